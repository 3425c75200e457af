/* Lobes: their values, with the bits of pictures, and facts of theory.h. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/kernels.h"
#include "burnish/theory.h"
#include "module.h"

/* ---- Values ---- */

PyObject *lobe_values(PyObject *module, PyObject *arguments) {
    const module_state *state = PyModule_GetState(module);
    array_input cosines = {.has_view = 0};
    burnish_lobe_spec lobe;
    burnish_error error = {0};
    const char *words;
    double exponent;
    PyObject *object;
    if (!PyArg_ParseTuple(arguments, "sdO", &words, &exponent, &object) ||
        !array_read_floats(object, "cosines", 1, &cosines)) {
        array_release(&cosines);
        return NULL;
    }
    const size_t count = cosines.array.count;
    float *input = malloc((count + 1) * sizeof *input),
          *values = malloc((count + 1) * sizeof *values);
    burnish_status status = burnish_lobe_spec_parse(words, &lobe, &error);
    const size_t stride = cosines.array.stride ? cosines.array.stride : sizeof *input;
    for (size_t i = 0; i < count && input; ++i) {
        memcpy(&input[i], (const char *)cosines.array.items + i * stride, sizeof *input);
    }
    if (status == BURNISH_STATUS_OK && input && values) {
        Py_BEGIN_ALLOW_THREADS;
        status = burnish_kernels_lobe_of_cosines(burnish_kernels_best(), &lobe, (float)exponent,
                                                 count, input, values, &error);
        Py_END_ALLOW_THREADS;
    }
    array_release(&cosines);
    free(input);
    if (!input || !values || status != BURNISH_STATUS_OK) {
        free(values);
        return input && values ? module_fail(state, &error) : PyErr_NoMemory();
    }
    const array_layout layout = {values, "f", sizeof *values, 1, {(Py_ssize_t)count}};
    return array_memoryview(state, NULL, &layout);
}

/* A sequence of numbers as doubles, to be freed; NULL after an exception. */
static double *read_doubles(PyObject *object, Py_ssize_t *count) {
    *count = PySequence_Size(object);
    if (*count < 0) {
        return NULL;
    }
    double *numbers = malloc(((size_t)*count + 1) * sizeof *numbers);
    if (!numbers) {
        PyErr_NoMemory();
        return NULL;
    }
    for (Py_ssize_t i = 0; i < *count; ++i) {
        PyObject *item = PySequence_GetItem(object, i);
        numbers[i] = item ? PyFloat_AsDouble(item) : -1;
        Py_XDECREF(item);
        if (PyErr_Occurred()) {
            free(numbers);
            return NULL;
        }
    }
    return numbers;
}

PyObject *lobe_exact(PyObject *module, PyObject *arguments) {
    const module_state *state = PyModule_GetState(module);
    burnish_theory_model model;
    burnish_error error = {0};
    const char *words;
    double exponent;
    Py_ssize_t count;
    PyObject *object;
    if (!PyArg_ParseTuple(arguments, "sdO", &words, &exponent, &object)) {
        return NULL;
    }
    if (burnish_theory_model_parse(words, exponent, &model, &error) != BURNISH_STATUS_OK) {
        return module_fail(state, &error);
    }
    double *values = read_doubles(object, &count);
    for (Py_ssize_t i = 0; i < count && values; ++i) {
        values[i] = burnish_theory_value_at_angle(&model, values[i]);
    }
    const array_layout layout = {values, "d", sizeof *values, 1, {count}};
    return values ? array_memoryview(state, NULL, &layout) : NULL;
}

/* ---- Facts ---- */

static int set(PyObject *dictionary, const char *key, PyObject *value) {
    const int done = value && PyDict_SetItemString(dictionary, key, value) == 0;
    Py_XDECREF(value);
    return done;
}

/* None for a missing number. */
static PyObject *number(double value) {
    return isnan(value) ? module_share(Py_None) : PyFloat_FromDouble(value);
}

