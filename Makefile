# make demo       run the main job on a real scene, and write a .blend and a picture into output/
# make test       all tests; BLENDER=path runs those of tests/blender inside that Blender too
# make lint       formatting, lint and types
# make wheels     fetch the libraries that the extension carries
# make extension  build the extension's zips into dist/
# make gallery    replay and draw every sample scene
# make bench      the benchmarks
# make figures    draw the studies of docs/studies.md, docs/regions.md and docs/placements.md
#
# Everything runs in .venv, made from a Python 3.11 or 3.13 (PYTHON=path chooses).

SHELL := /bin/sh
.DEFAULT_GOAL := help
.PHONY: help demo test lint wheels extension gallery bench figures clean

PY := .venv/bin/python
READY := .venv/ready
BLENDER ?=
JOBS ?= auto
export PIP_DISABLE_PIP_VERSION_CHECK := 1

help:
	@sed -n 's/^# make/make/p' Makefile

$(READY): pyproject.toml scripts/find_python scripts/list_requirements.py
	@python=$$(scripts/find_python) && "$$python" -m venv .venv
	$(PY) scripts/list_requirements.py dev bpy benchmarks > .venv/requirements.txt
	@$(PY) -m pip install --quiet --requirement .venv/requirements.txt || { \
	    echo "GeoAnalogy needs packages that pip could not install, see above: is there a network, or an index that pip may use?" >&2; \
	    exit 1; }
	@touch $(READY)

demo: $(READY)
	@mkdir -p output
	@$(PY) -m sample_blends.city --demo --output output

# Each suite runs in a process of its own, and all of them run: the engine inside the extension is another copy.
test: $(READY)
	@failed=; \
	$(PY) -m pytest tests/house tests/engine -n $(JOBS) --dist loadfile || failed=1; \
	$(PY) scripts/run_blender_tests.py || failed=1; \
	test -z "$(BLENDER)" || $(PY) scripts/run_blender_tests.py --blender "$(BLENDER)" || failed=1; \
	test -z "$$failed"

lint: $(READY)
	$(PY) -m ruff format --check .
	$(PY) -m ruff check .
	$(PY) -m mypy

wheels: $(READY)
	$(PY) scripts/fetch_wheels.py

extension: wheels
	$(PY) scripts/build_extension.py

gallery: $(READY)
	$(PY) -m sample_blends.gallery

bench: $(READY)
	$(PY) -m benchmarks

figures: $(READY)
	$(PY) -m benchmarks.figures
	$(PY) -m benchmarks.regions_figures
	$(PY) -m benchmarks.placements_figures

clean:
	rm -rf .venv build dist output .pytest_cache .ruff_cache .mypy_cache .hypothesis
