"""Static checks beside what is required.

Each check of each load case over what the criteria ask for.
"""

from pathlib import Path

from matplotlib.figure import Figure

import heeltoe

EXAMPLES = Path(__file__).parents[1]


def picture() -> Figure:
    """Run the block for its slip, check the dam that is left, and draw the checks."""
    case = heeltoe.read_case(EXAMPLES / "typical-base.toml", "statics.seismic_coefficient=0.1")
    return heeltoe.statics(case, heeltoe.rigid(case).residual_slip_m).plot()


if __name__ == "__main__":
    picture().savefig("checks.png")
