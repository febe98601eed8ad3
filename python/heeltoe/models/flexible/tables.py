"""What the kernel found of an elastic dam, by the names of the contract."""

from __future__ import annotations

from typing import Any

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.kernel.dam import DAM_STATES, DamRun
from heeltoe.kernel.shaking import Shaking
from heeltoe.models.flexible.evidence import Evidence
from heeltoe.models.flexible.history import CrackHistory, watched_nodes
from heeltoe.models.flexible.law.worn import law_found, sliding_friction, worn_of
from heeltoe.models.flexible.reduced import FlexibleDam, apart
from heeltoe.models.flexible.refinement import Answer
from heeltoe.models.flexible.response import AtCrack
from heeltoe.models.flexible.shaken import ShakenDam
from heeltoe.result.response import Energy


def anchors_of(case: Case, run: DamRun) -> list[dict[str, float | None]]:
    """Return the largest tension [N] of each anchor, and what it is good for."""
    tensions = iter(run.tension)
    found: list[dict[str, float | None]] = []
    for anchor in case.anchors_at_crack:
        stiff = anchor.axial_stiffness or anchor.shear_stiffness
        tension = next(tensions) if stiff else anchor.prestress
        found.append({"distance_m": anchor.distance, "peak_tension_n": tension, "capacity_n": anchor.capacity})
    return found


def histories_of_cracks(case: Case, dam: FlexibleDam, run: DamRun) -> tuple[CrackHistory, ...]:
    """Return the frames of a run, crack by crack from the crest down."""
    time, modes = run.frames["time"], apart(run.modes, dam.modes)
    bodies = [table.reshape(time.size, 2, -1) for table in (run.upper, run.lower)]
    nodes = bodies[0].shape[2]
    # Of the only crack the kernel keeps the forces on the upper face alone.
    split = np.split(run.force, [2 * nodes], axis=1)
    forces = [table.reshape(time.size, 2, -1) for table in split]
    found, watched = [], 0
    for place, line in enumerate(dam.lines):
        (first, count), (low, counted) = line.upper, line.lower
        side = place % 2
        contacts = contactors_of([count, counted][: 1 + bool(counted)], case.flexible.contactors)
        found.append(
            CrackHistory(
                time=time,
                upper_position=bodies[side][:, :, first : first + count],
                lower_position=bodies[1 - side][:, :, low : low + counted] if counted else None,
                force=forces[side][:, :, first : first + count],
                status=run.status[:, watched : watched + contacts],
                modes=modes,
                dam=dam,
                contactors=case.flexible.contactors,
                place=place,
            )
        )
        watched += contacts
    return tuple(found)


def contactors_of(nodes: list[int], contactors: int) -> int:
    """Return how many nodes of a crack are watched."""
    return sum(each.size for _, each in watched_nodes(nodes, contactors))


def crack_summary(dam: FlexibleDam, run: DamRun, place: int, evidence: Evidence | None) -> dict[str, Any]:
    """Return the numbers of the contract that a crack has."""
    raw, line = run.summaries[place], dam.lines[place]
    return {
        "residual_slip_m": raw["slip"],
        "peak_slip_downstream_m": raw["slip_max"],
        "peak_slip_upstream_m": raw["slip_min"],
        "rocking_downstream_rad": abs(raw["rotation_min"]),
        "rocking_upstream_rad": abs(raw["rotation_max"]),
        "opening_upstream_m": raw["opening_heel"],
        "opening_downstream_m": raw["opening_toe"],
        "largest_gap_heel_m": raw["opening_heel"],
        "largest_gap_toe_m": raw["opening_toe"],
        "slip_by_mode_m": {
            "sliding": raw["slip_sliding"],
            "slide_rocking": raw["slip_slide_rocking"],
            "drifting": raw["slip_drifting"],
        },
        "time_by_mode_s": {name.replace("-", "_"): raw[f"time_{name.replace('-', '_')}"] for name in DAM_STATES},
        "elastic_give": {"rotation_rad": line.give[0], "gap_m": line.give[1]},
        "impacts": int(raw["impacts"]),
        "largest_impact_velocity_m_s": raw["largest_impact_velocity"],
        "peak_normal_force_n": raw["peak_normal_force"],
        "final_mode": DAM_STATES[int(raw["final_state"])],
        "final_slip_velocity_m_s": raw["slip_velocity"],
        "crack_width_m": dam.sections[place].crack_width,
        # Where single runs scatter, what is shown first is the mean of several.
        **({} if evidence is None else {name: each.value for name, each in evidence.worth.items()}),
    }


def start_of(dam: FlexibleDam, place: int) -> dict[str, Any]:
    """Return how a crack stands before the earthquake."""
    start = dam.start
    return {"stands": start.stands, "slip_m": start.slips[place], "open_contacts": start.open_contacts[place]}


