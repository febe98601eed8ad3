"""How much stronger a crack at a height is shaken.

Response spectra of the ground and of the crack of Koyna Dam, by the decoupled chain.
"""

from pathlib import Path

from matplotlib.figure import Figure

import heeltoe

EXAMPLES = Path(__file__).parents[1]


def picture() -> Figure:
    """Run the chain and draw how the crack moves."""
    case = heeltoe.read_case(EXAMPLES / "koyna.toml", ["flexible.elements_across=4", "motion.duration=15s"])
    return heeltoe.decoupled(case).plot("crack-level")


if __name__ == "__main__":
    picture().savefig("crack_level.png")
