"""Print the table of docs/water-and-rock.md of how well rock in few unknowns answers.

python docs/rock_error.py
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from heeltoe.base.blas import one_blas_thread
from heeltoe.models.flexible.surroundings.reduction import sizes
from heeltoe.models.flexible.surroundings.rock import RockMaterial, full_rock, reduced_rock, smooth_tractions

# The base of the typical dam, and the rock that is assumed below it.
X = np.linspace(-40.0, 40.0, 17)
BASE = np.column_stack([X, np.zeros(X.size)])
ROCK = RockMaterial(20e9, 0.25, 2650.0, damping=0.02)
#: Rock, highest frequency [Hz], and reach in half widths of the base.
ROCKS = {
    "20 GPa": (ROCK, 15.0, 100.0),
    "10 GPa": (replace(ROCK, modulus=10e9), 15.0, 100.0),
    "20 GPa, 1.5 times as large": (ROCK, 22.5, 150.0),
}
LOWEST, COUNT = 0.2, 30


@one_blas_thread()
def main() -> None:
    """Print a row for each rock."""
    print("| rock | Hz | unknowns of all elements | few | error stated, % | error from 0.2 Hz up, % | at, Hz |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    tractions = smooth_tractions(BASE)
    for name, (material, highest, extent) in ROCKS.items():
        full = full_rock(BASE, material, highest=highest, extent=extent)
        few = reduced_rock(BASE, material, highest=highest, extent=extent)
        forces = np.zeros((full.mass.shape[0], tractions.shape[1]))
        forces[full.base] = tractions
        found = []
        for frequency in np.geomspace(LOWEST, highest, COUNT):
            omega = 2.0 * np.pi * float(frequency)
            exact = tractions.T @ full.body.response(1j * omega, forces)[full.base]
            off = np.abs(tractions.T @ few.compliance(omega, tractions) - exact)
            found.append((float(np.max(off / np.outer(sizes(exact), sizes(exact)))), float(frequency)))
        error, worst = max(found)
        counts = f"{highest:g} | {full.mass.shape[0]} | {few.omega_squared.size}"
        print(f"| {name} | {counts} | {100.0 * few.error:.2f} | {100.0 * error:.2f} | {worst:.1f} |")


if __name__ == "__main__":
    main()
