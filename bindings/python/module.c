/* burnish._burnish: the library for Python. Its public interface is in burnish/__init__.py. */
#include "module.h"

#include <errno.h>
#include <string.h>

module_state *module_state_of(PyTypeObject *type) {
    while (type && !PyType_GetModule(type)) { /* a Python class that is derived from one of these */
        PyErr_Clear();
        type = PyType_GetSlot(type, Py_tp_base);
    }
    return type ? PyType_GetModuleState(type) : NULL;
}

void *module_allocate(PyObject *type) {
    const allocfunc allocate = (allocfunc)PyType_GetSlot((PyTypeObject *)type, Py_tp_alloc);
    return allocate((PyTypeObject *)type, 0);
}

void module_free(PyObject *object) {
    PyTypeObject *type = Py_TYPE(object);
    const freefunc release = (freefunc)PyType_GetSlot(type, Py_tp_free);
    release(object);
    Py_DECREF(type);
}

PyObject *module_refuse(PyTypeObject *type, PyObject *arguments, PyObject *keywords) {
    (void)arguments, (void)keywords;
    PyErr_Format(PyExc_TypeError, "%R has no constructor; use the functions of burnish",
                 (PyObject *)type);
    return NULL;
}

PyObject *module_share(PyObject *object) {
    Py_XINCREF(object);
    return object;
}

/* Files that can't be read or written also raise what open() raises, and arguments ValueError. */
static PyObject *class_of(const module_state *state, const burnish_error *error) {
    const int is_file =
        error->status == BURNISH_STATUS_READ || error->status == BURNISH_STATUS_WRITE;
    if (error->status == BURNISH_STATUS_ARGUMENT) {
        return state->argument_error;
    }
    return !is_file                                ? state->error
           : strstr(error->text, strerror(ENOENT)) ? state->missing_file_error
                                                   : state->file_error;
}

PyObject *module_fail(const module_state *state, const burnish_error *error) {
    static const char *const names[] = {
#define STATUS_NAME(name, code, text) #name,
        BURNISH_STATUS_LIST(STATUS_NAME)
#undef STATUS_NAME
    };
    if (PyErr_Occurred()) {
        return NULL;
    }
    PyObject *text = PyUnicode_DecodeUTF8(error->text, (Py_ssize_t)strlen(error->text), "replace");
    PyObject *status = PyUnicode_FromString(names[error->status]);
    PyObject *class = class_of(state, error);
    PyObject *raised = text ? PyObject_CallFunctionObjArgs(class, text, NULL) : NULL;
    if (raised && status && PyObject_SetAttrString(raised, "status", status) == 0) {
        PyErr_SetObject(class, raised);
    }
    Py_XDECREF(text);
    Py_XDECREF(status);
    Py_XDECREF(raised);
    return NULL;
}

/* Whether a signal handler has raised an exception: Ctrl-C ends a long call. */
static int has_signal(void *user_data) {
    (void)user_data;
    const PyGILState_STATE held = PyGILState_Ensure();
    const int raised = PyErr_Occurred() || PyErr_CheckSignals() != 0;
    PyGILState_Release(held);
    return raised;
}

static int create_context(module_state *state) {
    burnish_context_options options = burnish_context_options_default();
    burnish_error error = {0};
    options.cancelled = has_signal;
    if (burnish_context_create(&options, &state->context, &error) != BURNISH_STATUS_OK) {
        module_fail(state, &error);
        return 0;
    }
    return 1;
}

static int add(PyObject *module, const char *name, PyObject *object) {
    return object && PyModule_AddObject(module, name, module_share(object)) == 0;
}

/* Creates an exception class with two bases; NULL if the first one is missing. */
static PyObject *derive(const char *name, const char *doc, PyObject *first, PyObject *second) {
    PyObject *bases = first ? PyTuple_Pack(2, first, second) : NULL;
    PyObject *class = bases ? PyErr_NewExceptionWithDoc(name, doc, bases, NULL) : NULL;
    Py_XDECREF(bases);
    return class;
}

static int execute(PyObject *module) {
    module_state *state = PyModule_GetState(module);
    state->error = PyErr_NewExceptionWithDoc(
        "burnish.Error", "A one-line error; status is a word such as 'FORMAT'.", NULL, NULL);
    state->argument_error =
        derive("burnish.ArgumentError", "An option or an array has a wrong value.", state->error,
               PyExc_ValueError);
    state->file_error = derive("burnish.FileError", "A file can't be read or written.",
                               state->error, PyExc_OSError);
    state->missing_file_error = derive("burnish.MissingFileError", "A file does not exist.",
                                       state->file_error, PyExc_FileNotFoundError);
    state->array_type = array_create_type(module);
    state->image_type = image_create_type(module);
    state->mesh_type = mesh_create_type(module);
    int done = PyModule_AddStringConstant(module, "version", burnish_version()) == 0;
#define ADD(member, name) done = done && add(module, #name, state->member);
    MODULE_CLASSES(ADD)
    return done && create_context(state) ? 0 : -1;
}

static int traverse(PyObject *module, visitproc visit, void *arg) {
    const module_state *state = PyModule_GetState(module);
#define VISIT(member, name) Py_VISIT(state->member);
    MODULE_CLASSES(VISIT)
    return 0;
}

static int clear(PyObject *module) {
    module_state *state = PyModule_GetState(module);
#define CLEAR(member, name) Py_CLEAR(state->member);
    MODULE_CLASSES(CLEAR)
    return 0;
}

static void release(void *module) {
    module_state *state = PyModule_GetState(module);
    clear(module);
    burnish_context_destroy(state->context);
    state->context = NULL;
}

static PyMethodDef functions[] = {
    {"load", mesh_load, METH_VARARGS, "load(cls, name, data, files, options)"},
    {"build", mesh_build, METH_VARARGS,
     "build(cls, name, vertices, faces, normals, colors, uv, up, options)"},
    {"check", mesh_check, METH_VARARGS, "check(options)"},
    {"flags", mesh_flags, METH_NOARGS,
     "flags() -> the options, as `options` of `burnish help --json`"},
    {"image", image_restore, METH_VARARGS,
     "image(pixels, shape, covered_pixels, camera, planes, warnings)"},
    {"lobe_values", lobe_values, METH_VARARGS, "lobe_values(lobe, exponent, cosines)"},
    {"lobe_exact", lobe_exact, METH_VARARGS, "lobe_exact(lobe, exponent, angles)"},
    {"lobe_row", lobe_row, METH_VARARGS, "lobe_row(lobe, exponent, metrics)"},
    {"lobe_choose", lobe_choose, METH_VARARGS, "lobe_choose(exponent, epsilon, affine)"},
    {"lobe_words", lobe_words, METH_NOARGS, "lobe_words()"},
    {0},
};

static PyModuleDef_Slot slots[] = {{Py_mod_exec, execute}, {0}};

static struct PyModuleDef definition = {
    PyModuleDef_HEAD_INIT,
    .m_name = "burnish._burnish",
    .m_size = sizeof(module_state),
    .m_methods = functions,
    .m_slots = slots,
    .m_traverse = traverse,
    .m_clear = clear,
    .m_free = release,
};

PyMODINIT_FUNC PyInit__burnish(void);
PyMODINIT_FUNC PyInit__burnish(void) {
    return PyModuleDef_Init(&definition);
}
