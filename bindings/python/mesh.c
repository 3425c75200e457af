/* burnish.Mesh: a loaded mesh, which can be drawn many times. */
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/program.h"
#include "cli/main.h"
#include "module.h"

typedef struct mesh_object {
    PyObject_HEAD session *session;
    PyThread_type_lock lock; /* one thread at a time draws a mesh */
    atomic_ulong holder;     /* the thread that has the lock */
    atomic_int is_held;
} mesh_object;

/* Acquires the lock, without Python's. Signal handlers run while drawing: there this thread already
 * has the lock and would wait for itself, so it raises an exception. */
static int enter(mesh_object *self) {
    const unsigned long thread = PyThread_get_thread_ident();
    if (atomic_load(&self->is_held) && atomic_load(&self->holder) == thread) {
        PyErr_SetString(PyExc_RuntimeError,
                        "a signal handler can't use the mesh that it interrupts; use another mesh");
        return 0;
    }
    Py_BEGIN_ALLOW_THREADS;
    PyThread_acquire_lock(self->lock, WAIT_LOCK);
    Py_END_ALLOW_THREADS;
    atomic_store(&self->holder, thread);
    atomic_store(&self->is_held, 1);
    return 1;
}

static void leave(mesh_object *self) {
    atomic_store(&self->is_held, 0);
    PyThread_release_lock(self->lock);
}

/* ---- Creation ---- */

/* An instance of cls, a class that is or is derived from Mesh. */
static mesh_object *create(const module_state *state, PyObject *cls) {
    if (!PyType_Check(cls) ||
        !PyType_IsSubtype((PyTypeObject *)cls, (PyTypeObject *)state->mesh_type)) {
        PyErr_SetString(PyExc_TypeError, "expected a class derived from Mesh");
        return NULL;
    }
    mesh_object *self = module_allocate(cls);
    if (!self) {
        return NULL;
    }
    self->lock = PyThread_allocate_lock();
    self->session = session_create(state->context);
    if (!self->lock || !self->session) {
        Py_DECREF(self);
        PyErr_NoMemory();
        return NULL;
    }
    return self;
}

static void destroy(PyObject *object) {
    mesh_object *self = (mesh_object *)object;
    session_destroy(self->session);
    if (self->lock) {
        PyThread_free_lock(self->lock);
    }
    module_free(object);
}

/* Options of a session, to be released. Texts belong to the Python objects. */
typedef struct option_list {
    session_option *items;
    double *numbers;
    size_t count;
} option_list;

static void release_options(option_list *list) {
    PyMem_Free(list->items);
    PyMem_Free(list->numbers);
}

static session_options options_of(const option_list *list) {
    return (session_options){list->items, list->count, SESSION_UNDERSCORES};
}

/* Reads a value: a bool, a text, or a tuple of floats, which go to *next. */
static int read_value(PyObject *value, session_option *option, double **next) {
    if (PyUnicode_Check(value)) {
        return PyArg_Parse(value, "s", &option->text);
    }
    if (PyBool_Check(value)) {
        option->is_off = value == Py_False;
        return 1;
    }
    option->numbers = *next;
    option->count = (size_t)PyTuple_Size(value);
    for (size_t i = 0; i < option->count; ++i) {
        *(*next)++ = PyFloat_AsDouble(PyTuple_GetItem(value, (Py_ssize_t)i));
    }
    return !PyErr_Occurred();
}

/* Reads a list of pairs (name, value). Returns 1, or 0 after an exception; for "O&". */
static int read_options(PyObject *pairs, void *target) {
    option_list *list = target;
    size_t numbers = 0;
    const Py_ssize_t count = PyList_Size(pairs);
    for (Py_ssize_t i = 0; i < count; ++i) {
        PyObject *value = PyTuple_GetItem(PyList_GetItem(pairs, i), 1);
        numbers += value && PyTuple_Check(value) ? (size_t)PyTuple_Size(value) : 0;
    }
    *list = (option_list){.count = count > 0 ? (size_t)count : 0};
    list->items = PyMem_Calloc(list->count + 1, sizeof *list->items);
    list->numbers = PyMem_Calloc(numbers + 1, sizeof *list->numbers);
    double *next = list->numbers;
    int is_good = count >= 0 && list->items && list->numbers;
    for (Py_ssize_t i = 0; i < count && is_good; ++i) {
        PyObject *pair = PyList_GetItem(pairs, i), *value;
        is_good = PyArg_ParseTuple(pair, "sO", &list->items[i].name, &value) &&
                  read_value(value, &list->items[i], &next);
    }
    if (!is_good) {
        release_options(list);
        if (!PyErr_Occurred()) {
            PyErr_NoMemory();
        }
    }
    return is_good;
}

