"""The far field of a reservoir: a channel of constant depth without an end, in symmetric positive matrices.

Beyond the near field the velocity potential of the water is a sum of a few shapes over the depth, ``Y(y) a(x, t)``,
and a long layer along the channel carries their amplitudes away. The layer absorbs more and more: its stiffness along
the channel, and that alone, has a damping,

    phi''/c^2 = d/dx [(1 + sigma(x) d/dt) dphi/dx] + d^2 phi/dy^2,    sigma(x) rising from 0,

so a wave of the wavenumber k loses exp(-Im int k / sqrt(1 + i omega sigma) dx). What does not vary along the channel,
the water over a floor that moves up and down, is left exactly as it is; evanescent waves are hardly touched; the
absorbing floor goes on below the layer. As sigma is linear at first, every wave meets the same layer in wavelengths,
and elements may grow with the distance: the waves that they would not carry have gone by then."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
import scipy.sparse as sparse

from heeltoe.base.arrays import Floats
from heeltoe.models.flexible.surroundings.reduction import Sparse

# sigma = _GRADIENT x / c times x / (x + _START depths), smoothly no more than _MOST over the first frequency of the
# water. The gentle start matters to waves below a cut-off, which reach into the layer without travelling; the highest
# value and the length to the slowest waves, next to a cut-off.
_GRADIENT, _START, _MOST, _LENGTH = 0.06, 10.0, 2.5, 120.0
# Length of an element over its distance from the start of the layer, at most.
_GROWTH = 0.1
# Modes over the depth beside those that can travel at the highest frequency.
_BESIDE = 4


@dataclass(frozen=True, eq=False)
class Channel:
    """A layer of water along a channel; unknowns are the amplitudes of k shapes over the depth at n places.

    Attributes
    ----------
    depth_shapes
        Shapes at the nodes over the depth, (nodes, k). The first k unknowns are their amplitudes at the start.
    mass, stiffness, damping_floor, damping_far
        Shape (n k, n k), of the potential, without the density: what floor and layer take stands apart.
    lift
        (n k,) flow into the water of a floor that rises with unit velocity.
    distance
        (n k,) of the unknowns from the start [m].
    """

    depth_shapes: Floats
    mass: Sparse
    stiffness: Sparse
    damping_floor: Sparse
    damping_far: Sparse
    lift: Floats
    distance: Floats


def channel(heights: Floats, wave_speed: float, admittance: float, highest: float) -> Channel:
    """Return the layer.

    Parameters
    ----------
    heights
        Nodes over the depth from floor to surface, those in the middle of quadratic elements included, (2 e + 1,) [m].
    wave_speed
        c [m/s].
    admittance
        q of the floor, ``dphi/dn = -q phi'`` [s/m].
    highest
        Circular frequency up to which the layer answers well [1/s].
    """
    depth = float(heights[-1] - heights[0])
    shapes, inertia, rigidity = _over_depth(heights, highest * depth / (np.pi * wave_speed))
    floor = np.outer(shapes[0], shapes[0])
    nodes = _places(depth, wave_speed, highest)
    first = np.pi * wave_speed / (2.0 * depth)
    most = _MOST / first

    def absorption(x: Floats) -> Floats:
        gentle = _GRADIENT * x / wave_speed * x / (x + _START * depth)
        rise: Floats = most * np.tanh(gentle / most)
        return rise

    product, slope, absorbed, total = _line(nodes, absorption)
    return Channel(
        shapes,
        sparse.kron(product, inertia) / wave_speed**2,
        sparse.kron(slope, inertia) + sparse.kron(product, rigidity),
        admittance * sparse.kron(product, floor),
        sparse.kron(absorbed, inertia),
        np.kron(total, shapes[0]),
        np.repeat(nodes, shapes.shape[1]),
    )


def _over_depth(heights: Floats, travelling: float) -> tuple[Floats, Floats, Floats]:
    """Return shapes over the depth, orthonormal, with their matrices of mass and stiffness: the lowest modes over a
    floor that is still, and what an absorbing floor adds to them."""
    product, slope, _, _ = _line(heights, np.ones_like)
    wet = slice(0, heights.size - 1)  # the surface has no potential
    mass, stiffness = product.toarray()[wet, wet], slope.toarray()[wet, wet]
    count = min(int(travelling) + 1 + _BESIDE, heights.size - 4)
    _, modes = scipy.linalg.eigh(stiffness, mass, subset_by_index=(0, count - 1))
    flow = np.zeros(heights.size - 1)
    flow[0] = 1.0
    # The potential of a steady flow through the floor, and how it varies with the frequency.
    answers = [flow]
    for _ in range(3):
        answers.append(scipy.linalg.solve(stiffness, answers[-1] if len(answers) == 1 else mass @ answers[-1]))
    added = np.column_stack(answers[1:])
    for _ in range(2):
        added = added - modes @ (modes.T @ (mass @ added))
        added = added / np.sqrt(np.sum(added * (mass @ added), axis=0))
    energy, mixed = scipy.linalg.eigh(added.T @ mass @ added)
    kept = energy > 1e-8 * energy[-1]
    shapes = np.column_stack([modes, added @ (mixed[:, kept] / np.sqrt(energy[kept]))])
    full = np.vstack([shapes, np.zeros(shapes.shape[1])])
    return full, shapes.T @ mass @ shapes, shapes.T @ stiffness @ shapes


def _places(depth: float, wave_speed: float, highest: float) -> Floats:
    """Return the nodes of quadratic elements along the layer, from 0 [m]."""
    shortest = min(2.0 * np.pi * wave_speed / highest / 6.0, depth / 3.0)
    ends = [0.0]
    while ends[-1] < _LENGTH * depth:
        ends.append(ends[-1] + min(max(shortest, _GROWTH * ends[-1]), 2.0 * depth))
    corners = np.array(ends)
    nodes = np.empty(2 * corners.size - 1)
    nodes[::2] = corners
    nodes[1::2] = (corners[1:] + corners[:-1]) / 2.0
    return nodes


def _line(nodes: Floats, weight: object) -> tuple[Sparse, Sparse, Sparse, Floats]:
    """Return over a line of quadratic elements the integrals of N N, N' N', weight N' N' and N."""
    points, weights = np.polynomial.legendre.leggauss(3)
    shape = np.stack([points * (points - 1.0) / 2.0, 1.0 - points**2, points * (points + 1.0) / 2.0])
    slope = np.stack([points - 0.5, -2.0 * points, points + 0.5])
    first = np.arange(0, nodes.size - 2, 2)
    half = (nodes[first + 2] - nodes[first]) / 2.0
    at = nodes[first + 1][:, None] + half[:, None] * points
    measured = weight(at)  # type: ignore[operator]
    places = first[:, None] + np.arange(3)
    rows, columns = np.repeat(places, 3, axis=1).reshape(-1), np.tile(places, (1, 3)).reshape(-1)

    def gathered(values: Floats) -> Sparse:
        return sparse.csr_matrix((values.reshape(-1), (rows, columns)), (nodes.size, nodes.size))

    product = np.einsum("ip,jp,p,e->eij", shape, shape, weights, half)
    slopes = np.einsum("ip,jp,p,e->eij", slope, slope, weights, 1.0 / half)
    weighted = np.einsum("ip,jp,p,ep,e->eij", slope, slope, weights, measured, 1.0 / half)
    total = np.zeros(nodes.size)
    np.add.at(total, places, np.einsum("ip,p,e->ei", shape, weights, half))
    return gathered(product), gathered(slopes), gathered(weighted), total
