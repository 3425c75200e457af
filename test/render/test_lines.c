/* Lines against analytic pictures: which edges of boxes show and where hidden parts end, the circle
 * that a sphere's silhouette is, SVG against the lines; edges of meshes against their facts. */
#include <math.h>

#include "burnish/drawing.h"
#include "burnish/look.h"
#include "mesh/edges.h"
#include "pictures.h"
#include "render/lines/lines.h"
#include "render/lines/lines_steps.h"
#include "shapes.h"
#include "svg_path.h"
#include "vec.h"

enum { SIZE = 400 };

static burnish_error error;

/* A drawing, whose renderer and lines the test looks at. */
typedef struct drawn {
    burnish_mesh *mesh;
    burnish_render_options options;
    burnish_renderer *renderer;
    burnish_image image;
    const burnish_lines *lines;
} drawn;

/* A square picture from a position, z up or, along z, y. */
static burnish_render_options make_options(const double position[3], double height, int edges) {
    burnish_render_options options = burnish_render_options_default();
    CHECK_OK(burnish_render_options_set_look(&options, BURNISH_LOOK_DRAWING, &error), error);
    memcpy(options.camera.position, position, sizeof options.camera.position);
    options.camera.orthographic_height = height;
    options.camera.view_up[1] = position[0] == 0 && position[1] == 0;
    options.camera.view_up[2] = options.camera.view_up[1] == 0;
    options.width = options.height = SIZE;
    options.edges = edges;
    options.threads = 1;
    return options;
}

static void draw_again(drawn *d) {
    CHECK_OK(burnish_renderer_draw(d->renderer, d->mesh, &d->options, &d->image, NULL, &error),
             error);
    d->lines = burnish_renderer_get_lines(d->renderer);
}

static drawn draw(burnish_mesh *mesh, burnish_render_options options) {
    drawn d = {.mesh = mesh, .options = options, .renderer = make_renderer(NULL)};
    CHECK_OK(burnish_look_set_materials(BURNISH_LOOK_DRAWING, mesh, &error), error);
    draw_again(&d);
    return d;
}

static drawn draw_shape(const shape *s, const double position[3], double height, int edges) {
    return draw(create_shape(s), make_options(position, height, edges));
}

static void drop(drawn *d) {
    burnish_image_destroy(&d->image);
    burnish_renderer_destroy(d->renderer);
    burnish_mesh_destroy(d->mesh);
}

/* ---- A camera of the test's own ---- */

typedef struct screen {
    double x, y;
} screen;

static screen project(const burnish_render_options *options, const double p[3]) {
    const burnish_camera *camera = &options->camera;
    double forward[3], right[3], up[3], v[3];
    for (int k = 0; k < 3; ++k) {
        forward[k] = camera->focal_point[k] - camera->position[k];
        v[k] = p[k] - camera->position[k];
    }
    cross(forward, camera->view_up, right);
    cross(right, forward, up);
    const double f = sqrt(dot(forward, forward)), r = sqrt(dot(right, right)),
                 u = sqrt(dot(up, up)), distance = dot(v, forward) / f;
    const double height = camera->orthographic_height > 0
                              ? camera->orthographic_height
                              : 2 * distance * tan(camera->view_angle * acos(-1) / 360);
    const double pixels = options->height / height;
    return (screen){options->width / 2.0 + dot(v, right) / r * pixels,
                    options->height / 2.0 - dot(v, up) / u * pixels};
}

/* How far a point is from a segment. */
static double distance_to(screen a, screen b, double x, double y) {
    const double ex = b.x - a.x, ey = b.y - a.y, square = ex * ex + ey * ey;
    double t = square > 0 ? ((x - a.x) * ex + (y - a.y) * ey) / square : 0;
    t = fmin(fmax(t, 0), 1);
    return hypot(x - a.x - t * ex, y - a.y - t * ey);
}

