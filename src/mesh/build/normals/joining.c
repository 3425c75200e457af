/* Union-find over the corners that meet in a vertex. */
#include <stddef.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "mesh/build/normals/creases.h"
#include "mesh/build/normals/joining.h"

/* The end of the edge that two faces share, away from the vertex. */
static uint32_t other_end(const burnish_rings *rings, size_t i, size_t j) {
    const uint32_t next = rings->next[i];
    return next == rings->previous[j] || next == rings->next[j] ? next : rings->previous[i];
}

/* Whether the edge from the vertex to position `end` is smooth, if the angle of its faces does not
 * decide. */
static int ask_surface(const burnish_rings *rings, size_t i, size_t j, uint32_t end) {
    burnish_surface surface = *rings->surface;
    const uint32_t here = surface.corner_positions[rings->corners[i]];
    const uint32_t from = rings->corners[i] / 3, to = rings->corners[j] / 3;
    const burnish_answer asked = {.triangles = {from < to ? from : to, from < to ? to : from},
                                  .edge = {here < end ? here : end, here < end ? end : here}};
    burnish_answer *kept =
        &rings->answers[(asked.triangles[0] * 5 + asked.triangles[1]) % BURNISH_ANSWERS];
    if (memcmp(kept, &asked, offsetof(burnish_answer, is_smooth)) != 0) {
        surface.known = rings->known;
        *kept = asked;
        kept->is_smooth = burnish_surface_is_smooth(&surface, asked.triangles, asked.edge);
    }
    return kept->is_smooth;
}

/* Joins faces i and j of the vertex; the smaller root remains a root. Returns 1 when two sets
 * became one. */
static int join_faces(burnish_rings *rings, uint32_t i, uint32_t j) {
    i = burnish_find_root(rings->parents, i);
    j = burnish_find_root(rings->parents, j);
    if (i < j) {
        rings->parents[j] = i;
    } else {
        rings->parents[i] = j;
    }
    return i != j;
}

/* Without branches: what a face shares with another can't be predicted. For at most
 * BURNISH_PAIRWISE_MAX faces. */
static void find_neighbors(const burnish_rings *rings, size_t first, size_t count,
                           burnish_neighbors *n) {
    const uint32_t *next = rings->next + first, *previous = rings->previous + first;
    n->any_doubtful = 0;
    for (size_t i = 0; i < count; ++i) {
        n->smooth[i] = n->doubtful[i] = 0;
    }
    for (size_t i = 0; i < count; ++i) {
        burnish_vec3 normal = burnish_ring_normal(rings, first + i);
        for (size_t j = i + 1; j < count; ++j) {
            int edge = (next[i] == previous[j]) | (previous[i] == next[j]) | (next[i] == next[j]) |
                       (previous[i] == previous[j]);
            double cosine = burnish_vec3_dot(normal, burnish_ring_normal(rings, first + j));
            uint32_t close = (uint32_t)(edge & (cosine > rings->sharp_cosine));
            uint32_t smooth = close & (uint32_t)(cosine > rings->smooth_cosine);
            n->smooth[i] |= smooth << j;
            n->smooth[j] |= smooth << i;
            n->doubtful[i] |= (close ^ smooth) << j;
            n->any_doubtful |= close ^ smooth;
        }
    }
}

#if defined(__x86_64__)
/* The same, all of the others at once: the dot product has the same bits from either side. Reads
 * BURNISH_PAIRWISE_MAX entries from `first` on. */
