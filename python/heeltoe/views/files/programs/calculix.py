"""A dam as input of CalculiX: contact pairs with friction, a static step, and a dynamic one with the earthquake."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from heeltoe.base.arrays import Floats, Integers
from heeltoe.models.flexible.deck import Deck, DeckCrack
from heeltoe.motion.earthquake import Earthquake
from heeltoe.views.files.programs.remarks import remarks

#: Files that are written.
FILES = ("dam.inp",)
# Sides of an element: its two corners, as places in its row of nodes, in the order S1 to S4.
_SIDES = ((0, 1), (1, 2), (2, 3), (3, 0))
# The ground under a crack on a rigid plane: one row of elements, so much of the crack's width thick.
_DEPTH = 0.05
# Stiffness of the contact over modulus by length of an element, as in the program for OpenSees.
_PENALTY = 200.0
# Part of the stress at which sticking contact is in full [1/m]: slope of the stick over that of the contact.
_STICK = 1.0
# Largest and smallest time step [s], how many of them between two outputs, and the alpha of Hilber, Hughes and Taylor.
_STEP, _SMALLEST, _OUTPUT, _ALPHA = 0.005, 1e-6, 10, -0.1
_ITEMS_A_LINE = 8
# Forces below this part of the largest are rounding.
_NOTHING = 1e-15


def write_calculix(deck: Deck, directory: Path) -> None:
    """Write a deck as ``dam.inp`` into an empty directory."""
    (directory / "dam.inp").write_text("\n".join(_lines(deck)) + "\n", encoding="utf-8")


def _lines(deck: Deck) -> Iterator[str]:
    yield from (f"** {line}" for line in remarks(deck))
    yield "** Contact: a penalty from surface to surface with Coulomb's friction."
    yield "** The sum of the reactions leaves out the loads on held nodes themselves."
    nodes, blocks = _with_ground(deck)
    yield "*NODE, NSET=all"
    yield from (f"{node}, {_number(x)}, {_number(y)}, 0." for node, (x, y) in enumerate(nodes.tolist(), 1))
    kind = "CPS8" if deck.plane == "stress" else "CPE8"
    number = 1
    firsts = {}
    for name, elements in blocks.items():
        firsts[name] = number
        yield f"*ELEMENT, TYPE={kind}, ELSET={name}"
        for row in (elements + 1).tolist():
            yield f"{number}, {', '.join(map(str, row))}"
            number += 1
    yield from ("*MATERIAL, NAME=concrete", "*ELASTIC", f"{_number(deck.modulus)}, {_number(deck.poisson)}")
    yield from (
        "*DENSITY",
        f"{_number(deck.density)}",
        "*DAMPING, ALPHA=0., " + f"BETA={_number(deck.stiffness_damping)}",
    )
    for name in blocks:
        yield from (f"*SOLID SECTION, ELSET={name}, MATERIAL=concrete", "1.")
    yield from _set("held", np.concatenate([deck.held, np.arange(len(deck.nodes), len(nodes))]))
    yield from _set("faces", np.unique(np.concatenate([[*crack.upper, *crack.lower] for crack in deck.cracks])))
    if deck.motion is not None:
        shaking = deck.motion.shaking
        yield from _amplitude("downstream", shaking.time, shaking.horizontal)
        if shaking.up is not None:
            yield from _amplitude("upward", shaking.time, shaking.up)
        yield from _waters(deck, len(nodes) + 1)
        for part in deck.parts:
            # A set has one gravity.
            for name in ("downstream", "upward"):
                yield from (f"*ELSET, ELSET={part.name}_{name}", part.name)
    yield from _surfaces(deck, blocks, firsts)
    for crack in deck.cracks:
        size = float(crack.lengths.sum()) / ((len(crack.upper) - 1) // 2)
        stiffness = _PENALTY * deck.modulus / size
        yield f"*SURFACE INTERACTION, NAME=joint_{crack.name}"
        yield from ("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", _number(stiffness))
        yield from ("*FRICTION", f"{_number(crack.friction)}, {_number(_STICK * stiffness)}")
        yield f"*CONTACT PAIR, INTERACTION=joint_{crack.name}, TYPE=SURFACE TO SURFACE"
        yield f"{crack.name}_upper, {crack.name}_lower"
    yield from ("*BOUNDARY", "held, 1, 2")
    yield from ("*STEP, NLGEOM=NO, INC=1000", "*STATIC", "0.25, 1., 1e-6, 0.25")
    yield from _forces(sum(deck.loads.values(), np.zeros_like(deck.nodes)))
    yield from _output()
    # The dynamic step wants the energy from the first step on.
    yield from ("*EL FILE", "ENER")
    yield "*END STEP"
    if deck.motion is not None:
        yield from _earthquake(deck, deck.motion, len(nodes) + 1)


def _number(value: float) -> str:
    """Return a number as CalculiX reads it, in twenty characters at most."""
    return f"{value:.12g}"


def _with_ground(deck: Deck) -> tuple[Floats, dict[str, Integers]]:
    """Return nodes and elements with a row of elements below each crack on a rigid plane, whose nodes are all held."""
    blocks = {part.name: part.elements for part in deck.parts}
    nodes, ground = deck.nodes, set(deck.ground.tolist())
    for crack in deck.cracks:
        if ground.intersection(crack.lower.tolist()):
            elements, deeper = _below(deck, crack, len(nodes))
            blocks["ground"], nodes = elements, np.vstack([nodes, deeper])
    return nodes, blocks


def _below(deck: Deck, crack: DeckCrack, first: int) -> tuple[Integers, Floats]:
    face, depth = crack.lower, _DEPTH * float(crack.lengths.sum())
    down = -depth * np.array(crack.normal)
    top = deck.nodes[face]
    ends = top[::2]
    middle, bottom = first + np.arange(len(ends)), first + len(ends) + np.arange(face.size)
    elements = np.column_stack(
        [bottom[:-2:2], bottom[2::2], face[2::2], face[:-2:2], bottom[1:-1:2], middle[1:], face[1:-1:2], middle[:-1]]
    )
    return elements, np.vstack([ends + down / 2.0, top + down])


def _surfaces(deck: Deck, blocks: dict[str, Integers], firsts: dict[str, int]) -> Iterator[str]:
    for crack in deck.cracks:
        for face, path in (("upper", crack.upper), ("lower", crack.lower)):
            yield f"*SURFACE, NAME={crack.name}_{face}, TYPE=ELEMENT"
            yield from _sides(set(path.tolist()), blocks, firsts)


def _sides(path: set[int], blocks: dict[str, Integers], firsts: dict[str, int]) -> Iterator[str]:
    """Yield elements with the side that lies on a face."""
    for name, elements in blocks.items():
        for number, row in enumerate(elements.tolist(), firsts[name]):
            for side, corners in enumerate(_SIDES, 1):
                if all(row[corner] in path for corner in corners):
                    yield f"{number}, S{side}"


def _set(name: str, nodes: Integers) -> Iterator[str]:
    yield f"*NSET, NSET={name}"
    yield from _rows((nodes + 1).tolist())


def _rows(items: Sequence[object]) -> Iterator[str]:
    for start in range(0, len(items), _ITEMS_A_LINE):
        yield ", ".join(map(str, items[start : start + _ITEMS_A_LINE])) + ","


def _forces(forces: Floats) -> Iterator[str]:
    yield "*CLOAD"
    for node, axis in np.argwhere(np.abs(forces) > _NOTHING * np.abs(forces).max()).tolist():
        yield f"{node + 1}, {axis + 1}, {_number(forces[node, axis])}"


def _output(every: int = 1) -> Iterator[str]:
    """Yield displacements for a viewer, of the crack's faces as numbers, too, and the sum of the reactions."""
    yield from (f"*NODE FILE, OUTPUT=2D, FREQUENCY={every}", "U")
    yield from (f"*NODE PRINT, NSET=faces, FREQUENCY={every}", "U")
    yield from (f"*NODE PRINT, NSET=held, TOTALS=ONLY, FREQUENCY={every}", "RF")


