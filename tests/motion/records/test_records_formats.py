"""Formats with a header of their own, and what may be assumed for a look at a file."""

from __future__ import annotations

import re

import numpy as np
import pytest

from heeltoe import InputError, read_record
from heeltoe.motion.records.read import read_channels, read_text
from shared.record_samples import GAL, WAVE, G, channels, cosmos, csmip, knet, read, smc

TOUCHING = 100.123456 + np.linspace(0.0, 50.0, 16)


# What the headers say


def test_csmip():
    motion = read(csmip({" 90 DEG": GAL}))
    assert motion.acceleration == pytest.approx(G * WAVE, abs=6e-6)
    assert motion.dt == pytest.approx(0.01)
    assert (motion.name, motion.format, motion.units_as_read, motion.channel) == ("a", "CSMIP V2", "cm/s^2", "1")
    assert (motion.event, motion.station) == ("NOWHERE EARTHQUAKE", "EMPTY VALLEY - DAM")
    assert (motion.component, motion.date) == ("90 DEG", "JANUARY 1, 1980 12:00 PST")
    assert motion.processing[0] == "PROCESSED: 1/02/80, XY QC00A000"
    assert "FILTERED WITH RAMPS AT .050- .100" in motion.processing[1]
    assert motion.warnings == ()


def test_csmip_of_the_new_century():
    text = csmip({"UP": TOUCHING}, form="10.6f").replace("NOWHERE EARTHQUAKE", "Rcrd of Tue Jan 1, 1980 12:00 PST")
    text = text.replace("SEC.  (UNITS: CM/SEC/SEC)", "sec, in cm/sec2. (8f10.6)").replace("  XYZ\n", "\n")
    assert "100.123456103.456789" in text  # nothing parts them but their width
    motion = read(text)
    assert motion.acceleration == pytest.approx(TOUCHING / 100.0, abs=6e-9)
    assert (motion.event, motion.date) == ("", "Tue Jan 1, 1980 12:00 PST")


def test_cosmos():
    motion = read(cosmos())
    assert motion.acceleration == pytest.approx(G * WAVE, abs=6e-8)
    # Not the recorder's step, which disagrees with the duration.
    assert motion.dt == pytest.approx(0.01)
    assert (motion.format, motion.units_as_read, motion.channel) == ("COSMOS V2", "cm/s^2", "1")
    assert (motion.event, motion.station) == ("Nowhere earthquake", "Empty Valley - Dam & Spillway")
    assert (motion.component, motion.date) == ("360 deg", "Tue Jan 1, 1980 20:00 UTC")
    assert motion.processing[0] == "Processed:1980-01-02 00:00:00 GMT, XYZ"
    assert motion.processing[1].startswith("Record filtered below 0.03 Hz")
    assert motion.warnings == ()


@pytest.mark.parametrize(
    ("said", "step"),
    [
        ({}, 0.01),
        ({"step": 1e5, "recorder_step": 0.01}, 0.01),
        ({"step": -999.0, "recorder_step": 0.02, "seconds": 3}, 0.02),
    ],
)
def test_the_step_of_a_cosmos_file_is_the_one_its_duration_agrees_with(said, step):
    motion = read(cosmos(**said))
    assert motion.dt == pytest.approx(step)
    assert motion.warnings == ()


def test_a_cosmos_file_whose_step_disagrees_with_its_duration_is_doubted():
    motion = read(cosmos(seconds=60))
    assert motion.dt == pytest.approx(0.01)
    assert "160 values and 60 s: check it" in str(motion.warnings[0])
    with pytest.raises(InputError, match=r"say so in motion\.time_step"):
        read(cosmos(step=-999.0, recorder_step=-999.0))


def test_a_cosmos_direction_that_is_missing_is_the_code_of_the_channel():
    motion = read(cosmos(direction="Other", number="?"))
    assert (motion.component, motion.channel) == ("HNE", "")
    assert read(cosmos(event="Earthquake of Tue Jan 1 1980")).date == "Tue Jan 1 1980"