__attribute__((target("avx2"))) static void
find_neighbors_avx2(const burnish_rings *rings, size_t first, size_t count, burnish_neighbors *n) {
    const double *x = rings->x + first, *y = rings->y + first, *z = rings->z + first;
    const __m256d sharp_cosine = _mm256_set1_pd(rings->sharp_cosine);
    const __m256d smooth_cosine = _mm256_set1_pd(rings->smooth_cosine);
    __m256i next = _mm256_loadu_si256((const __m256i *)(rings->next + first));
    __m256i previous = _mm256_loadu_si256((const __m256i *)(rings->previous + first));
    n->any_doubtful = 0;
    for (size_t i = 0; i < count; ++i) {
        __m256d at_x = _mm256_set1_pd(x[i]), at_y = _mm256_set1_pd(y[i]);
        __m256d at_z = _mm256_set1_pd(z[i]);
        int close = 0, smooth = 0;
        for (int half = 0; half < BURNISH_PAIRWISE_MAX; half += 4) {
            __m256d cosine =
                _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(at_x, _mm256_loadu_pd(x + half)),
                                            _mm256_mul_pd(at_y, _mm256_loadu_pd(y + half))),
                              _mm256_mul_pd(at_z, _mm256_loadu_pd(z + half)));
            close |= _mm256_movemask_pd(_mm256_cmp_pd(cosine, sharp_cosine, _CMP_GT_OQ)) << half;
            smooth |= _mm256_movemask_pd(_mm256_cmp_pd(cosine, smooth_cosine, _CMP_GT_OQ)) << half;
        }
        __m256i at_next = _mm256_set1_epi32((int)rings->next[first + i]);
        __m256i at_previous = _mm256_set1_epi32((int)rings->previous[first + i]);
        __m256i edge = _mm256_or_si256(_mm256_or_si256(_mm256_cmpeq_epi32(at_next, previous),
                                                       _mm256_cmpeq_epi32(at_previous, next)),
                                       _mm256_or_si256(_mm256_cmpeq_epi32(at_next, next),
                                                       _mm256_cmpeq_epi32(at_previous, previous)));
        uint32_t shared = (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(edge)) &
                          ((1U << count) - 1) & ~(1U << i);
        n->smooth[i] = shared & (uint32_t)smooth;
        n->doubtful[i] = shared & (uint32_t)(close & ~smooth);
        n->any_doubtful |= n->doubtful[i];
    }
}
#endif

/* Among up to BURNISH_SETS_MAX faces, as bits, the faces with an edge to position `end`. */
typedef uint32_t find_edges(const burnish_rings *rings, size_t first, size_t count, uint32_t end);

static inline uint32_t find_edges_scalar(const burnish_rings *rings, size_t first, size_t count,
                                         uint32_t end) {
    uint32_t found = 0;
    for (size_t i = 0; i < count; ++i) {
        found |= (uint32_t)((rings->next[first + i] == end) | (rings->previous[first + i] == end))
                 << i;
    }
    return found;
}

#if defined(__x86_64__)
/* Reads up to BURNISH_PAIRWISE_MAX entries more. */
__attribute__((target("avx2"))) static inline uint32_t
find_edges_avx2(const burnish_rings *rings, size_t first, size_t count, uint32_t end) {
    const __m256i ends = _mm256_set1_epi32((int)end);
    uint32_t found = 0;
    for (size_t i = 0; i < count; i += 8) {
        const __m256i next = _mm256_loadu_si256((const __m256i *)(rings->next + first + i));
        const __m256i previous = _mm256_loadu_si256((const __m256i *)(rings->previous + first + i));
        const __m256i equal =
            _mm256_or_si256(_mm256_cmpeq_epi32(next, ends), _mm256_cmpeq_epi32(previous, ends));
        found |= (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(equal)) << i;
    }
    return found & (uint32_t)(((uint64_t)1 << count) - 1);
}
#endif

/* Whether more than BURNISH_PAIRWISE_MAX bits are set. Mostly two are. */
static inline int has_many(uint32_t bits) {
    int count = 0;
    for (; bits != 0; bits &= bits - 1) {
        ++count;
    }
    return count > BURNISH_PAIRWISE_MAX;
}

/* The same for more faces, few of which share an edge. Returns 0 if an edge has more than
 * BURNISH_PAIRWISE_MAX. */
