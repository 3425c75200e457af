/* Looking points up in the depth maps of ambient occlusion. */
#ifndef BURNISH_RENDER_LIGHT_OCCLUSION_SIMD_H
#define BURNISH_RENDER_LIGHT_OCCLUSION_SIMD_H

#include "render/light/maps/depth_map_simd.h"
#include "render/light/maps/occlusion.h"

/* Hidden shares are means of taps at these offsets, in radii: two rotated squares, because an edge
 * along a map's axis would meet two taps of an upright one at once. A single square shows as
 * blotches in deep places, where most directions are hidden by something far away. Directions of much
 * light, whose taps would show as bands, have a spiral of twice as many. */
enum { TAP_COUNT = 8, BRIGHT_TAP_COUNT = 16 };
static const float TAPS[TAP_COUNT][2] = {{0.35f, 0.94f},  {-0.94f, 0.35f}, {-0.35f, -0.94f},
                                         {0.94f, -0.35f}, {0.5f, 0.02f},   {-0.02f, 0.5f},
                                         {-0.5f, -0.02f}, {0.02f, -0.5f}};
static const float BRIGHT_TAPS[BRIGHT_TAP_COUNT][2] = {
    {0.17f, 0.05f},   {-0.28f, 0.13f}, {0.15f, -0.37f}, {0.16f, 0.44f},
    {-0.47f, -0.24f}, {0.57f, -0.15f}, {-0.34f, 0.54f}, {-0.12f, -0.67f},
    {0.58f, 0.44f},   {-0.77f, 0.07f}, {0.54f, -0.60f}, {0.00f, 0.85f},
    {-0.60f, -0.65f}, {0.92f, 0.08f},  {-0.75f, 0.58f}, {0.17f, -0.97f}};

/* Of a direction that has more taps. */
#define BRIGHT 2.5f

/* How far above a point the blockers around it reach, in codes: the coarse map's maxima, bilinear,
 * less what the point's own plane rises in a cell. Most points have no blockers there, which a
 * single look-up detects. */
BURNISH_INLINE vf blocker_distance(const burnish_occlusion_lookup *lookup,
                                   const burnish_occlusion_pair *pair, vi shift,
                                   const map_point *point) {
    const int size = lookup->size / BURNISH_OCCLUSION_CELL;
    const vf scale = vf_set(1.0f / BURNISH_OCCLUSION_CELL);
    const vf middle = vf_set(0.5f / BURNISH_OCCLUSION_CELL - 0.5f);
    map_point coarse = *point;
    coarse.x = vf_add(vf_mul(point->x, scale), middle);
    coarse.y = vf_add(vf_mul(point->y, scale), middle);
    coarse.depth = vf_add(
        point->depth, vf_mul(vf_add(map_magnitude(point->slope_x), map_magnitude(point->slope_y)),
                             vf_set(BURNISH_OCCLUSION_CELL)));
    coarse.slope_x = coarse.slope_y = vf_set(0.0f);
    const vi cell = vi_add(
        texel_index(texel_before(coarse.x, size), texel_before(coarse.y, size), size), shift);
    const vi greatest = vi_and(vi_gather_pair(pair->blockers + size * size, cell), vi_set(0xffff));
    if (!vm_any(vf_greater(vf_from_int(greatest), coarse.depth))) {
        return vf_set(0.0f);
    }
    return map_over(pair->blockers, shift, size, &coarse, vf_set(0x1p17f), vf_set(1.0f));
}

