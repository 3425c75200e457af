/* The edges that are smooth if the caller gives no crease angle. Angles alone can't distinguish a
 * cylinder of 12 sides (30 degrees) from a chamfer of 30 degrees, but the faces beyond them can.
 * Only edges between SMOOTH and SHARP degrees are examined, so a dense mesh costs nothing. */
#include "mesh/build/normals/creases.h"
#include "mesh/build/normals/welded.h"

/* 40 degrees: an octagon's 45 is an edge, a decagon's 36 a step. */
#define STEP_COSINE 0.76604444311897804

/* In a scan, edges below 0.3 degrees are as frequent as others up to 1 degree; in a machined part
 * there are more, the diagonals of flat faces. An organic surface has less than 15 % of them, and
 * less than 4 % more than the edges from 0.3 to 1 degree suggest. Of 344 public STL files, only a
 * bull, a rabbit and spheres are organic; of 43 scans and sculptures, 37. */
#define PLANE_COSINE 0.99998629226429398
#define PLANE_SHARE 0.15
#define EXCESS_SHARE 0.04
/* From 60 degrees on. Coarse sculptures have up to 38 %; the faces of a volume mesh's cells, which
 * meet at all angles, 58 %. */
#define SHARP_SHARE 0.4
/* Triangles ten times as long as high: at most 17 % of the others that pass, scans and sculptures
 * among them, but 20 to 37 % of decimated robot parts. */
#define NEEDLE_HEIGHT 0.1
#define NEEDLE_SHARE 0.2
/* 3 degrees: edges below are flat in an organic surface. */
#define FLAT_COSINE 0.99862953475457383

/* The next edge of a chain turns by at most 60 degrees. */
#define ONWARD_COSINE 0.5

/* The samples are far apart: this prime is about 2^32 over the golden ratio. */
#define SPREAD UINT64_C(2654435761)

enum {
    SAMPLES = 1024,    /* vertices that are measured */
    SAMPLE_GROUP = 64, /* of them, which decide whether threads measure the others */
    EDGES_MIN = 256,   /* fewer decide nothing */
    EDGES_SURE = 24,   /* so many edges more than an organic surface has end the search */
    FACES_MAX = 32,    /* at the end of an edge with fewer: more are not searched, which bounds the
                       time for any input */
    WALK_MAX = 16      /* triangles of one flat face that are crossed */
};

/* Across a curve, neighbouring steps are at most so many times as wide, ... */
#define WIDTH_RATIO_MAX 3.0
/* ... and bend at least so much, as a share of the sine; an arc's end bends half a step. */
#define BEND_SHARE 0.25

typedef struct face {
    uint32_t triangle;
    burnish_vec3 normal;
} face;

static burnish_vec3 position_of(const burnish_surface *s, uint32_t position) {
    return burnish_vec3_loadf(s->positions + 3 * (size_t)position);
}

static face face_of(const burnish_surface *s, uint32_t triangle) {
    burnish_known_face *known = s->known ? &s->known->faces[triangle % BURNISH_KNOWN] : NULL;
    if (known && known->after == triangle + 1) {
        return (face){triangle, known->normal};
    }
    const burnish_vec3 cross =
        burnish_face_cross(s->positions, s->corner_positions + 3 * (size_t)triangle);
    const burnish_vec3 normal = burnish_vec3_normalize(cross);
    if (known) {
        *known = (burnish_known_face){triangle + 1, normal};
    }
    return (face){triangle, normal};
}

/* The triangle's corner that is not on the edge, which is one of its own. */
static uint32_t third_corner(const burnish_surface *s, uint32_t triangle, uint32_t a, uint32_t b) {
    const uint32_t *corners = s->corner_positions + 3 * (size_t)triangle;
    return corners[0] ^ corners[1] ^ corners[2] ^ a ^ b;
}

