/* Files of every format, read in every way, must give the mesh or the error of the plain reading: by
 * several threads, in chunks of any size, from a path in pieces, with failing allocations, truncated
 * and damaged. The files are a sheet in each format and the seeds of the fuzzer. */
#include <dirent.h>
#include <unistd.h>

#include "counting_context.h"
#include "mesh/read/io/streaming.h"
#include "mesh_arrays.h"
#include "reader_input.h"
#include "sheet.h"
#include "zip_input.h"

/* Sides of sheets. Files of a large one are read in pieces, which sanitizers' builds have small; a
 * huge one has more rows than the readers of binary files take at once. */
enum { SMALL = 9, LARGE = BURNISH_STREAMED_HEAD < 65536 ? 32 : 100, MANY = LARGE * 3 / 2 };

#ifdef BURNISH_MSAN
enum { HAS_MSAN = 1 }; /* expat is not built with it */
#else
enum { HAS_MSAN = 0 };
#endif

typedef enum expectation { ANYTHING /* all readings agree */, GOOD, BROKEN } expectation;

typedef struct input {
    char name[64];
    burnish_format format;
    file_bytes file;
    const char *library; /* OBJ: material library; NULL: two materials */
    int is_golden;       /* 1: if it is good, its mesh has a golden hash */
} input;

static char path[4096];
static size_t every = 1; /* --every N: an N-th of truncations, flipped bits and mutations */

/* ---- The plain reading ---- */

static const char *library_text;

static burnish_status open_library(void *user_data, const char *file, uint64_t max_bytes,
                                   const void **bytes, size_t *size, burnish_error *error) {
    (void)user_data, (void)max_bytes;
    if (strncmp(file, "missing", 7) == 0) {
        return burnish_fail(error, BURNISH_STATUS_READ, "%s: not here", file);
    }
    *bytes = library_text ? library_text : "newmtl a\nKd 0.5 0 1\nnewmtl red\nKd 1 0 0\nNs 0.5\n";
    *size = strlen(*bytes);
    return BURNISH_STATUS_OK;
}

static uint64_t hash_mesh(const burnish_mesh_data *mesh) {
    uint64_t hash = UINT64_C(0xCBF29CE484222325);
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        const burnish_stream *stream = &mesh->streams[i];
        const size_t size = burnish_attribute_size((burnish_attribute)i);
        hash =
            test_add_words(hash, stream->items, stream->count * size, i == BURNISH_COLOR ? 1 : 4);
        hash = test_add_words(hash, stream->corners, 12 * mesh->triangle_count, 4);
    }
    for (size_t i = 0; i < mesh->material_count; ++i) {
        hash = test_add_words(hash, mesh->materials[i].diffuse, 12, 4);
    }
    return test_add_words(hash, mesh->triangle_materials, 2 * mesh->triangle_count, 2);
}

/* test/golden/meshes.txt has a line "HASH NAME" for each file. After a deliberate change, take the
 * new line from the message. */
static void check_golden(const char *name, const burnish_mesh_data *mesh) {
    char line[160], expected[160];
    int found = 0;
    FILE *list = fopen(TEST_SOURCE_DIR "/test/golden/meshes.txt", "r");
    snprintf(expected, sizeof expected, "%016llx %.100s\n", (unsigned long long)hash_mesh(mesh),
             name);
    while (list && !found && fgets(line, sizeof line, list)) {
        found = strcmp(line, expected) == 0;
    }
    if (list) {
        fclose(list);
    }
    CHECK(found, "test/golden/meshes.txt has no line \"%.*s\"", (int)strlen(expected) - 1,
          expected);
}

/* ---- Ways to read ---- */

/* Reads by one thread in one chunk, then by `threads` threads in chunks of the sizes. */
static burnish_status check_chunks(const input *in, expectation expected, const int *threads,
                                   const size_t *sizes) {
    const burnish_load_options options = burnish_load_options_default();
    reader_run run = {in->format,   in->file.bytes, in->file.size,  &options,
                      open_library, NULL,           (size_t)1 << 30};
    burnish_mesh_data mesh;
    burnish_error error;
    library_text = in->library;
    const burnish_status status = read_as(&run, &mesh, &error);
    CHECK(expected == ANYTHING || (expected == BROKEN) == (status != BURNISH_STATUS_OK),
          "%s: status %d, \"%s\"", in->name, (int)status, error.text);
    CHECK(is_sound(status, &mesh, &error), "%s: status %d, \"%s\"", in->name, (int)status,
          error.text);
    if (in->is_golden && status == BURNISH_STATUS_OK) {
        check_golden(in->name, &mesh);
    }
    for (; *threads; ++threads) {
        burnish_tasks tasks;
        burnish_tasks_begin(&tasks, NULL, *threads);
        run.tasks = &tasks;
        for (const size_t *size = sizes; *size; ++size) {
            run.chunk_size = *size;
            check_same_reading(in->name, &run, status, &mesh, &error);
        }
    }
    burnish_mesh_data_destroy(&mesh);
    return status;
}

