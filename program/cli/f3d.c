/* The options of f3d 1 to 4, and what burnish does for each. Options with the same meaning and value
 * are other names of flags (cli_flag.also). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/cli/platform.h"
#include "base/cli/run.h"
#include "base/cli/values.h"
#include "cli/main.h"

enum { VALUE, SWITCH };

typedef struct option {
    const char *names, *letters; /* names: between commas */
    int is_switch;               /* its value is optional, and follows after = */
    const char
        *on; /* %s: the value; +NAME: of --annotate; "": burnish does so anyway; NULL: can't */
    const char *off; /* of a switch; or the value with which the option does nothing */
} option;

static const option options[] = {
    {"input", "", VALUE, "%s", NULL},
    {"max-size", "", VALUE, "--max-input-bytes=%sM", "-1"},
    {"config", "", VALUE, "--no-background", NULL},
    {"anti-aliasing-mode,force-reader,load-plugins,plugins-path,rendering-backend", "", VALUE, "",
     ""},
    {"camera-index", "", VALUE, "--camera=%s", "-1"},
    {"animation-index,animation-indices", "", VALUE, "--animation=%s", "-1"},
    {"backface-type", "", VALUE, "--cull-back-faces", "visible"},
    {"no-background", "", SWITCH, "--no-background", ""},
    {"blending,depth-peeling,dry-run,no-config,translucency-support", "p", SWITCH, "", ""},
    {"hdri-ambient", "f", SWITCH, "", ""},
    {"no-render", "", SWITCH, "", ""},
    {"geometry-only", "", SWITCH, "--no-colors", ""},
    {"verbose", "", SWITCH, "--timing", ""},
    {"recursive-dir-add", "", SWITCH, "--recursive", ""},
    {"axis", "x", SWITCH, "+axes", ""},
    {"grid", "g", SWITCH, "+grid", ""},
    {"axes-grid", "", SWITCH, "+dimensions", ""},
    {"edges", "e", SWITCH, "--wireframe", ""},
    {"hdri-skybox", "j", SWITCH, "--background-color=environment", ""},
    {"coloring-scalar-bar,bar", "b", SWITCH, "", "--no-legend"},
    {"camera-orthographic", "", SWITCH, "--camera-orthographic=yes", "--camera-orthographic=no"},
    {"ambient-occlusion,ssao", "q", SWITCH, "", "--occlusion=none"},
    {"anti-aliasing,fxaa", "a", SWITCH, "", "--samples=1"},
    {"tone-mapping", "t", SWITCH, "--tone-mapping=neutral", "--tone-mapping=none"},
    {"animation-autoplay,animation-progress,armature,blur-background,cells,checkerboard,"
     "coloring-by-cells,coloring-component,comp,denoise,display-depth,dpi-aware,filename,fps,"
     "fullscreen,grid-absolute,hdri-filename,interaction-style,inverse,invert-zoom,"
     "loading-progress,metadata,normal-glyphs,notifications,point-sprites,"
     "point-sprites-absolute-size,progress,raytracing-denoise,remove-empty-file-groups,"
     "scalar-coloring,scalars,scene-hierarchy,trackball,unlit,volume,volume-inverse,watch",
     "cdikmnorsuvyz", SWITCH, NULL, ""},
    {"animation-speed-factor,backdrop-color,backdrop-opacity,base-ior,blur-coc,colormap,"
     "colormap-discretization,command-script,define,emissive-factor,final-shader,font-color,"
     "font-file,font-scale,frame-rate,grid-color,grid-reflection,grid-subdivisions,grid-unit,"
     "interaction-test-play,interaction-test-record,light-intensity,load-statefile,metallic,"
     "multi-file-mode,multi-file-regex,normal-glyphs-scale,normal-scale,point-sprites-size,"
     "position,raytracing-samples,ref-threshold,reset,roughness,save-statefile,screenshot-filename,"
     "statefile-filename,texture-base-color,texture-emissive,texture-matcap,texture-material,"
     "texture-normal,textures-transform,volume-opacity-file,volume-opacity-map,x-color,y-color,"
     "z-color",
     "DR", VALUE, NULL, NULL},
};

