"""Elastic dams of plain sections."""

import numpy as np

from heeltoe.models.flexible.body.elastic import bonded_state, dam
from heeltoe.models.flexible.mesh.checks import check_elements
from heeltoe.models.flexible.mesh.dam import dam_mesh
from shared.meshes import bodies
from shared.outlines import make

G = 9.80665
CONCRETE = {"density": "2650 kg/m^3", "modulus": "20 GPa", "poisson": 0.2}


def built(corners, elevation=0.0, bend=None, concrete=CONCRETE, **more):
    """Return case, section and elastic dam; `bend` moves the nodes of the meshes first."""
    case = make(corners, elevation, concrete=concrete, **more)
    mesh = dam_mesh(case)
    for body in bodies(mesh) if bend else ():
        body.nodes[:] = bend(body)
        check_elements(body.nodes, body.elements, "bent")
    return case, case.cut, dam(case, mesh)


def bonded(one):
    """Return the displacements of both parts of a dam with one crack bonded, and the forces on it."""
    moved, (force,) = bonded_state(one)
    return moved[0], moved[1] if len(moved) > 1 else np.empty(0), force


def deep(depth):
    return {"depth": f"{depth!r} m"}


def parts(one):
    return [body for body in (one.upper, one.lower) if body]


def resultant(body, forces, section):
    """Sum of forces and moment about the heel."""
    x, z = (body.mesh.nodes - section.heel).T
    fx, fz = forces[::2], forces[1::2]
    return np.array([fx.sum(), fz.sum(), np.sum(x * fz - z * fx)])
