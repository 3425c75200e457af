/* Arrays of numbers by Python's buffer protocol. */
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "module.h"

/* ---- Exporting ---- */

typedef struct array_object {
    PyObject_HEAD PyObject *owner; /* of the items; NULL: this object owns them */
    void *items;
    array_layout layout;
    Py_ssize_t strides[ARRAY_DIMENSIONS];
} array_object;

int array_fill_view(PyObject *exporter, const array_layout *layout,
                    Py_ssize_t strides[ARRAY_DIMENSIONS], buffer_view *view, int flags) {
    Py_ssize_t size = layout->item_size;
    for (int i = layout->dimensions - 1; i >= 0; --i) {
        strides[i] = size;
        size *= layout->shape[i];
    }
    view->obj = NULL;
    if (flags & PyBUF_WRITABLE) {
        PyErr_SetString(PyExc_BufferError, "burnish's arrays are not to be written to; copy them");
        return -1;
    }
    if ((flags & PyBUF_F_CONTIGUOUS) == PyBUF_F_CONTIGUOUS && layout->dimensions > 1) {
        PyErr_SetString(PyExc_BufferError, "burnish's arrays are C-contiguous");
        return -1;
    }
    *view = (buffer_view){
        .buf = (void *)layout->items,
        .obj = module_share(exporter),
        .len = size,
        .itemsize = layout->item_size,
        .readonly = 1,
        .ndim = layout->dimensions,
        .format = flags & PyBUF_FORMAT ? (char *)layout->format : NULL,
        .shape = flags & PyBUF_ND ? (Py_ssize_t *)layout->shape : NULL,
        .strides = (flags & PyBUF_STRIDES) == PyBUF_STRIDES ? strides : NULL,
    };
    return 0;
}

static int get_buffer(PyObject *object, buffer_view *view, int flags) {
    array_object *self = (array_object *)object;
    return array_fill_view(object, &self->layout, self->strides, view, flags);
}

static void destroy(PyObject *object) {
    array_object *self = (array_object *)object;
    if (self->owner) {
        Py_DECREF(self->owner);
    } else {
        free(self->items);
    }
    module_free(object);
}

PyObject *array_memoryview(const module_state *state, PyObject *owner, const array_layout *layout) {
    array_object *self = module_allocate(state->array_type);
    if (!self) {
        if (!owner) {
            free((void *)layout->items);
        }
        return NULL;
    }
    self->owner = module_share(owner);
    self->items = (void *)layout->items;
    self->layout = *layout;
    PyObject *view = PyMemoryView_FromObject((PyObject *)self);
    Py_DECREF(self);
    return view;
}

PyObject *array_create_type(PyObject *module) {
    static PyType_Slot slots[] = {
        {Py_tp_new, module_refuse},
        {Py_tp_dealloc, destroy},
        {PyBUF_SLOT, get_buffer},
        {Py_tp_doc, "Numbers of burnish's."},
        {0},
    };
    static PyType_Spec spec = {"burnish._burnish.Array", sizeof(array_object), 0,
                               Py_TPFLAGS_DEFAULT, slots};
    return PyType_FromModuleAndSpec(module, &spec, NULL);
}

/* ---- Importing ---- */

/* An object's buffer as rows of numbers. */
typedef struct rows {
    const char *items;
    Py_ssize_t count, columns, stride, column_stride; /* strides in bytes */
    char kind;       /* 'f': floats, 'i': signed and 'u': unsigned integers */
    Py_ssize_t size; /* bytes of a number */
} rows;

static char kind_of(const char *format, Py_ssize_t size) {
    const uint16_t one = 1;
    const int is_little = *(const char *)&one;
    if (size != 1 && size != 2 && size != 4 && size != 8) {
        return 0;
    }
    if (!format) {
        return 'u';
    }
    if (strchr("@=<>!", *format)) {
        const int is_foreign =
            (*format == '<' && !is_little) || (strchr(">!", *format) && is_little && size > 1);
        if (*format++ == 0 || is_foreign) {
            return 0;
        }
    }
    if (format[0] == 0 || format[1] != 0) {
        return 0;
    }
    return strchr("fd", *format)        ? 'f'
           : strchr("bhilqn", *format)  ? 'i'
           : strchr("BHILQN?", *format) ? 'u'
                                        : 0;
}

