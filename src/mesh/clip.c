/* Cutting a mesh by a plane.
 *
 * A cut point depends only on the two ends of its edge, starting from the end that is kept. Both
 * triangles of an edge therefore get the same bits, and no gap opens between them. No triangles
 * close the cut: drawing fills it (render/frame/caps.h). */
#include <string.h>

#include "base/numbers.h"
#include "core/srgb.h"
#include "core/vec3.h"
#include "mesh/data/mesh.h"

/* Of a solid's volume: what gaps may change of it. */
#define GAP_TOLERANCE 0.01

/* The result of the cut. */
typedef struct cutter {
    const burnish_mesh *mesh;
    burnish_clip_plane plane;
    uint32_t *numbers; /* of the vertices that are kept, then of where they go */
    void *attributes[BURNISH_ATTRIBUTE_COUNT];
    uint32_t *indices;
    uint16_t *triangle_materials, *triangle_parts;
    size_t vertex_count, triangle_count;
    int cuts_something; /* 1: a corner is beyond the plane */
} cutter;

/* > 0 beyond the plane, times the length of its normal. */
static double distance_of(const cutter *cut, uint32_t vertex) {
    const float *p = cut->mesh->view.positions + 3 * (size_t)vertex;
    const double *n = cut->plane.normal;
    return (n[0] * (double)p[0] + n[1] * (double)p[1] + n[2] * (double)p[2]) - cut->plane.offset;
}

/* Bit k: corner k is kept. A triangle that only touches the plane from beyond is dropped. */
static unsigned kept_corners(const cutter *cut, const uint32_t v[3]) {
    unsigned kept = 0, inside = 0;
    for (int k = 0; k < 3; ++k) {
        const double distance = distance_of(cut, v[k]);
        kept |= (unsigned)(distance <= 0) << k;
        inside |= distance < 0;
    }
    return inside || kept == 7 ? kept : 0;
}

/* Upper bounds for the triangles and vertices of the result; marks the vertices that are kept. */
static void count_parts(cutter *cut, size_t *triangles, size_t *vertices) {
    const burnish_mesh_view *view = &cut->mesh->view;
    *triangles = *vertices = 0;
    for (size_t i = 0; i < view->triangle_count; ++i) {
        const uint32_t *v = view->indices + 3 * i;
        const unsigned kept = kept_corners(cut, v);
        *triangles += kept == 0 ? 0 : (size_t)(__builtin_popcount(kept) == 2) + 1;
        *vertices += kept == 0 || kept == 7 ? 0 : 2;
        cut->cuts_something |= kept != 7;
        for (int k = 0; k < 3; ++k) {
            cut->numbers[v[k]] |= kept >> k & 1;
        }
    }
    for (size_t i = 0; i < view->vertex_count; ++i) {
        *vertices += cut->numbers[i];
    }
}

/* ---- Vertices ---- */

static void copy_vertices(cutter *cut) {
    const burnish_mesh *mesh = cut->mesh;
    for (size_t i = 0; i < mesh->view.vertex_count; ++i) {
        if (!cut->numbers[i]) {
            continue;
        }
        const size_t to = cut->vertex_count++;
        for (int a = 0; a < BURNISH_ATTRIBUTE_COUNT; ++a) {
            const size_t size = burnish_attribute_size((burnish_attribute)a);
            if (mesh->attributes[a]) {
                memcpy((char *)cut->attributes[a] + to * size,
                       (const char *)mesh->attributes[a] + i * size, size);
            }
        }
        cut->numbers[i] = (uint32_t)to;
    }
}

/* Interpolates `count` numbers between a and b. */
static void mix_values(const float *a, const float *b, double t, int count, float *out) {
    for (int k = 0; k < count; ++k) {
        out[k] = (float)((double)a[k] + ((double)b[k] - (double)a[k]) * t);
    }
}

static void mix_colors(const uint8_t *a, const uint8_t *b, double t, uint8_t *out) {
    for (int k = 0; k < 3; ++k) {
        const double from = (double)burnish_srgb_to_linear[a[k]];
        const double to = (double)burnish_srgb_to_linear[b[k]];
        out[k] = burnish_linear_to_srgb((float)(from + (to - from) * t));
    }
    out[3] = (uint8_t)((double)a[3] + ((double)b[3] - (double)a[3]) * t + 0.5);
}

