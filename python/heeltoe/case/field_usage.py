"""Which models read which field of a case, and notices for fields without effect.

:data:`READ_BY` is the one place that knows; tests/case/test_every_field.py proves it by changing every field under
every model. A field that its own model reads only together with another one is in :func:`_idle`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cache
from typing import Any

from heeltoe.case.fields import Fields
from heeltoe.case.model import Case
from heeltoe.errors.error import shown
from heeltoe.warnings.notice import Notice

READERS = {
    "rigid": "the rigid model",
    "decoupled": "the decoupled chain",
    "flexible": "the flexible model",
    "statics": "the static checks",
}
_BLOCKS, _ELASTIC = frozenset({"rigid", "decoupled"}), frozenset({"decoupled", "flexible"})
_SHAKEN = _BLOCKS | _ELASTIC

# Whether it holds, what the reason is, and which fields have no effect then.
Rule = tuple[bool, str, tuple[str, ...]]

#: Fields, or whole blocks, that not every model reads, and those that do; of a field and its block, the field counts.
READ_BY: dict[str, frozenset[str]] = {
    "concrete.modulus": _ELASTIC,
    "concrete.poisson": _ELASTIC,
    "concrete.damping": _ELASTIC,
    "concrete.tensile_strength": frozenset({"flexible"}),
    "concrete.dynamic_tension": frozenset({"flexible"}),
    "crack.restitution": _BLOCKS,
    "crack.side_gap": frozenset({"rigid", "flexible"}),
    "motion.cross_valley": frozenset({"rigid", "flexible"}),
    "crack.rocking_loss": _BLOCKS,
    "crack.roughness": _BLOCKS | {"statics"},
    "crack.roughness.wear": _BLOCKS,
    "crack.band": _SHAKEN,
    "crack.kinks": frozenset({"flexible", "statics"}),
    "further_cracks.kinks": frozenset({"flexible", "statics"}),
    **dict.fromkeys(
        ("further_cracks", "crack.uplift", "crack.uplift_intensity"), frozenset({"rigid", "flexible", "statics"})
    ),
    "further_cracks.restitution": frozenset({"rigid"}),
    **dict.fromkeys((f"crack.law.{name}" for name in ("form", "slip", "speed", "surface")), _SHAKEN),
    "further_cracks.law": frozenset({"flexible", "statics"}),
    **dict.fromkeys(
        (f"further_cracks.law.{name}" for name in ("form", "slip", "speed", "surface")), frozenset({"flexible"})
    ),
    "joints": frozenset({"flexible", "statics"}),
    "crack.bond.dynamic_factor": _SHAKEN,
    # A rigid block bears its bond or not, and so does one at rest; it opens no crack that would take energy.
    **dict.fromkeys(
        (
            *(
                f"{crack}.bond.{name}"
                for crack in ("crack", "further_cracks", "joints")
                for name in ("fracture_energy", "shear_energy", "initial_energy")
            ),
            *(f"{crack}.bond.dynamic_factor" for crack in ("further_cracks", "joints")),
        ),
        frozenset({"flexible"}),
    ),
    **dict.fromkeys(("further_cracks.bond", "joints.bond"), frozenset({"flexible", "statics"})),
    "rock": frozenset({"flexible"}),
    "reservoir.virtual_mass_rotates": _BLOCKS,
    "tailwater.virtual_mass_rotates": _BLOCKS,
    **dict.fromkeys(
        (
            f"{side}.{name}"
            for side in ("reservoir", "tailwater")
            for name in ("compressible", "wave_speed", "floor_reflection")
        ),
        frozenset({"flexible"}),
    ),
    "reservoir.hydrodynamic": _BLOCKS | {"statics"},
    "tailwater.hydrodynamic": _BLOCKS | {"statics"},
    "anchors.axial_stiffness": _SHAKEN,
    "anchors.shear_stiffness": _SHAKEN,
    "anchors.capacity": _SHAKEN,
    "uplift.during_shaking": _SHAKEN,
    "uplift.opening": _SHAKEN,
    "motion": _SHAKEN,
    "aftershocks": _SHAKEN,
    # A suite takes them off the case and runs the models through each of its records.
    **dict.fromkeys(("motions", "suite"), frozenset[str]()),
    "flexible": frozenset({"flexible"}),
    **dict.fromkeys(
        (
            f"flexible.{name}"
            for name in (
                *("plane", "virtual_mass"),
                *("elements_across", "elements_across_below", "elements_away", "mesh_above", "mesh_below"),
            )
        ),
        _ELASTIC,
    ),
    "decoupled": frozenset({"decoupled"}),
    "statics": frozenset({"statics"}),
    "limits": _SHAKEN,
    **dict.fromkeys(("limits.crest_displacement", "limits.crest_acceleration"), frozenset({"rigid", "flexible"})),
    "analysis": _BLOCKS,
    "analysis.silence": _SHAKEN,
    "analysis.time_limit": _ELASTIC,
    "analysis.memory_limit": _ELASTIC,
}

# Values that hold for every block.
_AS_BLOCKS = {"rock": ("rigid",), "reservoir.compressible": (False,), "tailwater.compressible": (False,)}
# What a reader would expect to matter to the flexible model has a sentence of its own.
_EXPECTED = {
    "analysis.rotation": "it is for the rigid block, and elastic parts rotate by small angles",
    "crack.restitution": "it is for impacts of a rigid block; elastic faces rebound by the waves in the concrete",
    "reservoir.hydrodynamic": "",
    "tailwater.hydrodynamic": "",
}


def unused_fields(case: Case, models: Sequence[str]) -> tuple[Notice, ...]:
    """Return notices for the given fields of a case that no model reads.

    Parameters
    ----------
    case
        As the user gave it: of defaults nothing is said.
    models
        ``"rigid"``, ``"decoupled"``, ``"flexible"``, ``"statics"``: those whose results stand side by side. What one
        of them reads is read.
    """
    values = {path: (_plain(path), value) for path, value in _written_values(case)}
    # Between the motions of a sequence a dam is judged by the static checks.
    users = {*models, "statics"} if case.aftershocks else set(models)
    # What the static checks alone read says what `heeltoe statics` shall do, and is none too many beside a run.
    foreign = [
        path
        for path, (plain, value) in values.items()
        if not (own := readers(plain)) & users and own != {"statics"} and value not in _AS_BLOCKS.get(path, ())
    ]
    notices = []
    if "flexible" in models:
        # Rotations beyond small ones, and pressures beside the usual ones, are asked for because they matter, and one
        # of two models leaves them out.
        usual, apart = ("small", "westergaard"), tuple(path for path in _EXPECTED if path != "crack.restitution")
        expected = [
            path
            for path in _EXPECTED
            if path in foreign or (path in apart and values.get(path, (path, "small"))[1] not in usual)
        ]
        foreign = [path for path in foreign if path not in expected]
        # The water of an elastic dam is Westergaard's in any case.
        expectations = [path for path in expected if values[path][1] != "westergaard"]
        for path in expectations:
            stated, why = shown(values[path][1]), _EXPECTED[path]
            unread = Notice("value-unused", field=path, value=stated, why=why) if why else None
            notices.append(unread or Notice("hydrodynamic-unused", field=path, value=stated))
    if foreign:
        names = [name for model, name in READERS.items() if model in models]
        notices.append(Notice("fields-unused", readers=" and ".join(names), fields=", ".join(foreign)))
    for why, paths in _idle(case, models).items():
        idle = [
            path for path, (plain, _) in values.items() if (path in paths or plain in paths) and path not in foreign
        ]
        if idle:
            notices.append(Notice("fields-idle", field=idle[0], fields=", ".join(idle), why=why))
    return tuple(notices)


def _written_values(block: Fields, above: str = "") -> Iterator[tuple[str, Any]]:
    """Walk the fields that the user has given: their paths and values."""
    for name in type(block).model_fields:
        if name not in block.model_fields_set:
            continue
        value, path = getattr(block, name), above + name
        if isinstance(value, Fields):
            yield from _written_values(value, f"{path}.")
        elif isinstance(value, tuple) and value and isinstance(value[0], Fields):
            for place, item in enumerate(value):
                yield from _written_values(item, f"{path}[{place}].")
        elif value is not None:
            yield path, value


def _plain(path: str) -> str:
    """Return a path without places in lists."""
    return re.sub(r"\[\d+\]", "", path) if "[" in path else path


@cache
def readers(path: str) -> frozenset[str]:
    path = re.sub(r"^cracks(?=\.|$)", "crack", _plain(path))
    while path:
        if path in READ_BY:
            return READ_BY[path]
        path = path.rpartition(".")[0]
    return frozenset(READERS)


def _idle(case: Case, models: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Return fields that have no effect though models like these read them, by the reason why."""
    rules = [*_idle_water(case, models), *_idle_choices(case, models)]
    groups: dict[str, tuple[str, ...]] = {}
    for holds, why, paths in rules:
        if holds:
            groups[why] = groups.get(why, ()) + paths
    return groups


