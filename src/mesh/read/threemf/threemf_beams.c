/* Beam lattices (3MF Consortium, "Beam Lattice Extension" 1.2): rods between vertices, with linear
 * radii, and balls. Each becomes a closed surface of revolution. Round caps are hemispheres: spheres
 * differ only where the radii of a rod do. */
#include "base/numbers.h"
#include "core/vec3.h"
#include "mesh/read/threemf/threemf.h"
#include "mesh/read/threemf/threemf_xml.h"

#if BURNISH_HAS_3MF

enum { SIDES = 24, QUARTER = SIDES / 4, RINGS = 2 * QUARTER + 2 };

/* ---- Reading ---- */

static int is_word(const char *text, const char *word) {
    return text && strcmp(text, word) == 0;
}

/* A radius or length; not finite and negative ones count as 0. */
static int read_length(burnish_threemf_xml *xml, const char *const *attributes, const char *name,
                       float fallback, float *value) {
    *value = fallback;
    if (burnish_threemf_attribute(attributes, name) &&
        !burnish_threemf_float(xml, attributes, name, value)) {
        return 0;
    }
    *value = *value > 0 && burnish_is_finitef(*value) ? *value : 0;
    return 1;
}

void burnish_threemf_begin_lattice(burnish_threemf_xml *xml, burnish_threemf_object *object,
                                   const char *const *attributes) {
    burnish_threemf *threemf = xml->threemf;
    burnish_threemf_lattice *lattice = &threemf->lattice;
    const char *clipping = burnish_threemf_attribute(attributes, "clippingmode");
    const char *mode = burnish_threemf_prefixed(attributes, "ballmode");
    const char *const balls[] = {"r", burnish_threemf_prefixed(attributes, "ballradius"), NULL};
    burnish_threemf_rod *rod = &lattice->usual;
    lattice->balls = is_word(mode, "all") ? 2 : is_word(mode, "mixed");
    rod->is_round[0] = rod->is_round[1] =
        !is_word(burnish_threemf_attribute(attributes, "cap"), "butt");
    if (!read_length(xml, attributes, "radius", 0, &rod->radii[0]) ||
        !read_length(xml, attributes, "minlength", 0, &lattice->least) ||
        !read_length(xml, balls[1] ? balls : balls + 2, "r", 0, &lattice->ball_radius) ||
        !burnish_threemf_whole(xml, attributes, "pid", object->group, &rod->group) ||
        !burnish_threemf_whole(xml, attributes, "pindex", object->property, &rod->properties[0])) {
        return;
    }
    if (burnish_threemf_attribute(attributes, "representationmesh")) { /* drawn instead */
        burnish_threemf_placement *mesh = BURNISH_THREEMF_APPEND(threemf, &threemf->components);
        if (mesh) {
            mesh->matrix[0] = mesh->matrix[5] = mesh->matrix[10] = 1;
            mesh->part = object->part;
            mesh->line = burnish_threemf_line(xml);
            object->component_count = 1;
            burnish_threemf_whole(xml, attributes, "representationmesh", 0, &mesh->id);
        }
        return;
    }
    clipping = clipping ? clipping : burnish_threemf_attribute(attributes, "clipping");
    if (clipping && !is_word(clipping, "none")) {
        burnish_reader_note(threemf->reader, &threemf->slices, NULL,
                            "%.80s:%u: a beam lattice is drawn whole, not clipped by its mesh",
                            xml->part, burnish_threemf_line(xml));
    }
}

