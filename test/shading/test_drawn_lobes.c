/* What the renderer draws are the lobes of theory.h: peaks of arrays, recommended lobes, and sums of
 * lobes for rough surfaces. */
#include <math.h>

#include "burnish/render.h"
#include "burnish/theory.h"
#include "environment/area_lights.h"
#include "support.h"

/* Arrays have the peak that the fit gives. */
static void check_affine_array(void) {
    const burnish_lobe_spec lobe = {.fit = BURNISH_FIT_AFFINE, .order = 4};
    float values[3] = {1, 0.97f, 0.2f};
    double zeta, scale;
    CHECK1(burnish_lobe_solve(&lobe, 50, &zeta, &scale) == BURNISH_LOBE_OK && scale < 0.99);
    CHECK1(burnish_kernels_lobe_of_cosines(burnish_kernels_best(), &lobe, 50, 3, values, values,
                                           NULL) == BURNISH_STATUS_OK);
    CHECK1(values[0] == (float)scale && values[2] == 0);
    CHECK1(fabs((double)values[1] - scale * burnish_theory_family(zeta, 4, (double)0.97f)) < 1e-6);
}

/* Every lobe that a choice recommends. */
static void check_choice_is_drawn(void) {
    static const double epsilons[] = {0.3, 0.1, 0.06, 0.03, 0.0285, 0.01, 1 / 256.0, 0.001, 1e-6};
    int drawn = 0;
    burnish_mesh *sphere;
    burnish_load_options load = burnish_load_options_default();
    load.tessellation = 2;
    if (!CHECK1(burnish_mesh_load(":sphere", &load, &sphere, NULL) == BURNISH_STATUS_OK)) {
        return;
    }
    burnish_render_options options = burnish_render_options_default();
    options.width = options.height = 12;
    options.threads = 1;
    options.camera.position[2] = 5;
    for (double n = 1; n < 65536; n = n < 4 ? n + 0.25 : n * 1.8) {
        burnish_material material = burnish_material_default();
        material.exponent = (float)n;
        CHECK1(burnish_mesh_set_material(sphere, 0, &material, NULL) == BURNISH_STATUS_OK);
        for (size_t i = 0; i < 2 * sizeof epsilons / sizeof epsilons[0]; ++i) {
            burnish_theory_model model;
            burnish_error error = {BURNISH_STATUS_OK, ""};
            burnish_image image;
            burnish_render_report report;
            char name[BURNISH_LOBE_NAME_SIZE];
            CHECK1(burnish_theory_choose((double)(float)n, epsilons[i / 2], i % 2, &model, NULL,
                                         NULL, NULL) == BURNISH_STATUS_OK);
            burnish_lobe_spec_name(&model.lobe, name, sizeof name);
            if (!CHECK_OK(burnish_lobe_spec_parse(name, &options.lobe, &error), error)) {
                continue;
            }
            CHECK(burnish_render(sphere, &options, &image, &report, &error) == BURNISH_STATUS_OK &&
                      report.lobe_fallbacks == 0,
                  "%s at n=%g: %zu fallbacks, %s", name, n, report.lobe_fallbacks, error.text);
            burnish_image_destroy(&image);
            ++drawn;
        }
    }
    burnish_mesh_destroy(sphere);
    CHECK(drawn > 200, "%d lobes drawn", drawn);
}

/* A material that states its exponent is drawn with the exact lobe, others with energy:2, and all
 * with a lobe that is not by_material. */
static void check_stated_exponents(void) {
    burnish_mesh *sphere;
    burnish_image images[4] = {{0}};
    burnish_load_options load = burnish_load_options_default();
    burnish_render_options options = burnish_render_options_default();
    if (!CHECK1(burnish_mesh_load(":sphere", &load, &sphere, NULL) == BURNISH_STATUS_OK)) {
        return;
    }
    options.width = options.height = 64;
    options.threads = 1;
    options.camera.position[2] = 5;
    for (int i = 0; i < 4; ++i) {
        burnish_material material = burnish_material_default();
        material.has_exponent = i != 1;
        options.lobe = burnish_render_options_default().lobe;
        if (i == 2) {
            options.lobe = (burnish_lobe_spec){.kind = BURNISH_LOBE_EXACT};
        } else if (i == 3) {
            options.lobe.by_material = 0;
        }
        CHECK1(burnish_mesh_set_material(sphere, 0, &material, NULL) == BURNISH_STATUS_OK);
        CHECK1(burnish_render(sphere, &options, &images[i], NULL, NULL) == BURNISH_STATUS_OK);
    }
    burnish_mesh_destroy(sphere);
    const size_t size =
        (size_t)images[0].width * (size_t)images[0].height * (size_t)images[0].channels;
    CHECK1(memcmp(images[0].pixels, images[2].pixels, size) == 0);
    CHECK1(memcmp(images[1].pixels, images[3].pixels, size) == 0);
    CHECK1(memcmp(images[0].pixels, images[1].pixels, size) != 0);
    for (int i = 0; i < 4; ++i) {
        burnish_image_destroy(&images[i]);
    }
}

/* The renderer's floats have the same polynomials; slopes of near lights are 0.78 of them. */
static void check_sums(void) {
    for (int i = 2; i <= 201; ++i) {
        const double alpha = (float)(0.01 * (i / 2)), scale = i % 2 ? 0.78 : 1;
        const burnish_light_lobes lobes =
            i % 2 ? burnish_light_lobes_near((float)alpha) : burnish_light_lobes_for((float)alpha);
        burnish_theory_lobe_sum sum;
        CHECK1(!burnish_theory_lobe_sum_fit(BURNISH_THEORY_GGX, alpha, lobes.count, &sum, NULL));
        for (int j = 0; j < lobes.count; ++j) {
            CHECK(lobes.lobe[j].order == sum.order[j] &&
                      fabs(lobes.lobe[j].zeta / fmax(1, scale * sum.zeta[j]) - 1) < 1e-5 &&
                      fabs(lobes.lobe[j].weight - sum.weight[j]) < 1e-6,
                  "alpha %g, lobe %d: zeta %g, not %g, weight %g, not %g", alpha, j,
                  lobes.lobe[j].zeta, sum.zeta[j], lobes.lobe[j].weight, sum.weight[j]);
        }
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(check_affine_array());
    RUN(check_choice_is_drawn());
    RUN(check_stated_exponents());
    RUN(check_sums());
    return test_end("drawn_lobes");
}
