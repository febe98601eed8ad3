"""Runs until a result is certain enough, or what it may cost is spent."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.case.options import Flexible
from heeltoe.kernel.dam import DamRun
from heeltoe.models.flexible.body.cost import wave_bodies
from heeltoe.models.flexible.body.reduced import FlexibleDam
from heeltoe.models.flexible.evidence.evidence import (
    BUDGET,
    ERROR_OF_MEAN,
    FLOOR_M,
    LIMIT,
    allowed,
    may_have_no_limit,
    most_moved_by,
    worth_of,
)
from heeltoe.models.flexible.evidence.trials import CROSS_SLIP, SCALES, SOFTENING, Level, Trials, scales_of
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.flexible.run.expected import FEWEST_ACROSS
from heeltoe.result.contract import CRACKED, HEADLINES, RESIDUAL_SLIP
from heeltoe.result.distribution import distribution_of
from heeltoe.result.numbers import EvidenceNumbers, HeadlineWorth, RotationWorth

# Two meshes may agree by chance. Twice the elements of quadratic shape make what they leave a quarter at best, so of
# what moves a number from the third mesh to the second at least this part is left; coarser meshes say nothing.
_LEFT, _LEAST_ACROSS = 0.25, 2
# Means are taken at the longer step: the scheme is of the first order, so half the step leaves so much of its error.
_LEFT_BY_HALF = 0.5
# Single runs scatter where what a straight line through them leaves is more than this part of the uncertainty that is
# allowed, or where half the step, which moves a smooth run by a few thousandths, moves it by more than this one.
_SCATTERS, _SCATTERS_BY_STEP = 0.2, 0.1
# What is less than this part of the uncertainty that is allowed need not be refined.
_MATTERS = 0.25
_AS_IT_IS: tuple[float, ...] = (1.0,)
# Each so many runs of a sample are repeated with half the step, a finer mesh or larger surroundings, and a sample is
# doubled so often at most.
_PAIRED, _DOUBLINGS = 4, 1
#: Fewer runs with a result have no mean.
FEWEST = 2

_Wanted = list[tuple[Level, Sequence[float]]]


@dataclass(frozen=True)
class Answer:
    """A run with its frames, its dam, and what it is worth.

    Attributes
    ----------
    shaken, run, evidence
        What is told.
    evidences
        That of each crack, from the crest down; none where none is asked for.
    beside
        The dam with the other mesh, and its run with frames; None where there is none.
    """

    shaken: ShakenDam
    run: DamRun
    evidence: EvidenceNumbers | None
    beside: tuple[ShakenDam, DamRun] | None = None
    evidences: tuple[EvidenceNumbers, ...] = ()

    @property
    def slips(self) -> list[float]:
        """Residual slips to trust [m], of the cracks from the crest down: means where single runs scatter."""
        if self.evidences:
            return [evidence.residual_slip_m.value for evidence in self.evidences]
        return [summary.slip for summary in self.run.summaries]


def answer(shaken: ShakenDam, frame_step: float, asked: str, first: DamRun | None = None) -> Answer:
    """Run a dam with some evidence.

    Parameters
    ----------
    shaken
        The dam with its earthquake.
    frame_step
        Spacing of the frames [s].
    asked
        ``"full"``, ``"step"`` or ``"none"``.
    first
        A run at the first step with such frames, where it has been made before.
    """
    options = shaken.case.flexible
    trials, level = _begun(shaken, frame_step, first)
    if asked == "none":
        return Answer(shaken, trials.whole(level), None)
    full = asked == "full"
    while True:
        stand = _Stand(trials, level, full=full)
        if full and level.halvings < 0 and stand.scatters:
            shorter = Level(level.mesh, 0)
            if not _affordable(trials, shorter, full=True, means=False):
                evidence = stand.evidences(spent=True)
                break
            level = shorter
            continue
        evidence = stand.evidences()
        finer = _finer(_worst(evidence), level, options, lowered=full and stand.lowers_strength)
        if finer is None:
            break
        if not _affordable(trials, finer, full=full, means=any(item.scatters for item in evidence)):
            evidence = stand.evidences(spent=True)
            break
        level = finer
    mesh = stand.mesh
    beside = None if mesh is None else (trials.dam_of(mesh.mesh), trials.whole(mesh))
    return Answer(trials.dam_of(level.mesh), trials.whole(level), evidence[trials.asked], beside, evidence)


def _begun(shaken: ShakenDam, frame_step: float, first: DamRun | None = None) -> tuple[Trials, Level]:
    """Return trials, and the level of their first run: that of zero is for runs that scatter."""
    level = Level(0, -shaken.halvings)
    step = shaken.first_step() / 2.0**shaken.halvings
    return Trials(shaken, step, frame_step, {} if first is None else {level: first}), level


def build_ahead(shaken: ShakenDam, frame_step: float) -> None:
    """Build the dams that full evidence for a run at the first step will ask for, of which the last few are kept."""
    stand = _Stand(*_begun(shaken, frame_step), full=True)
    # Asking for it builds it.
    stand.wanted(means=False)


def _affordable(trials: Trials, level: Level, *, full: bool, means: bool) -> bool:
    """Return whether the runs that evidence at a level needs are within what a result may cost."""
    # These are the least, whatever the dam is like: they may be too much before it is built.
    least = min(trials.cost(_fewest(trials, level, change, full=full, means=means)) for change in (-1, 1))
    case = trials.dam_of(0).case
    if trials.work + least > BUDGET or not trials.expected(level, trials.work + least).within(case):
        return False
    work = trials.work + trials.cost(_Stand(trials, level, full=full).wanted(means=means))
    return work <= BUDGET and trials.expected(level, work).within(case)


def _fewest(trials: Trials, level: Level, change: int, *, full: bool, means: bool) -> _Wanted:
    """Return the least runs of evidence at a level, where the other step is that of the run, halved `change` times."""
    halvings = level.halvings + change
    wanted: _Wanted = [(level, _AS_IT_IS), (Level(level.mesh, halvings), _AS_IT_IS)]
    if full:
        longer = min(level.halvings, halvings)
        wanted.append((Level(level.mesh, longer), _AS_IT_IS))
        scales = _AS_IT_IS
        if means:
            sample = scales_of(0)
            scales = _paired(sample)
            wanted += [(Level(level.mesh, longer), sample), (Level(level.mesh, longer + 1), scales)]
            options = trials.dam_of(0).case.flexible
            if not (options.mesh_above or options.mesh_below):
                wanted.append((Level(level.mesh - 1, longer), sample))
        if wave_bodies(trials.dam_of(0).case):
            wanted.append((Level(level.mesh - 1, longer, larger=True), scales))
    return wanted


def _worst(evidences: Sequence[EvidenceNumbers]) -> EvidenceNumbers:
    """Return the evidence of the crack whose slip is the least certain, the first of them where several are as bad."""
    return max(
        evidences,
        key=lambda evidence: (not evidence.converged, evidence.residual_slip_m.uncertainty / evidence.allowed_m),
    )


def _finer(evidence: EvidenceNumbers, level: Level, options: Flexible, *, lowered: bool = False) -> Level | None:
    """Return the level at which the slip may be certain enough; None where it is, or nothing can make it so. A mesh
    that has `lowered` the strength of a joint is too coarse, whatever the shaking does."""
    if lowered and not evidence.converged and "elements_across" not in options.model_fields_set:
        return Level(level.mesh + 1, level.halvings)
    slip = evidence.residual_slip_m
    if evidence.converged or evidence.no_limit or (slip.shaking or 0.0) > evidence.allowed_m:
        return None
    # What the case gives is kept.
    step = 0.0 if options.time_step is not None else slip.step
    mesh = 0.0 if "elements_across" in options.model_fields_set else slip.mesh or 0.0
    if max(step, mesh) < _MATTERS * evidence.allowed_m:
        return None
    return Level(level.mesh, level.halvings + 1) if step > mesh else Level(level.mesh + 1, level.halvings)


def _rotation(worth: HeadlineWorth, *, bounded: bool) -> RotationWorth:
    return RotationWorth(**dict(worth) | ({} if bounded else {"uncertainty": None}))


def _moved_by_mesh(
    key: str, own: dict[str, Floats], beside: dict[str, Floats] | None, third: dict[str, Floats] | None
) -> float | None:
    """Return by how much the mesh moves a headline number of a run; None where there is no other mesh."""
    if beside is None:
        return None
    moved = abs(float(own[key][0] - beside[key][0]))
    return moved if third is None else max(moved, _LEFT * abs(float(beside[key][0] - third[key][0])))


@dataclass(frozen=True)
class _Sample:
    """Runs of a crack with the shaking varied, at one level.

    Attributes
    ----------
    level, scales
        How they are made, and the factors on the shaking (n,).
    numbers, good
        Their headline numbers by name, and which of them have a result, (n,) each.
    """

    level: Level
    scales: tuple[float, ...]
    numbers: dict[str, Floats]
    good: NDArray[np.bool_]

    def known(self, key: str) -> Floats:
        """Return the numbers of the runs that have a result."""
        return self.numbers[key][self.good]

    def values(self, key: str) -> list[float | None]:
        """Return the number of each run; None of one without a result."""
        return [float(value) if fine else None for value, fine in zip(self.numbers[key], self.good, strict=True)]

    def error(self, key: str) -> float:
        """Return the standard error of the mean."""
        known = self.known(key)
        return float(known.std(ddof=1) / math.sqrt(known.size))

    @property
    def is_enough(self) -> bool:
        """Whether the mean of the slip is known well enough."""
        mean = float(self.known(RESIDUAL_SLIP.key).mean())
        return self.error(RESIDUAL_SLIP.key) <= ERROR_OF_MEAN / LIMIT * allowed(mean)

    def moved(self, key: str, other: _Sample, left: float = 0.0) -> float | None:
        """Return how far the mean may be off, by its difference from the mean of runs with some of the same factors at
        another level, where the part `left` of its error is left: the difference; the part of it that exceeds its
        standard error, over 1 - left; and at least that standard error. By pairs where both levels scatter alike, by
        the two means where each scatters by itself. None without enough runs, which bound nothing."""
        place = {scale: row for row, scale in enumerate(self.scales)}
        rows = np.array([place[scale] for scale in other.scales])
        both = self.good[rows] & other.good
        if np.sum(both) < FEWEST:
            return None
        changes = (other.numbers[key] - self.numbers[key][rows])[both]
        means = float(other.known(key).mean() - self.known(key).mean())
        error, moved = min(
            (float(changes.std(ddof=1) / math.sqrt(changes.size)), abs(float(changes.mean()))),
            (math.hypot(self.error(key), other.error(key)), abs(means)),
        )
        return max(error, moved, (moved - error) / (1.0 - left))


def _paired(scales: tuple[float, ...]) -> tuple[float, ...]:
    """Return the factors of a sample at which it is compared with a level whose runs cost more."""
    return max(SCALES, scales[::_PAIRED], key=len)


def _deviation(numbers: Floats) -> float:
    return float(numbers.std(ddof=1))


def _difference(key: str, one: dict[str, Floats], other: dict[str, Floats]) -> float:
    return abs(float(one[key][0] - other[key][0]))


def _scatter(slips: Floats, step: float) -> bool:
    """Whether single runs are one of many equals, which do not lie on a line that rises with the shaking."""
    line = np.polyfit(SCALES, slips, 1)
    left = slips - np.polyval(line, SCALES)
    deviation = float(np.sqrt(np.sum(left**2) / (slips.size - line.size)))
    limit = allowed(float(slips.mean()))
    return deviation > _SCATTERS * limit or abs(step) > _SCATTERS_BY_STEP * limit


class _Stand:
    """Runs compared with the run at one level: another step, another mesh, other shaking."""

    def __init__(self, trials: Trials, level: Level, *, full: bool) -> None:
        self._trials, self._level, self._full = trials, level, full
        shaken = trials.dam_of(level.mesh)
        self._options = shaken.case.flexible
        self._bonds = [alone.crack.bond for alone in shaken.case.single_crack_cases]
        longer = 2.0 * trials.step_of(level)
        self._step = Level(level.mesh, level.halvings + (-1 if shaken.may_step(longer) else 1))
        # Members of the ensemble take the longer of the two steps.
        self._halvings = min(level.halvings, self._step.halvings)
        #: The other mesh, None where there is none.
        self.mesh = self._beside() if full else None
        #: The same with rock and water that reach farther, where there are any.
        self._larger = replace(self._cheap, larger=True) if full and wave_bodies(shaken.case) else None
        if self._larger is not None:
            trials.dam_of(self._larger.mesh, larger=True)

    def _beside(self) -> Level | None:
        if self._options.mesh_above or self._options.mesh_below:
            return None
        coarser = self._level.mesh - 1
        few = self._options.elements_across < FEWEST_ACROSS or not self._trials.has_mesh(coarser, _LEAST_ACROSS)
        return Level(self._level.mesh + 1 if few else coarser, self._halvings)

    @cached_property
    def _third(self) -> Level | None:
        """A mesh that is coarser still, by which two that agree by chance are found out; None where there is none."""
        if self.mesh is None or self.mesh.mesh > self._level.mesh:
            return None
        third = Level(self.mesh.mesh - 1, self._halvings)
        return third if self._trials.has_mesh(third.mesh, _LEAST_ACROSS) else None

    @property
    def _own(self) -> Level:
        return Level(self._level.mesh, self._halvings)

    @property
    def _cheap(self) -> Level:
        """Where the shaking is varied at first: the coarser of the two meshes."""
        return self._own if self.mesh is None else min(self.mesh, self._own)

    def _pairs(self, scales: tuple[float, ...]) -> dict[str, tuple[Level, tuple[float, ...]]]:
        """Return the levels and the factors with which a sample is compared by their difference: half the step and the
        other mesh, which is compared with the third; larger rock and water are compared with the cheapest mesh."""
        some = _paired(scales)
        pairs = {"step": (replace(self._own, halvings=self._halvings + 1), some)}
        if self.mesh is not None:
            pairs["mesh"] = (self.mesh, scales if self.mesh < self._own else some)
        if self._third is not None:
            # With rock and water around it a coarse mesh costs nearly as much as the own one.
            pairs["third mesh"] = (self._third, some if self._larger is not None else scales)
        if self._larger is not None:
            pairs["surroundings"] = (self._larger, some)
        return pairs

    def wanted(self, *, means: bool) -> _Wanted:
        """Return the runs that :meth:`evidence` needs, or needs where means are compared."""
        wanted: _Wanted = [(self._level, _AS_IT_IS), (self._step, _AS_IT_IS)]
        if self._full:
            wanted += [(self._cheap, SCALES), (self._own, _AS_IT_IS)]
            wanted += [(level, _AS_IT_IS) for level in (self.mesh, self._third, self._larger) if level is not None]
        return wanted + self._of_sample(scales_of(0)) if means else wanted

    def _of_sample(self, scales: tuple[float, ...]) -> _Wanted:
        """Return the runs of a sample and of all that it is compared with."""
        return [(self._own, scales), *self._pairs(scales).values()]

    def _sample(self, level: Level, scales: tuple[float, ...], crack: int) -> _Sample:
        numbers = self._trials.numbers(level, scales, crack)
        return _Sample(level, scales, numbers, self._trials.have_results(level, scales))

    def _drawn(self, crack: int) -> tuple[_Sample | None, bool]:
        """Return runs with the shaking varied until the mean of a crack's slip is known well enough, or the next ones
        cost more than a result may, and whether that is why there are no more; None where the first cost too much."""
        trials, sample = self._trials, None
        for doublings in range(_DOUBLINGS + 1):
            scales = scales_of(doublings)
            work = trials.work + trials.cost(self._of_sample(scales))
            if work > BUDGET or not trials.expected(self._level, work).within(trials.dam_of(0).case):
                return sample, True
            sample = self._sample(self._own, scales, crack)
            if np.sum(sample.good) < FEWEST or sample.is_enough:
                break
        return sample, False

    def _prepare(self) -> None:
        levels = [level for level in (self._level, self.mesh) if level is not None]
        self._trials.prepare(levels, self.wanted(means=False))

    @property
    def scatters(self) -> bool:
        """Whether single runs scatter, or the step moves them."""
        self._prepare()
        return any(self._scatters(crack) for crack in range(self._trials.cracks))

    def _scatters(self, crack: int) -> bool:
        """Whether single runs of a crack scatter."""
        varied = self._sample(self._cheap, SCALES, crack)
        if not (varied.good.all() and self._trials.have_results(self._step, _AS_IT_IS)[0]):
            # 1 % of the shaking decides whether there is a result.
            return True
        own, other = (
            self._trials.numbers(level, _AS_IT_IS, crack)[RESIDUAL_SLIP.key][0] for level in (self._level, self._step)
        )
        return _scatter(varied.numbers[RESIDUAL_SLIP.key], float(own - other))

    def evidences(self, *, spent: bool = False) -> tuple[EvidenceNumbers, ...]:
        """Return what the run at this level is worth, crack by crack."""
        trials = self._trials
        self._prepare()
        result = [self._evidence(crack, spent=spent) for crack in range(trials.cracks)]
        # Runs and their cost are those of all.
        return tuple(replace(item, runs=trials.runs, work=trials.work) for item in result)

    def _lowered(self, crack: int, dam: FlexibleDam) -> bool:
        """Return whether the elements along a joint are so long that its strength is lowered."""
        bond, own = dam.lines[crack].bond, self._bonds[crack]
        return bond is not None and own is not None and bond[0] < own.tensile_strength * (1.0 - 1e-12)

    @property
    def lowers_strength(self) -> bool:
        """Whether the elements along a joint are so long that its strength is lowered, and no number can be bounded."""
        return any(self._missing(crack) >= 1.0 for crack in range(self._trials.cracks))

    def _missing(self, crack: int) -> float:
        """Return by how much the strength of a joint is lowered, over the difference of the strengths on both meshes:
        up to 1 a straight line through both says what that does, farther it does not reach."""
        dam = self._trials.dam_of(self._level.mesh).dam
        if not self._lowered(crack, dam):
            return 0.0
        bond, own = dam.lines[crack].bond, self._bonds[crack]
        other = None if self.mesh is None else self._trials.dam_of(self.mesh.mesh).dam.lines[crack].bond
        assert bond is not None
        assert own is not None
        between = 0.0 if other is None else bond[0] - other[0]
        return (own.tensile_strength - bond[0]) / between if between > 0.0 else math.inf

    def _evidence(self, crack: int, *, spent: bool) -> EvidenceNumbers:
        trials = self._trials
        run, other = trials.numbers(self._level, _AS_IT_IS, crack), trials.numbers(self._step, _AS_IT_IS, crack)
        varied = self._sample(self._cheap, SCALES, crack) if self._full else None
        mean = self._full and self._scatters(crack)
        pairs = dict[str, _Sample]()
        if mean:
            drawn, stopped = self._drawn(crack)
            spent = spent or stopped
            varied = drawn or varied
            mean = drawn is not None and bool(np.sum(drawn.good) >= FEWEST)
        if mean and varied is not None:
            pairs = {name: self._sample(*pair, crack) for name, pair in self._pairs(varied.scales).items()}
        own, beside, third, farther, near = (
            None if level is None or mean else trials.numbers(level, _AS_IT_IS, crack)
            for level in (self._own, self.mesh, self._third, self._larger, self._larger and self._cheap)
        )

        failed = sum(int(np.sum(~sample.good)) for sample in (varied, *pairs.values()) if sample is not None)
        dam = trials.dam_of(self._level.mesh).dam
        width, lowered, missing = dam.sections[crack].crack_width, self._lowered(crack, dam), self._missing(crack)

        def known(*levels: Level | None) -> bool:
            return all(level is None or trials.have_results(level, _AS_IT_IS)[0] for level in levels)

        def worth(key: str) -> HeadlineWorth:
            least = FLOOR_M if key.endswith("_m") else FLOOR_M / width
            single = float(run[key][0])
            value, moved = single, dict[str, float | None](step=abs(single - float(other[key][0])))
            # A run without a result bounds nothing.
            if not known(self._step):
                moved["step"] = abs(single)
            if mean and varied is not None:
                value = float(varied.known(key).mean())
                coarser = pairs.get("third mesh")
                for name, pair in ((name, pair) for name, pair in pairs.items() if pair is not coarser):
                    beside_mesh = name == "surroundings" and self._cheap == self.mesh
                    left = _LEFT_BY_HALF if name == "step" else 0.0
                    by = (pairs["mesh"] if beside_mesh else varied).moved(key, pair, left)
                    moved[name] = abs(value) if by is None else by
                if coarser is not None:
                    by = pairs["mesh"].moved(key, coarser)
                    moved["mesh"] = max(moved["mesh"] or 0.0, abs(value) if by is None else _LEFT * by)
                moved["shaking"] = varied.error(key)
            elif self._full and own is not None:
                moved["mesh"] = _moved_by_mesh(key, own, beside, third)
                if not known(self._own, self.mesh, self._third):
                    moved["mesh"] = abs(single)
                if farther is not None and near is not None:
                    sound = known(self._larger, self._larger and self._cheap)
                    moved["surroundings"] = _difference(key, farther, near) if sound else abs(single)
                if varied is not None:
                    moved["shaking"] = abs(single) if failed else _deviation(varied.numbers[key])
            mesh = moved.get("mesh")
            drawn = varied if varied is not None and (mean or failed) and varied.good.any() else None
            return worth_of(
                value,
                single,
                moved["step"] or 0.0,
                mesh if mesh is None or missing >= 1.0 else (1.0 + missing) * mesh,
                moved.get("shaking"),
                moved.get("surroundings"),
                # A joint of another strength may do anything between this and nothing.
                least=max(least, abs(value)) if missing >= 1.0 else least,
                spread=_deviation(drawn.known(key)) if mean and drawn is not None else None,
                distribution=None if drawn is None else distribution_of(drawn.values(key)),
            )

        cracked = None
        if dam.lines[crack].bond is not None:
            # What one run cracks is what it says; no less is known than half an element.
            length = worth(CRACKED)
            least = 0.5 * width / self._options.elements_across
            if length.run + float(run[SOFTENING][0]) > width - least:
                # Nothing is intact that would stop it.
                least = max(least, width - length.run)
            if lowered:
                # A strength that depends on the mesh is no evidence of how far the joint cracks.
                least = max(length.run, width - length.run)
            # That of a single run, where numbers are means.
            moved = (length.step, length.mesh, length.spread, length.surroundings)
            cracked = worth_of(length.run, length.run, *moved, least=least)
        slip = worth(RESIDUAL_SLIP.key)
        on_rock = dam.rock is not None and crack == len(dam.lines) - 1
        no_limit = may_have_no_limit(trials.dam_of(0).case, dam)
        headline_worths: dict[str, Any] = {item.key: worth(item.key) for item in HEADLINES}
        for item in HEADLINES:
            if item.kind == "rotation":
                headline_worths[item.key] = _rotation(worth(item.key), bounded=not on_rock)
        return EvidenceNumbers(
            asked="full" if self._full else "step",
            converged=slip.uncertainty <= allowed(slip.value) and not (failed or no_limit),
            no_limit=no_limit,
            value_is="mean" if mean else "run",
            moved_most_by=most_moved_by(slip),
            allowed_m=allowed(slip.value),
            time_step_s=trials.step_of(self._level),
            other_time_step_s=trials.step_of(self._step),
            elements_across=self._options.elements_across,
            other_elements_across=None if self.mesh is None else trials.across_of(self.mesh),
            third_elements_across=None if self._third is None else trials.across_of(self._third),
            scales=[] if varied is None else list(varied.scales),
            residual_slips_m=[] if varied is None else varied.values(RESIDUAL_SLIP.key),
            varied_time_step_s=None if varied is None else trials.step_of(varied.level),
            varied_elements_across=None if varied is None else trials.across_of(varied.level),
            failed=failed,
            runs=trials.runs,
            work=trials.work,
            budget=BUDGET,
            budget_spent=spent,
            cracked_length_m=cracked,
            residual_slip_cross_m=None if trials.dam_of(0).across is None else worth(CROSS_SLIP),
            **headline_worths,
        )
