/* burnish-import-assimp: FBX, COLLADA, 3DS, X3D and the other formats of libassimp. */
#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "importer.h"
#include "materials.h"

const char importer_name[] = "burnish-import-assimp";

enum {
    DEPTH_MAX = 500, /* of nodes */
    GREY = 158       /* importer_default_material's, as a code of sRGB */
};

void importer_prepare(void) {
    aiGetImportFormatCount(); /* creates all readers once, with the libraries that they load */
}

/* ---- The one file that there is ---- */

typedef struct open_file {
    struct aiFile file;
    const importer_input *input;
    size_t position;
} open_file;

static open_file *opened_file(struct aiFile *file) {
    return (open_file *)(void *)file->UserData;
}

static size_t read_file(struct aiFile *file, char *to, size_t size, size_t count) {
    open_file *f = opened_file(file);
    const size_t left = f->input->size - f->position;
    const size_t most = size > 0 ? left / size : 0, got = count < most ? count : most;
    memcpy(to, f->input->bytes + f->position, got * size);
    f->position += got * size;
    return got;
}

static size_t write_file(struct aiFile *file, const char *from, size_t size, size_t count) {
    (void)file, (void)from, (void)size, (void)count;
    return 0;
}

static size_t file_tell(struct aiFile *file) {
    return opened_file(file)->position;
}

static size_t file_size(struct aiFile *file) {
    return opened_file(file)->input->size;
}

static enum aiReturn file_seek(struct aiFile *file, size_t offset, enum aiOrigin origin) {
    open_file *f = opened_file(file);
    const size_t size = f->input->size;
    const size_t base = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? f->position : size;
    const size_t to = base + offset; /* offsets back wrap around */
    if (to > size) {
        return aiReturn_FAILURE;
    }
    f->position = to;
    return aiReturn_SUCCESS;
}

static void file_flush(struct aiFile *file) {
    (void)file;
}

static char file_name[48];

/* Any other name is a missing file: files next to the input are not read here. */
static struct aiFile *open_one(struct aiFileIO *io, const char *name, const char *mode) {
    const size_t size = strlen(name), own = strlen(file_name);
    if (size < own || strcmp(name + size - own, file_name) != 0 || strchr(mode, 'w')) {
        return NULL;
    }
    open_file *f = importer_zeroed(1, sizeof *f);
    f->input = (const importer_input *)(const void *)io->UserData;
    f->file = (struct aiFile){.ReadProc = read_file,
                              .WriteProc = write_file,
                              .TellProc = file_tell,
                              .FileSizeProc = file_size,
                              .SeekProc = file_seek,
                              .FlushProc = file_flush,
                              .UserData = (aiUserData)f};
    return &f->file;
}

static void close_one(struct aiFileIO *io, struct aiFile *file) {
    (void)io;
    free(opened_file(file));
}

/* ---- Nodes ---- */

/* A walk over the nodes: for counting, or for drawing if `mesh` has its arrays. */
typedef struct walk {
    const struct aiScene *scene;
    importer_mesh *mesh;
    const unsigned *sets; /* of texture coordinates, by material */
    int has_opaque_colors;
    uint64_t vertices, triangles, points;
    int is_damaged;
    int has_no_normals; /* the present ones are not intended */
} walk;

typedef void use_mesh(walk *w, const struct aiMesh *mesh, const struct aiMatrix4x4 *matrix);

static struct aiMatrix4x4 matrix_product(const struct aiMatrix4x4 *a, const struct aiMatrix4x4 *b) {
    struct aiMatrix4x4 both = *a;
    aiMultiplyMatrix4(&both, b);
    return both;
}

static void for_each_mesh(walk *w, const struct aiNode *node, const struct aiMatrix4x4 *above,
                          int depth, use_mesh *use) {
    const struct aiMatrix4x4 matrix = matrix_product(above, &node->mTransformation);
    if (depth > DEPTH_MAX) {
        importer_fail(BURNISH_BMS_LIMIT_ERROR, "its nodes are nested deeper than 500");
    }
    const uint64_t before = w->triangles;
    const char *name = node->mName.data;
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        if (node->mMeshes[i] < w->scene->mNumMeshes) {
            const struct aiMesh *mesh = w->scene->mMeshes[node->mMeshes[i]];
            name = *name ? name : mesh->mName.data;
            use(w, mesh, &matrix);
        }
    }
    if (w->mesh->indices) { /* drawing */
        importer_add_part(w->mesh, name, w->triangles - before);
    }
    for (unsigned i = 0; i < node->mNumChildren; ++i) {
        for_each_mesh(w, node->mChildren[i], &matrix, depth + 1, use);
    }
}

