/* glTF's materials: metallic and roughness to the coefficients of the Phong equation.
 *
 * The exponent matches the Beckmann or GGX distribution of the same alpha (theory.h,
 * burnish_theory_exponent_from_roughness): n = 2 / alpha^2 - 2 with alpha = roughness^2. A narrower
 * lobe of height 1 reflects less: (n + 2) / 8 compensates for that (normalised Blinn-Phong). The
 * height is limited to 1, the most that an image can show.
 *
 * A metal has no diffuse colour, but there is no environment to reflect. Its colour therefore
 * reflects the ambient light, like an OBJ's Ka. */

#include "base/elementary.h"
#include "mesh/read/gltf/gltf.h"

enum { MATERIAL_LIMIT = 65535 /* what 16 bits a triangle can tell apart, but for the default */ };

static double clamp_number(double value, double low, double high) {
    return value > low ? (value < high ? value : high) : low; /* NaN gives low */
}

/* The values of a material in the file, before they become coefficients. */
typedef struct gltf_surface {
    double base[4];
    double metallic, roughness;
    double reflectance[3]; /* at normal incidence, for a dielectric */
    double edge_loss;      /* at grazing angles, for a dielectric */
} gltf_surface;

/* KHR_materials_ior and KHR_materials_specular: f0 = ((ior - 1) / (ior + 1))^2, times strength and
 * colour. */
static void read_reflectance(burnish_gltf *gltf, uint32_t value, gltf_surface *surface) {
    const uint32_t specular = burnish_gltf_extension(gltf, value, "KHR_materials_specular");
    const double ior = burnish_gltf_number(
        gltf, burnish_gltf_extension(gltf, value, "KHR_materials_ior"), "ior", 1.5);
    const double root = ior >= 1 ? (ior - 1) / (ior + 1) : ior == 0 ? 1 : 0.2;
    const double strength =
        clamp_number(burnish_gltf_number(gltf, specular, "specularFactor", 1), 0, 1);
    double color[3] = {1, 1, 1};
    surface->edge_loss = 1 - strength;
    burnish_gltf_numbers(gltf, specular, "specularColorFactor", 3, color);
    for (int i = 0; i < 3; ++i) {
        surface->reflectance[i] = clamp_number(root * root * color[i], 0, 1) * strength;
    }
}

static void read_metallic(burnish_gltf *gltf, uint32_t value, gltf_surface *surface) {
    const uint32_t metallic = burnish_gltf_object(gltf, value, "pbrMetallicRoughness");
    burnish_gltf_numbers(gltf, metallic, "baseColorFactor", 4, surface->base);
    surface->metallic =
        clamp_number(burnish_gltf_number(gltf, metallic, "metallicFactor", 1), 0, 1);
    surface->roughness =
        clamp_number(burnish_gltf_number(gltf, metallic, "roughnessFactor", 1), 0, 1);
    read_reflectance(gltf, value, surface);
}

/* KHR_materials_pbrSpecularGlossiness, of older files: a diffuse colour and a reflectance. */
static void read_glossy(burnish_gltf *gltf, uint32_t glossy, gltf_surface *surface) {
    double specular[3] = {1, 1, 1};
    burnish_gltf_numbers(gltf, glossy, "diffuseFactor", 4, surface->base);
    burnish_gltf_numbers(gltf, glossy, "specularFactor", 3, specular);
    surface->metallic = 0;
    surface->roughness =
        1 - clamp_number(burnish_gltf_number(gltf, glossy, "glossinessFactor", 1), 0, 1);
    for (int i = 0; i < 3; ++i) {
        surface->reflectance[i] = clamp_number(specular[i], 0, 1);
    }
}

/* The surface without textures. */
static burnish_material make_material(const gltf_surface *surface) {
    burnish_material material = {.has_diffuse = 1,
                                 .metallic = (float)surface->metallic,
                                 .roughness = (float)surface->roughness,
                                 .edge_loss = (float)surface->edge_loss};
    const double alpha = surface->roughness * surface->roughness;
    const double exponent = clamp_number(alpha > 0 ? 2 / (alpha * alpha) - 2 : 65536, 1, 65536);
    material.exponent = (float)exponent;
    for (int i = 0; i < 3; ++i) {
        const double base = clamp_number(surface->base[i], 0, 1), metallic = surface->metallic;
        const double f0 = surface->reflectance[i] * (1 - metallic) + base * metallic;
        material.ambient[i] = (float)base;
        material.diffuse[i] = (float)(base * (1 - metallic));
        material.specular[i] = (float)clamp_number(f0 * (exponent + 2) / 8, 0, 1);
        material.reflectance[i] = (float)surface->reflectance[i];
    }
    return material;
}

