/* Building the tree of boxes: splits where boxes' areas times their triangles are least (binned SAH).
 * Every range of triangles has its own nodes in advance, so threads build the same tree. */
#include <string.h>

#include "rays/rays.h"

/* A leaf has at most so many triangles, unless more have the same corners. */
enum { LEAF = 8, BINS = 16, TASK = 4096 /* triangles that are one piece of work */ };

/* What a node costs, in triangle tests. */
#define NODE_COST 1.2f

/* Boxes are wider by this much: what rotating corners into a ray's axes may be off. */
#define PADDING 0x1p-19f

/* Centres nearer than this are one. */
#define LEAST_EXTENT 1e-30f

typedef struct ray_box {
    float low[3], high[3];
} ray_box;

/* Triangles [first, first + count) of the order, and the first of their nodes. */
typedef struct ray_range {
    size_t first, count, slot;
    int depth;
    burnish_ray_node *parent;
    int side; /* of the parent */
} ray_range;

typedef struct tree_builder {
    burnish_ray_tree *tree;
    const burnish_ray_mesh *mesh;
    float (*corners)[9]; /* by number; each triangle's sorted */
    ray_box *boxes;      /* by number */
    uint32_t *order;     /* numbers, in the order of the leaves */
    ray_range *pieces;   /* for threads */
    size_t count, piece_count;
} tree_builder;

static const ray_box NOTHING = {{1e30f, 1e30f, 1e30f}, {-1e30f, -1e30f, -1e30f}};

static void include_box(ray_box *box, const ray_box *other) {
    for (int k = 0; k < 3; ++k) {
        box->low[k] = other->low[k] < box->low[k] ? other->low[k] : box->low[k];
        box->high[k] = other->high[k] > box->high[k] ? other->high[k] : box->high[k];
    }
}

/* Half of its surface. */
static float area_of(const ray_box *box) {
    const float x = box->high[0] - box->low[0], y = box->high[1] - box->low[1];
    const float z = box->high[2] - box->low[2];
    return x < 0 ? 0 : (x * y + y * z) + z * x;
}

/* Twice the middle of a box. */
static float middle_of(const ray_box *box, int axis) {
    return box->low[axis] + box->high[axis];
}

/* ---- Triangles ---- */

static int compare_corners(const float *a, const float *b) {
    for (int k = 0; k < 3; ++k) {
        if (a[k] != b[k]) {
            return a[k] < b[k] ? -1 : 1;
        }
    }
    return 0;
}

/* Orders the corners of a triangle: which is first makes no difference to rays. */
static void sort_corners(float c[9]) {
    for (int i = 0; i < 3; ++i) { /* 0 and 1, 1 and 2, 0 and 1 */
        float *const a = c + 3 * (i % 2), moved[3];
        if (compare_corners(a + 3, a) < 0) {
            memcpy(moved, a, sizeof moved);
            memcpy(a, a + 3, sizeof moved);
            memcpy(a + 3, moved, sizeof moved);
        }
    }
}

static int is_left_out(const burnish_ray_mesh *mesh, size_t i) {
    return mesh->left_out && mesh->left_out[i / 16] >> i % 16 & 1;
}

/* Loads the mesh's triangles, without those whose corners are two points. */
static void load_triangles(tree_builder *builder) {
    const burnish_ray_mesh *mesh = builder->mesh;
    for (size_t i = 0; i < mesh->view->triangle_count; ++i) {
        float *const c = builder->corners[i];
        ray_box box = NOTHING;
        for (int corner = 0; corner < 3; ++corner) {
            const float *from =
                mesh->view->positions + 3 * (size_t)mesh->view->indices[3 * i + (size_t)corner];
            for (int k = 0; k < 3; ++k) {
                const float at = (from[k] - mesh->center[k]) * mesh->scale + 0.0f;
                c[3 * corner + k] = at;
                box.low[k] = at < box.low[k] ? at : box.low[k];
                box.high[k] = at > box.high[k] ? at : box.high[k];
            }
        }
        sort_corners(c);
        const int is_thin = compare_corners(c, c + 3) == 0 || compare_corners(c + 3, c + 6) == 0;
        if (!is_left_out(mesh, i) && !is_thin) {
            builder->boxes[i] = box;
            builder->order[builder->count++] = (uint32_t)i;
        }
    }
}

/* ---- Splits ---- */