def test_smc():
    motion = read(smc())
    assert "E+0-" in smc()  # columns that touch
    assert motion.acceleration == pytest.approx(G * WAVE, rel=1e-4, abs=1e-9)
    assert motion.dt == pytest.approx(0.01)
    assert (motion.format, motion.units_as_read, motion.component) == ("USGS SMC", "cm/s^2", "up")
    assert (motion.event, motion.station) == ("Nowhere, XY", "Empty Valley, Dam, F")
    assert motion.date == "1980-01-01 2000"
    assert motion.warnings == ()


@pytest.mark.parametrize(
    ("direction", "component"), [((0, -32768), "up"), ((180, -32768), "down"), ((90, 133), "133"), ((90, -32768), "")]
)
def test_an_smc_direction_that_is_missing_in_words_stands_in_the_integers(direction, component):
    assert read(smc(component="", direction=direction)).component == component


def test_an_smc_file_may_flag_a_problem_and_not_know_its_rate():
    assert "flags a problem" in str(read(smc(flag=1)).warnings[0])
    with pytest.raises(InputError, match=r"say so in motion\.time_step"):
        read(smc(rate=1.7e38))
    assert read(smc(rate=1.7e38), time_step=0.005).dt == pytest.approx(0.005)


def test_knet():
    motion = read(knet(), "ABC0018001012000.NS")
    assert motion.acceleration == pytest.approx(G * WAVE, abs=7e-6)
    assert motion.dt == pytest.approx(0.01)
    assert (motion.name, motion.format, motion.units_as_read) == ("ABC0018001012000.NS", "K-NET", "gal")
    assert (motion.event, motion.date) == ("magnitude 6.5 at 35.0, 140.0", "1980/01/01 20:00:00")
    assert (motion.station, motion.component) == ("ABC001", "N-S")
    assert motion.processing == ("mean of 8.4483 gal taken out",)
    assert motion.warnings == ()
    assert read(knet(direction="6")).component == "U-D surface"
    assert read(knet(offset=-70_000)).acceleration == pytest.approx(motion.acceleration, abs=1e-9)


@pytest.mark.parametrize("text", [csmip({"UP": GAL}), cosmos(), smc(), knet()])
def test_a_count_or_a_peak_that_is_not_the_stated_one_is_said(text):
    lines = text.rstrip("\n").split("\n")
    if lines[-1][:1] in "/E":
        # The accelerations end where the velocities begin, or the file.
        last = next((k for k, line in enumerate(lines) if "VELOC DATA" in line), len(lines) - 1) - 1
    else:
        last = len(lines) - 1
    short = read("\n".join(lines[:last] + lines[last + 1 :]))
    assert short.time.size == 152
    assert "states 160 values and has 152" in str(short.warnings[0])
    peak = f"{GAL[np.abs(GAL).argmax()]:.3f}"
    stated = next(item for item in (peak, peak.lstrip("-"), peak[:-2], f"{float(peak):.1f}") if item in text)
    other = read(text.replace(stated, stated.replace("2", "9", 1), 1))
    assert "states a peak of 9" in str(other.warnings[0])


def test_an_smc_of_volume_1_is_read_and_said_to_be_uncorrected():
    motion = read(smc(first="1 UNCORRECTED ACCELEROGRAM"))
    assert motion.acceleration == pytest.approx(G * WAVE, rel=1e-4, abs=1e-9)
    assert [notice.code for notice in motion.warnings] == ["record-uncorrected"]
    assert motion.processing == ()


def test_an_smc_without_a_rate_has_pairs_of_time_and_value():
    """As the instrument was digitized: taken for values, times would be half of them."""
    time = 0.01 * np.arange(160) + 0.002 * np.sin(np.arange(160.0))
    pairs = np.column_stack([time, GAL]).ravel()
    text = smc(pairs, first="1 UNCORRECTED ACCELEROGRAM", rate=1.7e38)
    motion = read(text)
    assert motion.time == pytest.approx(time - time[0], abs=6e-5)
    assert motion.acceleration == pytest.approx(G * WAVE, rel=1e-4, abs=1e-9)
    assert [notice.code for notice in motion.warnings] == ["record-uncorrected"]
    # A row behind the stated count, whose times go back, is none of it.
    more = text + " 1.4000E+0 0.0000E+0 1.4100E+0 0.0000E+0\n"
    assert read(more).acceleration.tobytes() == motion.acceleration.tobytes()
    assert read(more).processing[0] == "4 numbers behind the stated 320 left out"
    pairs[100] = 0.0
    with pytest.raises(InputError, match="goes back"):
        read(smc(pairs, first="1 UNCORRECTED ACCELEROGRAM", rate=1.7e38), time_step=0.01)


