"""The report on sizes counts what it says it counts, and never fails."""

import runpy
import subprocess
import sys

import pytest

from shared.dams import ROOT

SIZES = runpy.run_path(str(ROOT / ".ci" / "sizes.py"))


def test_functions_are_measured_without_their_docstrings():
    python = 'def one(self, a, *b, c=1, **d):\n    """Say.\n\n    More.\n    """\n    def two(): ...\n    return 1\n'
    assert list(SIZES["python_functions"](python)) == [("one", 3, 4), ("two", 1, 0)]
    rust = (
        "trait A { fn no(&self) -> [u8; 3]; }\n"
        "fn one<'a>(s: &'a str) -> f64 {\n // }\n let c = '}';\n if x { \"{\" }\n}\n"
    )
    assert list(SIZES["rust_functions"](rust)) == [("one", 5, 0)]


@pytest.mark.slow
def test_it_is_a_report_that_lint_prints():
    done = subprocess.run([sys.executable, ROOT / ".ci" / "sizes.py"], capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert done.stdout.startswith("large ")
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    assert ".ci/sizes.py" in makefile.split("\nsizes:")[1].split("\n\n")[0]
    assert "sizes" in makefile.split("\nlint:")[1].split("\n\n")[0]
