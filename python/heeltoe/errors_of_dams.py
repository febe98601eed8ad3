"""What can be wrong with a dam, its crack and its anchors: part of the catalogue of errors (:mod:`heeltoe.errors`)."""

from __future__ import annotations

# As in heeltoe.errors: code -> (what is wrong, what to do).
OF_DAMS: dict[str, tuple[str, str]] = {
    "anchor-outside": ("{value} is beyond the toe: the crack is {width} wide", "give a distance from 0 m to {width}"),
    "anchor-form": ("is required and not there", "give distance, or head_x, head_elevation, foot_x and foot_elevation"),
    "anchor-ends": (
        "is a place on one crack, and there are further_cracks, which the anchor may cross as well",
        "give head_x, head_elevation, foot_x and foot_elevation",
    ),
    "anchor-flat": (
        "the line from its head to its foot is {value} off the normal of the crack",
        "let it cross the crack more steeply, up to {most}",
    ),
    "section-incomplete": ("is required and not there", "give {fields}; or slopes, a polygon or a file"),
    "face-levels": ("the elevations {value} do not ascend from 0 m", "give the base first, then each break in order"),
    "face-above-crest": ("{value} is not below the crest at {height}", "give breaks below it"),
    "section-file-unread": ("{value} has not been read", "read the case by heeltoe.read_case"),
    "section-file-missing": ("there is no file {value}", "give its path relative to the case file"),
    "section-file-unreadable": ("{value} cannot be read ({reason})", "give a drawing in DXF or a table in CSV"),
    "section-file-large": ("has more than {value}", "give the outline of the section alone"),
    "section-file-kind": ("is neither a drawing in DXF nor a table of numbers", "give one of them"),
    "section-unit-missing": (
        "is required, since the file does not state the unit of its numbers",
        'add for example unit = "m" under [section]',
    ),
    "section-row": (
        "line {number} is no corner: {value}",
        "give x and z in each line, and no more than its head names",
    ),
    "section-head": ("the head {value} does not say which columns are x and z", 'call them "x [m]" and "z [m]"'),
    "drawing-package": ("needs the package {value}, which is not installed", "pip install heeltoe[drawing]"),
    "drawing-unreadable": ("cannot be read as DXF ({reason})", "save it anew as DXF, best of the release 2010"),
    "drawing-empty": ("has no closed polyline", "join the lines of the section into one, and close it"),
    "drawing-several": (
        "there are {value} closed polylines; by layers: {layers}",
        "name a layer that has one alone by section.layer",
    ),
    "drawing-layer": ("{value} has no closed polyline; layers that have: {layers}", "name one of them"),
    "drawing-arcs": ("the polyline on the layer {value} has arcs", "replace them by short straight pieces"),
    "neck-above-crest": ("{value} is above the crest at {height}", "give a height up to {height}"),
    "section-size": ("{value} is no size of a dam", "give a section of 1 mm to 10 km"),
    "polygon-corners": ("has {value} different corners", "give at least 3"),
    "polygon-crossing": (
        "the outline {value} crosses or touches itself",
        "give the corners in order around the section",
    ),
    "crack-outside": ("{value} is outside the section", "give an elevation from 0 m to below {height}"),
    "crack-pieces": (
        "the line at {value} meets the section in several pieces",
        "give an elevation with one piece of concrete",
    ),
    "crack-overhang": (
        "the line at {value} goes through concrete upstream of where it starts, too",
        "give an inclination or elevation where it starts at the upstream face",
    ),
    "crack-no-width": ("the section has no width at {value}", "give an elevation where it has one"),
    "cracks-meet": (
        "the crack at {value} meets or crosses that at {other}, or leaves less than {least} between them",
        "give them another elevation or inclination",
    ),
    "several-cracks": (
        "{model} knows one crack alone, since what is above one of several is no single block",
        "run the flexible model, which knows several, or leave out [[further_cracks]]",
    ),
    "kinks-order": ("the distances {value} do not ascend from the heel", "give the kinks in order, from heel to toe"),
    "kinks-outside": ("{value} is beyond the toe: the crack is {width} wide", "give distances below {width}"),
    "kinks-steep": (
        "the crack runs at {value} to its mean line or to the horizontal behind {start}",
        "let it run at up to {most}; a step needs some length",
    ),
    "kinks-base": (
        "there is nothing of the dam below the crack that could have kinks",
        "give crack.elevation, and a section that goes down into the rock",
    ),
    "kinks-leave": (
        "the crack with the corners {value} leaves the dam between its heel and its toe",
        "give corners that are in its concrete",
    ),
    "kinks-mesh": ("elements cannot follow {value} kinks", "give more elements_across, fewer kinks or flatter ones"),
    "kinks-straight": (
        "{model} knows straight cracks alone",
        "run the flexible model, or leave out the kinks",
    ),
    "kinks-beside": ("does not go with crack.kinks: it is known of a straight crack alone", "remove it, or the kinks"),
    "kinks-value": (
        "{value} does not go with crack.kinks: it is known of a straight crack alone",
        "choose another, or leave out the kinks",
    ),
    "two-cracks-most": (
        "{value} make three blocks or more, and the rigid model knows two, one on the other",
        "leave one further crack, or run the flexible model, which knows any number",
    ),
    "one-crack-value": (
        "{value} does not go with {other}: it is known of one crack alone",
        "choose another, or one crack",
    ),
    "one-crack-only": ("does not go with {other}: it is known of one crack alone", "remove it, or the further cracks"),
    "friction-missing": ("is required and not there", "give friction, or both static_friction and kinetic_friction"),
    "friction-order": ("{value} is below kinetic_friction, {kinetic}", "give a static_friction of at least {kinetic}"),
    "law-option-foreign": ('does not belong to the law "{law}"', "remove it; that law knows {known}"),
    "law-option-missing": ('is required by the law "{law}"', "give it, or choose another law"),
    "law-order": ("{value} is below residual_friction, {residual}", "give a peak_friction of at least {residual}"),
    "law-points": ("the normal stresses {value} do not ascend", "give the points in order, each stress once"),
    "law-falls": (
        "the strength falls with the normal stress before {value}",
        "give points between which the coefficient times the stress grows",
    ),
    "law-penalty": (
        "{value} is not known to the penalty method",
        'use flexible.contact = "coulomb", or the rigid model or the decoupled chain',
    ),
    "rough-law": (
        "does not go with the law {value}: its coefficients are those of plane flanks alone",
        "give friction, that of the flanks, in place of the law",
    ),
    "rough-locks": (
        "friction and flanks come to {value} together: a crack that steep locks",
        "lower it, or the friction, or give a longer wave_length, so that they stay below 85 degrees",
    ),
    "rough-other": ("{value} does not go with crack.roughness", "choose another, or leave out crack.roughness"),
    "rough-model": ("is not known to {model}", "use the rigid model or the decoupled chain"),
    "law-unknown": ("{value} is no friction law", "give one of {names}, or a case, CASE.toml{near}"),
    "law-stack": (
        "{value} does not go with two rigid blocks",
        "give coefficients of friction, or run the flexible model",
    ),
    "law-twice": ("cannot stand beside the cohesion of crack.law", "keep one of them"),
    "uplift-option-foreign": (
        'does not belong to the pattern "{pattern}"',
        'remove it or choose the pattern "{owner}"',
    ),
    "uplift-option-missing": ('is required by the pattern "{pattern}"', "give it or choose another pattern"),
    "uplift-profile": (
        "the distances {value} do not ascend from 0 to 1",
        "give them in order, the heel at 0 and the toe at 1",
    ),
}
