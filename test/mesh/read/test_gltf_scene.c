/* glTF: nodes, animations, cameras, lights, materials and textures. */
#include <math.h>

#include "gltf_input.h"

/* ---- Nodes ---- */

/* A chain of a matrix, a turn about z, and a mirror, against the same by hand. */
static void test_hierarchy(void) {
    /* p -> 2 p + (10, 20, 30); a quarter turn: (x, y) -> (-y, x); then x mirrored, y times 3. */
    read_good("$head$triangle,'scene':1,'scenes':[{'nodes':[3]},{'nodes':[2]}],"
              "'nodes':[{'mesh':0,'scale':[-1,3,1]},{'children':[0],'rotation':[0,0,"
              "0.70710678118654757,0.70710678118654757]},{'children':[1],'matrix':[2,0,0,"
              "0, 0,2,0,0, 0,0,2,0, 10,20,30,1]},{'mesh':0}]}",
              NULL);
    /* The mirror turns the winding: corners 0, 2, 1. */
    CHECK1(got.triangle_count == 1 && corner_is(0, 0, 10, 20, 30) && corner_is(0, 2, 10, 18, 30) &&
           corner_is(0, 1, -2, 20, 30));
    /* Without scenes, all visible roots are drawn. */
    read_good("$head$triangle,'extensionsUsed':['KHR_node_visibility'],"
              "'nodes':[{'mesh':0},{'children':[2],'extensions':{'KHR_node_visibility':{'vi"
              "sible':false}}},{'mesh':0},{'mesh':0,'translation':[5,0,0]}]}",
              NULL);
    CHECK1(got.triangle_count == 2 && corner_is(1, 0, 5, 0, 0));
    check_warning(NULL);
    /* A missing scene is ignored. */
    read_good("$head$triangle,'scene':3,'nodes':[{'mesh':0}]}", NULL);
    CHECK1(got.triangle_count == 1);
    check_warning("mesh.gltf:1: scene: 3 is not in scenes, of which there are 0; ignored");
}

/* Normals stay at right angles to a stretched surface, and on the correct side when mirrored. */
static void test_normals_of_nodes(void) {
    static const float positions[9] = {0, 0, 0, 1, 1, 0, 0, 0, 1};
    static const float normals[9] = {1, -1, 0, 1, -1, 0, 1, -1, 0};
    for (int mirror = 0; mirror < 2; ++mirror) {
        byte_list binary = {.size = 0};
        char json[1024];
        put_floats(&binary, 9, positions);
        put_floats(&binary, 9, normals);
        snprintf(json, sizeof json,
                 "$head$buffer(72),'bufferViews':[$view(0,36),$view(36,36)],"
                 "'accessors':[$accessor(0,5126,3,VEC3),$accessor(1,5126,3,VEC3)],"
                 "$mesh('POSITION':0,'NORMAL':1),'nodes':[{'mesh':0,'scale':[%d,1,1]}]}",
                 mirror ? -4 : 4);
        read_good(json, &binary);
        /* (1/4, -1, 0), the 1/4 mirrored, made a unit vector */
        const double x = (mirror ? -0.25 : 0.25) / sqrt(0.0625 + 1), y = -1 / sqrt(0.0625 + 1);
        for (size_t i = 0; i < 3; ++i) {
            const float *n = burnish_normals(&got) + 3 * i;
            CHECK(fabs((double)n[0] - x) < 1e-7 && fabs((double)n[1] - y) < 1e-7 && n[2] == 0,
                  "%g %g %g", (double)n[0], (double)n[1], (double)n[2]);
        }
    }
}

/* ---- What moves vertices ---- */

/* Views over one buffer: positions, then whatever follows. */
static burnish_status read_posed(const char *rest, const byte_list *binary, double time,
                                 const char *animation) {
    static byte_list list;
    static char json[4096];
    burnish_load_options options = burnish_load_options_default();
    options.animation_time = time;
    options.animation = animation;
    snprintf(json, sizeof json, "$head$buffer(%zu),%s}", binary->size, rest);
    list.size = 0;
    put_glb(&list, json, binary);
    return run_reader(BURNISH_FORMAT_GLTF, list.bytes, list.size, &options, NULL);
}

/* p + 0.5 (0, 0, 4) for vertex 1. The node's weights precede the mesh's, weight 0 has no effect,
 * and normals also move. */
static void test_morph_targets(void) {
    static const float floats[] = {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 1,  0, 0, 1,
                                   0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0};
    static const struct {
        const char *weights;
        double z, n[3];
    } cases[] = {{"]}],'nodes':[{'mesh':0", 0, {0, 0, 1}},
                 {"],'weights':[0.5,9]}],'nodes':[{'mesh':0", 2, {0.5, 0, 0.5}},
                 {"],'weights':[7,0]}],'nodes':[{'mesh':0,'weights':[1,0]", 4, {1, 0, 0}}};
    byte_list binary = {.size = 0};
    put_floats(&binary, 36, floats);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char rest[1024];
        snprintf(rest, sizeof rest,
                 "'bufferViews':[{'buffer':0,'byteLength':144,'byteStride':12}],"
                 "'accessors':[$accessor(0,5126,3,VEC3),$part(36,5126,3,VEC3),"
                 "$part(72,5126,3,VEC3),$part(108,5126,3,VEC3)],"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1},"
                 "'targets':[{'POSITION':2,'NORMAL':3},{}]}%s}]",
                 cases[i].weights);
        if (!CHECK_OK(read_posed(rest, &binary, BURNISH_AT_REST, NULL), fault)) {
            continue;
        }
        CHECK1(corner_is(0, 1, 1, 0, cases[i].z) && corner_is(0, 2, 0, 2, 0));
        const float *n = burnish_normals(&got) + 3;
        const double length = sqrt(cases[i].n[0] * cases[i].n[0] + cases[i].n[2] * cases[i].n[2]);
        CHECK(fabs((double)n[0] - cases[i].n[0] / length) < 1e-6 &&
                  fabs((double)n[2] - cases[i].n[2] / length) < 1e-6,
              "%g %g", (double)n[0], (double)n[2]);
    }
}

