"""Errors of static loads and static checks: a part of the catalogue (:mod:`heeltoe.errors.error`)."""

from __future__ import annotations

# As in heeltoe.errors.error: code -> (what is wrong, what to do).
OF_STATICS: dict[str, tuple[str, str]] = {
    # water, ice and silt
    "ice-depth": ("{value} is not within the {depth} of water", "give a depth below the surface, up to there"),
    "silt-above-crest": ("{value} is above the crest at {height}", "give a depth between 0 m and {height}"),
    "water-above-crest": (
        "{value} is more than twice the height of the dam, {height}",
        "give a depth up to {most}",
    ),
    "ice-above-crest": (
        "the ice acts at {value}, above the crest at {height}",
        "leave the ice out, or lower the water",
    ),
    # criteria of a user's own
    "criteria-number": ("{value} is not a number above 0 and up to {most}", "give one"),
    "criteria-empty": ("{value} sets no criteria", "add a table, for example [sliding] with usual = 1.5"),
    # sections
    "section-misfit": ("at {value} the case does not fit: {reason}", "change that, or leave this section out"),
    "earthquake-rarity": (
        "{value} does not say whether the earthquake is an unusual or an extreme load",
        'add rarity = "unusual", as of an operating basis earthquake (OBE), or "extreme", as of a maximum design, '
        "maximum credible or safety evaluation earthquake (MDE, MCE, SEE)",
    ),
}
