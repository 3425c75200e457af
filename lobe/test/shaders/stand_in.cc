// The shaders against burnish/lobe.h and theory.h. Usage: stand_in LOBES_CSV AREA_CSV
#include "stand_in.h"

#ifdef GLSL
#include "half.h"
// after it, which has float16_t
#include "half.glsl"
#endif

// The number of a lobe in values.glsl, from its order; -1: unknown.
static int number_of(int order) {
    for (int number = 0; number < 5; ++number) {
        if (order == 2 << number) {
            return number;
        }
    }
    return -1;
}

static void check_vector_line(char *line) {
    char *fields[7];
    int count = 0;
    for (char *at = line; at && count < 7; ++count) {
        fields[count] = at;
        at = std::strchr(at, ',');
        if (at) {
            *at++ = 0;
        }
    }
    if (count < 7) {
        return;
    }
    const float n = std::strtof(fields[3], nullptr), cosine = std::strtof(fields[4], nullptr);
    const float zeta = std::strtof(fields[5], nullptr);
    const double value = std::strtod(fields[6], nullptr);
    if (std::strcmp(fields[0], "family") == 0) {
        burnish_lobe lobe;
        burnish_lobe_from_zeta(&lobe, zeta, std::atoi(fields[1]));
        const float expected = burnish_lobe_at_cosine(lobe, cosine);
        const float actual = lobeByNumber(number_of(lobe.order), cosine, zeta, n);
        check(same_bits(actual, expected), line, (double)actual, (double)expected);
    } else if (std::strcmp(fields[0], "schlick") == 0) {
        const float expected = burnish_schlick_at_cosine(cosine, n);
        const float actual = lobeByNumber(5, cosine, zeta, n);
        check(same_bits(actual, expected), line, (double)actual, (double)expected);
    } else if (std::strcmp(fields[0], "power") == 0) {
        check(std::fabs((double)lobeByNumber(6, cosine, zeta, n) - value) < 1e-6, line, (double)n, value);
    }
}

static void check_vectors(const char *path) {
    char line[512];
    std::FILE *file = std::fopen(path, "r");
    while (file && std::fgets(line, sizeof line, file)) {
        check_vector_line(line);
    }
    check(file != nullptr && checks > 200, path, checks, 201);
    if (file) {
        std::fclose(file);
    }
}

// The cost of the straight line for the slope: largest error against cos^n, compared with the optimum.
static void check_minimax(int order, double n) {
    burnish_theory_model best, line;
    char words[64], drawn[64];
    std::snprintf(words, sizeof words, "minimax:%d", order);
    std::snprintf(drawn, sizeof drawn, "zeta%.7f:%d", (double)burnishZetaMinimax((float)n, (float)order), order);
    const bool read = burnish_theory_model_parse(words, n, &best, nullptr) == BURNISH_STATUS_OK &&
                      burnish_theory_model_parse(drawn, n, &line, nullptr) == BURNISH_STATUS_OK;
    check(read, drawn, n, n);
    if (!read) {
        return;
    }
    const double end = (double)1.570796326794896L;
    const double more = burnish_theory_maximum_error(&line, end) - burnish_theory_maximum_error(&best, end);
    check(more < (double)0.001L, drawn, more, (double)0.0002L);
}

static void check_slopes() {
    for (int order = 2; order <= 32; order *= 2) {
        for (double n = order; n <= 65536; n *= 1.37) {
            const float fn = (float)n, m = (float)order;
            const double x = (double)fn;
            check_near("taylor", (double)burnishZetaTaylor(fn, m), solve(BURNISH_FIT_TAYLOR, order, x, 0), 2e-7);
            check_near("energy", (double)burnishZetaEnergy(fn, m), solve(BURNISH_FIT_ENERGY, order, x, 0), 3e-7);
            check_near("projected", (double)burnishZetaProjected(fn, m), solve(BURNISH_FIT_PROJECTED, order, x, 0),
                       2e-6);
            check_near("level", (double)burnishZetaLevel(fn, m, 0.5f), solve(BURNISH_FIT_LEVEL, order, x, 0.5),
                       2e-6 + x * 1e-7);
            check_minimax(order, x);
        }
    }
    check_near("shift7", (double)burnishZetaShift7(48), solve(BURNISH_FIT_SHIFT7, 2, 48, 0), 0);
    check_near("shift3", (double)burnishZetaShift3(48), solve(BURNISH_FIT_SHIFT3, 2, 48, 0), 0);
}

