"""Serve the app until Ctrl-C."""

from __future__ import annotations

import asyncio
import contextlib
import os
import signal
import socket
import sys
import threading
import webbrowser
from collections.abc import Callable
from importlib.util import find_spec

from heeltoe.app.folder import folder_of_app
from heeltoe.app.settings import Settings, is_loopback
from heeltoe.app.workers import WORKER_NAME
from heeltoe.errors.error import InputError

#: Where the app is found if it is free and no other is asked for.
USUAL_PORT = 8642
_PACKAGES = ("plotly", "starlette", "uvicorn", "websockets")
# After Ctrl-C, tabs that still talk are waited for so long [s].
_PATIENCE_S = 2


def serve(host: str, port: int | None, *, public: bool, browser: bool, say: Callable[[str], None]) -> None:
    """Serve the app.

    Parameters
    ----------
    host
        Where to listen.
    port
        There; the usual one, or any that is free, where none is given.
    public
        Whether other machines may reach it.
    browser
        Whether to open it in the browser of this machine.
    say
        Told the address, with the token that whoever asks needs.

    Raises
    ------
    InputError
        Where a package is missing, the address cannot be used, or is not of this machine alone without `public`.
    """
    for package in _PACKAGES:
        if find_spec(package) is None:
            raise InputError("package-missing", "heeltoe app", package, install='install heeltoe with the extra "app"')
    if not is_loopback(host) and not public:
        raise InputError("app-public", "--host", host)
    with contextlib.closing(_listen(host, port)) as listening, folder_of_app() as folder:
        settings = Settings(host, listening.getsockname()[1], folder)
        address = _address(settings)
        # A tab or a worker that closes its end while something is sent to it must not end the server.
        if hasattr(signal, "SIGPIPE"):
            signal.signal(signal.SIGPIPE, signal.SIG_IGN)
        # Ctrl-C ends it, as is said, from the first moment and where what started it had that ignored.
        # Until the server minds it itself it is noted: it would meet things half made.
        interrupts: list[int] = []
        signal.signal(signal.SIGINT, lambda number, _: interrupts.append(number))
        say(address)
        asyncio.run(_run(settings, listening, _opening(settings, address) if browser else "", interrupts))
    _leave()


def _leave() -> None:
    """End Python although a computation may still run on a thread; its result is dropped."""
    if any(thread.name.startswith(WORKER_NAME) for thread in threading.enumerate()):
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(0)


async def _run(settings: Settings, listening: socket.socket, open_at: str, interrupts: list[int]) -> None:
    import uvicorn

    from heeltoe.app.server import application

    config = uvicorn.Config(
        application(settings),
        ws="websockets-sansio",
        ws_max_size=settings.largest_message,
        log_level="warning",
        server_header=False,
        timeout_graceful_shutdown=_PATIENCE_S,
    )
    server = uvicorn.Server(config)
    if interrupts:
        return
    if open_at:
        # The socket listens already: what comes before the server is there waits for it.
        asyncio.get_running_loop().run_in_executor(None, webbrowser.open, open_at)
    await server.serve(sockets=[listening])


def _listen(host: str, port: int | None) -> socket.socket:
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    for tried in (USUAL_PORT, 0) if port is None else (port,):
        listening = socket.socket(family, socket.SOCK_STREAM)
        if sys.platform != "win32":  # there it would let two programs share an address
            listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((host, tried))
            listening.listen()
        except (OSError, OverflowError, TypeError, ValueError) as error:
            # The last two for names that no network can know.
            listening.close()
            if port is not None or tried == 0:
                reason = getattr(error, "strerror", None) or error
                raise InputError("app-address", "--port", f"{host}:{tried}", reason=reason) from None
        else:
            return listening
    raise AssertionError


def _address(settings: Settings) -> str:
    name = settings.host
    if name in ("0.0.0.0", "::"):
        name = socket.gethostname()
    shown = f"[{name}]" if ":" in name else name
    return f"http://{shown}:{settings.port}/?token={settings.token}"


def _opening(settings: Settings, address: str) -> str:
    """Write a page that leads to an address, and return its own: all users of a machine see what programs are started
    with, and the token is nothing for them."""
    path = settings.folder / "open.html"
    with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w", encoding="utf-8") as file:
        file.write(
            f'<!doctype html><meta charset="utf-8"><title>heeltoe</title>'
            f'<meta http-equiv="refresh" content="0; url={address}"><p><a href="{address}">Open heeltoe</a></p>\n'
        )
    return path.as_uri()
