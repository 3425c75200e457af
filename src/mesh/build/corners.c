/* The corners of every welded position: a counting sort. Threads count slices of the corners
 *     separately. The corners of a position are listed in the order of the slices, which is the
 *     order of the triangles. */
#include "mesh/build/builder.h"

enum {
    SLICES_MAX = 4,  /* each has counts of all positions */
    RANGES_MAX = 16, /* of positions, whose counts are added up together */
    CROWD = 64       /* more corners than that are counted for burnish_mesh_data.crowded_max */
};

typedef struct corner_lister {
    burnish_builder *b;
    size_t slices;
    uint32_t *counts[SLICES_MAX]; /* for each slice and position, the count of its corners; later
                                     where the next one goes, so the last slice leaves the ends */
    size_t ranges;                /* of positions, with ... */
    size_t sums[RANGES_MAX];      /* ... their corners, then those before them, and ... */
    size_t most[RANGES_MAX];      /* ... the most of one position, and ... */
    size_t crowded[RANGES_MAX];   /* ... those of positions with more than CROWD */
} corner_lister;

static size_t part_of(size_t count, size_t part, size_t parts) {
    return part < parts ? count / parts * part : count;
}

/* Runs the work on a slice's corners, some at a time. */
static void run_slice(corner_lister *lister, size_t slice, int thread,
                      void (*work)(corner_lister *lister, uint32_t *counts, size_t first,
                                   size_t end)) {
    burnish_tasks *tasks = lister->b->data->tasks;
    const size_t corners = 3 * lister->b->triangle_count;
    const size_t last = part_of(corners, slice + 1, lister->slices);
    for (size_t i = part_of(corners, slice, lister->slices), end; i < last; i = end) {
        end = last - i < BURNISH_BUILD_STEP ? last : i + BURNISH_BUILD_STEP;
        work(lister, lister->counts[slice], i, end);
        if (burnish_tasks_should_end(tasks, thread)) {
            return;
        }
    }
}

static void count_corners(corner_lister *lister, uint32_t *counts, size_t first, size_t end) {
    const uint32_t *positions = lister->b->corner_positions;
    for (size_t i = first; i < end; ++i) {
        ++counts[positions[i]];
    }
}

static void place_corners(corner_lister *lister, uint32_t *counts, size_t first, size_t end) {
    const uint32_t *positions = lister->b->corner_positions;
    uint32_t *corners = lister->b->corners;
    for (size_t i = first; i < end; ++i) {
        corners[counts[positions[i]]++] = (uint32_t)i;
    }
}

static void count_slice(void *context, size_t slice, int thread) {
    corner_lister *lister = context;
    memset(lister->counts[slice], 0, lister->b->position_count * sizeof(uint32_t));
    run_slice(lister, slice, thread, count_corners);
}

static void place_slice(void *context, size_t slice, int thread) {
    run_slice(context, slice, thread, place_corners);
}

static void sum_range(void *context, size_t range, int thread) {
    corner_lister *lister = context;
    const size_t positions = lister->b->position_count;
    size_t sum = 0;
    (void)thread;
    for (size_t i = part_of(positions, range, lister->ranges),
                end = part_of(positions, range + 1, lister->ranges);
         i < end; ++i) {
        for (size_t slice = 0; slice < lister->slices; ++slice) {
            sum += lister->counts[slice][i];
        }
    }
    lister->sums[range] = sum;
}

/* Turns counts into the offsets of first corners: position by position, slice by slice. */
static void start_range(void *context, size_t range, int thread) {
    corner_lister *lister = context;
    const size_t positions = lister->b->position_count;
    uint32_t next = (uint32_t)lister->sums[range], most = 0, crowded = 0;
    (void)thread;
    for (size_t i = part_of(positions, range, lister->ranges),
                end = part_of(positions, range + 1, lister->ranges);
         i < end; ++i) {
        const uint32_t start = next;
        for (size_t slice = 0; slice < lister->slices; ++slice) {
            uint32_t *count = &lister->counts[slice][i];
            const uint32_t corners = *count;
            *count = next;
            next += corners;
        }
        most = next - start > most ? next - start : most;
        crowded += next - start > CROWD ? next - start : 0;
    }
    lister->most[range] = most;
    lister->crowded[range] = crowded;
}

static void add_sums(corner_lister *lister) {
    size_t before = 0;
    for (size_t i = 0; i < lister->ranges; ++i) {
        const size_t sum = lister->sums[i];
        lister->sums[i] = before;
        before += sum;
    }
}

static burnish_status run_slices(corner_lister *lister, size_t count, burnish_task *task) {
    burnish_tasks *tasks = lister->b->data->tasks;
    burnish_tasks_run(tasks, count, 1, 0, task, lister);
    return burnish_tasks_check(tasks, lister->b->memory->error);
}

static burnish_status check_crowded(const burnish_builder *b, uint64_t crowded) {
    const uint64_t most = b->data->crowded_max;
    return most == 0 || crowded <= most
               ? BURNISH_STATUS_OK
               : burnish_fail(b->memory->error, BURNISH_STATUS_LIMIT,
                              "%s: too many triangles meet in the same vertices: %llu corners at "
                              "those of more than %d triangles, and %llu are the limit; set "
                              "--max-triangles to draw them, or leave out repeated triangles",
                              burnish_show_name(b->name).text, (unsigned long long)crowded, CROWD,
                              (unsigned long long)most);
}

static burnish_status list_corners(corner_lister *lister) {
    burnish_builder *b = lister->b;
    uint64_t crowded = 0;
    burnish_status status = run_slices(lister, lister->slices, count_slice);
    if (status == BURNISH_STATUS_OK && lister->ranges > 1) {
        status = run_slices(lister, lister->ranges, sum_range);
    }
    if (status == BURNISH_STATUS_OK) {
        add_sums(lister);
        status = run_slices(lister, lister->ranges, start_range);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (size_t i = 0; i < lister->ranges; ++i) {
        b->max_faces = lister->most[i] > b->max_faces ? lister->most[i] : b->max_faces;
        crowded += lister->crowded[i];
    }
    status = check_crowded(b, crowded);
    return status == BURNISH_STATUS_OK ? run_slices(lister, lister->slices, place_slice) : status;
}

burnish_status burnish_build_list_corners(burnish_builder *b) {
    const size_t corner_count = 3 * b->triangle_count;
    const size_t threads = (size_t)burnish_tasks_threads(b->data->tasks),
                 worth = b->triangle_count / BURNISH_BUILD_GRAIN,
                 most = threads < SLICES_MAX ? threads : SLICES_MAX;
    corner_lister lister = {.b = b, .slices = worth <= 1 ? 1 : worth < most ? worth : most};
    lister.ranges = lister.slices == 1 ? 1 : RANGES_MAX;
    b->first_corner =
        burnish_allocate(b->memory, b->position_count + 1, sizeof *b->first_corner, "vertices");
    b->corners = burnish_allocate(b->memory, corner_count, sizeof *b->corners, "vertices");
    for (size_t i = 0; i + 1 < lister.slices; ++i) {
        lister.counts[i] =
            burnish_allocate(b->memory, b->position_count, sizeof *lister.counts[i], "vertices");
    }
    burnish_status status = b->memory->status;
    if (status == BURNISH_STATUS_OK) {
        b->first_corner[0] = 0;
        lister.counts[lister.slices - 1] = b->first_corner + 1;
        status = list_corners(&lister);
    }
    for (size_t i = 0; i + 1 < lister.slices; ++i) {
        burnish_release(b->memory->context, lister.counts[i]);
    }
    return status;
}
