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

LAPTOP = {"width": 1366, "height": 900}
# Where a page is looked at: name, width, colours.
_PLACES = [("dark", 1366, "dark"), ("telephone", 390, "light"), ("night", 390, "dark"), ("projector", 1920, "light")]
# Screenshots of every page, to be looked at.
PICTURES = ROOT / "out" / "app"
# What Debian calls it, and others.
_BROWSERS = ("chromium", "chromium-browser", "google-chrome")
# Where the tests in a browser must not be left out, what they need is missed at once.
_REQUIRED = os.environ.get("HEELTOE_BROWSER") == "required"
if _REQUIRED:
    import axe_playwright_python  # noqa: F401
    import playwright  # noqa: F401


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Leave eight paths through the app to the default part; what else needs a browser belongs to the slow part."""
    for item in items:
        if "launch" in getattr(item, "fixturenames", ()) and not item.get_closest_marker("path"):
            item.add_marker(pytest.mark.slow)


@pytest.fixture(scope="session")
def address():
    """Serve the app, and return where, with its token."""
    words = [sys.executable, "-m", "heeltoe", "app", "--no-browser", "--port", "0"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env={**os.environ, "PYTHONUNBUFFERED": "1"}) as app:
        message = app.stdout.readline()
        assert "heeltoe app at http://" in message
        yield message.split()[3]
        app.send_signal(signal.SIGINT)
        try:
            assert app.wait(20) == 0
        finally:
            # One that is started where Ctrl-C is ignored would be waited for without an end.
            app.kill()


# Not longer: what drives the browser has a loop of its own, beside which other tests cannot have theirs.
@pytest.fixture(scope="module")
def launch():
    """Return what starts the browser of this machine."""
    result = next((item for item in map(shutil.which, _BROWSERS) if item), None)
    if result is None:
        leave = pytest.fail if _REQUIRED else pytest.skip
        leave("no browser: install chromium (make browser) to run these tests")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as tools:
        yield lambda: tools.chromium.launch(executable_path=result)


@pytest.fixture(scope="module")
def chromium(launch):
    """Start the browser for all tests of a module."""
    browser = launch()
    yield browser
    browser.close()


@pytest.fixture(scope="module")
def context(chromium):
    """Keep what a browser keeps from one page to the next: the scripts, as it has compiled them, too."""
    made = chromium.new_context(viewport=LAPTOP, has_touch=True)
    # Machines are busy: what must come may come late.
    made.set_default_timeout(120_000)
    yield made
    made.close()


@pytest.fixture(scope="module")
def tab(context, address):
    """Open a tab for all tests of a module: its scripts are compiled once. Return it, and what it complains of."""
    opened, complaints = context.new_page(), []
    opened.on("console", lambda said: complaints.append(said.text) if said.type == "error" else None)
    opened.on("pageerror", lambda error: complaints.append(str(error)))
    opened.on("request", lambda asked: None if _is_own(asked.url, address) else complaints.append(asked.url))
    return opened, complaints


def _is_own(url: str, address: str) -> bool:
    return url.startswith((address.partition("?")[0], "data:", "blob:"))


@pytest.fixture
def page(tab, address):
    """Open the app in a tab that must not complain, asks no one else for anything, and knows of no case before it."""
    opened, complaints = tab
    opened.set_viewport_size(LAPTOP)
    opened.emulate_media(color_scheme="light")
    opened.goto(address)
    yield opened
    opened.evaluate("() => { localStorage.clear(); sessionStorage.clear(); }")
    message = complaints[:]
    complaints.clear()
    assert not message


@pytest.fixture
def places(page, picture):
    """Return what walks through the screens that a page is looked at on, each loaded anew, nothing reaching out of it
    sideways, and pictured in the end."""

    def walk(name: str):
        for place, width, scheme in _PLACES:
            page.set_viewport_size({"width": width, "height": 900})
            page.emulate_media(color_scheme=scheme)
            page.reload()
            yield page
            assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), place
            picture(page, f"{name}-{place}")

    return walk


@pytest.fixture
def heard_well():
    """Return what asks axe-core what would hold up somebody who does not see the page."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")

    def grave(tab) -> list[tuple[str, str]]:
        violations = axe.Axe().run(tab).response["violations"]
        return [
            (violation["id"], violation["nodes"][0]["html"])
            for violation in violations
            if violation["impact"] in ("serious", "critical")
        ]

    return grave


@pytest.fixture
def picture():
    """Return what keeps a screenshot of the whole page."""

    def keep(tab, name: str) -> Path:
        PICTURES.mkdir(parents=True, exist_ok=True)
        path = PICTURES / f"{name}.png"
        tab.screenshot(path=path, full_page=True)
        return path

    return keep
