"""Ground motions made to order: white noise, filtered and modulated, for given parameters or for an earthquake.

The model is that of Rezaeian and Der Kiureghian (2008), Earthquake Engineering and Structural Dynamics 37, 1609-1630,
with the modulation and the predictive relations of their paper of 2010, same journal 39, 1155-1180, called RDK 2010
below. Relations from magnitude and distance to parameters stand in :mod:`heeltoe.motion.scenario`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.processing import baseline
from heeltoe.units.parse import STANDARD_GRAVITY

STEP = 0.01
"""Step of generated motions [s]; the filter is a continuous one sampled at it."""
LOWEST_FREQUENCY = 0.3
"""The filter frequency [Hz] falls no lower, however long the motion; a bound of ours, out of reach for most."""
# Behind its last strong shaking a motion goes on until the high-pass has come to rest but for (1 + x) exp(-x).
_REST = 9.0


@dataclass(frozen=True)
class Source:
    """The spectrum of an earthquake's source, as :func:`heeltoe.motion.scenario.source_of` has it.

    Attributes
    ----------
    lower, upper
        Its corner frequencies [Hz].
    share
        Of the upper corner, from 0 to 1.
    """

    lower: float
    upper: float
    share: float


@dataclass(frozen=True)
class Parameters:
    """Properties of a generated motion, in expectation over all seeds.

    Attributes
    ----------
    arias
        Arias intensity [m/s].
    duration
        D_5-95, time [s] between 5 % and 95 % of the Arias intensity.
    middle
        t_mid, time [s] of 45 % of the Arias intensity.
    frequency
        Filter frequency at `middle` [Hz].
    frequency_rate
        Its change in time [Hz/s].
    bandwidth
        Damping ratio of the filter: small is narrow-banded.
    corner
        Corner frequency [Hz] of the high-pass, where no source takes its place.
    source
        Of the earthquake, whose spectrum the motion has at long periods.
    """

    arias: float
    duration: float
    middle: float
    frequency: float
    frequency_rate: float = 0.0
    bandwidth: float = 0.3
    corner: float = 0.1
    source: Source | None = None

    def __post_init__(self) -> None:
        for name, low, high, unit in (
            ("arias", 1e-6, 1e3, "m/s"),
            ("duration", 0.1, 300.0, "s"),
            ("middle", 0.1, 300.0, "s"),
            ("frequency", LOWEST_FREQUENCY, 25.0, "Hz"),
            ("frequency_rate", -5.0, 5.0, "Hz/s"),
            ("bandwidth", 0.01, 0.99, ""),
            ("corner", 0.01, 2.0, "Hz"),
        ):
            value = getattr(self, name)
            if not low <= value <= high:
                bound = f"from {low:g} to {high:g} {unit}".strip()
                raise InputError("out-of-range", name, f"{value:g} {unit}".strip(), bound=bound)


def modulation(parameters: Parameters) -> tuple[float, float]:
    """Return shape k and scale s [s] of the gamma density that the squared modulation is proportional to.

    After RDK 2010, q(t) = alpha_1 t^(alpha_2 - 1) exp(-alpha_3 t). Its square is a gamma density of shape
    k = 2 alpha_2 - 1 and scale s = 1 / (2 alpha_3), so that D_5-95 / t_mid depends on the shape alone.

    Raises
    ------
    InputError
        Where the middle is so early or late for the duration that no shape with k > 1 gives it.
    """
    from scipy.optimize import brentq
    from scipy.stats import gamma

    ratio = parameters.duration / parameters.middle
    # A shape of 1 starts at full strength and has a ratio of 4.92; one of 300 is a bell far from zero.
    if not 0.2 <= ratio <= 4.9:
        raise InputError("synthetic-shape", "duration", f"{ratio:.3g}")

    def excess(logarithm: float) -> float:
        low, middle, high = gamma.ppf([0.05, 0.45, 0.95], np.exp(logarithm))
        return float((high - low) / middle - ratio)

    shape = float(np.exp(brentq(excess, 0.0, np.log(1000.0), xtol=1e-12)))
    return shape, parameters.middle / float(gamma.ppf(0.45, shape))


def stochastic_motion(
    parameters: Parameters, seed: int, *, gravity: float = STANDARD_GRAVITY, name: str = "synthetic"
) -> GroundMotion:
    """Return one motion of the stochastic model.

    After RDK 2010, noise u_i at each step drives an oscillator whose frequency is the one at the time of the
    noise,

        x(t) = q(t) / sigma(t) sum_i h(t - t_i) u_i,
        h(tau) = w / sqrt(1 - z^2) exp(-z w tau) sin(w sqrt(1 - z^2) tau),    w = 2 pi f(t_i),

    where sigma^2 = sum_i h^2 makes the variance one before modulation. The high-pass is their critically damped
    oscillator, which leaves neither velocity nor displacement behind; what is not yet at rest where the
    motion is ended, below a thousandth, a polynomial takes away. A source goes in its place, see :func:`_two_corners`.

    The Arias intensity is that of `parameters` on average over seeds, less what high-pass or source takes; it is not
    scaled to it, as its scatter is part of the model.

    Parameters
    ----------
    parameters
        What the motion is like.
    seed
        Of numpy's PCG64; the same seed gives the same bits with the same numpy.
    gravity
        One g [m/s2], in the definition of the Arias intensity.
    name
        Of the motion.
    """
    from scipy import signal
    from scipy.stats import gamma

    shape, scale = modulation(parameters)
    source = parameters.source
    lowest = parameters.corner if source is None else source.lower
    rest = _REST / (2.0 * np.pi * lowest)
    count = int(np.ceil((scale * float(gamma.ppf(0.999, shape)) + rest) / STEP)) + 1
    time: Floats = STEP * np.arange(count, dtype=np.float64)
    noise = np.random.Generator(np.random.PCG64(seed)).standard_normal(count)
    frequency = np.maximum(
        parameters.frequency + parameters.frequency_rate * (time - parameters.middle), LOWEST_FREQUENCY
    )
    filtered = _filtered_noise(noise, 2.0 * np.pi * frequency, parameters.bandwidth)
    # The integral of a^2 is 2 g / pi times the Arias intensity.
    power = 2.0 * gravity / np.pi * parameters.arias * gamma.pdf(time, shape, scale=scale)
    acceleration = np.sqrt(power) * filtered
    for numerator, denominator in [_critical(lowest)] if source is None else _two_corners(source):
        acceleration = signal.lfilter(*signal.bilinear(numerator, denominator, fs=1.0 / STEP), acceleration)
    long_periods = f"high-pass {lowest:.3g} Hz" if source is None else f"source {lowest:.3g} and {source.upper:.3g} Hz"
    processing = (
        f"filtered, modulated white noise after Rezaeian and Der Kiureghian (2010): Arias intensity "
        f"{parameters.arias:.4g} m/s, D5-95 {parameters.duration:.4g} s, t_mid {parameters.middle:.4g} s, frequency "
        f"{parameters.frequency:.4g} Hz there, changing by {parameters.frequency_rate:.3g} Hz/s, bandwidth "
        f"{parameters.bandwidth:.3g}, {long_periods}, seed {seed}"
    )
    motion = GroundMotion(
        name,
        time,
        acceleration,
        format="synthetic",
        units_as_read="m/s^2",
        source="made to order",
        processing=(processing,),
    )
    return baseline(motion, 3, displacement=True)


# Coefficients of powers of s, the highest first.
_Filter = tuple[list[float], list[float]]


def _critical(corner: float) -> _Filter:
    """Numerator and denominator of s^2 / (s + w)^2, the critically damped high-pass.

    Its bilinear transform has the double zero at frequency zero that makes velocity and displacement vanish.
    """
    w = 2.0 * np.pi * corner
    return [1.0, 0.0, 0.0], [1.0, 2.0 * w, w * w]


def _two_corners(source: Source) -> list[_Filter]:
    """Numerators and denominators of two filters whose amplitude, together, is that of a source of two corners.

    The spectrum f^2 ((1 - share) / (1 + (f / lower)^2) + share / (1 + (f / upper)^2)), one where the frequency is high,
    is that of s^2 (s + z)^2 / ((s + l)^2 (s + u)^2) with 1 / z^2 = (1 - share) / u^2 + share / l^2: no approximation.
    """
    low, up = (2.0 * np.pi * corner for corner in (source.lower, source.upper))
    z = float(1.0 / np.sqrt((1.0 - source.share) / up**2 + source.share / low**2))
    return [_critical(source.lower), ([1.0, 2.0 * z, z * z], [1.0, 2.0 * up, up * up])]


def _filtered_noise(noise: Floats, circular: Floats, damping: float) -> Floats:
    """Return the filtered noise with a variance of one at each moment; zero at the first, where nothing came yet."""
    total = np.zeros(noise.size)
    variance = np.zeros(noise.size)
    root = np.sqrt(1.0 - damping**2)
    tau = STEP * np.arange(noise.size)
    for i, (u, w) in enumerate(zip(noise, circular, strict=True)):
        # Beyond exp(-40) nothing is left in double precision.
        until = min(noise.size - i, int(40.0 / (damping * w * STEP)) + 2)
        h = w / root * np.exp(-damping * w * tau[:until]) * np.sin(w * root * tau[:until])
        total[i : i + until] += u * h
        variance[i : i + until] += h * h
    result: Floats = total / np.sqrt(np.where(variance > 0.0, variance, 1.0))
    return result
