"""What the terminal shows of a response (rich)."""

from __future__ import annotations

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.plain import plain
from heeltoe.result.response import Response
from heeltoe.result.rest import comes_to_rest
from heeltoe.result.verdict import verdict
from heeltoe.units.sentences import written
from heeltoe.units.write import lengths
from heeltoe.views.terminal.common import (
    label_grid,
    label_lines,
    print_title,
    print_warnings,
    quiet_table,
)
from heeltoe.views.terminal.decoupled import crack_lines
from heeltoe.views.terminal.elastic import elastic_lines
from heeltoe.views.terminal.sequence import print_sequence
from heeltoe.views.words import cracks
from heeltoe.views.words.law import law_lines
from heeltoe.views.words.motion import sampling
from heeltoe.views.words.numbers import Amount, in_one_unit
from heeltoe.views.words.sequence import part_lines
from heeltoe.views.words.spread import COLUMNS, spread_rows, spread_said
from heeltoe.views.words.starts import of_what, starts
from heeltoe.views.words.tension import tension_line, tension_worth
from heeltoe.views.words.warnings import listed


def print_summary(response: Response, console: Console, units: str = "si") -> None:
    """Print motion, static state, what the numbers rest on, result, warnings and verdict."""
    print_head(response, f"{response.model} model", console, units)
    if response.summary:
        console.print(_result_table(response, units))
        if "cracks" in response.summary:
            console.print()
            console.print(_cracks_table(response, units))
        console.print()
        console.print(label_lines(_result_lines(response, units)))
        if response.spread is not None:
            console.print()
            console.print(_spread_table(response, units))
        print_sequence(response, console, units)
    print_warnings(listed([response], units), console)
    print_verdicts([("Verdict", response.ok, verdict(response, units))], console)


def print_head(response: Response, model: str, console: Console, units: str) -> None:
    """Print title, motion and static state and, of the flexible model, all that its result rests on."""
    print_title(response.title, model, console)
    console.print()
    grid = label_grid()
    for label, motion in (("motion", response.motion), ("vertical motion", response.vertical)):
        if motion is not None:
            grid.add_row(label, escape(_motion_line(motion, response.gravity, units)))
    for label, text in [*_static_lines(response), *law_lines(response, units), *_basis_lines(response, units)]:
        grid.add_row(label, text)
    console.print(grid)
    console.print()


def print_verdicts(rows: list[tuple[str, bool, str]], console: Console) -> None:
    """Print labelled sentences; a label is red where there is no result to trust."""
    grid = Table.grid(padding=(0, 2))
    grid.add_column(no_wrap=True)
    grid.add_column()
    for label, good, text in rows:
        grid.add_row(f"[{'bold' if good else 'bold red'}]{label}[/]", escape(text))
    console.print()
    console.print(grid)


def in_the_end(response: Response) -> str:
    """Say whether the dam is at rest when the run ends."""
    return "at rest" if comes_to_rest(response) else "still moving"


def _motion_line(motion: GroundMotion, gravity: float, units: str) -> str:
    line = written(
        "{name}: PGA {pga_g:.4g g}, PGV {pgv_m_s:.3g m/s}, PGD {pgd_m:.3g m}, {duration_s:.4g s} {sampling}",
        units,
        name=motion.name,
        pga_g=motion.pga / gravity,
        pgv_m_s=motion.pgv,
        pgd_m=motion.pgd,
        duration_s=motion.duration,
        sampling=sampling(motion),
    )
    return "\n".join([line, *map(plain, motion.processing), *part_lines(motion, gravity)])


def _static_lines(response: Response) -> list[tuple[str, str]]:
    static = response.static
    factor = static["sliding_safety_factor"]
    text = "no horizontal force" if factor is None else f"{factor:.3f} under static loads"
    lines = [("sliding safety factor", text)]
    found = starts(response)
    for kind in ("sliding", "rocking"):
        both = [found[kind, way] for way in ("downstream", "upstream")]
        lines.append((f"{kind} starts at", ", ".join(f"{each} {each.way}" for each in both) + of_what(response)))
        if both[0].varied:
            ranges = ", ".join(f"{each.varied} {each.way}" for each in both)
            lines.append(("  with vertical motion", ranges))
    return lines


