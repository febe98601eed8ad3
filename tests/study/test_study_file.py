"""The study file: what is read of it, and what is refused in one line before anything runs."""

from __future__ import annotations

import pytest

from heeltoe import InputError, read_case
from heeltoe.study.plan.file import read_study
from heeltoe.study.plan.plan import plan_of
from heeltoe.study.run import batches as parts
from shared.command import command
from shared.dams import STUDIES, example
from shared.studies import DRAWN, GRID, study_file


def plan(folder, text, case=None):
    return plan_of(read_study(study_file(folder, text, case=case)))


def changed(text, old, new):
    assert old in text
    return text.replace(old, new)


FRICTION = '"crack.friction" = [0.3, 0.5]'
CORRELATED = 'correlation = [["crack.friction"'
# fmt: off
# What is wrong, and the field and a word of the one line that says so.
REFUSED = {
    "an unknown field": (changed(GRID, FRICTION, '"crack.fricton" = [0.3]'), "crack.fricton", "friction"),
    "an unknown key": (changed(GRID, "[vary]", "sample = 3\n[vary]"), "sample", "samples"),
    "a value out of range": (changed(GRID, FRICTION, '"crack.friction" = [0.3, 99]'), "vary.crack.friction", "10"),
    "the same value twice": (changed(GRID, FRICTION, '"crack.friction" = [0.3, "30 %"]'), "crack.friction", "once"),
    "no unit": (
        changed(GRID, FRICTION, '"concrete.density" = { from = 2300, to = "2400 kg/m^3", count = 2 }'),
        "vary.concrete.density.from",
        "no unit",
    ),
    "a distribution without a count": (changed(GRID, ", count = 3", ""), "vary.crack.restitution", "count"),
    "a distribution of words": (
        changed(GRID, FRICTION, '"uplift.pattern" = { from = 1, to = 2, count = 2 }'),
        "vary.uplift.pattern",
        "no number",
    ),
    "a distribution of what has no numbers": (
        changed(GRID, FRICTION, "title = { from = 1, to = 2, count = 2 }"),
        "vary.title",
        "no number",
    ),
    "a distribution that leaves the range": (
        changed(GRID, "from = 0.2, to = 0.8", "from = 0.2, to = 1.8"),
        "vary.crack.restitution",
        "at most 1",
    ),
    "draws that leave the range": (
        changed(DRAWN, '"50 kg/m^3", lower = "2200 kg/m^3"', '"50000 kg/m^3"'),
        "vary.concrete.density",
        "out of range",
    ),
    "the ends exchanged": (changed(GRID, "from = 0.2, to = 0.8", "from = 0.8, to = 0.2"), "restitution.to", "above"),
    "bounds exchanged": (changed(DRAWN, "upper = 1.0", "lower = 2.0, upper = 1.0"), "friction.upper", "above"),
    "a mode outside": (changed(DRAWN, "mode = 0.4", "mode = 0.95"), "restitution.mode", "between"),
    "no spread": (changed(DRAWN, 'std = "50 kg/m^3"', 'std = "0 kg/m^3"'), "density.std", "above 0"),
    "a median below zero": (changed(DRAWN, "median = 0.4", "median = -0.4"), "friction.median", "above 0"),
    "half a distribution": (changed(DRAWN, "median = 0.4, ", ""), "median", "is required by"),
    "numbers of another distribution": (changed(DRAWN, "median = 0.4", "median = 0.4, std = 3"), "std", "lognormal"),
    "no number of samples": (changed(DRAWN, "samples = 60", ""), "samples", "required"),
    "samples of a grid": (changed(GRID, "[vary]", "samples = 3\n[vary]"), "samples", "draws"),
    "not a power of two": (changed(DRAWN, '"latin hypercube"', '"sensitivity"'), "samples", "32 or 64"),
    "a million million runs": (changed(DRAWN, "samples = 60", "samples = 1000000000000"), "study", "too many"),
    "more than Sobol has": (
        changed(changed(DRAWN, '"latin hypercube"', '"sobol"'), "samples = 60", "samples = 4294967296"),
        "samples",
        "too many",
    ),
    "an empty folder": (changed(GRID, '"quakes"', '"."'), "motions.folder", "no records"),
    "no folder": (changed(GRID, '"quakes"', '"nowhere"'), "motions.folder", "not a directory"),
    "a folder of too long a name": (changed(GRID, '"quakes"', f'"{"y" * 300}"'), "motions.folder", "not a directory"),
    "no motions": (changed(GRID, 'folder = "quakes"', ""), "motions.folder", "files"),
    "motions twice": (changed(GRID, 'folder = "quakes"', 'folder = "quakes"\nfiles = ["x"]'), "folder", "keep one"),
    "components that do not pair": (
        changed(GRID, 'folder = "quakes"', 'folder = "quakes"\npairs = true'),
        "motions.pairs",
        "quake-c",
    ),
    "no vertical component": (
        changed(GRID, 'folder = "quakes"', 'folder = "quakes"\nvertical = true'),
        "motions.vertical",
        "quake-c",
    ),
    "a vertical component alone": (
        changed(GRID, 'folder = "quakes"', 'files = ["quakes/quake-a-up.txt"]'),
        "motions",
        "horizontal",
    ),
    "too many components": (
        changed(GRID, 'folder = "quakes"', 'files = ["a-1.txt", "a-2.txt", "a-3.txt"]'),
        "motions",
        "more components",
    ),
    "a motion that varies": (changed(GRID, FRICTION, '"motion.pga" = ["0.1 g"]'), "vary.motion.pga", "[motions]"),
    "an aftershock that varies": (
        changed(GRID, FRICTION, '"aftershocks[0].pga" = ["0.1 g"]'),
        "vary.aftershocks[0].pga",
        "[motions]",
    ),
    "a strength below zero": (changed(GRID, '"0.3 g", ', '"-0.3 g", '), "motions.scale.values[0]", "above 0"),
    "strengths that may be below zero": (
        changed(
            DRAWN,
            'values = { from = "0.2 g", to = "2 g" }',
            'values = { distribution = "normal", mean = "0.2 g", std = "0.2 g" }',
        ),
        "motions.scale.values",
        "below zero",
    ),
    "strengths drawn in a grid": (
        changed(GRID, '["0.3 g", "0.9 g"]', '{ from = "0.2 g", to = "2 g" }'),
        "motions.scale.values",
        "draws",
    ),
    "a period without its measure": (
        changed(GRID, 'measure = "pga"', 'measure = "pga", period = "1 s"'),
        "period",
        "sa",
    ),
    "a measure without its period": (changed(GRID, 'measure = "pga"', 'measure = "sa"'), "period", "required"),
    "a correlation with a list": (
        changed(DRAWN, "[vary]", 'correlation = [["crack.friction", "nothing", 0.5]]\n[vary]'),
        "correlation[0]",
        "drawn",
    ),
    "a field with itself": (
        changed(DRAWN, "[vary]", f'{CORRELATED}, "crack.friction", 0.5]]\n[vary]'),
        "correlation[0]",
        "drawn",
    ),
    "a correlation in a grid": (
        changed(GRID, "[vary]", 'correlation = [["crack.friction", "nothing", 0.5]]\n[vary]'),
        "correlation",
        "method",
    ),
    "correlations against each other": (
        changed(
            DRAWN,
            "[vary]",
            'correlation = [["crack.friction", "concrete.density", 0.9], '
            '["crack.friction", "crack.restitution", 0.9], ["concrete.density", "crack.restitution", -0.9]]\n[vary]',
        ),
        "correlation",
        "contradict",
    ),
    "a model twice": (changed(GRID, "[vary]", 'model = ["rigid", "rigid"]\n[vary]'), "model", "once"),
    "no case": (changed(GRID, '"case.toml"', '"nothing.toml"'), "nothing.toml", "no such file"),
    "no base to stand beside": (
        changed(changed(GRID, "[vary]", 'method = "one at a time"\n[vary]'), FRICTION, '"reservoir.depth" = ["1 m"]'),
        "vary.reservoir.depth",
        "does not state a value",
    ),
}


