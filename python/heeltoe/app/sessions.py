"""Memory of the server for each tab: its case and its files, for a limited time."""

from __future__ import annotations

import asyncio
import secrets
import shutil
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any

from heeltoe.app.settings import Settings
from heeltoe.base.payload import Json

if TYPE_CHECKING:
    from heeltoe.app.jobs import Job, Tell
    from heeltoe.app.state import Draft, Made, Offer
    from heeltoe.case.model import Case


@dataclass(eq=False)
class Session:
    """One tab.

    Attributes
    ----------
    name
        A secret between the tab and the server.
    folder
        Of its files.
    case
        As it was opened, without what the sliders change; None until one is.
    example
        Which of the examples it is; empty where it is none.
    changes
        What the sliders change, by the paths of the case.
    moved
        The sliders that were moved.
    stated, heard
        The number of the last state that its page was sent, and of the question that moved the sliders last before it.
    turn
        Held by whoever changes the case or its sliders: one after the other, as they were asked.
    units
        ``"si"`` or ``"us"``.
    draft
        The case as it was typed (`heeltoe.app.case.draft`), which is where a case is changed.
    sent
        Files that it has sent, by the names that they have in the case: the names that they have here.
    records
        What is in those of them that are records, by the same names.
    elastic
        What the elastic dam was left with by its last run without evidence, for the static checks.
    kept
        What else a page wants to find again, by names of its own.
    jobs
        Long runs, by their number.
    uploads
        How many files it has sent.
    offers
        Files that it may fetch once, by the secret in their address.
    kept_files
        The folder of its exported files, and the case that they are of.
    studies
        Its studies, by their number.
    open, tell
        Whether there is a tab, and what sends it a message.
    used
        When it was asked for last.
    """

    name: str
    folder: Path
    case: Case | None = None
    example: str = ""
    changes: dict[str, Any] = field(default_factory=dict)
    moved: frozenset[str] = frozenset()
    stated: int = 0
    heard: int = 0
    turn: asyncio.Lock = field(default_factory=asyncio.Lock)
    units: str = "si"
    draft: Draft | None = None
    sent: dict[str, str] = field(default_factory=dict)
    records: dict[str, Any] = field(default_factory=dict)
    elastic: dict[str, Any] | None = None
    kept: dict[str, Any] = field(default_factory=dict)
    jobs: dict[int, Job] = field(default_factory=dict)
    uploads: int = 0
    offers: dict[str, Offer] = field(default_factory=dict)
    kept_files: tuple[Path, str] | None = None
    studies: dict[int, Made] = field(default_factory=dict)
    open: bool = False
    tell: Tell | None = None
    used: float = field(default_factory=monotonic)

    @property
    def runs(self) -> bool:
        """Whether something runs for it."""
        return any(job.state == "running" for job in self.jobs.values())

    async def say(self, message: Json) -> None:
        """Tell the tab, if there is one: a run goes on while its tab is closed or loaded anew."""
        if self.open and self.tell is not None:
            await self.tell(message)

    def begin_as(self, other: Session) -> None:
        """Begin with the case of another tab, and with the files that it has sent."""
        self.example, self.units = other.example, other.units
        self.uploads = other.uploads
        self.changes, self.moved = dict(other.changes), other.moved
        self.case = other.case.based_in(self.folder) if other.case else None
        self.draft = replace(other.draft, case=self.case, undo=[], redo=[]) if other.draft else None
        for called, stored in other.sent.items():
            # Nothing changes such a file: a second name of it takes no room.
            (self.folder / stored).hardlink_to(other.folder / stored)
            self.sent[called] = stored
        self.records = dict(other.records)

    def close(self) -> None:
        """End what runs for it, and remove its files."""
        for job in self.jobs.values():
            job.cancel()
        for job in self.jobs.values():
            job.end()
        shutil.rmtree(self.folder, ignore_errors=True)


class TooManyError(Exception):
    """As many tabs are open as may be."""


class Sessions:
    """Tabs that the server remembers, limited in number and age.

    Parameters
    ----------
    settings
        How many, how long, and where their files are.
    """

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._sessions: dict[str, Session] = {}

    def get(self, name: str) -> Session | None:
        """Return the session of this name, where there is one."""
        self._forget()
        session = self._sessions.get(name)
        if session is not None:
            session.used = monotonic()
        return session

    def enter(self, name: str, *, again: bool = False, closed: str = "") -> Session:
        """Return the session of a tab that comes: the one it had, else that of the tab which this browser had closed
        last, else a new one.

        A tab that was doubled has the name of one that is open, and begins with its case; one that is loaded `again`
        goes on, though the server may not have seen yet that it was left.

        Raises
        ------
        TooManyError
            Where as many are open as may be.
        """
        session = self.get(name)
        goes_on = session is not None and (again or not session.open)
        if not goes_on and sum(session.open for session in self._sessions.values()) >= self._settings.most_open:
            limit = self._settings.most_open
            raise TooManyError(f"{limit} tabs are open, which is as many as can be: close one, and this page goes on.")
        if session is None and not name:
            left = self.get(closed)
            session = None if left is None or left.open else left
        if session is None or (session.open and not again):
            session = self._new(session)
        session.open = True
        return session

    def leave(self, session: Session, tell: Tell | None = None) -> None:
        """Note that a tab is closed, unless it has come back and receives its messages by another function than
        `tell`."""
        session.used = monotonic()
        if tell is not None and session.tell is not tell:
            return
        session.open = False

    def take(self, key: str) -> Offer | None:
        """Return what is behind a link, once."""
        return next((session.offers.pop(key) for session in self._sessions.values() if key in session.offers), None)

    def close(self) -> None:
        """Forget all."""
        for session in self._sessions.values():
            session.close()
        self._sessions.clear()

    def _new(self, like: Session | None) -> Session:
        name = secrets.token_urlsafe(24)
        folder = self._settings.folder / secrets.token_hex(8)
        folder.mkdir(mode=0o700, parents=True)
        session = Session(name, folder)
        if like is not None:
            session.begin_as(like)
        self._sessions[name] = session
        self._forget()
        return session

    def _forget(self) -> None:
        now = monotonic()
        closed = sorted(
            (session for session in self._sessions.values() if not (session.open or session.runs)), key=_used
        )
        for session in closed:
            if len(self._sessions) > self._settings.most_sessions or now - session.used > self._settings.idle_s:
                self._sessions.pop(session.name).close()


def _used(session: Session) -> float:
    return session.used
