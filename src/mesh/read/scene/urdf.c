/* Robots in URDF: the visible meshes and shapes of links, where their joints put them. */
#include "mesh/read/scene/urdf.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/elementary.h"
#include "base/numbers.h"
#include "base/show_text.h"
#include "mesh/read/common/parts.h"

enum { LOOKED_AT = 4096, FOLDERS_MOST = 16, LISTED = 240 };

static int urdf_recognise(const uint8_t *bytes, size_t size) {
    static const char tag[] = "<robot";
    const size_t looked = size < LOOKED_AT ? size : LOOKED_AT;
    size_t i = size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    while (i < looked && (bytes[i] == ' ' || (bytes[i] >= '\t' && bytes[i] <= '\r'))) {
        ++i;
    }
    const int is_xml = i < looked && bytes[i] == '<';
    for (; is_xml && i + sizeof tag <= looked; ++i) {
        if (memcmp(bytes + i, tag, sizeof tag - 1) == 0 && bytes[i + sizeof tag - 1] <= ' ') {
            return 2;
        }
    }
    return 0;
}

int burnish_urdf_fail(burnish_urdf *urdf, burnish_status status, uint32_t line, const char *format,
                      ...) {
    char text[280], place[24] = "";
    if (urdf->status == BURNISH_STATUS_OK) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(text, sizeof text, format, arguments);
        va_end(arguments);
        if (line > 0) {
            snprintf(place, sizeof place, "line %u: ", line);
        }
        urdf->status = burnish_reader_fail(urdf->scene.reader, status, NULL, "%s%s", place, text);
    }
    return 0;
}

/* ---- Joints ---- */

static int find_link(const burnish_urdf *urdf, const char *name) {
    for (size_t i = 0; i < urdf->link_count; ++i) {
        if (strcmp(urdf->links[i].name, name) == 0) {
            return (int)i;
        }
    }
    return BURNISH_URDF_NONE;
}

static burnish_urdf_joint *find_joint(const burnish_urdf *urdf, const char *name) {
    for (size_t i = 0; i < urdf->joint_count; ++i) {
        if (strcmp(urdf->joints[i].name, name) == 0) {
            return &urdf->joints[i];
        }
    }
    return NULL;
}

static int fail_joint(burnish_urdf *urdf, const char *name) {
    char list[LISTED] = "";
    size_t used = 0, moving = 0, listed = 0;
    for (size_t i = 0; i < urdf->joint_count; ++i) {
        const burnish_urdf_joint *joint = &urdf->joints[i];
        moving += joint->kind != BURNISH_URDF_FIXED;
        if (joint->kind != BURNISH_URDF_FIXED && used + strlen(joint->name) + 3 < sizeof list) {
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "",
                                     burnish_show_name(joint->name).text);
            ++listed;
        }
    }
    return burnish_urdf_fail(
        urdf, BURNISH_STATUS_ARGUMENT, 0, "no moving joint is named \"%.60s\"; %s%s%s", name,
        moving > 0 ? "the joints are " : "the robot has none", list, listed < moving ? " ..." : "");
}

/* Sets the value of a joint after those that it follows. */
static int follow(burnish_urdf *urdf, burnish_urdf_joint *joint) {
    burnish_urdf_joint *chain[BURNISH_URDF_MOST];
    size_t count = 0;
    for (burnish_urdf_joint *at = joint; at && !at->has_value; at = at->followed) {
        if (count == urdf->joint_count) {
            return burnish_urdf_fail(urdf, BURNISH_STATUS_FORMAT, joint->line,
                                     "joints that mimic each other; repair the file");
        }
        chain[count++] = at;
    }
    while (count > 0) {
        burnish_urdf_joint *next = chain[--count];
        next->value = *next->mimic ? next->offset : 0;
        next->value += next->followed ? next->multiplier * next->followed->value : 0;
        next->has_value = 1;
    }
    return 1;
}

/* Moves a joint as far as its limits allow. */
static void set_value(burnish_urdf *urdf, burnish_urdf_joint *joint, double value) {
    joint->value = value;
    joint->has_value = 1;
    if (joint->low < joint->high && !(value >= joint->low && value <= joint->high)) {
        joint->value = value < joint->low ? joint->low : joint->high;
        burnish_reader_warn(urdf->scene.reader, NULL,
                            "joint \"%.60s\" is at its limit, %g, instead of %g; it moves from %g "
                            "to %g",
                            burnish_show_name(joint->name).text, joint->value, value, joint->low,
                            joint->high);
    }
}

