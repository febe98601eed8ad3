"""Numbers with units, as people write them (``"95 m"``, ``"0.4 g"``), to numbers in SI units and back."""

from __future__ import annotations

import functools
import math
import re
from dataclasses import dataclass
from numbers import Real
from typing import TYPE_CHECKING, Any, Self

from heeltoe.errors.error import InputError, shown

if TYPE_CHECKING:
    import pint

STANDARD_GRAVITY = 9.80665
"""One g where the case does not say otherwise [m/s^2]."""

# A number, then a unit made of names, powers, products and quotients. pint would read more (sums, "1,5 m" as
# 15 m), and wrongly.
_QUANTITY = re.compile(r"\s*([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)\s*([^\d\s.,+-].{0,39})?", re.DOTALL)
_PARTS = {"": 1.0, "%": 0.01, "percent": 0.01}
_FREQUENCY = re.compile(r"[mkM]?Hz|hertz|1/s|s\^-1")
_MEMORY = re.compile(r"[kMGT]i?B|B")
_ANGLE = re.compile(r"deg|degrees?|°|rad|radians?|mrad")
# 907 kg to pint, 1000 kg to most of the world: a difference of a tenth that no one would see.
_TON = re.compile(
    r"(?<![A-Za-z_])(?:[kM]|kilo|mega)?tons?(?:_force)?(?![A-Za-z_])|(?<![A-Za-z_])force_tons?(?![A-Za-z_])"
)
# A slip of the shift key: stresses and forces of dams are no thousandths.
_MILLI = re.compile(r"(?<![A-Za-z_])m(?:Pa|N|t)(?![A-Za-z_])")
# What engineers of the United States write and pint does not know. A pound on an area or a length is a force to them.
_SHORT = {
    "pcf": "(lb/ft^3)",
    "kcf": "(kilopound/ft^3)",
    "psf": "(lbf/ft^2)",
    "ksf": "(kip/ft^2)",
    # In the United States alone, where a ton is 2,000 pounds.
    "tsf": "(force_ton/ft^2)",
    "plf": "(lbf/ft)",
    "klf": "(kip/ft)",
}
_SHORT_UNIT = re.compile(rf"(?<![A-Za-z_])(?:{'|'.join(_SHORT)})(?![A-Za-z_])")
_POUND = re.compile(r"(?<![A-Za-z_])(?:lbs?|pounds?)(?![A-Za-z_])")
_OF_FORCES = ("pressure", "line force", "fracture energy", "stiffness")
# Weights for each volume, for which densities are often taken.
_WEIGHT = "N/m^3"
# Numbers above this are no accelerations in g.
_LARGEST_IN_G = 10.0
_UNIT = re.compile(r"[A-Za-z%µμ_0-9()*/^²³⁻·. -]+")


# Python reads "1_0" and the digits of all scripts.
_PLAIN = re.compile(r"\s*[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?\s*")
# TOML has "1_000" for a thousand, and would have "1_0" for ten; comments and texts are passed over.
_GROUPED = re.compile(
    r'"""(?:\\.|[^\\])*?"""|"(?:\\.|[^"\\\n])*"|'
    r"'''.*?'''|'[^'\n]*'|#[^\n]*|([+-]?\b[0-9]+(?:_[0-9]+)+\b)",
    re.DOTALL,
)
_THOUSANDS = re.compile(r"[+-]?[0-9]{1,3}(?:_[0-9]{3})+")


def plain_number(text: str) -> float:
    """Return a plain number of a table.

    Raises
    ------
    ValueError
        Where it is none.
    """
    if not _PLAIN.fullmatch(text):
        raise ValueError(text)
    return float(text)


def misgrouped(text: str) -> str | None:
    """Return the first number of a text in TOML whose underscores do not part thousands; None without one."""
    numbers = (match[1] for match in _GROUPED.finditer(text) if match[1])
    return next((number for number in numbers if not _THOUSANDS.fullmatch(number)), None)


# Powers of numbers, of powers and of what is in brackets, and such of three digits: none is a unit, and some would be
# worked out for minutes.
_POWERS = re.compile(r"(?:^|[0-9)²³⁻·*/^. -])\s*(?:\*\*|\^)|(?:\*\*|\^)[\s(+-]*[0-9]{3}")


@dataclass(frozen=True)
class Dimension:
    """A kind of quantity: what people call it, its SI unit and an example."""

    kind: str
    unit: str
    example: str | float


DIMENSIONS = {
    "length": Dimension("a length", "m", "100 m"),
    # How far a dam may slide or open: a plain 100 is one of millimetres.
    "slip": Dimension("a length", "m", "150 mm"),
    "density": Dimension("a density", "kg/m^3", "2400 kg/m^3"),
    "pressure": Dimension("a pressure or modulus", "Pa", "20 GPa"),
    "duration": Dimension("a time", "s", "30 s"),
    "acceleration": Dimension("an acceleration", "m/s^2", "0.4 g"),
    "velocity": Dimension("a velocity", "m/s", "0.5 m/s"),
    "frequency": Dimension("a frequency", "Hz", "0.1 Hz"),
    "angle": Dimension("an angle", "rad", "5 deg"),
    "line force": Dimension("a force per metre of dam", "N/m", "150 kN/m"),
    "fracture energy": Dimension("an energy for each area that cracks", "N/m", "150 N/m"),
    "stiffness": Dimension("a stiffness per metre of dam", "N/m^2", "50 MN/m/m"),
    "wear coefficient": Dimension("a wear coefficient", "m^2/J", "1e-5 m^2/J"),
    "memory": Dimension("a size of memory", "B", "8 GB"),
    "number": Dimension("a number", "", 1.0),
}


