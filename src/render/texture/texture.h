/* Textures in a frame: what materials sample (texture.c), where a visible point lies in its image
 * (texture_points.c), and its light (texture_shade.c).
 *
 * A material is special where it has textures, light of its own, or metal's parameters: batches
 * (surface.h) hand its points over here. A mesh without special materials skips all of this. */
#ifndef BURNISH_RENDER_TEXTURE_TEXTURE_H
#define BURNISH_RENDER_TEXTURE_TEXTURE_H

#include "burnish/mesh.h"
#include "core/tasks.h"
#include "raster/raster_view.h"
#include "render/render_ops.h"
#include "render/space.h"
#include "render/texture/texture_levels.h"
#include "shading/shading_ops.h"

/* ---- What the kernels read ---- */

/* A texture as a material uses it. */
typedef struct burnish_texture_sampler {
    const burnish_texture_levels *levels; /* NULL: none */
    int wrap[2];                          /* burnish_texture_wrap */
    int is_nearest;
    int coordinates; /* 0 or 1: the streams of a batch */
    int is_single;   /* 1: of two levels the larger one alone counts */
    int has_transform;
    float transform[6]; /* as burnish_texture_use has it */
} burnish_texture_sampler;

/* The mask of a material. */
typedef struct burnish_mask {
    float solid, cutoff; /* there: where solid times alpha is at least cutoff */
    float alpha;         /* the alpha for which they are equal */
    int samples;
    const int8_t (*offsets)[2]; /* of samples, from the pixel's centre, 1/16 pixel */
    float spread;               /* pixels that the streams' changes are taken over: 1, or 1/2 */
} burnish_mask;

/* The texels that points are means of, by their index in burnish_texture_levels.texels: those on
 * the left, the upper and the lower one, and the shares of those on their right and of the lower
 * row. */
enum { BURNISH_TEXTURE_BATCH = 256 };

/* Next to the slots, as a bit: points get reflectance and roughness. */
enum { BURNISH_TEXTURE_REFLECTANCE = BURNISH_TEXTURE_SLOT_COUNT };

typedef struct burnish_texture_level_taps {
    int32_t upper[BURNISH_TEXTURE_BATCH], lower[BURNISH_TEXTURE_BATCH];
    float x[BURNISH_TEXTURE_BATCH], y[BURNISH_TEXTURE_BATCH];
} burnish_texture_level_taps;

typedef struct burnish_texture_taps {
    burnish_texture_level_taps level[2];       /* the next larger and the next smaller one */
    float share[BURNISH_TEXTURE_BATCH];        /* of the smaller one */
    uint8_t has_second[BURNISH_TEXTURE_BATCH]; /* of each vector: it counts */
    burnish_texture_box box;                   /* of all in level 0 */
} burnish_texture_taps;

/* Texture coordinates of points, and their changes to the pixel on the right and to the pixel
 * above. */
enum {
    BURNISH_TEXTURE_U,
    BURNISH_TEXTURE_V,
    BURNISH_TEXTURE_U_X,
    BURNISH_TEXTURE_V_X,
    BURNISH_TEXTURE_U_Y,
    BURNISH_TEXTURE_V_Y,
    BURNISH_TEXTURE_TANGENT,                            /* x, y, z, along which u grows */
    BURNISH_TEXTURE_SIGN = BURNISH_TEXTURE_TANGENT + 3, /* of the bitangent */
    BURNISH_TEXTURE_SHIFT_X, /* of fragments of layers: where the point lies, in pixels from its
                                pixel's centre, right and up */
    BURNISH_TEXTURE_SHIFT_Y,
    BURNISH_TEXTURE_SECOND, /* U to V_Y of the second texture coordinates */
    BURNISH_TEXTURE_STREAMS = BURNISH_TEXTURE_SECOND + 6 /* arrays of floats per point */
};

/* ---- A frame ---- */

