"""A suite of records: the earthquakes that one dam meets one by one, how strong they are, and how they are judged."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag, model_validator

from heeltoe.case.fields import Fields, TimeSpan, Truth
from heeltoe.case.motion import Layout
from heeltoe.case.processing import CorrectionStep
from heeltoe.case.quantities import AccelerationField, Duration
from heeltoe.case.sentences import gathered
from heeltoe.errors.error import InputError
from heeltoe.motion.records import HeaderFactor
from heeltoe.units.parse import STANDARD_GRAVITY, acceleration_unit

#: A period, or that of the first mode of the dam.
PeriodField = Annotated[
    Annotated[Literal["T1"], Tag(" ")] | Annotated[Duration, Field(ge=0.01, le=20.0), Tag("")],
    Discriminator(lambda value: " " if value == "T1" else ""),
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
    cross_valley: Truth = False
    """Whether the two horizontal components of each earthquake, recognised by station and direction in the files and
    else by their names, shake the dam together: each one along the stream with the other across the valley, and each
    one alone, for the factor between the two. Blocks alone follow that."""
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
