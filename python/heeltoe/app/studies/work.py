"""Computation of a study, never in the process of the server, and its report as plain blocks for the page."""

from __future__ import annotations

import base64
import copy
import json
import os
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from heeltoe.app.case.files import Sent, copied, lay_out, zipped
from heeltoe.app.live import refused
from heeltoe.base.payload import Json
from heeltoe.case.toml_writer import toml_text
from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import harmless
from heeltoe.motion.records.formats.columns import ASKS_FOR_LAYOUT
from heeltoe.study.plan.components import CHANNEL
from heeltoe.study.plan.file import Study, read_study
from heeltoe.views.content.tree import (
    Block,
    Code,
    Document,
    FigureBlock,
    Inline,
    Listing,
    Notes,
    Paragraph,
    Section,
    Strong,
    Symbol,
    Table,
)
from heeltoe.views.words.numbers import Value

if TYPE_CHECKING:
    from heeltoe.study.answers.suite import SuiteAnswer
    from heeltoe.study.plan.plan import Plan
    from heeltoe.study.run.run import Progress

STUDY, OUT = "study.toml", "study"
_CORES = os.cpu_count() or 1
# Where a form asks for what a record does not state, by the code of the error.
_UNSTATED = {
    "record-unit-missing": "motions.unit",
    "record-step-missing": "motions.time_step",
    "record-factor-of-several": "motions.factor",
    "record-uncorrected": "motions.processing",
    **dict.fromkeys(ASKS_FOR_LAYOUT, "motions.layout"),
}
Fields = dict[str, Any]
# The case, a study as its file has it, and the files that were sent, of which the last names some.
StudyRequest = tuple[Fields, Fields, Sent]
_HEAD = "# A study for heeltoe: many runs of the dam in case.toml."


def lay_study(case: Fields, study: Fields, sent: Sent, folder: Path) -> Study:
    """Write a study with its case and its records into a new folder, and read it.

    Raises
    ------
    InputError
        Where something in it cannot be used.
    """
    shutil.rmtree(folder, ignore_errors=True)
    lay_out(case, sent, folder, listed=False)
    events = study.get("motions", {}).get("events", ())
    names_of_records = [name for event in events for name in (*event["horizontal"], event.get("vertical"))]
    copies, names = dict[str, str](), dict[str, str]()
    for name in dict.fromkeys(names_of_records):
        file, sign, channel = (name, "", "") if name in sent else str(name).rpartition(CHANNEL)
        if file in sent:
            copies[file] = copies.get(file) or copied(sent[file], file, folder)
            names[name] = f"{copies[file]}{sign}{channel}"
    for event in events:
        event["horizontal"] = [names.get(name, name) for name in event["horizontal"]]
        if "vertical" in event:
            event["vertical"] = names.get(event["vertical"], event["vertical"])
    (folder / STUDY).write_text(toml_text(study, Study, _HEAD), encoding="utf-8")
    return read_study(folder / STUDY)


def look(request: StudyRequest, folder: Path, limit: int) -> Json:
    """Return how many runs a study has and about how long they take, or what is wrong with it."""
    case, study, sent = request
    try:
        # What is laid out has other names of records.
        return {"outlook": _outlook(_laid((case, copy.deepcopy(study), sent), folder, limit))}
    except InputError as error:
        return refused(error) if error.code not in _UNSTATED else _asked(request, folder, limit, error)


def _asked(request: StudyRequest, folder: Path, limit: int, error: InputError) -> Json:
    """Return the question for a missing entry of a record, at its field; for unit and time step at once where both are
    missing."""
    (case, study, sent), record = request, error.field
    error.field = _UNSTATED[error.code]
    if error.code == "record-step-missing":
        stepped = {**study, "motions": {**study["motions"], "time_step": "0.01 s"}}
        try:
            _laid((case, stepped, sent), folder, limit)
        except InputError as second:
            if second.code == "record-unit-missing":
                problem = f"{record} states neither its unit nor its time step"
                remedy = "give both here, as they hold for all records that do not state them"
                field, text = _UNSTATED[second.code], f"{problem}; {remedy}"
                return {"error": {"field": field, "text": text, "problem": problem, "remedy": remedy}}
    return refused(error)


def lay(request: StudyRequest, folder: Path, limit: int) -> None:
    """Write a study into a folder, where it waits for being run.

    Raises
    ------
    InputError
        Where it cannot run, or has more runs than that.
    """
    _laid(request, folder, limit)


def _laid(request: StudyRequest, folder: Path, limit: int) -> Plan:
    from heeltoe.study.plan.plan import plan_of

    plan = plan_of(lay_study(*request, folder))
    if plan.count > limit:
        raise InputError("too-many", "study", f"{plan.count:,} runs", most=f"{limit:,}")
    return plan


def _outlook(plan: Plan) -> str:
    """Say what a study will be."""
    from heeltoe.study.run.run import quick_outlook
    from heeltoe.views.terminal.study import outlook_text

    return outlook_text(quick_outlook(plan, _CORES))


def run(say: Callable[..., None], folder: Path, resume: bool, units: str) -> Json:
    """Run a study, or what is left of it, and write what it says."""
    from heeltoe.study.run.run import run_study
    from heeltoe.views.terminal.study import outlook_text, progress_text

    def show_progress(progress: Progress) -> None:
        done = f"{progress.done:,} of {progress.of:,} runs, {progress_text(progress)}"
        say(done, progress.done / progress.of)

    fine = "; elastic dams are first run with their evidence, for mesh and step"
    say("reading the study" + fine * ("flexible" in read_study(folder / STUDY).model))
    started = (folder / OUT / "study.json").exists()
    run_study(
        folder / STUDY,
        folder / OUT,
        resume=resume and started,
        progress=show_progress,
        before=lambda expected: say(outlook_text(expected)),
    )
    say("drawing what it says", 1.0)
    answers(folder, units)
    return {}


