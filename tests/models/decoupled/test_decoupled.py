"""The decoupled chain: ground, crack, block; on the command line, beside the flexible model, as a table of runs."""

from __future__ import annotations

import copy
import csv
import json
from dataclasses import replace

import numpy as np
import pyarrow.parquet as pq
import pytest

from heeltoe import GroundMotion, InputError, decoupled, rigid, verdict, with_spread
from heeltoe.base.atomic_files import LISTED
from heeltoe.mechanics.references import REFERENCES
from heeltoe.models.decoupled.model import crack_earthquake
from heeltoe.models.run import earthquake
from heeltoe.result.contract import HEADLINES
from heeltoe.result.write import json_text
from heeltoe.views.files.write import write_all
from shared.command import command, options
from shared.dams import KOYNA, SHORT, plane_case
from shared.every_field import BASE, put
from shared.responses import with_numbers

COARSE = SHORT[:1]
STIFF = [*SHORT, "concrete.modulus=1e15 Pa"]


def test_the_crack_is_shaken_more_than_the_ground(koyna):
    assert koyna.ok
    assert koyna.model == "decoupled"
    level = koyna.crack_level
    assert level["ground_peak_g"] == pytest.approx(0.49)
    assert level["amplification"] == pytest.approx(level["peak_horizontal_g"] / 0.49)
    # El Centro on Koyna's first period, 5 % damping: response spectra of records amplify 2 to 3 times there.
    assert 1.5 < level["amplification"] < 3.5
    assert level["periods_s"][0] == pytest.approx(0.355, rel=0.02)
    # The dam without a crack, its top elastic: close, a little slower.
    assert level["bonded"]["amplification"] == pytest.approx(level["amplification"], rel=0.25)
    assert 0.9 < level["periods_s"][0] / level["bonded"]["periods_s"][0] < 1.0
    assert koyna.residual_slip_m > 5.0 * abs(rigid(plane_case(KOYNA, SHORT)).residual_slip_m)
    evidence = level["convergence"]
    assert evidence["step_s"] == pytest.approx(0.5 * evidence["coarser_step_s"])
    assert evidence["straightness"] < 2e-3
    assert evidence["half_the_modes"] < 0.01
    assert evidence["change"] < 0.02


def test_spectrum_and_histories(koyna):
    spectrum = koyna.crack_level["spectrum"]
    assert set(koyna.crack_level["periods_s"]) <= set(spectrum["periods_s"])
    assert len({len(spectrum[name]) for name in spectrum if name != "damping_ratio"}) == 1
    # A stiff oscillator feels the peak, a slow one what the ground does.
    assert spectrum["ground_g"][0] == pytest.approx(0.49, rel=0.05)
    assert spectrum["crack_g"][0] == pytest.approx(koyna.crack_level["peak_horizontal_g"], rel=0.05)
    assert spectrum["crack_g"][-1] == pytest.approx(spectrum["ground_g"][-1], rel=0.05)
    assert spectrum["transfer"][-1] == pytest.approx(1.0, abs=0.02)
    h = koyna.histories
    motion = koyna.motion
    assert np.diff(h["time_s"]) == pytest.approx(0.005)
    expected = np.interp(h["time_s"], motion.time, motion.acceleration)
    assert h["ground_acceleration_m_s2"] == pytest.approx(expected)
    peak = np.abs(h["crack_acceleration_m_s2"]).max() / koyna.gravity
    assert peak == pytest.approx(koyna.crack_level["peak_horizontal_g"], rel=0.02)
    assert len({len(column) for column in h.values()}) == 1
    assert json.loads(json_text(koyna.to_json()))["crack_level"]["amplification"] > 1.0
    assert "the dam slides" in verdict(koyna)
    assert any("5.5" in reference for reference in koyna.citation())


