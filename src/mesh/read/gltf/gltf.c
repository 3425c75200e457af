/* glTF 2.0 and its binary form GLB: the container, required extensions, and the order in which
 * parts are read. */

#include "mesh/read/gltf/gltf.h"

#include <stdio.h>

#include "base/bytes.h"

enum {
    HEADER_SIZE = 12, /* "glTF", version, length */
    CHUNK_SIZE = 8,   /* length and kind */
    CHUNK_JSON = 0x4E4F534A,
    CHUNK_BINARY = 0x004E4942
};

/* ---- Container ---- */

static int gltf_recognise(const uint8_t *bytes, size_t size) {
    size_t i = 0, looked = size < 4096 ? size : 4096;
    if (size >= HEADER_SIZE && memcmp(bytes, "glTF", 4) == 0) {
        return 2;
    }
    i += size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    while (i < looked && (bytes[i] == ' ' || (bytes[i] >= '\t' && bytes[i] <= '\r'))) {
        ++i;
    }
    if (i == looked || bytes[i] != '{') {
        return 0;
    }
    static const char asset[] = "\"asset\"";
    for (; i + sizeof asset - 1 <= looked; ++i) {
        if (memcmp(bytes + i, asset, sizeof asset - 1) == 0) {
            return 2;
        }
    }
    return 1;
}

static int fail_glb(burnish_gltf *gltf, const uint8_t *at, const char *message) {
    gltf->status = burnish_reader_fail(gltf->reader, BURNISH_STATUS_FORMAT, at, "%s", message);
    return 0;
}

/* The next chunk at *next, which is moved past it; 0 at the end, and on failure. */
static int next_chunk(burnish_gltf *gltf, size_t *next, uint32_t *kind, burnish_gltf_bytes *chunk) {
    const burnish_reader_input *input = gltf->reader->input;
    const uint8_t *at = input->bytes + *next;
    if (input->size - *next < CHUNK_SIZE) {
        return 0;
    }
    *kind = burnish_load32(at + 4);
    *chunk = (burnish_gltf_bytes){at + CHUNK_SIZE, burnish_load32(at)};
    if (chunk->size > input->size - *next - CHUNK_SIZE) {
        return fail_glb(gltf, at, "a chunk reaches beyond the end; the file is truncated");
    }
    *next += CHUNK_SIZE + chunk->size;
    return 1;
}

/* The JSON of the file, and its binary chunk. Anything after these is ignored. */
static burnish_gltf_bytes open_container(burnish_gltf *gltf) {
    const burnish_reader_input *input = gltf->reader->input;
    burnish_gltf_bytes text = {input->bytes, input->size}, chunk;
    uint32_t kind;
    size_t next = HEADER_SIZE;
    if (input->size < HEADER_SIZE || memcmp(input->bytes, "glTF", 4) != 0) {
        return text;
    }
    gltf->is_glb = gltf->reader->is_binary = 1;
    if (burnish_load32(input->bytes + 4) != 2) {
        gltf->status =
            burnish_reader_fail(gltf->reader, BURNISH_STATUS_FORMAT, input->bytes + 4,
                                "GLB of version %u is not supported; convert it to glTF 2.0",
                                burnish_load32(input->bytes + 4));
        return text;
    }
    if (!next_chunk(gltf, &next, &kind, &text) || kind != CHUNK_JSON) {
        if (gltf->status == BURNISH_STATUS_OK) {
            fail_glb(gltf, input->bytes + HEADER_SIZE,
                     "a GLB begins with a chunk of JSON; this one is truncated or damaged");
        }
        return text;
    }
    while (next_chunk(gltf, &next, &kind, &chunk)) {
        if (kind == CHUNK_BINARY && !gltf->binary.bytes) {
            gltf->binary = chunk;
        }
    }
    return text;
}

/* ---- What the file asks for ---- */

