"""The reference cases of dams in earthquakes, with what each declares."""

from __future__ import annotations

import math

from heeltoe.references import REFERENCES
from heeltoe.validation import evidence, flexible_dams, koyna, penalty, random_dams, thesis_dams
from heeltoe.validation.chart import Chart
from heeltoe.validation.declared import Declared

_EXACT = "Exact from event to event: there is no step and no mesh."
_HALF = "Ours with half the step stands beside it; what the mesh does to dams like these is the case `halving`."
_ONE_PER_CENT = "Ours under 99 % and 101 % of the shaking stands beside it."
_PROTOTYPE = "an independent program made after it"
# What other arithmetic has been seen to move, and some more: of slips of cracks at the base,
# of the stiffest dams among them, and at a height.
_BASE_STEADY, _STIFF_STEADY, _HIGH_STEADY = 0.01, 0.06, 0.02
_CHAPTER_7 = f"{REFERENCES['flexible']}"
_BY_DEPTH = Chart(r"(?P<series>friction [\d.]+), water (?P<x>[\d.]+) m", "depth of water [m]", "slip [mm]", "y")

CASES: dict[str, Declared] = {
    "triangular": Declared(
        thesis_dams.triangular,
        ("rigid",),
        f'{REFERENCES["rigid"]}, after A. K. Chopra and L. Zhang, "Earthquake-induced base sliding of concrete gravity '
        'dams", Journal of Structural Engineering, ASCE 117 (1991), 3698-3719; '
        f"{_PROTOTYPE}",
        _EXACT,
        "What is chaotic is judged by its spread under 99 to 101 % of the shaking.",
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
    "random-dams": Declared(
        random_dams.random_dams,
        ("flexible",),
        "Conditions that every run must meet",
        "Steps from a ten-thousandth of the first period to thirty of it are among the draws.",
        "Every draw is another dam and another ground.",
        long=True,
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
}
