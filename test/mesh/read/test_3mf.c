/* The reader of 3MF, on archives put together here. */
#include <math.h>

#include "core/srgb.h"
#include "decimal_comma.h"
#include "mesh_arrays.h"
#include "threemf_input.h"

static const float points[4][3] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};

static const uint32_t *corners_of(burnish_attribute attribute) {
    return got.streams[attribute].corners;
}

/* ---- Places ---- */

static void test_plain(void) {
    if (read_fine(MODEL("<object id='1'>" MESH "</object>", ITEM_1), NULL)) {
        CHECK1(got.triangle_count == 4 && got.streams[BURNISH_POSITION].count == 4);
        CHECK1(corner_is(0, 0, 0, 0, 0) && corner_is(0, 1, 0, 3, 0) && corner_is(0, 2, 2, 0, 0) &&
               corner_is(3, 2, 0, 0, 4));
        CHECK1(got.material_count == 1 && !got.triangle_materials && got.material_count == 1);
        CHECK1(got.streams[BURNISH_COLOR].count == 0 && got.streams[BURNISH_TEXCOORD].count == 0);
        CHECK_TEXT(got.unit ? got.unit : "", "inch");
    }
    read_fine(MODEL_OF("", "<object id='1'>" MESH "</object>", ITEM_1), NULL);
    CHECK_TEXT(got.unit ? got.unit : "", "millimeter");
    /* prefixes of any name, declared or not; unknown elements; blanks around numbers */
    read_fine(
        "<c:model xmlns:c='http://schemas.microsoft.com/3dmanufacturing/core/2015/02'>"
        "<c:metadata name='a'>b<i/></c:metadata><c:resources><x:thing><object id='1'/></x:thing>"
        "<c:object id=' 1\n'><c:mesh>"
        "<c:vertices><vertex x=' 0' y='0 ' z='\t0\n'/><vertex x='+1e0' y='0' z='-0'/>"
        "<vertex x='0' y='.1E1' z='0.0000000000000000000000000000000000000000001'/>"
        "</c:vertices><c:triangles><triangle v1='0' v2='1' v3='2'/></c:triangles></c:mesh>"
        "</c:object></c:resources><c:build><c:item objectid='1'/></c:build></c:model>",
        NULL);
    CHECK1(got.triangle_count == 1 && corner_is(0, 1, 1, 0, 0) && corner_is(0, 2, 0, 1, 0));
}

/* x' = x m[0] + y m[3] + z m[6] + m[9], and so on: section 3.3. */
static void place(const double m[12], const double p[3], double to[3]) {
    for (int i = 0; i < 3; ++i) {
        to[i] = p[0] * m[i] + p[1] * m[3 + i] + p[2] * m[6 + i] + m[9 + i];
    }
}

#define OUTER "0 1 0 -1 0 0 0 0 2 5 6 7"
#define INNER "1 0.5 0 0 -1 0.25 0 0 1 10 20 30"

/* A component's transform is applied first, the item's last. Mirroring turns the triangles, which
 * keeps the sign of a solid's volume. */
static void test_transforms(void) {
    static const double outer[12] = {0, 1, 0, -1, 0, 0, 0, 0, 2, 5, 6, 7},
                        inner[12] = {1, 0.5, 0, 0, -1, 0.25, 0, 0, 1, 10, 20, 30};
    read_fine(MODEL("<object id='1'>" MESH "</object><object id='2'><components>"
                    "<component objectid='1' transform='" INNER "'/><component objectid='1'/>"
                    "</components></object>",
                    "<item objectid='2' transform='" OUTER "'/><item objectid='1'/>"),
              NULL);
    CHECK1(got.triangle_count == 12 && got.streams[BURNISH_POSITION].count == 12);
    static const unsigned face[3] = {1, 2, 3}; /* the third */
    for (size_t k = 0; k < 3 && got.triangle_count == 12; ++k) {
        const float *p = points[face[k]];
        const float *q = points[face[k == 0 ? 0 : 3 - k]]; /* as INNER mirrors */
        double from[3] = {(double)p[0], (double)p[1], (double)p[2]};
        double turned[3] = {(double)q[0], (double)q[1], (double)q[2]}, a[3], b[3];
        place(inner, turned, a);
        place(outer, a, b);
        CHECK(corner_is(2, k, b[0], b[1], b[2]), "both, corner %zu", k);
        place(outer, from, b);
        CHECK(corner_is(6, k, b[0], b[1], b[2]), "outer, corner %zu", k);
        CHECK(corner_is(10, k, from[0], from[1], from[2]), "none, corner %zu", k);
    }
}