static inline __attribute__((always_inline)) int find_many_neighbors(const burnish_rings *rings,
                                                                     size_t first, size_t count,
                                                                     find_edges *find,
                                                                     burnish_neighbors *n) {
    n->any_doubtful = 0;
    for (size_t i = 0; i < count; ++i) {
        n->smooth[i] = n->doubtful[i] = 0;
    }
    for (size_t i = 0; i < count; ++i) {
        const uint32_t after = find(rings, first, count, rings->next[first + i]);
        const uint32_t before = find(rings, first, count, rings->previous[first + i]);
        if (has_many(after) || has_many(before)) {
            return 0;
        }
        const uint32_t later = (after | before) >> i >> 1;
        for (uint32_t left = later; left != 0; left &= left - 1) {
            const size_t j = i + 1 + (size_t)__builtin_ctz(left);
            const double cosine = burnish_vec3_dot(burnish_ring_normal(rings, first + i),
                                                   burnish_ring_normal(rings, first + j));
            const uint32_t close = cosine > rings->sharp_cosine;
            const uint32_t smooth = close & (uint32_t)(cosine > rings->smooth_cosine);
            n->smooth[i] |= smooth << j;
            n->smooth[j] |= smooth << i;
            n->doubtful[i] |= (close ^ smooth) << j;
            n->any_doubtful |= close ^ smooth;
        }
    }
    return 1;
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) static int find_many_neighbors_avx2(const burnish_rings *rings,
                                                                    size_t first, size_t count,
                                                                    burnish_neighbors *n) {
    return find_many_neighbors(rings, first, count, find_edges_avx2, n);
}
#endif

/* The faces joined with a set so far. */
static uint32_t grow_set(const burnish_neighbors *n, uint32_t set) {
    for (uint32_t left = set; left != 0;) {
        const uint32_t found = n->smooth[__builtin_ctz(left)] & ~set;
        left = (left & (left - 1)) | found;
        set |= found;
    }
    return set;
}

/* Finds out which of the doubtful edges are smooth; one whose faces are joined already, as most are
 * in a scan, makes no difference. */
static void ask_neighbors(const burnish_rings *rings, size_t first, size_t count,
                          burnish_neighbors *n) {
    for (size_t i = 0; i < count; ++i) {
        uint32_t set = n->doubtful[i] ? grow_set(n, 1U << i) : 0;
        for (uint32_t left = n->doubtful[i]; left != 0; left &= left - 1) {
            const size_t j = (size_t)__builtin_ctz(left), at = first + i, to = first + j;
            if (!(set >> j & 1) && ask_surface(rings, at, to, other_end(rings, at, to))) {
                n->smooth[i] |= 1U << j;
                n->smooth[j] |= 1U << i;
                set = grow_set(n, set);
            }
        }
    }
}

/* Returns 0 if an edge has too many faces. */
static int find_any_neighbors(const burnish_rings *rings, size_t first, size_t count,
                              burnish_neighbors *n) {
#if defined(__x86_64__)
    if (rings->wide) {
        if (count > BURNISH_PAIRWISE_MAX) {
            return find_many_neighbors_avx2(rings, first, count, n);
        }
        find_neighbors_avx2(rings, first, count, n);
        return 1;
    }
#endif
    if (count > BURNISH_PAIRWISE_MAX) {
        return find_many_neighbors(rings, first, count, find_edges_scalar, n);
    }
    find_neighbors(rings, first, count, n);
    return 1;
}

size_t burnish_join_neighbors(burnish_rings *rings, size_t first, size_t count,
                              burnish_neighbors *neighbors, uint32_t sets[BURNISH_SETS_MAX]) {
    const uint32_t all = (uint32_t)(((uint64_t)1 << count) - 1);
    uint32_t left = all;
    size_t found = 0;
    sets[0] = grow_set(neighbors, 1);
    if (sets[0] == all) {
        return 1;
    }
    if (neighbors->any_doubtful) {
        ask_neighbors(rings, first, count, neighbors);
    }
    while (left != 0) {
        sets[found] = grow_set(neighbors, left & (0U - left));
        left &= ~sets[found++];
    }
    return found;
}