/* The one other triangle at an edge. Returns 0 if there is none, or several. */
static int find_across(const burnish_surface *s, uint32_t triangle, uint32_t a, uint32_t b,
                       face *across) {
    const size_t at_a = s->first_corner[a + (size_t)1] - s->first_corner[a];
    const size_t at_b = s->first_corner[b + (size_t)1] - s->first_corner[b];
    const uint32_t here = at_b < at_a ? b : a, there = at_b < at_a ? a : b;
    const size_t count = at_b < at_a ? at_b : at_a;
    const uint32_t *corners = s->corners + s->first_corner[here];
    uint32_t found = BURNISH_NONE;
    int faces = 0;
    for (size_t i = 0; i < count && count <= FACES_MAX; ++i) { /* which one can't be predicted */
        const uint32_t other = corners[i] / 3;
        const uint32_t *around = s->corner_positions + 3 * (size_t)other;
        const int shares = (around[0] == there) | (around[1] == there) | (around[2] == there);
        const uint32_t is_it = (uint32_t)(shares & (other != triangle));
        found = (other & (0U - is_it)) | (found & (is_it - 1));
        faces += (int)is_it;
    }
    if (faces == 1) {
        *across = face_of(s, found);
    }
    return faces == 1;
}

/* ---- curved faces: scans, sculptures, and what simplification left of them ---- */

/* Whether a face bends at two of its edges, neither flat nor sharp there.
 *   outer  the two faces at these edges, written */
static int is_bent(const burnish_surface *s, const face *f, const uint32_t edge[2], face outer[2]) {
    const uint32_t third = third_corner(s, f->triangle, edge[0], edge[1]);
    for (int i = 0; i < 2; ++i) {
        if (!find_across(s, f->triangle, edge[i], third, &outer[i])) {
            return 0;
        }
        const double cosine = burnish_vec3_dot(f->normal, outer[i].normal);
        if (cosine > BURNISH_COPLANAR_COSINE || cosine <= BURNISH_SHARP_COSINE) {
            return 0;
        }
    }
    return 1;
}

static int is_flat_beyond(const burnish_surface *s, const face *f, const uint32_t edge[2]) {
    const uint32_t third = third_corner(s, f->triangle, edge[0], edge[1]);
    for (int i = 0; i < 2; ++i) {
        face next;
        if (find_across(s, f->triangle, edge[i], third, &next) &&
            burnish_vec3_dot(f->normal, next.normal) > BURNISH_COPLANAR_COSINE) {
            return 1;
        }
    }
    return 0;
}

/* Whether two faces that bend at all their edges belong to a curved surface. All edges of an
 * icosahedron are steep; a steep edge among gentle ones is where two curves meet, as a chamfer
 * around a corner. And facets of a pocket have edges around them and larger flat faces beyond
 * these. Few edges of a scan are that sharp, so the search for flat faces is rare. */
static int is_curved(const burnish_surface *s, const face faces[2], const uint32_t edge[2],
                     face outer[2][2], double cosine) {
    int steep = 0, sharp = 0, flat = 0;
    for (int i = 0; i < 4; ++i) {
        const double around = burnish_vec3_dot(faces[i / 2].normal, outer[i / 2][i % 2].normal);
        steep += around <= STEP_COSINE;
        sharp += around <= BURNISH_SMOOTH_COSINE;
    }
    for (int i = 0; i < 4 && sharp >= 3; ++i) {
        const uint32_t third = third_corner(s, faces[i / 2].triangle, edge[0], edge[1]);
        const uint32_t side[2] = {edge[i % 2], third};
        flat += is_flat_beyond(s, &outer[i / 2][i % 2], side);
    }
    return flat <= 2 && (cosine > STEP_COSINE || (steep <= 2 && sharp > 0));
}

/* ---- steps of a curve ---- */

/* The surface at the far side of a flat face. */
typedef enum far_side { CONTINUES, ENDS, DIFFERS } far_side;

