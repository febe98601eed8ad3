"""Friction laws that are fitted to shear tests: made tests give their law back."""

from __future__ import annotations

import math

import numpy as np
import pytest

from heeltoe import InputError
from heeltoe.case.crack.law import Law
from heeltoe.kernel.friction import shear_stress
from heeltoe.mechanics.friction import law_of
from heeltoe.mechanics.law_fit import fit_laws
from heeltoe.mechanics.shear_tests import read_shear_tests
from shared.command import command
from validation.made_shear_tests import MADE, SCATTER, STRESSES, coverage, curves, falls_found, shear_test, speeds

#: Of 100 intervals of 95 % fewer than 88 have the true number once in 500 laws (binomial).
_FEWEST = 88
HEAD = "specimen,stage,normal stress [MPa],peak shear [MPa],residual shear [MPa]\n"


@pytest.mark.slow
@pytest.mark.parametrize("name", MADE)
def test_intervals_have_the_true_numbers_in_95_of_100_draws(name):
    assert min(coverage(MADE[name], 100).values()) >= _FEWEST


@pytest.mark.slow
@pytest.mark.parametrize("make", [curves, speeds])
def test_a_fall_is_found_where_it_is_and_seldom_where_it_is_not(make):
    # 11 of 100 and more come once in 200 where the level is 5 %.
    assert falls_found(lambda random: make(random, 0.0), 100) <= 11
    assert falls_found(lambda random: make(random, 0.15), 100) >= 95


@pytest.mark.parametrize("name", MADE)
def test_one_draw_of_each_law_gives_its_numbers_back(name):
    made = MADE[name]
    fits = fit_laws(made.make(np.random.default_rng(7)))
    fit = next(fit for fit in fits.fits if fit.law.startswith(made.law))
    assert fit.why.startswith(("chosen", "not chosen"))
    for number in fit.parameters:
        # Within twice its own interval: a quick look; the counts are in the test above.
        true = made.numbers.get(number.name, number.value)
        assert abs(number.value - true) <= number.high - number.low
    assert fit.band is not None
    assert all(low < best < high for low, best, high in zip(fit.band.low, fit.band.best, fit.band.high, strict=True))
    assert np.shape(fit.covariance) == (len(fit.parameters),) * 2


def test_a_straight_line_has_the_interval_of_the_textbook():
    # Slope through the origin: its variance is s^2 over the sum of squares, Student's t with n - 1 degrees.
    random = np.random.default_rng(3)
    tests = [shear_test(s, 0.9 * s + SCATTER * random.normal()) for s in STRESSES]
    shear = np.array([test.peak_pa for test in tests])
    slope = float(STRESSES @ shear / (STRESSES @ STRESSES))
    misfit = shear - slope * STRESSES
    half = 2.0686576 * math.sqrt(float(misfit @ misfit) / 23 / float(STRESSES @ STRESSES))
    number = fit_laws(tests).fits[0].parameters[0]
    assert number.value == pytest.approx(slope, rel=1e-7)
    assert number.high - number.value == pytest.approx(half, rel=1e-5)


def test_a_band_of_one_test_holds_further_tests():
    random = np.random.default_rng(4)
    tests = [shear_test(s, 0.9 * s + SCATTER * random.normal()) for s in STRESSES]
    band = fit_laws(tests).strength.band
    further = 0.9 + SCATTER * random.normal(size=4000) / 1e6
    inside = (further > np.interp(1e6, band.at, band.low)) & (further < np.interp(1e6, band.at, band.high))
    assert 0.92 < inside.mean() < 0.99