/* Opposite normals have no middle: the normal of the kept end is used. */
static void mix_normals(const float *a, const float *b, double t, float *out) {
    mix_values(a, b, t, 3, out);
    const burnish_vec3 sum = burnish_vec3_loadf(out);
    const double length = burnish_vec3_length(sum);
    const burnish_vec3 unit =
        length > 1e-6 ? burnish_vec3_scale(sum, 1 / length) : burnish_vec3_loadf(a);
    out[0] = (float)unit.x;
    out[1] = (float)unit.y;
    out[2] = (float)unit.z;
}

/* The point at which an edge from a kept vertex crosses the plane. */
static uint32_t add_cut_point(cutter *cut, uint32_t kept, uint32_t beyond) {
    const burnish_mesh_view *view = &cut->mesh->view;
    const double from = distance_of(cut, kept), to = distance_of(cut, beyond);
    const double t = from / (from - to); /* [0, 1) */
    const size_t a = kept, b = beyond, at = cut->vertex_count++;
    mix_values(view->positions + 3 * a, view->positions + 3 * b, t, 3,
               (float *)cut->attributes[BURNISH_POSITION] + 3 * at);
    mix_normals(view->normals + 3 * a, view->normals + 3 * b, t,
                (float *)cut->attributes[BURNISH_NORMAL] + 3 * at);
    if (view->colors) {
        mix_colors(view->colors + 4 * a, view->colors + 4 * b, t,
                   (uint8_t *)cut->attributes[BURNISH_COLOR] + 4 * at);
    }
    if (view->texture_coordinates) {
        mix_values(view->texture_coordinates + 2 * a, view->texture_coordinates + 2 * b, t, 2,
                   (float *)cut->attributes[BURNISH_TEXCOORD] + 2 * at);
    }
    if (view->second_coordinates) {
        mix_values(view->second_coordinates + 2 * a, view->second_coordinates + 2 * b, t, 2,
                   (float *)cut->attributes[BURNISH_TEXCOORD2] + 2 * at);
    }
    if (view->tangents) { /* both ends have one sign: a mirrored seam has two vertices */
        float *tangent = (float *)cut->attributes[BURNISH_TANGENT] + 4 * at;
        mix_normals(view->tangents + 4 * a, view->tangents + 4 * b, t, tangent);
        tangent[3] = view->tangents[4 * a + 3];
    }
    return (uint32_t)at;
}

/* ---- Triangles ---- */

