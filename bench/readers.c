/* Readers: megabytes per second from memory to triangles, per format and number of threads. Without
 * building the mesh. Usage: readers [GRID]     a torus of 2 GRID^2 triangles
 */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/mesh.h"

enum { RUNS = 7 };

typedef struct bytes {
    char *data;
    size_t size, capacity;
} bytes;

typedef struct mesh {
    size_t grid;
    double *positions, *normals; /* 3 per vertex, grid * grid vertices */
} mesh;

static void *take(void *pointer) {
    if (!pointer) {
        fputs("readers: out of memory\n", stderr);
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

static mesh make_torus(size_t grid) {
    mesh torus = {grid, take(malloc(grid * grid * 3 * sizeof(double))),
                  take(malloc(grid * grid * 3 * sizeof(double)))};
    const double turn = 6.283185307179586 / (double)grid;
    for (size_t i = 0; i < grid * grid; ++i) {
        double u = turn * (double)(i / grid), v = turn * (double)(i % grid);
        double *p = torus.positions + 3 * i, *n = torus.normals + 3 * i;
        n[0] = cos(u) * cos(v);
        n[1] = sin(u) * cos(v);
        n[2] = sin(v);
        p[0] = 20 * cos(u) + 7 * n[0];
        p[1] = 20 * sin(u) + 7 * n[1];
        p[2] = 7 * n[2];
    }
    return torus;
}

/* Corners of a triangle, counted from 0. */
static void corners_of(const mesh *torus, size_t triangle, size_t corners[3]) {
    const size_t g = torus->grid, row = triangle / 2 / g, column = triangle / 2 % g;
    const size_t right = (column + 1) % g, below = (row + 1) % g;
    corners[0] = row * g + column;
    corners[1] = triangle % 2 ? below * g + right : below * g + column;
    corners[2] = triangle % 2 ? row * g + right : below * g + right;
}

static bytes write_obj(const mesh *torus, int digits, int normals) {
    bytes out = {0};
    for (size_t i = 0; i < torus->grid * torus->grid; ++i) {
        const double *p = torus->positions + 3 * i, *n = torus->normals + 3 * i;
        print(&out, "v %.*f %.*f %.*f\n", digits, p[0], digits, p[1], digits, p[2]);
        if (normals) {
            print(&out, "vn %.4f %.4f %.4f\n", n[0], n[1], n[2]);
        }
    }
    for (size_t i = 0; i < 2 * torus->grid * torus->grid; ++i) {
        size_t c[3];
        corners_of(torus, i, c);
        if (normals) {
            print(&out, "f %zu//%zu %zu//%zu %zu//%zu\n", c[0] + 1, c[0] + 1, c[1] + 1, c[1] + 1,
                  c[2] + 1, c[2] + 1);
        } else {
            print(&out, "f %zu %zu %zu\n", c[0] + 1, c[1] + 1, c[2] + 1);
        }
    }
    return out;
}

static bytes write_ply(const mesh *torus, int ascii) {
    const size_t vertices = torus->grid * torus->grid;
    bytes out = {0};
    print(&out,
          "ply\nformat %s 1.0\nelement vertex %zu\nproperty float x\nproperty float y\n"
          "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
          "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
          ascii ? "ascii" : "binary_little_endian", vertices, 2 * vertices);
    for (size_t i = 0; i < vertices; ++i) {
        const double *p = torus->positions + 3 * i, *n = torus->normals + 3 * i;
        if (ascii) {
            print(&out, "%.6f %.6f %.6f %.6f %.6f %.6f\n", p[0], p[1], p[2], n[0], n[1], n[2]);
        } else {
            put_floats(&out, p);
            put_floats(&out, n);
        }
    }
    for (size_t i = 0; i < 2 * vertices; ++i) {
        size_t c[3];
        corners_of(torus, i, c);
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

static bytes write_stl(const mesh *torus, int ascii) {
    const uint32_t count = (uint32_t)(2 * torus->grid * torus->grid);
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
        corners_of(torus, i, c);
        const double *n = torus->normals + 3 * c[0];
        if (ascii) {
            print(&out, "facet normal %e %e %e\n  outer loop\n", n[0], n[1], n[2]);
        } else {
            put_floats(&out, n);
        }
        for (int k = 0; k < 3; ++k) {
            const double *p = torus->positions + 3 * c[k];
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

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void bench(const char *name, bytes input) {
    static const int THREADS[] = {1, 2, 4};
    printf("%-34s %8.1f MB ", name, (double)input.size / 1e6);
    for (size_t t = 0; t < sizeof THREADS / sizeof *THREADS; ++t) {
        burnish_load_options options = burnish_load_options_default();
        double seconds[RUNS];
        options.threads = THREADS[t];
        for (int i = 0; i < RUNS; ++i) {
            burnish_mesh *scene;
            burnish_error error;
            if (burnish_mesh_load_memory(input.data, input.size, "torus", &options, &scene,
                                         &error) != BURNISH_STATUS_OK) {
                fprintf(stderr, "readers: %s\n", error.text);
                exit(EXIT_FAILURE);
            }
            seconds[i] = burnish_mesh_get_info(scene)->read_seconds;
            burnish_mesh_destroy(scene);
        }
        qsort(seconds, RUNS, sizeof *seconds, compare_doubles);
        printf(" %9.0f %9.0f", (double)input.size / 1e6 / seconds[RUNS / 2],
               (double)input.size / 1e6 / seconds[0]);
    }
    putchar('\n');
    free(input.data);
}

int main(int count, char **arguments) {
    const long grid = count > 1 ? strtol(arguments[1], NULL, 10) : 400;
    if (grid < 3 || grid > 20000) {
        fputs("readers: GRID must be a number from 3 to 20000\n", stderr);
        return EXIT_FAILURE;
    }
    mesh torus = make_torus((size_t)grid);
    printf("%-34s %11s  %19s %19s %19s\n", "readers, MB/s: median and best", "", "1 thread",
           "2 threads", "4 threads");
    bench("OBJ, 6 decimals", write_obj(&torus, 6, 0));
    bench("OBJ, 6 decimals, normals", write_obj(&torus, 6, 1));
    bench("OBJ, 17 decimals", write_obj(&torus, 17, 0));
    bench("ASCII STL", write_stl(&torus, 1));
    bench("binary STL", write_stl(&torus, 0));
    bench("ASCII PLY, normals", write_ply(&torus, 1));
    bench("binary PLY, normals", write_ply(&torus, 0));
    free(torus.positions);
    free(torus.normals);
    return EXIT_SUCCESS;
}
