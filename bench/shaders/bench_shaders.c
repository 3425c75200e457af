/* What a highlight costs on a GPU: a full-screen pass of LOBES highlights, or of one area light, per pixel
 * for each lobe of shaders/burnish.glsl, medians over interleaved rounds, as a table. A real GPU is timed by its
 * timer queries. They are wrong in drivers that draw on the processor (llvmpipe restarts them in
 * every tile and reports the last): those are timed by the process' time on all processors.
 * Usage: bench_shaders BURNISH_GLSL [ROUNDS]
 * Exit code 77: OpenGL ES 3 with timer queries is missing. */
#include <EGL/egl.h>
#include <GLES3/gl3.h>
/* after burnish.glsl, which declares the types */
#include <GLES2/gl2ext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "egl.h"

enum { WIDTH = 1920, HEIGHT = 1080, LOBES = 16, ROUNDS_MAX = 99, SOURCE_MAX = 1 << 16 };

/* A parallelogram that slides through the lobe with c. */
#define AREA                                                                                       \
    "vec3(c * 4.0 - 3.2, 0.2, 1.0), vec3(0.4, 0.0, 0.0), vec3(0.0, 0.3, 0.1), 2, vec3(0.0, 0.0, "  \
    "1.0)"

/* Its corners. */
#define CORNERS                                                                                    \
    "vec3(c * 4.0 - 3.2, 0.2, 1.0), vec3(c * 4.0 - 2.8, 0.2, 1.0), vec3(c * 4.0 - 2.8, 0.5, 1.1)," \
    "vec3(c * 4.0 - 3.2, 0.5, 1.1)"

/* Linearly transformed cosines, as three.js has them: two look-ups by roughness and angle, the
 * polygon's vector irradiance with Hill and Heitz' rational function for the angle of an edge, and
 * the horizon of a sphere of the same irradiance; diffuse and specular. The normal is z. What the
 * tables contain does not change the cost. */
static const char LTC[] =
    "uniform highp sampler2D table, scale;\n"
    "vec3 ltcEdge(vec3 a, vec3 b) {\n"
    "    float x = dot(a, b), y = abs(x);\n"
    "    float v = (0.8543985 + (0.4965155 + 0.0145206 * y) * y) / (3.417594 + (4.1616724 + y) * "
    "y);\n"
    "    return cross(a, b) * (x > 0.0 ? v : 0.5 * inversesqrt(max(1.0 - x * x, 1e-7)) - v);\n"
    "}\n"
    "float ltcPolygon(mat3 inverse, vec3 corners[4]) {\n"
    "    vec3 a = normalize(inverse * corners[0]), b = normalize(inverse * corners[1]);\n"
    "    vec3 c = normalize(inverse * corners[2]), d = normalize(inverse * corners[3]);\n"
    "    vec3 f = ltcEdge(a, b) + ltcEdge(b, c) + ltcEdge(c, d) + ltcEdge(d, a);\n"
    "    float size = length(f);\n"
    "    return max((size * size + f.z) / (size + 1.0), 0.0);\n"
    "}\n"
    "float ltc(vec3 corners[4], vec3 view, float roughness) {\n"
    "    vec2 at = vec2(roughness, sqrt(1.0 - view.z)) * (63.0 / 64.0) + 0.5 / 64.0;\n"
    "    vec4 t = texture(table, at), s = texture(scale, at);\n"
    "    mat3 inverse = mat3(t.x, 0.0, t.y, 0.0, 1.0, 0.0, t.z, 0.0, t.w);\n"
    "    vec3 right = normalize(view - vec3(0.0, 0.0, view.z)), up = vec3(-right.y, right.x, "
    "0.0);\n"
    "    mat3 turn = transpose(mat3(right, up, vec3(0.0, 0.0, 1.0)));\n"
    "    return ltcPolygon(mat3(1.0), corners) +\n"
    "           (0.04 * s.x + 0.96 * s.y) * ltcPolygon(inverse * turn, corners);\n"
    "}\n";

