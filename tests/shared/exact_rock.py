"""A strip on an elastic half-plane by its wavenumber integral: an independent program for the tests."""

from __future__ import annotations

import numpy as np
from scipy.special import jv


def wavenumbers(frequency_ratio, poisson, damping):
    """Return wavenumbers times b, their weights, and what Lamb 1904 has of them times G: displacement along, and up and
    down, of tractions in the same direction, and that along of a traction upwards over i; all with losses.

    ``-k_s^2 nu_s / R``, ``-k_s^2 nu_p / R`` and ``k (2 k^2 - k_s^2 - 2 nu_p nu_s) / R`` with Rayleigh's function R.
    """
    loss = 1.0 + 2j * damping
    shear = frequency_ratio / np.sqrt(loss)
    pressure = shear * np.sqrt((1.0 - 2.0 * poisson) / (2.0 * (1.0 - poisson)))
    points, weights = np.polynomial.legendre.leggauss(12)
    near = np.linspace(0.0, 3.0 * frequency_ratio, 600)
    ends = np.concatenate([near, np.geomspace(max(3.0 * frequency_ratio, 1e-6), 1e3, 1500)[1:]])
    half = np.diff(ends) / 2.0
    k = (((ends[1:] + ends[:-1]) / 2.0)[:, None] + half[:, None] * points).reshape(-1)
    weight = (half[:, None] * weights).reshape(-1)
    nu_p, nu_s = np.sqrt(k**2 - pressure**2 + 0j), np.sqrt(k**2 - shear**2 + 0j)
    rayleigh = loss * ((2.0 * k**2 - shear**2) ** 2 - 4.0 * k**2 * nu_p * nu_s)
    mixed = k * (2.0 * k**2 - shear**2 - 2.0 * nu_p * nu_s) / rayleigh
    return k, weight, -(shear**2) * nu_s / rayleigh, -(shear**2) * nu_p / rayleigh, mixed


def strip_compliance(frequency_ratio, poisson, damping):
    """Return the mean displacement of a strip of width 2 b under a uniform traction on it, per unit force and times G.

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
    k, weight, along, up, _ = wavenumbers(frequency_ratio, poisson, damping)
    mean = weight * np.sinc(k / np.pi) ** 2 / np.pi
    return complex(mean @ up), complex(mean @ along)


def chebyshev_compliance(frequency_ratio, poisson, damping, count):
    """Return displacements under tractions ``T_n(s) / sqrt(1 - s^2)``, T Chebyshev's polynomials, seen through the same
    functions, times G / b; ``count`` along and as many upwards, shape (2 count, 2 count).

    Such tractions have the roots of a stiff body's edges; their transform is ``pi (-i)^n J_n(k b)``."""
    k, weight, along, up, mixed = wavenumbers(frequency_ratio, poisson, damping)
    bessel = np.array([jv(n, k) for n in range(count)])
    order = np.arange(count)
    phase = 1j ** (order[:, None] - order[None, :])
    even = (order[:, None] + order[None, :]) % 2 == 0

    def integral(kernel):
        return np.pi * (bessel * (weight * kernel)) @ bessel.T

    crossed = np.where(even, 0.0, 1j * phase * integral(mixed))
    return np.block(
        [[np.where(even, phase * integral(along), 0.0), crossed], [-crossed, np.where(even, phase * integral(up), 0.0)]]
    )
