"""Print how often the stated uncertainty of an elastic dam under both components contains what a finer run finds.

python docs/across_evidence.py [FIRST] [END]    # dams FIRST to END of a hundred; some seconds each on an idle core
"""

from __future__ import annotations

import sys

import numpy as np
from across_the_valley import dam
from scipy.stats import qmc

import heeltoe

_DAMS, _SEED = 100, 53
# As the dams of across_the_valley.py, where elastic ones slide: height [m], width and depth over height, friction, peak [g].
_LEAST = (30.0, 0.8, 0.5, 0.6, 0.2)
_MOST = (150.0, 1.1, 0.9, 1.0, 0.5)
# The finer run: so many times fewer seconds a step, and more elements along the crack.
_FINER_STEP, _FINER_MESH = 4.0, 2
_ELASTIC = {"concrete.modulus": "25 GPa", "rock": "rigid", "reservoir.compressible": False, "motion.duration": "10 s"}


def held(number: int, values: np.ndarray) -> dict[str, tuple[float, float, float]]:
    """Return the slip along and across of a dam, its uncertainty and the slip of a finer run [m]."""
    # The first ones have made motions.
    case = dam(number % 80, values).with_(_ELASTIC)
    response = heeltoe.run(case, "flexible")
    evidence = response.evidence
    finer = case.with_(
        {
            "flexible.evidence": "none",
            "flexible.elements_across": _FINER_MESH * evidence.elements_across,
            "flexible.time_step": f"{evidence.time_step_s / _FINER_STEP!r} s",
        }
    )
    true = heeltoe.run(finer, "flexible")
    along, across = evidence.residual_slip_m, evidence.residual_slip_cross_m
    return {
        "along": (along.value, along.uncertainty, true.residual_slip_m),
        "across": (across.value, across.uncertainty, true.cross_valley.residual_slip_cross_m),
    }


def main(first: int, end: int) -> None:
    """Run dams, and count those whose finer slip is within the uncertainty."""
    drawn = qmc.scale(qmc.LatinHypercube(5, rng=_SEED).random(_DAMS), _LEAST, _MOST)[first:end]
    within: dict[str, list[bool]] = {}
    for place, values in enumerate(drawn):
        for name, (slip, worth, true) in held(first + place, values).items():
            within.setdefault(name, []).append(abs(slip - true) <= worth)
            row = f"{1e3 * slip:.2f} +- {1e3 * worth:.2f}, finer {1e3 * true:.2f} mm"
            print(f"{first + place} {name}: {row}", file=sys.stderr, flush=True)
    print("| slip | dams | within the uncertainty |")
    print("| --- | --- | --- |")
    for name, each in within.items():
        print(f"| {name} | {len(each)} | {sum(each)} |")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:3] or ("0", str(_DAMS))))
