"""Meshes of plain dams, and what is measured on them."""

from pathlib import Path

import numpy as np

from heeltoe.models.flexible.mesh.checks import (
    jacobians,
)
from heeltoe.models.flexible.mesh.dam import dam_mesh, graded_cracks
from shared.outlines import make


def meshed(corners, elevation=0.0, directory=".", **options):
    case = make(corners, elevation, flexible=options)
    case = case.based_in(Path(directory))
    return dam_mesh(case, graded_cracks(case)), case.cut


def bodies(mesh):
    return [body for body in (mesh.upper, mesh.lower) if body]


def area(body):
    """By the Gauss points of the elements, not by the outline as the program does it."""
    x, w = np.polynomial.legendre.leggauss(3)
    points = np.array([(a, b) for a in x for b in x])
    determinants = np.linalg.det(jacobians(body.nodes, body.elements, points))
    return float((determinants @ np.outer(w, w).reshape(-1)).sum())


def on_polyline(points, line):
    """Distance of points from a line of straight pieces."""
    start, along = line[:-1], np.diff(line, axis=0)
    part = np.clip(np.sum((points[:, None] - start) * along, axis=2) / np.sum(along**2, axis=1), 0.0, 1.0)
    return np.linalg.norm(points[:, None] - start - part[..., None] * along, axis=2).min(axis=1)


def flat(corners):
    """Whether some face other than base and crest is a ledge to the program."""
    corners = np.array(corners)
    run, rise = np.abs(np.roll(corners, -1, axis=0) - corners).T
    return np.any(run[rise > 0.0] > 20.0 * rise[rise > 0.0])
