/* A glTF animation at a given time: the poses of nodes from its channels. Nodes without a channel
 * keep their pose from the file. */
#include "mesh/read/gltf/gltf.h"

#include "base/elementary.h"

/* A channel's keyframes around the requested time. */
typedef struct gltf_keys {
    const burnish_gltf_accessor *values;
    size_t before, after; /* keyframes */
    double share;         /* of the way from before to after, [0, 1] */
    double step;          /* seconds between them */
    int is_cubic;
} gltf_keys;

enum { ROTATION_WIDTH = 4, WEIGHTS_MAX = 1 << 22 /* of all nodes together */ };

/* ---- Which animation ---- */

/* The animation that the options name, by name or by number from 0; NONE, after a line, if there
 * is none. */
static uint32_t find_animation(burnish_gltf *gltf) {
    const burnish_load_options *options = gltf->reader->input->options;
    const size_t count = gltf->counts[BURNISH_GLTF_ANIMATIONS];
    const uint32_t *values = gltf->lists[BURNISH_GLTF_ANIMATIONS];
    if (count == 0) {
        burnish_reader_warn(gltf->reader, NULL, "has no animation; it is drawn at rest");
        return BURNISH_GLTF_NONE;
    }
    if (!options->animation) {
        return values[0];
    }
    for (size_t i = 0; i < count; ++i) {
        const uint32_t name = burnish_json_member(&gltf->json, values[i], "name");
        if (burnish_json_is_text(&gltf->json, name, options->animation)) {
            return values[i];
        }
    }
    const burnish_token token = {(const uint8_t *)options->animation, strlen(options->animation)};
    int64_t number;
    if (burnish_parse_integer(token, &number) == BURNISH_NUMBER_OK && number >= 0 &&
        (uint64_t)number < count) {
        return values[number];
    }
    burnish_gltf_fail(gltf, BURNISH_STATUS_ARGUMENT, BURNISH_JSON_NONE,
                      "animation \"%s\" does not exist; give a name or a number from 0 to %zu",
                      burnish_token_quote(token).text, count - 1);
    return BURNISH_GLTF_NONE;
}

/* ---- Keyframes ---- */

/* Finds the keyframes around a time; before the first and after the last, that one. */
static int find_keys(burnish_gltf *gltf, uint32_t sampler, unsigned widths, gltf_keys *keys) {
    const double asked = gltf->reader->input->options->animation_time, time = asked > 0 ? asked : 0;
    const uint32_t input = burnish_gltf_reference(gltf, sampler, "input", BURNISH_GLTF_ACCESSORS);
    const uint32_t output = burnish_gltf_reference(gltf, sampler, "output", BURNISH_GLTF_ACCESSORS);
    const uint32_t kind = burnish_json_member(&gltf->json, sampler, "interpolation");
    if (input == BURNISH_GLTF_NONE || output == BURNISH_GLTF_NONE) {
        return burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, sampler, "needs input and output");
    }
    const burnish_gltf_accessor *times = burnish_gltf_resolve(gltf, input, sampler, 1u << 1);
    keys->values = times ? burnish_gltf_resolve(gltf, output, sampler, widths) : NULL;
    if (!keys->values) {
        return 0;
    }
    double start, end = 0, *longest = &gltf->reader->mesh->animation_seconds;
    size_t first = 0, last = times->count - 1;
    burnish_gltf_element(times, last, &end);
    *longest = end > *longest && end <= 1e9 ? end : *longest;
    while (last - first > 1) { /* the last keyframe that is not after the time */
        const size_t middle = first + (last - first) / 2;
        burnish_gltf_element(times, middle, &start);
        *(start <= time ? &first : &last) = middle;
    }
    burnish_gltf_element(times, first, &start);
    burnish_gltf_element(times, last, &end);
    keys->before = time >= end ? last : first;
    keys->after = time <= start ? first : last;
    keys->step = end - start;
    keys->share =
        keys->before == keys->after || !(keys->step > 0) ? 0 : (time - start) / keys->step;
    keys->is_cubic = burnish_json_is_text(&gltf->json, kind, "CUBICSPLINE");
    if (burnish_json_is_text(&gltf->json, kind, "STEP")) {
        keys->share = 0;
    }
    return 1;
}

/* The four weights of a cubic Hermite spline: value and out-tangent before, in-tangent and value
 * after. Source: the specification's appendix C. */
static void hermite_weights(double t, double step, double weights[4]) {
    const double t2 = t * t, t3 = t2 * t;
    weights[0] = 2 * t3 - 3 * t2 + 1;
    weights[1] = step * (t3 - 2 * t2 + t);
    weights[2] = step * (t3 - t2);
    weights[3] = 3 * t2 - 2 * t3;
}

/* Element `item` of each keyframe, which has `items` of them, at the time. */
static int sample_channel(burnish_gltf *gltf, const gltf_keys *keys, size_t items, size_t item,
                          double *value) {
    const size_t per_key = items * (keys->is_cubic ? 3 : 1);
    const size_t before = keys->before * per_key, after = keys->after * per_key;
    double a[16], b[16], tangents[2][16];
    if ((before > after ? before : after) + per_key > keys->values->count) {
        return burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, keys->values->value,
                                 "%zu values are too few for its keyframes", keys->values->count);
    }
    const size_t at = keys->is_cubic ? items + item : item;
    burnish_gltf_element(keys->values, before + at, a);
    burnish_gltf_element(keys->values, after + at, b);
    if (!keys->is_cubic) {
        for (int k = 0; k < keys->values->width; ++k) {
            value[k] = a[k] + (b[k] - a[k]) * keys->share;
        }
        return 1;
    }
    double weights[4];
    hermite_weights(keys->share, keys->step, weights);
    burnish_gltf_element(keys->values, before + 2 * items + item, tangents[0]);
    burnish_gltf_element(keys->values, after + item, tangents[1]);
    for (int k = 0; k < keys->values->width; ++k) {
        value[k] = weights[0] * a[k] + weights[1] * tangents[0][k] + weights[2] * tangents[1][k] +
                   weights[3] * b[k];
    }
    return 1;
}

