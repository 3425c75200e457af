/* INPUT and the input flags, for all commands that load a mesh. */
#ifndef TOOL_CLI_INPUT_H
#define TOOL_CLI_INPUT_H

#include "base/cli/values.h"
#include "burnish/mesh.h"

/* Formats of --input-format that importers read (docs/importers.md), named by file extension. If
 * two importers have the same one, the first counts. Extensions with other, more common meanings
 * (.xml, .raw, .bvh, .csm ...) are omitted. */
#define CLI_OCCT_LIST(X) X(step) X(stp) X(p21) X(iges) X(igs) X(brep) X(brp)
/* clang-format off */
#define CLI_ASSIMP_LIST(X) \
    X(3ds) X(ac) X(ac3d) X(acc) X(ase) X(ask) X(b3d) X(blend) X(cob) X(dae) X(dxf) \
    X(enff) X(fbx) X(hmp) X(ifc) X(ifczip) X(iqm) X(irrmesh) X(lwo) X(lxo) X(md2) X(md3) \
    X(md5mesh) X(mdc) X(mdl) X(mesh) X(ms3d) X(ndo) X(nff) X(ogex) X(pmx) X(q3o) X(q3s) X(scn) \
    X(sib) X(smd) X(ter) X(x) X(x3d) X(x3db) X(xgl) X(zae) X(zgl)
/* clang-format on */
#define CLI_FOREIGN_ENUM(word) CLI_FOREIGN_##word,
typedef enum cli_foreign {
    CLI_FOREIGN_BEFORE = 1000, /* above all values of burnish_format */
    CLI_OCCT_LIST(CLI_FOREIGN_ENUM) CLI_ASSIMP_LIST(CLI_FOREIGN_ENUM) CLI_FOREIGN_COUNT
} cli_foreign;

/* The file extension of an importer's format, without the dot; NULL for a burnish_format. */
const char *cli_foreign_extension(int format);

/* The format that burnish reads by a file's extension, also with .gz; AUTO: none. And whether it or
 * importers read it. */
burnish_format cli_own_format(const char *name);
int cli_is_mesh_name(const char *name);

/* The name of an input without folders: of the file, the file in an archive, or the built-in object. */
const char *cli_model_name(const char *input);

/* The length of a file's name without its extension, and without .gz after the one of a mesh. */
size_t cli_stem_length(const char *base);

/* ARGUMENT for an importer's format, in programs that run no importers; else OK. */
burnish_status cli_refuse_foreign(int format, burnish_error *error);

enum { CLI_NAMES_SIZE = 1024 }; /* of all names of --hide or --only */
/* The joints of --joint. */
enum { CLI_JOINTS_MAX = 32 };
typedef struct cli_joints {
    burnish_joint items[CLI_JOINTS_MAX];
    size_t count;
} cli_joints;

typedef struct cli_input {
    int format; /* burnish_format or cli_foreign */
    int tessellation, strict, no_textures, no_libraries;
    cli_real animation_time;
    const char *animation, *variant, *root;
    int plate;                 /* 0: all; CLI_PLATE_SHEET */
    burnish_project **project; /* kept between loads of plates; NULL: is not */
    char hidden_parts[CLI_NAMES_SIZE], only_parts[CLI_NAMES_SIZE]; /* "": not given */
    cli_real explode;
    int thumbnail; /* burnish_thumbnail */
    cli_real point_size;
    uint64_t max_triangles, max_input_bytes, max_texture_pixels;
    uint64_t max_memory; /* of loading and drawing: 0: no limit */
    cli_joints joints;
    int scene;         /* 1: all inputs are one scene */
    const char *items; /* of this scene, as JSON; NULL: one input (import/scene.h) */
} cli_input;

/* The library's options for these flags, which refer to the joints. A cli_foreign is kept as the format, for import_load: the
 * library does not know it. */
burnish_load_options cli_load_options(const cli_input *input);

#define CLI_INPUT_EXTENSION(name, word, extensions, ...) " " extensions
#define CLI_INPUT_EXTENSIONS BURNISH_FORMAT_LIST(CLI_INPUT_EXTENSION)
#define CLI_INPUT_HELP (&CLI_INPUT_EXTENSIONS "; - standard input; :teapot :sphere :torus :knot"[1])

/* Files that an input in memory can refer to. */
typedef struct cli_companion {
    const char *name;
    const void *bytes;
    size_t size;
} cli_companion;
typedef struct cli_companions {
    cli_companion *items;
    size_t count;
} cli_companions;

