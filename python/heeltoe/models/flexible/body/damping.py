"""Damping of the concrete: what each mode gets, the few dashpots between modes, and the ratios that really come of it.

With the motion v of all parts in their modes, the damping force is ``-(c v + d^T s d v)``: coefficients c mode by mode
and a few rows d over the modes of all parts, the dashpots, with signs s."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.models.flexible.body.bonded import BondedDam
from heeltoe.models.flexible.body.elastic import Body, Dam, dofs, factor, rigid_motions, tied
from heeltoe.models.flexible.body.modes import SHOWN_MODES, Modes, intact_modes, part_periods, rayleigh

#: So many of the lowest modes of the bonded dam get exactly one ratio under `modal`; what is above gets more, in
#: proportion to its frequency.
_MODAL = 20
#: Motions of water with less mass than this of the largest are rounding.
_NO_WATER = 1e-12


@dataclass(frozen=True, eq=False)
class Damping:
    """Damping of the parts of a dam, from the crest down; m modes each.

    Attributes
    ----------
    sticking, free
        (m,) coefficients [1/s] of each part while some crack node sticks, and while none does.
    dashpots
        (k, m) rows of each part [s^(-1/2)].
    signs
        (k,) 1 for dashpots that take energy, -1 for those that give back what the mass of the water is damped with.
    coefficients
        Rayleigh coefficients of mass [1/s] and stiffness [s]; None with `modal`.
    of_stiffness
        That of the stiffness, with `modal`, too [s].
    periods
        Longest periods of the intact dam with its water [s], at most five.
    ratios
        Share of critical damping that these modes really get while the crack sticks.
    between
        (m, m) what couples the modes of the lowest part [1/s], where the rock is one body with it; (0, 0) elsewhere.
    factor
        How many times as much as the case asks for this is.
    """

    sticking: tuple[Floats, ...]
    free: tuple[Floats, ...]
    dashpots: tuple[Floats, ...]
    signs: Floats
    coefficients: tuple[float, float] | None
    of_stiffness: float
    periods: Floats
    ratios: Floats
    between: Floats = field(default_factory=lambda: np.empty((0, 0)))
    factor: float = 1.0

    def scaled(self, factor: float) -> Damping:
        """Return this damping multiplied by `factor`."""
        return Damping(
            tuple(factor * c for c in self.sticking),
            tuple(factor * c for c in self.free),
            tuple(math.sqrt(factor) * d for d in self.dashpots),
            self.signs,
            None if self.coefficients is None else (factor * self.coefficients[0], factor * self.coefficients[1]),
            factor * self.of_stiffness,
            self.periods,
            factor * self.ratios,
            factor * self.between,
            factor * self.factor,
        )

    def founded(self, held: Floats, bent: Floats) -> Damping:
        """Return the same damping of the concrete where the lowest part is one body with the rock.

        The mass of that part is damped relative to the motion of its base. Damping couples the modes of both.

        Parameters
        ----------
        held
            (h, m) share of each of its modes on a base that is still in each mode of both.
        bent
            (m, m) stiffness of the concrete that the motion of its base bends [1/s2].
        """
        between = held.T @ (self.sticking[-1][:, None] * held) + self.of_stiffness * bent
        own = np.diag(between).copy()
        dashpots = (*self.dashpots[:-1], self.dashpots[-1] @ held)
        sticking, free = ((*of_parts[:-1], own) for of_parts in (self.sticking, self.free))
        return replace(self, sticking=sticking, free=free, dashpots=dashpots, between=between - np.diag(own))


def damping_of(case: Case, dam: BondedDam) -> Damping:
    """Return the damping that a case asks for.

    Parameters
    ----------
    case
        With ``flexible.damping`` and ``concrete.damping``.
    dam
        The elastic bodies in their modes.
    """
    choice = case.flexible.damping
    omega, bonded = _bonded(dam, bonded_count(choice))
    lags = _crack_motions(dam, dam.modes) if choice in ("relative", "modal") else []
    dry = choice == "relative" and not case.flexible.damping_on_water
    water = _water_motion(dam, dam.modes, lags) if dry else ()
    return spread_damping(case, dam.modes, omega, bonded, lags, water)


def bonded_count(choice: str) -> int:
    """Return how many modes of the bonded dam a choice of damping is made from."""
    return _MODAL + 1 if choice == "modal" else SHOWN_MODES


def spread_damping(
    case: Case,
    modes: tuple[Modes, ...],
    omega: Floats,
    bonded: tuple[Floats, ...],
    lags: list[list[Floats]],
    water: tuple[Floats, ...] = (),
) -> Damping:
    """Return the damping that a case asks for, of parts that move in one way.

    Parameters
    ----------
    case
        With ``flexible.damping`` and ``concrete.damping``.
    modes
        Of each part.
    omega, bonded
        (j,) circular frequencies of the bonded dam [1/s], and these modes (j, m) in those of each part.
    lags
        For each crack rows for each part: the rigid motion that the part above would lack to follow the face below.
    water
        Rows of the motion of water that is not to be damped, for each part.
    """
    choice, ratio, dry = case.flexible.damping, case.concrete.damping, bool(water)
    periods = 2.0 * math.pi / omega[:SHOWN_MODES]
    coefficients: tuple[float, float] | None = rayleigh(periods[0], periods[min(2, len(periods) - 1)], ratio)
    if choice == "stiffness":
        coefficients = (0.0, 2.0 * ratio / omega[0])
    elif choice == "modal":
        coefficients = None
    if dry:
        coefficients = _dry_rayleigh(omega, 1.0 - _norms(water, bonded), ratio)
    mass, stiffness = coefficients or (0.0, 2.0 * ratio / omega[-1])
    sticking = tuple(mass + stiffness * mode.omega_squared for mode in modes)
    rows: tuple[Floats, ...] = tuple(np.empty((0, mode.omega_squared.size)) for mode in modes)
    free = sticking
    if choice in ("relative", "deformation"):
        for coefficients_of, mode in zip(sticking, modes, strict=True):
            coefficients_of[: mode.rigid] = 0.0
    if choice == "relative":
        rows = tuple(
            math.sqrt(mass) * np.vstack(all_of) for all_of in zip(*lags, *([water] if dry else []), strict=True)
        )
    elif choice == "modal":
        below = omega[:-1]
        shares = np.sqrt(below * (2.0 * ratio - stiffness * below))[:, None]
        rows = _without_slip([shares * item[:-1] for item in bonded], lags, modes)
    elif choice == "thesis":
        free = (np.zeros_like(sticking[0]), *(_own(mode, ratio) for mode in modes[1:]))
    signs = np.ones(len(rows[0]))
    if dry:
        signs[sum(len(lag[0]) for lag in lags) :] = -1.0
    ratios = _ratios(sticking, (rows, signs), omega, bonded)[:SHOWN_MODES]
    return Damping(sticking, free, rows, signs, coefficients, stiffness, periods, ratios)


def _own(modes: Modes, ratio: float) -> Floats:
    """Return Rayleigh damping by the first and third period of a part itself."""
    own = part_periods(modes, 3)
    mass, stiffness = rayleigh(own[0], own[-1], ratio)
    return mass + stiffness * modes.omega_squared


def _bonded(dam: BondedDam, count: int) -> tuple[Floats, tuple[Floats, ...]]:
    """Return the lowest circular frequencies [1/s] of the dam with its crack bonded, and these modes (j, m) in the
    modes of each part."""
    intact = dam.intact
    if count > SHOWN_MODES:
        stiffness = tied(dam, "stiffness")
        intact = intact_modes(dam, count, stiffness, factor(stiffness))
    places = np.cumsum([body.load.size for body in dam.bodies])[:-1]
    pieces = np.split(intact.momenta, places)
    return intact.omega, tuple((basis.shapes.T @ piece).T for basis, piece in zip(dam.modes, pieces, strict=True))


def _crack_motions(dam: Dam, modes: tuple[Modes, ...]) -> list[list[Floats]]:
    """Return for each crack rows (3, m) for each part: how the part above it would have to move as a rigid body, in
    addition to the motion of its rigid modes, to follow the lower face without slip; with the sign of a lag.

    The rigid motion is fitted to the nodes of a crack face by least squares along the crack. Zero while the crack is
    bonded means that the fits to both faces are the same.
    """
    result = []
    for crack in range(dam.free):
        upper, basis, lower = dam.bodies[crack].mesh, modes[crack], dam.below(crack)
        rigid = basis.shapes[:, : basis.rigid]
        face, points = dofs(upper.faces[-1]), upper.nodes[upper.faces[-1]]
        rows = [np.zeros((3, mode.omega_squared.size)) for mode in modes]
        rows[crack] = _fit(points, rigid[face]) @ basis.shapes[face]
        rows[crack][:, : basis.rigid] = 0.0
        if lower is not None:
            met = lower.mesh.faces[0]
            plane = np.linalg.lstsq(rigid_motions(points), rigid[face], rcond=None)[0]
            points = lower.mesh.nodes[met]
            rows[crack + 1] = -_fit(points, rigid_motions(points) @ plane) @ modes[crack + 1].shapes[dofs(met)]
        result.append(rows)
    # A part that slides itself, with all that is above it, is not to be damped for that: it counts as following what is
    # below it, and so on down.
    for crack in range(dam.free - 2, -1, -1):
        count = modes[crack + 1].rigid
        held = result[crack][crack + 1][:, :count].copy()
        result[crack][crack + 1][:, :count] = 0.0
        result[crack] = [own - held @ lag for own, lag in zip(result[crack], result[crack + 1], strict=True)]
    return result


def _water_motion(dam: Dam, modes: tuple[Modes, ...], lags: list[list[Floats]]) -> tuple[Floats, ...]:
    """Return rows (w, m) for each part whose squares are the mass of the water times that of the motion that the mass
    term damps: of a part above a crack that relative to the rigid motion fitted to its face, else all."""
    result: list[list[Floats]] = [[] for _ in modes]
    for place, (body, basis) in enumerate(zip(dam.bodies, modes, strict=True)):
        wet, root = _root_of_water(body)
        rigid = root @ basis.shapes[wet, : basis.rigid]
        own = root @ basis.shapes[wet]
        own[:, : basis.rigid] = 0.0
        for other, rows in enumerate(result):
            moved = np.zeros((len(root), modes[other].omega_squared.size)) if other != place else own
            rows.append(moved - rigid @ lags[place][other] if place < dam.free else moved)
    return tuple(np.vstack(rows) for rows in result)


def _root_of_water(body: Body) -> tuple[NDArray[np.int64], Floats]:
    """Return the displacements that move water, and a root (w, k) of its mass on them."""
    water = (body.mass - body.mass_concrete).tocsr()
    wet = np.flatnonzero(water.diagonal())
    values, shapes = np.linalg.eigh(water[wet][:, wet].toarray())
    kept = values > _NO_WATER * values.max(initial=0.0)
    return wet, np.sqrt(values[kept])[:, None] * shapes[:, kept].T


def _norms(rows: tuple[Floats, ...], bonded: tuple[Floats, ...]) -> Floats:
    """Return the sums of squares of rows on modes (j, m) of the bonded dam."""
    moved = sum(row @ motion.T for row, motion in zip(rows, bonded, strict=True))
    total: Floats = np.sum(np.square(moved), axis=0)
    return total


def _dry_rayleigh(omega: Floats, shares: Floats, ratio: float) -> tuple[float, float]:
    """Return coefficients of mass [1/s] and stiffness [s] that give the first and third mode a ratio, where only these
    shares of a mode's mass are damped."""
    chosen = [0, min(2, len(omega) - 1)]
    terms = np.column_stack([shares[chosen] / omega[chosen], omega[chosen]]) / 2.0
    mass, stiffness = np.linalg.lstsq(terms, np.full(2, ratio), rcond=None)[0]
    return float(mass), float(stiffness)


