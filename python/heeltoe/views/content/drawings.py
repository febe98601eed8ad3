"""Figures of a report: as SVG, with the captions that say what is in them."""

from __future__ import annotations

import io
from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from heeltoe.views.content.tree import Beside, Block, FigureBlock, glued
from heeltoe.views.words.response import NAMES, OF_CRACKS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from heeltoe.views.figures.all import Figures

CAPTIONS = {
    "summary": "The dam, its crack and its water; the ground motion, and the slip of the part above the crack.",
    "section": "Section of the dam with its crack, water levels and the pressure in the crack.",
    "law": "The friction law of the crack: its strength over its normal stress.",
    "comparison": "Both models side by side, shaken by the same ground motion; slip positive downstream, rotation "
    "about the heel.",
    "response": "Acceleration of the ground, slip, positive downstream, and what the part above the crack does; "
    "rotation positive about the heel.",
    "slip-by-mode": "Slip gathered in each mode of motion.",
    "plan": "Path of the slip in the plan of the crack: downstream to the right, to the left bank upwards.",
    "friction": "Friction in the crack, what its law could bear at the moment, slip, and the way slipped to and fro.",
    "asperities": "How far the rough crack dilates as it slips, and the angle that wear leaves its flanks.",
    "accelerations": "Acceleration of the ground, acceleration of the slip, and the forces at heel and toe.",
    "forces": "Forces across the crack.",
    "bearing": "Normal stress at heel and toe, straight over the crack as in static checks; where it is negative, "
    "the crack does not bear over all its width.",
    "anchors": "Forces that the anchors bear, tension and resistance to slip together, and their capacity.",
    "crest": "How the crest moves: its displacement relative to the ground, positive downstream, and its "
    "acceleration with that of the ground.",
    "energy": "Where the energy put in by the earthquake goes.",
    "path": "Path of the part above the crack.",
    "motion": "The ground motion, as used: acceleration, velocity, displacement.",
    "spectrum": "Response spectrum of the ground motion, 5 % of critical damping.",
    "scatter": "How far single runs slide, the shaking scaled by 0.99 to 1.01.",
    "crack-level": "Acceleration of ground and crack, their response spectra, and the amplification; dotted: periods.",
    "joints": "How much of each joint is cracked over time, by its height; white: whole, black: cracked through.",
    "joint": "Where the bond of the joint is intact, softens and is broken, over time; above, how far it is cracked.",
    "crack": "Each place of the crack over time.",
    "deformed": "Deformed dam with its principal stresses, tension on the left, compression on the right.",
    "tension": "Largest principal tension over the run at every place, and the largest of all.",
    "pressure": "Contact pressure along the crack over time.",
    "water-pressure": "Pressure of the water on the face: at rest, its range over the run, and at the largest push.",
    "mesh": "The mesh, and the nodes of the crack.",
    "modes": "Lowest vibration modes of the intact dam.",
}
# Simple figures need not be as wide as the page; those of a pair stand side by side.
_SHARES = {
    "law": 0.7,
    "plan": 0.8,
    "slip-by-mode": 0.8,
    "friction": 0.9,
    "asperities": 0.9,
    "energy": 0.8,
    "bands": 0.8,
    "slips": 0.8,
    "fragility": 0.8,
    "motion": 0.6,
    "spectrum": 0.4,
    "scatter": 0.7,
    "deformed": 0.57,
    "tension": 0.43,
    "crack": 0.5,
    "pressure": 0.5,
    "mesh": 0.32,
    "modes": 0.68,
}
# In a report they have at most these heights [in], and tall ones a part of their own: lower than on a page of their
# own, so that several share one with words and tables; letters stay as large as they are.
_LOWER, _TALL = 0.8, 4.0
_HEIGHTS = {
    "asperities": 3.2,
    "friction": 3.6,
    "comparison": 5.2,
    "response": 4.8,
    "accelerations": 3.7,
    "forces": 4.2,
    "scatter": 2.5,
    "crack-level": 3.9,
    "crest": 2.9,
    "crack": 2.1,
    "bearing": 2.0,
    "anchors": 2.0,
    "joint": 3.1,
    "pressure": 2.1,
    "plan": 2.6,
    "slip-by-mode": 2.5,
    "path": 2.6,
    "energy": 2.3,
    "motion": 3.1,
    "spectrum": 3.1,
    "deformed": 3.5,
    "tension": 3.5,
    "mesh": 2.5,
    "modes": 2.5,
    "joints": 3.2,
    "water-pressure": 3.4,
}
_PANELS = 3
"""Of one component of a motion: acceleration, velocity, displacement."""
# They share a row where there are both.
_HALVES = ("bearing", "anchors")
# Shares of a row are one together, but for rounding.
_ROW = 1.01
# Of each of further cracks.
_OF_FURTHER = ("law", "response", "scatter", "joint", "crack")
# What belongs to the words around it does not wait for another page.
_HELD = ("summary",)
# Of two models only so many figures, those of the one beside after its name: those of one alone are in its own report.
_OF_BOTH = (
    *(
        "summary",
        "section",
        "motion",
        "comparison",
        "bearing",
        "anchors",
        "crest",
        "energy",
        "spectrum",
        "scatter",
        "joints",
        "joint",
        "crack",
        "pressure",
        "water-pressure",
        "deformed",
        "tension",
        "mesh",
        "modes",
    ),
    "decoupled/crack-level",
)