typedef struct crossing {
    double width; /* of the flat face at the middle of the edge */
    far_side beyond;
} crossing;

/* The face beyond the far edge of a face.
 *   bend, next_bend  sines of the angles at the near and the far edge, in the plane of the crossing
 *   cosine           of the whole angle at the far edge */
static far_side find_far_side(double bend, double next_bend, double cosine) {
    const double least = BEND_SHARE * bend * bend;
    if (cosine <= STEP_COSINE) {
        return ENDS;
    }
    if (next_bend * bend >= least) {
        return CONTINUES;
    }
    const int sideways = 4 * next_bend * next_bend < 1 - cosine * cosine; /* as at a pole */
    return sideways ? ENDS : DIFFERS;
}

/* Crosses the flat face from the middle of an edge at a right angle to it, triangle by triangle.
 *   other  the face on the near side of the edge */
static crossing cross_face(const burnish_surface *s, const face *start, const face *other,
                           const uint32_t edge[2]) {
    uint32_t triangle = start->triangle, left = edge[0], right = edge[1];
    const burnish_vec3 a = position_of(s, left), b = position_of(s, right);
    const burnish_vec3 along = burnish_vec3_normalize(burnish_vec3_sub(b, a));
    const burnish_vec3 middle = burnish_vec3_scale(burnish_vec3_add(a, b), 0.5);
    const burnish_vec3 inward =
        burnish_vec3_sub(position_of(s, third_corner(s, triangle, left, right)), middle);
    burnish_vec3 across = burnish_vec3_cross(start->normal, along);
    across = burnish_vec3_scale(across, burnish_vec3_dot(across, inward) < 0 ? -1 : 1);
    const double bend = -burnish_vec3_dot(other->normal, across);
    double left_at = burnish_vec3_dot(burnish_vec3_sub(a, middle), along), right_at = -left_at;
    for (int step = 0; step < WALK_MAX; ++step) {
        const uint32_t third = third_corner(s, triangle, left, right);
        const burnish_vec3 to_third = burnish_vec3_sub(position_of(s, third), middle);
        const double third_at = burnish_vec3_dot(to_third, along);
        if (third_at > 0) {
            right = third;
            right_at = third_at;
        } else {
            left = third;
            left_at = third_at;
        }
        face next = *start;
        const int found = find_across(s, triangle, left, right, &next);
        const double cosine = found ? burnish_vec3_dot(start->normal, next.normal) : -1;
        if (cosine > BURNISH_COPLANAR_COSINE) {
            triangle = next.triangle;
            continue;
        }
        const double share = right_at > left_at ? right_at / (right_at - left_at) : 0.5;
        const burnish_vec3 from = burnish_vec3_sub(position_of(s, right), middle);
        const burnish_vec3 to = burnish_vec3_sub(position_of(s, left), middle);
        const double width =
            burnish_vec3_dot(from, across) * (1 - share) + burnish_vec3_dot(to, across) * share;
        return (crossing){width,
                          find_far_side(bend, burnish_vec3_dot(next.normal, across), cosine)};
    }
    return (crossing){0, DIFFERS};
}

/* Whether an edge is a step of a curve: both faces are about equally wide, and beyond at least one
 * of them the surface keeps bending in the same direction. Beyond the other it also does, or ends.
 */
static int is_step(const burnish_surface *s, const face faces[2], const uint32_t edge[2]) {
    const crossing c = cross_face(s, &faces[0], &faces[1], edge);
    if (c.beyond == DIFFERS) {
        return 0;
    }
    const crossing d = cross_face(s, &faces[1], &faces[0], edge);
    return d.beyond != DIFFERS && (c.beyond == CONTINUES || d.beyond == CONTINUES) &&
           c.width <= WIDTH_RATIO_MAX * d.width && d.width <= WIDTH_RATIO_MAX * c.width;
}

/* ---- organic surfaces ---- */

