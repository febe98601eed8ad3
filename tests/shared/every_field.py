"""Every field of a case, and another sensible value for each: what the schema says, with the few that need help."""

from __future__ import annotations

import copy
import re
import types
import typing
from collections.abc import Iterator
from typing import Any, Literal

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from heeltoe import Case
from shared.dams import plane_case

Fields = dict[str, Any]

PULSE = [["0 s", "0 g"], ["0.1 s", "2.4 g"], ["0.2 s", "-2 g"], ["0.3 s", "1.8 g"], ["0.4 s", "0 g"], ["0.6 s", "0 g"]]
UP = [["0 s", "0 g"], ["0.1 s", "0.3 g"], ["0.25 s", "-0.4 g"], ["0.4 s", "0 g"]]
STEPS: dict[str, Fields] = {
    "baseline": {},
    "band-pass": {"low": "0.5 Hz", "high": "4 Hz"},
    "taper": {},
    "cut": {},
    "window": {"start": "0.05 s", "end": "0.35 s"},
    "scale-to-arias": {"intensity": "2 m/s"},
    "scale-to-spectrum": {"period": "0.2 s", "acceleration": "1 g"},
    "scale-time": {"factor": 1.2, "allow": True},
}
# A dam that slides, rocks and strikes in half a second, under all that a case knows of.
BASE: Fields = {
    "section": {
        "height": "30 m",
        "crest_width": "5 m",
        "neck_height": "25 m",
        "neck_width": "6 m",
        "base_width": "26 m",
    },
    "concrete": {"modulus": "20 GPa", "tensile_strength": "1 MPa"},
    "crack": {"elevation": "6 m", "static_friction": 0.7, "kinetic_friction": 0.6},
    "reservoir": {"depth": "26 m"},
    "tailwater": {"depth": "10 m"},
    "ice": {"force": "50 kN/m"},
    "silt": {"depth": "12 m"},
    "anchors": [
        {
            "distance": "4 m",
            "inclination": "5 deg",
            "prestress": "300 kN/m",
            "axial_stiffness": "20 MN/m/m",
            "shear_stiffness": "10 MN/m/m",
            "capacity": "2 MN/m",
        }
    ],
    "uplift": {
        "pattern": "drained",
        "drain_position": 0.15,
        "drain_efficiency": 0.5,
        "during_shaking": "zero while open",
        "opening": "0.2 mm",
    },
    "motion": {"points": PULSE, "vertical": {"points": UP}},
    "flexible": {"elements_across": 4, "modes": 12, "evidence": "none"},
    "limits": {
        "residual_slip": "10 mm",
        "peak_slip": "20 mm",
        "opening_upstream": "10 mm",
        "opening_downstream": "10 mm",
        "cracked_length": "5 m",
        "rotation": "0.1 mrad",
        "crest_displacement": "5 mm",
        "crest_acceleration": "1 g",
    },
    "statics": {
        "bonded": 0.3,
        "cohesion": "0.5 MPa",
        "tensile_strength": "0.1 MPa",
        "compressive_strength": "20 MPa",
        "flood_depth": "29 m",
        "flood_tailwater": "11 m",
        "seismic_coefficient": 0.2,
        "vertical_seismic_coefficient": 0.1,
        "residual_friction": 0.5,
        "residual_slip": "20 mm",
        "drain_diameter": "75 mm",
    },
}
GONE = object()
FACES: Fields = {
    "height": "30 m",
    "crest_width": "5 m",
    "upstream": [["0 m", 0.2], ["10 m", 0.0]],
    "downstream": [["0 m", 0.8], ["25 m", 0.0]],
}
ENDS: Fields = {
    "head_x": "2 m",
    "head_elevation": "30 m",
    "foot_x": "6 m",
    "foot_elevation": "2 m",
    "prestress": "300 kN/m",
    "axial_stiffness": "20 MN/m/m",
}
PEAK: Fields = {"peak_friction": 0.75, "residual_friction": 0.6}
WEAKENING: Fields = {"name": "slip weakening", **PEAK, "slip": "20 mm"}
BARTON: Fields = {"name": "barton-bandis", "jrc": 8, "jcs": "10 MPa", "residual_angle": "28 deg"}
LIFT: Fields = {
    "name": "lift joint",
    "surface": "untreated",
    "basic_friction": 0.6,
    "roughness_friction": [["0.1 MPa", 0.2], ["2 MPa", 0.1]],
}
ROUGH: Fields = {"asperity_height": "2 mm", "wave_length": "50 mm", "wear": "1e-5 m^2/J"}
STIFF: Fields = {"anchors": GONE, "uplift.during_shaking": GONE, "uplift.opening": GONE}
NO_COEFFICIENTS: Fields = {"crack.static_friction": GONE, "crack.kinetic_friction": GONE, "statics.cohesion": GONE}
#: A dam that slides both ways, and does not lift.
CROSS: Fields = {
    **STIFF,
    "crack.static_friction": 0.45,
    "crack.kinetic_friction": 0.4,
    "motion.cross_valley": {"points": [["0 s", "0 g"], ["0.15 s", "1.4 g"], ["0.3 s", "-1 g"], ["0.4 s", "0 g"]]},
}
#: The same, of components that are rotated to the stream.
TURNED: Fields = {
    **CROSS,
    "motion.azimuth": "10 deg",
    "motion.direction": "0 deg",
    "motion.cross_valley.direction": "90 deg",
}
#: For fields that stand only in another case than the base, or have no value there: what changes first, then the value.
HELPED: dict[str, tuple[Fields, Any]] = {
    "title": ({}, "another"),
    "crack.side_gap": (CROSS, "0 mm"),
    "motion.cross_valley.reverse": (CROSS, True),
    "motion.azimuth": (TURNED, "40 deg"),
    "motion.direction": (TURNED, "180 deg"),
    "motion.cross_valley.direction": (TURNED, "270 deg"),
    **{
        f"motion.cross_valley.processing[{step}].{name}": (CROSS, None)
        for step, values in STEPS.items()
        for name in ("order", "displacement", "share", "ends", "start", "end", "damping", "allow", *values)
    },
    "motion.sign": ({"motion.reverse": GONE}, "reversed"),
    "section.upstream": ({"section": FACES}, [["0 m", 0.1], ["12 m", 0.0]]),
    "section.downstream": ({"section": FACES}, [["0 m", 0.7], ["25 m", 0.0]]),
    **{
        f"anchors[0].{name}": ({"anchors": [ENDS]}, value)
        for name, value in (("head_x", "3 m"), ("head_elevation", "28 m"), ("foot_x", "7 m"), ("foot_elevation", "1 m"))
    },
    "uplift.drain_x": ({"uplift.drain_position": GONE, "uplift.drain_x": "3 m"}, "4 m"),
    "section.polygon": (
        {"section": {"polygon": [["0 m", "0 m"], ["26 m", "0 m"], ["5 m", "30 m"], ["0 m", "30 m"]]}},
        [["-2 m", "0 m"], ["26 m", "0 m"], ["5 m", "30 m"], ["0 m", "30 m"]],
    ),
    **{
        f"crack.band.{name}": ({"crack.band": {"low": 0.5, **ends}}, value)
        for ends, name, value in (
            ({}, "low", 0.55),
            ({"high": 0.8}, "high", 0.9),
            ({}, "judge", "low"),
            ({"slip_weakening": {"residual_friction": 0.4, "slip": "5 mm"}}, "slip_weakening.residual_friction", 0.3),
            ({"slip_weakening": {"residual_friction": 0.4, "slip": "5 mm"}}, "slip_weakening.slip", "2 mm"),
            (
                {"speed_weakening": {"residual_friction": 0.4, "speed": "1 cm/s"}},
                "speed_weakening.residual_friction",
                0.3,
            ),
            ({"speed_weakening": {"residual_friction": 0.4, "speed": "1 cm/s"}}, "speed_weakening.speed", "2 cm/s"),
        )
    },
    "crack.friction": ({"crack.static_friction": GONE, "crack.kinetic_friction": GONE, "crack.friction": 0.6}, 0.5),
    **{
        f"crack.law.{name}": ({**NO_COEFFICIENTS, "crack.law": law}, value)
        for law, name, value in (
            (WEAKENING, "name", "speed weakening"),
            (WEAKENING, "form", "exponential"),
            (WEAKENING, "peak_friction", 0.8),
            (WEAKENING, "residual_friction", 0.55),
            (WEAKENING, "slip", "30 mm"),
            ({"name": "speed weakening", **PEAK, "speed": "0.1 m/s"}, "speed", "0.2 m/s"),
            ({"name": "cohesion", "residual_friction": 0.6, "cohesion": "50 kPa"}, "cohesion", "60 kPa"),
            (BARTON, "jrc", 9),
            (BARTON, "jcs", "11 MPa"),
            (BARTON, "residual_angle", "29 deg"),
            (LIFT, "surface", "monolithic"),
            (LIFT, "basic_friction", 0.55),
            (LIFT, "roughness_friction", [["0.1 MPa", 0.25], ["2 MPa", 0.1]]),
        )
    },
    **{
        f"crack.roughness.{name}": ({**STIFF, "crack.roughness": ROUGH}, value)
        for name, value in (("asperity_height", "3 mm"), ("wave_length", "60 mm"), ("wear", "1e-4 m^2/J"))
    },
    "crack.inclination": ({}, "5 deg"),
    "reservoir.nappe": ({"reservoir.depth": "31 m", "ice": GONE}, "weight"),
    "uplift.pattern": ({"uplift": {"pattern": "uniform"}, "statics.drain_diameter": GONE}, None),
    "uplift.extent": ({"uplift": {"pattern": "cut-off", "extent": 0.5}, "statics.drain_diameter": GONE}, 0.4),
    "uplift.points": (
        {"uplift": {"pattern": "profile", "points": [[0.0, "20 m"], [1.0, "4 m"]]}, "statics.drain_diameter": GONE},
        [[0.0, "20 m"], [1.0, "3 m"]],
    ),
    "flexible.elements_across_below": ({}, 5),
    "flexible.elements_away": ({"flexible.elements_across": 8}, 2),
    "flexible.time_step": ({}, "0.3 ms"),
    "flexible.mesh_above": ({}, "nowhere.msh"),
    "flexible.mesh_below": ({}, "nowhere.msh"),
    "flexible.damping_on_water": ({"flexible.damping": "relative"}, None),
    "flexible.contact": ({"flexible.damping": "stiffness"}, None),
    "flexible.newmark_beta": ({}, 0.4),
    "analysis.event_limit": ({}, 3),
    "analysis.silence": ({}, "0 s"),
    "analysis.time_limit": ({}, "1 ms"),
    "analysis.memory_limit": ({}, "1 kB"),
    "decoupled.vertical": ({"motion.vertical": GONE}, None),
    "aftershocks[0].pause": ({"aftershocks": [{"points": PULSE, "pause": "0.1 s"}]}, "0.15 s"),
    "statics.criteria_file": ({}, "nowhere.toml"),
    "statics.tensile_strength": ({"statics.bonded": 1.0, "statics.tensile_strength": "0.01 MPa"}, "0.05 MPa"),
}
JOINT = {"elevation": "10 m", "friction": 0.65, "bonded": 0.4, "cohesion": "0.4 MPa", "tensile_strength": "0.01 MPa"}