/* The share of a segment that lines cover, to 1/8 pixel. */
static double covered(const burnish_lines *lines, screen a, screen b) {
    const double length = hypot(b.x - a.x, b.y - a.y);
    const int steps = (int)(8 * length) + 1;
    int count = 0;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) / steps, x = a.x + t * (b.x - a.x), y = a.y + t * (b.y - a.y);
        int found = 0;
        for (size_t l = 0; l < lines->line_count && !found; ++l) {
            for (size_t k = lines->starts[l]; k + 1 < lines->starts[l + 1] && !found; ++k) {
                const float *p = lines->points + 2 * k;
                const screen from = {(double)p[0], (double)p[1]}, to = {(double)p[2], (double)p[3]};
                found = distance_to(from, to, x, y) < 0.1;
            }
        }
        count += found;
    }
    return length * count / steps;
}

static double length_of_lines(const burnish_lines *lines) {
    double length = 0;
    for (size_t l = 0; l < lines->line_count; ++l) {
        for (size_t k = lines->starts[l]; k + 1 < lines->starts[l + 1]; ++k) {
            const float *p = lines->points + 2 * k;
            length += hypot((double)p[2] - (double)p[0], (double)p[3] - (double)p[1]);
        }
    }
    return length;
}

/* ---- Boxes ---- */

/* End `end` of edge `edge` of the box from low to high. */
static void box_corner(const double low[3], const double high[3], int edge, int end, double p[3]) {
    const int axis = edge / 4, a = (axis + 1) % 3, b = (axis + 2) % 3;
    p[axis] = end ? high[axis] : low[axis];
    p[a] = edge & 1 ? high[a] : low[a];
    p[b] = edge & 2 ? high[b] : low[b];
}

/* 9 edges of a cube show, in their whole length and at their place; 3 leave no ink. The same of a
 * taller box that was cut: what is inside of it hides behind the cap. */
static void test_cube(double height, int is_cut) {
    static const double low[3] = {-1, -1, -1}, high[3] = {1, 1, 1}, position[3] = {6, -9, 5};
    const shape s = box_at(-1, -1, -1, 2, 2, is_cut ? 4 : 2);
    burnish_mesh *mesh = create_shape(&s);
    if (is_cut) {
        cut_mesh(mesh, 0, 0, 1, 1);
    }
    drawn d = draw(mesh, make_options(position, height, BURNISH_EDGES_FEATURES));
    int seen = 0, hidden = 0;
    double sum = 0;
    for (int edge = 0; edge < 12; ++edge) {
        double p[2][3], outside = 0, middle[3];
        for (int end = 0; end < 2; ++end) {
            box_corner(low, high, edge, end, p[end]);
        }
        /* Seen where one of the edge's faces is: the eye is beyond the plane of a face. */
        for (int k = 0; k < 3; ++k) {
            const double far = height > 0 ? 1e9 : 1; /* parallel: from far away */
            middle[k] = (p[0][k] + p[1][k]) / 2;
            outside = fmax(outside, middle[k] != 0 ? position[k] * far / middle[k] - 1 : 0);
        }
        const screen a = project(&d.options, p[0]), b = project(&d.options, p[1]);
        const double length = hypot(b.x - a.x, b.y - a.y), on = covered(d.lines, a, b);
        if (outside > 0) {
            CHECK(on > length - (is_cut ? 1 : 0.5), "edge %d: %g of %g pixels", edge, on, length);
            sum += length;
            ++seen;
        } else {
            CHECK(on < 2, "hidden edge %d: %g of %g pixels", edge, on, length);
            const int x = (int)((a.x + b.x) / 2), y = (int)((a.y + b.y) / 2);
            CHECK(is_cut || d.image.pixels[3 * (y * SIZE + x)] == 255, "ink on hidden edge %d",
                  edge);
            ++hidden;
        }
    }
    CHECK(seen == 9 && hidden == 3, "%d and %d", seen, hidden);
    for (size_t i = 0; i < d.lines->line_count; ++i) {
        CHECK1(d.lines->widths[i] == d.options.edge_width);
    }
    CHECK(fabs(length_of_lines(d.lines) - sum) < 1, "%g pixels of lines, expected %g",
          length_of_lines(d.lines), sum);
    drop(&d);
}

