/* The machine, from /proc, /sys and the compiler. */
#include "bench/kernels/machine.h"

#include <stdio.h>
#include <string.h>

/* The text after "KEY : " in a file of such lines; 0 if it is missing. */
static int read_field(const char *path, const char *key, char *text, size_t size) {
    char line[512];
    FILE *file = fopen(path, "r");
    int found = 0;
    while (file && !found && fgets(line, sizeof line, file)) {
        const char *colon = strchr(line, ':');
        if (colon && strncmp(line, key, strlen(key)) == 0) {
            colon += 1 + strspn(colon + 1, " \t");
            snprintf(text, size, "%.*s", (int)strcspn(colon, "\n"), colon);
            found = 1;
        }
    }
    if (file) {
        fclose(file);
    }
    return found;
}

static size_t read_cache(int index, int *level) {
    char path[96], type[32] = "";
    unsigned long kilobytes = 0;
    const char *const folder = "/sys/devices/system/cpu/cpu0/cache/index";
    FILE *file;
    *level = 0;
    snprintf(path, sizeof path, "%s%d/type", folder, index);
    if ((file = fopen(path, "r")) != NULL) {
        type[fread(type, 1, sizeof type - 1, file)] = 0;
        fclose(file);
    }
    if (!*type || strncmp(type, "Instruction", 11) == 0) {
        return 0;
    }
    snprintf(path, sizeof path, "%s%d/level", folder, index);
    if ((file = fopen(path, "r")) != NULL) {
        *level = fscanf(file, "%d", level) == 1 ? *level : 0;
        fclose(file);
    }
    snprintf(path, sizeof path, "%s%d/size", folder, index);
    if ((file = fopen(path, "r")) != NULL) {
        kilobytes = fscanf(file, "%lu", &kilobytes) == 1 ? kilobytes : 0; /* "48K" */
        fclose(file);
    }
    return (size_t)kilobytes * 1024;
}

void burnish_bench_find_machine(burnish_bench_machine *machine) {
    char text[96];
    unsigned long long kilobytes = 0;
    memset(machine, 0, sizeof *machine);
    if (!read_field("/proc/cpuinfo", "model name", machine->processor, sizeof machine->processor)) {
        snprintf(machine->processor, sizeof machine->processor, "unknown processor");
    }
    for (int index = 0; index < 8; ++index) {
        int level;
        size_t bytes = read_cache(index, &level);
        if (level >= 1 && level <= 3) {
            machine->cache_bytes[level - 1] = bytes;
        }
    }
    if (read_field("/proc/meminfo", "MemAvailable", text, sizeof text) &&
        sscanf(text, "%llu", &kilobytes) == 1) {
        machine->free_bytes = (size_t)kilobytes * 1024;
    }
#if defined(__clang__)
    snprintf(machine->compiler, sizeof machine->compiler, "clang %s", __clang_version__);
#else
    snprintf(machine->compiler, sizeof machine->compiler, "gcc %s", __VERSION__);
#endif
}
