/* Files of a torus, in memory. If memory runs out, the program ends. */
#include "torus.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *take(void *pointer) {
    if (!pointer) {
        fputs("out of memory\n", stderr);
        exit(EXIT_FAILURE);
    }
    return pointer;
}

static void put(bytes *to, const void *from, size_t size) {
    if (to->capacity - to->size < size) {
        to->capacity = 2 * to->capacity + size + 4096;
        to->data = take(realloc(to->data, to->capacity));
    }
    memcpy(to->data + to->size, from, size);
    to->size += size;
}

__attribute__((format(printf, 2, 3))) static void print(bytes *to, const char *format, ...) {
    char line[256];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    put(to, line, (size_t)length);
}

static void put_floats(bytes *to, const double *values) {
    for (int i = 0; i < 3; ++i) {
        float value = (float)values[i];
        put(to, &value, sizeof value);
    }
}

torus make_torus(size_t grid) {
    torus made = {grid, take(malloc(grid * grid * 3 * sizeof(double))),
                  take(malloc(grid * grid * 3 * sizeof(double)))};
    const double turn = 6.283185307179586 / (double)grid;
    for (size_t i = 0; i < grid * grid; ++i) {
        double u = turn * (double)(i / grid), v = turn * (double)(i % grid);
        double *p = made.positions + 3 * i, *n = made.normals + 3 * i;
        n[0] = cos(u) * cos(v);
        n[1] = sin(u) * cos(v);
        n[2] = sin(v);
        p[0] = 20 * cos(u) + 7 * n[0];
        p[1] = 20 * sin(u) + 7 * n[1];
        p[2] = 7 * n[2];
    }
    return made;
}

/* Corners of a triangle, counted from 0. */
static void corners_of(const torus *t, size_t triangle, size_t corners[3]) {
    const size_t g = t->grid, row = triangle / 2 / g, column = triangle / 2 % g;
    const size_t right = (column + 1) % g, below = (row + 1) % g;
    corners[0] = row * g + column;
    corners[1] = triangle % 2 ? below * g + right : below * g + column;
    corners[2] = triangle % 2 ? row * g + right : below * g + right;
}

bytes write_obj(const torus *t, int digits, int normals, int coordinates) {
    bytes out = {0};
    for (size_t i = 0; i < t->grid * t->grid; ++i) {
        const double *p = t->positions + 3 * i, *n = t->normals + 3 * i;
        print(&out, "v %.*f %.*f %.*f\n", digits, p[0], digits, p[1], digits, p[2]);
        if (normals) {
            print(&out, "vn %.4f %.4f %.4f\n", n[0], n[1], n[2]);
        }
        if (coordinates) {
            print(&out, "vt %.6f %.6f\n", (double)(i / t->grid) / (double)t->grid,
                  (double)(i % t->grid) / (double)t->grid);
        }
    }
    for (size_t i = 0; i < 2 * t->grid * t->grid; ++i) {
        size_t c[3];
        corners_of(t, i, c);
        if (normals && coordinates) {
            print(&out, "f %zu/%zu/%zu %zu/%zu/%zu %zu/%zu/%zu\n", c[0] + 1, c[0] + 1, c[0] + 1,
                  c[1] + 1, c[1] + 1, c[1] + 1, c[2] + 1, c[2] + 1, c[2] + 1);
        } else if (normals) {
            print(&out, "f %zu//%zu %zu//%zu %zu//%zu\n", c[0] + 1, c[0] + 1, c[1] + 1, c[1] + 1,
                  c[2] + 1, c[2] + 1);
        } else {
            print(&out, "f %zu %zu %zu\n", c[0] + 1, c[1] + 1, c[2] + 1);
        }
    }
    return out;
}

