/* Time and memory of whole processes by triangles and pixels, for docs/performance.md. Usage:
 * bench_scale BURNISH FOLDER [MOST_TRIANGLES]
 *
 * The mesh is a wavy torus, written to FOLDER as an indexed binary PLY without normals and removed
 * afterwards: 19 bytes per triangle. */
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { ROUNDS = 5, ROW_SIZE = 13, PATH_SIZE = 4096, LINE_SIZE = 512 };

/* One process, as its --timing and the kernel report it. Times in ms, `processor` of all threads.
 */
typedef struct run {
    double start, read, build, transform, draw, encode, write, total, processor;
    double peak_bytes;
} run;

typedef struct bench {
    const char *burnish;
    char mesh[PATH_SIZE], picture[PATH_SIZE];
    double patience; /* seconds left to wait until nothing else runs */
    int runs, disturbed;
} bench;

static _Noreturn void fail(const char *what) {
    fprintf(stderr, "bench_scale: %s: %s\n", what, strerror(errno));
    exit(EXIT_FAILURE);
}

/* ---- the mesh ---- */

static void put32(uint8_t *to, uint32_t value) {
    for (int i = 0; i < 4; ++i) {
        to[i] = (uint8_t)(value >> 8 * i);
    }
}

static void put_float(uint8_t *to, double value) {
    float narrow = (float)value;
    uint32_t bits;
    memcpy(&bits, &narrow, sizeof bits);
    put32(to, bits);
}

static void write_vertices(FILE *file, uint32_t around, uint32_t across) {
    const double turn = 6.283185307179586;
    for (uint32_t i = 0; i < around; ++i) {
        double u = turn * i / around, cos_u = cos(u), sin_u = sin(u);
        for (uint32_t k = 0; k < across; ++k) {
            double v = turn * k / across, tube = 0.4 + 0.03 * sin(7 * u) * sin(5 * v);
            double radius = 1 + tube * cos(v);
            uint8_t bytes[12];
            put_float(bytes, radius * cos_u);
            put_float(bytes + 4, tube * sin(v));
            put_float(bytes + 8, radius * sin_u);
            fwrite(bytes, sizeof bytes, 1, file);
        }
    }
}

static void write_triangle(FILE *file, uint32_t a, uint32_t b, uint32_t c) {
    uint8_t bytes[ROW_SIZE] = {3};
    put32(bytes + 1, a);
    put32(bytes + 5, b);
    put32(bytes + 9, c);
    fwrite(bytes, sizeof bytes, 1, file);
}

/* Writes about `wanted` triangles; returns how many. */
static uint64_t write_mesh(const char *path, uint64_t wanted) {
    uint32_t across = (uint32_t)sqrt((double)wanted / 4), around = 2 * across;
    uint64_t triangles = (uint64_t)2 * around * across;
    FILE *file = fopen(path, "wb");
    if (!file) {
        fail(path);
    }
    fprintf(file,
            "ply\nformat binary_little_endian 1.0\nelement vertex %" PRIu64
            "\nproperty float x\nproperty float y\nproperty float z\nelement face %" PRIu64
            "\nproperty list uchar int vertex_indices\nend_header\n",
            triangles / 2, triangles);
    write_vertices(file, around, across);
    for (uint32_t i = 0; i < around; ++i) {
        uint32_t here = i * across, next = (i + 1) % around * across;
        for (uint32_t k = 0; k < across; ++k) {
            uint32_t beside = (k + 1) % across;
            write_triangle(file, here + k, here + beside, next + k);
            write_triangle(file, next + k, here + beside, next + beside);
        }
    }
    if (ferror(file) || fclose(file) != 0) {
        fail(path);
    }
    return triangles;
}

/* ---- runs ---- */

/* Ticks of all processors since the start: idle ones and all. Returns 0 if unknown. */
static int read_ticks(double *idle, double *all) {
    FILE *file = fopen("/proc/stat", "r");
    double ticks[8] = {0};
    int read = 0;
    if (file) {
        /* user nice system idle iowait irq softirq steal */
        read = fscanf(file, "cpu %lf %lf %lf %lf %lf %lf %lf %lf", &ticks[0], &ticks[1], &ticks[2],
                      &ticks[3], &ticks[4], &ticks[5], &ticks[6], &ticks[7]);
        fclose(file);
    }
    *idle = ticks[3] + ticks[4];
    *all = 0;
    for (int i = 0; i < 8; ++i) {
        *all += ticks[i];
    }
    return read == 8;
}

/* Waits until the processors were idle for a tenth of a second, at most *budget seconds, which it
 * counts down. Returns 0 if they are still busy, 1 also if that is unknown. */
static int wait_until_quiet(double *budget) {
    const double pause = 0.1, enough = 0.85; /* one tick of a core is a tenth of the pause */
    for (;;) {
        double idle[2], all[2];
        if (!read_ticks(&idle[0], &all[0])) {
            return 1;
        }
        usleep((useconds_t)(pause * 1e6));
        if (!read_ticks(&idle[1], &all[1]) || idle[1] - idle[0] >= enough * (all[1] - all[0])) {
            return 1;
        }
        if (*budget <= 0) {
            return 0;
        }
        *budget -= pause;
    }
}

static double milliseconds(struct timeval time) {
    return 1e3 * (double)time.tv_sec + 1e-3 * (double)time.tv_usec;
}

