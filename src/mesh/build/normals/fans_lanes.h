/* The loops of fans.c over vectors of LANES vertices, for one instruction set.
 *
 *   LANES      of a vector
 *   NAME(x)    a name of this instruction set
 *   TARGET     an attribute for the compiler, or nothing */

typedef double NAME(real) __attribute__((vector_size(8 * LANES), aligned(8), may_alias));
typedef int64_t NAME(mask) __attribute__((vector_size(8 * LANES), aligned(8), may_alias));

typedef uint32_t NAME(number) __attribute__((vector_size(4 * LANES), aligned(4), may_alias));

/* Macros, because vectors as parameters depend on the instruction set of the caller. */
#define LOAD(type, array) (*(const NAME(type) *)(const void *)&(array))
#define STORE(array) (*(NAME(mask) *)(void *)&(array))
#define NUMBER(array) __builtin_convertvector(LOAD(number, array), NAME(mask))
#define COSINE(i, x, y, z)                                                                         \
    (LOAD(real, f->x[i][v]) * (x) + LOAD(real, f->y[i][v]) * (y) + LOAD(real, f->z[i][v]) * (z))
#define CHOOSE(is, yes, no) ((NAME(real))(((NAME(mask))(yes) & (is)) | ((NAME(mask))(no) & ~(is))))

/* Finds bits of the faces that each face shares an edge with: a smooth one, or a doubtful one. */
TARGET static void NAME(join_faces)(burnish_fans *f, size_t v, size_t faces,
                                    const burnish_rings *rings, NAME(mask) * joined) {
    const double smooth_cosine = rings->smooth_cosine, sharp_cosine = rings->sharp_cosine;
    NAME(mask) next[BURNISH_PAIRWISE_MAX], previous[BURNISH_PAIRWISE_MAX];
    NAME(mask) bit = (NAME(mask)){0} + 1;
    for (size_t i = 0; i < faces; ++i) {
        joined[i] = (NAME(mask)){0};
        next[i] = NUMBER(f->next[i][v]);
        previous[i] = NUMBER(f->previous[i][v]);
    }
    for (size_t i = 0; i < faces; ++i, bit += bit) {
        const NAME(real) x = LOAD(real, f->x[i][v]), y = LOAD(real, f->y[i][v]);
        const NAME(real) z = LOAD(real, f->z[i][v]);
        NAME(mask) other = bit, bits = joined[i], doubtful = {0};
        for (size_t j = i + 1; j < faces; ++j) {
            const NAME(real) cosine = COSINE(j, x, y, z);
            const NAME(mask) close = ((next[i] == previous[j]) | (previous[i] == next[j]) |
                                      (next[i] == next[j]) | (previous[i] == previous[j])) &
                                     (cosine > sharp_cosine);
            const NAME(mask) smooth = close & (cosine > smooth_cosine);
            other += other;
            bits |= smooth & other;
            doubtful |= (close ^ smooth) & other;
            joined[j] |= smooth & bit;
        }
        joined[i] = bits;
        STORE(f->joined[i][v]) = bits;
        STORE(f->doubtful[i][v]) = doubtful;
    }
}

/* Whether the faces are one set; returns whether those of any vertex are. */
TARGET static int NAME(find_sets)(burnish_fans *f, size_t v, size_t faces,
                                  const burnish_rings *rings) {
    const int64_t all = (INT64_C(1) << faces) - 1;
    NAME(mask) joined[BURNISH_PAIRWISE_MAX], set = (NAME(mask)){0} + 1;
    uint32_t any = 0;
    NAME(join_faces)(f, v, faces, rings, joined);
    for (int64_t missing = 1, grown = 1; missing && grown;) {
        const NAME(mask) before = set;
        NAME(mask) bit = (NAME(mask)){0} + 1;
        missing = grown = 0;
        for (size_t i = 0; i < faces; ++i, bit += bit) {
            set |= joined[i] & ((set & bit) == bit);
        }
        for (int k = 0; k < LANES; ++k) {
            missing |= set[k] ^ all;
            grown |= set[k] ^ before[k];
        }
    }
    for (int k = 0; k < LANES; ++k) {
        f->is_one[v + (size_t)k] = set[k] == all;
        any |= f->is_one[v + (size_t)k];
    }
    return any != 0;
}

