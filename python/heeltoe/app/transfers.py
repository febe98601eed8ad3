"""Files that a browser sends and keeps.

Sent files are few and not large, are kept under names of our own, and are opened by the readers of the package alone.
Offered files stand behind addresses that nobody can guess and that serve once."""

from __future__ import annotations

import secrets
from pathlib import Path
from typing import Any

from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, JSONResponse, PlainTextResponse, Response

from heeltoe.app.sessions import Session, Sessions
from heeltoe.app.settings import Settings
from heeltoe.app.state import Offer


async def take(request: Request, session: Session, sessions: Sessions, settings: Settings) -> Response:
    """Keep the body of a request as a file of a tab, and answer with the name that it has here."""
    if session.uploads >= settings.most_uploads:
        return _refused(413, f"A tab keeps up to {settings.most_uploads} files: open a new tab to start anew.")
    session.uploads += 1
    path = session.folder / f"upload-{secrets.token_hex(8)}"
    size, refusal = 0, ""
    try:
        with path.open("xb") as file:
            async for piece in request.stream():
                size += len(piece)
                session.uploaded += len(piece)
                if size > settings.largest_upload:
                    refusal = f"The file has more than {settings.largest_upload // 10**6} MB."
                elif sessions.uploaded > settings.largest_total:
                    refusal = f"All tabs together keep up to {settings.largest_total // 10**6} MB; restart the app."
                if refusal:
                    break
                file.write(piece)
        if not refusal:
            return JSONResponse({"name": path.name, "bytes": size})
    except ClientDisconnect:
        refusal = "The upload is incomplete; send the file again."
    _forget(session, path, size)
    return _refused(413, refusal)


def _forget(session: Session, path: Path, size: int) -> None:
    path.unlink(missing_ok=True)
    session.uploads -= 1
    session.uploaded -= size


def forget(session: Session, path: Path) -> None:
    """Remove a file that a tab has sent, so that another one has its place."""
    if path.is_file():
        _forget(session, path, path.stat().st_size)


def upload_path(session: Session, name: str) -> Path | None:
    """Return the file that a tab has sent by the name that it was given here; None where there is none."""
    paths = {path.name: path for path in session.folder.glob("upload-*")}
    return paths.get(name)


def _refused(status: int, text: str) -> Response:
    return JSONResponse({"error": text}, status_code=status)


# Links of a tab that were not followed; older ones go.
_MOST = 40


def offer(session: Session, path: Path, name: str) -> dict[str, Any]:
    """Return where a tab can fetch a file of its folder once."""
    if not path.resolve().is_relative_to(session.folder.resolve()):
        raise ValueError(path)
    key = secrets.token_urlsafe(24)
    session.offers[key] = Offer(path, name)
    while len(session.offers) > _MOST:
        del session.offers[next(iter(session.offers))]
    return {"of": "download", "address": f"/download/{key}", "name": name}


def gone() -> Response:
    """Return what is behind an address that serves no file, or has served it."""
    return PlainTextResponse("This address holds no file, or the file has been fetched; ask the page again.", 404)


def answer_offer(offer: Offer) -> Response:
    """Return the file, to be kept and never to be shown as a page of this server."""
    if not offer.path.is_file():
        return gone()
    return FileResponse(
        offer.path, media_type="application/octet-stream", filename=offer.name, headers={"Cache-Control": "no-store"}
    )
