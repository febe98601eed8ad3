"""Errors of static loads and static checks: a part of the catalogue (:mod:`heeltoe.errors.error`)."""

from __future__ import annotations

# As in heeltoe.errors.error: code -> (what is wrong, what to do).
OF_STATICS: dict[str, tuple[str, str]] = {
    # water, ice and silt
    "ice-above-crest": (
        "the ice acts at {value}, above the crest at {height}",
        "leave the ice out, or lower the water",
    ),
    # criteria of a user's own
    # sections
    "section-misfit": ("at {value} the case does not fit: {reason}", "change that, or leave this section out"),
    "earthquake-rarity": (
        "{value} does not say whether the earthquake is an unusual or an extreme load",
        'add rarity = "unusual", as of an operating basis earthquake (OBE), or "extreme", as of a maximum design, '
        "maximum credible or safety evaluation earthquake (MDE, MCE, SEE)",
    ),
}
