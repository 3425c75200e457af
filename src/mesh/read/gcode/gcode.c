#include "mesh/read/gcode/gcode.h"

#include "base/bytes.h"
#include "core/srgb.h"
#include "mesh/read/common/thumbnail.h"
#include "mesh/read/io/base64.h"
#include "mesh/read/io/budget.h"
#include "mesh/read/io/parallel_text.h"
#include "mesh/read/io/streaming.h"

enum {
    HEAD = 1 << 16,                  /* bytes that are looked at to recognise the format */
    PIECE = 16 * BURNISH_CHUNK_SIZE, /* bytes that are read at once */
    PICTURE_MOST = 1 << 24
};

/* ---- Recognition ---- */

static int is_binary(const uint8_t *bytes, size_t size) {
    return size >= 10 && memcmp(bytes, "GCDE", 4) == 0;
}

/* By the first line that is neither empty, nor a comment, nor a macro of the firmware, which has a
 * '_': a command, such as "G1 X2" or "N7 M104". Long thumbnails may be in front. */
static int gcode_recognise(const uint8_t *bytes, size_t size) {
    static const char *const marks[] = {"thumbnail", "generated", "HEADER_BLOCK", "FLAVOR"};
    burnish_lexer lexer = burnish_lexer_open(bytes, size < HEAD ? size : HEAD, 0);
    burnish_token word;
    int any = 0;
    if (is_binary(bytes, size)) {
        return 2;
    }
    while (burnish_lexer_word(&lexer, &word)) {
        if (*word.bytes == ';') {
            lexer.next = word.bytes + 1;
            const burnish_token text = burnish_lexer_rest(&lexer);
            for (size_t i = 0; i < sizeof marks / sizeof *marks; ++i) {
                const size_t length = strlen(marks[i]);
                any |= text.size >= length && memcmp(text.bytes, marks[i], length) == 0;
            }
            continue;
        }
        if (!memchr(word.bytes, '_', word.size)) {
            return word.size > 1 && memchr("GMNQT", *word.bytes, 5) && word.bytes[1] >= '0' &&
                   word.bytes[1] <= '9' && !memchr(bytes, 0, (size_t)(lexer.next - bytes));
        }
        burnish_lexer_rest(&lexer);
    }
    return any;
}

/* ---- Pictures ---- */

/* Draws bytes [first, end) of the file; base64 in lines of comments if is_text. */
static burnish_status draw_picture(burnish_gcode *g, int is_text, const char *why) {
    const size_t size = g->picture.end - g->picture.first;
    uint8_t *buffer = burnish_allocate(g->memory, size, 1, "a thumbnail");
    const uint8_t *bytes =
        buffer ? burnish_reader_peek(g->reader, g->picture.first, size, buffer) : NULL;
    burnish_status status = g->memory->status;
    if (buffer && !bytes) {
        status = burnish_stop_streaming(g->reader);
    } else if (buffer) {
        size_t count = size;
        if (is_text) {
            count = 0;
            for (size_t i = 0; i < size; ++i) {
                buffer[count] = bytes[i];
                count += bytes[i] > ' ' && bytes[i] != ';';
            }
            count = burnish_decode_base64(buffer, count, buffer);
            bytes = buffer;
        }
        status = burnish_draw_thumbnail(g->reader, bytes, count == SIZE_MAX ? 0 : count, why);
    }
    burnish_release(g->memory->context, buffer);
    return status;
}

static burnish_status replace_path(burnish_gcode *g, int is_text, const char *why) {
    const int is_only = g->reader->input->options->thumbnail == BURNISH_THUMBNAIL_ONLY;
    const int is_there = g->picture.area > 0 && g->picture.end > g->picture.first &&
                         g->picture.end - g->picture.first <= PICTURE_MOST;
    if (g->reader->input->options->thumbnail != BURNISH_THUMBNAIL_NEVER && is_there) {
        return draw_picture(g, is_text, is_only ? "its path is not wanted" : why);
    }
    return burnish_reader_fail(g->reader, BURNISH_STATUS_FORMAT, NULL,
                               "%s%s; export G-code of a 3D "
                               "printer as text, with thumbnails in PNG",
                               is_only ? "it holds no picture of itself" : why,
                               g->has_odd_picture ? ", and its pictures are not PNG or JPEG" : "");
}

/* Binary G-code (Prusa Research, "Binary G-code", libbgcode): blocks, of which only pictures are
 * read. */
