"""A stretch of a study's runs, by the model of each, as a table."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from time import perf_counter
from typing import Any

import numpy as np
import pyarrow as pa
from numpy.typing import NDArray

from heeltoe.base.arrays import Floats, Integers
from heeltoe.case.columns import COLUMNS
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.kernel.block import BLOCK, OUTCOMES
from heeltoe.mechanics.block import Block, build_block
from heeltoe.mechanics.many import crack_widths, sound_blocks, sound_vectors
from heeltoe.models.rigid.across import check_across
from heeltoe.models.rigid.many import run_rows
from heeltoe.models.rigid.model import run_rigid
from heeltoe.models.rigid.rows import Rows
from heeltoe.models.rigid.tables import crest_moves, with_openings
from heeltoe.models.rigid.varying import by_itself
from heeltoe.models.rigid.walk import limits_of
from heeltoe.models.runner import (
    BOUNCY,
    HAIR,
    block_until_rest,
    determined,
    outcomes_of,
    twin_of,
    with_outcome,
)
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.contract import CRACKED, HEADLINES, SLIPS_BY_MODE, TIMES_BY_MODE, WIDTH, headlines
from heeltoe.result.crest import CREST_PEAKS, crest_peaks
from heeltoe.result.judge import Judgement, judge
from heeltoe.result.outcome import Outcome
from heeltoe.result.response import Response
from heeltoe.study.plan.crack_columns import OfCrack, column_of, numbers_of_cracks
from heeltoe.study.plan.plan import Plan, Runs

#: What the seconds of a part stand under in the metadata of its table, on their way to who counts them.
SECONDS = "seconds"
_RESTITUTION = BLOCK.index("restitution")
#: Names of the numbers of a run, in their order in the table.
NUMBERS = (
    *(headline.key for headline in HEADLINES),
    *SLIPS_BY_MODE,
    *TIMES_BY_MODE,
    "largest_impact_velocity_m_s",
    "end_time_s",
    "energy_residual",
    CRACKED,
)

Words = NDArray[Any]
#: How some runs ended, their numbers at the crack that leads and, of several cracks, at each.
Ran = tuple[Words, OfCrack, Sequence[OfCrack]]


class PartResults:
    """Results of some runs, filled model by model."""

    def __init__(self, count: int, cracks: int, *, crest: bool) -> None:
        self.of_dam = (*NUMBERS, *(CREST_PEAKS if crest else ()))
        self.numbers = {name: np.full(count, np.nan) for name in (*self.of_dam, *numbers_of_cracks(cracks))}
        self.impacts = np.zeros(count, dtype=np.int64)
        self.slid_off = np.zeros(count, dtype=bool)
        self.undetermined = np.zeros(count, dtype=bool)
        self.outcome = np.full(count, Outcome.REFUSED, dtype=object)
        self.seconds: dict[str, float] = {}

    @contextmanager
    def timed(self, what: str) -> Iterator[None]:
        """Add what is done here to the seconds that it takes."""
        began = perf_counter()
        yield
        self.seconds[what] = self.seconds.get(what, 0.0) + perf_counter() - began

    def put(self, rows: Integers, outcome: Words, request: OfCrack, cracks: Sequence[OfCrack] = ()) -> None:
        """Put what some runs came to into their rows: at the crack that leads, and at each of several."""
        columns = {name: request.named[name] for name in self.of_dam}
        columns |= {
            column_of(k, key): crack.named[key]
            for k, crack in enumerate(cracks)
            for key in (*(headline.key for headline in HEADLINES), CRACKED)
        }
        judgement = _judged(outcome, cracks or [request])
        for name, values in columns.items():
            self.numbers[name][rows] = np.where(judgement.has_result, values, np.nan)
        self.slid_off[rows] = judgement.slid_off
        self.impacts[rows] = np.where(judgement.has_result, request.named["impacts"], 0.0).astype(np.int64)
        self.outcome[rows] = outcome


def _judged(outcome: Words, cracks: Sequence[OfCrack]) -> Judgement:
    """Return the judgement of some runs by the numbers at their cracks, without limits."""
    columns = {headline.key: np.column_stack([crack.named[headline.key] for crack in cracks]) for headline in HEADLINES}
    columns[WIDTH] = np.column_stack([crack.width for crack in cracks])
    return judge({"outcome": outcome, **columns}, {})


def _of_table(
    table: Mapping[str, Floats], width: Floats, headline: Mapping[str, Floats], *, joint: bool = False
) -> OfCrack:
    """Return the numbers at a crack, or at a bonded `joint`, that the rows of a kernel have; the `headline` ones have
    been read of them."""
    named = {
        **headline,
        **{name: table[name[:-2]] for name in (*SLIPS_BY_MODE, *TIMES_BY_MODE)},
        "largest_impact_velocity_m_s": table["largest_impact_velocity"],
        "end_time_s": table["end_time"],
        "energy_residual": table["energy_residual"],
        "impacts": table["impacts"],
        # A crack that is there from the start cracks no farther.
        CRACKED: np.minimum(table["cracked_length"], width) if joint else np.zeros_like(width),
    }
    return OfCrack(named, width)


def _of_responses(responses: Sequence[Response], place: int) -> OfCrack:
    """Return the numbers that some responses have at one of their cracks, counted from the crest down."""
    names = (*NUMBERS, *CREST_PEAKS, "impacts")
    rows, widths = [], []
    for response in responses:
        numbers = response.cracks[place].of_crack
        if numbers is None or response.energy is None:
            # A dam that does not stand has none.
            rows.append(dict.fromkeys(names, math.nan))
            widths.append(math.inf)
            continue
        row = {
            **dict(zip(SLIPS_BY_MODE, numbers.slip_by_mode_m.values(), strict=True)),
            **dict(zip(TIMES_BY_MODE, numbers.time_by_mode_s.values(), strict=True)),
            **crest_peaks(response.crest),
            "end_time_s": response.end_time_s,
            "energy_residual": response.energy.residual,
            # These models know no joint that holds.
            CRACKED: 0.0,
        }
        rows.append({name: row[name] if name in row else numbers[name] for name in names})
        widths.append(numbers.crack_width_m)
    return OfCrack({name: np.array([row[name] for row in rows], dtype=np.float64) for name in names}, np.array(widths))


def run_part(plan: Plan, start: int, stop: int, threads: int = 1) -> pa.Table:
    """Run a stretch of a study.

    Parameters
    ----------
    plan
        From :func:`heeltoe.study.plan.plan.plan_of`.
    start, stop
        Numbers of the first run and of the one after the last.
    threads
        Cores for it, 0 for all; the results are the same bits for any number.

    Returns
    -------
    Table
        Its metadata say, under :data:`SECONDS`, what took how long.
    """
    results = PartResults(min(stop, plan.count) - start, 1 + len(plan.case.further_cracks), crest=plan.crest)
    with results.timed("sampling"):
        runs = plan.runs(start, stop)
    for place, model in enumerate(plan.study.model):
        rows = np.flatnonzero(runs.model == place)
        if rows.size:
            _MODELS[model](plan, runs, rows, results, threads)
    with results.timed("tables"):
        table = _table(plan, runs, results)
    return table.replace_schema_metadata({SECONDS: json.dumps(results.seconds)})


def columns_of(plan: Plan) -> dict[str, str]:
    """Return the types of the columns of a study's runs, by name."""
    results = PartResults(0, 1 + len(plan.case.further_cracks), crest=plan.crest)
    return {column.name: str(column.type) for column in _table(plan, plan.runs(0, 0), results).schema}


