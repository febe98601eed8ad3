"""Tables as people have them: prose above rows, headers held against what was read, headings of what is no record."""

from __future__ import annotations

import itertools
import zipfile

import numpy as np
import pytest

from heeltoe import InputError, read_case, read_record
from heeltoe.case.shaking import resolve
from heeltoe.motion.records.quantities import names_of, table_in, unit_of
from heeltoe.motion.records.read import read_text, read_text_channels
from heeltoe.motion.records.stated import number, read_stated
from heeltoe.motion.records.to_motion import Options
from shared.dams import PLAIN as DAM
from shared.record_samples import GAL, G, channels, read

WAVE = np.round(1.7 * np.hanning(240) * np.sin(0.31 * np.arange(240)), 5)


def along(width: int, values=WAVE, form: str = "11.4E", between: str = "") -> str:
    """Values along rows of so many."""
    return "".join(
        between.join(format(v, form) for v in values[k : k + width]) + "\n" for k in range(0, len(values), width)
    )


def down(*columns, step: float = 0.005, places: int = 3) -> str:
    rows = zip(itertools.count(), *columns, strict=False)
    return "".join(f"{step * k:.{places}f} " + " ".join(f"{v:.5f}" for v in row) + "\n" for k, *row in rows)


# Prose above rows

PROSE = {
    "of five words": "Acceleration time series in m/s/s",
    "of a station": "Station : Made Up, Nowhere, Vale, 2020",
    "German": "Beschleunigung an der Sohle in m/s2",
    "Turkish": "ivme zaman serisi birim m/s2",
    "of numbers too": "Test 3 of wall B2 in m/s2",
}


@pytest.mark.parametrize("width", [2, 3, 5, 6, 8])
@pytest.mark.parametrize("prose", PROSE.values(), ids=PROSE)
def test_a_sentence_of_as_many_words_as_a_row_has_numbers_names_no_columns(prose, width):
    """240 values at 0.005 s, as the header says: whoever takes the sentence for names has 240 / width of them."""
    words = (prose.split() * 3)[:width]
    text = f"Time Increment (s) : 0.005\nNumber of Data : 240\nunits: m/s2\n{' '.join(words)}\n{along(width)}"
    motion = read(text)
    assert motion.acceleration == pytest.approx(WAVE, rel=1e-4, abs=1e-9)
    assert motion.dt == pytest.approx(0.005)
    assert motion.duration == pytest.approx(239 * 0.005)


def test_values_run_along_rows_where_count_and_step_say_so_and_else_only_on_request():
    head = "ACCELERATION DATA IN UNITS OF (FT/S/S)\n"
    motion = read(f"{head}NPT = 240, Tstep = 0.01\n{along(7)}")  # the last row is short
    assert motion.acceleration == pytest.approx(0.3048 * WAVE, rel=1e-4, abs=1e-9)
    assert motion.dt == 0.01
    for stated in ("Tstep = 0.01", "NPT = 240", "NPT = 239, Tstep = 0.01"):
        with pytest.raises(InputError, match=r'has 8 columns of numbers.*say in motion.layout "rows"'):
            read(f"{head}{stated}\n{along(8)}")
    asked = read(f"{head}{along(8)}", layout="rows", time_step=0.01)
    assert asked.acceleration.tolist() == motion.acceleration.tolist()
    three = channels(f"{head}{down(WAVE, 0.5 * WAVE, -WAVE)}", layout="columns")
    assert [item.component for item in three] == ["1", "2", "3"]
    assert three[1].acceleration == pytest.approx(0.3048 * 0.5 * WAVE, abs=1e-5)
    assert three[0].dt == pytest.approx(0.005)


def test_a_column_of_times_is_not_taken_for_values_even_on_request():
    for header in ("", "time [s] NS [g] EW [g]\n"):
        with pytest.raises(InputError, match=r'motion.layout: "rows" makes values of the times'):
            read(f"{header}units: g\n{down(WAVE, -WAVE)}", layout="rows", time_step=0.005)


def test_a_case_says_how_values_run(tmp_path):
    (tmp_path / "a.txt").write_text(f"units: m/s2\n{along(6)}")
    motion = {"file": "a.txt", "layout": "rows", "time_step": "0.01 s"}
    case = read_case(DAM | {"motion": motion})
    assert resolve(case.motion, case.gravity, tmp_path)[0].time.size == 240