# What most cases write: pint takes longer to load than a run of a block.
_USUAL = {
    "m": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "km": 1e3},
    "kg/m^3": {"kg/m^3": 1.0, "kg/m3": 1.0},
    "Pa": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9},
    "s": {"s": 1.0, "ms": 1e-3, "min": 60.0, "h": 3600.0},
    "m/s^2": {"m/s^2": 1.0, "m/s2": 1.0, "cm/s^2": 1e-2, "Gal": 1e-2, "mm/s^2": 1e-3},
    "m/s": {"m/s": 1.0, "cm/s": 1e-2, "mm/s": 1e-3, "km/s": 1e3},
    "Hz": {"Hz": 1.0},
    "rad": {"rad": 1.0, "deg": math.radians(1.0)},
    "N/m": {"N/m": 1.0, "kN/m": 1e3, "MN/m": 1e6},
    "N/m^2": {"MN/m/m": 1e6, "kN/m/m": 1e3},
    "m^2/J": {"m^2/J": 1.0},
    "B": {"B": 1.0, "MB": 1e6, "GB": 1e9},
}


def bound_beside(text: str, bound: float) -> str:
    """Return a bound [SI] in the unit of a quantity that people wrote, for example "10 m" beside "20 m"; a unit that is
    seldom used has the bound in SI."""
    unit = text.strip().lstrip("+-0123456789.eE").strip()
    known = next((units[unit] for units in _USUAL.values() if unit in units), None)
    return f"{bound:g} in SI units" if known is None else f"{bound / known:g} {unit}"


@dataclass(frozen=True)
class Acceleration:
    """An acceleration that remembers whether it was given in g, since one g may differ from case to case.

    Parameters
    ----------
    value
        In m/s^2, or in g.
    in_g
        Whether `value` counts g.
    """

    value: float
    in_g: bool

    def si(self, gravity: float) -> float:
        """Return the acceleration in m/s^2 where one g is `gravity` [m/s^2]."""
        return self.value * gravity if self.in_g else self.value

    def __str__(self) -> str:
        return f"{repr(self.value).removesuffix('.0')} {'g' if self.in_g else 'm/s^2'}"


class InSI(float):
    """A number that is in SI already; shown to people it is the `text`, with its unit, that says the same."""

    text: str

    def __new__(cls, value: float, text: str = "") -> Self:
        number = super().__new__(cls, value)
        number.text = text
        return number

    def __str__(self) -> str:
        return self.text


def parse(value: object, dimension: str, field: str) -> float:
    """Return a quantity in SI units; an acceleration given in g counts standard gravity.

    Parameters
    ----------
    value
        A text such as ``"95m"`` or ``"150 lb/ft^3"``, or an :class:`InSI`; for the dimension ``number`` also a plain
        number.
    dimension
        Key of :data:`DIMENSIONS`.
    field
        Where the value stands, for the error.

    Raises
    ------
    InputError
        Where the value is no finite number, or its unit is missing, unknown, or of another kind.
    """
    if isinstance(value, InSI):
        return float(value)
    if dimension == "acceleration":
        return parse_acceleration(value, field).si(STANDARD_GRAVITY)
    number, unit = _split(value, dimension, field)
    number *= _factor(unit, value, dimension, field)
    return number if math.isfinite(number) else _finite(number, value, dimension, field)


def parse_acceleration(value: object, field: str) -> Acceleration:
    """Return an acceleration; ``g`` means gravity here, not gram. Otherwise as :func:`parse`."""
    if isinstance(value, Acceleration):
        return value
    number, unit = _split(value, "acceleration", field)
    if unit == "g":
        return Acceleration(number, in_g=True)
    if unit.replace(" ", "") == "%g":
        return Acceleration(number / 100.0, in_g=True)
    # Seismologists write gal; to pint that is a gallon.
    factor = _factor("Gal" if unit == "gal" else unit, value, "acceleration", field)
    return Acceleration(_finite(number * factor, value, "acceleration", field), in_g=False)


def acceleration_unit(unit: str, field: str) -> Acceleration:
    """Return what one `unit` (``"g"``, ``"cm/s^2"``, ...) of a record's numbers is; many headers write ``G``, and those
    of small sensors ``mg``, thousandths of g."""
    if unit.strip() == "mg":
        return Acceleration(1e-3, in_g=True)
    return parse_acceleration(f"1 {'g' if unit.strip() == 'G' else unit}", field)


