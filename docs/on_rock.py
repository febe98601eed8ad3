"""Print the table of docs/water-and-rock.md: what rock and water with waves change in the slip of the typical dam.

python docs/on_rock.py
"""

from __future__ import annotations

from pathlib import Path

import heeltoe

EXAMPLE = Path(__file__).parents[1] / "examples/typical-base.toml"
SOUND, ROCK = ["reservoir.compressible=true"], ["rock.modulus=20 GPa"]
DAMS = {
    "rigid | a mass": [],
    "rigid | with sound": SOUND,
    "20 GPa | a mass": ROCK,
    "20 GPa | with sound": [*SOUND, *ROCK],
    "60 GPa | with sound": [*SOUND, "rock.modulus=60 GPa"],
    "20 GPa, massless | a mass": [*ROCK, "rock.massless=true"],
}


def main() -> None:
    """Run the dams and print a row for each."""
    print("| rock | water | residual slip, mm | left in the rock, MJ/m | left with the water, MJ/m |")
    print("| --- | --- | --- | --- | --- |")
    for name, changes in DAMS.items():
        case = heeltoe.read_case(EXAMPLE, ["flexible.evidence=none", "motion.sign=recorded", *changes])
        response = heeltoe.flexible(case)
        energy = response.energy
        water = energy.floor_j + energy.far_end_j
        print(f"| {name} | {1e3 * response.residual_slip_m:.0f} | {energy.rock_j / 1e6:.2f} | {water / 1e6:.2f} |")


if __name__ == "__main__":
    main()
