# make demo   build everything in .venv and run the main job on a real record
# make test   build everything in .venv and run the tests
# make help   the rest

PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin
PIP    := $(BIN)/pip install --quiet --disable-pip-version-check
# Where the tests and the validation look for strong-motion records that cannot be part of the project.
RECORDS := $(abspath ../shared/records)
export HEELTOE_RECORDS ?= $(if $(wildcard $(RECORDS)),$(RECORDS))
export PYO3_PYTHON := $(abspath $(BIN)/python)
# Tests start hundreds of processes: compiled modules are kept, whatever the shell says.
unexport PYTHONDONTWRITEBYTECODE
WASM := wasm32-unknown-unknown
SECONDS_SINCE = $$(( $$(date +%s) - $$(cat $(VENV)/.started) )) s
ELAPSED = echo "$@: done in $(SECONDS_SINCE)"
PASSED = echo "$@: passed in $(SECONDS_SINCE)"

.PHONY: demo test test-slow test-all attack test-pythons audit browser lint sizes format validate book peers bench docs wheel try-wheel clean help check
.DEFAULT_GOAL := help

help:
	@echo "make demo       run the typical dam through El Centro 1940; report, figures and results in out/demo"
	@echo "make test       the tests: kernels, every number of the physics, each figure, page and command once; 6 minutes"
	@echo "make test-slow  longer validation, which a change must pass too; 20 minutes"
	@echo "make test-all   both, and products: every figure of every example, every field under every model; an hour"
	@echo "make attack     tries to break it, for hours; writes docs/validation/attack.md (CASES=2000 SEED=7 ADD=1 for fewer, others, added)"
	@echo "make test-pythons  the tests under every Python of 3.11 to 3.13 that is installed"
	@echo "make audit      known weaknesses of all that is installed or built from; needs a network"
	@echo "make browser    install the browser that the tests of the app need; Debian's, needs a network"
	@echo "make lint       formatting, lints, types and directions of imports"
	@echo "make sizes      what is large: a report, never an error"
	@echo "make validate   the reference cases as tables (CASE=table-7.1 for one)"
	@echo "make book       the validation book, docs/validation, from the reference cases (CASE=table-7.1 for one)"
	@echo "make peers      independent codes on problems of known answer; their page of the book (PEER=MuJoCo for one)"
	@echo "make docs       the documentation as pages, in docs/_build/html"
	@echo "make bench      ours against named peers; writes benchmarks/results.md (PART=crack_dam for one part)"
	@echo "make wheel      a wheel that needs no compiler, and the sdist, in out/dist; needs a network"
	@echo "make try-wheel  install it into an empty environment and do with it what a user does"
	@echo "make clean      remove what was built"

check:
	@command -v $(PYTHON) >/dev/null || { echo "missing: Python 3.11 or newer (set PYTHON=...)"; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "missing: Python 3.11 or newer; $(PYTHON) is older (set PYTHON=...)"; exit 1; }
	@command -v cargo >/dev/null || { echo "missing: cargo (Rust 1.89 or newer)"; exit 1; }
	@mkdir -p $(VENV) && date +%s > $(VENV)/.started

$(VENV)/.packages: requirements.lock | check
	@echo "installing Python packages into $(VENV)"
	@$(PYTHON) -m venv $(VENV) || { echo "missing: the venv module of $(PYTHON) (python3-venv)"; exit 1; }
	@awk '/^maturin==/,!/\\$$/' requirements.lock > $(VENV)/maturin.lock && $(PIP) -r $(VENV)/maturin.lock
	@# The kernel compiles beside that; where it does not, the next rule says why.
	@(. $(BIN)/activate && maturin develop --release --locked --skip-install > $(VENV)/build.log 2>&1) & \
		$(PIP) -r requirements.lock; installed=$$?; wait; exit $$installed
	@touch $@

# All that the kernel is made from, at any depth.
SOURCES := $(shell find crates -type f) Cargo.toml Cargo.lock pyproject.toml

$(VENV)/.built: $(VENV)/.packages $(SOURCES) | check
	@echo "building heeltoe"
	@. $(BIN)/activate && maturin develop --release --locked > $(VENV)/build.log 2>&1 || { cat $(VENV)/build.log; exit 1; }
	@touch $@

demo: check $(VENV)/.built
	@$(BIN)/heeltoe run examples/typical-base.toml --report --out out/demo
	@$(ELAPSED)

# In the order of the folders those that wait for other processes come first, and short files last.
SIDE_BY_SIDE := -n 2 --dist loadfile --no-loadscope-reorder

