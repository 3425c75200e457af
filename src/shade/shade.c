/* The Phong equation for a block of visible points, one light after another in the lights' order.
 */
#include "shade/shade.h"

#include "shade/interpolate.h"

/* One component of a vector a point. */
typedef float component[BURNISH_FRAGMENT_BLOCK];

/* Vectors of a block that every light needs. */
typedef struct block_vectors {
    component offset[3]; /* from the eye to the point, times q */
    component q;
    component to_viewer[3]; /* V */
    component n_dot_v;      /* Phong only */
} block_vectors;

/* Scratch for one light. */
typedef struct light_vectors {
    component to_light[3]; /* L */
    component half[3];     /* H */
    component n_dot_l, l_dot_v, cosine, lobe;
} light_vectors;

static void locate(const burnish_shade_view *view, const burnish_fragments *fragments,
                   block_vectors *block) {
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < fragments->count; ++i) {
            block->offset[axis][i] = ((view->ray[axis] + fragments->x[i] * view->ray_x[axis]) +
                                      fragments->y[i] * view->ray_y[axis]) +
                                     (1.0f - fragments->depth[i]) * view->ray_depth[axis];
        }
    }
    for (int i = 0; i < fragments->count; ++i) {
        block->q[i] = fragments->depth[i] * view->q_per_depth + view->q_constant;
    }
}

static void find_viewer(const burnish_shade_view *view, size_t count, block_vectors *block) {
    for (int axis = 0; axis < 3; ++axis) {
        for (size_t i = 0; i < count; ++i) {
            block->to_viewer[axis][i] =
                view->local_viewer ? -block->offset[axis][i] : view->to_viewer[axis];
        }
    }
    if (view->local_viewer) {
        burnish_kernel_normalize(count, block->to_viewer[0], block->to_viewer[1],
                                 block->to_viewer[2], NULL);
    }
}

static void find_light(const burnish_shade_light *light, const burnish_points *points,
                       const block_vectors *block, light_vectors *vectors) {
    size_t count = (size_t)points->count;
    for (int axis = 0; axis < 3; ++axis) {
        for (size_t i = 0; i < count; ++i) {
            vectors->to_light[axis][i] =
                light->point ? light->vector[axis] * block->q[i] - block->offset[axis][i]
                             : light->vector[axis];
        }
    }
    if (light->point) {
        burnish_kernel_normalize(count, vectors->to_light[0], vectors->to_light[1],
                                 vectors->to_light[2], NULL);
    }
    burnish_kernel_dot(count, points->normal[0], points->normal[1], points->normal[2],
                       vectors->to_light[0], vectors->to_light[1], vectors->to_light[2],
                       vectors->n_dot_l);
}

/* Cosines of the specular lobe: N.H or R.V. */
static void find_cosine(const burnish_shade_view *view, const burnish_shade_light *light,
                        const burnish_points *points, const block_vectors *block,
                        light_vectors *vectors) {
    size_t count = (size_t)points->count;
    if (view->phong) {
        burnish_kernel_dot(count, vectors->to_light[0], vectors->to_light[1], vectors->to_light[2],
                           block->to_viewer[0], block->to_viewer[1], block->to_viewer[2],
                           vectors->l_dot_v);
        burnish_kernel_reflect(count, vectors->n_dot_l, block->n_dot_v, vectors->l_dot_v,
                               vectors->cosine);
        return;
    }
    if (!light->point && !view->local_viewer) {
        burnish_kernel_dot_uniform(count, points->normal[0], points->normal[1], points->normal[2],
                                   light->half, vectors->cosine);
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (size_t i = 0; i < count; ++i) {
            vectors->half[axis][i] = vectors->to_light[axis][i] + block->to_viewer[axis][i];
        }
    }
    burnish_kernel_normalize(count, vectors->half[0], vectors->half[1], vectors->half[2], NULL);
    burnish_kernel_dot(count, points->normal[0], points->normal[1], points->normal[2],
                       vectors->half[0], vectors->half[1], vectors->half[2], vectors->cosine);
}

/* Lyon's lobe: the normal of length s is scaled by three terms of 1/s instead of the exact root;
 * what is left of the length, g, shows in the chord: lambda = (g^2 + 1)/2 - g c. */
static void lyon_lobe(burnish_lobe lobe, size_t count, const float *lengths, const float *cosines,
                      float *values) {
    for (size_t i = 0; i < count; ++i) {
        float g = lengths[i] * burnish_lyon_normalize_factor(lengths[i] * lengths[i]);
        values[i] = (g * g + 1.0f) * 0.5f - g * cosines[i];
    }
    burnish_kernel_lobe_lambda(lobe, count, values, values);
}

/* Lights the points [first, end), which share a material. */
static void light_run(const burnish_shade_material *material, const burnish_shade_light *light,
                      const burnish_points *points, int first, int end, light_vectors *vectors,
                      burnish_shaded *shaded) {
    size_t count = (size_t)(end - first);
    float *lobe = vectors->lobe + first;
    if (material->lyon) {
        lyon_lobe(material->lobe.family, count, points->length + first, vectors->cosine + first,
                  lobe);
    } else {
        burnish_kernel_lobe(&material->lobe, count, vectors->cosine + first, lobe);
    }
    for (int channel = 0; channel < 3; ++channel) {
        burnish_kernel_accumulate(count, light->color[channel], points->diffuse[channel] + first,
                                  material->specular[channel], vectors->n_dot_l + first, lobe,
                                  shaded->channel[channel] + first);
    }
}

static int run_end(const burnish_points *points, int first) {
    int end = first + 1;
    while (end < points->count && points->material[end] == points->material[first]) {
        ++end;
    }
    return end;
}

/* The ambient term, and the vertex colours times the material's. */
static void begin_run(const burnish_shade_material *material, int first, int end,
                      burnish_points *points, burnish_shaded *shaded) {
    for (int channel = 0; channel < 3; ++channel) {
        for (int i = first; i < end; ++i) {
            shaded->channel[channel][i] = material->ambient[channel] * points->diffuse[channel][i];
            points->diffuse[channel][i] *= material->diffuse[channel];
        }
    }
}

void burnish_shade(const burnish_shader *shader, const burnish_fragments *fragments,
                   burnish_shaded *shaded) {
    burnish_points points;
    block_vectors block;
    light_vectors vectors;
    const burnish_shade_view *view = &shader->view;
    size_t count = (size_t)fragments->count;
    burnish_interpolate(shader, fragments, &points);
    locate(view, fragments, &block);
    find_viewer(view, count, &block);
    if (view->phong) {
        burnish_kernel_dot(count, points.normal[0], points.normal[1], points.normal[2],
                           block.to_viewer[0], block.to_viewer[1], block.to_viewer[2],
                           block.n_dot_v);
    }
    for (int first = 0; first < points.count; first = run_end(&points, first)) {
        begin_run(&shader->materials[points.material[first]], first, run_end(&points, first),
                  &points, shaded);
    }
    for (int i = 0; i < shader->light_count; ++i) {
        const burnish_shade_light *light = &shader->lights[i];
        find_light(light, &points, &block, &vectors);
        find_cosine(view, light, &points, &block, &vectors);
        for (int first = 0; first < points.count; first = run_end(&points, first)) {
            light_run(&shader->materials[points.material[first]], light, &points, first,
                      run_end(&points, first), &vectors, shaded);
        }
    }
}
