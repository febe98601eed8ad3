"""Blocks, motions and runs for tests of the rigid kernel, by name instead of by column."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.kernel._kernel import BlockEvents, BlockHistories, BlockSummary
from heeltoe.kernel.block import BLOCK, EVENT_KINDS, MODES, SETTLE, Limits, run_block
from heeltoe.kernel.shaking import Shaking

GRAVITY = 9.81
EVENT_LIMIT = 1_000_000
WATER = 1000.0


def named(**values: Any) -> dict[str, Any]:
    """Return all fields of a block, those not given zero; each value a number or an (n,) array."""
    unknown = set(values) - set(BLOCK)
    if unknown:
        raise KeyError(f"no such block field: {unknown}")
    like = np.asarray(values["height"], dtype=float)
    return {name: np.zeros_like(like) + values.get(name, 0.0) for name in BLOCK}


def rows(block: dict[str, Any]) -> Floats:
    """Return the kernel's (22,) or (n, 22) array of a named block."""
    return np.ascontiguousarray(np.stack([block[name] for name in BLOCK], axis=-1), dtype=float)


def ordinary(
    *,
    mass: Any = 1000.0,
    added: Any = 0.0,
    height: Any = 1.0,
    heel: Any = 0.5,
    toe: Any = 0.5,
    inertia: Any = None,
    friction: Any = 0.5,
    kinetic: Any = None,
    restitution: Any = 0.0,
    push: Any = 0.0,
    uplift: Any = 0.0,
    moment: Any = 0.0,
    gravity: Any = GRAVITY,
    push_per_vertical: Any = 0.0,
) -> dict[str, Any]:
    """Return a block under gravity, push, uplift and the moment of all static forces about its reference point.

    `added` is the virtual water that moves horizontally only. Without `inertia` the block is a rectangle of twice the
    height and of the base's width.
    """
    return named(
        mass_horizontal=mass + added,
        mass_vertical=mass,
        inertia=mass * ((heel + toe) ** 2 + 4.0 * height**2) / 12.0 if inertia is None else inertia,
        height=height,
        heel_distance=heel,
        toe_distance=toe,
        static_horizontal=push,
        static_vertical=uplift - mass * gravity,
        static_moment=moment,
        per_horizontal_horizontal=-(mass + added),
        per_vertical_vertical=-mass,
        per_vertical_horizontal=push_per_vertical,
        friction_static=friction,
        friction_kinetic=friction if kinetic is None else kinetic,
        restitution=restitution,
    )


def paradox_possible(block: dict[str, Any]) -> Any:
    """Return whether friction can pull a corner in (Painlevé): contact laws then have no solution, or several.

    A corner at x pushed by N while it slips accelerates by N (1/m + x (x - mu S H)/J); for both corners at once that
    becomes a 2x2 matrix. All is well as long as its principal minors are positive.
    """
    corners = (-block["heel_distance"], block["toe_distance"])
    bad = False
    for sign in (1.0, -1.0):
        drag = sign * block["friction_static"] * block["height"]
        (a, b), (c, d) = (
            [1.0 / block["mass_vertical"] + x * (other - drag) / block["inertia"] for other in corners] for x in corners
        )
        bad = bad | (a <= 0.0) | (d <= 0.0) | (a * d <= b * c)
    return bad


def rectangle(
    width: float,
    tall: float,
    friction: float,
    *,
    water: float = 0.0,
    uplift: float = 0.0,
    density: float = 2650.0,
    gravity: float = GRAVITY,
    **others: Any,
) -> Floats:
    """Return the kernel's numbers of a rectangle with water to a depth [m] and `uplift` times the full triangle."""
    mass = density * width * tall
    added = 7.0 / 12.0 * WATER * water**2
    height = (mass * tall / 2.0 + added * 0.4 * water) / (mass + added)
    push = WATER * gravity * water**2 / 2.0
    lift = uplift * WATER * gravity * water * width / 2.0
    values = {
        "mass": mass,
        "added": added,
        "height": height,
        "heel": width / 2.0,
        "toe": width / 2.0,
        "inertia": mass * (width**2 + tall**2) / 12.0
        + mass * (tall / 2.0 - height) ** 2
        + added * (0.4 * water - height) ** 2,
        "friction": friction,
        "push": push,
        "uplift": lift,
        # The push acts at a third of the depth, the uplift at a third of the width from the heel.
        "moment": push * (height - water / 3.0) - lift * width / 6.0,
        "gravity": gravity,
    }
    return rows(ordinary(**(values | others)))


@dataclass(frozen=True)
class Run:
    """Result of one run by the kernel's names; `kinds` and `modes` in words."""

    summary: BlockSummary
    outcome: str
    histories: BlockHistories
    modes: list[str]
    events: BlockEvents
    kinds: list[str]


def run(
    block: Floats,
    time: Any,
    horizontal: Any,
    vertical: Any = None,
    *,
    at: Any = (),
    start: Any = None,
    settle: float = SETTLE,
    event_limit: int = EVENT_LIMIT,
    jam: bool = False,
) -> Run:
    """Run the kernel; `at` are the moments of the histories."""

    def array(values: Any) -> Floats:
        return np.ascontiguousarray(values, dtype=float)

    shaking = Shaking(array(time), array(horizontal), None if vertical is None else array(vertical))
    result = run_block(block, shaking, array(at), Limits(event_limit, jam, settle), start=start)
    return Run(
        summary=result.summary,
        outcome=result.outcome,
        histories=result.histories,
        modes=[MODES[m] for m in result.mode],
        events=result.events,
        kinds=[EVENT_KINDS[int(k)] for k in result.events.kind],
    )
