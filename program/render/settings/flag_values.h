/* Handlers and words of the flags that only `burnish render` has, and presets of materials. */
#ifndef TOOL_RENDER_VALUES_H
#define TOOL_RENDER_VALUES_H

#include "render/settings/settings.h"

/* A material by name. */
typedef struct render_preset {
    const char *name, *what;
    float specular; /* ks */
    float exponent; /* n */
    float diffuse;  /* factor on kd and ka */
    float tint;     /* 0: the highlight is white, 1: it has the surface's colour */
    float metallic, roughness, reflectance; /* in light from many directions */
} render_preset;

enum { RENDER_GLASS = 6 }; /* the word whose preset lets light pass */

/* The presets in the order of render_preset_words, whose values are 1 + their indices. */
extern const render_preset render_presets[];
extern const cli_word render_preset_words[];

extern const cli_word render_plane_words[]; /* render_plane_kind */
extern const cli_word render_tone_words[];  /* 1 + burnish_tone_mapping */
extern const cli_word render_look_words[];  /* burnish_look */

/* The comment names the type of the target. */
cli_handler render_flag_background;    /* render_background */
cli_handler render_flag_no_background; /* render_background */
cli_handler render_flag_never;         /* int */
cli_handler render_flag_rows;          /* render_rows */
cli_handler render_flag_views;         /* render_views */
cli_handler render_flag_lobes;         /* render_lobes */
cli_handler render_flag_clip;          /* render_clip */
cli_handler render_flag_section;       /* render_section */
cli_handler render_flag_range;         /* double[2] */
cli_handler render_flag_occlusion;     /* render_occlusion */
cli_handler render_flag_plane;         /* render_planes */
cli_handler render_flag_edges;         /* render_edges */
cli_handler render_flag_tones;         /* int: a value of render_tone_words */
cli_handler render_flag_projection;    /* int: render_projection */
cli_handler render_flag_intrinsics;    /* render_intrinsics */
cli_handler render_flag_no_sandbox;    /* int: 0 */
cli_handler render_flag_annotate;      /* unsigned: sum of burnish_annotation */
cli_handler render_flag_light;         /* render_lights */
cli_handler render_flag_ambient;       /* render_ambient */

#endif
