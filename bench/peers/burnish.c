/* burnish as a contestant: one call of burnish_renderer_draw per frame, which keeps its memory
 * between frames, into the same image, encoded in sRGB. Its lobes are the public
 * interface's. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "worker.h"

typedef struct contestant {
    const burnish_peers_job *job;
    burnish_renderer *renderer;
    burnish_image image;
    burnish_render_options options;
} contestant;

static int open_renderer(void **state, const burnish_peers_job *job, int threads, char *note) {
    contestant *made = calloc(1, sizeof *made);
    burnish_error error;
    if (!made || burnish_renderer_create(NULL, &made->renderer, &error) != BURNISH_STATUS_OK) {
        free(made);
        return 0;
    }
    made->job = job;
    made->options = job->options;
    snprintf(note, BURNISH_PEERS_NOTE, "burnish, %s kernels, %d thread%s, %zu triangles",
             burnish_isa_name(burnish_kernels_get_isa(NULL)), threads, threads == 1 ? "" : "s",
             burnish_mesh_get_view(job->scene)->triangle_count);
    *state = made;
    return 1;
}

static int choose(contestant *r, const char *variant) {
    static const struct {
        const char *variant, *lobe;
        int two_sided;
    } LOBES[] = {{"family", "energy:2", 0},
                 {"family-two-sided", "energy:2", 1},
                 {"power", "power", 0},
                 {"schlick", "schlick", 0}};
    burnish_error error;
    for (size_t i = 0; i < sizeof LOBES / sizeof *LOBES; ++i) {
        if (strcmp(variant, LOBES[i].variant) == 0) {
            r->options.cull_back_faces = !LOBES[i].two_sided;
            return burnish_lobe_spec_parse(LOBES[i].lobe, &r->options.lobe, &error) ==
                   BURNISH_STATUS_OK;
        }
    }
    return 0;
}

static int draw(contestant *r) {
    burnish_error error;
    return burnish_renderer_draw(r->renderer, r->job->scene, &r->options, &r->image, NULL,
                                 &error) == BURNISH_STATUS_OK;
}

static int frame(void *state, const char *variant, double *milliseconds) {
    contestant *r = state;
    if (!choose(r, variant)) {
        return 0;
    }
    double start = burnish_peers_now(r->job);
    int drawn = draw(r);
    *milliseconds = burnish_peers_now(r->job) - start;
    return drawn;
}

static int picture(void *state, const char *variant, uint8_t *rgb) {
    contestant *r = state;
    if (!choose(r, variant) || !draw(r)) {
        return 0;
    }
    memcpy(rgb, r->image.pixels, (size_t)BURNISH_PEERS_PIXELS * 3);
    return 1;
}

static void close_renderer(void *state) {
    contestant *r = state;
    burnish_renderer_destroy(r->renderer);
    burnish_image_destroy(&r->image);
    free(r);
}

/* The mesh without shared vertices, each triangle in the colour of its number + 1. */
static burnish_status numbered_scene(const burnish_mesh_view *mesh, burnish_mesh **scene,
                                     burnish_error *error) {
    size_t corners = 3 * mesh->triangle_count;
    burnish_load_options load = burnish_load_options_default();
    float *positions = malloc(3 * corners * sizeof *positions);
    float *normals = malloc(3 * corners * sizeof *normals);
    uint8_t *colors = malloc(4 * corners);
    burnish_status status = BURNISH_STATUS_MEMORY;
    if (positions && normals && colors) {
        for (size_t i = 0; i < corners; ++i) {
            size_t number = i / 3 + 1, vertex = mesh->indices[i];
            memcpy(positions + 3 * i, mesh->positions + 3 * vertex, 3 * sizeof(float));
            memcpy(normals + 3 * i, mesh->normals + 3 * vertex, 3 * sizeof(float));
            const uint8_t color[4] = {(uint8_t)(number >> 16), (uint8_t)(number >> 8),
                                      (uint8_t)number, 255};
            memcpy(colors + 4 * i, color, sizeof color);
        }
        burnish_mesh_description arrays = burnish_mesh_description_default();
        arrays.positions = (burnish_array){positions, corners, 0};
        arrays.normals = (burnish_array){normals, corners, 0};
        arrays.colors = (burnish_array){colors, corners, 0};
        status = burnish_mesh_create(&arrays, &load, scene, error);
    }
    free(positions);
    free(normals);
    free(colors);
    return status;
}

/* Draws the triangles' numbers as colours, lit by ambient light alone. */
static int triangles(void *state, uint32_t *numbers) {
    contestant *r = state;
    burnish_mesh *scene = NULL;
    burnish_image image;
    burnish_error error;
    burnish_render_options options = r->job->options;
    burnish_material material = burnish_material_default();
    const float white[3] = {1, 1, 1};
    if (burnish_mesh_get_view(r->job->scene)->triangle_count >= 1 << 24 ||
        numbered_scene(burnish_mesh_get_view(r->job->scene), &scene, &error) != BURNISH_STATUS_OK) {
        return 0;
    }
    options.light_count = 0;
    memcpy(options.ambient_light, white, sizeof white);
    memcpy(material.ambient, white, sizeof white);
    memcpy(material.diffuse, white, sizeof white);
    memset(material.specular, 0, sizeof material.specular);
    material.has_diffuse = 1;
    int done = burnish_mesh_set_material(scene, 0, &material, &error) == BURNISH_STATUS_OK &&
               burnish_render(scene, &options, &image, NULL, &error) == BURNISH_STATUS_OK;
    for (size_t i = 0; done && i < BURNISH_PEERS_PIXELS; ++i) {
        const uint8_t *p = image.pixels + 3 * i;
        numbers[i] = ((uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2]) - 1;
    }
    if (done) {
        burnish_image_destroy(&image);
    }
    burnish_mesh_destroy(scene);
    return done;
}

int main(int count, char **arguments) {
    const burnish_peers_contestant burnish = {open_renderer, frame, picture, triangles,
                                              close_renderer};
    return burnish_peers_serve(&burnish, count, arguments);
}
