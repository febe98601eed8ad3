"""Numbers with units: what is read, what is refused, and in which words."""

import contextlib
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import TypeAdapter

from heeltoe.case.quantities import AccelerationField, DimensionlessNumber, Length
from heeltoe.errors.error import InputError
from heeltoe.units.parse import (
    _USUAL,
    DIMENSIONS,
    STANDARD_GRAVITY,
    Acceleration,
    _converted,
    acceleration_unit,
    parse,
    parse_acceleration,
)


@pytest.mark.parametrize(
    ("text", "dimension", "expected"),
    [
        ("100 m", "length", 100.0),
        ("95m", "length", 95.0),
        (" 95 m ", "length", 95.0),
        ("328 ft", "length", 328 * 0.3048),
        ("-2.5e3 mm", "length", -2.5),
        (".5 m", "length", 0.5),
        ("2650 kg/m^3", "density", 2650.0),
        ("2650 kg/m3", "density", 2650.0),
        ("2650 kg/m³", "density", 2650.0),
        ("2.65 t/m^3", "density", 2650.0),
        ("2.65 tonne/m^3", "density", 2650.0),
        ("0.075 short_ton/ft^3", "density", 150 * 0.45359237 / 0.3048**3),
        ("15 metric_ton_force/m", "line force", 15e3 * STANDARD_GRAVITY),
        ("150 lb/ft^3", "density", 150 * 0.45359237 / 0.3048**3),
        ("20 GPa", "pressure", 20e9),
        ("150 pcf", "density", 150 * 0.45359237 / 0.3048**3),
        ("0.15 kcf", "density", 150 * 0.45359237 / 0.3048**3),
        ("2000 psf", "pressure", 2000 * 4.4482216152605 / 0.3048**2),
        ("2 ksf", "pressure", 2000 * 4.4482216152605 / 0.3048**2),
        ("2 tsf", "pressure", 2 * 2000 * 4.4482216152605 / 0.3048**2),
        ("35 % g", "acceleration", 0.35 * STANDARD_GRAVITY),
        ("3 ksi", "pressure", 3000 * 4.4482216152605 / 0.0254**2),
        ("3000 lb/in^2", "pressure", 3000 * 4.4482216152605 / 0.0254**2),
        ("5 kips/ft", "line force", 5e3 * 4.4482216152605 / 0.3048),
        ("100 J/m^2", "fracture energy", 100.0),
        ("7 lb/ft", "fracture energy", 7.0 * 4.4482216152605 / 0.3048),
        ("5 klf", "line force", 5e3 * 4.4482216152605 / 0.3048),
        ("5000 plf", "line force", 5e3 * 4.4482216152605 / 0.3048),
        ("5000 lbs/ft", "line force", 5e3 * 4.4482216152605 / 0.3048),
        ("7 klf/ft", "stiffness", 7e3 * 4.4482216152605 / 0.3048**2),
        ("32.2 ft/s2", "acceleration", 32.2 * 0.3048),
        ("4 Mpsi", "pressure", 4e6 * 0.45359237 * 9.80665 / 0.0254**2),
        ("30s", "duration", 30.0),
        ("0.2 ms", "duration", 2e-4),
        ("2 min", "duration", 120.0),
        ("9.81 m/s^2", "acceleration", 9.81),
        ("9.81 m/s2", "acceleration", 9.81),
        ("9.81 m/s/s", "acceleration", 9.81),
        ("2 g", "acceleration", 2 * STANDARD_GRAVITY),
        (1.2, "number", 1.2),
        (3, "number", 3.0),
        ("1.2", "number", 1.2),
        ("5 %", "number", 0.05),
        ("5percent", "number", 0.05),
    ],
)
def test_read(text, dimension, expected):
    assert parse(text, dimension, "f") == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize(
    ("value", "dimension", "message"),
    [
        (12, "length", 'crack.elevation: 12 has no unit; write for example "12 m"'),
        (0.5, "duration", 'crack.elevation: 0.5 has no unit; write for example "0.5 s"'),
        ("12", "length", 'crack.elevation: "12" has no unit; write for example "12 m"'),
        (math.nan, "length", 'crack.elevation: NaN has no unit; write for example "100 m"'),
        ("12 kg", "length", 'crack.elevation: "12 kg" is not a length; write for example "100 m"'),
        (
            "24 kN/m^3",
            "density",
            'crack.elevation: "24 kN/m^3" is a weight for each volume, not a density',
        ),
        # pint alone reads the next two as 15 m and 1000 m.
        ("1,5 m", "length", 'crack.elevation: "1,5 m" is not a length; write for example "100 m"'),
        ("1,000 m", "length", 'crack.elevation: "1,000 m" is not a length; write for example "100 m"'),
        ("12 furlings", "length", 'has the unknown unit "furlings"; write for example "100 m"'),
        ("1e999 m", "length", '"1e999 m" is not a finite number; write for example "100 m"'),
        ("1e308 km", "length", '"1e308 km" is not a finite number; write for example "100 m"'),
        ("nan m", "length", "is not a length"),
        ("m", "length", "is not a length"),
        ("", "length", '"" is not a length'),
        (None, "length", "null is not a length"),
        (True, "length", "true is not a length"),
        ([1, 2], "length", "[1, 2] is not a length"),
        ("4 m + 3 m", "length", "has the unknown unit"),
        ("3 2 m", "length", "is not a length"),
        ("2 m/0", "length", "has the unknown unit"),
        ("20 kg", "acceleration", "is not an acceleration"),
        ("9 mg", "acceleration", "is not an acceleration"),
        (math.inf, "number", "is not a finite number; write for example 1.0"),
        (10**400, "number", "is not a finite number"),
        (True, "number", "true is not a number"),
        # 907 kg to pint: a tenth less than most who write it mean.
        ("2.65 ton/m^3", "density", 'may mean the metric ton of 1000 kg or the one of 2000 lb; write "t" (or "tonne")'),
        ("2.65 tons / m^3", "density", "may mean the metric ton"),
        ("2 kton/m^3", "density", "may mean the metric ton"),
        ("15 ton_force/m", "line force", "may mean the metric ton"),
        ("15 force_ton/m", "line force", "may mean the metric ton"),
        ("20 mPa", "pressure", "counts in thousandths, by a small m; write a large M for millions"),
        ("1.5 mN/m", "line force", "counts in thousandths"),
        ("2.4 mt/m^3", "density", "counts in thousandths"),
        # Digits of other scripts.
        ("\u0661\u0660 m", "length", "is not a length"),
        ("\uff11\uff10 m", "length", "is not a length"),
        # An angle is no number, although pint takes it for one.
        ("45 deg", "number", '"45 deg" is not a number; write for example 1.0'),
    ],
)
def test_refused(value, dimension, message):
    with pytest.raises(InputError) as caught:
        parse(value, dimension, "crack.elevation")
    assert message in str(caught.value)
    assert str(caught.value).startswith("crack.elevation: ")


