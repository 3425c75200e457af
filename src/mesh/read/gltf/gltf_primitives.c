/* glTF's primitives: the attributes of each, and how many triangles, lines or points it makes. Each
 * is read once, however many nodes draw it. */

#include "mesh/read/gltf/gltf.h"

#include <stdio.h>
#include <string.h>

enum { POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN };

#define WIDTH(width) (1u << (width))

/* The number of an attribute's accessor, whose type is checked; NONE if absent. */
static uint32_t read_attribute(burnish_gltf *gltf, const burnish_gltf_primitive *primitive,
                               uint32_t attributes, const char *name, unsigned widths) {
    const uint32_t number = burnish_gltf_reference(gltf, attributes, name, BURNISH_GLTF_ACCESSORS);
    if (number == BURNISH_GLTF_NONE || gltf->status != BURNISH_STATUS_OK) {
        return BURNISH_GLTF_NONE;
    }
    const burnish_gltf_accessor *accessor = burnish_gltf_resolve(
        gltf, number, burnish_json_member(&gltf->json, attributes, name), widths);
    if (!accessor) {
        return BURNISH_GLTF_NONE;
    }
    if (primitive->position != BURNISH_GLTF_NONE &&
        accessor->count < gltf->accessors[primitive->position].count) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT,
                          burnish_json_member(&gltf->json, attributes, name),
                          "has %zu values for %zu positions", accessor->count,
                          gltf->accessors[primitive->position].count);
        return BURNISH_GLTF_NONE;
    }
    return number;
}

/* Joints are unsigned integers of at most 16 bits; each set of them comes with weights. */
static void read_joints(burnish_gltf *gltf, burnish_gltf_primitive *primitive,
                        uint32_t attributes) {
    static const char *const names[BURNISH_GLTF_SETS][2] = {{"JOINTS_0", "WEIGHTS_0"},
                                                            {"JOINTS_1", "WEIGHTS_1"}};
    for (int set = 0; set < BURNISH_GLTF_SETS; ++set) {
        uint32_t *joints = &primitive->joints[set], *weights = &primitive->weights[set];
        *joints = read_attribute(gltf, primitive, attributes, names[set][0], WIDTH(4));
        *weights = read_attribute(gltf, primitive, attributes, names[set][1], WIDTH(4));
        if (*weights == BURNISH_GLTF_NONE ||
            (set > 0 && primitive->joints[set - 1] == BURNISH_GLTF_NONE)) {
            *joints = BURNISH_GLTF_NONE;
        }
        if (*joints != BURNISH_GLTF_NONE && gltf->status == BURNISH_STATUS_OK &&
            gltf->accessors[*joints].component != BURNISH_GLTF_UNSIGNED_BYTE &&
            gltf->accessors[*joints].component != BURNISH_GLTF_UNSIGNED_SHORT) {
            burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, attributes,
                              "%s must be of unsigned bytes or shorts", names[set][0]);
        }
    }
}

static void read_indices(burnish_gltf *gltf, burnish_gltf_primitive *primitive) {
    primitive->indices =
        burnish_gltf_reference(gltf, primitive->value, "indices", BURNISH_GLTF_ACCESSORS);
    primitive->corner_count = gltf->accessors[primitive->position].count;
    if (primitive->indices == BURNISH_GLTF_NONE || gltf->status != BURNISH_STATUS_OK) {
        return;
    }
    const uint32_t value = burnish_json_member(&gltf->json, primitive->value, "indices");
    const burnish_gltf_accessor *accessor =
        burnish_gltf_resolve(gltf, primitive->indices, value, WIDTH(1));
    if (!accessor) {
        return;
    }
    primitive->corner_count = accessor->count;
    if (accessor->component != BURNISH_GLTF_UNSIGNED_BYTE &&
        accessor->component != BURNISH_GLTF_UNSIGNED_SHORT &&
        accessor->component != BURNISH_GLTF_UNSIGNED_INT) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, value,
                          "accessors[%u] is of componentType %d; indices are unsigned integers",
                          primitive->indices, accessor->component);
    }
}

burnish_gltf_kind burnish_gltf_kind_of(const burnish_gltf_primitive *primitive) {
    return primitive->mode == POINTS     ? BURNISH_GLTF_POINTS
           : primitive->mode < TRIANGLES ? BURNISH_GLTF_LINES
                                         : BURNISH_GLTF_TRIANGLES;
}

