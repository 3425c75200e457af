/* burnish_atan2() of finite points over vectors, the operations in the same order. Included once a
 * width, without a guard:
 *
 * ARCTANGENT_LANES:  numbers a vector
 * ARCTANGENT_TARGET: the attribute of its functions, or nothing
 * ARCTANGENT(name):  the name of this width's type or function */

typedef double ARCTANGENT(vector) __attribute__((vector_size(8 * ARCTANGENT_LANES)));
typedef int64_t ARCTANGENT(mask) __attribute__((vector_size(8 * ARCTANGENT_LANES)));

ARCTANGENT_TARGET static inline ARCTANGENT(vector)
    ARCTANGENT(select)(ARCTANGENT(mask) mask, ARCTANGENT(vector) yes, ARCTANGENT(vector) no) {
    return (ARCTANGENT(vector))((mask & (ARCTANGENT(mask))yes) | (~mask & (ARCTANGENT(mask))no));
}

ARCTANGENT_TARGET static inline ARCTANGENT(vector) ARCTANGENT(absolute)(ARCTANGENT(vector) x) {
    return (ARCTANGENT(vector))((ARCTANGENT(mask))x & INT64_MAX);
}

ARCTANGENT_TARGET static inline ARCTANGENT(vector)
    ARCTANGENT(angle)(ARCTANGENT(vector) y, ARCTANGENT(vector) x) {
    ARCTANGENT(vector) width = ARCTANGENT(absolute)(x), height = ARCTANGENT(absolute)(y);
    ARCTANGENT(mask) steep = height > width, left = x < 0;
    ARCTANGENT(vector) larger = ARCTANGENT(select)(steep, height, width);
    ARCTANGENT(vector)
    q = ARCTANGENT(select)(steep, width, height) /
        ARCTANGENT(select)(larger > 0, larger, larger + 1);
    ARCTANGENT(vector) centre, head, rest;
    for (int i = 0; i < ARCTANGENT_LANES; ++i) {
        const double *row = arctangent_row(q[i]);
        centre[i] = row[0], head[i] = row[1], rest[i] = row[2];
    }
    ARCTANGENT(vector) t = (q - centre) / (1 + q * centre), z = t * t;
    ARCTANGENT(vector) sum = arctangent_series[10] - (ARCTANGENT(vector)){0};
    for (int i = 9; i >= 0; --i) {
        sum = sum * z + arctangent_series[i];
    }
    ARCTANGENT(vector) tail = t * (z * sum);
    ARCTANGENT(mask) near_zero = centre == 0;
    ARCTANGENT(vector) high = ARCTANGENT(select)(near_zero, t, head);
    ARCTANGENT(vector) low = ARCTANGENT(select)(near_zero, tail, t + (tail + rest));
    ARCTANGENT(vector) before_pi = 2 * half_pi[0] - (high + (low - 2 * half_pi[1]));
    ARCTANGENT(vector) before_half = half_pi[0] - (high + (low - half_pi[1]));
    ARCTANGENT(vector) after_half = half_pi[0] + (high + (low + half_pi[1]));
    ARCTANGENT(vector)
    angle = ARCTANGENT(select)(steep, ARCTANGENT(select)(left, after_half, before_half),
                               ARCTANGENT(select)(left, before_pi, high + low));
    return ARCTANGENT(select)(y < 0, -angle, angle);
}

/* From `first` on as many as fill whole vectors; returns where it stopped. */
ARCTANGENT_TARGET static size_t ARCTANGENT(array)(const double *y, const double *x, double *angles,
                                                  size_t first, size_t count) {
    size_t i = first;
    for (; i + ARCTANGENT_LANES <= count; i += ARCTANGENT_LANES) {
        ARCTANGENT(vector) at_y, at_x, angle;
        memcpy(&at_y, y + i, sizeof at_y);
        memcpy(&at_x, x + i, sizeof at_x);
        angle = ARCTANGENT(angle)(at_y, at_x);
        memcpy(angles + i, &angle, sizeof angle);
    }
    return i;
}

#undef ARCTANGENT_LANES
#undef ARCTANGENT_TARGET
#undef ARCTANGENT