/* Extensions that are drawn, do not affect drawing, or have warnings of their own. */
static const char *const drawn_extensions[] = {
    "KHR_lights_punctual",      "EXT_mesh_gpu_instancing",   "EXT_meshopt_compression",
    "EXT_texture_avif",         "EXT_texture_webp",          "KHR_draco_mesh_compression",
    "KHR_materials_anisotropy", "KHR_materials_clearcoat",   "KHR_materials_emissive_strength",
    "KHR_materials_ior",        "KHR_materials_iridescence", "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",      "KHR_materials_specular",    "KHR_materials_transmission",
    "KHR_materials_unlit",      "KHR_materials_variants",    "KHR_materials_volume",
    "KHR_mesh_quantization",    "KHR_meshopt_compression",   "KHR_node_visibility",
    "KHR_texture_basisu",       "KHR_texture_transform",     "KHR_xmp",
    "KHR_xmp_json_ld",          "MSFT_texture_dds",          "KHR_gaussian_splatting"};

static int is_drawn(const burnish_gltf *gltf, uint32_t name) {
    for (size_t i = 0; i < sizeof drawn_extensions / sizeof *drawn_extensions; ++i) {
        if (burnish_json_is_text(&gltf->json, name, drawn_extensions[i])) {
            return 1;
        }
    }
    return 0;
}

/* Beginnings of the names of extensions without which shapes at rest are the same: of materials,
 * textures and light, of behaviour (animation, sound, physics, avatars), and of data about parts.
 * They are of Khronos' registry (KHR_, EXT_ and vendors'), OMI's and VRM's. The list of used
 * extensions causes a warning. */
static const char *const shapeless[] = {"ADOBE_materials_",
                                        "AGI_stk_metadata",
                                        "CESIUM_primitive_outline",
                                        "EXT_feature_metadata",
                                        "EXT_instance_features",
                                        "EXT_lights_",
                                        "EXT_mesh_features",
                                        "EXT_mesh_manifold",
                                        "EXT_structural_metadata",
                                        "EXT_texture_",
                                        "FB_geometry_metadata",
                                        "GODOT_single_root",
                                        "GRIFFEL_bim_data",
                                        "KHR_animation_",
                                        "KHR_audio",
                                        "KHR_collision_shapes",
                                        "KHR_environment_map",
                                        "KHR_implicit_shapes",
                                        "KHR_interactivity",
                                        "KHR_lights_",
                                        "KHR_materials_",
                                        "KHR_node_",
                                        "KHR_physics_",
                                        "KHR_rigid_bodies",
                                        "KHR_techniques_webgl",
                                        "KHR_texture_",
                                        "MSFT_lod",
                                        "MSFT_packing_",
                                        "MSFT_texture_",
                                        "NV_materials_",
                                        "OMI_",
                                        "VRM"};

static int changes_shapes(const char *extension) {
    for (size_t i = 0; i < sizeof shapeless / sizeof *shapeless; ++i) {
        if (strncmp(extension, shapeless[i], strlen(shapeless[i])) == 0) {
            return 0;
        }
    }
    return 1;
}

static void refuse_required(burnish_gltf *gltf) {
    const uint32_t names = burnish_gltf_array(gltf, 0, "extensionsRequired");
    uint32_t name = names + 1;
    for (size_t i = burnish_json_length(&gltf->json, names); i > 0; --i) {
        char text[64];
        burnish_json_text(&gltf->json, name, text, sizeof text);
        if (!is_drawn(gltf, name) && changes_shapes(text)) {
            burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, name,
                              "the file can't be drawn without the extension %s, which is not "
                              "supported; export it without",
                              text);
            return;
        }
        name = gltf->json.nodes[name].next;
    }
}

/* Names, separated by commas; "..." for those without room. */
typedef struct gltf_names {
    char text[200];
    size_t used, count;
} gltf_names;

static void add_name(gltf_names *names, const char *name) {
    char *end = names->text + names->used;
    if (names->used + strlen(name) + 8 < sizeof names->text) {
        names->used += (size_t)snprintf(end, sizeof names->text - names->used, "%s%s",
                                        names->used > 0 ? ", " : "", name);
    } else if (strcmp(end, ", ...") != 0) {
        strcpy(end, ", ...");
    }
    ++names->count;
}

/* One line for all ignored extensions. */
static void warn_used(burnish_gltf *gltf) {
    const uint32_t names = burnish_gltf_array(gltf, 0, "extensionsUsed");
    gltf_names ignored = {.used = 0};
    uint32_t name = names + 1;
    for (size_t i = burnish_json_length(&gltf->json, names); i > 0; --i) {
        if (!is_drawn(gltf, name)) {
            char one[64];
            burnish_json_text(&gltf->json, name, one, sizeof one);
            add_name(&ignored, one);
        }
        name = gltf->json.nodes[name].next;
    }
    if (ignored.count > 0) {
        burnish_reader_warn(gltf->reader, NULL, "drawn without the extension%s %s",
                            ignored.count == 1 ? "" : "s", ignored.text);
    }
}

