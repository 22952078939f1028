# lrcs: settings, targets, rules. Everything built goes under $(BUILD).
#   make            the tool build/lrcs and the library build/liblrcs.a
#   make demo       sigma of the built-in satellite, with a picture
#   make charts     accuracy against time, for the README
#   make study      what sigma of simple bodies depends on: examples/study/results anew
#   make install    under PREFIX (/usr/local), in DESTDIR: tool, libraries, headers, manual, completion
#   make test       every test (needs cmocka; gets it by itself where it can)
#   make asan tsan lint purity layers fuzz coverage coverage-above    further checks
#   make amalgamation       the core as two files, build/amalgamation/lrcs.c and lrcs.h, and its tests on them
#   make flight portable    on a Cortex-M7 (needs gcc-arm-none-eabi, qemu); on four other machines (qemu-user)
#   make operations misra   steps a pose takes, beside the most; MISRA C:2012 and its deviations
#   make stack              what the core takes of the stack: no recursion, the deepest chain of calls
#   make gpu                the paper's method in OpenGL, judged by the conformance kit
#   make hard               the hard cases beside plain formulas, which fail on most of them
#   make bench scaling      what poses cost on this machine, beside other engines, and how that grows
# Compiling prints one line a file; V=1 prints the commands instead.

# --- settings ------------------------------------------------------------------------------------
CC       = gcc
AR       = ar
BUILD    = build
OPT      = -O2
# Tests spend their time in the library, and compile in half the time without optimisation.
TEST_OPT = $(OPT:-O2=-O0)
STD      = -std=c11 -pedantic -ffp-contract=off
WARN     = -Wall -Wextra -Werror -Wshadow -Wconversion -Wsign-conversion -Wstrict-prototypes \
           -Wmissing-prototypes -Wold-style-definition -Wcast-qual -Wcast-align -Wwrite-strings \
           -Wpointer-arith -Wformat=2 -Wundef -Wvla -Wswitch-enum -Wdouble-promotion
CFLAGS   =
# One compilation serves the static and the shared library.
PIC      = -fPIC -fno-semantic-interposition
THREADS  = -pthread
LDLIBS   = $(THREADS) -lm
# There are many tests to link, and gold takes half the time; sanitizers need the usual linker.
TEST_LD := $(if $(CFLAGS),,$(if $(shell command -v ld.gold),-fuse-ld=gold))

V        =
Q        = $(if $(V),,@)
SILENT   = $(findstring s,$(filter-out -%,$(firstword $(MAKEFLAGS))))
# $(call say,WHAT): the line for one file, before a command that begins with $(Q)
say      = $(if $(V)$(SILENT),,$(info $(NOTHING)  $(1) $@))
NOTHING  =

CORE     = base mesh optics scene view visibility integrate
CORE_SRC = $(sort $(wildcard $(CORE:%=src/%/*.c) $(CORE:%=src/%/*/*.c)))
ABOVE_SRC = $(sort $(wildcard src/analysis/*.c))
HOST_SRC = $(sort $(wildcard src/host/*.c src/host/*/*.c))
CLI_SRC  = $(sort $(wildcard src/cli/*.c src/cli/*/*.c))
TEST_SRC = $(sort $(wildcard test/*/test_*.c))
SH_TESTS = $(sort $(wildcard test/*/test_*.sh))

