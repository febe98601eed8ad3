"""Meshes from files: read as they are, or refused with the reason."""

import re
import sys

import meshio
import numpy as np
import pytest

from heeltoe.errors.error import InputError
from heeltoe.models.flexible.mesh.checks import (
    boundary_edges,
    check_pieces,
)
from heeltoe.models.flexible.mesh.dam import dam_mesh
from shared.dams import RECTANGLE, TYPICAL, plane_case
from shared.meshes import area, bodies, meshed
from shared.outlines import make


def write(path, nodes, elements, kind="quad8"):
    points = np.column_stack([nodes, np.zeros(len(nodes))]) if nodes.shape[1] == 2 else nodes
    meshio.Mesh(points, [(kind, elements)]).write(path, "gmsh" if path.suffix == ".msh" else None)
    return str(path)


@pytest.fixture
def own():
    mesh, _ = meshed(TYPICAL, 60.0, elements_across=2)
    return mesh


def numbered(body):
    return body.nodes.copy(), body.elements.copy()


def refused(tmp_path, nodes, elements, kind="quad8", elevation=60.0, part="mesh_above"):
    path = write(tmp_path / "own.vtu", nodes, elements, kind)
    with pytest.raises(InputError) as caught:
        meshed(TYPICAL, elevation, **{part: path})
    text = str(caught.value)
    assert text.startswith(path)
    return text.removeprefix(path + ": ")


@pytest.mark.parametrize("name", ["own.vtu", "own.inp", "own.msh", "own.vtk"])
@pytest.mark.parametrize("kind", ["quad", "quad8"])
def test_files_give_back_the_mesh(tmp_path, own, name, kind):
    for place, body in (("mesh_above", own.upper), ("mesh_below", own.lower)):
        corners, renumbered = np.unique(body.elements[:, :4], return_inverse=True)
        if kind == "quad":
            write(tmp_path / f"{place}-{name}", body.nodes[corners], renumbered.reshape(-1, 4), kind)
        else:
            write(tmp_path / f"{place}-{name}", *numbered(body))
    files = {place: f"{place}-{name}" for place in ("mesh_above", "mesh_below")}
    read, section = meshed(TYPICAL, 60.0, tmp_path, **files)
    for body, again in zip(bodies(own), bodies(read), strict=True):
        for path in ("crack", "upstream", "downstream", "fixed"):
            assert again.nodes[getattr(again, path)] == pytest.approx(body.nodes[getattr(body, path)])
        assert area(again) == pytest.approx(area(body))
        assert np.all(again.nodes[again.crack, 1] == section.crack_elevation)


def test_files_are_relative_to_the_case(tmp_path, own):
    write(tmp_path / "above.vtu", *numbered(own.upper))
    (tmp_path / "case.json").write_text(
        make(TYPICAL, 60.0, flexible={"mesh_above": "above.vtu"}).model_dump_json(exclude_none=True)
    )
    case = plane_case(tmp_path / "case.json")
    assert len(dam_mesh(case).upper.nodes) == len(own.upper.nodes)


def test_mesh_in_the_plane_x_z_with_lines_beside_it(tmp_path, own):
    nodes = np.insert(own.upper.nodes, 1, 7.0, axis=1)
    lines = boundary_edges(own.upper.elements)[:, [0, 2, 1]]
    path = tmp_path / "own.vtu"
    meshio.Mesh(nodes, [("line3", lines), ("quad8", own.upper.elements)]).write(path)
    read, _ = meshed(TYPICAL, 60.0, mesh_above=str(path))
    assert read.upper.nodes == pytest.approx(own.upper.nodes)


