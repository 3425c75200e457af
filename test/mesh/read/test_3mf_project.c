/* What slicers add to 3MF: volumes, filaments, painting and plates. */
#include <math.h>

#include "mesh_arrays.h"
#include "threemf_input.h"

#define COMPONENTS(list) "<object id='9'><components>" list "</components></object>"
#define COMPONENT(id) "<component p:path='/3D/b.model' objectid='" id "'/>"
#define AT(x, y) " transform='1 0 0 0 1 0 0 0 1 " x " " y " 0'/>"
#define KEY(key, value) "<metadata key='" key "' value='" value "'/>"
#define PART(attributes, keys) "<part " attributes ">" keys "</part>"
#define OBJECT(id, type) "<object id='" id "' type='" type "' name='o" id "'>" MESH "</object>"

/* Reads a project: a model, and a file of its slicer with each name that is not NULL. */
static zip_list *begin_project(const char *model, const char *settings, const char *colors) {
    zip_list *zip = begin_3mf(model);
    const int is_json = colors && *colors == '{';
    if (settings) {
        put_part_text(zip,
                      is_json || strstr(settings, "<part") || strstr(settings, "<plate")
                          ? "Metadata/model_settings.config"
                          : "Metadata/Slic3r_PE_model.config",
                      quoted_text(settings));
    }
    if (colors) {
        put_part_text(zip,
                      is_json ? "Metadata/project_settings.config" : "Metadata/Slic3r_PE.config",
                      is_json ? quoted_text(colors) : colors);
    }
    return zip;
}

static int read_project(const char *model, const char *settings, const char *colors) {
    return CHECK_OK(run_3mf(begin_project(model, settings, colors)), fault);
}

static const burnish_material *material_at(size_t triangle) {
    return &got.materials[got.triangle_materials ? got.triangle_materials[triangle] : 0];
}

static void check_part(size_t i, const char *name, burnish_part_role role, int filament) {
    if (CHECK(i < got.part_count, "part %zu of %zu", i, got.part_count)) {
        CHECK_TEXT(got.parts[i].name, name);
        CHECK(got.parts[i].role == role && got.parts[i].filament == filament, "part %zu: %d, %d", i,
              (int)got.parts[i].role, got.parts[i].filament);
    }
}

/* ---- What is drawn ---- */

/* The words of Bambu Studio count more than the types of objects; nth part, nth component. */
static void test_components(void) {
    zip_list *zip = begin_project(
        MODEL(COMPONENTS(COMPONENT("1") COMPONENT("2") COMPONENT("1") COMPONENT("3") COMPONENT("4")
                             COMPONENT("5") COMPONENT("6")),
              "<item objectid='9'/><item objectid='9' printable='0'" AT("9", "0")),
        "<config><object id='9'>" KEY("name", "thing") KEY("extruder", "2")
            PART("id='1' subtype='normal_part'",
                 KEY("name", "body")) PART("id='2' subtype='negative_part'", KEY("name", "hole"))
                PART("id='1' subtype='normal_part'",
                     KEY("extruder", "3")) PART("id='3' subtype='modifier_part'", "")
                    PART("id='4' subtype='support_blocker'", "")
                        PART("id='5'", KEY("part_type", "support_enforcer")) "</object></config>",
        "{'filament_colour':['#FF0000','#00FF0080','#0000FF']}");
    put_part_text(
        zip, "3D/b.model",
        quoted_text(MODEL(OBJECT("1", "other") OBJECT("2", "model") OBJECT("3", "model")
                              OBJECT("4", "other") OBJECT("5", "other") OBJECT("6", "other"),
                          "")));
    CHECK_OK(run_3mf(zip), fault);
    CHECK(got.part_count == 14 && got.triangle_count == 8, "%zu, %zu", got.part_count,
          got.triangle_count);
    check_part(0, "body", BURNISH_PART_SOLID, 2);
    check_part(1, "hole", BURNISH_PART_NEGATIVE, 2);
    check_part(2, "o1", BURNISH_PART_SOLID, 3);
    check_part(3, "o3", BURNISH_PART_MODIFIER, 2);
    check_part(4, "o4", BURNISH_PART_BLOCKER, 2);
    check_part(5, "o5", BURNISH_PART_ENFORCER, 2);
    check_part(6, "o6", BURNISH_PART_SUPPORT, 2);
    CHECK1(got.negatives && got.negatives->triangle_count == 4 &&
           got.negatives->streams[BURNISH_POSITION].count == 4 &&
           got.negatives->triangle_parts[3] == 1);
    CHECK1(got.triangle_parts && got.triangle_parts[3] == 0 && got.triangle_parts[4] == 2);
    CHECK1(got.triangle_materials && got.triangle_materials[0] == 1 &&
           got.triangle_materials[7] == 2 && material_at(7)->diffuse[2] == 1);
    CHECK1(fabsf(material_at(0)->transparency - 127.0F / 255) < 1e-6F);
    check_warnings(1,
                   "mesh.3mf: 11 parts are not drawn: modifier \"o3\", "
                   "support blocker \"o4\", support enforcer \"o5\", support \"o6\", not printed "
                   "\"body\", not printed \"hole\", not printed \"o1\", not printed \"o3\", not "
                   "printed \"o4\", not printed \"o5\", not printed \"o6\"");
}

