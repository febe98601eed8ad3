"""Plain numbers: time and acceleration, acceleration alone, several columns with a name each, or values that run along
the rows; a header in words or behind ``#`` if there is one.

Columns are parted by blanks, tabs, commas or semicolons; beside semicolons and tabs, commas are decimal, and beside
blanks where every cell has one within, as in one column of them. A header may state count, step, rate, duration, peak
and unit in the words of :mod:`heeltoe.motion.records.words`; all of it is held against what was read::

    # time step: 0.02 s
    # units: column 1 time [s], column 2 acceleration [g]
    time [s], acceleration [cm/s2]

Values run along the rows where the user says so, or where a header states a step and as many values as there are.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from heeltoe.base.arrays import Floats, median
from heeltoe.base.pattern import pattern
from heeltoe.errors.error import InputError
from heeltoe.motion.records.lines import is_data, is_row, parted, parted_all
from heeltoe.motion.records.quantities import (
    direction_in,
    is_direction,
    is_time,
    names_of,
    other_quantity,
    quantity_of,
    surely_time_in,
    table_in,
    time_in,
    unit_of,
    units_in,
    units_of,
    without_index,
)
from heeltoe.motion.records.raw import COUNT, NUMBER, RawRecord, counted, doubtful, numbers, real
from heeltoe.motion.records.stated import IN_A_SENTENCE, Stated, read_stated, seconds_in
from heeltoe.motion.records.words import TIME, folded
from heeltoe.motion.start import moment_of
from heeltoe.warnings.notice import Notice

FORMAT = "columns"

_TIME_IN = pattern(
    rf"(?<![/\w])(?:{TIME})\s+(?:in|en|em)\s+([^\W\d]+)|(?<![/\w])(?:{TIME})\s*[\[(]\s*([^\])]{{1,30}}?)\s*[\])]"
    r"(?!\s*[:=]?\s*[-+]?\d)(?!\s*[:=])"
)
# A factor beside a table, or one within its unit, as in "x 10 gal" or "g * 1e-3".
_FACTOR = pattern(
    r"\b(?:scale|scaling|multiplication|multiplier|conversion|calibration|amplification)(?:[ _-]?factor)?\s*[:=]\s*"
    rf"({NUMBER})|\bfactor\s*[:=]\s*({NUMBER})|[x×*]\s*(10\s*(?:\^|\*\*|e)?\s*[-+]?\d*)\b",
    re.IGNORECASE,
)
_HEADER_LINES, _HEADER_WIDTH = 100, 400
# More moments than this that are 1 s apart count samples: no record is so slow. Fewer steps show nothing.
_FEW = 20
# A column of times has this share of steps within so much of their median.
_MOSTLY, _EVEN = 0.9, 0.02
# A stated step is that of the times within so much of it.
_SAME_STEP = 0.01
# A line of data is shorter; of a longer one, a part tells what it is.
_DATA_WIDTH, _MOST_COLUMNS = 4000, 20
_DECIMAL_COMMA = pattern(r"\d,\d")
_BLANK_CELLS = pattern(r"\s*[-+]?\d+,\d+(?:[eE][-+]?\d+)?(?:\s+[-+]?\d+,\d+(?:[eE][-+]?\d+)?)+\s*")
_CELL = pattern(r"\s*[-+]?\d+(?:,\d+)?(?:[eE][-+]?\d+)?\s*")
_LONE = pattern(r"([-+]?\d+),(\d+)(?:[eE][-+]?\d+)?")
# 1,250 is 1250 to some, and 1.25 to others; 0,250 is clear, since no thousands begin with a zero.
_THOUSANDS = pattern(r"\s*[-+]?[1-9]\d{0,2},\d{3}\s*")
_ABOUT = pattern(
    r"^(event|earthquake|station|site code|component|date|initial time|processing)\s*[:=]\s*(.+)$", re.IGNORECASE
)
# A line that a table may begin with, the next one, and numbers that no count has.
_COUNT_AND_STEP = pattern(r"(\d{2,9})(?:[\s,;]+(0?\.\d+))?")
_STEP = pattern(r"0?\.0*[1-9]\d*")
_DECIMALS = pattern(r"[.,]\d|\d[eEdD]")
_CALLED = {"earthquake": "event", "site code": "station", "initial time": "date"}


def _split(lines: list[str]) -> tuple[list[str], int]:
    """Header lines without their ``#``, and the index of the first line of data."""
    header: list[str] = []
    for k, line in enumerate(lines):
        text = line.strip()
        if text and not text.startswith(("#", "%", "//")) and is_row(text[:_HEADER_WIDTH]):
            return header, k
        # What a header has to say it says early; a long one must not slow the search down.
        if k < _HEADER_LINES:
            header.append(text.lstrip("#%/ ").strip(" ,;\t")[:_HEADER_WIDTH])
    return header, len(lines)