typedef struct burnish_textured_material {
    burnish_material material; /* vertex colours replace a missing colour */
    int is_special;
    int has_textures; /* 1: coordinates are needed */
    int has_normals;  /* 1: tangents too */
    int is_varied;    /* 1: more than its colour differs from point to point */
    int is_alpha;     /* 1: alpha is below 1 somewhere */
    int is_smooth;    /* 1: a mask that is decided sample by sample */
    int is_bent;      /* 1: points have bent normals, for which they need tangents */
    int has_edge;     /* 1: points have an edge loss */
    int passes;       /* 1: light passes through it, and its triangles are transparent */
    int refracts;     /* 1: it is a smooth volume, through which rays are followed */
    float mask_alpha; /* MASK: the alpha from which on something is there */
    burnish_texture_sampler samplers[BURNISH_TEXTURE_SLOT_COUNT];
} burnish_textured_material;

/* Owned; all zero before the first frame, a later frame uses what still fits. */
typedef struct burnish_texturing {
    int has_some;          /* 0: no material is special, and nothing else means anything */
    int needs_points;      /* 1: some have textures */
    int needs_tangents;    /* 1: some have normal textures or anisotropy */
    int needs_second;      /* 1: some textures use the second texture coordinates */
    int has_alpha;         /* 1: some have alpha below 1 */
    int has_passing;       /* 1: light passes through some */
    int wants_reflectance; /* 1: light comes from many directions; the caller's to set */
    int samples;           /* of a pixel */
    int smooth_samples;    /* the same, where masks are decided sample by sample; 0: none is */
    const burnish_kernels *kernels; /* and ops: the caller's to set */
    const burnish_render_ops *ops;
    const burnish_mesh_view *mesh;
    burnish_textured_material *materials; /* one per material */
    size_t material_capacity;
    burnish_texture_levels *levels; /* BURNISH_TEXTURE_KIND_COUNT per texture */
    size_t levels_count;
    uint64_t serial; /* of the mesh that they are of; 0: of none */
    float slopes[BURNISH_EACH_TABLE], scales[BURNISH_EACH_TABLE]; /* burnish_point_materials */
    float least_exponent;
    burnish_lobe_spec lobe;       /* that these are of */
    burnish_kernels_shader white; /* a material of 1 in all, folded with the frame's lights */
    burnish_light_constants lights[BURNISH_LIGHT_MAX];
    double origin[3], scale, eye[3]; /* raster space: (p - origin) scale - eye */
} burnish_texturing;

/* Prepares what the mesh's materials sample; builds missing levels of textures. Errors: MEMORY,
 * CANCELLED. */
burnish_status burnish_texturing_update(burnish_texturing *texturing,
                                        const burnish_drawn_mesh *mesh, int samples,
                                        burnish_tasks *tasks, burnish_memory *memory);

/* What the view says: the lights with a white material, the lobe, where the eye is. Called where
 * has_some is 1. Errors: ARGUMENT. */
burnish_status burnish_texturing_view(burnish_texturing *texturing,
                                      const burnish_kernels_lighting *lighting,
                                      const burnish_lobe_spec *lobe, burnish_error *error);
void burnish_texturing_destroy(burnish_texturing *texturing, const burnish_context *context);

/* ---- Points ---- */

/* A triangle of points, one record of floats: numerators of the weights of corners 1 and 2 and
 * their denominator as planes over the screen (at its centre, per pixel right, per pixel up), and
 * corner 0 and the edges from it in the image. Before the kernel makes planes of them, these are
 * corner 0 from the eye and the edges from it. */