/* Two joints, of which the second is turned by 90 degrees about z around its place (1, 0, 0) and
 * bound there: vertices follow joint 0, joint 1, and both by half. The node's own matrix has no
 * effect. */
static void test_skin(void) {
    static const float positions[9] = {5, 0, 0, 2, 0, 0, 2, 0, 0};
    static const float weights[12] = {1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0};
    static const float bind[32] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,
                                   1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1};
    byte_list binary = {.size = 0};
    put_floats(&binary, 9, positions);
    put_floats(&binary, 12, weights);
    put_floats(&binary, 32, bind);
    put(&binary, "\0\1\0\0\0\1\0\0\0\1\0\0", 12);
    static const char rest[] =
        "'bufferViews':[$view(0,36),$view(36,48),$view(84,128),$view(212,12)],"
        "'accessors':[$accessor(0,5126,3,VEC3),$accessor(1,5126,3,VEC4),"
        "$accessor(2,5126,2,MAT4),$accessor(3,5121,3,VEC4)],"
        "$mesh('POSITION':0,'WEIGHTS_0':1,'JOINTS_0':3),'skins':[{'joints':[1,2],"
        "'inverseBindMatrices':2}],'nodes':[{'mesh':0,'skin':0,'translation':[100,0,"
        "0]},{},{'translation':[1,0,0],'rotation':[0,0,0.70710678118654757,"
        "0.70710678118654757]}]";
    CHECK_OK(read_posed(rest, &binary, BURNISH_AT_REST, NULL), fault);
    /* (5, 0, 0); (1, 0, 0) + (0, 1, 0); the middle of (2, 0, 0) and (1, 1, 0) */
    CHECK1(corner_is(0, 0, 5, 0, 0) && corner_is(0, 1, 1, 1, 0) && corner_is(0, 2, 1.5, 0.5, 0));
    binary.bytes[212] = 2;
    CHECK1(read_posed(rest, &binary, BURNISH_AT_REST, NULL) == BURNISH_STATUS_FORMAT);
    CHECK1(strstr(fault.text, "accessors[3]: joint 2 of vertex 0 is not below the skin's 2"));
}

static void test_instances(void) {
    static const float floats[] = {0, 0,  0, 1, 0, 0, 0, 2,  0, 10, 0,
                                   0, 20, 0, 0, 2, 2, 2, -1, 1, 1};
    byte_list binary = {.size = 0};
    put_floats(&binary, sizeof floats / sizeof *floats, floats);
    CHECK_OK(read_posed("'bufferViews':[$view(0,84)],'accessors':[$accessor(0,5126,3,VEC3),"
                        "$part(36,5126,2,VEC3),$part(60,5126,2,VEC3)],"
                        "'extensionsRequired':['EXT_mesh_gpu_instancing'],$mesh('POSITION':0),"
                        "'nodes':[{'mesh':0,'translation':[0,0,5],"
                        "'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':1,"
                        "'SCALE':2}}}}]",
                        &binary, BURNISH_AT_REST, NULL),
             fault);
    CHECK1(got.triangle_count == 2 && corner_is(0, 1, 12, 0, 5) && corner_is(0, 2, 10, 4, 5) &&
           corner_is(1, 2, 19, 0, 5) && corner_is(1, 1, 20, 2, 5)); /* a mirror */
}

static const struct {
    const char *animation, *path;
    double time, x;
} moments[] = {{"0", "", 0, 0},
               {"0", "", 2, 4},
               {"0", "", 2.5, 6},
               {"linear", "", 9, 8},
               {"step", "", 2.9, 0},
               {"1", "", 3, 8},
               {"cubic", "", 1, 0},
               {"cubic", "", 3, 8},
               /* t = 1/2: 8/2 + 2 (1/8 1) - 2 (1/8 2) */
               {"cubic", "", 2, 4 + 0.25 - 0.5}};

/* Translations 0 at 1 s and (8, 0, 0) at 3 s by each interpolation; a rotation of a quarter turn,
 * whose middle is an eighth of one, and whose quarters are equal angles. */
