/* What every command that loads a mesh takes: INPUT and the flags that say how it is read. */
#ifndef TOOL_CLI_INPUT_H
#define TOOL_CLI_INPUT_H

#include "burnish/mesh.h"
#include "cli/values.h"

/* What --input-format names besides burnish's own formats: endings of files that importers read
 * (docs/importers.md). Of two importers with the same one the first counts. Endings that mean other
 * things more often (.xml, .raw, .bvh, .csm ...) are left out. */
#define CLI_OCCT_LIST(X) X(step) X(stp) X(p21) X(iges) X(igs) X(brep) X(brp)
#define CLI_ASSIMP_LIST(X)                                                                         \
    X(3ds)                                                                                         \
    X(ac)                                                                                          \
    X(ac3d)                                                                                        \
    X(acc)                                                                                         \
    X(amf)                                                                                         \
    X(ase)                                                                                         \
    X(ask)                                                                                         \
    X(b3d)                                                                                         \
    X(blend)                                                                                       \
    X(cob)                                                                                         \
    X(dae)                                                                                         \
    X(dxf)                                                                                         \
    X(enff)                                                                                        \
    X(fbx)                                                                                         \
    X(hmp)                                                                                         \
    X(ifc)                                                                                         \
    X(ifczip)                                                                                      \
    X(iqm)                                                                                         \
    X(irrmesh)                                                                                     \
    X(lwo)                                                                                         \
    X(lxo)                                                                                         \
    X(md2)                                                                                         \
    X(md3)                                                                                         \
    X(md5mesh)                                                                                     \
    X(mdc)                                                                                         \
    X(mdl)                                                                                         \
    X(mesh)                                                                                        \
    X(ms3d)                                                                                        \
    X(ndo)                                                                                         \
    X(nff)                                                                                         \
    X(ogex)                                                                                        \
    X(pmx)                                                                                         \
    X(q3o)                                                                                         \
    X(q3s)                                                                                         \
    X(scn)                                                                                         \
    X(sib)                                                                                         \
    X(smd)                                                                                         \
    X(ter)                                                                                         \
    X(x)                                                                                           \
    X(x3d)                                                                                         \
    X(x3db)                                                                                        \
    X(xgl)                                                                                         \
    X(zae)                                                                                         \
    X(zgl)
#define CLI_FOREIGN_ENUM(word) CLI_FOREIGN_##word,
typedef enum cli_foreign {
    CLI_FOREIGN_BEFORE = 1000, /* beyond every burnish_format */
    CLI_OCCT_LIST(CLI_FOREIGN_ENUM) CLI_ASSIMP_LIST(CLI_FOREIGN_ENUM) CLI_FOREIGN_COUNT
} cli_foreign;

/* The ending that such a format is, without the point; NULL: a burnish_format. */
const char *cli_foreign_ending(int format);

/* ARGUMENT where a format is such an ending, for what runs no importers; else OK. */
burnish_status cli_refuse_foreign(int format, burnish_error *error);

typedef struct cli_input {
    int format; /* burnish_format or cli_foreign */
    int tessellation, strict, no_textures, no_libraries;
    cli_real animation_time;
    const char *animation;
    cli_real point_size;
    uint64_t max_triangles, max_input_bytes, max_texture_pixels;
} cli_input;

/* The library's options as the flags say. A cli_foreign stays in them as it is, for import_load and
 * sandbox_load: the library knows none. */
burnish_load_options cli_load_options(const cli_input *input);

#define CLI_INPUT_ENDING(name, word, endings, ...) " " endings
#define CLI_INPUT_HELP                                                                             \
    (&BURNISH_FORMAT_LIST(CLI_INPUT_ENDING) "; - standard input; :teapot :sphere :torus :knot"[1])

/* Files that an input in memory may name. */
typedef struct cli_companion {
    const char *name;
    const void *bytes;
    size_t size;
} cli_companion;
typedef struct cli_companions {
    cli_companion *items;
    size_t count;
} cli_companions;

/* A loader of these and no others; they stay until loading is over. */
burnish_file_loader cli_companion_loader(cli_companions *companions);

/* Tables for the flags' rows. */
extern const cli_word cli_input_formats[];
extern const char cli_input_format_manual[];
cli_handler cli_flag_input_format;
cli_handler cli_flag_texture_pixels; /* uint64_t in [low, high], or "auto" */

/* The rows; `type` has the cli_input `member`. The first one's group stands before it. */
#define CLI_INPUT_FORMAT_FLAG(type, member)                                                        \
    .name = "input-format", .aliases = "format", .value = "NAME", .help = "fbx ... or",            \
    .default_text = "auto", .manual = cli_input_format_manual, .handler = cli_flag_input_format,   \
    .words = cli_input_formats, .offset = offsetof(type, member.format)

