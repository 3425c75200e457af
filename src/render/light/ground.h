/* A ground that is seen only by the shadow on it: the plane across the up direction through the
 * mesh's lowest point. The background is darkened where it shows the plane from above. The mesh is
 * above the plane, so the ground never hides it.
 *
 * The shadow is a texture: the share of the sky that is hidden from points of the plane. Each depth
 * map that sees the mesh from below gives a silhouette on the plane, which represents a cone of the
 * sky: its edge is blurred by the width of the cone at the blocker. Silhouettes are added up by
 * width of blur, so that few blurs serve all. Silhouettes against the strongest area light weigh
 * more: its shadow is the more blurred, the higher its edge is. The shadow of a directional light,
 * where there is one, is one more silhouette, against that light.
 *
 * Where rays are cast, each texel casts them to the sky and to that light. */
#ifndef BURNISH_RENDER_LIGHT_GROUND_H
#define BURNISH_RENDER_LIGHT_GROUND_H

#include "core/tasks.h"
#include "render/light/maps/occlusion.h"
#include "render/light/maps/shadow.h"
#include "render/light/ray_light.h"
#include "render/render_ops.h"

enum {
    BURNISH_GROUND_SIZE = 256, /* texels along the texture's edge, at most */
    BURNISH_GROUND_LAYERS = 8  /* widths of blur */
};

/* Weaker shadows change no 8-bit code of a background: 0.1 % of light are a quarter of a code at
 * most, and 0.1 % of alpha are too. */
#define BURNISH_GROUND_DARK 0.001f

/* A depth map that sees the mesh from below, as points of the texture are looked up in it: of texel
 * (i, j) column, row and depth are dot products with (1, i, j). */
typedef struct burnish_silhouette {
    float column[3], row[3], depth[3];
    const uint16_t *depths;
    int size;
    float spread; /* width of blur, in texels of the texture, per code of distance */
    float weight; /* of its part of the sky */
} burnish_silhouette;

/* The texture, kept from frame to frame. All zero before the first. */
typedef struct burnish_ground {
    uint64_t mesh;              /* whose plane it is, burnish_mesh_view.serial; 0: nobody's */
    uint64_t maps;              /* whose shadow it is, burnish_occlusion.mesh; 0: nobody's */
    int count, size;            /* of the depth maps; 0: rays were cast */
    burnish_vec3 light;         /* that casts a shadow; 0: none does */
    int light_size;             /* of its depth map; 0: it is an area light */
    burnish_ray_lamp lamp;      /* that rays look for */
    int edge;                   /* texels along the texture's edge, a multiple of 16 */
    burnish_vec3 up, across[2]; /* unit vectors; the texture's axes */
    double height;              /* of the plane: p . up, in the raster's space */
    double reach;               /* half an edge of the texture */
    uint16_t *texels;           /* darkness, 65535 is black; 0 at the edge */
    int dark[2][2]; /* first and last column, first and last row with BURNISH_GROUND_DARK */
    float *layers;  /* scratch: sums of silhouettes by width of blur */
    size_t capacity, layer_capacity;
} burnish_ground;

/* What casts shadows. */
typedef struct burnish_ground_light {
    const burnish_occlusion *occlusion; /* maps toward the sky */
    const burnish_shadow *shadow;       /* of the first light, directional; or NULL */
    const burnish_ray_light *rays;      /* that are cast instead; or NULL */
    int sun;                            /* the lamp that is the first light, directional; or -1 */
    burnish_vec3 key;                   /* toward the strongest area light; 0: none */
    int side;                           /* pixels along the picture's shorter edge */
} burnish_ground_light;

/* The texture as a picture shows it. Of the point (x, y) of the screen, in pixels from the image's
 * centre, right and up, the texel is (column . (1, x, y), row . (1, x, y)) / depth . (1, x, y),
 * where that is positive. */
typedef struct burnish_ground_view {
    const uint16_t *texels;
    int size; /* texels along its edge */
    float column[3], row[3], depth[3];
    float half[2];       /* of the image, in pixels */
    float per_border[2]; /* the shadow fades toward the image's edges: 1 / the widths of borders */
    float least[2], most[2]; /* of x and y where the shadow has BURNISH_GROUND_DARK */
} burnish_ground_view;

/* Computes the plane. Errors: none. */
void burnish_ground_place(burnish_ground *ground, const burnish_mesh_view *mesh, burnish_vec3 up);

/* Whether a camera at `eye`, in the raster's space, sees the plane from above. */
int burnish_ground_is_seen(const burnish_ground *ground, const burnish_rays *rays,
                           burnish_vec3 eye);

/* Whether the texture was drawn for this plane and light. */
int burnish_ground_is_drawn(const burnish_ground *ground, const burnish_ground_light *light);

/* Draws the texture of a ground that was placed. Errors: MEMORY, CANCELLED; the texture is then
 * nobody's. */
burnish_status burnish_ground_draw(burnish_ground *ground, const burnish_render_ops *ops,
                                   const burnish_ground_light *light, burnish_tasks *tasks,
                                   burnish_memory *memory);

/*   width, height  of the image, in pixels */
burnish_ground_view burnish_ground_look(const burnish_ground *ground, const burnish_rays *rays,
                                        burnish_vec3 eye, int width, int height);
void burnish_ground_destroy(burnish_ground *ground, const burnish_context *context);

#endif
