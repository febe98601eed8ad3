"""Files that a browser sends and keeps, and the room that they have.

Sent files are few and not large, are kept under names of our own, and are opened by the readers of the package alone.
Offered files stand behind addresses that no one can guess and that serve once."""

from __future__ import annotations

import asyncio
import os
import secrets
from pathlib import Path

from starlette.requests import ClientDisconnect, Request
from starlette.responses import FileResponse, JSONResponse, PlainTextResponse, Response

from heeltoe.app.sessions import Session
from heeltoe.app.settings import Settings
from heeltoe.app.state import Offer
from heeltoe.base.payload import Json

# How much of a file arrives before it is looked again whether there is room [bytes].
_LOOKS_EVERY = 1_000_000
_FORGOTTEN = "The app has forgotten this tab; reload the page."


def too_large(settings: Settings) -> str:
    """Say that a file is larger than one may be."""
    return f"The file has more than {settings.largest_upload // 10**6} MB; send the part that matters."


def full(settings: Settings, more: int = 1) -> str:
    """Say that all tabs together keep as many files as they may, sent or made, if `more` bytes come; nothing where
    there is room."""
    sizes: dict[tuple[int, int], int] = {}
    for folder, _, names in os.walk(settings.folder):
        for name in names:
            try:
                status = os.lstat(os.path.join(folder, name))
            except FileNotFoundError:
                continue
            # A file with two names takes its room once.
            sizes[status.st_dev, status.st_ino] = status.st_size
    if sum(sizes.values()) + more <= settings.largest_total:
        return ""
    limit = f"{settings.largest_total // 10**6} MB"
    return f"All tabs together keep up to {limit} of files: remove a study, or restart the app."


async def take(request: Request, session: Session | None, settings: Settings) -> Response:
    """Keep the body of a request as a file of a tab, and answer with the name that it has here."""
    if session is None:
        return await _refused(request, 403, _FORGOTTEN, settings)
    if session.uploads >= settings.most_uploads:
        text = f"A tab keeps up to {settings.most_uploads} files: open a new tab to start anew."
        return await _refused(request, 413, text, settings)
    session.uploads += 1
    path = session.folder / f"upload-{secrets.token_hex(8)}"
    size, looked, refusal = 0, 0, ""
    try:
        # The part that has come is on the disk, where the other tabs see it.
        with path.open("xb", buffering=0) as file:
            async for piece in request.stream():
                size += len(piece)
                if size > settings.largest_upload:
                    refusal = too_large(settings)
                elif size > looked:
                    refusal = await asyncio.to_thread(full, settings, len(piece))
                    looked += _LOOKS_EVERY
                if refusal:
                    break
                file.write(piece)
        if not refusal:
            return JSONResponse({"name": path.name, "bytes": size})
    except ClientDisconnect:
        refusal = "The upload is incomplete; send the file again."
    forget(session, path)
    return await _refused(request, 413, refusal, settings)


async def _refused(request: Request, status: int, text: str, settings: Settings) -> Response:
    """Answer with a sentence. A browser hears none before it has sent all, so that is taken, and thrown away."""
    size = 0
    try:
        async for piece in request.stream():
            size += len(piece)
            if size > settings.most_unread:
                break
    except (ClientDisconnect, RuntimeError):
        # The latter where it had all been taken.
        pass
    return JSONResponse({"error": text}, status_code=status)


def forget(session: Session, path: Path) -> None:
    """Remove a file that a tab has sent, so that another one has its place."""
    if path.is_file():
        path.unlink()
        session.uploads -= 1


def upload_path(session: Session, name: str) -> Path | None:
    """Return the file that a tab has sent by the name that it was given here; None where there is none."""
    paths = {path.name: path for path in session.folder.glob("upload-*")}
    return paths.get(name)


# Links of a tab that were not followed; older ones go.
_MOST = 40


def offer(session: Session, path: Path, name: str) -> Json:
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