def test_a_count_of_all_numbers_beside_names_of_columns_is_refused():
    text = f"Number of points: 480\ntime [s]  acceleration [m/s2]\n{down(WAVE)}"
    with pytest.raises(InputError, match=r"states 480 values, has 240 rows of 2"):
        read(text)


# What a header states


@pytest.mark.parametrize(
    ("line", "counts", "steps"),
    [
        ("NPTS=   5372, DT=   .0100 SEC,", [5372], [0.01]),
        ("NO. OF POINTS = 4,000 AT EQUAL INTERVALS OF 0.02 SEC", [4000], [0.02]),
        ("4000 points at 0.005 s", [4000], [0.005]),
        ("Sampling Freq(Hz) 100Hz", [], [0.01]),
        ("SAMPLING RATE= 50Hz", [], [0.02]),
        ("sampled at 200 samples/s", [], [0.005]),
        ("Sampling rate: 128", [], [1 / 128]),
        ("Sampling rate: 0.005 s", [], [0.005]),
        ("Abtastrate: 200 Hz, Anzahl der Werte: 800", [800], [0.005]),
        ("Pas de temps (ms) : 5", [], [0.005]),
        ("Intervalo de muestreo (s): 0,01", [], [0.01]),
        ("Numero di campioni = 3.000", [3000], []),
        ("Frequência de amostragem: 0,25 kHz", [], [0.004]),
        ("Örnekleme aralığı (sn): 0.005; Veri sayısı: 1200", [1200], [0.005]),
        ("Ρυθμός δειγματοληψίας (Hz): 100", [], [0.01]),
        ("Шаг по времени: 0,005 с", [], [0.005]),
        ("サンプリング周波数：１００Hz データ数：6000", [6000], [0.01]),
        ("采样间隔: 0.02 秒", [], [0.02]),
        ("processing: two-step 4 pole filter", [], []),
        ("original dt = 0.005 s, dt = 0.01 s", [], [0.01]),
        ("dt: 0.01 fortnights", [], []),
        ("dt: 1.2.3", [], []),
        ("magnitude 6.5 at 12 km, depth 10", [], []),
    ],
)
def test_counts_and_steps_in_the_words_of_many(line, counts, steps):
    stated = read_stated([line])
    assert [item.value for item in stated.counts] == counts
    assert [item.value for item in stated.steps] == pytest.approx(steps)


@pytest.mark.parametrize(
    ("text", "value", "rounding"),
    [
        ("0,005", 0.005, 1e-3),
        ("1,234.5", 1234.5, 0.1),
        ("1.234,5", 1234.5, 0.1),
        ("1.234.567", 1234567.0, 1.0),
        ("1.0D-02", 0.01, 1e-3),
        (".5", 0.5, 0.1),
    ],
)
def test_numbers_with_points_and_commas(text, value, rounding):
    written = number(text)
    assert (written.value, written.rounding) == (pytest.approx(value), pytest.approx(rounding))
    assert number("1.2.3") is None


UNIT = "acceleration [m/s2]\ndt: 0.005 s\n"


@pytest.mark.parametrize(
    ("header", "code"),
    [
        ("Duration: 2.4 s", "record-states"),
        ("Dauer: 0,6 s", "record-states"),
        ("PGA: 0.168 m/s2", "record-states"),
        ("最大加速度: 0.5 m/s2", "record-states"),
        ("PGA: 1.681 g", "record-states"),
        ("Abtastrate: 100 Hz", "record-steps-stated"),
        ("number of samples: 100", "record-count-far"),
        ("Duration: 1.2 s, PGA: 1.681, 240 points, fs = 200 Hz", None),
        ("PGA: 0.1714 g", None),
        ("Significant duration: 0.6 s", None),
        ("raw PGA: 0.9 g", None),
        ("PGV: 0.5 m/s, PGD: 0.1 m, Peak velocity: 0.2", None),
    ],
)
def test_what_a_header_states_is_held_against_what_was_read(header, code):
    text = UNIT + header + "\n" + along(1, form=".5f")
    if code is None:
        assert read(text).warnings == ()
        return
    with pytest.raises(InputError) as caught:
        read(text)
    assert caught.value.code == code


