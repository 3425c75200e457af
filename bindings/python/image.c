/* burnish.Image: pixels and their properties. */
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "module.h"
#include <structmember.h>

typedef struct image_object {
    PyObject_HEAD burnish_image image;
    array_layout layout;
    Py_ssize_t strides[ARRAY_DIMENSIONS];
    char hash[17];
    uint64_t covered_pixels;
    PyObject *camera, *planes, *warnings;
} image_object;

PyObject *image_warnings(const session *s) {
    Py_ssize_t count = 0;
    while (session_warning(s, (size_t)count)) {
        ++count;
    }
    PyObject *lines = PyTuple_New(count);
    for (Py_ssize_t i = 0; lines && i < count; ++i) {
        const char *text = session_warning(s, (size_t)i);
        PyObject *line = PyUnicode_DecodeUTF8(text, (Py_ssize_t)strlen(text), "replace");
        if (!line || PyTuple_SetItem(lines, i, line) != 0) {
            Py_CLEAR(lines);
        }
    }
    return lines;
}

static PyObject *describe_camera(const burnish_camera *c) {
    return Py_BuildValue("{s(ddd)s(ddd)s(ddd)sdsd}", "position", c->position[0], c->position[1],
                         c->position[2], "focal_point", c->focal_point[0], c->focal_point[1],
                         c->focal_point[2], "view_up", c->view_up[0], c->view_up[1], c->view_up[2],
                         "view_angle", c->view_angle, "orthographic_height",
                         c->orthographic_height);
}

/* The planes as a dictionary of memoryviews, which own the items. */
static PyObject *take_planes(const module_state *state, session *s, const burnish_image *image) {
    const session_planes taken = session_take_planes(s);
    const Py_ssize_t width = image->width, height = image->height;
    const struct {
        const char *name;
        array_layout layout;
    } rows[] = {
        {"depth", {taken.depth, "f", sizeof(float), 2, {height, width}}},
        {"normal", {taken.normals, "f", sizeof(float), 3, {height, width, 3}}},
        {"triangle", {taken.triangles, "I", sizeof(uint32_t), 2, {height, width}}},
        {"coverage", {taken.coverage, "B", 1, 2, {height, width}}},
    };
    PyObject *planes = PyDict_New();
    int done = planes != NULL;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        if (rows[i].layout.items) { /* which the view takes, also after an error */
            PyObject *view = array_memoryview(state, NULL, &rows[i].layout);
            done = view && done && PyDict_SetItemString(planes, rows[i].name, view) == 0;
            Py_XDECREF(view);
        }
    }
    if (!done) {
        Py_CLEAR(planes);
    }
    return planes;
}

static void set_image(image_object *self, burnish_image image, uint64_t hash,
                      uint64_t covered_pixels) {
    snprintf(self->hash, sizeof self->hash, "%016llx", (unsigned long long)hash);
    self->image = image;
    self->covered_pixels = covered_pixels;
    self->layout =
        (array_layout){image.pixels, "B", 1, 3, {image.height, image.width, image.channels}};
}

PyObject *image_take(const module_state *state, session *s) {
    image_object *self = module_allocate(state->image_type);
    if (!self) {
        return NULL;
    }
    const burnish_camera camera = session_camera(s);
    const uint64_t hash = session_hash(s);
    set_image(self, session_take_image(s), hash, session_report(s)->covered_pixels);
    self->camera = describe_camera(&camera);
    self->planes = take_planes(state, s, &self->image);
    self->warnings = image_warnings(s);
    if (!self->camera || !self->planes || !self->warnings) {
        Py_DECREF(self);
        return NULL;
    }
    return (PyObject *)self;
}

PyObject *image_restore(PyObject *module, PyObject *arguments) {
    const module_state *state = PyModule_GetState(module);
    buffer_view pixels;
    int height, width, channels;
    unsigned long long covered_pixels;
    PyObject *camera, *planes, *warnings;
    burnish_image image;
    burnish_error error = {0};
    if (!PyArg_ParseTuple(arguments, "y*(iii)KO!O!O!", &pixels, &height, &width, &channels,
                          &covered_pixels, &PyDict_Type, &camera, &PyDict_Type, &planes,
                          &PyTuple_Type, &warnings)) {
        return NULL;
    }
    image_object *self = NULL;
    if (burnish_image_create(NULL, &image, width, height, channels, &error) != BURNISH_STATUS_OK) {
        module_fail(state, &error);
    } else if (pixels.len != (Py_ssize_t)height * width * channels) {
        PyErr_SetString(PyExc_ValueError, "the number of bytes is not that of the pixels");
        burnish_image_destroy(&image);
    } else if ((self = module_allocate(state->image_type)) == NULL) {
        burnish_image_destroy(&image);
    } else {
        memcpy(image.pixels, pixels.buf, (size_t)pixels.len);
        set_image(self, image, burnish_image_hash(&image), covered_pixels);
        self->camera = module_share(camera);
        self->planes = module_share(planes);
        self->warnings = module_share(warnings);
    }
    PyBuffer_Release(&pixels);
    return (PyObject *)self;
}