static void read_emission(burnish_gltf *gltf, uint32_t value, burnish_material *material) {
    const uint32_t strong = burnish_gltf_extension(gltf, value, "KHR_materials_emissive_strength");
    const double strength = burnish_gltf_number(gltf, strong, "emissiveStrength", 1);
    double color[3] = {0, 0, 0};
    burnish_gltf_numbers(gltf, value, "emissiveFactor", 3, color);
    for (int i = 0; i < 3; ++i) {
        material->emissive[i] = (float)clamp_number(color[i] * strength, 0, 1e6);
    }
}

/* KHR_materials_transmission and KHR_materials_volume. */
static void read_transmission(burnish_gltf *gltf, uint32_t value, burnish_material *material) {
    const uint32_t passes = burnish_gltf_extension(gltf, value, "KHR_materials_transmission");
    const uint32_t volume = burnish_gltf_extension(gltf, value, "KHR_materials_volume");
    const uint32_t ior = burnish_gltf_extension(gltf, value, "KHR_materials_ior");
    double color[3] = {1, 1, 1};
    material->transmission =
        (float)clamp_number(burnish_gltf_number(gltf, passes, "transmissionFactor", 0), 0, 1);
    if (!(material->transmission > 0)) {
        return;
    }
    burnish_gltf_numbers(gltf, volume, "attenuationColor", 3, color);
    for (int i = 0; i < 3; ++i) {
        material->attenuation_color[i] = (float)clamp_number(color[i], 0, 1);
    }
    material->thickness =
        (float)clamp_number(burnish_gltf_number(gltf, volume, "thicknessFactor", 0), 0, 1e30);
    material->attenuation_distance =
        (float)clamp_number(burnish_gltf_number(gltf, volume, "attenuationDistance", 0), 0, 1e30);
    material->refractive_index =
        (float)clamp_number(burnish_gltf_number(gltf, ior, "ior", 1.5), 1, 1e30);
    material->textures[BURNISH_TEXTURE_TRANSMISSION] =
        burnish_gltf_read_texture(gltf, passes, "transmissionTexture", BURNISH_GLTF_NUMBERS, NULL);
    material->textures[BURNISH_TEXTURE_THICKNESS] =
        burnish_gltf_read_texture(gltf, volume, "thicknessTexture", BURNISH_GLTF_NUMBERS, NULL);
}

static void read_alpha(burnish_gltf *gltf, uint32_t value, double alpha,
                       burnish_material *material) {
    const uint32_t mode = burnish_json_member(&gltf->json, value, "alphaMode");
    if (burnish_json_is_text(&gltf->json, mode, "BLEND")) {
        material->alpha_mode = BURNISH_ALPHA_BLEND;
    } else if (burnish_json_is_text(&gltf->json, mode, "MASK")) {
        material->alpha_mode = BURNISH_ALPHA_MASK;
        material->alpha_cutoff =
            (float)clamp_number(burnish_gltf_number(gltf, value, "alphaCutoff", 0.5), 0, 1);
    }
    if (material->alpha_mode != BURNISH_ALPHA_IGNORE) {
        material->transparency = (float)(1 - clamp_number(alpha, 0, 1));
    }
}

/* The textures of KHR_materials_specular. */
static void read_specular(burnish_gltf *gltf, uint32_t value, burnish_texture_use *textures) {
    const uint32_t specular = burnish_gltf_extension(gltf, value, "KHR_materials_specular");
    textures[BURNISH_TEXTURE_SPECULAR] = burnish_gltf_read_texture(
        gltf, specular, "specularColorTexture", BURNISH_GLTF_COLORS, NULL);
    textures[BURNISH_TEXTURE_SPECULAR_STRENGTH] =
        burnish_gltf_read_texture(gltf, specular, "specularTexture", BURNISH_GLTF_ALPHA, NULL);
}

