"""While a slider is dragged the plot is drawn quickly; what stands in the end is what the package answers."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("playwright")

from heeltoe.app.examples import example_path
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
    found = live(case, "rigid", earthquake(case)).histories
    expected = 1000.0 * np.interp(time, found["time_s"], found["slip_m"])
    assert abs(slip[-1]) > 1.0
    np.testing.assert_allclose(slip, expected, atol=1e-3 * np.abs(expected).max())
    # No peak is lost between the moments that are drawn.
    assert np.abs(slip).max() == pytest.approx(1000.0 * np.abs(found["slip_m"]).max(), rel=1e-6)
