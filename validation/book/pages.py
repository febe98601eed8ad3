"""The pages of the book in Markdown."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from heeltoe.mechanics.references import REFERENCES
from validation.absent import ABSENT
from validation.book.store import VERDICTS, Rows
from validation.cases import CASES
from validation.declared import Declared

_MADE = "<!-- Made by `make book`. -->"
#: The thesis in full, as on the first page of the book; the other pages have its short name.
_THESIS = REFERENCES["rigid"].partition(", chapters")[0]
#: Spread of a case without an earthquake, which its page leaves out.
_STILL = "Nothing shakes."
_COLUMNS = {
    "what": "",
    "reference": "reference",
    "ours": "heeltoe",
    "deviation": "deviation",
    "half the step": "half the step",
    "99 to 101 % of the shaking": "99 to 101 % of the shaking",
    "verdict": "not within",
}
_INTRODUCTION = """# Validation

Every validated number beside its reference: {cases} cases, {rows} rows. `make book` makes the pages from the programs
of `validation/`, and the tests compare the pages with the computed numbers. To run a case again:

    python -m validation table-7.8

Each row has a verdict. *Within*: the deviation is no larger than the uncertainty of the reference, which the case
states with its reason. *Deviates, explained*: it is larger, and the row gives the reason; such a row does not count as
reproduced. *Outside*: larger than is explained; there must be none. *No verdict*: the reference allows none, for the
reason given. A table marks the rows that are not within. A number in brackets leads to the note on the reference: its
kind, its tolerance, that is its own uncertainty, and how far a deviation is explained. The thesis is X. Zhu, *Seismic
Behavior of Cracked Concrete Gravity Dams*, PhD thesis, Concordia University, Montréal, 2004; its numbers are as
printed. A prototype is an independent program made after it. Records that some cases need are no part of the project;
without them these cases are skipped.

{verdicts}

[Independent codes](independent-codes.md) compares programs on problems with a known answer. [Choices of the flexible
model](flexible-choices.md) has the measurements behind it, and counts how often its stated uncertainty holds.
[Rigid rock](rigid-rock.md) measures the effect of rock and sound on a hundred dams. [Attacks](attack.md) counts random
cases that try to break the program.

## Measured

These cases stand beside tests in a laboratory. The slip of a real dam along its crack has not been measured in an
earthquake, as far as is known; no case has one.

{measured}

## Computed

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
                f"- Source: {case.source.replace(_THESIS, 'Zhu (2004)')}",
                f"- Convergence: {case.convergence}",
                *([f"- Spread: {case.spread}"] if case.spread != _STILL else []),
                f"- `python -m validation {name}`{' (needs records)' * case.records}",
                *_elsewhere(case),
            )
        )
    )
    if case.chart:
        parts.append(f"![The rows as curves]({file_of(name)}.png)")
    if case.history:
        parts.append(f"![Slip, rotation and modes over time]({file_of(name)}-history.png)")
    parts.append(f"{_in_words(counted(rows))}.{_shared(rows)}")
    parts += [_rows(rows), *_remarks(rows)]
    return "\n\n".join(parts) + "\n"


def index(book: dict[str, Rows]) -> str:
    """Return the first page: the matrix, and what cannot be reproduced."""
    total = Counter(row["verdict"] for rows in book.values() for row in rows)
    shown = [verdict for verdict in VERDICTS[1:] if total[verdict]]
    lines: list[list[str]] = []
    measured: list[list[str]] = []
    for name, case in CASES.items():
        rows = book.get(name, [])
        counts = counted(rows)
        cells = [f"[{name}]({file_of(name)}.md)", _shortened(case.title), ", ".join(case.models)]
        cells += [str(len(rows)), *(str(counts[verdict] or "") for verdict in shown)]
        (measured if any(row["kind"] == "measured" for row in rows) else lines).append(cells)
    heads = ["case", "what", "model", "rows", *shown]
    text = _INTRODUCTION.format(
        cases=len(CASES),
        rows=sum(total.values()),
        verdicts=f"Total: {_in_words(total)}.",
        measured=_table(heads, measured),
    )
    absent = [[gap.what, ", ".join(gap.models), gap.why] for gap in ABSENT]
    return (
        f"{_MADE}\n\n{text}{_table(heads, lines)}\n\n## Results that cannot be reproduced\n\n"
        f"{_table(['what', 'model', 'why'], absent)}\n"
    )


