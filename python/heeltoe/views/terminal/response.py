"""What the terminal shows of responses (rich)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.response import Response
from heeltoe.result.verdict import comes_to_rest, verdict
from heeltoe.units.write import angle, length
from heeltoe.views.terminal.common import label_grid, print_warnings, quiet_table, sampling
from heeltoe.views.words.warnings import listed

# Not at run time: a run of the rigid model need not wait for the elastic parts.
if TYPE_CHECKING:
    from heeltoe.models.flexible.reduced import FlexibleDam
    from heeltoe.study.comparison import Comparison

# What the names of the choices mean.
_DAMPING = {
    "deformation": "of deformation alone, at all times",
    "thesis": (
        "of all motion while any node of the crack sticks, of the part below alone while none does, as in Zhu (2004)"
    ),
    "modal": "in every mode of deformation",
}
_CONTACT = {
    "coulomb": "exact, with Coulomb friction",
    "idce": "by penalties (Zhu 2004), for comparison",
}


def print_summary(response: Response, console: Console) -> None:
    """Print motion, static state, what the numbers rest on, result, warnings and verdict."""
    _print_head(response, f"{response.model} model", console)
    if response.summary:
        console.print(_result_table(response))
        console.print()
        lines = label_grid()
        for label, text in _result_lines(response):
            lines.add_row(label, text)
        console.print(lines)
        if response.spread is not None:
            console.print()
            console.print(_spread_table(response))
    print_warnings(listed([response]), console)
    _print_verdicts([("Verdict", response.ok, verdict(response))], console)


def print_comparison(both: Comparison, console: Console) -> None:
    """Print the same of both models, side by side."""
    _print_head(both.flexible, f"{both.rigid.model} and flexible model", console)
    if isinstance(both.rigid, DecoupledResponse) and both.rigid.summary:
        lines = label_grid()
        for label, text in _crack_lines(both.rigid):
            lines.add_row(label, text)
        console.print(lines)
        console.print()
    console.print(_comparison_table(both))
    print_warnings(listed([both.rigid, both.flexible]), console)
    verdicts = [(each.model.capitalize(), each.ok, verdict(each)) for each in (both.rigid, both.flexible)]
    _print_verdicts([*verdicts, ("Difference", both.ok, both.meaning())], console)


def _print_head(response: Response, model: str, console: Console) -> None:
    """Print title, motion and static state and, of the flexible model, all that its result rests on."""
    # Titles and names are people's words, in which brackets mean brackets.
    console.print(f"[bold]{escape(response.title or 'Untitled case')}[/bold]  ({model})", soft_wrap=True)
    console.print()
    grid = label_grid()
    for label, motion in (("motion", response.motion), ("vertical motion", response.vertical)):
        if motion is not None:
            grid.add_row(label, escape(_motion_line(motion, response.gravity)))
    for label, text in _static_lines(response):
        grid.add_row(label, text)
    if isinstance(response, FlexibleResponse):
        for label, text in _elastic_lines(response):
            grid.add_row(label, text)
    if isinstance(response, DecoupledResponse) and response.summary:
        for label, text in _crack_lines(response):
            grid.add_row(label, text)
    console.print(grid)
    console.print()


def _print_verdicts(rows: list[tuple[str, bool, str]], console: Console) -> None:
    """Print labelled sentences; a label is red where there is no result to trust."""
    grid = Table.grid(padding=(0, 2))
    grid.add_column(no_wrap=True)
    grid.add_column()
    for label, good, text in rows:
        grid.add_row(f"[{'bold' if good else 'bold red'}]{label}[/]", escape(text))
    console.print()
    console.print(grid)


def _length(value: float | None) -> str:
    return length(value) if value and math.isfinite(value) else "-"


def _rotation(value: float | None) -> str:
    return angle(value) if value and math.isfinite(value) else "-"


def _motion_line(motion: GroundMotion, gravity: float) -> str:
    line = (
        f"{motion.name}: PGA {motion.pga / gravity:.4g} g, PGV {motion.pgv:.3g} m/s, PGD {motion.pgd:.3g} m, "
        f"{motion.duration:.4g} s {sampling(motion)}"
    )
    return "\n".join([line, *motion.processing])


def _static_lines(response: Response) -> list[tuple[str, str]]:
    static = response.static
    lines = []
    factor = static["sliding_safety_factor"]
    lines.append(
        (
            "sliding safety factor",
            "no horizontal force" if factor is None else f"{factor:.3f} under static loads",
        )
    )
    critical = static["critical_acceleration_g"]
    of = {"flexible": " (rigid block)", "decoupled": ", of the crack's own motion"}.get(response.model, "")
    for kind in ("sliding", "rocking"):
        down, up = critical[f"{kind}_downstream"], critical[f"{kind}_upstream"]
        lines.append((f"{kind} starts at", f"{down:.4f} g downstream, {up:.4f} g upstream{of}"))
    return lines


def _elastic_lines(response: FlexibleResponse) -> list[tuple[str, str]]:
    """Return what the result of the flexible model rests on."""
    s = response.summary
    periods = " ".join(f"{period:.4f}" for period in s["periods_s"])
    lines = [("periods", f"{periods} s, of the intact dam with its water")]
    mesh = s["mesh"]
    lines.append(("mesh", f"{mesh_line(mesh['elements'], mesh['nodes'])}; {mesh['crack_nodes']} nodes along the crack"))
    modes = " above and ".join(map(str, mesh["modes"])) + (" below" if len(mesh["modes"]) > 1 else "")
    kept = f"{mesh['basis_error']:.1e} is what those left out take from the flexibility of the crack"
    lines.append(("modes", f"{modes}, {kept if mesh['basis_error'] else 'which is all there are'}"))
    dam = response.crack.dam
    lines.append(("damping", damping_line(s["damping"], _damping_ratio(dam), dam.coefficients)))
    lines.append(("contact", _contact_line(response)))
    step = f"{_step(s['time_step_s'])}, {s['steps']} steps; "
    evidence = s["convergence"]
    if evidence is None:
        step += "whether it is short enough was not asked (flexible.convergence_check)"
    else:
        step += (
            f"residual slip {_exact(evidence['residual_slip_m'])}, with {_step(evidence['coarser_step_s'])} "
            f"{_exact(evidence['coarser_residual_slip_m'])}: {100.0 * evidence['change']:.2g} % apart "
            f"({100.0 * evidence['allowed']:g} % allowed)"
        )
    lines.append(("time step", step))
    if response.energy is not None:
        lines.append(("energy", _energy_line(response)))
    return lines


def _chosen_lines(response: Response) -> list[tuple[str, str]]:
    """Return what was chosen beyond the usual, where it plays a part."""
    s = response.summary
    lines = []
    if s.get("rotation", "small") != "small":
        lines.append(("rotation", "of any size" if s["rotation"] == "finite" else "small, with P-Delta"))
    if s.get("uplift_during_shaking", "constant") != "constant":
        lines.append(("uplift", f"{s['uplift_during_shaking']} in the earthquake"))
    for number, anchor in enumerate(s.get("anchors", ()), 1):
        of = "" if anchor["capacity_n"] is None else f" of {anchor['capacity_n'] / 1e6:.3g} MN/m it is good for"
        lines.append((f"anchor {number}", f"largest tension {anchor['peak_tension_n'] / 1e6:.3g} MN/m{of}"))
    return lines


def _crack_lines(response: DecoupledResponse) -> list[tuple[str, str]]:
    """Return how the crack moves that shakes the part above it."""
    level = response.crack_level
    found = level["convergence"]
    factor = "" if level["amplification"] is None else f", {level['amplification']:.3g} times the ground's"
    felt = level["felt"][0] if len(level["felt"]) == 1 else f"{', '.join(level['felt'][:-1])} and {level['felt'][-1]}"
    periods = " ".join(f"{period:.4f}" for period in level["periods_s"])
    bonded = level["bonded"]
    whole = f"peak {bonded['peak_horizontal_g']:.3g} g"
    if bonded["amplification"] is not None:
        whole += f", {bonded['amplification']:.3g} times the ground's"
    if bonded["periods_s"]:
        whole += f"; its first period is {bonded['periods_s'][0]:.4f} s"
    return [
        (
            "crack level",
            f"peak {level['peak_horizontal_g']:.3g} g{factor}; {level['peak_vertical_g']:.3g} g upward and "
            f"{level['peak_rotation_rad_s2']:.3g} rad/s2 beside it; the block feels the {felt} motion",
        ),
        (
            "periods below",
            f"{periods or 'none above 0.005'} s, of the part below with the part above attached; "
            f"{level['modes']} modes, {100.0 * level['damping_ratio']:.3g} % damping in each",
        ),
        ("dam without a crack", f"{whole}, all of it elastic"),
        (
            "sampling",
            f"every {_step(found['step_s'])}; residual slip {_exact(response.residual_slip_m)}, with "
            f"{_step(found['coarser_step_s'])} {_exact(found['coarser_residual_slip_m'])}",
        ),
    ]


def mesh_line(elements: Any, nodes: Any) -> str:
    """Say how large the meshes of the parts are."""
    parts = [f"{e} elements, {n} nodes" for e, n in zip(elements, nodes, strict=True)]
    return parts[0] if len(parts) == 1 else f"{parts[0]} above the crack; {parts[1]} below"


def damping_line(choice: str, ratio: float | None, rayleigh: tuple[float, float] | None) -> str:
    """Say how the concrete is damped."""
    text = f"{choice}: " + ("" if ratio is None else f"{100.0 * ratio:.3g} % ")
    if rayleigh is not None:
        text += f"in the 1st and 3rd mode (Rayleigh: {rayleigh[0]:.3g} 1/s of mass, {rayleigh[1]:.3g} s of stiffness), "
    return text + _DAMPING[choice]


def _damping_ratio(dam: FlexibleDam) -> float:
    """Return the damping ratio behind the coefficients of a dam."""
    if dam.coefficients is not None:
        omega = 2.0 * math.pi / dam.periods[0]
        return float(dam.coefficients[0] / omega + dam.coefficients[1] * omega) / 2.0
    part = dam.reduced[-1]
    return float(part.damping_sticking[-1] / math.sqrt(part.omega_squared[-1])) / 2.0


def _contact_line(response: FlexibleResponse) -> str:
    s = response.summary
    return (
        f"{s['contact']}: {_CONTACT[s['contact']]}; {s['contact_iterations_per_step']:.3g} iterations per step, "
        f"conditions met to {s['contact_residual']:.0e}"
    )


def _energy_line(response: Response) -> str:
    energy = response.energy
    assert energy is not None
    parts = {
        "friction": energy.friction_j,
        "damping": energy.damping_j,
        "impacts": energy.impact_j,
        "the time stepping": energy.numerical_j,
        "left in the dam": energy.kinetic_j,
    }
    named = [f"{name} {value / 1e6:.3g}" for name, value in parts.items() if abs(value) > 5e-4 * abs(energy.input_j)]
    return (
        f"{energy.input_j / 1e6:.3g} MJ/m put in: {', '.join(named)}; the ledger closes to {energy.residual:.0e}, "
        f"contact added {energy.gained_j:.1g} J/m"
    )


def _step(seconds: float) -> str:
    return f"{1e3 * seconds:.3g} ms"


def _exact(metres: float) -> str:
    return f"{1e3 * metres:.4g} mm"


def _result_table(response: Response) -> Table:
    table = quiet_table()
    table.add_column("")
    table.add_column("downstream", justify="right")
    table.add_column("upstream", justify="right")
    slip = response.residual_slip_m
    table.add_row("residual slip", *(_length(max(0.0, way * slip)) for way in (1, -1)))
    rotations = (response.rocking_downstream_rad, response.rocking_upstream_rad)
    openings = (response.opening_upstream_m, response.opening_downstream_m)
    table.add_row("peak slip", *map(_length, (response.peak_slip_downstream_m, -response.peak_slip_upstream_m)))
    table.add_row("largest rotation", *map(_rotation, rotations))
    if response.elastic:
        table.add_row("largest opening, this face", *map(_length, reversed(openings)))
    else:
        table.add_row("opening it means, other face", *map(_length, openings))
    return table


def _result_lines(response: Response) -> list[tuple[str, str]]:
    lines = [("slip by mode", _slip_by_mode(response))] if _slip_by_mode(response) else []
    times = [
        f"{name.replace('_', '-')} {value:.2f} s" for name, value in response.time_by_mode_s.items() if value >= 5e-3
    ]
    lines.append(("time by mode", ", ".join(times)))
    lines += _chosen_lines(response)
    if response.elastic:
        return [*lines, ("node strikes", _strikes(response)), ("in the end", _in_the_end(response))]
    closes = f"the energy ledger closes to {response.energy.residual if response.energy else 0.0:.0e}"
    return [*lines, ("events", f"{response.events}, {response.impacts} of them impacts; {closes}")]


def _slip_by_mode(response: Response) -> str:
    parts = {name.replace("_", "-"): value for name, value in response.slip_by_mode_m.items()}
    return ", ".join(f"{name} {length(value)}" for name, value in parts.items() if abs(value) >= 5e-6)


def _strikes(response: Response) -> str:
    return (
        f"{response.impacts}, at up to {response.largest_impact_velocity_m_s:.2g} m/s" if response.impacts else "none"
    )


def _in_the_end(response: Response) -> str:
    return "at rest" if comes_to_rest(response) else "still moving"


def _spread_table(response: Response) -> Table:
    """Value and spread, side by side, of all that is not next to nothing."""
    spread = response.spread
    assert spread is not None
    table = quiet_table()
    table.add_column("")
    for name in ("this run", "mean", "std. dev.", "least", "most"):
        table.add_column(name, justify="right")
    labels = {
        "residual_slip_m": "residual slip",
        "peak_slip_downstream_m": "peak slip downstream",
        "peak_slip_upstream_m": "peak slip upstream",
        "rocking_downstream_rad": "rotation downstream",
        "rocking_upstream_rad": "rotation upstream",
        "opening_upstream_m": "opening upstream",
        "opening_downstream_m": "opening downstream",
    }
    for name, label in labels.items():
        found = spread[name]
        if found is None:
            continue
        sign = -1.0 if name == "peak_slip_upstream_m" else 1.0
        write, least = (_length, 5e-6) if name.endswith("_m") else (_rotation, 1e-7)
        values = [response.summary[name], found["mean"], found["std"], found["min"], found["max"]]
        if max(map(abs, values)) < least:
            continue
        if sign < 0.0:
            values = [-values[0], -values[1], values[2], -values[4], -values[3]]
        table.add_row(label, *map(write, values))
    step = f", at a step of {_step(spread['time_step_s'])}" if "time_step_s" in spread else ""
    failed = f", {spread['failed']} of them without a result" if spread["failed"] else ""
    table.caption = (
        f"spread over {spread['runs']} runs with the shaking scaled by {spread['scales'][0]:g} to "
        f"{spread['scales'][-1]:g}{step}{failed}"
    )
    table.caption_justify = "left"
    return table


def _comparison_table(both: Comparison) -> Table:
    table = quiet_table()
    table.add_column("")
    first = both.rigid.model
    for name in ("rigid block" if first == "rigid" else "decoupled top", "flexible dam", f"flexible/{first}"):
        table.add_column(name, justify="right")
    models = (both.rigid, both.flexible)
    ratio = both.ratio()

    def row(label: str, name: str, write: Any, sign: float = 1.0) -> None:
        values = [each.summary.get(name) for each in models]
        shown = ratio[name]
        table.add_row(
            label,
            *("-" if value is None else write(sign * value) for value in values),
            "-" if shown is None else f"{shown:.3g}",
        )

    row("residual slip, + downstream", "residual_slip_m", _length)
    if any(each.spread is not None for each in models):
        table.add_row("  with the shaking varied by 1 %", *map(_range, models), "")
        table.add_row("  standard deviation of that", *map(_deviation, models), "")
    row("peak slip downstream", "peak_slip_downstream_m", _length)
    row("peak slip upstream", "peak_slip_upstream_m", _length, -1.0)
    row("rotation downstream", "rocking_downstream_rad", _rotation)
    row("rotation upstream", "rocking_upstream_rad", _rotation)
    row("opening, upstream face", "opening_upstream_m", _length)
    row("opening, downstream face", "opening_downstream_m", _length)
    for name in ("sliding", "slide_rocking", "drifting"):
        slips = [each.summary.get("slip_by_mode_m", {}).get(name) for each in models]
        if any(slips):
            table.add_row(f"slip while {name.replace('_', '-')}", *map(_length, slips), "")

    def words(write: Any) -> list[str]:
        return [write(each) if each.summary else "-" for each in models]

    table.add_row("impacts (corners; nodes of the crack)", *words(lambda each: str(each.impacts)), "")
    table.add_row("fastest of them", *words(_fastest), "")
    table.add_row("in the end", *words(_in_the_end), "")
    seconds = (both.seconds[each.model] for each in models)
    table.add_row(
        "computed in", *(f"{value:.2g} s" if value >= 0.1 else f"{1e3 * value:.2g} ms" for value in seconds), ""
    )
    return table


def _fastest(response: Response) -> str:
    return f"{response.largest_impact_velocity_m_s:.2g} m/s" if response.impacts else "-"


def _range(response: Response) -> str:
    found = None if response.spread is None else response.spread["residual_slip_m"]
    if found is None or not (found["min"] or found["max"]):
        return "-"
    return f"{length(found['min'])} to {length(found['max'])}"


def _deviation(response: Response) -> str:
    found = None if response.spread is None else response.spread["residual_slip_m"]
    return "-" if found is None else _length(found["std"])
