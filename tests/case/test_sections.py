"""Sections by the slopes of their faces, from tables and from drawings: the same dam, to the last bit."""

from __future__ import annotations

import io
import json
import math
import sys
import tomllib
from contextlib import suppress
from itertools import pairwise

import ezdxf
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from heeltoe import InputError, dam_periods, overturning_map, read_case, run, solve, statics_of_sections
from heeltoe.case.section_file import read_corners
from heeltoe.case.toml_writer import case_text
from shared.command import command
from shared.dams import polygon

CORNERS = [(-2.1, 0.0), (34.4, 0.0), (6.0, 38.0), (6.0, 45.0), (0.0, 45.0), (0.0, 21.0)]
CRACK = {"crack": {"friction": 1.0}}


def dam(**section):
    return {"section": section, **CRACK}


def drawing(*outlines, unit=6, layer="DAM", closed=True, bulge=0.0, old=False):
    """Return a drawing of outlines, each on a layer of its own but the first, as a file has it."""
    made = ezdxf.new("R2010", units=unit)
    space = made.modelspace()
    for number, corners in enumerate(outlines):
        there = {"layer": layer if not number else f"{layer}{number}"}
        if old:
            space.add_polyline2d(corners, close=closed, dxfattribs=there)
        else:
            points = [(x, y, bulge) for x, y in corners]
            space.add_lwpolyline(points, format="xyb", close=closed, dxfattribs=there)
    text = io.StringIO()
    made.write(text)
    return text.getvalue().encode()


def table(corners, head="x [m],z [m]\n"):
    return (head + "".join(f"{x!r},{z!r}\n" for x, z in corners)).encode()


def read(path, content, **more):
    path.write_bytes(content)
    return read_case({**CRACK, "section": {"file": str(path), **more}})


@given(
    upstream=st.lists(st.tuples(st.floats(0.5, 30.0), st.floats(-0.3, 0.6)), min_size=1, max_size=4),
    downstream=st.lists(st.tuples(st.floats(0.5, 30.0), st.floats(0.0, 1.2)), min_size=1, max_size=4),
    crest=st.floats(40.0, 50.0),
)
def test_slopes_say_the_same_as_corners(upstream, downstream, crest):
    """Each face by its pieces from the crest down: how high one is, and its slope."""
    height = max(sum(rise for rise, _ in face) for face in (upstream, downstream))
    faces, sides = [], []
    for face in (upstream, downstream):
        level, out, message, corners = height, 0.0, [], [(0.0, height)]
        for number, (rise, slope) in enumerate(face):
            lower = 0.0 if number == len(face) - 1 else level - rise
            out += slope * (level - lower)
            level = lower
            message.append([f"{level!r} m", slope])
            corners.append((out, level))
        faces.append(message[::-1])
        sides.append(corners)
    left = [(-out, level) for out, level in sides[0]]
    right = [(crest + out, level) for out, level in sides[1]]
    sizes = {"height": f"{height!r} m", "crest_width": f"{crest!r} m"}
    by_slopes = read_case(dam(**sizes, upstream=faces[0], downstream=faces[1]))
    by_corners = read_case(dam(**polygon([*left, *right[::-1]])))
    assert by_slopes.outline.symmetric_difference(by_corners.outline).area <= 1e-9 * by_corners.outline.area


def test_one_sloping_face_is_the_plain_trapezoid():
    plain = read_case(dam(height="40 m", crest_width="5 m", base_width="37 m"))
    assert read_case(dam(height="40 m", crest_width="5 m", downstream=[["0 m", 0.8]])).outline == plain.outline


