"""Self-excited sliding: how fast a vibration of the sliding dam grows.

While all nodes of the crack are closed and slip one way, friction *mu p_n* follows the normal force, and what is left
of the equations of motion is not symmetric: two vibrations can feed each other from the work of the loads (mode
coupling, as in a brake that squeals)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.models.flexible.reduced import FlexibleDam, ReducedBody

#: So many of the lowest modes of each part, with the static shapes of the crack, tell the growth.
_MODES = 25
#: Slower changes than this are none [1/s].
_SLOW = 1e-3


#: From so much growth in all on, the slip depends on damping.
_MATTERS = 1.0


@dataclass(frozen=True)
class Growth:
    """How a vibration of a dam grows as it slides.

    Attributes
    ----------
    rate
        Growth of the fastest [1/s]; none where it is negative.
    period
        Of that vibration [s]; infinite where nothing swings.
    sliding_time
        How long the dam slides [s].
    damped_slip
        Residual slip with twice the damping [m], where growth times time is so large that damping matters.
    """

    rate: float
    period: float
    sliding_time: float
    damped_slip: float | None

    @property
    def matters(self) -> bool:
        """Whether the slip depends on damping."""
        return self.rate * self.sliding_time > _MATTERS

    def to_json(self) -> dict[str, float | None]:
        """Return plain numbers."""
        return {
            "growth_1_s": self.rate,
            "period_s": self.period if math.isfinite(self.period) else None,
            "sliding_time_s": self.sliding_time,
            "twice_damped_slip_m": self.damped_slip,
        }


def growth_of(dam: FlexibleDam, friction: float) -> tuple[float, float]:
    """Return the fastest growth of a vibration of the dam as it slides, downstream or upstream.

    With the unknowns q of both parts and the forces p of the contacts, all closed: ``q'' + C q' + w^2 q = (S_n - s mu
    S_t)^T p``, ``S_n q' = 0``; s is the direction of slip.

    Parameters
    ----------
    dam
        Where it stands before the earthquake.
    friction
        Coefficient with which the crack slips.

    Returns
    -------
    growth : float
        Largest real part of the eigenvalues [1/s]; negative or zero where steady sliding is stable.
    period : float
        Of the vibration that grows so [s]; infinite where nothing swings.
    """
    return max((_growth(dam, friction, way) for way in (1.0, -1.0)), key=lambda found: found[0])


def _growth(dam: FlexibleDam, friction: float, way: float) -> tuple[float, float]:
    reduced = [_reduced(part) for part in dam.reduced]
    square = np.concatenate([each[0] for each in reduced])
    size = square.size
    damping = np.zeros((size, size))
    first = 0
    for each in reduced:
        count = each[0].size
        damping[first : first + count, first : first + count] = each[1]
        first += count
    rows = np.hstack([each[2] for each in reduced])
    damping += rows.T @ (dam.damping.signs[:, None] * rows)
    along, across = _relative(dam, [each[3] for each in reduced])
    free, left = _null(across), _null(across - way * friction * along).T
    mass, drag, spring = left @ free, left @ damping @ free, left @ (square[:, None] * free)
    count = len(mass)
    rates = np.linalg.solve(mass, np.hstack([-spring, -drag]))
    values = np.linalg.eigvals(np.vstack([np.eye(count, 2 * count, count), rates]))
    # The two zeros of the slide as a whole are no vibration.
    swings = values[np.abs(values) > 1.0]
    fastest = swings[np.argmax(swings.real)]
    turn = abs(float(fastest.imag))
    return float(fastest.real), 2.0 * math.pi / turn if turn > _SLOW else math.inf


def _reduced(part: ReducedBody) -> tuple[Floats, Floats, Floats, Floats]:
    """Return squared frequencies, damping (m, m), dashpots and shapes (m, 2 k) of a part in fewer coordinates: its
    lowest modes and the static answers to forces on the crack."""
    order = np.argsort(part.omega_squared)
    low, high = order[:_MODES], order[_MODES:]
    if high.size <= part.shapes.shape[1]:
        return part.omega_squared, np.diag(part.damping_free), part.dampers, part.shapes
    static = part.shapes[high] / part.omega_squared[high, None]
    basis = np.linalg.qr(static)[0]
    inner = basis.T @ (part.omega_squared[high, None] * basis)
    values, turned = np.linalg.eigh((inner + inner.T) / 2.0)
    basis = basis @ turned
    count = low.size
    damping = np.zeros((count + values.size, count + values.size))
    damping[:count, :count] = np.diag(part.damping_free[low])
    damping[count:, count:] = basis.T @ (part.damping_free[high, None] * basis)
    return (
        np.concatenate([part.omega_squared[low], values]),
        damping,
        np.hstack([part.dampers[:, low], part.dampers[:, high] @ basis]),
        np.vstack([part.shapes[low], basis.T @ part.shapes[high]]),
    )


def _relative(dam: FlexibleDam, shapes: list[Floats]) -> tuple[Floats, Floats]:
    """Return the motion (k, m) of the nodes of the upper face against the lower one, along the crack and across it."""
    above = np.split(shapes[0].T, 2)
    if len(shapes) == 1:
        return above[0], above[1]
    places = [part.position[: part.position.size // 2] for part in dam.reduced]
    below = np.split(shapes[1].T, 2)
    right = np.clip(np.searchsorted(places[1], places[0]), 1, places[1].size - 1)
    share = np.clip((places[0] - places[1][right - 1]) / (places[1][right] - places[1][right - 1]), 0.0, 1.0)[:, None]
    follow = [(1.0 - share) * each[right - 1] + share * each[right] for each in below]
    return np.hstack([above[0], -follow[0]]), np.hstack([above[1], -follow[1]])


def _null(rows: Floats) -> Floats:
    """Return an orthonormal basis of the vectors that rows of full rank take to zero."""
    full: Floats = np.linalg.qr(rows.T, mode="complete")[0]
    return full[:, len(rows) :]
