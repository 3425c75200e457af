# The front door. `make help` lists what there is; ./make does the same where make itself is missing.
.DEFAULT_GOAL := help
.PHONY: help deps build demo formats gallery importers mpi view test test-all check asan tsan msan clang scalar fuzz fuzz-briefly fuzz-lines fuzz-report build-fuzz sweep bench \
	bench-load bench-peers bench-scale format format-check golden abi figures shaders mcu operations prove-q15 rtl rtl-prove cross npm npm-browser web web-serve web-test web-bench install check-targets short-docs clean

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
	@./scripts/need-folder $(foreach folder,$(FORMATS_FILES),FORMATS_FILES "$(folder)")
	@$(DEPS) build
	@$(MAKE) --no-print-directory build
	@python3 scripts/tables formats $(BUILD)/burnish $(DOCS)/formats.md $(FORMATS_FILES)

gallery: short-docs ## render the pictures of README.md and docs/gallery.md again, and build/gallery/index.html with 40 shapes (minutes)
	@$(DEPS) build demo
	@$(if $(SHORT),,$(DEPS) gallery)
	@$(MAKE) --no-print-directory build
	@./scripts/demo $(BUILD)/burnish $(DOCS)/images 1280,720 480,334
	@python3 scripts/tables gallery $(BUILD)/burnish $(if $(SHORT),build/short,build)/gallery $(DOCS)/gallery $(if $(SHORT),short)

# ---- Tests: one label each (test/CMakeLists.txt) ----

test: ## build and run the tests that need no special tools; ONLY=NAME or ONLY=NAME:CASE for one of them
	@$(DEPS) build test
	@$(MAKE) --no-print-directory ctest-$(PRESET) CTEST='$(if $(ONLY),,-L "unit|cli")'

test-all: ## those, other processors, hardware, firmware, figures, and other compilers (minutes)
	@$(DEPS) build test-all demo
	@$(if $(SHORT),BITS=short )$(MAKE) --no-print-directory ctest-$(PRESET)

importers: short-docs ## build burnish-import-assimp (FBX, COLLADA ...), -draco (glTF), -occt (STEP ...), test them, fill docs/importers.md
	@$(DEPS) build test importers
	@cmake --preset release -DBURNISH_IMPORT_ASSIMP=ON -DBURNISH_IMPORT_DRACO=ON -DBURNISH_IMPORT_OCCT=ON >/dev/null
	@$(MAKE) --no-print-directory ctest-release CTEST='-L importers'
	@python3 scripts/tables importers build/release $(DOCS)/importers.md

mpi: ## build burnish-mpi, batches on many machines, and test it with ranks that die, sleep and hang
	@$(DEPS) build test mpi
	@cmake --preset release -DBURNISH_MPI=ON >/dev/null
	@cmake --build --preset release -j $(JOBS) --target burnish_cli burnish_mpi
	@./program/mpi/test/run build/release/burnish build/mpi-test build/release/burnish-mpi $(if $(SHORT),short)

view: ## build burnish with its window (SDL2), and test that and what desktops need
	@$(DEPS) build test view
	@$(MAKE) --no-print-directory ctest-release CTEST='-L view'

only_test = $(firstword $(subst :, ,$(ONLY)))
only_case = $(word 2,$(subst :, ,$(ONLY)))
ctest-%:
	@cmake --preset $* $(CMAKE_FLAGS) >/dev/null
	@cmake --build --preset $* -j $(JOBS)
	@BURNISH_TEST_ONLY='$(only_case)' ctest --preset $* --no-tests=error -j $(JOBS) $(CTEST) $(if $(ONLY),-V -R '^$(only_test)$$')

check: format-check asan tsan msan fuzz-briefly ## format, tests under sanitizers, a little fuzzing

# Their short forms compile without wide vectors and most of what debuggers need, and leave out what is slow and reads and draws
# nothing that the rest does not.
briefly = -DBURNISH_WIDE_VECTORS=OFF -DCMAKE_C_FLAGS_RELWITHDEBINFO="$1 -gline-tables-only"
asan: ## tests with the address and undefined behaviour sanitizers
	@$(DEPS) build test check
	@$(MAKE) --no-print-directory ctest-asan $(if $(SHORT),CMAKE_FLAGS='$(call briefly,-O1)' CTEST="-E '^($(no_memory))'")

