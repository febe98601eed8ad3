"""The pages of the book in Markdown."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterable, Sequence

from validation.absent import ABSENT
from validation.book.store import VERDICTS, Rows
from validation.cases import CASES
from validation.declared import MODELS, Declared, Model

_MADE = "<!-- Made by `make book`; what is changed by hand here fails the tests. -->"
_COLUMNS = {
    "what": "",
    "kind": "reference is",
    "reference": "reference",
    "ours": "heeltoe",
    "deviation": "deviation",
    "tolerance": "tolerance",
    "half the step": "half the step",
    "99 to 101 % of the shaking": "99 to 101 % of the shaking",
    "verdict": "verdict",
}
_INTRODUCTION = """# Validation

Every validated number beside its reference: {cases} cases, {rows} rows. All of it is
made from the programs of `validation/` by `make book`; the tests compute it again and fail where a page
says something else. A case is run again with

    python -m validation table-7.8

Each row has a verdict. *Within*: the deviation is no larger than the reference itself is good for, which the case
states with its reason. *Deviates, explained*: it is larger, and the row says what the difference is; it does not count
as reproduced. *Outside*: larger than is explained; there must be none. *No verdict*: a number to be known, for which
nothing can be asked, with the reason. References from the thesis (X. Zhu, Concordia University, 2004) are as it prints
them.

{verdicts}

[Independent codes](independent-codes.md) has the problems that other programs solve too, and what each of them cannot.

## Matrix

"""


def file_of(name: str) -> str:
    """Return the name of a case's page, without its ending."""
    return name.replace(".", "-")


def counted(rows: Rows) -> Counter[str]:
    """Return how many rows have each verdict."""
    return Counter(row["verdict"] for row in rows)


def page(name: str, rows: Rows) -> str:
    """Return the page of a case."""
    case = CASES[name]
    parts = [f"# {_plain(case.title).rstrip('.:')}", _MADE, *_body(case)]
    parts.append(
        "\n".join(
            (
                f"- Model: {', '.join(case.models)}",
                f"- Source: {case.source}",
                f"- Convergence: {case.convergence}",
                f"- Spread: {case.spread}",
                f"- Again: `python -m validation {name}`{_needs(case)}",
                *_elsewhere(case),
            )
        )
    )
    if case.chart:
        parts.append(f"![{_plain(case.title)}]({file_of(name)}.png)")
    if case.history:
        parts.append(f"![Slip, rotation and modes over time]({file_of(name)}-history.png)")
    parts.append(f"{len(rows)} rows: {_in_words(counted(rows))}.")
    parts += [_rows(rows), *_remarks(rows)]
    return "\n\n".join(parts) + "\n"


def index(book: dict[str, Rows]) -> str:
    """Return the first page: the matrix, and what cannot be reproduced."""
    total = Counter(row["verdict"] for rows in book.values() for row in rows)
    lines = []
    for name, case in CASES.items():
        rows = book.get(name, [])
        counts = counted(rows)
        cells = [f"[{name}]({file_of(name)}.md)", _plain(case.title).rstrip(".:"), *_ticks(case.models), str(len(rows))]
        lines.append([*cells, *(str(counts[verdict] or "") for verdict in VERDICTS)])
    heads = ["case", "what", *MODELS, "rows", *VERDICTS]
    text = _INTRODUCTION.format(cases=len(CASES), rows=sum(total.values()), verdicts=f"In all {_in_words(total)}.")
    absent = [[gap.what, ", ".join(gap.models), gap.why] for gap in ABSENT]
    return (
        f"{_MADE}\n\n{text}{_table(heads, lines)}\n\n## Results that cannot be reproduced\n\n"
        f"{_table(['what', 'model', 'why'], absent)}\n"
    )


def _body(case: Declared) -> list[str]:
    """Return what a case says of itself below its first line."""
    return [_plain(part) for part in case.text.partition("\n")[2].strip().split("\n\n") if part]


def _plain(text: str) -> str:
    """Return a docstring's text as Markdown."""
    return re.sub(r":\w+:`[\w.]*?(\w+)`", r"`\1`", text)


def _needs(case: Declared) -> str:
    return "; it needs records that are no part of the project, and says so where they are not there" * case.records


def _elsewhere(case: Declared) -> list[str]:
    """Return what is the same on another machine, where it is not all."""
    if case.steady == 0.0:
        return []
    numbers = (
        "numbers are others" if case.steady == math.inf else f"numbers are within {100.0 * case.steady:g} % of these"
    )
    return [f"- On another machine: {numbers}, verdicts the same; a dam that strikes carries rounding on"]


def _in_words(counts: Counter[str]) -> str:
    words = ("within what their reference is good for", "deviate and say why", "outside", "without a verdict")
    return ", ".join(f"{counts[verdict]} {word}" for verdict, word in zip(VERDICTS, words, strict=True))


def _ticks(models: tuple[Model, ...]) -> list[str]:
    return ["●" if model in models else "" for model in MODELS]


def _rows(rows: Rows) -> str:
    """Return the table of a case; remarks are numbered below it."""
    remarks = _numbered(rows)
    columns = [name for name in _COLUMNS if any(name in row for row in rows)]
    lines = []
    for row in rows:
        cells = {**row, "what": row["what"] + (f" [{remarks[row['remark']]}]" if row["remark"] else "")}
        if row["verdict"] == "outside":
            cells["verdict"] = "**outside**"
        lines.append([cells.get(name, "") for name in columns])
    return _table([_COLUMNS[name] for name in columns], lines)


def _numbered(rows: Rows) -> dict[str, int]:
    return {remark: place for place, remark in enumerate(dict.fromkeys(r["remark"] for r in rows if r["remark"]), 1)}


def _remarks(rows: Rows) -> Iterable[str]:
    if remarks := _numbered(rows):
        yield "\n".join(f"{place}. {remark}" for remark, place in remarks.items())


def _table(heads: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    cells = [list(heads), ["---"] * len(heads), *(list(line) for line in lines)]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in cells)