static int same_position(const cutter *cut, uint32_t a, uint32_t b) {
    const float *p = (const float *)cut->attributes[BURNISH_POSITION] + 3 * (size_t)a;
    const float *q = (const float *)cut->attributes[BURNISH_POSITION] + 3 * (size_t)b;
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

/* The material and part of triangle `at`, which is one of `source` or a piece of it. */
static void copy_marks(cutter *cut, size_t at, size_t source) {
    if (cut->triangle_materials) {
        cut->triangle_materials[at] = cut->mesh->view.triangle_materials[source];
    }
    if (cut->triangle_parts) {
        cut->triangle_parts[at] = cut->mesh->view.triangle_parts[source];
    }
}

/* Part of triangle `source`, unless two corners coincide because a corner is in the plane. */
static void add_triangle(cutter *cut, size_t source, uint32_t a, uint32_t b, uint32_t c) {
    if (same_position(cut, a, b) || same_position(cut, b, c) || same_position(cut, c, a)) {
        return;
    }
    const size_t at = cut->triangle_count++;
    cut->indices[3 * at] = a;
    cut->indices[3 * at + 1] = b;
    cut->indices[3 * at + 2] = c;
    copy_marks(cut, at, source);
}

static void cut_triangle(cutter *cut, size_t source, unsigned kept) {
    const uint32_t *v = cut->mesh->view.indices + 3 * source;
    const uint32_t *numbers = cut->numbers;
    const int is_pair = __builtin_popcount(kept) == 2;
    /* the corner that is alone on its side, and those after it */
    const int first = __builtin_ctz(is_pair ? ~kept : kept);
    const uint32_t alone = v[first], second = v[(first + 1) % 3], third = v[(first + 2) % 3];
    if (is_pair) {
        const uint32_t p = add_cut_point(cut, second, alone), q = add_cut_point(cut, third, alone);
        add_triangle(cut, source, p, numbers[second], numbers[third]);
        add_triangle(cut, source, p, numbers[third], q);
    } else {
        const uint32_t p = add_cut_point(cut, alone, second), q = add_cut_point(cut, alone, third);
        add_triangle(cut, source, numbers[alone], p, q);
    }
}

static void cut_triangles(cutter *cut) {
    const burnish_mesh_view *view = &cut->mesh->view;
    for (size_t i = 0; i < view->triangle_count; ++i) {
        const uint32_t *v = view->indices + 3 * i;
        const unsigned kept = kept_corners(cut, v);
        if (kept == 7) {
            const size_t at = cut->triangle_count++;
            for (size_t k = 0; k < 3; ++k) {
                cut->indices[3 * at + k] = cut->numbers[v[k]];
            }
            copy_marks(cut, at, i);
        } else if (kept) {
            cut_triangle(cut, i, kept);
        }
    }
}

/* ---- Points ---- */

/* Keeps the points that are not beyond the plane. Returns how many there are. */
static size_t keep_points(burnish_mesh *mesh, const burnish_clip_plane *plane, int is_count) {
    const burnish_vec3 normal = burnish_vec3_load(plane->normal);
    size_t kept = 0;
    for (size_t i = 0; i < mesh->view.vertex_count; ++i) {
        const burnish_vec3 p = burnish_vec3_loadf(mesh->view.positions + 3 * i);
        if (burnish_vec3_dot(normal, p) > plane->offset) {
            continue;
        }
        for (int a = 0; a < BURNISH_ATTRIBUTE_COUNT && !is_count; ++a) {
            const size_t size = burnish_attribute_size((burnish_attribute)a);
            uint8_t *items = mesh->attributes[a];
            if (items) {
                memmove(items + kept * size, items + i * size, size);
            }
        }
        ++kept;
    }
    return kept;
}

static burnish_status fail_empty(const burnish_mesh *mesh, const burnish_clip_plane *plane,
                                 burnish_error *error) {
    const double *n = plane->normal, *o = mesh->view.origin; /* as the file's coordinates have it */
    return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                        "clip: all of the mesh is beyond the plane %g,%g,%g,%g; negate all four "
                        "numbers, or change the last one",
                        n[0], n[1], n[2], plane->offset + n[0] * o[0] + n[1] * o[1] + n[2] * o[2]);
}

/* is_cut: 1 if the plane has cut something else. */
static burnish_status clip_points(burnish_mesh *mesh, const burnish_clip_plane *plane, int is_cut,
                                  burnish_error *error) {
    const size_t kept = keep_points(mesh, plane, 1);
    if (kept == 0) {
        return fail_empty(mesh, plane, error);
    }
    if (is_cut || kept < mesh->view.vertex_count) {
        keep_points(mesh, plane, 0);
        mesh->view.cuts[mesh->view.cut_count++] = *plane;
        mesh->view.vertex_count = mesh->info.point_count = kept;
        burnish_mesh_update_view(mesh);
    }
    return BURNISH_STATUS_OK;
}

/* The mesh keeps its triangles if all splats are beyond the plane. */
static void clip_splats(burnish_mesh *mesh, const burnish_clip_plane *plane) {
    burnish_error none;
    if (mesh->splats && clip_points(mesh->splats, plane, 0, &none) != BURNISH_STATUS_OK) {
        burnish_mesh_destroy(mesh->splats);
        mesh->splats = NULL;
    } else if (mesh->splats) {
        mesh->splats->view.cut_count = 0; /* its cuts are the mesh's */
    }
}

/* ---- The whole ---- */

static void release_result(cutter *cut) {
    const burnish_context *context = cut->mesh->context;
    for (int a = 0; a < BURNISH_ATTRIBUTE_COUNT; ++a) {
        burnish_release(context, cut->attributes[a]);
    }
    burnish_release(context, cut->indices);
    burnish_release(context, cut->triangle_materials);
    burnish_release(context, cut->triangle_parts);
    burnish_release(context, cut->numbers);
}

