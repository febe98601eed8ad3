"""The reference cases by name, with what each declares: of blocks, of dams in earthquakes, of the static checks."""

from __future__ import annotations

import math
import sys

from heeltoe.mechanics.references import REFERENCES
from validation import (
    evidence,
    flexible_dams,
    koyna,
    loads,
    penalty,
    textbook_walls,
    textbooks,
    thesis_dams,
)
from validation.blocks import (
    closed_forms,
    elastic_bar,
    elastic_cracks,
    flexible_blocks,
    friction_laws,
    granite,
    joints,
    rough_blocks,
    sliding_spectra,
    thesis_blocks,
    turning,
)
from validation.declared import Chart, Declared
from validation.row import Row

_EXACT = "Exact from event to event."
_INTEGRATED = "Exact where the law is a straight line over its path; else an error of 1e-12 in a step."
_SMOOTH = "Nothing here strikes or is at a threshold: ours moves as the shaking does."
_ONE_PER_CENT = "99 to 101 % of the shaking stands beside it."
_PULSE = "The pulse is a formula."
_TWO_PROTOTYPES = "Two independent programs made after the thesis: exact events, and Moreau and Jean's scheme in 20 µs"
_HALF = "Half the step stands beside it; the case `halving` has the mesh."
_PROTOTYPE = "an independent program made after it"
# What other arithmetic has been seen to move, and some more: of slips of cracks at the base,
# of the stiffest dams among them, and at a height, and of a block that strikes without damping.
_BASE_STEADY, _STIFF_STEADY, _HIGH_STEADY = 0.01, 0.06, 0.02
_PULLED = "Nothing shakes: springs draw the ends apart slowly."
_CHAPTER_7 = f"{REFERENCES['flexible']}"
_BY_DEPTH = Chart(r"(?P<series>friction [\d.]+), water (?P<x>[\d.]+) m", "depth of water [m]", "slip [mm]", "y")
_SUMS = "Sums and integrals in closed form."
_STILL = "Nothing shakes."
_PUNMIA = (
    "B. C. Punmia, B. B. Lal, A. K. Jain and A. K. Jain, Irrigation and Water Power Engineering, chapter 8, by the "
    "public programs of its worked examples (FOSSEE, Scilab textbook companion 2087)"
)

