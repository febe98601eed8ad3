"""What a run of the elastic dam costs in a study, beside the same run made alone; what engine and storage add."""

from __future__ import annotations

import argparse
import json
import os
import resource
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path
from tempfile import TemporaryDirectory

# The workers of a study use one core each for their matrices; so must what they are compared with.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
import study_million
from measure import Skipped, heading, require, seconds, table

from heeltoe import flexible, read_case, read_study, run_study
from heeltoe.kernel.build import PROFILE
from heeltoe.models.flexible.body import bonded, reduced
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.study.answers.study_results import StudyResults
from heeltoe.study.plan.plan import Pilot, Plan, plan_of
from heeltoe.study.run.batches import run_part
from heeltoe.study.run.run import Outlook

EXAMPLE = Path(__file__).parent.parent / "examples" / "typical-base.toml"
#: Dams and strengths: with 42 motions 504 runs.
FRICTIONS, STRENGTHS = (0.8, 1.0, 1.2), ("0.1 g", "0.2 g", "0.3 g", "0.4 g")
STUDY = """
case = "{case}"
model = "flexible"
[vary]
"crack.friction" = {frictions}
[motions]
events = {events}
pairs = true
both_signs = false
scale = {{ measure = "pga", values = {strengths} }}
"""
#: The records of the study: one folder of components of earthquakes within the records.
RECORDS = "ensemble"


@dataclass(frozen=True)
class Alone:
    """Processor time of runs that are made one by one, each [s], and how often each goes through the kernel."""

    all: float
    kernel: float
    setup: float
    passes: float


def study_file(folder: Path, frictions: tuple[float, ...]) -> Path:
    """Write the study."""
    records = Path(os.environ.get("HEELTOE_RECORDS", "../shared/records")).resolve() / RECORDS
    if not records.is_dir():
        raise Skipped(f"no records in $HEELTOE_RECORDS/{RECORDS}")
    path = folder / "study.toml"
    text = STUDY.format(
        case=EXAMPLE, events=study_million.events(), frictions=list(frictions), strengths=json.dumps(STRENGTHS)
    )
    path.write_text(text, encoding="utf-8")
    return path


def busy() -> float:
    """Return the processor time of this process and of those it has waited for [s]."""
    both = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return sum(item.ru_utime + item.ru_stime for item in both)


def forget() -> None:
    """Let go of all dams that are kept."""
    for module in (bonded, reduced):
        module._KEPT.clear()


def alone(found: StudyResults, plan: Plan) -> Alone:
    """Make some runs of a study by themselves, without evidence, at its mesh."""
    case, pilot = read_case(EXAMPLE), plan.pilot
    whole_steps = pilot is not None and pilot.time_step_s == pilot.first_step_s
    require(whole_steps, "the study has shorter steps: a run alone would not")
    assert pilot is not None
    rows = found.to_table().sort_by("run").to_pylist()
    every = [rows[start + place % (stop - start)] for place, (start, stop) in enumerate(stretches(plan))]
    shakes = {shake.name: shake.horizontal for shake in plan.shakes}

    def make(run: dict[str, float | str]) -> None:
        forget()
        dam = pilot.refined(case.with_({"crack.friction": run["crack.friction"], "motion": None}))
        slip = flexible(dam, shakes[str(run["motion"])].scaled(float(run["factor"]))).residual_slip_m
        same = np.isclose(slip, float(run["residual_slip_m"]), rtol=1e-3, atol=1e-6)
        require(bool(same), "a run of the study is not the one made alone")

    spent: dict[str, list[float]] = {}
    with counted(ShakenDam, "run", spent, "kernel"), counted(reduced, "_build", spent, "set-up"):
        make(every[0])  # what is loaded at first use is not counted
        spent.clear()
        began = time.process_time()
        for run in every:
            make(run)
        whole = time.process_time() - began
    kernel, setup = (sum(spent[key]) / len(every) for key in ("kernel", "set-up"))
    return Alone(whole / len(every), kernel, setup, len(spent["kernel"]) / len(every))


