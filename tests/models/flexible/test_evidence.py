"""What a result is worth: other runs beside it, what is said of them, and when the program refines by itself."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import InputError, flexible, read_case, run
from heeltoe.models.flexible import model
from heeltoe.models.flexible.body import reduced
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.evidence import refinement
from heeltoe.models.flexible.evidence.refinement import _finer, _moved_by_mesh, answer, build_ahead
from heeltoe.models.flexible.evidence.trials import SCALES, Level, Trials, scales_of
from heeltoe.models.flexible.run.dam_runner import ShakenDam, short_step
from heeltoe.models.flexible.run.expected import with_mesh
from heeltoe.models.run import earthquake
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.contract import RESIDUAL_SLIP
from shared.dams import example, plane_case
from shared.evidence import evidence_of

FIELDS = {
    "section": {"height": "30 m", "crest_width": "4 m", "base_width": "24 m"},
    "concrete": {"modulus": "20 GPa"},
    "crack": {"friction": 0.7},
    "reservoir": {"depth": "24 m"},
    # Other runs beside it are of the same length.
    "analysis": {"silence": "0 s"},
}
# Where a crack has corners [of its length].
FIVE = (0.15, 0.3, 0.45, 0.6, 0.75)
TIME = np.linspace(0.0, 2.0, 201)
MOTION = GroundMotion.from_points(TIME, 5.0 * np.sin(2.0 * np.pi * 2.0 * TIME))


def dam(**options):
    return plane_case(FIELDS | {"flexible": options})


def slip(scale=1.0, **options):
    motion = GroundMotion.from_points(TIME, scale * MOTION.acceleration)
    return flexible(dam(evidence="none", **options), motion).residual_slip_m


def test_each_part_is_the_difference_of_two_runs_of_ones_own():
    response = flexible(dam(elements_across=6), MOTION)
    evidence = response.evidence
    # As it is asked for: each run makes it fit its duration.
    step = evidence["time_step_s"]
    assert response.residual_slip_m > 0.01
    meshes = [evidence[f"{which}elements_across"] for which in ("", "other_", "third_")]
    assert meshes == [6, 3, 2]
    assert evidence["other_time_step_s"] == pytest.approx(2.0 * step)
    assert evidence["value_is"] == "run"
    worth = evidence["residual_slip_m"]
    assert worth["value"] == response.residual_slip_m == slip(elements_across=6)
    longer = f"{2.0 * step} s"
    other = slip(elements_across=6, time_step=longer)
    assert worth["step"] == pytest.approx(abs(worth["value"] - other), abs=1e-12)
    coarse, coarser = (slip(elements_across=across, time_step=longer) for across in (3, 2))
    assert worth["mesh"] == pytest.approx(max(abs(other - coarse), 0.25 * abs(coarse - coarser)), abs=1e-12)
    members = [slip(scale, elements_across=3, time_step=longer) for scale in SCALES]
    assert evidence["residual_slips_m"] == pytest.approx(members, abs=1e-12)
    assert worth["shaking"] == pytest.approx(np.std(members, ddof=1), abs=1e-12)
    assert worth["uncertainty"] == pytest.approx(worth["step"] + worth["mesh"] + worth["shaking"])
    assert evidence["runs"] == 8


def test_two_meshes_that_agree_better_than_their_order_promises_are_not_believed():
    def moved(*slips):
        own, beside, third = ({"slip": np.array([item])} for item in slips)
        return _moved_by_mesh("slip", own, beside, third)

    assert moved(1.0, 1.001, 1.4) == pytest.approx(0.25 * 0.399)
    # These converge no better than they may.
    assert moved(1.0, 1.1, 1.4) == pytest.approx(0.1)


def test_a_result_is_the_same_whatever_is_compared_with_it():
    slips = {item: flexible(dam(elements_across=2), MOTION, evidence=item) for item in ("none", "step", "full")}
    assert len({item.residual_slip_m for item in slips.values()}) == 1
    assert slips["none"].evidence is None
    assert slips["step"].evidence["residual_slip_m"]["mesh"] is None
    assert slips["step"].evidence["runs"] == 2
    # Two elements have no coarser mesh worth a comparison.
    assert slips["full"].evidence["other_elements_across"] == 4


def test_evidence_that_there_is_none_is_refused():
    with pytest.raises(InputError) as caught:
        flexible(dam(), MOTION, evidence="some")
    assert caught.value.code == "not-a-choice"
    with pytest.raises(InputError, match=r"flexible\.evidence"):
        dam(evidence="some")


@pytest.mark.parametrize(
    ("moved", "given", "finer"),
    [
        ((0.001, 0.002, 0.003), {}, None),
        ((0.001, 0.02, 0.003), {}, Level(1, 0)),
        ((0.02, 0.001, 0.003), {}, Level(0, 1)),
        # Nothing is to be had where the shaking moves it most, or where step and mesh are the case's own.
        ((0.001, 0.002, 0.009), {}, None),
        ((0.001, 0.02, 0.03), {}, None),
        ((0.001, 0.02, 0.003), {"elements_across": 8}, None),
        ((0.02, 0.001, 0.003), {"time_step": "0.1 ms"}, None),
    ],
)
def test_what_is_refined(moved, given, finer):
    assert _finer(evidence_of(moved), Level(0, 0), dam(**given).flexible) == finer


def test_a_mesh_that_lowers_the_strength_of_a_joint_is_refined_whatever_moves_its_slip():
    moved = (0.001, 0.002, 0.03)
    for given, finer in (({}, Level(1, 0)), ({"elements_across": 8}, None)):
        assert _finer(evidence_of(moved), Level(0, 0), dam(**given).flexible, lowered=True) == finer
    assert _finer(evidence_of((0.001, 0.002, 0.003)), Level(0, 0), dam().flexible, lowered=True) is None


def test_other_meshes_of_a_case():
    case = dam(elements_across=5, elements_across_below=8)
    assert [with_mesh(case, mesh).flexible.elements_across for mesh in (-1, 0, 1, 2)] == [3, 5, 10, 20]
    assert [with_mesh(case, mesh).flexible.elements_across_below for mesh in (-1, 1)] == [4, 16]


# Factors of a sample that a test can run through.
NINE = (0.99, 0.9925, 0.995, 0.9975, 1.0, 1.0025, 1.005, 1.0075, 1.01)


def error_of(numbers):
    return np.std(numbers, ddof=1) / np.sqrt(len(numbers))


@pytest.mark.parametrize(("scatters", "times"), [(True, 0.5), (False, 1.0)])
def test_a_longer_step_that_moves_the_slip_is_taken_back(monkeypatch, scatters, times):
    case = dam(elements_across=4)
    shaken = ShakenDam(case, build_flexible_dam(case), Earthquake(MOTION, None, 1.0).shaking)
    longest, asked = shaken.first_step(), []
    assert longest == pytest.approx(2.0 * short_step(case, shaken._period()), rel=0.1)

    def scatter(slips, step):
        asked.append(step)
        # With the shorter one they do not.
        return scatters and len(asked) == 1

    monkeypatch.setattr(refinement, "_scatter", scatter)
    evidence = answer(shaken, 0.01, "full").evidence
    assert (evidence.time_step_s, evidence.value_is) == (pytest.approx(times * longest), "run")
    stated = dam(elements_across=4, time_step=f"{longest} s")
    assert ShakenDam(stated, shaken.dam, shaken.shaking).halvings == 0


def test_a_shorter_step_that_costs_too_much_is_left_out(monkeypatch):
    monkeypatch.setattr(refinement, "_scatter", lambda slips, step: True)
    monkeypatch.setattr(refinement, "BUDGET", 2.0)
    case = dam(elements_across=4)
    shaken = ShakenDam(case, build_flexible_dam(case), Earthquake(MOTION, None, 1.0).shaking)
    evidence = answer(shaken, 0.01, "full").evidence
    assert (evidence.time_step_s, evidence.budget_spent) == (shaken.first_step(), True)
    assert evidence.work <= 2.0


@pytest.mark.parametrize("finest", [4, 8])
def test_where_runs_scatter_the_numbers_are_means(monkeypatch, finest):
    monkeypatch.setattr(refinement, "_scatter", lambda slips, step: True)
    monkeypatch.setattr(refinement, "scales_of", lambda doublings: NINE)
    response = flexible(dam(elements_across=finest), MOTION)
    evidence = response.evidence
    step = evidence["time_step_s"]

    def slips(scales, across, times):
        return np.array([slip(s, elements_across=across, time_step=f"{times * step} s") for s in scales])

    def moved(scales, one, other, times=1.0):
        changes = other - one[[NINE.index(scale) for scale in scales]]
        by_pairs = (error_of(changes), abs(np.mean(changes)))
        by_means = (np.hypot(error_of(one), error_of(other)), abs(np.mean(other) - np.mean(one)))
        error, known = min(by_pairs, by_means)
        return max(error, known, times * (known - error))

    members, coarse = slips(NINE, finest, 2.0), slips(NINE, finest // 2, 2.0)
    worth = evidence["residual_slip_m"]
    assert evidence["value_is"] == "mean"
    assert evidence["scales"] == list(NINE)
    assert evidence["varied_elements_across"] == finest
    assert evidence["varied_time_step_s"] == pytest.approx(2.0 * step)
    assert evidence["residual_slips_m"] == worth["distribution"]["numbers"] == pytest.approx(members, abs=1e-12)
    assert response.residual_slip_m == worth["value"] == pytest.approx(np.mean(members), abs=1e-12)
    assert worth["spread"] == pytest.approx(np.std(members, ddof=1), abs=1e-12)
    assert worth["shaking"] == pytest.approx(error_of(members), abs=1e-12)
    # Half the step leaves half of the error, the finer of two meshes a quarter at best.
    assert worth["step"] == pytest.approx(moved(SCALES, members, slips(SCALES, finest, 1.0), 2.0), abs=1e-12)
    third = moved(NINE, coarse, slips(NINE, 2, 2.0)) if finest == 8 else 0.0
    assert worth["mesh"] == pytest.approx(max(moved(NINE, members, coarse), 0.25 * third), abs=1e-12)
    parts = [worth[name] for name in ("step", "mesh", "shaking")]
    assert worth["uncertainty"] == pytest.approx(max(np.linalg.norm(parts), 0.03 * worth["value"]))
    assert worth["run"] == pytest.approx(response.histories["slip_m"][-1], abs=1e-12) != worth["value"]
    assert any("single runs scatter" in str(warning) for warning in response.warnings)
    assert "numerically ±" in response.to_json()["verdict"]


# Means over five factors on the shaking on 4, 8 and 16 even elements across, each run with a standard deviation of
# some 130 mm; and over nine on 8 graded elements at half and a quarter of the step and on 16 at both, with 30 mm. The
# second earthquake slides farther by two fifths on 4 elements.
@pytest.mark.slow
@pytest.mark.parametrize(
    ("way", "others", "spread", "runs"),
    [("reversed", [656.0, 563.0, 647.0], 130.0, 15), ("as recorded", [288.8, 286.8, 309.1, 291.2], 30.0, 36)],
)
def test_the_mean_of_a_dam_that_strikes_and_drifts_is_that_of_other_meshes(way, others, spread, runs):
    case = example("koyna-top")
    motion = earthquake(case)
    motion = motion.reversed() if way == "reversed" else motion
    evidence = answer(ShakenDam(case, build_flexible_dam(case), motion.shaking), 0.1, "full").evidence
    worth = evidence.residual_slip_m
    assert evidence.value_is == "mean"
    assert len(evidence.scales) >= 17
    assert worth.shaking <= 0.035 * worth.value
    assert abs(worth.value - 1e-3 * np.mean(others)) <= np.hypot(worth.uncertainty, 1e-3 * spread / np.sqrt(runs))
    assert worth.distribution.fractile_16 < worth.value < worth.distribution.fractile_84
    # One deviation of 17 runs and 36 is twice the other once in a thousand times (F-distribution).
    assert 0.5 < worth.spread / (1e-3 * spread) < 2.0


@pytest.mark.parametrize("scatters", [True, False])
def test_less_friction_is_tried_where_single_runs_say_something(monkeypatch, scatters):
    monkeypatch.setattr(refinement, "_scatter", lambda slips, step: scatters)
    monkeypatch.setattr(refinement, "scales_of", lambda doublings: NINE)
    case = plane_case(FIELDS | {"flexible": {"elements_across": 2}})
    response = run(case, motion=MOTION)
    assert response.evidence["value_is"] == ("mean" if scatters else "run")
    assert (response.friction_effect is None) == scatters


def sample(slips, scales, *, fails=()):
    """Return runs that slide as far as `slips` says of a factor."""
    good = np.array([scale not in fails for scale in scales])
    numbers = {RESIDUAL_SLIP.key: np.array([slips(scale) for scale in scales])}
    return refinement._Sample(Level(-1, -1), tuple(scales), numbers, good)


def test_pairs_tell_the_difference_of_two_levels_below_the_scatter_of_either():
    """By hand: slips that go up and down by 0.1 m with the shaking alike on both, 4 mm farther on the one; and one that
    differs by 1, -1, 1, -1 mm, whose mean of nothing has a standard error of 1.155/2 mm."""
    scatter = {scale: 0.5 + 0.1 * (-1.0) ** place for place, scale in enumerate(NINE)}
    own = sample(lambda scale: scatter[scale], NINE)
    farther = sample(lambda scale: scatter[scale] + 0.004, NINE[::4])
    assert own.moved(RESIDUAL_SLIP.key, farther) == pytest.approx(0.004)
    # Where half of the error is left there, it is twice the difference.
    assert own.moved(RESIDUAL_SLIP.key, farther, 0.5) == pytest.approx(0.008)
    jump = dict(zip(NINE[1:5], (1e-3, -1e-3, 1e-3, -1e-3), strict=True))
    other = sample(lambda scale: scatter[scale] + jump[scale], NINE[1:5])
    for left in (0.0, 0.5):
        assert own.moved(RESIDUAL_SLIP.key, other, left) == pytest.approx(1e-3 * np.sqrt(4.0 / 3.0) / 2.0)
    # Too little is left to compare.
    lost = sample(lambda scale: scatter[scale], NINE[:4], fails=NINE[:3])
    assert own.moved(RESIDUAL_SLIP.key, lost) is None


def test_two_means_tell_more_than_pairs_where_each_level_scatters_by_itself():
    """By hand: a level goes up by 0.1 m where the other goes down, each from a mean that is 30 mm farther. Eight pairs
    have a standard error of 0.0756 m, twice that of each of the two means."""
    up = dict(zip(NINE, [0.1, -0.1] * 4 + [0.0], strict=True))
    own = sample(lambda scale: 0.5 + up[scale], NINE)
    other = sample(lambda scale: 0.53 - up[scale], NINE[:8])
    error = np.hypot(np.sqrt(0.08 / 8.0 / 9.0), np.sqrt(0.08 / 7.0 / 8.0))
    assert own.moved(RESIDUAL_SLIP.key, other) == pytest.approx(max(0.03, error))


def test_runs_without_a_result_are_counted_and_have_no_part_in_a_mean():
    slips = sample(lambda scale: 0.3 if scale < 1.0 else 0.5, NINE, fails=(1.01,))
    assert slips.values(RESIDUAL_SLIP.key) == [0.3] * 4 + [0.5] * 4 + [None]
    assert slips.known(RESIDUAL_SLIP.key).mean() == pytest.approx(0.4)


@pytest.mark.parametrize(
    ("deviation", "enough"),
    # 3 % of 0.4 m by 8 deviations.
    [(0.095, True), (0.097, False)],
)
def test_a_mean_is_known_where_its_standard_error_is_three_per_cent(deviation, enough):
    scales = scales_of(2)
    # Half of them above and half below, but for the middle one.
    way = np.array([*([1.0, -1.0] * 32), 0.0])
    size = deviation * np.sqrt(65.0 / 64.0) * way
    numbers = dict(zip(scales, 0.4 + size, strict=True))
    mean = sample(lambda scale: numbers[scale], scales)
    assert mean.known(RESIDUAL_SLIP.key).mean() == pytest.approx(0.4)
    assert mean.error(RESIDUAL_SLIP.key) == pytest.approx(deviation / 8.0, rel=0.01)
    assert mean.is_enough is enough


def test_samples_grow_by_runs_between_those_that_are_there():
    first, second = scales_of(0), scales_of(1)
    assert (len(first), len(second)) == (17, 33)
    assert second[::2] == first
    assert set(SCALES) <= set(first)
    assert (first[0], first[-1]) == (0.99, 1.01)


def test_kinks_that_fewer_elements_cannot_follow_are_compared_with_more():
    kinks = [[f"{20.0 * share} m", f"{0.2 * (1 + place % 2)} m"] for place, share in enumerate(FIVE)]
    crack = {"elevation": "6 m", "friction": 0.7, "kinks": kinks}
    case = plane_case(FIELDS | {"crack": crack, "flexible": {"elements_across": 8}})
    evidence = flexible(case, MOTION).evidence
    assert (evidence["elements_across"], evidence["other_elements_across"]) == (8, 16)


@pytest.mark.parametrize(
    ("slips", "step", "scatters"),
    [
        # On a line, whatever its slope.
        ([0.300, 0.280, 0.290, 0.310, 0.320], 0.001, False),
        ([0.300, 0.300, 0.280, 0.310, 0.300], 0.001, True),
        ([0.300, 0.280, 0.290, 0.310, 0.320], 0.004, True),
        # Less than anybody would refine for.
        ([1e-4, 3e-4, 1e-4, 2e-4, 2e-4], 5e-5, False),
    ],
)
def test_what_is_scatter(slips, step, scatters):
    assert refinement._scatter(np.array(slips), step) is scatters


def test_the_work_of_runs_is_counted_once():
    case = dam(elements_across=2)
    shaken = ShakenDam(case, build_flexible_dam(case), Earthquake(MOTION, None, 1.0).shaking)
    trials = Trials(shaken, 1e-3, 0.1)
    own, finer = Level(0, 0), Level(1, -1)
    assert trials.cost([(own, (1.0,)), (finer, SCALES), (finer, (1.0,))]) == 1.0 + 5.0 * 2.0
    trials.prepare([own], [(finer, (1.0, 0.99))])
    assert (trials.runs, trials.work) == (3, 1.0 + 2.0 * 2.0)
    assert trials.cost([(own, (1.0,)), (finer, SCALES)]) == 3.0 * 2.0


def test_a_mesh_whose_runs_are_too_many_is_not_built(monkeypatch):
    """By hand: five runs at 4 and 17 at 2 with twice the elements; on the first mesh 17 at a half, and five with larger
    surroundings."""
    case = read_case(FIELDS | {"flexible": {"elements_across": 2}, "motion": {"file": "elcentro-1940-180-nga"}})
    shaken = ShakenDam(case, build_flexible_dam(case), Earthquake(MOTION, None, 1.0).shaking)
    trials, work = Trials(shaken, 1e-3, 0.1), 5.0 * 4.0 + 17.0 * 2.0 + (17.0 + 5.0) * 0.5
    finer = Level(1, 0)
    assert trials.cost(refinement._fewest(trials, finer, -1, full=True, means=True)) == work

    def build(*_):
        raise AssertionError

    monkeypatch.setattr(reduced, "_build", build)
    monkeypatch.setattr(refinement, "BUDGET", work - 0.1)
    assert not refinement._affordable(trials, finer, full=True, means=True)
    monkeypatch.setattr(refinement, "BUDGET", work)
    with pytest.raises(AssertionError):
        refinement._affordable(trials, finer, full=True, means=True)


@pytest.mark.parametrize(
    ("fields", "times"),
    [
        ({}, 2.0),
        ({"further_cracks": [{"elevation": "20 m", "friction": 0.7}]}, 2.0),
        ({"rock": "rigid"}, 1.0),
        ({"rock": {"modulus": "20 GPa", "damping": 0.0}}, 1.0),
        ({"uplift": {"during_shaking": "full while open"}}, 1.0),
        ({"flexible": {"elements_across": 2, "time_step": "1 ms"}}, 1.0),
    ],
    ids=["one crack", "two cracks", "rigid", "no damping", "water", "own step"],
)
def test_what_stands_beside_a_smooth_run_takes_twice_its_step(fields, times):
    case = read_case(
        FIELDS | {"flexible": {"elements_across": 2}, "motion": {"file": "elcentro-1940-180-nga"}} | fields
    )
    shaken = ShakenDam(case, build_flexible_dam(case), Earthquake(MOTION, None, 1.0).shaking)
    step = shaken.first_step()
    assert shaken.step_beside(step) == times * step
    # One that no longer follows the dam is none.
    assert shaken.step_beside(16.0 * step) == 16.0 * step


def test_what_evidence_asks_for_may_be_built_ahead(monkeypatch):
    case = plane_case(
        FIELDS | {"reservoir": {"depth": "24 m", "compressible": True}, "flexible": {"elements_across": 7}}
    )
    shaken = ShakenDam(case, build_flexible_dam(case), Earthquake(MOTION, None, 0.5).shaking)
    build_ahead(shaken, 0.01)

    def build(*_):
        raise AssertionError

    monkeypatch.setattr(reduced, "_build", build)
    meshes = answer(shaken, 0.01, "full").evidence
    assert meshes.other_elements_across == 4
    assert meshes.residual_slip_m.surroundings is not None


def test_a_vibration_that_grows_is_looked_at_at_the_mesh_that_is_told(monkeypatch):
    told = []

    def growth(shaken, run, *_):
        told.append(run)

    finer = iter([Level(1, 0)])
    monkeypatch.setattr(refinement, "_finer", lambda *_, **__: next(finer, None))
    monkeypatch.setattr(model, "self_excitation", growth)
    response = flexible(dam(elements_across=4), MOTION)
    assert response.evidence["elements_across"] == 8
    # That of the first mesh was on its way meanwhile.
    first, last = told
    assert last is not first
    assert last.summary.slip == response.residual_slip_m


def test_runs_without_a_result_enter_no_number_and_exceed_every_limit(monkeypatch):
    monkeypatch.setattr(refinement, "scales_of", lambda doublings: NINE)
    real = Trials.have_results
    # The strongest shaking, as where a dam overturns.
    monkeypatch.setattr(
        Trials, "have_results", lambda self, level, scales: real(self, level, scales) & (np.array(scales) < 1.005)
    )
    response = flexible(dam(elements_across=4).with_({"limits.residual_slip": "100 m"}), MOTION)
    evidence = response.evidence
    # Three of nine on either mesh, and two of five at half the step.
    assert (evidence["value_is"], evidence["failed"], evidence["converged"]) == ("mean", 8, False)
    worth = evidence["residual_slip_m"]
    known = [slip for slip in evidence["residual_slips_m"] if slip is not None]
    assert len(known) == 6
    assert worth["value"] == pytest.approx(np.mean(known), abs=1e-12)
    assert worth["distribution"]["fractile_84"] is None
    (limit,) = response.limits
    assert limit.exceeding == pytest.approx(3.0 / 9.0)
    assert not limit.met


@pytest.mark.parametrize(("across", "finest"), [(4, -1), (8, -2)])
def test_a_coarser_mesh_without_results_bounds_nothing(monkeypatch, across, finest):
    monkeypatch.setattr(refinement, "_scatter", lambda slips, step: True)
    monkeypatch.setattr(refinement, "scales_of", lambda doublings: NINE)
    real = Trials.have_results
    monkeypatch.setattr(
        Trials, "have_results", lambda self, level, scales: real(self, level, scales) & (level.mesh > finest)
    )
    case = plane_case(
        FIELDS | {"reservoir": {"depth": "24 m", "compressible": True}, "flexible": {"elements_across": across}}
    )
    evidence = flexible(case, MOTION).evidence
    worth = evidence["residual_slip_m"]
    assert worth["mesh"] == pytest.approx(abs(worth["value"]))
    # Those with larger surroundings are of the second mesh.
    assert (worth["surroundings"] == worth["mesh"]) == (finest == -1)
    assert not evidence["converged"]


def test_a_mean_that_costs_too_much_is_left_out(monkeypatch):
    monkeypatch.setattr(refinement, "_scatter", lambda slips, step: True)
    monkeypatch.setattr(refinement, "BUDGET", 5.0)
    evidence = flexible(dam(elements_across=4), MOTION).evidence
    assert (evidence["value_is"], evidence["budget_spent"]) == ("run", True)
    assert evidence["scales"] == list(SCALES)
    assert evidence["work"] <= 5.0


def test_another_step_without_a_result_bounds_nothing(monkeypatch):
    real = Trials.have_results

    def have_results(self, level, scales):
        return real(self, level, scales) & (level.halvings == 0)

    monkeypatch.setattr(Trials, "have_results", have_results)
    # A step of the case is not refined.
    evidence = flexible(dam(elements_across=4, evidence="step", time_step="0.2 ms"), MOTION).evidence
    worth = evidence["residual_slip_m"]
    assert worth["step"] == pytest.approx(abs(worth["run"]))
    assert not evidence["converged"]
