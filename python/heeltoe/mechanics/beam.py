"""A dam as a beam: about how long it swings, and how far each level of it does, without building elastic parts.

The whole section, uncracked, is a cantilever that bends and shears (Timoshenko), with the virtual water of a vertical
face; its axis is taken for straight. Its first period is up to 12 % off that of the elastic parts. What a motion does
to it is what a rigid block of the dam leaves out.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.cache import Kept
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.measures import mean_period
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.warnings.notice import Notice

_PIECES = 20
#: Share of a rectangle's area that carries shear.
_SHEAR = 5.0 / 6.0
_MODES = 3
#: No earthquake shakes what swings faster than this [s].
STIFF_S = 0.02
# So much of the amplitude of the first mode the straight lines between the values of a record may leave out, and how
# long their step is then, over the period: sinc(0.0956)**2 = 0.97.
_MOST_LEFT_OUT, _ENOUGH_STEPS = 0.03, 0.0956
# Rock and water answer well up to this multiple of the frequency of the last mode of the dam that matters.
_BEYOND_MODES = 4.0 / 3.0
# Waves within the depth of the water, and within the base on rock, that the stiffest dams of concrete do not reach: a
# wider band would cost memory, and slow motions their accuracy.
_SOUND_WAVES, _SHEAR_WAVES = 2.0, 4.0


@dataclass(frozen=True, eq=False)
class Beam:
    """A dam in its lowest modes.

    Attributes
    ----------
    periods
        (m,) with the water, for a modulus of 1 Pa; they go with one over its square root [s].
    levels
        (n,) from the base to the crest [m].
    reached
        (n, m) how far each level swings in each mode, over the spectral displacement.
    """

    periods: Floats
    levels: Floats
    reached: Floats


_Swung = tuple[Beam, Floats, Floats | None, float | None]
_KEPT: Kept[_Swung] = Kept(8)
_BEAMS: Kept[Beam] = Kept(8)


@dataclass(frozen=True, eq=False)
class Swing:
    """A dam in a motion, for each of some moduli.

    Attributes
    ----------
    periods
        (k,) first periods [s].
    peak
        Peak acceleration of the ground [m/s2].
    mean_period
        Of the motion [s]; None where it jumps and so has no Fourier transform.
    accelerations
        (k,) pseudo-accelerations of the motion there, with the damping of the concrete [m/s2].
    at_crack
        (k,) peak accelerations at the level of the crack [m/s2]: the modes by the root of the sum of their squares, and
        the ground itself.
    """

    periods: Floats
    peak: float
    mean_period: float | None
    accelerations: Floats
    at_crack: Floats


def swing_of(case: Case, motion: GroundMotion, moduli: tuple[float, ...]) -> Swing | None:
    """Return how a dam swings with each of these moduli [Pa]; nothing where it is too stiff for any
    earthquake, or nothing moves."""
    peak = motion.pga
    if not peak:
        return None
    spectrum, periods, felt, mean = _swung(case, motion, moduli)
    if felt is None:
        return None
    reached = [np.interp(case.crack.elevation, spectrum.levels, mode) for mode in spectrum.reached.T]
    at_crack = np.sqrt(peak**2 + np.sum((felt * np.array(reached)) ** 2, axis=1))
    return Swing(periods[:, 0], peak, mean, felt[:, 0], at_crack)


def step_warnings(case: Case, motion: GroundMotion) -> tuple[Notice, ...]:
    """Return a warning where a record has its values too far apart for the first mode of an elastic dam.

    Straight lines between the values of a wave of frequency f, taken every h, leave sinc(f h) squared of its amplitude.
    """
    modulus = case.concrete.modulus
    if modulus is None or motion.format in ("points", "synthetic"):
        return ()
    swing = swing_of(case, motion, (modulus,))
    if swing is None:
        return ()
    period = float(swing.periods[0])
    # Beyond one value for each swing nothing of it is known.
    left = float(np.sinc(min(motion.dt / period, 1.0)) ** 2)
    if 1.0 - left <= _MOST_LEFT_OUT:
        return ()
    return (
        Notice(
            "motion-coarse-for-dam",
            name=motion.name,
            step_s=motion.dt,
            period_s=period,
            share=1.0 - left,
            most_s=_ENOUGH_STEPS * period,
        ),
    )


def _swung(case: Case, motion: GroundMotion, moduli: tuple[float, ...]) -> _Swung:
    """Return the dam as a beam, for each modulus the periods of its modes and the pseudo-accelerations of the motion
    there, and its mean period; None instead of the last two where the dam is too stiff to ask. Kept for cases that
    differ elsewhere."""
    water = case.reservoir and (case.reservoir.depth, case.reservoir.density)
    concrete = case.concrete

    def build() -> _Swung:
        dam_beam = beam(case)
        periods = dam_beam.periods / np.sqrt(np.array(moduli))[:, None]
        if periods[:, 0].max() < STIFF_S:
            return dam_beam, periods, None, None
        spectrum = response_spectrum(motion, periods.ravel(), concrete.damping)
        return dam_beam, periods, spectrum.pseudo_acceleration.reshape(periods.shape), _mean_period(motion)

    key = (case.section, concrete.density, concrete.poisson, concrete.damping, water, motion, moduli)
    return _KEPT.get(key, build)


def _mean_period(motion: GroundMotion) -> float | None:
    try:
        return mean_period(motion)
    except InputError:
        return None


def beam(case: Case) -> Beam:
    """Return the dam of a case as a beam; the last few are kept."""
    concrete = case.concrete
    return _BEAMS.get((case.section, concrete.density, concrete.poisson, case.reservoir), lambda: _beam(case))


def _beam(case: Case) -> Beam:
    corners = np.array(case.section.vertices())
    base, crest = corners[:, 1].min(), corners[:, 1].max()
    levels = np.linspace(base, crest, _PIECES + 1)
    length = float(levels[1] - levels[0])
    wide = _widths(corners, (levels[1:] + levels[:-1]) / 2.0)
    size = 2 * (_PIECES + 1)
    stiffness, mass = np.zeros((size, size)), np.zeros(size)
    half = case.concrete.density * length / 2.0 * np.column_stack([wide, wide**3 / 12.0])
    for piece, (stiff, heavy) in enumerate(zip(_stiffness(wide, length, case.concrete.poisson), half, strict=True)):
        place = 2 * piece
        stiffness[place : place + 4, place : place + 4] += stiff
        mass[place : place + 2] += heavy
        mass[place + 2 : place + 4] += heavy
    if case.reservoir is not None:
        deep = case.reservoir.depth
        below = np.clip(deep - (levels - base), 0.0, None)
        mass[::2] += 7.0 / 8.0 * case.reservoir.density * np.sqrt(deep * below) * length
    # The base is held.
    root = np.sqrt(mass[2:])
    squares, turned = np.linalg.eigh(stiffness[2:, 2:] / np.outer(root, root))
    shapes = turned[:, :_MODES] / root[:, None]
    shares = shapes[::2].T @ mass[2::2]
    swing = np.vstack([np.zeros(_MODES), shapes[::2] * shares])
    return Beam(2.0 * np.pi / np.sqrt(squares[:_MODES]), levels - base, swing)


def band_of(case: Case) -> float:
    """Return up to which frequency [Hz] the modes of a dam that matter answer an earthquake, and a third more: those of
    the whole dam as a beam that carry its horizontal motion, three of them.

    It goes with the dam: one of the same shape that is so many times as large, of concrete so many times as stiff,
    swings by the root of that more slowly. No mesh has a part in it. A dam stiffer than all concretes is a block to
    waves of which two lie within the depth of the water, or four within its base: it asks for no shorter ones.
    """
    modulus = case.concrete.modulus
    assert modulus is not None
    band = float(_BEYOND_MODES * np.sqrt(modulus) / beam(case).periods.min())
    for side, water in (("reservoir", case.reservoir), ("tailwater", case.tailwater)):
        if water is not None and case.has_sound(side) and water.depth > 0.0:
            band = min(band, _SOUND_WAVES * water.wave_speed / water.depth)
    if (rock := case.foundation) is not None:
        left, _, right, _ = case.outline.bounds
        shear_speed = math.sqrt(rock.modulus / (2.0 * (1.0 + rock.poisson) * rock.density))
        band = min(band, _SHEAR_WAVES * shear_speed / (right - left))
    return band


def _widths(corners: Floats, levels: Floats) -> Floats:
    """Return how wide the section is at some levels [m]."""
    (x0, z0), (x1, z1) = corners.T, np.roll(corners, -1, axis=0).T
    level = levels[:, None]
    # Where the outline goes up there is concrete on one side of it, where it goes down on the other.
    way = np.where(z1 > level, 1.0, 0.0) - np.where(z0 > level, 1.0, 0.0)
    share = (level - z0) / np.where(z1 == z0, 1.0, z1 - z0)
    width: Floats = np.abs(np.sum(way * (x0 + share * (x1 - x0)), axis=1))
    return width


def _stiffness(width: Floats, length: float, poisson: float) -> Floats:
    """Return the stiffness (n, 4, 4) of pieces of a modulus of 1 Pa against displacement and rotation of both ends."""
    bending = width**3 / 12.0
    soft = 12.0 * bending * 2.0 * (1.0 + poisson) / (_SHEAR * width * length**2)
    twelve, a = np.full_like(width, 12.0), np.full_like(width, 6.0 * length)
    b, c = (4.0 + soft) * length**2, (2.0 - soft) * length**2
    rows = [[twelve, a, -twelve, a], [a, b, -a, c], [-twelve, -a, twelve, -a], [a, c, -a, b]]
    result: Floats = np.moveaxis(bending / (length**3 * (1.0 + soft)) * np.array(rows), -1, 0)
    return result
