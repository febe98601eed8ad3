"""Friction laws and sequences of motions, by hand and by a program of small steps."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from heeltoe.case.model import Case
from heeltoe.case.read import read_case
from heeltoe.models.run import rigid
from validation.row import Row

_WIDTH = 20.0
_PULSE_G, _LENGTH = 0.8, 0.3
# What the block of small steps is shaken by: [part of g, circular frequency in 1/s].
_SINES = ((0.35, 5.0), (0.3, 11.0), (0.25, 17.0))
_SHAKEN_S, _SAMPLES = 4.0, 2000


def _block(crack: Mapping[str, Any], motion: Mapping[str, Any], **more: Any) -> Case:
    corners = [["0 m", "0 m"], [f"{_WIDTH} m", "0 m"], [f"{_WIDTH} m", "1 m"], ["0 m", "1 m"]]
    return read_case({"section": {"polygon": corners}, "crack": dict(crack), "motion": dict(motion), **more})


def _weakening(peak: float, residual: float, slip: str, form: str = "linear") -> dict[str, Any]:
    return {
        "name": "slip weakening", "form": form, "peak_friction": peak, "residual_friction": residual, "slip": slip
    }  # fmt: skip


def _pulse(size_g: float = _PULSE_G, length: float = _LENGTH) -> dict[str, Any]:
    corners = [["0 s", f"{-size_g} g"], [f"{length} s", f"{-size_g} g"]]
    return {"points": [*corners, [f"{length} s", "0 g"], ["6 s", "0 g"]]}


def _newmark(friction: float, g: float, size_g: float = _PULSE_G, length: float = _LENGTH) -> float:
    velocity = size_g * g * length
    return velocity**2 / (2.0 * g * friction) * (1.0 - friction / size_g)


def weakening_slider() -> Iterator[Row]:
    """Block 20 x 1 m under a rectangular pulse of 0.8 g and 0.3 s: friction that weakens with slip, speed, or a bond.

    While friction falls from 0.6 to 0.3 over D = 50 mm, s'' = 0.2 g + 0.3 g s / D, so that s = (2/3) D (cosh k t - 1),
    k^2 = 0.3 g / D; from D on the block decelerates as any other. The work of friction is the area under its curve:
    by an exponential law it is W (0.3 s + 0.3 D (1 - exp(-s / D))), W the weight. A brittle bond leaves the slip of the
    friction behind it.
    """
    law: dict[str, Any] = _weakening(0.6, 0.3, "50 mm")
    response = rigid(_block({"law": law}, _pulse()))
    g, scale = response.gravity, 0.05
    weight = response.static["concrete_mass_kg"] * g
    k = math.sqrt(0.3 * g / scale)
    reached = math.acosh(1.0 + 1.5) / k
    fast = scale * k * math.sqrt(2.5**2 - 1.0) / 1.5
    left = _LENGTH - reached
    top = fast + 0.5 * g * left
    slip = scale + fast * left + 0.25 * g * left**2 + top**2 / (0.6 * g)
    yield Row("linear: slip [m]", slip, response.residual_slip_m, 1e-10)
    assert response.energy is not None
    lost = weight * (0.45 * scale + 0.3 * (slip - scale))
    yield Row("linear: work of friction [J]", lost, response.energy.friction_j, 1e-10)
    response = rigid(_block({"law": law | {"form": "exponential"}}, _pulse()))
    way = response.residual_slip_m
    assert response.energy is not None
    lost = weight * (0.3 * way + 0.3 * scale * -math.expm1(-way / scale))
    yield Row("exponential: work of friction over its slip [J]", lost, response.energy.friction_j, 1e-10)
    bond = {"name": "cohesion", "cohesion": "2 kPa", "residual_friction": 0.3}
    ours = rigid(_block({"law": bond}, _pulse())).residual_slip_m
    yield Row("brittle bond, then 0.3: slip [m]", _newmark(0.3, g), ours, 1e-10)
    stress = weight / _WIDTH
    for share, expected in ((0.999, True), (1.001, False)):
        held = share * (_PULSE_G - 0.3) * stress
        bond = {"name": "cohesion", "cohesion": f"{held} Pa", "residual_friction": 0.3}
        moves = rigid(_block({"law": bond}, _pulse())).residual_slip_m > 0.0
        yield Row(
            f"bond of {share} times what the pulse needs: slides", float(expected), float(moves), 0.0, relative=False
        )


def barton_bandis() -> Iterator[Row]:
    """Barton and Choubey: angle of friction 30 + JRC log10(JCS / stress) degrees, at most 70; its slip under a pulse.

    The angle is that of the strength which a run under the block's own weight reports; the slip is Newmark's under a
    pulse of 3 g for 0.1 s with its tangent. Strengths and a tangent that a public program, GMisc, prints are for
    JRC 10, JCS 30 MPa and 26 degrees: the run has the same ratio of JCS and stress, on which alone the angle depends.
    """
    for jrc, ratio, angle in ((20, 10.0, 50.0), (10, 100.0, 50.0), (10, 10.0, 40.0), (5, 100.0, 40.0), (0, 10.0, 30.0)):
        weight = 2400.0 * 9.80665
        law = {"name": "barton-bandis", "jrc": jrc, "jcs": f"{ratio * weight} Pa", "residual_angle": "30 deg"}
        response = rigid(_block({"law": law}, _pulse(3.0, 0.1)))
        friction = response.summary["friction_law"]["apparent_friction_before"]
        kind = f"JRC {jrc}, JCS {ratio:g} times the stress"
        yield Row(f"{kind}: angle [degrees]", angle, math.degrees(math.atan(friction)), 1e-12)
        slip = _newmark(math.tan(math.radians(angle)), response.gravity, 3.0, 0.1)
        yield Row(f"{kind}: slip [m]", slip, response.residual_slip_m, 1e-10)
    for jrc, ratio in ((20, 1e3), (10, 0.5)):
        law = {"name": "barton-bandis", "jrc": jrc, "jcs": f"{ratio * weight} Pa", "residual_angle": "30 deg"}
        friction = rigid(_block({"law": law}, _pulse())).summary["friction_law"]["apparent_friction_before"]
        bound = 70.0 if ratio > 1.0 else 30.0
        what = f"JRC {jrc}, JCS {ratio:g} times the stress: angle held at [degrees]"
        yield Row(what, bound, math.degrees(math.atan(friction)), 1e-12)
    yield from _printed_barton()


#: What GMisc prints for JRC 10, JCS 30 MPa and 26 degrees: normal stress and strength [MPa].
_GMISC = ((0.01, 0.018), (0.03, 0.044), (0.05, 0.068), (0.1, 0.122), (0.744, 0.671))
#: Rounding of three digits after the point.
_THREE = 5.1e-4


def _printed_barton() -> Iterator[Row]:
    def printed(what: str, reference: float, ours: float, good: float) -> Row:
        return Row(what, reference, ours, good, relative=False, remark="good for its printed digits", kind="program")

    for stress, strength in _GMISC:
        yield printed(f"GMisc: strength at {stress:g} MPa [MPa]", strength, _gmisc_strength(stress), _THREE)
    stress, near = 0.744, 1e-4
    above, below = _gmisc_strength(stress + near), _gmisc_strength(stress - near)
    slope = (above - below) / (2.0 * near)
    yield printed(f"GMisc: tangent at {stress} MPa [degrees]", 37.4, math.degrees(math.atan(slope)), 0.051)
    yield printed("GMisc: cohesion of the tangent [MPa]", 0.102, 0.5 * (above + below) - stress * slope, _THREE)


def _gmisc_strength(stress: float) -> float:
    """Return the strength at a normal stress [MPa] by the friction which a run under another stress reports."""
    wall = 30.0 / stress * 2400.0 * 9.80665
    law = {"name": "barton-bandis", "jrc": 10, "jcs": f"{wall!r} Pa", "residual_angle": "26 deg"}
    reported: float = rigid(_block({"law": law}, _pulse())).summary["friction_law"]["apparent_friction_before"]
    return stress * reported


#: Laws that are Coulomb's with one coefficient, 0.4.
_REDUCED: dict[str, dict[str, Any]] = {
    "slip weakening, linear": _weakening(0.4, 0.4, "10 mm"),
    "slip weakening, exponential": _weakening(0.4, 0.4, "10 mm", "exponential"),
    "speed weakening": {
        "name": "speed weakening",
        "peak_friction": 0.4,
        "residual_friction": 0.4,
        "speed": "0.1 m/s",
    },
    "cohesion 0": {"name": "cohesion", "cohesion": "0 Pa", "residual_friction": 0.4},
    "Barton-Bandis, JRC 0": {
        "name": "barton-bandis",
        "jrc": 0,
        "jcs": "1 MPa",
        "residual_angle": f"{math.degrees(math.atan(0.4))!r} deg",
    },
    "lift joint, plane": {"name": "lift joint", "surface": "plane", "basic_friction": 0.4},
}


def laws_to_coulomb() -> Iterator[Row]:
    """Every law with numbers that make it Coulomb's, 0.4, under three sines; a program of small steps under their own.

    The block 20 x 1 m only slides. The reference of the first rows is the exact walk with a constant coefficient. The
    program of small steps gives the mass an impulse of friction in each step; its first-order error is extrapolated
    from two lengths of the step.
    """
    motion = {
        "points": [[f"{t!r} s", f"{a!r} g"] for t, a in zip(*(column.tolist() for column in _sines()), strict=True)]
    }
    exact = rigid(_block({"friction": 0.4}, motion)).residual_slip_m
    for name, law in _REDUCED.items():
        ours = rigid(_block({"law": law}, motion)).residual_slip_m
        yield Row(f"{name}: slip [m]", exact, ours, 1e-10, kind="own run")
    for name, (law, bears) in _OWN.items():
        coarse, fine = (_small_steps(bears, parts) for parts in (20, 40))
        ours = rigid(_block({"law": law}, motion)).residual_slip_m
        row = Row(f"{name}: slip by small steps [m]", 2.0 * fine - coarse, ours, 2e-3, kind="prototype")
        yield row


_Bears = Callable[[float, float], float]
#: Laws of a case, and the same by hand: the coefficient at a way [m] and a speed [m/s].
_OWN: dict[str, tuple[dict[str, Any], _Bears]] = {
    "slip weakening, 0.5 to 0.3 over 50 mm": (
        _weakening(0.5, 0.3, "50 mm"),
        lambda way, speed: 0.3 + 0.2 * max(0.0, 1.0 - way / 0.05),
    ),
    "the same, exponential": (
        _weakening(0.5, 0.3, "50 mm", "exponential"),
        lambda way, speed: 0.3 + 0.2 * math.exp(-way / 0.05),
    ),
    "speed weakening, 0.5 to 0.3 over 0.2 m/s": (
        {"name": "speed weakening", "peak_friction": 0.5, "residual_friction": 0.3, "speed": "0.2 m/s"},
        lambda way, speed: 0.3 + 0.2 * math.exp(-speed / 0.2),
    ),
}


def _sines() -> tuple[np.ndarray[Any, np.dtype[np.float64]], np.ndarray[Any, np.dtype[np.float64]]]:
    time = np.linspace(0.0, _SHAKEN_S, _SAMPLES + 1)
    return time, sum((size * np.sin(rate * time) for size, rate in _SINES), np.zeros_like(time))


def _small_steps(bears: _Bears, parts: int) -> float:
    """Return the slip [m] of a mass on friction after steps of so many to a sample."""
    time, ground = _sines()
    ground = 9.80665 * ground
    velocity = slip = path = 0.0
    for k in range(time.size - 1):
        step = (time[k + 1] - time[k]) / parts
        for part in range(parts):
            free = velocity - (ground[k] + (ground[k + 1] - ground[k]) * (part + 0.5) / parts) * step
            impulse = bears(path, abs(velocity)) * 9.80665 * step
            after = 0.0 if abs(free) <= impulse else free - math.copysign(impulse, free)
            slip += 0.5 * step * (velocity + after)
            path += 0.5 * step * abs(velocity + after)
            velocity = after
    return float(slip)


def sequence() -> Iterator[Row]:
    """Three rectangular pulses, one after the other: the slip of each is Newmark's; then with drains that slip closes.

    The block 20 x 1 m of the last rows has water before it and below it, and its drains are 0.1 m wide; the second
    motion finds the drains that the first has left. The reference is the same motion alone, on a block with that
    efficiency from the beginning.
    """
    pulses = ((0.8, 0.1), (0.5, 0.25), (0.6, 0.2))
    first, *others = ({"points": _pulse(size, length)["points"]} for size, length in pulses)
    response = rigid(_block({"friction": 0.3}, first, aftershocks=others))
    total = 0.0
    for number, ((size, length), stage) in enumerate(zip(pulses, response.sequence, strict=True), 1):
        slip = _newmark(0.3, response.gravity, size, length)
        total += slip
        yield Row(f"motion {number}: slip [m]", slip, stage.slip_m, 1e-10)
    yield Row("all of them: slip [m]", total, response.residual_slip_m, 1e-10)
    water = {"reservoir": {"depth": "1 m"}}
    drained = {"pattern": "drained", "drain_position": 0.1, "drain_efficiency": 0.8}
    closing = {"uplift": drained, "statics": {"drain_diameter": "0.1 m"}}
    response = rigid(_block({"friction": 0.3}, _pulse(0.5, 0.1), **water, **closing, aftershocks=[_pulse(0.5, 0.1)]))
    share = 1.0 - response.sequence[0].residual_slip_m / 0.1
    yield Row("drainage that is left", share, response.summary["drainage_by_motion"][1], 1e-12)
    alone = rigid(
        _block({"friction": 0.3}, _pulse(0.5, 0.1), **water, uplift=drained | {"drain_efficiency": 0.8 * share})
    )
    what = "second motion with the drains that are left: slip [m]"
    yield Row(what, alone.residual_slip_m, response.sequence[1].slip_m, 1e-10, kind="own run")