def _rigid(plan: Plan, runs: Runs, rows: Integers, results: PartResults, threads: int) -> None:
    if plan.case.further_cracks:
        _two_blocks(plan, runs, rows, results, threads)
        return
    samples, values, of_sample = _dams(runs, rows)
    motions, which = np.unique(runs.motion[rows], return_inverse=True)
    earthquakes = [plan.earthquakes[motion] for motion in motions.tolist()]
    with results.timed("blocks"):
        across = any(earthquake.cross is not None for earthquake in earthquakes)
        numbers, blocks, sound = _blocks(plan, values, samples.size, across=across)
        moves = _crest_moves(plan, values, blocks, samples.size) if plan.crest else None
    kept = sound[of_sample]
    rows, which, dam = rows[kept], which[kept], of_sample[kept]
    scales = _both_ways(runs.factor[rows])
    several = [blocks[place] for place in dam.tolist()] if blocks else []
    all_rows = Rows(numbers[dam], several, which.astype(np.int64), scales, None if moves is None else moves[dam])
    limits = None if blocks else limits_of(plan.case)
    with results.timed("kernel"):
        table = run_rows(all_rows, earthquakes, limits, threads)
    width = crack_widths(numbers[dam])
    named = with_openings(headlines(table), plan.case, width)
    if moves is not None:
        gravity = values.get("gravity", np.full(samples.size, plan.case.gravity))[dam]
        named |= dict(
            zip(CREST_PEAKS, (table["crest_displacement"], table["crest_acceleration"] / gravity), strict=True)
        )
    outcome = _outcomes(plan.case, table, width)
    results.put(rows, outcome, _of_table(table, width, named))
    # Bounces may amplify the last digit: twins show it.
    bouncy = (numbers[dam, _RESTITUTION] >= BOUNCY) & (outcome == Outcome.OK) & (table["impacts"] > 0.0)
    again = np.flatnonzero(bouncy)
    if again.size:
        with results.timed("kernel"):
            twins = run_rows(all_rows.twins(again, 1.0 + HAIR), earthquakes, limits, threads)
        results.undetermined[rows[again]] = ~determined(table["slip"][again], twins["slip"])


