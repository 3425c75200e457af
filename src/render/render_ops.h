/* The kernels of rendering, compiled once per instruction set (frame/render_isa.c): a table of
 * functions, each signature declared here and nowhere else. A field has the name of its template,
 * which is in a file ..._simd.h below this folder. */
#ifndef BURNISH_RENDER_RENDER_OPS_H
#define BURNISH_RENDER_RENDER_OPS_H

#include <stddef.h>
#include <stdint.h>

#include "render/space.h"
#include "simd/isa.h"

/* Normal, colour, position, w, first light, openness, x, y, facing, and BURNISH_TEXTURE_STREAMS. */
/* What points see, of what there would be without anything that hides it. Maps find the first two, rays
 * the others and the first. */
enum {
    BURNISH_SEEN_LIGHT,
    BURNISH_SEEN_SKY,
    BURNISH_SEEN_BOUNCED = 1,  /* three: light that comes over other surfaces */
    BURNISH_SEEN_MIRRORED = 4, /* three: what other surfaces send along the lobe */
    BURNISH_SEEN_CLEAR = 7,    /* of what is mirrored from everywhere else */
    BURNISH_SEEN_AROUND,       /* three: what metals see of ambient light, less LIGHT of it */
    BURNISH_SEEN_VALUES = BURNISH_SEEN_AROUND + 3,
    BURNISH_SEEN_BATCH = 256
};

enum { BURNISH_BATCH_STREAMS = 25 + 18 };

/* Without a lobe, and the family's two: the first of burnish_lobe_body. */
enum { BURNISH_CODE_BODIES = 4 };

struct burnish_ground_view;
struct burnish_kernels_points;
struct burnish_kernels_shader;
struct burnish_mask;
struct burnish_mesh_view;
struct burnish_near_cells;
struct burnish_near_left;
struct burnish_occlusion_lookup;
struct burnish_passing;
struct burnish_primitive;
struct burnish_ray_light;
struct burnish_ray_points;
struct burnish_shadow_lookup;
struct burnish_started_rays;
struct burnish_silhouette;
struct burnish_splat_band;
struct burnish_splat_item;
struct burnish_srgb_encoder;
struct burnish_texture_levels;
struct burnish_texture_sampler;
struct burnish_texture_scratch;
struct burnish_texture_taps;
struct burnish_textured_material;

/* The arrays of a batch that shading reads, and where the items of one material go. */
typedef struct burnish_batch_streams {
    int count;
    const float *from[BURNISH_BATCH_STREAMS];
    float *to[BURNISH_BATCH_STREAMS];
} burnish_batch_streams;

/* A direction of normals and its code (codes_simd.h), kept from one batch of a tile to the next.
 * All zero before the first. */
typedef struct burnish_code_direction {
    const struct burnish_kernels_shader *shader; /* whose code it is */
    int state, axis;                             /* axis: the largest component, taken as 1 */
    float others[2];                             /* of the two axes after it, in turn */
    float limit;                                 /* of what others are off; 0: none points there */
    float inverse;                               /* of the largest component */
    int32_t code;
    int pause, left; /* steps that were shaded between two tries, and until the next */
} burnish_code_direction;

/* Pixels that become codes: normals of any length, which are shown where their depth is that of a
 * triangle. */
typedef struct burnish_code_batch {
    const float *normal[3], *depths;
    const struct burnish_srgb_encoder *encoder;
    uint32_t alpha, background; /* bits of the shown ones; the code of the others */
    burnish_code_direction *known;
    int has_codes; /* 1: normal[0] has face_code's codes in places */
    uint32_t *codes;
} burnish_code_batch;

/* From linear light to the light of 8-bit pixels. */
typedef struct burnish_tones {
    int is_linear;  /* 1: light stays as it is */
    int curve;      /* burnish_tone_mapping */
    float exposure; /* a factor */
} burnish_tones;