def test_points_in_a_sentence_are_counted_with_care():
    body = along(1, form=".5f")
    assert read(f"{UNIT}smoothed over 5 points\n{body}").warnings == ()
    assert read(f"{UNIT}240 points in all\n{body}").warnings == ()
    (notice,) = read(f"{UNIT}100 points in all\n{body}").warnings
    assert notice.code == "record-doubtful"
    assert "states 100 values and has" in str(notice)


def test_a_peak_that_is_nearly_the_stated_one_is_said():
    (notice,) = read(f"{UNIT}PGA: 1.72 m/s2\n{along(1, form='.5f')}").warnings
    assert notice.code == "record-doubtful"
    assert "states a peak of 1.72 and has" in str(notice)


def test_a_stated_peak_says_that_a_unit_that_was_given_is_not_that_of_the_file():
    text = f"dt: 0.005 s\nPeak: 1.681 m/s2\n{along(1, form='.5f')}"
    assert read(text, unit="m/s^2").pga == pytest.approx(np.abs(WAVE).max())
    with pytest.raises(InputError, match=r"peaks at 1\.\d+ in its own unit, and its header states 1.681 m/s\^2"):
        read(text, unit="g")


# Tables that are no records


@pytest.mark.parametrize(
    ("heading", "width"),
    [
        ("Period (s) acceleration (g)", 2),
        ("Period [s]; Sa [g]", 2),
        ("T [s], PSA [g]", 2),
        ("T(s) Se(g)", 2),
        ("Periode [s];Beschleunigung [m/s²]", 2),
        ("Periodo (s), aceleración (g)", 2),
        ("周期(s),加速度(gal)", 2),
        ("Freq. (Hz)  Amplitude", 2),
        ("Magnitude, distance [km], PGA [g]", 3),
        ("PGA [g], annual rate", 2),
        ("Mw Rjb Vs30", 3),
        ("return period [years], PGA [g]", 2),
        ("columns: period [s], acceleration [g]", 2),
        ("PSA [g]", 1),
    ],
)
def test_a_table_is_refused_by_its_headings(heading, width):
    values = np.column_stack([0.01 * np.arange(200)] + [np.linspace(0.1, 0.9, 200)] * (width - 1))
    between = ";" if ";" in heading else "," if "," in heading else " "
    rows = "\n".join(between.join(f"{v:.4f}" for v in row) for row in values[:, -width:])
    for unit in (None, "g"):
        with pytest.raises(InputError) as caught:
            read_text_channels(f"{heading}\n{rows}\n".encode(), "a.txt", Options(unit=unit, assume=True))
        assert caught.value.code == "record-table"


@pytest.mark.parametrize(
    "title",
    [
        "Period of the instrument: 0.05 s",
        "Instrument period (s): 0.05",
        "Magnitude 6.5",
        "matched to the spectrum of EN 1998, type 1",
        "Distance 12 km, Vs30 400 m/s",
        "Frequency range 0.1 to 25 Hz",
    ],
)
def test_words_of_tables_in_the_title_of_a_record_do_no_harm(title):
    assert read(f"{title}\n{UNIT}{along(1, form='.5f')}").time.size == 240
    assert read(f"{title}\ntime [s] acceleration [m/s2]\n{down(WAVE)}").dt == pytest.approx(0.005)


def test_two_columns_without_a_word_are_a_record_only_if_they_look_like_one():
    assert read(down(WAVE), unit="m/s^2").dt == pytest.approx(0.005)
    spectrum = np.column_stack([0.01 * np.arange(300), 0.3 * np.exp(-0.02 * np.arange(300))])
    rows = "\n".join(f"{t:.2f} {v:.5f}" for t, v in spectrum)
    with pytest.raises(InputError, match="never changes its sign"):
        read(rows, unit="g")
    # T is a time to some, and a period to others.
    with pytest.raises(InputError, match="never changes its sign"):
        read(f"T [s]; A [g]\n{rows.replace(' ', ';')}")
    assert read(f"time [s]; A [g]\n{rows.replace(' ', ';')}").time.size == 300
    periods = np.geomspace(0.01, 4.0, 100)
    rows = "\n".join(f"{t:.4f} {np.sin(k):.5f}" for k, t in enumerate(periods))
    with pytest.raises(InputError, match="two columns, of which the first is no time"):
        read(rows, unit="g")
    assert read(f"time [s] acceleration [g]\n{rows}").time.size == 100


