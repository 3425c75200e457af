/* index.html: shows all pictures and loads nothing else. */
#include <stdlib.h>
#include <string.h>

#include "base/cli/file.h"
#include "base/cli/output.h"
#include "base/cli/platform.h"
#include "batch/batch.h"
#include "batch/types.h"

const batch_unit batch_units[BATCH_UNITS] = {{"", "", 0},
                                             {"micron", "&micro;m", 1e-3},
                                             {"millimeter", "mm", 1},
                                             {"centimeter", "cm", 10},
                                             {"meter", "m", 1000},
                                             {"inch", "in", 25.4},
                                             {"foot", "ft", 304.8}};
enum { FIRST_IMPERIAL = 5 };

static const char head[] =
    "<meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
    "<meta name=\"color-scheme\" content=\"light dark\">\n"
    "<style>\n"
    ":root{--page:#f6f7f9;--card:#fff;--ink:#16181d;--soft:#5d6470;--line:#e1e4e9;--key:#2f6fd6;"
    "--bad:#b3261e}\n"
    "@media(prefers-color-scheme:dark){:root{--page:#121418;--card:#1b1e24;--ink:#eceef2;"
    "--soft:#9aa2af;--line:#2b3038;--key:#7fb0ff;--bad:#ff8a80}}\n"
    "*{box-sizing:border-box}\n"
    "body{margin:0;background:var(--page);color:var(--ink);font:15px/1.45 system-ui,-apple-system,"
    "\"Segoe UI\",Roboto,\"Helvetica Neue\",Arial,sans-serif}\n"
    "header{position:sticky;top:0;z-index:1;background:var(--page);border-bottom:1px solid "
    "var(--line);padding:14px 20px;display:flex;flex-wrap:wrap;gap:10px 16px;align-items:center}\n"
    "h1{font-size:20px;font-weight:650;margin:0;overflow-wrap:anywhere}\n"
    "#count{color:var(--soft);margin-right:auto}\n"
    "input,select{font:inherit;color:inherit;background:var(--card);border:1px solid var(--line);"
    "border-radius:9px;padding:8px 12px;min-height:40px}\n"
    "#tools{display:flex;gap:10px;flex:0 1 440px;min-width:min(100%,300px)}\n" /* one row */
    "input{flex:1 1 0;min-width:0}\n"
    "input:focus-visible,select:focus-visible,a:focus-visible{outline:2px solid var(--key);"
    "outline-offset:2px}\n"
    "main{display:grid;grid-template-columns:repeat(auto-fill,minmax(220px,1fr));gap:16px;"
    "padding:20px;max-width:1800px;margin:auto}\n"
    "article{background:var(--card);border:1px solid var(--line);border-radius:14px;"
    "overflow:hidden;content-visibility:auto;contain-intrinsic-size:auto 300px}\n"
    "article[hidden]{display:none}\n"
    "article a{display:block;background:#fff}\n"
    "img{display:block;width:100%;height:auto}\n"
    "h2{font-size:15px;font-weight:600;margin:0;padding:12px 14px 0;overflow-wrap:anywhere}\n"
    "p{margin:0;padding:2px 14px 12px;color:var(--soft);font-size:13px;"
    "font-variant-numeric:tabular-nums}\n"
    "i{display:inline-block;width:12px;height:12px;border-radius:3px;margin-right:3px;"
    "border:1px solid var(--line)}\n"
    ".warning{padding-top:0;margin-top:-8px}\n"
    ".bad{color:var(--bad);font-weight:600}\n"
    "section{max-width:1800px;margin:auto;padding:0 20px 28px}\n"
    "section h2{padding:8px 0;color:var(--bad)}\n"
    "ul{margin:0;padding-left:20px;color:var(--soft);font-size:14px;overflow-wrap:anywhere}\n"
    "li{padding:2px 0}\n"
    "#none{display:none;padding:40px 20px;text-align:center;color:var(--soft)}\n"
    "@media(max-width:560px){header{padding:12px}h1{flex:1 1 40%}#count{margin:0}"
    "#tools{flex:1 1 100%}main{grid-template-columns:repeat(2,1fr);gap:10px;padding:12px}h2{font-"
    "size:14px;"
    "padding:8px 10px 0}p{padding:2px 10px 10px;font-size:12px}section{padding:0 12px 20px}"
    "article{border-radius:10px}}\n"
    "</style>\n";

