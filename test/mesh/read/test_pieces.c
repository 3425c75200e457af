/* Files that are read piece by piece: the same meshes, warnings and errors as of the same
 * bytes in memory, in less memory than the file has; also of a file that becomes shorter. */
#include <fcntl.h>
#include <stdarg.h>
#include <unistd.h>

#include "burnish/mesh.h"
#include "counting_context.h"
#include "mesh/read/io/pieces.h"
#include "mesh_arrays.h"
#include "support.h"
#include "used_bytes.h"

enum { SIDE = 100, VERTICES = SIDE * SIDE, TRIANGLES = 2 * (SIDE - 1) * (SIDE - 1) };

static uint8_t file[TRIANGLES * 256 + 4096];
static size_t file_size, faces_begin;
static char path[4096];

static void put(uint64_t bits, int size, int big_endian) {
    for (int i = 0; i < size; ++i) {
        file[file_size++] = (uint8_t)(bits >> 8 * (big_endian ? size - 1 - i : i));
    }
}

static void put_float(float value, int big_endian) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(bits, 4, big_endian);
}

static void put_double(double value, int big_endian) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(bits, 8, big_endian);
}

static float coordinate(uint32_t vertex, int axis) {
    return axis == 0   ? (float)(vertex % SIDE)
           : axis == 1 ? (float)(vertex / SIDE)
                       : (float)(vertex * vertex % 17) * 0.25f;
}

static uint32_t corner(uint32_t triangle, uint32_t k) {
    const uint32_t q = triangle / 2, a = q / (SIDE - 1) * SIDE + q % (SIDE - 1);
    const uint32_t corners[2][3] = {{a, a + 1, a + SIDE}, {a + 1, a + SIDE + 1, a + SIDE}};
    return corners[triangle % 2][k];
}

/* ---- Files ---- */

/* What a PLY has. */
typedef struct ply_kind {
    int big_endian, has_doubles, has_normals, has_colors, has_face_colors;
    const char *extra; /* a line of the header */
} ply_kind;

static void make_ply(const ply_kind *kind) {
    const char *type = kind->has_doubles ? "double" : "float";
    static const char colors[] = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    file_size = (size_t)snprintf(
        (char *)file, 2048,
        "ply\nformat binary_%s_endian 1.0\n%selement vertex %d\nproperty %s x\nproperty %s y\n"
        "property %s z\n%s%selement face %d\nproperty list uchar int vertex_indices\n%s"
        "end_header\n",
        kind->big_endian ? "big" : "little", kind->extra, VERTICES, type, type, type,
        kind->has_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "",
        kind->has_colors ? colors : "", TRIANGLES, kind->has_face_colors ? colors : "");
    for (uint32_t i = 0; i < VERTICES; ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            if (kind->has_doubles) {
                put_double(5e6 + (double)coordinate(i, axis), kind->big_endian);
            } else {
                put_float(coordinate(i, axis), kind->big_endian);
            }
        }
        for (int axis = 0; axis < 3 && kind->has_normals; ++axis) {
            put_float(axis == (int)(i % 3), kind->big_endian);
        }
        for (uint32_t k = 0; k < 3 && kind->has_colors; ++k) {
            put((i >> k) & 0xff, 1, 0);
        }
    }
    faces_begin = file_size;
    for (uint32_t i = 0; i < TRIANGLES; ++i) {
        put(3, 1, 0);
        for (uint32_t k = 0; k < 3; ++k) {
            put(corner(i, k), 4, kind->big_endian);
        }
        for (uint32_t k = 0; k < 3 && kind->has_face_colors; ++k) {
            put((i >> k) & 0xff, 1, 0);
        }
    }
}

static void make_stl(const char *title, int has_colors) {
    memset(file, 0, 80);
    memcpy(file, title, strlen(title));
    file_size = 80;
    put(TRIANGLES, 4, 0);
    for (uint32_t i = 0; i < TRIANGLES; ++i) {
        for (int k = 0; k < 3; ++k) {
            put_float(0, 0);
        }
        for (uint32_t k = 0; k < 9; ++k) {
            put_float(coordinate(corner(i, k / 3), (int)(k % 3)), 0);
        }
        put(has_colors ? 0x8000 | (i & 0x7fff) : 0, 2, 0);
    }
}

