"""How a section that takes no tension, or little, carries its forces: stresses, and how far the crack opens."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.mechanics.loads import Resultant
from heeltoe.models.statics.water import StillWater

# Coefficients of a polynomial below this part of its largest one are rounding.
_ROUNDING = 1e-12


@dataclass(frozen=True)
class Contact:
    """The part of the base of the block that stands on the crack.

    Attributes
    ----------
    start, end
        Distances from the heel of the block along the crack [m].
    bonded_from
        From here to `bonded_to` the crack is bonded [m]; at or beyond `end` nowhere.
    tensile_strength
        Of the bonded part [Pa]; the rest has none.
    bonded_to
        Where the bond ends [m]; the end of the base where nothing has opened it from the toe.
    """

    start: float
    end: float
    bonded_from: float
    tensile_strength: float = 0.0
    bonded_to: float = math.inf

    @property
    def width(self) -> float:
        """Length of the contact [m]."""
        return self.end - self.start


@dataclass(frozen=True, eq=False)
class Settled:
    """How a contact carries its forces.

    Attributes
    ----------
    outcome
        "stands"; "cracks through": however far it opens, the tip stays in tension; "floats": no normal force is left.
    heel_crack, toe_crack
        How far it is open [m].
    normal
        Normal force, uplift taken off [N/m].
    position
        Where it acts, from the heel of the block [m]; None without one.
    heel_stress, toe_stress
        Normal stress at the ends of what is in contact, compression positive [Pa]; None unless it stands.
    profile
        Water pressure.
    iterations
        Of the search for the length of the crack.
    """

    outcome: str
    heel_crack: float
    toe_crack: float
    normal: float
    position: float | None
    heel_stress: float | None
    toe_stress: float | None
    profile: Floats
    iterations: int


def settle(contact: Contact, load: Resultant, water: StillWater) -> Settled:
    """Find how far the crack opens under a load, the water in it included.

    On what is in contact, of length L, the stress is linear (Navier): with the normal force N and the eccentricity e
    of the resultant it is ``N/L (1 -+ 6 e/L)`` at heel and toe. Where an end of the contact is in more tension than it
    can bear, it opens up to the first place where the tip is not; water follows, so that N and e change with the
    length. Times ``L^2`` the stress at the tip is a cubic of the length between two bends of the pressure: its turning
    points cut the way into stretches on which it rises or falls, and the first change of sign is found by Brent's
    method. So the first root is found for certain, also where drains drop out and the stress jumps.

    Parameters
    ----------
    contact
        Where the block stands.
    load
        All loads but the water in the crack: along and across the crack, moment about the heel.
    water
        The water in the crack.
    """
    state = _State(contact, load, water)
    normal, heel, toe = state.at(0.0, 0.0)
    if state.holds(heel, state.strength(0.0, "heel")) and state.holds(toe, state.strength(0.0, "toe")):
        return state.settled("stands", 0.0, 0.0, 0)
    if normal <= 0.0 and not contact.tensile_strength:
        return state.settled("floats", 0.0, 0.0, 0)
    side = "heel" if heel < toe else "toe"
    length, iterations = state.first_safe(side)
    if length is None:
        # The water fills all of the crack.
        ends = (contact.width, 0.0) if side == "heel" else (0.0, contact.width)
        through = state.settled("cracks through", *ends, iterations)
        return through if through.normal > 0.0 else state.settled("floats", *ends, iterations)
    return state.settled("stands", *((length, 0.0) if side == "heel" else (0.0, length)), iterations)


class _State:
    """Forces and stresses of a contact by how far it is open."""

    def __init__(self, contact: Contact, load: Resultant, water: StillWater) -> None:
        self.contact, self.load, self.water = contact, load, water

    def at(self, heel: float, toe: float) -> tuple[float, float, float]:
        """Return the normal force and the stresses at both ends of the closed part."""
        uplift, lever = self.water.act(self.water.pressure(heel, toe))
        low, high = self.contact.start + heel, self.contact.end - toe
        normal = -self.load.vertical - uplift
        turning = -(self.load.moment + lever) - normal * (low + high) / 2.0
        length = high - low
        if length <= 0.0:
            return normal, -math.inf, -math.inf
        return normal, normal / length - 6.0 * turning / length**2, normal / length + 6.0 * turning / length**2

    def strength(self, length: float, side: str) -> float:
        """Return the tension that what lies just beyond the tip can bear [Pa]."""
        contact = self.contact
        bonded = (
            contact.bonded_from <= contact.start + length < min(contact.end, contact.bonded_to)
            if side == "heel"
            else contact.bonded_from < contact.end - length <= contact.bonded_to
        )
        return contact.tensile_strength if bonded else 0.0

    def holds(self, stress: float, strength: float) -> bool:
        """Whether a stress is no more tension than the strength, to the rounding of the loads it comes from."""
        return stress >= -strength - 1e-12 * abs(self.load.vertical) / self.contact.width

    def margin(self, length: float, side: str) -> float:
        """Return what the tip could still bear, times the square of the length in contact; negative where it opens."""
        stress = self.at(*((length, 0.0) if side == "heel" else (0.0, length)))[1 if side == "heel" else 2]
        return (stress + self.strength(length, side)) * (self.contact.width - length) ** 2

    def first_safe(self, side: str) -> tuple[float | None, int]:
        """Return the smallest stable opening from one end, and the iterations of the search."""
        from scipy.optimize import brentq

        iterations = 0
        for low, high in self._stretches(side):
            # Just before its end a stretch still has the strength and the drains of its beginning.
            before = high - 1e-12 * self.contact.width
            if before <= low:
                continue
            if self.margin(low, side) >= 0.0:
                return (low if self._other_end_holds(low, side) else None), iterations
            if self.margin(before, side) >= 0.0:
                root, report = brentq(self.margin, low, before, args=(side,), xtol=1e-14, rtol=1e-14, full_output=True)
                iterations += report.iterations
                return (float(root) if self._other_end_holds(float(root), side) else None), iterations
        return None, iterations

    def _other_end_holds(self, length: float, side: str) -> bool:
        """Whether the far end bears its stress too; not where the block floats."""
        _, heel, toe = self.at(*((length, 0.0) if side == "heel" else (0.0, length)))
        far = "toe" if side == "heel" else "heel"
        return self.holds(toe if side == "heel" else heel, self.strength(0.0, far))

    def _stretches(self, side: str) -> Iterator[tuple[float, float]]:
        """Return the lengths from 0 to the whole contact in stretches on which the margin rises or falls throughout."""
        contact, width = self.contact, self.contact.width
        places = [*self.water.places, contact.bonded_from, contact.bonded_to]
        lengths = [x - contact.start if side == "heel" else contact.end - x for x in places]
        bends = sorted({0.0, width, *(length for length in lengths if 0.0 < length < width)})
        for low, high in pairwise(bends):
            yield from pairwise([low, *self._turning_points(side, low, high), high])

    def _turning_points(self, side: str, low: float, high: float) -> list[float]:
        """Return the lengths between two bends at which the margin turns from rising to falling or back, ascending.

        Between bends it is a polynomial, which its values at the Chebyshev points determine. One of a lower degree than
        it may have, as under a uniform pressure, leaves coefficients of rounding at its head: these are no roots.
        """

        def margins(lengths: Floats) -> Floats:
            return np.array([self.margin(float(length), side) for length in lengths])

        slope = np.polynomial.Chebyshev.interpolate(margins, self.water.degree, [low, high]).deriv()
        slope = slope.trim(_ROUNDING * float(np.abs(slope.coef).max()))
        roots: list[complex] = np.asarray(slope.roots(), dtype=np.complex128).tolist()
        real = [root.real for root in roots if abs(root.imag) < 1e-9 * (high - low)]
        return sorted(root for root in real if low < root < high)

    def settled(self, outcome: str, heel: float, toe: float, iterations: int) -> Settled:
        """Return the state at an opening."""
        profile = self.water.pressure(heel, toe)
        uplift, lever = self.water.act(profile)
        normal = -self.load.vertical - uplift
        stands = outcome == "stands"
        _, heel_stress, toe_stress = self.at(heel, toe) if stands else (0.0, None, None)
        return Settled(
            outcome=outcome,
            heel_crack=heel,
            toe_crack=toe,
            normal=normal,
            position=-(self.load.moment + lever) / normal if normal > 0.0 else None,
            heel_stress=heel_stress,
            toe_stress=toe_stress,
            profile=profile,
            iterations=iterations,
        )
