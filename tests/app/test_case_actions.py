"""What a tab may ask of its case: files of its own alone, sizes within bounds, nothing that no page asks."""

from __future__ import annotations

import pytest

pytest.importorskip("starlette")

from shared.app import HEADERS, client_in
from shared.dams import BASE


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    folder = tmp_path_factory.mktemp("app")
    with client_in(folder) as result:
        yield result


def enter(server):
    return server.websocket_connect("/talk", headers=HEADERS)


def heard(tab, of):
    """Return the next message of a kind; the page lives with others between."""
    while (message := tab.receive_json())["of"] != of:
        assert message["of"] in ("hello", "state")
    return message


def sent(server, name, content):
    return server.post("/upload", content=content, headers={**HEADERS, "x-session": name}).json()["name"]


@pytest.mark.parametrize(
    ("action", "fields"),
    [
        ("edit case", {}), ("edit case", {"changes": []}), ("edit case", {"changes": {"": 1}}),
        ("edit case", {"changes": {"a..b": 1}}), ("edit case", {"changes": {f"a{n}": 1 for n in range(100)}}),
        ("put block", {"path": "__class__", "present": True}), ("put block", {"path": ""}),
        ("add item", {"path": "crack"}), ("add item", {"path": "motion.processing"}),
        ("add item", {"path": "aftershocks[0].processing"}), ("add item", {}),
        ("drag", {"handle": 1}),
        ("drag", {"handle": "crest", "to": {"x": "1"}}), ("drag", {"handle": "crest", "to": 5}),
        ("open case", {"file": "../secret", "called": "x"}), ("open case", {"file": "x"}),
        ("open case", {"file": "x", "called": "y", "beside": {"z": 1}}),
    ],
)  # fmt: skip
def test_what_no_page_asks_is_told(server, action, fields):
    with enter(server) as tab:
        heard(tab, "state")
        tab.send_json({"do": action, **fields})
        assert heard(tab, "bad request")
        tab.send_json({"do": "case", "serial": 7})
        messages = heard(tab, "case")
        assert (messages["serial"], messages["errors"]) == (7, [])


def test_a_change_reaches_all_pages(server):
    with enter(server) as tab:
        heard(tab, "state")
        tab.send_json({"do": "edit case", "changes": {"title": "Mine", "reservoir.depth": "70"}})
        state = heard(tab, "state")
        assert (state["case"]["title"], state["case"]["example"]) == ("Mine", "")
        assert next(slider["value"] for slider in state["sliders"] if slider["path"] == "reservoir.depth") == 70.0
        assert heard(tab, "case")["fields"]["reservoir"]["depth"] == "70 m"
        tab.send_json({"do": "drag", "handle": "reservoir", "by": {"z": -1e290}})
        assert heard(tab, "case")["fields"]["reservoir"]["depth"] == "0 m"


def test_files_of_another_tab_are_not_opened(server):
    with enter(server) as one, enter(server) as other:
        name, stranger = heard(one, "hello")["session"], heard(other, "hello")["session"]
        file = sent(server, name, BASE.read_bytes())
        other.send_json({"do": "open case", "file": file, "called": "a.toml"})
        assert heard(other, "bad request")
        other.send_json(
            {"do": "open case", "file": sent(server, stranger, b"x = 1"), "called": "a", "beside": {"b": file}}
        )
        assert heard(other, "bad request")


@pytest.mark.parametrize("content", [b"[", b"\xff\xfe\x00", b'{"section": ' + b"[" * 5000, b"#" * 300_000])
def test_what_is_no_case_file_is_told_by_its_name(server, content):
    with enter(server) as tab:
        file = sent(server, heard(tab, "hello")["session"], content)
        tab.send_json({"do": "open case", "file": file, "called": "../../\u202eevil.toml", "serial": 3})
        messages = heard(tab, "case")
        assert messages["file"].startswith("evil.toml: ")
        assert file not in messages["file"]
        assert messages["fields"]["title"] == "Typical dam cracked at its base"


def test_a_case_and_its_record(server):
    record = b"\n".join(b"%d %d" % (n, n % 3) for n in range(200))
    with enter(server) as tab:
        name = heard(tab, "hello")["session"]
        text = BASE.read_text(encoding="utf-8").replace("elcentro-1940-180-nga", "mine.txt").encode()
        file = sent(server, name, text)
        tab.send_json({"do": "open case", "file": file, "called": "c.toml"})
        messages = heard(tab, "case")
        assert [error["field"] for error in messages["errors"]] == ["motion.file"]
        beside = {"dir\\mine.txt": sent(server, name, record)}
        tab.send_json({"do": "open case", "file": file, "called": "c.toml", "beside": beside})
        assert heard(tab, "case")["errors"] == []
        tab.send_json({"do": "save case"})
        saved = heard(tab, "case file")
        assert 'file = "mine.txt"' in saved["text"]
        assert saved["name"] == "typical-dam-cracked-at-its-base.toml"


def test_sliders_of_a_page_that_does_not_know_the_case_yet_move_nothing(server):
    """They speak of the case before, in the units before; the page asks again with the new state."""
    with enter(server) as tab:
        known = heard(tab, "state")["state"]

        def move(serial, state, **values):
            sliders = {path.replace("_", ".", 1): value for path, value in values.items()}
            tab.send_json({"do": "rigid", "serial": serial, "state": state, "values": sliders})
            return tab.receive_json()["of"]

        assert move(1, known, crack_friction=1.2) == "rigid"
        tab.send_json({"do": "edit case", "changes": {"reservoir.depth": "95 m"}, "serial": 2})
        state = heard(tab, "state")
        assert (state["heard"], state["moved"]) == (1, {})  # what was moved is in the case
        heard(tab, "case")
        assert move(3, known, crack_friction=1.3, reservoir_depth=80) == "late"
        tab.send_json({"do": "units", "units": "us", "serial": 4})
        again = heard(tab, "state")
        place = {slider["path"]: round(slider["value"], 6) for slider in again["sliders"]}
        assert (again["heard"], place["crack.friction"], place["reservoir.depth"]) == (1, 1.2, round(95 / 0.3048, 6))
        assert move(5, again["state"], crack_friction=1.3) == "rigid"
        tab.send_json({"do": "units", "units": "si", "serial": 6})
        assert heard(tab, "state")["moved"] == {"crack.friction": 1.3}
