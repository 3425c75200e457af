/* Mesa's software rasteriser as a contestant: GLES 3.2 without a window. Buffers and programs are
 * made once; a frame is glClear, a draw call per material and glFinish.
 *
 * The runner sets the number of threads in the environment: LP_NUM_THREADS=0 rasterises in the
 * calling thread, 2 in two more threads. */
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl32.h>
#include <math.h>
#include <meshoptimizer.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "llvmpipe_shaders.h"
#include "worker.h"

enum { LINEAR8, SRGB8, FLOAT32, TARGETS };

/* The plain names are OpenGL at its fastest for this picture: linear bytes, back faces
 * culled. */
static const struct variant {
    const char *name, *lobe;
    int target;
    int two_sided; /* 1: draws every face with N turned toward the viewer, as burnish does */
} VARIANTS[] = {
    {"power", lobe_power, LINEAR8, 0},           {"power-srgb", lobe_power, SRGB8, 0},
    {"power-two-sided", lobe_power, LINEAR8, 1}, {"family", lobe_family, LINEAR8, 0},
    {"schlick", lobe_schlick, LINEAR8, 0},
};

enum { VARIANT_COUNT = sizeof VARIANTS / sizeof *VARIANTS };

/* Orders of the mesh's triangles and vertices: burnish's, and meshoptimizer's for vertex caches.
 * Frames use the faster one. */
enum { ORDER_BURNISH, ORDER_CACHE, ORDERS };
static const char *const ORDER_NAMES[ORDERS] = {"burnish's order", "meshoptimizer's order"};

typedef struct gl_renderer {
    const burnish_peers_job *job;
    GLuint programs[VARIANT_COUNT];
    GLuint framebuffers[TARGETS];
    GLuint resolved;       /* where the samples of LINEAR8 go; 0: it has one per pixel */
    GLuint meshes[ORDERS]; /* vertex array objects */
    int fastest;           /* of these */
    size_t *ends;          /* of each material's indices */
    size_t material_count;
} gl_renderer;

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

/* Without a window: on Mesa's platform for that, else on the first device. Returns NULL, or what is missing. */
static const char *open_context(void) {
    static const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2,
                                        EGL_NONE};
    const EGLDisplay display = open_display();
    if (!display || !eglBindAPI(EGL_OPENGL_ES_API)) {
        return "no display without a window";
    }
    const EGLContext context =
        eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (!context || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        return "no OpenGL ES 3 context";
    }
    return NULL;
}

static void close_context(void) {
    const EGLDisplay display = eglGetCurrentDisplay();
    if (display != EGL_NO_DISPLAY) {
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglTerminate(display);
    }
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

static int is_colored(const burnish_peers_job *job) {
    return burnish_mesh_get_view(job->scene)->colors != NULL;
}

static int is_grey(const burnish_peers_job *job) {
    return !is_colored(job) && burnish_mesh_get_material_count(job->scene) == 1;
}

/* Fragment parts come after the common head. */
static GLuint link_program(const burnish_peers_job *job, const char *const parts[4], char *note) {
    char head[256];
    snprintf(head, sizeof head,
             "#version 320 es\nprecision highp float;\nprecision highp int;\n"
             "#define COLOR %s\n%s",
             is_grey(job) ? "float" : "vec3", is_colored(job) ? "#define COLORED\n" : "");
    const char *const vertex_parts[] = {head, vertex_main};
    const char *const fragment_parts[] = {head, parts[0], parts[1], parts[2], parts[3]};
    GLuint vertex = compile(GL_VERTEX_SHADER, vertex_parts, 2, note);
    GLuint fragment = compile(GL_FRAGMENT_SHADER, fragment_parts, 5, note);
    GLuint program = glCreateProgram();
    GLint done = 0;
    if (!vertex || !fragment) {
        return 0;
    }
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &done);
    if (!done) {
        glGetProgramInfoLog(program, BURNISH_PEERS_NOTE, NULL, note);
    }
    return done ? program : 0;
}

/* Columns of the matrix from world to clip space. */
static void make_matrix(const burnish_peers_job *job, float matrix[16]) {
    const double n = job->nearest, f = job->farthest;
    const double *axes[4] = {job->right, job->up, job->forward, job->forward};
    const double scale[4] = {2 * job->pixels / job->options.width,
                             2 * job->pixels / job->options.height, (f + n) / (f - n), 1};
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
    glUniform1f(glGetUniformLocation(program, "specular"), job->specular);
    glUniform1f(glGetUniformLocation(program, "exponent"), job->exponent);
    glUniform1f(glGetUniformLocation(program, "zeta"), job->zeta);
}

static int make_programs(gl_renderer *gl, char *note) {
    for (int i = 0; i < VARIANT_COUNT; ++i) {
        const char *parts[4] = {fragment_head,
                                VARIANTS[i].two_sided ? fragment_two_sided : fragment_one_sided,
                                VARIANTS[i].lobe, fragment_main};
        gl->programs[i] = link_program(gl->job, parts, note);
        if (!gl->programs[i]) {
            return 0;
        }
        set_uniforms(gl->job, gl->programs[i]);
    }
    return 1;
}

