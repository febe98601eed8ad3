"""What the terminal shows of a motion."""

from __future__ import annotations

from rich.console import Console
from rich.markup import escape

from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.views.terminal.common import label_lines, print_warnings
from heeltoe.views.words.motion import about_motion, suspicions


def print_motion(motion: GroundMotion, console: Console, units: str = "si", gravity: float = STANDARD_GRAVITY) -> None:
    """Print what is in a record."""
    console.print(label_lines((label, escape(text)) for label, text in about_motion(motion, units, gravity)))
    own = (each.text(units) for each in motion.warnings)
    print_warnings((*own, *suspicions(motion, units, gravity)), console)
