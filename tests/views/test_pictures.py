"""What pictures must not say wrongly: losses, clipped bars, bands, axes that are left, colours that end early."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure
from scipy.ndimage import uniform_filter1d

from heeltoe import rigid, run, statics, with_spread
from heeltoe.mechanics.law_curve import curve_of
from heeltoe.motion.ground_motion import GroundMotion, integrals
from heeltoe.motion.measures import velocity_displacement
from heeltoe.motion.sequence import joined
from heeltoe.units.systems import unit_system
from heeltoe.views.figures.energy import friction_loss
from heeltoe.views.figures.histories import _running_mean
from heeltoe.views.figures.panels import draw_rotation, draw_slip
from heeltoe.views.figures.statics.checks import statics_figure
from heeltoe.views.figures.stress.deformed import _levels, deformed_figure
from heeltoe.views.figures.summary import summary_figure
from shared.dams import example
from shared.drawn import texts

SI = unit_system("si")


def test_friction_on_a_rough_crack_is_not_what_lifts_the_block():
    response = rigid(example("rough-crack", "motion.duration=8s"))
    assert friction_loss(response)[-1] == pytest.approx(response.energy.friction_j, rel=1e-9)


def test_the_law_of_a_rough_crack_has_its_asperities():
    case = example("rough-crack")
    curve = curve_of(case)
    assert curve.at_rest == case.crack.apparent_friction == pytest.approx(1.0465, abs=1e-4)
    assert curve.friction == pytest.approx(curve.at_rest)
    assert "asperities" in curve.title


def test_a_bar_that_ends_with_the_axis_says_its_number():
    result = statics(example("typical-base"))
    check = next(check for check in result.checks if check.value is not None)
    far = replace(check, value=4.04 * check.required, at_least=True)
    equilibrium = next(check for check in result.checks if check.value is None and check.met)
    figure = statics_figure(replace(result, checks=(far, equilibrium)))
    assert "4.04 →" in {text.get_text() for text in texts(figure)}
    # What is met without a number has no bar; what is not met keeps its own.
    assert len(figure.axes[0].patches) == 1
    figure = statics_figure(replace(result, checks=(far, replace(equilibrium, met=False))))
    assert len(figure.axes[0].patches) == 2


def test_the_spread_of_what_remains_stands_at_the_end_alone():
    case = example("typical-base", "motion.duration=4s", "motion.sign=recorded")
    response = with_spread(rigid(case), case, 3)
    axes = Figure().subplots()
    draw_slip(axes, response, SI)
    (band,) = axes.collections
    times = band.get_paths()[0].vertices[:, 0]
    assert times.min() > 0.9 * response.end_time_s
    assert times.max() == response.end_time_s


def test_a_block_that_overturns_stays_within_its_axis_and_leads_with_its_rotation():
    case = example("slender", "motion.duration=8s")
    response = run(case, "rigid")
    assert response.outcome == "overturned"
    axes = Figure().subplots()
    draw_rotation(axes, response, SI)
    low, high = axes.get_ylim()
    turned = axes.lines[0].get_ydata()
    assert low <= turned.min()
    assert turned.max() <= high
    assert np.abs(turned).max() == pytest.approx(np.pi / 2.0, rel=1e-3)
    labels = [axis.get_ylabel() for axis in summary_figure(case, (response,)).axes]
    assert any("rotation" in label for label in labels)
    assert not any("slip" in label for label in labels)


def test_the_ground_does_not_drift_between_two_motions():
    time = 0.01 * np.arange(200)
    first = GroundMotion("first", time, np.sin(time) + 0.1)
    second = GroundMotion("second", time, np.cos(3.0 * time)).scaled(0.5)
    whole, _, _ = joined([(first, None, None), (second, None, None)], [first.duration, second.duration], [20.0])
    velocity, displacement = velocity_displacement(whole)
    between = (whole.time > first.duration) & (whole.time < first.duration + 20.0)
    assert not velocity[between].any()
    assert np.abs(displacement).max() == pytest.approx(whole.pgd, rel=1e-3)
    assert displacement[-1] == pytest.approx(integrals(second.time, second.acceleration)[1][-1])
    assert whole.all_processing == "none; then scaled by 0.5"


def test_colours_go_up_to_the_largest_stress():
    assert _levels(2.0, 2.5)[-1] >= 2.5
    steep = _levels(0.2, 2.52)
    assert steep[0] == 0.0
    assert steep[-2] < 2.52 <= steep[-1]
    assert np.all(steep[2:] / steep[1:-1] < 2.6)


def test_page_one_has_the_slip_of_every_crack(typical_both):
    case = example("two-cracks", "motion.duration=2s", "flexible.elements_across=3", "flexible.evidence=none")
    response = run(case, "flexible")
    slip = summary_figure(case, (response,)).axes[-1]
    labels = [line.get_label() for line in slip.lines if line.get_label().startswith("crack")]
    assert sorted(labels) == ["crack at 0 m", "crack at 90 m"]
    assert "largest tension" in deformed_figure(typical_both)._supxlabel.get_text()


@pytest.mark.parametrize("step", [0.01, 0.0125, 0.02])
def test_a_running_mean_holds_its_ends(step):
    time = step * np.arange(200)
    values = np.random.default_rng(1).normal(size=time.size)
    assert _running_mean(time, values) == pytest.approx(uniform_filter1d(values, round(0.1 / step), mode="nearest"))