/* samples 1: a plain renderbuffer. Returns 0 if the framebuffer is incomplete. */
static int make_framebuffer(const gl_renderer *gl, GLuint framebuffer, GLenum format, int samples) {
    const int count = samples > 1 ? samples : 0;
    const int width = gl->job->options.width, height = gl->job->options.height;
    GLuint buffers[2];
    glGenRenderbuffers(2, buffers);
    glBindRenderbuffer(GL_RENDERBUFFER, buffers[0]);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, count, GL_DEPTH_COMPONENT24, width, height);
    glBindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, count, format, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[0]);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[1]);
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

/* With several samples only LINEAR8. */
static int make_framebuffers(gl_renderer *gl, char *note) {
    const GLenum formats[TARGETS] = {GL_RGBA8, GL_SRGB8_ALPHA8, GL_RGBA32F};
    const int samples = gl->job->options.samples;
    int done = 1;
    glGenFramebuffers(TARGETS, gl->framebuffers);
    if (samples > 1) {
        glGenFramebuffers(1, &gl->resolved);
        done = make_framebuffer(gl, gl->resolved, formats[LINEAR8], 1);
    }
    for (int i = 0; done && i < (samples > 1 ? 1 : TARGETS); ++i) {
        done = make_framebuffer(gl, gl->framebuffers[i], formats[i], samples);
    }
    if (!done) {
        snprintf(note, BURNISH_PEERS_NOTE, "OpenGL: a framebuffer is not complete");
    }
    return done;
}

/* ---- Meshes ---- */

/* An array of 3 floats per vertex as attribute; remap: where vertices go, or NULL. Returns 0 if
 * memory is short. */
static int send_attribute(GLuint attribute, const float *vectors, size_t count,
                          const unsigned *remap) {
    GLuint buffer;
    float *moved = malloc(3 * count * sizeof *moved);
    if (!moved) {
        return 0;
    }
    if (remap) {
        meshopt_remapVertexBuffer(moved, vectors, count, 3 * sizeof(float), remap);
    } else {
        memcpy(moved, vectors, 3 * count * sizeof *moved);
    }
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(3 * count * sizeof *moved), moved, GL_STATIC_DRAW);
    glVertexAttribPointer(attribute, 3, GL_FLOAT, GL_FALSE, 0, NULL);
    glEnableVertexAttribArray(attribute);
    free(moved);
    return 1;
}

/* The vertices' colours in linear light. */
static int send_colors(const burnish_mesh_view *mesh, const unsigned *remap) {
    float *linear = malloc(3 * mesh->vertex_count * sizeof *linear);
    for (size_t i = 0; linear && i < mesh->vertex_count; ++i) {
        for (size_t k = 0; k < 3; ++k) {
            linear[3 * i + k] = burnish_srgb_decode((float)mesh->colors[4 * i + k] / 255);
        }
    }
    const int done = linear && send_attribute(2, linear, mesh->vertex_count, remap);
    free(linear);
    return done;
}

static int make_mesh(gl_renderer *gl, int order, const uint32_t *indices, const unsigned *remap) {
    const burnish_mesh_view *mesh = burnish_mesh_get_view(gl->job->scene);
    GLuint buffer;
    glGenVertexArrays(1, &gl->meshes[order]);
    glBindVertexArray(gl->meshes[order]);
    glGenBuffers(1, &buffer);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)(3 * mesh->triangle_count * sizeof *indices),
                 indices, GL_STATIC_DRAW);
    return send_attribute(0, mesh->positions, mesh->vertex_count, remap) &&
           send_attribute(1, mesh->normals, mesh->vertex_count, remap) &&
           (!mesh->colors || send_colors(mesh, remap));
}

/* Indices with the triangles of a material together, each material's in burnish's order: one draw
 * call each. */
static int sort_by_material(gl_renderer *gl, uint32_t *indices) {
    const burnish_mesh_view *mesh = burnish_mesh_get_view(gl->job->scene);
    const uint16_t *numbers = mesh->triangle_materials;
    gl->material_count = burnish_mesh_get_material_count(gl->job->scene);
    gl->ends = calloc(gl->material_count + 1, sizeof *gl->ends);
    if (!gl->ends) {
        return 0;
    }
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        gl->ends[(numbers ? numbers[i] : 0) + 1] += 3;
    }
    for (size_t m = 1; m <= gl->material_count; ++m) {
        gl->ends[m] += gl->ends[m - 1];
    }
    for (size_t i = 0; i < mesh->triangle_count; ++i) { /* starts become ends */
        size_t *at = &gl->ends[numbers ? numbers[i] : 0];
        memcpy(indices + *at, mesh->indices + 3 * i, 3 * sizeof *indices);
        *at += 3;
    }
    return 1;
}

