"""What a tab can ask for, by name. A new page adds its module to the list at the end."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

from heeltoe.app.jobs import Tell
from heeltoe.app.sessions import Session
from heeltoe.app.settings import Settings
from heeltoe.app.workers import Workers

Asked = dict[str, Any]


@dataclass(frozen=True)
class Desk:
    """What an action has at hand.

    Attributes
    ----------
    session
        Of the tab that asks.
    workers
        Where to compute: never in the action itself, which holds up all tabs.
    settings
        What the server allows.
    tell
        Sends the tab a message beside the answer.
    """

    session: Session
    workers: Workers
    settings: Settings
    tell: Tell


#: Takes what is asked and returns the answer.
Action = Callable[[Desk, Asked], Awaitable[dict[str, Any]]]


@dataclass(frozen=True)
class Entry:
    """An action, and whether only the newest of several that wait is worth an answer, as of a slider that moves."""

    action: Action
    newest: bool = False


class BadRequestError(Exception):
    """A message that no page of this app sends."""


def number(asked: Asked, name: str) -> float:
    """Return a finite number of a message.

    Raises
    ------
    BadRequestError
        Where there is none.
    """
    value = asked.get(name)
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < 1e300:
        raise BadRequestError(f"{name} is a number")
    return float(value)


def text(asked: Asked, name: str) -> str:
    """Return a text of a message.

    Raises
    ------
    BadRequestError
        Where there is none.
    """
    value = asked.get(name)
    if not isinstance(value, str):
        raise BadRequestError(f"{name} is a text")
    return value


def actions() -> dict[str, Entry]:
    """Return all of them."""
    from heeltoe.app import answer, checks, open_case
    from heeltoe.app.away import actions as away
    from heeltoe.app.case import actions as case
    from heeltoe.app.motion import actions as motion
    from heeltoe.app.studies import actions as studies

    found: dict[str, Entry] = {}
    for module in (open_case, case, motion, answer, checks, studies, away):
        found |= module.ACTIONS
    return found