/* Bytes of an object, or nothing for None. */
typedef struct bytes_input {
    buffer_view view;
    int has_view;
} bytes_input;

static int read_bytes(PyObject *object, bytes_input *input) {
    if (object == Py_None) {
        return 1;
    }
    input->has_view = PyObject_GetBuffer(object, &input->view, PyBUF_SIMPLE) == 0;
    return input->has_view;
}

static void release_bytes(bytes_input *inputs, Py_ssize_t count) {
    for (Py_ssize_t i = 0; i < count && inputs; ++i) {
        if (inputs[i].has_view) {
            PyBuffer_Release(&inputs[i].view);
        }
    }
    PyMem_Free(inputs);
}

/* Offers a list of pairs (name as bytes, content). Returns the contents' buffers, to be released
 * once the session is open; NULL after an exception. */
static bytes_input *offer(session *s, PyObject *files, Py_ssize_t count) {
    bytes_input *inputs = PyMem_Calloc((size_t)count + 1, sizeof *inputs);
    int is_good = inputs != NULL;
    for (Py_ssize_t i = 0; i < count && is_good; ++i) {
        PyObject *pair = PyList_GetItem(files, i), *content;
        const char *name;
        is_good = pair && PyArg_ParseTuple(pair, "yO", &name, &content) &&
                  read_bytes(content, &inputs[i]) &&
                  session_offer(s, name, inputs[i].view.buf, (size_t)inputs[i].view.len);
    }
    if (!is_good) {
        release_bytes(inputs, count);
        if (!PyErr_Occurred()) {
            PyErr_NoMemory();
        }
        return NULL;
    }
    return inputs;
}

static PyObject *opened(const module_state *state, mesh_object *self, burnish_status status,
                        const burnish_error *error) {
    if (status != BURNISH_STATUS_OK || PyErr_Occurred()) { /* of a signal */
        Py_DECREF(self);
        return module_fail(state, error);
    }
    return (PyObject *)self;
}

PyObject *mesh_load(PyObject *module, PyObject *arguments) {
    const module_state *state = PyModule_GetState(module);
    PyObject *cls, *data, *files;
    const char *name;
    option_list options;
    burnish_error error = {0};
    burnish_status status = BURNISH_STATUS_OK;
    if (!PyArg_ParseTuple(arguments, "OyOO!O&", &cls, &name, &data, &PyList_Type, &files,
                          read_options, &options)) {
        return NULL;
    }
    const Py_ssize_t count = PyList_Size(files);
    mesh_object *self = create(state, cls);
    bytes_input bytes = {.has_view = 0};
    bytes_input *offered = self ? offer(self->session, files, count) : NULL;
    if (!offered || !read_bytes(data, &bytes)) {
        release_bytes(offered, count);
        release_options(&options);
        Py_XDECREF((PyObject *)self);
        return NULL;
    }
    const void *content = bytes.has_view && bytes.view.len > 0 ? bytes.view.buf : "";
    Py_BEGIN_ALLOW_THREADS;
    status =
        session_open(self->session, name, bytes.has_view ? content : NULL,
                     bytes.has_view ? (size_t)bytes.view.len : 0, options_of(&options), &error);
    Py_END_ALLOW_THREADS;
    if (bytes.has_view) {
        PyBuffer_Release(&bytes.view);
    }
    release_bytes(offered, count);
    release_options(&options);
    return opened(state, self, status, &error);
}

/* The arrays of a mesh. */
typedef struct build_inputs {
    array_input vertices, faces, normals, colors, uv;
} build_inputs;

static void release_inputs(build_inputs *in) {
    array_release(&in->vertices);
    array_release(&in->faces);
    array_release(&in->normals);
    array_release(&in->colors);
    array_release(&in->uv);
}

