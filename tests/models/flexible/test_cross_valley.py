"""An elastic dam shaken across the valley: periods and slips of independent programs, limits, ledger."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from heeltoe import InputError, flexible, rigid
from heeltoe.case.combinations import check
from heeltoe.case.shaking import resolve_all
from heeltoe.kernel.block import run_block
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.flexible.body.across import across_dam
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.flexible.surroundings.rock import RockMaterial, reduced_rock, smooth_tractions
from heeltoe.models.run import earthquake
from heeltoe.result.verdict import across_sentence
from models.rigid.test_cross_valley import MASS, el_centro, typical
from shared.dams import TYPICAL_SECTION, plane_case
from shared.random_dams import draw

STEP = 2.5e-4


def case_of(friction: float | None = 1.0, **more):
    """Return the typical dam of the reference; without friction where a law has it."""
    crack = {"elevation": "0 m"} | ({} if friction is None else {"friction": friction})
    fields = {
        "section": TYPICAL_SECTION,
        "concrete": {"density": "2650 kg/m^3", "modulus": "20 GPa", "poisson": 0.143, "damping": 0.05},
        "crack": crack | more.pop("crack", {}),
        "reservoir": {"depth": "100 m"},
        "uplift": {"pattern": "triangular"},
        "flexible": {"elements_across": 4, "theta": 0.5, "evidence": "none"} | more.pop("flexible", {}),
    }
    return plane_case(fields | more)


def shaken(case, shaking: Shaking) -> ShakenDam:
    """Return a dam on the way through both components."""
    return ShakenDam(case, build_flexible_dam(case), shaking)


def both(case, shaking: Shaking, step: float = STEP):
    """Return what the dam does with and without the shaking across the valley."""
    runs = [shaken(case, motion).run(step) for motion in (shaking, shaking.along_stream())]
    for run in runs:
        assert run.outcome == "ok"
        assert run.summary.energy_residual < 1e-12
        assert run.summary.contact_residual < 1e-8
    return [run.summary for run in runs]


def test_periods_are_those_of_an_independent_program():
    case = case_of(flexible={"elements_across": 8})
    periods = across_dam(case, build_flexible_dam(case)).damping.periods
    assert periods[:3] == pytest.approx([0.1557, 0.0701, 0.0479], rel=0.003)


def test_a_column_swings_by_shear_waves():
    section = {"height": "40 m", "crest_width": "10 m", "base_width": "10 m"}
    case = case_of(section=section, reservoir={"depth": "20 m"})
    across = across_dam(case, build_flexible_dam(case))
    speed = math.sqrt(20e9 / (2.0 * 1.143) / 2650.0)
    assert across.damping.periods[0] == pytest.approx(4.0 * 40.0 / speed, rel=1e-5)
    assert across.damping.ratios[[0, 2]] == pytest.approx([0.05, 0.05], rel=1e-3)
    # All mass follows the ground, half a wave's share of it at most in each mode.
    total = sum(float(np.sum(part.participation_horizontal**2)) for part in across.parts)
    assert total == pytest.approx(2650.0 * 400.0, rel=1e-9)


# Along, across, sign, peak [g], friction; without and with the other component, slip across [mm].
REFERENCE = [
    (180, 270, 1, 0.4, 1.0, 529.7, 533.8, 9.1),
    (270, 180, 1, 0.4, 1.0, 1059.5, 1222.3, -43.0),
    (180, 270, -1, 0.4, 1.0, 698.3, 758.2, 4.4),
    (270, 180, -1, 0.4, 1.0, 1077.8, 1309.2, 103.7),
    (180, 270, 1, 0.4, 1.2, 322.8, 336.4, -1.0),
    (270, 180, 1, 0.4, 1.2, 698.4, 765.7, -61.8),
    (180, 270, -1, 0.4, 1.2, 463.2, 501.0, -0.5),
    (270, 180, -1, 0.4, 1.2, 696.9, 781.2, 31.0),
    (180, 270, 1, 0.3, 1.0, 281.8, 293.4, 2.2),
    (270, 180, 1, 0.3, 1.0, 596.3, 683.2, -32.2),
    (180, 270, 1, 0.3, 1.2, 160.2, 166.1, 2.4),
    (270, 180, 1, 0.3, 1.2, 411.3, 424.5, -31.6),
    (180, 270, 1, 0.2, 1.0, 106.3, 109.9, 1.8),
    (270, 180, 1, 0.2, 1.0, 239.2, 265.5, -13.3),
    (180, 270, 1, 0.2, 1.2, 65.2, 65.9, 1.6),
    (270, 180, 1, 0.2, 1.2, 140.8, 156.6, -1.3),
]


@pytest.mark.parametrize(
    ("along", "across", "sign", "peak", "friction", "one", "two", "y"),
    [row if k == 1 else pytest.param(*row, marks=pytest.mark.slow) for k, row in enumerate(REFERENCE)],
)
def test_slips_of_el_centro_are_those_of_an_independent_program(
    records, along, across, sign, peak, friction, one, two, y
):
    with_it, without = both(case_of(friction), el_centro(records, along, across, sign, peak))
    slip, alone = 1e3 * with_it.slip, 1e3 * without.slip
    # Another mesh: that of the reference moves slips by 4 %, the factor by 0.04 and the slip across by 6 mm.
    assert [alone, slip] == pytest.approx([one, two], rel=0.05)
    assert slip / alone == pytest.approx(two / one, abs=0.03)
    assert 1e3 * with_it.cross_slip == pytest.approx(y, abs=6.0)


def made(seconds: float = 4.0, seed: int = 3, along: float = 0.5, across: float = 0.5) -> Shaking:
    """Return a made motion both ways."""
    rng = np.random.default_rng(seed)
    time = np.arange(round(seconds / 0.02) + 1) * 0.02
    envelope = np.sin(np.linspace(0.0, np.pi, time.size))
    x, y = (
        9.80665 * peak * envelope * np.clip(rng.normal(size=time.size), -2.0, 2.0) / 2.0 for peak in (along, across)
    )
    return Shaking(time, x, cross=y)


def points(seed: int, peak: float) -> list[list[str]]:
    """Return a made motion of a second, still at both ends [g]."""
    wave = np.random.default_rng(seed).normal(size=51) * np.sin(np.linspace(0.0, np.pi, 51))
    rows = enumerate(peak * wave / np.abs(wave).max())
    return [[f"{0.02 * k:.2f} s", f"{x:.4f} g"] for k, x in rows]


CROSSED = {"points": points(1, 0.6), "cross_valley": {"points": points(3, 0.5)}}


def test_a_stiff_dam_is_the_rigid_block(records):
    whole = el_centro(records, 270, 180, 1, 0.4)
    kept = whole.time <= 12.0
    shaking = Shaking(whole.time[kept], whole.horizontal[kept], cross=whole.cross[kept])
    stiff = case_of(1.2, concrete={"density": "2650 kg/m^3", "modulus": "20000 GPa", "poisson": 0.143, "damping": 0.05})
    run = shaken(stiff, shaking).run(1e-4)
    block = run_block(typical(1.2), shaking, np.empty(0), across=(MASS, math.inf, math.inf, 0.0, 0.0))
    assert run.summary.slip == pytest.approx(block.summary.slip, rel=0.03)
    assert run.summary.cross_slip == pytest.approx(block.crossing.summary.slip, abs=5e-4)


def test_a_ground_that_is_still_across_has_the_bits_of_one_component():
    case, shaking = case_of(), made()
    plain = shaken(case, shaking.along_stream()).run(STEP, 0.01)
    still = shaken(case, replace(shaking, cross=0.0 * shaking.cross)).run(STEP, 0.01)
    assert still.summary.by_name() == plain.summary.by_name()
    assert (still.frames.slip == plain.frames.slip).all()
    assert not still.crest_cross.size


def test_the_mirror_keeps_the_bits_along_the_stream():
    case, shaking = case_of(), made()
    one = shaken(case, shaking).run(STEP, 0.01)
    other = shaken(case, replace(shaking, cross=-shaking.cross)).run(STEP, 0.01)
    assert one.summary.slip == other.summary.slip
    assert (one.frames.slip_cross == -other.frames.slip_cross).all()
    assert (one.crest_cross == -other.crest_cross).all()
    assert abs(one.summary.cross_slip) > 1e-4


def test_a_held_dam_slides_as_with_one_component():
    held, plain = both(case_of(crack={"side_gap": "0 mm"}), made())
    assert held.slip == pytest.approx(plain.slip, rel=1e-3)
    assert [held.cross_slip, held.cross_slip_max, held.cross_slip_min] == pytest.approx([0.0] * 3, abs=1e-12)
    assert held.side_impulse > 0.0


def test_two_contacts_of_the_same_nodes_are_stopped_once(records):
    case = case_of(1.2, crack={"elevation": "40 m", "side_gap": "0 mm"})
    for along, across in ((180, 270), (270, 180)):
        held, plain = both(case, el_centro(records, along, across, 1, 0.4, 12.0))
        # The ends leave the other face now and then, and slip across by micrometres.
        assert held.slip == pytest.approx(plain.slip, rel=5e-3)


def test_neighbours_stop_it():
    case, shaking = case_of(crack={"side_gap": ["1 mm", "2 mm"]}), made(across=0.8)
    dam, free = shaken(case, shaking), shaken(case_of(), shaking).run(STEP).summary
    run = dam.run(STEP, 0.01)
    stopped = run.summary
    # The mean of nodes that each stop there, after the way that they make in a step.
    assert stopped.cross_slip_min >= -0.002 - 2e-4
    assert stopped.cross_slip_max <= 0.001 + 2e-4
    assert free.cross_slip_max > 0.001 or free.cross_slip_min < -0.002
    assert stopped.side_contacts > 0
    assert stopped.time_at_side > 0.0
    assert stopped.energy_residual < 1e-12
    assert stopped.contact_residual < 1e-8


def test_shaking_across_alone_walks_an_elastic_dam_downstream(records):
    shaking = el_centro(records, 180, 270, 1, 0.4, 12.0)
    run = shaken(case_of(), replace(shaking, horizontal=0.0 * shaking.horizontal)).run(STEP)
    assert run.summary.slip > 1e-3
    assert run.summary.energy_residual < 1e-12


def test_a_dam_at_rest_stays_until_the_ground_moves_across():
    shaking = made()
    late = Shaking(np.array([0.0, 1.0, 1.1, 1.2, 2.0]), np.zeros(5), cross=np.array([0.0, 0.0, 3.0, 0.0, 0.0]))
    run = shaken(case_of(), late).run(STEP, 0.01)
    before = run.frames.time <= 1.0
    assert (run.frames.slip[before] == run.frames.slip[0]).all()
    assert (run.frames.slip_cross[before] == 0.0).all()
    assert (run.crest_cross[: round(1.0 / STEP)] == 0.0).all()
    assert np.abs(run.crest_cross).max() > 1e-6
    assert shaking.end == 4.0


def test_a_crack_at_a_height_and_rock_follow_it():
    shaking = made(2.0)
    high = {"elevation": "40 m"}
    for more in ({"crack": high}, {"rock": {"modulus": "20 GPa"}}, {"crack": high, "rock": {"modulus": "20 GPa"}}):
        case = case_of(0.8, flexible={"elements_across": 2}, **more)
        run = shaken(case, shaking).run(STEP)
        assert run.summary.energy_residual < 1e-11, more
        assert run.summary.contact_residual < 1e-8, more
        assert run.summary.cross_slip != 0.0


@pytest.mark.parametrize("friction", [0.8, 1.2])
def test_a_part_that_rocks_under_faint_shaking_across_goes_as_with_one_component(friction):
    """The solver of one component leaves no contact out, however far it is open."""
    case, shaking = case_of(friction, crack={"elevation": "60 m"}), made(3.0)
    faint, alone = both(case, replace(shaking, cross=1e-9 * shaking.cross))
    assert 0.0 < abs(faint.cross_slip) < 1e-8
    assert min(alone.opening_upstream, alone.opening_downstream) > 5e-3
    for name in ("slip", "opening_upstream", "opening_downstream", "rotation_min", "rotation_max"):
        assert getattr(faint, name) == pytest.approx(getattr(alone, name), rel=1e-7), name


def test_a_strip_on_rock_answers_across_as_in_closed_form():
    base = np.column_stack([np.linspace(-40.0, 40.0, 17), np.zeros(17)])
    material = RockMaterial(20e9, 0.25, 2650.0)
    rock = reduced_rock(base, material, across=True)
    assert rock.shapes.shape[0] == 17
    for ratio, stiffness in ((0.25, 0.9615 + 0.6878j), (1.0, 1.0741 + 1.9817j), (4.0, 1.0136 + 7.9916j)):
        omega = ratio * material.shear_speed / 40.0
        if omega > 2.0 * math.pi * rock.highest:
            continue
        # A rigid strip: forces that move all nodes alike.
        compliance = rock.compliance(omega, np.eye(17))
        forces = np.linalg.solve(compliance, np.ones(17))
        assert abs(forces.sum() / material.shear - stiffness) < 0.03 * abs(stiffness), ratio
    assert smooth_tractions(base).shape == (34, 8)


def test_a_run_says_what_the_shaking_across_the_valley_adds():
    case = case_of(
        1.0,
        flexible={"elements_across": 2},
        motion={
            "file": "synthetic:M6.5,10km,seed=4",
            "pga": "0.5 g",
            "duration": "8 s",
            "sign": "recorded",
            "cross_valley": {"file": "synthetic:M6.5,10km,seed=5"},
        },
    )
    response = flexible(case)
    across = response.cross_valley
    without = across.without_cross_valley
    alone = flexible(case.with_({"motion.cross_valley": "none"}))
    assert alone.cross_valley is None
    assert without.residual_slip_m == pytest.approx(alone.residual_slip_m, rel=1e-9)
    assert without.factor == pytest.approx(response.residual_slip_m / alone.residual_slip_m, rel=1e-9)
    assert "Across the valley" in response.to_json()["verdict"] or abs(across.residual_slip_cross_m) < 1e-3
    histories = response.histories
    assert histories.slip_cross_m[-1] == pytest.approx(across.residual_slip_cross_m, abs=1e-12)
    assert histories.crest_cross_m.shape == histories.time_s.shape
    assert np.abs(histories.friction_cross_n).max() > 0.0
    assert across.slip_path_m >= abs(response.residual_slip_m)
    assert {"cross-valley-upright"} <= {notice.code for notice in response.warnings}


@pytest.mark.slow
def test_a_dam_whose_single_runs_scatter_is_compared_by_means():
    motion = {
        "file": "synthetic:M6.5,10km,seed=1",
        "pga": "1 g",
        "duration": "5 s",
        "sign": "recorded",
        "cross_valley": {"file": "synthetic:M6.5,10km,seed=5"},
    }
    case = case_of(
        crack={"elevation": "61 m"}, flexible={"elements_across": 2, "theta": 0.52, "evidence": "full"}, motion=motion
    )
    response = flexible(case)
    evidence, without = response.evidence, response.cross_valley.without_cross_valley
    assert evidence.scatters
    alone = case.with_({"motion.cross_valley": "none"})
    dam = shaken(alone, earthquake(alone).silent(response.silence_s).shaking)
    slips = [dam.run(evidence.varied_time_step_s, factor=scale).summary.slip for scale in evidence.scales]
    assert without.residual_slip_m == pytest.approx(np.mean(slips), rel=1e-3)
    assert without.factor == pytest.approx(evidence.residual_slip_m.value / np.mean(slips), rel=1e-3)
    assert response.cross_valley.residual_slip_cross_m == evidence.residual_slip_cross_m.value
    assert evidence.residual_slip_cross_m.value != evidence.residual_slip_cross_m.run
    text = across_sentence(response)
    assert "in the mean to the" in text
    assert "in the mean." in text


WEAKENING = {"name": "slip weakening", "peak_friction": 1.1, "residual_friction": 0.8, "slip": "40 mm"}
SPEED = {"name": "speed weakening", "peak_friction": 1.1, "residual_friction": 0.8, "speed": "0.3 m/s"}
STEP_UP = [["30 m", "0 m"], ["33 m", "1.5 m"]]
TOOTH = [["10 m", "-0.4 m"], ["14 m", "0.3 m"]]
BOND = {
    "tensile_strength": "0.2 MPa",
    "cohesion": "0.6 MPa",
    "fracture_energy": "200 N/m",
    "shear_energy": "1000 N/m",
}
DOWEL = {
    "distance": "40 m",
    "prestress": "2 MN/m",
    "axial_stiffness": "200 MN/m/m",
    "shear_stiffness": "100 MN/m/m",
    "inclination": "-15 deg",
}
THROUGH_BOTH = {
    "head_x": "6 m",
    "head_elevation": "60 m",
    "foot_x": "20 m",
    "foot_elevation": "-5 m",
    "prestress": "1 MN/m",
    "axial_stiffness": "100 MN/m/m",
    "shear_stiffness": "60 MN/m/m",
}
# Without friction where a law has it.
FURTHER = {
    "slip weakening": (None, {"crack": {"law": WEAKENING}}),
    "speed weakening": (None, {"crack": {"law": SPEED}}),
    "two cracks": (1.1, {"further_cracks": [{"elevation": "40 m", "friction": 0.9}]}),
    "two cracks with a law": (
        None,
        {"crack": {"law": WEAKENING}, "further_cracks": [{"elevation": "40 m", "law": SPEED}]},
    ),
    "neighbours without a gap": (0.9, {"crack": {"elevation": "40 m", "side_gap": "0 mm"}}),
    "a law between neighbours": (None, {"crack": {"law": WEAKENING, "side_gap": "2 mm"}}),
    "kinks": (0.9, {"crack": {"elevation": "20 m", "kinks": STEP_UP}}),
    "kinks with a law between neighbours": (
        None,
        {"crack": {"elevation": "20 m", "kinks": STEP_UP, "law": WEAKENING, "side_gap": "1 mm"}},
    ),
    "two cracks with kinks": (
        0.9,
        {
            "crack": {"elevation": "20 m", "kinks": STEP_UP},
            "further_cracks": [{"elevation": "50 m", "friction": 0.9, "kinks": TOOTH}],
        },
    ),
    "an anchor": (0.8, {"anchors": [DOWEL]}),
    "an anchor through two cracks": (
        1.0,
        {"further_cracks": [{"elevation": "40 m", "friction": 0.9}], "anchors": [THROUGH_BOTH]},
    ),
    "a joint": (1.0, {"crack": {"elevation": "20 m", "bond": BOND}}),
    "a joint between neighbours": (1.0, {"crack": {"bond": BOND, "side_gap": "1 mm"}}),
    "a joint above a crack with a law": (
        None,
        {
            "crack": {"elevation": "20 m", "law": WEAKENING},
            "further_cracks": [{"elevation": "50 m", "friction": 1.0, "bond": BOND}],
        },
    ),
}


def test_contacts_that_are_left_out_do_not_make_a_step_look_worse():
    """The residual is one over the impulse that would stop the fastest node, which is open where a part rocks."""
    law = {"name": "cohesion", "residual_friction": 1.3, "cohesion": "0.5 MPa", "slip": "20 mm"}
    case = case_of(None, crack={"elevation": "20 m", "kinks": STEP_UP, "law": law}, flexible={"contactors": 3})
    run = shaken(case, made(0.8, 647, 2.0, 1e-9)).run(5e-5)
    assert run.summary.contact_residual < 1e-6


@pytest.mark.parametrize("name", FURTHER)
def test_what_a_crack_may_have_besides_keeps_ledger_mirror_and_bits(name):
    friction, more = FURTHER[name]
    case, shaking = case_of(friction, **more), made(3.0)
    check(case.with_({"motion": CROSSED}), "flexible")
    one = shaken(case, shaking).run(STEP, 0.01)
    other = shaken(case, replace(shaking, cross=-shaking.cross)).run(STEP, 0.01)
    for run in (one, other):
        assert run.outcome == "ok"
        assert run.summary.energy_residual < 1e-11
        assert run.summary.contact_residual < 1e-8
        # Bonds that break make a little more, as with one component.
        allowed = 1e-2 * run.summary.energy_fracture if "joint" in name else 1e-6 * run.summary.energy_turnover
        assert run.summary.energy_gained <= allowed
    for here, there in zip(one.summaries, other.summaries, strict=True):
        assert here.slip == there.slip
        assert here.cross_slip == -there.cross_slip
        assert here.slip_path == there.slip_path
    assert max(abs(summary.slip) for summary in one.summaries) > 1e-3
    assert (one.crest_cross == -other.crest_cross).all()
    plain = shaken(case, shaking.along_stream()).run(STEP, 0.01)
    still = shaken(case, replace(shaking, cross=0.0 * shaking.cross)).run(STEP, 0.01)
    assert [item.by_name() for item in still.summaries] == [item.by_name() for item in plain.summaries]
    late = Shaking(np.array([0.0, 0.5, 0.6, 0.7, 1.0]), np.zeros(5), cross=np.array([0.0, 0.0, 3.0, 0.0, 0.0]))
    quiet = shaken(case, late).run(STEP, 0.01)
    before = quiet.frames.time <= 0.5
    assert all((frames.slip[before] == frames.slip[0]).all() for frames in quiet.all_frames)
    assert all((frames.slip_cross[before] == 0.0).all() for frames in quiet.all_frames)


@pytest.mark.parametrize(
    ("elevation", "law", "seed", "along", "across", "step", "rock"),
    # Ends of both faces that meet are held once; friction that has been nothing has no direction to go on in.
    [("20 m", WEAKENING, 641, 1.1, 0.8, 5e-4, True), ("60 m", SPEED, 452, 0.6, 0.7, 2e-3, False)],
)
def test_neighbours_without_a_gap_leave_nothing_unsolved(elevation, law, seed, along, across, step, rock):
    crack = {"elevation": elevation, "law": law, "side_gap": "0 mm"}
    more = {"rock": {"modulus": "20 GPa"}} if rock else {}
    case = case_of(None, crack=crack, flexible={"elements_across": 2}, **more)
    summary = shaken(case, made(1.5, seed, along, across)).run(step).summary
    assert all(math.isfinite(value) for value in summary.by_name().values())
    assert summary.contact_residual < 1e-8


def test_a_law_that_does_not_weaken_is_constant_friction():
    constant = shaken(case_of(0.9), made(3.0)).run(STEP).summary
    for law in (WEAKENING, SPEED):
        even = law | {"peak_friction": 0.9, "residual_friction": 0.9}
        run = shaken(case_of(None, crack={"law": even}), made(3.0)).run(STEP).summary
        assert [run.slip, run.cross_slip] == pytest.approx([constant.slip, constant.cross_slip], rel=1e-7)


@pytest.mark.parametrize(
    "law",
    [
        {"name": "barton-bandis", "jrc": 8.0, "jcs": "50 MPa", "residual_angle": "30 deg"},
        {"name": "cohesion", "residual_friction": 0.8, "cohesion": "0.1 MPa", "slip": "20 mm"},
    ],
    ids=["barton-bandis", "cohesion"],
)
def test_laws_that_bend_or_bond_go_over_into_those_of_one_component(law):
    case, shaking = case_of(None, crack={"law": law}), made(3.0)
    alone, faint, whole = (
        shaken(case, replace(shaking, cross=factor * shaking.cross)).run(STEP).summary for factor in (0.0, 1e-9, 1.0)
    )
    assert faint.slip == pytest.approx(alone.slip, rel=1e-8)
    assert 0.0 < abs(faint.cross_slip) < 1e-8
    assert abs(whole.slip) > abs(alone.slip) > 1e-3
    for summary in (faint, whole):
        assert summary.energy_residual < 1e-11
        assert summary.contact_residual < 1e-8


@pytest.mark.parametrize("law", [WEAKENING, SPEED], ids=["slip weakening", "speed weakening"])
def test_a_stiff_dam_with_a_law_is_the_rigid_block(law):
    stiff = {"density": "2650 kg/m^3", "modulus": "20000 GPa", "poisson": 0.143, "damping": 0.05}
    # Stronger shaking lifts the block, which then ends without a result.
    motion = CROSSED | {"pga": "0.75 g"}
    case = case_of(None, crack={"law": law}, concrete=stiff, motion=motion)
    block = rigid(case)
    assert block.ok
    motions = resolve_all(case)
    shaking = Shaking(motions[0].time, motions[0].acceleration, cross=motions[2].acceleration)
    run = shaken(case, shaking).run(1e-4)
    # With one component, too, the elastic dam slides up to a millimetre more than the block.
    assert run.summary.slip == pytest.approx(block.residual_slip_m, abs=1.5e-3)
    assert run.summary.cross_slip == pytest.approx(block.cross_valley.residual_slip_cross_m, abs=1e-4)
    assert run.summary.cross_slip_path == pytest.approx(block.friction_law.slip_path_m, abs=1.5e-3)


def test_an_aftershock_goes_on_where_the_first_motion_ends():
    case = case_of(
        0.8,
        flexible={"elements_across": 2},
        analysis={"silence": "0 s"},
        motion=CROSSED,
        aftershocks=[{"points": points(2, 0.6), "pause": "2 s", "cross_valley": {"points": points(4, 0.5)}}],
    )
    response = flexible(case)
    alone = flexible(case.with_({"aftershocks": []}))
    assert response.ok
    histories = response.histories
    there = histories.time_s <= alone.histories.time_s[-1] + 1e-9
    assert histories.slip_m[there] == pytest.approx(alone.histories.slip_m, abs=1e-9)
    assert histories.slip_cross_m[there] == pytest.approx(alone.histories.slip_cross_m, abs=1e-9)
    assert abs(response.cross_valley.residual_slip_cross_m - alone.cross_valley.residual_slip_cross_m) > 1e-4
    assert len(response.sequence) == 2


def test_what_is_not_built_is_refused():
    motion = {"points": [["0 s", "0 g"], ["1 s", "0.1 g"]]}
    shaken_across = {"motion": motion | {"cross_valley": motion}}
    for more in (
        {"flexible": {"contact": "idce", "damping": "stiffness"}},
        {"flexible": {"contactors": 5}},
        {"further_cracks": [{"elevation": "40 m", "friction": 0.8}], "crack": {"side_gap": "3 mm"}},
    ):
        with pytest.raises(InputError, match=r"shaking across the valley|neighbours"):
            check(case_of(**more, **shaken_across), "flexible")


@pytest.mark.parametrize("count", [6, pytest.param(100, marks=pytest.mark.slow)])
def test_random_dams_close_their_books(count):
    rng = np.random.default_rng(52)
    checked = 0
    while checked < count:
        drawn = draw(rng)
        if not drawn.ordinary or drawn.case.flexible.contactors == 5:
            continue
        checked += 1
        across = across_dam(drawn.case, drawn.dam)
        gap = [(math.inf, math.inf), (0.001, 0.003)][checked % 2]
        kernel = drawn.dam.kernel.crossed(across.parts, gap)
        side = np.ascontiguousarray(rng.permutation(drawn.ground[:, 0].reshape(-1, 1))[:, 0])
        run = kernel.run(drawn.ground, drawn.step, drawn.case.flexible.theta, across=side)
        summary = run.summary
        assert all(math.isfinite(value) for value in summary.by_name().values()), checked
        assert summary.energy_residual <= 10.0 * drawn.residual_allowed(run), checked
        assert summary.contact_residual < 1e-6, checked
        assert summary.energy_gained <= 1e-3 * summary.energy_turnover, checked
