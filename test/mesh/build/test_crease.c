/* Generated normals of shapes whose normals are known: flat faces keep theirs, curved ones get the
 * surface's, and the format does not matter. */
#include <math.h>

#include "burnish/mesh.h"
#include "core/vec3.h"
#include "mesh_arrays.h"
#include "sheet.h"
#include "support.h"

#define PI 3.14159265358979323846

enum { CORNERS_MAX = 65536 };

typedef burnish_vec3 point;

/* A shape: its corners, and per corner the normal that it should get. */
static float positions[3 * CORNERS_MAX];
static point expected[CORNERS_MAX];
static uint32_t indices[CORNERS_MAX];
static size_t corner_count;

static void add_corner(point p, point normal) {
    if (!CHECK1(corner_count < CORNERS_MAX)) {
        return;
    }
    positions[3 * corner_count] = (float)p.x;
    positions[3 * corner_count + 1] = (float)p.y;
    positions[3 * corner_count + 2] = (float)p.z;
    expected[corner_count] = normal;
    indices[corner_count] = (uint32_t)corner_count;
    ++corner_count;
}

/* Triangles around the first point; normals NULL: flat. */
static void add_polygon(const point *points, const point *normals, int count) {
    const point flat = burnish_vec3_normalize(burnish_vec3_cross(
        burnish_vec3_sub(points[1], points[0]), burnish_vec3_sub(points[2], points[0])));
    for (int i = 1; i + 1 < count; ++i) {
        const int fan[3] = {0, i, i + 1};
        for (int k = 0; k < 3; ++k) {
            add_corner(points[fan[k]], normals ? normals[fan[k]] : flat);
        }
    }
}

static void add_quad(point a, point b, point c, point d) {
    const point points[4] = {a, b, c, d};
    add_polygon(points, NULL, 4);
}

/* ---- The check ---- */

/* Share of the corners whose normal is more than `tolerance` degrees away from the expected one. */
static double wrong_share(double tolerance) {
    const burnish_mesh_description arrays =
        describe_arrays(positions, NULL, NULL, corner_count, indices, corner_count / 3);
    size_t wrong = 0;
    OWNED_MESH *mesh = create_mesh(&arrays, NULL);
    if (!mesh) {
        return 1;
    }
    /* Fewer than 4,096 triangles keep their order. */
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    CHECK(3 * view->triangle_count == corner_count, "%zu triangles", view->triangle_count);
    for (size_t i = 0; i < corner_count && 3 * view->triangle_count == corner_count; ++i) {
        const float *n = view->normals + 3 * (size_t)view->indices[i];
        wrong +=
            burnish_vec3_dot((point){n[0], n[1], n[2]}, expected[i]) < cos(tolerance * PI / 180);
    }
    return (double)wrong / (double)corner_count;
}

/* ---- Parts with flat faces ---- */

/* A prism over a closed polygon, its top and bottom fans. */
static void make_prism(double (*polygon)[2], int count, double height, const point *sides) {
    point top[64] = {{0}}, bottom[64] = {{0}};
    for (int i = 0; i < count; ++i) {
        top[i] = (point){polygon[i][0], polygon[i][1], height};
        bottom[count - 1 - i] = (point){polygon[i][0], polygon[i][1], 0};
    }
    add_polygon(top, NULL, count);
    add_polygon(bottom, NULL, count);
    for (int i = 0; i < count; ++i) {
        const int j = (i + 1) % count;
        const point points[4] = {bottom[count - 1 - i], bottom[count - 1 - j], top[j], top[i]};
        if (sides) {
            const point normals[4] = {sides[i], sides[j], sides[j], sides[i]};
            add_polygon(points, normals, 4);
        } else {
            add_polygon(points, NULL, 4);
        }
    }
}

static void make_prism_or_cylinder(int sides, double height, int is_round) {
    double polygon[64][2];
    point normals[64];
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * PI * i / sides;
        polygon[i][0] = cos(angle);
        polygon[i][1] = sin(angle);
        normals[i] = (point){cos(angle), sin(angle), 0};
    }
    make_prism(polygon, sides, height, is_round ? normals : NULL);
}

