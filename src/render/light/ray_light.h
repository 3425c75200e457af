/* Occlusion, shadows and light that bounces by rays. Each pixel casts a few to the sky and to each area
 * light, neighbours others, and what a point sees is the mean over the pixels around it whose surface is
 * its own: so a picture has no noise that changes. Rays find shares of light, whose amount is known
 * without them, and what surfaces that they meet send back. */
#ifndef BURNISH_RENDER_LIGHT_RAY_LIGHT_H
#define BURNISH_RENDER_LIGHT_RAY_LIGHT_H

#include "burnish/light.h"
#include "burnish/mesh.h"
#include "raster/tile.h"
#include "rays/rays.h"
#include "render/light/area.h"
#include "render/light/maps/occlusion_share.h"
#include "render/render_ops.h"
#include "shading/shader.h"

enum {
    BURNISH_RAY_SAMPLES = 4,                     /* of a pixel */
    BURNISH_RAY_PATTERNS = BURNISH_BLOCK_PIXELS, /* one per pixel of a block */
    BURNISH_RAY_DIRECTIONS = BURNISH_RAY_SAMPLES * BURNISH_RAY_PATTERNS, /* of these */
    BURNISH_RAY_DIRECTIONS_MAX = 4 * BURNISH_RAY_DIRECTIONS,             /* of the ground */
    BURNISH_RAY_LIGHT_EDGE = 16,                                         /* of the table of light */
    BURNISH_RAY_MARGIN = 2, /* pixels around a tile that count for its own */
    BURNISH_RAY_EDGE = BURNISH_TILE_SIZE + 2 * BURNISH_RAY_MARGIN,
    BURNISH_RAY_PIXELS = BURNISH_RAY_EDGE * BURNISH_RAY_EDGE,
    BURNISH_RAY_BOUNCES = 2 /* that are followed */
};

/* A light that rays look for, in the raster's space; of a distant one, from everywhere. */
typedef struct burnish_ray_lamp {
    burnish_area_shape shape;
    int is_distant, is_two_sided;
    float center[3], half[2][3], radius; /* of a sphere or line */
    float strength; /* luminance times 4 or pi, for the area of the sides' product, by pi */
} burnish_ray_lamp;

/* A frame's. */
typedef struct burnish_ray_light {
    const burnish_ray_tree *tree;    /* of what is opaque */
    const burnish_ray_tree *volumes; /* that refract; NULL: none */
    const burnish_ray_ops *ops;
    const burnish_mesh_view *mesh;             /* that is drawn, with the ids of the raster */
    const burnish_mesh_view *solid;            /* of whose triangles the tree's are the first */
    const burnish_kernels_shader *shaders;     /* one per material */
    const burnish_area_material *reflecting;   /* the same; NULL: nothing is mirrored */
    const burnish_textured_material *textured; /* the same; read where there are volumes */
    const burnish_rays *pixels;                /* from the camera */
    int is_parallel;        /* 1: all rays from the camera come from the viewer */
    float viewer[3];        /* toward it */
    int has_colors;         /* 1: vertices have some */
    float center[3], scale; /* (position - center) scale is in the raster's space */
    float eye[3];           /* the camera, in the raster's space */
    float offset;           /* off a surface's triangle */
    float near;             /* points so far from a point's plane are of another surface */
    int has_sky;            /* 0: only shadows of lamps are wanted */
    float mean, tint[3];    /* luminance and colour of the light on white that is seen */
    float ambient[3];       /* light, which metals mirror as what comes from everywhere */
    float sky_mean;         /* luminance of the light from all directions without lamps */
    /* across, across and along a normal: evenly by cosine, all of them, a pattern's, and those of the
     * first patterns */
    float directions[BURNISH_RAY_DIRECTIONS_MAX][3];
    /* GGX's normals: across, for alpha 1, where they are 1 along */
    float lobe[BURNISH_RAY_DIRECTIONS_MAX][2];
    /* what arrives from directions without lamps, and its weights in what is hidden, nowhere 0: rows of
     * an octahedron that is folded out, whose corners are at those of the table */
    float sky[BURNISH_RAY_LIGHT_EDGE * BURNISH_RAY_LIGHT_EDGE];
    float light[BURNISH_RAY_LIGHT_EDGE * BURNISH_RAY_LIGHT_EDGE];
    /* where rays meet lamps: evenly over a square and a disc, in its half sides */
    float places[2][BURNISH_RAY_DIRECTIONS_MAX][2];
    burnish_ray_lamp lamps[BURNISH_AREA_LIGHT_MAX + 1 /* and a directional one */];
    int lamp_count, key; /* the lamp whose shadow is kept apart, or -1 */
    int mirrored_lamps;  /* so many of the first are seen in metals */
} burnish_ray_light;

/* Direction i of the table of light, a unit vector. */
burnish_vec3 burnish_ray_light_direction(int i);

