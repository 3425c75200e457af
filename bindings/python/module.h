/* Declarations of the extension. It uses the stable interface of Python 3.9. */
#ifndef PYTHON_MODULE_H
#define PYTHON_MODULE_H

#define PY_SSIZE_T_CLEAN
#define Py_LIMITED_API 0x03090000
#include <Python.h>

#include "burnish/core.h"
#include "session.h"

/* Buffers belong to the stable interface from 3.11 on, as they have been since 3.3: Python 3.9 and
 * 3.10, which no longer change, have the same layout, functions and slot. */
typedef struct buffer_view {
    void *buf;
    PyObject *obj;
    Py_ssize_t len, itemsize;
    int readonly, ndim;
    char *format;
    Py_ssize_t *shape, *strides, *suboffsets;
    void *internal;
} buffer_view;
enum {
    PyBUF_SIMPLE = 0,
    PyBUF_WRITABLE = 1,
    PyBUF_FORMAT = 4,
    PyBUF_ND = 8,
    PyBUF_STRIDES = 0x10 | PyBUF_ND,
    PyBUF_F_CONTIGUOUS = 0x40 | PyBUF_STRIDES,
    PyBUF_RECORDS_RO = PyBUF_STRIDES | PyBUF_FORMAT,
    PyBUF_SLOT = 1 /* Py_bf_getbuffer */
};
PyAPI_FUNC(int) PyObject_GetBuffer(PyObject *exporter, buffer_view *view, int flags);
PyAPI_FUNC(void) PyBuffer_Release(buffer_view *view);

/* burnish.Error, errors that are derived from it, and heap types. */
#define MODULE_CLASSES(X)                                                                          \
    X(error, Error)                                                                                \
    X(argument_error, ArgumentError)                                                               \
    X(file_error, FileError)                                                                       \
    X(missing_file_error, MissingFileError)                                                        \
    X(array_type, Array) X(image_type, Image) X(mesh_type, Mesh)

typedef struct module_state {
#define MODULE_MEMBER(member, name) PyObject *member;
    MODULE_CLASSES(MODULE_MEMBER)
    burnish_context *context; /* cancels calls when Python has a signal */
} module_state;

/* Raises burnish.Error or a class derived from it, with its status, unless a signal handler has
 * raised an exception. Returns NULL. */
PyObject *module_fail(const module_state *state, const burnish_error *error);

/* A zeroed instance of a heap type, and the end of its tp_dealloc. */
void *module_allocate(PyObject *type);
void module_free(PyObject *object);

/* The tp_new of types whose instances only functions create. Raises TypeError. */
PyObject *module_refuse(PyTypeObject *type, PyObject *arguments, PyObject *keywords);

/* The object with one more reference, which the caller owns; NULL for NULL. */
PyObject *module_share(PyObject *object);

/* The types, which belong to the module. NULL after an exception. */
PyObject *array_create_type(PyObject *module);
PyObject *image_create_type(PyObject *module);
PyObject *mesh_create_type(PyObject *module);

/* The state of the module that an instance's type, or a base of it, belongs to. */
module_state *module_state_of(PyTypeObject *type);

/* ---- Arrays ---- */

#define ARRAY_DIMENSIONS 3

/* Memory as a buffer: packed items in C order. */
typedef struct array_layout {
    const void *items;
    const char *format; /* of the struct module, one item */
    Py_ssize_t item_size;
    int dimensions;
    Py_ssize_t shape[ARRAY_DIMENSIONS];
} array_layout;

/* Fills a read-only view. Its shape and strides point into *layout and *strides, which live as long
 * as the exporter. Returns 0, or -1 after BufferError. */
int array_fill_view(PyObject *exporter, const array_layout *layout,
                    Py_ssize_t strides[ARRAY_DIMENSIONS], buffer_view *view, int flags);

/* A memoryview of items that belong to `owner`; if owner is NULL, it takes ownership of them. */
PyObject *array_memoryview(const module_state *state, PyObject *owner, const array_layout *layout);

/* An object's numbers in the library's layout: in place if possible, else copied. */
typedef struct array_input {
    buffer_view view;
    int has_view;
    void *copy;
    burnish_array array;
    int index_size; /* of indices */
} array_input;

/* Each takes a buffer of one dimension (items one after another), two, or three, and returns 1, or
 * 0 after an exception; None gives an empty array. Release each array, also after an exception.
 *   floats   any numbers, `components` per item
 *   indices  any integers, three or more per face: polygons become fans
 *   colors   3 or 4 per vertex: integers in [0, 255], or floats in [0, 1] */
int array_read_floats(PyObject *object, const char *name, int components, array_input *input);
int array_read_indices(PyObject *object, const char *name, array_input *input);
int array_read_colors(PyObject *object, const char *name, array_input *input);
void array_release(array_input *input);

/* ---- Images ---- */

/* Creates an Image from the session's picture and its facts. */
PyObject *image_take(const module_state *state, session *s);

/* Creates an Image from a copy of its pixels and its other properties: image(pixels, (height, width,
 * channels), covered_pixels, camera, planes, warnings). */
PyObject *image_restore(PyObject *module, PyObject *arguments);

/* The warnings of a session as a tuple of texts. */
PyObject *image_warnings(const session *s);

/* ---- Functions of the module ---- */

PyObject *mesh_load(PyObject *module, PyObject *arguments);
PyObject *mesh_build(PyObject *module, PyObject *arguments);
PyObject *mesh_check(PyObject *module, PyObject *arguments);
PyObject *mesh_flags(PyObject *module, PyObject *unused);
PyObject *lobe_values(PyObject *module, PyObject *arguments);
PyObject *lobe_exact(PyObject *module, PyObject *arguments);
PyObject *lobe_row(PyObject *module, PyObject *arguments);
PyObject *lobe_choose(PyObject *module, PyObject *arguments);
PyObject *lobe_words(PyObject *module, PyObject *unused);

#endif
