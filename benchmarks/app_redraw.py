"""How soon the browser app shows what a slider does: from the event of the slider to the redrawn plot, by the browser's
own clock, for 30 s of shaking; and how long after its command the app is there."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from statistics import median, quantiles
from typing import Any

from measure import Skipped, heading, require, seconds, table

CASES = ("typical-base", "typical-height")
#: The sliders by the paths of the case.
SLIDERS = {
    "crack.friction": "friction",
    "reservoir.depth": "water level",
    "crack.restitution": "restitution",
    "motion.pga": "peak acceleration",
    "uplift.drain_efficiency": "drains",
}
EVENTS, TABS, EVENTS_OF_EACH = 20, 10, 8
# Between two events, as of a hand that drags, so that each has its own drawing.
_PAUSE_MS = 120.0
_PATIENCE_MS = 60_000
_BROWSERS = ("chromium", "chromium-browser", "google-chrome")
_RIGID = ".card[data-details=rigid] tr"

# Moves a slider there and back around the middle of its way, and returns what was noted.
_DRAG = """async ([id, events, pause]) => {
  const slider = document.getElementById(id);
  const low = Number(slider.min), high = Number(slider.max), step = Number(slider.step);
  const noted = () => performance.getEntriesByName("slider to plot");
  performance.clearMeasures();
  for (let k = 0; k < events; k += 1) {
    const place = 0.5 + 0.2 * Math.sin(k);
    slider.value = String(low + step * Math.round(place * (high - low) / step));
    const before = noted().length;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    const began = performance.now();
    while (noted().length === before && performance.now() - began < 10000) await new Promise((go) => setTimeout(go, 5));
    await new Promise((go) => setTimeout(go, pause));
  }
  return noted().map((each) => each.duration / 1000);
}"""

# When something was seen first [ms since 1970].
_PAINTED = """() => performance.timeOrigin
  + performance.getEntriesByName("first-contentful-paint")[0].startTime"""


@contextmanager
def served() -> Iterator[tuple[str, float]]:
    """Serve the app; yield where, and when its command was given."""
    began = time.perf_counter()
    words = [sys.executable, "-m", "heeltoe", "app", "--no-browser", "--port", "0"]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=environment) as app:
        assert app.stdout is not None
        words = app.stdout.readline().split()
        try:
            require(len(words) > 3 and words[3].startswith("http://"), "the app has not started")
            yield words[3], began
        finally:
            app.send_signal(signal.SIGINT)


@contextmanager
def browser() -> Iterator[Any]:
    """Start the browser."""
    result = next((item for item in map(shutil.which, _BROWSERS) if item), None)
    if result is None:
        raise Skipped("there is no chromium")
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        raise Skipped("there is no playwright") from None
    with sync_playwright() as tools:
        yield tools.chromium.launch(executable_path=result)


def opened(chromium: Any, address: str, case: str) -> Any:
    """Open the app in a browser's context of its own, with 30 s of an example."""
    tab = chromium.new_context(viewport={"width": 1366, "height": 900}).new_page()
    tab.set_default_timeout(_PATIENCE_MS)
    tab.goto(address, wait_until="commit")
    tab.wait_for_selector(_RIGID)
    tab.select_option("#example", case)
    tab.wait_for_selector(".plot .main-svg")
    still(tab)
    if tab.locator("#drains").count():
        tab.check("#drains")
        still(tab)
    return tab


def still(tab: Any) -> None:
    """Wait until all that is shown is of the sliders as they stand."""
    tab.wait_for_timeout(300)
    tab.wait_for_function("() => !document.querySelector('.card.stale:not([hidden])')")


def drag(tab: Any, path: str, events: int, pause_ms: float = _PAUSE_MS) -> list[float]:
    """Move a slider, and return how long each of its events took to be seen [s]."""
    result: list[float] = tab.evaluate(_DRAG, [f"slider-{path.replace('.', '-')}", events, pause_ms])
    require(len(result) >= events // 2, f"{path}: {len(result)} of {events} events were drawn")
    return result


def row(name: str, what: str, found: Sequence[float]) -> list[str]:
    """Return a row of the table."""
    return [
        name,
        what,
        str(len(found)),
        seconds(median(found)),
        seconds(quantiles(found, n=20)[-1]),
        seconds(max(found)),
    ]


def alone(chromium: Any, address: str) -> list[list[str]]:
    """Return what one tab takes, slider by slider."""
    rows = []
    for case in CASES:
        tab = opened(chromium, address, case)
        drag(tab, "crack.friction", 10)
        every: list[float] = []
        for path, name in SLIDERS.items():
            result = drag(tab, path, EVENTS)
            every += result
            rows.append(row(case, name, result))
            still(tab)
        rows.append(row(case, "all", every))
        tab.context.close()
    return rows


def together(chromium: Any, address: str) -> list[str]:
    """Return what ten tabs take whose sliders move at once."""
    tabs = [opened(chromium, address, CASES[0]) for _ in range(TABS)]
    start = f"([id, events, pause]) => {{ window.dragged = ({_DRAG})([id, events, pause]); }}"
    for tab in tabs:
        tab.evaluate(start, ["slider-crack-friction", EVENTS_OF_EACH, 4 * _PAUSE_MS])
    result = [item for tab in tabs for item in tab.evaluate("() => window.dragged")]
    require(len(result) >= TABS * EVENTS_OF_EACH // 2, f"{len(result)} events of {TABS} tabs were drawn")
    for tab in tabs:
        tab.context.close()
    return row(CASES[0], f"friction, {TABS} tabs at once", result)


def first(chromium: Any) -> list[list[str]]:
    """Return how long after the command the page is painted, and the first answer drawn."""
    painted, answered = [], []
    for _ in range(3):
        with served() as (address, began), ExitStack() as after:
            tab = chromium.new_page()
            after.callback(tab.close)
            tab.set_default_timeout(_PATIENCE_MS)
            asked = time.time()
            late = time.perf_counter() - began
            tab.goto(address, wait_until="commit")
            tab.wait_for_selector(".plot .main-svg")
            answered.append(time.perf_counter() - began)
            # The browser's own clock, whose zero is when the page was asked for.
            at = tab.evaluate(
                "() => performance.timeOrigin + performance.getEntriesByName('first-contentful-paint')[0].startTime"
            )
            painted.append(late + at / 1000 - asked)
    return [
        [name, seconds(median(result)), seconds(max(result))]
        for name, result in (("first paint", painted), ("the first answer is drawn", answered))
    ]


def report() -> str:
    """Measure and return Markdown."""
    with browser() as chromium:
        beginning = first(chromium)
        with served() as (address, _):
            rows = [*alone(chromium, address), together(chromium, address)]
    return "\n\n".join(
        [
            heading("The app in a browser", ["heeltoe", "starlette", "plotly"]),
            f"From the event of a slider to the redrawn plot, by the browser's clock, {EVENTS} events of each slider; "
            f"the whole record. {TABS} tabs are in as many contexts of one browser.",
            table(["case", "slider", "events", "median", "95th percentile", "longest"], rows),
            "After the command `heeltoe app`, three times; the browser runs already.",
            table(["until", "median", "longest"], beginning),
        ]
    )


if __name__ == "__main__":
    print(report())
