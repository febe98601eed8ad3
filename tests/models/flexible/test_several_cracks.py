"""Several cracks: each alone where the others are bonded, ledger, mirror and scale, and two stiff blocks."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from heeltoe.case.model import Case
from heeltoe.models.flexible.body import bonded as bonded_module
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.mesh.dam import DamMesh, _body, dam_mesh, graded_cracks
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake, flexible
from shared.dams import plane_case
from shared.two_cracks import DAM, PULSES, STEP, bonded, same, shaken


def joined(case: Case) -> DamMesh:
    """Return the mesh of a dam with two cracks as that of one with the lower crack alone."""
    upper, lower = dam_mesh(case, graded_cracks(case)).parts
    faces = dict(zip(upper.faces[-1].tolist(), lower.faces[0].tolist(), strict=True))
    count = len(lower.nodes)
    renumbered = np.array([faces.get(node, count + node) for node in range(len(upper.nodes))])
    elements = np.vstack([lower.elements, renumbered[upper.elements]])
    nodes = np.vstack([lower.nodes, upper.nodes])
    used, places = np.unique(elements, return_inverse=True)
    return DamMesh((_body(nodes[used], places.reshape(elements.shape), case.cut, "joined", above=True),), None)


def test_the_neck_alone_where_the_base_is_bonded():
    case = plane_case(DAM)
    two = shaken(bonded(case, 0.0))
    alone = shaken(case.single_crack_cases[0])
    assert abs(alone.summary.slip) > 1e-3
    same(two.all_frames[0], alone.frames, 8.0)
    assert np.abs(two.all_frames[1].slip).max() < 1e-8


def test_the_base_alone_where_the_neck_is_bonded(monkeypatch):
    case = plane_case(DAM)
    two = shaken(bonded(case, 90.0))
    monkeypatch.setattr(bonded_module, "dam_mesh", lambda *_: joined(case))
    # Another damping, by rounding, so that no dam of another mesh is found.
    alone = shaken(
        case.single_crack_cases[1].model_copy(
            update={"concrete": case.concrete.model_copy(update={"damping": 0.05 + 1e-15})}
        )
    )
    assert abs(alone.summary.slip) > 1e-3
    same(two.all_frames[1], alone.frames, 80.0)
    assert np.abs(two.all_frames[0].slip).max() < 1e-8


def test_three_cracks_are_two_where_the_middle_one_is_bonded():
    fields = DAM | {"crack": {"elevation": "12 m", "friction": 0.7}}
    fields["further_cracks"] = [{"elevation": "90 m", "friction": 0.8}, {"elevation": "40 m", "friction": 1.0}]
    case = plane_case(fields)
    three = shaken(bonded(case, 12.0))
    two = shaken(bonded(bonded(case, 12.0), 40.0))
    assert [len(item.all_frames) for item in (three, two)] == [3, 3]
    assert np.abs(three.all_frames[2].slip).max() < 1e-8
    alone = shaken(case.single_crack_cases[0])
    largest = np.abs(alone.frames.slip).max()
    # Rows of elements lie elsewhere, and the damping is that of other modes.
    assert two.all_frames[0].slip == pytest.approx(alone.frames.slip, abs=0.1 * largest)


@pytest.fixture(scope="module")
def free() -> Case:
    return plane_case(DAM | {"flexible": {"elements_across": 4, "evidence": "none"}})


def test_the_ledger_closes_and_says_what_each_crack_has_lost(free):
    run = shaken(free)
    assert all(abs(summary.slip) > 1e-3 for summary in run.summaries)
    for item in run.summaries:
        assert item.energy_residual < 1e-12
        assert item.energy_gained < 1e-9 * item.energy_turnover
        assert item.contact_residual < 1e-9
    for whole, own in (("energy_friction", "crack_friction"), ("energy_impact", "crack_impact")):
        parts = [getattr(summary, own) for summary in run.summaries]
        assert sum(parts) == pytest.approx(getattr(run.summary, whole), rel=1e-9)
        assert min(parts) > 0.0


def test_without_an_earthquake_nothing_moves(free):
    still = free.with_({"motion": {"points": [["0 s", "0 g"], ["1 s", "0 g"]], "allow_zero": True, "duration": None}})
    run = shaken(still)
    assert [summary.slip_max - summary.slip_min for summary in run.summaries] == [0.0, 0.0]


def test_twice_the_density_and_stiffness_change_nothing(free):
    heavy = free.with_(
        {"concrete.density": "5300 kg/m^3", "concrete.modulus": "40 GPa", "reservoir.density": "2000 kg/m^3"}
    )
    for one, other in zip(shaken(free).all_frames, shaken(heavy).all_frames, strict=True):
        assert one.slip == pytest.approx(other.slip, abs=1e-9)


def test_a_mirrored_dam_slides_the_other_way(free):
    corners = np.array(free.section.vertices())
    mirrored = [[f"{-x} m", f"{z} m"] for x, z in corners[::-1]]
    image = free.with_(
        {
            "section": {**dict.fromkeys(free.section.model_fields_set), "polygon": mirrored},
            "reservoir": None,
            "tailwater": {"depth": "100 m", "compressible": False},
            "motion.reverse": True,
        }
    )
    for one, other in zip(shaken(free).all_frames, shaken(image).all_frames, strict=True):
        assert one.slip == pytest.approx(-other.slip, abs=1e-6)
        assert one.gap_heel == pytest.approx(other.gap_toe, abs=1e-6)


def test_a_run_has_the_same_bits_with_any_number_of_threads(free):
    dam = ShakenDam(free, build_flexible_dam(free), earthquake(free).shaking)
    one, two = (dam.run_scaled_cracks(STEP, np.array([0.9, 1.0, 1.1]), threads=threads) for threads in (1, 2))
    whole = dam.run(STEP)
    for each, other, run in zip(one, two, whole.summaries, strict=True):
        assert each["slip"].tobytes() == other["slip"].tobytes()
        assert each["slip"][1] == run.slip


def two_blocks(time, ground, masses, friction, gravity=9.80665):
    """Slide two rigid blocks, one on the other on the ground, by small steps: an independent program.

    Each contact sticks where its friction can hold what is on it, else it slips; slips are those of the upper block on
    the lower one, and of the lower one on the ground.
    """
    step = time[1] - time[0]
    upper, lower = masses
    limits = friction[0] * upper * gravity, friction[1] * (upper + lower) * gravity
    velocity, slip, history = np.zeros(2), np.zeros(2), []
    for a in ground:
        # Impulses of friction on the upper block by the lower, and on the lower by the ground, by sweeps.
        impulse = np.zeros(2)
        free = velocity - step * a
        for _ in range(60):
            before = impulse.copy()
            for k in (0, 1):
                moved = free + np.array([impulse[0] / upper, (impulse[1] - impulse[0]) / lower])
                relative, answer = (
                    (moved[0] - moved[1], 1.0 / upper + 1.0 / lower) if k == 0 else (moved[1], 1.0 / lower)
                )
                impulse[k] = np.clip(impulse[k] - relative / answer, -step * limits[k], step * limits[k])
            if np.abs(impulse - before).max() < 1e-12:
                break
        velocity = free + np.array([impulse[0] / upper, (impulse[1] - impulse[0]) / lower])
        slip = slip + step * np.array([velocity[0] - velocity[1], velocity[1]])
        history.append(slip)
    return np.array(history)


def test_two_stiff_blocks_slide_as_rigid_ones():
    points = [
        ["0 s", "0 g"],
        *([f"{t:.3f} s", f"{0.5 * np.sin(2.0 * np.pi * 2.0 * t):.6f} g"] for t in np.arange(1, 61) / 100),
    ]
    case = plane_case(
        {
            "section": {"polygon": [["0 m", "0 m"], ["16 m", "0 m"], ["16 m", "3 m"], ["0 m", "3 m"]]},
            "concrete": {"density": "2500 kg/m^3", "modulus": "20000 GPa", "poisson": 0.2},
            "crack": {"elevation": "0 m", "friction": 0.3},
            "further_cracks": [{"elevation": "2 m", "friction": 0.2}],
            "uplift": {"pattern": "none"},
            "motion": {"points": points, "duration": "0.6 s"},
            "analysis": {"silence": "0 s"},
            "flexible": {"elements_across": 4, "evidence": "none", "time_step": "0.05 ms"},
        }
    )
    response = flexible(case)
    step = 3e-5
    time = np.arange(20_000) * step
    shaking = earthquake(case).shaking
    ground = np.interp(time + step / 2.0, shaking.time, shaking.horizontal)
    slips = two_blocks(time, ground, (2500.0 * 16.0, 2500.0 * 32.0), (0.2, 0.3))
    for place in (0, 1):
        slip_m = response.cracks[place].histories["slip_m"]
        expected = np.interp(response.histories["time_s"], time + step, slips[:, place])
        largest = np.abs(expected).max()
        assert largest > 5e-3
        assert slip_m == pytest.approx(expected, abs=0.02 * largest)


def test_a_response_has_every_crack(free):
    case = free.with_({"limits.residual_slip": "0.1 mm"})
    response = flexible(case)
    answer = response.to_json()
    assert [item["elevation_m"] for item in answer["cracks"]] == [90.0, 0.0]
    assert answer["residual_slip_m"] == answer["cracks"][1]["residual_slip_m"]
    slips = [abs(item["residual_slip_m"]) for item in answer["cracks"]]
    assert answer["governing_crack"] == slips.index(max(slips))
    assert response.limits[0].value == max(slips)
    assert response.limits[0].elevation_m == [90.0, 0.0][answer["governing_crack"]]
    neck = response.others["crack-1"]
    assert neck.residual_slip_m == answer["cracks"][0]["residual_slip_m"]
    assert neck.crack.force.shape[2] == neck.crack.upper_position.shape[2] == 9
    assert neck.crack.status.shape[1] == 11
    assert response.crack.lower_position is None
    forces = neck.crack.forces()[:, 1].sum(axis=1)
    assert forces[1:] == pytest.approx(neck.histories["normal_force_n"][1:], rel=1e-9, abs=1.0)
    # The weight of what is above each crack, less the uplift, before the earthquake.
    for place, crack in enumerate(response.cracks):
        alone = case.single_crack_cases[place]
        weight = 2650.0 * 9.80665 * alone.cut.area
        head = 100.0 - alone.crack.elevation
        lift = 1000.0 * 9.80665 * head * alone.cut.crack_width / 2.0
        assert crack.frames.forces()[0, 1].sum() == pytest.approx(weight - lift, rel=1e-6)


def test_evidence_is_that_of_every_crack(free):
    case = free.with_({"flexible.evidence": "full"})
    response = flexible(case)
    evidences = [item["evidence"] for item in response.cracks]
    assert all(
        evidence["asked"] == "full" and evidence["residual_slip_m"]["mesh"] is not None for evidence in evidences
    )
    codes = [warning.name for warning in response.warnings]
    worse = [evidence for evidence in evidences[:1] if not evidence["converged"]]
    assert codes.count("not-converged further-crack") == len(worse)
    weak = dataclasses.replace(response, title="")
    assert weak.at_crack(0).summary["evidence"] == evidences[0]


@pytest.mark.slow
def test_each_motion_of_a_sequence_is_told_of_every_crack(free):
    again = {"points": [[time, f"{0.8 * float(a.split()[0]):g} g"] for time, a in PULSES], "pause": "1 s"}
    free = free.with_({"flexible.time_step": "0.1 ms", "motion.duration": "2 s"})
    alone, twice = flexible(free), flexible(free.with_({"aftershocks": [again], "motion.duration": "1 s"}))
    assert [item["elevation_m"] for item in twice.to_json()["cracks"]] == [90.0, 0.0]
    for place, answer in enumerate(twice.to_json()["cracks"]):
        first, second = answer["sequence"]
        # Until the next motion begins the dam does what it does alone; peaks are those of histories, between moments.
        assert first["peak_slip_downstream_m"] == pytest.approx(alone.cracks[place].peak_slip_downstream_m, rel=1e-3)
        assert first["slip_m"] + second["slip_m"] == pytest.approx(answer["residual_slip_m"], abs=1e-12)
        assert first["slip_m"] > 1e-4
        assert first["static"]["ok"] in (True, False)
        assert [item.to_json() for item in twice.at_crack(place).sequence] == answer["sequence"]
    assert [item.to_json() for item in twice.sequence] == twice.to_json()["cracks"][1]["sequence"]
    # Drains keep what they have: what the slip closes is said of the crack that has it.
    drained = {"uplift.pattern": "drained", "uplift.drain_position": 0.1, "uplift.drain_efficiency": 0.6}
    wet = free.with_({"aftershocks": [again], "motion.duration": "1 s", "statics.drain_diameter": "20 mm", **drained})
    warnings = [warning for warning in flexible(wet).warnings if warning.name == "sequence-drains"]
    assert any("at the crack at" in str(item) for item in warnings)


#: The typical dam of examples/two-cracks.toml with 12 s of its record. Its neck slides at a friction of 0.7, and tips
#: before it slides at 1.0: what is above it is 8 m wide and 10 m high.
EXAMPLE = ("motion.duration=12s", "analysis.silence=0s")


def ensemble(friction: float, across: int, step: float):
    """Return the slips of both cracks, from the crest down, with the shaking varied by up to 1 %, in mm."""
    given = plane_case("examples/two-cracks.toml", (*EXAMPLE, f"flexible.elements_across={across}"))
    neck = given.further_cracks[0].model_copy(update={"friction": friction})
    case = given.model_copy(update={"further_cracks": (neck,)})
    dam = ShakenDam(case, build_flexible_dam(case), earthquake(case).shaking)
    runs = dam.run_scaled_cracks(step, np.array([0.99, 0.995, 1.0, 1.005, 1.01]))
    return np.array([1e3 * item["slip"] for item in runs])


@pytest.mark.slow
def test_two_sliding_cracks_converge_with_step_and_mesh():
    """The table of docs/several-cracks.md."""
    usual = ensemble(0.7, 8, 1.4e-4)
    finer = [ensemble(0.7, 8, 7e-5), ensemble(0.7, 16, 1.4e-4)]
    for result in (usual, *finer):
        assert result.mean(axis=1) == pytest.approx(usual.mean(axis=1), rel=0.03)
        assert (np.ptp(result, axis=1) < 0.08 * result.mean(axis=1)).all()
    # A neck that tips strikes as it comes down, and what it does then is decided by a hundredth of the shaking.
    rocking = ensemble(1.0, 8, 1.4e-4)
    assert np.ptp(rocking[0]) > 0.3 * rocking[0].mean()
