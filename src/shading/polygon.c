/* Checks polygonal lights, spheres and tubes. */
#include "shading/polygon.h"

#include <string.h>

#include "base/arithmetic.h"
#include "base/elementary.h"
#include "base/error.h"
#include "base/layout.h"
#include "base/numbers.h"

#define COOKIE BURNISH_COOKIE(0x706f6c79, burnish_kernels_polygon)

/* In parts of a polygon's size: how far a vertex can be out of the plane, or on the wrong side of an
 * edge. */
#define TOLERANCE 1e-4

/* From this zeta on a quadratic approximates 1 / ((1 + c) cos(t/2)) in the cap, within 2e-5. */
#define NARROW 16.0f

void burnish_kernels_polygon_init(burnish_kernels_polygon *polygon, uint64_t layout) {
    const burnish_kernels_polygon defaults = {
        .cookie = COOKIE,
        .vertex_count = 4,
        .vertices = {{-1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {1, -1, 1}},
        .lobe_count = 1,
        .lobes = {{.order = 2, .zeta = 1, .weight = 1}}};
    burnish_layout_init(polygon, layout, BURNISH_LAYOUT(burnish_kernels_polygon), &defaults);
}

static int is_within(float x, float low, float high) {
    return x >= low && x <= high; /* not NaN */
}

/* Checks a composite; the squarings are those of its degree. */
static int make_composite(const burnish_composite *lobe, burnish_polygon_lobe *made) {
    double p[17] = {0, 1}, scale = (double)lobe->top * (double)lobe->top, energy = 0;
    int degree = 1; /* of p, in u^2 */
    if (lobe->multiplications < 2 || lobe->multiplications > 6 || !is_within(lobe->top, 1e-6f, 1) ||
        !is_within(lobe->slope, lobe->top, BURNISH_LOBE_ZETA_MAX * lobe->top)) {
        return 0;
    }
    made->zeta = lobe->slope / lobe->top;
    made->squarings = lobe->multiplications - 1;
    for (int step = 0; step < lobe->multiplications - 2; ++step) {
        const double b = (double)lobe->offset[step] / scale;
        double product[17] = {0};
        if (!is_within(lobe->offset[step], 0, 1e6f)) {
            return 0;
        }
        for (int i = 1; i <= degree; ++i) {
            product[i] += b * p[i] / (1 + b);
            for (int j = 1; j <= degree; ++j) {
                product[i + j] += p[i] * p[j] / (1 + b);
            }
        }
        memcpy(p, product, sizeof p);
        scale *= scale * (1 + b);
        degree *= 2;
    }
    for (int i = 1; i <= degree; ++i) {
        p[i] /= 2 * i + 1;
        energy += p[i];
    }
    made->terms = degree;
    for (int i = degree; i > 0; --i) { /* the powers from u^2i on have it */
        made->term[i - 1] = (float)(((double)(i < degree ? made->term[i] : 0.0f)) + p[i] / energy);
    }
    return 1;
}

static burnish_status make_lobes(const burnish_kernels_polygon *polygon,
                                 burnish_polygon_constants *constants, burnish_error *error) {
    if (polygon->lobe_count < 0 || polygon->lobe_count > BURNISH_POLYGON_LOBE_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "polygon: %d lobes; at most %d",
                            polygon->lobe_count, BURNISH_POLYGON_LOBE_MAX);
    }
    constants->lobe_count = polygon->lobe_count;
    constants->reach_cosine = 1;
    for (int j = 0; j < polygon->lobe_count; ++j) {
        const burnish_kernels_lobe *lobe = &polygon->lobes[j];
        burnish_polygon_lobe *made = &constants->lobes[j];
        *made = (burnish_polygon_lobe){.zeta = lobe->zeta, .weight = lobe->weight};
        if (lobe->order == 0 && !make_composite(&lobe->composite, made)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "polygon: the composite of lobe %d is not from "
                                "burnish_composite_create()",
                                j + 1);
        }
        if (lobe->order < 0 || (lobe->order > 1 && !burnish_lobe_order_is_valid(lobe->order))) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "polygon: order %d of lobe %d is not 0, 1, 2, 4, 8, 16 or 32",
                                lobe->order, j + 1);
        }
        const float least_zeta = polygon->vertex_count == 1 ? 1.0f : 0.5f;
        if (!is_within(made->zeta, least_zeta, BURNISH_LOBE_ZETA_MAX)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "polygon: zeta %g of lobe %d is not in [%g, 65536]",
                                (double)lobe->zeta, j + 1, (double)least_zeta);
        }
        if (!is_within(lobe->weight, 0.0f, 1e6f)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "polygon: weight %g of lobe %d is not in [0, 1e6]",
                                (double)lobe->weight, j + 1);
        }
        const double least = 1.0 - 1.0 / (double)made->zeta, bound = least > 0 ? least : 0;
        made->is_narrow = made->zeta >= NARROW;
        made->least_cosine = (float)bound;
        made->least_cosine_squared = (float)(bound * bound);
        while (1 << made->squarings < lobe->order) {
            ++made->squarings;
        }
        const float cosine = (float)(least - 1e-4); /* wider by more than rounding */
        constants->reach_cosine =
            cosine < constants->reach_cosine ? cosine : constants->reach_cosine;
    }
    const double cosine = (double)constants->reach_cosine;
    constants->reach_sine = (float)burnish_sqrt(cosine > -1 ? 1 - cosine * cosine : 0);
    return BURNISH_STATUS_OK;
}

