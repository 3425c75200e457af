/* bench_rays FILE: processor time to build the tree of a mesh, and rays per second on one core by
 * instruction set and of Embree, as pictures cast them: from the middles of 256 triangles in one
 * direction. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "rays/rays.h"

#ifdef BURNISH_BENCH_EMBREE
#include <embree3/rtcore.h>
#endif

enum { POINTS = 256, BATCHES = 4000 };

static float values[7][POINTS], hits[POINTS];

/* The rays of a batch, off their triangles on the side to which they go. */
static void aim(const burnish_ray_tree *tree, size_t batch) {
    const double z = fmod((double)batch * 0.7548776662, 2) - 1, turn = (double)batch * 2.4;
    const double r = sqrt(1 - z * z), d[3] = {r * cos(turn), r * sin(turn), z};
    for (size_t i = 0; i < POINTS; ++i) {
        const float *c = tree->triangles[(977 * batch + i) % tree->triangle_count];
        const double a[3] = {c[3] - c[0], c[4] - c[1], c[5] - c[2]};
        const double b[3] = {c[6] - c[0], c[7] - c[1], c[8] - c[2]};
        const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                             a[0] * b[1] - a[1] * b[0]};
        const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) + 1e-300;
        const double side = n[0] * d[0] + n[1] * d[1] + n[2] * d[2] < 0 ? -1e-4 : 1e-4;
        for (int k = 0; k < 3; ++k) {
            values[k][i] = (float)((c[k] + c[3 + k] + c[6 + k]) / 3.0 + side * n[k] / length);
            values[3 + k][i] = (float)d[k];
        }
        values[6][i] = 4;
    }
}

static void measure(const burnish_ray_tree *tree, burnish_isa isa) {
    const burnish_ray_batch rays = {
        {values[0], values[1], values[2]}, {values[3], values[4], values[5]}, values[6], POINTS};
    double ticks = 0;
    for (size_t batch = 0; batch < BATCHES; ++batch) {
        aim(tree, batch);
        const clock_t start = clock();
        burnish_ray_ops_for(isa)->find_hits(tree, &rays, hits, NULL, NULL);
        ticks += (double)(clock() - start);
    }
    printf("%s: %.1f million rays per second\n", burnish_isa_name(isa),
           (double)POINTS * BATCHES / ticks * CLOCKS_PER_SEC * 1e-6);
}

#ifdef BURNISH_BENCH_EMBREE
/* The same rays to the nearest hit, in packets of 16 with the flag for coherent ones. */
static void measure_embree(const burnish_ray_tree *tree) {
    _Alignas(64) int valid[16];
    _Alignas(64) struct RTCRayHit16 rays;
    struct RTCIntersectContext context;
    RTCDevice device = rtcNewDevice("threads=1");
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    RTCScene scene = rtcNewScene(device);
    const size_t size = 9 * sizeof(float) * tree->triangle_count;
    memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12,
                                   3 * tree->triangle_count),
           tree->triangles, size);
    uint32_t *indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                RTC_FORMAT_UINT3, 12, tree->triangle_count);
    for (size_t i = 0; i < 3 * tree->triangle_count; ++i) {
        indices[i] = (uint32_t)i;
    }
    const clock_t begin = clock();
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcCommitScene(scene);
    const double built = (double)(clock() - begin) * 1e3 / CLOCKS_PER_SEC;
    double ticks = 0;
    for (size_t batch = 0; batch < BATCHES; ++batch) {
        aim(tree, batch);
        const clock_t start = clock();
        for (size_t first = 0; first < POINTS; first += 16) {
            float *const to[] = {rays.ray.org_x, rays.ray.org_y, rays.ray.org_z, rays.ray.dir_x,
                                 rays.ray.dir_y, rays.ray.dir_z, rays.ray.tfar};
            for (int k = 0; k < 7; ++k) {
                memcpy(to[k], values[k] + first, 16 * sizeof(float));
            }
            for (int i = 0; i < 16; ++i) {
                rays.ray.tnear[i] = rays.ray.time[i] = 0;
                rays.ray.mask[i] = UINT32_MAX;
                rays.ray.flags[i] = 0;
                rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
                valid[i] = -1;
            }
            rtcInitIntersectContext(&context);
            context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
            rtcIntersect16(valid, scene, &context, &rays);
        }
        ticks += (double)(clock() - start);
    }
    printf("Embree %s: tree %.0f ms, %.1f million rays per second\n", RTC_VERSION_STRING, built,
           (double)POINTS * BATCHES / ticks * CLOCKS_PER_SEC * 1e-6);
    rtcReleaseGeometry(geometry);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
}
#endif

int main(int count, char **arguments) {
    burnish_ray_tree tree = {0};
    burnish_mesh *mesh;
    burnish_error error = {BURNISH_STATUS_OK, "name a mesh"};
    burnish_memory memory = burnish_memory_of(NULL, &error);
    burnish_tasks tasks;
    const burnish_load_options options = burnish_load_options_default();
    if (count < 2 || burnish_mesh_load(arguments[1], &options, &mesh, &error)) {
        return fprintf(stderr, "bench_rays: %s\n", error.text) > 0;
    }
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    burnish_ray_mesh of = {.view = view, .most_work = 1e30};
    double squared = 0;
    for (int k = 0; k < 3; ++k) {
        of.center[k] = (view->bounds_min[k] + view->bounds_max[k]) / 2;
        squared += pow((double)view->bounds_max[k] - (double)of.center[k], 2);
    }
    of.scale = (float)(1 / sqrt(squared));
    burnish_tasks_begin(&tasks, NULL, 1);
    const clock_t start = clock();
    if (burnish_ray_tree_update(&tree, &of, &tasks, &memory)) {
        return fprintf(stderr, "bench_rays: %s\n", error.text) > 0;
    }
    printf("%zu triangles: %.0f ms, %.0f bytes per triangle\n", tree.triangle_count,
           (double)(clock() - start) * 1e3 / CLOCKS_PER_SEC,
           36 + 64.0 * (double)tree.node_count / (double)tree.triangle_count);
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        if (burnish_isa_available() >> isa & 1) {
            measure(&tree, (burnish_isa)isa);
        }
    }
#ifdef BURNISH_BENCH_EMBREE
    measure_embree(&tree);
#endif
    burnish_ray_tree_destroy(&tree, NULL);
    burnish_mesh_destroy(mesh);
    return 0;
}
