/* The table of formats, and how an input is read. */
#include "mesh/read/read.h"

#include <string.h>

#include "base/bytes.h"
#include "base/inputs.h"
#include "image/decode/gunzip.h"
#include "mesh/read/common/damage.h"
#include "mesh/read/common/local_origin.h"
#include "mesh/read/common/textures.h"
#include "mesh/read/io/streaming.h"
#include "mesh/read/stl.h"

typedef struct format_row {
    burnish_format_info info;
    const burnish_format_reader *reader; /* NULL: not a format of files */
} format_row;

static const format_row formats[BURNISH_FORMAT_COUNT] = {
    [BURNISH_FORMAT_AUTO] = {.info = {"auto", "", {0, 1, 0}, 0}},
    [BURNISH_FORMAT_BUILTIN] = {.info = {"builtin", "", {0, 1, 0}, 0}},
    [BURNISH_FORMAT_ARRAYS] = {.info = {"arrays", "", {0, 1, 0}, 0}},
#define ROW(name, word, extensions, x, y, z)                                                       \
    [BURNISH_FORMAT_##name] = {{#word, extensions, {x, y, z}, 1}, &burnish_reader_##word},
    BURNISH_FORMAT_LIST(ROW)
#undef ROW
};

int burnish_format_count(void) {
    return BURNISH_FORMAT_COUNT;
}

const burnish_format_info *burnish_format_get_info(burnish_format format) {
    return (unsigned)format < BURNISH_FORMAT_COUNT ? &formats[format].info : NULL;
}

/* Whether a name has one of the extensions, which blanks separate, in any case and with or without
 * ".gz". */
static int has_extension(const char *name, const char *extensions) {
    size_t length = strlen(name);
    if (length > 3 &&
        burnish_bytes_are_caseless((const uint8_t *)name + length - 3, (const uint8_t *)".gz", 3)) {
        length -= 3;
    }
    while (*extensions) {
        const size_t size = strcspn(extensions, " ");
        if (length >= size && burnish_bytes_are_caseless((const uint8_t *)name + length - size,
                                                         (const uint8_t *)extensions, size)) {
            return 1;
        }
        extensions += size + strspn(extensions + size, " ");
    }
    return 0;
}

burnish_format burnish_format_of_name(const char *name) {
    for (int i = BURNISH_FORMAT_COUNT - 1; i > 0 && name; --i) {
        if (formats[i].reader && has_extension(name, formats[i].info.extensions)) {
            return (burnish_format)i;
        }
    }
    return BURNISH_FORMAT_AUTO;
}

burnish_format burnish_guess_format(const uint8_t *bytes, size_t size, const char *name) {
    enum { LOOKED_AT = 512 };
    const burnish_format named = burnish_format_of_name(name);
    burnish_format guess = BURNISH_FORMAT_AUTO;
    int most = 0;
    /* text or an archive that starts like another format, not like the named one */
    if (named != BURNISH_FORMAT_AUTO && !formats[named].reader->recognise(bytes, size) &&
        (burnish_reader_3mf.recognise(bytes, size) ||
         burnish_are_text(bytes, size < LOOKED_AT ? size : LOOKED_AT))) {
        name = NULL;
    }
    for (int i = BURNISH_FORMAT_COUNT - 1; i > 0; --i) {
        if (formats[i].reader) {
            /* Certain bytes, then the file extension, then bytes that are not certain. */
            const int sure = formats[i].reader->recognise(bytes, size);
            const int votes = sure == 2 ? 3 : name && named == (burnish_format)i ? 2 : sure;
            guess = votes > most ? (burnish_format)i : guess;
            most = votes > most ? votes : most;
        }
    }
    /* many texts begin with a brace, or are lines of numbers */
    const int is_weak = most == 1 && (guess == BURNISH_FORMAT_GLTF || guess == BURNISH_FORMAT_XYZ);
    const int is_other =
        is_weak && (named != BURNISH_FORMAT_AUTO || burnish_describe_foreign(bytes, size, NULL));
    return most > 0 && !is_other ? guess : named;
}

/* A binary STL is recognised by its size, which is unknown for a stream. Here it is recognised by
 * its coordinates, which are not all 0, and usual but for a few facets. */
static int may_be_binary_stl(const uint8_t *bytes, size_t size) {
    enum { COORDINATES = 9, MOST_ODD = 64 /* one facet in so many */ };
    uint32_t any = 0;
    size_t facets = 0, odd = 0;
    for (size_t at = BURNISH_STL_HEADER_SIZE; at + BURNISH_STL_FACET_SIZE <= size;
         at += BURNISH_STL_FACET_SIZE, ++facets) {
        int is_odd = 0;
        for (size_t i = 0; i < COORDINATES; ++i) {
            const uint32_t bits = burnish_load32(bytes + at + BURNISH_STL_NORMAL_SIZE + 4 * i);
            is_odd |= burnish_is_odd_coordinate(bits);
            any |= bits << 1; /* without the sign */
        }
        odd += (size_t)is_odd;
    }
    return any && odd <= facets / MOST_ODD && !burnish_are_text(bytes, size);
}

/* Wrapped text, or an archive. In UTF-16, more than half of a mesh's characters are ASCII. */
static int may_be_wrapped(const uint8_t *bytes, size_t size) {
    if (burnish_has_utf16_mark(bytes, size)) {
        const size_t high = bytes[0] == 0xFF; /* the byte of a character that is 0 then */
        size_t ascii = 0;
        for (size_t i = 0; i + 1 < size; i += 2) {
            ascii += bytes[i + high] == 0 && bytes[i + !high] > 0;
        }
        return ascii > size / 4;
    }
    return burnish_is_gzip(bytes, size) || burnish_reader_3mf.recognise(bytes, size);
}

int burnish_may_be(burnish_format format, const uint8_t *bytes, size_t size, const char *name) {
    const int is_any = format == BURNISH_FORMAT_AUTO;
    if (format == BURNISH_FORMAT_COUNT || may_be_wrapped(bytes, size)) {
        return 1;
    }
    const burnish_format guess = is_any ? burnish_guess_format(bytes, size, name) : format;
    const int votes =
        guess != BURNISH_FORMAT_AUTO ? formats[guess].reader->recognise(bytes, size) : 0;
    if (votes == 2 ||
        ((is_any || format == BURNISH_FORMAT_STL) && may_be_binary_stl(bytes, size))) {
        return 1;
    }
    if (memchr(bytes, 0, size)) { /* no text, whatever its first byte */
        return 0;
    }
    size_t at = 0;
    while (at < size && bytes[at] <= ' ') {
        ++at;
    }
    const int is_comment = at < size && bytes[at] == '#';
    return votes || (is_any && guess != BURNISH_FORMAT_AUTO) ||
           ((is_any || format == BURNISH_FORMAT_OBJ) && is_comment);
}

burnish_format burnish_streamed_format(burnish_format format, const uint8_t *head, size_t size,
                                       const char *name) {
    const int is_any = format == BURNISH_FORMAT_AUTO;
    const burnish_format guess =
        is_any ? burnish_guess_format(head, BURNISH_STREAMED_HEAD, name) : format;
    const int is_stl = burnish_is_binary_stl(head, size);
    if (burnish_is_gzip(head, size)) {
        return BURNISH_FORMAT_AUTO;
    }
    if (is_stl) { /* certain by its size, unless its bytes indicate another format */
        const burnish_format other =
            is_any ? burnish_guess_format(head, BURNISH_STREAMED_HEAD, NULL) : format;
        return other == BURNISH_FORMAT_STL || (is_any && other == BURNISH_FORMAT_AUTO)
                   ? BURNISH_FORMAT_STL
                   : BURNISH_FORMAT_AUTO;
    }
    const int can_stream = formats[guess].reader && formats[guess].reader->can_stream;
    return can_stream && !burnish_has_utf16_mark(head, size) ? guess : BURNISH_FORMAT_AUTO;
}

/* The usual name of a format. */
static const char *shown_format(burnish_format format) {
#define SHOWN(name, ...) [BURNISH_FORMAT_##name] = #name,
    static const char *const names[BURNISH_FORMAT_COUNT] = {BURNISH_FORMAT_LIST(SHOWN)};
#undef SHOWN
    return format == BURNISH_FORMAT_GLTF ? "glTF" : names[format];
}

/* Warns of a file whose contents contradict its name. For a streamed input, this is not a reason
 * to read all of it. */
static void warn_misnamed(burnish_reader *reader, burnish_format format) {
    static const char others[] = ".step .stp .iges .igs .fbx .dae .3ds "; /* of importers */
    const char *name = reader->input->name, *dot = strrchr(name, '.');
    const burnish_format named = burnish_format_of_name(name);
    char extension[BURNISH_EXTENSION_SIZE];
    burnish_lower_extension(name, strlen(name), extension);
    const int is_other =
        format != BURNISH_FORMAT_BMS && strlen(extension) > 2 && strstr(others, extension);
    if (reader->input->options->format == BURNISH_FORMAT_AUTO && !reader->has_warned &&
        (named != BURNISH_FORMAT_AUTO ? named != format : is_other)) {
        burnish_mesh_data_warn(reader->mesh, "%s: the file is %s, not %s as its name says",
                               burnish_show_name(name).text, shown_format(format),
                               is_other ? dot : shown_format(named));
    }
}

/* Fails with FORMAT for another kind of file. */
static burnish_status refuse_foreign(burnish_reader *reader, const char *what) {
    return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                               "%s, which contradicts its name; fetch or export it again", what);
}