/* Corners relative to the first one or, for a distant light, directions of unit length. */
typedef struct shape {
    int count;
    double corner[BURNISH_POLYGON_VERTEX_MAX][3];
    double normal[3]; /* unit vector toward points that see the corners counterclockwise */
    double size;      /* largest distance of two corners */
} shape;

static double dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross3(const double a[3], const double b[3], double product[3]) {
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        product[k] = a[i] * b[j] - a[j] * b[i];
    }
}

static void subtract3(const double a[3], const double b[3], double difference[3]) {
    for (int k = 0; k < 3; ++k) {
        difference[k] = a[k] - b[k];
    }
}

static burnish_status read_vertices(const burnish_kernels_polygon *polygon, shape *made,
                                    burnish_error *error) {
    const int is_flat_distant = polygon->is_distant && polygon->vertex_count > 2;
    made->count = polygon->vertex_count;
    if (made->count < 1 || made->count > BURNISH_POLYGON_VERTEX_MAX) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "polygon: %d vertices; 1 to %d",
                            made->count, BURNISH_POLYGON_VERTEX_MAX);
    }
    for (int v = 0; v < made->count; ++v) {
        double *corner = made->corner[v];
        for (int k = 0; k < 3; ++k) {
            if (!is_within(polygon->vertices[v][k], -0x1p40f, 0x1p40f)) {
                return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                    "polygon: vertex %d: coordinates must be in [-2^40, 2^40]",
                                    v + 1);
            }
            corner[k] = (double)polygon->vertices[v][k];
            corner[k] -= is_flat_distant ? 0.0 : (double)polygon->vertices[0][k];
        }
        const double length = burnish_sqrt(dot3(corner, corner));
        for (int k = 0; is_flat_distant && k < 3; ++k) {
            corner[k] /= length > 0 ? length : 1;
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status find_normal(shape *made, burnish_error *error) {
    double normal[3] = {0, 0, 0}, least = 8;
    made->size = 0;
    for (int v = 0; v < made->count; ++v) {
        double part[3], d[3];
        cross3(made->corner[v], made->corner[(v + 1) % made->count], part);
        for (int k = 0; k < 3; ++k) {
            normal[k] += part[k];
        }
        for (int other = 0; other < v; ++other) {
            subtract3(made->corner[v], made->corner[other], d);
            const double distance = burnish_sqrt(dot3(d, d));
            made->size = distance > made->size ? distance : made->size;
            least = v == 1 || distance < least ? distance : least;
        }
    }
    const double length = burnish_sqrt(dot3(normal, normal));
    if (!(length > TOLERANCE * TOLERANCE * made->size * made->size)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "polygon: it has no area");
    }
    if (!(least > TOLERANCE * TOLERANCE * made->size)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "polygon: two vertices coincide");
    }
    for (int k = 0; k < 3; ++k) {
        made->normal[k] = normal[k] / length;
    }
    return BURNISH_STATUS_OK;
}

