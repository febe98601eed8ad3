"""Target spectra, against numbers that follow by hand from the printed equations and tables."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe.errors.error import InputError
from heeltoe.motion.targets import asce_7, en_1998, table, target_of
from heeltoe.study.plan.motions import beside_file

G = 9.81


@pytest.mark.parametrize(
    ("ground", "type_", "period", "expected"),
    [
        # Type 1, ground B: S = 1.2, TB = 0.15 s, TC = 0.5 s, TD = 2 s.
        ("B", 1, 0.0, 1.2),
        ("B", 1, 0.075, 1.2 * (1.0 + 0.5 * 1.5)),  # half way up to the plateau
        ("B", 1, 0.15, 3.0),  # 1.2 * 2.5
        ("B", 1, 0.5, 3.0),
        ("B", 1, 1.0, 1.5),  # 3.0 * 0.5 / 1
        ("B", 1, 2.0, 0.75),
        ("B", 1, 4.0, 0.1875),  # 3.0 * 0.5 * 2 / 16
        # The plateau of each ground type: 2.5 S.
        ("A", 1, 0.4, 2.5),
        ("C", 1, 0.6, 2.875),
        ("D", 1, 0.8, 3.375),
        ("E", 1, 0.5, 3.5),
        ("A", 2, 0.25, 2.5),
        ("B", 2, 0.25, 3.375),
        ("C", 2, 0.25, 3.75),
        ("D", 2, 0.30, 4.5),
        ("E", 2, 0.25, 4.0),
        # Behind the corners, 2.5 S TC / T and 2.5 S TC TD / T^2.
        ("D", 1, 1.0, 2.7),  # 3.375 * 0.8
        ("C", 2, 1.0, 0.9375),  # 3.75 * 0.25
        ("D", 2, 2.0, 0.405),  # 4.5 * 0.3 * 1.2 / 4
    ],
)
def test_en_1998(ground, type_, period, expected):
    assert en_1998(1.0, ground, type_)(period) == pytest.approx(expected, rel=1e-12)


def test_en_1998_damping():
    # eta = sqrt(10 / (5 + 20)) = 0.6325 at 20 %; the plateau is 2.5 eta, and at period zero it is 1 for any damping.
    assert en_1998(1.0, damping=0.20)([0.0, 0.2]) == pytest.approx([1.0, 2.5 * np.sqrt(0.4)])
    assert en_1998(1.0, damping=0.02)(0.2) == pytest.approx(2.5 * np.sqrt(10.0 / 7.0))
    # sqrt(10 / 55) = 0.43 is below the least, 0.55.
    assert en_1998(1.0, damping=0.50)(0.2) == pytest.approx(2.5 * 0.55)


def test_asce_7():
    # S_DS = 1 g, S_D1 = 0.6 g: TS = 0.6 s, T0 = 0.12 s.
    target = asce_7(G, 0.6 * G, 8.0)
    periods = [0.0, 0.06, 0.12, 0.6, 1.0, 2.0, 8.0, 16.0]
    expected = [0.4, 0.7, 1.0, 1.0, 0.6, 0.3, 0.075, 0.6 * 8.0 / 256.0]
    assert target(periods) / G == pytest.approx(expected, rel=1e-12)


def test_table_is_straight_on_logarithmic_axes():
    target = table([0.0, 0.1, 1.0], [1.0, 4.0, 0.4])
    # Between 0.1 s and 1 s it is 0.4 / T.
    assert target([0.0, 0.05, 0.1, 0.2, 0.5, 1.0]) == pytest.approx([1.0, 2.5, 4.0, 2.0, 0.8, 0.4])
    assert table([0.1, 1.0], [4.0, 0.4])(0.2) == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("make", "code"),
    [
        (lambda: en_1998(0.0), "out-of-range"),
        (lambda: en_1998(1.0, "F"), "not-a-choice"),
        (lambda: en_1998(1.0, "A", 3), "not-a-choice"),
        (lambda: en_1998(1.0, damping=5.0), "out-of-range"),
        (lambda: en_1998(1.0)(4.5), "out-of-range"),
        (lambda: en_1998(1.0)(-0.1), "out-of-range"),
        (lambda: en_1998(1.0)(float("nan")), "out-of-range"),
        (lambda: asce_7(1.0, float("nan"), 8.0), "out-of-range"),
        (lambda: asce_7(1.0, 0.6, 0.5), "out-of-range"),
        (lambda: table([1.0, 0.1], [1.0, 1.0]), "target-table"),
        (lambda: table([0.1, 1.0], [1.0, 0.0]), "target-table"),
        (lambda: table([0.1, 1.0], [1.0]), "target-table"),
        (lambda: table([0.1, 1.0], [1.0, 0.5])(2.0), "out-of-range"),
    ],
)
def test_refused(make, code):
    with pytest.raises(InputError) as caught:
        make()
    assert caught.value.code == code


# One spectrum, 0.6 g at 0.2 s and 0.3 g at 1 s, as headings of files have it.
@pytest.mark.parametrize(
    ("heading", "rows"),
    [
        ("# period [s], Sa [g]", ((0.2, 0.6), (1.0, 0.3))),
        ("T,Sa [g]", ((0.2, 0.6), (1.0, 0.3))),
        ("T [ms];Sa [g]", ((200.0, 0.6), (1000.0, 0.3))),
        ("frequency [Hz], Sa [g]", ((1.0, 0.3), (5.0, 0.6))),
        ("Frequency Sa (g)", ((1.0, 0.3), (5.0, 0.6))),
        ("f (1/s)\tPSA (m/s2)", ((1.0, 0.3 * 9.80665), (5.0, 0.6 * 9.80665))),
    ],
)
def test_headings_say_what_the_first_column_of_a_table_holds(tmp_path, heading, rows):
    lines = [heading, *(f"{first} {second}" for first, second in rows)]
    (tmp_path / "a.txt").write_text("\n".join(lines) + "\n")
    target = target_of(str(tmp_path / "a.txt"), "--match")
    assert [target(0.2), target(1.0)] == pytest.approx([0.6 * 9.80665, 0.3 * 9.80665], rel=1e-12)


@pytest.mark.parametrize("heading", ["log10(T [s]), Sa [g]", "T [s], ln Sa [g]", "log T, Sa (g)"])
def test_logarithms_are_refused(tmp_path, heading):
    """Of a table by which a thousandth of a second and 3 s change places."""
    (tmp_path / "a.txt").write_text(f"{heading}\n-1 0.3\n0.5 0.6\n1 0.4\n")
    with pytest.raises(InputError) as refused:
        target_of(str(tmp_path / "a.txt"), "--match")
    assert refused.value.code == "heading-logarithm"


@pytest.mark.parametrize(
    ("heading", "damping"),
    [("T [s], Sa [g]", 0.05), ("# damping 2 %\nT [s], Sa [g]", 0.02), ("T [s], Sa [g] at 7.5% damping", 0.075),
     ("# damping = 0.1\nT [s], Sa [g]", 0.1), ("# 3 % of critical damping\nT [s], Sa [g]", 0.03)],
)  # fmt: skip
def test_a_heading_states_the_damping(tmp_path, heading, damping):
    (tmp_path / "a.txt").write_text(f"{heading}\n0.1 0.3\n1 0.6\n")
    assert target_of(str(tmp_path / "a.txt"), "--match").damping == pytest.approx(damping)


def test_rows_below_zero_are_rows(tmp_path):
    (tmp_path / "a.txt").write_text("T [s], Sa [g]\n-1 0.3\n0.5 0.6\n1 0.4\n")
    with pytest.raises(InputError) as refused:
        target_of(str(tmp_path / "a.txt"), "--match")
    assert refused.value.code == "target-table"


@pytest.mark.parametrize("heading", ["frequency [rad/s], Sa [g]", "period [Hz], Sa [g]"])
def test_a_column_that_holds_no_periods_is_refused(tmp_path, heading):
    (tmp_path / "a.txt").write_text(f"{heading}\n1 0.3\n5 0.6\n")
    with pytest.raises(InputError) as refused:
        target_of(str(tmp_path / "a.txt"), "--match")
    assert refused.value.code == "target-column"


GENERATED = "#,,,,\"generated_by='OpenQuake engine 3.26.0', start_date='2026-03-03T07:30:49', checksum=1{}\"\n"
PERIODS = (0.0, 0.1, 0.3, 1.0)
UNIFORM = {0.002105: (0.3, 0.7, 0.6, 0.2), 0.000404: (0.5, 1.2, 1.0, 0.35)}


def exported(kind="uniform", sites=1, spectra=UNIFORM):
    """Files in the forms of OpenQuake's exports, with numbers of our own."""
    if kind == "uniform":
        names = [f"{poe:.6f}~{f'SA({t})' if t else 'PGA'}" for poe in spectra for t in PERIODS]
        row = ",".join(f"{value:.6E}" for values in spectra.values() for value in values)
        head = GENERATED.format(", kind='mean', investigation_time=1.0")
        return head + ",".join(["lon,lat", *names]) + f"\n10.00000,45.00000,{row}" * sites + "\n"
    if kind == "conditional":
        rows = [
            f"{poe:.5E},mean,{t:.5E},{value:.5E},{0.3:.5E}"
            for poe, values in spectra.items()
            for t, value in zip(PERIODS, values, strict=True)
        ]
        return "\n".join([GENERATED.format(", site_id=0") + "poe,stat,period,mea,std", *rows, ""])
    rows = [
        f"{t:.5E},{','.join(f'{values[k]:.5E},{0.0 if t == 0.3 else 0.4:.5E}' for values in spectra.values())}"
        for k, t in enumerate(PERIODS)
    ]
    levels = ", ".join(repr(values[2]) for values in spectra.values())
    head = GENERATED.format(f", imls=[{levels}], site_id=0")
    return "\n".join([head + "sa_period,val0,std0,val1,std1", *rows, ""])


