"""Warnings of static checks; see :mod:`heeltoe.warnings.notice`."""

from __future__ import annotations

from heeltoe.warnings.input import Row

#: By code: how grave, field of the case, sentence.
OF_STATICS: dict[str, Row] = {
    "slip-unknown": (
        "caution",
        "statics.residual_slip",
        "post-seismic: no slip is given, so zero is assumed; {field}, or a run of the motion, provides it",
    ),
    "slip-untold": (
        "grave",
        "statics.residual_slip",
        'post-seismic: the {model} model ends "{outcome}", with no slip to trust: zero is taken, so that a statement '
        "of the dam after the earthquake holds only if it has not moved",
    ),
    "crack-opens-statically": (
        "note",
        "uplift",
        "the usual loads open the crack by {length_m:.2f m}, and water follows; the critical accelerations keep the "
        "case's uplift, as the time histories do at the start",
    ),
    "kinks-beside-line": (
        "caution",
        "crack.kinks",
        {
            "add": (
                "{field}: sliding and critical accelerations count the friction on the straight line from heel to "
                "toe alone, a factor of {along:.3f} under the usual loads; its pieces, which rise at up to "
                "{angle_deg:.3g} degrees, would bear {bear}. Stresses and openings are those on the straight line"
            ),
            "take": (
                "{field}: {name}: the resultant acts where the crack falls, and its pieces bear a sliding factor of"
                " {factor:.3f}, less than the {along:.3f} of friction on the straight line from heel to toe: the "
                "smaller one counts. Stresses and openings are those on the straight line"
            ),
        },
    ),
    "anchors-after-slip": (
        "grave",
        "anchors",
        "post-seismic: the anchors count with all their prestress, and few tendons bear a slip of {slip_m:.3g mm} "
        "across them: the sliding factor of {factor:.3f} is {bare_factor:.3f} without them",
    ),
    "anchors-as-prestress": (
        "note",
        "anchors",
        "{field}: the static checks count their prestress, not what opening and slip would add",
    ),
    "drains-by-manual": (
        "note",
        "uplift.drain_efficiency",
        "{field}: {efficiency:g} counts from the whole difference in head, as in USBR's manual. EM 1110-2-2200 counts "
        "from the straight line between heel and toe: its pressure for {efficiency:g} is lower, that of {same:.3g} "
        "here",
    ),
    "sections-apart": (
        "note",
        "statics.sections",
        "{field}: these checks are of the crack alone; heeltoe.statics_of_sections judges the {count:d} listed",
    ),
}
