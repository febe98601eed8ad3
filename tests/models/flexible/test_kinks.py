"""Cracks that are not straight: limits, a climbing sawtooth, a shear key, balance of forces and energy, refusals."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

from heeltoe import run
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.geometry.axes import places
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.mesh.kinks import angles
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake, flexible
from shared.dams import plane_case
from validation.blocks.elastic_cracks import sawtooth

GRAVITY = 9.80665
PULSES = [["0 s", "0 g"], ["0.15 s", "-0.6 g"], ["0.4 s", "0.5 g"], ["0.65 s", "-0.5 g"], ["0.8 s", "0 g"]]
DAM = {
    "section": {"height": "110 m", "crest_width": "8 m", "base_width": "90 m"},
    "concrete": {"modulus": "20 GPa"},
    "crack": {"elevation": "20 m", "friction": 0.9},
    "reservoir": {"depth": "105 m"},
    "motion": {"points": PULSES, "duration": "1 s"},
    "analysis": {"silence": "0 s"},
    # One step for straight cracks, which may take longer ones, and those with kinks.
    "flexible": {"elements_across": 6, "evidence": "none", "time_step": "0.2 ms"},
}
STEP = [["30 m", "0 m"], ["34 m", "1.5 m"]]


def dam(**crack: object) -> Case:
    return plane_case(DAM | {"crack": DAM["crack"] | crack})


def slip_of(case: Case):
    return flexible(case).histories["slip_m"]


def test_kinks_of_no_height_are_none():
    straight = slip_of(dam())
    assert abs(straight).max() > 0.01
    assert slip_of(dam(kinks=[["30 m", "0 m"]])).tobytes() == straight.tobytes()


# Even elements along a straight crack, too, as along one with kinks.
EVEN = ["flexible.elements_across=8", "flexible.elements_away=4"]


def test_kinks_of_hardly_a_height_change_hardly_anything():
    # At corners of elements, so that the mesh is the same but for the height.
    width = dam().cut.crack_width
    kinks = [[f"{width / 4!r} m", "1e-7 m"], [f"{width / 2!r} m", "0 m"]]
    straight, other = (slip_of(dam(**crack).with_(*EVEN)) for crack in ({}, {"kinks": kinks}))
    assert np.any(straight != other)
    np.testing.assert_allclose(other, straight, rtol=0.0, atol=2e-5 * abs(straight).max())


def test_both_faces_follow_the_line():
    case = dam(kinks=STEP, inclination="5 deg")
    built = build_flexible_dam(case)
    upper, lower = (body.mesh for body in built.bodies)
    line = places(upper.nodes[upper.crack], case.cut)
    np.testing.assert_allclose(upper.nodes[upper.crack], lower.nodes[lower.crack], rtol=0.0, atol=1e-9)
    corners = np.array([(0.0, 0.0), (30.0, 0.0), (34.0, 1.5), (case.cut.crack_width, 0.0)])
    np.testing.assert_allclose(line[:, 1], np.interp(line[:, 0], *corners.T), rtol=0.0, atol=1e-9)
    for corner in corners:
        assert np.hypot(*(line - corner).T).min() < 1e-9
    assert max(angles(upper, upper.crack, case)) == pytest.approx(math.atan2(1.5, 4.0))
    total = sum(body.loads["weight"].sum() for body in built.bodies)
    assert total == pytest.approx(-case.concrete.density * GRAVITY * case.outline.area, rel=1e-9)


@pytest.mark.parametrize(("degrees", "friction"), [(10.0, 0.3), (20.0, 0.2)])
def test_a_sawtooth_climbs_as_a_block_on_a_slope_does(degrees, friction):
    """On a slope i the crack holds up to tan(phi + i), and above it the block is pushed uphill as by hand."""
    rise = math.radians(degrees)
    strength = GRAVITY * math.tan(math.atan(friction) + rise)
    assert abs(slip_of(sawtooth(rise, friction, 0.95 * strength))).max() < 1e-3
    push = 1.4 * strength
    response = flexible(sawtooth(rise, friction, push))
    uphill = push * math.cos(rise) - GRAVITY * math.sin(rise)
    uphill -= friction * (GRAVITY * math.cos(rise) + push * math.sin(rise))
    time, slip, gap = (response.histories[name] for name in ("time_s", "slip_m", "gap_heel_m"))
    assert slip[-1] == pytest.approx(0.5 * uphill * time[-1] ** 2 * math.cos(rise), rel=0.05)
    assert gap[-1] >= 0.0


def test_a_step_without_friction_bears_the_push_by_its_face():
    """Nothing but pressure normal to each piece: what holds the dam along the crack is the face of the step."""
    case = dam(kinks=[["30 m", "0 m"], ["36 m", "6 m"], ["60 m", "0 m"]], friction=0.0).with_("uplift.pattern=none")
    built = build_flexible_dam(case)
    assert built.start.stands
    along, across = built.crack_forces[0]
    body = built.bodies[0]
    push, weight = body.load[::2].sum(), body.load[1::2].sum()
    assert along.sum() == pytest.approx(-push, rel=1e-9)
    assert across.sum() == pytest.approx(-weight, rel=1e-9)
    slope = np.array(angles(body.mesh, body.mesh.crack, case))
    inner = np.flatnonzero(np.abs(np.diff(slope)) < 1e-9) + 1
    np.testing.assert_allclose(along[inner], -np.tan(slope[inner]) * across[inner], atol=1e-9 * abs(push))


def test_the_ledger_closes_and_a_step_holds_back():
    response = flexible(dam(kinks=STEP))
    energy = {
        name: response.histories[f"{name}_energy_j"] for name in ("stored", "input", "damping", "friction", "impact")
    }
    lost = energy["damping"] + energy["friction"] + energy["impact"]
    left = energy["input"] - (energy["stored"] - energy["stored"][0]) - lost
    assert abs(left).max() < 0.02 * abs(energy["input"]).max()
    assert left.min() > -1e-3 * abs(energy["input"]).max()
    assert abs(response.histories["slip_m"]).max() < abs(slip_of(dam())).max()


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"crack.kinks": [["30 m", "1 m"], ["20 m", "0 m"]]}, "crack.kinks: the distances [30.0, 20.0] do not ascend"),
        ({"crack.kinks": [["0 m", "1 m"]]}, "crack.kinks: the distances [0.0] do not ascend"),
        ({"crack.kinks": [["90 m", "1 m"]]}, "crack.kinks: 90 m is out of range; give a value below"),
        ({"crack.kinks": [["30 m", "0 m"], ["31 m", "5 m"]]}, "crack.kinks: the crack runs at 78.7 deg"),
        ({"crack.elevation": "0 m"}, "crack.kinks: the section ends at the crack"),
        (
            {"crack.roughness": {"asperity_height": "5 cm", "wave_length": "1 m"}},
            "crack.roughness: roughness cannot be combined with kinks",
        ),
        (
            {"further_cracks": [{"elevation": "60 m", "kinks": [["5 m", "0 m"], ["6 m", "6 m"]]}]},
            "further_cracks[0].kinks: the crack runs at 80.5 deg",
        ),
        (
            {"further_cracks": [{"elevation": "22 m", "kinks": [["20 m", "-3 m"]]}]},
            "further_cracks[0].elevation: the crack at 22 m meets or crosses that at 20 m",
        ),
        (
            {"uplift.during_shaking": "zero while open"},
            'uplift.during_shaking: uplift that changes during shaking ("zero while open") cannot',
        ),
        (
            {"flexible.contact": "idce", "flexible.damping": "stiffness"},
            'flexible.contact: penalty contact ("idce") cannot be',
        ),
        (
            {"flexible.elements_across_below": 4},
            "flexible.elements_across_below: another number of elements below cannot be combined with kinks",
        ),
    ],
)
def test_what_is_wrong_is_refused_by_name(changes, said):
    with pytest.raises(InputError, match=re.escape(said)):
        dam(kinks=STEP).with_(changes)


def test_elements_that_cannot_follow_are_refused():
    many = [[f"{5 * k} m", f"{k % 2} m"] for k in range(1, 12)]
    with pytest.raises(InputError, match=r"crack\.kinks: elements cannot follow 11 kinks"):
        flexible(dam(kinks=many))


@pytest.mark.parametrize("model", ["rigid", "decoupled", "both"])
def test_other_models_refuse_kinks_by_name(model):
    with pytest.raises(InputError, match=r"crack\.kinks: .* does not support kinks"):
        run(dam(kinks=STEP), model=model)


def corners_of(case: Case) -> list[list[float]]:
    return [list(corner) for corner in case.section.vertices()]


def with_corners(case: Case, corners: list[list[float]], **changes: object) -> Case:
    polygon = [[f"{x!r} m", f"{z!r} m"] for x, z in corners]
    return case.with_({"section": {**dict.fromkeys(case.section.model_fields_set), "polygon": polygon}, **changes})


def test_a_mirrored_dam_slides_the_other_way():
    case = dam(kinks=STEP)
    width = case.cut.crack_width
    changes = {
        "crack.kinks": [[f"{width - 34.0!r} m", "1.5 m"], [f"{width - 30.0!r} m", "0 m"]],
        "reservoir": None,
        "tailwater": {"depth": "105 m", "compressible": False},
        "motion.reverse": True,
    }
    image = with_corners(case, [[-x, z] for x, z in reversed(corners_of(case))], **changes)
    one, other = flexible(case).histories, flexible(image).histories
    assert abs(one["slip_m"]).max() > 0.05
    np.testing.assert_allclose(other["slip_m"], -one["slip_m"], rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(other["gap_toe_m"], one["gap_heel_m"], rtol=0.0, atol=1e-9)


def test_a_larger_dam_on_larger_steps_slides_as_much_farther():
    # Four times the lengths and the modulus, twice the times.
    case = dam(kinks=STEP).with_({"flexible.time_step": "0.2 ms"})
    changes = {
        "crack.elevation": "80 m",
        "crack.kinks": [["120 m", "0 m"], ["136 m", "6 m"]],
        "reservoir.depth": "420 m",
        "concrete.modulus": "80 GPa",
        "motion.points": [[f"{2.0 * float(time.split()[0])} s", size] for time, size in PULSES],
        "motion.duration": "2 s",
        "flexible.time_step": "0.4 ms",
    }
    larger = with_corners(case, [[4.0 * x, 4.0 * z] for x, z in corners_of(case)], **changes)
    assert flexible(larger).residual_slip_m == pytest.approx(4.0 * flexible(case).residual_slip_m, rel=1e-9)


def test_a_run_has_the_same_bits_with_any_number_of_threads():
    case = dam(kinks=STEP)
    shaken_dam = ShakenDam(case, build_flexible_dam(case), earthquake(case).shaking)
    one, two = (shaken_dam.run_scaled(2e-4, np.array([0.9, 1.0, 1.1]), threads=threads) for threads in (1, 2))
    assert one["slip"].tobytes() == two["slip"].tobytes()
    assert one["slip"][1] == shaken_dam.run(2e-4).summary.slip


def test_anchors_hold_a_crack_with_kinks_as_a_straight_one():
    """By prestress and by what they gain as it opens and slips."""
    width = dam().cut.crack_width
    kinks = [[f"{width / 4!r} m", "1e-7 m"], [f"{width / 2!r} m", "0 m"]]
    anchor = {
        "distance": "20 m",
        "prestress": "3 MN/m",
        "axial_stiffness": "200 MN/m/m",
        "shear_stiffness": "50 MN/m/m",
    }
    bare = slip_of(dam().with_(*EVEN))
    straight, other = (slip_of(dam(**crack).with_(*EVEN, {"anchors": [anchor]})) for crack in ({}, {"kinks": kinks}))
    assert abs(straight).max() < 0.85 * abs(bare).max()
    np.testing.assert_allclose(other, straight, rtol=0.0, atol=2e-5 * abs(straight).max())