@pytest.mark.parametrize(
    ("kind", "wanted"),
    [("uniform", "0.002105"), ("uniform", "2.105e-3"), ("conditional", "0.000404"), ("early", "1"), ("early", "0.6 g")],
)
def test_spectra_of_openquake_are_targets(tmp_path, kind, wanted):
    """Periods, values and their unit, g, as engine/3.26's exporters write them (openquake.calculators.export.hazard):
    peaks of the ground are those of a period of zero."""
    file = tmp_path / "spectrum.csv"
    file.write_text(exported(kind).replace("\n", "\r\n"), newline="")
    target = target_of(f"{file}#{wanted}", "--match")
    own = UNIFORM[0.000404 if wanted in ("0.000404", "1") else 0.002105]
    assert target(PERIODS) == pytest.approx([9.80665 * value for value in own], rel=1e-6)
    assert (target.shortest, target.longest) == (0.0, 1.0)
    if kind == "uniform":
        assert target.name == "spectrum, uniform hazard spectrum of 0.002105 in 1 year"
    with pytest.raises(InputError, match="has several spectra"):
        target_of(str(file), "--match")


def test_a_median_spectrum_of_openquake_is_a_target(tmp_path):
    rows = "\n".join(f"{t:.5E},{value:.5E},-1.0,0.5,1.0" for t, value in zip(PERIODS, UNIFORM[0.002105], strict=True))
    (tmp_path / "a.csv").write_text(f"{GENERATED.format(', poe=0.002105')}period,spec,mea,sig,wei\n{rows}\n")
    assert target_of(str(tmp_path / "a.csv"), "--match")(0.3) == pytest.approx(0.6 * 9.80665)


