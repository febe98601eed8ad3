"""The results in full: how it slides, how long, how it strikes, and all figures of it."""

from __future__ import annotations

from typing import Any

from heeltoe.mechanics.block import StaticState
from heeltoe.result.contract import HEADLINES, RESIDUAL_SLIP, WIDTH
from heeltoe.result.numbers import (
    OF_SEVERAL,
    BlockNumbers,
    CrackEnergy,
    CrackLevel,
    CrackNumbers,
    ElasticCrack,
)
from heeltoe.result.response import Response
from heeltoe.result.verdict import effect_sentence
from heeltoe.units.sentences import listed, written
from heeltoe.units.write import NOTHING
from heeltoe.views.content.drawings import in_rows
from heeltoe.views.content.subject import Subject, labels_of
from heeltoe.views.content.tree import Block, Inline, Section, Table, paragraph
from heeltoe.views.words.response import (
    SEQUENCE_COLUMNS,
    law_line,
    roughness_line,
    sequence_rows,
    tension_line,
    tension_worth,
)
from heeltoe.views.words.starts import starts

_STARTS = {
    ("sliding", "downstream"): "Sliding downstream starts at",
    ("sliding", "upstream"): "Sliding upstream starts at",
    ("rocking", "downstream"): "Rocking downstream, about the toe, starts at",
    ("rocking", "upstream"): "Rocking upstream, about the heel, starts at",
}


