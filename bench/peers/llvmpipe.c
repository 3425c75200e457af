/* Mesa's software rasteriser as a contestant: GLES 3.2 without a window. Buffers and programs are
 * made once; a frame is glClear, one draw call and glFinish; the picture is not read back while
 * timed.
 *
 * Threads come from the environment, which the runner sets: LP_NUM_THREADS=0 rasterises in the
 * calling thread, 2 in two threads beside it. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl32.h>
#include <math.h>
#include <meshoptimizer.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "worker.h"

static const char vertex_text[] = "#version 320 es\n"
                                  "layout(location = 0) in vec3 position;\n"
                                  "layout(location = 1) in vec3 normal;\n"
                                  "uniform mat4 to_clip;\n"
                                  "out vec3 n;\n"
                                  "void main() {\n"
                                  "    n = normal;\n"
                                  "    gl_Position = to_clip * vec4(position, 1.0);\n"
                                  "}\n";

/* `float lobe(float c)` comes between the two parts. */
static const char fragment_head[] = "#version 320 es\n"
                                    "precision highp float;\n"
                                    "precision highp int;\n"
                                    "in vec3 n;\n"
                                    "uniform vec3 light, halfway;\n"
                                    "uniform float ambient, diffuse, specular, exponent, zeta;\n"
                                    "out vec4 color;\n";
static const char fragment_one_sided[] = "vec3 facing() { return normalize(n); }\n";
static const char fragment_two_sided[] =
    "vec3 facing() { return normalize(gl_FrontFacing ? n : -n); }\n";
static const char fragment_main[] =
    "void main() {\n"
    "    vec3 unit = facing();\n"
    "    float n_dot_l = max(dot(unit, light), 0.0);\n"
    "    float shine = n_dot_l > 0.0 ? lobe(dot(unit, halfway)) : 0.0;\n"
    "    float value = ambient + diffuse * n_dot_l + specular * shine;\n"
    "    color = vec4(value, value, value, 1.0);\n"
    "}\n";
static const char lobe_power[] = "float lobe(float c) { return pow(max(c, 0.0), exponent); }\n";
static const char lobe_family[] =
    "float lobe(float c) { float u = max(1.0 + zeta * (c - 1.0), 0.0); return u * u; }\n";
static const char lobe_schlick[] =
    "float lobe(float c) { c = max(c, 0.0); return c / (exponent - exponent * c + c); }\n";

static const char fragment_number[] = "#version 320 es\n"
                                      "precision highp float;\n"
                                      "precision highp int;\n"
                                      "out uint number;\n"
                                      "void main() { number = uint(gl_PrimitiveID); }\n";

enum { LINEAR8, SRGB8, FLOAT32, NUMBER, TARGETS };

/* The plain names are OpenGL at its fastest for this picture: linear bytes, back faces
 * culled. */
static const struct variant {
    const char *name, *lobe;
    int target;
    int two_sided; /* every face drawn, N turned toward the viewer, as burnish does */
} VARIANTS[] = {
    {"power", lobe_power, LINEAR8, 0},           {"power-srgb", lobe_power, SRGB8, 0},
    {"power-two-sided", lobe_power, LINEAR8, 1}, {"family", lobe_family, LINEAR8, 0},
    {"schlick", lobe_schlick, LINEAR8, 0},
};

enum { VARIANT_COUNT = sizeof VARIANTS / sizeof *VARIANTS };

/* Orders of the mesh's triangles and vertices: burnish's, and meshoptimizer's for vertex caches.
 * Frames are drawn in the one that is faster here. */
enum { ORDER_BURNISH, ORDER_CACHE, ORDERS };
static const char *const ORDER_NAMES[ORDERS] = {"burnish's order", "meshoptimizer's order"};

typedef struct gl_renderer {
    const burnish_peers_job *job;
    EGLDisplay display;
    EGLContext context;
    GLuint programs[VARIANT_COUNT], number_program;
    GLuint framebuffers[TARGETS];
    GLuint meshes[ORDERS]; /* vertex array objects */
    int fastest;           /* of these */
    GLsizei index_count;
} gl_renderer;

static void fail(char *note, const char *what) {
    snprintf(note, BURNISH_PEERS_NOTE, "EGL: %s", what);
}

