"""Components that begin at different times: by their headers, and by the shape of their shaking."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import InputError, read_case
from heeltoe.case.shaking import resolve_components
from heeltoe.motion.processing import cut_to_window
from heeltoe.motion.records.read import read_record, read_text
from heeltoe.motion.start import lag_of, moment_of
from models.rigid.test_varying import rectangle
from shared.record_samples import knet


@pytest.mark.parametrize(
    ("text", "seconds"),
    [
        ("1970/01/02 00:00:15", 86415.0),
        ("19700101_000102.250", 62.25),
        ("1970 01 01 00 01 00", 60.0),
        ("1940-05-19", None),
        ("1970/13/02 00:00:15", None),
    ],
)
def test_moments_of_headers(text, seconds):
    assert moment_of(text) == seconds


def test_formats_that_state_when_a_record_begins():
    record = read_text(knet().encode(), "XYZ0018001012000.NS")
    assert record.begins == moment_of("1980/01/01 20:00:15")
    assert record.after_rest(0.0, "to wait") is record


WAVES = np.random.default_rng(6).normal(size=(2, 2000)) * np.hanning(2000) ** 2


def components(directory, starts=("", ""), waves=WAVES, step=("0.01", "0.01")):
    """Write two components and return the motions of a slab under them."""
    for name, start, values, own in zip(("000", "090"), starts, waves, step, strict=True):
        numbers = "\n".join(f"{0.3 * value:.7f}" for value in values)
        head = f"# INITIAL TIME = {start}\n" if start else ""
        (directory / f"quake-{name}.txt").write_text(f"{head}# time step: {own} s\n# units: [g]\n{numbers}\n")
    one, other = (str(directory / f"quake-{name}.txt") for name in ("000", "090"))
    case = read_case(rectangle(20.0, 1.0, 0.4, motion={"file": one, "cross_valley": {"file": other}}))
    along, _, across = resolve_components(case.motion, case.gravity, directory)
    assert across is not None
    return along, across


@pytest.mark.parametrize("late", [0.4, -0.4])
def test_the_component_that_begins_later_waits(late, tmp_path):
    plain = components(tmp_path)
    starts = ("1980-01-01 20:00:10.5", f"1980-01-01 20:00:{10.5 + late:.1f}")
    along, across = components(tmp_path, starts)
    waits, first = (across, along) if late > 0.0 else (along, across)
    own = plain[1] if late > 0.0 else plain[0]
    other = plain[0] if late > 0.0 else plain[1]
    assert np.array_equal(first.acceleration, other.acceleration)
    moments = own.time + 0.4
    assert np.interp(moments, waits.time, waits.acceleration) == pytest.approx(own.acceleration, abs=1e-9)
    assert np.abs(np.interp(np.linspace(0.0, 0.39, 9), waits.time, waits.acceleration)).max() <= abs(
        own.acceleration[0]
    )
    assert "0.4 s of rest before it" in " ".join(waits.processing)


def test_records_of_different_hours_are_refused(tmp_path):
    with pytest.raises(InputError, match=r"begins 3600 s after quake-000") as refused:
        components(tmp_path, ("1980-01-01 20:00:10", "1980-01-01 21:00:10"))
    assert (refused.value.code, refused.value.field) == ("another-kind", "motion.cross_valley")


def test_a_window_moves_the_beginning(tmp_path):
    components(tmp_path, ("1980-01-01 20:00:10", ""))
    record = read_record(tmp_path / "quake-000.txt")
    assert cut_to_window(record, 2.0).begins == record.begins + 2.0
    assert record.after_rest(1.5, "to wait").begins == record.begins - 1.5


def test_a_lag_of_the_shaking_is_found_and_warned_of(tmp_path):
    late = np.concatenate([np.zeros(300), WAVES[1][:-300]])
    along, across = components(tmp_path, waves=(WAVES[0], late))
    assert lag_of(along, across) == pytest.approx(3.0, abs=0.5)
    assert lag_of(across, along) == pytest.approx(-3.0, abs=0.5)
    (notice,) = [notice for notice in across.warnings if notice.code == "components-unsure"]
    assert notice.field == "motion.cross_valley"
    assert "after that, by the correlation of their sizes" in str(notice)
    assert not [notice for notice in components(tmp_path)[1].warnings if notice.code == "components-unsure"]


def test_pairs_of_records_have_no_lag_and_one_that_is_moved_has(records):
    files = sorted((records / "ensemble").glob("*.txt"))
    found = 0
    for one, other in zip(files[::2], files[1::2], strict=True):
        along, across = read_record(one), read_record(other)
        assert lag_of(along, across) is None, one.name
        lag = lag_of(along, across.after_rest(3.0, "to lag"))
        found += lag is not None
        assert lag is None or lag == pytest.approx(3.0, abs=0.8), one.name
    assert found >= 19


def test_one_record_both_ways_is_warned_of(tmp_path):
    _, across = components(tmp_path, waves=(WAVES[0], WAVES[0]))
    (notice,) = [notice for notice in across.warnings if notice.code == "components-unsure"]
    assert "the values of that" in str(notice)
