/* What a highlight costs on a GPU: a full-screen pass of LOBES highlights, or of one area light, per pixel
 * for each lobe of shaders/burnish.glsl, medians over interleaved rounds, as a table. A real GPU is timed by its
 * timer queries. They are wrong in drivers that draw on the processor (llvmpipe restarts them in
 * every tile and reports the last): those are timed by the process' time on all processors.
 * Usage: bench_shaders BURNISH_GLSL [ROUNDS]
 * Exit code 77: OpenGL ES 3 with timer queries is missing. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
/* after burnish.glsl, which declares the types */
#include <GLES2/gl2ext.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { WIDTH = 1920, HEIGHT = 1080, LOBES = 16, ROUNDS_MAX = 99, SOURCE_MAX = 1 << 16 };

/* A parallelogram that slides through the lobe with c. */
#define AREA                                                                                       \
    "vec3(c * 4.0 - 3.2, 0.2, 1.0), vec3(0.4, 0.0, 0.0), vec3(0.0, 0.3, 0.1), 2, vec3(0.0, 0.0, "  \
    "1.0)"

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
    {"area light, GGX", "dot(burnishRectLightGgx(" AREA ", vec3(0.1, 0.2, 0.97), 0.3), vec2(1.0))",
     1},
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

/* Without a window: Mesa's platform, else the first device. */
static EGLDisplay open_display(void) {
    const PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    const PFNEGLQUERYDEVICESEXTPROC query_devices =
        (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
    EGLDeviceEXT device;
    EGLint count = 0;
    if (!get_display) {
        return EGL_NO_DISPLAY;
    }
    EGLDisplay display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (display && eglInitialize(display, NULL, NULL)) {
        return display;
    }
    if (!query_devices || !query_devices(1, &device, &count) || count < 1) {
        return EGL_NO_DISPLAY;
    }
    display = get_display(EGL_PLATFORM_DEVICE_EXT, device, NULL);
    return display && eglInitialize(display, NULL, NULL) ? display : EGL_NO_DISPLAY;
}

static void open_context(void) {
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
    const EGLDisplay display = open_display();
    EGLContext context;
    if (!display || !eglBindAPI(EGL_OPENGL_ES_API)) {
        stop(77, "no display without a window; run scripts/install-deps shaders");
    }
    context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (!context || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        stop(77, "no OpenGL ES 3 context");
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
    static char source[SOURCE_MAX + 2048];
    const GLuint program = glCreateProgram();
    GLint good = 0;
    char main_part[1024];
    snprintf(main_part, sizeof main_part, FRAGMENT_MAIN, one->body, one->count);
    snprintf(source, sizeof source, "#version 300 es\nprecision highp float;\n%s%s", shaders,
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
    return program;
}

static void open_target(void) {
    GLuint texture, framebuffer;
    glGenTextures(1, &texture);
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

static int draws_on_processor(void) {
    const char *name = (const char *)glGetString(GL_RENDERER);
    return strstr(name, "llvmpipe") || strstr(name, "SwiftShader") || strstr(name, "softpipe");
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
    return draws_on_processor() ? spent : (double)nanoseconds * 1e-6;
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
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
        if (i == NONE) {
            printf("| none | %.2f | | |\n", medians[i]);
        } else {
            printf("| %s | %.2f | %.4f | %.0f %% |\n", CONTESTANTS[i].name, medians[i],
                   more * 1e6 / ((double)WIDTH * HEIGHT * CONTESTANTS[i].count),
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
