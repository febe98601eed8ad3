"""What the tests of the report share: a reader of its HTML and its PDF, and a short case."""

from __future__ import annotations

import io
import re
from html.parser import HTMLParser

from pypdf import PdfReader


class Reader(HTMLParser):
    """Gathers the numbers with their keys, the tags, and all text."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.numbers: dict[str, tuple[float, str]] = {}
        self.tags: set[str] = set()
        self.links: list[str] = []
        self.text = ""
        self._key: str | None = None
        self._value = 0.0
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        found = dict(attrs)
        self.links += [found[name] for name in ("src", "href") if name in found]
        if "data-key" in found:
            self._key, self._value = found["data-key"], float(found["value"])

    def handle_data(self, data):
        self.text += data
        if self._key is not None:
            self.numbers[self._key] = (self._value, data)
            self._key = None


def pdf_text(data):
    """All text of a PDF with single blanks."""
    reader = PdfReader(io.BytesIO(data))
    return " ".join(
        " ".join(page.extract_text() for page in reader.pages).replace("\u200b", "").replace("\u2060", "").split()
    )


def squeezed(text):
    return re.sub(r"\s|[\u200b\u2060]", "", text)


def lookup(data, key):
    for name in key.split("."):
        data = data[int(name)] if isinstance(data, list) else data[name]
    return data
