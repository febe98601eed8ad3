"""The elastic dam at its worst moment.

Both parts of Koyna Dam deform, and the crack between them opens and slips; displacements are drawn many times
as far as they are.
"""

from pathlib import Path

from matplotlib.figure import Figure

import heeltoe

EXAMPLES = Path(__file__).parents[1]


def picture() -> Figure:
    """Run the elastic dam, coarse and short, and draw it."""
    changes = ["flexible.elements_across=4", "flexible.evidence=none", "motion.duration=8s"]
    return heeltoe.flexible(heeltoe.read_case(EXAMPLES / "koyna.toml", changes)).plot("deformed")


if __name__ == "__main__":
    picture().savefig("deformed.png")
