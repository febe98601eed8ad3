"""What Python says of things, and to what it cannot use: short, and with the name that was meant."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys

import numpy as np
import pytest

import heeltoe
from heeltoe import GroundMotion, InputError, build_block, dam_periods, read_case, read_record, rigid, rigid_many
from heeltoe.study.small.run_table import parse_axes, run_small
from shared.dams import BASE, FAST, SLENDER, example


@pytest.fixture(scope="module")
def case():
    return example("typical-base", *FAST)


@pytest.fixture(scope="module")
def response(case):
    return rigid(case)


@pytest.fixture(scope="module")
def grid():
    return run_small(BASE, FAST, parse_axes(["crack.friction=0.8,1.0"]), rigid)


def test_things_say_what_they_are_in_a_few_lines(case, response, grid, typical_both):
    for thing, words in (
        (case, ("<Case 'Typical dam cracked at its base'", "100 m", "friction 1", "peak 0.4 g")),
        (response, ("<Response: rigid model", "peak 0.4 g", "dam slides")),
        (typical_both, ("<FlexibleResponse: flexible model with the rigid one beside it", "dam slides")),
        (typical_both.crack, ("<CrackHistory: 301 frames",)),
        (typical_both.crack.dam, ("<FlexibleDam: ", "first period 0.3")),
        (response.motion, ("<GroundMotion elcentro-1940-180-nga", "3.923 m/s2", "301 samples")),
        (build_block(case), ("<Block: 1.071e+07 kg/m of concrete", "80 m", "sliding factor 1.341")),
        (heeltoe.statics(case, 0.1), ("<Statics: ", "usual, post-seismic", "of 8 checks are met", "not met: usual")),
        (grid, ("<SmallStudy: 2 runs of the rigid model", "crack.friction 2 times")),
        (dam_periods(case), ("DamPeriods",)),
        (heeltoe.overturning_map(read_case(SLENDER), count=2), ("OverturningMap",)),
    ):
        message = repr(thing)
        assert str(thing) == message
        assert all(word in message for word in words), message
        assert len(message) < 1200
        assert message.count("\n") < 8


def test_what_never_started_says_so(case):
    assert "No result to trust" in repr(rigid(case.with_("crack.friction=0.2")))


def test_the_numbers_of_a_response_are_found_by_completion(response):
    assert {"residual_slip_m", "peak_slip_downstream_m", "opening_upstream_m", "plot", "to_pandas"} <= set(
        dir(response)
    )
    assert {"with_", "plot", "reservoir"} <= set(dir(read_case(BASE)))


def test_a_name_that_is_not_there_gets_the_one_that_was_meant(case, response):
    for thing, name, meant in (
        (heeltoe, "rigd", "rigid"),
        (response, "residual_slip", "residual_slip_m"),
        (response, "warning", "warnings"),
        (case, "reservoire", "reservoir"),
        (case.crack, "frictoin", "friction"),
        (response.motion, "pgaa", "pga"),
        (heeltoe.statics(case, 0.1), "check", "checks"),
    ):
        with pytest.raises(AttributeError, match=f'{name}\', did you mean "{meant}"\\?'):
            getattr(thing, name)
        assert not hasattr(thing, "_repr_mimebundle_")
        assert not hasattr(thing, "xqzv")
    # A number that a run does not have says why, not that there is no such name.
    with pytest.raises(AttributeError, match="without a run, or of another model, has no 'residual_slip_m'"):
        _ = rigid(case.with_("crack.friction=0.2")).residual_slip_m
    with pytest.raises(InputError, match='did you mean "flexible"') as refused:
        heeltoe.run(case, "flexibel")
    assert refused.value.code == "not-a-choice"


def test_python_adds_no_second_guess():
    program = "import heeltoe\nheeltoe.rigd"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=60, check=False)
    assert done.stderr.count("id you mean") == 1


def test_things_can_still_be_copied(case, response):
    for thing in (case, response.motion, case.crack):
        assert repr(copy.deepcopy(thing)) == repr(pickle.loads(pickle.dumps(thing))) == repr(thing)
    assert copy.copy(response).residual_slip_m == response.residual_slip_m


def test_what_is_no_case_is_refused_by_every_public_function(case, response, tmp_path):
    for call in (
        heeltoe.run,
        heeltoe.rigid,
        heeltoe.decoupled,
        heeltoe.flexible,
        heeltoe.statics,
        heeltoe.build_block,
        heeltoe.build_flexible_dam,
        heeltoe.dam_periods,
        heeltoe.overturning_map,
        lambda given: heeltoe.animate(given, response, tmp_path / "dam.html"),
        lambda given: heeltoe.write_report(given, response, tmp_path),
        lambda given: heeltoe.with_spread(response, given),
    ):
        for given in ("file.toml", response, None):
            with pytest.raises(InputError, match=r"is not a case; give the result of heeltoe\.read_case") as refused:
                call(given)
            assert (refused.value.code, refused.value.field) == ("wrong-kind", "case")
    for call in (
        lambda given: heeltoe.animate(case, given, tmp_path / "dam.html"),
        lambda given: heeltoe.write_report(case, given, tmp_path),
        lambda given: heeltoe.with_spread(given, case),
    ):
        with pytest.raises(InputError) as refused:
            call("rigid")
        assert refused.value.code == "wrong-kind"
    with pytest.raises(InputError, match="motion: a str is not a ground motion"):
        rigid(case, "elcentro-1940-180-nga")


def test_many_blocks_and_motions_are_lists(case, response):
    motion, block = response.motion, build_block(case)
    for blocks, motions, code, field in (
        ([block, "file.toml"], [motion], "blocks-shape", "blocks[1]"),
        (case, [motion], "wrong-kind", "blocks"),
        (block, [motion], "wrong-kind", "blocks"),
        ([block], motion, "wrong-kind", "motions"),
        ([block], ["elcentro"], "blocks-motion", "motions[0]"),
    ):
        with pytest.raises(InputError) as refused:
            rigid_many(blocks, motions)
        assert (refused.value.code, refused.value.field) == (code, field)
    assert rigid_many([case], [motion])["slip"][0] == response.residual_slip_m


def test_a_record_is_read_by_its_name():
    motion = read_record("elcentro-1940-180-nga")
    assert motion.name == "elcentro-1940-180-nga"
    assert motion.pga / 9.80665 == pytest.approx(0.2808, rel=1e-3)
    assert read_record("synthetic:M6.5,20km,seed=3").pga > 0.0
    with pytest.raises(InputError, match="did you mean elcentro-1940-180-nga"):
        read_record("elcentro-1940-180-nba")


def test_tables_for_pandas(case, response, grid, monkeypatch):
    pytest.importorskip("pandas")
    histories = response.to_pandas()
    assert list(histories) == [*response.histories, "mode"]
    assert (histories["slip_m"] == response.histories["slip_m"]).all()
    assert list(grid.to_pandas()["crack.friction"]) == ["0.8", "1.0"]
    assert list(response.motion.to_pandas()) == ["time_s", "acceleration_m_s2"]
    checks = heeltoe.statics(case, 0.1).to_pandas()
    assert len(checks) == 8
    assert set(checks["load_case"]) == {"usual", "post-seismic"}
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(InputError, match=r"pip install pandas") as refused:
        GroundMotion.from_points([0.0, 1.0], np.zeros(2)).to_pandas()
    assert refused.value.code == "package-missing"
