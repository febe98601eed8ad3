"""Sections from meshes: the outline of the elements, to the last bit; what is no section is one clear error."""

from __future__ import annotations

import meshio
import numpy as np
import pytest
import shapely

from heeltoe import InputError, read_case
from heeltoe.models.flexible.deck import build_deck
from heeltoe.models.flexible.mesh.dam import dam_mesh
from heeltoe.views.files.programs.write import files_for, write_program
from shared.dams import BASE, COARSE, HEIGHT, TYPICAL

CRACK = {"crack": {"friction": 1.0}}
# Two unit squares of metres, ten high, in words of each format.
NODES = [(0.0, 0.0), (10.0, 0.0), (20.0, 0.0), (0.0, 10.0), (10.0, 10.0), (20.0, 10.0)]
QUADS = [(1, 2, 5, 4), (2, 3, 6, 5)]


def gmsh2(nodes, elements, kind=3, groups=(1, 1)):
    rows = [f"{number} {x!r} {y!r} {z!r}" for number, (x, y, z) in enumerate(((*p, 0.0)[:3] for p in nodes), 1)]
    cells = [
        f"{number} {kind} 2 {group} 1 {' '.join(map(str, own))}"
        for number, (own, group) in enumerate(zip(elements, groups, strict=True), 1)
    ]
    return "\n".join(
        [
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat",
            '$PhysicalNames\n2\n2 1 "dam"\n2 2 "rock"\n$EndPhysicalNames',
            f"$Nodes\n{len(rows)}",
            *rows,
            f"$EndNodes\n$Elements\n{len(cells)}",
            *cells,
            "$EndElements\n",
        ]
    )


def abaqus(nodes, elements, kind="CPS4", sets=("DAM", "DAM"), end=""):
    lines = ["*HEADING", "a dam", "** a comment", "*NODE, NSET=ALL"]
    lines += [f"{number}, {', '.join(map(repr, place))}" for number, place in enumerate(nodes, 1)]
    for number, (own, name) in enumerate(zip(elements, sets, strict=True), 1):
        lines += [f"*ELEMENT, TYPE={kind}, ELSET={name}", f"{number}, {', '.join(map(str, own))}"]
    return "\n".join([*lines, end])


FORMATS = {"msh": gmsh2, "inp": abaqus}


def read(path, text, **more):
    path.write_text(text, encoding="utf-8")
    return read_case({**CRACK, "section": {"file": str(path), "unit": "m", **more}})


def refused(path, text, **more):
    with pytest.raises(InputError) as error:
        read(path, text, **more)
    return error.value


def corners(case):
    return sorted(case.section.vertices())


def same(case, wanted):
    return corners(case) == [pytest.approx(corner, abs=1e-9) for corner in sorted(wanted)]


@pytest.mark.parametrize("ending", FORMATS)
def test_two_squares_are_their_outline(ending, tmp_path):
    case = read(tmp_path / f"dam.{ending}", FORMATS[ending](NODES, QUADS))
    assert corners(case) == [(0.0, 0.0), (0.0, 10.0), (20.0, 0.0), (20.0, 10.0)]


@pytest.mark.parametrize("ending", FORMATS)
def test_the_plane_may_be_x_z_and_the_unit_another(ending, tmp_path):
    upright = [(1e3 * x, 500.0, 1e3 * y) for x, y in NODES]
    case = read(tmp_path / f"dam.{ending}", FORMATS[ending](upright, QUADS), unit="mm")
    assert same(case, [(0.0, 0.0), (0.0, 10.0), (20.0, 0.0), (20.0, 10.0)])


@pytest.mark.parametrize("ending", FORMATS)
def test_a_unit_is_asked_for_and_a_wrong_one_seen(ending, tmp_path):
    text = FORMATS[ending](NODES, QUADS)
    error = refused(tmp_path / f"dam.{ending}", text, unit=None)
    assert (error.code, error.field) == ("missing", "section.unit")
    error = refused(tmp_path / f"dam.{ending}", text, unit="mm")
    assert (error.code, error.field) == ("drawing-height", "section.unit")
    assert "by the unit mm the dam is 0.01 m high" in str(error)


@pytest.mark.parametrize("program", ["gmsh", "calculix"])
@pytest.mark.parametrize("path", [BASE, HEIGHT])
def test_an_exported_dam_is_read_to_the_last_bit(path, program, tmp_path):
    deck = build_deck(read_case(path, COARSE), None)
    write_program(deck, program, tmp_path)
    (name,) = files_for(program)
    parts = ", ".join(part.name for part in deck.parts)
    several = len(deck.parts) > 1 or program == "calculix"
    case = read_case(
        {**CRACK, "section": {"file": str(tmp_path / name), "unit": "m", **({"layer": parts} if several else {})}}
    )
    # The crack between two parts is no edge of the section.
    assert same(case, TYPICAL)
    if several:
        with pytest.raises(InputError, match=r"section\.layer: has several sets of elements"):
            read_case({**CRACK, "section": {"file": str(tmp_path / name), "unit": "m"}})


