"""A document as one HTML file that needs nothing else: figures, style and all are inside."""

from __future__ import annotations

import base64
from importlib.resources import files
from typing import TYPE_CHECKING

from heeltoe.errors.sanitize import harmless
from heeltoe.views.content.tree import Code, Document, FigureBlock, Inline, Section, Strong, Symbol
from heeltoe.views.words.numbers import Value

if TYPE_CHECKING:
    from markupsafe import Markup


def html(document: Document) -> str:
    """Return the document as HTML."""
    from jinja2 import Environment, StrictUndefined

    environment = Environment(autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=StrictUndefined)
    environment.filters["inline"] = inline
    environment.filters["data"] = data
    environment.tests["kind"] = lambda block, name: type(block).__name__ == name
    places = files("heeltoe.views.report")
    template = environment.from_string(places.joinpath("report.html.jinja").read_text(encoding="utf-8"))
    style = places.joinpath("report.css").read_text(encoding="utf-8")
    return template.render(document=document, style=style, contents=_contents(document))


def inline(parts: tuple[Inline, ...] | Inline) -> Markup:
    """Return running text as markup in which people's words are harmless."""
    from markupsafe import Markup

    return Markup("").join(map(_part, parts if isinstance(parts, tuple) else (parts,)))


def _part(part: Inline) -> Markup:
    from markupsafe import Markup, escape

    if isinstance(part, Value):
        form = Markup('<data class="number" data-key="{}" value="{}">{}</data>')
        return form.format(part.key, repr(part.number), part.text)
    if isinstance(part, Code):
        return Markup("<code>{}</code>").format(harmless(part.text))
    if isinstance(part, Strong):
        return Markup("<strong>{}</strong>").format(harmless(part.text))
    if isinstance(part, Symbol):
        index = Markup("<sub>{}</sub>").format(part.index) if part.index else ""
        return Markup("<i>{}{}</i>").format(part.letter, index)
    return escape(harmless(part))


def data(figure: FigureBlock) -> str:
    """Return a figure as the address of an image that carries it."""
    return "data:image/svg+xml;base64," + base64.b64encode(figure.svg).decode("ascii")


def _contents(document: Document) -> list[tuple[int, str]]:
    """Return number and title of every section."""
    sections = (block for block in document.blocks if isinstance(block, Section))
    return [(number, section.title) for number, section in enumerate(sections, start=1)]
