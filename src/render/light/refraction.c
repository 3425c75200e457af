/* Paths of light through volumes. */
#include <string.h>

#include "base/elementary.h"
#include "core/vec3.h"
#include "render/light/ray_light.h"
#include "render/space.h"

/* Surfaces of volumes that a path meets. */
enum { SURFACES = 16 };

/* Longer than the mesh is wide, from anywhere near it. */
#define FAR 64.0f

/* Cosines of half the angle between a path's ends: from the first one on it goes straight on, up to the
 * second one it does not. As without rays (passing_simd.h). */
#define STRAIGHT 0.97
#define TURNED 0.8

/* From there on exp(-x) is 0 in single precision. */
#define DEEPEST 104.0

/* In the raster's space. */
typedef struct light_path {
    burnish_vec3 start, first, normal; /* where the volume is seen, from where, and its normal */
    burnish_vec3 at, along;
    double deep[3];                 /* logarithms of what is absorbed */
    uint16_t volumes[SURFACES + 1]; /* materials of those around it, the last one entered last */
    int depth;                      /* how many these are */
    int group;                      /* of four pixels */
    int is_seen, is_done;           /* is_seen: there is a path */
} light_path;

/* Turns a path at a surface, whose normal is against it: by refraction or, where that is more light, by
 * reflection. Returns whether it passes.
 *   ratio  of the refractive indices before and behind it */
static int turn_path(light_path *path, burnish_vec3 normal, double ratio) {
    const double c = -burnish_vec3_dot(path->along, normal);
    const double squared = 1 - ratio * ratio * (1 - c * c);
    const double inside = burnish_sqrt(squared > 0 ? squared : 0);
    const double across = (ratio * c - inside) / (ratio * c + inside);
    const double along = (ratio * inside - c) / (ratio * inside + c);
    const int passes = squared > 0 && across * across + along * along < 1;
    path->along = burnish_vec3_normalize(
        burnish_vec3_add(burnish_vec3_scale(path->along, passes ? ratio : 1),
                         burnish_vec3_scale(normal, passes ? ratio * c - inside : 2 * c)));
    return passes;
}

/* The refractive index of the innermost of `depth` volumes. */
static double index_in(const burnish_ray_light *light, const uint16_t *volumes, int depth) {
    const float index = depth ? light->textured[volumes[depth - 1]].material.refractive_index : 1;
    return index >= 1 ? (double)index : 1.5;
}

/* A surface's share of light passes, or a volume's along so many times its attenuation distance. */
static void absorb(light_path *path, const float color[3], double share, double times) {
    for (int k = 0; k < 3 && times > 0; ++k) {
        const double left = share * (double)color[k];
        path->deep[k] += left < 1 ? left > 0x1p-126 ? -times * burnish_log(left) : DEEPEST : 0;
    }
}

static void absorb_along(light_path *path, const burnish_ray_light *light, float length) {
    const size_t last = path->depth ? path->volumes[path->depth - 1] : 0;
    const burnish_material *material = &light->textured[last].material;
    if (path->depth && material->attenuation_distance > 0) {
        absorb(path, material->attenuation_color, 1,
               (double)length / ((double)light->scale * (double)material->attenuation_distance));
    }
}

/* Where a path would be behind a surface: in one volume more if it meets a front, or is in none; else in
 * one less, that of the surface's material if there is one. Returns how many. */
static int find_volumes(const light_path *path, uint16_t material, int is_back,
                        uint16_t volumes[SURFACES + 1]) {
    int left = path->depth - 1;
    memcpy(volumes, path->volumes, sizeof path->volumes);
    if (path->depth == 0 || !is_back) {
        volumes[path->depth] = material;
        return path->depth + 1;
    }
    for (int i = left; volumes[left] != material && i >= 0; --i) {
        left = volumes[i] == material ? i : left;
    }
    memmove(volumes + left, volumes + left + 1, (size_t)(SURFACES - left) * sizeof *volumes);
    return path->depth - 1;
}

