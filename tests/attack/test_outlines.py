"""Corners of a section that are finer than a mesh, and a crest that is level but for a slip of the hand."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe.models.flexible.mesh.dam import dam_mesh
from heeltoe.models.flexible.warnings import _about_the_mesh
from shared.dams import TYPICAL
from shared.outlines import make

HEIGHTS = np.linspace(0.0, 100.0, 1000)
CURVE = 80.0 * (1.0 - HEIGHTS / 100.0) ** 1.3 + 8.0


def drawn(face):
    """Return the case of a dam with this downstream face."""
    corners = zip(face.tolist(), HEIGHTS.tolist(), strict=True)
    return make([(0.0, 0.0), *corners, (0.0, 100.0)])


def area(mesh):
    """Return the area of the corners' quadrilaterals, all of straight sides."""
    x, z = np.moveaxis(mesh.nodes[mesh.elements[:, :4]], -1, 0)
    return float(np.sum(x * np.roll(z, -1, 1) - np.roll(x, -1, 1) * z)) / 2.0


@pytest.mark.parametrize(("rough", "misses"), [(0.0, 0.06), (0.01, 0.06), (0.2, 0.2)])
def test_a_thousand_corners(rough, misses):
    case = drawn(CURVE + rough * np.random.default_rng(1).random(HEIGHTS.size))
    mesh = dam_mesh(case).upper
    assert len(mesh.elements) < 160
    assert 0.0 < mesh.missed < misses
    assert area(mesh) == pytest.approx(case.outline.area, rel=1e-3)


def test_few_corners_stay_as_they_are():
    mesh = dam_mesh(make(TYPICAL, 40.0))
    assert [part.missed for part in mesh.parts] == [0.0, 0.0]
    for corner in TYPICAL:
        assert any((part.nodes == corner).all(axis=1).any() for part in mesh.parts)


@pytest.mark.parametrize("uneven", [3e-6, -3e-6, 1e-3])
def test_a_crest_that_is_hardly_uneven(uneven):
    corners = [(x, z + uneven if (x, z) == (8.0, 100.0) else z) for x, z in TYPICAL]
    mesh = dam_mesh(make(corners)).upper
    assert len(mesh.elements) == len(dam_mesh(make(TYPICAL)).upper.elements)
    assert mesh.nodes[:, 1].max() == max(100.0, 100.0 + uneven)


@pytest.mark.parametrize(("missed", "codes"), [(0.05, []), (0.5, ["outline-simplified"])])
def test_a_mesh_that_misses_much_is_told(missed, codes):
    from types import SimpleNamespace as There

    dam = There(section=There(height=100.0), bodies=[There(mesh=There(missed=0.0)), There(mesh=There(missed=missed))])
    assert [notice.code for notice in _about_the_mesh(dam)] == codes
