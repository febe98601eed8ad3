"""Static checks of cracks that are not straight: limits, images, how far they open, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

import heeltoe
from heeltoe import read_case
from heeltoe.errors.error import InputError
from heeltoe.models.statics.cases import usual
from heeltoe.models.statics.water import still_water
from shared.statics import dam, only

HALF = {"crack": {"elevation": "20 m", "friction": 0.9}}
STEP = [["20 m", "0 m"], ["23 m", "1.5 m"]]
SHAKEN = {"seismic_coefficient": 0.15, "vertical_seismic_coefficient": 0.1, "flood_depth": "99 m"}


def kinked(kinks, depth="90 m", **changes):
    return dam(depth, **({"crack": HALF["crack"] | {"kinks": kinks}, "statics": SHAKEN} | changes))


def numbers(case, slip=0.1):
    """Return the checks as plain data, without what they say of the case."""
    return {name: value for name, value in heeltoe.statics(case, slip).to_json().items() if name != "warnings"}


def test_kinks_of_no_height_change_nothing():
    assert numbers(kinked([["20 m", "0 m"], ["30 m", "0 m"]])) == numbers(kinked([]))


def test_kinks_of_hardly_a_height_change_hardly_anything():
    straight, other = (heeltoe.statics(kinked(kinks, "100 m"), 0.1) for kinks in ([], [["20 m", "1e-7 m"]]))
    opened = [item.cracked_length_m for item in straight.cases]
    assert max(opened) > 1.0
    for one, two in zip(straight.cases, other.cases, strict=True):
        assert two.outcome == one.outcome
        for name in ("normal_force_n", "shear_force_n", "sliding_factor", "cracked_length_m", "toe_stress_pa"):
            expected = getattr(one, name)
            assert getattr(two, name) == (expected if expected is None else pytest.approx(expected, rel=1e-6, abs=1e-6))
        if two.sliding_factor_on_pieces is not None:
            assert two.sliding_factor_on_pieces == pytest.approx(one.sliding_factor, rel=1e-6)


def test_a_mirrored_dam_has_mirrored_checks():
    section = {"polygon": [["0 m", "0 m"], ["60 m", "0 m"], ["60 m", "100 m"], ["0 m", "100 m"]]}
    there = kinked([["10 m", "0 m"], ["14 m", "2 m"]], section=section, statics=None)
    back = [["46 m", "2 m"], ["50 m", "0 m"]]
    image = kinked(back, section=section, statics=None, reservoir=None, tailwater={"depth": "90 m"})
    one, two = (only(heeltoe.statics(item), "usual") for item in (there, image))
    assert two.shear_force_n == pytest.approx(-one.shear_force_n)
    for name in ("normal_force_n", "sliding_factor", "sliding_factor_on_pieces", "steepest_rise_rad"):
        assert getattr(two, name) == pytest.approx(getattr(one, name), rel=1e-9)
    assert one.sliding_factor_on_pieces > 1.2 * one.sliding_factor
    assert two.heel_stress_pa == pytest.approx(one.toe_stress_pa, rel=1e-9)


def test_units_do_not_matter():
    # The same dam four times as large: forces grow by sixteen, factors stay.
    section = {"polygon": [["0 m", "0 m"], ["320 m", "0 m"], ["0 m", "400 m"]]}
    crack = {"elevation": "80 m", "friction": 0.9, "kinks": [["80 m", "0 m"], ["92 m", "6 m"]]}
    large = kinked([], "360 m", statics=None, section=section, crack=crack)
    one, two = (only(heeltoe.statics(item), "usual") for item in (kinked(STEP, statics=None), large))
    for name in ("sliding_factor", "sliding_factor_on_pieces", "flotation_factor", "overturning_factor"):
        assert getattr(two, name) == pytest.approx(getattr(one, name), rel=1e-9)
    assert two.normal_force_n == pytest.approx(16.0 * one.normal_force_n, rel=1e-9)


@pytest.mark.parametrize(
    ("depth", "uplift"),
    [
        ("99 m", {"pattern": "triangular"}),
        pytest.param(
            "102 m",
            {"pattern": "drained", "drain_position": 0.3, "drain_efficiency": 0.5},
            marks=pytest.mark.slow,
        ),
    ],
)
def test_it_opens_up_to_the_first_place_that_holds(depth, uplift):
    """Looked for in steps of a millimetre along the way."""
    case = kinked([["5 m", "1 m"], ["9 m", "-1.5 m"], ["40 m", "3 m"]], depth, uplift=uplift, statics=None)
    solved = usual(case)
    result, water = solved.load_case, still_water(case, 0.0, case.cut.crack_width)
    assert 1.0 < result.cracked_length_m < 50.0
    loads = [force for force in result.forces if force.name != "uplift"]
    down, turning = sum(force.vertical for force in loads), sum(force.moment for force in loads)

    def tip(length):
        lift, lever = water.act(water.pressure(length, 0.0))
        left = case.cut.crack_width - length
        normal = -down - lift
        away = -(turning + lever) - normal * (length + left / 2.0)
        return normal / left - 6.0 * away / left**2

    holds = next(length for length in np.arange(0.0, 60.0, 1e-3) if tip(length) >= 0.0)
    assert result.cracked_length_m == pytest.approx(holds, abs=1.1e-3)
    # Not as far as a straight crack: the water on the steps turns it, too.
    assert result.cracked_length_m != pytest.approx(
        usual(kinked([], depth, uplift=uplift, statics=None)).load_case.cracked_length_m, abs=1e-2
    )


def test_other_joints_are_straight():
    choice = {"sections": ["20 m", "40 m"]}
    joints = heeltoe.statics_of_sections(kinked(STEP, statics=choice)).joints
    assert [bool(joint.case.crack.kinks) for joint in joints] == [True, False]
    straight = heeltoe.statics_of_sections(kinked([], statics=choice)).joints
    assert joints[1].statics.to_json() == straight[1].statics.to_json()


def test_corners_outside_the_dam_are_refused():
    with pytest.raises(
        InputError, match=r"crack\.kinks: the crack with the corners \[\[48.0, 0.0\], \[55.0, 12.0\]\] leaves the dam"
    ):
        kinked([["48 m", "0 m"], ["55 m", "12 m"]])


def test_the_example_is_judged():
    result = heeltoe.statics(read_case("examples/stepped-crack.toml"))
    assert {"usual", "post-seismic"} == {item.name for item in result.cases}
    assert only(result, "usual").sliding_factor_on_pieces > only(result, "usual").sliding_factor