/* The mesh in burnish's order and in the one that meshoptimizer makes for vertex caches. */
static int make_meshes(gl_renderer *gl) {
    const burnish_mesh_view *mesh = burnish_mesh_get_view(gl->job->scene);
    const size_t vertices = mesh->vertex_count, count = 3 * mesh->triangle_count;
    uint32_t *sorted = malloc(count * sizeof *sorted), *indices = malloc(count * sizeof *indices);
    unsigned *remap = malloc(vertices * sizeof *remap);
    int done = sorted && indices && remap && sort_by_material(gl, sorted) &&
               make_mesh(gl, ORDER_BURNISH, sorted, NULL);
    for (size_t m = 0; done && m < gl->material_count; ++m) {
        const size_t first = m ? gl->ends[m - 1] : 0;
        meshopt_optimizeVertexCache(indices + first, sorted + first, gl->ends[m] - first, vertices);
    }
    if (done) {
        meshopt_optimizeVertexFetchRemap(remap, indices, count, vertices);
        meshopt_remapIndexBuffer(indices, indices, count, remap);
        done = make_mesh(gl, ORDER_CACHE, indices, remap);
    }
    free(sorted);
    free(indices);
    free(remap);
    return done;
}

static void close_gl(void *state) {
    gl_renderer *gl = state;
    close_context();
    free(gl->ends);
    free(gl);
}

static void draw_materials(const gl_renderer *gl) {
    const int grey = is_grey(gl->job);
    for (size_t m = 0; m < gl->material_count; ++m) {
        const size_t first = m ? gl->ends[m - 1] : 0;
        const float *diffuse = burnish_mesh_get_material(gl->job->scene, m)->diffuse;
        if (grey) {
            glUniform1f(0, diffuse[0]);
        } else {
            glUniform3fv(0, 1, diffuse);
        }
        glDrawElements(GL_TRIANGLES, (GLsizei)(gl->ends[m] - first), GL_UNSIGNED_INT,
                       (const void *)(uintptr_t)(first * sizeof(uint32_t)));
    }
}

static void resolve(const gl_renderer *gl) {
    const int width = gl->job->options.width, height = gl->job->options.height;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, gl->resolved);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

static void draw(const gl_renderer *gl, GLuint program, int target, int cull, int order) {
    glBindFramebuffer(GL_FRAMEBUFFER, gl->framebuffers[target]);
    glUseProgram(program);
    if (cull) {
        glEnable(GL_CULL_FACE);
    } else {
        glDisable(GL_CULL_FACE);
    }
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glBindVertexArray(gl->meshes[order]);
    draw_materials(gl);
    if (gl->resolved) {
        resolve(gl);
    }
    glFinish();
}

/* Finds the faster order by drawing both in turns, where a frame is slow once. */
static void find_fastest(gl_renderer *gl) {
    enum { TURNS = 3, SLOW = 50 /* milliseconds */ };
    double shortest[ORDERS] = {INFINITY, INFINITY};
    for (int i = 0; i < TURNS * ORDERS && (i < ORDERS || shortest[0] < SLOW); ++i) {
        const int order = i % ORDERS;
        const double start = burnish_peers_now(gl->job);
        draw(gl, gl->programs[0], LINEAR8, 1, order);
        shortest[order] = fmin(shortest[order], burnish_peers_now(gl->job) - start);
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
    const char *missing = open_context();
    if (missing) {
        snprintf(note, BURNISH_PEERS_NOTE, "EGL: %s", missing);
        close_gl(gl);
        return 0;
    }
    if (!make_programs(gl, note) || !make_framebuffers(gl, note)) {
        close_gl(gl);
        return 0;
    }
    glEnable(GL_DEPTH_TEST);
    glViewport(0, 0, job->options.width, job->options.height);
    if (!make_meshes(gl)) {
        snprintf(note, BURNISH_PEERS_NOTE, "out of memory");
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
    double start = burnish_peers_now(gl->job);
    draw(gl, gl->programs[i], VARIANTS[i].target, !VARIANTS[i].two_sided, gl->fastest);
    *milliseconds = burnish_peers_now(gl->job) - start;
    return glGetError() == GL_NO_ERROR;
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
        /* OpenGL's first row is the lowest */
        const size_t row = BURNISH_PEERS_HEIGHT - 1 - p / BURNISH_PEERS_WIDTH;
        for (size_t k = 0; k < 3; ++k) {
            size_t from = 4 * (row * BURNISH_PEERS_WIDTH + p % BURNISH_PEERS_WIDTH) + k;
            rgb[3 * p + k] = encoded ? codes[from] : burnish_peers_srgb((double)values[from]);
        }
    }
    free(values);
    return glGetError() == GL_NO_ERROR;
}

int main(int count, char **arguments) {
    const burnish_peers_contestant contestant = {open_gl, frame, picture, close_gl};
    return burnish_peers_serve(&contestant, count, arguments);
}