/* PrusaSlicer's ranges of triangles; the old key counts less. Instances have objects of their own.
 */
static void test_ranges(void) {
    static const char settings[] =
        "<config><object id='1'>" KEY("extruder", "2") "<volume firstid='2' lastid='2'>" KEY(
            "name", "cut") KEY("volume_type", "NegativeVolume")
            KEY("modifier", "0") "</volume>"
                                 "<volume firstid='0' lastid='1'>" KEY("modifier", "1")
                                     KEY("volume_type", "ModelPart") KEY("extruder", "9")
                                         KEY("name", "body") "</volume></object></config>";
    read_project(MODEL("<object id='1'>" MESH "</object><object id='2'><components>"
                       "<component objectid='1'/></components></object>",
                       ITEM_1 "<item objectid='2'/>"),
                 settings,
                 "; extruder_colour = \"\";#0000ff\n; filament_colour = #FF0000;#00FF00\n"
                 "; extruder_colour = \"\";\"#0000ff\"\n");
    CHECK(got.part_count == 6 && got.triangle_count == 6, "%zu", got.triangle_count);
    check_part(3, "body", BURNISH_PART_SOLID, 1); /* filament 9 does not exist */
    check_part(4, "cut", BURNISH_PART_NEGATIVE, 2);
    check_part(5, "", BURNISH_PART_SOLID, 2);
    CHECK1(got.filament_count == 2 && got.filaments[0].srgb[0] == 255 &&
           got.filaments[1].srgb[2] == 255);
    CHECK1(got.triangle_parts[2] == 2 && got.triangle_parts[5] == 5 &&
           got.triangle_materials[2] == 1);
    CHECK1(got.parts[1].item == 0 && got.parts[4].item == 1);
    check_warning(NULL);
}

/* They are a mesh of their own. */
static void test_negatives(void) {
    burnish_load_options options = burnish_load_options_default();
    zip_list *zip = begin_project(
        MODEL(OBJECT("1", "model") "<object id='2'><components><component objectid='1'/><component "
                                   "objectid='1'" AT("9", "0") "</components></object>",
              "<item objectid='2'/>"),
        "<config><object id='2'><part id='1'/><part id='1' "
        "subtype='negative_part'/></object></config>",
        NULL);
    end_zip(zip, 0);
    options.measure = 1;
    OWNED_MESH *mesh = load_bytes(zip->bytes, zip->size, NULL, &options);
    const burnish_mesh *negatives = burnish_mesh_get_negatives(mesh);
    if (CHECK1(negatives)) {
        const burnish_mesh_view *view = burnish_mesh_get_view(negatives);
        CHECK1(view->triangle_count == 4 && view->triangle_parts[0] == 1 &&
               view->bounds_min[0] == 9 && burnish_mesh_get_facts(negatives)->is_solid);
        CHECK1(burnish_mesh_get_view(mesh)->bounds_max[0] == 2);
    }
}