# Units


@pytest.mark.parametrize(
    ("header", "unit"),
    [
        ("Beschleunigung [m/s2]", "m/s^2"),
        ("Aceleración (cm/s²)", "cm/s^2"),
        ("ivme (g)", "g"),
        ("ag(g)", "g"),
        ("(%G)", "%g"),
        ("acc [mg]", "mg"),
        ("ускорение, см/с²", "cm/s^2"),
        ("加速度(ｇａｌ)", "cm/s^2"),
        ("ivme (cm/sn2)", "cm/s^2"),
        ("units: metres per second squared", "m/s^2"),
        ("in cm·s⁻²", "cm/s^2"),
        ("aceleración en g", "g"),
    ],
)
def test_a_bracket_says_the_unit_whatever_the_word(header, unit):
    assert unit_of([header]) == unit
    text = f"{header}\n{along(1, form='.5f')}"
    motion = read(text, time_step=0.005)
    assert motion.units_as_read == unit
    # A contradiction is refused, agreement is not.
    other = "m/s^2" if unit != "m/s^2" else "cm/s^2"
    with pytest.raises(InputError, match=r"is not what a\.V2 states"):
        read(text, time_step=0.005, unit=other)
    assert read(text, time_step=0.005, unit=unit).pga == motion.pga


def test_parts_of_g_are_what_they_say():
    for unit, share in (("%g", 0.01), ("mg", 0.001)):
        text = f"acceleration [{unit}]\ndt: 0.005\n{along(1, form='.5f')}"
        assert read(text).pga == pytest.approx(share * G * np.abs(WAVE).max())


@pytest.mark.parametrize("header", ["acceleration [g] or [cm/s2]", "units: g\ntime [s], acceleration [cm/s2]"])
def test_two_units_are_neither_guessed_nor_outvoted(header):
    text = f"{header}\n{down(WAVE)}"
    with pytest.raises(InputError, match="does not state its unit"):
        read(text)
    with pytest.raises(InputError, match="is not what"):
        read(text, unit="ft/s^2")
    assert read(text, unit="cm/s^2").pga == pytest.approx(0.01 * np.abs(WAVE).max())


@pytest.mark.parametrize(
    ("peak", "units"),
    [(0.3, ["g", "m/s^2"]), (3.4, ["m/s^2", "%g"]), (19.4, ["m/s^2", "cm/s^2", "%g"]), (340.0, ["cm/s^2", "mm/s^2"])],
)
def test_a_hint_names_each_unit_in_which_a_peak_is_that_of_an_earthquake(peak, units):
    """From 0.005 g to 3 g: 0.3 is 0.3 g or 0.03 g, and no hint is ten times off without its alternative."""
    with pytest.raises(InputError) as caught:
        read("dt: 0.01\n" + along(1, peak / np.abs(WAVE).max() * WAVE, form=".5f"))
    assert str(caught.value).endswith("unit = " + " or ".join(f'"{unit}"' for unit in units))


# Commas, digits, names


def test_decimal_commas_of_one_column_are_read_and_said():
    motion = read("acceleration [m/s2]\ndt: 0,005 s\n" + along(1, form=".3f").replace(".", ","))
    assert motion.acceleration == pytest.approx(WAVE, abs=5.1e-4)
    assert motion.dt == pytest.approx(0.005)
    assert "decimal commas read" in motion.processing


def test_one_column_of_commas_may_be_two_columns_or_thousands():
    counted = read("units: gal\n" + "".join(f"{k},{v}\n" for k, v in enumerate(range(-20, 20))), time_step=0.01)
    assert counted.acceleration[:2] == pytest.approx([-0.20, -0.19])
    with pytest.raises(InputError, match="can be read in two ways"):
        read("units: gal\ndt: 0.01\n1,250\n-1,300\n1,100\n")