def test_a_level_that_nothing_reaches_ends_a_spectrum(tmp_path):
    (tmp_path / "a.csv").write_text(exported(spectra={0.01: (0.3, 0.7, 0.6, 0.0)}))
    assert target_of(str(tmp_path / "a.csv"), "--match").longest == 0.3


@pytest.mark.parametrize(
    ("content", "code"),
    [
        (exported(sites=3), "several"),
        (exported().replace("kind='mean'", "kind='std'"), "target-spread"),
        (exported("early").replace("imls=[0.6", "imls=[0.5"), "target-level"),
        (GENERATED.format("") + "lon,lat,vs30\n1,2,3\n", "target-table"),
        (GENERATED.format("") + "lon,lat,0.1~PGA\n1,2,often\n", "target-table"),
        (exported("conditional").replace(",mean,", ",rlz-000,", 1).replace(",mean,", ",rlz-001,"), "several"),
    ],
)
def test_what_is_no_spectrum_of_openquake_is_refused(tmp_path, content, code):
    """Before 3.17 the engine exported the exponential of the level at the conditioning period, 2.718 g for 1 g: the
    expected file of its own case 1 of then."""
    (tmp_path / "a.csv").write_text(content)
    with pytest.raises(InputError) as refused:
        target_of(f"{tmp_path / 'a.csv'}#0.002105" if code == "target-level" else str(tmp_path / "a.csv"), "--match")
    assert refused.value.code == code


def test_a_suite_takes_the_file_beside_its_case(tmp_path):
    (tmp_path / "uhs.csv").write_text(exported())
    assert beside_file("uhs.csv#0.000404", tmp_path) == f"{tmp_path / 'uhs.csv'}#0.000404"
    assert beside_file("en1998:0.3g,B", tmp_path) == "en1998:0.3g,B"
