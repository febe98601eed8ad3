"""Dams, cracks and grounds drawn at random: what the energy must obey whatever the dam and the step."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.kernel.dam import DamRun
from heeltoe.models.flexible.body.reduced import FlexibleDam, build_flexible_dam
from shared.dams import plane_case
from validation.flexible_runs import GAINED

#: Up to this friction, from this damping and up to this step as a part of the dam's first period, dams are ordinary.
FRICTION, DAMPING, STEP = 1.5, 0.005, 0.01
#: Of double precision.
EPSILON = float(np.finfo(np.float64).eps)
#: Of ordinary dams, contact makes at most this part of the turnover in single steps, and this part in the whole run.
#: Of 5000 draws none made more than 3.7e-5 (one with friction 2 made 1.1e-4), or left over more than 2.8e-6. A long
#: step, no damping with theta 0.5, or friction beyond 1.5 can make more: a slipping node turns, and friction works
#: on the mean of both velocities.
MADE, LEFT = GAINED, 1e-5


@dataclass(frozen=True, eq=False)
class Drawn:
    """A dam drawn at random, and how it is shaken.

    Attributes
    ----------
    case, dam
        The dam.
    step
        Time step [s], up to thirty first periods.
    ground
        (n, 2) horizontal and vertical acceleration of each step [m/s2].
    """

    case: Case
    dam: FlexibleDam
    step: float
    ground: Floats

    @property
    def ordinary(self) -> bool:
        """Whether it is one of which contact must make next to no energy."""
        slow_enough = self.step <= STEP * float(self.dam.periods[0])
        return self.case.crack.mu_static <= FRICTION and self.case.concrete.damping >= DAMPING and slow_enough

    @property
    def default(self) -> bool:
        """Whether theta is at least its default, and friction no more than there is, whatever the step."""
        return self.case.crack.mu_static <= FRICTION and self.case.flexible.theta >= 0.52

    def run(self) -> DamRun:
        """Shake it."""
        return self.dam.kernel.run(self.ground, self.step, self.case.flexible.theta)

    def residual_allowed(self, run: DamRun) -> float:
        """Return how much of its turnover a ledger may leave unexplained.

        A step multiplies what rounding leaves in a mode by the square of step times frequency. Besides, the weight
        rests on the crack in every step, where what moves is counted from the state at rest: each step leaves what
        rounding does to the energy of the weight at the height of the dam, now more, now less. That is seen where the
        dam hardly moves.
        """
        fastest = max(float(part.omega_squared.max()) for part in self.dam.reduced)
        section = self.case.cut
        weight = self.case.concrete.density * section.area * self.case.gravity
        resting = EPSILON * math.sqrt(len(self.ground)) * weight * float(np.ptp(section.upstream_face[:, 1]))
        return 1e-12 + 1e-15 * self.step**2 * fastest + resting / max(run.summary.energy_turnover, resting)


def draw(rng: np.random.Generator) -> Drawn:
    """Draw a dam: any shape and size, any stiffness, any friction, any options; and a ground of steps and noise."""
    height = 10.0 ** rng.uniform(0.5, 2.1)
    base = height * rng.uniform(0.3, 1.2)
    crest, lean = base * rng.uniform(0.05, 1.0), max(0.0, base * rng.uniform(-0.2, 0.3))
    corners = [(0.0, 0.0), (base, 0.0), (lean + crest, height), (lean, height)]
    fields: dict[str, Any] = {
        "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]},
        "concrete": {
            "modulus": f"{10.0 ** rng.uniform(8.0, 13.0)} Pa",
            "poisson": rng.uniform(0.0, 0.45),
            "damping": float(rng.choice([0.0, 0.005, 0.02, 0.05, 0.2])),
        },
        "crack": {
            "friction": float(rng.choice([0.0, 0.2, 0.5, 0.8, 1.0, 1.5, 2.0, 10.0])),
            "elevation": f"{height * rng.choice([0.0, rng.uniform(0.2, 0.8)])} m",
        },
        "flexible": {
            "elements_across": int(rng.integers(1, 5)),
            "damping": str(rng.choice(["relative", "stiffness", "modal", "thesis", "deformation"])),
            "contactors": int(rng.integers(1, 6)),
            "theta": float(rng.choice([0.5, 0.52, 0.52, 0.7, 1.0])),
        },
    }
    if rng.random() < 0.6:
        fields["reservoir"] = {"depth": f"{height * rng.uniform(0.3, 1.0)} m"}
    case = plane_case(fields)
    dam = build_flexible_dam(case)
    step = (
        10.0 ** rng.uniform(-3.0, 0.0) * float(dam.periods[0]) * float(rng.choice([0.1, 1.0, 30.0], p=[0.5, 0.4, 0.1]))
    )
    count = int(rng.integers(200, 2000))
    held = int(rng.integers(1, 50))
    strength = case.gravity * 10.0 ** rng.uniform(-1.5, 0.8)
    ground = np.repeat(strength * rng.standard_normal((math.ceil(count / held), 2)), held, axis=0)[:count]
    ground[:, 1] *= rng.integers(0, 2)
    return Drawn(case, dam, step, ground)
