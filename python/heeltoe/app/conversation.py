"""The conversation with one tab: JSON both ways, each answer with the number of what it answers."""

from __future__ import annotations

import asyncio
import json
from typing import Any

from starlette.websockets import WebSocket, WebSocketDisconnect

from heeltoe.app.actions import Asked, BadRequestError, Desk, Entry
from heeltoe.errors import HeeltoeError

# Of actions that a tab asks for at once; a page waits for its answers.
_MOST_AT_ONCE = 16


class Conversation:
    """One tab that is open.

    Parameters
    ----------
    socket
        To the tab.
    desk
        What its actions have at hand.
    actions
        By name.
    """

    def __init__(self, socket: WebSocket, desk: Desk, actions: dict[str, Entry]) -> None:
        self._socket = socket
        self._desk = desk
        self._actions = actions
        self._busy: set[str] = set()
        # Of what only the newest is worth an answer: the one that waits while another is computed.
        self._waiting: dict[str, Asked] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    async def listen(self) -> None:
        """Answer until the tab is closed."""
        try:
            while True:
                await self._take(await self._socket.receive_text())
        except (WebSocketDisconnect, KeyError):
            pass
        finally:
            for task in self._tasks:
                task.cancel()

    async def _take(self, message: str) -> None:
        try:
            asked = json.loads(message)
        except (ValueError, RecursionError):
            asked = None
        name = asked.get("do") if isinstance(asked, dict) else None
        entry = self._actions.get(name) if isinstance(name, str) else None
        if entry is None or not isinstance(asked, dict) or not isinstance(name, str):
            await self._desk.tell({"of": "bad request", "text": "there is no such action"})
            return
        if entry.newest and name in self._busy:
            self._waiting[name] = asked
            return
        if len(self._tasks) >= _MOST_AT_ONCE:
            await self._desk.tell({"of": "bad request", "text": "too much at once", "serial": asked.get("serial")})
            return
        self._busy.add(name)
        task = asyncio.create_task(self._answer(name, entry, asked))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _answer(self, name: str, entry: Entry, asked: Asked | None) -> None:
        while asked is not None:
            serial = asked.get("serial")
            try:
                found: dict[str, Any] = await entry.action(self._desk, asked)
            except BadRequestError as error:
                found = {"of": "bad request", "text": str(error)}
            except HeeltoeError as error:
                found = {"of": "refused", "text": str(error)}
            await self._desk.tell({**found, "serial": serial, "to": name})
            asked = self._waiting.pop(name, None) if entry.newest else None
        self._busy.discard(name)
