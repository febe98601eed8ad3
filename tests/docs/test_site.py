"""The documentation as pages: what is generated says all that there is, and what is built asks no one."""

from __future__ import annotations

import ast
import importlib.util
import re
import runpy
import subprocess
import sys
from html import unescape
from pathlib import Path
from types import ModuleType

import pytest
from matplotlib.figure import Figure

import heeltoe
from heeltoe import read_case
from heeltoe.views.explain.find import everything
from shared.dams import FAST, ROOT

SITE = ROOT / "docs" / "site"
GALLERY = sorted((ROOT / "examples" / "gallery").glob("*.py"))


def module(name: str) -> ModuleType:
    """Return a generator, which no package has."""
    spec = importlib.util.spec_from_file_location(name, SITE / f"{name}.py")
    assert spec
    assert spec.loader
    result = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(result)
    return result


def test_the_reference_has_every_name(tmp_path):
    module("reference").write_reference(tmp_path)
    text = "".join(path.read_text(encoding="utf-8") for path in tmp_path.iterdir())
    for item in everything():
        assert f"`{item.name}`" in text or item.parts, item.name
    for name in heeltoe.__all__:
        assert f":: heeltoe.{name}\n" in text, name
    for option in ("--spread [N|none]", "--json FILE|-", "--resume"):
        assert f"`{option}`" in text, option


@pytest.mark.slow
@pytest.mark.parametrize("program", GALLERY, ids=lambda path: path.stem)
def test_a_program_of_the_gallery_draws(program, monkeypatch):
    # As it stands, with few elements and for a short time.
    monkeypatch.setattr(heeltoe, "read_case", lambda source, changes=(): read_case(source, changes).with_(*FAST))
    assert isinstance(runpy.run_path(str(program))["picture"](), Figure)
    assert ast.get_docstring(ast.parse(program.read_text(encoding="utf-8")))


@pytest.fixture(scope="module")
def site(tmp_path_factory) -> Path:
    pytest.importorskip("furo", reason="the extra docs is not installed")
    place = tmp_path_factory.mktemp("site") / "html"
    process = subprocess.run(
        [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", ROOT / "docs", place],
        capture_output=True,
        text=True,
        check=False,
    )
    assert process.returncode == 0, process.stderr
    return place


@pytest.mark.product
def test_the_site_is_built_without_a_warning_and_its_links_lead_somewhere(site):
    pages = {path: path.read_text(encoding="utf-8") for path in site.rglob("*.html")}
    assert len(pages) > 30
    names = {path: set(re.findall(r'\bid="([^"]+)"', text)) for path, text in pages.items()}
    dead = []
    for path, text in pages.items():
        for target in re.findall(r'<a [^>]*?href="([^"]+)"', text):
            file, _, anchor = unescape(target).partition("#")
            if re.match("[a-z]+:", file):
                continue
            place = (path.parent / file).resolve() if file else path
            if not place.exists() or (anchor and place in names and anchor not in names[place]):
                dead.append((path.name, target))
    assert not dead


@pytest.mark.product
def test_the_built_pages_ask_nothing_of_the_network(site):
    for path in site.rglob("*.html"):
        loads = re.findall(r'<(?:script|img|iframe|source)[^>]*? src="([^"]+)"', path.read_text(encoding="utf-8"))
        loads += re.findall(r'<link [^>]*?href="([^"]+)"', path.read_text(encoding="utf-8"))
        assert not [load for load in loads if re.match("(?:[a-z]+:)?//", load)], path.name
    for path in site.rglob("*.css"):
        assert not re.search(r"@import|url\(['\"]?(?:https?:)?//", path.read_text(encoding="utf-8")), path.name
