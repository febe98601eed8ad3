"""Small things of the command line: criteria in any case, one name for output."""

from __future__ import annotations

from shared.command import command
from shared.dams import BASE, BLOCK


def test_criteria_are_known_in_any_case():
    reply = command("statics", BASE, "--criteria", "usace", "--slip", "0 m", "--json", "-")
    assert '"criteria": "USACE"' in reply.stdout
    assert command("statics", BASE, "--criteria", "useless", "--slip", "0 m").returncode == 2


def test_an_animation_goes_to_out_and_to_its_older_name(tmp_path):
    for option in ("--out", "--to"):
        place = tmp_path / f"{option[2:]}.html"
        reply = command("animate", BLOCK, option, place, "--model", "rigid", "--until", "1s")
        assert reply.returncode == 0, reply.stderr
        assert place.is_file()
        assert "It shows the motion " in reply.stdout
    both = command("animate", BLOCK, "--out", tmp_path / "a.html", "--to", tmp_path / "b.html")
    assert both.returncode == 2
    assert '--to: cannot stand beside "--out"' in both.stderr
