"""Make the figures of the documentation from the examples; run from anywhere."""

from pathlib import Path

from matplotlib.figure import Figure

from heeltoe import decoupled, read_case, rigid
from heeltoe.study.overturning import overturning_map
from heeltoe.study.small import parse_axes, run_small
from heeltoe.views.figures.crack_level import crack_level_figure
from heeltoe.views.figures.histories import response_figure
from heeltoe.views.figures.overturning import overturning_figure
from heeltoe.views.figures.runs import slips_figure
from heeltoe.views.figures.write import save

HERE = Path(__file__).parent
EXAMPLES = HERE.parent / "examples"


def koyna_top() -> Figure:
    """Return the picture of the README."""
    return response_figure(rigid(read_case(EXAMPLES / "koyna-top.toml", ["motion.pga=1g", "motion.duration=15s"])))


if __name__ == "__main__":
    varied = parse_axes(["crack.friction=0.8,1.0,1.2", "uplift.pattern=uniform,triangular"])
    grid = run_small(EXAMPLES / "koyna.toml", [], varied, decoupled)
    save(koyna_top(), HERE / "koyna-top.png", dpi=110)
    save(crack_level_figure(grid.responses[0]), HERE / "koyna-crack-level.png", dpi=110)
    save(slips_figure(grid), HERE / "koyna-slips.png", dpi=110)
    pulses = overturning_map(read_case(EXAMPLES / "slender.toml"), count=100)
    save(overturning_figure(pulses), HERE / "overturning.png", dpi=110)
