/* The scenes' parameters and their meshes. */
#include "scenes.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/numbers.h"
#include "shapes.h"
#include "subdivide.h"

#define BUNNY "/usr/share/glmark2/models/bunny.obj" /* Debian's glmark2-data */

/* ---- Random numbers: the same on every machine ---- */

typedef struct dice {
    uint64_t state;
} dice;

static double uniform(dice *d, double low, double high) {
    d->state = d->state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * ((double)(d->state >> 11) * 0x1p-53);
}

static burnish_vec3 in_cube(dice *d, double half) {
    const double x = uniform(d, -half, half), y = uniform(d, -half, half);
    return (burnish_vec3){x, y, uniform(d, -half, half)};
}

static burnish_vec3 direction(dice *d) {
    burnish_vec3 v;
    do {
        v = in_cube(d, 1);
    } while (burnish_vec3_length(v) > 1 || burnish_vec3_length(v) < 0.01);
    return burnish_vec3_normalize(v);
}

static burnish_vec3 along(burnish_vec3 from, burnish_vec3 axis, double length) {
    return burnish_vec3_add(from, burnish_vec3_scale(axis, length));
}

/* ---- Shapes; count is the scene's parameter ---- */

static void make_rods(burnish_shape *shape, int count) {
    dice d = {1};
    for (int i = 0; i < count; ++i) {
        const burnish_vec3 middle = in_cube(&d, 1), axis = direction(&d);
        burnish_shape_cylinder(shape, along(middle, axis, -0.9), along(middle, axis, 0.9), 0.015,
                               24);
    }
}

static void make_quads(burnish_shape *shape, int count) {
    dice d = {2};
    for (int i = 0; i < count; ++i) {
        const burnish_vec3 middle = in_cube(&d, 0.8), u = direction(&d);
        const burnish_vec3 v = burnish_vec3_normalize(burnish_vec3_cross(u, direction(&d)));
        const double a = uniform(&d, 0.3, 0.9), b = uniform(&d, 0.3, 0.9);
        burnish_shape_quad(shape, along(along(middle, u, -a), v, -b),
                           along(along(middle, u, a), v, -b), along(along(middle, u, a), v, b),
                           along(along(middle, u, -a), v, b));
    }
}

/* The outermost hides all others. Few enough triangles that the mesh keeps their order. count < 0:
 * the innermost, which is farthest, first. */
static void make_spheres(burnish_shape *shape, int count) {
    const burnish_vec3 center = {0, 0, 0};
    for (int i = 0; i < abs(count); ++i) {
        const int depth = count < 0 ? -count - 1 - i : i;
        burnish_shape_sphere(shape, center, 1 - 0.02 * depth, 16);
    }
}

/* Concave: a quarter of a cylinder between floor and wall, with its two ends. */
static void make_fillet(burnish_shape *shape, burnish_vec3 corner, double radius, double width,
                        int steps) {
    burnish_vec3 arc[2][65];
    for (int side = 0; side < 2; ++side) {
        for (int i = 0; i <= steps; ++i) {
            const double turn = BURNISH_PI / 2 * i / steps;
            arc[side][i] =
                (burnish_vec3){corner.x + radius * (1 - sin(turn)),
                               corner.y + radius * (1 - cos(turn)), corner.z + width * side};
        }
    }
    for (int i = 0; i < steps; ++i) {
        const burnish_vec3 back = {corner.x, corner.y, corner.z + width};
        burnish_shape_quad(shape, arc[0][i], arc[0][i + 1], arc[1][i + 1], arc[1][i]);
        burnish_shape_triangle(shape, corner, arc[0][i + 1], arc[0][i]);
        burnish_shape_triangle(shape, back, arc[1][i], arc[1][i + 1]);
    }
}

static void make_bracket(burnish_shape *shape, int sides) {
    const burnish_plate base = {{0, 0, 3}, {4, 0, 0}, {0, 0, -3}, 0.4, 2, 2, 0.35, sides};
    const burnish_plate wall = {{0, 0, 3}, {0, 0, -3}, {0, 3, 0}, 0.4, 1, 1, 0.8, 2 * sides};
    burnish_shape_plate(shape, &base);
    burnish_shape_plate(shape, &wall);
    burnish_shape_box(shape, (burnish_vec3){-0.4, -0.4, 0}, (burnish_vec3){0, 0, 3});
    make_fillet(shape, (burnish_vec3){0, 0, 0}, 0.5, 3, sides);
    for (int i = 0; i < 2; ++i) { /* pins */
        const double z = 0.75 + 1.5 * i;
        burnish_shape_cylinder(shape, (burnish_vec3){2, 0, z}, (burnish_vec3){2, 0.8, z}, 0.25,
                               sides);
    }
}