/* Allocates the result. Errors: MEMORY, LIMIT. */
static burnish_status reserve_result(cutter *cut, size_t triangles, size_t vertices,
                                     burnish_memory *memory) {
    if (triangles > BURNISH_TRIANGLES_MAX || vertices > BURNISH_VALUE_LIMIT) {
        return burnish_fail(memory->error, BURNISH_STATUS_LIMIT,
                            "clip: more than %u triangles come out; simplify the mesh",
                            BURNISH_TRIANGLES_MAX);
    }
    for (int a = 0; a < BURNISH_ATTRIBUTE_COUNT; ++a) {
        if (cut->mesh->attributes[a]) {
            cut->attributes[a] = burnish_allocate(
                memory, vertices, burnish_attribute_size((burnish_attribute)a), "cut vertices");
        }
    }
    cut->indices = burnish_allocate(memory, triangles, 3 * sizeof *cut->indices, "cut triangles");
    if (cut->mesh->triangle_materials) {
        cut->triangle_materials =
            burnish_allocate(memory, triangles, sizeof *cut->triangle_materials, "materials");
    }
    if (cut->mesh->triangle_parts) {
        cut->triangle_parts =
            burnish_allocate(memory, triangles, sizeof *cut->triangle_parts, "parts");
    }
    return memory->status;
}

/* Swaps the result into the mesh; the cutter then owns the old arrays, to be released. */
static void exchange_result(burnish_mesh *mesh, cutter *cut) {
    burnish_mesh_view *view = &mesh->view;
    for (int a = 0; a < BURNISH_ATTRIBUTE_COUNT; ++a) {
        void *old = mesh->attributes[a];
        mesh->attributes[a] = cut->attributes[a];
        cut->attributes[a] = old;
    }
    uint32_t *indices = mesh->indices;
    uint16_t *materials = mesh->triangle_materials, *parts = mesh->triangle_parts;
    mesh->indices = cut->indices;
    mesh->triangle_materials = cut->triangle_materials;
    mesh->triangle_parts = cut->triangle_parts;
    cut->indices = indices;
    cut->triangle_materials = materials;
    cut->triangle_parts = parts;
    view->vertex_count = cut->vertex_count;
    view->triangle_count = cut->triangle_count;
    burnish_mesh_update_view(mesh);
}

/* The sum of x_i n_j over a part's triangles, whose normals n are as long as twice their areas. For a
 * closed surface it is twice the volume for i = j, else 0, from any origin. */
typedef struct part_sums {
    int has_origin;
    burnish_vec3 origin; /* a corner: far from the middle of any hole */
    double products[3][3];
} part_sums;

static void sum_triangle(const burnish_vec3 p[3], part_sums *sums) {
    sums->origin = sums->has_origin ? sums->origin : p[0];
    sums->has_origin = 1;
    const burnish_vec3 n =
        burnish_vec3_cross(burnish_vec3_sub(p[1], p[0]), burnish_vec3_sub(p[2], p[0]));
    const burnish_vec3 x = burnish_vec3_sub(
        burnish_vec3_scale(burnish_vec3_add(burnish_vec3_add(p[0], p[1]), p[2]), 1.0 / 3),
        sums->origin);
    const double normal[3] = {n.x, n.y, n.z}, middle[3] = {x.x, x.y, x.z};
    for (int k = 0; k < 9; ++k) {
        sums->products[k / 3][k % 3] += middle[k / 3] * normal[k % 3];
    }
}

/* The sign of the volume if gaps are too small to be seen, else 0. */
static int sign_of_volume(const part_sums *sums) {
    const double volume = (sums->products[0][0] + sums->products[1][1] + sums->products[2][2]) / 3;
    const double most = GAP_TOLERANCE * (volume < 0 ? -volume : volume);
    int sign = (volume > 0) - (volume < 0);
    for (int k = 0; k < 9; ++k) {
        const double off = sums->products[k / 3][k % 3] - (k % 4 == 0 ? volume : 0);
        sign = off <= most && off >= -most ? sign : 0;
    }
    return sign;
}

/* The side of the triangles that faces the inside of an uncut mesh. It is known if the mesh was
 * measured, and it is closed or each of its parts is but for gaps. Triangles that were turned to match
 * their normals change the sums. */
