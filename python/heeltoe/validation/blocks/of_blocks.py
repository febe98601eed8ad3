"""The reference cases of blocks, rigid and elastic, with what each declares."""

from __future__ import annotations

from heeltoe.references import REFERENCES
from heeltoe.validation import random_blocks
from heeltoe.validation.blocks import (
    closed_forms,
    elastic_bar,
    elastic_cracks,
    flexible_blocks,
    friction_laws,
    rough_blocks,
    sliding_spectra,
    thesis_blocks,
    turning,
)
from heeltoe.validation.chart import Chart
from heeltoe.validation.declared import Declared

_EXACT = "Exact from event to event: there is no step and no mesh."
_INTEGRATED = "Exact where the law is a straight line over its path; else integrated, with an error of 1e-12 in a step."
_SMOOTH = "Nothing here strikes or is at a threshold: ours moves as the shaking does."
_ONE_PER_CENT = "Ours under 99 % and 101 % of the shaking stands beside it."
_PULSE = "The pulse is given by its formula."
_TWO_PROTOTYPES = "Two independent programs made after the thesis: exact events, and Moreau and Jean's scheme in 20 µs"

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
        "Towards the rigid block with the modulus; docs/crack-line.md refines a dam.",
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
    ),
    "contactors": Declared(
        flexible_blocks.contactors,
        ("flexible",),
        f"{REFERENCES['flexible']}, section 6.5.3: five kinds of contactors",
        "Kinds of contactors against each other.",
        _PULSE,
        long=True,
    ),
    "random-blocks": Declared(
        random_blocks.random_blocks,
        ("rigid",),
        "Conditions that every run must meet",
        "Integrated with an error control of its own in every step.",
        "Every draw is another block and another ground.",
        long=True,
    ),
}