/* They are left out with their solids or alone, and moved with their solids. */
static void test_parts_with_negatives(void) {
    static const struct {
        const char *hidden, *only;
        double explode;
        float low, high, negative; /* bounds; 99: there is none */
    } rows[] = {{NULL, NULL, 0, 0, 32, 9},   {NULL, "#1", 0, 0, 2, 9},
                {"#2", NULL, 0, 0, 32, 99},  {"#1", NULL, 0, 30, 32, 99},
                {NULL, "#3", 0, 30, 32, 99}, {NULL, NULL, 1, -15, 47, -6},
                {"#2", NULL, 1, -15, 47, 99}};
    zip_list *zip = begin_project(
        MODEL(OBJECT("1", "model") "<object id='2'><components><component objectid='1'/><component "
                                   "objectid='1'" AT("9", "0") "</components></object>",
              "<item objectid='2'/><item objectid='1'" AT("30", "0")),
        "<config><object id='2'><part id='1'/><part id='1' "
        "subtype='negative_part'/></object></config>",
        NULL);
    end_zip(zip, 0);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        burnish_load_options options = burnish_load_options_default();
        options.hidden_parts = rows[i].hidden;
        options.only_parts = rows[i].only;
        options.explode = rows[i].explode;
        OWNED_MESH *mesh = load_bytes(zip->bytes, zip->size, NULL, &options);
        const burnish_mesh *negatives = burnish_mesh_get_negatives(mesh);
        const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
        const float low = negatives ? burnish_mesh_get_view(negatives)->bounds_min[0] : 99;
        CHECK(mesh && view->bounds_min[0] == rows[i].low && view->bounds_max[0] == rows[i].high &&
                  low == rows[i].negative,
              "%zu: %g to %g, negative from %g", i, (double)view->bounds_min[0],
              (double)view->bounds_max[0], (double)low);
    }
}

/* Settings that can't be read do no harm, and colours of the model go first. */
static void test_other_settings(void) {
    read_project(MODEL("<object id='1'>" MESH "</object>", ITEM_1), "<config><object></config>",
                 "{'filament_colour':3");
    check_warnings(2,
                   "mesh.3mf: Metadata/model_settings.config can't be read; its settings are "
                   "not used",
                   "mesh.3mf: Metadata/project_settings.config can't be read; its settings are not "
                   "used");
    CHECK1(got.triangle_count == 4 && got.filament_count == 0 && !*fault.text);
    read_project(MODEL(BASES ONE_TRIANGLE("pid='5' pindex='1'", ""), ITEM_1), NULL,
                 "{'filament_colour':['#123456','none']}");
    check_warning(NULL);
    CHECK1(got.filament_count == 2 && material_at(0)->transparency > 0);
    read_project(
        MODEL("<object id='1'>" MESH "</object>", ITEM_1),
        "<config><object id='1'><part id='1'>" KEY("extruder", "2") "</part></object></config>",
        NULL);
    check_warning("mesh.3mf: the file has no colours for its filaments; any are drawn");
    check_part(0, "", BURNISH_PART_SOLID, 2); /* an object that is its only part */
}

/* ---- Painting ---- */

