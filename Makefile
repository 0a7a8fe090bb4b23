# Two commands: `make demo` renders a picture, `make test` runs every test. Both first install and
# build what is missing; `make demo` leaves out what only tests and documentation need. On Debian and Ubuntu nothing but git, make and python3 needs to be there.

PYTHON ?= python3
UV ?= uv
JOBS ?= $(shell nproc)
DEMO_SCENE ?= scenes/ring/scene.xml
# Longer paths show the caustic again in the ring's metal: that light needs more time than a demo has.
DEMO_FLAGS ?= --integrator mlt -p max_depth=3 --time 15 --seed 2
SHARD ?= 1/1
MINUTES ?= 1
HOURS ?= 1
N ?= 60
SEED ?= 1
# The Pythons that `make wheel` makes wheels for: PYTHONS="python3.11 python3.12 python3.13".
PYTHONS ?= $(PYTHON)

BUILD := build/default
VENV := .venv
BIN := $(VENV)/bin
STAMPS := build/stamps
CTEST := ctest --test-dir $(BUILD) --output-on-failure --no-tests=error

# What the C++ build reads; folders too, whose time changes when a file is added or removed.
SOURCES := $(shell find cpp bindings tests/cpp docs/examples cmake CMakeLists.txt pyproject.toml \
             -not -name '.*' 2>/dev/null) $(wildcard tests/fuzz/*.h tests/fuzz/*.cpp)
FUZZ_TARGETS := $(basename $(patsubst tests/fuzz/fuzz_%,%,$(wildcard tests/fuzz/fuzz_*.cpp \
                  tests/fuzz/fuzz_*.py)))
CXX_FILES = $(shell git ls-files -- '*.h' '*.cpp')

MAKEFLAGS += --no-builtin-rules

export CMAKE_BUILD_PARALLEL_LEVEL ?= $(JOBS)
export PIP_DISABLE_PIP_VERSION_CHECK = 1

.DEFAULT_GOAL := build
.DELETE_ON_ERROR:
.PHONY: setup lock editor build quick demo docs test test-long mutants asan separate fuzz soak differential wheel blender release-check publish \
        lint format clean distclean

# ---- set-up ------------------------------------------------------------------------------------
setup: $(STAMPS)/dev

$(STAMPS)/apt $(STAMPS)/apt-test $(STAMPS)/apt-fuzz: $(STAMPS)/apt%: cmake/apt-packages%.txt
	cmake/install-apt-packages.sh $<
	@mkdir -p $(@D) && touch $@

$(VENV)/.stamp: requirements/build.txt | $(STAMPS)/apt
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -c 'import sys; assert sys.version_info >= (3, 11), "pymlt needs Python 3.11"'
	$(BIN)/pip install -q --require-hashes -r $<
	@touch $@

$(STAMPS)/dev $(STAMPS)/docs $(STAMPS)/fuzz: $(STAMPS)/%: requirements/%.txt $(VENV)/.stamp | $(STAMPS)/apt-test
	$(BIN)/pip install -q --require-hashes -r $<
	@mkdir -p $(@D) && touch $@

# The exact versions, with hashes, that these extras of pyproject.toml need, and what that needs.
lock:
	for extra in build dev docs fuzz release; do \
	  $(UV) pip compile -q --universal --python-version 3.11 --generate-hashes --no-annotate \
	    --no-header $(LOCK_FLAGS) --extra $$extra -o requirements/$$extra.txt pyproject.toml || exit 1; \
	done

# What clangd reads: how each file is compiled by itself, and the headers that CMake writes.
editor: $(STAMPS)/dev
	cmake -S . -B build/editor -G Ninja -DPYMLT_UNITY=OFF -DPYMLT_TESTS=ON -DPYMLT_PYTHON=ON \
	  -DPython_EXECUTABLE=$(abspath $(BIN)/python)
	cmake --build build/editor --target generated/mlt_build_id.h

# ---- one build: library, mlt-render and the extension, installed editable; and the C++ tests ------
build: $(STAMPS)/build

# A stamp bears the time of the start: a file that changes during the build is built the next time.
$(STAMPS)/program: $(SOURCES) $(VENV)/.stamp
	$(call install_editable,$(if $(wildcard $(STAMPS)/build),ON,OFF))

$(STAMPS)/build: $(SOURCES) $(STAMPS)/dev
	$(call install_editable,ON)
	@cp -p $@ $(STAMPS)/program

define install_editable
@mkdir -p $(@D) && touch $@.begun
$(BIN)/pip install -v --no-build-isolation --no-deps -e . \
  --config-settings=build-dir=$(BUILD) \
  --config-settings=cmake.define.PYMLT_TESTS=$(1)
@mv $@.begun $@
endef

# ---- run it --------------------------------------------------------------------------------------
demo: $(STAMPS)/program
	@mkdir -p out
	$(BIN)/python -m pymlt render $(DEMO_SCENE) $(DEMO_FLAGS) \
	  -o out/demo.exr -o out/demo.png
	@echo
	@echo "Look at out/demo.png (and out/demo.exr). To render more:"
	@echo "  source $(BIN)/activate"
	@echo "  pymlt render cornell-box --spp 64 -o out/box.png"

# The documentation, with the gallery's figures: open build/docs/index.html.
docs: build $(STAMPS)/docs
	$(BIN)/python -m sphinx -b html docs build/docs

# Both suites run, whatever the first one says. One process runs a whole file of Python tests, which
# share browsers, workers and images.
test: build
	@status=0; \
	$(CTEST) -j $(JOBS) -LE '^long$$' --timeout 300 || status=1; \
	$(BIN)/python -m pytest -n $(JOBS) --dist loadfile || status=1; \
	exit $$status

# Builds the C++ tests of one file's floor, and runs the short ones whose names contain the file's or
# its family's, in any case and with or without underscores; all of the floor if there are none. For
# FILE=cpp/scene/bsdf/phong.cpp they contain "bsdf" or "phong". TESTS='[Ll]ens' runs those whose names
# match that instead.
FLOOR = $(firstword $(subst /, ,$(patsubst cpp/%,%,$(FILE:tests/%=%))))
SHORT_TESTS = $(CTEST) -LE '^long$$' -R "^$(FLOOR)\..*($$names)"
quick:
	@test -f "$(FILE)" && test -d "tests/cpp/$(FLOOR)" || { \
	  echo 'FILE must be a file of a floor in tests/cpp: make quick FILE=cpp/scene/bsdf/phong.cpp'; exit 2; }
	@test -f $(BUILD)/build.ninja || $(MAKE) build
	cmake --build $(BUILD) --target test_$(FLOOR)
	@names='$(TESTS)'; test "$$names" || { \
	  names=$$(echo "$(FILE:tests/%=%)" | sed \
	    's|^cpp/$(FLOOR)/||; s/[.].*//; s/test_//; s/_/_?/g; s/[a-z]/[&\U&]/g; s:/:|:g'); \
	  $(SHORT_TESTS) -N >/dev/null || names=.; }; \
	$(SHORT_TESTS) -j $(JOBS) --timeout 300