/* An empty object in the middle, unused vertices, supports, objects that are not there. */
static void test_left_out(void) {
    read_fine(MODEL("<object id='1' type='support'>" MESH "</object>"
                    "<object id='2'><mesh/></object><object id='3' type='surface'><mesh><vertices>"
                    "<vertex x='9' y='9' z='9'/><vertex x='0' y='0' z='0'/>"
                    "<vertex x='9' y='9' z='9'/><vertex x='1' y='0' z='0'/>"
                    "<vertex x='0' y='1' z='0'/></vertices><triangles>"
                    "<triangle v1='1' v2='3' v3='4'/></triangles></mesh></object>",
                    ITEM_1 "<item objectid='2'/><item objectid='3'/>" ITEM_1),
              "mesh.3mf: 2 parts are not drawn: support");
    CHECK1(got.triangle_count == 1 && got.streams[BURNISH_POSITION].count == 3 &&
           corner_is(0, 1, 1, 0, 0) && corner_is(0, 2, 0, 1, 0));
    read_fine(MODEL("<object id='1'>" MESH "</object>", ITEM_1 "\n<item objectid='7'/>"),
              "mesh.3mf: 3D/a.model:5: object 7 does not exist and is ignored");
    read_fine(MODEL("<object id='1'>" MESH "</object><object id='2'><components>"
                    "<component objectid='1' transform='1 0 0 0 1 0 0 0 1 0 0 9'/></components>"
                    "</object>",
                    ""),
              "mesh.3mf: the build is empty; all objects are drawn");
    CHECK1(got.triangle_count == 4 && corner_is(0, 0, 0, 0, 9));
}

#define BEAM(a, b) "<b:beams><b:beam v1='" a "' v2='" b "'/></b:beams>"
#define LATTICE(attributes, content)                                                               \
    MODEL("<object id='2'>" MESH "</object><object id='1'><mesh>" TETRAHEDRON                      \
          "<b:beamlattice " attributes ">" content "</b:beamlattice></mesh></object>",             \
          ITEM_1)

/* Lattices: surfaces of 24 sides, measured against the solids that they are, in units of pi. */
static void test_lattices(void) {
    static const struct {
        const char *model;
        double volume;
        size_t warnings;
    } rows[] = {
        {LATTICE("radius='.5' cap='butt'", BEAM("0", "1") BEAM("0", "9")), 0.5, 1},
        {LATTICE("radius='.5' cap='butt'", BEAM("0", "1' r2='0' r1='.6") BEAM("0", "1' r1='0")),
         0.24, 0},
        {LATTICE(
             "radius='.5' c:ballmode='mixed' c:ballradius='.3' minlength='3.5'",
             BEAM("0", "1") "<c:balls><c:ball vindex='3'/><c:ball vindex='2' r='.6'/></c:balls>"),
         (0.027 + 0.216) * 4 / 3, 0},
        {LATTICE("radius='.3' cap='butt' c:ballmode='all' c:ballradius='.6'",
                 BEAM("0", "1' cap2='sphere") "<c:balls><c:ball vindex='1' r='.3'/></c:balls>"),
         0.18 + 0.018 + (0.216 + 0.027) * 4 / 3, 0},
        {LATTICE("radius='.5' representationmesh='2' clippingmode='inside'", BEAM("0", "1")),
         4 / 3.14159265, 0},
        {LATTICE("radius='.5' cap='butt' clippingmode='inside'", BEAM("0", "1")), 0.5, 1}};
    burnish_load_options options = burnish_load_options_default();
    options.measure = 1;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        zip_list *zip = begin_3mf(rows[i].model);
        end_zip(zip, 0);
        OWNED_MESH *mesh = load_bytes(zip->bytes, zip->size, "mesh.3mf", &options);
        const burnish_mesh_facts *facts = burnish_mesh_get_facts(mesh);
        if (CHECK1(facts && burnish_mesh_get_warning_count(mesh) == rows[i].warnings)) {
            const double ratio = facts->volume / (rows[i].volume * 3.14159265);
            CHECK(facts->is_closed && ratio > 0.97 && ratio < 1.001, "%zu: %g", i, ratio);
        }
    }
}