@pytest.mark.parametrize("padding", [b"\x00" * 512, b"\x1a", b"\r\n\x1a\x00\x00"])
def test_what_fills_the_last_block_of_a_file_is_none_of_it(padding):
    motion = read_text(smc().encode() + padding, "a.smc")
    assert motion.acceleration == pytest.approx(G * WAVE, rel=1e-4, abs=1e-9)


def test_kiknet_of_a_borehole_and_of_the_surface_have_two_names_and_one_a_word(tmp_path):
    for ending, direction in (("NS1", "1"), ("NS2", "4")):
        (tmp_path / f"ABCH018001012000.{ending}").write_text(knet(direction=direction))
    below, above = (read_record(tmp_path / f"ABCH018001012000.{ending}") for ending in ("NS1", "NS2"))
    assert (below.name, above.name) == ("ABCH018001012000.NS1", "ABCH018001012000.NS2")
    assert (below.component, above.component) == ("N-S borehole", "N-S surface")
    assert "motion within the ground" in str(below.warnings[0])
    assert above.warnings == ()


# Complaints

_V3 = """\
RESPONSE AND FOURIER AMPLITUDE SPECTRA      99999-S1234-80001.01       CHAN  1: 90 DEG
CORRECTED ACCELEROGRAM   99999-S1234-80001.01       CHAN  1: 90 DEG
UNCORRECTED ACCELEROGRAM DATA              PROCESSED:  1/02/80, XY QC00A000
NOWHERE EARTHQUAKE
   .100   .200   .300   .400
"""


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (cosmos("velocity"), "is a velocity record; give the acceleration record"),
        (cosmos("displacement"), "is a displacement record"),
        (smc(first="3 VELOCITY"), "is a velocity record"),
        (cosmos().replace("Real-header", "Real header"), "states no real header that can be used"),
        (cosmos().split("     160 acc")[0], "states no series of numbers"),
        (cosmos(unit="counts"), "counts"),
        (cosmos(unit="smoots"), "does not state its unit"),
        (csmip({"UP": GAL}, unit="CM"), '"1 cm" is not an acceleration'),
        ("\n".join(smc().split("\n")[:15]), "states no 48 integers and 50 reals"),
        (knet(scale="3920(gal)/0"), "states no scale factor"),
        (knet(scale="unknown"), "states no scale factor"),
        (knet().split("Memo.")[0], "has 0 samples"),
        (knet().replace("100Hz", "often"), "does not state its time step"),
        (_V3, "CSMIP V3 (response spectra) format, which is not read"),
        (cosmos().replace("Corrected acc", "Uncorrected acc"), "COSMOS V0 or V1 (uncorrected) format, which is not"),
        (cosmos().replace("Corrected acceleration", "Raw acceleration counts"), "COSMOS V0 or V1"),
        ("UNCORRECTED ACCELEROGRAM DATA\n0 1\n2 3\n", "CSMIP V1 (uncorrected)"),
    ],
)
def test_complaints(text, words):
    with pytest.raises(InputError) as caught:
        read(text)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_number_that_overflowed_its_column_is_no_number():
    text = csmip({"UP": GAL})
    with pytest.raises(InputError, match=r"line \d+: '\*+' is not a number"):
        read(text.replace(f"{GAL[80]:10.3f}", "*" * 10))


# What is assumed for a look


