"""A response on the terminal: verdict, all models and cracks in one table, and the warnings that matter."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from heeltoe.case.model import Case
from heeltoe.result.contract import LENGTHS
from heeltoe.result.numbers import BondState, FrictionBand
from heeltoe.result.response import Response
from heeltoe.result.verdict import effect_sentence, trial_text, verdict
from heeltoe.units.sentences import written
from heeltoe.units.write import NOTHING, length
from heeltoe.views.terminal.screen import Screen, print_title, quiet_table, safe
from heeltoe.views.words.motion import sampling
from heeltoe.views.words.numbers import Amount, Cell, Numbers, in_one_unit
from heeltoe.views.words.response import NAMES, listed

_MORE = "the ground motion, static loads, modes of motion, energy and convergence"
# So many cracks have a row of their own.
_ROWS = 6
_GRAVITIES = ("grave", "caution", "note")


def print_response(response: Response, console: Console, units: str = "si", details: Case | None = None) -> None:
    """Print a response, short; with the case that it is of, everything that its report says in words and numbers."""
    beside = "" if response.beside is None else f", {response.beside.model} beside it"
    print_title(response.title, f"{response.model} model{beside}", console)
    if details is not None:
        # Here, as the sections of a report take longer to load than a rigid run takes.
        from heeltoe.views.content.document import run_sections
        from heeltoe.views.content.subject import Subject
        from heeltoe.views.terminal.render import render

        numbers = Numbers(response.to_json(), units)
        render(run_sections(Subject(details, response, numbers, figures={})), console)
        times = ", ".join(f"{run.model} {_seconds(run.seconds)}" for run in response.responses)
        console.print(f"\ncomputed in: {times}", style="dim")
        return
    screen = Screen(console)
    screen.add(Text(_motion_line(response, units), style="dim", no_wrap=True, overflow="ellipsis"))
    screen.add(_verdicts(response, units))
    if any(run.started for run in response.responses):
        table = _table(response, units)
        # A line between is for a screen that has one left for a warning.
        if screen.left - screen.lines(table) > 1:
            screen.add(Text(""))
        screen.add(table)
    if response.friction_band is not None:
        screen.add(_band(response.friction_band, units))
    if response.friction_effect is not None:
        screen.add(Text(effect_sentence(response.friction_effect, units)))
    screen.add_warnings(_warnings(response, units), _MORE)


def _motion_line(response: Response, units: str) -> str:
    motion = response.motion
    line = written(
        "{name}: PGA {pga_g:.4g g}, {duration_s:.4g s} {sampling}",
        units,
        name=motion.name,
        pga_g=motion.pga / response.gravity,
        duration_s=motion.duration,
        sampling=sampling(motion),
    )
    if response.vertical is not None:
        line += f"; vertical {response.vertical.pga / response.gravity:.4g} g"
    if response.cross is not None:
        line += f"; across the valley {response.cross.pga / response.gravity:.4g} g"
    return line


def _verdicts(response: Response, units: str) -> Table:
    """Return the verdict, and what the model beside it adds; a label is red where there is no result to trust."""
    rows = [("Verdict", response.ok, verdict(response, units, brief=True))]
    block = response.beside
    if block is not None and not block.ok:
        rows.append((block.model.capitalize(), False, verdict(block, units, brief=True)))
    elif block is not None:
        rows.append(("Beside it", response.ok, response.meaning(units, brief=True)))
    grid = Table.grid(padding=(0, 2))
    grid.add_column(no_wrap=True)
    grid.add_column()
    for label, good, text in rows:
        grid.add_row(f"[{'bold' if good else 'bold red'}]{label}[/]", safe(text))
    return grid


def _band(band: FrictionBand, units: str) -> Table:
    """Return a line for each friction that the crack may have."""
    grid = Table.grid(padding=(0, 2))
    grid.add_column(no_wrap=True)
    grid.add_column()
    for trial in band.trials:
        judged = " (judged by the limits)" if trial.judged and len(band.trials) > 1 else ""
        grid.add_row(trial.name.replace("_", " "), f"{trial.friction.text(units)}: {trial_text(trial, units)}{judged}")
    return grid


def _table(response: Response, units: str) -> Table:
    """Return a row for each crack of each model, from the crest down."""
    cells: list[list[Cell]] = []
    bonded = any(_bond(crack) is not None for run in response.responses if run.started for crack in run.cracks)
    for run in response.responses:
        if not run.started:
            continue
        shown = _shown(run.cracks)
        for crack in shown:
            where = f"at {written('{at_m:g m}', units, at_m=crack.elevation)}" if run.several else ""
            amounts = [Amount(item.way * item.of(crack), item.kind) for item in LENGTHS]
            bond = _bond(crack)
            cracked = [NOTHING if bond is None else length(bond.cracked_length_m, units)] if bonded else []
            cells.append([f"{NAMES.get(run.model, run.model)} {where}".strip(), *amounts, *cracked])
        others = [crack for crack in run.cracks if not any(crack is one for one in shown)]
        if others:
            largest = [Amount(max(item.way * item.of(crack) for crack in others), item.kind) for item in LENGTHS]
            lengths = [bond.cracked_length_m for crack in others if (bond := _bond(crack)) is not None]
            cracked = [length(max(lengths), units) if lengths else NOTHING] if bonded else []
            cells.append([f"{len(others)} others, at most", *largest, *cracked])
    # A line of 80 characters holds the names of all columns beside that of a model.
    table = quiet_table(close=True)
    table.add_column("", no_wrap=True)
    for item in LENGTHS:
        table.add_column(item.heading.removesuffix(" slip") if bonded else item.heading, justify="right")
    if bonded:
        table.add_column("cracked", justify="right")
    for row in in_one_unit(cells, units):
        # Too small to measure is nothing in a narrow column.
        table.add_row(*("-" if text.startswith("under ") else text for text in row))
    return table


def _shown(cracks: Sequence[Any]) -> Sequence[Any]:
    """Return the cracks that have a row: of many those that slip and open most."""
    if len(cracks) <= _ROWS:
        return cracks

    def moved(crack: Any) -> tuple[float, float]:
        bond = _bond(crack)
        return max(abs(item.of(crack)) for item in LENGTHS), bond.cracked_length_m if bond else 0.0

    least = sorted(map(moved, cracks))[-_ROWS]
    return [crack for crack in cracks if moved(crack) >= least][:_ROWS]


def _bond(crack: Any) -> BondState | None:
    """Return the state of the bond of a crack at the end; None without a bond."""
    bond: BondState | None = getattr(crack, "joint", None)
    return bond


def _warnings(response: Response, units: str) -> list[str]:
    """Return the warnings, the grave ones first."""
    texts = listed(response.responses, units)
    return sorted(texts, key=lambda text: _GRAVITIES.index(texts[text]))


def _seconds(value: float) -> str:
    return f"{value:.2g} s" if value >= 0.1 else f"{1e3 * value:.2g} ms"
