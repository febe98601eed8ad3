"""Pages and pictures by typst, which reads SVG: the PDF of a report, and figures as PNG without drawing them twice."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any, Literal

from heeltoe.errors.error import InputError

# Address space that typst takes for a report, threads and fonts, twice over [bytes].
_ROOM = 300e6
_PAGE = "#set page(margin: 0pt, width: auto, height: auto)\n"
# So many pictures are made at once; memory grows with them.
_TOGETHER = 2


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
        What it becomes.
    ppi
        Pixels of a PNG for each inch.

    Raises
    ------
    InputError
        Where the process is not allowed as much more memory as typst may ask for, or typst gives up.
    """
    import typst
    from matplotlib import get_data_path

    left = _missing_room()
    if left is not None:
        raise InputError("report-package-broken", "report", "typst", reason=left)
    # Its types know one page only, and source and directory of one kind.
    made: Any
    given: Any = source
    try:
        made = typst.compile(
            given,
            root=str(root),
            format=kind,
            ppi=ppi,
            timestamp=0,
            font_paths=[str(Path(get_data_path()) / "fonts" / "ttf")],
        )
    except BaseException as error:
        # What its Rust gives up with, as where it gets no threads, is no Exception, and has no class to name.
        if type(error).__name__ != "PanicException":
            raise
        raise InputError("report-package-broken", "report", "typst", reason=error) from None
    return [made] if isinstance(made, bytes) else list(made)


def pictures(drawings: Sequence[Path], root: Path, ppi: float) -> list[bytes]:
    """Return the pictures of SVG files below a directory as PNG, in their order."""
    pages = [f"#page(image({_quoted(drawing.relative_to(root).as_posix())}))\n" for drawing in drawings]
    sources = ("".join([_PAGE, *pages[start : start + _TOGETHER]]) for start in range(0, len(pages), _TOGETHER))
    return [picture for source in sources for picture in compiled(source.encode(), root, "png", ppi)]


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


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
