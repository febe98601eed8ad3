"""What a tab may ask of its motion: used in the case as any other change of it, and called as its sender calls it."""

from __future__ import annotations

import json
import math

import pytest

pytest.importorskip("starlette")

from shared.app import HEADERS, HOME, client_in

CALLED = "my <b>quake.txt"
FORM = {"horizontal": {"source": f"record:{CALLED}", "unit": "g"}, "vertical": {"source": ""}}


@pytest.fixture
def tab(tmp_path):
    """Open a tab that has sent a record, and return what asks it."""
    with (
        client_in(tmp_path) as client,
        client.websocket_connect("/talk", headers=HEADERS) as socket,
    ):
        session = socket.receive_json()["session"]

        def ask(what, /, **fields):
            """Return the answer without the names that its files have here."""
            ask.serial += 1
            socket.send_json({"do": what, "serial": ask.serial, **fields})
            while (message := socket.receive_json()).get("serial") != ask.serial:
                assert message["of"] == "state"
            assert "upload-" not in json.dumps(message)
            return message

        ask.serial = 0
        # It drifts, which is warned of by its name.
        record = "".join(f"{0.02 * k:.2f} {0.05 + 0.4 * math.sin(0.3 * k):.5f}\n" for k in range(300))
        headers = {"origin": HOME, "x-session": session}
        file = client.post("/upload", content=record.encode(), headers=headers).json()["name"]
        assert "error" not in ask("record", file=file, called=CALLED)
        yield ask


@pytest.mark.slow
def test_a_record_is_called_as_its_sender_calls_it(tab):
    assert CALLED in json.dumps(tab("motion look", form=FORM)["motions"])
    assert "error" not in tab("use motion", form=FORM)
    answer = tab("rigid", values={})
    assert CALLED in answer["shaking"]
    assert any(CALLED in warning["text"] for warning in answer["warnings"])
    assert CALLED in json.dumps(tab("statics", values={}, spectrum="")["basis"])
    assert tab("study form")["choices"]["own"] == CALLED
    assert tab("case")["fields"]["motion"]["file"] == CALLED


def test_a_motion_in_the_case_is_a_step_that_is_taken_back(tab):
    before = tab("case")["fields"]["motion"]
    tab("rigid", values={"motion.pga": 0.3})
    tab("use motion", form=FORM)
    assert tab("case")["fields"]["motion"] == {"file": CALLED, "unit": "g"}
    assert tab("step case")["fields"]["motion"]["pga"] == "0.3 g"
    assert tab("step case")["fields"]["motion"] == before
    tab("step case", forward=True)
    assert tab("step case", forward=True)["fields"]["motion"]["file"] == CALLED


@pytest.mark.slow
def test_what_keeps_a_motion_from_being_in_force_is_told(tab):
    tab("edit case", changes={"crack.friction": "slippery"})
    messages = tab("use motion", form=FORM)
    assert messages["error"]["field"] == "crack.friction"
    tab("edit case", changes={"crack.friction": "1"})
    assert CALLED in tab("rigid", values={})["shaking"]


@pytest.mark.slow
def test_a_motion_that_cannot_be_read_changes_nothing(tab):
    before = tab("case")["fields"]
    way = {**FORM["horizontal"], "unit": "parsec"}
    assert tab("use motion", form={**FORM, "horizontal": way})["error"]["field"] == "motion.unit"
    assert tab("case")["fields"] == before


@pytest.mark.slow
def test_aftershocks_are_added_moved_and_removed(tab):
    first = tab("motion")["motions"][0]["title"]
    assert tab("use motion", form=FORM, to=1)["place"] == 1
    messages = tab("motion", place=1)
    assert [motion["title"] for motion in messages["motions"]] == [first, CALLED]
    assert messages["form"]["horizontal"]["title"] == CALLED
    assert tab("change motions", what="pause", place=1, pause="12").get("error") is None
    assert tab("case")["fields"]["aftershocks"] == [{"file": CALLED, "unit": "g", "pause": "12 s"}]
    tab("change motions", what="up", place=1)
    assert tab("case")["fields"]["motion"] == {"file": CALLED, "unit": "g"}
    # Its own source is the one that is looked at, wherever it goes.
    tab("use motion", form={"horizontal": {"source": "case", "pga": "0.2", "unit": "g"}, "vertical": {}}, place=0, to=2)
    assert tab("case")["fields"]["aftershocks"][1] == {"file": CALLED, "unit": "g", "pga": "0.2 g"}
    assert tab("change motions", what="pause", place=1, pause="long")["error"]["field"] == "aftershocks[0].pause"
    assert "long" in tab("motion")["motions"][1]["wrong"]
    tab("change motions", what="pause", place=1, pause="")
    for what, place in (("remove", 2), ("remove", 1)):
        tab("change motions", what=what, place=place)
    assert "aftershocks" not in tab("case")["fields"]
    for asked in (
        {"what": "remove", "place": 0}, {"what": "up", "place": 0}, {"what": "down", "place": 0},
        {"what": "pause", "place": 0, "pause": "1"}, {"what": "x", "place": 0}, {"what": "up", "place": "1"},
    ):  # fmt: skip
        assert tab("change motions", **asked)["of"] == "bad request"
    assert tab("use motion", form=FORM, to=2)["of"] == "bad request"