static void make_regular_prism(int sides, double height) {
    make_prism_or_cylinder(sides, height, 0);
}

static void make_cylinder(int sides, double height) {
    make_prism_or_cylinder(sides, height, 1);
}

/* A prism whose upright edges are chamfered: the chamfer leaves x at `degrees`. */
static void make_chamfered_prism(int n, double degrees) {
    (void)n;
    const double w = 4, d = 4, c = 0.3, e = c * tan(degrees * PI / 180);
    double polygon[8][2] = {{c, 0},     {w - c, 0}, {w, e},     {w, d - e},
                            {w - c, d}, {c, d},     {0, d - e}, {0, e}};
    make_prism(polygon, 8, 1.5, NULL);
}

static point corner_of(const int signs[3], int axis, double half, double chamfer) {
    double p[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = signs[k] * (k == axis ? half : half - chamfer);
    }
    return (point){p[0], p[1], p[2]};
}

/* A cube with all 12 edges chamfered at 45 degrees, and triangles at its corners. */
static void add_outward(const point *points, int count) {
    point turned[4];
    const point flat = burnish_vec3_cross(burnish_vec3_sub(points[1], points[0]),
                                          burnish_vec3_sub(points[2], points[0]));
    for (int i = 0; i < count; ++i) {
        turned[i] = points[burnish_vec3_dot(flat, points[0]) < 0 ? count - 1 - i : i];
    }
    add_polygon(turned, NULL, count);
}

static void make_chamfered_cube(int n, double chamfer) {
    (void)n;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (int s = -1; s <= 1; s += 2) {
            point face[4];
            static const int around[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
            for (int k = 0; k < 4; ++k) {
                int signs[3];
                signs[axis] = s;
                signs[u] = around[k][0];
                signs[v] = around[k][1];
                face[k] = corner_of(signs, axis, 1, chamfer);
            }
            add_outward(face, 4);
            for (int t = -1; t <= 1; t += 2) { /* the edge along v between faces axis and u */
                int low[3], high[3];
                low[axis] = high[axis] = s;
                low[u] = high[u] = t;
                low[v] = -1;
                high[v] = 1;
                const point strip[4] = {
                    corner_of(low, axis, 1, chamfer), corner_of(high, axis, 1, chamfer),
                    corner_of(high, u, 1, chamfer), corner_of(low, u, 1, chamfer)};
                add_outward(strip, 4);
            }
        }
    }
    for (int i = 0; i < 8; ++i) {
        const int signs[3] = {i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1};
        const point corner[3] = {corner_of(signs, 0, 1, chamfer), corner_of(signs, 1, 1, chamfer),
                                 corner_of(signs, 2, 1, chamfer)};
        add_outward(corner, 3);
    }
}

/* A plate with a hexagonal hole. */
static void make_hexagon_hole(int n, double x) {
    (void)n, (void)x;
    for (int i = 0; i < 6; ++i) {
        const double a = PI / 3 * i, b = PI / 3 * (i + 1);
        const point inner[2] = {{cos(a), sin(a), 0}, {cos(b), sin(b), 0}};
        const point outer[2] = {burnish_vec3_scale(inner[0], 2), burnish_vec3_scale(inner[1], 2)};
        const point up = {0, 0, 1};
        const point inner_top[2] = {{cos(a), sin(a), up.z}, {cos(b), sin(b), up.z}};
        const point outer_top[2] = {{outer[0].x, outer[0].y, 1}, {outer[1].x, outer[1].y, 1}};
        add_quad(inner_top[0], outer_top[0], outer_top[1], inner_top[1]);
        add_quad(inner[1], outer[1], outer[0], inner[0]);
        add_quad(inner[1], inner[0], inner_top[0], inner_top[1]);
        add_quad(outer[0], outer[1], outer_top[1], outer_top[0]);
    }
}

