"""Print the tables of docs/validation/rigid-rock.md: effects of rock and sound on the slip of made dams.

python docs/rigid_rock.py [FIRST] [END]    # dams FIRST to END of 100; all without, ten minutes on one core
"""

from __future__ import annotations

import sys
from itertools import pairwise

import numpy as np
from scipy.stats import qmc

import heeltoe

# Dams, each under a motion of its own: of fifty the first ones made, the last ones a record.
_DAMS, _SEED, _MADE = 100, 31, 28
_RECORDS = ("elcentro-1940-270-nga", "elcentro-1940-180-nga")
# Height [m], width over height, modulus [GPa], that of the rock over it, depth over height, friction, peak [g].
_LEAST = (30.0, 0.7, 15.0, 0.3, 0.6, 0.7, 0.3)
_MOST = (150.0, 0.9, 35.0, 3.0, 1.0, 1.1, 0.6)
# Least slip without rock and sound that counts [m].
_LEAST_SLIP = 1e-3
# Classes of dams: the number of `_LEAST` that they are by, and its bounds.
_CLASSES = {
    "height, m": (0, (30.0, 70.0, 110.0, 150.0)),
    "friction": (5, (0.7, 0.85, 1.0, 1.1)),
    "rock / concrete": (3, (0.3, 1.0, 2.0, 3.0)),
    "depth / height": (4, (0.6, 0.8, 1.0)),
    "peak, g": (6, (0.3, 0.4, 0.5, 0.6)),
}


def is_recorded(number: int) -> bool:
    """Whether the motion of a dam is a record."""
    return number % (_DAMS // 2) >= _MADE


def dam(number: int, values: np.ndarray) -> heeltoe.Case:
    """Return a dam on rigid rock before water without sound."""
    height, width, modulus, _, depth, friction, peak = values
    motion = {"file": f"synthetic:M{6.0 + 0.5 * (number % 4):g},{10 + 10 * (number % 3)}km,seed={number + 1}"}
    if is_recorded(number):
        motion = {"file": _RECORDS[number % 2], "duration": "25 s"}
    return heeltoe.read_case(
        {
            "section": {
                "height": f"{height:.4g} m",
                "crest_width": f"{0.08 * height:.4g} m",
                "base_width": f"{width * height:.4g} m",
            },
            "concrete": {"modulus": f"{modulus:.4g} GPa"},
            "crack": {"friction": float(f"{friction:.4g}")},
            "rock": "rigid",
            "reservoir": {"depth": f"{depth * height:.4g} m", "compressible": False},
            "uplift": {"pattern": "triangular" if is_recorded(number) and number % 4 < 2 else "none"},
            "motion": motion | {"pga": f"{peak:.4g} g", "sign": "recorded"},
            # A coarse mesh with few modes: single slips change by some per cent, and their ratio by less.
            "flexible": {"evidence": "none", "elements_across": 4, "modes": 20},
            "analysis": {"silence": "0 s"},
        }
    )


def main(first: int, end: int) -> None:
    """Run dams without and with rock and sound, and print how many times as far they slide with both, by class."""
    drawn = qmc.scale(qmc.LatinHypercube(7, rng=_SEED).random(_DAMS), _LEAST, _MOST)[first:end]
    ratios = np.empty(len(drawn))
    for place, values in enumerate(drawn):
        case = dam(first + place, values)
        both = case.with_("reservoir.compressible=true", f"rock.modulus={values[3] * values[2]:.4g} GPa")
        runs = [heeltoe.flexible(one) for one in (case, both)]
        without, with_both = (run.residual_slip_m if run.ok else np.nan for run in runs)
        # A dam that hardly slides has no ratio.
        ratios[place] = with_both / without if without > _LEAST_SLIP else np.nan
        print(f"{first + place}: {without:.4f} m, {with_both:.4f} m", file=sys.stderr, flush=True)
    print("| dams | number | slide less far, % | 16 % | 25 % | median | 75 % | 84 % | most |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    recorded = np.array([is_recorded(first + place) for place in range(len(drawn))])
    print_row("all", ratios)
    print_row("made motions", ratios[~recorded])
    print_row("El Centro", ratios[recorded])
    for name, (column, bounds) in _CLASSES.items():
        for low, high in pairwise(bounds):
            own = ratios[(drawn[:, column] >= low) & (drawn[:, column] <= high)]
            print_row(f"{name} {low:g} to {high:g}", own)


def print_row(name: str, ratios: np.ndarray) -> None:
    """Print share and fractiles of a class."""
    known = ratios[np.isfinite(ratios)]
    if known.size:
        fractiles = " | ".join(f"{x:.2f}" for x in np.quantile(known, (0.16, 0.25, 0.5, 0.75, 0.84, 1.0)))
        print(f"| {name} | {known.size} | {100 * np.mean(known < 1.0):.0f} | {fractiles} |")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 0, int(sys.argv[2]) if len(sys.argv) > 2 else _DAMS)