/* ---- Invisible inputs ---- */

/* An input in which everything is fully transparent would give an empty image. Most such files come
 * from exporters that write transparency for opacity or leave alpha at 0. A single transparent part
 * among visible ones stays transparent. */
static int is_invisible(const burnish_material *material) {
    const int is_kept = material->alpha_mode == BURNISH_ALPHA_MASK && !(material->alpha_cutoff > 0);
    return material->transparency >= 1 && !is_kept;
}

/* Whether one of a triangle's vertices has an alpha above 0, or no colour at all. */
static int has_visible_corner(const burnish_mesh_data *mesh, size_t triangle) {
    const uint32_t *corners = burnish_stream_corners(mesh, BURNISH_COLOR) + 3 * triangle;
    const uint8_t *rgba = burnish_colors(mesh);
    int any = 0;
    for (int k = 0; k < 3; ++k) {
        any |= corners[k] == BURNISH_NONE || rgba[4 * (size_t)corners[k] + 3] > 0;
    }
    return any;
}

static int is_anything_visible(const burnish_mesh_data *mesh) {
    const int has_colors = mesh->streams[BURNISH_COLOR].count > 0;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        const size_t number = mesh->triangle_materials ? mesh->triangle_materials[i] : 0;
        const burnish_material *material =
            number < mesh->material_count ? &mesh->materials[number] : NULL;
        if (!(material && is_invisible(material)) && (!has_colors || has_visible_corner(mesh, i))) {
            return 1;
        }
    }
    return mesh->triangle_count == 0;
}