@pytest.mark.parametrize("step", [0.005, 1.0 / 128.0, 1.0 / 300.0, 0.0025, 0.004])
@pytest.mark.parametrize("form", [".2f", ".3f", ".3e"])
def test_times_with_too_few_digits_are_equal_steps(step, form):
    """A repeated time is a jump by itself: PGD was twice too large."""
    count = 3000
    wave = np.hanning(count) * np.sin(2.0 * np.pi * 1.5 * step * np.arange(count))
    rows = "".join(f"{step * k:{form}} {v:.6f}\n" for k, v in enumerate(wave))
    motion = read(f"time [s] acceleration [m/s2]\n{rows}")
    right = read("units: m/s2\n" + "".join(f"{v:.6f}\n" for v in wave), time_step=step)
    assert motion.dt == pytest.approx(step, rel=1e-12)
    assert motion.pgd == pytest.approx(right.pgd, rel=1e-9)
    printed = np.array([float(f"{step * k:{form}}") for k in range(count)])
    uneven = np.ptp(np.diff(printed)) > 1e-9
    assert any("too few digits" in text for text in motion.processing) == uneven


def test_times_that_repeat_without_being_rounded_ones_are_refused():
    """Steps of 0, 0.01 and 0.02 s by chance: no equal steps were rounded to them."""
    times = np.cumsum(np.random.default_rng(3).choice([0.0, 0.01, 0.01, 0.02], 400))
    rows = "".join(f"{t:.2f} {np.sin(k):.4f}\n" for k, t in enumerate(times))
    with pytest.raises(InputError, match="times that repeat the one before"):
        read(f"time [s] acceleration [g]\n{rows}")


def test_missing_rows_are_missing_even_where_times_are_rounded():
    rows = [f"{k / 300.0:.3f} {np.sin(0.3 * k):.4f}\n" for k in range(600)]
    with pytest.raises(InputError):
        read("time [s] acceleration [g]\n" + "".join(rows[:200] + rows[320:]), time_step=1.0 / 300.0)


def test_a_step_that_contradicts_the_times_is_refused_wherever_it_stands():
    text = f"time [s] acceleration [m/s2]\n{down(WAVE)}"
    assert read(text, time_step=0.005).dt == pytest.approx(0.005)
    with pytest.raises(InputError, match=r"is not what the file states, 0.005 s"):
        read(text, time_step=0.01)


@pytest.mark.parametrize(
    ("line", "names"),
    [
        ("time [s] UD [gal] NS [gal] EW [gal]", ["time [s]", "UD [gal]", "NS [gal]", "EW [gal]"]),
        ("t(s) NS EW UD", ["t(s)", "NS", "EW", "UD"]),
        ("Zeit [s];Kanal A;Kanal B;Kanal C", ["Zeit [s]", "Kanal A", "Kanal B", "Kanal C"]),
        ('"time","left abutment","crest","right abutment"', ["time", "left abutment", "crest", "right abutment"]),
        ("N-S  E-W  U-D  N45E", ["N-S", "E-W", "U-D", "N45E"]),
        ("No. time[s] NS[g] EW[g]", ["No.", "time[s]", "NS[g]", "EW[g]"]),
        ("the record of NS", None),
        ("NS and EW components", None),
        ("ACC TIME HISTORY (G)", None),
        ("Acceleration in the valley", None),
    ],
)
def test_names_are_names_only_where_they_could_be(line, names):
    assert names_of([line], 4) == names
    assert table_in([line], 4) is None


def test_numbers_of_rows_in_front_are_no_channel():
    rows = "".join(f"{k + 1} {0.005 * k:.3f} {v:.5f} {-v:.5f}\n" for k, v in enumerate(WAVE))
    ns, ew = channels(f"No. time[s] NS[m/s2] EW[m/s2]\n{rows}")
    assert (ns.component, ew.component) == ("NS", "EW")
    assert ew.acceleration == pytest.approx(-WAVE, abs=1e-9)
    assert ns.dt == pytest.approx(0.005)