static int open_context(gl_renderer *gl, char *note) {
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_display =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2,
                                 EGL_NONE};
    if (!get_display) {
        fail(note, "no platform displays");
        return 0;
    }
    gl->display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    if (!gl->display || !eglInitialize(gl->display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_ES_API)) {
        fail(note, "no surfaceless display");
        return 0;
    }
    gl->context = eglCreateContext(gl->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (!gl->context || !eglMakeCurrent(gl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, gl->context)) {
        fail(note, "no OpenGL ES 3.2 context");
        return 0;
    }
    return 1;
}

static GLuint compile(GLenum kind, const char *const *parts, GLsizei count, char *note) {
    GLuint shader = glCreateShader(kind);
    GLint done = 0;
    glShaderSource(shader, count, parts, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
    if (!done) {
        glGetShaderInfoLog(shader, BURNISH_PEERS_NOTE, NULL, note);
        return 0;
    }
    return shader;
}

static GLuint link_program(const char *const *parts, GLsizei count, char *note) {
    const char *vertex_parts[] = {vertex_text};
    GLuint vertex = compile(GL_VERTEX_SHADER, vertex_parts, 1, note);
    GLuint fragment = compile(GL_FRAGMENT_SHADER, parts, count, note);
    GLuint program = glCreateProgram();
    GLint done = 0;
    if (!vertex || !fragment) {
        return 0;
    }
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &done);
    return done ? program : 0;
}

/* Columns of the matrix from world to clip space. */
static void make_matrix(const burnish_peers_job *job, float matrix[16]) {
    const double n = job->nearest, f = job->farthest;
    const double *axes[4] = {job->right, job->up, job->forward, job->forward};
    const double scale[4] = {2 * job->pixels / BURNISH_PEERS_WIDTH,
                             2 * job->pixels / BURNISH_PEERS_HEIGHT, (f + n) / (f - n), 1};
    const double offset[4] = {0, 0, -2 * f * n / (f - n), 0};
    for (int row = 0; row < 4; ++row) {
        double constant = 0;
        for (int k = 0; k < 3; ++k) {
            matrix[4 * k + row] = (float)(scale[row] * axes[row][k]);
            constant -= axes[row][k] * job->eye[k];
        }
        matrix[12 + row] = (float)(scale[row] * constant + offset[row]);
    }
}

static void set_uniforms(const burnish_peers_job *job, GLuint program) {
    float matrix[16];
    make_matrix(job, matrix);
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "to_clip"), 1, GL_FALSE, matrix);
    glUniform3fv(glGetUniformLocation(program, "light"), 1, job->light);
    glUniform3fv(glGetUniformLocation(program, "halfway"), 1, job->half);
    glUniform1f(glGetUniformLocation(program, "ambient"), job->ambient);
    glUniform1f(glGetUniformLocation(program, "diffuse"), job->diffuse);
    glUniform1f(glGetUniformLocation(program, "specular"), job->specular);
    glUniform1f(glGetUniformLocation(program, "exponent"), job->exponent);
    glUniform1f(glGetUniformLocation(program, "zeta"), job->zeta);
}

static int make_programs(gl_renderer *gl, char *note) {
    for (int i = 0; i < VARIANT_COUNT; ++i) {
        const char *parts[] = {fragment_head,
                               VARIANTS[i].two_sided ? fragment_two_sided : fragment_one_sided,
                               VARIANTS[i].lobe, fragment_main};
        gl->programs[i] = link_program(parts, 4, note);
        if (!gl->programs[i]) {
            return 0;
        }
        set_uniforms(gl->job, gl->programs[i]);
    }
    const char *parts[] = {fragment_number};
    gl->number_program = link_program(parts, 1, note);
    if (!gl->number_program) {
        return 0;
    }
    set_uniforms(gl->job, gl->number_program);
    return 1;
}

static int make_framebuffers(gl_renderer *gl, char *note) {
    const GLenum formats[TARGETS] = {GL_RGBA8, GL_SRGB8_ALPHA8, GL_RGBA32F, GL_R32UI};
    GLuint depth, color[TARGETS];
    glGenRenderbuffers(1, &depth);
    glBindRenderbuffer(GL_RENDERBUFFER, depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, BURNISH_PEERS_WIDTH,
                          BURNISH_PEERS_HEIGHT);
    glGenRenderbuffers(TARGETS, color);
    glGenFramebuffers(TARGETS, gl->framebuffers);
    for (int i = 0; i < TARGETS; ++i) {
        glBindRenderbuffer(GL_RENDERBUFFER, color[i]);
        glRenderbufferStorage(GL_RENDERBUFFER, formats[i], BURNISH_PEERS_WIDTH,
                              BURNISH_PEERS_HEIGHT);
        glBindFramebuffer(GL_FRAMEBUFFER, gl->framebuffers[i]);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color[i]);
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
        if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
            snprintf(note, BURNISH_PEERS_NOTE, "OpenGL: framebuffer %d is not complete", i);
            return 0;
        }
    }
    return 1;
}

