"""Files that a browser sends: a few, not large, kept under names of our own, for the readers of the package alone."""

from __future__ import annotations

import secrets
from pathlib import Path

from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from heeltoe.app.sessions import Session
from heeltoe.app.settings import Settings


async def take(request: Request, session: Session, settings: Settings) -> Response:
    """Keep the body of a request as a file of a tab, and answer with the name that it has here."""
    if session.uploads >= settings.most_uploads:
        return _refused(413, f"A tab keeps up to {settings.most_uploads} files: reload the page to start anew.")
    session.uploads += 1
    path = session.folder / f"upload-{secrets.token_hex(8)}"
    size = 0
    try:
        with path.open("xb") as file:
            async for piece in request.stream():
                size += len(piece)
                if size > settings.largest_upload:
                    raise OverflowError
                file.write(piece)
    except OverflowError:
        path.unlink(missing_ok=True)
        session.uploads -= 1
        return _refused(413, f"The file has more than {settings.largest_upload // 10**6} MB.")
    return JSONResponse({"name": path.name, "bytes": size})


def upload_path(session: Session, name: str) -> Path | None:
    """Return the file that a tab has sent by the name that it was given here; None where there is none."""
    found = {path.name: path for path in session.folder.glob("upload-*")}
    return found.get(name)


def _refused(status: int, text: str) -> Response:
    return JSONResponse({"error": text}, status_code=status)
