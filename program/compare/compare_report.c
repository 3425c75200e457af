/* The report of `burnish compare`: text and JSON. */
#include <math.h>
#include <string.h>

#include "base/cli/output.h"
#include "compare/sides.h"
#include "render/output/result.h"
#include "render/scene/cameras.h"

/* ---- Facts of meshes ---- */

enum { FACTS = 9 };

typedef struct fact {
    const char *key, *name;
    double value;
} fact;

static void list_facts(const compare_side *side, fact facts[FACTS]) {
    const burnish_mesh_facts *f = burnish_mesh_get_facts(side->result.mesh);
    float low[3], high[3];
    burnish_mesh_get_bounds(side->result.mesh, low, high);
    const fact all[FACTS] = {
        {"triangles", "triangles", f ? (double)f->triangle_count : 0},
        {"vertices", "vertices", f ? (double)f->vertex_count : NAN},
        {"shells", "shells", f ? (double)f->shell_count : NAN},
        {"open_edges", "open edges", f ? (double)f->open_edge_count : NAN},
        {"size_x", "size along x", (double)(high[0] - low[0])},
        {"size_y", "size along y", (double)(high[1] - low[1])},
        {"size_z", "size along z", (double)(high[2] - low[2])},
        {"area", "area", f ? f->area : NAN},
        {"volume", "volume", f && f->is_closed && f->is_consistent ? f->volume : NAN}};
    memcpy(facts, all, sizeof all);
}

static int have_facts(const comparison *c) {
    return compare_is_mesh(&c->sides[0]) && compare_is_mesh(&c->sides[1]) && !c->lobes;
}

static int same_number(double a, double b) {
    return a == b || (isnan(a) && isnan(b));
}

static void print_fact(FILE *stream, double value) {
    if (isnan(value)) {
        fprintf(stream, "none");
    } else {
        fprintf(stream, "%.9g", value);
    }
}

static void print_facts(FILE *stream, const comparison *c) {
    fact facts[2][FACTS];
    int differing = 0;
    list_facts(&c->sides[0], facts[0]);
    list_facts(&c->sides[1], facts[1]);
    fputc('\n', stream);
    for (int i = 0; i < FACTS; ++i) {
        const double a = facts[0][i].value, b = facts[1][i].value;
        if (!same_number(a, b)) {
            fprintf(stream, "  %-20s  ", facts[0][i].name);
            print_fact(stream, a);
            fprintf(stream, " and ");
            print_fact(stream, b);
            fputc('\n', stream);
            differing = 1;
        }
    }
    if (!differing) {
        fprintf(stream, "  the meshes have the same size, area, volume and counts\n");
    }
}

/* ---- JSON ---- */

static cJSON *facts_object(const compare_side *side, int *failed) {
    cJSON *object = cJSON_CreateObject();
    fact facts[FACTS];
    list_facts(side, facts);
    for (int i = 0; i < FACTS; ++i) {
        cli_json_add(object, facts[i].key, cli_json_real(facts[i].value), failed);
    }
    return object;
}

static void add_side(cJSON *root, const comparison *c, int i, int *failed) {
    const compare_side *side = &c->sides[i];
    cJSON *object = cJSON_CreateObject();
    cli_json_add(object, "input", cli_json_text(side->input), failed);
    cli_json_add(object, "kind", cJSON_CreateString(compare_is_mesh(side) ? "mesh" : "picture"),
                 failed);
    cli_json_add(object, "width", cJSON_CreateNumber(compare_image(side)->width), failed);
    cli_json_add(object, "height", cJSON_CreateNumber(compare_image(side)->height), failed);
    if (compare_is_mesh(side)) {
        char lobe[32];
        burnish_lobe_spec_name(&side->cell.lobe, lobe, sizeof lobe);
        cli_json_add(object, "lobe", cJSON_CreateString(lobe), failed);
        cli_json_add(object, "camera",
                     render_camera_object(&side->cell.camera,
                                          burnish_mesh_get_view(side->result.mesh)->origin, failed),
                     failed);
        cli_json_add(object, "up",
                     cJSON_CreateString(render_up_name(side->result.mesh, &side->settings.camera)),
                     failed);
        cli_json_add(object, "facts", facts_object(side, failed), failed);
        cli_json_add(object, "warnings",
                     cli_json_texts(side->result.warnings.count, side->result.warnings.lines),
                     failed);
    }
    cli_json_add(root, i == 0 ? "a" : "b", object, failed);
}

static burnish_status print_json(FILE *stream, const comparison *c, burnish_error *error) {
    int failed = 0;
    cJSON *root = cJSON_CreateObject();
    cli_json_add(root, "burnish", cJSON_CreateString(burnish_version()), &failed);
    add_side(root, c, 0, &failed);
    add_side(root, c, 1, &failed);
    cli_json_add(root, "output",
                 c->settings->output ? cli_json_text(c->settings->output) : cJSON_CreateNull(),
                 &failed);
    cli_json_add(root, "moved", cli_json_reals(3, c->moved), &failed);
    picture_add_verdict(root, &c->settings->rule, &c->verdict, &failed);
    return cli_json_print(stream, root, failed, error);
}

/* ---- Text ---- */

static void print_text(FILE *stream, const comparison *c) {
    const burnish_image *image = compare_image(&c->sides[0]);
    fprintf(stream, "%s and %s, %d x %d pixels: %s\n\n", c->sides[0].label, c->sides[1].label,
            image->width, image->height,
            c->verdict.numbers.different_pixels == 0 ? "the same"
            : c->verdict.passes                      ? "alike"
                                                     : "different");
    picture_print_verdict(stream, &c->verdict);
    if (!c->settings->align && have_facts(c) && c->verdict.numbers.silhouette_iou == 0) {
        fprintf(stream, "  A and B are at different places; --align moves B onto A\n");
    }
    if (c->settings->align) {
        fprintf(stream, "  B is moved by        %9.6g, %.6g, %.6g\n", c->moved[0], c->moved[1],
                c->moved[2]);
    }
    if (have_facts(c)) {
        print_facts(stream, c);
    }
}

burnish_status compare_write_report(const comparison *c, burnish_error *error) {
    const char *json = c->settings->json;
    cli_output output;
    if (!json && (c->settings->render.job.quiet ||
                  (c->settings->output && strcmp(c->settings->output, "-") == 0))) {
        return BURNISH_STATUS_OK; /* - has the picture */
    }
    burnish_status status = cli_output_begin(&output, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (json) {
        status = print_json(output.stream, c, error);
    } else {
        print_text(output.stream, c);
    }
    return cli_output_end(&output, json ? json : "-", status, error);
}
