/* 3MF that is invalid, hostile or damaged. */
#include "threemf_input.h"

/* ---- What is refused ---- */

static const struct {
    const char *model, *line;
} refused[] = {
    {MODEL("<object id='1'>" MESH "</object>", "<item objectid='2'/>"),
     "no triangles are built; export the model's meshes"},
    {MODEL_OF("unit='yard'", "", ITEM_1), "3D/a.model:2: unit \"yard\" is not one of micron, "
                                          "millimeter, centimeter, inch, foot, meter"},
    {MODEL_OF("xmlns:d='http://x.com/displacement/2022' requiredextensions='p d'", "", ITEM_1),
     "3D/a.model:2: the model can't be drawn without the extension "
     "http://x.com/displacement/2022, which is not supported; export it without"},
    {"<!DOCTYPE model [<!ENTITY a 'b'>]><model>&a;</model>",
     "3D/a.model:1: a document type (DOCTYPE), which 3MF forbids; remove it"},
    {"<model>&a;</model>",
     "3D/a.model:1: the XML is not well formed (undefined entity); repair the file"},
    {"<model>\n<resources></model>",
     "3D/a.model:2: the XML is not well formed (mismatched tag); repair the file"},
    {MODEL("<object id='x'/>", ""),
     "3D/a.model:4: id \"x\" is not a number from 0 to 4294967294; repair the file"},
    {MODEL("<object id='4294967295'/>", ""),
     "3D/a.model:4: id \"4294967295\" is not a number from 0 to 4294967294; repair the file"},
    {MODEL("<object/>", ""),
     "3D/a.model:4: id \"\" is not a number from 0 to 4294967294; repair the file"},
    {MODEL("<object id='1'><mesh><vertices>\n<vertex x='0' y='nan' z='0'/>", ""),
     "3D/a.model:5: y \"nan\" is not finite; repair or remove it"},
    {MODEL("<object id='1'><mesh><vertices><vertex x='0' y='1e39' z='0'/>", ""),
     "3D/a.model:4: y \"1e39\" is out of range; scale it to below 3.4e38"},
    {MODEL("<object id='1'><mesh><vertices><vertex x='0' y='0'/>", ""),
     "3D/a.model:4: z \"\" is not a number; write it like 1.5 or -2e-3"},
    {MODEL("<object id='1'><mesh>" TETRAHEDRON
           "<triangles><triangle v1='0' v2='1' v3='4'/></triangles></mesh></object>",
           ITEM_1),
     "3D/a.model:4: v3 \"4\" is out of range; there are 4 vertices, counted from 0"},
    {MODEL("<object id='1'><mesh>" TETRAHEDRON "</mesh></object>", ITEM_1),
     "no triangles are built; export the model's meshes"},
    {MODEL("<object id='1'/>", "<item objectid='1' transform=''/>"),
     "3D/a.model:4: transform is not 12 finite numbers; repair the file"},
    {MODEL("<object id='1'>" MESH "</object>", "<item objectid='1' transform='1 0 0'/>"),
     "3D/a.model:4: transform is not 12 finite numbers; repair the file"},
    {MODEL("<object id='1'>" MESH "</object>",
           "<item objectid='1' transform='1e38 0 0 0 1 0 0 0 1 3e38 0 0'/>"),
     "3D/a.model:4: a position of the object is placed beyond 3.4e38; repair the transforms"},
    {MODEL("<object id='1'><components><component objectid='2'/></components></object>\n"
           "<object id='2'><components>\n<component objectid='1'/></components></object>",
           ITEM_1),
     "3D/a.model:6: an object holds itself; repair the file"},
};

static void test_refused(void) {
    for (size_t i = 0; i < sizeof refused / sizeof *refused; ++i) {
        char line[400];
        CHECK(read_3mf(refused[i].model) == BURNISH_STATUS_FORMAT, "%zu", i);
        snprintf(line, sizeof line, "mesh.3mf: %s", refused[i].line);
        CHECK_TEXT(fault.text, line);
    }
}