static void make_gear(burnish_shape *shape, int teeth) {
    enum { PER_TOOTH = 8, MOST = 512 };
    static const double HEIGHTS[PER_TOOTH] = {0.84, 0.84, 0.87, 0.94, 1, 1, 0.94, 0.87};
    burnish_vec3 outer[MOST] = {0}, inner[MOST] = {0}, hub[MOST] = {0};
    const int count = teeth * PER_TOOTH;
    for (int i = 0; i < count; ++i) {
        const double turn = -2 * BURNISH_PI * i / count, x = cos(turn), z = sin(turn);
        const double radius = HEIGHTS[i % PER_TOOTH];
        outer[i] = (burnish_vec3){x * radius, 0, z * radius};
        hub[i] = (burnish_vec3){x * 0.4, 0.2, z * 0.4};
        inner[i] = (burnish_vec3){x * 0.25, 0, z * 0.25};
    }
    burnish_shape_ring(shape, outer, inner, count, (burnish_vec3){0, 0.2, 0});
    for (int i = 0; i < count; ++i) {
        inner[i].y = 0.2;
    }
    burnish_shape_ring(shape, hub, inner, count, (burnish_vec3){0, 0.15, 0});
}

/* Of the thread's surface: its crest rises one pitch per turn. */
static burnish_vec3 on_thread(int column, int columns, int row, int rows_per_turn, double pitch) {
    const double turn = (double)(column % columns) / columns;
    const double phase = fmod((double)row / rows_per_turn - turn + 16, 1);
    const double radius = 0.5 - 0.12 * fabs(2 * phase - 1);
    return (burnish_vec3){radius * cos(2 * BURNISH_PI * turn), -pitch * row / rows_per_turn,
                          -radius * sin(2 * BURNISH_PI * turn)};
}

static void make_bolt(burnish_shape *shape, int turns) {
    enum { COLUMNS = 64, ROWS = 8 };
    const double pitch = 0.15, end = -pitch * turns;
    for (int row = 0; row < turns * ROWS; ++row) {
        for (int i = 0; i < COLUMNS; ++i) {
            burnish_shape_quad(shape, on_thread(i, COLUMNS, row + 1, ROWS, pitch),
                               on_thread(i + 1, COLUMNS, row + 1, ROWS, pitch),
                               on_thread(i + 1, COLUMNS, row, ROWS, pitch),
                               on_thread(i, COLUMNS, row, ROWS, pitch));
        }
    }
    for (int i = 0; i < COLUMNS; ++i) {
        burnish_shape_triangle(shape, (burnish_vec3){0, end, 0},
                               on_thread(i + 1, COLUMNS, turns * ROWS, ROWS, pitch),
                               on_thread(i, COLUMNS, turns * ROWS, ROWS, pitch));
    }
    burnish_shape_cylinder(shape, (burnish_vec3){0, 0, 0}, (burnish_vec3){0, 0.55, 0}, 0.9, 6);
    burnish_shape_cylinder(shape, (burnish_vec3){0, 0.55, 0}, (burnish_vec3){0, 0.6, 0}, 0.72, 48);
}

static void make_boxes(burnish_shape *shape, int count) {
    for (int i = 0; i < count * count * count; ++i) {
        const burnish_vec3 low = {i % count, i / count % count, i / count / count};
        burnish_shape_box(shape, low, along(low, (burnish_vec3){1, 1, 1}, 0.6));
    }
}

static burnish_vec3 on_terrain(int column, int row, int count) {
    const double x = 2.0 * column / count - 1, z = 2.0 * row / count - 1;
    double height = 0;
    for (int octave = 1; octave < 7; ++octave) {
        const double f = 1.4 * pow(1.8, octave), turn = 1.3 * octave;
        height += sin(f * (x * cos(turn) + z * sin(turn)) + turn) *
                  cos(f * (z * cos(turn) - x * sin(turn))) / pow(f, 1.25);
    }
    return (burnish_vec3){x, 0.45 * height, z};
}

