"""Warnings of a flexible run, with remedies where it stopped."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from heeltoe.case.crack.kinks import climbs
from heeltoe.case.dam import Rock
from heeltoe.case.model import Case
from heeltoe.case.warnings import concrete_warnings
from heeltoe.kernel.dam import DamRun, DamSummary
from heeltoe.mechanics.anchors import anchors_hold
from heeltoe.mechanics.beam import band_of
from heeltoe.mechanics.block import Block, build_block, instability
from heeltoe.mechanics.loads import water_above_crack
from heeltoe.models.flexible.body.bond import zone_mesh
from heeltoe.models.flexible.body.modes import ENOUGH
from heeltoe.models.flexible.body.reduced import FlexibleDam, along_crack
from heeltoe.models.flexible.evidence.evidence import MOVED_BY, may_have_no_limit
from heeltoe.models.flexible.result.history import CrackHistory
from heeltoe.models.flexible.result.tables import anchors_of
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.flexible.surroundings.left_out import left_out
from heeltoe.models.flexible.surroundings.rock import ENOUGH as ENOUGH_OF_ROCK
from heeltoe.models.runner import about_the_anchors, advice_of, largest_rotation, leaves, slides_on
from heeltoe.result.numbers import AnchorForce, EvidenceNumbers, SelfExcitation
from heeltoe.result.outcome import Outcome, decide
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice

#: A mesh that misses corners of the section by more than this part of its height is told.
_MISSED = 1e-3
# Why no state of rest before the earthquake is known, and what to do.
_UNREST = {
    "moves away": (
        "nothing holds a part above a crack of the elastic dam under the static loads alone",
        Outcome.UNSTABLE.remedy,
    ),
    "not found": (
        "the search for a state of rest before the earthquake ended after 3,000 steps without one, which shows neither "
        "that the dam stands nor that it does not",
        "see its static safety, and try another flexible.elements_across, flexible.contactors or a weaker bond",
    ),
    "not sought": ("a part starts off the crack below it", Outcome.UNSTABLE.remedy),
}


def stands(dam: FlexibleDam, block: Block) -> bool:
    """Whether a dam stands before the earthquake by static equilibrium: with the anchor forces before it moves, or with
    those that it reaches as it slides or turns."""
    return (instability(block) is None and dam.start.stands) or _held(block) is not None


def _held(block: Block) -> Block | None:
    """Return the block above a crack that friction, weight and prestress do not hold, where anchors hold all of these;
    None where there is none, or one that nothing holds."""
    if not any(anchor.yields for anchor in block.case.anchors):
        return None
    blocks = [build_block(alone) for alone in block.case.single_crack_cases]
    loose = [alone for alone in blocks if instability(alone) is not None]
    return loose[0] if loose and all(map(anchors_hold, loose)) else None


def _unrest(dam: FlexibleDam) -> tuple[str, str]:
    """Say why no state of rest before the earthquake is known, and what to do."""
    return _UNREST[dam.start.unrest or "not sought"]


def judge_outcome(dam: FlexibleDam, block: Block, run: DamRun, silence: float = 0.0) -> tuple[Outcome, Sentence | None]:
    """Return how a run ended, and what to do about it; none where there is a result to trust.

    A dam that slides, overturns or floats under its static loads is none that an earthquake moves. A part that slides
    farther than its crack is wide has left what it stood on. Rotations that are not small are none of this model.
    `silence` is how long the run goes on after the ground motion [s].
    """
    rotation = max(float(largest_rotation(summary.by_name())) for summary in run.summaries)
    slides = silence > 0.0 and any(slides_on(frames.time, frames.slip, silence) for frames in run.all_frames)
    off = bool(leaves([summary.by_name() for summary in run.summaries], [each.crack_width for each in dam.sections]))
    outcome = decide(run.outcome, rotation=rotation, stands=stands(dam, block), off=off, slows=not slides)
    if outcome.has_result:
        return outcome, None
    raw, why = run.summary, instability(block)
    text, remedy = _unrest(dam) if why is None else ("", outcome.remedy)
    return outcome, advice_of(
        outcome,
        rotation=rotation,
        why=why or Sentence(text),
        unless_it_stands=remedy,
        stopped=Sentence.of("stopped at {time_s:.3f s} with slip {slip_m:.4g m}", time_s=raw.end_time, slip_m=raw.slip),
        silence=silence,
    )


def warnings_of(
    shaken: ShakenDam,
    run: DamRun,
    histories: Sequence[CrackHistory],
    evidences: Sequence[EvidenceNumbers],
    growth: SelfExcitation | None,
    block: Block,
    outcome: Outcome,
    leads: int = 0,
) -> list[Notice]:
    """Return what a reader of a flexible run must know; `block` is the part above the crack asked of, `outcome` that of
    :func:`judge_outcome`, and `leads` the place of the crack that leads."""
    case, dam = shaken.case, shaken.dam
    peak = float(abs(shaken.shaking.horizontal).max())
    return [
        # What does not stand has no result that evidence could be of.
        *(_about_the_evidences(evidences, dam, leads) if outcome is not Outcome.UNSTABLE else ()),
        *_about_the_start(case, dam, block),
        *_about_the_growth(growth, run.summaries[leads]),
        *_about_the_mesh(dam),
        *_about_the_rock(case, dam),
        *(left_out(case, max(abs(row.slip) for row in run.summaries), peak) if outcome == "ok" else ()),
        *_about_the_joints(case, dam),
        *_about_the_concrete(case, dam),
        *about_the_anchors(_most_loaded(case, run)),
        *_about_the_contact(case, run, histories),
    ]


def _most_loaded(case: Case, run: DamRun) -> list[AnchorForce]:
    """Return what each anchor bears at the crack at which it bears most."""
    cracks = (anchors_of(alone, run, place) for place, alone in enumerate(case.single_crack_cases))
    return [max(forces, key=lambda force: force.peak_force_n) for forces in zip(*cracks, strict=True)]


def _about_the_rock(case: Case, dam: FlexibleDam) -> Iterator[Notice]:
    around = case.surroundings
    if around.rigid_since:
        yield Notice("surroundings-not-assumed", "rock", why=Sentence(around.rigid_since))
    if around.mass_since:
        yield Notice(
            "surroundings-not-assumed", "sound", field="reservoir.compressible", why=Sentence(around.mass_since)
        )
    if dam.rock_error > ENOUGH_OF_ROCK:
        yield Notice("rock-coarse", error=dam.rock_error, highest_hz=band_of(case))
    if case.foundation is not None and may_have_no_limit(case, dam):
        yield Notice("rock-undamped", damping=case.foundation.damping, usual=Rock.model_fields["damping"].default)
    if case.foundation is not None and case.foundation.massless:
        yield Notice("rock-keeps-waves", path="rock.massless", value="true", other="false")
    elif case.foundation is not None and not case.foundation.radiation:
        yield Notice("rock-keeps-waves", path="rock.radiation", value="false", other="true")


def _about_the_mesh(dam: FlexibleDam) -> Iterator[Notice]:
    missed = max(body.mesh.missed for body in dam.bodies)
    if missed > _MISSED * dam.section.height:
        yield Notice("outline-simplified", missed_m=missed)


def _about_the_joints(case: Case, dam: FlexibleDam) -> Iterator[Notice]:
    modulus = case.concrete.modulus or 0.0
    meshes = [
        (zone_mesh(alone.crack.bond, modulus, along_crack(dam.bodies[place], dam.sections[place])), alone.crack.bond)
        for place, alone in enumerate(case.single_crack_cases)
        if alone.crack.bond is not None
    ]
    coarse = [(mesh, bond) for mesh, bond in meshes if mesh.is_coarse]
    if coarse:
        # Of many joints the one that is farthest from what it needs.
        mesh, bond = max(coarse, key=lambda pair: pair[0].element / pair[0].zone)
        yield Notice(
            "joint-coarse",
            element_m=mesh.element,
            zone_m=mesh.zone,
            given_pa=bond.tensile_strength,
            taken_pa=mesh.strength,
        )


def _about_the_start(case: Case, dam: FlexibleDam, block: Block) -> Iterator[Notice]:
    safety, held = block.sliding_safety_factor, _held(block)
    if held is not None:
        yield Notice("friction-not-enough", "anchors", field="anchors", why=instability(held))
    elif safety is not None and safety < 1.0:
        steps = climbs(case.crack.kinks) and dam.start.stands
        if steps:
            yield Notice("friction-not-enough", "steps", field="crack.kinks", factor=safety)
        else:
            yield Notice("slides-by-itself", factor=safety)
    elif not dam.start.stands:
        yield Notice("no-rest", why=_unrest(dam)[0])


def _about_the_evidences(evidences: Sequence[EvidenceNumbers], dam: FlexibleDam, leads: int) -> Iterator[Notice]:
    if not evidences:
        yield Notice("evidence-none")
        return
    for place in sorted(range(len(evidences)), key=lambda place: place != leads):
        section, evidence = dam.sections[place], evidences[place]
        elevation = section.heel[1] - section.base_elevation
        slip = evidence.residual_slip_m
        # The crack that leads has its reasons, too.
        if place == leads:
            yield from _about_the_evidence(evidence)
        elif not evidence.converged and not evidence.no_limit:
            yield Notice(
                "not-converged",
                "further-crack",
                elevation_m=elevation,
                slip_m=slip.value,
                uncertainty_m=slip.uncertainty,
            )
        if evidence.scatters:
            yield _scatter(evidence, elevation if len(evidences) > 1 else None)


def _about_the_evidence(evidence: EvidenceNumbers) -> Iterator[Notice]:
    slip, runs = evidence.residual_slip_m, len(evidence.residual_slips_m)
    if evidence.failed:
        yield Notice("evidence-failures", failed=evidence.failed, runs=runs)
    # Of slips without a limit another warning says why they are not converged.
    if not evidence.converged and not evidence.no_limit:
        spent = "the budget ended the refinement"
        yield Notice(
            "not-converged",
            "crack",
            slip_m=slip.value,
            uncertainty_m=slip.uncertainty,
            allowed_m=evidence.allowed_m,
            most=MOVED_BY[evidence.moved_most_by],
            stopped=spent if evidence.budget_spent else "refining would not help, or is not its own",
        )


def _scatter(evidence: EvidenceNumbers, elevation: float | None) -> Notice:
    """Return that the runs scatter; `elevation` is that of one of several cracks [m]."""
    slip = evidence.residual_slip_m
    level: dict[str, Any] = {} if elevation is None else {"elevation_m": elevation}
    return Notice(
        "runs-scatter",
        "one-crack" if level else "crack",
        **level,
        slip_m=slip.value,
        scatter_m=slip.spread or 0.0,
        runs=len(evidence.residual_slips_m),
    )


def _about_the_growth(growth: SelfExcitation | None, raw: DamSummary) -> Iterator[Notice]:
    if growth is not None and growth.twice_damped_slip_m is not None:
        yield Notice(
            "self-excited",
            growth_1_s=growth.growth_1_s,
            sliding_s=growth.sliding_time_s,
            slip_m=raw.slip,
            damped_slip_m=growth.twice_damped_slip_m,
        )


def _about_the_concrete(case: Case, dam: FlexibleDam) -> Iterator[Notice]:
    full = case.reservoir is not None and water_above_crack(case, case.reservoir) > 0.9 * dam.section.height
    if case.concrete.damping < 0.005 and full:
        yield Notice("damping-hardly")
    yield from concrete_warnings(case)
    if dam.basis_error > ENOUGH:
        yield Notice("modes-few", error=dam.basis_error)


def _about_the_contact(case: Case, run: DamRun, histories: Sequence[CrackHistory]) -> Iterator[Notice]:
    raw, sections = run.summary, histories[0].dam.sections
    depth = max(history.deepest_penetration() for history in histories)
    if depth > 1e-3 * min(section.crack_width for section in sections):
        yield Notice("faces-penetrate", depth_m=depth, contactors=case.flexible.contactors)
    if raw.contact_residual > 1e-6:
        yield Notice("contact-loose", residual=raw.contact_residual)
    if raw.energy_residual > 1e-9:
        yield Notice("energy-open", residual=raw.energy_residual)
    if raw.energy_gained > 1e-4 * raw.energy_turnover:
        exact = case.flexible.contact == "coulomb"
        why = ": compare with a shorter flexible.time_step"
        if not exact:
            why = (
                ", as a penalty does at every blow: compare with another time_step and with flexible.contact = "
                '"coulomb"'
            )
        yield Notice("energy-made", gained_j=raw.energy_gained, turnover_j=raw.energy_turnover, why=why)
