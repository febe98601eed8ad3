"""Figures of a report: as SVG, with the captions that say what is in them."""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import TYPE_CHECKING

from heeltoe.views.content.subject import NAMES
from heeltoe.views.content.tree import FigureBlock

if TYPE_CHECKING:
    from matplotlib.figure import Figure


CAPTIONS = {
    "summary": "The dam, its crack and its water; what shakes it, and how far the part above the crack slips.",
    "section": "Section of the dam with its crack, water levels and the pressure in the crack.",
    "law": "The friction law of the crack: its strength over its normal stress.",
    "comparison": "Both models side by side, shaken by the same ground motion.",
    "response": "Ground acceleration, slip (positive downstream), rotation and openings if there are any, the mode.",
    "slip-by-mode": "Slip gathered in each mode of motion.",
    "friction": "Friction in the crack, what its law could bear at the moment, slip, and the way slipped to and fro.",
    "asperities": "How far the rough crack dilates as it slips, and the angle that wear leaves its flanks.",
    "accelerations": "Acceleration of the ground, acceleration of the slip, and the forces at heel and toe.",
    "forces": "Forces across the crack.",
    "crest": "How the crest moves: its displacement relative to the ground, and its acceleration with that of the "
    "ground.",
    "energy": "Where the energy put in by the earthquake goes.",
    "path": "Path of the part above the crack.",
    "motion": "The ground motion, as used: acceleration, velocity, displacement.",
    "spectrum": "Response spectrum of the ground motion, 5 % of critical damping.",
    "crack-level": "Acceleration of ground and crack, their response spectra, and the amplification; dotted: periods.",
    "joints": "How much of each joint is cracked over time, by its height; white: whole, black: cracked through.",
    "joint": "Where the bond of the joint is intact, softens and is broken, over time; above, how far it is cracked.",
    "crack": "What each place of the crack does over time.",
    "deformed": "Deformed dam with its principal stresses, tension on the left, compression on the right.",
    "tension": "Largest principal tension over the run at every place, and the largest of all.",
    "pressure": "Contact pressure along the crack over time.",
    "water-pressure": "Pressure of the water on the face: at rest, its range over the run, and at two moments.",
    "mesh": "The mesh, and the nodes of the crack.",
    "modes": "Lowest vibration modes of the intact dam.",
}
# Simple figures need not be as wide as the page.
_SHARES = {
    "section": 0.7,
    "law": 0.7,
    "tension": 0.62,
    "spectrum": 0.6,
    "slip-by-mode": 0.8,
    "friction": 0.9,
    "asperities": 0.9,
    "energy": 0.75,
    "mesh": 0.36,
    "deformed": 0.78,
}
_SHARES |= {"bands": 0.8, "slips": 0.8, "fragility": 0.8}
# Histories are drawn lower than on a page of their own, so that two of them share one, or one and a table; letters stay
# as large as they are.
_LOWER = {
    "comparison": 0.64,
    "response": 0.75,
    "accelerations": 0.75,
    "forces": 0.9,
    "crack-level": 0.75,
    "crest": 0.55,
}
_LOWER |= {"crack": 0.7, "joint": 0.7, "pressure": 0.75, "water-pressure": 0.9}
_LEAST_HEIGHT = 4.0
# What belongs to the words around it does not wait for another page.
_HELD = ("summary",)
# Flatter ones have panels side by side, with no room to spare.
_FLAT = 0.47
# Of two models only so many figures, those of the one beside after its name: those of one alone are in its own report.
_OF_BOTH = (
    *(
        "summary",
        "section",
        "motion",
        "comparison",
        "crest",
        "energy",
        "spectrum",
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


def drawings(figures: Mapping[str, Figure]) -> dict[str, FigureBlock]:
    """Return the figures of a result that a report shows, by name: ``decoupled/crack-level`` of the one beside.

    They lose their headings, and some are made lower: what is to be written as a file is to be written before.
    """
    if "comparison" not in figures:
        return {name: drawing(name, figures[name], caption(name)) for name in figures}
    shared = ("summary", "section", "law", "motion", "comparison")
    captions = {name: caption(name if "/" in name or name in shared else f"flexible/{name}") for name in _OF_BOTH}
    return {name: drawing(name, figures[name], captions[name]) for name in figures if name in _OF_BOTH}


def caption(name: str) -> str:
    """Return what a figure shows; unknown ones are called by their name."""
    model, slash, own = name.rpartition("/")
    if model.startswith("crack-"):
        model = f"crack {model.removeprefix('crack-')} from the crest down"
    text = CAPTIONS.get(own, f"{own.replace('-', ' ').replace('_', ' ').capitalize()}.")
    return (
        f"{NAMES.get(model, model).capitalize()}. {text}"
        if slash and own not in ("spectrum", "mesh", "modes")
        else text
    )


def drawing(name: str, figure: Figure, text: str) -> FigureBlock:
    """Return a figure with its caption; it loses its heading."""
    import matplotlib as mpl

    from heeltoe.views.figures.style import laid_out, without_heading

    own = name.rpartition("/")[2]
    without_heading(figure)
    width, height = figure.get_size_inches()
    if own in _LOWER and height > _LEAST_HEIGHT:
        height = max(_LEAST_HEIGHT, _LOWER[own] * height)
        figure.set_size_inches(width, height)
    file = io.BytesIO()
    # Letters as outlines look the same wherever the report is read.
    with laid_out(figure), mpl.rc_context({"svg.fonttype": "path", "svg.hashsalt": "heeltoe"}):
        figure.savefig(file, format="svg", metadata={"Date": None})
    share = _SHARES.get(own, 1.0) if height > _FLAT * width else 1.0
    return FigureBlock(name, text, file.getvalue(), (float(width), float(height)), share, own in _HELD)
