#include "mesh/read/archive.h"

#include <stdio.h>
#include <string.h>

#include "base/bytes.h"
#include "base/inputs.h"
#include "mesh/read/read.h"

typedef struct part_name {
    char text[BURNISH_ARCHIVE_NAME]; /* "": the part has no usable name */
} part_name;

static part_name name_of(const burnish_zip_part *part) {
    part_name name = {""};
    if (part->name_size < sizeof name.text && !memchr(part->name, 0, part->name_size)) {
        memcpy(name.text, part->name, part->name_size);
    }
    return name;
}

static int is_3mf(const burnish_zip *zip) {
    int found = 0;
    for (size_t i = 0; i < zip->count && !found; ++i) {
        found = burnish_archive_is_3mf(name_of(&zip->parts[i]).text);
    }
    return found;
}

/* ---- The model ---- */

/* The models that an input may be. */
typedef struct choice {
    burnish_archive_models models;
    const burnish_zip_part *part; /* the best one */
    size_t files;                 /* of all kinds */
    char list[240];               /* their names, or those of other files */
    size_t listed;
} choice;

static int is_wanted(const char *name, const char *member) {
    return !member || burnish_is_same_name(name, member) ||
           burnish_is_same_name(burnish_archive_base(name), member);
}

static void list_name(choice *found, const char *name) {
    const size_t used = strlen(found->list);
    const burnish_shown_name shown = burnish_show_name(name);
    if (used + strlen(shown.text) + 3 < sizeof found->list) {
        snprintf(found->list + used, sizeof found->list - used, "%s%s", used > 0 ? ", " : "",
                 shown.text);
        found->listed += 1;
    }
}

/* Formats of importers that downloads have; others must be asked for by name. */
static int is_common(const char *name) {
    char extension[BURNISH_EXTENSION_SIZE], word[BURNISH_EXTENSION_SIZE + 2];
    burnish_lower_extension(name, strlen(name), extension);
    snprintf(word, sizeof word, " %s ", extension);
    return strstr(" fbx dae 3ds step stp iges igs blend x3d wrl lwo ", word) != NULL;
}

/* The format of a file by its name; COUNT: an importer's, if one may be chosen. */
static int format_of(const char *name, const burnish_load_options *options, int may_import) {
    const burnish_format own = burnish_format_of_name(name);
    const int is_any = options->format == BURNISH_FORMAT_AUTO ||
                       options->format == BURNISH_FORMAT_3MF; /* what an archive seems to be */
    if (own == BURNISH_FORMAT_AUTO) {
        return is_any && may_import && options->decoder.decode ? BURNISH_FORMAT_COUNT : 0;
    }
    return is_any || own == options->format ? (int)own : 0;
}

/* imports: 1: of archives without a model of the library's own formats */
static choice find_models(const burnish_zip *zip, const burnish_load_options *options,
                          const char *member, int imports) {
    choice found = {.files = 0}, others = {.files = 0};
    for (size_t i = 0; i < zip->count; ++i) {
        const part_name name = name_of(&zip->parts[i]);
        if (burnish_archive_hides(name.text)) {
            continue;
        }
        others.files += 1;
        list_name(&others, name.text);
        const int may_import = member || (imports && is_common(name.text));
        const int format =
            is_wanted(name.text, member) ? format_of(name.text, options, may_import) : 0;
        const burnish_archive_vote vote = burnish_archive_take(&found.models, name.text, format);
        if (vote == BURNISH_ARCHIVE_BEST) {
            found.part = &zip->parts[i];
        }
        if (vote != BURNISH_ARCHIVE_OTHER && found.models.count == 1) {
            *found.list = 0;
            found.listed = 0;
        }
        if (vote != BURNISH_ARCHIVE_OTHER) {
            list_name(&found, name.text);
        }
    }
    return found.part ? found : imports || member ? others : find_models(zip, options, member, 1);
}

/* Fails unless the choice is clear. */
static burnish_status check_choice(burnish_archive *archive, const choice *found,
                                   const char *member) {
    const size_t count = found->models.count, total = count > 0 ? count : found->files;
    char more[40] = "";
    if (count > 0 && !found->models.are_several) {
        return BURNISH_STATUS_OK;
    }
    if (total > found->listed) {
        snprintf(more, sizeof more, " and %zu more", total - found->listed);
    }
    return burnish_reader_fail(
        &archive->reader, count > 1 || member ? BURNISH_STATUS_ARGUMENT : BURNISH_STATUS_FORMAT,
        NULL, "%s (%s%s); %s",
        count > 1 ? "an archive of several models"
        : member  ? "no model of this name is in the archive"
                  : "a ZIP archive without a model of a format that burnish reads in archives",
        found->list, more,
        count > 1 ? "name one, as in kit.zip:part.stl"
        : member  ? "name one"
                  : "name it, as in kit.zip:part.fbx, or unpack it");
}

/* ---- Its files ---- */

