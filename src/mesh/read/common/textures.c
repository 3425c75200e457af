#include "mesh/read/common/textures.h"

#include <stdio.h>
#include <string.h>

#include "image/decode/decode.h"
#include "mesh/data/material.h"
#include "mesh/read/io/budget.h"
#include "mesh/read/io/companions.h"

enum {
    TABLE_SIZE = 8192,          /* a power of two */
    NAMES_MAX = TABLE_SIZE / 2, /* files that one input may name */
    SEARCHED_MAX = 256,         /* of them, those searched in several folders */
    AHEAD_MAX = 256,            /* pictures that are decoded ahead */
    WAVE_MAX = 64,              /* pictures that are decoded at the same time */
    AHEAD_REFUSED = 8,    /* after so many failures the others wait, since each may take long */
    MOST_TEXELS = 1 << 28 /* BURNISH_TEXTURE_PIXELS_AUTO */
};

/* A requested file. */
typedef struct texture_name {
    char *name; /* NULL: a free slot */
    int is_color, number;
} texture_name;

/* A picture that was decoded ahead. */
typedef struct ahead_picture {
    burnish_texture_source source; /* name NULL: it was requested */
    burnish_encoded from;
    const burnish_context *memory;
    burnish_status status;
    burnish_error why;
    burnish_image picture;
    uint64_t decoded; /* texels */
    uint64_t key;     /* of a file, if it was found */
} ahead_picture;

struct burnish_texture_names {
    texture_name table[TABLE_SIZE]; /* open addressing */
    size_t count, searched;
    uint64_t texels; /* decoded so far, including damaged pictures */
    burnish_warning_group missing;
    ahead_picture *ahead; /* in the order of their sources */
    size_t ahead_count;
    uint64_t ahead_texels; /* of their pictures */
};

static struct burnish_texture_names *names_of(burnish_reader *reader) {
    if (!reader->textures) {
        reader->textures =
            burnish_allocate_zeroed(&reader->mesh->memory, 1, sizeof *reader->textures, "textures");
    }
    return reader->textures;
}

static uint32_t hash_of(const char *name, int is_color) {
    uint32_t hash = 0x811c9dc5u ^ (uint32_t)is_color;
    for (; *name; ++name) {
        hash = (hash ^ (uint8_t)*name) * 0x01000193u;
    }
    return hash;
}

/* The slot of a name: its own, or a free one; NULL: there are too many. */
static texture_name *find_name(struct burnish_texture_names *names, const char *name,
                               int is_color) {
    uint32_t i = hash_of(name, is_color) % TABLE_SIZE;
    while (names->table[i].name &&
           (names->table[i].is_color != is_color || strcmp(names->table[i].name, name) != 0)) {
        i = (i + 1) % TABLE_SIZE;
    }
    return names->table[i].name || names->count < NAMES_MAX ? &names->table[i] : NULL;
}

void burnish_reader_drop_ahead(burnish_reader *reader) {
    struct burnish_texture_names *names = reader->textures;
    if (!names) {
        return;
    }
    for (size_t i = 0; i < names->ahead_count; ++i) {
        burnish_release(reader->mesh->memory.context, names->ahead[i].picture.pixels);
    }
    burnish_release(reader->mesh->memory.context, names->ahead);
    names->ahead = NULL;
    names->ahead_count = 0;
    names->ahead_texels = 0;
}

static void close_textures(burnish_reader *reader) {
    struct burnish_texture_names *names = reader->textures;
    if (!names) {
        return;
    }
    burnish_reader_warn_group(reader, &names->missing);
    for (size_t i = 0; i < TABLE_SIZE; ++i) {
        burnish_release(reader->mesh->memory.context, names->table[i].name);
    }
    burnish_reader_drop_ahead(reader);
    burnish_release(reader->mesh->memory.context, names);
    reader->textures = NULL;
}

