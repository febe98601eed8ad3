"""What the terminal shows of a motion."""

from __future__ import annotations

from rich.console import Console

from heeltoe.errors import InputError
from heeltoe.motion.check import check
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import measures
from heeltoe.views.terminal.common import label_grid, print_warnings, sampling


def print_motion(motion: GroundMotion, console: Console, gravity: float = 9.80665) -> None:
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
        ("PGV", f"{motion.pgv:.4g} m/s"),
        ("PGD", f"{motion.pgd:.4g} m"),
        *_measure_lines(motion, gravity),
        ("processing", "; ".join(motion.processing)),
        ("source", motion.source),
    ):
        if text:
            grid.add_row(label, text)
    console.print(grid)
    print_warnings((*map(str, motion.warnings), *_suspicions(motion, gravity)), console)


def _measure_lines(motion: GroundMotion, gravity: float) -> list[tuple[str, str]]:
    found = measures(motion, gravity)
    lines = [("Arias intensity", f"{found['arias_intensity_m_s']:.4g} m/s"), ("CAV", f"{found['cav_m_s']:.4g} m/s")]
    if "significant_duration_s" in found:
        lines.append(("significant duration", f"{found['significant_duration_s']:.4g} s (5-95 %)"))
    if "mean_period_s" in found:
        lines.append(("mean period", f"{found['mean_period_s']:.4g} s"))
    end = f"{found['end_velocity_m_s']:.3g} m/s, {found['end_displacement_m']:.3g} m"
    return [*lines, ("at the end, from rest", end)]


def _suspicions(motion: GroundMotion, gravity: float) -> tuple[str, ...]:
    """What an analysis would say about the record; here even what it would refuse is only said."""
    try:
        return tuple(map(str, check(motion, gravity, allow_zero=True)))
    except InputError as error:
        return (str(error),)
