# The front door. `make help` lists what there is; ./make does the same where make itself is missing.
.DEFAULT_GOAL := help
.PHONY: help deps build demo formats gallery test test-all check asan tsan msan clang scalar fuzz fuzz-briefly fuzz-lines build-fuzz sweep bench \
	bench-load bench-peers bench-scale format format-check golden abi figures mcu operations prove-q15 rtl rtl-prove cross install check-targets short-docs clean

PRESET ?= release
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
BUILD = build/$(PRESET)
DEPS = ./scripts/install-deps

# SHORT=1: every target in seconds or a few minutes, its pages and pictures in build/short instead of docs.
ifdef SHORT
DOCS = build/short/docs
OUT = build/short/demo
FUZZ_SECONDS ?= 10
MOST ?= 100000
ROUNDS ?= 1
else
DOCS = docs
OUT = out/demo
FUZZ_SECONDS ?= 600
endif

help: ## list the targets
	@awk 'BEGIN {FS = ":.*## "; print "burnish: make TARGET\n"} /^[a-z0-9-]+:.*## / {printf "  %-14s %s\n", $$1, $$2}' Makefile

GROUPS ?= build test demo
deps: ## install Debian packages by sudo: those that demo and test need, or GROUPS="test-all bench ..."
	@$(DEPS) --sudo $(GROUPS)

build: ## build the program: build/release/burnish
	@$(DEPS) build
	@cmake --preset $(PRESET) >/dev/null
	@cmake --build --preset $(PRESET) -j $(JOBS) --target burnish_cli

demo: ## render the teapot with four lobes and a scanned object, and say where they are
	@$(DEPS) build demo
	@$(MAKE) --no-print-directory build
	@./scripts/demo $(BUILD)/burnish $(OUT)

formats: ## fill docs/formats.md: what is drawn of the glTF files below FORMATS_FILES="FOLDER..."
	@$(DEPS) build
	@$(MAKE) --no-print-directory build
	@./scripts/formats-table $(BUILD)/burnish $(DOCS)/formats.md $(FORMATS_FILES)

gallery: short-docs ## render the pictures of README.md and docs/gallery.md again, and build/gallery/index.html with 40 shapes (minutes)
	@$(DEPS) build demo
	@$(if $(SHORT),,$(DEPS) gallery)
	@$(MAKE) --no-print-directory build
	@./scripts/demo $(BUILD)/burnish $(DOCS)/images 1280,720 480,334
	@./scripts/gallery $(BUILD)/burnish $(if $(SHORT),build/short,build)/gallery $(DOCS)/gallery $(if $(SHORT),short)

# ---- Tests: one label each (test/CMakeLists.txt) ----

test: ## build and run the tests that need no special tools; ONLY=NAME or ONLY=NAME:CASE for one of them
	@$(DEPS) build test
	@$(MAKE) --no-print-directory ctest-$(PRESET) CTEST='$(if $(ONLY),,-L "unit|cli")'

test-all: ## those, other processors, hardware, firmware, figures, and six builds (minutes)
	@$(DEPS) build test-all demo
	@$(MAKE) --no-print-directory ctest-$(PRESET)

only_test = $(firstword $(subst :, ,$(ONLY)))
only_case = $(word 2,$(subst :, ,$(ONLY)))
ctest-%:
	@cmake --preset $* >/dev/null
	@cmake --build --preset $* -j $(JOBS)
	@BURNISH_TEST_ONLY='$(only_case)' ctest --preset $* --no-tests=error -j $(JOBS) $(CTEST) $(if $(ONLY),-V -R '^$(only_test)$$')

check: format-check asan tsan msan fuzz-briefly ## format, tests under sanitizers, a little fuzzing

asan: ## tests with the address and undefined behaviour sanitizers
	@$(DEPS) build test check
	@$(MAKE) --no-print-directory ctest-asan

# What runs in one thread and shares nothing is left out, and so are scripts that draw what unit tests draw.
one_thread = theory|lobe|shade_q15|kernel|elementary|srgb|numbers|layers|options|text|camera|visibility|large_triangles
one_thread_cli = headers|abi|exports|tables|shell|sheet|command_lines|cli_(figures|lobe|help|complete|bench|render|turntable|planes|info)
tsan: ## tests with the thread sanitizer
	@$(DEPS) build test check
	@$(MAKE) --no-print-directory ctest-tsan CTEST="-E '^($(one_thread)|$(one_thread_cli))'"

