/* Scenes in JSON (docs/formats.md): {"burnish_scene": 1, "items": [{"file": "a.stl"}, ...]}. */
#include <stdio.h>
#include <string.h>

#include "base/elementary.h"
#include "base/numbers.h"
#include "base/show_text.h"
#include "mesh/read/common/parts.h"
#include "mesh/read/io/json.h"
#include "mesh/read/scene/scene.h"

enum {
    LOOKED_AT = 4096,
    TEXT_SIZE = 1024,
    TRANSFORM_MOST = 1000000000 /* as large as is useful */
};

typedef struct scene_json {
    burnish_scene scene;
    burnish_json json;
    burnish_status status;
    burnish_warning_group unknown; /* keys */
    burnish_warning_group damage;  /* items whose file can't be read */
} scene_json;

static int scene_recognise(const uint8_t *bytes, size_t size) {
    static const char key[] = "\"burnish_scene\"";
    size_t i = size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    const size_t looked = size < LOOKED_AT ? size : LOOKED_AT;
    while (i < looked && (bytes[i] == ' ' || (bytes[i] >= '\t' && bytes[i] <= '\r'))) {
        ++i;
    }
    const int is_object = i < looked && bytes[i] == '{';
    for (; is_object && i + sizeof key - 1 <= looked; ++i) {
        if (memcmp(bytes + i, key, sizeof key - 1) == 0) {
            return 2;
        }
    }
    return 0;
}

/* Fails at a value with its path, unless something failed before. Returns 0. */
static int scene_fail(scene_json *s, burnish_status status, uint32_t value, const char *message) {
    if (s->status == BURNISH_STATUS_OK) {
        s->status =
            burnish_reader_fail(s->scene.reader, status, burnish_json_at(&s->json, value), "%s: %s",
                                burnish_json_path_of(&s->json, value).text, message);
    }
    return 0;
}

/* Notes keys that mean nothing, such as misspelled ones. `known` ends with NULL. */
static void note_unknown(scene_json *s, uint32_t object, const char *const *known) {
    uint32_t key = object + 1;
    for (uint32_t i = s->json.nodes[object].size; i > 0; --i) {
        size_t k = 0;
        while (known[k] && !burnish_json_is_text(&s->json, key, known[k])) {
            ++k;
        }
        if (!known[k]) {
            char text[64];
            burnish_json_text(&s->json, key, text, sizeof text);
            burnish_reader_note(s->scene.reader, &s->unknown, burnish_json_at(&s->json, key),
                                "\"%s\" is unknown here and ignored", text);
        }
        key = s->json.nodes[key + 1].next;
    }
}

/* Finite numbers of an array. Returns 1 if the value is there; 0 without it, and on failure. */
static int read_numbers(scene_json *s, uint32_t object, const char *key, size_t count,
                        double *numbers) {
    const uint32_t value = burnish_json_member(&s->json, object, key);
    if (value == BURNISH_JSON_NONE) {
        return 0;
    }
    uint32_t item = value + 1;
    int is_fine = burnish_json_length(&s->json, value) == count;
    for (size_t i = 0; i < count && is_fine; ++i) {
        is_fine = burnish_json_number(&s->json, item, &numbers[i]) &&
                  numbers[i] <= TRANSFORM_MOST && numbers[i] >= -TRANSFORM_MOST;
        item = s->json.nodes[item].next;
    }
    char message[80];
    snprintf(message, sizeof message, "expected %zu numbers of at most 1e9", count);
    return is_fine || scene_fail(s, BURNISH_STATUS_FORMAT, value, message);
}

/* A text member; "" if it is missing and need not be there. Returns 0 on failure. */
static int read_text(scene_json *s, uint32_t object, const char *key, char text[TEXT_SIZE]) {
    const uint32_t value = burnish_json_member(&s->json, object, key);
    *text = 0;
    if (value == BURNISH_JSON_NONE) {
        return 1;
    }
    if (!burnish_json_is_kind(&s->json, value, BURNISH_JSON_STRING) ||
        s->json.nodes[value].size >= TEXT_SIZE) {
        return scene_fail(s, BURNISH_STATUS_FORMAT, value, "expected a text of at most 1023 bytes");
    }
    burnish_json_text(&s->json, value, text, TEXT_SIZE);
    return 1;
}

/* ---- Items ---- */

/* "#rrggbb" or "#rrggbbaa" */
static int read_color(scene_json *s, uint32_t object, burnish_scene_item *item) {
    static const char digits[] = "0123456789abcdef0123456789ABCDEF";
    const uint32_t value = burnish_json_member(&s->json, object, "color");
    char text[TEXT_SIZE];
    if (value == BURNISH_JSON_NONE || !read_text(s, object, "color", text)) {
        return s->status == BURNISH_STATUS_OK;
    }
    const size_t size = strlen(text);
    int is_fine = *text == '#' && (size == 7 || size == 9);
    item->has_color = 1;
    item->srgb[3] = 255;
    for (size_t i = 1; i < size && is_fine; ++i) {
        const char *digit = strchr(digits, text[i]);
        uint8_t *to = &item->srgb[(i - 1) / 2];
        is_fine = digit != NULL;
        *to = (uint8_t)((i % 2 == 1 ? 0 : *to << 4) + (digit ? (digit - digits) % 16 : 0));
    }
    return is_fine || scene_fail(s, BURNISH_STATUS_FORMAT, value,
                                 "expected a colour such as \"#ff8800\" or \"#ff880080\"");
}

