/* Contexts, and memory that goes through them. */
#include <stdint.h>

#include "base/context.h"
#include "base/error.h"
#include "base/memory.h"
#include "support.h"

static void check_refused(const burnish_context_options *options, const char *text) {
    burnish_error error = {BURNISH_STATUS_OK, ""};
    burnish_context *context = (burnish_context *)&error;
    CHECK1(burnish_context_create(options, &context, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, text);
    CHECK1(context == NULL);
}

static void *no_memory(void *user_data, size_t size, size_t alignment) {
    (void)user_data, (void)size, (void)alignment;
    return NULL;
}

static void release_nothing(void *user_data, void *memory) {
    (void)user_data, (void)memory;
}

static void run_nothing(void *user_data, int count, void (*task)(void *data, int index),
                        void *data) {
    (void)user_data, (void)count, (void)task, (void)data;
}

static void test_refusals(void) {
    burnish_error error;
    burnish_context_options options = {0};
    CHECK1(burnish_context_create(&options, NULL, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "context: NULL; pass where to put it");
    check_refused(NULL, "context options: not initialised; start from "
                        "burnish_context_options_default()");
    check_refused(&options, "context options: not initialised; start from "
                            "burnish_context_options_default()");
    options = burnish_context_options_default();
    options.allocator.allocate = no_memory;
    check_refused(&options, "context options: allocator has one function of two; set both, or "
                            "neither");
    options = burnish_context_options_default();
    options.tasks = (burnish_task_runner){0, run_nothing, NULL};
    check_refused(&options, "context options: tasks.thread_count is 0; expected 1 to 1024");
    options.tasks.thread_count = 1025;
    check_refused(&options, "context options: tasks.thread_count is 1025; expected 1 to 1024");
    options = burnish_context_options_default();
    options.allocator = (burnish_allocator){no_memory, release_nothing, NULL};
    burnish_context *context;
    CHECK1(burnish_context_create(&options, &context, &error) == BURNISH_STATUS_MEMORY);
    CHECK1(context == NULL);
    burnish_context_destroy(NULL);
}

/* An allocator that counts and sees to what it promises. */
typedef struct counts {
    int live, wrong;
} counts;

static void *count_allocate(void *user_data, size_t size, size_t alignment) {
    counts *c = user_data;
    c->wrong += size == 0 || alignment > 64 || (alignment & (alignment - 1)) != 0;
    ++c->live;
    return aligned_alloc(alignment, size);
}

static void count_release(void *user_data, void *memory) {
    counts *c = user_data;
    c->wrong += memory == NULL;
    --c->live;
    free(memory);
}

/* Arrays of every size, aligned, kept while they grow. */
static void check_arrays(const burnish_context *context) {
    burnish_error error;
    burnish_memory memory = burnish_memory_of(context, &error);
    for (size_t count = 1; count < 2000; count += count / 3 + 1) {
        uint8_t *items = burnish_allocate_zeroed(&memory, count, 3, "items");
        if (!CHECK(items && (uintptr_t)items % BURNISH_ALIGNMENT == 0, "%zu items", count)) {
            return;
        }
        int sum = 0;
        for (size_t i = 0; i < 3 * count; ++i) {
            sum += items[i];
        }
        CHECK(sum == 0, "%zu items are not cleared", count);
        burnish_release(context, items);
    }
    size_t capacity = 0;
    uint32_t *numbers = NULL;
    for (uint32_t i = 0; i < 5000; ++i) {
        numbers = burnish_reserve(&memory, numbers, &capacity, i + 1, sizeof *numbers, "numbers");
        numbers[i] = i * 7;
    }
    int wrong = 0;
    for (uint32_t i = 0; i < 5000; ++i) {
        wrong += numbers[i] != i * 7;
    }
    CHECK(wrong == 0 && capacity >= 5000, "%d numbers lost, capacity %zu", wrong, capacity);
    uint32_t *same =
        burnish_reserve_discard(&memory, numbers, &capacity, 100, sizeof *numbers, "numbers");
    CHECK1(same == numbers);
    numbers =
        burnish_reserve_discard(&memory, numbers, &capacity, 100000, sizeof *numbers, "numbers");
    CHECK1(numbers && capacity == 100000 && memory.status == BURNISH_STATUS_OK);
    numbers[0] = 3;
    numbers[9] = 4;
    numbers = burnish_shrink(context, numbers, &capacity, 10, sizeof *numbers);
    CHECK1(capacity == 10 && numbers[0] == 3 && numbers[9] == 4);
    burnish_release(context, numbers);
    CHECK1(burnish_allocate(&memory, 0, 8, "nothing") == NULL);
    CHECK1(memory.status == BURNISH_STATUS_OK);
    burnish_release(context, NULL);
}

/* What can't be had is said once; later requests fail with it. */
static void check_shortage(const burnish_context *context) {
    burnish_error error = {BURNISH_STATUS_OK, ""};
    burnish_memory memory = burnish_memory_of(context, &error);
    size_t capacity = 0;
    CHECK1(burnish_allocate(&memory, SIZE_MAX / 2, 3, "items") == NULL);
    CHECK1(memory.status == BURNISH_STATUS_LIMIT && error.status == BURNISH_STATUS_LIMIT);
    CHECK1(strstr(error.text, "items: ") == error.text);
    error.text[0] = 0;
    CHECK1(burnish_allocate(&memory, 1, 1, "more") == NULL);
    CHECK1(burnish_reserve(&memory, NULL, &capacity, 1, 1, "more") == NULL && capacity == 0);
    CHECK1(error.text[0] == 0 && memory.status == BURNISH_STATUS_LIMIT);

    memory = burnish_memory_of(context, &error);
    uint8_t *items = burnish_reserve(&memory, NULL, &capacity, 10, 1, "items");
    const size_t before = capacity;
    CHECK1(burnish_reserve(&memory, items, &capacity, SIZE_MAX - 1, 2, "items") == items);
    CHECK1(capacity == before && memory.status == BURNISH_STATUS_LIMIT);
    burnish_release(context, items);
}

static void test_memory_of(int own) {
    counts c = {0, 0};
    burnish_error error;
    burnish_context_options options = burnish_context_options_default();
    if (own) {
        options.allocator = (burnish_allocator){count_allocate, count_release, &c};
    }
    burnish_context *context = NULL;
    CHECK_OK(burnish_context_create(&options, &context, &error), error);
    CHECK1(c.live == own);
    check_arrays(context);
    check_shortage(context);
    CHECK(c.live == own && c.wrong == 0, "%d allocations left, %d wrong", c.live - own, c.wrong);
    burnish_context_destroy(context);
    CHECK1(c.live == 0);
}

static void test_version(void) {
    char text[32];
    snprintf(text, sizeof text, "%d.%d.%d", BURNISH_VERSION_MAJOR, BURNISH_VERSION_MINOR,
             BURNISH_VERSION_PATCH);
    CHECK_TEXT(burnish_version(), text);
    CHECK1(burnish_version_number() == BURNISH_VERSION_NUMBER);
}

/* Each status has a text and an exit code of its own; values outside the list have these. */
static void test_statuses(void) {
    for (int i = 0; i < BURNISH_STATUS_COUNT; ++i) {
        const char *text = burnish_status_text((burnish_status)i);
        CHECK(text[0] != 0 && strcmp(text, "unknown status") != 0, "status %d: %s", i, text);
        for (int k = 0; k < i; ++k) {
            CHECK(strcmp(text, burnish_status_text((burnish_status)k)) != 0, "%d and %d: %s", i, k,
                  text);
            CHECK(burnish_status_exit_code((burnish_status)i) !=
                      burnish_status_exit_code((burnish_status)k),
                  "%d and %d have one exit code", i, k);
        }
    }
    CHECK1(burnish_status_exit_code(BURNISH_STATUS_OK) == 0);
    CHECK_TEXT(burnish_status_text(BURNISH_STATUS_COUNT), "unknown status");
    CHECK_TEXT(burnish_status_text((burnish_status)-1), "unknown status");
    CHECK1(burnish_status_exit_code((burnish_status)-1) == 1);
}

/* Every errno has a text, also one that no system has. */
static void test_reasons(void) {
    CHECK1(burnish_errno_reason(2).text[0] != 0);
    CHECK_TEXT(burnish_errno_reason(2).text, strerror(2));
    CHECK1(burnish_errno_reason(99999).text[0] != 0);
}

/* Writes a code as UTF-8, and returns its size. */
static int encode(unsigned code, char text[8]) {
    const int size = code < 0x80 ? 1 : code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (int i = size - 1; i >= 0; --i) {
        const unsigned lead = size == 1 ? 0 : (0xF0U << (4 - size)) & 0xFF;
        text[i] = (char)(i > 0 ? 0x80 | (code & 0x3F) : lead | code);
        code >>= i > 0 ? 6 : 0;
    }
    text[size] = 0;
    return size;
}

/* What messages replace: controls (categories Cc, Zl, Zp) and what Unicode calls Bidi_Control, except
 * marks; bytes that are not UTF-8. */
static void test_clean_text(void) {
    static const char *const invalid[] = {
        "\x80", "\xC2", "\xC1\x81", "\xE2\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xFF"};
    int replaced = 0;
    for (unsigned code = 1; code < 0x110000; ++code) {
        const int is_control = code < 0x20 || (code >= 0x7F && code <= 0x9F) ||
                               (code >= 0x2028 && code <= 0x202E) ||
                               (code >= 0x2066 && code <= 0x2069);
        const int is_invalid = code >= 0xD800 && code < 0xE000; /* surrogates */
        char text[8], clean[8];
        const int size = encode(code, text);
        memcpy(clean, text, sizeof clean);
        burnish_clean_text(clean);
        const int is_kept = strcmp(clean, text) == 0;
        const int is_gone = (int)strspn(clean, "?") == size;
        replaced += is_gone && code != '?';
        CHECK(is_control || is_invalid ? is_gone : is_kept, "U+%04X", code);
    }
    CHECK(replaced == 31 + 33 + 7 + 4 + 0x800, "%d", replaced);
    for (size_t i = 0; i < sizeof invalid / sizeof *invalid; ++i) {
        char text[8];
        snprintf(text, sizeof text, "%s", invalid[i]);
        burnish_clean_text(text);
        CHECK(strspn(text, "?") == strlen(invalid[i]), "%zu: \"%s\"", i, text);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_refusals());
    RUN(test_memory_of(0));
    RUN(test_memory_of(1));
    RUN(test_version());
    RUN(test_statuses());
    RUN(test_reasons());
    RUN(test_clean_text());
    return test_end("context");
}
