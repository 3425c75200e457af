/* For tests of 3MF: pieces of models. */
#ifndef BURNISH_TEST_THREEMF_INPUT_H
#define BURNISH_TEST_THREEMF_INPUT_H

#include "zip_input.h"

#define MODEL_OF(attributes, resources, build)                                                     \
    "<?xml version='1.0'?>\n<model xmlns='http://schemas.microsoft.com/3dmanufacturing/core/"      \
    "2015/02' xmlns:m='http://schemas.microsoft.com/3dmanufacturing/material/2015/02' "            \
    "xmlns:p='http://schemas.microsoft.com/3dmanufacturing/production/2015/06' " attributes        \
    ">\n<resources>\n" resources "</resources><build>" build "</build></model>"
#define MODEL(resources, build) MODEL_OF("unit='inch'", resources, build)

#define TETRAHEDRON                                                                                \
    "<vertices><vertex x='0' y='0' z='0'/><vertex x='2' y='0' z='0'/><vertex x='0' y='3' z='0'/>"  \
    "<vertex x='0' y='0' z='4'/></vertices>"
#define FACES                                                                                      \
    "<triangle v1='0' v2='2' v3='1'/><triangle v1='0' v2='1' v3='3'/>"                             \
    "<triangle v1='1' v2='2' v3='3'/><triangle v1='2' v2='0' v3='3'/>"
#define MESH "<mesh>" TETRAHEDRON "<triangles>" FACES "</triangles></mesh>"
#define ITEM_1 "<item objectid='1'/>"

/* One triangle with its own attributes, in an object with attributes. */
#define ONE_TRIANGLE(object, triangle)                                                             \
    "<object id='1' " object "><mesh>" TETRAHEDRON "<triangles><triangle v1='0' v2='1' "           \
    "v3='2' " triangle "/></triangles></mesh></object>"

#define BASES                                                                                      \
    "<basematerials id='5'><base name='a' displaycolor='#102030'/>"                                \
    "<base name='b' displaycolor='#FFffFF80'/></basematerials>"
#define COLORS                                                                                     \
    "<m:colorgroup id='6'><m:color color='#112233'/><m:color color='#44556677'/>"                  \
    "<color color='red'/></m:colorgroup>"

#define TEXTURES                                                                                   \
    "<m:texture2d id='9' path='/3D/t.png' contenttype='image/png' tilestylev='mirror' "            \
    "tilestyleu='clamp' filter='nearest'/><m:texture2dgroup id='10' texid='9'>"                    \
    "<m:tex2coord u='0.25' v='0.5'/><m:tex2coord u='-1' v='2'/></m:texture2dgroup>"

/* Reads a model that is valid except for at most one warning; returns 1 if it could be read. */
static inline int read_fine(const char *model, const char *warning) {
    const int is_fine = CHECK_OK(read_3mf(model), fault);
    check_warning(warning);
    return is_fine;
}

#endif
