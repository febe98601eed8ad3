"""A motion on the terminal."""

from __future__ import annotations

from collections.abc import Sequence

from rich.console import Console

from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.views.terminal.screen import label_lines, print_warnings, quiet_table, safe
from heeltoe.views.words.motion import about_motion, about_motions, suspicions

#: The short form says where and how strong a motion is.
_SHORT = ("name", "event", "samples", "PGA", "PGV", "PGD", "Arias intensity", "significant duration", "motions")


def print_motion(
    motion: GroundMotion,
    console: Console,
    units: str = "si",
    gravity: float = STANDARD_GRAVITY,
    *,
    details: bool = False,
) -> None:
    """Print what is in a record, short or in detail."""
    lines = about_motion(motion, units, gravity)
    console.print(label_lines((label, safe(text)) for label, text in lines if details or label in _SHORT))
    print_warnings(_doubts(motion, units, gravity), console)


def print_motions(
    motions: Sequence[GroundMotion],
    console: Console,
    units: str = "si",
    gravity: float = STANDARD_GRAVITY,
    *,
    details: bool = False,
) -> None:
    """Print what is in the components of a record, side by side, short or in detail."""
    table = quiet_table()
    (_, names), *lines = about_motions(motions, units, gravity)
    table.add_column("", no_wrap=True)
    for name in names:
        # Names of files are long, and cut short they are all the same.
        table.add_column(safe(name), overflow="fold")
    for label, texts in lines:
        if not details and label not in _SHORT:
            continue
        table.add_row(label, *map(safe, texts))
    console.print(table)
    doubts = [(motion.name, text) for motion in motions for text in _doubts(motion, units, gravity)]
    print_warnings((text if name in text else f"{name}: {text}" for name, text in doubts), console)


def _doubts(motion: GroundMotion, units: str, gravity: float) -> list[str]:
    return [*(warning.text(units) for warning in motion.warnings), *suspicions(motion, units, gravity)]
