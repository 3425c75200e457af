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
     CLI_FLAG("output", "FILE", ".png .jpg .webp .svg .exr .npy, or -", cli_flag_text, output.path),
     .default_label = "INPUT's name",
     .letter = 'o',
     .common = 1,
     .takes_file = 1,
     .aliases = "out",
     .manual = "Writes the picture to _FILE_, or to standard output for *-*, in the format that "
               "its ending says: *.png*, *.jpg*, *.jpeg*, *.webp*, *.svg*, *.exr* or *.npy*; see "
               "*FORMATS*. Other names are PNG. The file appears whole or not at all: it is "
               "written beside its final name and renamed. Without this flag the name is that of "
               "_INPUT_ with *.png* in the current folder (*teapot.png* for *:teapot*), and "
               "standard output when _INPUT_ is *-*; a file that has this name already is replaced "
               "only if burnish wrote it, or *--overwrite* is given. A file that _FILE_ names is "
               "replaced. A terminal is refused as output, and so is an ending of a format that "
               "burnish does not write.\n*{model}*, *{folder}*, *{ending}* and *{view}* in _FILE_ "
               "stand for parts of _INPUT_'s name and for the view, as in *burnish batch*; with "
               "more than one _INPUT_ there has to be one of them, or *--output-dir*."},
    {CLI_FLAG("output-dir", "FOLDER", "where pictures go, one per INPUT", cli_flag_text,
              output.folder),
     .letter = 'd', .common = 1, .takes_file = 1, .aliases = "outdir,out-dir",
     .manual = "The folder of the pictures, made where it is missing. _INPUT_ may then be a folder "
               "too, of which all meshes are taken."},
    {CLI_SWITCH("recursive", "folders below an INPUT that is one, too", job.recursive),
     .letter = 'r',
     .manual = "As of *burnish batch*: takes the meshes in all folders below an _INPUT_ that is a "
               "folder."},
    {CLI_FLAG("files-from", "FILE", "names of INPUTs; -: standard input", cli_flag_text,
              job.files_from),
     .takes_file = 1, .aliases = "inputs-from,files0-from,from-file",
     .manual = "As of *burnish batch*: reads names of inputs from _FILE_."},
    {CLI_FLAG("resolution", "W,H", "width and height in pixels", cli_flag_size, picture.size),
     CLI_RANGE(1, BURNISH_IMAGE_MAX_SIZE), .default_text = "1024,768", .common = 1,
     .aliases = "width,height,res",
     .manual = "Width and height of the picture in pixels, each from 1 to 16384; _W_*x*_H_ is "
               "understood too. On a sheet this is the size of each cell."},
    {CLI_FLAG("size", "N", "a square: --resolution=N,N", cli_flag_square, picture.size),
     CLI_RANGE(1, BURNISH_IMAGE_MAX_SIZE), .common = 1,
     .manual = "The same as *--resolution=*_N_*,*_N_."},
    {CLI_FLAG("rows", "FIRST:COUNT", "draw only these rows of the picture", render_flag_rows,
              picture.rows),
     .default_label = "all",
     .manual =
         "Draws _COUNT_ rows of the picture from row _FIRST_ on, counted from 0, and no others: "
         "the file holds these rows, with the bits that they have in the whole picture, whatever "
         "the other flags are. So many machines can draw one picture (docs/scale.md). Multiples of "
         "64 take least time. Without sheets, turntables, *--annotate* and SVG; what warns of a "
         "blank picture is silent; depths in PNG have the range of these rows."},
    {CLI_SWITCH("cull-back-faces", "leave out triangles seen from their back",
                picture.cull_back_faces),
     .aliases = "backface-culling",
     .manual = "Leaves out triangles that are seen from their back: a closed surface looks the "
               "same and takes less time. Otherwise both sides of a surface are lit."},
    {CLI_FLAG("samples", "N", "per pixel, along edges", cli_flag_word, picture.samples),
     .default_text = "4", .words = sample_words, .aliases = "antialiasing,anti-aliasing,aa,msaa",
     .manual = "Samples per pixel along the edges: 1 (none smoothed), 4, 8 or 16."},
    {CLI_FLAG("background-color", "COLOR", "#rgb, #rrggbb, r,g,b or a name", render_flag_background,
              picture.background),
     .default_label = "the look's", .common = 1, .aliases = "bg-color,bg,background",
     .manual = "Colour of the background, see *COLOURS*, or *none*. The later of this flag and "
               "*--no-background* counts."},
    {CLI_FLAG("no-background", NULL, "transparent", render_flag_no_background, picture.background),
     .common = 1, .aliases = "transparent,transparency",
     .manual = "Leaves the background transparent: the PNG gets an alpha channel."},
    {CLI_FLAG("views", "LIST", "one, or a sheet", render_flag_views, picture.views), .common = 1,
     .words = view_words, .aliases = "view",
     .manual =
         "Standard views, seen along the axes; several, between commas, make one labelled sheet. "
         "*front* looks at the side that faces the viewer when the up axis points up (+Z for up "
         "+Y, -Y for up +Z), *iso* is the isometric direction from the upper right front. They are "
         "parallel projections unless *--camera-orthographic=no* is given. Each view is framed on "
         "its own, in a scale of its own unless *--same-scale* is given."},
    {CLI_FLAG("annotate", "LIST", "measure", render_flag_annotate, picture.annotations),
     .words = annotation_words,
     .aliases = "annotations,axis,grid,dimensions,scale-bar,bounding-box",
     .manual = "Draws lines and numbers around the object, several between commas: *axes*, the "
               "directions of X, Y and Z in a corner; *box*, the edges of the bounding box, dashed "
               "behind the object; *dimensions*, the lengths of the bounding box with arrows; "
               "*scale*, a bar of 1, 2 or 5 times a power of 10, of a parallel projection (of a "
               "perspective it is left out, with a warning); *grid*, lines of the ground so far "
               "apart, with their spacing. Numbers are in the units of the input, rounded to four "
               "digits. Framing leaves room for them; what finds none is left out with a warning."},
    {CLI_FLAG("columns", "N", "of a sheet", cli_flag_integer, picture.columns), CLI_RANGE(1, 256),
     .default_label = "near a square",
     .manual = "Cells in a row of a sheet. Cells are views times lobes, the lobes of a view side "
               "by side."},
    {CLI_FLAG("labels", "LIST", "of a sheet, one text per cell, between commas", cli_flag_text,
              picture.labels),
     .manual = "What stands below the cells of a sheet instead of the views' and lobes' names: one "
               "text per cell, between commas, in UTF-8."},
    {CLI_FLAG("font", "FILE", "of all labels", cli_flag_text, picture.font),
     .default_label = "burnish's own; the system's beyond ASCII", .takes_file = 1,
     .manual =
         "TrueType or OpenType font of all labels. Without this flag labels are drawn in burnish's "
         "own letters, which are the same everywhere, as long as all are ASCII, and else in the "
         "system's sans-serif, with other fonts for scripts that it lacks. Scripts that run to the "
         "left and letters that join or combine are set as they are written."},
    {CLI_SWITCH("no-labels", "a sheet without labels", picture.no_labels),
     .manual = "Leaves out the names below the cells of a sheet."},
    {.group = "Files",
     .topic = "files",
     CLI_FLAG("output-format", "NAME", "one of", cli_flag_word, output.format),
     .words = format_words,
     .manual = "Format of the picture, whatever _FILE_'s ending says: for standard output. *auto*, "
               "the default, goes by the ending."},
    {CLI_FLAG("quality", "N", "of JPEG and WebP", cli_flag_integer, output.quality),
     CLI_RANGE(1, 100), .default_label = "90, WebP without loss",
     .manual = "Quality of JPEG (90 without this flag) and WebP (without loss), from 1 to 100."},
    {CLI_FLAG("dpi", "N", "dots per inch, for printing", cli_flag_real, output.dots_per_inch),
     CLI_RANGE(1, 65535), .default_label = "none",
     .manual = "Dots per inch that PNG and JPEG say they are printed with; the pixels stay. The "
               "width and height of an SVG are then millimetres, 25.4 times pixels by _N_: 25.4 "
               "times the report's *pixels_per_unit* makes a drawing in millimetres print at 1:1."},
    {CLI_FLAG("plane", "NAME:FILE", "depth, normal, triangle, material, coverage or color",
              render_flag_plane, output.planes),
     .manual = "Numbers of each pixel, in a file of their own beside the picture; may be repeated. "
               "*depth* is the distance from the camera along its axis, *normal* the interpolated "
               "normal in the object's axes, *triangle* and *material* are numbers from 0, "
               "*coverage* is the part of the pixel that the object takes, *color* linear light. "
               "Where several triangles share a pixel, it shows one of them; nothing is mixed but "
               "*coverage* and *color*. See *PLANES*."},
    {CLI_FLAG("turntable", "FILE", ".gif .png .webp .y4m; - is Y4M on standard output",
              cli_flag_text, output.turntable),
     .takes_file = 1,
     .manual = "Instead of a picture a turn of the camera around the object, to the right around "
               "the up axis through the focal point; the last frame continues into the first. All "
               "frames have one framing, in which nothing is cut off. *.gif* has one palette for "
               "all frames; *.png* is an animated PNG; *.webp* is without loss unless *--quality* "
               "is given; *.y4m* is for video encoders: 4:2:0, limited range, BT.709. For example "
               "*burnish render part.stl --turntable=- | ffmpeg -i - -colorspace bt709 part.mp4*."},
    {CLI_FLAG("frames", "N", "of a turntable", cli_flag_integer, output.frames), CLI_RANGE(2, 3600),
     .default_text = "60", .manual = "Frames of a turn, from 2 to 3600."},
    {CLI_FLAG("fps", "N", "frames per second of a turntable", cli_flag_integer, output.fps),
     CLI_RANGE(1, 120), .default_text = "20", .aliases = "frame-rate",
     .manual = "Frames per second of a turntable, from 1 to 120; of a GIF at most 50."},
    {CLI_FLAG("runners", "N", "N sockets, from descriptor 3 on, lead to others", cli_flag_integer,
              job.runners),
     CLI_RANGE(0, 65536),
     .manual = "Frames of a turntable, or bands of one picture, are drawn by others too, to whom "
               "the sockets from descriptor 3 on lead: *burnish render --runner* with the same "
               "flags. *burnish-mpi* starts both (docs/scale.md). The file has the same bytes. A "
               "picture is written as PNG, and as it is never whole in memory there are no sheets, "
               "*--rows*, *--annotate*, *--plane*, *--reference*, *--json* and *--fail-on-blank*."},
    {CLI_SWITCH("runner", "draw parts for a burnish with --runners", job.runner),
     .manual =
         "Draws the frames or bands that the socket at descriptor 3 asks for, and writes no file."},
    {CLI_SWITCH("overwrite", "replace a file with INPUT's name and .png, whoever wrote it",
                output.overwrite),
     .manual = "Replaces a file that has the name made from _INPUT_'s, whoever wrote it. Without "
               "this flag only pictures by burnish are replaced."},
    {.group = "Camera",
     .topic = "camera",
     CLI_FLAG("up", "AXIS", "upward", cli_flag_word, camera.up),
     .default_label = format_axes,
     .common = 1,
     .words = up_words,
     .aliases = "up-axis,up-direction",
     .manual = "The axis of the object that points up. *auto* is a guess: of +Y and +Z the one "
               "that the input's format says, unless the object would fall over that way and "
               "stands well the other way."},
    {CLI_FLAG("camera-direction", "X,Y,Z", "look along this and frame the object", cli_flag_nonzero,
              camera.direction),
     .default_label = "three-quarter", .common = 1,
     .manual = "Direction from the camera into the scene, of any length. The camera stands where "
               "the whole object fits into the picture, as large as *--margin* allows."},
    {CLI_FLAG("camera-azimuth-angle", "DEG", "turn to the right around the up axis", cli_flag_real,
              camera.azimuth),
     CLI_RANGE(-ANGLE_MAX, ANGLE_MAX), .default_text = "0", .common = 1,
     .aliases = "azimuth,rotate",
     .manual = "Turns the camera around the up axis, positive to the right. The framing follows."},
    {CLI_FLAG("camera-elevation-angle", "DEG", "lift toward the up axis", cli_flag_real,
              camera.elevation),
     CLI_RANGE(-ANGLE_MAX, ANGLE_MAX), .default_text = "0", .common = 1,
     .aliases = "elevation,tilt",
     .manual = "Lifts the camera, positive upward. The framing follows."},
    {CLI_FLAG("camera", "NAME", "one of the input's own, by name or number from 0", cli_flag_text,
              camera.own),
     .aliases = "camera-index",
     .manual = "Takes the picture from where this camera of the input stands (glTF), by its name "
               "or its number from 0, instead of framing the object. Standard views are framed."},
    {CLI_FLAG("camera-position", "X,Y,Z", "stand exactly here; nothing is framed", cli_flag_vector,
              camera.position),
     .manual = "Puts the camera at this position, in the units of the input, instead of framing "
               "the object."},
    {CLI_FLAG("camera-focal-point", "X,Y,Z", "the middle of the picture", cli_flag_vector,
              camera.focal_point),
     .default_label = "middle of the object",
     .manual = "The point in the middle of the picture. Without *--camera-position* the framed "
               "camera is moved sideways until it looks there, direction and distance unchanged."},
    {CLI_FLAG("camera-view-up", "X,Y,Z", "what is upward in the picture", cli_flag_nonzero,
              camera.view_up),
     .default_label = "the up axis",
     .manual = "Direction that is upward in the picture: rolls the camera. It may not be parallel "
               "to the direction of view."},
    {CLI_FLAG("camera-view-angle", "DEG", "angle from the lower to the upper edge", cli_flag_real,
              camera.view_angle),
     CLI_RANGE(0.001, 179), .default_text = "30", .aliases = "fov,field-of-view",
     .manual =
         "Angle from the lower to the upper edge of the picture, in degrees, from 0.001 to 179."},
    {CLI_FLAG("camera-zoom-factor", "F", "come nearer: the distance is divided by F", cli_flag_real,
              camera.zoom),
     CLI_RANGE(1e-3, 1e3), .default_text = "1", .aliases = "zoom",
     .manual = "Comes nearer: the distance from the focal point, or the height of a parallel "
               "projection, is divided by _F_, from 0.001 to 1000."},
    {CLI_FLAG("camera-orthographic", "no", "parallel projection; no: perspective",
              render_flag_projection, camera.projection),
     .default_label = "for --views", .common = 1, .optional = 1, .aliases = "ortho,parallel",
     .manual = "Parallel projection, which standard views have without this flag; *no* draws those "
               "in perspective too. With *--camera-position* the height of the picture is the one "
               "that frames the object."},
    {CLI_FLAG("camera-orthographic-height", "H", "parallel projection, H units of the input high",
              cli_flag_real, camera.orthographic_height),
     CLI_RANGE(1e-30, 1e30), .default_label = "what fits",
     .aliases = "parallel-scale,ortho-scale,orthographic-height",
     .manual = "Parallel projection in which the picture's height shows _H_ units of the input: "
               "pictures of different objects, or of different runs, have one scale. The object "
               "stays in the middle; *--margin* has no meaning."},
    {CLI_SWITCH("same-scale", "parallel projection, all cells of a sheet in one scale",
                camera.same_scale),
     .manual = "Draws all cells of a sheet in one scale, the largest in which each view fits: "
               "lengths can be compared across views, and what is at one height in *front* is at "
               "that height in *right*. Implies *--camera-orthographic*. The report's "
               "*pixels_per_unit* tells the scale."},
    {CLI_FLAG("margin", "F", "share left free at each side by framing", cli_flag_real,
              camera.margin),
     CLI_RANGE(0, 0.45), .default_text = "0.05",
     .manual = "Share of the picture's smaller side that framing leaves free at each side."},
    {.group = "Surface and light",
     .topic = "light",
     CLI_FLAG("look", "NAME", "style", cli_flag_word, shading.look),
     .default_text = "studio",
     .common = 1,
     .words = render_look_words,
     .manual = "Lights, ground, burnish's grey, ambient occlusion and edges by one name; see "
               "*LOOKS*. Other flags change parts of it."},
    {CLI_FLAG("color", "COLOR", "of the whole object", cli_flag_color, shading.color), .common = 1,
     .aliases = "colour,object-color",
     .manual = "Colour of the whole object instead of the input's colours; see *COLOURS*."},
    {CLI_FLAG("material", "NAME", "surface by name", cli_flag_word, shading.material), .common = 1,
     .words = render_preset_words,
     .manual = "A surface by name, for the whole object; see *MATERIALS*. Colours stay."},
    {CLI_FLAG("opacity", "F", "of the whole object", cli_flag_real, shading.opacity),
     CLI_RANGE(0, 1), .default_label = "the input's",
     .manual = "Opacity of the whole object, from 0 to 1, times that of the input's materials "
               "(*d*, *Tr*) and colours (alpha). Transparent surfaces are drawn in the order of "
               "their depths at every sample, both sides of them, and cast no shadows, unless they "
               "are opaque but for a mask."},
    {CLI_FLAG("specular", "F", "strength of the highlight, ks", cli_flag_real, shading.specular),
     CLI_RANGE(0, 1), .default_label = "the input's",
     .manual = "Strength of the highlight, the specular coefficient ks, for every material."},
    {CLI_FLAG("exponent", "N", "exponent of the highlight, n", cli_flag_real, shading.exponent),
     CLI_RANGE(1, 65536), .aliases = "shininess",
     .manual =
         "Exponent n of the highlight, for every material: the larger, the smaller and sharper."},
    {CLI_FLAG("lobe", "FIT:ORDER", "highlight's shape; a list makes a sheet", render_flag_lobes,
              shading.lobes),
     .default_text = "energy:2", .common = 1,
     .manual = "The specular lobe; see *LOBES*. Several, between commas, make one labelled sheet. "
               "Of a repeated flag the last list counts."},
    {CLI_FLAG("equation", "NAME", "cosine that the lobe is taken of", cli_flag_word,
              shading.equation),
     .default_text = "blinn", .words = equation_words,
     .manual = "Which cosine the lobe is taken of: *blinn*, N.H with the half vector, or *phong*, "
               "R.V with the mirrored light."},
    {CLI_FLAG("viewer", "NAME", "where highlights take the viewer to be", cli_flag_word,
              shading.viewer),
     .default_text = "local", .words = viewer_words,
     .manual = "Where highlights take the viewer to be: *local*, at the camera, or *distant*, "
               "infinitely far along the camera's axis."},
    {CLI_FLAG("light", "SPEC", "KIND:X,Y,Z[:F[:COLOR]], file; repeatable", render_flag_light,
              shading.lights),
     .default_label = "key, fill, rim",
     .manual = "A light, in place of the default rig of key, fill and rim light; see *LIGHTS*. May "
               "be repeated up to 64 times. *file*: those of the input. *none* takes away the rig "
               "and all lights so far."},
    {CLI_FLAG("ambient", "F|COLOR", "light from everywhere, linear", render_flag_ambient,
              shading.ambient),
     CLI_RANGE(0, 16), .default_label = "a little",
     .manual = "Ambient light: a number from 0 to 16, linear, or a colour."},
    {CLI_FLAG("occlusion", "N", "directions of the sky, or none", render_flag_occlusion,
              shading.occlusion),
     CLI_RANGE(1, BURNISH_OCCLUSION_MAX), .default_label = "the look's",
     .aliases = "ambient-occlusion,ao",
     .manual = "Ambient occlusion: creases, holes and undersides, which see less of the sky, are "
               "darker. From how many directions the sky is looked at, or *none*; an odd number "
               "counts as the next even one. More directions are smoother and take longer."},
    {CLI_SWITCH("ground", "a soft shadow below the object", shading.ground), .common = 1,
     .aliases = "contact-shadow,ground-shadow",
     .manual = "A soft shadow on the plane through the object's lowest point, across the up axis, "
               "where the camera is above it. The plane itself is not seen: the background is "
               "darkened, and a transparent one becomes black with the shadow as its alpha. "
               "Framing leaves room for it, and more on the right with *--shadow*."},
    {CLI_SWITCH("shadow", "the first light's, on the object itself", shading.shadow),
     .aliases = "shadows,cast-shadows",
     .manual = "The first light casts a shadow with a soft edge on the object itself, and on the "
               "ground of *--ground*. The light must be directional, as the looks' key light is."},
    {CLI_FLAG("edges", "LIST", "lines", render_flag_edges, shading.edges), .common = 1,
     .optional = 1, .words = edge_words, .aliases = "outline,outlines,feature-edges",
     .manual = "Draws edges as lines, hidden ones left out: *silhouettes*, where a step in depth "
               "is; *creases*, where the surface is shaded with an edge; *boundaries* of open "
               "surfaces; borders between *materials*; or *none*. Without _LIST_ all of them, "
               "without the flag those of the look. Lines at a step in depth are *--edge-width* "
               "wide, the others have 3/5 of that."},
    {CLI_SWITCH("wireframe", "draw the edges of all triangles", shading.wireframe),
     .aliases = "wire,mesh-lines",
     .manual = "Draws the edges of all triangles as lines, hidden ones left out."},
    {CLI_FLAG("edge-width", "PIXELS", "of outlines; other lines have 3/5 of it", cli_flag_real,
              shading.edge_width),
     CLI_RANGE(0.1, BURNISH_EDGE_WIDTH_MAX), .default_label = "1.8", .aliases = "line-width",
     .manual = "Width of lines at a step in depth, in pixels, from 0.1 to 100. The others have 3/5 "
               "of it."},
    {CLI_FLAG("edge-color", "COLOR", "of lines", cli_flag_color, shading.edge_color),
     .default_label = "near black", .aliases = "edge-colour,line-color",
     .manual = "Colour of lines; see *COLOURS*."},
    {.group = "Input and report",
     .topic = "report",
     CLI_INPUT_FORMAT_FLAG(render_settings, input.load)},
    {CLI_FLAG("clip", "X,Y,Z,D", "cut away where X x + Y y + Z z > D; may be repeated",
              render_flag_clip, input.clip),
     .aliases = "clipping,clip-plane,cut,section",
     .manual = "Cuts away what is beyond a plane: points with _X_ x + _Y_ y + _Z_ z > _D_, in the "
               "units and axes of the input. *--clip=0,0,1,5* takes off all above z = 5. May be "
               "repeated up to 6 times. What the cut opens of a solid, a closed mesh that is wound "
               "consistently, is filled and hatched; other meshes, and transparent surfaces, are "
               "cut and not filled. The camera frames what is left."},
    {CLI_FLAG("crease-angle", "DEG", "smooth edges below this angle", cli_flag_real, input.crease),
     CLI_RANGE(0, 180), .default_label = "auto",
     .manual = "Where the input has no normals: smooth across all edges whose faces differ by "
               "less, 0 shades every face flat. Without the flag each edge is judged by what is "
               "around it: smooth up to 20 degrees; up to 60 between faces that bend at all their "
               "edges, as in scans; up to 40 as a step of a curve; chamfers and pockets stay "
               "sharp, and fillets do not bend planes."},
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
    {CLI_FLAG("max-overdraw", "N", "refuse what covers the picture so many times", cli_flag_real,
              job.max_overdraw),
     CLI_RANGE(1, 1e9), .default_text = "1000",
     .manual = "A bound of time: refuses (exit code 5) to draw a mesh whose large triangles, "
               "hidden ones included, cover the picture more than _N_ times (of less than 512 x "
               "512 pixels: as many pixels as _N_ pictures of these have), or a depth map of "
               "ambient occlusion, ground or shadow more than 2 _N_ times. Transparent triangles "
               "count 16 times. Triangles of up to 16 pixels are not counted, and "
               "*--max-triangles* limits these. *overdraw* of *--json* tells the number."},
    {CLI_FLAG("max-seconds", "N", "end after so long", cli_flag_real, job.max_seconds),
     CLI_RANGE(0, 1e6), .default_text = "0", .default_label = "never",
     .manual = "Ends the run after _N_ seconds by the clock, without a picture and with exit code "
               "5. 0 means never."},
    {CLI_FLAG("max-memory", "N", "bytes at most, such as 500M or 2G", cli_flag_bytes,
              job.max_memory),
     CLI_RANGE(1, 9e18), .default_label = "all",
     .manual = "Memory that the run may have, addresses included that it does not touch: threads "
               "have some. What needs more ends with exit code 6. _N_ may end in *K*, *M* or *G*."},
    {CLI_SWITCH("sandbox", "read and draw in a process that can't open files", job.sandbox),
     .manual =
         "Reads, draws and encodes in a process of its own, which can open no file, no socket and "
         "start no program: Linux's seccomp ends it when it tries, and Landlock, where the kernel "
         "has it, forbids files once more. It has the open input, and asks this one, which parses "
         "nothing, for material libraries and textures in the input's folder and to write the "
         "files named here. Pictures are the same. docs/security.md says more."},
    {CLI_FLAG("no-sandbox", NULL, "read and draw in this process", render_flag_no_sandbox,
              job.sandbox),
     .manual = "Reads and draws in this process. This is the default."},
    {CLI_JSON_FLAG(render_settings, output.json, "report on standard output, or in FILE",
                   "JSON OUTPUT")},
    {CLI_SWITCH("timing", "milliseconds per phase on standard error", job.timing),
     .aliases = "time,verbose",
     .manual = "Prints the milliseconds of each phase on standard error: *start* is the processor "
               "time before loading; *total* starts after it."},
    {CLI_SWITCH("quiet", "no warnings and no progress", job.quiet),
     .manual = "No warnings and no progress on standard error; errors stay."},
    {CLI_FLAG("threads", "N", "number of threads (does not affect the result)", cli_flag_integer,
              job.threads),
     CLI_RANGE(0, 1024), .default_text = "0", .default_label = "all cores", .aliases = "jobs",
     .manual = "Threads to draw with, 0 for as many as the machine offers. The picture's bytes are "
               "the same for every number."},
    {CLI_FLAG("isa", "NAME", "instruction set (does not affect the result)", cli_flag_text,
              job.isa_name),
     .default_text = "auto",
     .manual =
         "The instruction set of the kernels: *auto* for the fastest that the processor has, "
         "*scalar*, *sse2*, *avx2*, *avx512* or *neon*. *auto* follows the environment variable "
         "*BURNISH_ISA* where it is set. The picture's bytes are the same for every one."},
    {CLI_SWITCH("fail-on-blank", "a blank picture ends with exit code 8 and no file",
                output.fail_on_blank),
     .common = 1,
     .manual =
         "When the picture, or a cell of a sheet, shows nothing or is of one colour, ends with "
         "exit code 8 and writes no picture. Otherwise a blank picture only gives a warning."},
    {CLI_FLAG("reference", "FILE", "a PNG; exit code 10 where the picture differs", cli_flag_text,
              output.reference),
     .takes_file = 1, .aliases = "ref",
     .manual = "Compares the picture, or the sheet, with a PNG of the same size. Where it differs, "
               "the picture is written all the same, one line tells how, and the exit code is 10. "
               "*--json* has the numbers under *reference*; they are those of *burnish compare*."},
    {CLI_FLAG("reference-threshold", "X", "largest error that passes", cli_flag_real,
              output.reference_threshold),
     CLI_RANGE(0, 1), .default_label = "no pixel may differ", .aliases = "ref-threshold",
     .manual = "The picture passes where its error, 1 less the structural similarity to the "
               "reference, is at most _X_, from 0 to 1. The same pictures always pass."},
    {CLI_FLAG("reference-difference", "FILE", "reference, picture and difference side by side",
              cli_flag_text, output.reference_difference),
     .takes_file = 1,
     .manual = "Writes the reference, the picture and their difference side by side into _FILE_, "
               "as *burnish compare --output* does, where the sizes are the same."},
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
