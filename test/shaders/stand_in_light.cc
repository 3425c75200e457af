// The lights of the shaders against the kernels. lobe/test/shaders/stand_in.sh compiles it.
#include "stand_in.h"

#include "burnish/kernels.h"

static float random_number() { return (float)std::rand() / (float)RAND_MAX * 2 - 1; }

static vector unit(vector v) { return v * burnishInverseSqrt(burnishDot(v, v)); }

// The kernels' colours with red diffuse and green specular light are the weights.
static void check_light(int phong, int point, int order) {
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    const vector raw(random_number() * 3, random_number() * 3, random_number() * 3);
    const vector light = point ? raw : unit(raw), eye(random_number(), random_number(), 4);
    const float black[3] = {0, 0, 0}, red[3] = {1, 0, 0}, green[3] = {0, 1, 0};
    std::memcpy(lighting.material.ambient, black, sizeof black);
    std::memcpy(lighting.material.diffuse, red, sizeof red);
    std::memcpy(lighting.material.specular, green, sizeof green);
    lighting.material.exponent = 40;
    lighting.lobe.order = order;
    lighting.specular_model = phong ? BURNISH_SPECULAR_PHONG : BURNISH_SPECULAR_BLINN;
    lighting.local_viewer = 1;
    lighting.lights[0].kind = point ? BURNISH_LIGHT_POINT : BURNISH_LIGHT_DIRECTIONAL;
    for (int k = 0; k < 3; ++k) {
        lighting.viewer[k] = eye[k];
        lighting.lights[0].vector[k] = (double)light[k];
    }
    burnish_kernels_shader *shader = nullptr;
    burnish_error error;
    if (burnish_kernels_shader_create(&lighting, nullptr, &shader, &error) != BURNISH_STATUS_OK) {
        check(false, error.text, 0, 0);
        return;
    }
    const float zeta = (float)solve(BURNISH_FIT_ENERGY, order, 40, 0);
    for (int i = 0; i < 200; ++i) {
        const vector N(random_number() * 2, random_number() * 2, random_number() * 2);
        const vector P(random_number(), random_number(), random_number());
        const vector V = unit(eye - P), L = point ? light - P : light;
        const auto weights = phong ? burnishLitPhong(N, L, V, zeta, order)
                             : point ? burnishLitPoint(N, L, V, zeta, order)
                                     : burnishLit(N, L, V, zeta, order);
        const float n[3] = {N[0], N[1], N[2]}, p[3] = {P[0], P[1], P[2]};
        float color[3];
        float *out[3] = {&color[0], &color[1], &color[2]};
        burnish_kernels_points points = {};
        for (int k = 0; k < 3; ++k) {
            points.normal[k] = &n[k];
            points.position[k] = &p[k];
        }
        burnish_kernels_shade_float(burnish_kernels_best(), shader, &points, 1, out, nullptr);
#ifdef OSL
        check(std::fabs(weights[0] - color[0]) < 1e-6f, "N.L", (double)weights[0], (double)color[0]);
        check(std::fabs(weights[1] - color[1]) < 1e-4f, "highlight", (double)weights[1], (double)color[1]);
#else
        const float diffuse = weights.x, specular = weights.y;
        check(same_bits(diffuse, color[0]), "N.L", (double)diffuse, (double)color[0]);
        check(same_bits(specular, color[1]), "highlight", (double)specular, (double)color[1]);
#endif
    }
    burnish_kernels_shader_destroy(shader);
}

int main(int, char **arguments) {
    for (int order = 2; order <= 32; order *= 2) {
        for (int i = 0; i < 20; ++i) {
            check_light(0, 0, order);
            check_light(1, 0, order);
            check_light(0, 1, order);
        }
    }
    std::printf("%s: %d checks, %d failed\n", arguments[0], checks, failures);
    return checks == 0 || failures != 0;
}
