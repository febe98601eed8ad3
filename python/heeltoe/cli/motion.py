"""The command that says what is in a record."""

from __future__ import annotations

import os
import re
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from heeltoe.cli.common import Details, JsonPath, UnitsName, check_json, finish, say_cost
from heeltoe.cli.streams import console
from heeltoe.errors.error import InputError, shown
from heeltoe.errors.sanitize import plain
from heeltoe.units.parse import STANDARD_GRAVITY, parse
from heeltoe.units.systems import unit_system

# More motions than these are printed one below the other.
_SIDE_BY_SIDE = 3
_FIELD_OF_CASE = re.compile(r"\bmotion\.(unit|time_step|channel|layout|factor)\b")
_ABOUT = ("event", "station", "component", "date", "channel", "format", "units_as_read")

if TYPE_CHECKING:
    from rich.console import Console

    from heeltoe.motion.ground_motion import GroundMotion
    from heeltoe.motion.matching import Misfit
    from heeltoe.views.figures.motion import Matched


def motion(
    files: Annotated[list[str] | None, typer.Argument(metavar="FILE-or-NAME...")] = None,
    unit: Annotated[str | None, typer.Option(help="Unit of a file that does not state it: g, cm/s^2, ...")] = None,
    time_step: Annotated[
        str | None, typer.Option(metavar="0.01s", help="Time step of a file that does not state it.")
    ] = None,
    channel: Annotated[
        str | None, typer.Option(help="Channel to read from a multi-channel file (number or direction).")
    ] = None,
    layout: Annotated[
        str | None, typer.Option(metavar="rows|columns", help="How the numbers of a plain table run.")
    ] = None,
    factor: Annotated[
        float | None, typer.Option(help="Factor of a header by which to multiply the values, or 1 if they contain it.")
    ] = None,
    match: Annotated[
        str | None,
        typer.Option(metavar="en1998:0.3g,B | asce7:0.9g,0.4g,8s | FILE", help="Match the motion to this spectrum."),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR|FILE.txt",
            help="Write figure and columns, in g, of each motion here; of one motion the columns into a file.",
        ),
    ] = None,
    figure: Annotated[
        Path | None, typer.Option(hidden=True, help="Draw one motion into this file; --out writes it, too.")
    ] = None,
    json_: JsonPath = None,
    units: UnitsName = "si",
    details: Details = False,
    list_: Annotated[bool, typer.Option("--list", help="List the records available by name.")] = False,
) -> None:
    """Print what is in a record, its components, or a folder of them: peaks, intensity measures, origin, warnings.

    With --out or --figure it draws them, too.

    Formats: PEER AT2, COSMOS and CSMIP V2, USGS SMC, K-NET, CWA and CWB, ESM and ITACA ASC, AFAD, GeoNet V1A and V2A,
    USC V2, CSMNC, UNAM and CICESE, V1 of CSMIP, USC, BHRC and RENADIC, tables with any header, miniSEED and SAC
    (with the package obspy); all of them also in zip, tar, gz or bz2.
    """
    from heeltoe.motion.records.catalog import available

    words = console()
    unit_system(units, "--units")
    if list_:
        for name, where in available():
            words.print(f"{plain(name):40s} {plain(where)}", soft_wrap=True, markup=False)
        return
    if not files:
        raise InputError("missing", "FILE-or-NAME", remedy="give a file or a name, or --list")
    check_json(json_)
    from heeltoe.models.cost import reading_cost

    folders = [file for file in files if os.path.isdir(file)]
    say_cost(reading_cost(files))
    read = [motion for file in files for motion in _motions(file, unit, time_step, channel, layout, factor)]
    motions = _called_apart(read)
    misfits: list[Misfit] = []
    matches: list[Matched] | None = None
    if match is not None:
        motions, misfits, matches = _matched(motions, match)
    written = _written(motions, matches, out, figure, units)
    finish(
        lambda: _json(motions, misfits),
        json_,
        written,
        lambda shown: _show(motions, misfits, shown, units, len(files) > 1 and not folders, details),
    )