/* KHR_materials_variants: the names, and the number of the chosen one. */
static void read_variants(burnish_gltf *gltf) {
    burnish_mesh_data *mesh = gltf->reader->mesh;
    const char *wanted = gltf->reader->input->options->variant;
    gltf->is_lenient = 1;
    const uint32_t extension = burnish_gltf_extension(gltf, 0, "KHR_materials_variants");
    const uint32_t array = burnish_gltf_array(gltf, extension, "variants");
    gltf_names names = {.used = 0};
    uint32_t value = array + 1;
    gltf->is_lenient = 0;
    gltf->variant = UINT64_MAX;
    for (size_t i = burnish_json_length(&gltf->json, array); i > 0 && burnish_gltf_is_fine(gltf);
         --i) {
        char text[128];
        burnish_json_text(&gltf->json, burnish_json_member(&gltf->json, value, "name"), text,
                          sizeof text);
        char *name = burnish_allocate(gltf->memory, strlen(text) + 1, 1, "variants");
        mesh->variants =
            burnish_reserve(gltf->memory, mesh->variants, &mesh->variant_capacity,
                            mesh->variant_count + 1, sizeof *mesh->variants, "variants");
        if (!burnish_gltf_is_fine(gltf)) {
            burnish_release(gltf->memory->context, name);
            return;
        }
        if (wanted && gltf->variant == UINT64_MAX && strcmp(text, wanted) == 0) {
            gltf->variant = mesh->variant_count;
        }
        add_name(&names, text);
        mesh->variants[mesh->variant_count++] = strcpy(name, text);
        value = gltf->json.nodes[value].next;
    }
    if (wanted && names.count > 0 && gltf->variant == UINT64_MAX) {
        const burnish_token token = {(const uint8_t *)wanted, strlen(wanted)};
        burnish_gltf_fail(gltf, BURNISH_STATUS_ARGUMENT, BURNISH_JSON_NONE,
                          "variant \"%s\" does not exist; the file has %s",
                          burnish_token_quote(token).text, names.text);
    }
}

static void check_asset(burnish_gltf *gltf) {
    const uint32_t asset = burnish_gltf_object(gltf, 0, "asset");
    char version[16];
    if (asset == BURNISH_JSON_NONE) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, 0,
                          "the JSON has no \"asset\"; this is not glTF 2.0");
        return;
    }
    burnish_json_text(&gltf->json, burnish_json_member(&gltf->json, asset, "version"), version,
                      sizeof version);
    if (!version[0]) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, asset,
                          "no version, as in glTF 1.0; convert the file to glTF 2.0");
    } else if (strncmp(version, "2.", 2) != 0) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, asset,
                          "version \"%s\" is not supported; convert the file to glTF 2.0", version);
    }
}

/* ---- Reading ---- */

static void list_items(burnish_gltf *gltf) {
    static const char *const keys[BURNISH_GLTF_LIST_COUNT] = {
#define KEY(name, key) [BURNISH_GLTF_##name] = key,
        BURNISH_GLTF_LISTS(KEY)
#undef KEY
    };
    for (int i = 0; i < BURNISH_GLTF_LIST_COUNT && gltf->status == BURNISH_STATUS_OK; ++i) {
        const uint32_t array = burnish_gltf_array(gltf, 0, keys[i]);
        gltf->lists[i] = burnish_gltf_items(gltf, array, &gltf->counts[i]);
    }
    gltf->buffers = burnish_allocate_zeroed(gltf->memory, gltf->counts[BURNISH_GLTF_BUFFERS],
                                            sizeof *gltf->buffers, "buffers");
    gltf->decoded = burnish_allocate_zeroed(gltf->memory, gltf->counts[BURNISH_GLTF_VIEWS],
                                            sizeof *gltf->decoded, "buffer views");
    gltf->accessors = burnish_allocate_zeroed(gltf->memory, gltf->counts[BURNISH_GLTF_ACCESSORS],
                                              sizeof *gltf->accessors, "accessors");
    const size_t images = gltf->counts[BURNISH_GLTF_IMAGES];
    gltf->image_textures = burnish_allocate(
        gltf->memory, images, BURNISH_GLTF_IMAGE_KINDS * sizeof *gltf->image_textures, "images");
    for (size_t i = 0; gltf->image_textures && i < BURNISH_GLTF_IMAGE_KINDS * images; ++i) {
        gltf->image_textures[i] = -1;
    }
    gltf->skins = burnish_allocate_zeroed(gltf->memory, gltf->counts[BURNISH_GLTF_SKINS],
                                          sizeof *gltf->skins, "skins");
    burnish_gltf_is_fine(gltf);
}