#define CLI_TESSELLATION_FLAG(type, member)                                                        \
    .name = "tessellation", .help = "segments per patch edge of built-in objects", .value = "N",   \
    .default_text = "16", .low = 1, .high = 256,                                                   \
    .manual = "Segments along a patch edge of a built-in object.", .handler = cli_flag_integer,    \
    .offset = offsetof(type, member.tessellation)

#define CLI_STRICT_FLAG(type, member)                                                              \
    .name = "strict", .help = "refuse what would only be a warning about INPUT",                   \
    .manual =                                                                                      \
        "A fault of _INPUT_ that is otherwise mended or passed over with a warning ends the "      \
        "run with exit code 4.",                                                                   \
    .handler = cli_flag_switch, .offset = offsetof(type, member.strict)

#define CLI_ANIMATION_TIME_FLAG(type, member)                                                      \
    .name = "animation-time", .value = "SECONDS", .help = "the moment of INPUT's animation",       \
    .default_label = "at rest", .low = 0, .high = 1e9,                                             \
    .manual = "Shows _INPUT_ as it is _SECONDS_ after the start of its animation (glTF). Without " \
              "this flag and *--animation* it is shown as its nodes stand in the file.",           \
    .handler = cli_flag_real, .offset = offsetof(type, member.animation_time)

#define CLI_ANIMATION_FLAG(type, member)                                                           \
    .name = "animation", .value = "NAME", .help = "which animation, by name or number from 0",     \
    .default_label = "the first",                                                                  \
    .manual = "Which animation of _INPUT_ *--animation-time* means: its name, or its number from " \
              "0. Without a time, its start is shown.",                                            \
    .handler = cli_flag_text, .offset = offsetof(type, member.animation)

#define CLI_POINT_SIZE_FLAG(type, member)                                                          \
    .name = "point-size", .value = "SIZE", .help = "diameter of points and lines",                 \
    .default_label = "by their density", .low = 1e-30, .high = 1e30,                               \
    .manual =                                                                                      \
        "Diameter, in the units of _INPUT_, in which the points of a file without faces are "      \
        "drawn as balls, or its lines as rods.",                                                   \
    .handler = cli_flag_real, .offset = offsetof(type, member.point_size)

#define CLI_NO_LIBRARIES_FLAG(type, member)                                                        \
    .name = "no-libraries", .help = "read no file that INPUT names",                               \
    .manual = "Reads _INPUT_ alone: no material library, no texture, no buffer that it names.",    \
    .handler = cli_flag_switch, .offset = offsetof(type, member.no_libraries)

#define CLI_MAX_TRIANGLES_FLAG(type, member)                                                       \
    .name = "max-triangles", .value = "N", .help = "refuse larger meshes",                         \
    .default_text = "1431655764", .low = 1, .high = 1431655764, .default_label = "1.43e9",         \
    .manual =                                                                                      \
        "Refuses meshes with more triangles (exit code 5). Without it, 5 vertices and triangles "  \
        "together are drawn for each byte of _INPUT_ and the files that it names, and 5,242,880 "  \
        "in any case: enough for what is in a file, but not for what a small one repeats.",        \
    .handler = cli_flag_count, .offset = offsetof(type, member.max_triangles)

#define CLI_NO_TEXTURES_FLAG(type, member)                                                         \
    .name = "no-textures", .help = "without the textures of materials",                            \
    .manual =                                                                                      \
        "Textures are neither loaded nor drawn: materials have the colours that _INPUT_ gives "    \
        "them besides.",                                                                           \
    .handler = cli_flag_switch, .offset = offsetof(type, member.no_textures)

#define CLI_MAX_TEXTURE_PIXELS_FLAG(type, member)                                                  \
    .name = "max-texture-pixels", .value = "N", .help = "leave out textures beyond, of all",       \
    .default_text = "auto", .low = 0, .high = 1e12,                                                \
    .manual =                                                                                      \
        "Textures that would make more than _N_ pixels together are left out, with a warning. "    \
        "By default 32 for each byte of _INPUT_ and the files that it names, 2^25 at least and "   \
        "2^28 at most.",                                                                           \
    .handler = cli_flag_texture_pixels, .offset = offsetof(type, member.max_texture_pixels)

#define CLI_MAX_INPUT_BYTES_FLAG(type, member)                                                     \
    .name = "max-input-bytes", .help = "refuse larger inputs; K, M, G for powers of 1024",         \
    .value = "N", .default_text = "16G", .low = 1, .high = 9e18,                                   \
    .manual =                                                                                      \
        "Refuses larger inputs (exit code 5). _N_ may end in *K*, *M* or *G*, powers of 1024.",    \
    .handler = cli_flag_bytes, .offset = offsetof(type, member.max_input_bytes)

#endif