/* The area per filament of a painted triangle with corners (0, 0), (2, 0), (0, 3). */
static void check_areas(const char *code, const double shares[4]) {
    char model[2000];
    double areas[4] = {0, 0, 0, 0};
    snprintf(model, sizeof model, MODEL(ONE_TRIANGLE("", "paint_color='%s'"), ITEM_1), code);
    read_project(model, NULL, "{'filament_colour':['#FF0000','#00FF00','#0000FF','#FFFF00']}");
    check_warning(NULL);
    for (size_t i = 0; i < got.triangle_count; ++i) {
        const float *p[3];
        for (size_t k = 0; k < 3; ++k) {
            p[k] = burnish_positions(&got) + 3 * got.streams[BURNISH_POSITION].corners[3 * i + k];
        }
        const float cross =
            (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        CHECK(cross > 0, "%s: %zu", code, i); /* the winding of the whole */
        areas[got.triangle_materials[i]] += (double)cross / 6;
    }
    for (size_t k = 0; k < 4; ++k) {
        CHECK(fabs(areas[k] - shares[k]) < 1e-6, "%s: filament %zu has %g, not %g", code, k + 1,
              areas[k], shares[k]);
    }
}

/* Filament 0 is that of the part, the first; so are those that do not exist. */
static void test_codes(void) {
    check_areas("4", (double[4]){1, 0, 0, 0});
    check_areas("8", (double[4]){0, 1, 0, 0});
    check_areas("0C", (double[4]){0, 0, 1, 0});
    check_areas("1c", (double[4]){0, 0, 0, 1});
    check_areas("1FC", (double[4]){1, 0, 0, 0});
    check_areas("845", (double[4]){0.5, 0.5, 0, 0});
    check_areas("40C8A", (double[4]){0.25, 0.5, 0.25, 0});
    check_areas("48803", (double[4]){0.5, 0.5, 0, 0});
    check_areas("8888480C33", (double[4]){0.0625, 0.875, 0.0625, 0});
}

static void test_bad_codes(void) {
    static const char *const codes[] = {"C", "FFC", "45", "x", "4x5"};
    for (size_t i = 0; i < sizeof codes / sizeof *codes; ++i) {
        char model[2000];
        snprintf(model, sizeof model, MODEL(ONE_TRIANGLE("", "p:mmu_segmentation='%s'"), ITEM_1),
                 codes[i]);
        read_project(model, NULL, NULL);
        check_warning("mesh.3mf: 3D/a.model:4: the painting of a triangle ends early or is more "
                      "than 24 splits deep; it is not drawn");
        CHECK1(got.triangle_count == 1);
    }
    char deep[200] = "", model[2000]; /* 25 splits of one child each: two digits a level */
    for (int depth = 24; depth <= 25; ++depth) {
        memset(deep, '0', (size_t)depth + 1);
        memset(deep + depth + 1, '1', (size_t)depth);
        deep[2 * depth + 1] = 0;
        snprintf(model, sizeof model, MODEL(ONE_TRIANGLE("", "paint_color='%s'"), ITEM_1), deep);
        read_project(model, NULL, NULL);
        CHECK(depth == 24 ? got.triangle_count > 24 : got.triangle_count == 1, "%d: %zu", depth,
              got.triangle_count);
    }
}

/* A solid stays closed if only one of its faces is split, unevenly. */
static void test_joins(void) {
    zip_list *zip = begin_project(
        MODEL("<object id='1'><mesh>" TETRAHEDRON
              "<triangles><triangle v1='0' v2='2' v3='1' paint_color='444488883438443'/>"
              "<triangle v1='0' v2='1' v3='3'/><triangle v1='1' v2='2' v3='3'/>"
              "<triangle v1='2' v2='0' v3='3'/></triangles></mesh></object>",
              ITEM_1),
        NULL, NULL);
    burnish_load_options options = burnish_load_options_default();
    options.measure = 1;
    end_zip(zip, 0);
    OWNED_MESH *mesh = load_bytes(zip->bytes, zip->size, NULL, &options);
    const burnish_mesh_facts *facts = mesh ? burnish_mesh_get_facts(mesh) : NULL;
    if (CHECK1(facts)) {
        CHECK(facts->is_solid && fabs(facts->volume - 4) < 1e-6 && facts->triangle_count > 12,
              "%zu triangles, %zu open", facts->triangle_count, facts->open_edge_count);
    }
}

/* ---- Plates ---- */

#define PLATED "<object id='1'>" MESH "</object>"
#define PLATE(number, instance)                                                                    \
    "<plate>" KEY("plater_id", number)                                                             \
        KEY("plater_name", "p" number) "<model_instance>" KEY("object_id", "1")                    \
            KEY("instance_id", instance) "</model_instance></plate>"

static const char plated_model[] =
    MODEL(PLATED,
          "<item objectid='1'" AT("120", "10") "<item objectid='1'" AT(
              "0", "0") "<item objectid='1'" AT("0", "-240") "<item objectid='1'" AT("900", "900"));

/* Items are listed, or their position decides; those beside all plates are not printed. Plates
 * move together. */
static void test_plates(void) {
    read_project(plated_model, "<config>" PLATE("1", "1") PLATE("2", "0") "<plate/></config>",
                 "{'printable_area':['0x0','100x0','100x200','0x200']}");
    CHECK(got.part_count == 4 && got.plate_count == 3 && got.triangle_count == 12, "%zu",
          got.triangle_count);
    if (got.part_count == 4 && got.plate_count == 3) {
        CHECK1(got.parts[0].plate == 2 && got.parts[1].plate == 1 && got.parts[2].plate == 3 &&
               got.parts[3].plate == 0 && got.parts[3].role == BURNISH_PART_UNPRINTED);
        CHECK1(got.parts[0].transform[3] == 120 && got.parts[2].transform[7] == -240);
        CHECK_TEXT(got.plates[1].name, "p2");
    }
    /* contents of 2 x 3 x 4, on a grid of 2 x 2 with gaps of 0.75 */
    CHECK1(corner_is(0, 0, 2.75, 0, 0) && corner_is(4, 0, 0, 0, 0) && corner_is(8, 0, 0, -3.75, 0));
    read_project(plated_model, "<config>" PLATE("1", "1") "</config>",
                 "{'printable_area':['0x0','100x0','100x200','0x200']}");
    CHECK1(got.triangle_count == 4 && got.parts[0].role == BURNISH_PART_UNPRINTED);
}

static void test_one_plate(void) {
    burnish_load_options options = burnish_load_options_default();
    burnish_project *project = NULL;
    zip_list *zip = NULL;
    for (int i = 3; i >= 0; --i) { /* 3 fills the project, 2 takes it, and 1 is another file */
        zip = begin_project(plated_model,
                            i == 1 ? "<config>" PLATE("7", "1") PLATE("1", "0") "</config>"
                                   : "<config>" PLATE("1", "1") PLATE("7", "0") "</config>",
                            "{'printable_area':['0x0','100x200']}");
        end_zip(zip, 0);
        options.plate = i == 3 ? 0 : 7;
        options.project = i > 0 ? &project : NULL;
        CHECK_OK(run_reader(BURNISH_FORMAT_3MF, zip->bytes, zip->size, &options, NULL), fault);
        CHECK1(got.part_count == (i == 3 ? 4 : 1) && got.plate_count == 2 && got.unit);
        CHECK1(project);
        CHECK1(i == 3 || (i == 1 ? corner_is(0, 0, 0, 0, 0) : corner_is(0, 0, 120, 10, 0)));
    }
    burnish_project_destroy(project);
    options.plate = 2;
    check_fault(run_reader(BURNISH_FORMAT_3MF, zip->bytes, zip->size, &options, NULL),
                BURNISH_STATUS_ARGUMENT, "mesh.3mf: plate 2 does not exist; its plates are 1 to 7");
}

/* Parts that only other plates use are not read: a damaged one does not matter. An item that no
 * plate lists may be on any. */
static void test_parts_of_plate(void) {
    burnish_load_options options = burnish_load_options_default();
    zip_list *zip = begin_project(
        MODEL("<object id='1'><components><component p:path='/bad.model' objectid='1'/>"
              "</components></object>" COMPONENTS(COMPONENT("1")),
              "<item objectid='1'/><item objectid='9'" AT("120", "10")),
        "<config>" PLATE("1", "0") "<plate/></config>",
        "{'filament_colour':['#FF0000'],'printable_area':['0x0','100x0','100x200','0x200']}");
    put_part_text(zip, "3D/b.model", quoted_text(MODEL(OBJECT("1", "model"), "")));
    put_part_text(zip, "bad.model", "<model");
    end_zip(zip, 0);
    check_fault(run_reader(BURNISH_FORMAT_3MF, zip->bytes, zip->size, &options, NULL),
                BURNISH_STATUS_FORMAT,
                "mesh.3mf: bad.model:1: the XML is not well formed (unclosed token); repair the "
                "file");
    options.plate = 2;
    CHECK_OK(run_reader(BURNISH_FORMAT_3MF, zip->bytes, zip->size, &options, NULL), fault);
    CHECK(got.part_count == 1 && got.triangle_count == 4 && got.warning_count == 0, "%zu parts",
          got.part_count);
    zip = begin_project(
        MODEL("<object id='1'><components><component p:path='/c.model' objectid='1'/>"
              "</components></object>" COMPONENTS(COMPONENT("1")),
              "<item objectid='1'/><item objectid='9'" AT("120", "10")),
        "<config>" PLATE("1", "0") "<plate/></config>",
        "{'filament_colour':['#FF0000'],'printable_area':['0x0','100x0','100x200','0x200']}");
    put_part_text(zip, "c.model", quoted_text(MODEL(OBJECT("1", "model"), "")));
    put_part_text(zip, "3D/b.model", /* a part that needs another */
                  quoted_text(MODEL("<object id='1'><components><component p:path='/c.model' "
                                    "objectid='1'/></components></object>",
                                    "")));
    end_zip(zip, 0);
    CHECK_OK(run_reader(BURNISH_FORMAT_3MF, zip->bytes, zip->size, &options, NULL), fault);
    CHECK1(got.triangle_count == 4 && got.warning_count == 0);
}

/* PrusaSlicer lists no beds: they are squares of 1, 4 and 9, at a distance of their size and a gap.
 */
static void test_beds(void) {
    static const int plates[4] = {1, 2, 5, 3};
    burnish_load_options options = burnish_load_options_default();
    zip_list *zip = begin_project(
        MODEL(
            PLATED,
            "<item objectid='1'" AT("9", "9") "<item objectid='1'" AT(
                "59", "9") "<item objectid='1'" AT("110", "9") "<item objectid='1'" AT("9", "60")),
        NULL, ";\n; bed_shape = 0x0,40x0,40x30,0x30\n");
    CHECK_OK(run_3mf(zip), fault);
    for (size_t k = 0; k < 4 && CHECK1(got.plate_count == 5); ++k) {
        CHECK(got.parts[k].plate == plates[k], "%zu: %d", k, got.parts[k].plate);
    }
    options.plate = 4;
    check_fault(run_reader(BURNISH_FORMAT_3MF, zip->bytes, zip->size, &options, NULL),
                BURNISH_STATUS_ARGUMENT, "mesh.3mf: plate 4 is empty; draw another");
}

/* What the settings announce and no picture shows. */
static void test_undrawn(void) {
    static const char *const texts[2] = {";\n; support_material = 1\n", "{'enable_support':'1'}"};
    for (int i = 0; i < 2; ++i) {
        read_project(MODEL(PLATED, ITEM_1), NULL, texts[i]);
        check_warnings(1, "mesh.3mf: supports that the slicer will make are not drawn");
    }
}

/* ---- Heights ---- */

/* Three tetrahedra of two objects with filament 1, and a file of heights: the area of each filament in
 * the sides toward -y. Below z, such a side has 2 z - z^2 / 4. */
static void check_heights(const char *name, const char *heights, const double areas[3]) {
    zip_list *zip = begin_project(
        MODEL_OF("unit='millimeter'",
                 "<object id='7'>" MESH "</object><object id='3'>" MESH "</object>"
                 "<object id='4'><components><component objectid='7'/></components></object>",
                 "<item objectid='7'/><item objectid='4'" AT("9", "0") "<item objectid='3'" AT(
                     "0", "9")),
        NULL, ";\n; filament_colour = #FF0000;#00FF00\n; layer_height = 0.5\n");
    double found[3] = {0, 0, 0};
    put_part_text(zip, name, heights);
    CHECK_OK(run_3mf(zip), fault);
    check_warning(NULL);
    for (size_t i = 0; i < got.triangle_count; ++i) {
        const float *p[3];
        for (size_t k = 0; k < 3; ++k) {
            p[k] = burnish_positions(&got) + 3 * got.streams[BURNISH_POSITION].corners[3 * i + k];
        }
        const float area =
            (p[1][0] - p[0][0]) * (p[2][2] - p[0][2]) - (p[1][2] - p[0][2]) * (p[2][0] - p[0][0]);
        const int is_side = p[0][1] == p[1][1] && p[0][1] == p[2][1];
        found[got.triangle_materials[i]] += is_side ? (double)area / 2 : 0;
    }
    for (int k = 0; k < 3; ++k) {
        CHECK(fabs(found[k] - areas[k]) < 1e-5, "%s: filament %d has %g, not %g", name, k + 1,
              found[k], areas[k]);
    }
    burnish_load_options options = burnish_load_options_default();
    options.measure = 1;
    OWNED_MESH *mesh = load_bytes(zip->bytes, zip->size, NULL, &options);
    CHECK(burnish_mesh_get_facts(mesh)->is_solid &&
              fabs(burnish_mesh_get_facts(mesh)->volume - 12) < 1e-5,
          "%s", name);
}

static void test_heights(void) {
    check_heights("Metadata/Prusa_Slicer_layer_config_ranges.xml",
                  "<objects><object id=\"1\"><range min_z=\"1\" max_z=\"2\"><option "
                  "opt_key=\"layer_height\">0.2</option><option opt_key=\"extruder\">2</option>"
                  "</range></object></objects>",
                  (double[3]){12 - 2 * 1.25, 2 * 1.25, 0});
    check_heights("Metadata/layer_config_ranges.xml",
                  "<object id=\"2\"><range min_z=\"-1\" max_z=\"3\"><option "
                  "opt_key=\"extruder\">2</option><option opt_key=\"extruder\">0</option>",
                  (double[3]){8.25, 3.75, 0});
    check_heights("Metadata/custom_gcode_per_layer.xml",
                  "<plate><plate_info id=\"1\"/><layer top_z=\"1.5\" type=\"2\" extruder=\"2\" "
                  "color=\"#0000FF\"/><layer top_z=\"2\" type=\"1\" extruder=\"1\"/><layer "
                  "top_z=\"3.5\" type=\"0\" extruder=\"1\" color=\"#0000FF\"/></plate>",
                  (double[3]){5.25, 6.75, 0});
    check_heights("Metadata/Prusa_Slicer_custom_gcode_per_print_z.xml",
                  "<custom_gcodes_per_print_z bed_idx=\"0\"><code print_z=\"2.5\" type=\"0\" "
                  "extruder=\"1\" color=\"#0000FF\" gcode=\"M600\"/></custom_gcodes_per_print_z>",
                  (double[3]){9, 0, 3});
}

/* Each item has its own heights, which many heights and items together would take long to find. */
static void test_many_heights(void) {
    enum { ITEMS = 1 << 14, HEIGHTS = 512, EACH = 48 };
    static const char layer[] = "<layer top_z='1' type='2' extruder='2'/>";
    static char items[ITEMS * EACH], heights[HEIGHTS * EACH];
    size_t size = (size_t)snprintf(items, sizeof items, "%s", MODEL(ONE_TRIANGLE("", ""), "%"));
    size -= strlen("%</build></model>");
    for (int i = 0; i < ITEMS; ++i) {
        size += (size_t)snprintf(items + size, EACH, ITEM_1);
    }
    snprintf(items + size, EACH, "</build></model>");
    for (size_t i = 0; i < HEIGHTS; ++i) {
        snprintf(heights + i * strlen(layer), EACH, "%s<", layer);
    }
    zip_list *zip = begin_project(items, NULL, ";\n; filament_colour = #FF0000;#00FF00\n");
    put_part_text(zip, "Metadata/custom_gcode_per_layer.xml", quoted_text(heights));
    CHECK_OK(run_3mf(zip), fault);
    check_warning("mesh.3mf: 512 changes of the filament are too many for 16384 items; they are "
                  "not drawn");
}

/* Triangles keep their parts when they are reordered and cut. */
static void test_triangle_parts(void) {
    const burnish_clip_plane plane = {{0, 0, 1}, 2};
    burnish_load_options options = burnish_load_options_default();
    zip_list *zip = begin_3mf(MODEL(
        PLATED, ITEM_1 "<item objectid='1'" AT("30", "0") "<item objectid='1'" AT("-30", "0")));
    end_zip(zip, 0);
    OWNED_MESH *mesh = load_bytes(zip->bytes, zip->size, NULL, &options);
    for (int cut = 0; mesh && cut < 2; ++cut) {
        burnish_box boxes[3];
        CHECK1(burnish_mesh_get_contents(mesh)->part_count == 3);
        burnish_mesh_bound_parts(mesh, boxes);
        for (int i = 0; i < 3; ++i) {
            const float x = (float)(i == 0 ? 0 : i == 1 ? 30 : -30);
            CHECK(boxes[i].low[0] == x && boxes[i].high[0] == x + 2 && boxes[i].low[2] == 0 &&
                      boxes[i].high[2] == (cut ? 2 : 4),
                  "part %d: %g to %g", i, (double)boxes[i].low[0], (double)boxes[i].high[0]);
        }
        CHECK_OK(burnish_mesh_clip(mesh, &plane, &fault), fault);
    }
    burnish_coloring coloring = burnish_coloring_default();
    coloring.source = BURNISH_COLOR_BY_FILAMENT;
    check_fault(burnish_mesh_color_by(mesh, &coloring, NULL, &fault), BURNISH_STATUS_ARGUMENT,
                "colours: the mesh has no filaments; only print projects have them");
    coloring.source = BURNISH_COLOR_BY_PART;
    CHECK_OK(burnish_mesh_color_by(mesh, &coloring, NULL, &fault), fault);
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    for (size_t i = 0; mesh && i < view->triangle_count; ++i) {
        const size_t part = view->triangle_parts[i];
        uint8_t srgb[3];
        burnish_part_color(part, srgb);
        CHECK1(view->triangle_materials[i] == part &&
               burnish_mesh_get_material(mesh, part)->diffuse[1] ==
                   burnish_srgb_to_linear[srgb[1]]);
    }
    CHECK1(!burnish_mesh_get_negatives(mesh) && !burnish_mesh_get_negatives(NULL));
    CHECK1(!burnish_part_role_name(BURNISH_PART_ROLE_COUNT) && !burnish_mesh_get_contents(NULL));
}

/* ---- Pictures ---- */

/* A package without a mesh is its picture, which is named by a relationship, or of the plate. */
static void test_thumbnail(void) {
    static uint8_t png[1 << 16];
    FILE *file = fopen(TEST_DATA_DIR "/tiles.png", "rb");
    const size_t size = file ? fread(png, 1, sizeof png, file) : 0;
    if (file) {
        fclose(file);
    }
    burnish_load_options options = burnish_load_options_default();
    for (int i = 0; i < 4 && CHECK1(size > 0); ++i) {
        zip_list *zip = begin_3mf(i == 1   ? MODEL("<object id='1'>" MESH "</object>", ITEM_1)
                                  : i == 2 ? "<model requiredextensions='s' xmlns:s='secret'/>"
                                           : MODEL("", ""));
        put_part(zip, i == 3 ? "Metadata/plate_2.png" : "Metadata/thumbnail.png", png, size, 0);
        if (i == 2) {
            put_part_text(zip, "Secure/keystore.xml", "?");
        }
        end_zip(zip, 0);
        options.measure = 1;
        options.plate = i == 3 ? 2 : 0;
        options.thumbnail = i == 1 ? BURNISH_THUMBNAIL_ONLY : BURNISH_THUMBNAIL_AUTO;
        OWNED_MESH *mesh = load_bytes(zip->bytes, zip->size, "a.3mf", &options);
        if (CHECK1(mesh && burnish_mesh_get_texture_count(mesh) == 1)) {
            const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
            const float width = (float)burnish_mesh_get_texture(mesh, 0)->width;
            CHECK1(burnish_mesh_get_info(mesh)->is_thumbnail && !burnish_mesh_get_facts(mesh));
            CHECK1(view->triangle_count == 2 && view->bounds_max[0] == width);
            CHECK_TEXT(burnish_mesh_get_warning(mesh, 0),
                       i == 1   ? "a.3mf: its model is not wanted; the picture that it holds is "
                                  "drawn, no geometry"
                       : i == 2 ? "a.3mf: it is encrypted; the picture that it holds is drawn, no "
                                  "geometry"
                                : "a.3mf: no triangles are built; the picture that it holds is "
                                  "drawn, no geometry");
        }
        options.thumbnail = BURNISH_THUMBNAIL_NEVER;
        burnish_mesh *none = NULL;
        const burnish_status status =
            burnish_mesh_load_memory(zip->bytes, zip->size, "a.3mf", &options, &none, &fault);
        CHECK(i == 1 ? status == BURNISH_STATUS_OK : status == BURNISH_STATUS_FORMAT, "%d", i);
        burnish_mesh_destroy(none);
    }
    options.thumbnail = BURNISH_THUMBNAIL_ONLY;
    zip_list *zip = begin_3mf(MODEL("<object id='1'>" MESH "</object>", ITEM_1));
    end_zip(zip, 0);
    check_fault(run_reader(BURNISH_FORMAT_3MF, zip->bytes, zip->size, &options, NULL),
                BURNISH_STATUS_FORMAT, "mesh.3mf: it holds no picture of itself; draw its model");
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    if (BURNISH_HAS_3MF) {
        RUN(test_components());
        RUN(test_ranges());
        RUN(test_negatives());
        RUN(test_other_settings());
        RUN(test_codes());
        RUN(test_bad_codes());
        RUN(test_joins());
        RUN(test_plates());
        RUN(test_one_plate());
        RUN(test_parts_of_plate());
        RUN(test_beds());
        RUN(test_undrawn());
        RUN(test_heights());
        RUN(test_many_heights());
        RUN(test_triangle_parts());
        RUN(test_parts_with_negatives());
        RUN(test_thumbnail());
    }
    return test_end("3mf_project");
}
