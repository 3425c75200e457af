/* Folder dependencies point one way: reads every include below ROOTS, file by file, and checks it
 * against the table, which is the architecture. */
#include <dirent.h>
#include <sys/stat.h>

#include "support.h"

/* What lobe/ may see of the public headers: nothing of meshes, images and kernels. */
#define LOBE                                                                                       \
    "burnish/core.h burnish/lobe.h burnish/lobe_q15.h burnish/lobe_spec.h burnish/shade_q15.h "    \
    "burnish/theory.h"

/* What the files of a folder may include: those of the same folder, and these folders' and files'.
 * "burnish/NAME" is include/burnish/NAME. A folder that is not listed fails. */
static const struct layer {
    const char *folder;
    const char *may_include;
} LAYERS[] = {
    {"include/burnish", ""},
    {"base", "burnish/core.h"},
    {"base/cli", "base burnish/core.h"},
    {"base/include/burnish", ""},
    {"base/test", "base base/cli burnish/core.h"},
    {"base/wasm", "burnish/core.h"},
    {"lobe/include/burnish", LOBE},
    {"lobe/spec", "base " LOBE},
    {"lobe/theory", "base " LOBE},
    {"lobe/theory/composite", "base theory " LOBE},
    {"lobe/program", "base base/cli " LOBE},
    {"lobe/wasm", "base base/cli base/wasm program " LOBE},
    {"lobe/test", "base burnish/ring.h " LOBE},
    {"lobe/test/theory", "base theory " LOBE},
    {"lobe/theory/lights", "base theory " LOBE},
    {"lobe/test/shaders", LOBE},
    {"lobe/scripts", "theory"},
    {"src/core", "base burnish/core.h"},
    {"src/simd", "base core burnish/core.h"},
    {"src/shading",
     "base core simd burnish/core.h burnish/kernels.h burnish/lobe.h burnish/shading.h"},
    {"src/mesh", "base core mesh/data mesh/build mesh/read mesh/read/common mesh/read/io "
                 "burnish/core.h burnish/mesh.h"},
    {"src/mesh/data", "base core burnish/core.h burnish/mesh.h"},
    {"src/mesh/build", "base core mesh/build/normals mesh/data"},
    {"src/mesh/build/normals", "base core mesh/data"},
    {"src/mesh/read",
     "base core image/decode mesh/data mesh/read/common mesh/read/io mesh/read/ply"},
    {"src/mesh/read/common", "base core image/decode mesh/data mesh/read/io"},
    {"src/mesh/read/io", "base core image/decode mesh/data burnish/core.h"},
    {"src/mesh/read/cloud", "base mesh/read/io mesh/read/ply"},
    {"src/mesh/read/gcode", "base core mesh/data mesh/read/common mesh/read/io"},
    {"src/mesh/read/gltf", "base core mesh/data mesh/read/common mesh/read/io"},
    {"src/mesh/read/obj", "base core mesh/data mesh/read/common mesh/read/io"},
    {"src/mesh/read/ply", "base core mesh/data mesh/read/common mesh/read/io"},
    {"src/mesh/read/scene", "base core mesh/data mesh/read mesh/read/common mesh/read/io"},
    {"src/mesh/read/threemf", "base core mesh/data mesh/read/common mesh/read/io"},
    {"src/raster", "base core simd burnish/core.h"},
    {"src/rays", "base core simd burnish/mesh.h"},
    {"src/image", "base core burnish/compare.h burnish/core.h burnish/image.h"},
    {"src/image/decode", "base core image/zlib_stream.h burnish/image.h"},
    {"src/image/text",
     "base core image/pixels.h burnish/drawing.h burnish/image.h burnish/sheet.h"},
    {"src/annotate", "base core image image/text burnish/annotate.h burnish/core.h "
                     "burnish/drawing.h burnish/image.h burnish/mesh.h mesh/axes.h"},
    {"src/environment",
     "base core image image/decode shading simd burnish/kernels.h burnish/light.h"},
    {"src/render", "base core raster simd burnish/mesh.h"},
    {"src/render/drawing",
     "base core image/text/drawing.h render/frame burnish/drawing.h burnish/render.h"},
    {"src/render/frame",
     "base core simd raster rays shading render render/light render/light/maps render/lines "
     "render/splats render/texture "
     "burnish/core.h burnish/look.h burnish/mesh.h burnish/render.h"},
    {"src/render/light",
     "base core environment simd raster rays render render/light/maps render/texture shading "
     "burnish/light.h burnish/mesh.h burnish/render.h"},
    {"src/render/light/maps",
     "base core simd raster render render/texture burnish/mesh.h burnish/render.h"},
    {"src/render/lines",
     "base core mesh/axes.h image/text/strokes.h raster render burnish/render.h"},
    {"src/render/splats",
     "base core raster/raster_view.h render simd burnish/lobe.h burnish/render.h"},
    {"src/render/texture", "base core simd raster render shading burnish/mesh.h"},
    {"program/batch", "base base/cli cli import picture render render/output render/scene "
                      "render/settings sandbox burnish"},
    {"program/cli", "base base/cli render/flags.h burnish"},
    {"program/compare",
     "base base/cli cli import render render/output render/scene picture burnish"},
    {"program/font", "base base/cli cli burnish"},
    {"program/import", "base base/cli cli burnish"},
    {"program/info", "base base/cli batch cli import render/scene burnish"},
    {"program/picture", "base base/cli cli burnish"},
    {"program/render",
     "base base/cli batch/batch.h cli font picture render/output render/scene render/settings "
     "sandbox burnish"},
    {"program/render/output",
     "base base/cli cli font import picture render/scene render/settings sandbox burnish"},
    {"program/render/scene", "base base/cli cli import render/settings burnish"},
    {"program/render/settings", "base base/cli cli picture burnish"},
    {"program/sandbox", "base base/cli cli import picture/video.h burnish"},
    {"program/serve", "base base/cli cli import render render/settings sandbox burnish"},
    {"program/session", "base base/cli cli import render render/output render/scene burnish"},
    {"importers",
     "base mesh/read/bms.h mesh/read/read.h mesh/read/io/zip.h core/srgb.h sandbox/lock.h"},
    {"importers/assimp", "base importers"},
    {"importers/draco", "base importers"},
    {"importers/occt", "base importers"},
    {"bench", "burnish"},
    {"bench/kernels", "burnish"},
    {"bench/load", "burnish"},
    {"bench/rays", "rays burnish"},
    {"bench/peers", "base core simd shading burnish"},
    {"bindings/wasm", "base base/cli base/wasm cli picture/read_png.h core/pool.h image/decode "
                      "mesh/read/io/beside.h burnish wasi"},
    {"lobe/arduino/src", "burnish/lobe_q15.h burnish/shade_q15.h burnish/ring.h burnish/strip.h"},
    {"lobe/arduino/src/burnish", ""}, /* packed next to these: the integer headers */
    {"lobe/firmware", "burnish/lobe_q15.h burnish/shade_q15.h"},
    {"lobe/firmware/arm", ""},
    {"lobe/firmware/avr", ""},
    {"lobe/firmware/host", ""},
    {"lobe/firmware/rv32", ""},
    {"lobe/rtl/test", "burnish/lobe_q15.h burnish/shade_q15.h"},
    {"bindings/python", "base base/cli cli burnish"},
};

