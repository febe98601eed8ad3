"""The push-and-sine block made elastic, for programs that take matrices or a mesh; the block and its loads are those of
push_and_sine.py. All here loads where nothing but NumPy is installed, as the interpreter of peer_siconos.py asks for.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from measure import Timing, require
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Node = tuple[int, int]

#: Elements along and up, Young's modulus [Pa], Poisson's ratio; plane stress, no damping.
ALONG, UP, MODULUS, POISSON = 16, 4, 20e9, 0.2
#: Residual slip of the elastic block [m], four digits of it: both peers come to 1.0535 to 1.0538 with small steps and
#: some numerical dissipation. Without any, the undamped block flutters as it slides and no scheme settles.
ELASTIC_SLIP = 1.0536

# Corners first, then the middles of the sides, counter-clockwise: the order of both programs.
CORNERS: tuple[Node, ...] = ((-1, -1), (1, -1), (1, 1), (-1, 1))
SIDES: tuple[Node, ...] = ((0, -1), (1, 0), (0, 1), (-1, 0))


@dataclass(frozen=True)
class Result:
    """One way to slide the elastic block.

    Attributes
    ----------
    program, settings
        With what.
    step, steps
        Time step [s], and how many were made.
    slip
        Mean slip of the nodes of the base at the moments of push_and_sine.py that were reached [m].
    ringing
        Largest difference between the velocities along the base of two of its nodes at those moments [m/s]; next to
        nothing where vibrations die out, large where energy grows.
    finished
        Whether the steps went on until the end.
    timing
        Time of the steps; building the model and the state at rest are not in it.
    note
        What else is to be known.
    """

    program: str
    settings: str
    step: float
    steps: int
    slip: tuple[float, ...]
    ringing: float
    finished: bool
    timing: Timing
    note: str

    @property
    def time_s(self) -> float:
        """Median time of the steps [s]."""
        return self.timing.median

    @property
    def residual_slip_m(self) -> float:
        """Slip in the end, not a number where the end was not reached [m]."""
        return self.slip[-1] if self.finished else math.nan


def steps_between(interval: float, step: float) -> int:
    """Number of steps from one moment of comparison to the next.

    Raises
    ------
    NothingMeasured
        Where the steps do not meet the moments.
    """
    every = round(interval / step)
    require(every >= 1 and abs(every * step - interval) < 1e-9 * interval, f"steps of {step:g} s miss the moments")
    return every


def places(nodes: int) -> tuple[Node, ...]:
    """Nodes of an element with 4 or 8 of them, as places between -1 and 1."""
    require(nodes in (4, 8), f"elements with {nodes} nodes")
    return CORNERS if nodes == 4 else CORNERS + SIDES


def mesh(nodes: int) -> tuple[dict[Node, int], list[list[int]]]:
    """Grid places, in halves of an element, with the number of the node there, and the nodes of each element."""
    numbers: dict[Node, int] = {}
    elements = []
    for i in range(ALONG):
        for j in range(UP):
            around = [(2 * i + 1 + a, 2 * j + 1 + b) for a, b in places(nodes)]
            elements.append([numbers.setdefault(place, len(numbers)) for place in around])
    return numbers, elements


def _shapes(nodes: int, x: float, y: float) -> tuple[Floats, Floats]:
    """Shape functions and their slopes along x and y at a place between -1 and 1."""
    values, slopes = [], []
    for a, b in places(nodes):
        if nodes == 4:
            values.append((1 + a * x) * (1 + b * y) / 4)
            slopes.append((a * (1 + b * y) / 4, b * (1 + a * x) / 4))
        elif a and b:
            values.append((1 + a * x) * (1 + b * y) * (a * x + b * y - 1) / 4)
            slopes.append((a * (1 + b * y) * (2 * a * x + b * y) / 4, b * (1 + a * x) * (2 * b * y + a * x) / 4))
        elif b:
            values.append((1 - x * x) * (1 + b * y) / 2)
            slopes.append((-x * (1 + b * y), b * (1 - x * x) / 2))
        else:
            values.append((1 + a * x) * (1 - y * y) / 2)
            slopes.append((a * (1 - y * y) / 2, -y * (1 + a * x)))
    return np.array(values), np.array(slopes)


def matrices(nodes: int, width: float, height: float, density: float) -> tuple[Floats, Floats]:
    """Stiffness and consistent mass of the whole block, along and up by turns."""
    half = np.array([width / ALONG, height / UP]) / 2
    law = np.array([[1, POISSON, 0], [POISSON, 1, 0], [0, 0, (1 - POISSON) / 2]]) * MODULUS / (1 - POISSON**2)
    one_k, one_m = np.zeros((2, 2 * nodes, 2 * nodes))
    points, weights = np.polynomial.legendre.leggauss(3)
    for x, along in zip(points, weights, strict=True):
        for y, up in zip(points, weights, strict=True):
            values, slopes = _shapes(nodes, x, y)
            slopes = slopes / half
            strain, move = np.zeros((3, 2 * nodes)), np.zeros((2, 2 * nodes))
            strain[0, 0::2] = strain[2, 1::2] = slopes[:, 0]
            strain[1, 1::2] = strain[2, 0::2] = slopes[:, 1]
            move[0, 0::2] = move[1, 1::2] = values
            area = along * up * half.prod()
            one_k += area * strain.T @ law @ strain
            one_m += area * density * move.T @ move
    numbers, elements = mesh(nodes)
    stiffness, mass = np.zeros((2, 2 * len(numbers), 2 * len(numbers)))
    for element in elements:
        of = np.array([[2 * k, 2 * k + 1] for k in element]).ravel()
        stiffness[np.ix_(of, of)] += one_k
        mass[np.ix_(of, of)] += one_m
    return stiffness, mass
