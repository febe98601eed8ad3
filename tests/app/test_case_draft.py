"""The case of a tab as it is typed: what is wrong is told at its field, the last sound case stays, nothing is lost."""

from __future__ import annotations

import json

import pytest

from heeltoe.app.case.draft import back, case_of, draft_of, edit, fields_in_force, fields_of, start
from heeltoe.app.case.drawing import drawing
from heeltoe.app.case.fields import blocks, field_of, form, typed
from heeltoe.app.case.handles import corners_of, handle_data, handles, length_text, moved
from heeltoe.app.open_case import begin
from heeltoe.app.sessions import Session, Sessions
from heeltoe.app.settings import Settings
from heeltoe.case.fields_file import read_fields
from heeltoe.case.read import read_case
from heeltoe.case.toml_writer import case_text
from heeltoe.errors.error import InputError
from shared.dams import ALL_EXAMPLES, PLAIN, example


@pytest.fixture
def session(tmp_path):
    one_session = Session("", tmp_path)
    begin(one_session)
    return one_session


def wrong(session):
    return [item.field for item in fields_of(session)[1]]


def test_the_last_sound_case_stays_while_a_field_is_wrong(session):
    before = session.case
    edit(session, {"crack.friction": "slippery", "reservoir.depth": "12"})
    assert session.case is before
    assert sorted(wrong(session)) == ["crack.friction", "reservoir.depth"]
    assert draft_of(session).fields["crack"]["friction"] == "slippery"
    edit(session, {"crack.friction": 0.9, "reservoir.depth": "80 m"})
    assert not wrong(session)
    assert (session.case.crack.friction, session.case.reservoir.depth) == (0.9, 80.0)


def test_what_only_the_geometry_tells_is_at_its_field(session):
    edit(session, {"silt.depth": "101 m"})
    assert wrong(session) == ["silt.depth"]
    edit(session, {"crack.elevation": "120 m"})
    assert wrong(session) == ["silt.depth", "crack.elevation"]


def test_sliders_and_form_are_one_case(session):
    session.changes, session.moved = {"reservoir.depth": "70 m"}, frozenset({"reservoir.depth"})
    assert fields_of(session)[0]["reservoir"]["depth"] == "70 m"
    assert case_of(session).reservoir.depth == 70.0
    edit(session, {"crack.friction": 0.7})
    assert (session.case.reservoir.depth, session.case.crack.friction) == (70.0, 0.7)
    assert (session.changes, session.moved) == ({}, frozenset())
    back(session)
    assert (session.case.reservoir.depth, session.case.crack.friction) == (70.0, 1.0)
    back(session)
    assert session.case.reservoir.depth == 100.0
    back(session, forward=True)
    assert session.case.reservoir.depth == 70.0


def test_a_block_takes_the_place_of_another(session):
    edit(session, {"section": {"polygon": corners_of(session.case, "us")}})
    assert not wrong(session)
    assert session.case.outline.equals_exact(example("typical-base").outline, 1e-6)


def test_letters_of_a_word_are_one_step(session):
    for text in ("9", "90", "90 m"):
        edit(session, {"reservoir.depth": text}, step=1)
    edit(session, {"reservoir.depth": "80 m"}, step=2)
    back(session)
    assert session.case.reservoir.depth == 90.0
    back(session)
    assert session.case.reservoir.depth == 100.0


def test_what_stands_in_place_of_a_block_goes(session):
    start(session, {**PLAIN, "reservoir": 5, "crak": {"friction": 1}})
    assert {"reservoir", "crak"} <= set(wrong(session))
    edit(session, {"reservoir.depth": "9 m", "crak": None, "tailwater.depth": None})
    assert not wrong(session)


