"""All that is wrong with a case is said in one go."""

import pickle

import pytest

from heeltoe.case.read import read_case
from heeltoe.errors.error import InputError
from shared.cases import dam, write
from shared.command import command


def test_all_that_is_wrong_is_said_at_once():
    fields = dam(crack={"friction": 11, "restitution": 2}, reservoir={"depth": "1"}, tailwater={"depth": "250 m"})
    fields |= {"uplift": {"pattern": "drained", "opening": "1 mm"}, "titel": "x"}
    with pytest.raises(InputError) as caught:
        read_case(fields)
    message = [item.field for item in (caught.value, *caught.value.others)]
    options = ["uplift.drain_position", "uplift.drain_efficiency", "uplift.opening"]
    assert message == ["titel", "crack.friction", "crack.restitution", "reservoir.depth", *options, "tailwater.depth"]
    again = pickle.loads(pickle.dumps(caught.value))
    assert [str(item) for item in again.others] == [str(item) for item in caught.value.others]
    assert again.__notes__ == [str(item) for item in caught.value.others]


def test_all_that_the_section_rules_out_is_said_at_once():
    fields = dam(reservoir={"depth": "250 m"}, tailwater={"depth": "300 m"})
    with pytest.raises(InputError) as caught:
        read_case(fields | {"anchors": [{"distance": "900 m", "prestress": "1 MN/m"}]})
    message = [item.field for item in (caught.value, *caught.value.others)]
    assert message == ["reservoir.depth", "tailwater.depth", "anchors[0].distance"]


def test_the_command_says_each_on_a_line(tmp_path):
    text = "crack.friction = 11\nreservoir.depth = 5\n[section]\nheight = '9 m'\n"
    process = command("run", write(tmp_path / "case.toml", text.encode()))
    assert (process.returncode, process.stdout) == (2, "")
    lines = process.stderr.splitlines()
    assert all(line.startswith("heeltoe: ") for line in lines)
    fields = [line.split(": ")[1] for line in lines]
    assert fields == ["section.crest_width", "section.base_width", "crack.friction", "reservoir.depth"]
