"""Containers that cannot be changed, and can be pickled and copied: those of results."""

from __future__ import annotations

from collections.abc import ItemsView, Iterator, Mapping
from typing import Any, NoReturn

import numpy as np


class ReadOnlyArrays:
    """Holds arrays that cannot be written to, nor can those of its copies."""

    def __post_init__(self) -> None:
        """Take the arrays as views that are read-only."""
        for name, value in vars(self).items():
            if isinstance(value, np.ndarray):
                object.__setattr__(self, name, _read_only(value))
            elif isinstance(value, tuple) and any(isinstance(item, np.ndarray) for item in value):
                object.__setattr__(self, name, tuple(map(_read_only, value)))

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take what was pickled or copied; arrays come back as ones that can be written to."""
        vars(self).update(state)
        ReadOnlyArrays.__post_init__(self)


def _read_only(value: Any) -> Any:
    if not isinstance(value, np.ndarray) or not value.flags.writeable:
        return value
    view = value.view()
    view.flags.writeable = False
    return view


class FrozenDict(Mapping[str, Any]):
    """A mapping of names to values; its arrays are read-only."""

    __slots__ = ("_values",)

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = dict(values)
        for name, value in values.items():
            if isinstance(value, np.ndarray):
                # An array becomes a view.
                self._values[name] = view = value.view()
                view.flags.writeable = False
            elif type(value) is list:
                self._values[name] = FrozenList(value)

    def __getitem__(self, name: str) -> Any:
        return self._values[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._values)

    def __len__(self) -> int:
        return len(self._values)

    def items(self) -> ItemsView[str, Any]:
        """Return names and values."""
        return self._values.items()

    def __repr__(self) -> str:
        return repr(self._values)

    def __reduce__(self) -> tuple[type, tuple[dict[str, Any]]]:
        return type(self), (self._values,)


class FrozenList(list[Any]):
    """A list that cannot be changed, equal to a list of the same items."""

    def _refuse(self, *_: object, **__: object) -> NoReturn:
        raise TypeError("a result cannot be changed")

    append = extend = insert = remove = pop = clear = sort = reverse = _refuse
    __setitem__ = __delitem__ = __iadd__ = __imul__ = _refuse

    def __reduce__(self) -> tuple[type, tuple[list[Any]]]:
        return type(self), (list(self),)
