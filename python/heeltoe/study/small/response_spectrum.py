"""Static checks with an earthquake by its response spectrum: two modes with water and rock, static correction."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.case.shaking import resolve
from heeltoe.case.warnings import rock_warnings
from heeltoe.errors.error import InputError, expect
from heeltoe.models.flexible.surroundings.lowest_modes import Mode, lowest_modes
from heeltoe.models.statics.joints import Joint, Joints
from heeltoe.models.statics.model import with_demand
from heeltoe.models.statics.spectral import Push, SpectralDemand, SpectralMode
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.motion.targets import target_of

#: The spectrum of the case's own motion.
OF_MOTION = "motion"
# Ordinates of a design spectrum fall with damping by eta = sqrt(10 / (5 + 100 xi)), at least 0.55 (EN 1998-1, 3.2.2.2).
_LEAST_ETA = 0.55

# Where all motions have joined the ground, and the periods up to that at which their spectra are looked at.
_RIGID_HZ = 33.0
_PERIODS = np.geomspace(1.0 / _RIGID_HZ, 10.0, 200)


@dataclass(frozen=True)
class _Spectrum:
    """A spectrum: its name, its pseudo-acceleration [m/s2] at a period [s] and a damping ratio, that at period zero,
    and the frequency [Hz] up to which no oscillator goes with the ground."""

    name: str
    ordinate: Callable[[float, float], float]
    peak: float
    slow: float

    def rigid_share(self, period: float) -> float:
        """Return which part of an oscillator's response goes with the ground, as its acceleration does (Gupta 1990)."""
        rigid = (self.slow + 2.0 * _RIGID_HZ) / 3.0
        if rigid <= self.slow:
            return float(1.0 / period >= self.slow)
        return float(np.clip(math.log(1.0 / (period * self.slow)) / math.log(rigid / self.slow), 0.0, 1.0))


def with_response_spectrum(joints: Joints, spectrum: str = OF_MOTION, *, field: str = "spectrum") -> Joints:
    """Return static checks with two more load cases: an earthquake by its response spectrum, both ways.

    The dam is elastic and bonded, with water and rock as the case has them: its two lowest modes by their periods and
    effective damping, all higher ones by a static correction. The part of a mode that goes with the ground adds to that
    correction with its sign, the rest by the root of the sum of squares.

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
    expect(joints, Joints, "static checks", "joints")
    result = _spectrum_of(joints.joints[0].case, spectrum, field)

    def judged(joint: Joint) -> Joint:
        statics = with_demand(joint.statics, joint.case, _demand(joint.case, result, field))
        return replace(joint, statics=replace(statics, warnings=(*statics.warnings, *rock_warnings(joint.case))))

    return replace(joints, joints=tuple(map(judged, joints.joints)))


def _spectrum_of(case: Case, spectrum: str, field: str) -> _Spectrum:
    if spectrum == OF_MOTION:
        if case.motion is None:
            raise InputError("motion-missing", "motion")
        motion, _ = resolve(case.motion, case.gravity, case.base_directory)

        def of_motion(period: float, damping: float) -> float:
            return float(response_spectrum(motion, [period], damping).pseudo_acceleration[0])

        slow = _slow(_PERIODS, response_spectrum(motion, _PERIODS).pseudo_acceleration)
        return _Spectrum(motion.name, of_motion, motion.pga, slow)
    target = target_of(spectrum, field, case.gravity)
    peak = float(target([target.shortest])[0])

    def of_target(period: float, damping: float) -> float:
        return float(target([period])[0]) * _eta(damping) / _eta(target.damping)

    periods = np.clip(_PERIODS, target.shortest, target.longest)
    return _Spectrum(target.name, of_target, peak, _slow(periods, target(periods)))


def _slow(periods: Floats, accelerations: Floats) -> float:
    """Return the frequency at which the largest acceleration and the largest velocity of a spectrum meet [Hz]."""
    fastest = float(np.max(accelerations * periods, initial=0.0))
    return float(np.max(accelerations)) / fastest if fastest > 0.0 else 1.0


def _eta(damping: float) -> float:
    return max(_LEAST_ETA, math.sqrt(10.0 / (5.0 + 100.0 * damping)))


def _demand(case: Case, spectrum: _Spectrum, field: str) -> SpectralDemand:
    modes = lowest_modes(case, field)
    first, second = modes.first, modes.second
    shares = first.push if second is None else first.push + second.push

    def of_mode(mode: Mode) -> SpectralMode:
        acceleration = spectrum.ordinate(mode.period, mode.damping)
        return SpectralMode(
            period_s=mode.period,
            damping_ratio=mode.damping,
            pseudo_acceleration_m_s2=acceleration,
            rigid_share=spectrum.rigid_share(mode.period),
            push=Push.of(acceleration * mode.push),
        )

    return SpectralDemand(
        spectrum=spectrum.name,
        peak_ground_acceleration_m_s2=spectrum.peak,
        first_mode=of_mode(first),
        second_mode=None if second is None else of_mode(second),
        static_correction=Push.of(spectrum.peak * (modes.rigid - shares)),
    )
