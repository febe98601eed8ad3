"""Rotations of any size: a block that rocks freely, and blocks that a pulse overturns."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.case.model import Case
from heeltoe.kernel.block import BlockRun, run_block
from heeltoe.kernel.shaking import Shaking
from heeltoe.mechanics.block import Block, build_block
from heeltoe.models.rigid.varying import varying
from validation.row import Row
from validation.sources import plane_case

_G = 9.81


def free_finite_rocking() -> Iterator[Row]:
    """Block 1 x 4 m let go at half its slenderness: impacts and peaks at rotations of any size, restitution 0."""
    case = _slender("finite")
    slenderness = math.atan(0.25)
    moments = np.linspace(0.0, 4.4, 8801)
    lifted = [0.0, 0.0, math.sin(0.5 * slenderness)]
    rocking = _run(case, np.array([0.0, 4.4]), np.zeros(2), moments, [lifted, [0.0, 0.0, 0.0]])
    impacts = rocking.times_of("heel strikes", "toe strikes")
    remark = "sine of the rotation over the crack is the gap"
    for number, (reference, ours) in enumerate(zip((0.698343, 1.834900, 2.799281, 3.635548), impacts, strict=False)):
        yield Row(f"impact {number + 1} [s]", reference, ours, 1e-6)
    rotation = np.arcsin(rocking.histories.gap_toe - rocking.histories.gap_heel)
    references = (0.386714, 0.306397, 0.246057, 0.199314)
    for reference, (start, end) in zip(references, pairwise(impacts), strict=False):
        between = (moments > start) & (moments < end)
        peak = float(np.abs(rotation[between]).max()) / slenderness
        yield Row("peak after it, over the slenderness", reference, peak, 5e-6, remark=remark)


def overturning_pulses() -> Iterator[Row]:
    """Least A / (alpha g) of half and full sines that overturn a slender block without impact, with P-Delta."""
    case = _slender("p-delta")
    block = build_block(case)
    for whole, references in (
        (False, (1.3224, 1.80072, 2.29387, 3.28915)),
        (True, (1.41832, 2.34990, 3.63115, 7.16813)),
    ):
        for ratio, reference in zip((1, 2, 3, 5), references, strict=True):
            ours = _least(case, block, ratio, whole=whole)
            name = "full sine" if whole else "half sine"
            yield Row(f"{name}, w/p = {ratio}", reference, ours, 1e-5, remark="linearised block: its own p and alpha")


def overturning_after_impact() -> Iterator[Row]:
    """A / (alpha g) of full sines between which a slender block overturns after one impact, with P-Delta.

    Below the first edge it stands, between both it overturns after one impact, above the second it stands again: the
    safe region of Zhang and Makris, which ends where it overturns without impact.
    """
    case = _slender("p-delta")
    block = build_block(case)
    remark = (
        "an independent program with the textbook's equation and Housner's ratio, integrated by SciPy (DOP853, 1e-11)"
    )
    for ratio, bracket, references in (
        (3, (1.02, 2.5, 3.57), (1.398617, 3.505343)),
        (4, (1.02, 3.0, 5.1), (1.771726, 4.907883)),
        (5, (1.02, 4.5, 6.8), (2.880190, 6.456526)),
        (6, (1.02, 6.4, 8.5), (4.813185, 8.020859)),
    ):
        for name, reference, (low, high) in zip(("from", "to"), references, pairwise(bracket), strict=True):
            ours = _edge(case, block, ratio, (low, high))
            yield Row(f"{name}, w/p = {ratio}", reference, ours, 1e-5, remark=remark, kind="prototype")


def measured_impacts() -> Iterator[Row]:
    """Velocity that an impact leaves of a block of concrete that rocks on concrete, as measured, and without the loss.

    ElGawady and others let blocks of aspect ratio 5 and 3 rock freely, and found 0.95 and 0.97 of Housner's ratio. Ours
    is the ratio at the first impact of such a block with `rocking_loss` of 0.05 and 0.03, and without.
    """
    for aspect, measured, kept in ((5.0, 0.95, 0.801), (3.0, 0.97, 0.680)):
        sine2 = 1.0 / (1.0 + aspect**2)
        reference = measured * (1.0 - 1.5 * sine2)
        ours, plain = (_ratio_of_impact(aspect, loss) for loss in (1.0 - measured, 0.0))
        what = f"aspect ratio {aspect:g}: velocity after the impact over before"
        yield Row(what, reference, ours, 1e-6, kind="measured")
        yield Row(
            f"{what}, without rocking_loss", reference, plain, 0.01, explained=0.06, remark=_HOUSNER, kind="measured"
        )
        yield Row(f"aspect ratio {aspect:g}: energy that is kept", kept, ours**2, 5e-4, kind="measured")


_HOUSNER = "Housner's ratio alone, which keeps more than was measured"


def _ratio_of_impact(aspect: float, loss: float) -> float:
    """Return the angular velocity after the first impact over that before, of a block 1 m wide let go at half its
    slenderness."""
    changes = {"crack.rocking_loss": loss, "section.polygon": _rectangle(aspect)}
    case = _slender("p-delta").with_(changes)
    tilt = 0.5 * math.atan(1.0 / aspect)
    rocking = _run(case, np.array([0.0, 3.0]), np.zeros(2), start=[[0.0, tilt, 0.0], [0.0, 0.0, 0.0]])
    events, (first, *_) = rocking.events, rocking.times_of("heel strikes", "toe strikes")
    at = int(np.flatnonzero(events.time == first)[0])
    approach = abs(events.approach_velocity_heel[at] + events.approach_velocity_toe[at])
    return float(abs(events.gap_velocity_heel[at] + events.gap_velocity_toe[at]) / approach)


def _rectangle(height: float) -> list[list[str]]:
    return [["0 m", "0 m"], ["1 m", "0 m"], ["1 m", f"{height:g} m"], ["0 m", f"{height:g} m"]]


def _edge(case: Case, block: Block, ratio: float, bracket: tuple[float, float]) -> float:
    """Return the amplitude over g B / H at which overturning after one impact begins or ends, by bisection."""
    below, (low, high) = _overturns(case, block, ratio, bracket[0]), bracket
    while high - low > 1e-6:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _overturns(case, block, ratio, middle) == below else (low, middle)
    return high


def _overturns(case: Case, block: Block, ratio: float, amplitude: float) -> bool:
    """Return whether a full sine overturns the block after one impact."""
    time, pulse = _sine(block, ratio, whole=True)
    rocking = _run(case, time, amplitude * _G * block.toe_distance / block.height * pulse)
    return rocking.outcome == "overturned" and rocking.summary.impacts == 1.0


def _slender(rotation: str) -> Case:
    """Return a block 1 m wide and 4 m high that does not slide."""
    return plane_case(
        {
            "gravity": f"{_G} m/s^2",
            "section": {"polygon": _rectangle(4.0)},
            "crack": {"friction": 10.0, "restitution": 0.0},
            "analysis": {"rotation": rotation},
        }
    )


def _run(
    case: Case, time: Floats, ground: Floats, moments: Floats | None = None, start: list[list[float]] | None = None
) -> BlockRun:
    block = build_block(case)
    times = np.empty(0) if moments is None else moments
    return run_block(block.parameters(), Shaking(time, ground), times, start=start, varying=varying(case, block))


def _least(case: Case, block: Block, ratio: float, *, whole: bool) -> float:
    """Return the least amplitude over g B / H that overturns the block before it strikes, by bisection."""
    half, height = block.toe_distance, block.height
    time, pulse = _sine(block, ratio, whole=whole)
    low, high = 1.0, 12.0
    while high - low > 1e-6:
        middle = 0.5 * (low + high)
        rocking = _run(case, time, middle * _G * half / height * pulse)
        if rocking.outcome == "overturned" and rocking.summary.impacts == 0.0:
            high = middle
        else:
            low = middle
    return high


def _sine(block: Block, ratio: float, *, whole: bool) -> tuple[Floats, Floats]:
    """Return a sine of the circular frequency `ratio` p, one of it or half of it, and long rest after it."""
    half, height, mass = block.toe_distance, block.height, block.mass_vertical
    rate = math.sqrt(mass * _G * height / (block.inertia + mass * (height**2 + half**2)))
    circular = ratio * rate
    end = (2.0 if whole else 1.0) * math.pi / circular
    time = np.linspace(0.0, end, 4001)
    pulse = np.append(np.sin(circular * time), 0.0)
    pulse[-2] = 0.0
    return np.append(time, end + 40.0 / rate), pulse
