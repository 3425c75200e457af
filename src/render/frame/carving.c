#include "render/frame/carving.h"

#include <string.h>

#include "raster/layers.h"

/* ---- The mesh with its negative volumes ---- */

enum { STREAMS = 6, INDICES = STREAMS, MATERIALS };

static void release_arrays(burnish_carving *carving, const burnish_context *context) {
    for (size_t i = 0; i < sizeof carving->arrays / sizeof *carving->arrays; ++i) {
        burnish_release(context, carving->arrays[i]);
        carving->arrays[i] = NULL;
    }
    burnish_release(context, carving->items);
    burnish_release(context, carving->hosts);
    carving->items = carving->hosts = NULL;
    carving->serial = 0;
}

static uint32_t item_of(const burnish_contents *contents, const burnish_mesh_view *view,
                        size_t triangle) {
    return contents->parts[view->triangle_parts ? view->triangle_parts[triangle] : 0].item;
}

/* Two arrays one after the other; NULL where the first is. second: NULL leaves its place. */
static void *join_arrays(burnish_memory *memory, const void *first, size_t first_count,
                         const void *second, size_t second_count, size_t size) {
    char *joined =
        first ? burnish_allocate(memory, first_count + second_count, size, "negative volumes")
              : NULL;
    if (joined) {
        memcpy(joined, first, first_count * size);
        if (second) {
            memcpy(joined + first_count * size, second, second_count * size);
        }
    }
    return joined;
}

/* Which triangles have an item with negative volumes, and for each of these a triangle that the
 * mesh has of the item. */
static void find_items(burnish_carving *carving, const burnish_mesh *mesh, burnish_memory *memory) {
    const burnish_contents *contents = burnish_mesh_get_contents(mesh);
    const burnish_mesh_view *own = burnish_mesh_get_view(mesh);
    const burnish_mesh_view *negative = burnish_mesh_get_view(burnish_mesh_get_negatives(mesh));
    const size_t count = own->triangle_count, more = negative->triangle_count;
    size_t item_count = 1;
    for (size_t i = 0; i < contents->part_count; ++i) {
        const size_t item = contents->parts[i].item;
        item_count = item >= item_count ? item + 1 : item_count;
    }
    const char *what = "negative volumes";
    carving->items = burnish_allocate_zeroed(memory, count + more, sizeof *carving->items, what);
    carving->hosts = burnish_allocate_zeroed(memory, more, sizeof *carving->hosts, what);
    /* per item: its first triangle + 1; UINT32_MAX: none yet; 0: no negative volume */
    uint32_t *first = burnish_allocate_zeroed(memory, item_count, sizeof *first, what);
    for (size_t i = 0; memory->status == BURNISH_STATUS_OK && i < more; ++i) {
        carving->items[count + i] = item_of(contents, negative, i) + 1;
        first[carving->items[count + i] - 1] = UINT32_MAX;
    }
    for (size_t i = 0; memory->status == BURNISH_STATUS_OK && i < count; ++i) {
        const uint32_t item = item_of(contents, own, i);
        carving->items[i] = first[item] ? item + 1 : 0;
        first[item] = first[item] == UINT32_MAX ? (uint32_t)i + 1 : first[item];
    }
    for (size_t i = 0; memory->status == BURNISH_STATUS_OK && i < more; ++i) {
        const uint32_t host = first[carving->items[count + i] - 1];
        carving->hosts[i] = host == UINT32_MAX ? 0 : host - 1;
    }
    burnish_release(memory->context, first);
}

/* Negative volumes look like the solids that they cut: they have the material of these, and what they
 * lack themselves of one corner. */
static void dress_negatives(burnish_carving *carving, const burnish_mesh_view *own,
                            const void *const more[STREAMS], const size_t sizes[STREAMS]) {
    uint32_t *indices = carving->arrays[INDICES];
    uint16_t *materials = carving->arrays[MATERIALS];
    for (size_t i = own->triangle_count; i < carving->view.triangle_count; ++i) {
        const size_t host = carving->hosts[i - own->triangle_count];
        for (size_t k = 0; k < 3; ++k) {
            const size_t vertex = indices[3 * i + k] += (uint32_t)own->vertex_count;
            for (int s = 2; s < STREAMS; ++s) {
                char *stream = carving->arrays[s];
                if (stream && !more[s]) {
                    memcpy(stream + vertex * sizes[s], stream + own->indices[3 * host] * sizes[s],
                           sizes[s]);
                }
            }
        }
        if (materials) {
            materials[i] = materials[host];
        }
    }
}

