"""Print the table of docs/sliding-that-feeds-itself.md: what moves the slip of the typical dam on rock.

HEELTOE_RECORDS=DIRECTORY python docs/what_moves_the_slip.py    # a quarter of an hour on two cores

The directory has records of two components each in its folder "ensemble".
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

import heeltoe
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.outcome import Outcome

_RECORDS, _PGA, _G = 10, 0.4, 9.80665
# Less residual slip than this has no ratio [m].
_LEAST = 1e-3
# The mesh is that of the default; a single run of it has no evidence.
_RUN = ("flexible.evidence=none", "motion.sign=recorded")
_LEADING = ("rock.modulus=20 GPa", "rock.damping=0.02", "reservoir.compressible=true", *_RUN)

_Motion = Callable[[GroundMotion], GroundMotion]


def _as_recorded(motion: GroundMotion) -> GroundMotion:
    return motion


def _changed(factor: float = 1.0, stretch: float = 1.0, offset: float = 0.0) -> _Motion:
    def change(motion: GroundMotion) -> GroundMotion:
        return GroundMotion.from_points(stretch * motion.time, factor * motion.acceleration + offset)

    return change


_WEAKENING = '{name = "speed weakening", peak_friction = 1.0, residual_friction = 0.85, speed = "0.1 m/s"}'
_BOND = '{tensile_strength = "0.5 MPa", cohesion = "0.6 MPa", fracture_energy = "100 N/m", shear_energy = "1000 N/m"}'
_DRAINS = '{pattern = "drained", drain_position = 0.1, drain_efficiency = 0.667}'
#: What is changed: settings of the case, and the motion.
VARIANTS: dict[str, tuple[tuple[str, ...], _Motion]] = {
    "modulus of the concrete x 2": (("concrete.modulus=40 GPa",), _as_recorded),
    "modulus of the concrete / 2": (("concrete.modulus=10 GPa",), _as_recorded),
    "damping of the concrete 2 %": (("concrete.damping=0.02",), _as_recorded),
    "damping of the concrete 10 %": (("concrete.damping=0.1",), _as_recorded),
    "modulus of the rock x 2": (("rock.modulus=40 GPa",), _as_recorded),
    "modulus of the rock / 2": (("rock.modulus=10 GPa",), _as_recorded),
    "floor reflects 0.5 instead of 0.9": (("reservoir.floor_reflection=0.5",), _as_recorded),
    "water without sound": (("reservoir.compressible=false",), _as_recorded),
    "rigid rock, water without sound": (("rock=rigid", "reservoir.compressible=false"), _as_recorded),
    "the other sign": ((), _changed(factor=-1.0)),
    "shaking x 1.1": ((), _changed(factor=1.1)),
    "time stretched by 1.2": ((), _changed(stretch=1.2)),
    "offset of 0.001 g": ((), _changed(offset=0.001 * _G)),
    "friction 0.8": (("crack.friction=0.8",), _as_recorded),
    "friction 1.2": (("crack.friction=1.2",), _as_recorded),
    "friction falls by 15 % with speed": ((f"crack.law={_WEAKENING}", "crack.friction=none"), _as_recorded),
    "a bond of 0.5 MPa": ((f"crack.bond={_BOND}",), _as_recorded),
    "water 10 m lower": (("reservoir.depth=90 m",), _as_recorded),
    "tailwater of 10 m": (("tailwater.depth=10 m",), _as_recorded),
    "drains that work by two thirds": ((f"uplift={_DRAINS}",), _as_recorded),
    "no uplift": (("uplift.pattern=none",), _as_recorded),
    "no uplift while open": (("uplift.during_shaking=zero while open",), _as_recorded),
}


def _records() -> list[Path]:
    """Return records at equal distances in the list of all, one component of each pair."""
    paths = sorted((Path(os.environ["HEELTOE_RECORDS"]) / "ensemble").glob("*"))[::2]
    return [paths[round(place)] for place in np.linspace(0, len(paths) - 1, _RECORDS)]


def _slip(case: heeltoe.Case, motion: GroundMotion, model: Callable[..., heeltoe.Response]) -> float:
    """Return the residual slip [m]; infinite of a dam that fails."""
    response = model(case, motion)
    if response.outcome is not Outcome.OK:
        return np.inf if response.outcome.failed else np.nan
    assert response.residual_slip_m is not None
    return abs(response.residual_slip_m)


def _slips(work: tuple[Path, str]) -> tuple[str, float, float]:
    """Return the slips of a record under a variant, of the dam and of its block [m]."""
    path, name = work
    record = heeltoe.read_record(path)
    motion = GroundMotion.from_points(
        record.time, record.acceleration * (_PGA * _G / np.abs(record.acceleration).max())
    )
    settings, change = VARIANTS.get(name, ((), _as_recorded))
    base = heeltoe.read_case(Path(__file__).parent.parent / "examples" / "typical-base.toml", list(_LEADING))
    case, block = base.with_(settings), base
    try:
        block = base.with_([text for text in settings if not text.startswith("crack.bond")])
        rigid = _slip(block, change(motion), heeltoe.rigid)
    except heeltoe.InputError:
        rigid = np.nan
    return name, _slip(case, change(motion), heeltoe.flexible), rigid


def _ratio(slips: np.ndarray, base: np.ndarray) -> str:
    """Return the median of ratios, with the least and the largest."""
    known = (base > _LEAST) & ~np.isnan(slips)
    ratios = np.sort(slips[known] / base[known])
    if not ratios.size:
        return "| "
    low, middle, high = (f"{x:.2f}" if np.isfinite(x) else "fails" for x in (ratios[0], np.median(ratios), ratios[-1]))
    return f"{middle} | {low} to {high}"


def main() -> None:
    """Run all variants under all records and print the table."""
    records, names = _records(), ["as it is", *VARIANTS]
    slips = {name: [] for name in names}
    with ProcessPoolExecutor(2) as pool:
        for name, dam, block in pool.map(_slips, [(path, name) for name in names for path in records]):
            slips[name].append((dam, block))
            if len(slips[name]) == len(records):
                print(name, [f"{1e3 * dam:.3g}/{1e3 * block:.3g}" for dam, block in slips[name]], file=sys.stderr)
    base = np.array(slips["as it is"])
    print(
        "Residual slips as it is: "
        + ", ".join(f"{path.stem} {1e3 * row[0]:.3g} mm" for path, row in zip(records, base, strict=True))
    )
    print("| what changes | elastic dam: median | least to largest | block: median | least to largest |")
    print("| --- | --- | --- | --- | --- |")
    for name in VARIANTS:
        dam, block = np.array(slips[name]).T
        print(f"| {name} | {_ratio(dam, base[:, 0])} | {_ratio(block, base[:, 1])} |")


if __name__ == "__main__":
    main()
