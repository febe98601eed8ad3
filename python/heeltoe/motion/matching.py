"""Matching a record to a target spectrum in the time domain, by wavelets added where the oscillators peak.

Method of Lilhanand and Tseng (1988) with the wavelets of Al Atik and Abrahamson (2010), Earthquake Spectra 26, 601-617:
each large peak of an oscillator's response gets a wavelet, placed so that the response to it peaks there too; the
amplitudes come from a linear system, and since peaks move, this is repeated. Unlike theirs, the system also holds the
second and third peak of each oscillator, and is solved by damped least squares.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import arias_intensity, uniform
from heeltoe.motion.processing import baseline
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.motion.targets import Target

# Of a peak sampled at a fortieth of a period not more than 1 - cos(pi / 40) = 0.3 % is missed.
_SAMPLES_PER_PERIOD = 40.0
# The largest peaks of each oscillator that are looked after: a peak that was not the largest must not become it.
_PEAKS = 3
_NEARLY = 0.9
# Neighbouring periods ask for nearly the same wavelets; this share of the largest singular value keeps them small.
_RIDGE = 0.002
# Part of the linear step taken: peaks move, and at full length the rounds swing about the target.
_STEP = 0.6


@dataclass(frozen=True, eq=False)
class Misfit:
    """How far a motion is from its target, and what the matching changed.

    Attributes
    ----------
    period
        (k,) periods [s] at which it was judged, between those that were matched as well.
    log_ratio
        (k,) ln of response over target after the matching.
    log_ratio_before
        (k,) The same of the record, scaled as a whole to the target.
    scale
        That scale.
    pga_ratio, pgv_ratio, pgd_ratio, arias_ratio
        Peaks and Arias intensity after the matching over those of the scaled record.
    """

    period: Floats
    log_ratio: Floats
    log_ratio_before: Floats
    scale: float
    pga_ratio: float
    pgv_ratio: float
    pgd_ratio: float
    arias_ratio: float

    @property
    def largest(self) -> float:
        """Largest ln of response over target, without sign."""
        return float(np.abs(self.log_ratio).max())

    @property
    def rms(self) -> float:
        """Root mean square of ln of response over target."""
        return float(np.sqrt(np.mean(self.log_ratio**2)))

    @property
    def rms_before(self) -> float:
        """Root mean square of ln of response over target for the scaled record, before matching."""
        return float(np.sqrt(np.mean(self.log_ratio_before**2)))

    def __str__(self) -> str:
        return (
            f"off the target by {np.expm1(self.rms):.1%} (rms; {np.expm1(self.rms_before):.1%} before), at most "
            f"{np.expm1(self.largest):.1%}; PGA x {self.pga_ratio:.3g}, PGV x {self.pgv_ratio:.3g}, "
            f"PGD x {self.pgd_ratio:.3g}, Arias intensity x {self.arias_ratio:.3g}"
        )


def match(
    motion: GroundMotion,
    target: Target,
    *,
    shortest: float = 0.1,
    longest: float = 3.0,
    count: int = 60,
    iterations: int = 30,
) -> tuple[GroundMotion, Misfit]:
    """Match a record to a target spectrum, with its misfit.

    The record is first scaled as a whole, so that ln of response over target is zero on average; then wavelets are
    added. It comes back at a step of at most a fortieth of `shortest` and ends at rest.

    Parameters
    ----------
    motion
        The record; refined to equal steps where it has none.
    target
        The spectrum, at its damping.
    shortest, longest
        Band of periods [s] to match.
    count
        Number of periods, evenly spread on a logarithmic axis.
    iterations
        Rounds; the best one is kept.

    Returns
    -------
    motion, misfit
        The misfit is taken from the exact response spectrum at `count` periods and those halfway between.
    """
    if not 0.02 <= shortest < longest <= motion.duration:
        raise InputError("match-band", "shortest", f"{shortest:g} s to {longest:g} s")
    if not 5 <= count <= 200:
        raise InputError("out-of-range", "count", count, bound="from 5 to 200")
    if motion.pga == 0.0:
        raise InputError("order-zero", "", motion.name)
    judged = np.geomspace(shortest, longest, 2 * count - 1)
    period = judged[::2]
    targets = target(period)
    refined = uniform(motion)
    parts = int(np.ceil(refined.dt / (shortest / _SAMPLES_PER_PERIOD) * (1.0 - 1e-9)))
    refined = refined.resampled(refined.dt / parts) if parts > 1 else refined
    scale = float(np.exp(-np.mean(_log_ratio(refined, target, judged))))
    scaled = refined.scaled(
        scale, f"scaled by {scale:.6g} to {target.name} on average over {shortest:g} to {longest:g} s"
    )
    oscillators = _Oscillators(period, target.damping, scaled.dt, scaled.time.size)
    best = baseline(scaled, 3)
    smallest = np.inf
    current = best
    for _ in range(iterations):
        current = baseline(
            replace(current, acceleration=current.acceleration + oscillators.correction(current.acceleration, targets)),
            3,
        )
        error = float(np.sqrt(np.mean(_log_ratio(current, target, judged) ** 2)))
        if error < smallest:
            best, smallest = current, error
    misfit = Misfit(
        judged,
        _log_ratio(best, target, judged),
        _log_ratio(scaled, target, judged),
        scale,
        best.pga / scaled.pga,
        best.pgv / scaled.pgv,
        best.pgd / scaled.pgd,
        arias_intensity(best) / arias_intensity(scaled),
    )
    step = (
        f"matched by wavelets to {target.name}, {target.damping:.3%} damping, {shortest:g} s to {longest:g} s: "
        f"{misfit}; end velocity zero"
    )
    return replace(best, processing=(*scaled.processing, step)), misfit


def match_known_band(motion: GroundMotion, target: Target) -> tuple[GroundMotion, Misfit]:
    """Match a record as :func:`match`, from 0.1 s to 3 s as far as the target is known there and the record lasts."""
    shortest, longest = max(0.1, target.shortest), min(3.0, target.longest, motion.duration)
    return match(motion, target, shortest=shortest, longest=longest)


def _log_ratio(motion: GroundMotion, target: Target, period: Floats) -> Floats:
    response = response_spectrum(motion, period, target.damping).pseudo_acceleration
    ratio: Floats = np.log(response / target(period))
    return ratio


class _Oscillators:
    """The oscillators of the matched periods, sampled in `size` steps of `dt` [s]."""

    def __init__(self, period: Floats, damping: float, dt: float, size: int) -> None:
        self.dt = dt
        self.time = dt * np.arange(size)
        self.circular = 2.0 * np.pi / period
        self.damped = self.circular * np.sqrt(1.0 - damping**2)
        self.damping = damping
        # Pseudo-acceleration that answers a unit impulse of ground acceleration.
        w, wd = self.circular[:, None], self.damped[:, None]
        self.impulse = -(w**2) / wd * np.exp(-damping * w * self.time) * np.sin(wd * self.time)
        # Al Atik and Abrahamson (2010), in terms of the frequency in Hz.
        self.width = 1.178 * (self.circular / (2.0 * np.pi)) ** -0.93
        # From the middle of a wavelet to the peak of its response, theirs too.
        self.delay = (
            np.arctan(np.sqrt(1.0 - damping**2) / damping) / self.damped if damping else np.pi / 2 / self.damped
        )
        self.padded = int(2 ** np.ceil(np.log2(2 * size)))
        self.transform = np.fft.rfft(self.impulse, self.padded)

    def correction(self, acceleration: Floats, change: Floats) -> Floats:
        """Return the sum of wavelets that, to first order, brings the largest peaks to the target."""
        from scipy.signal import argrelmax

        spectrum = np.fft.rfft(acceleration, self.padded) * self.dt
        response = np.fft.irfft(self.transform * spectrum, self.padded)[:, : self.time.size]
        rows: list[tuple[int, int, float]] = []
        for i, values in enumerate(response):
            size = np.abs(values) / change[i]
            peaks = argrelmax(size)[0]
            peaks = peaks[np.argsort(-size[peaks], kind="stable")][:_PEAKS]
            for order, at in enumerate(peaks):
                # The largest goes to the target; others that come near stay, or come down to it.
                lacking = 1.0 - size[at] if order == 0 else min(1.0 - size[at], 0.0)
                if order == 0 or size[at] > _NEARLY:
                    rows.append((i, int(at), float(np.sign(values[at]) * lacking)))
        who = np.array([i for i, _, _ in rows])
        wavelets = self._wavelets(who, self.dt * np.array([float(at) for _, at, _ in rows]))
        # Response of each oscillator to each wavelet, at the moment of the oscillator's own peak. Every fourth sample,
        # ten per period, is enough for the integral of two waves.
        gain = np.array(
            [wavelets[:, at % 4 : at + 1 : 4] @ self.impulse[i, at - at % 4 :: -4] / change[i] for i, at, _ in rows]
        ) * (4.0 * self.dt)
        ridge = _RIDGE * np.linalg.norm(gain, 2)
        lack = np.array([lacking for _, _, lacking in rows])
        amplitude = np.linalg.solve(gain.T @ gain + ridge**2 * np.eye(lack.size), gain.T @ lack)
        result: Floats = _STEP * amplitude @ wavelets
        return result

    def _wavelets(self, who: NDArray[np.int_], peaks: Floats) -> Floats:
        """Tapered cosines to which oscillators `who` answer with a peak at `peaks` [s].

        Their integral is zero, but for 1e-6, and so is that of their velocity.
        """
        shifted = self.time - (peaks - self.delay[who])[:, None]
        result: Floats = np.cos(self.damped[who, None] * shifted) * np.exp(-((shifted / self.width[who, None]) ** 2))
        return result
