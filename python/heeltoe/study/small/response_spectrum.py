"""Static checks with an earthquake by its response spectrum: first mode with water and rock, static correction."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from heeltoe.case.model import Case
from heeltoe.case.shaking import resolve
from heeltoe.errors.error import InputError, expect
from heeltoe.models.flexible.surroundings.first_mode import first_mode
from heeltoe.models.statics.joints import Joints
from heeltoe.models.statics.model import with_demand
from heeltoe.models.statics.spectral import Push, SpectralDemand
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.motion.targets import target_of

#: The spectrum of the case's own motion.
OF_MOTION = "motion"
# Ordinates of a design spectrum fall with damping by eta = sqrt(10 / (5 + 100 xi)), at least 0.55 (EN 1998-1, 3.2.2.2).
_LEAST_ETA = 0.55

# Name of a spectrum, its pseudo-acceleration at a period and a damping ratio, and that at period zero [m/s2].
_Spectrum = tuple[str, Callable[[float, float], float], float]


def with_response_spectrum(joints: Joints, spectrum: str = OF_MOTION, *, field: str = "spectrum") -> Joints:
    """Return static checks with two more load cases: an earthquake by its response spectrum, both ways.

    The dam is elastic and bonded, with water and rock as the case has them: its first mode by its period and its
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


def _spectrum_of(case: Case, spectrum: str, field: str) -> _Spectrum:
    if spectrum == OF_MOTION:
        if case.motion is None:
            raise InputError("motion-missing", "motion")
        motion, _ = resolve(case.motion, case.gravity, case.base_directory)

        def of_motion(period: float, damping: float) -> float:
            return float(response_spectrum(motion, [period], damping).pseudo_acceleration[0])

        return motion.name, of_motion, motion.pga
    target = target_of(spectrum, field, case.gravity)
    peak = float(target([target.shortest])[0])

    def of_target(period: float, damping: float) -> float:
        return float(target([period])[0]) * _eta(damping) / _eta(target.damping)

    return target.name, of_target, peak


def _eta(damping: float) -> float:
    return max(_LEAST_ETA, math.sqrt(10.0 / (5.0 + 100.0 * damping)))


def _demand(case: Case, spectrum: _Spectrum, field: str) -> SpectralDemand:
    name, ordinate, peak = spectrum
    mode = first_mode(case, field)
    acceleration = ordinate(mode.period, mode.damping)
    return SpectralDemand(
        spectrum=name,
        period_s=mode.period,
        damping_ratio=mode.damping,
        pseudo_acceleration_m_s2=acceleration,
        peak_ground_acceleration_m_s2=peak,
        first_mode=Push.of(acceleration * mode.push),
        static_correction=Push.of(peak * (mode.rigid - mode.push)),
    )