def matches(lines: list[str]) -> bool:
    """Whether there are lines of as many numbers, after a header of any kind."""
    lines = _headed(lines)
    _, first = _split(lines)
    data = [parted(line[:_DATA_WIDTH].split("#")[0]).split() for line in lines[first : first + 20] if line.strip()]
    if not data:
        return False
    widths = [len(words) for words in data]
    # Prose may begin with a number. A line or two may be spoilt; the reader names them.
    numeric = widths[0] <= 2 or all(map(is_data, data[0][:_MOST_COLUMNS]))
    return numeric and widths.count(widths[0]) > len(widths) / 3


def read(lines: list[str], name: str, layout: str | None = None, field: str = "motion") -> list[RawRecord]:
    """Read a file that matches; `layout` is "rows" or "columns" where the user says, in the block `field`, how its
    values run."""
    lines = _headed(lines)
    header, first = _split(lines)
    points, commas = _with_points(lines[first:], name, first + 1)
    data = parted_all([line.split("#")[0] for line in points])
    widths = [len(line.split()) for line in data]
    width = widths[0]
    bare = [line.replace('"', "") for line in header]
    values = numbers(data, name, first + 1)
    said = [line for line in bare if not _ABOUT.match(line)]
    if heading := table_in(said, width):
        raise InputError("record-table", name, repr(heading[:60]))
    stated = read_stated(said)
    names = names_of(header, width)
    if names is not None and not _is_named_time(names[without_index(names)]) and _counts_time(values[::width]):
        # Accelerations do not grow in equal steps: what was taken for names says nothing of the first column.
        names = None
    asked = _Asked(name, layout, f"{field}.layout")
    if _run_along_rows(values, widths, names, stated, asked, bare):
        table = _Table(values.reshape(1, -1), [""], None)
        names = None
    else:
        table = _table(values, widths, names, name, first, layout, time_in(bare))
    _check_count(stated, table.columns[0], values.size, asked)
    clock = _clock(table.time, table.time_name, said, stated, name)
    series = _series(table, said, name)
    # One series by itself is one over time where somebody says its step.
    stands = table.time is None or any(map(is_direction, names or ())) or surely_time_in(bare)
    _check_sides(series, stands or bool(stated.steps) or clock.counts, name)
    about, processing = _about(bare)
    begins = next((moment_of(line) for line in bare if line.lower().startswith("initial time")), None)
    done = (*processing, *(("decimal commas read",) if commas else ()), *clock.processing)
    largest = max(range(len(series)), key=lambda k: float(np.abs(series[k][0]).max(initial=0.0)))
    return [
        RawRecord(
            acceleration,
            time=clock.time,
            time_step=clock.step,
            unit=unit,
            about={**about, "component": direction} if direction else dict(about),
            processing=done,
            warnings=_warnings(stated, table.columns[0], name),
            counts_samples=clock.counts,
            peaks=stated.peaks if k == largest and (len(series) == 1 or len(stated.peaks) == 1) else (),
            durations=stated.durations,
            named_units=frozenset() if unit else frozenset(units_of(said).union(*map(units_in, table.names))),
            factor=_factor(bare, name, f"{field}.factor"),
            begins=begins,
        )
        for k, (acceleration, direction, unit) in enumerate(series)
    ]


#: Codes of the errors that go where the user says how the values run.
ASKS_FOR_LAYOUT = frozenset({"record-layout", "record-columns", "record-time-column"})


def _headed(lines: list[str]) -> list[str]:
    """Return lines of which a first one with the count of all numbers behind it, and perhaps their step, says so.

    A whole number by itself before numbers with decimals is a count, too, if a wrong one.
    """
    _, first = _split(lines)
    filled = [place for place in range(first, len(lines)) if lines[place].strip()]
    found = _COUNT_AND_STEP.fullmatch(lines[filled[0]][:_DATA_WIDTH].strip()) if len(filled) > 1 else None
    if found is None:
        return lines
    rest = [len(parted(lines[place].split("#")[0]).split()) for place in filled[1:]]
    count, step, taken = int(found[1]), found[2], 1
    if step is None and sum(rest) == count + 1 and _STEP.fullmatch(lines[filled[1]].strip()):
        step, taken = lines[filled[1]].strip(), 2
    behind = [lines[place] for place in filled[taken:]]
    alone = step is None and set(rest) == {1} and all(map(_DECIMALS.search, behind))
    if sum(rest[taken - 1 :]) != count and not alone:
        return lines
    said = [f"NPTS: {count}", *([] if step is None else [f"DT: {step} s"])]
    own = {filled[0]: ", ".join(said)} if taken == 1 else dict(zip(filled, said, strict=False))
    return [own.get(place, line) for place, line in enumerate(lines)]


