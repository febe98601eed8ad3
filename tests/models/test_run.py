"""One way to run any model: whoever asks gets the same result, and the way there is straight."""

import json
import sys
from collections import Counter

import pytest

import heeltoe
from heeltoe import InputError, read_case
from heeltoe.models.run import MODELS, run
from shared.command import command
from shared.dams import BASE, FAST, example

# The usual loads open part of the crack, of which water takes hold.
OPENED = ["section.base_width=70 m", "crack.friction=1.2", "motion.sign=recorded"]


def test_python_and_the_command_line_warn_of_the_same():
    changes = [f"--set={change}" for change in OPENED]
    answer = json.loads(command("run", str(BASE), "--model", "rigid", *changes, "--json", "-").stdout)
    response = heeltoe.rigid(read_case(BASE, OPENED))
    assert [warning.name for warning in response.warnings] == [
        "crack-opens",
        "rigid-block",
        "rigid-unlike-dam slides",
        "fields-unused",
    ]
    assert response.to_json() == answer


def test_every_way_to_a_model_is_the_same():
    case = read_case(BASE, [*OPENED, *FAST, "limits.residual_slip=1 mm"])
    for model, function in (("rigid", heeltoe.rigid), ("flexible", heeltoe.flexible)):
        one, other = run(case, model), function(case)
        assert type(one) is type(other)
        assert one.to_json() == other.to_json()
        assert sum(warning.name == "crack-opens" for warning in one.warnings) == 1
        assert [check.name for check in one.limits] == ["residual_slip"]
    both = run(case, "both")
    assert both.to_json() == one.to_json() | {
        **{name: both.to_json()[name] for name in ("chosen", "beside", "ratio", "meaning", "warnings")}
    }
    # What the block reads is not said to change nothing.
    unread = {warning.name for warning in one.warnings} - {warning.name for warning in both.warnings}
    assert unread == {"value-unused"}
    # The better model is judged.
    assert both.limits
    assert not both.beside.limits
    assert sum(warning.name == "crack-opens" for warning in both.beside.warnings) == 1


def test_models_are_listed_once():
    for name in MODELS:
        assert callable(getattr(heeltoe, name))
    with pytest.raises(InputError, match="choose auto, rigid, decoupled, flexible") as refused:
        run(read_case(BASE), "elastic")
    assert refused.value.code == "not-a-choice"


def test_the_way_of_a_rigid_run_is_straight():
    """The section is cut once, the block built once, and every file entered once with the case in hand."""
    heeltoe.rigid(read_case(BASE, ["motion.duration=3 s"]))
    calls, way, fresh = Counter(), [], []

    def watch(frame, event, _):
        module = frame.f_globals.get("__name__", "")
        if event != "call" or not module.startswith("heeltoe."):
            return
        calls[f"{module}.{frame.f_code.co_name}"] += 1
        given = [frame.f_locals[name] for name in frame.f_code.co_varnames[: frame.f_code.co_argcount]]
        # What looks whether a case is one is no station, nor is what the case says of itself or is asked.
        known = module in (
            "heeltoe.errors.error",
            "heeltoe.base.display",
            "heeltoe.case.model",
            "heeltoe.case.at_crack",
            "heeltoe.case.combinations",
            "heeltoe.case.surroundings",
        )
        known = known or frame.f_code.co_name in ("in_stages", "varies")
        if any(item is case for item in given for case in fresh) and not known and way[-1:] != [module]:
            way.append(module)

    sys.setprofile(watch)
    try:
        fresh.append(read_case(BASE, ["motion.duration=3 s"]))
        heeltoe.rigid(fresh[0])
    finally:
        sys.setprofile(None)
    assert calls["heeltoe.geometry.section.cut"] == 1
    assert calls["heeltoe.mechanics.block.build_block"] == 1
    # The door hands it on, and takes the result back; a block is made after its loads; tables are made of the crack,
    # and of what the result refers to once it is judged.
    again = {"heeltoe.models.run": 2, "heeltoe.mechanics.block": 1, "heeltoe.models.rigid.tables": 1}
    entered = Counter(way) - Counter(again)
    assert max(entered.values()) == 1, way
    assert len(entered) <= 15, way


def test_the_worse_sign_is_that_with_the_larger_mean_where_single_runs_scatter():
    # By single runs the motion as recorded slides farther; its mean is less than what the other sign does.
    changes = ("flexible.elements_across=2", "flexible.time_step=0.2 ms", "motion.pga=0.7g", "motion.duration=4 s")
    case = example("koyna-top", *changes)
    single = [
        abs(heeltoe.flexible(case.with_({"motion.sign": sign, "flexible.evidence": "none"})).residual_slip_m)
        for sign in ("recorded", "reversed")
    ]
    response = run(case, "flexible")
    slips = {sign.sign: abs(sign.residual_slip_m) for sign in response.signs}
    assert single[0] > single[1]
    assert abs(response.residual_slip_m) == max(slips.values()) == slips["reversed"]
    assert [sign.sign for sign in response.signs if sign.governs] == ["reversed"]