def _idle_water(case: Case, models: Sequence[str]) -> Iterator[Rule]:
    uplift, section = case.uplift, case.cut
    above = {
        side: water is not None and section.base_elevation + water.depth > end[1]
        for side, water, end in (
            ("reservoir", case.reservoir, section.heel),
            ("tailwater", case.tailwater, section.toe),
        )
    }
    dry = not any(above.values())
    # The static checks fill the reservoir until the dam moves.
    still = "statics" not in models
    yield (
        still and dry and uplift.pattern != "profile",
        "no water stands above the crack",
        tuple(f"uplift.{name}" for name in type(uplift).model_fields),
    )
    for side, force in above.items():
        moves = (f"{side}.virtual_mass_rotates", f"{side}.hydrodynamic")
        yield not force, f"the {side} does not stand above the crack", moves
    crest = section.crest_elevation - section.base_elevation
    highest = max(case.reservoir.depth if case.reservoir else 0.0, 0.0 if still else case.statics.flood_depth or 0.0)
    yield highest <= crest, "no water stands above the crest", ("reservoir.nappe",)
    yield (
        uplift.pattern == "none" and uplift.during_shaking == "constant" and not dry,
        'uplift.pattern = "none"',
        ("uplift.intensity",),
    )
    yield (
        _stands_upright(case, below="flexible" in models),
        "the silt stands before a vertical face",
        ("silt.vertical_density",),
    )
    yield (
        set(models) == {"statics"} and not case.statics.pseudo_static,
        "there is no statics.seismic_coefficient",
        ("reservoir.hydrodynamic", "tailwater.hydrodynamic"),
    )
    still_water = tuple(f"{side}.follows_vertical_motion" for side in ("reservoir", "tailwater"))
    yield (
        set(models) == {"statics"}
        and not any(earthquake.vertical_seismic_coefficient for earthquake in case.statics.pseudo_static),
        "there is no statics.vertical_seismic_coefficient",
        still_water,
    )