/* Templates are included by templates and by ..._isa.c; bench takes those of the kernels, and
 * core has one of its own. */
static int may_include_templates(const char *path) {
    return strstr(path, "_simd.h") || strstr(path, "_isa.c") || strstr(path, "/src/core/") ||
           strstr(path, "/bench/");
}

static const struct layer *find_layer(const char *folder) {
    for (size_t i = 0; i < sizeof LAYERS / sizeof LAYERS[0]; ++i) {
        if (strcmp(LAYERS[i].folder, folder) == 0) {
            return &LAYERS[i];
        }
    }
    return NULL;
}

static int holds_word(const char *words, const char *word) {
    char padded[256], wanted[256];
    snprintf(padded, sizeof padded, " %.250s ", words);
    snprintf(wanted, sizeof wanted, " %.250s ", word);
    return strstr(padded, wanted) != NULL;
}

/* The part of a folder's name that includes have. */
static const char *include_name(const struct layer *layer) {
    const char *own = strchr(layer->folder, '/');
    return own ? own + 1 : layer->folder;
}

/* Whether a file of `folder` may include "include": by its folder, or by its whole name. */
static int allowed(const struct layer *layer, const char *include) {
    char folder[256];
    snprintf(folder, sizeof folder, "%s", include);
    char *slash = strrchr(folder, '/');
    if (!slash) { /* beside the file itself */
        return 1;
    }
    *slash = 0;
    return strcmp(include_name(layer), folder) == 0 || strcmp(layer->folder, folder) == 0 ||
           holds_word(layer->may_include, folder) || holds_word(layer->may_include, include);
}

