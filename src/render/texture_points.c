/* Where a visible point lies in its triangle's image.
 *
 * Barycentric weights come from the triangle in space (Olano and Greer 1997): in perspective that
 * of corner i is, but for a factor that all three share, the product d . (p_j x p_k) of the ray d
 * through the pixel and the other two corners, counted from the eye; linear on the screen, and true
 * of triangles that reach behind the eye. Double precision, so that no anchor is needed. */
#include <string.h>

#include "core/vector.h"
#include "render/texture.h"

/* A corner from the eye. */
static burnish_vec3 corner_of(const burnish_texturing *texturing, const float *position) {
    burnish_vec3 p;
    p.x = ((double)position[0] - texturing->origin[0]) * texturing->scale - texturing->eye[0];
    p.y = ((double)position[1] - texturing->origin[1]) * texturing->scale - texturing->eye[1];
    p.z = ((double)position[2] - texturing->origin[2]) * texturing->scale - texturing->eye[2];
    return p;
}

/* The planes of the three weights. */
static void weight_planes(const burnish_rays *rays, const burnish_vec3 p[3], double planes[3][3]) {
    const burnish_vec3 ray = burnish_vec3_loadf(rays->ray), x = burnish_vec3_loadf(rays->ray_x);
    const burnish_vec3 y = burnish_vec3_loadf(rays->ray_y);
    const burnish_vec3 depth = burnish_vec3_loadf(rays->ray_depth);
    for (int i = 0; i < 3; ++i) {
        const burnish_vec3 a = p[(i + 1) % 3], b = p[(i + 2) % 3];
        const int is_parallel = rays->q_per_depth == 0;
        const burnish_vec3 n = is_parallel ? burnish_vec3_cross(burnish_vec3_sub(b, a), depth)
                                           : burnish_vec3_cross(a, b);
        planes[i][0] = burnish_vec3_dot(x, n);
        planes[i][1] = burnish_vec3_dot(y, n);
        planes[i][2] = is_parallel ? -burnish_vec3_dot(a, n) : burnish_vec3_dot(ray, n);
    }
}

/* Of sums of weights times the corners' values. */
static void value_plane(double weights[3][3], const double values[3], double plane[3]) {
    for (int k = 0; k < 3; ++k) {
        plane[k] =
            (weights[0][k] * values[0] + weights[1][k] * values[1]) + weights[2][k] * values[2];
    }
}

static double least_of(const double v[3]) {
    const double a = v[0] < v[1] ? v[0] : v[1];
    return a < v[2] ? a : v[2];
}

static double most_of(const double v[3]) {
    const double a = v[0] > v[1] ? v[0] : v[1];
    return a > v[2] ? a : v[2];
}

static void set_tangents(const burnish_texturing *texturing, const uint32_t *vertices,
                         double weights[3][3], burnish_texture_setup *setup) {
    const float *tangents = texturing->mesh->tangents;
    const double side = setup->id & 1 ? -1 : 1; /* seen from its back all of the frame turns */
    for (size_t k = 0; k < 3; ++k) {
        const double values[3] = {side * (double)tangents[4 * (size_t)vertices[0] + k],
                                  side * (double)tangents[4 * (size_t)vertices[1] + k],
                                  side * (double)tangents[4 * (size_t)vertices[2] + k]};
        value_plane(weights, values, setup->tangent[k]);
    }
    setup->sign = (float)side * tangents[4 * (size_t)vertices[0] + 3];
    setup->has_tangents = 1;
}