/* A wrong value in an array raises what the library's errors about arrays do. */
static void convert_error(const module_state *state) {
    PyObject *class, *value, *trace;
    burnish_error error = {.status = BURNISH_STATUS_ARGUMENT};
    if (!PyErr_ExceptionMatches(PyExc_ValueError)) {
        return;
    }
    PyErr_Fetch(&class, &value, &trace);
    PyObject *line = PyObject_Str(value);
    const char *text;
    if (line && PyArg_Parse(line, "s", &text)) {
        snprintf(error.text, sizeof error.text, "%s", text);
        module_fail(state, &error);
    }
    Py_XDECREF(line);
    Py_XDECREF(class);
    Py_XDECREF(value);
    Py_XDECREF(trace);
}

PyObject *mesh_build(PyObject *module, PyObject *arguments) {
    const module_state *state = PyModule_GetState(module);
    burnish_mesh_description d = burnish_mesh_description_default();
    PyObject *cls, *vertices, *faces, *normals, *colors, *uv;
    build_inputs in = {.vertices = {.has_view = 0}};
    option_list options;
    burnish_error error = {0};
    burnish_status status = BURNISH_STATUS_OK;
    if (!PyArg_ParseTuple(arguments, "OsOOOOO(fff)O&", &cls, &d.name, &vertices, &faces, &normals,
                          &colors, &uv, &d.up_axis[0], &d.up_axis[1], &d.up_axis[2], read_options,
                          &options)) {
        return NULL;
    }
    mesh_object *self = create(state, cls);
    if (!self || !array_read_floats(vertices, "vertices", 3, &in.vertices) ||
        !array_read_indices(faces, "faces", &in.faces) ||
        !array_read_floats(normals, "normals", 3, &in.normals) ||
        !array_read_colors(colors, "colors", &in.colors) ||
        !array_read_floats(uv, "uv", 2, &in.uv)) {
        convert_error(state);
        release_inputs(&in);
        release_options(&options);
        Py_XDECREF((PyObject *)self);
        return NULL;
    }
    d.positions = in.vertices.array;
    d.indices = in.faces.array;
    d.index_size = in.faces.index_size ? in.faces.index_size : d.index_size;
    d.normals = in.normals.array;
    d.colors = in.colors.array;
    d.texture_coordinates = in.uv.array;
    Py_BEGIN_ALLOW_THREADS;
    status = session_build(self->session, &d, options_of(&options), &error);
    Py_END_ALLOW_THREADS;
    release_inputs(&in);
    release_options(&options);
    return opened(state, self, status, &error);
}

/* ---- Drawing ---- */

static PyObject *draw(PyObject *object, PyObject *arguments) {
    mesh_object *self = (mesh_object *)object;
    const module_state *state = module_state_of(Py_TYPE(object));
    option_list options;
    unsigned planes;
    burnish_error error = {0};
    burnish_status status;
    if (!PyArg_ParseTuple(arguments, "IO&", &planes, read_options, &options)) {
        return NULL;
    }
    if (!enter(self)) {
        release_options(&options);
        return NULL;
    }
    session_request_planes(self->session, planes);
    Py_BEGIN_ALLOW_THREADS;
    status = session_draw(self->session, options_of(&options), &error);
    Py_END_ALLOW_THREADS;
    release_options(&options);
    PyObject *image = status == BURNISH_STATUS_OK && !PyErr_Occurred()
                          ? image_take(state, self->session)
                          : module_fail(state, &error);
    leave(self);
    return image;
}

PyObject *mesh_check(PyObject *module, PyObject *arguments) {
    const module_state *state = PyModule_GetState(module);
    option_list options;
    burnish_error error = {0};
    if (!PyArg_ParseTuple(arguments, "O&", read_options, &options)) {
        return NULL;
    }
    const burnish_status status = session_check(options_of(&options), &error);
    release_options(&options);
    if (status != BURNISH_STATUS_OK) {
        return module_fail(state, &error);
    }
    Py_RETURN_NONE;
}

PyObject *mesh_flags(PyObject *module, PyObject *unused) {
    (void)module, (void)unused;
    char *text = cli_describe_flags(&render_options_command);
    PyObject *rows = text ? PyUnicode_FromString(text) : PyErr_NoMemory();
    free(text);
    return rows;
}

/* ---- Properties ---- */

static const burnish_mesh_view *view_of(PyObject *object) {
    return burnish_mesh_get_view(session_mesh(((mesh_object *)object)->session));
}

static PyObject *get_bounds(PyObject *object, void *unused) {
    (void)unused;
    double low[3], high[3];
    session_bounds(((mesh_object *)object)->session, low, high);
    return Py_BuildValue("((ddd)(ddd))", low[0], low[1], low[2], high[0], high[1], high[2]);
}

