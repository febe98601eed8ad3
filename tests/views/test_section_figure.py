"""The figure of the section: forces to scale, on their lines, labelled inside the picture."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg

from heeltoe.mechanics.block import build_block
from heeltoe.mechanics.loads import uplift_profile
from heeltoe.views.figures.section import section_figure
from heeltoe.views.figures.section_forces import _ends
from shared.dams import example

EVERYTHING = [
    "tailwater.depth=12m",
    'ice.force="150 kN/m"',
    "silt.depth=25m",
    'anchors=[{distance="8 m", prestress="3 MN/m", inclination="10 deg"},{distance="12 m", prestress="3 MN/m"}]',
]
SHAPES = [
    [],
    ["crack.elevation=20m"],
    ["crack.elevation=20m", "crack.inclination=15deg"],
    ["crack.elevation=40m", "crack.inclination=-12deg"],
    ["crack.elevation=85m"],
    ['uplift={pattern="drained", drain_position=0.1, drain_efficiency=0.67}'],
    ['uplift={pattern="none"}'],
    ["reservoir.depth=1m"],
]
SLOPED = (
    'section={polygon=[["-10 m","-5 m"],["70 m","-5 m"],["8 m","60 m"],["8 m","90 m"],["0 m","90 m"],["0 m","30 m"]]}'
)


def case(*changes, name="typical-base"):
    return example(name, *changes)


def annotations(figure):
    return [text for axes in figure.axes for text in axes.texts if text.get_text()]


def check(figure):
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw_without_rendering()
    for axes in figure.axes:
        assert "[" in axes.get_xlabel()
        inside = axes.get_window_extent(renderer).padded(2.0)
        seen = [(text.get_text(), text.get_window_extent(renderer)) for text in axes.texts if text.get_text()]
        for text, box in seen:
            assert inside.x0 <= box.x0 <= box.x1 <= figure.bbox.x1, text
            assert inside.y0 <= box.y0 <= box.y1 <= inside.y1, text
        for (one, a), (other, b) in combinations(seen, 2):
            # Less than a pixel of two boxes is not seen.
            assert not a.padded(-0.5).overlaps(b.padded(-0.5)), (one, other)


@pytest.mark.slow
@pytest.mark.parametrize("units", ["si", pytest.param("us", marks=pytest.mark.slow)])
@pytest.mark.parametrize("more", [pytest.param([], marks=pytest.mark.slow), EVERYTHING], ids=["plain", "everything"])
@pytest.mark.parametrize("changes", SHAPES, ids=lambda changes: " ".join(changes) or "base")
def test_labels_stay_inside_and_apart(changes, more, units):
    check(section_figure(case(*changes, *more), units))


@pytest.mark.parametrize("name", ["block", "koyna-top", "triangular", "typical-height"])
def test_examples(name):
    check(section_figure(case(name=name)))


def test_a_sloped_upstream_face():
    check(section_figure(case(SLOPED, "reservoir.depth=90m", "crack.elevation=10m", *EVERYTHING)))


def test_forces_and_pressures_have_their_values():
    figure = section_figure(case())
    seen = {text.get_text() for text in annotations(figure)}
    # By hand: 0.5 x 1000 x 9.80665 x 100^2, and half of that pressure over the 80 m of the base.
    assert {"reservoir 49.0 MN/m", "uplift 39.2 MN/m", "pressure 0.981 MPa", "heel", "toe", "centroid"} <= seen
    us = {text.get_text() for text in annotations(section_figure(case(), "us"))}
    assert {"reservoir 3360 kip/ft", "pressure 142 psi", "328.1 ft", "262.5 ft"} <= us


@pytest.mark.parametrize("changes", [[], ["crack.elevation=20m", "crack.inclination=15deg"], [SLOPED]])
def test_arrows_stand_on_the_lines_of_their_forces_and_to_scale(changes):
    whole = case(*changes, "reservoir.depth=85m", *EVERYTHING)
    block = build_block(whole)
    section = block.section
    for force in block.forces:
        size = math.hypot(force.horizontal, force.vertical)
        if not size:
            continue
        tail, tip = _ends(force, section, 1e-6)
        assert np.hypot(*(tip - tail)) == pytest.approx(1e-6 * size)
        for end in (tail, tip):
            x, z = end - np.array(section.heel)
            assert x * force.vertical - z * force.horizontal == pytest.approx(
                force.moment, abs=1e-9 * size * section.height
            )


def test_the_uplift_diagram_has_the_shape_of_the_pressure():
    whole = case('uplift={pattern="drained", drain_position=0.1, drain_efficiency=0.67}')
    (axes,) = section_figure(whole).axes
    distance, pressure = uplift_profile(whole).T
    diagram = next(patch for patch in axes.patches if patch.get_hatch() == "|||").get_xy()
    drawn = np.array([max(-diagram[np.isclose(diagram[:, 0], x), 1]) for x in distance])
    assert drawn / drawn.max() == pytest.approx(pressure / pressure.max())


def test_a_crack_near_the_crest_has_a_picture_of_its_own():
    assert len(section_figure(case(name="typical-height")).axes) == 2
    assert len(section_figure(case()).axes) == 1


def test_the_picture_of_page_one_has_every_crack():
    from heeltoe.views.figures.summary import summary_figure

    texts = [text.get_text() for axes in summary_figure(example("two-cracks"), ()).axes for text in axes.texts]
    assert {"crack at 90 m", "crack at 0 m"} <= set(texts)
