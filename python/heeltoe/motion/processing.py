"""Processing of a ground motion: each step is called by name, and records in `processing` how it changed the motion.

Errors name the parameter that cannot be; :func:`process` puts before it where the step stands.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Literal, Protocol

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import GroundMotion, integrals
from heeltoe.motion.measures import arias_intensity, fourier_amplitudes, husid_time, level_of, measures, uniform
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.warnings.notice import Notice

__all__ = [
    "Step",
    "band_pass",
    "baseline",
    "cut_significant",
    "cut_to_window",
    "fourier_amplitudes",
    "measures",
    "process",
    "scale_time",
    "scale_to_arias",
    "scale_to_spectrum",
    "taper",
]

Ends = Literal["both", "start", "end"]


class Step(Protocol):
    """One step of processing; those of a case file are in :mod:`heeltoe.case.processing`."""

    def apply(self, motion: GroundMotion, gravity: float) -> GroundMotion:
        """Return the processed motion, where one g is `gravity` [m/s2]."""


def process(
    motion: GroundMotion, steps: Sequence[Step], gravity: float = STANDARD_GRAVITY, *, field: str = "processing"
) -> GroundMotion:
    """Apply `steps` in their order; `field` is where they stand in the case, for errors."""
    for place, step in enumerate(steps):
        try:
            motion = step.apply(motion, gravity)
        except InputError as error:
            error.field = ".".join(part for part in (f"{field}[{place}]", error.field) if part)
            raise
    return motion


def baseline(motion: GroundMotion, order: int = 2, *, displacement: bool = False) -> GroundMotion:
    """Take a polynomial of time out of the velocity, so that the motion ends at rest.

    The polynomial, of degree `order` and zero at the start, is the one nearest to the velocity in the sense of
    least squares over time among those that meet it at the end; the acceleration loses its derivative. After
    Boore (2001), who fits quadratic velocities to the Chi-Chi records, with the end held.

    Each power is integrated as the straight pieces it becomes between the moments, so that the end velocity is zero
    to rounding for any steps.

    Parameters
    ----------
    motion
        The motion.
    order
        Degree of the polynomial, from 1.
    displacement
        Hold the end displacement to zero too; `order` is at least 2 then.
    """
    if order < 1 + displacement or order > 10:
        raise InputError("out-of-range", "order", order, bound=f"from {1 + displacement} to 10")
    share = motion.time / motion.duration
    # Legendre polynomials as accelerations: they span the same space as powers and do not become alike.
    powers = [np.polynomial.Legendre.basis(k)(2.0 * share - 1.0) for k in range(order)]
    moved = [integrals(motion.time, power) for power in powers]
    velocity, place = integrals(motion.time, motion.acceleration)
    fit = np.array([v for v, _ in moved])
    held = [[v[-1] for v, _ in moved]] + ([[d[-1] for _, d in moved]] if displacement else [])
    ends = [velocity[-1]] + ([place[-1]] if displacement else [])
    steps = np.diff(motion.time)
    weight = np.zeros(motion.time.size)
    weight[:-1] += steps / 2.0
    weight[1:] += steps / 2.0
    # Least squares with equality constraints: null-space method, as it keeps the constraints to rounding.
    constraint = np.array(held)
    start = np.linalg.lstsq(constraint, np.array(ends), rcond=None)[0]
    free = np.linalg.svd(constraint)[2][len(ends) :].T
    if free.size:
        root = np.sqrt(weight)
        start = start + free @ np.linalg.lstsq((fit.T @ free) * root[:, None], root * (velocity - fit.T @ start))[0]
    taken = start @ np.array(powers)
    also = " and displacement" if displacement else ""
    step = f"baseline: polynomial of degree {order} taken from the velocity, end velocity{also} zero"
    return replace(
        motion.corrected(),
        acceleration=motion.acceleration - taken,
        processing=(*motion.processing, f"{step} (was {ends[0]:.4g} m/s)"),
    )


# Of the peak; what the filter puts beside the record below this moves displacements by less than a hundredth.
_FADED = 1e-6
# Zeros on either side of a record that is filtered: a corner that asks for more is far slower than any record is long.
_MOST_ZEROS = 5_000_000


def band_pass(
    motion: GroundMotion, low: float | None = None, high: float | None = None, order: int = 4
) -> GroundMotion:
    """Filter with a Butterworth filter, forward and backward, so that phases stay (scipy's sosfiltfilt).

    With a corner `low`, the level at which the record rests goes first, a resistant line (Tukey, 1977; see
    :func:`heeltoe.motion.measures.level_of`): padded with zeros, an offset would have edges that the filter takes for
    shocks. A pulse to one side, which shifts a mean, hardly moves that line. Then the record fades in up to its first
    change of sign and out from its last one, a twentieth of it at most, where Converse and Brady (1992) begin and end
    it.

    Before and after the record stand 1.5 `order` / `low` seconds of zeros, their rule. The filter's motion there
    belongs to the motion: cut off, it leaves a velocity behind that makes displacements several times too large. So it
    stays, up to where it falls below a millionth of the peak, and `lead` of the motion says how much of it stands
    before the record. The two passes together have twice the order; each corner is down by half (6 dB).

    Parameters
    ----------
    motion
        The motion; refined to equal steps where its steps differ.
    low, high
        Corner frequencies [Hz]; without `low` a low-pass, without `high` a high-pass.
    order
        Of one pass.

    Raises
    ------
    InputError
        Where there is no corner, one is at or beyond the Nyquist frequency or so slow that there is no end of zeros, or
        they are in the wrong order.
    """
    # scipy.signal takes longer to load than a rigid run does, so it waits for the first filter.
    from scipy import signal

    motion = uniform(motion)
    nyquist = 0.5 / motion.dt
    if low is None and high is None:
        raise InputError("order-corner-missing", "")
    for name, corner in (("low", low), ("high", high)):
        if corner is not None and not 0.0 < corner < nyquist:
            raise InputError("order-corner", name, f"{corner:g} Hz", nyquist=f"{nyquist:g} Hz")
    if low is not None and high is not None and low >= high:
        raise InputError("out-of-range", "low", f"{low:g} Hz", bound=f"below high, {high:g} Hz")
    if not 1 <= order <= 10:
        raise InputError("out-of-range", "order", order, bound="from 1 to 10")
    corners = [corner for corner in (low, high) if corner is not None]
    zeros = math.ceil(1.5 * order / corners[0] / motion.dt)
    if zeros > _MOST_ZEROS:
        slowest = f"{1.5 * order / _MOST_ZEROS / motion.dt:.2g} Hz"
        raise InputError("order-corner-slow", "high" if low is None else "low", f"{corners[0]:g} Hz", least=slowest)
    kind = "bandpass" if len(corners) == 2 else "highpass" if high is None else "lowpass"
    sections = signal.butter(
        order, corners if len(corners) == 2 else corners[0], kind, fs=1.0 / motion.dt, output="sos"
    )
    rested, taken = (motion.acceleration, "") if low is None else _at_rest(motion)
    filtered = signal.sosfiltfilt(sections, np.pad(rested, zeros), padlen=0)
    size = np.abs(filtered)
    felt = np.flatnonzero(size > _FADED * size.max())
    first = min(zeros, int(felt[0])) if felt.size else zeros
    last = max(zeros + motion.time.size - 1, int(felt[-1])) if felt.size else zeros + motion.time.size - 1
    before, behind = (zeros - first) * motion.dt, (last - zeros - motion.time.size + 1) * motion.dt
    beside = np.concatenate([size[first:zeros], size[zeros + motion.time.size : last + 1]]).max(initial=0.0)
    felt_there = f", with up to {beside / size.max():.2g} of the peak" if beside > 0.0 else ""
    band = " to ".join(f"{corner:g}" for corner in corners)
    step = (
        f"{kind} {band} Hz (Butterworth of order {order}, forward and backward, {taken}"
        f"{zeros * motion.dt:g} s of zeros on either side, of which {before:.4g} s before and {behind:.4g} s behind "
        f"the record stay{felt_there})"
    )
    return replace(
        motion if low is None else motion.corrected(),
        time=motion.dt * np.arange(last - first + 1, dtype=np.float64),
        acceleration=filtered[first : last + 1],
        lead=motion.lead + before,
        processing=(*motion.processing, step),
    )


# Share of a record that may fade at either end before it is filtered.
_FADES = 0.05


def _at_rest(motion: GroundMotion) -> tuple[Floats, str]:
    """Return the accelerations without the level that they rest at, faded in and out, and a word on both."""
    level, slope = level_of(motion)
    values = motion.acceleration - level - slope * (motion.time - motion.duration / 2.0)
    most = max(1, int(_FADES * values.size))
    turns = np.flatnonzero(np.signbit(values[1:]) != np.signbit(values[:-1])) + 1
    first = min(int(turns[0]), most) if turns.size else most
    last = min(values.size - int(turns[-1]), most) if turns.size else most
    values[:first] *= 0.5 - 0.5 * np.cos(np.pi * np.arange(first) / first)
    values[values.size - last :] *= 0.5 + 0.5 * np.cos(np.pi * np.arange(1, last + 1) / last)
    trend = f" and a trend of {slope:.3g} m/s3" if slope else ""
    fades = f"faded over its first {first * motion.dt:.3g} s and last {last * motion.dt:.3g} s"
    return values, f"after a level of {level:.4g} m/s2{trend} was taken out of the record and it was {fades}, "


def taper(motion: GroundMotion, share: float = 0.05, ends: Ends = "both") -> GroundMotion:
    """Fade the motion in and out with half a cosine (Tukey) over `share` of its duration at each of the given ends."""
    if not 0.0 < share <= 0.5:
        raise InputError("out-of-range", "share", f"{share:g}", bound="above 0 and up to 0.5")
    place = motion.time / motion.duration
    weight = np.ones_like(place)
    if ends in ("both", "start"):
        weight *= 0.5 - 0.5 * np.cos(np.pi * (np.minimum(place, share) / share))
    if ends in ("both", "end"):
        weight *= 0.5 - 0.5 * np.cos(np.pi * (np.minimum(1.0 - place, share) / share))
    where = "both ends" if ends == "both" else f"the {ends}"
    return replace(
        motion,
        acceleration=motion.acceleration * weight,
        processing=(*motion.processing, f"cosine taper over {share:.4g} of the duration at {where}"),
    )


def cut_significant(motion: GroundMotion, start: float = 0.05, end: float = 0.95) -> GroundMotion:
    """Keep what lies between two shares of the Arias intensity, with samples right at the cuts."""
    if not 0.0 <= start < end <= 1.0:
        raise InputError("out-of-range", "start", f"{start:g}", bound=f"from 0 to below end, {end:g}")
    first, last = husid_time(motion, start), husid_time(motion, end)
    inside = (motion.time > first) & (motion.time < last)
    edges = np.interp([first, last], motion.time, motion.acceleration)
    step = f"cut to {start:g} to {end:g} of the Arias intensity, {first:.6g} s to {last:.6g} s"
    return replace(
        motion,
        time=np.concatenate([[first], motion.time[inside], [last]]) - first,
        acceleration=np.concatenate([edges[:1], motion.acceleration[inside], edges[1:]]),
        lead=0.0,
        begins=_begins_later(motion, first - motion.lead),
        processing=(*motion.processing, step),
    )


def cut_to_window(motion: GroundMotion, start: float = 0.0, end: float | None = None) -> GroundMotion:
    """Keep what lies between two moments [s] of the record, with samples right at the cuts; without an `end`, all after
    `start`, and from a start of zero what a filter has put before the record too."""
    last = motion.duration if end is None else min(end + motion.lead, motion.duration)
    first = start + motion.lead if start > 0.0 else 0.0
    if not (start >= 0.0 and first < last):
        raise InputError("order-window", "start", f"{start:g} s", end=f"{last - motion.lead:g} s")
    left = motion.cut(last)
    inside = left.time > first
    edge = np.interp(first, left.time, left.acceleration)
    until = last - motion.lead
    step = f"cut to {start:g} s to {until:g} s" if last < motion.duration else f"without its first {start:g} s"
    return replace(
        left,
        time=np.concatenate([[0.0], left.time[inside] - first]),
        acceleration=np.concatenate([[edge], left.acceleration[inside]]),
        lead=motion.lead if start == 0.0 else 0.0,
        begins=_begins_later(motion, start),
        processing=(*motion.processing, step),
    )


def _begins_later(motion: GroundMotion, seconds: float) -> float | None:
    """Return when a motion begins that has lost the first seconds of its record."""
    return None if motion.begins is None else motion.begins + seconds


def scale_to_arias(motion: GroundMotion, intensity: float, gravity: float = STANDARD_GRAVITY) -> GroundMotion:
    """Scale to an Arias intensity [m/s]."""
    if not intensity > 0.0:
        raise InputError("out-of-range", "intensity", f"{intensity:g} m/s", bound="above 0")
    if motion.pga == 0.0:
        raise InputError("order-zero", "", motion.name)
    factor = float(np.sqrt(intensity / arias_intensity(motion, gravity)))
    return motion.scaled(factor, f"scaled by {factor:.6g} to an Arias intensity of {intensity:.6g} m/s")


def scale_to_spectrum(motion: GroundMotion, period: float, acceleration: float, damping: float = 0.05) -> GroundMotion:
    """Scale to a spectral pseudo-acceleration [m/s2] at one period [s] and damping ratio."""
    if not acceleration > 0.0:
        raise InputError("out-of-range", "acceleration", f"{acceleration:g} m/s2", bound="above 0")
    if motion.pga == 0.0:
        raise InputError("order-zero", "", motion.name)
    factor = acceleration / float(response_spectrum(motion, [period], damping).pseudo_acceleration[0])
    purpose = f"to a pseudo-acceleration of {acceleration:.6g} m/s2 at {period:g} s and {damping:.3%} damping"
    return motion.scaled(factor, f"scaled by {factor:.6g} {purpose}")


def scale_time(motion: GroundMotion, factor: float, *, allow: bool = False) -> GroundMotion:
    """Stretch time by `factor`, which divides all frequencies by it; refused unless `allow` says it is meant."""
    if not 0.01 <= factor <= 100.0:
        raise InputError("out-of-range", "factor", f"{factor:g}", bound="from 0.01 to 100")
    if not allow:
        raise InputError("order-time", "allow", f"{factor:g}")
    step = f"time stretched by {factor:.6g}: all its frequencies are divided by that"
    stretched = replace(
        motion, time=motion.time * factor, lead=motion.lead * factor, processing=(*motion.processing, step)
    )
    return stretched.with_warnings(
        Notice("motion-unlike-records", "stretched", field="motion.processing", name=motion.name, factor=factor)
    )
