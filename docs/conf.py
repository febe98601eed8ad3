"""How Sphinx builds the documentation: `make docs`. Reference and gallery are generated anew at each build."""

from __future__ import annotations

import logging
import re
import shutil
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "site"))

from docutils import nodes  # noqa: E402
from gallery import write_gallery  # noqa: E402
from reference import write_reference  # noqa: E402
from sphinx.application import Sphinx  # noqa: E402

from heeltoe.result.write import build_info  # noqa: E402

# The finite elements tell every step of theirs.
logging.getLogger("skfem").setLevel(logging.WARNING)

project = "heeltoe"
author = "The heeltoe authors"
release = version = build_info()["heeltoe"]
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
exclude_patterns = ["_build", "site"]
myst_heading_anchors = 4
myst_enable_extensions = ["deflist"]
# Indented blocks are commands and equations, for which there is no colouring; blocks of programs say their language.
highlight_language = "none"
default_role = "code"
# Two dashes are an option, two strokes a second derivative.
smartquotes = False
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_member_order = "bysource"
napoleon_use_rtype = False
html_theme = "furo"
html_title = f"heeltoe {release}"
html_static_path = ["static"]
html_css_files = ["heeltoe.css"]
html_show_copyright = False
html_show_sourcelink = html_copy_source = False

# One letter, and what stands below it.
_INDEX = re.compile(r"(?<=[A-Za-zα-ω])_([0-9A-Za-z]{1,2})(?![\w.])")
_EQUATION = re.compile(r"^ *\((\d+[a-z]?)\) ", re.MULTILINE)


def _generate(app: Sphinx) -> None:
    place = HERE / "generated"
    place.mkdir(exist_ok=True)
    write_reference(place)
    write_gallery(place)
    shutil.copy(HERE.parent / "benchmarks" / "results.md", place / "benchmarks.md")


def _list_the_book(app: Sphinx, page: str, source: list[str]) -> None:
    """Put the pages of the validation book below its first one, which knows nothing of Sphinx, and let links to the
    results of the benchmarks lead to their copy here."""
    source[0] = re.sub(r"\]\((?:\.\./)+benchmarks/results\.md", "](/generated/benchmarks.md", source[0])
    if page == "validation/index":
        source[0] += "\n```{toctree}\n:hidden:\n:glob:\n\n*\n```\n"


def _number_equations(app: Sphinx, tree: Any) -> None:
    """Let each equation be found by its number: ``rigid.html#equation-5``."""
    for block in tree.findall(nodes.literal_block):
        numbers = _EQUATION.findall(block.astext())
        if numbers:
            block["ids"] += [f"equation-{number}" for number in numbers]
            block["classes"].append("equation")


def _lower_indices(app: Sphinx, tree: Any) -> None:
    """Show *m_z* with a lower index."""
    for letters in list(tree.findall(nodes.emphasis)):
        parts = _INDEX.split(letters.astext())
        if len(parts) > 1 and len(letters.children) == 1:
            shown = [nodes.subscript("", part) if place % 2 else nodes.Text(part) for place, part in enumerate(parts)]
            letters.children = []
            letters.extend(shown)


def setup(app: Sphinx) -> None:
    """Hook the generators in."""
    app.connect("builder-inited", _generate)
    app.connect("source-read", _list_the_book)
    app.connect("doctree-read", _number_equations)
    app.connect("doctree-read", _lower_indices)
