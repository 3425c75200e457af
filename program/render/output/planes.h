/* Planes: buffers of numbers for other programs, in addition to the picture or instead of it. */
#ifndef TOOL_RENDER_PLANES_H
#define TOOL_RENDER_PLANES_H

#include "burnish/render.h"
#include "render/settings/settings.h"

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

#endif