static const char script[] =
    "<script>\n"
    "const main=document.querySelector('main'),cards=[...main.children],"
    "find=document.getElementById('find'),order=document.getElementById('order'),"
    "count=document.getElementById('count'),none=document.getElementById('none'),"
    "text=cards.map(c=>c.textContent.toLowerCase()),"
    "names=cards.map(c=>c.querySelector('h2').textContent);\n"
    "const number=n=>n.toLocaleString('en');\n"
    "function show(){const words=find.value.toLowerCase().split(/\\s+/);let seen=0;"
    "cards.forEach((c,i)=>{const is=words.every(w=>text[i].includes(w));c.hidden=!is;seen+=is});"
    "count.textContent=seen===cards.length?number(seen)+(seen===1?' model':' models'):"
    "number(seen)+' of '+number(cards.length);none.style.display=seen?'none':'block'}\n"
    "function sort(){const key=order.value;const compare=(a,b)=>"
    "(key?cards[b].dataset[key]-cards[a].dataset[key]:0)||"
    "names[a].localeCompare(names[b],'en',{numeric:true})||a-b;"
    "main.append(...cards.map((c,i)=>i).sort(compare).map(i=>cards[i]))}\n"
    "find.addEventListener('input',show);order.addEventListener('change',sort);\n"
    "addEventListener('keydown',e=>{if(e.key==='/'&&document.activeElement!==find){"
    "e.preventDefault();find.focus()}});\n"
    "show();sort();\n"
    "</script>\n";

/* Text of HTML, cleaned: bidirectional controls would reorder names there too. */
static void put_text(FILE *page, const char *text) {
    char *clean = strdup(text);
    if (clean) {
        cli_clean(clean);
    }
    for (const char *c = clean ? clean : ""; *c; ++c) {
        const char *entity = *c == '&' ? "&amp;" : *c == '<' ? "&lt;" : *c == '"' ? "&quot;" : NULL;
        if (entity) {
            fputs(entity, page);
        } else {
            fputc(*c, page);
        }
    }
    free(clean);
}

