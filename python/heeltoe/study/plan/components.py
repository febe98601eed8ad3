"""The components of earthquakes among records: which are vertical and which belong together, by direction, station and
time in the files, else by their names."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from itertools import takewhile
from pathlib import Path

from heeltoe.case.motion import Layout
from heeltoe.case.suite import Suite
from heeltoe.errors.error import InputError, shown
from heeltoe.motion.check import way_of
from heeltoe.motion.ground_motion import UNCORRECTED, GroundMotion
from heeltoe.motion.records import HeaderFactor
from heeltoe.motion.records.catalog import PREFIX, find
from heeltoe.motion.records.read import read_channels
from heeltoe.study.plan.file import Motions
from heeltoe.study.plan.search_results import Listed, listed_records

# Last parts of the names of vertical components.
_VERTICAL = re.compile(r"up|ud\d?|v\d?|ver|vert|vertical|vrt|z|[bceghs][dghln]z|dwn|down", re.IGNORECASE)
# The last part of a name, which tells the components of an event apart: behind a dash, an underscore or a blank.
_LAST = re.compile(r"(.+)[-_ .]([^-_ .]+)")
# Endings of K-NET and KiK-net, which tell the components apart where names do not.
_ENDING = re.compile(r"\.(EW|NS|UD)[12]?", re.IGNORECASE)
# How many things a record says of its earthquake.
_SAID = 5
#: Sign between a file and the number of one of its channels.
CHANNEL = "#"


@dataclass(frozen=True)
class Reading:
    """How files of a study or a suite are read where they do not say it themselves.

    Attributes
    ----------
    unit, time_step, layout, factor
        As the fields of a study by these names.
    """

    unit: str | None = None
    time_step: float | None = None
    layout: Layout | None = None
    factor: HeaderFactor | None = None

    @classmethod
    def of(cls, block: Motions | Suite) -> Reading:
        """Return what a block of a study or of a case says."""
        return cls(block.unit, block.time_step, block.layout, block.factor)

    def channels(self, path: Path, *, assume: bool = True) -> list[GroundMotion]:
        """Return the motions in a file, read so where it does not say it itself."""
        options = {"unit": self.unit, "time_step": self.time_step, "layout": self.layout, "factor": self.factor}
        return read_channels(path, **options, assume=assume, several=True)  # type: ignore[arg-type]


NOTHING_SAID = Reading()


@dataclass(frozen=True)
class Component:
    """A record as a part of an earthquake.

    Attributes
    ----------
    given
        The file as it is given.
    file
        The same, with the number of its channel behind `#` where it has several.
    is_vertical
        Whether it is.
    earthquake
        Earthquake and station by the record, or by the list that came with it; empty where neither does.
    listed
        Its row of that list.
    """

    given: str
    file: str
    is_vertical: bool
    earthquake: tuple[str, ...] = ()
    listed: Listed = field(default_factory=Listed)


@dataclass(frozen=True)
class Group:
    """The components of one earthquake at one place.

    Attributes
    ----------
    name
        Their common name.
    horizontal, vertical
        In the order of their files.
    """

    name: str
    horizontal: tuple[Component, ...]
    vertical: tuple[Component, ...]


def components_of(names: Sequence[str], directory: Path, reading: Reading = NOTHING_SAID) -> list[Component]:
    """Return the components that files are or hold; those that are velocities or displacements are left out, and so is
    an uncorrected record beside the corrected one.

    Parameters
    ----------
    names
        Names of files, relative to `directory`, of records of the catalogue, or of motions made to order.
    directory
        Where paths start.
    reading
        How files are read that do not say it themselves.
    """
    listed = {
        name: row
        for folder in dict.fromkeys(Path(name).parent for name in names if not name.startswith(PREFIX))
        for name, row in listed_records(directory / folder).items()
    }
    found = [part for name in names for part in _in_file(name, directory, listed, reading)]
    corrected = {said for said, _, uncorrected in found if said and not uncorrected}
    return [part for said, part, uncorrected in found if not (uncorrected and said in corrected)]


def _in_file(
    name: str, directory: Path, listed: Mapping[str, Listed], reading: Reading
) -> Iterator[tuple[tuple[str, ...], Component, bool]]:
    """Walk the components of a file: all that a record says of itself, the component, and whether it is uncorrected."""
    file, channel = with_channel(name, directory)
    row = listed.get(Path(file).name.lower(), Listed())
    if file.startswith(PREFIX):
        # Each order is an earthquake of its own, whatever it ends with.
        yield (), Component(name, name, is_vertical=False, earthquake=(name,)), False
        return
    try:
        motions = reading.channels(find(file, directory))
    except InputError as error:
        if error.code != "record-not-acceleration":
            # It is read once more where it is used, and refused there.
            yield (), Component(name, name, _is_vertical_by_name(name), listed=row), False
        return
    if channel is not None:
        motions = [motion for motion in motions if motion.channel == channel]
        if not motions:
            # Its channels are listed where it is read.
            yield (), Component(name, name, is_vertical=False), False
    for motion in motions:
        part = component_of(motion, name, several=channel is None and len(motions) > 1, row=row)
        said = (*part.earthquake, motion.component) if part.earthquake and motion.component else ()
        yield said, part, any(notice.code == UNCORRECTED for notice in motion.warnings)


def component_of(motion: GroundMotion, name: str, *, several: bool, row: Listed | None = None) -> Component:
    """Return what a motion of a file is as a component of an earthquake.

    Parameters
    ----------
    motion
        The motion.
    name
        Of its file.
    several
        Whether it is one of several in the file.
    row
        Entries of a list on the file.
    """
    listed = row or Listed()
    way = listed.way or way_of(motion.component)
    vertical = way == "up" if way else _is_vertical_by_name(name)
    own = f"{name}{CHANNEL}{motion.channel}" if several else name
    return Component(name, own, vertical, listed.earthquake or _earthquake(motion), listed)


def check_asked(names: Sequence[str], directory: Path, reading: Reading) -> None:
    """Refuse options for reading files whose values each file states itself.

    Raises
    ------
    InputError
        For the field of a study.
    """
    for option in fields(reading):
        value = getattr(reading, option.name)
        without = replace(reading, **{option.name: None})
        if value is not None and not any(_asks(name, directory, without) for name in names):
            raise InputError(
                "option-foreign",
                f"motions.{option.name}",
                shown(value),
                owner="records that state this themselves",
                remedy="",
            )


def _asks(name: str, directory: Path, reading: Reading) -> bool:
    """Whether a file cannot be read so."""
    file, _ = with_channel(name, directory)
    if file.startswith(PREFIX):
        return False
    try:
        reading.channels(find(file, directory), assume=False)
    except InputError:
        return True
    return False


def _earthquake(motion: GroundMotion) -> tuple[str, ...]:
    """Return what a record says of its earthquake and its place; empty where it does not say both."""
    if not (motion.station and (motion.date or motion.event)):
        return ()
    # A borehole and the surface above it are two places.
    deep = "borehole" if "borehole" in motion.component.lower() else ""
    return motion.format, motion.event, motion.date, motion.station, deep


def with_channel(name: str, directory: Path) -> tuple[str, str | None]:
    """Return the file that a name stands for, and the channel in it, if it names one."""
    if CHANNEL not in name or os.path.exists(directory / os.path.expanduser(name)):
        return name, None
    file, _, channel = name.rpartition(CHANNEL)
    return file, channel


def grouped(components: Sequence[Component]) -> list[Group]:
    """Return components as earthquakes with a name each, in the order of their first components."""
    groups: dict[tuple[str, ...], list[Component]] = {}
    for part in components:
        groups.setdefault(part.earthquake or (_common(part.file),), []).append(part)
    kept: dict[tuple[str, ...], list[Component]] = {}
    for key, members in groups.items():
        levels = [part for part in members if not part.is_vertical]
        if len(levels) <= 2 and len(members) - len(levels) <= 1:
            kept.setdefault(key, []).extend(members)
            continue
        # Their own words are true of several earthquakes.
        for part in members:
            kept.setdefault((*key, _common(part.file)), []).append(part)
    for key in list(kept):
        own = kept[key]
        beside = next((other for other in kept if other != key and _are_one(kept[other], own)), None)
        if beside is not None:
            kept[beside] += kept.pop(key)
    called = [_name_of_group(members) for members in kept.values()]
    return [
        Group(
            name if called.count(name) == 1 else f"{name}-{called[: place + 1].count(name)}",
            tuple(part for part in members if not part.is_vertical),
            tuple(part for part in members if part.is_vertical),
        )
        for place, (name, members) in enumerate(zip(called, kept.values(), strict=True))
    ]


def _are_one(members: Sequence[Component], others: Sequence[Component]) -> bool:
    """Whether components are of one earthquake by their names, and say nothing against it: instruments start some parts
    of a second apart, and not every header has a station."""
    together = [*members, *others]
    levels = [part for part in together if not part.is_vertical]
    if not 0 < len(levels) <= 2 or len(together) - len(levels) > 1:
        return False
    said = {_day(part.earthquake) for part in together if part.earthquake}
    return len(said) <= 1 and all(_goes_with(part, members) for part in others)


def _day(earthquake: tuple[str, ...]) -> tuple[str, ...]:
    """Return what a record says of its earthquake, up to the day."""
    if len(earthquake) != _SAID:
        return earthquake
    form, event, date, station, deep = earthquake
    return form, event, re.split(r"[\sT,]", date)[0], station, deep


def _goes_with(part: Component, others: Sequence[Component]) -> bool:
    """Whether a component is called as others are, but for the last part of its name."""
    common = _common(part.file)

    def is_beside(other: Component) -> bool:
        # PEER writes STATION-UP beside STATION000 and STATION090.
        joined = Path(other.file).stem.lower().removeprefix(common.lower())
        return _common(other.file) == common or (part.is_vertical and re.fullmatch(r"\d{3}", joined) is not None)

    return any(is_beside(other) for other in others)


def _name_of_group(members: Sequence[Component]) -> str:
    """Return what the components of an earthquake have in common in their names."""
    level = [part for part in members if not part.is_vertical] or list(members)
    commons = {_common(part.file) for part in level}
    if len(commons) == 1:
        return commons.pop()
    stems = [Path(part.file).stem for part in level]
    alike = [letters[0] for letters in takewhile(lambda letters: len(set(letters)) == 1, zip(*stems, strict=False))]
    return "".join(alike).rstrip("-_ .0123456789") or stems[0]


def _common(name: str) -> str:
    return _parts(name)[0]


def _is_vertical_by_name(name: str) -> bool:
    return _VERTICAL.fullmatch(_parts(name)[1]) is not None


def _parts(name: str) -> tuple[str, str]:
    """Return what the components of one event have in common in their names, and the part that tells them apart; a name
    of one part is an event by itself."""
    path = Path(name.partition(CHANNEL)[0] if CHANNEL in Path(name).name else name)
    if CHANNEL in Path(name).name:
        return path.stem, ""
    if ending := _ENDING.fullmatch(path.suffix):
        return path.stem, ending[1]
    match = _LAST.fullmatch(path.stem)
    return (match[1], match[2]) if match else (path.stem, "")
