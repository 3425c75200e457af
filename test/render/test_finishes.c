/* Layers over a surface, against sums over their formulas: the light of the layer and what it leaves
 * of the light below it, which is that of a picture without the layer. */
#include "rough_surfaces.h"

enum { STEPS = 48, DIRECT = LIGHTS /* the number of a directional light */ };

static const vec toward_light = {-0.48, 0.6, 0.64};
static const vec toward_viewer = {0, 0, 1};

static float plain[SIDE][SIDE][4];

/* Two directions at right angles to the normal. */
static void make_frame(const vec normal, vec x, vec y) {
    cross(normal, fabs(normal[0]) < 0.6 ? (vec){1, 0, 0} : (vec){0, 1, 0}, x);
    normalize(x);
    cross(normal, x, y);
}

static double schlick(double f0, double cosine) {
    return f0 + (1 - f0) * pow(1 - fmin(fmax(cosine, 0), 1), 5);
}

/* ---- Coats ---- */

/* GGX of the directional light, whose colour lights white to 1. */
static double coat_direct(const vec normal, double alpha) {
    const double to_v = dot(normal, toward_viewer), to_l = dot(normal, toward_light);
    const double a = alpha * alpha;
    vec h;
    for (int k = 0; k < 3; ++k) {
        h[k] = toward_light[k] + toward_viewer[k];
    }
    normalize(h);
    const double to_h = dot(normal, h), d = to_h * to_h * (a - 1) + 1;
    if (!(to_l > 0 && to_v > 0)) {
        return 0;
    }
    const double v = to_l * sqrt(to_v * to_v * (1 - a) + a),
                 w = to_v * sqrt(to_l * to_l * (1 - a) + a);
    return schlick(0.04, dot(h, toward_viewer)) * a / (d * d) * 0.5 / (v + w) * to_l;
}

/* What a whole coat reflects. */
static double coat_light(int light, const vec position, const vec normal, double roughness) {
    const double alpha = fmax(roughness * roughness, 1e-3);
    double sum = 0;
    vec x, y;
    if (light == DIRECT) {
        return coat_direct(normal, alpha);
    }
    make_frame(normal, x, y);
    const vec v = {dot(toward_viewer, x), dot(toward_viewer, y), dot(toward_viewer, normal)};
    for (int i = 0; i < STEPS * STEPS; ++i) {
        vec m, w;
        visible_normal(v, alpha, (i / STEPS + drawn()) / STEPS, (i % STEPS + drawn()) / STEPS, m);
        const double cosine = dot(v, m);
        const vec l = {2 * cosine * m[0] - v[0], 2 * cosine * m[1] - v[1],
                       2 * cosine * m[2] - v[2]};
        for (int k = 0; k < 3; ++k) {
            w[k] = l[0] * x[k] + l[1] * y[k] + l[2] * normal[k];
        }
        if (l[2] > 0) {
            const double to_v = 1 + smith(v, alpha), share = to_v / (to_v + smith(l, alpha));
            sum += schlick(0.04, cosine) * share * radiance(light, position, w);
        }
    }
    return sum / (STEPS * STEPS);
}

/* ---- Pictures ---- */

static burnish_render_options scene_options(int light, burnish_environment *environment) {
    burnish_render_options options = options_for(light < LIGHTS ? light : 0, environment);
    if (light == DIRECT) {
        options.area_light_count = 0;
        light_from(&options, toward_light[0], toward_light[1], toward_light[2]);
    }
    return options;
}

/* A red, rough surface. */
static burnish_material base_material(void) {
    burnish_material material = burnish_material_default();
    material.diffuse[0] = 0.5f;
    material.diffuse[1] = material.diffuse[2] = 0.05f;
    set_three(material.reflectance, 0.04f);
    material.has_diffuse = material.is_metallic = 1;
    material.roughness = 0.6f;
    return material;
}

typedef double layer_function(int light, const vec position, const vec normal, double roughness,
                              double *below);

