"""Where the documentation explains a name: the page, and its heading or the number of the equation on it.

A field has precedence over its block. tests/docs/test_explained.py checks that every place exists.
"""

from __future__ import annotations

_PAGES = {
    # fields of a case
    "section": "sections.md#the-section",
    "anchors": "sections.md#anchors",
    "anchors.capacity": "flexible.md equation 10",
    "anchors.axial_stiffness": "flexible.md equation 10",
    "anchors.shear_stiffness": "flexible.md equation 10",
    "concrete.modulus": "runs.md#which-model-is-run",
    "concrete.damping": "flexible.md#damping",
    "concrete.tensile_strength": "flexible.md equation 7a",
    "concrete.dynamic_tension": "flexible.md equation 7a",
    "crack.friction": "rigid.md equation 5",
    "crack.static_friction": "rigid.md equation 5",
    "crack.kinetic_friction": "rigid.md equation 5",
    "crack.restitution": "rigid.md#impact",
    "crack.law": "friction.md",
    "crack.fit": "friction.md#a-band-of-frictions",
    "crack.bond": "joint-that-cracks.md",
    "joints": "joint-that-cracks.md",
    "crack.roughness": "rough-crack.md",
    "crack.elevation": "sections.md",
    "reservoir": "flexible.md equation 1",
    "tailwater": "flexible.md equation 1",
    "reservoir.virtual_mass_rotates": "rigid.md equation 6a",
    "tailwater.virtual_mass_rotates": "rigid.md equation 6a",
    "reservoir.hydrodynamic": "statics.md#hydrodynamic-pressure",
    "tailwater.hydrodynamic": "statics.md#hydrodynamic-pressure",
    **dict.fromkeys(
        (
            f"{side}.{name}"
            for side in ("reservoir", "tailwater")
            for name in ("compressible", "wave_speed", "floor_reflection")
        ),
        "water-and-rock.md",
    ),
    "rock": "water-and-rock.md",
    "reservoir.nappe": "statics.md#water-above-the-crest",
    "uplift": "statics.md#forces",
    "uplift.drain_x": "sections.md#drains",
    "uplift.drain_position": "sections.md#drains",
    "uplift.drain_efficiency": "sections.md#drains",
    "uplift.during_shaking": "flexible.md#water-in-the-crack-that-opens",
    "uplift.opening": "flexible.md#water-in-the-crack-that-opens",
    "motion": "howto/record.md",
    "motion.at": "water-and-rock.md#free-field-formulation",
    "statics.closed_drains": "statics.md#post-seismic",
    "motion.cross_valley": "cross-valley.md",
    "motion.azimuth": "cross-valley.md#the-stream-between-two-components",
    "motion.direction": "cross-valley.md#the-stream-between-two-components",
    "crack.side_gap": "cross-valley.md#neighbours",
    "aftershocks": "sequence.md",
    "motions": "suites.md",
    "flexible": "flexible.md#bodies",
    "flexible.damping": "flexible.md equation 2a",
    "flexible.damping_on_water": "flexible.md equation 2a",
    "flexible.contact": "flexible.md equation 5",
    "flexible.theta": "flexible.md equation 3",
    "flexible.time_step": "flexible.md#step-and-evidence",
    "flexible.evidence": "flexible.md#step-and-evidence",
    "flexible.elements_across": "flexible.md#step-and-evidence",
    "flexible.modes": "flexible.md equation 2",
    "flexible.virtual_mass": "flexible.md equation 1",
    "flexible.penalty_factor": "flexible.md equation 8",
    "flexible.newmark_gamma": "flexible.md equation 8",
    "flexible.newmark_beta": "flexible.md equation 8",
    "analysis.silence": "runs.md#the-end-of-a-run",
    "analysis.paradox": "rigid.md#events",
    "analysis.rotation": "rigid.md equation 6",
    "decoupled": "decoupled.md#theory",
    "decoupled.upper_part": "decoupled.md equation 2",
    "statics": "statics.md",
    "statics.criteria": "statics.md#criteria",
    "statics.sections": "statics.md#many-sections",
    "statics.cohesion": "statics.md equation 2",
    "statics.tensile_strength": "statics.md equation 6",
    "statics.drain_diameter": "statics.md equation 8",
    "limits": "report.md",
    "project": "report.md",
    # fields of a study
    "study case": "studies.md#the-study-file",
    "study model": "studies.md#the-study-file",
    "study method": "studies.md#the-study-file",
    "study samples": "studies.md#the-study-file",
    "study seed": "studies.md#the-study-file",
    "study vary": "studies.md#the-study-file",
    "study correlation": "studies.md#the-study-file",
    "study motions": "studies.md#the-study-file",
    "study fragility": "studies.md#fragility",
    "study suite": "suites.md",
    "study hazard": "studies.md equation 1",
    "study cases": "studies.md#a-table-of-dams",
    # keys of the JSON
    "suite": "suites.md",
    "hazard": "studies.md equation 1",
    "portfolio": "studies.md#a-table-of-dams",
    "critical_acceleration_g": "rigid.md#equations-of-motion",
    "cross_valley": "cross-valley.md#results",
    "energy": "rigid.md equation 7",
    "damping_ratios": "flexible.md#damping",
    "evidence": "flexible.md#step-and-evidence",
    "self_excitation": "sliding-that-feeds-itself.md",
    "tension": "flexible.md equation 7a",
    "crack_level": "decoupled.md equation 6",
    "crack_level.spectrum": "decoupled.md equation 7",
    "sequence": "sequence.md#results",
    "drainage_by_motion": "sequence.md#drains-that-slip-closes",
    "silence_s": "runs.md#the-end-of-a-run",
    "before_shaking": "flexible.md equation 1a",
    "elastic_give": "flexible.md#motion-of-the-dam",
    "warnings": "report.md#numbers",
    "cases": "statics.md#load-cases",
    "cases.sliding_factor": "statics.md equation 2",
    "cases.overturning_factor": "statics.md equation 3",
    "cases.flotation_factor": "statics.md equation 4",
    "cases.heel_stress_pa": "statics.md equation 5",
    "cases.toe_stress_pa": "statics.md equation 5",
    "checks": "statics.md#criteria",
}


def page_of(name: str, kind: str) -> str:
    """Return the place in the documentation that explains a name; empty if no page does."""
    path = name.replace("[]", "").partition("[")[0]
    study = "study " if kind == "field of a study" else ""
    while path and study + path not in _PAGES:
        path = path.rpartition(".")[0]
    return _PAGES.get(study + path, "")


def pages() -> frozenset[str]:
    """Return all places of the table."""
    return frozenset(_PAGES.values())
