"""The study file: a base case, what varies, how it is sampled, which earthquakes, and what is asked of the results."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from os import PathLike
from pathlib import Path
from typing import Annotated, Any, Literal, Self

from pydantic import (
    BeforeValidator,
    Discriminator,
    Field,
    PrivateAttr,
    Tag,
    ValidationError,
    model_validator,
)

from heeltoe.base.display import Shown
from heeltoe.case.distribution import Distribution, Value
from heeltoe.case.fields import Count, Fields, Fraction, TimeSpan, Truth
from heeltoe.case.fields_file import read_fields
from heeltoe.case.motion import Layout
from heeltoe.case.processing import CorrectionStep
from heeltoe.case.quantities import AccelerationField, DimensionlessNumber, Duration, Length, Rotation, Slip, Velocity
from heeltoe.case.sentences import collected, first_error, gathered
from heeltoe.case.suite import CrossValleyField, PeriodField, SuiteRule
from heeltoe.errors.error import InputError, shown
from heeltoe.motion.records import HeaderFactor
from heeltoe.units.parse import acceleration_unit
from heeltoe.units.sentences import counted

Model = Literal["rigid", "decoupled", "flexible"]
Method = Literal["grid", "one at a time", "latin hypercube", "sobol", "sensitivity"]
Measure = Literal[
    "pga", "pgv", "sa", "arias", "velocity spectrum intensity", "housner intensity", "cumulative absolute velocity"
]


def _listed(value: Any) -> Any:
    return [value] if isinstance(value, str | int | float) else value


# Without names of their own the kinds leave no trace in the path of what is wrong with one.
Values = Annotated[
    Annotated[tuple[Value, ...], Field(min_length=1), Tag(" ")] | Annotated[Distribution, Tag("")],
    Discriminator(lambda entry: "" if isinstance(entry, Mapping | Distribution) else " "),
]


class Event(Fields):
    """Components of one earthquake at one place."""

    name: Annotated[str, Field(strict=True)] = ""
    """Name of the event (default: its first file)."""
    horizontal: Annotated[tuple[str, ...], BeforeValidator(_listed), Field(min_length=1, max_length=2)]
    """One or two horizontal components: files, relative to the study file, or names of the catalogue; a channel of a
    file of several as `FILE#2`."""
    vertical: str | None = None
    """The vertical component, which shakes the dam together with each horizontal one, scaled by the same factor."""
    magnitude: Annotated[DimensionlessNumber, Field(ge=0.0, le=10.0)] | None = None
    """Moment magnitude; nothing depends on it but the comparison of measures of strength."""
    distance: Annotated[Length, Field(gt=0.0)] | None = None
    """From the fault to the place; for the same."""
    vs30: Annotated[Velocity, Field(gt=0.0)] | None = None
    """Velocity of shear waves in the upper 30 m of the place; shown beside its records."""
    pulse_period: Annotated[Duration, Field(gt=0.0)] | None = None
    """Period of the pulse in the velocity of a record near a fault; shown beside it."""
    hazard_share: Fraction | None = None
    """Share of the hazard from earthquakes of its magnitude and distance, by a disaggregation; shown beside it."""


class Scale(Fields):
    """How strong the motions are."""

    measure: Literal["factor", "pga", "pgv", "sa", "arias"] = "pga"
    """Meaning of `values`: factors on the record, or a measure of the scaled motion: peak acceleration, peak velocity,
    spectral acceleration at `period` with 5 % damping, Arias intensity."""
    period: PeriodField | None = None
    """Period of `sa`; "T1" for the first period of the dam, intact, with its water and its rock."""
    values: Values
    """A list, through which every motion goes, or a distribution of which each run draws one."""

    @model_validator(mode="after")
    @collected
    def _period(self) -> Self:
        if (self.measure == "sa") != (self.period is not None):
            if self.period is None:
                raise InputError("missing-field", "period", example='period = "0.3 s"')
            raise InputError("needs-other", "period", other='measure = "sa"')
        return self

    @property
    def period_s(self) -> float | None:
        """The period, once that of the dam is known [s]."""
        return self.period if isinstance(self.period, float) else None


class Motions(Fields):
    """The earthquakes; without them all runs meet that of the case."""

    folder: str | None = Field(default=None, strict=True, min_length=1)
    """Folder of records, all of which are used. Station, time and direction in the files say which are components of
    one event and which are vertical; where they are missing, names that differ in their last part do."""
    files: Annotated[tuple[str, ...], Field(min_length=1)] | None = None
    """Records, grouped by their names as in a folder."""
    events: Annotated[tuple[Event, ...], Field(min_length=1)] | None = None
    """Events with their components, listed one by one."""
    pairs: Truth = False
    """Two horizontal components of each event are expected; they keep the ratio of their strengths, since the factor of
    `scale` is that which the geometric mean of both needs, and count as one event wherever events are counted."""
    vertical: Truth = False
    """A vertical component of each event is expected and used."""
    cross_valley: CrossValleyField = False
    """Two horizontal components of each event are expected: each shakes the dams along the stream, with the other one
    across the valley by the same factor, or with this share of the peak along the stream ("30 %"). "15 deg" rotates
    both to streams of all azimuths in such steps; `scale` is that of the strongest."""
    both_signs: Truth | None = None
    """Each motion also reversed, as a run of its own: the default, unless the case says which way round its motion is
    (`motion.sign`)."""
    every: Truth | None = None
    """Whether every sample meets every motion, as in a grid or one at a time, or one motion each, evenly drawn, as
    otherwise."""
    scale: Scale | None = None
    """How strong they are; as recorded where it is not given."""
    match: str | None = Field(default=None, strict=True, min_length=1)
    """Target spectrum to which each horizontal motion is matched before it is scaled, as `heeltoe motion --match` takes
    it: `en1998:0.3g,B`, `asce7:0.9g,0.4g,8s`, or a file, relative to the study file."""
    unit: str | None = Field(default=None, strict=True)
    """Unit of the numbers in files that do not state it."""
    time_step: TimeSpan | None = None
    """Time between the numbers of files that do not state it."""
    layout: Layout | None = None
    """How the numbers of plain tables run whose headers do not say it: one series along the "rows", or each series down
    one of the "columns"."""
    factor: HeaderFactor | None = None
    """Where the header of a file has a factor (a scale of a table, SCALE of SAC): "multiply" the numbers by it,
    "divide" by it where it is a sensitivity, or leave numbers alone that "contain" it."""
    processing: tuple[CorrectionStep, ...] = ()
    """Steps of processing of every record in their order, before records are matched or scaled; uncorrected records
    need a band-pass or a baseline."""

    @model_validator(mode="after")
    @gathered
    def _one_source(self) -> Iterator[InputError]:
        sources = [name for name in ("folder", "files", "events") if getattr(self, name) is not None]
        if not sources:
            yield InputError("study-motions", "folder")
        if len(sources) > 1:
            yield InputError("fields-conflict", sources[0], other=sources[1])
        if self.unit is not None:
            try:
                acceleration_unit(self.unit, "unit")
            except InputError as error:
                yield error


class FragilityLimits(Fields):
    """Limits beyond which a dam counts as failed, each a list."""

    residual_slip: Annotated[tuple[Slip, ...], BeforeValidator(_listed)] = ()
    """Limits on the slip that remains, either way."""
    peak_slip: Annotated[tuple[Slip, ...], BeforeValidator(_listed)] = ()
    """Limits on the largest slip, either way."""
    opening: Annotated[tuple[Slip, ...], BeforeValidator(_listed)] = ()
    """Limits on the largest opening at either face."""
    rotation: Annotated[tuple[Rotation, ...], BeforeValidator(_listed)] = ()
    """Limits on the largest rotation: plain numbers in rad, or with their unit."""
    cracked_length: Annotated[tuple[Length, ...], BeforeValidator(_listed)] = ()
    """Limits on the length of a bonded joint that cracks; a little less than its width stands for cracked through."""
    crest_displacement: Annotated[tuple[Slip, ...], BeforeValidator(_listed)] = ()
    """Limits on the horizontal displacement of the crest, either way, relative to the ground."""
    crest_acceleration: Annotated[tuple[AccelerationField, ...], BeforeValidator(_listed)] = ()
    """Limits on the horizontal acceleration of the crest with that of the ground, either way."""


class Fragility(Fields):
    """Fragility curves: the probability that a limit is exceeded, given how strong the motion is."""

    limits: FragilityLimits
    """One curve each."""
    measure: Measure = "pga"
    """How strong the motion is."""
    period: Annotated[Duration, Field(ge=0.01, le=20.0)] | None = None
    """Period of `sa`."""
    confidence: Annotated[DimensionlessNumber, Field(ge=0.5, lt=1.0)] = 0.9
    """Probability of the intervals."""


class Hazard(Fields):
    """The hazard at the site: how often a year the ground exceeds a strength, by the measure of the
    fragility curves."""

    curve: (
        Annotated[tuple[tuple[Value, Annotated[DimensionlessNumber, Field(gt=0.0)]], ...], Field(min_length=2)] | None
    ) = None
    """Pairs of a strength, ascending, and the annual rate at which it is exceeded: `[["0.1 g", 0.01], ...]`."""
    file: str | None = Field(default=None, strict=True, min_length=1)
    """A file of the same, relative to the study file: two columns with headings, `pga [g], annual rate`, of which the
    second may hold return periods or probabilities in N years; or a curve as OpenQuake or NSHMP writes it."""
    at: Annotated[tuple[Value, ...], BeforeValidator(_listed)] = ()
    """Strengths at which the probability of each limit is wanted, beside those of the curve: `["0.3 g"]`."""

    @model_validator(mode="after")
    @collected
    def _one_source(self) -> Self:
        if self.curve is None and self.file is None:
            raise InputError("missing-field", "curve", example='curve = [["0.1 g", 0.01], ["0.5 g", 0.0004]]')
        if self.curve is not None and self.file is not None:
            raise InputError("fields-conflict", "curve", other="file")
        return self


class Study(Shown, Fields):
    """Many runs of one dam: what varies, and how."""

    title: str = Field(default="", strict=True)
    """Title of the results (default: that of the case)."""
    case: str = Field(strict=True, min_length=1)
    """The base case: a file, relative to the study file."""
    cases: str | None = Field(default=None, strict=True, min_length=1)
    """A table of dams, a CSV file relative to the study file: one row a dam, fields by name with their units in the
    header, `section.height [m]`, and a column `name`. All else of a dam is as in the base case."""
    model: Annotated[tuple[Model, ...], BeforeValidator(_listed), Field(min_length=1)] = ("rigid",)
    """The model, or several side by side on the same dams and motions."""
    method: Method = "grid"
    """Every combination of the values; each field by itself, the others as in the case; a Latin hypercube; Sobol's
    sequence; or what Sobol's sensitivity indices need."""
    samples: Count | None = None
    """How many dams are drawn, where the method draws any; `sensitivity` runs each once for each field, and twice."""
    seed: Annotated[int, Field(strict=True, ge=0, le=2**63 - 1)] = 1
    """Seed of the draws: the same seed gives the same runs."""
    vary: dict[str, Values] = Field(default_factory=dict)
    """Fields of the case by their paths: a list of values, or a distribution."""
    correlation: tuple[tuple[str, str, Annotated[DimensionlessNumber, Field(gt=-1.0, lt=1.0)]], ...] = ()
    """Pairs of fields that are drawn together, and the rank correlation of each."""
    motions: Motions | None = None
    """The earthquakes."""
    fragility: Fragility | None = None
    """Limits and curves."""
    hazard: Hazard | None = None
    """The hazard at the site, for annual probabilities of the limits of `fragility`."""
    suite: SuiteRule | None = None
    """The table of a suite of records, for one dam at one strength of each motion."""

    _directory: Path = PrivateAttr(default_factory=Path)

    @classmethod
    def of(cls, fields: Mapping[str, Any], directory: Path) -> Self:
        """Return the study of some fields, as a file has them, with relative paths from a directory.

        Raises
        ------
        InputError
            The first thing that is wrong, with the others.
        """
        try:
            study = cls.model_validate(fields)
        except ValidationError as error:
            raise first_error(error, cls) from None
        study._directory = directory
        return study

    @property
    def directory(self) -> Path:
        """Where relative paths start: that of the study file, or the current one."""
        return self._directory

    @property
    def drawn(self) -> bool:
        """Whether dams are drawn, not listed."""
        return self.method in ("latin hypercube", "sobol", "sensitivity")

    @model_validator(mode="after")
    @gathered
    def _agree(self) -> Iterator[InputError]:
        if self.drawn and self.samples is None:
            yield InputError("missing-field", "samples", example="samples = 1000")
        if not self.drawn and self.samples is not None:
            yield InputError("needs-other", "samples", other="a method that draws")
        if self.correlation and self.method not in ("latin hypercube", "sobol"):
            yield InputError("needs-other", "correlation", other='method "latin hypercube" or "sobol"')
        if self.method in ("sobol", "sensitivity") and self.samples and self.samples & (self.samples - 1):
            near = 2 ** max(1, self.samples.bit_length() - 1)
            yield InputError(
                "wrong-quantity",
                "samples",
                self.samples,
                kind="a power of two, which Sobol's points need",
                example=f"{near} or {2 * near}",
            )
        if self.hazard is not None and self.fragility is None:
            yield InputError("needs-other", "hazard", other="[fragility] with limits")
        if self.cases is not None and (self.vary or self.method != "grid"):
            yield InputError("fields-conflict", "cases", other="vary" if self.vary else "method")
        if self.suite is not None and (self.cases or self.vary or self.drawn or self.motions is None):
            yield InputError("suite-one-dam", "suite")
        if len(set(self.model)) < len(self.model):
            yield InputError("listed-twice", "model", shown(list(self.model)))
        for place, (first, second, _) in enumerate(self.correlation if self.drawn else ()):
            for name in (first, second):
                if not isinstance(self.vary.get(name), Distribution):
                    yield InputError("study-correlation", f"correlation[{place}]", shown(name))
            if first == second:
                yield InputError("study-correlation", f"correlation[{place}]", shown(first))
        for path in self.vary:
            if re.split(r"[.\[]", path, maxsplit=1)[0] in ("motion", "aftershocks"):
                yield InputError("study-motion-varies", f"vary.{path}")


def untitled(study: Mapping[str, Any], records: int, dams: int = 0) -> str:
    """Return what a study without a title is called, by its fields as a file has them: what it varies."""
    if study.get("suite"):
        return f"suite of {counted(records, 'record')}"
    if study.get("cases"):
        return f"portfolio of {counted(dams, 'dam')}"
    names = list(study.get("vary") or ())
    if not names:
        return f"study of {counted(records, 'ground motion')}"
    return f"study of {' and '.join(names) if len(names) < 3 else f'{len(names)} fields'}"


def read_study(source: str | PathLike[str]) -> Study:
    """Read and check a study file, without what it names.

    Raises
    ------
    InputError
        The first thing that is wrong, with the others.
    """
    path = Path(source)
    fields = read_fields(path, "a study file; `heeltoe examples` writes some")
    if "section" in fields and fields.keys().isdisjoint(("case", "cases")):
        raise InputError(
            "another-kind",
            str(path),
            "a case",
            wanted="a study",
            remedy=f'run it with "heeltoe run", or name it in a study file: case = "{path.name}"',
        )
    return Study.of(fields, path.parent)
