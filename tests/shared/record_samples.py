"""Records made up for the tests, one in each format; no file here was ever recorded."""

from __future__ import annotations

import numpy as np

from heeltoe.motion.records.read import read_text, read_text_channels
from heeltoe.motion.records.to_motion import Options

G = 9.80665
#: A wave without offset [g], as K-NET's reader takes the mean out.
WAVE = 0.3 * np.sin(np.arange(160) * 0.2) * np.hanning(160)
WAVE -= WAVE.mean()
GAL = 100.0 * G * WAVE


def rows(values, count: int, form: str) -> str:
    """Numbers in columns that may touch, as Fortran writes them."""
    return "\n".join("".join(format(v, form) for v in values[k : k + count]) for k in range(0, len(values), count))


def csmip(channels: dict[str, np.ndarray], unit: str = "CM/SEC/SEC", form: str = "10.3f") -> str:
    """A file with one channel after the other: direction and accelerations [cm/s2]."""
    return "".join(_csmip_channel(k, *channel, unit, form) for k, channel in enumerate(channels.items(), 1))


def _csmip_channel(number: int, direction: str, values: np.ndarray, unit: str, form: str) -> str:
    peak = values[np.abs(values).argmax()]
    text = f"""\
CORRECTED ACCELEROGRAM   99999-S1234-80001.01       CHAN {number:2}: {direction}     FROM
UNCORRECTED ACCELEROGRAM DATA              PROCESSED:  1/02/80, XY QC00A000
NOWHERE EARTHQUAKE
JANUARY 1, 1980 12:00 PST               (ORIGIN(XYZ): 01/01/80, 20:00:00.0 UTC)
99999-S1234-80001.01               TRIGGER TIME: 01/01/80, 12:00:01.0 PST
STATION NO. 99999   35.000N, 120.000W     SMA-1  S/N 1234
EMPTY VALLEY - DAM              XYZ
CHAN {number:2}: {direction}
ACCELEROGRAM BANDPASS FILTERED WITH RAMPS AT  .050- .100 AND 23.00-25.00 CYC/SEC
  {len(values)} POINTS OF INSTRUMENT- AND BASELINE-CORRECTED ACCEL, VELOC AND DISPL DATA
AT EQUALLY-SPACED INTERVALS OF    .010  SEC.
PEAK ACCELERATION = {peak:9.3f}    CM/SEC/SEC  AT     .780   SEC.
99999-S1234-80001.01      EMPTY VALLEY - DAM   CHAN {number:2}: {direction}
"""
    numbers = rows(np.zeros(100, dtype=int), 16, "5d") + "\n" + rows(np.zeros(100), 8, "10.3f") + "\n"
    series = "".join(
        f" {len(values)} POINTS OF {what} DATA EQUALLY SPACED AT  .010 SEC.  (UNITS: {of})\n{rows(values, 8, form)}\n"
        for what, of in (("ACCEL", unit), ("VELOC", "CM/SEC"), ("DISPL", "CM"))
    )
    return f"{text}{numbers}{series}/&  ----------  END OF DATA FOR CHANNEL {number:2}  ----------\n"