/* The three hidden edges of a cube are dashed from end to end, with gaps of 4 widths between dashes
 * of 11, scaled to the length. */
static void test_dashes(double height) {
    static const double low[3] = {-1, -1, -1}, high[3] = {1, 1, 1}, position[3] = {6, -9, 5};
    static const int edges[3] = {1, 4, 10}; /* those of the corner -1, 1, -1 */
    const int kinds = BURNISH_EDGES_FEATURES | BURNISH_EDGES_HIDDEN;
    const shape s = box_at(-1, -1, -1, 2, 2, 2);
    drawn d = draw_shape(&s, position, height, kinds);
    const double period = 15 * 0.5 * (double)d.options.edge_width;
    for (int i = 0; i < 3; ++i) {
        double p[2][3];
        box_corner(low, high, edges[i], 0, p[0]);
        box_corner(low, high, edges[i], 1, p[1]);
        const screen a = project(&d.options, p[0]), b = project(&d.options, p[1]);
        const double length = hypot(b.x - a.x, b.y - a.y), on = covered(d.lines, a, b);
        const double count = floor((length + period * 4 / 15) / period + 0.5);
        const double expected = length * 11 * count / (15 * count - 4);
        CHECK(fabs(on - expected) < 3, "edge %d: %g of %g pixels", i, on, expected);
        for (int end = 0; end < 2; ++end) {
            const double t = 5 / length, u = end ? t : 1 - t;
            const screen near = {a.x + u * (b.x - a.x), a.y + u * (b.y - a.y)};
            CHECK(covered(d.lines, end ? a : b, near) > 4, "edge %d, end %d", i, end);
        }
    }
    drop(&d);
}

enum { SIDES = 24 };

/* A prism around z. Each third upper corner is moved outward. */
static shape make_prism(double moved) {
    shape s = {.point_count = 0};
    for (int i = 0; i < SIDES; ++i) {
        const double angle = 2 * acos(-1) * i / SIDES, r = 1 + moved * (i % 3 == 0);
        add_point(&s, cos(angle), sin(angle), -1); /* 2 i, and 2 i + 1 above it */
        add_point(&s, r * cos(angle), r * sin(angle), 1);
    }
    for (uint32_t i = 0; i < SIDES; ++i) {
        const uint32_t next = (i + 1) % SIDES;
        add_quad(&s, 2 * i, 2 * next, 2 * next + 1, 2 * i + 1);
        if (i > 0 && next > 0) {
            add_triangle(&s, 1, 2 * i + 1, 2 * next + 1);
            add_triangle(&s, 0, 2 * next, 2 * i);
        }
    }
    return s;
}

/* A circle behind a box is dashed all around, though some of its walls are silhouettes: they are too
 * short to be drawn. */
static void test_hidden_circle(void) {
    static const double position[3] = {0, 0, 9};
    shape s = make_prism(1e-3);
    add_box(&s, (const double[]){-2, -2, 2}, (const double[]){2, 2, 3});
    drawn d = draw_shape(&s, position, 5, BURNISH_EDGES_FEATURES | BURNISH_EDGES_HIDDEN);
    const double length = SIDES * 2 * sin(acos(-1) / SIDES) * SIZE / 5;
    const double count = floor(length / (7.5 * (double)d.options.edge_width) + 0.5);
    const double expected = 16 * SIZE / 5.0 + length * 11 * count / (15 * count - 4);
    const double sum = length_of_lines(d.lines);
    CHECK(fabs(sum - expected) < 3, "%g pixels, expected %g", sum, expected);
    drop(&d);
}

/* The axis of a prism: a chain line from the side, a cross along it, 12 widths longer at each end than
 * the prism is high or wide. */
