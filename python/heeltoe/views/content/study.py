"""The report of a study: what was varied, what shook the dams, what came out, and how to run it again."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from heeltoe.errors.error import InputError
from heeltoe.errors.sanitize import plain
from heeltoe.mechanics.references import cited
from heeltoe.result.contract import RESIDUAL_SLIP
from heeltoe.result.outcome import Outcome
from heeltoe.result.verdict import verdict
from heeltoe.study.answers.study_results import StudyResults
from heeltoe.units.parse import STANDARD_GRAVITY
from heeltoe.units.sentences import counted, listed
from heeltoe.units.write import NOTHING, digits
from heeltoe.views.content.dam_pages import dam_pages
from heeltoe.views.content.drawings import drawing
from heeltoe.views.content.input import case_table, named, rerun_section, revisions
from heeltoe.views.content.one_unit import with_one_unit
from heeltoe.views.content.study_answers import (
    answer,
    fragility,
    hangs_on,
    hazard_section,
    measures_compared,
    portfolio,
    portfolio_section,
    results,
)
from heeltoe.views.content.study_subject import StudySubject
from heeltoe.views.content.suite import suite, suite_answer
from heeltoe.views.content.tree import (
    Block,
    Code,
    Document,
    Notes,
    References,
    Section,
    Strong,
    Table,
    paragraph,
    without_gaps,
)
from heeltoe.views.words.fields import shown
from heeltoe.views.words.numbers import Numbers
from heeltoe.views.words.response import NAMES
from heeltoe.views.words.studies import values_phrase

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_CAPTIONS = {
    "section": "Section of the base case with its crack, water levels and the pressure in the crack.",
    "bands": "Values that 16, 50 and 84 % of the runs stay below, by the strength of the motion; runs without a result "
    "count as infinitely far. Thin lines, if any, are single dams in single motions.",
    "fragility": "Shares of the runs that exceed (points, with exact bounds), and fragility curves with what they lie "
    "within (shaded); dotted, where there is no curve, between which strengths half of the dams come to exceed.",
    "slips": "Share of the runs that slide farther than so much.",
    "modes": "Which mode of motion makes most of the slip, in shares of the runs that slide; above the bars how many.",
    "sobol": "Sobol’s indices of the residual slip with their intervals.",
    "tornado": "The mean residual slip by each field alone; the line is the case as it is.",
}
_CAPTIONS |= {
    "suite": "Residual slip of each record, by its worse sign (bar) and the other (mark), with the numbers over all.",
    "hazard": "The hazard curve with the annual rates, dotted what they are at most (left), and how much of each "
    "annual rate motions of each strength make (right); below, if there are several events, the fractiles of the "
    "annual probabilities and the shares that events make.",
    "ranks": "The worst dams of the table: residual slip over the motions, from the median to the 84 % (bar) and the "
    "largest (mark), and the share of the motions in which the first limit is exceeded.",
    "suite-spectra": "Response spectra of the records as they shake the dam, with mean and any target.",
}
_SOURCES = {
    "fragility": ("fragility", "likelihood", "bounds", "clusters"),
    "measures": ("measures",),
    "sensitivity": ("sobol",),
}


def study_subject(
    study: StudyResults, directory: Path, units: str, command: str, figures: Mapping[str, Figure] | None
) -> StudySubject:
    """Gather what a report needs.

    Parameters
    ----------
    study
        The study.
    directory
        Where relative paths of its base case start.
    units
        ``"si"`` or ``"us"``.
    command
        What was typed.
    figures
        Of the study, drawn before; they lose their headings.
    """
    from heeltoe.views.figures.section import section_figure
    from heeltoe.views.figures.studies.all import study_figures

    subject = StudySubject(study, directory, Numbers(study.to_json(), units), {}, command)
    drawn = {
        "section": section_figure(subject.case, units),
        **(study_figures(study, units) if figures is None else figures),
    }
    blocks = {name: drawing(name, figure, _CAPTIONS[name]) for name, figure in drawn.items()}
    # The section stands below its heading, which would be empty without it.
    shown = {name: replace(block, held=name == "section") for name, block in blocks.items()}
    return replace(subject, figures=shown)


def study_answer(study: StudyResults, units: str) -> tuple[Block, ...]:
    """Return what the study says in sentences, and which runs are missing or have no result."""
    subject = StudySubject(study, Path(), Numbers(study.to_json(), units), {}, "")
    blocks = suite_answer(subject) or answer(subject)
    return without_gaps(_missing(study), *blocks, *portfolio(subject), _lost(study))


def study_sections(study: StudyResults, units: str) -> tuple[Block, ...]:
    """Return the results of a study in tables."""
    subject = StudySubject(study, Path(), Numbers(study.to_json(), units), {}, "")
    sections = (
        suite(subject),
        portfolio_section(subject),
        None if study.suite else results(subject),
        fragility(subject),
        hazard_section(subject),
        None if study.suite else measures_compared(subject),
        hangs_on(subject),
        _fine(subject),
    )
    return with_one_unit(without_gaps(*sections), subject.numbers)


def study_document(subject: StudySubject) -> Document:
    """Return the whole report."""
    study = subject.results
    sections = (
        _question(subject),
        suite(subject),
        portfolio_section(subject),
        dam_pages(subject),
        _varied(subject),
        _motions(subject),
        None if study.suite else results(subject),
        fragility(subject),
        hazard_section(subject),
        None if study.suite else measures_compared(subject),
        hangs_on(subject),
        _fine(subject),
        Section("References", (References(_references(subject)),)),
        _rerun(subject),
        Section("Appendix: the base case", (case_table(subject.case, subject.units, "Given by the base case."),)),
    )
    models = study.walk.models
    what, build = "suite" if study.suite else "study", study.manifest["build"]["heeltoe"]
    return Document(
        title=plain(study.title) or "Untitled case",
        subtitle=f"A {what} of {study.store.count:,} runs, by the {listed(models)} model{'s' * (len(models) > 1)}",
        footer=" · ".join([*named(subject.case), f"heeltoe {build}", f"{what} {study.manifest['fingerprint'][:12]}"]),
        blocks=with_one_unit(without_gaps(revisions(subject.case), *sections), subject.numbers),
        about=tuple((label, plain(words)) for label, words in subject.case.project.rows()),
    )


def _question(subject: StudySubject) -> Section:
    study = subject.results
    dams = study.store.count // max(1, _runs_of_a_dam(subject))
    motions = len(study.manifest["motions"])
    asked = (
        f"How does the part above the crack move in {study.store.count:,} runs: {counted(dams, 'dam')}, "
        f"{counted(motions, 'ground motion')} of {counted(len(study.manifest['events']), 'event')}?"
    )
    asked += "" if study.walk.every or motions == 1 else " Each dam meets one of them."
    blocks: list[Block | None] = [
        _missing(study),
        paragraph(Strong("Question. "), asked),
        *(suite_answer(subject) or answer(subject)),
        None if study.suite else _base_case(subject),
        _lost(study),
    ]
    if study.manifest["warnings"]:
        warned = tuple((plain(text, 1000),) for text in study.manifest["warnings"])
        blocks.append(Notes("warning", "Warnings", warned))
    return Section("Question and answer", without_gaps(*blocks))


def _missing(study: StudyResults) -> Block | None:
    """Say how many runs are missing."""
    if study.complete:
        return None
    text = f"{len(study.store.missing()):,} of {study.store.parts:,} parts of the runs are missing."
    return Notes("warning", "Not complete", ((text,),))


def _lost(study: StudyResults) -> Block | None:
    """Say which runs ended without a result."""
    lost = {name: count for name, count in study.outcomes.items() if not Outcome(name).has_result}
    if not sum(lost.values()):
        return None
    ended = ", ".join(f"{name} {count:,}" for name, count in lost.items())
    items = (
        f"{sum(lost.values()):,} of {sum(study.outcomes.values()):,} runs ended without a result: {ended}.",
        "Failed runs are kept: they exceed every limit. Dams that do not stand are counted beside the fragility "
        "curves; other runs without a result are left out of them and count as infinite slip in bands.",
    )
    return Notes("failure", "Runs without a result", tuple((item,) for item in items))


def _runs_of_a_dam(subject: StudySubject) -> int:
    """Return how many runs each dam has."""
    walk = subject.results.walk
    return (len(subject.results.manifest["motions"]) if walk.every else 1) * (walk.strengths or 1) * len(walk.models)


def _base_case(subject: StudySubject) -> Block | None:
    """Say what the base case does in its own motion, by the last model of the study; as its rows, without evidence."""
    from heeltoe.models.run import run

    try:
        response = run(subject.case.without_evidence(), subject.results.walk.models[-1])
    except InputError as error:
        return paragraph(Strong("Base case. "), f"Not run by itself: {plain(error, 300)}.")
    end = f"the {NAMES[response.model]} ends without a result ({response.outcome})."
    sentence = verdict(response, subject.units) if response.ok else end
    motion = f", peak {response.motion.pga / response.gravity:.3g} g: "
    return paragraph(Strong("Base case by itself. "), "In ", Code(plain(response.motion.name)), motion, sentence)


def _varied(subject: StudySubject) -> Section:
    study, blocks = subject.study, list[Block]()
    if study["suite"]:
        text = "All records shake the same dam; the appendix has every field of its case."
        return Section("The dam", (paragraph(text), *subject.figure("section")))
    drawn = study["samples"] is not None
    how = f"By the method “{study['method']}”"
    how += f", {study['samples']:,} samples, seed {study['seed']}." if drawn else "."
    blocks.append(paragraph(how))
    if study["cases"]:
        many = f"{len(subject.results.manifest['dams']):,} dams of the table "
        blocks.append(paragraph(many, Code(study["cases"]), "; all else is as in the base case."))
    elif study["vary"]:
        varied = tuple(
            (Code(path), values_phrase(values, subject.units, path)) for path, values in study["vary"].items()
        )
        blocks.append(
            Table(("field", "values"), varied, "Fields that vary; all others are as in the base case.", "ll", (4, 8))
        )
    else:
        blocks.append(paragraph("No field of the case varies."))
    if study["correlation"]:
        rows = tuple((Code(first), Code(second), f"{value:g}") for first, second, value in study["correlation"])
        blocks.append(Table(("field", "and field", "rank correlation"), rows, "Fields that are drawn together.", "llr"))
    return Section("Fields varied", (*blocks, *subject.figure("section")))


def _motions(subject: StudySubject) -> Section:
    motions = subject.results.manifest["motions"]
    motions_of_study = subject.study["motions"]
    scale = motions_of_study and motions_of_study["scale"]
    sentence = (
        "The motion of the base case, as it is."
        if motions_of_study is None
        else "As recorded; the table has them before scaling."
    )
    if scale:
        period = f" at {shown(scale['period'], subject.units)}" if scale["period"] is not None else ""
        what = "a factor" if scale["measure"] == "factor" else f"{scale['measure'].upper()}{period}"
        sentence += f" They are scaled to {what}: {values_phrase(scale['values'], subject.units)}"
        sentence += ", pairs of components by their geometric mean." if motions_of_study["pairs"] else "."
    if motions_of_study and motions_of_study["both_signs"]:
        sentence += " Each runs both ways round."
    rows = []
    for motion in motions:
        if not motion["reversed"]:
            measured, traits = motion["measures"], motion["traits"]
            rows.append(
                (
                    plain(motion["event"]),
                    Code(plain(motion["name"])),
                    f"{digits(measured['pga'] / STANDARD_GRAVITY, 3)} g",
                    subject.numbers.text(measured["pgv"], "velocity"),
                    _seconds(traits["mean_period_s"]),
                    _seconds(traits["significant_duration_s"]),
                )
            )
    head = ("event", "motion", "PGA", "PGV", "mean period", "duration")
    table = Table(
        head,
        tuple(rows),
        "Ground motions; duration from 5 to 95 % of the Arias intensity.",
        "llrrrr",
        (3.2, 3.8, 1.4, 1.7, 1.5, 1.7),
    )
    return Section("Ground motions", (paragraph(sentence), table))


def _seconds(value: float | None) -> str:
    return NOTHING if value is None else f"{digits(value, 3)} s"


def _fine(subject: StudySubject) -> Section | None:
    """Say how fine flexible runs are, and where the time went."""
    pilot, seconds = subject.results.manifest["pilot"], subject.results.manifest.get("seconds")
    blocks: list[Block] = []
    if pilot is not None:
        below = pilot["elements_across_below"]
        mesh = f"{pilot['elements_across']} elements across the crack" + (f", {below} below it" if below else "")
        step = f", and a time step of {1e3 * pilot['time_step_s']:.3g} ms"
        text = f"Flexible runs have {mesh}{step}, as one run of the base case with its evidence asked for; "
        blocks.append(paragraph(text + "the single runs of the study have none of their own."))
        slip_evidence = (pilot["evidence"] or {}).get(RESIDUAL_SLIP.key)
        if slip_evidence:
            worth = subject.numbers.text(slip_evidence["uncertainty"], "displacement")
            value = subject.numbers.text(slip_evidence["value"], "displacement")
            blocks.append(paragraph(f"There the residual slip was {value}, uncertain by {worth}."))
    if seconds:
        rows = tuple((name, f"{value:.3g} s") for name, value in seconds.items())
        blocks.append(Table(("", "time"), rows, "Where the time of the runs went, all workers together.", "lr"))
    return Section("How it was computed", tuple(blocks)) if blocks else None


def _references(subject: StudySubject) -> tuple[str, ...]:
    keys = list(subject.results.walk.models)
    if subject.study["fragility"]:
        keys += _SOURCES["fragility"]
    if len({motion["name"] for motion in subject.results.manifest["motions"]}) > 1:
        keys += _SOURCES["measures"]
    if subject.study["method"] == "sensitivity":
        keys += _SOURCES["sensitivity"]
    return cited(*keys)


def _rerun(subject: StudySubject) -> Section:
    needed, command = "the study file, its base case and its records", "heeltoe study STUDY.toml --report"
    if subject.study["suite"]:
        needed, command = "the case and its records", "heeltoe run CASE.toml --motions RECORDS --report"
    return rerun_section(
        f"With {needed}, this command makes the same numbers again:",
        subject.command or command,
        subject.results.manifest["build"],
        paragraph(
            Strong("Suite, SHA-256. " if subject.study["suite"] else "Study, SHA-256. "),
            Code(subject.results.manifest["fingerprint"]),
        ),
        paragraph(
            "The hash covers the study, every field of the base case in SI units, defaults included, and the samples "
            "of all ground motions, so that the same hash and the same build mean the same numbers."
        ),
    )
