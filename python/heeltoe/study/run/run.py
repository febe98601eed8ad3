"""Run a study from its file to its table."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
import pyarrow as pa

from heeltoe.base.cache import Kept
from heeltoe.case.model import Case
from heeltoe.errors.error import InputError
from heeltoe.mechanics.block import build_block
from heeltoe.models.cost import Cost, block_cost
from heeltoe.models.flexible.evidence.evidence import trusted
from heeltoe.models.flexible.evidence.refinement import Answer
from heeltoe.models.flexible.model import answer_at_rest
from heeltoe.models.flexible.run.expected import analysing, frame_step_of
from heeltoe.motion.earthquake import Earthquake
from heeltoe.result.judge import leading_crack
from heeltoe.result.outcome import Outcome
from heeltoe.study.answers.study_results import StudyResults, open_study
from heeltoe.study.plan.file import Study, read_study
from heeltoe.study.plan.plan import Pilot, Plan, plan_of
from heeltoe.study.run.batches import SECONDS, columns_of, run_part
from heeltoe.study.run.record import MOST_OF_PART, STUDY
from heeltoe.study.run.schedule import check_workers, run_here, run_on_workers
from heeltoe.study.run.store import Store, begin, keep_questions, keep_seconds, pilot_of

#: Seconds that a part should take a worker: long beside what it costs to hand one out, short beside a patient wait.
_SECONDS = 2.0
#: Runs that are tried to know how long all will take.
_TRIED = 200
#: The same of elastic dams, and the seconds after which no other one is tried; so far apart they lie evenly.
_TRIED_ELASTIC, _PATIENCE = 8, 5.0
#: Runs of elastic dams that are tried while somebody waits are estimated to take less [s].
_SHORT = 2.0
#: Until worker processes run, on two idle cores [s].
_START = 3.0
#: How much slower than estimated runs of a dam are on this machine, as it is now.
_SPEEDS: Kept[float] = Kept(16)
#: Bytes that a process takes without its runs.
_PROCESS = 1.5e8
_GOLDEN = 0.6180339887498949


@dataclass(frozen=True)
class Progress:
    """How far a study is.

    Attributes
    ----------
    done, of
        Runs, those that were there before among them.
    failed
        Of those made now, the ones without a result.
    rate
        Runs a second, of those made now.
    """

    done: int
    of: int
    failed: int
    rate: float

    @property
    def left(self) -> float:
        """Seconds to go."""
        return (self.of - self.done) / self.rate if self.rate > 0.0 else float("inf")


@dataclass(frozen=True, eq=False)
class Outlook:
    """Expected size of a study, before it runs.

    Attributes
    ----------
    plan
        The study.
    seconds_per_run
        On one core, as tried on a few.
    cores
        That will run it.
    before
        Seconds until the first of them runs: the run with evidence where it is still to come, and worker processes.
    memory
        That all of its processes take together, estimated [B].
    """

    plan: Plan
    seconds_per_run: float
    cores: int
    before: float = 0.0
    memory: float = 0.0

    @property
    def cost(self) -> Cost:
        """Time and memory of all."""
        return Cost(self.seconds, self.memory)

    @property
    def seconds(self) -> float:
        """About how long it will take."""
        return self.before + self.plan.count * self.seconds_per_run / self.cores

    def to_json(self) -> dict[str, Any]:
        """Return it as a dry run tells it."""
        dams, motions, strengths, models = self.plan.sizes
        return {
            "title": self.plan.study.title,
            "runs": self.plan.count,
            "dams": dams,
            "motions_of_each": motions,
            "strengths_of_each": strengths,
            "models": models,
            "motions": len(self.plan.shakes),
            "events": len(self.plan.events),
            "seconds_per_run": self.seconds_per_run,
            "cores": self.cores,
            "seconds": self.seconds,
            "fingerprint": self.plan.fingerprint,
        }

    @property
    def size(self) -> int:
        """How many runs make a part: whole dams where that is possible, so that what is built for one is built once."""
        count = int(np.clip(_SECONDS / max(self.seconds_per_run, 1e-9), 1, MOST_OF_PART))
        for together in (self.plan.count // self.plan.samples.count, self.plan.sizes[2] * self.plan.sizes[3]):
            if together <= max(4 * count, 8) and together <= MOST_OF_PART:
                return max(1, count // together) * together
        return count


def outlook(study: Study | Plan, cores: int) -> Outlook:
    """Say how many runs there are and about how long they take, by trying some.

    Raises
    ------
    InputError
        Where the study cannot run.
    """
    plan = study if isinstance(study, Plan) else plan_of(study)
    run_part(plan, 0, min(plan.count, 1))  # what is loaded at first use is not counted
    began, count = monotonic(), 0
    for start, stop in _tries(plan):
        run_part(plan, start, stop)
        count += stop - start
        if monotonic() - began > _PATIENCE:
            break
    return _outlook(plan, (monotonic() - began) / count, cores)


def estimated_outlook(plan: Plan, cores: int) -> Outlook:
    """As :func:`outlook`, without a run."""
    dam, ends = plan.case.without_evidence(), {quake.run_end: quake for quake in plan.earthquakes}
    costs = [_run_cost(dam, model, quake) for model in plan.study.model for quake in ends.values()]
    return _outlook(plan, sum(cost.seconds for cost in costs) / len(costs), cores)


def _run_cost(case: Case, model: str, quake: Earthquake) -> Cost:
    if model == "flexible":
        return analysing(case, quake.run_end, frame_step_of(quake.run_end, None))
    return block_cost(model, quake.run_end, quake.motion.time.size)


def quick_outlook(plan: Plan, cores: int) -> Outlook:
    """As :func:`outlook`, for someone who changes the study while it is counted: of elastic dams one run of each dam is
    tried, if it is short, and says how much slower than estimated this machine is; the rest is estimated."""
    if "flexible" not in plan.study.model:
        return outlook(plan, cores)
    models, case = plan.sizes[3], plan.case.without_evidence()
    ends = [earthquake.run_end for earthquake in plan.earthquakes]
    costs = {end: analysing(case, end, frame_step_of(end, None)).seconds for end in set(ends)}
    first = costs[ends[int(plan.runs(0, 1).motion[0])]]

    def slower() -> float:
        run_part(plan, 0, models)  # what is loaded at first use is not counted
        began = monotonic()
        run_part(plan, 0, models)
        return (monotonic() - began) / first

    speed = _SPEEDS.get(case.model_dump_json(exclude={"motion"}), slower) if first < _SHORT else 1.0
    return _outlook(plan, speed * float(np.mean([costs[end] for end in ends])) / models, cores)


def _outlook(plan: Plan, seconds_per_run: float, cores: int) -> Outlook:
    """Return an outlook with the work before the runs."""
    before = 0.0 if _alone(plan, None) else _START
    if "flexible" in plan.study.model and plan.pilot is None:
        middle = plan.shakes[int(plan.runs(plan.count // 2, plan.count // 2 + 1).motion[0])]
        signs = sum(shake.horizontal is middle.horizontal for shake in plan.shakes)
        end = plan.earthquakes[0].run_end
        whole, alone = (
            analysing(case, end, frame_step_of(end, None)).seconds for case in (plan.case, plan.case.without_evidence())
        )
        before += signs * seconds_per_run * plan.sizes[3] * whole / alone
    longest = max(plan.earthquakes, key=lambda quake: quake.run_end)
    alone = max(_run_cost(plan.case, model, longest).memory for model in plan.study.model)
    return Outlook(plan, seconds_per_run, cores, before, _PROCESS + cores * (alone + (_PROCESS if before else 0.0)))


def _tries(plan: Plan) -> Iterator[tuple[int, int]]:
    """Walk stretches of representative runs. Runs of elastic dams depend on the length of the motion and on
    whether the dam is at rest at its end, so a few from all over the study are tried; blocks many at once."""
    models = plan.sizes[3]
    if set(plan.study.model) == {"rigid"}:
        yield 0, min(plan.count, _TRIED)
        return
    places = plan.count // models
    for place in dict.fromkeys(int((k * _GOLDEN % 1.0) * places) for k in range(1, _TRIED_ELASTIC + 1)):
        yield place * models, (place + 1) * models


def run_study(
    source: Study | str | PathLike[str],
    out: str | PathLike[str],
    *,
    case: Case | None = None,
    resume: bool = False,
    scheduler: str | None = None,
    progress: Callable[[Progress], None] | None = None,
    before: Callable[[Outlook], None] | None = None,
) -> StudyResults:
    """Run a study, or what is left of it.

    Parameters
    ----------
    source
        A study file, or what :func:`heeltoe.read_study` returns.
    out
        Directory of the results; see :mod:`heeltoe.study.run.store`.
    case
        The base case, in the place of that which the study file names.
    resume
        Go on with a study that was begun there.
    scheduler
        Address of a Dask scheduler whose workers run it; without one rigid studies run in this process on all cores,
        others in one worker process for each core. The results are the same bits.
    progress
        Told after each part.
    before
        Told what there will be before anything runs, of elastic dams once more when some have been tried.

    Returns
    -------
    StudyResults
        The results, as :func:`heeltoe.open_study` returns them.

    Raises
    ------
    InputError
        Where the study cannot run, or its results cannot be written.
    """
    study = source if isinstance(source, Study) else read_study(source)
    plan = plan_of(study, case)
    directory = Path(out)
    if not _alone(plan, scheduler):
        check_workers(scheduler)
    store, plan = _begun(plan, directory, resume, before)
    _run(plan, store, scheduler, progress)
    return open_study(directory)


def _alone(plan: Plan, scheduler: str | None) -> bool:
    """Whether this process runs the study by itself."""
    return scheduler is None and set(plan.study.model) == {"rigid"}


def _begun(plan: Plan, directory: Path, resume: bool, before: Callable[[Outlook], None] | None) -> tuple[Store, Plan]:
    """Take up the study where it stands, or begin it."""
    import os

    if (directory / STUDY).exists():
        store = begin(plan, directory, 1, {}, resume=resume)
        keep_questions(directory, plan)
        return store, replace(plan, pilot=pilot_of(directory))
    cores = os.cpu_count() or 1
    if "flexible" in plan.study.model:
        # The run with evidence takes a while by itself.
        if before is not None:
            before(estimated_outlook(plan, cores))
        plan = replace(plan, pilot=pilot_run(plan))
    expected = outlook(plan, cores)
    if before is not None:
        before(expected)
    return begin(plan, directory, expected.size, columns_of(plan), resume=resume), plan


def _run(plan: Plan, store: Store, scheduler: str | None, progress: Callable[[Progress], None] | None) -> None:
    missing = store.missing()
    if not missing:
        return
    parts = [(part, *store.stretch(part)) for part in missing]
    ran = run_here(plan, parts) if _alone(plan, scheduler) else run_on_workers(plan, parts, store.directory, scheduler)
    done = store.count - sum(stop - start for _, start, stop in parts)
    began, made, failed = monotonic(), 0, 0
    seconds: dict[str, float] = {}
    try:
        for part, table in ran:
            taken = json.loads(table.schema.metadata[SECONDS.encode()])
            writing = monotonic()
            store.write(part, table.replace_schema_metadata(None))
            taken["writing"] = monotonic() - writing
            seconds |= {name: seconds.get(name, 0.0) + more for name, more in taken.items()}
            made += len(table)
            failed += _failed(table)
            if progress is not None:
                rate = made / max(monotonic() - began, 1e-9)
                progress(Progress(done + made, store.count, failed, rate))
    finally:
        # What stopped it is the thing to say, not that this could not be written.
        with suppress(InputError):
            keep_seconds(store.directory, seconds)


def _failed(table: pa.Table) -> int:
    counts = table["outcome"].combine_chunks().value_counts().to_pylist()
    return sum(entry["counts"] for entry in counts if not Outcome(entry["values"]).has_result)


def pilot_run(plan: Plan) -> Pilot:
    """Run the base case, in the motion and at the strength in the middle of the study, with the evidence that it asks
    for, and return the mesh and the step that this ends with; of a motion both ways round those of the larger slip."""
    runs = plan.runs(plan.count // 2, plan.count // 2 + 1)
    middle, factor = plan.shakes[int(runs.motion[0])], float(np.median(runs.factor))
    block, answers = build_block(plan.case), dict[int, tuple[Answer, Earthquake]]()
    for place, shake in enumerate(plan.shakes):
        if shake.horizontal is middle.horizontal:
            ground = plan.earthquakes[place].scaled(factor)
            answers[place] = answer_at_rest(plan.case, block, ground, frame_step_of(ground.end, None))
    least, *others = sorted(answers, key=lambda place: max(map(abs, answers[place][0].slips)))
    pilot = _pilot(least, *answers[least], None)
    for motion in others:
        pilot = _pilot(motion, *answers[motion], pilot)
    return pilot


def _pilot(motion: int, response: Answer, ground: Earthquake, other_sign: Pilot | None) -> Pilot:
    """Return what an answer to a motion says of the fineness of the runs, beside that of the other sign."""
    leads = leading_crack(response.slips)
    evidence = response.evidences[leads] if response.evidences else None
    options, first_step = response.shaken.case.flexible, response.shaken.first_step()
    shortest = first_step / 2.0**response.shaken.halvings
    taken_back = evidence is not None and evidence.time_step_s <= shortest < first_step
    scatters = taken_back or any(crack.scatters for crack in response.evidences)
    return Pilot(
        options.elements_across,
        options.elements_across_below,
        shortest if scatters else first_step,
        first_step if evidence is None else evidence.time_step_s,
        ground.silence,
        motion,
        None if evidence is None else evidence.to_json(),
        [trusted(crack) if crack.scatters else {} for crack in response.evidences],
        other_sign,
        options.elements_away,
        scatters,
    )