/* Sets the values of the options, and of joints that follow another. */
static int set_values(burnish_urdf *urdf) {
    const burnish_reader_input *input = urdf->scene.reader->input;
    const burnish_load_options *options = input->options;
    for (size_t i = 0; i < options->joint_count; ++i) {
        burnish_urdf_joint *joint = find_joint(urdf, options->joints[i].name);
        const int is_found = joint && joint->kind != BURNISH_URDF_FIXED;
        if (!is_found && !input->joint_found) {
            return fail_joint(urdf, options->joints[i].name);
        }
        if (is_found) {
            set_value(urdf, joint, options->joints[i].value);
        }
        if (is_found && input->joint_found) {
            input->joint_found[i] = 1;
        }
    }
    for (size_t i = 0; i < urdf->joint_count; ++i) {
        burnish_urdf_joint *joint = &urdf->joints[i];
        joint->followed = *joint->mimic ? find_joint(urdf, joint->mimic) : NULL;
    }
    int is_fine = 1;
    for (size_t i = 0; i < urdf->joint_count && is_fine; ++i) {
        is_fine = follow(urdf, &urdf->joints[i]);
    }
    return is_fine;
}

/* A joint's motion: a turn about its axis, or a move along it. */
static void find_motion(const burnish_urdf_joint *joint, double motion[12]) {
    static const double identity[12] = BURNISH_MATRIX_IDENTITY;
    const double *given = joint->axis;
    const double length =
        burnish_sqrt(given[0] * given[0] + given[1] * given[1] + given[2] * given[2]);
    double sine, cosine, axis[3];
    memcpy(motion, identity, sizeof identity);
    if (joint->kind == BURNISH_URDF_FIXED || !(length > 0)) {
        return;
    }
    burnish_sincos(joint->value, &sine, &cosine);
    for (int i = 0; i < 3; ++i) {
        axis[i] = given[i] / length;
    }
    for (int i = 0; i < 3; ++i) {
        if (joint->kind == BURNISH_URDF_SLIDES) {
            motion[4 * i + 3] = axis[i] * joint->value;
            continue;
        }
        const int next = (i + 1) % 3, last = (i + 2) % 3;
        motion[4 * i + i] = cosine + axis[i] * axis[i] * (1 - cosine);
        motion[4 * i + next] = axis[i] * axis[next] * (1 - cosine) - axis[last] * sine;
        motion[4 * i + last] = axis[i] * axis[last] * (1 - cosine) + axis[next] * sine;
    }
}

/* Places a link after those above it. */
static int place_link(burnish_urdf *urdf, int number) {
    static const double identity[12] = BURNISH_MATRIX_IDENTITY;
    int chain[BURNISH_URDF_MOST], count = 0;
    for (int at = number; !urdf->links[at].is_placed;) {
        const burnish_urdf_link *link = &urdf->links[at];
        if (count == (int)urdf->link_count) {
            return burnish_urdf_fail(urdf, BURNISH_STATUS_FORMAT, urdf->joints[link->parent].line,
                                     "its links form a loop; they must be a tree");
        }
        chain[count++] = at;
        if (link->parent == BURNISH_URDF_NONE) {
            break;
        }
        at = urdf->joints[link->parent].parent_link;
    }
    while (count > 0) {
        burnish_urdf_link *link = &urdf->links[chain[--count]];
        memcpy(link->transform, identity, sizeof identity);
        if (link->parent != BURNISH_URDF_NONE) {
            const burnish_urdf_joint *joint = &urdf->joints[link->parent];
            double motion[12];
            find_motion(joint, motion);
            burnish_matrix_multiply(urdf->links[joint->parent_link].transform, joint->origin,
                                    link->transform);
            burnish_matrix_multiply(link->transform, motion, link->transform);
        }
        link->is_placed = 1;
    }
    return 1;
}

static int place_links(burnish_urdf *urdf) {
    for (size_t i = 0; i < urdf->joint_count; ++i) {
        burnish_urdf_joint *joint = &urdf->joints[i];
        const int child = find_link(urdf, joint->child);
        joint->parent_link = find_link(urdf, joint->parent);
        if (child < 0 || joint->parent_link < 0) {
            return burnish_urdf_fail(urdf, BURNISH_STATUS_FORMAT, joint->line,
                                     "joint \"%.60s\" has no link \"%.60s\"; repair the file",
                                     joint->name, child < 0 ? joint->child : joint->parent);
        }
        if (urdf->links[child].parent != BURNISH_URDF_NONE) {
            return burnish_urdf_fail(urdf, BURNISH_STATUS_FORMAT, joint->line,
                                     "link \"%.60s\" has two parents; links must be a tree",
                                     joint->child);
        }
        urdf->links[child].parent = (int)i;
    }
    int is_fine = set_values(urdf);
    for (size_t i = 0; i < urdf->link_count && is_fine; ++i) {
        is_fine = place_link(urdf, (int)i);
    }
    return is_fine;
}

