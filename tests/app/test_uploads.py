"""Uploads over a real connection: one that is refused is answered, though its sender has not finished."""

from __future__ import annotations

import http.client
import json
from contextlib import closing

import pytest

pytest.importorskip("websockets")

from shared.app import Visitor

TOO_LARGE = "The file has more than 20 MB; send the part that matters."
MEGABYTE = bytes(1_000_000)


def send(browser: Visitor, session: str, megabytes: int) -> tuple[int, str]:
    with closing(http.client.HTTPConnection(browser.parts.netloc, timeout=60)) as connection:
        return _send(browser, connection, session, megabytes)


def _send(browser: Visitor, connection, session: str, megabytes: int) -> tuple[int, str]:
    headers = {**browser.headers, "x-session": session, "Content-Length": str(megabytes * len(MEGABYTE))}
    # Others than browsers say at once that this is all.
    headers["Connection"] = "close"
    connection.request("POST", "/upload", body=(MEGABYTE for _ in range(megabytes)), headers=headers)
    answer = connection.getresponse()
    return answer.status, json.loads(answer.read())["error"]


@pytest.fixture(scope="module")
def browser(address):
    return Visitor(address)


def test_a_file_that_is_too_large_is_answered(browser):
    with browser.tab() as tab:
        hello = json.loads(tab.recv())
        assert send(browser, hello["session"], 60) == (413, TOO_LARGE)
        # The page says the same before it sends anything.
        assert hello["upload"] == {"largest": 20_000_000, "refusal": TOO_LARGE}


def test_a_file_of_a_tab_that_was_forgotten_is_answered(browser):
    assert send(browser, "guessed", 60) == (403, "The app has forgotten this tab; reload the page.")
