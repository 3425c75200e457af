/* burnish_mesh_get_facts: areas, volumes and centres against closed forms, the same bits for any
 * number of threads. */
#include "shapes.h"

/* ---- Boxes ---- */

static void test_box(void) {
    shape s = box_at(1, 2, 3, 1, 2, 4);
    burnish_mesh_facts f = measure_as("a box", &s, whole_box);
    CHECK1(f.is_solid && f.volume == 8 && f.area == 28);
    check_center("a box", &f, 1.5, 3, 5, 0);
    for (size_t i = 0; i < 12; ++i) {
        turn(&s, i);
    }
    f = measure_as("inside out", &s, whole_box);
    CHECK1(f.is_solid && f.volume == -8 && f.area == 28);
    check_center("inside out", &f, 1.5, 3, 5, 0);
}

/* Digits that sums from the origin would lose: the volume of a tetrahedron from there is 1e20. */
static void test_far_box(void) {
    const shape s = box_at(1 << 23, -(1 << 23), 1 << 22, 1, 2, 3);
    const burnish_mesh_facts f = measure(&s);
    CHECK(f.volume == 6 && f.area == 22, "volume %.17g, area %.17g", f.volume, f.area);
    check_center("far away", &f, (1 << 23) + 0.5, 1 - (1 << 23), (1 << 22) + 1.5, 0);
}

/* The largest and the smallest floats. */
static void test_extreme_boxes(void) {
    const double large = 0x1p127, small = 0x1p-149;
    shape s = box_at(-large, -large, -large, 2 * large - 0x1p104, 2 * large - 0x1p104,
                     2 * large - 0x1p104);
    burnish_mesh_facts f = measure(&s);
    check_near("large", f.volume / 0x1p384, 1, 1e-6);
    check_center("large", &f, 0, 0, 0, 0x1p104);
    s = box_at(0, 0, 0, 2 * small, 2 * small, 2 * small);
    f = measure(&s);
    CHECK(f.is_solid && f.volume == 8 * small * small * small, "small: %g", f.volume);
    check_center("small", &f, small, small, small, 0);
}

static void test_open_box(void) {
    shape s = box_at(0, 0, 0, 1, 1, 1);
    s.triangle_count -= 2; /* without its lid, +z */
    counted expected = whole_box;
    expected.triangles = 10;
    expected.edges = 17;
    expected.open = 4;
    expected.closed = 0;
    const burnish_mesh_facts f = measure_as("an open box", &s, expected);
    CHECK(!f.is_solid && f.area == 5, "area %g", f.area);
    check_center("an open box", &f, 0.5, 0.5, 0.4, 1e-15); /* four sides at 0.5, the floor at 0 */
}

static void test_flipped(void) {
    counted expected = whole_box;
    shape s = box_at(0, 0, 0, 1, 1, 1);
    turn(&s, 4);
    expected.inconsistent = 3;
    expected.flipped = 1;
    expected.consistent = 0;
    burnish_mesh_facts f = measure_as("a flipped triangle", &s, expected);
    CHECK1(!f.is_solid && f.area == 6);
    for (size_t i = 0; i < 12; ++i) {
        turn(&s, i);
    }
    measure_as("all but one flipped", &s, expected);
    turn(&s, 5);
    expected.inconsistent = 4;
    expected.flipped = 2;
    measure_as("all but a face flipped", &s, expected);
}

/* Loading turns triangles to match their normals; the facts describe the triangles of the file. */
static void test_normals(void) {
    shape s = box_at(-1, -1, -1, 2, 2, 2);
    turn(&s, 0);
    burnish_mesh_description arrays =
        describe_arrays(s.points, s.points, NULL, s.point_count, s.corners, s.triangle_count);
    burnish_mesh_facts f = measure_arrays(&arrays, 1);
    CHECK(f.flipped_count == 1 && f.inconsistent_edge_count == 3, "%zu flipped", f.flipped_count);
    float inward[24];
    for (int i = 0; i < 24; ++i) {
        inward[i] = -s.points[i];
    }
    turn(&s, 0);
    arrays.normals.items = inward;
    f = measure_arrays(&arrays, 1);
    CHECK(f.volume == 8 && f.is_consistent, "volume %g", f.volume);
}

