/* The kernels of shading, compiled once per instruction set (shading_isa.c): a table of functions,
 * each signature declared here and nowhere else. It is burnish_kernels of the public header. */
#ifndef BURNISH_SHADING_SHADING_OPS_H
#define BURNISH_SHADING_SHADING_OPS_H

#include "shading/polygon.h"
#include "shading/shader.h"

/* out[i] = lobe(in[i]); out may be in. */
typedef void burnish_lobe_function(const burnish_lobe_constants *lobe, size_t count,
                                   const float *in, float *out);

/* The lighting of count points, as burnish/kernels.h says. Exactly one of rgba and rgb is written.
 */
typedef void burnish_shade_function(const burnish_kernels_shader *shader,
                                    const burnish_kernels_points *points, size_t count,
                                    uint8_t *rgba, float *const rgb[3]);

struct burnish_kernels {
    burnish_isa isa;

    burnish_lobe_function *lobe[BURNISH_LOBE_BODY_COUNT][BURNISH_LOBE_INPUT_COUNT];
    burnish_shade_function
        *shade[BURNISH_LOBE_BODY_COUNT][BURNISH_SHADE_GEOMETRY_COUNT][BURNISH_SHADE_OUTPUT_COUNT];

    /* The lighting of count points that have a material each; `points` has no diffuse. Reads and
     * writes whole vectors. */
    void (*shade_each[BURNISH_LOBE_BODY_COUNT])(const burnish_kernels_shader *shader,
                                                const burnish_kernels_points *points,
                                                const burnish_point_materials *materials,
                                                size_t count, float *const rgb[3]);

    /* The lighting of count points of the materials `materials`, as `shade` of each has it: directional lights
     * and a distant viewer. Every lobe is the family's of one order, or 0, or a composite with as
     * many products; the other bodies are NULL. Reads
     * and writes whole vectors. [1]: all materials have one lobe and specular colour. */
    void (*shade_mixed[BURNISH_LOBE_BODY_COUNT][2])(const burnish_kernels_shader *shaders,
                                                    const int32_t *materials,
                                                    const burnish_kernels_points *points,
                                                    size_t count, float *const rgb[3]);

    /* Adds light from many directions to the colours of count points, which `points` has without
     * diffuse colours. Reads and writes whole vectors. */
    void (*add_environment)(const burnish_environment_constants *constants,
                            const burnish_reflecting_material *material,
                            const burnish_kernels_points *points,
                            const burnish_reflecting_points *each, size_t count,
                            float *const rgb[3]);

    /* What a lobe of the material's roughness (with levels: of each point's) sees of distant light
     * along unit vectors; there are maps. Reads and writes whole vectors. */
    void (*see_environment)(const burnish_environment_constants *constants,
                            const burnish_reflecting_material *material,
                            const float *const direction[3], const float *roughness, size_t count,
                            float *const rgb[3]);

    /* The axes of the lobes of count points, unit vectors: R, for metallic-roughness moved toward N
     * by alpha^2. With a stretch: GGX's axis and stretch of burnish_light_lobes_near().
     *   roughness  NULL: the material's
     *   stretch    or NULL
     * Reads and writes whole vectors. */
    void (*reflect_points)(const burnish_environment_constants *constants,
                           const burnish_reflecting_material *material,
                           const burnish_kernels_points *points, const float *roughness,
                           size_t count, float *const axis[3], float *const stretch[3]);

    /* Scales the colours of count points by what sheen leaves of the light below it, and adds its own.
     *   white  with the frame's lights
     * Reads and writes whole vectors. */
    void (*lay_sheen)(const burnish_kernels_shader *white, const burnish_sheen_points *sheen,
                      const burnish_kernels_points *points, size_t count, float *const rgb[3]);

    /* The light of a polygon, as burnish_kernels_polygon_light() of burnish/kernels.h says. axes: not
     * NULL. */
    void (*polygon_light)(const burnish_polygon_constants *polygon,
                          const burnish_kernels_points *points, const burnish_kernels_axes *axes,
                          size_t count, float *const light[2]);

    /* out = in scaled to unit length; out may be in. */
    void (*normalize_array)(size_t count, const float *const in[3], float *const out[3]);
};
typedef burnish_kernels burnish_shading_ops;

/* The table of an instruction set; NULL if this build does not have it. */
const burnish_shading_ops *burnish_shading_ops_for(burnish_isa isa);

#endif
