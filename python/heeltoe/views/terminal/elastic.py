"""What the terminal shows of what the result of an elastic dam rests on: mesh, damping, contact, time step, energy."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.result.response import Energy
from heeltoe.units.sentences import numbers, written

# Not at run time: periods are shown without waiting for what a run needs.
if TYPE_CHECKING:
    from heeltoe.models.flexible.reduced import FlexibleDam

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


def elastic_lines(response: FlexibleResponse, units: str) -> list[tuple[str, str]]:
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
    lines.append(("time step", _step_line(response, units)))
    if response.energy is not None:
        lines.append(("energy", _energy_line(response.energy, units)))
    return lines


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


def _step_line(response: FlexibleResponse, units: str) -> str:
    s = response.summary
    step = written("{step_s:.3g ms}, {steps:d} steps; ", units, step_s=s["time_step_s"], steps=s["steps"])
    evidence = s["convergence"]
    if evidence is None:
        return f"{step}whether it is short enough was not asked (flexible.convergence_check)"
    return step + written(
        "residual slip {residual_slip_m:.4g mm}, with {coarser_step_s:.3g ms} {coarser_residual_slip_m:.4g mm}: "
        "{change:.2g %} apart ({allowed:g %} allowed)",
        units,
        **evidence,
    )


def _energy_line(energy: Energy, units: str) -> str:
    parts = {
        "friction": energy.friction_j,
        "damping": energy.damping_j,
        "impacts": energy.impact_j,
        "the time stepping": energy.numerical_j,
        "left in the dam": energy.kinetic_j,
    }
    parts = {name: value for name, value in parts.items() if abs(value) > 5e-4 * abs(energy.input_j)}
    (whole, *shares), unit = numbers([energy.input_j, *parts.values()], ".3g MJ/m", units)
    named = ", ".join(f"{name} {share}" for name, share in zip(parts, shares, strict=True))
    gained = written("{gained_j:.1g J/m}", units, gained_j=energy.gained_j)
    return f"{whole} {unit} put in: {named}; the ledger closes to {energy.residual:.0e}, contact added {gained}"
