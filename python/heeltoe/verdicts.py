"""What a response means, in one or two sentences."""

from __future__ import annotations

from heeltoe.response import Response

# Below these nobody measures anything on a dam: a hundredth of a millimetre, a thousandth of a milliradian.
_SLIP_M = 1e-5
_ROTATION_RAD = 1e-6


def verdict(response: Response) -> str:
    """Say what the part above the crack does, and whether it is at rest in the end."""
    if not response.ok:
        return f"No result to trust ({response.outcome}): {response.advice}."
    sentences = [_slip(response), _rocking(response), _end(response)]
    return " ".join(sentence for sentence in sentences if sentence)


def length(metres: float) -> str:
    """Write a length as people say it: in mm, or in m from one metre."""
    return f"{metres:.2f} m" if abs(metres) >= 1.0 else f"{1e3 * metres:.1f} mm"


def _slip(response: Response) -> str:
    slip: float = response.residual_slip_m
    down, up = response.peak_slip_downstream_m, -response.peak_slip_upstream_m
    if max(down, up) == 0.0:
        return "The dam does not slide."
    if abs(slip) < _SLIP_M:
        return f"The dam slides to and fro by up to {length(max(down, up))} and ends where it began."
    way = "downstream" if slip > 0.0 else "upstream"
    text = f"The dam slides {length(abs(slip))} {way}"
    back = max(down if slip > 0.0 else up, 0.0) - abs(slip)
    if back > max(_SLIP_M, 0.05 * abs(slip)):
        text += f" (up to {length(abs(slip) + back)} on the way)"
    return text + "."


def _rocking(response: Response) -> str:
    down, up = response.rocking_downstream_rad, response.rocking_upstream_rad
    if max(response.largest_gap_heel_m, response.largest_gap_toe_m) == 0.0:
        return "It does not rock."
    if max(down, up) < _ROTATION_RAD and response.time_by_mode_s["drifting"] == 0.0:
        return "It lifts off by less than anyone could measure."
    parts = []
    if down >= _ROTATION_RAD:
        parts.append(
            f"downstream by {down:.2e} rad, opening the crack "
            f"{length(response.opening_upstream_m)} at the upstream face"
        )
    if up >= _ROTATION_RAD:
        parts.append(
            f"upstream by {up:.2e} rad, opening it {length(response.opening_downstream_m)} at the downstream face"
        )
    text = "It rocks " + " and ".join(parts) if parts else "It lifts off"
    strikes = response.impacts
    if strikes:
        speed = response.largest_impact_velocity_m_s
        text += f"; {strikes} impact{'s' if strikes > 1 else ''}, bounces included, at up to {speed:.2g} m/s"
    return text + "."


def _end(response: Response) -> str:
    if response.final_mode == "rest":
        return "It is at rest in the end."
    return f"It still moves when the run ends ({response.final_mode})."
