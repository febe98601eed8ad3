"""The desk that every action works at: its session, the workers, the settings, and a way to tell the tab."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

from heeltoe.app.jobs import Tell
from heeltoe.app.sessions import Session
from heeltoe.app.settings import Settings
from heeltoe.app.workers import Workers
from heeltoe.base.payload import Json

Request = dict[str, Any]


@dataclass(frozen=True)
class Desk:
    """Context of an action.

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
Action = Callable[[Desk, Request], Awaitable[Json]]


@dataclass(frozen=True)
class Entry:
    """An action, and what becomes of it when the tab asks for it again before its answer.

    Attributes
    ----------
    action
        What computes the answer.
    newest
        Whether of several that wait only the newest is worth an answer, as of a slider that moves.
    replaced
        Whether it is cancelled, and the new one begins at once.
    writes
        Whether it makes files, for which there must be room.
    """

    action: Action
    newest: bool = False
    replaced: bool = False
    writes: bool = False


class BadRequestError(Exception):
    """A message that no page of this app sends."""


def number(request: Request, name: str) -> float:
    """Return a finite number of a message.

    Raises
    ------
    BadRequestError
        Where there is none.
    """
    value = request.get(name)
    if isinstance(value, bool) or not isinstance(value, int | float) or not abs(value) < 1e300:
        raise BadRequestError(f"{name} is a number")
    return float(value)


def text(request: Request, name: str) -> str:
    """Return a text of a message.

    Raises
    ------
    BadRequestError
        Where there is none.
    """
    value = request.get(name)
    if not isinstance(value, str):
        raise BadRequestError(f"{name} is a text")
    return value
