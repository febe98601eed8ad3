"""What the terminal shows of the static checks (rich)."""

from __future__ import annotations

import math
from collections.abc import Callable

from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from heeltoe.models.statics.checks import Check
from heeltoe.models.statics.load_case import LoadCase
from heeltoe.models.statics.model import Statics

_ROWS: tuple[tuple[str, Callable[[LoadCase], str]], ...] = (
    ("outcome", lambda found: found.outcome),
    ("normal force, MN/m", lambda found: f"{found.normal_force_n / 1e6:.3f}"),
    ("shear force, MN/m", lambda found: f"{found.shear_force_n / 1e6:.3f}"),
    ("friction", lambda found: f"{found.friction:g}"),
    ("cohesion, MN/m", lambda found: f"{found.cohesive_force_n / 1e6:.3f}"),
    ("sliding factor", lambda found: _number(found.sliding_factor)),
    ("overturning factor", lambda found: _number(found.overturning_factor)),
    ("  about the", lambda found: found.overturning_about),
    ("flotation factor", lambda found: _number(found.flotation_factor)),
    ("resultant at, m", lambda found: _number(found.resultant_from_heel_m)),
    ("  within", lambda found: found.resultant_zone.replace("middle", "mid")),
    ("stress at heel, MPa", lambda found: _number(found.heel_stress_pa, 1e6, 3)),
    ("stress at toe, MPa", lambda found: _number(found.toe_stress_pa, 1e6, 3)),
    ("contact B, m", lambda found: _number(found.contact_width_m)),
    ("  compressed, m", lambda found: _number(found.compressed_length_m)),
    ("  open, m", lambda found: _number(found.cracked_length_m or None)),
    ("  open from the", lambda found: found.cracked_from if found.cracked_length_m else "-"),
)


def print_statics(found: Statics, console: Console) -> None:
    """Print what the checks rest on, the load cases, the checks, warnings and verdict."""
    console.print(f"[bold]{escape(found.title or 'Untitled case')}[/bold]  (statics)", soft_wrap=True)
    console.print()
    head = _grid()
    for label, text in _head(found):
        head.add_row(label, escape(text))
    console.print(head)
    console.print()
    console.print(_cases(found))
    console.print()
    console.print(_checks(found.checks))
    console.print()
    console.print("[dim]resultant: at, from the heel; checked, from the middle; f: compressive strength[/dim]")
    said = _grid()
    numbers = _sources(found.checks)
    for source, number in numbers.items():
        said.add_row(str(number), escape(source))
    for note, of in _notes(found.checks, numbers).items():
        said.add_row(", ".join(map(str, of)), escape(note))
    console.print()
    console.print(said)
    said = _grid()
    for label, text in _assumptions(found.cases):
        said.add_row(label, escape(text))
    if said.row_count:
        console.print()
        console.print(said)
    if found.warnings:
        console.print()
    for warning in found.warnings:
        console.print(f"[yellow]warning[/yellow]  {escape(str(warning))}")
    console.print()
    failed = [check for check in found.checks if not check.met]
    verdict = _grid()
    count = (
        f"all {len(found.checks)} checks are met" if found.ok else f"{len(failed)} of {len(found.checks)} checks fail"
    )
    verdict.add_row(f"[{'bold' if found.ok else 'bold red'}]Verdict[/]", f"{count} ({found.criteria})")
    for check in failed:
        verdict.add_row("", f"[red]{escape(check.sentence)}[/red]")
    console.print(verdict)


def _head(found: Statics) -> list[tuple[str, str]]:
    critical, water = found.critical_acceleration_g, found.critical_water_level_m
    lines = [("criteria", f"{found.criteria}, {found.structure} structure, {found.site_information} site information")]
    for kind in ("sliding", "rocking"):
        down, up = critical[f"{kind}_downstream"], critical[f"{kind}_upstream"]
        lines.append((f"{kind} starts at", f"{_acceleration(down)} downstream, {_acceleration(up)} upstream"))
    for key, label in (
        ("sliding", "sliding factor 1 at"),
        ("sliding_required", "sliding factor required at"),
        ("overturning", "overturns at"),
        ("flotation", "floats at"),
    ):
        level = water[key]
        lines.append((label, "none up to the crest" if level is None else f"{level:.2f} m of water"))
    if found.slip_m is not None:
        lines.append(("residual slip", f"{found.slip_m:.4f} m: {found.slip_source}"))
    return lines


def _assumptions(cases: tuple[LoadCase, ...]) -> list[tuple[str, str]]:
    """Return each assumption once, beside the load cases that share it."""
    shared: dict[str, list[str]] = {}
    for each in cases:
        for text in each.assumptions:
            shared.setdefault(text, []).append(each.name)
    # The two ways of the earthquake share nearly all.
    return [(names[0] if len(names) == 1 else names[0].split()[0], text) for text, names in shared.items()]


def _cases(found: Statics) -> Table:
    table = _table()
    table.add_column("", no_wrap=True)
    for each in found.cases:
        # Five cases with long names are to fit beside each other.
        table.add_column(each.name.replace(" ", "\n").replace("-", "-\n"), justify="right", no_wrap=True)
    for label, text in _ROWS:
        table.add_row(label, *(text(each) for each in found.cases))
    return table


def _checks(checks: tuple[Check, ...]) -> Table:
    table = _table()
    table.add_column("load case")
    table.add_column("check")
    table.add_column("is", justify="right")
    table.add_column("required", justify="right")
    table.add_column("")
    table.add_column("by", justify="right")
    numbers = _sources(checks)
    for check in checks:
        bound = "-"
        if check.required is not None:
            bound = f"{'≥' if check.at_least else '≤'} {_value(check, check.required)}"
        table.add_row(
            check.load_case,
            check.name,
            _value(check, check.value),
            bound,
            "met" if check.met else "[bold red]fails[/]",
            str(numbers.get(check.source, "")),
        )
    return table


def _sources(checks: tuple[Check, ...]) -> dict[str, int]:
    """Return the sources of the required values, numbered."""
    found = dict.fromkeys(check.source for check in checks if check.required is not None)
    return {source: number for number, source in enumerate(found, start=1)}


def _notes(checks: tuple[Check, ...], numbers: dict[str, int]) -> dict[str, list[int]]:
    """Return each part of the notes once, with the numbers of the sources it is about."""
    notes: dict[str, set[int]] = {}
    for check in checks:
        for text in filter(None, check.note.split("; ")):
            notes.setdefault(text, set()).add(numbers[check.source])
    return {text: sorted(of) for text, of in notes.items()}


def _value(check: Check, value: float | None) -> str:
    if value is None:
        return "-"
    of = {"resultant": " B", "compression": " f"}.get(check.name, "")
    return f"{value:.3f}{of}" if of else f"{value:.2f}"


def _number(value: float | None, unit: float = 1.0, digits: int = 2) -> str:
    # Rounded first and added to zero: there is no minus zero.
    return "-" if value is None else f"{round(value / unit, digits) + 0.0:.{digits}f}"


def _acceleration(value: float) -> str:
    return f"{value:.4f} g" if math.isfinite(value) else "no acceleration"


def _table() -> Table:
    return Table(box=box.SIMPLE_HEAD, show_edge=False, pad_edge=False, header_style="dim", border_style="dim")


def _grid() -> Table:
    grid = Table.grid(padding=(0, 2))
    grid.add_column(style="dim", no_wrap=True)
    grid.add_column()
    return grid