/* A split of a range: triangles of bins below `bin` along `axis` come first. */
typedef struct ray_split {
    int axis, bin; /* axis -1: no split is better than a leaf */
    float low, scale, cost;
} ray_split;

static int bin_of(const ray_split *split, const ray_box *box) {
    const float at = (middle_of(box, split->axis) - split->low) * split->scale;
    return at < BINS - 1 ? (int)at : BINS - 1;
}

/* The best split along an axis, if it is better than *best. */
static void try_axis(const tree_builder *builder, const ray_range *range, ray_split split,
                     ray_split *best) {
    ray_box bins[BINS];
    size_t counts[BINS] = {0}, above[BINS], count = 0;
    float areas[BINS];
    for (int i = 0; i < BINS; ++i) {
        bins[i] = NOTHING;
    }
    for (size_t i = 0; i < range->count; ++i) {
        const ray_box *box = &builder->boxes[builder->order[range->first + i]];
        const int bin = bin_of(&split, box);
        include_box(&bins[bin], box);
        ++counts[bin];
    }
    ray_box all = NOTHING;
    for (int i = BINS - 1; i > 0; --i) {
        include_box(&all, &bins[i]);
        areas[i] = area_of(&all);
        above[i] = count += counts[i];
    }
    all = NOTHING;
    count = 0;
    for (int i = 1; i < BINS; ++i) {
        include_box(&all, &bins[i - 1]);
        count += counts[i - 1];
        split.cost = area_of(&all) * (float)count + areas[i] * (float)above[i];
        if (count > 0 && above[i] > 0 && split.cost < best->cost) {
            *best = split;
            best->bin = i;
        }
    }
}

static ray_split find_split(const tree_builder *builder, const ray_range *range,
                            const ray_box *bounds, const ray_box *middles) {
    ray_split best = {-1, 0, 0, 0, 1e30f};
    for (int k = 0; k < 3; ++k) {
        const float extent = middles->high[k] - middles->low[k];
        if (extent > LEAST_EXTENT) {
            const ray_split split = {k, 0, middles->low[k], BINS / extent, 0};
            try_axis(builder, range, split, &best);
        }
    }
    const float area = area_of(bounds);
    if (range->count <= LEAF && best.cost + NODE_COST * area >= area * (float)range->count) {
        best.axis = -1;
    }
    return best;
}

/* Brings the triangles of the first part to the front; returns how many there are. */
static size_t divide(const tree_builder *builder, const ray_range *range, const ray_split *split) {
    uint32_t *const order = builder->order + range->first;
    size_t low = 0, high = range->count;
    while (low < high) {
        if (bin_of(split, &builder->boxes[order[low]]) < split->bin) {
            ++low;
        } else {
            const uint32_t moved = order[--high];
            order[high] = order[low];
            order[low] = moved;
        }
    }
    return low;
}

/* Whether triangle a comes before b: by corners, then by number. */
static int is_before(const tree_builder *builder, uint32_t a, uint32_t b) {
    const int order = memcmp(builder->corners[a], builder->corners[b], sizeof *builder->corners);
    return order != 0 ? order < 0 : a < b;
}

/* Lets heap[i] sink below what comes after it. */
static void sink(const tree_builder *builder, uint32_t *heap, size_t i, size_t count) {
    const uint32_t moved = heap[i];
    for (size_t below = 2 * i + 1; below < count; below = 2 * i + 1) {
        below += below + 1 < count && is_before(builder, heap[below], heap[below + 1]);
        if (!is_before(builder, moved, heap[below])) {
            break;
        }
        heap[i] = heap[below];
        i = below;
    }
    heap[i] = moved;
}

/* Brings one triangle of each three corners to the front of a range whose triangles have one middle;
 * returns how many there are. A heap takes no memory, and never long. */
static size_t join_equal(const tree_builder *builder, const ray_range *range) {
    uint32_t *const order = builder->order + range->first;
    size_t count = 0;
    for (size_t i = range->count / 2; i-- > 0;) {
        sink(builder, order, i, range->count);
    }
    for (size_t end = range->count; end-- > 1;) {
        const uint32_t last = order[0];
        order[0] = order[end];
        order[end] = last;
        sink(builder, order, 0, end);
    }
    for (size_t i = 0; i < range->count; ++i) {
        if (i == 0 || memcmp(builder->corners[order[i]], builder->corners[order[count - 1]],
                             sizeof *builder->corners) != 0) {
            order[count++] = order[i];
        }
    }
    return count;
}

/* ---- Nodes ---- */

