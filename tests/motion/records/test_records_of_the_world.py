"""The formats of networks around the world: what is read, what is said of it, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import InputError, read_case
from heeltoe.case.shaking import resolve
from shared.dams import PLAIN as DAM
from shared.record_samples import GAL, WAVE, G, channels, csmip, read
from shared.records_of_the_world import (
    SAMPLES,
    afad,
    bhrc,
    csmip_v1,
    csmnc,
    esm,
    geonet,
    renadic,
    taiwan,
    unam,
    usc,
    usc_v1,
)

RAW = {"afad", "geonet raw", "bhrc", "renadic", "csmip v1", "csmip v1 of pairs", "csmip v1 of 1998", "usc v1"}


@pytest.mark.parametrize("name", SAMPLES)
def test_values_are_what_was_written(name):
    motion = channels(SAMPLES[name]())[0]
    # What the widths of the columns leave; those of RENADIC have a ten-thousandth of g.
    assert motion.acceleration == pytest.approx(G * WAVE, abs=6e-4)
    assert motion.dt == pytest.approx(0.005 if name in ("esm", "csmnc", "unam", "bhrc") else 0.01)
    assert [warning.code for warning in motion.warnings] == (["record-uncorrected"] if name in RAW else [])


def test_what_the_headers_say_is_kept():
    motion = read(esm())
    assert (motion.format, motion.units_as_read, motion.component) == ("ESM ASC", "cm/s^2", "HNZ")
    assert (motion.event, motion.date, motion.station) == ("NOWHERE", "19800101 200000", "XY.ABC")
    assert motion.processing == ("manual", "baseline removed", "butterworth 0.100 to 30.000 hz")
    motion = read(afad(), channel="e-w")
    assert (motion.format, motion.channel) == ("AFAD", "2")
    assert (motion.event, motion.station) == ("magnitude 6.5 Mw at 35.00000N-40.00000E", "9999 EMPTY VALLEY")
    motion = read(geonet(), channel="up")
    assert (motion.format, motion.units_as_read) == ("GeoNet V1A, V2A", "mm/s^2")
    assert (motion.event, motion.date) == ("5 km south-west of Nowhere", "1980 January 01 20:00:00 UT")
    assert motion.pga == pytest.approx(0.5 * G * np.abs(WAVE).max(), rel=1e-3)
    motion = read(usc())
    assert (motion.format, motion.component, motion.station) == ("USC V2", "N08W", "USC# 9999")
    assert (motion.event, motion.date) == ("NOWHERE EARTHQUAKE", "JAN 1, 1980 -2000 GMT")
    motion = read(csmnc())
    assert (motion.format, motion.component, motion.station) == ("CSMNC", "EW", "51ABC")
    assert (motion.event, motion.date) == ("NOWHERE EARTHQUAKE", "1980-1-1 20:0:0 BTM")
    assert [channel.component for channel in channels(unam())] == ["N00E", "N90E", "V"]
    assert read(unam(), channel=1).event == "magnitude M=6.5"
    assert [channel.component for channel in channels(bhrc())] == ["352 deg", "V"]
    motion = channels(renadic())[0]
    assert (motion.event, motion.date, motion.station) == ("NOWHERE", "01/01/1980 20:00:00", "EMPTY VALLEY")
    assert motion.component == "EW"


@pytest.mark.parametrize("name", [name for name in SAMPLES if name not in ("bhrc", "usc v1")])
def test_a_peak_that_is_not_the_stated_one_is_said(name):
    """The wave peaks at 288.463 gal; volume 1 of BHRC and USC states no peak."""
    lines = SAMPLES[name]().split("\n")
    k = next(k for k, line in enumerate(lines) if any(word in line.upper() for word in ("PGA", "PEAK ", "MAX")))
    other = lines[k].replace("288", "388", 1).replace("0.294", "0.394", 1)
    assert other != lines[k]
    lines[k] = other
    assert any("states a peak" in str(doubt) for motion in channels("\n".join(lines)) for doubt in motion.warnings)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (esm(DATA_TYPE="VELOCITY"), "is a velocity record; give the acceleration record"),
        (esm(DATA_TYPE="DISPLACEMENT RESPONSE SPECTRUM"), "is a displacement response spectrum record"),
        (esm(SAMPLING_INTERVAL_S=""), "does not state its time step"),
        (afad(step=""), "states no components, number of data or sampling interval"),
        (geonet().replace("Number of points", "Points"), "states no number of points and step"),
        (csmnc(quantity="CORRECTED VELOCITY  UNIT: CM/SEC"), "is a velocity record"),
        (usc().replace("OF ACC DATA", "OF VEL DATA"), "is a velocity or displacement record"),
        (usc(unit="SMOOTS"), "does not state its unit"),
        (unam(step=""), "states no channels, step or unit"),
        (bhrc().replace("G/10", "G/20"), "states no number of points, duration and unit of g or g/10"),
        (taiwan().replace("#SampleRate(Hz): 100", "#SampleRate(Hz): 50"), "step of 0.02 s, but its times are 0.01 s"),
        (taiwan().replace("#DataSequence: Time", "#DataSequence:"), "has 4 columns where others have 3"),
        (taiwan().replace("U(+); N(+); E(+)", "as usual"), "states no sampling rate and order of columns"),
        (unam(heads=8, channels=4), "states no number of channels, of which there are 3,"),
        (csmip({"UP": GAL}).split("\n", 1)[1].replace("CM/SEC/SEC", "G"), "CSMIP V1 (uncorrected)"),
    ],
)
def test_complaints(text, words):
    with pytest.raises(InputError) as caught:
        read(text)
    assert words in str(caught.value)


@pytest.mark.parametrize(("sample", "channel"), [(esm(BASELINE_CORRECTION="BASELINE NOT REMOVED"), 1), (renadic(), 1)])
def test_an_uncorrected_record_runs_only_corrected(tmp_path, sample, channel):
    (tmp_path / "a.txt").write_text(sample)
    motion = {"file": "a.txt", "channel": channel}

    def resolved(*steps):
        case = read_case(DAM | {"motion": motion | {"processing": list(steps)}})
        return resolve(case.motion, case.gravity, tmp_path)[0]

    for steps in ((), ({"step": "taper"},), ({"step": "band-pass", "high": "20 Hz"},)):
        with pytest.raises(InputError, match=r"motion: a(-chan1)? is uncorrected: .*; correct it by motion.processing"):
            resolved(*steps)
    for step in ({"step": "baseline"}, {"step": "band-pass", "low": "1 Hz"}):
        assert "record-uncorrected" not in {warning.code for warning in resolved(step).warnings}


def test_volume_1_of_california_says_where_it_is_from():
    pairs, equal = channels(csmip_v1())[0], channels(csmip_v1(equal=True))[0]
    for motion in (pairs, equal):
        assert (motion.format, motion.component) == ("volume 1 (CSMIP, USC, BHRC, RENADIC)", "90 DEG")
        assert motion.station == "EMPTY VALLEY - DAM"
    assert (pairs.event, pairs.date) == ("NOWHERE EARTHQUAKE", "JANUARY 1, 1980 12:00 PST")
    assert (equal.event, equal.date) == ("", "Tue Jan 1, 1980 12:00:00.0 PST")
    assert [motion.component for motion in channels(csmip_v1())] == ["90 DEG", "UP"]
    motion = read(usc_v1())
    assert (motion.event, motion.date) == ("NOWHERE EARTHQUAKE", "JAN 1, 1980 -2000 GMT")
    assert (motion.station, motion.component) == ("EMPTY VALLEY, DAM", "S05W")


def test_the_columns_of_taiwan_are_those_its_header_names():
    three = channels(taiwan())
    assert [motion.component for motion in three] == ["up", "north", "east"]
    for motion, share in zip(three, (1.0, 0.5, -0.3), strict=True):
        assert motion.acceleration == pytest.approx(share * G * WAVE, abs=6e-6)
    assert three[0].processing == ("offset corrected, by its header",)
    # Down is not up.
    assert channels(taiwan("U(-); N(+); E(+)"))[0].acceleration == pytest.approx(-G * WAVE, abs=6e-6)


def test_headings_of_channels_that_are_not_there_do_not_count():
    three = channels(unam(heads=8))
    assert [motion.component for motion in three] == ["N00E", "N90E", "V"]
    assert three[2].acceleration == pytest.approx(-0.3 * G * WAVE, abs=6e-6)
    spaced = unam(heads=8).replace("ACEL. MAX.(Gal)", "ACEL. MAX. (Gal)").replace("/288", "/388", 1)
    assert spaced != unam(heads=8)
    other = unam(heads=8).replace("ACEL. MAX.(Gal)", "ACEL. MAX. (Gal)").replace("/-288", "/-388", 1)
    texts = (spaced, other)
    assert any(
        "states a peak" in str(doubt) for text in texts for motion in channels(text) for doubt in motion.warnings
    )


def test_a_motion_that_goes_where_no_ground_goes_is_refused(tmp_path):
    (tmp_path / "a.txt").write_text("# units: [g]\n# dt: 1 s\n" + "\n".join(f"{v:.6f}" for v in WAVE))
    case = read_case(DAM | {"motion": {"file": "a.txt"}})
    with pytest.raises(InputError) as caught:
        resolve(case.motion, case.gravity, tmp_path)
    assert caught.value.code == "motion-fast"
    assert "more than 10 m/s or 50 m: no earthquake does; check its time step" in str(caught.value)
