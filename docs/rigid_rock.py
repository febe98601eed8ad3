"""Print the table of docs/rigid-rock.md: what rigid rock and water without sound leave out of the slip of made dams.

python docs/rigid_rock.py [COUNT]    # the first COUNT of 16 dams
"""

from __future__ import annotations

import sys

import numpy as np
from scipy.stats import qmc

import heeltoe

# Dams, each under a motion of its own.
_DAMS, _SEED = 16, 31
# Height [m], width over height, modulus [GPa], that of the rock over it, depth over height, friction, peak [g].
_LEAST = (30.0, 0.7, 15.0, 0.3, 0.6, 0.7, 0.3)
_MOST = (150.0, 0.9, 35.0, 3.0, 1.0, 1.1, 0.6)
_SOUND, _ROCK = "reservoir.compressible=true", "rock.modulus={:.4g} GPa"


def dam(number: int, values: np.ndarray) -> heeltoe.Case:
    """Return a dam on rigid rock before water without sound."""
    height, width, modulus, _, depth, friction, peak = values
    return heeltoe.read_case(
        {
            "section": {
                "height": f"{height:.4g} m",
                "crest_width": f"{0.08 * height:.4g} m",
                "base_width": f"{width * height:.4g} m",
            },
            "concrete": {"modulus": f"{modulus:.4g} GPa"},
            "crack": {"friction": float(f"{friction:.4g}")},
            "reservoir": {"depth": f"{depth * height:.4g} m"},
            "motion": {
                "file": f"synthetic:M{6.0 + 0.5 * (number % 4):g},{10 + 10 * (number % 3)}km,seed={number + 1}",
                "pga": f"{peak:.4g} g",
                "sign": "recorded",
            },
            "flexible": {"evidence": "none", "elements_across": 6},
        }
    )


def main(count: int) -> None:
    """Run the first dams four times each, and print a row for each."""
    print("| height, m | rock / concrete | without both, m | with sound, m | on elastic rock, m | with both, m |")
    print("| --- | --- | --- | --- | --- | --- |")
    drawn = qmc.scale(qmc.LatinHypercube(7, rng=_SEED).random(_DAMS), _LEAST, _MOST)
    for number, values in enumerate(drawn[:count]):
        case, rock = dam(number, values), _ROCK.format(values[3] * values[2])
        runs = [heeltoe.flexible(case.with_(*changes)) for changes in ((), (_SOUND,), (rock,), (_SOUND, rock))]
        slips = " | ".join(f"{run.residual_slip_m:.4f}" if run.ok else run.outcome for run in runs)
        print(f"| {values[0]:.0f} | {values[3]:.2f} | {slips} |", flush=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else _DAMS)
