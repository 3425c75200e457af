/* Robots: URDF (ROS, wiki.ros.org/urdf/XML), as a file states them. */
#ifndef BURNISH_MESH_READ_SCENE_URDF_H
#define BURNISH_MESH_READ_SCENE_URDF_H

#include "mesh/read/scene/scene.h"

enum {
    BURNISH_URDF_NAME = 128,  /* bytes of a name, with the 0 */
    BURNISH_URDF_FILE = 1024, /* the same of a file */
    BURNISH_URDF_MOST = 4096, /* links, joints, and materials of the robot */
    BURNISH_URDF_NONE = -1
};

typedef struct burnish_urdf_link {
    char name[BURNISH_URDF_NAME];
    int parent; /* the joint to it; NONE: it is a root */
    int is_placed;
    double transform[12]; /* to the scene, once it is placed */
} burnish_urdf_link;

/* A material's name and colour. */
typedef struct burnish_urdf_material {
    char name[BURNISH_URDF_NAME];
    int has_color;
    uint8_t srgb[4];
} burnish_urdf_material;

typedef enum burnish_urdf_shape {
    BURNISH_URDF_NOTHING,
    BURNISH_URDF_MESH,
    BURNISH_URDF_BOX,
    BURNISH_URDF_CYLINDER,
    BURNISH_URDF_SPHERE
} burnish_urdf_shape;

typedef struct burnish_urdf_visual {
    int link;
    int is_collision; /* 1: not visible; drawn if nothing is */
    uint32_t line;
    double origin[12];
    burnish_urdf_shape shape;
    double size[3]; /* of a box; radius and length; or the scale of a mesh */
    char file[BURNISH_URDF_FILE];
    burnish_urdf_material material;
} burnish_urdf_visual;

typedef enum burnish_urdf_kind {
    BURNISH_URDF_FIXED, /* also floating and planar: they stay */
    BURNISH_URDF_TURNS,
    BURNISH_URDF_SLIDES
} burnish_urdf_kind;

typedef struct burnish_urdf_joint {
    char name[BURNISH_URDF_NAME], parent[BURNISH_URDF_NAME], child[BURNISH_URDF_NAME];
    char mimic[BURNISH_URDF_NAME]; /* "": none */
    double multiplier, offset;     /* value = multiplier value of `mimic` + offset */
    uint32_t line;
    burnish_urdf_kind kind;
    int is_endless; /* 1: it turns without limits, whatever the file states */
    double origin[12], axis[3], value;
    double low, high;                    /* its limits; low >= high: none */
    int has_value;                       /* 1: it is final */
    struct burnish_urdf_joint *followed; /* by its mimic; NULL: none */
    int parent_link;
} burnish_urdf_joint;

typedef struct burnish_urdf {
    burnish_scene scene;
    burnish_status status;
    burnish_urdf_link *links;
    size_t link_count, link_capacity;
    burnish_urdf_joint *joints;
    size_t joint_count, joint_capacity;
    burnish_urdf_visual *visuals;
    size_t visual_count, visual_capacity;
    burnish_urdf_material *materials;
    size_t material_count, material_capacity;
} burnish_urdf;

/* Fails with "NAME: line N: ..." unless something failed before; line 0: none. Returns 0. */
__attribute__((format(printf, 4, 5))) int burnish_urdf_fail(burnish_urdf *urdf,
                                                            burnish_status status, uint32_t line,
                                                            const char *format, ...);

/* Parses the input. Returns 0 on failure. */
int burnish_urdf_parse(burnish_urdf *urdf);

/* The mesh of a box, cylinder or sphere; NULL if memory is out. */
burnish_scene_source *burnish_urdf_make_shape(burnish_urdf *urdf, burnish_urdf_shape shape,
                                              const double size[3]);

#endif
