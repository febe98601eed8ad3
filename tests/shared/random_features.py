"""Random cases over every field and every feature: what a user may combine, sensible values beside absurd ones."""

from __future__ import annotations

import copy
import math
import random
import re
from collections.abc import Callable
from typing import Any

from pydantic.fields import FieldInfo

from heeltoe import InputError
from shared.dams import plane_case
from shared.every_field import GONE, Fields, leaves, pair, put

#: Fields whose value is the place of a file, and those that the attack sets itself.
_NOT_DRAWN = re.compile(
    r"title|.*\.(file|layer|channel|unit|mesh_above|mesh_below|criteria_file|event_limit|time_limit|memory_limit)"
    r"|section\..*|motion\.(vertical\.)?(points|pga|time_step|layout|factor|allow_zero|duration)"
)
_NUMBER = re.compile(r"-?\d+(?:\.\d*)?(?:e[+-]?\d+)?")
LAWS: tuple[Fields, ...] = (
    {"name": "slip weakening", "peak_friction": 1.0, "residual_friction": 0.6, "slip": "20 mm"},
    {"name": "slip weakening", "form": "exponential", "peak_friction": 1.0, "residual_friction": 0.6, "slip": "5 mm"},
    {"name": "speed weakening", "peak_friction": 1.0, "residual_friction": 0.6, "speed": "0.1 m/s"},
    {"name": "cohesion", "residual_friction": 0.6, "cohesion": "80 kPa"},
    {"name": "barton-bandis", "jrc": 8, "jcs": "10 MPa", "residual_angle": "28 deg"},
    {
        "name": "lift joint",
        "surface": "untreated",
        "basic_friction": 0.6,
        "roughness_friction": [["0.1 MPa", 0.2], ["2 MPa", 0.1]],
    },
)
MODELS = ("rigid", "decoupled", "flexible", "both", "auto", "statics")


def random_case(draw: random.Random) -> tuple[str, Fields]:
    """Return a model and the fields of a case for it, the same for a generator in the same state."""
    height = math.exp(draw.uniform(math.log(6.0), math.log(150.0)))
    fields = _dam(draw, height)
    width = height * 0.6
    # Three of four users take back what was refused, so that their cases run with many features.
    careful = draw.random() < 0.75
    features = draw.sample(_FEATURES, draw.choice((1, 2, 3, 5, 8)))
    if draw.random() < _HEAVY_SHARE:
        features.append(draw.choice(_HEAVY))
    for feature in features:
        fields = _with(fields, careful, lambda tried, made=feature: _put_all(tried, made(draw, height, width)))
    for _ in range(draw.choice((0, 0, 1, 2, 4))):
        fields = _with(fields, careful, lambda tried: _change_a_field(draw, tried))
    return draw.choice(MODELS), fields


def _with(fields: Fields, careful: bool, change: Callable[[Fields], None]) -> Fields:
    """Return fields with a change, or without where a careful user is refused."""
    tried = copy.deepcopy(fields)
    change(tried)
    if careful:
        try:
            plane_case(tried)
        except InputError:
            return fields
    return tried


def _put_all(fields: Fields, changes: Fields) -> None:
    for path, value in changes.items():
        put(fields, path, value)


