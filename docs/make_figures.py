"""Make the figures of the documentation from the examples; run from anywhere."""

from pathlib import Path

import matplotlib as mpl

from heeltoe import read_case, rigid
from heeltoe.figures import STYLE, response_figure

HERE = Path(__file__).parent

if __name__ == "__main__":
    case = read_case(HERE.parent / "examples" / "koyna-top.toml", ["motion.pga=1g", "motion.duration=15s"])
    with mpl.rc_context(STYLE):
        figure = response_figure(rigid(case))
        figure.savefig(HERE / "koyna-top.png", dpi=110)