static const struct contestant {
    const char *name, *body;
    int count; /* per pixel */
} CONTESTANTS[] = {
    {"none", "c", LOBES}, /* without a lobe; subtracted */
    {"`pow`", "burnishPower(c, exponent)", LOBES},
    {"Schlick", "burnishSchlick(c, exponent)", LOBES},
    {"order 2", "burnishLobe2(c, zeta)", LOBES},
    {"order 4", "burnishLobe4(c, zeta)", LOBES},
    {"order 8", "burnishLobe8(c, zeta)", LOBES},
    {"order 16", "burnishLobe16(c, zeta)", LOBES},
    {"order 32", "burnishLobe32(c, zeta)", LOBES},
    {"area light, order 2",
     "dot(burnishRectLight(" AREA ", vec3(0.0, 0.0, 1.0), zeta, 2), vec2(1.0))", 1},
    {"area light, GGX",
     "dot(burnishRectLightGgx(" AREA ", vec3(c * 0.1, 0.2, 0.97), c * 0.3), vec2(1.0))", 1},
    {"area light, LTC", "ltc(vec3[4](" CORNERS "), vec3(c * 0.1, 0.2, 0.97), c * 0.3)", 1},
};

enum { NONE, POWER, CONTESTANT_COUNT = sizeof CONTESTANTS / sizeof *CONTESTANTS };

static const char VERTEX[] = "#version 300 es\n"
                             "out highp vec2 at;\n"
                             "void main() {\n"
                             "    at = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0;\n"
                             "    gl_Position = vec4(at * 2.0 - 1.0, 0.0, 1.0);\n"
                             "}\n";

/* The cosines of a pixel differ, and depend on it. */
static const char FRAGMENT_MAIN[] = "in vec2 at;\n"
                                    "uniform float zeta, exponent;\n"
                                    "out vec4 color;\n"
                                    "float lobe(float c) { return %s; }\n"
                                    "void main() {\n"
                                    "    float c = 0.8 + 0.1 * (at.x + at.y), sum = 0.0;\n"
                                    "    for (int i = 0; i < %d; ++i) {\n"
                                    "        sum += lobe(c);\n"
                                    "        c = c * 0.98 + 0.02;\n"
                                    "    }\n"
                                    "    color = vec4(sum * 0.05);\n"
                                    "}\n";

static void stop(int code, const char *what) {
    fprintf(stderr, "bench_shaders: %s\n", what);
    exit(code);
}

static void open_context(void) {
    const char *missing = burnish_bench_open_gl(3, 0);
    if (missing) {
        stop(77, missing);
    }
    if (!strstr((const char *)glGetString(GL_EXTENSIONS), "GL_EXT_disjoint_timer_query")) {
        stop(77, "no timer queries");
    }
}

static GLuint compile(GLenum kind, const char *source) {
    const GLuint shader = glCreateShader(kind);
    char log[512];
    GLint good = 0;
    glShaderSource(shader, 1, &source, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good) {
        glGetShaderInfoLog(shader, sizeof log, NULL, log);
        stop(1, log);
    }
    return shader;
}

static GLuint make_program(const char *shaders, const struct contestant *one) {
    static char source[SOURCE_MAX + 4096];
    const GLuint program = glCreateProgram();
    GLint good = 0;
    char main_part[1024];
    snprintf(main_part, sizeof main_part, FRAGMENT_MAIN, one->body, one->count);
    snprintf(source, sizeof source, "#version 300 es\nprecision highp float;\n%s%s%s", shaders, LTC,
             main_part);
    glAttachShader(program, compile(GL_VERTEX_SHADER, VERTEX));
    glAttachShader(program, compile(GL_FRAGMENT_SHADER, source));
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (!good) {
        stop(1, "can't link");
    }
    glUseProgram(program);
    glUniform1f(glGetUniformLocation(program, "exponent"), 64.0f);
    glUniform1f(glGetUniformLocation(program, "zeta"), 65.0f / 3.0f);
    glUniform1i(glGetUniformLocation(program, "scale"), 1);
    return program;
}

/* The tables of LTC, half floats as in three.js, with one entry throughout. */
static void open_tables(void) {
    enum { SIDE = 64 };
    static float entries[SIDE * SIDE][4];
    GLuint tables[2];
    for (int i = 0; i < SIDE * SIDE; ++i) {
        memcpy(entries[i], (const float[4]){1.1f, 0.1f, -0.1f, 0.9f}, sizeof entries[i]);
    }
    glGenTextures(2, tables);
    for (int i = 1; i >= 0; --i) {
        glActiveTexture(i ? GL_TEXTURE1 : GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D, tables[i]);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA16F, SIDE, SIDE, 0, GL_RGBA, GL_FLOAT, entries);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    }
}

