"""Where the energy goes.

The ledger of the same block over time: what the earthquake puts in, and what friction and impacts take out.
What is left of the balance is rounding.
"""

from pathlib import Path

from matplotlib.figure import Figure

import heeltoe

EXAMPLES = Path(__file__).parents[1]


def picture() -> Figure:
    """Run the block and draw its ledger."""
    case = heeltoe.read_case(EXAMPLES / "koyna-top.toml", ["motion.pga=1g", "motion.duration=15s"])
    return heeltoe.rigid(case).plot("energy")


if __name__ == "__main__":
    picture().savefig("energy.png")
