"""Which way rigid rock and water without sound put a slip wrong: by a study of made dams, each run without and with
both (docs/validation/rigid-rock.md)."""

from __future__ import annotations

from collections.abc import Iterator

from heeltoe.case.model import Case
from heeltoe.units.sentences import Sentence
from heeltoe.warnings.notice import Notice

#: By the depth of the reservoir over the height of the dam, from and to: how many were studied, which share of them
#: slides less far with rock and sound, and between how many times as far the middle half of them slides.
CLASSES = (
    (0.6, 0.8, 45, 0.62, (0.23, 1.47)),
    (0.8, 1.0, 50, 0.78, (0.4, 0.94)),
)
# What else the dams had in common, from and to.
_HEIGHT_M, _FRICTION, _PEAK_G = (30.0, 150.0), (0.7, 1.1), (0.3, 0.6)
# Least slip that is worth a word [m].
_LEAST = 1e-3


def left_out(case: Case, slip: float, peak: float) -> Iterator[Notice]:
    """Say of a dam on rigid rock before water without sound which way its slip is off.

    Parameters
    ----------
    case
        The dam.
    slip
        Its largest residual slip [m].
    peak
        Peak acceleration of the ground [m/s2].
    """
    around = case.surroundings
    if case.foundation is not None or case.has_compressible_water or abs(slip) < _LEAST:
        return
    if around.rigid_since or around.mass_since:
        # Another warning says that nothing could be assumed.
        return
    height = case.cut.crest_elevation - case.cut.base_elevation
    depth = 0.0 if case.reservoir is None else case.reservoir.depth / height
    why = _unlike(case, height, depth, peak / case.gravity)
    if why is not None:
        yield Notice("surroundings-left-out", "unknown", why=why)
        return
    *_, (_, _, cases, share, times) = (item for item in CLASSES if item[0] <= depth)
    yield Notice("surroundings-left-out", "studied", cases=cases, share=share, times=times)


def _unlike(case: Case, height: float, depth: float, peak: float) -> Sentence | None:
    """Return the quantities by which a dam differs from all that were studied; None for one like them."""
    if case.further_cracks or case.crack.elevation > 0.0:
        return Sentence.of("they have one crack, at the base")
    if not _HEIGHT_M[0] <= height <= _HEIGHT_M[1]:
        return Sentence.of("they are {ends_m:g m|to} high", ends_m=_HEIGHT_M)
    if case.crack.law is not None or not _FRICTION[0] <= case.crack.mu_static <= _FRICTION[1]:
        return Sentence.of("their friction is {ends:g|to}", ends=_FRICTION)
    ends = CLASSES[0][0], CLASSES[-1][1]
    if not ends[0] <= depth <= ends[1]:
        return Sentence.of("their water is {ends:g|to} of their height deep", ends=ends)
    if not _PEAK_G[0] <= peak <= _PEAK_G[1]:
        return Sentence.of("their motions have peaks of {ends_g:.2g g|to}", ends_g=_PEAK_G)
    return None
