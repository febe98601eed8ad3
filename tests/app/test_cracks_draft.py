"""Cracks, laws and aftershocks of a case as it is typed: what is put in begins sound, and its drawing shows it."""

from __future__ import annotations

import pytest

from heeltoe.app.case.defaults import block, following, item
from heeltoe.app.case.draft import back, draft_of, edit, fields_of, start
from heeltoe.app.case.drawing import drawing, law
from heeltoe.app.case.fields import blocks, field_of, typed
from heeltoe.app.case.handles import handles, moved
from heeltoe.app.open_case import begin, example_path
from heeltoe.app.sessions import Session
from heeltoe.app.studies.draft import choices
from heeltoe.case.crack.law import LAW_FIELDS
from heeltoe.case.fields_file import read_fields
from heeltoe.mechanics.law_curve import curve_of
from shared.dams import example


@pytest.fixture
def session(tmp_path):
    one_session = Session("", tmp_path)
    begin(one_session)
    return one_session


def choose(session, name):
    edit(session, following({"crack.law.name": name}, fields_of(session)[0]))
    assert not draft_of(session).errors
    return session.case


def put(session, path, *, there):
    edit(session, block(session.case, session.units, path, wanted=there))
    assert not draft_of(session).errors


@pytest.mark.parametrize("name", LAW_FIELDS)
def test_each_law_begins_sound_and_goes_back_to_the_friction_that_it_had(session, name):
    edit(session, {"crack.friction": None, "crack.static_friction": 1.1, "crack.kinetic_friction": 0.7})
    put(session, "crack.law", there=True)
    assert (session.case.crack.law.peak_friction, session.case.crack.law.residual_friction) == (1.1, 0.8)
    case = choose(session, name)
    assert case.crack.law.name == name
    drawn = law(case, "si")
    curve = curve_of(case)
    assert drawn["at"][0] == pytest.approx(curve.at[0] * drawn["at"][-1] / curve.at[-1], rel=1e-4)
    assert (drawn["friction"][0], drawn["friction"][-1]) == pytest.approx((curve.friction[0], curve.friction[-1]), 1e-4)
    assert drawn["dot"][1] == curve.at_rest
    assert f"{curve.at_rest:.3g}" in drawn["sentence"]
    assert "those of no dam" in drawn["sentence"]
    put(session, "crack.law", there=False)
    assert session.case.crack.friction == pytest.approx(curve.at_rest, rel=6e-3)
    assert law(session.case, "si") is None


def test_what_two_laws_share_stays(session):
    put(session, "crack.law", there=True)
    edit(session, {"crack.law.slip": "33 mm", "crack.law.residual_friction": 0.7})
    case = choose(session, "cohesion")
    assert (case.crack.law.slip, case.crack.law.residual_friction, case.crack.law.peak_friction) == (0.033, 0.7, None)
    assert "no dam: cohesion." in law(case, "si")["sentence"]
    edit(session, {"crack.law.cohesion": "0.2 MPa"})
    assert "no dam" not in law(session.case, "si")["sentence"]


def test_a_field_of_a_law_says_which_laws_know_it():
    assert field_of("crack.law.name").only == ()
    assert field_of("crack.law.slip").only == ("slip weakening", "cohesion")
    of_law = next(entry for entry in blocks() if entry.path == "crack.law").fields
    for name, (needed, allowed) in LAW_FIELDS.items():
        shown = {entry.path.rpartition(".")[2] for entry in of_law if entry.only and name in entry.only}
        assert shown == {*needed, *allowed}


def test_further_cracks_go_where_there_is_room(session):
    for _ in range(3):
        there = fields_of(session)[0].get("further_cracks", [])
        edit(session, {"further_cracks": [*there, item(session.case, "si", "further_cracks")]})
        assert not draft_of(session).errors
    assert [further_crack.elevation for further_crack in session.case.further_cracks] == [90.0, 45.0, 22.5]


