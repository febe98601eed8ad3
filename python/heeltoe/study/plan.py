"""What a study consists of, before anything runs: how many runs there are, and what each of them is."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any

import numpy as np

from heeltoe.arrays import Floats, Integers
from heeltoe.case.model import Case
from heeltoe.case.paths import value_of
from heeltoe.case.read import read_case
from heeltoe.case.warnings import case_warnings
from heeltoe.errors import InputError
from heeltoe.models.run import earthquake
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.intensity import MEASURES, intensity, spectral_acceleration
from heeltoe.motion.measures import measures
from heeltoe.study.axes import Axis, axis_of, beside, check_drawn, law_of
from heeltoe.study.cracks.columns import check_cracks
from heeltoe.study.file import Distribution, Scale, Study
from heeltoe.study.motions import Shake, shakes_of
from heeltoe.study.problems import Problems
from heeltoe.study.samples import MOST_SOBOL, Columns, Samples
from heeltoe.units.parse import parse, parse_acceleration
from heeltoe.warnings import Notice

#: More runs than this are a slip of the pen: a hundred core-years of the fastest model.
MOST = 10**11
#: What the scale of the motions counts.
_SCALES = {"factor": "number", "pga": "acceleration", "pgv": "velocity", "sa": "acceleration", "arias": "velocity"}
# What people call things, on which no run depends.
_WORDS = {"title", "units", "project"}
# Of the draws, how many are looked at for values that a field cannot have.
_LOOKED_AT = 1 << 20


@dataclass(frozen=True, eq=False)
class Runs:
    """Some runs.

    Attributes
    ----------
    number
        (n,) of the run.
    sample
        (n,) of the dam.
    values
        (n,) of each field that varies, by path; SI numbers, or words.
    motion
        (n,) place in :attr:`Plan.shakes`.
    strength
        (n,) what the scale says, SI.
    factor
        (n,) on the motion as recorded.
    model
        (n,) place in the models of the study.
    """

    number: Integers
    sample: Integers
    values: Columns
    motion: Integers
    strength: Floats
    factor: Floats
    model: Integers


@dataclass(frozen=True)
class Pilot:
    """How fine the flexible model is in a study: what the evidence of one run asked for.

    Attributes
    ----------
    elements_across, elements_across_below
        Along the crack; the second None where it is as the first.
    halvings
        How often the step is halved.
    evidence
        What that run was worth.
    """

    elements_across: int
    elements_across_below: int | None
    halvings: int
    evidence: Mapping[str, Any] | None

    def to_json(self) -> dict[str, Any]:
        """Return it as it is kept."""
        return asdict(self)

    def refined(self, case: Case) -> Case:
        """Return a case with the mesh, its runs to be made without evidence."""
        update = {
            "elements_across": self.elements_across,
            "elements_across_below": self.elements_across_below,
            "evidence": "none",
        }
        return case.model_copy(update={"flexible": case.flexible.model_copy(update=update)})


@dataclass(frozen=True, eq=False)
class Plan:
    """A study that has been checked.

    Attributes
    ----------
    study
        As read.
    case
        The base case.
    axes
        What varies.
    shakes, events
        The motions, and the names of their events.
    scale
        How strong they are.
    pilot
        How fine flexible runs are; as the case has it where it is not known yet.
    """

    study: Study
    case: Case
    axes: tuple[Axis, ...]
    shakes: tuple[Shake, ...]
    events: tuple[str, ...]
    scale: Axis | None
    pilot: Pilot | None = None

    @property
    def every(self) -> bool:
        """Whether every dam meets every motion."""
        chosen = self.study.motions.every if self.study.motions else None
        return not self.study.drawn if chosen is None else chosen

    @property
    def scale_drawn(self) -> bool:
        """Whether each dam meets one strength, drawn, and not all of them."""
        return self.study.drawn and self.scale is not None and self.scale.law is not None

    @cached_property
    def samples(self) -> Samples:
        """The dams."""
        more = (not self.every) + self.scale_drawn
        base = {axis.path: _base(self.case, axis) for axis in self.axes} if self.study.method == "one at a time" else {}
        study = self.study
        return Samples(self.axes, study.method, study.samples, study.seed, base, study.correlation, more)

    @property
    def sizes(self) -> tuple[int, int, int, int]:
        """How many dams, motions of each dam, strengths of each motion, models."""
        motions = len(self.shakes) if self.every else 1
        strengths = len(self.scale.values) if self.scale is not None and not self.scale_drawn else 1
        return self.samples.count, motions, strengths, len(self.study.model)

    @property
    def count(self) -> int:
        """How many runs."""
        dams, motions, strengths, models = self.sizes
        return dams * motions * strengths * models

    def runs(self, start: int, stop: int) -> Runs:
        """Return a stretch of the runs: the model varies fastest, then strength, motion and dam."""
        number = np.arange(start, min(stop, self.count), dtype=np.int64)
        _, motions, strengths, models = self.sizes
        rest, model = np.divmod(number, models)
        rest, strength_place = np.divmod(rest, strengths)
        sample, motion = np.divmod(rest, motions)
        values, shares = self.samples.at(sample)
        beside = list(shares.T)
        if not self.every:
            motion = np.minimum((beside.pop(0) * len(self.shakes)).astype(np.int64), len(self.shakes) - 1)
        if self.scale is None:
            strength = np.ones(number.size)
        elif self.scale_drawn:
            strength = self.scale.drawn(beside.pop(0))
        else:
            strength = self.scale.at(strength_place)
        return Runs(number, sample, values, motion, strength, self._factors(motion, strength), model)

    @cached_property
    def earthquakes(self) -> tuple[Earthquake, ...]:
        """The motions as recorded, turned round where they are."""
        found = []
        for shake in self.shakes:
            horizontal = shake.horizontal.reversed() if shake.turned else shake.horizontal
            found.append(Earthquake(horizontal, shake.vertical, horizontal.duration))
        return tuple(found)

    def warnings(self) -> list[str]:
        """Return what the case warns of, as it is and with the least and the largest of each field, and the motions."""
        cases = [self.case]
        for axis in self.axes:
            ends = axis.numbers if axis.law is None else np.array(axis.law.support())
            for value in () if ends is None else (ends.min(), ends.max()):
                with suppress(InputError):
                    cases += [self.case.with_(axis.changes(float(value)))] if np.isfinite(value) else []
        said = [notice for case in cases for notice in case_warnings(case)]
        said += [notice for shake in self.shakes for notice in shake.horizontal.warnings]
        if set(self.study.model) == {"rigid"}:
            said.append(Notice("study-rigid"))
        return list(dict.fromkeys(map(str, said)))

    def told_motions(self) -> list[dict[str, Any]]:
        """Return the motions with their measures as recorded, SI; spectral accelerations at the periods that the study
        names, as ``"sa(0.3)"``."""
        study = self.study
        named = [study.motions.scale.period if study.motions and study.motions.scale else None]
        named.append(study.fragility.period if study.fragility else None)
        periods = sorted({each for each in named if each is not None})
        measured: dict[str, dict[str, float]] = {}
        found = []
        for shake in self.shakes:
            motion = shake.horizontal
            if motion.name not in measured:
                by_name = {name: intensity(motion, name, None, self.case.gravity) for name in MEASURES}
                by_name |= {f"sa({period:g})": spectral_acceleration(motion, period) for period in periods}
                measured[motion.name] = by_name
            told = {"name": shake.name, "event": self.events[shake.event], "reversed": shake.turned}
            found.append({**told, "measures": measured[motion.name], "traits": self._traits(shake)})
        return found

    def _traits(self, shake: Shake) -> dict[str, float | None]:
        """Return what is known of a motion beside its strength."""
        told = measures(shake.horizontal, self.case.gravity)
        motions = self.study.motions
        event = motions.events[shake.event] if motions and motions.events else None
        return {
            "mean_period_s": told.get("mean_period_s"),
            "significant_duration_s": told.get("significant_duration_s"),
            "magnitude": event.magnitude if event else None,
            "distance_m": event.distance if event else None,
        }

    def _factors(self, motion: Integers, strength: Floats) -> Floats:
        """Return the factors on the motions as recorded."""
        factor = strength.astype(np.float64)
        if self.scale is not None:
            for place in np.unique(motion).tolist():
                here = motion == place
                factor[here] = self.shakes[place].factor(strength[here], self.scale.path)
        return factor

    @cached_property
    def inputs(self) -> dict[str, str]:
        """Hashes of all that the results hang on, by what each is called."""
        study = self.study.model_dump(mode="json", exclude={"title", "fragility", "case", "motions"})
        unheard = _WORDS | ({"motion"} if self.study.motions else set())
        case = self.case.model_dump(mode="json", exclude=unheard)
        found = {f"the study's {name}": _hash(value) for name, value in study.items()}
        found |= {f"the case's {name}": _hash(value) for name, value in case.items()}
        if self.study.motions is not None:
            found["the study's motions"] = _hash(
                self.study.motions.model_dump(mode="json", exclude={"folder", "files", "events"})
            )
        for shake in self.shakes:
            way = ", turned round" if shake.turned else ""
            found[f"the motion {shake.name}{way}"] = _hash(_told(shake))
        return found

    @property
    def fingerprint(self) -> str:
        """A hash of all of them."""
        return _hash([self.inputs, [shake.name for shake in self.shakes]])


def plan_of(study: Study) -> Plan:
    """Read what a study names and check that all of it can run.

    Raises
    ------
    InputError
        Naming the first thing that cannot be, with the others.
    """
    case = read_case(study.directory / study.case)
    check_cracks(case, study.model)
    if study.title == "" and case.title:
        study = study.model_copy(update={"title": case.title})
    axes, problems = list[Axis](), Problems()
    for path, given in study.vary.items():
        with problems:
            axes.append(axis_of(path, given, case, drawn=study.drawn, beside=beside(path, study.vary)))
    shakes, events, scale = tuple[Shake, ...](), tuple[str, ...](), None
    with problems:
        shakes, events = _motions(study, case)
    with problems:
        scale = _scale(study.motions.scale, case, drawn=study.drawn) if study.motions else None
    problems.tell()
    plan = Plan(study, case, tuple(axes), shakes, events, scale)
    if plan.count > MOST:
        raise InputError("study-many", "study", f"{plan.count:.3g}", most=f"{MOST:.0e}")
    if study.method == "sobol" and plan.samples.count > MOST_SOBOL:
        raise InputError("study-many", "samples", f"{study.samples:.3g}", most=f"{MOST_SOBOL:.3g}")
    if study.drawn:
        looked, _ = plan.samples.at(np.arange(min(plan.samples.count, _LOOKED_AT), dtype=np.int64))
        for axis in axes:
            with problems:
                check_drawn(axis, looked[axis.path], case, beside(axis.path, study.vary))
        problems.tell()
    elif study.method == "one at a time":
        _ = plan.samples
    return plan


def _motions(study: Study, case: Case) -> tuple[tuple[Shake, ...], tuple[str, ...]]:
    """Return the motions of a study and the names of their events: those of the case where it has none."""
    if study.motions is None:
        base = earthquake(case)
        return (Shake(base.motion.name, 0, base.motion, base.vertical),), (base.motion.name,)
    if case.aftershocks:
        raise InputError("study-aftershocks", "motions")
    return shakes_of(study.motions, case, study.directory)


def _scale(scale: Scale | None, case: Case, *, drawn: bool) -> Axis | None:
    """Return the strengths; their path is the measure."""
    if scale is None:
        return None
    quantity = _SCALES[scale.measure]
    field = "motions.scale.values"

    def number(value: object, field: str) -> float:
        # One g is that of the case.
        acceleration = quantity == "acceleration"
        found = parse_acceleration(value, field).si(case.gravity) if acceleration else parse(value, quantity, field)
        if not found > 0.0:
            raise InputError("out-of-range", field, str(value), bound="above 0")
        return found

    if isinstance(scale.values, Distribution):
        law = law_of(scale.values, number, field)
        low, _ = law.support()
        if low < 0.0 or (not np.isfinite(low) and scale.values.distribution == "normal"):
            raise InputError("study-strength", field, scale.values.distribution)
        if drawn:
            return Axis(scale.measure, quantity, (), np.zeros(0), law)
        raise InputError("needs-other", field, other="a method that draws, or a list of values")
    numbers, problems = list[float](), Problems()
    for place, value in enumerate(scale.values):
        with problems:
            numbers.append(number(value, f"{field}[{place}]"))
    problems.tell()
    return Axis(scale.measure, quantity, scale.values, np.array(numbers))


def _base(case: Case, axis: Axis) -> Any:
    """Return the base case's value of a field that varies.

    Raises
    ------
    InputError
        Where it has none.
    """
    value = value_of(case, axis.path)
    if value is None:
        raise InputError("study-base", f"vary.{axis.path}")
    return float(value) if axis.quantity is not None else value


def _hash(told: Any) -> str:
    return hashlib.sha256(json.dumps(told, sort_keys=True).encode()).hexdigest()


def _told(shake: Shake) -> list[Any]:
    def digest(values: Floats) -> str:
        return hashlib.sha256(np.ascontiguousarray(values).tobytes()).hexdigest()

    motions = [each for each in (shake.horizontal, shake.vertical) if each is not None]
    return [shake.event, shake.reference, *([digest(each.time), digest(each.acceleration)] for each in motions)]