static void check_conversions() {
    for (double n = 1; n <= 65536; n *= 1.7) {
        const float fn = (float)n;
        check_near("alpha", (double)burnishAlphaFromExponent(fn), burnish_theory_alpha_from_exponent(n), 1e-6);
        check_near("roughness", (double)burnishRoughnessFromExponent(fn), burnish_theory_roughness_from_exponent(n),
                   1e-6);
        check_near("and back", (double)burnishExponentFromRoughness(burnishRoughnessFromExponent(fn)), n, 1e-5);
        check_near("toksvig", (double)burnishToksvigExponent(fn, 0.75f), burnish_theory_toksvig_exponent(n, 0.75),
                   1e-6);
    }
    check_near("mirror", (double)burnishExponentFromRoughness(0), 65536, 0);
    check_near("rough", (double)burnishExponentFromRoughness(1), 1, 0);
    check_near("phong", (double)burnishPhongFromBlinn(64), burnish_theory_phong_from_blinn(64), 0);
    check_near("blinn", (double)burnishBlinnFromPhong(64), burnish_theory_blinn_from_phong(64), 0);
}

static void check_falloffs() {
    for (float x = -1; x < 10; x += 0.001f) {
        check(same_bits(burnishExpFalloff3(x), burnish_exp_falloff3(x)), "e^-x, 3", (double)x, 3);
        check(same_bits(burnishExpFalloff4(x), burnish_exp_falloff4(x)), "e^-x, 4", (double)x, 4);
        check(same_bits(burnishExpFalloff5(x), burnish_exp_falloff5(x)), "e^-x, 5", (double)x, 5);
        const double u = (double)std::min(std::max(1 - x, 0.0f), 1.0f);
        check_near("fresnel", (double)burnishFresnelWeight(x), u * u * u * u * u, 1e-6);
    }
}

static float composite(const burnish_composite &at, float cosine) {
    const float *o = at.offset;
    return at.multiplications == 3   ? burnishComposite3(cosine, at.top, at.slope, o[0])
           : at.multiplications == 4 ? burnishComposite4(cosine, at.top, at.slope, o[0], o[1])
           : at.multiplications == 5 ? burnishComposite5(cosine, at.top, at.slope, o[0], o[1], o[2])
                                     : burnishComposite6(cosine, at.top, at.slope, o[0], o[1], o[2], o[3]);
}

static void check_composites() {
    for (int multiplications = 3; multiplications <= 6; ++multiplications) {
        burnish_composite lobe;
        burnish_composite_create(&lobe, BURNISH_COMPOSITE_MINIMAX, multiplications, 64);
        check(lobe.multiplications == multiplications, "composite", lobe.multiplications, multiplications);
        for (float c = 0.8f; c < 1.01f; c += 0.0001f) {
            check(same_bits(composite(lobe, c), burnish_composite_at_cosine(lobe, c)), "composite", (double)c, 64);
        }
    }
    for (float n = 16; n <= 65536; n *= 1.003f) {
        for (float x = 0; x < 16; x += 0.1f) {
            const float c = 1 - x / n;
            const double value = (double)specularComposite(c, n), exact = std::pow((double)c, (double)n);
            check(value <= 1 && std::fabs(value - exact) < (double)0.0009f, "composite", value, exact);
        }
    }
}

// Integrals over the hemisphere by the midpoint rule in the cosine.
static void check_normalization() {
    const int steps = 200000;
    for (float zeta = 1.5f; zeta < 300; zeta *= 7) {
        double lobe = 0, distribution = 0, power = 0, power_distribution = 0;
        for (int i = 0; i < steps; ++i) {
            const float c = ((float)i + 0.5f) / (float)steps;
            lobe += (double)burnishLobe8(c, zeta);
            distribution += (double)(c * burnishLobe8(c, zeta));
            power += (double)burnishPower(c, zeta);
            power_distribution += (double)(c * burnishPower(c, zeta));
        }
        const double step = (double)6.283185307179586L / steps;
        check_near("lobe", lobe * step * (double)burnishNormalizeLobe(zeta, 8), 1, 1e-3);
        check_near("distribution", distribution * step * (double)burnishNormalizeLobeDistribution(zeta, 8), 1, 1e-3);
        check_near("power", power * step * (double)burnishNormalizePower(zeta), 1, 1e-3);
        check_near("power's", power_distribution * step * (double)burnishNormalizePowerDistribution(zeta), 1, 1e-3);
    }
    check_near("specular", (double)specularBurnishNormalized(1, 20), 7 * 3 / (double)6.283185307179586L, 1e-6);
}

static void check_lighting() {
    const vector N(0, 0, 2), L(0, 0, 1), a(1, 2, 3), d(4, 5, 6), s(7, 8, 9);
    const vector color = burnishLighting(N, L, L, a, d, s, 50);
    check_near("lighting", (double)color[1], 15, 1e-5);
    const vector x(1, 0, 0), near(0.99995f, 0.0099998f, 0);
    check_near("lambda", (double)burnishLambda(x, near), 5e-5, 1e-4);
}

