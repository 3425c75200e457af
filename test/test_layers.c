/* Folder dependencies point one way: reads every include of the sources and checks it against the
 * table, which is the architecture. */
#include <dirent.h>

#include "harness.h"

/* What a folder may include: itself, and these. "public:NAME" is include/burnish/NAME. */
static const struct layer {
    const char *folder;
    const char *may_include;
} LAYERS[] = {
    {"src/base", "public:file.h public:status.h"},
    {"src/theory", "base public:lobe.h public:theory.h"},
    {"src/kernels", "base public:batch.h public:isa.h public:lobe.h"},
    {"src/scene", "base public:scene.h public:status.h"},
    {"src/raster", "base kernels public:isa.h"},
    {"src/shade", "base kernels raster public:batch.h"},
    {"src/image", "base public:image.h public:status.h"},
    {"src/render", "base kernels raster shade public:batch.h public:render.h public:theory.h "
                   "public:status.h"},
    {"tools/burnish",
     "public:batch.h public:file.h public:image.h public:isa.h public:lobe.h public:render.h "
     "public:scene.h public:status.h public:theory.h bench"},
    {"bench", "kernels public:batch.h public:lobe.h public:render.h public:scene.h"},
};

static int allowed(const struct layer *layer, const char *include) {
    const char *slash_in_folder = strrchr(layer->folder, '/');
    const char *own = slash_in_folder ? slash_in_folder + 1 : layer->folder;
    char word[128];
    if (strncmp(include, "burnish/", 8) == 0 && strncmp(layer->folder, "src/", 4) == 0) {
        snprintf(word, sizeof word, "public:%s", include + 8);
    } else if (strncmp(include, "burnish/", 8) == 0) {
        snprintf(word, sizeof word, "public:%s", include + 8);
    } else {
        snprintf(word, sizeof word, "%s", include);
        char *slash = strchr(word, '/');
        if (!slash) { /* beside the file itself, in the tools */
            return strncmp(layer->folder, "tools/", 6) == 0;
        }
        *slash = 0;
        if (strcmp(word, own) == 0) {
            return 1;
        }
    }
    char padded[256], wanted[160];
    snprintf(padded, sizeof padded, " %s ", layer->may_include);
    snprintf(wanted, sizeof wanted, " %s ", word);
    return strstr(padded, wanted) != NULL;
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
            CHECK(allowed(layer, include), "%s:%d includes \"%s\"; %s may include: %s", path,
                  number, include, layer->folder, layer->may_include);
        }
    }
    fclose(file);
    return includes;
}

static void check_layer(const struct layer *layer) {
    char folder[512], path[1024];
    int includes = 0;
    snprintf(folder, sizeof folder, "%s/%s", TEST_SOURCE_DIR, layer->folder);
    DIR *directory = opendir(folder);
    if (!CHECK(directory, "no folder %s", folder)) {
        return;
    }
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;) {
        size_t length = strlen(entry->d_name);
        if (length > 2 && entry->d_name[length - 2] == '.') {
            snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
            includes += check_file(layer, path);
        }
    }
    closedir(directory);
    CHECK(includes > 0, "no include found in %s", folder);
}

/* The test must be able to fail: these includes would turn the arrows round. */
static void check_that_wrong_arrows_are_found(void) {
    CHECK(!allowed(&LAYERS[3], "raster/raster.h"), "scene knows no raster");
    CHECK(!allowed(&LAYERS[4], "shade/shade.h"), "raster knows no light");
    CHECK(!allowed(&LAYERS[5], "burnish/scene.h"), "shade knows no file");
    CHECK(!allowed(&LAYERS[0], "scene/source.h"), "base knows nobody");
    CHECK(!allowed(&LAYERS[8], "base/srgb.h"), "tools use public headers");
    CHECK(allowed(&LAYERS[5], "raster/raster.h"), "shade takes raster's result");
}

int main(void) {
    for (size_t i = 0; i < sizeof LAYERS / sizeof LAYERS[0]; ++i) {
        check_layer(&LAYERS[i]);
    }
    check_that_wrong_arrows_are_found();
    return test_end("layers");
}
