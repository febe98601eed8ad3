"""Whatever is done to a record file: a clear refusal or a sound series, quickly."""

from __future__ import annotations

import random

import numpy as np
import pytest

from heeltoe import GroundMotion, InputError
from heeltoe.motion.records.read import read_text, read_text_channels
from shared.record_samples import GAL, cosmos, csmip, knet, smc
from shared.record_samples import WAVE as _WAVE
from shared.records_of_the_world import SAMPLES as OF_THE_WORLD


def _at2() -> bytes:
    rows = "\n".join(" ".join(f"{v: .7E}" for v in row) for row in _WAVE.reshape(-1, 5))
    return (
        "PEER NGA STRONG MOTION DATABASE RECORD\nSomewhere-01, 5/19/1940, A Station, 180\n"
        f"ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=    {_WAVE.size}, DT=   .0100 SEC,\n{rows}\n"
    ).encode()


def _two_columns() -> bytes:
    rows = "\n".join(f"{0.01 * k:.3f} {v:.6f}" for k, v in enumerate(_WAVE))
    return f"# event: Somewhere\n# time step: 0.01 s\n# units: time [s], acceleration [g]\n{rows}\n".encode()


def _comma() -> bytes:
    rows = "\r\n".join(f"{0.01 * k:.3f},{981 * v:.4f}" for k, v in enumerate(_WAVE))
    return f"time [s],acc [cm/s2]\r\n{rows}\r\n".encode()


def _one_column() -> bytes:
    rows = "\n".join(f"{v:.6g}" for v in _WAVE)
    return f"# units: acceleration [g]\n# time step: 0.01 s\n{rows}\n".encode()


def _at2_of_1999() -> bytes:
    rows = "\n".join("".join(f"{v:13.6E}" for v in row).replace("E", "D") for row in _WAVE.reshape(-1, 5))
    return (
        "PEER STRONG MOTION DATABASE RECORD\nSOMEWHERE 5/19/40 0439, A STATION, DWN (X 117)\n"
        "ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.2 Hz  LP=15.0 Hz\n"
        f"  {_WAVE.size}  0.0100  NPTS, DT\n{rows}\n"
    ).encode()


def _named_columns() -> bytes:
    rows = "\n".join(f"{0.01 * k:.3f} {v:.6f} {9.81 * v:.6f} {0.5 * v:.6f}" for k, v in enumerate(_WAVE))
    return f"time [s], NS [g], vx [m/s], up [g]\n{rows}\n".encode()


def _foreign() -> bytes:
    rows = "\n".join("".join(f"{981 * v:10.3f}" for v in row) for row in _WAVE.reshape(-1, 8))
    head = "UNCORRECTED ACCELEROGRAM DATA\r\n"
    return f"{head}{head}{head} 160 POINTS OF DIGITIZED DATA IN CM/SEC/SEC\r\n{rows}\n".encode()


SAMPLES = {
    "at2": _at2,
    "at2 of 1999": _at2_of_1999,
    "two columns": _two_columns,
    "comma": _comma,
    "one column": _one_column,
    "named columns": _named_columns,
    "csmip": lambda: csmip({" 90 DEG": GAL, "UP": 0.5 * GAL}).encode(),
    "cosmos": lambda: (cosmos() + cosmos("velocity") + cosmos(values=0.5 * GAL, number=2)).encode(),
    "smc": lambda: smc().encode(),
    "knet": lambda: knet().encode(),
}
_JUNK = [
    b"\x00",
    b"\xff\xfe",
    b"nan",
    b"inf",
    b"1e999",
    b"-",
    b"9" * 400,
    b"1.2.3",
    b"NPTS=",
    b"DT=",
    b"#",
    b"\r",
    b"g",
    b"|",
    b"-32768",
    b"**********",
    b"End-of-data",
    b"points of accel data",
]


_OTHERS = {name: lambda sample=sample: sample().encode() for name, sample in OF_THE_WORLD.items()}


