"""How much a result hangs on the last per cent of the shaking: the same run, a little weaker and a little stronger."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from heeltoe import _kernel
from heeltoe.case.model import Case
from heeltoe.errors import InputError
from heeltoe.mechanics.block import Block, build_block
from heeltoe.models.decoupled.response import DecoupledResponse
from heeltoe.models.flexible.response import FlexibleResponse
from heeltoe.models.rigid.many import rigid_many
from heeltoe.models.rigid.varying import varies
from heeltoe.models.rigid.walk import GroundSeries, run_block
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.moments import ground
from heeltoe.result.response import Response
from heeltoe.warnings import Notice

Floats = NDArray[np.float64]
Told = Callable[[int, int], None]
R = TypeVar("R", bound=Response)

#: Runs where no number is given: enough for a standard deviation, and one of them has the motion as it is.
RUNS = 11
_FEWEST, _MOST = 2, 1000
#: Factors on the ground motion, from the weakest to the strongest: no record and no site is known better than that.
WEAKEST, STRONGEST = 0.99, 1.01
#: Where half the step changed the slip by less than this, the longer step is good enough for a spread.
_SAME = 0.01
#: A standard deviation of the slip above this part of its mean is said as a warning.
_LARGE = 0.10
#: Slips of less vary by nothing anyone could measure [m].
_NOTHING = 1e-4

# Numbers of the contract, and what gives them: name in both kernels and factor. The rigid kernel has no openings, but
# rotations of a base that stays straight.
_COMMON = {
    "residual_slip_m": ("slip", 1.0),
    "peak_slip_downstream_m": ("slip_max", 1.0),
    "peak_slip_upstream_m": ("slip_min", 1.0),
    "rocking_downstream_rad": ("rotation_min", -1.0),
    "rocking_upstream_rad": ("rotation_max", 1.0),
}
#: Names of the numbers that have a spread.
QUANTITIES = (*_COMMON, "opening_upstream_m", "opening_downstream_m")


def check_runs(value: object, field: str) -> int:
    """Return the number of runs that `value` means.

    Raises
    ------
    InputError
        Where it is no whole number from 2 to 1000.
    """
    text = str(value).strip()
    if not (text.isascii() and text.isdigit() and _FEWEST <= int(text[:9]) <= _MOST):
        raise InputError("spread-runs", field, value, fewest=_FEWEST, most=_MOST, usual=RUNS)
    return int(text)


def with_spread(response: R, case: Case, runs: int = RUNS, *, told: Told | None = None) -> R:
    """Run a case again with its ground motion scaled by equally spaced factors from 0.99 to 1.01.

    Parameters
    ----------
    response
        Of :func:`heeltoe.rigid`, :func:`heeltoe.decoupled` or :func:`heeltoe.flexible`, which says the model and the
        motion.
    case
        What it is the response of.
    runs
        How many, 2 to 1000; they run on all cores.
    told
        Called with how many runs are done, and of how many, as they go on.

    Returns
    -------
    Response
        The same with `spread`, and a warning where the slip varies much or runs end without a result. In `spread`:
        `runs`, `failed` (without a result; they count nowhere else), `scales`, `residual_slips_m` (None where failed),
        `time_step_s` of the flexible model, and for each of :data:`QUANTITIES` mean, std (of a sample), min and max.

    Raises
    ------
    InputError
        Where the number of runs cannot be used.
    """
    runs = check_runs(runs, "runs")
    scales = np.linspace(WEAKEST, STRONGEST, runs)
    end = case.motion.duration if case.motion and case.motion.duration else response.motion.duration
    step = None
    if isinstance(response, FlexibleResponse):
        step = _step(response)
        found, good = _flexible(response, case, end, scales, step, told)
    elif isinstance(response, DecoupledResponse):
        from heeltoe.models.decoupled.model import crack_motions

        # The part below is linear: its motion grows as the ground's does.
        found, good = _rigid(case, crack_motions(case, response.motion, response.vertical), end, scales, told)
    else:
        found, good = _rigid(case, (response.motion, response.vertical, None), end, scales, told)
    spread = {
        "runs": runs,
        "failed": int(np.sum(~good)),
        "scales": scales.tolist(),
        **({} if step is None else {"time_step_s": step}),
        **{name: _statistics(found[name][good]) for name in QUANTITIES},
        "residual_slips_m": [
            float(slip) if fine else None for slip, fine in zip(found[QUANTITIES[0]], good, strict=True)
        ],
    }
    return replace(response, spread=spread, warnings=(*response.warnings, *_warnings(spread)))


_Motions = tuple[GroundMotion, GroundMotion | None, GroundMotion | None]


def _rigid(
    case: Case, motions: _Motions, end: float, scales: Floats, told: Told | None
) -> tuple[dict[str, Floats], NDArray[np.bool_]]:
    block = build_block(case)
    if varies(case) or motions[2] is not None:
        return _varying(case, block, motions, end, scales, told)
    # Both directions up to the end of the run, which may be after that of the record.
    time, horizontal, up = ground(motions[0], motions[1], end)
    motion = GroundMotion.from_points(time, horizontal)
    rows = rigid_many(
        [block] * scales.size,
        [motion if up is None else (motion, GroundMotion.from_points(time, up))],
        scales=scales,
        event_limit=case.analysis.event_limit,
        jam=case.analysis.paradox == "tangential impact",
    )
    if told is not None:
        told(scales.size, scales.size)
    return _with_openings(rows, block)


def _varying(
    case: Case, block: Block, motions: _Motions, end: float, scales: Floats, told: Told | None
) -> tuple[dict[str, Floats], NDArray[np.bool_]]:
    shaking = GroundSeries.of(*motions, end)
    rows = []

    def run(scale: float) -> Floats:
        return run_block(case, block, shaking.scaled(scale), np.empty(0))[0]

    # The kernel lets go of the interpreter.
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for done, row in enumerate(pool.map(run, scales.tolist())):
            if told is not None:
                told(done, scales.size)
            rows.append(row)
    table = np.array(rows)
    return _with_openings({name: table[:, k] for k, name in enumerate(_kernel.SUMMARY_FIELDS)}, block)


def _with_openings(rows: Mapping[str, Floats], block: Block) -> tuple[dict[str, Floats], NDArray[np.bool_]]:
    found = _named(rows)
    found["opening_upstream_m"] = block.width * found["rocking_downstream_rad"]
    found["opening_downstream_m"] = block.width * found["rocking_upstream_rad"]
    good = [_kernel.OUTCOMES.index(name) for name in ("ok", "overturned")]
    return found, np.isin(rows["outcome"], good)


def _flexible(
    response: FlexibleResponse, case: Case, end: float, scales: Floats, step: float, told: Told | None
) -> tuple[dict[str, Floats], NDArray[np.bool_]]:
    # Here, so that the rigid model need not wait for the elastic parts.
    from heeltoe.models.flexible.shaken import Shaken

    shaken = Shaken(case, response.crack.dam, response.motion, response.vertical, end)
    if told is None:
        rows = shaken.run_scaled(step, scales)
    else:
        # In parts of one run for each core, so that there is something to tell.
        parts = []
        for start in range(0, scales.size, os.cpu_count() or 1):
            told(start, scales.size)
            parts.append(shaken.run_scaled(step, scales[start : start + (os.cpu_count() or 1)]))
        rows = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    found = _named(rows)
    found["opening_upstream_m"] = rows["opening_heel"]
    found["opening_downstream_m"] = rows["opening_toe"]
    return found, rows["outcome"] == _kernel.CRACK_OUTCOMES.index("ok")


def _named(rows: Mapping[str, Floats]) -> dict[str, Floats]:
    # Adding zero makes a negative zero a plain one.
    return {name: factor * rows[column] + 0.0 for name, (column, factor) in _COMMON.items()}


def _step(response: FlexibleResponse) -> float:
    """Return the step of the runs: the longer of the two that the response compared where they hardly differ."""
    evidence = response.summary["convergence"]
    if evidence is not None and evidence["change"] <= _SAME:
        return float(evidence["coarser_step_s"])
    return float(response.summary["time_step_s"])


def _statistics(values: Floats) -> dict[str, float] | None:
    """Return mean, standard deviation and extremes; None of fewer than two values."""
    if values.size < 2:
        return None
    return {
        "mean": float(values.mean()),
        "std": float(values.std(ddof=1)),
        "min": float(values.min()),
        "max": float(values.max()),
    }


def _warnings(spread: Mapping[str, Any]) -> list[Notice]:
    said = []
    if spread["failed"]:
        said.append(Notice("spread-failures", failed=spread["failed"], runs=spread["runs"]))
    slip = spread["residual_slip_m"]
    if slip is not None and slip["std"] > max(_LARGE * abs(slip["mean"]), _NOTHING):
        said.append(Notice("spread-large", slips_m=(slip["min"], slip["max"]), scales=(WEAKEST, STRONGEST)))
    return said