static void make_mesh(gl_renderer *gl, int order, const float *positions, const float *normals,
                      const uint32_t *indices) {
    const burnish_mesh_view *mesh = burnish_mesh_get_view(gl->job->scene);
    GLuint buffers[3];
    GLsizeiptr vectors = (GLsizeiptr)(mesh->vertex_count * 3 * sizeof(float));
    gl->index_count = (GLsizei)(3 * mesh->triangle_count);
    glGenVertexArrays(1, &gl->meshes[order]);
    glBindVertexArray(gl->meshes[order]);
    glGenBuffers(3, buffers);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, vectors, positions, GL_STATIC_DRAW);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[1]);
    glBufferData(GL_ARRAY_BUFFER, vectors, normals, GL_STATIC_DRAW);
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[2]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 (GLsizeiptr)(3 * mesh->triangle_count * sizeof *mesh->indices), indices,
                 GL_STATIC_DRAW);
}

/* The mesh in the order that meshoptimizer makes for vertex caches. */
static int make_cache_order(gl_renderer *gl) {
    const burnish_mesh_view *mesh = burnish_mesh_get_view(gl->job->scene);
    const size_t vertices = mesh->vertex_count, count = 3 * mesh->triangle_count;
    uint32_t *indices = malloc(count * sizeof *indices), *remap = malloc(vertices * sizeof *remap);
    float *positions = malloc(3 * vertices * sizeof *positions);
    float *normals = malloc(3 * vertices * sizeof *normals);
    const int done = indices && remap && positions && normals;
    if (done) {
        meshopt_optimizeVertexCache(indices, mesh->indices, count, vertices);
        meshopt_optimizeVertexFetchRemap(remap, indices, count, vertices);
        meshopt_remapIndexBuffer(indices, indices, count, remap);
        meshopt_remapVertexBuffer(positions, mesh->positions, vertices, 3 * sizeof(float), remap);
        meshopt_remapVertexBuffer(normals, mesh->normals, vertices, 3 * sizeof(float), remap);
        make_mesh(gl, ORDER_CACHE, positions, normals, indices);
    }
    free(indices);
    free(remap);
    free(positions);
    free(normals);
    return done;
}

static int make_buffers(gl_renderer *gl) {
    const burnish_mesh_view *mesh = burnish_mesh_get_view(gl->job->scene);
    make_mesh(gl, ORDER_BURNISH, mesh->positions, mesh->normals, mesh->indices);
    glEnable(GL_DEPTH_TEST);
    glViewport(0, 0, BURNISH_PEERS_WIDTH, BURNISH_PEERS_HEIGHT);
    return make_cache_order(gl);
}

