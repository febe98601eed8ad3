"""The two lowest modes of an intact dam with its water and its rock, as a response spectrum analysis takes them.

The dam answers a ground that moves like exp(i omega t). At its first resonance, of circular frequency omega_1 and
effective damping xi_1, one mode answers a quarter of a period late with 1 / (2 xi_1) times its share. So, with F(omega)
the forces of inertia and moving water on what is above a section for a unit acceleration of the ground,

    f_1 = 2 xi_1 Im F(omega_1),      f_0 = -F(0)

are the first mode's push for a unit pseudo-acceleration, and that of a dam that moves with the ground. Without the
first mode, of H_1(omega) = 1 / (1 - r^2 + 2 i xi_1 r) with r = omega / omega_1, the second is found in the same way:

    f_2 = 2 xi_2 Im [F(omega_2) + f_1 H_1(omega_2)]

where what is left of the crest's motion, late by a quarter of a period, is largest at omega_2. It goes the other way
than in the first mode. Half of that is left at r omega_2, from which xi_2 = (1 - r^2) / (2 r): below the peak, where no
higher mode takes part."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.blas import one_blas_thread
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.mechanics.beam import beam
from heeltoe.models.flexible.body.bonded import bonded_dam
from heeltoe.models.flexible.body.elastic import Body, dam
from heeltoe.models.flexible.body.modes import intact_periods
from heeltoe.models.flexible.body.reservoir import WaterBody, water_body
from heeltoe.models.flexible.body.rock import rock_material
from heeltoe.models.flexible.mesh.dam import dam_mesh
from heeltoe.models.flexible.surroundings.reduction import Complexes
from heeltoe.models.flexible.surroundings.response import CrestResponse, IntactDam, WaterOfDam, crest_response
from heeltoe.models.flexible.surroundings.rock import ReducedRock, reduced_rock

# Number of frequencies among which the first peak is sought, up to this multiple of that of the dry dam.
_FARTHEST, _COUNT = 1.5, 91
# The second peak is sought at this number of frequencies, up to a multiple of the second frequency of a beam.
_BEYOND, _SECONDS = 1.4, 120
# A frequency so low that the dam moves with the ground, in parts of the first one.
_STILL = 1e-3


@dataclass(frozen=True, eq=False)
class SectionForces:
    """Forces on the part above the crack of a bonded dam, frequency by frequency.

    Attributes
    ----------
    dam
        With its crack bonded.
    upper
        The part above the crack.
    heel
        Heel of the crack, x and z [m].
    ratio
        Damping ratio of the concrete.
    water, waves, rock
        Surroundings of the dam; the second are the waves of compressible water, if there is any.
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
        """Return those of a case; water and rock answer well up to a multiple of the first frequency."""
        parts = dam(case, dam_mesh(case))
        intact = IntactDam.of(parts)
        first = 1.0 / float(intact_periods(parts, 1, water=False)[0])
        waves = water_body(case, parts.bodies, farthest * first)
        rock = None
        if case.foundation is not None:
            rock = reduced_rock(intact.base, rock_material(case.foundation), highest=farthest * first)
        water = WaterOfDam.of(intact, parts, waves)
        return cls(intact, parts.upper, case.above.heel, case.concrete.damping, water, waves, rock, first)

    def crest(self) -> CrestResponse:
        """Return how the crest answers up to the farthest frequency at which its first peak is looked for."""
        frequencies = np.linspace(0.0, _FARTHEST * self.first, _COUNT)
        return crest_response(self.dam, frequencies, self.ratio, water=self.water, rock=self.rock)

    def crest_motion(self, frequencies: Floats) -> Complexes:
        """Return the acceleration of the crest (k,) for a unit acceleration of the ground of frequencies [Hz]."""
        return self.dam.crest_motion(frequencies, self.ratio, self.water, self.rock)

    def at(self, omega: float) -> Complexes:
        """Return the forces (4,) of inertia and moving water for a unit acceleration of the ground downstream like
        exp(i omega t): downstream, upward [kg per m], moment about the heel counter-clockwise, and what the upward
        ones add to that [kg]."""
        unknowns = self.dam.motion(omega, self.ratio, self.water, self.rock)
        moved = -(omega**2) * (self.dam.shapes[: self.upper.load.size] @ unknowns)
        moved[::2] += 1.0
        exerted = -(self.upper.mass @ moved)
        if self.waves is not None:
            driven = 1j * omega * (self.water.coupling @ unknowns) + self.water.ground / (1j * omega)
            exerted -= self.waves.coupling[0].T @ self.water.rates(omega, driven)
        x, z = (self.upper.mesh.nodes - np.array(self.heel)).T
        across, up = exerted[::2], exerted[1::2]
        return np.array([across.sum(), up.sum(), x @ up - z @ across, x @ up])


