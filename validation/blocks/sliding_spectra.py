"""Rigid blocks that slide under records, beside what public programs print of them."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.motion.ground_motion import GroundMotion
from validation.plain import rectangle, run
from validation.row import Row
from validation.thesis_dams import record_named

# OpenSeismoMatlab takes this one, and the records in m/s2.
_G = 9.81
_STANDARD_G = 9.80665
# What the published curves are read off at, by record and friction: greatest distance from the start [m].
_CEPHALONIA = {
    "lixouri-2014-ew": {0.05: 0.711, 0.1: 0.685, 0.2: 0.455, 0.4: 0.121, 0.5: 0.043},
    "lixouri-2014-ns": {0.05: 0.283, 0.1: 0.169, 0.2: 0.106, 0.4: 0.011},
    "chavriata-2014-ew": {0.05: 0.152, 0.1: 0.111, 0.2: 0.049},
}
# Ten seconds of it are taken there [s].
_FROM, _TO = 23.0, 33.0
_Published = dict[tuple[float, float], tuple[float | None, float]]
# SLAMMER 1.1: slip [cm] down the slope as the record is and reversed, by peak and yield acceleration [g].
_SLAMMER: dict[str, _Published] = {
    "coalinga-1983-pvb-045": {
        (0.5, 0.05): (80.19936, 72.97075),
        (0.4, 0.1): (20.16421, 14.44684),
        (0.4, 0.2): (4.28398, 1.17071),
    },
    "mammoth-lakes-1-1980-cvk-090": {
        (0.5, 0.05): (45.02322, 45.18899),
        (0.4, 0.1): (9.24595, 9.8919),
        (0.4, 0.2): (None, 1.07729),
    },
    "duzce-turkey-1999-375-090": {(0.5, 0.05): (22.50671, 20.35704), (0.4, 0.1): (3.46104, 2.21386)},
    "nahanni-canada-1985-ns1-280": {(0.5, 0.05): (7.69188, 7.5727), (0.4, 0.1): (0.67769, 1.20482)},
}


def lixouri() -> Iterator[Row]:
    """Sliding spectra of Lixouri and Chavriata, Cephalonia, 3 February 2014: greatest slip of a rigid block in m.

    A block on a level base that slides both ways, one horizontal component, 23 to 33 s of the record, as
    OpenSeismoMatlab takes them in its own verification.
    """
    read = "read off the published curve, good for 3 mm"
    stiff = (
        "its block is a stiff elastic and plastic oscillator, of an unpublished period: periods of 0.02 to 0.1 s "
        "move an independent one by up to 39 mm under these records"
    )
    for name, published in _CEPHALONIA.items():
        record = record_named(name)
        for friction, reference in published.items():
            low, ours, high = (_farthest(record, friction, scale) for scale in (0.99, 1.0, 1.01))
            yield Row(
                f"{name}, friction {friction}",
                reference,
                ours,
                3e-3,
                relative=False,
                remark=f"{read}; {stiff}",
                kind="program",
                explained=0.015,
                spread=(min(low, high), max(low, high)),
            )


def _farthest(record: GroundMotion, friction: float, scale: float) -> float:
    """Return how far a flat block ever is from where it was [m]."""
    taken = (record.time > _FROM) & (record.time < _TO)
    time, ground = record.time[taken] - _FROM, scale * record.acceleration[taken]
    time = time - time[0]
    sliding = run(rectangle(10.0, 1.0, friction, gravity=_G), time, ground, np.linspace(0.0, time[-1], 20_001))
    return float(np.abs(sliding.histories.slip).max())


def slammer() -> Iterator[Row]:
    """Sliding down a slope by SLAMMER 1.1, rigid analysis: four records, slip in cm.

    A block that slides one way is one whose static push and friction make it yield at k_y downstream and never
    upstream.
    """
    remark = (
        "good for 2 %, which is what the verification of pySLAMMER allows between itself and SLAMMER: both go by the "
        "steps of the record"
    )
    for name, published in _SLAMMER.items():
        record = record_named(name)
        for (peak, yields), both in published.items():
            for way, sign, printed in zip(("as recorded", "reversed"), (-1.0, 1.0), both, strict=True):
                if printed is None:
                    continue
                motion = record.scaled_to(peak * _STANDARD_G)
                low, ours, high = (_downhill(motion, yields, peak, sign * factor) for factor in (0.99, 1.0, 1.01))
                yield Row(
                    f"{name} {way}, peak {peak} g, k_y {yields} g",
                    printed,
                    ours,
                    0.02,
                    remark=remark,
                    kind="program",
                    spread=(low, high),
                )


def _downhill(motion: GroundMotion, yields: float, peak: float, scale: float) -> float:
    """Return the slip [cm] of a block that yields at `yields` downstream and beyond the record's peak upstream."""
    downstream, upstream = yields * _STANDARD_G, 3.0 * peak * _STANDARD_G
    push = 100.0 * 2400.0 * (upstream - downstream) / 2.0
    block = rectangle(100.0, 1.0, (upstream + downstream) / (2.0 * _STANDARD_G), gravity=_STANDARD_G, push=push)
    # It comes to rest on a ground that stands still.
    end = motion.time[-1]
    time: Floats = np.append(motion.time, [end, end + 20.0])
    sliding = run(block, time, scale * np.append(motion.acceleration, [0.0, 0.0]))
    return 100.0 * float(sliding.summary.slip)