BURNISH_INLINE vf look_up_wide(const burnish_occlusion_lookup *lookup,
                               const burnish_occlusion_pair *pair, vi shift, const map_point *point,
                               vf radius) {
    const int is_bright = pair->weight[0] > BRIGHT || pair->weight[1] > BRIGHT;
    const int count = is_bright ? BRIGHT_TAP_COUNT : TAP_COUNT;
    const float(*const taps)[2] = is_bright ? BRIGHT_TAPS : TAPS;
    const vf one = vf_set(1.0f), factor = vf_set(lookup->slope);
    vf hidden = vf_set(0.0f);
    for (int i = 0; i < count; ++i) {
        const vf dx = vf_mul(radius, vf_set(taps[i][0])), dy = vf_mul(radius, vf_set(taps[i][1]));
        const vf rise = vf_add(vf_mul(dx, point->slope_x), vf_mul(dy, point->slope_y));
        map_point tap = *point;
        tap.x = vf_add(point->x, dx);
        tap.y = vf_add(point->y, dy);
        tap.depth = vf_add(point->depth, rise);
        hidden = vf_add(hidden, map_over(pair->depths, shift, lookup->size, &tap, one, factor));
    }
    return vf_mul(hidden, vf_set(1.0f / (float)count));
}

enum { OCCLUDED_ROOM = BURNISH_OCCLUDED_MAX + LANES };

/* Points whose blockers are so far that they are looked up with a wide filter: they wait until
 * there is a vector of them. */
typedef struct wide_points {
    int count;
    int32_t x[OCCLUDED_ROOM], y[OCCLUDED_ROOM], depth[OCCLUDED_ROOM]; /* bits of floats */
    int32_t slope_x[OCCLUDED_ROOM], slope_y[OCCLUDED_ROOM], radius[OCCLUDED_ROOM];
    int32_t shift[OCCLUDED_ROOM], index[OCCLUDED_ROOM];
} wide_points;

/* Sums over directions so far, in the order of these. */
typedef struct occlusion_sums {
    float p[3][OCCLUDED_ROOM];                          /* the points, moved off the surface */
    float light[OCCLUDED_ROOM], hidden[OCCLUDED_ROOM];  /* by the weights of directions */
    float sky[OCCLUDED_ROOM], covered[OCCLUDED_ROOM];   /* the same with equal weights */
    float weight[OCCLUDED_ROOM], cosine[OCCLUDED_ROOM]; /* of the direction at hand */
} occlusion_sums;

BURNISH_INLINE void queue_wide(wide_points *wide, unsigned lanes, const map_point *point, vf radius,
                               vi shift, vi index) {
    const int at = wide->count;
    vi_compress(lanes, wide->x + at, vf_bits(point->x));
    vi_compress(lanes, wide->y + at, vf_bits(point->y));
    vi_compress(lanes, wide->depth + at, vf_bits(point->depth));
    vi_compress(lanes, wide->slope_x + at, vf_bits(point->slope_x));
    vi_compress(lanes, wide->slope_y + at, vf_bits(point->slope_y));
    vi_compress(lanes, wide->radius + at, vf_bits(radius));
    vi_compress(lanes, wide->shift + at, shift);
    wide->count += vi_compress(lanes, wide->index + at, index);
}

BURNISH_INLINE vf load_wide(const int32_t *from, vm lanes) {
    return vf_and_mask(lanes, vf_from_bits(vi_load(from)));
}

/* LANES of the points that wait. */
BURNISH_INLINE void add_wide(const burnish_occlusion_lookup *lookup,
                             const burnish_occlusion_pair *pair, const wide_points *wide, int first,
                             occlusion_sums *sums) {
    const int rest = wide->count - first, count = rest < LANES ? rest : LANES;
    const vm lanes = vi_greater(vi_set(count), vi_ramp(1));
    const vi none = vi_set(0);
    const map_point point = {load_wide(wide->x + first, lanes), load_wide(wide->y + first, lanes),
                             load_wide(wide->depth + first, lanes),
                             load_wide(wide->slope_x + first, lanes),
                             load_wide(wide->slope_y + first, lanes)};
    const vi shift = vi_blend(lanes, vi_load(wide->shift + first), none);
    float hidden[LANES];
    vf_store(hidden,
             look_up_wide(lookup, pair, shift, &point, load_wide(wide->radius + first, lanes)));
    for (int i = 0; i < count; ++i) {
        const int index = wide->index[first + i];
        sums->hidden[index] += sums->weight[index] * hidden[i];
        sums->covered[index] += sums->cosine[index] * hidden[i];
    }
}

