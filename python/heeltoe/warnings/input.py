"""Warnings of unlikely or unused input: the case, its motion, a record.

The part of the catalogue of warnings (:mod:`heeltoe.warnings.notice`) that needs no run.
"""

from __future__ import annotations

from typing import Literal

Severity = Literal["note", "caution", "grave"]
"""``"note"``: what was assumed or left out, with nothing wrong. ``"caution"``: it may be a mistake, or the numbers hold
with care. ``"grave"``: some number is not what it seems, or the dam does not hold what is asked of it."""

Row = tuple[Severity, str, str | dict[str, str]]
"""How grave it is, the field of the case, and the sentence, or several by their kind."""

# As in heeltoe.warnings.notice, by code.
OF_INPUT: dict[str, Row] = {
    # case
    "value-unusual": ("caution", "", "{field}: {value}"),
    "value-unused": ("note", "", "{field} = {value} has no effect in the flexible model: {why}"),
    "below-crack": ("note", "", "{field}: it {ends} below the crack, {effect}"),
    "section-drawn": (
        "note",
        "section",
        "{field} from a drawing: {height_m:.4g m} high, {base_m:.4g m} wide at its base, {area_m2:.4g m²}, on the "
        "layer {layer}; read to {within_m:.2g mm}",
    ),
    "law-range": (
        "caution",
        "crack.law",
        {
            "mean": "{field}: the static loads press the crack{where} with {stress_pa:.3g MPa} on average, {why}",
            "part": "{field}: the static loads press {share:.2g %} of the length of the crack{where} with {why}",
        },
    ),
    "law-by-mean": (
        "note",
        "crack.law",
        "{field}: a block feels the law {law} by the mean normal stress of its whole crack, even on a corner",
    ),
    "water-over-crest": (
        "caution",
        "reservoir.depth",
        "{field}: the water stands {over_m:.3g m} above the crest; it presses on the faces as still water does and on "
        'the crest by reservoir.nappe = "{nappe}", without what its flow changes',
    ),
    "tailwater-deeper": ("note", "tailwater.depth", "{field}: the water is deeper downstream than upstream"),
    # fields that change nothing
    "fields-unused": ("note", "", "no effect in {readers}: {fields}"),
    "fields-idle": ("note", "", "{fields}: no effect, because {why}"),
    "hydrodynamic-unused": (
        "caution",
        "reservoir.hydrodynamic",
        "{field} = {value} has no effect on the motion of the elastic dam, whose water is Westergaard's; it is used "
        "only for the accelerations at which a block starts to move",
    ),
    # ground motion
    "motion-still": ("note", "motion", "{name} is zero throughout: in this direction the ground does not move"),
    "motion-flaw": (
        "caution",
        "motion",
        {
            "drifts": "{name} ends at {share:.0%} of its largest velocity: its baseline drifts, or it was cut",
            "jumps": (
                "{name} {place} at {jump_g:.3g g}, {share:.0%} of its peak: the ground jumps by as much against the"
                " rest that it is in before and after the record; give more of the record, or taper it "
                "(motion.processing)"
            ),
            "spike": (
                "{name} jumps to {peak_g:.3g g} at {time_s:.4g s}, {ratio:.2g} times as far as it reaches around "
                "it: check whether this value was measured"
            ),
            "coarse": "{name} has values every {step_s:.3g s} only: check its step, as a dam feels much faster shaking",
            "gap": "{name} has a gap of {gap_s:.3g s} at {time_s:.4g s}",
            "clipped": "{name} stays at its peak for four samples or more: it may be clipped",
            "offset": (
                "{name} rests at {level_g:.2g g}, {share:.2g} of how far it shakes from there: an offset of its "
                "instrument makes the ground run away; a band-pass or a baseline takes it out"
            ),
        },
    ),
    "motion-coarse-for-dam": (
        "caution",
        "motion",
        "{name} has values every {step_s:.3g s}, and the dam swings in about {period_s:.2g s}: straight lines between "
        "them leave out some {share:.2g %} of such motion; take the record in steps of {most_s:.2g s} or less",
    ),
    "components-differ": (
        "grave",
        "motion.vertical",
        "{field}: it is not of the earthquake of the horizontal motion ({vertical}; {horizontal}), though it is scaled "
        "with it",
    ),
    "components-unsure": (
        "caution",
        "motion.vertical",
        "{field}: whether it was recorded with the horizontal motion is not known: {why}",
    ),
    "motion-gravity": (
        "grave",
        "motion.processing",
        "{name} rests at {level_g:.3g g}: gravity is in it, as its sensor feels it; without processing it is refused",
    ),
    "motion-cut": (
        "caution",
        "motion.duration",
        "the cut to {duration_s:g s} leaves out the record's peak at {time_s:g s}",
    ),
    "motion-unlike-records": (
        "caution",
        "motion",
        {
            "scaled": (
                "{name} is scaled by {factor:.3g}, more than {most:g}: an earthquake of such strength lasts longer "
                "and has more of its motion at long periods; take a stronger record"
            ),
            "stretched": "{name} had its time stretched by {factor:g}: no earthquake was recorded like that",
            "beyond-relations": (
                "{name} is outside the records behind its relations: M 6 to 7.6, 10 to 100 km, Vs30 600 m/s up"
            ),
        },
    ),
    "vertical-left-out": (
        "note",
        "motion.vertical",
        "{field}: a motion given beside the case comes without it, as it was recorded with another one",
    ),
    "motion-generated": ("note", "motion.file", "{name} is generated, not recorded"),
    "motion-peak-unusual": ("caution", "motion", "{name} peaks at {peak}: check its unit"),
    "component-other": ("grave", "motion", "{name} is a {kind} component ({component}), and shakes the dam {way} here"),
    "motions-left-out": ("caution", "motion", "{field}: a motion given beside the case comes alone and {effect}"),
    # records; their numbers are in the units of the file
    "record-channels": ("caution", "", "{name} opens {opened:d} channels and has accelerations of {found:d}"),
    "record-uncorrected": (
        "caution",
        "motion.processing",
        "{name} is uncorrected: {why}; an analysis asks for motion.processing with a band-pass or a baseline",
    ),
    "record-doubtful": ("caution", "", "{name} {doubt}"),
    "record-assumed": (
        "caution",
        "motion",
        "{name} states no {what}: {assumed} is assumed; an analysis asks for {field}",
    ),
}
