"""Making what is taken away: in a process of its own."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from heeltoe.app.away.lines import OUT, Wanted, command
from heeltoe.app.bundle import CASE, zipped

#: All of it as one file.
ZIP = "heeltoe.zip"


def make(say: Callable[..., None], folder: Path, wanted: Wanted) -> dict[str, Any]:
    """Run the case of a folder, write all that is wanted into it, and return what there is."""
    from heeltoe.case.read import read_case
    from heeltoe.models.run import cost_of
    from heeltoe.study.analysis import analyse
    from heeltoe.views.animation.write import animate
    from heeltoe.views.files.write import figures_of, write_run
    from heeltoe.views.report.write import build_report, check_packages, write_kinds

    if wanted.report:
        check_packages(field="report")
    case = read_case(folder / CASE)
    cost = cost_of(case, wanted.model)
    say("running" if cost is None else f"running, about {max(1.0, cost.seconds):.0f} s")
    result = analyse(case, wanted.model, spread="cheap" if wanted.report else None, say=say)
    say("drawing")
    figures = figures_of(result, case, wanted.units)

    def report(fresh: Path) -> None:
        if wanted.report:
            say("writing the report")
            built = build_report(case, result, units=wanted.units, command=command(wanted), figures=figures)
            write_kinds(built, fresh)

    write_run(result, folder / OUT, figures, suffix=wanted.suffix, report=report)
    if wanted.animation and result.histories:
        say("drawing the animation")
        animate(case.with_({"units": wanted.units}), result, folder / OUT / "animation.html")
    say("packing")
    zipped(folder, folder / ZIP, without=(".heeltoe-files",))
    return {"files": listed(folder), "verdict": _verdict(result, wanted.units)}


def _verdict(result: Any, units: str) -> str:
    from heeltoe.result.verdict import verdict

    return verdict(result, units)


def listed(folder: Path) -> list[dict[str, Any]]:
    """Return the files that were made, by their names below the folder."""
    found = sorted(path for path in (folder / OUT).rglob("*") if path.is_file() and not path.name.startswith("."))
    return [{"name": path.relative_to(folder / OUT).as_posix(), "bytes": path.stat().st_size} for path in found]
