"""What can be wrong with still loads and static checks: a part of the catalogue of errors (:mod:`heeltoe.errors`)."""

from __future__ import annotations

# As in heeltoe.errors: code -> (what is wrong, what to do).
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
    # sections
    "section-misfit": ("at {value} the case does not fit: {reason}", "change that, or leave this section out"),
    "sections-twice": ("{value} stands twice", "name each elevation once"),
}
