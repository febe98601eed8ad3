"""The flexible model: case -> two elastic parts in their modes -> kernel -> response."""

from __future__ import annotations

from heeltoe.case.model import Case
from heeltoe.errors import InputError
from heeltoe.kernel.dam import DAM_STATES
from heeltoe.mechanics.block import build_block, static_state
from heeltoe.models.flexible.excitation import self_excitation
from heeltoe.models.flexible.reduced import FlexibleDam, build_flexible_dam
from heeltoe.models.flexible.refinement import answer
from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.models.flexible.shaken import ShakenDam
from heeltoe.models.flexible.tables import energy_of, histories_of, history_of, summary_of
from heeltoe.models.flexible.warnings import outcome_of, stands, warnings_of
from heeltoe.motion.earthquake import Earthquake
from heeltoe.references import cited

#: Frames kept: enough for an animation, few enough for memory.
_FRAME_STEP = 0.01
_SHORTEST_FRAME_STEP = 1e-3


def run_flexible(case: Case, earthquake: Earthquake, output_step: float | None = None) -> FlexibleResponse:
    """Run the flexible model on a case.

    Parameters
    ----------
    case
        Dam, crack and water.
    earthquake
        What shakes the ground.
    output_step
        Spacing of the histories [s]; 0.01 s where it is not given.

    Raises
    ------
    InputError
        Where the case has no modulus or a mesh or a step that cannot be used.
    """
    end = earthquake.end
    if output_step is not None and not _SHORTEST_FRAME_STEP <= output_step <= end:
        raise InputError(
            "frame-step", "output_step", f"{output_step:g} s", shortest=f"{_SHORTEST_FRAME_STEP:g} s", end=f"{end:g} s"
        )
    shaken = ShakenDam(case, build_flexible_dam(case), earthquake.shaking)
    # A dam that does not stand has no slip to be certain of; one run shows how it goes.
    asked = case.flexible.evidence if stands(shaken.dam, build_block(case)) else "none"
    found = answer(shaken, output_step or min(_FRAME_STEP, end), asked)
    shaken, run, evidence = found.shaken, found.run, found.evidence
    # Its mesh may be finer by now.
    case, dam = shaken.case, shaken.dam
    block = build_block(case)
    outcome, advice = outcome_of(dam, block, run)
    # One that slides by itself needs no vibration to go on.
    growth = None if outcome == "unstable" else self_excitation(shaken, run)
    history = history_of(case, dam, run)
    return FlexibleResponse(
        model="flexible",
        title=case.title,
        outcome=outcome,
        advice=advice,
        warnings=tuple(warnings_of(shaken, run, history, evidence, growth, block.sliding_safety_factor, outcome)),
        summary=summary_of(shaken, run, evidence)
        | {
            "self_excitation": None if growth is None else growth.to_json(),
            "penetration_m": {"watched": run.summary["penetration"], "any_in_frames": history.deepest_penetration()},
        },
        energy=energy_of(run),
        motion=earthquake.motion,
        vertical=earthquake.vertical,
        gravity=case.gravity,
        histories=histories_of(shaken.shaking, run),
        mode=tuple(DAM_STATES[int(state)] for state in run.frames["state"]),
        event_log={},
        static=static_state(block),
        references=_references(case, dam),
        crack=history,
    )


def _references(case: Case, dam: FlexibleDam) -> tuple[str, ...]:
    keys = ["flexible", case.flexible.contact]
    moved = [(body.mass - body.mass_concrete).diagonal() for body in dam.bodies]
    if moved[0].any():
        keys.append("water")
    if any(water[1::2].any() for water in moved):
        keys.append("sloped water")
    if dam.water is not None:
        keys.append(case.uplift.during_shaking)
    return cited(*keys)
