"""Rough cracks, worn cracks and two rigid blocks, by hand."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from heeltoe.case.model import Case
from heeltoe.case.read import read_case
from heeltoe.models.run import rigid
from heeltoe.result.response import Response
from validation.row import Row

_WIDTH = 20.0
_PULSE_G, _LENGTH = 0.8, 0.3
_PULSE = [["0 s", f"{-_PULSE_G} g"], [f"{_LENGTH} s", f"{-_PULSE_G} g"], [f"{_LENGTH} s", "0 g"], ["6 s", "0 g"]]


def _rough(
    friction: float, slope: float, height: float = 1.0, wear: float = 0.0, points: list[list[str]] = _PULSE
) -> Case:
    """Return a dry block 20 x 1 m on asperities of a slope and a height [m]."""
    roughness = {
        "asperity_height": f"{height!r} m",
        "wave_length": f"{2.0 * height / slope!r} m",
        "wear": f"{wear!r} m^2/J",
    }
    corners = [["0 m", "0 m"], [f"{_WIDTH} m", "0 m"], [f"{_WIDTH} m", "1 m"], ["0 m", "1 m"]]
    crack = {"friction": friction, "roughness": roughness}
    return read_case({"section": {"polygon": corners}, "crack": crack, "motion": {"points": points}})


def _borne(friction: float, slope: float) -> float:
    return math.tan(math.atan(friction) + math.atan(slope))


def rough_crack() -> Iterator[Row]:
    """Block 20 x 1 m on asperities under a rectangular pulse of 0.8 g and 0.3 s: climb, limit of dilation, wear.

    A flank of slope k and a friction of tan(phi) along it bear m = tan(phi + arctan k) times what presses on the mean
    plane (Patton). Climbing under a ground acceleration a the block gains (a - m g) / (1 + m k), and after the pulse it
    loses m g / (1 + m k). Wear takes the angle from i to i exp(-c W), W being the work of friction per area (Plesha).
    """
    friction, slope = 0.3, 0.2
    response = rigid(_rough(friction, slope))
    g, strength = response.gravity, _borne(friction, slope)
    up = (_PULSE_G - strength) * g / (1.0 + strength * slope)
    back = strength * g / (1.0 + strength * slope)
    slip = 0.5 * up * _LENGTH**2 + (up * _LENGTH) ** 2 / (2.0 * back)
    rough = response.summary["roughness"]
    yield Row("apparent friction before", strength, rough["apparent_friction_before"], 1e-12)
    yield Row("climb and stop: slip [m]", slip, response.residual_slip_m, 1e-10)
    yield Row("climb and stop: dilation [m]", slope * slip, rough["residual_dilation_m"], 1e-10)
    assert response.energy is not None
    work = response.static["concrete_mass_kg"] * g * (_PULSE_G * 0.5 * up * _LENGTH**2 - slope * slip)
    yield Row("climb and stop: work of friction [J]", work, response.energy.friction_j, 1e-10)
    for share, moves in ((0.999, False), (1.001, True)):
        push = share * strength
        points = [["0 s", f"{-push!r} g"], ["0.5 s", f"{-push!r} g"], ["0.5 s", "0 g"], ["2 s", "0 g"]]
        ours = rigid(_rough(friction, slope, wear=1e-5, points=points)).summary["roughness"]["plastic_work_j_m2"] > 0.0
        what = f"pushed by {share} of its resistance: slips and wears"
        yield Row(what, float(moves), float(ours), 0.0, relative=False)
    for height in (0.005, 0.01):
        ours = rigid(_rough(friction, 0.15, height)).summary["roughness"]["peak_dilation_m"]
        yield Row(f"asperities of {1e3 * height:g} mm, passed: largest dilation [m]", height, ours, 1e-9)
    wear = 1e-4
    response = rigid(_rough(friction, slope, 0.05, wear))
    assert response.energy is not None
    angle = math.atan(slope) * math.exp(-wear * response.energy.friction_j / _WIDTH)
    yield Row("worn: angle after [rad]", angle, response.summary["roughness"]["asperity_angle_after_rad"], 1e-11)
    steep = rigid(_rough(0.1, 0.3))
    what = "flanks steeper than their friction: slip after it has come back [m]"
    yield Row(what, 0.0, steep.residual_slip_m, 1e-9, relative=False, kind="condition")


def _stack(base: float, upper: float) -> Response:
    """Slide two dry slabs of 20 m x 0.5 m, one on the other, by the pulse."""
    corners = [["0 m", "0 m"], [f"{_WIDTH} m", "0 m"], [f"{_WIDTH} m", "1 m"], ["0 m", "1 m"]]
    return rigid(
        read_case(
            {
                "section": {"polygon": corners},
                "crack": {"elevation": "0 m", "friction": base},
                "further_cracks": [{"elevation": "0.5 m", "friction": upper}],
                "motion": {"points": _PULSE},
            }
        )
    )


def _newmark(friction: float, g: float) -> float:
    velocity = _PULSE_G * g * _LENGTH
    return velocity**2 / (2.0 * g * friction) * (1.0 - friction / _PULSE_G)


#: Two slender blocks: friction of the lower and of the upper crack, peak of the ground [m/s2]; by Siconos the largest
#: gaps under the toes of the upper and of the lower one, and their slips [m].
_SICONOS = {
    "both rock": ((0.9, 0.8), 5.5, (0.32696475, 0.06939758), (0.0, 0.0)),
    "both slide and rock": ((0.45, 0.35), 6.5, (0.11289231, 0.06547979), (-0.23982326, -0.08352458)),
}


def _slender(friction: tuple[float, float], size: float) -> Response:
    """Rock two dry blocks by one sine wave of the ground of 1 s, of a peak [m/s2]."""
    time = np.arange(501) * 0.005
    ground = np.where(time <= 1.0, -size * np.sin(2.0 * math.pi * time), 0.0)
    corners = ((0.0, 0.0), (4.0, 0.0), (4.0, 6.0), (3.4, 6.0), (3.4, 12.0), (1.0, 12.0), (1.0, 6.0), (0.0, 6.0))
    case: dict[str, Any] = {
        "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]},
        "crack": {"elevation": "0 m", "friction": friction[0], "restitution": 0.0},
        "further_cracks": [{"elevation": "6 m", "friction": friction[1]}],
        "motion": {
            "points": [[f"{t!r} s", f"{a!r} m/s^2"] for t, a in zip(time.tolist(), ground.tolist(), strict=True)]
        },
        "analysis": {"silence": "0 s"},
    }
    return rigid(read_case(case))


def two_blocks() -> Iterator[Row]:
    """Two rigid blocks, one on the other: slabs that slide under a pulse by hand, slender ones that rock by Siconos.

    Slabs of 20 m x 0.5 m, as heavy as each other, under 0.8 g for 0.3 s. With friction 0.3 below and 0.1 above both
    slide: the upper one as Newmark's block of 0.1, the lower one as that of 2 x 0.3 - 0.1, on which it stops first.
    The slender ones are 4 m x 6 m under 2.4 m x 6 m, 0.2 m downstream of its middle, under one sine wave of 1 s;
    Siconos 4.4.0 has steps of 0.025 ms (`two_blocks` in benchmarks/peer_siconos.py), and slips are compared to 0.2 mm.
    """
    for base, upper, what in ((0.3, 0.9, "upper crack bonded"), (0.9, 0.2, "base bonded"), (0.3, 0.1, "both slide")):
        response = _stack(base, upper)
        g = response.gravity
        ours = [crack["residual_slip_m"] for crack in response.cracks]
        below = _newmark(2.0 * base - upper, g) if upper < base else _newmark(base, g)
        lower = below if base < _PULSE_G else 0.0
        above = _newmark(upper, g) - lower if upper < base else 0.0
        yield Row(f"{what}: slip of the upper crack [m]", above, ours[0], 1e-10, relative=above > 0.0)
        yield Row(f"{what}: slip of the base [m]", lower, ours[1], 1e-10, relative=lower > 0.0)
    for what, (friction, size, gaps, slips) in _SICONOS.items():
        cracks = _slender(friction, size).cracks
        for name, gap, slip, crack in zip(("upper", "lower"), gaps, slips, cracks, strict=True):
            ours = crack["largest_gap_toe_m"]
            yield Row(f"{what}: largest gap under the {name} toe [m]", gap, ours, 1e-3, kind="program")
            ours = crack["residual_slip_m"]
            yield Row(f"{what}: slip of the {name} crack [m]", slip, ours, 2e-4, relative=False, kind="program")
