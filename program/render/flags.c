/* The flags of `burnish render`, for the parser, the help screens and the man page. */
#include <stdio.h>

#include "base/cli/output.h"
#include "cli/main.h"
#include "picture/formats.h"
#include "render/flags.h"
#include "render/render.h"
#include "render/settings/flag_values.h"

static const cli_word format_words[] = {{"auto", PICTURE_AUTO},
                                        {"png", PICTURE_PNG},
                                        {"jpeg", PICTURE_JPEG},
                                        {"jpg", PICTURE_JPEG},
                                        {"webp", PICTURE_WEBP},
                                        {"svg", PICTURE_SVG},
                                        {"pdf", PICTURE_PDF},
                                        {"exr", PICTURE_EXR},
                                        {"npy", PICTURE_NPY},
                                        {"gif", PICTURE_GIF},
                                        {"mp4", PICTURE_MP4},
                                        {"webm", PICTURE_WEBM},
                                        {NULL, 0}};
static const cli_word sample_words[] = {{"1", 1}, {"4", 4}, {"8", 8}, {"16", 16}, {NULL, 0}};
static const cli_word up_words[] = {
    {"+Y", UP_POSITIVE_Y}, {"-Y", UP_NEGATIVE_Y}, {"+Z", UP_POSITIVE_Z},
    {"-Z", UP_NEGATIVE_Z}, {"+X", UP_POSITIVE_X}, {"-X", UP_NEGATIVE_X},
    {"auto", UP_AUTO},     {"format", UP_FORMAT}, {NULL, 0},
};
static const cli_word view_words[] = {
    {"front", VIEW_FRONT},
    {"right", VIEW_RIGHT},
    {"top", VIEW_TOP},
    {"iso", VIEW_ISO},
    {"back", VIEW_BACK},
    {"left", VIEW_LEFT},
    {"bottom", VIEW_BOTTOM},
    {"all", VIEW_ALL},
    {"third-angle", VIEW_THIRD_ANGLE},
    {"first-angle", VIEW_FIRST_ANGLE},
    {NULL, 0},
};
static const cli_word paper_words[] = {{"a4", 5}, {"a3", 4}, {"a2", 3},
                                       {"a1", 2}, {"a0", 1}, {NULL, 0}};
static const cli_word edge_words[] = {{"silhouettes", BURNISH_EDGES_SILHOUETTES},
                                      {"creases", BURNISH_EDGES_CREASES},
                                      {"boundaries", BURNISH_EDGES_BOUNDARIES},
                                      {"materials", BURNISH_EDGES_MATERIALS},
                                      {"tangents", BURNISH_EDGES_TANGENTS},
                                      {"none", 0},
                                      {NULL, 0}};

static const cli_word annotation_words[] = {{"axes", BURNISH_ANNOTATION_AXES},
                                            {"box", BURNISH_ANNOTATION_BOX},
                                            {"dimensions", BURNISH_ANNOTATION_DIMENSIONS},
                                            {"scale", BURNISH_ANNOTATION_SCALE},
                                            {"grid", BURNISH_ANNOTATION_GRID},
                                            {"none", 0},
                                            {NULL, 0}};
static const cli_word color_map_words[] = {{"viridis", BURNISH_COLOR_MAP_VIRIDIS},
                                           {"coolwarm", BURNISH_COLOR_MAP_COOLWARM},
                                           {"grey", BURNISH_COLOR_MAP_GREY},
                                           {NULL, 0}};
static const cli_word equation_words[] = {
    {"blinn", BURNISH_SPECULAR_BLINN}, {"phong", BURNISH_SPECULAR_PHONG}, {NULL, 0}};
static const cli_word viewer_words[] = {{"local", 1}, {"distant", 0}, {NULL, 0}};
static const cli_word normals_words[] = {{"auto", BURNISH_NORMALS_AUTO},
                                         {"file", BURNISH_NORMALS_FILE},
                                         {"own", BURNISH_NORMALS_OWN},
                                         {NULL, 0}};
#define AXIS_100(word) ", " #word " +X"
#define AXIS_010(word)
#define AXIS_001(word) ", " #word " +Z"
#define FORMAT_AXIS(name, word, extensions, x, y, z) AXIS_##x##y##z(word)
/* "+Y, stl +Z": +Y is the up axis of most formats. */
#define FORMAT_AXES "+Y" BURNISH_FORMAT_LIST(FORMAT_AXIS)

/* Values of coordinates and angles beyond this are mistakes. */
#define ANGLE_MAX 36000.0

#define TARGET(member) .offset = offsetof(render_settings, member)

#define DRAW_FLAG(...) CLI_FLAG(__VA_ARGS__), .phases = CLI_PHASE_DRAW
#define DRAW_SWITCH(...) CLI_SWITCH(__VA_ARGS__), .phases = CLI_PHASE_DRAW
#define LOAD_FLAG(...) CLI_FLAG(__VA_ARGS__), .phases = CLI_PHASE_LOAD
#define FILE_FLAG(...) CLI_FLAG(__VA_ARGS__), .phases = CLI_PHASE_FILE
#define FILE_SWITCH(...) CLI_SWITCH(__VA_ARGS__), .phases = CLI_PHASE_FILE