static void test_centers(int is_along) {
    const double position[3] = {0, is_along ? 0 : -9, is_along ? 9 : 0};
    const shape s = make_prism(0);
    drawn d = draw_shape(&s, position, 4, BURNISH_EDGES_FEATURES);
    const double bare = length_of_lines(d.lines);
    d.options.edges |= BURNISH_EDGES_CENTERS;
    draw_again(&d);
    const double width = 0.5 * (double)d.options.edge_width, over = 12 * width;
    const double reach = 1.0 * SIZE / 4 + over, length = 2 * reach;
    const double count = floor((length + 8 * width) / (31 * width) + 0.5);
    const double expected = length * 23 * count / (31 * count - 8);
    const double sum = length_of_lines(d.lines) - bare;
    CHECK(fabs(sum - (is_along ? 2 : 1) * expected) < 2, "%g pixels, expected %g", sum, expected);
    const screen middle = {SIZE / 2.0, SIZE / 2.0};
    const screen end = {middle.x, middle.y - reach}, near = {middle.x, middle.y - reach + 5};
    CHECK(covered(d.lines, end, near) > 4, "%g", covered(d.lines, end, near));
    drop(&d);
}

/* A sheet bent by a right angle: thin lines where the bend meets flat parts, if there are some, which
 * end before the sheet's borders; none within it. */
static void test_tangents(int is_flat) {
    enum { LAST = 8 };
    static const double position[3] = {6, -9, 5};
    const burnish_edge_flags edges = BURNISH_EDGES_FEATURES | BURNISH_EDGES_TANGENTS;
    shape s = {.point_count = 0};
    double points[2 * LAST + 2][3];
    for (int i = 0; i < 2 * LAST + 2; ++i) {
        const int row = i / 2;
        const double turn =
            is_flat ? fmin(fmax(row - 1, 0), LAST - 2) / (LAST - 2) : (double)row / LAST;
        points[i][0] = sin(acos(-1) / 2 * turn) - is_flat * (row == 0);
        points[i][1] = i % 2;
        points[i][2] = cos(acos(-1) / 2 * turn) - is_flat * (row == LAST);
        add_point(&s, points[i][0], points[i][1], points[i][2]);
    }
    for (uint32_t i = 0; i < LAST; ++i) {
        add_quad(&s, 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1);
    }
    drawn d = draw_shape(&s, position, 6, (int)edges);
    for (int i = 1; i < LAST; ++i) {
        const screen a = project(&d.options, points[2 * i]);
        const screen b = project(&d.options, points[2 * i + 1]);
        const int is_tangent = is_flat && (i == 1 || i == LAST - 1);
        const double whole = hypot(b.x - a.x, b.y - a.y) - 4 * (double)d.options.edge_width;
        CHECK(fabs(covered(d.lines, a, b) - is_tangent * whole) < 1.5, "edge %d", i);
    }
    drop(&d);
}

/* Of a plate's upper edge, seen along y, a box before it hides the part between its sides, which are
 * upright or cross the edge at 14 degrees. */
static void test_hidden_part(double slope) {
    static const double back[2][3] = {{-2, 1, -1}, {2, 1.5, 1}};
    static const double front[2][3] = {{-0.53, -1, -1.5}, {0.71, 0, 1.5}};
    static const double position[3] = {0, -10, 0};
    shape s = {.point_count = 0};
    add_box(&s, back[0], back[1]);
    add_box(&s, front[0], front[1]);
    for (float *p = s.points + 24; p < s.points + 48; p += 3) {
        p[0] += (float)slope * (p[2] - 1);
    }
    drawn d = draw_shape(&s, position, 5, BURNISH_EDGES_FEATURES);
    for (int side = 0; side < 2; ++side) {
        const double x = front[side][0];
        for (int step = -1; step <= 1; step += 2) { /* two pixels before the end and beyond it */
            const double at[3] = {x + step * 2 * 5.0 / SIZE, 1, 1};
            const double further[3] = {x + step * 3 * 5.0 / SIZE, 1, 1};
            const double on =
                covered(d.lines, project(&d.options, at), project(&d.options, further));
            const int is_seen = step == (side ? 1 : -1);
            CHECK(is_seen ? on > 0.9 : on < 0.1, "side %d, %d: %g", side, step, on);
        }
    }
    drop(&d);
}

