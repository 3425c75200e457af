/* Loads inputs: files, standard input and built-in objects, by the library or an importer. */
#ifndef TOOL_IMPORT_LOAD_H
#define TOOL_IMPORT_LOAD_H

#include "import/run.h"

/* Who reads an input: this process, or for a sandboxed one the process that started it.
 *   load    as burnish_mesh_load
 *   import  runs an importer; the stream is empty
 *   files   the files that an input names; NULL: they are opened in the input's folder
 *   folder  as in load options, for these files
 *   decode  decodes compressed streams; NULL: nobody does */
typedef struct import_source {
    burnish_status (*load)(const char *input, const burnish_load_options *options,
                           burnish_mesh **mesh, burnish_error *error);
    burnish_status (*import)(const import_program *importer, const char *extension,
                             const char *input, uint64_t max_bytes, import_stream *stream,
                             burnish_error *error);
    burnish_file_loader (*files)(const char *input);
    import_decode *decode;
    const char *folder;
} import_source;

/* Changes the source from files of this process to another one, which must outlive it. */
void import_set_source(const import_source *source);

/* Loads an input as burnish_mesh_load does, or through the importer that import_choose returns for
 * the name and options->format. */
burnish_status import_load(const char *input, const burnish_load_options *options,
                           burnish_mesh **mesh, burnish_error *error);

/* Loads as burnish_mesh_load_memory does, with importers for what the bytes hold or name. */
burnish_status import_load_memory(const void *bytes, size_t size, const char *name,
                                  const burnish_load_options *options, burnish_mesh **mesh,
                                  burnish_error *error);

/* Loads a scene (docs/formats.md), whose text is `items`, as if it were next to the file `input`. */
burnish_status import_load_items(const char *input, const char *items,
                                 const burnish_load_options *options, burnish_mesh **mesh,
                                 burnish_error *error);

/* Runs import_run on `path`, or on its open descriptor `held`; -1: none. Standard input is copied to
 * an unnamed file if it is not a file or was partly read: at most max_bytes and 1 GiB, since a
 * stream may be endless. Errors: also READ, LIMIT, MEMORY. */
burnish_status import_run_over(const import_program *importer, const char *extension,
                               const char *path, int held, uint64_t max_bytes, import_sink sink,
                               burnish_error *error);

#endif
