/* Rate of burnish batch: 200 meshes of 5,000 triangles (binary STL), 256 x 256, one thread per
 * picture.
 * Usage: bench_batch BURNISH FOLDER [ROUNDS]
 *   FOLDER  for the meshes and their pictures
 * Prints a table: medians of ROUNDS batches of each look, in turns. Other programs on the machine
 * lengthen processor time a little, and wall time, which is not reported, a lot. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "torus.h"

enum { GRID = 50, FILES = 200, ROUNDS = 5, LOOKS = 2, PATH_MAX_BYTES = 1024 };

static const char *const look_flags[LOOKS] = {"--look=plain", "--look=studio"};
static const char *const look_names[LOOKS] = {"`--look=plain`",
                                              "the default, with ambient occlusion"};

__attribute__((noreturn)) static void fail(const char *what) {
    fprintf(stderr, "bench_batch: %s\n", what);
    exit(1);
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Rings from flat to high: no two files are the same. */
static void write_meshes(const char *folder) {
    mkdir(folder, 0777);
    for (int i = 0; i < FILES; ++i) {
        char path[PATH_MAX_BYTES + 16];
        torus t = make_torus(GRID);
        for (size_t k = 0; k < t.grid * t.grid; ++k) {
            t.positions[3 * k + 2] *= 0.5 + 2.0 * i / FILES;
        }
        bytes file = write_stl(&t, 0);
        snprintf(path, sizeof path, "%s/%03d.stl", folder, i);
        FILE *stream = fopen(path, "wb");
        if (!stream || fwrite(file.data, file.size, 1, stream) != 1 || fclose(stream) != 0) {
            fail("the folder can't be written");
        }
        free(file.data);
        torus_destroy(&t);
    }
}

static double processor_ms(const struct rusage *usage) {
    return 1e3 * (double)(usage->ru_utime.tv_sec + usage->ru_stime.tv_sec) +
           1e-3 * (double)(usage->ru_utime.tv_usec + usage->ru_stime.tv_usec);
}

/* Processor time of a batch, all its processes together, in ms. */
static double run(const char *burnish, const char *meshes, const char *pictures, const char *look) {
    struct rusage usage;
    int state;
    const pid_t process = fork();
    if (process == 0) {
        if (!freopen("/dev/null", "w", stdout) || !freopen("/dev/null", "w", stderr)) {
            _exit(126);
        }
        execl(burnish, burnish, "batch", meshes, "--size=256", "--force", "-d", pictures, look,
              (char *)NULL);
        _exit(127);
    }
    if (process < 0 || wait4(process, &state, 0, &usage) != process || state != 0) {
        fail("burnish batch did not draw");
    }
    return processor_ms(&usage);
}

int main(int argc, char **argv) {
    const int rounds = argc > 3 ? atoi(argv[3]) : ROUNDS;
    char meshes[PATH_MAX_BYTES], pictures[PATH_MAX_BYTES];
    if (argc < 3 || rounds < 1) {
        fail("usage: bench_batch BURNISH FOLDER [ROUNDS]");
    }
    snprintf(meshes, sizeof meshes, "%s/meshes", argv[2]);
    snprintf(pictures, sizeof pictures, "%s/pictures", argv[2]);
    write_meshes(meshes);
    double *times = malloc(LOOKS * (size_t)rounds * sizeof *times);
    for (int i = 0; i < rounds && times; ++i) {
        for (int look = 0; look < LOOKS; ++look) {
            times[look * rounds + i] = run(argv[1], meshes, pictures, look_flags[look]) / FILES;
        }
    }
    printf("| | a picture | two cores would draw |\n| --- | --- | --- |\n");
    for (int look = 0; look < LOOKS && times; ++look) {
        double *own = times + (size_t)look * (size_t)rounds;
        qsort(own, (size_t)rounds, sizeof *own, compare);
        const double median = own[rounds / 2];
        printf("| %s | %.1f ms | %.0f a second |\n", look_names[look], median, 2000 / median);
    }
    free(times);
    return 0;
}
