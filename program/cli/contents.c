#include "cli/contents.h"

#include <float.h>
#include <stdlib.h>

#include "base/cli/output.h"

int cli_box_size(const burnish_box *box, float size[3]) {
    for (int k = 0; k < 3; ++k) {
        size[k] = box->high[k] - box->low[k];
    }
    return box->low[0] <= box->high[0];
}

burnish_box cli_bound_plate(const burnish_mesh *mesh, const burnish_box *boxes, int plate) {
    const burnish_contents *contents = burnish_mesh_get_contents(mesh);
    burnish_box box = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
    for (size_t i = 0; i < contents->part_count; ++i) {
        for (int k = 0; k < 3 && contents->parts[i].plate == plate; ++k) {
            const float low = boxes[i].low[k], high = boxes[i].high[k];
            box.low[k] = low < box.low[k] ? low : box.low[k];
            box.high[k] = high > box.high[k] ? high : box.high[k];
        }
    }
    return box;
}

burnish_box *cli_bound_parts(const burnish_mesh *mesh) {
    burnish_box *boxes = calloc(burnish_mesh_get_contents(mesh)->part_count + 1, sizeof *boxes);
    if (boxes) {
        burnish_mesh_bound_parts(mesh, boxes);
    }
    return boxes;
}

/* ---- JSON ---- */

typedef struct contents_source {
    const burnish_mesh *mesh;
    const burnish_contents *contents;
    const burnish_box *boxes;
} contents_source;

static cJSON *size_or_null(const burnish_box *box) {
    float size[3];
    return cli_box_size(box, size) ? cli_json_floats(3, size) : cJSON_CreateNull();
}

static cJSON *number_or_null(int number) {
    return number > 0 ? cli_json_count((size_t)number) : cJSON_CreateNull();
}

static cJSON *part_at(const void *from, size_t i) {
    const contents_source *source = from;
    const burnish_part *part = &source->contents->parts[i];
    int failed = 0;
    cJSON *row = cJSON_CreateObject();
    cli_json_add(row, "name", cli_json_text(part->name), &failed);
    cli_json_add(row, "role", cJSON_CreateString(burnish_part_role_name(part->role)), &failed);
    cli_json_add(row, "id", cli_json_count(part->id), &failed);
    cli_json_add(row, "item", cli_json_count(part->item), &failed);
    cli_json_add(row, "plate", number_or_null(part->plate), &failed);
    cli_json_add(row, "filament", number_or_null(part->filament), &failed);
    cli_json_add(row, "triangles", cli_json_count(part->triangle_count), &failed);
    cli_json_add(row, "size", size_or_null(&source->boxes[i]), &failed);
    cli_json_add(row, "transform", cli_json_reals(12, part->transform), &failed);
    return row;
}

static cJSON *plate_at(const void *from, size_t i) {
    const contents_source *source = from;
    const burnish_plate *plate = &source->contents->plates[i];
    const burnish_box box = cli_bound_plate(source->mesh, source->boxes, plate->number);
    int failed = 0;
    cJSON *row = cJSON_CreateObject();
    cli_json_add(row, "number", cli_json_count((size_t)plate->number), &failed);
    cli_json_add(row, "name", cli_json_text(plate->name), &failed);
    cli_json_add(row, "size", size_or_null(&box), &failed);
    return row;
}

static cJSON *filament_at(const void *from, size_t i) {
    const uint8_t *c = ((const contents_source *)from)->contents->filaments[i].srgb;
    char text[16];
    snprintf(text, sizeof text, "#%02X%02X%02X", c[0], c[1], c[2]);
    return cJSON_CreateString(text);
}

static cJSON *length_at(const void *from, size_t i) {
    return cJSON_CreateNumber(((const contents_source *)from)->contents->filaments[i].length);
}

cJSON *cli_contents_json(const burnish_mesh *mesh, const burnish_box *boxes, int *failed) {
    const burnish_contents *c = burnish_mesh_get_contents(mesh);
    const contents_source source = {mesh, c, boxes};
    cJSON *root = cJSON_CreateObject();
    cli_json_add(root, "parts", cli_json_array(c->part_count, part_at, &source), failed);
    cli_json_add(root, "plates", cli_json_array(c->plate_count, plate_at, &source), failed);
    cli_json_add(root, "filaments", cli_json_array(c->filament_count, filament_at, &source),
                 failed);
    cli_json_add(root, "filament_lengths", cli_json_array(c->filament_count, length_at, &source),
                 failed);
    return root;
}
