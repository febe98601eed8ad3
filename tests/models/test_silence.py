"""After the ground motion a run goes on through silence until the dam is at rest, as with zeros behind the record."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from heeltoe import (
    GroundMotion,
    InputError,
    decoupled,
    flexible,
    read_case,
    rigid,
    rigid_many,
    run,
    verdict,
    with_spread,
)
from heeltoe.kernel.block import Limits
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.rest import rests_from
from heeltoe.warnings.notice import Notice
from shared.dams import BASE, COARSE, ENDS, HEIGHT, SLENDER, example, plane_case

# The ground motion stops while the block slides.
SLIDING = ["motion.duration=2.1s", "flexible.elements_across=2", "flexible.evidence=none"]
# Once it slides nothing stops it.
SLIPPERY = ["crack.static_friction=1.0", "crack.kinetic_friction=0.6", "motion.duration=3s"]
MODELS = {
    "rigid": (rigid, BASE, SLIDING),
    "flexible": (flexible, BASE, SLIDING),
    "decoupled": (decoupled, HEIGHT, [*SLIDING, "motion.pga=1g"]),
}


def padded(motion: GroundMotion, seconds: float) -> GroundMotion:
    """Return a record with zeros behind it."""
    time, values = motion.time, motion.acceleration
    end = motion.duration
    return GroundMotion.from_points(
        np.append(time, [end, end + seconds]), np.append(values, [0.0, 0.0]), name=motion.name
    )


def codes(response) -> list[str]:
    return [warning.code for warning in response.warnings]


def same(one, other) -> bool:
    """Whether two runs are the same to the last bit, but for what they warn of and which motion they name."""
    return numbers(one) == numbers(other)


def numbers(response):
    """Return what a run is, but for what it warns of and which motion it names."""
    result = response.to_json()
    for name in ("warnings", "motion", "silence_s", "verdict", "chosen"):
        result.pop(name)
    # It holds the spectrum of the ground, which swings on in zeros.
    result.pop("crack_level", None)
    return result


def approximately(summary):
    """The same numbers but for rounding."""
    if isinstance(summary, dict):
        return {name: approximately(value) for name, value in summary.items()}
    if isinstance(summary, list | tuple):
        return [approximately(value) for value in summary]
    return pytest.approx(summary, rel=1e-6, abs=1e-9) if isinstance(summary, float) else summary


@pytest.mark.parametrize("model", MODELS)
def test_a_dam_that_still_slides_when_the_record_ends_goes_on_as_with_zeros_behind_it(model):
    function, path, changes = MODELS[model]
    # On a rigid plane the moments of the largest tension and slip are those of steps of 0.2 ms in both runs.
    result = function(plane_case(path, changes))
    assert result.silence_s > 0.0
    assert result.end_time_s == pytest.approx(2.1 + result.silence_s)
    longer = plane_case(path, [*changes, ENDS, f"motion.duration={2.1 + result.silence_s!r}s"])
    again = function(longer, padded(result.motion, result.silence_s))
    # The steps of an elastic dam differ in their last digit, as its record is longer.
    assert same(result, again) or (model == "flexible" and numbers(again) == approximately(numbers(result)))
    cut = function(plane_case(path, [*changes, ENDS]))
    assert cut.silence_s == 0.0
    assert abs(cut.residual_slip_m) < 0.97 * abs(result.residual_slip_m)


points = st.lists(st.tuples(st.floats(0.05, 0.4), st.floats(-12.0, 12.0)), min_size=2, max_size=8).map(
    lambda steps: GroundMotion.from_points(np.cumsum([0.0, *(h for h, _ in steps)]), [0.0, *(a for _, a in steps)])
)


@settings(max_examples=30)
@given(motion=points, friction=st.floats(0.3, 1.2), vertical=st.booleans())
def test_any_block_goes_on_as_with_zeros_behind_its_motion(motion, friction, vertical):
    case = read_case(SLENDER, [f"crack.friction={friction}", "analysis.event_limit=2000"])
    up = motion.scaled(0.4) if vertical else None
    response = rigid(case, motion, up)
    quiet = case.with_({"analysis.silence": "0 s"})
    if response.silence_s == 0.0:
        assert same(response, rigid(quiet, motion, up))
    else:
        after = [None if item is None else padded(item, response.silence_s) for item in (motion, up)]
        again = rigid(quiet, *after)
        assert again.summary == response.summary
        assert again.energy == response.energy
        assert all(np.array_equal(again.event_log[name], response.event_log[name]) for name in response.event_log)
    assert response.final_mode == "rest" or response.silence_s == 10.0 or response.outcome != "ok"


def test_the_silence_is_as_long_as_it_takes():
    response = rigid(read_case(BASE, SLIDING))
    assert response.silence_s == 2.5
    rest = rests_from(response)
    assert 2.1 < rest < 2.1 + 2.5
    assert rest == response.event_log["time_s"][-1]
    time = response.histories["time_s"]
    assert np.all(np.diff(time[time > 2.1]) <= 0.02 + 1e-12)
    assert (response.histories["ground_acceleration_m_s2"][time > 2.1] == 0.0).all()
    assert response.to_json()["silence_s"] == 2.5
    words = f"The ground motion is cut at 2.1 s; the dam comes to rest {rest - 2.1:.2g} s later, in silence."
    assert words in verdict(response)
    whole = GroundMotion.from_points([0.0, 0.5], [-6.0, -6.0])
    assert "The ground motion ends at 0.5 s; the dam comes to rest" in verdict(
        rigid(read_case(BASE, ["motion.duration=0.5s"]), whole)
    )


def test_a_dam_at_rest_costs_one_run(monkeypatch):
    runs = []
    plain = ShakenDam.run

    def counted(shaken, *args, **options):
        runs.append(shaken.shaking.end)
        return plain(shaken, *args, **options)

    monkeypatch.setattr(ShakenDam, "run", counted)
    quiet = [*COARSE, "motion.duration=3s", "motion.pga=0.05g", "reservoir.depth=20m"]
    assert flexible(plane_case(BASE, quiet)).silence_s == 0.0
    assert runs == [3.0]
    runs.clear()
    response = flexible(plane_case(BASE, [*COARSE, "motion.duration=3s"]))
    # One more for the damping.
    assert runs == [3.0, 3.0 + response.silence_s]
    assert 0.0 < response.silence_s < 10.0


def test_without_silence_a_run_ends_with_the_motion_and_says_so():
    response = rigid(read_case(BASE, [*SLIDING, ENDS]))
    assert (response.silence_s, response.end_time_s) == (0.0, 2.1)
    message = next(warning for warning in response.warnings if warning.code == "still-moves")
    assert message.field == "analysis.silence"
    assert "still moves when the ground motion ends (slide downstream, slip velocity" in str(message)
    assert "a longer analysis.silence may let it come to rest" in str(message)
    assert "It still moves when the run ends (slide downstream)" in verdict(response)


@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_what_never_comes_to_rest_is_told(model):
    changes = {"rigid": SLIPPERY, "flexible": [*COARSE, "motion.duration=3s"]}[model]
    response = MODELS[model][0](read_case(BASE, [*changes, "analysis.silence=1s"]))
    assert response.outcome == "ok"
    assert response.silence_s == 1.0
    message = next(str(warning) for warning in response.warnings if warning.code.endswith("still-moves"))
    assert "still moves 1 s after the ground motion has ended" in message
    assert "when the run ends, 1 s after the ground motion" in verdict(response)


def test_models_side_by_side_end_together():
    response = run(read_case(BASE, [*COARSE, "motion.duration=2.1s"]), "both")
    assert response.silence_s > response.beside.silence_s - 1e-9 > 0.0
    assert response.beside.end_time_s == pytest.approx(response.end_time_s)
    assert response.silence_s == response.beside.silence_s
    # The block needs the silence, the dam has it.
    slow = ["crack.static_friction=1.0", "crack.kinetic_friction=0.8", "motion.duration=3s"]
    both = run(read_case(BASE, [*slow, *COARSE]), "both")
    assert both.silence_s == both.beside.silence_s >= rigid(read_case(BASE, slow)).silence_s


def test_what_goes_on_after_the_end_is_no_silence():
    across = GroundMotion.from_points([0.0, 1.0], [-4.0, -4.0])
    longer = GroundMotion.from_points([0.0, 5.0], [2.0, 2.0])
    shaking = Earthquake(across, longer, 1.0).silent(2.5).shaking
    assert shaking.time.tolist() == [0.0, 1.0, 1.0, 3.5]
    assert shaking.horizontal.tolist() == [-4.0, -4.0, 0.0, 0.0]
    assert shaking.up is not None
    assert shaking.up.tolist() == [2.0, 2.0, 0.0, 0.0]
    # A motion that ends with zero does not jump.
    ends = GroundMotion.from_points([0.0, 1.0], [-4.0, 0.0])
    assert Earthquake(ends, None, 1.0).silent(2.5).shaking.time.tolist() == [0.0, 1.0, 3.5]


@pytest.mark.parametrize("model", MODELS)
def test_a_spread_ends_where_its_run_does(model):
    function, path, changes = MODELS[model]
    case = read_case(path, changes)
    response = with_spread(function(case), case, 3)
    assert response.spread["residual_slips_m"][1] == response.residual_slip_m


def test_many_runs_end_where_each_of_them_does():
    changes = [["crack.friction=0.9"], ["crack.friction=1.3"], SLIPPERY[:2], ["analysis.rotation=p-delta"], [ENDS]]
    cases = [read_case(BASE, ["motion.duration=2.1s", *change]) for change in changes]
    alone = [rigid(case) for case in cases]
    batch = rigid_many(cases, [alone[0].motion])
    assert batch["slip"].tolist() == [item.residual_slip_m for item in alone]
    assert batch["end_time"].tolist() == [item.end_time_s for item in alone]
    assert len({item.silence_s for item in alone}) == 3
    quiet = rigid_many(cases, [alone[0].motion], limits=Limits(silence=0.0))
    assert (quiet["end_time"] == 2.1).all()
    numbers = np.array([case.cut and rigid_many([case], [alone[0].motion])["slip"][0] for case in cases[:2]])
    assert batch["slip"][:2].tolist() == numbers.tolist()
    with pytest.raises(InputError, match=r"^limits\.silence: nan is out of range; give a value from 0 to 600 s$"):
        rigid_many(cases, [alone[0].motion], limits=Limits(silence=math.nan))


def test_a_block_may_overturn_in_silence():
    push = GroundMotion.from_points([0.0, 0.3], [-8.0, -8.0])
    changes = ["analysis.rotation=finite", "crack.restitution=0", "motion.duration=1s"]
    response = rigid(read_case(SLENDER, changes), push)
    assert response.outcome == "overturned"
    assert response.end_time_s > 1.0
    assert rigid(read_case(SLENDER, [*changes, ENDS]), push).outcome == "ok"


def test_a_silence_that_nobody_needs_is_told():
    quiet = ["motion.pga=0.05g", "reservoir.depth=20m", "motion.duration=3s"]
    assert "fields-idle" not in codes(rigid(read_case(BASE, quiet)))
    notice = Notice(
        "fields-idle",
        field="analysis.silence",
        fields="analysis.silence",
        why="nothing moves when the ground motion ends",
    )
    assert notice in rigid(read_case(BASE, [*quiet, "analysis.silence=5s"])).warnings
    for value in ("-1s", "601s"):
        with pytest.raises(InputError, match=r"analysis\.silence"):
            example("block", f"analysis.silence={value}")


@pytest.mark.slow
def test_a_crack_that_swings_on_moves_a_block_that_had_come_to_rest():
    cuts = [example("typical-height", "crack.friction=0.6", "motion.pga=1g", "flexible.elements_across=2")]
    cuts = [cuts[0].with_(f"motion.duration={6.0 + 0.05 * place:g}s") for place in range(20)]
    moved = []
    for case in cuts:
        ends = decoupled(case.with_(ENDS))
        if ends.final_mode != "rest":
            continue
        goes_on = decoupled(case)
        motion = ends.motion.cut(case.motion.duration)
        by_hand = decoupled(case.with_(ENDS, "motion.duration=20s"), padded(motion, 20.0 - motion.duration))
        assert goes_on.residual_slip_m == pytest.approx(by_hand.residual_slip_m, rel=1e-9)
        moved.append(goes_on.residual_slip_m != ends.residual_slip_m)
        if len(moved) == 3:
            break
    assert any(moved)
