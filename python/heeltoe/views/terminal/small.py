"""A table of runs, and a solved field, on the terminal (rich)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from heeltoe.errors.sanitize import plain
from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.result.contract import CRACKED, HEADLINES, RESIDUAL_SLIP
from heeltoe.result.numbers import SlipByMode
from heeltoe.result.outcome import Outcome
from heeltoe.result.response import Response
from heeltoe.result.rest import comes_to_rest
from heeltoe.result.verdict import advice
from heeltoe.study.plan.crack_columns import column_of
from heeltoe.study.small.run_table import BESIDE, SmallStudy
from heeltoe.study.small.solved import Solved
from heeltoe.units.systems import INCH
from heeltoe.views.content.solve import solve_answer, solve_table
from heeltoe.views.terminal.render import render
from heeltoe.views.terminal.screen import fits, in_parts, print_more, print_title, quiet_table, safe


def _length(metres: float, units: str) -> str:
    """Write a length in mm, or in inches."""
    if units == "us":
        inches = metres / INCH
        return f"{inches:.{1 if abs(inches) >= 1e2 else 2 if abs(inches) >= 1.0 else 3}f}"
    size = abs(1e3 * metres)
    return f"{1e3 * metres:.{0 if size >= 1e3 else 1 if size >= 1.0 else 2}f}"


def _long(metres: float, units: str) -> str:
    """Write a length in m, or in feet."""
    return f"{metres / (12.0 * INCH) if units == 'us' else metres:.3g}"


def _mrad(value: float, units: str) -> str:
    return f"{1e3 * value:.3g}" if value >= 1e-5 else f"{1e3 * value:.2f}"


def _count(value: int, units: str) -> str:
    return str(value)


# Heading, name in the rows, sign, how to write it.
_Column = tuple[str, str, float, Callable[[Any, str], str]]
_HEADLINES = tuple(
    (headline.short, headline.key, float(headline.way), _mrad if headline.kind == "rotation" else _length)
    for headline in HEADLINES
)
_SLIPS = sum(headline.kind == "slip" for headline in HEADLINES)
_SLIP: tuple[_Column, ...] = (
    *_HEADLINES[:_SLIPS],
    *((mode.replace("_", "-\n"), f"slip_{mode}_m", 1.0, _length) for mode in SlipByMode.names()),
)
_ROCKING: tuple[_Column, ...] = (*_HEADLINES[_SLIPS:], ("impacts", "impacts", 1.0, _count))
# What stands under --details alone: slips by mode, rotations, impacts.
_IN_DETAIL = _SLIP[_SLIPS:]
_ROTATIONS = sum(headline.kind == "rotation" for headline in HEADLINES)
# Whether the limits are kept, as the rows have it.
_KEPT = {True: "yes", False: "[red]NO[/]", None: "-"}
_UNITS = {"si": "mm", "us": "inches"}


def print_small(grid: SmallStudy, console: Console, units: str = "si", *, details: bool = False) -> None:
    """Print the table: lengths in mm or inches, rotations in mrad, slip positive downstream; in detail every column."""
    first = grid.responses[0]
    peak = first.motion.pga / first.gravity
    print_title(grid.title, f"{grid.model} model", console)
    runs = f"{plain(first.motion.name)}, peak {peak:.3g} g; {len(grid.cells)} runs"
    console.print(escape(runs), style="dim", soft_wrap=True)
    _print_crack_level(grid, console)
    # One table where there is room for it, else one of the slips and one of the rocking, in parts if need be.
    slip = _SLIP
    blocks = {response.beside.model for response in grid.responses if response.beside is not None}
    if len(blocks) == 1:
        # What the simpler model says stands beside what the better one does.
        beside = (f"residual,\n{blocks.pop()}", BESIDE, 1.0, _length)
        slip = (_SLIP[0], beside, *_SLIP[1:])
    several = [_of_crack(place) for place in range(grid.cracks)]
    slip = (slip[0], *several, *slip[1:])
    if grid.bonded:
        slip = (*slip, (f"cracked\n({'ft' if units == 'us' else 'm'})", CRACKED, 1.0, _long))
    if not details:
        slip = tuple(column for column in slip if column not in _IN_DETAIL)
    rocking = _ROCKING if details else _ROCKING[_ROTATIONS:-1]
    whole = slip + rocking

    def fit(columns: Sequence[_Column]) -> bool:
        return fits(_table(grid, columns, units), console)

    groups: list[Sequence[_Column]] = [whole] if fit(whole) else [*in_parts(slip, fit), *in_parts(rocking, fit)]
    for columns in groups:
        console.print()
        console.print(_table(grid, columns, units))
    footer = f"slips and openings in {_UNITS[units]}, slip positive downstream; rotations in mrad"
    console.print(footer, style="dim")
    if several:
        console.print("cracks count from the crest down; the other columns are of the one that slips most", style="dim")
    if not details:
        print_more(console, "slip by mode, impacts and all warnings")
    for text in _remarks(grid, units, details=details):
        console.print(f"[yellow]warning[/yellow]  {safe(text)}")
    for text in _judged(grid):
        console.print(f"\n[bold]Verdict[/bold]  {text}")


def print_solved(solved: Solved, console: Console, units: str = "si", *, details: bool = False) -> None:
    """Print where the limit is just met; in detail the runs, too."""
    print_title(solved.title or "Untitled case", f"{solved.model} model", console)
    render(solve_answer(solved, units), console)
    if details:
        render((solve_table(solved, units),), console)


def _of_crack(place: int) -> _Column:
    return f"crack {place + 1},\nresidual", column_of(place, RESIDUAL_SLIP.key), 1.0, _length


def _judged(grid: SmallStudy) -> list[str]:
    """Say how many runs meet the limits, and how many have no result."""
    sentences = []
    judged = [response for response in grid.responses if response.limits]
    if judged:
        kept = sum(all(check.met for check in response.limits) for response in judged)
        as_what = "" if judged[0].elastic else ", each as a rigid block"
        sentences.append(f"{kept} of {len(grid.responses)} runs meet the limits{as_what}.")
    failed = sum(not response.ok for response in grid.responses)
    if failed:
        sentences.append(f"{failed} of {len(grid.responses)} runs have no result to trust.")
    return [" ".join(sentences)] if sentences else []


def _remarks(grid: SmallStudy, units: str, *, details: bool) -> list[str]:
    """Return all warnings once, with the runs they are of; in detail those of other numbers, too."""
    remarks: dict[str | tuple[str, int], list[tuple[str, str]]] = {}
    for cell, response in zip(grid.cells, grid.responses, strict=True):
        failed = [] if response.ok else [f"{response.outcome}: {advice(response, units)}"]
        own = [(text, text) for text in failed]
        own += [(warning.code, warning.text(units)) for warning in response.warnings]
        codes = Counter[str]()
        for code, text in dict.fromkeys(own):
            codes[code] += 1
            remarks.setdefault(text if details else (code, codes[code]), []).append((", ".join(cell), text))
    sentences = []
    for known in remarks.values():
        (run, text), count = known[0], len(known)
        if len({text for _, text in known}) > 1:
            sentences.append(f"{run} and {count - 1} more, with other numbers: {text}")
        elif count == len(grid.cells):
            sentences.append(text)
        else:
            sentences.append(f"{'; '.join(run for run, _ in known)}: {text}")
    return sentences


def _table(grid: SmallStudy, columns: Sequence[_Column], units: str) -> Table:
    table = quiet_table(close=True)
    for axis in grid.axes:
        table.add_column(escape(axis.path.replace(".", "\n")), no_wrap=True)
    for heading, *_ in columns:
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("in the\nend", no_wrap=True)
    judged = any(response.limits for response in grid.responses)
    if judged:
        table.add_column("limits\nkept", no_wrap=True)
    for cell, row, response in zip(grid.cells, grid.rows(), grid.responses, strict=True):
        kept = [_KEPT[row["limits_met"]]] if judged else []
        table.add_row(*map(safe, cell), *(_written(row, column, units) for column in columns), _end(response), *kept)
    return table


def _written(row: Mapping[str, Any], column: _Column, units: str) -> str:
    _, name, sign, write = column
    value = row[name]
    if value is None:
        return "-"
    # A zero is no amount, of either sign.
    return write(-value if sign < 0.0 else value, units) if value else "0"


def _end(response: Response) -> str:
    if response.outcome != Outcome.OK:
        return response.outcome
    return "at rest" if comes_to_rest(response) else "moving"


def _print_crack_level(grid: SmallStudy, console: Console) -> None:
    """Say how much stronger the crack is shaken than the ground, over all runs."""
    levels = [
        response.crack_level
        for response in grid.responses
        if isinstance(response, DecoupledResponse) and response.summary
    ]
    factors = sorted(level.amplification for level in levels if level.amplification is not None)
    if not factors:
        return
    peaks = sorted(level.peak_horizontal_g for level in levels)

    def span(values: list[float], unit: str = "") -> str:
        low, high = f"{values[0]:.3g}", f"{values[-1]:.3g}"
        return f"{low}{unit}" if low == high else f"{low} to {high}{unit}"

    periods = span(sorted(level.periods_s[0] for level in levels if level.periods_s) or [0.0], " s")
    text = f"crack level: peak {span(peaks, ' g')}, {span(factors)} times the ground's; first period below {periods}"
    console.print(text, style="dim", soft_wrap=True)
