"""From the motion section of a case to ground motions ready for an analysis."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from heeltoe.base.cache import Kept
from heeltoe.case.model import Case
from heeltoe.case.motion import FILE_OPTIONS, Motion, Source
from heeltoe.errors.error import InputError
from heeltoe.motion.check import check, check_moved, check_pair, check_record, check_scaling
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.processing import process
from heeltoe.motion.records import called, read_record
from heeltoe.motion.records.catalog import PREFIX, find
from heeltoe.motion.scenario import synthetic
from heeltoe.motion.sequence import joined
from heeltoe.warnings.notice import Notice

# Records as they were read: many runs differ in all else.
_KEPT: Kept[GroundMotion] = Kept(8)
_NOT_ZERO = "the motion is not zero"


def resolve(
    shaking: Motion, gravity: float, base_directory: Path, field: str = "motion"
) -> tuple[GroundMotion, GroundMotion | None]:
    """Read, check, process, scale, reverse and cut the ground motions of a case, in this order, and check them again.

    A peak asked for is the peak of the whole record. A vertical motion without a peak or a scaling step of its own is
    scaled by the same factors as the horizontal one, as both were recorded together.

    Parameters
    ----------
    shaking
        The motion section of the case.
    gravity
        One g of the case [m/s2].
    base_directory
        Where relative paths start.
    field
        Where it stands in the case.

    Returns
    -------
    horizontal, vertical
        The second is None where the case has none.

    Raises
    ------
    InputError
        Where a record cannot be found, read or trusted.
    """
    horizontal = read_source(shaking, gravity, base_directory, field)
    vertical = None
    factor = 1.0
    if shaking.pga is not None and (horizontal.pga > 0.0 or not shaking.allow_zero):
        peak = shaking.pga.si(gravity)
        factor = peak / horizontal.pga if horizontal.pga else 1.0
        horizontal = horizontal.scaled_to(peak, f"scaled by {factor:.6g} to a peak of {shaking.pga}")
    by_processing = _scale_of_processing(shaking, gravity, base_directory, field)
    horizontal = horizontal.with_warnings(*check_scaling(horizontal, factor * by_processing, field))
    if shaking.vertical is not None:
        vertical = read_source(shaking.vertical, gravity, base_directory, f"{field}.vertical", upward=True)
        if shaking.vertical.pga is not None and vertical.pga > 0.0:
            vertical = vertical.scaled_to(
                shaking.vertical.pga.si(gravity), f"scaled to a peak of {shaking.vertical.pga}"
            )
        elif not _scales(shaking.vertical):
            factor *= by_processing
            if factor != 1.0:
                vertical = vertical.scaled(factor, f"scaled by {factor:.6g} like the horizontal motion")
        vertical = vertical.with_warnings(*check_pair(horizontal, vertical)).led_by(horizontal.lead)
        horizontal = horizontal.led_by(vertical.lead)
        vertical = _finish(vertical, shaking.vertical, shaking.duration)
        vertical = vertical.with_warnings(*check(vertical, gravity, allow_zero=True, field=f"{field}.vertical"))
    horizontal = _finish(horizontal, shaking, shaking.duration)
    allowed = shaking.allow_zero or (vertical is not None and vertical.pga > 0.0)
    horizontal = horizontal.with_warnings(*check(horizontal, gravity, allow_zero=allowed, field=field))
    if "allow_zero" in shaking.model_fields_set and horizontal.pga > 0.0:
        idle = Notice("fields-idle", field=f"{field}.allow_zero", fields=f"{field}.allow_zero", why=_NOT_ZERO)
        horizontal = horizontal.with_warnings(idle)
    return horizontal, vertical


def resolve_all(case: Case) -> tuple[GroundMotion, GroundMotion | None]:
    """Return the ground motions of a case, as :func:`resolve` does, with those of its aftershocks after them.

    Raises
    ------
    InputError
        Where it has none, or one that cannot be used.
    """
    if case.motion is None:
        raise InputError("motion-of-suite", "motions") if case.motions else InputError("motion-missing", "motion")
    if not case.aftershocks:
        return resolve(case.motion, case.gravity, case.base_directory)
    motions = {"motion": case.motion, **{f"aftershocks[{k}]": motion for k, motion in enumerate(case.aftershocks)}}
    pairs = []
    for field, motion in motions.items():
        across, up = resolve(motion, case.gravity, case.base_directory, field)
        pairs.append((across, up, motion.duration or across.duration))
    return joined(pairs, [aftershock.pause for aftershock in case.aftershocks])


def read_source(
    shaking: Source,
    gravity: float,
    base_directory: Path,
    field: str,
    *,
    upward: bool = False,
    options_field: str | None = None,
) -> GroundMotion:
    """Read, or make, the motion, look for damage that would be hidden later, and process it.

    `field` is where it stands, for errors. In a list of files that is the entry of the file itself; its unit and its
    time step then stand in the block `options_field`.
    """
    motion = _source(shaking, gravity, base_directory, field, upward, options_field)
    motion = motion.with_warnings(*check_record(motion, gravity, field=field, upward=upward))
    motion = process(motion, shaking.processing, gravity, field=f"{field}.processing")
    check_moved(motion, gravity, field)
    return motion


def _scales(shaking: Source) -> bool:
    """Whether the processing of a motion scales it."""
    return any(step.scales for step in shaking.processing)


def _scale_of_processing(shaking: Source, gravity: float, base_directory: Path, field: str) -> float:
    """Return the factor by which the processing of a motion scales it; all other steps are the same for any scale."""
    if not _scales(shaking):
        return 1.0
    others = tuple(step for step in shaking.processing if not step.scales)
    plain = read_source(shaking.model_copy(update={"processing": others}), gravity, base_directory, field)
    return read_source(shaking, gravity, base_directory, field).pga / plain.pga


def _source(
    shaking: Source, gravity: float, base_directory: Path, field: str, upward: bool, options_field: str | None
) -> GroundMotion:
    if shaking.points is not None:
        time = [moment for moment, _ in shaking.points]
        values = [value.si(gravity) for _, value in shaking.points]
        motion = GroundMotion.from_points(time, values, name="points of the case")
        return replace(motion, format="points", source="the case")
    assert shaking.file is not None
    file_field, block = (f"{field}.file", field) if options_field is None else (field, options_field)
    if shaking.file.startswith(PREFIX):
        for option in FILE_OPTIONS:
            if getattr(shaking, option) is not None:
                raise InputError("synthetic-option", f"{block}.{option}")
        return synthetic(shaking.file, gravity=gravity, field=file_field)
    path = find(shaking.file, base_directory, field=file_field)
    options = {"unit": shaking.unit, "time_step": shaking.time_step, "gravity": gravity, "field": block}
    options |= {"layout": shaking.layout, "factor": shaking.factor}
    motion = _KEPT.get(
        (_state_of(path), shaking.channel, *options.values()),
        lambda: read_record(path, shaking.channel, **options),  # type: ignore[arg-type]
    )
    component = motion.component.lower()
    if upward and (component.startswith(("down", "dwn")) or "positive down" in component):
        motion = replace(
            motion.reversed(),
            processing=(*motion.processing, "the record counts down as positive: turned to up"),
        )
    return called(motion, path, shaking.file)


def _state_of(path: Path) -> tuple[object, ...]:
    """Return what is another where a file has been written anew."""
    try:
        status = path.stat()
    except OSError:
        return (path,)
    return path.resolve(), status.st_mtime_ns, status.st_size, status.st_ino


def _finish(motion: GroundMotion, shaking: Source, duration: float | None) -> GroundMotion:
    if shaking.is_reversed if isinstance(shaking, Motion) else shaking.reverse:
        motion = motion.reversed()
    return motion if duration is None else motion.cut(duration + motion.lead)
