"""No exception of a library that reads reaches a user: each is raised at each call, whatever a library promises."""

from __future__ import annotations

import csv
import gzip
import io
import json
import lzma
import struct
import tomllib
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from shared.attacked import Attack
from shared.dams import BASE, BLOCK, COARSE
from shared.studies import BLOCK as BLOCK_CASE
from shared.studies import study_file

RECORD = b"# units: time [s], acceleration [g]\n" + b"".join(b"%.2f 0.1\n" % (0.01 * k) for k in range(50))
#: What Python's own readers of text may raise.
OWN: dict[str, tuple[BaseException, ...]] = {
    "TOML": (tomllib.TOMLDecodeError("odd"), RecursionError("deep")),
    "JSON": (json.JSONDecodeError("odd", "text", 0), RecursionError("deep")),
    "CSV": (csv.Error("odd"),),
    "file": (OSError(5, "Input/output error"), PermissionError(13, "Permission denied"), TimeoutError("late")),
}
#: What a library may raise that says nothing of it.
ANY: tuple[BaseException, ...] = (
    *(ValueError("odd"), TypeError("odd"), KeyError("odd"), IndexError("odd"), AttributeError("odd")),
    *(OSError("odd"), EOFError(), RuntimeError("odd"), NotImplementedError("odd"), ZeroDivisionError("odd")),
    *(AssertionError(), UnicodeDecodeError("utf-8", b"\xff", 0, 1, "odd"), struct.error("odd"), zlib.error("odd")),
    *(lzma.LZMAError("odd"), StopIteration(), RecursionError("deep"), Exception("two\nlines\x1b[2J")),
)
Prepared = Callable[[Path], list[str | Path]]


def _case(place: Path) -> list[str | Path]:
    (place / "case.json").write_text(json.dumps({"section": {}}))
    return ["run", "case.json"]


def _packed(name: str) -> Prepared:
    def prepare(place: Path) -> list[str | Path]:
        whole = io.BytesIO()
        with zipfile.ZipFile(whole, "w", zipfile.ZIP_DEFLATED) as packed:
            packed.writestr("record.txt", RECORD)
        (place / name).write_bytes(whole.getvalue() if name.endswith("zip") else gzip.compress(RECORD))
        return ["motion", name]

    return prepare


def _seed(place: Path) -> list[str | Path]:
    obspy = pytest.importorskip("obspy")
    import numpy as np

    trace = obspy.Trace(np.arange(500, dtype=np.int32), {"network": "XY", "station": "ABC", "channel": "HNE"})
    obspy.Stream([trace]).write(str(place / "record.mseed"), format="MSEED")
    (place / "record.xml").write_text("<FDSNStationXML/>")
    return ["motion", "record.mseed"]


def _mesh(place: Path) -> list[str | Path]:
    pytest.importorskip("meshio")
    (place / "mesh.vtu").write_text("<VTKFile/>")
    changes = ["flexible.mesh_above=" + str(place / "mesh.vtu"), *COARSE]
    return ["periods", BASE, *(word for change in changes for word in ("--set", change))]


def _drawing(place: Path) -> list[str | Path]:
    ezdxf = pytest.importorskip("ezdxf")
    drawing = ezdxf.new()
    drawing.modelspace().add_lwpolyline([(0, 0), (8, 0), (0, 12)], close=True)
    drawing.saveas(place / "dam.dxf")
    return ["run", BLOCK, "--set", f"section={{file = '{place / 'dam.dxf'}', unit = 'm'}}"]


def _dams(place: Path) -> list[str | Path]:
    study_file(place, 'case = "case.toml"\ncases = "dams.csv"\n', case=BLOCK_CASE)
    (place / "dams.csv").write_text("name,crack.friction\na,0.5\nb,0.6\n")
    return ["study", "study.toml", "--dry-run"]


#: Each call that reads, what it may raise, and a command that comes to it.
CALLS: dict[str, tuple[str, tuple[BaseException, ...], Prepared]] = {
    "case in TOML": ("heeltoe.case.fields_file.tomllib.loads", OWN["TOML"], lambda place: ["run", BLOCK]),
    "case in JSON": ("heeltoe.case.fields_file.json.loads", OWN["JSON"], _case),
    "case": ("heeltoe.case.fields_file.read_bounded", OWN["file"], _case),
    "table of dams": ("heeltoe.base.input_files.csv.reader", OWN["CSV"], _dams),
    "zip": ("zipfile.ZipFile", ANY, _packed("record.zip")),
    "file in a zip": ("zipfile.ZipExtFile.read", ANY, _packed("record.zip")),
    "gzip": ("gzip.GzipFile.read", ANY, _packed("record.gz")),
    "miniSEED": ("obspy.read", ANY, _seed),
    "StationXML": ("obspy.read_inventory", ANY, _seed),
    "mesh": ("meshio.read", (*ANY, SystemExit(1)), _mesh),
    "drawing": ("ezdxf.filemanagement.readfile", ANY, _drawing),
    "polylines of a drawing": ("ezdxf.document.Drawing.modelspace", ANY, _drawing),
}


@pytest.mark.parametrize("name", CALLS)
def test_what_a_library_raises_is_one_sentence(name, tmp_path, record_property, monkeypatch):
    target, errors, prepare = CALLS[name]
    words = prepare(tmp_path)
    strikes = Attack("exceptions of libraries")
    for error in errors:

        def fail(*_: Any, error: BaseException = error, **named: Any) -> None:
            raise error

        with monkeypatch.context() as patch:
            patch.setattr(target, fail)
            end = strikes.strike(f"{name}: {error!r}", *words, cwd=tmp_path)
        if end == "accepted":
            strikes.defects.append(f"{name}: {error!r} is taken for nothing")
    strikes.report(record_property)


# Some of them as files.


def test_a_cell_without_end_is_one_sentence(tmp_path, record_property):
    words = _dams(tmp_path)
    (tmp_path / "dams.csv").write_text('name,crack.friction\na,"' + 200_000 * "x" + "\n")
    strikes = Attack("exceptions of libraries")
    assert strikes.strike("a long cell", *words, cwd=tmp_path) == "refused"
    strikes.report(record_property)


def test_a_damaged_archive_packed_by_lzma_is_one_sentence(tmp_path, record_property):
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w", zipfile.ZIP_LZMA) as packed:
        packed.writestr("record.txt", RECORD)
    data, strikes = whole.getvalue(), Attack("exceptions of libraries")
    for place in range(38, 60):
        (tmp_path / "record.zip").write_bytes(data[:place] + bytes([data[place] ^ 0xFF]) + data[place + 1 :])
        strikes.strike(f"byte {place}", "motion", "record.zip", cwd=tmp_path)
    strikes.report(record_property)