/* f3d --list-readers: programs send files of these types. */
static const char readers[] = "Name  Exts  Mime-types\n"
                              "glTF  gltf  model/gltf+json\nglTF  glb   model/gltf-binary\n"
                              "OBJ   obj   model/obj\nOFF   off   application/vnd.off\n"
                              "PLY   ply   application/vnd.ply\nSTL   stl   model/stl\n"
                              "3MF   3mf   model/3mf\n";

/* The translation of a command line, until the program ends. */
static struct {
    char **words, *text; /* text: the rest of the storage for new words */
    int count, is_f3d, is_quiet, is_question, has_output, has_image;
    const char *input; /* under f3d's name: the first operand, as f3d draws no other */
    char notes[40];    /* --annotate=axes,grid,dimensions */
} line;

int f3d_is_name(const char *program) {
    const char *base = cli_base_name(program);
    return strcasecmp(base, "f3d") == 0 || strcasecmp(base, "f3d.exe") == 0;
}

static void put(const char *word) {
    line.words[line.count++] = (char *)(uintptr_t)word;
}

static void put_operand(const char *word) {
    if (!line.is_f3d) {
        put(word);
    } else if (!line.input) {
        line.input = word;
    }
}

/* The row of a name of this length; or, with length 0, of a letter. */
static const option *find(const char *name, size_t length) {
    for (const option *row = options; row < options + sizeof options / sizeof *options; ++row) {
        for (const char *item = row->names; item && length; item = strchr(item, ',')) {
            item += *item == ',';
            if (strcspn(item, ",") == length && memcmp(item, name, length) == 0) {
                return row;
            }
        }
        if (length == 0 && strchr(row->letters, *name)) {
            return row;
        }
    }
    return NULL;
}

/* Whether a value is one of these words, each between blanks. */
static int is_one_of(const char *value, const char *words) {
    char word[16];
    snprintf(word, sizeof word, " %s ", value);
    return strstr(words, word) != NULL;
}

/* The word of burnish for an option with this value, or without one; NULL: there is none. */
static const char *choose(const option *row, const char *value) {
    if (!row->is_switch) {
        const int is_other_file = strcmp(row->names, "config") == 0 && !strstr(value, "thumbnail");
        return is_other_file || (row->off && strcmp(value, row->off) == 0) ? "" : row->on;
    }
    if (value && strcmp(row->names, "verbose") == 0 && strcmp(value, "debug") != 0) {
        return is_one_of(value, " quiet error ") ? "--quiet" : "";
    }
    const int is_on = !value || !is_one_of(value, " 0 false no off none ");
    if (is_on && strcmp(row->letters, "j") == 0 && !line.has_image) {
        return NULL;
    }
    line.is_question |= is_on && strcmp(row->names, "no-render") == 0;
    return is_on ? row->on : row->off;
}

/* Writes the words for an option: its name or letter of this length, and its value or NULL. */
static void take(const option *row, const char *name, size_t length, const char *value) {
    const char *word = choose(row, value), *place = word ? strstr(word, "%s") : NULL;
    if (!word && !line.is_quiet) {
        char text[120];
        snprintf(text, sizeof text, "%s%.*s: no effect: burnish has nothing like it",
                 length > 1 ? "--" : "-", (int)length, name);
        cli_warn(text);
    } else if (word && *word == '+' && !strstr(line.notes, word + 1)) {
        strcat(strcat(line.notes, *line.notes ? "," : "--annotate="), word + 1);
    } else if (place == word && word) {
        put_operand(value);
    } else if (place) {
        put(line.text);
        line.text +=
            1 + sprintf(line.text, "%.*s%s%s", (int)(place - word), word, value, place + 2);
    } else if (word && *word && *word != '+') {
        put(word);
    }
}

