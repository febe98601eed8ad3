"""No block drawn at random cycles: events that follow each other without time passing."""

import pytest

from shared.random_blocks import draw

# Blocks that cycled while the next mode was chosen by looking ahead for a tenth of a millisecond whatever the block, or
# while rounding was judged by what the water leaves of the weight or by what is left of accelerations that balance; by
# what they are.
BENDS = {
    "a stiff anchor, uplift that vanishes, any rotation": 7781,
    "a corner that lands before the look ahead ends": 10419,
    "two stiff anchors": 27378,
    "water that has no room to follow": 7053,
    "water that follows, small rotations": 29135,
    "lifts its toe where friction all but jams, any rotation": 229935,
}
# What moves the heel is exactly zero: the ground stands still in steps, at the very limit, when the heel has landed.
BALANCES = {"lands on its heel under loads that just balance, p-delta": 410984}
FLOATS = {
    "a hundred millionth of the weight is left, any rotation": 371,
    "a millionth of the weight, two anchors": 4486,
    "bounces at a ten millionth of the weight": 14733,
    "a corner that has just left while the other one lands": 4394,
    "a corner that lifts with less than rounding": 327127,
}
FLOATS_EXACTLY = {"rocks on its heel": 116, "slides and rocks": 168, "rocks on its toe": 372, "anchored": 2272}

# Steps that met between their stages an anchor that goes taut, or the water of a crack that all but closes: the energy
# that they made was a few ten thousandths of the turnover.
PASSED_OVER = {"slides into an anchor": 310104, "bounces on water": 304661, "bounces on water, p-delta": 308079}


def named(cases):
    return pytest.mark.parametrize("seed", list(cases.values()), ids=list(cases))


def ends(run):
    return run.outcome in ("ok", "overturned", "unstable", "paradox")


@named(BENDS | FLOATS | BALANCES)
def test_a_block_that_cycled_comes_to_its_end(seed):
    run = draw(seed).run()
    assert run.outcome == "ok"
    assert run.summary.events < 5_000
    assert run.summary.energy_residual < 1e-6


@named(PASSED_OVER)
def test_no_step_passes_over_what_happens_between_its_stages(seed):
    run = draw(seed).run()
    assert run.outcome == "ok"
    assert run.summary.energy_residual < 1e-9


def test_a_slip_that_friction_jams_on_its_way_ends_there():
    # It turns into Painlevé's paradox while it slides and rocks; a walk that went on without the forces overturned it.
    run = draw(322683).run()
    assert run.outcome == "paradox"
    assert run.summary.energy_residual < 1e-9


@named(FLOATS_EXACTLY)
def test_a_block_that_all_but_floats_comes_to_its_end_exactly(seed):
    run = draw(seed).run(exact=True)
    assert run.outcome == "ok"
    assert run.summary.events < 100
    assert run.summary.energy_residual < 1e-11


@pytest.mark.slow
def test_the_energy_of_a_thousand_is_accounted_for():
    assert max(draw(seed).run().summary.energy_residual for seed in range(1_000)) < 1e-5


@pytest.mark.product
@pytest.mark.parametrize("part", range(8))
def test_none_of_forty_thousand_cycles(part):
    seeds = range(5_000 * part, 5_000 * (part + 1))
    assert [seed for seed in seeds if not ends(draw(seed).run())] == []
