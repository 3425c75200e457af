/* The same steps as interpolate.c and shade.c, for a row of pixels in place. */
#include "shade/row.h"

static burnish_float4 mix(const burnish_float4 *attributes, const uint32_t v[3], float weight1,
                          float weight2) {
    const float weight0 = (1.0f - weight1) - weight2;
    return (attributes[v[0]] * weight0 + attributes[v[1]] * weight1) + attributes[v[2]] * weight2;
}

/* Colours and Lyon's lobe need the attributes themselves, not times 1/w. */
static float divide_w(const burnish_shader *shader, const uint32_t v[3], float weight1,
                      float weight2, float inverse_w, int x, burnish_row *row) {
    const float w = 1.0f / inverse_w;
    if (shader->attributes.colors) {
        burnish_float4 color = mix(shader->attributes.colors, v, weight1, weight2) * w;
        for (int k = 0; k < 3; ++k) {
            row->diffuse[k][x] = color[k];
        }
    }
    return shader->lighting.lyon ? w : 1.0f;
}

/* Interpolates the pixels from `first` on that have an owner; returns the end of the last. */
static int interpolate_row(const burnish_shader *shader, const burnish_visibility *visibility,
                           const burnish_whole_row *whole, int first, burnish_row *row) {
    const burnish_float4 *normals = shader->attributes.normals;
    const int32_t *owners = whole->owners;
    const int needs_w = shader->attributes.colors || shader->lighting.lyon;
    int end = first;
    uint16_t material = 0;
    for (int x = first; x < visibility->width; ++x) {
        if (owners[x] >= 0) {
            const burnish_corners *corners = &visibility->triangles[owners[x]].corners;
            const float weight1 = whole->weights[0][x], weight2 = whole->weights[1][x];
            burnish_float4 normal = mix(normals, corners->vertices, weight1, weight2);
            float scale = corners->source & 1 ? -1.0f : 1.0f;
            if (needs_w) {
                scale *= divide_w(shader, corners->vertices, weight1, weight2, normal[3], x, row);
            }
            normal *= scale;
            row->normal[0][x] = normal[0];
            row->normal[1][x] = normal[1];
            row->normal[2][x] = normal[2];
            visibility->places[owners[x]] = 1;
            if (shader->triangle_materials) {
                material = shader->triangle_materials[corners->source >> 1];
            }
            end = x + 1;
        }
        row->material[x] = material; /* a hole goes with what is before it */
    }
    return end;
}

/* Places of the pixels [first, end) from the eye, times w. */
static void locate_row(const burnish_shade_view *view, const burnish_visibility *visibility,
                       const burnish_raster_view *raster, const float *depths, int y, int first,
                       int end, burnish_row *row) {
    const int half = BURNISH_SUBPIXELS / 2;
    const int center_y = (visibility->y + y) * BURNISH_SUBPIXELS + half - raster->height * half;
    const float at_y = (float)-center_y / BURNISH_SUBPIXELS;
    for (int x = first; x < end; ++x) {
        const int center_x = (visibility->x + x) * BURNISH_SUBPIXELS + half - raster->width * half;
        const float at_x = (float)center_x / BURNISH_SUBPIXELS;
        for (int k = 0; k < 3; ++k) {
            row->position[k][x] = ((view->ray[k] + at_x * view->ray_x[k]) + at_y * view->ray_y[k]) +
                                  (1.0f - depths[x]) * view->ray_depth[k];
        }
        row->w[x] = depths[x] * view->q_per_depth + view->q_constant;
    }
}

static void shade_run(const burnish_shader *shader, burnish_shade_cache *cache, int first, int end,
                      burnish_row *row) {
    burnish_batch_points run = {.w = row->w + first};
    float *rgb[3];
    burnish_shade_prepare(shader, row->material[first], cache);
    for (int k = 0; k < 3; ++k) {
        run.normal[k] = row->normal[k] + first;
        run.diffuse[k] = shader->attributes.colors ? row->diffuse[k] + first : NULL;
        run.position[k] = row->position[k] + first;
        rgb[k] = row->rgb[k] + first;
    }
    (void)burnish_batch_shade_float(shader->batch, &cache->prepared, &run, (size_t)(end - first),
                                    rgb, NULL);
}

int burnish_shade_row(const burnish_shader *shader, burnish_shade_cache *cache,
                      const burnish_visibility *visibility, const burnish_whole_row *whole,
                      const burnish_raster_view *view, int y, burnish_row *row) {
    int first = 0;
    while (first < visibility->width && whole->owners[first] < 0) {
        ++first;
    }
    if (first == visibility->width) {
        return 0;
    }
    const int end = interpolate_row(shader, visibility, whole, first, row);
    if (shader->needs_place) {
        locate_row(&shader->view, visibility, view, whole->depths, y, first, end, row);
    }
    if (!shader->triangle_materials) {
        /* whole vectors: pixels that nothing covers may be shaded too */
        const int from = first & ~15, to = (end + 15) & ~15;
        row->material[from] = 0;
        shade_run(shader, cache, from, to, row);
        return 1;
    }
    for (int at = first, next; at < end; at = next) {
        for (next = at + 1; next < end && row->material[next] == row->material[at]; ++next) {
        }
        shade_run(shader, cache, at, next, row);
    }
    return 1;
}
