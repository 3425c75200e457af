/* The flags of `burnish render`: the one description that parser, help and man page share. */
#include "render/settings.h"

static const burnish_cli_word sample_words[] = {
    {"1", 1}, {"4", 4}, {"8", 8}, {"16", 16}, {NULL, 0}};
static const burnish_cli_word up_words[] = {
    {"+Y", BURNISH_CLI_UP_POSITIVE_Y},
    {"-Y", BURNISH_CLI_UP_NEGATIVE_Y},
    {"+Z", BURNISH_CLI_UP_POSITIVE_Z},
    {"-Z", BURNISH_CLI_UP_NEGATIVE_Z},
    {"+X", BURNISH_CLI_UP_POSITIVE_X},
    {"-X", BURNISH_CLI_UP_NEGATIVE_X},
    {NULL, 0},
};
static const burnish_cli_word view_words[] = {
    {"front", BURNISH_CLI_VIEW_FRONT},   {"right", BURNISH_CLI_VIEW_RIGHT},
    {"top", BURNISH_CLI_VIEW_TOP},       {"iso", BURNISH_CLI_VIEW_ISO},
    {"back", BURNISH_CLI_VIEW_BACK},     {"left", BURNISH_CLI_VIEW_LEFT},
    {"bottom", BURNISH_CLI_VIEW_BOTTOM}, {NULL, 0},
};
static const burnish_cli_word equation_words[] = {
    {"blinn", BURNISH_SPECULAR_BLINN}, {"phong", BURNISH_SPECULAR_PHONG}, {NULL, 0}};
static const burnish_cli_word viewer_words[] = {
    {"local", BURNISH_VIEWER_LOCAL}, {"distant", BURNISH_VIEWER_DISTANT}, {NULL, 0}};
static const burnish_cli_word format_words[] = {{"auto", BURNISH_FORMAT_AUTO},
                                                {"obj", BURNISH_FORMAT_OBJ},
                                                {"ply", BURNISH_FORMAT_PLY},
                                                {"stl", BURNISH_FORMAT_STL},
                                                {NULL, 0}};

/* Values of coordinates and angles beyond this are mistakes. */
#define ANGLE_MAX 36000.0

#define TARGET(member) .offset = offsetof(burnish_cli_render, member)