def _dam(draw: random.Random, height: float) -> Fields:
    width, crest = height * draw.uniform(0.4, 1.1), height * draw.uniform(0.04, 0.15)
    neck = height * draw.uniform(0.6, 0.95)
    section: Fields = draw.choice(
        (
            {"height": _m(height), "crest_width": _m(crest), "base_width": _m(width)},
            {
                "height": _m(height),
                "crest_width": _m(crest),
                "neck_height": _m(neck),
                "neck_width": _m(crest * draw.uniform(1.0, 1.5)),
                "base_width": _m(width),
            },
            {
                "height": _m(height),
                "crest_width": _m(crest),
                "upstream": [["0 m", draw.uniform(0.0, 0.3)], [_m(0.4 * height), 0.0]],
                "downstream": [["0 m", draw.uniform(0.5, 0.9)], [_m(0.9 * height), 0.0]],
            },
            {"polygon": [["0 m", "0 m"], [_m(width), "0 m"], [_m(crest), _m(height)], ["0 m", _m(height)]]},
        )
    )
    crack: Fields = {"elevation": _m(draw.choice((0.0, 0.0, 0.3, 0.6)) * height)}
    if draw.random() < 0.5:
        crack["friction"] = draw.uniform(0.3, 1.5)
    else:
        crack |= {"static_friction": draw.uniform(0.6, 1.4), "kinetic_friction": draw.uniform(0.2, 0.7)}
    fields: Fields = {
        "section": section,
        "concrete": {"modulus": f"{draw.uniform(5.0, 40.0)} GPa"},
        "crack": crack,
        "motion": {"points": pulse(draw)},
        "flexible": {
            "elements_across": draw.choice((1, 1, 2, 2, 3)),
            "evidence": "step" if draw.random() < _HEAVY_SHARE else "none",
        },
        "analysis": {
            "silence": draw.choice(("0 s", "0.2 s", "1 s")),
            "time_limit": "20 s" if draw.random() < _HEAVY_SHARE else "2 s",
        },
    }
    if draw.random() < 0.8:
        fields["reservoir"] = {"depth": _m(height * draw.choice((0.3, 0.7, 0.9, 1.0, 1.04)))}
    if draw.random() < 0.3:
        fields["tailwater"] = {"depth": _m(height * draw.uniform(0.05, 0.5))}
    if draw.random() < 0.4:
        fields["limits"] = {
            name: f"{10.0 ** draw.uniform(-1.0, 3.0)} mm"
            for name in ("residual_slip", "peak_slip", "opening_upstream", "opening_downstream", "cracked_length")
            if draw.random() < 0.6
        }
        more = {"rotation": "1 mrad", "crest_displacement": "5 mm", "crest_acceleration": "0.7 g"}
        fields["limits"] |= {name: value for name, value in more.items() if draw.random() < 0.3}
    return fields


def _m(value: float) -> str:
    return f"{value:.6g} m"


def pulse(draw: random.Random) -> list[list[str]]:
    """Return a short motion of random points."""
    times = sorted(draw.uniform(0.02, 0.5) for _ in range(draw.randint(2, 8)))
    peak = 10.0 ** draw.uniform(-2.0, 0.6)
    points = [["0 s", "0 g"], *([f"{time:.6f} s", f"{draw.uniform(-peak, peak):.6f} g"] for time in times)]
    return [*points, [f"{times[-1] + 0.1:.6f} s", "0 g"]]


def _steel(draw: random.Random, height: float, width: float) -> Fields:
    steel = {
        "head_x": _m(0.03 * height),
        "head_elevation": _m(height),
        "foot_x": _m(0.2 * width),
        "foot_elevation": _m(-0.3 * height),
        "prestress": f"{draw.uniform(0.0, 3.0)} MN/m",
    }
    if draw.random() < 0.5:
        steel |= {"axial_stiffness": "20 MN/m/m", "shear_stiffness": "5 MN/m/m", "capacity": "2 MN/m"}
    if draw.random() < 0.3:
        steel = {"distance": _m(0.1 * width), "inclination": f"{draw.uniform(-20, 20)} deg", "prestress": "0.4 MN/m"}
    return {"anchors": [steel] * draw.choice((1, 1, 2))}


def _cracks(draw: random.Random, height: float, width: float) -> Fields:
    cracks: list[Fields] = []
    for share in draw.choice(((0.75,), (0.7,), (0.65, 0.85))):
        crack: Fields = {"elevation": _m(share * height)}
        if draw.random() < 0.5:
            crack["friction"] = draw.uniform(0.3, 1.3)
        if draw.random() < 0.3:
            crack["uplift"] = draw.choice(("none", "uniform", "triangular"))
        if draw.random() < 0.2:
            crack["kinks"] = [[_m(0.05 * height), _m(0.005 * height)]]
        if draw.random() < 0.2:
            crack["bond"] = _bond(draw)
        if draw.random() < 0.2:
            crack["law"] = draw.choice(LAWS)
            crack.pop("friction", None)
        if draw.random() < 0.3:
            crack["inclination"] = f"{draw.uniform(-8, 8)} deg"
        cracks.append(crack)
    return {"further_cracks": cracks}


