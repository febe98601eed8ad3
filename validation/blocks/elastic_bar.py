"""An elastic bar that falls on a rigid floor, with an exact solution: Doyen, Ern and Piperno (2011).

D. Doyen, A. Ern and S. Piperno, "Time-integration schemes for the finite element dynamic Signorini problem", SIAM
Journal on Scientific Computing 33 (2011), 223-249. Length 10, modulus 900, density 1, gravity 10, dropped from 5 above
the floor: the waves run at 30, so that a blow lasts for 2/3 and leaves the bar as it was; every two blows, after 16/3,
it is where it started.

The crack kernel itself is run, on linear elements with consistent mass and theta 0.5, without damping. It wants two
nodes on the crack: there are two bars side by side, which do not know of each other.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy.linalg

from heeltoe.base.arrays import Floats
from heeltoe.kernel.dam import CrackedDam, only_crack
from heeltoe.models.flexible.body.reduced import ReducedBody
from validation.row import Row

_LENGTH, _MODULUS, _DENSITY, _GRAVITY, _DROP = 10.0, 900.0, 1.0, 10.0, 5.0
_ELEMENTS = 100
_PERIOD, _CONTACT, _FORCE = 16.0 / 3.0, 2.0 / 3.0, 400.0
_ENERGY = _DENSITY * _LENGTH * _GRAVITY * _DROP


def bouncing_bar() -> Iterator[Row]:
    """Elastic bar dropped on a rigid floor, 100 elements: times, force and energy of Doyen, Ern and Piperno."""
    nothing_rebounds = (
        "a node does not rebound: what the foot of the bar held when it struck is lost, a little each time"
    )
    smeared = "in a mesh the wave that ends the contact comes as a front of several elements; 0.8 % with 400 elements"
    for courant in (1.0, 0.5, 2.0):
        one = _bounced(courant)
        what = f"CFL {courant:g}"
        if courant == 1.0:
            # One step is half a per cent of the contact.
            yield Row(f"{what}: first contact lasts, at half its mean force", _CONTACT, one.lasting, 0.01)
            yield Row(f"{what}: the same, at any force", _CONTACT, one.lasting_at_all, None, remark=smeared)
            yield Row(f"{what}: mean force of the first contact", _FORCE, one.force, 0.01)
            yield Row(f"{what}: from the first to the third contact", _PERIOD, one.period, 0.01)
        for number, lost in enumerate(one.lost, 1):
            judged = courant == 1.0 and number == 1
            yield Row(
                f"{what}: energy lost in period {number}, over that of the fall",
                0.0,
                lost,
                0.01 if judged else None,
                relative=False,
                remark=nothing_rebounds,
            )
        yield Row(
            f"{what}: energy made by contact, over turnover", 0.0, one.gained, 1e-12, relative=False, kind="condition"
        )
        yield Row(
            f"{what}: ledger, unexplained over turnover", 0.0, one.residual, 1e-12, relative=False, kind="condition"
        )


@dataclass(frozen=True)
class _Bounced:
    """What one bar did."""

    lasting: float
    lasting_at_all: float
    force: float
    period: float
    lost: list[float]
    gained: float
    residual: float


def _bounced(courant: float) -> _Bounced:
    """Drop the bar and watch it for three periods."""
    longest = courant * _LENGTH / _ELEMENTS / np.sqrt(_MODULUS / _DENSITY)
    per_period = int(np.ceil(_PERIOD / longest))
    step = _PERIOD / per_period
    bars = _two_bars()
    dam = CrackedDam((bars,), only_crack((bars,), (0.5, 0.5)), 3)
    ground = np.zeros((3 * per_period, 2))
    run = dam.run(ground, step, 0.5, stride=1)
    summary, column = run.summary, run.frames
    time, push = column.time, run.force[0][:, 2]
    # Between two contacts the bar is in the air for two seconds.
    touching = time[push > 1e-6 * _FORCE]
    begins = touching[np.diff(touching, prepend=-1.0) > 1.0]
    first = time < begins[0] + 1.0
    total = (column.stored_energy - column.input_energy) / 2.0
    return _Bounced(
        lasting=step * float(np.sum(first & (push > 0.5 * _FORCE))),
        lasting_at_all=step * float(np.sum(first & (push > 1e-6 * _FORCE))),
        force=float(push[first].sum()) * step / _CONTACT,
        period=float(begins[2] - begins[0]),
        lost=(-np.diff(total[::per_period]) / _ENERGY).tolist(),
        gained=summary.energy_gained / summary.energy_turnover,
        residual=summary.energy_residual,
    )


def _two_bars() -> ReducedBody:
    size = _LENGTH / _ELEMENTS
    ends = np.arange(_ELEMENTS)
    stiffness, mass = np.zeros((2, _ELEMENTS + 1, _ELEMENTS + 1))
    for i, j, k, m in ((0, 0, 1, 2), (1, 1, 1, 2), (0, 1, -1, 1), (1, 0, -1, 1)):
        np.add.at(stiffness, (ends + i, ends + j), k * _MODULUS / size)
        np.add.at(mass, (ends + i, ends + j), m * _DENSITY * size / 6.0)
    squares, shapes = scipy.linalg.eigh(stiffness, mass)
    squares[0] = 0.0
    # Modes of one bar, of the other, and one each in which their feet could move sideways.
    feet = scipy.linalg.block_diag(shapes[:1].T, shapes[:1].T)
    all_modes = np.zeros((2 * squares.size + 2, 4))
    all_modes[:-2, 2:] = feet
    all_modes[-2:, :2] = np.eye(2)

    def both(values: Floats) -> Floats:
        return np.concatenate([values, values, [0.0, 0.0]])

    uniform = shapes.T @ mass @ np.ones(squares.size)
    nothing = np.zeros(2 * squares.size + 2)
    return ReducedBody(
        omega_squared=both(squares),
        damping_sticking=nothing,
        damping_free=nothing,
        dampers=np.empty((0, nothing.size)),
        damper_signs=np.empty(0),
        wet=np.empty((0, nothing.size)),
        boundary=np.empty((0, 0)),
        load=both(-_GRAVITY * uniform),
        participation_horizontal=nothing,
        participation_vertical=nothing,
        start=both(_DROP * uniform),
        shapes=all_modes,
        position=np.array([0.0, 1.0, _DROP, _DROP]),
    )