static void show_transparent(burnish_reader *reader) {
    burnish_mesh_data *mesh = reader->mesh;
    if (is_anything_visible(mesh)) {
        return;
    }
    for (size_t i = 0; i < mesh->material_count; ++i) {
        burnish_material *material = &mesh->materials[i];
        material->transparency = is_invisible(material) ? 0 : material->transparency;
    }
    for (size_t i = 0; i < mesh->streams[BURNISH_COLOR].count; ++i) {
        burnish_colors(mesh)[4 * i + 3] = 255;
    }
    burnish_reader_warn(reader, NULL, "everything is fully transparent (alpha 0) and drawn opaque");
}

/* ---- Reading ---- */

/* Draws what is fully transparent, and reports that parts have been merged. */
static void finish(burnish_reader *reader) {
    show_transparent(reader);
    if (reader->mesh->part_count == BURNISH_PARTS_MAX) {
        burnish_reader_warn(reader, NULL,
                            "part %d takes all further ones; split the file to hide or colour them",
                            BURNISH_PARTS_MAX);
    }
}

burnish_status burnish_read(burnish_reader *reader, burnish_format *format) {
    const burnish_reader_input *input = reader->input;
    if (input->size == 0) {
        reader->is_binary = 1;
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, input->bytes,
                                   "the file is empty");
    }
    const int is_guessed = *format == BURNISH_FORMAT_AUTO;
    if (is_guessed) {
        *format = burnish_guess_format(input->bytes, input->size, input->name);
    }
    burnish_status status;
    if (input->options->origin) {
        memcpy(reader->mesh->origin, input->options->origin, sizeof reader->mesh->origin);
    }
    if (burnish_is_lfs_pointer(input->bytes, input->size)) {
        status =
            burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                "a Git LFS pointer, not the file; fetch the file (git lfs pull)");
    } else if (formats[*format].reader) {
        const char *what =
            is_guessed && !formats[*format].reader->recognise(input->bytes, input->size)
                ? burnish_describe_foreign(input->bytes, input->size, NULL)
                : NULL;
        /* any bytes may be the facets of an STL whose count is wrong */
        status = what && *format == BURNISH_FORMAT_STL ? refuse_foreign(reader, what)
                                                       : formats[*format].reader->read(reader);
        if (status == BURNISH_STATUS_FORMAT && reader->damage.count > 0) {
            burnish_fail(reader->error, status, "%s", reader->damage.first.text);
        } else if (status == BURNISH_STATUS_OK) {
            status = burnish_drop_damage(reader);
        }
        if (status == BURNISH_STATUS_FORMAT && what) {
            status = refuse_foreign(reader, what);
        } else if (status == BURNISH_STATUS_OK) {
            warn_misnamed(reader, *format);
        }
    } else {
#define NAME(name, word, ...) ", " #word
        static const char names[] = BURNISH_FORMAT_LIST(NAME);
#undef NAME
        const char *what = burnish_describe_foreign(input->bytes, input->size, input->name);
        status = what ? burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                            "%s, which burnish can't read; convert it to one of %s",
                                            what, names + 2)
                      : burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                            "neither its name nor its first bytes identify the "
                                            "format; name the input format, one of %s",
                                            names + 2);
    }
    burnish_reader_close(reader);
    if (status == BURNISH_STATUS_OK && !input->options->origin && reader->is_wide) {
        status = burnish_read_from_origin(reader, formats[*format].reader->read);
    }
    if (status == BURNISH_STATUS_OK) {
        reader->mesh->has_average_normals |= formats[*format].reader->averages_normals;
        finish(reader);
    }
    return status;
}