/* KHR_materials_anisotropy. Returns whether there is some. */
static int read_anisotropy(burnish_gltf *gltf, uint32_t value, burnish_material *material) {
    const uint32_t object = burnish_gltf_extension(gltf, value, "KHR_materials_anisotropy");
    const double turn = burnish_gltf_number(gltf, object, "anisotropyRotation", 0);
    const double strength =
        clamp_number(burnish_gltf_number(gltf, object, "anisotropyStrength", 0), 0, 1);
    double sine, cosine;
    if (material->is_unlit || !(strength > 0)) {
        return 0;
    }
    burnish_sincos(turn, &sine, &cosine);
    material->anisotropy[0] = (float)(strength * cosine);
    material->anisotropy[1] = (float)(strength * sine);
    material->textures[BURNISH_TEXTURE_ANISOTROPY] =
        burnish_gltf_read_texture(gltf, object, "anisotropyTexture", BURNISH_GLTF_NUMBERS, NULL);
    return 1;
}

/* KHR_materials_iridescence. Returns whether there is some. */
static int read_iridescence(burnish_gltf *gltf, uint32_t value, burnish_material *material) {
    const uint32_t film = burnish_gltf_extension(gltf, value, "KHR_materials_iridescence");
    const double thickness[2] = {
        burnish_gltf_number(gltf, film, "iridescenceThicknessMinimum", 100),
        burnish_gltf_number(gltf, film, "iridescenceThicknessMaximum", 400)};
    const double share = burnish_gltf_number(gltf, film, "iridescenceFactor", 0);
    if (material->is_unlit || !(share > 0)) {
        return 0;
    }
    material->iridescence = (float)clamp_number(share, 0, 1);
    material->film_index =
        (float)clamp_number(burnish_gltf_number(gltf, film, "iridescenceIor", 1.3), 1, 1e30);
    for (int i = 0; i < 2; ++i) {
        material->film_thickness[i] = (float)clamp_number(thickness[i], 0, 1e6);
    }
    material->textures[BURNISH_TEXTURE_IRIDESCENCE] =
        burnish_gltf_read_texture(gltf, film, "iridescenceTexture", BURNISH_GLTF_NUMBERS, NULL);
    material->textures[BURNISH_TEXTURE_FILM] = burnish_gltf_read_texture(
        gltf, film, "iridescenceThicknessTexture", BURNISH_GLTF_NUMBERS, NULL);
    return 1;
}

/* KHR_materials_sheen. */
static void read_sheen(burnish_gltf *gltf, uint32_t value, burnish_material *material) {
    const uint32_t sheen = burnish_gltf_extension(gltf, value, "KHR_materials_sheen");
    const double roughness = burnish_gltf_number(gltf, sheen, "sheenRoughnessFactor", 0);
    double color[3] = {0, 0, 0};
    float most = 0;
    burnish_gltf_numbers(gltf, sheen, "sheenColorFactor", 3, color);
    for (int i = 0; i < 3 && !material->is_unlit; ++i) {
        material->sheen[i] = (float)clamp_number(color[i], 0, 1);
        most += material->sheen[i];
    }
    material->sheen_roughness = (float)clamp_number(roughness, 0, 1);
    if (most > 0) {
        material->textures[BURNISH_TEXTURE_SHEEN_COLOR] =
            burnish_gltf_read_texture(gltf, sheen, "sheenColorTexture", BURNISH_GLTF_COLORS, NULL);
        material->textures[BURNISH_TEXTURE_SHEEN_ROUGHNESS] = burnish_gltf_read_texture(
            gltf, sheen, "sheenRoughnessTexture", BURNISH_GLTF_ALPHA, NULL);
    }
}