def cosmos(quantity: str = "acceleration", values: np.ndarray = GAL, **header: object) -> str:
    """One section of a file."""
    say = {
        "number": 1,
        "direction": "360 deg",
        "unit": "cm/sec2",
        "step": 10.0,
        "recorder_step": 0.005,
        "seconds": 2,
        "comment": "|<SCNL>ABC.HNE.XY.--",
        "form": "(8f10.5)",
        "event": "Nowhere Earthquake of Tue Jan 1, 1980 20:00 UTC",
    } | header
    first = {"acceleration": "Corrected acceleration"}.get(quantity, f"{quantity.capitalize()} data")
    peak = float(values[np.abs(values).argmax()])
    reals = np.full(100, -999.0)
    reals[[33, 61, 63]] = say["recorder_step"], say["step"], peak
    return f"""\
{first}   (Format v01.20 with 13 text lines) Src: 00000000
Record of {say["event"]}
Hypocenter: To be determined    H=   km       ML=     Mw=
Origin: To be determined
Statn No: 05- 99999 Code:XY-99999  XYZ  Empty Valley - Dam & Spillway
Coords: 35.000  -120.000   Site geology:
Recorder: Box    s/n 1234 ( 3 Chns of   3 at Sta) Sensor: (see comment)
Rcrd start time:01/01/1980, 20:00:00.000 UTC (Q=5)  RcrdID: 00000000
Sta Chan  {say["number"]}: {say["direction"]} (Rcrdr Chan  N) Location:
Raw record length =   1.600 sec. Uncor Max = 13643.000 c, at    0.780 sec.
Processed:1980-01-02 00:00:00 GMT, XYZ, Max = {peak:8.3f} cm/sec2 at    0.780 sec
Record filtered below  0.03 Hz (periods over 33.33 secs), and above 20.0 Hz
Values used when parameter or data value is unknown/unspecified:   -999, -999.0
 100 Integer-header values follow on  10 lines, Format= (10I8)
{rows(np.full(100, -999), 10, "8d")}
 100 Real-header values follow on  20 lines, Format= (5F15.6)
{rows(reals, 5, "15.6f")}
   2 Comment line(s) follow, each starting with a "|":
|
{say["comment"]}
     {len(values)} {quantity} pts, approx  {say["seconds"]} secs, units={say["unit"]}(04),Format={say["form"]}
{rows(values, 8, "10.5f")}
End-of-data for Chan  {say["number"]} {quantity}
"""


def smc(
    values: np.ndarray = GAL, *, first: str = "2 CORRECTED ACCELEROGRAM", rate: float = 100.0, **header: object
) -> str:
    """A file with its header as it was in the nineties."""
    say = {"component": "   up", "direction": (0, -32768), "flag": 0} | header
    integers = np.full(48, -32768)
    integers[[12, 13]] = say["direction"]
    integers[[15, 16, 17]] = 2, len(values), say["flag"]
    reals = np.full(50, 1.7e38)
    reals[1] = rate
    peak = float(values[np.abs(values).argmax()])
    # One digit of the exponent, as the format has it; the sign takes the place of the blank.
    data = [f"{v:11.4e}".replace("e+0", "E+").replace("e-0", "E-") for v in values]
    return f"""\
{first}
*
ABC0B
     1980   1   1    2000 Nowhere, XY
Moment Mag=      6.5 Ms=      6.5 Ml=      6.5
station = Empty Valley, Dam, F component={say["component"]}
epicentral dist =     20.0       pk     = {peak:8.1f}
inst type=SMA-1      data source = XYZ
*
*
*
{rows(integers, 8, "10d")}
{rows(reals, 5, "15.7E")}
|
|a comment with numbers: 1 2 3
{rows(data, 8, "s")}
"""


def knet(
    values: np.ndarray = GAL, *, direction: str = "N-S", scale: str = "3920(gal)/6182761", offset: int = 13325
) -> str:
    """A file of counts with an offset."""
    counts = np.rint(values * 6182761 / 3920).astype(int) + offset
    return f"""\
Origin Time       1980/01/01 20:00:00
Lat.              35.0
Long.             140.0
Depth. (km)       30
Mag.              6.5
Station Code      ABC001
Station Lat.      35.1000
Station Long.     140.1000
Station Height(m) 10
Record Time       1980/01/01 20:00:15
Sampling Freq(Hz) 100Hz
Duration Time(s)  1.6
Dir.              {direction}
Scale Factor      {scale}
Max. Acc. (gal)   {np.abs(values).max():.3f}
Last Correction   1980/01/01 20:00:00
Memo.
{rows(counts, 8, "9d")}
"""


def read(text: str, name: str = "a.V2", channel: str | int | None = None, **hints):
    return read_text(text.encode(), name, channel, Options(**hints))


def channels(text: str, **hints):
    return read_text_channels(text.encode(), "a.V2", Options(assume=True, **hints))
