"""What the terminal shows of what the result of an elastic dam rests on: mesh, damping, contact, time step, energy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.result.response import Energy
from heeltoe.units.sentences import numbers, written

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
# A slip of less than this is rounding [m].
_UNSEEN = 1e-9
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
    size = mesh_line(mesh["elements"], mesh["nodes"], cracks=max(1, len(response.at_cracks)))
    lines.append(("mesh", f"{size}; {mesh['crack_nodes']} nodes along the crack"))
    modes = " above and ".join(map(str, mesh["modes"])) + (" below" if len(mesh["modes"]) > 1 else "")
    if response.at_cracks:
        modes = f"{', '.join(map(str, mesh['modes']))} of the parts from the crest down"
    kept = f"{mesh['basis_error']:.1e} is what those left out take from the flexibility of the crack"
    lines.append(("modes", f"{modes}, {kept if mesh['basis_error'] else 'which is all there are'}"))
    rayleigh = s["rayleigh_mass_1_s"], s["rayleigh_stiffness_s"]
    lines.append(("damping", damping_line(s["damping"], s["damping_ratios"], rayleigh)))
    start = s["before_shaking"]
    if start is not None and start["stands"] and (abs(start["slip_m"]) > _UNSEEN or start["open_contacts"]):
        lines.append(("before the shaking", _start_line(start, units)))
    if s["self_excitation"] is not None:
        lines.append(("self-excitation", _growth_line(s["self_excitation"], units)))
    lines.append(("contact", _contact_line(response)))
    lines.append(
        ("time step", written("{step_s:.3g ms}, {steps:d} steps", units, step_s=s["time_step_s"], steps=s["steps"]))
    )
    if response.outcome != "unstable":
        lines.append(("evidence", evidence_line(s["evidence"], units)))
    if response.energy is not None:
        lines.append(("energy", _energy_line(response.energy, units)))
    return lines


def mesh_line(elements: Any, nodes: Any, cracks: int = 1) -> str:
    """Say how large the meshes of the parts are."""
    parts = [f"{e} elements, {n} nodes" for e, n in zip(elements, nodes, strict=True)]
    if cracks > 1:
        return f"{'; '.join(parts)}; of the parts from the crest down"
    return parts[0] if len(parts) == 1 else f"{parts[0]} above the crack; {parts[1]} below"


def damping_line(choice: str, ratios: Sequence[float], rayleigh: tuple[float | None, float | None] | None) -> str:
    """Say how the concrete is damped, and what the lowest modes of the intact dam get of it."""
    got = " ".join(f"{100.0 * ratio:.3g}" for ratio in ratios)
    text = f"{choice}, {_DAMPING[choice]}; {got} % in modes 1 to {len(ratios)} of the intact dam"
    if rayleigh is not None and rayleigh[0] is not None:
        text += f" (Rayleigh: {rayleigh[0]:.3g} 1/s of mass, {rayleigh[1]:.3g} s of stiffness)"
    return text


def _start_line(start: Mapping[str, Any], units: str) -> str:
    """Say what the crack does under the static loads alone."""
    opened = start["open_contacts"]
    nodes = {0: "no node", 1: "1 node"}.get(opened, f"{opened} nodes")
    return written(
        "let go, the crack slips by {slip_m:.4g mm} and opens at {nodes} under the static loads, and stands; the slip "
        "above counts from there",
        units,
        slip_m=start["slip_m"],
        nodes=nodes,
    )


def _growth_line(found: Mapping[str, float | None], units: str) -> str:
    """Say whether a vibration grows as the dam slides."""
    rate, sliding, damped = (found[name] for name in ("growth_1_s", "sliding_time_s", "twice_damped_slip_m"))
    assert rate is not None
    assert sliding is not None
    if rate <= 0.0:
        return f"steady sliding is stable; it slides for {sliding:.3g} s"
    text = f"a vibration of the sliding dam grows by {rate:.3g} 1/s; it slides for {sliding:.3g} s"
    if damped is not None:
        text += written("; with twice the damping the slip is {slip_m:.4g mm}", units, slip_m=damped)
    return text


def _contact_line(response: FlexibleResponse) -> str:
    s = response.summary
    found = (each.get("friction_law") for each in (s, *s.get("cracks", ())))
    laws = " and ".join(sorted({law["name"] for law in found if law is not None}))
    how = f"exact, with friction by {laws}" if laws else _CONTACT[s["contact"]]
    return (
        f"{s['contact']}: {how}; {s['contact_iterations_per_step']:.3g} iterations per step, "
        f"conditions met to {s['contact_residual']:.0e}"
    )


def evidence_line(found: Mapping[str, Any] | None, units: str) -> str:
    """Say what the residual slip is worth, and what moves it."""
    if found is None:
        return "none was asked for (flexible.evidence)"
    slip = found["residual_slip_m"]
    what = f", the mean of {len(found['scales'])} runs as single ones scatter" if found["value_is"] == "mean" else ""
    text = written("residual slip {value:.4g mm} ± {uncertainty:.2g mm}", units, **slip) + what
    text += written(
        ": {step:.2g mm} by the time step ({other_s:.3g ms})",
        units,
        step=slip["step"],
        other_s=found["other_time_step_s"],
    )
    if slip["mesh"] is not None:
        across = f"{found['other_elements_across']} across instead of {found['elements_across']}"
        text += written(", {mesh:.2g mm} by the mesh ({across})", units, mesh=slip["mesh"], across=across)
    if slip["shaking"] is not None:
        scales = min(found["scales"]), max(found["scales"])
        text += written(
            ", {shaking:.2g mm} by the shaking ({low:g} to {high:g} times)",
            units,
            shaking=slip["shaking"],
            low=scales[0],
            high=scales[1],
        )
    word = "converged" if found["converged"] else "NOT converged"
    return text + written("; {word}, {allowed_m:.2g mm} are allowed", units, word=word, allowed_m=found["allowed_m"])


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
