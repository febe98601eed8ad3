"""The largest tension of a run beside the strength of the concrete: what the contract says of it, and its warnings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from heeltoe.case.model import Case
from heeltoe.models.flexible.body.reduced import FlexibleDam
from heeltoe.models.flexible.evidence.refinement import Answer
from heeltoe.models.flexible.mesh.dam import BodyMesh
from heeltoe.models.flexible.result.envelope import (
    PartEnvelope,
    Peak,
    envelope_of,
    largest_compression,
    largest_tension,
    tension_before,
)
from heeltoe.result.numbers import StressPlace, TensileStrength, Tension, TensionByMesh
from heeltoe.result.tension import place_phrase
from heeltoe.warnings.notice import Notice

# What a part of the dam is called.
_PARTS = ("above", "below")


def tension_of(answer: Answer, parts: Sequence[PartEnvelope]) -> Tension | None:
    """Return the largest tension of a run for the result, and its value on other meshes; None where every point is too
    close to a singular one."""
    dam = answer.shaken.dam
    tension, compression = largest_tension(parts), largest_compression(parts)
    if tension is None or compression is None:
        return None
    before = tension_before(parts)
    return Tension(
        **_where(dam, parts, tension),
        direction_rad=float(parts[tension.part].direction[tension.index]),
        before_shaking_pa=before,
        strength=_judged(answer.shaken.case, dam, parts, (tension.stress, before)),
        read_from_crack_m=dam.stress_places[0].apart,
        mesh=_by_mesh(answer, tension),
        compression=_where(dam, parts, compression),
    )


# More tension than this [Pa] cracks some concrete of dams.
_WORTH_A_WORD = 1e6


def tension_warnings(tension: Tension | None) -> Iterator[Notice]:
    """Return what a reader must know where the concrete does not bear its tension."""
    strength = None if tension is None else tension.strength
    if tension is None:
        return
    if strength is None:
        if tension.stress_pa > _WORTH_A_WORD:
            yield Notice("tension-unjudged", stress_pa=tension.stress_pa)
        return
    if strength.exceeds_before_shaking:
        yield Notice(
            "tension-exceeds",
            "before",
            stress_pa=tension.before_shaking_pa,
            strength_pa=strength.static_pa,
        )
    if strength.exceeds:
        yield Notice(
            "tension-exceeds",
            "shaken",
            time_s=tension.time_s,
            stress_pa=tension.stress_pa,
            strength_pa=strength.dynamic_pa,
            where=place_phrase(tension),
            z_m=tension.z_m,
            share=strength.share_beyond,
        )


def share_beyond(dam: FlexibleDam, parts: Sequence[PartEnvelope], strength: float) -> float:
    """Return which part of the section has had more tension than `strength` [Pa], where the stress has a bound: of each
    element as much as of its corners."""
    beyond, whole = 0.0, 0.0
    for body, part in zip(dam.bodies, parts, strict=True):
        corners = body.mesh.elements[:, :4]
        over = (part.bounded & (part.tension > strength))[np.searchsorted(part.nodes, corners)]
        x, z = np.moveaxis(body.mesh.nodes[corners], 2, 0)
        area = np.abs(np.sum(x * np.roll(z, -1, axis=1) - z * np.roll(x, -1, axis=1), axis=1)) / 2.0
        beyond += float(area @ over.mean(axis=1))
        whole += float(area.sum())
    return beyond / whole


def _judged(
    case: Case, dam: FlexibleDam, parts: Sequence[PartEnvelope], tensions: tuple[float, float]
) -> TensileStrength | None:
    """Return the strength beside the largest tension and that before the earthquake; None where none is given."""
    static = case.concrete.tensile_strength
    if static is None:
        return None
    dynamic = static * case.concrete.dynamic_tension
    return TensileStrength(
        dynamic_pa=dynamic,
        static_pa=static,
        exceeds=tensions[0] > dynamic,
        exceeds_before_shaking=tensions[1] > static,
        share_beyond=share_beyond(dam, parts, dynamic),
    )


def _by_mesh(answer: Answer, tension: Peak) -> TensionByMesh | None:
    """Return what another mesh makes of the largest tension; None where there is none beside."""
    if answer.beside is None:
        return None
    shaken, run = answer.beside
    other = largest_tension(envelope_of(shaken.dam, run))
    if other is None:
        return None
    return TensionByMesh(
        other_elements_across=shaken.case.flexible.elements_across,
        stress_pa=other.stress,
        difference_pa=abs(tension.stress - other.stress),
    )


def _where(dam: FlexibleDam, parts: Sequence[PartEnvelope], peak: Peak) -> StressPlace:
    mesh = dam.bodies[peak.part].mesh
    node = int(parts[peak.part].nodes[peak.index])
    x, z = mesh.nodes[node]
    return StressPlace(
        stress_pa=peak.stress,
        time_s=peak.time,
        part=_part(dam, peak.part),
        place=_place(mesh, node),
        x_m=float(x),
        z_m=float(z),
    )


def _part(dam: FlexibleDam, place: int) -> str:
    """Return what a part is called."""
    if len(dam.lines) == 1:
        return _PARTS[place]
    return "uppermost" if place == 0 else "between" if place < dam.free else "lowest"


def _place(mesh: BodyMesh, node: int) -> str:
    """Return on which face a node is."""
    for name, nodes in (("upstream", mesh.upstream), ("downstream", mesh.downstream), ("base", mesh.fixed)):
        if node in nodes:
            return name
    return "inside"
