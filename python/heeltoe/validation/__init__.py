"""The reference cases as small programs: reference, ours, deviation, verdict.

A case is a function that yields rows. It runs through the same calls a user makes wherever the case file can express
it. ``heeltoe validate`` prints the tables; the tests assert them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from heeltoe.errors import InputError
from heeltoe.validation import (
    closed_forms,
    elastic_bar,
    flexible_blocks,
    flexible_dams,
    penalty,
    random_dams,
    thesis_blocks,
    thesis_dams,
    turning,
)
from heeltoe.validation.row import Row, Skipped

__all__ = ["CASES", "Row", "Skipped", "run_all", "run_case"]

CASES: dict[str, Callable[[], Iterable[Row]]] = {
    "impulse": thesis_blocks.impulse,
    "sine": thesis_blocks.sine,
    "push-and-sine": closed_forms.push_and_sine,
    "pulse": closed_forms.pulse,
    "free-rocking": closed_forms.free_rocking,
    "finite-rocking": turning.free_finite_rocking,
    "overturning": turning.overturning_pulses,
    "drifting": thesis_blocks.drifting,
    "dry-block": thesis_blocks.dry_block,
    "triangular": thesis_dams.triangular,
    "table-7.6-taft": thesis_dams.taft,
    "table-7.6-el-centro": thesis_dams.el_centro,
    "bouncing-bar": elastic_bar.bouncing_bar,
    "elastic-impulse": flexible_blocks.elastic_impulse,
    "elastic-sliding": flexible_blocks.elastic_sliding,
    "elastic-rocking": flexible_blocks.elastic_rocking,
    "contactors": flexible_blocks.contactors,
    "random-dams": random_dams.random_dams,
    "periods": flexible_dams.periods,
    "table-7.1": flexible_dams.table_7_1,
    "table-7.7": flexible_dams.table_7_7,
    "table-7.8": flexible_dams.table_7_8,
    "table-7.10": flexible_dams.table_7_10,
    "halving": flexible_dams.halving,
    "penalty": penalty.penalty,
}


def run_case(name: str) -> list[Row]:
    """Return the rows of one case.

    Raises
    ------
    InputError
        Where there is no case of that name.
    Skipped
        Where a record it needs is not there.
    """
    if name not in CASES:
        raise InputError("no-such-validation", "NAME", name, names=", ".join(CASES))
    return list(CASES[name]())


def run_all(name: str | None, console: Console) -> bool:
    """Print the table of one case or of all; return whether every row that can be judged is within its tolerance."""
    if name is not None and name not in CASES:
        run_case(name)
    passed = failed = explained = skipped = 0
    for each in [name] if name else CASES:
        case = CASES[each]
        heading = (case.__doc__ or "").strip().splitlines()[0]
        console.print(f"\n[bold]{each}[/bold]  {heading}")
        try:
            rows = run_case(each)
        except Skipped as reason:
            console.print(f"  [yellow]skipped[/yellow]: {reason}")
            skipped += 1
            continue
        table = Table(show_edge=False, pad_edge=False, header_style="dim", box=None)
        for column in ("", "reference", "heeltoe", "deviation", "verdict"):
            table.add_column(column, justify="left" if column in ("", "verdict") else "right", no_wrap=column != "")
        remarks = list(dict.fromkeys(row.remark for row in rows if row.remark))
        for row in rows:
            mark = f" [{remarks.index(row.remark) + 1}]" if row.remark else ""
            style = {True: "", False: "bold red", None: "dim"}[row.holds]
            what = escape(row.what + mark)
            table.add_row(what, row.reference_text, row.ours_text, row.deviation_text, row.verdict, style=style)
            passed += row.holds is True
            failed += row.holds is False
            explained += row.holds is None
        console.print(table)
        for number, remark in enumerate(remarks, 1):
            console.print(f"  \\[{number}] {remark}")
    console.print(
        f"\n{passed} within tolerance, {failed} outside, {explained} for information (not reproducible, reason given), "
        f"{skipped} cases skipped"
    )
    return failed == 0