bytes write_ply(const torus *t, int ascii, int normals) {
    const size_t vertices = t->grid * t->grid;
    bytes out = {0};
    print(&out,
          "ply\nformat %s 1.0\nelement vertex %zu\nproperty float x\nproperty float y\n"
          "property float z\n%s"
          "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
          ascii ? "ascii" : "binary_little_endian", vertices,
          normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "", 2 * vertices);
    for (size_t i = 0; i < vertices; ++i) {
        const double *p = t->positions + 3 * i, *n = t->normals + 3 * i;
        if (ascii) {
            print(&out, "%.6f %.6f %.6f", p[0], p[1], p[2]);
            if (normals) {
                print(&out, " %.6f %.6f %.6f", n[0], n[1], n[2]);
            }
            put(&out, "\n", 1);
        } else {
            put_floats(&out, p);
            if (normals) {
                put_floats(&out, n);
            }
        }
    }
    for (size_t i = 0; i < 2 * vertices; ++i) {
        size_t c[3];
        corners_of(t, i, c);
        if (ascii) {
            print(&out, "3 %zu %zu %zu\n", c[0], c[1], c[2]);
        } else {
            const int32_t row[3] = {(int32_t)c[0], (int32_t)c[1], (int32_t)c[2]};
            put(&out, "\3", 1);
            put(&out, row, sizeof row);
        }
    }
    return out;
}

bytes write_stl(const torus *t, int ascii) {
    const uint32_t count = (uint32_t)(2 * t->grid * t->grid);
    const char head[80] = {0};
    bytes out = {0};
    if (ascii) {
        print(&out, "solid torus\n");
    } else {
        put(&out, head, sizeof head);
        put(&out, &count, sizeof count);
    }
    for (size_t i = 0; i < count; ++i) {
        size_t c[3];
        corners_of(t, i, c);
        const double *n = t->normals + 3 * c[0];
        if (ascii) {
            print(&out, "facet normal %e %e %e\n  outer loop\n", n[0], n[1], n[2]);
        } else {
            put_floats(&out, n);
        }
        for (int k = 0; k < 3; ++k) {
            const double *p = t->positions + 3 * c[k];
            if (ascii) {
                print(&out, "    vertex %e %e %e\n", p[0], p[1], p[2]);
            } else {
                put_floats(&out, p);
            }
        }
        if (ascii) {
            print(&out, "  endloop\nendfacet\n");
        } else {
            put(&out, "\0", 2);
        }
    }
    if (ascii) {
        print(&out, "endsolid torus\n");
    }
    return out;
}

bytes write_glb(const torus *t) {
    const size_t vertices = t->grid * t->grid, indices = 6 * vertices;
    bytes out = {0};
    bytes json = {0};
    print(&json, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
                 "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
                 "{\"POSITION\":0,\"NORMAL\":1},\"indices\":2}]}],");
    print(&json,
          "\"buffers\":[{\"byteLength\":%zu}],\"bufferViews\":["
          "{\"buffer\":0,\"byteLength\":%zu},",
          24 * vertices + 4 * indices, 12 * vertices);
    print(&json,
          "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu},"
          "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}],\"accessors\":[",
          12 * vertices, 12 * vertices, 24 * vertices, 4 * indices);
    print(&json,
          "{\"bufferView\":0,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\","
          "\"min\":[-27,-27,-7],\"max\":[27,27,7]},",
          vertices);
    print(&json, "{\"bufferView\":1,\"componentType\":5126,\"count\":%zu,\"type\":\"VEC3\"},",
          vertices);
    print(&json, "{\"bufferView\":2,\"componentType\":5125,\"count\":%zu,\"type\":\"SCALAR\"}]}",
          indices);
    while (json.size % 4 != 0) {
        put(&json, " ", 1);
    }
    const uint32_t body = (uint32_t)(24 * vertices + 4 * indices);
    const uint32_t head[5] = {0x46546c67, 2, 28 + (uint32_t)json.size + body, (uint32_t)json.size,
                              0x4e4f534a};
    const uint32_t chunk[2] = {body, 0x004e4942};
    put(&out, head, sizeof head);
    put(&out, json.data, json.size);
    free(json.data);
    put(&out, chunk, sizeof chunk);
    for (size_t i = 0; i < vertices; ++i) {
        put_floats(&out, t->positions + 3 * i);
    }
    for (size_t i = 0; i < vertices; ++i) {
        put_floats(&out, t->normals + 3 * i);
    }
    for (size_t i = 0; i < 2 * vertices; ++i) {
        size_t c[3];
        corners_of(t, i, c);
        const uint32_t row[3] = {(uint32_t)c[0], (uint32_t)c[1], (uint32_t)c[2]};
        put(&out, row, sizeof row);
    }
    return out;
}

void torus_destroy(torus *t) {
    free(t->positions);
    free(t->normals);
}
