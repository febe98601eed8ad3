"""README, Makefile, .ci/run and the workflow name the same commands."""

import re

import yaml

from shared.dams import ROOT

README, MAKEFILE, RUN, CONTRIBUTING = (
    (ROOT / name).read_text(encoding="utf-8") for name in ("README.md", "Makefile", ".ci/run", "CONTRIBUTING.md")
)
TARGETS = set(re.findall(r"^([a-z][\w-]*):(?!=)", MAKEFILE, re.MULTILINE))
CHECKS = re.findall(r"^part make ([\w-]+)$", RUN, re.MULTILINE)


def test_the_first_screen_of_the_readme_has_both_commands():
    section = README.partition("## Two commands")[2].partition("\n## ")[0]
    assert README[: README.index("make test")].count("\n") < 40
    assert re.findall(r"^    make ([\w-]+)", section, re.MULTILINE) == ["demo", "test"]
    # The last line of each, as make prints it.
    assert re.search(r"\| `make demo` \|.*`demo: done in \d+ s` \|", section)
    assert re.search(r"\| `make test` \|.*`test: passed in \d+ s` \|", section)
    assert 'ELAPSED = echo "$@: done in $(SECONDS_SINCE)"' in MAKEFILE
    assert 'PASSED = echo "$@: passed in $(SECONDS_SINCE)"' in MAKEFILE


def test_ci_runs_the_test_command_of_the_readme_and_every_target_is_there():
    assert CHECKS == ["browser", "lint", "test", "test-slow", "docs", "try-wheel"]
    assert set(CHECKS) <= TARGETS
    help_text = set(re.findall(r'@echo "make ([\w-]+)', MAKEFILE))
    assert help_text <= TARGETS
    assert set(re.findall(r"^    make ([\w-]+)", CONTRIBUTING, re.MULTILINE)) <= TARGETS


def test_the_workflow_runs_what_ci_runs():
    jobs = yaml.safe_load((ROOT / ".github" / "workflows" / "ci.yml").read_text(encoding="utf-8"))["jobs"]
    commands = [row["run"] for row in jobs["part"]["strategy"]["matrix"]["include"]]
    assert {name for command in commands for name in command.split() if name in TARGETS} == set(CHECKS)


def test_the_shards_of_the_slow_part_are_all_of_it():
    """Each file of tests is in one shard: what one shard ignores, another names."""
    jobs = yaml.safe_load((ROOT / ".github" / "workflows" / "ci.yml").read_text(encoding="utf-8"))["jobs"]
    shards = [
        re.search(r'test-slow TESTS="(.+)"', row["run"])[1].split()
        for row in jobs["part"]["strategy"]["matrix"]["include"]
        if "test-slow" in row["run"]
    ]
    assert len(shards) == 3

    def within(path: str, shard: list[str]) -> bool:
        taken = any(path.startswith(f"{folder}/") for folder in shard if not folder.startswith("--"))
        ignored = [word.removeprefix("--ignore=") for word in shard if word.startswith("--ignore=")]
        return taken and not any(path.startswith(f"{folder}/") for folder in ignored)

    for path in (ROOT / "tests").rglob("test_*.py"):
        name = path.relative_to(ROOT).as_posix()
        assert sum(within(name, shard) for shard in shards) == 1, name


def test_parts_of_the_tests_are_markers():
    """The default part, the slow part and the products are all tests; no test is in none of them."""
    chosen = dict(re.findall(r'^([\w-]+):.*\n(?:\t.*\n)*?\t\$\(BIN\)/pytest -q -m "(.+?)"', MAKEFILE, re.MULTILINE))
    assert chosen == {
        "test": "not slow and not product",
        "test-slow": "slow and not product",
        "test-all": "slow or product",
    }
