"""Blocks and motions given by bare numbers, for reference cases that are no dams."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.kernel.block import BlockRun, block, run_block
from heeltoe.kernel.shaking import Shaking


def rectangle(
    width: float,
    height: float,
    friction: float,
    *,
    gravity: float,
    restitution: float = 0.0,
    density: float = 2400.0,
    push: float = 0.0,
) -> Floats:
    """Return the kernel's parameters of a rectangle [m, kg/m3] under a constant push [N/m] at its centre."""
    mass = density * width * height
    values = {
        "mass_horizontal": mass,
        "mass_vertical": mass,
        "inertia": mass * (width**2 + height**2) / 12.0,
        "height": height / 2.0,
        "heel_distance": width / 2.0,
        "toe_distance": width / 2.0,
        "static_horizontal": push,
        "static_vertical": -mass * gravity,
        "per_horizontal_horizontal": -mass,
        "per_vertical_vertical": -mass,
        "friction_static": friction,
        "friction_kinetic": friction,
        "restitution": restitution,
    }
    return block(values)


def sampled(ground: Callable[[Floats], Floats], step: float, end: float) -> tuple[Floats, Floats]:
    """Sample a ground acceleration [m/s2] every `step` from 0 to `end` [s]."""
    time = np.arange(round(end / step) + 1, dtype=np.float64) * step
    return time, ground(time)


def run(
    block: Floats,
    time: Floats,
    ground: Floats,
    output_times: Floats | None = None,
    start: list[list[float]] | None = None,
) -> BlockRun:
    """Run the kernel."""
    times = np.empty(0) if output_times is None else output_times
    return run_block(block, Shaking(time, np.ascontiguousarray(ground)), times, start=start)
