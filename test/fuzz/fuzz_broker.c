/* Fuzzes the sandbox's broker: libFuzzer's bytes are the messages of a compromised worker
 * (sandbox/channel.h). It must receive nothing of the secret next to the input's folder, write no
 * file but the two outputs, and leave no descriptor open.
 *
 * byte 0:    1: the input needs an importer; none is installed
 * the rest:  messages
 *
 * Built by `make fuzz`; test/fuzz/run starts it. */
#include "lying_worker.h"

#include <signal.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static lying_box box;
static int home; /* the folder in which libFuzzer names its files */

static void remove_box(void) {
    lying_end(&box);
}

static void require(int condition, const char *what) {
    if (!condition) {
        fprintf(stderr, "fuzz_broker: %s\n", what);
        abort();
    }
}

static int next_descriptor(void) {
    const int next = dup(STDERR_FILENO);
    close(next);
    return next;
}

static void begin(void) {
    home = open(".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    require(lying_begin(&box), "no folder");
    setenv("BURNISH_IMPORTERS", box.path, 1);
    signal(SIGPIPE, SIG_IGN);
    atexit(remove_box);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char secret[sizeof LYING_SECRET] = "";
    if (memmem(data, size, LYING_SECRET, strlen(LYING_SECRET))) {
        return 0; /* libFuzzer knows the secret from comparisons, and messages quote names */
    }
    if (!*box.path) {
        begin();
    }
    require(chdir(box.path) == 0, "no folder");
    box.plan.input = size > 0 && (data[0] & 1) ? "in/mesh.fbx" : "in/mesh.gltf";
    const int before = next_descriptor();
    lying_remove_outputs();
    const broker_state state =
        lying_run(&box, (void *)(uintptr_t)(data + (size > 0)), size - (size > 0), -1);
    require(state == BROKER_GONE || state == BROKER_VIOLATION, "it has not ended");
    require(!lying_has_secret(&box), "the secret is told");
    require(lying_count_files(&box) == LYING_FILES, "another file is there, or one is missing");
    require(next_descriptor() == before, "a descriptor is open");
    FILE *file = fopen("secret.txt", "r");
    require(file && fgets(secret, sizeof secret, file) && strcmp(secret, LYING_SECRET) == 0,
            "the secret was changed");
    fclose(file);
    require(fchdir(home) == 0, "no folder");
    return 0;
}
