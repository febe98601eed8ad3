"""Wishes that are too large: each says time and memory before it begins, and Ctrl-C ends it within two seconds.

The machine may be busy: processor time is measured, not that of a clock. ``pytest -s`` prints what was said and
measured. ``HEELTOE_WISHES=60`` lets those of at most so many estimated seconds run to their end, too, and compares."""

from __future__ import annotations

import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
import tomllib
from pathlib import Path

import pytest

from shared.dams import ROOT

pytestmark = [
    pytest.mark.product,
    pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="the system does not say what a process has used"),
]
SAID = re.compile(r"takes about ([\d.]+) (s|min|h|days) and ([\d.]+) GB of memory; Ctrl-C ends it")
SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0, "days": 86400.0}
#: Estimated seconds up to which a wish runs to its end.
LONGEST = float(os.environ.get("HEELTOE_WISHES", "0"))
#: Seconds that a program takes by itself; so long it may say nothing, by its processor time.
STARTS, SILENT = 2.0, 12.0
FREE = {"analysis.time_limit": "25 h", "analysis.memory_limit": "50 GB"}


def case(folder: Path, name: str, **changes: object) -> Path:
    """Write an example with changes by the paths of its fields."""
    fields = tomllib.loads((ROOT / "examples" / f"{name}.toml").read_text(encoding="utf-8"))
    for path, value in (FREE | changes).items():
        block = fields
        *blocks, last = path.split(".")
        for each in blocks:
            block = block.setdefault(each, {})
        block[last] = value
    place = folder / "case.json"
    place.write_text(json.dumps(fields))
    return place


def record(folder: Path, hours: float) -> Path:
    """Write a record that swings evenly, 100 samples a second."""
    wave = [0.0, 0.6, 1.0, 0.6, 0.0, -0.6, -1.0, -0.6]
    place = folder / "long.txt"
    place.write_text("".join(f"{value:g}\n" for value in wave) * int(hours * 360000 / len(wave)))
    return place


def shaken(folder: Path, name: str, hours: float, **changes: object) -> Path:
    file = {"file": str(record(folder, hours)), "unit": "m/s^2", "time_step": "0.01 s"}
    return case(folder, name, motion=file, **changes)


def study(folder: Path, text: str, name: str = "typical-base", **changes: object) -> Path:
    case(folder, name, **changes)
    place = folder / "study.toml"
    place.write_text(f'case = "case.json"\n{text}')
    return place


def records(folder: Path, count: int) -> Path:
    """Write a folder of records with names of their own."""
    (folder / "records").mkdir()
    for number in range(count):
        wave = "".join(f"{value:.6f}\n" for value in [0.0, 1.0, 2.0, 1.0, 0.0, -1.0, -2.0, -1.0] * 60)
        head = f"# record {number}, m/s^2, dt = 0.01 s\n"
        (folder / "records" / f"quake{number:03d}.txt").write_text(head + wave)
    return folder / "records"


JOINTS = {"tensile_strength": "1 MPa", "cohesion": "1 MPa", "fracture_energy": "100 N/m", "shear_energy": "1000 N/m"}
GRID = '[vary]\n"crack.friction" = { from = 0.6, to = 1.4, count = 4096 }\n'
WIDER = '"reservoir.depth" = { from = "60 m", to = "95 m", count = 4096 }\n'
ELASTIC = ["--model", "flexible"]


def joints(folder: Path) -> Path:
    place = case(folder, "typical-base", **{"flexible.elements_across": 3, "flexible.evidence": "none"})
    fields = json.loads(place.read_text())
    del fields["crack"]
    fields["joints"] = {"every": "1.6 m", "friction": 1.0, "bond": JOINTS}
    place.write_text(json.dumps(fields))
    return place


