"""The dam across the valley: one displacement at right angles to the section, in the mesh of the section.

``M w'' + C w' + K w = -M 1 a + forces in the cracks``, with ``K = int G grad N . grad N`` and ``M = int rho N N`` of
antiplane shear (Timoshenko and Goodier, Theory of Elasticity, chapter 10). Nothing in the bodies couples it with the
motion in the section. Water does nothing: it slides along the faces. The static loads leave w zero."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sparse
from scipy.linalg import eigh

from heeltoe.base.arrays import Floats
from heeltoe.base.blas import one_blas_thread
from heeltoe.base.cache import Kept
from heeltoe.case.model import Case
from heeltoe.models.flexible.body.bonded import NOT_OF_MODES, case_key
from heeltoe.models.flexible.body.damping import Damping, bonded_count, spread_damping
from heeltoe.models.flexible.body.elastic import Body, Dam, Sparse, factor, scalar_matrices
from heeltoe.models.flexible.body.modes import Basis, Modes, enough_modes, error_frequency, lowest
from heeltoe.models.flexible.body.reduced import FlexibleDam, ReducedBody
from heeltoe.models.flexible.body.rock import RockBody, rock_below, rock_body
from heeltoe.models.flexible.surroundings.reduction import congruent
from heeltoe.models.flexible.surroundings.response import base_nodes


@dataclass(frozen=True, eq=False)
class AcrossBody:
    """A part across the valley; n nodes.

    Attributes
    ----------
    body
        The part in the plane of the section.
    stiffness, mass
        (n, n) [N/m per m], [kg per m].
    modes
        Its modes, shapes (n, m).
    """

    body: Body
    stiffness: Sparse
    mass: Sparse
    modes: Modes


@dataclass(frozen=True, eq=False)
class AcrossDam:
    """A dam ready to be shaken across the valley.

    Attributes
    ----------
    parts
        Its bodies in their modes, as the kernel takes them, with one component for each crack node.
    crest
        (m,) how far each mode of the part at the crest moves its upstream edge.
    damping
        That of the concrete, with the periods of the intact dam.
    """

    parts: tuple[ReducedBody, ...]
    crest: Floats
    damping: Damping


@dataclass(frozen=True, eq=False)
class _Founded:
    """The lowest part as one body with the rock, see :class:`heeltoe.models.flexible.body.rock.Founded`."""

    modes: Modes
    held: Floats
    bent: Floats
    rock: Floats


@dataclass(frozen=True, eq=False)
class _Bonded:
    """The field without its damping: parts, frequencies of the bonded dam [1/s] and momenta of its modes, and the
    rock below a crack at the base, or as one body with the lowest part."""

    bodies: tuple[AcrossBody, ...]
    omega: Floats
    momenta: Floats
    rock: RockBody | None
    founded: _Founded | None


_KEPT: Kept[_Bonded] = Kept(4)


@one_blas_thread()
def across_dam(case: Case, dam: FlexibleDam) -> AcrossDam:
    """Return a dam across the valley; its modes, of the last few, are kept.

    Parameters
    ----------
    case
        With concrete and damping.
    dam
        The dam in the plane of the section, whose damping may be a multiple of that of the case.
    """
    count = bonded_count(case.flexible.damping)
    key = (str(count), repr(case.foundation), *case_key(case, NOT_OF_MODES))
    bonded = _KEPT.get(key, lambda: _bonded(case, dam, count))
    modes = tuple(body.modes for body in bonded.bodies)
    places = np.cumsum([body.mass.shape[0] for body in bonded.bodies])[:-1]
    pieces = np.split(bonded.momenta, places)
    shares = tuple((basis.shapes.T @ piece).T for basis, piece in zip(modes, pieces, strict=True))
    lags = _lags(dam, modes) if case.flexible.damping in ("relative", "modal") else []
    damping = spread_damping(case, modes, bonded.omega, shares, lags).scaled(dam.damping.factor)
    bodies, whole, rock = bonded.bodies, bonded.founded, bonded.rock
    if whole is not None:
        damping = damping.founded(whole.held, whole.bent)
        bodies = (*bodies[:-1], replace(bodies[-1], modes=whole.modes))
    parts = tuple(_reduced(body, damping, place) for place, body in enumerate(bodies))
    if whole is not None:
        parts = (*parts[:-1], replace(parts[-1], boundary=whole.rock + damping.between))
    if rock is not None:
        parts = (*parts, _reduced_rock(rock, parts[0]))
    upper = bonded.bodies[0]
    crest = np.ascontiguousarray(upper.modes.shapes[upper.body.mesh.upstream[-1]])
    return AcrossDam(parts, crest, damping)


def _bonded(case: Case, dam: Dam, count: int) -> _Bonded:
    matrices = [scalar_matrices(case, body.mesh) for body in dam.bodies]
    # The faces hang together across the valley as they do along the stream.
    tie = dam.tie[::2]
    tie = tie[:, np.flatnonzero(abs(tie).sum(axis=0))]
    stiffness, mass = (sparse.block_diag([pair[k] for pair in matrices], format="csc") for k in (0, 1))
    tied = [(tie.T @ matrix @ tie).tocsc() for matrix in (stiffness, mass)]
    squares, shapes = lowest(tied[0], tied[1], min(count, tie.shape[1]), 0.0)
    omega = np.sqrt(squares)
    bodies = []
    for body, (stiff, heavy) in zip(dam.bodies, matrices, strict=True):
        basis = _basis(body, stiff, heavy)
        kept = case.flexible.modes
        modes = enough_modes(basis, error_frequency(float(omega[0])))[0] if kept is None else basis.modes(kept)
        bodies.append(AcrossBody(body, stiff, heavy, modes))
    rock = rock_body(case, dam.bodies[-1], across=True)
    return _Bonded(tuple(bodies), omega, mass @ (tie @ shapes), rock, _founded(case, bodies[-1]))


def _founded(case: Case, lowest: AcrossBody) -> _Founded | None:
    """Return the lowest part as one body with the rock; None on a rigid plane, or where the dam is cracked there."""
    if case.foundation is None or not lowest.body.mesh.fixed.size:
        return None
    nodes = base_nodes(lowest.body)
    rock = rock_below(lowest.body.mesh.nodes[nodes], case, across=True)
    free = np.setdiff1d(np.arange(lowest.mass.shape[0]), lowest.body.mesh.fixed)
    below = np.zeros((lowest.mass.shape[0], rock.omega_squared.size))
    below[nodes] = rock.shapes
    held = lowest.stiffness[free][:, nodes] @ rock.shapes
    below[free] = -factor(lowest.stiffness[free][:, free])(held)
    own, count = lowest.modes, lowest.modes.omega_squared.size
    mass = np.eye(count + rock.omega_squared.size)
    mass[:count, count:] = own.shapes.T @ (lowest.mass @ below)
    mass[count:, :count] = mass[:count, count:].T
    mass[count:, count:] += congruent(lowest.mass, below)
    bent = congruent(lowest.stiffness, below)
    stiffness = np.diag(np.concatenate([own.omega_squared, rock.omega_squared]))
    stiffness[count:, count:] += bent
    squares, vectors = eigh(stiffness, mass)
    still, moved = vectors[:count], vectors[count:]
    shapes = own.shapes @ still + below @ moved
    modes = Modes(squares, shapes, 0, squares.size, own.total + rock.omega_squared.size, truncated=True)
    return _Founded(modes, still, congruent(bent, moved), congruent(rock.damping, moved))


def _basis(body: Body, stiffness: Sparse, mass: Sparse) -> Basis:
    mesh = body.mesh
    ones = np.ones((len(mesh.nodes), 1))
    held = mesh.fixed.size > 0
    pushed = mass @ ones
    return Basis(
        stiffness,
        mass,
        rigid=ones[:, :0] if held else ones / math.sqrt(float(pushed.sum())),
        held=mesh.fixed,
        crack=mesh.crack,
        loads=pushed if held else ones[:, :0],
        bent=mesh.nodes[:, 1] - mesh.nodes[:, 1].mean(),
    )


def _lags(dam: Dam, modes: tuple[Modes, ...]) -> list[list[Floats]]:
    """Return for each crack rows (1, m) for each part: how far the part above it would have to move in addition to its
    rigid mode to follow the lower face without slip; the motions of faces are means along them."""
    result = []
    for crack in range(dam.free):
        upper, lower = dam.bodies[crack].mesh, dam.below(crack)
        whole = 1.0 / modes[crack].shapes[0, 0]
        rows = [np.zeros((1, mode.omega_squared.size)) for mode in modes]
        face = upper.faces[-1]
        rows[crack][0] = whole * _mean(upper.nodes[face]) @ modes[crack].shapes[face]
        rows[crack][0, 0] = 0.0
        if lower is not None:
            face = lower.mesh.faces[0]
            rows[crack + 1][0] = -whole * _mean(lower.mesh.nodes[face]) @ modes[crack + 1].shapes[face]
        result.append(rows)
    # A part that slides itself is not damped for that, see `damping`.
    for crack in range(dam.free - 2, -1, -1):
        held = float(result[crack][crack + 1][0, 0])
        result[crack][crack + 1][0, 0] = 0.0
        result[crack] = [own - held * lag for own, lag in zip(result[crack], result[crack + 1], strict=True)]
    return result


def _mean(points: Floats) -> Floats:
    """Return the weights (k,) of the nodes of a face in the mean along it: Simpson, edge by edge."""
    length = np.hypot(*np.diff(points[::2], axis=0).T)
    weight = np.zeros(len(points))
    for place, part in ((0, 1.0), (1, 4.0), (2, 1.0)):
        weight[place : len(points) - 2 + place : 2] += part * length / 6.0
    mean: Floats = weight / weight.sum()
    return mean


def _reduced(body: AcrossBody, damping: Damping, place: int) -> ReducedBody:
    shapes, crack = body.modes.shapes, body.body.mesh.crack
    none = np.zeros(body.modes.omega_squared.size)
    return ReducedBody(
        omega_squared=np.ascontiguousarray(body.modes.omega_squared),
        damping_sticking=np.ascontiguousarray(damping.sticking[place]),
        damping_free=np.ascontiguousarray(damping.free[place]),
        load=none,
        participation_horizontal=shapes.T @ np.asarray(body.mass.sum(axis=1)).reshape(-1),
        participation_vertical=none,
        start=none,
        shapes=np.ascontiguousarray(shapes[crack].T),
        position=np.zeros(crack.size),
        dampers=np.ascontiguousarray(damping.dashpots[place]),
        damper_signs=damping.signs,
        wet=np.empty((0, none.size)),
        boundary=np.empty((0, 0)),
    )


def _reduced_rock(rock: RockBody, part: ReducedBody) -> ReducedBody:
    """Return the rock as a body of the kernel, which no ground shakes, with as many dashpots as a `part` of the dam."""
    none, size = np.zeros(rock.omega_squared.size), rock.omega_squared.size
    return ReducedBody(
        omega_squared=rock.omega_squared,
        damping_sticking=none,
        damping_free=none,
        load=none,
        participation_horizontal=none,
        participation_vertical=none,
        start=none,
        shapes=rock.shapes,
        position=np.zeros(len(rock.points)),
        dampers=np.zeros((len(part.dampers), size)),
        damper_signs=part.damper_signs,
        wet=np.empty((0, size)),
        boundary=rock.damping,
    )