def _crest_moves(plan: Plan, values: Mapping[str, NDArray[Any]], blocks: Sequence[Block], count: int) -> Floats:
    """Return how far slip and gaps move the crests of some dams, (dams, 3)."""
    if blocks:
        return np.array([crest_moves(block.case) for block in blocks])
    if values.keys() <= set(COLUMNS):
        return sound_vectors(plan.case, values, crest_moves)
    cases = _cases(plan, values, count)
    return np.array([np.full(3, np.nan) if case is None else crest_moves(case) for case in cases])


def _outcomes(case: Case, table: Mapping[str, Floats], width: Floats) -> Words:
    """Return how the rows of a table of blocks on cracks of these widths [m] ended."""
    words = np.array(OUTCOMES, dtype=object)[table["outcome"].astype(np.int64)]
    return outcomes_of(words, [table], [width], finite=case.analysis.rotation == "finite")


def _two_blocks(plan: Plan, runs: Runs, rows: Integers, results: PartResults, threads: int) -> None:
    from heeltoe.models.rigid.stack import run_two_blocks

    samples, values, of_sample = _dams(runs, rows)
    with results.timed("blocks"):
        dams = list(_cases(plan, values, samples.size))

    def run(row: int, case: Case | None) -> tuple[Response, bool] | None:
        if case is None:
            return None
        ground = plan.earthquakes[runs.motion[row]].scaled(float(runs.factor[row]))

        def through(earthquake: Earthquake) -> Response:
            return run_two_blocks(case, earthquake, ground.end, crest=plan.crest)

        try:
            ran = block_until_rest(through, lambda ran: ran, ground, case.analysis.silence)
            result = with_outcome(*ran)
            return result, twin_of(case, result, through, ground) is not None
        except InputError:
            return None

    # The kernel lets go of the interpreter.
    with results.timed("kernel"), ThreadPoolExecutor(threads or os.cpu_count()) as pool:
        ran = list(pool.map(run, rows.tolist(), [dams[sample] for sample in of_sample.tolist()]))
    done = [(row, *result) for row, result in zip(rows.tolist(), ran, strict=True) if result is not None]
    if done:
        places = np.array([row for row, _, _ in done])
        results.put(places, *_ran([response for _, response, _ in done]))
        results.undetermined[places] = [undetermined for _, _, undetermined in done]


