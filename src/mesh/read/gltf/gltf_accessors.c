/* glTF's accessors: numbers of six types in buffer views, some of them overwritten by sparse ones.
 *
 * Bounds are checked once; reading an element then needs no check. An accessor with sparse values
 * or without a view gets a separate array, made once. The input's size limits all of these
 * together, because many may share one view. */

#include "mesh/read/gltf/gltf.h"

size_t burnish_gltf_component_size(int component) {
    switch (component) {
    case BURNISH_GLTF_BYTE:
    case BURNISH_GLTF_UNSIGNED_BYTE:
        return 1;
    case BURNISH_GLTF_SHORT:
    case BURNISH_GLTF_UNSIGNED_SHORT:
        return 2;
    case BURNISH_GLTF_UNSIGNED_INT:
    case BURNISH_GLTF_FLOAT:
        return 4;
    default:
        return 0;
    }
}

/* Components of a type; 0 for types that are not used here (MAT2 and MAT3 have gaps). */
static int width_of(const burnish_gltf *gltf, uint32_t type) {
    static const struct {
        const char *name;
        int width;
    } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i) {
        if (burnish_json_is_text(&gltf->json, type, types[i].name)) {
            return types[i].width;
        }
    }
    return 0;
}

/* ---- Elements ---- */

/* Source of the scales: section 3.11 of the specification. */
static double read_component(const uint8_t *p, int component, int is_normalized) {
    double value, scale;
    switch (component) {
    case BURNISH_GLTF_FLOAT:
        return burnish_load_float(p);
    case BURNISH_GLTF_UNSIGNED_INT:
        return burnish_load32(p);
    case BURNISH_GLTF_BYTE:
        value = (int8_t)*p;
        scale = 127;
        break;
    case BURNISH_GLTF_UNSIGNED_BYTE:
        value = *p;
        scale = 255;
        break;
    case BURNISH_GLTF_SHORT:
        value = (int16_t)(uint16_t)burnish_load16(p);
        scale = 32767;
        break;
    default:
        value = burnish_load16(p);
        scale = 65535;
        break;
    }
    if (!is_normalized) {
        return value;
    }
    return value < -scale ? -1 : value / scale;
}

void burnish_gltf_element(const burnish_gltf_accessor *accessor, size_t i, double *components) {
    const uint8_t *p = accessor->bytes + i * accessor->stride;
    const size_t size = burnish_gltf_component_size(accessor->component);
    if (accessor->component == BURNISH_GLTF_FLOAT) { /* most are */
        for (int k = 0; k < accessor->width; ++k) {
            components[k] = burnish_load_float(p + 4 * (size_t)k);
        }
        return;
    }
    for (int k = 0; k < accessor->width; ++k) {
        components[k] =
            read_component(p + (size_t)k * size, accessor->component, accessor->is_normalized);
    }
}

/* ---- Bounds ---- */

/* Finds `count` elements of element_size bytes in the view that `object` names with its byteOffset.
 * *stride is the view's, or packed. */
static const uint8_t *locate_elements(burnish_gltf *gltf, uint32_t object, uint32_t view,
                                      size_t count, size_t element_size, size_t *stride) {
    burnish_gltf_bytes bytes;
    const uint64_t offset = burnish_gltf_whole(gltf, object, "byteOffset", 0, (uint64_t)1 << 53);
    if (!burnish_gltf_view(gltf, view, &bytes, stride) || gltf->status != BURNISH_STATUS_OK) {
        return NULL;
    }
    if (*stride == 0) {
        *stride = element_size;
    } else if (*stride < element_size) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, object,
                          "its elements have %zu bytes, but are %zu apart in bufferViews[%u]",
                          element_size, *stride, view);
        return NULL;
    }
    /* (count - 1) stride + element_size <= size - offset, without overflow */
    if (offset > bytes.size || element_size > bytes.size - offset ||
        (bytes.size - offset - element_size) / *stride < count - 1) {
        burnish_gltf_fail(
            gltf, BURNISH_STATUS_FORMAT, object,
            "%zu elements do not fit into bufferViews[%u] of %zu bytes; the file is damaged", count,
            view, bytes.size);
        return NULL;
    }
    return bytes.bytes + offset;
}

