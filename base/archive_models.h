/* Which file of a ZIP archive is its model: the only one, or the one that places the others. */
#ifndef BURNISH_BASE_ARCHIVE_MODELS_H
#define BURNISH_BASE_ARCHIVE_MODELS_H

#include "base/inputs.h"

enum { BURNISH_ARCHIVE_NAME = 512 }; /* files with longer names are ignored */

/* The models of an archive. All zero before its first file. */
typedef struct burnish_archive_models {
    char best[BURNISH_ARCHIVE_NAME]; /* the model, if it is the only one */
    int format;                      /* its */
    size_t count, twins;             /* twins: further files of the best one's name */
    int are_several;                 /* 1: their names differ not only in the extension */
} burnish_archive_models;

typedef enum burnish_archive_vote {
    BURNISH_ARCHIVE_OTHER, /* no model, or one that is not counted */
    BURNISH_ARCHIVE_MODEL,
    BURNISH_ARCHIVE_BEST /* of all so far; a count of 1: those before it were parts of a scene */
} burnish_archive_vote;

static inline const char *burnish_archive_base(const char *name) {
    const char *slash = strrchr(name, '/');
    return slash ? slash + 1 : name;
}

/* What no user put there: folders, __MACOSX, .DS_Store and other names with a dot. */
static inline int burnish_archive_hides(const char *name) {
    return !*burnish_archive_base(name) || name[0] == '.' || strncmp(name, "__MACOSX/", 9) == 0 ||
           strstr(name, "/.") || strstr(name, "/__MACOSX/");
}

/* Whether an archive with this file is 3MF. */
static inline int burnish_archive_is_3mf(const char *name) {
    return burnish_is_same_name(name, "_rels/.rels") ||
           burnish_is_same_name(name, "[Content_Types].xml") ||
           burnish_is_same_name(name, "3D/3dmodel.model");
}

/* A scene may consist of robots, and these of meshes. */
static inline int burnish_scene_rank(const char *name) {
    const size_t size = strlen(name);
    return size > 11 && burnish_is_same_name(name + size - 11, ".scene.json") ? 2
           : size > 5 && burnish_is_same_name(name + size - 5, ".urdf")       ? 1
                                                                              : 0;
}

/* Takes the next file that is not hidden; `format`: what its extension says, 0 for no model. Of
 * files that differ only in their extensions, the lowest format counts. */
static inline burnish_archive_vote burnish_archive_take(burnish_archive_models *models,
                                                        const char *name, int format) {
    const char *base = burnish_archive_base(name), *best = burnish_archive_base(models->best);
    const char *dot = strrchr(base, '.');
    const int rank = burnish_scene_rank(base) - burnish_scene_rank(best);
    if (format == 0 || !dot || strlen(name) >= sizeof models->best ||
        (models->count > 0 && rank < 0)) {
        return BURNISH_ARCHIVE_OTHER;
    }
    if (rank > 0) {
        *models = (burnish_archive_models){.count = 0};
    } else if (models->count > 0 && strcmp(name, models->best) == 0) {
        models->twins += 1;
        return BURNISH_ARCHIVE_OTHER;
    } else if (models->count > 0) {
        const size_t stem = (size_t)(dot - base);
        models->are_several |= format == models->format || /* in another folder */
                               stem != (size_t)(strrchr(best, '.') - best) ||
                               !burnish_are_same_letters(base, best, stem);
    }
    models->count += 1;
    if (models->count > 1 && format >= models->format) {
        return BURNISH_ARCHIVE_MODEL;
    }
    strcpy(models->best, name);
    models->format = format;
    return BURNISH_ARCHIVE_BEST;
}

#endif
