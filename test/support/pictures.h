/* For tests: pictures of meshes, as images, as linear light or with planes, and what their scenes
 * have in common. */
#ifndef BURNISH_TEST_PICTURES_H
#define BURNISH_TEST_PICTURES_H

#include "burnish/kernels.h"
#include "burnish/render.h"
#include "mesh_arrays.h"

/* ---- Drawing ---- */

/* Rows of planes follow one another without a gap; NULL: without the plane. */
static inline burnish_target make_target(burnish_pixels pixels, float *depth, float *normals,
                                         uint32_t *triangles, uint8_t *coverage) {
    const size_t width = (size_t)pixels.width;
    burnish_target target = burnish_target_default();
    target.pixels = pixels;
    target.depth = depth;
    target.depth_stride = width * sizeof *depth;
    target.normals = normals;
    target.normal_stride = 3 * width * sizeof *normals;
    target.triangles = triangles;
    target.triangle_stride = width * sizeof *triangles;
    target.coverage = coverage;
    target.coverage_stride = width;
    return target;
}

static inline burnish_pixels floats_of(float *light, int width, int height) {
    return (burnish_pixels){width, height, BURNISH_PIXELS_RGBA_FLOAT, (size_t)width * 16,
                            (uint8_t *)light};
}

static inline burnish_renderer *make_renderer(const burnish_context *context) {
    burnish_renderer *renderer = NULL;
    burnish_error error = {0};
    CHECK_OK(burnish_renderer_create(context, &renderer, &error), error);
    return renderer;
}

/* Draws by a new renderer. report: may be NULL, here and below. */
static inline void draw_into(const burnish_mesh *mesh, const burnish_render_options *options,
                             const burnish_target *target, burnish_render_report *report) {
    burnish_renderer *renderer = make_renderer(NULL);
    burnish_error error = {0};
    CHECK_OK(burnish_renderer_draw_into(renderer, mesh, options, target, report, &error), error);
    burnish_renderer_destroy(renderer);
}

/* 4 floats a pixel. */
static inline void draw_floats(const burnish_mesh *mesh, const burnish_render_options *options,
                               float *light, burnish_render_report *report) {
    const burnish_target target =
        make_target(floats_of(light, options->width, options->height), NULL, NULL, NULL, NULL);
    draw_into(mesh, options, &target, report);
}

static inline burnish_image draw_image(const burnish_mesh *mesh,
                                       const burnish_render_options *options,
                                       burnish_render_report *report) {
    burnish_image image = {0};
    burnish_error error = {0};
    CHECK_OK(burnish_render(mesh, options, &image, report, &error), error);
    return image;
}

static inline uint64_t hash_drawn(const burnish_mesh *mesh, const burnish_render_options *options) {
    burnish_image image = draw_image(mesh, options, NULL);
    const uint64_t hash = burnish_image_hash(&image);
    burnish_image_destroy(&image);
    return hash;
}

/* ---- Scenes ---- */

static inline void set_three(float to[3], float value) {
    to[0] = to[1] = to[2] = value;
}

/* From (0, 0, 10) along -z in parallel projection, `height` high, one sample a pixel, on black. */
static inline burnish_render_options front_options(int width, int height, double view_height) {
    burnish_render_options options = burnish_render_options_default();
    options.width = width;
    options.height = height;
    options.samples = 1;
    options.camera.position[2] = 10;
    options.camera.orthographic_height = view_height;
    memset(options.background, 0, sizeof options.background);
    return options;
}

/* The whole mesh, from the default direction. */
static inline burnish_render_options framed_options(const burnish_mesh *mesh, int width,
                                                    int height) {
    burnish_render_options options = burnish_render_options_default();
    burnish_framing framing = burnish_framing_default();
    burnish_error error = {0};
    options.width = width;
    options.height = height;
    framing.aspect = (double)width / height;
    CHECK_OK(burnish_camera_frame(mesh, &framing, &options.camera, &error), error);
    return options;
}

/* Ambient light of 1 alone: surfaces have their ambient colour. */
static inline void light_evenly(burnish_render_options *options) {
    options->light_count = 0;
    set_three(options->ambient_light, 1);
}

/* One directional light, and no ambient light. */
static inline void light_from(burnish_render_options *options, double x, double y, double z) {
    options->light_count = 1;
    options->lights[0] = (burnish_light){.vector = {x, y, z}, .color = {1, 1, 1}};
    set_three(options->ambient_light, 0);
}

/* Grey, without a specular part. */
static inline burnish_material matt_material(float color) {
    burnish_material material = burnish_material_default();
    set_three(material.ambient, color);
    set_three(material.diffuse, color);
    set_three(material.specular, 0);
    return material;
}

static inline void set_material(burnish_mesh *mesh, const burnish_material *material) {
    burnish_error error = {0};
    CHECK_OK(burnish_mesh_set_material(mesh, 0, material, &error), error);
}

/* White, metallic-roughness. */
static inline void set_metal(burnish_mesh *mesh, float metallic, float roughness) {
    burnish_material material = burnish_material_default();
    set_three(material.diffuse, 1);
    set_three(material.reflectance, 0.04f);
    material.has_diffuse = material.is_metallic = 1;
    material.metallic = metallic;
    material.roughness = roughness;
    set_material(mesh, &material);
}

#endif
