"""How strong a ground motion is, in one number of several."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import arias_intensity, cumulative_absolute_velocity
from heeltoe.motion.spectrum import response_spectrum

# Between the periods over which the spectrum intensities are integrated; refining it changes them by less than 1e-3.
_PERIODS = np.linspace(0.1, 2.5, 121)


def spectrum_intensity(motion: GroundMotion, damping: float) -> float:
    """Return the integral of the pseudo-velocity spectrum from 0.1 s to 2.5 s [m]."""
    spectrum = response_spectrum(motion, _PERIODS, damping)
    velocity = 2.0 * np.pi / _PERIODS * spectrum.displacement
    return float(np.sum(np.diff(_PERIODS) * (velocity[1:] + velocity[:-1]) / 2.0))


def spectral_acceleration(motion: GroundMotion, period: float) -> float:
    """Return the pseudo-acceleration of an oscillator with 5 % damping [m/s2]."""
    return float(response_spectrum(motion, [period], 0.05).pseudo_acceleration[0])


#: Measures by name: unit, and the measure of a motion where one g is so much. All but the Arias intensity, which grows
#: with the square, grow with the motion. Spectrum intensities: Von Thun et al. (1988) with 5 % damping, Housner (1952)
#: with 20 %.
MEASURES: dict[str, tuple[str, Callable[[GroundMotion, float], float]]] = {
    "pga": ("m/s^2", lambda motion, gravity: motion.pga),
    "pgv": ("m/s", lambda motion, gravity: motion.pgv),
    "arias": ("m/s", arias_intensity),
    "cumulative absolute velocity": ("m/s", lambda motion, gravity: cumulative_absolute_velocity(motion)),
    "velocity spectrum intensity": ("m", lambda motion, gravity: spectrum_intensity(motion, 0.05)),
    "housner intensity": ("m", lambda motion, gravity: spectrum_intensity(motion, 0.2)),
}


def intensity(motion: GroundMotion, name: str, period: float | None, gravity: float) -> float:
    """Return a measure by its name in SI units; ``"sa"`` is the spectral acceleration at a period."""
    if name == "sa":
        assert period is not None
        return spectral_acceleration(motion, period)
    return MEASURES[name][1](motion, gravity)


def at_factor(value: Floats, name: str, factor: Floats) -> Floats:
    """Return what a measure becomes where the motion is scaled."""
    return value * (factor * factor if name == "arias" else factor)
