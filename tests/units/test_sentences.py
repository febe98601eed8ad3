"""Sentences that hold quantities, in SI and in the units of the United States."""

from __future__ import annotations

import re

import pytest

from heeltoe.units.sentences import UNITS, Sentence, numbers, quantity, written


@pytest.mark.parametrize(
    ("value", "form", "si", "us"),
    [
        # To as many digits as the format gives in SI.
        (0.0123456, ".4g mm", "12.35 mm", "0.486 in"),
        (0.268, ".3g m/s", "0.268 m/s", "0.879 ft/s"),
        (1.2e6, ".3g MPa", "1.2 MPa", "174 psi"),
        (20e9, "g GPa", "20 GPa", "2901 ksi"),
        (2.65e6, ".4g kN/m", "2650 kN/m", "181.6 kip/ft"),
        (2400.0, "g kg/m^3", "2400 kg/m^3", "149.8 lb/ft³"),
        (3.5e6, ".3g MJ/m", "3.5 MJ/m", "787 ft-kip/ft"),
        (9.80665, ".6g m/s²", "9.80665 m/s²", "32.174 ft/s²"),
        # What is written in full in SI says no less elsewhere.
        (5.0, "g m", "5 m", "16.4 ft"),
        (100.0, "g m", "100 m", "328.1 ft"),
        (0.2, "g m", "0.2 m", "7.874 in"),
        # As fine as the decimals in SI.
        (29.604, ".2f m", "29.60 m", "97.13 ft"),
        (0.15, ".2f m", "0.15 m", "5.9 in"),
        (65.76e6, ".3f MN/m", "65.760 MN/m", "4506.0 kip/ft"),
        (-2e-12, "z.3f MPa", "0.000 MPa", "0.0 psi"),
        # Without an exponent where people would write none, and without what rounding leaves.
        (1.0, ".2g %", "100 %", "100 %"),
        (184.6, ".4g mm", "184.6 m", "605.6 ft"),
        (1.4612, ".1f mm", "1.46 m", "57.528 in"),
        ((0.1, 1.5), ".4g mm|to", "0.1 to 1.5 m", "3.937 to 59.06 in"),
        (6.98e-10, ".3g MPa", "0 MPa", "0 psi"),
        # The same everywhere.
        (0.012, ".3g ms", "12 ms", "12 ms"),
        (0.6667, ".2g %", "67 %", "67 %"),
        (0.4, ".3g g", "0.4 g", "0.4 g"),
        (1.2345, ".3f", "1.234", "1.234"),
        (3, "d", "3", "3"),
        # Several at once share a unit.
        ((1.6e-4, 0.0572), ".4g mm|to", "0.16 to 57.2 mm", "0.006299 to 2.252 in"),
        ((20e9, 200e9, 2e12), "g GPa", "20, 200 and 2000 GPa", "2901, 29008 and 290075 ksi"),
    ],
)
def test_quantities(value, form, si, us):
    assert quantity(value, form) == si
    assert quantity(value, form, "us") == us


@pytest.mark.parametrize("unit", UNITS)
def test_what_is_written_is_what_it_was(unit):
    """The number that stands there, times its unit, is the quantity."""
    inch, foot, pound, force = 0.0254, 0.3048, 0.45359237, 4.4482216152605
    units = {
        "in": inch,
        "ft": foot,
        "ft²": foot**2,
        "ft/s": foot,
        "ft/s²": foot,
        "psi": force / inch**2,
        "ksi": 1e3 * force / inch**2,
        "kip/ft": 1e3 * force / foot,
        "kip/ft²": 1e3 * force / foot**2,
        "ft-kip/ft": 1e3 * force,
        "lb/ft³": pound / foot**3,
        "ton/ft": 2e3 * pound / foot,
    }
    for value in (1.234567, 0.0345678, -876.5432):
        number, name = re.fullmatch(r"(\S+) (\S+)", quantity(value, f".6g {unit}", "us")).groups()
        assert float(number) * units[name] == pytest.approx(value, rel=1e-5)


def test_sentences_within_sentences():
    inner = Sentence.of("it slides {slip_m:.3g mm}", slip_m=0.0254)
    outer = Sentence.of('{what} at "{place}": write points = [[0, "95 m"]]', what=inner, place="{5 m}")
    # Words stay as they are, whatever stands in them: they may be meant to be copied.
    assert str(outer) == 'it slides 25.4 mm at "{5 m}": write points = [[0, "95 m"]]'
    assert outer.text("us") == 'it slides 1 in at "{5 m}": write points = [[0, "95 m"]]'
    assert outer == Sentence.of(outer.template, what=inner, place="{5 m}")
    assert hash(outer) == hash(Sentence.of(outer.template, what=inner, place="{5 m}"))
    assert written("{a_m:.2f m}", "us", a_m=1.0) == "3.28 ft"


def test_numbers_of_a_row_share_their_unit():
    assert numbers([65.76e6, 0.0], "z.3f MN/m", "us") == (["4506.0", "0.0"], "kip/ft")
    assert numbers([], ".3g m", "us") == ([], "ft")