/* Where the path goes on from a surface of a volume that its ray met. */
static void meet_volume(const burnish_ray_light *light, const burnish_started_rays *rays, size_t i,
                        light_path *path) {
    float position[3], smooth[3], plane[3];
    const size_t number = burnish_ray_met(rays, light->volumes, light, i, position, smooth, plane);
    const uint16_t *materials = light->solid->triangle_materials;
    const uint16_t own = materials ? materials[number] : 0;
    uint16_t volumes[SURFACES + 1];
    burnish_vec3 normal = burnish_vec3_loadf(smooth), face = burnish_vec3_loadf(plane);
    absorb_along(path, light, rays->distance[i]);
    const int depth =
        find_volumes(path, own, burnish_ray_met_back(rays, light->volumes, light, i), volumes);
    const burnish_material *material = &light->textured[own].material;
    normal = burnish_vec3_dot(normal, path->along) < 0 ? normal : face;
    const int passes =
        turn_path(path, normal,
                  index_in(light, path->volumes, path->depth) / index_in(light, volumes, depth));
    if (passes && depth > path->depth) {
        absorb(path, material->diffuse, (double)material->transmission, 1);
    }
    if (passes) {
        path->depth = depth;
        memcpy(path->volumes, volumes, sizeof volumes);
    }
    /* smooth normals lean away from the triangle, through which no path goes twice */
    const burnish_vec3 side = burnish_vec3_scale(face, passes ? -1 : 1);
    const double below = burnish_vec3_dot(path->along, side);
    path->along = below < 0 ? burnish_vec3_sub(path->along, burnish_vec3_scale(side, 2 * below))
                            : path->along;
    path->at = burnish_vec3_add(
        burnish_vec3_add(burnish_vec3_loadf(position), burnish_vec3_loadf(light->eye)),
        burnish_vec3_scale(side, (double)light->offset));
}

static void set_ray(burnish_started_rays *rays, size_t i, burnish_vec3 at, burnish_vec3 along,
                    float reach) {
    float from[3], to[3];
    burnish_space_store(at, from);
    burnish_space_store(along, to);
    for (int k = 0; k < 3; ++k) {
        rays->origin[k][i] = from[k];
        rays->direction[k][i] = to[k];
    }
    rays->reach[i] = reach;
}

static void find_hits(const burnish_ray_light *light, const burnish_ray_tree *tree,
                      burnish_started_rays *rays, size_t count) {
    rays->batch = (burnish_ray_batch){.reach = rays->reach, .count = count};
    for (int k = 0; k < 3; ++k) {
        rays->batch.origin[k] = rays->origin[k];
        rays->batch.direction[k] = rays->direction[k];
        for (size_t i = count; i % 16 != 0; ++i) { /* lanes that are not cast */
            rays->origin[k][i] = rays->origin[k][0];
            rays->direction[k][i] = rays->direction[k][0];
        }
    }
    memset(rays->reach + count, 0, (BURNISH_OCCLUDED_MAX - count) * sizeof *rays->reach);
    light->ops->find_hits(tree, &rays->batch, rays->hits, rays->distance, rays->place);
}

/* Adds what path `number` ends on to the tile's points. */
static void end_path(burnish_ray_tile *tile, const burnish_ray_light *light, size_t i,
                     size_t number) {
    float position[3], face[3], albedo[3];
    burnish_gathered_points *points = &tile->points;
    const size_t triangle =
        burnish_ray_met(&tile->rays, light->tree, light, i, position, NULL, face);
    const size_t to = points->count++;
    burnish_ray_albedo(light, triangle, 0, albedo);
    for (int k = 0; k < 3; ++k) {
        points->values[k][to] = position[k];
        points->values[3 + k][to] = points->values[6 + k][to] = face[k];
        points->albedo[k][to] = albedo[k];
    }
    points->values[BURNISH_RAY_GLOSS][to] = -1;
    points->from[to] = (uint16_t)number;
}

