/* The mesh as the library holds it, and the checks that every way into it shares. */
#ifndef BURNISH_MESH_MESH_H
#define BURNISH_MESH_MESH_H

#include "core/error.h"
#include "mesh/mesh_data.h"

/* What the ..._default() functions leave in `cookie`: the struct's name and version. One that was
 * not started from them is refused instead of being read as garbage. */
#define BURNISH_LOAD_OPTIONS_COOKIE 0x6c6f6432u /* "lod2" */
#define BURNISH_DESCRIPTION_COOKIE 0x6d736831u  /* "msh1" */
#define BURNISH_FRAMING_COOKIE 0x66726d32u      /* "frm2" */

struct burnish_mesh {
    burnish_mesh_view view; /* its pointers are the arrays below */
    burnish_mesh_info info;
    const burnish_context *context; /* where all arrays come from */

    void *attributes[BURNISH_ATTRIBUTE_COUNT]; /* vertex_count items each; NULL: none */
    uint32_t *indices;
    uint16_t *triangle_materials;

    burnish_material *materials;
    size_t material_count;

    char **warnings;
    size_t warning_count;
};

/* What every public function that loads looks at first: the place for the mesh, which becomes NULL,
 * and the options.
 * Errors: ARGUMENT (NULL, not started from burnish_load_options_default(), a field out of range).
 */
burnish_status burnish_check_load(const burnish_load_options *options, burnish_mesh **mesh,
                                  burnish_error *error);

/* LIMIT, with its line, where `count` triangles are more than the options allow. `where` is what
 * the line starts with: the input's name, and a location in it. */
burnish_status burnish_check_triangle_count(const burnish_load_options *options, const char *where,
                                            uint64_t count, burnish_error *error);

/* ARGUMENT, with its line, where a coefficient or the exponent is out of range; `name` is what the
 * line starts with. */
burnish_status burnish_check_material(const burnish_material *material, const char *name,
                                      burnish_error *error);

#endif
