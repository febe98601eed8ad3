"""Print the tables of docs/water-and-rock.md: what rock and water with waves change in the slip of the typical dam, and
what an independent program says.

HEELTOE_RECORDS=DIRECTORY python docs/on_rock.py

The directory has the record "Taft Lincoln School, 1952, S69E" in Caltech's processing.
"""

from __future__ import annotations

from pathlib import Path

import heeltoe

EXAMPLE = Path(__file__).parents[1] / "examples/typical-base.toml"
EL_CENTRO: list[str] = []
TAFT = ['motion.file="taft-1952-s69e-caltech"', "crack.friction=1.2"]
# A rigid plane before water that is a mass, unless a dam has other fields behind these.
PLAIN = ["rock=rigid", "reservoir.compressible=false"]
SOUND, ROCK = ["reservoir.compressible=true"], ["rock.modulus=20 GPa"]
STIFF, UNDAMPED = ["rock.modulus=60 GPa"], ["rock.damping=0"]
MASSLESS = [*ROCK, "rock.massless=true"]
DAMS = {
    "rigid | a mass": [],
    "rigid | with sound": SOUND,
    "20 GPa | a mass": ROCK,
    "20 GPa | with sound": [*SOUND, *ROCK],
    "60 GPa | with sound": [*SOUND, *STIFF],
    "20 GPa, massless | a mass": MASSLESS,
}
# Of an independent program of full matrices, not converged to the last per cent [mm].
INDEPENDENT = {
    "El Centro, 1.0 | rigid | a mass": (EL_CENTRO, 600),
    "El Centro, 1.0 | rigid | with sound": ([*EL_CENTRO, *SOUND], 632),
    "El Centro, 1.0 | 20 GPa | a mass": ([*EL_CENTRO, *ROCK, *UNDAMPED], 716),
    "El Centro, 1.0 | 20 GPa | with sound": ([*EL_CENTRO, *SOUND, *ROCK, *UNDAMPED], 720),
    "Taft, 1.2 | rigid | a mass": (TAFT, 291),
    "Taft, 1.2 | rigid | with sound": ([*TAFT, *SOUND], 376),
    "Taft, 1.2 | 20 GPa | a mass": ([*TAFT, *ROCK, *UNDAMPED], 280),
    "Taft, 1.2 | 20 GPa | with sound": ([*TAFT, *SOUND, *ROCK, *UNDAMPED], 317),
    "Taft, 1.2 | 60 GPa | with sound": ([*TAFT, *SOUND, *STIFF, *UNDAMPED], 349),
    "Taft, 1.2 | 20 GPa, massless | a mass": ([*TAFT, *MASSLESS, *UNDAMPED], 2070),
}
# What should hardly matter, of the last of them.
HAIRS = {
    "as it is": [],
    "half the step": ["flexible.time_step=0.1 ms"],
    "twice the step": ["flexible.time_step=0.4 ms"],
    "half the elements": ["flexible.elements_across=4"],
    "twice the elements": ["flexible.elements_across=16"],
    "1 % less of a peak": ["motion.pga=0.396 g"],
    "1 % more of a peak": ["motion.pga=0.404 g"],
    "4 % of damping in the concrete, not 5": ["concrete.damping=0.04"],
    "no damping by the steps (theta 0.5)": ["flexible.theta=0.5"],
}


def run(changes: list[str]) -> heeltoe.Response:
    """Run the typical dam under the motion as recorded."""
    case = heeltoe.read_case(EXAMPLE, ["flexible.evidence=none", "motion.sign=recorded", *PLAIN, *changes])
    return heeltoe.flexible(case)


def main() -> None:
    """Run the dams and print a row for each."""
    print("| rock | water | residual slip, mm | left in the rock, MJ/m | left with the water, MJ/m |")
    print("| --- | --- | --- | --- | --- |")
    for name, changes in DAMS.items():
        response = run(changes)
        energy = response.energy
        water = energy.floor_j + energy.far_end_j
        print(f"| {name} | {1e3 * response.residual_slip_m:.0f} | {energy.rock_j / 1e6:.2f} | {water / 1e6:.2f} |")
    print("\n| motion, friction | rock | water | residual slip, mm | independent program, mm | difference, % |")
    print("| --- | --- | --- | --- | --- | --- |")
    for name, (changes, theirs) in INDEPENDENT.items():
        ours = 1e3 * run(changes).residual_slip_m
        print(f"| {name} | {ours:.0f} | {theirs} | {100.0 * (ours / theirs - 1.0):+.0f} |")
    print("\n| massless rock without damping, Taft | residual slip, m |")
    print("| --- | --- |")
    for name, changes in HAIRS.items():
        print(f"| {name} | {float(f'{abs(run([*TAFT, *MASSLESS, *UNDAMPED, *changes]).residual_slip_m):.2g}'):g} |")


if __name__ == "__main__":
    main()