/* Follows paths to the next surface. Returns whether any goes on. */
static int follow_paths(burnish_ray_tile *tile, const burnish_ray_light *light, light_path *paths,
                        size_t count) {
    burnish_started_rays volumes;
    size_t from[BURNISH_OCCLUDED_MAX], rays = 0;
    for (size_t i = 0; i < count; ++i) {
        if (!paths[i].is_done) {
            set_ray(&volumes, rays, paths[i].at, paths[i].along, FAR);
            set_ray(&tile->rays, rays, paths[i].at, paths[i].along, FAR);
            from[rays++] = i;
        }
    }
    if (rays == 0) {
        return 0;
    }
    find_hits(light, light->volumes, &volumes, rays);
    for (size_t i = 0; i < rays; ++i) {
        tile->rays.reach[i] = volumes.hits[i] > 0 ? volumes.distance[i] : FAR;
    }
    find_hits(light, light->tree, &tile->rays, rays);
    for (size_t i = 0; i < rays; ++i) {
        light_path *path = &paths[from[i]];
        path->is_done = tile->rays.hits[i] > 0 || !(volumes.hits[i] > 0);
        if (tile->rays.hits[i] > 0) {
            absorb_along(path, light, tile->rays.distance[i]);
            end_path(tile, light, i, from[i]);
        } else if (!path->is_done) {
            meet_volume(light, &volumes, i, path);
        }
    }
    return 1;
}

/* Where a point lies, and from where path `number` sees it: from a quarter of its pixel. */
static light_path find_start(const burnish_ray_light *light, const burnish_kernels_points *points,
                             size_t i, int number) {
    const double w = points->w ? (double)points->w[i] : 1;
    const burnish_vec3 p = {(double)points->position[0][i] / w, (double)points->position[1][i] / w,
                            (double)points->position[2][i] / w};
    const burnish_vec3 right = burnish_vec3_loadf(light->pixels->ray_x),
                       up = burnish_vec3_loadf(light->pixels->ray_y);
    const burnish_vec3 forward = burnish_vec3_normalize(burnish_vec3_cross(up, right));
    const double depth = light->is_parallel ? 1 : burnish_vec3_dot(p, forward);
    const burnish_vec3 from =
        burnish_vec3_sub(burnish_vec3_scale(p, 1 / depth), burnish_vec3_loadf(light->pixels->ray));
    const double x = burnish_vec3_dot(from, right) / burnish_vec3_dot(right, right);
    const double y = burnish_vec3_dot(from, up) / burnish_vec3_dot(up, up);
    const burnish_vec3 shift =
        burnish_vec3_add(burnish_vec3_scale(right, number % 2 ? depth / 4 : -depth / 4),
                         burnish_vec3_scale(up, number / 2 ? depth / 4 : -depth / 4));
    const burnish_vec3 seen = burnish_vec3_add(p, shift);
    const int is_near = x > -0x1p20 && x < 0x1p20 && y > -0x1p20 && y < 0x1p20; /* else not shown */
    return (light_path){
        .start = burnish_vec3_add(seen, burnish_vec3_loadf(light->eye)),
        .first = light->is_parallel ? burnish_vec3_scale(burnish_vec3_loadf(light->viewer), -1)
                                    : burnish_vec3_normalize(seen),
        .normal = burnish_vec3_normalize((burnish_vec3){(double)points->normal[0][i],
                                                        (double)points->normal[1][i],
                                                        (double)points->normal[2][i]}),
        /* pixels' middles are at whole or half numbers */
        .group = is_near ? (int)(x + 0x1p20 + 0.25) % 2 + (int)(y + 0x1p20 + 0.25) % 2 * 2 : 0};
}

/* Moves starts to where rays through their quarters meet the surface, if they do near it. */
static void move_starts(burnish_ray_tile *tile, const burnish_ray_light *light, light_path *paths,
                        size_t count) {
    burnish_started_rays *rays = &tile->rays;
    for (size_t i = 0; i < count; ++i) {
        const burnish_vec3 back = burnish_vec3_scale(paths[i].first, (double)light->near);
        set_ray(rays, i, burnish_vec3_sub(paths[i].start, back), paths[i].first,
                paths[i].is_seen ? 2 * light->near : 0);
    }
    find_hits(light, light->volumes, rays, count);
    for (size_t i = 0; i < count; ++i) {
        float position[3], normal[3], face[3];
        if (rays->hits[i] > 0) {
            burnish_ray_met(rays, light->volumes, light, i, position, normal, face);
            paths[i].start =
                burnish_vec3_add(burnish_vec3_loadf(position), burnish_vec3_loadf(light->eye));
            paths[i].normal = burnish_vec3_loadf(normal);
        }
    }
}