/* Points that cast rays: from the eye, unit normals, and the normals of their triangles. */
typedef struct burnish_ray_points {
    const float *position[3], *normal[3], *face[3];
    /* alpha, below 0 of matt ones, and vectors against the rays that came; NULL: all are matt */
    const float *gloss, *back[3];
    size_t count; /* at most BURNISH_OCCLUDED_MAX, readable up to the next multiple of 16 */
    int lamps;    /* number of lamps that glossy points mirror */
} burnish_ray_points;

/* Rays of points, from off their triangles, and what they met. */
typedef struct burnish_started_rays {
    float origin[3][BURNISH_OCCLUDED_MAX], direction[3][BURNISH_OCCLUDED_MAX];
    float reach[BURNISH_OCCLUDED_MAX], light[BURNISH_OCCLUDED_MAX], hits[BURNISH_OCCLUDED_MAX];
    float distance[BURNISH_OCCLUDED_MAX]; /* of the nearest hit, if it is wanted */
    int32_t place[BURNISH_OCCLUDED_MAX];  /* its triangle's in the tree */
    burnish_ray_batch batch;
} burnish_started_rays;

/* Values of points: position, normal, face, then */
enum { BURNISH_RAY_GLOSS = 9, BURNISH_RAY_BACK = 10, BURNISH_RAY_VALUES = 13 };

/* Points that are brought together to cast rays. */
typedef struct burnish_gathered_points {
    float values[BURNISH_RAY_VALUES][BURNISH_OCCLUDED_MAX + 16]; /* burnish_ray_points' */
    float sums[3][BURNISH_OCCLUDED_MAX + 16];                    /* what the rays' kernel wrote */
    float light[3][BURNISH_OCCLUDED_MAX];  /* that comes over other surfaces */
    float met[3][BURNISH_OCCLUDED_MAX];    /* albedos of these, added up */
    float albedo[3][BURNISH_OCCLUDED_MAX]; /* of points on surfaces that rays have met */
    uint16_t from[BURNISH_OCCLUDED_MAX];   /* whose points they are */
    size_t count;
    int has_gloss; /* 0: all are matt */
} burnish_gathered_points;

/* What rays of a point found. Mirrored: the albedos of what they met, how many there are, how many of these
 * met any, how many are of metals, then what is sent and the albedos once more. Light that comes over other
 * surfaces, in the mean light's colour. Of the sky and of each lamp, all light, and what is hidden of it. */
enum {
    BURNISH_RAY_MIRRORED,
    BURNISH_RAY_GLOSSY = 3,
    BURNISH_RAY_MET,
    BURNISH_RAY_METALS,
    BURNISH_RAY_SENT,
    BURNISH_RAY_BOUNCED = BURNISH_RAY_SENT + 6,
    BURNISH_RAY_SKY = BURNISH_RAY_BOUNCED + 3,
    BURNISH_RAY_LAMPS = BURNISH_RAY_SKY + 2,
    BURNISH_RAY_LAMPS_MAX = BURNISH_AREA_LIGHT_MAX + 1, /* and a directional one */
    BURNISH_RAY_SUMS = BURNISH_RAY_LAMPS + 2 * BURNISH_RAY_LAMPS_MAX
};

_Static_assert((int)BURNISH_RAY_LAMPS_MAX + 2 <= 16, "bits of burnish_ray_tile.mixed");

/* The pixels of a tile and a margin, row after row. */
typedef struct burnish_ray_tile {
    float position[3][BURNISH_RAY_PIXELS], normal[3][BURNISH_RAY_PIXELS];
    float face[3][BURNISH_RAY_PIXELS];
    float sums[BURNISH_RAY_SUMS][BURNISH_RAY_PIXELS];
    float gloss[BURNISH_RAY_PIXELS]; /* alpha of GGX by which it mirrors; below 0: it does not */
    uint8_t is_metal[BURNISH_RAY_PIXELS];
    uint16_t rank[BURNISH_RAY_PIXELS]; /* of the point that stands for the pixel; 0: none */
    uint16_t cut[BURNISH_RAY_PIXELS];  /* bit i: some rays to lamp i are not in its light */
    /* Bits of rays of which there are more: to lamp i, as some of the block did not agree; then mirrored
     * ones that did not agree; then those to the sky, of which most is hidden. */
    uint16_t mixed[BURNISH_RAY_PIXELS];
    /* bit i: nor did these to lamp i with its neighbours', so that there are those of all patterns */
    uint16_t rough[BURNISH_RAY_PIXELS];
    uint16_t refracted[BURNISH_TILE_PIXELS]; /* bits of samples whose first volume has been seen */
    burnish_gathered_points points, met[BURNISH_RAY_BOUNCES]; /* scratch */
    burnish_started_rays rays;
} burnish_ray_tile;