/* ---- Meshes ---- */

/* Names the root that could help: the package's folder if the input is in it, or the folder above
 * the input's. */
static burnish_status fail_package(const burnish_urdf *urdf, const char *name,
                                   burnish_error *error) {
    const char *input = urdf->scene.reader->input->name, *slash = strrchr(input, '/');
    const size_t size = strcspn(name, "/"), above = slash ? (size_t)(slash - input) + 1 : 0;
    size_t package = 0;
    for (const char *c = input; slash && c < slash; c += strcspn(c, "/") + 1) {
        if (strcspn(c, "/") == size && memcmp(c, name, size) == 0) {
            package = (size_t)(c - input) + size;
        }
    }
    return burnish_fail(error, BURNISH_STATUS_READ,
                        "%.120s: in no folder from the robot's up to the root; --root=%.*s%s may "
                        "help",
                        name, (int)(package ? package : above), input, package ? "" : "..");
}

/* Loads the file of a package, "package://NAME/PATH": in a folder NAME of the root, next to the
 * input or above it, or in one of these folders itself, which is the package then. */
static burnish_status load_of_package(burnish_urdf *urdf, const char *name,
                                      burnish_scene_source **source, burnish_error *error) {
    const char *folder = urdf->scene.reader->input->folder, *path = strchr(name, '/');
    int above = folder && *folder ? 1 : 0;
    burnish_status status = BURNISH_STATUS_READ;
    for (const char *c = folder; c && *c; ++c) {
        above += *c == '/';
    }
    for (int i = 0; i < 2 * (above + 1) && i / 2 < FOLDERS_MOST && status == BURNISH_STATUS_READ;
         ++i) {
        char tried[BURNISH_URDF_FILE + 3 * FOLDERS_MOST];
        snprintf(tried, sizeof tried, "%.*s%s", 3 * (i / 2),
                 "../../../../../../../../../../../../../../../../",
                 i % 2 == 0 || !path ? name : path + 1);
        status = burnish_scene_load(&urdf->scene, tried, source, error);
    }
    return status != BURNISH_STATUS_READ ? status : fail_package(urdf, name, error);
}

static burnish_status load_mesh(burnish_urdf *urdf, const char *file, burnish_scene_source **source,
                                burnish_error *error) {
    static const char *const schemes[] = {"package://", "model://"};
    char name[BURNISH_URDF_FILE];
    strcpy(name, strncmp(file, "file://", 7) == 0 ? file + 7 : file);
    for (char *c = name; *c; ++c) {
        *c = *c == '\\' ? '/' : *c;
    }
    for (size_t i = 0; i < sizeof schemes / sizeof *schemes; ++i) {
        const size_t size = strlen(schemes[i]);
        if (strncmp(name, schemes[i], size) == 0) {
            return load_of_package(urdf, name + size, source, error);
        }
    }
    return burnish_scene_load(&urdf->scene, name, source, error);
}

/* The colour of a material: its own, or that of the first one of its name. */
static const burnish_urdf_material *find_color(const burnish_urdf *urdf,
                                               const burnish_urdf_material *material) {
    for (size_t i = 0; i < urdf->material_count && !material->has_color && *material->name; ++i) {
        if (urdf->materials[i].has_color && strcmp(urdf->materials[i].name, material->name) == 0) {
            return &urdf->materials[i];
        }
    }
    return material->has_color ? material : NULL;
}

/* Whether a mesh states how it looks. */
static int has_own_colors(const burnish_mesh_data *mesh) {
    const burnish_material grey = burnish_material_default();
    int any = mesh->streams[BURNISH_COLOR].count > 0;
    for (size_t i = 0; i < mesh->material_count && !any; ++i) {
        any = memcmp(&mesh->materials[i], &grey, sizeof grey) != 0;
    }
    return any;
}

