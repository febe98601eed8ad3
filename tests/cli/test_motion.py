"""``heeltoe motion``: one record, the components of one, a match to a spectrum, and all of it as JSON."""

from __future__ import annotations

import json

import numpy as np
import pytest

from heeltoe import GroundMotion, InputError, read_record
from heeltoe.motion.matching import match_known_band
from heeltoe.motion.targets import target_of
from heeltoe.views.figures.motion import Matched, motion_figure
from shared.command import command
from shared.record_samples import GAL, knet
from shared.records_of_the_world import esm

G = 9.80665


@pytest.fixture
def records(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, way, share in (("a.asc", "HNE", 1.0), ("b.asc", "HNN", 0.7), ("c.asc", "HNZ", 0.5)):
        (tmp_path / name).write_text(esm(share * GAL, STREAM=way, SAMPLING_INTERVAL_S="0.02"))
    return tmp_path


@pytest.mark.slow
def test_three_components_in_one_go(records):
    run = command("motion", "a.asc", "b.asc", "c.asc", "--json", "-", "--units", "us", "--out", "drawn", cwd=records)
    assert run.returncode == 0, run.stderr
    motions = json.loads(run.stdout)["motions"]
    assert [item["component"] for item in motions] == ["HNE", "HNN", "HNZ"]
    assert motions[0]["pga_g"] == pytest.approx(np.abs(GAL).max() / 100.0 / G, rel=1e-6)
    assert len(motions[0]["spectrum"]["period_s"]) == len(motions[0]["spectrum"]["pseudo_acceleration_m_s2"]) > 50
    assert motions[0]["format"] == "ESM ASC"
    assert "in/s" in run.stderr or "ft/s" in run.stderr
    drawn = sorted(path.name for path in (records / "drawn").iterdir())
    assert drawn == [f"{name}.{ending}" for name in "abc" for ending in ("motion.png", "txt")]
    assert read_record(records / "drawn" / "a.txt").pga / G == pytest.approx(motions[0]["pga_g"], rel=1e-6)


def test_nothing_is_drawn_that_is_not_asked_for(records):
    before = sorted(records.iterdir())
    assert command("motion", "a.asc", cwd=records).returncode == 0
    assert sorted(records.iterdir()) == before


@pytest.mark.slow
def test_a_match_is_drawn_with_its_target_and_the_record_before():
    time = 0.01 * np.arange(1500)
    motion = GroundMotion("noise", time, np.random.default_rng(1).standard_normal(time.size) * np.exp(-time / 5.0))
    target = target_of("en1998:0.3g,B", "--match")
    matched, misfit = match_known_band(motion, target)
    figure = motion_figure(matched, G, matched=Matched(target, motion.scaled(misfit.scale)))
    spectrum = figure.axes[-1]
    lines = {line.get_label(): line for line in spectrum.lines}
    period = lines["target"].get_xdata()
    assert np.allclose(lines["target"].get_ydata(), target(period) / G)
    assert {"scaled record", "matched"} <= set(lines)


@pytest.mark.parametrize(("units", "pgd", "speed"), [("si", "m", "m/s"), ("us", "in", "ft/s")])
def test_components_stand_side_by_side_in_one_unit(units, pgd, speed, records):
    run = command("motion", "a.asc", "b.asc", "c.asc", "--units", units, "--details", cwd=records)
    lines = {line[:22].strip(): line[22:] for line in run.stdout.splitlines()}
    assert lines["component"].split() == ["HNE", "HNN", "HNZ"]
    for label, unit in (("PGV", speed), ("PGD", pgd), ("Arias intensity", speed)):
        numbers, result = lines[label].split()[::2], lines[label].split()[1::2]
        assert result == [unit] * 3
        share = 0.49 if label == "Arias intensity" else 0.7
        assert float(numbers[1]) == pytest.approx(share * float(numbers[0]), rel=2e-3)
    # Four are printed one below the other.
    run = command("motion", *["a.asc"] * 4, "--details", cwd=records)
    assert run.stdout.count("significant duration") == 4


def test_components_of_two_earthquakes_are_told(records):
    (records / "d.asc").write_text(esm(EVENT_NAME="ELSEWHERE", EVENT_DATE_YYYYMMDD="19990101"))
    run = command("motion", "a.asc", "d.asc", cwd=records)
    assert "not of the earthquake of the horizontal motion" in " ".join(run.stdout.split())


def test_a_match_is_written_as_a_record(records):
    (records / "s.txt").write_text("# period [s], Sa [g]\n0.1, 0.5\n0.5, 0.5\n3, 0.08\n")
    run = command("motion", "a.asc", "--match", "s.txt", "--out", "m.txt", "--json", "m.json", cwd=records)
    assert run.returncode == 0, run.stderr
    assert "off the target by" in run.stdout
    message = json.loads((records / "m.json").read_text())["motions"][0]
    assert 0.0 < message["misfit"]["rms"] <= message["misfit"]["largest"]
    matched = read_record(records / "m.txt")
    assert matched.pga / G == pytest.approx(message["pga_g"], rel=1e-6)
    assert "matched by wavelets to s" in matched.processing[0]


def test_targets():
    assert target_of("en1998: 0.3 g, B", "--match")(0.3) == pytest.approx(0.3 * G * 1.2 * 2.5)
    assert target_of("en1998:0.3g,B,2", "--match")(0.1) == pytest.approx(0.3 * G * 1.35 * 2.5)
    assert target_of("asce7:0.9g,0.4g,8s", "--match")(1.0) == pytest.approx(0.4 * G)


@pytest.mark.parametrize("text", ["en1998:0.3g", "en1998:0.3g,B,3", "asce7:1g", "nowhere.txt", "x\0y"])
def test_texts_that_name_no_spectrum(text):
    with pytest.raises(InputError, match=r"--match: .* names no spectrum; write for example en1998"):
        target_of(text, "--match")


def test_a_table_without_a_unit_or_rows(tmp_path):
    (tmp_path / "a.txt").write_text("0.1 0.5\n1 0.3\n")
    with pytest.raises(InputError, match="does not state the unit of its accelerations"):
        target_of(str(tmp_path / "a.txt"), "--match")
    (tmp_path / "b.txt").write_text("# Sa [g], units: g\n")
    with pytest.raises(InputError, match="is not a table of a spectrum"):
        target_of(str(tmp_path / "b.txt"), "--match")


@pytest.mark.parametrize("option", ["--out", "--figure"])
def test_one_file_for_several_motions_is_refused(records, option):
    run = command("motion", "a.asc", "b.asc", option, "x.png", cwd=records)
    assert run.returncode == 2
    assert f"{option}: is of one motion, and here are 2 motions" in run.stderr
    assert not list(records.glob("*.png"))


def test_a_record_of_counts_is_still_read(records):
    (records / "k.NS").write_text(knet())
    assert command("motion", "k.NS", cwd=records).returncode == 0


def test_how_values_run_and_what_they_are_multiplied_by_can_be_said(records):
    rows = "\n".join(" ".join(f"{v:.5f}" for v in GAL[k : k + 5]) for k in range(0, GAL.size, 5))
    (records / "rows.txt").write_text(f"scale factor: 0.5\nunits: gal\ndt: 0.01 s\n{rows}\n")
    refused = command("motion", "rows.txt", cwd=records)
    assert refused.returncode == 2
    assert 'say in --layout "rows"' in " ".join(refused.stderr.split())
    assert command("motion", "rows.txt", "--layout", "sideways", cwd=records).returncode == 2
    run = command("motion", "rows.txt", "--layout", "rows", "--factor", "0.5", "--json", "-", cwd=records)
    (motion,) = json.loads(run.stdout)["motions"]
    assert motion["pga_g"] == pytest.approx(0.5 * np.abs(GAL).max() / 100.0 / G, rel=1e-5)
