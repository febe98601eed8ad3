"""A whole case: one dam, one crack, one earthquake, and what is derived from its fields."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property, partial
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Literal, Self

import numpy as np
import shapely
from pydantic import Field, PrivateAttr, ValidationError, model_validator

from heeltoe.base.arrays import Floats
from heeltoe.base.display import Shown
from heeltoe.case.at_crack import AnchorAtCrack, anchor_at_crack, flat, too_flat, uplift_at_crack
from heeltoe.case.changes import apply
from heeltoe.case.combinations import conflicts
from heeltoe.case.crack.crack import Crack, FurtherCrack
from heeltoe.case.crack.fit_file import with_fit_read
from heeltoe.case.crack.kinks import climbs, kinks_misfit
from heeltoe.case.dam import Anchor, Concrete, Ice, Reservoir, Rock, Silt, Uplift, Water
from heeltoe.case.fields import Fields
from heeltoe.case.joints import JOINTS
from heeltoe.case.lists import CRACKS, aliases_of, as_blocks, as_listed, crack_path, renamed
from heeltoe.case.motion import Aftershock, Motion
from heeltoe.case.options import Analysis, Decoupled, Flexible, Limits, StaticsChoice
from heeltoe.case.project import Project
from heeltoe.case.quantities import Gravity
from heeltoe.case.section import Section
from heeltoe.case.section_file import with_section_read
from heeltoe.case.sentences import all_errors, gathered
from heeltoe.case.suite import Suite, SuiteMotion
from heeltoe.case.surroundings import Surroundings, surroundings_of
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain
from heeltoe.geometry.levels import cut_levels
from heeltoe.geometry.section import ON_LINE, CutSection, above_line, cut, outline, outside
from heeltoe.units.parse import InSI

# Water so many times as deep as the dam is high is a slip of the pen.
_DEEPEST = 2.0
# Cracks nearer to each other than this part of the height of the section leave no part of the dam between them.
_NEAREST = 1e-3
# A block that the file leaves out: the validator of the case fills it, so that none of its own is built.
_LEFT_OUT: Any = Field(default_factory=dict, validate_default=True)


class Case(Shown, Fields):
    """One dam, one crack, one earthquake. Per metre of dam, SI units."""

    title: str = Field(default="", strict=True)
    """Title of the results."""
    units: Literal["si", "us"] = "si"
    """Units in which everything is shown: SI, or those of the United States; files of numbers stay SI."""
    project: Project = _LEFT_OUT
    """The title block of the report."""
    gravity: Annotated[Gravity, Field(ge=0.01, le=1e4)] = Field(default="9.80665 m/s^2", validate_default=True)
    """Acceleration of gravity, for weights and for motions given in g."""
    section: Section
    """The section of the dam."""
    concrete: Concrete = _LEFT_OUT
    """The concrete."""
    crack: Crack
    """The crack; or the list `[[cracks]]` of one or several, from the crest down."""
    further_cracks: tuple[FurtherCrack, ...] = ()
    """Cracks beside that of `[crack]`, in any order; `[[cracks]]` lists all of them."""
    reservoir: Reservoir | None = None
    """The water upstream."""
    tailwater: Water | None = None
    """The water downstream."""
    rock: Rock | Literal["rigid"] | None = None
    """The rock below an elastic dam: a block, or the word "rigid"; where neither stands, rock with the modulus of the
    concrete is assumed."""
    ice: Ice | None = None
    """The ice upstream."""
    silt: Silt | None = None
    """The silt upstream."""
    anchors: tuple[Anchor, ...] = ()
    """Anchors and bars across the crack."""
    uplift: Uplift = _LEFT_OUT
    """The water in the crack."""
    motion: Motion | None = None
    """The earthquake; statics needs none."""
    aftershocks: tuple[Aftershock, ...] = ()
    """Motions after the first; each meets the dam as the motion before has left it. A file may also list all of them as
    `[[motion]]`."""
    motions: tuple[SuiteMotion, ...] = ()
    """A suite of records, which the dam meets one by one, each from rest; `heeltoe run` runs all of them."""
    suite: Suite = _LEFT_OUT
    """How strong the records of the suite are, and how it is judged."""
    flexible: Flexible = _LEFT_OUT
    """Choices of the flexible model."""
    decoupled: Decoupled = _LEFT_OUT
    """Choices of the decoupled chain."""
    statics: StaticsChoice = _LEFT_OUT
    """Static checks."""
    limits: Limits = _LEFT_OUT
    """Limits on the results."""
    analysis: Analysis = _LEFT_OUT
    """End of the run, large rotations, limits of time and memory."""

    def __repr__(self) -> str:
        levels = [z for _, z in self.section.vertices()]
        parts = [
            f"dam of {max(levels) - min(levels):.4g} m",
            f"crack at {self.crack.elevation:.4g} m, {self.crack.friction_text()}",
            *(f"another at {crack.elevation:.4g} m" for crack in self.further_cracks),
            f"water of {self.reservoir.depth:.4g} m" if self.reservoir else "no water",
            plain(self.motion.source_text()) if self.motion else "no motion",
        ]
        return f"<Case {self.title or 'untitled'!r}: {'; '.join(parts)}>"

    __str__ = __repr__

    @model_validator(mode="after")
    @gathered
    def _agree(self) -> Iterator[InputError]:
        if self.reservoir is None:
            for name in ("ice", "silt"):
                if getattr(self, name) is not None:
                    yield InputError("needs-other", name, other="a reservoir")
            if self.uplift.during_shaking == "full while open":
                yield InputError("needs-other", "uplift.during_shaking", other="a reservoir")
        elif self.ice is not None and self.ice.depth >= self.reservoir.depth:
            yield InputError(
                "out-of-range",
                "ice.depth",
                f"{self.ice.depth:g} m",
                bound=f"from 0 m to {self.reservoir.depth:g} m, within the water",
            )
        for name in ("reservoir", "tailwater"):
            water = getattr(self, name)
            if water and water.follows_vertical_motion and self.motion and not self.motion.vertical:
                yield InputError("needs-other", f"{name}.follows_vertical_motion", other="motion.vertical")
        if self.aftershocks and self.motion is None:
            yield InputError("needs-other", "aftershocks", other="a motion")
        yield from conflicts(self)
        if not self.further_cracks:
            for name in ("uplift", "uplift_intensity"):
                if getattr(self.crack, name) is not None:
                    yield InputError("needs-other", f"crack.{name}", other="several cracks ([uplift] is that of one)")
        if self.statics.drain_diameter is not None and self.uplift.pattern != "drained":
            yield InputError("needs-other", "statics.drain_diameter", other='uplift.pattern = "drained"')

    @classmethod
    def of(
        cls, fields: Mapping[str, Any], directory: Path | None = None, written: Mapping[str, str] | None = None
    ) -> Case:
        """Return the case of some fields, as a file has them, with relative paths from a directory, the current one
        where none is given; `written` is how the user called cracks, by their paths in the fields.

        Raises
        ------
        InputError
            The first thing that is wrong, with the others.
        """
        case, wrong = problems(fields, directory or Path(), written)
        if case is None:
            raise wrong[0].with_others(wrong[1:])
        return case.based_in(directory or Path())

    def with_(self, *changes: str | Mapping[str, Any]) -> Case:
        """Return the case with some fields changed, read and checked as from a file; this one does not change.

        Parameters
        ----------
        changes
            Fields by their paths, with units as in a file: ``case.with_("crack.friction=1.2", "reservoir.depth=95m")``,
            or from a program ``case.with_({"crack.friction": mu, "reservoir.depth": f"{depth} m"})``. Blocks may be
            nested, ``{"crack": {"friction": mu}}``, and keep their other fields; what says the same thing in another
            way goes, as `motion.points` where `motion.file` is given. None takes back what the case says.

        Raises
        ------
        InputError
            Where a change cannot be used, or does not go together with the rest.
        """
        fields = self.model_dump(mode="json", exclude_unset=True)
        if self._lists_cracks:
            fields = as_listed(fields)
        return Case.of(fields, self.base_directory, apply(fields, changes, self.base_directory))

    def with_numbers(self, changes: Mapping[str, object]) -> Case:
        """Return the case with some fields changed as by :meth:`with_`, at once: blocks without a change are not read
        again, and no number becomes a text on the way.

        Parameters
        ----------
        changes
            Values by their paths: numbers with a unit as :class:`heeltoe.units.parse.InSI` or accelerations.

        Raises
        ------
        InputError
            Where a change cannot be used, or does not go together with the rest.
        """
        changed = {path.partition(".")[0] for path in changes}
        blocks = {name: value for name in self.model_fields_set if (value := getattr(self, name)) is not None}
        fields = {name: _in_si(value) if name in changed else value for name, value in blocks.items()}
        apply(fields, changes)
        case, wrong = _checked(fields, [], listed=self._lists_cracks)
        if case is None:
            raise wrong[0].with_others(wrong[1:])
        return case.based_in(self.base_directory)

    def without_evidence(self) -> Case:
        """Return the case whose elastic runs have no evidence."""
        return self.model_copy(update={"flexible": self.flexible.with_evidence("none")})

    @cached_property
    def surroundings(self) -> Surroundings:
        """Rock and water around an elastic dam: those of the case, or what is assumed where it says nothing."""
        return surroundings_of(self)

    @property
    def foundation(self) -> Rock | None:
        """The rock below an elastic dam; None where it stands on a rigid plane."""
        return self.surroundings.rock

    def has_sound(self, side: str) -> bool:
        """Whether sound travels in the water on a side, ``"reservoir"`` or ``"tailwater"``, before an elastic dam."""
        return side in self.surroundings.sound

    @property
    def has_compressible_water(self) -> bool:
        """Whether sound travels in the water on either side."""
        return bool(self.surroundings.sound)

    def with_water_as_mass(self) -> Case:
        """Return the case whose water is incompressible, and so a mass that moves with the dam."""
        if not self.has_compressible_water:
            return self
        sides = {"reservoir": self.reservoir, "tailwater": self.tailwater}
        return self.model_copy(
            update={
                side: water.model_copy(update={"compressible": False})
                for side, water in sides.items()
                if water is not None
            }
        )

    def on_rock(self, modulus: float) -> Case:
        """Return the case on the same rock with another modulus [Pa]."""
        assert self.foundation is not None
        return self.model_copy(update={"rock": self.foundation.model_copy(update={"modulus": modulus})})

    def on_rigid_plane(self) -> Case:
        """Return the case on a rigid plane, before water that is a mass."""
        return self.with_water_as_mass().model_copy(update={"rock": "rigid"})

    def reversal(self) -> dict[str, object]:
        """Return the changes that reverse all of its motions."""
        if self.motion is None:
            return {}
        changes: dict[str, Any] = {"motion.reverse": not self.motion.is_reversed, "motion.sign": None}
        if self.aftershocks:
            reverse = [
                motion.model_copy(update={"reverse": not motion.is_reversed, "sign": None})
                for motion in self.aftershocks
            ]
            changes["aftershocks"] = [motion.model_dump(mode="json", exclude_unset=True) for motion in reverse]
        return changes

    _base_directory: Path = PrivateAttr(default_factory=Path)
    # Whether its file has the list [[cracks]], by which messages call its cracks.
    _lists_cracks: bool = PrivateAttr(default=False)

    @property
    def base_directory(self) -> Path:
        """Where relative paths of motions start: the directory of the case file, or the current one."""
        return self._base_directory

    @cached_property
    def outline(self) -> shapely.Polygon:
        """The whole section, counter-clockwise [m].

        Raises
        ------
        InputError
            Where the corners are too few, or the outline crosses or touches itself.
        """
        return outline(self.section.vertices(), "section" if self.section.polygon is None else "section.polygon")

    @cached_property
    def cut(self) -> CutSection:
        """The part of the section above the crack.

        Raises
        ------
        InputError
            Where the crack does not cut the section in two along one line.
        """
        elevation, inclination = self.crack.elevation, self.crack.inclination
        if np.ndim(elevation):
            return cut_levels(self.outline, np.asarray(elevation), inclination)
        return cut(self.outline, elevation, inclination)

    @cached_property
    def above(self) -> CutSection:
        """The same, measured above the crack as it is where that has kinks.

        Raises
        ------
        InputError
            Where the crack does not cut the section in two along one line.
        """
        return above_line(self.cut, self.crack_line) if climbs(self.crack.kinks) else self.cut

    @property
    def crack_line(self) -> Floats:
        """Corners of the crack from heel to toe (x, z), shape (k, 2) [m]."""
        section = self.cut
        points = (section.from_crack_frame(*kink) for kink in self.crack.kinks)
        between = [(section.heel[0] + x, section.heel[1] + z) for x, z in points]
        return np.array([section.heel, *between, section.toe])

    @property
    def cracks(self) -> tuple[Crack, ...]:
        """Its cracks from the crest down, each with all of its fields.

        Raises
        ------
        InputError
            Where two cracks meet or cross.
        """
        return tuple(case.crack for case in self.single_crack_cases)

    @cached_property
    def single_crack_cases(self) -> tuple[Case, ...]:
        """The case with one crack alone, for each of its cracks from the crest down.

        Raises
        ------
        InputError
            Where two cracks meet or cross.
        """
        return self._sorted_cracks[0]

    @cached_property
    def asked(self) -> int:
        """Which of its cracks is the first one of the file, that of ``[crack]``."""
        return self._sorted_cracks[1]

    @cached_property
    def _sorted_cracks(self) -> tuple[tuple[Case, ...], int]:
        if not self.further_cracks:
            return (self,), 0
        cases = dict(zip(self.crack_paths, self._cases_as_written(), strict=True))
        first = next(iter(cases))
        ends = {path: _ends_of_crack(path, case, is_first=path == first) for path, case in cases.items()}
        paths = sorted(cases, key=lambda path: -ends[path][0])
        for above, below in pairwise(paths):
            upper, lower = cases[above], cases[below]
            nearest = _NEAREST * (upper.cut.crest_elevation - upper.cut.base_elevation)
            near = any(high - low < nearest for high, low in zip(ends[above], ends[below], strict=True))
            if near or _distance_between(upper, lower) < nearest:
                later = max(above, below, key=list(cases).index)
                one, other = f"{upper.crack.elevation:g} m", f"{lower.crack.elevation:g} m"
                raise InputError("cracks-meet", f"{later}.elevation", one, other=other, least=f"{nearest:g} m")
        if self._lists_cracks and paths != list(cases):
            path, before = next((path, above) for path, above in zip(cases, paths, strict=True) if path != above)
            level = f"{cases[path].crack.elevation:g} m"
            raise InputError("cracks-order", f"{path}.elevation", level, other=before)
        return tuple(cases[path] for path in paths), paths.index(first)

    def _cases_as_written(self) -> Iterator[Case]:
        """Walk the case with one crack alone, for each of its cracks in the order of the file."""
        if not self.further_cracks:
            yield self
            return
        first = self.crack.model_copy(update={"uplift": None, "uplift_intensity": None})
        for crack in (self.crack, *(crack.beside(first) for crack in self.further_cracks)):
            own = crack.model_copy(update={"uplift": None, "uplift_intensity": None})
            yield self.model_copy(update={"further_cracks": (), "crack": own, "uplift": crack.uplift_of(self.uplift)})

    @property
    def crack_paths(self) -> tuple[str, ...]:
        """Paths of its cracks, as its file has them."""
        paths = ("crack", *(f"further_cracks[{place}]" for place in range(len(self.further_cracks))))
        return tuple(self.path_as_written(path) for path in paths)

    def path_as_written(self, path: str) -> str:
        """Return the path of a field as the file of the case has it: of one that lists its cracks, in that list."""
        return crack_path(path) if self._lists_cracks else path

    @cached_property
    def anchors_at_crack(self) -> tuple[AnchorAtCrack, ...]:
        """The anchors by their distance from the heel and their inclination to the normal of the crack; those that do
        not cross it do nothing."""
        return tuple(anchor_at_crack(anchor, self.cut) for anchor in self.anchors)

    @cached_property
    def uplift_at_crack(self) -> Uplift:
        """The uplift with its drains on the crack."""
        return uplift_at_crack(self.crack.uplift_of(self.uplift), self.cut)

    def model_copy(self, *, update: Mapping[str, object] | None = None, deep: bool = False) -> Self:
        """Return a copy with other fields; what was made of those before goes."""
        copy = super().model_copy(update=update, deep=deep)
        for made, of in _MADE_OF.items():
            if update and not update.keys().isdisjoint(of):
                copy.__dict__.pop(made, None)
        return copy

    def based_in(self, directory: Path) -> Case:
        """Return the same case with another base directory."""
        copy = self.model_copy()
        copy._base_directory = directory
        return copy


# What is made of which fields, and kept.
_MADE_OF = {
    "outline": {"section"},
    "cut": {"section", "crack"},
    "above": {"section", "crack"},
    "surroundings": set(Case.model_fields),
    "single_crack_cases": set(Case.model_fields),
    "_sorted_cracks": set(Case.model_fields),
    "asked": {"section", "crack", "further_cracks"},
    "anchors_at_crack": {"section", "crack", "anchors"},
    "uplift_at_crack": {"section", "crack", "uplift"},
}
# In the place of a section or a crack that is wrong, so that the rest can be looked at.
_SECTION, _CRACK = {"height": "1 m", "crest_width": "1 m", "base_width": "1 m"}, {"friction": 1.0}
# What has no meaning without another block.
_OF_OTHERS = {"reservoir": ("ice", "silt")}


def problems(
    fields: Mapping[str, Any], directory: Path | None, written: Mapping[str, str] | None = None
) -> tuple[Case | None, list[InputError]]:
    """Return the case of some fields, as a file has them, and all of its errors; None with an error.

    Parameters
    ----------
    fields
        As a file has them.
    directory
        Where relative paths start; None where no file is to be read.
    written
        How the user called cracks, by their paths in the fields.
    """
    listed = CRACKS in fields or JOINTS in fields
    aliases = aliases_of(fields) if listed else {}
    case, wrong = _problems(fields, directory, listed=listed)
    return case, renamed(renamed(wrong, aliases), written or {})


def _problems(
    fields: Mapping[str, Any], directory: Path | None, *, listed: bool
) -> tuple[Case | None, list[InputError]]:
    wrong: list[InputError] = []
    try:
        read = with_section_read(fields, directory)
    except InputError as error:
        read, wrong = {**fields, "section": _SECTION}, [error, *error.others]
    try:
        # Joints go up to the crest of the section.
        read = with_fit_read(as_blocks(read), directory)
    except InputError as error:
        return None, [*wrong, error, *error.others]
    return _checked(read, wrong, listed=listed)


def _checked(
    read: Mapping[str, object], wrong: list[InputError], *, listed: bool
) -> tuple[Case | None, list[InputError]]:
    """Return the case of blocks and fields, and all its errors besides those already known."""
    try:
        case = Case.model_validate(read)
    except ValidationError as complaint:
        wrong += all_errors(complaint, Case)
        return None, [*wrong, *_further(read, wrong)]
    case._lists_cracks = listed
    if not wrong:
        wrong = _misfits(case)
    return (None if wrong else case), wrong


def _in_si(value: Any) -> Any:
    """Return a block as its fields that are given, with numbers that say that they are in SI."""
    if isinstance(value, Fields):
        return {name: _in_si(getattr(value, name)) for name in value.model_fields_set}
    if isinstance(value, tuple):
        return tuple(map(_in_si, value))
    return InSI(value, f"{value!r}") if type(value) is float else value


def _further(fields: Mapping[str, object], wrong: list[InputError]) -> list[InputError]:
    """Return what the section rules out of the blocks that are sound by themselves."""
    gone = {error.field.partition(".")[0].partition("[")[0] for error in wrong}
    gone |= {name for block in gone for name in _OF_OTHERS.get(block, ())}
    if "section" in gone:
        return []
    left = {name: value for name, value in fields.items() if name not in gone}
    if "crack" in gone:
        # What lies on the crack cannot be looked at.
        left = {name: value for name, value in left.items() if name != "anchors"} | {"crack": _CRACK}
    try:
        return _misfits(Case.model_validate(left))
    except ValidationError:
        return []


def _misfits(case: Case) -> list[InputError]:
    wrong = []
    try:
        for is_so, error in misfits(case):
            if is_so:
                wrong.append(error())
    except InputError as error:
        wrong.append(error)
    return wrong


def misfits(case: Case) -> Iterator[tuple[bool, Callable[[], InputError]]]:
    """Walk the conditions that the section rules out, row by row where the numbers of the case are columns, with their
    errors: silt above the crest, water farther above it than the dam is high, ice that nothing holds there, sections
    outside the dam and anchors beyond the toe."""
    choice = case.statics
    _, base, _, crest = case.outline.bounds
    height = crest - base
    surfaces = {
        "reservoir.depth": case.reservoir.depth if case.reservoir else None,
        "tailwater.depth": case.tailwater.depth if case.tailwater else None,
        "statics.flood_depth": choice.flood_depth,
        "statics.flood_tailwater": choice.flood_tailwater,
        "silt.depth": case.silt.depth if case.silt else None,
    }
    for field, depth in surfaces.items():
        if depth is not None:
            limit = height if field == "silt.depth" else _DEEPEST * height
            yield depth > limit * (1.0 + ON_LINE), partial(_above_crest, field, depth, height)
    if case.ice is not None and case.reservoir is not None:
        level = case.reservoir.depth - case.ice.depth
        yield level > height * (1.0 + ON_LINE), partial(_ice_above_crest, level, height)
    for place, joint in enumerate(choice.sections):
        field = f"statics.sections[{place}].elevation"
        yield outside(case.outline, joint.elevation), partial(_outside, field, joint.elevation, height)
    if case.further_cracks:
        _ = case.single_crack_cases  # raises where two meet
    section = case.cut
    for alone, path in zip(case._cases_as_written(), case.crack_paths, strict=True):
        kinks = alone.crack.kinks
        wrong = kinks_misfit(kinks, alone.cut, alone.outline, alone.crack_line, f"{path}.kinks") if kinks else None
        if wrong is None and case.further_cracks:
            wrong = alone.crack.bond_misfit(f"{path}.")  # with the friction that it inherits
        if wrong is not None:
            yield True, partial(wrong.with_others, ())
    for place, anchor in enumerate(case.anchors):
        if anchor.distance is not None:
            far = partial(_beyond_toe, f"anchors[{place}].distance", anchor.distance, section.crack_width)
            yield anchor.distance > section.crack_width * (1.0 + ON_LINE), far
            continue
        for cracked in case.single_crack_cases if case.further_cracks else (case,):
            yield too_flat(anchor, cracked.cut), partial(flat, place, anchor, cracked.cut)


def _ends_of_crack(path: str, case: Case, *, is_first: bool) -> tuple[float, float]:
    """Return the elevations of both ends of the only crack of a case."""
    try:
        section = case.cut
    except InputError as error:
        if is_first:
            raise
        elevation = f"{case.crack.elevation:g} m"
        raise InputError("section-misfit", f"{path}.elevation", elevation, reason=error) from None
    return section.heel[1], section.toe[1]


def _distance_between(upper: Case, lower: Case) -> float:
    """Return how far the lines of two cracks are apart, of which one has kinks; infinite where none has [m]."""
    if not (upper.crack.kinks or lower.crack.kinks):
        return math.inf
    return float(shapely.distance(*(shapely.LineString(case.crack_line) for case in (upper, lower))))


def _outside(field: str, elevation: float, height: float) -> InputError:
    return InputError("out-of-range", field, f"{elevation:g} m", bound=f"from 0 m to below the crest at {height:g} m")


def _above_crest(field: str, depth: float, height: float) -> InputError:
    other, most = ("the crest", height) if field == "silt.depth" else ("twice the height of the dam", _DEEPEST * height)
    return InputError("above-other", field, f"{depth:g} m", other=other, most=f"{most:g} m")


def _ice_above_crest(level: float, height: float) -> InputError:
    return InputError("ice-above-crest", "ice.depth", f"{level:g} m", height=f"{height:g} m")


def _beyond_toe(field: str, distance: float, width: float) -> InputError:
    return InputError(
        "out-of-range", field, f"{distance:g} m", bound=f"from 0 m to {width:g} m, the width of the crack"
    )
