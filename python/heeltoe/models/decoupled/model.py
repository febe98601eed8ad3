"""The decoupled chain: ground -> elastic part below the crack -> rigid part above it -> response."""

from __future__ import annotations

import math
from dataclasses import fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from heeltoe.case.model import Case
from heeltoe.case.shaking import resolve
from heeltoe.errors import InputError
from heeltoe.models.decoupled.chain import Chain, bonded_chain, chain
from heeltoe.models.decoupled.crack_motion import CrackMotion, crack_motion, crack_motion_at, relative
from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.models.rigid.model import rigid
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.moments import ground
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.references import cited
from heeltoe.result.response import Response
from heeltoe.warnings import Notice

Floats = NDArray[np.float64]

#: Damping ratio of the response spectra.
SPECTRUM_DAMPING = 0.05
# Periods of the spectra [s]; those of the dam come between them.
_PERIODS = np.geomspace(0.02, 4.0, 160)
_SHOWN = 5
# Longest spacing of the histories [s], where it is not given: the dam vibrates faster than records are sampled.
_OUTPUT_STEP = 0.005
# From which difference on a step of the crack's motion twice as long matters.
_CHANGE, _NOTHING = 0.02, 1e-4


def decoupled(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    *,
    output_step: float | None = None,
) -> DecoupledResponse:
    """Run the decoupled chain on a case with a crack at a height.

    The part below the crack is elastic and carries the part above as a rigid body; the acceleration of the crack then
    drives the rigid model of the part above.

    Parameters
    ----------
    case
        Dam, crack, water and earthquake; `decoupled` says what of the crack's motion the block feels. The vertical
        motion of the crack counts also where the case has a vertical ground motion.
    motion, vertical
        Ground motions to use, as they are, instead of the case's [m/s2, downstream and upward].
    output_step
        Spacing of the histories [s]; an even part of the record's step, up to 5 ms, where it is not given.

    Returns
    -------
    DecoupledResponse

    Raises
    ------
    InputError
        Where the crack is at the base, or the case has no motion or no modulus.
    """
    if motion is None:
        if case.motion is None:
            raise InputError("motion-missing", "motion")
        motion, vertical = resolve(case.motion, case.gravity, case.base_directory)
    part = chain(case)
    end = _end(case, motion)
    at_crack, straightness = crack_motion(part, motion, vertical, end)
    rough = crack_motion_at(part, motion, vertical, end, 2.0 * at_crack.step)
    if output_step is None:
        spacing = motion.dt if motion.is_uniform else _OUTPUT_STEP
        output_step = min(end, spacing / math.ceil(spacing / _OUTPUT_STEP * (1.0 - 1e-9)))
    block = _driven(case, at_crack, vertical is not None, output_step)
    coarser = _driven(case, rough, vertical is not None, output_step)
    if not block.summary:
        return _of_the_chain(block, motion=motion, vertical=vertical)
    level = _crack_level(case, part, at_crack, motion, vertical)
    level["convergence"] = {
        "step_s": at_crack.step,
        "straightness": straightness,
        "half_the_modes": _of_half_the_modes(part, at_crack, motion, vertical, end),
        **_change(block, coarser, rough.step),
    }
    return _of_the_chain(
        block,
        motion=motion,
        vertical=vertical,
        summary={**block.summary, "crack_level": level},
        histories=_histories(block, at_crack, motion, vertical, end),
        warnings=(*block.warnings, *_warnings(level)),
        references=(*block.references, *cited("decoupled", "piecewise exact")),
    )


def _of_the_chain(block: Response, **changes: Any) -> DecoupledResponse:
    """Return what the block has done as what the chain has done."""
    found = {each.name: getattr(block, each.name) for each in fields(block)}
    return DecoupledResponse(**(found | {"model": "decoupled"} | changes))


def crack_motions(
    case: Case, motion: GroundMotion, vertical: GroundMotion | None
) -> tuple[GroundMotion, GroundMotion | None, GroundMotion | None]:
    """Return what shakes the block: the crack's motion downstream and, where it is felt, upward and rotation."""
    found, _ = crack_motion(chain(case), motion, vertical, _end(case, motion))
    return (
        found.horizontal,
        found.vertical if _feels_vertical(case, vertical is not None) else None,
        found.rotation if case.decoupled.rotation else None,
    )


def _end(case: Case, motion: GroundMotion) -> float:
    return case.motion.duration if case.motion and case.motion.duration else motion.duration


def _feels_vertical(case: Case, shaken_upward: bool) -> bool:
    """A vertical ground motion that is given must not be lost on the way; what the crack adds to it belongs to it."""
    return case.decoupled.vertical or shaken_upward