static void test_animation(void) {
    static const float times[2] = {1, 3};
    static const float steps[6] = {0, 0, 0, 8, 0, 0};
    /* in-tangent, value, out-tangent, twice */
    static const float cubic[18] = {9, 9, 9, 0, 0, 0, 1, 0, 0, 2, 0, 0, 8, 0, 0, 9, 9, 9};
    static const float turns[8] = {0, 0, 0, 1, 0, 0, -0.70710678f, -0.70710678f};
    byte_list binary = {.size = 0};
    put_floats(&binary, 9, gltf_triangle);
    put_floats(&binary, 2, times);
    put_floats(&binary, 6, steps);
    put_floats(&binary, 18, cubic);
    put_floats(&binary, 8, turns);
    static const char rest[] =
        "'bufferViews':[$view(0,172)],'accessors':[$accessor(0,5126,3,VEC3),"
        "$part(36,5126,2,SCALAR),$part(44,5126,2,VEC3),$part(68,5126,6,VEC3),"
        "$part(140,5126,2,VEC4)],$mesh('POSITION':0),'nodes':[{'mesh':0,"
        "'translation':[0,7,0]}],'animations':[{'name':'linear',"
        "'samplers':[{'input':1,'output':2}],'channels':[{'sampler':0,"
        "'target':{'node':0,'path':'translation'}}]},{'name':'step',"
        "'samplers':[{'input':1,'output':2,'interpolation':'STEP'}],"
        "'channels':[{'sampler':0,'target':{'node':0,'path':'translation'}}]},"
        "{'name':'cubic','samplers':[{'input':1,'output':3,"
        "'interpolation':'CUBICSPLINE'}],'channels':[{'sampler':0,"
        "'target':{'node':0,'path':'translation'}}]},{'name':'turn',"
        "'samplers':[{'input':1,'output':4}],'channels':[{'sampler':0,"
        "'target':{'node':0,'path':'rotation'}}]}]";
    for (size_t i = 0; i < sizeof moments / sizeof *moments; ++i) {
        CHECK_OK(read_posed(rest, &binary, moments[i].time, moments[i].animation), fault);
        CHECK(corner_is(0, 0, moments[i].x, 0, 0), "%zu: %g", i,
              (double)burnish_positions(&got)[0]);
        CHECK1(got.animation_seconds == 3); /* whatever the time */
    }
    CHECK_OK(read_posed(rest, &binary, BURNISH_AT_REST, NULL), fault);
    CHECK1(corner_is(0, 0, 0, 7, 0));
    /* From no turn to one of 90 degrees about z, whose quaternion has the other sign. */
    for (int quarter = 0; quarter <= 4; ++quarter) {
        CHECK_OK(read_posed(rest, &binary, 1 + quarter / 2.0, "turn"), fault);
        const double angle = quarter * acos(0) / 4;
        CHECK(corner_is(0, 1, cos(angle), 7 + sin(angle), 0), "%d", quarter);
    }
    check_fault(read_posed(rest, &binary, 0, "4"), BURNISH_STATUS_ARGUMENT,
                "mesh.gltf: animation \"4\" does not exist; give a name or a number from 0 "
                "to 3");
    read_good("$head$triangle,$node}", NULL);
}

/* ---- Cameras and lights ---- */

static void test_cameras(void) {
    read_good("$head$triangle,'cameras':[{'type':'perspective','perspective':{'yfov':0.5,"
              "'znear':1}},{'name':'plan','type':'orthographic',"
              "'orthographic':{'ymag':3}}],'nodes':[{'mesh':0},{'name':'front','camera':0,"
              "'translation':[0.5,1,10]},{'camera':1,'translation':[0,50,0],"
              "'rotation':[-0.70710678118654757,0,0,0.70710678118654757]}]}",
              NULL);
    if (CHECK1(got.camera_count == 2)) {
        const burnish_camera *c = &got.cameras[0].camera;
        CHECK_TEXT(got.cameras[0].name, "front");
        CHECK1(c->position[0] == 0.5 && c->position[2] == 10 && c->view_up[1] == 1 &&
               c->orthographic_height == 0 && fabs(c->view_angle - 90 / acos(0) * 0.5) < 1e-9);
        /* as far away as the middle of the triangle's box */
        CHECK1(fabs(c->focal_point[0] - 0.5) < 1e-9 && fabs(c->focal_point[2]) < 1e-9);
        CHECK_TEXT(got.cameras[1].name, "plan");
        c = &got.cameras[1].camera;
        CHECK1(c->orthographic_height == 6 && fabs(c->focal_point[1] - 1) < 1e-9 &&
               fabs(c->view_up[2] + 1) < 1e-9 && fabs(c->view_up[1]) < 1e-9);
    }
}

/* Lux at the middle of the triangle's box, (0.5, 1, 0): 2 from +z, and from -x 18 / 3^2 = 2, of
 * which green is half. The lights do not face each other, so 2 becomes 1. The invisible, the dark
 * and the missing light are skipped. */