/* KHR_materials_clearcoat. */
static void read_coat(burnish_gltf *gltf, uint32_t value, burnish_material *material) {
    const uint32_t coat = burnish_gltf_extension(gltf, value, "KHR_materials_clearcoat");
    burnish_texture_use *textures = material->textures;
    const double factor = burnish_gltf_number(gltf, coat, "clearcoatFactor", 0);
    const double roughness = burnish_gltf_number(gltf, coat, "clearcoatRoughnessFactor", 0);
    material->coat = material->is_unlit ? 0 : (float)clamp_number(factor, 0, 1);
    material->coat_roughness = (float)clamp_number(roughness, 0, 1);
    if (!(material->coat > 0)) {
        return;
    }
    gltf->reader->mesh->has_normal_textures |=
        burnish_json_member(&gltf->json, coat, "clearcoatNormalTexture") != BURNISH_JSON_NONE;
    textures[BURNISH_TEXTURE_COAT] =
        burnish_gltf_read_texture(gltf, coat, "clearcoatTexture", BURNISH_GLTF_NUMBERS, NULL);
    textures[BURNISH_TEXTURE_COAT_ROUGHNESS] = burnish_gltf_read_texture(
        gltf, coat, "clearcoatRoughnessTexture", BURNISH_GLTF_NUMBERS, NULL);
    textures[BURNISH_TEXTURE_COAT_NORMAL] = burnish_gltf_read_texture(
        gltf, coat, "clearcoatNormalTexture", BURNISH_GLTF_NUMBERS, "scale");
    if (textures[BURNISH_TEXTURE_COAT_NORMAL].coordinates) {
        burnish_gltf_note(gltf, &gltf->other_sets, coat,
                          "clearcoatNormalTexture is ignored, as normalTexture uses another set of "
                          "texture coordinates");
        memset(&textures[BURNISH_TEXTURE_COAT_NORMAL], 0, sizeof *textures);
    }
}

/* Textures that multiply glTF's factors need the original base colour and factors; so do vertex
 * colours on a metal. */
static void read_textures(burnish_gltf *gltf, uint32_t value, uint32_t glossy,
                          burnish_material *material) {
    const uint32_t metallic = burnish_gltf_object(gltf, value, "pbrMetallicRoughness");
    burnish_texture_use *textures = material->textures;
    burnish_gltf_texture_sets(gltf, value, gltf->texture_sets);
    gltf->reader->mesh->has_normal_textures |=
        burnish_json_member(&gltf->json, value, "normalTexture") != BURNISH_JSON_NONE;
    textures[BURNISH_TEXTURE_NORMAL] =
        burnish_gltf_read_texture(gltf, value, "normalTexture", BURNISH_GLTF_NUMBERS, "scale");
    textures[BURNISH_TEXTURE_EMISSIVE] =
        burnish_gltf_read_texture(gltf, value, "emissiveTexture", BURNISH_GLTF_COLORS, NULL);
    if (textures[BURNISH_TEXTURE_EMISSIVE].texture == 0 &&
        burnish_json_member(&gltf->json, value, "emissiveTexture") != BURNISH_JSON_NONE) {
        memset(material->emissive, 0, sizeof material->emissive); /* the texture is mostly black */
    }
    textures[BURNISH_TEXTURE_OCCLUSION] = burnish_gltf_read_texture(
        gltf, value, "occlusionTexture", BURNISH_GLTF_NUMBERS, "strength");
    if (glossy != BURNISH_JSON_NONE) {
        textures[BURNISH_TEXTURE_COLOR] =
            burnish_gltf_read_texture(gltf, glossy, "diffuseTexture", BURNISH_GLTF_COLORS, NULL);
        textures[BURNISH_TEXTURE_SPECULAR] = burnish_gltf_read_texture(
            gltf, glossy, "specularGlossinessTexture", BURNISH_GLTF_COLORS, NULL);
        return;
    }
    textures[BURNISH_TEXTURE_COLOR] =
        burnish_gltf_read_texture(gltf, metallic, "baseColorTexture", BURNISH_GLTF_COLORS, NULL);
    read_specular(gltf, value, textures);
    read_transmission(gltf, value, material);
    textures[BURNISH_TEXTURE_METALLIC_ROUGHNESS] = burnish_gltf_read_texture(
        gltf, metallic, "metallicRoughnessTexture", BURNISH_GLTF_NUMBERS, NULL);
    const int has_color = textures[BURNISH_TEXTURE_COLOR].texture > 0;
    const float *f0 = material->reflectance;
    const float given = material->metallic + material->roughness + f0[0] + f0[1] + f0[2];
    const int is_brushed = read_anisotropy(gltf, value, material);
    material->is_metallic = read_iridescence(gltf, value, material) || is_brushed ||
                            material->transmission > 0 ||
                            textures[BURNISH_TEXTURE_METALLIC_ROUGHNESS].texture > 0 ||
                            textures[BURNISH_TEXTURE_SPECULAR].texture > 0 ||
                            textures[BURNISH_TEXTURE_SPECULAR_STRENGTH].texture > 0 ||
                            (!(given > 0) && material->edge_loss < 1) ||
                            (has_color && textures[BURNISH_TEXTURE_NORMAL].texture > 0) ||
                            ((has_color || gltf->has_colors) && material->metallic > 0);
    if (material->is_metallic || material->is_unlit) {
        memcpy(material->diffuse, material->ambient, sizeof material->diffuse);
    }
}

