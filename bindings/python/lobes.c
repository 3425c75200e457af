/* Lobes: their values, with the bits of pictures, and facts of theory.h and `burnish lobe`. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/kernels.h"
#include "burnish/theory.h"
#include "lobe/lists.h"
#include "lobe/lobe.h"
#include "lobe/metrics.h"
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
    return isnan(value) ? Py_NewRef(Py_None) : PyFloat_FromDouble(value);
}

static PyObject *row_of(const lobe_metric_list *metrics, const lobe_facts *facts) {
    PyObject *row = PyDict_New();
    for (size_t i = 0; i < metrics->count && row; ++i) {
        cli_column column;
        lobe_metric_column(&metrics->items[i], &column);
        if (!set(row, column.key, number(lobe_metric_value(&metrics->items[i], facts)))) {
            Py_CLEAR(row);
        }
    }
    return row;
}

PyObject *lobe_row(PyObject *module, PyObject *arguments) {
    const module_state *state = PyModule_GetState(module);
    lobe_metric_list metrics;
    lobe_facts facts;
    burnish_error error = {0};
    const char *words, *names;
    double exponent;
    if (!PyArg_ParseTuple(arguments, "sds", &words, &exponent, &names)) {
        return NULL;
    }
    if (burnish_theory_model_parse(words, exponent, &facts.model, &error) != BURNISH_STATUS_OK ||
        lobe_read_metrics("metrics", names, &metrics, &error) != BURNISH_STATUS_OK) {
        return module_fail(state, &error);
    }
    Py_BEGIN_ALLOW_THREADS;
    burnish_theory_compare(&facts.model, CLI_RIGHT_ANGLE, &facts.difference);
    facts.cost = burnish_theory_model_cost(&facts.model);
    Py_END_ALLOW_THREADS;
    return row_of(&metrics, &facts);
}

PyObject *lobe_choose(PyObject *module, PyObject *arguments) {
    const module_state *state = PyModule_GetState(module);
    burnish_theory_model model;
    burnish_theory_cost cost;
    burnish_error error = {0};
    char name[LOBE_NAME];
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