size_t burnish_join_few(burnish_rings *rings, size_t first, size_t count,
                        uint32_t sets[BURNISH_SETS_MAX]) {
    burnish_neighbors n;
    return find_any_neighbors(rings, first, count, &n)
               ? burnish_join_neighbors(rings, first, count, &n, sets)
               : 0;
}

/* Sorts edges by their other end, byte by byte from the lowest; those of one end keep their order.
 * Files of a few bytes can have millions of faces at a vertex, too many to compare. */
static void sort_edges(uint64_t *edges, uint64_t *spare, size_t count) {
    enum { DIGITS = 256 };
    uint64_t *from = edges, *to = spare;
    for (int shift = 32; shift < 64; shift += 8) {
        size_t starts[DIGITS] = {0}, sum = 0;
        for (size_t i = 0; i < count; ++i) {
            ++starts[from[i] >> shift & (DIGITS - 1)];
        }
        if (starts[from[0] >> shift & (DIGITS - 1)] == count) {
            continue; /* all have the same byte */
        }
        for (size_t d = 0; d < DIGITS; ++d) {
            const size_t found = starts[d];
            starts[d] = sum;
            sum += found;
        }
        for (size_t i = 0; i < count; ++i) {
            to[starts[from[i] >> shift & (DIGITS - 1)]++] = from[i];
        }
        uint64_t *const sorted = to;
        to = from;
        from = sorted;
    }
    if (from != edges) {
        memcpy(edges, from, count * sizeof *edges);
    }
}

/* Joins the faces of `count` edges with one other end, across smooth edges or across doubtful ones.
 * Returns how many sets disappeared. */
static size_t join_at_end(burnish_rings *rings, size_t first, const uint64_t *edges, size_t count,
                          int doubtful) {
    const size_t reach = count <= BURNISH_PAIRWISE_MAX ? BURNISH_PAIRWISE_MAX : 1;
    size_t joined = 0;
    for (size_t k = 0; k < count; ++k) {
        for (size_t l = k + 1; l < count && l <= k + reach; ++l) {
            const uint32_t i = (uint32_t)edges[k], j = (uint32_t)edges[l];
            const double cosine = burnish_vec3_dot(burnish_ring_normal(rings, first + i),
                                                   burnish_ring_normal(rings, first + j));
            const int smooth = cosine > rings->smooth_cosine;
            if (doubtful ? !smooth && cosine > rings->sharp_cosine &&
                               burnish_find_root(rings->parents, i) !=
                                   burnish_find_root(rings->parents, j) &&
                               ask_surface(rings, first + i, first + j, (uint32_t)(edges[k] >> 32))
                         : smooth) {
                joined += (size_t)join_faces(rings, i, j);
            }
        }
    }
    return joined;
}

/* Sorts the edges by their other end, then by face. */
int burnish_join_many(burnish_rings *rings, size_t first, size_t count) {
    _Static_assert(sizeof *rings->sets >= 2 * sizeof(uint64_t), "sets have room for edges");
    uint64_t *edges = rings->edges;
    size_t sets = count;
    for (size_t i = 0; i < count; ++i) {
        rings->parents[i] = (uint32_t)i;
        edges[2 * i] = (uint64_t)rings->next[first + i] << 32 | i;
        edges[2 * i + 1] = (uint64_t)rings->previous[first + i] << 32 | i;
    }
    sort_edges(edges, (uint64_t *)(void *)rings->sets, 2 * count); /* no set is in use yet */
    for (int doubtful = 0; doubtful <= rings->asks && sets > 1; ++doubtful) {
        for (size_t start = 0, end; start < 2 * count; start = end) {
            for (end = start + 1; end < 2 * count && edges[end] >> 32 == edges[start] >> 32;
                 ++end) {
            }
            sets -= join_at_end(rings, first, edges + start, end - start, doubtful);
        }
    }
    return sets == 1;
}