static burnish_status join_meshes(burnish_carving *carving, const burnish_mesh *mesh,
                                  burnish_memory *memory) {
    const burnish_mesh_view *own = burnish_mesh_get_view(mesh);
    const burnish_mesh_view *more = burnish_mesh_get_view(burnish_mesh_get_negatives(mesh));
    const void *const from[STREAMS] = {
        own->positions,          own->normals, own->colors, own->texture_coordinates,
        own->second_coordinates, own->tangents};
    const void *const added[STREAMS] = {more->positions, more->normals, more->colors,
                                        more->texture_coordinates};
    const size_t sizes[STREAMS] = {12, 12, 4, 8, 8, 16}; /* bytes, as mesh.h says */
    burnish_mesh_view *view = &carving->view;
    void **arrays = carving->arrays;
    *view = *own;
    view->vertex_count += more->vertex_count;
    view->triangle_count += more->triangle_count;
    for (int s = 0; s < STREAMS; ++s) {
        arrays[s] =
            join_arrays(memory, from[s], own->vertex_count, added[s], more->vertex_count, sizes[s]);
        if (arrays[s] && !added[s]) { /* vertices of no triangle */
            memset((char *)arrays[s] + own->vertex_count * sizes[s], 0,
                   more->vertex_count * sizes[s]);
        }
    }
    arrays[INDICES] = join_arrays(memory, own->indices, 3 * own->triangle_count, more->indices,
                                  3 * more->triangle_count, sizeof *own->indices);
    arrays[MATERIALS] = join_arrays(memory, own->triangle_materials, own->triangle_count, NULL,
                                    more->triangle_count, sizeof *own->triangle_materials);
    find_items(carving, mesh, memory);
    if (memory->status == BURNISH_STATUS_OK) {
        dress_negatives(carving, own, added, sizes);
        view->positions = arrays[0];
        view->normals = arrays[1];
        view->colors = arrays[2];
        view->texture_coordinates = arrays[3];
        view->second_coordinates = arrays[4];
        view->tangents = arrays[5];
        view->indices = arrays[INDICES];
        view->triangle_materials = arrays[MATERIALS];
        view->triangle_parts = NULL;
        carving->turned[0] = own->inside == BURNISH_INSIDE_FRONT;
        carving->turned[1] = more->inside == BURNISH_INSIDE_FRONT;
        carving->serial = own->serial;
    }
    return memory->status;
}

burnish_status burnish_carving_update(burnish_carving *carving, burnish_drawn_mesh *mesh,
                                      burnish_memory *memory) {
    const burnish_mesh *negatives = burnish_mesh_get_negatives(mesh->mesh);
    burnish_status status = BURNISH_STATUS_OK;
    carving->own_count = negatives ? mesh->view->triangle_count : 0;
    if (carving->own_count > 0 && carving->serial != mesh->view->serial) {
        release_arrays(carving, memory->context);
        status = join_meshes(carving, mesh->mesh, memory);
    }
    if (carving->own_count > 0 && status == BURNISH_STATUS_OK) {
        mesh->view = &carving->view;
    }
    return status;
}

static uint32_t triangle_of(const burnish_geometry *geometry, size_t index) {
    const size_t end = geometry->mesh_batches * BURNISH_BATCH_SIZE;
    return index < end ? (uint32_t)index : geometry->clipped_ids[index - end];
}