@pytest.mark.parametrize("name", ["/etc/passwd", "../../etc/passwd", "record.at2", "upload-0"])
def test_only_files_that_were_sent_are_looked_for(session, name):
    motion = {"file": "elcentro-1940-180-nga"}
    for field, changes in (
        ("aftershocks[1].file", {"aftershocks": [motion, {"file": name}]}),
        ("aftershocks[0].vertical.file", {"aftershocks": [{**motion, "vertical": {"file": name}}]}),
    ):
        before = session.case
        edit(session, changes)
        assert wrong(session) == [field]
        assert "has not been sent" in fields_of(session)[1][0].problem
        assert session.case is before
        back(session)
    for path in ("motion.file", "motion.vertical.file", "flexible.mesh_above"):
        before = session.case
        edit(session, {path: name})
        assert path in wrong(session)
        assert "has not been sent" in fields_of(session)[1][0].problem
        assert session.case is before
        back(session)


def test_a_file_that_was_sent_has_the_name_of_its_sender(session):
    session.sent = {"mine.at2": "upload-1"}
    edit(session, {"motion.file": "mine.at2", "aftershocks": [{"file": "mine.at2"}]})
    assert not wrong(session)
    assert session.case.motion.file == session.case.aftershocks[0].file == "upload-1"
    assert fields_in_force(session)["aftershocks"] == [{"file": "mine.at2"}]
    assert 'file = "mine.at2"' in case_text(fields_in_force(session))


def test_what_another_page_changes_is_taken_over(session):
    session.sent = {"mine.at2": "upload-1"}
    edit(session, {"reservoir.depth": "300 ft", "crack.friction": "x"})
    session.case = session.case.with_("motion.file=upload-1", "tailwater.depth=5m")
    fields, errors = fields_of(session)
    assert fields["motion"]["file"] == "mine.at2"
    assert (fields["reservoir"]["depth"], fields["tailwater"]["depth"]) == ("300 ft", "5.0 m")
    assert [error.field for error in errors] == ["crack.friction"]
    back(session)
    assert "tailwater" not in fields_of(session)[0]


def test_a_tab_that_is_doubled_has_the_same_case(tmp_path):
    sessions = Sessions(Settings("127.0.0.1", 1, tmp_path))
    one = sessions.enter("")
    begin(one)
    (one.folder / "upload-1").write_text("1")
    one.sent = {"mine.at2": "upload-1"}
    edit(one, {"crack.friction": "x", "title": "Mine"})
    other = sessions.enter(one.name)
    assert other is not one
    assert wrong(other) == ["crack.friction"]
    edit(other, {"crack.friction": 0.5})
    assert (one.case.crack.friction, other.case.title) == (1.0, "Mine")
    assert (other.folder / "upload-1").read_text() == "1"


def test_a_case_is_not_too_large(session):
    with pytest.raises(InputError, match="kB"):
        edit(session, {"title": "x" * 300_000})
    deep = []
    for _ in range(100_000):
        deep = [deep]
    with pytest.raises(InputError):
        start(session, {"section": deep})
    assert not wrong(session)


def test_what_json_cannot_say_becomes_text(session, tmp_path):
    path = tmp_path / "odd.toml"
    path.write_text("[crack]\nfriction = inf\nelevation = 1979-05-27\nrestitution = nan\n")
    start(session, read_fields(path))
    json.dumps(fields_of(session)[0], allow_nan=False)
    assert {"crack.friction", "crack.elevation", "crack.restitution", "section"} <= set(wrong(session))


@pytest.mark.parametrize("path", ALL_EXAMPLES, ids=lambda path: path.stem)
def test_what_is_written_is_what_was_read(path, tmp_path):
    file = tmp_path / path.name
    file.write_text(case_text(read_fields(path)), encoding="utf-8")
    written, case = read_case(file), read_case(path)
    cracks = {"crack", "further_cracks"}
    assert written.model_dump(exclude=cracks) == case.model_dump(exclude=cracks)
    assert written.cracks == case.cracks


