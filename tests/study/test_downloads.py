"""Folders as they come from those who distribute records: no file is renamed, and none is counted twice."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

import heeltoe
from heeltoe.case.suite import Suite, SuiteMotion
from heeltoe.case.toml_writer import toml_text
from heeltoe.errors.error import InputError
from heeltoe.study.plan.components import Reading, components_of, grouped
from heeltoe.study.plan.motions import records_of, suite_events
from shared.command import command
from shared.downloads import DOWNLOADS, SAID, STATIONS, at2, peer, write
from shared.studies import BLOCK

PRODUCERS = pytest.mark.parametrize("producer", list(DOWNLOADS))
HERE = Path()
#: What `heeltoe motion` is given with a folder of a producer.
OPTIONS = {"SAC": ("--unit", "m/s^2", "--factor", "0.1")}


def said(producer: str) -> Reading:
    return Reading.of(Suite.model_validate(SAID.get(producer, {})))


def toml_lines(fields: Mapping[str, Any]) -> str:
    return toml_text(fields, Suite, "")


def called(file: str | None) -> str | None:
    return None if file is None else Path(file).name


@PRODUCERS
def test_components_are_told_by_what_the_records_say(tmp_path, producer):
    """Made up with two stations of a vertical component each, which is half as strong as the first one."""
    make, count = DOWNLOADS[producer]
    places = 4 if producer == "KiK-net" else len(STATIONS)
    folder = write(tmp_path / "records", make())
    for vertical in (False, True):
        events, _ = suite_events([SuiteMotion(file=str(folder))], HERE, vertical=vertical, reading=said(producer))
        assert len({event.name for event in events}) == len(events) == count
        with_up = [event.vertical for event in events if event.vertical is not None]
        assert len(with_up) == (count if vertical else 0)
        # Each vertical with the horizontal ones of its place.
        assert len(set(with_up)) == (places if vertical else 0)
    groups = grouped(components_of(records_of(str(folder), HERE), HERE, said(producer)))
    assert [(len(group.horizontal), len(group.vertical)) for group in groups] == [(count // places, 1)] * places


@pytest.mark.parametrize(
    "producer",
    [
        name if name in ("PEER", "AFAD", "SAC", "BHRC") else pytest.param(name, marks=pytest.mark.slow)
        for name in DOWNLOADS
    ],
)
def test_a_download_goes_through_the_commands(tmp_path, producer):
    make, count = DOWNLOADS[producer]
    write(tmp_path / "records", make())
    how = toml_lines(SAID.get(producer, {}))
    (tmp_path / "case.toml").write_text(f"{BLOCK}[suite]\n{how}", encoding="utf-8")
    first = records_of("records", tmp_path)[0]
    asked = OPTIONS.get(producer, ())
    assert command("motion", first, *asked, cwd=tmp_path).returncode == 0
    shown = command("motion", "records", *asked, "--json", "-", cwd=tmp_path)
    assert shown.returncode == 0, shown.stderr
    seen = [row["name"] for row in json.loads(shown.stdout)["motions"]]
    places = 4 if producer == "KiK-net" else len(STATIONS)
    assert len(set(seen)) == len(seen) == count + places
    run = command(
        "run", "case.toml", "--motions", "records", "--vertical", "--model", "rigid", "--json", "-", cwd=tmp_path
    )
    assert run.returncode == 0, run.stderr
    records = json.loads(run.stdout)["suite"]["models"][0]["records"]
    assert len({record["motion"] for record in records}) == len(records) == count
    # The wave of 0.3 g at each station, and where there are three components one of 0.24 g (AFAD and UNAM: half); a
    # baseline moves them by some hundredths.
    peaks = sorted({round(record["pga_g"], 2) for record in records})
    assert peaks[-1] == pytest.approx(0.29, abs=0.04 if "processing" in how else 1e-9)
    assert len(peaks) == count // places
    (tmp_path / "study.toml").write_text(
        'case = "case.toml"\n[motions]\nfolder = "records"\nvertical = true\n'
        + how
        + ("pairs = true\n" if count > len(STATIONS) else "")
        + '[motions.scale]\nmeasure = "pga"\nvalues = ["0.3 g"]\n'
    )
    study = command("study", "study.toml", "--out", "out", "--json", "-", cwd=tmp_path)
    assert study.returncode == 0, study.stderr
    manifest = heeltoe.open_study(tmp_path / "out").manifest
    assert len(set(manifest["events"])) == places
    assert len({motion["name"] for motion in manifest["motions"]}) == count


def test_the_list_of_a_search_stands_beside_its_records(tmp_path):
    """Magnitude, distance to the rupture, Vs30 and the period of the pulse as the list of the download has them."""
    write(tmp_path / "records", peer())
    (tmp_path / "case.toml").write_text(BLOCK, encoding="utf-8")
    suite = heeltoe.run_suite(tmp_path / "case.toml", tmp_path / "records", model="rigid")
    (answer,) = suite.suite["models"]
    about = {
        record["motion"]: [record[key] for key in ("magnitude", "distance_m", "vs30_m_s", "pulse_period_s")]
        for record in answer["records"]
    }
    assert about["RSN9001_MADEUP_ABC090"] == [6.7, 12500.0, 300.0, 2.5]
    assert about["RSN9002_MADEUP_DEF000"] == [6.7, 12500.0, 400.0, None]
    shown = command("run", "case.toml", "--motions", "records", "--model", "rigid", cwd=tmp_path).stdout
    assert all(word in shown for word in ("12.5 km", "300 m/s", "2.5 s"))


def test_a_channel_of_a_file_is_named_by_its_number(tmp_path):
    make, _ = DOWNLOADS["AFAD"]
    folder = write(tmp_path / "records", make())
    file = next(iter(sorted(folder.iterdir())))
    events, _ = suite_events([SuiteMotion(file=f"{file}#2")], HERE, vertical=False)
    assert [event.name for event in events] == [f"{file.stem}-chan2"]
    both, _ = suite_events([SuiteMotion(file=str(file))], HERE, vertical=True)
    assert [called(event.horizontal[0]) for event in both] == [f"{file.name}#1", f"{file.name}#2"]
    assert {called(event.vertical) for event in both} == {f"{file.name}#3"}
    (tmp_path / "case.toml").write_text(BLOCK, encoding="utf-8")
    with pytest.raises(InputError) as refused:
        heeltoe.run_suite(tmp_path / "case.toml", f"{file}#7", model="rigid")
    assert refused.value.code == "record-channel"


def test_each_motion_made_to_order_is_an_earthquake_of_its_own():
    orders = [f"synthetic:M6.5,20km,seed={seed}" for seed in (1, 2, 3)]
    groups = grouped(components_of(orders, HERE))
    assert [[part.file for part in group.horizontal] for group in groups] == [[order] for order in orders]
    assert len({group.name for group in groups}) == 3


def test_instruments_that_start_some_parts_of_a_second_apart_are_one_station(tmp_path):
    """Three components of one name, whose headers differ in the last digit of the time."""
    files = {
        f"quake-{ending}.AT2": at2("Madeup-01", "ABC", component, 1.0).replace(
            "1/1/1980", f"1/1/1980 20:00:15.0{place}"
        )
        for place, (ending, component) in enumerate((("000", "000"), ("090", "090"), ("up", "UP")))
    }
    folder = write(tmp_path / "records", files)
    (group,) = grouped(components_of([str(path) for path in sorted(folder.iterdir())], HERE))
    assert (group.name, len(group.horizontal), len(group.vertical)) == ("quake", 2, 1)


def test_a_vertical_component_of_another_earthquake_is_warned_of(tmp_path):
    """As for a single run: PEER's headers say that the one is of 1980, the other of 1999."""
    one = at2("Madeup-01", "ABC", "000", 1.0)
    other = at2("Madeup-01", "ABC", "UP", 0.5).replace("1/1/1980", "1/1/1999")
    folder = write(tmp_path / "records", {"a-000.AT2": one, "a-up.AT2": other})
    (tmp_path / "case.toml").write_text(BLOCK, encoding="utf-8")
    (tmp_path / "study.toml").write_text(
        'case = "case.toml"\n[[motions.events]]\nhorizontal = "records/a-000.AT2"\nvertical = "records/a-up.AT2"\n'
    )
    study = heeltoe.run_study(tmp_path / "study.toml", tmp_path / "out")
    assert any("not of the earthquake of the horizontal motion" in text for text in study.manifest["warnings"])
    # In a folder they are no pair.
    (group, alone) = grouped(components_of([str(path) for path in sorted(folder.iterdir())], HERE))
    assert (len(group.vertical), len(alone.horizontal)) == (0, 0)


def test_uncorrected_records_beside_corrected_ones_are_left_out(tmp_path):
    corrected, _ = DOWNLOADS["GeoNet"]
    from shared.records_of_the_world import geonet

    raw = {name.replace("V2A", "V1A"): geonet("Uncorrected").replace("ABC", name[9:12]) for name in corrected()}
    folder = write(tmp_path / "records", {**corrected(), **raw})
    events, _ = suite_events([SuiteMotion(file=str(folder))], HERE, vertical=False)
    assert [called(event.horizontal[0]) for event in events] == ["19800101_ABC.V2A#1", "19800101_DEF.V2A#1"]
