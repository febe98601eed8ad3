"""The app without a browser: its server in this process, asked by somebody who has the token."""

from __future__ import annotations

import http.client
import time
from contextlib import closing
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from starlette.testclient import TestClient
from websockets.sync.client import ClientConnection, connect

from heeltoe.app.server import application
from heeltoe.app.settings import Settings

PORT = 8642
HOME = f"http://127.0.0.1:{PORT}"
#: Address of a websocket that a page of the app opens.
HEADERS = {"host": f"127.0.0.1:{PORT}", "origin": HOME}


def client_of(settings: Settings, **more: Any) -> TestClient:
    """Return a client of the app with these settings, which shows its token."""
    return TestClient(application(settings), base_url=HOME, cookies={settings.cookie: settings.token}, **more)


def client_in(folder: Path, **limits: int) -> TestClient:
    """Return a client of an app that has a folder for its files."""
    folder.mkdir(exist_ok=True)
    return client_of(Settings("127.0.0.1", PORT, folder, **limits))  # type: ignore[arg-type]


class Visitor:
    """Who has opened the printed address of an app that runs elsewhere, and keeps its cookie as a browser does."""

    def __init__(self, address: str) -> None:
        self.parts = urlsplit(address)
        with closing(http.client.HTTPConnection(self.parts.netloc, timeout=60)) as connection:
            connection.request("GET", f"/?{self.parts.query}")
            self.cookie = connection.getresponse().headers["set-cookie"].partition(";")[0]
        self.headers = {"Origin": f"http://{self.parts.netloc}", "Cookie": self.cookie}

    def tab(self) -> ClientConnection:
        """Open a tab."""
        return connect(
            f"ws://{self.parts.netloc}/talk",
            additional_headers={"Cookie": self.cookie},
            origin=self.headers["Origin"],
            max_size=None,
        )


def fill(say: Any, folder: Path) -> dict[str, Any]:
    """Write files for a minute, as the process of a job."""
    folder.mkdir()
    say("filling")
    for number in range(600):
        (folder / str(number)).write_bytes(bytes(10_000))
        time.sleep(0.1)
    return {}
