"""Where heeltoe explain, the code and the pages send their readers: headings, equations, and pages of the site."""

from __future__ import annotations

import re

from heeltoe.views.explain.find import everything
from heeltoe.views.explain.pages import pages
from shared.dams import ROOT
from shared.pages import PAGES, equations, headings


def test_where_a_name_is_explained_there_is_something():
    for place in pages():
        page, _, number = place.partition(" equation ")
        page, _, heading = page.partition("#")
        assert f"docs/{page}" in PAGES, place
        assert not number or number in equations(f"docs/{page}"), place
        assert not heading or heading in headings(f"docs/{page}"), place


def test_all_those_places_are_used():
    assert {item.page for item in everything() if item.page} == set(pages())


def test_equations_that_the_code_names_are_there():
    named = []
    for top, ending in (("python", "py"), ("crates", "rs"), ("docs", "md")):
        for path in (ROOT / top).rglob(f"*.{ending}"):
            text = " ".join(path.read_text(encoding="utf-8").split())
            result = re.findall(r"docs/([\w-]+\.md),? equations? (\d+[a-z]?)(?: to (\d+[a-z]?))?", text)
            result += re.findall(r"\[[\w-]+\.md\]\(([\w-]+\.md)\), equation (\d+[a-z]?)()", text)
            named += [(f"docs/{page}", number) for page, *numbers in result for number in numbers if number]
    assert named
    for page, number in named:
        assert number in equations(page), (page, number)


def test_every_page_is_in_the_contents():
    listed = set(re.findall(r"^([a-z-]+(?:/[a-z]+)?)$", PAGES["docs/index.md"], re.MULTILINE))
    there = {page.removeprefix("docs/").removesuffix(".md") for page in PAGES if page.startswith("docs/")}
    # The pages of the book depend on its first one.
    assert {page for page in there if not page.startswith("validation/")} - {"index"} <= listed
    assert {page for page in listed if not page.startswith("generated/")} <= there