def _idle_choices(case: Case, models: Sequence[str]) -> Iterator[Rule]:
    options, choice = case.flexible, case.statics
    flexible, elastic = "flexible" in models, not _ELASTIC.isdisjoint(models)
    penalty = tuple(f"flexible.{name}" for name in ("penalty_factor", "newmark_gamma", "newmark_beta"))
    yield flexible and options.contact == "coulomb", 'flexible.contact = "coulomb"', penalty
    yield flexible and options.contact == "idce", 'flexible.contact = "idce"', ("flexible.theta",)
    bonded = any(crack.bond is not None for crack in (case.crack, *case.further_cracks))
    yield not bonded, "no crack has a bond", ("limits.cracked_length",)
    yield (
        set(models) == {"statics"} and choice.has_own_bond,
        "[statics] has a bond of its own",
        tuple(
            f"{crack}.bond.{name}" for crack in ("crack", "further_cracks") for name in ("tensile_strength", "cohesion")
        ),
    )
    unjudged = case.concrete.tensile_strength is None
    yield flexible and unjudged, "concrete.tensile_strength is not given", ("concrete.dynamic_tension",)
    water = any(body and body.depth for body in (case.reservoir, case.tailwater))
    yield elastic and not water, "there is no water", ("flexible.virtual_mass", "flexible.damping_on_water")
    for side, body in (("reservoir", case.reservoir), ("tailwater", case.tailwater)):
        fields = (f"{side}.wave_speed", f"{side}.floor_reflection")
        yield flexible and body is not None and not case.has_sound(side), f"{side}.compressible is false", fields
    springs = case.foundation is not None and case.foundation.massless
    yield flexible and springs, "rock.massless is set", ("rock.density", "rock.radiation")
    lowest = case.single_crack_cases[-1]
    bonded_to_rock = case.foundation is not None and case.outline.area - lowest.cut.area > 1e-9 * case.outline.area
    yield flexible and bonded_to_rock, "all cracks are above the base", ("rock.bears_uplift",)
    dry_crack = case.foundation is not None and lowest.uplift.pattern == "none"
    yield flexible and dry_crack, "the crack on the rock has no uplift", ("rock.bears_uplift",)
    below = case.outline.area - case.cut.area > 1e-9 * case.outline.area
    across, across_below = "flexible.elements_across", "flexible.elements_across_below"
    yield elastic and not below, "nothing is below the crack", (across_below,)
    yield elastic and bool(options.mesh_below), "flexible.mesh_below is given", (across_below,)
    meshed_below = not below or options.mesh_below or options.elements_across_below
    yield elastic and bool(options.mesh_above and meshed_below), "flexible.mesh_above is given", (across,)
    meshed = [
        *([] if options.mesh_above else [options.row_counts()]),
        *([options.row_counts(below=True)] if below and not options.mesh_below else []),
    ]
    even = not any(halvings for _, halvings in meshed)
    yield elastic and even, "the elements along the crack cannot be halved to so few", ("flexible.elements_away",)
    yield (
        "decoupled" in models and bool(case.motion and case.motion.vertical),
        "the block feels a vertical motion of the ground in any case",
        ("decoupled.vertical",),
    )
    slid = case.motion or choice.residual_slip is not None or choice.residual_friction is not None
    yield (
        set(models) == {"statics"} and (not slid or choice.residual_friction is not None),
        "statics.residual_friction is given" if slid else "nothing slides in these checks",
        ("crack.kinetic_friction", "further_cracks.kinetic_friction"),
    )
    shaken_across = any(motion.cross_valley is not None for motion in (case.motion, *case.aftershocks) if motion)
    yield not shaken_across, "there is no motion.cross_valley", ("crack.side_gap",)
    laws = {
        "crack": case.crack.law,
        **{f"further_cracks[{place}]": crack.law for place, crack in enumerate(case.further_cracks)},
    }
    for crack, law in laws.items():
        yield (
            set(models) == {"statics"} and law is not None and law.name == "speed weakening",
            "a crack at rest does not slip",
            (f"{crack}.law.residual_friction",),
        )
        yield (
            set(models) == {"statics"}
            and law is not None
            and law.name == "slip weakening"
            and (not slid or choice.residual_friction is not None),
            "statics.residual_friction is given" if slid else "nothing slides in these checks",
            (f"{crack}.law.residual_friction",),
        )


def _stands_upright(case: Case, *, below: bool) -> bool:
    """Whether silt stands before a vertical face alone, above the crack and, if that counts, `below` it."""
    if case.silt is None:
        return False
    face = case.cut.upstream_face
    wet = face[: int((face[:, 1] < case.cut.base_elevation + case.silt.depth).sum()) + 1, 0]
    straight = bool((abs(wet - wet[0]) < 1e-9).all())
    return straight and (not below or case.outline.bounds[0] >= wet[0] - 1e-9)