static double coat_layer(int light, const vec position, const vec normal, double roughness,
                         double *below) {
    *below = 1 - 0.8 * schlick(0.04, dot(normal, toward_viewer));
    return 0.8 * coat_light(light, position, normal, roughness);
}

/* Draws a mesh without and with a layer; errors of the second picture, and of the first. */
static void compare_layer(burnish_mesh *mesh, const burnish_render_options *options, int light,
                          const burnish_material *layered, layer_function *layer, errors e[2]) {
    const burnish_material base = base_material();
    const burnish_target target = make_target(floats_of(picture.rgba[0][0], SIDE, SIDE),
                                              picture.depth[0], picture.normal[0][0], NULL, NULL);
    const double roughness = (double)layered->coat_roughness;
    set_material(mesh, &base);
    draw_floats(mesh, options, plain[0][0], NULL);
    set_material(mesh, layered);
    draw_into(mesh, options, &target, NULL);
    for (int i = 3; i < SIDE * SIDE; i += 877) {
        const int x = i % SIDE, y = i / SIDE;
        vec position = {((x + 0.5) / SIDE - 0.5) * 2.2, (0.5 - (y + 0.5) / SIDE) * 2.2, 0}, normal;
        if (!isfinite(picture.depth[y][x])) {
            continue;
        }
        position[2] = 4 - (double)picture.depth[y][x];
        for (int k = 0; k < 3; ++k) {
            normal[k] = (double)picture.normal[y][x][k];
        }
        double below;
        const double own = layer(light, position, normal, roughness, &below);
        for (int k = 0; k < 3; ++k) {
            const double before = (double)plain[y][x][k], should = before * below + own;
            for (int j = 0; j < 2; ++j) {
                const double d = srgb(j ? before : (double)picture.rgba[y][x][k]) - srgb(should);
                e[j].squares += d * d;
                e[j].sum += d;
                ++e[j].count;
            }
        }
    }
}

static void test_coat(burnish_mesh *const meshes[SHAPES], int light,
                      burnish_environment *environment) {
    static const float roughnesses[] = {0, 0.1f, 0.3f, 0.6f};
    const burnish_render_options options = scene_options(light, environment);
    for (int i = light == DIRECT; i < 4; ++i) { /* a smooth coat's highlight is within a pixel */
        errors e[2] = {{0}};
        burnish_material coated = base_material();
        coated.coat = 0.8f;
        coated.coat_roughness = roughnesses[i];
        for (int shape = 0; shape < SHAPES; ++shape) {
            compare_layer(meshes[shape], &options, light, &coated, coat_layer, e);
        }
        const double rms = sqrt(e[0].squares / e[0].count), bias = e[0].sum / e[0].count;
        const double without = sqrt(e[1].squares / e[1].count);
        printf("  coat, light %d, roughness %.1f: RMS %.1f, bias %+.1f of 255; without %.1f\n",
               light, (double)roughnesses[i], rms, bias, without);
        CHECK(e[0].count > 300 && rms < (light == DIRECT ? 4 : 3) && fabs(bias) < 3 &&
                  rms < (light == DIRECT ? 0.7 : 0.35) * without,
              "light %d, roughness %g: %g, %g, %g", light, (double)roughnesses[i], rms, bias,
              without);
    }
}

/* ---- Textures ---- */

enum { PIXELS = 40 };

