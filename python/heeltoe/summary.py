"""What the terminal shows of a motion and of a response (rich)."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table

from heeltoe.errors import InputError
from heeltoe.measures import measures
from heeltoe.motion import GroundMotion, check
from heeltoe.response import Response
from heeltoe.verdicts import length, verdict


def print_summary(response: Response, console: Console) -> None:
    """Print motion, static state, result, warnings and verdict."""
    console.print(f"[bold]{response.title or 'Untitled case'}[/bold]  ({response.model} model)")
    console.print()
    grid = _grid()
    for label, motion in (("motion", response.motion), ("vertical motion", response.vertical)):
        if motion is not None:
            grid.add_row(label, _motion_line(motion, response.gravity))
    for label, text in _static_lines(response):
        grid.add_row(label, text)
    console.print(grid)
    console.print()
    if response.summary:
        console.print(_result_table(response))
    _print_warnings(response.warnings, console)
    style = "bold" if response.ok else "bold red"
    console.print()
    console.print(f"[{style}]Verdict[/{style}]  {verdict(response)}")


def print_motion(motion: GroundMotion, console: Console, gravity: float = 9.80665) -> None:
    """Print what is in a record."""
    grid = _grid()
    for label, text in (
        ("name", motion.name),
        ("event", motion.event),
        ("station", motion.station),
        ("component", motion.component),
        ("date", motion.date),
        ("format", motion.format),
        ("read as", motion.units_as_read),
        ("samples", f"{motion.time.size}, {_steps(motion)}, {motion.duration:.5g} s in all"),
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
    _print_warnings((*motion.warnings, *_suspicions(motion, gravity)), console)


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
        return check(motion, gravity, allow_zero=True)
    except InputError as error:
        return (str(error),)


def _grid() -> Table:
    grid = Table.grid(padding=(0, 2))
    grid.add_column(style="dim", no_wrap=True)
    grid.add_column()
    return grid


def _print_warnings(warnings: tuple[str, ...], console: Console) -> None:
    for warning in warnings:
        console.print(f"[yellow]warning[/yellow]  {warning}")


def _length(value: float) -> str:
    return length(value) if value else "-"


def _steps(motion: GroundMotion) -> str:
    return f"every {motion.dt:.5g} s" if motion.is_uniform else "in unequal steps"


def _motion_line(motion: GroundMotion, gravity: float) -> str:
    line = (
        f"{motion.name}: PGA {motion.pga / gravity:.4g} g, PGV {motion.pgv:.3g} m/s, PGD {motion.pgd:.3g} m, "
        f"{motion.duration:.4g} s {_steps(motion)}"
    )
    return "\n".join([line, *motion.processing])


def _static_lines(response: Response) -> list[tuple[str, str]]:
    static = response.static
    lines = []
    factor = static["sliding_safety_factor"]
    lines.append(
        (
            "sliding safety factor",
            "no horizontal force" if factor is None else f"{factor:.3f} under static loads",
        )
    )
    critical = static["critical_acceleration_g"]
    for kind in ("sliding", "rocking"):
        down, up = critical[f"{kind}_downstream"], critical[f"{kind}_upstream"]
        lines.append((f"{kind} starts at", f"{down:.4f} g downstream, {up:.4f} g upstream"))
    return lines


def _result_table(response: Response) -> Table:
    table = Table(show_edge=False, pad_edge=False, header_style="dim")
    table.add_column("")
    table.add_column("downstream", justify="right")
    table.add_column("upstream", justify="right")
    slip = response.residual_slip_m
    table.add_row("residual slip", *(_length(max(0.0, way * slip)) for way in (1, -1)))
    rotations = (response.rocking_downstream_rad, response.rocking_upstream_rad)
    openings = (response.opening_upstream_m, response.opening_downstream_m)
    table.add_row("peak slip", *map(_length, (response.peak_slip_downstream_m, -response.peak_slip_upstream_m)))
    table.add_row("largest rotation", *(f"{value:.3e} rad" if value else "-" for value in rotations))
    table.add_row("opening it means, other face", *map(_length, openings))
    parts = response.slip_by_mode_m
    used = [f"{name.replace('_', '-')} {length(value)}" for name, value in parts.items() if abs(value) >= 5e-6]
    times = [
        f"{name.replace('_', '-')} {value:.2f} s" for name, value in response.time_by_mode_s.items() if value >= 5e-3
    ]
    energy = response.energy
    table.caption = "\n".join(
        [
            *(["slip by mode: " + ", ".join(used)] if used else []),
            "time: " + ", ".join(times),
            f"{response.events} events, {response.impacts} impacts; energy ledger closes to "
            f"{energy.residual if energy else 0.0:.0e}",
        ]
    )
    table.caption_justify = "left"
    return table
