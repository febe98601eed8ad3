"""What is in a ground motion, in words and numbers."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain
from heeltoe.motion.check import check, check_moved, check_record
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import measures
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.sentences import numbers, quantity
from heeltoe.views.words.sequence import part_lines


def sampling(motion: GroundMotion) -> str:
    """Say how a motion is sampled."""
    return f"every {motion.dt:.5g} s" if motion.is_uniform else "in unequal steps"


def about_motion(
    motion: GroundMotion, units: str = "si", gravity: float = STANDARD_GRAVITY
) -> tuple[tuple[str, str], ...]:
    """Return labels and texts of all that is known of a motion."""
    return tuple((label, text) for label, (text,) in about_motions([motion], units, gravity))


def about_motions(
    motions: Sequence[GroundMotion], units: str = "si", gravity: float = STANDARD_GRAVITY
) -> list[tuple[str, list[str]]]:
    """Return labels, and a text for each motion, of all that is known of motions, each quantity in one unit."""
    found = [measures(each, gravity) for each in motions]

    def amounts(values: Sequence[float], form: str) -> list[str]:
        texts, unit = numbers(values, form, units)
        return [f"{text} {unit}" for text in texts]

    def measured(name: str, form: str) -> list[str]:
        return [quantity(each[name], form) if name in each else "" for each in found]

    ends = zip(
        amounts([each["end_velocity_m_s"] for each in found], ".3g m/s"),
        amounts([each["end_displacement_m"] for each in found], ".3g m"),
        strict=True,
    )
    samples = [f"{each.time.size}, {sampling(each)}, {each.duration:.5g} s in all" for each in motions]
    lines = (
        ("name", [each.name for each in motions]),
        ("event", [each.event for each in motions]),
        ("station", [each.station for each in motions]),
        ("component", [each.component for each in motions]),
        ("date", [each.date for each in motions]),
        ("format", [each.format for each in motions]),
        ("read as", [each.units_as_read for each in motions]),
        ("samples", samples),
        ("PGA", [f"{each.pga / gravity:.5g} g" for each in motions]),
        ("PGV", amounts([each.pgv for each in motions], ".4g m/s")),
        ("PGD", amounts([each.pgd for each in motions], ".4g m")),
        ("Arias intensity", amounts([each["arias_intensity_m_s"] for each in found], ".4g m/s")),
        ("CAV", amounts([each["cav_m_s"] for each in found], ".4g m/s")),
        ("significant duration", [text and f"{text} (5-95 %)" for text in measured("significant_duration_s", ".4g s")]),
        ("mean period", measured("mean_period_s", ".4g s")),
        ("at the end, from rest", [", ".join(each) for each in ends]),
        ("processing", [each.all_processing for each in motions]),
        ("motions", ["; then ".join(part_lines(each, gravity)) for each in motions]),
        ("source", [each.source for each in motions]),
    )
    return [(label, list(map(plain, texts))) for label, texts in lines if any(texts)]


def suspicions(motion: GroundMotion, units: str = "si", gravity: float = STANDARD_GRAVITY) -> tuple[str, ...]:
    """Return what an analysis would say about a record; here even what it would refuse is only said."""
    said: list[str] = []
    for look in (partial(check_record, upward=None), partial(check, allow_zero=True)):
        try:
            said += [each.text(units) for each in look(motion, gravity)]
        except InputError as error:
            said.append(str(error))
    try:
        # That a record is uncorrected stands among its own warnings.
        check_moved(motion.corrected(), "motion")
    except InputError as error:
        said.append(str(error))
    return tuple(dict.fromkeys(said))
