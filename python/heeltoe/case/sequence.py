"""A file may give a motion and its aftershocks as one list, ``[[motion]]``; a case has them apart."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from heeltoe.errors import InputError

# Not at run time: a case is read with what stands here.
if TYPE_CHECKING:
    from heeltoe.case.model import Case


def with_motions_apart(fields: Mapping[str, Any]) -> dict[str, Any]:
    """Return the fields of a case with the first motion of a list as `motion` and the others as `aftershocks`.

    Raises
    ------
    InputError
        Where there are aftershocks beside such a list.
    """
    given = fields.get("motion")
    if not isinstance(given, list) or not given or not all(isinstance(each, Mapping) for each in given):
        return dict(fields)
    if "aftershocks" in fields:
        raise InputError("fields-conflict", "motion", other="aftershocks")
    first, *others = given
    return {**fields, "motion": first, **({"aftershocks": others} if others else {})}


def turned_round(case: Case) -> dict[str, Any]:
    """Return the changes that turn round all motions of a case."""
    if case.motion is None:
        return {}
    changes: dict[str, Any] = {"motion.reverse": not case.motion.reverse}
    if case.aftershocks:
        turned = [each.model_copy(update={"reverse": not each.reverse}) for each in case.aftershocks]
        changes["aftershocks"] = [each.model_dump(mode="json", exclude_unset=True) for each in turned]
    return changes