# What runs in one thread and shares nothing is left out, and so are scripts that draw what unit tests draw.
one_thread = theory|lobe|shade_q15|arrays_q15|kernel|elementary|srgb|numbers|layers|options|text|camera|visibility|large_triangles
one_thread_cli = serve_http|headers|abi|exports|links|tables|shell|sheet|shaders|command_lines|cli_(batch|serve|import|view|compare|faults|figures|lobe|help|complete|bench|render|turntable|planes|info)
several_threads = tasks|context|render_context|kept|reader_threads|obj_threads|ply_binary|load|decode|gltf|picture|png|lines|occlusion|shadow|texture|transparency|target|render
tsan: ## tests with the thread sanitizer
	@$(DEPS) build test check
	@$(MAKE) --no-print-directory $(if $(SHORT),threads-briefly,ctest-tsan CTEST="-E '^($(one_thread)|$(one_thread_cli))'")
threads-briefly:
	@cmake --preset tsan $(call briefly,-O2) >/dev/null
	@cmake --build --preset tsan -j $(JOBS) --target $(addprefix test_,$(subst |, ,$(several_threads)))
	@ctest --preset tsan --no-tests=error -j $(JOBS) -R '^($(several_threads))$$'

no_memory = theory|headers|abi|exports|links|tables|shell|shaders|sheet|cli_figures|cli_bench
no_files = $(no_memory)|memory|lobe|shade_q15|arrays_q15|large_triangles|rows|depth_maps
msan: ## unit tests with the memory sanitizer
	@$(DEPS) build test check
	@$(MAKE) --no-print-directory ctest-msan CTEST="-L unit$(if $(SHORT), -E '^($(no_files))')" $(if $(SHORT),CMAKE_FLAGS='$(call briefly,-O2)')

clang: ## tests of the optimised clang build
	@$(DEPS) build test check
	@$(MAKE) --no-print-directory $(if $(SHORT),golden-clang,ctest-clang)

scalar: ## tests of a build without vector instructions
	@$(DEPS) build test
	@$(MAKE) --no-print-directory $(if $(SHORT),golden-scalar,ctest-scalar)

# The short form of a whole build's tests: its pictures. clang may use FMA there, and must not.
short_clang = -O1 -march=native
short_scalar = -O1
golden-%:
	@cmake --preset $* -B build/short/$* -DBURNISH_WIDE_VECTORS=OFF -DCMAKE_C_FLAGS_RELEASE="$(short_$*) -DNDEBUG" >/dev/null
	@cmake --build build/short/$* -j $(JOBS) --target burnish_cli
	@GOLDEN_HOW=each ./test/integration/golden.sh build/short/$*/burnish build/short/$*/golden

# The same 20,000 inputs every time.
fuzz-briefly: build-fuzz
	@./test/fuzz/run --runs 20000 >build/fuzz/brief.log 2>&1 || { tail -n 30 build/fuzz/brief.log; exit 1; }
	@echo "fuzz: 20000 inputs, none of them harmful"

fuzz: build-fuzz ## look for files that break loading and drawing: 10 minutes, or FUZZ_SECONDS=N
	@./test/fuzz/run $(FUZZ_SECONDS) $(FUZZ_FORMAT)
	@$(if $(FUZZ_FORMAT),,$(MAKE) --no-print-directory fuzz-lines)

fuzz-report: short-docs build-fuzz ## fuzz every kind of input with 1,000,000 inputs, and fill docs/security.md (hours)
	@./test/fuzz/report $(if $(SHORT),500,1000000) $(DOCS)/security.md

.PHONY: hostile
hostile: short-docs build ## draw small files that are meant to take long or much memory; fills docs/security.md
	@./test/hostile/report build/release/burnish build/hostile $(DOCS)/security.md

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

.PHONY: sweep-gpu
sweep-gpu: ## a lobe over all 2^32 floats on every Vulkan driver that is here (minutes)
	@$(DEPS) shaders
	@$(MAKE) --no-print-directory program-gpu_values
	@./test/shaders/gpu.sh $(CURDIR)/build/release/test/gpu_values $(CURDIR) $(CURDIR)/build/sweep-gpu $(if $(SHORT),,--all)

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
	@./test/integration/golden.sh $(BUILD)/burnish build/golden $(if $(SHORT),,--update)

