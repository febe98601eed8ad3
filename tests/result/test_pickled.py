"""Cases, responses and studies can be pickled and copied, and results cannot be changed."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import heeltoe
from heeltoe import decoupled, flexible, read_case, rigid
from heeltoe.base.frozen import FrozenDict
from shared.dams import BASE, FAST, SHORT, example
from shared.studies import study_file

STUDY = 'case = "case.toml"\nmethod = "grid"\nmodel = ["rigid"]\n[vary]\n"crack.friction" = [0.9, 1.0]\n'


def study(folder):
    return heeltoe.run_study(study_file(folder, STUDY), folder / "out")


WAYS = {"pickled": lambda thing: pickle.loads(pickle.dumps(thing)), "copied": copy.copy, "deep": copy.deepcopy}
RUNS = {
    "rigid": lambda _: rigid(read_case(BASE, FAST)),
    "flexible": lambda _: flexible(read_case(BASE, FAST)),
    "decoupled": lambda _: decoupled(example("koyna-top", *SHORT)),
    "solve": lambda _: heeltoe.solve(BASE, "crack.friction", "residual_slip = 5 m", model="rigid", between=(0.9, 1.0)),
    "study": study,
}


@pytest.mark.parametrize("run", RUNS)
def test_results_can_be_pickled_and_copied(run, tmp_path):
    result = RUNS[run](tmp_path)
    for way, again in WAYS.items():
        assert again(result).to_json() == result.to_json(), way


@pytest.mark.parametrize("way", WAYS)
def test_cases_can_be_pickled_and_copied(way):
    case = read_case(BASE, FAST)
    again = WAYS[way](case)
    assert again == case
    assert rigid(again).residual_slip_m == rigid(case).residual_slip_m


def test_a_copy_of_an_elastic_dam_runs_to_the_same_bits():
    response = flexible(read_case(BASE, FAST))
    dam = response.crack.dam
    again = pickle.loads(pickle.dumps(dam))
    assert again.kernel is not dam.kernel
    assert [state.slips for state in (again.kernel.still(), dam.kernel.still())] == [dam.kernel.still().slips] * 2


@pytest.mark.parametrize("pickled", [False, True])
def test_a_result_cannot_be_changed(pickled):
    response = rigid(read_case(BASE, FAST))
    if pickled:
        response = pickle.loads(pickle.dumps(response))
    with pytest.raises(ValueError, match="read-only"):
        response.histories["slip_m"][0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        response.event_log["time_s"][0] = 1.0
    with pytest.raises(TypeError):
        response.histories["slip_m"] = np.zeros(3)
    with pytest.raises(AttributeError):
        response.numbers.impacts = 3
    with pytest.raises(AttributeError):
        response.outcome = "ok"


def test_containers_that_cannot_be_changed():
    frozen = FrozenDict({"numbers": np.zeros(2), "items": [1, 2]})
    assert frozen["items"] == [1, 2]
    for change in (
        lambda: frozen["items"].append(3),
        lambda: frozen["items"].__setitem__(0, 3),
        lambda: frozen["items"].clear(),
    ):
        with pytest.raises(TypeError, match="cannot be changed"):
            change()
    again = pickle.loads(pickle.dumps(frozen))
    assert not again["numbers"].flags.writeable
    assert copy.deepcopy(again)["items"] == [1, 2]