@functools.cache
def _registry() -> pint.UnitRegistry[Any]:
    # Importing pint and building its registry takes longer than all the rest of a rigid run, so they wait for
    # the first unit that is not usual.
    import pint

    return pint.UnitRegistry(cache_folder=None)


def _split(value: object, dimension: str, field: str) -> tuple[float, str]:
    """Take number and unit apart; the unit of a plain number is empty."""
    expected = DIMENSIONS[dimension]
    if isinstance(value, Real) and not isinstance(value, bool):
        if expected.unit:
            raise InputError("unit-missing", field, shown(value), example=_with_unit(value, dimension))
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        return _finite(number, value, dimension, field), ""
    # The minus of printed tables, as our PDFs have it, too.
    match = _QUANTITY.fullmatch(value.replace("\u2212", "-")) if isinstance(value, str) else None
    if match is None:
        raise InputError("wrong-quantity", field, shown(value), kind=expected.kind, example=shown(expected.example))
    unit = (match[2] or "").strip()
    if expected.unit and not unit:
        raise InputError("unit-missing", field, shown(value), example=_with_unit(match[1], dimension))
    return _finite(float(match[1]), value, dimension, field), unit


@functools.lru_cache(maxsize=256)
def _conversion(unit: str, target: str) -> float | None:
    """Return how many `target` one `unit` is; None where they are of different kinds."""
    usual = _USUAL.get(target, {}).get(unit)
    return _converted(unit, target) if usual is None else usual


def _converted(unit: str, target: str) -> float | None:
    """Return the same by way of pint."""
    registry = _registry()
    # "m/s2" is how many people write a square.
    one = registry.Quantity(1.0, registry.parse_units(re.sub(r"(?<=[A-Za-z])([23])\b", r"^\1", unit)))
    return float(one.to(target).magnitude) if one.is_compatible_with(target) else None


def _factor(unit: str, value: object, dimension: str, field: str) -> float:
    expected = DIMENSIONS[dimension]
    if _TON.search(unit):
        raise InputError("unit-ton", field, shown(value))
    if _MILLI.search(unit):
        raise InputError("unit-milli", field, shown(value))
    try:
        if not expected.unit:
            # Not by way of pint, to which a degree is a number too: a friction of "45 deg" is not 0.785.
            factor = _PARTS.get(unit)
        elif dimension == "frequency" and not _FREQUENCY.fullmatch(unit):
            # To pint a radian is 1, so that 1 rad/s would be 1 Hz.
            factor = None
        elif dimension == "memory" and not _MEMORY.fullmatch(unit):
            # To pint bytes are numbers.
            factor = None
        elif dimension == "angle":
            # To pint a per cent is an angle.
            factor = _conversion(unit, expected.unit) if _ANGLE.fullmatch(unit) else None
        elif _UNIT.fullmatch(unit) and not _POWERS.search(unit):
            unit_here = _SHORT_UNIT.sub(lambda match: _SHORT[match[0]], unit)
            factor = _conversion(_pounds_of_force(unit) if dimension in _OF_FORCES else unit_here, expected.unit)
        else:
            raise ValueError
    except Exception:  # pint passes on whatever Python's tokenizer and arithmetic make of a unit it cannot read
        raise InputError(
            "unit-unknown", field, shown(value), unit=shown(unit), example=shown(expected.example)
        ) from None
    if factor is None and dimension == "density" and (weight := _conversion(_pounds_of_force(unit), _WEIGHT)):
        raise InputError("density-weight", field, shown(value), density=_density(value, unit, weight))
    if factor is None:
        raise InputError("wrong-quantity", field, shown(value), kind=expected.kind, example=shown(expected.example))
    return factor


def _pounds_of_force(unit: str) -> str:
    """Return a unit as pint reads it, in which a pound is a force."""
    return _POUND.sub("lbf", _SHORT_UNIT.sub(lambda match: _SHORT[match[0]], unit))


def _density(value: object, unit: str, weight: float) -> str:
    """Return the density [kg/m^3] for a weight per volume, as a case has it."""
    number = float(str(value).replace("\u2212", "-").removesuffix(unit))
    return shown(f"{number * weight / STANDARD_GRAVITY:.5g} kg/m^3")


def _finite(number: float, value: object, dimension: str, field: str) -> float:
    if not math.isfinite(number):
        raise InputError("not-finite", field, shown(value), example=shown(DIMENSIONS[dimension].example))
    return number


def _with_unit(value: object, dimension: str) -> str:
    """Return the user's own number with a unit, unless it is none that could be meant."""
    example = str(DIMENSIONS[dimension].example)
    if dimension == "acceleration" and 9.7 < float(str(value)) < 9.9:
        # That is gravity itself.
        return shown(f"{value} m/s^2")
    if dimension == "acceleration" and abs(number := float(str(value))) > _LARGEST_IN_G:
        # No ground shakes with 35 g; 35 % of g is what people mean.
        percent = f"{number / 100.0:g} g"
        return f"{shown(percent)} or {shown(f'{value} %g')}" if abs(number) <= 100.0 * _LARGEST_IN_G else shown(example)
    return shown(f"{value} {example.split()[-1]}" if math.isfinite(float(str(value))) else example)