/* Along an axis each hidden edge of a box is behind a visible one. A box on a plate, seen from above,
 * is one grey without its edges; they are drawn, as wide as its outline. */
static void test_along_axis(int is_step) {
    const double position[3] = {0, is_step ? 0 : -9, is_step ? 10 : 0};
    shape s = box_at(-1, -1, -1, 2, 2, 2);
    if (is_step) {
        add_box(&s, (const double[]){-2, -2, -1}, (const double[]){2, 2, 0});
    }
    drawn d = draw_shape(&s, position, 5, BURNISH_EDGES_FEATURES | BURNISH_EDGES_HIDDEN);
    const double length = length_of_lines(d.lines);
    CHECK(fabs(length - (is_step ? 24 : 8) * SIZE / 5.0) < 2, "%g pixels", length);
    for (size_t i = 0; i < d.lines->line_count; ++i) {
        CHECK1(d.lines->widths[i] == d.options.edge_width);
    }
    drop(&d);
}

/* ---- A sphere, a grid ---- */

/* In perspective the silhouette of a sphere at distance d has the radius of tan(asin(r / d)). */
static void test_sphere(void) {
    static const double position[3] = {3, -5, 1};
    burnish_mesh *mesh = load_measured(":sphere", 96);
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    const double r = ((double)view->bounds_max[0] - (double)view->bounds_min[0]) / 2;
    burnish_render_options options = make_options(position, 0, BURNISH_EDGES_FEATURES);
    for (int k = 0; k < 3; ++k) {
        options.camera.position[k] *= r;
    }
    drawn d = draw(mesh, options);
    const double radius =
        tan(asin(1 / sqrt(35.0))) / tan(options.camera.view_angle * acos(-1) / 360) * SIZE / 2;
    for (size_t i = 0; i < d.lines->point_count; ++i) {
        const double at = hypot((double)d.lines->points[2 * i] - SIZE / 2.0,
                                (double)d.lines->points[2 * i + 1] - SIZE / 2.0);
        CHECK(fabs(at - radius) < 0.35, "point %zu: %g from the middle, expected %g", i, at,
              radius);
    }
    CHECK(fabs(length_of_lines(d.lines) / (2 * acos(-1) * radius) - 1) < 0.02,
          "a circle of %g pixels, expected %g", length_of_lines(d.lines), 2 * acos(-1) * radius);
    drop(&d);
}

static shape *make_grid(int n) {
    shape *s = calloc(1, sizeof *s);
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) {
            add_point(s, x - n / 2.0, y - n / 2.0, 0);
        }
    }
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const uint32_t a = (uint32_t)(y * (n + 1) + x), w = (uint32_t)n + 1;
            add_quad(s, a, a + 1, a + w + 1, a + w);
        }
    }
    return s;
}

/* n x n squares have 2 n (n + 1) sides and n^2 diagonals; only the border is a feature. The first
 * picture has no lines: no array exists. */
static void test_grid(void) {
    enum { N = 6 };
    static const double position[3] = {0, 0, 10};
    shape *s = make_grid(N);
    drawn d = draw_shape(s, position, N + 1, BURNISH_EDGES_MATERIALS);
    CHECK1(d.lines->line_count == 0);
    d.options.edges = BURNISH_EDGES_ALL;
    draw_again(&d);
    const double pixel = SIZE / (N + 1.0);
    double expected = (2 * N * (N + 1) + N * N * sqrt(2)) * pixel;
    /* at two corners no diagonal ends: the line goes on */
    CHECK(d.lines->line_count == 2 * N * (N + 1) + N * N - 2, "%zu lines", d.lines->line_count);
    CHECK(fabs(length_of_lines(d.lines) - expected) < 0.01 * expected, "%g pixels, expected %g",
          length_of_lines(d.lines), expected);
    d.options.edges = BURNISH_EDGES_BOUNDARIES;
    draw_again(&d);
    CHECK(fabs(length_of_lines(d.lines) - 4 * N * pixel) < 1, "%g pixels of boundary",
          length_of_lines(d.lines));
    d.options.edges = BURNISH_EDGES_CREASES | BURNISH_EDGES_MATERIALS;
    draw_again(&d);
    CHECK(d.lines->line_count == 0, "%zu lines on a plane", d.lines->line_count);
    d.options.edges = 0;
    draw_again(&d);
    CHECK1(d.lines->line_count == 0);
    drop(&d);
    free(s);
}

