"""An app that is killed leaves no process that computes, and its folder to the next one, which removes it."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path

import pytest

pytest.importorskip("websockets")
pytest.importorskip("psutil")

import psutil

from heeltoe.app.folder import folder_of_app
from shared.app import Visitor

FINE = {"flexible.elements_across": "40", "flexible.time_step": "0.1 ms"}
ELASTIC = {"models": ["flexible"], "method": "grid", "source": "case"}
VARIED = {"path": "crack.friction", "kind": "list", "values": ", ".join(f"{0.6 + 0.01 * k:.2f}" for k in range(40))}


@pytest.fixture
def place(tmp_path, monkeypatch):
    """Where apps make their folders."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path


@contextmanager
def served(place: Path):
    words = [sys.executable, "-m", "heeltoe", "app", "--no-browser", "--port", "0"]
    # A killed process leaves nothing that would count what it shares.
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env={**os.environ, "TMPDIR": str(place)}
    ) as app:
        try:
            yield app, app.stdout.readline().split()[3]
        finally:
            app.kill()


def heard(tab, fits):
    while not fits(message := json.loads(tab.recv(timeout=120))):
        assert message["of"] not in ("bad request", "refused"), message
    return message


def killed_amid(place: Path, changes, asked, status: str) -> None:
    """Kill an app amid a run, and look for what it leaves."""
    with served(place) as (app, address):
        with Visitor(address).tab() as tab:
            heard(tab, lambda message: message["of"] == "state")
            tab.send(json.dumps({"do": "edit case", "changes": changes}))
            heard(tab, lambda message: message["of"] == "case")
            tab.send(json.dumps(asked))
            heard(tab, lambda message: message["of"] == "job" and status in message["status"])
            begun = psutil.Process(app.pid).children(recursive=True)
            assert begun
            (left,) = place.glob("heeltoe-app-*")
            assert any(path.name == "case.toml" for path in left.rglob("*"))
            app.send_signal(signal.SIGKILL)
            app.wait(10)
        _, alive = psutil.wait_procs(begun, timeout=10.0)
        assert not alive
    with served(place) as (app, _):
        assert not left.exists()
        (own,) = place.glob("heeltoe-app-*")
        app.send_signal(signal.SIGINT)
        assert app.wait(20) == 0
    assert not own.exists()


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs SIGKILL")
def test_an_app_that_is_killed_amid_an_export(place):
    wanted = {"do": "make", "model": "flexible", "report": True, "csv": False, "animation": True}
    killed_amid(place, FINE, wanted, "running")


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs SIGKILL")
def test_an_app_that_is_killed_amid_a_study_of_elastic_dams(place):
    coarse = {"flexible.elements_across": "2", "flexible.evidence": "none", "motion.sign": "recorded"}
    killed_amid(place, coarse, {"do": "study run", "study": {**ELASTIC, "vary": [VARIED]}}, " of 40 runs")


def test_folders_of_others_stay(place):
    """A folder without a sign of an app, a link with the name of one, and one of an app that runs."""
    other = place / "heeltoe-app-other"
    other.mkdir()
    target = place / "target"
    target.mkdir()
    (target / "held").touch()
    (place / "heeltoe-app-link").symlink_to(target)
    (place / "heeltoe-app-file").touch()
    with folder_of_app() as one, folder_of_app() as two:
        assert one != two
        assert one.stat().st_mode & 0o077 == 0
        assert {other, target, target / "held", one, two} <= set(place.rglob("*"))
        assert (one / "held").exists()
    assert sorted(path.name for path in place.iterdir()) == [
        "heeltoe-app-file",
        "heeltoe-app-link",
        other.name,
        "target",
    ]
