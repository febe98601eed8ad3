"""Which pulses overturn a block.

A slender block in sine pulses of many frequencies and amplitudes. Between those that overturn it after an
impact and those that do so at once lies a gap in which it stands.
"""

from pathlib import Path

from matplotlib.figure import Figure

import heeltoe

EXAMPLES = Path(__file__).parents[1]


def picture() -> Figure:
    """Run the pulses and draw the map."""
    return heeltoe.overturning_map(heeltoe.read_case(EXAMPLES / "slender.toml"), count=60).plot()


if __name__ == "__main__":
    picture().savefig("overturning.png")
