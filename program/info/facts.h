/* Facts of a mesh as text, JSON and CSV. */
#ifndef TOOL_INFO_FACTS_H
#define TOOL_INFO_FACTS_H

#include <cjson/cJSON.h>
#include <stdio.h>

#include "burnish/mesh.h"
#include "render/scene/up.h"

typedef struct info_report {
    const char *input;
    int format; /* of --input-format */
    const burnish_mesh *mesh;
    const burnish_mesh_view *view;
    const burnish_mesh_facts *facts; /* NULL: the input has points or lines instead of faces */
    float low[3], high[3], size[3];
    render_stance stance;
    burnish_box *boxes; /* of the parts */
} info_report;

void info_print_text(FILE *stream, const info_report *r);

/* Sets *failed to 1 if memory is short. */
cJSON *info_make_json(const info_report *r, int *failed);

/* The names of the columns, and a row with the values of a JSON object. */
void info_print_csv_head(FILE *stream);
void info_print_csv_row(FILE *stream, const cJSON *root);

#endif