def test_mesh_with_a_ledge_at_the_crack(tmp_path):
    # The crack is narrower than the lower part; rows cannot do this, a mesh of one's own can.
    corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (8.0, 6.0), (8.0, 12.0), (0.0, 12.0)]
    x, z = np.meshgrid(np.arange(0.0, 12.0, 2.0), np.arange(0.0, 8.0, 2.0))
    number = np.arange(x.size).reshape(x.shape)
    elements = np.stack([number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], axis=-1).reshape(-1, 4)
    below = write(tmp_path / "below.vtu", np.column_stack([x.reshape(-1), z.reshape(-1)]), elements, "quad")
    mesh, _ = meshed(corners, 6.0, mesh_below=below, elements_across=4)
    lower = mesh.lower
    assert lower.nodes[lower.crack, 0] == pytest.approx(np.arange(0.0, 9.0))
    # The ledge belongs to the downstream face.
    assert lower.nodes[lower.downstream[[0, -1]]] == pytest.approx(np.array([(10.0, 0.0), (8.0, 6.0)]))
    assert len(lower.fixed) == 11


def test_notch_in_the_base(tmp_path):
    # Held are the points on the lowest line alone.
    nodes = np.array([(x, z) for z in (0.0, 3.0, 6.0) for x in np.linspace(0.0, 8.0, 5)])
    nodes[2, 1] = 0.2
    elements = [(i + j, i + j + 1, i + j + 6, i + j + 5) for i in (0, 5) for j in range(4)]
    mesh, _ = meshed(RECTANGLE, 6.0, mesh_below=write(tmp_path / "own.vtu", nodes, np.array(elements), "quad"))
    assert mesh.lower.nodes[mesh.lower.fixed].tolist() == [[x, 0.0] for x in (0.0, 1.0, 2.0, 6.0, 7.0, 8.0)]


def test_gallery(tmp_path):
    mesh, _ = meshed(RECTANGLE, elements_across=12)
    nodes, elements = numbered(mesh.upper)
    middle = np.argmin(np.linalg.norm(nodes[elements[:, :4]].mean(axis=1) - [4.3, 6.2], axis=1))
    path = write(tmp_path / "own.vtu", nodes, np.delete(elements, middle, axis=0))
    read, section = meshed(RECTANGLE, mesh_above=path)
    assert area(read.upper) < section.area
    assert len(read.upper.upstream) == len(mesh.upper.upstream)


def test_single_precision_is_good_enough(tmp_path, own):
    nodes = own.upper.nodes.astype(np.float32).astype(float) + np.array([3e-5, -3e-5])
    path = write(tmp_path / "own.vtu", nodes, own.upper.elements)
    mesh, section = meshed(TYPICAL, 60.0, mesh_above=path)
    assert np.all(mesh.upper.nodes[mesh.upper.crack, 1] == 60.0)
    assert mesh.upper.nodes[mesh.upper.crack[[0, -1]]].tolist() == [list(section.heel), list(section.toe)]


def test_clockwise(tmp_path, own):
    nodes, elements = numbered(own.upper)
    elements[2:] = elements[2:, [0, 3, 2, 1, 7, 6, 5, 4]]
    text = refused(tmp_path, nodes, elements)
    assert text.startswith(f"{len(elements) - 2} elements run clockwise, the first of them is 3; number")


def test_folded(tmp_path, own):
    nodes, elements = numbered(own.upper)
    crossed = elements.copy()
    crossed[1, :2] = elements[1, 1::-1]
    assert refused(tmp_path, nodes, crossed).startswith("1 elements are folded over or crushed, the first of them is 2")
    # A midside node so near a corner that the element is folded there, and only there.
    nodes[elements[0, 4]] = 0.78 * nodes[elements[0, 0]] + 0.22 * nodes[elements[0, 1]]
    assert "the first of them is 1;" in refused(tmp_path, nodes, elements)