/* On which side of an edge another corner is, as a distance; above 0 inside a convex polygon. */
static double find_side(const shape *made, int edge, int corner, double facing) {
    const double *a = made->corner[edge], *b = made->corner[(edge + 1) % made->count];
    const double *c = made->corner[corner];
    double along[3], to_c[3], normal[3];
    subtract3(b, a, along);
    subtract3(c, a, to_c);
    cross3(along, to_c, normal);
    const double length = burnish_sqrt(dot3(along, along));
    return (facing != 0 ? -dot3(normal, a) * facing : dot3(normal, made->normal)) / length;
}

/* facing: of a distant light, 1 if (0, 0, 0) is on its bright side and -1 behind it. */
static burnish_status check_shape(const shape *made, double facing, burnish_error *error) {
    for (int v = 0; v < made->count; ++v) {
        const double height = dot3(made->corner[v], made->normal);
        if (facing == 0 && (height > TOLERANCE * made->size || height < -TOLERANCE * made->size)) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "polygon: vertex %d is not in the plane of the others", v + 1);
        }
        for (int other = 0; other < made->count; ++other) {
            if (find_side(made, v, other, facing) < -TOLERANCE * made->size) {
                return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                    "polygon: not convex, at the edge after vertex %d", v + 1);
            }
        }
    }
    return BURNISH_STATUS_OK;
}

/* The product of the normal and the vertices, which a distant light has to see from a side. */
static burnish_status find_facing(const shape *made, double *facing, burnish_error *error) {
    double sum = 0;
    for (int v = 0; v < made->count; ++v) {
        sum -= dot3(made->normal, made->corner[v]) / made->count;
    }
    *facing = sum > 0 ? 1 : -1;
    return sum * *facing > TOLERANCE
               ? BURNISH_STATUS_OK
               : burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                              "polygon: (0, 0, 0) is in the plane of a distant light");
}

/* ---- Spheres and tubes ---- */

/* The corners of a circle, outside it by as much as inside, or of a strip. */
static void find_round_corners(burnish_polygon_constants *constants) {
    const int count = constants->vertex_count, is_strip = constants->shape == BURNISH_POLYGON_TUBE;
    double sine, cosine;
    burnish_sincos(2 * BURNISH_PI / count, &sine, &cosine);
    const double size = burnish_sqrt(is_strip ? 2 : 2 * BURNISH_PI / (count * sine));
    for (int v = 0; v < count; ++v) {
        burnish_sincos(2 * BURNISH_PI * (v + 0.5) / count, &sine, &cosine);
        constants->vertex[v][0] = (float)(size * cosine);
        constants->vertex[v][1] = (float)(size * sine);
    }
}