static void for_all(walk *w, use_mesh *use) {
    struct aiMatrix4x4 none;
    aiIdentityMatrix4(&none);
    for_each_mesh(w, w->scene->mRootNode, &none, 0, use);
}

/* ---- Meshes ---- */

static int is_triangle(const struct aiFace *face, const struct aiMesh *mesh) {
    return face->mNumIndices == 3 && face->mIndices[0] < mesh->mNumVertices &&
           face->mIndices[1] < mesh->mNumVertices && face->mIndices[2] < mesh->mNumVertices;
}

/* A mesh of only lines or points is drawn only if nothing else is. */
static int has_triangles(const struct aiMesh *mesh) {
    for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
        if (is_triangle(&mesh->mFaces[i], mesh)) {
            return 1;
        }
    }
    return 0;
}

/* The coordinates of its material's textures, which might not be the first set. */
static const struct aiVector3D *coordinates_of(const walk *w, const struct aiMesh *mesh) {
    const unsigned set =
        mesh->mMaterialIndex < w->scene->mNumMaterials ? w->sets[mesh->mMaterialIndex] : 0;
    return set < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh->mTextureCoords[set]
               ? mesh->mTextureCoords[set]
               : mesh->mTextureCoords[0];
}

/* Colours that are fully transparent everywhere mean "no colours": libassimp returns them for
 * .blend files without colours. The same applies to its default grey for .dxf. */
static const struct aiColor4D *colors_of(const struct aiMesh *mesh) {
    for (unsigned i = 0; i < mesh->mNumVertices && mesh->mColors[0]; ++i) {
        const struct aiColor4D *c = &mesh->mColors[0][i];
        if (c->a > 0 && !(c->r == 0.6f && c->g == 0.6f && c->b == 0.6f && c->a == 0.6f)) {
            return mesh->mColors[0];
        }
    }
    return NULL;
}

static void count_mesh(walk *w, const struct aiMesh *mesh, const struct aiMatrix4x4 *matrix) {
    (void)matrix;
    if (!mesh->mVertices || !has_triangles(mesh)) {
        w->points += mesh->mVertices && mesh->mPrimitiveTypes & aiPrimitiveType_POINT
                         ? mesh->mNumVertices
                         : 0;
        return;
    }
    w->vertices += mesh->mNumVertices;
    for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
        w->triangles += (uint64_t)is_triangle(&mesh->mFaces[i], mesh);
    }
    w->mesh->parts |= (mesh->mNormals && !w->has_no_normals ? BURNISH_BMS_NORMALS : 0) |
                      (colors_of(mesh) ? BURNISH_BMS_COLORS : 0) |
                      (coordinates_of(w, mesh) ? BURNISH_BMS_TEXCOORDS : 0);
}

/* The matrix for normals: the cofactors, which are the inverse's transpose times the determinant.
 */
static void find_cofactors(const struct aiMatrix4x4 *m, double c[9], double *determinant) {
    const double a[9] = {m->a1, m->a2, m->a3, m->b1, m->b2, m->b3, m->c1, m->c2, m->c3};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            const int r = (row + 1) % 3, s = (row + 2) % 3, u = (column + 1) % 3,
                      v = (column + 2) % 3;
            c[3 * row + column] = a[3 * r + u] * a[3 * s + v] - a[3 * r + v] * a[3 * s + u];
        }
    }
    *determinant = a[0] * c[0] + a[1] * c[1] + a[2] * c[2];
}

/* Numbers that are not finite become 0, with a warning. */
static void put_vector(walk *w, const double v[3], float *to) {
    for (int i = 0; i < 3; ++i) {
        to[i] = (float)v[i];
        if (!isfinite(to[i])) {
            to[i] = 0;
            w->is_damaged = 1;
        }
    }
}

static void put_position(walk *w, const struct aiMatrix4x4 *m, const struct aiVector3D *p,
                         float *to) {
    const double x = p->x, y = p->y, z = p->z;
    const double moved[3] = {m->a1 * x + m->a2 * y + m->a3 * z + m->a4,
                             m->b1 * x + m->b2 * y + m->b3 * z + m->b4,
                             m->c1 * x + m->c2 * y + m->c3 * z + m->c4};
    put_vector(w, moved, to);
}

/* A unit vector; 0 if there is no direction, so the normal is generated. */
static void put_normal(const double c[9], double sign, const struct aiVector3D *n, float *to) {
    double turned[3], square = 0;
    for (int i = 0; i < 3; ++i) {
        turned[i] = sign * (c[3 * i] * n->x + c[3 * i + 1] * n->y + c[3 * i + 2] * n->z);
        square += turned[i] * turned[i];
    }
    for (int i = 0; i < 3 && square > 0 && square < 1e300; ++i) {
        to[i] = (float)(turned[i] / sqrt(square));
    }
}

