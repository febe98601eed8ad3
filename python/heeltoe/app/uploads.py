"""Files that a browser sends: a few, not large, kept under names of our own, for the readers of the package alone."""

from __future__ import annotations

import secrets
from pathlib import Path

from starlette.requests import ClientDisconnect, Request
from starlette.responses import JSONResponse, Response

from heeltoe.app.sessions import Session, Sessions
from heeltoe.app.settings import Settings


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
                    refusal = f"All tabs together keep up to {settings.largest_total // 10**6} MB: start the app anew."
                if refusal:
                    break
                file.write(piece)
        if not refusal:
            return JSONResponse({"name": path.name, "bytes": size})
    except ClientDisconnect:
        refusal = "The file has not come as a whole."
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
    found = {path.name: path for path in session.folder.glob("upload-*")}
    return found.get(name)


def _refused(status: int, text: str) -> Response:
    return JSONResponse({"error": text}, status_code=status)