/* From the corner of a sphere (count 1) or between those of a tube. */
static burnish_status make_round(const burnish_kernels_polygon *polygon, const shape *read,
                                 burnish_polygon_constants *constants, burnish_error *error) {
    const int is_tube = polygon->vertex_count == 2;
    const float *first = polygon->vertices[0], *last = polygon->vertices[is_tube];
    double axis[3], center[3], squared = 0;
    subtract3(read->corner[is_tube], read->corner[0], axis);
    const double length = burnish_sqrt(dot3(axis, axis)), radius = (double)polygon->radius;
    for (int k = 0; k < 3; ++k) {
        center[k] = ((double)first[k] + (double)last[k]) / 2;
        squared += center[k] * center[k];
        constants->center[k] = (float)center[k];
        constants->axis[k] = is_tube ? (float)(axis[k] / length) : 0.0f;
    }
    if (!is_within(polygon->radius, 0x1p-40f, 0x1p40f)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "polygon: a radius of %g is not in [2^-40, 2^40]", radius);
    }
    if (is_tube && !(length > TOLERANCE * TOLERANCE * radius)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "polygon: two vertices coincide");
    }
    if (polygon->is_distant && !(radius * radius < squared)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "polygon: (0, 0, 0) is inside a distant light");
    }
    constants->shape = is_tube ? BURNISH_POLYGON_TUBE : BURNISH_POLYGON_SPHERE;
    constants->vertex_count = is_tube ? 4 : BURNISH_POLYGON_VERTEX_MAX;
    constants->is_distant = polygon->is_distant != 0;
    constants->thickness = polygon->radius;
    constants->half_length = (float)(length / 2);
    /* corners are outside a sphere, and twice the radius from an axis at most */
    constants->radius = (float)(is_tube ? (length / 2 + 2 * radius) * 1.0001 : radius * 1.02);
    find_round_corners(constants);
    return make_lobes(polygon, constants, error);
}

/* ---- Polygons ---- */

/* A sphere around the vertices, a little too large. */
static void find_sphere(burnish_polygon_constants *constants) {
    const int count = constants->vertex_count;
    double center[3] = {0, 0, 0}, squared = 0;
    for (int v = 0; v < count; ++v) {
        for (int k = 0; k < 3; ++k) {
            center[k] += (double)constants->vertex[v][k] / count;
        }
    }
    for (int v = 0; v < count; ++v) {
        double d[3];
        for (int k = 0; k < 3; ++k) {
            d[k] = (double)constants->vertex[v][k] - center[k];
        }
        squared = dot3(d, d) > squared ? dot3(d, d) : squared;
    }
    for (int k = 0; k < 3; ++k) {
        constants->center[k] = (float)center[k];
    }
    constants->radius = (float)(burnish_sqrt(squared) * 1.0001);
}

burnish_status burnish_polygon_constants_make(const burnish_kernels_polygon *polygon,
                                              burnish_polygon_constants *constants,
                                              burnish_error *error) {
    shape made;
    double facing = 0, offset = 0;
    burnish_status status =
        burnish_layout_check(polygon, COOKIE, "polygon", "kernels_polygon", error);
    status = status == BURNISH_STATUS_OK ? read_vertices(polygon, &made, error) : status;
    if (status == BURNISH_STATUS_OK && made.count < 3) {
        *constants = (burnish_polygon_constants){.is_two_sided = 1};
        return make_round(polygon, &made, constants, error);
    }
    status = status == BURNISH_STATUS_OK ? find_normal(&made, error) : status;
    if (status == BURNISH_STATUS_OK && polygon->is_distant) {
        status = find_facing(&made, &facing, error);
    }
    status = status == BURNISH_STATUS_OK ? check_shape(&made, facing, error) : status;
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    *constants = (burnish_polygon_constants){.vertex_count = made.count,
                                             .is_distant = polygon->is_distant != 0,
                                             .is_two_sided = polygon->is_two_sided != 0};
    for (int v = 0; v < made.count; ++v) {
        for (int k = 0; k < 3; ++k) {
            const double x = polygon->is_distant ? made.corner[v][k] : polygon->vertices[v][k];
            constants->vertex[made.count - 1 - v][k] = (float)x;
            offset += made.normal[k] * x / made.count;
        }
    }
    for (int k = 0; k < 3; ++k) {
        constants->normal[k] = (float)made.normal[k];
    }
    constants->offset = (float)offset;
    find_sphere(constants);
    return make_lobes(polygon, constants, error);
}