def _ran(responses: Sequence[Response]) -> Ran:
    """Return what some responses say."""
    outcome = np.array([response.outcome for response in responses], dtype=object)
    cracks = [_of_responses(responses, place) for place in range(len(responses[0].cracks))]
    return _led(outcome, cracks)


def _led(outcome: Words, cracks: Sequence[OfCrack]) -> Ran:
    """Return how runs ended, with the numbers of the crack that leads in each, and of several cracks those of
    all."""
    if len(cracks) == 1:
        return outcome, cracks[0], ()
    leads = _judged(outcome, cracks).governing_crack
    places = np.arange(leads.size)

    def chosen(columns: Sequence[Floats]) -> Floats:
        return np.asarray(np.stack(columns)[leads, places])

    named = {name: chosen([crack.named[name] for crack in cracks]) for name in cracks[0].named}
    return outcome, OfCrack(named, chosen([crack.width for crack in cracks])), cracks


def _dams(runs: Runs, rows: Integers) -> tuple[Integers, dict[str, NDArray[Any]], Integers]:
    """Return the dams of some rows, the values of their fields, and which of them each row has."""
    samples, first, of_sample = np.unique(runs.sample[rows], return_index=True, return_inverse=True)
    return samples, {path: column[rows][first] for path, column in runs.values.items()}, of_sample


def _blocks(
    plan: Plan, values: Mapping[str, NDArray[Any]], count: int, *, across: bool
) -> tuple[Floats, list[Block], NDArray[np.bool_]]:
    """Return the numbers of the blocks of some dams, the blocks where something varies as they move or the ground
    shakes them `across` the valley, and which of the dams there are: the others are refused, and what stands in their
    places says nothing."""
    sound = np.ones(count, dtype=bool)
    if values and not across and not by_itself(plan.case) and values.keys() <= set(COLUMNS):
        numbers, sound = sound_blocks(plan.case, values)
        return numbers, [], sound
    numbers = np.zeros((count, len(BLOCK)))
    blocks: list[Block] = []
    some = build_block(plan.case)
    for place, case in enumerate(_cases(plan, values, count)):
        try:
            if case is not None and across:
                check_across(case)
            block = None if case is None else build_block(case)
        except InputError:
            block = None
        if block is None:
            sound[place], block = False, some
        numbers[place] = block.parameters()
        blocks.append(block)
    alone = across or any(by_itself(block.case) for block in blocks)
    return numbers, blocks if alone else [], sound


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


def _elastic(
    plan: Plan, runs: Runs, rows: Integers, results: PartResults, run: Callable[[Case, int, Floats], Ran]
) -> None:
    """Run dam by dam, and motion by motion: what is built for one of them serves all its strengths."""
    samples, values, of_sample = _dams(runs, rows)
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
            results.put(here, *ran)


def _flexible(plan: Plan, runs: Runs, rows: Integers, results: PartResults, threads: int) -> None:
    from heeltoe.models.drain_closure import drained, follows_drains
    from heeltoe.models.flexible.model import Rested, rest_of
    from heeltoe.models.flexible.run.dam_runner import ShakenDam

    def run(case: Case, motion: int, scales: Floats) -> Ran:
        ground, made = plan.earthquakes[motion], plan.pilot_of(motion)
        pilot = made or plan.pilot
        # Its evidence is that of the pilot.
        case = pilot.refined(case) if pilot else case.without_evidence()
        with results.timed("blocks"):
            rest = rest_of(case, ground, step_of=pilot.step_of if pilot else ShakenDam.first_step)

        def through(factor: float) -> Rested:
            shaken = ground.scaled(factor)
            if made is not None:
                # At a coarser mesh it may take another silence.
                shaken = shaken.silent(made.silence_s)
            return drained(case, shaken, rest)[0] if follows_drains(case, shaken) else rest(shaken)

        # The kernel lets go of the interpreter.
        with results.timed("kernel"), ThreadPoolExecutor(threads or os.cpu_count()) as pool:
            ran = list(pool.map(through, scales.tolist()))
        dam = ran[0].shaken.dam
        cracks = []
        peaks = [crest_peaks(rested.crest(case)) for rested in ran] if plan.crest else []
        crest = {name: np.array([row[name] for row in peaks]) for name in CREST_PEAKS if peaks}
        for place, section in enumerate(dam.sections):
            summaries = [rested.run.summaries[place].by_name() for rested in ran]
            table = {name: np.array([row[name] for row in summaries]) for name in summaries[0]}
            named = headlines(table) | crest
            if made is not None and made.means:
                named |= {name: np.full(scales.size, mean) for name, mean in made.means[place].items()}
            cracks.append(
                _of_table(
                    table, np.full(scales.size, section.crack_width), named, joint=dam.lines[place].bond is not None
                )
            )
        outcome = np.array([rested.outcome for rested in ran], dtype=object)
        return _led(outcome, cracks)

    _elastic(plan, runs, rows, results, run)


