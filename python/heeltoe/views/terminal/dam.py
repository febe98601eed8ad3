"""A dam without an earthquake on the terminal: its periods, and the pulses that overturn it."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import zip_longest
from typing import TYPE_CHECKING

from rich.console import Console

from heeltoe.case.model import Case
from heeltoe.case.warnings import drawing_notice
from heeltoe.units.sentences import written
from heeltoe.views.content.tree import Table
from heeltoe.views.terminal.render import print_table
from heeltoe.views.terminal.screen import label_grid, print_more, print_title, safe

# Not at run time: neither waits for the other's parts.
if TYPE_CHECKING:
    from heeltoe.models.flexible.body.periods import DamPeriods
    from heeltoe.models.flexible.surroundings.amplification import Amplification
    from heeltoe.study.small.overturning import OverturningMap


# What the names of the choices mean.
_DAMPING = {
    "relative": "of the motion relative to a rigid slide along the crack",
    "stiffness": "of deformation, by its rate alone",
    "modal": "one ratio for the modes of the intact dam",
    "deformation": "of deformation of the free parts",
    "thesis": (
        "of all motion while any node of the crack sticks, of the part below alone while none does, as in Zhu (2004)"
    ),
}


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


def print_drawing(case: Case, console: Console, units: str = "si") -> None:
    """Print which outline of a drawing is the dam, if it is drawn."""
    for notice in drawing_notice(case):
        console.print(safe(notice.text(units)), style="dim")


def print_periods(
    periods: DamPeriods, console: Console, dam: str = "", *, details: bool = False, units: str = "si"
) -> None:
    """Print the periods of a dam and of its parts; in detail with the input."""
    names = periods.part_names(units)
    print_title(periods.title, "periods", console)
    console.print()
    columns = {
        "intact, dry": periods.intact_dry,
        "intact, with water": periods.intact,
        **dict(zip(names, periods.parts.values(), strict=True)),
    }
    rows = tuple(
        (str(number), *("-" if value is None else f"{value:.4f} s" for value in row))
        for number, row in enumerate(zip_longest(*columns.values()), start=1)
    )
    print_table(Table(("", *columns), rows, align="l" + "r" * len(columns)), console)
    for sentence in periods.simplified:
        console.print(sentence)
    if periods.amplification is not None:
        _print_amplification(periods.amplification, console, units)
    if not details:
        print_more(console, "parts, mesh and damping")
        return
    console.print()
    grid = label_grid()
    if dam:
        grid.add_row("dam", dam)
    below = "; the lowest part is fixed at its base" if periods.grounded else ""
    free = "the parts above a crack are" if len(periods.parts) > 2 else "the part above is"
    grid.add_row("parts", f"separate, with their water; {free} free, without rigid-body modes{below}")
    grid.add_row("mesh", _mesh_line(names, periods.elements, periods.nodes))
    grid.add_row("damping", _damping_line(periods.damping, periods.damping_ratios, periods.rayleigh))
    console.print(grid)


def _print_amplification(amplification: Amplification, console: Console, units: str) -> None:
    """Print the first resonance of the crest on each rock and with each water."""
    from heeltoe.views.words.amplification import COLUMNS, peak_rows

    console.print()
    print_table(Table(COLUMNS, tuple(peak_rows(amplification)), align="llrrr"), console)
    for sentence in amplification.sentences(units):
        console.print(sentence, markup=False)


def _mesh_line(names: Sequence[str], elements: Sequence[int], nodes: Sequence[int]) -> str:
    """Say how large the meshes of the parts are."""
    parts = [f"{e} elements, {n} nodes" for e, n in zip(elements, nodes, strict=True)]
    return parts[0] if len(parts) == 1 else "; ".join(f"{part} {name}" for name, part in zip(names, parts, strict=True))


def _damping_line(choice: str, ratios: Sequence[float], rayleigh: tuple[float | None, float | None] | None) -> str:
    """Say how the concrete is damped, and what the lowest modes of the intact dam get of it."""
    got = " ".join(f"{100.0 * ratio:.3g}" for ratio in ratios)
    text = f"{choice}, {_DAMPING[choice]}; {got} % in modes 1 to {len(ratios)} of the intact dam"
    if rayleigh is not None and rayleigh[0] is not None:
        text += f" (Rayleigh: {rayleigh[0]:.3g} 1/s of mass, {rayleigh[1]:.3g} s of stiffness)"
    return text


def print_overturning(overturning: OverturningMap, console: Console, dam: str = "") -> None:
    """Print which pulses overturn a block, and the text on the dam itself."""
    print_title(overturning.title, "overturning", console)
    console.print()
    grid = label_grid()
    if dam:
        grid.add_row("dam", dam)
    p, slenderness = overturning.frequency_parameter_1_s, overturning.slenderness_rad
    grid.add_row("block", f"slenderness {slenderness:.4g} rad, frequency parameter {p:.4g} rad/s")
    low, high = overturning.frequency_hz[0], overturning.frequency_hz[-1]
    sizes = f"{overturning.amplitude_g[0]:.3g} to {overturning.amplitude_g[-1]:.3g} g"
    grid.add_row("pulses", f"one {overturning.pulse}, {low:.3g} to {high:.3g} Hz, {sizes}: {overturning.end.size} runs")
    least = [
        (size, hertz)
        for size, hertz in zip(overturning.least_g, overturning.frequency_hz, strict=True)
        if size is not None
    ]
    if not least:
        grid.add_row("overturning", "by none of them")
    else:
        size, hertz = min(least)
        grid.add_row("overturning", f"from {size:.3g} g on, at {hertz:.3g} Hz")
        widest = max(overturning.safe_gap, key=lambda gap: gap.to_g - gap.from_g, default=None)
        text = (
            "none: at each frequency, every pulse that overturns it is stronger than all that do not"
            if widest is None
            else f"widest at {widest.frequency_hz:.3g} Hz: pulses of {widest.from_g:.3g} to {widest.to_g:.3g} g do "
            "not overturn it, "
            "though weaker ones do"
        )
        grid.add_row("safe gap", text)
    console.print(grid)
