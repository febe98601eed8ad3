"""From a record as it stands in its file, and what the caller tells of it, to a ground motion in SI units."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from heeltoe.base.arrays import Floats, median
from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.records import HeaderFactor
from heeltoe.motion.records.raw import PEAK, RawRecord, doubtful
from heeltoe.motion.records.stated import Written
from heeltoe.units.parse import STANDARD_GRAVITY, acceleration_unit
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice

# Beyond these the numbers are no record in any unit, and displacements would overflow.
_LARGEST_VALUE, _LARGEST_GAP = 1e12, 1e4
# No instrument for strong motion is slower [s].
_LONGEST_STEP = 1.0
# What stands for a missing value: nines alone, and far from all that was measured.
_NINES, _FAR = pattern(r"9{3,}(?:\.9*0*)?"), 1.5
_ENDING = pattern(r"\.(?:ns|ew|ud)[12]?", re.IGNORECASE)
# A record of more rows than these, nearly all of them a step apart within so much of it, lacks some where two are
# farther apart than this many steps.
_FEW, _EVEN, _MOSTLY, _LACKING = 20, 0.02, 0.9, 2.5
# The commonest of digitised records.
_LIKELY_STEP = 0.01
# Times that were rounded are within half of their last digit of equal steps, and a little for what floats lose.
_ROUNDED = 0.52
# Digits that times are printed with: decimals, or significant ones.
_DECIMALS, _SIGNIFICANT = range(0, 8), range(3, 8)
# Share of repeated moments beyond which they are no jumps.
_REPEATED = 0.02
# Peaks in g of strong motion, and the units in which records are written, with what one g is in them.
_WEAKEST, _STRONGEST = 0.005, 3.0
_IN_ONE_G = {"g": 1.0, "m/s^2": 9.80665, "cm/s^2": 980.665, "mm/s^2": 9806.65}
_IN_ONE_G_TOO = {"%g": 100.0}
# Differences of a stated peak or length beyond its rounding: up to the first it is the same, up to the second the
# file is said to contradict itself, beyond it is not what was read.
_SAME, _FAR_PEAK, _FAR_DURATION = 1e-3, 0.05, 0.01


@dataclass(frozen=True)
class Options:
    """Options of the caller for a record; see :func:`heeltoe.motion.records.read.read_record`. Options for `several`
    files hold for those that do not state the value themselves."""

    unit: str | None = None
    time_step: float | None = None
    gravity: float = STANDARD_GRAVITY
    field: str = "motion"
    assume: bool = False
    layout: str | None = None
    factor: float | HeaderFactor | None = None
    several: bool = False


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
        raise InputError("too-few", name, f"{raw.values.size} samples", least="two")
    if not np.isfinite(raw.values).all():
        bad = int(np.flatnonzero(~np.isfinite(raw.values))[0])
        raise InputError("motion-not-finite", name, str(raw.values[bad]), number=bad + 1)
    _check_markers(raw, name)
    peak = float(np.abs(raw.values).max())
    within, scaled = _factor(raw, name, options)
    time, done, unsure = _time(raw, name, options)
    _check_duration(raw.durations, time, name)
    unit, read_as, unsure_too = _unit(raw, name, peak * abs(within), options)
    factor = within * _si(unit, f"{options.field}.unit" if raw.unit is None else name, options)
    # A peak that was stated without its unit may be in any.
    held = _held_peak(raw.peaks, peak, factor, name, options, assumed=raw.unit is None)
    if peak * factor > _LARGEST_VALUE:
        raise InputError("motion-peak", name, f"{peak:.4g} {unit}", name="it")
    # K-NET and KiK-net tell the components of a station apart by the endings of their names alone.
    stem = Path(name).name if _ENDING.fullmatch(Path(name).suffix) else Path(name).stem
    measured = (Notice("record-uncorrected", name=name, why=raw.uncorrected),) if raw.uncorrected else ()
    return GroundMotion(
        name=f"{stem}-chan{raw.channel}" if channels > 1 else stem,
        time=time,
        acceleration=raw.values * factor,
        format=raw.format,
        units_as_read=read_as,
        source=name,
        channel=raw.channel,
        processing=(*raw.processing, *scaled, *done),
        warnings=(*raw.warnings, *held, *measured, *unsure, *unsure_too),
        begins=raw.begins,
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
    """Refuse a record in equal steps with missing rows: a straight line would replace measured values."""
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


def _factor(raw: RawRecord, name: str, options: Options) -> tuple[float, tuple[str, ...]]:
    """The factor of the values, which the user chooses where the file has one, and the notes on it."""
    field = f"{options.field}.factor"
    if options.factor is None:
        if raw.factor is not None:
            code = "record-factor-of-several" if options.several else "record-factor"
            raise InputError(code, name, f"{raw.factor:g}", factor_field=field)
        return 1.0, ()
    if isinstance(options.factor, str):
        if raw.factor is None:
            return 1.0, ()
        chosen = {"multiply": raw.factor, "divide": 1.0 / raw.factor, "contain": 1.0}[options.factor]
        return chosen, (f"values times {chosen:g}, by the factor {raw.factor:g} of its header",)
    if raw.factor is None:
        raise InputError(
            "option-foreign", field, f"{options.factor:g}", owner=f"{name}, whose header has no factor", remedy=""
        )
    # A sensitivity is what to divide by.
    allowed = (1.0, raw.factor, 1.0 / raw.factor)
    if not any(abs(options.factor - one) <= 1e-6 * abs(one) for one in allowed):
        raise InputError("record-factor-other", field, f"{options.factor:g}", name=name, stated=f"{raw.factor:g}")
    return options.factor, (f"values times {options.factor:g}, the factor of its header as given",)


def _check_duration(durations: tuple[Written, ...], time: Floats, name: str) -> None:
    """Refuse a record that is not as long as its header says, or one step longer."""
    length = float(time[-1] - time[0])
    step = length / (time.size - 1)
    if durations and not any(stated.agrees(length, _FAR_DURATION, 2.0 * step) for stated in durations):
        raise InputError(
            "record-states",
            name,
            f"{length:.6g} s",
            found="lasts",
            stated=f"{durations[0].value:g} s",
            doubtful="its time step",
        )


def _held_peak(
    peaks: tuple[Written, ...], peak: float, factor: float, name: str, options: Options, *, assumed: bool
) -> tuple[Notice, ...]:
    """Return a warning where no stated peak is that of the values, in the unit of the file or one that was `assumed`.

    Raises
    ------
    InputError
        Where they are so far apart that the values, or their unit, are not what the header speaks of.
    """
    if not peaks or peak == 0.0:
        return ()
    shares = {}
    for written in peaks:
        # A peak that is stated without its unit may be in that of the values, or in any.
        scales = [1.0, *(_si(unit, name, options) / factor for unit in _IN_ONE_G)]
        if written.unit:
            scales = [_si(written.unit, name, options) / factor]
        shares[written] = min((abs(written.value * scale - peak) - written.rounding * scale) / peak for scale in scales)
    stated = min(shares, key=shares.__getitem__)
    if shares[stated] <= _SAME:
        return ()
    # A look takes a unit that the user gives or it assumes, and says what does not fit.
    if shares[stated] > _FAR_PEAK and not (assumed and options.assume):
        raise InputError(
            "record-states",
            name,
            f"{peak:.4g} in its own unit",
            found="peaks at",
            stated=f"{stated.value:g} {stated.unit}".strip(),
            doubtful="its unit, its columns",
        )
    return (doubtful(name, PEAK, stated=stated.value, found=peak),)


def _unit(raw: RawRecord, name: str, peak: float, options: Options) -> tuple[str, str, tuple[Notice, ...]]:
    """The unit of the values, how it is known, and a warning if it is only assumed."""
    field = f"{options.field}.unit"
    stated = [raw.unit] if raw.unit else sorted(raw.named_units)
    if (
        options.unit
        and stated
        and not options.several
        and _si(options.unit, field, options) not in [_si(unit, name, options) for unit in stated]
    ):
        raise InputError("stated-otherwise", field, options.unit, name=name, stated=" and ".join(stated))
    if raw.unit:
        return raw.unit, raw.unit, ()
    if options.unit:
        return options.unit, f"{options.unit} (as given)", ()
    likely = _likely_unit(peak)
    if likely and options.assume and not stated:
        return (
            likely,
            f"{likely} (assumed)",
            (Notice("record-assumed", field=field, name=name, what="unit", assumed=likely),),
        )
    possible = (
        stated
        or [unit for unit, in_one_g in (_IN_ONE_G | _IN_ONE_G_TOO).items() if _WEAKEST <= peak / in_one_g <= _STRONGEST]
        or ["m/s^2", "g", "cm/s^2"]
    )
    guess = "unit = " + " or ".join(f'"{unit}"' for unit in possible)
    raise InputError("record-unit-missing", name, f"{peak:.4g}", unit_field=field, guess=guess)


def _si(unit: str, field: str, options: Options) -> float:
    return acceleration_unit(unit, field).si(options.gravity)


def _likely_unit(peak: float) -> str | None:
    # Hardly any ground has passed 1.3 g; a few m/s^2 are a common peak, and a few g a grave mistake.
    if peak < 1.3:
        return "g"
    return "cm/s^2" if peak > 20.0 else None


def _time(raw: RawRecord, name: str, options: Options) -> tuple[Floats, tuple[str, ...], tuple[Notice, ...]]:
    """The moments of the values, what was done to them, and a warning if their step is only assumed."""
    if raw.time is not None:
        time, done = _moments(raw.time, raw.time_step, name, options)
        return time, done, ()
    step, field = raw.time_step or options.time_step, f"{options.field}.time_step"
    warnings: tuple[Notice, ...] = ()
    if step is None and options.assume:
        step = _step_of_duration(raw) or _LIKELY_STEP
        warnings = (
            Notice(
                "record-assumed",
                field=field,
                name=name,
                what="time step",
                assumed=Sentence.of("{step_s:g s}", step_s=step),
            ),
        )
    if step is None:
        raise InputError(
            "record-counts-samples" if raw.counts_samples else "record-step-missing", name, step_field=field
        )
    given = None if options.several else options.time_step
    if raw.time_step and given and abs(raw.time_step - given) > 1e-9 * given:
        raise InputError(
            "stated-otherwise", field, f"{options.time_step:g} s", name="the file", stated=f"{raw.time_step} s"
        )
    if not 1e-6 <= step <= _LONGEST_STEP:
        raise InputError("record-step", name, f"{step:g} s")
    return np.arange(raw.values.size, dtype=np.float64) * step, (), warnings


def _step_of_duration(raw: RawRecord) -> float | None:
    """Return a step that people choose which makes the values as long as the file says; None where there is none."""
    count = raw.values.size
    for stated in raw.durations:
        for pieces in (count - 1, count):
            mean = stated.value / pieces
            if 0.0 < mean <= _LONGEST_STEP:
                steps = _plain_steps(mean, stated.rounding / pieces, None)
                if steps and steps[0] != mean:
                    return steps[0]
    return None


def _moments(time: Floats, stated: float | None, name: str, options: Options) -> tuple[Floats, tuple[str, ...]]:
    """Return the moments that a file has, in equal steps where they were printed with too few digits to show them."""
    with np.errstate(invalid="ignore", over="ignore"):
        steps = np.diff(time)
        gap, middle = float(np.abs(steps).max()), median(steps)
        mean = float((time[-1] - time[0]) / steps.size)
    if gap > _LARGEST_GAP or max(middle, mean if mean < middle else middle) > _LONGEST_STEP:
        raise InputError("record-step", name, f"{gap if gap > _LARGEST_GAP else middle:g} s")
    even, done = _evened(time, stated or options.time_step)
    field = f"{options.field}.time_step"
    given = None if options.several else options.time_step
    if given and not any(abs(found - given) <= 0.01 * found for found in (middle, mean)):
        raise InputError("stated-otherwise", field, f"{given:g} s", name="the file", stated=f"{mean:.6g} s")
    if done:
        return even, done
    _check_rows(time, middle, name)
    if time.size > _FEW and (steps == 0.0).mean() > _REPEATED:
        raise InputError("record-times-repeat", name, int((steps == 0.0).sum()))
    return time, ()


def _evened(time: Floats, stated: float | None) -> tuple[Floats, tuple[str, ...]]:
    """Return moments in equal steps, with a note, where these are such moments rounded; else unchanged.

    Rounding moves each moment by half of its last digit at most; of a record in unequal steps, or one that lacks rows,
    the moments walk away from any line by more.
    """
    if time.size <= _FEW or not np.isfinite(time).all():
        return time, ()
    steps, count = np.diff(time), time.size - 1
    mean = float((time[-1] - time[0]) / count)
    if not mean > 0.0 or float(steps.min()) < 0.0 or float(steps.max() - steps.min()) <= 1e-6 * mean:
        return time, ()
    number = np.arange(time.size, dtype=np.float64)
    for digit in _last_digits(time):
        for step in _plain_steps(mean, 2.0 * float(digit.max()) / count, stated):
            off = time - number * step
            # Where the first moment really is, to half of its digit.
            low, high = float((off - _ROUNDED * digit).max()), float((off + _ROUNDED * digit).min())
            # Cut off rather than rounded, all moments are early by up to a digit.
            early, late = float(off.max()), float((off + 2.0 * _ROUNDED * digit).min())
            if low <= high or early <= late:
                return number * step, (f"times printed with too few digits: equal steps of {step:.6g} s",)
    return time, ()


def _last_digits(time: Floats) -> Iterator[Floats]:
    """Walk the sizes of the last digit of each moment by the ways of printing that fit: decimals, or significant
    digits."""
    size = np.abs(time)
    for decimals in _DECIMALS:
        if (np.abs(time - np.round(time, decimals)) <= 1e-9 * np.maximum(size, 1.0)).all():
            yield np.full(time.size, 10.0**-decimals)
            break
    power = np.floor(np.log10(np.where(size > 0.0, size, 1.0)) + 1e-12)
    for digits in _SIGNIFICANT:
        digit = 10.0 ** (power - digits + 1)
        if (np.abs(time / digit - np.rint(time / digit)) <= 1e-6 * np.maximum(1.0, np.abs(time / digit))).all():
            yield digit
            break


def _plain_steps(mean: float, unsure: float, stated: float | None) -> list[float]:
    """Return the steps that equal ones may have: the stated one, those that people choose, and the mean, in this order.

    People choose a whole number in a second, or few digits.
    """
    rate = round(1.0 / mean) if mean > 1e-9 else 0
    chosen = [stated, 1.0 / rate if rate else None, *(round(mean, digits) for digits in range(1, 7)), mean]
    return [step for step in chosen if step and abs(step - mean) <= unsure]