static void close_gl(void *state) {
    gl_renderer *gl = state;
    if (gl->display) {
        eglMakeCurrent(gl->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglTerminate(gl->display);
    }
    free(gl);
}

static void draw(const gl_renderer *gl, GLuint program, int target, int cull, int order) {
    glBindFramebuffer(GL_FRAMEBUFFER, gl->framebuffers[target]);
    glUseProgram(program);
    if (cull) {
        glEnable(GL_CULL_FACE);
    } else {
        glDisable(GL_CULL_FACE);
    }
    if (target == NUMBER) {
        const GLuint nothing[4] = {BURNISH_PEERS_NOTHING, 0, 0, 0};
        glClearBufferuiv(GL_COLOR, 0, nothing);
        glClear(GL_DEPTH_BUFFER_BIT);
    } else {
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    }
    glBindVertexArray(gl->meshes[order]);
    glDrawElements(GL_TRIANGLES, gl->index_count, GL_UNSIGNED_INT, NULL);
    glFinish();
}

/* Finds the faster order by drawing both in turns. */
static void find_fastest(gl_renderer *gl) {
    enum { TURNS = 5 };
    double shortest[ORDERS] = {INFINITY, INFINITY};
    for (int i = 0; i < TURNS * ORDERS; ++i) {
        const int order = i % ORDERS;
        const double start = burnish_peers_now();
        draw(gl, gl->programs[0], LINEAR8, 1, order);
        shortest[order] = fmin(shortest[order], burnish_peers_now() - start);
    }
    gl->fastest = shortest[ORDER_CACHE] < shortest[ORDER_BURNISH] ? ORDER_CACHE : ORDER_BURNISH;
}

static int open_gl(void **state, const burnish_peers_job *job, int threads, char *note) {
    gl_renderer *gl = calloc(1, sizeof *gl);
    const char *lp_threads = getenv("LP_NUM_THREADS");
    if (!gl) {
        return 0;
    }
    gl->job = job;
    if (!open_context(gl, note) || !make_programs(gl, note) || !make_framebuffers(gl, note)) {
        close_gl(gl);
        return 0;
    }
    if (!make_buffers(gl)) {
        close_gl(gl);
        return 0;
    }
    find_fastest(gl);
    snprintf(note, BURNISH_PEERS_NOTE, "%s, %s, LP_NUM_THREADS=%s, %d thread%s, %s",
             (const char *)glGetString(GL_RENDERER), (const char *)glGetString(GL_VERSION),
             lp_threads ? lp_threads : "(unset)", threads, threads == 1 ? "" : "s",
             ORDER_NAMES[gl->fastest]);
    *state = gl;
    return 1;
}

static int find_variant(const char *name) {
    for (int i = 0; i < VARIANT_COUNT; ++i) {
        if (strcmp(name, VARIANTS[i].name) == 0) {
            return i;
        }
    }
    return -1;
}

static int frame(void *state, const char *name, double *milliseconds) {
    const gl_renderer *gl = state;
    int i = find_variant(name);
    if (i < 0) {
        return 0;
    }
    double start = burnish_peers_now();
    draw(gl, gl->programs[i], VARIANTS[i].target, !VARIANTS[i].two_sided, gl->fastest);
    *milliseconds = burnish_peers_now() - start;
    return glGetError() == GL_NO_ERROR;
}

/* The offset of the top row in what OpenGL reads back. */
static size_t flipped(size_t pixel) {
    size_t x = pixel % BURNISH_PEERS_WIDTH, y = pixel / BURNISH_PEERS_WIDTH;
    return (BURNISH_PEERS_HEIGHT - 1 - y) * BURNISH_PEERS_WIDTH + x;
}

/* An sRGB framebuffer's own bytes; otherwise linear floats, encoded here exactly. */
static int picture(void *state, const char *name, uint8_t *rgb) {
    const gl_renderer *gl = state;
    int i = find_variant(name);
    float *values = malloc((size_t)BURNISH_PEERS_PIXELS * 4 * sizeof *values);
    uint8_t *codes = (uint8_t *)values;
    if (i < 0 || !values) {
        free(values);
        return 0;
    }
    int encoded = VARIANTS[i].target == SRGB8;
    draw(gl, gl->programs[i], encoded ? SRGB8 : FLOAT32, !VARIANTS[i].two_sided, ORDER_BURNISH);
    glReadPixels(0, 0, BURNISH_PEERS_WIDTH, BURNISH_PEERS_HEIGHT, GL_RGBA,
                 encoded ? GL_UNSIGNED_BYTE : GL_FLOAT, values);
    for (size_t p = 0; p < BURNISH_PEERS_PIXELS; ++p) {
        for (size_t k = 0; k < 3; ++k) {
            size_t from = 4 * flipped(p) + k;
            rgb[3 * p + k] = encoded ? codes[from] : burnish_peers_srgb((double)values[from]);
        }
    }
    free(values);
    return glGetError() == GL_NO_ERROR;
}

static int triangles(void *state, uint32_t *numbers) {
    const gl_renderer *gl = state;
    uint32_t *read = malloc((size_t)BURNISH_PEERS_PIXELS * sizeof *read);
    if (!read) {
        return 0;
    }
    draw(gl, gl->number_program, NUMBER, 0, ORDER_BURNISH); /* numbers are burnish's */
    glReadPixels(0, 0, BURNISH_PEERS_WIDTH, BURNISH_PEERS_HEIGHT, GL_RED_INTEGER, GL_UNSIGNED_INT,
                 read);
    for (size_t p = 0; p < BURNISH_PEERS_PIXELS; ++p) {
        numbers[p] = read[flipped(p)];
    }
    free(read);
    return glGetError() == GL_NO_ERROR;
}

int main(int count, char **arguments) {
    const burnish_peers_contestant contestant = {open_gl, frame, picture, triangles, close_gl};
    return burnish_peers_serve(&contestant, count, arguments);
}
