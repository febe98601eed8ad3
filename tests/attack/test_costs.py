"""What would take hours, or more memory than there is, is refused in one line with its estimate, before it begins."""

from __future__ import annotations

import time

import pytest

from heeltoe import InputError, read_case, run
from heeltoe.models.run import cost_of
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import measures
from heeltoe.motion.processing import band_pass
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.study.small.run_table import parse_axes, run_small
from heeltoe.study.small.statics import After, statics_table
from shared.attacked import limited
from shared.cases import refusal
from shared.dams import example

DAM = ('motion.points=[["0 s","0 g"],["0.5 s","0.3 g"],["1 s","0 g"]]', "motion.duration=1s", "analysis.silence=0s")


def refused(model, *changes):
    """Return the error of a run that must be refused at once."""
    case = example("typical-base", *DAM, *changes)
    begun = time.perf_counter()
    with pytest.raises(InputError) as error:
        run(case, model)
    assert time.perf_counter() - begun < 10.0
    return error.value


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ("flexible.elements_across=200", "flexible.elements_across"),
        ("flexible.time_step=1e-9s", "flexible.time_step"),
        ("flexible.time_step=1e-300s", "flexible.time_step"),
        ("motion.duration=1e5s", "motion.duration"),
    ],
)
@pytest.mark.parametrize("model", ["flexible", "both"])
def test_elastic_parts_that_cost_too_much(model, change, field):
    error = refused(model, change)
    assert (error.code, error.field) == ("too-costly", field)
    assert len(str(error)) < 300


def test_all_modes_of_a_fine_mesh():
    error = refused("flexible", "flexible.elements_across=60", "flexible.modes=1000000000000")
    assert (error.code, error.field) == ("too-costly", "flexible.modes")


def test_a_step_that_only_what_is_in_the_crack_asks_for():
    assert refused("flexible", "analysis.time_limit=0.2s").code == "too-costly"


def test_the_chain():
    case = example("koyna", *DAM, "crack.elevation=66.5m", "flexible.elements_across=8")
    for change, field in (
        ("motion.duration=1e5s", "motion.duration"),
        ("analysis.time_limit=0.01s", "flexible.elements_across"),
    ):
        with pytest.raises(InputError) as error:
            run(case.with_(change), "decoupled")
        assert (error.value.code, error.value.field) == ("too-costly", field)


def test_what_is_proposed_allows_it():
    error = refused("flexible", "analysis.time_limit=0.1s", "analysis.memory_limit=1MB", "flexible.elements_across=2")
    allowed = str(error).split("allow it by ")[1].split(" and ")
    case = example("typical-base", *DAM, "flexible.elements_across=2", *(change.replace('"', "") for change in allowed))
    assert run(case, "flexible").summary


def test_a_table_is_judged_as_a_whole():
    fields = example("typical-base", *DAM).model_dump(mode="json", exclude_unset=True)
    variations = parse_axes(["crack.friction=0.8,1.0"])
    one = cost_of(read_case(fields))
    limit = f"analysis.time_limit={1.5 * one.seconds} s"
    with pytest.raises(InputError) as error:
        run_small(fields, [limit], variations, pytest.fail, cost=cost_of)
    assert (error.value.code, error.value.field) == ("too-costly", "--vary")


def test_a_table_of_choices_of_the_checks_costs_the_one_run_that_it_shares():
    dam = example("typical-base", *DAM, "flexible.elements_across=2", "flexible.evidence=none")
    after, limit = After(model="flexible"), f"analysis.time_limit={1.5 * cost_of(dam, 'flexible').seconds} s"
    fields = dam.model_dump(mode="json", exclude_unset=True)
    assert len(statics_table(fields, [limit], parse_axes(["statics.residual_friction=0.8,1.0"]), after).dams) == 2
    with pytest.raises(InputError) as error:
        statics_table(fields, [limit], parse_axes(["crack.friction=0.8,1.0"]), after)
    assert (error.value.code, error.value.field) == ("too-costly", "--vary")


def test_durations_that_are_none():
    for duration in ("1e-300s", "1e-9s"):
        for model in ("rigid", "flexible"):
            assert refused(model, f"motion.duration={duration}").code == "motion-brief"


def test_a_filter_without_end():
    motion = GroundMotion.from_points([0.0, 0.5, 1.0], [0.0, 1.0, 0.0])
    for corners in ({"low": 1e-9}, {"high": 1e-9}):
        with pytest.raises(InputError) as error:
            band_pass(motion, **corners)
        assert (error.value.code, error.value.field) == ("order-corner-slow", next(iter(corners)))


def test_measures_of_points_that_only_a_microsecond_divides():
    """A sum for each of 396 frequencies over a million samples took 10 s."""
    motion = GroundMotion.from_points([0.0, 0.106591, 0.436387, 0.436388, 0.936387], [0.0, 0.2, 0.5, -0.3, 0.0])
    with limited(5.0):
        assert 0.3 < measures(motion)["mean_period_s"] < 3.0


def test_periods_that_no_record_tells():
    motion = GroundMotion.from_points([0.0, 0.5, 1.0], [0.0, 1.0, 0.0])
    assert response_spectrum(motion, [0.0]).pseudo_acceleration[0] == 1.0
    with pytest.raises(InputError) as error:
        response_spectrum(motion, [1e-9])
    assert error.value.code == "spectrum-period"


def test_limits_have_units_of_memory():
    assert refusal("examples/block.toml", ["analysis.memory_limit=5kg"]).code == "wrong-quantity"
    assert read_case("examples/block.toml", ["analysis.memory_limit=2GiB"]).analysis.memory_limit == 2.0**31
