"""The section with its forces.

What presses on the part above the crack before the earthquake: water, uplift and weight.
"""

from pathlib import Path

from matplotlib.figure import Figure

import heeltoe

EXAMPLES = Path(__file__).parents[1]


def picture() -> Figure:
    """Draw the typical dam."""
    return heeltoe.read_case(EXAMPLES / "typical-base.toml").plot()


if __name__ == "__main__":
    picture().savefig("section.png")
