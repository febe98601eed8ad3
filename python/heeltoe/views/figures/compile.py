"""Pages and pictures by typst, which reads SVG: the PDF of a report, and figures as PNG without drawing them twice."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from shutil import copyfile
from typing import Any, Literal

from heeltoe.base.atomic_files import temporary
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
        Format of the result.
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
        # An error of its Rust, as where it gets no threads, is no Exception, and has no class to name.
        if type(error).__name__ != "PanicException":
            raise
        raise InputError("report-package-broken", "report", "typst", reason=error) from None
    return [made] if isinstance(made, bytes) else list(made)


def pictures(drawings: Sequence[Path], ppi: float) -> list[bytes]:
    """Return the pictures of SVG files as PNG, in their order."""
    made: list[bytes] = []
    for start in range(0, len(drawings), _TOGETHER):
        some = drawings[start : start + _TOGETHER]
        # Files of a user may have names that typst does not take.
        with temporary() as folder:
            for number, drawing in enumerate(some):
                copyfile(drawing, folder / f"{number}.svg")
            pages = [f'#page(image("{number}.svg"))\n' for number in range(len(some))]
            made += compiled("".join([_PAGE, *pages]).encode(), folder, "png", ppi)
    return made


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
