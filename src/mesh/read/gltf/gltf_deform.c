/* glTF's vertices are moved before their node's matrix: by morph targets and weights, then by
 * joints of a skin. */

#include "mesh/read/gltf/gltf.h"
#include "mesh/read/io/budget.h"

/* ---- Morph targets ---- */

/* The weights of a node's mesh: of the animation, of the node, or of the mesh. */
static double weight_of(burnish_gltf *gltf, const burnish_gltf_node *node, uint32_t values,
                        size_t target) {
    double weight = 0;
    if (node->weight_count > 0) {
        return target < node->weight_count ? gltf->weights[node->first_weight + target] : 0;
    }
    if (target < burnish_json_length(&gltf->json, values)) {
        burnish_json_number(&gltf->json, values + 1 + (uint32_t)target, &weight);
    }
    return weight;
}

/* A target's accessor of an attribute; NULL if absent. */
static const burnish_gltf_accessor *target_accessor(burnish_gltf *gltf, uint32_t target,
                                                    const char *name, size_t count) {
    const uint32_t number = burnish_gltf_reference(gltf, target, name, BURNISH_GLTF_ACCESSORS);
    if (number == BURNISH_GLTF_NONE) {
        return NULL;
    }
    const burnish_gltf_accessor *accessor = burnish_gltf_resolve(gltf, number, target, 1u << 3);
    if (accessor && accessor->count < count) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, target,
                          "%s has %zu values for %zu positions", name, accessor->count, count);
        return NULL;
    }
    return accessor;
}

static void add_target(burnish_gltf *gltf, burnish_gltf_shape *shape, uint32_t target, size_t count,
                       double weight) {
    const uint64_t most =
        burnish_budget_of(burnish_budget_bytes(gltf->reader), BURNISH_SUMS_PER_BYTE);
    gltf->work += count;
    if (gltf->work > most) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_LIMIT, target,
                          "morph targets add up more than %llu values; remove some",
                          (unsigned long long)most);
        return;
    }
    shape->targets =
        burnish_reserve(gltf->memory, shape->targets, &shape->target_capacity,
                        shape->target_count + 1, sizeof *shape->targets, "morph targets");
    if (!burnish_gltf_is_fine(gltf)) {
        return;
    }
    shape->targets[shape->target_count++] =
        (burnish_gltf_target){.position = target_accessor(gltf, target, "POSITION", count),
                              .normal = target_accessor(gltf, target, "NORMAL", count),
                              .weight = weight};
}

static void choose_targets(burnish_gltf *gltf, burnish_gltf_shape *shape,
                           const burnish_gltf_node *node, const burnish_gltf_primitive *primitive) {
    const size_t count = gltf->accessors[primitive->position].count;
    const size_t targets = burnish_json_length(&gltf->json, primitive->targets);
    shape->target_count = 0;
    if (targets == 0) {
        return;
    }
    uint32_t values =
        burnish_gltf_array(gltf, gltf->lists[BURNISH_GLTF_NODES][node - gltf->nodes], "weights");
    if (values == BURNISH_JSON_NONE) {
        values = burnish_gltf_array(gltf, gltf->lists[BURNISH_GLTF_MESHES][node->mesh], "weights");
    }
    uint32_t target = primitive->targets + 1;
    gltf->work += targets;
    for (size_t i = 0; i < targets && gltf->status == BURNISH_STATUS_OK; ++i) {
        const double weight = weight_of(gltf, node, values, i);
        if (weight != 0) {
            add_target(gltf, shape, target, count, weight);
        }
        target = gltf->json.nodes[target].next;
    }
}

/* ---- Skins ---- */

/* Joint matrices of a skin: node to world, times the inverse of the bind pose. Made once. */
static void place_joints(burnish_gltf *gltf, uint32_t number) {
    burnish_gltf_skin *skin = &gltf->skins[number];
    const uint32_t value = gltf->lists[BURNISH_GLTF_SKINS][number];
    const uint32_t joints = burnish_gltf_array(gltf, value, "joints");
    const uint32_t inverse =
        burnish_gltf_reference(gltf, value, "inverseBindMatrices", BURNISH_GLTF_ACCESSORS);
    skin->count = burnish_json_length(&gltf->json, joints);
    skin->matrices =
        burnish_allocate(gltf->memory, skin->count, 12 * sizeof *skin->matrices, "joints");
    if (!burnish_gltf_is_fine(gltf)) {
        return;
    }
    const burnish_gltf_accessor *bind =
        inverse == BURNISH_GLTF_NONE ? NULL : burnish_gltf_resolve(gltf, inverse, value, 1u << 16);
    if (bind && bind->count < skin->count) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, value,
                          "%zu inverse bind matrices for %zu joints", bind->count, skin->count);
    }
    uint32_t joint = joints + 1;
    for (size_t i = 0; i < skin->count && gltf->status == BURNISH_STATUS_OK; ++i) {
        const uint32_t node = burnish_gltf_item(gltf, joint, BURNISH_GLTF_NODES);
        double *matrix = skin->matrices + 12 * i;
        joint = gltf->json.nodes[joint].next;
        if (node == BURNISH_GLTF_NONE) {
            return;
        }
        memcpy(matrix, gltf->nodes[node].matrix, sizeof gltf->nodes[node].matrix);
        if (bind) {
            double columns[16], rows[12];
            burnish_gltf_element(bind, i, columns);
            burnish_gltf_transpose(columns, rows);
            burnish_matrix_multiply(matrix, rows, matrix);
        }
    }
}

