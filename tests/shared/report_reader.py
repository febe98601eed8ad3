"""What the tests of the report share: a reader of its HTML and its PDF, and a short case."""

from __future__ import annotations

import io
import json
import re
from html.parser import HTMLParser

import pytest
from pypdf import PdfReader

from heeltoe.result.write import json_text
from heeltoe.views.content.tree import Section
from heeltoe.views.report.html import html
from heeltoe.views.report.typst_pdf import pdf
from heeltoe.views.words.numbers import Value


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
        attributes = dict(attrs)
        self.links += [attributes[name] for name in ("src", "href") if name in attributes]
        if "data-key" in attributes:
            self._key, self._value = attributes["data-key"], float(attributes["value"])

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


def values(blocks):
    """All numbers of a tree of blocks."""
    for block in blocks:
        if isinstance(block, Section):
            yield from values(block.blocks)
        else:
            parts = getattr(block, "parts", ())
            for row in getattr(block, "rows", ()):
                parts = (*parts, *row)
            yield from (part for part in parts if isinstance(part, Value))


UNITS = {
    "mm": 1e-3,
    "mrad": 1e-3,
    "MN/m": 1e6,
    "kN/m": 1e3,
    "MJ/m": 1e6,
    "kJ/m": 1e3,
    "t/m": 1e3,
    "MPa": 1e6,
    "kPa": 1e3,
}
UNITS |= {"%": 0.01}
UNITS |= {"ft": 0.3048, "in": 0.0254, "ft/s": 0.3048, "ft/s²": 0.3048, "psi": 6894.757, "ksi": 6894757.0}
UNITS |= {"kip/ft": 14593.903, "ft-kip/ft": 4448.2216, "ton/ft": 2976.3279}


def read_back(text):
    """The number that a text shows in SI, and half of its last digit."""
    text = text.removeprefix("≥ ").removeprefix("≤ ")
    number, _, unit = text.partition(" ")
    mantissa, _, exponent = number.partition("·10")
    power = int(exponent.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789")) or 0)
    decimals = len(mantissa.partition(".")[2])
    factor = UNITS.get(unit, 1.0) * 10.0**power
    return float(mantissa) * factor, 0.5 * 10.0**-decimals * factor


def check_numbers(document, result):
    data = json.loads(json_text(result.to_json()))
    reader = Reader(html(document))
    printed = squeezed(pdf_text(pdf(document)))
    assert len(reader.numbers) > 40
    for key, (number, text) in reader.numbers.items():
        if not key.startswith("statics."):
            assert number == lookup(data, key), key
        if text.startswith("under "):
            shown_number, _ = read_back(text.removeprefix("under "))
            assert abs(number) < shown_number, (key, text)
        else:
            shown_number, half = read_back(text)
            # Digits that are zero may be left out, angles have three digits.
            assert abs(shown_number) == pytest.approx(abs(number), abs=half * 1.0001, rel=1e-3), (key, text)
        assert squeezed(text) in printed, (key, text)
    return reader, printed
