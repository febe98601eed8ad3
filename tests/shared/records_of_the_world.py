"""Records made up for the tests in the formats of networks outside the United States and Japan, and of USC; see
:mod:`shared.record_samples`."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from shared.record_samples import GAL, WAVE, rows


def _peak(values: np.ndarray) -> float:
    return float(values[np.abs(values).argmax()])


def esm(values: np.ndarray = GAL, **header: str) -> str:
    """One component, a value to a line."""
    say = {
        "EVENT_NAME": "NOWHERE",
        "EVENT_DATE_YYYYMMDD": "19800101",
        "EVENT_TIME_HHMMSS": "200000",
        "NETWORK": "XY",
        "STATION_CODE": "ABC",
        "STATION_NAME": "Empty Valley: Dam",
        "SAMPLING_INTERVAL_S": "0.005000",
        "NDATA": str(len(values)),
        "STREAM": "HNZ",
        "UNITS": "cm/s^2",
        "PGA_CM/S^2": f"{_peak(values):.6f}",
        "BASELINE_CORRECTION": "BASELINE REMOVED",
        "FILTER_TYPE": "BUTTERWORTH",
        "LOW_CUT_FREQUENCY_HZ": "0.100",
        "HIGH_CUT_FREQUENCY_HZ": "30.000",
        "DATA_TYPE": "ACCELERATION",
        "PROCESSING": "manual",
        "USER1": "",
    } | header
    return "".join(f"{label}: {value}\n" for label, value in say.items()) + rows(values, 1, ".6f") + "\n"


def afad(peaks: str = "RAW PGA VALUES (gal)", step: str = "0.01") -> str:
    """Three components side by side."""
    table = np.column_stack([GAL, 0.5 * GAL, -0.3 * GAL])
    n, e, u = (f"{np.abs(column).max():.6f}" for column in table.T)
    return f"""\
STRONG GROUND MOTION RECORDS OF TURKIYE
PLACE                   : EMPTY VALLEY
EARTHQUAKE DATE         : 1980/01/01 20:00:00 (GMT)
EPICENTER COORDINATES   : 35.00000N-40.00000E
EARTHQUAKE MAGNITUDE    : 6.5 Mw
STATION ID              : 9999
NUMBER OF DATA          : {len(table)}
SAMPLING INTERVAL (sec) : {step}
{peaks:24s}: (N-S) {n} (E-W) {e} (U-D) {u}
Copyright NOBODY
       N-S          E-W          U-D
{rows(table.ravel(), 3, "12.6f")}
"""


def geonet(first: str = "Corrected", values: np.ndarray = 10.0 * GAL) -> str:
    """Two components with velocities and displacements behind them, as V2A has it; V1A has neither."""
    corrected = first == "Corrected"
    return "".join(
        f"""\
{first} accelerogram 19800101_200000_ABC_20 Nobody
Site ABC       35 00 00S  172 00 00E     Basalt file:  19800101_200000_ABC_20
Empty Valley Dam
Instrument Box_1234
Resolution: 24-bit   Instr Period: 0.0050 s   Damping: 0.700
Accelerogram 19800101_200000_ABC_20                 Processed 1980 January 02
5 km south-west of Nowhere
1980 January 01         20:00:00 UT
Epicentre  42 41 33S 173 01 19E  Bearing S40E  Dist   25km  Depth   15km Mw 6.50
Number of points  {len(values)}    Duration 1.60 {"sec" if corrected else "s"}
{"Instrument corrected data at 0.010 sec intervals" if corrected else _RAW}
{"Band-pass filter transition bands are .10-.25 Hz and 24.50-25.50 Hz" if corrected else "Data is unfiltered"}
Component {way}  Longitudinal Accelerometer Axis
Acceleration:  Peak {_peak(share * values):8.1f} mm/s/s at  0.78 sec     rms    292.2 mm/s/s
Velocity:      peak  -298.49 mm/s   at  0.59 sec     rms    46.28 mm/s
Displacement:  peak   99.407 mm     at  0.53 sec     rms   14.626 mm
{rows(np.zeros(40, dtype=int), 10, "8d")}
{rows(np.zeros(60), 10, "8.3f")}
{rows(share * values, 10, "8.1f")}
"""
        + (2 * f"{rows(np.zeros(len(values)), 10, '8.2f')}\n" if corrected else "")
        for way, share in (("N10E", 1.0), ("Up", 0.5))
    )


_RAW = "Raw readings in units of 1.00 mm/s/s  at intervals of 0.010 s"


def usc(values: np.ndarray = GAL, unit: str = "CM/SEC/SEC") -> str:
    """Acceleration, velocity and displacement of one component."""
    series = "".join(
        f"  {len(values)} POINTS OF {what} DATA EQUALLY SPACED AT   .010 SEC.  IN UNITS {of}\n"
        f"{rows(part, 8, '10.3f')}\n"
        for what, of, part in (("ACC", unit, values), ("VEL", "CM/SEC", 0 * values), ("DIS", "CM", 0 * values))
    )
    return f"""\
