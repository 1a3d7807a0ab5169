# One word each; the work is in CMake (CMakePresets.json) and scripts/.
jobs ?= $(shell nproc)
build := cmake --build -j$(jobs) --preset

.PHONY: help demo test bench python sanitize fuzz abi format check-format tidy clean
help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' Makefile | expand -t 22

demo: release ## fit the coast of Iceland: pictures and a table of errors in out/
	@$(build) release --target ifsm_demo ifsm_cli ifsm_static
	build/release/bin/ifsm-demo data/coast/iceland.csv out

test: release ## build everything and run all tests
	@$(build) release
	@ctest --preset release

bench: ## build and run the benchmarks
	@scripts/bench

python: ## the Python package: build the wheel, install it in a fresh environment, run its tests there
	@scripts/python

sanitize: ## all tests under address and undefined-behaviour sanitizers, the threaded ones under the thread sanitizer
	@scripts/sanitize asan
	@scripts/sanitize tsan

fuzz: ## feed each reader any bytes for a minute (seconds=60)
	@scripts/fuzz $(or $(seconds),60)

abi: release ## compare the library with tests/abi: exported symbols, types
	@scripts/setup check
	@$(build) release --target ifsm
	@scripts/abi

format: ## lay out the C++ sources
	@scripts/format

check-format: ## fail when a source is not laid out
	@scripts/format --check

tidy: release ## clang-tidy on the files that differ from the last commit (a minute a file)
	@scripts/tidy

clean: ## remove build/ and out/
	rm -rf build out

.PHONY: release
release:
	@scripts/setup
	@mkdir -p build
	@cmake --preset release >build/configure-release.log || { cat build/configure-release.log; exit 1; }