static void test_left_out(void) {
    CHECK_OK(
        read_3mf(MODEL("<object id='1'><mesh>" TETRAHEDRON "<triangles><triangle v1='0' v2='1' "
                       "v3='9'/>" FACES "</triangles></mesh></object>",
                       ITEM_1)),
        fault);
    CHECK1(got.triangle_count == 4 && got.warning_count == 1);
    CHECK_TEXT(got.warnings[0],
               "mesh.3mf: 3D/a.model:4: v3 \"9\" is out of range; there are 4 vertices, "
               "counted from 0; it was left out");
    static const char odd[] =
        "\n<model unit='Inch'><resources><object id='1'><mesh><vertices><vertex x='0,5' y='1D0' "
        "z='0'/>"
        "<vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/><vertex x='one' y='1'/></vertices>"
        "<triangles><triangle v1='0.0' v2='1' v3='2'/><triangle v1='0' v2='1' v3='3'/><triangle "
        "v1='x'/>"
        "</triangles></mesh></object></resources><build><item objectid='1' transform='1 0 0 0 1 0 "
        "0 "
        "0 1 0 2,5 0'/></build></model>";
    CHECK_OK(read_3mf(odd), fault);
    CHECK1(got.triangle_count == 1 && got.warning_count == 2 && corner_is(0, 0, 0.5, 3.5, 0));
}

/* Objects that hold the one before twice: 2^n of them, from n lines. */
static void write_doubled(char *model, unsigned count, int is_empty, unsigned times) {
    char *to = model;
    to += sprintf(to, "<model><resources><object id='1'>%s</object>", is_empty ? "<mesh/>" : MESH);
    for (unsigned i = 2; i <= count; ++i) {
        to += sprintf(to, "<object id='%u'><components>", i);
        for (unsigned k = 0; k < times; ++k) {
            to += sprintf(to, "<component objectid='%u'/>", i - 1);
        }
        to += sprintf(to, "</components></object>");
    }
    sprintf(to, "</resources><build><item objectid='%u'/></build></model>", count);
}

