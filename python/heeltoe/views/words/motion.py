"""A ground motion in words and numbers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import partial

from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain
from heeltoe.motion.check import check, check_moved, check_record
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import measures
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.sentences import numbers, quantity
from heeltoe.views.words.response import part_lines


def sampling(motion: GroundMotion) -> str:
    """Say how a motion is sampled."""
    return f"every {motion.dt:.5g} s" if motion.is_uniform else "in unequal steps"


def about_motion(
    motion: GroundMotion, units: str = "si", gravity: float = STANDARD_GRAVITY
) -> tuple[tuple[str, str], ...]:
    """Return labels and texts of the properties of a motion."""
    return tuple((label, text) for label, (text,) in about_motions([motion], units, gravity))


def about_motions(
    motions: Sequence[GroundMotion], units: str = "si", gravity: float = STANDARD_GRAVITY
) -> list[tuple[str, list[str]]]:
    """Return labels, and a text for each motion, of the properties of motions, each quantity in one unit."""
    table = [measures(motion, gravity) for motion in motions]

    def amounts(values: Sequence[float], form: str) -> list[str]:
        texts, unit = numbers(values, form, units)
        return [f"{text} {unit}" for text in texts]

    def measured(values: Iterable[float | None], form: str) -> list[str]:
        return ["" if value is None else quantity(value, form) for value in values]

    ends = zip(
        amounts([row.end_velocity_m_s for row in table], ".3g m/s"),
        amounts([row.end_displacement_m for row in table], ".3g m"),
        strict=True,
    )
    samples = [f"{motion.time.size}, {sampling(motion)}, {motion.duration:.5g} s in all" for motion in motions]
    lines = (
        ("name", [motion.name for motion in motions]),
        ("event", [motion.event for motion in motions]),
        ("station", [motion.station for motion in motions]),
        ("component", [motion.component for motion in motions]),
        ("date", [motion.date for motion in motions]),
        ("format", [motion.format for motion in motions]),
        ("read as", [motion.units_as_read for motion in motions]),
        ("samples", samples),
        ("PGA", [f"{motion.pga / gravity:.5g} g" for motion in motions]),
        ("PGV", amounts([motion.pgv for motion in motions], ".4g m/s")),
        ("PGD", amounts([motion.pgd for motion in motions], ".4g m")),
        ("Arias intensity", amounts([row.arias_intensity_m_s for row in table], ".4g m/s")),
        ("CAV", amounts([row.cav_m_s for row in table], ".4g m/s")),
        (
            "significant duration",
            [text and f"{text} (5-95 %)" for text in measured((row.significant_duration_s for row in table), ".4g s")],
        ),
        ("mean period", measured((row.mean_period_s for row in table), ".4g s")),
        ("at the end, from rest", [", ".join(end) for end in ends]),
        ("processing", [motion.all_processing for motion in motions]),
        ("motions", ["; then ".join(part_lines(motion, gravity)) for motion in motions]),
        ("source", [motion.source for motion in motions]),
    )
    return [(label, list(map(plain, texts))) for label, texts in lines if any(texts)]


def suspicions(motion: GroundMotion, units: str = "si", gravity: float = STANDARD_GRAVITY) -> tuple[str, ...]:
    """Return the remarks of an analysis on a record; refusals are remarks here."""
    texts: list[str] = []
    for look in (partial(check_record, upward=None), partial(check, allow_zero=True)):
        try:
            texts += [notice.text(units) for notice in look(motion, gravity)]
        except InputError as error:
            texts.append(str(error))
    try:
        # That a record is uncorrected stands among its own warnings.
        check_moved(motion.corrected(), gravity, "motion")
    except InputError as error:
        texts.append(str(error))
    return tuple(dict.fromkeys(texts))
