"""What the terminal shows of two models side by side (rich)."""

from __future__ import annotations

from collections.abc import Callable

from rich.console import Console
from rich.table import Table

from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.result.contract import HEADLINES, Quantity
from heeltoe.result.response import Response
from heeltoe.result.verdict import verdict
from heeltoe.units.write import length, speed
from heeltoe.views.terminal.common import label_lines, print_warnings, quiet_table
from heeltoe.views.terminal.decoupled import crack_lines
from heeltoe.views.terminal.response import in_the_end, print_head, print_verdicts
from heeltoe.views.terminal.sequence import print_sequence
from heeltoe.views.words.numbers import headline
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
    both = (block, dam)
    table = quiet_table()
    table.add_column("")
    for name in (
        "rigid block" if block.model == "rigid" else "decoupled top",
        "flexible dam",
        f"flexible/{block.model}",
    ):
        table.add_column(name, justify="right")
    for each in HEADLINES:
        table.add_row(*_row(dam, block, each, units))
        if each.signed and any(response.spread is not None for response in both):
            for label, write in (
                ("  with the shaking varied by 1 %", _range),
                ("  standard deviation of that", _deviation),
            ):
                table.add_row(label, *(write(response, units) for response in both), "")
    for name in ("sliding", "slide_rocking", "drifting"):
        slips = [each.summary.get("slip_by_mode_m", {}).get(name) for each in both]
        if any(slips):
            table.add_row(
                f"slip while {name.replace('_', '-')}", *(headline(slip, "slip", units) for slip in slips), ""
            )

    def row(label: str, write: Callable[[Response], str]) -> None:
        table.add_row(label, *(write(each) if each.summary else "-" for each in both), "")

    row("impacts (corners; nodes of the crack)", lambda each: str(each.impacts))
    row("fastest of them", lambda each: speed(each.largest_impact_velocity_m_s, units) if each.impacts else "-")
    row("in the end", in_the_end)
    row("computed in", lambda each: _seconds(each.seconds))
    return table


def _row(dam: Response, block: Response, of: Quantity, units: str) -> list[str]:
    values = [each.summary.get(of.key) for each in (block, dam)]
    ratio = dam.ratio()[of.key]
    cells = [headline(None if value is None else of.way * value, of.kind, units) for value in values]
    return [of.full, *cells, "-" if ratio is None else f"{ratio:.3g}"]


def _seconds(value: float) -> str:
    return f"{value:.2g} s" if value >= 0.1 else f"{1e3 * value:.2g} ms"


def _range(response: Response, units: str) -> str:
    found = None if response.spread is None else response.spread["residual_slip_m"]
    if found is None or not (found["min"] or found["max"]):
        return "-"
    return f"{length(found['min'], units)} to {length(found['max'], units)}"


def _deviation(response: Response, units: str) -> str:
    found = None if response.spread is None else response.spread["residual_slip_m"]
    return "-" if found is None else headline(found["std"], "slip", units)