static uint8_t code_of(float value) {
    return (uint8_t)(value > 0 ? value < 1 ? value * 255 + 0.5f : 255 : 0);
}

static void draw_vertices(walk *w, const struct aiMesh *mesh, const struct aiMatrix4x4 *matrix) {
    importer_mesh *to = w->mesh;
    const struct aiColor4D *colors = colors_of(mesh);
    const struct aiVector3D *coordinates = coordinates_of(w, mesh);
    const int is_grey = mesh->mMaterialIndex < to->material_count &&
                        !(to->materials[mesh->mMaterialIndex].flags & BURNISH_BMS_HAS_DIFFUSE);
    double cofactors[9], determinant;
    find_cofactors(matrix, cofactors, &determinant);
    for (unsigned i = 0; i < mesh->mNumVertices; ++i) {
        const uint64_t at = w->vertices + i;
        put_position(w, matrix, &mesh->mVertices[i], to->positions + 3 * at);
        if (mesh->mNormals && to->normals) {
            put_normal(cofactors, determinant < 0 ? -1 : 1, &mesh->mNormals[i],
                       to->normals + 3 * at);
        }
        if (colors && to->colors) {
            const struct aiColor4D *c = &colors[i];
            const uint8_t rgba[4] = {code_of(c->r), code_of(c->g), code_of(c->b),
                                     w->has_opaque_colors ? 255 : code_of(c->a)};
            memcpy(to->colors + 4 * at, rgba, sizeof rgba);
        } else if (to->colors && is_grey) {
            memset(to->colors + 4 * at, GREY, 3);
        }
        if (coordinates && to->texcoords) {
            const float u = coordinates[i].x, v = coordinates[i].y;
            to->texcoords[2 * at] = isfinite(u) ? u : 0;
            to->texcoords[2 * at + 1] = isfinite(v) ? v : 0;
        }
    }
}

static int is_finite_face(const struct aiFace *face, const struct aiMesh *mesh) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const struct aiVector3D *p = &mesh->mVertices[face->mIndices[k]];
        sum += (double)p->x + (double)p->y + (double)p->z;
    }
    return isfinite(sum);
}

/* Mirroring reverses triangles. One with a position that is not finite becomes a point. */
static void draw_triangles(walk *w, const struct aiMesh *mesh, const struct aiMatrix4x4 *matrix) {
    double cofactors[9], determinant;
    find_cofactors(matrix, cofactors, &determinant);
    for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
        const struct aiFace *face = &mesh->mFaces[i];
        if (!is_triangle(face, mesh)) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            const int corner = !is_finite_face(face, mesh) ? 0
                               : determinant < 0 && k > 0  ? 3 - k
                                                           : k;
            w->mesh->indices[3 * w->triangles + (uint64_t)k] =
                (uint32_t)(w->vertices + face->mIndices[corner]);
        }
        w->mesh->triangle_materials[w->triangles] =
            mesh->mMaterialIndex < w->scene->mNumMaterials ? mesh->mMaterialIndex : 0;
        w->triangles += 1;
    }
}

static void draw_mesh(walk *w, const struct aiMesh *mesh, const struct aiMatrix4x4 *matrix) {
    const int is_cloud = w->mesh->triangle_count == 0;
    if (!mesh->mVertices ||
        (is_cloud ? !(mesh->mPrimitiveTypes & aiPrimitiveType_POINT) : !has_triangles(mesh))) {
        return;
    }
    draw_vertices(w, mesh, matrix);
    if (!is_cloud) {
        draw_triangles(w, mesh, matrix);
    }
    w->vertices += mesh->mNumVertices;
}

/* Blender's vertices have smooth normals even if faces are flat. DXF has no transparency, but
 * libassimp's default grey for it has an alpha of 0.6. */
static void flatten_scene(const struct aiScene *scene, const char *extension, const unsigned *sets,
                          importer_mesh *mesh) {
    walk counted = {.scene = scene, .mesh = mesh, .sets = sets}, drawn = counted;
    drawn.has_opaque_colors = strcmp(extension, "dxf") == 0;
    counted.has_no_normals = strcmp(extension, "blend") == 0;
    for_all(&counted, count_mesh);
    mesh->vertex_count = counted.triangles > 0 ? counted.vertices : counted.points;
    mesh->triangle_count = counted.triangles;
    mesh->parts |= counted.triangles > 0 ? BURNISH_BMS_TRIANGLE_MATERIALS : 0;
    importer_allocate(mesh);
    for_all(&drawn, draw_mesh);
    if (drawn.is_damaged) {
        importer_warn(mesh, "triangles with positions that are not finite were left out");
    }
}