# The tests that take minutes; SHARD=2/4 runs the second of four parts.
test-long: build
	@status=0; \
	$(CTEST) -j $(JOBS) -L '^long$$' -I $(subst /,$(comma)$(comma),$(SHARD)) --timeout 3600 || status=1; \
	$(BIN)/python -m pytest -m long --timeout 3600 --shard=$(SHARD) || status=1; \
	exit $$status
comma := ,

# Do the tests find bugs that are injected, one at a time? SHARD=2/4 takes the second of four parts,
# MUTANTS="phong_pdf spot_time" these alone.
mutants: $(STAMPS)/dev
	CTEST_PARALLEL_LEVEL=$(JOBS) $(BIN)/python tests/mutants/run.py --shard $(SHARD) $(MUTANTS)

asan: | $(STAMPS)/apt $(STAMPS)/apt-test
	cmake --preset asan
	cmake --build --preset asan
	ctest --preset asan -j $(JOBS)

# Each file of the library by itself: does it include what it uses?
separate: | $(STAMPS)/apt
	cmake --preset separate
	cmake --build --preset separate

# Hostile files for every reader, MINUTES for each; it fails if one of them crashes, takes ten seconds
# or a gigabyte. Targets that are named by FUZZ_TARGETS="obj ply" run alone.
fuzz: build $(STAMPS)/fuzz | $(STAMPS)/apt-fuzz
	cmake --preset fuzz
	cmake --build --preset fuzz
	@printf '%s\n' $(FUZZ_TARGETS) | xargs -P $(JOBS) -I NAME tests/fuzz/run.sh NAME $(MINUTES)