/* A plate with a V-shaped pocket of flat facets: a groove that ends in a triangle. */
static void make_pocket(int n, double degrees) {
    (void)n;
    const double depth = tan(degrees * PI / 180);
    const point a = {-1, -3, 0}, b = {1, -3, 0}, c = {0, -3, -depth}, d = {0, 0, -depth};
    const point e = {0, 0.8, 0}, f = {-1, 0, 0}, g = {1, 0, 0};
    const point h = {-4, -3, 0}, i = {-4, 4, 0}, j = {4, 4, 0}, k = {4, -3, 0};
    add_quad(a, c, d, f);
    add_quad(c, b, g, d);
    add_polygon((const point[]){f, d, e}, NULL, 3);
    add_polygon((const point[]){d, g, e}, NULL, 3);
    add_quad(h, a, f, i);
    add_quad(e, j, i, f);
    add_polygon((const point[]){e, g, j}, NULL, 3);
    add_quad(g, b, k, j);
}

/* ---- Round ones ---- */

/* A block with its upright edges rounded in `steps`, tangent to the planes. */
static void make_filleted_block(int steps, double radius) {
    static const double centers[4][2] = {{2, 1}, {-2, 1}, {-2, -1}, {2, -1}};
    double polygon[64][2];
    point normals[64];
    int count = 0;
    for (int quarter = 0; quarter < 4; ++quarter) {
        for (int i = 0; i <= steps; ++i) {
            const double angle = PI / 2 * (quarter + (double)i / steps);
            normals[count] = (point){cos(angle), sin(angle), 0};
            polygon[count][0] = centers[quarter][0] + radius * cos(angle);
            polygon[count][1] = centers[quarter][1] + radius * sin(angle);
            ++count;
        }
    }
    make_prism(polygon, count, 3, normals);
}

static point on_sphere(double longitude, double latitude) {
    return (point){cos(longitude) * cos(latitude), sin(longitude) * cos(latitude), sin(latitude)};
}

static void add_smooth_triangle(point a, point b, point c) {
    const point points[3] = {a, b, c},
                normals[3] = {burnish_vec3_normalize(a), burnish_vec3_normalize(b),
                              burnish_vec3_normalize(c)};
    add_polygon(points, normals, 3);
}

static void make_sphere(int rows, double x) {
    (void)x;
    const int columns = 2 * rows;
    for (int row = 0; row < rows; ++row) {
        const double low = PI * row / rows - PI / 2, high = PI * (row + 1) / rows - PI / 2;
        for (int column = 0; column < columns; ++column) {
            const double a = 2 * PI * column / columns;
            const double b = 2 * PI * ((column + 1) % columns) / columns;
            const point south = {0, 0, -1}, north = {0, 0, 1};
            if (row == 0) {
                add_smooth_triangle(south, on_sphere(b, high), on_sphere(a, high));
            } else if (row == rows - 1) {
                add_smooth_triangle(on_sphere(a, low), on_sphere(b, low), north);
            } else {
                const point quad[4] = {on_sphere(a, low), on_sphere(b, low), on_sphere(b, high),
                                       on_sphere(a, high)};
                add_polygon(quad, quad, 4);
            }
        }
    }
}

static point middle(point a, point b) {
    return burnish_vec3_normalize((point){a.x + b.x, a.y + b.y, a.z + b.z});
}

static void split_triangle(point a, point b, point c, int level) {
    if (level == 0) {
        add_smooth_triangle(a, b, c);
        return;
    }
    const point d = middle(a, b), e = middle(b, c), f = middle(c, a);
    split_triangle(a, d, f, level - 1);
    split_triangle(d, b, e, level - 1);
    split_triangle(f, e, c, level - 1);
    split_triangle(d, e, f, level - 1);
}

/* An octahedron, split. */
static void make_geodesic(int level, double unused) {
    (void)unused;
    for (int i = 0; i < 8; ++i) {
        const point x = {i & 1 ? -1 : 1, 0, 0}, y = {0, i & 2 ? -1 : 1, 0};
        const point z = {0, 0, i & 4 ? -1 : 1};
        const int turned = (i ^ i >> 1 ^ i >> 2) & 1;
        split_triangle(x, turned ? z : y, turned ? y : z, level);
    }
}

