"""The typical dam cracked at its base and at its neck, as the tests of several cracks run it."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe.case.model import Case
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake

PULSES = [
    ["0 s", "0 g"],
    ["0.15 s", "-0.6 g"],
    ["0.4 s", "0.5 g"],
    ["0.65 s", "-0.5 g"],
    ["0.9 s", "0.3 g"],
    ["1 s", "0 g"],
]
#: A dam cracked at its base and at its neck, with all modes, so that what is bonded is what was never cut.
DAM = {
    "section": {
        "height": "100 m",
        "crest_width": "8 m",
        "neck_height": "90 m",
        "neck_width": "8 m",
        "base_width": "80 m",
    },
    "concrete": {"density": "2650 kg/m^3", "modulus": "20 GPa", "poisson": 0.143},
    "crack": {"elevation": "0 m", "friction": 0.9},
    "further_cracks": [{"elevation": "90 m", "friction": 0.8}],
    "reservoir": {"depth": "100 m"},
    "motion": {"points": PULSES, "duration": "1.5 s"},
    "analysis": {"silence": "0 s"},
    "flexible": {"elements_across": 4, "modes": 5000, "damping": "stiffness", "evidence": "none"},
}
STEP = 2e-4
#: Factor on the pressure that presses the faces of a bonded crack together instead of apart.
GLUE = -300.0


def shaken(case: Case):
    """Return what each crack of a case does, from the crest down."""
    dam = ShakenDam(case, build_flexible_dam(case), earthquake(case).shaking)
    return dam.run(STEP, 0.01)


def bonded(case: Case, elevation: float) -> Case:
    """Return the case with one of its cracks bonded: its faces are pressed together by forces that its contact gives
    back, and nothing slips."""
    glue = {"uplift": "uniform", "uplift_intensity": GLUE}
    strong = {"friction": 1e3, "static_friction": None, "kinetic_friction": None}
    if case.crack.elevation == elevation:
        own = case.uplift.model_copy(update={"pattern": "uniform", "intensity": GLUE})
        others = [
            crack.model_copy(
                update={
                    "uplift": crack.uplift or case.uplift.pattern,
                    "uplift_intensity": 1.0 if crack.uplift_intensity is None else crack.uplift_intensity,
                    "friction": crack.friction or case.crack.friction,
                }
            )
            for crack in case.further_cracks
        ]
        crack = case.crack.model_copy(update=strong)
        return case.model_copy(update={"crack": crack, "uplift": own, "further_cracks": tuple(others)})
    cracks = [
        crack.model_copy(update=glue | strong) if crack.elevation == elevation else crack
        for crack in case.further_cracks
    ]
    return case.model_copy(update={"further_cracks": tuple(cracks)})


def same(one, other, width: float, within: float = 1e-6) -> None:
    """Compare what a crack does, to a millionth of how far it moves or `within` another part."""
    largest = np.abs(other.slip).max()
    for name, arm in (("slip", 1.0), ("rotation", width), ("gap_heel", 1.0), ("gap_toe", 1.0)):
        assert arm * getattr(one, name) == pytest.approx(arm * getattr(other, name), abs=within * largest), name
