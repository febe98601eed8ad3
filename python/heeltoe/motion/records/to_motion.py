"""From a record as it stands in its file, and what the caller tells of it, to a ground motion in SI units."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.records.raw import RawRecord
from heeltoe.units.parse import STANDARD_GRAVITY, acceleration_unit
from heeltoe.warnings.notice import Notice

# Beyond these the numbers are no record in any unit, and displacements would overflow.
_LARGEST_VALUE, _LARGEST_GAP = 1e12, 1e4
# No instrument for strong motion is slower [s].
_LONGEST_STEP = 1.0
# What stands for a missing value: nines alone, and far from all that was measured.
_NINES, _FAR = re.compile(r"9{3,}(?:\.9*0*)?"), 1.5
# A record of more rows than these, nearly all of them a step apart within so much of it, lacks some where two are
# farther apart than this many steps.
_FEW, _EVEN, _MOSTLY, _LACKING = 20, 0.02, 0.9, 2.5
# The commonest of digitised records.
_LIKELY_STEP = 0.01


@dataclass(frozen=True)
class Options:
    """What the caller says of a record; see :func:`heeltoe.motion.records.read_record`."""

    unit: str | None = None
    time_step: float | None = None
    gravity: float = STANDARD_GRAVITY
    field: str = "motion"
    assume: bool = False


def to_motion(raw: RawRecord, name: str, channels: int, options: Options) -> GroundMotion:
    """Make a ground motion of a record.

    Parameters
    ----------
    raw
        The record as it stands in its file.
    name
        Of the file.
    channels
        How many there are in the file.
    options
        What the caller says.

    Raises
    ------
    InputError
        Where file and caller contradict each other, or neither states what is needed.
    """
    if raw.values.size < 2:
        raise InputError("motion-short", name, raw.values.size)
    if not np.isfinite(raw.values).all():
        bad = int(np.flatnonzero(~np.isfinite(raw.values))[0])
        raise InputError("motion-not-finite", name, str(raw.values[bad]), number=bad + 1)
    _check_markers(raw, name)
    peak = float(np.abs(raw.values).max())
    time, unsure = _time(raw, name, options)
    unit, read_as, unsure_too = _unit(raw, name, peak, options)
    factor = _si(unit, f"{options.field}.unit" if raw.unit is None else name, options)
    if peak * factor > _LARGEST_VALUE:
        raise InputError("motion-peak", name, f"{peak:.4g} {unit}", name="it")
    stem = Path(name).stem
    measured = (Notice("record-uncorrected", name=name, why=raw.uncorrected),) if raw.uncorrected else ()
    return GroundMotion(
        name=f"{stem}-chan{raw.channel}" if channels > 1 else stem,
        time=time,
        acceleration=raw.values * factor,
        format=raw.format,
        units_as_read=read_as,
        source=name,
        channel=raw.channel,
        processing=raw.processing,
        warnings=(*raw.warnings, *measured, *unsure, *unsure_too),
        **raw.about,  # type: ignore[arg-type]
    )


def _check_markers(raw: RawRecord, name: str) -> None:
    """Refuse -9999 and its like among smaller values; scaled to a peak it would hide all that was measured."""
    size = np.abs(raw.values)
    worst = int(size.argmax())
    rest = float(size[size < size[worst]].max(initial=0.0))
    if _NINES.fullmatch(f"{size[worst]:.10g}") and size[worst] > _FAR * rest:
        raise InputError("record-marker", name, f"{raw.values[worst]:g}", number=worst + 1)


def _check_rows(time: Floats, step: float, name: str) -> None:
    """Refuse a record in equal steps that lacks some: a straight line would stand for what was measured."""
    steps = np.diff(time)
    even = np.abs(steps - step) <= _EVEN * step
    if time.size <= _FEW or even.mean() < _MOSTLY:
        return
    # What stands before the first moving sample, or behind the last one, may be one long step of nothing.
    longest = int(np.argmax(steps[1:-1])) + 1
    if steps[longest] > _LACKING * step:
        raise InputError(
            "record-rows-missing", name, start=f"{time[longest]:g}", end=f"{time[longest + 1]:g}", step=f"{step:g}"
        )


def _unit(raw: RawRecord, name: str, peak: float, options: Options) -> tuple[str, str, tuple[Notice, ...]]:
    """The unit of the values, how it is known, and a warning if it is only assumed."""
    field = f"{options.field}.unit"
    if raw.unit:
        if options.unit and _si(options.unit, field, options) != _si(raw.unit, name, options):
            raise InputError("record-unit-conflict", field, options.unit, stated=raw.unit, name=name)
        return raw.unit, raw.unit, ()
    if options.unit:
        return options.unit, f"{options.unit} (as given)", ()
    likely = _likely_unit(peak)
    if likely and options.assume:
        return (
            likely,
            f"{likely} (assumed)",
            (Notice("record-unit-assumed", field=field, name=name, unit=likely),),
        )
    guess = f'probably unit = "{likely}"' if likely else 'unit = "m/s^2", or "g" or "cm/s^2"'
    raise InputError("record-unit-missing", name, f"{peak:.4g}", unit_field=field, guess=guess)


def _si(unit: str, field: str, options: Options) -> float:
    return acceleration_unit(unit, field).si(options.gravity)


def _likely_unit(peak: float) -> str | None:
    # Hardly any ground has passed 1.3 g; a few m/s^2 are a common peak, and a few g a grave mistake.
    if peak < 1.3:
        return "g"
    return "cm/s^2" if peak > 20.0 else None


def _time(raw: RawRecord, name: str, options: Options) -> tuple[Floats, tuple[Notice, ...]]:
    """The moments of the values, and a warning if their step is only assumed."""
    if raw.time is not None:
        with np.errstate(invalid="ignore", over="ignore"):
            gap = float(np.abs(np.diff(raw.time)).max())
        middle = float(np.median(np.diff(raw.time)))
        if gap > _LARGEST_GAP or middle > _LONGEST_STEP:
            raise InputError("record-step", name, f"{gap if gap > _LARGEST_GAP else middle:g} s")
        _check_rows(raw.time, middle, name)
        return raw.time, ()
    step, field = raw.time_step or options.time_step, f"{options.field}.time_step"
    warnings: tuple[Notice, ...] = ()
    if step is None and options.assume:
        step = _LIKELY_STEP
        warnings = (Notice("record-step-assumed", field=field, name=name, step_s=step),)
    if step is None:
        raise InputError(
            "record-counts-samples" if raw.counts_samples else "record-step-missing", name, step_field=field
        )
    if raw.time_step and options.time_step and abs(raw.time_step - options.time_step) > 1e-9 * options.time_step:
        raise InputError("record-step-conflict", field, f"{options.time_step:g} s", stated=raw.time_step)
    if not 1e-6 <= step <= _LONGEST_STEP:
        raise InputError("record-step", name, f"{step:g} s")
    return np.arange(raw.values.size, dtype=np.float64) * step, warnings