def test_on_a_stiff_dam_it_is_the_rigid_model():
    case = plane_case(KOYNA, [*STIFF, "motion.pga=0.9 g"])
    chained, plain = decoupled(case), rigid(case)
    assert plain.residual_slip_m > 1e-3
    for name in ("residual_slip_m", "peak_slip_upstream_m", "rocking_upstream_rad", "rocking_downstream_rad"):
        assert chained.summary[name] == pytest.approx(plain.summary[name], rel=1e-6), name
    assert chained.crack_level["amplification"] == pytest.approx(1.0, rel=1e-12)


def test_what_drives_the_block_is_the_motion_of_the_crack(koyna):
    case = plane_case(KOYNA, SHORT)
    felt = crack_earthquake(case, earthquake(case, koyna.motion))
    assert felt.vertical is None
    assert "at the crack" in felt.motion.name
    assert "through the part of the dam below the crack" in felt.motion.processing[-1]
    assert rigid(case, felt.motion).residual_slip_m == koyna.residual_slip_m
    assert koyna.motion.name == "elcentro-1940-180-nga"


def test_the_vertical_motion_on_request_and_with_a_vertical_ground_motion(koyna):
    felt = decoupled(plane_case(KOYNA, [*SHORT, "decoupled.vertical=true"]))
    assert felt.crack_level["felt"] == ["horizontal", "vertical"]
    assert koyna.crack_level["felt"] == ["horizontal"]
    assert felt.residual_slip_m != koyna.residual_slip_m
    assert felt.vertical is None
    assert "vertical_ground_acceleration_m_s2" not in felt.histories
    up = plane_case(KOYNA, [*SHORT, "motion.vertical.file=elcentro-1940-up-nga", "motion.vertical.pga=0.3 g"])
    shaken = decoupled(up)
    assert shaken.crack_level["felt"] == ["horizontal", "vertical"]
    assert np.abs(shaken.histories["vertical_ground_acceleration_m_s2"]).max() / shaken.gravity == pytest.approx(
        0.3, rel=0.02
    )
    assert shaken.crack_level["peak_vertical_g"] > 0.3


def test_a_motion_of_points_with_a_jump_and_a_longer_run():
    points = "motion.points=[['0 s','0 g'],['0.2 s','0 g'],['0.2 s','0.6 g'],['0.5 s','0.6 g'],['0.5 s','0 g']]"
    response = decoupled(plane_case(KOYNA, [*COARSE, points, "motion.pga=0.6 g", "motion.duration=2 s"]))
    assert response.ok
    assert response.end_time_s == 2.0 + response.silence_s
    assert response.residual_slip_m != 0.0


def test_output_step_changes_no_number(koyna):
    coarse = decoupled(plane_case(KOYNA, SHORT), output_step=0.1)
    assert coarse.histories["time_s"].size == 41
    assert coarse.residual_slip_m == koyna.residual_slip_m


def test_a_block_that_feels_the_rotation_of_its_crack(koyna):
    turned = decoupled(plane_case(KOYNA, [*SHORT, "decoupled.rotation=true"]))
    assert turned.crack_level["felt"] == ["horizontal", "rotation"]
    felt = turned.histories["ground_rotation_rad_s2"]
    assert np.abs(felt).max() == pytest.approx(turned.crack_level["peak_rotation_rad_s2"], rel=0.05)
    assert turned.residual_slip_m != koyna.residual_slip_m
    # Only integration follows it.
    assert REFERENCES["integration"] in turned.citation()
    assert REFERENCES["integration"] not in koyna.citation()
    # A stiff dam turns as little as its foundation.
    stiff, level = (
        decoupled(plane_case(KOYNA, [*STIFF, f"decoupled.rotation={felt}"])).residual_slip_m
        for felt in ("true", "false")
    )
    assert stiff == pytest.approx(level, rel=1e-3)
    varied = with_spread(turned, plane_case(KOYNA, [*SHORT, "decoupled.rotation=true"]), 3)
    assert varied.spread["residual_slips_m"][1] == pytest.approx(turned.residual_slip_m, rel=1e-6)