def test_pieces(tmp_path, own):
    nodes, elements = numbered(own.upper)
    away = np.vstack([nodes, nodes + np.array([100.0, 0.0])]), np.vstack([elements, elements + len(nodes)])
    assert refused(tmp_path, *away).startswith("falls into 2 pieces")
    # Side by side, but each with nodes of its own: a crack that no one has asked for.
    row = np.unique(elements[:2])
    slit = elements.copy()
    shared = np.intersect1d(row, elements[2:])
    extra = len(nodes) + np.arange(len(shared))
    slit[2:] = np.where(np.isin(slit[2:], shared), extra[np.searchsorted(shared, slit[2:]) % len(shared)], slit[2:])
    text = refused(tmp_path, np.vstack([nodes, nodes[shared]]), slit)
    assert text.startswith(
        f"{len(shared)} pairs of nodes coincide, the first of them {shared[0] + 1} and {extra[0] + 1}"
    )


def test_sides_that_do_not_fit(tmp_path):
    def square(x, z):
        return [(x, z), (x + 2, z), (x + 2, z + 2), (x, z + 2), (x + 1, z), (x + 2, z + 1), (x + 1, z + 2), (x, z + 1)]

    nodes = np.array(square(0.0, 0.0) + square(2.0, 0.0) + square(2.0, 2.0))
    unique, places = np.unique(nodes, axis=0, return_inverse=True)
    elements = places.reshape(3, 8)
    check_pieces(unique, elements[:2], "own")
    # Elements that touch at a corner alone,
    with pytest.raises(InputError, match="own: the elements that meet at node 8 do not fit side to side"):
        check_pieces(unique, elements[[0, 2]], "own")
    # that do not share the node in the middle of their side,
    apart = elements[:2].copy()
    apart[1, 7] = len(unique)
    with pytest.raises(InputError, match="do not fit side to side"):
        check_pieces(np.vstack([unique, [(2.01, 1.0)]]), apart, "own")
    # and three on one side.
    with pytest.raises(InputError, match="do not fit side to side"):
        check_pieces(unique, elements[[0, 1, 1]], "own")


def test_far_away(tmp_path, own):
    nodes, elements = numbered(own.upper)
    text = refused(tmp_path, nodes + np.array([200.0, 0.0]), elements)
    assert text == (
        "is not where the section is: it covers x from 200 to 232 m, z from 60 to 100 m, and the crack goes along "
        "x from 0 to 32 m at z = 60 m; give it in metres and in the coordinates of the section"
    )
    assert refused(tmp_path, 1000.0 * nodes, elements).startswith("is not where the section is")


def test_faces_of_the_crack_do_not_meet(tmp_path, own):
    nodes, elements = numbered(own.upper)
    text = refused(tmp_path, nodes + np.array([0.0, 0.5]), elements)
    assert text == (
        "its lower side covers x from 0 to 32 m at z = 60.5 m, and the crack goes along x from 0 to 32 m at "
        "z = 60 m; let a line of element sides follow the crack from end to end"
    )
    assert "covers x from 0.5 to 32.5 m at z = 60 m" in refused(tmp_path, nodes + np.array([0.5, 0.0]), elements)
    assert "covers x from 0 to 31.68 m" in refused(tmp_path, nodes * [0.99, 1.0], elements)
    low, below = numbered(own.lower)
    text = refused(tmp_path, low - np.array([0.0, 0.5]), below, part="mesh_below")
    assert text.startswith("its upper side covers x from 0 to 32 m at z = 59.5 m")
    bent = nodes.copy()
    bent[own.upper.crack[2], 1] += 0.5
    assert "its lower side covers" in refused(tmp_path, bent, elements)


def test_other_area(tmp_path, own):
    nodes, elements = numbered(own.upper)
    higher = np.column_stack([nodes[:, 0], 60.0 + 1.02 * (nodes[:, 1] - 60.0)])
    text = refused(tmp_path, higher, elements)
    assert re.fullmatch(r"has an area of 693\.6 m\^2 where the section has 680 m\^2; follow the outline .*", text)


