"""Blocks and grounds drawn at random, loads and geometry changing as they move: every run must come to its end."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.case.read import read_case
from heeltoe.kernel.block import BlockRun, Limits, run_block
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import Block, build_block
from heeltoe.models.rigid.varying import varying

# The walk knows the inertia of a block, not where it comes from; the tests keep what draws of such water have found.
_POINT = {"virtual_mass_rotates": False}
_RULES = ("constant", "zero while open", "full while open", "follows opening")


@dataclass(frozen=True, eq=False)
class Drawn:
    """A block drawn at random, and how it is shaken.

    Attributes
    ----------
    case, block
        The dam and its block.
    shaking
        Noise, straight between its moments or in steps; some with a vertical motion, some with a rotation.
    limits
        Jammed by friction or stopped in Painlevé's paradox.
    """

    case: Case
    block: Block
    shaking: Shaking
    limits: Limits

    def run(self, *, exact: bool = False) -> BlockRun:
        """Shake it, by integration or, as if nothing changed, by the exact walk."""
        what = None if exact else varying(self.case, self.block)
        return run_block(self.block.parameters(), self.shaking, np.empty(0), self.limits, varying=what)


def draw(seed: int) -> Drawn:
    """Draw a block: any shape, size, friction and restitution, uplift that changes by any rule, anchors, any rotation;
    and a ground that moves it. Of some the water leaves next to no weight."""
    rng = np.random.default_rng(seed)
    width = 10.0 ** rng.uniform(-0.3, 2.0)
    height = width * rng.uniform(0.3, 4.0)
    crest, lean = width * rng.uniform(0.1, 1.0), max(0.0, width * rng.uniform(-0.3, 0.2))
    corners = ((0.0, 0.0), (width, 0.0), (lean + crest, height), (lean, height))
    fields: dict[str, Any] = {
        "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]},
        "crack": _crack(rng, height),
        "uplift": _uplift(rng),
        "analysis": {"rotation": str(rng.choice(["small", "p-delta", "finite"]))},
    }
    fills = fields["uplift"]["during_shaking"] == "full while open"
    if rng.random() < 0.8 or fills:
        fields["reservoir"] = {"depth": f"{height * rng.uniform(0.1, 0.95)} m", **_POINT}
    if rng.random() < 0.2:
        fields["tailwater"] = {"depth": f"{height * rng.uniform(0.1, 0.6)} m", **_POINT}
    if rng.random() < 0.15 and not fills:
        fields = _floating(rng, fields)
    if rng.random() < 0.5:
        fields["anchors"] = [_anchor(rng, 0.6 * width) for _ in range(rng.integers(1, 3))]
    case = read_case(fields)
    block = build_block(case)
    return Drawn(case, block, _ground(rng, block), Limits(jam=bool(rng.random() < 0.7)))


def _crack(rng: np.random.Generator, height: float) -> dict[str, Any]:
    crack: dict[str, Any] = {
        "friction": 10.0 ** rng.uniform(-1.0, 0.3),
        "restitution": float(rng.choice([0.0, 0.3, 0.5, 0.9, 0.95])),
        "inclination": f"{rng.choice([0.0, 0.0, rng.uniform(-4.0, 10.0)])} deg",
        "elevation": f"{0.2 * height} m",
    }
    if rng.random() < 0.3:
        friction = crack.pop("friction")
        crack |= {"static_friction": friction, "kinetic_friction": friction * rng.uniform(0.5, 1.0)}
    return crack


def _uplift(rng: np.random.Generator) -> dict[str, Any]:
    rule = str(rng.choice(_RULES))
    pattern = str(rng.choice(["uniform", "triangular", "cut-off", "drained"]))
    fields: dict[str, Any] = {"pattern": pattern, "intensity": rng.uniform(0.2, 1.0), "during_shaking": rule}
    if pattern == "cut-off":
        fields["extent"] = rng.uniform(0.1, 1.0)
    if pattern == "drained":
        fields |= {"drain_position": rng.uniform(0.05, 0.5), "drain_efficiency": rng.uniform(0.0, 1.0)}
    if rule != "constant":
        fields["opening"] = f"{10.0 ** rng.uniform(-6.0, -1.0)} m"
    return fields


def _floating(rng: np.random.Generator, fields: dict[str, Any]) -> dict[str, Any]:
    """Return the block under a pressure of its own that leaves a tenth to a billionth of its weight, where it can."""
    dry = {name: value for name, value in fields.items() if name not in ("reservoir", "tailwater")}
    dry["crack"] = fields["crack"] | {"inclination": "0 deg"}
    rule = {name: fields["uplift"][name] for name in ("during_shaking", "opening") if name in fields["uplift"]}
    plain = read_case(dry | {"uplift": {"pattern": "none"}})
    section = plain.cut
    width, place = section.crack_width, section.centroid[0] - section.heel[0]
    # Heads, in metres of water of 1000 kg/m3, whose force acts below the centroid.
    lift = plain.concrete.density * section.area / 1000.0 * (1.0 - 10.0 ** rng.uniform(-9.0, -1.0))
    toe = 6.0 * lift * place / width**2 - 2.0 * lift / width
    heel = 2.0 * lift / width - toe
    if min(toe, heel) > 0.0:
        dry["uplift"] = {"pattern": "profile", "points": [[0.0, f"{heel} m"], [1.0, f"{toe} m"]]} | rule
    return dry


def _anchor(rng: np.random.Generator, width: float) -> dict[str, Any]:
    return {
        "distance": f"{rng.uniform(0.0, 1.0) * width} m",
        "inclination": f"{rng.choice([0.0, rng.uniform(-30.0, 30.0)])} deg",
        "prestress": f"{rng.choice([0.0, 10.0 ** rng.uniform(2.0, 6.0)])} N/m",
        "axial_stiffness": f"{10.0 ** rng.uniform(4.0, 9.0)} N/m^2",
        "shear_stiffness": f"{rng.choice([0.0, 10.0 ** rng.uniform(4.0, 9.0)])} N/m^2",
    }


def _ground(rng: np.random.Generator, block: Block) -> Shaking:
    g, size = block.gravity, block.height + block.width
    critical = block.critical_accelerations()
    lowest = max(0.05 * g, min(abs(critical.sliding_downstream), abs(critical.rocking_downstream), 5.0 * g))
    pace = math.sqrt(size / 10.0)
    count, step = 40, float(rng.choice([0.01, 0.04, 0.2])) * pace
    across = rng.normal(size=count) * rng.uniform(0.5, 3.0)
    if rng.random() < 0.3:
        # Halves, so that limits and plateaus are met exactly.
        across = np.rint(2.0 * across) / 2.0
    time = np.append(np.arange(count) * step, (count * step) + 2.0 * pace)
    in_steps = rng.random() < 0.3

    def series(noise: Floats, scale: float) -> Floats:
        values = np.append(scale * noise[: count - 1], [0.0, 0.0])
        return np.repeat(values, 2)[:-1] if in_steps else values

    return Shaking(
        np.repeat(time, 2)[1:] if in_steps else time,
        series(across, lowest),
        series(rng.normal(size=count - 1), 0.3 * g) if rng.random() < 0.5 else None,
        series(rng.normal(size=count - 1), 0.1 * g / size) if rng.random() < 0.1 else None,
    )
