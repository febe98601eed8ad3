"""The static checks after an earthquake: the command and the report say the same of what it leaves."""

from __future__ import annotations

import json

import pytest

import heeltoe
from heeltoe import read_case, rigid
from heeltoe.models.statics.after import statics_after
from heeltoe.views.report.html import html
from heeltoe.views.report.write import build_report
from shared.command import command, options
from shared.dams import COARSE, ENDS, ROOT
from shared.report_reader import Reader

EXAMPLES = ROOT / "examples"
SLIDES_ON = ["crack.friction=0.8", "motion.duration=4s", ENDS]
PUSHED = 'motion.points=[["0 s", "-0.4 g"], ["0.3 s", "-0.4 g"], ["0.3 s", "0 g"], ["3 s", "0 g"]]'


def both(example, *changes):
    """Return what the command finds, and all that a report of the rigid run says."""
    # A model that is asked for says the slip whatever the case says.
    model = () if any("residual_slip" in change for change in changes) else ("--model", "rigid")
    process = command("statics", EXAMPLES / f"{example}.toml", *options(changes), *model, "--json", "-")
    assert process.returncode == 0, process.stderr
    case = read_case(EXAMPLES / f"{example}.toml", changes)
    response = rigid(case)
    return json.loads(process.stdout), Reader(html(build_report(case, response))).text, response


@pytest.mark.parametrize(
    ("example", "changes", "slip", "expected"),
    [
        ("typical-base", SLIDES_ON, None, "rigid model, points of the case, PGA 0.4 g, still moving when the run ends"),
        ("typical-base", [], None, "rigid model, points of the case, PGA 0.4 g"),
        ("typical-base", ["statics.residual_slip=0.2m"], 0.2, "statics.residual_slip"),
        ("typical-base", ["crack.friction=0.1"], 0.0, "the rigid model ends 'unstable', zero is taken"),
    ],
)
@pytest.mark.usefixtures("no_figures")
def test_command_and_report_agree(example, changes, slip, expected):
    result, report, response = both(example, PUSHED, *changes)
    assert result["slip_source"] == expected
    assert f"({expected})." in report
    assert result["slip_m"] == (response.residual_slip_m if slip is None else slip)
    after = statics_after(read_case(EXAMPLES / f"{example}.toml", [PUSHED, *changes]), response)
    assert after.to_json()["checks"] == result["checks"]
    grave = [notice.code for notice in after.warnings if notice.severity == "grave"]
    assert ("slip-untold" in grave) == expected.endswith("zero is taken")


def test_the_model_of_the_slip_is_named_and_can_be_chosen():
    """The better one by itself, as in the report of the same run."""
    quick = ("--set", PUSHED, *options(COARSE))
    result = {
        model: json.loads(command("statics", EXAMPLES / "typical-base.toml", *quick, *more, "--json", "-").stdout)
        for model, more in (("flexible", ()), ("rigid", ("--model", "rigid")))
    }
    for model, each in result.items():
        assert each["slip_source"].startswith(f"{model} model, points of the case")
        run = heeltoe.run(read_case(EXAMPLES / "typical-base.toml", [PUSHED, *COARSE]), model)
        assert each["slip_m"] == run.residual_slip_m