static int save(void) {
    FILE *to = fopen(path, "wb");
    return CHECK(to && fwrite(file, 1, file_size, to) == file_size && fclose(to) == 0,
                 "can't write %s", path);
}

/* ---- The same as of bytes in memory ---- */

static int same_mesh(const burnish_mesh *a, const burnish_mesh *b) {
    const size_t warnings = burnish_mesh_get_warning_count(a);
    int same = same_meshes(a, b) && warnings == burnish_mesh_get_warning_count(b) &&
               (!a || memcmp(burnish_mesh_get_view(a)->origin, burnish_mesh_get_view(b)->origin,
                             sizeof burnish_mesh_get_view(a)->origin) == 0);
    for (size_t i = 0; i < warnings && same; ++i) {
        same = strcmp(burnish_mesh_get_warning(a, i), burnish_mesh_get_warning(b, i)) == 0;
    }
    return same;
}

/* Loads the file and its bytes. A context's log must also be the same. */
static void check_same(const char *what, burnish_status expected) {
    static const int threads[] = {1, 2, 5};
    save();
    for (int i = 0; i < 3; ++i) {
        counts counted[2];
        burnish_mesh *meshes[2] = {NULL, NULL};
        burnish_error errors[2] = {{0}, {0}};
        burnish_status found[2];
        burnish_context *contexts[2];
        for (int k = 0; k < 2; ++k) {
            burnish_load_options options = burnish_load_options_default();
            contexts[k] = make_context(&counted[k]);
            options.context = contexts[k];
            options.threads = threads[i];
            found[k] = k == 0 ? burnish_mesh_load(path, &options, &meshes[0], &errors[0])
                              : burnish_mesh_load_memory(file, file_size, path, &options,
                                                         &meshes[1], &errors[1]);
        }
        CHECK(found[0] == expected && found[1] == expected, "%s: %d and %d, not %d: %s", what,
              (int)found[0], (int)found[1], (int)expected, errors[0].text);
        CHECK(same_mesh(meshes[0], meshes[1]), "%s, %d threads: another mesh", what, threads[i]);
        CHECK(strcmp(errors[0].text, errors[1].text) == 0, "%s: %s, not %s", what, errors[0].text,
              errors[1].text);
        CHECK(counted[0].lines == counted[1].lines, "%s: %d lines of a log, not %d", what,
              counted[0].lines, counted[1].lines);
        for (int k = 0; k < 2; ++k) {
            burnish_mesh_destroy(meshes[k]);
            burnish_context_destroy(contexts[k]);
            CHECK(atomic_load(&counted[k].live) == 0, "%s: not all was given back", what);
        }
    }
}

