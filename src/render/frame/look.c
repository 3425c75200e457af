/* Looks: sets of options by name. docs/README.md shows them. */
#include "render/frame/render_options.h"

#include <string.h>

/* Which materials a look changes. */
typedef enum recolors { NONE, UNCOLORED, ALL } recolors;

typedef struct look {
    burnish_light lights[3];
    int light_count;
    float ambient;
    const burnish_area_light *areas;
    int area_count;
    const burnish_dome *dome; /* NULL: none */
    float reflection_distance;
    recolors recolors; /* these materials become ... */
    float grey[3], specular;
    float roughness, reflectance; /* for area lights; 0: the same as specular and exponent */
    uint8_t background[3];
    burnish_tone_mapping tones;
    int occlusion;
    float occlusion_strength;
    burnish_edge_flags edges; /* burnish_render_options has the colour */
    float edge_width;
    int outline_contrast;
} look;

/* Directions of key, fill and rim light: the photographer's three points. */
#define KEY                                                                                        \
    { -0.55, 0.75, 0.85 }
#define FILL                                                                                       \
    { 0.90, 0.15, 0.55 }
#define RIM                                                                                        \
    { 0.35, 0.60, -0.80 }
#define LIGHT .follows_camera = 1, .vector
#define EDGE_WIDTH 1.8f

/* A rectangle that faces the object, far away. */
#define BOX BURNISH_AREA_RECT, 1, 1, 0

/* A product studio: a window on the upper left, a strip on the right, a panel above and behind,
 * a rim light on the left behind the object, and a table that rises toward the viewer with a brighter
 * card on it, which vertical faces of metal reflect. They are so close (reflection_distance) that a flat
 * face reflects an edge of one of them. A white, matt surface gets at most 1.59, which tone mapping
 * takes to 0.946: most of a white part is brighter than 0.75. */
static const burnish_area_light STUDIO_AREAS[] = {
    {BOX,
     {-0.4716, 0.6428, 0.6037},
     {0.1994, 0.3860, -0.2552},
     {0.3404, 0, 0.2659},
     {5.418f, 5.312f, 5.073f}},
    {BOX,
     {0.9458, 0.1045, 0.3073},
     {-0.0795, 0.7956, -0.0258},
     {0.078, 0, -0.24},
     {1.052f, 1.106f, 1.184f}},
    {BOX, {0, 0.7193, -0.6947}, {0, 0.2779, 0.2877}, {-2, 0, 0}, {0.9462f, 0.996f, 1.066f}},
    {BOX,
     {-0.8851, 0.1736, -0.4317},
     {0.1171, 0.7386, 0.0571},
     {-0.0877, 0, 0.1798},
     {0.7097f, 0.747f, 0.7993f}},
    {BOX, {0, -0.87, 0.5}, {0, 0.5, 0.87}, {2.2, 0, 0}, {0.2623f, 0.2573f, 0.249f}},
    {BOX, {-0.2, -0.97, 0.326}, {0, 0.35, 0.609}, {0.9, 0, 0}, {0.415f, 0.4067f, 0.3943f}},
};
static const burnish_dome STUDIO_DOME = {
    {0.4731f, 0.498f, 0.5329f}, {0.08665f, 0.0913f, 0.09777f}, {0.0996f, 0.0996f, 0.0996f}, 1};

/* A surface that faces the key light gets key + ambient + a little fill = 0.79 linear, 0.9 of
 * white. THREE_POINT's grey is as bright under its lights as burnish's 0.34 under PLAIN's; STUDIO's is
 * a little brighter. */
