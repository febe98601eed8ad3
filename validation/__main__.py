"""``python -m validation [NAME...]`` prints the tables of some reference cases, or of all."""

from __future__ import annotations

import sys

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from validation.cases import CASES, run_case, wanted
from validation.row import Row, Skipped


def run_all(names: list[str], console: Console) -> bool:
    """Print the tables of some cases, or of all; return whether no row is farther off than is explained."""
    passed = failed = deviating = informing = skipped = 0
    for title in names or CASES:
        console.print(f"\n[bold]{title}[/bold]  {escape(CASES[title].title)}")
        console.print(f"  [dim]{escape(CASES[title].source)}[/dim]")
        try:
            rows = run_case(title)
        except Skipped as reason:
            console.print(f"  [yellow]skipped[/yellow]: {reason}")
            skipped += 1
            continue
        for row in rows:
            passed += row.holds is True
            failed += row.holds is False
            deviating += row.deviates
            informing += row.tolerance is None
        _print_rows(rows, console)
    console.print(
        f"\n{passed} within what their reference is good for, {deviating} deviate and say why, {failed} outside, "
        f"{informing} for information (not reproducible, reason given), {skipped} cases skipped"
    )
    return failed == 0


def _print_rows(rows: list[Row], console: Console) -> None:
    """Print the rows of a case, each remark once below them."""
    table = Table(show_edge=False, pad_edge=False, header_style="dim", box=None)
    for column in ("", "reference", "of", "heeltoe", "deviation", "verdict"):
        left = column in ("", "of", "verdict")
        table.add_column(column, justify="left" if left else "right", no_wrap=column not in ("", "verdict"))
    remarks = list(dict.fromkeys(row.remark for row in rows if row.remark))
    for row in rows:
        mark = f" [{remarks.index(row.remark) + 1}]" if row.remark else ""
        style = "yellow" if row.deviates else {True: "", False: "bold red", None: "dim"}[row.holds]
        numbers = (row.reference_text, row.kind, row.ours_text, row.deviation_text, row.verdict)
        table.add_row(escape(row.what + mark), *numbers, style=style)
    console.print(table)
    for number, remark in enumerate(remarks, 1):
        console.print(f"  \\[{number}] {remark}")


if __name__ == "__main__":
    sys.exit(not run_all(wanted(sys.argv[1:]), Console()))
