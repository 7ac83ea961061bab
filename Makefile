# assur: Python 3.11 or newer, git and make are all that must be there. `make` alone lists the targets.

PYTHON ?= python3
VENV   := .venv
BIN    := $(VENV)/bin

# The second variable holds the build tools to the same versions; an older pip takes them from the first.
INSTALL := PIP_CONSTRAINT=constraints.txt PIP_BUILD_CONSTRAINT=constraints.txt PIP_DISABLE_PIP_VERSION_CHECK=1 \
           $(BIN)/python -m pip install --quiet --editable

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.NOTPARALLEL:
.PHONY: help demo test test-deep test-engines mutations check figures report docs bench format constraints clean

help: ## list the targets
	@sed -n 's/^\([a-z-]*\): .*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 14

demo: $(VENV)/installed ## set up, then the main job: the paper's mechanism, checked row by row
	$(BIN)/assur demo

test: $(VENV)/installed-$(if $(ALL),all,dev) ## set up, then every test; ALL=yes installs every extra for those that need one
	OPENBLAS_NUM_THREADS=1 $(if $(ALL),ASSUR_EXTRAS=required )$(BIN)/python -m pytest -n 2 --dist worksteal $(ARGS)

# Another seed every day, so that the days together see more; the line that make prints holds it.
SEED ?= $(shell date +%Y%m%d)
test-deep: $(VENV)/installed-$(if $(ALL),all,dev) ## the long walks, real kills and thousands of mutations that `test` leaves out; SEED=20260101 draws its examples again
	OPENBLAS_NUM_THREADS=1 $(BIN)/python -m pytest -n 2 --dist worksteal -m "deep or hypothesis" --hypothesis-profile=deep --hypothesis-seed=$(SEED) $(ARGS)

test-engines: $(VENV)/installed-engines ## MuJoCo, Newton, Drake and Pinocchio read our exports, PyNite bends our bars; installs them, 1 GB, and Newton compiles for a minute at first
	OPENBLAS_NUM_THREADS=1 $(BIN)/python -m pytest -n 2 --dist worksteal -m engines tests/export tests/machine $(ARGS)

mutations: $(VENV)/installed-dev ## put faults into a copy of the source, one by one: the test named for each notices it (needs Node)
	OPENBLAS_NUM_THREADS=1 $(BIN)/python -m pytest -n 2 -m mutation tests/test_mutations.py

check: $(VENV)/installed-dev ## ruff, mypy strict and the direction of the imports
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports --no-cache

figures: $(VENV)/installed ## the paper's figures into out/figures
	$(BIN)/assur figures zeng2019 -o out/figures

report: $(VENV)/installed ## the one-file report into out/report.html
	@mkdir -p out
	$(BIN)/assur report zeng2019 -o out/report.html

docs: $(VENV)/installed-docs ## the site into build/site, from docs/; no warning is let through
	OPENBLAS_NUM_THREADS=1 $(BIN)/python -m sphinx -W --keep-going -E -q -d build/doctrees docs build/site
	@echo "open build/site/index.html"

bench: $(VENV)/installed ## poses per second beside a hand-written C loop (needs gcc), and the topology of a mechanism
	$(BIN)/python bench/bench.py
	$(BIN)/python bench/topology.py
	$(BIN)/python bench/kinematics.py
	$(BIN)/python bench/compiled.py
	$(BIN)/python bench/exported.py
	$(BIN)/python bench/seconds.py
	if command -v chromium >/dev/null && $(BIN)/python -c 'import playwright' 2>/dev/null; then \
	    $(BIN)/python bench/page.py; fi
	$(BIN)/python bench/others.py
	$(BIN)/python bench/derived.py
	$(BIN)/python bench/dynamics.py

format: $(VENV)/installed-dev ## put the code into the form that `check` asks for
	$(BIN)/ruff check --fix .
	$(BIN)/ruff format .

constraints: ## pin every package anew, each at its newest version that pyproject.toml allows
	rm -rf build/pins && $(PYTHON) -m venv build/pins
	build/pins/bin/python -m pip install --quiet --editable '.[dev,sim,view,cad,movie,cluster,engines,docs,bench]' hatchling editables
	sed -n '/^#/p' constraints.txt > build/constraints.txt
	build/pins/bin/python -m pip list --format=freeze --exclude pip --exclude setuptools --exclude assur \
	    >> build/constraints.txt
	mv build/constraints.txt constraints.txt

clean: ## remove what was made, except the virtual environment (rm -rf .venv does that)
	rm -rf out build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache
	find src tests bench examples docs -name __pycache__ -prune -exec rm -rf {} +

# ---- the virtual environment: a stamp for each step, so that the second run is instant ---------------------------

$(VENV)/made:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || { \
	    echo "assur needs Python 3.11 or newer; '$(PYTHON)' is $$($(PYTHON) --version 2>/dev/null || echo missing)."; \
	    echo "Name another one: make demo PYTHON=python3.11"; exit 1; } >&2
	$(PYTHON) -m venv $(VENV)
	@touch $@

$(VENV)/installed: pyproject.toml constraints.txt | $(VENV)/made
	$(INSTALL) .
	@touch $@

$(VENV)/installed-dev: pyproject.toml constraints.txt | $(VENV)/made
	$(INSTALL) '.[dev]'
	@touch $(VENV)/installed $@

$(VENV)/installed-docs: pyproject.toml constraints.txt | $(VENV)/made
	$(INSTALL) '.[docs]'
	@touch $(VENV)/installed $@

$(VENV)/installed-all: pyproject.toml constraints.txt | $(VENV)/made
	$(INSTALL) '.[dev,sim,view,cad,movie,cluster,docs]'
	@touch $(VENV)/installed $(VENV)/installed-dev $(VENV)/installed-docs $@

$(VENV)/installed-engines: pyproject.toml constraints.txt | $(VENV)/made
	$(INSTALL) '.[dev,engines]'
	@touch $(VENV)/installed $(VENV)/installed-dev $@
