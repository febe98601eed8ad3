"""A tab that meets a fault of the program hears of it, and can ask again."""

from __future__ import annotations

import asyncio
import json
import logging

import pytest

from heeltoe.app.conversation import Conversation
from heeltoe.app.desk import Entry
from heeltoe.errors.error import InputError


class Desk:
    """Keeps what a tab would hear."""

    def __init__(self):
        self.heard = []

    async def tell(self, message):
        self.heard.append(json.loads(json.dumps(message, allow_nan=False)))


class Socket:
    """Says some messages, and is closed."""

    def __init__(self, messages):
        self.messages = iter(messages)

    async def receive_text(self):
        # What was asked before is answered meanwhile.
        for _ in range(5):
            await asyncio.sleep(0)
        try:
            return next(self.messages)
        except StopIteration:
            raise KeyError from None


async def _fails(desk, asked):
    raise ZeroDivisionError("a fault of the program")


async def _refuses(desk, asked):
    raise InputError("motion-zero", "motion")


async def _answers(desk, asked):
    return {"of": "answer"}


def talk(*messages):
    desk = Desk()
    known = {"fail": Entry(_fails, newest=True), "refuse": Entry(_refuses), "answer": Entry(_answers, newest=True)}
    asyncio.run(Conversation(Socket(messages), desk, known).listen())
    return desk.heard


def test_a_fault_is_answered_logged_and_frees_its_action(caplog):
    with caplog.at_level(logging.ERROR):
        first, second = talk('{"do": "fail", "serial": 1}', '{"do": "fail", "serial": 2}')
    assert (first["serial"], second["serial"]) == (1, 2)
    assert first["of"] == "refused"
    assert "ZeroDivisionError" in first["text"]
    assert "a fault of the program" in caplog.text


def test_what_a_user_can_mend_is_no_fault(caplog):
    (answer,) = talk('{"do": "refuse", "serial": 1}')
    assert answer["of"] == "refused"
    assert not caplog.records


@pytest.mark.parametrize("serial", ["NaN", "Infinity", "-Infinity"])
def test_numbers_that_json_does_not_know_are_refused_and_wedge_nothing(serial):
    refused, answer = talk(f'{{"do": "answer", "serial": {serial}}}', '{"do": "answer", "serial": 3}')
    assert refused["of"] == "bad request"
    assert (answer["of"], answer["serial"]) == ("answer", 3)