/* A triangle that is wound against its neighbours makes no line. */
static void test_flipped(void) {
    static const double position[3] = {6, -9, 5};
    shape s = box_at(-1, -1, -1, 2, 2, 2);
    double lengths[2];
    for (int i = 0; i < 2; ++i) {
        drawn d = draw_shape(&s, position, 0, BURNISH_EDGES_FEATURES);
        lengths[i] = length_of_lines(d.lines);
        drop(&d);
        for (int t = 0; t < 12; t += 5) {
            turn(&s, (size_t)t);
        }
    }
    CHECK(fabs(lengths[0] - lengths[1]) < 1, "%g and %g pixels", lengths[0], lengths[1]);
}

/* Along an axis and in parallel projection AXIS_VIEWS are features, elsewhere nothing. */
static void test_axis_views(void) {
    static const double along[3] = {0, -9, 0}, aslant[3] = {1, -9, 0};
    const shape s = box_at(-1, -1, -1, 2, 2, 2);
    for (int i = 0; i < 3; ++i) {
        drawn d = draw_shape(&s, i == 1 ? aslant : along, i == 2 ? 0 : 4, BURNISH_EDGES_AXIS_VIEWS);
        CHECK(fabs(length_of_lines(d.lines) - (i == 0 ? 4 * SIZE / 2.0 : 0)) < 0.5,
              "view %d: %g pixels", i, length_of_lines(d.lines));
        CHECK1(i > 0 || (d.lines->widths[0] < d.options.edge_width && d.lines->opacity < 1));
        drop(&d);
    }
}

/* ---- Noise ---- */

/* Which of some lines of two points stay with limits of 5, 10, 20 and 30 pixels. */
static void test_loose(void) {
    static const struct {
        float x0, y0, x1, y1;
        int is_rim, is_feature, stays;
    } rows[] = {
        {10, 10, 15, 10, 0, 1, 0},   /* alone */
        {50, 10, 75, 10, 0, 1, 1},   /* alone, but long */
        {110, 10, 135, 10, 0, 0, 0}, /* the same, without a feature */
        {150, 10, 181, 10, 0, 0, 1}, /* longer */
        {10, 30, 13, 30, 1, 0, 1},   /* at a rim */
        {40, 40, 48, 40, 0, 1, 1},    {48, 40, 48, 47, 0, 1, 1},
        {48, 47, 40.5f, 47, 0, 1, 1}, {40.5f, 47, 40, 40, 0, 1, 1},    /* a ring */
        {110, 40, 112, 40, 0, 1, 0},  {112, 40, 110, 40.5f, 0, 1, 0},  /* a tiny one */
        {10, 60, 19, 60, 0, 1, 0},    {19.5f, 60.5f, 26, 60, 0, 1, 0}, /* 15 pixels */
        {60, 60, 72, 60, 0, 1, 1},    {72, 60.9f, 84, 61, 0, 1, 1},    /* 24 pixels */
        {150, 80, 181, 80, 0, 2, 0},                                   /* a tangent edge */
        {10, 80, 35, 80, 0, 1, 1},    {36, 80, 46, 88, 0, 1, 1},       /* at a long one */
        {20, 80, 20, 87, 0, 1, 0},                                     /* a tick along it */
        {60, 80, 66, 80, 0, 1, 0},    {72, 80, 78, 80, 0, 1, 0},
        {84, 80, 90, 80, 0, 1, 0}, /* too far apart */
        {110, 60, 160, 60, 0, 1, 1},  {135, 61, 135, 66, 0, 1, 1},
        {110, 67, 160, 67, 0, 1, 1}, /* between two */
    };
    enum { COUNT = sizeof rows / sizeof *rows };
    float points[4 * COUNT], widths[COUNT];
    uint32_t starts[COUNT + 1];
    uint8_t is_rim[COUNT];
    for (size_t i = 0; i < COUNT; ++i) {
        memcpy(points + 4 * i, &rows[i].x0, 4 * sizeof *points);
        widths[i] = rows[i].is_feature == 2 ? 1 : rows[i].is_feature ? 1.2f : 2;
        starts[i] = (uint32_t)(2 * i);
        is_rim[i] = (uint8_t)rows[i].is_rim;
    }
    starts[COUNT] = 2 * COUNT;
    burnish_line_art art = {.points = points, .starts = starts, .widths = widths, .is_rim = is_rim};
    art.lines = (burnish_lines){.width = 200,
                                .height = 100,
                                .line_count = COUNT,
                                .starts = starts,
                                .points = points,
                                .point_count = 2 * COUNT,
                                .widths = widths};
    burnish_memory memory = burnish_memory_of(NULL, &error);
    const burnish_line_limits limits = {
        .tick = 10, .least = 5, .set = 20, .fold = 30, .outline = 2};
    burnish_line_art_drop_loose(&art, &limits, &memory);
    size_t at = 0;
    for (size_t i = 0; i < COUNT; ++i) {
        const int stays = at < art.lines.line_count &&
                          memcmp(points + 2 * starts[at], &rows[i].x0, 4 * sizeof *points) == 0;
        CHECK(stays == rows[i].stays, "line %zu", i);
        if (stays) {
            CHECK1(widths[at] == (rows[i].is_feature ? 1.2f : 2.0f));
            ++at;
        }
    }
    CHECK1(at == art.lines.line_count && art.lines.point_count == 2 * at && starts[at] == 2 * at);
}

