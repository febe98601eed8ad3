"""Changes of a case from Python: texts and dictionaries, as a file is read and of a case that is there."""

from __future__ import annotations

import pytest

from heeltoe import Case, InputError, read_case
from shared.cases import DAM
from shared.dams import ALL_EXAMPLES, BASE, EXAMPLES, example

FIELDS = {"crack.friction": 1.2, "reservoir.depth": "95 m"}


@pytest.mark.parametrize(
    "changes",
    [
        "crack.friction=1.2",
        ["crack.friction=1.2"],
        {"crack.friction": 1.2},
        {"crack": {"friction": 1.2}},
        [{"crack.friction": 1.2}],
        {"crack.friction": "1.2"},
    ],
)
def test_one_change_can_be_said_in_several_ways(changes):
    wanted = read_case(BASE, ["crack.friction=1.2"])
    assert read_case(BASE, changes) == wanted
    several = changes if isinstance(changes, list) else [changes]
    assert read_case(BASE).with_(*several).model_dump() == wanted.model_dump()


def test_a_case_stays_as_it_is():
    case = example("typical-base")
    changed = case.with_(FIELDS, "uplift.intensity=0.5")
    assert (changed.crack.friction, changed.reservoir.depth, changed.uplift.intensity) == (1.2, 95.0, 0.5)
    assert (case.crack.friction, case.reservoir.depth, case.uplift.intensity) == (1.0, 100.0, 1.0)
    # What was said beside it stays said, and files are looked for where they were.
    assert changed.concrete == case.concrete
    assert changed.base_directory == case.base_directory == EXAMPLES


@pytest.mark.parametrize("path", ALL_EXAMPLES, ids=lambda path: path.stem)
def test_no_change_changes_nothing(path):
    case = read_case(path)
    again = case.with_()
    assert again.model_dump() == case.model_dump()
    assert again.model_dump(exclude_unset=True) == case.model_dump(exclude_unset=True)


def test_a_change_is_checked_as_a_file_is():
    case = read_case(DAM)
    for change, code, words in (
        ("crack.frictoin=1.2", "unknown-field", 'did you mean "friction"?'),
        ({"reservoir": {"depht": "3 m"}}, "unknown-field", 'did you mean "depth"?'),
        ({"reservoir.depth": 95}, "unit-missing", '"95 m"'),
        ({"gravity": 9.81}, "unit-missing", '"9.81 m/s^2"'),
        ({"reservoir.depth": "220 m"}, "above-other", "twice the height of the dam"),
        ("crack.friction", "wrong-quantity", "PATH=VALUE"),
        ({"": 1}, "wrong-quantity", "PATH=VALUE"),
        ({3: 1}, "wrong-quantity", "PATH=VALUE"),
        (5, "wrong-quantity", "PATH=VALUE"),
    ):
        for changed in (lambda: case.with_(change), lambda: read_case(DAM, change)):  # noqa: B023
            with pytest.raises(InputError) as refused:
                changed()
            assert refused.value.code == code
            assert words in str(refused.value)


def test_what_says_the_same_in_another_way_goes():
    case = read_case(DAM)
    apart = case.with_({"crack": {"static_friction": 1.1, "kinetic_friction": 0.9}})
    assert (apart.crack.friction, apart.crack.mu_static, apart.crack.mu_kinetic) == (None, 1.1, 0.9)
    drawn = case.with_({"motion.points": [["0 s", "0 g"], ["1 s", "0.1 g"]]})
    assert drawn.motion.file is None
    assert case.with_({"reservoir": None}).reservoir is None


def test_a_dictionary_that_changes_a_case_is_not_changed_itself():
    points = [["0 s", "0 g"], ["1 s", "0.1 g"]]
    changes = {"motion.points": points}
    read_case(DAM, changes).with_({"motion.points": [["0 s", "0 g"], ["2 s", "0.2 g"]]})
    assert changes == {"motion.points": [["0 s", "0 g"], ["1 s", "0.1 g"]]}


def test_what_is_no_source_of_a_case_is_refused():
    for source in (read_case(DAM), 3, None):
        with pytest.raises(InputError, match="neither a case file nor the fields of one") as refused:
            read_case(source)
        assert refused.value.code == "case-source"
    assert isinstance(read_case(str(BASE)), Case)


TWO = read_case(EXAMPLES / "two-cracks.toml")


def test_what_stands_in_a_list_is_changed_by_its_place():
    changed = TWO.with_("further_cracks[0].friction=0.5", {"further_cracks[0].elevation": "80 m"})
    assert changed == TWO.with_({"further_cracks": [{"elevation": "80 m", "friction": 0.5}]})
    # One coefficient goes where there are two.
    pair = changed.with_("further_cracks[0].static_friction=0.6", "further_cracks[0].kinetic_friction=0.4")
    assert pair.further_cracks[0].friction is None
    assert pair.with_("further_cracks[0].friction=0.5") == changed


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ("further_cracks[1].friction=1", '"further_cracks" has 1, counted from 0'),
        ("anchors[0].prestress=1", 'there is no list "anchors"'),
        ("crack[0].friction=1", 'there is no list "crack"'),
        ("further_cracks[0].fric=1", 'did you mean "friction"'),
        ("further_cracks[x].friction=1", 'did you mean "further_cracks"'),
        ("further_cracks[0].friction.sliding=1", '"friction" has no fields'),
    ],
)
def test_a_place_that_is_not_there_is_said(change, said):
    with pytest.raises(InputError, match="no such field") as result:
        TWO.with_(change)
    assert said in str(result.value)