/* Sine and cosine of degrees; exact at right angles. */
static void sincos_of_degrees(double degrees, double *sine, double *cosine) {
    const double turns = degrees / 90;
    const int64_t quarter = (int64_t)(turns + (turns < 0 ? -0.5 : 0.5));
    double s, c;
    burnish_sincos((degrees - 90 * (double)quarter) * (3.14159265358979323846 / 180), &s, &c);
    const double all[4] = {s, c, -s, -c};
    *sine = all[quarter & 3];
    *cosine = all[(quarter + 1) & 3];
}

/* "matrix", or "translate", "rotate" and "scale". Returns 0 on failure. */
static int read_transform(scene_json *s, uint32_t object, double transform[12]) {
    static const char *const keys[] = {"translate", "rotate", "scale"};
    double m[16], move[3] = {0, 0, 0}, turn[3] = {0, 0, 0}, scale[3] = {1, 1, 1};
    double sines[3], cosines[3];
    if (read_numbers(s, object, "matrix", 16, m)) {
        const uint32_t value = burnish_json_member(&s->json, object, "matrix");
        for (size_t i = 0; i < 3; ++i) {
            const uint32_t other = burnish_json_member(&s->json, object, keys[i]);
            if (other != BURNISH_JSON_NONE) {
                return scene_fail(s, BURNISH_STATUS_FORMAT, other, "not beside \"matrix\"");
            }
        }
        if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
            return scene_fail(s, BURNISH_STATUS_FORMAT, value,
                              "its last row is not 0, 0, 0, 1; give the rows one after another");
        }
        memcpy(transform, m, 12 * sizeof *m);
        return 1;
    }
    read_numbers(s, object, "translate", 3, move);
    read_numbers(s, object, "rotate", 3, turn);
    const uint32_t size = burnish_json_member(&s->json, object, "scale");
    if (size != BURNISH_JSON_NONE && burnish_json_number(&s->json, size, &scale[0])) {
        scale[1] = scale[2] = scale[0];
    } else {
        read_numbers(s, object, "scale", 3, scale);
    }
    if (s->status != BURNISH_STATUS_OK) { /* and numbers may be huge */
        return 0;
    }
    for (int i = 0; i < 3; ++i) {
        sincos_of_degrees(turn[i], &sines[i], &cosines[i]);
    }
    burnish_scene_place(sines, cosines, move, transform);
    for (int i = 0; i < 12; ++i) {
        transform[i] *= i % 4 < 3 ? scale[i % 4] : 1;
    }
    return 1;
}

/* The name of a file without folders and extension. */
static void name_item(const char *file, char name[BURNISH_NAME_SIZE]) {
    const char *slash = strrchr(file, '/'), *base = slash ? slash + 1 : file;
    const char *dot = strrchr(base, '.');
    burnish_part_set_name(name, base, dot && dot > base ? (size_t)(dot - base) : strlen(base));
}

static int read_item(scene_json *s, uint32_t object) {
    static const char *const keys[] = {"file",      "name",   "color", "matrix",
                                       "translate", "rotate", "scale", NULL};
    burnish_error why = {0};
    burnish_scene_source *source = NULL;
    char file[TEXT_SIZE], name[TEXT_SIZE];
    if (!read_text(s, object, "file", file) || !read_text(s, object, "name", name)) {
        return 0;
    }
    if (!*file) {
        return scene_fail(s, BURNISH_STATUS_FORMAT, object, "has no \"file\"; name one");
    }
    note_unknown(s, object, keys);
    for (char *at = file; (at = strchr(at, '\\')); *at = '/') { /* as Windows writes them */
    }
    const burnish_status status = burnish_scene_load(&s->scene, file, &source, &why);
    const int is_reported = status != BURNISH_STATUS_OK && !*why.text;
    if (is_reported || status == BURNISH_STATUS_MEMORY || status == BURNISH_STATUS_CANCELLED) {
        s->status =
            *why.text ? burnish_fail(s->scene.reader->error, status, "%s", why.text) : status;
        return 0;
    }
    const uint32_t value = burnish_json_member(&s->json, object, "file");
    if (status == BURNISH_STATUS_READ || status == BURNISH_STATUS_FORMAT) {
        burnish_reader_note(s->scene.reader, &s->damage, burnish_json_at(&s->json, value), "%s: %s",
                            burnish_json_path_of(&s->json, value).text, why.text);
        return 1;
    }
    if (status != BURNISH_STATUS_OK) {
        return scene_fail(s, status, value, why.text);
    }
    burnish_scene_item *item = burnish_scene_add(&s->scene, source);
    if (!item) {
        s->status = s->scene.reader->mesh->memory.status;
        return scene_fail(s, BURNISH_STATUS_LIMIT, object, "more than 65535 items");
    }
    burnish_part_set_name(item->name, name, strlen(name));
    if (!*name) {
        name_item(file, item->name);
    }
    return read_color(s, object, item) && read_transform(s, object, item->transform);
}

