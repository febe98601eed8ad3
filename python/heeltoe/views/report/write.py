"""Writing a report: what it needs is there, what it says is gathered, and its files appear whole or not at all."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from heeltoe.base.atomic_files import write_whole
from heeltoe.base.heap import give_back
from heeltoe.errors.error import InputError, expect

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from heeltoe.case.model import Case
    from heeltoe.models.statics.joints import Joints
    from heeltoe.models.statics.model import Statics
    from heeltoe.result.response import Response
    from heeltoe.study.answers.study_results import StudyResults
    from heeltoe.views.content.drawings import DrawnAhead
    from heeltoe.views.content.tree import Document

#: What each kind of report needs that heeltoe itself does not.
KINDS = {"pdf": "typst", "html": "jinja2"}


def check_packages(kinds: Sequence[str] = ("pdf", "html"), field: str = "--report") -> None:
    """Refuse a kind of report that is not known, or whose package is not installed.

    Raises
    ------
    InputError
        Then; before anything is computed, if it is called first.
    """
    for kind in kinds:
        if kind not in KINDS:
            raise InputError("not-a-choice", field, repr(kind), choices="pdf or html")
        if find_spec(KINDS[kind]) is None:
            raise InputError("package-missing", field, KINDS[kind], install="pip install jinja2 typst")
        try:
            import_module(KINDS[kind])
        except ImportError as error:
            raise InputError("report-package-broken", field, KINDS[kind], reason=error) from None


def build_report(
    case: Case,
    result: Response,
    *,
    statics: Statics | Joints | None = None,
    units: str = "si",
    command: str = "",
    figures: Mapping[str, Figure] | None = None,
    ahead: DrawnAhead | None = None,
) -> Document:
    """Return what a report says, apart from how it looks.

    Parameters as of :func:`write_report`; `figures` are those of the result, drawn before, which are changed here to
    what a report needs. They are drawn where they are not given; a report of none at all has none of its own either.
    Those that are drawn `ahead` are taken from there.
    """
    from heeltoe.models.statics.after import joints_after
    from heeltoe.models.statics.joints import Joint, Joints
    from heeltoe.views.content.document import document
    from heeltoe.views.content.drawings import drawings
    from heeltoe.views.content.subject import Subject
    from heeltoe.views.figures.all import Figures, all_figures, has_pictures
    from heeltoe.views.figures.motion import history_figure
    from heeltoe.views.figures.summary import summary_figure
    from heeltoe.views.words.numbers import Numbers

    if isinstance(statics, Joints):
        judged = statics
    elif statics is not None:
        judged = Joints(case.title, (Joint(case.crack.elevation, case, statics),))
    else:
        judged = joints_after(case, lambda: tuple(reversed(result.responses)))
    numbers = Numbers({**result.to_json(), "statics": judged.governing.statics.to_json()}, units)
    drawn = all_figures(case, result, units) if figures is None else figures
    runs = tuple(run for run in reversed(result.responses) if has_pictures(run))
    if not drawn:
        return document(Subject(case, result, numbers, drawings(drawn), judged, command))
    first = {"summary": lambda: summary_figure(case, runs, units)}
    if runs:
        first["motion"] = lambda: history_figure(result.motion, result.vertical, result.gravity, units)
    shown = drawings(
        Figures(first | {name: partial(drawn.__getitem__, name) for name in drawn}),
        _crack_names(result, units),
        None if ahead is None else ahead.blocks,
    )
    return document(Subject(case, result, numbers, shown, judged, command))


def draw_ahead(case: Case, result: Response, units: str) -> DrawnAhead:
    """Return the figures of a result, and what draws them for its report as they are written."""
    from heeltoe.views.content.drawings import DrawnAhead
    from heeltoe.views.figures.all import all_figures

    return DrawnAhead(all_figures(case, result, units), _crack_names(result, units))


def _crack_names(result: Response, units: str) -> dict[str, str]:
    """Return what each of several cracks is called in captions, by the prefix of its figures."""
    from heeltoe.units.sentences import quantity

    if not result.several:
        return {}
    own = result.cracks[result.asked].elevation
    levels = {"": own} | {name: other.cracks[0].elevation for name, other in result.others.items()}
    return {name: f"crack at {quantity(level, '.5g m', units)}" for name, level in levels.items()}


def write_report(
    case: Case,
    result: Response,
    directory: Path | str,
    *,
    statics: Statics | Joints | None = None,
    units: str | None = None,
    kinds: Sequence[str] = ("pdf", "html"),
    command: str = "",
) -> list[Path]:
    """Write the report of a result as ``report.pdf`` and ``report.html``.

    Both are made aside first, so that a failure leaves nothing half-done; reports of an earlier run are replaced.

    Parameters
    ----------
    case
        What was asked.
    result
        What came out: of one model, or with another beside it. A run that failed makes a report that says what failed.
    directory
        Where; it is made if it is not there.
    statics
        Result of :func:`heeltoe.statics` or :func:`heeltoe.statics_of_sections`; computed with the residual slips of
        the result where it is not given.
    units
        ``"si"`` or ``"us"``: of input, numbers, sentences and figures; those of the case where it is not given. The
        JSON stays SI.
    kinds
        Which of ``"pdf"`` and ``"html"``.
    command
        What was typed to get the report, for the section on how to run it again.

    Returns
    -------
    list of Path
        What was written.

    Raises
    ------
    InputError
        Where the directory cannot be written, or a package of the extra ``report`` is not installed.
    """
    from heeltoe.case.model import Case
    from heeltoe.result.response import Response

    expect(case, Case, "a case", "case")
    expect(result, Response, "a response", "result")
    check_packages(kinds, "kinds")
    document = build_report(case, result, statics=statics, units=units or case.units, command=command)
    return write_document(document, directory, kinds)


def write_study_report(
    study: StudyResults,
    fresh: Path,
    *,
    base: Path | None = None,
    units: str = "si",
    command: str = "",
    figures: Mapping[str, Figure] | None = None,
) -> None:
    """Write the report of a study into a directory without one.

    Parameters
    ----------
    study
        The study.
    fresh
        Where.
    base
        Where relative paths of its base case start; the current directory where it is not given.
    units, command
        As of :func:`write_report`.
    figures
        Of the study, drawn before, which are changed here to what a report needs.
    """
    from heeltoe.views.content.study import study_document, study_subject

    write_kinds(study_document(study_subject(study, base or Path(), units, command, figures)), fresh)


def write_document(document: Document, directory: Path | str, kinds: Sequence[str] = ("pdf", "html")) -> list[Path]:
    """Write what a report says as ``report.pdf`` and ``report.html``, both or none; see :func:`write_report`."""
    return write_whole(lambda fresh: write_kinds(document, fresh, kinds), Path(directory), (), field="--report")


def write_kinds(document: Document, fresh: Path, kinds: Sequence[str] = ("pdf", "html")) -> None:
    """Write the files of a report into a directory without one."""
    # The PDF last, as typst keeps what it has read.
    for kind in sorted(kinds):
        give_back()
        (fresh / f"report.{kind}").write_bytes(_rendered(document, kind))


def _rendered(document: Document, kind: str) -> bytes:
    if kind == "pdf":
        from heeltoe.views.report.typst_pdf import pdf

        return pdf(document)
    from heeltoe.views.report.html import html

    return html(document).encode("utf-8")
