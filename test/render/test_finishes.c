/* Layers over a surface, against sums over their formulas: the light of the layer and what it leaves
 * of the light below it, which is that of a picture without the layer. */
#include "rough_surfaces.h"

enum { STEPS = 48, DIRECT = LIGHTS /* the number of a directional light */ };

static const vec toward_light = {-0.48, 0.6, 0.64};
static const vec toward_viewer = {0, 0, 1};

static float plain[SIDE][SIDE][4];

/* ---- Coats ---- */

/* GGX in the directional light, whose colour lights white to 1. N is z. */
static double coat_direct(const vec v, const vec l, double a) {
    vec h = {v[0] + l[0], v[1] + l[1], v[2] + l[2]};
    normalize(h);
    const double d = h[2] * h[2] * (a - 1) + 1;
    const double visible =
        l[2] * sqrt(v[2] * v[2] * (1 - a) + a) + v[2] * sqrt(l[2] * l[2] * (1 - a) + a);
    return l[2] > 0 ? schlick(0.04, dot(h, v)) * a / (d * d) * 0.5 / visible * l[2] : 0;
}

/* What GGX reflects once of a light, with Fresnel's term at normal incidence and at the edge. */
static double gloss_light(int light, const vec position, const vec normal, double alpha, double f0,
                          double f90) {
    double sum = 0;
    vec axes[3], v, m, l;
    make_frame(normal, toward_viewer, axes, v);
    for (int i = 0; i < STEPS * STEPS; ++i) {
        visible_normal(v, alpha, (i / STEPS + drawn()) / STEPS, (i % STEPS + drawn()) / STEPS, m);
        const double cosine = dot(v, m);
        for (int k = 0; k < 3; ++k) {
            l[k] = 2 * cosine * m[k] - v[k];
        }
        if (l[2] > 0) {
            const double to_v = 1 + smith(v, alpha), share = to_v / (to_v + smith(l, alpha));
            sum += (f0 + (f90 - f0) * schlick(0, cosine)) * share *
                   local_radiance(light, position, axes, l);
        }
    }
    return sum / (STEPS * STEPS);
}

