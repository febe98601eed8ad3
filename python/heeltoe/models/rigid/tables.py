"""Results of the rigid kernels, by the names of the contract."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from heeltoe.base.arrays import Bools, Floats
from heeltoe.case.model import Case
from heeltoe.kernel.block import EVENT_KINDS, MODES, SUMMARY, BlockRun
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import Block, static_state
from heeltoe.mechanics.references import cited
from heeltoe.models.rigid.bond import BondedBlock, bonded_block, held_histories
from heeltoe.models.rigid.slip_history import law_histories, law_result, roughness_histories, roughness_result
from heeltoe.result.contract import (
    HEADLINES,
    OPENINGS,
    ROTATIONS,
    ground_histories,
    headlines,
    slip_by_mode,
    time_by_mode,
)
from heeltoe.result.crest import LOOKS_S, CrestMotion, CrestSeries, crest_series, even_moments
from heeltoe.result.histories import ROTATION, EventLog, Histories, computed_columns
from heeltoe.result.numbers import AnchorForce, BlockNumbers, CrossValley, Energy
from heeltoe.result.outcome import Outcome
from heeltoe.result.quantity import computed
from heeltoe.result.record import CrackResponse

#: Modes of motion by their numbers.
MODE_NAMES = np.array(MODES, dtype=object)
#: What :func:`heeltoe.result.contract.headlines` reads of a kernel's table.
_COLUMNS = tuple({headline.column for headline in HEADLINES} & set(SUMMARY))


def opening(case: Case, width: Floats, rotation: Floats) -> Floats:
    """Return how far rotations [rad] about one corner open cracks of these widths at the other [m]."""
    if case.analysis.rotation == "finite":
        return np.asarray(width * np.sin(np.minimum(rotation, math.pi / 2.0)), dtype=np.float64)
    return width * rotation


def with_openings(columns: dict[str, Floats], case: Case, width: Floats) -> dict[str, Floats]:
    """Return the headline numbers of blocks, (n,) by name, with the openings that their rotations make."""
    # Rocking downstream, about the toe, opens the crack at the upstream face.
    pairs = zip(OPENINGS, ROTATIONS, strict=True)
    return columns | {item.key: opening(case, width, columns[rotation]) for item, rotation in pairs}


def anchors_of(case: Case, run: BlockRun) -> list[AnchorForce]:
    """Return what each anchor bears [N/m], and what it is good for: its prestress where nothing varies."""
    anchors = case.anchors_at_crack
    borne = [None] * len(anchors) if run.anchors is None else run.anchors.tolist()
    return [AnchorForce.of(anchor, forces) for anchor, forces in zip(anchors, borne, strict=True)]


def references_of(case: Case, block: Block, run: BlockRun) -> tuple[str, ...]:
    """Return the sources of the methods used."""
    keys = ["rigid", "rocking"] + (["water"] if block.water.mass else [])
    if block.water.sloped:
        keys.append("sloped water")
    if case.analysis.rotation != "small":
        keys.append("overturning")
    if case.uplift.during_shaking != "constant":
        keys.append(case.uplift.during_shaking)
    if not run.exact:
        keys.append("integration")
    if run.crossing is not None:
        keys.append("two components")
    if case.crack.law is not None:
        keys.append(f"law: {case.crack.law.name}")
    if case.crack.roughness is not None:
        keys.append("rough crack")
    if case.crack.roughness is not None and case.crack.roughness.wear:
        keys.append("wear")
    return cited(*keys)


def numbers_of(
    case: Case,
    block: Block,
    run: BlockRun,
    histories: Histories,
    drainage: Sequence[float] = (),
    bonded: BondedBlock | None = None,
) -> BlockNumbers:
    """Return the numbers of a crack below a block, with its histories; `drainage` is what each motion of a sequence met
    of its drainage, `bonded` how its bond has fared."""
    raw, row = run.summary, run.summary.by_name()
    table = {name: np.array([row[name]]) for name in _COLUMNS}
    first: dict[str, Any] = {
        name: float(value[0]) for name, value in with_openings(headlines(table), case, np.array([block.width])).items()
    }
    about = "toe" if first[ROTATIONS[0]] > first[ROTATIONS[1]] else "heel"
    return BlockNumbers(
        **first,
        **computed(BlockNumbers, histories.time_s, histories.slip_m),
        largest_gap_heel_m=raw.largest_gap_heel,
        largest_gap_toe_m=raw.largest_gap_toe,
        slip_by_mode_m=slip_by_mode(row),
        time_by_mode_s=time_by_mode(row),
        impacts=int(raw.impacts),
        largest_impact_velocity_m_s=raw.largest_impact_velocity,
        # As many as the log has: the one at which the limit stops a run is not made any more.
        events=int(run.events.time.size),
        final_mode=run.final_mode,
        final_slip_velocity_m_s=raw.slip_velocity,
        end_time_s=raw.end_time,
        crack_width_m=block.width,
        rotation=case.analysis.rotation,
        uplift_during_shaking=case.uplift.during_shaking,
        drainage_by_motion=list(drainage) or None,
        friction_law=None if case.crack.law is None else law_result(case, block, run),
        roughness=roughness_result(case.crack, run),
        bond=None if bonded is None else bonded.numbers,
        overturned_about=about if run.outcome == Outcome.OVERTURNED else None,
        anchors=anchors_of(case, run),
        cross_valley=_across(run),
    )


def _across(run: BlockRun) -> CrossValley | None:
    """Return what a block did across the valley; None where the ground does not shake that way."""
    if run.crossing is None:
        return None
    row = run.crossing.summary
    return CrossValley(
        residual_slip_cross_m=row.slip + 0.0,
        peak_slip_cross_left_m=row.slip_max + 0.0,
        peak_slip_cross_right_m=row.slip_min + 0.0,
        slip_path_m=row.path,
        side_contacts=int(row.side_strikes),
        time_at_side_s=row.time_at_side,
        side_contact_impulse_n_s=row.side_impulse,
    )


def crack_response(
    case: Case,
    block: Block,
    shaking: Shaking,
    moments: Floats,
    run: BlockRun,
    *,
    started: bool = True,
    drainage: Sequence[float] = (),
) -> CrackResponse:
    """Return the results of the crack below a block; a run that never started has events and static state alone. The
    `moments` are those of the histories that the run has reached. `drainage` is the share that each motion of a
    sequence meets."""
    bonded = bonded_block(block, shaking)
    histories = Histories(histories_of(case, block, shaking, moments, run, bonded) if started else {})
    return CrackResponse(
        elevation=block.section.heel[1] - block.section.base_elevation,
        of_crack=numbers_of(case, block, run, histories, drainage, bonded) if started else None,
        histories=histories,
        mode=tuple(MODE_NAMES.take(run.mode).tolist()) if started else (),
        event_log=EventLog(events_of(run)),
        static=static_state(block),
    )


def with_crest(
    cracks: Sequence[CrackResponse],
    blocks: Sequence[Block],
    runs: Sequence[BlockRun],
    shaking: Shaking,
    moments: Floats,
    shown: Bools,
) -> tuple[list[CrackResponse], CrestMotion | None]:
    """Return the results of cracks with the motion of the crest, which goes with the blocks, one on the other, and its
    largest numbers. The `moments` of the runs that are `shown` are moments of the histories, and those of
    :func:`crest_moments` are among them."""
    if not all(crack.histories for crack in cracks):
        return list(cracks), None
    place = np.sum([_crest_place(block, run) for block, run in zip(blocks, runs, strict=True)], axis=0)
    looks = crest_looks(float(moments[-1]))
    series = _series(place[np.searchsorted(moments, looks)], shaking)
    displacement = place[shown] - place[0]
    seen = series.histories(moments[shown], displacement)
    # The block stays where it is beyond its last look.
    crest = series.motion(blocks[0].gravity, float(displacement[-1]))
    return [replace(crack, histories=Histories(dict(crack.histories.items()) | seen)) for crack in cracks], crest


def crest_looks(end: float) -> Floats:
    """Return the moments up to an end [s] at which the crest of a block is looked at."""
    return LOOKS_S * np.arange(int(np.floor(end / LOOKS_S * (1.0 + 1e-12))) + 1, dtype=np.float64)


def _series(place: Floats, shaking: Shaking) -> CrestSeries:
    ground = np.interp(even_moments(LOOKS_S, place.size), shaking.time, shaking.horizontal)
    return crest_series(LOOKS_S, place, ground)


def _crest_place(block: Block, run: BlockRun) -> Floats:
    """Return how far one crack moves the upstream edge of the crest downstream [m]: a turn counter-clockwise, about the
    heel, moves it upstream."""
    slip, heel, toe = run.places.T
    by_slip, by_heel, by_toe = crest_moves(block.case)
    place = by_slip * slip + by_heel * heel + by_toe * toe
    if block.case.analysis.rotation == "finite":
        ahead, above = _to_crest(block.case)
        small = (toe - heel) / block.section.crack_width
        turn = np.arcsin(np.clip(small, -1.0, 1.0))
        place += (np.cos(turn) - 1.0) * ahead - (np.sin(turn) - small) * above
    return np.asarray(place)


def _to_crest(case: Case) -> tuple[float, float]:
    """Return how far the upstream edge of the crest is downstream of the heel, and above it [m]; (n,) of columns."""
    corners, (x, z) = np.array(case.outline.exterior.coords), case.cut.heel
    top = corners[:, 1].max()
    return corners[corners[:, 1] == top, 0].min() - x, top - z


def crest_moves(case: Case) -> Floats:
    """Return how far slip, heel gap and toe gap move the upstream edge of the crest downstream while rotations are
    small, (3,), or (3, n) of a case of columns."""
    section = case.cut
    turn = _to_crest(case)[1] / section.crack_width
    moves = (np.cos(section.inclination), turn - np.sin(section.inclination), -turn)
    return np.array(np.broadcast_arrays(*moves), dtype=np.float64)


def crest_of_run(block: Block, shaking: Shaking, run: BlockRun) -> tuple[float, float]:
    """Return how far the crest moves [m], and its largest acceleration [m/s2], in a run seen at :func:`crest_looks`."""
    crest = _series(_crest_place(block, run), shaking).motion(1.0)
    return crest.displacement_m, crest.acceleration_g


def energy_of(run: BlockRun) -> Energy:
    """Return the ledger."""
    raw = run.summary
    return Energy(
        input_j=raw.energy_input,
        friction_j=raw.energy_friction,
        impact_j=raw.energy_impact,
        left_j=raw.energy_kinetic,
        residual=raw.energy_residual,
    )


def histories_of(
    case: Case, block: Block, shaking: Shaking, moments: Floats, run: BlockRun, bonded: BondedBlock | None = None
) -> dict[str, Floats]:
    """Return the histories of the contract at the moments that the run has reached."""
    column, result = run.histories, ground_histories(shaking, moments)
    if shaking.turning is not None:
        result["ground_rotation_rad_s2"] = np.interp(moments, shaking.time, shaking.turning)
    rotation = (column.gap_toe - column.gap_heel) / block.width
    rate = (column.gap_velocity_toe - column.gap_velocity_heel) / block.width
    if case.analysis.rotation == "finite":
        # The gaps go with its sine.
        rotation = np.arcsin(np.clip(rotation, -1.0, 1.0))
        rate = rate / np.maximum(np.cos(rotation), 1e-9)
    result |= computed_columns(Histories, column) | {ROTATION: rotation, "rotation_velocity_rad_s": rate}
    if run.crossing is not None:
        slip, velocity, friction = run.crossing.kept.T
        result |= {"slip_cross_m": slip, "slip_cross_velocity_m_s": velocity, "friction_cross_n": friction}
    if bonded is not None:
        held, forces = held_histories(block, shaking, moments, bonded.until)
        result |= {name: np.where(held, force, result[name]) for name, force in forces.items()}
    if case.crack.law is not None and run.worn is not None:
        result |= law_histories(case, block, run)
    return result | roughness_histories(run)


def events_of(run: BlockRun) -> dict[str, object]:
    """Return the events of the contract."""
    column = run.events

    def named(places: Floats, names: tuple[str, ...]) -> list[str]:
        return [names[k] for k in places.astype(np.intp).tolist()]

    names = {
        "kind": named(column.kind, EVENT_KINDS),
        "mode_before": named(column.mode_before, MODES),
        "mode_after": named(column.mode_after, MODES),
    }
    return computed_columns(EventLog, column) | names
