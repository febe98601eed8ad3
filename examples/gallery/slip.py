"""A block that slides and rocks.

The part of Koyna Dam above its crack, under El Centro scaled to 1 g, as a rigid block: slip, rotation,
openings and modes of motion over time.
"""

from pathlib import Path

from matplotlib.figure import Figure

import heeltoe

EXAMPLES = Path(__file__).parents[1]


def picture() -> Figure:
    """Run the block and draw what it does."""
    case = heeltoe.read_case(EXAMPLES / "koyna-top.toml", ["motion.pga=1g", "motion.duration=15s"])
    return heeltoe.rigid(case).plot()


if __name__ == "__main__":
    picture().savefig("slip.png")