def test_refusals():
    for changes, code in (
        (["crack.elevation=0 m"], "crack-at-base"),
        (["concrete.modulus=1 Pa"], "out-of-range"),
    ):
        with pytest.raises(InputError) as refused:
            decoupled(plane_case(KOYNA, [*SHORT, *changes]))
        assert refused.value.code == code
    dry = {"section": {"polygon": [["0 m", "0 m"], ["9 m", "0 m"], ["0 m", "9 m"]]}, "crack": {"friction": 1.0}}
    with pytest.raises(InputError) as refused:
        decoupled(plane_case(dry))
    assert refused.value.code == "motion-missing"


def test_a_dam_that_cannot_stand_is_not_shaken():
    response = decoupled(plane_case(KOYNA, [*SHORT, "crack.friction=0.1"]))
    assert (response.outcome, response.model) == ("unstable", "decoupled")
    assert not response.summary
    assert response.to_json()["motion"]["name"] == "elcentro-1940-180-nga"


def test_spread_is_that_of_the_scaled_ground():
    case = plane_case(KOYNA, SHORT)
    response = with_spread(decoupled(case), case, 3)
    by_hand = [decoupled(case, response.motion.scaled(factor)).residual_slip_m for factor in (0.99, 1.0, 1.01)]
    assert response.spread["residual_slips_m"] == pytest.approx(by_hand, rel=1e-6)


@pytest.mark.slow
def test_a_motion_made_by_hand_is_used_as_it_is():
    time = np.arange(0.0, 3.0, 0.02)
    motion = GroundMotion.from_points(time, 6.0 * np.sin(2.0 * np.pi * time / 0.355), name="resonant")
    response = decoupled(plane_case(KOYNA, COARSE), motion)
    assert response.motion is motion
    # Eight cycles at its own period with 5 %: most of the way to 1/(2 * 0.05) times the share of the mode.
    assert response.crack_level["amplification"] > 5.0


@pytest.mark.usefixtures("empty_figures")
def test_beside_the_flexible_model(koyna_both, tmp_path):
    both = koyna_both
    assert both.beside.model == "decoupled"
    data = json.loads(json_text(both.to_json()))
    assert (data["model"], data["beside"]["model"]) == ("flexible", "decoupled")
    ratio = data["residual_slip_m"] / data["beside"]["residual_slip_m"]
    assert data["ratio"]["residual_slip_m"] == pytest.approx(ratio)
    assert "the top does not vibrate itself" in both.meaning()
    written = {str(path.relative_to(tmp_path)) for path in write_all(both, tmp_path)}
    assert written >= {"comparison.png", "decoupled/crack-level.png", "decoupled/result.json", "crack.parquet"}


@pytest.mark.parametrize(
    ("block", "dam", "words"),
    [
        (0.1, 0.3, "3 times as far"),
        (0.1, -0.3, "opposite ways"),
        (0.1, 0.11, "They agree"),
        (0.0, 0.1, "decoupled top slides less than a hundredth"),
        (1.0, 0.001, "flexible dam slides less than a hundredth"),
    ],
)
def test_what_the_difference_means(koyna_both, block, dam, words):
    one, other = (
        with_numbers(each, **{headline.key: 0.0 for headline in HEADLINES} | {"residual_slip_m": slip})
        for each, slip in ((koyna_both.beside, block), (koyna_both, dam))
    )
    assert words in replace(other, beside=one).meaning()


@pytest.mark.usefixtures("empty_figures")
def test_on_the_command_line(tmp_path):
    result = command("run", KOYNA, "--model", "decoupled", *options(SHORT), "--details", "--out", tmp_path)
    assert result.returncode == 0, result.stderr
    shown = "The motion of the crack, which shakes the block", "Period of the intact dam"
    for words in ("(decoupled model)", *shown):
        assert words in result.stdout, words
    names = {path.name for path in tmp_path.iterdir()}
    assert names >= {"crack-level.png", "crack-level.svg", "response.png", "events.parquet", "result.json"}