static void note_missing(burnish_reader *reader, const uint8_t *at, const char *name,
                         const char *why) {
    const size_t size = strlen(name);
    burnish_reader_note(reader, &reader->textures->missing, at, "texture \"%s\" was skipped: %s",
                        size > 80 ? name + size - 80 : name, why);
}

/* ---- Decoding ---- */

static burnish_encoded encoded_picture(const char *name, const uint8_t *bytes, size_t size,
                                       uint64_t max_pixels, uint64_t *decoded) {
    return (burnish_encoded){.bytes = bytes,
                             .size = size,
                             .name = name,
                             .channels = 4,
                             .max_side = BURNISH_TEXTURE_SIZE_MAX,
                             .max_pixels = max_pixels,
                             .decoded = decoded};
}

static uint64_t texels_of(const burnish_image *picture) {
    return (uint64_t)picture->width * (uint64_t)picture->height;
}

/* A picture of one colour takes a byte for 1,000 texels; their cost in time and memory must stay
 * proportional to the bytes that were read. */
static uint64_t texels_most(const burnish_reader *reader) {
    const uint64_t asked = reader->input->options->max_texture_pixels;
    const uint64_t most = burnish_budget_of(burnish_budget_bytes(reader), BURNISH_TEXELS_PER_BYTE);
    return asked != BURNISH_TEXTURE_PIXELS_AUTO ? asked : most < MOST_TEXELS ? most : MOST_TEXELS;
}

/* Texels that further textures may have, without those of pictures decoded ahead. */
static uint64_t texels_left(const burnish_reader *reader) {
    const uint64_t most = texels_most(reader);
    const uint64_t used = reader->textures->texels + reader->textures->ahead_texels;
    return most > used ? most - used : 0;
}

static int add_picture(burnish_reader *reader, const char *name, const burnish_image *picture,
                       int is_color) {
    return burnish_mesh_data_add_texture(reader->mesh, name, picture->width, picture->height,
                                         picture->pixels, is_color);
}

/* Whether a picture can't be loaded, now or later. */
static int is_refused(const ahead_picture *ahead) {
    return ahead->status != BURNISH_STATUS_OK && ahead->status != BURNISH_STATUS_LIMIT &&
           ahead->status != BURNISH_STATUS_MEMORY;
}

/* The picture decoded ahead from these bytes or, if they are NULL, from the file of that name. */
static ahead_picture *find_ahead(struct burnish_texture_names *names, const char *name,
                                 const uint8_t *bytes, size_t size) {
    for (size_t i = 0; i < names->ahead_count; ++i) {
        const burnish_texture_source *source = &names->ahead[i].source;
        if (source->name && source->bytes == bytes && source->size == size &&
            strcmp(source->name, name) == 0) {
            return &names->ahead[i];
        }
    }
    return NULL;
}

static int count_file(burnish_reader *reader, uint64_t key, uint64_t size, burnish_error *why) {
    return burnish_budget_companion(reader, key, size) ||
           (burnish_fail(why, BURNISH_STATUS_LIMIT, "its file is referenced too often"), 0);
}

/* Takes the result of decoding ahead. Returns 0 if the picture must be decoded now. */
static int take_ahead(burnish_reader *reader, const char *name, const uint8_t *bytes, size_t size,
                      int is_color, int *number, burnish_error *why) {
    struct burnish_texture_names *names = reader->textures;
    ahead_picture *found = find_ahead(names, name, bytes, size);
    if (!found) {
        return 0;
    }
    ahead_picture ahead = *found;
    found->source.name = NULL;
    found->picture = (burnish_image){0};
    names->ahead_texels -= texels_of(&ahead.picture);
    *number = 0;
    if (!is_refused(&ahead) && !ahead.picture.pixels) {
        return 0;
    }
    if (!bytes && ahead.from.bytes && !count_file(reader, ahead.key, ahead.from.size, why)) {
        burnish_release(reader->mesh->memory.context, ahead.picture.pixels);
        return 1;
    }
    names->texels += ahead.decoded;
    if (is_refused(&ahead)) {
        *why = ahead.why;
    } else {
        *number = add_picture(reader, name, &ahead.picture, is_color);
    }
    return 1;
}