def _show(
    motions: list[GroundMotion], misfits: list[Misfit], words: Console, units: str, components: bool, details: bool
) -> None:
    from heeltoe.motion.check import check_pair
    from heeltoe.views.terminal.motion import print_motion, print_motions
    from heeltoe.views.terminal.screen import print_warnings

    side_by_side = 1 < len(motions) <= _SIDE_BY_SIDE
    if side_by_side:
        print_motions(motions, words, units, details=details)
    for k, motion in enumerate(motions):
        if not side_by_side:
            print_motion(motion, words, units, details=details)
        if misfits:
            whose = f"{plain(motion.name)}: " if side_by_side else "  "
            words.print(f"{whose}{misfits[k]}", soft_wrap=True, markup=False)
        if not side_by_side:
            words.print()
    if components:
        notices = [notice.text(units) for other in motions[1:] for notice in check_pair(motions[0], other)]
        print_warnings(tuple(dict.fromkeys(notices)), words)
    elif len(motions) > 1:
        words.print(f"{len(motions)} channels; --channel NUMBER shows and draws one", soft_wrap=True)


def _json(motions: list[GroundMotion], misfits: list[Misfit]) -> dict[str, object]:
    """Return the numbers of each motion, with its response spectrum."""
    from heeltoe.motion.spectrum import response_spectrum
    from heeltoe.result.write import motion_json

    rows = []
    for k, motion in enumerate(motions):
        spectrum = response_spectrum(motion)
        rows.append(
            {
                **motion_json(motion, STANDARD_GRAVITY),
                **{name: getattr(motion, name) for name in _ABOUT},
                "warnings": [warning.to_json() for warning in motion.warnings],
                "spectrum": {
                    "damping": spectrum.damping,
                    "period_s": spectrum.period.tolist(),
                    "pseudo_acceleration_m_s2": spectrum.pseudo_acceleration.tolist(),
                },
                **({"misfit": {"rms": misfits[k].rms, "largest": misfits[k].largest}} if misfits else {}),
            }
        )
    return {"motions": rows}


def _matched(motions: list[GroundMotion], text: str) -> tuple[list[GroundMotion], list[Misfit], list[Matched]]:
    """Match each motion to a spectrum, as far as that goes and the motion lasts."""
    from heeltoe.motion.check import check_scaling
    from heeltoe.motion.matching import match_known_band
    from heeltoe.motion.targets import target_of
    from heeltoe.views.figures.motion import Matched

    target = target_of(text, "--match")
    pairs = [match_known_band(motion, target) for motion in motions]
    records = [motion.scaled(misfit.scale) for motion, (_, misfit) in zip(motions, pairs, strict=True)]
    # Every motion that is shown gets the same warnings of its peak.
    looked_at = [
        matched.with_warnings(*check_scaling(motion, misfit.scale, "--match"))
        for motion, (matched, misfit) in zip(motions, pairs, strict=True)
    ]
    return looked_at, [misfit for _, misfit in pairs], [Matched(target, record) for record in records]


def _written(
    motions: list[GroundMotion], matches: list[Matched] | None, out: Path | None, figure: Path | None, units: str
) -> list[Path]:
    """Write figures and columns where that is wanted: of each motion into a directory, of one into a file."""
    from heeltoe.base.atomic_files import check_directory, write_text
    from heeltoe.views.figures.motion import write_motion_figure

    # A name that is too long for any file is no directory, either: Path.is_dir raises.
    into = out if out is not None and (os.path.isdir(out) or not out.suffix) else None
    for option, option_value in (("--figure", figure), ("--out", None if into else out)):
        if option_value is not None and len(motions) > 1:
            raise InputError("motion-one", option, f"{len(motions)} motions")
    if figure is not None and figure.suffix.lower() not in (".png", ".svg", ".pdf"):
        raise InputError("file-ending", "--figure", figure, kind="a figure", endings=".png, .svg or .pdf")
    if into is not None:
        check_directory(into, "--out")
        try:
            into.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError("cannot-write", "--out", into, reason=error.strerror or error) from None
    written = []
    for number, motion in enumerate(motions):
        name = _file_name(motion.name)
        place = figure or (into and into / f"{name}.motion.png")
        if place is not None:
            matched = matches[number] if matches else None
            written.append(write_motion_figure(motion, STANDARD_GRAVITY, place, units, matched))
        columns = into / f"{name}.txt" if into else out
        if columns is not None:
            written.append(write_text(columns, _columns(motion), "--out"))
    return written


