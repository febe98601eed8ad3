"""Print the table of elastic dams in docs/cross-valley.md: the typical dam under both components of El Centro 1940.

python docs/across_elastic.py RECORDS    # the directory of the records; two minutes on one core
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

import heeltoe
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.motion.records.read import read_record

_EXAMPLE = Path(__file__).parents[1] / "examples" / "typical-base.toml"
_CHANGES = ["rock=rigid", "reservoir.compressible=false", "flexible.elements_across=4", "flexible.theta=0.5"]
# Step, and length of the motion [s].
_STEP, _END = 2.5e-4, 30.0
_PAIRS, _SIGNS = ((180, 270), (270, 180)), (1, -1)
# Peak [g], friction and signs.
_SHAKEN = ((0.4, 1.0, 2), (0.4, 1.2, 2), (0.3, 1.0, 1), (0.3, 1.2, 1), (0.2, 1.0, 1), (0.2, 1.2, 1))


def shaking(records: Path, along: int, across: int, peak: float) -> Shaking:
    """Return both components with one factor, straight between the samples, and 2 s of rest."""
    pair = [read_record(records / f"imperial-valley-1940-elc-{name}.txt").acceleration for name in (along, across)]
    factor = peak * 9.80665 / np.abs(pair[0]).max()
    time = np.arange(round(_END / 0.01) + 1) * 0.01
    x, y = (np.append(factor * values[: time.size], [0.0, 0.0]) for values in pair)
    return Shaking(np.append(time, [_END, _END + 2.0]), x, cross=y)


def main(records: Path) -> None:
    """Print the table."""
    for peak, friction, signs in _SHAKEN:
        case = heeltoe.read_case(_EXAMPLE, [*_CHANGES, f"crack.friction={friction}"])
        dam = build_flexible_dam(case)
        for sign in _SIGNS[:signs]:
            for along, across in _PAIRS:
                both = shaking(records, along, across, peak)
                both = Shaking(both.time, sign * both.horizontal, cross=both.cross)
                runs = [ShakenDam(case, dam, motion).run(_STEP).summary for motion in (both.along_stream(), both)]
                one, two = (1e3 * run.slip for run in runs)
                cells = f"{one:.1f} | {two:.1f} | {1e3 * runs[1].cross_slip:.1f} | {two / one:.3f}"
                print(f"| {along} + {across} | {'+-'[sign < 0]} | {peak} g | {friction} | {cells} |", flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