/* How much a path that met nothing shows of what is straight behind: nothing where that is opaque. */
static void find_straight(burnish_ray_tile *tile, const burnish_ray_light *light,
                          const light_path *paths, size_t count, float *share) {
    for (size_t i = 0; i < count; ++i) {
        const double cosine = burnish_vec3_dot(paths[i].along, paths[i].first);
        const double half = burnish_sqrt(cosine > -1 ? 0.5 + 0.5 * cosine : 0);
        const double t = (half - TURNED) / (STRAIGHT - TURNED), part = t < 0 ? 0 : t < 1 ? t : 1;
        share[i] = (float)(part * part * (3 - 2 * part));
        set_ray(&tile->rays, i, paths[i].start, paths[i].first,
                paths[i].is_seen && share[i] > 0 ? FAR : 0);
    }
    find_hits(light, light->tree, &tile->rays, count);
    for (size_t i = 0; i < count; ++i) {
        share[i] = tile->rays.hits[i] > 0 ? 0 : share[i];
    }
}

static void enter_volume(const burnish_ray_light *light, const burnish_textured_material *material,
                         light_path *path) {
    path->volumes[0] = (uint16_t)(material - light->textured);
    path->depth = 1;
    path->along = path->first;
    if (burnish_vec3_dot(path->normal, path->first) > 0) { /* a smooth one, at the edge */
        path->normal = burnish_vec3_scale(path->first, -1);
    }
    path->is_done = !turn_path(path, path->normal, 1 / index_in(light, path->volumes, 1));
    path->at =
        burnish_vec3_sub(path->start, burnish_vec3_scale(path->normal, (double)light->offset));
}

void burnish_ray_refract(burnish_ray_tile *tile, const burnish_ray_light *light,
                         const burnish_render_ops *ops, const burnish_passing *points, size_t count,
                         int number, burnish_refracted *refracted) {
    light_path paths[BURNISH_OCCLUDED_MAX];
    burnish_gathered_points *met = &tile->points;
    for (size_t i = 0; i < count; ++i) {
        paths[i] = find_start(light, &points->points, i, number);
        paths[i].is_seen = points->facing[i] > 1;
    }
    if (!points->material->has_normals) {
        move_starts(tile, light, paths, count);
    }
    memset(refracted, 0, sizeof *refracted);  /* also lanes beyond the points */
    for (int group = 0; group < 4; ++group) { /* each has a quarter of the patterns */
        met->count = met->has_gloss = 0;
        for (size_t i = 0; i < count; ++i) {
            if (paths[i].group == group) {
                enter_volume(light, points->material, &paths[i]);
            }
            paths[i].is_done |= paths[i].group != group || !paths[i].is_seen;
        }
        for (int i = 0; i < SURFACES && follow_paths(tile, light, paths, count); ++i) {
        }
        if (met->count > 0) {
            burnish_ray_shine(tile, light, ops, BURNISH_RAY_PATHS * group + number);
        }
        for (size_t i = 0; i < met->count; ++i) {
            refracted->has_met[met->from[i]] = 1;
            for (int k = 0; k < 3; ++k) {
                refracted->light[k][met->from[i]] = met->light[k][i];
            }
        }
    }
    find_straight(tile, light, paths, count, refracted->straight);
    for (size_t i = 0; i < 3 * count; ++i) {
        const double deep = paths[i / 3].deep[i % 3];
        float to[3];
        burnish_space_store(paths[i / 3].along, to);
        refracted->left[i % 3][i / 3] = (float)(deep < DEEPEST ? burnish_expm1(-deep) + 1 : 0);
        refracted->to[i % 3][i / 3] = to[i % 3];
    }
}
