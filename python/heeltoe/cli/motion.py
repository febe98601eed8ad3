"""The command that says what is in a record."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from heeltoe.cli.common import UnitsName, say_file
from heeltoe.cli.streams import console
from heeltoe.errors import InputError
from heeltoe.plain import plain
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.systems import unit_system

if TYPE_CHECKING:
    from heeltoe.motion.ground_motion import GroundMotion


def motion(
    file: Annotated[str | None, typer.Argument(metavar="FILE-or-NAME")] = None,
    unit: Annotated[str | None, typer.Option(help="Unit of a file that does not state it: g, cm/s^2, ...")] = None,
    time_step: Annotated[str | None, typer.Option(metavar="0.01s", help="Of a file that does not state it.")] = None,
    channel: Annotated[str | None, typer.Option(help="Of a file of several: its number or direction.")] = None,
    figure: Annotated[
        Path | None, typer.Option(metavar="FILE.png", help="Where to draw it; NAME.motion.png here if not said.")
    ] = None,
    no_figure: Annotated[bool, typer.Option("--no-figure", help="Do not draw it.")] = False,
    units: UnitsName = "si",
    list_: Annotated[bool, typer.Option("--list", help="List the records that can be used by name.")] = False,
) -> None:
    """Say what is in a record: peaks, measures, origin, warnings; and draw it."""
    from heeltoe.motion.records.catalog import available
    from heeltoe.views.terminal.motion import print_motion

    words = console()
    unit_system(units, "--units")
    if list_:
        for name, where in available():
            words.print(f"{plain(name):40s} {plain(where)}", soft_wrap=True, markup=False)
        return
    if file is None:
        raise InputError("record-missing", "FILE-or-NAME")
    motions = _motions(file, unit, time_step, channel)
    written = None
    if len(motions) == 1 and not no_figure:
        from heeltoe.views.figures.motion import write_motion_figure

        place = figure or Path(f"{_file_name(motions[0].name)}.motion.png")
        if place.suffix.lower() not in (".png", ".svg", ".pdf"):
            raise InputError("figure-format", "--figure", place)
        written = write_motion_figure(motions[0], STANDARD_GRAVITY, place, units)
    for each in motions:
        print_motion(each, words, units)
        words.print()
    if written:
        say_file("wrote", written, words)
    elif len(motions) > 1:
        words.print(f"{len(motions)} channels; --channel NUMBER shows and draws one", soft_wrap=True)


def _motions(file: str, unit: str | None, time_step: str | None, channel: str | None) -> list[GroundMotion]:
    """Read what is to be looked at: all channels of a file, the one wanted, or a motion made to order."""
    from heeltoe.motion.records import read_channels, read_record
    from heeltoe.motion.records.catalog import find
    from heeltoe.motion.scenario import PREFIX, synthetic
    from heeltoe.units.parse import parse

    if file.startswith(PREFIX):
        for option, value in (("--unit", unit), ("--time-step", time_step), ("--channel", channel)):
            if value is not None:
                raise InputError("synthetic-option", option)
        return [synthetic(file, field="FILE-or-NAME")]
    step = None if time_step is None else parse(time_step, "duration", "--time-step")
    path = find(file, Path.cwd(), field="FILE-or-NAME")
    if channel is None:
        return read_channels(path, unit=unit, time_step=step)
    return [read_record(path, channel, unit=unit, time_step=step, assume=True)]


def _file_name(name: str) -> str:
    """A motion's name without what file systems and shells do not like."""
    return "".join(c if c.isalnum() or c in "-_." else "-" for c in name)
