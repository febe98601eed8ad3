"""Cases, motions and results draw themselves."""

from __future__ import annotations

import pytest
from matplotlib.image import imread

from heeltoe import InputError, overturning_map, read_case, rigid, statics
from heeltoe.study.small.run_table import parse_axes, run_small
from shared.dams import BASE, FAST, SLENDER, example
from shared.drawn import check, texts


@pytest.fixture(scope="module")
def response():
    return rigid(example("typical-base", *FAST))


def test_each_thing_has_a_main_figure(response, typical_both):
    case = example("typical-base", "statics.seismic_coefficient=0.1")
    for thing, name, words in (
        (case, "section", "heel"),
        (response, "response", "rigid model"),
        (typical_both, "comparison", "flexible model"),
        (response.motion, "motion", "PGA 0.400 g"),
        (statics(case, 0.1), "statics", "2 of 16 checks are not met"),
        (run_small(BASE, FAST, parse_axes(["crack.friction=0.8,1.0"]), rigid), "slips", "elcentro-1940-180-nga"),
        (overturning_map(read_case(SLENDER), count=3), "overturning", "pulse"),
    ):
        figure = thing.plot()
        if name not in ("statics", "motion", "overturning"):
            check(figure, name)
        message = " ".join([text.get_text() for text in texts(figure)] + [axes.get_ylabel() for axes in figure.axes])
        assert words in message
        assert thing.plot(name).get_size_inches() == pytest.approx(figure.get_size_inches())


def test_a_figure_is_chosen_by_name_and_written(response, tmp_path):
    path = tmp_path / "energy.png"
    figure = response.plot("energy", path=path, units="us")
    assert any("kip" in axes.get_xlabel() for axes in figure.axes)
    assert imread(path).std() > 0.05


def test_what_cannot_be_drawn_says_so(response, tmp_path):
    for call, code, words in (
        (lambda: response.plot("respons"), "not-a-choice", 'did you mean "response"?'),
        (lambda: response.plot(units="imperial"), "not-a-choice", "si or us"),
        (lambda: response.plot(path="dam.jpeg"), "file-ending", ".png"),
        (lambda: response.plot(path=tmp_path / "none" / "dam.png"), "cannot-write", "No such file"),
        (lambda: rigid(example("typical-base", "crack.friction=0.2")).plot(), "nothing-to-show", "unstable"),
    ):
        with pytest.raises(InputError) as refused:
            call()
        assert refused.value.code == code
        assert words in str(refused.value)


def test_bars_of_the_static_checks_reach_one_where_they_are_met():
    result = statics(example("typical-base", "statics.seismic_coefficient=0.1"), 0.1)
    bars = result.plot().axes[0].patches
    # An equilibrium that is met has no margin, and no bar.
    drawn = [item for item in result.checks if item.value is not None or not item.met]
    assert 0 < len(drawn) < len(result.checks)
    for bar, each in zip(bars, drawn, strict=True):
        assert (bar.get_width() >= 1.0 - 1e-9) == each.met
