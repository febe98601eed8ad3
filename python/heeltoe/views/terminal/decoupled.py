"""What the terminal shows of how the crack moves that shakes the part above it."""

from __future__ import annotations

from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.units.sentences import written

_ATTACHED = {
    "rigid body": "the part above attached as a rigid body",
    "mass on the crack": "the mass of the concrete above on its crack",
}


def crack_lines(response: DecoupledResponse, units: str) -> list[tuple[str, str]]:
    """Return how the crack moves, what vibrates below it, and how finely its motion is sampled."""
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
    sampling = written(
        "every {step_s:.3g ms}; residual slip {slip_m:.4g mm}, with {coarser_step_s:.3g ms} {coarser_slip_m:.4g mm}",
        units,
        step_s=found["step_s"],
        slip_m=response.residual_slip_m,
        coarser_step_s=found["coarser_step_s"],
        coarser_slip_m=found["coarser_residual_slip_m"],
    )
    return [
        (
            "crack level",
            f"peak {level['peak_horizontal_g']:.3g} g{factor}; {level['peak_vertical_g']:.3g} g upward and "
            f"{level['peak_rotation_rad_s2']:.3g} rad/s2 beside it; the block feels the {felt} motion",
        ),
        (
            "periods below",
            f"{periods or 'none above 0.005'} s, of the part below with {_ATTACHED[level['upper_part']]}; "
            f"{level['modes']} modes, {100.0 * level['damping_ratio']:.3g} % damping in each",
        ),
        ("dam without a crack", f"{whole}, all of it elastic"),
        ("sampling", sampling),
    ]