static burnish_status load_part(void *user_data, const char *name, uint64_t max_bytes,
                                const void **bytes, size_t *size, burnish_error *error) {
    burnish_archive *archive = user_data;
    const burnish_zip_part *part = burnish_zip_find(&archive->zip, name);
    uint8_t *unpacked;
    if (!part || part->size > max_bytes) {
        return burnish_fail(error, part ? BURNISH_STATUS_LIMIT : BURNISH_STATUS_READ, "%s: %s",
                            burnish_show_name(name).text,
                            part ? "is larger than the limit" : "is not in the archive");
    }
    archive->reader.error = error;
    const burnish_status status = burnish_zip_read(&archive->zip, part, &unpacked, size);
    *bytes = unpacked;
    return status;
}

static void release_part(void *user_data, const void *bytes, size_t size) {
    const burnish_archive *archive = user_data;
    (void)size;
    burnish_release(archive->reader.mesh->memory.context, (void *)(uintptr_t)bytes);
}

/* ---- Opening ---- */

/* Lets an importer make a mesh stream of a model of another format. */
static burnish_status import_model(burnish_archive *archive, burnish_reader_input *input) {
    const burnish_stream_decoder *decoder = &input->options->decoder;
    char extension[BURNISH_EXTENSION_SIZE];
    burnish_error why = {0};
    burnish_lower_extension(archive->name, strlen(archive->name), extension);
    const burnish_status status =
        decoder->decode(decoder->user_data, extension, archive->bytes, input->size,
                        &archive->stream, &archive->stream_size, &why);
    if (status != BURNISH_STATUS_OK) {
        return burnish_fail(archive->reader.error, status, "%s", why.text);
    }
    strcpy(archive->reader.mesh->imported, extension);
    input->bytes = archive->stream;
    input->size = archive->stream_size;
    return BURNISH_STATUS_OK;
}

/* Makes the part the input. */
static burnish_status take_model(burnish_archive *archive, const burnish_zip_part *part,
                                 burnish_reader_input *input) {
    burnish_memory *memory = &archive->reader.mesh->memory;
    const part_name name = name_of(part);
    const char *outer = archive->input.name, *member = burnish_archive_member(outer);
    const size_t size = member ? (size_t)(member - outer) - 1 : strlen(outer);
    const size_t most = sizeof archive->name - BURNISH_ARCHIVE_NAME - 1;
    const size_t skipped = size > most ? size - most : 0;
    snprintf(archive->name, sizeof archive->name, "%.*s:%s", (int)(size - skipped), outer + skipped,
             name.text);
    snprintf(archive->folder, sizeof archive->folder, "%.*s",
             (int)(burnish_archive_base(name.text) - name.text), name.text);
    burnish_status status = burnish_zip_read(&archive->zip, part, &archive->bytes, &input->size);
    input->bytes = archive->bytes;
    input->name = archive->name;
    input->folder = archive->folder;
    input->companions = (burnish_file_loader){load_part, release_part, archive};
    input->is_archived = 1;
    if (input->options->ignore_referenced_files) {
        input->companions = (burnish_file_loader){0};
    }
    if (status == BURNISH_STATUS_OK && burnish_format_of_name(name.text) == BURNISH_FORMAT_AUTO) {
        status = import_model(archive, input);
    } else if (status == BURNISH_STATUS_OK) {
        status = burnish_unpack_input(input, memory, &archive->text);
    }
    return status;
}

burnish_status burnish_archive_open(burnish_archive *archive, burnish_reader_input *input,
                                    burnish_mesh_data *data, burnish_error *error) {
    if (input->streamed || !burnish_reader_3mf.recognise(input->bytes, input->size) ||
        burnish_guess_format(input->bytes, input->size, input->name) != BURNISH_FORMAT_3MF) {
        return BURNISH_STATUS_OK;
    }
    archive->input = *input;
    archive->reader = (burnish_reader){.input = &archive->input, .mesh = data, .error = error};
    burnish_status status = burnish_zip_open(&archive->zip, &archive->reader);
    if (status == BURNISH_STATUS_OK && !is_3mf(&archive->zip)) {
        const char *member = burnish_archive_member(input->name);
        const choice found = find_models(&archive->zip, input->options, member, 0);
        status = check_choice(archive, &found, member);
        if (status == BURNISH_STATUS_OK && found.models.twins > 0) {
            burnish_reader_warn(&archive->reader, NULL,
                                "%zu files in the archive have one name (%s); the first is drawn",
                                found.models.twins + 1, found.list);
        }
        if (status == BURNISH_STATUS_OK) {
            status = take_model(archive, found.part, input);
        }
    }
    return status;
}

void burnish_archive_close(burnish_archive *archive) {
    const burnish_stream_decoder *decoder =
        archive->stream ? &archive->input.options->decoder : NULL;
    if (decoder && decoder->release) {
        decoder->release(decoder->user_data, archive->stream, archive->stream_size);
    }
    if (archive->reader.mesh) {
        burnish_release(archive->reader.mesh->memory.context, archive->bytes);
        burnish_release(archive->reader.mesh->memory.context, archive->text);
        burnish_zip_close(&archive->zip);
    }
}
