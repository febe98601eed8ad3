"""Responses with other numbers than they have, for words and figures that seldom runs lead to."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

from heeltoe import Response
from heeltoe.base.blocks import Block

R = TypeVar("R", bound=Response)


def with_numbers(response: R, **numbers: object) -> R:
    """Return the response with other numbers of the crack of ``[crack]`` and of the dam, by their JSON names."""
    crack, dam = response.numbers, response.dam
    assert crack is not None
    of_crack = {name: _typed(crack, name, value) for name, value in numbers.items() if name in crack.names()}
    of_dam = {name: value for name, value in numbers.items() if name not in of_crack}
    if of_dam:
        assert dam is not None
        dam = replace(dam, **of_dam)
    return replace(response, dam=dam).with_crack(of_crack=replace(crack, **of_crack))


def _typed(block: Block, name: str, value: object) -> object:
    """Return numbers that are given as a dictionary as the block that they were."""
    before = getattr(block, name)
    return replace(before, **value) if isinstance(value, dict) and isinstance(before, Block) else value