/* ---- Arrays of their own ---- */

/* A packed copy of the elements; 0 without a view. */
static void own_elements(burnish_gltf *gltf, burnish_gltf_accessor *accessor, size_t element_size) {
    const uint64_t bytes = (uint64_t)accessor->count * element_size; /* < 2^32 * 64 */
    if (!burnish_gltf_fill(gltf, accessor->value, bytes, "sparse accessors")) {
        return;
    }
    accessor->owned =
        burnish_allocate_zeroed(gltf->memory, accessor->count, element_size, "sparse accessors");
    if (!burnish_gltf_is_fine(gltf)) {
        return;
    }
    uint8_t *to = accessor->owned;
    for (size_t i = 0; accessor->bytes && i < accessor->count; ++i) {
        memcpy(to + i * element_size, accessor->bytes + i * accessor->stride, element_size);
    }
    accessor->bytes = accessor->owned;
    accessor->stride = element_size;
}

/* Overwrites the elements that accessor.sparse names. */
static void fill_sparse(burnish_gltf *gltf, burnish_gltf_accessor *accessor, uint32_t sparse,
                        size_t element_size) {
    const uint32_t indices = burnish_gltf_object(gltf, sparse, "indices");
    const uint32_t values = burnish_gltf_object(gltf, sparse, "values");
    const size_t count = (size_t)burnish_gltf_whole(gltf, sparse, "count", 0, accessor->count);
    const int type = (int)burnish_gltf_whole(gltf, indices, "componentType", 0, 65535);
    const uint32_t index_view =
        burnish_gltf_reference(gltf, indices, "bufferView", BURNISH_GLTF_VIEWS);
    const uint32_t value_view =
        burnish_gltf_reference(gltf, values, "bufferView", BURNISH_GLTF_VIEWS);
    if (gltf->status != BURNISH_STATUS_OK || count == 0) {
        return;
    }
    if (index_view == BURNISH_GLTF_NONE || value_view == BURNISH_GLTF_NONE ||
        (type != BURNISH_GLTF_UNSIGNED_BYTE && type != BURNISH_GLTF_UNSIGNED_SHORT &&
         type != BURNISH_GLTF_UNSIGNED_INT)) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, sparse,
                          "needs indices of unsigned integers and values, each with a bufferView");
        return;
    }
    size_t index_stride, value_stride;
    const uint8_t *index_bytes = locate_elements(gltf, indices, index_view, count,
                                                 burnish_gltf_component_size(type), &index_stride);
    const uint8_t *value_bytes =
        index_bytes ? locate_elements(gltf, values, value_view, count, element_size, &value_stride)
                    : NULL;
    if (!value_bytes) {
        return;
    }
    const burnish_gltf_accessor index = {.bytes = index_bytes,
                                         .count = count,
                                         .stride = index_stride,
                                         .component = type,
                                         .width = 1};
    uint8_t *to = accessor->owned;
    for (size_t i = 0; i < count; ++i) {
        const uint32_t at = burnish_gltf_integer(&index, i, 0);
        if (at >= accessor->count) {
            burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, indices,
                              "index %u is not below the %zu elements of its accessor", at,
                              accessor->count);
            return;
        }
        memcpy(to + at * element_size, value_bytes + i * value_stride, element_size);
    }
}

