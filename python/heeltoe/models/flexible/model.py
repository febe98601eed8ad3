"""The flexible model: case -> two elastic parts in their modes -> kernel -> response."""

from __future__ import annotations

from heeltoe import _kernel
from heeltoe.case.model import Case
from heeltoe.case.shaking import resolve
from heeltoe.case.warnings import case_warnings
from heeltoe.errors import InputError
from heeltoe.mechanics.block import build_block, static_state
from heeltoe.models.flexible.reduced import FlexibleDam, build_flexible_dam
from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.models.flexible.shaken import Shaken, converged
from heeltoe.models.flexible.tables import FRAME, anchors_of, energy_of, histories_of, history_of, summary_of
from heeltoe.models.flexible.warnings import advice_of, last_change, warnings_of
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.references import cited
from heeltoe.result.limits import check_limits

#: Frames kept: enough for an animation, few enough for memory.
_FRAME_STEP = 0.01


_SHORTEST_FRAME_STEP = 1e-3


def flexible(
    case: Case,
    motion: GroundMotion | None = None,
    vertical: GroundMotion | None = None,
    *,
    output_step: float | None = None,
    dam: FlexibleDam | None = None,
) -> FlexibleResponse:
    """Run the flexible model on a case.

    Parameters
    ----------
    case
        Dam, crack, water and earthquake.
    motion, vertical
        Ground motions to use, as they are, instead of the case's [m/s2, downstream and upward].
    output_step
        Spacing of the histories [s]; 0.01 s where it is not given. It does not change the motion that is computed.
    dam
        The case's dam, built before; saves the set-up in studies of one dam.

    Returns
    -------
    FlexibleResponse

    Raises
    ------
    InputError
        Where the case has no motion, no modulus or a mesh or a step that cannot be used.
    """
    if motion is None:
        if case.motion is None:
            raise InputError("motion-missing", "motion")
        motion, vertical = resolve(case.motion, case.gravity, case.base_directory)
    end = case.motion.duration if case.motion and case.motion.duration else motion.duration
    if output_step is not None and not _SHORTEST_FRAME_STEP <= output_step <= end:
        raise InputError(
            "frame-step", "output_step", f"{output_step:g} s", shortest=f"{_SHORTEST_FRAME_STEP:g} s", end=f"{end:g} s"
        )
    dam = dam or build_flexible_dam(case)
    shaken = Shaken(case, dam, motion, vertical, end)
    raw, frames, convergence = converged(shaken, output_step or min(_FRAME_STEP, end))
    outcome = _kernel.CRACK_OUTCOMES[int(raw["outcome"])]
    block = build_block(case)
    safety = block.sliding_safety_factor
    # Anchors with stiffness hold what friction does not.
    if outcome == "ok" and safety is not None and safety < 1.0 and not dam.anchors:
        outcome = "unstable"
    record = history_of(frames, dam, case.flexible.contactors)
    summary = summary_of(raw, dam, shaken, convergence)
    if case.anchors:
        summary["anchors"] = anchors_of(case, raw)
    summary["uplift_during_shaking"] = case.uplift.during_shaking
    return FlexibleResponse(
        model="flexible",
        title=case.title,
        outcome=outcome,
        advice=advice_of(outcome, raw),
        warnings=(
            *case_warnings(case),
            *motion.warnings,
            *warnings_of(case, dam, raw, record, convergence, safety, last_change(frames[0])),
        ),
        summary=summary,
        energy=energy_of(raw),
        motion=motion,
        vertical=vertical,
        gravity=case.gravity,
        histories=histories_of(frames[0], shaken),
        mode=tuple(_kernel.CRACK_STATES[int(state)] for state in frames[0][:, FRAME["state"]]),
        event_log={},
        static=static_state(block),
        references=_references(case, dam),
        crack=record,
        limits=check_limits(case.limits, summary),
    )


def _references(case: Case, dam: FlexibleDam) -> tuple[str, ...]:
    keys = ["flexible", case.flexible.contact]
    if dam.dam.upper.mass.sum() > dam.dam.upper.mass_concrete.sum() * (1.0 + 1e-12):
        keys.append("water")
    if dam.water is not None:
        keys.append(case.uplift.during_shaking)
    return cited(*keys)
