"""Our own figures by version: picked from the sections of results.md, kept in history.csv, shown in history.md.

run.py calls this for every part that it has measured. ``python benchmarks/history.py`` writes history.md anew;
``--all`` first gathers what every version of results.md in git has had.
"""

from __future__ import annotations

import argparse
import csv
import re
import subprocess
from dataclasses import astuple, dataclass, fields
from importlib.metadata import version
from pathlib import Path

HERE = Path(__file__).parent
STORE, TABLE = HERE / "history.csv", HERE / "history.md"
UNITS = {"ns": 1e-9, "µs": 1e-6, "ms": 1e-3, "s": 1.0}
_TIME = r"([\d.]+ (?:ns|µs|ms|s))\b"
#: Section of the results, the figure, and where it stands there.
FIGURES = (
    ("Rigid ensemble", "a dam, Taft, one core", rf"^\| dam, Taft S69E \| [\d,]+ \| 1 \|[^|]*\|[^|]*\| {_TIME}"),
    (
        "Rigid ensemble",
        "a slender block, Taft, one core",
        rf"^\| slender, Taft S69E \| [\d,]+ \| 1 \|[^|]*\|[^|]*\| {_TIME}",
    ),
    ("Rigid ensemble", "`heeltoe.rigid`, one dam", rf"^A single dam through .*?: {_TIME}"),
    ("A million runs", "a million rigid runs", rf"^\| 1,000,000 \| {_TIME}"),
    ("Flexible dams", "20 s, base crack", rf"^\| base crack \|(?:[^|]*\|){{4}} {_TIME}"),
    ("Flexible dams", "20 s, crack at 90 m", rf"^\| crack at 90 m \|(?:[^|]*\|){{4}} {_TIME}"),
    ("Flexible studies", "an elastic run of a study", rf"^\| a run of the study \| {_TIME}"),
    ("How cost grows", "30 s, rigid dam", rf"^\| 30 s \| {_TIME}"),
    ("How cost grows", "20 s, 16 across", rf"^\| 16 across \|[^|]*\| {_TIME}"),
    ("Commands", "elastic dam, from the shell", rf"^\| elastic dam, crack at its base \| {_TIME}"),
    ("The app in a browser", "the first answer is drawn", rf"^\| the first answer is drawn \| {_TIME}"),
)


@dataclass(frozen=True)
class Figure:
    """One figure: when, of which version on which machine, what, and how long [s]."""

    date: str
    version: str
    commit: str
    machine: str
    part: str
    figure: str
    seconds: str


def picked(section: str, commit: str) -> list[Figure]:
    """Return the figures of one section of the results."""
    title = section.split("\n", 1)[0].removeprefix("## ")
    match = re.search(r"^Measured (\S+) on (.*?); .*?heeltoe ([^,.\s]+(?:\.\w+)*)", section, re.M)
    if match is None:
        return []
    date, machine, release = match.groups()
    result = []
    for part, name, pattern in FIGURES:
        if part == title and (value := re.search(pattern, section, re.M)):
            number, unit = value[1].split()
            result.append(Figure(date, release, commit, machine, part, name, f"{float(number) * UNITS[unit]:.4g}"))
    return result


def read() -> list[Figure]:
    """Return all figures so far."""
    if not STORE.exists():
        return []
    with STORE.open(encoding="utf-8", newline="") as file:
        return [Figure(**line) for line in csv.DictReader(file)]


def add(new: list[Figure]) -> None:
    """Append figures, each once, and write the table anew."""
    known = read()
    known += [figure for figure in dict.fromkeys(new) if figure not in known]
    with STORE.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([field.name for field in fields(Figure)])
        writer.writerows(astuple(figure) for figure in known)
    TABLE.write_text(page(known), encoding="utf-8")


def page(known: list[Figure]) -> str:
    """Return history.md: a line for each day and version that has some, a column for each figure."""
    names = [(part, name) for part, name, _ in FIGURES if any((e.part, e.figure) == (part, name) for e in known)]
    heads = ["date", "version", "commit", *(name for _, name in names)]
    lines = [heads, ["---"] * len(heads)]
    for when in dict.fromkeys((item.date, item.version, item.commit) for item in known):
        of_then = {(e.part, e.figure): e.seconds for e in known if (e.date, e.version, e.commit) == when}
        lines.append([*when, *(_shown(of_then[item]) if item in of_then else "" for item in names)])
    machines = "; ".join(dict.fromkeys(item.machine for item in known))
    table = "\n".join("| " + " | ".join(line) + " |" for line in lines)
    return (
        "# Our own figures by version\n\nWritten by `python benchmarks/run.py`, which appends what it has measured to "
        f"history.csv. Measured on: {machines}. A shared server is slower "
        f"on some days: a change of less than a quarter says nothing by itself.\n\n{table}\n"
    )


def _shown(text: str) -> str:
    value = float(text)
    unit = next((unit for unit in ("s", "ms", "µs") if value >= UNITS[unit]), "ns")
    return f"{value / UNITS[unit]:.3g} {unit}"


def commit_now() -> str:
    """Return the commit that is checked out, or the version where there is no git."""
    try:
        return _git("rev-parse", "--short", "HEAD").strip() or version("heeltoe")
    except (OSError, subprocess.CalledProcessError):
        return version("heeltoe")


def _git(*words: str) -> str:
    return subprocess.run(["git", *words], cwd=HERE, capture_output=True, text=True, check=True).stdout


def from_git() -> list[Figure]:
    """Return the figures of every version of results.md, the oldest first; each with the commit that brought it."""
    result: list[Figure] = []
    for commit in _git("log", "--reverse", "--format=%h", "--", "results.md").split():
        sections = re.split(r"^(?=## )", _git("show", f"{commit}:./results.md"), flags=re.M)[1:]
        seen = {(item.date, item.part, item.figure, item.seconds) for item in result}
        for section in sections:
            result += [e for e in picked(section, commit) if (e.date, e.part, e.figure, e.seconds) not in seen]
    return result


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--all", action="store_true", help="gather all versions of results.md from git")
    add(from_git() if parser.parse_args().all else [])