def test_g_is_gravity_of_the_case():
    assert parse_acceleration("0.4g", "f") == Acceleration(0.4, in_g=True)
    assert parse_acceleration("0.4 g", "f").si(9.81) == pytest.approx(3.924)
    assert parse_acceleration("3.924 m/s^2", "f").si(1.62) == pytest.approx(3.924)


def test_per_cent_of_g():
    assert parse_acceleration("35 %g", "") == Acceleration(0.35, in_g=True)


def test_gal_is_no_gallon():
    assert parse_acceleration("981 gal", "f").si(1.0) == pytest.approx(9.81)
    assert acceleration_unit("cm/s^2", "f").si(1.0) == pytest.approx(0.01)
    assert acceleration_unit("g", "f") == Acceleration(1.0, in_g=True)


def test_example_of_each_kind_can_be_read():
    for dimension, known in DIMENSIONS.items():
        assert parse(known.example, dimension, "f") > 0.0


@given(st.floats(allow_nan=False, allow_infinity=False), st.booleans())
def test_acceleration_written_and_read_again(value, in_g):
    acceleration = Acceleration(value, in_g)
    assert parse_acceleration(str(acceleration), "f") == acceleration


@given(
    st.one_of(st.text(), st.from_regex(r"[0-9.e+-]{1,9} ?[a-z^*/()%0-9 .-]{0,12}")),
    st.sampled_from(list(DIMENSIONS)),
)
def test_any_text_is_read_or_refused_in_words(text, dimension):
    # Whatever else is raised fails the test.
    with contextlib.suppress(InputError):
        assert math.isfinite(parse(text, dimension, "f"))


def test_pydantic_types():
    length = TypeAdapter(Length)
    assert length.validate_python("2 ft") == pytest.approx(0.6096)
    assert length.dump_json(95.0) == b'"95.0 m"'
    for kind, type_, quantity, example in (
        (Length, "string", "length", "100 m"),
        (AccelerationField, "string", "acceleration", "0.4 g"),
        (DimensionlessNumber, ["number", "string"], "number", 1.0),
    ):
        assert TypeAdapter(kind).json_schema() == {"type": type_, "quantity": quantity, "examples": [example]}
    with pytest.raises(ValueError, match="12 has no unit"):
        length.validate_python(12)


@pytest.mark.parametrize(("target", "units"), _USUAL.items())
def test_usual_units_are_those_of_pint(target, units):
    assert {unit: _converted(unit, target) for unit in units} == units


def test_the_minus_of_printed_tables_is_a_minus():
    assert parse("\u22127 m", "length", "here") == -7.0
    assert parse_acceleration("\u22120.2 g", "here").si(9.81) == pytest.approx(-1.962)


@pytest.mark.parametrize(
    ("text", "density"), [("24 kN/m^3", "2447.3"), ("150 lbf/ft^3", "2402.8"), ("0.15 kip/ft^3", "2402.8")]
)
def test_a_weight_for_each_volume_is_refused_with_its_density(text, density):
    """24,000 N over 9.80665 m/s2 are 2447.3 kg; a pound of force for each cubic foot is 16.0185 kg/m3."""
    with pytest.raises(InputError) as refused:
        parse(text, "density", "concrete.density")
    assert refused.value.code == "density-weight"
    assert refused.value.remedy == f'divide it by one g, 9.80665 m/s^2: "{density} kg/m^3"'


@pytest.mark.parametrize(
    "text",
    ["2**3 m", "2 (m*2**2**2)", "2 m*2**300", "2 m^2^2", "2 m**(2**2)", "2 m^300", f"{'1' * 400} m"],
)
def test_a_unit_is_no_sum_that_is_worked_out(text):
    """A power of a number, of a power or of three digits is no unit, and is not worked out to find that."""
    with pytest.raises(InputError):
        parse(text, "length", "crack.elevation")
