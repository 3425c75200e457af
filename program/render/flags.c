/* The flags of `burnish render`: the one description that parser, help and man page share. */
#include <stdio.h>

#include "cli/commands.h"
#include "cli/output.h"
#include "render/flags.h"
#include "render/manual.h"
#include "render/render.h"
#include "render/values.h"

static const cli_word format_words[] = {{"auto", PICTURE_AUTO},
                                        {"png", PICTURE_PNG},
                                        {"jpeg", PICTURE_JPEG},
                                        {"jpg", PICTURE_JPEG},
                                        {"webp", PICTURE_WEBP},
                                        {"svg", PICTURE_SVG},
                                        {"exr", PICTURE_EXR},
                                        {"npy", PICTURE_NPY},
                                        {"gif", PICTURE_GIF},
                                        {"y4m", PICTURE_Y4M},
                                        {NULL, 0}};
const cli_word render_plane_words[] = {
    {"depth", PLANE_DEPTH},
    {"normal", PLANE_NORMAL},
    {"triangle", PLANE_TRIANGLE},
    {"material", PLANE_MATERIAL},
    {"coverage", PLANE_COVERAGE},
    {"color", PLANE_COLOR},
    {NULL, 0},
};
static const cli_word sample_words[] = {{"1", 1}, {"4", 4}, {"8", 8}, {"16", 16}, {NULL, 0}};
static const cli_word up_words[] = {
    {"+Y", UP_POSITIVE_Y}, {"-Y", UP_NEGATIVE_Y}, {"+Z", UP_POSITIVE_Z}, {"-Z", UP_NEGATIVE_Z},
    {"+X", UP_POSITIVE_X}, {"-X", UP_NEGATIVE_X}, {"auto", UP_AUTO},     {NULL, 0},
};
static const cli_word view_words[] = {
    {"front", VIEW_FRONT}, {"right", VIEW_RIGHT}, {"top", VIEW_TOP},       {"iso", VIEW_ISO},
    {"back", VIEW_BACK},   {"left", VIEW_LEFT},   {"bottom", VIEW_BOTTOM}, {NULL, 0},
};
const cli_word render_look_words[] = {{"studio", BURNISH_LOOK_STUDIO},
                                      {"plain", BURNISH_LOOK_PLAIN},
                                      {"clay", BURNISH_LOOK_CLAY},
                                      {"technical", BURNISH_LOOK_TECHNICAL},
                                      {"drawing", BURNISH_LOOK_DRAWING},
                                      {"lobes", BURNISH_LOOK_LOBES},
                                      {NULL, 0}};
static const cli_word edge_words[] = {{"silhouettes", BURNISH_EDGES_SILHOUETTES},
                                      {"creases", BURNISH_EDGES_CREASES},
                                      {"boundaries", BURNISH_EDGES_BOUNDARIES},
                                      {"materials", BURNISH_EDGES_MATERIALS},
                                      {"none", 0},
                                      {NULL, 0}};

static const cli_word annotation_words[] = {{"axes", BURNISH_ANNOTATION_AXES},
                                            {"box", BURNISH_ANNOTATION_BOX},
                                            {"dimensions", BURNISH_ANNOTATION_DIMENSIONS},
                                            {"scale", BURNISH_ANNOTATION_SCALE},
                                            {"grid", BURNISH_ANNOTATION_GRID},
                                            {NULL, 0}};
static const cli_word equation_words[] = {
    {"blinn", BURNISH_SPECULAR_BLINN}, {"phong", BURNISH_SPECULAR_PHONG}, {NULL, 0}};
static const cli_word viewer_words[] = {{"local", 1}, {"distant", 0}, {NULL, 0}};
#define AXIS_100(word) ", " #word " +X"
#define AXIS_010(word)
#define AXIS_001(word) ", " #word " +Z"
#define FORMAT_AXIS(name, word, endings, x, y, z) AXIS_##x##y##z(word)
/* "+Y, stl +Z": most formats stand on +Y. */
static const char format_axes[] = "+Y" BURNISH_FORMAT_LIST(FORMAT_AXIS);

/* Values of coordinates and angles beyond this are mistakes. */
#define ANGLE_MAX 36000.0

#define TARGET(member) .offset = offsetof(render_settings, member)

