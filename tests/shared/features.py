"""The features of a case, see :mod:`heeltoe.case.combinations`: what gives each of them to a plain dam."""

from __future__ import annotations

import copy

from shared.every_field import Fields, put

STEEL = {"head_x": "3 m", "head_elevation": "99 m", "foot_x": "9 m", "foot_elevation": "-9 m", "prestress": "2 MN/m"}
LAW = {"name": "slip weakening", "peak_friction": 1.1, "residual_friction": 0.9, "slip": "20 mm"}
WALLS = {"name": "barton-bandis", "jrc": 8, "jcs": "10 MPa", "residual_angle": "28 deg"}
BOND = {"name": "cohesion", "cohesion": "0.1 MPa", "residual_friction": 0.9}
JOINT = {
    "tensile_strength": "0.5 MPa",
    "cohesion": "1 MPa",
    "fracture_energy": "100 N/m",
    "shear_energy": "500 N/m",
}
# A feature, and the changes that give it to the case.
CHANGES: dict[str, Fields] = {
    "several cracks": {"further_cracks": [{"elevation": "70 m"}]},
    "three cracks": {"further_cracks": [{"elevation": "70 m"}, {"elevation": "90 m"}]},
    "kinks": {"crack.kinks": [["30 m", "0 m"]]},
    "kinks off the straight line": {"crack.kinks": [["30 m", "0.5 m"]]},
    "a measured loss of rocking": {"crack.rocking_loss": 0.05},
    "roughness": {"crack.roughness": {"asperity_height": "2 mm", "wave_length": "50 mm"}},
    "a friction law": {"crack.law": LAW},
    "a law with cohesion": {"crack.law": BOND},
    "a friction law by the normal stress": {"crack.law": WALLS},
    "a bonded joint": {"crack.bond": JOINT},
    "all nodes watched twice": {"flexible.contactors": 5},
    "cohesion of the static checks": {"statics.cohesion": "0.1 MPa", "statics.bonded": 0.5},
    "uplift that changes during shaking": {"uplift.during_shaking": "zero while open"},
    "an anchor placed on one crack": {"anchors": [{"distance": "5 m", "prestress": "1 MN/m"}]},
    "an anchor with stiffness": {"anchors": [STEEL | {"axial_stiffness": "10 MN/m/m"}]},
    "aftershocks": {"aftershocks": [{"points": [["0 s", "0 g"], ["1 s", "0.1 g"]]}]},
    "drains that slip closes": {
        "uplift.pattern": "drained",
        "uplift.drain_x": "8 m",
        "uplift.drain_efficiency": 0.5,
        "statics.drain_diameter": "75 mm",
    },
    "finite rotation": {"analysis.rotation": "finite"},
    "rotation beyond small angles": {"analysis.rotation": "p-delta"},
    "penalty contact": {"flexible.contact": "idce", "flexible.damping": "stiffness"},
    "damping of free parts": {"flexible.damping": "modal"},
    "options of the thesis": {"flexible.virtual_mass": "thesis"},
    "meshes from files": {"flexible.mesh_above": "above.msh"},
    "another number of elements below": {"flexible.elements_across_below": 5},
    "virtual water that does not rotate": {"reservoir.virtual_mass_rotates": False},
    "Zangar's water pressure": {"reservoir.hydrodynamic": "zangar"},
    "compressible water": {"reservoir.compressible": True},
    "shaking across the valley": {"motion.cross_valley": {"points": [["0 s", "0 g"], ["1 s", "0.05 g"]]}},
    "neighbours": {"crack.side_gap": "3 mm"},
    "an inclined crack": {"crack.inclination": "2 deg"},
    "elastic rock": {"rock": {"modulus": "20 GPa"}},
    "water that follows the vertical motion": {
        "reservoir.follows_vertical_motion": True,
        "motion.vertical": {"points": [["0 s", "0 g"], ["1 s", "0.05 g"]]},
    },
}
BASE: Fields = {
    "section": {"height": "100 m", "crest_width": "10 m", "base_width": "80 m"},
    "concrete": {"modulus": "20 GPa"},
    "crack": {"elevation": "20 m", "friction": 1.0},
    "reservoir": {"depth": "90 m"},
    "motion": {"points": [["0 s", "0 g"], ["1 s", "0.1 g"]]},
}


def same_field(one: str, other: str) -> bool:
    """Whether two features are values of one field, of which a case has one."""
    return bool(CHANGES[one].keys() & CHANGES[other].keys())


def changes_of(one: str, other: str) -> Fields:
    """Return the changes that give a case two features."""
    changes = CHANGES[one] | CHANGES[other]
    if {one, other} == {"damping of free parts", "penalty contact"}:
        changes["flexible.damping"] = "modal"
    return changes


def pair_fields(one: str, other: str) -> Fields:
    """Return a small dam with two features, for which any model takes a moment."""
    fields = copy.deepcopy(BASE)
    fields["motion"] = {"points": [["0 s", "0 g"], ["0.2 s", "0.4 g"], ["0.4 s", "-0.3 g"], ["0.6 s", "0 g"]]}
    fields["flexible"] = {"elements_across": 2, "evidence": "none"}
    fields["analysis"] = {"silence": "0 s"}
    for path, value in changes_of(one, other).items():
        put(fields, path, value)
    law = fields["crack"].get("law")
    if law:
        del fields["crack"]["friction"]
    return fields