/* The matrix of a vertex: its joints' by their weights. Returns 0 on failure. */
static int blend_joints(burnish_gltf *gltf, const burnish_gltf_shape *shape, size_t vertex,
                        double matrix[12]) {
    double total = 0;
    memset(matrix, 0, 12 * sizeof *matrix);
    for (int set = 0; set < shape->set_count; ++set) {
        double weights[4];
        burnish_gltf_element(shape->weights[set], vertex, weights);
        for (int k = 0; k < 4; ++k) {
            const uint32_t joint = burnish_gltf_integer(shape->joints[set], vertex, k);
            if (weights[k] == 0) {
                continue;
            }
            if (joint >= shape->skin->count) {
                return burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, shape->joints[set]->value,
                                         "joint %u of vertex %zu is not below the skin's %zu",
                                         joint, vertex, shape->skin->count);
            }
            total += weights[k];
            for (int i = 0; i < 12; ++i) {
                matrix[i] += weights[k] * shape->skin->matrices[12 * (size_t)joint + (size_t)i];
            }
        }
    }
    for (int i = 0; i < 12 && total > 0; ++i) { /* quantised weights need not add up to 1 */
        matrix[i] /= total;
    }
    if (!(total > 0)) {
        memcpy(matrix, shape->matrix, 12 * sizeof *matrix);
    }
    return 1;
}

/* ---- Shapes ---- */

/* Cofactors of the upper 3 x 3 of the matrix, negated if it mirrors. Returns whether it does. */
static int find_cofactors(burnish_gltf_shape *shape) {
    const double *m = shape->matrix;
    double *c = shape->cofactors;
    for (int row = 0; row < 3; ++row) {
        const double *a = m + 4 * ((row + 1) % 3), *b = m + 4 * ((row + 2) % 3);
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            c[3 * row + k] = a[i] * b[j] - a[j] * b[i];
        }
    }
    const int is_mirror = m[0] * c[0] + m[1] * c[1] + m[2] * c[2] < 0;
    for (int i = 0; i < 9 && is_mirror; ++i) {
        c[i] = -c[i];
    }
    return is_mirror;
}

void burnish_gltf_set_shape(burnish_gltf *gltf, burnish_gltf_shape *shape,
                            const burnish_gltf_node *node, const double matrix[12],
                            const burnish_gltf_primitive *primitive) {
    choose_targets(gltf, shape, node, primitive);
    memcpy(shape->matrix, matrix, sizeof shape->matrix);
    shape->set_count = 0;
    if (node->skin != BURNISH_GLTF_NONE && primitive->joints[0] != BURNISH_GLTF_NONE) {
        shape->skin = &gltf->skins[node->skin];
        if (!shape->skin->matrices) {
            place_joints(gltf, node->skin);
        }
        for (; shape->set_count < BURNISH_GLTF_SETS &&
               primitive->joints[shape->set_count] != BURNISH_GLTF_NONE;
             ++shape->set_count) {
            shape->joints[shape->set_count] = &gltf->accessors[primitive->joints[shape->set_count]];
            shape->weights[shape->set_count] =
                &gltf->accessors[primitive->weights[shape->set_count]];
        }
        if (shape->skin->count > 0 && gltf->status == BURNISH_STATUS_OK) {
            memcpy(shape->matrix, shape->skin->matrices, sizeof shape->matrix);
        }
    }
    shape->is_mirrored = find_cofactors(shape);
}

int burnish_gltf_move(burnish_gltf *gltf, burnish_gltf_shape *shape, size_t vertex,
                      double position[3], double normal[3]) {
    for (size_t i = 0; i < shape->target_count; ++i) {
        const burnish_gltf_target *target = &shape->targets[i];
        double step[3];
        for (int k = 0; target->position && k < 3; ++k) {
            if (k == 0) {
                burnish_gltf_element(target->position, vertex, step);
            }
            position[k] += target->weight * step[k];
        }
        for (int k = 0; target->normal && k < 3; ++k) {
            if (k == 0) {
                burnish_gltf_element(target->normal, vertex, step);
            }
            normal[k] += target->weight * step[k];
        }
    }
    if (shape->set_count > 0) {
        if (!blend_joints(gltf, shape, vertex, shape->matrix)) {
            return 0;
        }
        find_cofactors(shape);
    }
    return 1;
}
