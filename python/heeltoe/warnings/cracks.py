"""Warnings of cracks and of motions in sequence; see :mod:`heeltoe.warnings.notice`."""

from __future__ import annotations

from heeltoe.warnings.input import Row

#: By code: how grave, field of the case, sentence.
OF_CRACKS: dict[str, Row] = {
    "sequence-ends": (
        "grave",
        "aftershocks",
        "the run ends in motion {number:d}, {name}: the {left:d} after it are not computed",
    ),
    "sequence-moves": (
        "caution",
        "aftershocks",
        "{name} leaves the dam moving when the next begins at {time_s:.4g s}: a longer {field} lets it come to rest",
    ),
    "sequence-statics": (
        "grave",
        "aftershocks",
        "the dam that {name} leaves does not meet the static checks before the next motion: {missed}",
    ),
    "sequence-drains-close": (
        "caution",
        "aftershocks",
        "the slip that {name} leaves keeps {share:.2g %} of the drainage: the motions after it are computed with "
        "uplift.drain_efficiency = {efficiency:.3g}",
    ),
    "sequence-drains": (
        "grave",
        "aftershocks",
        "the slip that {name} leaves keeps {share:.2g %} of the drainage, and the motions after it are computed with "
        "all of it: a run with uplift.drain_efficiency = {efficiency:.3g} bounds what they do",
    ),
    "bond-of-block": (
        "caution",
        "crack.bond",
        "a rigid block bears its bond up to the strength, by linear stresses, and then cracks through at once: an "
        "elastic dam cracks step by step, earlier or later, and may vibrate several times as hard; the flexible model "
        "says how far",
    ),
    "joint-coarse": (
        "caution",
        "flexible.elements_across",
        "elements of {element_m:.3g m} along the joint are longer than a third of its process zone of {zone_m:.3g m}; "
        "the tensile strength is lowered from {given_pa:.3g MPa} to {taken_pa:.3g MPa}, which keeps the energy: give "
        "more elements across",
    ),
}
