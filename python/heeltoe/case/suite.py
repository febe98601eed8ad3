"""A suite of records: the earthquakes that one dam meets one by one, how strong they are, and how they are judged."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Annotated, Literal, NamedTuple

from pydantic import Discriminator, Field, PlainValidator, Tag, WithJsonSchema, model_validator

from heeltoe.case.fields import Fields, TimeSpan, Truth
from heeltoe.case.motion import Layout
from heeltoe.case.processing import CorrectionStep
from heeltoe.case.quantities import AccelerationField, Duration
from heeltoe.case.sentences import collected, gathered
from heeltoe.errors.error import InputError, shown
from heeltoe.motion.records import HeaderFactor
from heeltoe.units.parse import STANDARD_GRAVITY, acceleration_unit, parse

#: A period, or that of the first mode of the dam.
PeriodField = Annotated[
    Annotated[Literal["T1"], Tag(" ")] | Annotated[Duration, Field(ge=0.01, le=20.0), Tag("")],
    Discriminator(lambda value: " " if value == "T1" else ""),
]


# A step between azimuths divides the half circle into whole ones, no more than these.
_MOST_AZIMUTHS = 180


class CrossValley(NamedTuple):
    """How the two horizontal components of an earthquake shake a dam.

    Attributes
    ----------
    share
        Peak of the component across the valley over that of the one along the stream, each of them along in turn; None
        where both have one factor.
    step
        Between the azimuths of the stream to which both are rotated [deg]; None where the stream runs along each of
        them in turn.
    """

    share: float | None = None
    step: float | None = None


def _written_cross_valley(value: object) -> bool | str:
    """Check how two components go together, as it is written."""
    if isinstance(value, bool):
        return value
    cross_valley_of(value if isinstance(value, str) else shown(value))
    return str(value)


def cross_valley_of(value: bool | str) -> CrossValley:
    """Return what a field ``cross_valley`` asks for; of true, and of false, there is nothing more to say.

    Raises
    ------
    InputError
        Where a text is neither a share nor a step of an azimuth that divides 180 degrees.
    """
    if isinstance(value, bool):
        return CrossValley()
    if value.rstrip().endswith("%"):
        share = parse(value, "number", "")
        if not 0.0 < share <= 10.0:
            raise InputError("out-of-range", "", value, bound="above 0 % and up to 1000 %")
        return CrossValley(share=share)
    step = math.degrees(parse(value, "angle", ""))
    count = 180.0 / step if step > 0.0 else 0.0
    if not 1.0 <= round(count) <= _MOST_AZIMUTHS or abs(count - round(count)) > 1e-9 * count:
        raise InputError("out-of-range", "", value, bound="that divides 180 deg, of 1 deg or more")
    return CrossValley(step=180.0 / round(count))


#: Whether, and how, the two horizontal components of each earthquake shake a dam together.
CrossValleyField = Annotated[
    bool | str,
    PlainValidator(collected(_written_cross_valley)),
    WithJsonSchema({"type": ["boolean", "string"], "examples": ["30 %", "15 deg"]}),
]


class SuiteMotion(Fields):
    """One earthquake of a suite, or a folder of them."""

    file: str = Field(strict=True, min_length=1)
    """A record: its file, relative to the case file, its name in the catalogue, or a motion made to order; or a folder,
    each horizontal record of which is one earthquake."""
    vertical: str | None = Field(default=None, strict=True, min_length=1)
    """The vertical component of the same earthquake, scaled by the same factor."""


class SuiteRule(Fields):
    """How a suite of records is judged: one dam in several earthquakes."""

    judge: Literal["largest", "mean", "median", "84%"] = "largest"
    """Statistic over the records that is compared with the limits of the case."""
    target: str | None = Field(default=None, strict=True, min_length=1)
    """Target spectrum to draw with those of the records, written as `motions.match`; that one where it is given."""


class Suite(SuiteRule):
    """How strong the records of `[[motions]]` are, and how the suite is judged."""

    pga: AccelerationField | None = None
    """Scale each record to this peak acceleration; as recorded where neither this nor `sa` is given."""
    sa: AccelerationField | None = None
    """Scale each record to this spectral acceleration at `period`, 5 % damping."""
    period: PeriodField | None = None
    """Period of `sa`: "0.3 s", or "T1", the default, for the first period of the intact dam with its water and rock."""
    match: str | None = Field(default=None, strict=True, min_length=1)
    """Target spectrum to which each record is matched before it is scaled: `en1998:0.3g,B`, `asce7:0.9g,0.4g,8s`, or a
    file, relative to the case file."""
    both_signs: Truth | None = None
    """Whether each record runs both ways round: it does unless `motion.sign` says which way round motions are."""
    vertical: Truth = False
    """Whether vertical components of folders, recognised by their names, shake the dam with each horizontal one."""
    disaggregation: str | None = Field(default=None, strict=True, min_length=1)
    """File of OpenQuake's disaggregation by magnitude and distance (Mag_Dist), relative to the case file; of several
    measures and probabilities one, `FILE#PGA,0.02`. Each record is labelled with the share of the hazard from
    earthquakes like its own."""
    cross_valley: CrossValleyField = False
    """Whether the two horizontal components of each earthquake, recognised by station and direction in the files and
    else by their names, shake the dam together: each one along the stream with the other across the valley, and each
    one alone, for the factor between the two. "30 %" gives the other one this share of the peak along the stream; "15
    deg" rotates both to streams of all azimuths in such steps, of which the worst counts."""
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
    def _agree(self) -> Iterator[InputError]:
        if self.pga is not None and self.sa is not None:
            yield InputError("fields-conflict", "pga", other="sa")
        if self.period is not None and self.sa is None:
            yield InputError("needs-other", "period", other="sa")
        for name in ("pga", "sa"):
            value = getattr(self, name)
            if value is not None and not value.si(STANDARD_GRAVITY) > 0.0:
                yield InputError("out-of-range", name, str(value), bound="above 0")
        if self.unit is not None:
            try:
                acceleration_unit(self.unit, "unit")
            except InputError as error:
                yield error
