"""Warnings of unlikely or unused input: the case, its motion, a record.

The part of the catalogue of warnings (:mod:`heeltoe.warnings.notice`) that needs no run.
"""

from __future__ import annotations

from typing import Literal

Severity = Literal["note", "caution", "grave"]
"""``"note"``: what was assumed or left out, with nothing wrong. ``"caution"``: it may be a mistake, or the numbers hold
with care. ``"grave"``: some number is not what it seems, or the dam does not hold what is asked of it."""

# As in heeltoe.warnings.notice: code -> (how grave, field of the case, sentence).
OF_INPUT: dict[str, tuple[Severity, str, str]] = {
    # case
    "value-unusual": ("caution", "", "{field}: {value}"),
    "below-crack": ("note", "", "{field}: it {ends} below the crack, {effect}"),
    "section-drawn": (
        "note",
        "section",
        "{field} from a drawing: {height_m:.4g m} high, {base_m:.4g m} wide at its base, {area_m2:.4g m²}, on the "
        "layer {layer}; read to {within_m:.2g mm}",
    ),
    "friction-high": (
        "caution",
        "crack",
        "{field}: a coefficient of friction of {friction:g} is higher than tests of concrete show",
    ),
    "law-range": (
        "caution",
        "crack.law",
        "{field}: the static loads press the crack{where} with {stress_pa:.3g MPa} on average, {why}",
    ),
    "law-range-part": (
        "caution",
        "crack.law",
        "{field}: the static loads press {share:.2g %} of the length of the crack{where} with {why}",
    ),
    "law-by-mean": (
        "note",
        "crack.law",
        "{field}: a block feels the law {law} by the mean normal stress of its whole crack, even on a corner",
    ),
    "uplift-intensity": (
        "caution",
        "uplift.intensity",
        "{field}: {intensity:g} means more pressure than the pattern gives",
    ),
    "drains-raise": (
        "caution",
        "uplift.drain_efficiency",
        "{field}: with {efficiency:g} the head at the drains is higher than without drains: drains without effect are "
        'uplift.pattern = "triangular"',
    ),
    "water-over-crest": (
        "caution",
        "reservoir.depth",
        "{field}: the water stands {over_m:.3g m} above the crest; it presses on the faces as still water does and on "
        'the crest by reservoir.nappe = "{nappe}", without what its flow changes',
    ),
    "silt-above-water": (
        "caution",
        "silt.depth",
        "{field}: the silt is higher than the water, though its densities are of silt under water",
    ),
    "silt-with-water": (
        "caution",
        "silt",
        "{field}: {densities_kg_m3:g kg/m^3} seem to include the water, which is counted separately",
    ),
    "tailwater-deeper": ("note", "tailwater.depth", "{field}: the water is deeper downstream than upstream"),
    # fields that change nothing
    "fields-unused": ("note", "", "no effect in {readers}: {fields}"),
    "fields-idle": ("note", "", "{fields}: no effect, because {why}"),
    "rotation-unused": (
        "note",
        "analysis.rotation",
        "{field} = {value} has no effect in the flexible model: it is for the rigid block, and elastic parts "
        "rotate by small angles",
    ),
    "restitution-unused": (
        "note",
        "crack.restitution",
        "{field} = {value} has no effect in the flexible model: it is for impacts of a rigid block; elastic faces "
        "rebound by the waves in the concrete",
    ),
    "hydrodynamic-unused": (
        "caution",
        "reservoir.hydrodynamic",
        "{field} = {value} has no effect on the motion of the elastic dam, whose water is Westergaard's; it is used "
        "only for the accelerations at which a block starts to move",
    ),
    # ground motion
    "motion-still": ("note", "motion", "{name} is zero throughout: in this direction the ground does not move"),
    "motion-strong": (
        "caution",
        "motion",
        "{name} peaks at {peak_g:.3g g}, more than any recorded ground motion: check its unit",
    ),
    "motion-weak": (
        "caution",
        "motion",
        "{name} peaks at {peak_g:.2g g} only: check its unit",
    ),
    "motion-drifts": (
        "caution",
        "motion",
        "{name} ends at {share:.0%} of its largest velocity: its baseline drifts, or it was cut",
    ),
    "motion-jumps": (
        "caution",
        "motion",
        "{name} {place} at {jump_g:.3g g}, {share:.0%} of its peak: the ground jumps by as much against the rest that "
        "it is in before and after the record; give more of the record, or taper it (motion.processing)",
    ),
    "motion-spike": (
        "caution",
        "motion",
        "{name} jumps to {peak_g:.3g g} at {time_s:.4g s}, {ratio:.2g} times as far as it reaches around it: check "
        "whether this value was measured",
    ),
    "motion-coarse": (
        "caution",
        "motion",
        "{name} has values every {step_s:.3g s} only: check its step, as a dam feels much faster shaking",
    ),
    "motion-coarse-for-dam": (
        "caution",
        "motion",
        "{name} has values every {step_s:.3g s}, and the dam swings in about {period_s:.2g s}: straight lines between "
        "them leave out some {share:.2g %} of such motion; take the record in steps of {most_s:.2g s} or less",
    ),
    "component-vertical": (
        "grave",
        "motion",
        "{name} is a vertical component ({component}), and shakes the dam horizontally here",
    ),
    "component-horizontal": (
        "grave",
        "motion.vertical",
        "{name} is a horizontal component ({component}), and shakes the dam vertically here",
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
        "{field}: whether it is of the earthquake of the horizontal motion is not known: {missing} could not be "
        "compared; they last {lengths_s:.4g s|and}, with steps of {steps_s:.3g s|and}",
    ),
    "motion-gap": ("caution", "motion", "{name} has a gap of {gap_s:.3g s} at {time_s:.4g s}"),
    "motion-clipped": (
        "caution",
        "motion",
        "{name} stays at its peak for four samples or more: it may be clipped",
    ),
    "motion-gravity": (
        "grave",
        "motion.processing",
        "{name} rests at {level_g:.3g g}: gravity is in it, as its sensor feels it; without processing it is refused",
    ),
    "motion-offset": (
        "caution",
        "motion.processing",
        "{name} rests at {level_g:.2g g}, {share:.2g} of how far it shakes from there: an offset of its instrument "
        "makes the ground run away; a band-pass or a baseline takes it out",
    ),
    "motion-cut": (
        "caution",
        "motion.duration",
        "the cut to {duration_s:g s} leaves out the record's peak at {time_s:g s}",
    ),
    "motion-scaled": (
        "caution",
        "motion",
        "{name} is scaled by {factor:.3g}, more than {most:g}: an earthquake of such strength lasts longer and has "
        "more of its motion at long periods; take a stronger record",
    ),
    "motion-stretched": (
        "caution",
        "motion.processing",
        "{name} had its time stretched by {factor:g}: no earthquake was recorded like that",
    ),
    "vertical-left-out": (
        "note",
        "motion.vertical",
        "{field}: a motion given beside the case comes without it, as it was recorded with another one",
    ),
    "cross-valley-not-given": (
        "caution",
        "motion.cross_valley",
        "{field}: a motion given beside the case comes without it: the run has no shaking across the valley",
    ),
    "aftershocks-left-out": (
        "caution",
        "aftershocks",
        "{field}: a motion given beside the case takes the place of all of its motions, and comes alone",
    ),
    "motion-generated": ("note", "motion.file", "{name} is generated, not recorded"),
    "motion-beyond-relations": (
        "caution",
        "motion.file",
        "{name} is outside the records behind its relations: M 6 to 7.6, 10 to 100 km, Vs30 600 m/s up",
    ),
    # records; their numbers are in the units of the file
    "record-count": ("caution", "", "{name} states {stated:g} values and has {found:d}: all of them are used"),
    "record-peak": ("caution", "", "{name} states a peak of {stated:g} and has {found:.6g}: what it has is used"),
    "record-step-doubtful": (
        "caution",
        "",
        "{name} states a step of {step_s:g s}, {values:g} values and {duration_s:g s}: check it",
    ),
    "record-channels": ("caution", "", "{name} opens {opened:d} channels and has accelerations of {found:d}"),
    "record-doubtful": ("caution", "", "{name} {doubt}"),
    "record-reader-warns": ("caution", "", "{name}: its reader warns: {text}"),
    "record-uncorrected": (
        "caution",
        "motion.processing",
        "{name} is uncorrected: {why}; an analysis asks for motion.processing with a band-pass or a baseline",
    ),
    "record-unit-assumed": (
        "caution",
        "motion.unit",
        "{name} states no unit: {unit} is assumed; an analysis asks for {field}",
    ),
    "record-step-assumed": (
        "caution",
        "motion.time_step",
        "{name} states no time step: {step_s:g s} is assumed; an analysis asks for {field}",
    ),
}