def _bond(draw: random.Random) -> Fields:
    strength = 10.0 ** draw.uniform(-2.0, 0.5)
    return {
        "tensile_strength": f"{strength} MPa",
        "cohesion": f"{strength * draw.uniform(1.0, 4.0)} MPa",
        "fracture_energy": f"{10.0 ** draw.uniform(1.0, 3.0)} N/m",
        "shear_energy": f"{10.0 ** draw.uniform(1.0, 3.5)} N/m",
    }


def _law(draw: random.Random, height: float, width: float) -> Fields:
    friction = ("friction", "static_friction", "kinetic_friction")
    return {f"crack.{name}": GONE for name in friction} | {"crack.law": draw.choice(LAWS)}


def _uplift(draw: random.Random, height: float, width: float) -> Fields:
    drained = {
        "pattern": "drained",
        "drain_position": draw.uniform(0.02, 0.4),
        "drain_efficiency": draw.uniform(0.0, 1.0),
    }
    profile = {"pattern": "profile", "points": [[0.0, _m(0.7 * height)], [0.4, _m(0.3 * height)], [1.0, "0 m"]]}
    plain = {"pattern": draw.choice(("none", "uniform", "triangular")), "intensity": draw.choice((0.5, 1.0, 1.3))}
    uplift: Fields = draw.choice((drained, profile, plain, {"pattern": "cut-off", "extent": draw.uniform(0.1, 0.9)}))
    if draw.random() < 0.4:
        uplift |= {"during_shaking": draw.choice(("zero while open", "full while open"))}
    fields: Fields = {"uplift": uplift}
    if uplift["pattern"] == "drained" and draw.random() < 0.4:
        fields["statics.drain_diameter"] = "75 mm"
    return fields


def _statics(draw: random.Random, height: float, width: float) -> Fields:
    choice: Fields = {
        "criteria": draw.choice(("USACE", "USBR", "FERC", "CDA", "CADAM3D")),
        "structure": draw.choice(("critical", "normal")),
        "site_information": draw.choice(("well defined", "ordinary", "limited")),
        "bonded": draw.choice((0.0, 0.3, 1.0)),
        "tensile_strength": draw.choice(("0 MPa", "0.1 MPa", "2 MPa")),
        "cohesion": draw.choice(("0 MPa", "0.3 MPa")),
    }
    more: Fields = {
        "flood_depth": _m(height * draw.uniform(0.9, 1.1)),
        "seismic_coefficient": draw.uniform(0.02, 0.5),
        "compressive_strength": "20 MPa",
        "residual_slip": f"{draw.uniform(0.0, 900.0)} mm",
        "residual_friction": draw.uniform(0.3, 1.0),
        "sections": [{"elevation": _m(0.4 * height), "friction": 0.8}],
    }
    choice |= {name: value for name, value in more.items() if draw.random() < 0.5}
    if "seismic_coefficient" in choice and draw.random() < 0.5:
        choice["vertical_seismic_coefficient"] = draw.uniform(0.0, 0.3)
        choice["uplift_in_earthquake"] = draw.choice(("criteria", "unchanged", "zero", "full"))
    return {"statics": choice}