/* A geodesic sphere with vertices moved in or out at random, like a decimated scan: its normals are
 * near the sphere's. */
static void make_noisy_sphere(int level, double noise) {
    make_geodesic(level, 0);
    for (size_t i = 0; i < 3 * corner_count; i += 3) {
        uint32_t words[3];
        memcpy(words, positions + i, sizeof words);
        /* By value: the same for all corners of a vertex. */
        uint64_t state = ((uint64_t)words[0] << 32 | words[1]) ^ (uint64_t)words[2] << 16;
        const double r = test_random32(&state) * 0x1p-32 - 0.5, size = 1 + noise * r;
        for (size_t k = i; k < i + 3; ++k) {
            positions[k] = (float)(positions[k] * size);
        }
    }
}

/* A rough dome on a rough base, like a decimated part: the rim between them is sharp. */
static void make_dome(int level, double noise) {
    make_noisy_sphere(level, noise);
    for (size_t i = 0; i < corner_count; ++i) {
        float *p = positions + 3 * i;
        const size_t first = i - i % 3; /* the triangle's; its corners were not yet moved up */
        const double x = (double)p[0], y = (double)p[1], z = (double)p[2];
        const double width = sqrt(x * x + y * y), r = sqrt(x * x + y * y + z * z);
        if (z < 0) {
            const double scale = width > 0 ? acos(-z / r) / (PI / 2) / width : 0;
            p[0] = (float)(x * scale);
            p[1] = (float)(y * scale);
            p[2] = (float)(-1e-3 - fabs(r - 1));
        }
        if (i % 3 == 2 && positions[3 * first + 2] + positions[3 * first + 5] + p[2] < 0) {
            expected[first] = expected[first + 1] = expected[i] = (point){0, 0, -1};
        }
    }
}

static point on_rod(int side, int ring) {
    static const double radii[] = {1, 1, 0.8}, heights[] = {0, 30, 30.2};
    uint64_t state = (uint64_t)(side % 32 + 100 * ring);
    test_random32(&state);
    const double a = PI / 16 * side, r = radii[ring] + 0.003 * test_random32(&state) * 0x1p-32;
    return (point){r * cos(a), r * sin(a), heights[ring]};
}