static void set_up(const burnish_texturing *texturing, const burnish_rays *rays,
                   const burnish_textured_material *material, uint32_t id,
                   burnish_texture_setup *setup) {
    const burnish_mesh_view *mesh = texturing->mesh;
    const uint32_t *vertices = mesh->indices + 3 * (size_t)(id >> 1);
    setup->frame = texturing->frame;
    setup->id = id;
    setup->has_tangents = 0;
    setup->has_coordinates = material->has_textures;
    if (!material->has_textures) {
        return;
    }
    burnish_vec3 p[3];
    double weights[3][3], u[3], v[3];
    static const double one[3] = {1, 1, 1};
    for (int i = 0; i < 3; ++i) {
        const float *coordinates = mesh->texture_coordinates + 2 * (size_t)vertices[i];
        p[i] = corner_of(texturing, mesh->positions + 3 * (size_t)vertices[i]);
        u[i] = (double)coordinates[0];
        v[i] = (double)coordinates[1];
    }
    weight_planes(rays, p, weights);
    value_plane(weights, one, setup->w);
    value_plane(weights, u, setup->u);
    value_plane(weights, v, setup->v);
    setup->low[0] = least_of(u);
    setup->low[1] = least_of(v);
    setup->high[0] = most_of(u);
    setup->high[1] = most_of(v);
    if (material->has_normals && mesh->tangents) {
        set_tangents(texturing, vertices, weights, setup);
    }
}

static double at(const double plane[3], double x, double y) {
    return (plane[0] * x + plane[1] * y) + plane[2];
}

/* A point beside an edge, where rounding puts it, gets what is at the edge; so does a NaN. */
static double within(double value, double low, double high) {
    const double least = value > low ? value : low;
    return least < high ? least : high;
}

static void clear_points(burnish_texture_scratch *scratch, int first, int end) {
    for (int k = 0; k < BURNISH_TEXTURE_STREAMS; ++k) {
        memset(&scratch->points[k][first], 0, (size_t)(end - first) * sizeof(float));
    }
}

/* Points [first, end) of one triangle. */
static void locate_run(const burnish_texture_setup *setup, const burnish_screen_points *points,
                       int first, int end, burnish_texture_scratch *scratch) {
    float(*out)[BURNISH_TEXTURE_BATCH] = scratch->points;
    for (int i = first; i < end; ++i) {
        const double x = (double)(points->x + points->x_offset[i]);
        const double y = (double)(points->y + points->y_offset[i]);
        const double inverse = 1 / at(setup->w, x, y);
        const double u = within(at(setup->u, x, y) * inverse, setup->low[0], setup->high[0]);
        const double v = within(at(setup->v, x, y) * inverse, setup->low[1], setup->high[1]);
        out[BURNISH_TEXTURE_U][i] = (float)u;
        out[BURNISH_TEXTURE_V][i] = (float)v;
        out[BURNISH_TEXTURE_U_X][i] = (float)((setup->u[0] - u * setup->w[0]) * inverse);
        out[BURNISH_TEXTURE_V_X][i] = (float)((setup->v[0] - v * setup->w[0]) * inverse);
        out[BURNISH_TEXTURE_U_Y][i] = (float)((setup->u[1] - u * setup->w[1]) * inverse);
        out[BURNISH_TEXTURE_V_Y][i] = (float)((setup->v[1] - v * setup->w[1]) * inverse);
        for (int k = 0; k < 3 && setup->has_tangents; ++k) {
            out[BURNISH_TEXTURE_TANGENT + k][i] = (float)(at(setup->tangent[k], x, y) * inverse);
        }
        out[BURNISH_TEXTURE_SIGN][i] = setup->sign;
    }
}

void burnish_texture_locate(const burnish_texturing *texturing, const burnish_rays *rays,
                            const burnish_screen_points *points, const int32_t *materials,
                            int count, burnish_texture_scratch *scratch) {
    const uint32_t *ids = scratch->ids;
    for (int first = 0, end; first < count; first = end) {
        const uint32_t id = ids[first];
        const int material = materials ? materials[first] : 0;
        burnish_texture_setup *setup =
            &scratch->setups[(id * 0x9e3779b1u) >> 26]; /* of BURNISH_TEXTURE_SETUPS */
        for (end = first + 1; end < count && ids[end] == id; ++end) {
        }
        if (setup->frame != texturing->frame || setup->id != id) {
            set_up(texturing, rays, &texturing->materials[material], id, setup);
        }
        if (!setup->has_coordinates || !setup->has_tangents) {
            clear_points(scratch, first, end);
        }
        if (setup->has_coordinates) {
            locate_run(setup, points, first, end, scratch);
        }
    }
    const int padded = (count + 15) / 16 * 16;
    clear_points(scratch, count, padded);
}