typedef struct burnish_render_ops {
    /* out = in scaled to unit length; out may be in. */
    void (*normalize_array)(size_t count, const float *const in[3], float *const out[3]);

    /* The positions of count points from the eye, times w, and w. Reads and writes whole vectors:
     * up to the next multiple of 16. */
    void (*position_from_depth)(const burnish_rays *rays, const burnish_screen_points *points,
                                size_t count, float *const position[3], float *w);

    /* The materials of count pixels, a multiple of 16, from the materials of two triangles or more;
     * returns whether all are the same.
     *   ids         burnish_primitive.id_and_facing of the pixels, unless there are primitives
     *   primitives  `shown` is an index of them; NULL: ids are read
     *   shown       pixels where it is below 0 get the material of another one */
    int (*find_materials)(const uint16_t *of_triangles, size_t triangle_count, const int32_t *ids,
                          const struct burnish_primitive *primitives, const int32_t *shown,
                          size_t count, int32_t *materials);

    /* Copies the vectors of items [first, count) in which `left` is `material`, one after another,
     * from each stream's array to its other one; there `left` becomes -1. starts[v] receives the
     * first item of vector v, so count <= 256. Returns how many items were copied. Arrays are read
     * and written up to the next multiple of 16. */
    int (*collect_material)(int32_t material, int first, int count, int32_t *left,
                            const burnish_batch_streams *streams, uint8_t *starts);

    /* Copies `size` colours of such vectors back to where `materials` is `material`. */
    void (*scatter_material)(int32_t material, const int32_t *materials, int size,
                             const uint8_t *starts, const float *const from[3], float *const to[3]);

    /* What count <= BURNISH_OCCLUDED_MAX points keep of their light: 1 less strength times the
     * share that is hidden from them, of the light and of a sky of equal light. Positions count from
     * the eye, normals are unit vectors. Reads and writes whole vectors. */
    void (*occlude)(const struct burnish_occlusion_lookup *lookup, const float *const position[3],
                    const float *const normal[3], size_t count, float *const open[2]);

    /* Casts rays `first` to first + count - 1 of the light's directions from points, and writes how
     * many are hidden, the light that there is, and what is hidden of it. `met`, unless it is NULL, gets
     * what the last of each met. Reads and writes whole vectors. */
    void (*sample_sky)(const struct burnish_ray_light *light,
                       const struct burnish_ray_points *points, int first, int count,
                       struct burnish_started_rays *met, float *const sums[3]);

    /* The same to places of a lamp; the first sum is how many are in its light. */
    void (*sample_lamp)(const struct burnish_ray_light *light, int lamp,
                        const struct burnish_ray_points *points, int first, int count,
                        float *const sums[3]);

    /* Multiplies the light of count points by what they see of it, open[0], and adds what surfaces
     * around them, which hide the sky of open[1], send there.
     *   albedo  per channel; factor: of each point, NULL: 1
     *   open    BURNISH_SEEN_VALUES arrays, as far as lookup->is_traced needs them
     * Reads and writes whole vectors. */
    void (*add_bounces)(const struct burnish_occlusion_lookup *lookup, const float albedo[3],
                        const float *const factor[3], float (*open)[BURNISH_SEEN_BATCH],
                        size_t count, float *const rgb[3]);

    /* Bits of the 16 pixels of a block that are shown, >= 0 (NULL: all); *alike: bits of those whose
     * squared distance from the first shown is below limits[0], and the cosine above limits[1]. */
    unsigned (*compare_block)(const float *const position[3], const float *const normal[3],
                              const int32_t *shown, const float limits[2], unsigned *alike);

    /* What of the light reaches count points, [0, 1]. Reads and writes whole vectors. */
    void (*cast_shadow)(const struct burnish_shadow_lookup *lookup,
                        const struct burnish_kernels_points *points, size_t count, float *lit);

    /* Writes the light of near lights, BURNISH_NEAR_VALUES arrays, of points of a tile that are in
     * cells of the material; fills *left with the others. Depths are not read. Reads and writes whole
     * vectors. */
    void (*apply_near_cells)(const struct burnish_near_cells *cells, int material,
                             const struct burnish_kernels_points *points,
                             const burnish_screen_points *screen, size_t count,
                             float (*values)[256], struct burnish_near_left *left);

    /* Adds a silhouette to `count` texels, a multiple of 16, of row `row` of the ground's texture:
     * its weight, shared out to the two layers whose widths are next to the blur's. */
    void (*add_silhouette)(const struct burnish_silhouette *silhouette, float row, size_t count,
                           float *const *layers);

    /* Blurs 16 neighbouring columns of `edge` x `edge` texels by a tent of 2 radius texels to each
     * side. scratch: 16 edge numbers. */
    void (*blur_columns)(float *texels, size_t edge, int radius, float *scratch);

    /* Darkens a row of the ground's texture, 65535 is black, by what layers add up to there, each
     * edge^2 after the one before.
     *   strength  what is left where they add up to 1: 1 - strength */
    void (*darken_ground)(const float *layers, size_t edge, int layer_count, float strength,
                          float row, uint16_t *texels);

    /* How dark the ground is at count points of the screen, [0, 1], 0 where it is not seen; depths
     * are not read. Reads and writes whole vectors. */
    void (*shadow_ground)(const struct burnish_ground_view *view,
                          const burnish_screen_points *points, size_t count, float *shadow);

    /* Makes planes of records of triangles, BURNISH_CORNER_FLOATS each. Reads and writes whole
     * vectors of them. */
    void (*plane_records)(const burnish_rays *rays, float *records, size_t count);

    /* Where count points of the screen lie in the images of their triangles: the first six of
     * BURNISH_TEXTURE_STREAMS, and the weights of corners 1 and 2 unless they are NULL.
     *   corners     records
     *   records     the number of each point's
     *   is_uniform  per BURNISH_TEXTURE_GROUP points: 1: all have the record of the first
     * Reads and writes whole vectors. */
    void (*locate_points)(const burnish_screen_points *points, const float *corners,
                          const uint16_t *records, const uint8_t *is_uniform, size_t count,
                          float *const *streams, float *const *weights);

    /* Which texels count points are means of. streams: the first six of BURNISH_TEXTURE_STREAMS.
     * Reads and writes whole vectors. */
    void (*find_taps)(const struct burnish_texture_sampler *sampler, const float *const *streams,
                      size_t count, struct burnish_texture_taps *taps);

    /* What a texture holds there: red, green, blue, alpha. Reads and writes whole vectors.
     *   channels  bit k: channel k is wanted; others may be written, too */
    void (*sample_texture)(const struct burnish_texture_levels *levels,
                           const struct burnish_texture_taps *taps, unsigned channels, size_t count,
                           float *const out[4]);

    /* What a mask leaves of each sample of a pixel, [0, 1], where a texture's samples are at its
     * cutoff: alpha there is that of the texels around the point, whose taps these are. streams:
     * BURNISH_TEXTURE_STREAMS. alpha: of the points. Reads and writes whole vectors. */
    void (*cover_samples)(const struct burnish_texture_sampler *sampler,
                          const struct burnish_mask *mask, const struct burnish_texture_taps *taps,
                          const float *const *streams, size_t count, const float *alpha,
                          float (*cover)[256]);

    /* Tangents, x, y, z and the bitangent's sign, of points of triangles `ids` at the weights of
     * corners 1 and 2. Reads and writes whole vectors. */
    void (*interpolate_tangents)(const struct burnish_mesh_view *mesh, const uint32_t *ids,
                                 const float *const weights[2], size_t count, float *const *out);

    /* Unit normals as samples of a normal texture turn them, and the mean length that they had.
     * tangent: x, y, z and the bitangent's sign. Reads and writes whole vectors. */
    void (*turn_normals)(float strength, const float *const normal[3], const float *const *tangent,
                         const float *const sample[4], size_t count, float *const out[4]);

    /* Cosines between normals and the direction to the viewer, at least 0. */
    void (*find_facing)(const struct burnish_kernels_shader *view,
                        const struct burnish_kernels_points *points, size_t count, float *facing);

    /* The coefficients of count points from what textures hold there: in scratch, diffuse
     * (colours), and where bit BURNISH_TEXTURE_... of `sampled` is set, specular, exponent,
     * channels 1 and 2 of sample (METALLIC_ROUGHNESS) and open (OCCLUSION); where there are
     * normals, length. Fills ambient, diffuse, specular and exponent; with bit
     * BURNISH_TEXTURE_REFLECTANCE also reflectance and roughness. Reads and writes whole vectors. */
    void (*vary_points)(const struct burnish_textured_material *material, unsigned sampled,
                        size_t count, struct burnish_texture_scratch *scratch);

    /* Fills scratch->bent: normals bent toward the viewer along the direction of the material's
     * anisotropy, unit vectors. In scratch are roughness and, if there is its texture, sample.
     *   view     has the viewer
     *   tangent  turn_normals' */
    void (*bend_normals)(const struct burnish_kernels_shader *view,
                         const struct burnish_textured_material *material,
                         const struct burnish_kernels_points *points, const float *const *tangent,
                         size_t count, struct burnish_texture_scratch *scratch);

    /* What passes through count points, in scratch: passed and transmission, which vary_points has
     * filled, reflectance, roughness and, if there is its texture, thickness. Fills passed with the
     * shares that pass, sample[0] to [2] with unit vectors along which refracted rays go, and
     * sample[3] with the share of light that comes from straight behind instead. Reads and writes
     * whole vectors. */
    void (*pass_points)(const struct burnish_passing *passing, size_t count,
                        struct burnish_texture_scratch *scratch);

    /* Exposes count colours and applies the curve, in place. Reads and writes whole vectors. */
    void (*map_tones)(const burnish_tones *tones, size_t count, float *const rgb[3]);

    /* count linear colours, a multiple of 16, to sRGB codes: red in the lowest byte of a pixel,
     * then green and blue. With `shown`, pixels where it is >= 0 also get the bits of alpha, and
     * the others are `background`. */
    void (*encode_pixels)(const struct burnish_srgb_encoder *encoder, size_t count,
                          const float *const rgb[3], const int32_t *shown, uint32_t alpha,
                          uint32_t background, uint32_t *pixels);

    /* The codes of count pixels, a multiple of 16, for a shader of that burnish_lobe_body with
     * directional lights and a distant viewer: what `shade` and encode_pixels make of them. */
    void (*shade_codes[BURNISH_CODE_BODIES])(const struct burnish_kernels_shader *shader,
                                             const burnish_code_batch *batch, size_t count);

    /* The code of all normals whose direction is within 2^-18.4 of a vector's, as the bits of a
     * float that is not finite; 0 if they have several. */
    int32_t (*face_code[BURNISH_CODE_BODIES])(const struct burnish_kernels_shader *shader,
                                              const struct burnish_srgb_encoder *encoder,
                                              const float normal[3], burnish_code_direction *known);

    /* count groups of four pixels, each `stride` pixels after the last, to 12 bytes per group, one
     * after another: red, green, blue. The highest byte of a pixel must be 0. */
    void (*pack_groups)(size_t count, const uint32_t *pixels, size_t stride, uint8_t *to);

    /* Blends splats, from near to far, into the band's rows. Reads and writes whole vectors. */
    void (*blend_splats)(const struct burnish_splat_item *items, size_t count,
                         const struct burnish_splat_band *band);
} burnish_render_ops;

/* The table of an instruction set; NULL if this build does not have it. */
const burnish_render_ops *burnish_render_ops_for(burnish_isa isa);

#endif
