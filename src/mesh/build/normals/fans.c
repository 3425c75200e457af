/* Most vertices have few faces, which smooth edges join. Vectors of such vertices do what normals.c
 * does, with the same operations in the same order. */
#include "mesh/build/normals/fans.h"
#include "mesh/build/normals/creases.h"
#include "mesh/build/normals/faces.h"

#define LANES 2
#define NAME(x) x##_any
#define TARGET
#include "mesh/build/normals/fans_lanes.h"

#if defined(__x86_64__)
#define LANES 4
#define NAME(x) x##_avx2
#define TARGET __attribute__((target("avx2")))
#include "mesh/build/normals/fans_lanes.h"

#define LANES 8
#define NAME(x) x##_avx512
#define TARGET __attribute__((target("avx512f,avx512dq")))
#include "mesh/build/normals/fans_lanes.h"
#endif

void burnish_fans_normals(burnish_fans *fans, const burnish_rings *rings, const uint32_t *starts,
                          size_t count, size_t faces) {
    const size_t whole = (count + BURNISH_FACE_LANES - 1) / BURNISH_FACE_LANES * BURNISH_FACE_LANES;
    if (!rings->asks) {
        memset(fans->chosen, 0xff, sizeof fans->chosen);
    }
    burnish_measured_faces to[BURNISH_PAIRWISE_MAX];
    for (size_t i = 0; i < faces; ++i) {
        to[i] = (burnish_measured_faces){fans->x[i],       fans->y[i],      fans->z[i],
                                         fans->lengths[i], fans->angles[i], fans->next[i],
                                         fans->previous[i]};
    }
    burnish_measure_fans(rings->surface, starts, count, faces, rings->wide, to);
#if defined(__x86_64__)
    if (rings->wide) {
        (rings->wide > 1 ? find_normals_avx512 : find_normals_avx2)(fans, rings, whole, faces);
        return;
    }
#endif
    find_normals_any(fans, rings, whole, faces);
}

void burnish_fans_neighbors(const burnish_fans *fans, size_t vertex, size_t faces,
                            burnish_neighbors *neighbors) {
    neighbors->any_doubtful = 0;
    for (size_t i = 0; i < faces; ++i) {
        neighbors->smooth[i] = (uint32_t)fans->joined[i][vertex];
        neighbors->doubtful[i] = (uint32_t)fans->doubtful[i][vertex];
        neighbors->any_doubtful |= neighbors->doubtful[i];
    }
}

void burnish_fans_to_rings(burnish_fans *fans, const burnish_rings *rings, size_t vertex,
                           size_t faces, const uint32_t *corners, size_t first) {
    for (size_t i = 0; i < faces; ++i) {
        rings->x[first + i] = fans->x[i][vertex];
        rings->y[first + i] = fans->y[i][vertex];
        rings->z[first + i] = fans->z[i][vertex];
        rings->lengths[first + i] = fans->lengths[i][vertex];
        rings->angles[first + i] = fans->angles[i][vertex];
        rings->next[first + i] = fans->next[i][vertex];
        rings->previous[first + i] = fans->previous[i][vertex];
        fans->corners[first + i] = corners[i];
    }
}
