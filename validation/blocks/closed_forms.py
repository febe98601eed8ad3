"""Cases with exact solutions."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from heeltoe.case.read import read_case
from heeltoe.models.run import rigid
from validation.plain import rectangle, run, sampled
from validation.row import Row

# The references of this file were worked out with this g.
_G = 9.81


def push_and_sine() -> Iterator[Row]:
    """Block 4 x 1 m, friction 0.3, constant push 0.15 g, base 0.6 g sin(4 pi t), 5 s: converges with the sampling.

    Between stops the slip is an integral of sines and constants; the reference is their exact sum.
    """
    block = rectangle(4.0, 1.0, 0.3, gravity=_G, density=250.0, push=0.15 * 1000.0 * _G)
    for step, tolerance in ((1e-2, None), (1e-3, None), (1e-4, None), (1e-5, 1e-8)):
        motion = run(block, *sampled(lambda t: 0.6 * _G * np.sin(4.0 * np.pi * t), step, 5.0))
        remark = "sampling error alone" if tolerance is None else ""
        yield Row(f"slip, sampled every {step:g} s [m]", 1.0538997745, motion.summary.slip, tolerance, remark=remark)
    yield Row("stops", 19, len(motion.times_of("slip stops")), 0.0)
    yield Row("velocity at the end [m/s]", 0.5836259828, motion.summary.slip_velocity, 1e-8)


def pulse() -> Iterator[Row]:
    """Rectangular pulse A for t0, yield N g: slip V^2 / (2 g N) (1 - N / A), V = A g t0 (Newmark 1965)."""
    for yield_g, pulse_g, length in ((0.2, 0.8, 0.1), (0.2, 0.5, 0.25), (0.5, 0.6, 0.4)):
        case = read_case(
            {
                "section": {"polygon": [["0 m", "0 m"], ["4 m", "0 m"], ["4 m", "1 m"], ["0 m", "1 m"]]},
                "crack": {"friction": yield_g},
                "motion": {
                    "points": [
                        ["0 s", f"{-pulse_g} g"],
                        [f"{length} s", f"{-pulse_g} g"],
                        [f"{length} s", "0 g"],
                        ["3 s", "0 g"],
                    ]
                },
            }
        )
        velocity = pulse_g * case.gravity * length
        exact = velocity**2 / (2.0 * case.gravity * yield_g) * (1.0 - yield_g / pulse_g)
        ours = rigid(case).residual_slip_m
        yield Row(f"N = {yield_g}, A = {pulse_g}, t0 = {length} s: slip [m]", exact, ours, 1e-12)


def free_rocking() -> Iterator[Row]:
    """Block 1 x 4 m let go at half its slenderness, e = 0: each impact leaves Housner's ratio of the velocity."""
    block = rectangle(1.0, 4.0, 10.0, gravity=_G)
    slenderness = np.arctan(0.25)
    grid = np.linspace(0.0, 6.0, 60_001)
    # Leaning downstream about the toe, with the heel in the air.
    start = [[0.0, 0.5 * slenderness, 0.0], [0.0, 0.0, 0.0]]
    motion = run(block, np.array([0.0, 6.0]), np.zeros(2), grid, start)
    strikes = motion.times_of("heel strikes", "toe strikes")
    yield Row("first impact [s]", 0.5319961, strikes[0], 1e-7)
    rotation = np.abs(motion.histories.gap_toe - motion.histories.gap_heel)
    references = (0.4156574, 0.3455422, 0.2872544, 0.2387989)
    for k, (reference, (since, until)) in enumerate(zip(references, pairwise(strikes), strict=False), 1):
        peak = rotation[(grid > since) & (grid < until)].max() / slenderness
        yield Row(f"peak {k} [slendernesses]", reference, float(peak), 1e-6)
    events = motion.events
    approach = np.abs(events.approach_velocity_heel + events.approach_velocity_toe)
    leaving = np.abs(events.gap_velocity_heel + events.gap_velocity_toe)
    struck = np.isin(events.time, strikes)
    ratio = float(leaving[struck][0] / approach[struck][0])
    yield Row("Housner's ratio 1 - 1.5 sin^2", 1.0 - 1.5 * np.sin(slenderness) ** 2, ratio, 1e-12)