# Random scenes that are stopped, killed and resumed, for HOURS, by a build of its own with the address
# sanitizer. That build is no editable one, so the Python that imports it is not the one of $(VENV).
SOAK := build/soak
soak: build
	$(BIN)/pip install -q --no-build-isolation --no-deps --upgrade --target $(SOAK)/site . \
	  --config-settings=build-dir=$(SOAK)/cmake --config-settings=cmake.build-type=Debug \
	  --config-settings=cmake.define.PYMLT_SANITIZE=ON --config-settings=cmake.define.PYMLT_WIDE_ARCH=
	PYTHONPATH=$(SOAK)/site:$$(echo $(VENV)/lib/python3*/site-packages) \
	  LD_PRELOAD="$$($(CXX) -print-file-name=libasan.so) $$($(CXX) -print-file-name=libstdc++.so)" \
	  ASAN_OPTIONS=detect_leaks=0:quarantine_size_mb=16 \
	  $(PYTHON) tests/soak.py --hours $(HOURS)

# N random scenes by all algorithms, from number SEED on: do they make the same image?
differential: build
	$(BIN)/python tests/differential.py --n $(N) --seed $(SEED)

# ---- the release: dist/*.whl and dist/*.tar.gz ----------------------------------------------------
wheel: $(STAMPS)/dev
	$(BIN)/python release/make_wheels.py $(PYTHONS)

# The extension for Blender with the wheels of dist/, which are made if there are none, and those of the
# denoiser; Blender has numpy itself.
blender: $(STAMPS)/dev
	test -n "$(wildcard dist/*.whl)" || $(MAKE) wheel
	grep -A99 -E '^(pyoidn|cffi|pycparser)==' requirements/dev.txt | awk '/^[a-z]/ {on = /^(pyoidn|cffi|pycparser)==/} on' \
	  >build/denoiser.txt
	$(BIN)/pip download -q --no-deps --require-hashes -r build/denoiser.txt -d build/blender
	$(BIN)/python release/make_extension.py dist/*.whl build/blender/*.whl

# Where debootstrap runs (as root), in fresh systems; else in fresh virtual environments.
release-check: build
	$(BIN)/python release/check.py

# To the index that twine is told of, by default that of Python; it asks for a token.
publish: release-check
	build/wheels/tools/bin/twine upload dist/*.whl dist/*.tar.gz

# ---- style ---------------------------------------------------------------------------------------
lint: $(STAMPS)/dev
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/clang-format --dry-run --Werror $(CXX_FILES)

format: $(STAMPS)/dev
	$(BIN)/ruff check --fix-only .
	$(BIN)/ruff format .
	$(BIN)/clang-format -i $(CXX_FILES)

clean:
	rm -rf build out
	find . -name __pycache__ -not -path './$(VENV)/*' -prune -exec rm -rf {} +

distclean: clean
	rm -rf $(VENV)