@pytest.mark.parametrize("what", REFUSED)
def test_a_bad_study_gets_one_line_before_anything_runs(what, tmp_path):
    text, field, word = REFUSED[what]
    process = command("study", study_file(tmp_path, text), "--out", tmp_path / "out")
    assert process.returncode == 2
    assert process.stderr.count("\n") == 1
    assert process.stderr.startswith("heeltoe: ")
    assert field in process.stderr
    assert word in process.stderr
    assert not (tmp_path / "out").exists()


def wrongs(folder, text):
    """All that is said of a study, one line each."""
    process = command("study", study_file(folder, text), "--out", folder / "out")
    assert process.returncode == 2
    assert not (folder / "out").exists()
    return [line.removeprefix("heeltoe: ") for line in process.stderr.splitlines()]


def test_all_that_is_wrong_is_told_at_once(tmp_path):
    depths = '"reservoir.depth" = ["5", "2 m", "99 m"]'
    text = changed(GRID, FRICTION, f'"crack.fricton" = [0.3]\n"crack.mu" = [1]\n{depths}')
    text = changed(text, "from = 0.2, to = 0.8, count = 3", 'from = "2 m", to = "3 m", count = 3')
    text = changed(text, '"0.3 g", "0.9 g"', '"0.3", "-1 g"').replace('folder = "quakes"', 'files = ["x.txt", "y.txt"]')
    lines = wrongs(tmp_path, text)
    assert [line.partition(": ")[0] for line in lines] == [
        *("vary.crack.fricton", "vary.crack.mu", "vary.reservoir.depth", "vary.reservoir.depth"),
        *("vary.crack.restitution.from", "vary.crack.restitution.to", "motions.files[0]", "motions.files[1]"),
        *("motions.scale.values[0]", "motions.scale.values[1]"),
    ]
    assert len(set(lines)) == len(lines)
    with pytest.raises(InputError) as caught:
        plan_of(read_study(tmp_path / "study.toml"))
    assert [str(caught.value), *map(str, caught.value.others)] == lines
    assert caught.value.__notes__ == lines[1:]