/* A long rod with a chamfer of 45 degrees and blunt ends, rough like a decimated part. */
static void make_rod(int sides, double x) {
    (void)x;
    for (int i = 0; i < sides; ++i) {
        for (int ring = 0; ring < 2; ++ring) {
            const point quad[4] = {on_rod(i, ring), on_rod(i + 1, ring), on_rod(i + 1, ring + 1),
                                   on_rod(i, ring + 1)};
            point normals[4];
            for (int k = 0; k < 4; ++k) {
                normals[k] = burnish_vec3_normalize((point){quad[k].x, quad[k].y, ring * 0.9});
            }
            add_polygon(quad, normals, 4);
        }
        const point down[3] = {{0, 0, -1}, {0, 0, -1}, {0, 0, -1}};
        const point up[3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
        add_polygon((const point[]){on_rod(i + 1, 0), on_rod(i, 0), {0, 0, -0.05}}, down, 3);
        add_polygon((const point[]){on_rod(i, 2), on_rod(i + 1, 2), {0, 0, 30.25}}, up, 3);
    }
}

/* The faces of cells that fill a cube, each once, wound at random. */
static void make_cells(int size, double x) {
    (void)x;
    for (int i = 0; i < 3 * size * size * size; ++i) {
        const int axis = i % 3, at[3] = {i / 3 % size, i / 3 / size % size, i / 3 / size / size};
        point corners[4];
        for (int k = 0; k < 4; ++k) {
            int p[3] = {at[0], at[1], at[2]};
            p[(axis + 1) % 3] += k == 1 || k == 2;
            p[(axis + 2) % 3] += k == 2 || k == 3;
            uint64_t state = (uint64_t)(p[0] + 100 * p[1] + 10000 * p[2]);
            double moved[3];
            for (int m = 0; m < 3; ++m) {
                moved[m] = p[m] + 0.15 * (test_random32(&state) * 0x1p-32 - 0.5);
            }
            corners[k] = (point){moved[0], moved[1], moved[2]};
        }
        if ((i ^ i >> 2 ^ i >> 5) & 1) {
            add_quad(corners[0], corners[1], corners[2], corners[3]);
        } else {
            add_quad(corners[3], corners[2], corners[1], corners[0]);
        }
    }
}

static void make_cone(int sides, double x) {
    (void)x;
    const point tip = {0, 0, 2};
    for (int i = 0; i < sides; ++i) {
        const double a = 2 * PI * i / sides, b = 2 * PI * ((i + 1) % sides) / sides;
        const point p = {cos(a), sin(a), 0}, q = {cos(b), sin(b), 0};
        const point points[3] = {p, q, tip};
        const point normals[3] = {burnish_vec3_normalize((point){2 * p.x, 2 * p.y, 1}),
                                  burnish_vec3_normalize((point){2 * q.x, 2 * q.y, 1}),
                                  {0, 0, 1}};
        add_polygon(points, normals, 3);
        add_polygon((const point[]){q, p, {0, 0, 0}}, NULL, 3);
    }
}

/* A cylinder whose rim has a chamfer of 45 degrees. Both are bands of triangles that bend at all
 * their edges, as the middle ring is half a step ahead. */
static void make_chamfered_rim(int sides, double chamfer) {
    point caps[2][64] = {{{0}}};
    for (int i = 0; i < sides; ++i) {
        point p[3][2], n[3][2], m[3][2];
        for (int k = 0; k < 6; ++k) {
            const int ring = k / 2, is_top = ring == 2;
            const double angle = 2 * PI * ((i + k % 2) % sides + (ring == 1) / 2.0) / sides;
            n[ring][k % 2] = (point){cos(angle), sin(angle), 0};
            m[ring][k % 2] = burnish_vec3_normalize((point){cos(angle), sin(angle), 1});
            p[ring][k % 2] = burnish_vec3_scale(n[ring][k % 2], 1 - is_top * chamfer);
            p[ring][k % 2].z = (ring > 0) + is_top * chamfer;
        }
        add_polygon((point[]){p[0][0], p[0][1], p[1][0]}, (point[]){n[0][0], n[0][1], n[1][0]}, 3);
        add_polygon((point[]){p[0][1], p[1][1], p[1][0]}, (point[]){n[0][1], n[1][1], n[1][0]}, 3);
        add_polygon((point[]){p[1][0], p[1][1], p[2][1]}, (point[]){m[1][0], m[1][1], m[2][1]}, 3);
        add_polygon((point[]){p[1][0], p[2][1], p[2][0]}, (point[]){m[1][0], m[2][1], m[2][0]}, 3);
        caps[0][sides - 1 - i] = p[0][0];
        caps[1][i] = p[2][0];
    }
    add_polygon(caps[0], NULL, sides);
    add_polygon(caps[1], NULL, sides);
}

/* ---- The shapes ---- */

/* make: with the numbers n and x. */
typedef struct shape {
    const char *name;
    void (*make)(int n, double x);
    int n;
    double x;
    double tolerance; /* degrees from the known normal */
    double share;     /* of corners that may be farther away */
} shape;

static const shape shapes[] = {
    {"octagonal prism", make_regular_prism, 8, 1, 0.1, 0},
    {"45-degree chamfers", make_chamfered_prism, 0, 45, 0.1, 0},
    {"30 and 60-degree chamfers", make_chamfered_prism, 0, 60, 0.1, 0},
    {"cube with chamfers", make_chamfered_cube, 0, 0.2, 0.1, 0},
    {"hexagonal hole", make_hexagon_hole, 0, 0, 0.1, 0},
    {"pocket of 25 degrees", make_pocket, 0, 25, 0.1, 0},
    {"pocket of 35 degrees", make_pocket, 0, 35, 0.1, 0},
    {"fillet in 3 steps", make_filleted_block, 3, 0.2, 1, 0},
    {"fillet in 12 steps", make_filleted_block, 12, 0.2, 1, 0},
    {"cylinder of 12 sides", make_cylinder, 12, 4, 1, 0},
    {"cylinder of 16", make_cylinder, 16, 4, 1, 0},
    {"cylinder of 24", make_cylinder, 24, 4, 1, 0},
    {"cylinder of 64", make_cylinder, 64, 4, 1, 0},
    {"low disc of 12 sides", make_cylinder, 12, 0.1, 1, 0},
    {"cone of 12 sides", make_cone, 12, 0, 4, 0},
    {"cone of 32 sides", make_cone, 32, 0, 4, 0},
    {"rim with a chamfer", make_chamfered_rim, 24, 0.1, 4, 0},
    {"sphere of 12 x 6", make_sphere, 6, 0, 8, 0},
    {"sphere of 16 x 8", make_sphere, 8, 0, 4, 0},
    {"sphere of 48 x 24", make_sphere, 24, 0, 1, 0},
    {"geodesic sphere of 32", make_geodesic, 1, 0, 8, 0},
    {"geodesic sphere of 128", make_geodesic, 2, 0, 4, 0},
    {"geodesic sphere of 2,048", make_geodesic, 4, 0, 1, 0},
    {"noisy sphere of 128", make_noisy_sphere, 2, 0.12, 25, 0.02},
    {"noisy sphere of 512", make_noisy_sphere, 3, 0.1, 30, 0.02},
    {"noisy sphere of 2,048", make_noisy_sphere, 4, 0.05, 30, 0.02},
    {"rough dome on its base", make_dome, 4, 0.02, 30, 0.02},
    {"rough rod with a chamfer", make_rod, 32, 0, 15, 0.02},
    {"faces of cells", make_cells, 6, 0, 25, 0.02},
};

enum { SHAPES = sizeof shapes / sizeof *shapes };

static void test_shape(const shape *s) {
    corner_count = 0;
    s->make(s->n, s->x);
    const double share = wrong_share(s->tolerance);
    CHECK(share <= s->share, "%s: %.1f %% of %zu corners are wrong", s->name, 100 * share,
          corner_count);
}

/* ---- Formats ---- */

/* One sheet as STL, OBJ and PLY has the same normals, bit for bit. */
static void test_formats(void) {
    static void (*const writers[])(file_bytes *, const sheet *) = {write_stl, write_obj, write_ply};
    static const char *const names[] = {"a.stl", "a.obj", "a.ply"};
    burnish_mesh *meshes[3];
    for (int i = 0; i < 3; ++i) {
        file_bytes file = {0};
        writers[i](&file, &(sheet){.side = 40, .newline = "\n", .end = i == 0 ? NULL : ""});
        meshes[i] = load_bytes(file.bytes, file.size, names[i], NULL);
        free(file.bytes);
        CHECK(same_meshes(meshes[0], meshes[i]), "%s", names[i]);
    }
    for (int i = 0; i < 3; ++i) {
        burnish_mesh_destroy(meshes[i]);
    }
}

/* The steep edges of a rough surface are noise: nearly all of its 1,026 positions have one normal.
 */
static void test_rough(void) {
    corner_count = 0;
    make_noisy_sphere(4, 0.12);
    const burnish_mesh_description arrays =
        describe_arrays(positions, NULL, NULL, corner_count, indices, corner_count / 3);
    OWNED_MESH *mesh = create_mesh(&arrays, NULL);
    if (mesh) {
        const size_t count = burnish_mesh_get_view(mesh)->vertex_count;
        CHECK(count < 1150, "%zu vertices", count);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    for (int i = 0; i < SHAPES; ++i) {
        RUN(test_shape(&shapes[i]));
    }
    RUN(test_rough());
    RUN(test_formats());
    return test_end("crease");
}