static void destroy(PyObject *object) {
    image_object *self = (image_object *)object;
    burnish_image_destroy(&self->image);
    Py_XDECREF(self->camera);
    Py_XDECREF(self->planes);
    Py_XDECREF(self->warnings);
    module_free(object);
}

static int get_buffer(PyObject *object, buffer_view *view, int flags) {
    image_object *self = (image_object *)object;
    return array_fill_view(object, &self->layout, self->strides, view, flags);
}

/* ---- PNG ---- */

static PyObject *png(PyObject *object, PyObject *unused) {
    (void)unused;
    const image_object *self = (image_object *)object;
    const burnish_pixels pixels = burnish_image_get_pixels(&self->image);
    burnish_error error = {0};
    uint8_t *bytes = NULL;
    size_t size = 0;
    burnish_status status;
    Py_BEGIN_ALLOW_THREADS;
    status = burnish_png_encode(&pixels, NULL, &bytes, &size, &error);
    Py_END_ALLOW_THREADS;
    if (status != BURNISH_STATUS_OK) {
        return module_fail(module_state_of(Py_TYPE(object)), &error);
    }
    PyObject *result = PyBytes_FromStringAndSize((const char *)bytes, (Py_ssize_t)size);
    burnish_release(NULL, bytes);
    return result;
}

/* Whether a file's name has the extension .png or none. Others raise ValueError: only the program
 * writes other formats. */
static int check_extension(const char *name) {
    const char *slash = strrchr(name, '/');
    const char *dot = strrchr(slash ? slash : name, '.');
    if (!dot || PyOS_stricmp(dot, ".png") == 0) {
        return 1;
    }
    PyErr_Format(PyExc_ValueError,
                 "%s: save() writes PNG; use the extension .png, or Pillow for other formats: "
                 "PIL.Image.fromarray(picture).save(name)",
                 name);
    return 0;
}