/* The bounds of a range, and of twice the middles of its boxes. */
static ray_box bounds_of(const tree_builder *builder, const ray_range *range, ray_box *middles) {
    ray_box bounds = NOTHING;
    *middles = NOTHING;
    for (size_t i = 0; i < range->count; ++i) {
        const ray_box *box = &builder->boxes[builder->order[range->first + i]];
        ray_box middle;
        for (int k = 0; k < 3; ++k) {
            middle.low[k] = middle.high[k] = middle_of(box, k);
        }
        include_box(&bounds, box);
        include_box(middles, &middle);
    }
    return bounds;
}

static void build_range(tree_builder *builder, ray_range range, int is_piece);

/* Builds the node of a range: its first `left` triangles, and the others. */
static void build_node(tree_builder *builder, const ray_range *range, size_t left, int is_piece) {
    burnish_ray_node *node = &builder->tree->nodes[range->slot];
    const ray_range first = {range->first, left, range->slot + 1, range->depth + 1, node, 0};
    const ray_range second = {
        range->first + left, range->count - left, range->slot + left, range->depth + 1, node, 1};
    build_range(builder, first, is_piece);
    build_range(builder, second, is_piece);
}

/* Builds a range into its parent. Large ranges are divided at once; the others are pieces for
 * threads, or parts of these. */
static void build_range(tree_builder *builder, ray_range range, int is_piece) {
    burnish_ray_node *const parent = range.parent;
    const int side = range.side;
    if (!is_piece && range.count <= TASK) {
        builder->pieces[builder->piece_count++] = range;
        return;
    }
    ray_box middles;
    const ray_box bounds = bounds_of(builder, &range, &middles);
    ray_split split = {-1, 0, 0, 0, 0};
    size_t left = range.count / 2;
    for (int k = 0; k < 3; ++k) {
        parent->low[side][k] = bounds.low[k] - PADDING;
        parent->high[side][k] = bounds.high[k] + PADDING;
    }
    if (range.count > 1 && range.depth < BURNISH_RAY_SPLITS) {
        split = find_split(builder, &range, &bounds, &middles);
    }
    if (split.axis >= 0) {
        left = divide(builder, &range, &split);
    } else if (range.count > LEAF) {
        range.count = join_equal(builder, &range);
        left = range.count / 2;
    }
    const int is_leaf = split.axis < 0 && range.count <= LEAF;
    parent->child[side] = (uint32_t)(is_leaf ? range.first : range.slot);
    parent->count[side] = is_leaf ? (uint32_t)range.count : 0;
    if (!is_leaf) {
        build_node(builder, &range, left, is_piece);
    }
}

/* What threads build. */
typedef struct piece_run {
    tree_builder *builder;
    burnish_tasks *tasks;
} piece_run;

static void build_piece(void *context, size_t index, int thread) {
    const piece_run *run = context;
    if (!burnish_tasks_should_end(run->tasks, thread)) {
        build_range(run->builder, run->builder->pieces[index], 1);
    }
}

/* ---- The tree ---- */

/* Moves the nodes to the front, and writes the leaves' triangles. */
static void pack_tree(tree_builder *builder) {
    burnish_ray_tree *tree = builder->tree;
    for (size_t i = 0; i < builder->count; ++i) {
        memcpy(tree->triangles[i], builder->corners[builder->order[i]], sizeof *tree->triangles);
        tree->numbers[i] = builder->order[i];
    }
    uint32_t *const number = builder->order;
    tree->node_count = 0;
    for (size_t i = 0; i < builder->count; ++i) { /* unused ones have no size */
        const int is_used = tree->nodes[i].low[0][0] < tree->nodes[i].high[0][0];
        number[i] = (uint32_t)tree->node_count;
        tree->node_count += (size_t)is_used;
        if (is_used) {
            tree->nodes[number[i]] = tree->nodes[i];
        }
    }
    for (size_t i = 0; i < tree->node_count; ++i) {
        burnish_ray_node *node = &tree->nodes[i];
        for (int side = 0; side < 2; ++side) {
            node->child[side] =
                node->count[side] > 0 ? node->child[side] : number[node->child[side]];
        }
    }
    tree->triangle_count = builder->count;
}

