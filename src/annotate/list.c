/* The list of lines and labels. */
#include <string.h>

#include "annotate/annotate.h"
#include "image/text/text.h"

void burnish_annotation_add_line(burnish_annotation_list *list, burnish_point a, burnish_point b,
                                 double width, burnish_annotation_layer layer) {
    list->lines = burnish_reserve(list->memory, list->lines, &list->line_capacity,
                                  list->line_count + 1, sizeof *list->lines, "annotations");
    if (list->memory->status != BURNISH_STATUS_OK) {
        return;
    }
    list->lines[list->line_count++] = (burnish_annotation_line){
        {(float)a.x, (float)a.y, (float)b.x, (float)b.y, (float)(width / 2)}, layer};
}

/* The nearest whole number. From 2^52 on all are whole; a camera within the object sees as far. */
static double whole(double value) {
    if (!(value > -0x1p52 && value < 0x1p52)) {
        return value;
    }
    return value < 0 ? -(double)(int64_t)(0.5 - value) : (double)(int64_t)(value + 0.5);
}

burnish_annotation_label burnish_annotation_label_at(const burnish_annotation_view *view,
                                                     const char *text, burnish_point middle,
                                                     burnish_annotation_layer layer) {
    static const uint8_t unused[3] = {0};
    burnish_annotation_label label = {.layer = layer};
    const size_t length = strlen(text);
    memcpy(label.text, text, length + 1);
    const double width =
        burnish_text_draw(NULL, 0, 0, (float)view->text, unused, label.text, length);
    label.x = whole(middle.x - width / 2);
    label.baseline = whole(middle.y + view->text / 2);
    label.area =
        (burnish_area){label.x, label.baseline - view->text, label.x + width, label.baseline};
    return label;
}

int burnish_annotation_is_free(const burnish_annotation_list *list, const burnish_area *area) {
    for (size_t i = 0; i < list->label_count; ++i) {
        if (burnish_areas_touch(area, &list->labels[i].area)) {
            return 0;
        }
    }
    for (size_t i = 0; i < list->mark_count; ++i) {
        if (burnish_areas_touch(area, &list->marks[i])) {
            return 0;
        }
    }
    for (size_t i = 0; i < list->line_count; ++i) {
        const burnish_stroke *s = &list->lines[i].stroke;
        const burnish_area reach = burnish_area_grown(*area, (double)s->radius);
        if (burnish_segment_hits((burnish_point){(double)s->x0, (double)s->y0},
                                 (burnish_point){(double)s->x1, (double)s->y1}, &reach)) {
            return 0;
        }
    }
    return 1;
}
