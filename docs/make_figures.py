"""Make the figures of the documentation from the examples; run from anywhere."""

from pathlib import Path

from heeltoe import read_case, rigid
from heeltoe.figures import response_figure, save

HERE = Path(__file__).parent

if __name__ == "__main__":
    case = read_case(HERE.parent / "examples" / "koyna-top.toml", ["motion.pga=1g", "motion.duration=15s"])
    save(response_figure(rigid(case)), HERE / "koyna-top.png", dpi=110)