static void count_elements(burnish_gltf *gltf, burnish_gltf_primitive *primitive) {
    const size_t corners = primitive->corner_count;
    const size_t of_each = primitive->mode == TRIANGLES ? 3 : primitive->mode == LINES ? 2 : 1;
    switch (primitive->mode) {
    case POINTS:
        primitive->element_count = corners;
        return;
    case LINE_LOOP:
        primitive->element_count = corners >= 2 ? corners : 0;
        return;
    case LINE_STRIP:
        primitive->element_count = corners >= 2 ? corners - 1 : 0;
        return;
    case TRIANGLE_STRIP:
    case TRIANGLE_FAN:
        primitive->element_count = corners >= 3 ? corners - 2 : 0;
        return;
    default:
        primitive->element_count = corners / of_each;
    }
    if (corners % of_each != 0) {
        burnish_gltf_note(gltf, &gltf->rests, primitive->value,
                          "%zu corners do not make whole %s; the last %zu are ignored", corners,
                          primitive->mode == LINES ? "lines" : "triangles", corners % of_each);
    }
}

/* The sets of texture coordinates that the primitive's material uses. */
static void read_texcoords(burnish_gltf *gltf, burnish_gltf_primitive *primitive,
                           uint32_t attributes) {
    const char *scalar = gltf->reader->input->options->scalar_property;
    unsigned sets[2] = {0, BURNISH_GLTF_TEXCOORDS};
    if (primitive->material != BURNISH_GLTF_NONE && !scalar) {
        burnish_gltf_texture_sets(gltf, gltf->lists[BURNISH_GLTF_MATERIALS][primitive->material],
                                  sets);
    }
    for (int i = 0; i < 2; ++i) {
        char name[16];
        snprintf(name, sizeof name, "TEXCOORD_%u", sets[i]);
        primitive->texcoords[i] =
            sets[i] == BURNISH_GLTF_TEXCOORDS
                ? BURNISH_GLTF_NONE
                : read_attribute(gltf, primitive, attributes, scalar ? scalar : name,
                                 WIDTH(scalar ? 1 : 2));
    }
}

/* Attributes of KHR_gaussian_splatting, also without the prefix, as drafts had them. */
static void read_splats(burnish_gltf *gltf, burnish_gltf_primitive *primitive,
                        uint32_t attributes) {
    static const char *const names[4] = {
        "KHR_gaussian_splatting:SCALE", "KHR_gaussian_splatting:ROTATION",
        "KHR_gaussian_splatting:OPACITY", "KHR_gaussian_splatting:SH_DEGREE_0_COEF_0"};
    static const unsigned widths[4] = {WIDTH(3), WIDTH(4), WIDTH(1), WIDTH(3)};
    const uint32_t value = burnish_gltf_extension(gltf, primitive->value, "KHR_gaussian_splatting");
    for (int i = 0; i < 4; ++i) {
        uint32_t *number = &primitive->splats[i];
        *number = BURNISH_GLTF_NONE;
        for (const char *name = names[i]; name && *number == BURNISH_GLTF_NONE &&
                                          value != BURNISH_JSON_NONE && primitive->mode == POINTS;
             name = strchr(name, ':') ? strchr(name, ':') + 1 : NULL) {
            *number = read_attribute(gltf, primitive, attributes, name, widths[i]);
        }
    }
}

/* The primitive's material, or what the chosen variant puts in its place. */
static uint32_t read_material(burnish_gltf *gltf, uint32_t primitive) {
    const uint32_t extension = burnish_gltf_extension(gltf, primitive, "KHR_materials_variants");
    const uint32_t mappings = gltf->variant == UINT64_MAX
                                  ? BURNISH_JSON_NONE
                                  : burnish_gltf_array(gltf, extension, "mappings");
    uint32_t mapping = mappings + 1;
    for (size_t i = burnish_json_length(&gltf->json, mappings); i > 0; --i) {
        const uint32_t variants = burnish_gltf_array(gltf, mapping, "variants");
        uint32_t variant = variants + 1;
        for (size_t k = burnish_json_length(&gltf->json, variants); k > 0; --k) {
            double number = -1;
            if (burnish_json_number(&gltf->json, variant, &number) && number >= 0 &&
                number < 0x1p53 && (uint64_t)number == gltf->variant) {
                return burnish_gltf_reference(gltf, mapping, "material", BURNISH_GLTF_MATERIALS);
            }
            variant = gltf->json.nodes[variant].next;
        }
        mapping = gltf->json.nodes[mapping].next;
    }
    return burnish_gltf_reference(gltf, primitive, "material", BURNISH_GLTF_MATERIALS);
}