static void test_nesting(void) {
    static char model[1 << 16];
    static const struct {
        unsigned count, times;
        int is_empty;
        burnish_status status;
        const char *text;
    } cases[] = {
        {64, 1, 0, BURNISH_STATUS_OK, ""},
        {65, 1, 0, BURNISH_STATUS_LIMIT, "objects are nested more than 64 deep; export them flat"},
        {9, 2, 0, BURNISH_STATUS_OK, ""},
        {60, 2, 1, BURNISH_STATUS_FORMAT, "no triangles are built"},
        {60, 2, 0, BURNISH_STATUS_LIMIT, "become more than 5242880 vertices and triangles"},
        {24, 2, 0, BURNISH_STATUS_LIMIT, "become more than 5242880 vertices and triangles"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        write_doubled(model, cases[i].count, cases[i].is_empty, cases[i].times);
        const burnish_status status = read_3mf(model);
        CHECK(status == cases[i].status && strstr(fault.text, cases[i].text), "%zu: %d %s", i,
              status, fault.text);
        CHECK1(status != BURNISH_STATUS_OK || got.triangle_count == (i == 0 ? 4 : 4u << 8));
    }
}

static void test_limits(void) {
    static char text[1 << 21];
    burnish_load_options options = burnish_load_options_default();
    zip_list *zip = begin_3mf(MODEL("<object id='1'>" MESH "</object>", ITEM_1 ITEM_1));
    end_zip(zip, 0);
    options.max_triangles = 7;
    check_fault(run_reader(BURNISH_FORMAT_3MF, zip->bytes, zip->size, &options, NULL),
                BURNISH_STATUS_LIMIT,
                "mesh.3mf: more than 7 triangles; raise the limit or simplify the mesh");
    options.max_triangles = 8;
    CHECK_OK(run_reader(BURNISH_FORMAT_3MF, zip->bytes, zip->size, &options, NULL), fault);

    /* what unpacks to more than it may; a tag without an end; elements in elements */
    static const char *const heads[] = {"<model>", "<model a='", "<model>"};
    static const char *const lines[] = {
        ("mesh.3mf: 3D/3dmodel.model: the archive unpacks to more than the limit of 1048576 bytes; "
         "raise the limit or simplify the mesh"),
        "mesh.3mf: 3D/3dmodel.model:1: a tag or comment of more than 1 MiB",
        "mesh.3mf: 3D/3dmodel.model:1: elements more than 64 deep"};
    for (int i = 0; i < 3; ++i) {
        zip->size = zip->directory_size = zip->count = 0;
        memset(text, ' ', sizeof text);
        memcpy(text, heads[i], strlen(heads[i]));
        for (size_t k = strlen(heads[i]); i == 2 && k + 3 <= sizeof text; k += 3) {
            memcpy(text + k, "<a>", 3);
        }
        put_part(zip, "3D/3dmodel.model", text, sizeof text, 1);
        if (i > 0) {
            put_part(zip, "padding", text + 100, 1 << 16, 0);
        }
        end_zip(zip, 0);
        options.max_input_bytes = i == 0 ? 1 << 20 : 1 << 30;
        check_fault(run_reader(BURNISH_FORMAT_3MF, zip->bytes, zip->size, &options, NULL),
                    BURNISH_STATUS_LIMIT, lines[i]);
    }
}

/* ---- Archives ---- */

static const char small_model[] = MODEL(COLORS ONE_TRIANGLE("pid='6'", "p1='0' p2='1'"), ITEM_1);

static void test_archives(void) {
    zip_list *zip = begin_3mf(small_model);
    end_zip(zip, 1);
    CHECK(read_bytes(BURNISH_FORMAT_AUTO, zip->bytes, zip->size) == BURNISH_STATUS_OK,
          "64 bits: %s", fault.text);
    CHECK1(got.triangle_count == 1);

    zip->size = zip->directory_size = zip->count = 0;
    put_part_text(zip, "word/document.xml", "<a/>");
    check_fault(run_3mf(zip), BURNISH_STATUS_FORMAT,
                "mesh.3mf: a ZIP archive of other parts, such as a document, without a 3D model");

    static const struct {
        size_t at; /* in the model's entry of the directory */
        uint8_t value;
        const char *text;
    } cases[] = {{8, 1, "the part is encrypted; export it without a password"},
                 {10, 14, "the part is packed in a way that is not read; pack it by deflate"},
                 {16, 0x5a, "the part's size or checksum does not match; fetch the file again"},
                 {24, 0x5a, "the part's size or checksum does not match; fetch the file again"},
                 {22, 0x5a, "the part reaches beyond the archive; the file is truncated"},
                 {44, 0x5a, "the part is not where the archive says; the file is damaged"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char line[200];
        zip->size = zip->directory_size = zip->count = 0;
        put_part_text(zip, "3D/3dmodel.model", quoted_text(small_model));
        zip->directory[cases[i].at] = cases[i].value;
        CHECK(run_3mf(zip) == BURNISH_STATUS_FORMAT, "%zu", i);
        snprintf(line, sizeof line, "mesh.3mf: 3D/3dmodel.model: %s", cases[i].text);
        CHECK_TEXT(fault.text, line);
    }
}

/* Every beginning of a model, in a sound archive. */
static void test_truncated_model(void) {
    char model[sizeof small_model];
    for (size_t i = 0; i + 1 < sizeof model; ++i) {
        memcpy(model, small_model, i);
        model[i] = 0;
        CHECK(read_3mf(model) == BURNISH_STATUS_FORMAT && strstr(fault.text, "3D/a.model:"),
              "%zu bytes: %s", i, fault.text);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    if (!BURNISH_HAS_3MF) {
        puts("3mf_faults: built without expat");
        return EXIT_SUCCESS;
    }
    RUN(test_refused());
    RUN(test_left_out());
    RUN(test_nesting());
    RUN(test_limits());
    RUN(test_archives());
    RUN(test_truncated_model());
    return test_end("3mf_faults");
}