@dataclass(frozen=True)
class _Asked:
    """The file, how its values run by the user, and the field in which to say it."""

    name: str
    layout: str | None
    field: str


@dataclass(frozen=True)
class _Table:
    """The columns of a file without its times and the numbers of its rows, with their names."""

    columns: Floats
    names: list[str]
    time: Floats | None
    time_name: str = ""


@dataclass(frozen=True)
class _Clock:
    """Times of the values of a file: their moments [s] or their step [s], and the notes on them."""

    time: Floats | None
    step: float | None
    processing: tuple[str, ...] = ()
    counts: bool = False


def _run_along_rows(
    values: Floats,
    widths: list[int],
    names: list[str] | None,
    stated: Stated,
    asked: _Asked,
    header: list[str],
) -> bool:
    """Whether the values run along the rows, by the user's word, or by a count and a step of the header."""
    width, rows = widths[0], sum(count > 0 for count in widths)
    name, field = asked.name, asked.field
    if asked.layout is not None:
        if asked.layout == "rows" and width > 1 and _counts_time(values[: width * (rows - 1) : width]):
            raise InputError("record-layout-time", field, '"rows"', name=name)
        return asked.layout == "rows"
    if width == 1:
        return False
    along = stated.is_count(values.size) and not stated.is_count(rows)
    if along and stated.steps and names is not None and not any(map(_is_surely_named, names)):
        # Words alone weigh less than numbers.
        names = None
    if along and names is not None:
        raise InputError("record-layout", name, values.size, width=width, rows=rows, layout_field=field)
    if along and stated.steps:
        return True
    if width == 2 and names is None:
        # Where values run along the rows, the last one may be short.
        if values.size in (2 * rows, 2 * rows - 1) and not _is_time(values[: 2 * (rows - 1) : 2], time_in(header)):
            raise InputError("record-time-column", name, layout_field=field)
        return False
    if names is None:
        raise InputError("record-columns", name, width, layout_field=field)
    return False


def _is_surely_named(name: str) -> bool:
    return is_time(name) or bool(units_in(name))


def _is_time(column: Floats, named: bool) -> bool:
    """Whether a column may be the times of a record: never back, and in equal steps unless its header names a time."""
    if column.size <= _FEW:
        return True
    with np.errstate(invalid="ignore", over="ignore"):
        steps = np.diff(column)
        if not (steps >= 0.0).all() or abs(column[0]) > abs(column[-1] - column[0]):
            # Damage is named by its row, where most of it is right.
            return bool(named or (steps > 0.0).mean() > _MOSTLY)
        middle = median(steps)
        even = float((np.abs(steps - middle) <= _EVEN * middle).mean())
        return bool(named or even > _MOSTLY or _is_rounded(column))


def _counts_time(column: Floats) -> bool:
    """Whether a column grows all through, which no acceleration does."""
    with np.errstate(invalid="ignore", over="ignore"):
        return bool(column.size > _FEW and column[-1] > column[0] and (np.diff(column) >= 0.0).all())


def _is_rounded(column: Floats) -> bool:
    """Whether equal steps were printed with too few digits."""
    steps = np.diff(column)
    line = column[0] + (column[-1] - column[0]) * np.arange(column.size) / (column.size - 1)
    return bool(np.abs(column - line).max() <= 1.5 * float(steps.max() - steps.min()))