def test_what_is_wrong_with_a_record_names_the_field_that_has_it(tmp_path):
    event = 'events = [{ horizontal = ["quakes/quake-a-000.txt", "x"], vertical = "y" }]'
    lines = wrongs(tmp_path, changed(GRID, 'folder = "quakes"', event))
    fields = [line.partition(": ")[0] for line in lines]
    assert fields == ["motions.events[0].horizontal[1]", "motions.events[0].vertical"]
    ordered = changed(GRID, 'folder = "quakes"', 'files = ["synthetic:M6"]')
    assert wrongs(tmp_path, ordered)[0].startswith("motions.files[0]: ")
    (tmp_path / "bare.txt").write_text("0.1\n0.2\n0.1\n" * 20)
    (line,) = wrongs(tmp_path, changed(GRID, 'folder = "quakes"', 'files = ["bare.txt"]\nunit = "g"'))
    assert line.startswith("bare.txt: ")
    assert "motions.time_step" in line
    whole = 'files = ["bare.txt"]\nunit = "g"\ntime_step = "0.02 s"'
    plan = plan_of(read_study(study_file(tmp_path, changed(GRID, 'folder = "quakes"', whole))))
    assert plan.shakes[0].horizontal.duration == pytest.approx(59 * 0.02)


def test_what_does_not_agree_is_told_at_once(tmp_path):
    text = changed(GRID, FRICTION, '"crack.friction" = { std = 1, from = 2 }')
    text = changed(text, "folder =", "unit = 'hm'\nfolder =")
    fields = [line.partition(": ")[0] for line in wrongs(tmp_path, text)]
    assert sorted(fields) == ["motions.unit", "vary.crack.friction.std", "vary.crack.friction.to"]
    whole = changed(GRID, "[vary]", 'samples = 3\nmodel = ["rigid", "rigid"]\n[vary]')
    assert [line.partition(": ")[0] for line in wrongs(tmp_path, whole)] == ["samples", "model"]