static void make_terrain(burnish_shape *shape, int count) {
    for (int row = 0; row < count; ++row) {
        for (int i = 0; i < count; ++i) {
            burnish_shape_quad(shape, on_terrain(i, row + 1, count),
                               on_terrain(i + 1, row + 1, count), on_terrain(i + 1, row, count),
                               on_terrain(i, row, count));
        }
    }
}

/* Strips of 12 quads that hang from a half sphere, each turning a little. */
static void make_hair(burnish_shape *shape, int count) {
    enum { SEGMENTS = 12 };
    dice d = {3};
    for (int i = 0; i < count; ++i) {
        burnish_vec3 root = direction(&d);
        root.y = fabs(root.y);
        const burnish_vec3 drift = burnish_vec3_scale(direction(&d), 0.12);
        burnish_vec3 at = root, heading = root;
        const burnish_vec3 down = {0, -0.28, 0};
        burnish_vec3 side = burnish_vec3_normalize(burnish_vec3_cross(direction(&d), root));
        for (int k = 0; k < SEGMENTS; ++k) {
            const double width = 0.004 * (1 - 0.8 * k / SEGMENTS);
            const double end = 0.004 * (1 - 0.8 * (k + 1) / SEGMENTS);
            const burnish_vec3 to = along(at, heading, 0.12);
            burnish_shape_quad(shape, along(at, side, -width), along(at, side, width),
                               along(to, side, end), along(to, side, -end));
            at = to;
            heading =
                burnish_vec3_normalize(burnish_vec3_add(burnish_vec3_add(heading, down), drift));
        }
    }
}

/* Seen from (0, 0, 4): each covers the picture, the first is the farthest. */
static void make_triangles(burnish_shape *shape, int count) {
    for (int i = 0; i < count; ++i) {
        const double z = count > 1 ? -1 + 2.0 * i / (count - 1) : 0;
        burnish_shape_triangle(shape, (burnish_vec3){-16, -8, z}, (burnish_vec3){16, -8, z},
                               (burnish_vec3){0, 20, z});
    }
}

/* A glyph is some of seven strokes, as on a pocket calculator. */
static void make_glyph(burnish_shape *shape, burnish_vec3 at, double size, unsigned strokes) {
    static const struct {
        double x, y, width, height;
    } STROKES[7] = {{0, 0, 0.6, 0.1},     {0, 0.45, 0.6, 0.1}, {0, 0.9, 0.6, 0.1},
                    {0, 0.05, 0.1, 0.45}, {0, 0.5, 0.1, 0.45}, {0.5, 0.05, 0.1, 0.45},
                    {0.5, 0.5, 0.1, 0.45}};
    for (int i = 0; i < 7; ++i) {
        if (strokes >> i & 1) {
            const double x = at.x + size * STROKES[i].x, y = at.y + size * STROKES[i].y;
            const double right = x + size * STROKES[i].width, top = y + size * STROKES[i].height;
            burnish_shape_quad(shape, (burnish_vec3){x, y, at.z}, (burnish_vec3){right, y, at.z},
                               (burnish_vec3){right, top, at.z}, (burnish_vec3){x, top, at.z});
        }
    }
}

/* Pages one behind the other and to the side, with 40 lines of 50 glyphs. */
static void make_text(burnish_shape *shape, int pages) {
    enum { LINES = 40, LETTERS = 50 };
    dice d = {4};
    for (int page = 0; page < pages; ++page) {
        const double x = 0.35 * page, y = 0.1 * page, z = -0.3 * page, pitch = 0.018;
        shape->material = 0;
        burnish_shape_quad(shape, (burnish_vec3){x, y, z}, (burnish_vec3){x + 1, y, z},
                           (burnish_vec3){x + 1, y + 1.2, z}, (burnish_vec3){x, y + 1.2, z});
        shape->material = 1;
        for (int i = 0; i < LINES * LETTERS; ++i) {
            const burnish_vec3 at = {x + 0.05 + pitch * (i % LETTERS),
                                     y + 1.13 - 0.0272 * (i / LETTERS), z + 0.002};
            make_glyph(shape, at, 0.02, (unsigned)uniform(&d, 0, 128));
        }
    }
}