/* Objects of other parts, by paths in every spelling; ids are of a part. */
static void test_production(void) {
    static const char model[] =
        MODEL("<object id='1'><components><component p:path='/3D/../3d/./x/B.model' objectid='1'/>"
              "<component p:path='/none.model' objectid='1'/></components></object>",
              ITEM_1
              "<item p:path='\\3D\\x\\b.model' objectid='2' transform='1 0 0 0 1 0 0 0 1 5 0 0'/>");
    zip_list *zip = begin_3mf(model);
    put_part_text(zip, "3D/X/b.model",
                  quoted_text(MODEL_OF("unit='meter'",
                                       "<object id='1'>" MESH
                                       "</object>\n" ONE_TRIANGLE("partnumber='2'", ""),
                                       ITEM_1)));
    check_fault(run_3mf(zip), BURNISH_STATUS_FORMAT,
                "mesh.3mf: 3D/X/b.model:5: the id 1 is also used in line 4; give each "
                "resource its own");
    zip = begin_3mf(model);
    put_part_text(zip, "3D/X/b.model",
                  quoted_text(MODEL_OF("unit='meter'",
                                       "<object id='1'>" MESH "</object>"
                                       "<object id='2'><components><component objectid='1'/>"
                                       "</components></object>",
                                       ITEM_1)));
    CHECK_OK(run_3mf(zip), fault);
    check_warning("mesh.3mf: the part \"none.model\" is not in the archive; its objects are "
                  "missing");
    CHECK1(got.triangle_count == 8 && corner_is(0, 2, 2, 0, 0) && corner_is(4, 2, 7, 0, 0));
    CHECK_TEXT(got.unit ? got.unit : "", "inch");
}

/* ---- Properties ---- */

static const burnish_material *material_of(size_t i) {
    return &got.materials[got.triangle_materials ? got.triangle_materials[i] : 0];
}

/* A triangle's own pid and p1 go before its object's; p2 and p3 are as p1. */
static void test_bases(void) {
    read_fine(MODEL(BASES "<object id='1' pid='5' pindex='1'><mesh>" TETRAHEDRON "<triangles>"
                          "<triangle v1='0' v2='2' v3='1'/><triangle v1='0' v2='1' v3='3' p1='0'/>"
                          "<triangle v1='1' v2='2' v3='3' pid='5'/></triangles></mesh></object>"
                          "<object id='2'>" MESH "</object>",
                    ITEM_1 "<item objectid='2'/>"),
              NULL);
    if (CHECK1(got.triangle_count == 7 && got.material_count == 3 && got.triangle_materials)) {
        const float grey = burnish_material_default().diffuse[0];
        CHECK1(material_of(0)->diffuse[2] == 1 &&
               fabsf(material_of(0)->transparency - 127 / 255.0f) < 1e-6f);
        for (size_t i = 1; i < 3; ++i) {
            const burnish_material *m = material_of(i);
            CHECK1(m->diffuse[0] == burnish_srgb_to_linear[0x10] &&
                   m->diffuse[1] == burnish_srgb_to_linear[0x20] &&
                   m->ambient[2] == burnish_srgb_to_linear[0x30] && m->transparency == 0);
        }
        CHECK1(material_of(3)->diffuse[0] == grey && material_of(6)->diffuse[0] == grey);
        CHECK1(got.streams[BURNISH_COLOR].count == 0);
    }
}