def test_a_table_of_japan_has_the_rate_of_its_header():
    text = "SITE CODE= 00000 Nowhere,,\nLAT.=  35.0,,\nSAMPLING RATE= 50Hz,,\nUNIT  = gal(cm/s/s),,\n"
    text += "INITIAL TIME = 1980 01 01 20 00 00,,\nNS,EW,UD\n"
    rows = "".join(f"{v:.3f},{0.5 * v:.3f},{-v:.3f}\n" for v in 100.0 * WAVE)
    three = channels(text + rows)
    assert [motion.component for motion in three] == ["NS", "EW", "UD"]
    assert three[0].dt == pytest.approx(0.02)
    assert three[0].acceleration == pytest.approx(WAVE, abs=6e-6)
    assert (three[0].station, three[0].date) == ("00000 Nowhere", "1980 01 01 20 00 00")
    assert three[0].warnings == ()


# Factors, workbooks


def test_a_factor_of_a_header_is_applied_only_as_the_user_says(tmp_path):
    (tmp_path / "a.txt").write_text(f"# scale factor: 0.5\n{UNIT}{along(1, form='.5f')}")
    peak = float(np.abs(WAVE).max())
    with pytest.raises(InputError, match=r"has the factor 0.5.*say in motion.factor what they are multiplied by"):
        read_record(tmp_path / "a.txt")
    assert read_record(tmp_path / "a.txt", factor=0.5).pga == pytest.approx(0.5 * peak)
    assert read_record(tmp_path / "a.txt", factor=1.0).pga == pytest.approx(peak)
    with pytest.raises(InputError, match=r"neither 1 nor what the header of a.txt states, 0.5"):
        read_record(tmp_path / "a.txt", factor=3.0)
    (tmp_path / "b.txt").write_text(f"{UNIT}{along(1, form='.5f')}")
    with pytest.raises(InputError, match=r"b.txt, whose header has no factor"):
        read_record(tmp_path / "b.txt", factor=3.0)


def test_a_workbook_is_refused_in_one_clear_sentence(tmp_path):
    with zipfile.ZipFile(tmp_path / "a.xlsx", "w") as book:
        for name in ("[Content_Types].xml", "xl/workbook.xml", "xl/worksheets/sheet1.xml"):
            book.writestr(name, "<x/>")
    with zipfile.ZipFile(tmp_path / "a.ods", "w") as book:
        book.writestr("mimetype", "application/vnd.oasis.opendocument.spreadsheet")
    (tmp_path / "a.xls").write_bytes(b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(600))
    for name in ("a.xlsx", "a.ods", "a.xls"):
        with pytest.raises(InputError, match=r"is a workbook of a spreadsheet program.*save the sheet.*as CSV"):
            read_record(tmp_path / name)


@pytest.mark.parametrize(
    ("head", "width"),
    [
        ("160", 1),
        ("160 0.01", 1),
        ("A title\n160, 0.01", 8),
        ("160\n0.01", 1),
        ("160\n0.01", 5),
        ("A title\n160 .01", 4),
    ],
)
def test_a_count_in_front_of_the_values_is_none_of_them(head, width):
    """As programs for building structures write them; a count of 160 would be a peak of 160 cm/s2 at the start."""
    rows = "\n".join(" ".join(f"{v:.6f}" for v in GAL[k : k + width]) for k in range(0, GAL.size, width))
    options = Options(unit="gal", time_step=0.01)
    motion = read_text(f"{head}\n{rows}\n".encode(), "a.txt", options=options)
    assert motion.acceleration == pytest.approx(0.01 * GAL, abs=1e-7)
    assert motion.dt == pytest.approx(0.01)


def test_a_wrong_count_in_front_of_the_values_is_refused():
    rows = "\n".join(f"{v:.6f}" for v in GAL)
    with pytest.raises(InputError, match="states 130 values and has 160"):
        read_text(f"130\n{rows}\n".encode(), "a.txt", options=Options(unit="gal", time_step=0.01))


@pytest.mark.parametrize("name", ["Arias (%)", "Husid", "cumulative energy"])
def test_what_grows_all_through_is_no_acceleration(name):
    rows = "\n".join(f"{0.01 * k:g}, {k / 160:.4f}" for k in range(160))
    with pytest.raises(InputError, match="is a cumulative record"):
        read_text(f"time (s), {name}\n{rows}\n".encode(), "a.txt", options=Options(unit="g"))
