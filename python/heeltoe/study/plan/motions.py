"""The earthquakes of a study: events with their components, how strong each is, and the factors that make them as
strong as is wanted."""

from __future__ import annotations

import math
import os
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
from heeltoe.case.suite import SuiteMotion, cross_valley_of
from heeltoe.errors.error import InputError, shown
from heeltoe.errors.sanitize import harmless
from heeltoe.models.run import runs_both_signs
from heeltoe.motion.check import check_lag, check_moved, check_pair, check_scaling
from heeltoe.motion.direction import check_right_angle, direction_of, rotated
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.intensity import intensity
from heeltoe.motion.matching import match_known_band
from heeltoe.motion.records.read import is_record
from heeltoe.motion.start import begun_together
from heeltoe.motion.targets import Target, file_of_target, target_of
from heeltoe.study.plan.components import NOTHING_SAID, Reading, check_asked, components_of, grouped, with_channel
from heeltoe.study.plan.file import Event, Motions
from heeltoe.study.plan.problems import Problems
from heeltoe.study.plan.search_results import Listed, is_list


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
    about
        The event as the study has it; None of the motion of a case.
    cross
        Across the valley, as recorded [m/s2]; None where there is none.
    azimuth
        Direction of the stream to which both components are rotated, clockwise from north [deg], or from the first
        component where the records do not state their directions; None where they are not.
    """

    name: str
    event: int
    horizontal: GroundMotion
    vertical: GroundMotion | None
    turned: bool = False
    reference: float = 1.0
    end: float = 0.0
    about: Event | None = None
    cross: GroundMotion | None = None
    azimuth: float | None = None

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
    names = [name for event in events for name in (*event.horizontal, event.vertical) if name is not None]
    check_asked(names, directory, Reading.of(motions))
    # Halves of letters are none that a table can hold.
    return tuple(replace(shake, name=harmless(shake.name)) for shake in _called_apart(shakes)), tuple(
        harmless(event.name) for event in events
    )


def _called_apart(shakes: Sequence[Shake]) -> Iterator[Shake]:
    """Walk motions with a name each: files of one name that differ in their ending are called with it."""
    names = [shake.name for shake in shakes if not shake.turned]
    for shake in shakes:
        ending = Path(shake.horizontal.source).suffix
        yield replace(shake, name=f"{shake.name}{ending}") if names.count(shake.name) > 1 else shake


def _shakes(motions: Motions, case: Case, directory: Path, number: int, event: Event) -> Iterator[Shake]:
    """Walk the motions of an event."""
    if motions.pairs and len(event.horizontal) != 2:
        raise InputError("study-pair", "motions.pairs", shown(event.name), count=len(event.horizontal))
    if motions.cross_valley and len(event.horizontal) != 2:
        raise InputError("study-pair", "motions.cross_valley", shown(event.name), count=len(event.horizontal))
    if motions.vertical and event.vertical is None:
        raise InputError(
            "study-component", "motions.vertical", shown(event.name), component="vertical", remedy="leave vertical out"
        )
    horizontal, problems = list[GroundMotion](), Problems()
    vertical: GroundMotion | None = None
    fields = [
        _field_of(motions, name, f"events[{number}].horizontal[{place}]") for place, name in enumerate(event.horizontal)
    ]
    for name, field in zip(event.horizontal, fields, strict=True):
        with problems:
            horizontal.append(_read(motions, case, directory, name, field))
    with problems:
        if event.vertical is not None:
            field = _field_of(motions, event.vertical, f"events[{number}].vertical")
            vertical = _read(motions, case, directory, event.vertical, field, upward=True)
    problems.tell()
    if vertical is not None:
        horizontal = [motion.with_warnings(*check_pair(motion, vertical)) for motion in horizontal]
    if vertical is not None or motions.cross_valley:
        horizontal, vertical = _together(horizontal, vertical, fields)
        if motions.cross_valley:
            horizontal[1] = horizontal[1].with_warnings(*check_lag(horizontal[0], horizontal[1], fields[1]))
    if motions.match is not None:
        target = target_of(beside_file(motions.match, directory), "motions.match", case.gravity)
        horizontal = [_matched(motion, target, case.gravity) for motion in horizontal]
    references = [_reference(motions, motion, case) for motion in horizontal]
    if motions.pairs:
        references = [float(np.sqrt(np.prod(references)))] * 2
    for shake in _ways(motions, case, horizontal, references, fields[-1], event.name):
        shaken = replace(shake, event=number, vertical=vertical, about=event)
        yield shaken
        if both_signs(motions, case):
            yield replace(shaken, turned=True)


def _together(
    horizontal: Sequence[GroundMotion], vertical: GroundMotion | None, fields: Sequence[str]
) -> tuple[list[GroundMotion], GroundMotion | None]:
    """Return the components of an event on one clock, by their headers and by the leads of filters."""
    up = [] if vertical is None else [vertical]
    placed = begun_together([*horizontal, *up], [*fields, "motions.vertical"])
    lead = max(motion.lead for motion in placed)
    placed = [motion.led_by(lead) for motion in placed]
    return placed[: len(horizontal)], placed[-1] if up else None


def _ways(
    motions: Motions,
    case: Case,
    horizontal: Sequence[GroundMotion],
    references: Sequence[float],
    field: str,
    name: str,
) -> Iterator[Shake]:
    """Walk how the horizontal components of an event of this name, the last of which stands in `field`, shake a dam,
    without their vertical one."""
    rule = cross_valley_of(motions.cross_valley)
    if rule.step is None:
        across = horizontal[::-1] if motions.cross_valley else [None] * len(horizontal)
        for motion, reference, other in zip(horizontal, references, across, strict=True):
            cross = other
            if cross is not None and rule.share is not None and cross.pga > 0.0:
                share = f"scaled to {100.0 * rule.share:g} % of the peak along the stream"
                cross = cross.scaled_to(rule.share * motion.pga, share)
            yield Shake(motion.name, 0, motion, None, reference=reference, cross=cross)
        return
    one, other = horizontal
    first, second = direction_of(one), direction_of(other)
    directions = (0.0, math.pi / 2.0) if first is None or second is None else (first, second)
    check_right_angle(one, directions, field)
    # The other half of the circle is the other sign of these.
    count = round((180.0 if both_signs(motions, case) else 360.0) / rule.step)
    turned = [rotated(one, other, directions, math.radians(place * rule.step)) for place in range(count)]
    strongest = references[0] if motions.pairs else max(_reference(motions, along, case) for along, _ in turned)
    for place, (along, cross) in enumerate(turned):
        azimuth = place * rule.step
        along = replace(along, name=f"{name} at {azimuth:g} deg")
        yield Shake(along.name, 0, along, None, reference=strongest, cross=cross, azimuth=azimuth)


def _matched(motion: GroundMotion, target: Target, gravity: float) -> GroundMotion:
    """Return a record matched to a target, looked at as any record that was processed."""
    matched, misfit = match_known_band(motion, target)
    check_moved(matched, gravity, "motions.match")
    return matched.with_warnings(*check_scaling(motion, misfit.scale))


def beside_file(text: str, directory: Path) -> str:
    """Return the text of a target spectrum; a file that it names is relative to the study file."""
    file, wanted = file_of_target(text, directory)
    place = directory / os.path.expanduser(file)
    return f"{place}#{wanted}" if wanted and os.path.isfile(place) else str(place) if os.path.isfile(place) else text


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
        entry = f"files[{next(k for k, file in enumerate(motions.files) if name.startswith(file))}]"
    elif motions.folder is not None:
        entry = "folder"
    return f"motions.{entry}"


def _read(
    motions: Motions, case: Case, directory: Path, name: str, field: str, *, upward: bool = False
) -> GroundMotion:
    step = None if motions.time_step is None else f"{motions.time_step!r} s"
    file, channel = with_channel(name, directory)
    how = {"channel": channel, "unit": motions.unit, "time_step": step, "layout": motions.layout}
    try:
        source = Source.model_validate({"file": file, **how})
    except ValidationError as found:
        raise first_error(found, Source) from None
    source = source.model_copy(update={"processing": motions.processing})
    factor = motions.factor
    return read_source(
        source, case.gravity, directory, field, upward=upward, options_field="motions", header_factor=factor
    )


def _events(motions: Motions, directory: Path) -> Iterator[Event]:
    """Walk the events; components of files without a word of which belong together are found by their contents."""
    if motions.events is not None:
        for event in motions.events:
            yield event if event.name else event.model_copy(update={"name": Path(event.horizontal[0]).stem})
        return
    names = motions.files or records_of(motions.folder or "", directory)
    parts = components_of(names, directory, Reading.of(motions))
    groups = grouped(parts)
    for group in groups:
        if not group.horizontal:
            raise InputError(
                "study-component",
                "motions",
                shown(group.vertical[0].file),
                component="horizontal",
                remedy="take the file out",
            )
        files = [part.file for part in (*group.horizontal, *group.vertical)]
        if len(group.vertical) > 1 or len(group.horizontal) > 2:
            raise InputError("study-components", "motions", shown(group.name), names=", ".join(files))
        used = group.vertical[0].file if group.vertical and motions.vertical else None
        yield _event(group.name, [part.file for part in group.horizontal], used, group.horizontal[0].listed)


def _event(name: str, horizontal: Sequence[str], vertical: str | None, listed: Listed) -> Event:
    """Return an event with its entry of a list of records."""
    about = {
        "magnitude": listed.magnitude,
        "distance": listed.distance_m,
        "vs30": listed.vs30_m_s,
        "pulse_period": listed.pulse_period_s,
    }
    return Event(name=name, horizontal=tuple(horizontal), vertical=vertical).model_copy(update=about)


def suite_events(
    motions: Sequence[SuiteMotion],
    directory: Path,
    *,
    vertical: bool,
    cross_valley: bool | str = False,
    reading: Reading = NOTHING_SAID,
) -> tuple[list[Event], list[str]]:
    """Return each horizontal record of a suite as an event by itself, with the entry of the case that it comes from;
    both horizontal components of an earthquake as one event with `cross_valley`.

    A vertical component, known by what its record says and else by its name, goes with each horizontal one of its
    earthquake where `vertical` is asked for, and is left out otherwise.

    Raises
    ------
    InputError
        Where there is no record, a folder has none, or two records have one name.
    """
    if not motions:
        raise InputError("study-motions", "motions")
    files: dict[str, tuple[str, str | None]] = {}
    names, found = list[str](), set[str]()
    for place, motion in enumerate(motions):
        is_folder = os.path.isdir(directory / os.path.expanduser(motion.file))
        own = records_of(motion.file, directory, f"motions[{place}].file") if is_folder else [motion.file]
        names += own
        files |= dict.fromkeys(own, (f"motions[{place}]", motion.vertical))
        found |= set(own) if is_folder else set()
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise InputError("listed-twice", "motions", shown(twice[0]))
    rows = list[tuple[int, Event, str]]()
    for group in grouped(components_of(names, directory, reading)):
        # Alone and by its file, a vertical component is what the user asks for; it is warned of.
        level = group.horizontal or tuple(part for part in group.vertical if part.given not in found)
        if cross_valley:
            if len(level) != 2:
                raise InputError("study-pair", "suite.cross_valley", shown(group.name), count=len(level))
            entry, named = files[level[0].given]
            up = group.vertical[0].file if vertical and group.vertical else None
            event = _event(group.name, [part.file for part in level], named or up, level[0].listed)
            rows.append((names.index(level[0].given), event, entry))
            continue
        for part in level:
            entry, named = files[part.given]
            up = group.vertical[0].file if vertical and group.horizontal and group.vertical else None
            event = _event(_name_of(part.file, directory), [part.file], named or up, part.listed)
            rows.append((names.index(part.given), event, entry))
    if not rows:
        raise InputError(
            "study-component", "motions", shown(names[0]), component="horizontal", remedy="take the file out"
        )
    rows.sort(key=lambda row: row[0])
    called = [event.name for _, event, _ in rows]
    return [
        event if called.count(event.name) == 1 else event.model_copy(update={"name": Path(event.horizontal[0]).name})
        for _, event, _ in rows
    ], [entry for _, _, entry in rows]


def _name_of(name: str, directory: Path) -> str:
    """Return what a record is called by its file."""
    file, channel = with_channel(name, directory)
    own = Path(file).stem if os.path.isfile(directory / file) else file
    return own if channel is None else f"{own}-chan{channel}"


def records_of(name: str, directory: Path, field: str = "motions.folder") -> list[str]:
    """Return the records of a folder, in the order of their names.

    Raises
    ------
    InputError
        Where it is no folder, or has none.
    """
    # Unlike that of paths, it leaves the home of no one as it is.
    root = directory / os.path.expanduser(name)
    # A name that is too long for any file is no folder, either: Path.is_dir raises.
    if not os.path.isdir(root):
        raise InputError(
            "not-a-directory", field, shown(name), expected="the directory of the records, relative to the study file"
        )
    files = [str(path.resolve()) for path in sorted(root.iterdir()) if is_record(path) and not is_list(path.name)]
    if not files:
        raise InputError("empty", field, shown(name), what="records", expected="a directory with records")
    return files
