"""Target spectra, against numbers that follow by hand from the printed equations and tables."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe.errors.error import InputError
from heeltoe.motion.targets import asce_7, en_1998, table, target_of

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
        (lambda: en_1998(0.0), "target-value"),
        (lambda: en_1998(1.0, "F"), "target-ground"),
        (lambda: en_1998(1.0, "A", 3), "target-type"),
        (lambda: en_1998(1.0, damping=5.0), "target-value"),
        (lambda: en_1998(1.0)(4.5), "target-period"),
        (lambda: en_1998(1.0)(-0.1), "target-period"),
        (lambda: en_1998(1.0)(float("nan")), "target-period"),
        (lambda: asce_7(1.0, float("nan"), 8.0), "target-value"),
        (lambda: asce_7(1.0, 0.6, 0.5), "target-value"),
        (lambda: table([1.0, 0.1], [1.0, 1.0]), "target-table"),
        (lambda: table([0.1, 1.0], [1.0, 0.0]), "target-table"),
        (lambda: table([0.1, 1.0], [1.0]), "target-table"),
        (lambda: table([0.1, 1.0], [1.0, 0.5])(2.0), "target-period"),
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


@pytest.mark.parametrize("heading", ["frequency [rad/s], Sa [g]", "period [Hz], Sa [g]"])
def test_a_column_that_holds_no_periods_is_refused(tmp_path, heading):
    (tmp_path / "a.txt").write_text(f"{heading}\n1 0.3\n5 0.6\n")
    with pytest.raises(InputError) as refused:
        target_of(str(tmp_path / "a.txt"), "--match")
    assert refused.value.code == "target-column"