def _waters(deck: Deck, first: int) -> Iterator[str]:
    """Yield the water as mass elements on nodes of their own, from number `first` on: a mass is the same along all
    axes, so that each node follows the dam along one of them alone."""
    number = first
    for node, axis in np.argwhere(deck.water_masses).tolist():
        x, y = deck.nodes[node].tolist()
        yield from ("*NODE, NSET=water", f"{number}, {_number(x)}, {_number(y)}, 0.")
        yield from (f"*ELEMENT, TYPE=MASS, ELSET=water_{number}", f"{number}, {number}")
        yield from (f"*MASS, ELSET=water_{number}", f"{_number(deck.water_masses[node, axis])}")
        yield from ("*EQUATION", "2", f"{number}, {axis + 1}, 1., {node + 1}, {axis + 1}, -1.")
        others = [other for other in (1, 2, 3) if other != axis + 1]
        yield from ("*BOUNDARY", *(f"{number}, {other}, {other}" for other in others))
        number += 1


def _amplitude(name: str, time: Floats, values: Floats) -> Iterator[str]:
    yield f"*AMPLITUDE, NAME={name}"
    # A jump has its moment twice, which no amplitude may.
    moments = time + 1e-9 * np.concatenate([[0.0], np.diff(time) == 0.0])
    pairs = [
        f"{_number(moment)}, {_number(value)}" for moment, value in zip(moments.tolist(), values.tolist(), strict=True)
    ]
    for start in range(0, len(pairs), _ITEMS_A_LINE // 2):
        yield ", ".join(pairs[start : start + _ITEMS_A_LINE // 2])


def _earthquake(deck: Deck, motion: Earthquake, waters: int) -> Iterator[str]:
    """Yield the step in which the ground moves: forces of inertia in motion relative to it; the static loads remain."""
    shaking = motion.shaking
    components = [("downstream", shaking.horizontal), *([] if shaking.up is None else [("upward", shaking.up)])]
    if shaking.up is not None:
        yield "** Water pressure that follows the vertical motion of the ground, where any does, is left out."
    yield from ("*STEP, NLGEOM=NO, INC=1000000", f"*DYNAMIC, ALPHA={_ALPHA!r}")
    yield f"{_STEP!r}, {_number(motion.end)}, {_SMALLEST!r}, {_STEP!r}"
    for axis, (name, _) in enumerate(components):
        direction = ("-1., 0., 0.", "0., -1., 0.")[axis]
        yield f"*DLOAD, AMPLITUDE={name}"
        yield from (f"{part.name}_{name}, GRAV, 1., {direction}" for part in deck.parts)
        yield f"*CLOAD, AMPLITUDE={name}"
        for number, (node, along) in enumerate(np.argwhere(deck.water_masses).tolist(), waters):
            if along == axis:
                yield f"{number}, {axis + 1}, {_number(-deck.water_masses[node, axis])}"
    yield from _output(every=_OUTPUT)
    yield "*END STEP"
