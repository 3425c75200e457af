/* What is compiled once per instruction set: one table of functions, each signature declared here
 * and nowhere else. A field has the name of its function; the function is a template over the
 * vector type (raster/..._simd.h, shading/..._simd.h).
 *
 * simd/isa_<name>.c is where templates meet an instruction set: the only files that include them.
 * Calls go down from C files through this table into templates and never come back up. */
#ifndef BURNISH_SIMD_ISA_OPS_H
#define BURNISH_SIMD_ISA_OPS_H

#include <stddef.h>
#include <stdint.h>

#include "burnish/kernels.h"
#include "shading/shader.h"

struct burnish_batch_header;
struct burnish_bin_slice;
struct burnish_bins;
struct burnish_block_row;
struct burnish_fragments;
struct burnish_geometry;
struct burnish_ground_view;
struct burnish_occlusion_lookup;
struct burnish_maps;
struct burnish_mesh_view;
struct burnish_raster_view;
struct burnish_screen_vertices;
struct burnish_shadow_lookup;
struct burnish_silhouette;
struct burnish_srgb_encoder;
struct burnish_mask;
struct burnish_texture_levels;
struct burnish_texture_sampler;
struct burnish_texture_scratch;
struct burnish_texture_taps;
struct burnish_textured_material;
struct burnish_tile;
struct burnish_triangle_batch;

/* out[i] = lobe(in[i]); out may be in. */
typedef void burnish_lobe_function(const burnish_lobe_constants *lobe, size_t count,
                                   const float *in, float *out);

/* The lighting of count points, as burnish/kernels.h says. Exactly one of rgba and rgb is written.
 */
typedef void burnish_shade_function(const burnish_kernels_shader *shader,
                                    const burnish_kernels_points *points, size_t count,
                                    uint8_t *rgba, float *const rgb[3]);