class DrawnAhead:
    """Figures of a result as a report shows them, each drawn as soon as its file is written, and then let go.

    Parameters
    ----------
    figures, cracks
        As of :func:`drawings`.
    """

    def __init__(self, figures: Figures, cracks: Mapping[str, str] | None = None) -> None:
        self.figures, self._looks = figures, _looks(figures, cracks)
        self.blocks: dict[str, FigureBlock] = {}

    def finish(self, name: str, figure: Figure) -> None:
        """Draw a figure that is written, if the report shows it."""
        if name in self._looks:
            self.blocks[name] = drawing(name, figure, *self._looks[name])
        self.figures.let_go(name)


def drawings(
    figures: Mapping[str, Figure],
    cracks: Mapping[str, str] | None = None,
    ahead: Mapping[str, FigureBlock] | None = None,
) -> dict[str, FigureBlock]:
    """Return the figures of a result that a report shows, by name: ``decoupled/crack-level`` of the one beside.

    They lose their headings, and some are made lower: what is to be written as a file is to be written before. `cracks`
    are names of several cracks by the prefix of their figures, empty for the one that leads; `ahead` are figures that
    were drawn before.
    """
    made = ahead or {}
    looks = _looks(figures, cracks)
    return {name: made[name] if name in made else drawing(name, figures[name], *look) for name, look in looks.items()}


def _looks(names: Collection[str], cracks: Mapping[str, str] | None) -> dict[str, tuple[str, float | None]]:
    """Return the captions of the figures that a report shows, by name, and which share of the page they take, None for
    their own."""
    called = cracks or {}
    halves = dict.fromkeys(_HALVES, 0.5) if set(_HALVES) <= set(names) else {}
    if "comparison" not in names:
        return {name: (caption(name, called), halves.get(name)) for name in names if _is_shown(name)}
    shared = ("summary", "section", "law", "motion", "comparison")
    captions = {name: caption(name if "/" in name or name in shared else f"flexible/{name}") for name in _OF_BOTH}
    return {name: (captions[name], halves.get(name)) for name in names if name in _OF_BOTH}


def in_rows(figures: Sequence[FigureBlock]) -> tuple[Block, ...]:
    """Return figures in rows, as many beside each other as have room, in their order."""
    lines: list[list[FigureBlock]] = []
    for figure in figures:
        if lines and sum(other.share for other in lines[-1]) + figure.share < _ROW:
            lines[-1].append(figure)
        else:
            lines.append([figure])
    return tuple(line[0] if len(line) == 1 else Beside(tuple(line)) for line in lines)


def _is_shown(name: str) -> bool:
    """Whether a report has a figure: of each further crack a few are enough, the others are files of their own."""
    return not ("/" in name and name.startswith("crack-")) or name.rpartition("/")[2] in _OF_FURTHER


def caption(name: str, cracks: Mapping[str, str] | None = None) -> str:
    """Return what a figure shows; unknown ones are called by their name, those of one of several cracks with its."""
    prefix, _, own = name.rpartition("/")
    text = CAPTIONS.get(own, f"{own.replace('-', ' ').replace('_', ' ').capitalize()}.")
    model = NAMES.get(prefix, prefix)
    if cracks and own in OF_CRACKS:
        model = cracks.get(prefix, model)
    return f"{model.capitalize()}. {text}" if model and own not in ("spectrum", "mesh", "modes") else text


def drawing(name: str, figure: Figure, text: str, share: float | None = None) -> FigureBlock:
    """Return a figure with its caption, as wide as a share of the page where one is given; it loses its heading."""
    import matplotlib as mpl

    from heeltoe.views.figures.style import STYLE, WIDTH, fit_words, laid_out, without_heading

    own = name.rpartition("/")[2]
    without_heading(figure)
    width, height = figure.get_size_inches()
    if figure.get_layout_engine() is not None:
        # Made as large as it is printed, it keeps the size of its letters.
        # Two components of a motion stand side by side in its figure, which has no room beside it.
        if share is None:
            share = 1.0 if own == "motion" and len(figure.axes) > _PANELS else _SHARES.get(own, 1.0)
        lower = _LOWER * height if height > _TALL else height
        width, height = share * WIDTH, min(lower, _HEIGHTS.get(own, height))
        figure.set_size_inches(width, height)
        with mpl.rc_context(STYLE):
            fit_words(figure)
    file = io.BytesIO()
    # Letters as outlines look the same wherever the report is read.
    with laid_out(figure), mpl.rc_context({"svg.fonttype": "path", "svg.hashsalt": "heeltoe"}):
        figure.savefig(file, format="svg", metadata={"Date": None})
    return FigureBlock(
        name, glued(text), file.getvalue(), (float(width), float(height)), float(width) / WIDTH, own in _HELD
    )