enum {
    BURNISH_CORNER_P,
    BURNISH_CORNER_E1 = 3,
    BURNISH_CORNER_E2 = 6,
    BURNISH_CORNER_FIRST = BURNISH_CORNER_P,
    BURNISH_CORNER_SECOND = BURNISH_CORNER_E1,
    BURNISH_CORNER_DETERMINANT = BURNISH_CORNER_E2,
    BURNISH_CORNER_UV = 9,
    BURNISH_CORNER_UV1 = 11,
    BURNISH_CORNER_UV2 = 13,
    BURNISH_CORNER_FLOATS = 16
};
enum {
    BURNISH_TEXTURE_GROUP = 16,    /* points; a row of blocks is a multiple */
    BURNISH_TEXTURE_RECENT = 1024, /* a power of two */
    /* Records that are kept, as the next row of blocks shows many of the triangles again. */
    BURNISH_TEXTURE_RECORDS = 1024
};

typedef struct burnish_texture_scratch {
    uint32_t *ids;                           /* id and facing of each point's triangle */
    uint16_t records[BURNISH_TEXTURE_BATCH]; /* and its number in corners */
    uint8_t is_uniform[BURNISH_TEXTURE_BATCH / BURNISH_TEXTURE_GROUP]; /* 1: a group has one */
    float corners[BURNISH_TEXTURE_RECORDS + BURNISH_TEXTURE_GROUP][BURNISH_CORNER_FLOATS];
    float second[BURNISH_TEXTURE_RECORDS + BURNISH_TEXTURE_GROUP][BURNISH_CORNER_FLOATS];
    uint32_t record_ids[BURNISH_TEXTURE_RECORDS];
    int record_count;                        /* of this frame */
    uint16_t recent[BURNISH_TEXTURE_RECENT]; /* records by the low bits of their triangle */
    float weights[2][BURNISH_TEXTURE_BATCH]; /* barycentric, of corners 1 and 2 */
    float points[BURNISH_TEXTURE_STREAMS][BURNISH_TEXTURE_BATCH];
    float brought[BURNISH_TEXTURE_STREAMS][BURNISH_TEXTURE_BATCH]; /* of one material */
    burnish_texture_taps taps;
    const burnish_texture_sampler *taps_of; /* the use that taps are of; NULL: none */
    float sample[4][BURNISH_TEXTURE_BATCH];
    float normal[3][BURNISH_TEXTURE_BATCH], length[BURNISH_TEXTURE_BATCH];
    float ambient[3][BURNISH_TEXTURE_BATCH], diffuse[3][BURNISH_TEXTURE_BATCH];
    float specular[3][BURNISH_TEXTURE_BATCH], exponent[BURNISH_TEXTURE_BATCH];
    float open[BURNISH_TEXTURE_BATCH]; /* of ambient light */
    float reflectance[3][BURNISH_TEXTURE_BATCH], roughness[BURNISH_TEXTURE_BATCH]; /* if wanted */
    float edge_loss[BURNISH_TEXTURE_BATCH], bent[3][BURNISH_TEXTURE_BATCH];
    float film[2][BURNISH_TEXTURE_BATCH], facing[BURNISH_TEXTURE_BATCH]; /* texels; N.V */
    float sheen[4][BURNISH_TEXTURE_BATCH]; /* factors of its colour and roughness */
    float opacity[BURNISH_TEXTURE_BATCH];  /* of points of one material */
    float alpha[BURNISH_TEXTURE_BATCH];    /* of the batch: what textures leave of the opacity */
    float transmission[BURNISH_TEXTURE_BATCH], thickness[BURNISH_TEXTURE_BATCH]; /* texels */
    float passed[3][BURNISH_TEXTURE_BATCH];  /* of points of one material: light that passes */
    float through[3][BURNISH_TEXTURE_BATCH]; /* of the batch */
    /* What masks leave of each sample of a pixel: of points of one material, and of the batch,
     * where some are smoothed. */
    int has_shifts; /* 1: points are fragments of layers, and some masks are smoothed */
    float cover[BURNISH_MAX_SAMPLES][BURNISH_TEXTURE_BATCH];
    float covers[BURNISH_MAX_SAMPLES][BURNISH_TEXTURE_BATCH];
    float at[BURNISH_TEXTURE_SECOND][BURNISH_TEXTURE_BATCH];    /* quarters of pixels */
    float mixed[BURNISH_TEXTURE_SECOND][BURNISH_TEXTURE_BATCH]; /* their pixels */
    float part[BURNISH_MAX_SAMPLES / 4][BURNISH_TEXTURE_BATCH];
} burnish_texture_scratch;

