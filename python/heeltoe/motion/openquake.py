"""Spectra as OpenQuake exports them: uniform hazard, conditional mean and median spectra, in g over periods."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Mapping, Sequence

from heeltoe.errors.error import InputError, shown

_GENERATED = re.compile(r"^#.*(?:generated_by='OpenQuake|investigation_time=)")
_SPREAD = re.compile(r"kind='std'")
_YEARS = re.compile(r"investigation_time=([\d.]+)")
_LEVELS = re.compile(r"imls=\[([^\]]*)\]")
_UNIFORM = re.compile(r"([\d.eE+-]+)~(PGA|SA\(([\d.]+)\))")
# Where a conditional spectrum is known, it hardly spreads; so near it is the level that it was made for.
_KNOWN, _SAME = 0.01, 0.02
# As near are two probabilities that are one.
_ONE = 1e-6

#: Periods [s] and pseudo-accelerations [g].
Spectrum = list[tuple[float, float]]


def is_of_openquake(text: str) -> bool:
    """Whether a file opens as OpenQuake's exports do."""
    return _GENERATED.match(text.partition("\n")[0]) is not None


def spectrum_of_openquake(text: str, name: str, wanted: str) -> tuple[Spectrum, str]:
    """Return the spectrum of one site and one probability of exceedance, and what it is.

    Parameters
    ----------
    text
        The file.
    name
        Of it, for errors.
    wanted
        The probability of exceedance; empty where the file has one alone.

    Raises
    ------
    InputError
        Where the file has no spectrum, or those of several sites or probabilities, or contradicts itself.
    """
    rows = [row for row in csv.reader(text.splitlines()) if row]
    comment = ",".join(rows[0])
    if len(rows) < 3:
        raise InputError("target-table", name)
    if _SPREAD.search(comment):
        raise InputError("target-spread", name)
    head, body = [cell.strip() for cell in rows[1]], rows[2:]
    try:
        if any(_UNIFORM.fullmatch(cell) for cell in head):
            spectra, kind = _uniform(head, body, name), "uniform hazard spectrum"
        elif {"poe", "period", "mea"} <= set(head):
            spectra, kind = _conditional(head, body, name), "conditional mean spectrum"
        elif "sa_period" in head:
            levels = _LEVELS.search(comment)
            spectra, kind = _early_conditional(head, body, levels[1] if levels else "", name), "conditional spectrum"
        elif {"period", "spec"} <= set(head):
            at, of = head.index("period"), head.index("spec")
            spectra, kind = {"": [(float(row[at]), float(row[of])) for row in body]}, "median spectrum"
        else:
            raise InputError("target-table", name)
    except (ValueError, IndexError):
        raise InputError("target-table", name) from None
    chosen = _chosen(spectra, wanted, name)
    said = f" of {chosen}" if chosen else ""
    if chosen and (match := _YEARS.search(comment)):
        years = float(match[1])
        said += f" in {years:g} year{'s' * (years != 1.0)}"
    spectrum = sorted(spectra[chosen])
    # A level that no earthquake reaches is exported as zero.
    while spectrum and spectrum[-1][1] == 0.0:
        spectrum.pop()
    return spectrum, f"{kind}{said}"


def _uniform(head: Sequence[str], body: Sequence[Sequence[str]], name: str) -> dict[str, Spectrum]:
    """Return the spectra of a site by their probabilities."""
    if len(body) > 1:
        raise InputError("several", name, f"{len(body)}", things="curves", how="of the site")
    spectra: dict[str, Spectrum] = {}
    for cell, value in zip(head, body[0], strict=True):
        if match := _UNIFORM.fullmatch(cell):
            spectra.setdefault(match[1], []).append((float(match[3] or 0.0), float(value)))
    return spectra


def _conditional(head: Sequence[str], body: Sequence[Sequence[str]], name: str) -> dict[str, Spectrum]:
    """Return the mean spectra by their probabilities."""
    places = {cell: place for place, cell in enumerate(head)}
    kinds = {row[places["stat"]] for row in body} if "stat" in places else set()
    if len(kinds) > 1 and "mean" not in kinds:
        raise InputError(
            "several", name, ", ".join(sorted(kinds)), things="spectra", how="as in the rows of one of them"
        )
    spectra: dict[str, Spectrum] = {}
    for row in body:
        if len(kinds) < 2 or row[places["stat"]] == "mean":
            spectrum = spectra.setdefault(f"{float(row[places['poe']]):g}", [])
            spectrum.append((float(row[places["period"]]), float(row[places["mea"]])))
    return spectra


def _early_conditional(
    head: Sequence[str], body: Sequence[Sequence[str]], levels: str, name: str
) -> dict[str, Spectrum]:
    """Return the spectra of an engine before 3.17 by the levels that they are conditional on, where they meet them."""
    at, spectra = head.index("sa_period"), dict[str, Spectrum]()
    for number, level in enumerate(float(text) for text in levels.split(",") if text.strip()):
        of, spread = head.index(f"val{number}"), head.index(f"std{number}")
        known = min(body, key=lambda row: float(row[spread]))
        if float(known[spread]) < _KNOWN and abs(float(known[of]) / level - 1.0) > _SAME:
            raise InputError("target-level", name, f"{float(known[of]):.4g} g", stated=f"{level:.4g} g")
        spectra[f"{level:.6g} g"] = [(float(row[at]), float(row[of])) for row in body]
    return spectra


def _chosen(spectra: Mapping[str, Spectrum], wanted: str, name: str) -> str:
    """Return which of several spectra is wanted."""
    if not wanted and len(spectra) == 1:
        return next(iter(spectra))
    found = [key for key in spectra if key == wanted or _are_one(key, wanted)]
    if len(found) != 1:
        names = ", ".join(spectra)
        raise InputError(
            "several", name, names, things="spectra", how=f"""as in {shown(f"{name}#{next(iter(spectra), '')}")}"""
        )
    return found[0]


def _are_one(key: str, wanted: str) -> bool:
    try:
        return math.isclose(float(key.removesuffix(" g")), float(wanted.removesuffix(" g")), rel_tol=_ONE)
    except ValueError:
        return False
