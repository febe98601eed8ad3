"""Disaggregation of a hazard by magnitude and distance, as OpenQuake exports it: which earthquakes make the hazard."""

from __future__ import annotations

import csv
import math
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

from heeltoe.base.input_files import read_bounded
from heeltoe.errors.error import InputError, shown
from heeltoe.motion.openquake import is_of_openquake
from heeltoe.motion.targets import file_of_target

_LARGEST = 50_000_000
_YEARS = re.compile(r"investigation_time=([\d.]+)")
_EDGES = {"mag": re.compile(r"mag_bin_edges=\[([^\]]*)\]"), "dist": re.compile(r"dist_bin_edges=\[([^\]]*)\]")}
_WEIGHTS = re.compile(r"weights=\[([^\]]*)\]")
_OF_BRANCH = re.compile(r"rlz\d+")


@dataclass(frozen=True)
class Disaggregation:
    """Annual rates at which earthquakes of bins of magnitude and distance make the ground exceed a level.

    Attributes
    ----------
    magnitudes, distances
        Edges of the bins, ascending; distances [km].
    rates
        Annual rate of each bin that has one, by its places among both edges [1/year].
    """

    magnitudes: Sequence[float]
    distances: Sequence[float]
    rates: Mapping[tuple[int, int], float]

    @property
    def rate(self) -> float:
        """Annual rate at which the level is exceeded [1/year]."""
        return math.fsum(self.rates.values())

    def share_of(self, magnitude: float, distance: float) -> float:
        """Return which part of the rate is of earthquakes in the same bin; the distance in m."""
        place = _place(magnitude, self.magnitudes), _place(distance / 1e3, self.distances)
        return self.rates.get(place, 0.0) / self.rate

    def mean(self) -> tuple[float, float]:
        """Return mean magnitude and distance [m] over the middles of the bins, by their rates."""
        middles = [[0.5 * sum(pair) for pair in pairwise(edges)] for edges in (self.magnitudes, self.distances)]
        magnitude, distance = (
            math.fsum(rate * middles[axis][place[axis]] for place, rate in self.rates.items()) / self.rate
            for axis in (0, 1)
        )
        return magnitude, 1e3 * distance


def read_disaggregation(text: str, directory: Path, field: str) -> Disaggregation:
    """Return the disaggregation of a file.

    Parameters
    ----------
    text
        The file, relative to the directory; ``FILE#PGA,0.02`` names one of several measures and probabilities.
    directory
        Where relative paths start.
    field
        Field of the case, for errors.

    Raises
    ------
    InputError
        Where there is no such file, it is none of OpenQuake's by magnitude and distance, or holds several.
    """
    name, wanted = file_of_target(text, directory)
    path = directory / os.path.expanduser(name)
    try:
        content = read_bounded(path, _LARGEST).decode("utf-8")
    except FileNotFoundError:
        raise InputError("source-missing", field, expected=_EXPECTED) from None
    except (OSError, ValueError):
        raise InputError("disaggregation", field, shown(name)) from None
    rows = [row for row in csv.reader(content.splitlines()) if row]
    comment = ",".join(rows[0]) if rows else ""
    years, head = _YEARS.search(comment), [cell.strip() for cell in rows[1]] if len(rows) > 2 else []
    edges = {axis: _numbers(pattern.search(comment)) for axis, pattern in _EDGES.items()}
    if not is_of_openquake(content) or years is None or not {"mag", "dist"} <= set(head) or not all(edges.values()):
        raise InputError("disaggregation", field, shown(name))
    columns = _columns(head, comment, field, name)
    cells = [dict(zip(head, row, strict=False)) for row in rows[2:]]
    known = list(dict.fromkeys(_level(row) for row in cells))
    chosen = [level for level in known if not wanted or _same(level, wanted)]
    if len(chosen) != 1:
        raise InputError("disaggregation-several", field, shown(text), known=", ".join(known))
    try:
        rates: dict[tuple[int, int], float] = {}
        for row in cells:
            if _level(row) == chosen[0]:
                place = _place(float(row["mag"]), edges["mag"]), _place(float(row["dist"]), edges["dist"])
                # A bin's probability is that of a Poisson process.
                rate = math.fsum(-weight * math.log1p(-float(row[column])) for column, weight in columns.items())
                rates[place] = rates.get(place, 0.0) + rate / float(years[1])
        found = Disaggregation(edges["mag"], edges["dist"], rates)
        if not 0.0 < found.rate < math.inf:
            raise ValueError("no rate")
    except (KeyError, ValueError):
        raise InputError("disaggregation", field, shown(name)) from None
    return found


_EXPECTED = "OpenQuake's CSV of a disaggregation by magnitude and distance, Mag_Dist"


def _columns(head: Sequence[str], comment: str, field: str, name: str) -> dict[str, float]:
    """Return the columns of probabilities with their weights: the mean, or the branches of the logic tree."""
    if "mean" in head:
        return {"mean": 1.0}
    branches = [cell for cell in head if _OF_BRANCH.fullmatch(cell)]
    weights = _numbers(_WEIGHTS.search(comment)) if len(branches) > 1 else [1.0]
    if not branches or len(weights) != len(branches):
        raise InputError("disaggregation", field, shown(name))
    return {branch: weight / sum(weights) for branch, weight in zip(branches, weights, strict=True)}


def _level(row: Mapping[str, str]) -> str:
    """Return the measure and the probability of a row, as a text names them."""
    return f"{row.get('imt', '')},{_plain(row.get('poe', ''))}"


def _same(level: str, wanted: str) -> bool:
    measure, _, probability = wanted.rpartition(",")
    return level == f"{measure},{_plain(probability)}"


def _plain(number: str) -> str:
    try:
        return f"{float(number):g}"
    except ValueError:
        return number


def _numbers(found: re.Match[str] | None) -> list[float]:
    try:
        return [] if found is None else [float(text) for text in found[1].split(",")]
    except ValueError:
        return []


def _place(value: float, edges: Sequence[float]) -> int:
    """Return which bin has a value; -1 beyond the edges."""
    return next((place for place, (low, high) in enumerate(pairwise(edges)) if low <= value < high), -1)
