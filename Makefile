# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
# What you can do here; each installs what it needs first and is quick when nothing has changed.
#
#   make demo    build, run the main graph, show what was measured
#   make demo-live  the same against two emulated scanners over TCP
#   make test    build, run the tests
#   make check   the long check: format, clang with sanitizers, fuzzing, threads
#   make bench   our stages beside PCL, CGAL and Open3D, one table of ratios
#   make thesis  the thesis's tables as studies; writes docs/thesis.md
#   make build   only the release build: build/release/bin/velum
#   make install PREFIX=/usr/local
.PHONY: demo demo-live test check bench thesis build install format clean
PREFIX ?= /usr/local

build: build/release/build.ninja
	@cmake --build --preset release

build/release/build.ninja:
	@tools/setup.sh build
	@cmake --preset release

demo: build
	@tools/demo.sh

demo-live: build
	@tools/demo_live.sh

test: build
	@tools/setup.sh build
	@ctest --preset release -LE long

check: build
	@tools/check.sh

bench:
	@tools/setup.sh build bench
	@cmake --preset bench
	@cmake --build --preset bench
	@tools/bench.sh

thesis: build
	@python3 tools/thesis

install: build
	@cmake --install build/release --prefix $(PREFIX)

format:
	@tools/format.sh

clean:
	@rm -rf build
