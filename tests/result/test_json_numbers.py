"""A result to trust has a number wherever one belongs: nothing infinite, and null only where there is no such thing."""

from __future__ import annotations

import json
import math
import re

import pytest

from heeltoe import InputError, read_case, run, statics
from heeltoe.result.write import json_text
from heeltoe.views.words.starts import starts
from shared.dams import ALL_EXAMPLES, ENDS, FAST, HEIGHT

# What a case may not have, or a run not need: there is no such thing, and so no number of it.
NONE = re.compile(
    r"advice|evidence|vertical_motion|self_excitation(\.twice_damped_slip_m|\.period_s)?|assumed_rock|assumed_rock\.trials\.2\.modulus_pa|"
    r"before_shaking|rayleigh_\w+|(cracks\.\d+\.)?anchors\.\d+\.(capacity_n|slack_s|yields_s)|evidence\.rocking_\w+\.uncertainty|warnings\.\d+\.(field|kind|time_s)|(beside\.)?ratio\.\w+|"
    r"(cracks\.\d+\.)?(friction_law|roughness|joint|drainage_by_motion|overturned_about|cross_valley)|cracks\.\d+\.evidence|evidence\.(cracked_length|residual_slip_cross)_m|"
    r"(cracks\.\d+\.)?joint\.(first_cracking_s|first_cracking_at_m|cracked_through_s)|crack_level\.(bonded\.)?amplification|"
    r"(cracks\.\d+\.)?bond(\.breaks_s|\.breaks_by)?|tension\.(strength|mesh)"
)
# A crack that rises downstream: nothing makes the part above slide that way.
STEEP = ["crack.elevation=40m", "crack.inclination=30deg", "crack.friction=2"]


def numberless(found, path=""):
    """Yield the places in a JSON where there is no number."""
    if isinstance(found, dict):
        for name, each in found.items():
            yield from numberless(each, f"{path}.{name}" if path else name)
    elif isinstance(found, list):
        for place, each in enumerate(found):
            yield from numberless(each, f"{path}.{place}")
    elif found is None or (isinstance(found, float) and not math.isfinite(found)):
        yield f"{path} is {found}"


def faults(found):
    return [item for item in numberless(found) if not NONE.fullmatch(item.removesuffix(" is None"))]


# Two or more earthquakes, or rock to reduce: longer than all others.
LONG = ("aftershocks", "on-rock", "pine-flat")


@pytest.mark.parametrize(
    "path",
    [pytest.param(path, marks=pytest.mark.slow if path.stem in LONG else ()) for path in ALL_EXAMPLES],
    ids=[f"{path.parent.name}-{path.stem}" for path in ALL_EXAMPLES],
)
@pytest.mark.parametrize("model", ["rigid", "decoupled", "flexible"])
def test_a_result_to_trust_has_all_its_numbers(path, model):
    try:
        response = run(read_case(path, [*FAST, "motion.duration=2s"]), model)
    except InputError as error:
        pytest.skip(str(error))
    assert response.ok
    assert faults(response.to_json()) == []
    assert json.loads(json_text(response.to_json())) == json.loads(json.dumps(response.to_json(), allow_nan=False))


@pytest.mark.parametrize("model", ["rigid", "decoupled", "flexible"])
def test_what_no_acceleration_does_has_no_number_but_a_reason(model):
    response = run(read_case(HEIGHT, [*FAST, *STEEP]), model)
    assert response.ok
    data = response.to_json()
    assert faults(data) == []
    assert "sliding_downstream" not in data["critical_acceleration_g"]
    why = "no horizontal acceleration of the ground does that"
    assert data["left_out"] == {"critical_acceleration_g.sliding_downstream": why}
    assert math.isinf(response.static["critical_acceleration_g"]["sliding_downstream"])
    assert str(starts(response)["sliding", "downstream"]) == "no acceleration"


def test_a_dry_block_has_no_factor_against_sliding_but_a_reason():
    case = read_case(ALL_EXAMPLES[0].parent / "block.toml", [ENDS])
    data = run(case).to_json()
    assert "sliding_safety_factor" not in data["static"]
    assert data["left_out"] == {"static.sliding_safety_factor": "no force acts along the crack"}


def test_the_static_checks_leave_out_what_no_acceleration_does():
    data = statics(read_case(HEIGHT, STEEP)).to_json()
    assert "sliding_downstream" not in data["critical_acceleration_g"]
    assert list(data["left_out"]) == ["critical_acceleration_g.sliding_downstream"]
    assert all(math.isfinite(item) for item in data["critical_acceleration_g"].values())