/* Errors go to *why; only memory errors are the reader's. Returns 1 + number, or 0. */
static int decode_texture(burnish_reader *reader, const char *name, const uint8_t *bytes,
                          size_t size, int is_color, burnish_error *why) {
    burnish_memory memory = burnish_memory_of(reader->mesh->memory.context, why);
    burnish_encoded from =
        encoded_picture(name, bytes, size, texels_left(reader), &reader->textures->texels);
    burnish_image picture;
    from.tasks = reader->mesh->tasks;
    burnish_status status = burnish_decode(&from, &memory, &picture);
    if (status == BURNISH_STATUS_LIMIT && reader->textures->ahead_texels > 0) {
        burnish_reader_drop_ahead(reader); /* pictures not requested yet make room */
        memory = burnish_memory_of(reader->mesh->memory.context, why);
        from.max_pixels = texels_left(reader);
        status = burnish_decode(&from, &memory, &picture);
    }
    if (status == BURNISH_STATUS_MEMORY) {
        reader->mesh->memory.status = status;
        if (reader->mesh->memory.error) {
            *reader->mesh->memory.error = *why;
        }
    }
    return status == BURNISH_STATUS_OK ? add_picture(reader, name, &picture, is_color) : 0;
}

int burnish_reader_decode_texture(burnish_reader *reader, const uint8_t *at, const char *name,
                                  const uint8_t *bytes, size_t size, int is_color) {
    burnish_error why = {0};
    if (!names_of(reader)) {
        return 0;
    }
    int number;
    if (!take_ahead(reader, name, bytes, size, is_color, &number, &why)) {
        number = decode_texture(reader, name, bytes, size, is_color, &why);
    }
    if (number == 0 && reader->mesh->memory.status == BURNISH_STATUS_OK) {
        note_missing(reader, at, name, why.text);
    }
    return number;
}

int burnish_reader_copy_texture(burnish_reader *reader, const uint8_t *at, const char *name,
                                int width, int height, const uint8_t *pixels, int is_color) {
    struct burnish_texture_names *names = names_of(reader);
    const size_t count = (size_t)width * (size_t)height;
    if (!names) {
        return 0;
    }
    if (names->texels + count > texels_most(reader)) {
        note_missing(reader, at, name, "too many texels; raise the limit or make textures smaller");
        return 0;
    }
    uint8_t *copy = burnish_allocate(&reader->mesh->memory, count, 4, "textures");
    if (!copy) {
        return 0;
    }
    memcpy(copy, pixels, 4 * count);
    names->texels += count;
    return burnish_mesh_data_add_texture(reader->mesh, name, width, height, copy, is_color);
}

/* ---- Files ---- */

/* A file's bytes, as the companions' loader has them. */
typedef struct file_bytes {
    const void *bytes;
    size_t size;
    uint64_t key; /* which file it is */
    int is_found;
} file_bytes;

static file_bytes open_file(burnish_reader *reader, const char *path, burnish_error *why) {
    const burnish_file_loader *companions = &reader->input->companions;
    file_bytes file = {0};
    burnish_status status =
        companions->load(companions->user_data, path, reader->input->options->max_input_bytes,
                         &file.bytes, &file.size, why);
    if (status == BURNISH_STATUS_MEMORY) {
        reader->mesh->memory.status = status;
        if (reader->mesh->memory.error) {
            *reader->mesh->memory.error = *why;
        }
    }
    file.is_found = status == BURNISH_STATUS_OK;
    file.key = burnish_companion_key(path);
    return file;
}

static void close_file(const burnish_reader *reader, const file_bytes *file) {
    const burnish_file_loader *companions = &reader->input->companions;
    if (file->is_found && companions->release) {
        companions->release(companions->user_data, file->bytes, file->size);
    }
}

