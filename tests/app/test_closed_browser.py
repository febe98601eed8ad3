"""A browser that is killed while the elastic dam runs: the server goes on for others, and nothing is left of it in the
end."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import psutil
import pytest

pytest.importorskip("playwright")

SLIP = ".card[data-details=rigid] tr[data-key=residual_slip_m] td"


def open_answer(browser, home):
    page = browser.new_page()
    page.set_default_timeout(120_000)
    page.goto(home)
    page.click("#tab-answer")
    page.wait_for_selector(SLIP)
    return page


def test_a_browser_killed_in_the_middle_of_a_run(launch):
    words = [sys.executable, "-m", "heeltoe", "app", "--no-browser", "--port", "0"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as app:
        try:
            home = app.stdout.readline().split()[3]
            browser = launch()
            page = open_answer(browser, home)
            page.click("text=Run the elastic dam")
            page.wait_for_selector("#page-answer button:visible:text-is('Cancel')")
            kinds = browser.new_browser_cdp_session().send("SystemInfo.getProcessInfo")["processInfo"]
            (process,) = [kind["id"] for kind in kinds if kind["type"] == "browser"]
            os.kill(process, signal.SIGKILL)
            other = launch()
            assert open_answer(other, home).inner_text(SLIP)
            other.close()
            begun = psutil.Process(app.pid).children(recursive=True)
            app.send_signal(signal.SIGINT)
            assert app.wait(30) == 0
            _, alive = psutil.wait_procs(begun, timeout=5.0)
            assert not alive
        finally:
            app.kill()