/* The faces at a position, with the corners beside it. */
typedef struct ring {
    size_t count; /* 0 if there are more than FACES_MAX */
    uint32_t next[FACES_MAX], previous[FACES_MAX];
    burnish_vec3 normals[FACES_MAX];
} ring;

static void list_faces(const burnish_surface *s, uint32_t position, ring *r) {
    static const uint8_t after[5] = {0, 1, 2, 0, 1};
    const uint32_t *corners = s->corners + s->first_corner[position];
    const size_t count = s->first_corner[position + (size_t)1] - s->first_corner[position];
    r->count = count <= FACES_MAX ? count : 0;
    for (size_t i = 0; i < r->count; ++i) {
        const uint32_t *around = s->corner_positions + corners[i] / 3 * (size_t)3;
        r->next[i] = around[after[corners[i] % 3 + 1]];
        r->previous[i] = around[after[corners[i] % 3 + 2]];
        r->normals[i] = face_of(s, corners[i] / 3).normal;
    }
}

/* Counts the edges at a position. */
static burnish_edge_counts count_edges(const burnish_surface *s, uint32_t position) {
    ring r;
    burnish_edge_counts counts = {0};
    list_faces(s, position, &r);
    for (size_t i = 0; i < r.count; ++i) {
        uint32_t found = 0; /* which one can't be predicted, but that there is one */
        for (size_t j = 0; j < r.count; ++j) {
            found |= (uint32_t)(r.next[i] == r.previous[j]) << j;
        }
        for (; found != 0; found &= found - 1) {
            const double cosine = burnish_vec3_dot(r.normals[i], r.normals[__builtin_ctz(found)]);
            ++counts.all;
            counts.plane += cosine > PLANE_COSINE;
            counts.flat += cosine > BURNISH_COPLANAR_COSINE;
            counts.gentle += (cosine <= FLAT_COSINE) & (cosine > BURNISH_SMOOTH_COSINE);
            counts.sharp += cosine <= BURNISH_SHARP_COSINE;
        }
    }
    return counts;
}

/* Whether a sharp edge continues beyond its end `at`: another one goes on within 60 degrees. */
static int goes_on(const burnish_surface *s, uint32_t from, uint32_t at) {
    const burnish_vec3 here = position_of(s, at);
    const burnish_vec3 along = burnish_vec3_normalize(burnish_vec3_sub(here, position_of(s, from)));
    ring r;
    list_faces(s, at, &r);
    for (size_t i = 0; i < r.count; ++i) {
        for (size_t j = 0; j < r.count; ++j) {
            if (r.next[i] == r.previous[j] && r.next[i] != from &&
                burnish_vec3_dot(r.normals[i], r.normals[j]) <= BURNISH_SHARP_COSINE) {
                const burnish_vec3 onward = burnish_vec3_sub(position_of(s, r.next[i]), here);
                if (burnish_vec3_dot(burnish_vec3_normalize(onward), along) >= ONWARD_COSINE) {
                    return 1;
                }
            }
        }
    }
    return 0;
}

/* Whether many triangles are needles, as between the rims of a decimated cylinder. */
static int has_needles(const burnish_surface *s, size_t position_count) {
    const uint64_t count = s->first_corner[position_count] / 3;
    const uint64_t samples = count < SAMPLES ? count : SAMPLES;
    double needles = 0;
    for (uint64_t i = 0; i < samples; ++i) {
        const uint32_t *corners = s->corner_positions + 3 * (i * SPREAD % count);
        double longest = 0; /* squared */
        for (int k = 0; k < 3; ++k) {
            const burnish_vec3 side = burnish_vec3_sub(position_of(s, corners[k]),
                                                       position_of(s, corners[k < 2 ? k + 1 : 0]));
            const double square = burnish_vec3_dot(side, side);
            longest = square > longest ? square : longest;
        }
        needles += burnish_vec3_length(burnish_face_cross(s->positions, corners)) <
                   NEEDLE_HEIGHT * longest;
    }
    return needles >= NEEDLE_SHARE * (double)samples;
}