def _body(case: Declared) -> list[str]:
    """Return what a case says of itself below its first line."""
    return [_plain(part) for part in case.text.partition("\n")[2].strip().split("\n\n") if part]


def _shortened(title: str) -> str:
    """Return what a title says before its first colon; the page has all of it."""
    return _plain(title).partition(": ")[0].rstrip(".:")


def _plain(text: str) -> str:
    """Return a docstring's text as Markdown."""
    return re.sub(r":\w+:`[\w.]*?(\w+)`", r"`\1`", text)


def _elsewhere(case: Declared) -> list[str]:
    """Return what is the same on another machine, where it is not all."""
    if case.steady == 0.0:
        return []
    numbers = "other numbers" if case.steady == math.inf else f"within {100.0 * case.steady:g} %"
    return [f"- On another machine: {numbers}"]


def _in_words(counts: Counter[str]) -> str:
    """Return how many rows have each verdict, those without a row left out."""
    named = [(counts[verdict], verdict) for verdict in VERDICTS if counts[verdict]]
    total = sum(count for count, _ in named)
    if len(named) == 1:
        return f"{total} rows, all {named[0][1]}"
    return f"{total} rows: {'; '.join(f'{count} {verdict}' for count, verdict in named)}"


def _shared(rows: Rows) -> str:
    """Return the kind, tolerance and remark of the references in a sentence, if all rows have the same ones."""
    notes = _notes(rows)
    return f" Reference: {next(iter(notes))}." if len(notes) == 1 else ""


def _note(row: Mapping[str, str]) -> str:
    """Return the kind of a reference, its tolerance, and the remark on it."""
    tolerance = "" if row["tolerance"] == "none" else f", {row['tolerance'].replace(';', ',')}"
    remark = f": {row['remark']}" if row["remark"] else ""
    return f"{row['kind']}{tolerance}{remark}"


def _notes(rows: Rows) -> dict[str, int]:
    """Return the numbers of the notes on references."""
    return {note: place for place, note in enumerate(dict.fromkeys(_note(row) for row in rows), 1)}


def _rows(rows: Rows) -> str:
    """Return the table of a case; notes are numbered below it."""
    if table := _versions(rows):
        return table
    notes = _notes(rows)
    same = {"verdict"} if len(counted(rows)) == 1 and not counted(rows)["outside"] else set()
    columns = [name for name in _COLUMNS if name not in same and any(row.get(name) for row in rows)]
    lines = []
    for row in rows:
        cells = {**row, "what": row["what"] + (f" [{notes[_note(row)]}]" if len(notes) > 1 else "")}
        cells["verdict"] = {"within": "", "outside": "**outside**"}.get(row["verdict"], row["verdict"])
        lines.append([cells.get(name, "") for name in columns])
    return _table([_COLUMNS[name] for name in columns], lines)


def _versions(rows: Rows) -> str:
    """Return a table with a column for each version of an input, where all versions have the same references; empty
    where a case has no versions."""
    names = [row["what"].partition(", ") for row in rows]
    versions = list(dict.fromkeys(version for version, _, _ in names))
    cells = {(what, version): row for (version, _, what), row in zip(names, rows, strict=True)}
    numbers = list(dict.fromkeys(what for _, _, what in names))
    whole = len(versions) > 1 and len(cells) == len(rows) == len(numbers) * len(versions)
    if not whole or any(len({cells[what, name]["reference"] for name in versions}) > 1 for what in numbers):
        return ""
    lines = []
    for what in numbers:
        ours = [f"{cells[what, name]['ours']} ({cells[what, name]['deviation']})" for name in versions]
        lines.append([what, cells[what, versions[0]]["reference"], *ours])
    return _table(["", "reference", *versions], lines)


def _remarks(rows: Rows) -> Iterable[str]:
    notes = _notes(rows)
    if len(notes) > 1:
        known: dict[str, int] = {}
        lines = []
        for note, place in notes.items():
            what, colon, remark = note.partition(": ")
            first = known.setdefault(remark, place) if colon else place
            lines.append(f"{place}. {note if first == place else f'{what}: as in {first}'}")
        yield "\n".join(lines)


def _table(heads: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    cells = [list(heads), ["---"] * len(heads), *(list(line) for line in lines)]
    return "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in cells)
