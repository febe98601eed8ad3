"""Closed forms and limits of the static checks; the crack beside a slow search for the first place that holds."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import heeltoe
from heeltoe import read_case
from heeltoe.mechanics.block import build_block
from heeltoe.mechanics.loads import total, uplift_profile
from heeltoe.models.statics.cases import pseudo_static, usual
from shared.statics import CLOSE, SHAKEN, TRIANGLE, M, dam, only

DRY = {"section": {"polygon": TRIANGLE}, "crack": {"friction": 0.9}}


def test_critical_water_level():
    """With a friction of 0.7 the factor is 1 at 0.7 (96 - 0.4 h) = 0.005 h^2: h = -28 + sqrt(784 + 13440), and
    2.0, what USACE requires, at h = -14 + sqrt(196 + 6720), both with all of the base in compression."""
    levels = heeltoe.statics(dam(crack={"friction": 0.7})).critical_water_level_m
    assert levels["sliding"] == pytest.approx(-28.0 + math.sqrt(14224.0), **CLOSE)
    assert levels["sliding_required"] == pytest.approx(-14.0 + math.sqrt(6916.0), **CLOSE)
    assert levels["overturning"] is levels["flotation"] is None


def test_critical_water_level_of_overturning_is_where_the_crack_goes_through():
    # On the light dam, L = 3 (M - p B^2/2) / (W - p B) comes to nothing at M = p B^2/2:
    # 80 x 160/3 - h^3/600 = 0.01 h x 3200
    light = dam("60 m", concrete={"density": "2000 kg/m^3"})
    roots = np.roots([1.0 / 600.0, 0.0, 32.0, -12800.0 / 3.0])
    level = float(roots[np.argmin(abs(roots.imag))].real)
    assert heeltoe.statics(light).critical_water_level_m["overturning"] == pytest.approx(level, rel=1e-6)


def test_critical_water_levels_are_looked_for_up_to_the_flood():
    """Above the crest the push is 0.01 (h - 50) MN: 0.95 (96 - 0.4 h) = h - 50, where the base takes tension."""
    whole = {"bonded": 1.0, "tensile_strength": "100 MPa"}
    low, high = (
        heeltoe.statics(dam(crack={"friction": 0.95}, statics=whole | flood))
        for flood in ({}, {"flood_depth": "110 m"})
    )
    assert (low.highest_water_level_m, high.highest_water_level_m) == (100.0, 110.0)
    assert low.critical_water_level_m["sliding"] is None
    assert high.critical_water_level_m["sliding"] == pytest.approx((0.95 * 96.0 + 50.0) / 1.38, **CLOSE)


def test_no_flood_may_be_said():
    case = dam(statics={"flood_depth": "none"})
    assert [item.name for item in heeltoe.statics(case).cases] == ["usual"]
    flooded = {"statics": {"flood_depth": "95 m", "flood_tailwater": "5 m", "flood_rarity": "extreme"}}
    assert read_case(flooded | DRY, {"statics.flood_depth": "none"}).statics.flood_tailwater is None


def test_critical_acceleration_is_that_of_the_block():
    critical = heeltoe.statics(dam()).critical_acceleration_g
    # Sliding: (0.9 x 60 - 40.5) / (96 + 47.25); rocking about the toe: (5120 - 3135) / (96 x 100/3 + 47.25 x 36)
    assert critical["sliding_downstream"] == pytest.approx(13.5 / 143.25, **CLOSE)
    assert critical["rocking_downstream"] == pytest.approx(1985.0 / (3200.0 + 1701.0), **CLOSE)


def test_a_dry_dam_is_pushed_by_nothing():
    result = heeltoe.statics(dam(reservoir=None))
    outcome = only(result, "usual")
    assert outcome.sliding_factor is outcome.flotation_factor is outcome.overturning_factor is None
    assert outcome.resultant_from_heel_m == pytest.approx(80.0 / 3.0)
    assert outcome.heel_stress_pa == pytest.approx(2.4 * M)
    assert outcome.toe_stress_pa == pytest.approx(0.0, abs=1e-6)
    assert result.ok, [str(check.sentence) for check in result.checks]
    assert len(result.cases) == 1


@pytest.mark.parametrize(("depth", "density"), [(5.0, 2400), (9.0, 2400), (9.0, 1700)])
def test_mirror(depth, density):
    """A rectangle does not know upstream from downstream, nor whether it is cracked from heel or toe."""
    block = {"polygon": [["0 m", "0 m"], ["6 m", "0 m"], ["6 m", "9 m"], ["0 m", "9 m"]]}
    water = {"depth": f"{depth} m"}
    concrete = {"density": f"{density} kg/m^3"}
    up = only(heeltoe.statics(dam(section=block, concrete=concrete, reservoir=water)), "usual")
    down = only(heeltoe.statics(dam(section=block, concrete=concrete, reservoir=None, tailwater=water)), "usual")
    assert up.outcome == down.outcome == ("cracks through" if density == 1700 else "stands")
    assert bool(up.cracked_length_m) == (depth == 9.0)
    assert up.cracked_length_m == pytest.approx(down.cracked_length_m)
    if up.cracked_length_m:
        assert (up.cracked_from, down.cracked_from) == ("heel", "toe")
    assert up.eccentricity_m == pytest.approx(-down.eccentricity_m)
    assert up.sliding_factor == pytest.approx(down.sliding_factor)
    assert up.overturning_factor == pytest.approx(down.overturning_factor)
    assert (up.overturning_about, down.overturning_about) == ("toe", "heel")
    if up.outcome == "stands":
        assert up.heel_stress_pa == pytest.approx(down.toe_stress_pa)


@pytest.mark.parametrize("degrees", [10.0, -10.0])
def test_an_inclined_crack(degrees):
    # A dry column slides down its crack: mu N / T = mu / tan(alpha), upstream where the crack rises downstream.
    column = {"polygon": [["0 m", "0 m"], ["6 m", "0 m"], ["6 m", "20 m"], ["0 m", "20 m"]]}
    crack = {"friction": 0.9, "elevation": "5 m", "inclination": f"{degrees} deg"}
    result = only(heeltoe.statics(dam(section=column, reservoir=None, crack=crack)), "usual")
    assert result.sliding_factor == pytest.approx(0.9 / math.tan(math.radians(10.0)), **CLOSE)
    assert math.copysign(1.0, result.shear_force_n) == -math.copysign(1.0, degrees)


def test_a_crack_nearly_level_opens_as_a_level_one():
    level = only(heeltoe.statics(dam("100 m")), "usual")
    for degrees in (1e-7, -1e-7):
        crack = {"friction": 0.9, "elevation": "0.001 m", "inclination": f"{degrees} deg"}
        result = only(heeltoe.statics(dam("100 m", crack=crack), 1.0), "usual")
        assert result.cracked_length_m == pytest.approx(level.cracked_length_m, rel=1e-3)
        assert result.sliding_factor == pytest.approx(level.sliding_factor, rel=1e-3)


def test_water_above_an_inclined_crack():
    # The crack rises by 5 deg from 30 m; 20 m of water stand above its heel, none at the toe. It is open where the slip
    # upstream has left the heel, and there the pressure falls with the height: 0.2 - 0.01 x sin(5 deg).
    crack = {"friction": 0.9, "elevation": "30 m", "inclination": "5 deg"}
    case = dam("50 m", crack=crack)
    section = case.cut
    width, rise = section.crack_width, math.sin(math.radians(5.0))
    result = only(heeltoe.statics(case, -1.0), "post-seismic")
    uplift = next(force for force in result.forces if force.name == "uplift")
    # The toe opens a little, dry.
    assert result.cracked_from == "toe"
    assert 0.0 < result.cracked_length_m < 3.0
    expected = 0.2 - 0.01 * rise / 2.0 + 0.2 / 2.0 * (width - 1.0 - result.cracked_length_m)
    assert math.hypot(uplift.horizontal, uplift.vertical) == pytest.approx(expected * M, **CLOSE)


def test_an_anchor_holds():
    # 10 MN/m at 10 from the heel, leaning upstream by 30 deg: N + 8.66, T - ... pulled towards the part below
    anchor = {"distance": "10 m", "prestress": "10 MN/m", "inclination": "30 deg"}
    result = only(heeltoe.statics(dam(anchors=[anchor])), "usual")
    assert result.normal_force_n == pytest.approx((60.0 + 10.0 * math.cos(math.pi / 6.0)) * M, **CLOSE)
    assert result.shear_force_n == pytest.approx((40.5 - 5.0) * M, **CLOSE)


def test_seismic_forces_are_those_of_the_block():
    """The same forces one by one as the rigid model has per unit of acceleration."""
    case = dam(
        crack={"friction": 0.9, "elevation": "10 m", "inclination": "5 deg"},
        reservoir={"depth": "90 m", "follows_vertical_motion": True},
        statics=SHAKEN,
    )
    section, block = case.cut, build_block(case)
    load_case = pseudo_static(case, usual(case))[0].load_case
    sums = total("all", (force for force in load_case.forces if force.name != "uplift"))
    still = total("still", (force for force in block.forces if force.name != "uplift"))
    extra = total("extra", (sums, type(sums)("", -still.horizontal, -still.vertical, -still.moment)))
    along, across = section.in_crack_frame(extra.horizontal, extra.vertical)
    a, v = -1.0, -0.5
    rates = [a * h + v * u for h, u in zip(block.per_horizontal, block.per_vertical, strict=True)]
    moment = extra.moment - block.heel_distance * across + block.height * along
    assert [along, across, moment] == pytest.approx(rates, rel=1e-9)


@settings(max_examples=150)
@given(
    pattern=st.sampled_from(["uniform", "triangular", "cut-off", "drained", "profile"]),
    base=st.floats(68.0, 80.0),
    depth=st.floats(88.0, 100.0),
    tail=st.floats(0.0, 5.0),
    density=st.integers(2150, 2700),
    bonded=st.floats(0.0, 1.0),
    strength=st.floats(0.0, 0.1),
    intensity=st.floats(0.4, 1.0),
)
def test_the_crack_stops_at_the_first_place_that_holds(
    pattern, base, depth, tail, density, bonded, strength, intensity
):
    """Against stresses by plain sums: at the length found the tip just holds, and nowhere before."""
    options = {
        "cut-off": {"extent": 0.4},
        "drained": {"drain_position": 0.15, "drain_efficiency": 0.5},
        "profile": {"points": [[0.0, "90 m"], [0.2, "40 m"], [0.2, "30 m"], [1.0, "5 m"]]},
    }
    case = dam(
        f"{depth} m",
        section={"polygon": [["0 m", "0 m"], [f"{base} m", "0 m"], ["0 m", "100 m"]]},
        tailwater={"depth": f"{tail} m"},
        concrete={"density": f"{density} kg/m^3"},
        uplift={"pattern": pattern, "intensity": intensity, **options.get(pattern, {})},
        statics={"bonded": bonded, **({"tensile_strength": f"{strength} MPa"} if bonded else {})},
    )
    load_case = usual(case).load_case
    load = total("", (force for force in load_case.forces if force.name != "uplift"))
    knots = uplift_profile(case)

    def tip(length):
        """Stress at the tip and strength there, times the square of what is left, all by sums."""
        points = knots[knots[:, 0] > length]
        if length > 0.0 and pattern != "profile":
            points = np.vstack([[length, intensity * 1e4 * depth], points])
        else:
            points = knots
        # Strips that end where the pressure bends or jumps.
        ends = np.unique(np.concatenate([np.linspace(0.0, base, 20001), knots[:, 0], [length]]))
        x, wide = (ends[1:] + ends[:-1]) / 2.0, np.diff(ends)
        p = np.where(x < length, 1e4 * depth, np.interp(x, *points.T))
        normal = -load.vertical - (p * wide).sum()
        moment = -load.moment - (p * x * wide).sum()
        left = base - length
        stress = 4.0 * normal / left - 6.0 * (moment - normal * length) / left**2
        holds = strength * M if bonded and length >= (1.0 - bonded) * base else 0.0
        return (stress + holds) * left**2

    assume(load_case.cracked_from == "heel")
    scale = 1e-5 * base * 96.0 * M
    crack = load_case.cracked_length_m
    if load_case.outcome == "stands":
        assert tip(crack + 1e-9 if crack else 0.0) >= -scale
    if crack and load_case.outcome != "floats":
        assert all(tip(length) < scale for length in np.linspace(0.0, crack, 7)[:-1])


@pytest.mark.parametrize("criteria", ["USACE", "USBR", "FERC", "CDA", "CADAM3D"])
def test_the_manual_that_measures_drains_in_another_way_is_named_with_its_efficiency(criteria):
    drains = {"pattern": "drained", "drain_position": 0.2, "drain_efficiency": 0.5}
    case = dam(uplift=drains, statics={"criteria": criteria})
    notices = [notice for notice in heeltoe.statics(case).warnings if notice.code == "drains-by-manual"]
    assert len(notices) == (criteria == "USACE")
    for notice in notices:
        same = dict(notice.quantities)["same"]
        # Without drains the head there is 0.8 of the reservoir's; the manual leaves half of that.
        head = uplift_profile(dam(uplift={**drains, "drain_efficiency": same}))[1, 1]
        assert head == pytest.approx(0.5 * 0.8 * uplift_profile(case)[0, 1], **CLOSE)