/* The buffer's dimensions as rows. Returns 0 for others. */
static int shape_rows(const buffer_view *view, int columns, rows *r) {
    const Py_ssize_t *shape = view->shape, *strides = view->strides;
    if (view->ndim == 1 && shape[0] % columns == 0) {
        r->count = shape[0] / columns;
        r->columns = columns;
        r->column_stride = strides[0];
        r->stride = strides[0] * columns;
    } else if (view->ndim == 2) {
        r->count = shape[0];
        r->columns = shape[1];
        r->stride = strides[0];
        r->column_stride = strides[1];
    } else if (view->ndim == 3 && (shape[0] <= 1 || strides[0] == strides[1] * shape[1])) {
        r->count = shape[0] * shape[1]; /* such as three corners per triangle */
        r->columns = shape[2];
        r->stride = strides[1];
        r->column_stride = strides[2];
    } else {
        return 0;
    }
    return 1;
}

static int open_rows(PyObject *object, const char *name, int columns, array_input *input, rows *r) {
    if (PyObject_GetBuffer(object, &input->view, PyBUF_RECORDS_RO) != 0) {
        PyErr_Clear();
        PyErr_Format(PyExc_TypeError,
                     "%s: %R has no buffer of numbers; give an array, such as NumPy's", name,
                     (PyObject *)Py_TYPE(object));
        return 0;
    }
    const buffer_view *view = &input->view;
    input->has_view = 1;
    r->items = view->buf;
    r->size = view->itemsize;
    r->kind = kind_of(view->format, view->itemsize);
    if (r->kind == 0) {
        PyErr_Format(PyExc_TypeError,
                     "%s: items of format '%s'; give floats or integers in the machine's byte "
                     "order, or a NumPy array",
                     name, view->format);
        return 0;
    }
    if (view->ndim < 1 || view->ndim > 3 || !shape_rows(view, columns, r)) {
        PyErr_Format(PyExc_ValueError, "%s: %d dimensions; give an array of shape (N, %d)", name,
                     view->ndim, columns);
        return 0;
    }
    return 1;
}

/* Integers of more than 53 bits are rounded. */
static double number_at(const rows *r, Py_ssize_t row, Py_ssize_t column) {
    union {
        float f4;
        double f8;
        int8_t i1;
        int16_t i2;
        int32_t i4;
        int64_t i8;
        uint8_t u1;
        uint16_t u2;
        uint32_t u4;
        uint64_t u8;
    } n;
    memcpy(&n, r->items + row * r->stride + column * r->column_stride, (size_t)r->size);
    switch (r->kind) {
    case 'f':
        return r->size == 4 ? (double)n.f4 : n.f8;
    case 'i':
        return r->size == 1 ? n.i1 : r->size == 2 ? n.i2 : r->size == 4 ? n.i4 : (double)n.i8;
    default:
        return r->size == 1 ? n.u1 : r->size == 2 ? n.u2 : r->size == 4 ? n.u4 : (double)n.u8;
    }
}

static void *allocate(Py_ssize_t count, Py_ssize_t each) {
    void *memory = NULL;
    if (count <= PY_SSIZE_T_MAX / each) {
        memory = malloc(count > 0 ? (size_t)count * (size_t)each : 1);
    }
    if (!memory) {
        PyErr_NoMemory();
    }
    return memory;
}

static int in_place(const rows *r, char kind, Py_ssize_t size) {
    return r->kind == kind && r->size == size && r->column_stride == size &&
           r->stride >= r->columns * size;
}

int array_read_floats(PyObject *object, const char *name, int components, array_input *input) {
    rows r;
    if (object == Py_None) {
        return 1;
    }
    if (!open_rows(object, name, components, input, &r)) {
        return 0;
    }
    if (r.columns != components) {
        PyErr_Format(PyExc_ValueError, "%s: rows of %zd numbers; give %d each", name, r.columns,
                     components);
        return 0;
    }
    if (in_place(&r, 'f', sizeof(float))) {
        input->array = (burnish_array){r.items, (size_t)r.count, (size_t)r.stride};
        return 1;
    }
    float *copy = allocate(r.count, components * (Py_ssize_t)sizeof *copy);
    input->copy = copy;
    for (Py_ssize_t i = 0; i < r.count && copy; ++i) {
        for (int k = 0; k < components; ++k) {
            copy[i * components + k] = (float)number_at(&r, i, k);
        }
    }
    input->array = (burnish_array){copy, (size_t)r.count, 0};
    return copy != NULL;
}