CORRECTED ACCELEROGRAM  IIBB999  80.001.0 COMP N08W   FILE   0  CORRESPONDING T
FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:
NOWHERE EARTHQUAKE                                                      21
JAN 1, 1980 -2000 GMT                                                   22
IBB999  80.001.0 N                                                      18
STATION USC# 9999   35 00 00N, 120 00 00W                               39
EMPTY VALLEY, DAM                                                       48
COMP N08W                                                               9
UNITS ARE SEC AND G/10                                                  22
ACCELEROGRAM IS BAND-PASS FILTERED BETWEEN  .225- .325 AND 25.00-27.00 HZ.
PEAK ACCELERATION =  {_peak(values):10.5f}  CMS/SEC/SEC AT    0.780   SEC.
{rows(np.zeros(100, dtype=int), 16, "5d")}
{rows(np.zeros(100), 8, "10.3f")}
{series}"""


def csmnc(values: np.ndarray = GAL, quantity: str = "CORRECTED ACCELERATION  UNIT: CM/SEC/SEC") -> str:
    """One component."""
    return f"""\
051ABC800101200001
0800101200000 1980-1-1 20:0:0 BTM
NOWHERE EARTHQUAKE
EPICENTER  35.000N 103.000E DEPTH 13 KM
MAGNITUDE  6.5(Ms)
STATION: 51ABC 35.100N 103.100E
SITE CONDITION: ROCK
COMP. EW
{quantity}
NO. OF POINTS:  {len(values)}  EQUALLY SPACED INTERVALS OF:  0.005  SEC
PEAK VALUE:    {_peak(values):9.3f}   AT   0.39 SEC    DURATION:  0.8 SEC
PRE-EVENT TIME:  0  SEC
CSMNC

{rows(values, 8, "14.6E")}
"""


def unam(step: str = "/0.005/0.005/0.005", heads: int = 3, channels: int = 3) -> str:
    """Three channels side by side, some files with headings for more."""
    table = np.column_stack([GAL, 0.5 * GAL, -0.3 * GAL])
    line = "---------+" * 8
    return f"""\
**************************************************************************************
                       INSTITUTO DE NADA
**************************************************************************************
ARCHIVO ESTANDAR DE ACELERACION:
VERSION DEL FORMATO                    : 2.0
NOMBRE DE LA ESTACION                  : VALLE VACIO
NUMERO DE CANALES                      : {channels}
INTERVALO DE MUESTREO, C1-C6 (s)       : {step}
INTERVALO DE MUESTREO, C7-C12 (s)      :
FECHA DEL SISMO [GMT]                  : 1980/01/01
HORA EPICENTRO (GMT)                   : 20:00:00
MAGNITUD(ES)                           : /M=6.5
NUM. TOTAL DE MUESTRAS, C1-C6          : {3 * f"/{len(table)}"}
ACEL. MAX.(Gal), C1-C6                 : {"".join(f"/{_peak(column):.4f}" for column in table.T)}
UNIDADES DE LOS DATOS                  : Gal (cm/s/s)
FORMATO DATOS (FORTRAN,10 campos/dato) : 3F10.4
DATOS DE ACELERACION:
{line}
{"".join(f"   CANAL-{k}" for k in range(1, heads + 1))}
      N00E      N90E         V
{line}
{rows(table.ravel(), 3, "10.4f")}
"""


def bhrc(values: np.ndarray = 10.0 * WAVE, ways: Mapping[str, float] = {"L1": 1.0, "V2": 0.5}) -> str:
    """Components in tenths of g, each with its share of the values."""
    numbers = f"{rows(np.zeros(100, dtype=int), 16, '5d')}\n{rows(np.zeros(50), 8, '10.3f')}\n"
    return "".join(
        f"""\
