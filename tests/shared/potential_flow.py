"""Potential flow of still, incompressible water before a face that moves: an oracle for virtual water."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from skfem import Basis, ElementTriP2, FacetBasis, Functional, LinearForm, MeshQuad, condense, solve
from skfem.models.poisson import laplace


def push(face: Callable[[np.ndarray], np.ndarray], columns: int = 80, rows: int = 32) -> tuple[float, float]:
    """Return the forces, towards the dam and down on it, of water 1 deep and of density 1 on a face that is
    accelerated horizontally into it by 1.

    ``div grad p = 0``, p = 0 at the surface and far away, no flow through the level bottom, ``dp/dn = -n_x`` on the
    face; `face` says how far it stands out into the water at each height.
    """
    far = 5.0 + float(np.max(face(np.linspace(0.0, 1.0, 11))))
    s, z = np.meshgrid(np.linspace(0.0, 1.0, columns + 1) ** 2, np.linspace(0.0, 1.0, rows + 1), indexing="ij")
    x = face(z) + (far - face(z)) * s
    number = np.arange(s.size).reshape(s.shape)
    corners = [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]]
    quads = MeshQuad(np.vstack([x.ravel(), z.ravel()]), np.vstack([corner.ravel() for corner in corners]))
    mesh = quads.to_meshtri()
    basis = Basis(mesh, ElementTriP2())
    on_face = mesh.facets_satisfying(lambda at: np.abs(at[0] - face(at[1])) < 1e-6, boundaries_only=True)
    edge = FacetBasis(mesh, ElementTriP2(), facets=on_face)
    driven = LinearForm(lambda v, w: -w.n[0] * v).assemble(edge)
    still = basis.get_dofs(lambda at: (np.abs(at[1] - 1.0) < 1e-9) | (np.abs(at[0] - far) < 1e-9)).all()
    pressure = edge.interpolate(solve(*condense(laplace.assemble(basis), driven, D=still)))
    sums = [Functional(lambda w, k=k: -w.n[k] * w["p"]).assemble(edge, p=pressure) for k in (0, 1)]
    return float(sums[0]), float(sums[1])


def leaning(degrees: float) -> Callable[[np.ndarray], np.ndarray]:
    """A straight face that leans back from the water by an angle from the vertical."""
    return lambda z: math.tan(math.radians(degrees)) * (1.0 - z)