test: check $(VENV)/.built
	cargo test --locked --quiet -p heeltoe
	$(BIN)/pytest -q -m "not slow and not product" $(SIDE_BY_SIDE)
	@$(PASSED)

# TESTS="tests/study tests/views" for some folders of it.
test-slow: check $(VENV)/.built
	$(BIN)/pytest -q -m "slow and not product" -n 2 --dist worksteal $(TESTS)
	@$(PASSED)

test-all: test
	$(BIN)/pytest -q -m "slow or product" -n 2 --dist worksteal
	@$(PASSED)

# Random cases of an attack, where they begin, and which attacks; the defects that it finds name their seeds. With ADD=1
# their figures are added to those of the page.
CASES ?= 20000
SEED ?= 34
ATTACKS ?= tests/attack

attack: check $(VENV)/.built
	HEELTOE_ATTACK_CASES=$(CASES) HEELTOE_ATTACK_SEED=$(SEED) HEELTOE_ATTACK_PAGE=docs/validation/attack.md HEELTOE_ATTACK_ADD=$(ADD) \
	  $(BIN)/pytest -q $(ATTACKS) -n 2 --dist worksteal
	@$(ELAPSED)

test-pythons: check $(VENV)/.built
	.ci/pythons
	@$(ELAPSED)

audit: check
	PYTHON=$(PYTHON) .ci/audit

# As the administrator only where somebody else asks.
SUDO := $(shell [ "$$(id -u)" = 0 ] || echo sudo)

browser:
	@{ command -v chromium || command -v chromium-browser || command -v google-chrome; } >/dev/null || \
	  { $(SUDO) apt-get update && $(SUDO) apt-get install -y --no-install-recommends chromium; }

lint: check $(VENV)/.built
	cargo fmt --check
	cargo clippy --workspace --release --locked --all-targets --quiet
	RUSTDOCFLAGS="-D warnings" cargo doc --locked --quiet -p heeltoe --no-deps
	@tree=$$(cargo tree --locked -p heeltoe --prefix none) || exit 1; \
	! echo "$$tree" | grep -w pyo3 || { echo "crates/heeltoe is for users without Python: no pyo3"; exit 1; }
	@if [ -d "$$(rustc --print target-libdir --target $(WASM))" ]; then \
	  cargo check --locked --quiet -p heeltoe --target $(WASM) --no-default-features; \
	else echo "skipped: the kernels in a browser (no standard library for $(WASM); rustup target add $(WASM))"; fi
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	cd benchmarks && ../$(BIN)/mypy --config-file mypy.ini
	$(BIN)/lint-imports --no-logo --no-cache
	@$(MAKE) --no-print-directory sizes

sizes: check $(VENV)/.packages
	@$(BIN)/python .ci/sizes.py
	@$(BIN)/python .ci/spine.py
	@$(BIN)/python .ci/knobs.py

validate: check $(VENV)/.built
	$(BIN)/python -m validation $(CASE)

book: check $(VENV)/.built
	$(BIN)/python -m validation.book docs/validation $(CASE)
	$(BIN)/python benchmarks/peers.py --page
	@$(ELAPSED)

# What of the peers no wheel fits is not there then, and is said to be.
PEERS = $(PIP) -r requirements-bench.lock \
	|| echo "not all peers could be installed; what is missing is said below"

peers: check $(VENV)/.built
	@$(PEERS)
	$(BIN)/python benchmarks/peers.py $(PEER)
	@$(ELAPSED)

docs: check $(VENV)/.built
	$(BIN)/sphinx-build -W -E --keep-going -q -b html docs docs/_build/html
	@echo "open docs/_build/html/index.html"
	@$(ELAPSED)

bench: check $(VENV)/.built
	@$(PEERS)
	$(BIN)/python benchmarks/run.py $(PART)
	@$(ELAPSED)

# Linked by zig against glibc 2.17 (2012), so that it runs on every Linux of today, whatever this machine has.
ZIG := ziglang==0.17.1
OLD_LINUX := $(if $(filter Linux,$(shell uname)),--zig --compatibility manylinux2014)

wheel: check $(VENV)/.built
	$(BIN)/pip install --quiet --disable-pip-version-check $(ZIG)
	rm -rf out/dist
	. $(BIN)/activate && maturin build --release --locked --sdist $(OLD_LINUX) --out out/dist
	@$(ELAPSED)

try-wheel: wheel
	$(PYTHON) .ci/try_wheel.py out/dist
	@$(ELAPSED)

format:
	cargo fmt
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

clean:
	rm -rf $(VENV) target out docs/_build docs/generated python/heeltoe/kernel/*.so