def _driven(case: Case, found: CrackMotion, shaken_upward: bool, output_step: float) -> Response:
    """Shake the block by the motion of the crack."""
    vertical = found.vertical if _feels_vertical(case, shaken_upward) else None
    rotation = found.rotation if case.decoupled.rotation else None
    return rigid(case, found.horizontal, vertical, rotation, output_step=output_step)


def _crack_level(
    case: Case, part: Chain, found: CrackMotion, motion: GroundMotion, vertical: GroundMotion | None
) -> dict[str, Any]:
    g = case.gravity
    own = part.periods[:_SHOWN]
    bonded = bonded_chain(case)
    marked = np.concatenate([own, bonded.periods[:_SHOWN]])
    periods = np.unique(np.concatenate([_PERIODS, marked[marked >= _PERIODS[0]]]))
    felt = ["horizontal"]
    felt += ["vertical"] if _feels_vertical(case, vertical is not None) else []
    felt += ["rotation"] if case.decoupled.rotation else []
    spectra = {
        f"{name}_g": (response_spectrum(each, periods, SPECTRUM_DAMPING).pseudo_acceleration / g).tolist()
        for name, each in (("ground", motion), ("crack", found.horizontal))
    }
    beside = crack_motion_at(bonded, motion, vertical, _end(case, motion), found.step)
    return {
        "peak_horizontal_g": found.horizontal.pga / g,
        "peak_vertical_g": found.vertical.pga / g,
        "peak_rotation_rad_s2": found.rotation.pga,
        "ground_peak_g": motion.pga / g,
        "amplification": found.horizontal.pga / motion.pga if motion.pga else None,
        "felt": felt,
        "periods_s": own.tolist(),
        "damping_ratio": part.damping,
        "modes": int(part.omega.size),
        "spectrum": {
            "damping_ratio": SPECTRUM_DAMPING,
            "periods_s": periods.tolist(),
            **spectra,
            "transfer": part.transfer(periods).tolist(),
            "bonded_transfer": bonded.transfer(periods).tolist(),
        },
        "bonded": {
            "periods_s": bonded.periods[:_SHOWN].tolist(),
            "peak_horizontal_g": beside.horizontal.pga / g,
            "amplification": beside.horizontal.pga / motion.pga if motion.pga else None,
        },
    }


def _of_half_the_modes(
    part: Chain, found: CrackMotion, motion: GroundMotion, vertical: GroundMotion | None, end: float
) -> float:
    """Return what the slower half of the modes misses of the horizontal motion, over its peak."""
    less = crack_motion_at(part.slower_half(), motion, vertical, end, found.step).horizontal.acceleration
    exact = found.horizontal.acceleration
    return relative(less, exact, exact[None])


def _change(block: Response, coarser: Response, step: float) -> dict[str, float]:
    """Return what a step of the crack's motion twice as long does to the slip."""
    slip, other = block.residual_slip_m, coarser.summary["residual_slip_m"]
    change = abs(slip - other) / max(abs(slip), _NOTHING / _CHANGE)
    return {"coarser_step_s": step, "coarser_residual_slip_m": other, "change": change}


def _histories(
    block: Response, found: CrackMotion, motion: GroundMotion, vertical: GroundMotion | None, end: float
) -> dict[str, Floats]:
    """Put the ground's own motion where the block has that of the crack, and the crack's beside it."""
    histories = dict(block.histories)
    moments = histories["time_s"]
    time, horizontal, up = ground(motion, vertical, end)
    result = {"time_s": moments, "ground_acceleration_m_s2": np.interp(moments, time, horizontal)}
    if up is not None:
        result["vertical_ground_acceleration_m_s2"] = np.interp(moments, time, up)
    histories.pop("vertical_ground_acceleration_m_s2", None)
    for name, each in (
        ("crack_acceleration_m_s2", found.horizontal),
        ("vertical_crack_acceleration_m_s2", found.vertical),
        ("crack_rotation_acceleration_rad_s2", found.rotation),
    ):
        result[name] = np.interp(moments, each.time, each.acceleration)
    return result | {name: values for name, values in histories.items() if name not in result}


def _warnings(level: dict[str, Any]) -> tuple[Notice, ...]:
    found = level["convergence"]
    if not found["change"] > _CHANGE:
        return ()
    steps = {name: found[name] for name in ("coarser_step_s", "step_s")}
    return (Notice("sampling-matters", coarser_slip_m=found["coarser_residual_slip_m"], **steps),)
