"""What of a study is computed: never in the process of the server."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from heeltoe.app.bundle import Sent, copied, lay_out, zipped
from heeltoe.app.live import refused
from heeltoe.case.written import toml_text
from heeltoe.errors import InputError
from heeltoe.study.file import Study, read_study

if TYPE_CHECKING:
    from heeltoe.study.plan import Plan
    from heeltoe.study.run import Progress

STUDY, OUT = "study.toml", "study"
_CORES = os.cpu_count() or 1
Fields = dict[str, Any]
# The case, a study as its file has it, and the files that were sent, of which the last names some.
Asked = tuple[Fields, Fields, Sent]
_HEAD = "# A study for heeltoe: many runs of the dam in case.toml."


def lay_study(case: Fields, study: Fields, sent: Sent, folder: Path) -> Study:
    """Write a study with its case and its records into a folder that has none, and read it.

    Raises
    ------
    InputError
        Where something in it cannot be used.
    """
    shutil.rmtree(folder, ignore_errors=True)
    lay_out(case, sent, folder)
    events = study.get("motions", {}).get("events", ())
    wanted = [name for event in events for name in (*event["horizontal"], event.get("vertical"))]
    names = {name: copied(sent[name], name, folder) for name in dict.fromkeys(wanted) if name in sent}
    for event in events:
        event["horizontal"] = [names.get(each, each) for each in event["horizontal"]]
        if "vertical" in event:
            event["vertical"] = names.get(event["vertical"], event["vertical"])
    (folder / STUDY).write_text(toml_text(study, Study, _HEAD), encoding="utf-8")
    return read_study(folder / STUDY)


def look(asked: Asked, folder: Path, most: int) -> dict[str, Any]:
    """Return how many runs a study has and about how long they take, or what is wrong with it."""
    try:
        return {"outlook": _outlook(_laid(asked, folder, most))}
    except InputError as error:
        return refused(error)


def lay(asked: Asked, folder: Path, most: int) -> None:
    """Write a study into a folder, where it waits for being run.

    Raises
    ------
    InputError
        Where it cannot run, or has more runs than that.
    """
    _laid(asked, folder, most)


def _laid(asked: Asked, folder: Path, most: int) -> Plan:
    from heeltoe.study.plan import plan_of

    plan = plan_of(lay_study(*asked, folder))
    if plan.count > most:
        raise InputError("study-many", "study", f"{plan.count:,} runs", most=f"{most:,}")
    return plan


def _outlook(plan: Plan) -> str:
    """Say what a study will be; runs that take long to try are estimated as a single one is."""
    from heeltoe.models.flexible.expected import analysing, frame_step_of
    from heeltoe.study.run import Outlook, outlook
    from heeltoe.views.terminal.study import outlook_text

    if "flexible" not in plan.study.model:
        return outlook_text(outlook(plan, _CORES))
    case = plan.case.model_copy(update={"flexible": plan.case.flexible.with_evidence("none")})
    end = plan.earthquakes[0].run_end
    cost = analysing(case, end, frame_step_of(end, None))
    return outlook_text(Outlook(plan, cost.seconds / len(plan.study.model), _CORES))


def run(say: Callable[..., None], folder: Path, resume: bool, units: str) -> dict[str, Any]:
    """Run a study, or what is left of it, and write what it says."""
    from heeltoe.study.run import run_study
    from heeltoe.views.terminal.study import outlook_text, progress_text

    def told(progress: Progress) -> None:
        done = f"{progress.done:,} of {progress.of:,} runs, {progress_text(progress)}"
        say(done, progress.done / progress.of)

    say("reading the study")
    there = (folder / OUT / "study.json").exists()
    run_study(
        folder / STUDY,
        folder / OUT,
        resume=resume and there,
        progress=told,
        before=lambda expected: say(outlook_text(expected)),
    )
    say("drawing what it says", 1.0)
    answers(folder, units)
    return {}


def answers(folder: Path, units: str) -> dict[str, Any]:
    """Return what a study says, as far as it has come, and keep it beside its runs."""
    from heeltoe.app.studies.told import told_document
    from heeltoe.study.opened import open_study
    from heeltoe.views.report.study import study_document, study_subject

    try:
        found = open_study(folder / OUT)
        subject = study_subject(found, folder, units, command(), None)
    except InputError as error:
        return refused(error)
    said = {"complete": found.complete, **told_document(study_document(subject))}
    if found.complete:
        text = json.dumps(said, allow_nan=False)
        fresh = folder / f"answers-{units}.fresh"
        fresh.write_text(text, encoding="utf-8")
        fresh.replace(folder / f"answers-{units}.json")
    return said


def kept_answers(folder: Path, units: str) -> dict[str, Any] | None:
    """Return what a study has said in these units; None where that is not there."""
    try:
        found: dict[str, Any] = json.loads((folder / f"answers-{units}.json").read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    return found


def command() -> str:
    """Return what is typed to do the same."""
    return f"heeltoe study {STUDY} --out {OUT} --report"


def packed(folder: Path, what: str, units: str) -> tuple[Path, str]:
    """Write something to take away of a study, and return where it is and what it is called.

    Parameters
    ----------
    folder
        Of the study.
    what
        ``"study"`` for all of it, ``"csv"`` for a table of its runs, ``"pdf"`` or ``"html"`` for its report.
    units
        Of the report and its figures.
    """
    from heeltoe.study.opened import open_study
    from heeltoe.views.files.write import write_study
    from heeltoe.views.report.write import check_packages, write_study_report

    found = open_study(folder / OUT)
    if what == "csv":
        return _csv(found, folder), "runs.csv"
    if what == "study":
        write_study(found, folder / OUT, units)
        aside = ("runs.csv", "study.zip", "answers-si.json", "answers-us.json")
        return zipped(folder, folder / "study.zip", without=aside), "study.zip"
    check_packages((what,), "report")
    aside_ = folder / "report"
    shutil.rmtree(aside_, ignore_errors=True)
    aside_.mkdir()
    write_study_report(found, aside_, base=folder, units=units, command=command())
    return aside_ / f"report.{what}", f"study-report.{what}"


def _csv(found: Any, folder: Path) -> Path:
    """Write the runs as a table, a part at a time."""
    import pyarrow as pa
    import pyarrow.csv

    path, writer = folder / "runs.csv", None
    try:
        for batch in found.batches():
            plain = pa.table(
                {
                    name: column.cast(pa.string()) if pa.types.is_dictionary(column.type) else column
                    for name, column in zip(batch.schema.names, batch.columns, strict=True)
                }
            )
            writer = writer or pyarrow.csv.CSVWriter(path, plain.schema)
            writer.write_table(plain)
    finally:
        if writer is not None:
            writer.close()
    return path