static const ply_kind kinds[] = {
    {0, 0, 0, 0, 0, ""}, {1, 0, 1, 0, 0, ""}, {0, 0, 1, 1, 0, ""},
    {1, 0, 0, 0, 1, ""}, {0, 1, 1, 0, 0, ""}, {0, 0, 0, 0, 0, "what is this\n"},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

static void test_ply(void) {
    for (int i = 0; i < KINDS; ++i) {
        char what[32];
        snprintf(what, sizeof what, "PLY %d", i);
        make_ply(&kinds[i]);
        check_same(what, BURNISH_STATUS_OK);
        file[file_size++] = '!';
        check_same("PLY, a byte more", BURNISH_STATUS_OK);
        file_size -= 2;
        check_same("PLY, a byte less", BURNISH_STATUS_FORMAT);
    }
}

/* Contents that need the whole file: a quad, a corner that is not a vertex or not a number. */
static void test_odd_ply(void) {
    static const size_t rows[] = {0, 1, TRIANGLES / 2, TRIANGLES - 1};
    for (int i = 0; i < 4; ++i) {
        make_ply(&kinds[0]);
        file[faces_begin + 13 * rows[i]] = 2;
        check_same("PLY, a face of two", i < 3 ? BURNISH_STATUS_FORMAT : BURNISH_STATUS_OK);
        make_ply(&kinds[0]);
        memset(file + faces_begin + 13 * rows[i] + 1, 0xff, 4);
        check_same("PLY, a bad corner", BURNISH_STATUS_FORMAT);
        make_ply(&kinds[0]);
        memset(file + faces_begin - 12 * (rows[i] % VERTICES + 1), 0xff, 4);
        check_same("PLY, no number", BURNISH_STATUS_FORMAT);
    }
    make_ply(&kinds[0]);
    memset(file, ' ', 1); /* " ly": no PLY by its bytes */
    check_same("no PLY", BURNISH_STATUS_FORMAT);
}

static void test_stl(void) {
    static const char *const titles[] = {"a part", "solid part", "COLOR=abcd", "ply\n", "glTF"};
    for (int i = 0; i < 5; ++i) {
        for (int has_colors = 0; has_colors < 2; ++has_colors) {
            make_stl(titles[i], has_colors);
            check_same(titles[i], BURNISH_STATUS_OK);
        }
    }
    make_stl("a part", 0);
    file[file_size++] = '!';
    check_same("STL, a byte more", BURNISH_STATUS_OK);
    file_size -= 2;
    check_same("STL, a byte less", BURNISH_STATUS_FORMAT);
    for (size_t facet = 0; facet < TRIANGLES; facet += TRIANGLES / 3) {
        make_stl("a part", 0);
        memset(file + 84 + 50 * facet + 12, 0xff, 8);
        check_same("STL, no number", BURNISH_STATUS_FORMAT);
    }
}

/* ---- Text ---- */

__attribute__((format(printf, 1, 2))) static void print(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    file_size +=
        (size_t)vsnprintf((char *)file + file_size, sizeof file - file_size, format, arguments);
    va_end(arguments);
}

/* Text for the middle of a file, and for its end. */
typedef struct oddity {
    const char *middle, *end;
    burnish_status status;
} oddity;

static int is_middle(uint32_t i) {
    return i == TRIANGLES / 2;
}

static void make_text_stl(const oddity *odd, const char *newline) {
    file_size = 0;
    print("solid sheet%s", newline);
    for (uint32_t i = 0; i < TRIANGLES; ++i) {
        print("%sfacet normal 0 0 1%s outer loop%s", is_middle(i) ? odd->middle : "", newline,
              newline);
        for (uint32_t k = 0; k < 3; ++k) {
            print("  vertex %g %.6e %g%s", (double)coordinate(corner(i, k), 0),
                  (double)coordinate(corner(i, k), 1), (double)coordinate(corner(i, k), 2),
                  newline);
        }
        print(" endloop%sendfacet%s", newline, newline);
    }
    print("%s", odd->end);
}

static void make_text_ply(const oddity *odd, const char *newline) {
    file_size = 0;
    print("ply%sformat ascii 1.0%selement vertex %d%sproperty float x%sproperty float y%s"
          "property float z%sproperty uchar red%sproperty uchar green%sproperty uchar blue%s"
          "element face %d%sproperty list uchar int vertex_indices%send_header%s",
          newline, newline, VERTICES, newline, newline, newline, newline, newline, newline, newline,
          TRIANGLES, newline, newline, newline);
    for (uint32_t i = 0; i < VERTICES; ++i) {
        print("%g %g %.5f %u 7 255%s", (double)coordinate(i, 0), (double)coordinate(i, 1),
              (double)coordinate(i, 2), i & 255, newline);
    }
    for (uint32_t i = 0; i < TRIANGLES; ++i) {
        print("3 %u %u %u%s%s", corner(i, 0), corner(i, 1), corner(i, 2),
              is_middle(i) ? odd->middle : "", newline);
    }
    print("%s", odd->end);
}

static void make_obj(const oddity *odd, const char *newline) {
    file_size = 0;
    print("# a sheet%s", newline);
    for (uint32_t i = 0; i < VERTICES; ++i) {
        print("v %g %g %.7f%svt %.4f .5%s", (double)coordinate(i, 0), (double)coordinate(i, 1),
              (double)coordinate(i, 2), newline, i / (double)VERTICES, newline);
    }
    for (uint32_t i = 0; i < TRIANGLES; ++i) {
        const uint32_t a = corner(i, 0) + 1, b = corner(i, 1) + 1, c = corner(i, 2) + 1;
        print("%sf %u/%u %u/%u -%u/%u%s", is_middle(i) ? odd->middle : "", a, a, b, b,
              VERTICES + 1 - c, c, newline);
    }
    print("%s", odd->end);
}

static void test_text(void) {
    static const char *const newlines[] = {"\n", "\r\n", "\r"};
    static const oddity stl[] = {
        {"", "endsolid\n", BURNISH_STATUS_OK},
        {"", "", BURNISH_STATUS_OK},
        {"endsolid a\nsolid facet\n", "endsolid\n \n", BURNISH_STATUS_OK},
        {"facet normal a b c outer loop vertex 1 2 3 vertex 3 4 5 vertex 9 9 1 endloop endfacet ",
         "endsolid", BURNISH_STATUS_OK},
        {"facet normal 0 0 0 outer loop vertex 1 2 x\n", "", BURNISH_STATUS_FORMAT},
        {"", "facet normal 0 0 0 outer", BURNISH_STATUS_FORMAT},
        {"", "endsolid\nsomething", BURNISH_STATUS_OK},
    };
    static const oddity ply[] = {
        {"", "", BURNISH_STATUS_OK},
        {"", "\n \n\n", BURNISH_STATUS_OK},
        {"", "something", BURNISH_STATUS_OK},
        {" 7", "", BURNISH_STATUS_OK},
        {"\n2 1 2\n", "", BURNISH_STATUS_OK},
        {"\n4 1 2 3 4\n", "", BURNISH_STATUS_OK},
        {"\n3 1 2 99999\n", "", BURNISH_STATUS_FORMAT},
    };
    static const oddity obj[] = {
        {"", "", BURNISH_STATUS_OK},
        {"usemtl a\n", "", BURNISH_STATUS_OK},
        {"what is this\n", "", BURNISH_STATUS_OK},
        {"f 1 2 \\\n 3 4\n", "", BURNISH_STATUS_OK},
        {"f 1 2\nl 1 2\ng a\n", "v 1 2 3", BURNISH_STATUS_OK},
        {"f 1 2 20000\n", "", BURNISH_STATUS_FORMAT},
        {"f 1//1 2//1 3//1\n", "vn 0 0 1\n", BURNISH_STATUS_OK},
        {"", "f 1 2 x", BURNISH_STATUS_FORMAT},
    };
    for (int i = 0; i < 3; ++i) {
        const size_t most = i == 0 ? SIZE_MAX : 2;
        for (size_t k = 0; k < sizeof stl / sizeof *stl && k < most; ++k) {
            make_text_stl(&stl[k], newlines[i]);
            check_same("ASCII STL", stl[k].status);
        }
        for (size_t k = 0; k < sizeof ply / sizeof *ply && k < most; ++k) {
            make_text_ply(&ply[k], newlines[i]);
            check_same("ASCII PLY", ply[k].status);
        }
        for (size_t k = 0; k < sizeof obj / sizeof *obj && k < most; ++k) {
            make_obj(&obj[k], newlines[i]);
            memcpy(strrchr(path, '.'), ".obj", 4);
            check_same("OBJ", obj[k].status);
            CHECK1(unlink(path) == 0);
            memcpy(strrchr(path, '.'), ".stl", 4);
        }
    }
}

/* ---- Memory ---- */

/* The most that a context hands out while the file is loaded, from its path or from memory. */
static size_t peak_of(int is_in_pieces) {
    used_bytes used;
    burnish_load_options options = burnish_load_options_default();
    burnish_context *context = make_counted(&used);
    burnish_mesh *mesh = NULL;
    burnish_error error = {0};
    used.refused = is_in_pieces ? file_size : 0;
    options.context = context;
    options.threads = 1;
    CHECK((is_in_pieces ? burnish_mesh_load(path, &options, &mesh, &error)
                        : burnish_mesh_load_memory(file, file_size, path, &options, &mesh,
                                                   &error)) == BURNISH_STATUS_OK,
          "%s", error.text);
    burnish_mesh_destroy(mesh);
    burnish_context_destroy(context);
    return atomic_load(&used.most);
}

/* A file that is loaded from its path takes its head or window more than from memory, where its
 * bytes are the caller's and not counted, and no array has its size. By one thread: the peak of
 * several depends on which of them work at the same time. */
static void check_memory(const char *what) {
    save();
    const size_t pieces = peak_of(1), whole = peak_of(0);
    CHECK(pieces <= whole + BURNISH_PIECES_HEAD, "%s of %zu bytes takes %zu, from memory %zu", what,
          file_size, pieces, whole);
}

static void test_memory(void) {
    static const oddity none = {"", "", BURNISH_STATUS_OK};
    make_stl("a part", 0);
    check_memory("binary STL");
    make_ply(&kinds[2]);
    check_memory("binary PLY");
    make_text_stl(&(oddity){"", "endsolid\n", BURNISH_STATUS_OK}, "\n");
    check_memory("ASCII STL");
    make_text_ply(&none, "\n");
    check_memory("ASCII PLY");
}

static burnish_status load_path(const void *data, const burnish_load_options *options,
                                burnish_mesh **mesh, burnish_error *error) {
    return burnish_mesh_load(data, options, mesh, error);
}

/* Each allocation fails once. */
static void test_allocations(void) {
    make_ply(&kinds[2]);
    save();
    check_failures(load_path, path, 2, 0);
}

/* ---- Files that change, descriptors ---- */

/* A file that is cut when the call first asks whether to go on. */
static int cut_file(void *user_data) {
    CHECK1(truncate(path, *(const off_t *)user_data) == 0);
    return 0;
}

static void test_cut(void) {
    for (off_t size = 0; size < 300000; size += 70000) {
        for (int i = 0; i < 3; ++i) {
            burnish_context_options made = burnish_context_options_default();
            burnish_load_options options = burnish_load_options_default();
            burnish_mesh *mesh = NULL;
            burnish_error error = {0};
            burnish_context *context = NULL;
            if (i == 0) {
                make_ply(&kinds[2]);
            } else if (i == 1) {
                make_stl("a part", 0);
            } else {
                make_text_stl(&(oddity){"", "endsolid\n", BURNISH_STATUS_OK}, "\n");
            }
            save();
            made.cancelled = cut_file;
            made.cancelled_user_data = &size;
            CHECK1(burnish_context_create(&made, &context, NULL) == BURNISH_STATUS_OK);
            options.context = context;
            options.threads = 1;
            const burnish_status status = burnish_mesh_load(path, &options, &mesh, &error);
            CHECK(status == BURNISH_STATUS_FORMAT && strstr(error.text, "truncated"),
                  "cut to %ld bytes: %d, %s", (long)size, (int)status, error.text);
            burnish_mesh_destroy(mesh);
            burnish_context_destroy(context);
        }
    }
}

/* A descriptor is read to its end; one that is elsewhere than at the beginning from there. */
static void test_descriptor(void) {
    make_stl("a part", 0);
    save();
    const int descriptor = open(path, O_RDONLY);
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = NULL;
    burnish_error error = {0};
    CHECK_OK(burnish_mesh_load_descriptor(descriptor, "a", &options, &mesh, &error), error);
    CHECK1(lseek(descriptor, 0, SEEK_CUR) == (off_t)file_size);
    burnish_mesh_destroy(mesh);
    CHECK1(lseek(descriptor, 50, SEEK_SET) == 50);
    CHECK(burnish_mesh_load_descriptor(descriptor, "a", &options, &mesh, &error) !=
              BURNISH_STATUS_OK,
          "the end of a file was read as all of it");
    burnish_mesh_destroy(mesh);
    CHECK1(close(descriptor) == 0);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    snprintf(path, sizeof path, TEST_BINARY_DIR "/pieces-%d.stl", (int)getpid());
    RUN(test_ply());
    RUN(test_odd_ply());
    RUN(test_stl());
    RUN(test_text());
    RUN(test_memory());
    RUN(test_allocations());
    RUN(test_cut());
    RUN(test_descriptor());
    CHECK1(unlink(path) == 0);
    return test_end("pieces");
}