def _basis_lines(response: Response, units: str) -> list[tuple[str, str]]:
    """Return what the result of a model beyond the rigid block rests on."""
    if isinstance(response, FlexibleResponse):
        return elastic_lines(response, units)
    if isinstance(response, DecoupledResponse) and response.summary:
        return crack_lines(response, units)
    return []


def _result_table(response: Response, units: str) -> Table:
    table = quiet_table()
    table.add_column("")
    table.add_column("downstream", justify="right")
    table.add_column("upstream", justify="right")

    slip = response.residual_slip_m
    openings = (response.opening_upstream_m, response.opening_downstream_m)
    down, up = reversed(openings) if response.elastic else openings
    opening = "largest opening, this face" if response.elastic else "opening it means, other face"
    rows: tuple[tuple[str, str, float, float], ...] = (
        ("residual slip", "slip", max(0.0, slip), max(0.0, -slip)),
        ("peak slip", "slip", response.peak_slip_downstream_m, -response.peak_slip_upstream_m),
        ("largest rotation", "rotation", response.rocking_downstream_rad, response.rocking_upstream_rad),
        (opening, "opening", down, up),
    )
    cells = [(label, Amount(one, kind), Amount(other, kind)) for label, kind, one, other in rows]
    for row in in_one_unit(cells, units):
        table.add_row(*row)
    return table


def _cracks_table(response: Response, units: str) -> Table:
    """Return what each of several cracks did, from the crest down."""
    table = quiet_table()
    first, *others = cracks.COLUMNS
    table.add_column(first)
    for name in others:
        table.add_column(name, justify="right")
    for row in cracks.crack_rows(response, units):
        table.add_row(*row)
    return table


def _result_lines(response: Response, units: str) -> list[tuple[str, str]]:
    by_mode = _slip_by_mode(response, units)
    lines = [("slip by mode", by_mode)] if by_mode else []
    times = [
        f"{name.replace('_', '-')} {value:.2f} s" for name, value in response.time_by_mode_s.items() if value >= 5e-3
    ]
    lines.append(("time by mode", ", ".join(times)))
    lines += _chosen_lines(response, units)
    if isinstance(response, FlexibleResponse) and response.tension is not None:
        lines.append(("largest tension", tension_line(response.tension, units)))
        lines.append(("", tension_worth(response.tension, units)))
    if response.elastic:
        return [*lines, ("node strikes", _strikes(response, units)), ("in the end", in_the_end(response))]
    closes = f"the energy ledger closes to {response.energy.residual if response.energy else 0.0:.0e}"
    return [*lines, ("events", f"{response.events}, {response.impacts} of them impacts; {closes}")]


def _chosen_lines(response: Response, units: str) -> list[tuple[str, str]]:
    """Return what was chosen beyond the usual, where it plays a part."""
    s = response.summary
    lines = []
    if s.get("rotation", "small") != "small":
        lines.append(("rotation", "of any size" if s["rotation"] == "finite" else "small, with P-Delta"))
    if s.get("uplift_during_shaking", "constant") != "constant":
        lines.append(("uplift", f"{s['uplift_during_shaking']} in the earthquake"))
    for number, anchor in enumerate(s.get("anchors", ()), 1):
        text = "largest tension {peak_tension_n:.3g MN/m}"
        if anchor["capacity_n"] is not None:
            text += " of {capacity_n:.3g MN/m} it is good for"
        lines.append((f"anchor {number}", written(text, units, **anchor)))
    return lines


def _slip_by_mode(response: Response, units: str) -> str:
    parts = {name.replace("_", "-"): value for name, value in response.slip_by_mode_m.items() if abs(value) >= 5e-6}
    texts = lengths(list(parts.values()), units)
    return ", ".join(f"{name} {text}" for name, text in zip(parts, texts, strict=True))


def _strikes(response: Response, units: str) -> str:
    if not response.impacts:
        return "none"
    fastest = response.largest_impact_velocity_m_s
    return written("{impacts:d}, at up to {fastest_m_s:.2g m/s}", units, impacts=response.impacts, fastest_m_s=fastest)


def _spread_table(response: Response, units: str) -> Table:
    """Value and spread, side by side, of all that is not next to nothing."""
    table = quiet_table()
    table.add_column("")
    for name in COLUMNS:
        table.add_column(name, justify="right")
    for row in spread_rows(response, units):
        table.add_row(*row)
    table.caption = spread_said(response, units)
    table.caption_justify = "left"
    return table