CASES: dict[str, Declared] = {
    "impulse": Declared(
        thesis_blocks.impulse,
        ("rigid",),
        f"{REFERENCES['rigid']}: the printed parabolas",
        _EXACT,
        _PULSE,
        history=thesis_blocks.impulse_response,
    ),
    "sine": Declared(
        thesis_blocks.sine,
        ("rigid",),
        f"{REFERENCES['rigid']}: the printed times",
        "Exact from event to event; the sine is sampled every 10 µs.",
        _PULSE,
        Chart(r"zero velocity (?P<x>\d+)", "number of the zero", "time [s]"),
    ),
    "push-and-sine": Declared(
        closed_forms.push_and_sine,
        ("rigid",),
        "Integrals of sines and constants between stops, summed in wider numbers",
        "Exact from event to event; the rows show how the sampling of the sine converges.",
        _PULSE,
        Chart(r"sampled every (?P<x>\S+) s", "sampling of the sine [s]", "slip [m]", log="x"),
    ),
    "pulse": Declared(
        closed_forms.pulse,
        ("rigid",),
        'N. M. Newmark, "Effects of earthquakes on dams and embankments", Géotechnique 15 (1965), 139-160',
        _EXACT,
        _PULSE,
    ),
    "weakening-slider": Declared(
        friction_laws.weakening_slider,
        ("rigid",),
        f"Closed forms; {REFERENCES['law: slip weakening']}; N. M. Newmark, Géotechnique 15 (1965), 139-160",
        _INTEGRATED,
        _PULSE,
    ),
    "barton-bandis": Declared(
        friction_laws.barton_bandis,
        ("rigid",),
        f"{REFERENCES['law: barton-bandis']}; N. M. Newmark, Géotechnique 15 (1965), 139-160; M. Garnier Villarreal, "
        "GMisc 0.3.1, the example of Barton_Choubey in its manual (github.com/maxgav13/GMisc)",
        _INTEGRATED,
        _PULSE,
    ),
    "laws-to-coulomb": Declared(
        friction_laws.laws_to_coulomb,
        ("rigid",),
        "The exact walk with a constant coefficient; an independent program of small steps",
        _INTEGRATED,
        "The motion is given by its formula.",
        long=True,
    ),
    "rough-crack": Declared(
        rough_blocks.rough_crack,
        ("rigid",),
        f"Closed forms; {REFERENCES['rough crack']}; {REFERENCES['wear']}",
        "Integrated, with an error of 1e-12 in a step.",
        _PULSE,
    ),
    "two-blocks": Declared(
        rough_blocks.two_blocks,
        ("rigid",),
        "N. M. Newmark, Géotechnique 15 (1965), 139-160; Siconos 4.4.0",
        _EXACT,
        _PULSE,
    ),
    "kinked-crack": Declared(
        elastic_cracks.kinked_crack,
        ("flexible",),
        "Closed forms: a point on a slope, balance of forces",
        "Towards the rigid block with the modulus; docs/kinks.md refines a dam.",
        _SMOOTH,
        long=True,
    ),
    "several-cracks": Declared(
        elastic_cracks.several_cracks,
        ("flexible",),
        "Two rigid blocks, exact from event to event; the neck of the same dam alone",
        "Towards the rigid blocks with the modulus; docs/several-cracks.md refines mesh and step.",
        _SMOOTH,
        long=True,
    ),
    "flexible-laws": Declared(
        elastic_cracks.flexible_laws,
        ("flexible",),
        "The rigid block with the same law; the elastic dam with a constant coefficient",
        "Towards the rigid block with the modulus.",
        _SMOOTH,
        long=True,
    ),
    "bonded-bar": Declared(
        joints.bonded_bar,
        ("flexible",),
        "Closed forms: a bar that softens in one place",
        "With the speed of the pull, to the closed forms: inertia and damping are what is left.",
        _PULLED,
    ),
    "bonded-cantilevers": Declared(
        joints.bonded_cantilevers,
        ("flexible",),
        "The J integral: P. C. Paris and A. J. Paris, International Journal of Fracture 38 (1988), R19-R21",
        "Two meshes stand in the rows.",
        _PULLED,
    ),
    "notched-beam": Declared(
        joints.notched_beam,
        ("flexible",),
        "D. Grégoire, L. B. Rojas-Solano and G. Pijaudier-Cabot, International Journal for Numerical and Analytical "
        "Methods in Geomechanics 37 (2013), 1434-1452, beam 4, by the data of pypd (github.com/mark-hobbs/pypd)",
        "16 elements along the depth; with 32 the forces change by 2 %.",
        _PULLED,
    ),
    "sequence": Declared(
        friction_laws.sequence,
        ("rigid",),
        "N. M. Newmark, Géotechnique 15 (1965), 139-160; each motion alone",
        _EXACT,
        _PULSE,
    ),
    "free-rocking": Declared(
        closed_forms.free_rocking,
        ("rigid",),
        f"{REFERENCES['rocking']}, for small rotations",
        _EXACT,
        "Nothing shakes.",
        Chart(r"peak (?P<x>\d+)", "number of the peak", "rotation [slendernesses]"),
    ),
    "finite-rocking": Declared(
        turning.free_finite_rocking,
        ("rigid",),
        f"{REFERENCES['rocking']}: an integral of its energy at rotations of any size, in wider numbers",
        "Integrated with an error of 1e-12 of the motion in every step.",
        "Nothing shakes.",
    ),
    "measured-impacts": Declared(
        turning.measured_impacts,
        ("rigid",),
        "M. A. ElGawady, Q. Ma, J. W. Butterworth and J. M. Ingham, Effects of interface material on the dynamic "
        "behaviour of rigid blocks, doi 10.1201/9781003060888-45: measured, free rocking of concrete on concrete",
        "Integrated with an error of 1e-12 of the motion in every step.",
        "Nothing shakes.",
    ),
    "granite-stones": Declared(
        granite.stones,
        ("rigid",),
        "The repository ZhiangChen/virtual_shake_robot_pybullet, commit 9f239e7: measured, two granite stones on a "
        "shaking table, and discrete elements of its owners",
        "Exact from event to event; samples of the table are means of 5 ms.",
        "The even runs choose the width, the odd ones judge.",
        records=True,
        long=True,
        # With the records that are missing here there are others.
        steady=math.inf,
    ),
    "overturning": Declared(
        turning.overturning_pulses,
        ("rigid",),
        f"{REFERENCES['overturning']}: the conditions of overturning without impact, solved in wider numbers",
        "Integrated with an error of 1e-12; the pulse is sampled in 4000 parts.",
        "The least amplitude itself is what is found.",
        Chart(
            r"(?P<series>\w+ sine), w/p = (?P<x>\d)",
            "circular frequency of the pulse over p",
            "least amplitude over alpha g",
        ),
    ),
    "overturning-after-impact": Declared(
        turning.overturning_after_impact,
        ("rigid",),
        f"{REFERENCES['overturning']}; {REFERENCES['rocking']}",
        "Integrated with an error of 1e-12; the pulse is sampled in 4000 parts.",
        "The amplitudes themselves are what is found.",
        Chart(r"(?P<series>\w+), w/p = (?P<x>\d)", "circular frequency of the pulse over p", "amplitude over alpha g"),
    ),
    "lixouri": Declared(
        sliding_spectra.lixouri,
        ("rigid",),
        'G. Papazafeiropoulos and V. Plevris, "OpenSeismoMatlab: New features, verification and charting future '
        'endeavors", Buildings 14 (2024), 304, and the published output of its verification SRS1, made after E. Garini '
        "and G. Gazetas, Rocking and sliding potential of the 2014 Cephalonia, Greece, earthquakes, ICONHIC 2016",
        _EXACT,
        _ONE_PER_CENT,
        Chart(r"(?P<series>[\w-]+), friction (?P<x>[\d.]+)", "friction", "greatest slip [m]"),
        records=True,
    ),
    "slammer": Declared(
        sliding_spectra.slammer,
        ("rigid",),
        "R. W. Jibson, E. M. Rathje, M. W. Jibson and Y. W. Lee, SLAMMER, version 1.1, US Geological Survey Techniques "
        "and Methods 12-B1, 2013; its results as the verification of pySLAMMER publishes them (2026)",
        _EXACT,
        _ONE_PER_CENT,
        records=True,
    ),
    "drifting": Declared(
        thesis_blocks.drifting,
        ("rigid",),
        _TWO_PROTOTYPES,
        _EXACT,
        _PULSE,
        history=thesis_blocks.drifting_response,
    ),
    "dry-block": Declared(thesis_blocks.dry_block, ("rigid",), _TWO_PROTOTYPES, _EXACT, _PULSE),
    "bouncing-bar": Declared(
        elastic_bar.bouncing_bar,
        ("flexible",),
        'D. Doyen, A. Ern and S. Piperno, "Time-integration schemes for the finite element dynamic Signorini problem", '
        "SIAM Journal on Scientific Computing 33 (2011), 223-249",
        "The same bar with half and with twice the step.",
        "Nothing shakes.",
    ),
    "elastic-impulse": Declared(
        flexible_blocks.elastic_impulse,
        ("flexible",),
        f"{REFERENCES['flexible']}, section 6.5.1; an independent program made after it",
        "Towards the rigid block with the modulus; steps of 0.05 ms.",
        _SMOOTH,
        long=True,
    ),
    "elastic-sliding": Declared(
        flexible_blocks.elastic_sliding,
        ("flexible",),
        "The exact slip of the rigid block; independent programs, one with Siconos and one with OpenSees",
        "By design: ours is judged by the rigid limit, which it must come to.",
        _SMOOTH,
        long=True,
    ),
    "elastic-rocking": Declared(
        flexible_blocks.elastic_rocking,
        ("flexible",),
        f"{REFERENCES['rocking']}; {REFERENCES['flexible']}, section 6.5.2",
        "Two meshes without damping: the first peak agrees, the second is chaotic.",
        "Nothing shakes.",
        long=True,
        steady=_HIGH_STEADY,
    ),
    "contactors": Declared(
        flexible_blocks.contactors,
        ("flexible",),
        f"{REFERENCES['flexible']}, section 6.5.3: five kinds of contactors",
        "Kinds of contactors against each other.",
        _PULSE,
        long=True,
    ),
    "triangular": Declared(
        thesis_dams.triangular,
        ("rigid",),
        f'{REFERENCES["rigid"]}, after A. K. Chopra and L. Zhang, "Earthquake-induced base sliding of concrete gravity '
        'dams", Journal of Structural Engineering, ASCE 117 (1991), 3698-3719; '
        f"{_PROTOTYPE}",
        _EXACT,
        "Chaotic numbers are judged by their spread under 99 to 101 % of the shaking.",
        history=thesis_dams.triangular_response,
        records=True,
    ),
    "table-7.6-taft": Declared(
        thesis_dams.taft,
        ("rigid",),
        f"{_CHAPTER_7}, table 7.6, Taft; {_PROTOTYPE}",
        _EXACT,
        _ONE_PER_CENT,
        _BY_DEPTH,
        history=thesis_dams.typical_response,
        records=True,
    ),
    "table-7.6-el-centro": Declared(
        thesis_dams.el_centro,
        ("rigid",),
        f"{_CHAPTER_7}, table 7.6, El Centro",
        _EXACT,
        "Four versions of one record stand beside each other, which is more than 1 % of shaking.",
        Chart(
            r"(?P<series>friction [\d.]+), water (?P<x>[\d.]+) m",
            "depth of water [m]",
            "slip [mm]",
            "y",
            panels=(("Caltech", "caltech"), ("PEER 1999", "peer1999"), ("Peknold", "peknold"), ("NGA", "nga2")),
        ),
        records=True,
    ),
    "koyna-chain": Declared(
        koyna.koyna_chain,
        ("decoupled",),
        f"{REFERENCES['decoupled']}; an independent program made after it. The slips of the thesis belong to the "
        "record of 1967",
        "The motion at the crack is exact for straight pieces of the record, and so is the block.",
        "A dam that bounces differs by some millimetres between two programs.",
        long=True,
        records=True,
    ),
    "periods": Declared(
        flexible_dams.periods,
        ("flexible",),
        f"{_CHAPTER_7}",
        "Eight elements across; rows say what sixteen change.",
        "Nothing shakes.",
        Chart(r"(?P<series>[\w ]+), period (?P<x>\d)", "mode", "period [s]"),
    ),
    "table-7.1": Declared(
        flexible_dams.table_7_1,
        ("flexible",),
        f"{_CHAPTER_7}, table 7.1; {_PROTOTYPE}",
        _HALF,
        _ONE_PER_CENT,
        Chart(r"(?P<x>[\d.]+) GPa: slip", "modulus [GPa]", "slip [mm]", log="x"),
        long=True,
        records=True,
        steady=_BASE_STEADY,
    ),
    "table-7.7": Declared(
        flexible_dams.table_7_7,
        ("flexible",),
        f"{_CHAPTER_7}, table 7.7; {_PROTOTYPE}",
        _HALF,
        _ONE_PER_CENT,
        Chart(r"(?P<series>friction [\d.]+), water (?P<x>[\d.]+) m: slip", "depth of water [m]", "slip [mm]", "y"),
        long=True,
        records=True,
        steady=_BASE_STEADY,
    ),
    "table-7.8": Declared(
        flexible_dams.table_7_8,
        ("flexible",),
        f"{_CHAPTER_7}, table 7.8; {_PROTOTYPE}",
        _HALF,
        _ONE_PER_CENT,
        Chart(r"^(?P<x>[\d.]+) GPa: slip", "modulus [GPa]", "slip [mm]", log="x"),
        long=True,
        records=True,
        steady=_STIFF_STEADY,
    ),
    "table-7.10": Declared(
        flexible_dams.table_7_10,
        ("flexible",),
        f"{_CHAPTER_7}, table 7.10; {_PROTOTYPE}",
        _HALF,
        _ONE_PER_CENT,
        _BY_DEPTH,
        long=True,
        records=True,
        steady=_HIGH_STEADY,
    ),
    "damping": Declared(
        flexible_dams.damping,
        ("flexible",),
        f"An independent program with full matrices and no modes, made after {_CHAPTER_7}",
        _HALF,
        _ONE_PER_CENT,
        long=True,
        records=True,
        steady=_BASE_STEADY,
    ),
    "halving": Declared(
        flexible_dams.halving,
        ("flexible",),
        "Ours with twice the step and with twice the elements",
        "This is what the case is for.",
        "Where a single run says little about the mesh its remark has the spread.",
        long=True,
        records=True,
        steady=_HIGH_STEADY,
    ),
    "evidence": Declared(
        evidence.evidence,
        ("flexible",),
        "Ours with twice the elements and a quarter of the step",
        "This is what the case is for.",
        "The program's own uncertainty, which contains it, is what is judged.",
        long=True,
    ),
    "penalty": Declared(
        penalty.penalty,
        ("flexible",),
        f"{REFERENCES['idce']}; ours with exact contact",
        "One step for all; the case `halving` has what it does to exact contact.",
        "Two methods meet the very same shaking.",
        Chart(
            r"gamma (?P<x>[\d.]+): slip",
            "Newmark's gamma",
            "slip [mm]",
            "y",
            panels=(("crack at the base", "base crack"), ("crack at 90 m", "crack at 90 m")),
        ),
        long=True,
        records=True,
        steady=math.inf,
    ),
    "punmia-walls": Declared(textbooks.punmia_walls, ("statics",), _PUNMIA, _SUMS, _STILL),
    "punmia-dams": Declared(textbooks.punmia_dams, ("statics",), _PUNMIA, _SUMS, _STILL),
    "water": Declared(loads.water, ("rigid", "statics"), f"Integrals; {REFERENCES['water']}", _SUMS, _STILL),
    "rest-ends": Declared(
        loads.rest_ends,
        ("rigid",),
        f"{REFERENCES['rigid']}, section 4.3; sums by hand",
        _SUMS,
        "Ramps to a thousandth below and above the limit.",
    ),
    "zangar": Declared(
        textbooks.zangar_pressure, ("rigid", "statics"), f"{REFERENCES['sloped water']}; {_PUNMIA}", _SUMS, _STILL
    ),
    "elementary": Declared(
        textbooks.elementary,
        ("statics",),
        "G. L. Asawa, Irrigation and Water Resources Engineering, New Age, 2005, section 16.5; Indian Agricultural "
        "Statistics Research Institute, stability analysis of gravity dams, lesson 32; a lecture, Determination of "
        "forces in dam",
        _SUMS,
        _STILL,
    ),
    "sarkar": Declared(
        textbook_walls.sarkar,
        ("statics",),
        "B. K. Sarkar, Strength of Materials, chapter 14, by the public programs of its worked examples (FOSSEE, "
        "Scilab textbook companion 3772)",
        _SUMS,
        _STILL,
    ),
}


def wanted(names: list[str]) -> list[str]:
    """Return names of reference cases; exit with an error where there is no such case."""
    if unknown := set(names) - set(CASES):
        sys.exit(f"no reference case: {', '.join(sorted(unknown))}; there are {', '.join(CASES)}")
    return names


def run_case(name: str) -> list[Row]:
    """Return the rows of one case.

    Raises
    ------
    KeyError
        Where there is no case of that name.
    Skipped
        Where a record it needs is not there.
    """
    return list(CASES[name].rows())
