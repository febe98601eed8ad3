"""Files for the browser to keep: each behind an address that nobody can guess, and that serves once."""

from __future__ import annotations

import secrets
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from starlette.responses import FileResponse, PlainTextResponse, Response

from heeltoe.app.sessions import Session

# Links of a tab that were not followed; older ones go.
_MOST = 40


@dataclass(frozen=True)
class Offer:
    """A file that may be fetched once.

    Attributes
    ----------
    path
        Where it is.
    name
        What the browser calls it.
    """

    path: Path
    name: str

    def answer(self) -> Response:
        """Return the file, to be kept and never to be shown as a page of this server."""
        if not self.path.is_file():
            return gone()
        return FileResponse(
            self.path, media_type="application/octet-stream", filename=self.name, headers={"Cache-Control": "no-store"}
        )


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
    return PlainTextResponse("There is nothing at this address, or it has been fetched: ask the page again.", 404)