static PyObject *save(PyObject *object, PyObject *path) {
    const image_object *self = (image_object *)object;
    PyObject *name = NULL;
    burnish_error error = {0};
    burnish_status status;
    if (PyObject_HasAttrString(path, "write")) {
        PyObject *bytes = png(object, NULL);
        PyObject *result = bytes ? PyObject_CallMethod(path, "write", "O", bytes) : NULL;
        Py_XDECREF(bytes);
        Py_XDECREF(result);
        return result ? module_share(Py_None) : NULL;
    }
    if (!PyUnicode_FSConverter(path, &name)) {
        return NULL;
    }
    if (!check_extension(PyBytes_AsString(name))) {
        Py_DECREF(name);
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS;
    status = burnish_image_write_png(&self->image, PyBytes_AsString(name), &error);
    Py_END_ALLOW_THREADS;
    Py_DECREF(name);
    if (status != BURNISH_STATUS_OK) {
        return module_fail(module_state_of(Py_TYPE(object)), &error);
    }
    Py_RETURN_NONE;
}

static PyObject *to_bytes(PyObject *object, PyObject *unused) {
    (void)unused;
    const burnish_image *image = &((image_object *)object)->image;
    return PyBytes_FromStringAndSize((const char *)image->pixels,
                                     (Py_ssize_t)image->width * image->height * image->channels);
}

/* ---- Properties ---- */

static PyObject *get_shape(PyObject *object, void *unused) {
    (void)unused;
    const burnish_image *image = &((image_object *)object)->image;
    return Py_BuildValue("(iii)", image->height, image->width, image->channels);
}

static PyObject *get_mode(PyObject *object, void *unused) {
    (void)unused;
    return PyUnicode_FromString(((image_object *)object)->image.channels == 4 ? "RGBA" : "RGB");
}

static PyObject *get_size(PyObject *object, void *unused) {
    (void)unused;
    const burnish_image *image = &((image_object *)object)->image;
    return Py_BuildValue("(ii)", image->width, image->height);
}

static PyObject *get_camera(PyObject *object, void *unused) {
    (void)unused;
    return PyDict_Copy(((image_object *)object)->camera);
}

static PyObject *get_planes(PyObject *object, void *unused) {
    (void)unused;
    return PyDict_Copy(((image_object *)object)->planes);
}

static PyObject *get_interface(PyObject *object, void *unused) {
    (void)unused;
    const image_object *self = (image_object *)object;
    return Py_BuildValue("{s(iii)sss(NO)si}", "shape", self->image.height, self->image.width,
                         self->image.channels, "typestr", "|u1", "data",
                         PyLong_FromVoidPtr(self->image.pixels), Py_True, "version", 3);
}

static PyObject *represent(PyObject *object) {
    const image_object *self = (image_object *)object;
    return PyUnicode_FromFormat("<burnish.Image %dx%d %s %s>", self->image.width,
                                self->image.height, self->image.channels == 4 ? "RGBA" : "RGB",
                                self->hash);
}

static PyMemberDef members[] = {
    {"width", T_INT, offsetof(image_object, image.width), READONLY, "Pixels."},
    {"height", T_INT, offsetof(image_object, image.height), READONLY, "Pixels."},
    {"covered_pixels", T_ULONGLONG, offsetof(image_object, covered_pixels), READONLY,
     "Pixels that show the object."},
    {"hash", T_STRING_INPLACE, offsetof(image_object, hash), READONLY,
     "XXH64 of the pixels: what `burnish render --json` prints."},
    {"warnings", T_OBJECT_EX, offsetof(image_object, warnings), READONLY,
     "Warnings about the mesh and the picture."},
    {0},
};

static PyGetSetDef properties[] = {
    {"size", get_size, NULL, "Width and height, as in Pillow.", NULL},
    {"shape", get_shape, NULL, "Height, width and channels, as in NumPy.", NULL},
    {"mode", get_mode, NULL, "'RGB', or 'RGBA' with no_background=True.", NULL},
    {"camera", get_camera, NULL,
     "position, focal_point, view_up, view_angle (degrees) and "
     "orthographic_height (0: perspective).",
     NULL},
    {"planes", get_planes, NULL,
     "A dictionary of the planes that render() was asked for: memoryviews for numpy.asarray().\n"
     "depth     (height, width) of float32: distance along the camera's axis, infinity if empty\n"
     "normal    (height, width, 3) of float32: unit normals in the mesh's axes, 0 if empty\n"
     "triangle  (height, width) of uint32: indices into mesh.faces, 4294967295 if empty\n"
     "coverage  (height, width) of uint8: 255 times the part of the pixel that shows something",
     NULL},
    {"__array_interface__", get_interface, NULL, NULL, NULL},
    {0},
};

static PyMethodDef methods[] = {
    {"png", png, METH_NOARGS, "png() -> bytes\n\nThe picture as a PNG file."},
    {"_repr_png_", png, METH_NOARGS, NULL},
    {"save", save, METH_O,
     "save(file)\n\nWrites a PNG file, whole or not at all. file is a path with the extension "
     ".png or none,\nor an object with write(). Pillow writes other formats:\n"
     "Image.fromarray(picture).save('part.jpg')."},
    {"tobytes", to_bytes, METH_NOARGS, "tobytes() -> bytes\n\nA copy of the pixels."},
    {0},
};

PyObject *image_create_type(PyObject *module) {
    static PyType_Slot slots[] = {
        {Py_tp_new, module_refuse},
        {Py_tp_dealloc, destroy},
        {Py_tp_repr, represent},
        {Py_tp_members, members},
        {Py_tp_getset, properties},
        {Py_tp_methods, methods},
        {PyBUF_SLOT, get_buffer},
        {Py_tp_doc, "A picture: 8-bit sRGB values, rows from the top; a fourth channel is straight "
                    "alpha.\n\nnumpy.asarray(picture) and memoryview(picture) are read-only views "
                    "of the pixels, (height, width, channels)."},
        {0},
    };
    static PyType_Spec spec = {"burnish.Image", sizeof(image_object), 0, Py_TPFLAGS_DEFAULT, slots};
    return PyType_FromModuleAndSpec(module, &spec, NULL);
}
