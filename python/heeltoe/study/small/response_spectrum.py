"""Static checks with an earthquake by its response spectrum: two modes with water and rock, static correction."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.case.shaking import resolve
from heeltoe.errors.error import InputError, expect
from heeltoe.models.flexible.surroundings.dam_modes import Mode, dam_modes
from heeltoe.models.statics.joints import Joints
from heeltoe.models.statics.model import with_demand
from heeltoe.models.statics.spectral import Push, SecondMode, SpectralDemand
from heeltoe.motion.spectrum import PERIODS, response_spectrum, rigid_share
from heeltoe.motion.targets import target_of

#: The spectrum of the case's own motion.
OF_MOTION = "motion"
# Ordinates of a design spectrum fall with damping by eta = sqrt(10 / (5 + 100 xi)), at least 0.55 (EN 1998-1, 3.2.2.2).
_LEAST_ETA = 0.55

# Periods [s] among which its shape is looked at, as far as standards define theirs.
_SHAPE: Floats = PERIODS[PERIODS <= 4.0]


@dataclass(frozen=True)
class _Ordinates:
    """A spectrum: its name, its pseudo-accelerations at periods [s] for a damping ratio, and that at period zero
    [m/s2]."""

    name: str
    ordinates: Callable[[Floats, float], Floats]
    peak: float

    def of_mode(self, period: float, damping: float) -> tuple[float, float]:
        """Return the pseudo-acceleration of a mode [m/s2] and the share of it that follows the ground at once."""
        at = self.ordinates(_SHAPE, damping)
        return float(self.ordinates(np.array([period]), damping)[0]), rigid_share(_SHAPE, at, self.peak, period)


def with_response_spectrum(joints: Joints, spectrum: str = OF_MOTION, *, field: str = "spectrum") -> Joints:
    """Return static checks with two more load cases: an earthquake by its response spectrum, both ways.

    The dam is elastic and bonded, with water and rock as the case has them: its first two modes by their periods and
    effective damping, all higher modes by a static correction.

    Parameters
    ----------
    joints
        From :func:`heeltoe.statics_of_sections`.
    spectrum
        ``"motion"`` for that of the case's motion, else a design spectrum as ``heeltoe motion --match`` takes it:
        ``"en1998:0.3 g,B"``, ``"asce7:0.9 g,0.4 g,8 s"``, or a file.
    field
        What the spectrum is called in errors.

    Raises
    ------
    InputError
        Where the spectrum, the motion or the modulus cannot be used, or the dam has no first mode.
    """
    expect(joints, Joints, "not-checks", "joints")
    result = _spectrum_of(joints.joints[0].case, spectrum, field)
    return replace(
        joints,
        joints=tuple(
            replace(joint, statics=with_demand(joint.statics, joint.case, _demand(joint.case, result, field)))
            for joint in joints.joints
        ),
    )


def _spectrum_of(case: Case, spectrum: str, field: str) -> _Ordinates:
    if spectrum == OF_MOTION:
        if case.motion is None:
            raise InputError("motion-missing", "motion")
        motion, _ = resolve(case.motion, case.gravity, case.base_directory)

        def of_motion(periods: Floats, damping: float) -> Floats:
            return response_spectrum(motion, periods, damping).pseudo_acceleration

        return _Ordinates(motion.name, of_motion, motion.pga)
    target = target_of(spectrum, field, case.gravity)
    peak = float(target([target.shortest])[0])

    def of_target(periods: Floats, damping: float) -> Floats:
        within = periods if periods.size == 1 else np.clip(periods, target.shortest, target.longest)
        return target(within) * _eta(damping) / _eta(target.damping)

    return _Ordinates(target.name, of_target, peak)


def _eta(damping: float) -> float:
    return max(_LEAST_ETA, math.sqrt(10.0 / (5.0 + 100.0 * damping)))


def _demand(case: Case, spectrum: _Ordinates, field: str) -> SpectralDemand:
    modes = dam_modes(case, field)
    first, second = modes.first, modes.second
    acceleration, share = spectrum.of_mode(first.period, first.damping)
    return SpectralDemand(
        spectrum=spectrum.name,
        period_s=first.period,
        damping_ratio=first.damping,
        pseudo_acceleration_m_s2=acceleration,
        rigid_share=share,
        first_mode=Push.of(acceleration * first.push),
        second_mode=None if second is None else _second(second, spectrum),
        peak_ground_acceleration_m_s2=spectrum.peak,
        static_correction=Push.of(spectrum.peak * modes.rest),
    )


def _second(mode: Mode, spectrum: _Ordinates) -> SecondMode:
    acceleration, share = spectrum.of_mode(mode.period, mode.damping)
    return SecondMode(
        period_s=mode.period,
        damping_ratio=mode.damping,
        pseudo_acceleration_m_s2=acceleration,
        rigid_share=share,
        push=Push.of(acceleration * mode.push),
    )