# ---- What the pages show ----

short-docs:
	@$(if $(SHORT),mkdir -p build/short && rm -rf $(DOCS) && cp -R docs $(DOCS))

shaders: ## write shaders/ from shaders/burnish.shade again
	@$(DEPS) test
	@./scripts/shaders $(if $(SHORT),build/short/shaders)

abi: ## rewrite test/golden/abi.txt after a deliberate change of the binary interface
	@$(DEPS) check
	@./test/integration/abi.sh . build/abi --update $(if $(SHORT),build/short/abi.txt)

figures: short-docs ## draw the figures and fill the tables of docs/theory.md again
	@$(DEPS) build figures
	@$(MAKE) --no-print-directory build
	@python3 scripts/tables figures $(BUILD)/burnish $(DOCS)/figures
	@python3 scripts/tables theory $(BUILD)/burnish $(DOCS)/theory.md

mcu: short-docs ## run the firmware in simulators, check every pixel, count cycles (minutes); rewrites docs/firmware.md
	@$(DEPS) mcu mcu-float
	@$(MAKE) --no-print-directory program-prove_q15 program-firmware_sheet
	@python3 scripts/tables firmware build/release $(DOCS)/firmware.md $(DOCS)/images $(if $(SHORT),short)

.PHONY: arduino
arduino: ## build the library for Arduino, PlatformIO and the Pico into build/arduino and build/burnish-arduino-VERSION.zip; compile and run its examples
	@$(DEPS) build mcu
	@$(MAKE) --no-print-directory build
	@./hardware/arduino/pack build
	@./hardware/arduino/test/run $(if $(SHORT),check,all) build/arduino-test $(BUILD)/burnish

operations: short-docs ## count the operations of W, W_0.5 and Schlick's lobe in machine code and circuits; fills docs/theory.md
	@$(DEPS) build mcu rtl
	@$(MAKE) --no-print-directory build
	@python3 scripts/tables operations build/operations $(DOCS)/images/operations.csv
	@python3 scripts/tables theory $(BUILD)/burnish $(DOCS)/theory.md

cross: short-docs ## the golden hashes on musl, aarch64, armhf, i386, riscv64, s390x, Windows (minutes); fills docs/portability.md
	@$(DEPS) build $(if $(SHORT),systems-short,systems)
	@./scripts/cross --page $(DOCS)/portability.md $(if $(SHORT),--short musl s390x,$(TARGETS))

WASM = ./scripts/debian-sources build/sources zlib expat && cmake -S bindings/wasm -B build/wasm -G Ninja $(if $(SHORT),-DCMAKE_BUILD_TYPE=Short,-DCMAKE_BUILD_TYPE=Release) >/dev/null && \
	cmake --build build/wasm -j $(JOBS) && ./bindings/npm/pack build/wasm build

npm: ## build the npm package, WebAssembly inside, into build/npm and build/burnish-VERSION.tgz; its pixels are the program's
	@$(DEPS) build npm
	@$(MAKE) --no-print-directory build
	@$(WASM)
	@./bindings/npm/test/run $(BUILD)/burnish build/burnish-*.tgz build/npm-test

.PHONY: python
python: ## build the wheel for Python, the library inside, into build/python, and test it in a virtual environment
	@$(DEPS) build python
	@$(MAKE) --no-print-directory build
	@./bindings/python/test/run $(BUILD) $(BUILD)/burnish build/python

npm-browser: npm ## the package in Chromium: a worker, and its highlights by three.js' renderers; fetches three.js and playwright-core
	@! command -v npm >/dev/null || $(DEPS) browser
	@./bindings/npm/test/browser/run build/burnish-*.tgz build/npm-browser

web: ## build the explorer, a page of lobes beside the power, into build/web; fetches uPlot from npm
	@$(DEPS) build npm
	@$(WASM)
	@./bindings/web/build build/npm build/web

web-serve: web ## the same, served at http://127.0.0.1:8000
	@$(if $(SHORT),:,node bindings/web/serve.mjs build/web)

web-test: web ## click through the explorer in Chromium: its hashes are the program's
	@! command -v npm >/dev/null || $(DEPS) browser
	@$(MAKE) --no-print-directory build
	@./bindings/web/test/run $(BUILD)/burnish build/web build/web-test