static void test_lights(void) {
    read_good("$head$triangle,'extensionsUsed':['KHR_lights_punctual'],"
              "'extensions':{'KHR_lights_punctual':{'lights':[{'type':'directional',"
              "'intensity':2},{'type':'spot','intensity':18,'color':[1,0.5,0],"
              "'range':7,'spot':{'outerConeAngle':1.0471975511965976}},"
              "{'type':'point','intensity':0}]}},'nodes':[{'mesh':0},"
              "{'extensions':{'KHR_lights_punctual':{'light':0}},'translation':[7,8,9]},"
              "{'extensions':{'KHR_lights_punctual':{'light':1}},'translation':[-2.5,1,"
              "0]},{'extensions':{'KHR_lights_punctual':{'light':2}}},"
              "{'extensions':{'KHR_lights_punctual':{'light':3}}},"
              "{'extensions':{'KHR_lights_punctual':{'light':0},"
              "'KHR_node_visibility':{'visible':false}}}]}",
              NULL);
    if (CHECK1(got.light_count == 2)) {
        const burnish_light *sun = &got.lights[0], *lamp = &got.lights[1];
        CHECK1(sun->kind == BURNISH_LIGHT_DIRECTIONAL && !sun->follows_camera);
        CHECK1(sun->vector[0] == 0 && sun->vector[1] == 0 && sun->vector[2] == 1);
        CHECK1(lamp->kind == BURNISH_LIGHT_POINT && lamp->distance == 3 && lamp->range == 7);
        CHECK1(lamp->axis[0] == 0 && lamp->axis[1] == 0 && lamp->axis[2] == -1);
        CHECK1(lamp->cone[0] == 1 && fabs(lamp->cone[1] - 0.5) < 1e-12);
        CHECK1(lamp->vector[0] == -2.5 && lamp->vector[1] == 1 && lamp->vector[2] == 0);
        for (int k = 0; k < 3; ++k) {
            CHECK1(sun->color[k] == 1 && fabsf(lamp->color[k] - (1 - 0.5f * (float)k)) < 1e-6f);
        }
    }
    CHECK1(got.warning_count == 0);
    CHECK1(read_gltf("$head$triangle,$node}") == BURNISH_STATUS_OK && got.light_count == 0);
}

/* ---- Materials ---- */

static void test_materials(void) {
    read_good("$head$triangle_accessors,'materials':[{'pbrMetallicRoughness':{'baseColorFac"
              "tor':[0.5,0.25,1,0.5],'metallicFactor':0,'roughnessFactor':0.5}},"
              "{'pbrMetallicRoughness':{'baseColorFactor':[0.5,0.25,1,0.5],"
              "'roughnessFactor':1},'alphaMode':'BLEND'},"
              "{'extensions':{'KHR_materials_pbrSpecularGlossiness':{'diffuseFactor':[1,"
              "0.5,0,1],'specularFactor':[0.1,0.1,0.1],'glossinessFactor':0.5}}},"
              "{'pbrMetallicRoughness':{'metallicFactor':'x'},"
              "'extensions':{'KHR_materials_unlit':{}}}],"
              "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0},"
              "{'attributes':{'POSITION':0},'material':1},{'attributes':{'POSITION':0}},"
              "{'attributes':{'POSITION':0},'material':3}]}],$node}",
              NULL);
    CHECK1(got.material_count == 5 && got.triangle_count == 4 && got.triangle_materials[1] == 1 &&
           got.triangle_materials[2] == 4 && got.triangle_materials[3] == 3);
    const burnish_material *m = got.materials;
    /* alpha 1/4: n = 2 * 16 - 2 = 30, and a height of 0.04 * 32 / 8 */
    CHECK1(m->exponent == 30 && m->diffuse[0] == 0.5f && m->diffuse[2] == 1 &&
           m->ambient[1] == 0.25f && m->transparency == 0);
    CHECK1(fabsf(m->specular[0] - 0.16f) < 1e-6f);
    ++m; /* a metal: no diffuse, its colour is the highlight's, 3/8 as high as n = 1 has it */
    CHECK1(m->exponent == 1 && m->diffuse[2] == 0 && m->transparency == 0.5f &&
           m->ambient[2] == 1 && m->specular[0] == 0.1875f);
    ++m;
    CHECK1(m->exponent == 30 && m->diffuse[1] == 0.5f && fabsf(m->specular[1] - 0.4f) < 1e-6f);
    ++m;
    CHECK1(m->is_unlit && m->diffuse[0] == 1 && m->specular[0] == 0);
    check_warning("mesh.gltf:1: materials[3].pbrMetallicRoughness.metallicFactor: expected a "
                  "number, found \"x\"; ignored");
}

/* Nodes scale the thickness of volumes. Without transmission there is none. */
static void test_volumes(void) {
    read_good("$head$triangle_accessors,'materials':[{'extensions':{'KHR_materials_transmission':"
              "{'transmissionFactor':0.75},'KHR_materials_ior':{'ior':1.25},'KHR_materials_volume':"
              "{'thicknessFactor':2,'attenuationDistance':4,'attenuationColor':[0.5,1,2]}}},"
              "{'extensions':{'KHR_materials_volume':{'thicknessFactor':1}}}],"
              "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0},"
              "{'attributes':{'POSITION':0},'material':1}]}],'nodes':[{'mesh':0},"
              "{'mesh':0,'scale':[3,3,-3]},{'mesh':0,'scale':[3,3,3]}]}",
              NULL);
    const burnish_material *m = got.materials;
    CHECK1(m->is_metallic && m->transmission == 0.75f && m->thickness == 2 &&
           m->refractive_index == 1.25f && m->attenuation_distance == 4 &&
           m->attenuation_color[0] == 0.5f && m->attenuation_color[2] == 1);
    CHECK1(m[1].transmission == 0 && m[1].thickness == 0 && got.material_count == 3);
    CHECK1(fabsf(m[2].thickness - 6) < 1e-6f && got.triangle_materials[0] == 0 &&
           got.triangle_materials[2] == 2 && got.triangle_materials[4] == 2);
}

