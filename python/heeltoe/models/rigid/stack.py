"""Two rigid blocks: case -> two blocks -> kernel -> response."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from heeltoe.base.arrays import Bools, Floats, among
from heeltoe.case.combinations import check
from heeltoe.case.model import Case
from heeltoe.kernel.block import StackRun, run_stack
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import Block, build_block, instability
from heeltoe.models.rigid.model import moments_of, with_looks
from heeltoe.models.rigid.tables import crack_response, energy_of, references_of, with_crest
from heeltoe.models.rigid.walk import limits_of
from heeltoe.models.rigid.warnings import advice_of_block, warnings_of
from heeltoe.models.runner import largest_rotation, leaves
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.judge import leading_crack
from heeltoe.result.numbers import CrackEnergy
from heeltoe.result.outcome import Outcome, decide
from heeltoe.result.record import CrackResponse
from heeltoe.result.response import Response
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice


def place_of(lower: Block, upper: Block) -> Floats:
    """Return where the upper block's reference point is, seen from that of all above the lower crack, along and across
    the lower crack, and by which angle the upper crack is turned from the lower one."""

    def point(block: Block) -> Floats:
        return np.add(block.section.heel, block.section.from_crack_frame(block.heel_distance, block.height))

    x, z = point(upper) - point(lower)
    along, across = lower.section.in_crack_frame(x, z)
    return np.array([along, across, upper.section.inclination - lower.section.inclination])


def run_two_blocks(
    case: Case, earthquake: Earthquake, output_step: float | None = None, *, crest: bool = True
) -> Response:
    """Run a dam that is cracked at two levels, exactly between events.

    Parameters
    ----------
    case
        Dam, both cracks and water.
    earthquake
        What shakes the lower crack.
    output_step
        Spacing of the histories [s]; where it is not given at the record's samples, and between those that are more
        than 0.02 s apart.
    crest
        Whether the motion of the crest is wanted.

    Raises
    ------
    InputError
        Where something in the case does not go with two blocks, or the spacing cannot be used.
    """
    check(case, "rigid")
    asked = case.asked
    seen = moments_of(earthquake, output_step)
    moments = with_looks(seen, earthquake.shaking.time[-1]) if crest else seen
    shown = among(moments, seen)
    blocks, run = walk_two_blocks(case, earthquake.shaking, moments, shown)
    reached = len(run.cracks[0].places)
    moments, shown = moments[:reached], shown[:reached]
    # Neither may turn far from the ground.
    turned = max(float(largest_rotation(run.cracks[0].summary.by_name())), float(np.abs(run.tilts).max()))
    off = bool(leaves([crack.summary.by_name() for crack in run.cracks[::-1]], [block.width for block in blocks]))
    outcome = decide(run.cracks[0].outcome, rotation=turned, off=off)
    started = outcome is not Outcome.UNSTABLE
    first, alone = blocks[asked], run.cracks[1 - asked]
    cracks = [
        _with_losses(
            crack_response(
                block.case, block, earthquake.shaking, moments[shown], run.cracks[1 - place], started=started
            ),
            block.case.crack.mu_kinetic,
            run.lost[1 - place].tolist(),
        )
        for place, block in enumerate(blocks)
    ]
    top = None
    if crest:
        cracks, top = with_crest(cracks, blocks, run.cracks[::-1], earthquake.shaking, moments, shown)
    leads = leading_crack([run.cracks[1 - place].summary.slip for place in range(len(blocks))])
    return Response(
        model="rigid",
        title=case.title,
        outcome=outcome,
        advice=_advice(blocks, run, outcome, asked, turned),
        warnings=_warnings(blocks, run),
        energy=energy_of(alone) if started else None,
        motion=earthquake.motion,
        vertical=earthquake.vertical,
        gravity=case.gravity,
        cracks=tuple(cracks),
        crest=top,
        asked=leads,
        references=references_of(case, first, alone),
        silence_s=earthquake.silence,
    )


def walk_two_blocks(
    case: Case, shaking: Shaking, moments: Floats | None = None, whole: Bools | None = None
) -> tuple[list[Block], StackRun]:
    """Return the block above each crack, from the crest down, and what the kernel makes of them, which counts from the
    ground up. `moments` are those of the histories [s], or those of them that are `whole`; none without them."""
    blocks = [build_block(alone) for alone in case.single_crack_cases]
    upper, lower = blocks
    numbers, wanted = (lower.parameters(), upper.parameters()), np.empty(0) if moments is None else moments
    return blocks, run_stack(numbers, place_of(lower, upper), shaking, wanted, limits_of(case), whole=whole)


def _with_losses(crack: CrackResponse, friction: float, lost: Sequence[float]) -> CrackResponse:
    """Return what one of two cracks did with its friction and what it has taken of the energy of both."""
    if crack.of_crack is None:
        return crack
    energy = CrackEnergy(friction_j=lost[0], impact_j=lost[1])
    return replace(crack, of_crack=replace(crack.of_crack, friction=friction, crack_energy=energy))


def _advice(blocks: list[Block], run: StackRun, outcome: Outcome, asked: int, rotation: float) -> Sentence | None:
    """Say where a run stopped, at which of the blocks, and what to do; None where there is a result to trust."""
    place = asked
    if outcome is Outcome.UNSTABLE:
        place = next((place for place, block in enumerate(blocks) if instability(block) is not None), asked)
    elif outcome is Outcome.LARGE_ROTATION:
        place = 1 - int(np.abs(run.tilts).max(axis=1).argmax())
    advice = advice_of_block(blocks[place], run.cracks[1 - place], outcome, rotation)
    if advice is None:
        return None
    return Sentence.of("at the crack at {at_m:g m}: {advice}", at_m=_elevation(blocks[place]), advice=advice)


def _elevation(block: Block) -> float:
    section = block.section
    return float(section.heel[1] - section.base_elevation)


def _warnings(blocks: list[Block], run: StackRun) -> tuple[Notice, ...]:
    """Return what a reader must know, of either crack, each thing once."""
    notices: list[Notice] = []
    for place, block in enumerate(blocks):
        notices += [notice for notice in warnings_of(block.case, block, run.cracks[1 - place]) if notice not in notices]
    return tuple(notices)