def test_every_crack_is_drawn_and_moved(session):
    case = example("two-cracks")
    drawn = drawing(case, "si")
    lines = {line["kind"]: line["points"] for line in drawn["lines"]}
    assert lines["crack"] == [[0.0, 0.0], [80.0, 0.0]]
    assert lines["further-crack"] == [[0.0, 90.0], [8.0, 90.0]]
    assert sum(shape["kind"] == "uplift" for shape in drawn["shapes"]) == 2
    (handle,) = [entry for entry in handles(case, "si") if entry.name == "further crack 1"]
    assert handle.at == pytest.approx((2.8, 90.0))
    changed = moved(case, "si", "further crack 1", {"z": 60.2})
    assert changed["further_cracks"][0]["elevation"] == "60 m"
    assert case.with_(changed).further_cracks[0].elevation == 60.0
    # Elevations count from the lowest point of the section.
    edit(session, {"section": {"polygon": [["0 m", "5 m"], ["80 m", "5 m"], ["0 m", "105 m"]]}})
    edit(session, {"further_cracks": [{"elevation": "50 m"}]})
    (handle,) = [entry for entry in handles(session.case, "si") if entry.name == "further crack 1"]
    assert handle.at == pytest.approx((14.0, 55.0))
    assert moved(session.case, "si", handle.name, {"z": 65.0})["further_cracks"][0]["elevation"] == "60 m"


def test_an_aftershock_has_all_that_a_motion_has(session):
    edit(session, {"aftershocks": [item(session.case, "si", "aftershocks")]})
    assert not draft_of(session).errors
    given = {
        "points": [["0", "0.1"], ["1", "0"]],
        "vertical": {"points": [["0", "0.1"], ["1", "0"]], "pga": "0.2"},
        "processing": [{"step": "cut", "low": "1"}],
        "pause": "12",
    }
    (result,) = typed([given], field_of("aftershocks"), "si")
    assert result["points"] == [["0 s", "0.1 g"], ["1 s", "0 g"]]
    assert result["vertical"] == {"points": [["0 s", "0.1 g"], ["1 s", "0 g"]], "pga": "0.2 g"}
    assert result["pause"] == "12 s"
    cells = field_of("aftershocks").inner[2].inner
    assert [cell.label for cell in cells] == ["Time", "Acceleration"]
    back(session)
    assert not session.case.aftershocks


def test_every_list_begins_with_something_sound(session):
    for path in ("anchors", "statics.sections", "further_cracks", "aftershocks"):
        edit(session, {path: [item(session.case, "si", path)]})
        assert not draft_of(session).errors, path
        back(session)


def test_a_study_begins_with_a_model_that_knows_the_crack(session):
    assert choices(session)["usual"] == "rigid"
    start(session, read_fields(example_path("stepped-crack")))
    assert choices(session)["usual"] == "flexible"


def test_every_block_begins_sound(session):
    had = [entry.path for entry in blocks() if entry.optional]
    assert {"crack.law", "crack.roughness", "tailwater"} <= set(had)
    for path in had:
        put(session, path, there=True)
        back(session)


@pytest.mark.parametrize("units", ["si", "us"])
def test_an_anchor_of_several_cracks_goes_through_all_of_them(units):
    case = example("two-cracks")
    held = case.with_({"anchors": [item(case, units, "anchors")]})
    for alone in held.single_crack_cases:
        (anchor,) = alone.anchors_at_crack
        assert anchor.prestress == 1e6
        assert anchor.distance == pytest.approx(4.0, rel=1e-3)


def test_a_law_of_a_further_crack_begins_sound(session):
    edit(session, {"further_cracks": [{"elevation": "60 m", "friction": 0.9}]})
    for chosen, name in (({}, "slip weakening"), ({"name": "lift joint"}, "lift joint")):
        put_in = {"further_cracks": [{"elevation": "60 m", "friction": 0.9, "law": chosen}]}
        edit(session, following(put_in, fields_of(session)[0]))
        assert not draft_of(session).errors
        assert session.case.further_cracks[0].law.name == name
        assert session.case.further_cracks[0].friction is None
    # What is typed into it later stays as it is typed.
    own = session.case.further_cracks[0].law.model_dump(mode="json", exclude_unset=True) | {"basic_friction": 0.65}
    typed = {"further_cracks": [{"elevation": "60 m", "law": own}]}
    assert following(typed, fields_of(session)[0]) == typed