def test_later_stages_are_left_out_and_what_they_would_have_done_is_told(tmp_path):
    # The line by hand: first stages 0.9 s + 0.2; later ones lose a tenth of the normal stress for each stage.
    rows = [
        (f"S{number}", stage + 1, s, 0.9 * s + 0.2 - 0.1 * stage * s, 0.7 * s)
        for number in range(4)
        for stage, s in enumerate((0.4 + 0.2 * number, 0.8 + 0.2 * number, 1.6 + 0.2 * number))
    ]
    path = tmp_path / "tests.csv"
    path.write_text(HEAD + "".join(f"{a},{b},{c:.4f},{d:.6f},{e:.4f}\n" for a, b, c, d, e in rows))
    fits = fit_laws(read_shear_tests(path))
    assert (fits.tests, fits.used, fits.specimens) == (12, 4, 4)
    numbers = {number.name: number.value for number in fits.fits[1].parameters}
    assert numbers["residual_friction"] == pytest.approx(0.9, rel=1e-5)
    assert numbers["cohesion"] == pytest.approx(0.2e6, rel=1e-4)
    slope, intercept = np.polyfit([row[2] for row in rows], [row[3] for row in rows], 1)
    # As the Bureau of Reclamation found.
    assert slope < 0.9
    assert intercept > 0.2
    assert f"{slope:.2f} and {intercept:.2f} MPa" in str(fits.notes[0])


def test_the_size_of_specimens_is_seen_where_it_matters():
    random = np.random.default_rng(5)
    sizes = np.tile([0.1, 0.2, 0.4], 8)
    tests = [
        shear_test(s, (1.2 - 1.0 * size) * s + 0.02e6 * random.normal(), size_m=size)
        for s, size in zip(STRESSES, sizes, strict=True)
    ]
    assert "falls with the size of the specimens" in str(fit_laws(tests).notes[0])
    assert "0.10 m to 0.40 m" in str(fit_laws(tests).notes[0])
    assert "cannot be seen" in str(fit_laws([shear_test(s, s) for s in STRESSES]).notes[0])


@pytest.mark.parametrize("name", MADE)
def test_the_block_of_a_case_is_one(name, tmp_path):
    command("examples", tmp_path / "examples")
    case = tmp_path / "examples" / "block.toml"
    text = case.read_text()
    fits = fit_laws(MADE[name].make(np.random.default_rng(6)))
    block = fits.crack.partition("\n[crack.band]")[0]
    rest = "\n".join(line for line in text.splitlines() if not line.startswith(("friction", "static_", "kinetic_")))
    block = block.removeprefix("[crack]\n")
    whole = (
        rest.replace("[crack]", f"[crack]\n{block}", 1) if not block.startswith("[") else f"{rest.rstrip()}\n\n{block}"
    )
    (tmp_path / "case.toml").write_text(whole)
    reply = command("law", tmp_path / "case.toml")
    assert reply.returncode == 0, reply.stderr


def test_a_band_is_written_where_slip_takes_nothing_of_the_strength():
    held = fit_laws(MADE["constant"].make(np.random.default_rng(6)))
    assert "\n[crack.band]" in held.crack
    lost = fit_laws([shear_test(s, 1.0 * s, residual=0.7 * s) for s in STRESSES])
    assert "kinetic_friction = 0.700" in lost.crack
    assert "\n[crack.band]" not in lost.crack


