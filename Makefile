# SPDX-License-Identifier: LGPL-2.1-or-later
# Set-up, build, demo and tests on a bare Debian 12, as root or with sudo.
SHELL := /bin/bash
.SHELLFLAGS := -eu -o pipefail -c
.DELETE_ON_ERROR:

PYTHON ?= /usr/bin/python3
JOBS ?= 2
# Empty where there is no such package: then tests in FreeCAD mesh and load, and do not solve.
CALCULIX ?= calculix-ccx
BIN := .venv/bin
STAMPS := build/stamps
CHECKS := build/checks

KERNEL_FILES := CMakeLists.txt $(shell find kernel -type f)
PACKAGE_FILES := pyproject.toml freecad_tetra/_version.py
CXX_FILES := $(shell find kernel benchmarks -name '*.cpp' -o -name '*.h')

.PHONY: all demo test lint format tidy test-kernel test-python test-freecad test-freecad-gui \
    install-freecad pictures translations benchmark clean

all: $(STAMPS)/install

# Debian packages; only what is missing, so a prepared machine needs no root.
$(STAMPS)/debian: tools/install_debian.sh
	mkdir -p $(@D)
	tools/install_debian.sh
	touch $@

$(STAMPS)/venv: $(STAMPS)/debian tools/requirements.txt tools/requirements-no-deps.txt
	[ -x $(BIN)/python ] || $(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --upgrade pip
	$(BIN)/python -m pip install --quiet -r tools/requirements.txt
	$(BIN)/python -m pip install --quiet --no-deps -r tools/requirements-no-deps.txt
	touch $@

# Editable, so changed Python needs nothing; objects stay in build/<tag>, so a changed C++ file
# costs its own compilation.
$(STAMPS)/install: $(STAMPS)/venv $(KERNEL_FILES) $(PACKAGE_FILES)
	CMAKE_BUILD_PARALLEL_LEVEL=$(JOBS) flock build/lock \
	    $(BIN)/python -m pip install --quiet --no-deps --no-build-isolation --editable .
	touch $@

demo: $(STAMPS)/install
	tools/demo.sh

test: lint test-kernel test-python test-freecad test-freecad-gui

lint: $(STAMPS)/install
	tools/lint.sh

format: $(STAMPS)/venv
	clang-format -i $(CXX_FILES)
	$(BIN)/ruff check --fix --quiet . || true
	$(BIN)/ruff format --quiet .

tidy: $(STAMPS)/venv
	tools/install_debian.sh clang-tidy
	cmake -S . -B $(CHECKS) -G Ninja -DTETRA_BUILD_TESTS=ON -DTETRA_SANITIZE=ON -DTETRA_WERROR=ON
	clang-tidy -p $(CHECKS) --quiet $$(find kernel/src -name '*.cpp')

test-kernel: $(STAMPS)/venv
	cmake -S . -B $(CHECKS) -G Ninja -DTETRA_BUILD_TESTS=ON -DTETRA_SANITIZE=ON -DTETRA_WERROR=ON
	cmake --build $(CHECKS) --parallel $(JOBS)
	ctest --test-dir $(CHECKS) --output-on-failure --parallel $(JOBS)

test-python: $(STAMPS)/install
	$(BIN)/python -m pytest tests --numprocesses $(JOBS) --dist worksteal

# The checkout becomes a workbench of the user's FreeCAD.
install-freecad: export MAKE := $(MAKE)
install-freecad: export JOBS := $(JOBS)
install-freecad:
	tools/install_freecad.sh

# In the real FreeCAD, without a window and with a user folder of its own.
test-freecad: export MAKE := $(MAKE)
test-freecad: export JOBS := $(JOBS)
test-freecad: export CALCULIX := $(CALCULIX)
test-freecad:
	tools/install_debian.sh freecad $(CALCULIX) g++ cmake ninja-build python3-dev python3-venv
	QT_QPA_PLATFORM=offscreen tools/install_freecad.sh --kernel-only
	tests/in_freecad/run_headless

# In FreeCAD's window, on a display of its own.
test-freecad-gui: export MAKE := $(MAKE)
test-freecad-gui: export JOBS := $(JOBS)
test-freecad-gui:
	tools/install_debian.sh freecad xvfb xauth g++ cmake ninja-build python3-dev python3-venv
	QT_QPA_PLATFORM=offscreen tools/install_freecad.sh --kernel-only
	tests/in_freecad/run_gui

# The pictures of docs/freecad.md.
pictures:
	TETRA_SCREENSHOTS=$(CURDIR)/docs/pictures tests/in_freecad/run_gui pictures

# After a change of texts that FreeCAD's window shows.
translations:
	tools/translate.sh

# Beside CGAL, TetGen and CoACD, which are installed for this target only, and over growing solids.
benchmark: $(STAMPS)/install
	tools/install_debian.sh libcgal-dev freecad calculix-ccx
	cmake -S . -B build/benchmarks -G Ninja -DTETRA_BUILD_BENCHMARKS=ON
	cmake --build build/benchmarks --target cgal_cells
	failed=0; \
	$(BIN)/python benchmarks/cells_vs_cgal.py --cgal build/benchmarks/benchmarks/cgal_cells \
	    -o benchmarks/results/cells_vs_cgal.json || failed=1; \
	$(BIN)/python benchmarks/tets_vs_tetgen.py -o benchmarks/results/tets_vs_tetgen.json || failed=1; \
	$(BIN)/python benchmarks/growth.py -o benchmarks/results/growth.json \
	    --plot benchmarks/results/growth.png || failed=1; \
	$(BIN)/python benchmarks/compound_vs_part.py -o benchmarks/results/compound_vs_part.json || failed=1; \
	$(BIN)/python benchmarks/fem_convergence.py -o benchmarks/results/fem_convergence.json \
	    --plot benchmarks/results/fem_convergence.png || failed=1; \
	$(BIN)/python benchmarks/hulls_vs_coacd.py -o benchmarks/results/hulls_vs_coacd.json || failed=1; \
	exit $$failed

clean:
	rm -rf build .venv