/* Blocks along streets of width 0.5, seen from the middle crossing. */
static void make_city(burnish_shape *shape, int count) {
    dice d = {5};
    const double half = 0.75 * count;
    burnish_shape_quad(shape, (burnish_vec3){-half, 0, half}, (burnish_vec3){half, 0, half},
                       (burnish_vec3){half, 0, -half}, (burnish_vec3){-half, 0, -half});
    for (int i = 0; i < count * count; ++i) {
        const double x = 1.5 * (i % count) - half + 0.25, z = 1.5 * (i / count) - half + 0.25;
        const double height = uniform(&d, 0.2, 0.8) * uniform(&d, 0.5, 2.2);
        shape->material = (uint16_t)(1 + i % 3);
        burnish_shape_box(shape, (burnish_vec3){x, 0, z}, (burnish_vec3){x + 1, height, z + 1});
        burnish_shape_box(shape, (burnish_vec3){x + 0.2, height, z + 0.2},
                          (burnish_vec3){x + 0.8, height + uniform(&d, 0.05, 0.6), z + 0.8});
    }
}

/* ---- The list ---- */

typedef void shape_maker(burnish_shape *shape, int count);

typedef struct recipe {
    const char *name, *text;
    shape_maker *make;           /* NULL: the bunny */
    int count;                   /* of the maker; of the bunny: subdivisions */
    int materials;               /* 0: one; the bunny's are mixed in groups of eight triangles */
    int colors;                  /* of the bunny: 1: one per vertex */
    int open;                    /* 1: both sides are lit */
    int textured;                /* texels along a side of the one texture; 0: none */
    burnish_scene_lights lights; /* count 0: one */
    double eye[3], focus[3];     /* equal: the camera frames the mesh */
} recipe;

static const recipe RECIPES[] = {
    {"bunny", "a scan of 69,666 triangles", .make = NULL},
    {"bunny16", "subdivided twice: 1.1 million", .count = 2},
    {"materials-64", "bunny, mixed by eight triangles", .materials = 64},
    {"materials-1000", "the same with 1,000", .materials = 1000},
    {"colors", "bunny with vertex colours", .colors = 1},
    {"texture", "bunny with a texture of 1,024 x 1,024", .textured = 1024},
    {"light-near", "bunny under a point light", .lights = {1, 1}},
    {"lights-16", "bunny, 16 directional lights", .lights = {16, 0}},
    {"lights-near-16", "bunny, 16 point lights", .lights = {16, 1}},
    {"rods", "200 cylinders of 24 sides", make_rods, .count = 200},
    {"quads", "60 large ones that cross", make_quads, .count = 60, .open = 1},
    {"texture-quads", "the same with a texture of 2,048 x 2,048", make_quads, .count = 60,
     .open = 1, .textured = 2048},
    {"spheres", "8 nested, the visible one first", make_spheres, .count = 8},
    {"spheres-back", "8 nested, it comes last", make_spheres, .count = -8},
    {"bracket", "fillet, holes, pins", make_bracket, .count = 32},
    {"gear", "40 teeth, thin fans", make_gear, .count = 40},
    {"bolt", "hexagon and thread", make_bolt, .count = 16},
    {"boxes", "12 x 12 x 12", make_boxes, .count = 12},
    {"terrain", "256 x 256 quads", make_terrain, .count = 256, .open = 1},
    {"hair", "6,000 strips of 12 quads", make_hair, .count = 6000, .open = 1},
    {"triangle", "one over the whole picture", make_triangles, .count = 1, .eye = {0, 0, 4}},
    {"triangles", "500 of them, back to front", make_triangles, .count = 500, .eye = {0, 0, 4}},
    {"text", "3 pages of 2,000 glyphs", make_text, .count = 3, .materials = 2, .open = 1},
    {"city", "boxes from inside, clipped", make_city, .count = 40, .materials = 4,
     .eye = {0.02, 0.9, 0.1}, .focus = {-5, 0.2, -9}},
};

enum { RECIPES_COUNT = sizeof RECIPES / sizeof *RECIPES };

const char *burnish_scene_name(size_t index) {
    return index < RECIPES_COUNT ? RECIPES[index].name : NULL;
}

const char *burnish_scene_text(size_t index) {
    return index < RECIPES_COUNT ? RECIPES[index].text : NULL;
}

/* ---- Meshes ---- */