/* Triangles that a ray through the whole is tested against: a box is hit as often as its area says. */
static double measure_work(const burnish_ray_tree *tree) {
    ray_box all = NOTHING;
    double sum = 0;
    for (size_t i = 0; i < 2 * tree->node_count; ++i) {
        const burnish_ray_node *node = &tree->nodes[i / 2];
        ray_box box;
        memcpy(box.low, node->low[i % 2], sizeof box.low);
        memcpy(box.high, node->high[i % 2], sizeof box.high);
        include_box(&all, &box);
        sum += (double)area_of(&box) * node->count[i % 2];
    }
    return tree->node_count > 0 ? sum / (double)area_of(&all) : 0;
}

static burnish_status build_tree(tree_builder *builder, burnish_tasks *tasks,
                                 const burnish_context *context, burnish_error *error) {
    burnish_ray_tree *tree = builder->tree;
    piece_run run = {builder, tasks};
    load_triangles(builder);
    tree->triangle_count = tree->node_count = 0;
    tree->work = 0;
    if (builder->count == 0) {
        return BURNISH_STATUS_OK;
    }
    memset(tree->nodes, 0, (builder->count + 1) * sizeof *tree->nodes);
    if (builder->count == 1) { /* both sides of the root are it */
        builder->order[1] = builder->order[0];
        builder->count = 2;
    }
    const ray_range all = {0, builder->count, 0, 0, NULL, 0};
    build_node(builder, &all, builder->count / 2, 0);
    burnish_tasks_run(tasks, builder->piece_count, 1, 0, build_piece, &run);
    const burnish_status status = burnish_tasks_check(tasks, error);
    if (status == BURNISH_STATUS_OK) {
        pack_tree(builder);
        tree->nodes = burnish_shrink(context, tree->nodes, &tree->node_capacity, tree->node_count,
                                     sizeof *tree->nodes);
        tree->work = measure_work(tree);
    }
    return status;
}

burnish_status burnish_ray_tree_update(burnish_ray_tree *tree, const burnish_ray_mesh *mesh,
                                       burnish_tasks *tasks, burnish_memory *memory) {
    /* one more: a triangle alone is there twice */
    const size_t room = mesh->view->triangle_count + 1;
    /* of each depth, fewer than room / TASK ranges are divided into two */
    const size_t pieces = 2 * BURNISH_RAY_DEPTH * (room / TASK + 1);
    burnish_status status = BURNISH_STATUS_OK;
    if (tree->mesh != mesh->view->serial || tree->mesh == 0) {
        tree->mesh = 0;
        tree->nodes = burnish_reserve_discard(memory, tree->nodes, &tree->node_capacity, room,
                                              sizeof *tree->nodes, "boxes of rays");
        tree->triangles =
            burnish_reserve_discard(memory, tree->triangles, &tree->triangle_capacity, room,
                                    sizeof *tree->triangles, "triangles of rays");
        tree->numbers = burnish_reserve_discard(memory, tree->numbers, &tree->number_capacity, room,
                                                sizeof *tree->numbers, "triangles of rays");
        tree_builder builder = {
            .tree = tree,
            .mesh = mesh,
            .corners = burnish_allocate(memory, room, sizeof *builder.corners, "corners"),
            .boxes = burnish_allocate(memory, room, sizeof *builder.boxes, "bounds of triangles"),
            .order = burnish_allocate(memory, room, sizeof *builder.order, "order of triangles"),
            .pieces =
                burnish_allocate(memory, pieces, sizeof *builder.pieces, "parts of the tree")};
        status = memory->status;
        if (status == BURNISH_STATUS_OK) {
            status = build_tree(&builder, tasks, memory->context, memory->error);
        }
        burnish_release(memory->context, builder.corners);
        burnish_release(memory->context, builder.boxes);
        burnish_release(memory->context, builder.order);
        burnish_release(memory->context, builder.pieces);
        tree->mesh = status == BURNISH_STATUS_OK ? mesh->view->serial : 0;
    }
    if (status == BURNISH_STATUS_OK && tree->work > mesh->most_work) {
        status = burnish_fail(memory->error, BURNISH_STATUS_LIMIT,
                              "rays would be tested against %.0f triangles each, which takes long; "
                              "the limit is %.0f: raise --max-overdraw, or omit raytracing",
                              tree->work, mesh->most_work);
    }
    return status;
}

void burnish_ray_tree_destroy(burnish_ray_tree *tree, const burnish_context *context) {
    burnish_release(context, tree->nodes);
    burnish_release(context, tree->triangles);
    burnish_release(context, tree->numbers);
    memset(tree, 0, sizeof *tree);
}

#define OPS burnish_ray_ops
#include "simd/isa_table.h"