def _decoupled(plan: Plan, runs: Runs, rows: Integers, results: PartResults, threads: int) -> None:
    from heeltoe.models.decoupled.model import crack_earthquake

    def run(case: Case, motion: int, scales: Floats) -> Ran:
        ground, at_crack = plan.earthquakes[motion], dict[float, Earthquake]()
        with results.timed("blocks"):
            block = build_block(case)

        def through(factor: float) -> Response:
            def run(earthquake: Earthquake) -> Response:
                # The part below is linear: its motion grows as the ground's does.
                if earthquake.silence not in at_crack:
                    at_crack[earthquake.silence] = crack_earthquake(case, earthquake)
                felt = at_crack[earthquake.silence].scaled(factor)
                return replace(run_rigid(case, felt, ground.end, block, crest=False), silence_s=earthquake.silence)

            return with_outcome(*block_until_rest(run, lambda ran: ran, ground, case.analysis.silence, swings=True))

        with results.timed("kernel"):
            return _ran([through(factor) for factor in scales.tolist()])

    _elastic(plan, runs, rows, results, run)


_MODELS: dict[str, Callable[[Plan, Runs, Integers, PartResults, int], None]] = {
    "rigid": _rigid,
    "decoupled": _decoupled,
    "flexible": _flexible,
}


def _both_ways(factor: Floats) -> Floats:
    return np.column_stack([factor, factor])


def _table(plan: Plan, runs: Runs, results: PartResults) -> pa.Table:
    """Return the runs with their results, as they are stored."""
    names = [shake.name for shake in plan.shakes]
    events = [plan.events[shake.event] for shake in plan.shakes]
    turned = np.array([shake.turned for shake in plan.shakes])

    def words(values: Any) -> pa.Array:
        return pa.array(values, type=pa.string()).dictionary_encode()

    def named(names: Sequence[str], places: Integers) -> pa.Array:
        # The words in the order in which they come first, as :func:`words` has them.
        places = np.unique(names, return_inverse=True)[1][places]
        used, first, place = np.unique(places, return_index=True, return_inverse=True)
        order = np.argsort(first)
        indices = pa.array(np.argsort(order)[place], type=pa.int32())
        known = np.unique(names)[used[order]].tolist()
        return pa.DictionaryArray.from_arrays(indices, pa.array(known, type=pa.string()))

    columns: dict[str, Any] = {
        "run": pa.array(runs.number),
        "sample": pa.array(runs.sample),
        "model": named(plan.study.model, runs.model),
        "event": named(events, runs.motion),
        "motion": named(names, runs.motion),
        "reversed": pa.array(turned[runs.motion]),
        "factor": pa.array(runs.factor),
    }
    for axis in plan.axes:
        column = runs.values[axis.path]
        columns[axis.path] = pa.array(column) if axis.quantity is not None else words([str(value) for value in column])
    columns["outcome"] = words(results.outcome)
    for name, values in results.numbers.items():
        columns[name] = pa.array(values, mask=np.isnan(values))
    columns["impacts"] = pa.array(results.impacts)
    columns["slid_off"] = pa.array(results.slid_off)
    columns["undetermined"] = pa.array(results.undetermined)
    return pa.table(columns)