def _mutate(data: bytes, rng: random.Random) -> bytes:
    out = bytearray(data)
    for _ in range(rng.randint(1, 4)):
        at = rng.randrange(len(out) + 1)
        choice = rng.randrange(9)
        if choice == 0:
            del out[at:]
        elif choice == 1 and out:
            out[at % len(out)] ^= 1 << rng.randrange(8)
        elif choice == 2:
            out[at:at] = rng.choice(_JUNK)
        elif choice == 3:
            out = bytearray(bytes(out).replace(b"\n", rng.choice([b"\r\n", b"\r", b"\n\n", b" "])))
        elif choice == 4:
            lines = bytes(out).split(b"\n")
            k = rng.randrange(len(lines))
            lines[k : k + 1] = [] if rng.random() < 0.5 else [lines[k]] * rng.randint(2, 5)
            out = bytearray(b"\n".join(lines))
        elif choice == 5:
            out[at : at + rng.randrange(200)] = rng.randbytes(rng.randrange(60))
        elif choice == 6:
            out = bytearray(bytes(out).replace(b"160", rng.choice([b"99999999999999999999", b"-1", b"0", b"1e30"])))
        elif choice == 7:
            out = bytearray(bytes(out).replace(b".", rng.choice([b",", b"", b". "]), rng.randint(1, 3)))
        else:
            del out[at : at + rng.randrange(100)]
    return bytes(out)


def _assault(name: str, count: int) -> tuple[int, int]:
    sample = (SAMPLES | _OTHERS | {"foreign": _foreign})[name]()
    rng = random.Random(f"heeltoe {name}")
    sound = refused = 0
    complaints = []
    for _ in range(count):
        data = _mutate(sample, rng)
        try:
            motions = read_text_channels(data, "fuzzed.txt")
        except InputError as error:
            refused += 1
            complaints.append(str(error))
            continue
        assert motions
        for motion in motions:
            assert isinstance(motion, GroundMotion)
            assert motion.time.shape == motion.acceleration.shape
            assert np.isfinite(motion.time).all()
            assert np.isfinite(motion.acceleration).all()
            assert (np.diff(motion.time) >= 0.0).all()
            assert motion.time.size <= len(data)
            # What is finite may still overflow once it is integrated.
            assert np.isfinite([motion.pga, motion.pgv, motion.pgd, motion.end_velocity, motion.dt]).all()
        sound += 1
    assert not any("\n" in complaint for complaint in complaints)
    return sound, refused


def _check_both_kinds(sound: int, refused: int) -> None:
    """Sound and refused must occur, or the mutations are too tame or too wild to prove anything."""
    assert min(sound, refused) > 0.05 * (sound + refused)


@pytest.mark.parametrize("name", SAMPLES)
def test_samples_are_read_as_they_are(name):
    motion = read_text_channels(SAMPLES[name](), "sample.txt")[0]
    assert motion.acceleration == pytest.approx(9.80665 * _WAVE, rel=2e-3, abs=2e-5)
    assert motion.warnings == ()


@pytest.mark.slow
@pytest.mark.parametrize("name", SAMPLES)
def test_mutations(name):
    _check_both_kinds(*_assault(name, 1_000))


@pytest.mark.slow
@pytest.mark.parametrize("name", _OTHERS)
def test_mutations_of_formats_of_the_world(name):
    _check_both_kinds(*_assault(name, 300))


def test_mutations_of_a_format_that_is_not_read():
    _, refused = _assault("foreign", 1_000)
    assert refused > 950


@pytest.mark.product
@pytest.mark.parametrize("name", [*SAMPLES, *_OTHERS])
def test_many_mutations(name):
    _check_both_kinds(*_assault(name, 40_000))


def test_an_announced_gigabyte_is_not_allocated():
    with pytest.raises(InputError, match=r"states 2.68435e\+08 values and has 160"):
        read_text(_at2().replace(b"160,", b"268435456,"), "x.AT2")