def test_a_unit_and_a_step_are_assumed_only_on_request():
    bare = "0.1\n0.2\n"
    motion = channels(bare)[0]
    assert (motion.units_as_read, motion.dt) == ("g (assumed)", 0.01)
    assert motion.pga == pytest.approx(0.2 * G)
    assert tuple(map(str, motion.warnings)) == (
        "a.V2 states no time step: 0.01 s is assumed; an analysis asks for motion.time_step",
        "a.V2 states no unit: g is assumed; an analysis asks for motion.unit",
    )
    assert channels("0 100\n0.01 50\n")[0].units_as_read == "cm/s^2 (assumed)"
    assert read(bare, assume=True).pga == motion.pga
    with pytest.raises(InputError, match=r"peaks at 3; say so in motion\.unit"):
        channels("0 3\n0.01 0\n")  # 3 m/s2, or a grave mistake
    for hints in ({}, {"unit": "g"}, {"time_step": 0.01}):
        with pytest.raises(InputError, match=r"say so in motion\.(unit|time_step)"):
            read(bare, **hints)
    answer = channels(bare, unit="m/s^2", time_step=0.02)[0]
    assert (answer.units_as_read, answer.dt, answer.warnings) == ("m/s^2 (as given)", 0.02, ())


# Small print of columns


def test_a_capital_g_is_gravity():
    assert read("0 0.1\n0.01 0.2\n", unit="G").pga == pytest.approx(0.2 * G)
    assert read("# units: g\n0 0.1\n0.01 0.2\n", unit="G").pga == pytest.approx(0.2 * G)


@pytest.mark.parametrize("separator", [";", "\t", " ; "])
def test_decimal_commas_beside_semicolons_or_tabs(separator):
    text = "Zeit [s];acc [g]\n" + "".join(
        f"0,{k:03d}{separator}{v}\n" for k, v in ((0, "0,123"), (10, "-1,5e-1"), (20, "0"))
    )
    motion = read(text)
    assert motion.time == pytest.approx([0.0, 0.01, 0.02])
    assert motion.acceleration == pytest.approx(G * np.array([0.123, -0.15, 0.0]))


def test_a_comma_behind_a_leading_zero_parts_no_thousands():
    motion = read("# units: [g]\n0,000;0,125\n0,010;0,250\n")
    assert motion.acceleration == pytest.approx(G * np.array([0.125, 0.25]))


@pytest.mark.parametrize(
    ("data", "line"),
    [
        ("1,000;1,250\n2,000;1,500\n", 2),  # thousands, or thousandths
        ("0,01;0,5\n0.02;0,5\n", 3),
        ("0,01;0,5\n1.000,5;0,5\n", 3),
    ],
)
def test_commas_that_can_be_read_in_two_ways_are_refused(data, line):
    with pytest.raises(InputError, match=rf"line {line}: the commas of .* can be read in two ways"):
        read("# units: [cm/s2]\n" + data)


def test_commas_in_remarks_are_not_decimal():
    assert read("# units: [g]\n0.0 0.1\n# 1,5; no more\n0.01 0.2 # 2,5;\n").time.size == 2
    assert read("# units: [g]\n0.0,\t0.1\n0.01,\t0.2\n").pga == pytest.approx(0.2 * G)


def test_quotes_do_not_matter():
    motion = read('"station: X"\n"time [s]","acceleration [g]"\n"0.00","0.1"\n"0.01","0.2"\n')
    assert (motion.pga, motion.station) == (pytest.approx(0.2 * G), "X")