static burnish_status check_all_chunks(const input *in, expectation expected) {
    static const int threads[] = {1, 2, 7, 0};
    static const size_t sizes[] = {1, 16, 64, 101, 256, 1000, 4096, 0};
    return check_chunks(in, expected, threads, sizes);
}

static burnish_status check_some_chunks(const input *in, expectation expected) {
    return check_chunks(in, expected, (const int[]){1, 7, 0}, (const size_t[]){64, 4096, 0});
}

static void save(const input *in) {
    char *extension = strrchr(path, '.');
    sprintf(extension, ".%s", burnish_format_get_info(in->format)->name);
    save_bytes(path, &in->file);
}

static int has_same_texts(const burnish_mesh *a, const burnish_mesh *b) {
    const size_t warnings = burnish_mesh_get_warning_count(a);
    int is_same = warnings == burnish_mesh_get_warning_count(b) &&
                  (!a || memcmp(burnish_mesh_get_view(a)->origin, burnish_mesh_get_view(b)->origin,
                                sizeof burnish_mesh_get_view(a)->origin) == 0);
    for (size_t i = 0; i < warnings && is_same; ++i) {
        is_same = strcmp(burnish_mesh_get_warning(a, i), burnish_mesh_get_warning(b, i)) == 0;
    }
    return is_same;
}

/* Loads the file and its bytes. A context's log must also be the same. */
static void check_source(const input *in, expectation expected) {
    static const int threads[] = {1, 5};
    save(in);
    for (int i = 0; i < 2; ++i) {
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
            options.ignore_referenced_files = 1; /* they are next to the file alone */
            found[k] = k == 0 ? burnish_mesh_load(path, &options, &meshes[0], &errors[0])
                              : burnish_mesh_load_memory(in->file.bytes, in->file.size, path,
                                                         &options, &meshes[1], &errors[1]);
        }
        CHECK(found[0] == found[1] &&
                  (expected == ANYTHING || (expected == BROKEN) == (found[0] != BURNISH_STATUS_OK)),
              "%s: %d and %d: %s", in->name, (int)found[0], (int)found[1], errors[0].text);
        CHECK(same_meshes(meshes[0], meshes[1]) && has_same_texts(meshes[0], meshes[1]) &&
                  strcmp(errors[0].text, errors[1].text) == 0 &&
                  counted[0].lines == counted[1].lines,
              "%s, %d threads: another result from the file: %s, not %s", in->name, threads[i],
              errors[0].text, errors[1].text);
        for (int k = 0; k < 2; ++k) {
            burnish_mesh_destroy(meshes[k]);
            burnish_context_destroy(contexts[k]);
            CHECK(atomic_load(&counted[k].live) == 0, "%s: not all was given back", in->name);
        }
    }
    CHECK1(unlink(path) == 0);
}

/* ---- Damage ---- */

/* Changes bytes of a good file, a few at a time. */
static void check_mutations(input *in, int count) {
    static const char letters[] = "\n\r\\ \t#vf/+-.e0123456789ENDFACOLPI";
    uint64_t random = test_seed(in->file.size);
    in->is_golden = 0;
    for (int i = 0; i < count; i += (int)every) {
        const int bytes = 1 + i % 3;
        size_t at[3];
        uint8_t old[3];
        for (int k = 0; k < bytes; ++k) {
            at[k] = test_random64(&random) % in->file.size;
            old[k] = in->file.bytes[at[k]];
            in->file.bytes[at[k]] = (uint8_t)letters[test_random32(&random) % (sizeof letters - 1)];
        }
        check_some_chunks(in, ANYTHING);
        for (int k = bytes - 1; k >= 0; --k) {
            in->file.bytes[at[k]] = old[k];
        }
    }
}

