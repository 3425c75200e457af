/* burnish/shading.h: the inputs of the Phong illumination equation: lobes, materials, lights and
 * specular models. kernels.h and render.h draw with them; theory.h analyses the lobes.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_SHADING_H
#define BURNISH_SHADING_H

#include "burnish/lobe_spec.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Textures ---- */

/* The uses of a texture. COLOR, SPECULAR, EMISSIVE and SHEEN_COLOR contain colours (sRGB), the
 * others numbers. */
typedef enum burnish_texture_slot {
    BURNISH_TEXTURE_COLOR,              /* multiplies ambient and diffuse, or the base colour; for
                                           alpha see alpha_mode */
    BURNISH_TEXTURE_SPECULAR,           /* rgb multiplies specular, or the reflectance */
    BURNISH_TEXTURE_EXPONENT,           /* r multiplies the exponent */
    BURNISH_TEXTURE_METALLIC_ROUGHNESS, /* g multiplies roughness, b metallic */
    BURNISH_TEXTURE_NORMAL,             /* tangent space, green up: 2 rgb - 1 */
    BURNISH_TEXTURE_EMISSIVE,           /* rgb multiplies emissive */
    BURNISH_TEXTURE_OCCLUSION,          /* r multiplies the ambient light */
    BURNISH_TEXTURE_OPACITY,            /* r multiplies the opacity */
    BURNISH_TEXTURE_TRANSMISSION,       /* r multiplies transmission */
    BURNISH_TEXTURE_THICKNESS,          /* g multiplies thickness */
    BURNISH_TEXTURE_SHEEN_COLOR,        /* rgb multiplies sheen */
    BURNISH_TEXTURE_SHEEN_ROUGHNESS,    /* r multiplies sheen_roughness */
    BURNISH_TEXTURE_SPECULAR_STRENGTH,  /* r multiplies what a dielectric reflects */
    BURNISH_TEXTURE_ANISOTROPY,         /* 2 rg - 1: a direction that anisotropy turns; b
                                           multiplies its length */
    BURNISH_TEXTURE_IRIDESCENCE,        /* r multiplies iridescence */
    BURNISH_TEXTURE_FILM,               /* g: from film_thickness[0] to [1] */
    BURNISH_TEXTURE_COAT,               /* r multiplies coat */
    BURNISH_TEXTURE_COAT_ROUGHNESS,     /* g multiplies coat_roughness */
    BURNISH_TEXTURE_COAT_NORMAL,        /* as NORMAL, for the coat, which ignores NORMAL */
    BURNISH_TEXTURE_SLOT_COUNT
} burnish_texture_slot;

/* How a texture continues beyond its image. */
typedef enum burnish_texture_wrap {
    BURNISH_WRAP_REPEAT,
    BURNISH_WRAP_CLAMP,
    BURNISH_WRAP_MIRROR
} burnish_texture_wrap;

/* The use of a texture by a material. All 0: no texture. */
typedef struct burnish_texture_use {
    int texture;        /* 1 + number of the texture in the mesh; 0: no texture */
    int wrap[2];        /* burnish_texture_wrap of u and v */
    int is_nearest;     /* 1: the nearest texel, for pixel art; 0: filtered */
    int coordinates;    /* 0: the mesh's texture_coordinates; 1: second_coordinates. NORMAL and
                           COAT_NORMAL: 0 */
    int has_transform;  /* 1: u' = t0 u + t1 v + t2, v' = t3 u + t4 v + t5 */
    float transform[6]; /* finite */
    float strength;     /* NORMAL, COAT_NORMAL: factor of x and y; OCCLUSION: 0 none to 1 full. Not
                           used for the other slots */
} burnish_texture_use;

/* The effect of alpha in textures and of the opacity. */
typedef enum burnish_alpha_mode {
    BURNISH_ALPHA_IGNORE, /* the alpha of textures is ignored */
    BURNISH_ALPHA_MASK,   /* opaque if the opacity is at least alpha_cutoff, else invisible */
    BURNISH_ALPHA_BLEND   /* alpha multiplies the opacity */
} burnish_alpha_mode;

/* ---- Materials ---- */

/* A material: coefficients of the Phong equation or, with is_metallic 1, the metallic-roughness
 * parameters of glTF, from which these coefficients follow. Colours are linear light, [0, 1] in a
 * mesh, [0, 1e6] in kernels.h, which uses only the members up to exponent. If all members from
 * has_diffuse on are 0, the material is a plain opaque Phong material. */