/* Whether a face determines the normal, a mask in f->chosen: all do, or the largest one and those
 * coplanar with it. Four partial sums, as in normals.c. */
TARGET static void NAME(choose_faces)(burnish_fans *f, size_t v, size_t faces) {
    NAME(real) most = LOAD(real, f->lengths[0][v]), x = LOAD(real, f->x[0][v]);
    NAME(real) y = LOAD(real, f->y[0][v]), z = LOAD(real, f->z[0][v]);
    NAME(real) areas[4] = {most}, flat_areas[4] = {{0}};
    for (size_t i = 1; i < faces; ++i) {
        const NAME(real) length = LOAD(real, f->lengths[i][v]);
        const NAME(mask) more = length > most;
        areas[i % 4] += length;
        most = CHOOSE(more, length, most);
        x = CHOOSE(more, LOAD(real, f->x[i][v]), x);
        y = CHOOSE(more, LOAD(real, f->y[i][v]), y);
        z = CHOOSE(more, LOAD(real, f->z[i][v]), z);
    }
    for (size_t i = 0; i < faces; ++i) {
        const NAME(mask) is_flat = COSINE(i, x, y, z) > BURNISH_COPLANAR_COSINE;
        flat_areas[i % 4] += (NAME(real))(LOAD(mask, f->lengths[i][v]) & is_flat);
        STORE(f->chosen[i][v]) = is_flat;
    }
    const NAME(real) flat = (flat_areas[0] + flat_areas[2]) + (flat_areas[1] + flat_areas[3]);
    const NAME(real) rest = ((areas[0] + areas[2]) + (areas[1] + areas[3])) - flat;
    const NAME(mask) all = ~((rest > 0) & (flat >= BURNISH_FLAT_SHARE * rest));
    for (size_t i = 0; i < faces; ++i) {
        STORE(f->chosen[i][v]) |= all;
    }
}

/* The sum of the chosen faces; the others add 0, which changes no bit. */
TARGET static void NAME(add_faces)(burnish_fans *f, size_t v, size_t faces) {
    NAME(real) x = {0}, y = {0}, z = {0};
    for (size_t i = 0; i < faces; ++i) {
        const NAME(real) angle =
            (NAME(real))(LOAD(mask, f->angles[i][v]) & LOAD(mask, f->chosen[i][v]));
        x += LOAD(real, f->x[i][v]) * angle;
        y += LOAD(real, f->y[i][v]) * angle;
        z += LOAD(real, f->z[i][v]) * angle;
    }
    *(NAME(real) *)(void *)&f->sum[0][v] = x;
    *(NAME(real) *)(void *)&f->sum[1][v] = y;
    *(NAME(real) *)(void *)&f->sum[2][v] = z;
}

/* As burnish_store_unit has it. */
TARGET static void NAME(store_normals)(burnish_fans *f, size_t count) {
    for (size_t v = 0; v < count; ++v) {
        const burnish_vec3 sum = {f->sum[0][v], f->sum[1][v], f->sum[2][v]};
        const double length = burnish_vec3_length(sum), scale = 1 / length;
        f->normals[0][v] = (float)(sum.x * scale) + 0.0f;
        f->normals[1][v] = (float)(sum.y * scale) + 0.0f;
        f->normals[2][v] = (float)(sum.z * scale) + 0.0f;
        f->is_one[v] &= length > BURNISH_CANCELLED * BURNISH_LARGEST_ANGLE;
    }
}

TARGET static void NAME(find_normals)(burnish_fans *f, const burnish_rings *rings, size_t count,
                                      size_t faces) {
    for (size_t v = 0; v < count; v += LANES) {
        if (!NAME(find_sets)(f, v, faces, rings)) {
            continue; /* what the sums were is not used */
        }
        if (rings->asks) {
            NAME(choose_faces)(f, v, faces);
        }
        NAME(add_faces)(f, v, faces);
    }
    NAME(store_normals)(f, count);
}

#undef LOAD
#undef STORE
#undef NUMBER
#undef COSINE
#undef CHOOSE
#undef LANES
#undef NAME
#undef TARGET