static burnish_status read_binary(burnish_gcode *g) {
    enum { THUMBNAIL = 5, JPEG = 1, WITH_CHECKSUM = 1, LEAST = 14 /* bytes of a picture's head */ };
    const size_t size = g->reader->input->size;
    size_t at = 10;
    const size_t checksum = g->reader->input->bytes[8] == WITH_CHECKSUM ? 4 : 0;
    g->reader->is_binary = 1;
    while (at + LEAST <= size) {
        uint8_t buffer[18], block[18] = {0};
        const size_t some = size - at < sizeof block ? size - at : sizeof block;
        const uint8_t *read = burnish_reader_peek(g->reader, at, some, buffer);
        if (!read) {
            return burnish_stop_streaming(g->reader);
        }
        memcpy(block, read, some);
        const uint32_t type = burnish_load16(block), packing = burnish_load16(block + 2);
        const size_t header = packing ? 12 : 8, parameters = type == THUMBNAIL ? 6 : 2;
        const uint8_t *p = block + header;
        const uint64_t bytes = burnish_load32(block + (packing ? 8 : 4));
        const uint64_t area = (uint64_t)burnish_load16(p + 2) * burnish_load16(p + 4);
        const uint64_t first = at + header + parameters;
        if (bytes > size - at || first + bytes > size) {
            break;
        }
        if (type == THUMBNAIL && !packing && burnish_load16(p) <= JPEG && area > g->picture.area) {
            g->picture = (burnish_gcode_picture){(size_t)first, (size_t)(first + bytes), area};
        }
        g->has_odd_picture |= type == THUMBNAIL;
        at = (size_t)(first + bytes) + checksum;
    }
    return replace_path(g, 0, "it is binary G-code, of which the path is not read");
}

/* ---- Text ---- */

/* Reads the file in pieces of whole lines. A line that is longer than a piece is cut. */
static burnish_status read_text(burnish_gcode *g) {
    const burnish_reader_input *input = g->reader->input;
    burnish_window window = {.input = input, .capacity = PIECE};
    if (input->streamed) {
        window.bytes = burnish_allocate(g->memory, PIECE, 1, "a piece of the file");
    }
    burnish_status status = g->memory->status;
    for (size_t at = 0; at < input->size && !g->is_over && status == BURNISH_STATUS_OK;) {
        const size_t left = input->size - at;
        size_t size = left < PIECE ? left : PIECE;
        if (input->streamed && !burnish_window_move(&window, at)) {
            status = burnish_stop_streaming(g->reader);
            break;
        }
        const uint8_t *text = input->streamed ? window.bytes : input->bytes + at;
        for (size_t end = size; end > 0 && size < left; --end) {
            if (text[end - 1] == '\n') {
                size = end;
                break;
            }
        }
        burnish_gcode_read_lines(g, text, size, at);
        at += size;
        status = g->memory->status == BURNISH_STATUS_OK
                     ? burnish_tasks_check(g->reader->mesh->tasks, g->reader->error)
                     : g->memory->status;
        burnish_tasks_progress(g->reader->mesh->tasks, BURNISH_STAGE_READ,
                               (double)at / (double)input->size);
    }
    burnish_release(g->memory->context, window.bytes);
    return status == BURNISH_STATUS_OK ? g->status : status;
}

/* ---- Contents ---- */

/* Parts are the features, in the order in which the file names them. Each tool has a material: of its
 * filament, or grey if only one is used and it has no colour. */
