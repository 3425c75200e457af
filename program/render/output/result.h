/* The result of `burnish render`, its report (JSON and times), and its reference. */
#ifndef TOOL_RENDER_OUTPUT_RESULT_H
#define TOOL_RENDER_OUTPUT_RESULT_H

#include "burnish/drawing.h"
#include "burnish/render.h"
#include "burnish/sheet.h"
#include "font/font.h"
#include "picture/formats.h"
#include "picture/verdict.h"
#include "render/scene/cameras.h"
#include "render/scene/environments.h"
#include "render/scene/warnings.h"
#include "render/settings/settings.h"

/* ---- Planes: buffers of numbers for other programs (planes.c) ---- */

/* The buffers, width * height items each; NULL if not requested. */
typedef struct render_plane_data {
    int width, height;
    float *color;        /* linear RGBA, straight alpha */
    float *depth;        /* infinity for empty pixels */
    float *normals;      /* x, y, z; 0, 0, 0 for empty pixels */
    uint32_t *triangles; /* UINT32_MAX, which is -1, for empty pixels */
    uint32_t *materials; /* the same */
    uint8_t *coverage;
    float low, high; /* of the finite depths; both 0 if there are none */
} render_plane_data;

/* Draws the planes of a set of kinds, bits 1 << render_plane_kind, with the camera and lobe of
 * options. Release them also after an error. Errors: MEMORY, and as for drawing. */
burnish_status render_draw_planes(burnish_renderer *renderer, const burnish_mesh *mesh,
                                  const burnish_render_options *options, unsigned kinds,
                                  render_plane_data *data, burnish_error *error);
void render_release_planes(render_plane_data *data);

/* The file of one plane. Errors: ARGUMENT for ids that a PNG can't hold, MEMORY. */
burnish_status render_encode_plane(const render_plane_data *data, const render_plane *plane,
                                   int threads, picture_file *file, burnish_error *error);

/* A whole picture: EXR with every plane, or NPY with the colour. Errors: MEMORY. */
burnish_status render_encode_planes(const render_plane_data *data, picture_format format,
                                    picture_file *file, burnish_error *error);

/* ---- Brightness and contrast of a finished picture (tones.c) ---- */

/* Statistics of the pixels that show the object; shares are in [0, 1]. NaN if undefined. */
typedef struct render_tones {
    double near_white;  /* share: all channels at least 250 */
    double near_black;  /* share: all channels at most 5 */
    double like_ground; /* share: all channels within 5 of the background's */
    double contrast;    /* (L + 0.05) / (M + 0.05) of the mean luminances of object and background,
                           the larger one in the numerator: [1, 21], as defined by WCAG 2.2*/
} render_tones;

/* One pass over the image.
 *   coverage  of each pixel, if there is a ground; or NULL: shadows on it count as the object's
 *   covered   pixels that show the object
 *   step      1: every pixel; N: every N-th
 *   options   for the background */
render_tones render_measure_tones(const burnish_image *image, const uint8_t *coverage,
                                  uint64_t covered, uint64_t step,
                                  const burnish_render_options *options);

/* 1: all pixels are equal. */
int render_has_one_color(const burnish_image *image);

/* ---- Results ---- */

/* The only picture, or a cell of a sheet. */
typedef struct render_cell {
    render_view view;
    burnish_lobe_spec lobe;
    burnish_camera camera;
    burnish_image image;
    burnish_drawing *drawing; /* of an SVG; else NULL */
    burnish_render_report report;
    uint64_t hash;
    render_tones tones;         /* with --json */
    uint8_t *coverage;          /* with --json and a ground, until tones are measured */
    uint32_t *triangles;        /* with --callouts, until annotations are drawn */
    burnish_callouts *callouts; /* with --callouts */
    int has_one_color;
    char label[256]; /* UTF-8 */
    int plate;       /* of --plate=sheet; else 0 */
} render_cell;

/* Wall time of the phases, except start, which is processor time before loading. load is read plus
 * build; total begins with load. */
typedef struct render_seconds {
    double start, load, read, build, transform, draw, encode, write, total;
} render_seconds;

/* The results of a run. */
typedef struct render_result {
    render_settings *settings;
    render_settings given; /* with --plate=sheet and --play: before they are prepared for a mesh */
    burnish_mesh *mesh;
    burnish_project *project; /* with --plate=sheet */
    burnish_render_options *options;
    burnish_renderer *renderer;
    render_cell *cells;
    size_t cell_count;
    burnish_image sheet;          /* of several cells */
    const burnish_image *picture; /* the only cell's image or the sheet */
    render_plane_data planes;     /* of the only cell */
    uint64_t hash;
    double color_range[2]; /* of --color-by */
    int columns;
    burnish_projection projection; /* of --views=third-angle and first-angle */
    render_environment environment;
    font *font; /* of labels; NULL: burnish's own */
    size_t blank_cells;
    size_t faulty_cells;   /* blank ones and others with a warning of render_warn_illegible */
    int written;           /* 1: the output is written under a temporary name */
    double start, encoded; /* clock, in seconds: before loading, after encoding */
    render_seconds seconds;
    struct {
        burnish_image image;     /* empty without --reference */
        picture_verdict verdict; /* with 0 pixels if the sizes differ */
    } reference;
    unsigned unmet; /* needs of the input, by number, of a picture of a batch */
    render_warnings warnings;
} render_result;

/* ---- The report (render_report.c) ---- */

/* A camera of a mesh with an origin in JSON; NULL when out of memory. *failed becomes 1 if a part
 * of it is missing. */
cJSON *render_camera_object(const burnish_camera *camera, const double origin[3], int *failed);

/* Writes the JSON object to the file of --json. Errors: MEMORY, WRITE. */
burnish_status render_write_json(const render_result *result, burnish_error *error);

