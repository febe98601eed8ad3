"""Exports: the files are what the shown words make, and no one else gets at them."""

from __future__ import annotations

import base64
import io
import json
import math
import os
import shlex
import subprocess
import sys
import time
import zipfile

import numpy as np
import pytest

pytest.importorskip("starlette")

from heeltoe.app.sessions import Session
from heeltoe.app.transfers import offer
from heeltoe.result.contract import HEADLINES
from heeltoe.units.write import angle, length
from shared.app import HEADERS, HOME, client_in
from shared.command import command


@pytest.fixture(scope="module")
def ask(tmp_path_factory):
    with client_in(tmp_path_factory.mktemp("app")) as client:
        yield client


class Tab:
    """A tab that asks and waits."""

    def __init__(self, socket):
        self.socket = socket
        self.session = self.hear("hello")["session"]
        self.hear("state")

    def hear(self, *kinds):
        """Return the next message of one of these kinds; a job's when it has ended."""
        while True:
            message = self.socket.receive_json()
            if message["of"] in kinds and message.get("state") != "running":
                return message

    def ask(self, what, *kinds, **fields):
        self.socket.send_json({"do": what, **fields})
        return self.hear(*kinds, "bad request", "refused")


@pytest.fixture
def tab(ask):
    with ask.websocket_connect("/talk", headers=HEADERS) as socket:
        yield Tab(socket)


def files_made(tab, wanted):
    """Have the files made, and return their names."""
    made = tab.ask("make", "job", **wanted)
    assert made["state"] == "done", made["status"]
    return {item["name"] for item in made["result"]["files"]}


def case_file(ask, tab, folder):
    """Fetch the case, with its record where that was sent, into a folder."""
    result = ask.get(tab.ask("case file", "download")["address"])
    if 'filename="case.zip"' in result.headers["content-disposition"]:
        with zipfile.ZipFile(io.BytesIO(result.content)) as archive:
            archive.extractall(folder)
        return folder / "case"
    assert result.headers["content-disposition"] == 'attachment; filename="case.toml"'
    (folder / "case.toml").write_bytes(result.content)
    return folder


def same_elsewhere(ask, tab, folder, wanted, ways=("typed", "python")):
    """Hold the numbers that the shown words make against those of the page."""
    ours = ask.get(tab.ask("fetch", "download", name="result.json")["address"]).json()
    shown = tab.ask("export", "export", **wanted)
    assert shown["same"]
    for place, words in (
        ("typed", [sys.executable, "-m", *shlex.split(shown["command"])]),
        ("python", [sys.executable, "-c", shown["program"]]),
    ):
        if place not in ways:
            continue
        (folder / place).mkdir()
        here = case_file(ask, tab, folder / place)
        done = subprocess.run(words, cwd=here, capture_output=True, text=True, env=os.environ)
        assert done.returncode == 0, done.stderr
        assert json.loads((here / "result" / "result.json").read_text()) == ours


@pytest.mark.slow
def test_a_record_that_was_sent_goes_with_the_words(ask, tab, tmp_path):
    record = "".join(f"{0.02 * k:.2f} {0.3 * math.sin(0.3 * k):.5f}\n" for k in range(150))
    headers = {"origin": HOME, "x-session": tab.session}
    file = ask.post("/upload", content=record.encode(), headers=headers).json()["name"]
    assert "error" not in tab.ask("record", "record", file=file, called="mine.txt")
    way = {"source": "record:mine.txt", "unit": "g"}
    assert "error" not in tab.ask("use motion", "motion used", form={"horizontal": way, "vertical": {"source": ""}})
    wanted = {"model": "rigid", "csv": True}
    assert {"result.json", "histories.csv", "response.png", "response.svg"} <= files_made(tab, wanted)
    # By Python they are in the slow test below.
    same_elsewhere(ask, tab, tmp_path, wanted, ("typed",))
    tab.ask("rigid", "rigid", values={"crack.friction": 1.2})
    assert not tab.ask("export", "export", **wanted)["same"]


@pytest.mark.slow
def test_the_shown_words_make_the_same_report_and_numbers(ask, tab, tmp_path):
    assert tab.ask("rigid", "rigid", values={"crack.friction": 1.1})["ok"]
    wanted = {"model": "rigid", "report": True, "csv": True}
    assert {"result.json", "report.pdf", "report.html", "histories.csv"} <= files_made(tab, wanted)
    same_elsewhere(ask, tab, tmp_path, wanted)


