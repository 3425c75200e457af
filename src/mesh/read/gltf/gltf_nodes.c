/* glTF's nodes: a forest whose matrices multiply down to the meshes. Nothing here recurses, and
 * each node is visited once, so a loop of nodes is an error. */
#include "mesh/read/gltf/gltf.h"

#include "base/elementary.h"
#include "mesh/read/common/parts.h"

static const double identity[12] = BURNISH_MATRIX_IDENTITY;

void burnish_gltf_transpose(const double columns[16], double matrix[12]) {
    for (int row = 0; row < 3; ++row) {
        for (int k = 0; k < 4; ++k) {
            matrix[4 * row + k] = columns[4 * k + row];
        }
    }
}

/* A quaternion (x, y, z, w) of any length but 0 is taken as the rotation of its direction. */
void burnish_gltf_compose(const double translation[3], const double rotation[4],
                          const double scale[3], double matrix[12]) {
    double x = rotation[0], y = rotation[1], z = rotation[2], w = rotation[3];
    const double length = burnish_sqrt(x * x + y * y + z * z + w * w);
    if (length > 0) {
        x /= length, y /= length, z /= length, w /= length;
    }
    const double r[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                         2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                         2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    for (int row = 0; row < 3; ++row) {
        for (int k = 0; k < 3; ++k) {
            matrix[4 * row + k] = r[3 * row + k] * scale[k];
        }
        matrix[4 * row + 3] = translation[row];
    }
}

/* The matrix to the parent. */
static void read_local(burnish_gltf *gltf, uint32_t value, const burnish_gltf_pose *pose,
                       double matrix[12]) {
    double columns[16], translation[3] = {0, 0, 0}, rotation[4] = {0, 0, 0, 1},
                        scale[3] = {1, 1, 1};
    const int is_posed = pose && (pose->has_translation || pose->has_rotation || pose->has_scale);
    if (!is_posed && burnish_gltf_numbers(gltf, value, "matrix", 16, columns)) {
        burnish_gltf_transpose(columns, matrix);
        return;
    }
    burnish_gltf_numbers(gltf, value, "translation", 3, translation);
    burnish_gltf_numbers(gltf, value, "rotation", 4, rotation);
    burnish_gltf_numbers(gltf, value, "scale", 3, scale);
    burnish_gltf_compose(pose && pose->has_translation ? pose->translation : translation,
                         pose && pose->has_rotation ? pose->rotation : rotation,
                         pose && pose->has_scale ? pose->scale : scale, matrix);
}

/* Records the parents. */
static void find_parents(burnish_gltf *gltf) {
    for (size_t i = 0; i < gltf->counts[BURNISH_GLTF_NODES]; ++i) {
        const uint32_t children =
            burnish_gltf_array(gltf, gltf->lists[BURNISH_GLTF_NODES][i], "children");
        uint32_t child = children + 1;
        for (size_t k = burnish_json_length(&gltf->json, children); k > 0; --k) {
            const uint32_t number = burnish_gltf_item(gltf, child, BURNISH_GLTF_NODES);
            if (number == BURNISH_GLTF_NONE) {
                return;
            }
            if (gltf->nodes[number].parent != BURNISH_GLTF_NONE || number == i) {
                burnish_gltf_fail(
                    gltf, BURNISH_STATUS_FORMAT, child,
                    "nodes[%u] has two parents, or is its own; nodes must form a tree", number);
                return;
            }
            gltf->nodes[number].parent = (uint32_t)i;
            child = gltf->json.nodes[child].next;
        }
    }
}

/* Parents before children. A loop of nodes has no root and is never reached. */
static void find_order(burnish_gltf *gltf) {
    const size_t count = gltf->counts[BURNISH_GLTF_NODES];
    size_t known = 0;
    for (uint32_t i = 0; i < count; ++i) {
        if (gltf->nodes[i].parent == BURNISH_GLTF_NONE) {
            gltf->node_order[known++] = i;
        }
    }
    for (size_t done = 0; done < known; ++done) {
        const uint32_t value = gltf->lists[BURNISH_GLTF_NODES][gltf->node_order[done]];
        const uint32_t children = burnish_json_member(&gltf->json, value, "children");
        uint32_t child = children + 1;
        for (size_t k = burnish_json_length(&gltf->json, children); k > 0; --k) {
            gltf->node_order[known++] = burnish_gltf_item(gltf, child, BURNISH_GLTF_NODES);
            child = gltf->json.nodes[child].next;
        }
    }
    if (known < count) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, burnish_json_member(&gltf->json, 0, "nodes"),
                          "%zu nodes are their own ancestors; nodes must form a tree",
                          count - known);
    }
}