static const cli_flag flags[] = {
    {.group = "Picture",
     .topic = "picture",
     FILE_FLAG("output", "FILE", ".png .jpg .webp .svg .pdf .exr .npy, or -", cli_flag_text,
               output.path),
     .not_for = HEIR_ANY,
     .default_label = "INPUT's name",
     .letter = 'o',
     .common = 1,
     .file = CLI_WRITES,
     .aliases = "out,render-output,out-file",
     .manual =
         "Writes the picture to _FILE_, or to standard output for *-*. The file extension chooses "
         "the format: *.png*, *.jpg*, *.jpeg*, *.webp*, *.svg*, *.pdf*, *.exr* or *.npy*; see "
         "*FORMATS*. A name without an extension is a PNG. Any other extension is an error, such "
         "as *.stl*, and so is a terminal as standard output. The file is complete or does not "
         "appear: it is written under a temporary name and renamed. An existing _FILE_ is "
         "replaced, but without one of these extensions only if burnish wrote it, it is empty, or "
         "with *--overwrite*. If _FILE_ is a folder, the picture has its default name there. "
         "Without this flag the picture has the name of _INPUT_ with *.png*, in the current folder "
         "(*teapot.png* for *:teapot*), or goes to standard output when _INPUT_ is *-*. A file "
         "that already has this default name is replaced only if burnish wrote it, or with "
         "*--overwrite*.\n*{model}*, *{folder}*, *{extension}* and *{view}* in _FILE_ are replaced "
         "by parts of _INPUT_'s name and by the view, as in *burnish batch*. Several inputs need "
         "one of them, or *--output-dir*.\nInstead of this flag, a second operand can name the "
         "picture or the turntable: *burnish part.stl part.jpg*. An existing picture is then "
         "replaced only if burnish wrote it, or with *--overwrite*. A last operand that is a "
         "folder receives the pictures of all others, as with *cp*; *-* is standard output."},
    {FILE_FLAG("output-dir", "FOLDER", "folder of the pictures, one per INPUT", cli_flag_text,
               output.folder),
     .not_for = HEIR_ANY, .letter = 'd', .common = 1, .file = CLI_FOLDER,
     .aliases = "outdir,out-dir",
     .manual = "The folder of the pictures; it is created if it is missing. _INPUT_ can then be a "
               "folder, whose meshes are all drawn."},
    {FILE_SWITCH("recursive", "search folders recursively", job.recursive), .not_for = HEIR_ANY,
     .letter = 'r',
     .manual = "Draws the meshes in all folders below an _INPUT_ that is a folder, as *burnish "
               "batch* does."},
    {FILE_FLAG("files-from", "FILE", "read names of INPUTs; -: standard input", cli_flag_text,
               job.files_from),
     .not_for = HEIR_ANY, .file = CLI_READS, .aliases = "inputs-from,files0-from,from-file",
     .manual = "Reads names of inputs from _FILE_, as *burnish batch* does."},
    {DRAW_FLAG("resolution", "W,H", "width and height in pixels", cli_flag_size, picture.size),
     .not_for = HEIR_BATCH | HEIR_SERVE | HEIR_COMPARE, CLI_RANGE(1, BURNISH_IMAGE_MAX_SIZE),
     .default_text = "1024,768", .aliases = "res",
     .manual = "Width and height of the picture in pixels, each from 1 to 16384. _W_*x*_H_ is the "
               "same. On a sheet this is the size of each cell."},
    {DRAW_FLAG("size", "WxH", "width and height in pixels; N: a square", cli_flag_size,
               picture.size),
     CLI_RANGE(1, BURNISH_IMAGE_MAX_SIZE), .letter = 's', .default_label = "1024x768", .common = 1,
     .aliases = "resize,thumbnail-size,geometry",
     .manual = "*--size=*_W_*x*_H_ is the same as *--resolution=*_W_*,*_H_, and *--size=*_N_ the "
               "same as *--resolution=*_N_*,*_N_."},
    {DRAW_FLAG("width", "N", "width; the height follows, unless it is given", cli_flag_integer,
               picture.sides[0]),
     .not_for = HEIR_COMPARE, CLI_RANGE(1, BURNISH_IMAGE_MAX_SIZE),
     .manual = "Width of the picture in pixels. Without *--height*, the height keeps the "
               "proportions of *--resolution*."},
    {DRAW_FLAG("height", "N", "height; the width follows, unless it is given", cli_flag_integer,
               picture.sides[1]),
     .not_for = HEIR_COMPARE, CLI_RANGE(1, BURNISH_IMAGE_MAX_SIZE),
     .manual = "Height of the picture in pixels. Without *--width*, the width keeps the "
               "proportions of *--resolution*."},
    {DRAW_FLAG("rows", "FIRST:COUNT", "draw only these rows of the picture", render_flag_rows,
               picture.rows),
     .not_for = HEIR_ANY, .svg = CLI_SVG_REFUSED, .default_label = "all",
     .manual = "Draws only _COUNT_ rows of the picture, starting with row _FIRST_, counted from 0. "
               "The file holds these rows with the same bits as in the whole picture, so several "
               "machines can draw one picture (docs/batch.md). Multiples of 64 are fastest. Not "
               "available for sheets, turntables, *--annotate* and SVG. A blank part is not "
               "reported, and depths in PNG have the range of these rows."},
    {DRAW_SWITCH("cull-back-faces", "skip back-facing triangles", picture.cull_back_faces),
     .aliases = "backface-culling",
     .manual = "Skips back-facing triangles: a closed surface looks the same and is faster to "
               "draw. Without this flag both sides of a surface are lit, but for a glTF file whose "
               "materials are single-sided and whose faces look inward, as the walls of a room: "
               "there back faces are skipped, and the inside is seen."},
    {DRAW_FLAG("no-cull-back-faces", NULL, "draw both sides of every face", render_flag_never,
               picture.cull_back_faces),
     .svg = CLI_SVG_SAME, .aliases = "double-sided,no-backface-culling",
     .manual = "Draws both sides of every face, of rooms too."},
    {DRAW_FLAG("samples", "N", "samples per pixel (anti-aliasing)", cli_flag_word, picture.samples),
     .svg = CLI_SVG_REFUSED, .default_text = "4", .words = sample_words,
     .aliases = "antialiasing,anti-aliasing,aa,msaa,a,render-samples",
     .manual = "Samples per pixel along edges: 1 (no anti-aliasing), 4, 8 or 16."},
    {DRAW_FLAG("background-color", "COLOR", "#rgb, #rrggbb, r,g,b or a name",
               render_flag_background, picture.background),
     .value_type = CLI_TYPE_COLOR, .default_label = "the look's", .common = 1,
     .also = "background,bg-color", .aliases = "bg", .off = "none",
     .manual = "Colour of the background, see *COLOURS*, *none*, or *environment*: the environment "
               "of *--environment*, with its strength and turn. Parallel projections show it as a "
               "perspective of *--camera-view-angle* does. If *--no-background* is given too, the "
               "last of both counts."},
    {DRAW_FLAG("no-background", NULL, "transparent background", render_flag_no_background,
               picture.background),
     .common = 1, .aliases = "transparent,transparency,alpha,film-transparent",
     .manual = "Makes the background transparent: the PNG has an alpha channel."},
    {DRAW_FLAG("views", "LIST", "one or more", render_flag_views, picture.views),
     .value_type = CLI_TYPE_WORDS, .common = 1, .words = view_words, .aliases = "view",
     .manual = "Standard views along the axes; a list with commas makes one labelled sheet. "
               "*front* shows the side that faces the viewer when the up axis points up (+Z for up "
               "+Y, -Y for up +Z), *iso* is the isometric view from the upper right front. They "
               "are parallel projections unless *--camera-orthographic=no* is given. Each view is "
               "framed separately, in its own scale unless *--same-scale* is given. *all* is the "
               "seven views "
               "from *front* to *bottom*. *third-angle* "
               "and *first-angle* are drawing sheets: front, top and side view aligned at one "
               "scale, *iso* in the free corner, a frame, and the symbol of the projection. "
               "*--resolution* is the size of the whole sheet, by default A4 at 144 dots per inch. "
               "*--annotate=dimensions* gives each length once. With *--dpi* a unit is a "
               "millimetre, and the scale on paper is one of ISO 5455, such as 1:2."},
    {DRAW_FLAG("paper", "SIZE", "page of aligned views", cli_flag_word, picture.paper),
     .not_for = HEIR_ONE_PICTURE, .words = paper_words, .default_label = "none",
     .aliases = "paper-size,page-size",
     .manual =
         "The page of *--views=third-angle* or *first-angle*, lying on its long side, with the "
         "margins of ISO 5457, instead of *--resolution*. A unit of the input is a "
         "millimetre, as with *--dpi*, which is 144 unless it is given."},
    {DRAW_FLAG("annotate", "LIST", "draw measurements", render_flag_annotate, picture.annotations),
     .value_type = CLI_TYPE_WORDS, .not_for = HEIR_COMPARE, .words = annotation_words,
     .off = "none", .aliases = "annotations,axis,grid,dimensions,scale-bar,bounding-box,g,x",
     .manual =
         "Draws lines and numbers around the object, a list with commas: *axes*, the directions of "
         "X, Y and Z in a corner; *box*, the edges of the bounding box, dashed behind the object; "
         "*dimensions*, the lengths of the bounding box with arrows; *scale*, a bar of 1, 2 or 5 "
         "times a power of 10 (parallel projections only; in perspective it is omitted with a "
         "warning); *grid*, lines on the ground with such a spacing, and the spacing; *none*. "
         "Numbers are in the units of the input, rounded to four digits. Framing leaves room for "
         "annotations; one that does not fit is omitted with a warning. Parts that *--explode* "
         "moves have no *dimensions*."},
    {DRAW_SWITCH("callouts", "number the parts, and list them", picture.callouts),
     .not_for = HEIR_COMPARE, .aliases = "bom,balloons,parts-list",
     .manual =
         "Draws balloons with numbers around the object, leaders to the parts of the input, and a "
         "list of numbers, counts and names (*#3*: the third part, whose name is empty or not in "
         "Latin letters, which lose their accents). Equal parts have one number: the same name but "
         "for digits at its end, as many triangles, and the same area. A single part has one, too, "
         "also on a plate. Hidden parts are paler. The last row counts those that the list has no "
         "room for; *--json* has all. There are at most 64 "
         "balloons and 1000 entries; a warning names what has no balloon. Drawing sheets have them "
         "in the pictorial view. The list replaces the legend of *--color-by=part*."},
    {DRAW_FLAG("columns", "N", "columns of a sheet", cli_flag_integer, picture.columns),
     .not_for = HEIR_ONE_PICTURE, CLI_RANGE(1, 256), .default_label = "near a square",
     .aliases = "tile",
     .manual = "Number of cells in a row of a sheet. A sheet has a cell for each view and lobe; "
               "the lobes of a view are next to each other."},
    {DRAW_FLAG("labels", "LIST", "labels of a sheet's cells, between commas", cli_flag_text,
               picture.labels),
     .not_for = HEIR_ONE_PICTURE,
     .manual = "Labels below the cells of a sheet, instead of the names of views and lobes: one "
               "per cell, between commas, in UTF-8."},
    {DRAW_FLAG("font", "FILE", "font of labels", cli_flag_text, picture.font),
     .not_for = HEIR_ONE_PICTURE | HEIR_SERVE | HEIR_REQUEST,
     .default_label = "burnish's own; the system's beyond ASCII", .file = CLI_READS,
     .manual = "TrueType or OpenType font of all labels. Without this flag ASCII labels use "
               "burnish's own letters, which are the same on every machine; other labels use the "
               "system's sans-serif font, with fallback fonts for missing scripts. Right-to-left "
               "scripts, joining letters and combining characters are supported."},
    {DRAW_SWITCH("no-labels", "a sheet without labels", picture.no_labels),
     .not_for = HEIR_ONE_PICTURE, .manual = "Omits the labels below the cells of a sheet."},
    {.group = "Files",
     .topic = "files",
     FILE_FLAG("output-format", "NAME", "format", cli_flag_word, output.format),
     .not_for = HEIR_BATCH,
     .words = format_words,
     .aliases = "format,render-format,F",
     .manual = "Format of the picture, regardless of the file extension: for standard output. "
               "*auto*, the default, uses the extension."},
    {CLI_SCENE_FLAG(render_settings, input.load), .not_for = HEIR_ANY},
    {CLI_JOINT_FLAG(render_settings, input.load)},
    {FILE_FLAG("quality", "N", "quality of JPEG and WebP", cli_flag_integer, output.quality),
     .svg = CLI_SVG_SAME, CLI_RANGE(1, 100), .default_label = "90, WebP without loss",
     .manual = "Quality of JPEG (90 by default) and WebP (lossless by default), from 1 to 100."},
    {FILE_FLAG("dpi", "N", "dots per inch, for printing", cli_flag_real, output.dots_per_inch),
     CLI_RANGE(1, 65535), .default_label = "none", .aliases = "density",
     .manual =
         "Print resolution stored in PNG and JPEG; the pixels do not change. The width and height "
         "of an SVG or PDF are then in millimetres: pixels times 25.4 / _N_. With _N_ = 25.4 times "
         "*pixels_per_unit* of the report, a drawing in millimetres prints at 1:1."},
    {FILE_FLAG("plane", "NAME:FILE", "depth, normal, triangle, material, coverage or color",
               render_flag_plane, output.planes),
     .not_for = HEIR_ANY, .svg = CLI_SVG_SAME, .file = CLI_WRITES, .repeats = 1,
     .manual =
         "Writes a buffer of numbers for each pixel to its own file, in addition to the picture; "
         "can be repeated. *depth* is the distance from the camera along its axis, *normal* the "
         "interpolated normal in the object's coordinates, *triangle* and *material* are numbers "
         "from 0, *coverage* is the share of the pixel that the object covers, *color* is linear "
         "light. If several triangles share a pixel, the buffers have the values of one of them; "
         "only *coverage* and *color* are averaged. See *PLANES*."},
    {FILE_FLAG("turntable", "FILE", "animation: .gif .webp .mp4 .webm", cli_flag_text,
               output.turntable),
     .not_for = HEIR_ANY, .file = CLI_WRITES, .aliases = "animate,render-anim",
     .manual = "Writes an animation instead of a picture: one turn of the camera to the right, "
               "around the up axis through the focal point. The last frame continues into the "
               "first. All frames have the same framing, in which nothing is cut off. *.gif* has "
               "one palette for all frames; *.webp* is lossless unless *--quality* is given. "
               "*.mp4* and *.webm* are encoded by *ffmpeg*, which must be in *PATH*; of an odd "
               "width or height one column or row is cut off. *-* writes Y4M to standard output, "
               "for other video encoders: 4:2:0, limited range, BT.709."},
    {FILE_SWITCH("play", "the turntable shows INPUT's animation instead", output.plays),
     .not_for = HEIR_ANY, .svg = CLI_SVG_SAME, .aliases = "play-animation",
     .manual = "The frames of *--turntable* show a glTF file's animation instead of a turn: its "
               "first one, or that of *--animation*, at *--frames* equal steps of its length. It "
               "has its own speed if *--frames* is its seconds times *--fps*; *animation_seconds* "
               "of *--json* is its length. One camera shows what all frames cover. _INPUT_ is read "
               "again for each frame."},
    {FILE_FLAG("frames", "N", "frames of a turntable", cli_flag_integer, output.frames),
     .not_for = HEIR_ANY, .svg = CLI_SVG_SAME, CLI_RANGE(2, 3600), .default_text = "60",
     .manual = "Number of frames, from 2 to 3600."},
    {FILE_FLAG("fps", "N", "frames per second of a turntable", cli_flag_integer, output.fps),
     .not_for = HEIR_ANY, .svg = CLI_SVG_SAME, CLI_RANGE(1, 120), .default_text = "20",
     .aliases = "frame-rate",
     .manual = "Frames per second of a turntable, from 1 to 120; at most 50 in a GIF."},
    {CLI_SWITCH("overwrite", "replace a file that burnish did not write", output.overwrite),
     .phases = CLI_PHASE_FILE | CLI_PHASE_PROCESS, .not_for = HEIR_SERVE | HEIR_REQUEST,
     .aliases = "force,f,y,yes",
     .manual = "Replaces any file that has the picture's default name, or the name of *--output* "
               "without an extension of pictures. Without this flag only pictures written by "
               "burnish are replaced."},
    {.group = "Camera",
     .topic = "camera",
     LOAD_FLAG("up", "AXIS", "up axis", cli_flag_word, camera.up),
     .default_text = "auto",
     .common = 1,
     .words = up_words,
     .aliases = "up-axis,up-direction",
     .manual =
         "The axis of the object that points up. *format* is that of the input's "
         "format: " FORMAT_AXES
         ". *auto*, the default, is the same except for objects that would fall over: an OBJ, PLY "
         "or OFF file whose object is stable on +Z, and an STL file whose object falls on +Z and "
         "is very stable on +Y; and for point clouds of terrain, buildings or geographic "
         "coordinates, which take +Z, and PCD files of a depth camera, which take -Y. *burnish "
         "info* prints how stable it is. An object that is "
         "flat, "
         "with an extent of at most 0.5 % of its longest one, is a drawing: it keeps the axis, and "
         "the default view shows it face on. See docs/formats.md."},
    {DRAW_FLAG("camera-direction", "X,Y,Z", "direction of view; frames the object",
               cli_flag_nonzero, camera.direction),
     .default_label = "three-quarter", .common = 1,
     .manual = "Direction from the camera into the scene, of any length, or an axis such as *-Z*. "
               "The camera is placed so "
               "that the whole object fills the picture, up to *--margin*."},
    {DRAW_FLAG("azimuth", "DEG", "rotate to the right around the up axis", cli_flag_real,
               camera.azimuth),
     CLI_RANGE(-ANGLE_MAX, ANGLE_MAX), .default_text = "0", .common = 1,
     .also = "camera-azimuth-angle", .aliases = "rotate",
     .manual = "Rotates the camera around the up axis, positive to the right. Framing takes it "
               "into account."},
    {DRAW_FLAG("elevation", "DEG", "raise the camera", cli_flag_real, camera.elevation),
     CLI_RANGE(-ANGLE_MAX, ANGLE_MAX), .default_label = "0, flat objects up to 30", .common = 1,
     .also = "camera-elevation-angle", .aliases = "tilt",
     .manual = "Raises the camera, positive upward. Framing takes it into account. The default is "
               "more than 0 if the height is below a quarter of the longest side."},
    {DRAW_FLAG("camera", "NAME", "camera of the input, by name or number from 0", cli_flag_text,
               camera.own),
     .value_type = CLI_TYPE_NAME, .aliases = "camera-index",
     .manual = "Uses this camera of the input (glTF), by its name or its number from 0, instead of "
               "framing the object. Standard views are still framed."},
    {DRAW_FLAG("camera-position", "X,Y,Z", "exact position, without framing", cli_flag_vector,
               camera.position),
     .manual = "Puts the camera at this position, in the units of the input, instead of framing "
               "the object."},
    {DRAW_FLAG("camera-focal-point", "X,Y,Z", "point in the middle of the picture", cli_flag_vector,
               camera.focal_point),
     .default_label = "middle of the object",
     .manual = "The point in the middle of the picture. Without *--camera-position* the framed "
               "camera moves sideways until it looks there; direction and distance do not change."},
    {DRAW_FLAG("camera-view-up", "X,Y,Z", "up direction in the picture", cli_flag_nonzero,
               camera.view_up),
     .default_label = "the up axis",
     .manual = "Direction that points up in the picture: rolls the camera. It can not be parallel "
               "to the direction of view."},
    {DRAW_FLAG("camera-view-angle", "DEG", "vertical field of view in degrees", cli_flag_real,
               camera.view_angle),
     CLI_RANGE(0.001, 179), .default_text = "30", .aliases = "fov,field-of-view,lens",
     .manual = "Vertical field of view: the angle from the lower to the upper edge of the picture, "
               "in degrees, from 0.001 to 179."},
    {DRAW_FLAG("camera-intrinsics", "FX,FY,CX,CY", "focal lengths and principal point in pixels",
               render_flag_intrinsics, camera.intrinsics),
     .value_type = CLI_TYPE_VECTOR,
     .manual = "A calibrated camera without distortion: its focal lengths and its principal point "
               "in pixels, as in OpenCV, where 0,0 is the middle of the upper left pixel. Needs "
               "*--camera-position* and replaces *--camera-view-angle*."},
    {DRAW_FLAG("zoom", "F", "divide the distance by F", cli_flag_real, camera.zoom),
     CLI_RANGE(1e-3, 1e3), .default_text = "1", .also = "camera-zoom-factor", .aliases = "scale",
     .manual = "Moves the camera nearer: divides the distance from the focal point, or the height "
               "of a parallel projection, by _F_, from 0.001 to 1000."},
    {DRAW_FLAG("camera-orthographic", "no", "parallel projection; no: perspective",
               render_flag_projection, camera.projection),
     .default_label = "for --views", .common = 1, .optional = 1, .aliases = "ortho,parallel",
     .off = "no",
     .manual =
         "Parallel projection, which is the default for standard views; *no* draws all views in "
         "perspective. With *--camera-position* the object still fills the height of the picture."},
    {DRAW_FLAG("camera-orthographic-height", "H", "parallel projection, H units of the input high",
               cli_flag_real, camera.orthographic_height),
     CLI_RANGE(1e-30, 1e30), .default_label = "what fits",
     .aliases = "parallel-scale,ortho-scale,orthographic-height",
     .manual = "Parallel projection in which the height of the picture is _H_ units of the input: "
               "pictures of different objects, or of different runs, have the same scale. The "
               "object stays in the middle; *--margin* has no effect."},
    {DRAW_SWITCH("same-scale", "one scale for all cells of a sheet", camera.same_scale),
     .not_for = HEIR_SESSION,
     .manual =
         "Draws all cells of a sheet in one scale, the largest in which each view fits: lengths "
         "can be compared across views, and a feature has the same height in *front* and in "
         "*right*. Implies *--camera-orthographic*. The scale is *pixels_per_unit* in the report."},
    {DRAW_FLAG("margin", "F", "free share of the picture at each side", cli_flag_real,
               camera.margin),
     CLI_RANGE(0, 0.45), .default_text = "0.05", .aliases = "padding,border,trim,crop",
     .manual = "Share of the picture's shorter side that framing leaves free at each side."},
    {.group = "Surface and light",
     .topic = "light",
     DRAW_FLAG("look", "NAME", "style", cli_flag_word, shading.look),
     .default_text = "studio",
     .common = 1,
     .words = render_look_words,
     .aliases = "engine,shading,preset,E",
     .manual = "A preset of lights, background, grey surface colour, ambient occlusion and edges; "
               "see *LOOKS*. Other flags change parts of it. With *--equation=phong* or another  "
               "*--lobe* than the default, the default look is *three-point*."},
    {DRAW_FLAG("color", "COLOR", "colour of the whole object", cli_flag_color, shading.color),
     .value_type = CLI_TYPE_COLOR, .common = 1, .aliases = "colour,object-color",
     .manual = "Colour of the whole object, instead of the colours of the input; see *COLOURS*."},
    {DRAW_SWITCH("no-colors", "ignore the colours of the input", shading.no_colors),
     .svg = CLI_SVG_SAME, .common = 1, .aliases = "no-colours,ignore-colors,monochrome",
     .manual = "Ignores colours, materials and textures of the input, but not its opacity: the "
               "object has the grey of the look, or the colour of *--color*."},
    {DRAW_FLAG("material", "NAME", "material preset", cli_flag_word, shading.material), .common = 1,
     .words = render_preset_words, .aliases = "metal,metallic,roughness",
     .manual =
         "A material preset for the whole object; see *MATERIALS*. Colours do not change, but "
         "*glass* without a colour is clear."},
    {DRAW_FLAG("opacity", "F", "opacity of the whole object", cli_flag_real, shading.opacity),
     .svg = CLI_SVG_REFUSED, CLI_RANGE(0, 1), .default_label = "the input's",
     .manual =
         "Opacity of the whole object, from 0 to 1. It is multiplied by the opacity of materials "
         "(*d*, *Tr*) and colours (alpha). Both sides of transparent surfaces are drawn, sorted by "
         "depth at every sample. They cast no shadows, unless they are opaque apart from a mask."},
    {DRAW_FLAG("specular", "F", "strength of the highlight, ks", cli_flag_real, shading.specular),
     .svg = CLI_SVG_REFUSED, CLI_RANGE(0, 1), .default_label = "the input's",
     .manual = "Strength of the highlight, the specular coefficient ks, for every material."},
    {DRAW_FLAG("exponent", "N", "exponent of the highlight, n", cli_flag_real, shading.exponent),
     .svg = CLI_SVG_REFUSED, CLI_RANGE(1, 65536), .aliases = "shininess",
     .manual = "Exponent n of the highlight, for every material: a larger exponent makes it "
               "smaller and sharper."},
    {DRAW_FLAG("lobe", "FIT:ORDER", "shape of the highlight; a list: a sheet", render_flag_lobes,
               shading.lobes),
     .svg = CLI_SVG_REFUSED, .default_text = "auto", .common = 1,
     .manual =
         "The specular lobe; see *LOBES*. *auto* draws materials that state their exponent (in "
         "the input, by *--material* or *--exponent*) with cos^n, exact to 8 bits, and the rest "
         "with *energy:2*. Materials whose exponent, highlight or normal varies with a texture are "
         "drawn with *power* in place of *composite* and *display*. A list with commas makes one "
         "labelled sheet."},
    {DRAW_FLAG("equation", "NAME", "cosine that the lobe is applied to", cli_flag_word,
               shading.equation),
     .svg = CLI_SVG_REFUSED, .default_text = "blinn", .words = equation_words,
     .manual = "The cosine that the lobe is applied to: *blinn*, N.H with the half vector, or "
               "*phong*, R.V with the mirrored light."},
    {DRAW_FLAG("viewer", "NAME", "position of the viewer for highlights", cli_flag_word,
               shading.viewer),
     .svg = CLI_SVG_REFUSED, .default_text = "local", .words = viewer_words,
     .manual = "Position of the viewer for highlights: *local*, at the camera, or *distant*, "
               "infinitely far away along the camera's axis."},
    {DRAW_FLAG("light", "SPEC", "KIND:X,Y,Z[:...], file; repeatable", render_flag_light,
               shading.lights),
     .svg = CLI_SVG_REFUSED, .default_label = "the look's", .off = "none", .repeats = 1,
     .manual = "A light that replaces the lights of the look; see *LIGHTS*. Can be repeated: up to "
               "64 lights and 8 area lights. *file* adds the lights of the input. *none* removes "
               "the rig and all lights so far."},
    {DRAW_FLAG("environment", "NAME|FILE", "sky, room or an image: light from all directions",
               cli_flag_text, shading.environment.name),
     .default_label = "none", .file = CLI_READS, .also = "hdri-file,hdri", .aliases = "hdr,world",
     .manual = "Light from all directions, which replaces the lights of the look: *sky*, *room*, "
               "or an equirectangular image in Radiance HDR or EXR. Smooth and metallic surfaces "
               "reflect it. Lights of *--light* are added."},
    {DRAW_FLAG("environment-strength", "F", "factor of the environment's light", cli_flag_real,
               shading.environment.strength),
     CLI_RANGE(0, 1000), .default_text = "1", .manual = "Factor of the environment's light."},
    {DRAW_FLAG("environment-turn", "DEGREES", "rotation of the environment about the up axis",
               cli_flag_real, shading.environment.turn),
     CLI_RANGE(-3600, 3600), .default_text = "0",
     .manual = "Turns the environment about the up axis, counter-clockwise from above. At 0 the "
               "middle of its image is to the right of an object seen from the front."},
    {DRAW_FLAG("ambient", "F|COLOR", "ambient light, linear", render_flag_ambient, shading.ambient),
     .value_type = CLI_TYPE_LIGHT, CLI_RANGE(0, 16), .default_label = "the look's",
     .manual = "Ambient light: a number from 0 to 16, linear, or a colour."},
    {DRAW_FLAG("exposure", "STOPS", "make light brighter (> 0) or darker", cli_flag_real,
               shading.exposure),
     .svg = CLI_SVG_REFUSED, CLI_RANGE(-BURNISH_EXPOSURE_MAX, BURNISH_EXPOSURE_MAX),
     .default_text = "0", .aliases = "light-intensity,brightness",
     .manual = "Multiplies light by 2^_STOPS_, from -20 to 20. A background colour and buffers "
               "of linear colour do not change."},
    {DRAW_FLAG("tone-mapping", "NAME", "curve from light to pixels", render_flag_tones,
               shading.tone_mapping),
     .svg = CLI_SVG_REFUSED, .value_type = CLI_TYPE_WORD, .optional = 1, .words = render_tone_words,
     .default_label = "the look's", .off = "none", .aliases = "t,view-transform",
     .manual =
         "How light becomes pixels: *none* clamps light above 1; *neutral*, also without _NAME_, "
         "is Khronos PBR Neutral, which keeps hues and makes bright colours pale gradually; *soft* "
         "is the same without its toe, which darkens dark colours; *filmic* is a curve of ACES "
         "with more contrast. A background colour and buffers of linear colour do not change."},
    {DRAW_FLAG("occlusion", "N", "ambient occlusion: directions, or none", render_flag_occlusion,
               shading.occlusion),
     .value_type = CLI_TYPE_INTEGER, .svg = CLI_SVG_REFUSED, CLI_RANGE(1, BURNISH_OCCLUSION_MAX),
     .default_label = "the look's", .aliases = "ambient-occlusion,ao", .off = "none",
     .manual =
         "Ambient occlusion darkens creases, holes and undersides, the less the brighter their "
         "colour is, because surfaces light each other, and draws the soft shadows of area lights "
         "and environments. _N_ is the number of directions from "
         "which light arrives, or *none*; odd numbers are rounded up. More directions are "
         "smoother and slower."},
    {DRAW_SWITCH("ground", "draw a soft shadow below the object", shading.ground),
     .svg = CLI_SVG_REFUSED, .common = 1, .aliases = "contact-shadow,ground-shadow",
     .default_label = "in studio",
     .manual = "A soft shadow on the horizontal plane through the object's lowest point, if the "
               "camera is above it. The plane itself is invisible: it darkens the background, and "
               "a transparent background becomes black with the shadow as alpha. The shadow of the "
               "strongest area light falls away from it; that of a directional light needs "
               "*--shadow*. The object is as large as without. Drawn by default in the look "
               "*studio* if the object stands on its lowest points, but not with *--views*, "
               "*--plane*, *--occlusion=none* or linear outputs. If *--no-ground* is given too, "
               "the last of both counts."},
    {DRAW_FLAG("no-ground", NULL, "no shadow below the object", render_flag_never, shading.ground),
     .svg = CLI_SVG_SAME, .aliases = "no-contact-shadow,no-ground-shadow",
     .manual = "Draws no shadow below the object, for pictures that are laid over others or "
               "measured."},
    {DRAW_SWITCH("shadow", "shadow of the key light on the object", shading.shadow),
     .svg = CLI_SVG_REFUSED, .aliases = "shadows,cast-shadows",
     .manual = "The first light, which must be directional, casts a shadow with a soft edge on the "
               "object itself, and on the ground of *--ground*. In the look *studio*, or if all "
               "lights are area lights, the strongest area light does, as if all of its light came "
               "from its centre. If it is wide and there is occlusion, its soft shadow on the "
               "object is there without this flag."},
    {DRAW_SWITCH("raytracing", "find occlusion, shadows, reflections and refraction by rays",
                 shading.raytracing),
     .svg = CLI_SVG_REFUSED, .aliases = "ray-tracing,raytrace,rays,rt",
     .manual =
         "Casts rays at all triangles to find how much light arrives, instead of drawing depth "
         "maps: all area lights cast soft shadows, exact at contacts and in narrow gaps, also "
         "on the ground. Draws *--occlusion* unless it is *none*. Takes seconds for a large "
         "picture. Not for points of a cloud."},
    {DRAW_FLAG("edges", "LIST", "draw edges", render_flag_edges, shading.edges),
     .value_type = CLI_TYPE_WORDS, .common = 1, .optional = 1, .words = edge_words, .off = "none",
     .aliases = "outline,outlines,feature-edges,no-edges",
     .manual = "Draws visible edges as lines: *silhouettes*, at steps in depth; *creases*, at hard "
               "edges; *boundaries* of open surfaces; borders between *materials*; *tangents*, "
               "where a fillet meets a face; or *none*. Without _LIST_ all but tangents; without "
               "the flag the look decides."},
    {DRAW_SWITCH("wireframe", "draw the edges of all triangles", shading.wireframe),
     .aliases = "wire,mesh-lines,e",
     .manual = "Draws the visible edges of all triangles as lines."},
    {DRAW_SWITCH("hidden-lines", "draw hidden edges as dashed lines", shading.hidden_lines),
     .aliases = "hidden",
     .manual =
         "Draws the edges that the object hides as dashed lines, half as wide as visible ones, "
         "where no other line covers them. Draws edges like *--edges* if the look does not."},
    {DRAW_SWITCH("center-lines", "draw axes of holes and cylinders", shading.center_lines),
     .aliases = "centre-lines,axis-lines",
     .manual = "Draws axes that two circles of hard edges have in common as chain lines, with a "
               "cross where the axis points to the viewer. Axes of hidden circles are drawn only "
               "together with *--hidden-lines*. Draws edges like *--edges* if the look does not."},
    {DRAW_FLAG("edge-width", "PIXELS", "width of visible edges", cli_flag_real, shading.edge_width),
     CLI_RANGE(0.1, BURNISH_EDGE_WIDTH_MAX), .default_label = "1.8", .also = "line-width",
     .manual = "Width of visible edges in pixels, from 0.1 to 100. Hidden lines and axes have "
               "half of it, wireframes and the faint edges of views along an axis 3/5."},
    {DRAW_FLAG("edge-color", "COLOR", "colour of lines", cli_flag_color, shading.edge_color),
     .value_type = CLI_TYPE_COLOR, .default_label = "near black",
     .aliases = "edge-colour,line-color", .manual = "Colour of lines; see *COLOURS*."},
    {DRAW_FLAG("outline-contrast", "N", "least contrast to the background, 0 to 255", cli_flag_real,
               shading.outline_contrast),
     .svg = CLI_SVG_REFUSED, CLI_RANGE(0, 255), .default_label = "36 in studio",
     .manual =
         "Draws a hairline along the object's outline where it differs from the background by less "
         "than *N* of 255, so white objects on a white background stay visible. Other pixels keep "
         "their values; 0 draws none. Not drawn on transparent backgrounds."},
    {.group = "Input", .topic = "input", CLI_INPUT_FORMAT_FLAG(render_settings, input.load)},
    {LOAD_FLAG("clip", "X,Y,Z,D", "cut away where X x + Y y + Z z > D; may be repeated",
               render_flag_clip, input.clip),
     .value_type = CLI_TYPE_VECTOR, .not_for = HEIR_COMPARE, .aliases = "clipping,clip-plane",
     .repeats = 1,
     .manual =
         "Cuts away everything beyond a plane: points with _X_ x + _Y_ y + _Z_ z > _D_, in "
         "the coordinates of the input. *--clip=0,0,1,5* removes everything above z = 5. Can "
         "be repeated up to 6 times. Cuts through solids, whose parts are closed but for gaps of 1 "
         "% and wound consistently, are filled and hatched, parts in different ways; cuts "
         "through other meshes and transparent surfaces are not. The camera frames the "
         "rest."},
    {LOAD_FLAG("section", "AXIS", "cut and look at the cut: x, -y, z:OFFSET", render_flag_section,
               input.section),
     .value_type = CLI_TYPE_TEXT, .not_for = HEIR_COMPARE, .aliases = "cross-section,cut",
     .manual = "Cuts the object across an axis of the input, _AXIS_ or _AXIS_:_OFFSET_, by default "
               "in its middle, and looks at the cut square on, from the side of the front, right "
               "or top view. A sign chooses the side: *--section=-y* takes away what is below, and "
               "the viewer is there. Cuts are filled as those of *--clip*. A sheet of aligned "
               "views shows the whole object and one more view, A-A, whose plane and direction "
               "are marked in the front or top view."},
    {LOAD_FLAG("color-by", "VALUE", "height, normal, part (feature), filament (tool) or a property",
               cli_flag_text, input.coloring.by),
     .not_for = HEIR_COMPARE, .svg = CLI_SVG_REFUSED, .also = "coloring-array,scalars",
     .aliases = "scalar-coloring",
     .manual =
         "Colours the object by values of its vertices instead of its own colours: *height* along "
         "the up axis, *normal* (red, green and blue are the directions X, Y and Z), or a scalar "
         "property of the points or vertices of a PLY, PCD, LAS, XYZ or glTF file, such as "
         "*intensity* or *_HEAT*; or *part*, of files that *--hide* can divide, or *filament* of a "
         "print project (3MF, G-code; there *feature* and *tool* are the same). Values "
         "are interpolated over triangles and then mapped. A legend shows the range; framing "
         "leaves room for it. Not for *--look=drawing*, which has no colours."},
    {LOAD_FLAG("color-map", "NAME", "map of --color-by", cli_flag_word, input.coloring.map),
     .not_for = HEIR_COMPARE, .words = color_map_words, .default_text = "viridis",
     .also = "colormap-file", .aliases = "colormap",
     .manual = "Colours of *--color-by*: *viridis*, *coolwarm*, which diverges from a grey middle, "
               "or *grey*. The colours are then lit like any others."},
    {LOAD_FLAG("color-range", "LO:HI", "range of --color-by", render_flag_range,
               input.coloring.range),
     .not_for = HEIR_COMPARE, .default_label = "of the values", .also = "coloring-range,range",
     .manual = "Values with the first and the last colour of the map. Values beyond them get the "
               "nearest of the two. If _LO_ is more than _HI_, the map is reversed."},
    {DRAW_SWITCH("no-legend", "no legend of --color-by", input.coloring.no_legend),
     .not_for = HEIR_COMPARE,
     .manual = "Omits the bar of *--color-by* with its numbers, and the room for it."},
    {LOAD_FLAG("normals", "NAME", "source", cli_flag_word, input.normals), .words = normals_words,
     .default_text = "auto",
     .manual = "Source of the normals. *file* uses those of the input and generates missing ones; "
               "*own* generates all of them. *auto*, the default, is *own* if *--crease-angle* is "
               "given; otherwise it is *file*, except that the normals of an OBJ, PLY or OFF file, "
               "or of a glTF file without normal textures, are replaced, with a warning, if they "
               "smooth the sharp edges of flat faces on more than 10 % of the area."},
    {LOAD_FLAG("crease-angle", "DEG", "smooth edges below this angle", cli_flag_real, input.crease),
     CLI_RANGE(0, 180), .default_label = "auto",
     .manual =
         "Generates normals: edges whose faces differ by less than this angle are smooth; 0 shades "
         "every face flat. Normals of the input are used only with *--normals=file*; then the "
         "angle applies to missing ones. By default each edge depends on its surroundings: it is "
         "smooth up to 20 degrees, up to 60 between faces that bend at all their edges, and up to "
         "40 as a step of a curve. Chamfers and pockets stay sharp, and fillets do not bend "
         "planes. In scans and sculptures steeper edges are smooth too where most edges bend."},
    {CLI_TESSELLATION_FLAG(render_settings, input.load)},
    {CLI_ANIMATION_TIME_FLAG(render_settings, input.load)},
    {CLI_ANIMATION_FLAG(render_settings, input.load)},
    {CLI_VARIANT_FLAG(render_settings, input.load)},
    {CLI_PLATE_FLAG(render_settings, input.load)},
    {CLI_HIDE_FLAG(render_settings, input.load)},
    {CLI_ONLY_FLAG(render_settings, input.load)},
    {CLI_EXPLODE_FLAG(render_settings, input.load)},
    {CLI_THUMBNAIL_FLAG(render_settings, input.load)},
    {CLI_POINT_SIZE_FLAG(render_settings, input.load)},
    {CLI_STRICT_FLAG(render_settings, input.load)},
    {CLI_NO_TEXTURES_FLAG(render_settings, input.load)},
    {CLI_NO_LIBRARIES_FLAG(render_settings, input.load)},
    {CLI_ROOT_FLAG(render_settings, input.load), .not_for = HEIR_REQUEST | HEIR_SERVE},
    {.group = "Limits and report",
     .topic = "report",
     CLI_MAX_TRIANGLES_FLAG(render_settings, input.load),
     .not_for = HEIR_REQUEST},
    {CLI_MAX_TEXTURE_PIXELS_FLAG(render_settings, input.load), .not_for = HEIR_REQUEST},
    {CLI_MAX_INPUT_BYTES_FLAG(render_settings, input.load), .not_for = HEIR_REQUEST},
    {CLI_FLAG("max-overdraw", "N", "limit on large triangles", cli_flag_real, job.max_overdraw),
     .phases = CLI_PHASE_DRAW | CLI_PHASE_PROCESS, .not_for = HEIR_REQUEST, CLI_RANGE(1, 1e9),
     .default_text = "1000",
     .manual =
         "Limits the time: a mesh is refused (exit code 5) if its large triangles, visible or "
         "hidden, cover the picture more than _N_ times (a picture with less than 512 x 512 pixels "
         "counts as one with so many), or a depth map of ambient occlusion, ground or shadow more "
         "than 2 _N_ times. Transparent triangles count 16 times. Triangles of up to 16 pixels do "
         "not count; *--max-triangles* limits them. The number is *overdraw* in *--json*."},
    {CLI_FLAG("max-seconds", "N", "time limit", cli_flag_real, job.max_seconds),
     .phases = CLI_PHASE_PROCESS, .not_for = HEIR_ANY, CLI_RANGE(0, 1e6), .default_text = "0",
     .default_label = "never",
     .manual = "Ends the run after _N_ seconds of processor time, of all threads together, or ten "
               "times that in wall-clock time, without a picture and with exit code 5. An importer "
               "may take as much again. 0: no limit."},
    {CLI_FLAG("max-memory", "N", "memory limit, such as 500M or 2G", cli_flag_bytes,
              job.max_memory),
     .phases = CLI_PHASE_PROCESS, .not_for = HEIR_ANY, CLI_RANGE(1, 9e18), .default_label = "all",
     .manual = "Limit on the address space of the process in bytes, including reserved but unused "
               "memory such as the stacks of threads. A run that needs more ends with exit code "
               "6; G-code is drawn in fewer layers. _N_ can end in *K*, *M* or *G*."},
    {CLI_SWITCH("sandbox", "read and draw in a process that can't open files", job.sandbox),
     .phases = CLI_PHASE_PROCESS, .not_for = HEIR_ANY,
     .manual = "Reads, draws and encodes in a separate process that can not open files or sockets "
               "or start programs: Linux's seccomp ends the process if it tries, and Landlock, if "
               "the kernel has it, denies access to files as well. The process receives the open "
               "input. It requests material libraries and textures in the input's folder from the "
               "main process, which parses nothing and writes the files named on the command line. "
               "Pictures are the same. See docs/security.md."},
    {CLI_FLAG("no-sandbox", NULL, "read and draw in this process", render_flag_no_sandbox,
              job.sandbox),
     .phases = CLI_PHASE_PROCESS, .not_for = HEIR_ANY,
     .manual = "Reads and draws in this process. This is the default."},
    {CLI_JSON_FLAG(render_settings, output.json, "report on standard output, or in FILE",
                   "JSON OUTPUT"),
     .phases = CLI_PHASE_FILE | CLI_PHASE_PROCESS, .not_for = HEIR_ANY},
    {CLI_SWITCH("timing", "milliseconds per phase on standard error", job.timing),
     .phases = CLI_PHASE_PROCESS, .not_for = HEIR_ANY, .also = "verbose", .aliases = "time",
     .manual = "Prints the milliseconds of each phase on standard error: *start* is the processor "
               "time before loading; *total* begins after it."},
    {CLI_SWITCH("quiet", "no warnings, no progress", job.quiet), .phases = CLI_PHASE_PROCESS,
     .letter = 'q',
     .manual = "No warnings and no progress on standard error; errors are still printed."},
    {CLI_FLAG("threads", "N", "number of threads (does not affect the result)", cli_flag_integer,
              job.threads),
     .phases = CLI_PHASE_LOAD | CLI_PHASE_DRAW | CLI_PHASE_PROCESS,
     .not_for = HEIR_BATCH | HEIR_REQUEST, CLI_RANGE(0, 1024), .default_text = "0",
     .default_label = "all cores", .aliases = "jobs,j",
     .manual =
         "Number of threads, 0 for all processors. The bytes of the picture do not depend on it."},
    {CLI_FLAG("isa", "NAME", "instruction set (does not affect the result)", cli_flag_text,
              job.isa_name),
     .phases = CLI_PHASE_DRAW | CLI_PHASE_PROCESS, .not_for = HEIR_REQUEST, .default_text = "auto",
     .manual =
         "The instruction set of the kernels: *auto* for the fastest one that the processor "
         "supports, *scalar*, *sse2*, *avx2*, *avx512* or *neon*. *auto* follows the environment "
         "variable *BURNISH_ISA* if it is set. The bytes of the picture do not depend on it."},
    {FILE_SWITCH("fail-on-blank", "exit code 8 and no file if blank", output.fail_on_blank),
     .svg = CLI_SVG_SAME, .common = 1,
     .manual =
         "If the picture, or a cell of a sheet, shows nothing or has only one colour, ends with "
         "exit code 8 and writes no picture. Without this flag a blank picture is a warning."},
    {FILE_FLAG("reference", "FILE", "compare with a PNG; exit code 10 if different", cli_flag_text,
               output.reference),
     .not_for = HEIR_ANY, .file = CLI_READS, .also = "ref",
     .manual =
         "Compares the picture, or the sheet, with a PNG of the same size. If they differ, the "
         "picture is still written, one line describes the difference, and the exit code is 10. "
         "The numbers, the same as those of *burnish compare*, are under *reference* in *--json*."},
    {FILE_FLAG("reference-threshold", "X", "largest accepted error", cli_flag_real,
               output.reference_threshold),
     .not_for = HEIR_ANY, CLI_RANGE(0, 1), .default_label = "no pixel may differ",
     .aliases = "ref-threshold",
     .manual = "The picture passes if its error, 1 minus the structural similarity to the "
               "reference, is at most _X_, from 0 to 1. Identical pictures always pass."},
    {FILE_FLAG("reference-difference", "FILE", "reference, picture and difference side by side",
               cli_flag_text, output.reference_difference),
     .not_for = HEIR_ANY, .file = CLI_WRITES,
     .manual = "If the sizes are the same, writes the reference, the picture and their difference "
               "side by side into _FILE_, as *burnish compare --output* does."},
};