static void draw_quad(const burnish_material *material, float light[PIXELS][PIXELS][4]) {
    static const float corners[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    static const float coordinates[] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const uint8_t texels[3][4] = {
        {128, 200, 0, 255}, {87, 165, 242, 255}, {200, 90, 220, 255}};
    burnish_texture textures[3];
    for (int i = 0; i < 3; ++i) {
        textures[i] = (burnish_texture){NULL, 1, 1, texels[i], 0};
    }
    burnish_mesh_description arrays = describe_quads(corners, NULL, 1);
    give_textures(&arrays, coordinates, textures, 3);
    give_materials(&arrays, material, 1);
    OWNED_MESH *mesh = create_mesh(&arrays, NULL);
    burnish_render_options options = front_options(PIXELS, PIXELS, 2);
    options.area_light_count = 1;
    options.area_lights[0] = areas[0];
    draw_floats(mesh, &options, light[0][0], NULL);
}

/* The largest difference of two materials' pictures, and of them from black. */
static double differ(const burnish_material *a, const burnish_material *b, double *most) {
    static float light[2][PIXELS][PIXELS][4];
    double difference = 0;
    *most = 0;
    draw_quad(a, light[0]);
    draw_quad(b, light[1]);
    for (int i = 0; i < PIXELS * PIXELS * 4; ++i) {
        if (i % 4 < 3) {
            const double x = (double)light[0][0][0][i], y = (double)light[1][0][0][i];
            difference = fmax(difference, fabs(x - y));
            *most = fmax(*most, x);
        }
    }
    return difference;
}

/* Textures of a coat multiply its numbers, and its normals are the texture's alone. */
static void test_coat_textures(void) {
    const burnish_texture_use uses[3] = {
        {.texture = 1}, {.texture = 2, .strength = 1}, {.texture = 3, .strength = 1}};
    burnish_material numbers = base_material(), textured = base_material();
    double most;
    numbers.coat = 128.0f / 255;
    numbers.coat_roughness = 0.5f * 200 / 255;
    textured.coat = 1;
    textured.coat_roughness = 0.5f;
    textured.textures[BURNISH_TEXTURE_COAT] = uses[0];
    textured.textures[BURNISH_TEXTURE_COAT_ROUGHNESS] = uses[0];
    CHECK1(differ(&numbers, &textured, &most) < 3e-4 && most > 0.1);

    burnish_material plastic = base_material(), coated = base_material();
    set_three(plastic.diffuse, 0);
    set_three(coated.diffuse, 0);
    set_three(coated.reflectance, 0);
    plastic.roughness = coated.coat_roughness = 0.3f;
    coated.coat = 1;
    plastic.textures[BURNISH_TEXTURE_NORMAL] = coated.textures[BURNISH_TEXTURE_COAT_NORMAL] =
        uses[1];
    coated.textures[BURNISH_TEXTURE_NORMAL] = uses[2];
    /* the base's edge still reflects a little */
    CHECK1(differ(&plastic, &coated, &most) < 5e-3 && most > 0.3);
    coated.textures[BURNISH_TEXTURE_COAT_NORMAL].texture = 0;
    CHECK1(differ(&plastic, &coated, &most) > 0.1);
}

int main(int count, char **arguments) {
    static float rgb[ROWS][COLUMNS][3];
    static const float corners[] = {-1, -0.8f, 0.9f,  1,  -0.8f, 0.9f,
                                    1,  0.7f,  -0.9f, -1, 0.7f,  -0.9f};
    burnish_environment *environment;
    burnish_error error;
    test_begin(count, arguments, NULL);
    seed = test_seed(6);
    furnish();
    for (int i = 0; i < ROWS * COLUMNS; ++i) {
        set_three(rgb[i / COLUMNS][i % COLUMNS], room[i / COLUMNS][i % COLUMNS]);
    }
    CHECK_OK(burnish_environment_create(NULL, COLUMNS, ROWS, rgb[0][0], &environment, &error),
             error);
    burnish_mesh *meshes[SHAPES] = {load_tessellated(":sphere", 64),
                                    create_quads(corners, NULL, 1)};
    for (int light = 0; light <= DIRECT; ++light) {
        RUN(test_coat(meshes, light, environment));
    }
    RUN(test_coat_textures());
    burnish_environment_destroy(environment);
    for (int i = 0; i < SHAPES; ++i) {
        burnish_mesh_destroy(meshes[i]);
    }
    return test_end("finishes");
}