typedef struct sampler {
    const burnish_surface *surface;
    size_t position_count;
    burnish_edge_counts counts[SAMPLES];
} sampler;

static void count_samples(sampler *s, size_t first, size_t end) {
    for (uint64_t i = first; i < end; ++i) {
        s->counts[i] = count_edges(s->surface, (uint32_t)(i * SPREAD % s->position_count));
    }
}

static void count_group(void *context, size_t group, int thread) {
    (void)thread;
    count_samples(context, (group + 1) * SAMPLE_GROUP, (group + 2) * SAMPLE_GROUP);
}

/* Most machined parts are known by the first group, so one thread goes on step by step. */
int burnish_surface_is_organic(const burnish_surface *s, size_t position_count,
                               burnish_tasks *tasks) {
    const size_t samples = position_count < SAMPLES ? position_count : SAMPLES;
    const int is_shared = samples == SAMPLES && burnish_tasks_threads(tasks) > 1;
    sampler all = {.surface = s, .position_count = position_count};
    double edges = 0, plane = 0, sharp = 0, excess = 0;
    for (size_t i = 0; i < samples && excess < EXCESS_SHARE * edges + EDGES_SURE; ++i) {
        if (is_shared && i == SAMPLE_GROUP) {
            burnish_tasks_run(tasks, SAMPLES / SAMPLE_GROUP - 1, 1, 0, count_group, &all);
        } else if (!is_shared || i < SAMPLE_GROUP) {
            count_samples(&all, i, i + 1);
        }
        const burnish_edge_counts *counts = &all.counts[i];
        edges += counts->all;
        plane += counts->plane;
        sharp += counts->sharp;
        excess += counts->plane - (counts->flat - counts->plane) * (0.3 / 0.7);
    }
    return edges >= EDGES_MIN && plane < PLANE_SHARE * edges && excess < EXCESS_SHARE * edges &&
           sharp < SHARP_SHARE * edges && !has_needles(s, position_count);
}

/* The same if the position is asked for again, which it is by other edges. */
static burnish_edge_counts find_counts(const burnish_surface *s, uint32_t position) {
    burnish_known_edges *known = s->known ? &s->known->edges[position % BURNISH_KNOWN] : NULL;
    if (!known) {
        return count_edges(s, position);
    }
    if (known->after != position + 1) {
        *known = (burnish_known_edges){position + 1, count_edges(s, position)};
    }
    return known->counts;
}

/* Whether an edge of an organic surface is noise: others around it bend gently. */
static int is_noise(const burnish_surface *s, const uint32_t edge[2]) {
    const burnish_edge_counts a = find_counts(s, edge[0]), b = find_counts(s, edge[1]);
    const int all = a.all + b.all;
    return 4 * (a.plane + b.plane) <= all && 8 * (a.gentle + b.gentle) >= all;
}

int burnish_surface_is_smooth(const burnish_surface *s, const uint32_t triangles[2],
                              const uint32_t edge[2]) {
    const face faces[2] = {face_of(s, triangles[0]), face_of(s, triangles[1])};
    const double cosine = burnish_vec3_dot(faces[0].normal, faces[1].normal);
    face outer[2][2];
    int smooth = s->is_organic && is_noise(s, edge) &&
                 (cosine > BURNISH_SHARP_COSINE ||
                  !(goes_on(s, edge[0], edge[1]) && goes_on(s, edge[1], edge[0])));
    if (!smooth && cosine > BURNISH_SHARP_COSINE) {
        smooth = is_bent(s, &faces[0], edge, outer[0]) && is_bent(s, &faces[1], edge, outer[1])
                     ? is_curved(s, faces, edge, outer, cosine)
                     : cosine > STEP_COSINE && is_step(s, faces, edge);
    }
    return smooth;
}
