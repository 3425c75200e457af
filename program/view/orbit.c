#include "view/orbit.h"

#include <math.h>
#include <string.h>

#include "base/cli/values.h"

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double result[3]) {
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3, last = (k + 2) % 3;
        result[k] = a[next] * b[last] - a[last] * b[next];
    }
}

static double normalize(double v[3]) {
    const double length = sqrt(dot(v, v));
    for (int k = 0; k < 3 && length > 0; ++k) {
        v[k] /= length;
    }
    return length;
}

/* The unit vector from the focal point to the camera; returns the distance. */
static double backward(const burnish_camera *camera, double direction[3]) {
    for (int k = 0; k < 3; ++k) {
        direction[k] = camera->position[k] - camera->focal_point[k];
    }
    return normalize(direction);
}

/* The part of v that is perpendicular to the unit vector n. */
static void flatten(const double v[3], const double n[3], double result[3]) {
    const double along = dot(v, n);
    for (int k = 0; k < 3; ++k) {
        result[k] = v[k] - along * n[k];
    }
}

/* The height of the picture at the focal point. */
static double height(const burnish_camera *camera) {
    double direction[3];
    return camera->orthographic_height > 0
               ? camera->orthographic_height
               : 2 * backward(camera, direction) * tan(camera->view_angle / 2 * CLI_DEGREE);
}

void view_orbit(burnish_camera *camera, const double up[3], double azimuth, double elevation) {
    double direction[3], level[3], side[3];
    const double distance = backward(camera, direction);
    const double rise = fmin(fmax(dot(direction, up), -1), 1);
    flatten(direction, up, level);
    if (normalize(level) < 1e-6) { /* straight above: the picture's up direction is backward */
        flatten(camera->view_up, up, level);
        normalize(level);
        for (int k = 0; k < 3; ++k) {
            level[k] = rise > 0 ? -level[k] : level[k];
        }
    }
    cross(up, level, side);
    const double turn = azimuth * CLI_DEGREE, quarter = 90 * CLI_DEGREE;
    const double lift = fmin(fmax(asin(rise) + elevation * CLI_DEGREE, -quarter), quarter);
    for (int k = 0; k < 3; ++k) {
        const double turned = cos(turn) * level[k] + sin(turn) * side[k];
        camera->position[k] =
            camera->focal_point[k] + distance * (cos(lift) * turned + sin(lift) * up[k]);
        camera->view_up[k] = cos(lift) * up[k] - sin(lift) * turned;
    }
}

void view_pan(burnish_camera *camera, double right, double upward) {
    double direction[3], above[3], side[3];
    const double scale = height(camera);
    backward(camera, direction);
    flatten(camera->view_up, direction, above);
    normalize(above);
    cross(above, direction, side);
    for (int k = 0; k < 3; ++k) {
        const double step = scale * (right * side[k] + upward * above[k]);
        camera->position[k] += step;
        camera->focal_point[k] += step;
    }
}

void view_zoom(burnish_camera *camera, double factor, double x, double y) {
    view_pan(camera, x * (1 - 1 / factor), y * (1 - 1 / factor));
    if (camera->orthographic_height > 0) {
        camera->orthographic_height /= factor;
        return;
    }
    for (int k = 0; k < 3; ++k) {
        camera->position[k] =
            camera->focal_point[k] + (camera->position[k] - camera->focal_point[k]) / factor;
    }
}

void view_change_projection(burnish_camera *camera, double radius) {
    double direction[3];
    const double scale = height(camera), was = backward(camera, direction);
    const int is_parallel = camera->orthographic_height > 0;
    const double distance = is_parallel ? scale / (2 * tan(camera->view_angle / 2 * CLI_DEGREE))
                                        : fmax(was, 2 * radius);
    for (int k = 0; k < 3; ++k) {
        camera->position[k] = camera->focal_point[k] + distance * direction[k];
    }
    camera->orthographic_height = is_parallel ? 0 : scale;
}
