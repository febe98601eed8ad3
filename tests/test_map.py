"""The map in CONTRIBUTING.md: folders say themselves what is in them, and the walk through a run is the one that is
taken."""

import ast
import re
import sys
import tomllib

import pytest

from shared.command import command
from shared.dams import ROOT

PACKAGE = ROOT / "python" / "heeltoe"
MAP = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8").split("## Map")[1].split("\n## ")[0]
WALK = re.findall(r"^\d+\. `([\w./-]+)`, `(\w+)`: ", MAP, flags=re.MULTILINE)


def layers():
    """Return what stands in the package, the highest first."""
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["importlinter"][
        "contracts"
    ]
    return [name for layer in contracts[0]["layers"] for name in re.split(r"\s*[|:]\s*", layer)]


def paragraph(text):
    return " ".join(text.split("\n\n")[0].split())


def of_package(folder):
    return paragraph(ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))))


def of_crate(folder):
    lines = (folder / "src" / "lib.rs").read_text(encoding="utf-8").split("\n\n")[0].splitlines()
    return paragraph("\n".join(line.removeprefix("//!") for line in lines))


def test_each_folder_says_what_the_map_says():
    rows = re.findall(r"^\| `([\w/-]+)/` \| (.+) \|$", MAP, flags=re.MULTILINE)
    folders = [name for name in layers() if (PACKAGE / name).is_dir()]
    crates = sorted((path for path in (ROOT / "crates").iterdir() if path.is_dir()), reverse=True)
    expected = [(f"python/heeltoe/{name}", of_package(PACKAGE / name)) for name in folders]
    assert rows == expected + [(f"crates/{path.name}", of_crate(path)) for path in crates]


def test_a_folder_holds_its_subject_in_files():
    """The root hands out public names, and the records are a registry of formats; all others say what they are."""
    others = {PACKAGE / "__init__.py", PACKAGE / "motion" / "records" / "__init__.py"}
    for path in set(PACKAGE.rglob("__init__.py")) - others:
        (message,) = ast.parse(path.read_text(encoding="utf-8")).body
        assert isinstance(message, ast.Expr), path


def test_the_root_holds_users_names_and_rooms_alone():
    files = {path.name for path in PACKAGE.iterdir() if path.is_file() and path.suffix in (".py", ".pyi", ".so")}
    assert files == {"__init__.py", "__main__.py"}


@pytest.mark.parametrize(("file", "function"), WALK)
def test_each_stop_of_the_walk_is_there(file, function):
    path = ROOT / file if file.startswith("crates/") else PACKAGE / file
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        assert function in {node.name for node in ast.parse(text).body if isinstance(node, ast.FunctionDef)}
    else:
        assert re.search(rf"\bfn {function}\b", text)


def test_a_run_takes_this_walk():
    stops = [(str(PACKAGE / file), function) for file, function in WALK if file.endswith(".py")]
    assert len(stops) > 10
    taken = []

    def note(frame, event, _):
        stop = (frame.f_code.co_filename, frame.f_code.co_name)
        if event == "call" and stop in stops and stop not in taken:
            taken.append(stop)

    sys.setprofile(note)
    try:
        process = command("run", ROOT / "examples" / "block.toml")
    finally:
        sys.setprofile(None)
    assert process.returncode == 0, process.stderr
    assert taken == stops
