"""A stretch of a study's runs, by the model of each, as a table."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from time import perf_counter
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from heeltoe.arrays import Floats, Integers
from heeltoe.case.columns import COLUMNS
from heeltoe.case.crack.kinks import any_kinks
from heeltoe.case.model import Case
from heeltoe.errors import InputError
from heeltoe.kernel.block import BLOCK, OUTCOMES
from heeltoe.mechanics.block import Block, build_block, instability
from heeltoe.mechanics.many import crack_widths, sound_blocks
from heeltoe.models.rigid.many import run_rows
from heeltoe.models.rigid.rows import Rows
from heeltoe.models.rigid.tables import with_openings
from heeltoe.models.rigid.varying import by_itself
from heeltoe.models.rigid.walk import limits_of
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.contract import HEADLINES, LARGEST_ROTATION, TOO_FAR, headlines
from heeltoe.study.cracks.columns import OfCrack, column_of, columns_of_cracks
from heeltoe.study.cracks.two import at_two_cracks, run_two
from heeltoe.study.plan import Plan, Runs

#: What the case of a run refuses, as water above the crest: such a run has no result and is counted as this.
REFUSED = "refused"
#: What the seconds of a part stand under in the metadata of its table, on their way to who counts them.
SECONDS = "seconds"
_SLIPS = ("slip_sliding", "slip_slide_rocking", "slip_drifting")
_TIMES = tuple(f"time_{name}" for name in ("rest", "sliding", "rocking", "slide_rocking", "drifting"))
#: Names of the numbers of a run, in their order in the table.
NUMBERS = (
    *(each.key for each in HEADLINES),
    *(f"{name}_m" for name in _SLIPS),
    *(f"{name}_s" for name in _TIMES),
    "largest_impact_velocity_m_s",
    "end_time_s",
    "energy_residual",
)
# Outcomes whose numbers are those of a dam.
_WITH_RESULT = ("ok", "overturned")

Words = NDArray[Any]
#: What a kernel found, outcomes, headline numbers and, of several cracks, those at each, of some runs.
Ran = tuple[dict[str, Floats], Words, OfCrack, Sequence[OfCrack]]


class Found:
    """Results of some runs, filled model by model."""

    def __init__(self, count: int, cracks: int) -> None:
        self.numbers = {name: np.full(count, np.nan) for name in (*NUMBERS, *columns_of_cracks(cracks))}
        self.impacts = np.zeros(count, dtype=np.int64)
        self.slid_off = np.zeros(count, dtype=bool)
        self.outcome = np.full(count, REFUSED, dtype=object)
        self.seconds: dict[str, float] = {}

    @contextmanager
    def timed(self, what: str) -> Iterator[None]:
        """Add what is done here to the seconds that it takes."""
        began = perf_counter()
        yield
        self.seconds[what] = self.seconds.get(what, 0.0) + perf_counter() - began

    def put(
        self,
        rows: Integers,
        table: Mapping[str, Floats],
        outcome: Words,
        told: OfCrack,
        of_cracks: Sequence[OfCrack] = (),
    ) -> None:
        """Put what a kernel found into some rows: at the crack asked of, and at each of several."""
        found = {
            **told.named,
            **{f"{name}_m": table[name] for name in _SLIPS},
            **{f"{name}_s": table[name] for name in _TIMES},
            "largest_impact_velocity_m_s": table["largest_impact_velocity"],
            "end_time_s": table["end_time"],
            "energy_residual": table["energy_residual"],
            **{column_of(k, key): values for k, each in enumerate(of_cracks) for key, values in each.named.items()},
        }
        fine = np.isin(outcome, _WITH_RESULT)
        for name, values in found.items():
            self.numbers[name][rows] = np.where(fine, values, np.nan)
        off = np.any([_largest_slip(each.named) > each.width for each in (told, *of_cracks)], axis=0)
        self.slid_off[rows] = (fine | (outcome == TOO_FAR)) & off
        self.impacts[rows] = np.where(fine, table["impacts"], 0.0).astype(np.int64)
        self.outcome[rows] = outcome


def _largest_slip(named: Mapping[str, Floats]) -> Floats:
    return np.maximum(named["peak_slip_downstream_m"], -named["peak_slip_upstream_m"])


def run_part(plan: Plan, start: int, stop: int, threads: int = 1) -> pa.Table:
    """Run a stretch of a study.

    Parameters
    ----------
    plan
        From :func:`heeltoe.study.plan.plan_of`.
    start, stop
        Numbers of the first run and of the one after the last.
    threads
        Cores for it, 0 for all; the results are the same bits for any number.

    Returns
    -------
    Table
        Its metadata say, under :data:`SECONDS`, what took how long.
    """
    found = Found(min(stop, plan.count) - start, 1 + len(plan.case.further_cracks))
    with found.timed("sampling"):
        runs = plan.runs(start, stop)
    for place, model in enumerate(plan.study.model):
        rows = np.flatnonzero(runs.model == place)
        if rows.size:
            _MODELS[model](plan, runs, rows, found, threads)
    with found.timed("tables"):
        table = _table(plan, runs, found)
    return table.replace_schema_metadata({SECONDS: json.dumps(found.seconds)})


def _rigid(plan: Plan, runs: Runs, rows: Integers, found: Found, threads: int) -> None:
    if plan.case.further_cracks:
        _two_blocks(plan, runs, rows, found, threads)
        return
    samples, first, of_sample = np.unique(runs.sample[rows], return_index=True, return_inverse=True)
    values = {path: column[rows][first] for path, column in runs.values.items()}
    motions, which = np.unique(runs.motion[rows], return_inverse=True)
    earthquakes = [plan.earthquakes[motion] for motion in motions.tolist()]
    with found.timed("blocks"):
        numbers, blocks, sound = _blocks(plan, values, samples.size)
    kept = sound[of_sample]
    rows, which, dam = rows[kept], which[kept], of_sample[kept]
    scales = _both_ways(runs.factor[rows])
    several = [blocks[place] for place in dam.tolist()] if blocks else []
    with found.timed("kernel"):
        table = run_rows(
            Rows(numbers[dam], several, which.astype(np.int64), scales),
            earthquakes,
            None if blocks else limits_of(plan.case),
            threads,
        )
    width = crack_widths(numbers[dam])
    named = with_openings(headlines(table), plan.case, width)
    outcome = np.array(OUTCOMES, dtype=object)[table["outcome"].astype(np.int64)]
    if plan.case.analysis.rotation != "finite":
        outcome = _not_too_far([table], outcome)
    found.put(rows, table, outcome, OfCrack(named, width))


def _two_blocks(plan: Plan, runs: Runs, rows: Integers, found: Found, threads: int) -> None:
    samples, first, of_sample = np.unique(runs.sample[rows], return_index=True, return_inverse=True)
    values = {path: column[rows][first] for path, column in runs.values.items()}
    with found.timed("blocks"):
        dams = list(_cases(plan, values, samples.size))
    each = [(row, dams[sample]) for row, sample in zip(rows.tolist(), of_sample.tolist(), strict=True)]
    there = [(row, case) for row, case in each if case is not None]
    earthquakes = [plan.earthquakes[runs.motion[row]] for row, _ in there]
    factors = [float(runs.factor[row]) for row, _ in there]
    with found.timed("kernel"):
        ran = run_two([case for _, case in there], earthquakes, factors, threads)
    done = [(row, each) for (row, _), each in zip(there, ran, strict=True) if each is not None]
    if done:
        told, of_cracks, table = at_two_cracks(plan.case, [each for _, each in done])
        outcome = np.array([each.outcome for _, each in done], dtype=object)
        found.put(np.array([row for row, _ in done]), table, outcome, told, of_cracks)


def _blocks(
    plan: Plan, values: Mapping[str, NDArray[Any]], count: int
) -> tuple[Floats, list[Block], NDArray[np.bool_]]:
    """Return the numbers of the blocks of some dams, the blocks where something varies as they move, and which of the
    dams there are: the others are refused, and what stands in their places says nothing."""
    sound = np.ones(count, dtype=bool)
    if values and not by_itself(plan.case) and values.keys() <= set(COLUMNS):
        numbers, sound = sound_blocks(plan.case, values)
        return numbers, [], sound
    numbers = np.zeros((count, len(BLOCK)))
    blocks: list[Block] = []
    some = build_block(plan.case)
    for place, case in enumerate(_cases(plan, values, count)):
        try:
            block = None if case is None else build_block(case)
        except InputError:
            block = None
        if block is None:
            sound[place], block = False, some
        numbers[place] = block.parameters()
        blocks.append(block)
    return numbers, blocks if any(by_itself(block.case) for block in blocks) else [], sound


def _cases(plan: Plan, values: Mapping[str, NDArray[Any]], count: int) -> Iterator[Case | None]:
    """Walk the cases of some dams; None for one that the case itself refuses."""
    axes = {axis.path: axis for axis in plan.axes}
    for place in range(count):
        changes: dict[str, Any] = {}
        for path, numbers in values.items():
            changes |= axes[path].changes(numbers[place])
        try:
            yield plan.case.with_(changes) if changes else plan.case
        except InputError:
            yield None


def _not_too_far(tables: Sequence[Mapping[str, Floats]], outcome: Words) -> Words:
    """Return the outcomes where rotations at each crack are taken for small: those that are not have no result."""
    far = np.any(
        [np.maximum(each["rotation_max"], -each["rotation_min"]) > LARGEST_ROTATION for each in tables], axis=0
    )
    return np.where((outcome == "ok") & far, TOO_FAR, outcome)


def _elastic(plan: Plan, runs: Runs, rows: Integers, found: Found, run: Callable[[Case, int, Floats], Ran]) -> None:
    """Run dam by dam, and motion by motion: what is built for one of them serves all its strengths."""
    samples, first, of_sample = np.unique(runs.sample[rows], return_index=True, return_inverse=True)
    values = {path: column[rows][first] for path, column in runs.values.items()}
    for place, case in enumerate(_cases(plan, values, samples.size)):
        if case is None:
            continue
        mine = rows[of_sample == place]
        for motion in np.unique(runs.motion[mine]).tolist():
            here = mine[runs.motion[mine] == motion]
            try:
                ran = run(case, motion, runs.factor[here])
            except InputError:
                continue
            found.put(here, *ran)


def _flexible(plan: Plan, runs: Runs, rows: Integers, found: Found, threads: int) -> None:
    from heeltoe.kernel.dam import DAM_OUTCOMES, DAM_STATES
    from heeltoe.models.drained import follows_drains, run_drained
    from heeltoe.models.flexible.reduced import build_flexible_dam
    from heeltoe.models.flexible.shaken import ShakenDam

    def run(case: Case, motion: int, scales: Floats) -> Ran:
        case = plan.pilot.refined(case) if plan.pilot else case
        with found.timed("blocks"):
            dam = build_flexible_dam(case)
        halvings = plan.pilot.halvings if plan.pilot else 0

        def shake(earthquake: Earthquake, scales: Floats) -> tuple[dict[str, Floats], ...]:
            with found.timed("kernel"):
                shaken = ShakenDam(case, dam, earthquake.shaking)
                step = shaken.first_step() / 2.0**halvings
                if follows_drains(case, earthquake):
                    return (run_drained(shaken, earthquake.motion.parts, step, scales, threads),)
                return shaken.run_scaled_cracks(step, scales, threads=threads)

        # A dam that swings on two of its steps does not show in the state of its crack: it always has its silence.
        steps = any_kinks(case)
        tables = shake(plan.earthquakes[motion].silent(case.analysis.silence if steps else 0.0), scales)
        restless = np.any([table["final_state"] != DAM_STATES.index("rest") for table in tables], axis=0)
        moves = (tables[0]["outcome"] == DAM_OUTCOMES.index("ok")) & restless & (not steps)
        if moves.any() and case.analysis.silence:
            longer = shake(plan.earthquakes[motion].silent(case.analysis.silence), scales[moves])
            for table, again in zip(tables, longer, strict=True):
                for name, values in again.items():
                    table[name][moves] = values
        outcome = np.array(DAM_OUTCOMES, dtype=object)[tables[0]["outcome"].astype(np.int64)]
        if not dam.anchors and (not dam.start.stands or instability(build_block(case)) is not None):
            outcome[:] = "unstable"
        told = [
            OfCrack(headlines(table), np.full(scales.size, section.crack_width))
            for table, section in zip(tables, dam.sections, strict=True)
        ]
        outcome = _not_too_far(tables, outcome)
        return tables[dam.asked], outcome, told[dam.asked], told if len(told) > 1 else ()

    _elastic(plan, runs, rows, found, run)


def _decoupled(plan: Plan, runs: Runs, rows: Integers, found: Found, threads: int) -> None:
    from heeltoe.models.decoupled.model import crack_earthquake

    def run(case: Case, motion: int, scales: Floats) -> Ran:
        with found.timed("blocks"):
            block = build_block(case)
            # The part below is linear: its motion grows as the ground's does.
            # The crack swings on while the ground stands still.
            shaken = crack_earthquake(case, plan.earthquakes[motion].silent(case.analysis.silence))
        many = Rows(
            np.tile(block.parameters(), (scales.size, 1)),
            [block] * scales.size if by_itself(case) else [],
            np.zeros(scales.size, dtype=np.int64),
            _both_ways(scales),
        )
        with found.timed("kernel"):
            table = run_rows(many, [shaken], replace(limits_of(case), silence=0.0), threads)
        outcome = np.array(OUTCOMES, dtype=object)[table["outcome"].astype(np.int64)]
        if case.analysis.rotation != "finite":
            outcome = _not_too_far([table], outcome)
        width = np.full(scales.size, block.width)
        return table, outcome, OfCrack(with_openings(headlines(table), case, width), width), ()

    _elastic(plan, runs, rows, found, run)


_MODELS: dict[str, Callable[[Plan, Runs, Integers, Found, int], None]] = {
    "rigid": _rigid,
    "decoupled": _decoupled,
    "flexible": _flexible,
}


def _both_ways(factor: Floats) -> Floats:
    return np.column_stack([factor, factor])


def _table(plan: Plan, runs: Runs, found: Found) -> pa.Table:
    """Return the runs with their results, as they are stored."""
    names = np.array([shake.name for shake in plan.shakes])
    events = np.array([plan.events[shake.event] for shake in plan.shakes])
    turned = np.array([shake.turned for shake in plan.shakes])

    def words(values: Any) -> pa.Array:
        return pa.array(values, type=pa.string()).dictionary_encode()

    columns: dict[str, Any] = {
        "run": pa.array(runs.number),
        "sample": pa.array(runs.sample),
        "model": words(np.array(plan.study.model)[runs.model]),
        "event": words(events[runs.motion]),
        "motion": words(names[runs.motion]),
        "reversed": pa.array(turned[runs.motion]),
        "factor": pa.array(runs.factor),
    }
    for axis in plan.axes:
        column = runs.values[axis.path]
        columns[axis.path] = pa.array(column) if axis.quantity is not None else words([str(each) for each in column])
    columns["outcome"] = words(found.outcome)
    for name, values in found.numbers.items():
        columns[name] = pa.array(values, mask=np.isnan(values))
    columns["impacts"] = pa.array(found.impacts)
    columns["slid_off"] = pa.array(found.slid_off)
    return pa.table(columns)