@dataclass(frozen=True, eq=False)
class Mode:
    """A mode of an intact dam.

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

    def response(self, omega: Floats) -> Complexes:
        """Return the pseudo-acceleration (k,) for a unit acceleration of the ground of circular frequencies [rad/s]."""
        ratio = omega * self.period / (2.0 * np.pi)
        answer: Complexes = 1.0 / (1.0 - ratio**2 + 2j * self.damping * ratio)
        return answer


@dataclass(frozen=True, eq=False)
class LowestModes:
    """Modes of an intact dam for a response spectrum analysis.

    Attributes
    ----------
    first
        The mode of the crest's first peak.
    second
        The next one; None where waves leave so little of it that it has no peak.
    rigid
        (4,) push, as of a mode, of a dam that moves with a ground of unit acceleration.
    """

    first: Mode
    second: Mode | None
    rigid: Floats


@one_blas_thread()
def lowest_modes(case: Case, field: str) -> LowestModes:
    """Return the two lowest modes of a dam with one crack, all bonded.

    Parameters
    ----------
    case
        Water and rock count as it has them.
    field
        Field that asks for it, for errors.

    Raises
    ------
    InputError
        Where the dam has no modulus, or is damped so much that its crest has no peak.
    """
    periods = beam(case).periods
    farthest = max(_FARTHEST, _BEYOND * float(periods[0] / periods[1]))
    section = SectionForces.of(case, farthest)
    response = section.crest()
    if response.resonance is None or response.damping is None:
        raise InputError("no-first-mode", field)
    omega = 2.0 * np.pi * response.resonance
    first = Mode(1.0 / response.resonance, response.damping, 2.0 * response.damping * section.at(omega).imag)
    rigid = -section.at(_STILL * omega).real
    return LowestModes(first, _second_mode(section, first, farthest), rigid)


def _second_mode(section: SectionForces, first: Mode, farthest: float) -> Mode | None:
    """Return the mode of the second peak, sought up to a multiple of the first frequency of the dry dam."""
    frequencies = np.linspace(1.0 / first.period, farthest * section.first, _SECONDS)
    crest = section.crest_motion(frequencies)
    # The crest goes by the first mode as far as it does at that resonance.
    share = -2.0 * first.damping * crest[0].imag
    late = crest.imag - share * first.response(2.0 * np.pi * frequencies).imag
    peaks = 1 + np.flatnonzero((crest.imag[1:-1] > 0.0) & (late[1:-1] >= late[:-2]) & (late[1:-1] > late[2:]))
    below = np.flatnonzero(late[: peaks[0]] < 0.5 * late[peaks[0]]) if peaks.size else peaks
    if not below.size:
        return None
    # Closer, from half of the peak to its other side.
    frequencies = np.linspace(frequencies[below[-1]], frequencies[peaks[0] + 1], _SECONDS)
    late = section.crest_motion(frequencies).imag - share * first.response(2.0 * np.pi * frequencies).imag
    peak = int(np.argmax(late))
    resonance = float(frequencies[peak])
    ratio = float(frequencies[np.argmin(np.abs(late[: peak + 1] - 0.5 * late[peak]))]) / resonance
    damping, omega = (1.0 - ratio**2) / (2.0 * ratio), 2.0 * np.pi * resonance
    left = section.at(omega) + first.push * first.response(np.array(omega))
    return Mode(1.0 / resonance, damping, 2.0 * damping * left.imag)


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
        Field that asks for it, for errors.

    Raises
    ------
    InputError
        Where the dam has no modulus, or is damped so much that its crest has no peak.
    """
    if case.foundation is None and not case.has_compressible_water:
        return float(intact_periods(bonded_dam(case), 1)[0])
    resonance = SectionForces.of(case, _FARTHEST).crest().resonance
    if resonance is None:
        raise InputError("no-first-mode", field)
    return 1.0 / resonance
