/* What kernels read: a lobe, and a whole lighting, with everything worked out that does not depend
 * on the point. */
#ifndef BURNISH_SHADING_SHADER_H
#define BURNISH_SHADING_SHADER_H

#include <stdint.h>

#include "burnish/kernels.h"
#include "shading/light_map.h"

/* The bodies that lobes are evaluated by. */
typedef enum burnish_lobe_body {
    BURNISH_LOBE_BODY_NONE,    /* 0 */
    BURNISH_LOBE_BODY_SQUARE,  /* the family, m = 2 */
    BURNISH_LOBE_BODY_SQUARES, /* the family, m = 4 .. 32 */
    BURNISH_LOBE_BODY_COMPOSITE,
    BURNISH_LOBE_BODY_POWER,    /* any exponent, by polynomials */
    BURNISH_LOBE_BODY_MULTIPLY, /* whole exponents, by multiplications */
    BURNISH_LOBE_BODY_SCHLICK,
    BURNISH_LOBE_BODY_GAUSSIAN,
    BURNISH_LOBE_BODY_GX,
    BURNISH_LOBE_BODY_COUNT
} burnish_lobe_body;

enum { BURNISH_LOBE_INPUT_COSINE, BURNISH_LOBE_INPUT_LAMBDA, BURNISH_LOBE_INPUT_COUNT };

/* DISTANT: every light directional, the viewer distant and Blinn's cosine: the half vectors are
 * constant. GENERAL: anything. */
enum { BURNISH_SHADE_DISTANT, BURNISH_SHADE_GENERAL, BURNISH_SHADE_GEOMETRY_COUNT };

enum { BURNISH_SHADE_RGBA8, BURNISH_SHADE_FLOAT, BURNISH_SHADE_OUTPUT_COUNT };

typedef struct burnish_lobe_constants {
    int body;        /* burnish_lobe_body */
    int squarings;   /* family: log2 of the order; composites: products of the base */
    float zeta;      /* slope of the base, of family and composites */
    float top;       /* value of the base at the peak: 1 for the family */
    float offset[4]; /* composites: of each product after the first */
    float exponent;  /* n */
    float slope;     /* factor in an exponent or denominator */
    float least;     /* MULTIPLY: the cosine up to which cos^n is below 2^-126 */
    uint32_t whole;  /* MULTIPLY: n */
} burnish_lobe_constants;

/* A light: colours times material, for results in [0, 255] and in [0, 1] (BURNISH_SHADE_...). */
typedef struct burnish_light_constants {
    int is_point, is_lessened;             /* is_lessened: one of the next four is not 0 */
    float squared_distance, squared_range; /* burnish_light's */
    float cone_scale, cone_offset;         /* t is linear in a cosine; scale 0: no cone */
    float to_light[3];                     /* against the cone's axis */
    float vector[3];
    float half[3]; /* of a distant light and viewer: H, zeta H for lobes with a base */
    float diffuse[2][3], specular[2][3];
} burnish_light_constants;

struct burnish_kernels_shader {
    const burnish_context *context; /* whose memory it is */
    const burnish_light_constants *lights;
    int light_count;
    int geometry; /* which kernel: BURNISH_SHADE_DISTANT or GENERAL */
    int phong, lyon, local_viewer, needs_position;
    float offset; /* base of the lobe at cosine 0: 1 - zeta for the family */
    float cutoff; /* cosines below it are surely dark; -1 where there are none */
    float viewer[3];
    float ambient[2][3];
    float albedo[3]; /* of light that arrives by way of other surfaces; the renderer sets it */
    burnish_lobe_constants lobe;
};

/* ---- Points with a material of their own ---- */

/* Tables of lobes: entry i is for the exponent 2^(i / BURNISH_EACH_STEPS). */
enum { BURNISH_EACH_STEPS = 4, BURNISH_EACH_TABLE = 16 * BURNISH_EACH_STEPS + 2 };

/* Coefficients of points, arrays as burnish_kernels_points has them; the shader's own material is
 * white. */
typedef struct burnish_point_materials {
    const float *ambient[3], *diffuse[3], *specular[3];
    const float *exponent;
    const float *slopes, *scales; /* family: zeta / n, and the value at the peak */
    float least_exponent;         /* smaller ones are taken as it */
} burnish_point_materials;

/* ---- Light from many directions (burnish/light.h) ---- */

/* What all materials share. */
typedef struct burnish_environment_constants {
    int local_viewer;
    float viewer[3];  /* as burnish_kernels_shader has it */
    float axes[3][3]; /* of the maps, in the points' space */
    float nearness; /* 1 / distance of what maps show from the object's middle; 0: infinitely far */
    float offset[3]; /* from the object's middle to the origin of positions, times nearness */
    const burnish_light_map *diffuse; /* NULL: no light comes from maps */
} burnish_environment_constants;

typedef struct burnish_reflecting_material {
    float diffuse[3], reflectance[3], roughness; /* kd, F0, sqrt(alpha) */
    float edge_loss;                             /* 1 - F90 */
    int reflects;                                /* 0: only kd */
    int is_metallic;                   /* 1: metallic-roughness: kd is what is not reflected */
    int has_levels;                    /* 1: `specular` is BURNISH_LIGHT_LEVELS maps */
    const burnish_light_map *specular; /* read where there are maps and it reflects */
} burnish_reflecting_material;

/* Arrays of points that differ from their material; NULL: they do not. */
typedef struct burnish_reflecting_points {
    const float *diffuse[3]; /* factors */
    const float *reflectance[3], *roughness, *edge_loss;
    const float *bent[3]; /* unit vectors that directions are mirrored at instead of N */
    const float *open;    /* share of the light that arrives */
    const float *near_diffuse[3], *near_specular[3]; /* light of near lights: added to D and Spec */
    /* of Spec what nothing hides, what is seen instead, and light of which metals reflect their colour */
    const float *clear, *mirrored[3], *around[3];
} burnish_reflecting_points;

/* Sheen (sheen_simd.h) of points. Arrays may be NULL. */
typedef struct burnish_sheen_points {
    float color[3], roughness;
    const float *each[4]; /* factors of color and roughness */
    const float *wide[3]; /* light from many directions, as white has it */
    const float *open;    /* share of the light from many directions that arrives */
} burnish_sheen_points;

/* ---- Folding ---- */

/* Fills *constants, and *scale with the value at the peak. Returns OK or ARGUMENT, with a line. */
burnish_status burnish_lobe_constants_make(const burnish_lobe_spec *lobe, float exponent,
                                           burnish_lobe_constants *constants, float *scale,
                                           burnish_error *error);

/* Checks what all materials share: lights, viewer, specular model, cookie. Errors: ARGUMENT. */
burnish_status burnish_lighting_check(const burnish_kernels_lighting *lighting,
                                      burnish_error *error);

/* Checks a material and its lobe and folds them with a checked lighting, whose own material and
 * lobe are not read. lights has room for lighting->light_count and must live as long as the shader.
 * Errors: ARGUMENT. */
burnish_status burnish_shader_fold(const burnish_kernels_lighting *lighting,
                                   const burnish_material *material, const burnish_lobe_spec *lobe,
                                   burnish_light_constants *lights, burnish_kernels_shader *shader,
                                   burnish_error *error);

#endif