typedef struct burnish_material {
    float ambient[3];   /* ka: factor of the ambient light */
    float diffuse[3];   /* kd: times max(0, N.L) */
    float specular[3];  /* ks: times the specular lobe; 0, 0, 0: no lobe */
    float exponent;     /* n of the specular lobe, [1, 65536] */
    int has_diffuse;    /* 1: vertex colours multiply ambient and diffuse; 0: they replace them */
    float transparency; /* 1 - opacity, [0, 1]: 0 is opaque */
    int has_exponent;   /* 1: the input or the user states the exponent: the highlight looks as in
                           other programs (by_material of lobe_spec.h); 0: burnish's choice */

    float emissive[3]; /* emitted light */
    int is_unlit;      /* 1: the colour is drawn without lighting */

    /* 0: a Phong material. The lights of light.h use metallic, roughness and reflectance if one of
     *    them is not 0, with the base colour `ambient`; otherwise they are not used.
     * 1: a metallic-roughness material; diffuse is the base colour, and ambient, specular and
     *    exponent are not used. With the base colour, these coefficients replace them:
     *      kd = base (1 - metallic), ka = base
     *      n  = 2 / roughness^4 - 2, at least 1
     *      ks = min(1, (reflectance (1 - metallic) + base metallic) (n + 2) / 8)
     *    The factor (n + 2) / 8 lets a wide lobe reflect as much as a narrow lobe. */
    int is_metallic;
    float metallic, roughness; /* [0, 1] */
    float reflectance[3];      /* of a dielectric at normal incidence: 0.04 for an index of
                                  refraction of 1.5 */
    float edge_loss;           /* what a dielectric does not reflect at grazing angles, [0, 1]; 0:
                                  it reflects all */

    /* Of materials with is_metallic 1, in the lights of light.h: highlights are stretched along the
     * surface. Cosine and sine of the angle from the direction in which u grows, times the strength,
     * at most 1; 0, 0: they are not. Needs texture coordinates */
    float anisotropy[2];

    /* Of materials with is_metallic 1: a film that is as thin as light's wavelength colours this share
     * of what the surface reflects, as KHR_materials_iridescence of glTF has it. Its index of
     * refraction, from 1 on, and its thickness in nanometres, [0, 1e6]: the second, without a
     * texture. */
    float iridescence;
    float film_index, film_thickness[2];

    /* Sheen of textiles over all of the above, as KHR_materials_sheen of glTF has it: a colour; 0, 0, 0:
     * none. [0, 1]; a roughness below 0.1 counts as 0.1 */
    float sheen[3], sheen_roughness;

    /* A clear coat over all of the above: it reflects as a metallic-roughness material of
     * reflectance 0.04 and this roughness does, times `coat`, and takes coat F of the light below
     * it, F = 0.04 + 0.96 (1 - N.V)^5. [0, 1]; coat 0: none */
    float coat, coat_roughness;

    /* Light that passes, of materials with is_metallic 1. Of what a dielectric does not reflect, a
     * share `transmission` is not diffusely reflected: it comes from behind, times the base colour.
     * Behind a front face with a thickness is a volume, which refracts and absorbs: what passes is
     * multiplied by attenuation_color^(thickness / attenuation_distance). */
    float transmission;         /* [0, 1] */
    float thickness;            /* of the volume, in the units of the mesh; 0: a thin sheet */
    float refractive_index;     /* of the volume: 0, which means 1.5, or from 1 on */
    float attenuation_distance; /* in the units of the mesh; 0: the volume is clear */
    float attenuation_color[3]; /* [0, 1] */

    burnish_alpha_mode alpha_mode;
    float alpha_cutoff; /* MASK: [0, 1] */
    burnish_texture_use textures[BURNISH_TEXTURE_SLOT_COUNT];
} burnish_material;

/* ---- Lights ---- */

typedef enum burnish_light_kind {
    BURNISH_LIGHT_DIRECTIONAL,
    BURNISH_LIGHT_POINT
} burnish_light_kind;

/* A light. Its last four members are for point lights: 0 where they have no effect. At the distance
 * d, in the direction u from the light, a point receives color times
 *   (distance / d)^2 max(0, 1 - (d / range)^4) t^2,
 *   t = clamp((axis.u - cos outer) / max(0.001, cos inner - cos outer), 0, 1)
 * as KHR_lights_punctual has it, the first factor at most 2^20. Factors without effect are 1. */
typedef struct burnish_light {
    burnish_light_kind kind;
    int follows_camera; /* 1: vector is in camera space: x right, y up, z toward the viewer; the
                           unit for point lights is the distance from camera to focal point. Not
                           for kernels.h, which has no camera */
    double vector[3];   /* DIRECTIONAL: toward the light, of any length > 0 (kernels.h: 1); POINT:
                           its position */
    float color[3];     /* linear, [0, 1e6] */
    double distance;    /* where color arrives; 0: the light does not fall off */
    double range;       /* where it ends; 0: nowhere */
    double axis[3];     /* of a cone, of any length (kernels.h: 1); 0, 0, 0: it shines everywhere */
    double cone[2];     /* cos inner >= cos outer */
} burnish_light;

/* The most lights. */
#define BURNISH_LIGHT_MAX 64

/* The cosine that the lobe uses. With unit vectors N (normal), L (light) and V (viewer):
 * BLINN: N.H, H = (L + V) / |L + V|; PHONG: R.V, R = 2 (N.L) N - L. */
typedef enum burnish_specular_model {
    BURNISH_SPECULAR_BLINN,
    BURNISH_SPECULAR_PHONG
} burnish_specular_model;

#ifdef __cplusplus
}
#endif

#endif
