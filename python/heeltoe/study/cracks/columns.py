"""Several cracks in a study: what their columns are called, what stands in them, and what cannot be studied."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import NamedTuple

from heeltoe.arrays import Floats
from heeltoe.case.at_crack import one_crack
from heeltoe.case.crack.kinks import straight_crack
from heeltoe.case.model import Case
from heeltoe.models.rigid.stack.model import check_stack
from heeltoe.result.contract import HEADLINES


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
        straight_crack(case, "a study of blocks")
    if case.further_cracks and "decoupled" in models:
        one_crack(case, "the decoupled chain")
    if case.further_cracks and "rigid" in models:
        check_stack(case)


def columns_of_cracks(cracks: int) -> tuple[str, ...]:
    """Return the names of the headline numbers of each of several cracks; none of a single one."""
    places = range(cracks) if cracks > 1 else ()
    return tuple(column_of(place, each.key) for place in places for each in HEADLINES)


def column_of(place: int, key: str) -> str:
    """Return what a headline number of a crack is called, as in the JSON of a run: cracks count from the crest down."""
    return f"cracks[{place}].{key}"
