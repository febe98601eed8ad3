"""Try the wheel of a folder as a stranger does: in an empty environment, without a compiler, outside the sources.

    python .ci/try_wheel.py FOLDER

A sdist beside the wheel is looked into. Python's own modules are all it needs; packages have the versions of
requirements.lock. It says how long each step took.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile
import threading
import time
import urllib.parse
import urllib.request
import venv
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
WINDOWS = os.name == "nt"
EXTRAS = "animation,app,records,report,study"
COMPILERS = ("cargo", "rustc", "gcc", "cc", "clang", "zig")
# What an engineer is promised, from the wheel to the first report [s of processor time]: a machine that is busy keeps
# the promise, too. A command that hangs is given up after PATIENCE [s].
LONGEST, PATIENCE = 600, 3600


class Environment:
    """An empty environment: its own programs alone, a home of its own, nothing of ours."""

    def __init__(self, place: Path) -> None:
        self.home = place / "home"
        self.home.mkdir()
        venv.create(place / "env", with_pip=True)
        self.programs = place / "env" / ("Scripts" if WINDOWS else "bin")
        kept = {"SYSTEMROOT", "TEMP", "TMP", "PIP_INDEX_URL", "PIP_CONFIG_FILE", "PIP_CERT", "SSL_CERT_FILE"}
        passed = {name: value for name, value in os.environ.items() if name in kept or name.lower().endswith("_proxy")}
        self.variables = {**passed, "PATH": str(self.programs), "HOME": str(self.home), "COLUMNS": "160"}
        result = [name for name in COMPILERS if shutil.which(name, path=self.variables["PATH"])]
        assert not result, f"the environment has {result}"
        if WINDOWS:
            self.variables["USERPROFILE"] = str(self.home)

    def program(self, name: str) -> str:
        """Return the path of a program."""
        return str(self.programs / (f"{name}.exe" if WINDOWS else name))

    def run(self, name: str, *arguments: str | Path, expected: int = 0) -> str:
        """Run a program in the home, say what it took, and return all that it said."""
        begun = time.monotonic()
        done = subprocess.run(
            [self.program(name), *map(str, arguments)],
            cwd=self.home,
            env=self.variables,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            encoding="utf-8",
            timeout=PATIENCE,
            check=False,
        )
        words = " ".join([name, *map(str, arguments)])
        print(f"{time.monotonic() - begun:7.1f} s  {words if len(words) < 120 else words[:117] + '...'}", flush=True)
        assert done.returncode == expected, f"{words}: exit code {done.returncode}\n{done.stdout}"
        return done.stdout

    def file(self, name: str, least: int, begins: bytes = b"") -> None:
        """Assert that a file was written that can hold something."""
        data = (self.home / name).read_bytes()
        assert len(data) > least, f"{name} has {len(data)} bytes"
        assert data.startswith(begins), f"{name} begins with {data[:8]!r}"


def constraints(place: Path) -> Path:
    """Write the versions of the lock file, without their hashes, which a wheel of ours cannot have."""
    matches = re.findall(
        r"^([\w.-]+==[\w.!+-]+)", (ROOT / "requirements.lock").read_text(encoding="utf-8"), re.MULTILINE
    )
    path = place / "constraints.txt"
    path.write_text("".join(f"{match}\n" for match in matches), encoding="utf-8")
    return path


def names(wheel: Path) -> set[str]:
    """Return the files of a wheel, what is compiled and what says its version apart."""
    with zipfile.ZipFile(wheel) as archive:
        result = {re.sub(r"^heeltoe-[^/]+\.dist-info/", "dist-info/", name) for name in archive.namelist()}
    return {name for name in result if not re.fullmatch(r"heeltoe/kernel/_kernel\..*(so|pyd)|dist-info/sboms/.*", name)}


def check_contents(wheel: Path) -> None:
    """Compare a wheel with the sources: all modules, pages, templates and examples, one kernel, nothing else."""
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "python", "examples"],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout.splitlines()
    expected = {name.removeprefix("python/") for name in listed if name.startswith("python/")}
    expected |= {f"heeltoe/{name}" for name in listed if name.startswith("examples/") and name.endswith(".toml")}
    about = ("METADATA", "WHEEL", "RECORD", "entry_points.txt", "licenses/LICENSE")
    expected |= {f"dist-info/{name}" for name in about}
    different = names(wheel) ^ expected
    assert not different, f"{wheel.name} and the sources differ in {sorted(different)}"
    with zipfile.ZipFile(wheel) as archive:
        kernels = [name for name in archive.namelist() if re.search(r"_kernel\..*(so|pyd)$", name)]
    assert len(kernels) == 1, kernels
    assert "-abi3-" in wheel.name, wheel.name


def check_app(home: Environment) -> None:
    """Start the app, take its first page and what that asks for, and end it as Ctrl-C does."""
    begun = time.monotonic()
    flags = subprocess.CREATE_NEW_PROCESS_GROUP if sys.platform == "win32" else 0
    app = subprocess.Popen(
        [home.program("heeltoe"), "app", "--no-browser", "--port", "0"],
        cwd=home.home,
        env=home.variables,
        stdout=subprocess.PIPE,
        text=True,
        creationflags=flags,
    )
    late = threading.Timer(60, app.kill)
    late.start()
    try:
        assert app.stdout is not None
        address = re.search(r"http://\S+", app.stdout.readline())
        assert address, "the app says no address"
        # As a browser does, it shows the token of the address by a cookie from then on.
        browser = urllib.request.build_opener(urllib.request.HTTPCookieProcessor())
        page = browser.open(address[0], timeout=30).read().decode()
        assert "<title>heeltoe" in page, page
        asked = re.findall(r'(?:src|href)="([^":]+\.(?:js|css|svg))"', page)
        assert asked, page
        for name in asked:
            assert browser.open(urllib.parse.urljoin(address[0], name), timeout=30).read(), name
        print(f"{time.monotonic() - begun:7.1f} s  heeltoe app: its page and {len(asked)} files of it", flush=True)
        if sys.platform == "win32":
            app.terminate()
        else:
            app.send_signal(signal.SIGINT)
            assert app.wait(30) == 0
    finally:
        late.cancel()
        app.kill()
        app.wait()


def _processor_time() -> float:
    """Return the processor time [s] of the programs that have been run and have ended."""
    spent = os.times()
    return spent.children_user + spent.children_system


def check_commands(home: Environment, wheel: Path, fixed: Path) -> None:
    """Install a wheel and do with it what a user does, first of all a report."""
    begun, processor = time.monotonic(), _processor_time()
    pip = ("-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--constraint", fixed)
    home.run("python", *pip, wheel)
    assert f"heeltoe {wheel.name.split('-')[1]} kernel release" in home.run("heeltoe", "--version")
    home.run("heeltoe", "new", "mydam")
    made = "synthetic:M6.5,20km,seed=3"
    assert "slides" in home.run("heeltoe", "run", "mydam.toml", "--motion", made, "--out", "small")
    assert "report" in home.run("heeltoe", "run", "mydam.toml", "--motion", made, "--report", expected=2)
    home.run("python", *pip, f"{wheel}[{EXTRAS}]")
    elastic = ("--set", "concrete.modulus=20GPa")
    home.run("heeltoe", "run", "mydam.toml", *elastic, "--model", "both", "--report")
    home.file("mydam-report/report.pdf", 100_000, b"%PDF")
    home.file("mydam-report/report.html", 100_000)
    taken, processor = time.monotonic() - begun, _processor_time() - processor
    print(
        f"{taken:7.1f} s  in all, from the wheel to the first report, {processor:.1f} s of processor time", flush=True
    )
    assert processor < LONGEST, f"at most {LONGEST} s of processor time"
    home.run("heeltoe", "statics", "mydam.toml", "--report")
    home.file("mydam-statics/report.pdf", 50_000, b"%PDF")
    home.run("heeltoe", "examples")
    # Two of its dams cannot stand before the earthquake: they are counted and named, and the study has its answer.
    words = home.run("heeltoe", "study", "examples/studies/fragility.toml", "--out", "fragility", "--report")
    assert "2 of 10,000 runs ended without a result: unstable 2" in words
    home.file("fragility/report.pdf", 50_000, b"%PDF")
    home.run("heeltoe", "animate", "examples/block.toml", "--to", "block.html")
    home.file("block.html", 20_000)
    home.run("heeltoe", "animate", "examples/block.toml", "--to", "block.mp4", "--fps", "5")
    home.file("block.mp4", 10_000)
    check_app(home)


def check_sdist(sdist: Path) -> None:
    """Look into a sdist: the kernel with its tests, and the package, nothing that was built, no record."""
    with tarfile.open(sdist) as archive:
        kept = {name.partition("/")[2] for name in archive.getnames()}
    needed = {
        "Cargo.lock",
        "crates/heeltoe-python/build.rs",
        "examples/block.toml",
        "python/heeltoe/py.typed",
        "LICENSE",
    }
    assert needed <= kept, needed - kept
    unwanted = r"\.(so|pyd|parquet|png|AT2)$|(^|/)(out|target)/|^(tests|python/.*/tests)/"
    wrong = [name for name in kept if re.search(unwanted, name)]
    assert not wrong, wrong


def main() -> None:
    """Try the wheel of the folder that is named."""
    folder = Path(sys.argv[1]).resolve()
    (wheel,) = folder.glob("*.whl")
    print(f"{wheel.name}: {wheel.stat().st_size / 1e6:.1f} MB")
    check_contents(wheel)
    for sdist in folder.glob("*.tar.gz"):
        check_sdist(sdist)
    with tempfile.TemporaryDirectory(prefix="wheel-") as name:
        place = Path(name)
        check_commands(Environment(place), wheel, constraints(place))
    print(f"{wheel.name}: works without a compiler, outside its sources")


if __name__ == "__main__":
    main()
