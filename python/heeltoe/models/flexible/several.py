"""What each of several cracks did."""

from __future__ import annotations

from typing import Any

from heeltoe.kernel.dam import DAM_STATES, DamRun
from heeltoe.models.flexible.evidence import Evidence
from heeltoe.models.flexible.history import CrackHistory
from heeltoe.models.flexible.refinement import Answer
from heeltoe.models.flexible.response import AtCrack
from heeltoe.models.flexible.tables import crack_summary, histories_of, start_of


def several_of(found: Answer, cracks: tuple[CrackHistory, ...]) -> dict[str, Any]:
    """Return the numbers of the contract where there are several cracks: those of each, and which slips most."""
    told = at_cracks(found, cracks)
    if not told:
        return {}
    slips = [abs(each.summary["residual_slip_m"]) for each in told]
    of_crack = [{"elevation_m": each.elevation, **each.summary} for each in told]
    return {"governing_crack": slips.index(max(slips)), "cracks": of_crack}


def at_cracks(found: Answer, cracks: tuple[CrackHistory, ...]) -> tuple[AtCrack, ...]:
    """Return what each of several cracks did, from the crest down."""
    if len(cracks) == 1:
        return ()
    shaken, run = found.shaken, found.run
    told = []
    for place, history in enumerate(cracks):
        evidence = found.evidences[place] if found.evidences else None
        section = shaken.dam.sections[place]
        told.append(
            AtCrack(
                elevation=section.heel[1] - section.base_elevation,
                summary=_summary(found, history, evidence),
                histories=histories_of(shaken.shaking, run, place),
                mode=modes_of(run, place),
                crack=history,
            )
        )
    return tuple(told)


def _summary(found: Answer, history: CrackHistory, evidence: Evidence | None) -> dict[str, Any]:
    dam, run, place = found.shaken.dam, found.run, history.place
    raw = run.summaries[place]
    return {
        **crack_summary(dam, run, place, evidence),
        "friction": dam.lines[place].friction[1],
        "crack_energy": {"friction_j": raw["crack_friction"], "impact_j": raw["crack_impact"]},
        "before_shaking": start_of(dam, place),
        "penetration_m": penetration_of(run, history),
        "evidence": None if evidence is None else evidence.to_json(),
    }


def penetration_of(run: DamRun, history: CrackHistory) -> dict[str, float]:
    """Return how deep the faces of a crack are in each other at most [m]."""
    watched = run.summaries[history.place]["penetration"]
    return {"watched": watched, "any_in_frames": history.deepest_penetration()}


def modes_of(run: DamRun, place: int) -> tuple[str, ...]:
    """Return what the part above a crack does, frame by frame."""
    return tuple(DAM_STATES[int(state)] for state in run.all_frames[place]["state"])
