"""Files that a tab sends: limited, under names of our own, read by the readers alone; no other is read."""

from __future__ import annotations

import asyncio
import json
import pickle
import re
import sys
from pathlib import Path

import pytest

pytest.importorskip("starlette")

from starlette.testclient import TestClient

from heeltoe.app import answer as running
from heeltoe.app.desk import Desk
from heeltoe.app.open_case import example_path
from heeltoe.app.sessions import Session
from heeltoe.app.settings import Settings
from heeltoe.app.transfers import upload_path
from heeltoe.app.workers import Workers
from shared.app import HEADERS, HOME, client_in, fill

CASE = '[section]\nheight = "50 ft"\ncrest_width = "5 ft"\nbase_width = "40 ft"\n[crack]\nfriction = 0.9\n'
# Whoever finds this in an answer has read what is not of the tab.
SECRET = "0.7071067811"


class Tab:
    """A tab that sends files and asks."""

    def __init__(self, client: TestClient, socket) -> None:
        self._client = client
        self._socket = socket
        self._serial = 0
        self.session = socket.receive_json()["session"]
        socket.receive_json()

    def send(self, content: bytes, name: str = ""):
        """Send a file."""
        headers = {"origin": HOME, "x-session": self.session}
        return self._client.post(f"/upload?name={name}", content=content, headers=headers)

    def ask(self, what: str, /, **fields):
        """Ask, and return the answer and the texts of all that came before it."""
        self._serial += 1
        self._socket.send_json({"do": what, "serial": self._serial, **fields})
        texts = []
        while True:
            texts.append(self._socket.receive_text())
            answer = json.loads(texts[-1])
            if answer.get("serial") == self._serial:
                return answer, "".join(texts)


@pytest.fixture
def folder(tmp_path):
    """Where the app keeps its files."""
    return tmp_path / "app"


@pytest.fixture
def secret(tmp_path):
    """Lay a record beside the folder of the app."""
    place = tmp_path / "secret"
    place.mkdir()
    path = place / "record.csv"
    path.write_text("".join(f"{0.01 * i:.2f} {(-1) ** (i // 20)}e-1\n" for i in range(400)) + f"4.00 {SECRET}\n")
    return path


def enter(client: TestClient, query: str = ""):
    return client.websocket_connect(f"/talk{query}", headers=HEADERS)


def stored(folder: Path) -> list[Path]:
    """Return all that has been sent, wherever it is."""
    return sorted(path for path in folder.rglob("*") if path.is_file())


def test_all_tabs_together_send_so_much(folder):
    with client_in(folder, largest_upload=10, largest_total=16) as client, enter(client) as one, enter(client) as other:
        first, second = Tab(client, one), Tab(client, other)
        assert first.send(b"12345678").status_code == 200
        assert second.send(b"12345678").status_code == 200
        refused = second.send(b"1")
        assert refused.status_code == 413
        assert "All tabs together" in refused.json()["error"]
        assert first.send(b"1").status_code == 413
        assert [path.stat().st_size for path in stored(folder)] == [8, 8]


def test_what_is_made_takes_the_same_room(folder):
    """The files that a tab has made leave no room for what another one sends or makes, and give it back."""
    with client_in(folder, largest_total=100_000) as client, enter(client) as one, enter(client) as other:
        first, second = Tab(client, one), Tab(client, other)
        made = folder / "made"
        made.write_bytes(bytes(100_000))
        assert "All tabs together" in second.send(b"1").json()["error"]
        wanted = {"model": "rigid", "report": False, "csv": False, "animation": False}
        study = {"models": ["rigid"], "method": "grid", "vary": [], "source": "case"}
        asked = {"make": wanted, "case file": {}, "study look": {"study": study}, "study run": {"study": study}}
        asked["study download"] = {"number": 1, "what": "study"}
        before = stored(folder)
        for what, fields in asked.items():
            answer, _ = first.ask(what, **fields)
            assert answer["of"] == "refused", what
            assert "All tabs together keep up to 0 MB" in answer["text"]
        assert stored(folder) == before
        made.unlink()
        assert second.send(b"1").status_code == 200
        assert first.ask("case file")[0]["of"] == "download"


def test_case_files_that_were_fetched_go(folder):
    with client_in(folder) as client, enter(client) as socket:
        tab = Tab(client, socket)
        links = [tab.ask("case file")[0]["address"] for _ in range(3)]
        assert len(stored(folder)) == 3
        for link in links:
            assert client.get(link).status_code == 200
        tab.ask("case file")
        assert len(stored(folder)) == 1


