/* A white room with six windows of light and six boxes, seen from 4.4 above its floor: the dimensions
 * and intensities of three.js' RoomEnvironment (examples/jsm/environments/RoomEnvironment.js), after
 * model-viewer's EnvironmentScene. Surfaces are rough dielectrics (a share of 0.04 is not diffuse),
 * lit by one point light without shadows, as there. */
#include "environment/room.h"

#include "base/numbers.h"
#include "core/vector.h"

typedef burnish_vec3 vec3;

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
static vec3 turn(const placed *p, vec3 v) {
    return (vec3){v.x * p->cosine - v.z * p->sine, v.y, v.x * p->sine + v.z * p->cosine};
}

static vec3 turn_back(const placed *p, vec3 v) {
    return (vec3){v.x * p->cosine + v.z * p->sine, v.y, v.z * p->cosine - v.x * p->sine};
}

/* The distance at which the ray from the origin enters a box, or leaves the room; 0: it misses.
 * *normal: in the axes of the box, toward the ray. */
static double meet(const placed *p, vec3 size, vec3 ray, int is_room, vec3 *normal) {
    const vec3 d = turn(p, ray);
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
static double shade(vec3 point, vec3 normal) {
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

static double radiance(const placed *places, vec3 ray) {
    vec3 normal, nearest_normal = {0, 0, 0};
    double nearest = 1e9;
    int hit = 0;
    for (int i = 0; i < BOX_COUNT; ++i) {
        const double distance = meet(&places[i], boxes[i].size, ray, i == 0, &normal);
        if (distance > 0 && distance < nearest) {
            nearest = distance;
            nearest_normal = turn_back(&places[i], normal);
            hit = i;
        }
    }
    return boxes[hit].radiance > 0 ? boxes[hit].radiance
                                   : shade(burnish_vec3_scale(ray, nearest), nearest_normal);
}

void burnish_room_fill(int width, int height, float *rgb) {
    placed places[BOX_COUNT];
    for (int i = 0; i < BOX_COUNT; ++i) {
        burnish_sincos(boxes[i].turn, &places[i].sine, &places[i].cosine);
        places[i].center = turn(&places[i], boxes[i].center);
    }
    for (int i = 0; i < 4 * width * height; ++i) { /* four rays a pixel, row by row */
        const int y = i / (2 * width), x = i % (2 * width);
        double s, c, sine, cosine;
        burnish_sincos(BURNISH_PI * (y + 0.5) / (2 * height), &s, &c);
        burnish_sincos(BURNISH_PI * (x + 0.5) / width - BURNISH_PI, &sine, &cosine);
        const float value = (float)radiance(places, (vec3){s * cosine, c, s * sine}) / 4;
        float *to = rgb + 3 * (y / 2 * width + x / 2);
        to[0] = y % 2 + x % 2 > 0 ? to[0] + value : value;
        to[1] = to[2] = to[0];
    }
}