static const cli_flag flags[] = {
    {.group = "Picture",
     .topic = "picture",
     .name = "output",
     .aliases = "out",
     .common = 1,
     .letter = 'o',
     .value = "FILE",
     .help = ".png .jpg .webp .svg .exr .npy, or -",
     .default_label = "INPUT's name",
     .manual =
         "Writes the picture to _FILE_, or to standard output for *-*, in the format that its "
         "ending says: *.png*, *.jpg*, *.jpeg*, *.webp*, *.svg*, *.exr* or *.npy*; see *FORMATS*. "
         "Other names are PNG. "
         "The file appears whole or "
         "not at all: it is written beside its final name and renamed. Without this flag the name "
         "is that of _INPUT_ with *.png* in the current folder (*teapot.png* for *:teapot*), "
         "and standard output when _INPUT_ is *-*; a file that has this name already is "
         "replaced only if burnish wrote it, or *--overwrite* is given. A file that _FILE_ names "
         "is replaced. A "
         "terminal is refused as output, and so is an ending of a format that burnish does not "
         "write.\n"
         "*{model}*, *{folder}*, *{ending}* and *{view}* in _FILE_ stand for parts of _INPUT_'s "
         "name and for the view, as in *burnish batch*; with more than one _INPUT_ there has to be "
         "one of them, or *--output-dir*.",
     .handler = cli_flag_text,
     .takes_file = 1,
     TARGET(output.path)},
    {.name = "output-dir",
     .aliases = "outdir,out-dir",
     .common = 1,
     .letter = 'd',
     .value = "FOLDER",
     .help = "where pictures go, one per INPUT",
     .manual = "The folder of the pictures, made where it is missing. _INPUT_ may then be a folder "
               "too, of which all meshes are taken.",
     .handler = cli_flag_text,
     .takes_file = 1,
     TARGET(output.folder)},
    {.name = "recursive",
     .letter = 'r',
     .help = "folders below an INPUT that is one, too",
     .manual = "As of *burnish batch*: takes the meshes in all folders below an _INPUT_ that is a "
               "folder.",
     .handler = cli_flag_switch,
     TARGET(job.recursive)},
    {.name = "files-from",
     .aliases = "inputs-from,files0-from,from-file",
     .value = "FILE",
     .help = "names of INPUTs; -: standard input",
     .manual = "As of *burnish batch*: reads names of inputs from _FILE_.",
     .handler = cli_flag_text,
     .takes_file = 1,
     TARGET(job.files_from)},
    {.name = "resolution",
     .aliases = "width,height,res",
     .common = 1,
     .value = "W,H",
     .help = "width and height in pixels",
     .default_text = "1024,768",
     .low = 1,
     .high = BURNISH_IMAGE_MAX_SIZE,
     .manual = "Width and height of the picture in pixels, each from 1 to 16384; _W_*x*_H_ is "
               "understood too. On a sheet this is the size of each cell.",
     .handler = cli_flag_size,
     TARGET(picture.size)},
    {.name = "size",
     .common = 1,
     .help = "a square: --resolution=N,N",
     .value = "N",
     .low = 1,
     .high = BURNISH_IMAGE_MAX_SIZE,
     .manual = "The same as *--resolution=*_N_*,*_N_.",
     .handler = cli_flag_square,
     TARGET(picture.size)},
    {.name = "rows",
     .value = "FIRST:COUNT",
     .help = "draw only these rows of the picture",
     .default_label = "all",
     .manual =
         "Draws _COUNT_ rows of the picture from row _FIRST_ on, counted from 0, and no others: "
         "the "
         "file holds these rows, with the bits that they have in the whole picture, whatever the "
         "other flags are. So many machines can draw one picture (docs/scale.md). Multiples of 64 "
         "take least time. Without sheets, turntables, *--annotate* and SVG; what warns of a blank "
         "picture is silent; depths in PNG have the range of these rows.",
     .handler = render_flag_rows,
     TARGET(picture.rows)},
    {.name = "cull-back-faces",
     .aliases = "backface-culling",
     .help = "leave out triangles seen from their back",
     .manual =
         "Leaves out triangles that are seen from their back: a closed surface looks the same "
         "and takes less time. Otherwise both sides of a surface are lit.",
     .handler = cli_flag_switch,
     TARGET(picture.cull_back_faces)},
    {.name = "samples",
     .aliases = "antialiasing,anti-aliasing,aa,msaa",
     .help = "per pixel, along edges",
     .value = "N",
     .default_text = "4",
     .manual = "Samples per pixel along the edges: 1 (none smoothed), 4, 8 or 16.",
     .handler = cli_flag_word,
     .words = sample_words,
     TARGET(picture.samples)},
    {.name = "background-color",
     .aliases = "bg-color,bg,background",
     .common = 1,
     .value = "COLOR",
     .help = "#rgb, #rrggbb, r,g,b or a name",
     .default_label = "the look's",
     .manual = "Colour of the background, see *COLOURS*, or *none*. The later of this flag and "
               "*--no-background* counts.",
     .handler = render_flag_background,
     TARGET(picture.background)},
    {.name = "no-background",
     .aliases = "transparent,transparency",
     .common = 1,
     .help = "transparent",
     .manual = "Leaves the background transparent: the PNG gets an alpha channel.",
     .handler = render_flag_no_background,
     TARGET(picture.background)},
    {.name = "views",
     .aliases = "view",
     .common = 1,
     .value = "LIST",
     .help = "one, or a sheet",
     .manual =
         "Standard views, seen along the axes; several, between commas, make one labelled "
         "sheet. *front* looks at the side that faces the viewer when the up axis points up "
         "(+Z for up +Y, -Y for up +Z), *iso* is the isometric direction from the upper right "
         "front. They are parallel projections unless *--camera-orthographic=no* is given. Each "
         "view is framed on its own, in a scale of its own unless *--same-scale* is given.",
     .handler = render_flag_views,
     .words = view_words,
     TARGET(picture.views)},
    {.name = "annotate",
     .aliases = "annotations,axis,grid,dimensions,scale-bar,bounding-box",
     .value = "LIST",
     .help = "measure",
     .manual =
         "Draws lines and numbers around the object, several between commas: *axes*, the "
         "directions of X, Y and Z in a corner; *box*, the edges of the bounding box, dashed "
         "behind the object; *dimensions*, the lengths of the bounding box with arrows; *scale*, a "
         "bar of 1, 2 or 5 times a power of 10, of a parallel projection (of a perspective it is "
         "left "
         "out, with a warning); *grid*, lines of the "
         "ground so far apart, with their spacing. Numbers are in the units of the input, rounded "
         "to four digits. Framing leaves room for them; what finds none is left out with a "
         "warning.",
     .handler = render_flag_annotate,
     .words = annotation_words,
     TARGET(picture.annotations)},
    {.name = "columns",
     .value = "N",
     .help = "of a sheet",
     .default_label = "near a square",
     .low = 1,
     .high = 256,
     .manual =
         "Cells in a row of a sheet. Cells are views times lobes, the lobes of a view side by "
         "side.",
     .handler = cli_flag_integer,
     TARGET(picture.columns)},
    {.name = "labels",
     .help = "of a sheet, one text per cell, between commas",
     .value = "LIST",
     .manual = "What stands below the cells of a sheet instead of the views' and lobes' names: one "
               "text per cell, between commas, in UTF-8.",
     .handler = cli_flag_text,
     TARGET(picture.labels)},
    {.name = "font",
     .value = "FILE",
     .help = "of all labels",
     .default_label = "burnish's own; the system's beyond ASCII",
     .manual =
         "TrueType or OpenType font of all labels. Without this flag labels are drawn in burnish's "
         "own letters, which are the same everywhere, as long as all are ASCII, and else in the "
         "system's sans-serif, with other fonts for scripts that it lacks. Scripts that run to the "
         "left and letters that join or combine are set as they are written.",
     .handler = cli_flag_text,
     .takes_file = 1,
     TARGET(picture.font)},
    {.name = "no-labels",
     .help = "a sheet without labels",
     .manual = "Leaves out the names below the cells of a sheet.",
     .handler = cli_flag_switch,
     TARGET(picture.no_labels)},

    {.group = "Files",
     .topic = "files",
     .name = "output-format",
     .value = "NAME",
     .help = "one of",
     .manual = "Format of the picture, whatever _FILE_'s ending says: for standard output. *auto*, "
               "the default, goes by the ending.",
     .handler = cli_flag_word,
     .words = format_words,
     TARGET(output.format)},
    {.name = "quality",
     .value = "N",
     .low = 1,
     .high = 100,
     .help = "of JPEG and WebP",
     .default_label = "90, WebP without loss",
     .manual = "Quality of JPEG (90 without this flag) and WebP (without loss), from 1 to 100.",
     .handler = cli_flag_integer,
     TARGET(output.quality)},
    {.name = "dpi",
     .value = "N",
     .low = 1,
     .high = 65535,
     .help = "dots per inch, for printing",
     .default_label = "none",
     .manual =
         "Dots per inch that PNG and JPEG say they are printed with; the pixels stay. The width "
         "and height of an SVG are then millimetres, 25.4 times pixels by _N_: 25.4 times the "
         "report's *pixels_per_unit* makes a drawing in millimetres print at 1:1.",
     .handler = cli_flag_real,
     TARGET(output.dots_per_inch)},
    {.name = "plane",
     .value = "NAME:FILE",
     .help = "depth, normal, triangle, material, coverage or color",
     .manual = "Numbers of each pixel, in a file of their own beside the picture; may be repeated. "
               "*depth* is the distance from the camera along its axis, *normal* the interpolated "
               "normal in the object's axes, *triangle* and *material* are numbers from 0, "
               "*coverage* is the part of the pixel that the object takes, *color* linear light. "
               "Where several triangles share a pixel, it shows one of them; nothing is mixed but "
               "*coverage* and *color*. See *PLANES*.",
     .handler = render_flag_plane,
     TARGET(output.planes)},
    {.name = "turntable",
     .value = "FILE",
     .help = ".gif .png .webp .y4m; - is Y4M on standard output",
     .manual = "Instead of a picture a turn of the camera around the object, to the right around "
               "the up axis through the focal point; the last frame continues into the first. All "
               "frames have one framing, in which nothing is cut off. *.gif* has one palette for "
               "all frames; *.png* is an animated PNG; *.webp* is without loss unless *--quality* "
               "is given; *.y4m* is for video encoders: 4:2:0, limited range, BT.709. For "
               "example *burnish render part.stl --turntable=- | ffmpeg -i - -colorspace bt709 "
               "part.mp4*.",
     .handler = cli_flag_text,
     .takes_file = 1,
     TARGET(output.turntable)},
    {.name = "frames",
     .value = "N",
     .low = 2,
     .high = 3600,
     .help = "of a turntable",
     .default_text = "60",
     .manual = "Frames of a turn, from 2 to 3600.",
     .handler = cli_flag_integer,
     TARGET(output.frames)},
    {.name = "fps",
     .aliases = "frame-rate",
     .value = "N",
     .low = 1,
     .high = 120,
     .help = "frames per second of a turntable",
     .default_text = "20",
     .manual = "Frames per second of a turntable, from 1 to 120; of a GIF at most 50.",
     .handler = cli_flag_integer,
     TARGET(output.fps)},
    {.name = "runners",
     .value = "N",
     .help = "N sockets, from descriptor 3 on, lead to others",
     .low = 0,
     .high = 65536,
     .manual =
         "Frames of a turntable, or bands of one picture, are drawn by others too, to whom the "
         "sockets from descriptor 3 on lead: *burnish render --runner* with the same flags. "
         "*burnish-mpi* starts both (docs/scale.md). The file has the same bytes. A picture is "
         "written as PNG, and as it is never whole in memory there are no sheets, *--rows*, "
         "*--annotate*, *--plane*, *--reference*, *--json* and *--fail-on-blank*.",
     .handler = cli_flag_integer,
     TARGET(job.runners)},
    {.name = "runner",
     .help = "draw parts for a burnish with --runners",
     .manual =
         "Draws the frames or bands that the socket at descriptor 3 asks for, and writes no file.",
     .handler = cli_flag_switch,
     TARGET(job.runner)},
    {.name = "overwrite",
     .help = "replace a file with INPUT's name and .png, whoever wrote it",
     .manual = "Replaces a file that has the name made from _INPUT_'s, whoever wrote it. Without "
               "this flag only pictures by burnish are replaced.",
     .handler = cli_flag_switch,
     TARGET(output.overwrite)},

    {.group = "Camera",
     .topic = "camera",
     .name = "up",
     .aliases = "up-axis,up-direction",
     .common = 1,
     .value = "AXIS",
     .help = "upward",
     .default_label = format_axes,
     .manual =
         "The axis of the object that points up. *auto* is a guess: of +Y and +Z the one that the "
         "input's format says, unless the object would fall over that way and stands well the "
         "other way.",
     .handler = cli_flag_word,
     .words = up_words,
     TARGET(camera.up)},
    {.name = "camera-direction",
     .common = 1,
     .value = "X,Y,Z",
     .help = "look along this and frame the object",
     .default_label = "three-quarter",
     .manual =
         "Direction from the camera into the scene, of any length. The camera stands where the "
         "whole object fits into the picture, as large as *--margin* allows.",
     .handler = cli_flag_nonzero,
     TARGET(camera.direction)},
    {.name = "camera-azimuth-angle",
     .aliases = "azimuth,rotate",
     .common = 1,
     .value = "DEG",
     .help = "turn to the right around the up axis",
     .default_text = "0",
     .low = -ANGLE_MAX,
     .high = ANGLE_MAX,
     .manual = "Turns the camera around the up axis, positive to the right. The framing follows.",
     .handler = cli_flag_real,
     TARGET(camera.azimuth)},
    {.name = "camera-elevation-angle",
     .aliases = "elevation,tilt",
     .common = 1,
     .value = "DEG",
     .help = "lift toward the up axis",
     .default_text = "0",
     .low = -ANGLE_MAX,
     .high = ANGLE_MAX,
     .manual = "Lifts the camera, positive upward. The framing follows.",
     .handler = cli_flag_real,
     TARGET(camera.elevation)},
    {.name = "camera",
     .aliases = "camera-index",
     .value = "NAME",
     .help = "one of the input's own, by name or number from 0",
     .manual =
         "Takes the picture from where this camera of the input stands (glTF), by its name or "
         "its number from 0, instead of framing the object. Standard views are framed.",
     .handler = cli_flag_text,
     TARGET(camera.own)},
    {.name = "camera-position",
     .value = "X,Y,Z",
     .help = "stand exactly here; nothing is framed",
     .manual =
         "Puts the camera at this position, in the units of the input, instead of framing the "
         "object.",
     .handler = cli_flag_vector,
     TARGET(camera.position)},
    {.name = "camera-focal-point",
     .value = "X,Y,Z",
     .help = "the middle of the picture",
     .default_label = "middle of the object",
     .manual =
         "The point in the middle of the picture. Without *--camera-position* the framed camera "
         "is moved sideways until it looks there, direction and distance unchanged.",
     .handler = cli_flag_vector,
     TARGET(camera.focal_point)},
    {.name = "camera-view-up",
     .value = "X,Y,Z",
     .help = "what is upward in the picture",
     .default_label = "the up axis",
     .manual =
         "Direction that is upward in the picture: rolls the camera. It may not be parallel to "
         "the direction of view.",
     .handler = cli_flag_nonzero,
     TARGET(camera.view_up)},
    {.name = "camera-view-angle",
     .aliases = "fov,field-of-view",
     .value = "DEG",
     .help = "angle from the lower to the upper edge",
     .default_text = "30",
     .low = 0.001,
     .high = 179,
     .manual =
         "Angle from the lower to the upper edge of the picture, in degrees, from 0.001 to 179.",
     .handler = cli_flag_real,
     TARGET(camera.view_angle)},
    {.name = "camera-zoom-factor",
     .aliases = "zoom",
     .value = "F",
     .help = "come nearer: the distance is divided by F",
     .default_text = "1",
     .low = 1e-3,
     .high = 1e3,
     .manual = "Comes nearer: the distance from the focal point, or the height of a parallel "
               "projection, is divided by _F_, from 0.001 to 1000.",
     .handler = cli_flag_real,
     TARGET(camera.zoom)},
    {.name = "camera-orthographic",
     .aliases = "ortho,parallel",
     .common = 1,
     .value = "no",
     .optional = 1,
     .help = "parallel projection; no: perspective",
     .default_label = "for --views",
     .manual = "Parallel projection, which standard views have without this flag; *no* draws those "
               "in perspective too. With *--camera-position* the height of the picture is the one "
               "that frames the object.",
     .handler = render_flag_projection,
     TARGET(camera.projection)},
    {.name = "camera-orthographic-height",
     .aliases = "parallel-scale,ortho-scale,orthographic-height",
     .value = "H",
     .help = "parallel projection, H units of the input high",
     .default_label = "what fits",
     .low = 1e-30,
     .high = 1e30,
     .manual = "Parallel projection in which the picture's height shows _H_ units of the input: "
               "pictures of different objects, or of different runs, have one scale. The object "
               "stays in the middle; *--margin* has no meaning.",
     .handler = cli_flag_real,
     TARGET(camera.orthographic_height)},
    {.name = "same-scale",
     .help = "parallel projection, all cells of a sheet in one scale",
     .manual = "Draws all cells of a sheet in one scale, the largest in which each view fits: "
               "lengths can be compared across views, and what is at one height in *front* is at "
               "that height in *right*. Implies *--camera-orthographic*. The report's "
               "*pixels_per_unit* tells the scale.",
     .handler = cli_flag_switch,
     TARGET(camera.same_scale)},
    {.name = "margin",
     .help = "share left free at each side by framing",
     .value = "F",
     .default_text = "0.05",
     .low = 0,
     .high = 0.45,
     .manual = "Share of the picture's smaller side that framing leaves free at each side.",
     .handler = cli_flag_real,
     TARGET(camera.margin)},

    {.group = "Surface and light",
     .topic = "light",
     .name = "look",
     .common = 1,
     .value = "NAME",
     .help = "style",
     .default_text = "studio",
     .manual =
         "Lights, ground, burnish's grey, ambient occlusion and edges by one name; see *LOOKS*. "
         "Other flags change parts of it.",
     .handler = cli_flag_word,
     .words = render_look_words,
     TARGET(shading.look)},
    {.name = "color",
     .aliases = "colour,object-color",
     .common = 1,
     .value = "COLOR",
     .help = "of the whole object",
     .manual = "Colour of the whole object instead of the input's colours; see *COLOURS*.",
     .handler = cli_flag_color,
     TARGET(shading.color)},
    {.name = "material",
     .common = 1,
     .help = "surface by name",
     .value = "NAME",
     .manual = "A surface by name, for the whole object; see *MATERIALS*. Colours stay.",
     .handler = cli_flag_word,
     .words = render_preset_words,
     TARGET(shading.material)},
    {.name = "opacity",
     .value = "F",
     .help = "of the whole object",
     .default_label = "the input's",
     .low = 0,
     .high = 1,
     .manual =
         "Opacity of the whole object, from 0 to 1, times that of the input's materials (*d*, "
         "*Tr*) and colours (alpha). Transparent surfaces are drawn in the order of their "
         "depths at every sample, both sides of them, and cast no shadows, "
         "unless they are opaque but for a mask.",
     .handler = cli_flag_real,
     TARGET(shading.opacity)},
    {.name = "specular",
     .value = "F",
     .help = "strength of the highlight, ks",
     .default_label = "the input's",
     .low = 0,
     .high = 1,
     .manual = "Strength of the highlight, the specular coefficient ks, for every material.",
     .handler = cli_flag_real,
     TARGET(shading.specular)},
    {.name = "exponent",
     .aliases = "shininess",
     .help = "exponent of the highlight, n",
     .value = "N",
     .low = 1,
     .high = 65536,
     .manual =
         "Exponent n of the highlight, for every material: the larger, the smaller and sharper.",
     .handler = cli_flag_real,
     TARGET(shading.exponent)},
    {.name = "lobe",
     .common = 1,
     .value = "FIT:ORDER",
     .help = "highlight's shape; a list makes a sheet",
     .default_text = "energy:2",
     .manual =
         "The specular lobe; see *LOBES*. Several, between commas, make one labelled sheet. Of a "
         "repeated flag the last list counts.",
     .handler = render_flag_lobes,
     TARGET(shading.lobes)},
    {.name = "equation",
     .value = "NAME",
     .help = "cosine that the lobe is taken of",
     .default_text = "blinn",
     .manual =
         "Which cosine the lobe is taken of: *blinn*, N.H with the half vector, or *phong*, R.V "
         "with the mirrored light.",
     .handler = cli_flag_word,
     .words = equation_words,
     TARGET(shading.equation)},
    {.name = "viewer",
     .help = "where highlights take the viewer to be",
     .value = "NAME",
     .default_text = "local",
     .manual = "Where highlights take the viewer to be: *local*, at the camera, or *distant*, "
               "infinitely far along the camera's axis.",
     .handler = cli_flag_word,
     .words = viewer_words,
     TARGET(shading.viewer)},
    {.name = "light",
     .value = "SPEC",
     .help = "KIND:X,Y,Z[:F[:COLOR]], file; repeatable",
     .default_label = "key, fill, rim",
     .manual =
         "A light, in place of the default rig of key, fill and rim light; see *LIGHTS*. May be "
         "repeated up to 64 times. *file*: those of the input. *none* takes away the rig and all "
         "lights so far.",
     .handler = render_flag_light,
     TARGET(shading.lights)},
    {.name = "ambient",
     .help = "light from everywhere, linear",
     .value = "F|COLOR",
     .low = 0,
     .high = 16,
     .manual = "Ambient light: a number from 0 to 16, linear, or a colour.",
     .default_label = "a little",
     .handler = render_flag_ambient,
     TARGET(shading.ambient)},
    {.name = "occlusion",
     .aliases = "ambient-occlusion,ao",
     .help = "directions of the sky, or none",
     .value = "N",
     .low = 1,
     .high = BURNISH_OCCLUSION_MAX,
     .default_label = "the look's",
     .manual = "Ambient occlusion: creases, holes and undersides, which see less of the sky, are "
               "darker. From how many directions the sky is looked at, or *none*; an odd number "
               "counts as the next even one. More directions are smoother and take longer.",
     .handler = render_flag_occlusion,
     TARGET(shading.occlusion)},
    {.name = "ground",
     .aliases = "contact-shadow,ground-shadow",
     .common = 1,
     .help = "a soft shadow below the object",
     .manual =
         "A soft shadow on the plane through the object's lowest point, across the up axis, "
         "where the camera is above it. The plane itself is not seen: the background is "
         "darkened, and a transparent one becomes black with the shadow as its alpha. Framing "
         "leaves room for it, and more on the right with *--shadow*.",
     .handler = cli_flag_switch,
     TARGET(shading.ground)},
    {.name = "shadow",
     .aliases = "shadows,cast-shadows",
     .help = "the first light's, on the object itself",
     .manual = "The first light casts a shadow with a soft edge on the object itself, and on the "
               "ground of *--ground*. The light "
               "must be directional, as the looks' key light is.",
     .handler = cli_flag_switch,
     TARGET(shading.shadow)},

    {.name = "edges",
     .aliases = "outline,outlines,feature-edges",
     .common = 1,
     .value = "LIST",
     .optional = 1,
     .help = "lines",
     .manual =
         "Draws edges as lines, hidden ones left out: *silhouettes*, where a step in depth is; "
         "*creases*, where the surface is shaded with an edge; *boundaries* of open surfaces; "
         "borders between *materials*; or *none*. Without _LIST_ all of them, without the flag "
         "those "
         "of the look. Lines at a step in depth are *--edge-width* wide, the others have 3/5 of "
         "that.",
     .handler = render_flag_edges,
     .words = edge_words,
     TARGET(shading.edges)},
    {.name = "wireframe",
     .aliases = "wire,mesh-lines",
     .help = "draw the edges of all triangles",
     .manual = "Draws the edges of all triangles as lines, hidden ones left out.",
     .handler = cli_flag_switch,
     TARGET(shading.wireframe)},
    {.name = "edge-width",
     .aliases = "line-width",
     .value = "PIXELS",
     .help = "of outlines; other lines have 3/5 of it",
     .default_label = "1.8",
     .low = 0.1,
     .high = BURNISH_EDGE_WIDTH_MAX,
     .manual = "Width of lines at a step in depth, in pixels, from 0.1 to 100. The others have 3/5 "
               "of it.",
     .handler = cli_flag_real,
     TARGET(shading.edge_width)},
    {.name = "edge-color",
     .aliases = "edge-colour,line-color",
     .value = "COLOR",
     .help = "of lines",
     .default_label = "near black",
     .manual = "Colour of lines; see *COLOURS*.",
     .handler = cli_flag_color,
     TARGET(shading.edge_color)},

    {.group = "Input and report",
     .topic = "report",
     CLI_INPUT_FORMAT_FLAG(render_settings, input.load)},
    {.name = "clip",
     .aliases = "clipping,clip-plane,cut,section",
     .value = "X,Y,Z,D",
     .help = "cut away where X x + Y y + Z z > D; may be repeated",
     .manual =
         "Cuts away what is beyond a plane: points with _X_ x + _Y_ y + _Z_ z > _D_, in the units "
         "and axes of the input. *--clip=0,0,1,5* takes off all above z = 5. May be repeated up to "
         "6 times. What the cut opens of a solid, a closed mesh that is wound consistently, is "
         "filled and hatched; other meshes, and transparent surfaces, are cut and not filled. The "
         "camera frames what is left.",
     .handler = render_flag_clip,
     TARGET(input.clip)},
    {.name = "crease-angle",
     .value = "DEG",
     .help = "smooth edges below this angle",
     .default_label = "auto",
     .low = 0,
     .high = 180,
     .manual =
         "Where the input has no normals: smooth across all edges whose faces differ by less, "
         "0 shades every face flat. Without the flag each edge is judged by what is around "
         "it: smooth up to 20 degrees; up to 60 between faces that bend at all their edges, "
         "as in scans; up to 40 as a step of a curve; chamfers and pockets stay sharp, and "
         "fillets do not bend planes.",
     .handler = cli_flag_real,
     TARGET(input.crease)},
    {CLI_TESSELLATION_FLAG(render_settings, input.load)},
    {CLI_ANIMATION_TIME_FLAG(render_settings, input.load)},
    {CLI_ANIMATION_FLAG(render_settings, input.load)},
    {CLI_POINT_SIZE_FLAG(render_settings, input.load)},
    {CLI_STRICT_FLAG(render_settings, input.load)},
    {CLI_NO_TEXTURES_FLAG(render_settings, input.load)},
    {CLI_NO_LIBRARIES_FLAG(render_settings, input.load)},
    {CLI_MAX_TRIANGLES_FLAG(render_settings, input.load)},
    {CLI_MAX_TEXTURE_PIXELS_FLAG(render_settings, input.load)},
    {CLI_MAX_INPUT_BYTES_FLAG(render_settings, input.load)},
    {.name = "max-overdraw",
     .value = "N",
     .help = "refuse what covers the picture so many times",
     .default_text = "1000",
     .low = 1,
     .high = 1e9,
     .manual =
         "A bound of time: refuses (exit code 5) to draw a mesh whose large triangles, hidden ones "
         "included, cover the picture more than _N_ times (of less than 512 x 512 pixels: as many "
         "pixels as _N_ pictures of these have), or a depth map of ambient occlusion, "
         "ground or shadow more than 2 _N_ times. Transparent triangles count 16 times. Triangles "
         "of up to 16 pixels are not counted, and *--max-triangles* limits these. *overdraw* of "
         "*--json* tells the number.",
     .handler = cli_flag_real,
     TARGET(job.max_overdraw)},
    {.name = "max-seconds",
     .value = "N",
     .help = "end after so long",
     .low = 0,
     .high = 1e6,
     .default_text = "0",
     .default_label = "never",
     .manual = "Ends the run after _N_ seconds by the clock, without a picture and with exit code "
               "5. 0 means never.",
     .handler = cli_flag_real,
     TARGET(job.max_seconds)},
    {.name = "max-memory",
     .value = "N",
     .help = "bytes at most, such as 500M or 2G",
     .low = 1,
     .high = 9e18,
     .default_label = "all",
     .manual = "Memory that the run may have, addresses included that it does not touch: threads "
               "have some. What needs more ends with exit code 6. _N_ may end in *K*, *M* or *G*.",
     .handler = cli_flag_bytes,
     TARGET(job.max_memory)},
    {.name = "sandbox",
     .help = "read and draw in a process that can't open files",
     .manual =
         "Reads, draws and encodes in a process of its own, which can open no file, no socket and "
         "start no program: Linux's seccomp ends it when it tries, and Landlock, where the kernel "
         "has it, forbids files once more. It has the open input, and asks this one, "
         "which parses nothing, for material libraries and textures in the input's folder and to "
         "write the files named here. Pictures are the same. docs/security.md says more.",
     .handler = cli_flag_switch,
     TARGET(job.sandbox)},
    {.name = "no-sandbox",
     .help = "read and draw in this process",
     .manual = "Reads and draws in this process. This is the default.",
     .handler = render_flag_no_sandbox,
     TARGET(job.sandbox)},
    {CLI_JSON_FLAG(render_settings, output.json, "report on standard output, or in FILE",
                   "JSON OUTPUT")},
    {.name = "timing",
     .aliases = "time,verbose",
     .help = "milliseconds per phase on standard error",
     .manual =
         "Prints the milliseconds of each phase on standard error: *start* is the processor time "
         "before loading; *total* starts after it.",
     .handler = cli_flag_switch,
     TARGET(job.timing)},
    {.name = "quiet",
     .help = "no warnings and no progress",
     .manual = "No warnings and no progress on standard error; errors stay.",
     .handler = cli_flag_switch,
     TARGET(job.quiet)},
    {.name = "threads",
     .aliases = "jobs",
     .value = "N",
     .help = "number of threads (does not affect the result)",
     .default_text = "0",
     .low = 0,
     .high = 1024,
     .default_label = "all cores",
     .manual =
         "Threads to draw with, 0 for as many as the machine offers. The picture's bytes are the "
         "same for every number.",
     .handler = cli_flag_integer,
     TARGET(job.threads)},
    {.name = "isa",
     .help = "instruction set (does not affect the result)",
     .value = "NAME",
     .default_text = "auto",
     .manual =
         "The instruction set of the kernels: *auto* for the fastest that the processor has, "
         "*scalar*, *sse2*, *avx2*, *avx512* or *neon*. *auto* follows the environment variable "
         "*BURNISH_ISA* where it is set. The picture's bytes are the same for every one.",
     .handler = cli_flag_text,
     TARGET(job.isa_name)},
    {.name = "fail-on-blank",
     .common = 1,
     .help = "a blank picture ends with exit code 8 and no file",
     .manual = "When the picture, or a cell of a sheet, shows nothing or is of one colour, ends "
               "with exit "
               "code 8 and writes no picture. Otherwise a blank picture only gives a warning.",
     .handler = cli_flag_switch,
     TARGET(output.fail_on_blank)},
    {.name = "reference",
     .aliases = "ref",
     .value = "FILE",
     .help = "a PNG; exit code 10 where the picture differs",
     .manual = "Compares the picture, or the sheet, with a PNG of the same size. Where it differs, "
               "the picture is written all the same, one line tells how, and the exit code is 10. "
               "*--json* has the numbers under *reference*; they are those of *burnish compare*.",
     .handler = cli_flag_text,
     .takes_file = 1,
     TARGET(output.reference)},
    {.name = "reference-threshold",
     .aliases = "ref-threshold",
     .value = "X",
     .help = "largest error that passes",
     .default_label = "no pixel may differ",
     .low = 0,
     .high = 1,
     .manual = "The picture passes where its error, 1 less the structural similarity to the "
               "reference, is at most _X_, from 0 to 1. The same pictures always pass.",
     .handler = cli_flag_real,
     TARGET(output.reference_threshold)},
    {.name = "reference-difference",
     .value = "FILE",
     .help = "reference, picture and difference side by side",
     .manual = "Writes the reference, the picture and their difference side by side into _FILE_, "
               "as *burnish compare --output* does, where the sizes are the same.",
     .handler = cli_flag_text,
     .takes_file = 1,
     TARGET(output.reference_difference)},
};