void burnish_threemf_add_rod(burnish_threemf_xml *xml, const burnish_threemf_object *object,
                             const char *const *attributes, int is_ball) {
    static const char *const names[2][3][2] = {{{"v1", "v2"}, {"r1", "r2"}, {"p1", "p2"}},
                                               {{"vindex", "vindex"}, {"r", "r"}, {"p", "p"}}};
    burnish_threemf *threemf = xml->threemf;
    const burnish_threemf_lattice *lattice = &threemf->lattice;
    burnish_threemf_rod rod = lattice->usual;
    if (object->component_count > 0 || (is_ball && !lattice->balls) ||
        !burnish_threemf_whole(xml, attributes, "pid", rod.group, &rod.group)) {
        return;
    }
    rod.radii[0] = is_ball ? lattice->ball_radius : rod.radii[0];
    if (burnish_threemf_attribute(attributes, "pid")) {
        rod.properties[0] = 0;
    }
    for (int i = 0; i < 2; ++i) {
        const char *cap = burnish_threemf_attribute(attributes, i ? "cap2" : "cap1");
        rod.is_round[i] = is_ball || (cap ? !is_word(cap, "butt") : rod.is_round[i]);
        const char *end = burnish_threemf_attribute(attributes, names[is_ball][0][i]);
        const int is_below = end && *end == '-'; /* out of range */
        rod.ends[i] = BURNISH_THREEMF_NONE;
        if ((!is_below && !burnish_threemf_whole(xml, attributes, names[is_ball][0][i],
                                                 BURNISH_THREEMF_NONE, &rod.ends[i])) ||
            !read_length(xml, attributes, names[is_ball][1][i], rod.radii[0], &rod.radii[i]) ||
            !burnish_threemf_whole(xml, attributes, names[is_ball][2][i], rod.properties[0],
                                   &rod.properties[i])) {
            return;
        }
        if (rod.ends[i] >= object->vertex_count) {
            burnish_reader_note(
                threemf->reader, &threemf->reader->damage, NULL,
                "%.80s:%u: %s %.20s is out of range; there are %u vertices, counted "
                "from 0",
                xml->part, burnish_threemf_line(xml), names[is_ball][0][i], end,
                object->vertex_count);
            return;
        }
    }
    burnish_threemf_rod *to = BURNISH_THREEMF_APPEND(threemf, &threemf->rods);
    if (to) {
        *to = rod;
    }
}

/* ---- Drawing ---- */

/* Of angle * 360 / SIDES degrees. */
static double cosine(int angle) {
    static const double first[QUARTER + 1] = {
        1, 0.96592582628906829, 0.86602540378443865, 0.70710678118654752, 0.5, 0.25881904510252076,
        0};
    angle = angle < 0 ? -angle : angle;
    angle = angle > SIDES / 2 ? SIDES - angle : angle;
    return angle > QUARTER ? -first[SIDES / 2 - angle] : first[angle];
}

/* A surface of revolution: rings around an axis; a ring without a radius is one vertex. */
typedef struct revolution {
    burnish_vec3 base, axes[3]; /* two across, one along */
    int step;                   /* of the angles of SIDES */
    int count, second;          /* rings; the first of the second end */
    double along[RINGS], radius[RINGS];
    const burnish_threemf_rod *rod;
} revolution;

static void put_ring(burnish_threemf *threemf, burnish_threemf_object *object, const revolution *r,
                     int i) {
    for (int side = 0; side < (r->radius[i] > 0 ? SIDES : 1); side += r->step) {
        burnish_threemf_position *to = BURNISH_THREEMF_APPEND(threemf, &threemf->vertices);
        if (to) {
            const burnish_vec3 across = burnish_vec3_add(
                burnish_vec3_scale(r->axes[0], r->radius[i] * cosine(side)),
                burnish_vec3_scale(r->axes[1], r->radius[i] * cosine(side - QUARTER)));
            const burnish_vec3 at = burnish_vec3_add(
                burnish_vec3_add(r->base, burnish_vec3_scale(r->axes[2], r->along[i])), across);
            *to = (burnish_threemf_position){{(float)at.x, (float)at.y, (float)at.z}};
            ++object->vertex_count;
        }
    }
}

/* The triangles between rings i and i + 1, which begin at these vertices. Returns 0 on failure. */
static int join_rings(burnish_threemf *threemf, burnish_threemf_object *object, const revolution *r,
                      int i, const uint32_t starts[2]) {
    const uint32_t sides = (uint32_t)(SIDES / r->step);
    for (uint32_t n = 0; n < 2 * sides; ++n) {
        const uint32_t side = n / 2, next = side + 1 < sides ? side + 1 : 0;
        const int is_high = n % 2; /* a side of the second ring, and a corner on the first */
        burnish_threemf_triangle triangle = {.group = r->rod->group};
        const uint32_t at[3][2] = {
            {0, side}, {(uint32_t)is_high, next}, {1, is_high ? side : next}};
        for (int k = 0; k < 3; ++k) {
            const int ring = i + (int)at[k][0];
            triangle.corners[k] = starts[at[k][0]] + (r->radius[ring] > 0 ? at[k][1] : 0);
            triangle.properties[k] = r->rod->properties[ring >= r->second];
        }
        if (r->radius[i + is_high] > 0 &&
            !burnish_threemf_add_triangle(threemf, object, &triangle)) {
            return 0;
        }
    }
    return 1;
}

