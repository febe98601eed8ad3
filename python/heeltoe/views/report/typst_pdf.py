"""A document as a PDF, by typst: source and figures go into a directory of their own and are compiled there."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace
from importlib.resources import files
from typing import Literal

from heeltoe.base.atomic_files import temporary
from heeltoe.views.content.tree import (
    Beside,
    Block,
    Code,
    Document,
    Equation,
    FigureBlock,
    Inline,
    Listing,
    Notes,
    Paragraph,
    References,
    Section,
    Strong,
    Symbol,
    Table,
)
from heeltoe.views.figures.compile import compiled as compile_typst
from heeltoe.views.words.numbers import Value

# The first comes with typst, the second with matplotlib; of the others whatever the machine has.
_FONTS = (
    "Libertinus Serif",
    "DejaVu Sans",
    "Noto Serif CJK SC",
    "Noto Serif",
    "Noto Naskh Arabic",
    "Source Han Serif",
    "SimSun",
    "Arial Unicode MS",
)
# Words of more letters than this may be broken: in narrow cells and in the title, and elsewhere.
_NARROW, _WIDE = 26, 70
_SQUARE = "\N{WHITE SQUARE}"
_NO_FONT = Notes(
    "note",
    "Letters without a font",
    (("For some letters no font was found here; they may show as boxes. In the HTML report a browser shows them.",),),
)
_SHORT = 18
"""Lines of a table that is kept on one page; longer ones are broken, so that no page stays half empty."""
_LONG = 8
"""Rows from which on a table of two columns has its second half beside the first."""
_TABLE_PT = 8.5
"""Size of the letters of all tables, and of the references."""
_HELD = 3
"""Rows at the head and the foot of a longer table that stay together."""
_GAP_MM = 2
"""Between figures side by side."""
_WIDTH_MM, _HEIGHT_MM = 170.0, 225.0
"""Room for a figure on a page, its caption left out."""


def pdf(document: Document) -> bytes:
    """Return the document as PDF; the same document gives the same bytes with the same fonts."""
    (content,) = compiled(document, "pdf")
    return content


def pages(document: Document, ppi: float = 100.0) -> list[bytes]:
    """Return the pages as PNG, to look at them."""
    return compiled(document, "png", ppi)


def compiled(document: Document, kind: Literal["pdf", "png"], ppi: float | None = None) -> list[bytes]:
    """Compile a document to ``"pdf"``, one file, or ``"png"``, one for each page."""
    with temporary() as directory:
        for number, figure in enumerate(_figures(document.blocks)):
            (directory / f"{number}.svg").write_bytes(figure.svg)
        return compile_typst(source(document).encode(), directory, kind, ppi)


def source(document: Document) -> str:
    """Return the source in typst."""
    look = files("heeltoe.views.report").joinpath("report.typ").read_text(encoding="utf-8")
    fonts = ", ".join(map(_string, _FONTS))
    head = f"#let footer-text = {_string(document.footer)}\n#let fonts = ({fonts})\n"
    title = (
        f"#set document(title: {_string(document.title)})\n"
        f'#block(below: 0.7em, text(19pt, weight: "bold", {_words(document.title, _NARROW)}))\n'
        f"#block(below: 1.4em, text(11pt, fill: luma(70), {_words(document.subtitle)}))\n"
    )
    title += _about(document.about)
    body = "\n".join(_Writer().write(document.blocks))
    if _unreadable(title + body):
        title += _plain(_NO_FONT) + "\n"
    return head + look + title + body


def _about(rows: tuple[tuple[str, str], ...]) -> str:
    """Return the title block."""
    cells = ", ".join(f"{_words(label)}, {_words(text or ' ', _NARROW)}" for label, text in rows)
    return f"#title-block({cells})\n" if rows else ""


def _unreadable(text: str) -> bool:
    """Whether there are letters for which this machine has no font, as far as matplotlib knows; typst draws boxes."""
    from heeltoe.views.figures.fonts import readable

    return not text.isascii() and readable(text)[0].count(_SQUARE) > text.count(_SQUARE)


def _figures(blocks: tuple[Block, ...]) -> Iterator[FigureBlock]:
    for block in blocks:
        if isinstance(block, FigureBlock):
            yield block
        elif isinstance(block, Beside):
            yield from block.figures
        elif isinstance(block, Section):
            yield from _figures(block.blocks)


class _Writer:
    """Writes blocks; counts figures, which are files by their number."""

    def __init__(self) -> None:
        self.figures = 0
        self.placement = "auto"

    def write(self, blocks: tuple[Block, ...], level: int = 1) -> Iterator[str]:
        waiting = False
        for block in blocks:
            if isinstance(block, Section):
                # Figures that wait for a page with room for them come before the next section.
                if level == 1 and waiting:
                    yield "#place.flush()"
                if level == 1:
                    self.placement = "auto"
                waiting = any(_figures((block,)))
                if block.page:
                    yield "#pagebreak(weak: true)"
                yield f"#heading(level: {level}, {_words(block.title)})"
                yield from self.write(block.blocks, level + 1)
            elif isinstance(block, FigureBlock):
                # Text flows on until there is a page with room for it.
                yield "#" + self._figure(block, "none" if block.held else self._next())
            elif isinstance(block, Beside):
                columns = ", ".join(f"{figure.share:g}fr" for figure in block.figures)
                figures = ", ".join(self._figure(figure, "none") for figure in block.figures)
                yield (
                    f"#place({self._next()}, float: true, grid(columns: ({columns}), column-gutter: {_GAP_MM}mm, "
                    f"align: bottom, {figures}))"
                )
            else:
                yield _plain(block)

    def _next(self) -> str:
        """Return where the next figure goes: the first of a section where typst likes, so that it does not stand above
        the heading of another one; others to the head of a page, as those at its foot leave a gap above them."""
        placement, self.placement = self.placement, "top"
        return placement

    def _figure(self, block: FigureBlock, placement: str) -> str:
        width, height = block.size
        shown = min(block.share * _WIDTH_MM, width / height * _HEIGHT_MM)
        name = f'"{self.figures}.svg"'
        self.figures += 1
        caption = _words(block.caption)
        picture = f"image({name}, width: {shown:.1f}mm, alt: {_string(block.caption)})"
        return f"figure(placement: {placement}, {picture}, caption: {caption})"


def _plain(block: Block) -> str:
    if isinstance(block, Paragraph):
        # What leads to an equation or a table stays with it.
        leads = isinstance(block.parts[-1], str) and block.parts[-1].endswith(":")
        return f"#block(sticky: {'true' if leads else 'false'}, {_inline(block.parts)})"
    if isinstance(block, Notes):
        items = "".join(f"{_inline(item)}, " for item in block.items)
        return f"#notes({_string(block.kind)}, {_words(block.title)}, ({items}))"
    if isinstance(block, Table):
        return _table(block)
    if isinstance(block, Equation):
        return f"#numbered({block.number}, $ {block.typst} $)"
    if isinstance(block, References):
        items = "".join(f"{_words(item)}, " for item in block.items)
        return f'#text({_TABLE_PT}pt, enum(numbering: "[1]", {items}))' if items else ""
    assert isinstance(block, Listing)
    return f"#listing({_string(_breakable(block.text, _WIDE))})"


def _in_halves(table: Table) -> Table:
    """Return a long narrow table with its second half beside the first."""
    if len(table.head) != 2 or len(table.rows) < _LONG or table.widths:
        return table
    half = -(-len(table.rows) // 2)
    blank: tuple[Inline, ...] = ("", "")
    second = (*table.rows[half:], *[blank] * (2 * half - len(table.rows)))
    rows = tuple((*left, "", *right) for left, right in zip(table.rows[:half], second, strict=True))
    return replace(table, head=(*table.head, "", *table.head), rows=rows, align=f"{table.align}l{table.align}")


def _table(table: Table) -> str:
    table = _in_halves(table)
    count = len(table.head)
    widths = [f"{share:g}fr" for share in table.widths] or ["auto"] * count
    letters = table.align.ljust(count, "l")
    broken = _lines(table) > _SHORT and not table.whole
    held_together = broken and len(table.rows) > _SHORT
    if held_together:
        widths, letters = ["0pt", *widths], "l" + letters
    columns = ", ".join(widths)
    align = ", ".join("right" if letter == "r" else "left" for letter in letters)
    # Short tables stay in one piece; long ones keep their first and their last rows together by cells without width.
    held = f"table.cell(rowspan: {_HELD}, breakable: false, inset: 0pt, [])"
    cells = [
        "table.hline(stroke: 0.8pt)",
        f"table.header({'[], ' * held_together}{', '.join(f'strong({_words(name)})' for name in table.head)}, "
        "table.hline(stroke: 0.4pt))",
    ]
    for place, row in enumerate(table.rows):
        if held_together and place in (0, len(table.rows) - _HELD):
            cells.append(held)
        elif held_together and _HELD <= place < len(table.rows) - _HELD:
            cells.append("[]")
        cells += [_inline((cell,), _NARROW if table.widths else _WIDE) for cell in row]
    cells.append("table.hline(stroke: 0.8pt)")
    body = f"text({_TABLE_PT}pt, table(columns: ({columns}), align: ({align},), {', '.join(cells)}))"
    figure = f"figure(kind: table, supplement: [Table], caption: {_words(table.caption)}, {body})"
    return f"#{{ show figure: set block(breakable: {str(broken).lower()}); {figure} }}"


def _lines(table: Table) -> int:
    """Return about how many lines the rows of a table take."""
    longest = (
        max((len(getattr(cell, "text", cell if isinstance(cell, str) else "")) for cell in row), default=0)
        for row in table.rows
    )
    return sum(max(1, -(-letters // _WIDE)) for letters in longest)


def _inline(parts: tuple[Inline, ...], most: int = _WIDE) -> str:
    return "[" + "".join(f"#{_part(part, most)};" for part in parts) + "]"


def _part(part: Inline, most: int) -> str:
    if isinstance(part, Value):
        return f"box({_words(part.text)})"
    if isinstance(part, Code):
        return f"code({_string(_breakable(part.text, most))})"
    if isinstance(part, Strong):
        return f"strong({_words(part.text)})"
    if isinstance(part, Symbol):
        index = f"#sub({_words(part.index)})" if part.index else ""
        return f"[#emph({_words(part.letter)}){index}]"
    return _words(part, most)


def _words(text: str, most: int = _WIDE) -> str:
    """Return a user's text as a call that typst prints literally."""
    return f"words({_string(_breakable(text, most))})"


def _breakable(text: str, most: int) -> str:
    """Let words of more letters than `most` be broken, after a mark if there is one; others stay whole."""

    def broken(match: re.Match[str]) -> str:
        parts = re.findall(rf".{{1,{most // 2}}}[._/,=-]|.{{1,{most // 2}}}", match[0])
        return "\u200b".join(parts)

    # Nor is a unit broken at its stroke.
    text = re.sub(r"(\d[ \u00a0][A-Za-z-]{1,7}/)(?=[a-z])", "\\1\u2060", text)
    return re.sub(rf"\S{{{most + 1},}}", broken, text)


def _string(text: str) -> str:
    """Return a string of typst's: nothing in it is markup."""
    plain = "".join(c if c.isprintable() or c in "\u00a0\u200b\u2060" else " " for c in text)
    return '"' + plain.replace("\\", "\\\\").replace('"', '\\"') + '"'