def test_odd_texts_are_written():
    fields = {"title": 'a "b"\\\n\x00\x7f\ud800', "own key": {"x": [1, -0.5, True, {"y": None, "z": "w"}]}}
    assert '"own key"' in case_text(fields)
    import tomllib

    read = tomllib.loads(case_text(fields))
    assert read["title"] == 'a "b"\\\n\x00\x7f?'
    assert read["own key"]["x"] == [1, -0.5, True, {"z": "w"}]


@pytest.mark.parametrize("units", ["si", "us"])
def test_each_default_and_example_can_be_typed(units):
    shown = [field for block in form(units) for field in block["fields"] if field["kind"] == "quantity"]
    for field in shown:
        for text in filter(None, (field["default"], field["example"])):
            value = typed(text, field_of(field["path"]), units)
            assert value is not None, field["path"]
        plain = typed("2", field_of(field["path"]), units)
        assert plain == (f"2 {field['unit']}" if field["unit"] else 2.0)
    names = {block.path for block in blocks()}
    assert {"", "section", "crack", "reservoir", "uplift", "anchors", "motion.vertical", "analysis"} <= names


def test_what_is_typed():
    assert typed("80", field_of("reservoir.depth"), "us") == "80 ft"
    assert typed("260 ft", field_of("reservoir.depth"), "si") == "260 ft"
    assert typed(" ", field_of("reservoir.depth"), "si") is None
    assert typed("yes", field_of("motion.reverse"), "si") is True
    assert typed("8", field_of("flexible.elements_across"), "si") == 8
    assert typed([["0", ""], "x"], field_of("section.polygon"), "si") == [["0 m", ""], "x"]
    block = {"distance": "3", "prestress": "", "odd": 1}
    assert typed([block], field_of("anchors"), "us") == [{"distance": "3 ft", "odd": 1}]
    step = {"step": "band-pass", "low": "0.1", "order": "4"}
    assert typed([step], field_of("motion.processing"), "si") == [{"step": "band-pass", "low": "0.1 Hz", "order": 4}]


@pytest.mark.parametrize("units", ["si", "us"])
@pytest.mark.parametrize("name", ["typical-base", "anchored", "lift-joint", "koyna"])
def test_handles_move_what_they_stand_for(name, units):
    case = example(name)
    for handle in handles(case, units):
        assert handle_data(handle)["text"]
        for way in handle.ways:
            changed = case.with_(moved(case, units, handle.name, by={way.axis: -1}))
            again = next(item for item in handles(changed, units) if item.name == handle.name)
            value = next(item.value for item in again.ways if item.axis == way.axis)
            assert value == pytest.approx(max(way.value - way.step, way.least), abs=way.step / 1.9)
            assert value < way.value or way.value == way.least
    assert moved(case, units, "nothing", to={"x": 1.0}) == {}


def test_a_handle_follows_the_hand_and_ends_at_its_ends():
    case = example("typical-base")
    assert moved(case, "si", "reservoir", to={"z": 80.2}) == {"reservoir.depth": "80 m"}
    assert moved(case, "si", "reservoir", to={"z": 900.0}) == {"reservoir.depth": "100 m"}
    assert moved(case, "us", "base", to={"x": 80.0}) == {"section.base_width": "262 ft"}
    assert moved(case, "si", "crest", to={"z": 10.0}) == {"section.height": "100 m"}  # water stands there
    there = moved(example("block"), "si", "corner 2", to={"x": 3.0, "z": 0.0})
    assert there["section.polygon"][1] == ["3 m", "0 m"]


@pytest.mark.parametrize("path", ALL_EXAMPLES, ids=lambda path: path.stem)
def test_each_dam_is_drawn(path):
    case = read_case(path)
    seen = drawing(case, "us")
    json.dumps(seen, allow_nan=False)
    kinds = {shape["kind"] for shape in seen["shapes"]}
    assert {"below", "above"} <= kinds
    assert ("water" in kinds) == bool(case.reservoir and case.reservoir.depth)


