"""The server: the page and its files, uploads, and a conversation with each tab."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.requests import Request
from starlette.responses import FileResponse, Response
from starlette.routing import Mount, Route, WebSocketRoute
from starlette.staticfiles import StaticFiles
from starlette.websockets import WebSocket, WebSocketDisconnect, WebSocketState

from heeltoe.app import answer, checks, open_case
from heeltoe.app.case import actions as case
from heeltoe.app.conversation import Conversation
from heeltoe.app.desk import Desk
from heeltoe.app.export import actions as export
from heeltoe.app.guard import Guard
from heeltoe.app.motion import actions as motion
from heeltoe.app.sessions import Session, Sessions, TooManyError
from heeltoe.app.settings import Settings
from heeltoe.app.studies import actions as studies
from heeltoe.app.transfers import answer_offer, gone, take, too_large
from heeltoe.app.workers import Workers
from heeltoe.base.payload import Json

_PAGE = Path(__file__).parent / "page"
# What plays the moving dam, on the pages of animations and here.
_PLAYER = Path(__file__).parents[1] / "views" / "animation" / "player"
# Requests of a tab by name, page by page.
_ACTIONS = {
    name: entry
    for module in (open_case, case, motion, answer, checks, studies, export)
    for name, entry in module.ACTIONS.items()
}
# The code with which a websocket is closed where there are too many.
_TRY_LATER = 1013


def application(settings: Settings) -> Starlette:
    """Return the app that serves these settings."""
    sessions, workers = Sessions(settings), Workers()

    @asynccontextmanager
    async def life(app: Starlette) -> AsyncIterator[None]:
        warming = asyncio.create_task(workers.quick(_warm, settings.folder))
        try:
            yield
        finally:
            warming.cancel()
            sessions.close()
            workers.close()

    async def talk(socket: WebSocket) -> None:
        await socket.accept()
        query = socket.query_params
        try:
            session = sessions.enter(query.get("session", ""), again="again" in query, closed=query.get("closed", ""))
        except TooManyError as error:
            await socket.close(_TRY_LATER, str(error))
            return
        desk = Desk(session, workers, settings, _teller(socket, session))
        session.tell = desk.tell
        try:
            upload = {"largest": settings.largest_upload, "refusal": too_large(settings)}
            await desk.tell({"of": "hello", "session": session.name, "upload": upload})
            await _begin(desk)
            await Conversation(socket, desk, _ACTIONS).listen()
        finally:
            sessions.leave(session, desk.tell)

    async def upload(request: Request) -> Response:
        session = sessions.get(request.headers.get("x-session", ""))
        return await take(request, session, settings)

    async def download(request: Request) -> Response:
        # What only looks at the head of a file shall not use up its link.
        offer = sessions.take(request.path_params["key"]) if request.method == "GET" else None
        return gone() if offer is None else answer_offer(offer)

    return Starlette(
        routes=[
            Route("/", _index),
            Route("/plotly.js", _plotly),
            Route("/upload", upload, methods=["POST"]),
            Route("/download/{key}", download),
            WebSocketRoute("/talk", talk),
            Mount("/page", StaticFiles(directory=_PAGE)),
            Mount("/player", StaticFiles(directory=_PLAYER)),
        ],
        middleware=[Middleware(Guard, settings=settings)],
        lifespan=life,
    )


async def _begin(desk: Desk) -> None:
    async with desk.session.turn:
        # A page that was loaded anew counts its questions anew.
        desk.session.heard = 0
        await desk.tell(await desk.workers.quick(open_case.begin, desk.session))
    for job in desk.session.jobs.values():
        await desk.tell(job.payload())


def _teller(socket: WebSocket, session: Session) -> Any:
    """Return the function that sends a message to a tab, one at a time; messages to a closed tab are lost.

    Files that it has sent are called as it calls them, whoever speaks of them."""
    lock = asyncio.Lock()

    async def tell(message: Json) -> None:
        text = json.dumps(message, separators=(",", ":"), allow_nan=False)
        for called, stored in session.sent.items():
            text = text.replace(stored, json.dumps(called)[1:-1])
        async with lock:
            if socket.client_state is WebSocketState.CONNECTED:
                try:
                    await socket.send_text(text)
                except (WebSocketDisconnect, RuntimeError):
                    return

    return tell


async def _index(request: Request) -> Response:
    return FileResponse(_PAGE / "index.html", headers={"Cache-Control": "no-cache"})


async def _plotly(request: Request) -> Response:
    return FileResponse(plotly_file(), media_type="text/javascript", headers={"Cache-Control": "max-age=86400"})


def plotly_file() -> Path:
    """Return the library that draws, as the Python package brings it, without loading that."""
    spec = find_spec("plotly")
    assert spec is not None
    assert spec.origin is not None
    return Path(spec.origin).parent / "package_data" / "plotly.min.js"


def _warm(place: Path) -> None:
    """Load all that the first answer needs while the browser draws the page."""
    from tempfile import TemporaryDirectory

    from heeltoe.app import live

    with TemporaryDirectory(prefix="warm-", dir=place) as folder:
        session = Session("", Path(folder))
        open_case.begin(session)
        if session.case is not None:
            live.answer(session.case, {}, "rigid", "si")