/* Adds a mesh or shape of a link. The colours of a mesh count more than those of the robot. */
static int add_visual(burnish_urdf *urdf, const burnish_urdf_visual *visual,
                      burnish_scene_source *source) {
    const burnish_urdf_link *link = &urdf->links[visual->link];
    const burnish_urdf_material *color = find_color(urdf, &visual->material);
    burnish_scene_item *item = burnish_scene_add(&urdf->scene, source);
    if (!item) {
        urdf->status = urdf->scene.reader->mesh->memory.status;
        return 0;
    }
    burnish_part_set_name(item->name, link->name, strlen(link->name));
    burnish_matrix_multiply(link->transform, visual->origin, item->transform);
    for (int i = 0; i < 12 && visual->shape == BURNISH_URDF_MESH; ++i) {
        item->transform[i] *= i % 4 < 3 ? visual->size[i % 4] : 1;
    }
    if (source->is_turned) { /* ROS takes the coordinates of the file */
        static const double back[12] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0};
        burnish_matrix_multiply(item->transform, back, item->transform);
    }
    if (color && !has_own_colors(&source->mesh)) {
        item->has_color = 1;
        memcpy(item->srgb, color->srgb, sizeof item->srgb);
    }
    return 1;
}

/* Adds what is visible, or the bodies of collisions. A mesh that can't be loaded is noted and left
 * out. */
static int add_visuals(burnish_urdf *urdf, burnish_warning_group *missing,
                       burnish_warning_group *broken) {
    burnish_reader *reader = urdf->scene.reader;
    int has_visuals = 0;
    for (size_t i = 0; i < urdf->visual_count; ++i) {
        has_visuals |= !urdf->visuals[i].is_collision;
    }
    for (size_t i = 0; i < urdf->visual_count; ++i) {
        const burnish_urdf_visual *visual = &urdf->visuals[i];
        if (has_visuals && visual->is_collision) {
            continue;
        }
        burnish_scene_source *source = NULL;
        burnish_error why = {0};
        burnish_status status = BURNISH_STATUS_OK;
        if (visual->shape == BURNISH_URDF_MESH) {
            status = load_mesh(urdf, visual->file, &source, &why);
        } else if (visual->shape != BURNISH_URDF_NOTHING) {
            source = burnish_urdf_make_shape(urdf, visual->shape, visual->size);
            status = source ? burnish_scene_count(&urdf->scene, &source->mesh)
                            : reader->mesh->memory.status;
        }
        if (status == BURNISH_STATUS_READ || status == BURNISH_STATUS_FORMAT) {
            burnish_reader_note(reader, status == BURNISH_STATUS_READ ? missing : broken, NULL,
                                "line %u: a mesh is left out: %s", visual->line, why.text);
        } else if (status != BURNISH_STATUS_OK) {
            urdf->status = *why.text ? burnish_fail(reader->error, status, "%s", why.text) : status;
            return 0;
        } else if (source && !add_visual(urdf, visual, source)) {
            return 0;
        }
    }
    return 1;
}

static void read_robot(burnish_urdf *urdf) {
    burnish_warning_group missing = {0}, broken = {0};
    if (!burnish_urdf_parse(urdf) || !place_links(urdf) || !add_visuals(urdf, &missing, &broken)) {
        return;
    }
    if (urdf->scene.item_count == 0) {
        const burnish_warning_group *why = missing.count > 0 ? &missing : &broken;
        urdf->status = why->count > 0
                           ? burnish_fail(urdf->scene.reader->error, BURNISH_STATUS_FORMAT, "%s",
                                          why->first.text)
                           : burnish_reader_fail(urdf->scene.reader, BURNISH_STATUS_FORMAT, NULL,
                                                 "a robot without anything visible");
        return;
    }
    burnish_reader_warn_group(urdf->scene.reader, &missing);
    burnish_reader_warn_group(urdf->scene.reader, &broken);
    urdf->status = burnish_scene_join(&urdf->scene);
}

static burnish_status urdf_read(burnish_reader *reader) {
    burnish_urdf urdf = {.scene = {.reader = reader, .is_robot = 1, .unit = "meter"}};
    const burnish_context *context = reader->mesh->memory.context;
    reader->mesh->up_axis[2] = 1;
    read_robot(&urdf);
    burnish_release(context, urdf.links);
    burnish_release(context, urdf.joints);
    burnish_release(context, urdf.visuals);
    burnish_release(context, urdf.materials);
    burnish_scene_close(&urdf.scene);
    return urdf.status;
}

const burnish_format_reader burnish_reader_urdf = {.recognise = urdf_recognise, .read = urdf_read};