msan: ## unit tests with the memory sanitizer
	@$(DEPS) build test check
	@$(MAKE) --no-print-directory ctest-msan CTEST='-L unit'

clang: ## tests of the optimised clang build
	@$(DEPS) build test check
	@$(MAKE) --no-print-directory $(if $(SHORT),golden-clang,ctest-clang)

scalar: ## tests of a build without vector instructions
	@$(DEPS) build test
	@$(MAKE) --no-print-directory $(if $(SHORT),golden-scalar,ctest-scalar)

# The short form of a whole build's tests: its pictures.
golden-%:
	@cmake --preset $* >/dev/null
	@cmake --build --preset $* -j $(JOBS) --target burnish_cli
	@GOLDEN_HOW=each ./test/cli/golden.sh build/$*/burnish build/$*/golden

# The same 20,000 inputs every time.
fuzz-briefly: build-fuzz
	@./test/fuzz/run --runs 20000 >build/fuzz/brief.log 2>&1 || { tail -n 30 build/fuzz/brief.log; exit 1; }
	@echo "fuzz: 20000 inputs, none of them harmful"

fuzz: build-fuzz ## look for files that break loading and drawing: 10 minutes, or FUZZ_SECONDS=N
	@./test/fuzz/run $(FUZZ_SECONDS) $(FUZZ_FORMAT)
	@$(if $(FUZZ_FORMAT),,$(MAKE) --no-print-directory fuzz-lines)

FUZZ_LINES = $(if $(SHORT),500,20000)
fuzz-lines: ## random command lines of the program: 20,000, or FUZZ_LINES=N
	@$(MAKE) --no-print-directory program-fuzz_lines program-burnish_cli
	@./test/fuzz/lines build/release/test/fuzz_lines build/release/burnish build/fuzz/lines $(FUZZ_LINES) $$(date +%s)

build-fuzz:
	@$(DEPS) build check
	@cmake --preset fuzz >/dev/null
	@cmake --build --preset fuzz -j $(JOBS)

sweep: ## every lobe over all 2^32 floats (minutes)
	@$(MAKE) --no-print-directory program-sweep_lobe
	@build/release/test/sweep_lobe $(if $(SHORT),65537)

prove-q15: ## prove the integer lobes over every input and exponent (minutes)
	@$(MAKE) --no-print-directory program-prove_q15
	@build/release/test/prove_q15 $(if $(SHORT),--inputs)

program-%:
	@$(DEPS) build test
	@cmake --preset release $(CMAKE_FLAGS) >/dev/null
	@cmake --build --preset release -j $(JOBS) --target $*

format: ## format the sources with clang-format
	@$(DEPS) check
	@./scripts/format

format-check: ## fail when a source is not formatted
	@$(DEPS) check
	@./scripts/format --check

golden: build ## rewrite test/golden/pixels.txt after a deliberate change of pixels
	@./test/cli/golden.sh $(BUILD)/burnish build/golden $(if $(SHORT),,--update)

# ---- What the pages show ----

short-docs:
	@$(if $(SHORT),mkdir -p build/short && rm -rf $(DOCS) && cp -R docs $(DOCS))

abi: ## rewrite test/golden/abi.txt after a deliberate change of the binary interface
	@$(DEPS) check
	@./test/cli/abi.sh . build/abi --update $(if $(SHORT),build/short/abi.txt)

figures: short-docs ## draw the figures and fill the tables of docs/theory.md again
	@$(DEPS) build figures
	@$(MAKE) --no-print-directory build
	@./scripts/figures $(BUILD)/burnish $(DOCS)/figures
	@./scripts/theory-tables $(BUILD)/burnish $(DOCS)/theory.md

mcu: short-docs ## run the firmware in simulators, check every pixel, count cycles (minutes); rewrites docs/firmware.md
	@$(DEPS) mcu mcu-float
	@$(MAKE) --no-print-directory program-prove_q15 program-firmware_sheet
	@./scripts/firmware-tables build/release $(DOCS)/firmware.md $(DOCS)/images/firmware.png $(if $(SHORT),short)

operations: short-docs ## count the operations of W, W_0.5 and Schlick's lobe in machine code and circuits; fills docs/theory.md
	@$(DEPS) build mcu rtl
	@$(MAKE) --no-print-directory build
	@./scripts/operation-counts build/operations $(DOCS)/images/operations.csv
	@./scripts/theory-tables $(BUILD)/burnish $(DOCS)/theory.md

