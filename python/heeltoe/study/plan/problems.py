"""Errors of a study, gathered so that all are shown at once."""

from __future__ import annotations

from types import TracebackType

from heeltoe.errors.error import InputError


class Problems:
    """Keeps the errors that are raised in its ``with`` blocks, and goes on behind them."""

    def __init__(self) -> None:
        self._errors: dict[str, InputError] = {}

    def __enter__(self) -> None:
        return None

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> bool:
        if not isinstance(error, InputError):
            return False
        for problem in (error, *error.others):
            self._errors.setdefault(str(problem), problem)
        error.others = ()
        error.__dict__.pop("__notes__", None)
        return True

    def tell(self) -> None:
        """Raise what is wrong, if anything is.

        Raises
        ------
        InputError
            The first problem, with the others.
        """
        if self._errors:
            error, *others = self._errors.values()
            raise error.with_others(others)