@pytest.mark.parametrize(("kind", "name"), [("gmsh22", "msh"), ("gmsh", "msh"), ("abaqus", "inp")])
def test_files_of_another_writer_are_read(kind, name, tmp_path):
    part = dam_mesh(read_case(BASE, COARSE)).upper
    mesh = meshio.Mesh(np.column_stack([part.nodes, np.zeros(len(part.nodes))]), [("quad8", part.elements)])
    options = {} if kind == "abaqus" else {"binary": False}
    meshio.write(tmp_path / f"dam.{name}", mesh, kind, **options)
    text = (tmp_path / f"dam.{name}").read_text()
    assert same(read(tmp_path / f"dam.{name}", text), TYPICAL)


def test_a_curved_side_keeps_its_midside_nodes(tmp_path):
    """One quadratic element whose right side bulges by a metre, whose other midside nodes are on straight sides."""
    nodes = [(0.0, 0.0), (10.0, 0.0), (10.0, 20.0), (0.0, 20.0), (5.0, 0.0), (11.0, 10.0), (5.0, 20.0), (0.0, 10.0)]
    case = read(tmp_path / "dam.inp", abaqus(nodes, [range(1, 9)], "CPE8R", ["dam"]))
    assert corners(case) == [(0.0, 0.0), (0.0, 20.0), (10.0, 0.0), (10.0, 20.0), (11.0, 10.0)]
    assert read(tmp_path / "dam.msh", gmsh2(nodes, [range(1, 9)], 16, [1])).section == case.section


def test_the_dam_is_chosen_among_sets(tmp_path):
    for ending, text in (
        ("msh", gmsh2(NODES, QUADS, groups=(1, 2))),
        ("inp", abaqus(NODES, QUADS, sets=("dam", "rock"))),
    ):
        path = tmp_path / f"dam.{ending}"
        error = refused(path, text)
        assert (error.code, error.field) == ("several", "section.layer")
        assert corners(read(path, text, layer="Dam"))[-1] == (10.0, 10.0)
        assert corners(read(path, text, layer="dam, rock"))[-1] == (20.0, 10.0)
        assert refused(path, text, layer="water").code == "not-a-choice"
    sets = "*ELSET, ELSET=left, GENERATE\n1, 1\n*ELSET, ELSET=both\nleft, 2\n"
    named = abaqus(NODES, QUADS, sets=("a", "a"), end=sets)
    assert corners(read(tmp_path / "dam.inp", named, layer="left"))[-1] == (10.0, 10.0)
    assert corners(read(tmp_path / "dam.inp", named, layer="both"))[-1] == (20.0, 10.0)


@pytest.mark.parametrize("ending", FORMATS)
def test_a_hole_and_two_pieces_are_refused(ending, tmp_path):
    grid = [(10.0 * i, 10.0 * j) for j in range(4) for i in range(4)]
    around = [
        (4 * j + i + 1, 4 * j + i + 2, 4 * j + i + 6, 4 * j + i + 5)
        for j in range(3)
        for i in range(3)
        if (i, j) != (1, 1)
    ]
    names = {"groups": [1] * 8} if ending == "msh" else {"sets": ["dam"] * 8}
    error = refused(tmp_path / f"dam.{ending}", FORMATS[ending](grid, around, **names))
    assert error.code == "another-kind"
    assert "holes (1)" in str(error)
    ends = [around[0], around[-1]]
    names = {"groups": [1] * 2} if ending == "msh" else {"sets": ["dam"] * 2}
    assert refused(tmp_path / f"dam.{ending}", FORMATS[ending](grid, ends, **names)).code == "mesh-pieces"


def test_nodes_of_two_faces_in_one_place_are_one(tmp_path):
    nodes = [*NODES[:2], *NODES[3:5], NODES[1], NODES[2], NODES[4], NODES[5]]
    case = read(tmp_path / "dam.msh", gmsh2(nodes, [(1, 2, 4, 3), (5, 6, 8, 7)]))
    assert shapely.Polygon(case.section.vertices()).area == pytest.approx(200.0)
    assert len(case.section.vertices()) == 4


CUBE = [(x, y, z) for z in (0.0, 5.0) for x, y in ((0.0, 0.0), (5.0, 0.0), (5.0, 5.0), (0.0, 5.0))]
GOOD = gmsh2(NODES, QUADS)