/* Every truncation, and every byte with a bit changed, in formats of bytes each bit: an error of one
 * line, or a valid mesh. */
static void check_damage(input *in) {
    static const int none[] = {0};
    const size_t size = in->file.size;
    uint64_t start = test_seed(size);
    const int announces = in->format == BURNISH_FORMAT_BMS || in->format == BURNISH_FORMAT_3MF ||
                          memcmp(in->file.bytes, "glTF", 4) == 0;
    in->is_golden = 0;
    for (size_t i = start % every; i < size; i += every) {
        in->file.size = i;
        check_chunks(in, announces && i + 4 < size ? BROKEN : ANYTHING, none, NULL);
        in->file.size = size;
        for (size_t bit = announces ? 0 : i % 8; bit < (announces ? 8 : i % 8 + 1); ++bit) {
            in->file.bytes[i] ^= (uint8_t)(1 << bit);
            check_chunks(in, ANYTHING, none, NULL);
            in->file.bytes[i] ^= (uint8_t)(1 << bit);
        }
    }
}

static burnish_status load_file(const void *data, const burnish_load_options *options,
                                burnish_mesh **mesh, burnish_error *error) {
    (void)data;
    return burnish_mesh_load(path, options, mesh, error);
}

/* ---- Seeds ---- */

/* The file after the four bytes for the fuzzer. A byte 0 ends an OBJ or a scene, and its library follows, or a
 * model of 3MF that has no archive yet, and another part follows. */
static int open_seed(const char *folder, const char *name, input *in) {
    char from[4500];
    uint8_t bytes[8192];
    snprintf(from, sizeof from, "%s/%s", folder, name);
    FILE *file = fopen(from, "rb");
    size_t size = file ? fread(bytes, 1, sizeof bytes - 1, file) : 0;
    if (file) {
        fclose(file);
    }
    if (*name == '.' || size <= 4) {
        return 0;
    }
    bytes[size] = 0;
    snprintf(in->name, sizeof in->name, "seed %s/%.40s", strrchr(folder, '/') + 1, name);
    in->file.size = 0;
    in->library = NULL;
    in->is_golden = 1;
    add(&in->file, bytes + 4, size - 3);
    in->file.size -= 1;
    const char *text = (const char *)in->file.bytes, *rest = text + strnlen(text, size - 4);
    const size_t more = (size_t)(text + size - 4 - rest);
    const int has_library = in->format == BURNISH_FORMAT_OBJ ||
                            in->format == BURNISH_FORMAT_SCENE || in->format == BURNISH_FORMAT_URDF;
    if (has_library && more > 0) {
        in->library = rest + 1;
        in->file.size = (size_t)(rest - text);
    } else if (in->format == BURNISH_FORMAT_3MF && memcmp(text, "PK", 2) != 0) {
        const zip_list *zip = pack_parts(text, size - 4);
        in->file.size = 0;
        add(&in->file, zip->bytes, zip->size);
    }
    return 1;
}

static void check_seed(input *in) {
    burnish_mesh *mesh;
    check_all_chunks(in, ANYTHING);
    check_source(in, ANYTHING);
    check_damage(in);
    if (in->format <= BURNISH_FORMAT_STL) {
        check_mutations(in, 200);
    }
    save(in);
    if (burnish_mesh_load(path, NULL, &mesh, NULL) == BURNISH_STATUS_OK) {
        check_failures(load_file, NULL, 1, 0);
        check_failures(load_file, NULL, 2, 0);
    }
    burnish_mesh_destroy(mesh);
    CHECK1(unlink(path) == 0);
}

static void check_seeds(const char *seeds, burnish_format format) {
    char folder[4200];
    snprintf(folder, sizeof folder, "%s/%s", seeds, burnish_format_get_info(format)->name);
    DIR *list = opendir(folder);
    input in = {.format = format};
    int count = 0;
    for (struct dirent *entry; list && (entry = readdir(list)) != NULL;) {
        if (open_seed(folder, entry->d_name, &in)) {
            check_seed(&in);
            ++count;
        }
    }
    CHECK(count > 0, "no seeds in %s", folder);
    if (list) {
        closedir(list);
    }
    free(in.file.bytes);
}

