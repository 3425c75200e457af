/* The mesh of a frame, and the raster's space: the mesh is moved and scaled to fill the unit
 * sphere. */
#ifndef BURNISH_RENDER_SPACE_H
#define BURNISH_RENDER_SPACE_H

#include "burnish/mesh.h"
#include "core/vec3.h"

/* How a point of the screen becomes one of space. What is visible at (x, y), in pixels from the
 * image's centre, right and up, lies from the eye at
 *   (ray + x ray_x + y ray_y + (1 - depth) ray_depth) / q,
 *   q = depth * q_per_depth + q_constant (1/w in perspective, 1 in parallel projection). */
typedef struct burnish_rays {
    float ray[3], ray_x[3], ray_y[3], ray_depth[3];
    float q_per_depth, q_constant;
} burnish_rays;

/* Points of the screen: (x + x_offset[i], y + y_offset[i]) with the depth of what they show. */
typedef struct burnish_screen_points {
    float x, y;
    const float *x_offset, *y_offset, *depth;
} burnish_screen_points;

/* Triangles, or points of a cloud. */
static inline size_t burnish_drawn_count(const burnish_mesh_view *mesh) {
    return mesh->point_radius > 0 ? mesh->vertex_count : mesh->triangle_count;
}

/* The middle of the mesh, rounded to floats: what the raster subtracts from positions. */
static inline burnish_vec3 burnish_space_center(const burnish_mesh_view *mesh) {
    float center[3];
    for (int i = 0; i < 3; ++i) {
        center[i] = (float)(((double)mesh->bounds_min[i] + mesh->bounds_max[i]) * 0.5);
    }
    return burnish_vec3_loadf(center);
}

/* Units of the raster's space per unit of the mesh. */
static inline double burnish_space_scale(const burnish_mesh_view *mesh) {
    const burnish_vec3 low = burnish_vec3_loadf(mesh->bounds_min);
    const burnish_vec3 high = burnish_vec3_loadf(mesh->bounds_max);
    const double half_diagonal = burnish_vec3_length(burnish_vec3_sub(high, low)) * 0.5;
    return half_diagonal > 0 ? 1 / half_diagonal : 1;
}

/* A unit vector across v. */
static inline burnish_vec3 burnish_space_across(burnish_vec3 v) {
    const int x_is_least = v.x * v.x <= v.y * v.y && v.x * v.x <= v.z * v.z;
    const burnish_vec3 other = x_is_least ? (burnish_vec3){1, 0, 0} : (burnish_vec3){0, 1, 0};
    return burnish_vec3_normalize(burnish_vec3_cross(other, v));
}

static inline void burnish_space_store(burnish_vec3 v, float out[3]) {
    out[0] = (float)v.x;
    out[1] = (float)v.y;
    out[2] = (float)v.z;
}

/* From a depth of the raster to the distance along the view axis, in the mesh's units:
 * (constant + (1 - depth) slope) / q, q as burnish_rays has it. */
typedef struct burnish_view_distance {
    float constant, slope;
} burnish_view_distance;

/* The clear coat of a material, as a material of its own. */
typedef struct burnish_coat {
    burnish_material material;
    size_t base; /* the number of the material below it */
} burnish_coat;

typedef struct burnish_drawn_mesh {
    const burnish_mesh *mesh;      /* for its materials and textures */
    const burnish_mesh_view *view; /* of the mesh */
    size_t material_count;
    int ignore_colors; /* 1: as if its vertices had no colours */
    const burnish_coat *coats;
    size_t coat_count; /* their numbers follow the mesh's materials */
} burnish_drawn_mesh;

/* A material of the mesh, or a coat. */
static inline const burnish_material *burnish_drawn_material(const burnish_drawn_mesh *mesh,
                                                             size_t number) {
    return number < mesh->material_count ? burnish_mesh_get_material(mesh->mesh, number)
                                         : &mesh->coats[number - mesh->material_count].material;
}

#endif