static void check_area(const char *path) {
    static area_case cases[AREA_CASES_MAX];
    const int count = read_area_cases(path, cases);
    check(count > 300, path, count, 301);
    for (int i = 0; i < count; ++i) {
        const area_case &one = cases[i];
        const auto of = [](const float *v) { return vector(v[0], v[1], v[2]); };
        const auto light = [&](int sides, vector halfV) {
            return areaLight((int)one.shape, sides, (int)one.order, one.zeta, of(one.center), of(one.half_u), halfV, of(one.normal),
                             of(one.axis));
        };
        const float most = AREA_ERRORS[(int)one.shape];
        const vec2 actual = light((int)one.sides, of(one.half_v));
        check(std::fabs(actual.x - one.diffuse) <= most, "area, diffuse", (double)actual.x, (double)one.diffuse);
        check(std::fabs(actual.y - one.specular) <= most, "area, specular", (double)actual.y, (double)one.specular);
        const vec2 back = light(1, -of(one.half_v)), both = light(2, -of(one.half_v));
        check(one.sides > 1 || std::max(back.x, back.y) == 0, "the dark side", (double)back.x, 0);
        const vec2 none = light(2, of(one.half_u) * 0.5f);
        check(none.x == 0 && none.y == 0, "a light without area", (double)none.y, 0);
        check(std::fabs(both.x - one.diffuse) <= most, "the other side", (double)both.x, (double)one.diffuse);
    }
}

// Shares of GGX with F = 1 and with F = (1 - V.H)^5, sums of 4,096 visible normals: roughness, N.V and both.
static void check_albedo() {
    static const float cases[][4] = {
        {0.1, 0.1, 0.9944, 0.5785},
        {0.1, 0.4, 0.9999, 0.0779},
        {0.1, 0.9, 1.0000, 0.0000},
        {0.3, 0.1, 0.8843, 0.3213},
        {0.3, 0.4, 0.9646, 0.0713},
        {0.3, 0.9, 0.9894, 0.0001},
        {0.5, 0.1, 0.8916, 0.1397},
        {0.5, 0.4, 0.8443, 0.0402},
        {0.5, 0.9, 0.9074, 0.0003},
        {0.8, 0.1, 0.8330, 0.0442},
        {0.8, 0.4, 0.6513, 0.0114},
        {0.8, 0.9, 0.5612, 0.0003},
        {1.0, 0.1, 0.7602, 0.0239},
        {1.0, 0.4, 0.4989, 0.0051},
        {1.0, 0.9, 0.3275, 0.0002},
    };
    for (const float *one : cases) {
        const vec2 share = burnishGgxAlbedo(one[1], one[0]);
        check(std::fabs(share.x + share.y - one[2]) < 0.013f, "albedo", (double)(share.x + share.y), (double)one[2]);
        check(std::fabs(share.y - one[3]) < 0.015f, "albedo of F0 = 0", (double)share.y, (double)one[3]);
    }
}

#ifdef GLSL
// Every input of each lobe in half precision, NaN and infinity included.
static void check_half() {
    float16_t (*const lobes[])(float16_t, float16_t) = {burnishLobe2, burnishLobe4, burnishLobe8, burnishLobe16, burnishLobe32};
    static const double most[] = {0.0008, 0.0013, 0.0023, 0.0045, 0.008};
    for (int number = 0; number < 5; ++number) {
        const int order = 2 << number;
        double error = 0;
        for (double n = order; n <= 65536; n *= 2) {
            const double zeta = solve(BURNISH_FIT_ENERGY, order, n, 0);
            for (int bits = 0; bits < 65536; ++bits) {
                const float16_t c = half_of_bits(bits);
                const double value = (double)lobes[number](c, float16_t((float)zeta)).value;
                check(value >= 0 && value <= 1, "half", value, (double)c.value);
                const double exact = std::pow(std::fmin(std::fmax(1 - zeta * (1 - (double)c.value), 0), 1), order);
                error = std::isnan(c.value) ? error : std::max(error, std::fabs(value - exact));
            }
        }
        check(error <= most[number], "half precision's error", error, most[number]);
    }
}
#endif

int main(int, char **arguments) {
    check_vectors(arguments[1]);
    check_slopes();
    check_conversions();
    check_falloffs();
    check_composites();
    check_normalization();
    check_lighting();
    check_area(arguments[2]);
    check_albedo();
#ifdef GLSL
    check_half();
#endif
    std::printf("%s: %d checks, %d failed\n", arguments[0], checks, failures);
    return failures != 0;
}