def test_a_bilinear_block_is_the_two_lines():
    from validation.made_shear_tests import bilinear

    fits = fit_laws([shear_test(s, bilinear(s)) for s in STRESSES])
    assert fits.strength.law == "bilinear"
    import tomllib

    fields = tomllib.loads(fits.crack)["crack"]["law"]
    law = law_of(Law(**fields))
    for s in (0.3e6, 0.8e6, 1.6e6, 2.4e6):
        assert float(shear_stress(law, s)[1]) == pytest.approx(bilinear(s), rel=0.01)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("normal stress [MPa],strength [MPa]\n1,2\n", "is not a choice; choose columns of"),
        ("normal stress,peak shear [MPa]\n1,2\n", "has no unit"),
        ("normal stress [MPa],peak shear [mm]\n1,2\n", "peak shear"),
        ("normal stress [MPa],normal stress [kPa],peak shear [MPa]\n1,2,3\n", "is listed twice"),
        ("peak shear [MPa]\n1\n", "normal stress: is required but missing"),
        ("normal stress [MPa]\n1\n", "peak shear: is required but missing"),
        ("normal stress [MPa],slip [mm],shear [MPa]\n1,2,3\n", "specimen: is required but missing"),
        ("normal stress [MPa],slip [mm],peak shear [MPa]\n1,2,3\n", "strengths and points of curves"),
        ("normal stress [MPa],peak shear [MPa]\n1,2,3\n", "row 1: has 3 cells, the header 2"),
        ("normal stress [MPa],peak shear [MPa]\n1,x\n", "row 1: peak shear: "),
        ("normal stress [MPa],peak shear [MPa]\n1,\n", "row 1: peak shear: "),
        ("normal stress [MPa],peak shear [MPa]\n0,1\n", "row 1: normal stress: "),
        ("normal stress [MPa],peak shear [MPa]\n1,-1\n", "is out of range"),
        ("normal stress [MPa],peak shear [MPa]\n1,1\n2,2\n", "has 2 tests with a strength"),
        ("specimen,normal stress [MPa],slip [mm],shear [MPa]\nA,1,1,1\n", "the curve has 1 points"),
        ("", "is required but missing"),
        ("normal stress [MPa],peak shear [MPa]\n1,\udcff\n", "cannot be read"),
    ],
)
def test_a_bad_table_gets_one_clear_error(text, words, tmp_path):
    path = tmp_path / "tests.csv"
    path.write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(InputError, match=words.replace("[", r"\[")):
        read_shear_tests(path)


def test_the_command_prints_and_writes_the_laws(tmp_path):
    path = tmp_path / "tests.csv"
    rows = [f"S{k},1,{s / 1e6:.3f},{0.9 * s / 1e6 + 0.01 * (-1) ** k:.3f}," for k, s in enumerate(STRESSES)]
    path.write_text(HEAD + "\n".join(rows) + "\n")
    reply = command("law", "fit", path, "--out", tmp_path / "fit", "--json", tmp_path / "fit.json")
    assert reply.returncode == 0, reply.stderr
    assert "friction = 0.90" in reply.stdout
    assert "chosen: criterion" in reply.stdout
    assert {file.name for file in (tmp_path / "fit").iterdir()} >= {"law-fit.json", "law-fit.toml", "strength.png"}
    assert not (tmp_path / "fit" / "report.html").exists()
    reply = command("law", "fit", "tests.csv", "--out", "fit", "--report", cwd=tmp_path)
    assert reply.returncode == 0, reply.stderr
    page = (tmp_path / "fit" / "report.html").read_text(encoding="utf-8")
    assert "Friction laws from shear tests" in page
    assert "As a block of the case file" in page
    assert (tmp_path / "fit" / "report.pdf").is_file()
    for options in (("fit", "tests.csv", "--report"), ("cohesion", "--report")):
        reply = command("law", *options, cwd=tmp_path)
        assert reply.returncode == 2
        assert "--report: has no meaning without" in reply.stderr
    assert command("law", "fit").returncode == 2
    assert "law fit TESTS.csv: is required but missing" in command("law", "fit").stderr
    assert "there is no file" in command("law", "fit", tmp_path / "none.csv").stderr
    assert "--set" in command("law", "fit", path, "--set", "crack.friction=1").stderr
    assert "TESTS.csv" in command("law", "cohesion", path).stderr
    falling = tmp_path / "curves.csv"
    lines = ["specimen,normal stress [MPa],slip [mm],shear [MPa]"]
    for test in curves(np.random.default_rng(1), 0.3):
        lines += [
            f"{test.specimen},1,{1e3 * slip:.3f},{ratio:.4f}"
            for slip, ratio in zip(test.curve.slip_m, test.curve.ratio, strict=True)
        ]
    falling.write_text("\n".join(lines) + "\n")
    reply = command("law", "fit", falling, "--out", tmp_path / "falls")
    assert 'name = "slip weakening"' in reply.stdout
    assert (tmp_path / "falls" / "fall.png").exists()
