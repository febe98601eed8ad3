"""Links, files, fields of a case and Python names in the documentation: all are there, and mean one thing."""

from __future__ import annotations

import re
from importlib import import_module
from typing import Any

import pytest

from heeltoe.case.read import case_schema
from shared.dams import ROOT
from shared.pages import PAGES, files, headings, links, spans


@pytest.mark.parametrize(("page", "target"), links(), ids=lambda text: text)
def test_links_lead_somewhere(page, target):
    # What is generated when the site is built is looked up there.
    if re.match("https?:|(?:../)?generated/", target):
        return
    name, _, anchor = target.partition("#")
    place = ((ROOT / page).parent / name).resolve() if name else ROOT / page
    assert place.exists()
    if anchor:
        assert anchor in headings(str(place.relative_to(ROOT)))


@pytest.mark.parametrize("page", PAGES)
def test_source_files_are_named_so_that_they_are_found(page):
    for name in sorted(set(re.findall(r"[\w./-]+\.(?:py|rs)\b", PAGES[page]))):
        result = [path for path in files() if path == name or path.endswith(f"/{name}")]
        result = [path for path in result if path == name or not path.startswith("tests/")]
        assert len(result) == 1, (name, result)


@pytest.mark.parametrize("page", PAGES)
def test_paths_are_there(page):
    places = r"(?:docs|examples|tests|benchmarks|crates|python)/[\w./-]*\w"
    for path in sorted(set(re.findall(rf"(?<![\w/.]){places}", PAGES[page]))):
        if path.startswith(("docs/_build", "docs/generated")):
            continue
        assert any(file == path or file.startswith(f"{path}/") for file in files()), path


def field(path: str) -> Any:
    """Return the schema of a field of a case by its path, None where there is no such field."""
    schema = case_schema()
    result: Any = schema
    for name in path.split("."):
        reference = re.search(r"#/\$defs/(\w+)", str(result.get("$ref", result.get("anyOf", ""))))
        result = schema["$defs"][reference[1]] if reference else result
        result = result.get("properties", {}).get(name)
        if result is None:
            return None
    return result


BLOCKS = "|".join(set(case_schema()["properties"]) - {"title"})


@pytest.mark.parametrize("page", PAGES)
def test_fields_of_a_case_are_there(page):
    for span in spans(page):
        named = re.match(rf"((?:{BLOCKS})(?:\.[a-z_]+)+)(?: =|$)", span)
        if named and not span.endswith((".parquet", ".png", ".pvd")):
            assert field(named[1]) is not None, span


@pytest.mark.parametrize("name", sorted(set(re.findall(r"heeltoe(?:\.\w+)+", "".join(PAGES.values())))))
def test_python_names_are_there(name):
    parts = name.split(".")
    for end in range(len(parts), 0, -1):
        try:
            thing = import_module(".".join(parts[:end]))
        except ModuleNotFoundError:
            continue
        for part in parts[end:]:
            thing = getattr(thing, part)
        return
