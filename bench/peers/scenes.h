/* Scenes made by the program, one per kind of shape: what is fast on one is slow on another. */
#ifndef BURNISH_BENCH_PEERS_SCENES_H
#define BURNISH_BENCH_PEERS_SCENES_H

#include "burnish/mesh.h"

/* White lights, directional or points near the object. */
typedef struct burnish_scene_lights {
    int count; /* [1, 16] */
    int near;
} burnish_scene_lights;

typedef struct burnish_scene {
    burnish_mesh *mesh;
    burnish_camera camera; /* for the aspect asked for */
    burnish_scene_lights lights;
    int cull_back_faces; /* 0: the surfaces are open, both sides are lit */
} burnish_scene;

/* The name of scene index, NULL after the last. */
const char *burnish_scene_name(size_t index);

/* What it shows and why, in a few words. */
const char *burnish_scene_text(size_t index);

/* Makes the scene of that name, its camera for pictures of that width / height. The mesh is the
 * caller's. Errors: ARGUMENT for an unknown name, READ if the bunny's file is missing, and the
 * errors of burnish_mesh_create. */
burnish_status burnish_scene_make(const char *name, double aspect, burnish_scene *scene,
                                  burnish_error *error);

#endif
