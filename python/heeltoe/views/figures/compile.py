"""Pages and pictures by typst, which reads SVG: the PDF of a report, and figures as PNG without drawing them twice."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from importlib.util import find_spec
from pathlib import Path
from shutil import copyfile
from typing import Any, Literal

from heeltoe.base.atomic_files import temporary
from heeltoe.errors.error import InputError

# Address space that typst takes for a report, threads and fonts, twice over [bytes].
_ROOM = 300e6
_PAGE = "#set page(margin: 0pt, width: auto, height: auto)\n"
# For so many compilations typst keeps what it has read and drawn, which takes more memory than all else in a report.
_KEPT_FOR = 10


def can_compile() -> bool:
    """Whether typst is installed, and the process is allowed the memory that it may ask for."""
    return find_spec("typst") is not None and _missing_room() is None


def compiled(source: bytes, root: Path, kind: Literal["pdf", "png"], ppi: float | None = None) -> list[bytes]:
    """Compile a source of typst to ``"pdf"``, one file, or ``"png"``, one for each page.

    Parameters
    ----------
    source
        In UTF-8.
    root
        Directory of the files that it names.
    kind
        Format of the result.
    ppi
        Pixels of a PNG for each inch.

    Raises
    ------
    InputError
        Where the process is not allowed as much more memory as typst may ask for, or typst gives up.
    """
    made = _compile(_compiler(root), source, kind, ppi)
    return [made] if isinstance(made, bytes) else list(made)


def pictures(drawings: Iterable[Path], ppi: float) -> Iterator[bytes]:
    """Yield the pictures of SVG files as PNG, in their order."""
    # Files of a user may have names that typst does not take.
    with temporary() as folder:
        compiler = _compiler(folder)
        for number, drawing in enumerate(drawings):
            copyfile(drawing, folder / f"{number}.svg")
            yield _compile(compiler, f'{_PAGE}#image("{number}.svg")\n'.encode(), "png", ppi)
            for _ in range(_KEPT_FOR):
                _compile(compiler, _PAGE.encode(), "png", ppi)


def _compiler(root: Path) -> Any:
    """Return a compiler of sources that name files in a directory, which looks for fonts once.

    Raises
    ------
    InputError
        Where the process is not allowed as much more memory as typst may ask for.
    """
    import typst
    from matplotlib import get_data_path

    left = _missing_room()
    if left is not None:
        raise InputError("report-package-broken", "report", "typst", reason=left)
    return typst.Compiler(root=str(root), font_paths=[str(Path(get_data_path()) / "fonts" / "ttf")])


def _compile(compiler: Any, source: bytes, kind: Literal["pdf", "png"], ppi: float | None) -> Any:
    """Compile a source: one file, or a list of several pages."""
    try:
        return compiler.compile(source, format=kind, ppi=ppi, timestamp=0)
    except BaseException as error:
        # An error of its Rust, as where it gets no threads, is no Exception, and has no class to name.
        if type(error).__name__ != "PanicException":
            raise
        raise InputError("report-package-broken", "report", "typst", reason=error) from None


def _missing_room() -> str | None:
    """Say how much memory is left where that is less than typst may ask for, since asking ends the process then; None
    where there is enough."""
    try:
        import resource

        allowed, _ = resource.getrlimit(resource.RLIMIT_AS)
        taken = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0]) * resource.getpagesize()
    except (ImportError, OSError, ValueError):  # other systems tell it otherwise, or not at all
        return None
    if allowed == resource.RLIM_INFINITY or allowed - taken >= _ROOM:
        return None
    return f"it wants {_ROOM / 1e6:.0f} MB of memory, {max(0, allowed - taken) / 1e6:.0f} MB are left"