def _table(
    values: Floats,
    widths: list[int],
    names: list[str] | None,
    name: str,
    first: int,
    layout: str | None,
    named: bool,
) -> _Table:
    width = widths[0]
    for k, count in enumerate(widths):
        if count not in (0, width):
            raise InputError("record-ragged", name, f"{count} columns", line=first + k + 1, width=width)
    if values.size % width:
        raise InputError("record-ragged", name, f"{values.size} numbers", line=first + 1, width=width)
    columns = np.ascontiguousarray(values.reshape(-1, width).T)
    if names is None:
        # The first of the columns that the user names is a time if it can be one.
        timed = width == 2 or (
            width > 2 and layout == "columns" and columns.shape[1] > _FEW and _is_time(columns[0], named)
        )
        rest = [str(k) for k in range(1, width)] if width > 2 else [""]
        return _Table(columns[1:], rest, columns[0]) if timed else _Table(columns, [*rest, str(width)][:width], None)
    skipped = without_index(names)
    if skipped and skipped == width - 1 and not is_time(names[-1]):
        # A number for each row, and nothing else beside the values: the reader of the clock asks for a step.
        return _Table(columns[1:], names[1:], columns[0], names[0])
    columns, names = columns[skipped:], names[skipped:]
    if len(names) > 1 and _is_named_time(names[0]):
        return _Table(columns[1:], names[1:], columns[0], names[0])
    return _Table(columns, names, None)


def _is_named_time(name: str) -> bool:
    bracket = re.search(r"[\[(]\s*([^\])]{1,20}?)\s*[\])]", name)
    return is_time(name) or (bracket is not None and seconds_in(bracket[1]) is not None)


def _check_count(stated: Stated, column: Floats, total: int, asked: _Asked) -> None:
    """Refuse another count than the header states where it is that of all the numbers."""
    if stated.is_count(total) and not stated.is_count(column.size):
        width, rows = total // max(1, column.size), column.size
        raise InputError("record-layout", asked.name, total, width=width, rows=rows, layout_field=asked.field)


def _warnings(stated: Stated, column: Floats, name: str) -> tuple[Notice, ...]:
    labelled = {count.value for count in stated.counts if count.unit != IN_A_SENTENCE}
    if labelled and not stated.is_count(column.size):
        return counted(column, min(labelled, key=lambda count: abs(count - column.size)), name)
    # The wrong ones of several are named; small numbers of points in sentences are of something else.
    in_sentences = {count.value for count in stated.counts} if not stated.is_count(column.size) else set()
    others = sorted(labelled | {count for count in in_sentences if count > _FEW})
    return tuple(doubtful(name, COUNT, stated=other, found=column.size) for other in others if other != column.size)


def _about(header: list[str]) -> tuple[dict[str, str], tuple[str, ...]]:
    about = {}
    for line in header:
        if match := _ABOUT.match(line):
            label = match[1].lower()
            about[_CALLED.get(label, label)] = match[2].strip(" ,;")
    processing = (about.pop("processing"),) if "processing" in about else ()
    return about, processing


def _factor(header: list[str], name: str, field: str) -> float | None:
    """Return the factor other than 1 that a header has: whether the values contain it is unknown."""
    for line in header:
        for match in () if _ABOUT.match(line) else _FACTOR.finditer(line):
            value = match[1] or match[2]
            if value is None:
                raise InputError("record-factor", name, repr(match[0]), factor_field=field)
            if real(value) != 1.0:
                return real(value)
    return None


def _time_unit(time_name: str, header: list[str], name: str) -> tuple[str, float]:
    """Return the unit in which the header states the times, and how many seconds it has; seconds without one."""
    for line in (time_name, *header):
        if match := _TIME_IN.search(folded(line)):
            unit = match[1] or match[2]
            size = seconds_in(unit)
            if size is None and match[1] is None:
                raise InputError("record-time-unit", name, repr(unit))
            if size is not None:
                return unit, size
    return "s", 1.0


def _clock(time: Floats | None, time_name: str, header: list[str], stated: Stated, name: str) -> _Clock:
    if time is None:
        return _Clock(None, stated.step(name))
    processing: tuple[str, ...] = ()
    unit, seconds = _time_unit(time_name, header, name)
    if seconds != 1.0:
        # Thousandths are divided, so that 20 ms are 0.02 s to the last bit.
        time = time / (1.0 / seconds) if seconds < 1.0 else time * seconds
        processing = (f"time read in {unit}",)
    elif time.size > _FEW and (np.diff(time) == 1.0).all():
        return _Clock(None, stated.step(name), ("the first column counts the samples",), counts=True)
    if stated.step(name) is None or time.size < 2:
        return _Clock(time, None, processing)
    with np.errstate(invalid="ignore", over="ignore"):
        mean, middle = float((time[-1] - time[0]) / (time.size - 1)), median(np.diff(time))
    for step in stated.steps:
        if any(abs(step.value - found) <= _SAME_STEP * found for found in (mean, middle)):
            return _Clock(time, step.value, processing)
    raise InputError("record-step-differs", name, f"{stated.steps[0].value:g} s", found=f"{middle:g} s")


