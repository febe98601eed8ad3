"""An elastic dam between water in an endless channel and a half-plane, frequency by frequency: an independent program.

The dam in all its finite elements, the water by the exact modes of the channel before a vertical face, the rock by its
wavenumber integral with tractions that are polynomials along the base."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

from shared.exact_rock import chebyshev_compliance
from shared.exact_water import channel_modes

TRACTIONS = 8


def edge_integrals(nodes, functions, end=np.inf):
    """Return the integrals along quadratic edges, up to an end, of functions times the shapes of the nodes."""
    points, weights = np.polynomial.legendre.leggauss(8)
    rows = 0.0
    for first in range(0, len(nodes) - 2, 2):
        low, high = nodes[first], nodes[first + 2]
        top = min(high, end)
        if top <= low:
            continue
        at = (low + top) / 2.0 + (top - low) / 2.0 * points
        s = (2.0 * at - low - high) / (high - low)
        shapes = np.stack([s * (s - 1.0) / 2.0, 1.0 - s**2, s * (s + 1.0) / 2.0])
        values = functions(at)
        total = np.zeros((len(nodes), values.shape[1]), dtype=values.dtype)
        total[first : first + 3] = (shapes * weights * (top - low) / 2.0) @ values
        rows = rows + total
    return rows


def chebyshev_integrals(nodes):
    """Return the integrals from -1 to 1 of ``T_n(s) / sqrt(1 - s^2)`` times the shapes of nodes of quadratic edges."""
    angles = (np.arange(4000) + 0.5) * np.pi / 4000
    at = np.cos(angles)
    edge = 2 * np.clip(np.searchsorted(nodes[2:-1:2], at), 0, (len(nodes) - 3) // 2)
    s = (2.0 * at - nodes[edge] - nodes[edge + 2]) / (nodes[edge + 2] - nodes[edge])
    values = np.cos(np.outer(angles, np.arange(TRACTIONS))) * np.pi / 4000
    total = np.zeros((len(nodes), TRACTIONS))
    for place, shape in enumerate((s * (s - 1.0) / 2.0, 1.0 - s**2, s * (s + 1.0) / 2.0)):
        np.add.at(total, edge + place, shape[:, None] * values)
    return total


def crest_amplification(body, base, frequency, ratio, water=None, rock=None):
    """Return the amplification of the crest.

    Parameters
    ----------
    body
        The dam in one part.
    base
        Nodes on which it stands, from heel to toe.
    frequency
        [Hz].
    ratio
        Damping ratio of the concrete at all frequencies.
    water
        depth, wave speed and reflection of the floor.
    rock
        shear modulus, Poisson's ratio, density and damping ratio.
    """
    omega = 2.0 * np.pi * frequency
    size = body.mesh.nodes.size
    stiffness = sparse.lil_matrix((1.0 + 2j * ratio) * body.stiffness - omega**2 * body.mass_concrete)
    load = -(body.mass_concrete @ np.tile([1.0 + 0j, 0.0], size // 2))
    if water is not None:
        depth, wave_speed, reflection = water
        mu, decay = channel_modes(omega, depth, wave_speed, reflection)
        face = body.mesh.upstream
        heights = body.mesh.nodes[face, 1]
        modes = edge_integrals(heights, lambda y: np.sin(np.outer(depth - y, mu)), depth)
        y, weights = np.polynomial.legendre.leggauss(400)
        squares = depth / 2.0 * weights @ np.sin(np.outer(depth * (1.0 - y) / 2.0, mu)) ** 2
        mass = 1000.0 * (modes / (squares * decay)) @ modes.T
        stiffness[np.ix_(2 * face, 2 * face)] -= omega**2 * mass
        load[2 * face] -= mass @ np.ones(len(face))
    free = np.arange(size)
    if rock is None:
        free = np.setdiff1d(free, np.concatenate([2 * base, 2 * base + 1]))
    else:
        shear, poisson, density, damping = rock
        x = body.mesh.nodes[base, 0]
        half = (x[-1] - x[0]) / 2.0
        wave = np.sqrt(shear / density)
        compliance = chebyshev_compliance(omega * half / wave, poisson, damping, TRACTIONS) / shear
        along = chebyshev_integrals((x - x[0]) / half - 1.0)
        tractions = np.zeros((2 * len(base), 2 * TRACTIONS))
        tractions[::2, :TRACTIONS] = tractions[1::2, TRACTIONS:] = along
        dofs = np.stack([2 * base, 2 * base + 1], axis=1).reshape(-1)
        stiffness[np.ix_(dofs, dofs)] += tractions @ np.linalg.solve(compliance, tractions.T)
    operator = sparse.csc_matrix(stiffness)[free][:, free]
    moved = np.zeros(size, dtype=complex)
    moved[free] = splu(operator.tocsc()).solve(load[free])
    return 1.0 - omega**2 * moved[2 * body.mesh.upstream[-1]]