typedef struct burnish_isa_ops {
    burnish_isa isa;

    /* ---- raster: a frame ---- */

    /* Transforms the vertices [first, end) to the screen. */
    void (*transform_vertices)(struct burnish_screen_vertices *vertices,
                               const struct burnish_raster_view *view, const float *positions,
                               size_t first, size_t end);

    /* Culls `count` <= BURNISH_BATCH_SIZE triangles, 3 indices each, and finds depth and bounds of
     * those that may be seen; returns how many. Bit i of *clipped is set where triangle i must be
     * clipped first. */
    int (*cull_and_bound)(const struct burnish_screen_vertices *vertices,
                          const struct burnish_raster_view *view, const uint32_t *indices,
                          size_t count, struct burnish_triangle_batch *batch,
                          struct burnish_batch_header *header, unsigned *clipped);

    /* Appends the triangles of the batches [first, end) to a slice's tile lists. Returns where it
     * stopped: end, or the batch for which the slice has too few chunks. To be called again from
     * there when it has more: what that batch has already added is not added twice. */
    size_t (*bin_batches)(const struct burnish_bins *bins, struct burnish_bin_slice *slice,
                          const struct burnish_geometry *geometry, size_t first, size_t end);

    /* ---- raster: depth maps ---- */

    /* Projects `count` positions by a view per pair of maps, which have one size and origin and are
     * parallel projections in which the mesh fits. */
    void (*project_to_maps)(const struct burnish_raster_view *views, const float *positions,
                            size_t count, const struct burnish_maps *maps);

    /* Draws the triangles over what is in the maps. */
    void (*draw_maps)(struct burnish_maps *maps);

    /* ---- raster: a tile ---- */

    /* Draws the lists of the tile (column, row) into it. */
    void (*draw_tile)(struct burnish_tile *tile, const struct burnish_geometry *geometry,
                      const struct burnish_bins *bins, int column, int row);

    /* Collects the layers of the tile (column, row), which has been drawn, once more. */
    void (*draw_deeper_layers)(struct burnish_tile *tile, const struct burnish_geometry *geometry,
                               const struct burnish_bins *bins, int column, int row);

    /* Finds which pixels of a block row are covered, and which of them are simple. */
    void (*classify_block_row)(const struct burnish_tile *tile, int row,
                               struct burnish_block_row *pixels);

    /* The next fragments of the tile's complex pixels, from block *next_block on, which becomes
     * where to go on: 0 at first. Returns 0 when there are none left; with one sample per pixel
     * there are none. May write up to LANES - 1 items past the last one. */
    int (*next_fragments)(const struct burnish_tile *tile, const struct burnish_raster_view *view,
                          int *next_block, struct burnish_fragments *fragments);

    /* Sets drawn[t] to 1 for each of the mesh's triangles t that a sample shows; needs ids. Several
     * threads may do so at the same time. */
    void (*mark_drawn)(const struct burnish_tile *tile, uint8_t *drawn);

    /* ---- shading ---- */

    burnish_lobe_function *lobe[BURNISH_LOBE_BODY_COUNT][BURNISH_LOBE_INPUT_COUNT];
    burnish_shade_function
        *shade[BURNISH_LOBE_BODY_COUNT][BURNISH_SHADE_GEOMETRY_COUNT][BURNISH_SHADE_OUTPUT_COUNT];

    /* The lighting of count points that have a material each; `points` has no diffuse. Reads and
     * writes whole vectors. */
    void (*shade_each[BURNISH_LOBE_BODY_COUNT])(const burnish_kernels_shader *shader,
                                                const burnish_kernels_points *points,
                                                const burnish_point_materials *materials,
                                                size_t count, float *const rgb[3]);

    /* out = in scaled to unit length; out may be in. */
    void (*normalize_array)(size_t count, const float *const in[3], float *const out[3]);

    /* The positions of count points from the eye, times w, and w. Reads and writes whole vectors:
     * up to the next multiple of 16. */
    void (*position_from_depth)(const burnish_rays *rays, const burnish_screen_points *points,
                                size_t count, float *const position[3], float *w);

    /* ---- render ---- */

    /* Copies the vectors of points [first, count) in which `left` is `material`, one after another,
     * from each of `streams` arrays to another; there `left` becomes -1. places[v] gets the first
     * point of vector v, so count <= 256. Returns how many points were copied. Arrays are read and
     * written up to the next multiple of 16. */
    int (*collect_material)(int32_t material, int first, int count, int32_t *left, int streams,
                            const float *const *from, float *const *to, uint8_t *places);

    /* Takes `size` colours of such vectors back to where `materials` is `material`. */
    void (*scatter_material)(int32_t material, const int32_t *materials, int size,
                             const uint8_t *places, const float *const from[3], float *const to[3]);

    /* What count <= BURNISH_OCCLUDED_MAX points keep of their light: 1 less strength times the
     * share of the sky that is hidden from them. Positions count from the eye, normals are unit
     * vectors. Reads and writes whole vectors. */
    void (*occlude)(const struct burnish_occlusion_lookup *lookup, const float *const position[3],
                    const float *const normal[3], size_t count, float *open);

    /* What of the light reaches count points, [0, 1]. Reads and writes whole vectors. */
    void (*cast_shadow)(const struct burnish_shadow_lookup *lookup,
                        const struct burnish_kernels_points *points, size_t count, float *lit);

    /* Adds a silhouette to `count` texels, a multiple of 16, of row `row` of the ground's texture:
     * its weight, shared out to the two layers whose widths are next to the blur's. */
    void (*add_silhouette)(const struct burnish_silhouette *silhouette, float row, size_t count,
                           float *const *layers);

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

    /* The coefficients of count points from what textures hold there: in scratch, diffuse
     * (colours), and where bit BURNISH_TEXTURE_... of `sampled` is set, specular, exponent,
     * channels 1 and 2 of sample (METALLIC_ROUGHNESS) and open (OCCLUSION); where there are
     * normals, length. Fills ambient, diffuse, specular and exponent. Reads and writes whole
     * vectors. */
    void (*vary_points)(const struct burnish_textured_material *material, unsigned sampled,
                        size_t count, struct burnish_texture_scratch *scratch);

    /* count linear colours, a multiple of 16, to sRGB codes: red in the lowest byte of a pixel,
     * then green and blue. With `shown`, pixels where it is >= 0 also get the bits of alpha, and
     * the others are `background`. */
    void (*encode_pixels)(const struct burnish_srgb_encoder *encoder, size_t count,
                          const float *const rgb[3], const int32_t *shown, uint32_t alpha,
                          uint32_t background, uint32_t *pixels);

    /* count groups of four pixels, each `stride` pixels after the last, to 12 bytes per group, one
     * after another: red, green, blue. The highest byte of a pixel must be 0. May write up to four
     * bytes past the last. */
    void (*pack_groups)(size_t count, const uint32_t *pixels, size_t stride, uint8_t *to);
} burnish_isa_ops;

/* The table of an instruction set; NULL where this build has none. Whether it runs here says
 * burnish_isa_available(). */
const burnish_isa_ops *burnish_isa_ops_for(burnish_isa isa);

/* The registers that decide, as an x86 processor gives them; 0 where a leaf does not exist. */
typedef struct burnish_cpuid {
    uint32_t leaf1_ecx, leaf1_edx;
    uint32_t leaf7_ebx;
    uint64_t xcr0; /* what the operating system saves; 0 without OSXSAVE */
} burnish_cpuid;

/* The instruction sets that such a processor runs, SCALAR included. A pure function, so that tests
 * can try any processor. */
uint32_t burnish_isa_from_cpuid(const burnish_cpuid *cpuid);

/* Each isa_<name>.c gives its table, or NULL where it was not compiled for that instruction set. */
#define BURNISH_ISA_DECLARE(name, word, lanes) const burnish_isa_ops *burnish_isa_ops_##word(void);
BURNISH_ISA_LIST(BURNISH_ISA_DECLARE)
#undef BURNISH_ISA_DECLARE

#endif
