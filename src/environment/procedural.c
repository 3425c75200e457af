/* The environments "room" and "sky".
 *
 * The room is white, with six windows of light and six boxes, seen from 4.4 above its floor: the
 * dimensions and intensities of three.js' RoomEnvironment
 * (examples/jsm/environments/RoomEnvironment.js), after model-viewer's EnvironmentScene. Surfaces
 * are rough dielectrics (a share of 0.04 is not diffuse), lit by one point light without shadows, as
 * there. */
#include "environment/environment.h"

#include "base/numbers.h"
#include "core/vec3.h"

typedef burnish_vec3 vec3;

/* ---- Room ---- */

static const struct box {
    vec3 center, size;
    double turn;     /* about y, radians */
    double radiance; /* 0: a white surface */
} boxes[] = {
    {{-0.757, 9.719, 0.717}, {31.713, 28.305, 28.591}, 0, 0}, /* the room, seen from inside */
    {{-10.906, -1.491, 1.846}, {2.328, 7.905, 4.651}, -0.195, 0},
    {{-5.607, -4.254, -0.758}, {1.970, 1.534, 3.955}, 0.994, 0},
    {{6.167, -2.643, 7.803}, {3.927, 6.285, 3.687}, 0.561, 0},
    {{-2.017, -3.482, 6.124}, {2.002, 4.566, 2.064}, 0.333, 0},
    {{2.291, -4.256, -2.621}, {1.546, 1.552, 1.496}, -0.286, 0},
    {{-2.193, -3.869, -5.547}, {3.875, 3.487, 2.986}, 0.516, 0},
    {{-16.116, 10.87, 8.208}, {0.1, 2.428, 2.739}, 0, 50},
    {{-16.109, 14.521, -8.207}, {0.1, 2.425, 2.751}, 0, 50},
    {{14.904, 8.698, -1.832}, {0.15, 4.265, 6.331}, 0, 17},
    {{-0.462, 5.39, 14.520}, {4.38, 5.441, 0.088}, 0, 43},
    {{3.235, 7.986, -12.541}, {2.5, 2.0, 0.1}, 0, 20},
    {{0, 16.5, 0}, {1, 0.1, 1}, 0, 100},
};
enum { BOX_COUNT = sizeof boxes / sizeof *boxes };

static const vec3 lamp = {0.418, 12.699, 0.300};
static const double lamp_intensity = 900; /* candela */
static const double lamp_reach = 28;      /* where its light ends */

/* A box, with its turn worked out. */
typedef struct placed {
    double sine, cosine;
    vec3 center; /* in its own axes */
} placed;

/* Into the axes of a box. */
static vec3 turn_into_box(const placed *p, vec3 v) {
    return (vec3){v.x * p->cosine - v.z * p->sine, v.y, v.x * p->sine + v.z * p->cosine};
}

static vec3 turn_back(const placed *p, vec3 v) {
    return (vec3){v.x * p->cosine + v.z * p->sine, v.y, v.z * p->cosine - v.x * p->sine};
}

/* The distance at which the ray from the origin enters a box, or leaves the room; 0: it misses.
 * *normal: in the axes of the box, toward the ray. */