static void read_parts(burnish_gltf *gltf) {
    void (*const steps[])(burnish_gltf *) = {check_asset,
                                             refuse_required,
                                             list_items,
                                             read_variants,
                                             burnish_gltf_decode_draco,
                                             burnish_gltf_read_primitives,
                                             burnish_gltf_place_nodes,
                                             burnish_gltf_read_materials,
                                             burnish_gltf_read_geometry,
                                             burnish_gltf_read_cameras,
                                             burnish_gltf_read_lights,
                                             warn_used};
    for (size_t i = 0; i < sizeof steps / sizeof *steps && gltf->status == BURNISH_STATUS_OK; ++i) {
        steps[i](gltf);
    }
    if (gltf->status == BURNISH_STATUS_OK) {
        burnish_reader_warn_group(gltf->reader, &gltf->odd_values);
        burnish_reader_warn_group(gltf->reader, &gltf->undrawn);
        burnish_reader_warn_group(gltf->reader, &gltf->rests);
        burnish_reader_warn_group(gltf->reader, &gltf->other_sets);
        gltf->status = gltf->memory->status;
    }
}

static void close_file(burnish_gltf *gltf) {
    const burnish_context *context = gltf->memory->context;
    burnish_gltf_release_draco(gltf);
    for (size_t i = 0; gltf->buffers && i < gltf->counts[BURNISH_GLTF_BUFFERS]; ++i) {
        burnish_gltf_release_buffer(gltf, &gltf->buffers[i]);
    }
    for (size_t i = 0; gltf->accessors && i < gltf->counts[BURNISH_GLTF_ACCESSORS]; ++i) {
        burnish_release(context, gltf->accessors[i].owned);
    }
    for (int i = 0; i < BURNISH_GLTF_LIST_COUNT; ++i) {
        burnish_release(context, gltf->lists[i]);
    }
    for (size_t i = 0; gltf->skins && i < gltf->counts[BURNISH_GLTF_SKINS]; ++i) {
        burnish_release(context, gltf->skins[i].matrices);
    }
    for (size_t i = 0; gltf->decoded && i < gltf->counts[BURNISH_GLTF_VIEWS]; ++i) {
        burnish_release(context, gltf->decoded[i]);
    }
    burnish_release(context, gltf->decoded);
    burnish_release(context, gltf->skins);
    burnish_release(context, gltf->image_textures);
    burnish_release(context, gltf->poses);
    burnish_release(context, gltf->weights);
    burnish_release(context, gltf->buffers);
    burnish_release(context, gltf->accessors);
    burnish_release(context, gltf->nodes);
    burnish_release(context, gltf->node_order);
    burnish_release(context, gltf->primitives);
    burnish_release(context, gltf->mesh_primitives);
    burnish_json_destroy(context, &gltf->json);
}

static burnish_status gltf_read(burnish_reader *reader) {
    reader->mesh->unit = "meter"; /* section 3.4 */
    burnish_gltf gltf = {.reader = reader,
                         .memory = &reader->mesh->memory,
                         .bytes_left = reader->input->options->max_input_bytes};
    const burnish_gltf_bytes text = open_container(&gltf);
    if (gltf.status == BURNISH_STATUS_OK) {
        gltf.status = burnish_json_parse(reader, text.bytes, text.size, &gltf.json);
    }
    if (gltf.status == BURNISH_STATUS_OK) {
        read_parts(&gltf);
    }
    close_file(&gltf);
    return gltf.status;
}

const burnish_format_reader burnish_reader_gltf = {
    .recognise = gltf_recognise, .read = gltf_read, .averages_normals = 1};