/* The type of an accessor's elements. */
static void read_kind(burnish_gltf *gltf, burnish_gltf_accessor *accessor) {
    const uint32_t value = accessor->value;
    accessor->count =
        (size_t)burnish_gltf_whole(gltf, value, "count", 0, (uint64_t)BURNISH_VALUE_LIMIT - 1);
    accessor->component = (int)burnish_gltf_whole(gltf, value, "componentType", 0, 65535);
    accessor->width = width_of(gltf, burnish_json_member(&gltf->json, value, "type"));
    accessor->is_normalized = burnish_gltf_flag(gltf, value, "normalized", 0);
    accessor->stride = burnish_gltf_component_size(accessor->component) * (size_t)accessor->width;
    if (gltf->status != BURNISH_STATUS_OK) {
        return;
    }
    if (accessor->stride == 0) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, value,
                          "its type or componentType is not supported; expected SCALAR, VEC2, "
                          "VEC3, VEC4 or MAT4, and 5120 to 5126");
    } else if (accessor->count == 0) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, value,
                          "has no elements; count must be 1 or more");
    }
}

/* Makes an array for an accessor without values, or with sparse ones. */
static void fill_own(burnish_gltf *gltf, burnish_gltf_accessor *accessor) {
    const uint32_t sparse = burnish_gltf_object(gltf, accessor->value, "sparse");
    const size_t element_size =
        burnish_gltf_component_size(accessor->component) * (size_t)accessor->width;
    if (gltf->status != BURNISH_STATUS_OK || (accessor->bytes && sparse == BURNISH_JSON_NONE)) {
        return;
    }
    own_elements(gltf, accessor, element_size);
    if (gltf->status == BURNISH_STATUS_OK && sparse != BURNISH_JSON_NONE) {
        fill_sparse(gltf, accessor, sparse, element_size);
    }
}

static void resolve_accessor(burnish_gltf *gltf, burnish_gltf_accessor *accessor) {
    const uint32_t value = accessor->value;
    const uint32_t view = burnish_gltf_reference(gltf, value, "bufferView", BURNISH_GLTF_VIEWS);
    read_kind(gltf, accessor);
    if (gltf->status != BURNISH_STATUS_OK) {
        return;
    }
    if (view != BURNISH_GLTF_NONE) {
        accessor->bytes = locate_elements(gltf, value, view, accessor->count, accessor->stride,
                                          &accessor->stride);
    }
    fill_own(gltf, accessor);
}

void burnish_gltf_give(burnish_gltf *gltf, uint32_t number, uint32_t user,
                       const burnish_gltf_accessor *values) {
    burnish_gltf_accessor *accessor = &gltf->accessors[number];
    if (accessor->bytes) {
        return;
    }
    accessor->value = gltf->lists[BURNISH_GLTF_ACCESSORS][number];
    read_kind(gltf, accessor);
    if (gltf->status != BURNISH_STATUS_OK) {
        return;
    }
    /* indices have 32 bits, regardless of the file's component type */
    const int is_same = values->component == accessor->component || values->width == 1;
    if (values->width != accessor->width || !is_same || values->count < accessor->count) {
        burnish_gltf_fail(
            gltf, BURNISH_STATUS_FORMAT, user,
            "unpacks to other values than accessors[%u] describes; the file is damaged", number);
        return;
    }
    accessor->component = values->component;
    accessor->stride = burnish_gltf_component_size(accessor->component) * (size_t)accessor->width;
    accessor->bytes = values->bytes;
    fill_own(gltf, accessor);
}

const burnish_gltf_accessor *burnish_gltf_resolve(burnish_gltf *gltf, uint32_t accessor,
                                                  uint32_t user, unsigned widths) {
    burnish_gltf_accessor *at = &gltf->accessors[accessor];
    if (!at->bytes) {
        at->value = gltf->lists[BURNISH_GLTF_ACCESSORS][accessor];
        resolve_accessor(gltf, at);
    }
    if (gltf->status == BURNISH_STATUS_OK && !(widths >> at->width & 1)) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, user,
                          "accessors[%u] has the wrong type for this use", accessor);
    }
    return gltf->status == BURNISH_STATUS_OK ? at : NULL;
}
