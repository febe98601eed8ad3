"""Water before a rigid vertical wall in an endless channel, in closed forms: an independent program for the tests."""

from __future__ import annotations

import numpy as np
from scipy.special import j0


def channel_modes(omega, depth, wave_speed, reflection, count=60):
    """Return wavenumbers mu over the depth and decay along the channel of its modes ``sin(mu (H - y))``.

    ``-mu cos(mu H) = i omega q sin(mu H)`` (Fenves and Chopra 1984), each from that over a rigid floor as the floor
    takes more and more.
    """
    q = (1.0 - reflection) / (wave_speed * (1.0 + reflection))
    mu = (np.arange(count) + 0.5) * np.pi / depth + 0j
    for share in np.linspace(0.0, 1.0, 41)[1:]:
        taken = 1j * omega * q * share
        for _ in range(12):
            value = mu * np.cos(mu * depth) + taken * np.sin(mu * depth)
            slope = np.cos(mu * depth) * (1.0 + taken * depth) - mu * depth * np.sin(mu * depth)
            mu = mu - value / slope
    decay = np.sqrt(mu**2 - (omega / wave_speed) ** 2 + 0j)
    decay = np.where(decay.real < 0.0, -decay, decay)
    # Waves that travel go away from the wall: exp(i (omega t - k x)).
    return mu, np.where((np.abs(decay.real) < 1e-9 * np.abs(decay)) & (decay.imag < 0.0), -decay, decay)


def channel_pressure(heights, omega, depth, wave_speed, reflection, velocity, density=1000.0):
    """Return the pressure at heights of the wall under its velocity ``velocity(z) exp(i omega t)`` into the channel."""
    mu, decay = channel_modes(omega, depth, wave_speed, reflection)
    y, weights = np.polynomial.legendre.leggauss(400)
    y, weights = depth * (y + 1.0) / 2.0, weights * depth / 2.0
    modes = np.sin(np.outer(depth - y, mu))
    shares = (modes.T @ (weights * velocity(y))) / (weights @ modes**2)
    return 1j * omega * density * np.sin(np.outer(depth - np.asarray(heights), mu)) @ (shares / decay)


def step_pressure(times, depth, wave_speed, density=1000.0, count=400):
    """Return base pressure and total force on the wall that accelerates into the water by 1 m/s2 from t = 0 on.

    Over a rigid floor; Tsai, Lee and Ketter 1990: the sum over modes of integrals of J0.
    """
    fine = np.linspace(0.0, max(times), 200_001)
    pressure, force = np.zeros_like(fine), np.zeros_like(fine)
    for k in range(1, count + 1):
        mu = (2 * k - 1) * np.pi / (2.0 * depth)
        value = j0(mu * wave_speed * fine)
        integral = np.concatenate([[0.0], np.cumsum((value[1:] + value[:-1]) / 2.0)]) * fine[1]
        term = 2.0 * density * wave_speed / depth * integral / mu
        pressure += term * (-1.0) ** (k + 1)
        force += term / mu
    return np.interp(times, fine, pressure), np.interp(times, fine, force)


def vertical_pressure(times, depth, wave_speed, reflection, density=1000.0):
    """Return the pressure at a floor that accelerates upwards by 1 m/s2 from t = 0 on, water of one depth above it.

    The wave upwards at the floor is ``f(t) = rho c (1 + alpha) / 2 v(t) - alpha f(t - 2 H / c)``, the pressure
    ``f(t) - f(t - 2 H / c)``.
    """
    back = 2.0 * depth / wave_speed

    def upwards(t):
        total, sign = 0.0, 1.0
        while t > 0.0:
            total += sign * density * wave_speed * (1.0 + reflection) / 2.0 * t
            sign, t = -sign * reflection, t - back
        return total

    return np.array([upwards(t) - upwards(t - back) for t in times])