/* Searches the usual folders for the last part of a path. */
static file_bytes search_file(burnish_reader *reader, const char *base) {
    static const char *const folders[] = {
        "textures",           "../textures",           "texture",   "../texture",
        "materials/textures", "../materials/textures", "materials", "../materials"};
    enum { LONGEST = 32 }; /* of the folders */
    char name[BURNISH_COMPANION_SIZE + LONGEST], path[BURNISH_COMPANION_SIZE];
    file_bytes file = {0};
    for (size_t i = 0; i < sizeof folders / sizeof *folders && !file.is_found &&
                       reader->mesh->memory.status == BURNISH_STATUS_OK;
         ++i) {
        burnish_error unused = {0};
        snprintf(name, sizeof name, "%s/%s", folders[i], base);
        if (burnish_companion_path(reader->input, name, path)) {
            file = open_file(reader, path, &unused);
        }
    }
    return file;
}

/* The file of that name, or else its last part next to the input or in the usual folders. */
static file_bytes find_file(burnish_reader *reader, const char *name, burnish_error *why) {
    char path[BURNISH_COMPANION_SIZE], spelled[BURNISH_COMPANION_SIZE];
    burnish_error unused = {0};
    file_bytes file = {0};
    if (strlen(name) >= sizeof spelled) {
        burnish_fail(why, BURNISH_STATUS_READ, "its name is not a file name");
        return file;
    }
    if (!reader->input->companions.load) {
        burnish_fail(why, BURNISH_STATUS_READ, "the input has no folder");
        return file;
    }
    for (size_t i = 0; i <= strlen(name); ++i) {
        spelled[i] = name[i] == '\\' ? '/' : name[i];
    }
    if (burnish_companion_path(reader->input, spelled, path)) {
        file = open_file(reader, path, why);
    } else {
        burnish_companion_outside(reader->input, spelled, why);
    }
    const char *slash = strrchr(spelled, '/'), *base = slash ? slash + 1 : spelled;
    if (*spelled == '/' || (*spelled && spelled[1] == ':')) {
        burnish_fail(why, BURNISH_STATUS_READ,
                     "it is a path of another machine; put the texture next to the file, or into "
                     "textures/ there");
    }
    const int is_name = *base && strcmp(base, ".") != 0 && strcmp(base, "..") != 0;
    if (!file.is_found && slash && is_name && reader->mesh->memory.status == BURNISH_STATUS_OK &&
        burnish_companion_path(reader->input, base, path)) {
        file = open_file(reader, path, &unused);
    }
    if (!file.is_found && is_name && reader->textures->searched < SEARCHED_MAX) {
        reader->textures->searched += 1;
        file = search_file(reader, base);
    }
    if (!file.is_found) {
        burnish_companion_missing(reader->input, why);
    }
    return file;
}

static int load_and_decode(burnish_reader *reader, const char *name, int is_color,
                           burnish_error *why) {
    int number = 0;
    if (!take_ahead(reader, name, NULL, 0, is_color, &number, why)) {
        const file_bytes file = find_file(reader, name, why);
        number = file.is_found && count_file(reader, file.key, file.size, why)
                     ? decode_texture(reader, name, file.bytes, file.size, is_color, why)
                     : 0;
        close_file(reader, &file);
    }
    return number;
}

int burnish_reader_load_texture(burnish_reader *reader, const uint8_t *at, const char *name,
                                int is_color) {
    struct burnish_texture_names *names = names_of(reader);
    burnish_memory *memory = &reader->mesh->memory;
    burnish_error why = {0};
    if (!names || memory->status != BURNISH_STATUS_OK || reader->input->options->ignore_textures) {
        return 0;
    }
    texture_name *known = find_name(names, name, is_color);
    if (!known) {
        burnish_fail(&why, BURNISH_STATUS_LIMIT, "only the first %d textures are used", NAMES_MAX);
    } else if (known->name) {
        return known->number;
    } else {
        char *copy = burnish_allocate(memory, strlen(name) + 1, 1, "a name");
        if (!copy) {
            return 0;
        }
        strcpy(copy, name);
        *known = (texture_name){copy, is_color, 0};
        names->count += 1;
        known->number = load_and_decode(reader, name, is_color, &why);
    }
    if ((!known || known->number == 0) && memory->status == BURNISH_STATUS_OK) {
        note_missing(reader, at, name, why.text);
    }
    return known ? known->number : 0;
}

