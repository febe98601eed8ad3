"""Make the figures of the documentation from the examples: `python -m docs.make_figures`, at the root."""

from pathlib import Path
from tempfile import TemporaryDirectory

from matplotlib import rc_context
from matplotlib.figure import Figure
from PIL import Image, ImageSequence

from heeltoe import animate, decoupled, read_case, rigid, run
from heeltoe.study.small.overturning import overturning_map
from heeltoe.study.small.run_table import parse_axes, run_small
from heeltoe.views.figures.crack_level import crack_level_figure
from heeltoe.views.figures.histories import response_figure
from heeltoe.views.figures.runs import overturning_figure, slips_figure
from heeltoe.views.figures.style import STYLE
from heeltoe.views.figures.write import save
from validation.blocks.joints import BEAM_ENERGY, FIRST_PART, MEASURED, TAKEN_ENERGY, bend_beam

HERE = Path(__file__).parent
EXAMPLES = HERE.parent / "examples"


def koyna_top() -> Figure:
    """Return the picture of the README."""
    return response_figure(rigid(read_case(EXAMPLES / "koyna-top.toml", ["motion.pga=1g", "motion.duration=15s"])))


def real_cracks() -> Figure:
    """Return the slip of the typical dam's block with different friction."""
    laws = {
        "constant 1.2": {"crack.friction": 1.2},
        "constant 0.8": {"crack.friction": 0.8},
        "1.2, worn to 0.8 in 20 mm": {
            "crack.law": {"name": "slip weakening", "peak_friction": 1.2, "residual_friction": 0.8, "slip": "20 mm"}
        },
        "1.2, worn to 0.8 in 500 mm": {
            "crack.law": {"name": "slip weakening", "peak_friction": 1.2, "residual_friction": 0.8, "slip": "500 mm"}
        },
        "Barton-Bandis, JRC 10": {
            "crack.law": {"name": "barton-bandis", "jrc": 10, "jcs": "20 MPa", "residual_angle": "32 deg"}
        },
    }
    with rc_context(STYLE):
        figure = Figure(figsize=(7.0, 4.0), layout="constrained")
        axes = figure.subplots()
        for (name, law), dash in zip(laws.items(), ("-", "-", "--", ":", "-."), strict=True):
            histories = rigid(read_case(EXAMPLES / "typical-base.toml", law)).histories
            axes.plot(histories["time_s"], 1e3 * histories["slip_m"], linestyle=dash, linewidth=1.5, label=name)
        axes.set_xlabel("time [s]")
        axes.set_ylabel("slip of the block [mm]")
        axes.legend(loc="upper left")
    return figure


def measured_beam() -> Figure:
    """Return the notched beam of a test, beside the band that was measured."""
    mouth, least, most = zip(*MEASURED, strict=True)
    part = f"two lines, {100 * FIRST_PART:g} % in the first"
    curves = (
        (BEAM_ENERGY, 1.0, "--", f"{BEAM_ENERGY:g} J/m², one line"),
        (BEAM_ENERGY, FIRST_PART, "-", f"{BEAM_ENERGY:g} J/m², {part}"),
        (TAKEN_ENERGY, FIRST_PART, "-.", f"{TAKEN_ENERGY:g} J/m², as the beam took; {part}"),
    )
    with rc_context(STYLE):
        figure = Figure(figsize=(7.0, 4.0), layout="constrained")
        axes = figure.subplots()
        axes.fill_between(
            (0.0, *mouth), (0.0, *least), (0.0, *most), color="0.8", label="measured, cycles from below to above"
        )
        for energy, first, dash, name in curves:
            opening, force = bend_beam(energy, first)
            axes.plot(opening, force, linestyle=dash, linewidth=1.5, label=name)
        axes.set_xlim(0.0, 0.2)
        axes.set_ylim(bottom=0.0)
        axes.set_xlabel("mouth opening [mm]")
        axes.set_ylabel("force [N]")
        figure.legend(loc="outside lower center", ncols=2)
    return figure


def moving_dam(place: Path) -> None:
    """Write the moving picture of the README: the elastic typical dam, small enough for a page."""
    changes = ["flexible.evidence=none", "motion.duration=8s"]
    case = read_case(EXAMPLES / "typical-base.toml", changes)
    with TemporaryDirectory() as folder:
        whole = Path(folder) / "dam.gif"
        animate(case, run(case, "flexible"), whole, frames_per_second=3.0, speed=0.5, window=(1.5, 6.0))
        with Image.open(whole) as film:
            pictures = [
                frame.convert("RGB").resize((640, 360), Image.Resampling.LANCZOS).quantize(16, dither=Image.Dither.NONE)
                for frame in ImageSequence.Iterator(film)
            ]
    pictures[0].save(place, save_all=True, append_images=pictures[1:], duration=333, loop=0, optimize=True)


if __name__ == "__main__":
    moving_dam(HERE / "typical-base.gif")
    varied = parse_axes(["crack.friction=0.8,1.0,1.2", "uplift.pattern=uniform,triangular"])
    grid = run_small(EXAMPLES / "koyna.toml", [], varied, decoupled)
    save(koyna_top(), HERE / "koyna-top.png", dpi=110)
    save(crack_level_figure(grid.responses[0]), HERE / "koyna-crack-level.png", dpi=110)
    save(slips_figure(grid), HERE / "koyna-slips.png", dpi=110)
    save(real_cracks(), HERE / "real-cracks.png", dpi=110)
    pulses = overturning_map(read_case(EXAMPLES / "slender.toml"), count=100)
    save(overturning_figure(pulses), HERE / "overturning.png", dpi=110)
    save(measured_beam(), HERE / "measured-beam.png", dpi=110)
