"""Response spectra, exact for a ground acceleration that is linear between its moments."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from heeltoe.base.arrays import Floats
from heeltoe.base.frozen import ReadOnlyArrays
from heeltoe.errors.error import InputError
from heeltoe.kernel.shaking import peak_responses
from heeltoe.motion.ground_motion import GroundMotion

# A shorter period [s] but zero has nothing in a record to answer to, and takes for ever to follow.
_SHORTEST = 1e-4
#: 200 periods from 0.02 s to 10 s, evenly spread on a logarithmic axis.
PERIODS: Floats = np.geomspace(0.02, 10.0, 200)


@dataclass(frozen=True, eq=False)
class Spectrum(ReadOnlyArrays):
    """Response spectrum of one ground motion.

    Attributes
    ----------
    name
        Of the motion.
    period
        (k,) periods [s].
    damping
        Damping ratio.
    displacement
        (k,) largest displacement relative to the ground [m].
    total_acceleration
        (k,) largest acceleration of ground and oscillator together [m/s2].
    """

    name: str
    period: Floats
    damping: float
    displacement: Floats
    total_acceleration: Floats

    @property
    def pseudo_acceleration(self) -> Floats:
        """(k,) displacement times the circular frequency squared [m/s2]; the PGA at period zero."""
        zero = self.period == 0.0
        frequency = 2.0 * np.pi / np.where(zero, 1.0, self.period)
        result: Floats = np.where(zero, self.total_acceleration, self.displacement * frequency**2)
        return result


def response_spectrum(motion: GroundMotion, periods: ArrayLike | None = None, damping: float = 0.05) -> Spectrum:
    """Return the response spectrum of a ground motion.

    Parameters
    ----------
    motion
        The ground motion.
    periods
        (k,) periods [s], zero allowed; :data:`PERIODS` where not given.
    damping
        Damping ratio, at least 0 and below 1.

    Returns
    -------
    Spectrum

    Raises
    ------
    InputError
        Where a period or the damping is out of range.
    """
    period = np.ascontiguousarray(PERIODS if periods is None else periods, dtype=np.float64)
    if not 0.0 <= damping < 1.0:
        raise InputError("out-of-range", "damping", f"{damping:g}", bound="from 0 to below 1")
    if period.ndim != 1 or not np.isfinite(period).all() or ((period < _SHORTEST) & (period != 0.0)).any():
        raise InputError("spectrum-period", "periods", least=f"{_SHORTEST:g} s")
    displacement, total = peak_responses(motion.time, motion.acceleration, period, damping)
    return Spectrum(motion.name, period, damping, displacement, total)
