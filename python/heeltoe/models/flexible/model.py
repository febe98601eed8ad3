"""The flexible model: case -> two elastic parts in their modes -> kernel -> response."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from heeltoe.case.model import Case
from heeltoe.errors import InputError
from heeltoe.kernel.dam import DamRun
from heeltoe.mechanics.block import Block, build_block, static_state
from heeltoe.models.flexible.cost import check_cost
from heeltoe.models.flexible.excitation import self_excitation
from heeltoe.models.flexible.expected import analysing, frame_step_of
from heeltoe.models.flexible.law.worn import Worn, check_law, law_found, law_warnings, worn_of
from heeltoe.models.flexible.reduced import FlexibleDam, build_flexible_dam
from heeltoe.models.flexible.refinement import Answer, answer
from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.models.flexible.shaken import ShakenDam
from heeltoe.models.flexible.stress.envelope import envelope_of
from heeltoe.models.flexible.stress.tension import tension_of, tension_warnings
from heeltoe.models.flexible.tables import (
    at_cracks,
    energy_of,
    histories_of,
    histories_of_cracks,
    modes_of,
    penetration_of,
    several_of,
    summary_of,
)
from heeltoe.models.flexible.warnings import outcome_of, stands, warnings_of
from heeltoe.models.silence import until_rest
from heeltoe.motion.earthquake import Earthquake
from heeltoe.references import cited
from heeltoe.result.rest import LAST_S, last_change, still_since
from heeltoe.units.sentences import Sentence
from heeltoe.warnings import Notice

_SHORTEST_FRAME_STEP = 1e-3


def run_flexible(case: Case, earthquake: Earthquake, output_step: float | None = None) -> FlexibleResponse:
    """Run the flexible model on a case, on through silence until the dam is at rest.

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
    check_law(case)
    end = earthquake.end
    if output_step is not None and not _SHORTEST_FRAME_STEP <= output_step <= end:
        raise InputError(
            "frame-step", "output_step", f"{output_step:g} s", shortest=f"{_SHORTEST_FRAME_STEP:g} s", end=f"{end:g} s"
        )
    block = build_block(case)
    frame_step = frame_step_of(end, output_step)
    silence = max(case.analysis.silence - earthquake.silence, 0.0)
    check_cost(case, analysing(case, earthquake.run_end, frame_step, silence=silence))
    found, earthquake = _answer(case, block, earthquake, frame_step)
    shaken, run, evidence = found.shaken, found.run, found.evidence
    # Its mesh may be finer by now.
    case, dam = shaken.case, shaken.dam
    outcome, advice = outcome_of(dam, block, run)
    # One that slides by itself needs no vibration to go on.
    growth = None if outcome == "unstable" else self_excitation(shaken, run)
    cracks, envelope = histories_of_cracks(case, dam, run), envelope_of(dam, run)
    history = cracks[dam.asked]
    worn = [worn_of(alone, place, dam, run) for place, alone in enumerate(case.cracks)]
    own = worn[dam.asked]
    tension = None if outcome == "unstable" else tension_of(found, envelope)
    return FlexibleResponse(
        model="flexible",
        title=case.title,
        outcome=outcome,
        advice=advice,
        warnings=(
            *warnings_of(shaken, run, cracks, found.evidences, growth, block.sliding_safety_factor, outcome),
            *tension_warnings(tension),
            *_about_the_laws(case, worn),
        ),
        summary=summary_of(shaken, run, evidence)
        | {
            "self_excitation": None if growth is None else growth.to_json(),
            "tension": tension,
            "friction_law": None if own is None else law_found(own, run, dam.asked),
            "penetration_m": penetration_of(run, history),
            **several_of(found, cracks),
        },
        energy=energy_of(run),
        motion=earthquake.motion,
        vertical=earthquake.vertical,
        gravity=case.gravity,
        histories=histories_of(shaken.shaking, run, dam.asked, law=own is not None),
        mode=modes_of(run, dam.asked),
        event_log={},
        static=static_state(block),
        references=_references(case, dam),
        silence_s=earthquake.silence,
        crack=history,
        envelope=envelope,
        at_cracks=at_cracks(found, cracks),
    )


def _answer(case: Case, block: Block, earthquake: Earthquake, frame_step: float) -> tuple[Answer, Earthquake]:
    """Run a dam until it is at rest, and gather evidence up to there; return the earthquake with its silence, too."""
    dam = build_flexible_dam(case)

    def run(through: Earthquake) -> tuple[Earthquake, ShakenDam, DamRun]:
        shaken = ShakenDam(case, dam, through.shaking)
        step = shaken.first_step()
        # Water and anchors may have made it shorter than could be expected.
        check_cost(case, analysing(case, through.run_end, frame_step, step))
        return through, shaken, shaken.run(step, frame_step)

    def reach(first: tuple[Earthquake, ShakenDam, DamRun]) -> float:
        return _reach(dam, block, first[-1])

    earthquake, shaken, first = until_rest(run, reach, earthquake, case.analysis.silence)
    # A dam that does not stand has no slip to be certain of; one run shows how it goes.
    asked = case.flexible.evidence if stands(dam, block) else "none"
    found = answer(shaken, frame_step, asked, first)
    if _reach(dam, block, found.run) < math.inf or earthquake.silence >= case.analysis.silence:
        return found, earthquake
    # Its mesh or step is finer now, and it takes longer.
    earthquake, shaken, first = run(earthquake.silent(case.analysis.silence))
    return answer(shaken, frame_step, asked, first), earthquake


def _reach(dam: FlexibleDam, block: Block, run: DamRun) -> float:
    """Return what :func:`until_rest` asks of a run."""
    if outcome_of(dam, block, run)[0] != "ok":
        return -math.inf
    reach = -math.inf
    for frames in run.all_frames:
        moved = tuple(frames[name] for name in ("time", "slip", "opening_heel", "opening_toe"))
        reach = max(reach, still_since(*moved) + LAST_S if last_change(*moved).rest else math.inf)
    return reach


def _references(case: Case, dam: FlexibleDam) -> tuple[str, ...]:
    keys = ["flexible", case.flexible.contact]
    moved = [(body.mass - body.mass_concrete).diagonal() for body in dam.bodies]
    if moved[0].any():
        keys.append("water")
    if any(water[1::2].any() for water in moved):
        keys.append("sloped water")
    if dam.water is not None:
        keys.append(case.uplift.during_shaking)
    if case.concrete.tensile_strength is not None:
        keys.append("dynamic tension")
    keys += [f"law: {alone.crack.law.name}" for alone in case.cracks if alone.crack.law is not None]
    return cited(*dict.fromkeys(keys))


def _about_the_laws(case: Case, worn: Sequence[Worn | None]) -> Iterator[Notice]:
    """Say of each crack with a law where that is used beyond what it was made for."""
    for alone, each in zip(case.cracks, worn, strict=True):
        if each is not None:
            where = Sentence.of(" at {at_m:g m}", at_m=alone.crack.elevation) if case.further_cracks else ""
            yield from law_warnings(each, where)