def results(subject: Subject) -> Section:
    """Return the section with all numbers and figures of the results."""
    n, prefix = subject.numbers, subject.first.prefix
    labels = (*labels_of(StaticState, "static."), ("Width of the crack", WIDTH, "length"))
    static = list(subject.known(labels, prefix, "").rows)
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
        # The headline numbers stand before; those of one model stay empty for another.
        moves = dict.fromkeys(
            label
            for run in subject.runs
            for label in labels_of(_kind_of(run.response))
            if label[1] not in (WIDTH, *(item.key for item in HEADLINES))
        )
        silence = ("Silence after the ground motion, at the end of the run", "silence_s", "time")
        caption = f"How it moves, {subject.per_width}; what is zero is left out."
        blocks.append(subject.compared([*moves, silence], caption))
        figure = subject.figure
        blocks += [
            *_signs(subject),
            *_band(subject),
            *_friction_effect(subject),
            *_cracks(subject),
            *figure("plan", "slip-by-mode", "friction", "asperities"),
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


def _kind_of(response: Response) -> type[CrackNumbers]:
    return ElasticCrack if response.elastic else BlockNumbers


def _signs(subject: Subject) -> list[Block]:
    """Return what the motion does both ways round."""
    signs, n = subject.result.signs, subject.numbers
    rows: list[tuple[Inline, ...]] = []
    for place, way in enumerate(signs):
        key = f"signs.{place}."
        crack = (n(f"{key}elevation_m", "length"),) if subject.result.several else ()
        slip, opening = n(f"{key}{RESIDUAL_SLIP.key}"), n(f"{key}opening_m")
        rows.append((way.sign, way.outcome, *crack, slip, opening, "leads" if way.governs else ""))
    crack_head = ("crack",) if subject.result.several else ()
    head = ("motion", "outcome", *crack_head, "residual slip", "largest opening", "")
    caption = "The motion as recorded and reversed; all other numbers are those of the sign that leads."
    return [Table(head, tuple(rows), caption, "ll" + "r" * (len(head) - 3) + "l")] if rows else []


def _band(subject: Subject) -> list[Block]:
    """Return what other frictions of the crack do."""
    band, n = subject.result.friction_band, subject.numbers
    if band is None:
        return []
    rows: list[tuple[Inline, ...]] = []
    for place, trial in enumerate(band.trials):
        key = f"friction_band.trials.{place}."
        moved = n(f"{key}{RESIDUAL_SLIP.key}"), n(f"{key}opening_m")
        rows.append((trial.friction.text(subject.units), trial.outcome, *moved, "judged" if trial.judged else ""))
    caption = "The frictions that the crack may have, the best estimate first; the others without evidence."
    return [Table(("", "outcome", "residual slip", "largest opening", ""), tuple(rows), caption, "llrrl")]


def _friction_effect(subject: Subject) -> list[Block]:
    """Return what a little less friction does."""
    effect = subject.result.friction_effect
    return [] if effect is None else [paragraph(effect_sentence(effect, subject.units))]


def _cracks(subject: Subject) -> list[Block]:
    """Return what each of several cracks did."""
    if not subject.result.several:
        return []
    cracks = subject.result.cracks
    n = subject.numbers
    head = ("", *(f"crack at {written('{at_m:g m}', subject.units, at_m=crack.elevation)}" for crack in cracks))
    labels = [
        *(label for label in labels_of(_kind_of(subject.result)) if label[1] not in (*OF_SEVERAL, WIDTH)),
        *labels_of(CrackEnergy, "crack_energy."),
        *(
            (f"Largest force of anchor {place + 1}", f"anchors.{place}.peak_force_n", None)
            for place in range(len(subject.case.anchors))
        ),
    ]
    rows: list[tuple[Inline, ...]] = [
        (label, *(n(f"cracks.{place}.{key}", quantity) for place in range(len(cracks))))
        for label, key, quantity in labels
    ]
    rows = [row for row in rows if any(cell != NOTHING for cell in row[1:])]
    caption = "Each crack by itself, from the crest down; unless stated, values are those of the crack that slips most."
    means = [name for name, crack in zip(head[1:], cracks, strict=True) if crack.scatters]
    if means:
        caption += f" Slips, openings and rotations of the {listed(means)} are means over runs that scatter."
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
    # The spectra have figures.
    labels = [label for label in labels_of(CrackLevel) if not label[1].startswith("spectrum.")]
    return [
        subject.known(labels, f"{run.prefix}crack_level.", caption)
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
    caption = f"Forces that the anchors bear, tension and resistance to slip together, {subject.per_width}."
    return [Table(head, rows, caption, "l" + "r" * (len(head) - 1))] if rows else []


def _rough(subject: Subject) -> list[Block]:
    """Return the state of the asperities of a rough crack at the end."""
    blocks: list[Block] = []
    for run in subject.runs:
        roughness = run.response.summary.get("roughness")
        if roughness is not None:
            whose = "" if len(subject.runs) == 1 else f", {run.name}"
            blocks.append(paragraph(f"The rough crack{whose}: {roughness_line(roughness, subject.units)}."))
    return blocks


def _law(subject: Subject) -> list[Block]:
    """Return the friction law or the rough crack: its kind, its figure, and its state at the end."""
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
        for prefix, elevation, law in _laws_of(run.response):
            at = _where(subject, elevation)
            blocks.append(paragraph(f"The law at the end{at}{whose}: {law_line(law, subject.units)}."))
            caption = f"The friction law{at}{whose}."
            blocks.append(subject.known(labels_of(type(law)), f"{run.prefix}{prefix}friction_law.", caption))
    return blocks


def _joint(subject: Subject) -> list[Block]:
    """Return what has become of the bonds of joints."""
    blocks: list[Block] = []
    for run in subject.runs:
        for name in ("joint", "bond"):
            whose = " below the block" if name == "bond" else ""
            for prefix, elevation, state in _laws_of(run.response, name):
                caption = f"State of the joint{whose}{_where(subject, elevation)}."
                blocks.append(subject.known(labels_of(type(state)), f"{run.prefix}{prefix}{name}.", caption))
    return blocks


def _where(subject: Subject, elevation_m: float | None) -> str:
    """Return where one of several cracks is; nothing of the only one."""
    return "" if elevation_m is None else written(" at {at_m:g m}", subject.units, at_m=elevation_m)


def _laws_of(response: Response, block: str = "friction_law") -> list[tuple[str, float | None, Any]]:
    """Return the final states of laws or bonds, crack by crack: the prefix of its keys, the elevation of one of
    several, and its block."""
    states = [
        (f"cracks.{place}.", crack.elevation, crack.numbers) if response.several else ("", None, crack.numbers)
        for place, crack in enumerate(response.cracks)
    ]
    found = [(prefix, at, getattr(numbers, block, None)) for prefix, at, numbers in states]
    return [(prefix, at, state) for prefix, at, state in found if state is not None]


def _sequence(subject: Subject) -> list[Block]:
    """Return what each motion of a sequence does."""
    blocks: list[Block] = []
    for run in subject.runs:
        rows = tuple(map(tuple, sequence_rows(run.response, subject.units)))
        if rows:
            caption = f"Motion by motion, {run.name}; slips from before the first one, + downstream."
            blocks.append(Table(SEQUENCE_COLUMNS, rows, caption, "l" + "r" * (len(SEQUENCE_COLUMNS) - 1)))
    return blocks