web-bench: web ## how soon the explorer has its first picture, and how many a second it draws (medians; Chromium)
	@! command -v npm >/dev/null || $(DEPS) browser
	@./bindings/web/test/run --bench build/web build/web-test $(if $(SHORT),short)

.PHONY: docs
SITE = $(if $(SHORT),build/short/site,build/docs)
docs: ## make the documentation into build/docs: guides, manual, the reference of the headers, search; links are checked
	@$(DEPS) build docs
	@$(MAKE) --no-print-directory build
	@./docs/site/build $(BUILD)/burnish build/web $(SITE)
	@python3 test/pages/links.py --site $(SITE)

rtl: short-docs build ## synthesise the Verilog and its opponents; fills docs/hardware.md's tables and picture (minutes)
	@$(DEPS) rtl figures
	@BURNISH_LIBRARY=$(CURDIR)/$(BUILD)/libburnish.a PICTURE=$(CURDIR)/$(DOCS)/images/rtl-teapot.png ./hardware/rtl/test/run $(BUILD)/rtl short errors picture
	@python3 scripts/tables rtl $(BUILD)/rtl/table $(DOCS)/hardware.md $(BUILD)/rtl/errors.txt $(if $(SHORT),short)
	@python3 scripts/tables rtl-area $(BUILD)/burnish $(if $(SHORT),docs,$(DOCS))/images/rtl-area.csv $(DOCS)/images/rtl-area.svg

rtl-prove: ## every input of every unit and netlist against the C core, and the proofs (an hour)
	@$(DEPS) rtl
	@./hardware/rtl/test/run $(BUILD)/rtl $(if $(SHORT),short events proofs,full)
	@./hardware/rtl/test/protocol $(BUILD)/rtl/protocol
	$(if $(SHORT),,@./hardware/rtl/test/run $(BUILD)/rtl short newest)

DEMO = BURNISH_LIBRARY=$(CURDIR)/$(BUILD)/libburnish.a ./hardware/rtl/demo/run $(BUILD)/demo
.PHONY: demo-icebreaker demo-ulx3s demo-film demo-window
demo-icebreaker: build ## build build/release/demo/icebreaker.bin: a sphere and a teapot on an iCEBreaker's screen (minutes)
	@$(DEPS) rtl boards
	@$(if $(SHORT),PICTURES=2 $(DEMO) tables compare_icebreaker,$(DEMO) tables compare_icebreaker icebreaker icebreaker_netlist)

demo-ulx3s: build ## build build/release/demo/ulx3s.bit, the same on a ULX3S of ULX3S_CELLS=12 (or 25, 45, 85; thousands)
	@$(DEPS) rtl boards
	@$(DEMO) tables tmds $(if $(SHORT),,compare_ulx3s ulx3s_circuit ulx3s_netlist ulx3s)

demo-film: short-docs build ## draw the board's film for docs/hardware.md by Verilator
	@$(DEPS) rtl boards
	@$(if $(SHORT),PICTURES=2 )FILM=$(CURDIR)/$(DOCS)/images/rtl-demo.gif STILL=$(CURDIR)/$(DOCS)/images/rtl-demo.png $(DEMO) tables film

demo-window: build ## run the simulated board in a window: keys 1, 2, 3 are its buttons
	@$(DEPS) rtl view
	@$(if $(SHORT),SDL_VIDEODRIVER=dummy WINDOW_PICTURES=2 )$(DEMO) tables window

bench: short-docs ## time kernels, frames and whole processes (medians); rewrites docs/performance.md
	@$(DEPS) build demo bench
	@$(MAKE) --no-print-directory program-all CMAKE_FLAGS=-DBURNISH_BENCH=ON
	@./bench/run build/release $(if $(SHORT),--quick)
	@python3 scripts/tables performance build/release/kernels.csv $(DOCS)/performance.md

.PHONY: bench-q15
bench-q15: short-docs ## time the integer arrays beside the kernels in floating point (seconds); fills docs/fixed-point.md
	@$(DEPS) build
	@$(MAKE) --no-print-directory program-bench_q15
	@rm -rf build/q15 && mkdir -p build/q15
	@./build/release/bench_q15 build/q15 $(if $(SHORT),quick)
	@python3 scripts/tables fill build/q15 $(DOCS)/fixed-point.md