def summary_of(shaken: ShakenDam, run: DamRun, evidence: Evidence | None) -> dict[str, Any]:
    """Return the numbers of the contract, of the crack asked of and of the dam."""
    raw, dam, case = run.summary, shaken.dam, shaken.case
    coefficients = dam.damping.coefficients
    return {
        **crack_summary(dam, run, dam.asked, evidence),
        "end_time_s": raw["end_time"],
        "periods_s": dam.periods.tolist(),
        "mesh": {
            "elements": [len(body.mesh.elements) for body in dam.bodies],
            "nodes": [len(body.mesh.nodes) for body in dam.bodies],
            "modes": [int(basis.omega_squared.size) for basis in dam.modes],
            "crack_nodes": dam.lines[dam.asked].upper[1],
            "basis_error": dam.basis_error,
        },
        "damping": case.flexible.damping,
        "damping_ratio": case.concrete.damping,
        "damping_ratios": dam.damping.ratios.tolist(),
        "rayleigh_mass_1_s": coefficients[0] if coefficients else None,
        "rayleigh_stiffness_s": coefficients[1] if coefficients else None,
        "before_shaking": start_of(dam, dam.asked) if case.flexible.contact == "coulomb" else None,
        "contact": case.flexible.contact,
        "steps": int(raw["steps"]),
        "time_step_s": raw["end_time"] / raw["steps"],
        "contact_iterations_per_step": raw["iterations"] / raw["steps"],
        "contact_residual": raw["contact_residual"],
        "evidence": None if evidence is None else evidence.to_json(),
        **({"anchors": anchors_of(case, run)} if case.anchors else {}),
        "uplift_during_shaking": case.uplift.during_shaking,
        "drainage_by_motion": None,
    }


def energy_of(run: DamRun) -> Energy:
    """Return the ledger."""
    raw = run.summary
    return Energy(
        input_j=raw["energy_input"],
        friction_j=raw["energy_friction"],
        impact_j=raw["energy_impact"],
        kinetic_j=raw["energy_stored"] + raw["energy_penalty"] - raw["energy_start"],
        residual=raw["energy_residual"],
        damping_j=raw["energy_damping"],
        numerical_j=raw["energy_numerical"],
        gained_j=raw["energy_gained"],
    )


def histories_of(shaking: Shaking, run: DamRun, place: int, law: bool = False) -> dict[str, Floats]:
    """Return the histories of the contract for a crack, frame by frame; with those of its friction `law`."""
    column, time = run.all_frames[place], run.frames["time"]
    result = {"time_s": time, "ground_acceleration_m_s2": np.interp(time, shaking.time, shaking.horizontal)}
    if shaking.up is not None:
        result["vertical_ground_acceleration_m_s2"] = np.interp(time, shaking.time, shaking.up)
    if law:
        result |= {"slip_path_m": column["slip_path"], "friction_strength_n": column["friction_strength"]}
    return result | {
        "slip_m": column["slip"],
        "slip_velocity_m_s": column["slip_velocity"],
        "gap_heel_m": column["opening_heel"],
        "gap_toe_m": column["opening_toe"],
        "rotation_rad": column["rotation"],
        "normal_force_n": column["normal_force"],
        "friction_force_n": column["friction_force"],
        "touching": column["touching"],
        "stored_energy_j": column["energy_stored"],
        "input_energy_j": column["energy_input"],
        "damping_energy_j": column["energy_damping"],
        "friction_energy_j": column["energy_friction"],
        "impact_energy_j": column["energy_impact"],
    }


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
                histories=histories_of(shaken.shaking, run, place, law=shaken.case.cracks[place].crack.law is not None),
                mode=modes_of(run, place),
                crack=history,
            )
        )
    return tuple(told)


def _summary(found: Answer, history: CrackHistory, evidence: Evidence | None) -> dict[str, Any]:
    dam, run, place = found.shaken.dam, found.run, history.place
    raw, alone = run.summaries[place], found.shaken.case.cracks[place]
    worn = worn_of(alone, place, dam, run)
    return {
        **crack_summary(dam, run, place, evidence),
        "friction": sliding_friction(alone, place, dam),
        **({} if worn is None else {"friction_law": law_found(worn, run, place)}),
        "crack_energy": {"friction_j": raw["crack_friction"], "impact_j": raw["crack_impact"]},
        "before_shaking": start_of(dam, place),
        "penetration_m": penetration_of(run, history),
        **({"anchors": anchors_of(alone, run)} if alone.anchors else {}),
        "evidence": None if evidence is None else evidence.to_json(),
    }


def penetration_of(run: DamRun, history: CrackHistory) -> dict[str, float]:
    """Return how deep the faces of a crack are in each other at most [m]."""
    watched = run.summaries[history.place]["penetration"]
    return {"watched": watched, "any_in_frames": history.deepest_penetration()}


def modes_of(run: DamRun, place: int) -> tuple[str, ...]:
    """Return what the part above a crack does, frame by frame."""
    return tuple(DAM_STATES[int(state)] for state in run.all_frames[place]["state"])
