/* Sorting in place, in O(n log n) whatever the input, and O(n) when it is sorted already. Included
 * once per type, without a guard:
 *
 * SORT_TYPE:          the type of an item
 * SORT_NAME(name):    the name of this type's function
 * SORT_LESS(a, b):    whether *a comes before *b; the order is total
 * SORT_INSERTION_MAX: up to so many items insertion sort is faster */

static void SORT_NAME(insert)(SORT_TYPE *items, size_t count) {
    for (size_t i = 1; i < count; ++i) {
        const SORT_TYPE item = items[i];
        size_t j = i;
        for (; j > 0 && SORT_LESS(&item, &items[j - 1]); --j) {
            items[j] = items[j - 1];
        }
        items[j] = item;
    }
}

static void SORT_NAME(sift_down)(SORT_TYPE *heap, size_t root, size_t count) {
    const SORT_TYPE item = heap[root];
    for (size_t child; (child = 2 * root + 1) < count; root = child) {
        child += child + 1 < count && SORT_LESS(&heap[child], &heap[child + 1]);
        if (!SORT_LESS(&item, &heap[child])) {
            break;
        }
        heap[root] = heap[child];
    }
    heap[root] = item;
}

static void SORT_NAME(heap)(SORT_TYPE *items, size_t count) {
    for (size_t i = count / 2; i > 0; --i) {
        SORT_NAME(sift_down)(items, i - 1, count);
    }
    for (size_t i = count - 1; i > 0; --i) {
        const SORT_TYPE last = items[i];
        items[i] = items[0];
        items[0] = last;
        SORT_NAME(sift_down)(items, 0, i);
    }
}

static void SORT_NAME(array)(SORT_TYPE *items, size_t count) {
    if (count <= SORT_INSERTION_MAX) {
        SORT_NAME(insert)(items, count);
        return;
    }
    for (size_t i = 1; i < count; ++i) {
        if (SORT_LESS(&items[i], &items[i - 1])) {
            SORT_NAME(heap)(items, count);
            return;
        }
    }
}

#undef SORT_TYPE
#undef SORT_NAME
#undef SORT_LESS
#undef SORT_INSERTION_MAX