static burnish_status list_contents(burnish_gcode *g) {
    burnish_mesh_data *mesh = g->reader->mesh;
    size_t counts[BURNISH_GCODE_FEATURES] = {0}, tools = 0, parts = (size_t)g->feature_count;
    for (size_t i = 0; i < g->count; ++i) {
        counts[g->points[i].feature] += !g->points[i].is_start;
        tools = g->points[i].tool >= tools ? g->points[i].tool + 1u : tools;
    }
    while (parts > 0 && counts[parts - 1] == 0) { /* of what ends a print */
        --parts;
    }
    parts = parts == 1 && strcmp(g->features[0], BURNISH_GCODE_OTHER) == 0 ? 0 : parts;
    mesh->parts = burnish_reserve(g->memory, mesh->parts, &mesh->part_capacity, parts,
                                  sizeof *mesh->parts, "parts");
    mesh->materials = burnish_reserve(g->memory, mesh->materials, &mesh->material_capacity, tools,
                                      sizeof *mesh->materials, "materials");
    mesh->filaments = burnish_reserve(g->memory, mesh->filaments, &mesh->filament_capacity, tools,
                                      sizeof *mesh->filaments, "filaments");
    if (g->memory->status != BURNISH_STATUS_OK) {
        return g->memory->status;
    }
    for (size_t i = 0; i < parts; ++i) {
        mesh->parts[i] = (burnish_part){.transform = {[0] = 1, [5] = 1, [10] = 1},
                                        .triangle_count = BURNISH_GCODE_TRIANGLES * counts[i]};
        memcpy(mesh->parts[i].name, g->features[i], BURNISH_NAME_SIZE);
    }
    for (size_t i = 0; i < tools; ++i) {
        burnish_material material = burnish_material_default();
        burnish_filament filament = {{192, 192, 192, 255}, g->lengths[i] > 0 ? g->lengths[i] : 0};
        if (g->colors[i][3] > 0) {
            memcpy(filament.srgb, g->colors[i], 3);
        } else if (tools > 1) {
            burnish_part_color(i, filament.srgb);
        }
        material.has_diffuse = g->colors[i][3] > 0 || tools > 1;
        for (int k = 0; k < 3 && material.has_diffuse; ++k) {
            material.ambient[k] = material.diffuse[k] = burnish_srgb_to_linear[filament.srgb[k]];
        }
        mesh->materials[i] = material;
        mesh->filaments[i] = filament;
    }
    mesh->part_count = parts;
    mesh->material_count = mesh->filament_count = tools;
    return BURNISH_STATUS_OK;
}

/* How many rods there may be. */
static size_t find_room(const burnish_gcode *g) {
    const int is_given = g->reader->input->options->max_triangles < BURNISH_TRIANGLES_MAX;
    const uint64_t most = burnish_budget_triangles(g->reader);
    const uint64_t budget = is_given ? most : most / 2; /* of vertices, which are as many, too */
    const uint64_t room = burnish_budget_room(g->reader->input);
    const uint64_t least = (budget < room ? budget : room) / BURNISH_GCODE_TRIANGLES;
    return least < BURNISH_GCODE_POINTS ? (size_t)least : BURNISH_GCODE_POINTS;
}

static burnish_status make_mesh(burnish_gcode *g) {
    burnish_mesh_data *mesh = g->reader->mesh;
    burnish_status status = burnish_gcode_reduce(g, find_room(g));
    if (status == BURNISH_STATUS_OK) {
        status = list_contents(g);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_gcode_make_beads(g);
    }
    mesh->layer_count = g->layer_marks > 0 ? g->layer_marks : (size_t)g->layer + 1;
    if (status == BURNISH_STATUS_OK && g->layer_step > 1) {
        burnish_mesh_data_warn(
            mesh,
            "%s: 1 in %u layers is drawn, as high as %u, since the path has more "
            "pieces than are drawn",
            burnish_show_name(g->reader->input->name).text, g->layer_step, g->layer_step);
    }
    return status;
}

static burnish_status gcode_read(burnish_reader *reader) {
    burnish_gcode g = {.reader = reader,
                       .memory = &reader->mesh->memory,
                       .tolerance = 0.005,
                       .room = SIZE_MAX,
                       .layer_step = 1,
                       .unit = 1,
                       .is_apart = 1,
                       .height = 0.2F,
                       .diameter = 1.75F};
    burnish_status status;
    if (is_binary(reader->input->bytes, reader->input->size)) {
        return read_binary(&g);
    }
    reader->mesh->unit = "millimeter";
    status = read_text(&g);
    burnish_reader_warn_group(reader, &g.odd);
    burnish_gcode_flush(&g);
    const int is_unwanted = reader->input->options->thumbnail == BURNISH_THUMBNAIL_ONLY;
    if (status == BURNISH_STATUS_OK && (is_unwanted || g.line_count == 0)) {
        status = replace_path(&g, 1, "no move has filament (E)");
    } else if (status == BURNISH_STATUS_OK) {
        status = make_mesh(&g);
    }
    burnish_release(g.memory->context, g.points);
    return status;
}

const burnish_format_reader burnish_reader_gcode = {
    .recognise = gcode_recognise, .read = gcode_read, .can_stream = 1};
