"""Self-excited sliding: how fast a vibration of the sliding dam grows.

While all nodes of the crack are closed and slip one way, friction *mu p_n* follows the normal force, and what is left
of the equations of motion is not symmetric: two vibrations can feed each other from the work of the loads (mode
coupling, as in a brake that squeals). Waves in rock and water take a part of that work."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from scipy.linalg import block_diag

from heeltoe.base.arrays import Floats
from heeltoe.base.blas import one_blas_thread
from heeltoe.kernel.dam import DamRun, Ending
from heeltoe.models.flexible.body.reduced import FlexibleDam, ReducedBody, build_flexible_dam, damped
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.flexible.run.slip_history import sliding_friction
from heeltoe.models.flexible.surroundings.reduction import congruent
from heeltoe.result.numbers import SelfExcitation

#: So many of the lowest modes of each part, with the static shapes of the crack, tell the growth.
_MODES = 25
#: Slower changes than this are none [1/s].
_SLOW = 1e-3


#: From so much growth in all on, the slip depends on damping.
_MATTERS = 1.0


def growth_of(dam: FlexibleDam, friction: Sequence[float | None]) -> tuple[float, float]:
    """Return the fastest growth of a vibration of the dam as it slides, downstream or upstream.

    With the unknowns q of all parts and the forces p of the contacts, all closed: ``q'' + C q' + w^2 q = (S_n - s mu
    S_t)^T p``, ``S_n q' = 0``; s is the direction of slip. A crack that sticks has ``S_t q' = 0``, too. Elastic rock is
    one of the parts; water with sound has its own unknowns, which C couples with those of the dam.

    Parameters
    ----------
    dam
        Where it stands before the earthquake.
    friction
        Coefficient with which a crack slips, from the crest down; None for one that sticks.

    Returns
    -------
    growth : float
        Largest real part of the eigenvalues [1/s]; negative or zero where steady sliding is stable.
    period : float
        Of the vibration that grows so [s]; infinite where nothing swings.
    """
    square, damping, relative = _equations(dam)
    # Rock without mass has vibrations of microseconds, which no step follows; concrete has none beyond its mesh.
    on_rock = any(part.boundary.size for part in dam.parts)
    fastest = math.sqrt(dam.reduced[0].omega_squared.max()) if on_rock else math.inf
    ways: Iterable[tuple[float, ...]] = product((1.0, -1.0), repeat=sum(value is not None for value in friction))

    def growth(way: tuple[float, ...]) -> tuple[float, float]:
        signs = iter(way)
        held, pushed = [], []
        for coefficient, (along, across) in zip(friction, relative, strict=True):
            held += [across] if coefficient is not None else [along, across]
            pushed += [across - next(signs) * coefficient * along] if coefficient is not None else [along, across]
        return _growth(square, damping, np.vstack(held), np.vstack(pushed), fastest)

    return max(map(growth, ways), key=lambda rate_and_period: rate_and_period[0])


def _equations(dam: FlexibleDam) -> tuple[Floats, Floats, list[tuple[Floats, Floats]]]:
    """Return squared frequencies (m,), damping (m, m) and the relative motions of each crack, see :func:`_relative`,
    of all parts together."""
    parts = [_reduced(part) for part in dam.parts]
    rows, wet = (np.hstack([part[place] for part in parts]) for place in (2, 3))
    damping = block_diag(*(part[1] for part in parts)) + rows.T @ (dam.damping.signs[:, None] * rows)
    square = np.concatenate([part[0] for part in parts])
    shapes = [part[4] for part in parts]
    relative = [_relative(dam, shapes, place) for place in range(len(dam.lines))]
    water = dam.reservoir
    if water is None:
        return square, damping, relative
    # It takes energy by its own damping alone: what couples it with the dam is skew.
    damping = np.block([[damping, wet.T], [-wet, water.damping_floor + water.damping_far]])
    dry = np.zeros((1, water.omega_squared.size))
    relative = [
        (np.hstack([along, np.repeat(dry, len(along), 0)]), np.hstack([across, np.repeat(dry, len(across), 0)]))
        for along, across in relative
    ]
    return np.concatenate([square, water.omega_squared]), damping, relative


def _growth(square: Floats, damping: Floats, held: Floats, pushed: Floats, fastest: float) -> tuple[float, float]:
    """Return growth and period of coordinates `held` (c, m) at rest by forces that act along `pushed` (c, m), for
    vibrations up to a circular frequency."""
    free, left = _null(held), _null(pushed).T
    mass, drag, spring = left @ free, left @ damping @ free, left @ (square[:, None] * free)
    count = len(mass)
    rates = np.linalg.solve(mass, np.hstack([-spring, -drag]))
    values = np.linalg.eigvals(np.vstack([np.eye(count, 2 * count, count), rates]))
    # The zeros of the slide as a whole are no vibration.
    swings = values[(np.abs(values) > 1.0) & (np.abs(values) < fastest)]
    first = swings[np.argmax(swings.real)]
    turn = abs(float(first.imag))
    return float(first.real), 2.0 * math.pi / turn if turn > _SLOW else math.inf


def _reduced(part: ReducedBody) -> tuple[Floats, Floats, Floats, Floats, Floats]:
    """Return squared frequencies, damping (m, m), dashpots, rows of the water and shapes (m, 2 k) of a part in fewer
    coordinates: its lowest modes and the static answers to forces on the crack. A part with rock, whose lowest modes
    are those of a box that is much larger than the dam, remains unreduced."""
    order = np.argsort(part.omega_squared)
    low, high = order[:_MODES], order[_MODES:]
    if part.boundary.size or high.size <= part.shapes.shape[1]:
        return part.omega_squared, _damping(part), part.dampers, part.wet, part.shapes
    static = part.shapes[high] / part.omega_squared[high, None]
    basis = np.linalg.qr(static)[0]
    inner = basis.T @ (part.omega_squared[high, None] * basis)
    values, turned = np.linalg.eigh((inner + inner.T) / 2.0)
    kept = np.zeros((order.size, low.size + values.size))
    kept[low, np.arange(low.size)] = 1.0
    kept[high, low.size :] = basis @ turned
    return (
        np.concatenate([part.omega_squared[low], values]),
        congruent(_damping(part), kept),
        part.dampers @ kept,
        part.wet @ kept,
        kept.T @ part.shapes,
    )


def _damping(part: ReducedBody) -> Floats:
    own = np.diag(part.damping_free)
    return own + part.boundary if part.boundary.size else own


def _relative(dam: FlexibleDam, shapes: list[Floats], place: int) -> tuple[Floats, Floats]:
    """Return the motion (k, m) of the nodes of the upper face of a crack against the lower one, along the crack and
    across it, in the unknowns of all parts."""
    along, across = (np.zeros((dam.lines[place].upper[1], sum(map(len, shapes)))) for _ in range(2))
    first = sum(map(len, shapes[:place]))
    upper = _face(dam, shapes, place, slice(dam.bodies[place].mesh.top, None))
    along[:, first : first + len(shapes[place])], across[:, first : first + len(shapes[place])] = upper[1:]
    if place + 1 < len(shapes):
        first += len(shapes[place])
        at, *lower = _face(dam, shapes, place + 1, slice(0, dam.lines[place].lower[1]))
        right = np.clip(np.searchsorted(at, upper[0]), 1, at.size - 1)
        share = np.clip((upper[0] - at[right - 1]) / (at[right] - at[right - 1]), 0.0, 1.0)[:, None]
        for relative, moved in zip((along, across), lower, strict=True):
            relative[:, first : first + moved.shape[1]] = -((1.0 - share) * moved[right - 1] + share * moved[right])
    return along, across


def _face(dam: FlexibleDam, shapes: list[Floats], part: int, nodes: slice) -> tuple[Floats, Floats, Floats]:
    """Return where the nodes (k,) of a face of a part are along its crack [m], and how they move along and across it,
    (k, m) each."""
    along, across = np.split(shapes[part].T, 2)
    position = dam.parts[part].position
    return position[: position.size // 2][nodes], along[nodes], across[nodes]


def _null(rows: Floats) -> Floats:
    """Return an orthonormal basis of the vectors that rows of full rank take to zero."""
    full: Floats = np.linalg.qr(rows.T, mode="complete")[0]
    return full[:, len(rows) :]


#: Of more cracks only the one that leads is looked at, as the only one: the sets and ways of all are too many.
_FEW = 3


@one_blas_thread()
def self_excitation(
    shaken: ShakenDam, run: DamRun, leads: int = 0, ending: Ending | None = None
) -> SelfExcitation | None:
    """Return the growth of a vibration of the dam as it slides; None where it never slides. With several cracks that
    slide, the fastest growth counts among all of them sliding at once and each by itself while the others stick; with
    more, only the governing one by itself.

    Parameters
    ----------
    shaken
        The dam with its earthquake.
    run
        The run that is reported. Where the growth matters, it is repeated with twice the damping, at the step of
        :meth:`~heeltoe.models.flexible.run.dam_runner.ShakenDam.step_beside`.
    leads
        Place of the crack of whose slip is told.
    ending
        What ends the run with twice the damping on another thread than the main one.
    """
    times = [raw.time_sliding + raw.time_slide_rocking for raw in run.summaries]
    sliding = [place for place, time in enumerate(times) if time > 0.0]
    if not sliding:
        return None
    alone = shaken.case.single_crack_cases
    friction = [sliding_friction(case, place, shaken.dam) for place, case in enumerate(alone)]
    if len(alone) > _FEW:
        # A crack that sticks is none.
        place = leads if leads in sliding else max(sliding, key=times.__getitem__)
        rate, period = growth_of(build_flexible_dam(alone[place]), [friction[place]])
    else:
        sets = {frozenset(sliding), *(frozenset([place]) for place in sliding)}
        rate, period = max(
            growth_of(shaken.dam, [value if place in moving else None for place, value in enumerate(friction)])
            for moving in sets
        )
    damped_slip = None
    if rate * max(times) > _MATTERS and run.outcome == "ok":
        raw = run.summaries[leads]
        other = replace(shaken, dam=damped(shaken.dam, 2.0))
        step = other.step_beside(raw.end_time / raw.steps)
        damped_slip = other.run(step, ending=ending).summaries[leads].slip
    return SelfExcitation(
        growth_1_s=rate,
        period_s=period if math.isfinite(period) else None,
        sliding_time_s=max(times),
        twice_damped_slip_m=damped_slip,
    )
