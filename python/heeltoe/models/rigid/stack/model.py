"""Two rigid blocks: case -> two blocks -> kernel -> response."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from heeltoe.arrays import Floats
from heeltoe.case.at_crack import anchors_through_several
from heeltoe.case.crack.kinks import straight_crack
from heeltoe.case.model import Case
from heeltoe.errors import InputError, shown
from heeltoe.kernel.shaking import Shaking
from heeltoe.kernel.stack import StackRun, run_stack
from heeltoe.mechanics.block import Block, build_block, instability, static_state
from heeltoe.models.rigid.model import MODE_NAMES, moments_of
from heeltoe.models.rigid.stack.response import AtBlock, StackResponse
from heeltoe.models.rigid.tables import energy_of, events_of, histories_of, references_of, summary_of
from heeltoe.models.rigid.walk import limits_of
from heeltoe.models.rigid.warnings import ADVICE, advice_of, outcome_of, warnings_of
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.contract import LARGEST_ROTATION, TOO_FAR
from heeltoe.units.sentences import Sentence
from heeltoe.warnings import Notice

#: Cracks that make two blocks.
CRACKS = 2


def check_stack(case: Case) -> None:
    """Refuse what of a case two blocks cannot use.

    Raises
    ------
    InputError
        Then.
    """
    if len(case.further_cracks) + 1 > CRACKS:
        raise InputError("two-cracks-most", "further_cracks", f"{len(case.further_cracks)} further cracks")
    straight_crack(case, "a rigid block")
    problems = _unfit(case)
    for first in problems:
        raise first.with_others(problems)


def _unfit(case: Case) -> Iterator[InputError]:
    other = "further_cracks"
    yield from anchors_through_several(case)
    if case.aftershocks:
        yield InputError("one-crack-only", "aftershocks", other=other)
    if case.crack.law is not None:
        yield InputError("one-crack-only", "crack.law", other=other)
    for place, crack in enumerate(case.further_cracks):
        if crack.law is not None:
            yield InputError("law-stack", f"further_cracks[{place}].law", shown(crack.law.name))
    if case.uplift.during_shaking != "constant":
        yield InputError("one-crack-value", "uplift.during_shaking", shown(case.uplift.during_shaking), other=other)
    if case.analysis.rotation != "small":
        yield InputError("one-crack-value", "analysis.rotation", shown(case.analysis.rotation), other=other)
    for name, water in (("reservoir", case.reservoir), ("tailwater", case.tailwater)):
        if water is not None and not water.virtual_mass_rotates:
            yield InputError("one-crack-value", f"{name}.virtual_mass_rotates", "false", other=other)
        if water is not None and water.hydrodynamic != "westergaard":
            yield InputError("one-crack-value", f"{name}.hydrodynamic", shown(water.hydrodynamic), other=other)


def place_of(lower: Block, upper: Block) -> Floats:
    """Return where the upper block's reference point is, seen from that of all above the lower crack, along and across
    the lower crack, and by which angle the upper crack is turned from the lower one."""

    def point(block: Block) -> Floats:
        return np.add(block.section.heel, block.section.from_crack_frame(block.heel_distance, block.height))

    x, z = point(upper) - point(lower)
    along, across = lower.section.in_crack_frame(x, z)
    return np.array([along, across, upper.section.inclination - lower.section.inclination])


def run_two_blocks(case: Case, earthquake: Earthquake, output_step: float | None = None) -> StackResponse:
    """Run a dam that is cracked at two levels, exactly between events.

    Parameters
    ----------
    case
        Dam, both cracks and water.
    earthquake
        What shakes the lower crack.
    output_step
        Spacing of the histories [s]; at the record's samples where it is not given.

    Raises
    ------
    InputError
        Where something in the case does not go with two blocks, or the spacing cannot be used.
    """
    check_stack(case)
    asked = case.asked
    moments = moments_of(earthquake, output_step)
    blocks, run = walk_two_blocks(case, earthquake.shaking, moments)
    moments = moments[: run.cracks[0].mode.size]
    outcome = outcome_of_two(case, run)
    started = outcome != "unstable"
    told = [_at_block(block, earthquake, moments, run, place) for place, block in enumerate(blocks)] if started else []
    first, alone = blocks[asked], run.cracks[1 - asked]
    return StackResponse(
        model="rigid",
        title=case.title,
        outcome=outcome,
        advice=_advice(blocks, run, outcome, asked),
        warnings=_warnings(blocks, run),
        summary=_summary(told, asked) if started else {},
        energy=energy_of(alone) if started else None,
        motion=earthquake.motion,
        vertical=earthquake.vertical,
        gravity=case.gravity,
        histories=told[asked].histories if started else {},
        mode=told[asked].mode if started else (),
        event_log=told[asked].event_log if started else events_of(alone),
        static=static_state(first),
        references=references_of(case, first, alone),
        silence_s=earthquake.silence,
        at_cracks=tuple(told),
        asked=asked,
    )


def walk_two_blocks(case: Case, shaking: Shaking, moments: Floats | None = None) -> tuple[list[Block], StackRun]:
    """Return the block above each crack, from the crest down, and what the kernel makes of them, which counts from the
    ground up. `moments` are those of the histories [s]; none without them."""
    blocks = [build_block(each) for each in case.cracks]
    upper, lower = blocks
    numbers, wanted = (lower.parameters(), upper.parameters()), np.empty(0) if moments is None else moments
    return blocks, run_stack(numbers, place_of(lower, upper), shaking, wanted, limits_of(case))


def _at_block(block: Block, earthquake: Earthquake, moments: Floats, run: StackRun, place: int) -> AtBlock:
    """Return what the crack did that is so many below the uppermost."""
    case, section, own = block.case, block.section, run.cracks[1 - place]
    friction, impact = run.lost[1 - place].tolist()
    summary = summary_of(case, block, own) | {
        "friction": case.crack.mu_kinetic,
        "crack_energy": {"friction_j": friction, "impact_j": impact},
    }
    return AtBlock(
        elevation=section.heel[1] - section.base_elevation,
        summary=summary,
        histories=histories_of(case, block, earthquake.shaking, moments, own),
        mode=tuple(MODE_NAMES.take(own.mode).tolist()),
        event_log=events_of(own),
        static=static_state(block),
    )


def _summary(told: list[AtBlock], asked: int) -> dict[str, Any]:
    """Return the numbers of the contract: those of the crack asked of, and of each."""
    slips = [abs(each.summary["residual_slip_m"]) for each in told]
    own = {key: value for key, value in told[asked].summary.items() if key not in ("friction", "crack_energy")}
    of_crack = [{"elevation_m": each.elevation, **each.summary} for each in told]
    return own | {"governing_crack": slips.index(max(slips)), "cracks": of_crack}


def outcome_of_two(case: Case, run: StackRun) -> str:
    """Return how a run of two blocks ended: neither may turn far from the ground."""
    found = outcome_of(case, run.cracks[0])
    turned = float(np.abs(run.tilts).max())
    return TOO_FAR if found == "ok" and turned > LARGEST_ROTATION else found


def _advice(blocks: list[Block], run: StackRun, outcome: str, asked: int) -> Sentence | None:
    """Say where a run stopped, at which of the blocks, and what to do; None where there is a result to trust."""
    if outcome == "ok":
        return None
    if outcome == "unstable":
        place = next((place for place, block in enumerate(blocks) if instability(block) is not None), asked)
    elif outcome == TOO_FAR:
        place = 1 - int(np.abs(run.tilts).max(axis=1).argmax())
        turned = float(np.abs(run.tilts[1 - place]).max())
        return Sentence.of(
            "the block above the crack at {at_m:g m} rotates by {rotation_rad:.3g rad}: beyond {least_rad:g rad} that "
            "is not small, and it may overturn, which two blocks with small rotations know nothing of; look at that "
            'block alone, without [[further_cracks]] and with analysis.rotation = "finite"',
            at_m=_elevation(blocks[place]),
            rotation_rad=turned,
            least_rad=LARGEST_ROTATION,
        )
    else:
        place = asked
    said = advice_of(blocks[place], run.cracks[1 - place], outcome)
    if said is None or outcome not in ADVICE:
        return said
    return Sentence.of("at the crack at {at_m:g m}: {said}", at_m=_elevation(blocks[place]), said=said)


def _elevation(block: Block) -> float:
    section = block.section
    return float(section.heel[1] - section.base_elevation)


def _warnings(blocks: list[Block], run: StackRun) -> tuple[Notice, ...]:
    """Return what a reader must know, of either crack, each thing once."""
    said: list[Notice] = []
    for place, block in enumerate(blocks):
        said += [each for each in warnings_of(block.case, block, run.cracks[1 - place]) if each not in said]
    return tuple(said)
