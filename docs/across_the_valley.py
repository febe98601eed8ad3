"""Print the tables of docs/cross-valley.md: what the shaking across the valley adds to the slip of made rigid dams.

python docs/across_the_valley.py [FIRST] [END]    # dams FIRST to END of 100; all without, some minutes on one core
"""

from __future__ import annotations

import sys
from itertools import pairwise

import numpy as np
from scipy.stats import qmc

import heeltoe

# Dams, each under a pair of its own: the first ones made, the last ones El Centro in both assignments and signs.
_DAMS, _SEED, _MADE = 100, 52, 80
_RECORDS = ("elcentro-1940-270-nga", "elcentro-1940-180-nga")
# Height [m], width over height, depth over height, friction, peak [g].
_LEAST = (30.0, 0.8, 0.5, 0.5, 0.2)
_MOST = (150.0, 1.1, 0.9, 0.9, 0.5)
# Least slip along the stream alone that counts [m].
_LEAST_SLIP = 1e-3
# Classes of dams: the number of `_LEAST` that they are by, and its bounds.
_CLASSES = {
    "depth / height": (2, (0.5, 0.7, 0.9)),
    "friction": (3, (0.5, 0.7, 0.9)),
    "peak, g": (4, (0.2, 0.3, 0.4, 0.5)),
}


def is_recorded(number: int) -> bool:
    """Whether the motion of a dam is a record."""
    return number >= _MADE


def dam(number: int, values: np.ndarray) -> heeltoe.Case:
    """Return a dam that is shaken along the stream and across the valley, both by one factor."""
    height, width, depth, friction, peak = values
    made = f"synthetic:M{6.0 + 0.5 * (number % 4):g},{10 + 10 * (number % 3)}km,seed="
    along, across = f"{made}{2 * number + 1}", f"{made}{2 * number + 2}"
    if is_recorded(number):
        along, across = _RECORDS if number % 2 else _RECORDS[::-1]
    return heeltoe.read_case(
        {
            "section": {
                "height": f"{height:.4g} m",
                "crest_width": f"{0.08 * height:.4g} m",
                "base_width": f"{width * height:.4g} m",
            },
            "crack": {"friction": float(f"{friction:.4g}")},
            "reservoir": {"depth": f"{depth * height:.4g} m"},
            "motion": {
                "file": along,
                "pga": f"{peak:.4g} g",
                "sign": "reversed" if number % 4 > 1 else "recorded",
                "cross_valley": {"file": across},
            },
        }
    )


def main(first: int, end: int) -> None:
    """Run dams with and without the shaking across the valley, and print how many times as far they slide with it."""
    drawn = qmc.scale(qmc.LatinHypercube(5, rng=_SEED).random(_DAMS), _LEAST, _MOST)[first:end]
    ratios = np.full(len(drawn), np.nan)
    lifts, ended = 0, 0
    for place, values in enumerate(drawn):
        response = heeltoe.run(dam(first + place, values), "rigid")
        lifts += response.ok and max(response.rocking_upstream_rad, response.rocking_downstream_rad) > 0.0
        ended += not response.ok
        across = response.cross_valley
        without = across.without_cross_valley if response.ok and across is not None else None
        # A dam that hardly slides has no ratio.
        if without is not None and without.factor is not None and abs(without.residual_slip_m or 0.0) > _LEAST_SLIP:
            ratios[place] = without.factor
        print(f"{first + place}: {response.outcome}, {ratios[place]:.3f}", file=sys.stderr, flush=True)
    print("| dams | number | slide less far, % | 16 % | 25 % | median | 75 % | 84 % | most |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    recorded = np.array([is_recorded(first + place) for place in range(len(drawn))])
    print_row("all", ratios)
    print_row("made motions", ratios[~recorded])
    print_row("El Centro", ratios[recorded])
    for name, (column, bounds) in _CLASSES.items():
        for low, high in pairwise(bounds):
            print_row(f"{name} {low:g} to {high:g}", ratios[(drawn[:, column] >= low) & (drawn[:, column] <= high)])
    few = len(drawn) - ended - np.isfinite(ratios).sum()
    print(f"\n{lifts} lift, {few} slide less than 1 mm, {ended} have no result.")


def print_row(name: str, ratios: np.ndarray) -> None:
    """Print share and fractiles of a class."""
    known = ratios[np.isfinite(ratios)]
    if known.size:
        fractiles = " | ".join(f"{x:.2f}" for x in np.quantile(known, (0.16, 0.25, 0.5, 0.75, 0.84, 1.0)))
        print(f"| {name} | {known.size} | {100 * np.mean(known < 1.0):.0f} | {fractiles} |")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 0, int(sys.argv[2]) if len(sys.argv) > 2 else _DAMS)
