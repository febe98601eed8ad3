"""The earthquake of a case: source and scale of the ground motion."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Annotated, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from heeltoe.case.fields import LARGEST_ACCELERATION, Channel, Fields, Time, TimeSpan, Truth
from heeltoe.case.processing import ProcessingStep
from heeltoe.case.quantities import AccelerationField, Angle, DimensionlessNumber, PeakField
from heeltoe.case.sentences import collected
from heeltoe.errors.error import InputError, shown
from heeltoe.units.parse import STANDARD_GRAVITY, acceleration_unit

#: A direction, clockwise from north.
Azimuth = Annotated[Angle, Field(ge=-2.0 * math.pi - 1e-9, le=2.0 * math.pi + 1e-9)]
#: How the numbers of a plain table run.
Layout = Literal["rows", "columns"]
#: Fields that belong to a motion from a file.
FILE_OPTIONS = ("channel", "unit", "time_step", "layout", "factor")
NO_MOTION = "none"
"""What leaves out the vertical motion, in a case or on the command line."""


class Source(Fields):
    """A ground motion in one direction: from a record, or drawn by points."""

    file: str | None = Field(default=None, strict=True, min_length=1)
    """A record: its file, relative to the case file, or its name in the catalogue; or a motion made to order, such
    as synthetic:M6.5,20km,seed=3."""
    channel: Channel | None = None
    """Channel of a file that has several, by number or by direction: 1, "90 deg", "up"."""
    points: tuple[tuple[Time, AccelerationField], ...] | None = None
    """[time, acceleration] in order of time, straight in between; twice the same time is a jump."""
    pga: AccelerationField | None = None
    """Scale the motion to this peak acceleration, its largest absolute value."""
    reverse: Truth = False
    """Change the sign of the motion."""
    unit: str | None = Field(default=None, strict=True)
    """Unit of the numbers in a file that does not state it: g, cm/s^2, m/s^2, ..."""
    time_step: TimeSpan | None = None
    """Time between the numbers of a file that does not state it."""
    layout: Layout | None = None
    """How the numbers of a plain table run where its header does not say it: one series along its "rows", or each
    series down one of its "columns"."""
    factor: Annotated[DimensionlessNumber, Field(gt=0.0, le=1e12)] | None = None
    """Where the header of a file has a factor (a scale of a table, SCALE of SAC): that factor, by which the numbers are
    multiplied, 1 over it where it is a sensitivity, or 1 where they contain it."""
    processing: tuple[ProcessingStep, ...] = ()
    """Steps of processing in their order, before the motion is scaled to `pga`."""

    def peak(self, gravity: float, stream: float) -> float | None:
        """Return the wanted peak [m/s2]; `stream` is that of the motion along the stream, of which it may be
        a share."""
        return None if self.pga is None else self.pga.si(gravity)

    def source_text(self) -> str:
        """Say in a few words where the motion comes from."""
        return (self.file or f"{len(self.points or ())} points") + (f", peak {self.pga}" if self.pga else "")

    @model_validator(mode="after")
    @collected
    def _one_source(self) -> Self:
        if self.file is not None and self.points is not None:
            raise InputError("fields-conflict", "file", other="points")
        if self.file is None and self.points is None:
            raise InputError("motion-source", "")
        if self.points is not None:
            times = [time for time, _ in self.points]
            if len(times) < 2 or times[0] == times[-1] or any(b < a for a, b in pairwise(times)):
                raise InputError(
                    "not-ascending",
                    "points",
                    shown(times),
                    what="the times",
                    remedy="at least two points in order of time",
                )
            for place, (_, value) in enumerate(self.points):
                if abs(value.si(STANDARD_GRAVITY)) > LARGEST_ACCELERATION:
                    raise InputError("out-of-range", f"points[{place}][1]", str(value), bound="from -10 g to 10 g")
            for option in FILE_OPTIONS:
                if getattr(self, option) is not None:
                    raise InputError(
                        "option-foreign",
                        option,
                        owner="a motion given by points",
                        remedy=", or give file instead of points",
                    )
        if self.unit is not None:
            acceleration_unit(self.unit, "unit")
        # The case's own g plays no part in what is plausible.
        peak = self.peak(STANDARD_GRAVITY, STANDARD_GRAVITY)
        if peak is not None and not 0.0 < peak <= LARGEST_ACCELERATION:
            if isinstance(self.pga, float):
                share = f"{100.0 * LARGEST_ACCELERATION / STANDARD_GRAVITY:g} %"
                raise InputError(
                    "out-of-range", "pga", f'"{100.0 * self.pga:g} %"', bound=f"above 0 % and up to {share}"
                )
            raise InputError("out-of-range", "pga", str(self.pga), bound="above 0 g and up to 10 g")
        return self


class HorizontalSource(Source):
    """A horizontal ground motion."""

    direction: Azimuth | None = None
    """Where the component counts positive, clockwise from north, for `motion.azimuth`; by default its record or its
    name states it."""


class CrossSource(HorizontalSource):
    """A ground motion across the valley."""

    pga: PeakField | None = None  # type: ignore[assignment]  # wider than that of other motions
    """Scale the motion to this peak acceleration, or to this share of that along the stream: "30 %" is what rules of
    combination take."""

    def peak(self, gravity: float, stream: float) -> float | None:
        """Return the wanted peak [m/s2], as :meth:`Source.peak`."""
        return self.pga * stream if isinstance(self.pga, float) else super().peak(gravity, stream)


class Motion(HorizontalSource):
    """The ground motion: horizontal, positive downstream, with vertical and cross-valley ones on request."""

    azimuth: Azimuth | None = None
    """Direction of the stream, clockwise from north: the motion and that across the valley, whose own directions are
    those of their records, are rotated into along and across it before they are scaled."""
    duration: TimeSpan | None = None
    """Length of the run, counted from where the record begins; the whole record where it is not given."""
    sign: Literal["recorded", "reversed"] | None = None
    """Which way round the motion shakes the dam. Where the case does not say, here or by `reverse`, both ways are run
    and the worse one leads; `points` are as they are written."""
    at: Literal["surface", "rock"] = "surface"
    """Where the ground has this motion: on the free surface of the rock (outcrop), as records and hazard curves have
    it; or within the rock, as a deconvolution leaves it, which no model takes."""
    allow_zero: Truth = False
    """Accept a motion that is zero throughout, which is otherwise taken for a mistake."""
    vertical: Annotated[
        Source | None,
        BeforeValidator(
            lambda value: None if value == NO_MOTION else value, json_schema_input_type=Source | Literal["none"] | None
        ),
    ] = None
    """The vertical motion of the same earthquake, positive up; without a peak of its own it is scaled as the horizontal
    one is. "none" leaves it out."""

    cross_valley: Annotated[
        CrossSource | None,
        BeforeValidator(
            lambda value: None if value == NO_MOTION else value,
            json_schema_input_type=CrossSource | Literal["none"] | None,
        ),
    ] = None
    """The horizontal motion across the valley of the same earthquake, positive to the left bank; without a peak of its
    own it is scaled as the motion along the stream is, and what outlasts that is cut off. Its sign mirrors the slip
    across the valley and changes nothing else. "none" leaves it out."""

    @model_validator(mode="after")
    @collected
    def _check_sign(self) -> Self:
        if self.sign is not None and "reverse" in self.model_fields_set:
            raise InputError("contradiction", "sign", f'"{self.sign}"', other=f"reverse = {str(self.reverse).lower()}")
        return self

    @model_validator(mode="after")
    @collected
    def _check_place(self) -> Self:
        if self.at == "rock":
            raise InputError("motion-in-rock", "at", '"rock"')
        return self

    @model_validator(mode="after")
    @collected
    def _check_azimuth(self) -> Self:
        if self.azimuth is not None and self.cross_valley is None:
            raise InputError("needs-other", "azimuth", other="cross_valley, the other horizontal component")
        if self.azimuth is None:
            for name, source in (("", self), ("cross_valley.", self.cross_valley)):
                if source is not None and source.direction is not None:
                    raise InputError("needs-other", f"{name}direction", other="azimuth")
        return self

    @property
    def is_reversed(self) -> bool:
        """Whether it is turned round before it shakes the dam."""
        return self.reverse or self.sign == "reversed"

    @property
    def has_sign(self) -> bool:
        """Whether the case says which way round it shakes the dam: points of the case are what its author means."""
        return self.sign is not None or self.points is not None or "reverse" in self.model_fields_set


class Aftershock(Motion):
    """A ground motion that the dam meets after another one, as that has left it."""

    pause: Annotated[TimeSpan, Field(le=100.0)] = Field(default="10 s", validate_default=True)
    """How long the ground stands still before it, so that the dam comes to rest; longer than 100 s changes nothing."""
