"""Response of the crest of the intact dam, frequency by frequency: amplification, first resonance, effective damping.

Under the ground's motion ``a_g exp(i omega t)``, displacements u relative to the free field,

    [(1 + 2 i xi) K - omega^2 M + i omega L^T H L + S_base] u = -M iota a_g - L^T H G a_g / (i omega),

H that of the water (:class:`heeltoe.models.flexible.surroundings.water.ReducedWater`), S the dynamic stiffness of the
rock, the inverse of its compliance at the base. The damping of the concrete is the same at all frequencies. The
amplification is that of the whole motion of the crest, ``1 - omega^2 u / a_g``: 1 when it goes with the ground."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

from heeltoe.base.arrays import Floats, Integers
from heeltoe.models.flexible.body.elastic import Body, Dam, Sparse, dofs, side_by_side
from heeltoe.models.flexible.body.modes import lowest
from heeltoe.models.flexible.body.reservoir import WaterBody
from heeltoe.models.flexible.surroundings.reduction import Complexes, congruent
from heeltoe.models.flexible.surroundings.rock import ReducedRock
from heeltoe.models.flexible.surroundings.water import ReducedWater

# Modes of the dam on a base that is still, beside the static shapes of the base.
_MODES = 30
# Combinations of shapes with less than this part of the energy of others hold nothing new.
_NOTHING = 1e-8


@dataclass(frozen=True, eq=False)
class CrestResponse:
    """How the crest answers a horizontal motion of the ground.

    Attributes
    ----------
    frequencies
        (k,) [Hz].
    amplification
        (k,) of the acceleration of the crest, complex, over that of the ground.
    resonance
        Frequency of the first peak [Hz]; None where there is none.
    peak
        Amplification there; None without one.
    damping
        Effective damping ratio of the first mode, from the width of the peak at ``1 / sqrt(2)`` of its height; None
        where the peak is too broad to have one.
    """

    frequencies: Floats
    amplification: Complexes
    resonance: float | None
    peak: float | None
    damping: float | None


@dataclass(frozen=True, eq=False)
class IntactDam:
    """A dam with its cracks bonded, in modes over a base that is still and static shapes of the nodes of that base
    (Craig and Bampton 1968); m unknowns, the last 2 n those of the base.

    Attributes
    ----------
    stiffness, mass
        (m, m), of the concrete.
    shapes
        (N, m) displacements of all parts, from the crest down.
    load
        (m,) inertia forces ``M iota`` for a unit horizontal acceleration of the ground [kg per m].
    crest
        (m,) horizontal motion of the crest.
    face
        (2 f, m) motion of the nodes of the upstream face, x and z in turn, part after part from below.
    faces
        These nodes, path by path.
    base
        (n, 2) nodes of the base from heel to toe [m].
    """

    stiffness: Floats
    mass: Floats
    shapes: Floats
    load: Floats
    crest: Floats
    face: Floats
    faces: tuple[Floats, ...]
    base: Floats

    @classmethod
    def of(cls, dam: Dam) -> IntactDam:
        """Return a dam with its cracks bonded."""
        lowest_part = dam.bodies[-1]
        nodes = base_nodes(lowest_part)
        start = sum(body.load.size for body in dam.bodies[:-1])
        total = start + lowest_part.load.size
        held = start + dofs(nodes)
        standing = sparse.csr_matrix((np.ones(held.size), (held, np.arange(held.size))), (total, held.size))
        mass, stiffness = (side_by_side(dam, name) for name in ("mass_concrete", "stiffness"))
        starts = np.cumsum([0, *(body.load.size for body in dam.bodies)])
        upstream = np.concatenate(
            [first + dofs(body.mesh.upstream) for body, first in zip(dam.bodies[::-1], starts[-2::-1], strict=True)]
        )
        shapes = _shapes(stiffness, mass, sparse.csr_matrix(dam.tie), standing, upstream)
        horizontal = np.tile([1.0, 0.0], total // 2)
        return cls(
            shapes.T @ (stiffness @ shapes),
            shapes.T @ (mass @ shapes),
            shapes,
            shapes.T @ (mass @ horizontal),
            shapes[2 * dam.bodies[0].mesh.upstream[-1]],
            shapes[upstream],
            tuple(body.mesh.nodes[body.mesh.upstream] for body in dam.bodies[::-1]),
            lowest_part.mesh.nodes[nodes],
        )

    def crest_motion(
        self, frequencies: Floats, ratio: float, water: WaterOfDam | None, rock: ReducedRock | None
    ) -> Complexes:
        """Return the amplification of the crest (k,) at frequencies [Hz], from 0 on, with a damping ratio of the
        concrete."""
        amplification = np.ones(frequencies.size, dtype=complex)
        for place, omega in enumerate(2.0 * np.pi * frequencies):
            if omega > 0.0:
                amplification[place] -= omega**2 * self.crest @ self.motion(omega, ratio, water, rock)
        return amplification

    def motion(self, omega: float, ratio: float, water: WaterOfDam | None, rock: ReducedRock | None) -> Complexes:
        """Return the unknowns (m,) under a unit horizontal acceleration of the ground like exp(i omega t), omega
        above zero; those of a rigid base are zero."""
        added, extra = (0.0, 0.0) if water is None else (water.mass, water.load)
        operator = (1.0 + 2j * ratio) * self.stiffness - omega**2 * (self.mass + added)
        load = -(self.load + extra) + 0j
        if water is not None and water.omega_squared.size:
            moved = water.pressed(omega)
            operator = operator + 1j * omega * moved[:, :-1]
            load = load - moved[:, -1]
        size = 2 * len(self.base)
        standing = slice(0, self.mass.shape[0] - (0 if rock is not None else size))
        if rock is not None:
            operator[-size:, -size:] += np.linalg.inv(rock.compliance(omega, np.eye(size)))
        answer = np.zeros(self.mass.shape[0], dtype=complex)
        answer[standing] = np.linalg.solve(operator[standing, standing], load[standing])
        return answer


@dataclass(frozen=True, eq=False)
class WaterOfDam:
    """Water on both faces in the m unknowns of a dam: the mass that moves with it, and w modes of the water with waves.

    Attributes
    ----------
    mass
        (m, m) virtual mass [kg per m]; zero of water with waves.
    load
        (m,) its inertia forces for a unit horizontal acceleration of the ground.
    omega_squared, damping
        (w,) and (w, w) of the waves, see :class:`heeltoe.models.flexible.surroundings.water.ReducedWater`.
    coupling
        (w, m) rows by the unknowns of the dam.
    ground
        (w,) for the horizontal velocity of the ground.
    """

    mass: Floats
    load: Floats
    omega_squared: Floats
    damping: Floats
    coupling: Floats
    ground: Floats

    @classmethod
    def before(cls, dam: IntactDam, water: ReducedWater) -> WaterOfDam:
        """Return water with waves, made for ``dam.faces``."""
        size = dam.load.size
        return cls(
            np.zeros((size, size)),
            np.zeros(size),
            water.omega_squared,
            water.damping,
            water.coupling @ dam.face,
            water.ground[:, 0],
        )

    @classmethod
    def of(cls, dam: IntactDam, parts: Dam, water: WaterBody | None) -> WaterOfDam:
        """Return the virtual water of the parts of a dam, and what has waves before them."""
        virtual = side_by_side(parts, "mass") - side_by_side(parts, "mass_concrete")
        horizontal = np.tile([1.0, 0.0], dam.shapes.shape[0] // 2)
        mass, load = dam.shapes.T @ (virtual @ dam.shapes), dam.shapes.T @ (virtual @ horizontal)
        if water is None:
            return cls(mass, load, np.zeros(0), np.zeros((0, 0)), np.zeros((0, load.size)), np.zeros(0))
        return cls(
            mass,
            load,
            water.omega_squared,
            water.damping_floor + water.damping_far,
            np.hstack(water.coupling) @ dam.shapes,
            water.ground[:, 0],
        )

    def pressed(self, omega: float) -> Complexes:
        """Return the forces on the unknowns, against them, for unit velocities of each and, last, for the ground that
        moves with a unit acceleration, (m, m + 1)."""
        forces: Complexes = self.coupling.T @ self.rates(
            omega, np.column_stack([self.coupling, self.ground / (1j * omega)])
        )
        return forces

    def rates(self, omega: float, driven: Complexes) -> Complexes:
        """Return the velocities of the waves (w, ...) for the rates that drive them."""
        operator = np.diag(self.omega_squared - omega**2 + 0j) + 1j * omega * self.damping
        return 1j * omega * np.linalg.solve(operator, driven)


def crest_response(
    dam: IntactDam, frequencies: Floats, ratio: float, *, water: WaterOfDam | None, rock: ReducedRock | None
) -> CrestResponse:
    """Return the response of the crest.

    Parameters
    ----------
    dam
        From :meth:`IntactDam.of`.
    frequencies
        Rising [Hz].
    ratio
        Damping ratio of the concrete.
    water
        On the faces; None for an empty reservoir.
    rock
        Made for ``dam.base``; None for a rigid one.
    """
    amplification = dam.crest_motion(frequencies, ratio, water, rock)
    size = np.abs(amplification)
    peaks = np.flatnonzero((size[1:-1] >= size[:-2]) & (size[1:-1] > size[2:])) + 1
    if not peaks.size:
        return CrestResponse(frequencies, amplification, None, None, None)
    # The grid may miss a sharp peak: it is looked for between its neighbours.
    low, high = frequencies[peaks[0] - 1], frequencies[peaks[0] + 1]
    for _ in range(3):
        near = np.linspace(low, high, 21)
        sizes = np.abs(dam.crest_motion(near, ratio, water, rock))
        top = int(np.clip(np.argmax(sizes), 1, near.size - 2))
        low, high = near[top - 1], near[top + 1]
    resonance, peak = float(near[top]), float(sizes[top])
    damping = _width(dam, ratio, (water, rock), (resonance, peak))
    return CrestResponse(frequencies, amplification, resonance, peak, damping)


def base_nodes(body: Body) -> Integers:
    """Return the nodes on which the lowest part of a dam stands, from heel to toe."""
    nodes = body.mesh.fixed if body.mesh.fixed.size else body.mesh.faces[-1]
    ordered: Integers = nodes[np.argsort(body.mesh.nodes[nodes, 0])]
    return ordered


def _shapes(stiffness: Sparse, mass: Sparse, tie: Sparse, standing: Sparse, pressed: Integers) -> Floats:
    """Return modes over a base that is still with the static shapes of forces on the face, all orthonormal in the
    stiffness, then the static shapes of the nodes of the base; columns over all displacements."""
    inner = sparse.csc_matrix(tie.T @ stiffness @ tie)
    solve = splu(inner).solve
    _, modes = lowest(inner, tie.T @ mass @ tie, min(_MODES, tie.shape[1]), 0.0, solve)
    # Without these the face gives too little under water: 3 % of the crest's motion next to a resonance of the water.
    pushed = solve(tie.T[:, pressed].toarray())
    moving = np.column_stack([modes, pushed / np.sqrt(np.abs(np.sum(pushed * (inner @ pushed), axis=0)) + 1e-300)])
    moving[:, : modes.shape[1]] /= np.sqrt(np.sum(modes * (inner @ modes), axis=0))
    sizes, mixed = scipy.linalg.eigh(congruent(inner, moving))
    kept = sizes > _NOTHING * sizes[-1]
    moving = moving @ (mixed[:, kept] / np.sqrt(sizes[kept]))
    static = standing.toarray() - tie @ solve((tie.T @ stiffness @ standing).toarray())
    shapes: Floats = np.column_stack([tie @ moving, static])
    return shapes


def _width(
    dam: IntactDam,
    ratio: float,
    around: tuple[WaterOfDam | None, ReducedRock | None],
    top: tuple[float, float],
) -> float | None:
    """Return half the relative width of a peak at ``1 / sqrt(2)`` of its height."""
    resonance, peak = top
    ends = []
    for side in (-1.0, 1.0):
        reach, end = 0.01, None
        while reach < 0.6 and end is None:
            near = resonance * (1.0 + side * np.linspace(0.0, reach, 25))
            below = np.flatnonzero(np.abs(dam.crest_motion(near, ratio, *around)) < peak / np.sqrt(2.0))
            if below.size:
                pair = near[below[0] - 1 : below[0] + 1]
                sizes = np.abs(dam.crest_motion(pair, ratio, *around))
                share = (sizes[0] - peak / np.sqrt(2.0)) / (sizes[0] - sizes[1])
                end = float(pair[0] + share * (pair[1] - pair[0]))
            reach *= 2.0
        if end is None:
            return None
        ends.append(end)
    return (ends[1] - ends[0]) / (2.0 * resonance)