def test_both_on_the_command_line():
    fast = [*SHORT, "flexible.evidence=none"]
    result = command("run", KOYNA, "--model", "decoupled,flexible", *options(fast), "--json", "-")
    assert result.returncode == 0, result.stderr
    assert json.loads(result.stdout)["beside"]["model"] == "decoupled"
    for words in ("decoupled beside it", "flexible dam", "Verdict"):
        assert words in result.stderr, words


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--model", "rigid,decoupled"), "rigid,decoupled is not a choice; choose auto"),
        (("--spread", "3", "--vary", "crack.friction=1,2"), "--spread: does not belong to a table of runs"),
        (("--vary", "crack.frictoin=1,2"), "crack.frictoin"),
        (("--model", "decoupled", "--vtk", "--out", "x"), "--vtk: does not belong to a rigid block"),
    ],
)
def test_what_the_command_line_refuses(arguments, words):
    result = command("run", KOYNA, *arguments)
    assert result.returncode == 2, result.stdout
    assert words in result.stderr


@pytest.mark.usefixtures("empty_figures")
def test_a_table_of_runs_on_the_command_line(tmp_path):
    vary = ("--vary", "crack.friction=0.8,1.0,1.2", "--vary", "uplift.pattern=uniform,triangular")
    result = command(
        "run", KOYNA, "--model", "decoupled", *options(SHORT), *vary, "--out", tmp_path, "--reverse", columns=80
    )
    assert result.returncode == 0, result.stderr
    assert max(map(len, (line for line in result.stdout.splitlines() if "wrote" not in line))) <= 80
    for words in ("residual", "triangular", "crack level: peak"):
        assert words in result.stdout, words
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {
        LISTED,
        "result.json",
        "table.csv",
        "table.parquet",
        *(f"{name}.{kind}" for name in ("slips", "residual-slip", "crack-level") for kind in ("png", "svg")),
    }
    rows = list(csv.DictReader((tmp_path / "table.csv").read_text().splitlines()))
    assert [(row["crack.friction"], row["uplift.pattern"]) for row in rows[:3]] == [
        ("0.8", "uniform"),
        ("0.8", "triangular"),
        ("1.0", "uniform"),
    ]
    runs = json.loads((tmp_path / "result.json").read_text())["runs"]
    assert [run["residual_slip_m"] for run in runs] == [float(row["residual_slip_m"]) for row in rows]
    one = decoupled(
        plane_case(KOYNA, [*SHORT, "motion.reverse=true", "crack.friction=0.8", "uplift.pattern=triangular"])
    )
    assert float(rows[1]["residual_slip_m"]) == one.residual_slip_m
    assert float(rows[1]["slip_sliding_m"]) == one.slip_by_mode_m["sliding"]
    assert pq.read_table(tmp_path / "table.parquet").num_rows == 6


def test_the_option_of_one_run_is_refused_in_process():
    from heeltoe.cli.run import run

    with pytest.raises(InputError) as refused:
        run(str(KOYNA), vary=["crack.friction=1,2"], spread="3")
    assert refused.value.code == "option-foreign"


def test_pieces_of_any_length_are_divided_alike_for_all_modes_and_half_of_them():
    fields = copy.deepcopy(BASE)
    put(fields, "motion.processing", [{"step": "cut", "start": 1e-12}])
    evidence = decoupled(plane_case(fields)).crack_level["convergence"]
    assert 0.0 < evidence["half_the_modes"] < 0.2


def test_without_damping_the_amplitude_at_a_period_of_its_own_is_large_and_a_number():
    fields = copy.deepcopy(BASE)
    put(fields, "concrete.damping", 0.0)
    transfer = decoupled(plane_case(fields)).crack_level["spectrum"]["transfer"]
    assert 1e3 < max(transfer) < 1e7
