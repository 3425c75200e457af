/* A mesh in memory and pictures of it, with the options of `burnish render`. The bindings are built
 * on sessions. Only one thread at a time can use a session. */
#ifndef TOOLS_SESSION_SESSION_H
#define TOOLS_SESSION_SESSION_H

#include "base/cli/options.h"
#include "burnish/image.h"
#include "burnish/mesh.h"
#include "burnish/render.h"

typedef struct session session;

/* One option and its value: text, numbers, or neither for a switch. */
typedef struct session_option {
    const char *name; /* of a flag, with '-', '_' or camelCase */
    const char *text;
    const double *numbers;
    size_t count; /* of the numbers */
    int is_off;   /* 1: false or an empty list, instead of a value */
} session_option;

/* How errors and warnings spell the names of options: camera_position, cameraPosition,
 * --camera-position. */
typedef enum session_naming {
    SESSION_UNDERSCORES,
    SESSION_CAMEL_CASE,
    SESSION_FLAGS
} session_naming;

/* The caller owns the options. Options of one name that follow one another are the items of a list.
 */
typedef struct session_options {
    const session_option *items;
    size_t count;
    session_naming naming;
} session_options;

/* Number `index` of the flags that are options, and what it is an option of: a sum of
 * CLI_PHASE_LOAD and CLI_PHASE_DRAW. NULL past the last. */
const cli_flag *session_flag_at(size_t index, unsigned *stages);

/* NULL without memory. The context of loading and drawing must outlive the session; NULL: the
 * default. */
session *session_create(burnish_context *context);
void session_destroy(session *s);

/* Adds a file that an input in memory can refer to. Name and bytes must live until the session is
 * open. Returns 0 without memory. */
int session_offer(session *s, const char *name, const void *bytes, size_t size);

/* The mesh that is opened next gets its facts. */
void session_request_facts(session *s);

/* Loads a mesh, once.
 *   name   a built-in object or a file; with bytes: for the format and messages
 *   bytes  of the file; NULL: the file `name` is loaded */
burnish_status session_open(session *s, const char *name, const void *bytes, size_t size,
                            session_options options, burnish_error *error);

/* Builds a mesh from arrays, once. */
burnish_status session_build(session *s, const burnish_mesh_description *description,
                             session_options options, burnish_error *error);

/* Checks options of drawing without a mesh. */
burnish_status session_check(session_options options, burnish_error *error);

/* Planes of numbers in addition to pictures, width * height items each as in burnish_target; NULL
 * if not requested. */
typedef struct session_planes {
    float *depth, *normals;
    uint32_t *triangles;
    uint8_t *coverage;
} session_planes;

enum { SESSION_DEPTH = 1, SESSION_NORMAL = 2, SESSION_TRIANGLE = 4, SESSION_COVERAGE = 8 };

/* Requests planes for the following pictures: a sum of SESSION_DEPTH and so on; default 0. */
void session_request_planes(session *s, unsigned kinds);

/* Draws the mesh. Can be called again, also after an error. */
burnish_status session_draw(session *s, session_options options, burnish_error *error);

/* ---- Results ---- */

/* The picture; valid until the next one. */
const burnish_image *session_image(const session *s);

/* The picture, which the caller destroys. The session keeps no image. */
burnish_image session_take_image(session *s);

/* The requested planes, which the caller frees. The session keeps none. */
session_planes session_take_planes(session *s);

uint64_t session_hash(const session *s); /* of the last picture; 0 after an error */
const burnish_render_report *session_report(const session *s);
burnish_camera session_camera(const session *s); /* in coordinates of the file */
const burnish_mesh *session_mesh(const session *s);
void session_bounds(const session *s, double minimum[3], double maximum[3]); /* the same */

/* Parts, plates and filaments in JSON, to be freed; NULL: out of memory. */
char *session_contents(const session *s);

int session_up_number(const session *s); /* the axis in use, a render_up */

/* Warning number `index`, the warnings of loading first; NULL past the last. */
const char *session_warning(const session *s, size_t index);

#endif
