"""Who may ask: the right name of the server, no other origin, and on a public address the token.

It stands before everything else, plain requests and websockets alike."""

from __future__ import annotations

import secrets
from http.cookies import CookieError, SimpleCookie
from urllib.parse import parse_qs, urlsplit

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse, RedirectResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from heeltoe.app.settings import Settings

COOKIE = "heeltoe-token"
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
        if not refusal and self._settings.token and not self._shows_token(headers):
            if self._brings_token(scope):
                answer = RedirectResponse(scope["path"], status_code=303)
                answer.set_cookie(COOKIE, self._settings.token, httponly=True, samesite="strict")
                await answer(scope, receive, sealed)
                return
            refusal = "This address needs a token; open the address that heeltoe app has printed."
        if not refusal:
            await self._app(scope, receive, sealed)
        elif scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": 1008, "reason": refusal[:120]})
        else:
            await PlainTextResponse(refusal, status_code=403)(scope, receive, sealed)

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

    def _shows_token(self, headers: Headers) -> bool:
        try:
            cookie = SimpleCookie(headers.get("cookie", "")).get(COOKIE)
        except CookieError:
            return False
        return cookie is not None and self._is_token(cookie.value)

    def _brings_token(self, scope: Scope) -> bool:
        if scope["type"] != "http" or scope["method"] != "GET":
            return False
        token = parse_qs(scope["query_string"].decode("latin-1")).get("token", [""])
        return self._is_token(token[0])

    def _is_token(self, text: str) -> bool:
        return secrets.compare_digest(text.encode(), self._settings.token.encode())
