"""Permissions and bounds of the app's server."""

from __future__ import annotations

import ipaddress
import secrets
import socket
from dataclasses import dataclass, field
from pathlib import Path

#: Names by which a browser on this machine reaches it.
_LOOPBACK = ("127.0.0.1", "localhost", "::1")


@dataclass(frozen=True)
class Settings:
    """How the app is served.

    Attributes
    ----------
    host, port
        Where it listens.
    folder
        Where uploads and results go; nothing is written anywhere else, and nothing in it outlives the app.
    token
        The word that a browser must show: other users of this machine reach the app, too.
    most_sessions
        Tabs that are remembered; the one unused for longest goes first.
    most_open
        Tabs that are open at once.
    idle_s
        After how long without a word a tab is forgotten [s].
    largest_message, largest_upload
        Of what a browser sends [bytes].
    most_uploads
        Files of one tab.
    longest_reading_s
        That a file may take to be read [s].
    largest_total
        Size of the files of all tabs together, sent or made [bytes].
    most_unread
        Size of a file that is refused, taken so that its sender hears why [bytes].
    most_jobs
        Long runs at once, of all tabs.
    most_studies, most_runs
        Studies that a tab keeps, and runs of each.
    """

    host: str
    port: int
    folder: Path
    token: str = field(default_factory=lambda: secrets.token_urlsafe(24), repr=False)
    most_sessions: int = 64
    most_open: int = 32
    idle_s: float = 4 * 3600.0
    largest_message: int = 1_000_000
    largest_upload: int = 20_000_000
    most_uploads: int = 40
    longest_reading_s: float = 30.0
    largest_total: int = 1_000_000_000
    most_unread: int = 1_000_000_000
    most_jobs: int = 2
    most_studies: int = 12
    most_runs: int = 1_000_000

    @property
    def cookie(self) -> str:
        """Name of the cookie of the token: browsers keep those of one machine together, whatever the port."""
        return f"heeltoe-{self.port}"

    @property
    def is_public(self) -> bool:
        """Whether other machines can reach it."""
        return not is_loopback(self.host)

    def knows(self, host: str) -> bool:
        """Whether the header ``Host`` of a request names this server: a page of another site that has its name point
        here does not. Numbers as addresses belong to no site."""
        name, _, port = host.rpartition(":") if not host.endswith("]") else (host, "", "80")
        if not name:
            name, port = port, "80"
        name = name.strip("[]").lower()
        if port != str(self.port):
            return False
        if not self.is_public:
            return name in _LOOPBACK
        return name in (self.host.lower(), socket.gethostname().lower(), *_LOOPBACK) or _is_address(name)


def is_loopback(host: str) -> bool:
    """Whether an address is of this machine alone."""
    return host in _LOOPBACK or (_is_address(host) and ipaddress.ip_address(host).is_loopback)


def _is_address(name: str) -> bool:
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True