/* A loader of only these files, which must live until loading ends. */
burnish_file_loader cli_companion_loader(cli_companions *companions);

/* Tables for the flags' rows. */
extern const cli_word cli_input_formats[];
extern const char cli_input_format_manual[];
extern const cli_word cli_thumbnails[];
cli_handler cli_flag_input_format;
cli_handler cli_flag_plate;          /* int in [low, high], "all", or "sheet" */
cli_handler cli_flag_part_names;     /* char[CLI_NAMES_SIZE]: adds names, between commas */
cli_handler cli_flag_joint;          /* cli_joints */
cli_handler cli_flag_texture_pixels; /* uint64_t in [low, high], or "auto" */

/* What the flags below need of the input; without a mesh, as if nothing were met. */
enum { CLI_INPUT_NEEDS = 10 };
void cli_list_input_needs(const burnish_mesh *mesh, cli_need needs[CLI_INPUT_NEEDS]);

/* The rows; `type` has the cli_input `member`. */
#define CLI_INPUT_FORMAT_FLAG(type, member)                                                        \
    .phases = CLI_PHASE_LOAD, .name = "input-format", .aliases = "force-reader,import-format",     \
    .value = "NAME", .help = "as", .default_text = "auto", .manual = cli_input_format_manual,      \
    .handler = cli_flag_input_format, .words = cli_input_formats,                                  \
    .offset = offsetof(type, member.format)

#define CLI_TESSELLATION_FLAG(type, member)                                                        \
    .phases = CLI_PHASE_LOAD, .name = "tessellation",                                              \
    .help = "segments per patch edge of built-in objects", .value = "N", .default_text = "16",     \
    .low = 1, .high = 256, .manual = "Segments along a patch edge of a built-in object.",          \
    .handler = cli_flag_integer, .offset = offsetof(type, member.tessellation)

#define CLI_STRICT_FLAG(type, member)                                                              \
    .phases = CLI_PHASE_LOAD, .svg = CLI_SVG_SAME, .name = "strict",                               \
    .help = "treat warnings about INPUT and flags as errors",                                      \
    .manual = "A fault of _INPUT_ that is otherwise repaired or ignored with a warning ends the "  \
              "run with exit code 4, and a flag without an effect with exit code 2.",              \
    .handler = cli_flag_switch, .offset = offsetof(type, member.strict)

#define CLI_ANIMATION_TIME_FLAG(type, member)                                                      \
    .phases = CLI_PHASE_LOAD, .name = "animation-time", .value = "SECONDS",                        \
    .help = "time in INPUT's animation", .default_label = "at rest", .low = 0, .high = 1e9,        \
    .manual = "Shows _INPUT_ at _SECONDS_ after the start of its animation (glTF). Without "       \
              "this flag and *--animation* it is shown in the rest pose of the file.",             \
    .handler = cli_flag_real, .offset = offsetof(type, member.animation_time)

#define CLI_ANIMATION_FLAG(type, member)                                                           \
    .phases = CLI_PHASE_LOAD, .value_type = CLI_TYPE_NAME, .name = "animation", .value = "NAME",   \
    .help = "which animation, by name or number from 0", .default_label = "the first",             \
    .manual = "The animation of _INPUT_ for *--animation-time*: its name, or its number from "     \
              "0. Without a time, its start is shown.",                                            \
    .handler = cli_flag_text, .offset = offsetof(type, member.animation)

#define CLI_VARIANT_FLAG(type, member)                                                             \
    .phases = CLI_PHASE_LOAD, .value_type = CLI_TYPE_NAME, .name = "variant", .value = "NAME",     \
    .help = "materials of a variant of INPUT", .default_label = "the file's own",                  \
    .manual = "Draws the variant _NAME_ of a glTF file, such as another colour of a product "      \
              "(KHR_materials_variants). *burnish info* lists the names.",                         \
    .handler = cli_flag_text, .offset = offsetof(type, member.variant)

enum { CLI_PLATE_SHEET = -1 };

#define CLI_PLATE_FLAG(type, member)                                                               \
    .phases = CLI_PHASE_LOAD, .value_type = CLI_TYPE_INTEGER, .name = "plate", .value = "N",       \
    .help = "a plate of a print project, all, or sheet", .default_text = "all", .low = 1,          \
    .high = 256,                                                                                   \
    .manual =                                                                                      \
        "Draws only plate _N_ of a slicer's project (3MF). By default *all* plates are drawn, "    \
        "moved close together. *sheet* draws one labelled picture per plate, in one scale. "       \
        "*burnish info* lists them.",                                                              \
    .handler = cli_flag_plate, .offset = offsetof(type, member.plate)

