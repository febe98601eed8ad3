"""A case with several cracks: each by itself, from the crest down, and what does not go with several."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from typing import TYPE_CHECKING

from heeltoe.errors import InputError, shown

if TYPE_CHECKING:
    from heeltoe.case.model import Case

# Cracks nearer to each other than this part of the height of the section leave no part of the dam between them.
_NEAREST = 1e-3


def many_cracks(case: Case) -> Iterator[InputError]:
    """Walk what of a case does not go with several cracks."""
    if not case.further_cracks:
        return
    other = "further_cracks"
    options = case.flexible
    for name in ("anchors", "aftershocks"):
        if getattr(case, name):
            yield InputError("one-crack-only", name, other=other)
    if case.uplift.during_shaking != "constant":
        yield InputError("one-crack-value", "uplift.during_shaking", shown(case.uplift.during_shaking), other=other)
    for name, unfit in (("contact", "idce"), ("damping", "thesis"), ("virtual_mass", "thesis")):
        value = getattr(options, name)
        if value == unfit:
            yield InputError("one-crack-value", f"flexible.{name}", shown(value), other=other)
    for name in ("mesh_above", "mesh_below"):
        if getattr(options, name) is not None:
            yield InputError("one-crack-only", f"flexible.{name}", other=other)


def places_of(case: Case) -> tuple[tuple[Case, ...], int]:
    """Return the case with each of its cracks alone, from the crest down, and which of them is that of ``[crack]``.

    Raises
    ------
    InputError
        Where a crack does not cut the section in two, or two meet or cross.
    """
    if not case.further_cracks:
        return (case,), 0
    alone = case.model_copy(update={"further_cracks": ()})
    found = [(alone, "crack")]
    for place, crack in enumerate(case.further_cracks):
        update = {"crack": crack.beside(case.crack), "uplift": crack.wet(case.uplift)}
        found.append((alone.model_copy(update=update), f"further_cracks[{place}]"))
    found.sort(key=lambda each: -_cut(*each)[0])
    for (upper, above), (lower, below) in pairwise(found):
        least = _NEAREST * (upper.cut.crest_elevation - upper.cut.base_elevation)
        if any(high - low < least for high, low in zip(_cut(upper, above), _cut(lower, below), strict=True)):
            later = max(above, below, key=lambda name: (name != "crack", name))
            one, other = f"{upper.crack.elevation:g} m", f"{lower.crack.elevation:g} m"
            raise InputError("cracks-meet", f"{later}.elevation", one, other=other, least=f"{least:g} m")
    cases = tuple(each for each, _ in found)
    return cases, [name for _, name in found].index("crack")


def _cut(case: Case, field: str) -> tuple[float, float]:
    """Return the elevations of both ends of the only crack of a case."""
    try:
        section = case.cut
    except InputError as error:
        if field == "crack":
            raise
        elevation = f"{case.crack.elevation:g} m"
        raise InputError("section-misfit", f"{field}.elevation", elevation, reason=error) from None
    return section.heel[1], section.toe[1]


def one_crack(case: Case, model: str) -> None:
    """Refuse a case with several cracks for what knows one alone.

    Raises
    ------
    InputError
        Then.
    """
    if case.further_cracks:
        raise InputError("several-cracks", "further_cracks", model=model)
