"""Blocks and motions given by bare numbers, for reference cases that are no dams."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.models.rigid.walk import SETTLE

Floats = NDArray[np.float64]


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
    return np.array([values.get(name, 0.0) for name in _kernel.BLOCK_FIELDS])


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
) -> tuple[dict[str, float], dict[str, Floats], dict[str, Floats]]:
    """Run the kernel; returns summary, histories and events by the kernel's names."""
    wanted = np.empty(0) if output_times is None else output_times
    row, history, _, events = _kernel.run_rigid(
        block, time, np.ascontiguousarray(ground), None, wanted, start, SETTLE, 1_000_000, False
    )
    return (
        dict(zip(_kernel.SUMMARY_FIELDS, row.tolist(), strict=True)),
        {name: history[:, k] for k, name in enumerate(_kernel.HISTORY_FIELDS)},
        {name: events[:, k] for k, name in enumerate(_kernel.EVENT_FIELDS)},
    )


def times_of(events: dict[str, Floats], *kinds: str) -> list[float]:
    """Return the times of all events of some kinds."""
    wanted = [_kernel.EVENT_KINDS.index(kind) for kind in kinds]
    return [float(t) for t, kind in zip(events["time"], events["kind"], strict=True) if int(kind) in wanted]
