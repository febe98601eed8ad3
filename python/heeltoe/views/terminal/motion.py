"""What the terminal shows of a motion."""

from __future__ import annotations

from functools import partial

from rich.console import Console
from rich.markup import escape

from heeltoe.errors import InputError
from heeltoe.motion.check import check, check_record
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import measures
from heeltoe.plain import plain
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.sentences import quantity, written
from heeltoe.views.terminal.common import label_grid, print_warnings, sampling


def print_motion(motion: GroundMotion, console: Console, units: str = "si", gravity: float = STANDARD_GRAVITY) -> None:
    """Print what is in a record."""
    grid = label_grid()
    for label, text in (
        ("name", motion.name),
        ("event", motion.event),
        ("station", motion.station),
        ("component", motion.component),
        ("date", motion.date),
        ("format", motion.format),
        ("read as", motion.units_as_read),
        ("samples", f"{motion.time.size}, {sampling(motion)}, {motion.duration:.5g} s in all"),
        ("PGA", f"{motion.pga / gravity:.5g} g"),
        ("PGV", quantity(motion.pgv, ".4g m/s", units)),
        ("PGD", quantity(motion.pgd, ".4g m", units)),
        *_measure_lines(motion, gravity, units),
        ("processing", "; ".join(motion.processing)),
        ("source", motion.source),
    ):
        if text:
            grid.add_row(label, escape(plain(text)))
    console.print(grid)
    print_warnings((*(each.text(units) for each in motion.warnings), *_suspicions(motion, gravity, units)), console)


def _measure_lines(motion: GroundMotion, gravity: float, units: str) -> list[tuple[str, str]]:
    found = measures(motion, gravity)
    lines = [
        ("Arias intensity", quantity(found["arias_intensity_m_s"], ".4g m/s", units)),
        ("CAV", quantity(found["cav_m_s"], ".4g m/s", units)),
    ]
    if "significant_duration_s" in found:
        lines.append(("significant duration", f"{found['significant_duration_s']:.4g} s (5-95 %)"))
    if "mean_period_s" in found:
        lines.append(("mean period", f"{found['mean_period_s']:.4g} s"))
    end = written("{end_velocity_m_s:.3g m/s}, {end_displacement_m:.3g m}", units, **found)
    return [*lines, ("at the end, from rest", end)]


def _suspicions(motion: GroundMotion, gravity: float, units: str) -> tuple[str, ...]:
    """What an analysis would say about the record; here even what it would refuse is only said."""
    said: list[str] = []
    for look in (partial(check_record, upward=None), partial(check, allow_zero=True)):
        try:
            said += [each.text(units) for each in look(motion, gravity)]
        except InputError as error:
            said.append(str(error))
    return tuple(dict.fromkeys(said))
