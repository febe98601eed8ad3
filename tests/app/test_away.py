"""What is taken away: the files are what the shown words make, and nobody else gets at them."""

from __future__ import annotations

import io
import json
import os
import shlex
import subprocess
import sys
import time
import zipfile

import pytest

pytest.importorskip("starlette")

from starlette.testclient import TestClient

from heeltoe.app.downloads import offer
from heeltoe.app.server import application
from heeltoe.app.sessions import Session
from heeltoe.app.settings import Settings

HOME = "http://127.0.0.1:8642"


@pytest.fixture
def ask(tmp_path):
    with TestClient(application(Settings("127.0.0.1", 8642, tmp_path)), base_url=HOME) as client:
        yield client


class Tab:
    """A tab that asks and waits."""

    def __init__(self, socket):
        self.socket = socket
        self.hear("state")

    def hear(self, *kinds):
        """Return the next message of one of these kinds; a job's when it has ended."""
        while True:
            told = self.socket.receive_json()
            if told["of"] in kinds and told.get("state") != "running":
                return told

    def ask(self, what, *kinds, **fields):
        self.socket.send_json({"do": what, **fields})
        return self.hear(*kinds, "bad request", "refused")


@pytest.fixture
def tab(ask):
    with ask.websocket_connect("/talk", headers={"host": "127.0.0.1:8642", "origin": HOME}) as socket:
        yield Tab(socket)


def test_the_shown_words_make_the_same_numbers(ask, tab, tmp_path):
    wanted = {"model": "rigid", "report": True, "csv": True}
    told = tab.ask("rigid", "rigid", values={"crack.friction": 1.1})
    assert told["ok"]
    made = tab.ask("make", "job", **wanted)
    assert made["state"] == "done", made["said"]
    names = {each["name"] for each in made["result"]["files"]}
    assert {"result.json", "report.pdf", "report.html", "histories.csv", "response.png", "response.svg"} <= names
    ours = ask.get(tab.ask("fetch", "download", name="result.json")["address"]).json()
    case = ask.get(tab.ask("case file", "download")["address"])
    assert case.headers["content-disposition"] == 'attachment; filename="case.toml"'
    shown = tab.ask("away", "away", **wanted)
    assert shown["same"]
    for place, words in (
        ("typed", [sys.executable, "-m", *shlex.split(shown["command"])]),
        ("python", [sys.executable, "-c", shown["program"]]),
    ):
        here = tmp_path / place
        here.mkdir()
        (here / "case.toml").write_bytes(case.content)
        done = subprocess.run(words, cwd=here, capture_output=True, text=True, env=os.environ)
        assert done.returncode == 0, done.stderr
        assert json.loads((here / "result" / "result.json").read_text()) == ours
    tab.ask("rigid", "rigid", values={"crack.friction": 1.2})
    assert not tab.ask("away", "away", **wanted)["same"]


def test_a_file_is_served_once_and_as_a_file(ask, tab):
    made = tab.ask("make", "job", model="rigid")
    assert made["state"] == "done", made["said"]
    link = tab.ask("fetch", "download", name="")["address"]
    assert ask.head(link).status_code == 404
    told = ask.get(link)
    assert told.headers["content-disposition"].startswith("attachment")
    assert told.headers["x-content-type-options"] == "nosniff"
    assert "heeltoe.zip" in told.headers["content-disposition"]
    assert zipfile.ZipFile(io.BytesIO(told.content)).testzip() is None
    assert ask.get(link).status_code == 404
    for name in ("../case.toml", "/etc/passwd", "..", ".heeltoe-files", "result.json/../../case.toml"):
        assert tab.ask("fetch", "download", name=name)["of"] == "bad request"
    for path in ("/download/", "/download/x", "/download/../server.py", "/download/%2e%2e%2fcase.toml"):
        assert ask.get(path).status_code == 404


def test_another_tab_gets_nothing(ask, tab):
    assert tab.ask("make", "job", model="rigid")["state"] == "done"
    with ask.websocket_connect("/talk", headers={"host": "127.0.0.1:8642", "origin": HOME}) as socket:
        other = Tab(socket)
        assert other.ask("fetch", "download", name="")["of"] == "bad request"
        assert other.ask("study answers", "study answers", number=1)["of"] == "bad request"


def test_what_no_page_asks(tab):
    for asked in ({"model": "x"}, {"model": 1}, {"model": "rigid", "report": "yes"}, {}):
        assert tab.ask("make", "job", **asked)["of"] == "bad request"


def test_only_files_of_the_tab_are_offered(tmp_path):
    folder = tmp_path / "tab"
    folder.mkdir()
    (folder / "out").symlink_to("/etc")
    session = Session("x", folder)
    for path in (tmp_path / "other", folder / ".." / "other", folder / "out" / "passwd"):
        with pytest.raises(ValueError, match=path.name):
            offer(session, path, "x")
    assert not session.offers
    for _ in range(100):
        offer(session, folder / "x", "x")
    assert len(session.offers) <= 40


def test_a_tab_that_comes_again_has_what_it_had(ask):
    def enter(**given):
        more = "&".join(f"{name}={value}" for name, value in given.items())
        return ask.websocket_connect(f"/talk?{more}", headers={"host": "127.0.0.1:8642", "origin": HOME})

    with enter() as first:
        name = first.receive_json()["session"]
        with enter(session=name) as doubled:
            assert doubled.receive_json()["session"] != name
        with enter(closed=name) as new:
            assert new.receive_json()["session"] != name
        with enter(session=name, again="") as again:
            assert again.receive_json()["session"] == name
            first.close()
            time.sleep(0.2)
            with enter(closed=name) as new:
                assert new.receive_json()["session"] != name
    with enter(closed=name) as back:
        assert back.receive_json()["session"] == name
