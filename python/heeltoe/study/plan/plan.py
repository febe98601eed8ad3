"""The parts of a study before it runs: number and content of its runs."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.combinations import check
from heeltoe.case.distribution import Distribution
from heeltoe.case.model import Case
from heeltoe.case.paths import value_of
from heeltoe.case.read import read_case
from heeltoe.case.warnings import case_warnings, rock_warnings
from heeltoe.errors.error import InputError, shown
from heeltoe.mechanics.beam import step_warnings
from heeltoe.models.rigid.across import check_across
from heeltoe.models.run import earthquake
from heeltoe.motion.check import check as check_motion
from heeltoe.motion.check import check_scaling
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.intensity import MEASURES, intensity, spectral_acceleration
from heeltoe.motion.measures import measures
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.motion.targets import Target, target_of
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.result.crest import CREST_PEAKS
from heeltoe.result.judge import CREST_LIMITS
from heeltoe.study.plan.axes import Axis, axis_of, beside, check_drawn, law_of
from heeltoe.study.plan.crack_columns import check_cracks
from heeltoe.study.plan.file import Scale, Study
from heeltoe.study.plan.hazard import HazardCurve, read_hazard
from heeltoe.study.plan.motion_names import alone
from heeltoe.study.plan.motions import Shake, beside_file, both_signs, shakes_of
from heeltoe.study.plan.problems import Problems
from heeltoe.study.plan.samples import MOST_SOBOL, Columns, Samples
from heeltoe.study.plan.table import read_table
from heeltoe.units.parse import parse, parse_acceleration
from heeltoe.warnings.notice import Notice

if TYPE_CHECKING:
    from heeltoe.models.flexible.run.dam_runner import ShakenDam

#: More runs than this are a slip of the pen: a hundred core-years of the fastest model.
MOST = 10**11
#: What the scale of the motions counts.
_SCALES = {"factor": "number", "pga": "acceleration", "pgv": "velocity", "sa": "acceleration", "arias": "velocity"}
# What people call things, on which no run depends.
_WORDS = {"title", "units", "project"}
# Of the dams of a table, so many are looked at for what they warn of.
_WARNED = 2000
#: At which the spectra of a suite are drawn [s].
SUITE_PERIODS: Floats = np.geomspace(0.05, 4.0, 90)
# Share of a distribution without a bound.
_NEARLY_ALL = 0.99
# No strength of an earthquake comes near, whatever its measure.
_STRONGEST = 1e12
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
    """Fineness of the flexible model in a study, from the evidence of one run.

    Attributes
    ----------
    elements_across, elements_across_below
        Along the crack; the second None where it is as the first.
    first_step_s, time_step_s
        The step without evidence, or where runs scatter, and the step that it ends with: those of other dams are in the
        same proportion.
    scatters
        Whether its runs scatter or a longer step moves them, so that all dams have that of runs that scatter.
    silence_s, motion
        How long that run went on after its motion, and the place of that in :attr:`Plan.shakes`.
    evidence
        What that run was worth.
    means
        Of each crack, from the crest down, the headline numbers that are means because single runs scatter.
    other_sign
        The same of the motion the other way round, where the study has it.
    elements_away
        Far from the crack; None where as many as along it.
    """

    elements_across: int
    elements_across_below: int | None
    first_step_s: float
    time_step_s: float
    silence_s: float
    motion: int
    evidence: Mapping[str, Any] | None
    means: Sequence[Mapping[str, float]] = ()
    other_sign: Pilot | None = None
    elements_away: int | None = None
    scatters: bool = False

    def to_json(self) -> dict[str, Any]:
        """Return it as it is kept."""
        return asdict(self)

    @classmethod
    def from_json(cls, fields: Mapping[str, Any]) -> Pilot:
        """Return what :meth:`to_json` has written."""
        other = fields["other_sign"]
        return cls(**{**fields, "other_sign": None if other is None else cls.from_json(other)})

    def of_motion(self, motion: int) -> Pilot | None:
        """Return the pilot of a motion; None of one that it has not run."""
        if motion == self.motion:
            return self
        return None if self.other_sign is None else self.other_sign.of_motion(motion)

    def step_of(self, shaken: ShakenDam) -> float:
        """Return the time step of a run [s]."""
        first = shaken.first_step() / 2.0 ** (shaken.halvings if self.scatters else 0)
        return self.time_step_s if first == self.first_step_s else first * (self.time_step_s / self.first_step_s)

    def refined(self, case: Case) -> Case:
        """Return a case with the mesh, its runs to be made without evidence."""
        update = {
            "elements_across": self.elements_across,
            "elements_across_below": self.elements_across_below,
            "elements_away": self.elements_away,
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
    dams
        Names of the dams of a table; None where they come otherwise.
    hazard
        At the site; None where the study has none.
    """

    study: Study
    case: Case
    axes: tuple[Axis, ...]
    shakes: tuple[Shake, ...]
    events: tuple[str, ...]
    scale: Axis | None
    pilot: Pilot | None = None
    dams: tuple[str, ...] | None = None
    hazard: HazardCurve | None = None

    @cached_property
    def crest(self) -> bool:
        """Whether the runs are to say how the crest moves: a limit of the case or of a curve is on it."""
        asked = [self.case.limits, *([self.study.fragility.limits] if self.study.fragility else [])]
        return any(getattr(limits, name) not in (None, ()) for limits in asked for name in CREST_LIMITS)

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
        method = study.method if self.dams is None else "table"
        return Samples(self.axes, method, study.samples, study.seed, base, study.correlation, more)

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
        earthquakes = []
        for shake in self.shakes:
            horizontal = shake.horizontal.reversed() if shake.turned else shake.horizontal
            end = shake.end or horizontal.duration
            earthquakes.append(Earthquake(horizontal, shake.vertical, end, cross=shake.cross))
        return tuple(earthquakes)

    def warnings(self) -> list[str]:
        """Return what the case warns of, as it is and with the least and the largest of each field, and the motions."""
        if self.dams is not None:
            return list(dict.fromkeys(map(str, [*self._warnings_of_dams(), *self._warnings_of_motions()])))
        cases = [self.case]
        for axis in self.axes:
            ends = axis.numbers if axis.law is None else np.array(axis.law.support())
            for value in () if ends is None else (ends.min(), ends.max()):
                with suppress(InputError):
                    cases += [self.case.with_(axis.changes(float(value)))] if np.isfinite(value) else []
        notices = [notice for case in cases for notice in case_warnings(case)] + self._warnings_of_motions()
        return list(dict.fromkeys(map(str, notices)))

    def _warnings_of_dams(self) -> Iterator[str]:
        """Walk what the dams of a table warn of, each kind by the first dam that does."""
        known = set[str]()
        for dam, name in enumerate(self.dams or ()):
            values, _ = self.samples.at(np.array([dam]))
            changes = {
                key: value for axis in self.axes for key, value in axis.changes(_scalar(values[axis.path][0])).items()
            }
            for notice in case_warnings(self.case.with_(changes)):
                if notice.name not in known:
                    known.add(notice.name)
                    yield f"{name}: {notice}"
            if dam >= _WARNED:
                return

    def _warnings_of_motions(self) -> list[Notice]:
        """Return what motions and models warn of."""
        level = [motion for shake in self.shakes for motion in (shake.horizontal, shake.cross)]
        notices = [notice for motion in level if motion is not None for notice in motion.warnings]
        notices += self.check_motions()
        motions, own = self.study.motions, self.case.motion
        if motions is not None and own is not None and own.vertical is not None and not motions.vertical:
            notices.append(Notice("study-vertical-left-out"))
        if set(self.study.model) == {"rigid"}:
            notices.append(Notice("study-rigid"))
        else:
            notices += [notice for shake in self.shakes for notice in step_warnings(self.case, shake.horizontal)]
        if "flexible" in self.study.model:
            notices += rock_warnings(self.case)
        if self.pilot is not None and self.pilot.evidence is not None:
            single_runs = any(self.pilot_of(motion) is None for motion in range(len(self.shakes)))
            notices += _worth(self.pilot.evidence, single_runs=single_runs)
        return notices

    def check_motions(self) -> Iterator[Notice]:
        """Walk what is suspicious about the motions of the study as they shake the dams, as single runs look at them.

        They are looked at at their weakest and strongest, or what is less and more than nearly all that is drawn.

        Raises
        ------
        InputError
            Where one is more than any ground has been seen to do.
        """
        motions, scale = self.study.motions, self.scale
        if motions is None:
            return
        field = "motions" if motions.match is None else "motions.match"
        ends: Any = np.ones(1)
        if scale is not None:
            field = "motions.scale.values"
            ends = scale.numbers if scale.law is None else scale.law.ppf([1.0 - _NEARLY_ALL, _NEARLY_ALL])
        for shake in self.shakes:
            if shake.turned:
                continue
            factors = shake.factor(np.asarray(ends, dtype=np.float64), "factor" if scale is None else scale.path)
            yield from check_scaling(shake.horizontal, float(factors.max()))
            for factor in sorted({float(factors.min()), float(factors.max())}):
                for motion in (shake.horizontal, shake.vertical, shake.cross):
                    if motion is not None:
                        made = motion if factor == 1.0 else motion.scaled(factor)
                        yield from check_motion(made, self.case.gravity, allow_zero=True, field=field)

    def pilot_of(self, motion: int) -> Pilot | None:
        """Return the pilot where it has made the run of a motion: of one dam at one strength."""
        return None if self.pilot is None or self.axes or self.scale is not None else self.pilot.of_motion(motion)

    def motions_of_manifest(self) -> list[dict[str, object]]:
        """Return the motions with their measures as recorded, SI; spectral accelerations at the periods that the study
        names, as ``"sa(0.3)"``."""
        study = self.study
        named = [study.motions.scale.period_s if study.motions and study.motions.scale else None]
        named.append(study.fragility.period if study.fragility else None)
        periods = sorted({period for period in named if period is not None})
        measured: dict[str, dict[str, float]] = {}
        rows = []
        for shake in self.shakes:
            motion = shake.horizontal
            if shake.name not in measured:
                by_name = {name: intensity(motion, name, None, self.case.gravity) for name in MEASURES}
                by_name |= {f"sa({period:g})": spectral_acceleration(motion, period) for period in periods}
                measured[shake.name] = by_name
            row = {"name": shake.name, "event": self.events[shake.event], "reversed": shake.turned}
            if shake.azimuth is not None:
                row["azimuth_deg"] = shake.azimuth
            rows.append({**row, "measures": measured[shake.name], "traits": self._traits(shake), **_place(shake)})
        return rows

    def spectra(self) -> dict[str, Any] | None:
        """Return the spectra of a suite with its target, SI: those of the motions as recorded, by name; None of any
        other study."""
        if self.study.suite is None:
            return None
        target = _target(self.study, self.case)
        motions = {shake.name: shake.horizontal for shake in self.shakes}
        damping = 0.05 if target is None else target.damping
        periods = SUITE_PERIODS
        drawn = None
        if target is not None:
            known = periods[(periods >= target.shortest) & (periods <= target.longest)]
            accelerations = target(known).tolist()
            drawn = {"name": target.name, "period_s": known.tolist(), "pseudo_acceleration_m_s2": accelerations}
        return {
            "damping": damping,
            "period_s": periods.tolist(),
            "motions": {
                name: response_spectrum(motion, periods, damping).pseudo_acceleration.tolist()
                for name, motion in motions.items()
            },
            "target": drawn,
        }

    def _traits(self, shake: Shake) -> dict[str, float | None]:
        """Return what is known of a motion beside its strength."""
        known = measures(shake.horizontal, self.case.gravity)
        event = shake.about
        return {
            "mean_period_s": known.mean_period_s,
            "significant_duration_s": known.significant_duration_s,
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
        """Hashes of everything that the results depend on, by name."""
        study = self.study.model_dump(mode="json", exclude={"title", "fragility", "hazard", "suite", "case", "motions"})
        unheard = _WORDS | ({"motion"} if self.study.motions else set())
        case = self.case.model_dump(mode="json", exclude=unheard)
        hashes = {f"the study's {name}": _hash(value) for name, value in study.items()}
        hashes |= {f"the case's {name}": _hash(value) for name, value in case.items()}
        if self.study.motions is not None:
            hashes["the study's motions"] = _hash(
                self.study.motions.model_dump(mode="json", exclude={"folder", "files", "events"})
            )
        if self.crest:
            hashes["what is said of the crest"] = _hash(CREST_PEAKS)
        if self.dams is not None:
            columns = [[axis.path, list(map(str, axis.values))] for axis in self.axes]
            hashes["the table of dams"] = _hash([list(self.dams), columns])
        for shake in self.shakes:
            way = ", turned round" if shake.turned else ""
            hashes[f"the motion {shake.name}{way}"] = _hash(_shake_content(shake))
        return hashes

    @property
    def fingerprint(self) -> str:
        """A hash of all of them."""
        return _hash([self.inputs, [shake.name for shake in self.shakes]])


def plan_of(study: Study, case: Case | None = None) -> Plan:
    """Read what a study names and check that all of it can run.

    Parameters
    ----------
    study
        The study.
    case
        The base case; read from the file that the study names where it is not given.

    Raises
    ------
    InputError
        Naming the first thing that cannot be, with the others.
    """
    case = read_case(study.directory / study.case) if case is None else case
    check_cracks(case, study.model)
    study = _with_first_period(study, case)
    if study.title == "" and case.title:
        study = study.model_copy(update={"title": case.title})
    axes, problems = list[Axis](), Problems()
    dams = None if study.cases is None else read_table(study.directory / os.path.expanduser(study.cases))
    if dams is not None:
        with problems:
            dams.check(case)
        axes += dams.axes
    for path, entry in study.vary.items():
        with problems:
            axes.append(axis_of(path, entry, case, drawn=study.drawn, beside=beside(path, study.vary)))
    shakes, events, scale = tuple[Shake, ...](), tuple[str, ...](), None
    with problems:
        shakes, events = _motions(study, case)
    with problems:
        scale = _scale(study.motions.scale, case, drawn=study.drawn) if study.motions else None
    problems.tell()
    hazard = None
    if study.hazard is not None and study.fragility is not None:
        measure, period = study.fragility.measure, study.fragility.period
        hazard = read_hazard(study.hazard, measure, case.gravity, study.directory, period)
    names = None if dams is None else dams.names
    plan = Plan(study, case, tuple(axes), shakes, events, scale, dams=names, hazard=hazard)
    band = case.crack.band
    if band is not None and band.judge != "best":
        raise InputError("band-many", "crack.band.judge", shown(band.judge))
    bonded = any(crack.bond is not None for crack in case.cracks)
    if study.fragility is not None and study.fragility.limits.cracked_length and not bonded:
        raise InputError("needs-other", "fragility.limits.cracked_length", other="a bonded joint (crack.bond)")
    if study.suite is not None:
        if plan.sizes[2] > 1:
            raise InputError("suite-one-strength", "motions.scale.values", plan.sizes[2])
        _target(study, case)
    list(plan.check_motions())
    if plan.crest and "decoupled" in study.model:
        raise InputError("study-no-crest", "model", "decoupled")
    if plan.count > MOST:
        raise InputError("too-many", "study", f"{plan.count:.3g}", most=f"{MOST:.0e}")
    if study.method == "sobol" and plan.samples.count > MOST_SOBOL:
        raise InputError("too-many", "samples", f"{study.samples:.3g}", most=f"{MOST_SOBOL:.3g}")
    if study.drawn:
        looked, _ = plan.samples.at(np.arange(min(plan.samples.count, _LOOKED_AT), dtype=np.int64))
        for axis in axes:
            with problems:
                check_drawn(axis, looked[axis.path], case, beside(axis.path, study.vary))
        problems.tell()
    elif study.method == "one at a time":
        _ = plan.samples
    return plan


def _with_first_period(study: Study, case: Case) -> Study:
    """Return the study with the first period of the dam in the place of "T1"."""
    motions = study.motions
    if motions is None or motions.scale is None or motions.scale.period != "T1":
        return study
    if case.concrete.modulus is None:
        raise InputError("suite-no-period", "motions.scale.period", "T1")
    from heeltoe.models.flexible.surroundings.lowest_modes import first_period

    # Six digits say what the spectrum is read at, in words and in files.
    first = float(f"{first_period(case, 'motions.scale.period'):.6g}")
    scale = motions.scale.model_copy(update={"period": first})
    return study.model_copy(update={"motions": motions.model_copy(update={"scale": scale})})


def _target(study: Study, case: Case) -> Target | None:
    """Return the target spectrum of a suite."""
    motions = study.motions
    for field, text in (
        ("suite.target", study.suite and study.suite.target),
        ("motions.match", motions and motions.match),
    ):
        if text:
            return target_of(beside_file(text, study.directory), field, case.gravity)
    return None


def _motions(study: Study, case: Case) -> tuple[tuple[Shake, ...], tuple[str, ...]]:
    """Return the motions of a study and the names of their events: by default those of the case."""
    if study.motions is None:
        base = earthquake(case)
        shake = Shake(base.motion.name, 0, base.motion, base.vertical, end=base.end, cross=base.cross)
        both = both_signs(None, case) and base.motion.pga > 0.0
        return (shake, replace(shake, turned=True)) if both else (shake,), (base.motion.name,)
    check(case, "motions")
    if study.motions.cross_valley:
        for model in study.model:
            check_across(case, model, "motions.cross_valley" if study.suite is None else "suite.cross_valley")
    shakes, events = shakes_of(study.motions, case, study.directory)
    if study.suite is not None and study.motions.cross_valley:
        # A run without the other component shows its effect.
        shakes += tuple(replace(shake, name=alone(shake.name), cross=None) for shake in shakes)
    return shakes, events


def _scale(scale: Scale | None, case: Case, *, drawn: bool) -> Axis | None:
    """Return the strengths; their path is the measure."""
    if scale is None:
        return None
    quantity = _SCALES[scale.measure]
    field = "motions.scale.values"

    def number(value: object, field: str) -> float:
        # One g is that of the case.
        acceleration = quantity == "acceleration"
        number_si = parse_acceleration(value, field).si(case.gravity) if acceleration else parse(value, quantity, field)
        if not 0.0 < number_si < _STRONGEST:
            raise InputError("out-of-range", field, str(value), bound=f"above 0 and below {_STRONGEST:g} in SI")
        return number_si

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


def _scalar(value: Any) -> Any:
    return float(value) if isinstance(value, np.floating) else value


def _hash(content: Any) -> str:
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def _place(shake: Shake) -> dict[str, float | None]:
    """Return what is known of where a motion was recorded, and of its pulse."""
    event = shake.about
    return {
        "vs30_m_s": None if event is None else event.vs30,
        "pulse_period_s": None if event is None else event.pulse_period,
        "hazard_share": None if event is None else event.hazard_share,
    }


def _shake_content(shake: Shake) -> list[Any]:
    def digest(values: Floats) -> str:
        return hashlib.sha256(np.ascontiguousarray(values).tobytes()).hexdigest()

    motions = [motion for motion in (shake.horizontal, shake.vertical, shake.cross) if motion is not None]
    return [shake.event, shake.reference, *([digest(motion.time), digest(motion.acceleration)] for motion in motions)]


def _worth(evidence: Mapping[str, Any], *, single_runs: bool) -> Iterator[Notice]:
    """Say what the base case's evidence says of the rows, which are single runs without evidence."""
    slip = evidence[RESIDUAL_SLIP.key]
    if evidence["value_is"] == "mean" and single_runs:
        yield Notice("study-single-runs", "scatter", value_m=slip["value"], run_m=slip["run"])
    if not evidence["converged"]:
        yield Notice("study-single-runs", "uncertain", value_m=slip["value"], uncertainty_m=slip["uncertainty"])
