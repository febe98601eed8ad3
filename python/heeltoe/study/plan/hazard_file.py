"""Files of hazard curves: two columns that their headings describe, OpenQuake's CSV, NSHMP's CSV and JSON."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from heeltoe.base.input_files import read_csv_rows, reason_of
from heeltoe.errors.error import InputError, shown
from heeltoe.units.parse import parse, parse_acceleration, plain_number

# Bytes; no curve comes near.
_LARGEST = 1_000_000
_UNIT = re.compile(r"\[([^\[\]]+)\]|\(([^()]+)\)")
_YEARS = re.compile(r"(\d+(?:\.\d+)?)[\s-]*(?:years?|yrs?|y|a)\b")
_PERIOD = re.compile(r"^sa\D{0,3}(\d*\.?\d+)")
_PROBABILITY = re.compile(r"\b(?:poes?|pe|aep|prob\w*)\b")
_RATE = re.compile(r"\b(?:rates?|afe|maf|mafe|frequency|freq|lambda)\b|1/(?:yr|year|a)\b")
# Words that make another number of a rate, of a probability, or of a strength.
_LOGARITHM = re.compile(r"\b(?:log\s?_?(?:10|e)?|ln)(?:\b|(?=[\s_(\[]|pga|pgv|sa|afe))")
_OTHER = re.compile(
    r"non[\s-]?exceed|densit|occurrence|\b10\s?(?:\^|\*\*|-\d|e-?\d)|/\s?(?:day|d|week|month)\b"
    r"|\b(?:per|a) (?:day|week|month|\d+)|\b(?:daily|weekly|monthly)\b"
)
_ANY_PERIOD = re.compile(r"\bt\s?=\s?(\d*\.?\d+)|\bp?sa\b\D{0,3}(\d*\.?\d+)?")
_OQ_TIME = re.compile(r"investigation_time=([\d.]+)")
_OQ_MEASURE = re.compile(r"imt='([^']+)'")
# Spectral ordinates of OpenQuake and of NSHMP are in g, velocities in cm/s.
_UNITS = {"pgv": "cm/s"}
#: Strengths with their units, and the annual rates at which they are exceeded.
Pairs = list[tuple[str, float]]


def read_pairs(path: Path, field: str, quantity: str, measure: str, period: float | None) -> Pairs:
    """Return the hazard curve of a file.

    Parameters
    ----------
    path
        The file.
    field
        What errors call it.
    quantity
        What a strength is, a key of :data:`heeltoe.units.parse.DIMENSIONS`.
    measure, period
        Of strength: those of the fragility curves; the period [s] of ``"sa"``.

    Returns
    -------
    Pairs
        In the order of the file. Strengths that are always or never exceeded have no place on a curve and are left out
        at its ends.

    Raises
    ------
    InputError
        Where the file cannot be read, has another measure, or does not say what its numbers are.
    """
    try:
        name, stated, pairs = (
            _of_json(path, field) if path.suffix.lower() == ".json" else _of_csv(path, field, quantity)
        )
    except InputError:
        raise
    except (OSError, ValueError) as error:
        raise InputError(
            "file-unreadable",
            "hazard.file",
            shown(str(path)),
            reason=reason_of(error),
            expected="a CSV file, relative to the study file",
        ) from None
    found = _measure_of(name)
    # A heading may be silent about the measure; a file of OpenQuake or NSHMP names it, such as CAV or AvgSA(0.5).
    if (found is None and stated) or (
        found is not None and (found[0] != measure or (found[1] and period and not math.isclose(found[1], period)))
    ):
        wanted = measure if period is None or measure != "sa" else f"sa at {period:g} s"
        raise InputError("hazard-measure", field, shown(name), measure=wanted)
    first = next((k for k, (_, rate) in enumerate(pairs) if rate < math.inf), 0)
    last = next((k for k in range(len(pairs), 0, -1) if pairs[k - 1][1] != 0.0), len(pairs))
    return pairs[first:last]


def _of_csv(path: Path, field: str, quantity: str) -> tuple[str, bool, Pairs]:
    """Return what names the measure, whether that is its name alone, and the curve."""
    rows = read_csv_rows(path, _LARGEST)
    if rows and rows[0][0].startswith("#") and (time := _OQ_TIME.search(",".join(rows[0]))):
        return _of_openquake(rows, float(time[1]), field)
    header = rows[0] if rows else []
    unit = _unit_of(header[0], quantity) if header else None
    if header and _LOGARITHM.search(header[0].lower()):
        raise InputError("heading-logarithm", field, shown(header[0]))
    if unit is None:
        raise InputError("hazard-header", field)
    rate = _rate_of(header[1] if len(header) > 1 else "", field)
    pairs = [_pair(row, f"{field}: row {number}") for number, row in enumerate(rows[1:], start=1)]
    return header[0], False, [(f"{strength!r} {unit}", rate(value)) for strength, value in pairs]


def _of_openquake(rows: Sequence[Sequence[str]], years: float, field: str) -> tuple[str, bool, Pairs]:
    """Return the curve of one site from a file of hazard curves of OpenQuake's engine."""
    measure = _OQ_MEASURE.search(",".join(rows[0]))
    if measure is None or len(rows) < 3:
        raise InputError("hazard-header", field)
    if len(rows) > 3:
        raise InputError("several", field, f"{len(rows) - 2}", things="curves", how="of the site")
    unit = _UNITS.get(measure[1].lower(), "g")
    pairs = [
        (f"{strength!r} {unit}", _rate_of_probability(probability, years, field))
        for name, cell in zip(rows[1], rows[2], strict=False)
        if name.startswith("poe-")
        for strength, probability in [_pair((name.removeprefix("poe-"), cell), field)]
    ]
    return measure[1], True, pairs