def test_what_was_typed_beside_what_moves_stays(session):
    edit(session, {"section": {"polygon": [["0 ft", "0 m"], ["200 ft", "0 m"], ["5 m", "100 m"], ["0 m", "100 m"]]}})
    edit(session, {"anchors": [{"distance": "9 ft", "prestress": "1 MN/m"}]})
    fields = fields_in_force(session)
    there = moved(session.case, "si", "corner 3", by={"x": 1.0}, fields=fields)
    assert there == {"section.polygon": [["0 ft", "0 m"], ["200 ft", "0 m"], ["5.5 m", "100 m"], ["0 m", "100 m"]]}
    assert fields["section"]["polygon"][2] == ["5 m", "100 m"]
    there = moved(session.case, "si", "anchor 1", to={"x": 5.0}, fields=fields)
    assert there == {"anchors": [{"distance": "5 m", "prestress": "1 MN/m"}]}


def test_lengths_as_they_are_typed():
    case = example("typical-base")
    assert length_text(case, "si", 0.1) == "10 m"
    assert corners_of(case, "si")[1:3] == [["80 m", "0 m"], ["8 m", "90 m"]]


def test_a_section_from_a_file_is_one_that_was_sent(session):
    edit(session, {"section": {"file": "/etc/passwd"}})
    assert wrong(session)[0] == "section.file"
    (session.folder / "upload-1").write_text("x [m],z [m]\n0,0\n80,0\n8,100\n0,100\n")
    session.sent = {"dam.csv": "upload-1"}
    edit(session, {"section": {"file": "dam.csv"}})
    assert not wrong(session)
    assert session.case.section.polygon[1] == (80.0, 0.0)
    assert 'file = "dam.csv"' in case_text(fields_in_force(session))
    edit(session, moved(session.case, "si", "corner 2", by={"x": 1.0}, fields=fields_in_force(session)))
    assert not wrong(session)
    assert session.case.section.polygon[1] == (80.5, 0.0)


def test_a_fit_of_a_crack_is_one_that_was_sent(session, tmp_path):
    assert field_of("crack.fit").kind == "text"
    (tmp_path / "law-fit.toml").write_text("[crack]\nfriction = 0.7\n")
    for name in (str(tmp_path / "law-fit.toml"), "law-fit.toml"):
        edit(session, {"crack.fit": name})
        assert wrong(session)[0] == "crack.fit"
        assert "has not been sent" in fields_of(session)[1][0].problem
    (session.folder / "upload-1").write_text("[crack]\nfriction = 0.9\n[crack.band]\nlow = 0.8\n")
    session.sent = {"lift.toml": "upload-1"}
    edit(session, {"crack.fit": "lift.toml"})
    assert not wrong(session)
    assert (session.case.crack.friction, session.case.crack.band.low) == (0.9, 0.8)
    assert 'fit = "lift.toml"' in case_text(fields_in_force(session))


def test_slopes_and_ends_are_shown_and_drawn(session):
    faces = {"height": "100 m", "crest_width": "8 m", "downstream": [["0 m", 0.8], ["90 m", 0.0]]}
    ends = {"head_x": "3 m", "head_elevation": "100 m", "foot_x": "9 m", "foot_elevation": "-9 m"}
    edit(session, {"section": faces, "anchors": [{**ends, "prestress": "1 MN/m"}], "units": "us"})
    edit(session, {"uplift": {"pattern": "drained", "drain_x": "5 m", "drain_efficiency": 0.5}})
    assert not wrong(session)
    assert session.units == "us"
    names = [item.name for item in handles(session.case, "si")]
    assert "crest" in names
    assert "drains" in names
    assert not {"base", "anchor 1"} & set(names)
    kinds = [line["kind"] for line in drawing(session.case, "us")["lines"]]
    assert kinds == ["crack", "drain", "anchor"]