static PyObject *get_warnings(PyObject *object, void *unused) {
    (void)unused;
    mesh_object *self = (mesh_object *)object;
    if (!enter(self)) { /* drawing adds to them */
        return NULL;
    }
    PyObject *lines = image_warnings(self->session);
    leave(self);
    return lines;
}

enum { VERTICES, FACES, NORMALS, COLORS, FACE_PARTS };

/* An array of the mesh, of which the closure is the number. */
static PyObject *get_array(PyObject *object, void *number) {
    const burnish_mesh_view *view = view_of(object);
    const Py_ssize_t vertices = (Py_ssize_t)view->vertex_count;
    const array_layout arrays[] = {
        [VERTICES] = {view->positions, "f", sizeof(float), 2, {vertices, 3}},
        [FACES] = {view->indices, "I", 4, 2, {(Py_ssize_t)view->triangle_count, 3}},
        [NORMALS] = {view->normals, "f", sizeof(float), 2, {vertices, 3}},
        [COLORS] = {view->colors, "B", 1, 2, {vertices, 4}},
        [FACE_PARTS] = {view->triangle_parts, "H", 2, 1, {(Py_ssize_t)view->triangle_count}},
    };
    const array_layout *array = &arrays[(intptr_t)number];
    if (!array->items) {
        Py_RETURN_NONE;
    }
    return array_memoryview(module_state_of(Py_TYPE(object)), object, array);
}

/* JSON. */
static PyObject *get_contents(PyObject *object, PyObject *unused) {
    (void)unused;
    char *text = session_contents(((mesh_object *)object)->session);
    PyObject *contents = text ? PyUnicode_FromString(text) : PyErr_NoMemory();
    free(text);
    return contents;
}

static PyObject *get_origin(PyObject *object, void *unused) {
    (void)unused;
    const double *origin = view_of(object)->origin;
    return Py_BuildValue("(ddd)", origin[0], origin[1], origin[2]);
}

static PyObject *represent(PyObject *object) {
    const burnish_mesh_view *view = view_of(object);
    return PyUnicode_FromFormat("<burnish.Mesh %zu triangles, %zu vertices>", view->triangle_count,
                                view->vertex_count);
}

static PyGetSetDef properties[] = {
    {"vertices", get_array, NULL,
     "A memoryview (N, 3) of float32, read-only: positions after corners with several normals or\n"
     "colors were split, so there can be more than were given. numpy.asarray(mesh.vertices)\n"
     "shares the memory; mesh.vertices.tolist() copies it.",
     (void *)VERTICES},
    {"faces", get_array, NULL,
     "A memoryview (M, 3) of uint32, read-only: triangles as indices into vertices.",
     (void *)FACES},
    {"normals", get_array, NULL,
     "A memoryview (N, 3) of float32, read-only: unit normals, one per vertex.", (void *)NORMALS},
    {"colors", get_array, NULL,
     "A memoryview (N, 4) of uint8, read-only: sRGB and alpha, one per vertex; or None.",
     (void *)COLORS},
    {"face_parts", get_array, NULL,
     "A memoryview (M,) of uint16, read-only: the number in parts of each face's part; or None.",
     (void *)FACE_PARTS},
    {"bounds", get_bounds, NULL, "The least and the largest coordinates.", NULL},
    {"origin", get_origin, NULL,
     "To be added to vertices: (0, 0, 0), except for files whose objects are far away from it.",
     NULL},
    {"warnings", get_warnings, NULL, "Lines about ignored or repaired parts of the input.", NULL},
    {0},
};

static PyMethodDef methods[] = {
    {"_draw", draw, METH_VARARGS, NULL},
    {"_contents", get_contents, METH_NOARGS, NULL},
    {0},
};

PyObject *mesh_create_type(PyObject *module) {
    static PyType_Slot slots[] = {
        {Py_tp_new, module_refuse},
        {Py_tp_dealloc, destroy},
        {Py_tp_repr, represent},
        {Py_tp_getset, properties},
        {Py_tp_methods, methods},
        {Py_tp_doc, "A loaded mesh."},
        {0},
    };
    static PyType_Spec spec = {"burnish._burnish.Mesh", sizeof(mesh_object), 0,
                               Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE, slots};
    return PyType_FromModuleAndSpec(module, &spec, NULL);
}