/* Marks the roots of the scene that is drawn; without a scene all roots. */
static void mark_roots(burnish_gltf *gltf) {
    gltf->is_lenient = 1; /* a missing scene counts as none */
    uint32_t scene = burnish_gltf_reference(gltf, 0, "scene", BURNISH_GLTF_SCENES);
    gltf->is_lenient = 0;
    if (scene == BURNISH_GLTF_NONE && gltf->counts[BURNISH_GLTF_SCENES] > 0) {
        scene = 0;
    }
    if (scene == BURNISH_GLTF_NONE) {
        for (size_t i = 0; i < gltf->counts[BURNISH_GLTF_NODES]; ++i) {
            gltf->nodes[i].is_drawn = gltf->nodes[i].parent == BURNISH_GLTF_NONE;
        }
        return;
    }
    const uint32_t roots =
        burnish_gltf_array(gltf, gltf->lists[BURNISH_GLTF_SCENES][scene], "nodes");
    uint32_t root = roots + 1;
    for (size_t k = burnish_json_length(&gltf->json, roots); k > 0; --k) {
        const uint32_t number = burnish_gltf_item(gltf, root, BURNISH_GLTF_NODES);
        if (number == BURNISH_GLTF_NONE) {
            return;
        }
        gltf->nodes[number].is_drawn = 1;
        root = gltf->json.nodes[root].next;
    }
}

burnish_part burnish_gltf_part_of(burnish_gltf *gltf, uint32_t node) {
    const uint32_t owners[2] = {gltf->lists[BURNISH_GLTF_NODES][node],
                                gltf->lists[BURNISH_GLTF_MESHES][gltf->nodes[node].mesh]};
    char text[128] = "";
    for (int i = 0; i < 2 && !*text; ++i) {
        burnish_json_text(&gltf->json, burnish_json_member(&gltf->json, owners[i], "name"), text,
                          sizeof text);
    }
    burnish_part part = burnish_part_of(text, strlen(text));
    part.id = part.item = node;
    memcpy(part.transform, gltf->nodes[node].matrix, sizeof part.transform);
    return part;
}

static int is_visible(burnish_gltf *gltf, uint32_t value) {
    return burnish_gltf_flag(gltf, burnish_gltf_extension(gltf, value, "KHR_node_visibility"),
                             "visible", 1);
}

void burnish_gltf_place_nodes(burnish_gltf *gltf) {
    const size_t count = gltf->counts[BURNISH_GLTF_NODES];
    gltf->nodes = burnish_allocate(gltf->memory, count, sizeof *gltf->nodes, "nodes");
    gltf->node_order = burnish_allocate(gltf->memory, count, sizeof *gltf->node_order, "nodes");
    if (!burnish_gltf_is_fine(gltf)) {
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        gltf->nodes[i] = (burnish_gltf_node){
            .parent = BURNISH_GLTF_NONE,
            .mesh = burnish_gltf_reference(gltf, gltf->lists[BURNISH_GLTF_NODES][i], "mesh",
                                           BURNISH_GLTF_MESHES)};
    }
    find_parents(gltf);
    if (gltf->status == BURNISH_STATUS_OK) {
        find_order(gltf);
    }
    if (gltf->status == BURNISH_STATUS_OK) {
        burnish_gltf_animate(gltf);
    }
    if (gltf->status != BURNISH_STATUS_OK) {
        return;
    }
    mark_roots(gltf);
    for (size_t i = 0; i < count && gltf->status == BURNISH_STATUS_OK; ++i) {
        burnish_gltf_node *node = &gltf->nodes[gltf->node_order[i]];
        const uint32_t value = gltf->lists[BURNISH_GLTF_NODES][gltf->node_order[i]];
        const burnish_gltf_node *parent =
            node->parent == BURNISH_GLTF_NONE ? NULL : &gltf->nodes[node->parent];
        double local[12];
        read_local(gltf, value, gltf->poses ? &gltf->poses[gltf->node_order[i]] : NULL, local);
        node->skin = burnish_gltf_reference(gltf, value, "skin", BURNISH_GLTF_SKINS);
        burnish_matrix_multiply(parent ? parent->matrix : identity, local, node->matrix);
        node->is_drawn =
            (node->is_drawn || (parent && parent->is_drawn)) && is_visible(gltf, value);
    }
}
