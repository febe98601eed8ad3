"""The catalogue of warnings: what each says, in which units, and how it stands in the JSON."""

from __future__ import annotations

import json
import re
from string import Formatter

import pytest

from heeltoe.case.warnings import unusual
from heeltoe.units.sentences import UNITS
from heeltoe.warnings.notice import CATALOGUE, Notice, templates

# Endings of the names of quantities, the longest first, and the kinds of quantity that they are.
ENDINGS = {
    "_kg_m3": "density",
    "_m_s2": "acceleration",
    "_m_s": "velocity",
    "_rad": None,
    "_pa": "pressure",
    "_m2": "area",
    "_m": "length",
    "_s": None,
    "_g": None,
    "_j": "energy",
    "_n": "force",
}


def placeholders(text: str) -> dict[str, str]:
    return {name: form or "" for _, name, form, _ in Formatter().parse(text) if name}


@pytest.mark.parametrize(("code", "kind"), [(code, kind) for code in CATALOGUE for kind in templates(code)])
def test_names_of_quantities_say_their_unit(code, kind):
    severity, text = CATALOGUE[code][0], templates(code)[kind]
    assert severity in ("note", "caution", "grave")
    assert not text.endswith(".")
    for name, form in placeholders(text).items():
        unit = form.partition("|")[0].partition(" ")[2]
        quantity = next((result for end, result in ENDINGS.items() if name.endswith(end)), None)
        wanted = UNITS[unit][1] if unit in UNITS else None
        assert wanted == {"length": "displacement" if unit == "mm" else "length"}.get(quantity, quantity), name
    # What is not in braces would not be converted; what the relations of records and thesis are about stays.
    words = re.sub(r"{[^}]*}", "", text)
    assert kind == "beyond-relations" or not re.search(r"\d ?(mm|m|m/s|MPa|kN/m)\b", words)


def test_a_notice_is_a_value_with_its_quantities():
    notice = Notice("slip-in-the-air", slip_m=0.0254, restitution=0.5)
    assert notice == Notice("slip-in-the-air", slip_m=0.0254, restitution=0.5)
    assert len({notice, Notice("slip-in-the-air", slip_m=0.0254, restitution=0.5)}) == 1
    assert str(notice).startswith("most of the slip, 25.4 mm, happens in the air")
    assert notice.text("us").startswith("most of the slip, 1 in, happens in the air")
    assert (notice.severity, notice.field, notice.time_s) == ("caution", "crack.restitution", None)
    with pytest.raises(TypeError, match="slip-in-the-air takes restitution, slip_m, not slip_m"):
        Notice("slip-in-the-air", slip_m=0.0254)
    with pytest.raises(KeyError):
        Notice("no-such-code")


def test_json_has_quantities_in_si_and_the_place():
    notice = Notice("motion-flaw", "gap", field="motion.vertical", time_s=0.29, name="x", gap_s=0.31)
    assert json.loads(json.dumps(notice.to_json())) == {
        "code": "motion-flaw",
        "kind": "gap",
        "text": "x has a gap of 0.31 s at 0.29 s",
        "severity": "caution",
        "field": "motion.vertical",
        "time_s": 0.29,
        "quantities": {"gap_s": 0.31},
    }
    both = unusual("silt", "{densities_kg_m3:g kg/m^3}", densities_kg_m3=(1350.0, 1900.0)).to_json()
    assert both["quantities"] == {"densities_kg_m3": [1350.0, 1900.0]}
    assert Notice("energy-open", residual=1e-3).to_json()["field"] is None