/* Adds what a direction and the one against it show to LANES points; each faces one of them. A
 * direction represents a cone, whose width at the blockers is the radius of the filter. */
BURNISH_INLINE void add_directions(const burnish_occlusion_lookup *lookup,
                                   const burnish_occlusion_pair *pair, const float *const normal[3],
                                   size_t i, occlusion_sums *sums, wide_points *wide) {
    const vf n[3] = {vf_load(normal[0] + i), vf_load(normal[1] + i), vf_load(normal[2] + i)};
    const vf p[3] = {vf_load(sums->p[0] + i), vf_load(sums->p[1] + i), vf_load(sums->p[2] + i)};
    const vf cosine = map_dot(pair->toward, n), size = map_magnitude(cosine);
    const vm back = vf_greater(vf_set(0.0f), cosine);
    const vi shift = vi_blend(back, vi_set(lookup->back), vi_set(0));
    map_point point = map_locate(&pair->map, p, n, vf_max(size, vf_set(0.125f)), lookup->plane);
    const vf against = vf_sub(vf_set((float)BURNISH_MAP_CODES), point.depth);
    point.depth = vf_blend(back, vf_max(against, vf_set(1.0f)), point.depth);
    const vf radius = vf_mul(blocker_distance(lookup, pair, shift, &point), vf_set(lookup->cone));
    const vm is_wide = vf_greater(radius, vf_set(lookup->least_radius));
    const vf weight =
        vf_mul(size, vf_blend(back, vf_set(pair->weight[1]), vf_set(pair->weight[0])));
    vf_store(sums->light + i, vf_add(vf_load(sums->light + i), weight));
    vf_store(sums->sky + i, vf_add(vf_load(sums->sky + i), size));
    if (vm_any(is_wide)) {
        vf_store(sums->weight + i, weight);
        vf_store(sums->cosine + i, size);
        queue_wide(wide, vm_bits(is_wide), &point, vf_min(radius, vf_set(lookup->most_radius)),
                   shift, vi_add(vi_ramp(1), vi_set((int32_t)i)));
    }
    if (vm_any(vm_not(is_wide))) {
        const vf hidden = map_over(pair->depths, shift, lookup->size, &point, vf_set(1.0f),
                                   vf_set(lookup->slope));
        const vf part = vf_blend(is_wide, vf_set(0.0f), hidden);
        vf_store(sums->hidden + i, vf_add(vf_load(sums->hidden + i), vf_mul(weight, part)));
        vf_store(sums->covered + i, vf_add(vf_load(sums->covered + i), vf_mul(size, part)));
    }
}

static void occlude(const burnish_occlusion_lookup *lookup, const float *const position[3],
                    const float *const normal[3], size_t count, float *const open[2]) {
    occlusion_sums sums;
    wide_points wide;
    for (size_t i = 0; i < count; i += LANES) {
        for (int k = 0; k < 3; ++k) {
            const vf off = vf_mul(vf_load(normal[k] + i), vf_set(lookup->offset));
            vf_store(sums.p[k] + i, vf_add(vf_load(position[k] + i), off));
        }
        for (int k = 0; k < 2; ++k) {
            vf_store((k ? sums.sky : sums.light) + i,
                     vf_set(0x1p-20f)); /* without a normal: open */
            vf_store((k ? sums.covered : sums.hidden) + i, vf_set(0.0f));
        }
    }
    for (int d = 0; d < lookup->count; ++d) {
        wide.count = 0;
        for (size_t i = 0; i < count; i += LANES) {
            add_directions(lookup, &lookup->pairs[d], normal, i, &sums, &wide);
        }
        for (int first = 0; first < wide.count; first += LANES) {
            add_wide(lookup, &lookup->pairs[d], &wide, first, &sums);
        }
    }
    for (size_t i = 0; i < count; i += LANES) {
        const vf share = vf_div(vf_load(sums.hidden + i), vf_load(sums.light + i));
        const vf covered = vf_div(vf_load(sums.covered + i), vf_load(sums.sky + i));
        vf_store(open[0] + i, vf_sub(vf_set(1.0f), vf_mul(vf_set(lookup->strength), share)));
        vf_store(open[1] + i, vf_sub(vf_set(1.0f), vf_mul(vf_set(lookup->strength), covered)));
    }
}

