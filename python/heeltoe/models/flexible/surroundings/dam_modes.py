"""The first two modes of an intact dam with its water and its rock, as a response spectrum analysis takes them.

The dam answers a ground that moves like exp(i omega t). At its first resonance, of circular frequency omega_1 and
effective damping xi, one mode answers a quarter of a period late with 1 / (2 xi) times its share. So, with F(omega) the
forces of inertia and moving water on what is above a section for a unit acceleration of the ground,

    f_1 = 2 xi Im F(omega_1),      f_0 = -F(0)

are the first mode's push for a unit pseudo-acceleration, and that of a dam that moves with the ground. The second mode
is found in what the first one leaves: with H_1 = omega_1^2 / ((1 + 2 i xi_1) omega_1^2 - omega^2), and u the motion of
the crest relative to the ground, Im (u + u_1 H_1) has its highest peak at omega_2. At half its height the peak is
2 xi_2 omega_2 wide, and f_2 = 2 xi_2 Im (F + f_1 H_1) at its top."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from heeltoe.base.arrays import Floats
from heeltoe.base.blas import one_blas_thread
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.models.flexible.body.bonded import bonded_dam
from heeltoe.models.flexible.body.elastic import Body, dam
from heeltoe.models.flexible.body.modes import intact_periods
from heeltoe.models.flexible.body.reservoir import WaterBody, water_body
from heeltoe.models.flexible.body.rock import rock_material
from heeltoe.models.flexible.mesh.dam import dam_mesh
from heeltoe.models.flexible.surroundings.reduction import Complexes
from heeltoe.models.flexible.surroundings.response import CrestResponse, IntactDam, WaterOfDam, crest_response
from heeltoe.models.flexible.surroundings.rock import ReducedRock, reduced_rock

# Frequencies among which the first peak is looked for, up to so many times that of the dry dam on a rigid base.
_FARTHEST, _COUNT = 1.5, 91
# The same for the second one, from so many times the first resonance on; that of a slender cantilever is at 6.27 times.
_SECOND, _NEAREST, _COUNT_SECOND = 7.0, 1.3, 200
# Up to here water and rock answer well: the second mode of a gravity dam is at some 2.3 times the first.
_SURROUNDED = 4.5
# Where it is looked for more closely, and how often.
_FINE, _TIMES = 21, 2
# A peak that is broader than this damping ratio is no mode.
_BROADEST = 0.5
# A frequency so low that the dam moves with the ground, in parts of the first one.
_STILL = 1e-3


@dataclass(frozen=True, eq=False)
class SectionForces:
    """Forces on what is above the crack of a dam that is bonded, frequency by frequency.

    Attributes
    ----------
    dam
        With its crack bonded.
    upper
        The part above the crack.
    heel
        Of the crack, x and z [m].
    ratio
        Damping ratio of the concrete.
    water, waves, rock
        What is around the dam; the second are those of compressible water, if there is any.
    first
        First frequency of the dry dam on a rigid base [Hz].
    """

    dam: IntactDam
    upper: Body
    heel: tuple[float, float]
    ratio: float
    water: WaterOfDam
    waves: WaterBody | None
    rock: ReducedRock | None
    first: float

    @classmethod
    def of(cls, case: Case, farthest: float) -> SectionForces:
        """Return those of a case; water and rock answer well up to so many times the first frequency."""
        parts = dam(case, dam_mesh(case))
        intact = IntactDam.of(parts)
        first = 1.0 / float(intact_periods(parts, 1, water=False)[0])
        waves = water_body(case, parts.bodies, farthest * first)
        rock = None
        if case.rock is not None:
            rock = reduced_rock(intact.base, rock_material(case.rock), highest=farthest * first)
        water = WaterOfDam.of(intact, parts, waves)
        return cls(intact, parts.upper, case.above.heel, case.concrete.damping, water, waves, rock, first)

    def crest(self) -> CrestResponse:
        """Return how the crest answers up to the farthest frequency at which its first peak is looked for."""
        frequencies = np.linspace(0.0, _FARTHEST * self.first, _COUNT)
        return crest_response(self.dam, frequencies, self.ratio, water=self.water, rock=self.rock)

    def at(self, omega: float) -> Complexes:
        """Return the forces (4,) of inertia and moving water for a unit acceleration of the ground downstream like
        exp(i omega t): downstream, upward [kg per m], moment about the heel counter-clockwise, and what the upward
        ones add to that [kg]."""
        return self.answer(omega)[:4]

    def answer(self, omega: float) -> Complexes:
        """Return these forces (5,) and, last, the motion of the crest relative to the ground [s2]."""
        unknowns = self.dam.motion(omega, self.ratio, self.water, self.rock)
        moved = -(omega**2) * (self.dam.shapes[: self.upper.load.size] @ unknowns)
        moved[::2] += 1.0
        exerted = -(self.upper.mass @ moved)
        if self.waves is not None:
            driven = 1j * omega * (self.water.coupling @ unknowns) + self.water.ground / (1j * omega)
            exerted -= self.waves.coupling[0].T @ self.water.rates(omega, driven)
        x, z = (self.upper.mesh.nodes - np.array(self.heel)).T
        across, up = exerted[::2], exerted[1::2]
        return np.array([across.sum(), up.sum(), x @ up - z @ across, x @ up, self.dam.crest @ unknowns])


@dataclass(frozen=True, eq=False)
class Mode:
    """One mode of an intact dam.

    Attributes
    ----------
    period, damping
        [s], and the effective damping ratio.
    push
        (4,) for a unit pseudo-acceleration: push of the part above the crack downstream, upward [kg per m], moment
        about the heel counter-clockwise, and what the upward part adds to that [kg].
    """

    period: float
    damping: float
    push: Floats


@dataclass(frozen=True, eq=False)
class DamModes:
    """The modes of an intact dam.

    Attributes
    ----------
    first
        The first one.
    second
        None where waves that leave take so much from it that nothing of it peaks.
    rigid
        (4,) push of a dam that moves with a ground of unit acceleration, in the order of a mode's.
    """

    first: Mode
    second: Mode | None
    rigid: Floats

    @property
    def rest(self) -> Floats:
        """Push of all higher modes (4,), which follow the ground at once."""
        return self.rigid - self.first.push - (0.0 if self.second is None else self.second.push)


@one_blas_thread()
def dam_modes(case: Case, field: str) -> DamModes:
    """Return the first two modes of a dam with one crack, all bonded.

    Parameters
    ----------
    case
        Water and rock count as it has them.
    field
        What asks for it, for errors.

    Raises
    ------
    InputError
        Where the dam has no modulus, or is damped so much that its crest has no peak.
    """
    section = SectionForces.of(case, _SURROUNDED)
    response = section.crest()
    if response.resonance is None or response.damping is None:
        raise InputError("no-first-mode", field)
    omega = 2.0 * np.pi * response.resonance
    answer = 2.0 * response.damping * section.answer(omega).imag
    first = Mode(1.0 / response.resonance, response.damping, answer[:4])
    return DamModes(first, _second(section, first, answer), -section.at(_STILL * omega).real)


def _second(section: SectionForces, first: Mode, answer: Floats) -> Mode | None:
    """Return the second mode: the highest peak of what the first mode leaves of the motion of the crest, whose forces
    and motion at its resonance, over its amplification, are `answer` (5,)."""
    resonance = 2.0 * np.pi / first.period

    def left(omega: float) -> Floats:
        one = resonance**2 / ((1.0 + 2.0j * first.damping) * resonance**2 - omega**2)
        remaining: Floats = (section.answer(omega) + answer * one).imag
        return remaining

    omegas = np.linspace(_NEAREST * resonance, 2.0 * np.pi * _SECOND * section.first, _COUNT_SECOND)
    sizes = np.abs([left(omega)[-1] for omega in omegas])
    peaks = np.flatnonzero((sizes[1:-1] >= sizes[:-2]) & (sizes[1:-1] > sizes[2:])) + 1
    if not peaks.size:
        return None
    highest = peaks[np.argmax(sizes[peaks])]
    near = omegas[highest - 1 : highest + 2]
    for _ in range(_TIMES):
        near = np.linspace(near[0], near[-1], _FINE)
        top = int(np.clip(np.argmax([abs(left(omega)[-1]) for omega in near]), 1, near.size - 2))
        near = near[top - 1 : top + 2]
    peak = left(near[1])
    ends = [_half(lambda omega: abs(left(omega)[-1]) / abs(peak[-1]), near[1], side) for side in (-1.0, 1.0)]
    if ends[0] is None or ends[1] is None:
        return None
    damping = (ends[1] - ends[0]) / (2.0 * near[1])
    return Mode(2.0 * np.pi / near[1], damping, 2.0 * damping * peak[:4])


def _half(share: Callable[[float], float], top: float, side: float) -> float | None:
    """Return where a peak has fallen to half its height on one side; None where it does not."""
    reach = top * (1.0 + side * np.geomspace(1e-4, _BROADEST, 60))
    beyond = next((place for place, omega in enumerate(reach) if share(omega) < 0.5), None)
    if beyond is None:
        return None
    return float(brentq(lambda omega: share(omega) - 0.5, top if beyond == 0 else reach[beyond - 1], reach[beyond]))


@one_blas_thread()
def first_period(case: Case, field: str) -> float:
    """Return the first period of a dam with its cracks bonded, its water and its rock as the case has them [s].

    Where waves leave, through rock or through water with sound, it is that of the first peak of the crest's response;
    without them that of the first mode.

    Parameters
    ----------
    case
        A dam with a modulus.
    field
        What asks for it, for errors.

    Raises
    ------
    InputError
        Where the dam has no modulus, or is damped so much that its crest has no peak.
    """
    if case.rock is None and not case.has_compressible_water:
        return float(intact_periods(bonded_dam(case), 1)[0])
    resonance = SectionForces.of(case, _FARTHEST).crest().resonance
    if resonance is None:
        raise InputError("no-first-mode", field)
    return 1.0 / resonance