cross: short-docs ## the golden hashes on musl, aarch64, armhf, i386, riscv64, s390x, Windows (minutes); fills docs/portability.md
	@$(DEPS) build $(if $(SHORT),systems-short,systems)
	@./scripts/cross --page $(DOCS)/portability.md $(if $(SHORT),--short musl s390x,$(TARGETS))

rtl: short-docs build ## synthesise the Verilog and its opponents; fills docs/hardware.md's tables and picture (minutes)
	@$(DEPS) rtl figures
	@BURNISH_LIBRARY=$(CURDIR)/$(BUILD)/libburnish.a PICTURE=$(CURDIR)/$(DOCS)/images/rtl-teapot.png ./rtl/test/run $(BUILD)/rtl short errors picture
	@./scripts/rtl-table $(BUILD)/rtl/table $(DOCS)/hardware.md $(BUILD)/rtl/errors.txt $(if $(SHORT),short)
	@./scripts/rtl-figure $(BUILD)/burnish $(if $(SHORT),docs,$(DOCS))/images/rtl-area.csv $(DOCS)/images/rtl-area.svg

rtl-prove: ## every input of every unit and netlist against the C core, and the proofs (an hour)
	@$(DEPS) rtl
	@./rtl/test/run $(BUILD)/rtl $(if $(SHORT),short events proofs,full)
	$(if $(SHORT),,@./rtl/test/run $(BUILD)/rtl short newest)

bench: short-docs ## time kernels, frames and whole processes (medians); rewrites docs/performance.md
	@$(DEPS) build demo bench
	@$(MAKE) --no-print-directory program-all CMAKE_FLAGS=-DBURNISH_BENCH=ON
	@./bench/run build/release $(if $(SHORT),--quick)
	@./scripts/performance build/release/kernels.csv >build/release/performance.md
	@sed -n '/^## Scale/,$$p' docs/performance.md >>build/release/performance.md
	@mv build/release/performance.md $(DOCS)/performance.md

bench-scale: short-docs ## time and memory up to MOST=100000000 triangles and 16384x16384 pixels; rewrites their tables
	@$(MAKE) --no-print-directory program-all CMAKE_FLAGS=-DBURNISH_BENCH=ON
	@./scripts/scale-tables build/release/bench_scale build/release/burnish build/release $(DOCS)/performance.md $(MOST)

bench-peers: short-docs ## time frames and whole processes against other renderers (minutes); fills docs/frames.md. MESHES=FOLDER: frames of its files; PARTS=FOLDER: processes
	@$(DEPS) build demo
	@$(if $(SHORT),,$(DEPS) peers || echo "bench-peers: going on with the peers that are installed")
	@$(MAKE) --no-print-directory program-bench_peers_programs CMAKE_FLAGS=-DBURNISH_BENCH_PEERS=ON
	@./bench/peers/run build/release $(ROUNDS)
	@$(if $(MESHES),,./scripts/frames-tables $(if $(PARTS),--parts "$(PARTS)") build/release $(DOCS)/frames.md)

bench-load: short-docs ## time loading meshes beside other libraries; fills docs/loading.md. FILES=FOLDER: its files, printed only
	@$(DEPS) build
	@$(if $(SHORT),,$(DEPS) peers || echo "bench-load: going on with the peers that are installed")
	@$(MAKE) --no-print-directory program-bench_load_programs CMAKE_FLAGS=-DBURNISH_BENCH_PEERS=ON
	@mkdir -p build/load
	@./bench/load/run build/release/bench/load build/load/torus $(if $(SHORT),1 40)
	$(if $(FILES),,@./scripts/fill-tables build/load $(DOCS)/loading.md)

install: ## install program, libraries, headers and man page (DESTDIR, PREFIX), building nothing else
	@$(DEPS) build
	@cmake --preset $(PRESET) >/dev/null
	@cmake --build --preset $(PRESET) -j $(JOBS) --target burnish_installed
	@$(if $(SHORT),DESTDIR=$(CURDIR)/build/short/install )cmake --install $(BUILD) $(if $(PREFIX),--prefix $(PREFIX))

check-targets: ## every other target of this list in its short form
	@./scripts/check-targets

clean: ## remove everything that was built
	@rm -rf build out
