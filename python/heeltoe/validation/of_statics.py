"""The reference cases of the static checks and of the loads, with what each declares."""

from __future__ import annotations

from heeltoe.references import REFERENCES
from heeltoe.validation import loads, textbook_walls, textbooks
from heeltoe.validation.declared import Declared

_SUMS = "Sums and integrals in closed form: there is no step and no mesh."
_STILL = "Nothing shakes."
_PUNMIA = (
    "B. C. Punmia, B. B. Lal, A. K. Jain and A. K. Jain, Irrigation and Water Power Engineering, chapter 8, by the "
    "public programs of its worked examples (FOSSEE, Scilab textbook companion 2087)"
)

CASES: dict[str, Declared] = {
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
