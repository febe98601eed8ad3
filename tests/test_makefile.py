"""The Makefile builds the kernel anew when any of its sources has changed."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
BUILT = Path(".venv/.built")
pytestmark = pytest.mark.skipif(shutil.which("make") is None, reason="make is not installed")


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """A source tree without git, all of it as old and the kernel built."""
    shutil.copytree(ROOT / "crates", tmp_path / "crates")
    for name in ("Makefile", "Cargo.toml", "Cargo.lock", "pyproject.toml", "requirements.lock"):
        shutil.copy(ROOT / name, tmp_path / name)
    for name in (".packages", ".built"):
        (tmp_path / ".venv").mkdir(exist_ok=True)
        (tmp_path / ".venv" / name).touch()
    for path in tmp_path.rglob("*"):
        os.utime(path, (1e9, 1e9))
    return tmp_path


def builds(tree: Path, *changed: Path) -> bool:
    """Whether make would build the kernel if these files had just been changed."""
    pretend = [word for path in changed for word in ("-W", str(path))]
    process = subprocess.run(
        ["make", "-n", *pretend, str(BUILT)], cwd=tree, capture_output=True, text=True, check=True, timeout=30
    )
    return "maturin" in process.stdout


@pytest.mark.slow
def test_every_source_of_the_kernel_is_seen(tree: Path) -> None:
    sources = [path.relative_to(tree) for path in tree.rglob("*.rs")]
    assert max(len(source.parts) for source in sources) > 5, "the deepest sources are not in the tree"
    assert not builds(tree)
    for source in [*sources, *map(Path, ("Cargo.toml", "Cargo.lock", "pyproject.toml", "crates/heeltoe/Cargo.toml"))]:
        assert builds(tree, source), f"{source} is not seen"
