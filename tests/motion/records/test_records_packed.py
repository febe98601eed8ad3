"""Records in archives, and those that obspy reads: what comes out, and what is refused, whatever an archive says."""

from __future__ import annotations

import bz2
import gzip
import io
import random
import struct
import tarfile
import zipfile

import numpy as np
import pytest

from heeltoe import InputError, read_channels, read_record
from heeltoe.motion.records import archive, seismology
from heeltoe.motion.records.read import read_text, read_text_channels
from heeltoe.motion.records.to_motion import Options
from shared.record_samples import GAL, WAVE, G, csmip
from shared.records_of_the_world import esm

COUNTS = np.rint(1e6 * G * WAVE).astype(np.int32) + 5000


def zipped(files: dict[str, bytes], method: int = zipfile.ZIP_DEFLATED) -> bytes:
    whole = io.BytesIO()
    with zipfile.ZipFile(whole, "w", method) as packed:
        for name, content in files.items():
            packed.writestr(name, content)
    return whole.getvalue()


def tarred(files: dict[str, bytes], *, links: dict[str, str] | None = None, kind: int = tarfile.PAX_FORMAT) -> bytes:
    whole = io.BytesIO()
    with tarfile.open(fileobj=whole, mode="w", format=kind) as packed:
        for name, target in (links or {}).items():
            link = tarfile.TarInfo(name)
            link.type, link.linkname = tarfile.SYMTYPE, target
            packed.addfile(link)
        for name, content in files.items():
            member = tarfile.TarInfo(name)
            member.size = len(content)
            packed.addfile(member, io.BytesIO(content))
    return whole.getvalue()


def with_checksum(header: bytearray) -> bytes:
    """A header of a tar whose sum is right again."""
    header[148:156] = b" " * 8
    header[148:156] = b"%06o\0 " % sum(header)
    return bytes(header)


def miniseed(counts: np.ndarray = COUNTS, *, gap: bool = False) -> bytes:
    obspy = pytest.importorskip("obspy")
    header = {"network": "XY", "station": "ABC", "channel": "HNE", "sampling_rate": 100.0}
    traces = [obspy.Trace(counts, header)]
    if gap:
        traces.append(obspy.Trace(counts, header | {"starttime": obspy.UTCDateTime(100.0)}))
    whole = io.BytesIO()
    obspy.Stream(traces).write(whole, format="MSEED")
    return whole.getvalue()


def sac(**header: float) -> bytes:
    obspy = pytest.importorskip("obspy")
    trace = obspy.Trace((G * WAVE).astype(np.float32), {"channel": "HNE", "sampling_rate": 100.0, "sac": header})
    whole = io.BytesIO()
    trace.write(whole, format="SAC")
    return whole.getvalue()