@pytest.mark.parametrize(
    ("old", "new", "path"),
    [
        ("from = 0.2, to = 0.8", "frmo = 0.2, size = 1, to = 0.8", "vary.crack.restitution"),
        ('["0.3 g", "0.9 g"]', '{ frmo = "0.1 g", size = 1 }', "motions.scale.values"),
    ],
)
def test_a_key_that_a_range_has_not_gets_those_that_it_has(old, new, path, tmp_path):
    near, far = wrongs(tmp_path, changed(GRID, old, new))[:2]
    assert near == f'{path}.frmo: no such field; did you mean "from"?'
    assert far.startswith(f"{path}.size: no such field; the fields here are distribution, from, to, mode, mean, std,")


def test_no_study_file(tmp_path):
    process = command("study", tmp_path / "none.toml")
    assert process.returncode == 2
    assert "study file" in process.stderr


def test_a_grid_counts_all_combinations(tmp_path):
    study_plan = plan(tmp_path, GRID)
    # Two frictions, three restitutions; five horizontal components, two strengths.
    assert study_plan.sizes == (6, 5, 2, 1)
    assert study_plan.count == 60
    runs = study_plan.runs(0, 60)
    assert len({tuple(item) for item in zip(*runs.values.values(), runs.motion, runs.strength, strict=True)}) == 60
    assert sorted(set(runs.values["crack.restitution"].tolist())) == pytest.approx([0.2, 0.5, 0.8])


def test_one_at_a_time_keeps_the_others_as_they_are(tmp_path):
    study_plan = plan(tmp_path, changed(GRID, "[vary]", 'method = "one at a time"\n[vary]'))
    assert study_plan.sizes[0] == 1 + 2 + 3
    values = study_plan.runs(0, study_plan.count).values
    base = (study_plan.case.crack.mu_static, study_plan.case.crack.restitution)
    seen = set(zip(*values.values(), strict=True))
    assert base in seen
    assert all(friction == base[0] or bounce == base[1] for friction, bounce in seen)


def test_a_case_keeps_its_own_motion_where_the_study_has_none(tmp_path):
    study_plan = plan(tmp_path, GRID.split("[motions]")[0])
    assert study_plan.count == 6
    assert study_plan.shakes[0].horizontal.pga == pytest.approx(study_plan.earthquakes[0].motion.pga)


def test_a_base_value_that_is_none_is_refused(tmp_path):
    text = changed(changed(GRID, "[vary]", 'method = "one at a time"\n[vary]'), FRICTION, '"tailwater.depth" = ["1 m"]')
    with pytest.raises(InputError) as refused:
        plan(tmp_path, text)
    assert refused.value.code == "study-base"


@pytest.mark.parametrize("path", STUDIES, ids=lambda path: path.stem)
def test_examples_can_run(path):
    result = plan_of(read_study(path))
    assert result.count >= 100
    assert parts.run_part(result, 0, 1).num_rows == 1


def test_a_case_is_no_study_and_a_study_no_case(tmp_path):
    from heeltoe.case.toml_writer import case_text

    case = tmp_path / "dam.toml"
    case.write_text(case_text(example("typical-base").model_dump(mode="json", exclude_unset=True)), encoding="utf-8")
    with pytest.raises(InputError, match=r'is a case, not a study; run it with "heeltoe run".*case = "dam.toml"'):
        read_study(case)
    study = tmp_path / "study.toml"
    study.write_text('case = "dam.toml"\nmodel = "rigid"\n', encoding="utf-8")
    with pytest.raises(InputError, match='is a study, not a case; run it with "heeltoe study"'):
        read_case(study)


def test_a_limit_without_a_unit_is_one_of_millimetres(tmp_path):
    """Dams that slide 100 m are no limit: people write limits of slips and openings in millimetres."""
    for limit in ("residual_slip", "peak_slip", "opening", "crest_displacement"):
        file = study_file(tmp_path, f'case = "case.toml"\n[fragility]\nlimits = {{ {limit} = [100] }}\n')
        with pytest.raises(InputError, match="has no unit") as error:
            read_study(file)
        assert '"100 mm"' in str(error.value)
        assert '"100 m"' not in str(error.value)
    with pytest.raises(InputError, match=r"limits\.residual_slip") as error:
        read_case({**example("koyna").model_dump(mode="json"), "limits": {"residual_slip": 100}})
    assert '"100 mm"' in str(error.value)