static int check_file(const struct layer *layer, const char *path) {
    FILE *file = fopen(path, "r");
    char line[512], include[256];
    int includes = 0, number = 0;
    if (!CHECK(file, "can't open %s", path)) {
        return 0;
    }
    while (fgets(line, sizeof line, file)) {
        ++number;
        if (sscanf(line, " # include \"%255[^\"]\"", include) == 1) {
            ++includes;
            CHECK(!strstr(include, "_simd.h") || may_include_templates(path),
                  "%s:%d includes the template \"%s\"; call it through ..._ops.h", path, number,
                  include);
            CHECK(allowed(layer, include), "%s:%d includes \"%s\"; %s may include: %s", path,
                  number, include, layer->folder, layer->may_include);
        }
    }
    fclose(file);
    return includes;
}

static int is_source(const char *name) {
    const char *extension = strrchr(name, '.');
    return extension && (strcmp(extension, ".c") == 0 || strcmp(extension, ".h") == 0 ||
                         strcmp(extension, ".cpp") == 0);
}

/* Checks the sources of a folder and of all below it; returns how many includes it saw. */
static int check_folder(const char *folder) {
    char path[1024];
    int includes = 0;
    snprintf(path, sizeof path, "%s/%s", TEST_SOURCE_DIR, folder);
    DIR *directory = opendir(path);
    if (!CHECK(directory, "no folder %s", path)) {
        return 0;
    }
    const struct layer *layer = find_layer(folder);
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;) {
        struct stat info;
        snprintf(path, sizeof path, "%s/%s/%s", TEST_SOURCE_DIR, folder, entry->d_name);
        if (entry->d_name[0] == '.' || stat(path, &info) != 0) {
            continue;
        }
        if (S_ISDIR(info.st_mode)) {
            char below[512];
            snprintf(below, sizeof below, "%s/%s", folder, entry->d_name);
            includes += check_folder(below);
            continue;
        }
        if (is_source(entry->d_name) &&
            CHECK(layer, "%s: the folder %s is not in the table of layers", entry->d_name,
                  folder)) {
            includes += check_file(layer, path);
        }
    }
    closedir(directory);
    return includes;
}

/* No two folders may include each other. */
static void check_directions(void) {
    const size_t count = sizeof LAYERS / sizeof LAYERS[0];
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < i; ++k) {
            CHECK(!holds_word(LAYERS[i].may_include, include_name(&LAYERS[k])) ||
                      !holds_word(LAYERS[k].may_include, include_name(&LAYERS[i])),
                  "%s and %s may include each other", LAYERS[i].folder, LAYERS[k].folder);
        }
    }
}

/* The test must be able to fail: these includes would turn the arrows round. */
static void check_that_wrong_arrows_are_found(void) {
    CHECK(!allowed(find_layer("src/mesh"), "raster/tile.h"), "mesh knows no raster");
    CHECK(!allowed(find_layer("src/raster"), "render/frame/steps.h"), "raster knows no frame");
    CHECK(!allowed(find_layer("src/shading"), "burnish/mesh.h"), "shading knows no file");
    CHECK(!find_layer("src/gltf"), "an unknown folder is found out");
    CHECK(!allowed(find_layer("lobe/spec"), "burnish/mesh.h"), "lobes know no renderer");
    CHECK(!allowed(find_layer("base"), "burnish/lobe.h"), "base knows no lobes");
    CHECK(!allowed(find_layer("lobe/firmware"), "burnish/core.h"), "integer headers only");
    CHECK(!may_include_templates("/src/raster/tile.c"), "templates are called through tables");
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    static const char *const ROOTS[] = {"base",  "src",       "program", "bindings",
                                        "bench", "importers", "lobe",    "include"};
    for (size_t i = 0; i < sizeof ROOTS / sizeof ROOTS[0]; ++i) {
        CHECK(check_folder(ROOTS[i]) > 0, "no include found in %s", ROOTS[i]);
    }
    check_directions();
    RUN(check_that_wrong_arrows_are_found());
    return test_end("layers");
}