_FEATURES = (
    _steel,
    _cracks,
    _law,
    _uplift,
    _uplift,
    _statics,
    _statics,
    lambda draw, height, width: {"crack.bond": _bond(draw)},
    lambda draw, height, width: {"crack.kinks": [[_m(0.3 * width), _m(draw.choice((0.0, 0.02, 0.05)) * height)]]},
    lambda draw, height, width: {
        "crack.roughness": {
            "asperity_height": "2 mm",
            "wave_length": "50 mm",
            "wear": draw.choice(("0 m^2/J", "1e-5 m^2/J")),
        }
    },
    lambda draw, height, width: {"crack.inclination": f"{draw.uniform(-12, 12)} deg"},
    lambda draw, height, width: {"aftershocks": [{"points": pulse(draw), "pause": "0.2 s"}]},
    lambda draw, height, width: {"motion.vertical": {"points": pulse(draw)}},
    lambda draw, height, width: {"analysis.rotation": draw.choice(("p-delta", "finite"))},
    lambda draw, height, width: {"flexible.contact": "idce", "flexible.damping": "stiffness"},
    lambda draw, height, width: {
        "flexible.damping": draw.choice(("relative", "stiffness", "modal", "thesis", "deformation"))
    },
    lambda draw, height, width: {"flexible.virtual_mass": "thesis"},
    lambda draw, height, width: {"flexible.contactors": draw.randint(1, 5)},
    lambda draw, height, width: {"reservoir": {"depth": _m(0.8 * height), "hydrodynamic": "zangar"}},
    lambda draw, height, width: {"reservoir": {"depth": _m(0.8 * height), "virtual_mass_rotates": False}},
    lambda draw, height, width: {
        "reservoir": {"depth": _m(0.8 * height), "follows_vertical_motion": True},
        "motion.vertical": {"points": pulse(draw)},
    },
    lambda draw, height, width: {"ice": {"force": "100 kN/m"}, "silt": {"depth": _m(0.3 * height)}},
    lambda draw, height, width: {"concrete.tensile_strength": f"{draw.uniform(0.05, 3.0)} MPa"},
    lambda draw, height, width: {"decoupled": {"vertical": True, "rotation": draw.random() < 0.5}},
)
#: Features that take ten times as long as others, and the share of cases that have one, refine their step, or may
#: take longer than most.
_HEAVY = (
    lambda draw, height, width: {"reservoir": {"depth": _m(0.8 * height), "compressible": True}},
    lambda draw, height, width: {"rock": {"modulus": f"{draw.uniform(2, 60):.3g} GPa"}},
)
_HEAVY_SHARE = 0.06


def _leaves() -> dict[str, FieldInfo]:
    return {path: field for path, field in leaves() if not _NOT_DRAWN.fullmatch(path)}


_LEAVES = _leaves()
_PATHS = tuple(_LEAVES)
_KNOWN: dict[str, tuple[Fields, str]] = {}


def _change_a_field(draw: random.Random, fields: Fields) -> None:
    """Give a field another value: that of the tests of every field, and where it is a number, times anything."""
    path = draw.choice(_PATHS)
    if path not in _KNOWN:
        try:
            _, after, written = pair(path, _LEAVES[path], {})
        except InputError:  # a field that stands only beside what is drawn elsewhere
            return
        _KNOWN[path] = after, written
    after, written = _KNOWN[path]
    *_, value = _walk(after, written)
    factor = draw.choice((1.0, 1.0, 0.5, 2.0, 0.0, -1.0, 10.0 ** draw.uniform(-4.0, 4.0)))
    if isinstance(value, float):
        value *= factor
    elif isinstance(value, str) and (number := _NUMBER.match(value)):
        value = f"{float(number[0]) * factor!r}{value[number.end() :]}"
    if listed := re.fullmatch(r"(motion.*processing)\[0\]\..*", written):
        try:
            put(fields, listed[1], _walk(after, listed[1])[-1])
        except KeyError:
            return
    block = written.rpartition(".")[0]
    try:
        if not isinstance(_walk(fields, block)[-1], dict):
            return
    except (KeyError, IndexError, TypeError):
        # The block that the field is in comes with it.
        top = re.split(r"[.\[]", written)[0]
        if top not in ("motion", "section"):
            fields[top] = copy.deepcopy(after[top])
    try:
        put(fields, written, value)
    except (KeyError, IndexError, TypeError):
        return


def _walk(fields: Fields, path: str) -> list[Any]:
    values: list[Any] = [fields]
    for name in re.sub(r"\[(\d+)\]", r".\1", path).split(".") if path else ():
        values.append(values[-1][int(name)] if name.isdigit() else values[-1][name])
    return values