/* ---- The scene ---- */

/* "up" is an axis with or without a sign; by default it is that of the first file. */
static int read_up(scene_json *s) {
    float *up = s->scene.reader->mesh->up_axis;
    char text[TEXT_SIZE];
    if (!read_text(s, 0, "up", text)) {
        return 0;
    }
    const int has_sign = *text == '+' || *text == '-';
    const int axis = (text[has_sign] | 32) - 'x';
    if (*text && (axis < 0 || axis > 2 || text[has_sign + 1])) {
        return scene_fail(s, BURNISH_STATUS_FORMAT, burnish_json_member(&s->json, 0, "up"),
                          "expected an axis such as \"+Z\"");
    }
    if (*text) {
        up[0] = up[1] = up[2] = 0;
        up[axis] = *text == '-' ? -1 : 1;
    }
    return 1;
}

static int read_unit(scene_json *s) {
    static const char *const units[] = {"micron", "millimeter", "centimeter",
                                        "inch",   "foot",       "meter"};
    const uint32_t value = burnish_json_member(&s->json, 0, "unit");
    for (size_t i = 0; i < sizeof units / sizeof *units; ++i) {
        s->scene.unit = burnish_json_is_text(&s->json, value, units[i]) ? units[i] : s->scene.unit;
    }
    return value == BURNISH_JSON_NONE || s->scene.unit ||
           scene_fail(s, BURNISH_STATUS_FORMAT, value,
                      "expected micron, millimeter, centimeter, inch, foot or meter");
}

/* Each joint of the options must be one of some robot. */
static int check_joints(scene_json *s) {
    const burnish_load_options *options = s->scene.reader->input->options;
    for (size_t i = 0; i < options->joint_count; ++i) {
        if (!s->scene.joint_found[i]) {
            s->status = burnish_reader_fail(s->scene.reader, BURNISH_STATUS_ARGUMENT, NULL,
                                            "no robot of the scene has a moving joint named "
                                            "\"%.60s\"; look up its name in their files",
                                            burnish_show_name(options->joints[i].name).text);
            return 0;
        }
    }
    return 1;
}

static void read_scene(scene_json *s) {
    const uint32_t items = burnish_json_member(&s->json, 0, "items");
    const uint32_t version = burnish_json_member(&s->json, 0, "burnish_scene");
    double number = 0;
    if (version == BURNISH_JSON_NONE || !burnish_json_number(&s->json, version, &number) ||
        number != 1) {
        scene_fail(s, BURNISH_STATUS_FORMAT, version == BURNISH_JSON_NONE ? 0 : version,
                   "no scene of version 1; it needs \"burnish_scene\": 1");
        return;
    }
    if (burnish_json_length(&s->json, items) == 0) {
        scene_fail(s, BURNISH_STATUS_FORMAT, items == BURNISH_JSON_NONE ? 0 : items,
                   "no \"items\"; list at least one");
        return;
    }
    static const char *const keys[] = {"burnish_scene", "unit", "up", "items", NULL};
    note_unknown(s, 0, keys);
    uint32_t item = items + 1;
    int is_fine = read_up(s) && read_unit(s);
    for (size_t i = burnish_json_length(&s->json, items); i > 0 && is_fine; --i) {
        is_fine = read_item(s, item);
        item = s->json.nodes[item].next;
    }
    burnish_reader_warn_group(s->scene.reader, &s->unknown);
    if (is_fine && s->scene.item_count == 0) {
        s->status =
            burnish_fail(s->scene.reader->error, BURNISH_STATUS_FORMAT, "%s", s->damage.first.text);
    } else if (is_fine && check_joints(s)) {
        burnish_warning_group left_out = {.count = s->damage.count};
        burnish_fail(&left_out.first, BURNISH_STATUS_OK, "%s; it was left out",
                     s->damage.first.text);
        burnish_reader_warn_group(s->scene.reader, &left_out);
        s->status = burnish_scene_join(&s->scene);
    }
}

static burnish_status scene_read(burnish_reader *reader) {
    burnish_memory *memory = &reader->mesh->memory;
    scene_json s = {.scene = {.reader = reader}};
    s.scene.joint_found =
        burnish_allocate_zeroed(memory, reader->input->options->joint_count + 1, 1, "joints");
    s.status = memory->status;
    if (s.status == BURNISH_STATUS_OK) {
        s.status = burnish_json_parse(reader, reader->input->bytes, reader->input->size, &s.json);
    }
    if (s.status == BURNISH_STATUS_OK) {
        read_scene(&s);
    }
    burnish_json_destroy(memory->context, &s.json);
    burnish_scene_close(&s.scene);
    return s.status;
}

const burnish_format_reader burnish_reader_scene = {.recognise = scene_recognise,
                                                    .read = scene_read};
