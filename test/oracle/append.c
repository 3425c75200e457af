/* How readers fill a oracle_source. */
#include "oracle/append.h"

#include <string.h>

#include "oracle/polygon.h"

static burnish_status reserve_colors(oracle_source *source, size_t count, burnish_error *error) {
    return oracle_legacy_reserve((void **)&source->colors, &source->color_capacity, count, 4,
                                 "colours", error);
}

burnish_status oracle_append_position(oracle_source *source, oracle_place place,
                                      const float position[3], burnish_error *error) {
    size_t count = source->position_count;
    burnish_status status = BURNISH_STATUS_OK;
    if (count >= ORACLE_POSITION_LIMIT) {
        return oracle_fail_at(error, BURNISH_STATUS_LIMIT, place,
                              "more than %zu vertices; split or simplify the mesh",
                              ORACLE_POSITION_LIMIT);
    }
    if (count == source->position_capacity) {
        status = oracle_legacy_reserve((void **)&source->positions, &source->position_capacity,
                                       count + 1, 3 * sizeof(float), "positions", error);
    }
    if (status == BURNISH_STATUS_OK && source->colors) {
        status = reserve_colors(source, count + 1, error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (source->colors) {
        memset(source->colors + 4 * count, 255, 4);
    }
    memcpy(source->positions + 3 * count, position, 3 * sizeof(float));
    source->position_count = count + 1;
    return BURNISH_STATUS_OK;
}

burnish_status oracle_append_color(oracle_source *source, const uint8_t rgba[4],
                                   burnish_error *error) {
    size_t count = source->position_count;
    if (!source->colors) {
        burnish_status status = reserve_colors(source, count, error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        memset(source->colors, 255, 4 * count);
    }
    memcpy(source->colors + 4 * (count - 1), rgba, 4);
    return BURNISH_STATUS_OK;
}

burnish_status oracle_append_normal(oracle_source *source, oracle_place place,
                                    const float normal[3], burnish_error *error) {
    size_t count = source->normal_count;
    if (count >= ORACLE_POSITION_LIMIT) {
        return oracle_fail_at(error, BURNISH_STATUS_LIMIT, place,
                              "more than %zu normals; split or simplify the mesh",
                              ORACLE_POSITION_LIMIT);
    }
    if (count == source->normal_capacity) {
        burnish_status status =
            oracle_legacy_reserve((void **)&source->normals, &source->normal_capacity, count + 1,
                                  3 * sizeof(float), "normals", error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    memcpy(source->normals + 3 * count, normal, 3 * sizeof(float));
    source->normal_count = count + 1;
    return BURNISH_STATUS_OK;
}

burnish_status oracle_reserve_triangles(oracle_source *source, const burnish_load_options *options,
                                        oracle_place place, size_t more, burnish_error *error) {
    uint64_t limit = options->max_triangles;
    if (limit > ORACLE_TRIANGLE_LIMIT) {
        limit = ORACLE_TRIANGLE_LIMIT;
    }
    if (source->triangle_count > limit || more > limit - source->triangle_count) {
        return oracle_fail_at(error, BURNISH_STATUS_LIMIT, place,
                              "more than %llu triangles; raise the limit or simplify the mesh",
                              (unsigned long long)limit);
    }
    return oracle_legacy_reserve((void **)&source->corner_positions, &source->corner_capacity,
                                 source->triangle_count + more, 3 * sizeof(uint32_t), "triangles",
                                 error);
}

/* Room for the normal indices of `more` triangles; those so far get none when these are the first.
 */
static burnish_status reserve_corner_normals(oracle_source *source, size_t more,
                                             burnish_error *error) {
    int first = !source->corner_normals;
    burnish_status status = oracle_legacy_reserve(
        (void **)&source->corner_normals, &source->corner_normal_capacity,
        source->triangle_count + more, 3 * sizeof(uint32_t), "normal indices", error);
    if (status == BURNISH_STATUS_OK && first) {
        memset(source->corner_normals, 0xFF, 3 * sizeof(uint32_t) * source->triangle_count);
    }
    return status;
}

/* One triangle of a polygon, by the numbers of its corners there. */
static inline void place_triangle(oracle_source *source, size_t triangle, const uint32_t *positions,
                                  const uint32_t *normals, size_t a, size_t b, size_t c) {
    uint32_t *to = source->corner_positions + 3 * triangle;
    to[0] = positions[a];
    to[1] = positions[b];
    to[2] = positions[c];
    if (source->corner_normals) {
        to = source->corner_normals + 3 * triangle;
        to[0] = normals ? normals[a] : ORACLE_SOURCE_NONE;
        to[1] = normals ? normals[b] : ORACLE_SOURCE_NONE;
        to[2] = normals ? normals[c] : ORACLE_SOURCE_NONE;
    }
}

void oracle_place_polygon(oracle_source *source, size_t first_triangle, const uint32_t *positions,
                          const uint32_t *normals, size_t count) {
    if (count > 3 && count <= ORACLE_POLYGON_CORNERS) {
        uint16_t cut[3 * (ORACLE_POLYGON_CORNERS - 2)];
        oracle_polygon_cut(source->positions, positions, count, cut);
        for (size_t i = 0; i < count - 2; ++i) {
            place_triangle(source, first_triangle + i, positions, normals, cut[3 * i],
                           cut[3 * i + 1], cut[3 * i + 2]);
        }
    } else {
        for (size_t i = 0; i < count - 2; ++i) {
            place_triangle(source, first_triangle + i, positions, normals, 0, i + 1, i + 2);
        }
    }
}

burnish_status oracle_append_polygon(oracle_source *source, const burnish_load_options *options,
                                     oracle_place place, const uint32_t *positions,
                                     const uint32_t *normals, size_t count, burnish_error *error) {
    burnish_status status = oracle_reserve_triangles(source, options, place, count - 2, error);
    if (status == BURNISH_STATUS_OK && (normals || source->corner_normals)) {
        status = reserve_corner_normals(source, count - 2, error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    oracle_place_polygon(source, source->triangle_count, positions, normals, count);
    source->triangle_count += count - 2;
    return BURNISH_STATUS_OK;
}