static void test_seeds(void) {
    char folder[4100], command[9000];
    snprintf(folder, sizeof folder, TEST_BINARY_DIR "/seeds-%d", (int)getpid());
    snprintf(command, sizeof command, "sh '" TEST_SOURCE_DIR "/test/fuzz/seeds' '%s'", folder);
    CHECK(system(command) == 0, "%s", command);
    for (burnish_format i = BURNISH_FORMAT_GLTF; i < BURNISH_FORMAT_COUNT; ++i) {
        if (!HAS_MSAN || (i != BURNISH_FORMAT_3MF && i != BURNISH_FORMAT_URDF)) {
            check_seeds(folder, i);
        }
    }
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    CHECK1(system(command) == 0);
}

/* ---- Sheets ---- */

#define F "facet normal 0 0 1 outer loop "
#define V "vertex 1 2 "

/* How a format is written, with lines for the middle of a file that are read, ignored or left out,
 * lines that are errors, and ends. */
static const struct {
    burnish_format format;
    void (*write)(file_bytes *file, const sheet *s);
    const char *good[20], *broken[14], *ends[8];
} writers[] = {
    {BURNISH_FORMAT_OBJ,
     write_obj,
     {"what is this\n", "f 1 2 \\\n 3 4\n", "f 1 2\nl 1 2\ng a\n", "f 1 2 3//9999999\n",
      "mtllib missing2.mtl\nusemtl a\nf -1 -2 -3\nusemtl red\n",
      "v 1 2 3 4 5\nv 1 2 3 1 1 x\nvn 1 2\nvn 1 2 x\n",
      "l 1 2 3\np 1\nusemtl \x01\nvp 1 2\ns off\n#\nf\n# a\r\rvn\n", "v 1 2\n", "v 1 2 nan\n",
      "v 1e39 0 0\n", "v a b c\n", "v\n", "f 1 2 0\n", "f 1 2 20000\n", "f 1 2 -99999999\n",
      "f 1 2 3x\n", "f 1 2 3/4/5/6\n", "f 1\x01 2 3\n", "v 1,5 2 3\nf 1 2 3.0\n"},
     {NULL},
     {"v 1 2 3", "vn 0 0 1\n", "f 1 2 3 \\", "# a\rv 0 0 0\n", "f 1 2 x"}},
    {BURNISH_FORMAT_OFF,
     write_off,
     {"3 0 1 2\n", "3 1 2 99999\n", "3 1 2 x\n"},
     {NULL},
     {"\n# c\n", "something"}},
    {BURNISH_FORMAT_PLY,
     write_ply,
     {"3 1 2 3 4\n", "2 1 2\n", "4 1 2 3 4\n", "0\n", "\n3 0 1 2\n", "3 1 2 99999\n", "3 1 2 -1\n",
      "3 1 1.5 2\n"},
     {"-1 1 2 3\n", "3 1 2\n", "99999 1 2\n", "2.5 1 2 3\n"},
     {"\n \n\n", "something", "3\r1 2 3\n"}},
    {BURNISH_FORMAT_STL,
     write_stl,
     {"endsolid a\nsolid facet\n", "endsolid facet 1 2 3\nsolid\nendsolid\n\n \nsolid facet\n",
      "facet normal a b c outer loop " V "3 " V "5 " V "1 endloop endfacet "},
     {F V "x\n", F V "3 4\n", F V "\n", F V "inf\n", F "vertex 1e39 0 0\n", F V "3x\n",
      F "endsolid\n", F "solid\n", F "facet\n", F "endfacet\n", "vertex\n",
      "facet normal 0 0 odd words without corners\nendfacet\n"},
     {"endsolid\n", "", "endsolid\n \n", "endsolid\nsomething",
      "endsolid ENDFACE\nsolid Ndfa\nendsolid\n", F}},
};
enum { WRITERS = sizeof writers / sizeof *writers };

static const double far_away[3] = {5e6, 5e6, 5e6};
static const sheet plans[] = {
    {.newline = "\n"},
    {.newline = "\r\n", .normals = 1, .quads = 1},
    {.newline = "\r", .colors = 1},
    {.newline = " \n", .normals = 1, .colors = 2, .quads = 1},
    {.newline = "\n", .colors = 3, .shift = far_away},
};
enum { PLANS = sizeof plans / sizeof *plans };

