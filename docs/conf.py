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
from docutils.utils.math.latex2mathml import tex2mathml  # noqa: E402
from gallery import write_gallery  # noqa: E402
from reference import write_reference  # noqa: E402
from sphinx.application import Sphinx  # noqa: E402

from heeltoe.kernel.build import build_info  # noqa: E402

# The finite elements log each of their steps.
logging.getLogger("skfem").setLevel(logging.WARNING)

project = "heeltoe"
author = "The heeltoe authors"
release = version = build_info()["heeltoe"]
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon"]
exclude_patterns = ["_build", "site"]
myst_heading_anchors = 4
myst_enable_extensions = ["deflist", "dollarmath"]
# Indented blocks are commands, which need no colours; blocks of programs name their language.
highlight_language = "none"
default_role = "code"
# Two dashes mark an option, two strokes a second derivative.
smartquotes = False
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_member_order = "bysource"
napoleon_use_rtype = False
html_theme = "furo"
html_title = f"heeltoe {release}"
html_static_path = ["static"]
html_css_files = ["heeltoe.css"]
# Equations become MathML while the site is built: browsers draw it themselves, without a script or a network.
html_math_renderer = "mathml"
html_show_copyright = False
html_show_sourcelink = html_copy_source = False

# A letter and its lower index.
_INDEX = re.compile(r"(?<=[A-Za-zα-ω])_([0-9A-Za-z]{1,2})(?![\w.])")
_TAG = re.compile(r"\\tag\{(\d+[a-z]?)\}")
_PLACES = re.compile(r"^code ")


def _generate(app: Sphinx) -> None:
    place = HERE / "generated"
    place.mkdir(exist_ok=True)
    write_reference(place)
    write_gallery(place)
    shutil.copy(HERE.parent / "benchmarks" / "results.md", place / "benchmarks.md")


def _list_the_book(app: Sphinx, page: str, source: list[str]) -> None:
    """List the pages of the validation book below its first page, and lead links to the benchmarks' results to their
    copy here."""
    source[0] = re.sub(r"\]\((?:\.\./)+benchmarks/results\.md", "](/generated/benchmarks.md", source[0])
    if page == "validation/index":
        source[0] += "\n```{toctree}\n:hidden:\n:glob:\n\n*\n```\n"


def _mathml(formula: str, block: bool = False) -> str:
    """Return a formula as MathML, with strokes of derivatives as such."""
    return str(tex2mathml(formula, as_block=block)).replace("<mo>'</mo>", '<mo lspace="0" rspace="0">′</mo>')


def _show_formula(translator: Any, node: Any) -> None:
    """Write a formula within a sentence as MathML."""
    translator.body.append(_mathml(node.astext()))
    raise nodes.SkipNode


def _show_equation(translator: Any, node: Any) -> None:
    """Write an equation on lines of its own as MathML, with its number; ``rigid.html#equation-5`` leads to it."""
    number = _TAG.search(node.astext())
    formula = _mathml(_TAG.sub("", node.astext()).strip(), block=True)
    place = f' id="equation-{number[1]}"' if number else ""
    label = f'<span class="number">({number[1]})</span>' if number else ""
    translator.body.append(f'<div class="equation"{place}>{formula}{label}</div>\n')
    raise nodes.SkipNode


def _mark_places(app: Sphinx, tree: Any) -> None:
    """Mark the lines below equations that name their code and their test."""
    for line in tree.findall(nodes.paragraph):
        if _PLACES.match(line.astext()) and " · test " in line.astext():
            line["classes"].append("places")


def _lower_indices(app: Sphinx, tree: Any) -> None:
    """Show *m_z* with a lower index."""
    for letters in list(tree.findall(nodes.emphasis)):
        parts = _INDEX.split(letters.astext())
        if len(parts) > 1 and len(letters.children) == 1:
            shown = [nodes.subscript("", part) if place % 2 else nodes.Text(part) for place, part in enumerate(parts)]
            letters.children = []
            letters.extend(shown)


def setup(app: Sphinx) -> None:
    """Connect the generators and the renderer of equations."""
    app.add_html_math_renderer("mathml", (_show_formula, None), (_show_equation, None))
    app.connect("builder-inited", _generate)
    app.connect("source-read", _list_the_book)
    app.connect("doctree-read", _mark_places)
    app.connect("doctree-read", _lower_indices)