/* ---- Light that bounces ---- */

/* What arrives of uniform light after any number of reflections, less what arrives directly (Jimenez
 * et al., Practical Realtime Strategies for Accurate Indirect Occlusion, 2016): a polynomial of
 * degree 3 in the openness, its coefficients linear in the albedo. Surfaces around a point face other
 * ways, so it is a share of the mean light of all that are seen, not of the point's own. */
BURNISH_INLINE vf bounced_share(vf open, vf albedo) {
    const vf a = vf_sub(vf_mul(vf_set(2.0404f), albedo), vf_set(0.3324f));
    const vf b = vf_sub(vf_set(0.6417f), vf_mul(vf_set(4.7951f), albedo));
    const vf c = vf_add(vf_mul(vf_set(2.7552f), albedo), vf_set(0.6903f));
    const vf all = vf_mul(vf_add(vf_mul(vf_add(vf_mul(a, open), b), open), c), open);
    return vf_max(vf_sub(all, open), vf_set(0.0f));
}

static void add_bounces(const burnish_occlusion_lookup *lookup, const float albedo[3],
                        const float *const factor[3], float (*open)[BURNISH_SEEN_BATCH],
                        size_t count, float *const rgb[3]) {
    for (size_t i = 0; i < count; i += LANES) {
        const vf seen = vf_load(open[BURNISH_SEEN_LIGHT] + i);
        const vf sky = vf_load(open[BURNISH_SEEN_SKY] + i);
        for (int k = 0; k < 3; ++k) {
            const vf own = factor[k] ? vf_load(factor[k] + i) : vf_set(1.0f);
            const vf reflected = vf_mul(vf_set(albedo[k]), own);
            const int is_traced = lookup->is_traced;
            const vf share = is_traced ? vf_load(open[BURNISH_SEEN_BOUNCED + k] + i)
                                       : bounced_share(sky, reflected);
            const vf around = is_traced ? vf_set(1.0f) : vf_set(lookup->mean[k]);
            const vf direct = vf_mul(vf_load(rgb[k] + i), seen);
            vf_store(rgb[k] + i, vf_add(direct, vf_mul(vf_mul(reflected, around), share)));
        }
    }
}

/* ---- Sharing ---- */

static unsigned compare_block(const float *const position[3], const float *const normal[3],
                              const int32_t *shown, const float limits[2], unsigned *alike) {
    enum { PIXELS = 16 };
    unsigned bits = 0;
    for (int i = 0; i < PIXELS && shown; i += LANES) {
        bits |= vm_bits(vi_not_negative(vi_load(shown + i))) << i;
    }
    bits = shown ? bits : (1u << PIXELS) - 1;
    const int first = bits ? __builtin_ctz(bits) : 0;
    *alike = 0;
    for (int i = 0; i < PIXELS; i += LANES) {
        vf distance = vf_set(0.0f), cosine = vf_set(0.0f);
        for (int k = 0; k < 3; ++k) {
            const vf step = vf_sub(vf_load(position[k] + i), vf_set(position[k][first]));
            const vf product = vf_mul(vf_load(normal[k] + i), vf_set(normal[k][first]));
            distance = vf_add(distance, vf_mul(step, step));
            cosine = vf_add(cosine, product);
        }
        *alike |= vm_bits(vm_and(vf_greater(vf_set(limits[0]), distance),
                                 vf_greater(cosine, vf_set(limits[1]))))
                  << i;
    }
    return bits;
}

#endif
