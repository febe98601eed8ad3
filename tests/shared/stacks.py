"""Two dry rectangles, one on the other: their numbers for the kernel, and a program of small steps that knows neither
events nor modes (Moreau and Jean's time stepping in the coordinates of both centres)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from heeltoe.kernel.block import BLOCK, StackRun, block, run_stack
from heeltoe.kernel.shaking import Shaking

GRAVITY = 9.80665
DENSITY = 2400.0


@dataclass(frozen=True)
class Rectangles:
    """Width and height of both, how far the upper one's middle is downstream; friction, restitution of the cracks."""

    lower: tuple[float, float] = (4.0, 6.0)
    upper: tuple[float, float] = (2.4, 6.0)
    offset: float = 0.2
    friction: tuple[float, float] = (0.9, 0.8)
    restitution: tuple[float, float] = (0.0, 0.0)

    @property
    def bodies(self):
        """(mass, inertia) of each, and its centre (x, z)."""
        bodies, feet = [], ((0.0, 0.0), (self.offset, self.lower[1]))
        for (width, height), (x, foot) in zip((self.lower, self.upper), feet, strict=True):
            mass = DENSITY * width * height
            bodies.append((mass, mass * (width**2 + height**2) / 12.0, x, foot + height / 2.0))
        return bodies

    def numbers(self):
        """Return the numbers of the kernel: all above the lower crack, what is above the upper one, and their place."""
        bodies, blocks, centres = self.bodies, [], []
        feet = ((self.lower[0], 0.0, 0.0), (self.upper[0], self.offset, self.lower[1]))
        for first, (width, middle, foot) in enumerate(feet):
            own = bodies[first:]
            mass = sum(body[0] for body in own)
            x, z = (sum(body[0] * body[place] for body in own) / mass for place in (2, 3))
            inertia = sum(body[1] + body[0] * ((body[2] - x) ** 2 + (body[3] - z) ** 2) for body in own)
            values = {
                "mass_horizontal": mass,
                "mass_vertical": mass,
                "inertia": inertia,
                "height": z - foot,
                "heel_distance": x - middle + width / 2.0,
                "toe_distance": middle + width / 2.0 - x,
                "static_vertical": -mass * GRAVITY,
                "per_horizontal_horizontal": -mass,
                "per_vertical_vertical": -mass,
                "friction_static": self.friction[first],
                "friction_kinetic": self.friction[first],
                "restitution": self.restitution[first],
            }
            assert set(values) <= set(BLOCK)
            blocks.append(block(values))
            centres.append((x, z))
        (x1, z1), (x2, z2) = centres
        return tuple(blocks), np.array([x2 - x1, z2 - z1, 0.0])

    def run(self, shaking: Shaking, moments=()) -> StackRun:
        """Run the kernel."""
        blocks, place = self.numbers()
        return run_stack(blocks, place, shaking, np.asarray(moments, dtype=float))

    def exact(self, time, ground):
        """Return slip, heel gap and toe gap of the lower and of the upper crack at the samples of the motion."""
        result = self.run(Shaking(time, ground), time)
        assert all(crack.outcome == "ok" and crack.summary.impacts for crack in result.cracks)
        assert all(crack.summary.energy_residual < 1e-14 for crack in result.cracks)
        names = ("slip", "gap_heel", "gap_toe")
        return np.column_stack([getattr(crack.histories, name) for crack in result.cracks for name in names])

    def contacts(self):
        """Return masses (6,), and rows of gaps (4, 6) and of slips (4, 6) at heel and toe of the lower and of the upper
        crack; each body moves by (right, up, counter-clockwise) at its centre."""
        (m1, j1, x1, z1), (m2, j2, x2, z2) = self.bodies
        mass = np.array([m1, m1, j1, m2, m2, j2])
        gaps, slips = np.zeros((4, 6)), np.zeros((4, 6))
        crack_height = self.lower[1]
        for corner, side in enumerate((-0.5, 0.5)):
            x = side * self.lower[0]
            gaps[corner, :3], slips[corner, :3] = (0.0, 1.0, x - x1), (1.0, 0.0, z1)
            x = self.offset + side * self.upper[0]
            gaps[2 + corner] = (0.0, -1.0, x1 - x, 0.0, 1.0, x - x2)
            slips[2 + corner] = (-1.0, 0.0, crack_height - z1, 1.0, 0.0, z2 - crack_height)
        return mass, gaps, slips

    def problem(self, time, ground):
        """Return the same for a program that is told masses and rows."""
        mass, gaps, slips = self.contacts()
        along = np.array([1.0, 0.0, 0.0, 1.0, 0.0, 0.0])
        return {
            "mass": mass,
            "gaps": gaps,
            "slips": slips,
            "friction": np.repeat(self.friction, 2),
            "bounce": np.repeat(self.restitution, 2),
            "force": -GRAVITY * mass * np.array([0.0, 1.0, 0.0, 0.0, 1.0, 0.0]),
            "along": -mass * along,
            "time": time,
            "ground": ground,
        }

    def stepped(self, time, ground, step):
        """Return the moments of steps, and slip, heel and toe gap of the lower and of the upper crack then (n, 6)."""
        mass, gaps, slips = self.contacts()
        weight = np.array([0.0, -mass[1] * GRAVITY, 0.0, 0.0, -mass[4] * GRAVITY, 0.0])
        mu, bounce = np.repeat(self.friction, 2), np.repeat(self.restitution, 2)
        rows = np.concatenate([gaps, slips])
        delassus = (rows / mass) @ rows.T
        count = round(time[-1] / step)
        middle = np.interp((np.arange(count) + 0.5) * step, time, ground)
        drive = np.array([1.0, 0.0, 0.0, 1.0, 0.0, 0.0])
        place, speed, push = np.zeros(6), np.zeros(6), np.zeros(8)
        seen = np.zeros((count + 1, 6))
        for k in range(count):
            free = speed + step * (weight / mass - drive * middle[k])
            # Contact by the gap in the middle of the step.
            active = np.flatnonzero(gaps @ (place + 0.5 * step * speed) <= 0.0)
            if active.size:
                before, after = gaps @ speed, rows @ free
                push = _solved(delassus, after, before * bounce, mu, active, push)
                free = free + (rows.T @ push) / mass
            else:
                push[:] = 0.0
            place, speed = place + 0.5 * step * (speed + free), free
            seen[k + 1] = (slips[0] @ place, *(gaps[:2] @ place), slips[2] @ place, *(gaps[2:] @ place))
        return np.arange(count + 1) * step, seen


