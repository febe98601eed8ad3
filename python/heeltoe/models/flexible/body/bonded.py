"""Parts that dams share which differ only in friction, damping, or fields that their runs read: mesh, matrices, static
loads with the crack bonded, and modes. Nearly all the time of the setup goes into these."""

from __future__ import annotations

import os
from dataclasses import dataclass
from hashlib import sha256
from typing import Any

from heeltoe.base.arrays import Floats
from heeltoe.base.blas import one_blas_thread
from heeltoe.base.cache import Kept
from heeltoe.case.model import Case
from heeltoe.models.flexible.body.cost import building, check_cost, part_of
from heeltoe.models.flexible.body.elastic import Dam, bonded_state, dam, factor, tied
from heeltoe.models.flexible.body.modes import (
    SHOWN_MODES,
    Basis,
    Intact,
    Modes,
    enough_modes,
    error_frequency,
    intact_modes,
)
from heeltoe.models.flexible.body.stress_places import StressPlaces, stress_places
from heeltoe.models.flexible.mesh.dam import dam_mesh, graded_cracks
from heeltoe.models.flexible.mesh.kinks import kinked

# The earthquake plays no part in any dam, nor does what is asked of a run or read by other models.
_OF_RUNS = ("time_step", "evidence", "theta", "penalty_factor", "newmark_gamma", "newmark_beta")
_ANY: Any = dict.fromkeys(("title", "project", "motion", "analysis", "limits", "statics", "decoupled"), True)
_FRICTION = {"friction", "static_friction", "kinetic_friction", "law", "bond"}
_STRENGTH = {"tensile_strength", "dynamic_tension"}
#: What a dam that is ready to be shaken does not depend on.
NOT_OF_DAM: Any = _ANY | {
    "crack": {"restitution", "rocking_loss", "band"},
    "further_cracks": {"__all__": {"restitution"}},
    "concrete": _STRENGTH,
    "flexible": set(_OF_RUNS),
}
#: What its modes do not depend on.
NOT_OF_MODES: Any = _ANY | {
    "crack": {"restitution", "rocking_loss", "band", *_FRICTION},
    "further_cracks": {"__all__": {"restitution", *_FRICTION}},
    "concrete": {"damping", *_STRENGTH},
    "flexible": {*_OF_RUNS, "damping", "damping_on_water", "contact", "contactors"},
    "rock": True,
}


@dataclass(frozen=True, eq=False, kw_only=True)
class BondedDam(Dam):
    """A dam with its crack bonded.

    Attributes
    ----------
    bent
        (2 n,) displacements of each body under the static loads [m].
    bonded_forces
        (2 k,) forces on the nodes of each crack's upper face then, x and z in turn [N].
    intact
        Its lowest modes.
    modes
        Of each body.
    basis_error
        Largest error of the crack's flexibility by the modes left out, see
        :func:`heeltoe.models.flexible.body.modes.error_frequency`; 0 where none is.
    stress_places
        Where the stresses of each body are read.
    """

    bent: tuple[Floats, ...]
    bonded_forces: tuple[Floats, ...]
    intact: Intact
    modes: tuple[Modes, ...]
    basis_error: float
    stress_places: tuple[StressPlaces, ...]


_KEPT: Kept[BondedDam] = Kept(4)
_ELASTIC: Kept[Dam] = Kept(4)


def elastic_dam(case: Case, *, opens: bool = False) -> Dam:
    """Mesh and assemble the parts of a case, for cracks that open or remain bonded; the last few are kept.

    Raises
    ------
    InputError
        As :func:`bonded_dam`.
    """

    graded = graded_cracks(case) if opens else None

    def build() -> Dam:
        mesh = kinked(dam_mesh(case, graded), case)
        check_cost(case, building([part_of(case, part.crack.size, part.nodes.size) for part in mesh.parts]))
        return dam(case, mesh)

    return _ELASTIC.get((opens, case_key(case, NOT_OF_MODES)), build)


@one_blas_thread()
def bonded_dam(case: Case) -> BondedDam:
    """Mesh and assemble the parts of a case and find their modes; the last few are kept.

    Raises
    ------
    InputError
        Where the case has no modulus, or a mesh cannot be made or used.
    """
    return _KEPT.get(case_key(case, NOT_OF_MODES), lambda: _build(case))


def case_key(case: Case, left_out: Any) -> tuple[str, ...]:
    """Return a case without what is left out, with where its water has sound, which of its cracks are graded and what
    its mesh files contain."""
    sound, graded = " ".join(sorted(case.surroundings.sound)), str(graded_cracks(case))
    return case.model_dump_json(exclude=left_out), sound, graded, *fingerprints(case)


def fingerprints(case: Case) -> list[str]:
    """Return what the mesh files contain, as a hash, since they may change under their name; a missing one is the
    reader's to complain about."""
    result = []
    for name in (case.flexible.mesh_above, case.flexible.mesh_below):
        path = case.base_directory / name if name else None
        result.append(sha256(path.read_bytes()).hexdigest() if path and os.path.isfile(path) else "")
    return result


def _build(case: Case) -> BondedDam:
    bonded = elastic_dam(case, opens=True)
    stiffness = tied(bonded, "stiffness")
    solve = factor(stiffness)
    bent, forces = bonded_state(bonded, solve)
    intact = intact_modes(bonded, SHOWN_MODES, stiffness, solve)
    modes, errors = _modes(case, bonded, error_frequency(float(intact.omega[0])))
    return BondedDam(
        bodies=bonded.bodies,
        tie=bonded.tie,
        bent=bent,
        bonded_forces=forces,
        intact=intact,
        modes=modes,
        basis_error=max(errors),
        stress_places=tuple(map(stress_places, bonded.bodies, modes)),
    )


def _modes(case: Case, bonded: Dam, circular: float) -> tuple[tuple[Modes, ...], list[float]]:
    """Return the modes of each body and the error that those left out make."""
    if case.flexible.modes is None:
        result = [enough_modes(Basis.of(body), circular) for body in bonded.bodies]
    else:
        bases = [Basis.of(body) for body in bonded.bodies]
        modes = [basis.modes(case.flexible.modes) for basis in bases]
        result = [(own, basis.error(own, circular)) for own, basis in zip(modes, bases, strict=True)]
    return tuple(modes for modes, _ in result), [error for _, error in result]
