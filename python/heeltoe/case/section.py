"""The section of the dam: dimensions, slopes of its faces, corners, or a file of them."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import Annotated

from pydantic import Field, model_validator

from heeltoe.case.fields import Fields, Head
from heeltoe.case.quantities import DimensionlessNumber, Length
from heeltoe.case.sentences import gathered
from heeltoe.errors.error import InputError, shown
from heeltoe.geometry.faces import corners_between

Slope = Annotated[DimensionlessNumber, Field(ge=-2.0, le=10.0)]
_SIZES = ("height", "crest_width")
_NECK = ("neck_height", "neck_width")
_FACES = ("upstream", "downstream")


class Section(Fields):
    """The section of the dam: five dimensions, the slopes of its faces, any polygon, or a file of its corners; x points
    downstream, z up.

    The dimensions describe a dam with a vertical upstream face at x = 0. Its downstream face runs straight
    from the base to the neck and straight on to the crest (Zhu 2004); without a neck it is one straight line. Slopes
    describe both faces from the base up, below a crest whose upstream edge is at x = 0.
    """

    height: Annotated[Length, Field(gt=0.0)] | None = None
    """From the base to the crest."""
    crest_width: Annotated[Length, Field(ge=0.0)] | None = None
    """Width at the crest."""
    neck_height: Annotated[Length, Field(gt=0.0)] | None = None
    """From the base to the neck, where the slope of the downstream face changes."""
    neck_width: Annotated[Length, Field(gt=0.0)] | None = None
    """Width at the neck."""
    base_width: Annotated[Length, Field(gt=0.0)] | None = None
    """Width at the base."""
    upstream: tuple[tuple[Head, Slope], ...] | None = None
    """Slopes of the upstream face, each from an elevation above the base on: [elevation, horizontal per vertical],
    positive where the dam is wider below; vertical without it."""
    downstream: tuple[tuple[Head, Slope], ...] | None = None
    """Slopes of the downstream face, as those of the upstream one."""
    polygon: tuple[tuple[Length, Length], ...] | None = None
    """Corners [x, z] in order around the section, either way."""
    file: str | None = Field(default=None, strict=True, min_length=1)
    """A drawing (DXF), a mesh (.msh, .inp) or a table of corners (CSV), relative to the case file; read once, into
    `polygon`."""
    layer: str | None = Field(default=None, strict=True, min_length=1)
    """Layer of a drawing with the closed outline of the section, or element sets of a mesh; needed where there are
    several, or other lines. Beside `polygon`: where this was drawn, which answers name."""
    unit: str | None = Field(default=None, strict=True, min_length=1)
    """Unit of the numbers in the file, in place of the one that it states."""

    @model_validator(mode="after")
    @gathered
    def _one_form(self) -> Iterator[InputError]:
        names = [name for name in type(self).model_fields if getattr(self, name) is not None]
        if self.file is not None:
            # The contents of a file replace these fields before they are read.
            yield InputError("section-file-unread", "file", shown(self.file))
            return
        of_file = ("unit",) if self.polygon is not None else ("layer", "unit")
        yield from (InputError("needs-other", name, other="a file") for name in of_file if name in names)
        names = [name for name in names if name not in ("layer", "unit")]
        if self.polygon is not None:
            yield from (InputError("fields-conflict", name, other="polygon") for name in names if name != "polygon")
            return
        faces = [name for name in _FACES if name in names]
        if faces:
            foreign = [name for name in names if name not in (*_SIZES, *faces)]
            yield from (InputError("fields-conflict", name, other=faces[0]) for name in foreign)
            yield from self._missing(_SIZES)
            for name in faces:
                yield from self._wrong_face(name)
            return
        # Half a neck is a slip of the pen, no neck is a plain trapezoid.
        yield from self._missing((*_SIZES, "base_width", *(_NECK if set(_NECK) & set(names) else ())))
        if self.neck_height is not None and self.height is not None and self.neck_height > self.height:
            yield InputError(
                "above-other", "neck_height", f"{self.neck_height:g} m", other="the crest", most=f"{self.height:g} m"
            )

    def _missing(self, names: tuple[str, ...]) -> Iterator[InputError]:
        for name in names:
            if getattr(self, name) is None:
                yield InputError("missing", name, remedy=f"give {', '.join(names)}; or slopes, a polygon or a file")

    def _wrong_face(self, name: str) -> Iterator[InputError]:
        levels = [level for level, _ in getattr(self, name)]
        if not levels or levels[0] != 0.0 or any(upper <= lower for lower, upper in pairwise(levels)):
            yield InputError(
                "not-ascending",
                name,
                shown([f"{level:g} m" for level in levels]),
                what="the elevations",
                remedy="the base at 0 m first, then each break",
            )
        elif self.height is not None and levels[-1] >= self.height:
            yield InputError("out-of-range", name, f"{levels[-1]:g} m", bound=f"below the crest at {self.height:g} m")

    def vertices(self) -> tuple[tuple[float, float], ...]:
        """Return the corners (x, z) [m] around the section, as given or counter-clockwise from the heel."""
        if self.polygon is not None:
            return self.polygon
        # The validator has seen that these are there.
        assert self.height is not None
        assert self.crest_width is not None
        if self.base_width is None:
            return corners_between(self.upstream or (), self.downstream or (), self.height, self.crest_width)
        neck = () if self.neck_width is None or self.neck_height is None else ((self.neck_width, self.neck_height),)
        return (0.0, 0.0), (self.base_width, 0.0), *neck, (self.crest_width, self.height), (0.0, self.height)
