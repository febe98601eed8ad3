"""What has no end, or asks for more than there is, is refused in one line before anything runs."""

from __future__ import annotations

from pathlib import Path

import pytest

from heeltoe import GroundMotion, InputError, rigid
from heeltoe.cli.common import resolved_path
from heeltoe.errors.sanitize import plain
from heeltoe.models.flexible.mesh.file import _read
from heeltoe.motion.processing import taper
from heeltoe.motion.records.read import read_text
from shared.cases import dam, refusal
from shared.command import command, process
from shared.dams import BLOCK, EXAMPLES, example

LONG = "x" * 300


def test_a_case_without_end(tmp_path):
    assert refusal("/dev/zero").code == "too-large"


def test_more_moments_than_there_is_room_for():
    with pytest.raises(InputError) as refused:
        rigid(example("block"), output_step=1e-9)
    assert refused.value.code == "too-many"


def test_more_events_than_can_be_counted():
    assert refusal(BLOCK, ["analysis.event_limit=18446744073709551616"]).code == "out-of-range"


def test_a_home_of_nobody_is_a_name():
    assert resolved_path("~nouser/record") == "~nouser/record"


@pytest.mark.parametrize(
    ("text", "code"), [("*Node\n *INCLUDE, INPUT=/dev/zero\n", "source-unreadable"), (None, "too-large")]
)
def test_meshes_that_lead_elsewhere_or_never_end(tmp_path, text, code):
    pytest.importorskip("meshio")
    path = tmp_path / "dam.inp" if text else Path("/dev/zero")
    if text:
        path.write_text(text)
    with pytest.raises(InputError) as refused:
        _read(path)
    assert refused.value.code == code


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a\x1b[31mred", "a\\x1b[31mred"),
        ("dam\nVerdict  all is well", "dam Verdict all is well"),
        ("a\u202eb\0c\u2028d", "ab\\x00c d"),
        ("\udcff é 水", "\\udcff é 水"),
        ("x" * 2000, "x" * 197 + "..."),
    ],
)
def test_words_of_strangers(text, shown):
    assert plain(text) == shown


def test_titles_and_names_reach_the_terminal_harmless(tmp_path):
    text = BLOCK.read_text(encoding="utf-8").replace("Block pushed once", "a\\u001b[31m\\u202e\\nVerdict  fine")
    (tmp_path / "dam.toml").write_text(text, encoding="utf-8")
    reply = process("run", "dam.toml", cwd=tmp_path, columns=0)
    assert reply.returncode == 0, reply.stderr
    assert reply.stdout.startswith("a\\x1b[31m Verdict fine  (rigid model)\n")
    assert sum(line.startswith("Verdict") for line in reply.stdout.splitlines()) == 1


def test_a_directory_named_like_an_address(tmp_path, empty_figures):
    reply = command("run", BLOCK, "--out", "memory:dam", cwd=tmp_path)
    assert reply.returncode == 0, reply.stderr
    assert (tmp_path / "memory:dam" / "histories.parquet").exists()


@pytest.mark.parametrize(
    "arguments", [("run",), ("run", "a", "b"), ("periods", BLOCK, "--count=x"), ("fly",), ("--fly",), ("run", "--set")]
)
def test_options_and_commands_that_there_are_not_are_refused_in_one_line(arguments):
    reply = command(*arguments)
    assert (reply.returncode, reply.stdout, reply.stderr.count("\n")) == (2, "", 1)
    assert reply.stderr.startswith("heeltoe: ")
    assert "--help` lists the options" in reply.stderr


def test_halves_of_letters_are_refused():
    assert refusal(dam(reservoir={"depth": "\ud800"})).code == "wrong-quantity"


@pytest.mark.slow
@pytest.mark.parametrize(
    "arguments",
    [
        ("run", str(BLOCK), "--motion", LONG),
        ("new", LONG),
        ("run", str(EXAMPLES / "typical-base.toml"), "--model", "flexible", "--set", f"flexible.mesh_above={LONG}.msh"),
    ],
    ids=["motion", "new", "mesh"],
)
def test_names_longer_than_a_file_may_have(arguments, tmp_path):
    reply = process(*arguments, cwd=tmp_path)
    assert reply.returncode == 2
    complaints = [line for line in reply.stderr.splitlines() if "takes about" not in line]
    assert len(complaints) == 1
    assert "standard output" not in reply.stderr
    assert not list(tmp_path.iterdir())


def test_a_mark_and_no_text_is_no_record():
    with pytest.raises(InputError):
        read_text(b"\xef\xbb\xbf", "marked.smc")


def test_a_taper_over_next_to_nothing_leaves_the_motion():
    motion = GroundMotion.from_points([0.0, 0.5, 1.0], [1.0, 2.0, 1.0])
    assert taper(motion, 5e-324).acceleration.tolist() == [0.0, 2.0, 0.0]
