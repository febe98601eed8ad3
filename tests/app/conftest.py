"""The app as its users meet it: served by its command, shown by a browser."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from shared.dams import ROOT

# Screenshots of every page, to be looked at.
PICTURES = ROOT / "out" / "app"
# What Debian calls it, and others.
_BROWSERS = ("chromium", "chromium-browser", "google-chrome")
# Where the tests in a browser must not be left out, what they need is missed at once.
_REQUIRED = os.environ.get("HEELTOE_BROWSER") == "required"
if _REQUIRED:
    import axe_playwright_python  # noqa: F401
    import playwright  # noqa: F401


@pytest.fixture(scope="session")
def address():
    """Serve the app, and return where."""
    words = [sys.executable, "-m", "heeltoe", "app", "--no-browser", "--port", "0"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONUNBUFFERED": "1"}) as app:
        said = app.stdout.readline()
        assert "heeltoe app at http://" in said
        yield said.split()[3]
        app.send_signal(signal.SIGINT)
        try:
            assert app.wait(20) == 0
        finally:
            # One that is started where Ctrl-C is ignored would be waited for without an end.
            app.kill()


# Not longer: what drives the browser has a loop of its own, beside which other tests cannot have theirs.
@pytest.fixture(scope="module")
def chromium():
    """Start the browser of this machine."""
    found = next((each for each in map(shutil.which, _BROWSERS) if each), None)
    if found is None:
        leave = pytest.fail if _REQUIRED else pytest.skip
        leave("no browser: install chromium (make browser) to run these tests")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as tools:
        browser = tools.chromium.launch(executable_path=found)
        yield browser
        browser.close()


@pytest.fixture
def page(chromium, address):
    """Open the app in a tab that must not complain, and asks nobody else for anything."""
    context = chromium.new_context(viewport={"width": 1366, "height": 900})
    # Machines are busy: what must come may come late.
    context.set_default_timeout(120_000)
    tab = context.new_page()
    said, foreign = [], []
    tab.on("console", lambda message: said.append(message.text) if message.type == "error" else None)
    tab.on("pageerror", lambda error: said.append(str(error)))
    tab.on("request", lambda asked: None if asked.url.startswith(address) else foreign.append(asked.url))
    tab.goto(address)
    yield tab
    context.close()
    assert not said
    assert not [each for each in foreign if not each.startswith(("data:", "blob:"))]


@pytest.fixture
def picture():
    """Return what keeps a screenshot of the whole page."""

    def keep(tab, name: str) -> Path:
        PICTURES.mkdir(parents=True, exist_ok=True)
        path = PICTURES / f"{name}.png"
        tab.screenshot(path=path, full_page=True)
        return path

    return keep