/* Primitives without a material are white, unlike those of other formats. */
static void test_default_material(void) {
    read_good("$head$triangle,$node}", NULL);
    const burnish_material *m = got.materials;
    CHECK1(got.material_count == 1 && m->has_diffuse && m->diffuse[0] == 1 && m->diffuse[2] == 1 &&
           m->ambient[1] == 1 && m->roughness == 1 && m->reflectance[0] == 0.04f);
}

/* Splats next to points are drawn alone, next to others with them. */
static void test_splats(void) {
    static const struct {
        const char *other, *warning;
    } cases[] = {
        {"0", "mesh.gltf:1: meshes[0].primitives[0]: points are not drawn in a file with splats"},
        {"2", NULL},
        {"4", NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char json[500];
        snprintf(json, sizeof json,
                 "$head$triangle_accessors,'meshes':[{'primitives':[{'attributes':{'POSITION':0},"
                 "'mode':%s},{'attributes':{'POSITION':0,'SCALE':0},'mode':0,'extensions':"
                 "{'KHR_gaussian_splatting':{}}}]}],$node}",
                 cases[i].other);
        read_good(json, NULL);
        if (cases[i].warning) {
            check_warning(cases[i].warning);
        }
        const burnish_mesh_data *splats = cases[i].warning ? &got : got.splats;
        CHECK1(splats && splats->streams[BURNISH_SPLAT].count == 3 && splats->point_count == 3);
        CHECK1(got.warning_count == (cases[i].warning != NULL));
    }
}

/* A variant puts another material in a primitive's place; a primitive that does not map it keeps
 * its own. */
static void test_variants(void) {
    static const char json[] =
        "$head$triangle_accessors,'materials':[{},{'doubleSided':true},{}],"
        "'extensions':{'KHR_materials_variants':{'variants':[{'name':'red'},{'name':'dark "
        "blue'}]}},"
        "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0,'extensions':"
        "{'KHR_materials_variants':{'mappings':[{'material':2,'variants':[0]},"
        "{'material':1,'variants':[7,1]}]}}},{'attributes':{'POSITION':0},'material':0}]}],$node}";
    static const struct {
        const char *variant;
        int material;
    } cases[] = {{NULL, 0}, {"red", 2}, {"dark blue", 1}};
    static byte_list list;
    burnish_load_options options = burnish_load_options_default();
    put_json(&list, json);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        options.variant = cases[i].variant;
        CHECK_OK(run_reader(BURNISH_FORMAT_GLTF, list.bytes, list.size, &options, NULL), fault);
        CHECK(got.triangle_count == 2 && got.triangle_materials[0] == cases[i].material &&
                  got.triangle_materials[1] == 0,
              "%zu: %d", i, got.triangle_materials[0]);
        CHECK1(got.variant_count == 2 && strcmp(got.variants[1], "dark blue") == 0);
    }
    options.variant = "blue";
    check_fault(run_reader(BURNISH_FORMAT_GLTF, list.bytes, list.size, &options, NULL),
                BURNISH_STATUS_ARGUMENT,
                "mesh.gltf: variant \"blue\" does not exist; the file has red, dark blue");
}

/* ---- Textures ---- */

/* One image as colours and as numbers is two textures, however often it is used. The transform of
 * (u, v) = (1/4, 1/4 from above) is checked by hand. */
static void test_textures(void) {
    read_good("$head$triangle_accessors,'images':[$image],'samplers':[{'wrapS':33071,"
              "'wrapT':33648,'magFilter':9728}],'textures':[{'source':0,'sampler':0},"
              "{'source':0}],'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'ind"
              "ex':0,'extensions':{'KHR_texture_transform':{'offset':[0.5,0.25],"
              "'scale':[2,4],'rotation':1.5707963267948966}}},"
              "'metallicRoughnessTexture':{'index':1}},'normalTexture':{'index':1,"
              "'scale':0.5},'emissiveTexture':{'index':1},'occlusionTexture':{'index':1,"
              "'texCoord':1},'emissiveFactor':[1,0,0.5],"
              "'extensions':{'KHR_materials_emissive_strength':{'emissiveStrength':3}},"
              "'alphaMode':'MASK','alphaCutoff':0.25}],"
              "$painted}",
              NULL);
    const burnish_material *m = got.materials;
    const burnish_texture_use *color = &m->textures[BURNISH_TEXTURE_COLOR];
    CHECK1(got.texture_count == 2 && got.textures[color->texture - 1].is_color &&
           m->textures[BURNISH_TEXTURE_EMISSIVE].texture == color->texture &&
           m->textures[BURNISH_TEXTURE_NORMAL].texture ==
               m->textures[BURNISH_TEXTURE_METALLIC_ROUGHNESS].texture &&
           m->textures[BURNISH_TEXTURE_OCCLUSION].texture > 0 &&
           m->textures[BURNISH_TEXTURE_OCCLUSION].coordinates == 1);
    CHECK1(color->wrap[0] == BURNISH_WRAP_CLAMP && color->wrap[1] == BURNISH_WRAP_MIRROR &&
           color->is_nearest && m->textures[BURNISH_TEXTURE_NORMAL].strength == 0.5f &&
           m->textures[BURNISH_TEXTURE_NORMAL].wrap[0] == BURNISH_WRAP_REPEAT);
    CHECK1(m->is_metallic && m->emissive[0] == 3 && m->emissive[2] == 1.5f &&
           m->alpha_mode == BURNISH_ALPHA_MASK && m->alpha_cutoff == 0.25f && m->diffuse[0] == 1);
    /* Scaled (1/2, 1), turned to (1, -1/2), moved to (3/2, -1/4), which is 5/4 from below. */
    const float *t = color->transform, u = 0.25f, v = 0.75f;
    CHECK(color->has_transform && fabsf(t[0] * u + t[1] * v + t[2] - 1.5f) < 1e-6f &&
              fabsf(t[3] * u + t[4] * v + t[5] - 1.25f) < 1e-6f,
          "%g %g", (double)(t[0] * u + t[1] * v + t[2]), (double)(t[3] * u + t[4] * v + t[5]));
    CHECK1(got.warning_count == 0);
}

