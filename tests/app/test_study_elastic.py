"""A study of elastic dams in the app: cancelled, it leaves no process behind, and goes on where it stopped."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time

import pytest

pytest.importorskip("starlette")

from shared.app import HEADERS, Visitor, client_in

psutil = pytest.importorskip("psutil")

COARSE = {"flexible.elements_across": "2", "flexible.evidence": "none", "motion.sign": "recorded"}
FRICTION = {"path": "crack.friction", "kind": "list", "values": ", ".join(f"{0.6 + 0.02 * k:.2f}" for k in range(30))}
STUDY = {"models": ["flexible"], "method": "grid", "source": "case", "vary": [FRICTION]}


def processes() -> set[int]:
    """Return all that this process has begun, and what those have."""
    return {item.pid for item in psutil.Process().children(recursive=True)}


@pytest.mark.slow
def test_a_study_of_elastic_dams_is_cancelled_and_gone_on_with(tmp_path, capfd):
    with (
        client_in(tmp_path) as client,
        client.websocket_connect("/talk", headers=HEADERS) as tab,
    ):

        def heard(fits):
            while not fits(message := tab.receive_json()):
                assert message["of"] not in ("bad request", "refused", "study refused"), message
            return message

        tab.send_json({"do": "edit case", "changes": COARSE})
        tab.send_json({"do": "study look", "study": STUDY})
        assert heard(lambda message: message["of"] == "study look")["outlook"].startswith("30 runs")
        before = processes()
        tab.send_json({"do": "study run", "study": STUDY})
        running = heard(lambda message: message["of"] == "job" and "of 30 runs" in message["status"])
        done = int(running["status"].split()[0])
        assert 0 < done < 30
        assert len(processes() - before) > 2  # the workers of the study among them
        tab.send_json({"do": "cancel", "number": running["number"]})
        heard(lambda message: message["of"] == "job" and message["state"] == "cancelled")
        deadline = time.monotonic() + 120.0
        while processes() - before and time.monotonic() < deadline:
            time.sleep(0.2)
        assert not processes() - before
        # What its workers shared and put aside is given back.
        assert "leaked" not in capfd.readouterr().err
        assert not list(tmp_path.rglob(".workers-*"))

        tab.send_json({"do": "study form"})
        number = heard(lambda message: message["of"] == "study form")["studies"][0]["number"]
        tab.send_json({"do": "study answers", "number": number})
        assert not heard(lambda message: message["of"] == "study answers")["complete"]
        tab.send_json({"do": "study run", "number": number})
        first = heard(lambda message: message["of"] == "job" and "of 30 runs" in message["status"])
        assert int(first["status"].split()[0]) > done
        ended = heard(lambda message: message["of"] == "job" and message["state"] not in ("running", "cancelled"))
        assert ended["state"] == "done", ended["status"]
        tab.send_json({"do": "study answers", "number": number})
        assert heard(lambda message: message["of"] == "study answers")["complete"]


@pytest.mark.slow
def test_ctrl_c_ends_a_study_and_all_its_processes():
    words = [sys.executable, "-m", "heeltoe", "app", "--no-browser", "--port", "0"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as app:
        try:
            with Visitor(app.stdout.readline().split()[3]).tab() as tab:

                def hear(fits):
                    while not fits(message := json.loads(tab.recv(timeout=60))):
                        assert message["of"] not in ("bad request", "refused", "study refused"), message

                tab.send(json.dumps({"do": "flexible", "values": {}}))
                tab.send(json.dumps({"do": "edit case", "changes": COARSE}))
                tab.send(json.dumps({"do": "study run", "study": STUDY}))
                hear(lambda message: message["of"] == "job" and "of 30 runs" in message["status"])
                begun = psutil.Process(app.pid).children(recursive=True)
                assert len(begun) > 4
                began = time.monotonic()
                app.send_signal(signal.SIGINT)
                assert app.wait(30) == 0
            assert time.monotonic() - began < 15.0
            _, alive = psutil.wait_procs(begun, timeout=5.0)
            assert not alive
        finally:
            app.kill()