#define CLI_HIDE_FLAG(type, member)                                                                \
    .phases = CLI_PHASE_LOAD, .value_type = CLI_TYPE_NAME, .name = "hide", .value = "NAME,...",    \
    .help = "parts to leave out, such as \"screw*\"", .default_label = "none", .repeats = 1,       \
    .manual =                                                                                      \
        "Leaves out the parts of these names before the picture is framed, with the negative "     \
        "volumes of what is hidden. Parts are objects and volumes of 3MF, nodes of glTF, objects " \
        "or groups of OBJ, solids of a text STL, and products of STEP; *burnish info* lists "      \
        "them. In a name an asterisk stands for any text and ? for one byte, also for a comma; "   \
        "#2 is the second part of the list. A name that no part has is a warning. Can be "         \
        "repeated.",                                                                               \
    .handler = cli_flag_part_names, .offset = offsetof(type, member.hidden_parts)

#define CLI_ONLY_FLAG(type, member)                                                                \
    .phases = CLI_PHASE_LOAD, .value_type = CLI_TYPE_NAME, .name = "only", .value = "NAME,...",    \
    .help = "leave out all other parts", .default_label = "all", .repeats = 1,                     \
    .manual = "Draws only the parts of these names, as for *--hide*, with their negative "         \
              "volumes. It is an error if none of the parts has one of the names; an input "       \
              "without parts is drawn whole, with a warning. Can be repeated.",                    \
    .handler = cli_flag_part_names, .offset = offsetof(type, member.only_parts)

#define CLI_EXPLODE_FLAG(type, member)                                                             \
    .phases = CLI_PHASE_LOAD, .name = "explode", .value = "F", .help = "move parts apart",         \
    .default_text = "0", .low = 0, .high = 1000,                                                   \
    .manual =                                                                                      \
        "Moves each part away from the middle of all parts, by _F_ times the vector from there "   \
        "to its own middle, both of bounding boxes. Parts that a negative volume cuts together "   \
        "are moved together, and parts around one point stay in each other.",                      \
    .handler = cli_flag_real, .offset = offsetof(type, member.explode)

#define CLI_JOINT_FLAG(type, member)                                                               \
    .phases = CLI_PHASE_LOAD, .value_type = CLI_TYPE_NAME, .name = "joint", .value = "NAME:VALUE", \
    .help = "where a robot's joint is; may be repeated", .repeats = 1, .default_label = "0",       \
    .manual = "Moves joint _NAME_ of a robot (URDF) to _VALUE_, in radians or, if it slides, in "  \
              "metres, as far as its limits allow, and with it the joints that follow it. In a "   \
              "scene, it moves in every robot that has it. Can be repeated up to 32 times.",       \
    .handler = cli_flag_joint, .offset = offsetof(type, member.joints)

#define CLI_SCENE_FLAG(type, member)                                                               \
    .phases = CLI_PHASE_LOAD, .name = "scene", .help = "all INPUTs together, in one scene",        \
    .manual = "Puts every _INPUT_ into one mesh, each in its own coordinates, or scaled to the "   \
              "unit of the first if both state one; up is the axis of the first. *--root* is, by " \
              "default, the deepest folder that contains them all. A scene with places and "       \
              "colours is a file: docs/formats.md.",                                               \
    .handler = cli_flag_switch, .offset = offsetof(type, member.scene)

#define CLI_THUMBNAIL_FLAG(type, member)                                                           \
    .phases = CLI_PHASE_LOAD, .name = "thumbnail", .value = "WHEN",                                \
    .help = "draw the picture in a 3MF or G-code", .default_text = "auto",                         \
    .words = cli_thumbnails,                                                                       \
    .manual = "*auto* draws the picture that a 3MF or G-code file holds of itself, with a "        \
              "warning, if the file is sliced and has no mesh, is encrypted, or is binary "        \
              "G-code. *never* refuses such files; *only* draws nothing but the picture.",         \
    .handler = cli_flag_word, .offset = offsetof(type, member.thumbnail)

#define CLI_POINT_SIZE_FLAG(type, member)                                                          \
    .phases = CLI_PHASE_LOAD, .name = "point-size", .value = "SIZE",                               \
    .help = "diameter of points and lines", .default_label = "by density", .low = 1e-30,           \
    .high = 1e30,                                                                                  \
    .manual =                                                                                      \
        "Diameter, in the units of _INPUT_, in which the points of a file without faces are "      \
        "drawn, or its lines as rods. By default points close a sampled surface.",                 \
    .handler = cli_flag_real, .offset = offsetof(type, member.point_size)