def test_a_run_that_fills_the_room_is_ended_and_its_files_go(folder, monkeypatch):
    monkeypatch.setattr(running, "_LOOKS_EVERY_S", 0.2)
    folder.mkdir()
    settings = Settings("127.0.0.1", 8642, folder, largest_total=100_000)
    session, workers = Session("x", folder), Workers()
    desk = Desk(session, workers, settings, None)

    async def run():
        number = running.start(desk, "filling", fill, folder / "run", unless_done=folder / "run")["number"]
        await asyncio.wait_for(asyncio.gather(*running._RUNNING), 60)
        return session.jobs[number].payload()

    try:
        payload = asyncio.run(run())
    finally:
        workers.close()
    assert payload["state"] == "refused"
    assert "All tabs together" in payload["status"]
    assert stored(folder) == []


def test_what_is_refused_counts_for_nothing(folder):
    with client_in(folder, largest_upload=10, largest_total=16, most_uploads=2) as client, enter(client) as socket:
        tab = Tab(client, socket)
        for _ in range(5):
            assert tab.send(b"12345678901").status_code == 413
        assert stored(folder) == []
        assert tab.send(b"12345678").status_code == 200
        assert tab.send(b"12345678").status_code == 200


def test_files_of_a_tab_that_was_doubled_take_no_room_of_their_own(folder):
    with client_in(folder) as client, enter(client) as socket:
        tab = Tab(client, socket)
        name = tab.send(CASE.encode()).json()["name"]
        assert tab.ask("open case", file=name, called="a.toml", beside={"r.csv": name})[0]["file"] == ""
        with enter(client, f"?session={tab.session}") as doubled:
            Tab(client, doubled)
            one, other = stored(folder)
            assert one.parent != other.parent
            assert one.samefile(other)


@pytest.mark.parametrize(
    "called",
    ["../../evil.py", "/etc/cron.d/evil", "..\\..\\evil.exe", "%2e%2e%2fevil", "a\x00b", ".bashrc", "<script>", "con"],
)
def test_names_are_our_own(folder, tmp_path, called):
    before = set(tmp_path.rglob("*"))
    with client_in(folder) as client, enter(client) as socket:
        tab = Tab(client, socket)
        name = tab.send(CASE.encode(), "..%2f..%2fevil.py").json()["name"]
        answer, _ = tab.ask("open case", file=name, called=called, beside={called: name})
        assert answer["of"] == "case"
        assert re.fullmatch(r"upload-[0-9a-f]{16}", name)
        made = [path for path in tmp_path.rglob("*") if path not in before and path.is_file()]
        assert [path.name for path in made] == [name]
        assert made[0].parent.parent == folder
        assert not made[0].stat().st_mode & 0o111


class _Runs:
    """Writes a file wherever it is unpickled."""

    def __init__(self, mark: Path) -> None:
        self._mark = str(mark)

    def __reduce__(self):
        return Path.touch, (Path(self._mark),)


def test_nothing_that_is_sent_is_run(folder, tmp_path):
    mark = tmp_path / "ran"
    program = f"import pathlib; pathlib.Path({str(mark)!r}).touch()"
    # What writes the mark does so where it is run at all.
    pickle.loads(pickle.dumps(_Runs(mark)))
    assert mark.exists()
    mark.unlink()
    hostile = [
        pickle.dumps(_Runs(mark)),
        program.encode(),
        f"#!/bin/sh\ntouch {mark}\n".encode(),
        f'title = "{{{{ {program} }}}}"\n{CASE}'.encode(),
        f'title = """__import__("os").system("touch {mark}")"""\n{CASE}'.encode(),
    ]
    with client_in(folder) as client, enter(client) as socket:
        tab = Tab(client, socket)
        for content in hostile:
            name = tab.send(content).json()["name"]
            assert tab.ask("open case", file=name, called="evil.py", beside={"evil.py": name})[0]["of"] == "case"
            changes = {"motion.file": "evil.py", "flexible.mesh_above": "evil.py"}
            assert tab.ask("edit case", changes=changes)[0]["of"] == "case"
            assert tab.ask("rigid", values={})[0]["of"] == "rigid"
    assert not mark.exists()


@pytest.fixture
def opened():
    """Note the names of all files that this process opens."""
    names: list[str] = []
    listening = [True]

    def note(event: str, arguments: tuple[object, ...]) -> None:
        if listening and event == "open":
            names.append(str(arguments[0]))

    sys.addaudithook(note)
    yield names
    listening.clear()


