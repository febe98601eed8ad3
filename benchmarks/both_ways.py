"""A block whose ground shakes along and across the plane that it stands on: friction is one circle. For ours and for
Siconos, whose friction in three dimensions is the same circle in every contact.

The block is 2 m wide and 3 m high, 2500 kg/m3, dry, without rebound. For a second the ground moves with a sine of 1 g
and 2 Hz along, and with one of 3 Hz across; then it stands still for another. It is held upright across, as neighbours
hold a monolith.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from problems import Floats, G, rectangle

from heeltoe.kernel.block import run_block
from heeltoe.kernel.shaking import Shaking

WIDTH, HEIGHT, DENSITY = 2.0, 3.0, 2500.0
MASS = DENSITY * WIDTH * HEIGHT
#: The motion is straight between such samples [s].
TIME = np.arange(401) * 0.005


@dataclass(frozen=True)
class Shaken:
    """The friction of the block, and how strong the ground shakes across [g]."""

    friction: float
    strength: float

    @property
    def ground(self) -> tuple[Floats, Floats]:
        """Accelerations of the ground along and across at the samples [m/s2]."""
        along = G * np.sin(4.0 * math.pi * TIME)
        across = self.strength * G * np.sin(6.0 * math.pi * TIME + 0.5)
        across[0] = 0.0
        for motion in (along, across):
            motion[201:] = 0.0
        return along, across

    def ours(self) -> Floats:
        """Return gaps of heel and toe, slip along and slip across at the samples (n, 4) [m]."""
        along, across = self.ground
        block = rectangle(WIDTH, HEIGHT, DENSITY, self.friction)
        free = (MASS, math.inf, math.inf, 0.0, 0.0)
        run = run_block(block, Shaking(TIME, along, cross=across), TIME, across=free)
        seen = run.histories
        return np.column_stack([seen.gap_heel, seen.gap_toe, seen.slip, run.crossing.kept[:, 0]])

    def problem(self) -> dict[str, Floats]:
        """Return the same for a program that takes masses and rows: motions right, up, counter-clockwise, across."""
        mass = MASS * np.array([1.0, 1.0, (WIDTH**2 + HEIGHT**2) / 12.0, 1.0])
        along, across = self.ground
        return {
            "mass": mass,
            "gaps": np.array([[0.0, 1.0, side * WIDTH / 2.0, 0.0] for side in (-1.0, 1.0)]),
            "slips": np.tile([1.0, 0.0, HEIGHT / 2.0, 0.0], (2, 1)),
            "crosses": np.tile([0.0, 0.0, 0.0, 1.0], (2, 1)),
            "friction": np.full(2, self.friction),
            "bounce": np.zeros(2),
            "force": np.array([0.0, -MASS * G, 0.0, 0.0]),
            "along": np.array([-MASS, 0.0, 0.0, 0.0]),
            "across": np.array([0.0, 0.0, 0.0, -MASS]),
            "time": TIME,
            "ground": along,
            "ground_across": across,
        }


#: One slides, the other also rocks.
BLOCKS = {"slides": Shaken(0.6, 0.8), "rocks": Shaken(0.8, 0.5)}
