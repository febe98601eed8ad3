"""How much a result depends on the last per cent of the shaking, in words and numbers."""

from __future__ import annotations

from heeltoe.result.contract import HEADLINES
from heeltoe.result.response import Response
from heeltoe.units.sentences import written
from heeltoe.views.words.numbers import Amount, Cell, in_one_unit

#: What stands above the numbers of a row.
COLUMNS = ("this run", "mean", "std. dev.", "least", "most")


def spread_rows(response: Response, units: str) -> list[list[str]]:
    """Return label, value and spread of all that is not next to nothing, each quantity in one unit."""
    spread = response.spread
    assert spread is not None
    rows: list[list[Cell]] = []
    for headline in HEADLINES:
        statistics = spread[headline.key]
        if statistics is None:
            continue
        values = [
            response.summary[headline.key],
            statistics["mean"],
            statistics["std"],
            statistics["min"],
            statistics["max"],
        ]
        if max(map(abs, values)) < headline.least:
            continue
        if headline.way < 0:
            values = [-values[0], -values[1], values[2], -values[4], -values[3]]
        rows.append([headline.label, *(Amount(value, headline.kind) for value in values)])
    return in_one_unit(rows, units)


def spread_sentence(response: Response, units: str) -> str:
    """Say which runs a spread is of."""
    spread = response.spread
    assert spread is not None
    step = written(", at a step of {time_step_s:.3g ms}", units, **spread) if "time_step_s" in spread else ""
    failed = f", {spread['failed']} of them without a result" if spread["failed"] else ""
    return (
        f"spread over {spread['runs']} runs with the shaking scaled by {spread['scales'][0]:g} to "
        f"{spread['scales'][-1]:g}{step}{failed}"
    )