/* ---- SVG ---- */

/* Every line's points come back. */
static void test_svg(void) {
    static const double position[3] = {6, -9, 5};
    static svg_path read;
    burnish_mesh *mesh = load_measured(":teapot", 8);
    burnish_render_options options = make_options(position, 4, BURNISH_EDGES_FEATURES);
    char *text = NULL;
    size_t size = 0, found = 0;
    options.camera = framed_options(mesh, SIZE, SIZE).camera;
    drawn d = draw(mesh, options);
    burnish_drawing *drawing = NULL;
    CHECK_OK(burnish_drawing_create(NULL, SIZE, SIZE, &drawing, &error), error);
    CHECK_OK(burnish_renderer_trace(d.renderer, mesh, &options, drawing, &error), error);
    CHECK_OK(burnish_drawing_encode_svg(drawing, "a<b>&\"c\n", options.background, 0, &text, &size,
                                        &error),
             error);
    CHECK1(strlen(text) == size && strstr(text, "<title>a&lt;b&gt;&amp;&quot;c </title>") &&
           strstr(text, "width=\"400\" height=\"400\" viewBox=\"0 0 400 400\"") &&
           strstr(text, "fill=\"#ffffff\""));
    for (const char *tag = text; (tag = strstr(tag, "<path")) != NULL; ++tag) {
        const double wide = strtod(attribute(tag, "stroke-width"), NULL);
        svg_read_path(attribute(tag, "d"), &read);
        const double(*points)[2] = (const double(*)[2])read.points;
        const size_t count = read.starts[read.count];
        size_t at = 0;
        for (size_t l = 0; l < d.lines->line_count; ++l) {
            if (fabs((double)d.lines->widths[l] - wide) > 0.006) {
                continue;
            }
            ++found;
            for (size_t k = d.lines->starts[l]; k < d.lines->starts[l + 1]; ++k) {
                const float *p = d.lines->points + 2 * k;
                if (at < count && fabs(points[at][0] - (double)p[0]) < 0.0052 &&
                    fabs(points[at][1] - (double)p[1]) < 0.0052) {
                    ++at;
                } else { /* equal to the one before */
                    CHECK(at > 0 && fabs(points[at - 1][0] - (double)p[0]) < 0.0052 &&
                              fabs(points[at - 1][1] - (double)p[1]) < 0.0052,
                          "line %zu, point %zu: %g, %g", l, k, (double)p[0], (double)p[1]);
                }
            }
        }
        CHECK(at == count, "%zu points of %zu", at, count);
    }
    CHECK(found == d.lines->line_count && found > 10, "%zu of %zu lines", found,
          d.lines->line_count);
    burnish_release(NULL, text);
    burnish_drawing_destroy(drawing);
    drop(&d);
}

