# The front door. `make help` lists what there is.
.DEFAULT_GOAL := help
.PHONY: help deps build demo pictures test check asan tsan clang scalar fuzz fuzz-briefly build-fuzz sweep bench bench-peers format format-check golden figures mcu prove-q15 rtl rtl-prove install clean

PRESET ?= release
FUZZ_SECONDS ?= 600
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
BUILD = build/$(PRESET)
DEPS = ./scripts/install-deps

help: ## list the targets
	@awk 'BEGIN {FS = ":.*## "; print "burnish: make TARGET\n"} /^[a-z0-9-]+:.*## / {printf "  %-14s %s\n", $$1, $$2}' Makefile

deps: ## install the Debian packages that building and testing need
	@$(DEPS) build test demo

build: ## build the program: build/release/burnish
	@$(DEPS) build
	@cmake --preset $(PRESET) >/dev/null
	@cmake --build --preset $(PRESET) -j $(JOBS) --target burnish_cli

demo: ## render the teapot with four lobes and a scanned object, and say where they are
	@$(DEPS) build demo
	@$(MAKE) --no-print-directory build
	@./scripts/demo $(BUILD)/burnish out/demo

pictures: ## render the README's pictures again
	@$(DEPS) build demo
	@$(MAKE) --no-print-directory build
	@./scripts/demo $(BUILD)/burnish docs/images 1280,720 480,334

test: ## build and run every test
	@$(DEPS) build test demo mcu
	@$(MAKE) --no-print-directory ctest-$(PRESET)

ctest-%:
	@cmake --preset $* >/dev/null
	@cmake --build --preset $* -j $(JOBS)
	@ctest --preset $* --no-tests=error

check: format-check asan tsan fuzz-briefly ## format, tests under sanitizers, a little fuzzing

asan: ## tests with the address and undefined behaviour sanitizers
	@$(DEPS) build test demo
	@$(MAKE) --no-print-directory ctest-asan

tsan: ## tests with the thread sanitizer
	@$(DEPS) build test demo
	@$(MAKE) --no-print-directory ctest-tsan

# The same 20,000 inputs every time.
fuzz-briefly: build-fuzz
	@./test/fuzz/run --runs 20000 >build/fuzz/brief.log 2>&1 || { tail -n 30 build/fuzz/brief.log; exit 1; }
	@echo "fuzz: 20000 inputs, none of them harmful"

fuzz: build-fuzz ## look for files that break loading and drawing: 10 minutes, or FUZZ_SECONDS=N
	@./test/fuzz/run $(FUZZ_SECONDS) $(FUZZ_FORMAT)

build-fuzz:
	@$(DEPS) build test
	@cmake --preset fuzz >/dev/null
	@cmake --build --preset fuzz -j $(JOBS)

clang: ## tests of the optimised clang build
	@$(DEPS) build test demo
	@$(MAKE) --no-print-directory ctest-clang

scalar: ## tests of a build without vector instructions
	@$(DEPS) build test demo
	@$(MAKE) --no-print-directory ctest-scalar

sweep: ## every lobe over all 2^32 floats (minutes)
	@$(DEPS) build test
	@cmake --preset release >/dev/null
	@cmake --build --preset release -j $(JOBS) --target sweep_lobe
	@build/release/test/sweep_lobe

prove-q15: ## prove the integer lobes over every input and exponent (minutes)
	@$(DEPS) build test
	@cmake --preset release >/dev/null
	@cmake --build --preset release -j $(JOBS) --target prove_q15
	@build/release/test/prove_q15

mcu: ## run the firmware in simulators, check every pixel, count cycles (minutes); rewrites docs/firmware.md
	@$(DEPS) build test mcu mcu-float
	@cmake --preset release >/dev/null
	@cmake --build --preset release -j $(JOBS) --target prove_q15 burnish
	@./scripts/firmware-tables build/release docs/firmware.md docs/images/firmware.png

bench: ## time kernels, frames and whole processes (medians); rewrites docs/performance.md
	@$(DEPS) build demo bench
	@cmake --preset release -DBURNISH_BENCH=ON >/dev/null
	@cmake --build --preset release -j $(JOBS)
	@./bench/run build/release
	@./scripts/performance build/release/kernels.csv >build/release/performance.md
	@sed -n '/^## Scale/,$$p' docs/performance.md >>build/release/performance.md
	@mv build/release/performance.md docs/performance.md

bench-scale: ## time and memory up to MOST=100000000 triangles and 16384x16384 pixels; rewrites their tables
	@$(DEPS) build
	@cmake --preset release -DBURNISH_BENCH=ON >/dev/null
	@cmake --build --preset release -j $(JOBS)
	@./scripts/scale-tables build/release/bench_scale build/release/burnish build/release docs/performance.md $(MOST)

bench-peers: ## time frames and whole processes against other renderers (minutes); fills docs/frames.md
	@$(DEPS) build demo
	@$(DEPS) peers || echo "bench-peers: going on with the peers that are installed"
	@cmake --preset release -DBURNISH_BENCH_PEERS=ON >/dev/null
	@cmake --build --preset release -j $(JOBS) --target bench_peers_programs
	@./bench/peers/run build/release
	@./scripts/frames-tables build/release/bench-peers.json docs/frames.md

format: ## format the sources with clang-format
	@$(DEPS) test
	@./scripts/format

format-check: ## fail when a source is not formatted
	@$(DEPS) test
	@./scripts/format --check

golden: build ## rewrite test/golden/pixels.txt after a deliberate change of pixels
	@./test/cli/golden.sh $(BUILD)/burnish build/golden --update

figures: ## draw the figures and fill the tables of docs/theory.md again
	@$(DEPS) build test
	@$(MAKE) --no-print-directory build
	@./scripts/figures $(BUILD)/burnish docs/figures
	@./scripts/theory-tables $(BUILD)/burnish docs/theory.md

rtl: build ## synthesise the Verilog and its opponents; fills docs/hardware.md's tables and picture (minutes)
	@$(DEPS) test
	@BURNISH_LIBRARY=$(CURDIR)/$(BUILD)/libburnish.a PICTURE=$(CURDIR)/docs/images/rtl-teapot.png ./rtl/test/run build/rtl short errors picture
	@./scripts/rtl-table build/rtl/table docs/hardware.md build/rtl/errors.txt
	@./scripts/rtl-figure docs/images/rtl-area.csv docs/images/rtl-area.svg

rtl-prove: ## every input of every unit and netlist against the C core, and the proofs (an hour)
	@$(DEPS) test
	@./rtl/test/run build/rtl-prove full

install: build ## install program, library, headers and man page (DESTDIR, PREFIX)
	@cmake --build --preset $(PRESET) -j $(JOBS)
	@cmake --install $(BUILD) $(if $(PREFIX),--prefix $(PREFIX))

clean: ## remove everything that was built
	@rm -rf build out