/* ---- Built-in objects ---- */

static burnish_mesh *load(const char *name, int tessellation, int threads) {
    burnish_load_options options = burnish_load_options_default();
    options.measure = 1;
    options.tessellation = tessellation;
    options.threads = threads;
    return load_mesh(name, &options);
}

static burnish_mesh_facts facts_of(const char *name, int tessellation) {
    OWNED_MESH *mesh = load(name, tessellation, 1);
    const burnish_mesh_facts facts = *burnish_mesh_get_facts(mesh);
    return facts;
}

/* The limit of a value whose error falls with the square of the tessellation. */
static double limit(double coarse, double fine) {
    return (4 * fine - coarse) / 3;
}

/* Against the smooth shape; what is left is the floats' rounding and the fourth power. */
static void check_smooth(const char *name, double area, double volume) {
    const burnish_mesh_facts a = facts_of(name, 32), b = facts_of(name, 64);
    check_near(name, limit(a.area, b.area) / area, 1, 2e-6);
    check_near(name, limit(a.volume, b.volume) / volume, 1, 2e-6);
    CHECK(b.is_solid && b.shell_count == 1 && b.open_edge_count == 0 && b.degenerate_count == 0,
          "%s: solid %d, %zu shells", name, b.is_solid, b.shell_count);
    check_center(name, &b, 0, 0, 0, 1e-7);
}

/* Of the knot's middle line, |p'(a)|^2 = 9 + 4 (2 + cos 3a)^2 over a turn: the trapezoid rule
 * converges faster than any power. */
static double knot_length(void) {
    enum { STEPS = 3000 };
    double length = 0;
    for (int i = 0; i < STEPS; ++i) {
        const double distance = 2 + cos(2 * TEST_PI * 3 * i / STEPS);
        length += sqrt(9 + 4 * distance * distance);
    }
    return length * 2 * TEST_PI / STEPS;
}

static void test_builtin(void) {
    check_smooth(":sphere", 4 * TEST_PI, 4 * TEST_PI / 3);
    check_smooth(":torus", 4 * TEST_PI * TEST_PI * 0.4, 2 * TEST_PI * TEST_PI * 0.16);
    /* A tube of constant radius: circumference and cross-section times length (Pappus). */
    check_smooth(":knot", 2 * TEST_PI * 0.6 * knot_length(), TEST_PI * 0.36 * knot_length());
    const burnish_mesh_facts f = facts_of(":teapot", 16);
    /* body, lid, handle and spout; two borders of body and lid, and the ends of the others */
    CHECK(f.shell_count == 4 && f.open_edge_count == 256 && !f.is_closed && f.is_consistent,
          "%zu shells, %zu open", f.shell_count, f.open_edge_count);
}

static void test_threads(void) {
    static const int threads[] = {2, 7};
    OWNED_MESH *one = load(":knot", 48, 1);
    for (int i = 0; i < 2; ++i) {
        OWNED_MESH *other = load(":knot", 48, threads[i]);
        CHECK(memcmp(burnish_mesh_get_facts(one), burnish_mesh_get_facts(other),
                     sizeof(burnish_mesh_facts)) == 0,
              "%d threads", threads[i]);
    }
}

static void test_unasked(void) {
    burnish_load_options options = burnish_load_options_default();
    CHECK1(!options.measure);
    OWNED_MESH *mesh = load_mesh(":sphere", &options);
    CHECK1(!burnish_mesh_get_facts(mesh) && !burnish_mesh_get_facts(NULL));
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_box());
    RUN(test_far_box());
    RUN(test_extreme_boxes());
    RUN(test_open_box());
    RUN(test_flipped());
    RUN(test_normals());
    RUN(test_builtin());
    RUN(test_threads());
    RUN(test_unasked());
    return test_end("measure");
}