def ways_to(secret: Path) -> list[str]:
    """Return names by which a careless server would find a file."""
    up = f"../../{secret.parent.name}/{secret.name}"
    return [str(secret), up, up.replace("/", "%2f"), up.replace("/", "\\"), f"file://{secret}", f"./{up}", f"~/{up}",
            f"upload-0/../{up}", f"{secret}\x00.csv", f"//{secret}",
            up.replace(".", "%2e").replace("/", "%2F")]  # fmt: skip


@pytest.mark.slow
def test_a_case_names_no_file_that_was_not_sent(folder, secret, opened):
    fields = ("motion.file", "motion.vertical.file", "flexible.mesh_above", "flexible.mesh_below")
    with client_in(folder) as client, enter(client) as socket:
        tab = Tab(client, socket)
        for way in ways_to(secret):
            for field in fields:
                answer, texts = tab.ask("edit case", changes={field: way})
                assert [error["code"] for error in answer["errors"] if error["field"] == field], (field, way)
                texts += tab.ask("rigid", values={})[1] + tab.ask("case")[1]
                assert SECRET not in texts
                tab.ask("step case")
            for asked in ({"file": way, "called": "a"}, {"file": "x", "called": "a", "beside": {"a": way}}):
                assert tab.ask("open case", **asked)[0]["of"] == "bad request"
            for source in ("name", "record", "case", "pulse", "synthetic", "file"):
                form = {"horizontal": {"source": f"{source}:{way}"}, "vertical": {"source": f"{source}:{way}"}}
                form["horizontal"] |= {"unit": "g", "magnitude": way}
                for action in ("motion look", "use motion"):
                    answer, texts = tab.ask(action, form=form)
                    assert SECRET not in texts
                    assert "error" in answer or source == "case", (source, answer)
                    if source in ("name", "record"):
                        assert answer["error"]["problem"].startswith("there is no record")
            assert tab.ask("record", file=way, called="a")[0]["of"] == "bad request"
            study = {"models": ["rigid"], "method": "grid", "vary": [], "source": "records", "records": [way]}
            answer, texts = tab.ask("study look", study=study)
            assert SECRET not in texts
            assert answer["of"] == "bad request" or answer["error"]
            assert tab.ask("open example", name=way)[0]["of"] == "bad request"
    assert not [name for name in opened if Path(name).name == secret.name]


def test_no_address_leads_to_a_file(folder, secret, opened):
    with client_in(folder) as client, enter(client) as socket:
        name = Tab(client, socket).send(CASE.encode()).json()["name"]
        [path] = stored(folder)
        for way in (*ways_to(secret), name, f"{path.parent.name}/{name}", str(path)):
            quoted = way.replace("\x00", "%00")
            for base in ("/page/", "/download/", "/upload/", "/", "/plotly.js/"):
                assert client.get(f"{HOME}{base}{quoted}").status_code in (404, 405), (base, way)
        opened.clear()
        assert client.get("/page/main.js").status_code == 200
        assert any(item.endswith("main.js") for item in opened)  # what is opened is seen


def test_a_link_leads_nowhere(folder, secret):
    with client_in(folder) as client, enter(client) as socket:
        tab = Tab(client, socket)
        name = tab.send(CASE.encode()).json()["name"]
        [path] = stored(folder)
        # No tab can make one; if one is there, it is no one's upload.
        path.with_name("link").symlink_to(secret)
        assert tab.ask("open case", file="link", called="a")[0]["of"] == "bad request"
        assert tab.ask("edit case", changes={"motion.file": "link"})[0]["errors"]
        assert tab.ask("open case", file=name, called="a")[0]["of"] == "case"


def test_another_tab_has_other_files(folder):
    with client_in(folder) as client, enter(client) as one, enter(client) as other:
        first, second = Tab(client, one), Tab(client, other)
        name = first.send(CASE.encode()).json()["name"]
        [path] = stored(folder)
        for way in (name, f"../{path.parent.name}/{name}", str(path)):
            assert second.ask("open case", file=way, called="a")[0]["of"] == "bad request"
            answer, _ = second.ask("edit case", changes={"motion.file": way})
            assert "motion.file" in [error["field"] for error in answer["errors"]]


def test_uploads_and_examples_are_found_by_their_names_alone(tmp_path):
    session = Session("x", tmp_path)
    (tmp_path / "upload-1").write_text("")
    assert upload_path(session, "upload-1") == tmp_path / "upload-1"
    for name in ("", ".", "upload-*", "./upload-1", "../x/upload-1", "upload-1/", str(tmp_path / "upload-1")):
        assert upload_path(session, name) is None
        assert example_path(name) is None