static int material_count(const recipe *r) {
    return r->materials ? r->materials : 1;
}

/* Grey, then colours, each a little different; two materials are paper and dark ink. */
static void vary_materials(burnish_material *materials, int count) {
    for (int i = 0; i < count; ++i) {
        materials[i] = burnish_material_default();
        for (int k = 0; k < 3; ++k) {
            const float ink = i > 0 ? 0.05f : 0.8f;
            const float color = i > 0 ? 0.5f + 0.3f * (float)sin(0.7 * i + 2 * k) : 0.6f;
            materials[i].diffuse[k] = count == 2 ? ink : color;
        }
    }
}

/* ---- Textures ---- */

/* Coordinates and the one texture of a textured scene, all NULL for others. */
typedef struct texturing {
    float *coordinates;
    uint8_t *texels;
    burnish_texture texture;
} texturing;

/* Squares of eight texels, each with a colour of its own. */
static void paint(uint8_t *texels, int side) {
    for (int i = 0; i < side * side; ++i) {
        const unsigned square = (unsigned)(i % side / 8) + 977u * (unsigned)(i / side / 8);
        for (unsigned k = 0; k < 3; ++k) {
            texels[4 * (size_t)i + k] =
                (uint8_t)(64 + ((square * 2654435761u) >> (8 * k + 5)) % 192);
        }
        texels[4 * (size_t)i + 3] = 255;
    }
}

/* Projects the image along (1, 1, 1) onto the positions, `scale` times per unit. Returns 0 if
 * memory is short. */
static int add_texture(const recipe *r, const float *positions, size_t count, double scale,
                       burnish_material *material, texturing *t, burnish_mesh_description *arrays) {
    if (!r->textured) {
        return 1;
    }
    t->coordinates = malloc(2 * count * sizeof *t->coordinates);
    t->texels = malloc((size_t)r->textured * (size_t)r->textured * 4);
    if (!t->coordinates || !t->texels) {
        return 0;
    }
    for (size_t i = 0; i < count; ++i) {
        const float *p = positions + 3 * i;
        t->coordinates[2 * i] = (float)(scale * ((double)p[0] - (double)p[2]));
        t->coordinates[2 * i + 1] = (float)(scale * ((double)p[1] - 0.5 * (double)(p[0] + p[2])));
    }
    paint(t->texels, r->textured);
    t->texture = (burnish_texture){"squares", r->textured, r->textured, t->texels, 1};
    material->textures[BURNISH_TEXTURE_COLOR].texture = 1;
    arrays->texture_coordinates = (burnish_array){t->coordinates, count, 0};
    arrays->textures = &t->texture;
    arrays->texture_count = 1;
    return 1;
}

static void free_texture(texturing *t) {
    free(t->coordinates);
    free(t->texels);
}

static burnish_status make_shape(const recipe *r, burnish_mesh **mesh, burnish_error *error) {
    enum { MOST = 8 };
    burnish_load_options load = burnish_load_options_default();
    burnish_mesh_description arrays = burnish_mesh_description_default();
    burnish_material materials[MOST];
    burnish_shape shape = {0};
    burnish_status status = BURNISH_STATUS_MEMORY;
    *mesh = NULL;
    r->make(&shape, r->count);
    vary_materials(materials, material_count(r));
    load.crease_angle = 40; /* as for parts */
    arrays.name = r->name;
    arrays.positions = (burnish_array){shape.positions, 3 * shape.triangles, 0};
    arrays.triangle_materials = (burnish_array){shape.materials, shape.triangles, 0};
    arrays.materials = materials;
    arrays.material_count = (size_t)material_count(r);
    snprintf(error->text, sizeof error->text, "%s: out of memory", r->name);
    texturing t = {0};
    if (!shape.out_of_memory &&
        add_texture(r, shape.positions, 3 * shape.triangles, 0.5, materials, &t, &arrays)) {
        status = burnish_mesh_create(&arrays, &load, mesh, error);
    }
    free_texture(&t);
    burnish_shape_free(&shape);
    return status;
}