static const burnish_cli_flag flags[] = {
    {.group = "Picture",
     .name = "output",
     .letter = 'o',
     .value = "FILE",
     .help = "the PNG; - is standard output",
     .shown = "INPUT's name with .png",
     .manual =
         "Writes the picture to _FILE_, or to standard output for *-*. The file appears whole or "
         "not at all: it is written beside its place and renamed. Without this flag the name "
         "is that of _INPUT_ with *.png* in the current folder (*teapot.png* for *:teapot*), "
         "and standard output when _INPUT_ is *-*. A terminal is refused as output.",
     .handler = burnish_cli_flag_text,
     TARGET(output)},
    {.name = "resolution",
     .value = "W,H",
     .help = "in pixels; --size is a square",
     .initial = "1024,768",
     .low = 1,
     .high = BURNISH_IMAGE_MAX_SIZE,
     .manual = "Width and height of the picture in pixels, each from 1 to 16384; _W_*x*_H_ is "
               "understood too. On a sheet this is the size of each cell.",
     .handler = burnish_cli_flag_resolution,
     TARGET(size)},
    {.name = "size",
     .value = "N",
     .low = 1,
     .high = BURNISH_IMAGE_MAX_SIZE,
     .manual = "The same as *--resolution=*_N_*,*_N_.",
     .handler = burnish_cli_flag_size,
     TARGET(size)},
    {.name = "cull-back-faces",
     .help = "leave out back faces; samples a pixel: 1, 4, 8, 16",
     .manual =
         "Leaves out triangles that are seen from their back: a closed surface looks the same "
         "and takes less time. Otherwise both sides of a surface are lit.",
     .handler = burnish_cli_flag_switch,
     TARGET(cull_back_faces)},
    {.name = "samples",
     .value = "N",
     .initial = "4",
     .manual = "Samples a pixel along the edges: 1 (none smoothed), 4, 8 or 16.",
     .handler = burnish_cli_flag_word,
     .words = sample_words,
     TARGET(samples)},
    {.name = "background-color",
     .value = "COLOR",
     .help = "#rgb, #rrggbb, r,g,b or a name; transparent",
     .shown = "white",
     .manual = "Colour behind the object, see *COLOURS*, or *none*. The later of this flag and "
               "*--no-background* counts.",
     .handler = burnish_cli_flag_background,
     TARGET(background)},
    {.name = "no-background",
     .manual = "Leaves the background transparent: the PNG gets an alpha channel.",
     .handler = burnish_cli_flag_no_background,
     TARGET(background)},
    {.name = "views",
     .value = "LIST",
     .help = "seen from:",
     .manual =
         "Standard views, seen along the axes; several, between commas, make one labelled "
         "sheet. *front* looks at the side that faces the viewer when the up axis points up "
         "(+Z for up +Y, -Y for up +Z), *iso* is the isometric direction from the upper right "
         "front. Each view is framed on its own.",
     .handler = burnish_cli_flag_views,
     .words = view_words,
     TARGET(views)},
    {.name = "columns",
     .value = "N",
     .help = "for sheets of several views or lobes",
     .shown = "near a square",
     .low = 1,
     .high = 256,
     .manual =
         "Cells in a row of a sheet. Cells are views times lobes, the lobes of a view side by "
         "side.",
     .handler = burnish_cli_flag_integer,
     TARGET(columns)},
    {.name = "labels",
     .value = "LIST",
     .manual = "What stands below the cells of a sheet instead of the views' and lobes' names: one "
               "text a cell, between commas.",
     .handler = burnish_cli_flag_text,
     TARGET(labels)},
    {.name = "no-labels",
     .manual = "Leaves out the names below the cells of a sheet.",
     .handler = burnish_cli_flag_switch,
     TARGET(no_labels)},

    {.group = "Camera",
     .name = "up",
     .value = "AXIS",
     .help = "points up:",
     .shown = "+Y, +Z for STL",
     .manual = "The axis of the object that points up.",
     .handler = burnish_cli_flag_word,
     .words = up_words,
     TARGET(up)},
    {.name = "camera-direction",
     .value = "X,Y,Z",
     .help = "look along this and frame the object",
     .shown = "three-quarter",
     .manual =
         "Direction from the camera into the scene, of any length. The camera stands where the "
         "whole object fits into the picture, as large as *--margin* allows.",
     .handler = burnish_cli_flag_nonzero,
     TARGET(direction)},
    {.name = "camera-azimuth-angle",
     .value = "DEG",
     .help = "turn to the right around the up axis",
     .initial = "0",
     .low = -ANGLE_MAX,
     .high = ANGLE_MAX,
     .manual = "Turns the camera around the up axis, positive to the right. The framing follows.",
     .handler = burnish_cli_flag_real,
     TARGET(azimuth)},
    {.name = "camera-elevation-angle",
     .value = "DEG",
     .help = "lift toward the up axis",
     .initial = "0",
     .low = -ANGLE_MAX,
     .high = ANGLE_MAX,
     .manual = "Lifts the camera, positive upward. The framing follows.",
     .handler = burnish_cli_flag_real,
     TARGET(elevation)},
    {.name = "camera-position",
     .value = "X,Y,Z",
     .help = "stand exactly here; nothing is framed",
     .manual = "Puts the camera at this place, in the units of the scene, instead of framing the "
               "object.",
     .handler = burnish_cli_flag_vector,
     TARGET(position)},
    {.name = "camera-focal-point",
     .value = "X,Y,Z",
     .help = "the middle of the picture",
     .shown = "middle of the object",
     .manual =
         "The point in the middle of the picture. Without *--camera-position* the framed camera "
         "is moved sideways until it looks there, direction and distance unchanged.",
     .handler = burnish_cli_flag_vector,
     TARGET(focal_point)},
    {.name = "camera-view-up",
     .value = "X,Y,Z",
     .help = "what is upward in the picture",
     .shown = "the up axis",
     .manual =
         "Direction that is upward in the picture: rolls the camera. It may not be parallel to "
         "the direction of view.",
     .handler = burnish_cli_flag_nonzero,
     TARGET(view_up)},
    {.name = "camera-view-angle",
     .value = "DEG",
     .help = "angle from the lower to the upper edge",
     .initial = "30",
     .low = 0.001,
     .high = 179,
     .manual =
         "Angle from the lower to the upper edge of the picture, in degrees, from 0.001 to 179.",
     .handler = burnish_cli_flag_real,
     TARGET(view_angle)},
    {.name = "camera-zoom-factor",
     .value = "F",
     .help = "come nearer: the distance is divided by F",
     .initial = "1",
     .low = 1e-3,
     .high = 1e3,
     .manual = "Comes nearer: the distance from the focal point, or the height of a parallel "
               "projection, is divided by _F_, from 0.001 to 1000.",
     .handler = burnish_cli_flag_real,
     TARGET(zoom)},
    {.name = "camera-orthographic",
     .help = "parallel projection; share left free around",
     .manual = "Parallel projection. With *--camera-position* the height of the picture is the one "
               "that frames the object.",
     .handler = burnish_cli_flag_switch,
     TARGET(orthographic)},
    {.name = "margin",
     .value = "F",
     .initial = "0.05",
     .low = 0,
     .high = 0.45,
     .manual = "Share of the picture's smaller side that framing leaves free at each side.",
     .handler = burnish_cli_flag_real,
     TARGET(margin)},

    {.group = "Surface and light",
     .name = "color",
     .value = "COLOR",
     .help = "paint; finish:",
     .manual = "Colour of the whole object instead of the input's colours; see *COLOURS*.",
     .handler = burnish_cli_flag_color,
     TARGET(color)},
    {.name = "material",
     .value = "NAME",
     .manual = "A surface by name, for the whole object; see *MATERIALS*. Colours stay.",
     .handler = burnish_cli_flag_word,
     .words = burnish_cli_preset_words,
     TARGET(material)},
    {.name = "specular",
     .value = "F",
     .help = "highlight's strength ks and exponent n",
     .shown = "the input's",
     .low = 0,
     .high = 1,
     .manual = "Strength of the highlight, the specular coefficient ks, for every material.",
     .handler = burnish_cli_flag_real,
     TARGET(specular)},
    {.name = "exponent",
     .value = "N",
     .low = 1,
     .high = 65536,
     .manual =
         "Exponent n of the highlight, for every material: the larger, the smaller and sharper.",
     .handler = burnish_cli_flag_real,
     TARGET(exponent)},
    {.name = "lobe",
     .value = "FIT:ORDER",
     .help = "highlight's shape; a list makes a sheet",
     .initial = "energy:2",
     .manual =
         "The specular lobe; see *LOBES*. Several, between commas, make one labelled sheet. Of a "
         "repeated flag the last list counts.",
     .handler = burnish_cli_flag_lobes,
     TARGET(lobes)},
    {.name = "equation",
     .value = "NAME",
     .help = "blinn or phong; local or distant",
     .initial = "blinn",
     .manual =
         "Which cosine the lobe is taken of: *blinn*, N.H with the half vector, or *phong*, R.V "
         "with the mirrored light.",
     .handler = burnish_cli_flag_word,
     .words = equation_words,
     TARGET(equation)},
    {.name = "viewer",
     .value = "NAME",
     .initial = "local",
     .manual = "Where highlights take the viewer to be: *local*, at the camera, or *distant*, "
               "infinitely far along the camera's axis.",
     .handler = burnish_cli_flag_word,
     .words = viewer_words,
     TARGET(viewer)},
    {.name = "light",
     .value = "SPEC",
     .help = "KIND:X,Y,Z[:INTENSITY[:COLOR]]",
     .shown = "key, fill, rim",
     .manual =
         "A light, in place of the default rig of key, fill and rim light; see *LIGHTS*. May be "
         "repeated up to 64 times. *none* takes away the rig and all lights so far.",
     .handler = burnish_cli_flag_light,
     TARGET(lights)},
    {.name = "ambient",
     .help = "light from everywhere, linear",
     .value = "F|COLOR",
     .low = 0,
     .high = 16,
     .manual = "Ambient light: a number from 0 to 16, linear, or a colour.",
     .shown = "a little",
     .handler = burnish_cli_flag_ambient,
     TARGET(ambient)},

    {.group = "Input and report",
     .name = "input-format",
     .value = "NAME",
     .help = "",
     .initial = "auto",
     .manual =
         "Format of _INPUT_: *obj*, *ply*, *stl*, or *auto*, which looks at the name's ending "
         "and the first bytes.",
     .handler = burnish_cli_flag_word,
     .words = format_words,
     TARGET(format)},
    {.name = "crease-angle",
     .value = "DEG",
     .help = "smooth edges below; patch segments",
     .shown = "60, 40 for STL",
     .low = 0,
     .high = 180,
     .manual = "Where the input has no normals: smooth across edges whose faces differ by less, 0 "
               "shades every face flat.",
     .handler = burnish_cli_flag_real,
     TARGET(crease)},
    {.name = "tessellation",
     .value = "N",
     .initial = "16",
     .low = 1,
     .high = 256,
     .manual = "Segments along a patch edge of a built-in object.",
     .handler = burnish_cli_flag_integer,
     TARGET(tessellation)},
    {.name = "max-triangles",
     .value = "N",
     .help = "refuse larger inputs; K, M, G for bytes",
     .initial = "2147483647",
     .low = 1,
     .high = 2147483647,
     .shown = "2^31-1",
     .manual = "Refuses meshes with more triangles (exit code 5).",
     .handler = burnish_cli_flag_count,
     TARGET(max_triangles)},
    {.name = "max-input-bytes",
     .value = "N",
     .initial = "16G",
     .low = 1,
     .high = 9e18,
     .manual =
         "Refuses larger inputs (exit code 5). _N_ may end in *K*, *M* or *G*, powers of 1024.",
     .handler = burnish_cli_flag_bytes,
     TARGET(max_input_bytes)},
    {.name = "json",
     .help = "report on standard output; phases in ms; no warnings",
     .manual = "Prints one JSON object on standard output; see *JSON OUTPUT*.",
     .handler = burnish_cli_flag_switch,
     TARGET(json)},
    {.name = "timing",
     .manual =
         "Prints the milliseconds of each phase on standard error: *start* is the processor time "
         "before loading, *total* begins behind it.",
     .handler = burnish_cli_flag_switch,
     TARGET(timing)},
    {.name = "quiet",
     .manual = "No warnings and no progress on standard error; errors stay.",
     .handler = burnish_cli_flag_switch,
     TARGET(quiet)},
    {.name = "threads",
     .value = "N",
     .help = "never change the picture",
     .initial = "0",
     .low = 0,
     .high = 1024,
     .shown = "all cores",
     .manual =
         "Threads to draw with, 0 for as many as the machine offers. The picture's bytes are the "
         "same for every number.",
     .handler = burnish_cli_flag_integer,
     TARGET(threads)},
    {.name = "isa",
     .value = "NAME",
     .initial = "auto",
     .manual =
         "The instruction set of the kernels: *auto* for the fastest that the processor has, "
         "*scalar*, *sse2*, *avx2*, *avx512* or *neon*. *auto* follows the environment variable "
         "*BURNISH_ISA* where it is set. The picture's bytes are the same for every one.",
     .handler = burnish_cli_flag_isa,
     TARGET(isa)},
    {.name = "fail-on-blank",
     .help = "nothing to see: exit code 8, no file; this screen",
     .manual =
         "When the picture, or a cell of a sheet, shows nothing, ends with exit code 8 and writes "
         "no file. Otherwise a blank picture only gives a warning.",
     .handler = burnish_cli_flag_switch,
     TARGET(fail_on_blank)},
    {.name = "help",
     .letter = 'h',
     .manual = "Prints the flags on one screen.",
     .handler = burnish_cli_flag_switch,
     TARGET(help)},
};

const burnish_cli_command burnish_cli_render_command = {
    .name = "render",
    .operand = "INPUT",
    .summary = "draw a mesh into a PNG",
    .operand_help =
        "an .obj, .ply or .stl file, - for standard input, or :teapot, :sphere, :torus, :knot",
    .manual =
        "Loads _INPUT_ and draws it with the Phong illumination equation. _INPUT_ is an OBJ (with "
        "its material library), PLY or STL file, *-* for standard input, or a built-in object: "
        "*:teapot*, *:sphere*, *:torus* or *:knot*.\n"
        "Without flags the whole object is shown from a pleasant three-quarter view, lit by a rig "
        "that follows the camera. Values follow a flag after *=* or as the next argument; flags "
        "can't be abbreviated; of a repeated flag the last counts, but for *--light*; *--* ends "
        "the flags.",
    .operands_max = 1,
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
    .run = burnish_cli_render_main,
};
