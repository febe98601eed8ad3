"""Warnings of a rigid run, and remedies where it stopped."""

from __future__ import annotations

import math

from heeltoe.case.model import Case
from heeltoe.kernel.block import BlockRun
from heeltoe.mechanics.anchors import anchors_hold
from heeltoe.mechanics.block import Block, instability
from heeltoe.mechanics.friction import range_of
from heeltoe.models.rigid.tables import anchors_of
from heeltoe.models.runner import about_the_anchors, advice_of
from heeltoe.result.outcome import Outcome
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice

# A block that rotates by more than this part of what would overturn it is pulled back noticeably less by its weight.
_SHARE_OF_SLENDERNESS = 0.1
# Less slip [m] changes no decision.
_SLIP_TO_TALK_ABOUT = 1e-3


def law_warnings(case: Case, block: Block) -> list[Notice]:
    """Say where a friction law is used beyond what it was made for."""
    law = case.crack.law
    if law is None:
        return []
    stress = block.normal_force / block.width
    why = range_of(law, stress)
    notices = [] if why is None else [Notice("law-range", "mean", stress_pa=stress, why=why, where="")]
    if law.name in ("barton-bandis", "lift joint"):
        notices.append(Notice("law-by-mean", law=law.name))
    return notices


def advice_of_block(block: Block, run: BlockRun, outcome: Outcome, rotation: float) -> Sentence | None:
    """Say where a run stopped, and what to do; None where there is a result to trust. `rotation` is the largest of the
    run [rad]."""
    if outcome.has_result:
        return None
    raw = run.summary
    stopped = Sentence.of(
        "stopped at {time_s:.6f s} in mode {mode} with slip {slip_m:.6g m} at {slip_velocity_m_s:.6g m/s}, heel gap "
        "{gap_heel_m:.6g m}, toe gap {gap_toe_m:.6g m}",
        time_s=raw.end_time,
        mode=repr(run.final_mode),
        slip_m=raw.slip,
        slip_velocity_m_s=raw.slip_velocity,
        gap_heel_m=raw.gap_heel,
        gap_toe_m=raw.gap_toe,
    )
    why = instability(block) or Sentence("its static loads are at the limit of friction or of overturning")
    return advice_of(outcome, rotation=rotation, why=why, stopped=stopped)


def warnings_of(case: Case, block: Block, run: BlockRun) -> list[Notice]:
    """Return what a reader of a rigid run must know."""
    raw, notices = run.summary, []
    if raw.energy_limited_impacts:
        notices.append(Notice("restitution-lowered", impacts=int(raw.energy_limited_impacts)))
    if raw.jams:
        notices.append(Notice("paradox-jammed", jams=int(raw.jams)))
    notices += law_warnings(case, block)
    if case.crack.bond is not None:
        notices.append(Notice("bond-of-block"))
    notices += _about_rare_choices(case, run)
    notices += _about_the_slip(case, run)
    # Integration is exact to a part of the crack's width, of which tiny motions are a tiny part.
    if raw.energy_residual > (1e-9 if run.exact else 1e-6):
        notices.append(Notice("energy-open", residual=raw.energy_residual))
    why = instability(block)
    if why is not None and anchors_hold(block):
        notices.append(Notice("friction-not-enough", "anchors", field="anchors", why=why))
    notices += about_the_anchors(anchors_of(case, run))
    if case.analysis.rotation == "small":
        notices += _about_the_rotation(block, run)
    return notices


def _about_rare_choices(case: Case, run: BlockRun) -> list[Notice]:
    """Say where a choice for a rare situation is given, and the run never came into one."""
    met = {
        "event_limit": (run.outcome == Outcome.EVENT_LIMIT, "the run has fewer events"),
        "paradox": (run.outcome == Outcome.PARADOX or run.summary.jams > 0.0, "no paradox was met"),
    }
    return [
        Notice("fields-idle", field=f"analysis.{name}", fields=f"analysis.{name}", why=why)
        for name, (happened, why) in met.items()
        if name in case.analysis.model_fields_set and not happened
    ]


def _about_the_slip(case: Case, run: BlockRun) -> list[Notice]:
    """Say where the slip is of little use."""
    raw, notices = run.summary, []
    in_the_air, sliding = abs(raw.slip_drifting), abs(raw.slip_sliding) + abs(raw.slip_slide_rocking)
    if case.crack.restitution > 0.0 and in_the_air > max(sliding, _SLIP_TO_TALK_ABOUT):
        notices.append(Notice("slip-in-the-air", slip_m=in_the_air, restitution=case.crack.restitution))
    return notices


def _about_the_rotation(block: Block, run: BlockRun) -> list[Notice]:
    """Say where the block turns so far that its weight pulls it back noticeably less."""
    notices = []
    for rotation, distance, corner in (
        (-run.summary.rotation_min, block.toe_distance, "toe"),
        (run.summary.rotation_max, block.heel_distance, "heel"),
    ):
        slenderness = math.atan2(distance, block.height)
        if rotation > _SHARE_OF_SLENDERNESS * slenderness:
            notices.append(
                Notice(
                    "rotation-large",
                    rotation_rad=rotation,
                    corner=corner,
                    share=rotation / slenderness,
                    slenderness_rad=slenderness,
                )
            )
    return notices
