"""Content of a report, apart from its looks: one tree of frozen blocks that both renderers walk."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal

from heeltoe.views.words.numbers import Value


@dataclass(frozen=True)
class Code:
    """Words of the program: a field, a command, a hash. They may be broken anywhere."""

    text: str


@dataclass(frozen=True)
class Strong:
    """Words that carry weight."""

    text: str


@dataclass(frozen=True)
class Symbol:
    """A letter of the equations in running text, with its index."""

    letter: str
    index: str = ""


Inline = str | Value | Code | Strong | Symbol
"""A piece of running text; plain strings are sentences, in which anything may stand."""


@dataclass(frozen=True)
class Paragraph:
    """Running text."""

    parts: tuple[Inline, ...]


@dataclass(frozen=True)
class Notes:
    """A boxed list that readers must not miss."""

    kind: Literal["failure", "warning", "note"]
    title: str
    items: tuple[tuple[Inline, ...], ...]


@dataclass(frozen=True)
class Table:
    """Rows of cells below a head.

    Attributes
    ----------
    head
        Names of the columns.
    rows
        Cells of each row.
    caption
        What the table shows; empty for none.
    align
        A letter for each column: ``l`` or ``r``.
    widths
        Shares of the width that the columns take; none for as wide as they need.
    whole
        Whether it stays on one page, however long it is.
    """

    head: tuple[str, ...]
    rows: tuple[tuple[Inline, ...], ...]
    caption: str = ""
    align: str = ""
    widths: tuple[float, ...] = ()
    whole: bool = False


@dataclass(frozen=True)
class Equation:
    """A numbered equation, in typst's mathematics and in HTML; both are written by us, not by users."""

    number: int
    typst: str
    html: str


@dataclass(frozen=True)
class FigureBlock:
    """A figure as SVG, with its caption, its width and height [in], and the share of the page's width that it takes.

    One that is `held` stands where it is in the text; others may wait for a page with room for them.
    """

    name: str
    caption: str
    svg: bytes
    size: tuple[float, float]
    share: float = 1.0
    held: bool = False


@dataclass(frozen=True)
class Beside:
    """Figures side by side, whose shares of the width are one together."""

    figures: tuple[FigureBlock, ...]


@dataclass(frozen=True)
class References:
    """Numbered sources."""

    items: tuple[str, ...]


@dataclass(frozen=True)
class Listing:
    """Lines to be copied."""

    text: str


@dataclass(frozen=True)
class Section:
    """A part of the report with its heading; one that is a `page` begins a new one."""

    title: str
    blocks: tuple[Block, ...]
    page: bool = False


Block = Paragraph | Notes | Table | Equation | FigureBlock | Beside | References | Listing | Section


@dataclass(frozen=True)
class Document:
    """A whole report.

    Attributes
    ----------
    title, subtitle
        What the case is called, and what was done with it.
    footer
        What stands on every page, beside its number.
    blocks
        Everything else.
    about
        Label and words of each entry of the title block; none for no such block.
    """

    title: str
    subtitle: str
    footer: str
    blocks: tuple[Block, ...]
    about: tuple[tuple[str, str], ...] = ()


def paragraph(*parts: Inline) -> Paragraph:
    """Return running text of these parts."""
    return Paragraph(parts)


def glued(text: str) -> str:
    """Keep numbers and their units on one line."""
    return re.sub(r"(?<=\d) (?=(?:%|(?!and|to|or|of|at|in the|on)[a-zA-Z/]{1,4}\b))", "\u00a0", text)


def without_gaps(*blocks: Block | None) -> tuple[Block, ...]:
    """Return the blocks that are there."""
    return tuple(block for block in blocks if block is not None)
