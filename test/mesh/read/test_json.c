/* The strict reader of JSON. */
#include "mesh/read/io/json.h"

#include "reader_input.h"

typedef struct json_case {
    burnish_mesh_data mesh;
    burnish_error error;
    burnish_json json;
} json_case;

static burnish_status parse(json_case *c, const char *text, size_t size) {
    const burnish_reader_input input = {.bytes = (const uint8_t *)text, .size = size, .name = "a"};
    c->error = (burnish_error){0};
    c->mesh = burnish_mesh_data_begin(NULL, NULL, &c->error);
    burnish_reader reader = {.input = &input, .mesh = &c->mesh, .error = &c->error};
    return burnish_json_parse(&reader, input.bytes, size, &c->json);
}

static void end(json_case *c) {
    burnish_json_destroy(NULL, &c->json);
    burnish_mesh_data_destroy(&c->mesh);
}

static void test_values(void) {
    static const char text[] = " {\"a\" : [1, -2.5e-1,0 ,true,false,null,{}, []],\n"
                               "\"b\":{\"c\":\"x\\n\\u00e9\\ud83d\\ude00\\\"\\/\"},\"a\":7 } \n";
    json_case c;
    CHECK_OK(parse(&c, text, sizeof text - 1), c.error);
    const burnish_json *j = &c.json;
    const uint32_t a = burnish_json_member(j, 0, "a"), b = burnish_json_member(j, 0, "b");
    CHECK1(j->nodes[0].kind == BURNISH_JSON_OBJECT && j->nodes[0].size == 3);
    CHECK1(burnish_json_length(j, a) == 8 && burnish_json_length(j, b) == 0);
    static const burnish_json_kind kinds[8] = {
        BURNISH_JSON_NUMBER, BURNISH_JSON_NUMBER, BURNISH_JSON_NUMBER, BURNISH_JSON_TRUE,
        BURNISH_JSON_FALSE,  BURNISH_JSON_NULL,   BURNISH_JSON_OBJECT, BURNISH_JSON_ARRAY};
    static const double numbers[3] = {1, -0.25, 0};
    uint32_t item = a + 1;
    for (int i = 0; i < 8; ++i, item = j->nodes[item].next) {
        double number = 9;
        CHECK(burnish_json_is_kind(j, item, kinds[i]), "%d", i);
        CHECK1(burnish_json_number(j, item, &number) == (i < 3));
        CHECK1(i >= 3 || number == numbers[i]);
    }
    char word[32];
    const uint32_t s = burnish_json_member(j, b, "c");
    CHECK1(burnish_json_text(j, s, word, sizeof word) == 10);
    CHECK_TEXT(word, "x\n\xC3\xA9\xF0\x9F\x98\x80\"/");
    CHECK1(burnish_json_is_text(j, s, word) && !burnish_json_is_text(j, s, "x\n") &&
           !burnish_json_is_text(j, a, "a"));
    CHECK1(burnish_json_text(j, s, word, 6) == 4); /* no half of a character */
    CHECK_TEXT(burnish_json_path_of(j, s).text, "b.c");
    CHECK_TEXT(burnish_json_path_of(j, a + 2).text, "a[1]");
    CHECK_TEXT(burnish_json_path_of(j, 0).text, "");
    CHECK1(burnish_json_member(j, b, "a") == BURNISH_JSON_NONE);
    CHECK1(burnish_json_member(j, BURNISH_JSON_NONE, "a") == BURNISH_JSON_NONE);
    end(&c);
}

/* Half a pair of surrogates is not a character. */
static void test_surrogates(void) {
    static const char text[] = "[\"\\ud83dx\", \"\\ude00\", \"\\ud83d\\u0041\"]";
    static const char *const expected[3] = {"\xEF\xBF\xBDx", "\xEF\xBF\xBD", "\xEF\xBF\xBD\x41"};
    json_case c;
    CHECK1(parse(&c, text, sizeof text - 1) == BURNISH_STATUS_OK);
    for (uint32_t i = 0; i < 3; ++i) {
        char word[16];
        burnish_json_text(&c.json, 1 + i, word, sizeof word);
        CHECK_TEXT(word, expected[i]);
    }
    end(&c);
}