CORE_OBJ = $(CORE_SRC:%.c=$(BUILD)/%.o)
ABOVE_OBJ = $(ABOVE_SRC:%.c=$(BUILD)/%.o)
HOST_OBJ = $(HOST_SRC:%.c=$(BUILD)/%.o)
CLI_OBJ  = $(CLI_SRC:%.c=$(BUILD)/%.o)
TESTS    = $(TEST_SRC:%.c=$(BUILD)/%)
EXAMPLES = $(patsubst %.c,$(BUILD)/%,$(sort $(wildcard examples/*.c))) $(STUDY)
INCLUDED = $(BUILD)/demo.inc $(BUILD)/explore.inc $(BUILD)/explore_style.inc $(BUILD)/explore_controls.inc \
           $(BUILD)/style.inc $(BUILD)/readme.inc
STUDY    = $(BUILD)/examples/study/study
CORE_TESTS = $(patsubst %.c,$(BUILD)/%,$(filter $(CORE:%=test/%/%),$(TEST_SRC)))
JOINED   = $(BUILD)/amalgamation
FLIGHT   = $(BUILD)/flight
LIB      = $(BUILD)/liblrcs.a
TOOL     = $(BUILD)/lrcs
FUZZ_TARGETS = $(patsubst test/fuzz/fuzz_%.c,%,$(sort $(wildcard test/fuzz/fuzz_*.c)))
FUZZ_TESTS = $(FUZZ_TARGETS:%=$(BUILD)/test/fuzz/fuzz_%)
BENCH_DIR = $(BUILD)/test/bench
BENCH_OBJ = $(patsubst %.c,$(BUILD)/%.o,$(filter-out %/bench.c %/scaling.c,$(wildcard test/bench/*.c)))

# --- targets -------------------------------------------------------------------------------------
all: $(TOOL) $(LIB)

# Exit 3 says that the tolerance was not met, and is not a failure here.
demo: $(TOOL)
	$(TOOL) run demo --azel 50,40 --image $(BUILD)/demo.png || [ $$? -eq 3 ]

# The README's charts of accuracy against time, with the times of this machine.
charts: $(TOOL)
	$(TOOL) converge demo --azel 50,40 --plot examples/converge_demo.svg
	$(TOOL) converge examples/plate.toml --azel 0,70 --plot examples/converge_plate.svg
	$(TOOL) converge examples/cylinder.toml --azel 0,30 --plot examples/converge_cylinder.svg
	$(TOOL) converge examples/cone.toml --azel 0,30 --plot examples/converge_cone.svg

# Tables, plots and laws as they are kept; the same bytes every time.
study: $(STUDY)
	$(STUDY) -o examples/study/results

# Shell tests first: they take longest, and would leave a processor idle at the end.
test: cmocka $(TOOL) $(TESTS) $(EXAMPLES) $(BENCH_DIR)/bench $(BENCH_DIR)/scaling $(FUZZ_TESTS)
	@sh test/run.sh $(TOOL) $(SH_TESTS) $(TESTS)

# Tests take far longer than the compiler, so the library is optimised; large pages save the kernel most of
# the time that AddressSanitizer's marks of large work areas take.
asan: cmocka
	ASAN_OPTIONS=no_huge_pages_for_shadow=0:$$ASAN_OPTIONS \
	$(MAKE) BUILD=$(BUILD)/asan OPT="-O2 -g1" TEST_OPT="-O0 -g1" CFLAGS="$(SANITIZE)" \
	    LDLIBS="$(SANITIZE) $(THREADS) -lm" test
SANITIZE = -fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all -fno-omit-frame-pointer

# The threads under ThreadSanitizer.
tsan: cmocka
	$(MAKE) BUILD=$(BUILD)/tsan OPT="-O1 -g" CFLAGS=-fsanitize=thread LDLIBS="-fsanitize=thread $(THREADS) -lm" \
	    $(BUILD)/tsan/test/host/test_sweep $(BUILD)/tsan/test/host/test_refine
	$(BUILD)/tsan/test/host/test_sweep
	$(BUILD)/tsan/test/host/test_refine

lint: $(INCLUDED)
	sh test/lint.sh $(BUILD)

purity: $(LIB)
	sh test/purity.sh $(CORE_OBJ)

layers:
	sh test/layers.sh

# The core joined into two files, which compile alone, and the core's own tests on them.
amalgamation: cmocka $(CORE_TESTS:$(BUILD)/%=$(JOINED)/%)
	@sh test/run.sh $(TOOL) $(filter $(JOINED)/test/%,$^)

# What the core takes of the stack here, and on a Cortex-M7 where its compiler is installed.
stack: $(JOINED)/lrcs.c
	@for compiler in gcc "$(ARM) $(CORTEX_M7)"; do \
	    command -v $${compiler%% *} >/dev/null || continue; \
	    echo "$$compiler $(OPT)"; \
	    $$compiler $(STD) $(OPT) -fcallgraph-info=su -c -o $(JOINED)/stack.o $< && \
	    sh test/stack.sh $(JOINED)/stack.ci || exit 1; \
	done
ARM       = arm-none-eabi-gcc
CORTEX_M7 = -mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard

# examples/flight here, and on an emulated Cortex-M7: what it prints, its code size.
flight: $(FLIGHT)/task $(FLIGHT)/task.elf
	$(FLIGHT)/task
	arm-none-eabi-size $(FLIGHT)/task.elf
	qemu-system-arm -M mps2-an500 -nographic -icount shift=0 -semihosting-config enable=on,target=native \
	    -kernel $(FLIGHT)/task.elf </dev/null

# How many steps a pose takes, counted, beside how many it may take at most.
operations: $(JOINED)/lrcs.c
	sh test/flight/operations.sh $(JOINED)

# The core against MISRA C:2012 (needs cppcheck): every deviation has its reason in test/misra.md.
misra:
	sh test/misra.sh $(BUILD)

# The core's tests and a digest of its results on other machines under qemu-user, with gcc and clang,
# at -O0, -O2 and -O3: PORTABLE="MACHINES=s390x COMPILERS=gcc LEVELS=2" runs one of them.
portable: $(JOINED)/lrcs.c
	$(PORTABLE) FLAGS="$(STD)" sh test/portable/portable.sh $(JOINED) $(PORTABLE_TESTS)
PORTABLE =
# Those that take minutes under emulation are left out.
PORTABLE_TESTS = $(filter-out $(addprefix %/test_,$(addsuffix .c,bound closed cubature divide fit large \
    proximity_band mean polygon random range_shapes shadows steps switch uncertainty workspace)),$(filter $(CORE:%=test/%/%),$(TEST_SRC)))

# Every target of test/fuzz under libFuzzer and the sanitizers (needs clang), each for FUZZ_SECONDS;
# fuzz-NAME: one of them. fuzz-long, fuzz-long-NAME: FUZZ_RUNS executions of each, without
# AddressSanitizer, which takes most of the time: work areas end where memory does. FUZZ_FLAGS=-fork=2
# uses two processors. Corpora and what breaks a target are left in $(FUZZ_DIR). Comparisons are not
# watched: arithmetic would be four times slower, and the seeds hold the formats' words; nor is it
# weighed how rare what an input reaches is, which took longer than to run it.
fuzz: $(FUZZ_TARGETS:%=fuzz-%)
fuzz-long: $(FUZZ_TARGETS:%=fuzz-long-%)
fuzz-long-%:
	$(MAKE) FUZZ_DIR=$(BUILD)/fuzz-long FUZZ_SANITIZE="$(FUZZ_TRAPS)" FUZZ_LIMIT=-runs=$(FUZZ_RUNS) fuzz-$*
fuzz-%:
	$(MAKE) CC=clang BUILD=$(FUZZ_DIR) OPT="-O2 -g1" CFLAGS="-fsanitize=fuzzer-no-link $(FUZZ_CFLAGS)" \
	    $(FUZZ_DIR)/liblrcs.a
	clang $(STD) -O2 -g1 -D_XOPEN_SOURCE=700 -DFUZZ_CHOOSE -fsanitize=fuzzer $(FUZZ_CFLAGS) -Iinclude -Isrc \
	    -o $(FUZZ_DIR)/$* test/fuzz/fuzz_$*.c $(FUZZ_DIR)/liblrcs.a $(LDLIBS)
	$(MAKE) $(BUILD)/test/fuzz/fuzz_$*
	@mkdir -p $(FUZZ_DIR)/corpus/$* $(FUZZ_DIR)/seeds/$*
	$(BUILD)/test/fuzz/fuzz_$* unpack $(FUZZ_DIR)/seeds/$* test/fuzz/seeds/$*
	$(FUZZ_DIR)/$* $(FUZZ_LIMIT) -max_len=$(FUZZ_LENGTH) -entropic=0 -rss_limit_mb=3000 \
	    -print_final_stats=1 -artifact_prefix=$(FUZZ_DIR)/$*- $(FUZZ_FLAGS) \
	    $(FUZZ_DIR)/corpus/$* $(FUZZ_DIR)/seeds/$*
FUZZ_DIR      = $(BUILD)/fuzz
FUZZ_SECONDS  = 20
FUZZ_RUNS     = 10000000
FUZZ_LIMIT    = -max_total_time=$(FUZZ_SECONDS)
FUZZ_LENGTH   = 512
FUZZ_FLAGS    =
FUZZ_SANITIZE = $(SANITIZE)
FUZZ_TRAPS    = -fsanitize=bounds,shift,signed-integer-overflow,integer-divide-by-zero,float-cast-overflow \
                -fsanitize-trap=all
FUZZ_CFLAGS   = $(FUZZ_SANITIZE) -fno-sanitize-coverage=trace-cmp
# Scenes of few facets: they meet in as many ways.
fuzz-pose:   FUZZ_LENGTH = 80
fuzz-curved: FUZZ_LENGTH = 60

# Lines and branches of the core that its own tests run.
coverage: cmocka
	@mkdir -p $(BUILD)/coverage
	find $(BUILD)/coverage -name '*.gcda' -exec rm -f {} +
	$(MAKE) BUILD=$(BUILD)/coverage OPT=-O0 CFLAGS=--coverage LDLIBS="--coverage $(THREADS) -lm" test-core
	sh test/coverage.sh $(BUILD)/coverage
# The same figures of src/host and src/analysis by their tests and the tool's, for information.
coverage-above: cmocka
	@mkdir -p $(BUILD)/coverage
	find $(BUILD)/coverage -name '*.gcda' -exec rm -f {} +
	$(MAKE) BUILD=$(BUILD)/coverage OPT=-O0 CFLAGS=--coverage LDLIBS="--coverage $(THREADS) -lm" test-above
	sh test/coverage.sh $(BUILD)/coverage host analysis
ABOVE_TESTS = $(patsubst %.c,$(BUILD)/%,$(filter test/host/% test/analysis/%,$(TEST_SRC)))
# What builds anew, or limits the address space, which the counters do not fit, is left out.
test-above: $(TOOL) $(ABOVE_TESTS) $(EXAMPLES)
	@sh test/run.sh $(TOOL) $(ABOVE_TESTS) $(filter-out $(addprefix %/test_,$(addsuffix .sh,install limits \
	    report_browser runner)),$(filter test/host/% test/cli/%,$(SH_TESTS)))
test-core: $(TOOL) $(CORE_TESTS) $(FUZZ_TESTS)
	@sh test/run.sh $(TOOL) $(CORE_TESTS) test/fuzz/test_replay.sh

# Every proved bound on BOUNDS_SCENES scenes of each kind with exact answers, and what the estimate is
# worth (needs python3, mpmath).
bounds: $(LIB)
	@mkdir -p $(BUILD)/test/hostile
	$(CC) $(STD) $(OPT) -Wall -Wextra -Iinclude -Isrc -o $(BUILD)/test/hostile/bounds test/hostile/bounds.c $(LIB) $(LDLIBS)
	for kind in hostile plain lattice contacts doubled far; do \
	    python3 test/hostile/bounds.py $(BOUNDS_SCENES) $(BOUNDS_SEED) $$kind >$(BUILD)/test/hostile/$$kind && \
	    $(BUILD)/test/hostile/bounds $(BUILD)/test/hostile/$$kind || exit 1; \
	done
# Areas by cells of the view plane against the clipping that they replaced, on MODELS from AGREE
# directions each: third-party models beside the checkout, not part of the repository.
agree: $(LIB)
	@mkdir -p $(BUILD)/test/visibility
	$(CC) $(STD) $(OPT) $(WARN) -Iinclude -Isrc -Itest -o $(BUILD)/test/visibility/agree \
	    test/visibility/agree.c test/visibility/reference/*.c $(LIB) $(LDLIBS)
	$(BUILD)/test/visibility/agree $(AGREE) $(MODELS)
AGREE  = 100
MODELS = $(sort $(wildcard ../shared/models/*.3ds ../shared/models/*.obj ../shared/models/*.stl))

BOUNDS_SCENES = 500
BOUNDS_SEED   = 1

# What the estimate is worth on the demo and on ESTIMATE_MODELS, against method exact.
estimate: $(LIB)
	@mkdir -p $(BUILD)/test/hostile
	$(CC) $(STD) $(OPT) -Wall -Wextra -Iinclude -o $(BUILD)/test/hostile/estimate test/hostile/estimate.c $(LIB) $(LDLIBS)
	$(BUILD)/test/hostile/estimate $(ESTIMATE_DIRECTIONS) $(ESTIMATE_SEED) demo $(ESTIMATE_MODELS)
ESTIMATE_DIRECTIONS = 24
ESTIMATE_SEED       = 1
ESTIMATE_MODELS     =

# The tessellation bound on SHADOWS_SCENES scenes of curved shapes in contact, flush, nested, pierced:
# a coarse mesh against a fine one, and meshes against rays over the true shapes. Then closed forms of
# shapes that nothing hides against meshes, on as many scenes.
shadows: cmocka $(BUILD)/test/integrate/test_proximity_band $(BUILD)/test/integrate/test_shapes
	$(BUILD)/test/integrate/test_proximity_band $(SHADOWS_SCENES) $(SHADOWS_SEED)
	$(BUILD)/test/integrate/test_proximity_band $(SHADOWS_SCENES) $(SHADOWS_SEED) 24
	$(BUILD)/test/integrate/test_shapes $(SHADOWS_SCENES) $(SHADOWS_SEED)
SHADOWS_SCENES = 420
SHADOWS_SEED   = 1

# What loading, preparing and whole poses cost on this machine: real models, generated scenes and
# hard cases (both from beside the checkout, not part of the repository), beside OpenGL and Embree
# where BENCH_PEERS names the folder they are built in. Tables, $(BENCH_DIR)/bench.csv and bench.svg
# (BENCH_FLAGS=--quick: a minute; "--only aura": one scene).
bench: $(BENCH_DIR)/bench
	$(BENCH_DIR)/bench $(BENCH_FLAGS) --csv $(BENCH_DIR)/bench.csv --plot $(BENCH_DIR)/bench.svg \
	    --scratch $(BENCH_DIR) $(BENCH_PEERS:%=--peers %) $(BENCH_CASES:%=--cases %) $(BENCH_MODELS)
BENCH_FLAGS  =
BENCH_PEERS  =
BENCH_CASES  = $(wildcard ../shared/cases)
BENCH_MODELS = $(wildcard ../shared/models/*.3ds ../shared/models/*.obj ../shared/models/*.stl)

# How time and memory grow with facets, pixels and depth: exponents, and the worst cases.
scaling: $(BENCH_DIR)/scaling
	$(BENCH_DIR)/scaling $(SCALING_FLAGS)
SCALING_FLAGS =

# The paper's method in OpenGL, and what the kit says of it; a verdict of exit 1 is no failure here
# (needs EGL and a driver: libegl-dev, libgl1-mesa-dri).
gpu: $(TOOL)
	@mkdir -p $(BUILD)/gpu
	$(CC) -std=c11 -O2 -Wall -Wextra -o $(BUILD)/gpu/lrcs_gl $(wildcard examples/gpu/*.c) -lEGL -lm
	$(TOOL) vectors $(BUILD)/gpu/kit --resolution 0
	$(BUILD)/gpu/lrcs_gl $(BUILD)/gpu/kit $(GPU_PIXELS) >$(BUILD)/gpu/gl.csv
	$(TOOL) compare $(BUILD)/gpu/kit $(BUILD)/gpu/gl.csv --pixels $(GPU_PIXELS) || [ $$? -eq 1 ]
GPU_PIXELS = 512
.PHONY: gpu

# The hard cases: the plain formula in doubles, the engine, and the reference with 50 digits.
hard: cmocka $(BUILD)/test/integrate/test_plain
	$(BUILD)/test/integrate/test_plain table

# The exact method on BIG_ROWS^2 * 4 facets with a closed form: ten million in 4 GB.
big: cmocka $(BUILD)/test/integrate/test_large
	$(BUILD)/test/integrate/test_large $(BIG_ROWS)
BIG_ROWS = 1600

# What goes where: the tool with its manual page and bash completion, the library for static and
# shared linking, its headers and its pkg-config file.
PREFIX   = /usr/local
DESTDIR  =
VERSION := $(shell sed -n 's/.*LRCS_VERSION_TEXT *"\(.*\)"/\1/p' include/lrcs/status.h)
# Programs built against one minor version run with no other while the major one is 0.
SONAME  := liblrcs.so.$(shell echo $(VERSION) | sed 's/^\(0\.[0-9]*\)\..*/\1/; t; s/\..*//')
SHARED   = $(BUILD)/liblrcs.so.$(VERSION)
TO       = $(DESTDIR)$(PREFIX)
MANUAL   = $(TO)/share/man/man1/lrcs.1
COMPLETE = $(TO)/share/bash-completion/completions/lrcs

install: $(TOOL) $(LIB) $(SHARED) $(BUILD)/lrcs.pc
	install -d $(TO)/bin $(TO)/lib/pkgconfig $(TO)/include/lrcs $(dir $(MANUAL)) $(dir $(COMPLETE))
	install -m 755 $(TOOL) $(TO)/bin/lrcs
	install -m 644 include/lrcs/*.h $(TO)/include/lrcs
	install -m 644 $(LIB) $(SHARED) $(TO)/lib
	ln -sf liblrcs.so.$(VERSION) $(TO)/lib/$(SONAME)
	ln -sf $(SONAME) $(TO)/lib/liblrcs.so
	install -m 644 $(BUILD)/lrcs.pc $(TO)/lib/pkgconfig
	$(TOOL) help --man >$(MANUAL)
	$(TOOL) help --bash >$(COMPLETE)

uninstall:
	rm -f $(TO)/bin/lrcs $(TO)/lib/liblrcs.a $(TO)/lib/liblrcs.so $(TO)/lib/liblrcs.so.* \
	    $(TO)/lib/pkgconfig/lrcs.pc $(MANUAL) $(COMPLETE)
	rm -rf $(TO)/include/lrcs

clean:
	rm -rf $(BUILD)

# cmocka: found, or installed, or one line that says how.
cmocka:
	@sh test/cmocka.sh $(CC)

.PHONY: all demo charts study install uninstall clean cmocka
.PHONY: test asan tsan lint purity layers amalgamation stack flight operations misra portable
.PHONY: fuzz fuzz-long coverage coverage-above test-core test-above bounds agree estimate shadows bench
.PHONY: scaling hard big
.DELETE_ON_ERROR:

# --- rules ---------------------------------------------------------------------------------------
# The folders of everything built are made once: a process for each file would take seconds.
$(shell mkdir -p $(sort $(dir $(TOOL) $(CORE_OBJ) $(ABOVE_OBJ) $(HOST_OBJ) $(CLI_OBJ) $(TESTS) $(EXAMPLES) \
    $(CORE_TESTS:$(BUILD)/%=$(JOINED)/%) $(FUZZ_TESTS) $(BENCH_OBJ) $(FLIGHT)/task)))

$(TOOL): $(CLI_OBJ) $(LIB)
	$(call say,link)
	$(Q)$(CC) -o $@ $(CLI_OBJ) $(LIB) $(LDLIBS)

$(LIB): $(CORE_OBJ) $(ABOVE_OBJ) $(HOST_OBJ)
	@rm -f $@
	$(call say,ar  )
	$(Q)$(AR) rcs $@ $^

# Only lrcs_ names are exported.
$(SHARED): $(LIB)
	$(Q)echo '{ global: lrcs_*; local: *; };' >$(BUILD)/lrcs.map
	$(call say,link)
	$(Q)$(CC) -shared -o $@ -Wl,-soname,$(SONAME) -Wl,--version-script,$(BUILD)/lrcs.map \
	    -Wl,--whole-archive $(LIB) -Wl,--no-whole-archive $(LDLIBS)

$(BUILD)/lrcs.pc: include/lrcs/status.h Makefile
	$(Q)printf '%s\n' 'prefix=$(PREFIX)' 'includedir=$${prefix}/include' 'libdir=$${prefix}/lib' '' \
	    'Name: lrcs' 'Description: laser radar cross-section of a facet mesh, with a proved bound' \
	    'Version: $(VERSION)' 'Cflags: -I$${includedir}' 'Libs: -L$${libdir} -llrcs' \
	    'Libs.private: $(LDLIBS)' >$@

$(BUILD)/src/cli/%.o: src/cli/%.c
	$(call say,cc  )
	$(Q)$(CC) $(STD) $(OPT) $(WARN) $(CFLAGS) -D_XOPEN_SOURCE=700 -Iinclude -Isrc -I$(BUILD) -MMD -MP -c -o $@ $<

$(BUILD)/src/host/%.o: src/host/%.c
	$(call say,cc  )
	$(Q)$(CC) $(STD) $(OPT) $(WARN) $(PIC) $(CFLAGS) $(THREADS) -D_XOPEN_SOURCE=700 -Iinclude -Isrc -I$(BUILD) -MMD -MP -c -o $@ $<

$(JOINED)/lrcs.c: src/amalgamate.sh $(CORE_SRC) $(wildcard $(CORE:%=src/%/*.h) $(CORE:%=src/%/*/*.h) include/lrcs/*.h)
	$(call say,join)
	$(Q)sh src/amalgamate.sh $(JOINED) $(foreach layer,$(CORE),$(filter src/$(layer)/%,$(CORE_SRC)))

$(JOINED)/lrcs.o: $(JOINED)/lrcs.c
	$(call say,cc  )
	$(Q)$(CC) $(STD) $(OPT) $(WARN) $(CFLAGS) -c -o $@ $<

$(JOINED)/test/%: $(BUILD)/test/%.o $(JOINED)/lrcs.o
	$(call say,link)
	$(Q)$(CC) -o $@ $^ -lcmocka $(LDLIBS)

$(FLIGHT)/task: $(wildcard examples/flight/*) $(LIB)
	$(call say,link)
	$(Q)$(CC) $(STD) $(OPT) $(WARN) -Iinclude -o $@ examples/flight/task.c examples/flight/main.c \
	    examples/flight/board_host.c $(LIB) $(LDLIBS)

$(FLIGHT)/task.elf: $(wildcard examples/flight/*) $(JOINED)/lrcs.c
	$(call say,link)
	$(Q)$(ARM) $(CORTEX_M7) $(STD) $(OPT) -ffunction-sections -I$(JOINED) -Iinclude -nostartfiles -Wl,--gc-sections \
	    -T examples/flight/board_m7.ld -o $@ examples/flight/task.c examples/flight/main.c \
	    examples/flight/board_m7.c $(JOINED)/lrcs.c -lm

# The built-in scene, the fixed parts of HTML pages and the text of a kit, as the bytes of C arrays.
$(BUILD)/demo.inc: examples/satellite.toml
$(BUILD)/explore.inc: src/cli/report/explore.js
$(BUILD)/explore_style.inc: src/cli/report/explore.css
$(BUILD)/explore_controls.inc: src/cli/report/explore.html
$(BUILD)/style.inc: src/cli/report/style.css
$(BUILD)/readme.inc: src/host/kit/readme.md
$(INCLUDED):
	$(call say,gen )
	$(Q)od -An -v -td1 $< | sed 's/-*[0-9][0-9]*/&,/g' >$@

# The flags stand in this file.
$(CORE_OBJ) $(ABOVE_OBJ) $(HOST_OBJ): Makefile

$(BUILD)/src/host/scene/demo.o: $(BUILD)/demo.inc
$(BUILD)/src/cli/report/explore.o: $(BUILD)/explore.inc $(BUILD)/explore_style.inc $(BUILD)/explore_controls.inc
$(BUILD)/src/cli/report/page.o: $(BUILD)/style.inc
$(BUILD)/src/host/kit/files.o: $(BUILD)/readme.inc

$(BUILD)/src/%.o: src/%.c
	$(call say,cc  )
	$(Q)$(CC) $(STD) $(OPT) $(WARN) $(PIC) $(CFLAGS) -Iinclude -Isrc -MMD -MP -c -o $@ $<

$(BUILD)/examples/%: examples/%.c $(LIB)
	$(call say,link)
	$(Q)$(CC) $(STD) $(OPT) $(WARN) $(CFLAGS) -Iinclude -o $@ $< $(LIB) $(LDLIBS)

$(STUDY): $(wildcard examples/study/*.[ch]) $(LIB)
	$(call say,link)
	$(Q)$(CC) $(STD) $(OPT) $(WARN) $(CFLAGS) -D_XOPEN_SOURCE=700 -Iinclude -o $@ $(filter %.c,$^) $(LIB) $(LDLIBS)

# Tests compute references in long double, of which clang warns at every step.
$(BUILD)/test/%.o: test/%.c
	$(call say,cc  )
	$(Q)$(CC) $(STD) $(TEST_OPT) $(WARN) -Wno-double-promotion $(CFLAGS) -D_XOPEN_SOURCE=700 -Iinclude -Isrc -Itest -MMD -MP -c -o $@ $<

$(BUILD)/test/%: $(BUILD)/test/%.o $(LIB)
	$(call say,link)
	$(Q)$(CC) $(TEST_LD) -o $@ $< $(LIB) -lcmocka $(LDLIBS)

# Every allocation of the library goes through the test that refuses them.
$(BUILD)/test/host/test_memory: override LDLIBS += \
    -Wl,--wrap=malloc,--wrap=calloc,--wrap=realloc,--wrap=free,--wrap=strdup,--wrap=realpath,--wrap=fdopen

# Tests are compiled once cmocka is there.
$(TEST_SRC:%.c=$(BUILD)/%.o): | cmocka

# A fuzz target with a driver in the place of libFuzzer.
$(BUILD)/test/fuzz/fuzz_%: $(BUILD)/test/fuzz/fuzz_%.o $(BUILD)/test/fuzz/replay.o $(LIB)
	$(call say,link)
	$(Q)$(CC) $(TEST_LD) -o $@ $^ $(LDLIBS)

# The benchmarks tell how they were built.
$(BENCH_DIR)/%.o: TEST_OPT = $(OPT)
$(BENCH_DIR)/measure.o: override CFLAGS += -DBENCH_BUILD='"$(CC) $(STD) $(OPT)"'
$(BENCH_DIR)/%: $(BENCH_DIR)/%.o $(BENCH_OBJ) $(LIB)
	$(call say,link)
	$(Q)$(CC) -o $@ $< $(BENCH_OBJ) $(LIB) $(LDLIBS)

.SECONDARY: $(BENCH_OBJ) $(FUZZ_TESTS:%=%.o) $(BUILD)/test/fuzz/replay.o $(TEST_SRC:%.c=$(BUILD)/%.o)
-include $(CORE_OBJ:.o=.d) $(ABOVE_OBJ:.o=.d) $(HOST_OBJ:.o=.d) $(CLI_OBJ:.o=.d) $(TEST_SRC:%.c=$(BUILD)/%.d) $(wildcard $(BENCH_DIR)/*.d $(BUILD)/test/fuzz/*.d)