/* Returns whether there is anything to draw. */
static int read_primitive(burnish_gltf *gltf, burnish_gltf_primitive *primitive) {
    const uint32_t attributes = burnish_gltf_object(gltf, primitive->value, "attributes");
    primitive->mode = (int)burnish_gltf_whole(gltf, primitive->value, "mode", TRIANGLES, 6);
    if (gltf->status != BURNISH_STATUS_OK) {
        return 0;
    }
    if (burnish_gltf_draco(gltf, primitive->value) != BURNISH_JSON_NONE) {
        primitive->mode = TRIANGLES; /* as which strips are unpacked */
    }
    primitive->position = read_attribute(gltf, primitive, attributes, "POSITION", WIDTH(3));
    if (primitive->position == BURNISH_GLTF_NONE) { /* which the specification allows */
        return 0;
    }
    primitive->normal = read_attribute(gltf, primitive, attributes, "NORMAL", WIDTH(3));
    primitive->color = read_attribute(gltf, primitive, attributes, "COLOR_0", WIDTH(3) | WIDTH(4));
    primitive->tangent = read_attribute(gltf, primitive, attributes, "TANGENT", WIDTH(4));
    primitive->targets = burnish_gltf_array(gltf, primitive->value, "targets");
    read_joints(gltf, primitive, attributes);
    primitive->material = read_material(gltf, primitive->value);
    read_texcoords(gltf, primitive, attributes);
    read_splats(gltf, primitive, attributes);
    if (gltf->status == BURNISH_STATUS_OK) {
        read_indices(gltf, primitive);
    }
    count_elements(gltf, primitive);
    gltf->has_colors |= primitive->color != BURNISH_GLTF_NONE;
    gltf->has_plain |= primitive->material == BURNISH_GLTF_NONE && primitive->element_count > 0;
    return gltf->status == BURNISH_STATUS_OK && primitive->element_count > 0;
}

size_t burnish_gltf_target_count(burnish_gltf *gltf, uint32_t mesh) {
    const uint32_t primitives =
        burnish_gltf_array(gltf, gltf->lists[BURNISH_GLTF_MESHES][mesh], "primitives");
    return burnish_json_length(&gltf->json, primitives) == 0
               ? 0
               : burnish_json_length(&gltf->json,
                                     burnish_json_member(&gltf->json, primitives + 1, "targets"));
}

static void read_mesh(burnish_gltf *gltf, uint32_t mesh) {
    const uint32_t primitives = burnish_gltf_array(gltf, mesh, "primitives");
    uint32_t value = primitives + 1;
    for (size_t i = burnish_json_length(&gltf->json, primitives);
         i > 0 && gltf->status == BURNISH_STATUS_OK; --i) {
        burnish_gltf_primitive primitive = {.value = value, .position = BURNISH_GLTF_NONE};
        if (read_primitive(gltf, &primitive)) {
            gltf->primitives =
                burnish_reserve(gltf->memory, gltf->primitives, &gltf->primitive_capacity,
                                gltf->primitive_count + 1, sizeof *gltf->primitives, "primitives");
            if (burnish_gltf_is_fine(gltf)) {
                gltf->primitives[gltf->primitive_count++] = primitive;
            }
        }
        value = gltf->json.nodes[value].next;
    }
}

void burnish_gltf_read_primitives(burnish_gltf *gltf) {
    const size_t count = gltf->counts[BURNISH_GLTF_MESHES];
    gltf->mesh_primitives =
        burnish_allocate(gltf->memory, count + 1, sizeof *gltf->mesh_primitives, "meshes");
    for (size_t i = 0; i < count && burnish_gltf_is_fine(gltf); ++i) {
        gltf->mesh_primitives[i] = (uint32_t)gltf->primitive_count;
        read_mesh(gltf, gltf->lists[BURNISH_GLTF_MESHES][i]);
    }
    if (burnish_gltf_is_fine(gltf)) {
        gltf->mesh_primitives[count] = (uint32_t)gltf->primitive_count;
    }
}