/* ---- The scene ---- */

/* Which way is up. libassimp turns most formats to +Y. For others it keeps +Z, or turns them away
 * from it. */
static void find_up(const struct aiScene *scene, const char *extension, float up[3]) {
    static const struct {
        const char *extension;
        float z;
    } rows[] = {{"ac", -1}, {"ac3d", -1}, {"acc", -1}, {"blend", 1}, {"cob", 1}, {"dxf", -1},
                {"hmp", 1}, {"ogex", 1},  {"q3o", 1},  {"scn", 1},   {"smd", 1}};
    up[1] = 1;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        if (strcmp(rows[i].extension, extension) == 0) {
            up[1] = 0;
            up[2] = rows[i].z;
        }
    }
    if (strcmp(extension, "nff") == 0 && scene->mNumCameras > 0) { /* the file says it */
        const struct aiVector3D *own = &scene->mCameras[0]->mUp;
        const float axes[3] = {own->x, own->y, own->z};
        for (int i = 0; i < 3; ++i) {
            up[i] = fabsf(axes[i]) > 0.9f ? axes[i] > 0 ? 1 : -1 : 0;
        }
        up[1] = up[0] == 0 && up[1] == 0 && up[2] == 0 ? 1 : up[1];
    }
}

/* The library's message, and advice if it has none. */
static _Noreturn void fail_by_library(void) {
    static const struct {
        const char *part, *advice;
    } rows[] = {{"Missing file input", "; parts in other files are not read: convert it whole"},
                {"old format version", "; save it as one of these, or as glTF"}};
    const char *text = aiGetErrorString(), *advice = "";
    char line[400];
    if (!text || !*text) {
        text = "libassimp gives no reason";
    }
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        advice = strstr(text, rows[i].part) ? rows[i].advice : advice;
    }
    const int length = (int)strcspn(text, "\r\n"), end = length > 250 ? 250 : length;
    snprintf(line, sizeof line, "%.*s%s",
             *advice && end > 0 && text[end - 1] == '.' ? end - 1 : end, text, advice);
    importer_fail(strstr(text, "bad_alloc") ? BURNISH_BMS_MEMORY_ERROR : BURNISH_BMS_FORMAT_ERROR,
                  line);
}

/* Says which Blender saved a file that libassimp can't read; the library's messages name inner
 * structures. Of 222 public files it reads 94 of 98 saved before Blender 3.0, and 2 of 124 others. */
static void fail_by_blender(const importer_input *input) {
    static const char *advice = "and libassimp can't read it; export it from Blender as glTF";
    const char *head = (const char *)input->bytes;
    char line[160];
    if (strcmp(input->extension, "blend") != 0 || input->size < 12) {
        return;
    }
    const int is_five = memcmp(head, "BLENDER1", 8) == 0;
    if (memcmp(head, "\x28\xB5\x2F\xFD", 4) == 0) { /* zstd */
        snprintf(line, sizeof line, "Blender 3.0 or later compressed it, %s", advice);
        importer_fail(BURNISH_BMS_FORMAT_ERROR, line);
    } else if (is_five || (memcmp(head, "BLENDER", 7) == 0 && head[9] >= '3')) {
        const char version[] = {is_five ? '5' : head[9], '.', is_five ? 'x' : head[11], 0};
        snprintf(line, sizeof line, "Blender %s saved it, %s", version, advice);
        importer_fail(BURNISH_BMS_FORMAT_ERROR, line);
    }
}

void importer_import(importer_input *input, importer_mesh *mesh) {
    importer_unpack(input);
    struct aiFileIO files = {open_one, close_one, (aiUserData)(uintptr_t)input};
    struct aiPropertyStore *properties = aiCreatePropertyStore();
    const unsigned steps =
        aiProcess_Triangulate | aiProcess_TransformUVCoords | aiProcess_GenUVCoords;
    snprintf(file_name, sizeof file_name, "input.%s", input->extension);
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_NO_SKELETON_MESHES, 1);
    const struct aiScene *scene =
        aiImportFileExWithProperties(file_name, steps, &files, properties);
    if (!scene || !scene->mRootNode) {
        fail_by_blender(input);
        fail_by_library();
    }
    find_up(scene, input->extension, mesh->up);
    flatten_scene(scene, input->extension, assimp_read_materials(scene, input->extension, mesh),
                  mesh);
}
