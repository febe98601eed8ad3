"""From the motion section of a case to ground motions ready for an analysis."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from heeltoe.base.cache import Kept
from heeltoe.case.model import Case
from heeltoe.case.motion import FILE_OPTIONS, HorizontalSource, Motion, Source
from heeltoe.errors.error import InputError
from heeltoe.motion.check import check, check_lag, check_moved, check_pair, check_record, check_scaling
from heeltoe.motion.direction import check_right_angle, direction_of, rotated
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.processing import process
from heeltoe.motion.records import HeaderFactor
from heeltoe.motion.records.catalog import PREFIX, find
from heeltoe.motion.sequence import Components, joined
from heeltoe.motion.start import begun_together
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
    return resolve_components(shaking, gravity, base_directory, field)[:2]


def resolve_components(shaking: Motion, gravity: float, base_directory: Path, field: str = "motion") -> Components:
    """Return the ground motions of a case along the stream, upward and across the valley, as :func:`resolve` does."""
    horizontal = read_source(shaking, gravity, base_directory, field)
    vertical = cross = None
    if shaking.vertical is not None:
        vertical = read_source(shaking.vertical, gravity, base_directory, f"{field}.vertical", upward=True)
    if shaking.cross_valley is not None:
        cross = read_source(shaking.cross_valley, gravity, base_directory, f"{field}.cross_valley")
    horizontal, vertical, cross = together(horizontal, vertical, cross, field)
    by_processing = _scale_of_processing(shaking, gravity, base_directory, field)
    scaled_by = by_processing
    if shaking.azimuth is not None and cross is not None and shaking.cross_valley is not None:
        if by_processing != 1.0 and not _scales(shaking.cross_valley):
            cross = cross.scaled(by_processing, f"scaled by {by_processing:.6g} like the horizontal motion")
        # Both have it from here on.
        scaled_by = 1.0
        beside = f"{field}.cross_valley"
        directions = _direction(horizontal, shaking, field), _direction(cross, shaking.cross_valley, beside)
        check_right_angle(horizontal, directions, f"{beside}.direction")
        horizontal, cross = rotated(horizontal, cross, directions, shaking.azimuth)
    factor = 1.0
    if shaking.pga is not None and (horizontal.pga > 0.0 or not shaking.allow_zero):
        peak = shaking.pga.si(gravity)
        factor = peak / horizontal.pga if horizontal.pga else 1.0
        horizontal = horizontal.scaled_to(peak, f"scaled by {factor:.6g} to a peak of {shaking.pga}")
    horizontal = horizontal.with_warnings(*check_scaling(horizontal, factor * by_processing, field))
    if vertical is not None and shaking.vertical is not None:
        vertical = _beside(vertical, shaking.vertical, horizontal, factor * by_processing, gravity)
    if cross is not None and shaking.cross_valley is not None:
        beside = f"{field}.cross_valley"
        cross = _beside(cross, shaking.cross_valley, horizontal, factor * scaled_by, gravity, beside)
    if vertical is not None and shaking.vertical is not None:
        vertical = _finish(vertical, shaking.vertical, shaking.duration)
        vertical = vertical.with_warnings(*check(vertical, gravity, allow_zero=True, field=f"{field}.vertical"))
    if cross is not None and shaking.cross_valley is not None:
        cross = _finish(cross, shaking.cross_valley, shaking.duration)
        cross = cross.with_warnings(*check(cross, gravity, allow_zero=True, field=f"{field}.cross_valley"))
    horizontal = _finish(horizontal, shaking, shaking.duration)
    allowed = shaking.allow_zero or (vertical is not None and vertical.pga > 0.0)
    horizontal = horizontal.with_warnings(*check(horizontal, gravity, allow_zero=allowed, field=field))
    if "allow_zero" in shaking.model_fields_set and horizontal.pga > 0.0:
        idle = Notice("fields-idle", field=f"{field}.allow_zero", fields=f"{field}.allow_zero", why=_NOT_ZERO)
        horizontal = horizontal.with_warnings(idle)
    return horizontal, vertical, cross


def together(
    horizontal: GroundMotion, vertical: GroundMotion | None, cross: GroundMotion | None, field: str
) -> Components:
    """Return the components of one earthquake on one clock, by the headers of their records and by the leads of
    filters; a component across the valley that yet shakes at another time has a warning.

    Raises
    ------
    InputError
        Where their headers say that they were not recorded together.
    """
    by_field = {field: horizontal, f"{field}.vertical": vertical, f"{field}.cross_valley": cross}
    known = {place: motion for place, motion in by_field.items() if motion is not None}
    lead = max(motion.lead for motion in known.values())
    begun = begun_together(list(known.values()), list(known))
    placed = dict(zip(known, (motion.led_by(lead) for motion in begun), strict=True))
    horizontal, cross = placed[field], placed.get(f"{field}.cross_valley")
    if cross is not None:
        cross = cross.with_warnings(*check_lag(horizontal, cross, f"{field}.cross_valley"))
    return horizontal, placed.get(f"{field}.vertical"), cross


def _direction(motion: GroundMotion, source: HorizontalSource, field: str) -> float:
    """Return the direction of a component by the case, else by its record or its name [rad]."""
    direction = direction_of(motion) if source.direction is None else source.direction
    if direction is None:
        remedy = f'neither {motion.name} nor its name states it; give for example {field}.direction = "180 deg"'
        raise InputError("missing", f"{field}.direction", remedy=remedy)
    return direction


def _beside(
    motion: GroundMotion,
    source: Source,
    horizontal: GroundMotion,
    factor: float,
    gravity: float,
    field: str | None = None,
) -> GroundMotion:
    """Scale another component of the same earthquake: as its own block says, or as the horizontal one is, and look
    whether both are of one."""
    peak = source.peak(gravity, horizontal.pga)
    if peak is not None and peak > 0.0 and motion.pga > 0.0:
        asked = f"{100.0 * source.pga:g} % of the horizontal one" if isinstance(source.pga, float) else str(source.pga)
        motion = motion.scaled_to(peak, f"scaled to a peak of {asked}")
    elif not _scales(source) and factor != 1.0:
        motion = motion.scaled(factor, f"scaled by {factor:.6g} like the horizontal motion")
    return motion.with_warnings(*check_pair(horizontal, motion, field=field))


def resolve_all(case: Case) -> Components:
    """Return the ground motions of a case, as :func:`resolve_components` does, with those of its aftershocks after
    them.

    Raises
    ------
    InputError
        Where it has none, or one that cannot be used.
    """
    if case.motion is None:
        raise InputError("motion-of-suite", "motions") if case.motions else InputError("motion-missing", "motion")
    if not case.aftershocks:
        return resolve_components(case.motion, case.gravity, case.base_directory)
    motions = {"motion": case.motion, **{f"aftershocks[{k}]": motion for k, motion in enumerate(case.aftershocks)}}
    earthquakes = [
        resolve_components(motion, case.gravity, case.base_directory, field) for field, motion in motions.items()
    ]
    lengths = [
        motion.duration or along.duration for motion, (along, _, _) in zip(motions.values(), earthquakes, strict=True)
    ]
    return joined(earthquakes, lengths, [aftershock.pause for aftershock in case.aftershocks])


def read_source(
    shaking: Source,
    gravity: float,
    base_directory: Path,
    field: str,
    *,
    upward: bool = False,
    options_field: str | None = None,
    header_factor: HeaderFactor | None = None,
) -> GroundMotion:
    """Read, or make, the motion, look for damage that would be hidden later, and process it.

    `field` is where it stands, for errors. In a list of files that is the entry of the file itself; how files are read
    and processed, and what to do with the factors in their headers, then stands in the block `options_field`.
    """
    motion = _source(shaking, gravity, base_directory, field, upward, options_field, header_factor)
    motion = motion.with_warnings(*check_record(motion, gravity, field=field, upward=upward))
    block = options_field or field
    motion = process(motion, shaking.processing, gravity, field=f"{block}.processing")
    check_moved(motion, gravity, field, block)
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
    shaking: Source,
    gravity: float,
    base_directory: Path,
    field: str,
    upward: bool,
    options_field: str | None,
    header_factor: HeaderFactor | None,
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
            # What is said of a list is for its files.
            if getattr(shaking, option) is not None and options_field is None:
                raise InputError("option-foreign", f"{block}.{option}", owner="a synthetic motion", remedy="")
        from heeltoe.motion.scenario import synthetic

        return synthetic(shaking.file, gravity=gravity, field=file_field)
    # Here: a dozen formats, each with its words, take longer than a run whose motion is made to order.
    from heeltoe.motion.records.read import called, read_record

    path = find(shaking.file, base_directory, field=file_field)
    options = {"unit": shaking.unit, "time_step": shaking.time_step, "gravity": gravity, "field": block}
    options |= {"layout": shaking.layout, "factor": header_factor or shaking.factor}
    options |= {"several": options_field is not None}
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
