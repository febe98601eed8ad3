"""Folders as they come from those who distribute records, made up: two stations with three components each."""

from __future__ import annotations

import io
from collections.abc import Callable, Mapping

import numpy as np
import pytest

from shared.record_samples import GAL, WAVE, G, cosmos, csmip, knet, rows, smc
from shared.records_of_the_world import afad, bhrc, csmip_v1, csmnc, esm, geonet, renadic, taiwan, unam, usc, usc_v1

#: Which of the three are horizontal, and how strong each is, as a part of the wave.
SHARES = {"h1": 1.0, "h2": 0.8, "up": 0.5}
STATIONS = ("ABC", "DEF")
Files = Mapping[str, str | bytes]


def at2(event: str, station: str, component: str, share: float, quantity: str = "ACCELERATION") -> str:
    """A file of PEER's."""
    return (
        f"PEER NGA STRONG MOTION DATABASE RECORD\n{event}, 1/1/1980, {station}, {component}\n"
        f"{quantity} TIME SERIES IN UNITS OF {'G' if quantity == 'ACCELERATION' else 'CM/S'}\n"
        f"NPTS=    {WAVE.size}, DT=   .0100 SEC,\n{rows(share * WAVE, 5, '15.7E')}\n"
    )


def peer() -> Files:
    """Accelerations, velocities, displacements, and the list of the search."""
    files = {}
    table = [
        "PEER Ground Motion Database",
        " -- Summary of Search Criteria --",
        "Magnitude:, 6, 7",
        "",
        " -- Summary of Metadata of Selected Records --",
        " Result ID, Spectral Ordinate, Record Sequence Number, Scale Factor, MSE, Tp-Pulse (sec), Earthquake Name,"
        " Year, Station Name, Magnitude, Mechanism, Rjb (km), Rrup (km), Vs30 (m/sec), Lowest Useable Frequency (Hz),"
        " Horizontal-1 Acc. Filename, Horizontal-2 Acc. Filename, Vertical Acc. Filename",
    ]
    for place, station in enumerate(STATIONS):
        rsn, stem = 9001 + place, f"RSN{9001 + place}_MADEUP_{station}"
        # The vertical of the first station has a name that does not say so.
        up = ("-V1", "DWN")[place]
        for ending, component, share in (("000", "000", 1.0), ("090", "090", 0.8), (up, "UP", 0.5)):
            for kind, quantity in (("AT2", "ACCELERATION"), ("VT2", "VELOCITY"), ("DT2", "DISPLACEMENT")):
                files[f"{stem}{ending}.{kind}"] = at2("Madeup-01", station, component, share, quantity)
        names = ", ".join(f"{stem}{ending}.AT2" for ending in ("000", "090", up))
        pulse = ("2.5", "-")[place]
        table.append(
            f' {place + 1}, SRSS, {rsn}, 1.5, 0.1, {pulse}, "Madeup-01", 1980, "{station}, Town", 6.7, reverse, 9.1,'
            f" 12.5, {300 + 100 * place}, 0.1, {names}"
        )
    table += ["", " -- Scaled Spectra used in Search & Scaling --", "Period (sec), RSN-9001", "0.01, 0.3"]
    return {**files, "_SearchResults.csv": "\n".join(table) + "\n"}


def k_net() -> Files:
    return {
        f"{station}0018001012000.{ending}": knet(share * GAL, direction=way).replace("ABC001", f"{station}001")
        for station in STATIONS
        for ending, way, share in (("EW", "E-W", 1.0), ("NS", "N-S", 0.8), ("UD", "U-D", 0.5))
    }


def renamed_k_net() -> Files:
    """The same under names that say nothing: station, time and direction stand in the files."""
    return {f"{place}.txt": text for place, text in enumerate(k_net().values())}


def kik_net() -> Files:
    return {
        f"{station}H018001012000.{ending}{sensor}": knet(share * GAL, direction=str(way + 3 * (sensor - 1))).replace(
            "ABC001", f"{station}H01"
        )
        for station in STATIONS
        for ending, way, share in (("NS", 1, 1.0), ("EW", 2, 0.8), ("UD", 3, 0.5))
        for sensor in (1, 2)
    }