/* Normals of one surface differ by less than this cosine's angle, 26 degrees. */
#define BURNISH_RAY_ALIKE 0.9f

/* Where the sums of a lamp are; -1: of the sky. */
static inline int burnish_ray_sums(int lamp) {
    return BURNISH_RAY_LAMPS + 2 * lamp;
}

/* The share of a lamp that is hidden from a pixel, or of what it mirrors that is the object. */
static inline float burnish_ray_share(const burnish_ray_tile *tile, int at, int sums) {
    return tile->sums[sums][at] > 0 ? tile->sums[sums + 1][at] / tile->sums[sums][at] : 0;
}

/* Where the pixel is that is so many to the right of and below the tile's first. */
static inline int burnish_ray_place(int x, int y) {
    return (y + BURNISH_RAY_MARGIN) * BURNISH_RAY_EDGE + x + BURNISH_RAY_MARGIN;
}

/* The rank of a fragment: the one of the most samples stands for a pixel, of equals the first sample's.
 */
static inline uint16_t burnish_ray_rank(unsigned samples) {
    return (uint16_t)(__builtin_popcount(samples) * 16 + 15 - __builtin_ctz(samples));
}

/* A point of the pixel at a place, unless one of a higher rank stands for it.
 *   normal  of any length; triangle: burnish_primitive.id_and_facing, or UINT32_MAX for a cap */
void burnish_ray_tile_add(burnish_ray_tile *tile, const burnish_ray_light *light, int at,
                          uint16_t rank, const float position[3], const float normal[3],
                          uint32_t triangle);

/* Adds the pixels around a tile that count for its own: rays from the camera find them. */
void burnish_ray_tile_add_margin(burnish_ray_tile *tile, const burnish_ray_light *light,
                                 const burnish_rays *from, const burnish_tile *place,
                                 const burnish_raster_view *view);

/* Casts the rays of all pixels. */
void burnish_ray_tile_cast(burnish_ray_tile *tile, const burnish_ray_light *light,
                           const burnish_render_ops *ops);

/* Writes what points see to scratch->open, and of the lamp that is kept apart to lit. Points that no
 * pixel around stands for get what all of these found, those of layers see all. */
void burnish_ray_tile_look(const burnish_ray_tile *tile, const burnish_ray_light *light,
                           const burnish_render_ops *ops, const burnish_share_points *points,
                           int count, burnish_share_scratch *scratch, float *lit);

/* Where ray i met a triangle of a tree: from the eye, the normal there, unless it is NULL, and the
 * triangle's, both toward the ray's start. Returns the triangle's number. */
size_t burnish_ray_met(const burnish_started_rays *rays, const burnish_ray_tree *tree,
                       const burnish_ray_light *light, size_t i, float position[3], float *normal,
                       float face[3]);

/* Whether it met the triangle's back. */
int burnish_ray_met_back(const burnish_started_rays *rays, const burnish_ray_tree *tree,
                         const burnish_ray_light *light, size_t i);

/* What the surface of a triangle of the mesh reflects. Pieces of masked ones are gray. Returns its
 * gloss: matt surfaces see all as matt, for few rays find what others mirror. */
float burnish_ray_albedo(const burnish_ray_light *light, size_t triangle, int is_mirrored,
                         float albedo[3]);

/* Writes to the tile's points' light what these matt points send, by rays of pattern `pattern` to the sky
 * and to each lamp. */
void burnish_ray_shine(burnish_ray_tile *tile, const burnish_ray_light *light,
                       const burnish_render_ops *ops, int pattern);

/* ---- Refraction (refraction.c) ---- */

/* Paths through volumes of a pixel, from its quarters. */
enum { BURNISH_RAY_PATHS = 4 };

/* What is seen along one path from each point of a volume. */
typedef struct burnish_refracted {
    uint8_t has_met[BURNISH_OCCLUDED_MAX]; /* 1: the path ends on an opaque surface */
    float light[3][BURNISH_OCCLUDED_MAX];  /* of that */
    float to[3][BURNISH_OCCLUDED_MAX];     /* otherwise: where it goes, a unit vector */
    float straight[BURNISH_OCCLUDED_MAX];  /* share of what is straight behind */
    float left[3][BURNISH_OCCLUDED_MAX];   /* by what is absorbed on the way */
} burnish_refracted;

/* Follows path `number` of points through all volumes, over 16 surfaces. Only those have one whose
 * facing is above 1. */
void burnish_ray_refract(burnish_ray_tile *tile, const burnish_ray_light *light,
                         const burnish_render_ops *ops, const burnish_passing *points, size_t count,
                         int number, burnish_refracted *refracted);

/* Sets directions and places. */
void burnish_ray_light_prepare(burnish_ray_light *light);

/* Adds a lamp, which is in the raster's space. */
void burnish_ray_light_add(burnish_ray_light *light, const burnish_area_light *lamp);

#endif
