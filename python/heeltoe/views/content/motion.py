"""The ground motion: where it comes from, what was done to it, its measures, and what is suspicious about it."""

from __future__ import annotations

from heeltoe.errors.sanitize import plain
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.result.write import MotionNumbers
from heeltoe.units.sentences import written
from heeltoe.units.write import NOTHING
from heeltoe.views.content.drawings import in_rows
from heeltoe.views.content.subject import Subject, labels_of
from heeltoe.views.content.tree import Block, Code, FigureBlock, Inline, Notes, Section, Table, paragraph, without_gaps

# Of all steps of processing together.
_LONGEST = 2000
_WORDS = (
    ("Event", "event"),
    ("Station", "station"),
    ("Component", "component"),
    ("Date", "date"),
    ("Source", "source"),
    ("Read as", "units_as_read"),
)


def ground_motion(subject: Subject) -> Section:
    """Return the section about the ground motion."""
    response = subject.first.response
    motions = {"horizontal, + downstream": (response.motion, "motion")}
    if response.vertical is not None:
        motions["vertical, + up"] = (response.vertical, "vertical_motion")
    if response.cross is not None:
        motions["across the valley, + left"] = (response.cross, "cross_valley_motion")
    n, prefix = subject.numbers, subject.first.prefix

    rows: list[tuple[Inline, ...]] = [("Name", *(Code(plain(motion.name)) for motion, _ in motions.values()))]
    for label, name in _WORDS:
        words = [getattr(motion, name) for motion, _ in motions.values()]
        if any(words):
            rows.append((label, *(plain(word or NOTHING) for word in words)))
    rows.append(("Processing", *(plain(motion.all_processing or "none", _LONGEST) for motion, _ in motions.values())))
    for label, name, quantity in labels_of(MotionNumbers):
        cells = [n(f"{prefix}{key}.{name}", quantity) for _, key in motions.values()]
        if any(cell != NOTHING for cell in cells):
            rows.append((label, *cells))
    table = Table(
        ("", *motions),
        tuple(rows),
        "The ground motion, as used.",
        "l" + "l" * len(motions),
        # Of one motion it stands in two halves beside each other.
        () if len(motions) == 1 else (3.0, *(6.0 / len(motions) for _ in motions)),
    )
    gravity = written("One g is taken as {gravity_m_s2:.6g m/s²}.", subject.units, gravity_m_s2=subject.case.gravity)
    blocks = (
        *in_rows((*subject.figure("motion")[:1], *_spectrum(subject))),
        table,
        paragraph(gravity),
        _checks([motion for motion, _ in motions.values()], subject.units),
    )
    return Section("Ground motion", without_gaps(*blocks))


def _checks(motions: list[GroundMotion], units: str) -> Block:
    texts = [warning.text(units) for motion in motions for warning in motion.warnings]
    if texts:
        return Notes("warning", "Checks of the motion", tuple((text,) for text in texts))
    return paragraph(
        "Checks of the motion (finite samples in order of time, a plausible peak, velocity and displacement at the "
        "end) found nothing to warn of."
    )


def _spectrum(subject: Subject) -> tuple[FigureBlock, ...]:
    # Both models are shaken by the same motion; one spectrum is enough, and that of the flexible dam shows its periods.
    return subject.figure("spectrum")[-1:]
