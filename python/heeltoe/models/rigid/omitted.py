"""What a rigid block leaves out of a dam: the dam's own vibration, and what it makes of the ground's motion."""

from __future__ import annotations

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.kept import Kept
from heeltoe.mechanics.beam import Beam, beam
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.units.sentences import Sentence
from heeltoe.warnings import Notice

#: Moduli that the concrete of dams usually has [Pa].
USUAL_MODULI = (15e9, 35e9)
#: Shaking that is amplified by less than this makes a block of the dam as good as a dam.
_NOTICED = 1.1
#: No earthquake shakes what swings faster than this [s].
_STIFF_S = 0.02
_SAME = 1.05

_Swung = tuple[Beam, Floats, Floats | None]
_KEPT: Kept[_Swung] = Kept(8)


def omitted(case: Case, motion: GroundMotion) -> tuple[Notice, ...]:
    """Return what the dam's own vibration would do in a motion, for its modulus or for usual ones; nothing where the
    dam is so stiff and low that the motion hardly feels it."""
    if not motion.pga:
        return ()
    modulus = case.concrete.modulus
    moduli = USUAL_MODULI if modulus is None else (modulus,)
    found, periods, felt = _swung(case, motion, moduli)
    if felt is None:
        return ()
    first = felt[:, 0]
    # At the level of the crack, the modes by the root of the sum of their squares, and the ground itself.
    reached = [np.interp(case.crack.elevation, found.levels, mode) for mode in found.reached.T]
    there = np.sqrt(motion.pga**2 + np.sum((felt * np.array(reached)) ** 2, axis=1))
    if max(first.max(), there.max()) <= _NOTICED * motion.pga:
        return ()
    level: Sentence | str = ""
    if case.crack.elevation > 0.0:
        level = Sentence.of(
            "; at the crack, {elevation_m:g m} above the base, it shakes with about {peaks_g:.2g g|to}, {times:.2g|to} "
            "times the ground's peak",
            elevation_m=case.crack.elevation,
            peaks_g=_ends(there / case.gravity),
            times=_ends(there / motion.pga),
        )
    remedy = "give concrete.modulus" if modulus is None else "run it with --model auto"
    return (
        Notice(
            "rigid-block",
            moduli_pa=moduli,
            periods_s=_ends(periods[:, 0]),
            accelerations_g=_ends(first / case.gravity),
            times=_ends(first / motion.pga),
            level=level,
            remedy=remedy,
        ),
    )


def _swung(case: Case, motion: GroundMotion, moduli: tuple[float, ...]) -> _Swung:
    """Return the dam as a beam, and for each modulus the periods of its modes and the pseudo-accelerations of the
    motion there; None instead of these where the dam is too stiff to ask. Kept for cases that differ elsewhere."""
    water = case.reservoir and (case.reservoir.depth, case.reservoir.density)
    concrete = case.concrete

    def build() -> _Swung:
        found = beam(case)
        periods = found.periods / np.sqrt(np.array(moduli))[:, None]
        if periods[:, 0].max() < _STIFF_S:
            return found, periods, None
        spectrum = response_spectrum(motion, periods.ravel(), concrete.damping)
        return found, periods, spectrum.pseudo_acceleration.reshape(periods.shape)

    key = (case.section, concrete.density, concrete.poisson, concrete.damping, water, motion, moduli)
    return _KEPT.get(key, build)


def _ends(values: Floats) -> tuple[float, ...]:
    """Return the least and the largest, or the largest alone where they are about the same."""
    low, high = float(values.min()), float(values.max())
    return (high,) if high <= _SAME * low else (low, high)