def _solved(delassus, free, bounced, mu, active, start):
    """Return the impulses of the contacts in a step: projections, one contact after the other, until they settle."""
    push = np.zeros(8)
    push[active], push[active + 4] = start[active], start[active + 4]
    moved = free + delassus @ push
    for _ in range(500):
        most = 0.0
        for contact in active:
            for row, low, high in ((contact, 0.0, np.inf), (contact + 4, None, None)):
                wanted = moved[row] + (bounced[contact] if row == contact else 0.0)
                if row != contact:
                    high = mu[contact] * push[contact]
                    low = -high
                changed = min(max(push[row] - wanted / delassus[row, row], low), high) - push[row]
                if changed:
                    push[row] += changed
                    moved = moved + delassus[:, row] * changed
                    most = max(most, abs(changed) * delassus[row, row])
        if most < 1e-11:
            break
    return push


#: Both rock; both slide, rock and strike; both rock and bounce: the blocks and the peak of the ground [m/s2].
STACKS = {
    "rock": (Rectangles(), 5.5),
    "slide": (Rectangles(friction=(0.45, 0.35)), 6.5),
    "bounce": (Rectangles(restitution=(0.2, 0.3)), 5.5),
}


def pulse(size=5.0, frequency=1.0, rest=2.0, interval=0.005):
    """Return one sine wave of the ground and the silence after it: times and accelerations [m/s2]."""
    time = np.arange(round((1.0 / frequency + rest) / interval) + 1) * interval
    return time, np.where(time <= 1.0 / frequency, -size * np.sin(2.0 * np.pi * frequency * time), 0.0)


def at_samples(time, moments, seen):
    """Return what was seen at other moments at those of the motion, straight between."""
    return np.column_stack([np.interp(time, moments, column) for column in seen.T])
