"""Several cracks in a study: what their columns are called, what stands in them, and what cannot be studied."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import NamedTuple

from heeltoe.base.arrays import Floats
from heeltoe.case.combinations import check
from heeltoe.case.model import Case
from heeltoe.result.contract import CRACKED, HEADLINES


class OfCrack(NamedTuple):
    """Headline numbers at a crack in some runs, (n,) by name, and how wide it is [m]."""

    named: Mapping[str, Floats]
    width: Floats


def check_cracks(case: Case, models: Collection[str]) -> None:
    """Refuse cracks that a study, or one of its models, does not know.

    Raises
    ------
    InputError
        Then.
    """
    if set(models) != {"flexible"}:
        check(case, "study")
    for model in models:
        check(case, model)


def columns_of_cracks(cracks: int) -> tuple[str, ...]:
    """Return the names of the headline numbers of each of several cracks; none of a single one."""
    places = range(cracks) if cracks > 1 else ()
    return tuple(column_of(place, headline.key) for place in places for headline in HEADLINES)


def numbers_of_cracks(cracks: int) -> tuple[str, ...]:
    """Return the names of all numbers of each of several cracks that the runs of a study have."""
    places = range(cracks) if cracks > 1 else ()
    return (*columns_of_cracks(cracks), *(column_of(place, CRACKED) for place in places))


def column_of(place: int, key: str) -> str:
    """Return what a headline number of a crack is called, as in the JSON of a run: cracks count from the crest down."""
    return f"cracks[{place}].{key}"