/* What a whole coat reflects. */
static double coat_light(int light, const vec position, const vec normal, double roughness) {
    const double alpha = fmax(roughness * roughness, 1e-3);
    vec axes[3], v, l;
    make_frame(normal, toward_light, axes, l);
    make_frame(normal, toward_viewer, axes, v);
    return light == DIRECT ? coat_direct(v, l, alpha * alpha)
                           : gloss_light(light, position, normal, alpha, 0.04, 1);
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

/* ---- Sheen: Charlie's distribution, visibility of Ashikhmin and Premoze ---- */

static double sheen_value(const vec v, const vec l, double alpha) {
    vec h = {v[0] + l[0], v[1] + l[1], v[2] + l[2]};
    normalize(h);
    const double d = (2 + 1 / alpha) * pow(fmax(1 - h[2] * h[2], 0), 0.5 / alpha) / (2 * M_PI);
    return d / (4 * (v[2] + l[2] - v[2] * l[2])) * l[2];
}

/* What white sheen reflects, and its albedo. Above an albedo of 1, which this visibility has near
 * the edge, light from many directions is scaled to it. */
static double sheen_light(int light, const vec position, const vec normal, double roughness,
                          double *albedo) {
    const double alpha = roughness * roughness;
    double sum = 0;
    vec axes[3], v, to_light;
    make_frame(normal, toward_light, axes, to_light);
    make_frame(normal, toward_viewer, axes, v);
    *albedo = 0;
    for (int i = 0; i < STEPS * STEPS; ++i) {
        const double z = (i / STEPS + drawn()) / STEPS, s = sqrt(1 - z * z);
        const double turn = 2 * M_PI * (i % STEPS + drawn()) / STEPS;
        const vec l = {s * cos(turn), s * sin(turn), z};
        const double value = 2 * M_PI * sheen_value(v, l, alpha) / (STEPS * STEPS);
        *albedo += value;
        sum += light == DIRECT ? 0 : value * local_radiance(light, position, axes, l);
    }
    if (light == DIRECT && to_light[2] > 0) {
        sum = M_PI * sheen_value(v, to_light, alpha) * fmax(*albedo, 1);
    }
    sum /= fmax(*albedo, 1);
    *albedo = fmin(*albedo, 1);
    return sum;
}

/* ---- Anisotropy: GGX around normals that are bent in the plane of N and the direction, toward V ---- */

/* Of a strength of 0.6 and a direction 30 degrees from that of u in make_brushed()'s shapes. */
static double brushed_light(int light, const vec position, const vec normal, double roughness) {
    const double share = pow(1 - 0.6 * (1 - roughness), 4), up = dot(normal, toward_viewer);
    vec t = {normal[2], 0, -normal[0]}, b, bent;
    normalize(t);
    cross(normal, t, b);
    const double along =
        cos(M_PI / 6) * dot(t, toward_viewer) + sin(M_PI / 6) * dot(b, toward_viewer);
    for (int k = 0; k < 3; ++k) {
        const double direction = cos(M_PI / 6) * t[k] + sin(M_PI / 6) * b[k];
        const double full = (up * normal[k] + along * direction) / hypot(up, along);
        bent[k] = full + share * (normal[k] - full);
    }
    normalize(bent);
    return gloss_light(light, position, bent, roughness * roughness, 0.5, 0.5);
}

/* Numbers, or a texture of -60 degrees that is turned by 90. */
static void brush(int is_textured, float roughness, burnish_material *material) {
    material->roughness = roughness;
    material->anisotropy[0] = is_textured ? 0 : 0.6f * (float)cos(M_PI / 6);
    material->anisotropy[1] = is_textured ? 1 : 0.6f * (float)sin(M_PI / 6);
    material->textures[BURNISH_TEXTURE_ANISOTROPY].texture = is_textured;
    material->edge_loss = 0.5f;
    set_three(material->reflectance, 0.5f);
    set_three(material->diffuse, 0);
}

/* A shape whose u is x and whose v is y, with tangents. */
static burnish_mesh *make_brushed(burnish_mesh *shape) {
    const burnish_mesh_view *view = burnish_mesh_get_view(shape);
    static const uint8_t texel[4] = {191, 17, 153, 255};
    const burnish_texture texture = {NULL, 1, 1, texel, 0};
    burnish_material material = base_material();
    float *coordinates = malloc(2 * view->vertex_count * sizeof *coordinates);
    for (size_t i = 0; i < 2 * view->vertex_count; ++i) {
        coordinates[i] = view->positions[3 * (i / 2) + i % 2];
    }
    burnish_mesh_description arrays =
        describe_arrays(view->positions, view->normals, NULL, view->vertex_count, view->indices,
                        view->triangle_count);
    brush(1, 0, &material);
    give_textures(&arrays, coordinates, &texture, 1);
    give_materials(&arrays, &material, 1);
    burnish_mesh *mesh = create_mesh(&arrays, NULL);
    burnish_mesh_destroy(shape);
    free(coordinates);
    return mesh;
}

/* What a layer reflects, and what it leaves of the light below it. */
static double layer_light(const burnish_material *layered, int light, const vec position,
                          const vec normal, double *below) {
    const double coat = (double)layered->coat, sheen = (double)layered->sheen[0];
    double albedo;
    if (layered->anisotropy[1] > 0) {
        *below = 0;
        return brushed_light(light, position, normal, (double)layered->roughness);
    }
    if (coat > 0) {
        *below = 1 - coat * schlick(0.04, dot(normal, toward_viewer));
        return coat * coat_light(light, position, normal, (double)layered->coat_roughness);
    }
    const double all =
        sheen_light(light, position, normal, (double)layered->sheen_roughness, &albedo);
    *below = 1 - sheen * albedo;
    return sheen * all;
}

/* Draws a mesh without and with a layer; errors of the second picture, and of the first. */
static void compare_layer(burnish_mesh *mesh, const burnish_render_options *options, int light,
                          const burnish_material *layered, errors e[2]) {
    burnish_material base = *layered;
    memset(base.anisotropy, 0, sizeof base.anisotropy);
    set_three(base.sheen, base.coat = 0);
    set_material(mesh, &base);
    draw_floats(mesh, options, plain[0][0], NULL);
    set_material(mesh, layered);
    draw_shape(mesh, options);
    for (int i = 3; i < SIDE * SIDE; i += 877) {
        const int x = i % SIDE, y = i / SIDE;
        vec position, normal;
        double below;
        if (!find_surface(x, y, position, normal)) {
            continue;
        }
        const double own = layer_light(layered, light, position, normal, &below);
        for (int k = 0; k < 3; ++k) {
            const double before = (double)plain[y][x][k], should = before * below + own;
            add_error(&e[0], (double)picture.rgba[y][x][k], should);
            add_error(&e[1], before, should);
        }
    }
}

/* Coats, sheen or anisotropy of four roughnesses, each with the most that its errors may be. A coat of
 * roughness 0 under a directional light has a highlight within a pixel. */
static void test_layer(burnish_mesh *const meshes[SHAPES], int light, int kind,
                       burnish_environment *environment) {
    static const float roughnesses[3][4] = {
        {0, 0.1f, 0.3f, 0.6f}, {0.2f, 0.4f, 0.7f, 1}, {0.1f, 0.3f, 0.4f, 0.5f}};
    static const double most[2][3][4] = {{{3, 1.5, 0.5, 1}, {6, 8, 4.5, 3}, {8, 8, 8, 8}},
                                         {{255, 4, 2, 4}, {0.3, 0.3, 0.3, 0.3}}};
    static const char *const names[3] = {"coat", "sheen", "anisotropy"};
    const burnish_render_options options = scene_options(light, environment);
    for (int i = 0; i < 4; ++i) {
        errors e[2] = {{0}};
        burnish_material layered = base_material();
        layered.coat = kind == 0 ? 0.8f : 0;
        set_three(layered.sheen, kind == 1 ? 0.6f : 0);
        layered.coat_roughness = layered.sheen_roughness = roughnesses[kind][i];
        if (kind == 2) {
            brush(i % 2, roughnesses[kind][i], &layered);
        }
        for (int shape = 0; shape < SHAPES; ++shape) {
            compare_layer(meshes[shape], &options, light, &layered, e);
        }
        const double rms = sqrt(e[0].squares / e[0].count), bias = e[0].sum / e[0].count;
        const double without = sqrt(e[1].squares / e[1].count);
        printf("  %s, light %d, roughness %.1f: RMS %.1f, bias %+.1f of 255; without %.1f\n",
               names[kind], light, (double)roughnesses[kind][i], rms, bias, without);
        CHECK(e[0].count > 300 && rms < most[light == DIRECT][kind][i] && fabs(bias) < 5 &&
                  rms < 0.9 * without,
              "%s, light %d, case %d: %g, %g, %g", names[kind], light, i, rms, bias, without);
    }
}

/* ---- Thin films: the formulas of KHR_materials_iridescence ---- */

/* Light of a path, channel k. */
static double film_sensitivity(int k, double path, double shift) {
    static const double from_xyz[3][3] = {{3.2404542, -1.5371385, -0.4985314},
                                          {-0.9692660, 1.8760108, 0.0415560},
                                          {0.0556434, -0.2040259, 1.0572252}};
    static const double value[3] = {5.4856e-13, 4.4201e-13, 5.2481e-13};
    static const double at[3] = {1.6810e6, 1.7953e6, 2.2084e6};
    static const double variance[3] = {4.3278e9, 9.3046e9, 6.6121e9};
    const double phase = 2 * M_PI * path * 1e-9;
    double sum = from_xyz[k][0] * 9.7470e-14 * sqrt(2 * M_PI * 4.5282e9) *
                 cos(2.2399e6 * phase + shift) * exp(-4.5282e9 * phase * phase);
    for (int j = 0; j < 3; ++j) {
        sum += from_xyz[k][j] * value[j] * sqrt(2 * M_PI * variance[j]) *
               cos(at[j] * phase + shift) * exp(-variance[j] * phase * phase);
    }
    return sum / 1.0685e-7;
}

/* Reflectance at normal incidence of a film of index 1.4 on a grey surface. */
static double film_light(int k, double facing, double thickness, double f0) {
    const double index = 1.4, base = (1 + sqrt(f0)) / (1 - sqrt(f0));
    const double inside = sqrt(1 - (1 - facing * facing) / (index * index));
    const double r12 = schlick(pow((index - 1) / (index + 1), 2), facing);
    const double r23 = schlick(pow((base - index) / (base + index), 2), inside);
    const double rs = (1 - r12) * (1 - r12) * r23 / (1 - r12 * r23);
    double sum = r12 + rs, factor = rs - (1 - r12);
    for (int m = 1; m <= 2; ++m) {
        const double shift = m * (base < index ? 2 * M_PI : M_PI);
        factor *= sqrt(r12 * r23);
        sum += factor * 2 * film_sensitivity(k, m * 2 * index * thickness * inside, shift);
    }
    const double edge = schlick(0, facing);
    return fmin(fmax((fmax(sum, 0) - edge) / (1 - edge), 0), 1);
}

/* A quad that is turned until a directional light is reflected toward the viewer. */
static void draw_film(double angle, const burnish_material *material, float rgba[4]) {
    enum { SMALL = 8 };
    const float x = (float)cos(angle), z = (float)sin(angle);
    const float corners[] = {-x, -1, -z, x, -1, z, x, 1, z, -x, 1, -z};
    burnish_mesh_description arrays = describe_quads(corners, NULL, 1);
    give_materials(&arrays, material, 1);
    OWNED_MESH *mesh = create_mesh(&arrays, NULL);
    burnish_render_options options = front_options(SMALL, SMALL, 1);
    float light[SMALL][SMALL][4];
    light_from(&options, -sin(2 * angle), 0, cos(2 * angle));
    draw_floats(mesh, &options, light[0][0], NULL);
    memcpy(rgba, light[SMALL / 2][SMALL / 2], sizeof light[0][0]);
}

static void test_film(void) {
    static const double thickness[5] = {40, 120, 300, 550, 1200};
    static const float f0[2] = {0.04f, 0.5f};
    burnish_material plain_one = base_material();
    double most = 0, spread = 0;
    plain_one.metallic = 1;
    plain_one.roughness = 0.8f;
    for (int i = 0; i < 30; ++i) {
        const double angle = i % 3 * 0.4, nm = thickness[i / 3 % 5], base = (double)f0[i / 15];
        float without[4], with[4];
        set_three(plain_one.diffuse, f0[i / 15]);
        burnish_material film = plain_one;
        film.iridescence = 1;
        film.film_index = 1.4f;
        film.film_thickness[1] = (float)nm;
        draw_film(angle, &plain_one, without);
        draw_film(angle, &film, with);
        for (int k = 0; k < 3; ++k) {
            const double ratio = (double)with[k] / (double)without[k];
            const double should = film_light(k, cos(angle), nm, base) / base;
            most = fmax(most, fabs(ratio - should) * base);
            spread = fmax(spread, fabs(should - 1));
        }
    }
    printf("  film: at most %.2g from its formula\n", most);
    CHECK(most < 1e-4 && spread > 0.5, "%g, %g", most, spread);
}

/* ---- Textures ---- */

enum { PIXELS = 40 };

static void draw_quad(const burnish_material *material, float light[PIXELS][PIXELS][4]) {
    static const float corners[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    static const float coordinates[] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const uint8_t texels[4][4] = {
        {128, 200, 0, 255}, {87, 165, 242, 255}, {200, 90, 220, 255}, {128, 128, 128, 255}};
    burnish_texture textures[4];
    for (int i = 0; i < 4; ++i) {
        textures[i] = (burnish_texture){NULL, 1, 1, texels[i], 0};
    }
    burnish_mesh_description arrays = describe_quads(corners, NULL, 1);
    give_textures(&arrays, coordinates, textures, 4);
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
    const float *x = light[0][0][0], *y = light[1][0][0];
    double difference = 0;
    *most = 0;
    draw_quad(a, light[0]);
    draw_quad(b, light[1]);
    for (int i = 0; i < PIXELS * PIXELS * 4; ++i) {
        if (i % 4 < 3) {
            difference = fmax(difference, fabs((double)x[i] - (double)y[i]));
            *most = fmax(*most, (double)x[i]);
        }
    }
    return difference;
}

/* Textures of layers multiply their numbers, and a coat's normals are its texture's alone. */
static void test_layer_textures(void) {
    const burnish_texture_use uses[4] = {{.texture = 1},
                                         {.texture = 2, .strength = 1},
                                         {.texture = 3, .strength = 1},
                                         {.texture = 4}};
    burnish_material numbers = base_material(), textured = base_material();
    double most;
    numbers.coat = 128.0f / 255;
    numbers.coat_roughness = 0.5f * 200 / 255;
    textured.coat = 1;
    textured.coat_roughness = 0.5f;
    textured.textures[BURNISH_TEXTURE_COAT] = uses[0];
    textured.textures[BURNISH_TEXTURE_COAT_ROUGHNESS] = uses[0];
    CHECK1(differ(&numbers, &textured, &most) < 3e-4 && most > 0.1);

    numbers = textured = base_material();
    set_three(numbers.reflectance, 0.5f * 128 / 255);
    set_three(textured.reflectance, 0.5f);
    numbers.edge_loss = 1 - 128.0f / 255;
    textured.textures[BURNISH_TEXTURE_SPECULAR_STRENGTH] = uses[0];
    CHECK1(differ(&numbers, &textured, &most) < 3e-4 && most > 0.1);

    numbers = textured = base_material();
    set_three(numbers.sheen, 0.6f * 128 / 255);
    set_three(textured.sheen, 0.6f);
    numbers.sheen_roughness = 0.8f * 87 / 255;
    textured.sheen_roughness = 0.8f;
    textured.textures[BURNISH_TEXTURE_SHEEN_COLOR] = uses[3];
    textured.textures[BURNISH_TEXTURE_SHEEN_ROUGHNESS] = uses[1];
    CHECK1(differ(&numbers, &textured, &most) < 3e-4 && most > 0.1);

    numbers = textured = base_material();
    numbers.film_index = textured.film_index = 1.3f;
    numbers.iridescence = 128.0f / 255;
    numbers.film_thickness[1] = 200 + 300 * 165.0f / 255;
    textured.iridescence = 1;
    textured.film_thickness[0] = 200;
    textured.film_thickness[1] = 500;
    textured.textures[BURNISH_TEXTURE_IRIDESCENCE] = uses[0];
    textured.textures[BURNISH_TEXTURE_FILM] = uses[1];
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
    burnish_mesh *meshes[SHAPES];
    test_begin(count, arguments, NULL);
    seed = test_seed(6);
    burnish_environment *environment = make_room();
    make_shapes(meshes);
    for (int i = 0; i < SHAPES; ++i) {
        meshes[i] = make_brushed(meshes[i]);
    }
    for (int light = 0; light <= DIRECT; ++light) {
        RUN(test_layer(meshes, light, 0, environment));
        RUN(test_layer(meshes, light, 1, environment));
        if (light < LIGHTS) {
            RUN(test_layer(meshes, light, 2, environment));
        }
    }
    RUN(test_film());
    RUN(test_layer_textures());
    burnish_environment_destroy(environment);
    for (int i = 0; i < SHAPES; ++i) {
        burnish_mesh_destroy(meshes[i]);
    }
    return test_end("finishes");
}
