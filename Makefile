# Every target sets the machine up by itself, once: .venv with the pinned versions.

VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed

# The first Python found that is new enough and can make a virtual environment;
# name another with `make PYTHON=...`.
USABLE := import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))
PYTHON ?= $(shell for name in python3 python3.11 python3.12 python3.13 python3.14; do \
	$$name -c '$(USABLE)' >/dev/null 2>&1 && echo $$name && break; done)

# More for pytest or the benchmarks: make test ARGS="-k crossing"
ARGS ?=

export PIP_DISABLE_PIP_VERSION_CHECK := 1
export PIP_NO_INPUT := 1

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help demo test test-long test-page lint bench wheel site

help:  ## say what can be made
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "make %-9s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

demo: $(STAMP)  ## the main job on a shipped hull, with pictures in build/demo
	$(BIN)/assoc-hull demo --out build/demo

test: $(STAMP)  ## all tests and docstring examples, on two processes
	$(BIN)/python -m pytest -n 2 $(ARGS)

test-long: $(STAMP)  ## the tests again, with the forms that take long
	ASSOC_HULL_LONG=1 $(BIN)/python -m pytest -n 2 $(ARGS)

# The browser is Debian's; name another with `make test-page BROWSER=/path`.
BROWSER ?= $(shell command -v chromium || command -v chromium-browser || command -v google-chrome)

test-page: $(VENV)/.page  ## the fairing page in a real browser, on two processes
	@test -n "$(BROWSER)" || { echo "error: no browser was found: apt-get install chromium," \
		"or name one: make test-page BROWSER=/path" >&2; exit 2; }
	@if command -v npm >/dev/null && $(MAKE) --no-print-directory $(NPM)/.installed; then \
		$(NPM)/node_modules/.bin/tsc -p tests/browser/tsconfig.json; \
		else echo "npm is missing: types, accessibility and pure modules are NOT checked"; fi
	ASSOC_HULL_BROWSER="$(BROWSER)" $(BIN)/python -m pytest -n 2 tests/browser $(ARGS)

# Nothing of it is shipped: it looks at the types of the page's modules, and at its accessibility.
NPM := build/npm

$(NPM)/.installed: tests/browser/package-lock.json
	mkdir -p $(NPM)
	cp tests/browser/package.json tests/browser/package-lock.json $(NPM)
	cd $(NPM) && npm ci --silent --no-audit --no-fund
	@touch $@

lint: $(STAMP)  ## rules of style, formatting, imports and types
	$(BIN)/python -m ruff check .
	$(BIN)/python -m ruff format --check .
	$(BIN)/lint-imports --no-logo
	$(BIN)/python -m mypy

bench: $(STAMP)  ## the benchmarks
	$(BIN)/python -m benchmarks $(ARGS)

# It has an environment of its own: nothing of it is needed to use or test the package. What the
# package itself needs is in it, too: tables of the pages are made from the code.
SITE := build/docs-env

$(SITE)/.installed: requirements/docs.txt requirements/ci.txt Makefile
	@test -n "$(PYTHON)" || { echo "error: no Python 3.11 or newer with venv was found" >&2; exit 2; }
	$(PYTHON) -m venv $(SITE)
	$(SITE)/bin/python -m pip install --quiet --requirement requirements/docs.txt
	$(SITE)/bin/python -m pip install --quiet --constraint requirements/ci.txt \
	    attrs networkx numpy rich scipy shtab threadpoolctl
	@touch $@

site: $(SITE)/.installed  ## the documentation as a site with search, in build/site
	$(SITE)/bin/python docs/notebook_cells.py
	NO_MKDOCS_2_WARNING=1 $(SITE)/bin/python -m mkdocs build --strict

wheel: $(STAMP)  ## the wheel, in dist
	rm -rf dist
	$(BIN)/python -m build --wheel --no-isolation --outdir dist

$(VENV)/.page: requirements/page.txt $(STAMP)
	$(BIN)/python -m pip install --quiet --requirement requirements/page.txt
	@touch $@

$(STAMP): requirements/ci.txt pyproject.toml
	@test -n "$(PYTHON)" || { echo "error: no Python 3.11 or newer with venv was found;" \
		"install one, or name it: make PYTHON=python3.12" >&2; exit 2; }
	@echo "setting up $(VENV) (once, and again when the pinned versions change)"
	$(BIN)/python -m pip --version >/dev/null 2>&1 || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --requirement requirements/ci.txt
	$(BIN)/python -m pip install --quiet --no-deps --no-build-isolation --editable .
	@touch $@
