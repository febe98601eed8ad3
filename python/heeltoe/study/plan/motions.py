"""The earthquakes of a study: events with their components, how strong each is, and the factors that make them as
strong as is wanted."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from pydantic import ValidationError

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.case.motion import Source
from heeltoe.case.sentences import first_error
from heeltoe.case.shaking import read_source
from heeltoe.case.suite import SuiteMotion
from heeltoe.errors.error import InputError, shown
from heeltoe.errors.sanitize import harmless
from heeltoe.models.run import runs_both_signs
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.intensity import intensity
from heeltoe.motion.matching import match_known_band
from heeltoe.motion.records.catalog import is_record
from heeltoe.motion.targets import target_of
from heeltoe.study.plan.file import Event, Motions
from heeltoe.study.plan.problems import Problems

# What the last part of a vertical component's name is.
_VERTICAL = re.compile(r"up|ud\d?|v|ver|vert|vertical|vrt|z|[bceghs][dghln]z|dwn|down", re.IGNORECASE)
# The last part of a name, which tells the components of an event apart: behind a dash, an underscore or a blank.
_LAST = re.compile(r"(.+)[-_ .]([^-_ .]+)")
# Endings of K-NET and KiK-net, which tell the components apart where names do not.
_ENDING = re.compile(r"\.(EW|NS|UD)[12]?", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class Shake:
    """A motion that dams meet.

    Attributes
    ----------
    name
        Of the horizontal component.
    event
        That it belongs to, counting from zero.
    horizontal, vertical
        As recorded [m/s2]; the vertical one None where there is none.
    turned
        Whether the horizontal one is turned round before it shakes a dam.
    reference
        What the measure of the scale is for factor one: the geometric mean of both components of a pair.
    end
        Of the shaking [s]; that of the horizontal motion where it is zero.
    """

    name: str
    event: int
    horizontal: GroundMotion
    vertical: GroundMotion | None
    turned: bool = False
    reference: float = 1.0
    end: float = 0.0

    def factor(self, strength: Floats, measure: str) -> Floats:
        """Return the factors that make the motion so strong."""
        if measure == "factor":
            return strength
        ratio = strength / self.reference
        return np.sqrt(ratio) if measure == "arias" else ratio


def shakes_of(motions: Motions, case: Case, directory: Path) -> tuple[tuple[Shake, ...], tuple[str, ...]]:
    """Read the motions of a study.

    Returns
    -------
    shakes
        In the order of the events.
    events
        Their names.

    Raises
    ------
    InputError
        Where a record cannot be found, read or trusted, or components that are expected are not there.
    """
    events = list(_events(motions, directory))
    shakes, problems = list[Shake](), Problems()
    for number, event in enumerate(events):
        with problems:
            shakes += _shakes(motions, case, directory, number, event)
    problems.tell()
    # Halves of letters are none that a table can hold.
    return tuple(replace(shake, name=harmless(shake.name)) for shake in shakes), tuple(
        harmless(event.name) for event in events
    )


def _shakes(motions: Motions, case: Case, directory: Path, number: int, event: Event) -> Iterator[Shake]:
    """Walk the motions of an event."""
    if motions.pairs and len(event.horizontal) != 2:
        raise InputError("study-pair", "motions.pairs", shown(event.name), count=len(event.horizontal))
    if motions.vertical and event.vertical is None:
        raise InputError("study-vertical", "motions.vertical", shown(event.name))
    horizontal, problems = list[GroundMotion](), Problems()
    vertical: GroundMotion | None = None
    for place, name in enumerate(event.horizontal):
        with problems:
            field = _field_of(motions, name, f"events[{number}].horizontal[{place}]")
            horizontal.append(_read(motions, case, directory, name, field))
    with problems:
        if event.vertical is not None:
            field = _field_of(motions, event.vertical, f"events[{number}].vertical")
            vertical = _read(motions, case, directory, event.vertical, field, upward=True)
    problems.tell()
    if motions.match is not None:
        target = target_of(beside_file(motions.match, directory), "motions.match", case.gravity)
        horizontal = [match_known_band(motion, target)[0] for motion in horizontal]
    references = [_reference(motions, motion, case) for motion in horizontal]
    if motions.pairs:
        references = [float(np.sqrt(np.prod(references)))] * 2
    for motion, reference in zip(horizontal, references, strict=True):
        shake = Shake(motion.name, number, motion, vertical, reference=reference)
        yield shake
        if both_signs(motions, case):
            yield replace(shake, turned=True)


def beside_file(text: str, directory: Path) -> str:
    """Return the text of a target spectrum; a file that it names is relative to the study file."""
    place = directory / os.path.expanduser(text)
    return str(place) if os.path.isfile(place) else text


def both_signs(motions: Motions | None, case: Case) -> bool:
    """Whether each motion of a study comes as recorded and reversed."""
    chosen = None if motions is None else motions.both_signs
    return runs_both_signs(case) if chosen is None else chosen


def _reference(motions: Motions, motion: GroundMotion, case: Case) -> float:
    if motions.scale is None or motions.scale.measure == "factor":
        return 1.0
    value = intensity(motion, motions.scale.measure, motions.scale.period_s, case.gravity)
    if value <= 0.0:
        raise InputError("motion-zero", motion.name)
    return value


def _field_of(motions: Motions, name: str, entry: str) -> str:
    """Return where the name of a record stands in the study: `entry` in a study whose events are listed."""
    if motions.files is not None:
        entry = f"files[{motions.files.index(name)}]"
    elif motions.folder is not None:
        entry = "folder"
    return f"motions.{entry}"


def _read(
    motions: Motions, case: Case, directory: Path, name: str, field: str, *, upward: bool = False
) -> GroundMotion:
    step = None if motions.time_step is None else f"{motions.time_step!r} s"
    try:
        source = Source.model_validate({"file": name, "unit": motions.unit, "time_step": step})
    except ValidationError as found:
        raise first_error(found, Source) from None
    return read_source(source, case.gravity, directory, field, upward=upward, options_field="motions")


def _events(motions: Motions, directory: Path) -> Iterator[Event]:
    """Walk the events; components of files without a word of which belong together are told by their names."""
    if motions.events is not None:
        for event in motions.events:
            yield event if event.name else event.model_copy(update={"name": Path(event.horizontal[0]).stem})
        return
    names = motions.files or _folder(motions.folder or "", directory)
    groups: dict[str, list[str]] = {}
    for name in names:
        common, last = _parts(name)
        if _VERTICAL.fullmatch(last):
            common = next((_parts(other)[0] for other in names if _goes_with(name, other)), common)
        groups.setdefault(common, []).append(name)
    for common, files in groups.items():
        vertical = [file for file in files if _VERTICAL.fullmatch(_parts(file)[1])]
        horizontal = [file for file in files if file not in vertical]
        if not horizontal:
            raise InputError("study-horizontal", "motions", shown(vertical[0]))
        if len(vertical) > 1 or len(horizontal) > 2:
            raise InputError("study-components", "motions", shown(common), names=", ".join(files))
        used = vertical[0] if vertical and motions.vertical else None
        yield Event(name=common, horizontal=tuple(horizontal), vertical=used)


def suite_events(motions: Sequence[SuiteMotion], directory: Path, *, vertical: bool) -> tuple[list[Event], list[str]]:
    """Return each horizontal record of a suite as an event by itself, with the entry of the case that it comes from.

    A vertical component of a folder, told by its name, goes with each horizontal one of its name where `vertical` is
    asked for, and is left out otherwise.

    Raises
    ------
    InputError
        Where there is no record, a folder has none, or two records have one name.
    """
    if not motions:
        raise InputError("study-motions", "motions")
    files: dict[str, tuple[str, str | None]] = {}
    names = list[str]()
    for place, motion in enumerate(motions):
        is_folder = os.path.isdir(directory / os.path.expanduser(motion.file))
        for name in _folder(motion.file, directory, f"motions[{place}].file") if is_folder else [motion.file]:
            files[name] = f"motions[{place}]", motion.vertical
            names.append(name)
    upward = [
        file
        for file in files
        if _VERTICAL.fullmatch(_parts(file)[1]) and any(_goes_with(file, other) for other in files)
    ]
    horizontal = [file for file in names if file not in upward]
    stems = [_name_of(file) if os.path.isfile(directory / file) else file for file in horizontal]
    twice = [stem for stem in stems if stems.count(stem) > 1]
    if twice:
        raise InputError("study-twice", "motions", shown(twice[0]))
    events = [
        Event(
            name=stem,
            horizontal=(file,),
            vertical=files[file][1]
            or (next((up for up in upward if _goes_with(up, file)), None) if vertical else None),
        )
        for stem, file in zip(stems, horizontal, strict=True)
    ]
    return events, [files[file][0] for file in horizontal]


def _goes_with(upward: str, other: str) -> bool:
    """Whether another record is a horizontal component beside a vertical one."""
    common, last = _parts(other)
    beside = _parts(upward)[0]
    # PEER writes STATION-UP beside STATION000 and STATION090.
    joined = Path(other).stem.lower().removeprefix(beside.lower())
    return not _VERTICAL.fullmatch(last) and (common == beside or re.fullmatch(r"\d{3}", joined) is not None)


def _parts(name: str) -> tuple[str, str]:
    """Return what the components of one event have in common in their names, and the part that tells them apart; a name
    of one part is an event by itself."""
    path = Path(name)
    if ending := _ENDING.fullmatch(path.suffix):
        return path.stem, ending[1]
    match = _LAST.fullmatch(path.stem)
    return (match[1], match[2]) if match else (path.stem, "")


def _name_of(name: str) -> str:
    """Return what a record is called by its file: with its ending where that alone tells it from others."""
    path = Path(name)
    return path.name if _ENDING.fullmatch(path.suffix) else path.stem


def _folder(name: str, directory: Path, field: str = "motions.folder") -> list[str]:
    """Return the records of a folder, in the order of their names."""
    # Unlike that of paths, it leaves the home of nobody as it is.
    root = directory / os.path.expanduser(name)
    # A name that is too long for any file is no folder, either: Path.is_dir raises.
    if not os.path.isdir(root):
        raise InputError("study-folder", field, shown(name))
    files = [str(path.resolve()) for path in sorted(root.iterdir()) if is_record(path)]
    if not files:
        raise InputError("study-folder-empty", field, shown(name))
    return files