/* Adds the metrics of an item, NAME, NAME:ARGUMENT or a group, to the row. */
static int add_metrics(PyObject *row, const char *item, const burnish_theory_model *model,
                       const burnish_theory_difference *difference) {
    const char *colon = strchr(item, ':');
    const size_t length = colon ? (size_t)(colon - item) : strlen(item);
    const burnish_theory_metric *m;
    int found = 0;
    for (size_t i = 0; (m = burnish_theory_metric_at(i)) != NULL; ++i) {
        const int is_it = strlen(m->name) == length && strncmp(m->name, item, length) == 0;
        char key[80], suffix[16] = "";
        double argument = m->usual;
        if (is_it && colon) {
            argument = m->takes ? PyOS_string_to_double(colon + 1, NULL, NULL) : NAN;
        } else if (!is_it && strcmp(item, m->group) != 0 &&
                   (strcmp(item, "all") != 0 || strcmp(m->group, "sums") == 0)) {
            continue;
        }
        if (PyErr_Occurred()) {
            return 0;
        }
        const int is_whole = m->takes && strcmp(m->takes, "LOBES") == 0;
        if (!(argument >= m->low && argument <= m->high) ||
            (is_whole && argument != floor(argument))) {
            PyErr_Format(PyExc_ValueError, "metrics: \"%s\": the number is out of range", item);
            return 0;
        }
        if (m->takes) {
            snprintf(suffix, sizeof suffix, "_%.6g", argument);
        }
        snprintf(key, sizeof key, "%s%s", m->key, suffix);
        if (!set(row, key, number(burnish_theory_metric_value(m, model, argument, difference)))) {
            return 0;
        }
        found = 1;
    }
    if (!found) {
        PyErr_Format(PyExc_ValueError, "metrics: \"%s\": unknown metric", item);
    }
    return found;
}

PyObject *lobe_row(PyObject *module, PyObject *arguments) {
    const module_state *state = PyModule_GetState(module);
    burnish_theory_model model;
    burnish_theory_difference difference;
    burnish_error error = {0};
    const char *words;
    double exponent;
    PyObject *names;
    if (!PyArg_ParseTuple(arguments, "sdO!", &words, &exponent, &PyList_Type, &names)) {
        return NULL;
    }
    if (burnish_theory_model_parse(words, exponent, &model, &error) != BURNISH_STATUS_OK) {
        return module_fail(state, &error);
    }
    Py_BEGIN_ALLOW_THREADS;
    burnish_theory_compare(&model, acos(0), &difference);
    Py_END_ALLOW_THREADS;
    PyObject *row = PyDict_New();
    for (Py_ssize_t i = 0; row && i < PyList_Size(names); ++i) {
        const char *item;
        if (!PyArg_Parse(PyList_GetItem(names, i), "s", &item) ||
            !add_metrics(row, item, &model, &difference)) {
            Py_CLEAR(row);
        }
    }
    return row;
}

PyObject *lobe_choose(PyObject *module, PyObject *arguments) {
    const module_state *state = PyModule_GetState(module);
    burnish_theory_model model;
    burnish_theory_cost cost;
    burnish_error error = {0};
    char name[32];
    double exponent, epsilon, maximum;
    int affine;
    if (!PyArg_ParseTuple(arguments, "ddp", &exponent, &epsilon, &affine)) {
        return NULL;
    }
    if (burnish_theory_choose(exponent, epsilon, affine, &model, &cost, &maximum, &error) !=
        BURNISH_STATUS_OK) {
        return module_fail(state, &error);
    }
    burnish_lobe_spec_name(&model.lobe, name, sizeof name);
    return Py_BuildValue("{sssdsdsdsisisisisisi}", "lobe", name, "zeta", model.zeta, "scale",
                         model.scale, "max_error", maximum, "multiplications", cost.multiplications,
                         "additions", cost.additions, "comparisons", cost.comparisons, "divisions",
                         cost.divisions, "functions", cost.transcendentals, "lookups",
                         cost.lookups);
}

PyObject *lobe_words(PyObject *module, PyObject *unused) {
    (void)module, (void)unused;
    PyObject *list = PyList_New(0);
    for (size_t i = 0; list && burnish_lobe_spec_example(i); ++i) {
        PyObject *words = PyUnicode_FromString(burnish_lobe_spec_example(i));
        if (!words || PyList_Append(list, words) != 0) {
            Py_CLEAR(list);
        }
        Py_XDECREF(words);
    }
    return list;
}