/* Reads a long option. Returns the number of words, 2 if the next one is its value. */
static int take_long(const char *word, const char *next) {
    const char *name = word + 2, *equals = strchr(name, '=');
    const size_t length = strcspn(name, "=");
    const cli_flag *own = cli_find_flag(&render_command, name, length);
    const option *row = find(name, length);
    const int is_set = equals && row && row->is_switch &&
                       (!own || !own->value ||
                        (own->handler != cli_flag_integer &&
                         is_one_of(equals + 1, " 0 false no off 1 true yes on ")));
    if ((!line.is_f3d && ((own && !is_set) || strcmp(name, "no-render") == 0)) ||
        strncmp(name, "scalars=", 8) == 0) { /* whose name is optional in f3d */
        row = NULL;
    }
    const int has_value = row ? !row->is_switch : own && own->value && !own->optional;
    const int has_next = has_value && !equals && next;
    line.has_output |= own && strcmp(own->name, "output") == 0;
    if (row && (!has_value || equals || next)) {
        take(row, name, length, equals ? equals + 1 : has_next ? next : NULL);
    } else {
        put(word);
        line.words[line.count] = (char *)(uintptr_t)next;
        line.count += has_next;
    }
    return 1 + has_next;
}

/* Reads a group of f3d's letters, such as -tuqap, or -Dname=value. */
static int take_letters(const char *word) {
    const option *row = NULL;
    for (const char *letter = word + 1; *letter && (!row || row->is_switch); ++letter) {
        row = find(letter, 0);
        if (!row) {
            put(word); /* for the parser's message */
            return 1;
        }
        take(row, letter, 1, row->is_switch ? NULL : letter);
    }
    return row->is_switch || word[2] ? 1 : 2;
}

static void take_words(int argc, char **argv, int i) {
    while (i < argc && strcmp(argv[i], "--") != 0) {
        if (strncmp(argv[i], "--", 2) == 0) {
            i += take_long(argv[i], argv[i + 1]);
        } else if (line.is_f3d && argv[i][0] == '-' && argv[i][1]) {
            i += take_letters(argv[i]);
        } else {
            put_operand(argv[i++]);
        }
    }
    if (*line.notes) {
        put(line.notes);
    }
    for (i += line.is_f3d; i < argc; ++i) {
        put_operand(argv[i]);
    }
}

int f3d_refuse_window(const char *name) {
    burnish_error error;
    return cli_exit_code(cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                                  "%s: burnish has no window; draw a picture by \"burnish INPUT -o "
                                  "OUTPUT\", or use a viewer such as f3d",
                                  name),
                         &error);
}

char **f3d_translate(int *argc, char **argv, int first) {
    size_t size = 0;
    burnish_error error;
    line.is_f3d = f3d_is_name(argv[0]);
    for (int i = 0; i < *argc; ++i) {
        size += strlen(argv[i]) + 32; /* each letter can give a word, each value a longer one */
        line.is_quiet |= strcmp(argv[i], "--quiet") == 0 || strcmp(argv[i], "--verbose=quiet") == 0;
        line.is_quiet |= strcmp(argv[i], "-q") == 0 && !line.is_f3d;
        line.has_image |= strncmp(argv[i], "--hdri-file", 11) == 0;
        const int is_version = line.is_f3d && strcmp(argv[i], "--version") == 0;
        if (is_version || strcmp(argv[i], "--list-readers") == 0 ||
            strcmp(argv[i], "--readers-list") == 0) {
            fputs(is_version ? "burnish, which reads f3d's options\nVersion: 3.5.0\n" : readers,
                  stdout);
            *argc = cli_exit_code(cli_finish_output(&error), &error);
            return NULL;
        }
    }
    line.words = calloc(size, sizeof *line.words);
    line.text = malloc(size);
    if (!line.words || !line.text) {
        cli_fail(&error, BURNISH_STATUS_MEMORY, "out of memory for the command line");
        *argc = cli_exit_code(error.status, &error);
        return NULL;
    }
    memcpy(line.words, argv, (size_t)first * sizeof *argv);
    line.count = first;
    if (line.is_f3d) { /* the size is f3d's */
        put("render");
        put("--output-format=png");
        put("--resolution=1000,600");
    }
    take_words(*argc, argv, first);
    if (line.input && line.is_question) {
        line.count = first;
        put("info");
        put("--scene-box");
    } else if (line.input && !line.has_output) {
        *argc = f3d_refuse_window("f3d");
        return NULL;
    }
    if (line.input) {
        put("--");
        put(line.input);
    }
    line.words[line.count] = NULL;
    *argc = line.is_question && !line.input ? 0 : line.count;
    return *argc ? line.words : NULL;
}