@given(out=st.floats(-5.0, 5.0), wide=st.floats(0.1, 90.0), high=st.floats(0.1, 90.0), part=st.floats(0.1, 0.9))
@settings(max_examples=15)
def test_files_are_the_corners_to_the_last_bit(tmp_path_factory, out, wide, high, part):
    folder = tmp_path_factory.mktemp("section")
    corners = [(out, 0.0), (out + wide, 0.0), (out + part * wide, part * high), (out + 0.1 * wide, high)]
    own = read_case(dam(**polygon(corners))).section.polygon
    for name, content in (
        ("a.csv", table(corners)),
        ("b.csv", table([*corners, corners[0]])),
        ("c.txt", table(corners, "# of the dam\n\n").replace(b",", b" ")),
        ("d.csv", ("name,z_m,x_m\n" + "".join(f"k,{z!r},{x!r}\n" for x, z in corners)).encode()),
        ("e.dxf", drawing(corners)),
        ("f.dxf", drawing([*corners, corners[0]], closed=False)),
        ("g.dxf", drawing(corners, old=True)),
    ):
        # Of a drawing the unit is asked for where it makes no dam.
        more = {"unit": "m"} if name == "c.txt" or name.endswith("dxf") else {}
        assert read(folder / name, content, **more).section.polygon == own, name


def test_units_of_files(tmp_path):
    feet = [(x / 0.3048, z / 0.3048) for x, z in CORNERS]
    metres = read_case(dam(**polygon(CORNERS))).outline
    for name, content, more in (
        ("a.dxf", drawing(feet, unit=2), {}),
        ("b.dxf", drawing(feet, unit=0), {"unit": "ft"}),
        ("c.dxf", drawing(feet, unit=1), {"unit": "ft"}),
        ("d.csv", table(feet, "x (ft),z (ft)\n"), {}),
        ("e.csv", b"x;elevation\n" + b"".join(f"{x:.9f};{z:.9f}\n".replace(".", ",").encode() for x, z in feet),
         {"unit": "ft"}),
    ):  # fmt: skip
        assert read(tmp_path / name, content, **more).outline.equals_exact(metres, 1e-6), name