static void test_faults(void) {
    static const struct {
        const char *text, *message;
    } cases[] = {
        {" ", "a:1: the JSON ends where a value should follow; the file is truncated"},
        {"{", "a:1: the JSON ends where a key in quotes should follow; the file is truncated"},
        {"[1,]", "a:1: expected a value, found \"]\"; this is not JSON"},
        {"[1 2]", "a:1: expected a comma or ], found \"2]\"; this is not JSON"},
        {"{\"a\":1 \"b\"", "a:1: expected a comma or }, found \"\"b\"\"; this is not JSON"},
        {"{\"a\" 1}", "a:1: expected a colon, found \"1}\"; this is not JSON"},
        {"{a:1}", "a:1: expected a key in quotes, found \"a:1}\"; this is not JSON"},
        {"[1]\n]", "a:2: expected the end of the JSON, found \"]\"; this is not JSON"},
        {"[01]", "a:1: expected a number such as -1.5e3, found \"01]\"; this is not JSON"},
        {"[1.]", "a:1: expected a number such as -1.5e3, found \"1.]\"; this is not JSON"},
        {"[-]", "a:1: expected a number such as -1.5e3, found \"-]\"; this is not JSON"},
        {"[1e]", "a:1: expected a number such as -1.5e3, found \"1e]\"; this is not JSON"},
        {"[.5]", "a:1: expected a value, found \".5]\"; this is not JSON"},
        {"[+1]", "a:1: expected a value, found \"+1]\"; this is not JSON"},
        {"[NaN]", "a:1: expected a value, found \"NaN]\"; this is not JSON"},
        {"[tru]", "a:1: expected a value, found \"tru]\"; this is not JSON"},
        {"\n\"a", "a:2: the JSON ends where the end of a string should follow; the file is "
                  "truncated"},
        {"\"\\x\"",
         "a:1: expected an escape such as \\n or \\u00e9, found \"\\x\"\"; this is not JSON"},
        {"\"\\u12g4\"",
         "a:1: expected an escape such as \\n or \\u00e9, found \"\\u12g4\"\"; this is not JSON"},
        {"\"\t\"",
         "a:1: expected a string without control characters, found \"\"; this is not JSON"},
        {"[1]//", "a:1: expected the end of the JSON, found \"//\"; this is not JSON"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        json_case c;
        CHECK(parse(&c, cases[i].text, strlen(cases[i].text)) == BURNISH_STATUS_FORMAT, "%s",
              cases[i].text);
        CHECK_TEXT(c.error.text, cases[i].message);
        end(&c);
    }
}

/* 64 levels are accepted. One more is rejected, and so is every truncated document. */
static void test_depth_and_truncation(void) {
    static const char text[] = "{\"a\":[1.5,{\"b\":\"c\\n\"},true,null,-3e2]}";
    char deep[2 * (BURNISH_JSON_DEPTH + 1)];
    json_case c;
    CHECK1(parse(&c, "[1]\0\0", 5) == BURNISH_STATUS_OK); /* padding of GLB by some writers */
    end(&c);
    for (int depth = BURNISH_JSON_DEPTH; depth <= BURNISH_JSON_DEPTH + 1; ++depth) {
        memset(deep, '[', (size_t)depth);
        memset(deep + depth, ']', (size_t)depth);
        const burnish_status expected =
            depth > BURNISH_JSON_DEPTH ? BURNISH_STATUS_LIMIT : BURNISH_STATUS_OK;
        CHECK(parse(&c, deep, 2 * (size_t)depth) == expected, "%d: %s", depth, c.error.text);
        end(&c);
    }
    for (size_t size = 0; size < sizeof text - 1; ++size) {
        char *copy = malloc(size + 1); /* lets the address sanitizer detect reads beyond the end */
        memcpy(copy, text, size);
        copy = realloc(copy, size > 0 ? size : 1);
        CHECK(parse(&c, copy, size) == BURNISH_STATUS_FORMAT, "%zu bytes", size);
        end(&c);
        free(copy);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_values());
    RUN(test_surrogates());
    RUN(test_faults());
    RUN(test_depth_and_truncation());
    return test_end("json");
}