WISHES = {
    "64 elements across": lambda to: ["run", case(to, "typical-base", **{"flexible.elements_across": 64}), *ELASTIC],
    "2,000 modes": lambda to: ["run", case(to, "typical-base", **{"flexible.modes": 2000}), *ELASTIC],
    "a tiny step": lambda to: ["run", case(to, "typical-base", **{"flexible.time_step": "1e-6 s"}), *ELASTIC],
    "an elastic dam for an hour": lambda to: ["run", shaken(to, "typical-base", 1.0), *ELASTIC],
    "200 runs of a spread": lambda to: ["run", case(to, "typical-base"), *ELASTIC, "--spread", "200"],
    "60 joints": lambda to: ["run", joints(to), *ELASTIC],
    "two cracks": lambda to: ["run", case(to, "two-cracks", **{"flexible.elements_across": 24}), *ELASTIC],
    "a bonded joint": lambda to: ["run", case(to, "bonded-joint"), *ELASTIC],
    "soft rock": lambda to: ["run", case(to, "typical-base", rock={"modulus": "2 GPa"}), *ELASTIC],
    "the elastic dam as it is": lambda to: ["run", case(to, "typical-base")],
    "a block for an hour": lambda to: ["run", shaken(to, "typical-base", 1.0), "--model", "rigid"],
    "a record of 24 h": lambda to: ["run", shaken(to, "typical-base", 24.0), "--model", "rigid"],
    "a look at a record of 24 h": lambda to: ["motion", record(to, 24.0), "--unit", "m/s^2", "--time-step", "0.01s"],
    "the chain for ten minutes": lambda to: ["run", shaken(to, "typical-height", 1 / 6), "--model", "decoupled"],
    "a spread of long runs": lambda to: [
        *("run", shaken(to, "typical-base", 0.2), "--model", "rigid", "--spread", "500"),
    ],
    "a table of elastic dams": lambda to: [
        *("run", case(to, "typical-base"), *ELASTIC, "--vary", "crack.friction={from=0.6,to=1.2,count=32}"),
    ],
    "a table of long runs": lambda to: [
        *("run", shaken(to, "typical-base", 0.2), "--model", "rigid"),
        *("--vary", "crack.friction={from=0.6,to=1.2,count=32}"),
    ],
    "solved by elastic runs": lambda to: [
        *("solve", case(to, "typical-base"), "crack.friction", "--until", "residual_slip = 50 mm", *ELASTIC),
    ],
    "solved by long runs": lambda to: [
        *("solve", shaken(to, "typical-base", 0.2), "crack.friction", "--until", "residual_slip = 50 mm"),
        *("--model", "rigid"),
    ],
    "checks after an elastic run": lambda to: ["statics", case(to, "typical-base"), *ELASTIC],
    "a table of checks": lambda to: [
        *("statics", case(to, "typical-base"), *ELASTIC, "--vary", "crack.friction={from=0.6,to=1.2,count=32}"),
    ],
    "a map of 160,000 pulses": lambda to: [
        "overturning",
        case(to, "typical-base"),
        "--count",
        "400",
        "--out",
        to / "m",
    ],
    "a video of ten minutes": lambda to: [
        *("animate", shaken(to, "typical-base", 1 / 6), "--model", "rigid", "--out", to / "a.mp4"),
    ],
    "a page of an elastic dam": lambda to: ["animate", case(to, "typical-base"), "--out", to / "a.html"],
    "a report": lambda to: ["run", case(to, "typical-base"), "--report", "--out", to / "report"],
    "a report of an hour": lambda to: [
        *("run", shaken(to, "typical-base", 1.0), "--model", "rigid", "--report", "--out", to / "report"),
    ],
    "a study of elastic dams": lambda to: [
        *("study", study(to, f'model = "flexible"\n{GRID}'), "--out", to / "out"),
    ],
    "a study of 17 million rows": lambda to: [
        *("study", study(to, f'model = "rigid"\n{GRID}{WIDER}'), "--out", to / "out"),
    ],
    "a plan of fine dams": lambda to: [
        *("study", study(to, f'model = "flexible"\n{GRID}', **{"flexible.elements_across": 48}), "--dry-run"),
    ],
    "a suite of elastic dams": lambda to: ["run", case(to, "typical-base"), *ELASTIC, "--motions", records(to, 40)],
    "periods of a fine mesh": lambda to: ["periods", case(to, "typical-base", **{"flexible.elements_across": 64})],
}