* VOL1DS FILE:  9999/01
Inst Type = SSA-2
Origin Time : 1980/01/01   20:00:00

L

COMP {way}
Nowhere                   Station   38.474 N 47.059 E   Altitude 1360m   Azimuth L 352   T 82
Epicenter 38.520 N 46.860 E   FD 12 Km mb      Ms      Mw6.5   M        ML   (XYZ   )
INSTR PERIOD =  .019 SEC   DAMPING =  .640
NO. OF POINTS =  {len(values)}      DURATION =  0.800
UNITS ARE SECONDS AND G/10

{numbers}{rows(share * values, 10, "13.6E")}
/&
"""
        for way, share in ways.items()
    )


def renadic(values: np.ndarray = 10.0 * WAVE, ways: Mapping[str, float] = {"EW": 1.0, "V": 0.5}) -> str:
    """Components as pairs of time and tenths of g, in columns that touch, each with its share of the values."""
    numbers = f"{rows(np.zeros(100, dtype=int), 16, '5d')}\n{rows(np.zeros(50), 8, '10.3f')}\n"
    return "".join(
        f"""\
UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 01/02/1980
NOWHERE
01/01/1980 20:00:00 (GMT)                (ORIGIN: 01/01/1980 20:00:00 GMT)
                                   TRIGGER TIME: 01/01/1980 20:00:10.000 GMT
STATION NO.          0.000N    0.000E  QDR       S/N  999 (2  CHNS OF 2  AT STA)
EMPTY VALLEY
CHAN  {number}: {way}       (STA CHN:  {number})
NOBODY - RENADIC
HYPOCENTER:   0.000N    0.000E  H=   0.0KM   ML= 0.00
INSTR PERIOD = 0.0391 SEC,  DAMPING =0.7000,  SENSITIVITY =1.250 VDC/G
NO. OF POINTS =  {len(values)}  RECORD LENGTH =  1.600 SEC
UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = {_peak(share * values) / 10.0:6.3f} G, AT  0.780 SEC
RMS ACCEL OF COMPLETE RECORD = 0.106 G
{numbers}{rows(np.column_stack([_LATE + 0.01 * np.arange(len(values)), share * values]).ravel(), 10, "7.3f")}
/&  ----------  END OF DATA FOR CHANNEL {number}  ----------
"""
        for number, (way, share) in enumerate(ways.items(), 1)
    )


def csmip_v1(
    values: np.ndarray = 10.0 * WAVE,
    *,
    equal: bool = False,
    of_1998: bool = False,
    ways: Mapping[str, float] = {"90 DEG": 1.0, "UP": 0.5},
) -> str:
    """Components: as pairs of time and tenths of g, or, as of late, in equal steps and g, in the words of two
    years."""
    numbers = f"{rows(np.zeros(100, dtype=int), 16, '5d')}\n{rows(np.zeros(50), 8, '10.3f')}\n"
    parts = []
    for number, (way, share) in enumerate(ways.items(), 1):
        of = share * values
        if equal:
            units = "Units of uncor data are sec and g ."
            record = f" {len(of)} Accelerogram points at 100 pts/sec in units of g .      Format: (8f9.6)\n"
            record += rows(of / 10.0, 8, "9.6f")
            event = ("Record of Tue Jan 1, 1980 12:00:00.0 PST             (Avol1 v9.2)", "XYZ Preliminary Processing")
            if of_1998:
                units = "UNITS OF UNCOR ACCEL IS G.             "
                record = f"{len(of)} POINTS OF ACCEL DATA EQUALLY SPACED AT .010 SEC.  (UNITS: G)\n"
                record += rows(of / 10.0, 8, "9.6f")
        else:
            units = "UNITS OF UNCOR ACCEL ARE SEC AND G/10."
            record = rows(np.column_stack([0.01 * np.arange(len(of)), of]).ravel(), 10, "7.3f")
            event = (
                "NOWHERE EARTHQUAKE",
                "JANUARY 1, 1980 12:00 PST              (ORIGIN(XYZ): 01/01/80, 20:00:00.0 GMT)",
            )
        parts.append(
            f"""\
UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 02/08/80, XYZ QN94A403
{event[0]}
{event[1]}
99999-S1234-80001.02               TRIGGER TIME: 01/01/80, 20:00:10.0 UTC
STATION NO. 99999   35.000N, 120.000W     SMA-1  S/N 1234
EMPTY VALLEY - DAM
CHAN  {number}: {way}
NOWHERE EARTHQUAKE     JANUARY 1, 1980 12:00 PST
HYPOCENTER(XYZ): 35.000N, 120.000W, H=18KM. ML=6.6
INSTR PERIOD =  .0397 SEC,  DAMPING =  .592,  SENSITIVITY = 1.77 CM/G.
NO. OF POINTS =  {len(of)}  RECORD LENGTH = {0.01 * len(of):.3f} SEC
{units}     MAX  = {_peak(of) / 10.0:6.3f} G, AT   0.780 SEC.
RMS ACCEL OF COMPLETE RECORD =  .021 G.
{numbers}{record}
/&  ----------  END OF DATA FOR CHANNEL {number}  ----------
"""
        )
    return "".join(parts)


def usc_v1(values: np.ndarray = 10.0 * WAVE) -> str:
    """One component as pairs of time and tenths of g; its lines of text end with their lengths."""
    numbers = f"{rows(np.zeros(100, dtype=int), 16, '5d')}\n{rows(np.zeros(50), 8, '10.3f')}\n"
    pairs = np.column_stack([0.01 * np.arange(len(values)), values]).ravel()
    record = "\n".join(" " + row for row in rows(pairs, 10, "7.3f").split("\n"))
    return f"""\
FILE     0 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:
NOWHERE EARTHQUAKE                                                      18
JAN 1, 1980 -2000 GMT                                                   21
IBB999  80.001.0 N                                                      18
STATION USC# 9999   35 00 00N, 120 00 00W                               39
EMPTY VALLEY, DAM                                                       17
COMP S05W                                                               9
NOWHERE EARTHQUAKE   JAN 1, 1980 -2000 GMT                              46
EPICENTER -   35 00 00N, 120 00 00W                                     35
INSTR PERIOD =  .037 SEC  DAMPING =   .568  SENSITIVITY =   1.69CM/G    69
NO. OF POINTS =   {len(values)}      DURATION =  {0.01 * (len(values) - 1):.3f} SEC                      50
UNITS ARE SEC AND G/10                                                  22
RMS ACCLN. OF COMPLETE RECORD =     .211 G/10                           45
{numbers}{record}
"""


def taiwan(order: str = "U(+); N(+); E(+)") -> str:
    """Time and three components side by side."""
    table = np.column_stack([0.01 * np.arange(len(GAL)), GAL, 0.5 * GAL, -0.3 * GAL])
    peaks = "".join(
        f"#AmplitudeMAX. {way}: {column.max():9.3f}~ {column.min():9.3f}\n"
        for way, column in zip("UNE", table.T[1:], strict=True)
    )
    return f"""\
#Earthquake Information
#Origin Time(GMT+08): 1980/01/01-20:00:00
#Magnitude(Ml): 6.5
#Depth(km): 10.0

#StationCode: ABC
#InstrumentKind: FBA
#StartTime(GMT+08): 1980/01/01-20:00:10.000
#RecordLength(sec): 2
#SampleRate(Hz): 100
#AmplitudeUnit:  gal. DCoffset(corr)
{peaks}#DataSequence: Time {order}
#Data: 4F10.3
{rows(table.ravel(), 4, "10.3f")}
"""


# Of 100 s and more there is no blank left between the columns.
_LATE = 100.0

#: Every format with a sample whose first channel is the wave.
SAMPLES = {
    "esm": esm,
    "afad": afad,
    "geonet": geonet,
    "geonet raw": lambda: geonet("Uncorrected"),
    "usc": usc,
    "csmnc": csmnc,
    "unam": unam,
    "bhrc": bhrc,
    "renadic": renadic,
    "csmip v1": lambda: csmip_v1(equal=True),
    "csmip v1 of 1998": lambda: csmip_v1(equal=True, of_1998=True),
    "csmip v1 of pairs": csmip_v1,
    "usc v1": usc_v1,
    "taiwan": taiwan,
}
