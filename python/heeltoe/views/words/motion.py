"""What is in a ground motion, in words and numbers."""

from __future__ import annotations

from functools import partial

from heeltoe.errors import InputError
from heeltoe.motion.check import check, check_moved, check_record
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import measures
from heeltoe.plain import plain
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.sentences import quantity, written
from heeltoe.views.words.sequence import part_lines


def sampling(motion: GroundMotion) -> str:
    """Say how a motion is sampled."""
    return f"every {motion.dt:.5g} s" if motion.is_uniform else "in unequal steps"


def about_motion(
    motion: GroundMotion, units: str = "si", gravity: float = STANDARD_GRAVITY
) -> tuple[tuple[str, str], ...]:
    """Return labels and texts of all that is known of a motion."""
    lines = (
        ("name", motion.name),
        ("event", motion.event),
        ("station", motion.station),
        ("component", motion.component),
        ("date", motion.date),
        ("format", motion.format),
        ("read as", motion.units_as_read),
        ("samples", f"{motion.time.size}, {sampling(motion)}, {motion.duration:.5g} s in all"),
        ("PGA", f"{motion.pga / gravity:.5g} g"),
        ("PGV", quantity(motion.pgv, ".4g m/s", units)),
        ("PGD", quantity(motion.pgd, ".4g m", units)),
        *_measures(motion, gravity, units),
        ("processing", "; ".join(motion.processing)),
        ("motions", "; then ".join(part_lines(motion, gravity))),
        ("source", motion.source),
    )
    return tuple((label, plain(text)) for label, text in lines if text)


def _measures(motion: GroundMotion, gravity: float, units: str) -> list[tuple[str, str]]:
    found = measures(motion, gravity)
    lines = [
        ("Arias intensity", quantity(found["arias_intensity_m_s"], ".4g m/s", units)),
        ("CAV", quantity(found["cav_m_s"], ".4g m/s", units)),
    ]
    if "significant_duration_s" in found:
        lines.append(("significant duration", f"{found['significant_duration_s']:.4g} s (5-95 %)"))
    if "mean_period_s" in found:
        lines.append(("mean period", f"{found['mean_period_s']:.4g} s"))
    end = written("{end_velocity_m_s:.3g m/s}, {end_displacement_m:.3g m}", units, **found)
    return [*lines, ("at the end, from rest", end)]


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
