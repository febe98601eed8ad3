"""What all tests share."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Any

# Several processes test at once, and matrices are small: threads of the linear algebra would only wait for each other.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import pytest
from hypothesis import HealthCheck, settings
from xdist.scheduler import LoadFileScheduling

import heeltoe
from heeltoe.errors.error import CATALOGUE as ERRORS
from heeltoe.errors.error import InputError
from heeltoe.warnings.notice import CATALOGUE as WARNINGS
from heeltoe.warnings.notice import Notice, templates
from shared.attack_page import write_page
from shared.dams import FAST, ROOT, SHORT, example

# Not tests themselves, but what they assert with.
pytest.register_assert_rewrite("shared.drawn", "shared.report_reader")

_BESIDE = ROOT.parent / "shared" / "records"
if "HEELTOE_RECORDS" not in os.environ and _BESIDE.is_dir():
    os.environ["HEELTOE_RECORDS"] = str(_BESIDE)


# No deadlines: machines differ. In CI the examples are the same each time, so that a change is judged by itself.
settings.register_profile(
    "heeltoe",
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
    derandomize="CI" in os.environ,
)
settings.load_profile("heeltoe")

_CATALOGUES = {
    "error": list(ERRORS),
    "warning": [f"{code} {sentence}".rstrip() for code in WARNINGS for sentence in templates(code)],
}
# All errors and warnings that the tests of this process have raised: "error" or "warning", and the code; the kind of
# a warning behind it.
_RAISED: set[tuple[str, str]] = set()
# What a complete run has not raised of the catalogues.
_UNTESTED = pytest.StashKey[list[str]]()


def pytest_configure(config: pytest.Config) -> None:
    """Note every error and warning that is made, to see in the end whether all of the catalogues are tested."""
    _note(InputError, "error")
    _note(Notice, "warning")
    if not hasattr(config, "workerinput"):
        config.pluginmanager.register(FailuresAtOnce(config))


def _note(notice: type[InputError] | type[Notice], kind: str) -> None:
    plain = notice.__init__

    def noting(self: InputError | Notice, code: str, *args: object, **context: object) -> None:
        of_code = f"{code} {args[0]}".rstrip() if kind == "warning" and args else code
        _RAISED.add((kind, of_code))
        plain(self, code, *args, **context)  # type: ignore[arg-type]

    notice.__init__ = noting  # type: ignore[assignment, method-assign]


class FailuresAtOnce:
    """The name of a test on a line of its own as soon as it fails: a run that is ended early has said it, too."""

    def __init__(self, config: pytest.Config) -> None:
        self.config = config

    @pytest.hookimpl(trylast=True)
    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        terminal = self.config.pluginmanager.get_plugin("terminalreporter")
        if report.failed and terminal:
            # The letter of the test stands on the line before.
            terminal.write(f"\nFAILED {report.nodeid} ({report.when}, {report.duration:.0f} s)\n")


def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> LoadFileScheduling | None:
    """Give a process whole files, and all pages of the app to one process, which serves them once."""
    return OneApp(config, log) if config.getoption("dist") == "loadfile" else None


class OneApp(LoadFileScheduling):  # type: ignore[misc]
    """Files as they are handed out, the pages of the app as one of them."""

    def _split_scope(self, nodeid: str) -> str:
        file: str = super()._split_scope(nodeid)
        return "pages" if file.endswith("_page.py") else file


def pytest_testnodedown(node: object) -> None:
    """Gather what a worker of pytest-xdist has seen."""
    _RAISED.update((kind, code) for kind, code in getattr(node, "workeroutput", {}).get("raised", ()))


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    """Fail a complete run in which some error or warning of the catalogues was never raised."""
    config = session.config
    if hasattr(config, "workeroutput"):
        config.workeroutput["raised"] = sorted(_RAISED)
        return
    complete = (
        config.option.markexpr in ("", "not slow and not product")
        and not config.option.keyword
        and not config.option.collectonly
    )
    if complete and config.args == config.getini("testpaths") and session.exitstatus == 0:
        declared = {(kind, code) for kind, codes in _CATALOGUES.items() for code in codes}
        config.stash[_UNTESTED] = sorted(f"{kind} {code}" for kind, code in declared - _RAISED)
        if config.stash[_UNTESTED]:
            session.exitstatus = 1


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> Iterator[None]:
    """Show what came of all attacks, and after all else what the tests have left out of the catalogues."""
    _show_attacks(terminalreporter)
    yield
    if untested := terminalreporter.config.stash.get(_UNTESTED, []):
        terminalreporter.write_sep("=", "declared in a catalogue, but raised by no test")
        for entry in untested:
            terminalreporter.write_line(f"FAILED catalogue: {entry}")


def _show_attacks(terminalreporter: pytest.TerminalReporter) -> None:
    # Tests that were not chosen stand there, too, and are none.
    reports = [
        report
        for reports in terminalreporter.stats.values()
        for report in reports
        if isinstance(report, pytest.TestReport)
    ]
    rows = [
        value
        for report in reports
        if report.when == "call"
        for name, value in report.user_properties
        if name == "attack"
    ]
    if not rows:
        return
    ends = ("accepted", "refused", "no result", "defect")
    terminalreporter.write_sep("-", "attacks")
    terminalreporter.write_line(f"{'':32s}{'tried':>10s}" + "".join(f"{end:>10s}" for end in ends))
    for what, counts in [
        *sorted(rows, key=lambda row: str(row[0])),
        ("all", sum((Counter(counts) for _, counts in rows), Counter())),
    ]:
        columns = "".join(f"{counts.get(end, 0):>10d}" for end in ends)
        terminalreporter.write_line(f"{what:32s}{sum(counts.values()):>10d}{columns}")
    # Each process of several that test also comes here, with its own part.
    alone = not hasattr(terminalreporter.config, "workerinput")
    if alone and (page := os.environ.get("HEELTOE_ATTACK_PAGE")):
        write_page(Path(page), rows, add=bool(os.environ.get("HEELTOE_ATTACK_ADD")))


@pytest.fixture(scope="session")
def records() -> Path:
    """Directory of strong-motion records, which are not part of the project."""
    if not os.environ.get("HEELTOE_RECORDS"):
        pytest.skip("no strong-motion records here; set HEELTOE_RECORDS")
    return Path(os.environ["HEELTOE_RECORDS"])


# Runs that several modules look at, each computed once by each process of a test run. Results cannot be changed.


@pytest.fixture(scope="session")
def typical_both() -> heeltoe.Response:
    """The typical dam as a rigid block and as an elastic dam, for 3 s."""
    return heeltoe.run(example("typical-base", *FAST, "motion.sign=recorded"), "both")


@pytest.fixture(scope="session")
def typical_elastic(typical_both) -> heeltoe.Response:
    """The same as an elastic dam alone."""
    return replace(typical_both, beside=None)


@pytest.fixture(scope="session")
def typical_written(typical_both, tmp_path_factory) -> tuple[Path, list[Path]]:
    """All files of both, figures too: the directory, and what was said to be written."""
    from heeltoe.views.files.write import write_all

    directory = tmp_path_factory.mktemp("typical")
    return directory, write_all(typical_both, directory)


@pytest.fixture(scope="session")
def koyna_both() -> heeltoe.Response:
    """Koyna by the decoupled chain and by the flexible model, for 4 s."""
    return heeltoe.run(example("koyna", *SHORT, "flexible.evidence=none", "motion.sign=recorded"), "decoupled,flexible")


@pytest.fixture(scope="session")
def koyna(koyna_both) -> heeltoe.Response:
    """Koyna by the decoupled chain."""
    return koyna_both.beside


@pytest.fixture
def no_figures(monkeypatch):
    """Leave out figures, which take most of the time, where words and numbers alone are looked at."""
    monkeypatch.setattr("heeltoe.views.content.drawings.drawings", lambda figures, cracks=None, ahead=None: {})
    monkeypatch.setattr("heeltoe.views.figures.write.save_all", lambda figures, directory, finish=None: [])


@pytest.fixture
def empty_figures(monkeypatch):
    """Write figures as empty files, where it matters alone which there are."""
    monkeypatch.setattr("heeltoe.views.figures.write.laid_out", lambda figure: nullcontext())
    monkeypatch.setattr("heeltoe.views.figures.write.save", lambda figure, path: path.touch())
    monkeypatch.setattr("heeltoe.views.figures.write.can_compile", lambda: False)
