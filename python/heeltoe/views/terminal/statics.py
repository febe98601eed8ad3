"""Static checks on the terminal."""

from __future__ import annotations

from rich.console import Console
from rich.markup import escape

from heeltoe.models.statics.joints import Joints
from heeltoe.study.small.statics import StaticsTable
from heeltoe.units.sentences import numbers, quantity
from heeltoe.views.content.checks import answer_of, missed_of, section_table
from heeltoe.views.content.statics import MOST_MISSED, sheet_sections, statics_sections
from heeltoe.views.content.tree import Notes, Paragraph, Strong
from heeltoe.views.terminal.render import render
from heeltoe.views.terminal.screen import Screen, print_title, print_warnings, quiet_table, safe
from heeltoe.views.words.statics import section_warnings


def print_sections(
    joints: Joints, console: Console, units: str = "si", *, sheet: bool = False, details: bool = False
) -> None:
    """Print the verdict, the checks that are not met, every section of several, and warnings.

    In detail also the load cases, all checks and their basis; with the sheets also the calculation, step by step.
    """
    several = len(joints.joints) > 1
    print_title(joints.title, f"statics at {len(joints.joints)} sections" if several else "statics", console)
    render((Paragraph((Strong("Verdict  "), answer_of(joints, units))),), console)
    missed = missed_of(joints, units, MOST_MISSED)
    if missed:
        render((Notes("failure", "Not met", tuple(missed)),), console)
    if several:
        render((section_table(joints, units),), console)
    warnings = section_warnings(joints.joints, units)
    if details:
        print_warnings(warnings, console)
        render(statics_sections(joints, units), console)
    else:
        screen = Screen(console)
        screen.left -= 3 + len(missed)
        screen.add_warnings(warnings, "load cases, all checks, critical water levels and sources")
    if sheet:
        render(sheet_sections(joints, units), console)


def print_statics_table(grid: StaticsTable, console: Console, units: str = "si") -> None:
    """Print a table of static checks: a row for each dam, with the governing check."""
    print_title(grid.title, f"statics of {len(grid.cells)} dams", console)
    console.print()
    table, rows = quiet_table(), grid.rows()
    several = any(len(dam.joints) > 1 for dam in grid.dams)
    for axis in grid.axes:
        table.add_column(escape(axis.path.replace(".", "\n")), no_wrap=True)
    heads = ["checks\nnot met", "governs", "margin", "least\nsliding", "least\noverturn.", "least\nflotation"]
    cracks, unit = numbers([row["longest_crack_m"] or 0.0 for row in rows], "z.2f m", units)
    slips, slip_unit = numbers([row["slip_m"] or 0.0 for row in rows], "z.4f m", units)
    slid = any(row["slip_m"] is not None for row in rows)
    for head in [*heads, f"longest\ncrack, {unit}", *([f"slip,\n{slip_unit}"] if slid else [])]:
        table.add_column(head, justify="left" if head == "governs" else "right")
    for cell, row, crack, slip in zip(grid.cells, rows, cracks, slips, strict=True):
        check = row["governing_check"]
        governs = "-" if check is None else f"{row['governing_load_case']}, {check.removesuffix(' factor')}"
        if several:
            governs += f", at {quantity(row['governing_elevation_m'], '.4g m', units)}"
        factors = [row[f"least_{name}_factor"] for name in ("sliding", "overturning", "flotation")]
        texts = ["-" if factor is None else f"{factor:.2f}" for factor in (row["governing_margin"], *factors)]
        table.add_row(
            *map(safe, cell),
            str(row["checks_not_met"]),
            safe(governs),
            *texts,
            crack,
            *([slip if row["slip_m"] is not None else "-"] if slid else []),
            style="" if row["checks_not_met"] == 0 else "red",
        )
    console.print(table)
    print_warnings(section_warnings([joint for dam in grid.dams for joint in dam.joints], units), console)
    met = sum(dam.ok for dam in grid.dams)
    verdict = f"{met} of {len(grid.dams)} dams meet all checks ({grid.dams[0].joints[0].statics.criteria})"
    console.print(f"\n[bold]Verdict[/bold]  {verdict}")
