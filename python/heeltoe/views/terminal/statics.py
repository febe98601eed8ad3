"""What the terminal shows of the static checks (rich)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from heeltoe.models.statics.checks import Check
from heeltoe.models.statics.load_case import LoadCase
from heeltoe.models.statics.model import Statics
from heeltoe.units.sentences import numbers
from heeltoe.views.terminal.common import label_grid, label_lines, print_title, print_warnings, quiet_table
from heeltoe.views.words.statics import basis, check_cells, failed, verdict_of

# Label, how numbers are written (in SI, without a minus before zero), what they are; or words without a form.
_ROWS: tuple[tuple[str, str, Callable[[LoadCase], float | str | None]], ...] = (
    ("outcome", "", lambda found: found.outcome),
    ("normal force", "z.3f MN/m", lambda found: found.normal_force_n),
    ("shear force", "z.3f MN/m", lambda found: found.shear_force_n),
    ("friction", "g", lambda found: found.friction),
    ("cohesion", "z.3f MN/m", lambda found: found.cohesive_force_n),
    ("sliding factor", "z.2f", lambda found: found.sliding_factor),
    ("overturning factor", "z.2f", lambda found: found.overturning_factor),
    ("  about the", "", lambda found: found.overturning_about),
    ("flotation factor", "z.2f", lambda found: found.flotation_factor),
    ("resultant at", "z.2f m", lambda found: found.resultant_from_heel_m),
    ("  within", "", lambda found: found.resultant_zone.replace("middle", "mid")),
    ("stress at heel", "z.3f MPa", lambda found: found.heel_stress_pa),
    ("stress at toe", "z.3f MPa", lambda found: found.toe_stress_pa),
    ("contact B", "z.2f m", lambda found: found.contact_width_m),
    ("  compressed", "z.2f m", lambda found: found.compressed_length_m),
    ("  open", "z.2f m", lambda found: found.cracked_length_m or None),
    ("  open from the", "", lambda found: found.cracked_from if found.cracked_length_m else "-"),
)


def print_statics(found: Statics, console: Console, units: str = "si") -> None:
    """Print what the checks rest on, the load cases, the checks, warnings and verdict."""
    print_title(found.title, "statics", console)
    console.print()
    console.print(label_lines((label, escape(text)) for label, text in basis(found, units)))
    console.print()
    console.print(_cases(found, units))
    console.print()
    console.print(_checks(found.checks))
    console.print()
    console.print("[dim]resultant: at, from the heel; checked, from the middle; f: compressive strength[/dim]")
    sources = _sources(found.checks)
    said = [(str(number), source) for source, number in sources.items()]
    said += [(", ".join(map(str, of)), note) for note, of in _notes(found.checks, sources).items()]
    for lines in (said, _assumptions(found.cases, units)):
        if lines:
            console.print()
            console.print(label_lines((label, escape(text)) for label, text in lines))
    print_warnings([warning.text(units) for warning in found.warnings], console)
    console.print()
    verdict = label_grid()
    verdict.add_row(f"[{'bold' if found.ok else 'bold red'}]Verdict[/]", verdict_of(found))
    for text in failed(found, units):
        verdict.add_row("", f"[red]{escape(text)}[/red]")
    console.print(verdict)


def _assumptions(cases: tuple[LoadCase, ...], units: str) -> list[tuple[str, str]]:
    """Return each assumption once, beside the load cases that share it."""
    shared: dict[str, list[str]] = {}
    for each in cases:
        for text in each.assumptions:
            shared.setdefault(text.text(units), []).append(each.name)
    # The two ways of the earthquake share nearly all.
    return [(names[0] if len(names) == 1 else names[0].split()[0], text) for text, names in shared.items()]


def _cases(found: Statics, units: str) -> Table:
    table = quiet_table()
    table.add_column("", no_wrap=True)
    for each in found.cases:
        # Five cases with long names are to fit beside each other.
        table.add_column(each.name.replace(" ", "\n").replace("-", "-\n"), justify="right", no_wrap=True)
    for label, form, read in _ROWS:
        table.add_row(*_row(label, form, [read(each) for each in found.cases], units))
    return table


def _row(label: str, form: str, cells: Sequence[float | str | None], units: str) -> list[str]:
    """Return a row: words, or numbers whose unit stands beside the label; a dash where there is no number."""
    values = [cell for cell in cells if isinstance(cell, float)]
    if not form:
        return [label, *map(str, cells)]
    texts, unit = numbers(values, form, units)
    left = iter(texts)
    return [f"{label}, {unit}" if unit else label, *("-" if cell is None else next(left) for cell in cells)]


def _checks(checks: tuple[Check, ...]) -> Table:
    table = quiet_table()
    table.add_column("load case")
    table.add_column("check")
    table.add_column("is", justify="right")
    table.add_column("required", justify="right")
    table.add_column("")
    table.add_column("by", justify="right")
    numbers = _sources(checks)
    for check in checks:
        table.add_row(
            *check_cells(check),
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
