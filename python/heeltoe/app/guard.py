"""Admission of requests: the right name of the server, no other origin, and the token of the printed address.

It stands before everything else, plain requests and websockets alike."""

from __future__ import annotations

import secrets
from urllib.parse import urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.requests import HTTPConnection
from starlette.responses import PlainTextResponse, RedirectResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from heeltoe.app.settings import Settings

_NO_TOKEN = "This page needs the token of the app: open the whole address that heeltoe app has printed."
# The plots write the style of what they draw into the page; scripts come from here alone, and none stands in the page.
_POLICY = (
    "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "connect-src 'self'; object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'"
)
_HEADERS = {
    "Content-Security-Policy": _POLICY,
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
}


class Guard:
    """Lets through what comes from a page of this server, and says on every answer what a browser may do with it."""

    def __init__(self, app: ASGIApp, settings: Settings) -> None:
        self._app = app
        self._settings = settings

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
            return
        headers = Headers(scope=scope)

        async def sealed(message: Message) -> None:
            if message["type"] == "http.response.start":
                headers = MutableHeaders(scope=message)
                for name, value in _HEADERS.items():
                    headers[name] = value
            await send(message)

        refusal = self._refusal(scope, headers)
        if not refusal and self._brings_token(scope):
            # The address that stays in the browser is without it.
            answer = RedirectResponse(scope["path"], status_code=303)
            # A browser that comes from a link elsewhere has to show it at once, which "strict" would forbid.
            answer.set_cookie(self._settings.cookie, self._settings.token, httponly=True, samesite="lax")
            await answer(scope, receive, sealed)
        elif not refusal and self._shows_token(scope):
            await self._app(scope, receive, sealed)
        elif scope["type"] == "websocket":
            await receive()
            if not refusal:
                # A page hears a reason on an open websocket alone; it is one of ours, of an app that has ended.
                await send({"type": "websocket.accept"})
            await send({"type": "websocket.close", "code": 1008, "reason": (refusal or _NO_TOKEN)[:120]})
        else:
            await PlainTextResponse(refusal or _NO_TOKEN, status_code=403)(scope, receive, sealed)

    def _refusal(self, scope: Scope, headers: Headers) -> str:
        """Say why a request is refused, whoever it comes from; nothing where it is not."""
        host = headers.getlist("host")
        if len(host) != 1 or not self._settings.knows(host[0]):
            return "This server has another name."
        origin = headers.get("origin")
        changes = scope["type"] == "websocket" or scope["method"] not in ("GET", "HEAD")
        if origin is None:
            return "A page of this server says where it comes from." if changes else ""
        parts = urlsplit(origin)
        return (
            ""
            if parts.scheme == "http" and parts.netloc == host[0]
            else "Pages of other sites may not use this server."
        )

    def _shows_token(self, scope: Scope) -> bool:
        return self._is_token(HTTPConnection(scope).cookies.get(self._settings.cookie, ""))

    def _brings_token(self, scope: Scope) -> bool:
        if scope["type"] != "http" or scope["method"] != "GET":
            return False
        return self._is_token(HTTPConnection(scope).query_params.get("token", ""))

    def _is_token(self, text: str) -> bool:
        return secrets.compare_digest(text.encode(), self._settings.token.encode())
