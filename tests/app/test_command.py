"""The command `heeltoe app`: what it refuses, and that nobody else pays for it."""

from __future__ import annotations

import signal
import socket
import subprocess
import sys

import pytest

from heeltoe.app import serve as serving
from shared.command import command
from shared.dams import BLOCK


def test_a_public_address_is_asked_for():
    process = command("app", "--host", "0.0.0.0", "--no-browser")
    assert process.returncode == 2
    assert "--public" in process.stderr


def test_an_address_in_use_is_told():
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        process = command("app", "--port", str(taken.getsockname()[1]), "--no-browser")
    assert process.returncode == 2
    assert "--port: the app cannot listen at 127.0.0.1:" in process.stderr


def test_a_missing_package_is_told(monkeypatch):
    monkeypatch.setattr(serving, "find_spec", lambda name: None)
    process = command("app", "--no-browser")
    assert process.returncode == 2
    assert 'extra "app"' in process.stderr


@pytest.mark.parametrize("arguments", [("run", str(BLOCK)), ("--help",)])
def test_other_commands_load_nothing_of_it(arguments):
    program = (
        "import sys; from heeltoe.cli.main import main\n"
        f"sys.argv = ['heeltoe', *{arguments!r}]\n"
        "try: main()\n"
        "except SystemExit: pass\n"
        "names = ('heeltoe.app', 'starlette', 'uvicorn', 'websockets', 'plotly', 'anyio')\n"
        "print([name for name in sys.modules if name.split('.')[0] in names or name.startswith('heeltoe.app')])"
    )
    process = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=True)
    assert process.stdout.splitlines()[-1] == "[]"


def test_ctrl_c_ends_it_at_once_even_where_it_was_ignored():
    words = [sys.executable, "-m", "heeltoe", "app", "--no-browser", "--port", "0"]
    ignored = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        app = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    finally:
        signal.signal(signal.SIGINT, ignored)
    app.stdout.readline()
    app.send_signal(signal.SIGINT)
    try:
        message = app.communicate(timeout=60)
    finally:
        app.kill()
    assert app.returncode == 0
    assert message == ("", "")