/* Linear keyframes of a rotation turn at a constant rate, the shorter way (slerp). If they are
 * almost equal, linear interpolation is enough. */
static int sample_rotation(burnish_gltf *gltf, const gltf_keys *keys, double rotation[4]) {
    double a[4], b[4], cosine = 0;
    if (!sample_channel(gltf, keys, 1, 0, rotation)) {
        return 0;
    }
    if (keys->is_cubic || keys->share == 0) {
        return 1;
    }
    burnish_gltf_element(keys->values, keys->before, a);
    burnish_gltf_element(keys->values, keys->after, b);
    for (int k = 0; k < ROTATION_WIDTH; ++k) {
        cosine += a[k] * b[k];
    }
    const double sign = cosine < 0 ? -1 : 1, angle = burnish_acos(sign * cosine);
    double from = 1 - keys->share, to = keys->share, sine, unused;
    if (angle > 1e-3) {
        burnish_sincos(from * angle, &from, &unused);
        burnish_sincos(to * angle, &to, &unused);
        burnish_sincos(angle, &sine, &unused);
        from /= sine;
        to /= sine;
    }
    for (int k = 0; k < ROTATION_WIDTH; ++k) {
        rotation[k] = from * a[k] + sign * to * b[k];
    }
    return 1;
}

/* ---- Channels ---- */

/* Weights of the morph targets: as many elements per keyframe as the mesh has targets. */
static void sample_weights(burnish_gltf *gltf, const gltf_keys *keys, burnish_gltf_node *node) {
    const size_t count =
        node->mesh == BURNISH_GLTF_NONE ? 0 : burnish_gltf_target_count(gltf, node->mesh);
    const size_t first = gltf->weight_count;
    if (count > WEIGHTS_MAX - first) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_LIMIT, keys->values->value,
                          "more than %d weights of morph targets; remove some", WEIGHTS_MAX);
        return;
    }
    gltf->weights = burnish_reserve(gltf->memory, gltf->weights, &gltf->weight_capacity,
                                    first + count, sizeof *gltf->weights, "weights");
    if (!burnish_gltf_is_fine(gltf)) {
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        if (!sample_channel(gltf, keys, count, i, &gltf->weights[first + i])) {
            return;
        }
    }
    gltf->weight_count += count;
    node->first_weight = first;
    node->weight_count = count;
}

static void apply_channel(burnish_gltf *gltf, uint32_t channel, const uint32_t *samplers,
                          size_t sampler_count) {
    const uint32_t target = burnish_gltf_object(gltf, channel, "target");
    const uint32_t path = burnish_json_member(&gltf->json, target, "path");
    const uint32_t number = burnish_gltf_reference(gltf, target, "node", BURNISH_GLTF_NODES);
    const size_t sampler = (size_t)burnish_gltf_whole(gltf, channel, "sampler",
                                                      BURNISH_GLTF_LIST_MAX, BURNISH_GLTF_LIST_MAX);
    if (number == BURNISH_GLTF_NONE || gltf->status != BURNISH_STATUS_OK) {
        return;
    }
    if (sampler >= sampler_count) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, channel,
                          "its sampler is not one of the animation's %zu", sampler_count);
        return;
    }
    burnish_gltf_node *node = &gltf->nodes[number];
    burnish_gltf_pose *pose = &gltf->poses[number];
    gltf_keys keys;
    if (burnish_json_is_text(&gltf->json, path, "translation")) {
        pose->has_translation = find_keys(gltf, samplers[sampler], 1u << 3, &keys) &&
                                sample_channel(gltf, &keys, 1, 0, pose->translation);
    } else if (burnish_json_is_text(&gltf->json, path, "scale")) {
        pose->has_scale = find_keys(gltf, samplers[sampler], 1u << 3, &keys) &&
                          sample_channel(gltf, &keys, 1, 0, pose->scale);
    } else if (burnish_json_is_text(&gltf->json, path, "rotation")) {
        pose->has_rotation = find_keys(gltf, samplers[sampler], 1u << 4, &keys) &&
                             sample_rotation(gltf, &keys, pose->rotation);
    } else if (burnish_json_is_text(&gltf->json, path, "weights") &&
               find_keys(gltf, samplers[sampler], 1u << 1, &keys)) {
        sample_weights(gltf, &keys, node);
    }
}

void burnish_gltf_animate(burnish_gltf *gltf) {
    const burnish_load_options *options = gltf->reader->input->options;
    if (options->animation_time == BURNISH_AT_REST && !options->animation) {
        return;
    }
    const uint32_t animation = find_animation(gltf);
    if (animation == BURNISH_GLTF_NONE) {
        return;
    }
    gltf->poses = burnish_allocate_zeroed(gltf->memory, gltf->counts[BURNISH_GLTF_NODES],
                                          sizeof *gltf->poses, "an animation");
    const uint32_t channels = burnish_gltf_array(gltf, animation, "channels");
    size_t count;
    uint32_t *samplers =
        burnish_gltf_items(gltf, burnish_gltf_array(gltf, animation, "samplers"), &count);
    uint32_t channel = channels + 1;
    for (size_t i = burnish_json_length(&gltf->json, channels); i > 0 && burnish_gltf_is_fine(gltf);
         --i) {
        apply_channel(gltf, channel, samplers, count);
        channel = gltf->json.nodes[channel].next;
    }
    burnish_release(gltf->memory->context, samplers);
}
