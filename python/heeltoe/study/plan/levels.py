"""Levels of earthquake by which a dam is judged: a file in TOML, with a motion, limits and a rule for each level.

title = "Our authority"

[[levels]]
return_period = 1000
pga = "0.2 g"
records = 3
judge = "mean"

[levels.limits]
residual_slip = "0 mm"
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationError, model_validator

from heeltoe.case.fields import Count, Fields, FrictionCoefficient
from heeltoe.case.fields_file import read_fields
from heeltoe.case.model import Case
from heeltoe.case.options import Limits
from heeltoe.case.quantities import AccelerationField, DimensionlessNumber
from heeltoe.case.sentences import first_error, gathered
from heeltoe.case.suite import PeriodField
from heeltoe.errors.error import InputError


class Level(Fields):
    """One level of earthquake."""

    return_period: Annotated[DimensionlessNumber, Field(gt=0.0, le=1e8)]
    """Mean time between such earthquakes, in years."""
    pga: AccelerationField | None = None
    """Scale each record to this peak acceleration; as recorded where neither this nor `sa` is given."""
    sa: AccelerationField | None = None
    """Scale each record to this spectral acceleration at `period`."""
    period: PeriodField | None = None
    """Period of `sa`, as `suite.period` of a case."""
    motions: str | None = Field(default=None, strict=True, min_length=1)
    """Folder of the records of this level, relative to the file; the suite of the case where it is not given."""
    damping: Annotated[DimensionlessNumber, Field(gt=0.0, lt=1.0)] | None = None
    """Damping ratio of the concrete at this level; that of the case where it is not given."""
    records: Count = 1
    """Fewest earthquakes that the suite must have."""
    judge: Literal["largest", "mean", "median", "84%"] = "largest"
    """Which number over the records the limits judge."""
    limits: Limits = Limits()
    """Limits of this level."""
    factor: Annotated[DimensionlessNumber, Field(gt=0.0, le=100.0)] | None = None
    """Factor against sliding that must be left after the earthquake, by the static checks with the judged slip."""
    residual_friction: FrictionCoefficient | None = None
    """Coefficient of friction after the earthquake, of that factor; that of the case where it is not given."""
    during_shaking: Literal["constant", "zero while open", "full while open", "follows opening"] | None = None
    """Uplift in the earthquake, as `uplift.during_shaking`; that of the case where it is not given."""
    closed_drains: Literal["reservoir head", "linear"] | None = None
    """Uplift after it where slip has closed the drains, as `statics.closed_drains`; that of the case where it is not
    given."""

    @model_validator(mode="after")
    @gathered
    def _agree(self) -> Iterator[InputError]:
        if self.pga is not None and self.sa is not None:
            yield InputError("fields-conflict", "pga", other="sa")
        if self.period is not None and self.sa is None:
            yield InputError("needs-other", "period", other="sa")
        if self.residual_friction is not None and self.factor is None:
            yield InputError("needs-other", "residual_friction", other="factor")

    def suite(self) -> dict[str, Any]:
        """Return the fields of the block `[suite]` of a case that this level states."""
        period = f"{self.period!r} s" if isinstance(self.period, float) else self.period
        written = {name: None if value is None else str(value) for name, value in (("pga", self.pga), ("sa", self.sa))}
        return {**written, "period": period, "judge": self.judge}


class Levels(Fields):
    """Criteria by level of earthquake."""

    title: str = Field(default="", strict=True)
    """Whose criteria they are."""
    levels: Annotated[tuple[Level, ...], Field(min_length=1)]
    """The levels."""


def read_levels(path: str | os.PathLike[str]) -> Levels:
    """Read criteria by level.

    Raises
    ------
    InputError
        Where there is no such file, or a field cannot be used.
    """
    file = Path(path)
    fields = read_fields(file, "a file of criteria by level, in TOML")
    try:
        levels = Levels.model_validate(fields)
    except ValidationError as error:
        raise first_error(error, Levels) from None
    folders = [level.motions and str((file.parent / level.motions).resolve()) for level in levels.levels]
    placed = [level.model_copy(update={"motions": at}) for level, at in zip(levels.levels, folders, strict=True)]
    return levels.model_copy(update={"levels": tuple(placed)})


def case_at(case: Case, level: Level) -> Case:
    """Return a case with the limits, the damping and the uplift of a level."""
    own = {
        "concrete.damping": level.damping,
        "uplift.during_shaking": level.during_shaking,
        "statics.closed_drains": level.closed_drains,
    }
    changes = {path: value for path, value in own.items() if value is not None}
    changed = case.with_(changes) if changes else case
    return changed.model_copy(update={"limits": level.limits})