/* ---- Ahead ---- */

static void decode_task(void *context, size_t i, int thread) {
    ahead_picture *ahead = (ahead_picture *)context + i;
    (void)thread;
    if (!is_refused(ahead)) {
        burnish_memory memory = burnish_memory_of(ahead->memory, &ahead->why);
        ahead->status = burnish_decode(&ahead->from, &memory, &ahead->picture);
    }
}

/* Opens a file, or takes bytes. */
static void begin_ahead(burnish_reader *reader, const burnish_texture_source *source,
                        uint64_t max_pixels, ahead_picture *ahead, file_bytes *file) {
    ahead->source = *source;
    ahead->memory = reader->mesh->memory.context;
    ahead->from =
        encoded_picture(source->name, source->bytes, source->size, max_pixels, &ahead->decoded);
    if (!source->bytes) {
        *file = find_file(reader, source->name, &ahead->why);
        ahead->from.bytes = file->bytes;
        ahead->from.size = file->size;
        ahead->key = file->key;
        ahead->status = file->is_found ? BURNISH_STATUS_OK : BURNISH_STATUS_READ;
    }
}

/* Decodes `count` pictures in parallel, which share the remaining texels. Returns how many can't be
 * loaded. */
static int decode_wave(burnish_reader *reader, const burnish_texture_source *sources,
                       size_t count) {
    struct burnish_texture_names *names = reader->textures;
    burnish_memory *memory = &reader->mesh->memory;
    ahead_picture *wave = names->ahead + names->ahead_count;
    const uint64_t most = texels_left(reader) / count;
    file_bytes files[WAVE_MAX] = {{0}};
    int refused = 0;
    for (size_t i = 0; i < count && memory->status == BURNISH_STATUS_OK; ++i) {
        begin_ahead(reader, &sources[i], most, &wave[i], &files[i]);
    }
    if (memory->status == BURNISH_STATUS_OK) {
        burnish_tasks_run(reader->mesh->tasks, count, 1, 0, decode_task, wave);
    }
    for (size_t i = 0; i < count; ++i) {
        close_file(reader, &files[i]);
        names->ahead_texels += texels_of(&wave[i].picture);
        refused += is_refused(&wave[i]);
    }
    names->ahead_count += count;
    return refused;
}

void burnish_reader_decode_ahead(burnish_reader *reader, const burnish_texture_source *sources,
                                 size_t count) {
    burnish_memory *memory = &reader->mesh->memory;
    const int threads = burnish_tasks_threads(reader->mesh->tasks);
    const size_t most = threads < WAVE_MAX / 2 ? 2 * (size_t)threads : WAVE_MAX;
    int refused = 0;
    if (threads < 2 || count < 2 || reader->input->options->ignore_textures || !names_of(reader) ||
        reader->textures->ahead) {
        return;
    }
    count = count < AHEAD_MAX ? count : AHEAD_MAX;
    reader->textures->ahead =
        burnish_allocate_zeroed(memory, count, sizeof *reader->textures->ahead, "textures");
    for (size_t first = 0, size;
         first < count && refused < AHEAD_REFUSED && memory->status == BURNISH_STATUS_OK;
         first += size) {
        size = count - first < most ? count - first : most;
        refused += decode_wave(reader, sources + first, size);
    }
}

void burnish_reader_close(burnish_reader *reader) {
    const burnish_context *context = reader->mesh->memory.context;
    burnish_release(context, reader->polygons);
    reader->polygons = NULL;
    reader->polygon_count = reader->polygon_capacity = 0;
    burnish_release(context, reader->companions);
    reader->companions = NULL;
    reader->companion_count = reader->companion_capacity = 0;
    close_textures(reader);
}