@pytest.mark.parametrize("width", [3, 8])
def test_more_than_two_columns_are_refused_with_a_remedy(width):
    with pytest.raises(InputError, match=f"has {width} columns of numbers, and no line above them that names each"):
        read("# units: [g]\n" + 5 * (" 1.0E-1-2.0E-1" * (width // 2) + " 3.0" * (width % 2) + "\n"))
    with pytest.raises(InputError, match="no known format"):
        read("3 blind mice\n3 blind mice\n")


ROWS = "".join(f"{0.01 * k:.2f} {0.1 * (k % 3):.1f} {0.2 * (k % 2):.1f} {0.3 * (k % 4):.1f}\n" for k in range(30))


@pytest.mark.parametrize(
    "header", ["time [s], NS [g], EW [g], up [g]", "t(s)  NS  EW  up\n# units: g", "T|NS [g]|EW (g)|up (g)"]
)
def test_columns_with_a_name_each(header):
    text = f"# {header}\n{ROWS}"
    result = channels(text)
    assert [item.component for item in result] == ["NS", "EW", "up"]
    assert [item.pga / G for item in result] == pytest.approx([0.2, 0.2, 0.9])
    assert read(text, channel="ew").dt == pytest.approx(0.01)
    with pytest.raises(InputError, match=r"has several channels \(1: NS, peak 0\.2 g; 2: EW"):
        read(text)


def test_velocities_and_displacements_beside_accelerations_are_left_out():
    header = "Time (sec), Acceleration (g), Velocity (cm/sec), Displacement (cm)\n"
    motion = read(header + ROWS.replace(" ", ","))
    assert (motion.units_as_read, motion.pga / G) == ("g", pytest.approx(0.2))
    with pytest.raises(InputError, match="is a displacement and velocity record; give the acceleration record"):
        read("time [s], vx [cm/s], velocity y, d [cm]\n" + ROWS.replace(" ", ","))


@pytest.mark.parametrize(
    ("header", "quantity"),
    [
        ("# time [s], velocity [cm/s]", "velocity"),
        ("time [s];v [m/s]", "velocity"),
        ("# units: cm/s", "velocity"),
        ("# Displacement time history", "displacement"),
        ("t [s], d [cm]", "displacement"),
    ],
)
def test_a_column_of_another_quantity_is_no_acceleration(header, quantity):
    separator = ";" if ";" in header else " "
    with pytest.raises(InputError, match=f"is a {quantity} record; give the acceleration record"):
        read(f"{header}\n" + "".join(f"{0.01 * k:.2f}{separator}0.1\n" for k in range(30)), unit="cm/s^2")


def test_a_column_that_counts_the_samples_is_no_time():
    text = "# units: [g]\n" + "".join(f"{k} {0.1 * (k % 3):.1f}\n" for k in range(1, 40))
    with pytest.raises(InputError, match=r"counts the samples and is no time; say the time step in motion\.time_step"):
        read(text)
    motion = read(text, time_step=0.005)
    assert (motion.dt, motion.processing) == (pytest.approx(0.005), ("the first column counts the samples",))
    assert read(text.replace("units: [g]", "units: [g], dt: 0.02")).dt == pytest.approx(0.02)
    # A thousand values in a second have times of whole milliseconds.
    assert read("time [ms], acc [g]\n" + text.split("\n", 1)[1]).dt == pytest.approx(0.001)


# Records as distributed


def test_all_records_are_read_without_options_and_are_what_they_state(records):
    files = sorted(file for file in records.rglob("*") if file.is_file() and file.name != "README.md")
    assert len(files) > 50
    seen = 0
    for file in files:
        text = file.read_text("latin-1")
        for motion in read_channels(file):
            assert motion.time.size > 100
            for warning in map(str, motion.warnings):
                assert "is assumed" in warning
            if motion.format == "CSMIP V2":
                message = text.split("END OF DATA FOR CHANNEL")[int(motion.channel) - 1]
                count, step = re.search(r"(\d+) POINTS OF ACCEL DATA EQUALLY SPACED AT +([\d.]+)", message).groups()
                peak = re.search(r"PEAK ACCELERATION = +-?([\d.]+)", message)[1]
                assert (motion.time.size, motion.dt) == (int(count), pytest.approx(float(step)))
                assert 100.0 * motion.pga == pytest.approx(float(peak), abs=1e-9)
                seen += 1
            if motion.format == "USGS SMC":
                lines = text.split("\n")
                assert motion.time.size == int(lines[13][:10])
                assert 1.0 / motion.dt == pytest.approx(float(lines[17][15:30]))
                largest, smallest = float(lines[22][60:75]), float(lines[23][15:30])
                assert 100.0 * motion.pga == pytest.approx(max(largest, -smallest), rel=5e-5)
                seen += 1
    assert seen == 5


def test_a_record_of_several_channels_is_not_taken_without_a_choice(records):
    file = records / "formats" / "cosmos-csmip-ce36456.V2"
    with pytest.raises(InputError, match=r"3: 0 DEG, peak 256\.2 cm/s\^2\); choose one in motion\.channel"):
        read_record(file)
    assert 100.0 * read_record(file, channel="up").pga == pytest.approx(94.805)
