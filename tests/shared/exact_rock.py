"""A strip on an elastic half-plane by its wavenumber integral: an independent program for the tests."""

from __future__ import annotations

import numpy as np


def strip_compliance(frequency_ratio, poisson, damping):
    """Return the mean displacement of a strip of width 2 b under a uniform traction on it, per unit force and times G.

    Lamb 1904: vertical ``-k_s^2 nu_p / (G R)`` and horizontal ``-k_s^2 nu_s / (G R)`` with the function R of Rayleigh,
    the traction's transform ``sin(k b) / (k b)`` once for the traction and once for the mean.

    Parameters
    ----------
    frequency_ratio
        ``omega b / c_s`` of the rock without losses.
    poisson
        Poisson's ratio.
    damping
        xi of ``G (1 + 2 i xi)``; without it the integrand has a pole.

    Returns
    -------
    vertical, horizontal : complex
    """
    loss = 1.0 + 2j * damping
    shear = frequency_ratio / np.sqrt(loss)
    pressure = shear * np.sqrt((1.0 - 2.0 * poisson) / (2.0 * (1.0 - poisson)))
    points, weights = np.polynomial.legendre.leggauss(20)
    ends = np.concatenate(
        [np.linspace(0.0, 4.0 * frequency_ratio, 400), np.geomspace(4.0 * frequency_ratio, 4e3, 4000)[1:]]
    )
    half = np.diff(ends) / 2.0
    k = ((ends[1:] + ends[:-1]) / 2.0)[:, None] + half[:, None] * points
    weight = half[:, None] * weights * np.sinc(k / np.pi) ** 2 / np.pi
    nu_p, nu_s = np.sqrt(k**2 - pressure**2 + 0j), np.sqrt(k**2 - shear**2 + 0j)
    rayleigh = (2.0 * k**2 - shear**2) ** 2 - 4.0 * k**2 * nu_p * nu_s
    return tuple(complex(np.sum(weight * -(shear**2) * nu / rayleigh) / loss) for nu in (nu_p, nu_s))
