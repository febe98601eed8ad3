"""Errors of a dam, its crack and its anchors: a part of the catalogue (:mod:`heeltoe.errors.error`)."""

from __future__ import annotations

# As in heeltoe.errors.error: code -> (what is wrong, what to do).
OF_DAMS: dict[str, tuple[str, str]] = {
    "anchor-flat": (
        "the line from its head to its foot is {value} off the normal of the crack",
        "let it cross the crack more steeply, up to {most}",
    ),
    "section-file-unread": ("{value} has not been read", "read the case by heeltoe.read_case"),
    "section-row": (
        "line {number} is not a corner: {value}",
        "give x and z in each line, and no more than its head names",
    ),
    "section-head": ("the head {value} does not say which columns are x and z", 'call them "x [m]" and "z [m]"'),
    "drawing-empty": (
        "has no closed outline{why}",
        "close it: a closed polyline, or lines and curves that join at their ends",
    ),
    "drawing-several": (
        "there are {value} closed outlines; by layers: {layers}",
        "name a layer that has one alone by section.layer",
    ),
    "drawing-beside": (
        "the only closed outline, on the layer {value}, {beside}",
        "say by section.layer that it is the dam, or close the outline of the dam and name its layer",
    ),
    "drawing-mixed": (
        "the closed outline on the layer {value} {beside}",
        "move it to a layer of its own, whole, and name that",
    ),
    "drawing-layer": ("{value} has no closed outline{why}; layers that have: {layers}", "name one of them"),
    "drawing-height": (
        "by the unit {unit} the dam is {value} high",
        'say the unit of its numbers, for example unit = "m" under [section]',
    ),
    "polygon-crossing": (
        "the outline {value} crosses or touches itself",
        "give the corners in order around the section",
    ),
    "crack-pieces": (
        "the line at {value} meets the section in several pieces",
        "give an elevation with one piece of concrete",
    ),
    "crack-overhang": (
        "the line at {value} goes through concrete upstream of where it starts, too",
        "give an inclination or elevation where it starts at the upstream face",
    ),
    "crack-leaves-base": (
        "the crack starts at the base and falls downstream by {value}, out of the section",
        "an inclined crack that falls needs an elevation above the base, because its toe lies below its heel; "
        "or give crack.inclination of 0 deg or more",
    ),
    "crack-no-width": ("the section has no width at {value}", "give an elevation where it has one"),
    "cracks-meet": (
        "the crack at {value} meets or crosses that at {other}, or leaves less than {least} between them",
        "give them another elevation or inclination",
    ),
    "cracks-order": ("{value} is below the crack at {other}", "list the cracks from the crest down"),
    "combination": ("{value} cannot be combined with {other}: {reason}", "{remedy}"),
    "unsupported": ("{model} does not support {value}: {reason}", "{remedy}"),
    "kinks-steep": (
        "the crack runs at {value} to its mean line or to the horizontal behind {start}",
        "let it run at up to {most}; a step needs some length",
    ),
    "kinks-base": (
        "the section ends at the crack: kinks need concrete below it",
        "give crack.elevation, and a section that goes down into the rock",
    ),
    "kinks-leave": (
        "the crack with the corners {value} leaves the dam between its heel and its toe",
        "give corners that are in its concrete",
    ),
    "kinks-mesh": ("elements cannot follow {value} kinks", "give more elements_across, fewer kinks or flatter ones"),
    "law-falls": (
        "the strength falls with the normal stress before {value}",
        "give points between which the coefficient times the stress grows",
    ),
    "bond-apex": (
        "{value} is less than friction times tensile_strength, {least}: the joint would slip before it bears that",
        "give a cohesion of at least {least}, or a lower bond.tensile_strength",
    ),
    "rough-locks": (
        "friction and flanks come to {value} together: a crack that steep locks",
        "lower it, or the friction, or give a longer wave_length, so that they stay below 85 degrees",
    ),
    "law-unknown": ("{value} is not a friction law", "give one of {names}, or a case, CASE.toml{near}"),
    "motion-in-rock": (
        "{value}: the models take the motion of the free surface, not one within the rock",
        "give the record as it was before any deconvolution",
    ),
    # the band of the friction
    "band-negative": ("5 % of this {value} distribution is below zero", "cut it by lower, or give less scatter"),
    "fit-file": (
        "{value} {reason}",
        "give the law-fit.toml of `heeltoe law fit TESTS.csv --out FOLDER`",
    ),
    "band-judge": ("the band has no {value}", "give that end, or judge another one"),
    "band-many": (
        "{value} judges a single run; studies and suites run the best estimate",
        'write judge = "best", and run the other frictions by crack.friction',
    ),
    # tables of shear tests
    "tests-both": (
        "the table has strengths and points of curves",
        "give a table of strengths, or one of curves with specimen, normal stress, slip and shear",
    ),
    "tests-cell": ("{value} is no number", "give a plain number in the unit of the heading"),
    "tests-points": ("the curve has {value} points", "give at least {least} points of each specimen and stage"),
}