@pytest.mark.slow
def test_the_shown_words_make_the_same_elastic_dam(ask, tab, tmp_path):
    brief = {"motion.duration": "3 s", "analysis.silence": "0 s", "flexible.elements_across": "2"}
    answer = tab.ask("edit case", "case", changes={**brief, "flexible.evidence": "none"})
    assert not answer["errors"]
    wanted = {"model": "auto"}
    assert {"result.json", "rigid/result.json"} <= files_made(tab, wanted)
    same_elsewhere(ask, tab, tmp_path, wanted)


def test_app_and_shell_have_the_same_numbers(ask, tab, tmp_path):
    """What the page of the answer shows of a block, of an elastic dam and of the static checks with its slip is what
    the command line computes from the case file, with the sliders where they are."""
    brief = {"motion.duration": "4 s", "flexible.elements_across": "2", "flexible.evidence": "none"}
    brief |= {"statics.criteria": "USBR", "limits.residual_slip": "1 mm"}
    assert not tab.ask("edit case", "case", changes=brief)["errors"]
    # The page shows what the block does before the elastic dam.
    shown = {model: tab.ask(model, model, values={"crack.friction": 0.9}) for model in ("rigid", "elastic")}
    checks = tab.ask("statics", "statics", values={"crack.friction": 0.9}, spectrum="")
    case = case_file(ask, tab, tmp_path) / "case.toml"

    def shell(name, model):
        reply = command(name, case, "--model", model, "--json", "-")
        assert reply.returncode == 0, reply.stderr
        return json.loads(reply.stdout)

    for name, model in (("rigid", "rigid"), ("elastic", "flexible")):
        page, result = shown[name], shell("run", model)
        assert result["residual_slip_m"] > 0.01
        numbers = {row["key"]: row["text"] for row in page["numbers"]}
        for headline in HEADLINES:
            value = headline.way * result[headline.key]
            text = angle(value) if headline.kind == "rotation" else length(value)
            assert numbers[headline.key] == (text if abs(value) >= headline.least else "0")
        (limit,) = result["limits"]
        assert page["headline"]["state"] == ("met" if limit["met"] else "failed")
        assert page["headline"]["value"] == length(limit["value"])
        assert page["verdict"] in result["verdict"] or page["verdict"].split(".")[0] in result["verdict"]
        slip = np.frombuffer(base64.b64decode(page["curves"]["slip"]["values"]["data"]), dtype="<f4")
        assert slip[-1] == np.float32(1e3 * result["residual_slip_m"])
        if model == "flexible":
            assert page["left"]["slips_m"] == {"0": result["residual_slip_m"]}
    expected = shell("statics", "flexible")
    rows = [(*row["cells"][:3], row["met"]) for row in checks["checks"]]
    assert len(rows) == len(expected["checks"]) > 3
    for (of, name, text, met), check in zip(rows, expected["checks"], strict=True):
        assert (of, name, met) == (check["load_case"], check["name"], check["met"])
        assert text == "-" if check["value"] is None else float(text.split()[0]) == round(check["value"], 2)
    missed = sum(not check["met"] for check in expected["checks"])
    assert checks["verdict"].startswith(f"{missed} of {len(rows)} checks fail")


def test_a_file_is_served_once_as_a_file_and_to_its_tab_alone(ask, tab):
    assert not tab.ask("edit case", "case", changes={"motion.duration": "2 s", "analysis.silence": "0 s"})["errors"]
    made = tab.ask("make", "job", model="rigid")
    assert made["state"] == "done", made["status"]
    link = tab.ask("fetch", "download", name="")["address"]
    assert ask.head(link).status_code == 404
    answer = ask.get(link)
    assert answer.headers["content-disposition"].startswith("attachment")
    assert answer.headers["x-content-type-options"] == "nosniff"
    assert "heeltoe.zip" in answer.headers["content-disposition"]
    assert zipfile.ZipFile(io.BytesIO(answer.content)).testzip() is None
    assert ask.get(link).status_code == 404
    for name in ("../case.toml", "/etc/passwd", "..", ".heeltoe-files", "result.json/../../case.toml"):
        assert tab.ask("fetch", "download", name=name)["of"] == "bad request"
    for path in ("/download/", "/download/x", "/download/../server.py", "/download/%2e%2e%2fcase.toml"):
        assert ask.get(path).status_code == 404
    with ask.websocket_connect("/talk", headers=HEADERS) as socket:
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


@pytest.mark.slow
def test_a_tab_that_comes_again_has_what_it_had(ask):
    def enter(**given):
        more = "&".join(f"{name}={value}" for name, value in given.items())
        return ask.websocket_connect(f"/talk?{more}", headers=HEADERS)

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