static unsigned color_at(size_t corner) {
    const uint8_t *c = burnish_colors(&got) + 4 * (size_t)corners_of(BURNISH_COLOR)[corner];
    return (unsigned)c[0] << 24 | (unsigned)c[1] << 16 | (unsigned)c[2] << 8 | c[3];
}

static void test_colors(void) {
    read_fine(MODEL(BASES COLORS
                    "<object id='1' pid='6' pindex='0'><mesh>" TETRAHEDRON "<triangles>"
                    "<triangle v1='0' v2='2' v3='1' p1='0' p2='1' p3='2'/>"
                    "<triangle v1='0' v2='1' v3='3'/>"
                    "<triangle v1='1' v2='2' v3='3' p1='1'/>"
                    "<triangle v1='2' v2='0' v3='3' pid='5' p1='0'/></triangles></mesh>"
                    "</object>",
                    "<item objectid='1' transform='-1 0 0 0 1 0 0 0 1 0 0 0'/>"),
              NULL);
    if (CHECK1(got.triangle_count == 4 && got.streams[BURNISH_COLOR].count > 0)) {
        /* mirrored: the second and third change places */
        CHECK1(color_at(0) == 0x112233FF && color_at(1) == 0xFFFFFFFF && color_at(2) == 0x44556677);
        CHECK1(corner_is(0, 1, -2, 0, 0) && corner_is(0, 2, 0, 3, 0));
        CHECK1(color_at(3) == 0x112233FF && color_at(5) == 0x112233FF &&
               color_at(6) == 0x44556677 && color_at(8) == 0x44556677);
        CHECK1(color_at(9) == 0xFFFFFFFF && color_at(11) == 0xFFFFFFFF);
        CHECK1(!material_of(0)->has_diffuse && material_of(3)->has_diffuse &&
               material_of(3)->diffuse[0] == burnish_srgb_to_linear[0x10]);
    }
}

/* The weighted mean in linear light. */
#define INVISIBLE                                                                                  \
    "<basematerials id='5'><base name='a' displaycolor='#CAD1EE00'/>"                              \
    "<base name='b' displaycolor='#10203080'/></basematerials>"                                    \
    "<basematerials id='7'><base name='unused' displaycolor='#00000000'/></basematerials>"         \
    "<m:colorgroup id='6'><m:color color='#11223300'/><m:color color='#44556677'/></m:colorgroup>"

/* Alpha 00 means opaque, in bases and in colours; other values mean what they say. */
static void test_invisible(void) {
    read_fine(MODEL(INVISIBLE ONE_TRIANGLE("pid='5' pindex='0'", ""), ITEM_1),
              "mesh.3mf: 1 colour is fully transparent (alpha 00) and drawn opaque");
    CHECK1(got.material_count == 2 && material_of(0)->transparency == 0 &&
           material_of(0)->diffuse[0] == burnish_srgb_to_linear[0xCA]);
    CHECK1(got.material_count == 2 && got.materials[1].transparency > 0.4f);
    read_fine(MODEL(INVISIBLE "<object id='1' pid='6' pindex='0'><mesh>" TETRAHEDRON "<triangles>"
                              "<triangle v1='0' v2='2' v3='1' p1='0' p2='1' p3='0'/>"
                              "<triangle v1='0' v2='1' v3='3' pid='5' p1='0'/>"
                              "</triangles></mesh></object>",
                    ITEM_1),
              "mesh.3mf: 2 colours are fully transparent (alpha 00) and drawn opaque");
    if (CHECK1(got.streams[BURNISH_COLOR].count > 0)) {
        CHECK1(color_at(0) == 0x112233FF && color_at(1) == 0x44556677);
    }
    read_fine(MODEL(BASES ONE_TRIANGLE("pid='5' pindex='0'", ""), ITEM_1), NULL);
}

