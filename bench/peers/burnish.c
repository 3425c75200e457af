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

int main(int count, char **arguments) {
    const burnish_peers_contestant burnish = {open_renderer, frame, picture, close_renderer};
    return burnish_peers_serve(&burnish, count, arguments);
}
