"""What anchors bear by the law of the kernels, beside what the kernels say."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import rigid
from heeltoe.case.at_crack import AnchorAtCrack
from heeltoe.mechanics.anchors import anchor_force
from heeltoe.views.figures.anchors import anchor_figure
from heeltoe.views.figures.histories import bearing_figure, edge_stresses
from shared.dams import example
from shared.drawn import check


def test_an_anchor_pulls_along_its_axis_never_pushes_and_is_a_dowel():
    anchor = AnchorAtCrack(3.0, 0.0, 1e6, 1e8, 0.0, None)
    along, across = np.array([0.0, 0.5, 0.0]), np.array([0.0, 0.01, -0.02])
    # Upright: slip does not stretch it, opening does, and it goes slack.
    assert anchor_force(anchor, along, across) == pytest.approx([1e6, 2e6, 0.0])
    dowel = AnchorAtCrack(3.0, np.pi / 2.0, 3e6, 0.0, 4e7, None)
    assert anchor_force(dowel, np.array([0.1]), np.array([0.0])) == pytest.approx([5e6])


def test_the_figure_of_the_anchors_ends_where_the_kernel_says():
    case = example("anchored")
    response = rigid(case)
    figure = anchor_figure(case, response)
    assert response.anchors is not None
    (axes,) = figure.axes
    curves = {line.get_label(): line.get_ydata() for line in axes.lines}
    for number, anchor in enumerate(response.anchors, 1):
        assert max(curves[f"anchor {number}"]) * 1e6 == pytest.approx(anchor.peak_force_n, rel=2e-3)
    assert "capacity of anchor 1" in curves
    check(figure, "anchors")


def test_heel_and_toe_bear_before_the_earthquake_what_static_checks_say():
    response = rigid(example("typical-base", 'motion={points=[["0 s","0 g"],["1 s","0.05 g"]]}'))
    _, heel, toe = edge_stresses(response)
    # N/B and the resultant of the static checks: 65.76 MN/m over 80 m, 51.18 m from the heel.
    static = response.cracks[0].static
    normal, place = static.normal_force_n, static.resultant_from_heel_m
    mean, width = normal / response.crack_width_m, response.crack_width_m
    lever = 6.0 * (place - width / 2.0) / width
    assert heel[0] == pytest.approx(mean * (1.0 - lever), rel=1e-6)
    assert toe[0] == pytest.approx(mean * (1.0 + lever), rel=1e-6)
    check(bearing_figure(response), "bearing")