/* If no triangle has a colour, the look chooses the grey; next to colours it is burnish's. */
static void test_grey(void) {
    read_fine(MODEL("<object id='1'>" MESH "</object>", ITEM_1), NULL);
    CHECK1(got.material_count == 1 && !got.materials[0].has_diffuse);
    read_fine(MODEL(BASES "<object id='1' pid='5' pindex='0'>" MESH "</object><object id='2'>" MESH
                          "</object>",
                    ITEM_1 "<item objectid='2'/>"),
              NULL);
    CHECK1(got.material_count == 3 && material_of(0)->has_diffuse && !material_of(4)->has_diffuse);
    read_fine(MODEL(COLORS "<object id='1' pid='6' pindex='0'>" MESH "</object><object id='2'>" MESH
                           "</object>",
                    ITEM_1 "<item objectid='2'/>"),
              NULL);
    CHECK1(got.material_count == 2 && !material_of(0)->has_diffuse && material_of(4)->has_diffuse &&
           color_at(12) == 0xFFFFFFFF);
}

static void test_composites(void) {
    read_fine(MODEL(BASES "<m:compositematerials id='7' matid='5' matindices='1 0'>"
                          "<m:composite values='1 3'/><m:composite values='0 1'/>"
                          "</m:compositematerials>" ONE_TRIANGLE("pid='7'", "p1='0' p2='1' p3='0'"),
                    ITEM_1),
              NULL);
    if (CHECK1(got.triangle_count == 1 && got.streams[BURNISH_COLOR].count > 0)) {
        unsigned expected = 0;
        static const int first[3] = {0x10, 0x20, 0x30};
        for (int i = 0; i < 3; ++i) {
            const double mean = 0.25 + 0.75 * (double)burnish_srgb_to_linear[first[i]];
            expected = expected << 8 | burnish_linear_to_srgb((float)mean);
        }
        CHECK(color_at(0) == (expected << 8 | (0x80 + 3 * 255 + 2) / 4), "%x", color_at(0));
        CHECK1(color_at(1) == 0x102030FF);
    }
}

/* Of several layers the colours that hide the bases; indices that are left out are 0. */
static void test_multiples(void) {
    read_fine(MODEL("<m:multiproperties id='8' pids='6 5'><multi pindices='1 1'/>"
                    "<m:multi pindices=''/></m:multiproperties>" BASES COLORS ONE_TRIANGLE(
                        "pid='8'", "p1='0' p2='1' p3='1'"),
                    ITEM_1),
              "mesh.3mf: only the uppermost texture or colour of multiple properties is drawn");
    CHECK1(got.triangle_count == 1 && color_at(0) == 0x44556677 && color_at(1) == 0x112233FF);
}

static void test_bad_properties(void) {
    static const char *const cases[] = {
        MODEL(COLORS ONE_TRIANGLE("pid='6'", "p1='3'"), ITEM_1),
        MODEL(COLORS ONE_TRIANGLE("pid='6'", "p1='0' p2='1' p3='4294967294'"), ITEM_1),
        MODEL(COLORS ONE_TRIANGLE("pid='99'", ""), ITEM_1),
        MODEL("<m:multiproperties id='6' pids='6'><multi "
              "pindices='0'/></m:multiproperties>" ONE_TRIANGLE("pid='6'", ""),
              ITEM_1),
        MODEL("<m:compositematerials id='6' matid='6' matindices='0'><composite values='1'/>"
              "</m:compositematerials>" ONE_TRIANGLE("pid='6'", ""),
              ITEM_1),
        MODEL(ONE_TRIANGLE("pid='1'", ""), ITEM_1)};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        CHECK(read_3mf(cases[i]) == BURNISH_STATUS_OK, "%zu: %s", i, fault.text);
        CHECK(got.triangle_count == 1 && got.material_count == 1 && got.warning_count >= 1 &&
                  strstr(got.warnings[0], "missing properties"),
              "%zu", i);
    }
}

