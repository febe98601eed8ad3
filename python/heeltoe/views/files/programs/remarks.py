"""Lines that stand above the files of other programs: the case, and how the dam in the file differs from it."""

from __future__ import annotations

import textwrap

from heeltoe.kernel.build import build_info
from heeltoe.models.flexible.deck import Deck

_WIDTH = 110


def remarks(deck: Deck) -> list[str]:
    """Return lines of text without the sign of a comment."""
    version = build_info()["heeltoe"]
    units = "SI units, one metre of dam, x downstream, y up. Nodes from 1."
    lines = [f"{' '.join(deck.title.split())}: written by heeltoe {version}.", units, *deck.notes]
    return [part for line in lines for part in textwrap.wrap(line, _WIDTH)]
