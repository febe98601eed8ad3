"""Say whether all that names the version names the same one; with a tag, whether that does, too.

    python .ci/version.py [v1.2.3]

The version stands in Cargo.toml. The lock file and CITATION.cff repeat it, and the changelog has a heading for it.
"""

from __future__ import annotations

import re
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]


def problems(root: Path, tag: str | None = None) -> list[str]:
    """Return what does not name the version of Cargo.toml, a sentence each."""
    texts = {
        name: (root / name).read_text(encoding="utf-8")
        for name in ("Cargo.toml", "Cargo.lock", "CITATION.cff", "CHANGELOG.md")
    }
    version = str(tomllib.loads(texts["Cargo.toml"])["workspace"]["package"]["version"])
    result = []
    ours = [item for item in tomllib.loads(texts["Cargo.lock"])["package"] if item["name"].startswith("heeltoe")]
    if {our["version"] for our in ours} != {version}:
        result.append(f"Cargo.lock has another version of ours than {version}: run cargo update --workspace")
    if not re.search(rf"^version: {re.escape(version)}$", texts["CITATION.cff"], re.MULTILINE):
        result.append(f"CITATION.cff has another version than {version}")
    heading = re.search(rf"^## {re.escape(version)} \((.+)\)$", texts["CHANGELOG.md"], re.MULTILINE)
    if heading is None:
        result.append(f"CHANGELOG.md has no heading for {version}")
    if tag is not None and tag != f"v{version}":
        result.append(f"the tag is {tag}, the version {version}")
    date = re.search(r"^date-released: (\S+)$", texts["CITATION.cff"], re.MULTILINE)
    cited = date[1] if date else "unreleased"
    if heading is not None and (heading[1] != cited or (tag is not None and date is None)):
        result.append(f"CHANGELOG.md dates {version} {heading[1]}, CITATION.cff {cited}; a tag needs a day in both")
    return result


if __name__ == "__main__":
    sys.exit("\n".join(problems(ROOT, *sys.argv[1:2])) or 0)