def esm_files() -> Files:
    return {
        f"XY.{station}.00.{stream}.D.19800101.200000.C.{kind}.ASC": esm(
            share * GAL,
            STATION_CODE=station,
            STREAM=stream,
            **({} if kind == "ACC" else {"DATA_TYPE": "VELOCITY", "UNITS": "cm/s"}),
        )
        for station in STATIONS
        for stream, share in (("HNE", 1.0), ("HNN", 0.8), ("HNZ", 0.5))
        for kind in ("ACC", "VEL")
    }


def cosmos_files() -> Files:
    return {
        f"{station}_{way.split()[0]}.V2": cosmos(
            values=share * GAL, direction=way, number=number, event=f"Nowhere Earthquake of {station}"
        ).replace("Empty Valley", station)
        for station in STATIONS
        for number, (way, share) in enumerate((("360 deg", 1.0), ("90 deg", 0.8), ("Up", 0.5)), 1)
    }


def csmip_files() -> Files:
    channels = {"90 DEG": GAL, "UP": 0.5 * GAL, "0 DEG": 0.8 * GAL}
    return {f"{station}.V2": csmip(channels).replace("EMPTY VALLEY", station) for station in STATIONS}


def smc_files() -> Files:
    return {
        f"{station}{number}.smc": smc(share * GAL, component=way, direction=turn).replace("Empty Valley, Dam", station)
        for station in STATIONS
        for number, (way, turn, share) in enumerate(
            (("   90", (90, 90), 1.0), ("   up", (0, -32768), 0.5), ("  360", (90, 360), 0.8))
        )
    }


def csmnc_files() -> Files:
    return {
        f"051{station}800101200001{number}.dat": csmnc(share * GAL)
        .replace("COMP. EW", f"COMP. {way}")
        .replace("STATION: 51ABC", f"STATION: 51{station}")
        for station in STATIONS
        for number, (way, share) in enumerate((("EW", 1.0), ("NS", 0.8), ("UD", 0.5)), 1)
    }


def usc_files() -> Files:
    return {
        f"{station}{way}.v2": usc(share * GAL)
        .replace("N08W", way)
        .replace("USC# 9999", f"USC# 999{STATIONS.index(station)}")
        for station in STATIONS
        for way, share in (("N08W", 1.0), ("S82W", 0.8), ("VERT", 0.5))
    }


def usc_v1_files() -> Files:
    return {
        f"{station}{way}.v1": usc_v1(10.0 * share * WAVE)
        .replace("COMP S05W", f"COMP {way}")
        .replace("EMPTY VALLEY, DAM", station)
        for station in STATIONS
        for way, share in (("S05W", 1.0), ("N85W", 0.8), ("VERT", 0.5))
    }


def jma_files() -> Files:
    """Three columns under lines of text whose cells end with commas."""
    table = rows(np.column_stack([GAL, 0.8 * GAL, 0.5 * GAL]).ravel(), 3, "10.3f")
    values = "\n".join(",".join(line.split()) for line in table.split("\n"))
    return {
        f"{station}.csv": f"SITE CODE= {station} Nowhere,,\nLAT.=  35.0,,\nLON.= 140.0,,\nSAMPLING RATE= 100Hz,,\n"
        f"UNIT  = gal(cm/s/s),,\nINITIAL TIME = 1980 01 01 20 00 00,,\nNS,EW,UD\n{values}\n"
        for station in STATIONS
    }


def _trace(station: str, channel: str, values: np.ndarray, form: str, **header: object) -> bytes:
    obspy = pytest.importorskip("obspy")
    about = {"network": "XY", "station": station, "channel": channel, "sampling_rate": 100.0, **header}
    whole = io.BytesIO()
    obspy.Trace(values, about).write(whole, format=form)
    return whole.getvalue()


def sac_files() -> Files:
    """In tenths of m/s2, each with what it is to be multiplied by in its header."""
    return {
        f"1980.001.XY.{station}.{channel}.SAC": _trace(
            station, channel, (10.0 * share * G * WAVE).astype(np.float32), "SAC", sac={"scale": 0.1}
        )
        for station in STATIONS
        for channel, share in (("HNE", 1.0), ("HNN", 0.8), ("HNZ", 0.5))
    }


def miniseed_files() -> Files:
    """Counts, beside a StationXML for each station."""
    shares = {"HNE": (1.0, 90.0, 0.0), "HNN": (0.8, 0.0, 0.0), "HNZ": (0.5, 0.0, -90.0)}
    counts = {
        f"XY.{station}..{channel}.D.1980.001": _trace(
            station, channel, np.rint(1e6 * share * G * WAVE).astype(np.int32), "MSEED"
        )
        for station in STATIONS
        for channel, (share, _, _) in shares.items()
    }
    return counts | {f"{station}.xml": _station_xml(station, shares) for station in STATIONS}


