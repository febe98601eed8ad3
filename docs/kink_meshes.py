"""Print the table of docs/kinks.md on cracks with a step, on a rigid plane before water without sound:
`python docs/kink_meshes.py`."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from heeltoe import read_case
from heeltoe.case.model import Case
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake

CASE = Path(__file__).parent.parent / "examples" / "stepped-crack.toml"
#: Slope of the step [degrees], 0 without a step, and friction; the step of the example is 1.5 m high and 3 m long.
LINES = {
    "straight, 0.9": (0.0, 0.9),
    "10°, 0.8": (10.0, 0.8),
    "10°, 0.9": (10.0, 0.9),
    "27°, 0.9": (math.degrees(math.atan(0.5)), 0.9),
    "45°, 0.9": (45.0, 0.9),
    "55°, 0.9": (55.0, 0.9),
}
#: Elements across and step [s].
MESHES = ((8, 2e-4), (16, 2e-4), (16, 1e-4), (24, 2e-4), (32, 2e-4), (48, 2e-4))
SCALES = np.array([0.99, 0.995, 1.0, 1.005, 1.01])


def main() -> None:
    """Print a row for each mesh."""
    print(f"| elements across, step | {' | '.join(LINES)} |")
    print("| --- " * (1 + len(LINES)) + "|")
    for across, step in MESHES:
        cells = (f"{mean:.0f} ± {half:.0f}" for mean, half in _row(across, step))
        print(f"| {across}, {1e3 * step:g} ms | {' | '.join(cells)} |", flush=True)


def slips(slope: float, friction: float, across: int, step: float) -> tuple[float, float]:
    """Return the mean slip of five runs at the end of the motion and half of their range [mm]."""
    case = _case(slope, friction, across)
    ends = ShakenDam(case, build_flexible_dam(case), earthquake(case).shaking).run_scaled(step, SCALES)["slip"]
    return 1e3 * float(ends.mean()), 500.0 * float(np.ptp(ends))


def _case(slope: float, friction: float, across: int) -> Case:
    changes = {
        "crack.friction": friction,
        "flexible.elements_across": across,
        "analysis.silence": "0 s",
        "rock": "rigid",
        "reservoir.compressible": False,
    }
    case = read_case(CASE, changes)
    if not slope:
        return case.with_({"crack.kinks": []})
    start, height = 30.0, 1.5
    end = start + height / math.tan(math.radians(slope))
    return case.with_({"crack.kinks": [[f"{start} m", "0 m"], [f"{end!r} m", f"{height} m"]]})


def _row(across: int, step: float) -> Iterator[tuple[float, float]]:
    for slope, friction in LINES.values():
        yield slips(slope, friction, across, step)


if __name__ == "__main__":
    main()