def test_lower_mesh_without_a_level_base(tmp_path, own):
    nodes, elements = numbered(own.lower)
    nodes[:, 1] -= 0.1 * nodes[:, 0] * (60.0 - nodes[:, 1]) / 60.0
    assert refused(tmp_path, nodes, elements, part="mesh_below").startswith("has no level base to stand on")


def test_bad_nodes(tmp_path, own):
    nodes, elements = numbered(own.upper)
    extra = np.vstack([nodes, [(1.0, 61.0), (2.0, 61.0)]])
    text = refused(tmp_path, extra, elements)
    assert text.startswith(f"2 nodes belong to no element, the first of them is {len(nodes) + 1}; remove them")
    nodes[4, 1] = np.nan
    assert refused(tmp_path, nodes, elements).startswith("node 5 has no finite coordinates")


def test_mesh_that_is_not_plane(tmp_path, own):
    nodes = np.column_stack([own.upper.nodes, own.upper.nodes[:, 0]])
    assert refused(tmp_path, nodes, own.upper.elements).startswith("is not plane")


def test_other_elements(tmp_path, own):
    nodes, elements = numbered(own.upper)
    corners, places = np.unique(elements[:, :3], return_inverse=True)
    text = refused(tmp_path, nodes[corners], places.reshape(-1, 3), "triangle")
    assert text.startswith("holds triangle; give quadrilaterals throughout")
    path = tmp_path / "mixed.vtu"
    cells = [("quad8", elements[1:]), ("triangle6", elements[:1, [0, 1, 2, 4, 5, 6]])]
    meshio.Mesh(np.insert(nodes, 2, 0.0, axis=1), cells).write(path)
    with pytest.raises(InputError, match="holds quad8, triangle6"):
        meshed(TYPICAL, 60.0, mesh_above=str(path))
    meshio.Mesh(np.insert(nodes, 2, 0.0, axis=1), [("line", elements[:, :2])]).write(path)
    with pytest.raises(InputError, match="holds no elements"):
        meshed(TYPICAL, 60.0, mesh_above=str(path))


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("own.msh", ""),
        ("own.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 x"),
        ("own.vtu", "<VTKFile><Broken>"),
        ("own.inp", "*NODE\n1, 0.0, a"),
        ("own.txt", "0 0"),
        ("own", "0 0"),
    ],
)
def test_unreadable(tmp_path, capsys, name, content):
    path = tmp_path / name
    path.write_text(content)
    with pytest.raises(InputError, match=re.escape(f"{path}: cannot be read (")):
        meshed(TYPICAL, mesh_above=str(path))
    assert capsys.readouterr() == ("", "")


def test_element_of_nodes_that_are_not_there(tmp_path):
    path = tmp_path / "own.vtk"
    path.write_text(
        "# vtk DataFile Version 2.0\nown\nASCII\nDATASET UNSTRUCTURED_GRID\n"
        "POINTS 4 double\n0 0 0 80 0 0 8 100 0 0 100 0\nCELLS 1 5\n4 0 1 2 9\nCELL_TYPES 1\n9\n"
    )
    with pytest.raises(InputError, match="an element names a node that is not there"):
        meshed(TYPICAL, mesh_above=str(path))


def test_missing_file(tmp_path):
    with pytest.raises(InputError, match=r"flexible\.mesh_above: there is no file .*own\.msh; give the path of a mesh"):
        meshed(TYPICAL, 0.0, tmp_path, mesh_above="own.msh")


def test_missing_package(tmp_path, own, monkeypatch):
    path = write(tmp_path / "own.vtu", *numbered(own.upper))
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(InputError, match=r"own\.vtu: .* pip install meshio"):
        meshed(TYPICAL, 60.0, mesh_above=path)


def test_mesh_below_without_a_part_below():
    with pytest.raises(InputError, match=r"flexible\.mesh_below: does not belong to a dam whose crack is at the base"):
        meshed(TYPICAL, mesh_below="below.msh")