def answers(folder: Path, units: str) -> Json:
    """Return what a study says, as far as it has come, and keep it beside its runs."""
    from heeltoe.study.answers.study_results import open_study
    from heeltoe.views.content.study import study_document, study_subject

    try:
        results = open_study(folder / OUT)
        subject = study_subject(results, folder, units, command(), None)
    except InputError as error:
        return refused(error)
    headlines = _headlines(results.suite, units)
    payload = {"complete": results.complete, "headlines": headlines, **document_payload(study_document(subject))}
    if results.complete:
        text = json.dumps(payload, allow_nan=False)
        fresh = folder / f"answers-{units}.fresh"
        fresh.write_text(text, encoding="utf-8")
        fresh.replace(folder / f"answers-{units}.json")
    return payload


def _headlines(suite: SuiteAnswer | None, units: str) -> list[Json]:
    """Return what a reader looks for first in a suite, model by model: the number that is judged, and its limit."""
    from heeltoe.app.response_payload import judged
    from heeltoe.result.contract import RESIDUAL_SLIP
    from heeltoe.views.words.studies import JUDGED

    headlines = list[dict[str, Any]]()
    if suite is None:
        return headlines
    for row in suite.models:
        slip, by = row.statistics[RESIDUAL_SLIP.key][suite.judge], JUDGED[suite.judge]
        if slip is None or any(check.value is None for check in row.limits):
            why = "in every record: the dam fails, or a run has none"
            headline: Json = {"value": "No result", "label": why, "limit": "", "state": "failed", "limits": []}
        else:
            headline = judged(row.limits, slip, "residual slip", units, f", {by}")
        headlines.append({"model": row.model, **headline})
    return headlines


def kept_answers(folder: Path, units: str) -> Json | None:
    """Return the stored answer of a study in these units; None without one."""
    try:
        payload: Json = json.loads((folder / f"answers-{units}.json").read_text(encoding="utf-8"))
    except FileNotFoundError:
        return None
    return payload


def command() -> str:
    """Return what is typed to do the same."""
    return f"heeltoe study {STUDY} --out {OUT} --report"


def packed(folder: Path, what: str, units: str) -> tuple[Path, str]:
    """Write an export of a study, and return where it is and what it is called.

    Parameters
    ----------
    folder
        Of the study.
    what
        ``"study"`` for all of it, ``"csv"`` for a table of its runs, ``"pdf"`` or ``"html"`` for its report.
    units
        Of the report and its figures.
    """
    from heeltoe.study.answers.study_results import open_study
    from heeltoe.views.files.write import write_study
    from heeltoe.views.report.write import check_packages, write_study_report

    results = open_study(folder / OUT)
    if what == "csv":
        return _csv(results, folder), "runs.csv"
    if what == "study":
        write_study(results, folder / OUT, units)
        aside = ("runs.csv", "study.zip", "answers-si.json", "answers-us.json")
        return zipped(folder, folder / "study.zip", without=aside), "study.zip"
    check_packages((what,), "report")
    aside_ = folder / "report"
    shutil.rmtree(aside_, ignore_errors=True)
    aside_.mkdir()
    write_study_report(results, aside_, base=folder, units=units, command=command())
    return aside_ / f"report.{what}", f"study-report.{what}"


def _csv(results: Any, folder: Path) -> Path:
    """Write the runs as a table, a part at a time."""
    import pyarrow as pa
    import pyarrow.csv

    path, writer = folder / "runs.csv", None
    try:
        for batch in results.batches():
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


def document_payload(document: Document) -> Json:
    """Return a document; what a page does not show, as references and appendices, is left out."""
    return {"title": document.title, "subtitle": document.subtitle, "blocks": _blocks(document.blocks)}


def _blocks(blocks: tuple[Block, ...]) -> list[Json]:
    return [content for content in map(_block, blocks) if content]


def _block(block: Block) -> Json:
    if isinstance(block, Section):
        if block.title.startswith("Appendix"):
            return {}
        inner = _blocks(block.blocks)
        return {"kind": "section", "title": block.title, "blocks": inner} if inner else {}
    if isinstance(block, Paragraph):
        return {"kind": "paragraph", "parts": _parts(block.parts)}
    if isinstance(block, Notes):
        items = [_parts(item) for item in block.items]
        return {"kind": "notes", "grave": block.kind, "title": block.title, "items": items}
    if isinstance(block, Table):
        rows = [[_parts((cell,)) for cell in row] for row in block.rows]
        return {"kind": "table", "head": list(block.head), "rows": rows, "caption": block.caption, "align": block.align}
    if isinstance(block, FigureBlock):
        data = base64.b64encode(block.svg).decode("ascii")
        return {
            "kind": "figure",
            "name": block.name,
            "caption": block.caption,
            "svg": data,
            "width": block.size[0],
        }
    if isinstance(block, Listing):
        return {"kind": "listing", "text": block.text}
    return {}


def _parts(parts: tuple[Inline, ...]) -> list[dict[str, str]]:
    return [_part(part) for part in parts]


def _part(part: Inline) -> dict[str, str]:
    if isinstance(part, Code | Strong):
        return {"as": "code" if isinstance(part, Code) else "strong", "text": harmless(part.text)}
    if isinstance(part, Symbol):
        return {"as": "", "text": part.letter + part.index}
    return {"as": "", "text": part.text if isinstance(part, Value) else harmless(part)}
