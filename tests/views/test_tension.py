"""The largest tension in words and as a figure."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest

from heeltoe import flexible
from heeltoe.result.numbers import TensionByMesh
from heeltoe.result.tension import place_phrase, tension_sentence
from heeltoe.result.verdict import verdict
from heeltoe.views.figures.all import all_figures
from heeltoe.views.figures.stress.tension import tension_figure
from heeltoe.views.report.html import html
from heeltoe.views.report.write import build_report
from heeltoe.views.words.response import tension_line, tension_worth
from shared.dams import BASE, COARSE, ENDS, HEIGHT, plane_case
from shared.drawn import check, texts
from shared.report_reader import Reader

SHORT = [*COARSE, "flexible.elements_across=4", "motion.duration=3s", ENDS]


@pytest.fixture(scope="module")
def judged():
    return flexible(plane_case(HEIGHT, [*SHORT, "concrete.tensile_strength=0.5 MPa"]))


def test_it_is_said_with_place_moment_and_strength(judged):
    tension = judged.tension
    line = tension_line(tension, "si")
    assert line.startswith(f"{tension['stress_pa'] / 1e6:.3g} MPa at {tension['time_s']:.2f} s ")
    assert f"of the part {tension['part']} the crack, {tension['z_m']:.3g} m up" in line
    assert line.endswith("MORE than the 0.75 MPa that the concrete bears in an earthquake, 0.5 MPa without one")
    assert "psi" in tension_line(tension, "us")
    assert "MPa" not in tension_line(tension, "us")
    strong = replace(tension, strength=replace(tension.strength, exceeds=False))
    assert "; within the 0.75 MPa" in tension_line(strong, "si")
    assert tension_line(replace(tension, strength=None), "si").endswith(
        "gives no concrete.tensile_strength to judge it by"
    )


def test_the_verdict_names_it_where_the_concrete_does_not_bear_it(judged):
    tension = judged.tension
    message = verdict(judged)
    assert f"Its tension of {tension['stress_pa'] / 1e6:.3g} MPa {place_phrase(tension)}" in message
    assert (
        "more than the 0.75 MPa that the concrete bears, so the assumption of no further cracking is not valid."
        in message
    )
    assert "psi" in verdict(judged, "us")
    strong = replace(tension, strength=replace(tension.strength, exceeds=False))
    assert (
        tension_sentence(strong, "si")
        == tension_sentence(replace(tension, strength=None), "si")
        == tension_sentence(None, "si")
        == ""
    )


@pytest.mark.slow
def test_page_one_of_the_report_has_it(judged):
    case = plane_case(HEIGHT, [*SHORT, "concrete.tensile_strength=0.5 MPa"])
    text = Reader(html(build_report(case, judged))).text
    assert re.search(r"Largest tension in the concrete\s+[\d.]+ MPa", text)
    assert re.search(r"Strength in an earthquake\s+0\.75 MPa", text)


def test_what_it_is_worth_is_said(judged):
    assert tension_worth(judged.tension, "si") == (
        "read 1 m from the crack at least, as it has no bound there; compared with no other mesh"
    )
    mesh = TensionByMesh(other_elements_across=2, stress_pa=1.234e6, difference_pa=1e5)
    assert tension_worth(replace(judged.tension, mesh=mesh), "si").endswith(
        "; 1.23 MPa with 2 elements along the crack"
    )


@pytest.mark.parametrize("units", ["si", "us"])
def test_the_figure_marks_the_place_and_the_strength(judged, units):
    figure = tension_figure(judged, units)
    check(figure, "tension")
    seen = " ".join(text.get_text() for text in texts(figure))
    assert "what the concrete bears" in seen
    assert ("[psi]" if units == "us" else "[MPa]") in seen
    scale = 1.0 if units == "si" else 1.0 / 0.3048
    marks = [line for line in figure.axes[0].lines if line.get_marker() == "o"]
    assert [float(marks[0].get_xdata()[0]), float(marks[0].get_ydata()[0])] == pytest.approx(
        [scale * judged.tension["x_m"], scale * judged.tension["z_m"]]
    )


def test_a_dam_that_does_not_stand_has_no_such_figure():
    case = plane_case(BASE, [*SHORT, "crack.friction=0.3"])
    assert "tension" not in all_figures(case, flexible(case))
