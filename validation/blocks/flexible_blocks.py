"""Elastic blocks: sliding, rocking, and a block that slides past the end of another.

Damping is `deformation` at the default ratio of 5 %, theta the default. The blocks of Zhu (2004), section 6.5, are told
without their ground motions and moduli; what is assumed here instead is said where it is.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from heeltoe.case.model import Case
from heeltoe.kernel.dam import CrackedDam, only_crack
from heeltoe.models.flexible.body.reduced import FlexibleDam, ReducedBody, build_flexible_dam
from heeltoe.models.flexible.result.response import FlexibleResponse
from heeltoe.models.run import rigid
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.response import Response
from validation.flexible_runs import Runs
from validation.plain import rectangle, run, sampled
from validation.row import Row
from validation.sources import ENDS_WITH_MOTION, plane_case

Corners = list[tuple[float, float]]

_G = 9.81


def elastic_impulse() -> Iterator[Row]:
    """Block 8 x 16 m, friction 0.2, ground 0.8 g for 0.1 s (section 6.5.1 of Zhu): slip in mm.

    The pulse is that of chapter IV, sampled every millisecond with its last 0.8 g at 0.099 s: this gives the 116.5 mm
    of rigid theory that the prototype was compared with. Steps of 0.05 ms.
    """
    time = np.append(0.001 * np.arange(400), 2.0)
    motion = GroundMotion.from_points(time, np.where(time < 0.0995, -0.8 * _G, 0.0), name="pulse")
    slips, runs = {}, Runs()
    for modulus in (20.0, 200.0, 2000.0):
        case = _case([(0.0, 0.0), (8.0, 0.0), (8.0, 16.0), (0.0, 16.0)], 0.2, modulus, 5e-5)
        slips[modulus] = runs.slip_mm(case, motion)
    limit = 1e3 * rigid(case, motion).residual_slip_m
    # A printed 116.5 is 116.45 to 116.55.
    yield Row("our rigid model", 116.5, limit, 5e-4, remark="good for its four digits", kind="prototype")
    within = "the thesis has its stiff block within 0.104 % of rigid theory"
    yield Row("2000 GPa, against our rigid model", limit, slips[2000.0], 1.04e-3, remark=within, kind="own run")
    slower = "the start of the pulse runs up the block as a wave; what that costs goes as the root of the modulus"
    yield Row("200 GPa, against our rigid model", limit, slips[200.0], None, remark=slower, kind="own run")
    # The prototype's own distance from rigid theory.
    yield Row("20 GPa, against the prototype", 117.0, slips[20.0], 0.5 / 116.5, remark=slower, kind="prototype")
    yield from runs.energy()


def elastic_sliding() -> Iterator[Row]:
    """Block 4 x 1 m of 1 t, 20 GPa, friction 0.3, push 0.15 g, base 0.6 g sin(4 pi t), 5 s: slip in m.

    The push acts on all of the mass, as a ground acceleration of -0.15 g does. 16 elements across, steps of 0.1 ms,
    ground sampled every millisecond. Two prototypes have 1.0529 to 1.0532 m, with a damping that is not known.
    """
    time, shaking = sampled(lambda t: 0.6 * _G * np.sin(4.0 * np.pi * t), 1e-3, 5.0)
    motion, runs = GroundMotion.from_points(time, shaking - 0.15 * _G, name="push and sine"), Runs()
    for poisson in (0.0, 0.2):
        concrete = {"density": "250 kg/m^3", "poisson": poisson}
        case = _case(
            [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (0.0, 1.0)], 0.3, 20.0, 1e-4, elements_across=16, concrete=concrete
        )
        slip = float(runs(case, motion).residual_slip_m)
        what = f"Poisson's ratio {poisson:g}, against"
        # As far as the prototypes are from it.
        yield Row(f"{what} the exact rigid slip", 1.0538997745, slip, 1e-3)
        yield Row(f"{what} the middle of the prototypes", 1.05305, slip, 1e-3, kind="prototype")
    yield from runs.energy()


def elastic_rocking() -> Iterator[Row]:
    """Block 1 x 4 m let go at half its slenderness, friction 1 (as section 6.5.2 of Zhu): first impact, peaks.

    The blow of a rigid block without restitution acts at a corner and leaves Housner's ratio of the velocity. An
    elastic face comes down with all of its nodes at once. About a base of width B and height H a blow at the distance c
    from the middle leaves (k - c B / 2) / (k + c B / 2), k = B^2 / 12 + H^2 / 3: c = B / 2 is Housner's ratio,
    c = B / 6 a blow that grows straight from one corner to the other. The peaks go with its square. Steps of 0.05 ms.
    """
    slenderness = np.arctan(0.25)
    low, high = (0.5 * _left(1.0, 4.0, arm) ** 2 for arm in (1.0 / 2.0, 1.0 / 6.0))
    impact, peaks = _rigid_rocking(slenderness)
    yield Row("rigid: peak 1 by Housner's ratio [slendernesses]", low, peaks[0], 1e-4)
    spread = f"between Housner's {low:.4f} and {high:.4f} of a blow spread over the face; the reference is the middle"
    later = "rigid theory without restitution; the difference of the first blow goes on"
    chaos = "without damping the block still rings when it strikes again: the second blow is another on each mesh"
    for modulus, damping, across in ((20.0, 0.05, 8), (2000.0, 0.05, 8), (20.0, 0.0, 8), (20.0, 0.0, 4)):
        concrete = {"damping": damping, "poisson": 0.2}
        case = _case(
            [(0.0, 0.0), (1.0, 0.0), (1.0, 4.0), (0.0, 4.0)],
            1.0,
            modulus,
            5e-5,
            elements_across=across,
            concrete=concrete,
        )
        first, peak, gained = _elastic_rocking(build_flexible_dam(case), 0.5 * slenderness, slenderness)
        what = f"{modulus:g} GPa, " + ("5 % damping" if damping else f"undamped, {across} across")
        if damping:
            yield Row(f"{what}: first impact [s]", impact, first, 1e-3)
        # What rings on is another on another machine.
        digits = (None, 3) if damping else (3, 2)
        middle, half = (low + high) / 2.0, (high - low) / 2.0
        yield Row(f"{what}: peak 1", middle, peak[0], half, relative=False, remark=spread, digits=digits[0])
        bound = later if damping else chaos
        yield Row(f"{what}: peak 2", peaks[1], peak[1], None, remark=bound, kind="own run", digits=digits[1])
        yield Row(f"{what}: energy made by contact, over turnover", 0.0, gained, 1e-4, relative=False, kind="condition")


def contactors() -> Iterator[Row]:
    """A leaning block that slides past the end of another (as section 6.5.3 of Zhu): five kinds of contactors.

    Both are 8 m wide and 4 m high, the upper leans 4.6 m downstream; friction 0.1, 20 GPa, two elements across, steps
    of 0.1 ms. A push of 0.4 g slides it 1.2 m downstream, where the sharp corner of the lower block carries it between
    two of its nodes, or 2.2 m upstream, where it stands on its own corner between two nodes of the lower face.
    """
    corners = [(0.0, 0.0), (8.0, 0.0), (8.0, 4.0), (12.6, 8.0), (4.6, 8.0), (0.0, 4.0)]
    runs = Runs()
    for way, sign, target, blind in (("downstream", -1.0, 1.2, 1), ("upstream", 1.0, 2.2, 2)):
        pulse = np.sqrt(2.0 * target * 0.1 / _G / (1.0 - 0.1 / 0.4)) / 0.4
        end = 0.4 / 0.1 * pulse + 1.0
        push = 0.4 * _G * sign
        motion = GroundMotion.from_points([0.0, pulse, pulse, end], [push, push, 0.0, 0.0], name="push")
        responses = {}
        for kind in range(1, 6):
            case = _case(corners, 0.1, 20.0, 1e-4, elements_across=2, elevation=4.0, contactors=kind)
            responses[kind] = runs(case, motion)
        depths = ", ".join(f"{1e3 * _depth(response):.2g}" for response in responses.values())
        remark = (
            f"types 1 to 5 penetrate by {depths} mm {way}; those of step and rounding of the face are far below 1 mm"
        )
        slip = float(responses[3].residual_slip_m)
        for kind in (4, 5):
            yield Row(
                f"{way}, type {kind}: slip against type 3 [m]",
                slip,
                float(responses[kind].residual_slip_m),
                1e-3,
                kind="own run",
            )
        for kind in (blind, 3, 4, 5):
            warns = float(any(warning.code == "faces-penetrate" for warning in responses[kind].warnings))
            expected = float(kind == blind)
            what = f"{way}, type {kind}: the result warns of penetration ({expected:.0f})"
            yield Row(what, expected, warns, 0.0, relative=False, remark=remark, kind="condition")
    yield from runs.energy()


def _depth(response: Response) -> float:
    assert isinstance(response, FlexibleResponse)
    return response.crack.deepest_penetration()


def _left(width: float, height: float, arm: float) -> float:
    """Return the ratio of velocities that a blow at `arm` widths from the middle of the base leaves."""
    inertia = width**2 / 12.0 + height**2 / 3.0
    lever = arm * width**2 / 2.0
    return (inertia - lever) / (inertia + lever)


def _rigid_rocking(slenderness: float) -> tuple[float, list[float]]:
    """Return the moment of the first impact [s] and the peaks after the impacts [slendernesses]."""
    grid = np.linspace(0.0, 4.0, 40_001)
    start = [[0.0, 0.5 * slenderness, 0.0], [0.0, 0.0, 0.0]]
    block = rectangle(1.0, 4.0, 1.0, gravity=_G)
    rocking = run(block, np.array([0.0, 4.0]), np.zeros(2), grid, start)
    strikes = rocking.times_of("heel strikes", "toe strikes")
    turned = np.abs(rocking.histories.gap_toe - rocking.histories.gap_heel) / slenderness
    return strikes[0], [float(turned[(grid > a) & (grid < b)].max()) for a, b in pairwise(strikes[:3])]


def _elastic_rocking(dam: FlexibleDam, angle: float, slenderness: float) -> tuple[float, list[float], float]:
    """Return the same of an elastic block, and what contact has made over the turnover."""
    step, end = 5e-5, 2.5
    part = _leaning(dam, angle)
    leaning = CrackedDam((part,), only_crack((part,), (1.0, 1.0)), 3)
    rocking = leaning.run(np.zeros((round(end / step), 2)), step, 0.52, stride=1)
    time, turned = rocking.frames.time, rocking.frames.rotation
    # It strikes where it passes the upright; a face that flutters there passes more than once.
    upright = time[1:][turned[1:] * turned[:-1] < 0.0]
    strikes = upright[np.diff(upright, prepend=-1.0) > 0.1]
    peaks = [float(np.abs(turned[(time > a) & (time < b)]).max()) for a, b in pairwise([*strikes[:2], end])]
    return (
        float(strikes[0]),
        [peak / slenderness for peak in peaks],
        rocking.summary.energy_gained / rocking.summary.energy_turnover,
    )


def _leaning(dam: FlexibleDam, angle: float) -> ReducedBody:
    """Lean a block downstream by `angle`, about its toe, deformed as it is while it falls without vibrating."""
    part, rigid_modes = dam.reduced[0], dam.modes[0].rigid
    count = part.shapes.shape[1] // 2
    toe = part.shapes[:, [count - 1, 2 * count - 1]]
    # The force on the toe with which it does not accelerate; it bends the block.
    moves = toe[:rigid_modes]
    force = np.linalg.solve(moves.T @ moves, -moves.T @ part.load[:rigid_modes])
    start = np.zeros_like(part.load)
    start[rigid_modes:] = (part.load + toe @ force)[rigid_modes:] / part.omega_squared[rigid_modes:]
    place = part.position - part.shapes.T @ part.start
    target = np.concatenate([np.zeros(count), angle * (place[count - 1] - place[:count])])
    bent = toe.T @ start
    target -= np.repeat(bent, count)
    start[:rigid_modes] = np.linalg.lstsq(part.shapes[:rigid_modes].T, target)[0]
    return replace(part, start=start, position=place + part.shapes.T @ start)


def _case(
    corners: Corners,
    friction: float,
    modulus: float,
    step: float,
    *,
    elevation: float = 0.0,
    concrete: dict[str, Any] | None = None,
    **flexible: Any,
) -> Case:
    return plane_case(
        {
            "gravity": f"{_G} m/s^2",
            "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]},
            "concrete": {"modulus": f"{modulus} GPa", **(concrete or {})},
            "crack": {"friction": friction, "elevation": f"{elevation} m"},
            **ENDS_WITH_MOTION,
            "flexible": {
                "elements_across": 8,
                "time_step": f"{step} s",
                "evidence": "none",
                **flexible,
            },
        }
    )