def test_of_several_outlines_one_is_named(tmp_path):
    content = drawing(CORNERS, [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
    assert read(tmp_path / "a.dxf", content, layer="dam").section.polygon is not None
    with pytest.raises(InputError, match=r'section.layer: there are 2 closed .*"DAM" \(1\), "DAM1" \(1\)'):
        read(tmp_path / "a.dxf", content)


def saved(tmp_path, draw, *, frozen=(), **more):
    """Read the section of a drawing that a function fills."""
    made = ezdxf.new("R2010", units=6)
    draw(made.modelspace())
    for name in frozen:
        (made.layers.get(name) if name in made.layers else made.layers.add(name)).freeze()
    path = tmp_path / "a.dxf"
    made.saveas(path)
    return read(path, path.read_bytes(), **more)


def outline(space, corners, layer="DAM", **more):
    return space.add_lwpolyline(corners, close=True, dxfattribs={"layer": layer}, **more)


def by_lines(space, corners, layer="DAM", *, closed=True):
    for number, (start, end) in enumerate(pairwise([*corners, corners[0]] if closed else corners)):
        # As drawn by hand: some lines the other way round.
        space.add_line(*((end, start) if number % 3 == 1 else (start, end)), dxfattribs={"layer": layer})


FRAME = [(-10.0, -5.0), (50.0, -5.0), (50.0, 55.0), (-10.0, 55.0)]


def test_a_frame_around_a_dam_that_is_drawn_as_lines_is_not_taken_for_the_dam(tmp_path):
    """The right answer is a question: a frame of 60 x 60 m would be a block that stands."""

    def draw(space):
        outline(space, FRAME, "FRAME")
        by_lines(space, CORNERS)
        space.add_text("Section A-A", dxfattribs={"layer": "TEXT"})

    with pytest.raises(
        InputError, match=r'section.layer: there are 2 closed outlines; by layers: "FRAME" \(1\), "DAM"'
    ):
        saved(tmp_path, draw)
    assert saved(tmp_path, draw, layer="FRAME").outline.area == pytest.approx(3600.0)
    own = read_case(dam(**polygon(CORNERS))).outline
    assert saved(tmp_path, draw, layer="DAM").outline.symmetric_difference(own).area == pytest.approx(0.0, abs=1e-9)


def test_lines_that_join_are_the_dam_wherever_they_begin(tmp_path):
    own = read_case(dam(**polygon(CORNERS))).outline
    places = list(pairwise([*CORNERS, CORNERS[0]]))

    def draw(space):
        for number in (3, 0, 5, 1, 4, 2):
            start, end = places[number]
            layer = "UP" if number > 3 else "DOWN"
            # Ends meet within 3 mm, as those of a dam of 45 m do that was drawn by hand.
            space.add_line(end, (start[0] + 0.003, start[1]), dxfattribs={"layer": layer})

    case = saved(tmp_path, draw)
    assert case.outline.symmetric_difference(own).area < 0.003 * own.length
    assert len(case.section.polygon) == len(CORNERS)


OPEN = CORNERS[:3] + CORNERS[4:]


@pytest.mark.parametrize(
    ("draw", "words"),
    [
        (
            lambda space: by_lines(space, CORNERS, closed=False),
            "section.file: has no closed outline; a line ends alone",
        ),
        (lambda space: (outline(space, FRAME), by_lines(space, CORNERS, "X", closed=False)), '5 LINE on "X"'),
        (lambda space: (outline(space, CORNERS), space.add_circle((5.0, 10.0), 1.0)), "there are 2 closed outlines"),
        (lambda space: (outline(space, CORNERS), space.add_line((0.0, 20.0), (9.0, 20.0))), "has other lines inside"),
        (lambda space: (outline(space, CORNERS), space.add_line((0.0, 60.0), (9.0, 60.0))), "stands beside other"),
        (lambda space: (outline(space, FRAME), space.add_solid(CORNERS[:4])), '1 SOLID on "0"'),
        (
            lambda space: (
                outline(space, OPEN),
                space.add_spline([CORNERS[2], (5.0, 41.0), CORNERS[4]], dxfattribs={"layer": "CREST"}),
            ),
            'has a straight edge where another line has the same two ends: 1 SPLINE on "CREST"',
        ),
        (
            lambda space: (
                outline(space, OPEN),
                space.add_arc((-10.0, 40.0), 16.12, 20.0, 40.0, dxfattribs={"layer": "CREST"}),
            ),
            'stands beside other lines: 1 ARC on "CREST"',
        ),
    ],
)
def test_a_lone_outline_is_the_dam_where_nothing_else_could_be(tmp_path, draw, words):
    with pytest.raises(InputError) as refused:
        saved(tmp_path, draw)
    assert words in str(refused.value)


def test_a_layer_is_the_dam_where_it_has_one_outline_alone(tmp_path):
    def draw(space):
        outline(space, CORNERS)
        space.add_line((0.0, 20.0), (9.0, 20.0), dxfattribs={"layer": "JOINTS"})
        outline(space, OPEN, "MIXED")
        space.add_spline([CORNERS[2], (5.0, 41.0), CORNERS[4]], dxfattribs={"layer": "mixed"})

    assert len(saved(tmp_path, draw, layer="dam").section.polygon) == len(CORNERS)
    with pytest.raises(InputError, match='the layer "MIXED" has a straight edge where another line') as refused:
        saved(tmp_path, draw, layer="MIXED")
    assert refused.value.code == "drawing-mixed"
    with pytest.raises(InputError, match='"JOINTS" has no closed outline; a line ends alone at'):
        saved(tmp_path, draw, layer="JOINTS")


def test_a_hidden_outline_is_not_taken_for_the_dam(tmp_path):
    def draw(space):
        outline(space, CORNERS, "OLD")

    assert saved(tmp_path, draw).outline.is_valid
    with pytest.raises(InputError, match='"OLD", is hidden'):
        saved(tmp_path, draw, frozen=["OLD"])
    assert saved(tmp_path, draw, frozen=["OLD"], layer="OLD").outline.is_valid

    def beside(space):
        draw(space)
        by_lines(space, FRAME, "NEW")

    with pytest.raises(
        InputError, match=r'by layers: "OLD, hidden" \(1\), "NEW" \(1\)|"OLD", hidden \(1\), "NEW" \(1\)'
    ):
        saved(tmp_path, beside, frozen=["OLD"])

    def unseen(space):
        outline(space, CORNERS).dxf.invisible = 1

    with pytest.raises(InputError, match='"DAM", is hidden'):
        saved(tmp_path, unseen)


def test_curves_within_a_tolerance(tmp_path):
    """Areas of circles, ellipses and parabolas in closed form: a dam of 40 m whose downstream face is each of them."""
    height, out = 40.0, 30.0

    def draw(kind):
        def lines(space):
            if kind == "bulge":
                # A quarter of a circle about (40, 40): tan(90/4) to the right of the way down.
                corners = [(0.0, 0.0), (0.0, 40.0, math.tan(math.pi / 8.0)), (40.0, 0.0)]
                space.add_lwpolyline([(*corner, 0.0)[:3] for corner in corners], format="xyb", close=True)
                return
            by_lines(space, [(0.0, height), (0.0, 0.0), (out if kind != "arc" else height, 0.0)], "0", closed=False)
            if kind == "arc":
                space.add_arc((40.0, 40.0), 40.0, 180.0, 270.0)
            elif kind == "ellipse":
                space.add_ellipse((out, height), (0.0, -height), out / height, math.pi * 1.5, math.tau)
            else:
                # Three control points: a parabola, which leaves a third of the triangle before it.
                space.add_open_spline([(0.0, height), (0.0, 0.0), (out, 0.0)], degree=2)

        return lines

    quarter = 1.0 - math.pi / 4.0
    for kind, area, length in (
        ("arc", quarter * height**2, 20.0 * math.pi),
        ("bulge", quarter * height**2, 20.0 * math.pi),
        ("ellipse", quarter * height * out, 56.0),
        ("spline", height * out / 6.0, 56.0),
    ):
        case = saved(tmp_path, draw(kind))
        assert case.outline.area == pytest.approx(area, abs=1e-4 * 40.0 * length), kind
        assert case.outline.bounds[3] == pytest.approx(height, rel=1e-12)
        assert 10 < len(case.section.polygon) < 80, kind


def test_blocks_stand_where_they_are_inserted(tmp_path):
    def lying(corners):
        return [(-0.5 * z, 0.5 * x) for x, z in corners]

    def draw(space):
        inner = space.doc.blocks.new("INNER")
        inner.add_lwpolyline(lying(CORNERS[:4]))
        inner.add_line(*lying(CORNERS[3:5]))
        block = space.doc.blocks.new("SECTION")
        block.add_blockref("INNER", (0.0, 0.0))
        by_lines(block, lying([*CORNERS[4:], CORNERS[0]]), "0", closed=False)
        there = {"xscale": 2.0, "yscale": 2.0, "rotation": -90.0}
        space.add_blockref("SECTION", (100.0, 7.0), dxfattribs={**there, "layer": "DAM"})
        space.add_blockref("SECTION", (300.0, 7.0), dxfattribs={**there, "yscale": -6.0, "layer": "MIRRORED"})

    own = read_case(dam(**polygon(CORNERS))).outline
    case = saved(tmp_path, draw, layer="DAM")
    moved = shapely.affinity.translate(own, 100.0, 7.0)
    assert case.outline.symmetric_difference(moved).area == pytest.approx(0.0, abs=1e-9)
    mirrored = saved(tmp_path, draw, layer="MIRRORED").outline
    assert mirrored.area == pytest.approx(3.0 * own.area)
    assert mirrored.bounds == pytest.approx((300.0 - 3.0 * 34.4, 7.0, 300.0 + 3.0 * 2.1, 52.0))


def test_blocks_without_end_are_refused(tmp_path):
    """Nine times itself, sixteen deep, and a million copies of nothing."""

    def within_itself(space):
        block = space.doc.blocks.new("SELF")
        for place in range(9):
            block.add_blockref("SELF", (float(place), 0.0))
        space.add_blockref("SELF", (0.0, 0.0))

    def copies(space):
        space.doc.blocks.new("NONE")
        grid = {"row_count": 1000, "column_count": 1000, "row_spacing": 1.0, "column_spacing": 1.0}
        space.add_blockref("NONE", (0.0, 0.0), dxfattribs=grid)
        space.add_line((0.0, 0.0), (1.0, 0.0))

    for draw in (within_itself, copies):
        with pytest.raises(InputError) as refused:
            saved(tmp_path, draw)
        assert refused.value.code == "too-large"


def test_every_answer_says_which_outline_is_the_dam(tmp_path):
    """40 m high, 30 m at its base and 2 m at its crest: 640 m² by hand."""

    def draw(space):
        outline(space, [(0.0, 0.0), (30.0, 0.0), (2.0, 40.0), (0.0, 40.0)], "PIER 3")
        outline(space, FRAME, "FRAME")

    case = saved(tmp_path, draw, layer="pier 3")
    shaken = case.with_({"motion": {"points": [["0 s", "0 g"], ["0.2 s", "0.3 g"], ["0.4 s", "0 g"]]}})
    again = read_case(tomllib.loads(case_text(shaken.model_dump(mode="json", exclude_unset=True))))
    for answer in (run(shaken), run(again), statics_of_sections(case)):
        (note,) = [warning for warning in answer.warnings if warning.code == "section-drawn"]
        said = 'section from a drawing: 40 m high, 30 m wide at its base, 640 m², on the layer "PIER 3"; read to 4 mm'
        assert str(note) == said
    elastic = shaken.with_({"concrete.modulus": "30 GPa", "flexible.elements_across": 2})
    solved = solve(shaken, "crack.friction", "residual_slip = 1 mm", model="rigid")
    for result in (dam_periods(elastic, 1), overturning_map(shaken, count=2), solved):
        assert result.to_json()["drawing"] == said
    # Other corners are of no drawing.
    assert case.with_({"section.polygon": [["0 m", "0 m"], ["9 m", "0 m"], ["0 m", "9 m"]]}).section.layer is None


@pytest.mark.parametrize(
    "arguments",
    [
        ["statics"],
        ["run", "--model", "rigid"],
        pytest.param(["run", "--model", "rigid", "--vary", "motion.pga=0.1g,0.2g"], marks=pytest.mark.slow),
        pytest.param(["periods", "--set", "concrete.modulus=30 GPa"], marks=pytest.mark.slow),
        pytest.param(["overturning", "--count", "2"], marks=pytest.mark.slow),
        pytest.param(["solve", "crack.friction", "--until", "residual_slip=10mm"], marks=pytest.mark.slow),
    ],
)
def test_every_command_says_which_outline_is_the_dam(tmp_path, arguments):
    saved(tmp_path, lambda space: outline(space, [(0.0, 0.0), (30.0, 0.0), (2.0, 40.0), (0.0, 40.0)]))
    (tmp_path / "a.toml").write_text(
        'section.file = "a.dxf"\ncrack.friction = 1.0\nlimits.residual_slip = "1 m"\nanalysis.silence = "0 s"\n'
        'motion = { file = "synthetic:M6.5,20km,seed=3", pga = "0.3 g", duration = "5 s" }\n'
    )
    name, *others = arguments
    words = " ".join(command(name, "a.toml", *others, "--json", "a.json", cwd=tmp_path).stdout.split())
    said = 'section from a drawing: 40 m high, 30 m wide at its base, 640 m², on the layer "DAM"'
    assert said in words
    assert json.dumps(said, ensure_ascii=False)[1:-1] in (tmp_path / "a.json").read_text(encoding="utf-8")


TRIANGLE = CORNERS[:3]
TWICE = drawing(CORNERS, CORNERS, layer="")
REFUSED = [
    ("missing", table(CORNERS, ""), {}),
    ("missing", drawing(CORNERS, unit=0), {}),
    # A dam of 45 m in a template of millimetres is 45 mm high by it; one in millimetres under metres 45 km.
    ("drawing-height", drawing(CORNERS, unit=4), {}),
    ("drawing-height", drawing([(1e3 * x, 1e3 * z) for x, z in CORNERS], unit=6), {}),
    ("section-row", table(CORNERS) + b"1,x\n", {}),
    ("section-row", table(CORNERS) + b"1\n", {}),
    ("section-row", table(CORNERS) + b"1,nan\n", {}),
    ("section-row", table(CORNERS) + b"1,2,3\n", {}),
    ("section-head", table(CORNERS, "x [m],z [ft]\n"), {}),
    ("section-head", b"name,east,north\na,1,2\n", {}),
    ("source-unreadable", b"", {}),
    ("source-unreadable", b"\xff\xfe\x00\x01", {}),
    ("too-large", table([(float(n), 0.0) for n in range(10_002)]), {}),
    ("too-large", b"1,2\n" * 3_000_000, {}),
    ("too-few", table(TRIANGLE[:2]), {}),
    ("unit-unknown", table(CORNERS, "x [wide],z [wide]\n"), {}),
    ("wrong-quantity", table(CORNERS), {"unit": "kg"}),
    ("wrong-type", table(CORNERS), {"unit": 5}),
    ("fields-conflict", table(CORNERS), {"height": "5 m", "polygon": []}),
    ("needs-other", table(CORNERS), {"layer": "DAM"}),
    ("drawing-empty", drawing(CORNERS, closed=False), {}),
    ("drawing-layer", drawing(CORNERS), {"layer": "DIKE"}),
    ("drawing-several", TWICE.replace(b"DAM1", b"DAM"), {}),
    ("source-unreadable", drawing(CORNERS)[:2000], {}),
    ("source-unreadable", b"0\nSECTION\n2\nENTITIES\nx\ny\n", {}),
    ("source-unreadable", b"AutoCAD Binary DXF\r\n\x1a\x00" + bytes(500), {}),
]


@pytest.mark.parametrize(("code", "content", "more"), REFUSED)
def test_refused(tmp_path, code, content, more):
    with pytest.raises(InputError) as caught:
        read(tmp_path / "section", content, **more)
    assert caught.value.code == code
    assert caught.value.field.startswith("section")


def test_refused_paths(tmp_path):
    for name, code in (("no.csv", "file-missing"), (".", "file-unreadable")):
        with pytest.raises(InputError) as caught:
            read_case({**CRACK, "section": {"file": name}})
        assert caught.value.code == code
    assert read_case_at(tmp_path).section.polygon[1] == CORNERS[1]


def read_case_at(folder):
    """Read a case that names a file beside it."""
    (folder / "dam.csv").write_bytes(table(CORNERS))
    (folder / "dam.toml").write_text('section = { file = "dam.csv" }\ncrack.friction = 1.0\n')
    return read_case(folder / "dam.toml")


def test_a_case_keeps_its_corners_when_it_changes(tmp_path):
    case = read_case_at(tmp_path)
    (tmp_path / "dam.csv").unlink()
    assert case.with_("crack.friction=0.5").section == case.section
    (tmp_path / "other.csv").write_bytes(table(TRIANGLE))
    assert case.with_("section.file=other.csv").section.vertices() == tuple(TRIANGLE)
    assert case.with_({"section.downstream": [["0 m", 1.0]], "section.height": "9 m", "section.crest_width": "1 m"})


def test_without_the_package(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ezdxf.filemanagement", None)
    with pytest.raises(InputError, match=r"pip install ezdxf"):
        read(tmp_path / "a.dxf", drawing(CORNERS))


@pytest.mark.parametrize(
    ("section", "words"),
    [
        ({"downstream": [["1 m", 0.8]]}, "section.downstream: the elevations"),
        ({"downstream": [["0 m", 0.8], ["0 m", 0.7]]}, "do not ascend"),
        ({"downstream": []}, "section.downstream: the elevations"),
        (
            {"upstream": [["0 m", 0.1], ["40 m", 0.0]]},
            "section.upstream: 40 m is out of range; give a value below the crest at 40 m",
        ),
        ({"upstream": [["0 m", 0.1]], "base_width": "30 m"}, "section.base_width: cannot stand beside"),
        ({"upstream": [["0 m", -1.5]]}, "crosses or touches itself"),
        ({"layer": "DAM", "base_width": "30 m"}, "section.layer: has no meaning without a file"),
    ],
)
def test_refused_faces(section, words):
    with pytest.raises(InputError) as caught:
        read_case(dam(height="40 m", crest_width="5 m", **section))
    assert any(words in str(item) for item in (caught.value, *caught.value.others))


@given(st.binary(max_size=400), st.integers(0, 3))
@settings(max_examples=60)
def test_broken_files_are_refused_in_words(tmp_path_factory, noise, kind):
    """Noise, alone and within files that were sound: corners, or a sentence."""
    path = tmp_path_factory.mktemp("section") / "section"
    sound = (b"", table(CORNERS), drawing(CORNERS), b"0\nSECTION\n")[kind]
    cut = len(sound) * (noise[0] if noise else 0) // 255
    path.write_bytes(sound[:cut] + noise + sound[cut + len(noise) :])
    with suppress(InputError):
        assert read_corners(path, unit="m")
