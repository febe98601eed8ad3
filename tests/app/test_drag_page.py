"""While a slider is dragged the plot is drawn quickly; what stands in the end is what the package answers."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("playwright")

from heeltoe.app.open_case import example_path
from heeltoe.case.read import read_case
from heeltoe.models.run import earthquake, live

_DRAG = """async () => {
  const slider = document.getElementById("slider-motion-pga");
  const plot = document.querySelector("#page-answer .plot");
  let quick = 0;
  for (let k = 0; k <= 20; k += 1) {
    slider.value = String(0.6 - 0.01 * k);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    await new Promise((go) => setTimeout(go, 60));
    quick += Number(plot.classList.contains("quick"));
  }
  return quick;
}"""
_PLOTTED = """() => document.querySelector("#page-answer .plot").data
  .filter(({ name, yaxis }) => name === "rigid" && yaxis === "y2").map(({ x, y }) => [[...x], [...y]])[0]"""


def test_after_a_drag_the_plot_is_the_answer(page, tmp_path):
    page.wait_for_selector(".plot .main-svg")
    page.wait_for_timeout(500)
    assert page.evaluate(_DRAG) > 0
    page.wait_for_function(
        """() => !document.querySelector("#page-answer .plot.quick, .card.stale:not([hidden])")
          && document.getElementById("slider-motion-pga").value === "0.4" """
    )
    page.wait_for_timeout(500)
    time, slip = map(np.array, page.evaluate(_PLOTTED))
    case = read_case(example_path("typical-base")).with_({"motion.pga": "0.4 g"})
    histories = live(case, "rigid", earthquake(case)).histories
    expected = 1000.0 * np.interp(time, histories["time_s"], histories["slip_m"])
    assert abs(slip[-1]) > 1.0
    np.testing.assert_allclose(slip, expected, atol=1e-3 * np.abs(expected).max())
    # No peak is lost between the moments that are drawn.
    assert np.abs(slip).max() == pytest.approx(1000.0 * np.abs(histories["slip_m"]).max(), rel=1e-6)


_SLIDERS = """() => [...document.querySelectorAll("input[type=range][id^=slider-]")]
  .filter((each) => each.offsetParent).map(({ id }) => id)"""
_PULL = """async ([id, way]) => {
  const slider = document.getElementById(id);
  const [low, high] = [Number(slider.min), Number(slider.max)];
  const begin = Number(slider.value);
  const end = way > 0 ? begin + 0.4 * (high - begin) : begin - 0.4 * (begin - low);
  for (let k = 1; k <= 8; k += 1) {
    slider.value = String(begin + (end - begin) * k / 8);
    slider.dispatchEvent(new Event("input", { bubbles: true }));
    await new Promise((go) => setTimeout(go, 50));
  }
}"""
_AT_REST = """() => !document.querySelector("#page-answer .plot.quick, .card.stale:not([hidden])")"""
_OUTSIDE = """() => {
  const plot = document.querySelector("#page-answer .plot");
  const outside = [], longest = new Map();
  for (const { name, y, yaxis } of plot.data) {
    const axis = plot._fullLayout[(yaxis || "y").replace("y", "yaxis")];
    if (axis.type === "category") continue;
    const [low, high] = axis.range;
    const values = [...y].filter((value) => value !== null);
    const [least, most] = [values.reduce((a, b) => Math.min(a, b), 0), values.reduce((a, b) => Math.max(a, b), 0)];
    longest.set(yaxis, Math.max(longest.get(yaxis) || 0, most - least));
    if (least < low || most > high) outside.push([name, yaxis, least, most, low, high]);
  }
  // Nor may an axis be so long that all of its curves, of the block and of the elastic dam, are lines along zero.
  const [low, high] = plot._fullLayout.yaxis2.range, span = longest.get("y2");
  if (span > 0 && high - low > 20 * span) outside.push(["flat", span, low, high]);
  return outside;
}"""


@pytest.mark.slow
def test_every_slider_up_and_down_leaves_the_curves_inside_the_axes(page):
    page.wait_for_selector(".plot .main-svg")
    page.wait_for_timeout(500)
    sliders = page.evaluate(_SLIDERS)
    assert len(sliders) > 3
    for name in sliders:
        for way in (-1, 1, 1, -1):
            page.evaluate(_PULL, [name, way])
            page.wait_for_timeout(1000)
            page.wait_for_function(_AT_REST)
            assert page.evaluate(_OUTSIDE) == [], (name, way)


def test_an_upward_drag_keeps_the_slip_inside_the_axes(page):
    page.wait_for_selector(".plot .main-svg")
    page.wait_for_timeout(500)
    for way in (-1, -1, 1):
        page.evaluate(_PULL, ["slider-crack-friction", way])
        page.wait_for_timeout(1000)
        page.wait_for_function(_AT_REST)
        assert page.evaluate(_OUTSIDE) == [], way
