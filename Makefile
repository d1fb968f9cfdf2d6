# SPDX-License-Identifier: Apache-2.0
# Two commands for a fresh clone: `make demo` and `make test`. Everything else is CMake's.

BUILD := build/release
OUT := out
JOBS := $(shell nproc)

.PHONY: help setup build demo test clean

help:
	@echo "make demo    install what is missing, build, show light in misty air, and what learning gains"
	@echo "make test    install what is missing, build everything, run every test"
	@echo "make setup   install the missing Debian packages (tools/debian-packages.txt)"
	@echo "make build   build everything in $(BUILD)"
	@echo "make clean   remove build/ and $(OUT)/"

setup:
	@tools/setup.sh

# Ninja runs CMake again when it has to; here only what the demo leaves out is switched on.
build: setup
	@grep -qs 'TYNDALL_BUILD_TESTS:BOOL=ON' $(BUILD)/CMakeCache.txt || \
	  cmake --preset release -DTYNDALL_BUILD_TESTS=ON -DTYNDALL_BUILD_BENCH=ON
	cmake --build $(BUILD)

# Needs neither the tests nor their packages.
demo:
	@tools/setup.sh build
	@test -f $(BUILD)/build.ninja || \
	  cmake --preset release -DTYNDALL_BUILD_TESTS=OFF -DTYNDALL_BUILD_BENCH=OFF
	cmake --build $(BUILD) --target tyndall_cli
	@tools/demo.sh $(BUILD)/tyndall $(OUT)

test: build
	ctest --preset release -j $(JOBS)

clean:
	rm -rf build $(OUT)
