/* How many processors this process may use. */
#include <pthread.h>
#include <sched.h>
#include <stdio.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#else
#include <unistd.h>
#endif

#include "core/processors.h"
#include "core/tasks.h"

int burnish_quota_processors(const char *text) {
    long long quota, period;
    if (sscanf(text, "%lld %lld", &quota, &period) != 2 || quota <= 0 || period <= 0) {
        return 0; /* "max 100000", or no such file */
    }
    const long long whole = (quota + period - 1) / period;
    return whole < BURNISH_THREADS_MAX ? (int)whole : BURNISH_THREADS_MAX;
}

#ifdef __linux__
/* The first bytes of a file as text; "" where it can't be read. */
static void read_text(const char *path, char *text, size_t size) {
    FILE *file = fopen(path, "re");
    size_t length = file ? fread(text, 1, size - 1, file) : 0;
    text[length] = 0;
    if (file) {
        fclose(file);
    }
}

static int smaller(int a, int b) {
    return a > 0 && (b == 0 || a < b) ? a : b;
}

/* The least quota of the process' control group (version 2) and those above it; 0 for none. */
static int read_quota_of_groups(void) {
    static const char ROOT[] = "/sys/fs/cgroup";
    char groups[4096], path[4400], text[128];
    int least = 0;
    read_text("/proc/self/cgroup", groups, sizeof groups);
    char *group = strstr(groups, "0::/");
    if (!group) {
        return 0;
    }
    group += 3;
    group[strcspn(group, "\n")] = 0;
    for (;;) {
        snprintf(path, sizeof path, "%s%s/cpu.max", ROOT, strcmp(group, "/") == 0 ? "" : group);
        read_text(path, text, sizeof text);
        least = smaller(burnish_quota_processors(text), least);
        char *slash = strrchr(group, '/');
        if (!slash || strcmp(group, "/") == 0) {
            return least;
        }
        slash[slash == group] = 0; /* "/" is the last one */
    }
}

/* The same for version 1, whose controller is mounted with the container's group as its root. */
static int read_quota_version_1(void) {
    char quota[64], period[64], text[160];
    read_text("/sys/fs/cgroup/cpu/cpu.cfs_quota_us", quota, sizeof quota);
    read_text("/sys/fs/cgroup/cpu/cpu.cfs_period_us", period, sizeof period);
    snprintf(text, sizeof text, "%s %s", quota, period);
    return burnish_quota_processors(text);
}
#endif

static int quota; /* 0: none */

static void read_quota(void) {
#ifdef __linux__
    quota = smaller(read_quota_of_groups(), read_quota_version_1());
#endif
}

/* The processors that are on, or at least 1. */
static int count_online(void) {
#ifdef _WIN32
    DWORD_PTR own, all;
    if (GetProcessAffinityMask(GetCurrentProcess(), &own, &all)) {
        const int count = __builtin_popcountll(own);
        return count > 1 ? count : 1;
    }
    return 1;
#else
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online < 1 ? 1 : online < BURNISH_THREADS_MAX ? (int)online : BURNISH_THREADS_MAX;
#endif
}

int burnish_processor_count(void) {
    static pthread_once_t once = PTHREAD_ONCE_INIT; /* a quota hardly changes; files are slow */
    int count = 0;                                  /* unknown */
    pthread_once(&once, read_quota);
#ifdef CPU_COUNT
    cpu_set_t processors;
    if (sched_getaffinity(0, sizeof processors, &processors) == 0) {
        count = CPU_COUNT(&processors);
    }
#endif
    count = count < 1 ? count_online() : count;
    return quota > 0 && quota < count ? quota : count;
}