burnish_status burnish_carving_find(burnish_carving *carving, const burnish_geometry *geometry,
                                    const burnish_transparency *transparency,
                                    const burnish_raster_view *view, burnish_memory *memory) {
    const size_t count = geometry->batch_count, first = geometry->mesh_batches * BURNISH_BATCH_SIZE;
    carving->masks = burnish_reserve_discard(memory, carving->masks, &carving->mask_capacity, count,
                                             sizeof *carving->masks, "negative volumes");
    carving->layered = burnish_reserve_discard(memory, carving->layered, &carving->layered_capacity,
                                               count, sizeof *carving->layered, "negative volumes");
    carving->range = burnish_caps_range(&carving->view, view);
    for (size_t batch = 0; memory->status == BURNISH_STATUS_OK && batch < count; ++batch) {
        unsigned mask = 0;
        for (size_t i = 0; i < BURNISH_BATCH_SIZE; ++i) {
            const size_t at = batch * BURNISH_BATCH_SIZE + i;
            const int is_there = at < first ? at < carving->view.triangle_count
                                            : at - first < geometry->clipped_count;
            mask |= (unsigned)(is_there && carving->items[triangle_of(geometry, at)] > 0) << i;
        }
        carving->masks[batch] = carving->layered[batch] = (uint16_t)mask;
        if (transparency) { /* what is carved is opaque */
            carving->layered[batch] |= transparency->masks[batch];
            transparency->masks[batch] &= (uint16_t)~mask;
        }
    }
    return memory->status;
}

void burnish_carving_destroy(burnish_carving *carving, const burnish_context *context) {
    release_arrays(carving, context);
    burnish_release(context, carving->masks);
    burnish_release(context, carving->layered);
    memset(carving, 0, sizeof *carving);
}

/* ---- A sample ---- */

/* Where one is of an item. */
typedef struct place {
    uint32_t item;        /* + 1; 0: nowhere */
    int16_t inside, open; /* of how many solids, and negative volumes */
} place;

/* Kinds of layers, of equal depth in this order: faces that lie in each other open holes, and a solid
 * is left behind its outline. */
enum { NEGATIVE_FRONT, SOLID_FRONT, SOLID_BACK, NEGATIVE_BACK };

typedef struct layer {
    float depth;
    uint32_t index, item;
    int kind;
} layer;

enum { PLACES = 4 /* that are kept from pass to pass */, NONE = -1 };

struct burnish_carver {
    const burnish_carving *carving;
    const burnish_geometry *geometry;
    int is_too_much;
    place (*places)[PLACES]; /* per sample */
    float *through;          /* per sample: 1 while what is seen is unknown, else 0 */
};

burnish_carver *burnish_carver_create(int samples, burnish_memory *memory) {
    const size_t count = (size_t)samples * BURNISH_TILE_PIXELS;
    const size_t places = count * sizeof(place[PLACES]);
    burnish_carver *carver = burnish_allocate_zeroed(
        memory, 1, sizeof *carver + places + count * sizeof(float), "negative volumes");
    if (carver) {
        carver->places = (place(*)[PLACES])(void *)(carver + 1);
        carver->through = (float *)(void *)((char *)(carver + 1) + places);
    }
    return carver;
}

/* How far a depth of a triangle may be off because its vertices snap to 1/256 pixel. */
static float error_of(const burnish_geometry *geometry, uint32_t index) {
    const burnish_primitive primitive = burnish_geometry_primitive(geometry, index >> 1, index & 1);
    const burnish_screen_vertex *v[3];
    for (int k = 0; k < 3; ++k) {
        v[k] = &geometry->vertices.items[primitive.vertices[k]];
    }
    const float x[2] = {(float)(v[1]->x - v[0]->x), (float)(v[2]->x - v[0]->x)};
    const float y[2] = {(float)(v[1]->y - v[0]->y), (float)(v[2]->y - v[0]->y)};
    const float z[2] = {v[1]->depth - v[0]->depth, v[2]->depth - v[0]->depth};
    const float area = __builtin_fabsf(x[0] * y[1] - x[1] * y[0]);
    const float steps =
        __builtin_fabsf(z[0] * y[1] - z[1] * y[0]) + __builtin_fabsf(z[1] * x[0] - z[0] * x[1]);
    const float most = __builtin_fabsf(z[0]) + __builtin_fabsf(z[1]);
    return steps < most * area ? steps / area : most;
}

/* Whether layers may be in one plane. */
static int are_one(const burnish_geometry *geometry, const layer *a, const layer *b) {
    const float apart = a->depth - b->depth;
    return apart <= 1e-6f * b->depth ||
           apart <= error_of(geometry, a->index) + error_of(geometry, b->index);
}