bench-scale: short-docs ## time and memory up to MOST=100000000 triangles and 16384x16384 pixels; rewrites their tables
	@$(MAKE) --no-print-directory program-all CMAKE_FLAGS=-DBURNISH_BENCH=ON
	@python3 scripts/tables scale build/release/bench_scale build/release/burnish build/release $(DOCS)/performance.md $(MOST)

bench-peers: short-docs ## time frames and whole processes against other renderers (minutes); fills docs/frames.md. MESHES=FOLDER: frames of its files; PARTS=FOLDER: processes
	@./scripts/need-folder MESHES "$(MESHES)" PARTS "$(PARTS)"
	@$(DEPS) build demo
	@$(if $(SHORT),,$(DEPS) peers || echo "bench-peers: going on with the peers that are installed")
	@$(MAKE) --no-print-directory program-bench_peers_programs CMAKE_FLAGS=-DBURNISH_BENCH_PEERS=ON
	@./bench/peers/run build/release $(ROUNDS)
	@$(if $(MESHES),,python3 scripts/tables frames $(if $(PARTS),--parts "$(PARTS)") build/release $(DOCS)/frames.md)

bench-load: short-docs ## time loading meshes beside other libraries; fills docs/loading.md. FILES=FOLDER: its files, printed only
	@./scripts/need-folder FILES "$(FILES)"
	@$(DEPS) build
	@$(if $(SHORT),,$(DEPS) peers || echo "bench-load: going on with the peers that are installed")
	@$(MAKE) --no-print-directory program-bench_load_programs CMAKE_FLAGS=-DBURNISH_BENCH_PEERS=ON
	@mkdir -p build/load
	@./bench/load/run build/release/bench/load build/load/torus $(if $(SHORT),1 40)
	$(if $(FILES),,@python3 scripts/tables fill build/load $(DOCS)/loading.md)

.PHONY: bench-serve
bench-serve: short-docs ## time pictures one after another, by requests to serve-stdio and by a process each; fills docs/serve.md
	@$(MAKE) --no-print-directory program-bench_serve CMAKE_FLAGS=-DBURNISH_BENCH=ON
	@mkdir -p build/serve/tables
	@build/release/bench_serve build/release/burnish build/serve $(if $(SHORT),10) >build/serve/tables/latency
	@python3 scripts/tables fill build/serve/tables $(DOCS)/serve.md

.PHONY: bench-batch
bench-batch: short-docs ## processor time of a picture of burnish batch, in the plain and the default look; fills docs/batch.md
	@$(MAKE) --no-print-directory program-bench_batch CMAKE_FLAGS=-DBURNISH_BENCH=ON
	@mkdir -p build/batch/tables
	@build/release/bench_batch build/release/burnish build/batch $(if $(SHORT),1) >build/batch/tables/rate
	@python3 scripts/tables fill build/batch/tables $(DOCS)/batch.md

.PHONY: bench-shaders
bench-shaders: short-docs ## time highlights in a full-screen pass on this machine's OpenGL ES; fills docs/shaders.md
	@$(DEPS) shaders
	@$(MAKE) --no-print-directory program-bench_shaders CMAKE_FLAGS=-DBURNISH_BENCH_PEERS=ON
	@$(MAKE) --no-print-directory program-half_table
	@python3 scripts/tables shaders build/release/bench/shaders/bench_shaders build/release/test/half_table $(DOCS)/shaders.md $(if $(SHORT),3)

install: ## install program, libraries, headers and man page (DESTDIR, PREFIX), building nothing else
	@$(DEPS) build
	@cmake --preset $(PRESET) >/dev/null
	@cmake --build --preset $(PRESET) -j $(JOBS) --target burnish_installed
	@$(if $(SHORT),DESTDIR=$(CURDIR)/build/short/install )cmake --install $(BUILD) $(if $(PREFIX),--prefix $(PREFIX))

.PHONY: dist
DIST = $(if $(SHORT),build/short/dist,build/dist)
dist: ## build what is released into build/dist, twice with the same bytes, and test it (long; its chroot needs root)
	@$(DEPS) build test $(if $(SHORT),,dist)
	@./packaging/dist $(DIST) headers $(if $(SHORT),,static windows debian arduino)
	@./packaging/test/run $(DIST) build/dist-test

check-targets: ## every other target of this list in its short form
	@./scripts/check-targets

clean: ## remove everything that was built
	@rm -rf build out
