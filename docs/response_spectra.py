"""Print the table of docs/statics.md: earthquakes by their response spectrum beside time histories of the bonded dam.

HEELTOE_RECORDS=DIRECTORY python docs/response_spectra.py

The directory has records of two components each in its folder "ensemble". Dams on rigid rock before water without sound
are followed mode by mode, by their own matrices; those on rock before water with sound frequency by frequency.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import scipy.linalg
from scipy.interpolate import CubicSpline
from scipy.signal import cont2discrete, lfilter

import heeltoe
from heeltoe.case.shaking import resolve
from heeltoe.models.flexible.body.elastic import dam, side_by_side
from heeltoe.models.flexible.mesh.dam import dam_mesh
from heeltoe.models.flexible.surroundings.lowest_modes import SectionForces, lowest_modes
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.motion.spectrum import response_spectrum

_DAMS, _SEED, _RECORDS = 8, 45, 14
# Modes that a history has, frequencies of which one is computed, and how long it is at least after the record [s].
_MODES, _SAMPLES, _QUIET = 30, 150, 5.0
_AT = [0, 2]


def random_case(number: int) -> heeltoe.Case:
    """Return a dam; every second one is cracked above its base."""
    rng = np.random.default_rng([_SEED, number])
    height = rng.uniform(30.0, 150.0)
    base, crest = height * rng.uniform(0.7, 0.95), height * rng.uniform(0.06, 0.12)
    corners = [(0.0, 0.0), (base, 0.0), (crest, 0.85 * height), (crest, height), (0.0, height)]
    return heeltoe.read_case(
        {
            "section": {"polygon": [[f"{x} m", f"{z} m"] for x, z in corners]},
            "concrete": {"density": "2400 kg/m^3", "modulus": f"{rng.uniform(18.0, 35.0)} GPa", "poisson": 0.2},
            "rock": "rigid",
            "reservoir": {"depth": f"{height * rng.uniform(0.6, 0.98)} m", "compressible": False},
            "crack": {"friction": 1.0, "elevation": f"{0.0 if number % 2 else height * rng.uniform(0.3, 0.8)} m"},
            "flexible": {"elements_across": 4},
        }
    )


def record_files() -> list[Path]:
    """Return records at equal distances in the list of all."""
    paths = sorted((Path(os.environ["HEELTOE_RECORDS"]) / "ensemble").glob("*"))
    return [paths[round(place)] for place in np.linspace(0, len(paths) - 1, _RECORDS)]


def modal_peaks(case: heeltoe.Case, records: list[GroundMotion]) -> np.ndarray:
    """Return largest push and moment (records, 2) of what is above the crack, mode by mode."""
    parts = dam(case, dam_mesh(case))
    tie = np.asarray(parts.tie.toarray())
    mass, stiffness = (side_by_side(parts, name).toarray() for name in ("mass", "stiffness"))
    squares, shapes = scipy.linalg.eigh(tie.T @ stiffness @ tie, tie.T @ mass @ tie, subset_by_index=[0, _MODES - 1])
    shapes = tie @ shapes
    # Water moves with the whole dam: what presses on the part above the crack is the part's own.
    upper = parts.upper.mass
    part = shapes[: parts.upper.load.size]
    horizontal = np.tile([1.0, 0.0], mass.shape[0] // 2)
    shares = shapes.T @ (mass @ horizontal)
    x, z = (parts.upper.mesh.nodes - np.array(case.above.heel)).T

    def forces(pushes: np.ndarray) -> np.ndarray:
        return np.array([pushes[::2].sum(axis=0), x @ pushes[1::2] - z @ pushes[::2]])

    by_mode = forces(upper @ part) * shares
    rest = forces((upper @ horizontal[: part.shape[0]])[:, None])[:, 0] - by_mode.sum(axis=1)
    ratio, peaks = case.concrete.damping, []
    for motion in records:
        step = float(np.diff(motion.time).min())
        times = np.arange(0.0, motion.time[-1] + _QUIET, step)
        ground = np.interp(times, motion.time, motion.acceleration, right=0.0)
        answers = np.outer(ground, rest)
        for omega, push in zip(np.sqrt(squares), by_mode.T, strict=True):
            numerator, denominator, _ = cont2discrete(([omega**2], [1.0, 2.0 * ratio * omega, omega**2]), step, "foh")
            answers += np.outer(lfilter(numerator[0], denominator, ground), push)
        peaks.append(np.abs(answers).max(axis=0))
    return np.array(peaks)


def peaks_by_frequency(case: heeltoe.Case, records: list[GroundMotion], farthest: float = 6.0) -> np.ndarray:
    """Return the same frequency by frequency, up to a multiple of the first frequency of the dry dam."""
    section = SectionForces.of(case, farthest)
    sampled = np.linspace(0.02, farthest, _SAMPLES) * section.first
    answers = CubicSpline(sampled, [section.at(2.0 * np.pi * frequency)[_AT] for frequency in sampled])
    peaks = []
    for motion in records:
        step = min(0.01, float(np.diff(motion.time).min()))
        count = 2 ** int(np.ceil(np.log2((motion.time[-1] + _QUIET) / step)))
        frequencies = np.fft.rfftfreq(count, step)
        # Above that frequency the dam moves with the ground, which waves do not reach.
        within = np.clip(frequencies, sampled[0], sampled[-1])
        transfer = answers(within).T
        ground = np.interp(step * np.arange(count), motion.time, motion.acceleration, right=0.0)
        histories = np.fft.irfft(transfer * np.fft.rfft(ground), count)
        peaks.append(np.abs(histories).max(axis=1))
    return np.array(peaks)


def by_one_mode(case: heeltoe.Case, records: list[GroundMotion]) -> np.ndarray:
    """Return largest push and moment (records, 2) by the first mode and a static correction, as Fenves and Chopra."""
    modes = lowest_modes(case, "spectrum")
    first, rows = modes.first, []
    for motion in records:
        felt = float(response_spectrum(motion, [first.period], first.damping).pseudo_acceleration[0])
        rows.append(np.hypot(felt * first.push, motion.pga * (modes.rigid - first.push))[_AT])
    return np.array(rows)


def by_two_modes(cases: list[heeltoe.Case]) -> np.ndarray:
    """Return the same (cases, 2) as `heeltoe statics --spectrum motion` has it."""
    rows = []
    for case in cases:
        demand = heeltoe.with_response_spectrum(heeltoe.statics_of_sections(case)).joints[0].statics.response_spectrum
        rows.append(np.abs([demand.together.horizontal_n, demand.together.moment_about_heel_nm]))
    return np.array(rows)


def main() -> None:
    """Print a row for each dam, and what the mean of all is."""
    print("| height, m | crack at, m | shear, one mode | shear, two | moment, one mode | moment, two |")
    print("| --- | --- | --- | --- | --- | --- |")
    for kind, around in (
        ("rigid rock", ()),
        ("rock and sound", ('rock.modulus="25 GPa"', "reservoir.compressible=true")),
    ):
        rows = []
        for number in range(_DAMS):
            case = random_case(number).with_(*around)
            cases = [case.with_(f'motion.file="{path}"') for path in record_files()]
            records = [resolve(other.motion, other.gravity, other.base_directory)[0] for other in cases]
            right = (peaks_by_frequency if around else modal_peaks)(case, records)
            answers = by_one_mode(case, records), by_two_modes(cases)
            one, two = (100.0 * np.mean(answer / right - 1.0, axis=0) for answer in answers)
            rows.append([one[0], two[0], one[1], two[1]])
            top, crack = max(z for _, z in case.section.vertices()), case.crack.elevation
            print(f"| {top:.0f}, {kind} | {crack:.0f} | {_percent(rows[-1])} |", flush=True)
        print(f"| mean, {kind} | | {_percent(np.mean(rows, axis=0))} |")


def _percent(values: Iterable[float]) -> str:
    return " | ".join(f"{value:+.0f}" for value in values)


if __name__ == "__main__":
    main()
