"""Water, uplift and virtual mass on a mesh against the resultants of the rigid model and slow sums."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from heeltoe.mechanics import loads, virtual_water
from shared.dams import TYPICAL
from shared.elastic import G, built, deep, parts, resultant
from shared.meshes import flat
from shared.outlines import dams, make

waters = st.one_of(st.none(), st.floats(0.01, 1.4))
nappes = st.sampled_from(["none", "weight", "falling"])
uplifts = st.sampled_from(
    [
        {"pattern": "none"},
        {"pattern": "uniform"},
        {"pattern": "triangular", "intensity": 0.5},
        {"pattern": "cut-off", "extent": 0.37},
        {"pattern": "drained", "drain_position": 0.21, "drain_efficiency": 0.6},
        {"pattern": "profile", "points": [[0, "8 m"], [0.3, "8 m"], [0.3, "1 m"], [1, "2 m"]]},
    ]
)


@settings(max_examples=20)
@given(dams(), st.integers(0, 9), waters, waters, uplifts, st.integers(1, 4), nappes)
def test_resultants_are_those_of_the_rigid_body(corners, tenths, up, down, uplift, across, nappe):
    assume(not flat(corners))
    top = max(z for _, z in corners)
    water = {"reservoir": up and deep(up * top) | {"nappe": nappe}, "tailwater": down and deep(down * top)}
    options = {"elements_across": across, "elements_across_below": 3}
    case, section, one = built(corners, tenths / 10 * top, uplift=uplift, flexible=options, **water)
    scale = 2650 * G * 80.0 * top
    for reference in loads.static_forces(case):
        result = resultant(one.upper, one.upper.loads[reference.name], section)
        expected = [reference.horizontal, reference.vertical, reference.moment]
        assert result == pytest.approx(expected, rel=1e-9, abs=1e-12 * scale * top), reference.name
    assert one.upper.load == pytest.approx(sum(one.upper.loads.values()))
    if one.lower is None:
        return
    # Upper and lower part together are the whole dam: uplift in the crack cancels.
    whole = case.model_copy(update={"crack": make(corners).crack})
    forces = loads.static_forces(whole)
    heel = whole.cut
    for reference in forces[:3]:
        result = sum(resultant(body, body.loads[reference.name], heel) for body in parts(one))
        expected = [reference.horizontal, reference.vertical, reference.moment]
        assert result == pytest.approx(expected, rel=1e-9, abs=1e-12 * scale * top), reference.name
    result = [resultant(body, body.loads["uplift"], section) for body in parts(one)]
    assert result[0] == pytest.approx(-result[1], rel=1e-9, abs=1e-12 * scale * top)


@settings(max_examples=15)
@given(dams(), st.integers(0, 9), st.floats(0.01, 1.4), waters, st.integers(1, 4))
def test_virtual_mass(corners, tenths, filling, down, across):
    assume(not flat(corners))
    top = max(z for _, z in corners)
    water = {"reservoir": deep(filling * top), "tailwater": down and deep(down * top)}
    case, section, one = built(corners, tenths / 10 * top, flexible={"elements_across": across}, **water)
    result = [moving(body, section) for body in parts(one)]
    expected = virtual_water.virtual_mass(case)
    assert result[0] == pytest.approx([expected.mass, expected.mass * expected.height], rel=1e-9, abs=1e-6)
    if len(result) == 2:
        at_base = make(corners, **water)
        whole = virtual_water.virtual_mass(at_base)
        mass, moment = sum(moving(body, at_base.cut) for body in parts(one))
        assert (mass, moment) == pytest.approx((whole.mass, whole.mass * whole.height), rel=1e-9, abs=1e-6)


def moving(body, section):
    """Mass of the water that moves horizontally and its moment about the crack."""
    rows = (body.mass - body.mass_concrete).toarray()[::2, ::2]
    return np.array([rows.sum(), rows.sum(axis=0) @ (body.mesh.nodes[:, 1] - section.heel[1])])


def test_water_moves_along_the_normal_of_a_face():
    # Upstream 1 : 4, downstream 3 : 4.
    corners = ((0.0, 0.0), (40.0, 0.0), (10.0, 40.0))
    _, _, one = built(corners, reservoir=deep(36.0), tailwater=deep(20.0), flexible={"elements_across": 4})
    water = (one.upper.mass - one.upper.mass_concrete).tocsr()
    assert abs(water - water.T).max() < 1e-14 * abs(water).max()
    x, z = one.upper.mesh.nodes.T
    for there, way in ((x <= z / 4.0 + 1e-9, (1.0, 4.0)), (x > z / 4.0 + 1e-9, (-3.0, 4.0))):
        along = np.outer(there, way).reshape(-1)
        across = np.outer(there, way[::-1] * np.array([1.0, -1.0])).reshape(-1)
        assert abs(water @ along).max() < 1e-9 * abs(water @ across).max()


def test_a_vertical_face_moves_no_water_up_and_down():
    _, _, one = built(TYPICAL, reservoir=deep(90.0))
    water = (one.upper.mass - one.upper.mass_concrete).toarray()
    assert not water[1::2].any()
    assert not water[:, 1::2].any()
    assert water[::2, ::2].any()


def test_virtual_mass_of_the_thesis():
    # 7/8 rho sqrt(D (D - eta)) with D = 30 m from the crack: 7/12 rho D^2, its centre 0.4 D up; none below.
    _, section, one = built(TYPICAL, 60.0, reservoir=deep(90.0), flexible={"virtual_mass": "thesis"})
    assert moving(one.upper, section) == pytest.approx([7 / 12 * 1000 * 900.0, 7 / 12 * 1000 * 900.0 * 12.0])
    assert moving(one.lower, section) == pytest.approx([0.0, 0.0])
    _, section, one = built(TYPICAL, 60.0, reservoir=deep(50.0), flexible={"virtual_mass": "thesis"})
    assert moving(one.upper, section) == pytest.approx([0.0, 0.0])
    # At the base there is one part, and no difference.
    cases = [
        built(TYPICAL, reservoir=deep(90.0), flexible={"virtual_mass": name})[2] for name in ("thesis", "complete")
    ]
    assert abs(cases[0].upper.mass - cases[1].upper.mass).max() < 1e-9 * abs(cases[0].upper.mass).max()


def test_virtual_mass_is_consistent():
    # The energy of a motion that is quadratic over an edge, against the integral over the height.
    _, _, one = built(TYPICAL, reservoir=deep(77.0), flexible={"elements_across": 16})
    z = one.upper.mesh.nodes[:, 1]
    water = (one.upper.mass - one.upper.mass_concrete)[::2][:, ::2]
    eta = 77.0 * (np.arange(200_000) + 0.5) / 200_000
    density = 7 / 8 * 1000 * np.sqrt(77.0 * (77.0 - eta)) * 77.0 / 200_000
    assert (z**2) @ (water @ (z**2)) == pytest.approx(np.sum(density * eta**4), rel=1e-6)


def bulged(body):
    """Nodes with the midside nodes of both faces moved, so that the faces are wavy."""
    nodes = body.nodes.copy()
    for face, shift in ((body.upstream, (-0.4, 0.3)), (body.downstream, (0.5, -0.3))):
        nodes[face[1::2]] += shift
    return nodes


@pytest.mark.parametrize("depth", [5.0, 33.3, 61.7, 100.0])
def test_pressure_on_curved_faces(depth):
    # Whatever the shape of a face, the push is rho g h^2 / 2, at a third of the depth.
    case, section, one = built(TYPICAL, reservoir=deep(depth), tailwater=deep(depth), bend=bulged)
    push = 1000 * G * depth**2 / 2
    z = one.upper.mesh.nodes[:, 1]
    for name, sign in (("reservoir", 1.0), ("tailwater", -1.0)):
        forces = one.upper.loads[name]
        assert forces[::2].sum() == pytest.approx(sign * push, rel=1e-9)
    assert one.upper.loads["reservoir"][::2] @ z == pytest.approx(push * depth / 3, rel=1e-9)
    mass, moment = moving(one.upper, section)
    water = virtual_water.virtual_mass(case)
    assert mass == pytest.approx(water.mass, rel=1e-9)
    assert moment == pytest.approx(water.mass * water.height, rel=1e-9)
    # Archimedes: weight of the water that the wavy face holds up or displaces, by fine strips.
    assert one.upper.loads["reservoir"][1::2].sum() == pytest.approx(-strips(one.upper, depth), rel=1e-4, abs=1e3)


def strips(body, depth):
    """Weight of the water above the upstream face, from x = 0 to the face, counted by signed strips."""
    total, s = 0.0, (np.arange(20_000) + 0.5) / 10_000 - 1.0
    path = body.mesh.upstream
    for first in range(0, len(path) - 2, 2):
        start, middle, end = body.mesh.nodes[path[first : first + 3]]
        bend, slope = (start - 2 * middle + end) / 2, (end - start) / 2
        z = bend[1] * s * s + slope[1] * s + middle[1]
        run = 2 * bend[0] * s + slope[0]
        total += np.sum(np.maximum(0.0, depth - z) * run) / 10_000
    return 1000 * G * total
