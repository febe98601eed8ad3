"""The conversation with one tab: JSON both ways, each answer with the number of its question."""

from __future__ import annotations

import asyncio
import json
import logging

from starlette.websockets import WebSocket, WebSocketDisconnect

from heeltoe.app.desk import BadRequestError, Desk, Entry, Request
from heeltoe.app.transfers import full
from heeltoe.base.payload import Json
from heeltoe.errors.error import HeeltoeError

_LOG = logging.getLogger(__name__)
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
        self._waiting: dict[str, Request] = {}
        # Of what the next one replaces: the one that is computed.
        self._replaced: dict[str, asyncio.Task[None]] = {}
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
            content = json.loads(message, parse_constant=_no_number)
        except (ValueError, RecursionError):
            content = None
        name = content.get("do") if isinstance(content, dict) else None
        entry = self._actions.get(name) if isinstance(name, str) else None
        if entry is None or not isinstance(content, dict) or not isinstance(name, str):
            await self._desk.tell({"of": "bad request", "text": "there is no such action"})
            return
        if entry.newest and name in self._busy:
            self._waiting[name] = content
            return
        if len(self._tasks) >= _MOST_AT_ONCE:
            await self._desk.tell({"of": "bad request", "text": "too much at once", "serial": content.get("serial")})
            return
        if entry.replaced and name in self._replaced:
            self._replaced[name].cancel()
        self._busy.add(name)
        task = asyncio.create_task(self._answer(name, entry, content))
        if entry.replaced:
            self._replaced[name] = task
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _answer(self, name: str, entry: Entry, request: Request | None) -> None:
        try:
            while request is not None:
                answer = await self._answer_of(name, entry, request)
                await self._desk.tell({**answer, "serial": request.get("serial"), "to": name})
                request = self._waiting.pop(name, None) if entry.newest else None
        finally:
            # Whatever has happened, the tab may ask for it again.
            self._busy.discard(name)

    async def _answer_of(self, name: str, entry: Entry, request: Request) -> Json:
        """Return the answer of an action; one that fails says so, and the log says where."""
        try:
            if entry.writes and (refusal := await asyncio.to_thread(full, self._desk.settings)):
                return {"of": "refused", "text": refusal}
            return await entry.action(self._desk, request)
        except BadRequestError as error:
            return {"of": "bad request", "text": str(error)}
        except HeeltoeError as error:
            return {"of": "refused", "text": str(error)}
        except Exception as error:
            _LOG.exception("the action %r of the app failed", name)
            text = f"heeltoe failed at this ({type(error).__name__}): the terminal in which the app runs says where."
            return {"of": "refused", "text": text}


def _no_number(name: str) -> None:
    """Refuse NaN and the infinities, which are no JSON."""
    raise ValueError(name)