static burnish_inside find_inside(const burnish_mesh *mesh, burnish_memory *memory) {
    const burnish_mesh_view *view = &mesh->view;
    const uint16_t *parts = mesh->facts.is_solid ? NULL : view->triangle_parts;
    const size_t count = parts ? mesh->contents.part_count : 1;
    int signs = 0; /* bits: a volume is below 0, 0 and above 0 */
    if (!mesh->has_facts) {
        return BURNISH_INSIDE_UNKNOWN;
    }
    part_sums *sums = burnish_allocate_zeroed(memory, count, sizeof *sums, "parts of a cut");
    for (size_t i = 0; i < view->triangle_count && sums; ++i) {
        burnish_vec3 p[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = burnish_vec3_loadf(view->positions + 3 * (size_t)view->indices[3 * i + k]);
        }
        sum_triangle(p, &sums[parts ? parts[i] : 0]);
    }
    for (size_t i = 0; i < count && sums; ++i) {
        signs |= sums[i].has_origin ? 1 << (1 + sign_of_volume(&sums[i])) : 0;
    }
    burnish_release(memory->context, sums);
    return signs == 4   ? BURNISH_INSIDE_BACK
           : signs == 1 ? BURNISH_INSIDE_FRONT
                        : BURNISH_INSIDE_UNKNOWN;
}

static burnish_status check_clip(const burnish_mesh *mesh, const burnish_clip_plane *plane,
                                 burnish_error *error) {
    if (!mesh || !plane) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "clip: the %s is NULL; pass one",
                            !mesh ? "mesh" : "plane");
    }
    const double *n = plane->normal;
    const double sum = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    if (!(sum > 0 && sum < __builtin_inf()) || !burnish_is_finite(plane->offset)) {
        return burnish_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "clip: %g,%g,%g,%g is not a plane; expected finite numbers, and a normal that is not 0",
            n[0], n[1], n[2], plane->offset);
    }
    if (mesh->view.cut_count == BURNISH_CUTS_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "clip: more than %d planes; leave some out", BURNISH_CUTS_MAX);
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_mesh_clip(burnish_mesh *mesh, const burnish_clip_plane *plane,
                                 burnish_error *error) {
    burnish_status status = check_clip(mesh, plane, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (mesh->view.point_radius > 0) {
        return clip_points(mesh, plane, 0, error);
    }
    burnish_memory memory = burnish_memory_of(mesh->context, error);
    burnish_mesh_view *view = &mesh->view;
    cutter cut = {.mesh = mesh, .plane = *plane};
    size_t triangles = 0, vertices = 0;
    cut.numbers =
        burnish_allocate_zeroed(&memory, view->vertex_count, sizeof *cut.numbers, "cut vertices");
    status = memory.status;
    if (status == BURNISH_STATUS_OK) {
        count_parts(&cut, &triangles, &vertices);
        if (triangles == 0 && mesh->splats && keep_points(mesh->splats, plane, 1) > 0) {
            release_result(&cut);
            burnish_mesh_keep_splats(mesh);
            return clip_points(mesh, plane, 1, error);
        }
        if (triangles == 0) {
            status = fail_empty(mesh, plane, error);
        }
    }
    if (status == BURNISH_STATUS_OK && !cut.cuts_something && mesh->splats) {
        clip_splats(mesh, plane);
        burnish_mesh_update_view(mesh);
    }
    if (status != BURNISH_STATUS_OK || !cut.cuts_something) {
        release_result(&cut);
        return status;
    }
    status = reserve_result(&cut, triangles, vertices, &memory);
    if (status == BURNISH_STATUS_OK) {
        copy_vertices(&cut);
        cut_triangles(&cut);
        if (cut.triangle_count == 0) {
            status = burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                  "clip: the mesh only touches the plane; change its last number");
        }
    }
    burnish_inside inside = view->inside;
    if (status == BURNISH_STATUS_OK && view->cut_count == 0) {
        inside = find_inside(mesh, &memory);
        status = memory.status;
    }
    if (status == BURNISH_STATUS_OK) {
        view->inside = inside;
        view->cuts[view->cut_count++] = *plane;
        clip_splats(mesh, plane);
        exchange_result(mesh, &cut);
    }
    release_result(&cut);
    return status;
}