/* A sample's layers, nearest first; returns how many. */
static int gather_layers(const burnish_carver *carver, const burnish_tile_layers *from, int sample,
                         layer to[BURNISH_LAYERS_MAX]) {
    const burnish_carving *carving = carver->carving;
    const int count = from->counts[sample];
    size_t at = burnish_layer_index(from, sample);
    for (int i = 0; i < count; ++i, at += (size_t)from->block_samples) {
        const uint32_t index = from->indices[at];
        const uint32_t triangle = triangle_of(carver->geometry, index >> 1);
        const int is_negative = triangle >= carving->own_count;
        const int is_back = (int)(index & 1) ^ carving->turned[is_negative];
        const int kind = is_negative ? is_back ? NEGATIVE_BACK : NEGATIVE_FRONT
                         : is_back   ? SOLID_BACK
                                     : SOLID_FRONT;
        const layer made = {from->depths[at], index, carving->items[triangle], kind};
        int k = i;
        for (; k > 0 && to[k - 1].kind > kind && to[k - 1].item == made.item &&
               are_one(carver->geometry, &to[k - 1], &made);
             --k) {
            to[k] = to[k - 1];
        }
        to[k] = made;
    }
    return count;
}

static place *find_place(place *places, int *count, uint32_t item) {
    for (int i = 0; i < *count; ++i) {
        if (places[i].item == item) {
            return &places[i];
        }
    }
    places[*count] = (place){item, 0, 0};
    return &places[(*count)++];
}

/* Where one is before the first layer: in what one leaves without having come into it. Solids only
 * where a cut has opened them. */
static void find_start(const layer *layers, int count, int is_cut, place *places,
                       int *place_count) {
    place now[BURNISH_LAYERS_MAX];
    int now_count = 0;
    for (int i = 0; i < count; ++i) {
        place *start = find_place(places, place_count, layers[i].item);
        place *at = find_place(now, &now_count, layers[i].item);
        at->open = (int16_t)(at->open + (layers[i].kind == NEGATIVE_FRONT) -
                             (layers[i].kind == NEGATIVE_BACK));
        at->inside = (int16_t)(at->inside + (layers[i].kind == SOLID_FRONT) -
                               (layers[i].kind == SOLID_BACK));
        start->open = start->open < -at->open ? (int16_t)-at->open : start->open;
        start->inside =
            is_cut && start->inside < -at->inside ? (int16_t)-at->inside : start->inside;
    }
}

/* The first layer of a solid that a cut shows filled. */
static int find_filled(const layer *layers, int count, const place *places, int place_count) {
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < place_count; ++k) {
            if (layers[i].kind == SOLID_BACK && places[k].item == layers[i].item &&
                places[k].inside > 0 && places[k].open == 0) {
                return i;
            }
        }
    }
    return NONE;
}

/* Passes a layer; returns 1 if it is what is seen. */
static int pass_layer(burnish_carver *carver, const layer *at, place *here) {
    const int was_inside = here->inside > 0, was_open = here->open > 0;
    here->open = (int16_t)(here->open + (at->kind == NEGATIVE_FRONT) -
                           (at->kind == NEGATIVE_BACK && was_open));
    here->inside = (int16_t)(here->inside + (at->kind == SOLID_FRONT) -
                             (at->kind == SOLID_BACK && was_inside));
    carver->is_too_much |= here->open > BURNISH_NEGATIVES_MAX;
    return at->kind == NEGATIVE_BACK ? was_open && was_inside && here->open == 0
                                     : at->kind != NEGATIVE_FRONT && !was_inside && !was_open;
}

/* Depths of a sample that cuts have left. */
typedef struct depth_range {
    int is_cut; /* 1: nearest is a plane */
    double nearest, farthest;
} depth_range;

static depth_range find_range(const burnish_cap_range *range, const burnish_tile *tile,
                              const burnish_raster_view *view, int sample) {
    const int samples = tile->options.samples, s = sample / BURNISH_BLOCK_PIXELS % samples;
    const int pixel = sample / (BURNISH_BLOCK_PIXELS * samples) * BURNISH_BLOCK_PIXELS +
                      sample % BURNISH_BLOCK_PIXELS;
    const int8_t *offset = burnish_sample_offsets(samples)[s];
    const double x = tile->x + burnish_pixel_x(pixel) + 0.5 + offset[0] / 16.0 - view->width * 0.5;
    const double y = view->height * 0.5 - tile->y - burnish_pixel_y(pixel) - 0.5 - offset[1] / 16.0;
    depth_range found = {0, (double)BURNISH_NEAREST, (double)BURNISH_FARTHEST};
    for (int i = 0; i < range->count; ++i) {
        const burnish_cap *cap = &range->items[i];
        const double depth = (cap->right * x + cap->up * y) + cap->middle;
        if (range->is_exit[i]) {
            found.farthest = depth > found.farthest ? depth : found.farthest;
        } else {
            found.nearest = depth < found.nearest ? depth : found.nearest;
            found.is_cut = 1;
        }
    }
    return found;
}