static double meet_box(const placed *p, vec3 size, vec3 ray, int is_room, vec3 *normal) {
    const vec3 d = turn_into_box(p, ray);
    const double from[3] = {p->center.x, p->center.y, p->center.z}, along[3] = {d.x, d.y, d.z};
    const double half[3] = {size.x / 2, size.y / 2, size.z / 2};
    double enter = 0, leave = 1e9;
    int enter_axis = 0, leave_axis = 0;
    for (int k = 0; k < 3; ++k) {
        const double speed = along[k] < 0 ? -along[k] : along[k];
        const double middle = along[k] < 0 ? -from[k] : from[k];
        if (speed < 1e-12) {
            if (middle > half[k] || middle < -half[k]) {
                return 0;
            }
            continue;
        }
        const double near = (middle - half[k]) / speed, far = (middle + half[k]) / speed;
        enter_axis = near > enter ? k : enter_axis;
        enter = near > enter ? near : enter;
        leave_axis = far < leave ? k : leave_axis;
        leave = far < leave ? far : leave;
    }
    const int axis = is_room ? leave_axis : enter_axis;
    const double sign = along[axis] > 0 ? -1 : 1;
    *normal = (vec3){axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
    return enter < leave ? (is_room ? leave : enter) : 0;
}

/* Radiance of a white surface at a point toward the origin: Lambert's, and GGX of alpha 1. */
static double shade_white(vec3 point, vec3 normal) {
    const vec3 toward = burnish_vec3_sub(lamp, point), light = burnish_vec3_normalize(toward);
    const vec3 viewer = burnish_vec3_normalize(burnish_vec3_scale(point, -1));
    const vec3 half = burnish_vec3_normalize(burnish_vec3_add(light, viewer));
    const double n_l = burnish_vec3_dot(normal, light), n_v = burnish_vec3_dot(normal, viewer);
    if (n_l <= 0) {
        return 0;
    }
    const double miss = 1 - burnish_vec3_dot(viewer, half), squared = miss * miss;
    const double fresnel = 0.04 + 0.96 * squared * squared * miss;
    const double specular = fresnel * 0.5 / (n_l + (n_v > 0 ? n_v : 0));
    const double distance = burnish_vec3_dot(toward, toward); /* squared */
    const double share = distance / (lamp_reach * lamp_reach), end = 1 - share * share;
    const double window = end > 0 ? end * end : 0;
    return lamp_intensity * window * n_l * (0.96 + specular) / BURNISH_PI / distance;
}

static double room_radiance(const placed *places, vec3 ray) {
    vec3 normal, nearest_normal = {0, 0, 0};
    double nearest = 1e9;
    int hit = 0;
    for (int i = 0; i < BOX_COUNT; ++i) {
        const double distance = meet_box(&places[i], boxes[i].size, ray, i == 0, &normal);
        if (distance > 0 && distance < nearest) {
            nearest = distance;
            nearest_normal = turn_back(&places[i], normal);
            hit = i;
        }
    }
    return boxes[hit].radiance > 0 ? boxes[hit].radiance
                                   : shade_white(burnish_vec3_scale(ray, nearest), nearest_normal);
}

void burnish_room_fill(int width, int height, float *rgb) {
    placed places[BOX_COUNT];
    for (int i = 0; i < BOX_COUNT; ++i) {
        burnish_sincos(boxes[i].turn, &places[i].sine, &places[i].cosine);
        places[i].center = turn_into_box(&places[i], boxes[i].center);
    }
    for (int i = 0; i < 4 * width * height; ++i) { /* four rays a pixel, row by row */
        const int y = i / (2 * width), x = i % (2 * width);
        double s, c, sine, cosine;
        burnish_sincos(BURNISH_PI * (y + 0.5) / (2 * height), &s, &c);
        burnish_sincos(BURNISH_PI * (x + 0.5) / width - BURNISH_PI, &sine, &cosine);
        const float value = (float)room_radiance(places, (vec3){s * cosine, c, s * sine}) / 4;
        float *to = rgb + 3 * (y / 2 * width + x / 2);
        to[0] = y % 2 + x % 2 > 0 ? to[0] + value : value;
        to[1] = to[2] = to[0];
    }
}

/* ---- Sky ---- */

/* A clear sky with the sun 40 degrees above the horizon, over grey ground. Luminance: the CIE
 * standard clear sky (CIE S 011, type 12); the colours are chosen by eye. The sun is a lobe of 1.4
 * degrees. Sky and sun light a white horizontal surface to 1. */
static const vec3 sun = {-0.4596267, 0.6427876, 0.6128356};
static const double sun_share = 0.55;    /* of the light on a horizontal surface */
static const double sun_zeta = 400;      /* of its lobe, order 8 */
static const double ground_share = 0.22; /* reflected */

/* Linear colours. */
static const vec3 zenith_color = {0.26, 0.48, 1.0}, horizon_color = {0.74, 0.86, 1.0};
static const vec3 sun_color = {1.0, 0.93, 0.82}, ground_color = {1.0, 0.95, 0.87};

static vec3 of_luminance(vec3 color, double luminance) {
    const double own = 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
    return burnish_vec3_scale(color, luminance / own);
}

static vec3 mix_colors(vec3 a, vec3 b, double share) {
    return burnish_vec3_add(burnish_vec3_scale(a, 1 - share), burnish_vec3_scale(b, share));
}

static double exponential_of(double x) {
    return burnish_expm1(x) + 1;
}

/* The sky in a direction above the horizon, in any unit. */
static vec3 sky_color(vec3 w) {
    const double a = -1, b = -0.32, c = 10, d = -3, e = 0.45;
    const double height = w.y > 0.005 ? w.y : 0.005, cosine = burnish_vec3_dot(w, sun);
    const double gradation = 1 + a * exponential_of(b / height);
    const double scattered =
        c * (exponential_of(d * burnish_acos(cosine)) - exponential_of(d * BURNISH_PI / 2));
    const double low = 1 - height, glow = scattered / c;
    const vec3 color = mix_colors(zenith_color, horizon_color, low * low * low);
    return of_luminance(mix_colors(color, sun_color, glow > 0 ? glow : 0),
                        gradation * (1 + scattered + e * cosine * cosine));
}

static double sun_lobe(vec3 w) {
    double u = 1 + sun_zeta * (burnish_vec3_dot(w, sun) - 1);
    u = u > 0 ? u * u : 0;
    return u * u * u * u;
}

static vec3 texel_direction(int x, int y, int width, int height) {
    double s, c, sine, cosine;
    burnish_sincos(BURNISH_PI * (y + 0.5) / height, &s, &c);
    burnish_sincos(2 * BURNISH_PI * (x + 0.5) / width - BURNISH_PI, &sine, &cosine);
    return (vec3){s * cosine, c, s * sine};
}

void burnish_sky_fill(int width, int height, float *rgb) {
    /* the sky's luminance on a horizontal surface, over pi; the lobe's integral is exact */
    double light = 0;
    for (int y = 0; y < height / 2; ++y) {
        for (int x = 0; x < width; x += 8) {
            const vec3 w = texel_direction(x, y, width, height), color = sky_color(w);
            const double area =
                2 * BURNISH_PI * BURNISH_PI * 8 / width / height * __builtin_sqrt(1 - w.y * w.y);
            light += (0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z) * w.y * area;
        }
    }
    const double sky_scale = (1 - sun_share) * BURNISH_PI / light;
    const vec3 sun_radiance =
        of_luminance(sun_color, sun_share * sun_zeta * 9 / (2 * sun.y)); /* E = 2 pi / (9 zeta) */
    const vec3 ground = of_luminance(ground_color, ground_share);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x, rgb += 3) {
            const vec3 w = texel_direction(x, y, width, height);
            const vec3 above = burnish_vec3_add(burnish_vec3_scale(sky_color(w), sky_scale),
                                                burnish_vec3_scale(sun_radiance, sun_lobe(w)));
            const vec3 color = w.y > 0 ? above : ground;
            rgb[0] = (float)color.x;
            rgb[1] = (float)color.y;
            rgb[2] = (float)color.z;
        }
    }
}