/* KHR_materials_specular: strengths are the alpha of their image, here 127. A material of numbers
 * that are 0 still reflects at its rim. */
static void test_specular(void) {
    read_good("$head$triangle_accessors,'images':[$image],'textures':[{'source':0}],"
              "'materials':[{'extensions':{'KHR_materials_specular':{'specularFactor':0.25,"
              "'specularColorTexture':{'index':0},'specularTexture':{'index':0}}}},"
              "{'pbrMetallicRoughness':{'metallicFactor':0,'roughnessFactor':0},'extensions':"
              "{'KHR_materials_specular':{'specularColorFactor':[0,0,0]}}}],$painted}",
              NULL);
    const burnish_material *m = got.materials;
    const int color = m[0].textures[BURNISH_TEXTURE_SPECULAR].texture;
    const int strength = m[0].textures[BURNISH_TEXTURE_SPECULAR_STRENGTH].texture;
    CHECK1(color > 0 && got.textures[color - 1].is_color);
    CHECK1(strength > 0 && !got.textures[strength - 1].is_color);
    for (int k = 0; k < 3 && strength > 0; ++k) {
        CHECK1(got.textures[strength - 1].pixels[k] == 127);
    }
    CHECK1(m[0].edge_loss == 0.75f && m[0].is_metallic && m[1].edge_loss == 0 && m[1].is_metallic);
    CHECK1(got.warning_count == 0);
}

/* KHR_materials_clearcoat, _sheen and _anisotropy. */
static void test_layers(void) {
    read_good("$head$triangle_accessors,'images':[$image],'textures':[{'source':0}],"
              "'materials':[{'extensions':{'KHR_materials_clearcoat':{'clearcoatFactor':0.75,"
              "'clearcoatRoughnessFactor':2,'clearcoatTexture':{'index':0},"
              "'clearcoatRoughnessTexture':{'index':0},"
              "'clearcoatNormalTexture':{'index':0,'scale':0.5}},'KHR_materials_sheen':{"
              "'sheenColorFactor':[0,0.5,3],'sheenRoughnessFactor':0.25,"
              "'sheenColorTexture':{'index':0},'sheenRoughnessTexture':{'index':0}},"
              "'KHR_materials_anisotropy':{'anisotropyStrength':0.5,"
              "'anisotropyRotation':1.5707964,'anisotropyTexture':{'index':0}}}}],"
              "$painted}",
              NULL);
    const burnish_material *m = got.materials;
    const burnish_texture_use *uses = m->textures, *coat = &uses[BURNISH_TEXTURE_COAT];
    CHECK1(m->coat == 0.75f && m->coat_roughness == 1 && m->sheen_roughness == 0.25f);
    CHECK1(m->sheen[0] == 0 && m->sheen[1] == 0.5f && m->sheen[2] == 1);
    CHECK1(coat->texture > 0 && uses[BURNISH_TEXTURE_COAT_NORMAL].strength == 0.5f &&
           uses[BURNISH_TEXTURE_COAT_ROUGHNESS].texture == coat->texture &&
           uses[BURNISH_TEXTURE_COAT_NORMAL].texture == coat->texture);
    CHECK1(m->is_metallic && fabsf(m->anisotropy[0]) < 1e-6f && m->anisotropy[1] == 0.5f &&
           uses[BURNISH_TEXTURE_ANISOTROPY].texture == coat->texture);
    for (int k = 0; k < 2; ++k) {
        const int number = uses[BURNISH_TEXTURE_SHEEN_COLOR + k].texture;
        CHECK1(number > 0 && got.textures[number - 1].is_color == !k);
    }
    CHECK1(got.warning_count == 0);
}

/* A vertex has two sets of texture coordinates: the normal texture's, or else the one that most
 * textures of its material use, and the one that most others use. The second corner's u is 0.5 in
 * set 0 and 1 in set 1. A third set is ignored with a warning. */
