"""Tables of an elastic dam: the kernel's results by the names of the contract."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.kernel.dam import DAM_STATES, DamRun, DamSummary
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import StaticState, build_block, static_state
from heeltoe.models.flexible.body.bond import zone_mesh
from heeltoe.models.flexible.body.reduced import FlexibleDam, along_crack
from heeltoe.models.flexible.evidence.evidence import trusted
from heeltoe.models.flexible.evidence.refinement import Answer
from heeltoe.models.flexible.result.history import CrackHistory, watched_nodes
from heeltoe.models.flexible.result.response import ElasticCrackResponse
from heeltoe.models.flexible.result.water import extremes_of_water, face_pressures
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.flexible.run.slip_history import law_result, sliding_friction, worn_of
from heeltoe.result.contract import ground_histories, headlines, slip_by_mode, time_by_mode
from heeltoe.result.crest import CrestSeries, crest_series
from heeltoe.result.histories import EventLog, Histories, computed_columns
from heeltoe.result.numbers import (
    AnchorForce,
    AssumedRock,
    BeforeShaking,
    BondState,
    CrackEnergy,
    CrossValley,
    ElasticCrack,
    ElasticDam,
    ElasticGive,
    Energy,
    EvidenceNumbers,
    Mesh,
    Penetration,
    SelfExcitation,
    Tension,
)
from heeltoe.result.quantity import computed

# Columns of the histories that cracks with a friction law alone have, those of a ground that shakes across the valley,
# too, and those with a bond.
_OF_LAWS = ("slip_path_m", "friction_strength_n")
_ACROSS = ("slip_cross_m", "friction_cross_n")
_CRACKED = ("cracked_upstream_m", "cracked_downstream_m", "cracked_length_m")
_OF_BONDS = ("softening_length_m", "fracture_energy_j")


def anchors_of(case: Case, run: DamRun, place: int) -> list[AnchorForce]:
    """Return what each anchor bears [N] at a crack, and what it is good for; `case` has it alone."""
    borne = iter(run.anchors[place].tolist())
    return [AnchorForce.of(anchor, next(borne) if anchor.yields else None) for anchor in case.anchors_at_crack]


def histories_of_cracks(case: Case, dam: FlexibleDam, run: DamRun) -> tuple[CrackHistory, ...]:
    """Return the frames of a run, crack by crack from the crest down."""
    time = run.frames.time

    def by_direction(table: Floats) -> Floats:
        return table.reshape(time.size, 2, -1)

    result, watched = [], 0
    for place, line in enumerate(dam.lines):
        count, counted = line.upper[1], line.lower[1]
        contacts = contactors_of([count, counted][: 1 + bool(counted)], case.flexible.contactors)
        result.append(
            CrackHistory(
                time=time,
                upper_position=by_direction(run.upper[place]),
                lower_position=by_direction(run.lower[place]) if counted else None,
                force=by_direction(run.force[place]),
                status=run.status[:, watched : watched + contacts],
                damage=run.damage[:, watched : watched + contacts] if line.bond is not None else None,
                modes=run.modes[: len(dam.modes)],
                dam=dam,
                contactors=case.flexible.contactors,
                place=place,
                water=run.water if dam.reservoir is not None else None,
                pressures=extremes_of_water(dam, run),
            )
        )
        watched += contacts
    return tuple(result)


def contactors_of(nodes: list[int], contactors: int) -> int:
    """Return how many nodes of a crack are watched."""
    return sum(watched.size for _, watched in watched_nodes(nodes, contactors))


def crack_numbers(
    case: Case, dam: FlexibleDam, run: DamRun, history: CrackHistory, evidence: EvidenceNumbers | None
) -> ElasticCrack:
    """Return the numbers of a crack; `case` has it alone."""
    place = history.place
    raw, line = run.summaries[place], dam.lines[place]
    row = raw.by_name()
    worn = worn_of(case, place, dam, run)
    several = len(dam.lines) > 1
    numbers = ElasticCrack(
        **computed(ElasticCrack, run.frames.time, run.all_frames[place].slip),
        **{name: float(column) for name, column in headlines(row).items()},
        largest_gap_heel_m=raw.opening_upstream,
        largest_gap_toe_m=raw.opening_downstream,
        slip_by_mode_m=slip_by_mode(row),
        time_by_mode_s=time_by_mode(row),
        impacts=int(raw.impacts),
        largest_impact_velocity_m_s=raw.largest_impact_velocity,
        final_mode=DAM_STATES[int(raw.final_state)],
        final_slip_velocity_m_s=raw.slip_velocity,
        crack_width_m=dam.sections[place].crack_width,
        friction=sliding_friction(case, place, dam) if several else None,
        crack_energy=CrackEnergy(friction_j=raw.crack_friction, impact_j=raw.crack_impact) if several else None,
        anchors=anchors_of(case, run, place) if case.anchors else None,
        elastic_give=ElasticGive(rotation_rad=line.give[0], gap_m=line.give[1]),
        peak_normal_force_n=raw.peak_normal_force,
        before_shaking=start_of(dam, place) if case.flexible.contact == "coulomb" else None,
        penetration_m=Penetration(watched=raw.penetration, any_in_frames=history.deepest_penetration()),
        evidence=evidence,
        friction_law=None if worn is None else law_result(worn, run, place),
        joint=bond_of(case, dam, run, place),
        cross_valley=_across(raw, evidence) if run.crest_cross.size else None,
    )
    # Where single runs scatter, what is shown first is the mean of several.
    means: dict[str, Any] = {} if evidence is None else trusted(evidence)
    return replace(numbers, **means)


def _across(raw: DamSummary, evidence: EvidenceNumbers | None) -> CrossValley:
    """Return what the part above a crack does across the valley; its slip is the mean where single runs scatter."""
    worth = None if evidence is None else evidence.residual_slip_cross_m
    return CrossValley(
        residual_slip_cross_m=(raw.cross_slip if worth is None else worth.value) + 0.0,
        peak_slip_cross_left_m=raw.cross_slip_max + 0.0,
        peak_slip_cross_right_m=raw.cross_slip_min + 0.0,
        slip_path_m=raw.cross_slip_path,
        side_contacts=int(raw.side_contacts),
        time_at_side_s=raw.time_at_side,
        side_contact_impulse_n_s=raw.side_impulse,
    )


def bond_of(case: Case, dam: FlexibleDam, run: DamRun, place: int) -> BondState | None:
    """Return what has become of the bond of a joint; `case` has it alone."""
    bond, raw = case.crack.bond, run.summaries[place]
    if bond is None:
        return None
    mesh = zone_mesh(bond, case.concrete.modulus or 0.0, along_crack(dam.bodies[place], dam.sections[place]))
    cracks = raw.first_cracking >= 0.0
    # The kernel adds lengths of a face that its loads have strained.
    width = dam.sections[place].crack_width
    return BondState(
        first_cracking_s=raw.first_cracking if cracks else None,
        first_cracking_at_m=raw.first_cracking_place if cracks else None,
        cracked_through_s=raw.cracked_through if raw.cracked_through >= 0.0 else None,
        cracked_upstream_m=min(raw.cracked_from_heel, width),
        cracked_downstream_m=min(raw.cracked_from_toe, width),
        cracked_length_m=min(raw.cracked_length, width),
        softening_length_m=raw.softening_length,
        fracture_energy_j=raw.crack_fracture,
        process_zone_m=mesh.zone,
        element_m=mesh.element,
        tensile_strength_pa=mesh.strength,
    )


def start_of(dam: FlexibleDam, place: int) -> BeforeShaking:
    """Return how a crack stands before the earthquake."""
    start = dam.start
    return BeforeShaking(stands=start.stands, slip_m=start.slips[place], open_contacts=start.open_contacts[place])


def dam_numbers(
    shaken: ShakenDam,
    run: DamRun,
    growth: SelfExcitation | None,
    tension: Tension | None,
    assumed_rock: AssumedRock | None,
) -> ElasticDam:
    """Return the numbers of the dam as a whole."""
    raw, dam, case = run.summary, shaken.dam, shaken.case
    coefficients = dam.damping.coefficients
    return ElasticDam(
        end_time_s=raw.end_time,
        periods_s=dam.periods.tolist(),
        mesh=Mesh(
            elements=[len(body.mesh.elements) for body in dam.bodies],
            nodes=[len(body.mesh.nodes) for body in dam.bodies],
            modes=[int(basis.omega_squared.size) for basis in dam.modes],
            crack_nodes=dam.lines[dam.asked].upper[1],
            basis_error=dam.basis_error,
        ),
        damping=case.flexible.damping,
        damping_ratio=case.concrete.damping,
        damping_ratios=dam.damping.ratios.tolist(),
        rayleigh_mass_1_s=coefficients[0] if coefficients else None,
        rayleigh_stiffness_s=coefficients[1] if coefficients else None,
        contact=case.flexible.contact,
        steps=int(raw.steps),
        time_step_s=raw.end_time / raw.steps,
        contact_iterations_per_step=raw.iterations / raw.steps,
        contact_residual=raw.contact_residual,
        uplift_during_shaking=case.uplift.during_shaking,
        drainage_by_motion=None,
        self_excitation=growth,
        assumed_rock=assumed_rock,
        tension=tension,
        water_pressure=face_pressures(dam, run),
    )


def energy_of(run: DamRun) -> Energy:
    """Return the ledger."""
    raw = run.summary
    return Energy(
        input_j=raw.energy_input,
        friction_j=raw.energy_friction,
        impact_j=raw.energy_impact,
        left_j=raw.energy_stored + raw.energy_penalty - raw.energy_start,
        residual=raw.energy_residual,
        damping_j=raw.energy_damping,
        fracture_j=raw.energy_fracture,
        rock_j=raw.energy_boundary,
        floor_j=raw.energy_floor,
        far_end_j=raw.energy_far_end,
        numerical_j=raw.energy_numerical,
        gained_j=raw.energy_gained,
    )


def histories_of(
    shaking: Shaking, run: DamRun, place: int, *, law: bool = False, bonded_width: float | None = None
) -> dict[str, Floats]:
    """Return the histories of the contract for a crack, frame by frame; with those of its friction `law`, and of a bond
    over its width [m]."""
    columns = computed_columns(Histories, run.all_frames[place])
    # The kernel adds lengths of a face that its loads have strained.
    columns |= {name: np.minimum(columns[name], bonded_width or 0.0) for name in _CRACKED}
    crosses = run.crest_cross.size > 0
    without = (
        *(() if law else _OF_LAWS),
        *(() if crosses else _ACROSS),
        *(() if bonded_width is not None else (*_CRACKED, *_OF_BONDS)),
    )
    kept = {name: column for name, column in columns.items() if name not in without}
    if crosses:
        moments = run.summary.end_time / run.summary.steps * np.arange(run.crest_cross.size)
        kept["crest_cross_m"] = np.interp(run.frames.time, moments, run.crest_cross)
    return ground_histories(shaking, run.frames.time) | kept


def crest_of(shaken: ShakenDam, run: DamRun) -> CrestSeries:
    """Return the way of the upstream edge of the crest, step by step."""
    step = run.summary.end_time / run.summary.steps
    time: Floats = step * np.arange(run.crest.size, dtype=np.float64)
    return crest_series(step, run.crest, _mean_around(time, step, shaken.shaking.time, shaken.shaking.horizontal))


def _mean_around(moments: Floats, step: float, time: Floats, values: Floats) -> Floats:
    """Return the mean of a function that is straight between knots over a step around each of some even moments: where
    a record jumps, its value at a moment is that of either side by the last digit of a time."""
    sums = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(time) * (values[1:] + values[:-1]))])
    ends = np.append(moments - 0.5 * step, moments[-1] + 0.5 * step).clip(time[0], time[-1])
    knot = np.searchsorted(time, ends, side="right").clip(1, time.size - 1) - 1
    length, after = time[knot + 1] - time[knot], ends - time[knot]
    slope = np.divide(values[knot + 1] - values[knot], length, out=np.zeros(ends.size), where=length > 0.0)
    change, span = np.diff(sums[knot] + after * (values[knot] + 0.5 * slope * after)), np.diff(ends)
    # A run may end a step behind its record.
    mean: Floats = np.divide(change, span, out=np.full(span.size, values[-1]), where=span > 0.0)
    return mean


def crack_responses(
    answer: Answer, histories: Sequence[CrackHistory], static: StaticState, crest: CrestSeries
) -> list[ElasticCrackResponse]:
    """Return what each crack did, from the crest down; `static` is the state at the one asked of."""
    shaken, run = answer.shaken, answer.run
    moved = crest.histories(run.frames.time)
    responses = []
    for history, case in zip(histories, shaken.case.single_crack_cases, strict=True):
        place = history.place
        evidence = answer.evidences[place] if answer.evidences else None
        section = shaken.dam.sections[place]
        responses.append(
            ElasticCrackResponse(
                elevation=section.heel[1] - section.base_elevation,
                of_crack=crack_numbers(case, shaken.dam, run, history, evidence),
                histories=Histories(
                    histories_of(
                        shaken.shaking,
                        run,
                        place,
                        law=case.crack.law is not None,
                        bonded_width=None if case.crack.bond is None else section.crack_width,
                    )
                    | moved
                ),
                mode=modes_of(run, place),
                event_log=EventLog({}),
                static=static if place == shaken.dam.asked else static_state(build_block(case)),
                frames=history,
            )
        )
    return responses


def modes_of(run: DamRun, place: int) -> tuple[str, ...]:
    """Return what the part above a crack does, frame by frame."""
    return tuple(DAM_STATES[int(state)] for state in run.all_frames[place].state)