class counted:
    """Keeps the processor time of each call of a function, for a while."""

    def __init__(self, owner: object, name: str, spent: dict[str, list[float]], key: str) -> None:
        self._owner, self._name, self._spent, self._key = owner, name, spent, key
        self._plain: Callable[..., object] = getattr(owner, name)

    def __enter__(self) -> None:
        def timed(*given: object, **named: object) -> object:
            began = time.process_time()
            result = self._plain(*given, **named)
            self._spent.setdefault(self._key, []).append(time.process_time() - began)
            return result

        setattr(self._owner, self._name, timed)

    def __exit__(self, *_: object) -> None:
        setattr(self._owner, self._name, self._plain)


def stretches(plan: Plan) -> list[tuple[int, int]]:
    """Return the runs of each motion at all strengths, with the dams in turn: they stand for the whole study."""
    dams, motions, strengths, _ = plan.sizes
    starts = [(motion % dams * motions + motion) * strengths for motion in range(motions)]
    return [(start, start + strengths) for start in starts]


def in_this_process(plan: Plan) -> float:
    """Return the processor time of a run where nothing hands it out or keeps it [s]."""
    forget()
    run_part(plan, 0, 1)  # what is loaded at first use is not counted
    began = time.process_time()
    count = sum(run_part(plan, *stretch).num_rows for stretch in stretches(plan))
    return (time.process_time() - began) / count


def measure(frictions: tuple[float, ...]) -> list[list[str]]:
    """Run the study, and some of its runs alone, and return the rows of a table."""
    with TemporaryDirectory() as folder:
        file = study_file(Path(folder), frictions)
        expected: list[float] = []
        began, marks = [time.perf_counter()], [busy()]

        def before(told: Outlook) -> None:
            # Once before the first run, and again by how long that took.
            expected[:], began[1:], marks[1:] = [told.seconds], [time.perf_counter()], [busy()]

        study = run_study(file, Path(folder) / "out", before=before)
        began.append(time.perf_counter())
        marks.append(busy())
        count = study.store.count
        require(study.complete and study.all_ok, "some run has no result")
        plan = replace(plan_of(read_study(file)), pilot=Pilot(**study.manifest["pilot"]))
        here = in_this_process(plan)
        single = alone(study, plan)
    ahead, during = ((end - start) / count for start, end in pairwise(marks))
    # The seconds of a study are elapsed ones of its workers, one for each core, as these are.
    _, whole = (end - start for start, end in pairwise(began))
    inside = sum(study.manifest["seconds"][item] for item in ("blocks", "kernel"))
    beside = (os.cpu_count() or 1) * whole / inside - 1.0
    ready = single.kernel + single.setup
    return [
        ["runs of the study", f"{count} in parts of {study.store.size}, {seconds(began[-1] - began[0])}"],
        ["said beforehand", seconds(expected[0])],
        ["a run of the study", seconds(during)],
        ["the same in one process, without engine and storage", seconds(here)],
        ["that much more, as two workers share what cores share", f"{during / here - 1.0:.0%}"],
        ["engine and storage add to the elapsed time of the workers", f"{beside:.0%}"],
        ["evidence of the first run and the tries, for each run", seconds(ahead)],
        ["the same run alone: kernel", f"{seconds(single.kernel)}, in {single.passes:.1f} passes"],
        ["set-up", seconds(single.setup)],
        ["all of `heeltoe.flexible` without evidence", seconds(single.all)],
        ["a run of the study over kernel and set-up of one alone", f"{during / ready:.2f}"],
        ["over set-up and one pass of the kernel", f"{during / (single.kernel / single.passes + single.setup):.2f}"],
    ]


def report(frictions: tuple[float, ...] = FRICTIONS) -> str:
    """Measure and return Markdown."""
    require(PROFILE == "release", "the kernel is a debug build")
    text = (
        "The typical dam with three coefficients of friction, through all components of an ensemble of earthquakes at "
        "four strengths, on the mesh that the evidence of the study's first run asks for. Processor time of all "
        "processes together, the start of the workers and the writing included. A run alone goes through its motion "
        "again, up to twice, where the dam still moves at its end by the strict measure of a result by itself."
    )
    return "\n\n".join(
        [
            heading("Flexible studies", ["heeltoe", "numpy", "scipy", "distributed"]),
            text,
            table(["", "measured"], measure(frictions)),
        ]
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--frictions", type=int, default=len(FRICTIONS), help="how many of the three dams")
    print(report(FRICTIONS[: parser.parse_args().frictions]))