/* The same object in one line, to be freed; NULL when out of memory. */
char *render_json_line(const render_result *result);

/* The object of an input without a picture; total: seconds, NAN for none. NULL when out of memory. */
cJSON *render_describe_failure(const char *input, int code, const char *message, double total,
                               int *failed);

/* The exit code of what was drawn, BLANK or DIFFERENT with its line in *line, or 0. */
int render_judge_result(const render_result *result, burnish_error *line);

/* Prints one line of milliseconds on standard error. */
void render_print_timing(const render_seconds *seconds);

/* ---- --reference, an older picture (reference.c) ---- */

/* Reads the reference, if there is one, before anything is drawn. Errors: READ, FORMAT, LIMIT,
 * MEMORY. */
burnish_status render_read_reference(render_result *result, burnish_error *error);

/* Compares result->picture with the reference, and writes --reference-difference. */
burnish_status render_judge(render_result *result, burnish_error *error);

/* Adds the key "reference" to the report. */
void render_add_reference(cJSON *root, const render_result *result, int *failed);

/* If the picture does not pass, sets *line and returns 1. */
int render_is_different(const render_result *result, burnish_error *line);

/* ---- Whether it shows the object (legible.c) ---- */

/* 1: the cell has one colour, or neither a pixel of the object nor a line. */
int render_is_blank(const render_result *result, const render_cell *cell);

/* Warns, once, about a cell that is blank, nearly black, like its background or a speck, and names a
 * flag that helps. Needs its image, without annotations, and its report. */
void render_warn_illegible(render_result *result, const render_cell *cell);

/* ---- Drawing it (draw.c) ---- */

/* Aims and draws all cells, composes them, and draws planes: sets result->picture, its hash and
 * result->planes. Errors: as for cameras and drawing. */
burnish_status render_draw_picture(render_result *result, burnish_error *error);

/* Draws a cell for each plate of the mesh instead, all in one scale, if two have something on them;
 * *are_drawn becomes 1 then. Errors: as for loading, preparing and drawing. */
burnish_status render_draw_plates(render_result *result, int *are_drawn, burnish_error *error);

/* Draws a cell whose view, lobe and camera are set, with annotations and legend, as pixels and for
 * an SVG or PDF as lines; warns about it. */
burnish_status render_draw_cell(render_result *result, render_cell *cell, burnish_error *error);

/* Draws a cell as a frame of a turntable: without annotations, and nothing is reported. */
burnish_status render_draw_frame(render_result *result, render_cell *cell, burnish_error *error);

/* ---- Turntables (turntable.c) ---- */

/* The camera of the first frame, which keeps the object in the picture for the whole turn. Errors:
 * ARGUMENT, MEMORY. */
burnish_status render_turntable_camera(const burnish_mesh *mesh, const render_settings *settings,
                                       render_view view, render_room *room, burnish_camera *camera,
                                       burnish_error *error);

/* Draws and writes all frames; result->cells[0] has the first one's camera and image, afterwards
 * the image of the last one. Errors: as for drawing, the format and writing; no file appears then.
 *   ready  receives result when all frames are written */
burnish_status render_write_turntable(render_result *result, burnish_file_check *ready,
                                      burnish_error *error);

/* ---- Frames of the input's animation (play.c) ---- */

/* The camera for all frames. Errors: ARGUMENT (no animation), and as for loading and cameras. */
burnish_status render_play_camera(const render_result *result, render_view view, render_room *room,
                                  burnish_camera *camera, burnish_error *error);

/* Draws a frame with the cell's camera, which moves with the origin of the frame's mesh. Errors: as
 * for loading, preparing and drawing. */
burnish_status render_draw_moment(render_result *result, render_cell *cell, int frame,
                                  burnish_error *error);

/* ---- Cells of a sheet (sheet_cells.c) ---- */

/* The cells as arguments of the library. */
typedef struct render_sheet {
    burnish_sheet_cell cells[RENDER_LIST_MAX * RENDER_LIST_MAX];
    uint8_t ink[3]; /* of labels: black or white, whichever stands out from the background */
} render_sheet;

/* The number of columns of a sheet of `count` cells. */
int render_sheet_columns(const render_settings *settings, size_t count);

/* Sets views, lobes, sizes and labels of the cells. The lobes of a view are side by side. */
void render_describe_cells(render_result *result);

/* Opens the font that labels need, if any. Errors: see font_open; only with --font. */
burnish_status render_open_font(render_result *result, burnish_error *error);

/* Checks the sheet's size, and warns about letters that no font has. */
burnish_status render_check_sheet(render_result *result, burnish_error *error);

void render_list_cells(const render_result *result, render_sheet *sheet);

/* Draws the image of the whole sheet. */
burnish_status render_compose(const render_result *result, burnish_image *image,
                              burnish_error *error);

/* ---- Annotations (annotations.c) ---- */

/* Makes the cell's drawing with annotations, from the last frame of the renderer. */
burnish_status render_trace(const render_result *result, render_cell *cell, const float *depth,
                            burnish_error *error);

/* The drawing of the only cell, or a sheet of all drawings, as SVG.
 *   cells  as the sheet of their images takes them
 *   ink    of labels */
burnish_status render_encode_drawing(const render_result *result, const burnish_sheet_cell *cells,
                                     const uint8_t ink[3], picture_file *file,
                                     burnish_error *error);

/* Draws the annotations over the cell, and warns about those without room.
 *   depth  distances of the mesh; NULL if no annotation is behind it */
burnish_status render_annotate(render_result *result, render_cell *cell, const float *depth,
                               burnish_error *error);

/* Draws the legend of --color-by over the image, on the right; nothing if the colours have none. */
void render_draw_legend(const render_result *result, burnish_image *image);

#endif