def _fit(points: Floats, shapes: Floats) -> Floats:
    """Return the matrix (3, 2 k) that finds in displacements of a face its shares in three shapes (2 k, 3)."""
    length = np.hypot(*np.diff(points[::2], axis=0).T)
    weight = np.zeros(len(points))
    for place, part in ((0, 1.0), (1, 4.0), (2, 1.0)):  # Simpson, edge by edge
        weight[place : len(points) - 2 + place : 2] += part * length / 6.0
    twice = np.repeat(weight, 2)[:, None] * shapes
    return np.asarray(np.linalg.solve(shapes.T @ twice, twice.T), dtype=np.float64)


def _without_slip(rows: list[Floats], lags: list[list[Floats]], modes: tuple[Modes, ...]) -> tuple[Floats, ...]:
    """Take out of rows what they feel of the rigid motion of each part above a crack against the lower face."""
    for place, lag in enumerate(lags):
        count = modes[place].rigid
        held = rows[place][:, :count].copy()
        rows[place][:, :count] = 0.0
        rows = [row - held @ motion for row, motion in zip(rows, lag, strict=True)]
    return tuple(rows)


def _ratios(
    coefficients: tuple[Floats, ...],
    dashpots: tuple[tuple[Floats, ...], Floats],
    omega: Floats,
    bonded: tuple[Floats, ...],
) -> Floats:
    """Return the share of critical damping of bonded modes: the power of damping over that of critical damping."""
    rows, signs = dashpots
    power, stretched = np.zeros_like(omega), np.zeros((len(rows[0]), omega.size))
    for mode, c, row in zip(bonded, coefficients, rows, strict=True):
        power += mode**2 @ c
        stretched += row @ mode.T
    result: Floats = (power + signs @ stretched**2) / (2.0 * omega)
    return result