static void test_sheets(int writer) {
    input in = {.format = writers[writer].format};
    for (int i = 0; i < PLANS; ++i) {
        sheet s = plans[i];
        s.side = SMALL;
        in.file.size = 0;
        in.is_golden = 1;
        snprintf(in.name, sizeof in.name, "sheet %d.%s", i,
                 burnish_format_get_info(in.format)->name);
        writers[writer].write(&in.file, &s);
        check_all_chunks(&in, GOOD);
        check_mutations(&in, 60);
        s.side = LARGE;
        in.file.size = 0;
        snprintf(in.name, sizeof in.name, "large %s", s.newline);
        writers[writer].write(&in.file, &s);
        check_chunks(&in, GOOD, (const int[]){3, 0}, (const size_t[]){4096, 0});
        check_source(&in, GOOD);
    }
    free(in.file.bytes);
}

static void check_oddity(int writer, const sheet *odd, expectation expected) {
    input in = {.format = writers[writer].format};
    snprintf(in.name, sizeof in.name, "%.30s|%.30s", odd->middle ? odd->middle : "",
             odd->end ? odd->end : "");
    writers[writer].write(&in.file, odd);
    if (odd->side == SMALL) {
        check_all_chunks(&in, expected);
    } else {
        check_source(&in, expected);
    }
    free(in.file.bytes);
}

static void test_oddities(int writer) {
    enum { MOST_BROKEN = 4 }; /* large files: they are read again in memory, whatever is wrong */
    for (int side = SMALL; side <= LARGE; side += LARGE - SMALL) {
        sheet s = {.side = side, .newline = "\n"};
        for (int i = 0; (s.end = writers[writer].ends[i]) != NULL; ++i) {
            check_oddity(writer, &s, ANYTHING);
        }
        for (int i = 0; (s.middle = writers[writer].good[i]) != NULL; ++i) {
            check_oddity(writer, &s, GOOD);
        }
        for (int i = 0;
             (s.middle = writers[writer].broken[i]) != NULL && (side == SMALL || i < MOST_BROKEN);
             ++i) {
            check_oddity(writer, &s, BROKEN);
        }
    }
}

/* ---- Binary files ---- */

static const ply_layout layouts[] = {
    {"uchar", "int", 1, 4, 0, 0},    {"uint8", "uint32", 1, 4, 1, 0}, {"int", "int", 4, 4, 0, 0},
    {"uchar", "ushort", 1, 2, 0, 0}, {"ushort", "uint", 2, 4, 1, 1},  {"uchar", "int", 1, 4, 0, 1},
};
enum { LAYOUTS = sizeof layouts / sizeof *layouts };

/* A binary PLY has the mesh of the one in text. */
static void check_layout(const input *in, const sheet *s) {
    const burnish_load_options options = burnish_load_options_default();
    file_bytes text = {0};
    burnish_mesh_data mesh;
    burnish_error error;
    write_ply(&text, s);
    reader_run run = {BURNISH_FORMAT_PLY, text.bytes, text.size, &options, NULL, NULL, 0};
    CHECK_OK(read_as(&run, &mesh, &error), error);
    run.bytes = in->file.bytes;
    run.size = in->file.size;
    for (int threads = 1; threads < 8; threads += 3) {
        burnish_tasks tasks;
        burnish_tasks_begin(&tasks, NULL, threads);
        run.tasks = &tasks;
        check_same_reading(in->name, &run, BURNISH_STATUS_OK, &mesh, &(burnish_error){0});
    }
    burnish_mesh_data_destroy(&mesh);
    free(text.bytes);
}

/* Contents that need the whole file: a face of two, a corner that is not a vertex or a number. */
static void check_odd_ply(input *in, const sheet *s) {
    for (size_t i = 0; i < 4; ++i) {
        const size_t last = 2 * sheet_squares(s) - 1, rows[] = {0, 1, last / 2, last};
        for (int kind = 0; kind < 3; ++kind) {
            in->file.size = 0;
            const size_t faces = write_binary_ply(&in->file, s, &layouts[0]);
            uint8_t *row = in->file.bytes + faces + 13 * rows[i];
            if (kind == 0) {
                *row = 2;
            } else {
                memset(kind == 1 ? row + 1 : in->file.bytes + faces - 12 * (i + 1), 0xff, 4);
            }
            snprintf(in->name, sizeof in->name, "PLY, fault %d in row %zu", kind, rows[i]);
            check_source(in, kind > 0 || i == 3 ? GOOD : BROKEN);
        }
    }
}