static void test_texture_sets(void) {
    static const struct {
        const char *sets[3]; /* of base colour, normals, occlusion */
        int uses[3];         /* 1 + coordinates; 0: ignored */
        double u[2];         /* of the second corner; 0: none, or none in the file */
    } cases[] = {{{"0", "0", "0"}, {1, 1, 1}, {0.5, 0}}, {{"1", "1", "1"}, {1, 1, 1}, {1, 0}},
                 {{"0", "1", "1"}, {2, 1, 1}, {1, 0.5}}, {{"1", "0", "1"}, {2, 1, 2}, {0.5, 1}},
                 {{"0", "1", "8"}, {2, 1, 0}, {1, 0.5}}, {{"1", "2", "0"}, {2, 1, 0}, {0, 1}},
                 {{"1", "9", "0"}, {1, 0, 2}, {1, 0.5}}};
    static const int slots[3] = {BURNISH_TEXTURE_COLOR, BURNISH_TEXTURE_NORMAL,
                                 BURNISH_TEXTURE_OCCLUSION};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char json[2048];
        byte_list binary = {.size = 0};
        static const float values[] = {0,    0, 0, 1,    0, 0, 0, 2, 0, 0, 0,
                                       0.5f, 0, 0, 0.5f, 0, 0, 1, 0, 0, 1};
        put_floats(&binary, sizeof values / sizeof *values, values);
        snprintf(json, sizeof json,
                 "$head$buffer(84),'bufferViews':[$view(0,36),$view(36,24),$view(60,24)],"
                 "'accessors':[$accessor(0,5126,3,VEC3),$accessor(1,5126,3,VEC2),"
                 "$accessor(2,5126,3,VEC2)],'images':[$image],'textures':[{'source':0}],"
                 "'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0,"
                 "'texCoord':%s}},'normalTexture':{'index':0,'texCoord':%s},"
                 "'occlusionTexture':{'index':0,'texCoord':7,"
                 "'extensions':{'KHR_texture_transform':{'texCoord':%s}}}}],"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':1,"
                 "'TEXCOORD_1':2},'material':0}]}],$node}",
                 cases[i].sets[0], cases[i].sets[1], cases[i].sets[2]);
        read_good(json, &binary);
        for (int k = 0; k < 3 && got.material_count > 0; ++k) {
            const burnish_texture_use *use = &got.materials[0].textures[slots[k]];
            CHECK((use->texture ? 1 + use->coordinates : 0) == cases[i].uses[k], "%zu: slot %d", i,
                  k);
        }
        for (int k = 0; k < 2; ++k) {
            const burnish_stream *stream = &got.streams[k ? BURNISH_TEXCOORD2 : BURNISH_TEXCOORD];
            const float *uv = stream->items;
            CHECK(stream->count == (i < 2 && k == 1 ? 0 : 3) &&
                      (stream->count == 0 || (double)uv[2] == cases[i].u[k]),
                  "%zu: set %d", i, k);
        }
        CHECK(got.warning_count == (i > 3), "%zu: %zu warnings", i, got.warning_count);
    }
}

/* Images of formats that are not decoded: the other image of the texture, or one warning for all. */
static void test_undecoded_images(void) {
#define KTX "{'uri':'data:image/ktx2;base64,q0tUWCAyMLs='}"
    for (int has_other = 0; has_other < 2; ++has_other) {
        char json[2048];
        snprintf(json, sizeof json,
                 "$head$triangle_accessors,'extensionsRequired':['KHR_texture_basisu'],"
                 "'extensionsUsed':['KHR_texture_basisu'],'images':[$image," KTX "," KTX "],"
                 "'textures':[{%s'extensions':{'KHR_texture_basisu':{'source':1}}},"
                 "{%s'extensions':{'KHR_texture_basisu':{'source':2}}}],'materials':[{"
                 "'emissiveTexture':{'index':1},'pbrMetallicRoughness':{'baseColorTexture':"
                 "{'index':0}}}],$painted}",
                 has_other ? "'source':0," : "", has_other ? "'source':0," : "");
        read_good(json, NULL);
        CHECK1(got.texture_count == (size_t)has_other && got.warning_count == (size_t)!has_other &&
               got.materials[0].textures[BURNISH_TEXTURE_COLOR].texture == has_other);
    }
#undef KTX
    read_good("$head$triangle_accessors,'extensionsUsed':['EXT_texture_avif'],'images':[{'uri':"
              "'data:;base64,AAAAAGZ0eXBhdmlm'}],'textures':[{'extensions':{'EXT_texture_avif':"
              "{'source':0}}}],'materials':[{'emissiveTexture':{'index':0}}],$painted}",
              NULL);
    check_warning("mesh.gltf:1: texture \"images[0]\" was skipped: images[0]: AVIF is not "
                  "supported; convert it to PNG");
}