/* Points of one material through which light passes. */
typedef struct burnish_passing {
    const burnish_textured_material *material;
    const burnish_kernels_shader *shader; /* has the viewer */
    burnish_kernels_points points;        /* position and w are read if the viewer is near */
    const float *facing;                  /* above 0: the front is seen; above 1: and traced */
    int is_traced;                        /* 1: rays find what a volume absorbs */
} burnish_passing;

/* Points of one special material that are shaded together. */
typedef struct burnish_texture_batch {
    const burnish_render_ops *ops;
    const burnish_textured_material *material;
    /* BURNISH_TEXTURE_SECOND arrays, with the first and with the second texture coordinates */
    const float *const *streams[2];
    int count;
    burnish_texture_scratch *scratch;
} burnish_texture_batch;

/* Whether the lights of burnish/light.h take a material's metallic-roughness parameters. */
static inline int burnish_has_roughness(const burnish_material *material) {
    const float *f = material->reflectance;
    return material->is_metallic || material->metallic > 0 || material->roughness > 0 || f[0] > 0 ||
           f[1] > 0 || f[2] > 0;
}

/* `count` rounded up to whole vectors: lanes after the last point also read from the blocks of
 * a texture. */
static inline int burnish_texture_padded(int count) {
    return (count + BURNISH_TEXTURE_GROUP - 1) / BURNISH_TEXTURE_GROUP * BURNISH_TEXTURE_GROUP;
}

static inline void burnish_texture_fill(float *to, int count, float value) {
    for (int i = 0; i < count; ++i) {
        to[i] = value;
    }
}

/* ---- masks.c ---- */

/* What masks need of a batch: where fragments of layers lie in their pixels; all samples are whole
 * until their material is shaded.
 *   samples  of fragments of layers, bits of those that show it; NULL: of other points */
void burnish_masks_begin(const burnish_texturing *texturing, const uint16_t *samples, int count,
                         burnish_texture_scratch *scratch);

/* Where nearest texels count and that of a point is not there, others next to it may be, and show
 * in some samples: gives the point their mean colour. */
void burnish_masks_color(const burnish_texture_batch *batch);

/* The mask of points whose opacity and taps of the colour have been found: opacity becomes 0 or 1,
 * or 1 and cover what the mask leaves of each sample. */
void burnish_masks_apply(const burnish_texturing *texturing, const burnish_texture_batch *batch);

/* ---- texture_points.c ---- */

/* To be called before the first point of a frame: forgets the last frame's triangles. */
void burnish_texture_begin(burnish_texture_scratch *scratch);

/* Fills scratch->points for scratch->ids; points whose material needs none get some numbers.
 *   materials  of points; NULL: all have material 0 */
void burnish_texture_locate(const burnish_texturing *texturing, const burnish_rays *rays,
                            const burnish_screen_points *points, const int32_t *materials,
                            int count, burnish_texture_scratch *scratch);

/* ---- texture_shade.c ---- */

/* Light of a batch.
 *   shader  of the batch's material
 *   rgb     receives linear light, >= 0; NULL: only opacity is wanted
 * The batch's scratch receives in opacity what the material's textures leave of its opacity, [0,
 * 1]; if its mask is smoothed 1, and in cover what the mask leaves of each sample. */
void burnish_texture_shade(const burnish_texturing *texturing, const burnish_kernels_shader *shader,
                           const burnish_kernels_points *points, const burnish_texture_batch *batch,
                           float *const rgb[3]);

#endif