/* ---- Edges of meshes ---- */

/* As many edges, and as many open ones, as facts count. */
static void test_edges(burnish_mesh *mesh) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    const burnish_mesh_facts *facts = burnish_mesh_get_facts(mesh);
    burnish_memory memory = burnish_memory_of(NULL, &error);
    burnish_edges edges;
    CHECK1(burnish_edges_find(view, NULL, &memory, &edges) == BURNISH_STATUS_OK);
    size_t open = 0;
    for (size_t i = 0; i < edges.count; ++i) {
        const burnish_edge *edge = &edges.items[i];
        open += edge->triangles[1] == BURNISH_EDGE_OPEN;
        for (int t = 0; t < 2 && edge->triangles[t] != BURNISH_EDGE_OPEN; ++t) {
            int at[2] = {-1, -1};
            for (int k = 0; k < 3; ++k) {
                const float *p = view->positions + 3 * view->indices[3 * edge->triangles[t] + k];
                for (int e = 0; e < 2; ++e) {
                    const float *q = view->positions + 3 * edge->ends[e];
                    at[e] = memcmp(p, q, 3 * sizeof *p) == 0 ? k : at[e];
                }
            }
            const int along = (at[0] + 1) % 3 == at[1];
            CHECK1(at[0] >= 0 && at[1] >= 0);
            CHECK1(along == (t == 0 || (edge->flags & BURNISH_EDGE_ALIKE) != 0));
        }
    }
    CHECK(edges.count == facts->edge_count && open == facts->open_edge_count,
          "%zu edges, %zu open; expected %zu and %zu", edges.count, open, facts->edge_count,
          facts->open_edge_count);
    burnish_release(NULL, edges.items);
    burnish_mesh_destroy(mesh);
}

static burnish_mesh *random_mesh(void) {
    static float positions[60][3];
    static uint32_t corners[150][3];
    burnish_load_options options = burnish_load_options_default();
    uint32_t seed = 7;
    options.measure = 1;
    for (int i = 0; i < 180; ++i) {
        seed = seed * 1664525u + 1013904223u;
        positions[i / 3][i % 3] = (float)(seed >> 8);
    }
    for (int i = 0; i < 150; ++i) {
        for (int k = 0; k < 3; ++k) {
            seed = seed * 1664525u + 1013904223u;
            corners[i][k] = (seed >> 16) % 20 * 3 + (uint32_t)k; /* three that differ */
        }
    }
    const burnish_mesh_description arrays =
        describe_arrays(positions[0], NULL, NULL, 60, corners[0], 150);
    return create_mesh(&arrays, &options);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_cube(0, 0));
    RUN(test_cube(4, 0));
    RUN(test_cube(0, 1));
    RUN(test_cube(4, 1));
    RUN(test_dashes(0));
    RUN(test_dashes(4));
    RUN(test_along_axis(0));
    RUN(test_along_axis(1));
    RUN(test_tangents(0));
    RUN(test_tangents(1));
    RUN(test_centers(0));
    RUN(test_centers(1));
    RUN(test_hidden_part(0));
    RUN(test_hidden_part(4));
    RUN(test_hidden_circle());
    RUN(test_sphere());
    RUN(test_grid());
    RUN(test_flipped());
    RUN(test_axis_views());
    RUN(test_loose());
    RUN(test_svg());
    RUN(test_edges(load_measured(":teapot", 4)));
    RUN(test_edges(load_measured(":knot", 6)));
    RUN(test_edges(random_mesh()));
    return test_end("lines");
}