class Wish:
    """A command that runs."""

    def __init__(self, words: list[object], folder: Path) -> None:
        self.errors: list[str] = []
        self.process = subprocess.Popen(
            [sys.executable, "-m", "heeltoe", *map(str, words)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            cwd=folder,
            env={**os.environ, "COLUMNS": "200"},
            # Shells let what runs behind them ignore it.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
        )
        self.reader = threading.Thread(target=self._read)
        self.reader.start()

    def _read(self) -> None:
        assert self.process.stderr is not None
        self.errors.extend(self.process.stderr)

    def has_ended(self) -> bool:
        """Whether it has, which is still to be waited for."""
        return os.waitid(os.P_PID, self.process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None

    def used(self) -> float:
        """Return its processor time [s]."""
        with contextlib.suppress(OSError):
            fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
            return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")
        return 0.0

    def said(self) -> list[tuple[float, float]]:
        """Return what it has said [s, GB], once there is something, or it has ended or been silent for long."""
        while True:
            found = SAID.findall("".join(list(self.errors)))
            if found or self.has_ended() or self.used() > SILENT:
                return [(float(number) * SECONDS[unit], float(memory)) for number, unit, memory in found]
            time.sleep(0.1)

    def end(self) -> tuple[float, float, float]:
        """Wait for its end; return what it used then [s], the clock [s], and its memory at most [GB]."""
        began = time.monotonic()
        _, status, usage = os.wait4(self.process.pid, 0)
        self.process.returncode = os.waitstatus_to_exitcode(status)
        self.reader.join()
        assert self.process.stderr is not None
        self.process.stderr.close()
        return usage.ru_utime + usage.ru_stime, time.monotonic() - began, usage.ru_maxrss / 1e6


@pytest.mark.parametrize("name", WISHES)
def test_a_wish_says_what_it_takes_and_stops(name, tmp_path):
    wish = Wish(WISHES[name](tmp_path), tmp_path)
    said = wish.said()
    silent = wish.used()
    time.sleep(2.0)
    before = wish.used()
    os.kill(wish.process.pid, signal.SIGINT)
    used, clock, _ = wish.end()
    print(
        f"\n{name}: said {said} after {silent:.1f} s; stopped after {used - before:.1f} s ({clock:.1f} s by the clock)"
    )
    assert said, "".join(wish.errors)
    assert wish.process.returncode == 130, "".join(wish.errors)
    # Workers of a study have their own processor time, which counts when they have ended.
    assert used - before < 2.0 + STARTS


@pytest.mark.skipif(LONGEST == 0.0, reason="takes many minutes; HEELTOE_WISHES=60 runs what is estimated so long")
@pytest.mark.parametrize("name", WISHES)
def test_a_wish_takes_what_it_says(name, tmp_path):
    wish = Wish(WISHES[name](tmp_path), tmp_path)
    said = wish.said()
    if not said or max(seconds for seconds, _ in said) > LONGEST:
        os.kill(wish.process.pid, signal.SIGINT)
        wish.end()
        pytest.skip(f"it takes {said}")
    used, clock, memory = wish.end()
    found = [(float(number) * SECONDS[unit], float(gb)) for number, unit, gb in SAID.findall("".join(wish.errors))]
    seconds, gigabytes = sum(seconds for seconds, _ in found), max(gb for _, gb in found)
    print(f"\n{name}: said {seconds:.0f} s, {gigabytes:.1f} GB; took {used:.1f} s ({clock:.1f}), {memory:.2f} GB")
    assert 0.5 < (used - STARTS) / seconds < 2.0
    # A tenth of a gigabyte is what a program takes without anything.
    assert (memory - 0.1) / 2.0 < gigabytes < 2.0 * memory + 0.1