static void open_target(void) {
    GLuint texture, framebuffer;
    glGenTextures(1, &texture);
    glActiveTexture(GL_TEXTURE2);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, WIDTH, HEIGHT);
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    glViewport(0, 0, WIDTH, HEIGHT);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        stop(1, "no target");
    }
}

static double processor_time(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

/* Milliseconds of one pass. */
static double time_pass(GLuint program, GLuint query) {
    const PFNGLGETQUERYOBJECTUI64VEXTPROC get_result =
        (PFNGLGETQUERYOBJECTUI64VEXTPROC)eglGetProcAddress("glGetQueryObjectui64vEXT");
    GLuint64 nanoseconds = 0;
    glUseProgram(program);
    glFinish();
    const double start = processor_time();
    glBeginQuery(GL_TIME_ELAPSED_EXT, query);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEndQuery(GL_TIME_ELAPSED_EXT);
    glFinish();
    const double spent = processor_time() - start;
    get_result(query, GL_QUERY_RESULT, &nanoseconds);
    return burnish_bench_draws_on_processor() ? spent : (double)nanoseconds * 1e-6;
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Decimals for three digits that count. */
static int decimals(double value) {
    int count = 2;
    for (; count < 8 && value > 0 && value < 1; ++count) {
        value *= 10;
    }
    return value >= 10 ? count - 1 : count;
}

static void print_table(double times[][ROUNDS_MAX], int rounds) {
    double medians[CONTESTANT_COUNT];
    for (int i = 0; i < CONTESTANT_COUNT; ++i) {
        qsort(times[i], (size_t)rounds, sizeof(double), compare);
        medians[i] = times[i][rounds / 2];
    }
    const double power = medians[POWER] - medians[NONE];
    printf(
        "| lobe, on %s | ms a pass | ns a highlight | of `pow` |\n| --- | ---: | ---: | ---: |\n",
        (const char *)glGetString(GL_RENDERER));
    for (int i = 0; i < CONTESTANT_COUNT; ++i) {
        const double more = medians[i] - medians[NONE];
        const double each = more * 1e6 / ((double)WIDTH * HEIGHT * CONTESTANTS[i].count);
        if (i == NONE) {
            printf("| none | %.*f | | |\n", decimals(medians[i]), medians[i]);
        } else {
            printf("| %s | %.*f | %.*f | %.0f %% |\n", CONTESTANTS[i].name, decimals(medians[i]),
                   medians[i], decimals(each), each,
                   100 * more / power * LOBES / CONTESTANTS[i].count);
        }
    }
}

int main(int count, char **arguments) {
    static char shaders[SOURCE_MAX];
    static double times[CONTESTANT_COUNT][ROUNDS_MAX];
    GLuint programs[CONTESTANT_COUNT], query;
    const int rounds = count > 2 ? atoi(arguments[2]) : 25;
    FILE *file = count > 1 ? fopen(arguments[1], "r") : NULL;
    if (!file || rounds < 1 || rounds > ROUNDS_MAX) {
        stop(2, "usage: bench_shaders BURNISH_GLSL [ROUNDS, 1 to 99]");
    }
    shaders[fread(shaders, 1, SOURCE_MAX - 1, file)] = 0;
    fclose(file);
    open_context();
    open_tables();
    open_target();
    glGenQueries(1, &query);
    for (int i = 0; i < CONTESTANT_COUNT; ++i) {
        programs[i] = make_program(shaders, &CONTESTANTS[i]);
        time_pass(programs[i], query); /* drivers compile at the first use */
    }
    for (int round = 0; round < rounds; ++round) {
        for (int i = 0; i < CONTESTANT_COUNT; ++i) {
            times[i][round] = time_pass(programs[i], query);
        }
    }
    if (glGetError() != GL_NO_ERROR) {
        stop(1, "OpenGL reports an error");
    }
    print_table(times, rounds);
    return 0;
}