# A second crack above that of the base, with what knows one crack alone left out.
SECOND = {"elevation": "18 m", "static_friction": 0.7, "kinetic_friction": 0.6}
SECOND |= {"uplift": "triangular", "uplift_intensity": 0.5}
SEVERAL: Fields = {
    "further_cracks": [SECOND],
    "anchors": GONE,
    "aftershocks": GONE,
    "uplift.during_shaking": GONE,
    "uplift.opening": GONE,
}
HELPED |= {f"further_cracks[0].{name}": (SEVERAL, None) for name in SECOND}
HELPED |= {
    "further_cracks[0].inclination": (SEVERAL, "5 deg"),
    "further_cracks[0].uplift": (SEVERAL, "uniform"),
    # Low enough for a rigid block to slide.
    "further_cracks[0].static_friction": (SEVERAL | {"further_cracks": [SECOND | {"kinetic_friction": 0.3}]}, 0.35),
    "further_cracks[0].friction": (
        SEVERAL | {"further_cracks": [{"elevation": "18 m", "friction": 0.6, "uplift": "triangular"}]},
        0.5,
    ),
}
HELPED |= {
    f"further_cracks[0].{path.removeprefix('crack.')}": (
        SEVERAL | {"further_cracks": [{"elevation": "18 m", "law": changes["crack.law"], "uplift": "triangular"}]},
        value,
    )
    for path, (changes, value) in HELPED.items()
    if path.startswith("crack.law.")
}
HELPED["further_cracks[0].kinks"] = (
    SEVERAL | {"flexible.elements_across_below": GONE},
    [["5 m", "0.5 m"]],
)
_STRAIGHT_ALONE = (
    "aftershocks",
    "uplift.during_shaking",
    "uplift.opening",
    "flexible.elements_across_below",
)
# Strong enough to hold for a while, weak enough to break.
BONDED: Fields = {
    "tensile_strength": "0.1 MPa",
    "cohesion": "0.3 MPa",
    "fracture_energy": "300 N/m",
    "shear_energy": "100 N/m",
    "initial_energy": "200 N/m",
    "dynamic_factor": 1.1,
}
HELPED |= {f"crack.bond.{name}": ({"crack.bond": BONDED}, None) for name in BONDED}
HELPED |= {
    f"further_cracks[0].bond.{name}": (SEVERAL | {"further_cracks": [SECOND | {"bond": BONDED}]}, None)
    for name in BONDED
}
HELPED |= {
    f"{side}.{name}": ({f"{side}.compressible": True}, None)
    for side in ("reservoir", "tailwater")
    for name in ("wave_speed", "floor_reflection")
}
ON_ROCK: Fields = {
    "rock": {"modulus": "5 GPa"},
    "crack.elevation": "0 m",
    **dict.fromkeys(("anchors", "uplift.during_shaking", "uplift.opening", "flexible.elements_across_below"), GONE),
}
HELPED |= {
    f"rock.{name}": (ON_ROCK, None)
    for name in ("modulus", "poisson", "density", "damping", "radiation", "bears_uplift", "massless")
}
HELPED["crack.kinks"] = (dict.fromkeys(_STRAIGHT_ALONE, GONE), [["8 m", "0.5 m"]])
HELPED |= {
    "crack.uplift": (SEVERAL | {"crack.uplift": "none"}, "uniform"),
    "crack.uplift_intensity": (SEVERAL | {"crack.uplift_intensity": 0.5}, 1.5),
    # Strong enough for the upper block to strike.
    "further_cracks[0].restitution": (SEVERAL | {"motion.pga": "5 g"}, 0.1),
}
QUAKE = {"name": "MDE", "seismic_coefficient": 0.1, "vertical_seismic_coefficient": 0.05, "rarity": "extreme"}
QUAKES = {
    "statics.seismic_coefficient": GONE, "statics.vertical_seismic_coefficient": GONE, "statics.earthquakes": [QUAKE],
}  # fmt: skip
HELPED |= {f"statics.earthquakes[0].{name}": (QUAKES, None) for name in QUAKE}
HELPED["statics.earthquakes[0].name"] = (QUAKES, "SEE")
HELPED["statics.earthquakes[0].rarity"] = (QUAKES, "unusual")
HELPED |= {f"statics.sections[0].{name}": ({"statics.sections": [JOINT]}, None) for name in JOINT}
SUITE: Fields = {"motions": [{"file": "a.txt", "vertical": "up.txt"}]}
HELPED |= {
    "motions[0].file": (SUITE, "b.txt"),
    "motions[0].vertical": (SUITE, "down.txt"),
    "suite.judge": (SUITE, "mean"),
    "suite.target": (SUITE, "en1998:0.3g,B"),
    "suite.pga": (SUITE, "0.3 g"),
    "suite.sa": (SUITE, "0.5 g"),
    "suite.period": (SUITE | {"suite.sa": "0.5 g"}, "0.3 s"),
    "suite.match": (SUITE, "en1998:0.3g,B"),
    "suite.both_signs": (SUITE, False),
    "suite.vertical": (SUITE, True),
    "suite.disaggregation": (SUITE, "Mag_Dist-0.csv"),
    "suite.unit": (SUITE, "g"),
    "suite.time_step": (SUITE, "0.01 s"),
    "suite.layout": (SUITE, "rows"),
    "suite.factor": (SUITE, "divide"),
}
_NUMBER = re.compile(r"-?\d+(?:\.\d*)?(?:e[+-]?\d+)?")