/* Faces as triangles, polygons as fans around their first corner. */
static int copy_faces(const rows *r, const char *name, array_input *input) {
    const Py_ssize_t fan = r->columns - 2;
    uint32_t *copy = r->count <= PY_SSIZE_T_MAX / fan ? allocate(r->count * fan, 3 * sizeof *copy)
                                                      : allocate(PY_SSIZE_T_MAX, 3);
    input->copy = copy;
    input->index_size = sizeof *copy;
    input->array = (burnish_array){copy, (size_t)(r->count * fan * 3), 0};
    for (Py_ssize_t i = 0; i < r->count && copy; ++i) {
        for (Py_ssize_t k = 0; k < r->columns; ++k) {
            const double index = number_at(r, i, k);
            if (index < 0 || index >= UINT32_MAX) {
                PyErr_Format(PyExc_ValueError,
                             "%s: face %zd has a vertex that is none; vertices are numbered from "
                             "0",
                             name, i);
                return 0;
            }
            uint32_t *at = copy + 3 * fan * i;
            if (k == 0) {
                at[0] = (uint32_t)index;
            } else if (k < 3) {
                at[k] = (uint32_t)index;
            } else {
                at[3 * (k - 2)] = at[0];
                at[3 * (k - 2) + 1] = at[3 * (k - 3) + 2];
                at[3 * (k - 2) + 2] = (uint32_t)index;
            }
        }
    }
    return copy != NULL;
}

int array_read_indices(PyObject *object, const char *name, array_input *input) {
    rows r;
    if (object == Py_None) {
        return 1;
    }
    if (!open_rows(object, name, 3, input, &r)) {
        return 0;
    }
    if (r.kind == 'f' || r.columns < 3) {
        PyErr_Format(r.kind == 'f' ? PyExc_TypeError : PyExc_ValueError,
                     "%s: rows of %zd %s; give three integers each, numbers of vertices", name,
                     r.columns, r.kind == 'f' ? "floats" : "integers");
        return 0;
    }
    if (r.columns == 3 && r.size <= 4 && in_place(&r, 'u', r.size) && r.stride == 3 * r.size) {
        input->array = (burnish_array){r.items, (size_t)(3 * r.count), 0};
        input->index_size = (int)r.size;
        return 1;
    }
    return copy_faces(&r, name, input);
}

int array_read_colors(PyObject *object, const char *name, array_input *input) {
    rows r;
    if (object == Py_None) {
        return 1;
    }
    if (!open_rows(object, name, 4, input, &r)) {
        return 0;
    }
    if (r.columns != 3 && r.columns != 4) {
        PyErr_Format(PyExc_ValueError, "%s: rows of %zd numbers; give 3 or 4 per vertex", name,
                     r.columns);
        return 0;
    }
    if (r.columns == 4 && in_place(&r, 'u', 1)) {
        input->array = (burnish_array){r.items, (size_t)r.count, (size_t)r.stride};
        return 1;
    }
    uint8_t *copy = allocate(r.count, 4);
    input->copy = copy;
    for (Py_ssize_t i = 0; i < r.count && copy; ++i) {
        copy[4 * i + 3] = 255;
        for (Py_ssize_t k = 0; k < r.columns; ++k) {
            const double value = (r.kind == 'f' ? 255 : 1) * number_at(&r, i, k);
            if (!(value > -0.5 && value < 255.5)) {
                PyErr_Format(PyExc_ValueError,
                             "%s: row %zd is out of range; floats are from 0 to 1, integers from "
                             "0 to 255",
                             name, i);
                return 0;
            }
            copy[4 * i + k] = (uint8_t)(value + 0.5);
        }
    }
    input->array = (burnish_array){copy, (size_t)r.count, 0};
    return copy != NULL;
}

void array_release(array_input *input) {
    if (input->has_view) {
        PyBuffer_Release(&input->view);
    }
    free(input->copy);
    *input = (array_input){.has_view = 0};
}