static const look LOOKS[BURNISH_LOOK_COUNT] = {
    [BURNISH_LOOK_PLAIN] = {.lights = {{LIGHT = KEY, .color = {1.22f, 1.19f, 1.13f}},
                                       {LIGHT = FILL, .color = {0.24f, 0.28f, 0.34f}},
                                       {LIGHT = RIM, .color = {0.68f, 0.68f, 0.72f}}},
                            .light_count = 3,
                            .ambient = 0.08f,
                            .background = {255, 255, 255},
                            .occlusion_strength = 0.75f,
                            .edge_width = EDGE_WIDTH},
    /* A base a little cool, because the window is warm. Without area lights: as THREE_POINT. */
    [BURNISH_LOOK_STUDIO] = {.areas = STUDIO_AREAS,
                             .area_count = sizeof STUDIO_AREAS / sizeof *STUDIO_AREAS,
                             .dome = &STUDIO_DOME,
                             .reflection_distance = 1.5f,
                             .recolors = UNCOLORED,
                             .grey = {0.344f, 0.35f, 0.359f},
                             .tones = BURNISH_TONES_SOFT,
                             .specular = 0.75f,
                             .roughness = 0.35f,
                             .reflectance = 0.1f,
                             .background = {238, 239, 241},
                             .occlusion = BURNISH_OCCLUSION_AUTO,
                             .occlusion_strength = 0.95f,
                             .edges = BURNISH_EDGES_AXIS_VIEWS,
                             .edge_width = EDGE_WIDTH,
                             .outline_contrast = 36},
    [BURNISH_LOOK_CLAY] = {.lights = {{LIGHT = KEY, .color = {0.60f, 0.59f, 0.57f}},
                                      {LIGHT = FILL, .color = {0.14f, 0.16f, 0.19f}},
                                      {LIGHT = RIM, .color = {0.25f, 0.25f, 0.26f}}},
                           .light_count = 3,
                           .ambient = 0.18f,
                           .recolors = ALL,
                           .grey = {0.62f, 0.50f, 0.40f},
                           .specular = 0.03f,
                           .background = {238, 239, 241},
                           .occlusion = BURNISH_OCCLUSION_AUTO,
                           .occlusion_strength = 0.95f,
                           .edges = BURNISH_EDGES_AXIS_VIEWS,
                           .edge_width = EDGE_WIDTH},
    /* Light enough everywhere that black lines stand out. */
    [BURNISH_LOOK_TECHNICAL] = {.lights = {{LIGHT = {-0.45, 0.75, 0.85},
                                            .color = {0.50f, 0.50f, 0.50f}}},
                                .light_count = 1,
                                .ambient = 0.36f,
                                .recolors = UNCOLORED,
                                .grey = {0.72f, 0.74f, 0.77f},
                                .specular = 0.0f,
                                .background = {255, 255, 255},
                                .occlusion_strength = 0.75f,
                                .edges = BURNISH_EDGES_FEATURES | BURNISH_EDGES_TANGENTS,
                                .edge_width = EDGE_WIDTH},
    [BURNISH_LOOK_DRAWING] = {.ambient = 1,
                              .recolors = ALL,
                              .grey = {1, 1, 1},
                              .background = {255, 255, 255},
                              .occlusion_strength = 0.75f,
                              .edges = BURNISH_EDGES_FEATURES | BURNISH_EDGES_TANGENTS,
                              .edge_width = EDGE_WIDTH},
    /* A dark material, which makes the highlight prominent. */
    [BURNISH_LOOK_LOBES] = {.lights = {{LIGHT = KEY, .color = {1, 1, 1}}},
                            .light_count = 1,
                            .ambient = 0.08f,
                            .recolors = UNCOLORED,
                            .grey = {0.10f, 0.10f, 0.10f},
                            .specular = 0.9f,
                            .background = {255, 255, 255},
                            .occlusion_strength = 0.75f,
                            .edge_width = EDGE_WIDTH},
    [BURNISH_LOOK_THREE_POINT] = {.lights = {{LIGHT = KEY, .color = {0.70f, 0.685f, 0.65f}},
                                             {LIGHT = FILL, .color = {0.16f, 0.185f, 0.22f}},
                                             {LIGHT = RIM, .color = {0.36f, 0.36f, 0.38f}}},
                                  .light_count = 3,
                                  .ambient = 0.08f,
                                  .recolors = UNCOLORED,
                                  .grey = {0.54f, 0.54f, 0.54f},
                                  .specular = 0.75f,
                                  .background = {238, 239, 241},
                                  .occlusion = BURNISH_OCCLUSION_AUTO,
                                  .occlusion_strength = 0.8f,
                                  .edges = BURNISH_EDGES_AXIS_VIEWS,
                                  .edge_width = EDGE_WIDTH},
};

static burnish_status check_look(burnish_look name, burnish_error *error) {
    return (unsigned)name < BURNISH_LOOK_COUNT
               ? BURNISH_STATUS_OK
               : burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                              "look %d: there are looks from 0 to %d", (int)name,
                              BURNISH_LOOK_COUNT - 1);
}

void burnish_look_apply(burnish_look name, burnish_render_options *options) {
    const look *wanted = &LOOKS[name];
    memcpy(options->lights, wanted->lights, sizeof wanted->lights);
    options->light_count = wanted->light_count;
    options->area_light_count = wanted->area_count;
    for (int i = 0; i < wanted->area_count; ++i) {
        options->area_lights[i] = wanted->areas[i];
    }
    options->has_dome = wanted->dome != NULL;
    options->dome = wanted->dome ? *wanted->dome : (burnish_dome){.zenith = {0}};
    options->reflection_distance = wanted->reflection_distance;
    options->tone_mapping = wanted->tones;
    options->occlusion = wanted->occlusion;
    options->occlusion_strength = wanted->occlusion_strength;
    options->ignore_colors = wanted->recolors == ALL;
    options->edges = wanted->edges;
    options->edge_width = wanted->edge_width;
    options->outline_contrast = wanted->outline_contrast;
    for (int k = 0; k < 3; ++k) {
        options->ambient_light[k] = wanted->ambient;
        options->background[k] = wanted->background[k];
    }
}

burnish_status burnish_render_options_set_look(burnish_render_options *options, burnish_look name,
                                               burnish_error *error) {
    burnish_status status = burnish_render_options_check_cookie(options, error);
    if (status == BURNISH_STATUS_OK) {
        status = check_look(name, error);
    }
    if (status == BURNISH_STATUS_OK) {
        burnish_look_apply(name, options);
    }
    return status;
}

burnish_status burnish_look_set_materials(burnish_look name, burnish_mesh *mesh,
                                          burnish_error *error) {
    burnish_status status = check_look(name, error);
    const look *wanted = status == BURNISH_STATUS_OK ? &LOOKS[name] : &LOOKS[0];
    const size_t count =
        mesh && wanted->recolors != NONE ? burnish_mesh_get_material_count(mesh) : 0;
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        burnish_material material = *burnish_mesh_get_material(mesh, i);
        if (material.has_diffuse && wanted->recolors == UNCOLORED) {
            continue;
        }
        memset(material.textures, 0, sizeof material.textures);
        memset(material.emissive, 0, sizeof material.emissive);
        memset(material.sheen, 0, sizeof material.sheen);
        material.is_metallic = material.is_unlit = material.has_exponent = 0;
        material.metallic = material.coat = material.edge_loss = 0;
        material.roughness = wanted->roughness;
        material.alpha_mode = BURNISH_ALPHA_IGNORE;
        for (int k = 0; k < 3; ++k) {
            material.ambient[k] = material.diffuse[k] = wanted->grey[k];
            material.specular[k] = wanted->specular;
            material.reflectance[k] = wanted->reflectance;
        }
        material.transparency = wanted->recolors == ALL ? 0 : material.transparency;
        status = burnish_mesh_set_material(mesh, i, &material, error);
    }
    return status;
}
