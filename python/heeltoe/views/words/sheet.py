"""The calculation sheet of a load case in numbers that can be added and divided by hand: forces, then step by step."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from heeltoe.models.statics.checks import Check
from heeltoe.models.statics.load_case import LoadCase, along_line
from heeltoe.models.statics.sheet import ForceLine
from heeltoe.units.systems import FOOT, INCH, KIP, POUND_FORCE
from heeltoe.units.write import NOTHING
from heeltoe.views.words.statics import check_cells

# Digits of the largest number of a column; the others have as many behind the point, so that they add up.
_DIGITS = 6
# So many pressures of a crack are told.
_MOST_POINTS = 6


@dataclass(frozen=True)
class SheetUnits:
    """Units whose products and quotients are units of the sheet again: what is multiplied by hand needs no factor.

    Attributes
    ----------
    length, force
        In SI: metres, and newtons per metre of dam.
    names
        Of length, force, moment and stress.
    """

    length: float
    force: float
    names: tuple[str, str, str, str]

    @property
    def moment(self) -> float:
        """In SI."""
        return self.length * self.force

    @property
    def stress(self) -> float:
        """In SI."""
        return self.force / self.length


_SI = SheetUnits(1.0, 1e3, ("m", "kN/m", "kN·m/m", "kPa"))
_US = SheetUnits(FOOT, KIP / FOOT, ("ft", "kip/ft", "kip·ft/ft", "ksf"))
_PSI = POUND_FORCE / INCH**2


def sheet_units(units: str) -> SheetUnits:
    """Return the units of a sheet in SI or in those of the United States."""
    return _US if units == "us" else _SI


@dataclass(frozen=True)
class Lines:
    """The forces of a load case as text.

    Attributes
    ----------
    head
        Of the columns: force, horizontal, its height, vertical, its distance, moment, where it comes from.
    rows
        Of each force, and last their sum.
    """

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def lines(load_case: LoadCase, units: str, about: str = "heel") -> Lines:
    """Return the forces with arms and moments about the heel or the toe of the contact; those without effect are left
    out."""
    sheet, to = load_case.sheet(about), sheet_units(units)
    length, force, moment, _ = to.names
    acting = [line for line in sheet.lines if line.horizontal_n or line.vertical_n or line.moment_nm]
    # What has pieces is taken piece by piece: the rows add up to the sum.
    shown = [force_line for line in acting for force_line in line.parts or (line,)]
    every = [*shown, sheet.sum]
    pushes = _column([component for line in every for component in (line.horizontal_n, line.vertical_n)], to.force)
    arms = _column([arm for line in shown for arm in (line.height_m, line.distance_m)], to.length)
    turns = _column([line.moment_nm for line in every], to.moment)
    columns = (pushes, arms, pushes, arms, turns)
    rows = [
        (
            line.name,
            *(column(value) for column, value in zip(columns, _numbers(line), strict=True)),
            _from(load_case, line, units),
        )
        for line in shown
    ]
    last = sheet.sum
    whole = (columns[0](last.horizontal_n), "", columns[2](last.vertical_n), "", columns[4](last.moment_nm))
    head = (
        "force",
        f"H [{force}]",
        f"arm z [{length}]",
        f"V [{force}]",
        f"arm x [{length}]",
        f"M about {about} [{moment}]",
        "from",
    )
    return Lines(head, (*rows, ("sum", *whole, "")))


def _numbers(line: ForceLine) -> tuple[float | None, ...]:
    return line.horizontal_n, line.height_m, line.vertical_n, line.distance_m, line.moment_nm


def _from(load_case: LoadCase, line: ForceLine, units: str) -> str:
    """Say where a force comes from; of the water in the crack its pressures, which a checker integrates."""
    words = line.source.text(units)
    points = list(dict.fromkeys(load_case.pressures))
    if line.name != "uplift" or len(points) > _MOST_POINTS:
        return words
    to = sheet_units(units)
    listed = ", ".join(f"{_say(p / to.stress, 5)} at {_say(x / to.length, 5)}" for x, p in points)
    return f"{words}: {listed}, in {to.names[3]} and {to.names[0]} from the heel of the crack"


def _column(values: Sequence[float | None], unit: float) -> Callable[[float | None], str]:
    """Return what writes the numbers of a column: all to the same place behind the point."""
    decimals = _decimals(max((abs(value) / unit for value in values if value is not None), default=0.0))
    return lambda value: NOTHING if value is None else _text(value / unit, decimals)


def _decimals(largest: float) -> int:
    return min(_DIGITS, max(0, _DIGITS - 1 - math.floor(math.log10(largest)))) if largest > 0.0 else 0


def _text(value: float, decimals: int) -> str:
    # With the minus of a keyboard: what is copied into a table of a checker must be a number there.
    return f"{value:z.{decimals}f}"


def _say(value: float, digits: int = _DIGITS) -> str:
    """Write a number of a step."""
    if not value:
        return "0"
    decimals = min(_DIGITS, max(0, digits - 1 - math.floor(math.log10(abs(value)))))
    text = _text(value, decimals)
    return text.rstrip("0").rstrip(".") if "." in text else text


def _within(value: float) -> str:
    """Write a number of a product, which has a sign of its own."""
    return f"({_say(value)})" if value < 0.0 else _say(value)


@dataclass(frozen=True)
class Step:
    """A step of the calculation.

    Attributes
    ----------
    name, formula, worked, value
        What is found, how, with the numbers put in, and what comes out.
    limit
        What is required of it; empty where nothing is.
    met
        Whether it is met; None where nothing is required.
    """

    name: str
    formula: str
    worked: str
    value: str
    limit: str = ""
    met: bool | None = None


def steps(load_case: LoadCase, checks: Sequence[Check], units: str) -> tuple[Step, ...]:
    """Return the steps from the sums of the sheet to the factors, with the required values."""
    return _Steps(load_case, checks, units).all()


class _Steps:
    """Writes the steps of one load case."""

    def __init__(self, load_case: LoadCase, checks: Sequence[Check], units: str) -> None:
        self.load_case, self.to = load_case, sheet_units(units)
        self.length, self.force, self.moment, self.stress = self.to.names
        self.units = units
        self.checks = {check.name: check for check in checks if check.load_case == load_case.name}
        self.sum = load_case.sheet().sum
        (x0, z0), (x1, z1) = load_case.ends_m
        self.angle = math.atan2(z1 - z0, x1 - x0)
        self.normal = load_case.normal_force_n / self.to.force
        self.shear = load_case.shear_force_n / self.to.force
        self.width = load_case.contact_width_m / self.to.length

    def all(self) -> tuple[Step, ...]:
        """Return all steps that the load case has."""
        made = [*self._sums(), *self._position(), *self._stresses(), *self._sliding(), self._overturning()]
        return (*made, self._flotation())

    def _judged(self, name: str) -> tuple[str, bool | None]:
        check = self.checks.get(name)
        return ("", None) if check is None else (check_cells(check)[3].replace("-", ""), check.met)

    def _sums(self) -> list[Step]:
        across, up = (component / self.to.force for component in (self.sum.horizontal_n, self.sum.vertical_n))
        normal, shear = _say(self.normal), _say(self.shear)
        if abs(math.sin(self.angle)) < 1e-12:
            return [
                Step("normal force", "N = −ΣV", f"−({_say(up)})", f"{normal} {self.force}"),
                Step("force along the crack", "T = ΣH", _say(across), f"{shear} {self.force}"),
            ]
        turn = f"{math.degrees(self.angle):.4f}°"
        return [
            Step(
                "normal force",
                "N = ΣH sin α − ΣV cos α",
                f"{_say(across)} sin {turn} − ({_say(up)}) cos {turn}",
                f"{normal} {self.force}",
            ),
            Step(
                "force along the crack",
                "T = ΣH cos α + ΣV sin α",
                f"{_say(across)} cos {turn} + ({_say(up)}) sin {turn}",
                f"{shear} {self.force}",
            ),
        ]

    def _position(self) -> list[Step]:
        load_case = self.load_case
        limit, met = self._judged("resultant")
        if load_case.resultant_from_heel_m is None or load_case.eccentricity_m is None:
            return [Step("resultant", "x = −ΣM / N", "N is not positive", "none", limit, met)]
        moment = self.sum.moment_nm / self.to.moment
        place = (load_case.resultant_from_heel_m - load_case.contact_from_m) / self.to.length
        away = load_case.eccentricity_m / self.to.length
        share = abs(away) / self.width
        return [
            Step(
                "resultant from the heel",
                "x = −ΣM / N",
                f"−({_say(moment)}) / {_say(self.normal)}",
                f"{_say(place)} {self.length}",
            ),
            Step(
                "from the middle of B",
                "e = x − B/2",
                f"{_say(place)} − {_say(self.width)}/2",
                f"{_say(away)} {self.length}",
            ),
            Step("over the contact", "|e| / B", f"{_say(abs(away))} / {_say(self.width)}", f"{share:.4f}", limit, met),
        ]

    def _stresses(self) -> list[Step]:
        load_case = self.load_case
        stands = self.checks.get("equilibrium")
        met = None if stands is None else stands.met
        if (
            load_case.heel_stress_pa is None
            or load_case.toe_stress_pa is None
            or load_case.resultant_from_heel_m is None
        ):
            return [
                Step("state of the crack", "stress at the tip", "no length of it holds", load_case.outcome, "", met)
            ]
        open_, closed = (
            load_case.cracked_length_m / self.to.length,
            self.width - load_case.cracked_length_m / self.to.length,
        )
        from_heel = load_case.cracked_from == "heel"
        place = (load_case.resultant_from_heel_m - load_case.contact_from_m) / self.to.length
        middle = (open_ if from_heel else 0.0) + closed / 2.0
        away = place - middle
        made = []
        how = "nothing opens" if not open_ else f"from the {load_case.cracked_from}, {load_case.iterations} iterations"
        made.append(Step("crack open", "c, where its tip holds", how, f"{_say(open_)} {self.length}", "", met))
        made.append(
            Step("length closed", "L = B − c", f"{_say(self.width)} − {_say(open_)}", f"{_say(closed)} {self.length}")
        )
        shift = f"{_say(place)} − {_say(open_)} − {_say(closed)}/2"
        if not open_ or not from_heel:
            shift = f"{_say(place)} − {_say(closed)}/2"
        formula = "e' = x − c − L/2" if open_ and from_heel else "e' = x − L/2"
        made.append(Step("from the middle of L", formula, shift, f"{_say(away)} {self.length}"))
        limit, met = self._judged("compression")
        for name, sign, value in (
            ("stress at the heel" if not (open_ and from_heel) else "stress at the tip", "−", load_case.heel_stress_pa),
            ("stress at the toe" if from_heel or not open_ else "stress at the tip", "+", load_case.toe_stress_pa),
        ):
            governs = value == max(load_case.heel_stress_pa, load_case.toe_stress_pa)
            # What is left of a tip at zero is rounding.
            shown = 0.0 if abs(value) < 1e-9 * abs(load_case.normal_force_n) / load_case.contact_width_m else value
            made.append(
                Step(
                    name,
                    f"σ = N/L (1 {sign} 6 e'/L)",
                    f"{_say(self.normal)}/{_say(closed)} (1 {sign} 6 · {_within(away)}/{_say(closed)})",
                    self._stress(shown),
                    *((limit, met) if governs and limit else ("", None)),
                )
            )
        return made

    def _stress(self, value: float) -> str:
        text = f"{_say(value / self.to.stress, 5)} {self.stress}"
        return text if self.units != "us" else f"{text} = {_say(value / _PSI, 4)} psi"

    def _sliding(self) -> list[Step]:
        load_case = self.load_case
        limit, met = self._judged("sliding factor")
        if load_case.sliding_factor is None:
            return [Step("sliding", "F = μ N / |T|", "T is zero", "none", limit, met)]
        cohesive = load_case.cohesive_force_n / self.to.force
        held = f"{load_case.friction:g} · {_say(max(0.0, self.normal))}"
        formula, worked = "F = μ N / |T|", f"{held} / {_say(abs(self.shear))}"
        if cohesive:
            formula, worked = "F = (C + μ N) / |T|", f"({_say(cohesive)} + {held}) / {_say(abs(self.shear))}"
        alone: list[Step] = []
        if cohesive and load_case.friction_factor is not None:
            by = ("F = μ N / |T|", f"{held} / {_say(abs(self.shear))}")
            alone = [Step("sliding, friction alone", *by, f"{load_case.friction_factor:.4f}")]
        if load_case.sliding_factor_on_pieces is None:
            return [Step("sliding", formula, worked, f"{load_case.sliding_factor:.4f}", limit, met), *alone]
        borne = load_case.sliding_factor_on_pieces * abs(self.shear)
        less = load_case.pieces_bear == "less"
        judged, idle = (limit, met), ("", None)
        by_pieces = ("F = T_p / |T|, T_p what they bear", f"{_say(borne)} / {_say(abs(self.shear))}")
        return [
            Step(
                "sliding, straight line", formula, worked, f"{along_line(load_case):.4f}", *(idle if less else judged)
            ),
            Step(
                "sliding, on its pieces",
                *by_pieces,
                f"{load_case.sliding_factor_on_pieces:.4f}",
                *(judged if less else idle),
            ),
        ]

    def _overturning(self) -> Step:
        load_case = self.load_case
        about = load_case.overturning_about
        sign = 1.0 if about == "toe" else -1.0
        moments = [sign * line.moment_nm / self.to.moment for line in load_case.sheet(about).lines]
        holds, turns = (
            math.fsum(max(0.0, moment) for moment in moments),
            -math.fsum(min(0.0, moment) for moment in moments),
        )
        formula = f"ΣM hold / ΣM turn, about {about}"
        if load_case.overturning_factor is None:
            return Step("overturning", formula, "nothing turns it", "none")
        return Step("overturning", formula, f"{_say(holds)} / {_say(turns)}", f"{load_case.overturning_factor:.4f}")

    def _flotation(self) -> Step:
        limit, met = self._judged("flotation factor")
        across = [
            (line.vertical_n * math.cos(self.angle) - line.horizontal_n * math.sin(self.angle)) / self.to.force
            for line in self.load_case.sheet().lines
        ]
        down, up = (
            -math.fsum(min(0.0, component) for component in across),
            math.fsum(max(0.0, component) for component in across),
        )
        if self.load_case.flotation_factor is None:
            return Step("flotation", "ΣV down / ΣV up", "nothing lifts it", "none", limit, met)
        worked = f"{_say(down)} / {_say(up)}"
        return Step("flotation", "ΣV down / ΣV up", worked, f"{self.load_case.flotation_factor:.4f}", limit, met)
