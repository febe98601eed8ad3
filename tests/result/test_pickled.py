"""Cases, responses and studies can be pickled and copied, and results cannot be changed."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Mapping

import numpy as np
import pytest

import heeltoe
from heeltoe import HeeltoeError, InputError, decoupled, flexible, read_case, rigid
from heeltoe.base.frozen import FrozenDict
from heeltoe.motion import targets
from shared.dams import BASE, FAST, SHORT, SLENDER, example
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


def arrays(thing, depth=8):
    """Walk the arrays that a thing holds, with those of what it holds; no dams, which are no results."""
    if isinstance(thing, np.ndarray):
        yield thing
    elif depth and not isinstance(thing, heeltoe.FlexibleDam):
        values = thing.values() if isinstance(thing, Mapping) else thing if isinstance(thing, list | tuple) else ()
        for value in [*values, *getattr(thing, "__dict__", {}).values()]:
            yield from arrays(value, depth - 1)


CASE = read_case(BASE, FAST)
# One of each class that the package names, and of what its functions return.
PUBLIC = {
    "Block": lambda: heeltoe.build_block(CASE),
    "Case": lambda: CASE,
    "DamPeriods": lambda: heeltoe.dam_periods(CASE),
    "FlexibleDam": lambda: heeltoe.build_flexible_dam(CASE),
    "GroundMotion": lambda: heeltoe.GroundMotion.from_points([0.0, 0.5, 1.0], [0.0, 1.0, 0.0]),
    "HeeltoeError": lambda: HeeltoeError("no-file", "--json", "x"),
    "InputError": lambda: InputError("no-file", "--json", "x"),
    "Response": lambda: rigid(CASE),
    "Statics": lambda: heeltoe.statics(CASE),
    "asce_7": lambda: heeltoe.asce_7(9.0, 4.0, 8.0),
    "en_1998": lambda: heeltoe.en_1998(3.0, "B"),
    "table": lambda: targets.table([0.0, 0.1, 1.0], [3.0, 9.0, 2.0]),
    "flexible": lambda: flexible(CASE),
    "overturning_map": lambda: heeltoe.overturning_map(read_case(SLENDER), count=3),
    "response_spectrum": lambda: heeltoe.response_spectrum(rigid(CASE).motion, [0.1, 1.0]),
    "statics_of_sections": lambda: heeltoe.statics_of_sections(CASE),
    "with_spread": lambda: heeltoe.with_spread(rigid(CASE), CASE, 5),
}


def test_each_public_class_is_sent_somewhere():
    classes = {name for name in heeltoe.__all__ if isinstance(getattr(heeltoe, name), type)}
    assert classes <= set(PUBLIC)
    for name in classes:
        assert isinstance(PUBLIC[name](), getattr(heeltoe, name))


@pytest.mark.parametrize("name", PUBLIC)
def test_public_objects_can_be_sent_to_other_processes(name):
    """Numbers are those of the original, and no copy can be written to."""
    thing = PUBLIC[name]()
    numbers = [array.tobytes() for array in arrays(thing)]
    for way in (lambda thing: thing, *WAYS.values()):
        again = way(thing)
        assert type(again) is type(thing)
        held = list(arrays(again))
        assert [array.tobytes() for array in held] == numbers
        assert not [array.shape for array in held if array.flags.writeable]
        if hasattr(thing, "to_json"):
            assert again.to_json() == thing.to_json()
        if callable(thing):
            assert again([0.0, 0.3, 1.0]).tolist() == thing([0.0, 0.3, 1.0]).tolist()
        if isinstance(thing, HeeltoeError):
            assert str(again) == str(thing)


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
