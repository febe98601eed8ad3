"""Motion of the crest as people, gates and instruments there feel it, from the computed motion.

A blow lasts as long as a program resolves it, and so its acceleration alone is no number of a dam. Accelerations are
those up to :data:`BAND_HZ`: they pass a Butterworth filter of order 4 forward and backward, ``1 / (1 + (f/50 Hz)^8)``,
without a shift in time. What comes out does not depend on the spacing of histories, and hardly on the time step.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Block, Number

#: Its largest numbers as columns of studies.
CREST_PEAKS = ("crest_displacement_m", "crest_acceleration_g")
#: Its columns of the histories.
DISPLACEMENT, ACCELERATION = "crest_displacement_m", "crest_acceleration_m_s2"
#: Up to which frequency accelerations of the crest count [Hz].
BAND_HZ = 50.0
#: How often the crest of a block is looked at [s]; an elastic dam has a place of its crest at each step.
LOOKS_S = 1e-3
# The filter has forgotten after this time [s] all but a hundred-thousandth of a blow.
_MEMORY_S = 0.1
_ORDER = 4


class CrestMotion(Block):
    """How far and how hard the upstream edge of the crest moves."""

    displacement_m: Annotated[
        float,
        Number(
            "Largest horizontal displacement from where it stands before the earthquake, relative to the ground, of "
            "all computed steps (of a block: every millisecond).",
            "m",
        ),
    ]
    residual_displacement_m: Annotated[
        float, Number("Where it is at the end of the run, positive downstream: of a dam that slips mostly slip.", "m")
    ]
    acceleration_g: Annotated[
        float,
        Number(
            "Largest horizontal acceleration with that of the ground, of all computed steps (of a block: every "
            "millisecond), in the band up to 50 Hz: Butterworth of order 4, forward and backward. It is the same for "
            "every output step.",
            "g",
        ),
    ]
    amplification: Annotated[
        float | None,
        Number("How many times the peak of the ground in the same band that is; null where the ground stands still."),
    ]


@dataclass(frozen=True, eq=False)
class CrestSeries:
    """The way of the crest at even moments.

    Attributes
    ----------
    step
        Between the moments, the first of which is zero [s].
    displacement
        (n,) from its first place, relative to the ground, positive downstream [m].
    acceleration, ground
        (n,) acceleration with that of the ground, and that of the ground alone, both up to :data:`BAND_HZ` [m/s2].
    """

    step: float
    displacement: Floats
    acceleration: Floats
    ground: Floats

    def motion(self, gravity: float, residual: float | None = None) -> CrestMotion:
        """Return the largest numbers; `gravity` is one g [m/s2], `residual` where it is at the end, if that is not the
        last of the moments [m]."""
        largest, ground = (float(np.abs(values).max(initial=0.0)) for values in (self.acceleration, self.ground))
        return CrestMotion(
            displacement_m=float(np.abs(self.displacement).max(initial=0.0)),
            residual_displacement_m=float(self.displacement[-1]) if residual is None else residual,
            acceleration_g=largest / gravity,
            amplification=largest / ground if ground else None,
        )

    def histories(self, moments: Floats, displacement: Floats | None = None) -> dict[str, Floats]:
        """Return the columns of the histories at some moments [s]; with the `displacement` there, if it is known."""
        time = even_moments(self.step, self.displacement.size)
        if displacement is None:
            displacement = np.interp(moments, time, self.displacement)
        return {DISPLACEMENT: displacement, ACCELERATION: np.interp(moments, time, self.acceleration)}


def even_moments(step: float, count: int) -> Floats:
    """Return `count` moments from zero on, one `step` apart [s]."""
    moments = np.arange(count, dtype=np.float64)
    moments *= step
    return moments


def crest_series(step: float, place: Floats, ground: Floats) -> CrestSeries:
    """Return the way of the crest.

    Parameters
    ----------
    step
        Between the moments, the first of which is zero [s].
    place
        (n,) where it is relative to the ground, from anywhere, positive downstream [m].
    ground
        (n,) horizontal acceleration of the ground [m/s2].

    Returns
    -------
    CrestSeries
        Its own acceleration is its change of velocity between the middles of the neighbouring steps, which is exact in
        the mean, and none at both ends.
    """
    displacement: Floats = place - place[0]
    both: Floats = np.zeros(place.size)
    if place.size > 2:
        both[1:-1] = np.diff(displacement, 2)
    both /= step**2
    both += ground
    return CrestSeries(step, displacement, in_band(both, step), in_band(ground, step))


def in_band(acceleration: Floats, step: float) -> Floats:
    """Return the part of an acceleration (n,), with steps of `step` seconds, that is within the band; beyond its ends
    it is constant."""
    reach = band_weights(step).size - 1
    if not reach or not acceleration.size:
        return acceleration
    # By Fourier's transform; SciPy has a function for it, which takes longer to load than a block to run. It goes piece
    # by piece, as a transform of a long record takes a multiple of its memory.
    padded = np.pad(acceleration, reach, mode="edge")
    size = 1 << (16 * reach).bit_length()
    weights, passed = _transformed_weights(step, size), np.empty(acceleration.size)
    for first in range(0, passed.size, size - 2 * reach):
        here = passed[first : first + size - 2 * reach]
        piece = np.fft.irfft(np.fft.rfft(padded[first : first + size], size) * weights, size)
        here[:] = piece[2 * reach : 2 * reach + here.size]
    return passed


@lru_cache(maxsize=2)
def _transformed_weights(step: float, size: int) -> NDArray[np.complex128]:
    """Return the transform of the weights both ways: the crest and the ground of a run have the same moments."""
    half = band_weights(step)
    transformed = np.fft.rfft(np.concatenate([half[:0:-1], half]), size)
    transformed.flags.writeable = False
    return transformed


@lru_cache(maxsize=32)
def band_weights(step: float) -> Floats:
    """Return the weights of the filter for the distances 0, 1, 2, ... between moments one `step` apart, the same either
    way, together 1: how a blow goes forward and backward through it. Steps too long for the band pass all."""
    if step * BAND_HZ > 0.25:
        return np.ones(1)
    size = math.ceil(_MEMORY_S / step) + 1
    # Butterworth's gain by the bilinear transform, squared: once forward and once backward.
    tangent = np.tan(np.linspace(0.0, np.pi / 2.0, size + 1)) / np.tan(np.pi * BAND_HZ * step)
    half = np.fft.irfft(1.0 / (1.0 + tangent ** (2 * _ORDER)))[:size]
    weights: Floats = half / (2.0 * half.sum() - half[0])
    weights.flags.writeable = False
    return weights


def crest_peaks(crest: CrestMotion | None) -> dict[str, float]:
    """Return the numbers of :data:`CREST_PEAKS`; not a number where there are none."""
    peaks = (math.nan, math.nan) if crest is None else (crest.displacement_m, crest.acceleration_g)
    return dict(zip(CREST_PEAKS, peaks, strict=True))
