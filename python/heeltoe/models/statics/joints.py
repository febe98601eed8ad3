"""The static checks at many sections: the crack of the case and its lift joints, the governing one first."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from heeltoe.case.field_usage import unused_fields
from heeltoe.case.model import Case, misfits
from heeltoe.case.options import StaticsSection
from heeltoe.errors.error import InputError, expect
from heeltoe.kernel.build import build_info
from heeltoe.models.statics.checks import Check
from heeltoe.models.statics.model import Statics, statics
from heeltoe.warnings.notice import Notice, by_gravity


@dataclass(frozen=True)
class Joint:
    """A section and its checks.

    Attributes
    ----------
    elevation_m
        Of its upstream end above the lowest point of the dam.
    case
        The dam with its crack there.
    statics
        The checks.
    """

    elevation_m: float
    case: Case
    statics: Statics

    @property
    def governing(self) -> Check | None:
        """The check with the smallest margin of capacity over demand; None without a requirement."""
        return min(self._with_margin(), key=_margin, default=None)

    def governing_of(self, check: str) -> Check | None:
        """Return the check of a name with the smallest margin over the load cases; None where there is none."""
        return min(
            (candidate for candidate in self._with_margin() if candidate.name == check), key=_margin, default=None
        )

    def _with_margin(self) -> list[Check]:
        return [check for check in self.statics.checks if check.margin is not None]


@dataclass(frozen=True)
class Joints:
    """Static checks at many sections.

    Attributes
    ----------
    title
        Title of the case.
    joints
        In the order in which the case lists them.
    """

    title: str
    joints: tuple[Joint, ...]

    @property
    def ranked(self) -> tuple[Joint, ...]:
        """The joints, that with the smallest margin first."""
        return tuple(sorted(self.joints, key=lambda joint: _margin(joint.governing)))

    @property
    def governing(self) -> Joint:
        """The joint with the smallest margin."""
        return self.ranked[0]

    @property
    def checks(self) -> tuple[str, ...]:
        """Names of the checks that have a margin anywhere."""
        names = [check.name for joint in self.joints for check in joint.statics.checks if check.margin is not None]
        return tuple(dict.fromkeys(names))

    @property
    def warnings(self) -> tuple[Notice, ...]:
        """Warnings of all joints, shared ones once."""
        return by_gravity(dict.fromkeys(notice for joint in self.joints for notice in joint.statics.warnings))

    @property
    def ok(self) -> bool:
        """Whether every check is met everywhere."""
        return all(joint.statics.ok for joint in self.joints)

    def governing_of(self, check: str) -> tuple[Joint, Check] | None:
        """Return the joint at which a check has its smallest margin, and that check."""
        judged = [(joint, worst) for joint in self.joints if (worst := joint.governing_of(check))]
        return min(judged, key=lambda pair: _margin(pair[1]), default=None)

    def to_json(self) -> dict[str, Any]:
        """Return plain numbers, strings and lists; of each joint what its checks say by themselves."""
        return {
            "model": "statics at many sections",
            "title": self.title,
            "ok": self.ok,
            "governing_elevation_m": self.governing.elevation_m,
            "governing": {
                name: {"elevation_m": worst[0].elevation_m, **worst[1].to_json()}
                for name in self.checks
                if (worst := self.governing_of(name))
            },
            "sections": [
                {"elevation_m": joint.elevation_m, "statics": joint.statics.to_json()} for joint in self.ranked
            ],
            "build": build_info(),
        }


#: Judges a section: the dam with its crack there, and which of its cracks that is from the crest down; None of a joint
#: that is none of them.
Judge = Callable[[Case, int | None], Statics]


def _by_the_case(case: Case, place: int | None) -> Statics:
    return statics(case)


def statics_of_sections(case: Case, judge: Judge = _by_the_case) -> Joints:
    """Judge the stability of a dam at each of its ``statics.sections``, or at its cracks where it lists none.

    Parameters
    ----------
    case
        Dam, water and the choices of ``[statics]``.
    judge
        Makes the checks of a section, of the dam with its crack there, and of which of its cracks it is.

    Raises
    ------
    InputError
        Where a section does not cut the dam in two, or something of the case has no place there.
    """
    expect(case, Case, "a case", "case")
    listed = case.statics.sections
    if not listed:
        own = {why: notice for notice in unused_fields(case, ("statics",)) if (why := _unused(notice))}
        cracks = [
            Joint(alone.crack.elevation, alone, _named(judge(alone, place), own))
            for place, alone in enumerate(case.single_crack_cases)
        ]
        return Joints(case.title, tuple(cracks))
    return Joints(case.title, tuple(_joint(case, place, judge) for place in range(len(listed))))


def at_section(case: Case, section: StaticsSection, field: str = "statics.sections") -> Case:
    """Return the case with its crack at a lift joint, which is level and straight unless it is the crack itself.

    Raises
    ------
    InputError
        Of the field, where the joint does not cut the section in two, or something of the case has no place there.
    """
    place = _crack_at(case, section.elevation)
    crack: dict[str, Any] = {"elevation": section.elevation}
    if place is None:
        crack |= {"inclination": 0.0, "kinks": ()}
    if section.friction is not None:
        crack |= {"friction": section.friction, "static_friction": None, "kinetic_friction": None, "law": None}
    choice = {
        name: value
        for name in ("bonded", "cohesion", "tensile_strength")
        if (value := getattr(section, name)) is not None
    }
    alone = case.single_crack_cases[case.asked if place is None else place]
    moved = alone.model_copy(
        update={
            "crack": alone.crack.model_copy(update=crack),
            "statics": case.statics.model_copy(update={**choice, "sections": ()}),
        }
    )
    for wrong, error in misfits(moved):
        if wrong:
            raise InputError("section-misfit", field, f"{section.elevation:g} m", reason=error())
    return moved


def _crack_at(case: Case, elevation: float) -> int | None:
    """Return which crack of a case begins at an elevation [m], from the crest down; None where none does."""
    levels = [crack.elevation for crack in case.cracks]
    return levels.index(elevation) if elevation in levels else None


def _joint(case: Case, place: int, judge: Judge) -> Joint:
    section = case.statics.sections[place]
    moved = at_section(case, section, f"statics.sections[{place}]")
    return Joint(section.elevation, moved, judge(moved, _crack_at(case, section.elevation)))


def _named(joint_statics: Statics, own: Mapping[str, Notice]) -> Statics:
    """Return the checks of one of several cracks, with the fields that have no effect named as the whole case does."""
    named = (own.get(why, notice) if (why := _unused(notice)) else notice for notice in joint_statics.warnings)
    return replace(joint_statics, warnings=tuple(dict.fromkeys(named)))


def _unused(notice: Notice) -> str | None:
    """Return why fields have no effect, of a notice that says so of some; None of any other."""
    quantities = dict(notice.quantities)
    return (
        str(quantities.get("why") or quantities["readers"]) if notice.code in ("fields-idle", "fields-unused") else None
    )


def _margin(check: Check | None) -> float:
    return float("inf") if check is None or check.margin is None else check.margin