static void read_line(int descriptor, char *line) {
    size_t used = 0;
    ssize_t got;
    while (used + 1 < LINE_SIZE &&
           (got = read(descriptor, line + used, LINE_SIZE - 1 - used)) > 0) {
        used += (size_t)got;
    }
    line[used] = '\0';
}

static run render(bench *b, const char *resolution) {
    int ends[2], status;
    struct rusage usage;
    char line[LINE_SIZE];
    run r;
    ++b->runs;
    b->disturbed += !wait_until_quiet(&b->patience);
    if (pipe(ends) != 0) {
        fail("pipe");
    }
    pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], STDERR_FILENO);
        close(ends[0]);
        close(ends[1]);
        execl(b->burnish, b->burnish, "render", b->mesh, "-o", b->picture, resolution,
              "--samples=1", "--timing", "--max-input-bytes=64G", (char *)NULL);
        _exit(127);
    }
    close(ends[1]);
    read_line(ends[0], line);
    close(ends[0]);
    if (child < 0 || wait4(child, &status, 0, &usage) != child) {
        fail("wait4");
    }
    if (status != 0 ||
        sscanf(line,
               "burnish: start %lf ms, read %lf ms, build %lf ms, transform %lf ms, draw %lf ms, "
               "encode %lf ms, write %lf ms, total %lf ms",
               &r.start, &r.read, &r.build, &r.transform, &r.draw, &r.encode, &r.write,
               &r.total) != 8) {
        fprintf(stderr, "bench_scale: %s failed: %s\n", b->burnish, line);
        exit(EXIT_FAILURE);
    }
    r.processor = milliseconds(usage.ru_utime) + milliseconds(usage.ru_stime);
    r.peak_bytes = 1024.0 * (double)usage.ru_maxrss;
    return r;
}

static int compare_totals(const void *a, const void *b) {
    double first = ((const run *)a)->total, second = ((const run *)b)->total;
    return (first > second) - (first < second);
}

/* The run with the median total. */
static run median(bench *b, const char *resolution, int rounds) {
    run runs[ROUNDS];
    for (int i = 0; i < rounds; ++i) {
        runs[i] = render(b, resolution);
    }
    qsort(runs, (size_t)rounds, sizeof *runs, compare_totals);
    return runs[rounds / 2];
}

static void print_row(const char *name, double work, const run *r) {
    printf("| %s | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.0f | %.0f | %.0f |\n", name, r->read,
           r->build, r->transform + r->draw, r->encode + r->write, r->total, r->processor,
           1e6 * r->processor / work, r->peak_bytes / 1e6, r->peak_bytes / work);
}

static void print_head(const char *work, const char *per) {
    printf("| %s | read | build | draw | encode, write | total | processor | ns %s | peak MB | "
           "bytes %s |\n| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n",
           work, per, per);
}

static void bench_triangles(bench *b, uint64_t most) {
    printf("### Triangles\n\nA wavy torus without normals as binary PLY, 1920x1080, one sample "
           "per pixel.\n\n");
    print_head("triangles", "per triangle");
    for (uint64_t wanted = 10000; wanted <= most; wanted *= 10) {
        char name[32];
        uint64_t triangles = write_mesh(b->mesh, wanted);
        run r = median(b, "--resolution=1920,1080", wanted < 10000000 ? ROUNDS : 1);
        snprintf(name, sizeof name, "%" PRIu64, triangles);
        print_row(name, (double)triangles, &r);
        fflush(stdout);
        unlink(b->mesh);
    }
}

static void bench_pixels(bench *b, int largest) {
    printf("\n### Pixels\n\nThe torus of about 100,000 triangles.\n\n");
    print_head("pixels", "per pixel");
    write_mesh(b->mesh, 100000);
    for (int size = 256; size <= largest; size *= 2) {
        char resolution[64], name[64];
        snprintf(resolution, sizeof resolution, "--resolution=%d,%d", size, size);
        snprintf(name, sizeof name, "%d x %d", size, size);
        run r = median(b, resolution, size < 8192 ? ROUNDS : 1);
        print_row(name, (double)size * size, &r);
        fflush(stdout);
    }
    unlink(b->mesh);
}

int main(int count, char **arguments) {
    bench b = {.patience = 90};
    uint64_t most = count > 3 ? strtoull(arguments[3], NULL, 10) : 100000000;
    int largest = 16384;
    if (most < 1000000) { /* a short form, whose numbers nobody reads */
        b.patience = 0;
        largest = 1024;
    }
    if (count < 3) {
        fprintf(stderr, "usage: bench_scale BURNISH FOLDER [MOST_TRIANGLES]\n");
        return 2;
    }
    b.burnish = arguments[1];
    snprintf(b.mesh, sizeof b.mesh, "%s/scale.ply", arguments[2]);
    snprintf(b.picture, sizeof b.picture, "%s/scale.png", arguments[2]);
    printf("Whole processes with all %ld processors, ms; the median of %d, from 10,000,000 "
           "triangles or 8192 x 8192\npixels one run. Processor: the time of all threads "
           "together; the column after it divides it by the work.\n\n",
           sysconf(_SC_NPROCESSORS_ONLN), ROUNDS);
    bench_triangles(&b, most);
    bench_pixels(&b, largest);
    unlink(b.picture);
    if (b.disturbed > 0) {
        printf("\nOther programs used the machine in %d of %d runs: only the column processor is "
               "reliable.\n",
               b.disturbed, b.runs);
    }
    return EXIT_SUCCESS;
}
