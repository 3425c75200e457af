#include "mesh/read/textures.h"

#include <stdio.h>
#include <string.h>

#include "image/decode.h"
#include "mesh/read/beside.h"

enum {
    TABLE_SIZE = 8192,          /* a power of two */
    NAMES_MAX = TABLE_SIZE / 2, /* files that one input may name */
    NAME_SIZE = 4096
};

/* A file that was asked for. */
typedef struct texture_name {
    char *name; /* NULL: a free slot */
    int is_color, number;
} texture_name;

struct burnish_texture_names {
    texture_name table[TABLE_SIZE]; /* open addressing */
    size_t count;
    uint64_t texels; /* of all textures so far */
    burnish_warning_group missing;
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

void burnish_reader_close_textures(burnish_reader *reader) {
    struct burnish_texture_names *names = reader->textures;
    if (!names) {
        return;
    }
    burnish_reader_warn_group(reader, &names->missing);
    for (size_t i = 0; i < TABLE_SIZE; ++i) {
        burnish_release(reader->mesh->memory.context, names->table[i].name);
    }
    burnish_release(reader->mesh->memory.context, names);
    reader->textures = NULL;
}

static void note_missing(burnish_reader *reader, const uint8_t *at, const char *name,
                         const char *why) {
    burnish_reader_note(reader, &reader->textures->missing, at, "texture \"%.80s\" is left out: %s",
                        name, why);
}

/* ---- Decoding ---- */

/* Errors go to *why; only those of memory are the reader's. Returns 1 + number, or 0. */
static int decode(burnish_reader *reader, const char *name, const uint8_t *bytes, size_t size,
                  int is_color, burnish_error *why) {
    struct burnish_texture_names *names = reader->textures;
    const uint64_t most = reader->input->options->max_texture_pixels;
    const burnish_encoded from = {.bytes = bytes,
                                  .size = size,
                                  .name = name,
                                  .channels = 4,
                                  .max_side = BURNISH_TEXTURE_SIZE_MAX,
                                  .max_pixels = most > names->texels ? most - names->texels : 0};
    burnish_memory memory = burnish_memory_of(reader->mesh->memory.context, why);
    burnish_image picture;
    burnish_status status = burnish_decode(&from, &memory, &picture);
    if (status == BURNISH_STATUS_MEMORY) {
        reader->mesh->memory.status = status;
        if (reader->mesh->memory.error) {
            *reader->mesh->memory.error = *why;
        }
    }
    if (status != BURNISH_STATUS_OK) {
        return 0;
    }
    names->texels += (uint64_t)picture.width * (uint64_t)picture.height;
    return burnish_mesh_data_add_texture(reader->mesh, name, picture.width, picture.height,
                                         picture.pixels, is_color);
}

int burnish_reader_decode_texture(burnish_reader *reader, const uint8_t *at, const char *name,
                                  const uint8_t *bytes, size_t size, int is_color) {
    burnish_error why = {0};
    if (!names_of(reader)) {
        return 0;
    }
    const int number = decode(reader, name, bytes, size, is_color, &why);
    if (number == 0 && reader->mesh->memory.status == BURNISH_STATUS_OK) {
        note_missing(reader, at, name, why.text);
    }
    return number;
}

/* ---- Files ---- */

/* Loads and decodes one file; *found becomes 1 where it is there. */
static int open_file(burnish_reader *reader, const char *path, const char *name, int is_color,
                     int *found, burnish_error *why) {
    const burnish_file_loader *companions = &reader->input->companions;
    const void *bytes = NULL;
    size_t size = 0;
    burnish_status status = companions->load(
        companions->user_data, path, reader->input->options->max_input_bytes, &bytes, &size, why);
    if (status == BURNISH_STATUS_MEMORY) {
        reader->mesh->memory.status = status;
        if (reader->mesh->memory.error) {
            *reader->mesh->memory.error = *why;
        }
    }
    if (status != BURNISH_STATUS_OK) {
        return 0;
    }
    *found = 1;
    const int number = decode(reader, name, bytes, size, is_color, why);
    if (companions->release) {
        companions->release(companions->user_data, bytes, size);
    }
    return number;
}

/* The file as it is named, or else its last part beside the input. */
static int find_file(burnish_reader *reader, const char *name, int is_color, burnish_error *why) {
    char path[NAME_SIZE];
    int found = 0, number = 0;
    if (strlen(name) >= sizeof path) {
        burnish_fail(why, BURNISH_STATUS_READ, "its name is no file name");
        return 0;
    }
    if (!reader->input->companions.load) {
        burnish_fail(why, BURNISH_STATUS_READ, "the input has no folder");
        return 0;
    }
    for (size_t i = 0; i <= strlen(name); ++i) {
        path[i] = name[i] == '\\' ? '/' : name[i];
    }
    const char *slash = strrchr(path, '/');
    if (*path && burnish_stays_beside(path)) {
        number = open_file(reader, path, name, is_color, &found, why);
    } else if (!slash || !slash[1] || !burnish_stays_beside(slash + 1)) {
        burnish_fail(why, BURNISH_STATUS_READ, "it lies outside the folder of the file");
    }
    if (!found && slash && slash[1] && burnish_stays_beside(slash + 1) &&
        reader->mesh->memory.status == BURNISH_STATUS_OK) {
        number = open_file(reader, slash + 1, name, is_color, &found, why);
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
        burnish_fail(&why, BURNISH_STATUS_LIMIT, "the first %d textures are enough", NAMES_MAX);
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
        known->number = find_file(reader, name, is_color, &why);
    }
    if ((!known || known->number == 0) && memory->status == BURNISH_STATUS_OK) {
        note_missing(reader, at, name, why.text);
    }
    return known ? known->number : 0;
}
