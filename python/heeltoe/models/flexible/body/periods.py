"""Periods of vibration: of the intact dam, and of each part by itself once the crack is there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from heeltoe.case.model import Case
from heeltoe.case.warnings import drawing_text
from heeltoe.errors.error import InputError, expect
from heeltoe.kernel.build import build_info
from heeltoe.models.flexible.body.bonded import bonded_dam
from heeltoe.models.flexible.body.modes import intact_periods, part_periods
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.surroundings.amplification import Amplification, crest_amplification
from heeltoe.units.sentences import written

COUNT = 5
_MOST = 50


@dataclass(frozen=True)
class DamPeriods:
    """Periods of a dam [s], longest first.

    Attributes
    ----------
    title
        Title of the case.
    intact_dry, intact
        The whole dam, its crack bonded: without water, and with the virtual water that vibrates with it. Compressible
        water counts as that, too: with waves that leave, no modes are real.
    parts
        Each part by itself with its water, from the crest down, by where it is: the lowest held at its base where no
        crack is there, the others free, whose rigid-body motion is none of them.
    elevations
        Of the cracks, from the crest down [m].
    grounded
        Whether the lowest part is held at its base.
    rayleigh
        Coefficients of mass [1/s] and stiffness [s] of the damping that follow from the intact dam; None with `modal`.
    damping, damping_ratio
        What the case says of them.
    damping_ratios
        What the lowest modes of the intact dam, at most five, really get.
    elements, nodes
        Of each part, from above.
    simplified
        Sentences on what of the case is simpler here.
    amplification
        How the crest answers by frequency, with and without rock and water; None where no one asked.
    drawing
        Which outline of a drawing is the dam; empty where the section is not drawn.
    """

    title: str
    intact_dry: tuple[float, ...]
    intact: tuple[float, ...]
    parts: dict[str, tuple[float, ...]]
    elevations: tuple[float, ...]
    grounded: bool
    rayleigh: tuple[float, float] | None
    damping: str
    damping_ratio: float
    damping_ratios: tuple[float, ...]
    elements: tuple[int, ...]
    nodes: tuple[int, ...]
    simplified: tuple[str, ...] = ()
    amplification: Amplification | None = None
    drawing: str = ""

    @property
    def above(self) -> tuple[float, ...]:
        """Periods of the part above the highest crack [s]."""
        return next(iter(self.parts.values()))

    @property
    def below(self) -> tuple[float, ...] | None:
        """Periods of the part below the lowest crack [s]; None where that crack is at the base."""
        return list(self.parts.values())[-1] if self.grounded else None

    def part_names(self, units: str = "si") -> list[str]:
        """Return where each part is, from the crest down, in units ``"si"`` or ``"us"``."""
        return _names(self.elevations, len(self.parts), units)

    def to_json(self) -> dict[str, Any]:
        """Return plain numbers, strings and lists."""
        return {
            "title": self.title,
            "drawing": self.drawing,
            "periods_s": {
                "intact_dry": list(self.intact_dry),
                "intact": list(self.intact),
                "above_crack": list(self.above),
                "below_crack": None if self.below is None else list(self.below),
            },
            "parts": [{"part": name, "periods_s": list(periods)} for name, periods in self.parts.items()],
            "damping": self.damping,
            "damping_ratio": self.damping_ratio,
            "damping_ratios": list(self.damping_ratios),
            "rayleigh": None
            if self.rayleigh is None
            else dict(zip(("mass_1_s", "stiffness_s"), self.rayleigh, strict=True)),
            "mesh": {"elements": list(self.elements), "nodes": list(self.nodes)},
            "response": None if self.amplification is None else self.amplification.to_json(),
            "build": build_info(),
        }


def dam_periods(case: Case, count: int = COUNT, *, response: bool = False, field: str = "count") -> DamPeriods:
    """Return the longest periods of a dam and of its parts.

    Parameters
    ----------
    case
        A dam with a modulus; it needs no earthquake.
    count
        How many of each, 1 to 50; fewer where the mesh has no more.
    response
        Whether to compute how the crest answers by frequency, too, on rigid and on elastic rock, with its reservoir
        empty, its water a mass, and its water with sound.
    field
        What the count is called where it cannot be used.

    Raises
    ------
    InputError
        Where the count, the modulus or the mesh cannot be used.
    """
    expect(case, Case, "a case", "case")
    if not 1 <= count <= _MOST:
        raise InputError("out-of-range", field, count, bound=f"from 1 to {_MOST}")
    dam, massed = build_flexible_dam(case), bonded_dam(case.with_water_as_mass())
    elevations = tuple(crack.elevation for crack in case.cracks)
    names = _names(elevations, len(dam.modes))
    return DamPeriods(
        title=case.title,
        intact_dry=tuple(intact_periods(massed, count, water=False).tolist()),
        intact=tuple(intact_periods(massed, count).tolist()),
        parts={
            name: tuple(part_periods(modes, count).tolist()) for name, modes in zip(names, massed.modes, strict=True)
        },
        elevations=elevations,
        grounded=len(names) > len(case.cracks),
        rayleigh=dam.damping.coefficients,
        damping=case.flexible.damping,
        damping_ratio=case.concrete.damping,
        damping_ratios=tuple(dam.damping.ratios.tolist()),
        elements=tuple(len(body.mesh.elements) for body in dam.bodies),
        nodes=tuple(len(body.mesh.nodes) for body in dam.bodies),
        simplified=tuple(_simplified(case)),
        drawing=drawing_text(case),
        amplification=crest_amplification(case) if response else None,
    )


def _simplified(case: Case) -> Iterator[str]:
    """Walk what of the case would make no mode real: what waves take with them."""
    if case.has_compressible_water:
        yield "The compressible water counts as a mass here, as if it were incompressible."
    if case.foundation is not None:
        yield "The rock counts as rigid here."


def _names(elevations: Sequence[float], count: int, units: str = "si") -> list[str]:
    """Return where each part is, from the crest down, of a dam cracked at these elevations [m]."""
    if len(elevations) == 1:
        return ["above the crack", "below the crack"][:count]
    between = [written("{ends_m:.4g m|to}", units, ends_m=[low, high]) for high, low in pairwise(elevations)]
    above, below = (
        written(f"{word} {{at_m:.4g m}}", units, at_m=at)
        for word, at in (("above", elevations[0]), ("below", elevations[-1]))
    )
    return [above, *between, below][:count]