/* Missing images are skipped. After several damaged images, no more are tried. */
static void test_damaged_images(void) {
    static const char *const images[] = {"{'uri':'data:image/png;base64,AAAA'}",
                                         "{'uri':'data:image/png;base64,A*'}",
                                         "{'bufferView':7}",
                                         "{'uri':5}",
                                         "{}",
                                         "{'uri':'../a.png'}"};
    for (size_t i = 0; i < sizeof images / sizeof *images; ++i) {
        char json[2048];
        snprintf(json, sizeof json,
                 "$head$triangle_accessors,'images':[%s,%s],'textures':[{'source':0},"
                 "{'source':1}],'materials':[{'pbrMetallicRoughness':{'baseColorTexture':{'ind"
                 "ex':0}},'normalTexture':{'index':1},'emissiveTexture':{'index':9},"
                 "'emissiveFactor':[1,1,1]},{'extensions':{'KHR_materials_pbrSpecularGlossiness':"
                 "{'specularGlossinessTexture':{'index':0}}}}],"
                 "$painted}",
                 images[i], images[i]);
        read_good(json, NULL);
        CHECK1(got.triangle_count == 1 && got.texture_count == 0 && got.warning_count >= 1 &&
               got.materials[0].textures[BURNISH_TEXTURE_COLOR].texture == 0 &&
               got.materials[0].emissive[0] == 0 && got.materials[1].exponent == 1 &&
               got.materials[1].reflectance[0] == 0.04f);
    }
}

/* A required extension that only changes the look, or nothing at rest, does not refuse the file. */
static void test_required_shapeless(void) {
    static const char *const names[] = {"KHR_materials_x",       "KHR_animation_pointer",
                                        "KHR_interactivity",     "KHR_audio_emitter",
                                        "KHR_node_hoverability", "KHR_physics_rigid_bodies",
                                        "EXT_lights_ies",        "EXT_structural_metadata",
                                        "OMI_physics_body",      "VRMC_vrm"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        char json[1024], warning[128];
        snprintf(json, sizeof json,
                 "$head$triangle_accessors,'extensionsRequired':['%s'],'extensionsUsed':['%s'],"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],$node}",
                 names[i], names[i]);
        snprintf(warning, sizeof warning, "mesh.gltf: drawn without the extension %s", names[i]);
        read_good(json, NULL);
        check_warning(warning);
    }
}

/* ---- Nothing to be seen ---- */

#define MATERIALS(first, second)                                                                   \
    "'materials':[{" first "},{" second "}],'meshes':[{'primitives':["                             \
    "{'attributes':{'POSITION':0},'material':0},{'attributes':{'POSITION':0},'material':1}]}]"     \
    ",$node}"
#define CLEAR "'alphaMode':'BLEND','pbrMetallicRoughness':{'baseColorFactor':[1,0,0,0]}"
#define CLEAR_MASK "'alphaMode':'MASK','pbrMetallicRoughness':{'baseColorFactor':[1,0,0,0]}"

/* A fully transparent part of a visible scene stays transparent. If everything is, all becomes
 * opaque. */
static void test_invisible(void) {
    static const struct {
        const char *json;
        int is_opaque;
    } cases[] = {{"$head$triangle_accessors," MATERIALS(CLEAR, "'name':'visible'"), 0},
                 {"$head$triangle_accessors," MATERIALS(CLEAR, CLEAR), 1},
                 {"$head$triangle_accessors," MATERIALS(CLEAR, CLEAR_MASK), 1},
                 {"$head$triangle_accessors," MATERIALS(CLEAR, CLEAR_MASK ",'alphaCutoff':0"), 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        read_good(cases[i].json, NULL);
        check_warning(cases[i].is_opaque
                          ? "mesh.gltf: everything is fully transparent (alpha 0) and drawn opaque"
                          : NULL);
        CHECK(got.material_count == 2 && got.materials[0].transparency == !cases[i].is_opaque,
              "%zu", i);
    }
}

/* Alpha of vertices, which a blended material multiplies: 0 for all of them, or for all but one. */
static void test_invisible_vertices(void) {
    for (int visible = 0; visible < 2; ++visible) {
        byte_list binary = {.size = 0};
        put_floats(&binary, 9, gltf_triangle);
        for (int i = 0; i < 3; ++i) {
            put_bits(&binary, 0x00334455u | (visible && i == 2 ? 0x80000000u : 0), 4, 0);
        }
        read_good("$head$buffer(48),'bufferViews':[$view(0,36),$view(36,12)],"
                  "'accessors':[$accessor(0,5126,3,VEC3),{'bufferView':1,'componentType':5121,"
                  "'count':3,'type':'VEC4','normalized':true}],"
                  "'materials':[{'alphaMode':'BLEND'}],'meshes':[{'primitives':[{'attributes':{"
                  "'POSITION':0,'COLOR_0':1},'material':0}]}],$node}",
                  &binary);
        check_warning(
            visible ? NULL
                    : "mesh.gltf: everything is fully transparent (alpha 0) and drawn opaque");
        if (CHECK1(got.streams[BURNISH_COLOR].count == 3)) {
            CHECK1(burnish_colors(&got)[3] == (visible ? 0 : 255));
        }
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_invisible());
    RUN(test_invisible_vertices());
    RUN(test_hierarchy());
    RUN(test_normals_of_nodes());
    RUN(test_required_shapeless());
    RUN(test_materials());
    RUN(test_morph_targets());
    RUN(test_skin());
    RUN(test_instances());
    RUN(test_animation());
    RUN(test_cameras());
    RUN(test_lights());
    RUN(test_volumes());
    RUN(test_default_material());
    RUN(test_splats());
    RUN(test_variants());
    RUN(test_textures());
    RUN(test_specular());
    RUN(test_layers());
    RUN(test_texture_sets());
    RUN(test_damaged_images());
    RUN(test_undecoded_images());
    return test_end("gltf_scene");
}