/* The mesh again with materials in groups of eight triangles, or a colour per vertex. */
static burnish_status decorate(const recipe *r, const burnish_mesh_view *view, burnish_mesh **mesh,
                               burnish_error *error) {
    burnish_load_options load = burnish_load_options_default();
    burnish_mesh_description arrays = burnish_mesh_description_default();
    burnish_material *materials = calloc((size_t)material_count(r), sizeof *materials);
    uint16_t *numbers = calloc(view->triangle_count, sizeof *numbers);
    uint8_t *colors = calloc(view->vertex_count, 4);
    burnish_status status = BURNISH_STATUS_MEMORY;
    if (materials && numbers && colors) {
        vary_materials(materials, material_count(r));
        for (size_t i = 0; i < view->triangle_count; ++i) {
            numbers[i] = (uint16_t)(i / 8 % (size_t)material_count(r));
        }
        for (size_t i = 0; i < 4 * view->vertex_count; ++i) {
            colors[i] =
                i % 4 == 3 ? 255 : (uint8_t)(127.5f + 127.5f * view->normals[i / 4 * 3 + i % 4]);
        }
        arrays.positions = (burnish_array){view->positions, view->vertex_count, 0};
        arrays.normals = (burnish_array){view->normals, view->vertex_count, 0};
        arrays.indices = (burnish_array){view->indices, 3 * view->triangle_count, 0};
        if (r->colors) {
            arrays.colors = (burnish_array){colors, view->vertex_count, 0};
        } else {
            arrays.triangle_materials = (burnish_array){numbers, view->triangle_count, 0};
            arrays.materials = materials;
            arrays.material_count = (size_t)material_count(r);
        }
        memcpy(arrays.up_axis, view->up_axis, sizeof arrays.up_axis);
        const double size = (double)view->bounds_max[1] - (double)view->bounds_min[1];
        texturing t = {0};
        if (add_texture(r, view->positions, view->vertex_count, 1 / size, materials, &t, &arrays)) {
            status = burnish_mesh_create(&arrays, &load, mesh, error);
        }
        free_texture(&t);
    }
    free(materials);
    free(numbers);
    free(colors);
    return status;
}

static burnish_status make_bunny(const recipe *r, burnish_mesh **mesh, burnish_error *error) {
    burnish_load_options load = burnish_load_options_default();
    burnish_mesh *plain;
    burnish_status status = burnish_mesh_load(BUNNY, &load, &plain, error);
    *mesh = plain;
    if (status != BURNISH_STATUS_OK || (!r->count && !r->materials && !r->colors && !r->textured)) {
        return status;
    }
    *mesh = NULL;
    if (r->count) {
        status = burnish_peers_subdivide(plain, r->count, mesh, error);
    } else {
        status = decorate(r, burnish_mesh_get_view(plain), mesh, error);
    }
    burnish_mesh_destroy(plain);
    return status;
}

static burnish_status make_camera(const recipe *r, double aspect, burnish_scene *scene,
                                  burnish_error *error) {
    if (memcmp(r->eye, r->focus, sizeof r->eye) != 0) {
        burnish_camera *camera = &scene->camera;
        memcpy(camera->position, r->eye, sizeof r->eye);
        memcpy(camera->focal_point, r->focus, sizeof r->focus);
        camera->view_up[1] = 1;
        camera->view_angle = 60;
        return BURNISH_STATUS_OK;
    }
    burnish_framing framing = burnish_framing_default();
    framing.aspect = aspect;
    return burnish_camera_frame(scene->mesh, &framing, &scene->camera, error);
}

burnish_status burnish_scene_make(const char *name, double aspect, burnish_scene *scene,
                                  burnish_error *error) {
    const recipe *r = NULL;
    memset(scene, 0, sizeof *scene);
    for (size_t i = 0; i < RECIPES_COUNT; ++i) {
        r = strcmp(RECIPES[i].name, name) == 0 ? &RECIPES[i] : r;
    }
    if (!r) {
        snprintf(error->text, sizeof error->text, "no scene is called \"%s\"", name);
        return BURNISH_STATUS_ARGUMENT;
    }
    burnish_status status =
        r->make ? make_shape(r, &scene->mesh, error) : make_bunny(r, &scene->mesh, error);
    if (status == BURNISH_STATUS_OK) {
        status = make_camera(r, aspect, scene, error);
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_mesh_destroy(scene->mesh);
        scene->mesh = NULL;
    }
    scene->lights = r->lights.count ? r->lights : (burnish_scene_lights){1, 0};
    scene->cull_back_faces = !r->open;
    return status;
}
