"""The command `heeltoe app`: what it refuses, and that no one else pays for it."""

from __future__ import annotations

import os
import re
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path
from urllib.parse import unquote, urlsplit

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


def test_the_token_is_printed_and_is_no_word_of_the_browser(tmp_path):
    """All users of a machine see the words with which a program is started: the browser opens a page that leads on."""
    seen, browser = tmp_path / "seen", tmp_path / "browser"
    browser.write_text(f'#!/bin/sh\necho "$@" > {seen}.part && mv {seen}.part {seen}\n')
    browser.chmod(0o755)
    words = [sys.executable, "-m", "heeltoe", "app", "--port", "0"]
    environment = {**os.environ, "BROWSER": f"{browser} %s"}
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=environment) as app:
        try:
            address = re.fullmatch(
                r"heeltoe app at (http://127\.0\.0\.1:\d+/\?token=(\S{32}))  .*\n", app.stdout.readline()
            )
            assert address
            end = time.monotonic() + 60.0
            while not seen.exists() and time.monotonic() < end:
                time.sleep(0.05)
            page = Path(unquote(urlsplit(seen.read_text().strip()).path))
            assert address[2] not in seen.read_text()
            assert f'url={address[1]}"' in page.read_text()
            assert page.stat().st_mode & 0o077 == 0
            assert page.parent.stat().st_mode & 0o077 == 0
            app.send_signal(signal.SIGINT)
            assert app.wait(20) == 0
            assert not page.parent.exists()
        finally:
            app.kill()
