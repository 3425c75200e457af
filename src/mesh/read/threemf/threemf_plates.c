/* The plates of a print project. Files place them side by side at a distance of their size and a
 * fifth (PartPlate.cpp of Bambu Studio), or in growing squares with a gap (MultipleBeds.cpp of
 * PrusaSlicer); several are drawn closer together. */
#include "mesh/read/threemf/threemf.h"

#if BURNISH_HAS_3MF

#define STRIDE 1.2 /* from plate to plate, in sizes of one */
#define GAP 0.25   /* between drawn plates, as a part of the longest side of what is on one */

enum { BEDS_PER_SIDE = 3 };

/* Columns of a grid of plates. */
static size_t columns_of(size_t count) {
    size_t columns = 1;
    while (columns * columns < count) {
        ++columns;
    }
    return columns;
}

/* The plate at a position, for an item that none lists. NONE: beside them. */
static uint32_t plate_at(const burnish_threemf *threemf, const double matrix[12]) {
    const int64_t count = (int64_t)threemf->plates.count;
    const int64_t columns = (int64_t)columns_of(threemf->plates.count);
    double size[2], squares = 0;
    int64_t cell[2];
    for (int k = 0; k < 2; ++k) {
        size[k] = (double)threemf->bed[1][k] - (double)threemf->bed[0][k];
        squares += size[k] * size[k];
    }
    const double gap = 9 * squares < 1e6 ? 0.3 * __builtin_sqrt(squares) : 100;
    for (int k = 0; k < 2; ++k) {
        const double step = threemf->has_beds ? size[k] + gap : STRIDE * size[k];
        const double from = matrix[4 * k + 3] - (double)threemf->bed[0][k];
        const double at = size[k] > 0 ? from / step : 0;
        if (!(at > -1024 && at < 1024)) {
            return BURNISH_THREEMF_NONE;
        }
        cell[k] = (int64_t)(at + 1024) - 1024; /* rounds down */
        if (threemf->has_beds &&
            (cell[k] < 0 || cell[k] >= BEDS_PER_SIDE || from - (double)cell[k] * step > size[k])) {
            return BURNISH_THREEMF_NONE;
        }
    }
    if (threemf->has_beds) {
        return (uint32_t)(cell[1] < cell[0] ? cell[0] * cell[0] + cell[1]
                                            : cell[1] * cell[1] + cell[1] + cell[0]);
    }
    return cell[0] >= 0 && cell[0] < columns && cell[1] <= 0 && cell[0] - cell[1] * columns < count
               ? (uint32_t)(cell[0] - cell[1] * columns)
               : BURNISH_THREEMF_NONE;
}

/* Lists PrusaSlicer's beds up to the last that is in use, if it is not the only one. Returns 0 on
 * failure. */
static int list_beds(burnish_threemf *threemf) {
    uint32_t count = 0;
    for (size_t i = 0; i < threemf->items.count; ++i) {
        const uint32_t bed = plate_at(threemf, threemf->items.items[i].matrix);
        count = bed != BURNISH_THREEMF_NONE && bed >= count ? bed + 1 : count;
    }
    for (uint32_t i = 0; i < count && count > 1; ++i) {
        burnish_plate *plate = BURNISH_THREEMF_APPEND(threemf, &threemf->plates);
        if (!plate) {
            return 0;
        }
        plate->number = (int)i + 1;
    }
    return 1;
}

static int has_plate(const burnish_threemf *threemf, int number) {
    for (size_t i = 0; i < threemf->plates.count; ++i) {
        if (threemf->plates.items[i].number == number) {
            return 1;
        }
    }
    return 0;
}

int burnish_threemf_choose_plates(burnish_threemf *threemf) {
    const int wanted = threemf->reader->input->options->plate;
    if (threemf->has_beds && !list_beds(threemf)) {
        return 0;
    }
    const size_t count = threemf->plates.count;
    const int is_known = count > 1 || threemf->instances.count > 0;
    size_t left = threemf->items.count;
    for (size_t i = 0; i < threemf->items.count && count > 0; ++i) {
        burnish_threemf_placement *item = &threemf->items.items[i];
        if (item->plate == BURNISH_THREEMF_NONE) {
            item->plate = is_known ? plate_at(threemf, item->matrix) : 0;
        }
        if (item->plate == BURNISH_THREEMF_NONE) {
            item->is_unprinted = 1;
        }
        if (wanted > 0 && (item->plate == BURNISH_THREEMF_NONE ||
                           threemf->plates.items[item->plate].number != wanted)) {
            item->object = BURNISH_THREEMF_NONE;
            --left;
        }
    }
    if (wanted > 0 && count > 0 && !has_plate(threemf, wanted)) {
        threemf->status = burnish_reader_fail(threemf->reader, BURNISH_STATUS_ARGUMENT, NULL,
                                              "plate %d does not exist; its plates are %d to %d",
                                              wanted, threemf->plates.items[0].number,
                                              threemf->plates.items[count - 1].number);
    }
    if (threemf->status == BURNISH_STATUS_OK && left == 0 && threemf->items.count > 0) {
        threemf->status = burnish_reader_fail(threemf->reader, BURNISH_STATUS_ARGUMENT, NULL,
                                              "plate %d is empty; draw another", wanted);
    }
    return threemf->status == BURNISH_STATUS_OK;
}

static int is_used(const burnish_threemf *threemf, size_t plate) {
    return threemf->plate_boxes[plate][0][0] <= threemf->plate_boxes[plate][1][0];
}

void burnish_threemf_place_plates(burnish_threemf *threemf) {
    double size[2] = {0, 0}, first[2] = {0, 0}; /* of a cell; the middle of the first plate */
    size_t used = 0, cell = 0;
    for (size_t i = 0; i < threemf->plates.count; ++i) {
        double(*box)[2] = threemf->plate_boxes[i];
        for (int k = 0; k < 2 && is_used(threemf, i); ++k) {
            size[k] = box[1][k] - box[0][k] > size[k] ? box[1][k] - box[0][k] : size[k];
            first[k] = used == 0 ? (box[0][k] + box[1][k]) / 2 : first[k];
        }
        used += (size_t)is_used(threemf, i);
    }
    const size_t columns = columns_of(used);
    const double gap = GAP * (size[0] > size[1] ? size[0] : size[1]);
    for (size_t i = 0; i < threemf->plates.count; ++i) {
        double(*box)[2] = threemf->plate_boxes[i];
        const double at[2] = {(double)(cell % columns), -(double)(cell / columns)};
        for (int k = 0; k < 2 && is_used(threemf, i); ++k) { /* rows go toward the viewer */
            threemf->plates.items[i].shift[k] =
                first[k] + at[k] * (size[k] + gap) - (box[0][k] + box[1][k]) / 2;
        }
        cell += (size_t)is_used(threemf, i);
    }
}

#endif