def _station_xml(station: str, channels: Mapping[str, tuple[float, float, float]]) -> str:
    place = "<Latitude>35</Latitude><Longitude>-120</Longitude><Elevation>0</Elevation>"
    each = "".join(
        f'<Channel code="{channel}" locationCode="" startDate="1960-01-01T00:00:00">{place}<Depth>0</Depth>'
        f"<Azimuth>{azimuth}</Azimuth><Dip>{dip}</Dip><SampleRate>100</SampleRate><Response><InstrumentSensitivity>"
        "<Value>1e6</Value><Frequency>1</Frequency><InputUnits><Name>M/S**2</Name></InputUnits><OutputUnits>"
        "<Name>COUNTS</Name></OutputUnits></InstrumentSensitivity></Response></Channel>"
        for channel, (_, azimuth, dip) in channels.items()
    )
    return (
        '<?xml version="1.0" encoding="UTF-8"?><FDSNStationXML xmlns="http://www.fdsn.org/xml/station/1" '
        'schemaVersion="1.1"><Source>nobody</Source><Created>1970-01-01T00:00:00</Created><Network code="XY">'
        f'<Station code="{station}">{place}<Site><Name>Empty Valley</Name></Site>{each}</Station></Network>'
        "</FDSNStationXML>"
    )


def of_both(make: Callable[[], str], ending: str, said: str) -> Callable[[], Files]:
    """One file of all components for each station."""
    return lambda: {f"19800101_{station}.{ending}": make().replace(said, station) for station in STATIONS}


#: Folder of each producer, by name, and how many horizontal components it has; KiK-net measures in the ground,
#: too.
DOWNLOADS: dict[str, tuple[Callable[[], Files], int]] = {
    "PEER": (peer, 4),
    "K-NET": (k_net, 4),
    "K-NET, renamed": (renamed_k_net, 4),
    "KiK-net": (kik_net, 8),
    "ESM": (esm_files, 4),
    "COSMOS": (cosmos_files, 4),
    "CSMIP": (csmip_files, 4),
    "SMC": (smc_files, 4),
    "CSMNC": (csmnc_files, 4),
    "USC": (usc_files, 4),
    "AFAD": (of_both(lambda: afad("CORRECTED PGA VALUES (gal)"), "txt", "9999"), 4),
    "GeoNet": (of_both(geonet, "V2A", "ABC"), 2),
    "UNAM": (of_both(unam, "txt", "VALLE VACIO"), 4),
    "CICESE": (of_both(lambda: unam(heads=8), "191", "VALLE VACIO"), 4),
    "CWA": (of_both(lambda: taiwan("N(+); E(+); U(+)"), "txt", "#StationCode: ABC"), 4),
    "JMA": (jma_files, 4),
    "BHRC": (of_both(lambda: bhrc(ways={"L1": 1.0, "V2": 0.5, "T3": 0.8}), "V1", "Nowhere "), 4),
    "RENADIC": (of_both(lambda: renadic(ways={"EW": 1.0, "NS": 0.8, "V": 0.5}), "v1", "EMPTY VALLEY"), 4),
    "CSMIP, volume 1": (
        of_both(lambda: csmip_v1(ways={"90 DEG": 1.0, "UP": 0.5, "360 DEG": 0.8}), "RAW", "EMPTY VALLEY"),
        4,
    ),
    "USC, volume 1": (usc_v1_files, 4),
    "GeoNet, volume 1": (of_both(lambda: geonet("Uncorrected"), "V1A", "ABC"), 2),
    "SAC": (sac_files, 4),
    "miniSEED": (miniseed_files, 4),
}
#: What the user says of a folder: how its files are to be read and corrected.
CORRECTED = {"processing": [{"step": "baseline"}]}
SAID: dict[str, Mapping[str, object]] = {
    **dict.fromkeys(("BHRC", "RENADIC", "CSMIP, volume 1", "USC, volume 1", "GeoNet, volume 1", "miniSEED"), CORRECTED),
    "SAC": {"unit": "m/s^2", "factor": "multiply"},
}


def write(folder, files: Files):
    """Write a download into a folder."""
    folder.mkdir()
    for name, text in files.items():
        (folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    return folder
