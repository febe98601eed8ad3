"""Friction laws that were fitted to shear tests: in words, and the report of them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from heeltoe.errors.sanitize import plain
from heeltoe.kernel.build import build_info
from heeltoe.mechanics.law_fit import Fall, LawFits, Parameter
from heeltoe.units.sentences import counted, written
from heeltoe.views.content.drawings import drawing
from heeltoe.views.content.tree import Document, Inline, Listing, Notes, Section, Strong, Table, paragraph

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_FORMS = {"Pa": "{:.3g MPa}", "m": "{:.3g mm}", "m/s": "{:.3g m/s}"}
_NAMES = {"Pa": "pa", "m": "m", "m/s": "m_s"}


def law_fit_document(
    fits: LawFits, title: str, units: str = "si", figures: Mapping[str, Figure] | None = None
) -> Document:
    """Return the report of laws that were fitted to the shear tests of a file."""
    rows: list[tuple[Inline, ...]] = [
        (Strong(fit.law) if fit.chosen else fit.law, "; ".join(numbers_of(fit.parameters, units)), fit.why)
        for fit in fits.fits
    ]
    texts = [fall_sentence(fall) for fall in fits.falls] + [note.text(units) for note in fits.notes]
    notes = [Notes("note", "The tests", tuple((text,) for text in texts))] if texts else []
    captions = {"strength": "Strengths of the tests, the laws, and the band of further tests.", "fall": "The fall."}
    return Document(
        title=plain(title),
        subtitle="Friction laws from shear tests",
        footer=f"heeltoe {build_info()['heeltoe']} · friction laws",
        blocks=(
            Section(
                "Friction of the joint",
                (
                    *(paragraph(text) for text in summary_lines(fits, units)),
                    Table(("law", "numbers (95 %)", "why"), tuple(rows), "The laws; the chosen ones stand out.", "lll"),
                    *notes,
                    *(drawing(name, figure, captions[name]) for name, figure in (figures or {}).items()),
                ),
            ),
            Section("As a block of the case file", (Listing(fits.crack),)),
        ),
    )


def summary_lines(fits: LawFits, units: str) -> tuple[str, str]:
    """Return how many tests there are, and the friction that they have."""
    used = "" if fits.used == fits.tests else f", {fits.used} of them fitted"
    stress = written("{stress_pa:.3g MPa}", units, stress_pa=fits.normal_stress_pa)
    friction = f"{fits.friction:.3f}, 95 % of further tests between {fits.low:.3f} and {fits.high:.3f}"
    return (
        f"{counted(fits.tests, 'test')} of {counted(fits.specimens, 'specimen')}{used}",
        f"apparent friction at a normal stress of {stress}: {friction}",
    )


def numbers_of(parameters: list[Parameter], units: str) -> list[str]:
    """Return the numbers of a law with their intervals."""
    return [f"{number.name} {_shown(number, units)}" for number in parameters]


def fall_sentence(fall: Fall) -> str:
    """Say whether the friction falls."""
    chance = f"probability {fall.probability:.2g} where there is none"
    if not fall.found:
        return f"No fall of the friction with {fall.by} is found in {counted(fall.tests, 'test')} ({chance})."
    return f"The friction falls by {fall.friction:.2f} with {fall.by} in {counted(fall.tests, 'test')} ({chance})."


def _shown(number: Parameter, units: str) -> str:
    best, low, high = (_one(value, number.unit, units) for value in (number.value, number.low, number.high))
    return f"{best} ({low} to {high})"


def _one(value: float, unit: str, units: str) -> str:
    if unit == "rad":
        return f"{math.degrees(value):.3g} deg"
    if unit not in _FORMS:
        return f"{value:.3g}"
    name = f"value_{_NAMES[unit]}"
    return written(_FORMS[unit].replace("{:", f"{{{name}:"), units, **{name: value})