def leaves(model: type[BaseModel] = Case, above: str = "") -> Iterator[tuple[str, FieldInfo]]:
    """Walk the schema: every field that holds a value, with its path; of a list of blocks the first, of steps each."""
    for name, field in model.model_fields.items():
        path = above + name
        if name == "project":
            continue  # words of the report, on which no number depends
        if name == "aftershocks":
            # All else of them is what a motion has, read by the same code.
            yield f"{path}[0].pause", _blocks(field.annotation)[0].model_fields["pause"]
            continue
        if name == "processing":
            for kind in _blocks(field.annotation):
                step = typing.get_args(kind.model_fields["step"].annotation)[0]
                yield from ((f"{path}[{step}].{inner}", leaf) for inner, leaf in _own(kind))
            continue
        blocks = _blocks(field.annotation)
        many = typing.get_origin(field.annotation) is tuple
        if blocks:
            yield from leaves(blocks[0], f"{path}[0]." if many else f"{path}.")
        else:
            yield path, field


def _own(kind: type[BaseModel]) -> list[tuple[str, FieldInfo]]:
    return [(name, field) for name, field in kind.model_fields.items() if name != "step"]


def _blocks(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [block for inner in typing.get_args(annotation) for block in _blocks(inner)]


def pair(path: str, field: FieldInfo, records: dict[str, tuple[Fields, Any]]) -> tuple[Fields, Fields, str]:
    """Return the fields of two cases that differ in one field alone, and how its path is written in messages."""
    changes, value = (HELPED | records).get(path, ({}, None))
    before = copy.deepcopy(BASE)
    for place, needed in changes.items():
        put(before, place, needed)
    if step := re.fullmatch(r"(.*processing)\[(.*?)\]\.(.*)", path):
        put(before, step[1], [{"step": step[2], **STEPS[step[2]]}])
        path = f"{step[1]}[0].{step[3]}"
    after = copy.deepcopy(before)
    put(after, path, other(path, field, plane_case(before)) if value is None else value)
    return before, after, path


def put(fields: Fields, path: str, value: Any) -> None:
    """Set a field, or take it out."""
    *way, last = re.sub(r"\[(\d+)\]", r".\1", path).split(".")
    block: Any = fields
    for name in way:
        block = block[int(name)] if name.isdigit() else block.setdefault(name, {})
    if value is GONE:
        block.pop(last, None)
    else:
        block[last] = copy.deepcopy(value)


def other(path: str, field: FieldInfo, case: Case) -> Any:
    """Return another value of the same kind as the one in a case."""
    written: Any = case.model_dump(mode="json")
    for name in re.sub(r"\[(\d+)\]", r".\1", path).split("."):
        written = written[int(name)] if name.isdigit() else written[name]
    choices = _choices(field.annotation)
    if choices:
        return next(choice for choice in choices if choice != written)
    if isinstance(written, bool):
        return not written
    if isinstance(written, int):
        return written + 1
    if isinstance(written, float):
        return written * 1.1 if written else 0.1
    assert isinstance(written, str), f"{path} has no value to change: give one in HELPED of tests/shared/every_field.py"
    number = _NUMBER.match(written)
    assert number, path
    return f"{float(number[0]) * 1.1!r}{written[number.end() :]}"


def _choices(annotation: Any) -> tuple[Any, ...]:
    if typing.get_origin(annotation) is Literal:
        return typing.get_args(annotation)
    if isinstance(annotation, types.UnionType) or typing.get_origin(annotation) is typing.Annotated:
        return next((choices for kind in typing.get_args(annotation) if (choices := _choices(kind))), ())
    return ()
