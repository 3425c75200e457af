# The front door: `make help` lists the targets, and ./make does the same where make itself is missing.
# Jobs that measure, prove or pack something are in scripts/job; test tiers are labels of CTest (test/CMakeLists.txt).
.DEFAULT_GOAL := help
PRESET ?= release
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
GROUPS ?= build test
DEPS = @./scripts/install-deps
JOB_NAMES := $(shell ./scripts/job --list)

# Without a terminal, on which ninja rewrites one line, a build prints what fails and nothing else.
# $(call build,PRESET,TARGET,CMAKE_OPTIONS) and $(call test,PRESET,CTEST_OPTIONS); ONLY=NAME or ONLY=NAME:CASE runs one test.
build = @echo "building build/$1 ($2)"; cmake --preset $1 $3 >/dev/null && cmake --build --preset $1 -j $(JOBS) --target $2 -- $$([ -t 1 ] || echo --quiet)
only = $(if $(ONLY),-V -R '^$(firstword $(subst :, ,$(ONLY)))$$',$1)
test = @BURNISH_TEST_ONLY='$(word 2,$(subst :, ,$(ONLY)))' ./scripts/ctest $1 -j $(JOBS) $(call only,$2)

.PHONY: help
help: ## list the targets
	@echo "make TARGET, to build and to test:"
	@awk -F ':.*## ' '/^[a-z][a-z -]*:.*## / {printf "  %-15s %s\n", $$1, $$2}' Makefile
	@echo "make JOB, to measure, prove, draw and pack:"
	@./scripts/job --help

.PHONY: deps
deps: ## install Debian packages by sudo: those that demo and test need, or GROUPS="test-all peers ..."
	$(DEPS) --sudo $(GROUPS)

.PHONY: build
build: ## build the program: build/release/burnish
	$(DEPS) build
	$(call build,$(PRESET),burnish_cli)

.PHONY: demo
demo: ## render two teapots, and print where they are
	$(DEPS) build
	$(call build,$(PRESET),burnish_cli)
	@./scripts/demo build/$(PRESET)/burnish out/demo
	@echo "the program:                 build/$(PRESET)/burnish"
	@echo "try it:                      build/$(PRESET)/burnish :teapot out/teapot.png"

.PHONY: install
install: ## install program, libraries, headers and man page (DESTDIR, PREFIX), building nothing else
	$(DEPS) build
	$(call build,$(PRESET),burnish_installed)
	@cmake --install build/$(PRESET) $(if $(PREFIX),--prefix $(PREFIX))
	@# the loader finds a library of /usr/local in its cache only
	@if [ -z "$(DESTDIR)" ] && [ "$$(id -u)" -eq 0 ] && command -v ldconfig >/dev/null; then ldconfig; fi

.PHONY: test
test: ## build and run the tests that need no special tools; ONLY=NAME or ONLY=NAME:CASE for one of them
	$(DEPS) build test
	$(call build,$(PRESET),all)
	$(call test,$(PRESET),-L '^(unit|cli)$$')

.PHONY: test-all
test-all: ## also other processors, hardware, firmware, figures and other compilers (minutes)
	$(DEPS) build test-all demo
	$(call build,$(PRESET),all)
	$(call test,$(PRESET),-LE '^job$$')

.PHONY: desktop
desktop: ## test the thumbnailer and the other files of desktops
	$(DEPS) build test desktop
	$(call build,release,all)
	$(call test,release,-L '^desktop$$')

.PHONY: check
check: format-check ## format, the tests that matter under each sanitizer, a little fuzzing
	$(DEPS) build test check
	$(call build,asan,tests_asan)
	$(call test,asan,-L '^asan$$')
	$(call build,tsan,tests_tsan)
	$(call test,tsan,-L '^tsan$$')
	$(call build,msan,tests_msan)
	$(call test,msan,-L '^msan$$')

.PHONY: asan tsan msan
asan tsan msan: ## one sanitizer's tests, also those that take long, and with wide vectors
	$(DEPS) build test check
	$(call build,$@,all,$(if $(filter asan,$@),-DBURNISH_WIDE_VECTORS=ON))
	$(call test,$@,-L '^$@')

.PHONY: clang scalar
clang scalar: ## tests of the optimised clang build, and of one without vector instructions
	$(DEPS) build test check
	$(call build,$@,all)
	$(call test,$@,-LE '^job$$')

.PHONY: format format-check
format: ## format the sources with clang-format
	$(DEPS) check
	@./scripts/format

format-check: ## fail if a source is not formatted
	$(DEPS) check
	@./scripts/format --check

.PHONY: golden
golden: build ## rewrite test/golden/pixels.txt after a deliberate change of pixels
	@./test/integration/golden.sh build/$(PRESET)/burnish build/golden --update

.PHONY: clean
clean: ## remove everything that was built
	@rm -rf build out

.PHONY: $(JOB_NAMES)
$(JOB_NAMES):
	@./scripts/job $@
