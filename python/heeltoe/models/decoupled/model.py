"""The decoupled chain: ground -> elastic part below the crack -> rigid part above it -> response."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.blas import one_blas_thread
from heeltoe.case.model import Case
from heeltoe.case.warnings import concrete_warnings
from heeltoe.mechanics.block import Block, build_block
from heeltoe.mechanics.references import cited
from heeltoe.models.cost import Cost
from heeltoe.models.decoupled.chain import Chain as Part
from heeltoe.models.decoupled.chain import bonded_chain, chain
from heeltoe.models.decoupled.crack_motion import FIRST_STEP, CrackMotion, crack_motion, crack_motion_at, relative
from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.models.flexible.body.cost import check_cost
from heeltoe.models.rigid.model import run_rigid
from heeltoe.models.rigid.walk import walk
from heeltoe.models.runner import block_until_rest, with_outcome
from heeltoe.motion.earthquake import Earthquake
from heeltoe.motion.spectrum import response_spectrum
from heeltoe.result.contract import JOINT_METER_M, ground_histories
from heeltoe.result.histories import AT_CRACK, AT_CRACK_UP, GROUND_UP
from heeltoe.result.numbers import BondedMotion, Chain, CrackLevel, CrackMotionConvergence, CrackSpectrum
from heeltoe.result.response import Response
from heeltoe.warnings.notice import Notice

#: Damping ratio of the response spectra.
SPECTRUM_DAMPING = 0.05
# Periods of the spectra [s]; those of the dam come between them.
_PERIODS = np.geomspace(0.02, 4.0, 160)
_SHOWN = 5
# Longest spacing of the histories [s], where it is not given: the dam vibrates faster than records are sampled.
_OUTPUT_STEP = 0.005
# From which difference on a step of the crack's motion twice as long matters.
_CHANGE = 0.02
# Of the motion at the crack, for each first step of it.
_BYTES = 400.0


@dataclass(frozen=True, eq=False)
class _Run:
    """The motion of the block under that of the crack, before the latter is judged."""

    earthquake: Earthquake
    at_crack: CrackMotion
    straightness: float
    response: Response


def run_decoupled(case: Case, earthquake: Earthquake, output_step: float | None = None) -> DecoupledResponse:
    """Run the decoupled chain on a case with a crack at a height, on through silence until the dam is at rest.

    The part below the crack is elastic and carries the part above as a rigid body; the acceleration of the crack then
    drives the rigid model of the part above.

    Parameters
    ----------
    case
        Dam, crack and water; `decoupled` says what of the crack's motion the block feels. The vertical motion of the
        crack counts also where there is a vertical ground motion.
    earthquake
        What shakes the ground.
    output_step
        Spacing of the histories [s]; an even part of the record's step, up to 5 ms, where it is not given.

    Raises
    ------
    InputError
        Where the crack is at the base, or the case has no modulus.
    """

    part, block = chain(case), build_block(case)
    last = _run_until_rest(case, part, block, earthquake, output_step)
    response, earthquake, at_crack = last.response, last.earthquake, last.at_crack
    if not response.started:
        return of_the_chain(response, earthquake)
    rough = crack_motion_at(part, earthquake, 2.0 * at_crack.step)
    coarser = walk(case, block, rough.felt(case, earthquake).shaking)
    convergence = CrackMotionConvergence(
        step_s=at_crack.step,
        straightness=last.straightness,
        half_the_modes=_of_half_the_modes(part, at_crack, earthquake),
        coarser_step_s=rough.step,
        coarser_residual_slip_m=coarser.summary.slip,
        change=_change(response.residual_slip_m, coarser.summary.slip),
    )
    level = _crack_level(case, part, at_crack, earthquake, convergence)
    return of_the_chain(
        response.with_crack(histories=_histories(response, at_crack, earthquake)),
        earthquake,
        dam=Chain(crack_level=level),
        warnings=(*response.warnings, *concrete_warnings(case), *_warnings(level)),
        references=(*response.references, *cited("decoupled", "piecewise exact")),
    )


def block_of_chain(case: Case, earthquake: Earthquake, output_step: float | None = None) -> Response:
    """Return what the block of the chain does, without what :func:`run_decoupled` says of the motion of the crack."""
    return _run_until_rest(case, chain(case), build_block(case), earthquake, output_step).response


def _run_until_rest(case: Case, part: Part, block: Block, earthquake: Earthquake, output_step: float | None) -> _Run:
    def run(through: Earthquake) -> _Run:
        check_cost(case, Cost(0.0, _BYTES * through.end / FIRST_STEP), "motion.duration")
        at_crack, straightness = crack_motion(part, through)
        step = step_of(through) if output_step is None else output_step
        return _Run(
            through, at_crack, straightness, run_rigid(case, at_crack.felt(case, through), step, block, crest=False)
        )

    last, outcome = block_until_rest(
        run, lambda ran: of_the_chain(ran.response, ran.earthquake), earthquake, case.analysis.silence, swings=True
    )
    response = replace(last.response, silence_s=last.earthquake.silence)
    return replace(last, response=with_outcome(response, outcome))


def step_of(earthquake: Earthquake) -> float:
    """Return the spacing of the histories, where none is given [s]."""
    motion = earthquake.motion
    spacing = motion.dt if motion.is_uniform else _OUTPUT_STEP
    return min(earthquake.run_end, spacing / math.ceil(spacing / _OUTPUT_STEP * (1.0 - 1e-9)))


def of_the_chain(block: Response, earthquake: Earthquake, **changes: Any) -> DecoupledResponse:
    """Return the result of the block as that of the chain."""
    values = {column.name: getattr(block, column.name) for column in fields(block)}
    values |= {"model": "decoupled", "motion": earthquake.motion, "vertical": earthquake.vertical}
    values |= {"silence_s": earthquake.silence}
    return DecoupledResponse(**(values | changes))


@one_blas_thread()
def crack_earthquake(case: Case, earthquake: Earthquake) -> Earthquake:
    """Return what shakes the block where `earthquake` shakes the ground."""
    at_crack, _ = crack_motion(chain(case), earthquake)
    return at_crack.felt(case, earthquake)


def _crack_level(
    case: Case, part: Part, at_crack: CrackMotion, earthquake: Earthquake, convergence: CrackMotionConvergence
) -> CrackLevel:
    g, motion = case.gravity, earthquake.motion
    own = part.periods[:_SHOWN]
    bonded = bonded_chain(case)
    marked = np.concatenate([own, bonded.periods[:_SHOWN]])
    periods = np.unique(np.concatenate([_PERIODS, marked[marked >= _PERIODS[0]]]))
    blocks = at_crack.felt(case, earthquake)
    felt = ["horizontal"]
    felt += ["vertical"] if blocks.vertical is not None else []
    felt += ["rotation"] if blocks.rotation is not None else []
    spectra = {
        f"{name}_g": (response_spectrum(accelerogram, periods, SPECTRUM_DAMPING).pseudo_acceleration / g).tolist()
        for name, accelerogram in (("ground", motion), ("crack", at_crack.horizontal))
    }
    beside = crack_motion_at(bonded, earthquake, at_crack.step)
    return CrackLevel(
        peak_horizontal_g=at_crack.horizontal.pga / g,
        peak_vertical_g=at_crack.vertical.pga / g,
        peak_rotation_rad_s2=at_crack.rotation.pga,
        ground_peak_g=motion.pga / g,
        amplification=at_crack.horizontal.pga / motion.pga if motion.pga else None,
        felt=felt,
        upper_part=case.decoupled.upper_part,
        periods_s=own.tolist(),
        damping_ratio=part.damping,
        modes=int(part.omega.size),
        spectrum=CrackSpectrum(
            damping_ratio=SPECTRUM_DAMPING,
            periods_s=periods.tolist(),
            **spectra,
            transfer=part.transfer(periods).tolist(),
            bonded_transfer=bonded.transfer(periods).tolist(),
        ),
        bonded=BondedMotion(
            periods_s=bonded.periods[:_SHOWN].tolist(),
            peak_horizontal_g=beside.horizontal.pga / g,
            amplification=beside.horizontal.pga / motion.pga if motion.pga else None,
        ),
        convergence=convergence,
    )


def _of_half_the_modes(part: Part, felt: CrackMotion, earthquake: Earthquake) -> float:
    """Return what the slower half of the modes misses of the horizontal motion, over its peak."""
    less = crack_motion_at(part.slower_half(), earthquake, felt.asked).horizontal.acceleration
    exact = felt.horizontal.acceleration
    return relative(less, exact, exact[None])


def _change(slip: float, coarser: float) -> float:
    """Return by how much a step of the crack's motion twice as long changes the slip, as a share."""
    return abs(slip - coarser) / max(abs(slip), JOINT_METER_M / _CHANGE)


def _histories(block: Response, felt: CrackMotion, earthquake: Earthquake) -> dict[str, Floats]:
    """Put the ground's own motion where the block has that of the crack, and the crack's beside it."""
    histories = dict(block.histories)
    moments = histories["time_s"]
    result = ground_histories(earthquake.shaking, moments)
    histories.pop(GROUND_UP, None)
    for name, accelerogram in (
        (AT_CRACK, felt.horizontal),
        (AT_CRACK_UP, felt.vertical),
        ("crack_rotation_acceleration_rad_s2", felt.rotation),
    ):
        result[name] = np.interp(moments, accelerogram.time, accelerogram.acceleration)
    return result | {name: values for name, values in histories.items() if name not in result}


def _warnings(level: CrackLevel) -> tuple[Notice, ...]:
    convergence = level.convergence
    if not convergence.change > _CHANGE:
        return ()
    return (
        Notice(
            "slip-sensitive",
            "sampling",
            coarser_slip_m=convergence.coarser_residual_slip_m,
            coarser_step_s=convergence.coarser_step_s,
            step_s=convergence.step_s,
        ),
    )