def _series(table: _Table, header: list[str], name: str) -> list[tuple[Floats, str, str | None]]:
    """The accelerations among columns, each with its direction and its unit."""
    unit = unit_of(header)
    if len(table.columns) == 1:
        own = units_in(table.names[0])
        if len(own) == 1:
            unit = _agreed(own, header)
        quantity = other_quantity(header) or (None if unit else quantity_of(table.names[0]))
        if quantity:
            raise InputError("record-not-acceleration", name, quantity)
        return [(table.columns[0], "", unit)]
    quantities = [quantity_of(column_name) for column_name in table.names]
    kept = [
        (values, direction_in(column_name), _agreed(units_in(column_name), header) if units_in(column_name) else unit)
        for values, column_name, quantity in zip(table.columns, table.names, quantities, strict=True)
        if quantity is None
    ]
    if not kept:
        raise InputError(
            "record-not-acceleration", name, " and ".join(sorted({quantity or "" for quantity in quantities}))
        )
    return kept


def _agreed(own: set[str], header: list[str]) -> str | None:
    """Return the unit in the name of a column, where no line that speaks of units names another one alone."""
    said = units_of([line for line in header if re.search(r"unit|einheit|unid|birim", folded(line))])
    if len(own) != 1 or (said and said.isdisjoint(own)):
        return None
    return next(iter(own))


def _check_sides(series: list[tuple[Floats, str, str | None]], explained: bool, name: str) -> None:
    """Refuse numbers of one sign whose quantity is not stated: the ground shakes to and fro."""
    for values, _, _ in series:
        if not explained and values.size > _FEW and (values.min() >= 0.0 or values.max() <= 0.0) and values.any():
            raise InputError("record-one-sided", name)


def _with_points(lines: list[str], name: str, first_line: int) -> tuple[list[str], bool]:
    """Return lines of data with points for decimal commas, which semicolons, tabs or blanks beside them give away, and
    whether there were any.

    Parameters
    ----------
    lines
        Lines of data.
    name
        Of the file, for errors.
    first_line
        Number of the first of them in the file, for errors.

    Raises
    ------
    InputError
        Where a comma may mean one thing or another.
    """
    if not any("," in line for line in lines):
        return lines, False
    texts = [line.split("#")[0].replace('"', "") for line in lines]
    if _is_one_column(texts, name, first_line):
        return [text.replace(",", ".") for text in texts], True
    if not any(_has_decimal_comma(text) for text in texts):
        return lines, False
    surely = False
    for number, (line, text) in enumerate(zip(lines, texts, strict=True), first_line):
        parting = r"\s+" if _BLANK_CELLS.fullmatch(text) else r"[;\t]"
        cells = [cell for cell in re.split(parting, text) if cell.strip()]
        if not all(_CELL.fullmatch(cell) for cell in cells):
            raise InputError("record-comma", name, repr(line.strip()[:30]), line=number)
        surely = surely or any("," in cell and not _THOUSANDS.fullmatch(cell) for cell in cells)
    if not surely:
        raise InputError("record-comma", name, repr(lines[0].strip()[:30]), line=first_line)
    return [text.replace(",", ".") for text in texts], True


def _is_one_column(texts: list[str], name: str, first_line: int) -> bool:
    """Whether lines of two whole numbers with a comma between are one column of decimal commas.

    Two columns of whole numbers have times, or numbers of rows, in front, which grow from row to row.

    Raises
    ------
    InputError
        Where the commas may part thousands.
    """
    cells = [text.strip().rstrip(";") for text in texts if text.strip()]
    pairs = [_LONE.fullmatch(cell) for cell in cells]
    if len(cells) < 3 or not all(
        pair or re.fullmatch(r"[-+]?\d+", cell) for cell, pair in zip(cells, pairs, strict=True)
    ):
        return False
    front = [int(pair[1]) for pair in pairs if pair]
    if len(front) < 3 or all(late > early for early, late in pairwise(front)):
        return False
    if all(_THOUSANDS.fullmatch(cell) for cell, pair in zip(cells, pairs, strict=True) if pair):
        raise InputError("record-comma", name, repr(cells[0][:30]), line=first_line)
    return True


def _has_decimal_comma(text: str) -> bool:
    text = text.strip()
    if _BLANK_CELLS.fullmatch(text):
        return True
    return (";" in text or "\t" in text) and _DECIMAL_COMMA.search(text) is not None
