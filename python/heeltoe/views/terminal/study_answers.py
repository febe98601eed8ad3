"""What the terminal shows of a study's answers: measures of strength compared, and what the slip hangs on."""

from __future__ import annotations

from typing import Any

from rich.console import Console
from rich.markup import escape

from heeltoe.study.opened import Opened
from heeltoe.views.terminal.common import quiet_table
from heeltoe.views.words.numbers import Amount, Cell, in_one_unit
from heeltoe.views.words.studies import TRAITS, ends_of, left_out


def print_compared(found: Opened, console: Console, units: str = "si") -> None:
    """Print how well each measure foretells the slip, the best first; nothing of a single motion."""
    if len({each["name"] for each in found.told["motions"]}) < 2:
        return
    for model, told in found.compared().items():
        if not told["measures"]:
            continue
        console.print()
        traits = [name for name in TRAITS if any(each["sufficiency"].get(name) for each in told["measures"])]
        table = quiet_table()
        table.add_column(escape(f"measure, {model}"), no_wrap=True)
        table.add_column("scatter", justify="right")
        for name in traits:
            table.add_column(f"p {TRAITS[name]}", justify="right", no_wrap=True)
        for each in told["measures"]:
            lines = [each["sufficiency"][name] for name in traits]
            cells = ["-" if line is None else f"{line['p']:.2f}" for line in lines]
            table.add_row(each["measure"], f"{each['efficiency']:.2f}", *cells)
        console.print(table)
        text = f"scatter of the logarithm of the slip about a line, over {told['runs']:,} runs; {left_out(told, units)}"
        if traits:
            text += "; p: of what is left over hanging on something else of the events by chance"
        console.print(text, style="dim", highlight=False)


def print_hangs_on(found: Opened, console: Console, units: str) -> None:
    """Print Sobol's indices, or what each field does by itself, where the study is made for them."""
    method = found.told["study"]["method"]
    if method == "sensitivity":
        for model, told in found.sensitivity().items():
            _print_sobol(model, told, console)
    elif method == "one at a time":
        for model, told in found.tornado().items():
            _print_tornado(model, told, console, units)


def _print_sobol(model: str, told: dict[str, Any], console: Console) -> None:
    console.print()
    if told["indices"]:
        table = quiet_table()
        table.add_column(escape(f"slip hangs on, {model}"), no_wrap=True)
        for heading in ("by itself", "with all others"):
            table.add_column(heading, justify="right", no_wrap=True)
        for each in told["indices"]:
            table.add_row(escape(each["name"]), *(_within(each, kind) for kind in ("first", "total")))
        console.print(table)
        note = f"Sobol's indices with their {told['confidence']:.0%} intervals, over {told['rows']:,} rows of dams"
        console.print(note, style="dim", highlight=False)
    else:
        console.print(f"{model}: no indices, as the slip does not vary over {told['rows']:,} rows", highlight=False)
    _print_left_out(told["left_out"], "rows with a run without a slip are behind no index", console)


def _print_tornado(model: str, told: dict[str, Any], console: Console, units: str) -> None:
    console.print()
    table = quiet_table()
    table.add_column(escape(f"slip at, {model}"), no_wrap=True)
    table.add_column("from", justify="right")
    table.add_column("to", justify="right")
    rows: list[list[Cell]] = []
    for each in told["fields"]:
        ends = [(Amount(slip, zero="0"), f" [dim]({escape(value)})[/]") for slip, value in ends_of(each, units)]
        rows.append([escape(each["name"]), *ends])
    # The case as it is, below the table, has its units.
    *rows_said, (_, base) = in_one_unit([*rows, ["", Amount(told["base"], zero="0")]], units)
    for cells in rows_said:
        table.add_row(*cells)
    if told["base"] is not None:
        console.print(table)
        note = f"residual slip, mean over {told['motions']:,} motions at their strengths; {base} as it is"
        console.print(note, style="dim", highlight=False)
    _print_left_out(told["left_out"], "motions in which a dam has no slip are left out", console)


def _print_left_out(count: int, what: str, console: Console) -> None:
    if count:
        console.print(f"[yellow]warning[/yellow]  {count:,} {what}")


def _within(each: dict[str, Any], kind: str) -> str:
    low, high = each[f"{kind}_interval"]
    return f"{each[kind]:.2f} [dim]({low:.2f} to {high:.2f})[/]"
