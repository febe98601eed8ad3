"""The calculation sheet of a load case: force by force with its arms, so that a checker can follow it by hand.

    moment about a point = arm of the vertical part x vertical part - height of the horizontal part x horizontal part

with arms counted from that point, downstream and up, counter-clockwise positive.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from heeltoe.case.dam import Water
from heeltoe.case.model import Case
from heeltoe.geometry.pieces import Piece
from heeltoe.mechanics.loads import Resultant, concrete_mass, nappe_heads, silt, total, water_above_crack
from heeltoe.units.sentences import Sentence

# What is proportional to the area of the section, so that its pieces can be taken one by one.
_OF_THE_BODY = ("weight", "inertia")
# A part of a force that is so small beside the others is rounding, and has no arm.
_ROUNDING = 1e-12


@dataclass(frozen=True)
class ForceLine:
    """A line of the sheet. Per metre of dam, SI.

    Attributes
    ----------
    name
        Source of the force.
    horizontal_n, vertical_n
        Downstream and upward.
    height_m
        At which the horizontal part acts, above the point of the moments; None where there is none, or where its
        pieces are a couple.
    distance_m
        At which the vertical part acts, downstream of that point; None as above.
    moment_nm
        About the point, counter-clockwise.
    source
        Where the force comes from.
    parts
        The same piece by piece of the section; nothing of what has none.
    """

    name: str
    horizontal_n: float
    height_m: float | None
    vertical_n: float
    distance_m: float | None
    moment_nm: float
    source: Sentence
    parts: tuple[ForceLine, ...] = ()


@dataclass(frozen=True)
class Sheet:
    """The forces of a load case about one point.

    Attributes
    ----------
    about
        "heel" or "toe": the end of the contact that moments are about.
    point_m
        Where it is, downstream of the heel of the crack and above it.
    lines
        Force by force, the uplift with the crack open as far as found.
    sum
        Of all lines.
    """

    about: str
    point_m: tuple[float, float]
    lines: tuple[ForceLine, ...]
    sum: ForceLine


def sheet(
    forces: Sequence[Resultant],
    sources: Mapping[str, Sentence],
    about: str,
    point: tuple[float, float],
    pieces: Sequence[Piece] = (),
) -> Sheet:
    """Return the sheet of some forces about a point.

    Parameters
    ----------
    forces
        With moments about the heel of the crack.
    sources
        Where they come from, by their names.
    about
        What the point is called.
    point
        Downstream of the heel of the crack and above it [m].
    pieces
        Of the section, counted from the heel of the crack.
    """
    size = sum(abs(force.horizontal) + abs(force.vertical) for force in forces)
    lines = []
    for force in forces:
        line = _line(force, point, size, sources.get(force.name, Sentence("")))
        if force.name in _OF_THE_BODY:
            line = replace(line, parts=tuple(_pieces(force, pieces, point, size, sources)))
        lines.append(line)
    return Sheet(about, point, tuple(lines), _line(total("sum", forces), point, size, Sentence("")))


def _pieces(
    force: Resultant,
    pieces: Sequence[Piece],
    point: tuple[float, float],
    size: float,
    sources: Mapping[str, Sentence],
) -> Iterator[ForceLine]:
    """Return the lines of a force that is proportional to the area, each at the centroid of its piece."""
    whole = math.fsum(piece.area_m2 for piece in pieces)
    for number, piece in enumerate(pieces, start=1):
        share = piece.area_m2 / whole
        own = Resultant.at(
            f"{force.name} {number}", (share * force.horizontal, share * force.vertical), (piece.x_m, piece.z_m)
        )
        source = Sentence.of(
            "{shape} {width_m:.5g m} by {height_m:.5g m}, {of}",
            shape=piece.shape,
            width_m=piece.width_m,
            height_m=piece.height_m,
            of=sources.get(f"{force.name} of a piece", Sentence("at its centroid")),
        )
        yield _line(own, point, size, source)


def _line(force: Resultant, point: tuple[float, float], size: float, source: Sentence) -> ForceLine:
    across, up = force.horizontal, force.vertical
    pushes, lifts = abs(across) > _ROUNDING * size, abs(up) > _ROUNDING * size
    return ForceLine(
        name=force.name,
        horizontal_n=across,
        height_m=(force.lift_moment - force.moment) / across - point[1] if pushes else None,
        vertical_n=up,
        distance_m=force.lift_moment / up - point[0] if lifts else None,
        moment_nm=force.moment_about(*point),
        source=source,
    )


def sources_of(case: Case) -> dict[str, Sentence]:
    """Say where the forces of a case of loads come from, by their names."""
    sentences = {
        "weight": Sentence.of(
            "{area_m2:.5g m²} of concrete of {density:.5g kg/m³}, at its centroid",
            area_m2=case.above.area,
            density=case.concrete.density,
        ),
        "weight of a piece": Sentence.of("concrete of {density:.5g kg/m³}", density=case.concrete.density),
        "reservoir": _water(case, case.reservoir, "heel"),
        "tailwater": _water(case, case.tailwater, "toe"),
        "uplift": Sentence.of('pattern "{pattern}", intensity {intensity:g}', **_uplift(case)),
    }
    if case.reservoir is not None:
        text = "{head_m:.4g m} of water over the upstream edge of the crest, {end_m:.4g m} over the downstream one"
        head, end = nappe_heads(case)
        sentences["nappe"] = Sentence.of(text, head_m=head, end_m=end)
    if case.ice is not None:
        sentences["ice"] = Sentence.of("{push_n:g kN/m}, {depth_m:g m} below the surface", **_ice(case))
    if case.silt is not None:
        text = "silt {depth_m:g m} deep as a fluid of {sideways:g kg/m³} sideways"
        # Before a vertical face it has no weight on the dam.
        text += ", {down:g kg/m³} in its weight" if silt(case).vertical else ""
        densities = {"sideways": case.silt.horizontal_density, "down": case.silt.vertical_density}
        sentences["silt"] = Sentence.of(text, depth_m=case.silt.depth, **densities)
    if case.anchors:
        sentences["anchors"] = Sentence("prestress along their axes, where they cross the crack")
    return sentences


def sources_of_inertia(case: Case, horizontal: float, vertical: float) -> dict[str, Sentence]:
    """Say where the forces of a ground acceleration in g, downstream and upward, come from."""
    sentences = {
        "inertia": Sentence.of(
            "{mass:.5g t/m} times {horizontal:g} g and {vertical:g} g of the ground, at the centroid",
            mass=concrete_mass(case),
            horizontal=horizontal,
            vertical=vertical,
        ),
        "inertia of a piece": Sentence.of(
            "{horizontal:g} g and {vertical:g} g of the ground", horizontal=horizontal, vertical=vertical
        ),
        "hydrodynamic": Sentence.of(
            "{whose} water times {horizontal:g} g of the ground", whose=_whose(case), horizontal=horizontal
        ),
    }
    for name in ("reservoir", "nappe", "tailwater"):
        sentences[f"{name} in vertical motion"] = Sentence.of(
            "{vertical:g} times the pressure of the {name}", vertical=vertical, name=name
        )
    return sentences


def _water(case: Case, water: Water | None, end: str) -> Sentence:
    if water is None:
        return Sentence("none")
    head = water_above_crack(case, water, toe=end == "toe")
    return Sentence.of(
        "water {head_m:.4g m} above the {end}, {density:g kg/m³}", head_m=head, end=end, density=water.density
    )


def _whose(case: Case) -> str:
    names = [side.hydrodynamic.title() for side in (case.reservoir, case.tailwater) if side is not None]
    return " and ".join(f"{name}'s" for name in dict.fromkeys(names)) or "no"


def _uplift(case: Case) -> dict[str, object]:
    return {"pattern": case.uplift.pattern, "intensity": case.uplift.intensity}


def _ice(case: Case) -> dict[str, float]:
    assert case.ice is not None
    return {"push_n": case.ice.force, "depth_m": case.ice.depth}