/* The number of the layer that is seen, or NONE. *is_open: 1 where layers behind may be. */
static int walk_layers(burnish_carver *carver, const layer *layers, int count,
                       const depth_range *range, place *places, int *place_count, int *is_open) {
    int is_entered = !range->is_cut;
    *is_open = 0;
    for (int i = 0; i < count; ++i) {
        const double depth = (double)layers[i].depth;
        const double margin = carver->carving->range.count > 0
                                  ? (double)error_of(carver->geometry, layers[i].index)
                                  : 0;
        if (depth < range->farthest - margin) {
            return NONE;
        }
        if (!is_entered && depth < range->nearest - margin) {
            const int filled = find_filled(layers, count, places, *place_count);
            is_entered = 1;
            if (filled != NONE) {
                return filled;
            }
        }
        place *here = find_place(places, place_count, layers[i].item);
        if (pass_layer(carver, &layers[i], here) && is_entered) {
            return i;
        }
    }
    *is_open = count == BURNISH_LAYERS_MAX;
    return NONE;
}

static void carve_sample(burnish_carver *carver, burnish_tile *tile,
                         const burnish_raster_view *view, int sample) {
    burnish_tile_layers *from = tile->layers;
    layer layers[BURNISH_LAYERS_MAX];
    place places[BURNISH_LAYERS_MAX + PLACES], *kept = carver->places[sample];
    const int count = gather_layers(carver, from, sample, layers);
    depth_range range = find_range(&carver->carving->range, tile, view, sample);
    int place_count = 0, is_open;
    if (from->pass == 0) {
        find_start(layers, count, range.is_cut, places, &place_count);
    } else {
        for (; place_count < PLACES && kept[place_count].item > 0; ++place_count) {
            places[place_count] = kept[place_count];
        }
        range.is_cut &= (double)from->fronts[sample] >= range.nearest;
    }
    const int seen = walk_layers(carver, layers, count, &range, places, &place_count, &is_open);
    carver->through[sample] = (float)is_open;
    if (seen != NONE) {
        from->chosen[sample] = layers[seen].index;
    }
    int used = 0;
    memset(kept, 0, sizeof *carver->places);
    for (int i = 0; is_open && i < place_count; ++i) {
        if (places[i].inside > 0 || places[i].open > 0) {
            carver->is_too_much |= used == PLACES;
            kept[used < PLACES ? used++ : 0] = places[i];
        }
    }
}

int burnish_carve_tile(burnish_carver *carver, burnish_tile *tile, const burnish_carve_scene *scene,
                       const burnish_bins *bins) {
    burnish_tile_layers *layers = tile->layers;
    const burnish_carving *carving = scene->carving;
    const burnish_geometry *geometry = scene->geometry;
    const int column = tile->x / BURNISH_TILE_SIZE, row = tile->y / BURNISH_TILE_SIZE;
    const int count = BURNISH_TILE_PIXELS * tile->options.samples;
    carver->carving = carving;
    carver->geometry = geometry;
    carver->is_too_much = 0;
    memset(layers->chosen, 0xff, (size_t)count * sizeof *layers->chosen);
    do {
        scene->ops->draw_deeper_layers(tile, geometry, bins, column, row);
        for (int i = 0; i < count; ++i) {
            carver->through[i] = 0;
            if (layers->counts[i] > 0) {
                carve_sample(carver, tile, scene->view, i);
            }
        }
    } while (burnish_layers_deeper(tile, carver->through, 0, 0.5f, BURNISH_LAYER_PASSES));
    carver->is_too_much |= layers->dropped != layers->dropped_before;
    layers->dropped = layers->dropped_before;
    layers->pass = 0;
    scene->ops->draw_chosen(tile, geometry, bins, column, row);
    memset(layers->counts, 0, (size_t)count * sizeof *layers->counts);
    return !carver->is_too_much;
}