def station_xml(units: str = "M/S**2", sensitivity: float = 1e6) -> bytes:
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<FDSNStationXML xmlns="http://www.fdsn.org/xml/station/1" schemaVersion="1.1">
<Source>nobody</Source><Created>1970-01-01T00:00:00</Created>
<Network code="XY"><Station code="ABC"><Latitude>35</Latitude><Longitude>-120</Longitude><Elevation>0</Elevation>
<Site><Name>Empty Valley</Name></Site>
<Channel code="HNE" locationCode="" startDate="1960-01-01T00:00:00"><Latitude>35</Latitude><Longitude>-120</Longitude>
<Elevation>0</Elevation><Depth>0</Depth><SampleRate>100</SampleRate>
<Response><InstrumentSensitivity><Value>{sensitivity}</Value><Frequency>1</Frequency>
<InputUnits><Name>{units}</Name></InputUnits><OutputUnits><Name>COUNTS</Name></OutputUnits></InstrumentSensitivity>
</Response></Channel></Station></Network></FDSNStationXML>
""".encode()


def refused(data: bytes, name: str = "a.zip") -> InputError:
    with pytest.raises(InputError) as caught:
        read_text_channels(data, name, Options(assume=True))
    return caught.value


# Archives


def test_what_is_packed_is_read_as_what_is_not(tmp_path):
    plain = read_text(esm().encode(), "a.asc")
    packed = read_text(gzip.compress(esm().encode()), "a.asc.gz")
    assert packed.acceleration.tobytes() == plain.acceleration.tobytes()
    twice = gzip.compress(esm()[:900].encode()) + gzip.compress(esm()[900:].encode())
    assert read_text(twice, "a.asc.gz").acceleration.tobytes() == plain.acceleration.tobytes()
    (tmp_path / "a.zip").write_bytes(zipped({"../../etc/a.asc": esm().encode()}))
    assert read_record(tmp_path / "a.zip").acceleration.tobytes() == plain.acceleration.tobytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.zip"]


def test_the_components_of_an_archive_are_its_channels():
    files = {f"{way}.asc": esm(share * GAL, STREAM=way).encode() for way, share in (("HNE", 1.0), ("HNZ", 0.5))}
    others = {"readme.txt": b"read me\n", "v.asc": esm(DATA_TYPE="VELOCITY").encode(), "x.png": b"\x89PNG\x00"}
    data = zipped(others | files)
    assert [
        (read_text_channel.channel, read_text_channel.component)
        for read_text_channel in read_text_channels(data, "a.zip")
    ] == [
        ("1", "HNE"),
        ("2", "HNZ"),
    ]
    assert read_text(data, "a.zip", "hnz").pga == pytest.approx(0.5 * G * np.abs(WAVE).max(), rel=1e-5)
    with pytest.raises(InputError, match=r"a\.zip: has several channels"):
        read_text(data, "a.zip")
    # What is there to be read, and damaged, is not left out.
    torn = zipped(files | {"c.V2": csmip({"UP": GAL}).replace("12.", "1x.", 5).encode()})
    assert refused(torn).code == "record-number"


def test_archives_that_lie_or_never_end(monkeypatch):
    bomb = zipped({"a.txt": b"0\n" * 1_000_000})
    assert len(bomb) < 10_000
    monkeypatch.setattr(archive, "LARGEST_BYTES", 1_000_000)
    assert refused(bomb).code == "too-large"
    assert refused(gzip.compress(b"0\n" * 1_000_000), "a.gz").code == "too-large"
    for many in (zipped, tarred):
        assert "it holds more than 200 files" in str(refused(many({f"{k}.txt": b"" for k in range(300)})))
    lying = bytearray(zipped({"a.txt": b"0 0.1\n" * 400_000}))
    at = lying.index(b"PK\x01\x02") + 24
    lying[at : at + 4] = (100).to_bytes(4, "little")
    assert refused(bytes(lying)).code in ("too-large", "source-unreadable")


def test_archives_that_cannot_be_read():
    good = zipped({"a.asc": esm().encode()})
    assert refused(good[:-30]).code == "source-unreadable"
    assert refused(gzip.compress(esm().encode())[:-100], "a.gz").code == "source-unreadable"
    assert "it stands in another one" in str(refused(zipped({"b.zip": good})))
    assert refused(zipped({})).code == "empty"
    assert refused(zipped({"readme.txt": b"read me\n"})).code == "record-format"
    encrypted = bytearray(good)
    encrypted[6] |= 1
    encrypted[good.index(b"PK\x01\x02") + 8] |= 1
    assert "encrypted" in str(refused(bytes(encrypted)))
    unknown = bytearray(good)
    unknown[8], unknown[good.index(b"PK\x01\x02") + 10] = 99, 99
    assert "compression" in str(refused(bytes(unknown)))


# tar and bzip2

WAYS = {"": bytes, ".gz": gzip.compress, ".bz2": bz2.compress}


@pytest.mark.parametrize("ending", WAYS)
@pytest.mark.parametrize("kind", [tarfile.USTAR_FORMAT, tarfile.GNU_FORMAT, tarfile.PAX_FORMAT])
def test_a_tar_is_read_as_a_zip_is(ending, kind, tmp_path):
    plain = read_text(esm().encode(), "a.asc")
    # A name of more than its header has room for, and one that leads elsewhere.
    long = f"../../{'d' * 90}/{'e' * 60}/a.asc"
    data = WAYS[ending](tarred({long: esm().encode(), "readme.txt": b"read me\n"}, kind=kind))
    (tmp_path / f"a.tar{ending}").write_bytes(data)
    result = read_record(tmp_path / f"a.tar{ending}")
    assert result.acceleration.tobytes() == plain.acceleration.tobytes()
    assert [path.name for path in tmp_path.iterdir()] == [f"a.tar{ending}"]


def test_what_stands_behind_bzip2_is_read():
    plain = read_text(esm().encode(), "a.asc").acceleration.tobytes()
    text = esm().encode()
    for data in (bz2.compress(text), bz2.compress(text[:900]) + bz2.compress(text[900:])):
        assert read_text(data, "a.asc.bz2").acceleration.tobytes() == plain
    assert refused(bz2.compress(text)[:-20], "a.bz2").code == "source-unreadable"
    assert refused(bz2.compress(b""), "a.bz2").code == "record-empty"


def test_tars_that_lie_lead_elsewhere_or_never_end(monkeypatch, tmp_path):
    secret = tmp_path / "secret.asc"
    secret.write_text(esm())
    linked = tarred({}, links={"a.asc": str(secret)})
    assert refused(linked, "a.tar").code == "empty"
    good = tarred({"a.asc": esm().encode()})
    assert refused(good[:2000], "a.tar").code == "source-unreadable"
    assert "it stands in another one" in str(refused(tarred({"b.tar": good}), "a.tar"))
    # The second header is torn: what stands behind it is not left out in silence.
    two = bytearray(tarred({"a.asc": esm().encode(), "b.asc": esm().encode()}, kind=tarfile.USTAR_FORMAT))
    two[two.index(b"b.asc")] ^= 1
    assert "it is damaged" in str(refused(bytes(two), "a.tar"))
    # A size below zero leads back to where it came from.
    header = bytearray(good[:512])
    header[124:136] = b"\xff" * 10 + b"\xfa\x00"
    assert refused(with_checksum(header) + good[512:], "a.tar").code == "source-unreadable"
    header[124:136] = b"\x80" + b"\x7f" * 11
    assert refused(with_checksum(header) + good[512:], "a.tar").code == "source-unreadable"
    monkeypatch.setattr(archive, "LARGEST_BYTES", 1_000_000)
    bomb = tarred({f"{k}.txt": b"0\n" * 100_000 for k in range(6)})
    for compress in (gzip.compress, bz2.compress):
        assert len(compress(bomb)) < 20_000
        assert refused(compress(bomb), "a.tar.gz").code == "too-large"
    # A header says a gigabyte, of which nothing is there; one of holes is all zeros.
    header = bytearray(tarred({"a.asc": b""}, kind=tarfile.GNU_FORMAT)[:512])
    header[124:136] = b"%011o\0" % 2**30
    assert refused(with_checksum(header) + bytes(1024), "a.tar").code in ("source-unreadable", "too-large")
    header[156:157], header[483:495] = b"S", b"%011o\0" % 2**30
    assert refused(with_checksum(header) + bytes(1024), "a.tar").code in ("source-unreadable", "too-large")


# miniSEED and SAC


def test_counts_are_turned_by_the_sensitivity_of_the_instrument(tmp_path):
    (tmp_path / "a.mseed").write_bytes(miniseed())
    assert refused(miniseed(), "a.mseed").code == "record-response"
    (tmp_path / "a.xml").write_bytes(station_xml())
    motion = read_record(tmp_path / "a.mseed")
    assert motion.acceleration == pytest.approx(G * WAVE, abs=2e-6)
    assert (motion.format, motion.component, motion.station) == ("miniSEED", "HNE", "XY.ABC")
    assert motion.processing == ("counts over 1e+06 of its StationXML", "mean of 0.005 m/s2 taken out")
    assert [warning.code for warning in motion.warnings] == ["record-uncorrected"]
    together = zipped({"a.mseed": miniseed(), "station.xml": station_xml()})
    assert read_text(together, "a.zip").acceleration == pytest.approx(motion.acceleration)
    milli = zipped({"a.mseed": miniseed(), "station.xml": station_xml("mm/s^2", 1e3)})
    assert read_text(milli, "a.zip").acceleration == pytest.approx(motion.acceleration)


@pytest.mark.parametrize(
    ("files", "code"),
    [
        ({"a.mseed": miniseed(), "s.xml": station_xml("M/S")}, "record-not-acceleration"),
        ({"a.mseed": miniseed(), "s.xml": station_xml().replace(b'"ABC"', b'"DEF"')}, "record-response"),
        ({"a.mseed": miniseed(), "s.xml": station_xml(sensitivity=0.0)}, "record-response"),
        ({"a.mseed": miniseed(), "s.xml": station_xml().replace(b"<FDSN", b"<!DOCTYPE x><FDSN", 1)}, "record-response"),
        ({"a.mseed": miniseed(gap=True), "s.xml": station_xml()}, "record-gaps"),
    ],
)
def test_counts_that_cannot_be_turned(files, code):
    assert refused(zipped(files)).code == code


def test_values_that_are_no_counts_are_in_the_unit_that_is_told():
    data = miniseed((G * WAVE).astype(np.float32))
    with pytest.raises(InputError, match="does not state its unit"):
        read_text(data, "a.mseed")
    assert read_text(data, "a.mseed", options=Options(unit="m/s^2")).pga == pytest.approx(
        G * np.abs(WAVE).max(), rel=1e-6
    )


def test_sac():
    motion = read_text(sac(), "a.sac", options=Options(unit="m/s^2"))
    assert motion.acceleration == pytest.approx(G * WAVE, abs=1e-6)
    assert (motion.format, motion.dt, motion.component) == ("SAC", pytest.approx(0.01), "HNE")
    assert refused(sac(idep=7), "a.sac").code == "record-not-acceleration"
    other = bytearray(sac())
    other[4:8] = np.float32(99.0).tobytes()  # depmin
    doubts = read_text(bytes(other), "a", options=Options(unit="g")).warnings
    assert any("states a peak of 99 " in str(doubt) for doubt in doubts)


@pytest.mark.parametrize("scale", [0.01, 5.9e8])
def test_the_scale_of_sac_is_applied_only_as_the_user_says(scale, tmp_path):
    """Some write there what they want to multiply by, others the sensitivity they have divided by."""
    (tmp_path / "a.sac").write_bytes(sac(scale=scale))
    unit = {"unit": "m/s^2"}
    with pytest.raises(InputError, match=r"its header has the factor .*say in motion.factor"):
        read_record(tmp_path / "a.sac", **unit)
    applied = read_record(tmp_path / "a.sac", factor=scale if scale < 1.0 else 1.0 / scale, **unit)
    share = min(scale, 1.0 / scale)
    assert applied.acceleration == pytest.approx(share * G * WAVE, rel=1e-5, abs=1e-6 * share)
    assert any("the factor of its header as given" in text for text in applied.processing)
    assert read_record(tmp_path / "a.sac", factor=1.0, **unit).acceleration == pytest.approx(G * WAVE, abs=1e-6)
    assert read_text(sac(scale=1.0), "a.sac", options=Options(unit="m/s^2")).pga > 0.0


def test_what_the_reader_warns_of_reaches_the_result():
    """A year of two digits, of which obspy makes one of the last century."""
    data = bytearray(sac())
    order = "<" if struct.unpack_from("<i", data, 304)[0] in (6, 7) else ">"
    data[280:284] = struct.pack(f"{order}i", 80)  # nzyear
    motion = read_text(bytes(data), "a.sac", options=Options(unit="m/s^2"))
    (notice,) = motion.warnings
    assert notice.code == "record-doubtful"
    assert "2-digit year" in str(notice).lower()
    # The reader's word on a step that is not its own is not so.
    data = bytearray(sac())
    data[0:4] = struct.pack(f"{order}f", 1.0 / 128.0)
    assert read_text(bytes(data), "a.sac", options=Options(unit="m/s^2")).warnings == ()


def oriented(azimuth: float, dip: float) -> bytes:
    return station_xml().replace(
        b"<SampleRate>", f"<Azimuth>{azimuth}</Azimuth><Dip>{dip}</Dip><SampleRate>".encode(), 1
    )


@pytest.mark.parametrize(
    ("azimuth", "dip", "component"),
    [
        (90.0, 0.0, "90 deg (HNE)"),
        (0.0, -90.0, "up (HNE)"),
        (0.0, 90.0, "down (HNE)"),
        (30.0, -45.0, "30 deg, 45 deg upward (HNE)"),
    ],
)
def test_the_sensor_points_where_its_station_xml_says(azimuth, dip, component):
    data = zipped({"a.mseed": miniseed(), "s.xml": oriented(azimuth, dip)})
    motion = read_text(data, "a.zip")
    assert motion.component == component
    for choice in ("HNE", component.split(" (")[0], component):
        assert read_text(data, "a.zip", choice).component == component


@pytest.mark.parametrize("name", ["a", "ABC", "XY.ABC", "xy_abc_response", "ABC.HNE"])
def test_a_station_xml_is_found_under_the_name_of_its_file_or_its_station(name, tmp_path):
    (tmp_path / "a.mseed").write_bytes(miniseed())
    (tmp_path / "XY.DEF.xml").write_bytes(station_xml().replace(b'"ABC"', b'"DEF"'))
    with pytest.raises(InputError, match=r"put its StationXML beside it as a\.xml or ABC\.xml"):
        read_record(tmp_path / "a.mseed")
    (tmp_path / f"{name}.xml").write_bytes(station_xml())
    assert read_record(tmp_path / "a.mseed").station == "XY.ABC"


def test_without_obspy_the_remedy_is_said(tmp_path, monkeypatch):
    (tmp_path / "a.mseed").write_bytes(miniseed())
    monkeypatch.setattr(seismology, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=r"a\.mseed: needs the package obspy.*pip install obspy"):
        read_channels(tmp_path / "a.mseed")


@pytest.mark.parametrize("step", [1.0 / 128.0, 0.01, 0.005, 1.0 / 300.0])
def test_the_step_of_sac_is_that_of_its_header(step):
    """Which is in single precision; the reader rounds it to microseconds."""
    data = bytearray(sac())
    data[0:4] = struct.pack("<f" if struct.unpack_from("<i", data, 304)[0] in (6, 7) else ">f", step)
    motion = read_text(bytes(data), "a.sac", options=Options(unit="m/s^2"))
    assert motion.dt == pytest.approx(step, rel=6e-8)
    assert step not in (1.0 / 128.0, 0.01, 0.005) or motion.dt == step


@pytest.mark.parametrize("sample", ["zip", "gz", "bz2", "tar", "tgz", "miniseed", "sac"])
def test_whatever_is_done_to_them(sample):
    """A clear refusal, or finite values."""
    packed = {"a.mseed": miniseed(), "s.xml": station_xml()}
    data = {
        "zip": zipped({"a.asc": esm().encode()}),
        "gz": gzip.compress(esm().encode()),
        "bz2": bz2.compress(esm().encode()),
        "tar": tarred({"a.asc": esm().encode()}),
        "tgz": gzip.compress(tarred({"a.asc": esm().encode()})),
        "miniseed": zipped(packed, zipfile.ZIP_STORED),
        "sac": sac(),
    }[sample]
    rng = random.Random(sample)
    outcomes = set()
    for _ in range(150):
        other = bytearray(data)
        for _ in range(rng.randint(1, 3)):
            at = rng.randrange(len(other))
            if rng.random() < 0.7:
                other[at] ^= 1 << rng.randrange(8)
            else:
                del other[at : at + rng.randrange(100)]
        try:
            motions = read_text_channels(bytes(other), "a", Options(unit=None if sample != "sac" else "m/s^2"))
        except InputError as error:
            outcomes.add("refused" if "\n" not in str(error) else "in two lines")
            continue
        outcomes.add("read")
        for motion in motions:
            assert np.isfinite([motion.pga, motion.pgv, motion.pgd, motion.dt]).all()
    assert "refused" in outcomes
    assert "in two lines" not in outcomes


def test_damaged_miniseed_is_refused_or_read_as_it_was():
    """The sums of its packed blocks tell; one flipped bit made a peak fifteen times as large."""
    rng = np.random.default_rng(1)
    counts = np.cumsum(rng.integers(-300, 300, 3000)).astype(np.int32)
    whole, stations = miniseed(counts), [station_xml()]
    right = seismology.read(whole, "a", stations)[0].values
    refusals = 0
    for _ in range(60):
        damaged = bytearray(whole)
        damaged[int(rng.integers(len(whole)))] ^= 1 << int(rng.integers(8))
        try:
            assert seismology.read(bytes(damaged), "a", stations)[0].values == pytest.approx(right)
        except InputError:
            refusals += 1
    assert 10 < refusals < 60
