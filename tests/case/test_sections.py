"""Sections by the slopes of their faces, from tables and from drawings: the same dam, to the last bit."""

from __future__ import annotations

import io
import sys
from contextlib import suppress
from itertools import pairwise

import ezdxf
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from heeltoe import InputError, read_case
from heeltoe.case.section_file import read_corners
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
        more = {"unit": "m"} if name == "c.txt" else {}
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


def test_a_frame_around_a_dam_that_is_drawn_as_lines_is_not_taken_for_the_dam(tmp_path):
    """The right answer is a question: a frame of 60 x 60 m would be a block that stands."""
    made = ezdxf.new("R2010", units=6)
    made.layers.add("FRAME")
    space = made.modelspace()
    frame = [(-10.0, -5.0), (50.0, -5.0), (50.0, 55.0), (-10.0, 55.0)]
    space.add_lwpolyline(frame, close=True, dxfattribs={"layer": "FRAME"})
    for start, end in pairwise([*CORNERS, CORNERS[0]]):
        space.add_line(start, end, dxfattribs={"layer": "DAM"})
    space.add_text("Section A-A", dxfattribs={"layer": "TEXT"})
    path = tmp_path / "a.dxf"
    made.saveas(path)
    with pytest.raises(InputError, match=r'section.layer: the only closed .*"FRAME", stands .*: 6 on "DAM"') as refused:
        read(path, path.read_bytes())
    assert refused.value.code == "drawing-beside"
    with pytest.raises(InputError, match='"DAM" has no closed polyline'):
        read(path, path.read_bytes(), layer="DAM")
    assert read(path, path.read_bytes(), layer="FRAME").outline.area == pytest.approx(3600.0)


def test_a_hidden_outline_is_not_taken_for_the_dam(tmp_path):
    made = ezdxf.new("R2010", units=6)
    layer = made.layers.add("OLD")
    made.modelspace().add_lwpolyline(CORNERS, close=True, dxfattribs={"layer": "OLD"})
    path = tmp_path / "a.dxf"
    made.saveas(path)
    assert read(path, path.read_bytes()).outline.is_valid
    layer.freeze()
    made.saveas(path)
    with pytest.raises(InputError, match='"OLD", is hidden'):
        read(path, path.read_bytes())


TRIANGLE = CORNERS[:3]
ARCS, TWICE = drawing(CORNERS, bulge=0.3), drawing(CORNERS, CORNERS, layer="")
REFUSED = [
    ("section-unit-missing", table(CORNERS, ""), {}),
    ("section-unit-missing", drawing(CORNERS, unit=0), {}),
    ("section-row", table(CORNERS) + b"1,x\n", {}),
    ("section-row", table(CORNERS) + b"1\n", {}),
    ("section-row", table(CORNERS) + b"1,nan\n", {}),
    ("section-row", table(CORNERS) + b"1,2,3\n", {}),
    ("section-head", table(CORNERS, "x [m],z [ft]\n"), {}),
    ("section-head", b"name,east,north\na,1,2\n", {}),
    ("section-file-kind", b"", {}),
    ("section-file-kind", b"\xff\xfe\x00\x01", {}),
    ("section-file-large", table([(float(n), 0.0) for n in range(10_002)]), {}),
    ("section-file-large", b"1,2\n" * 3_000_000, {}),
    ("polygon-corners", table(TRIANGLE[:2]), {}),
    ("unit-unknown", table(CORNERS, "x [wide],z [wide]\n"), {}),
    ("wrong-quantity", table(CORNERS), {"unit": "kg"}),
    ("wrong-type", table(CORNERS), {"unit": 5}),
    ("fields-conflict", table(CORNERS), {"height": "5 m", "polygon": []}),
    ("needs-other", table(CORNERS), {"layer": "DAM"}),
    ("drawing-empty", drawing(CORNERS, closed=False), {}),
    ("drawing-layer", drawing(CORNERS), {"layer": "DIKE"}),
    ("drawing-arcs", ARCS, {}),
    ("drawing-several", TWICE.replace(b"DAM1", b"DAM"), {}),
    ("drawing-unreadable", drawing(CORNERS)[:2000], {}),
    ("drawing-unreadable", b"0\nSECTION\n2\nENTITIES\nx\ny\n", {}),
    ("drawing-unreadable", b"AutoCAD Binary DXF\r\n\x1a\x00" + bytes(500), {}),
]


@pytest.mark.parametrize(("code", "content", "more"), REFUSED)
def test_refused(tmp_path, code, content, more):
    with pytest.raises(InputError) as caught:
        read(tmp_path / "section", content, **more)
    assert caught.value.code == code
    assert caught.value.field.startswith("section")


def test_refused_paths(tmp_path):
    for name, code in (("no.csv", "section-file-missing"), (".", "section-file-unreadable")):
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
        ({"downstream": [["0 m", 0.8], ["0 m", 0.7]]}, "do not ascend from 0 m"),
        ({"downstream": []}, "section.downstream: the elevations"),
        ({"upstream": [["0 m", 0.1], ["40 m", 0.0]]}, "section.upstream: 40 m is not below the crest at 40 m"),
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