static const cli_example examples[] = {
    {"burnish render *.stl --output-dir=thumbs", "a picture of each"},
    {NULL, NULL},
};

_Static_assert(sizeof flags / sizeof *flags <= 128, "as many as cli_given has bits for");

const cli_command render_command = {
    .name = "render",
    .operand = "INPUT...",
    .summary = "draw a mesh into a picture",
    .operand_help = CLI_INPUT_HELP,
    .manual =
        "Loads _INPUT_ and draws it with the Phong illumination equation. _INPUT_ is a glTF, GLB, "
        "OBJ (with its material library), OFF, PLY, STL or 3MF file, also in gzip, *-* for "
        "standard input, or a built-in object: "
        "*:teapot*, *:sphere*, *:torus* or *:knot*.\n"
        "Without flags the whole object is shown from a pleasant three-quarter view, lit by a rig "
        "that follows the camera. Values follow a flag after *=* or as the next argument; flags "
        "can't be abbreviated; of a repeated flag the last counts, but for *--light*; *--* ends "
        "the flags. A flag that can have no effect is an error: *--frames* without *--turntable*, "
        "*--columns* of one picture.\n"
        "Several inputs have a picture each, drawn as *burnish batch* does: each in a process of "
        "its own, locked in unless *--no-sandbox* is given, *--threads* at a time. Those that fail "
        "are listed, and the exit code is 11. *--json* is then the report of a batch. What is "
        "unchanged is drawn again: *burnish batch* leaves it, and takes folders within folders.",
    .operands_max = SIZE_MAX,
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
    .examples = examples,
    .sections = render_sections,
    .settings_size = sizeof(render_settings),
    .given = offsetof(render_settings, given),
    .work = render_work,
};
