/* Masked triangles cast the shadow of the part that the mask leaves. */
#include <math.h>

#include "draw_floats.h"
#include "mesh_arrays.h"
#include "support.h"

enum { SIZE = 96 };

typedef struct picture {
    float pixels[SIZE * SIZE * 4];
} picture;

/* A floor and a card above it, from x = -1 to `right`; alpha: of the right half of its image. */
static void draw_card(const burnish_material *card, float right, uint8_t alpha, int shadow,
                      int occlusion, picture *to) {
    const uint8_t texels[] = {255, 255, 255, 255, 255, 255, 255, alpha};
    static const float coordinates[] = {0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 1};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    static const uint16_t triangle_materials[] = {0, 0, 1, 1};
    const float positions[] = {-2, -2, 0, 2,     -2, 0, 2,     2, 0, -2, 2, 0,
                               -1, -1, 1, right, -1, 1, right, 1, 1, -1, 1, 1};
    const burnish_texture texture = {NULL, 2, 1, texels, 1};
    const burnish_material materials[2] = {burnish_material_default(), *card};
    burnish_mesh_description arrays = describe_arrays(positions, NULL, NULL, 8, indices, 4);
    burnish_render_options options = burnish_render_options_default();
    burnish_render_report report;
    arrays.texture_coordinates = (burnish_array){coordinates, 8, 0};
    arrays.materials = materials;
    arrays.material_count = 2;
    arrays.triangle_materials = (burnish_array){triangle_materials, 4, 0};
    arrays.textures = &texture;
    arrays.texture_count = 1;
    burnish_mesh *mesh = create_mesh(&arrays, NULL);
    options.width = options.height = SIZE;
    options.camera = (burnish_camera){{3, -6, 5}, {0, 0, 0}, {0, 0, 1}, 45, 0};
    options.light_count = 1;
    options.lights[0] = (burnish_light){BURNISH_LIGHT_DIRECTIONAL, 0, {0.2, 0.3, 0.9}, {1, 1, 1}};
    options.shadow = shadow;
    options.occlusion = occlusion;
    draw_floats(mesh, &options, to->pixels, &report);
    burnish_mesh_destroy(mesh);
}

/* Pixels whose light differs by more than a twentieth. */
static int different_pixels(const picture *a, const picture *b) {
    int count = 0;
    for (int i = 0; i < SIZE * SIZE; ++i) {
        count += fabsf(a->pixels[4 * i] - b->pixels[4 * i]) > 0.05f;
    }
    return count;
}

static burnish_material masked(float cutoff) {
    burnish_material material = burnish_material_default();
    material.textures[BURNISH_TEXTURE_COLOR].texture = 1;
    material.textures[BURNISH_TEXTURE_COLOR].wrap[0] = BURNISH_WRAP_CLAMP;
    material.alpha_mode = BURNISH_ALPHA_MASK;
    material.alpha_cutoff = cutoff;
    return material;
}

/* Half of the card casts what half a card does. */
static void test_half(int shadow, int occlusion) {
    static picture opaque, left, none;
    const burnish_material plain = burnish_material_default();
    const burnish_material half = masked(0.5f);
    draw_card(&plain, 0, 255, shadow, occlusion, &opaque);
    draw_card(&half, 1, 0, shadow, occlusion, &left);
    draw_card(&plain, 0, 255, 0, 0, &none);
    CHECK(different_pixels(&opaque, &none) > 150, "shadow %d: it shows in %d pixels", shadow,
          different_pixels(&opaque, &none));
    CHECK(different_pixels(&opaque, &left) < 40, "shadow %d: %d pixels differ", shadow,
          different_pixels(&opaque, &left));
}

/* A mask that leaves nothing casts nothing, one that leaves all casts as a whole card does. */
static void test_extremes(void) {
    static picture whole, all, nothing, without;
    const burnish_material plain = burnish_material_default();
    burnish_material material = masked(0.1f);
    draw_card(&plain, 1, 255, 1, 0, &whole);
    draw_card(&material, 1, 60, 1, 0, &all);
    CHECK(different_pixels(&whole, &all) == 0, "%d pixels differ", different_pixels(&whole, &all));
    material.alpha_cutoff = 0.5f;
    material.transparency = 0.6f;
    draw_card(&material, 1, 0, 1, 0, &nothing);
    draw_card(&material, 1, 0, 0, 0, &without);
    CHECK(different_pixels(&nothing, &without) == 0, "%d pixels differ",
          different_pixels(&nothing, &without));
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_half(1, 0));
    RUN(test_half(0, 48));
    RUN(test_extremes());
    return test_end("casters");
}
