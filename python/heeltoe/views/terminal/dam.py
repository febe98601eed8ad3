"""What the terminal shows of a dam without an earthquake: its periods, and which pulses overturn it."""

from __future__ import annotations

from itertools import zip_longest
from typing import TYPE_CHECKING

from rich.console import Console

from heeltoe.case.model import Case
from heeltoe.units.sentences import written
from heeltoe.views.terminal.common import label_grid, print_title, quiet_table
from heeltoe.views.terminal.elastic import damping_line, mesh_line

# Not at run time: neither waits for the other's parts.
if TYPE_CHECKING:
    from heeltoe.models.flexible.periods import DamPeriods
    from heeltoe.study.overturning import OverturningMap


def about_dam(case: Case, units: str = "si") -> str:
    """Say how large a dam is, where it is cracked, and how deep its water is."""
    section = case.cut
    sizes = {
        "height": section.crest_elevation - section.base_elevation,
        "crack": section.crack_elevation - section.base_elevation,
        "width": section.crack_width,
    }
    text = "{height:.4g m} high, cracked at {crack:.4g m}, {width:.4g m} wide there"
    if case.reservoir is not None:
        text += "; water {depth:.4g m} deep"
        sizes["depth"] = case.reservoir.depth
    return written(text, units, **sizes)


def print_periods(periods: DamPeriods, console: Console, dam: str = "") -> None:
    """Print the periods of a dam and of its parts, and what is said of the dam itself."""
    print_title(periods.title, "periods", console)
    console.print()
    columns = {
        "intact, dry": periods.intact_dry,
        "intact, with water": periods.intact,
        "above the crack": periods.above,
        "below the crack": periods.below,
    }
    shown = {name: values for name, values in columns.items() if values is not None}
    table = quiet_table()
    table.add_column("")
    for name in shown:
        table.add_column(name, justify="right")
    for number, row in enumerate(zip_longest(*shown.values()), start=1):
        table.add_row(str(number), *("-" if value is None else f"{value:.4f} s" for value in row))
    console.print(table)
    console.print()
    grid = label_grid()
    if dam:
        grid.add_row("dam", dam)
    below = "" if periods.below is None else "; the part below is held at its base"
    grid.add_row("parts", f"each by itself, with its water; the part above is free, rigid-body motion left out{below}")
    grid.add_row("mesh", mesh_line(periods.elements, periods.nodes))
    grid.add_row("damping", damping_line(periods.damping, periods.damping_ratios, periods.rayleigh))
    console.print(grid)


def print_overturning(found: OverturningMap, console: Console, dam: str = "") -> None:
    """Print which pulses overturn a block, and what is said of the dam itself."""
    print_title(found.title, "overturning", console)
    console.print()
    grid = label_grid()
    if dam:
        grid.add_row("dam", dam)
    p, slenderness = found.frequency_parameter_1_s, found.slenderness_rad
    grid.add_row("block", f"slenderness {slenderness:.4g} rad, p = {p:.4g} 1/s")
    low, high = found.frequency_hz[0], found.frequency_hz[-1]
    sizes = f"{found.amplitude_g[0]:.3g} to {found.amplitude_g[-1]:.3g} g"
    grid.add_row("pulses", f"one {found.pulse}, {low:.3g} to {high:.3g} Hz, {sizes}: {found.end.size} runs")
    least = [(size, hertz) for size, hertz in zip(found.least_g(), found.frequency_hz, strict=True) if size is not None]
    if not least:
        grid.add_row("overturning", "by none of them")
    else:
        size, hertz = min(least)
        grid.add_row("overturning", f"from {size:.3g} g on, at {hertz:.3g} Hz")
        gaps = found.safe_gap()
        widest = max(gaps, key=lambda gap: gap[2] - gap[1], default=None)
        text = (
            "none: what overturns it is weaker than all it stands"
            if widest is None
            else f"widest at {widest[0]:.3g} Hz: it stands {widest[1]:.3g} to {widest[2]:.3g} g, though weaker ones "
            "overturn it"
        )
        grid.add_row("safe gap", text)
    console.print(grid)
