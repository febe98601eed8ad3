"""What the terminal shows of two models side by side (rich)."""

from __future__ import annotations

from collections.abc import Callable

from rich.console import Console
from rich.table import Table

from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.result.contract import HEADLINES, Quantity
from heeltoe.result.response import Response
from heeltoe.result.verdict import verdict
from heeltoe.units.write import speed
from heeltoe.views.terminal.common import label_lines, print_warnings, quiet_table
from heeltoe.views.terminal.decoupled import crack_lines
from heeltoe.views.terminal.response import in_the_end, print_head, print_verdicts
from heeltoe.views.terminal.sequence import print_sequence
from heeltoe.views.words.numbers import Amount, Cell, in_one_unit
from heeltoe.views.words.warnings import listed


def print_side_by_side(dam: Response, block: Response, console: Console, units: str = "si") -> None:
    """Print what is printed of one model of both, side by side, the verdict of the better one, and what the difference
    means."""
    print_head(dam, f"{dam.model} model, {block.model} beside it", console, units)
    if isinstance(block, DecoupledResponse) and block.summary:
        console.print(label_lines(crack_lines(block, units)))
        console.print()
    console.print(_table(dam, block, units))
    print_sequence(dam, console, units)
    print_warnings(listed(dam.responses, units), console)
    verdicts = [("Verdict", dam.ok, verdict(dam, units))]
    # What the block does stands in the table; why it does nothing does not.
    if not block.ok:
        verdicts.append((block.model.capitalize(), False, verdict(block, units)))
    print_verdicts([*verdicts, ("Beside it", dam.ok and block.ok, dam.meaning(units))], console)


def _table(dam: Response, block: Response, units: str) -> Table:
    table = quiet_table()
    table.add_column("")
    for name in (
        "rigid block" if block.model == "rigid" else "decoupled top",
        "flexible dam",
        f"flexible/{block.model}",
    ):
        table.add_column(name, justify="right")
    for cells in in_one_unit(_rows(dam, block, units), units):
        table.add_row(*cells)
    return table


def _rows(dam: Response, block: Response, units: str) -> list[tuple[Cell, ...]]:
    both = (block, dam)
    rows: list[tuple[Cell, ...]] = []
    for each in HEADLINES:
        rows.append(_row(dam, block, each))
        if each.signed and any(response.spread is not None for response in both):
            for label, write in (
                ("  with the shaking varied by 1 %", _range),
                ("  standard deviation of that", _deviation),
            ):
                rows.append((label, *(write(response) for response in both), ""))
    for name in ("sliding", "slide_rocking", "drifting"):
        slips = [each.summary.get("slip_by_mode_m", {}).get(name) for each in both]
        if any(slips):
            rows.append((f"slip while {name.replace('_', '-')}", *map(Amount, slips), ""))

    def row(label: str, write: Callable[[Response], str]) -> None:
        rows.append((label, *(write(each) if each.summary else "-" for each in both), ""))

    row("impacts (corners; nodes of the crack)", lambda each: str(each.impacts))
    row("fastest of them", lambda each: speed(each.largest_impact_velocity_m_s, units) if each.impacts else "-")
    row("in the end", in_the_end)
    row("computed in", lambda each: _seconds(each.seconds))
    return rows


def _row(dam: Response, block: Response, of: Quantity) -> tuple[Cell, ...]:
    values = [each.summary.get(of.key) for each in (block, dam)]
    ratio = dam.ratio()[of.key]
    cells = [Amount(None if value is None else of.way * value, of.kind) for value in values]
    return (of.full, *cells, "-" if ratio is None else f"{ratio:.3g}")


def _seconds(value: float) -> str:
    return f"{value:.2g} s" if value >= 0.1 else f"{1e3 * value:.2g} ms"


def _range(response: Response) -> Cell:
    found = None if response.spread is None else response.spread["residual_slip_m"]
    if found is None or not (found["min"] or found["max"]):
        return "-"
    return Amount(found["min"], zero="0"), " to ", Amount(found["max"], zero="0")


def _deviation(response: Response) -> Cell:
    found = None if response.spread is None else response.spread["residual_slip_m"]
    return "-" if found is None else Amount(found["std"])