#define CLI_NO_LIBRARIES_FLAG(type, member)                                                        \
    .phases = CLI_PHASE_LOAD, .name = "no-libraries", .help = "ignore files that INPUT refers to", \
    .manual = "Reads only _INPUT_, without the material libraries, textures and buffers that it "  \
              "refers to.",                                                                        \
    .handler = cli_flag_switch, .offset = offsetof(type, member.no_libraries)

#define CLI_ROOT_FLAG(type, member)                                                                \
    .phases = CLI_PHASE_LOAD, .value_type = CLI_TYPE_NAME, .name = "root", .value = "FOLDER",      \
    .help = "INPUT may refer to files in FOLDER", .file = CLI_FOLDER,                              \
    .default_label = "INPUT's folder",                                                             \
    .manual =                                                                                      \
        "_INPUT_ may refer to files anywhere in _FOLDER_, which must contain it, such as "         \
        "*--root=..*; no name and no link leads out of _FOLDER_. Textures that are not where "     \
        "_INPUT_ "                                                                                 \
        "says are also searched in the folders textures, texture, materials/textures and "         \
        "materials, next to _INPUT_ and next to its folder. Without this flag only _INPUT_'s "     \
        "folder and those below it are read.",                                                     \
    .handler = cli_flag_text, .offset = offsetof(type, member.root)

#define CLI_MAX_TRIANGLES_FLAG(type, member)                                                       \
    .phases = CLI_PHASE_LOAD | CLI_PHASE_PROCESS, .name = "max-triangles", .value = "N",           \
    .help = "refuse larger meshes", .default_text = "1431655764", .low = 1, .high = 1431655764,    \
    .default_label = "5 per byte",                                                                 \
    .manual =                                                                                      \
        "Refuses meshes with more triangles (exit code 5). By default the limit is 5 vertices "    \
        "and triangles together for each byte of _INPUT_ and the files that it refers to, and "    \
        "at least 5,242,880: enough for the contents of any file, but not for a small file "       \
        "that repeats its contents many times.",                                                   \
    .handler = cli_flag_count, .offset = offsetof(type, member.max_triangles)

#define CLI_NO_TEXTURES_FLAG(type, member)                                                         \
    .phases = CLI_PHASE_LOAD, .svg = CLI_SVG_SAME, .name = "no-textures",                          \
    .help = "ignore textures",                                                                     \
    .manual = "Textures are neither loaded nor drawn: materials have only their colours.",         \
    .handler = cli_flag_switch, .offset = offsetof(type, member.no_textures)

#define CLI_MAX_TEXTURE_PIXELS_FLAG(type, member)                                                  \
    .phases = CLI_PHASE_LOAD, .value_type = CLI_TYPE_INTEGER, .svg = CLI_SVG_SAME,                 \
    .name = "max-texture-pixels", .value = "N", .help = "limit on the pixels of all textures",     \
    .default_text = "auto", .low = 0, .high = 1e12,                                                \
    .manual =                                                                                      \
        "Textures beyond _N_ pixels in total are skipped, with a warning. The default is 32 "      \
        "for each byte of _INPUT_ and the files that it refers to, at least 2^25 and at most "     \
        "2^28.",                                                                                   \
    .handler = cli_flag_texture_pixels, .offset = offsetof(type, member.max_texture_pixels)

#define CLI_MAX_INPUT_BYTES_FLAG(type, member)                                                     \
    .phases = CLI_PHASE_LOAD | CLI_PHASE_PROCESS, .name = "max-input-bytes",                       \
    .help = "refuse larger inputs; K, M, G for powers of 1024", .value = "N",                      \
    .default_text = "16G", .low = 1, .high = 9e18,                                                 \
    .manual =                                                                                      \
        "Refuses larger inputs (exit code 5). _N_ can end in *K*, *M* or *G*, powers of 1024.",    \
    .handler = cli_flag_bytes, .offset = offsetof(type, member.max_input_bytes)

/* Whether a file that begins with these bytes is of a wanted kind. */
typedef int cli_recognise(const uint8_t *bytes, size_t size);

/* Reads a whole file, or standard input for "-", and appends a 0; release *bytes with free. Of a file of another kind,
 * which could be endless, only the beginning is read; `recognise` can be NULL. Errors: READ, LIMIT,
 * MEMORY. */
burnish_status cli_read_bytes(const char *path, uint64_t max_bytes, cli_recognise *recognise,
                              uint8_t **bytes, size_t *size, burnish_error *error);

#endif
