"""The results in full: how it slides, how long, how it strikes, and all figures of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from heeltoe.result.contract import HEADLINES
from heeltoe.result.response import Response
from heeltoe.units.sentences import written
from heeltoe.views.content.drawings import in_rows
from heeltoe.views.content.subject import Labels, Subject
from heeltoe.views.content.tree import Block, Inline, Section, Table, paragraph
from heeltoe.views.words.numbers import Value
from heeltoe.views.words.response import (
    SEQUENCE_COLUMNS,
    law_line,
    roughness_line,
    sequence_rows,
    tension_line,
    tension_worth,
)
from heeltoe.views.words.starts import starts

_ROWS: Labels = (
    ("Slip while sliding", "slip_by_mode_m.sliding", "displacement"),
    ("Slip while slide-rocking", "slip_by_mode_m.slide_rocking", "displacement"),
    ("Slip while drifting", "slip_by_mode_m.drifting", "displacement"),
    ("Time at rest", "time_by_mode_s.rest", "time"),
    ("Time sliding", "time_by_mode_s.sliding", "time"),
    ("Time rocking", "time_by_mode_s.rocking", "time"),
    ("Time slide-rocking", "time_by_mode_s.slide_rocking", "time"),
    ("Time drifting, in touch with nothing", "time_by_mode_s.drifting", "time"),
    ("Strikes (of corners; of nodes of the crack)", "impacts", None),
    ("Fastest strike", "largest_impact_velocity_m_s", None),
    ("Events of the walk", "events", None),
    ("Largest normal force on the crack", "peak_normal_force_n", None),
    ("Slip velocity at the end", "final_slip_velocity_m_s", None),
    ("End of the run", "end_time_s", None),
    ("Of it silence, after the ground motion", "silence_s", "time"),
)
_ALWAYS = ("impacts", "final_slip_velocity_m_s", "end_time_s")
_STATIC: Labels = (
    ("Sliding safety factor", "static.sliding_safety_factor", None),
    ("Normal force on the crack", "static.normal_force_n", None),
    ("Force along the crack, + downstream", "static.horizontal_force_n", None),
    ("Resultant from the heel", "static.resultant_from_heel_m", "length"),
    ("Width of the crack", "crack_width_m", "length"),
    ("Mass of the concrete above the crack", "static.concrete_mass_kg", None),
    ("Virtual mass of the water", "static.virtual_mass_kg", None),
)
_STARTS = {
    ("sliding", "downstream"): "Sliding downstream starts at",
    ("sliding", "upstream"): "Sliding upstream starts at",
    ("rocking", "downstream"): "Rocking downstream, about the toe, starts at",
    ("rocking", "upstream"): "Rocking upstream, about the heel, starts at",
}
_OF_CRACKS: Labels = (
    *(
        (item.full.capitalize(), item.key, None if item.kind == "rotation" else "displacement")
        for item in HEADLINES
        if item.way > 0
    ),
    ("Strikes of nodes", "impacts", None),
    ("Lost in friction", "crack_energy.friction_j", None),
    ("Lost in impacts", "crack_energy.impact_j", None),
)
_CRACK_LEVEL: Labels = (
    ("Peak of the ground", "ground_peak_g", "g"),
    ("Peak at the crack, horizontal", "peak_horizontal_g", "g"),
    ("Peak at the crack, over that of the ground", "amplification", None),
    ("Peak at the crack, upward", "peak_vertical_g", "g"),
    ("Peak rotational acceleration of the crack", "peak_rotation_rad_s2", None),
    ("First period of the part below with the part above attached", "periods_s.0", "time"),
    ("First period of the dam without a crack, all of it elastic", "bonded.periods_s.0", "time"),
    ("Peak in that dam at the place of the crack", "bonded.peak_horizontal_g", "g"),
    ("Spacing of the motion of the crack", "convergence.step_s", "time"),
    ("Residual slip with twice that", "convergence.coarser_residual_slip_m", "displacement"),
)
_LAW: Labels = (
    ("Slip path, to and fro", "slip_path_m", "displacement"),
    ("Normal stress under the static loads", "normal_stress_pa", None),
    ("Apparent friction before the earthquake", "apparent_friction_before", None),
    ("Apparent friction after it", "apparent_friction_after", None),
    ("Cohesion left", "cohesion_left_pa", None),
    ("Work that broke the bond", "bond_energy_j", "energy"),
    ("Least slip path of a node", "slip_path_range_m.0", "displacement"),
    ("Largest slip path of a node", "slip_path_range_m.1", "displacement"),
    ("Apparent friction of a node after it, least", "apparent_friction_after_range.0", None),
    ("Apparent friction of a node after it, largest", "apparent_friction_after_range.1", None),
    ("Time walked by integration, the rest exactly", "integrated_time_s", "time"),
    ("Estimated error of the integration", "integration_error_m", None),
)
_JOINT: Labels = (
    ("First cracking", "first_cracking_s", "time"),
    ("Place of it, from the upstream face", "first_cracking_at_m", "length"),
    ("Cracked through", "cracked_through_s", "time"),
    ("Cracked from the upstream face", "cracked_upstream_m", "length"),
    ("Cracked from the downstream face", "cracked_downstream_m", "length"),
    ("Cracked in all", "cracked_length_m", "length"),
    ("Softened, not yet cracked", "softening_length_m", "length"),
    ("Energy that the bond took", "fracture_energy_j", "energy"),
    ("Process zone of the concrete", "process_zone_m", "length"),
    ("Longest element along the joint", "element_m", "length"),
    ("Tensile strength that the model takes", "tensile_strength_pa", None),
)
_BOND: Labels = (
    ("Bond breaks", "breaks_s", "time"),
    ("Part of the tensile strength used until then", "tensile_strength_used", None),
    ("Part of the shear strength used until then", "shear_strength_used", None),
)


def results(subject: Subject) -> Section:
    """Return the section with all numbers and figures of what happens."""
    n, prefix = subject.numbers, subject.first.prefix
    static: list[tuple[Inline, ...]] = [(label, n(prefix + key, quantity)) for label, key, quantity in _STATIC]
    for (kind, way), start in starts(subject.first.response).items():
        static.append((_STARTS[kind, way], n(f"{prefix}critical_acceleration_g.{kind}_{way}", "g")))
        if start.varied:
            static.append(("with the vertical motion", start.varied))
    # A heading keeps its table: a figure before that could float to the page before.
    blocks: list[Block] = [
        Table(
            ("", "value"),
            tuple(static),
            f"Before the earthquake, with the uplift of the case, {subject.per_width}; accelerations at which a rigid "
            "part above the crack starts to move.",
            "lr",
        ),
        *subject.figure("comparison", "response"),
    ]
    if any(run.response.summary for run in subject.runs):
        rows: list[tuple[Inline, ...]] = []
        for label, key, quantity in _ROWS:
            row = subject.row(label, key, quantity)
            if key in _ALWAYS or any(isinstance(cell, Value) and cell.number for cell in row[1:]):
                rows.append(row)
        blocks.append(
            Table(
                subject.head(),
                tuple(rows),
                f"How it moves, {subject.per_width}; modes that do not happen are left out.",
                subject.align(),
            )
        )
        figure = subject.figure
        blocks += [
            *_signs(subject),
            *_cracks(subject),
            *figure("slip-by-mode", "friction", "asperities"),
            *_tension(subject),
            *in_rows(figure("deformed", "tension")),
            *_at_the_crack(subject),
            *figure("crack-level", "accelerations", "forces"),
            *_anchors(subject),
            *in_rows(figure("bearing", "anchors")),
            *figure("crest"),
            *_law(subject),
            *_joint(subject),
            *figure("joints", "joint"),
            *in_rows(figure("crack", "pressure")),
            *figure("path", "water-pressure"),
            *_sequence(subject),
        ]
    else:
        blocks.append(paragraph("The run never started, so that there are no results and no figures of it."))
    return Section("Results", tuple(blocks))


def _signs(subject: Subject) -> list[Block]:
    """Return what the motion does both ways round."""
    signs, n = subject.result.signs, subject.numbers
    rows: list[tuple[Inline, ...]] = []
    for place, way in enumerate(signs):
        key = f"signs.{place}."
        crack = (n(f"{key}elevation_m", "length"),) if subject.result.several else ()
        slip, opening = n(f"{key}residual_slip_m"), n(f"{key}opening_m")
        rows.append((way.sign, way.outcome, *crack, slip, opening, "leads" if way.governs else ""))
    crack_head = ("crack",) if subject.result.several else ()
    head = ("motion", "outcome", *crack_head, "residual slip", "largest opening", "")
    caption = "The motion as recorded and reversed; all other numbers are those of the sign that leads."
    return [Table(head, tuple(rows), caption, "ll" + "r" * (len(head) - 3) + "l")] if rows else []


def _cracks(subject: Subject) -> list[Block]:
    """Return what each of several cracks did."""
    if not subject.result.several:
        return []
    cracks = subject.result.cracks
    n = subject.numbers
    head = ("", *(f"crack at {written('{at_m:g m}', subject.units, at_m=crack.elevation)}" for crack in cracks))
    rows: list[tuple[Inline, ...]] = [
        (label, *(n(f"cracks.{place}.{key}", quantity) for place in range(len(cracks))))
        for label, key, quantity in (
            *_OF_CRACKS,
            *(
                (f"Largest force of anchor {place + 1}", f"anchors.{place}.peak_force_n", None)
                for place in range(len(subject.case.anchors))
            ),
        )
    ]
    caption = "Each crack by itself, from the crest down; unless stated, values are those of the crack that slips most."
    return [Table(head, tuple(rows), caption, "l" + "r" * len(cracks))]


def _tension(subject: Subject) -> list[Block]:
    """Return the largest tension of an elastic dam, and what the concrete bears."""
    blocks: list[Block] = []
    for run in subject.runs:
        tension = run.response.summary.get("tension")
        if tension is not None:
            sentences = tension_line(tension, subject.units), tension_worth(tension, subject.units)
            blocks.append(paragraph(f"The largest tension in the concrete is {sentences[0]}. It is {sentences[1]}."))
    return blocks


def _at_the_crack(subject: Subject) -> list[Block]:
    """Return how the crack moves that shakes a decoupled block."""
    caption = "The motion of the crack, which shakes the block."
    return [
        subject.values(_CRACK_LEVEL, f"{run.prefix}crack_level.", caption)
        for run in subject.runs
        if "crack_level" in run.response.summary
    ]


def _anchors(subject: Subject) -> list[Block]:
    """Return what the anchors bear."""
    if not subject.case.anchors:
        return []
    runs = [run for run in subject.runs if run.response.summary.get("anchors")]
    events = [
        (f"{label}, {run.name}", f"{run.prefix}anchors", key)
        for key, label in (("slack_s", "slack from"), ("yields_s", "above its capacity from"))
        for run in runs
        if any(anchor[key] is not None for anchor in run.response.anchors or ())
    ]
    head = (
        "anchor",
        "from the heel",
        *(f"largest force, {run.name}" for run in runs),
        "capacity",
        *(label for label, _, _ in events),
    )
    rows = tuple(
        (
            f"{place + 1}",
            subject.numbers(f"{runs[0].prefix}anchors.{place}.distance_m", "length"),
            *(subject.numbers(f"{run.prefix}anchors.{place}.peak_force_n") for run in runs),
            subject.numbers(f"{runs[0].prefix}anchors.{place}.capacity_n"),
            *(subject.numbers(f"{path}.{place}.{key}", "time") for _, path, key in events),
        )
        for place in range(len(subject.case.anchors))
        if runs
    )
    caption = f"What the anchors bear, tension and resistance to slip together, {subject.per_width}."
    return [Table(head, rows, caption, "l" + "r" * (len(head) - 1))] if rows else []


def _rough(subject: Subject) -> list[Block]:
    """Return what a rough crack has come to."""
    blocks: list[Block] = []
    for run in subject.runs:
        roughness = run.response.summary.get("roughness")
        if roughness is not None:
            whose = "" if len(subject.runs) == 1 else f", {run.name}"
            blocks.append(paragraph(f"The rough crack{whose}: {roughness_line(roughness, subject.units)}."))
    return blocks


def _law(subject: Subject) -> list[Block]:
    """Return what a friction law is, looks like, and has come to, or a rough crack."""
    alone = [cracked for cracked in subject.case.single_crack_cases if cracked.crack.law is not None]
    if not alone:
        return _rough(subject)
    blocks: list[Block] = []
    for cracked in alone:
        at = _where(subject, cracked.crack.elevation if subject.case.further_cracks else None)
        assert cracked.crack.law is not None
        sentence = (
            f"The friction of the crack{at} goes by the law {cracked.crack.law.name}; its figure shows what is borne."
        )
        blocks.append(paragraph(sentence))
    blocks += subject.figure("law")
    for run in subject.runs:
        whose = "" if len(subject.runs) == 1 else f", {run.name}"
        for prefix, law_state in _laws_of(run.response):
            at, law = _where(subject, law_state.get("elevation_m")), law_state["friction_law"]
            blocks.append(paragraph(f"What it has come to{at}{whose}: {law_line(law, subject.units)}."))
            present = [key for _, key, _ in _LAW if key.split(".")[0] in law]
            caption = f"The friction law{at}{whose}."
            blocks.append(subject.values(_LAW, f"{run.prefix}{prefix}friction_law.", caption, present))
    return blocks


def _joint(subject: Subject) -> list[Block]:
    """Return what has become of the bonds of joints."""
    blocks: list[Block] = []
    for run in subject.runs:
        for name, labels in (("joint", _JOINT), ("bond", _BOND)):
            whose = " below the block" if name == "bond" else ""
            for prefix, state in _laws_of(run.response, name):
                caption = f"What has become of the joint{whose}{_where(subject, state.get('elevation_m'))}."
                blocks.append(subject.known(labels, f"{run.prefix}{prefix}{name}.", caption))
    return blocks


def _where(subject: Subject, elevation_m: float | None) -> str:
    """Return where one of several cracks is; nothing of the only one."""
    return "" if elevation_m is None else written(" at {at_m:g m}", subject.units, at_m=elevation_m)


def _laws_of(response: Response, block: str = "friction_law") -> list[tuple[str, Mapping[str, Any]]]:
    """Return what says what a law or a bond has come to, of each of several cracks or of the only one, and where."""
    if not response.several:
        laws = [("", response.summary)]
    else:
        laws = [(f"cracks.{place}.", crack.to_json()) for place, crack in enumerate(response.cracks)]
    return [(prefix, numbers) for prefix, numbers in laws if numbers.get(block) is not None]


def _sequence(subject: Subject) -> list[Block]:
    """Return what each motion of a sequence does."""
    blocks: list[Block] = []
    for run in subject.runs:
        rows = tuple(map(tuple, sequence_rows(run.response, subject.units)))
        if rows:
            caption = f"Motion by motion, {run.name}; slips from before the first one, + downstream."
            blocks.append(Table(SEQUENCE_COLUMNS, rows, caption, "l" + "r" * (len(SEQUENCE_COLUMNS) - 1)))
    return blocks
