"""When two components of one earthquake begin: by their headers, and by the shape of their shaking."""

from __future__ import annotations

import re
from collections.abc import Sequence
from datetime import datetime

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import GroundMotion

_MOMENT = re.compile(r"(\d{4})\D?(\d\d)\D?(\d\d)\D{1,2}(\d\d)\D?(\d\d)\D?(\d\d)(\.\d+)?")
# Width of the window over which the size of a component is averaged [s]. Of 21 pairs of records the sizes so smoothed
# are best alike at a lag of 0.7 s at most, with a correlation of 0.84 or more; with one of a pair moved by 3 s the
# correlation at the right lag is higher than at none by 0.045 in all but one.
_WINDOW, _LEAST_LAG, _ALIKE, _GAIN = 0.5, 1.5, 0.8, 0.045
# Most values of a series that is correlated.
_MOST = 20_000


def moment_of(text: str) -> float | None:
    """Return a date with a time of day as seconds since 1970, by its own clock; None without one."""
    match = _MOMENT.search(text)
    if match is None:
        return None
    try:
        day = datetime(*(int(match[k]) for k in range(1, 7)))  # type: ignore[arg-type]
    except ValueError:
        return None
    return (day - datetime(1970, 1, 1)).total_seconds() + float(match[7] or 0.0)


def begun_together(motions: Sequence[GroundMotion], fields: Sequence[str]) -> list[GroundMotion]:
    """Return the components of one earthquake on one clock: those that begin later than others, by the headers of the
    same format, with the ground at rest before them; one whose header does not tell begins with the first.

    Parameters
    ----------
    motions
        The first is that along the stream.
    fields
        Where they stand.

    Raises
    ------
    InputError
        Where one begins after the first has ended, or has ended before.
    """
    first, late = motions[0], list[float]()
    for motion, field in zip(motions, fields, strict=False):
        known = motion.begins is not None and first.begins is not None and motion.format == first.format
        # A sum of so many seconds has no digits below some tenths of a microsecond.
        late.append(round((motion.begins or 0.0) - (first.begins or 0.0), 6) if known else 0.0)
        if late[-1] >= first.duration or -late[-1] >= motion.duration:
            raise InputError(
                "another-kind",
                field,
                f"a record that begins {abs(late[-1]):.4g} s {'after' if late[-1] > 0.0 else 'before'} {first.name}",
                wanted="one that was recorded with it",
                remedy="give the component of the same earthquake",
            )
    earliest = min(late)
    return [
        motion.after_rest(own - earliest, "as it begins so much later than the other component by its header")
        for own, motion in zip(late, motions, strict=True)
    ]


def lag_of(one: GroundMotion, other: GroundMotion) -> float | None:
    """Return how much later the second of two components shakes than the first [s], where that is clear from the
    correlation of their sizes, each smoothed over half a second; else None.

    Components of one instrument differ in sign and shape, yet grow and fade together.
    """
    end = max(one.duration, other.duration)
    step = max(one.dt, other.dt, 0.01, end / _MOST)
    time = np.arange(0.0, end, step)
    width = max(1, round(_WINDOW / step))
    first, second = (_size(motion, time, width) for motion in (one, other))
    whole = float(np.sqrt((first @ first) * (second @ second)))
    if whole == 0.0 or time.size < 2 * width:
        return None
    count = 2 * time.size
    spectrum = np.conj(np.fft.rfft(first, count)) * np.fft.rfft(second, count)
    alike = np.fft.irfft(spectrum, count) / whole
    best = int(alike.argmax())
    lag = step * (best - count if best > time.size else best)
    if abs(lag) < _LEAST_LAG or alike[best] < _ALIKE or alike[best] - alike[0] < _GAIN:
        return None
    return float(lag)


def _size(motion: GroundMotion, time: Floats, width: int) -> Floats:
    """Return the root of the mean square of a motion about each moment."""
    values = np.interp(time, motion.time, motion.acceleration, left=0.0, right=0.0)
    window = np.hanning(width + 2)[1:-1]
    mean: Floats = np.convolve(values**2, window / window.sum(), "same")
    return np.sqrt(mean)
