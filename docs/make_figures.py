"""Make the figures of the documentation from the examples; run from anywhere."""

from pathlib import Path

import matplotlib as mpl

from heeltoe import decoupled, read_case, rigid
from heeltoe.decoupled_figures import crack_level_figure, slips_figure
from heeltoe.figures import STYLE, response_figure
from heeltoe.variations import parse_variations, run_grid

HERE = Path(__file__).parent
EXAMPLES = HERE.parent / "examples"

if __name__ == "__main__":
    case = read_case(EXAMPLES / "koyna-top.toml", ["motion.pga=1g", "motion.duration=15s"])
    varied = parse_variations(["crack.friction=0.8,1.0,1.2", "uplift.pattern=uniform,triangular"])
    grid = run_grid(EXAMPLES / "koyna.toml", [], varied, decoupled)
    with mpl.rc_context(STYLE):
        response_figure(rigid(case)).savefig(HERE / "koyna-top.png", dpi=110)
        crack_level_figure(grid.responses[0]).savefig(HERE / "koyna-crack-level.png", dpi=110)
        slips_figure(grid).savefig(HERE / "koyna-slips.png", dpi=110)