static void test_binary_ply(void) {
    input in = {.format = BURNISH_FORMAT_PLY};
    for (int i = 0; i < 2 * LAYOUTS; ++i) { /* each layout with two plans */
        const ply_layout *how = &layouts[i / 2];
        sheet s = plans[(i / 2 + i % 2) % PLANS];
        s.newline = "\n";
        s.side = MANY;
        snprintf(in.name, sizeof in.name, "PLY %d.%d", i / 2, i % 2);
        in.file.size = 0;
        write_binary_ply(&in.file, &s, how);
        if (!s.shift || how->has_doubles) {
            check_layout(&in, &s);
        }
        check_source(&in, GOOD);
        if (i % 2 == 0) {
            add(&in.file, "!", 1);
            check_source(&in, GOOD);
            in.file.size -= 2 + (size_t)(3 * i);
            check_source(&in, BROKEN);
        }
    }
    check_odd_ply(&in, &(sheet){.side = MANY, .newline = "\n"});
    free(in.file.bytes);
}

static void test_binary_stl(void) {
    static const char *const titles[] = {"glTF", "solid part", "COLOR=abcd", "ply\n", "a part"};
    const size_t count = (size_t)2 * (MANY - 1) * (MANY - 1);
    input in = {.format = BURNISH_FORMAT_STL};
    for (int i = 0; i < 10; ++i) {
        const sheet s = {.side = MANY, .colors = i % 2};
        in.file.size = 0;
        snprintf(in.name, sizeof in.name, "STL %s", titles[i / 2]);
        write_binary_stl(&in.file, &s, titles[i / 2]);
        check_some_chunks(&in, GOOD);
        check_source(&in, GOOD);
    }
    add(&in.file, "!", 1);
    check_source(&in, GOOD);
    in.file.size -= 2;
    check_source(&in, BROKEN);
    in.file.size += 1;
    for (size_t facet = 0; facet < count; facet += count / 3) {
        memset(in.file.bytes + 84 + 50 * facet + 12, 0xff, 8);
        check_source(&in, GOOD);
        CHECK1(burnish_may_be(BURNISH_FORMAT_AUTO, in.file.bytes, 1 << 16, "-")); /* a pipe */
    }
    free(in.file.bytes);
}

/* ---- Odd shapes ---- */

/* More blank lines than a chunk has bytes, in a facet or after it; lines longer than a chunk, also
 * joined; normals that nothing uses and colours of the first vertices of a chunk alone. */
static void test_shapes(void) {
    enum { ROOM = 1 << 15 };
    input in = {.format = BURNISH_FORMAT_STL};
    static char blank[4 * ROOM + 1];
    memset(blank, '\n', sizeof blank - 1);
    for (int within = 0; within < 2; ++within) {
        in.file.size = 0;
        say(&in.file, "solid\n");
        for (int i = 0; i < 3; ++i) {
            add(&in.file, blank, within ? 0 : sizeof blank - 1);
            say(&in.file, F "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n");
            add(&in.file, blank, within ? sizeof blank - 1 : 0);
            say(&in.file, "endloop\nendfacet\n");
        }
        say(&in.file, "endsolid\n");
        check_some_chunks(&in, GOOD);
    }
    in.format = BURNISH_FORMAT_OBJ;
    in.file.size = 0;
    say(&in.file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf");
    while (in.file.size < ROOM) {
        say(&in.file, " %zu%s", 1 + in.file.size % 3, in.file.size % 97 ? "" : "\\\r\n");
    }
    say(&in.file, "\nv 0 0 1\nf 1 2 4\n#");
    while (in.file.size < 2 * ROOM) {
        say(&in.file, "                                       \\");
    }
    say(&in.file, "\nf -1 -2 -3\n");
    check_some_chunks(&in, GOOD);
    in.file.size = 0;
    while (in.file.size < ROOM) {
        say(&in.file, "vn 0 0 1\nv 0 0 0 1 # . .\nv 1 0 0\nv 0 %zu 1\nf -1 -2 -3\n", in.file.size);
    }
    check_some_chunks(&in, GOOD);
    free(in.file.bytes);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, "--every");
    every = test_option() ? (size_t)atoi(test_option()) : every;
    snprintf(path, sizeof path, TEST_BINARY_DIR "/conditions-%d.x", (int)getpid());
    RUN(test_seeds());
    for (int i = 0; i < WRITERS; ++i) {
        RUN(test_sheets(i));
        RUN(test_oddities(i));
    }
    RUN(test_binary_ply());
    RUN(test_binary_stl());
    RUN(test_shapes());
    return test_end("conditions");
}