def _of_json(path: Path, field: str) -> tuple[str, bool, Pairs]:
    """Return the total curve of a response of NSHMP's web service."""
    if path.stat().st_size > _LARGEST:
        raise ValueError(f"it is larger than {_LARGEST // 10**6} MB")
    try:
        response = json.loads(path.read_text("utf-8"))["response"]
        curves = response.get("hazardCurves", response)
        curves = curves if isinstance(curves, list) else [curves]
        if len(curves) != 1:
            raise InputError("several", field, f"{len(curves)}", things="curves", how="of the site")
        (curve,) = curves
        known: dict[str, Any] = curve.get("metadata", curve)
        total = next(data for data in curve["data"] if data.get("component", "Total") == "Total")
        values = total["values"]
        rate = _rate_of(known.get("ylabel", "Annual Frequency of Exceedance"), field)
        name = str(known["imt"]["value"])
        unit = _UNITS.get(name.lower(), "g")
        pairs = zip(values["xs"], values["ys"], strict=True)
        return name, True, [(f"{float(x)!r} {unit}", rate(float(y))) for x, y in pairs]
    except (KeyError, TypeError, AttributeError, StopIteration, RecursionError):
        raise ValueError("it is no response of NSHMP's hazard service") from None


def _unit_of(heading: str, quantity: str) -> str | None:
    """Return the unit in brackets, the last one where there are several; None where there is none."""
    for square, round_ in reversed(_UNIT.findall(heading)):
        unit = str(square or round_).strip()
        try:
            if quantity == "acceleration":
                parse_acceleration(f"1 {unit}", "hazard.file")
            else:
                parse(f"1 {unit}", quantity, "hazard.file")
        except InputError:
            if square:
                return unit
            continue
        return unit
    return None


def _measure_of(heading: str) -> tuple[str, float | None] | None:
    """Return the measure that a heading names, with its period [s]; None where it names none."""
    text = heading.strip().lower()
    if re.match(r"pga\b|peak ground acceleration", text):
        return "pga", None
    if re.match(r"pgv\b|peak ground velocity", text):
        return "pgv", None
    if match := _PERIOD.match(text.replace("(", " ").replace("p", ".")):
        return "sa", float(match[1])
    if match := _ANY_PERIOD.search(text):
        at = match[1] or match[2]
        return "sa", float(at) if at else None
    return ("sa", None) if "spectral acc" in text else None


def _rate_of(heading: str, field: str) -> Callable[[float], float]:
    """Return the function that makes annual rates of the numbers below a heading.

    A probability of p in N years is that of a Poisson process, a rate of -ln(1 - p) / N.
    """
    text = heading.lower().replace("_", " ")
    share = 0.01 if "%" in text or "percent" in text or "per cent" in text else 1.0
    years = _YEARS.search(text)
    if _LOGARITHM.search(text):
        raise InputError("heading-logarithm", field, shown(heading))
    if _OTHER.search(text):
        raise InputError("hazard-heading", field, shown(heading))
    if "return period" in text or re.match(r"(?:rp|t)\s*[\[(]", text):
        return lambda value: 1.0 / value if value else math.inf
    if _PROBABILITY.search(text) or (share != 1.0 and not _RATE.search(text)):
        span = float(years[1]) if years else 1.0 if re.search(r"annual|\baep\b|a year|per year", text) else None
        if span:
            return lambda value: _rate_of_probability(share * value, span, field)
    elif _RATE.search(text) and not years and share == 1.0:
        return lambda value: value
    raise InputError("hazard-heading", field, shown(heading))


def _rate_of_probability(probability: float, years: float, field: str) -> float:
    if not 0.0 <= probability <= 1.0:
        raise InputError("out-of-range", field, f"{probability:g}", bound="from 0 to 1, as probabilities are")
    if not years > 0.0:
        raise InputError("out-of-range", field, f"{years:g} years", bound="above 0 years, in which it is exceeded")
    return math.inf if probability == 1.0 else -math.log1p(-probability) / years


def _pair(row: Sequence[str], field: str) -> tuple[float, float]:
    try:
        strength, rate = row
        return plain_number(strength), plain_number(rate)
    except ValueError:
        raise InputError(
            "wrong-quantity",
            field,
            shown(", ".join(row)),
            kind="a strength with an annual rate",
            example="two numbers, 0.1, 0.01",
        ) from None