static void test_textures(void) {
    static uint8_t png[1 << 16];
    FILE *file = fopen(TEST_DATA_DIR "/tiles.png", "rb");
    const size_t size = file ? fread(png, 1, sizeof png, file) : 0;
    static const char model[] =
        MODEL(TEXTURES ONE_TRIANGLE("pid='10'", "p1='0' p2='1' p3='1'") "<object id='2'>" MESH
                                                                        "</object>",
              ITEM_1 "<item objectid='2'/>");
    if (file) {
        fclose(file);
    }
    zip_list *zip = begin_3mf(model);
    put_part(zip, "3d/T.PNG", png, size, 0);
    CHECK_OK(run_3mf(zip), fault);
    if (CHECK1(size > 0 && got.triangle_count == 5 && got.texture_count == 1 &&
               got.material_count == 2)) {
        const burnish_texture_use *use = &material_of(0)->textures[BURNISH_TEXTURE_COLOR];
        const uint32_t *corners = corners_of(BURNISH_TEXCOORD);
        const float *uv = got.streams[BURNISH_TEXCOORD].items;
        CHECK1(use->texture == 1 && use->wrap[0] == BURNISH_WRAP_CLAMP &&
               use->wrap[1] == BURNISH_WRAP_MIRROR && use->is_nearest);
        CHECK1(material_of(0)->diffuse[1] == 1 && got.textures[0].is_color);
        CHECK1(uv[2 * corners[0]] == 0.25f && uv[2 * corners[0] + 1] == 0.5f &&
               uv[2 * corners[1]] == -1 && uv[2 * corners[2] + 1] == 2);
        CHECK1(corners[3] == BURNISH_NONE && !material_of(1)->textures->texture);
    }
    read_fine(model, "mesh.3mf: texture \"3D/t.png\" is not in the archive");
    CHECK1(got.triangle_count == 5 && got.texture_count == 0 && got.material_count == 1);
}

/* The size of a solid, its winding, +Z up, and its unit through the public door. */
static void test_mesh(void) {
    burnish_load_options options = burnish_load_options_default();
    zip_list *zip = begin_3mf(MODEL("<object id='1'>" MESH "</object>", ITEM_1
                                    "<item objectid='1' transform='-1 0 0 0 1 0 0 0 1 -9 0 0'/>"));
    end_zip(zip, 0);
    options.measure = 1;
    OWNED_MESH *mesh = load_bytes(zip->bytes, zip->size, NULL, &options);
    const burnish_mesh_facts *facts = mesh ? burnish_mesh_get_facts(mesh) : NULL;
    if (CHECK1(facts)) {
        CHECK1(facts->is_solid && fabs(facts->volume - 8) < 1e-9 && facts->shell_count == 2);
        CHECK1(burnish_mesh_get_view(mesh)->up_axis[2] == 1);
        CHECK_TEXT(burnish_mesh_get_info(mesh)->unit, "inch");
    }
}

/* A build without expat reports that. */
static void test_without(void) {
    check_fault(read_3mf("<model/>"), BURNISH_STATUS_FORMAT,
                "mesh.3mf: a ZIP archive; this build of burnish lacks expat and can't read 3MF");
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    if (!BURNISH_HAS_3MF) {
        RUN(test_without());
        return test_end("3mf");
    }
    RUN(test_plain());
    RUN(test_transforms());
    RUN(test_left_out());
    RUN(test_lattices());
    RUN(test_production());
    RUN(test_bases());
    RUN(test_colors());
    RUN(test_invisible());
    RUN(test_grey());
    RUN(test_composites());
    RUN(test_multiples());
    RUN(test_bad_properties());
    RUN(test_textures());
    RUN(test_mesh());
    if (test_decimal_comma_begin()) {
        RUN(test_transforms());
        test_decimal_comma_end();
    }
    return test_end("3mf");
}
