"""Warnings of one result or of two."""

from __future__ import annotations

from collections.abc import Sequence

from heeltoe.result.response import Response


def listed(responses: Sequence[Response], units: str = "si") -> tuple[str, ...]:
    """Return every warning once, in units ``"si"`` or ``"us"``; those of one of two models say whose they are."""
    by_model = {response.model: [warning.text(units) for warning in response.warnings] for response in responses}
    first = next(iter(by_model.values()))
    shared = dict.fromkeys(text for text in first if all(text in texts for texts in by_model.values()))
    own = [f"{model}: {text}" for model, texts in by_model.items() for text in texts if text not in shared]
    return (*shared, *own)
