"""Measures of a ground motion: intensity, duration, frequency content; exact for straight pieces where stated."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

import numpy as np

from heeltoe.base.arrays import Floats, median
from heeltoe.base.blocks import Block, Number
from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import GroundMotion, integrals
from heeltoe.units.parse import STANDARD_GRAVITY

# Samples up to which zeros behind a record cost nothing to speak of: some 20 MB.
_PADDED = 1 << 20
# Samples of which medians tell a level, and rounds after which a trend no longer changes.
_FEWEST, _ROUNDS = 30, 20


def velocity_displacement(motion: GroundMotion) -> tuple[Floats, Floats]:
    """Return velocity [m/s] and displacement [m] from rest at the moments of the motion, exactly; of a sequence those
    of each of its motions from rest, and nothing in the pauses: the ground does not drift on there."""
    if not motion.parts:
        return integrals(motion.time, motion.acceleration)
    velocity, displacement = np.zeros(motion.time.size), np.zeros(motion.time.size)
    for part in motion.parts:
        here = motion.part_slice(part)
        velocity[here], displacement[here] = integrals(motion.time[here], motion.acceleration[here])
    return velocity, displacement


def level_of(motion: GroundMotion) -> tuple[float, float]:
    """Return the level at which a record in equal steps rests [m/s2] and the trend of it [m/s3].

    It is the resistant line of Tukey (1977): its slope is that between the medians of the first and the last third, its
    height in the middle the median of what remains. The strong part of a record and pulses to one side, which shift a
    mean, hardly move it. A motion drawn by points rests at zero by what points mean.
    """
    values = motion.acceleration
    if motion.format == "points" or values.size < _FEWEST:
        return 0.0, 0.0
    third, place = values.size // 3, motion.time - motion.duration / 2.0
    away = place[-third:].mean() - place[:third].mean()
    slope, rest = 0.0, values
    # The medians of thirds with a trend in them are not its own; a few rounds find it.
    for _ in range(_ROUNDS):
        more = float((median(rest[-third:]) - median(rest[:third])) / away)
        slope, rest = slope + more, rest - more * place
    return median(rest), slope


def husid(motion: GroundMotion) -> Floats:
    """Return the integral of the squared acceleration up to each moment [m2/s3], exactly."""
    a0, a1 = motion.acceleration[:-1], motion.acceleration[1:]
    return np.concatenate([[0.0], np.cumsum(np.diff(motion.time) * (a0**2 + a0 * a1 + a1**2) / 3.0)])


def arias_intensity(motion: GroundMotion, gravity: float = STANDARD_GRAVITY) -> float:
    """Return the Arias intensity [m/s], pi / (2 g) times the integral of a^2 (Arias 1970), exactly."""
    return float(np.pi / (2.0 * gravity) * husid(motion)[-1])


def husid_time(motion: GroundMotion, share: float) -> float:
    """Return the moment [s] at which `share` of the Arias intensity has come in.

    The Husid curve is a cubic in each straight piece; its crossing is found by bisection to the last bit.
    """
    curve = husid(motion)
    if curve[-1] == 0.0:
        raise InputError("order-zero", "", motion.name)
    level = share * curve[-1]
    k = int(np.clip(np.searchsorted(curve, level) - 1, 0, curve.size - 2))
    h = motion.time[k + 1] - motion.time[k]
    a0, rise = motion.acceleration[k], motion.acceleration[k + 1] - motion.acceleration[k]
    low, high = 0.0, 1.0
    while low < (middle := (low + high) / 2.0) < high:
        reached = curve[k] + h * middle * (a0**2 + a0 * rise * middle + rise**2 * middle**2 / 3.0)
        low, high = (middle, high) if reached < level else (low, middle)
    return float(motion.time[k] + high * h)


def significant_duration(motion: GroundMotion, start: float = 0.05, end: float = 0.95) -> float:
    """Return the time [s] between two shares of the Arias intensity (Trifunac and Brady 1975), exactly."""
    return husid_time(motion, end) - husid_time(motion, start)


def cumulative_absolute_velocity(motion: GroundMotion) -> float:
    """Return the integral of |a| [m/s] (EPRI 1988), exactly."""
    a0, a1 = motion.acceleration[:-1], motion.acceleration[1:]
    size = np.abs(a0) + np.abs(a1)
    # A piece that changes sign is two triangles over parts of h that are as |a0| to |a1|.
    crossing = (a0**2 + a1**2) / np.where(size > 0.0, size, 1.0)
    return float(np.sum(np.diff(motion.time) * np.where(a0 * a1 < 0.0, crossing, size) / 2.0))


def uniform(motion: GroundMotion) -> GroundMotion:
    """Return the motion in equal steps, refined where its steps differ; refining is exact.

    Raises
    ------
    InputError
        Where it jumps, or no step down to a hundredth of its smallest divides all its steps.
    """
    if motion.is_uniform:
        return motion
    steps = np.diff(motion.time)
    if (steps > 0.0).all():
        for parts in range(1, 101):
            step = float(steps.min()) / parts
            # Few records have a million samples; a step that asks for more is none that was meant.
            if motion.duration / step > 1e6:
                break
            ratio = steps / step
            if (np.abs(ratio - np.rint(ratio)) <= 1e-6 * ratio).all():
                return motion.resampled(step)
    raise InputError("order-uniform", "", motion.name)


def fourier_amplitudes(
    motion: GroundMotion, resolution: float | None = None, band: tuple[float, float] = (0.0, np.inf)
) -> tuple[Floats, Floats]:
    """Return the Fourier amplitude spectrum, |dt DFT(a)|, as is usual for records.

    Memory grows with the samples and the frequencies of the band, not with the zeros behind the record: a motion of a
    few samples that are a nanosecond apart has as few frequencies in a band as any other.

    Parameters
    ----------
    motion
        In steps of its own; refined to equal ones where they differ.
    resolution
        Largest step of frequency [Hz]; zeros behind the record make it finer.
    band
        Lowest and highest frequency [Hz]; bounded where a resolution is wanted.

    Returns
    -------
    frequency, amplitude
        In Hz, from 0 to the Nyquist frequency at most, and in m/s.
    """
    motion = uniform(motion)
    size = motion.time.size
    if resolution is not None:
        size = max(size, int(np.ceil(1.0 / (resolution * motion.dt))))
    step = 1.0 / (size * motion.dt)
    if size <= max(_PADDED, 4 * motion.time.size):
        amplitude: Floats = motion.dt * np.abs(np.fft.rfft(motion.acceleration, size))
        frequency: Floats = np.arange(amplitude.size, dtype=np.float64) * step
        inside = (frequency >= band[0]) & (frequency <= band[1])
        return frequency[inside], amplitude[inside]
    first, last = np.ceil(band[0] / step), np.floor(min(band[1] / step, size / 2))
    wanted: Floats = np.arange(first, last + 1.0) * step
    # A chirp transform: each frequency by a sum of its own takes 10 s for a million samples.
    from scipy.signal import zoom_fft

    bounds, count = [first * step, (first + max(wanted.size, 1)) * step], max(wanted.size, 1)
    sums: Floats = np.abs(zoom_fft(motion.acceleration, bounds, count, fs=1.0 / motion.dt))[: wanted.size]
    return wanted, motion.dt * sums


def mean_period(motion: GroundMotion) -> float:
    """Return the mean period [s]: sum of C^2 / f over sum of C^2, from 0.25 Hz to 20 Hz.

    After Rathje et al. (2004), who ask for steps of frequency of at most 0.05 Hz.
    """
    frequency, amplitude = fourier_amplitudes(motion, resolution=0.05, band=(0.25, 20.0))
    power = amplitude**2
    if power.sum() == 0.0:
        raise InputError("order-zero", "", motion.name)
    return float(np.sum(power / frequency) / power.sum())


class Measures(Block):
    """All measures of a motion."""

    duration_s: Annotated[float, Number("Length of the motion.", "s")]
    pga_m_s2: Annotated[float, Number("Peak acceleration, without sign.", "m/s²")]
    pgv_m_s: Annotated[float, Number("Peak velocity.", "m/s")]
    pgd_m: Annotated[float, Number("Peak displacement, by integration from rest.", "m")]
    arias_intensity_m_s: Annotated[float, Number("Arias intensity.", "m/s")]
    cav_m_s: Annotated[float, Number("Cumulative absolute velocity.", "m/s")]
    end_velocity_m_s: Annotated[float, Number("Velocity at the end: what a sound record leaves is small.", "m/s")]
    end_displacement_m: Annotated[float, Number("Displacement at the end, from rest.", "m")]
    significant_duration_s: Annotated[
        float | None, Number("Time in which 5 to 95 % of the Arias intensity come in.", "s", optional=True)
    ]
    mean_period_s: Annotated[float | None, Number("Mean period of the Fourier amplitudes.", "s", optional=True)]


def measures(motion: GroundMotion, gravity: float = STANDARD_GRAVITY) -> Measures:
    """Return all measures.

    The mean period is left out where the motion jumps and so has no samples to take a Fourier transform of, and
    durations and periods of a motion that is zero throughout.
    """
    velocity, displacement = velocity_displacement(motion)
    return Measures(
        duration_s=motion.duration,
        pga_m_s2=motion.pga,
        pgv_m_s=motion.pgv,
        pgd_m=motion.pgd,
        arias_intensity_m_s=arias_intensity(motion, gravity),
        cav_m_s=cumulative_absolute_velocity(motion),
        end_velocity_m_s=float(velocity[-1]),
        end_displacement_m=float(displacement[-1]),
        significant_duration_s=_known(significant_duration, motion),
        mean_period_s=_known(mean_period, motion),
    )


def _known(measure: Callable[[GroundMotion], float], motion: GroundMotion) -> float | None:
    try:
        return measure(motion)
    except InputError as error:
        if error.code not in ("order-zero", "order-uniform"):
            raise
        return None