/* Without the texture of reflectance and glossiness its factors, mostly 1, would make a mirror. */
static void settle_gloss(burnish_gltf *gltf, uint32_t glossy, gltf_surface *surface,
                         burnish_material *material) {
    if (material->textures[BURNISH_TEXTURE_SPECULAR].texture > 0 ||
        burnish_json_member(&gltf->json, glossy, "specularGlossinessTexture") ==
            BURNISH_JSON_NONE) {
        return;
    }
    surface->roughness = 1;
    surface->reflectance[0] = surface->reflectance[1] = surface->reflectance[2] = 0.04;
    const burnish_material dull = make_material(surface);
    material->roughness = dull.roughness;
    material->exponent = dull.exponent;
    memcpy(material->reflectance, dull.reflectance, sizeof dull.reflectance);
    if (!material->is_unlit) {
        memcpy(material->specular, dull.specular, sizeof dull.specular);
    }
}

static burnish_material read_material(burnish_gltf *gltf, uint32_t value) {
    gltf_surface surface = {.base = {1, 1, 1, 1}};
    const uint32_t glossy =
        burnish_gltf_extension(gltf, value, "KHR_materials_pbrSpecularGlossiness");
    if (glossy != BURNISH_JSON_NONE) {
        read_glossy(gltf, glossy, &surface);
    } else {
        read_metallic(gltf, value, &surface);
    }
    burnish_material material = make_material(&surface);
    if (burnish_gltf_extension(gltf, value, "KHR_materials_unlit") != BURNISH_JSON_NONE) {
        material.is_unlit = 1;
        memset(material.specular, 0, sizeof material.specular);
    }
    read_emission(gltf, value, &material);
    read_alpha(gltf, value, surface.base[3], &material);
    read_textures(gltf, value, glossy, &material);
    read_sheen(gltf, value, &material);
    read_coat(gltf, value, &material);
    settle_gloss(gltf, glossy, &surface, &material);
    return material;
}

/* The material of primitives without one: white and rough (section 3.7.2.1). The specification's
 * is a metal, which looks the same under area lights; other looks would leave it nothing to
 * reflect. */
static burnish_material plain_material(void) {
    return make_material(
        &(gltf_surface){.base = {1, 1, 1, 1}, .roughness = 1, .reflectance = {0.04, 0.04, 0.04}});
}

void burnish_gltf_read_materials(burnish_gltf *gltf) {
    burnish_mesh_data *mesh = gltf->reader->mesh;
    const size_t count = gltf->counts[BURNISH_GLTF_MATERIALS];
    if (count > MATERIAL_LIMIT) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_LIMIT,
                          burnish_json_member(&gltf->json, 0, "materials"),
                          "more than %d materials; merge equal ones", MATERIAL_LIMIT);
        return;
    }
    mesh->materials = burnish_reserve(gltf->memory, mesh->materials, &mesh->material_capacity,
                                      count + 1, sizeof *mesh->materials, "materials");
    if (!burnish_gltf_is_fine(gltf)) {
        return;
    }
    gltf->is_lenient = 1;
    burnish_gltf_decode_ahead(gltf);
    for (size_t i = 0; i < count && gltf->status == BURNISH_STATUS_OK; ++i) {
        const uint32_t material = gltf->lists[BURNISH_GLTF_MATERIALS][i];
        mesh->materials[i] = read_material(gltf, material);
    }
    gltf->is_lenient = 0;
    burnish_gltf_drop_ahead(gltf);
    mesh->materials[count] = plain_material();
    mesh->material_count = count + (gltf->has_plain || count == 0);
}