def _columns(motion: GroundMotion) -> str:
    """Return a motion in two columns below what was done to it."""
    rows = zip(motion.time, motion.acceleration / STANDARD_GRAVITY, strict=True)
    header = f"# processing: {'; '.join(motion.processing)}\n" if motion.processing else ""
    return f"{header}# time [s], acceleration [g]\n" + "".join(f"{t:.6f} {a:.9e}\n" for t, a in rows)


def _motions(
    file: str, unit: str | None, time_step: str | None, channel: str | None, layout: str | None, factor: float | None
) -> list[GroundMotion]:
    """Read what is to be looked at: all channels of a file, or of all in a folder, the one wanted, or a motion made to
    order."""
    from heeltoe.motion.records.catalog import PREFIX, find
    from heeltoe.motion.records.read import read_channels, read_record
    from heeltoe.motion.scenario import synthetic

    given = {"--unit": unit, "--time-step": time_step, "--channel": channel, "--layout": layout, "--factor": factor}
    if file.startswith(PREFIX):
        for option, value in given.items():
            if value is not None:
                raise InputError("option-foreign", option, owner="a synthetic motion", remedy="")
        return [synthetic(file, field="FILE-or-NAME")]
    step = None if time_step is None else parse(time_step, "duration", "--time-step")
    if layout not in (None, "rows", "columns"):
        raise InputError("not-a-choice", "--layout", shown(layout), choices='"rows" or "columns"')
    if os.path.isdir(file):
        return [
            motion
            for path in _files_of(file)
            for motion in _accelerations(path, unit, time_step, channel, layout, factor)
        ]
    path = find(file, Path.cwd(), field="FILE-or-NAME")
    options = {"unit": unit, "time_step": step, "layout": layout, "factor": factor}
    try:
        if channel is None:
            return read_channels(path, **options)  # type: ignore[arg-type]
        return [read_record(path, channel, **options, assume=True)]  # type: ignore[arg-type]
    except InputError as error:
        # A case has fields for what are options here.
        error.field, error.remedy = (_FIELD_OF_CASE.sub(_option_of, text) for text in (error.field, error.remedy))
        raise


def _option_of(field: re.Match[str]) -> str:
    return f"--{field[1].replace('_', '-')}"


def _files_of(folder: str) -> list[str]:
    """Return the files of records in a folder as it was downloaded."""
    from heeltoe.study.plan.motions import records_of

    return records_of(folder, Path.cwd(), "FILE-or-NAME")


def _accelerations(file: str, *options: Any) -> list[GroundMotion]:
    """Read a file of a folder; velocities and displacements are left out."""
    try:
        return _motions(file, *options)
    except InputError as error:
        if error.code != "record-not-acceleration":
            raise
        return []


def _called_apart(motions: list[GroundMotion]) -> list[GroundMotion]:
    """Return motions with a name each: files of one name that differ in their ending are called with it."""
    names = [motion.name for motion in motions]
    return [
        replace(motion, name=f"{motion.name}{Path(motion.source).suffix}") if names.count(motion.name) > 1 else motion
        for motion in motions
    ]


def _file_name(name: str) -> str:
    """A motion's name without what file systems and shells do not like."""
    return "".join(c if c.isalnum() or c in "-_." else "-" for c in name)