/* Adds the rings of one end, whose cap is at `at`: outside first for the first end. */
static void add_end(revolution *r, int end, double at) {
    const double radius = (double)r->rod->radii[end];
    const int is_round = r->rod->is_round[end] && radius > 0;
    for (int i = 0; i <= QUARTER; i += is_round ? r->step : QUARTER) {
        const int angle = end ? QUARTER - i : i; /* from the pole */
        const double out = is_round ? radius * cosine(angle) : 0;
        r->along[r->count] = end ? at + out : at - out;
        r->radius[r->count++] = radius * cosine(QUARTER - angle);
    }
}

/* Writes a rod, or a ball if it begins where it ends. Returns 0 on failure. */
static int put_rod(burnish_threemf *threemf, burnish_threemf_object *object,
                   const burnish_threemf_rod *rod, int step) {
    const burnish_threemf_position *at = threemf->vertices.items + object->first_vertex;
    revolution r = {.base = burnish_vec3_loadf(at[rod->ends[0]].xyz), .step = step, .rod = rod};
    const burnish_vec3 along = burnish_vec3_sub(burnish_vec3_loadf(at[rod->ends[1]].xyz), r.base);
    const int is_ball = rod->ends[0] == rod->ends[1];
    const double length = burnish_vec3_length(along);
    if (!burnish_is_finite(r.base.x + r.base.y + r.base.z + length) ||
        !(is_ball ? rod->radii[0] > 0 : length > 0 && length >= (double)threemf->lattice.least)) {
        return 1;
    }
    const burnish_vec3 axis = is_ball ? (burnish_vec3){0, 0, 1} : burnish_vec3_normalize(along);
    const burnish_vec3 other =
        axis.x * axis.x < 0.5 ? (burnish_vec3){1, 0, 0} : (burnish_vec3){0, 1, 0};
    r.axes[2] = axis;
    r.axes[0] = burnish_vec3_normalize(burnish_vec3_cross(other, axis));
    r.axes[1] = burnish_vec3_cross(axis, r.axes[0]);
    add_end(&r, 0, 0);
    r.second = r.count -= is_ball; /* whose equator is there once */
    add_end(&r, 1, length);
    uint32_t starts[2] = {0, 0};
    for (int i = 0; i < r.count; ++i) {
        starts[0] = starts[1];
        starts[1] = object->vertex_count;
        put_ring(threemf, object, &r, i);
        if (threemf->memory->status != BURNISH_STATUS_OK ||
            (i > 0 && !join_rings(threemf, object, &r, i - 1, starts))) {
            return 0;
        }
    }
    return 1;
}

/* Lists a ball at each end of a rod, but for the balls that are listed, last. Returns 0 on failure. */
static int list_balls(burnish_threemf *threemf, uint32_t vertex_count) {
    const float radius = threemf->lattice.ball_radius;
    uint8_t *has_ball = burnish_allocate_zeroed(threemf->memory, vertex_count, 1, "balls");
    for (size_t i = 2 * threemf->rods.count; i > 0 && has_ball; --i) {
        const burnish_threemf_rod rod = threemf->rods.items[(i - 1) / 2];
        const uint32_t at = rod.ends[i % 2], property = rod.properties[i % 2];
        burnish_threemf_rod *to = has_ball[at] || rod.ends[0] == rod.ends[1]
                                      ? NULL
                                      : BURNISH_THREEMF_APPEND(threemf, &threemf->rods);
        has_ball[at] = 1;
        if (to) {
            *to = (burnish_threemf_rod){
                {at, at}, {radius, radius}, {1, 1}, rod.group, {property, property}};
        }
    }
    burnish_release(threemf->memory->context, has_ball);
    return threemf->memory->status == BURNISH_STATUS_OK;
}

int burnish_threemf_put_lattice(burnish_threemf *threemf, burnish_threemf_object *object) {
    if (threemf->lattice.balls == 2 && !list_balls(threemf, object->vertex_count)) {
        return 0;
    }
    const size_t count = threemf->rods.count;
    const int step = count <= 500 ? 1 : count <= 5000 ? 2 : count <= 20000 ? 3 : 6;
    for (size_t i = 0; i < count; ++i) {
        if (!put_rod(threemf, object, &threemf->rods.items[i], step)) {
            return 0;
        }
    }
    threemf->rods.count = 0;
    threemf->lattice.balls = 0;
    return 1;
}

#endif