/* A path as a relative reference (RFC 3986). */
static void put_link(FILE *page, const char *path) {
    static const char plain[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
    for (const char *c = path; *c; ++c) {
        if (strchr(plain, *c)) {
            fputc(*c, page);
        } else {
            fprintf(page, "%%%02X", (unsigned)(unsigned char)*c);
        }
    }
}

/* 1234567 as 1,234,567 */
static void put_count(FILE *page, double value) {
    char digits[32];
    const int length = snprintf(digits, sizeof digits, "%.0f", value);
    for (int i = 0; i < length; ++i) {
        fprintf(page, "%s%c", i > 0 && (length - i) % 3 == 0 ? "," : "", digits[i]);
    }
}

static int is_false(const cJSON *line, const char *key) {
    return cJSON_IsFalse(cJSON_GetObjectItemCaseSensitive(line, key));
}

/* The unit that the input states, or --unit. */
static const batch_unit *unit_of(const batch *b, const cJSON *line) {
    const char *name = batch_text(line, "unit");
    for (int i = 1; i < BATCH_UNITS; ++i) {
        if (strcmp(name, batch_units[i].name) == 0) {
            return &batch_units[i];
        }
    }
    return &batch_units[b->settings->unit];
}

/* Volume and area in cm or inches; in the input's unit if that is unknown. */
static void put_measured(FILE *page, const cJSON *line, const batch_unit *unit) {
    const int is_imperial = unit - batch_units >= FIRST_IMPERIAL;
    const double scale = unit->millimeters > 0 ? unit->millimeters / (is_imperial ? 25.4 : 10) : 1;
    const char *symbol = unit->millimeters == 0 ? "units" : is_imperial ? "in" : "cm";
    if (!cJSON_HasObjectItem(line, "area")) {
        return;
    }
    if (is_false(line, "closed")) {
        fprintf(page, "<br><span class=\"bad\">&#9888; not closed</span>, %.0f open edges",
                batch_number(line, "open_edges"));
    } else if (is_false(line, "solid")) {
        fputs("<br><span class=\"bad\">&#9888; not solid</span>", page);
    } else if (batch_number(line, "volume") < 0) {
        fputs("<br><span class=\"bad\">&#9888; inside out</span>", page);
    } else {
        fprintf(page, "<br>%.4g %s&sup3;", batch_number(line, "volume") * scale * scale * scale,
                symbol);
    }
    fprintf(page, " &middot; %.4g %s&sup2;", batch_number(line, "area") * scale * scale, symbol);
}

static void put_size(FILE *page, const cJSON *size, const batch_unit *unit) {
    const char *separator = "";
    const cJSON *side;
    cJSON_ArrayForEach(side, size) {
        fprintf(page, "%s%.4g", separator, cJSON_IsNumber(side) ? side->valuedouble : 0);
        separator = " &times; ";
    }
    fprintf(page, " %s", unit->symbol);
}

/* The colours of filaments, and a line per plate that has something. */
static void put_contents(FILE *page, const cJSON *line, const batch_unit *unit) {
    const cJSON *filament, *plate;
    const char *separator = "<br>";
    cJSON_ArrayForEach(filament, cJSON_GetObjectItemCaseSensitive(line, "filaments")) {
        const char *color = cJSON_IsString(filament) ? filament->valuestring : "";
        if (strspn(color, "#0123456789ABCDEF") == 7) {
            fprintf(page, "%s<i title=\"%.7s\" style=\"background:%.7s\"></i>", separator, color,
                    color);
            separator = "";
        }
    }
    cJSON_ArrayForEach(plate, cJSON_GetObjectItemCaseSensitive(line, "plates")) {
        const cJSON *size = cJSON_GetObjectItemCaseSensitive(plate, "size");
        if (cJSON_IsArray(size)) {
            fprintf(page, "<br>Plate %.0f%s", batch_number(plate, "number"),
                    *batch_text(plate, "name") ? ", " : "");
            put_text(page, batch_text(plate, "name"));
            fputs(": ", page);
            put_size(page, size, unit);
        }
    }
}

static void put_facts(FILE *page, const batch *b, const cJSON *line) {
    const double triangles = batch_number(line, "triangles");
    fputs("<p>", page);
    put_count(page, triangles);
    fputs(triangles == 1 ? " triangle" : " triangles", page);
    if (*batch_text(line, "format")) {
        fputs(" &middot; ", page);
        put_text(page, batch_text(line, "format"));
    }
    fputs("<br>", page);
    const batch_unit *unit = unit_of(b, line);
    put_size(page, cJSON_GetObjectItemCaseSensitive(line, "size"), unit);
    put_measured(page, line, unit);
    put_contents(page, line, unit);
    fputs("</p>\n", page);
    const cJSON *warnings = cJSON_GetObjectItemCaseSensitive(line, "warnings");
    if (cJSON_GetArraySize(warnings) > 0) {
        const cJSON *first = cJSON_GetArrayItem(warnings, 0);
        const char *text = cJSON_IsString(first) ? first->valuestring : "";
        fputs("<p class=\"warning\" title=\"", page);
        put_text(page, text);
        fputs("\">&#9888; ", page);
        put_count(page, cJSON_GetArraySize(warnings));
        fputs(cJSON_GetArraySize(warnings) == 1 ? " warning</p>\n" : " warnings</p>\n", page);
    }
}

/* What the page calls an item: its input below the folder that was named. */
static const char *shown_name(const batch_item *item) {
    return *item->input == ':' ? item->input : item->input + item->tree;
}

static const char *in_folder(const batch *b, const batch_item *item) {
    const char *folder = b->settings->output_dir;
    const size_t length = strcmp(folder, ".") == 0 ? 0 : strlen(folder);
    const char *path = item->output + length;
    return length > 0 && *path == '/' ? path + 1 : path;
}

static void put_card(FILE *page, const batch *b, const batch_item *item, const cJSON *line) {
    const double width = batch_number(line, "width"), height = batch_number(line, "height");
    const double scale = unit_of(b, line)->millimeters > 0 ? unit_of(b, line)->millimeters : 1;
    const cJSON *warnings = cJSON_GetObjectItemCaseSensitive(line, "warnings");
    fprintf(page,
            "<article data-triangles=\"%.0f\" data-bytes=\"%.0f\" data-volume=\"%.9g\" "
            "data-area=\"%.9g\" data-defects=\"%d\"><a href=\"",
            batch_number(line, "triangles"), batch_number(line, "bytes"),
            batch_number(line, "volume") * scale * scale * scale,
            batch_number(line, "area") * scale * scale,
            2 * is_false(line, "solid") + (cJSON_GetArraySize(warnings) > 0));
    put_link(page, in_folder(b, item));
    fputs("\"><img loading=\"lazy\" decoding=\"async\" src=\"", page);
    put_link(page, in_folder(b, item));
    fprintf(page, "\" width=\"%.0f\" height=\"%.0f\" alt=\"", width, height);
    put_text(page, shown_name(item));
    fputs("\"></a>\n<h2>", page);
    put_text(page, shown_name(item));
    if (item->view >= 0) {
        put_text(page, ", ");
        put_text(page, batch_view_name(b, item));
    }
    fputs("</h2>\n", page);
    put_facts(page, b, line);
    fputs("</article>\n", page);
}

static void put_failures(FILE *page, const batch *b) {
    fprintf(page, "<section id=\"failed\"><h2>%zu failed</h2><ul>\n", b->failed);
    for (size_t i = 0; i < b->list.count; ++i) {
        const batch_item *item = &b->list.items[i];
        cJSON *line = item->has_failed && item->line ? cJSON_Parse(item->line) : NULL;
        if (line) {
            fputs("<li>", page);
            put_text(page, batch_text(line, "error"));
            fputs("</li>\n", page);
        }
        cJSON_Delete(line);
    }
    fputs("</ul></section>\n", page);
}

static void put_title(FILE *page, const batch *b) {
    const char *name =
        b->settings->title ? b->settings->title : cli_base_name(b->settings->output_dir);
    put_text(page, strcmp(name, ".") == 0 || strcmp(name, "..") == 0 || !*name ? "Models" : name);
}

static const char beginning[] = "<!doctype html>\n<html lang=\"en\">\n"
                                "<meta name=\"generator\" content=\"burnish\">\n";

static void put_page(FILE *page, const batch *b) {
    fprintf(page, "%s<title>", beginning);
    put_title(page, b);
    fprintf(page, "</title>\n%s<header><h1>", head);
    put_title(page, b);
    fputs("</h1><span id=\"count\"></span>", page);
    if (b->failed > 0) {
        fprintf(page, "<a class=\"bad\" href=\"#failed\">%zu failed</a>", b->failed);
    }
    fputs("\n<div id=\"tools\">"
          "<input id=\"find\" type=\"search\" placeholder=\"Search\" aria-label=\"Search\" "
          "autocomplete=\"off\">\n<select id=\"order\" aria-label=\"Order\"><option value=\"\">By "
          "name</option><option value=\"triangles\">Most triangles</option><option "
          "value=\"bytes\">Largest file</option>",
          page);
    if (b->settings->render.input.measure) {
        fputs("<option value=\"volume\">Largest volume</option><option value=\"area\">Largest "
              "area</option><option value=\"defects\">Defects first</option>",
              page);
    }
    fputs("</select></div></header>\n<main>\n", page);
    for (size_t i = 0; i < b->list.count; ++i) {
        const batch_item *item = &b->list.items[i];
        cJSON *line = !item->has_failed && item->line ? cJSON_Parse(item->line) : NULL;
        if (line) {
            put_card(page, b, item, line);
        }
        cJSON_Delete(line);
    }
    fputs("</main>\n<p id=\"none\">No model has that.</p>\n", page);
    if (b->failed > 0) {
        put_failures(page, b);
    }
    fprintf(page, "%s</html>\n", script);
}

/* The name of the page, to be freed, or NULL. */
static char *index_path(const batch *b) {
    return cli_join_path(b->settings->output_dir, "index.html");
}

/* Whether the file has the beginning of a page, or is empty or none. */
static int is_own_page(const char *path) {
    char bytes[sizeof beginning - 1];
    FILE *file = fopen(path, "rb");
    const size_t size = file ? fread(bytes, 1, sizeof bytes, file) : 0;
    if (file) {
        fclose(file);
    }
    return size == 0 || (size == sizeof bytes && memcmp(bytes, beginning, size) == 0);
}

burnish_status batch_check_index(const batch *b, burnish_error *error) {
    char *path = index_path(b);
    burnish_status status = BURNISH_STATUS_OK;
    if (!path) {
        status = cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the page");
    } else if (b->report && strcmp(path, b->report) == 0) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--report: \"%.200s\" is the page of --index; name another file", path);
    } else if (!b->settings->render.output.overwrite && !is_own_page(path)) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--index: \"%.200s\" exists and was not written by burnish; replace it "
                          "with --overwrite, or name another --output-dir",
                          path);
    }
    free(path);
    return status;
}

burnish_status batch_write_index(const batch *b, burnish_error *error) {
    char *path = index_path(b), *text = NULL;
    size_t size = 0;
    FILE *page = path ? cli_open_memory(&text, &size) : NULL;
    burnish_status status = BURNISH_STATUS_OK;
    if (page) {
        put_page(page, b);
    }
    if (!page || cli_close_memory(page, &text, &size) != 0) {
        status = cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the page");
    } else {
        status = cli_file_write(path, text, size, error);
    }
    free(text);
    free(path);
    return status;
}
