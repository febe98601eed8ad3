"""Limitations of an analysis, in words: each model, and the features that the table of combinations names."""

from __future__ import annotations

from heeltoe.case.combinations import unsupported_features
from heeltoe.views.content.subject import Subject
from heeltoe.views.content.tree import Block, Section, Strong, glued, paragraph

_ALL = (
    "The dam is a plane section of unit width: nothing passes between monoliths, and no abutment helps. The cracks are "
    "where the case puts them, and are cracked before the earthquake unless a bond is given; concrete elsewhere does "
    "not crack. The record is the motion of the ground at the base; what the site makes of it is in the record or "
    "nowhere."
)
_OF_MODEL = {
    "rigid": "The part above the crack is rigid: the dam does not vibrate, and what the part below does to the ground "
    "motion is left out. Elastic dams slide farther than their blocks.",
    "decoupled": "The part above the crack is rigid, and the motion of the part below is that without the crack: what "
    "the sliding part gives back is left out.",
    "flexible": "The parts are linear elastic, with small displacements and rotations; damping in the concrete is an "
    "assumption on which the slip may depend.",
}
_JUDGE = (
    "Judge for the dam at hand whether what is left out matters; the warnings on page one say where the program has "
    "reason to think that it does."
)


def limitations(subject: Subject) -> Section:
    """Return the section on limitations of the analysis."""
    blocks: list[Block] = [paragraph(Strong("All models. "), glued(_ALL))]
    for run in reversed(subject.runs):
        model = run.response.model
        absent = unsupported_features(model)
        cannot = f" It cannot represent: {', '.join(absent)}." if absent else ""
        words = f"{_OF_MODEL[model]} {_water(subject, model)}{cannot}"
        blocks.append(paragraph(Strong(f"{model.capitalize()} model. "), glued(words)))
    return Section("Limitations of this analysis", (*blocks, paragraph(_JUDGE)))


def _water(subject: Subject, model: str) -> str:
    """Say what the water and the rock are to a model."""
    reservoir = subject.case.reservoir
    sound = model == "flexible" and subject.case.has_sound("reservoir")
    if sound:
        water = "The water carries sound over a floor that takes some of it, in a reservoir of one depth."
    elif reservoir is not None:
        water = "The water is a mass that moves with the dam: sound in it, and what it takes away, are left out."
    else:
        water = ""
    rock = "The rock below the base is rigid: it neither gives way nor takes energy from the dam."
    if model == "flexible" and subject.case.foundation is not None:
        rock = (
            "The rock is an even, linear elastic half-plane whose level surface moves as the record says where no dam "
            "stands; it has settled under its own weight, and neither slides nor cracks."
        )
        if subject.case.surroundings.assumed:
            rock += " Its modulus is not of the site: it is assumed to be that of the concrete."
    return f"{water} {rock}".strip()
