"""Links, files, fields of a case and Python names in the documentation: all are there, and mean one thing."""

from __future__ import annotations

import re
from importlib import import_module
from typing import Any

from heeltoe.case.read import case_schema
from shared.dams import ROOT
from shared.pages import PAGES, files, headings, links, spans

SCHEMA = case_schema()
BLOCKS = "|".join(set(SCHEMA["properties"]) - {"title"})


def lead_somewhere(page: str, target: str) -> bool:
    """Whether a link leads to a file, and to a heading of it; pages that the site generates are looked up there."""
    if re.match("https?:|(?:../)?generated/", target):
        return True
    name, _, anchor = target.partition("#")
    place = ((ROOT / page).parent / name).resolve() if name else ROOT / page
    return place.exists() and (not anchor or anchor in headings(str(place.relative_to(ROOT))))


def test_links_lead_somewhere():
    assert len(links()) > 300
    assert [(page, target) for page, target in links() if not lead_somewhere(page, target)] == []
    assert not lead_somewhere("README.md", "docs/no-such-page.md")
    assert not lead_somewhere("README.md", "docs/rigid.md#no-such-heading")


def test_tests_that_are_named_are_there():
    """SECURITY.md names the test of each of its promises."""
    named = [pair for text in PAGES.values() for pair in re.findall(r"`(tests/[\w./-]+\.py)::(\w+)", text)]
    assert len(named) > 1
    missing = [(file, name) for file, name in named if f"def {name}(" not in (ROOT / file).read_text(encoding="utf-8")]
    assert missing == []


def test_source_files_are_named_so_that_they_are_found():
    wrong = []
    for page, text in PAGES.items():
        for name in sorted(set(re.findall(r"[\w./-]+\.(?:py|rs)\b", text))):
            result = [path for path in files() if path == name or path.endswith(f"/{name}")]
            result = [path for path in result if path == name or not path.startswith("tests/")]
            wrong += [(page, name, result)] if len(result) != 1 else []
    assert wrong == []


def test_paths_are_there():
    places = r"(?:docs|examples|tests|benchmarks|crates|python)/[\w./-]*\w"
    named = {(page, path) for page, text in PAGES.items() for path in re.findall(rf"(?<![\w/.]){places}", text)}
    absent = {
        (page, path)
        for page, path in named
        if not path.startswith(("docs/_build", "docs/generated"))
        and not any(file == path or file.startswith(f"{path}/") for file in files())
    }
    assert absent == set()


def field(path: str) -> Any:
    """Return the schema of a field of a case by its path, None where there is no such field."""
    result: Any = SCHEMA
    for name in path.split("."):
        reference = re.search(r"#/\$defs/(\w+)", str(result.get("$ref", result.get("anyOf", ""))))
        result = SCHEMA["$defs"][reference[1]] if reference else result
        result = result.get("properties", {}).get(name)
        if result is None:
            return None
    return result


def test_fields_of_a_case_are_there():
    for page in PAGES:
        for span in spans(page):
            named = re.match(rf"((?:{BLOCKS})(?:\.[a-z_]+)+)(?: =|$)", span)
            if named and not span.endswith((".parquet", ".png", ".pvd")):
                assert field(named[1]) is not None, (page, span)


def is_there(name: str) -> bool:
    """Whether a dotted Python name is there: a module, or what stands in one."""
    parts = name.split(".")
    for end in range(len(parts), 0, -1):
        try:
            thing = import_module(".".join(parts[:end]))
        except ModuleNotFoundError:
            continue
        return all((thing := getattr(thing, part, None)) is not None for part in parts[end:])
    return False


def test_python_names_are_there():
    names = sorted(set(re.findall(r"heeltoe(?:\.\w+)+", "".join(PAGES.values()))))
    assert [name for name in names if not is_there(name)] == []
    assert not is_there("heeltoe.no_such_name")
