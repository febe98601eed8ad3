"""What the terminal shows of the static checks (rich)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from rich.console import Console
from rich.markup import escape
from rich.measure import Measurement
from rich.table import Table

from heeltoe.models.statics.checks import Check
from heeltoe.models.statics.joints import Joint, Joints
from heeltoe.models.statics.load_case import LoadCase
from heeltoe.models.statics.model import Statics
from heeltoe.study.statics import StaticsTable
from heeltoe.units.sentences import numbers, quantity
from heeltoe.views.terminal.common import label_grid, label_lines, print_title, print_warnings, quiet_table
from heeltoe.views.words.sheet import lines, steps
from heeltoe.views.words.statics import basis, check_cells, failed, section_rows, section_warnings, verdict_of

# Label, how numbers are written (in SI, without a minus before zero), what they are; or words without a form.
_ROWS: tuple[tuple[str, str, Callable[[LoadCase], float | str | None]], ...] = (
    ("outcome", "", lambda found: found.outcome),
    ("normal force", "z.3f MN/m", lambda found: found.normal_force_n),
    ("shear force", "z.3f MN/m", lambda found: found.shear_force_n),
    ("friction", "g", lambda found: found.friction),
    ("cohesion", "z.3f MN/m", lambda found: found.cohesive_force_n),
    ("sliding factor", "z.2f", lambda found: found.sliding_factor),
    ("  on its pieces", "z.2f", lambda found: found.sliding_factor_on_pieces),
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


def print_statics(found: Statics, console: Console, units: str = "si", warnings: Sequence[str] | None = None) -> None:
    """Print what the checks rest on, the load cases, the checks, warnings (its own, or others) and verdict."""
    print_title(found.title, "statics", console)
    console.print()
    console.print(label_lines((label, escape(text)) for label, text in basis(found, units)))
    console.print()
    for cases in _beside(found.cases, console, units):
        console.print(_cases(cases, units))
        console.print()
    console.print(_checks(found.checks))
    console.print()
    console.print("[dim]resultant: at, from the heel; checked, from the middle; f: compressive strength[/dim]")
    sources = _sources(found.checks)
    said = [(str(number), source) for source, number in sources.items()]
    said += [(", ".join(map(str, of)), note) for note, of in _notes(found.checks, sources).items()]
    for told in (said, _assumptions(found.cases, units)):
        if told:
            console.print()
            console.print(label_lines((label, escape(text)) for label, text in told))
    if warnings is None:
        warnings = [warning.text(units) for warning in found.warnings]
    print_warnings(warnings, console)
    console.print()
    verdict = label_grid()
    verdict.add_row(f"[{'bold' if found.ok else 'bold red'}]Verdict[/]", verdict_of(found))
    for text in failed(found, units):
        verdict.add_row("", f"[red]{escape(text)}[/red]")
    console.print(verdict)


def print_sections(found: Joints, console: Console, units: str = "si", *, sheet: bool = False) -> None:
    """Print a table of the sections, that which governs first, and the checks of that one; with their calculation
    sheets on request."""
    joint = found.governing
    if len(found.joints) > 1:
        print_title(found.title, f"statics at {len(found.joints)} sections", console)
        console.print()
        console.print(_sections(found, units))
        console.print()
        console.print("[dim]margin: what is there over what is asked for; 1 just meets it[/dim]")
        console.print()
        where = quantity(joint.elevation_m, ".4g m", units)
        console.print(f"[bold]The section that governs, at {where}[/bold]")
    print_statics(joint.statics, console, units, section_warnings(found.joints, units))
    if sheet:
        for each in found.ranked if len(found.joints) > 1 else (joint,):
            _print_sheets(each, console, units)
    if len(found.joints) > 1:
        missed = [each for each in found.ranked if not each.statics.ok]
        said = f"{len(missed)} of {len(found.joints)} sections miss a check" if missed else "every section meets all"
        console.print(f"\n[{'bold red' if missed else 'bold'}]All sections[/]  {said}")


def _sections(found: Joints, units: str) -> Table:
    """Return the table of the sections."""
    table, (head, rows) = quiet_table(), section_rows(found, units)
    for place, name in enumerate(head):
        text = escape(name.replace("overt", "over-\nt").replace("not met", "not\nmet").replace(", ", ",\n"))
        # The longest word of a load case is not cut where the table is wider than the terminal; nor are numbers.
        table.add_column(
            text,
            justify="left" if place in (1, 2) else "right",
            min_width=12 if place == 1 else None,
            no_wrap=place != 1,
        )
    for row, joint in zip(rows, found.ranked, strict=True):
        table.add_row(*map(escape, row), style="" if joint.statics.ok else "red")
    return table


def _print_sheets(joint: Joint, console: Console, units: str) -> None:
    where = quantity(joint.elevation_m, ".4g m", units)
    for each in joint.statics.cases:
        console.print(f"\n[bold]{escape(each.name)}[/bold], crack at {where}")
        written = lines(each, units)
        table = quiet_table()
        for place, name in enumerate(written.head[:-1]):
            table.add_column(escape(name), justify="right" if place else "left")
        for row in written.rows:
            table.add_row(*map(escape, row[:-1]), style="bold" if row is written.rows[-1] else "")
        console.print(table)
        console.print()
        table = quiet_table()
        for name in ("step", "how", "numbers", "is", "required", ""):
            table.add_column(name, justify="right" if name == "is" else "left")
        for step in steps(each, joint.statics.checks, units):
            met = "" if step.met is None else "met" if step.met else "[bold red]fails[/]"
            table.add_row(*map(escape, (step.name, step.formula, step.worked, step.value, step.limit)), met)
        console.print(table)


def print_statics_table(found: StaticsTable, console: Console, units: str = "si") -> None:
    """Print a table of static checks: a row for each dam, with what governs it."""
    print_title(found.title, f"statics of {len(found.cells)} dams", console)
    console.print()
    table, rows = quiet_table(), found.rows()
    several = any(len(each.joints) > 1 for each in found.found)
    for axis in found.axes:
        table.add_column(escape(axis.path.replace(".", "\n")), no_wrap=True)
    heads = ["checks\nnot met", "governs", "margin", "least\nsliding", "least\noverturn.", "least\nflotation"]
    cracks, unit = numbers([row["longest_crack_m"] or 0.0 for row in rows], "z.2f m", units)
    slips, slip_unit = numbers([row["slip_m"] or 0.0 for row in rows], "z.4f m", units)
    slid = any(row["slip_m"] is not None for row in rows)
    for head in [*heads, f"longest\ncrack, {unit}", *([f"slip,\n{slip_unit}"] if slid else [])]:
        table.add_column(head, justify="left" if head == "governs" else "right")
    for cell, row, crack, slip in zip(found.cells, rows, cracks, slips, strict=True):
        check = row["governing_check"]
        governs = "-" if check is None else f"{row['governing_load_case']}, {check.removesuffix(' factor')}"
        if several:
            governs += f", at {quantity(row['governing_elevation_m'], '.4g m', units)}"
        factors = [row[f"least_{name}_factor"] for name in ("sliding", "overturning", "flotation")]
        said = ["-" if each is None else f"{each:.2f}" for each in (row["governing_margin"], *factors)]
        table.add_row(
            *map(escape, cell),
            str(row["checks_not_met"]),
            escape(governs),
            *said,
            crack,
            *([slip if row["slip_m"] is not None else "-"] if slid else []),
            style="" if row["checks_not_met"] == 0 else "red",
        )
    console.print(table)
    print_warnings(section_warnings([joint for each in found.found for joint in each.joints], units), console)
    met = sum(each.ok for each in found.found)
    said_ = f"{met} of {len(found.found)} dams meet all checks ({found.found[0].joints[0].statics.criteria})"
    console.print(f"\n[bold]Verdict[/bold]  {said_}")


def _assumptions(cases: tuple[LoadCase, ...], units: str) -> list[tuple[str, str]]:
    """Return each assumption once, beside the load cases that share it."""
    shared: dict[str, list[str]] = {}
    for each in cases:
        for text in each.assumptions:
            shared.setdefault(text.text(units), []).append(each.name)
    # The two ways of the earthquake share nearly all.
    return [(names[0] if len(names) == 1 else names[0].split()[0], text) for text, names in shared.items()]


def _beside(cases: tuple[LoadCase, ...], console: Console, units: str) -> list[tuple[LoadCase, ...]]:
    """Divide load cases so that no number has to be cut, evenly, as far as at least one fits."""
    wide = console.options.update(max_width=10_000)
    most = next(
        count
        for count in range(len(cases), 0, -1)
        if count == 1 or Measurement.get(console, wide, _cases(cases[:count], units)).maximum <= console.width
    )
    tables = -(-len(cases) // most)
    each = -(-len(cases) // tables)
    return [cases[start : start + each] for start in range(0, len(cases), each)]


def _cases(cases: tuple[LoadCase, ...], units: str) -> Table:
    table = quiet_table()
    table.add_column("", no_wrap=True)
    for each in cases:
        # Five cases with long names are to fit beside each other.
        table.add_column(each.name.replace(" ", "\n").replace("-", "-\n", 1), justify="right", no_wrap=True)
    for label, form, read in _ROWS:
        # Of a crack that stays closed nothing is to be said.
        if "open" in label and not any(each.cracked_length_m for each in cases):
            continue
        table.add_row(*_row(label, form, [read(each) for each in cases], units))
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
    last = ""
    for check in checks:
        # Long names of load cases stand once, or every row would take two.
        table.add_row(
            "" if check.load_case == last else check.load_case,
            *check_cells(check)[1:],
            "met" if check.met else "[bold red]fails[/]",
            str(numbers.get(check.source, "")),
        )
        last = check.load_case
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
