"""Writing figures to files."""

from __future__ import annotations

import gc
from collections.abc import Callable, Mapping
from pathlib import Path

import matplotlib as mpl
from matplotlib.figure import Figure

from heeltoe.views.figures.compile import can_compile, pictures
from heeltoe.views.figures.style import STYLE, laid_out

#: Resolution of a picture, in pixels for each inch.
DPI = 150.0


def save_all(
    figures: Mapping[str, Figure], directory: Path, finish: Callable[[str, Figure], object] | None = None
) -> list[Path]:
    """Write figures by their names as PNG and SVG and return the paths. Each is drawn once, as SVG, of which typst
    makes the picture; without typst it is drawn again. `finish` gets each that is written, and may change it."""
    twice = not can_compile()
    written, drawings = [], []
    for name, figure in figures.items():
        picture, drawing = directory / f"{name}.png", directory / f"{name}.svg"
        drawing.parent.mkdir(exist_ok=True)
        with laid_out(figure):
            save(figure, drawing)
            if twice:
                save(figure, picture)
        if finish is not None:
            finish(name, figure)
            # Where it is kept no longer, it goes at once: its parts refer to each other.
            del figure
            gc.collect(1)
        drawings.append(drawing)
        written += [picture, drawing]
    if drawings and not twice:
        for drawing, content in zip(drawings, pictures(drawings, DPI), strict=True):
            drawing.with_suffix(".png").write_bytes(content)
    return written


def save(figure: Figure, path: Path, dpi: float = DPI) -> None:
    """Write one figure; the ending of the path says the format."""
    # Without its date the same figure makes the same file; images packed harder are 2 % smaller and take 12 % longer.
    options = {"metadata": {"Date": None}} if path.suffix == ".svg" else {"pil_kwargs": {"compress_level": 3}}
    with mpl.rc_context(STYLE):
        figure.savefig(path, dpi=dpi, **options)