@pytest.mark.parametrize(
    ("name", "text", "code", "words"),
    [
        ("a.inp", abaqus(CUBE, [range(1, 9)], "C3D8", ["dam"]), "source-unreadable", "C3D8 are not plane"),
        ("a.msh", gmsh2(CUBE, [range(1, 9)], 5, [1]), "source-unreadable", "type 5 are not plane"),
        ("a.msh", gmsh2(CUBE, [(1, 2, 3, 4), (1, 2, 6, 5)]), "mesh-plane", "not plane"),
        ("a.msh", GOOD.replace("2.2 0 8", "2.2 1 8"), "source-unreadable", "save it as ASCII"),
        ("a.msh", GOOD.replace("2.2 0 8", "4.0 0 8"), "source-unreadable", "save it as 2.2 or 4.1"),
        ("a.msh", GOOD.replace("$EndElements", ""), "source-unreadable", "does not end"),
        ("a.msh", GOOD.replace("$Elements\n2", "$Elements\n9"), "source-unreadable", "ends before"),
        ("a.msh", GOOD.replace("2 3 6 5", "2 3 6 99"), "source-unreadable", "'99'"),
        ("a.msh", GOOD.replace("2 3 6 5", "2 3 6"), "source-unreadable", "not 4 nodes"),
        ("a.msh", GOOD.replace("20.0 0.0 0.0", "nan 0.0 0.0"), "mesh-not-finite", "node 3"),
        ("a.msh", GOOD.replace(" 3 2 ", " 1 2 "), "another-kind", "without plane elements"),
        ("a.msh", "$MeshFormat\n", "source-unreadable", "does not end"),
        ("a.inp", abaqus(NODES, QUADS, end="*INCLUDE, INPUT=b.inp"), "source-unreadable", "includes another file"),
        ("a.inp", abaqus(NODES, QUADS, end="*NGEN\n1, 5"), "source-unreadable", "generates its nodes"),
        ("a.inp", abaqus(NODES, QUADS, end="*SYSTEM\n1.0, 0.0"), "source-unreadable", "system of coordinates"),
        ("a.inp", abaqus(NODES, QUADS).replace("*NODE", "*NODE, SYSTEM=C"), "source-unreadable", "system of coord"),
        ("a.inp", abaqus(NODES, QUADS, end="*ELGEN\n1, 5"), "source-unreadable", "generates its elements"),
        ("a.inp", abaqus(NODES, QUADS, end="*INSTANCE, NAME=a\n1.0, 0.0"), "source-unreadable", "moves an instance"),
        ("a.inp", abaqus(NODES, QUADS, "XYZ7"), "source-unreadable", "XYZ7 are not plane"),
        ("a.inp", abaqus(NODES, [(1, 2, 5), (2, 3, 6)]), "source-unreadable", "not 4 nodes"),
        ("a.inp", abaqus(NODES, QUADS).replace("10.0, 0.0", "ten, 0.0"), "source-unreadable", "ten"),
        ("a.msh", gmsh2(NODES, [(1, 2, 3, 2), (1, 2, 3, 2)]), "another-kind", "without an area"),
        ("a.inp", "*HEADING\nno mesh\n", "another-kind", "without plane elements"),
        ("a.msh", "", "source-unreadable", "neither a drawing in DXF nor a mesh nor a table"),
        ("a.msh", "words\n", "section-head", "words"),
    ],
)
def test_what_is_no_section_is_one_error(name, text, code, words, tmp_path):
    error = refused(tmp_path / name, text)
    assert error.code == code, str(error)
    assert error.field.startswith("section.")
    assert words in str(error)


@pytest.mark.parametrize("quadratic", [False, True])
def test_sloping_meshes_have_no_slivers_for_holes(quadratic, tmp_path):
    rng = np.random.default_rng(5)
    for _ in range(12):
        base, crest, height = map(float, rng.uniform([20.0, 4.0, 25.0], [90.0, 12.0, 110.0]))
        across, up = map(int, rng.integers(3, 9, 2))
        refined = 2 if quadratic else 1
        grid, nodes = {}, []
        for j in range(up * refined + 1):
            z = height * j / (up * refined)
            width = base + (crest - base) * z / height
            for i in range(across * refined + 1):
                grid[i, j] = len(nodes) + 1
                nodes.append((width * i / (across * refined), z))
        corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
        ways = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1)] if quadratic else corners
        elements = [
            tuple(grid[i * refined + a, j * refined + b] for a, b in ways) for j in range(up) for i in range(across)
        ]
        kind = 16 if quadratic else 3
        (tmp_path / "a.msh").write_text(gmsh2(nodes, elements, kind, (1,) * len(elements)))
        case = read_case(CRACK | {"section": {"file": str(tmp_path / "a.msh"), "unit": "m"}})
        assert case.cut.area == pytest.approx((base + crest) / 2.0 * height, rel=1e-6)