static const cli_example examples[] = {
    {"burnish render *.stl --output-dir=thumbs", "one picture per file"},
    {NULL, NULL},
};

_Static_assert(sizeof flags / sizeof *flags <= 128, "as many as cli_given has bits for");

const cli_command render_command = {
    .name = "render",
    .aliases = "convert,magick,thumbnail,screenshot,draw",
    .operand = "INPUT...",
    .summary = "draw a mesh into a picture",
    .operand_help = CLI_INPUT_HELP,
    .manual =
        "Draws _INPUT_: a file with an extension of" CLI_INPUT_EXTENSIONS
        ", optionally compressed with gzip or in a ZIP archive (*kit.zip:part.stl* names one of "
        "several), *-* for standard input, or a built-in object: "
        "*:teapot*, *:sphere*, *:torus* or *:knot*.\nWithout flags the picture shows the whole "
        "object in a three-quarter view, lit by lights that follow the camera. The value of a flag "
        "follows after *=* or as the next argument. Flags can't be abbreviated. If a flag is "
        "repeated, the last one counts, without a warning; *--light*, *--clip*, *--plane*, "
        "*--hide*, *--only* and *--joint* add up. *--* ends the flags. A flag without an effect is "
        "a warning, such as *--frames* without "
        "*--turntable* or *--animation* for an STL file, and an error with *--strict*. Limits, "
        "*--overwrite*, *--no-colors*, *--no-textures* and *--no-libraries* never are. Flags that "
        "contradict each other, and flags for shading in an SVG or PDF, are errors.\nSeveral "
        "inputs are drawn as *burnish batch* does: one picture and one process per input, "
        "sandboxed unless *--no-sandbox* is given, *--threads* at a time. Inputs that fail are "
        "listed, and the exit code is 11. *--json* has a line for each. All pictures are "
        "drawn, also unchanged ones, which *burnish batch* skips.",
    .operands_max = SIZE_MAX,
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
    .examples = examples,
    .sections = render_sections,
    .settings_size = sizeof(render_settings),
    .given = offsetof(render_settings, given),
};

const cli_command render_options_command = {
    .name = "options",
    .base = &render_command,
    .base_phases = CLI_PHASE_LOAD | CLI_PHASE_DRAW,
    .heir = HEIR_SESSION,
    .settings_size = sizeof(render_settings),
};
