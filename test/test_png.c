/* PNG files against libpng, and outputs that appear whole or not at all. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <png.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "burnish/image.h"
#include "support.h"

#define CHECK_STATUS(call, expected) CHECK((call) == (expected), "not the expected status")

static char folder[] = TEST_BINARY_DIR "/png_test_XXXXXX";

static burnish_image make(int width, int height, int channels) {
    burnish_image image;
    if (burnish_image_create(&image, width, height, channels, NULL) != BURNISH_STATUS_OK) {
        exit(EXIT_FAILURE);
    }
    size_t stride = (size_t)width * (size_t)channels;
    uint64_t state = test_seed((unsigned)(width * 31 + height));
    for (size_t i = 0; i < stride * (size_t)height; ++i) {
        uint8_t noise = (uint8_t)test_random32(&state);
        /* Noise, runs and gradients, so that every kind of deflate block occurs. */
        size_t row = i / stride;
        image.pixels[i] = (uint8_t)(row % 3 == 0 ? noise : row % 3 == 1 ? 77 : i + row);
    }
    return image;
}

/* The pixels as libpng reads them equal the image's, and the header says what it should. */
static void check_decoded(const burnish_image *image, const void *bytes, size_t size) {
    png_image png = {.version = PNG_IMAGE_VERSION};
    if (!CHECK(png_image_begin_read_from_memory(&png, bytes, size), "%s", png.message)) {
        return;
    }
    int alpha = image->channels == 4;
    CHECK(png.format == (alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB), "format %u",
          (unsigned)png.format);
    CHECK((int)png.width == image->width && (int)png.height == image->height, "size");
    CHECK((png.flags & PNG_IMAGE_FLAG_COLORSPACE_NOT_sRGB) == 0, "not sRGB");
    size_t pixels_size = PNG_IMAGE_SIZE(png);
    uint8_t *pixels = malloc(pixels_size);
    if (CHECK(pixels && png_image_finish_read(&png, NULL, pixels, 0, NULL), "%s", png.message)) {
        CHECK(png.warning_or_error == 0, "%s", png.message);
        CHECK(memcmp(pixels, image->pixels, pixels_size) == 0, "%d x %d x %d: pixels differ",
              image->width, image->height, image->channels);
    }
    free(pixels);
}

static burnish_status encode(const burnish_image *image, int threads, uint8_t **bytes, size_t *size,
                             burnish_error *error) {
    const burnish_pixels pixels = burnish_image_pixels(image);
    burnish_png_options options = burnish_png_options_default();
    options.threads = threads;
    return burnish_png_encode(&pixels, &options, bytes, size, error);
}

static void test_decoding(void) {
    static const int sizes[][2] = {{1, 1},    {1, 2},   {2, 1},     {1, 300},   {300, 1},
                                   {3, 3},    {7, 5},   {16, 16},   {17, 31},   {255, 9},
                                   {256, 64}, {641, 3}, {331, 257}, {16384, 2}, {2, 16384}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        for (int channels = 3; channels <= 4; ++channels) {
            burnish_image image = make(sizes[i][0], sizes[i][1], channels);
            uint8_t *bytes;
            size_t size;
            CHECK_STATUS(encode(&image, 0, &bytes, &size, NULL), BURNISH_STATUS_OK);
            check_decoded(&image, bytes, size);
            burnish_release(NULL, bytes);
            burnish_image_destroy(&image);
        }
    }
}

/* Filtered rows of noise (which nothing can shorten), of next to nothing, and of symbols very
 * unlike in frequency. */
static burnish_image make_kind(int width, int height, int channels, int kind) {
    burnish_image image = make(width, height, channels);
    size_t stride = (size_t)width * (size_t)channels, size = stride * (size_t)height;
    uint64_t state = test_seed(1);
    size_t fibonacci[24] = {1, 1}, sum = 0, symbol = 0, left = 0;
    for (int i = 2; i < 24; ++i) {
        fibonacci[i] = fibonacci[i - 1] + fibonacci[i - 2];
    }
    for (size_t i = 0; i < size; ++i) {
        uint8_t noise = (uint8_t)test_random32(&state);
        if (left == 0) {
            symbol = (symbol + 1) % 24;
            left = fibonacci[symbol];
        }
        --left;
        uint8_t above = i >= stride ? image.pixels[i - stride] : 0;
        uint8_t rare = (uint8_t)(symbol + (i % 5 == 0 ? 100 * (i % 2) : 0));
        image.pixels[i] = (uint8_t)(above + (kind == 0   ? noise
                                             : kind == 1 ? (i % 4000 == 0)
                                             : kind == 2 ? 0
                                                         : rare));
        sum += image.pixels[i];
    }
    CHECK(size < 1000 || kind == 2 || sum > 0, "an empty picture");
    return image;
}

/* Sizes on both sides of every change in the number of bands, every kind of content, and the same
 * file from any number of threads. */
static void test_bands(void) {
    enum { BAND = 1 << 17 };
    static const int widths[] = {1, 2, 5, 341, 10922, 16384};
    for (size_t w = 0; w < sizeof widths / sizeof *widths; ++w) {
        for (int channels = 3; channels <= 4; ++channels) {
            int row = widths[w] * channels + 1, most = row < 64 ? 8192 : 3 * BAND / row + 2;
            for (int height = 1; height <= most; height += height < 20 ? 1 : most / 9 + 1) {
                int near = BAND / row + height % 3 - 1; /* a band less one row, full, and more */
                int chosen = height % 2 && near > 0 && near <= 16384 ? near : height;
                burnish_image image = make_kind(widths[w], chosen, channels, height % 4);
                uint8_t *bytes, *again;
                size_t size, again_size;
                CHECK_STATUS(encode(&image, 1, &bytes, &size, NULL), BURNISH_STATUS_OK);
                check_decoded(&image, bytes, size);
                for (int threads = 2; threads <= 7; threads += 5) {
                    CHECK_STATUS(encode(&image, threads, &again, &again_size, NULL),
                                 BURNISH_STATUS_OK);
                    CHECK(size == again_size && memcmp(bytes, again, size) == 0,
                          "%d x %d: %d threads make another file", widths[w], chosen, threads);
                    burnish_release(NULL, again);
                }
                burnish_release(NULL, bytes);
                burnish_image_destroy(&image);
            }
        }
    }
}

/* Signature and chunks, byte by byte up to the image data; libpng checks the CRC of the header. */
static void test_chunks(void) {
    static const uint8_t start[] = {137, 'P', 'N', 'G', 13,  10, 26,   10,   0,    0,   0, 13,
                                    'I', 'H', 'D', 'R', 0,   0,  1,    2,    0,    0,   0, 3,
                                    8,   6,   0,   0,   0,   0,  0,    0,    0,    0,   0, 0,
                                    1,   's', 'R', 'G', 'B', 0,  0xAE, 0xCE, 0x1C, 0xE9};
    static const uint8_t end[] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xAE, 0x42, 0x60, 0x82};
    burnish_image image = make(258, 3, 4);
    uint8_t *bytes;
    size_t size;
    CHECK_STATUS(encode(&image, 0, &bytes, &size, NULL), BURNISH_STATUS_OK);
    CHECK(memcmp(bytes, start, 29) == 0, "IHDR");
    CHECK(memcmp(bytes + 33, start + 33, sizeof start - 33) == 0, "sRGB");
    CHECK(memcmp(bytes + sizeof start + 4, "IDAT", 4) == 0, "IDAT");
    CHECK(memcmp(bytes + size - sizeof end, end, sizeof end) == 0, "IEND");
    burnish_release(NULL, bytes);
    burnish_image_destroy(&image);
    burnish_error error;
    CHECK_STATUS(encode(&image, 0, &bytes, &size, &error), BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "PNG: the image is empty; create or render it first");
    CHECK(!bytes && size == 0, "no bytes on error");
}

/* Rows apart and channels in another order make the same file and hash. */
static void test_views(void) {
    enum { WIDTH = 2100, HEIGHT = 70, GAP = 13 };
    burnish_image image = make_kind(WIDTH, HEIGHT, 4, 3);
    const size_t row = WIDTH * 4;
    uint8_t *apart = calloc(HEIGHT, row + GAP), *bytes, *again;
    size_t size, again_size;
    CHECK_STATUS(encode(&image, 0, &bytes, &size, NULL), BURNISH_STATUS_OK);
    for (int format = BURNISH_PIXELS_RGBA8; apart && format <= BURNISH_PIXELS_BGRA8; ++format) {
        const size_t red = format == BURNISH_PIXELS_BGRA8 ? 2 : 0;
        for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; ++i) {
            const uint8_t *from = image.pixels + 4 * i;
            uint8_t *to = apart + i / WIDTH * (row + GAP) + i % WIDTH * 4;
            to[red] = from[0], to[1] = from[1], to[2 - red] = from[2], to[3] = from[3];
        }
        const burnish_pixels view = {WIDTH, HEIGHT, (burnish_pixel_format)format, row + GAP, apart};
        CHECK(burnish_pixels_hash(&view) == burnish_image_hash(&image), "format %d: hash", format);
        CHECK_STATUS(burnish_png_encode(&view, NULL, &again, &again_size, NULL), BURNISH_STATUS_OK);
        CHECK(size == again_size && memcmp(bytes, again, size) == 0, "format %d: file", format);
        burnish_release(NULL, again);
    }
    burnish_release(NULL, bytes);
    free(apart);
    burnish_image_destroy(&image);
}

static void test_bad_views(void) {
    uint8_t pixel[4] = {0}, *bytes;
    size_t size;
    burnish_error error;
    static const struct {
        int width, height;
        burnish_pixel_format format;
        size_t stride;
        const char *text;
    } CASES[] = {{0, 1, BURNISH_PIXELS_RGB8, 3,
                  "PNG: a size of 0 x 1 pixels; width and height must be 1 to 16384"},
                 {1, 16385, BURNISH_PIXELS_RGB8, 3,
                  "PNG: a size of 1 x 16385 pixels; width and height must be 1 to 16384"},
                 {1, 1, BURNISH_PIXELS_RGBA8, 3, "PNG: a stride of 3 bytes; a row has 4"},
                 {1, 1, BURNISH_PIXELS_COUNT, 4,
                  "PNG: 3 is no pixel format; expected RGB8, RGBA8 or BGRA8"}};
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; ++i) {
        const burnish_pixels view = {CASES[i].width, CASES[i].height, CASES[i].format,
                                     CASES[i].stride, pixel};
        CHECK_STATUS(burnish_png_encode(&view, NULL, &bytes, &size, &error),
                     BURNISH_STATUS_ARGUMENT);
        CHECK_TEXT(error.text, CASES[i].text);
    }
    const burnish_pixels view = {1, 1, BURNISH_PIXELS_RGB8, 3, pixel};
    const burnish_png_options unset = {0};
    CHECK_STATUS(burnish_png_encode(&view, &unset, &bytes, &size, &error), BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text,
               "PNG options: not initialised; start from burnish_png_options_default()");
}

typedef struct counted_memory {
    int left, live; /* allocations that succeed; not released */
} counted_memory;

static void *counted_allocate(void *user_data, size_t size, size_t alignment) {
    counted_memory *counted = user_data;
    if (counted->left-- <= 0) {
        return NULL;
    }
    ++counted->live;
    return aligned_alloc(alignment, size);
}

static void counted_release(void *user_data, void *memory) {
    --((counted_memory *)user_data)->live;
    free(memory);
}

static int cancel_at_once(void *unused) {
    (void)unused;
    return 1;
}

/* Every allocation goes through the context, and any of them may fail. */
static void test_context(void) {
    counted_memory counted = {1000, 0};
    burnish_image image = make_kind(600, 400, 3, 1);
    const burnish_pixels pixels = burnish_image_pixels(&image);
    burnish_context_options wanted = burnish_context_options_default();
    wanted.allocator = (burnish_allocator){counted_allocate, counted_release, &counted};
    burnish_png_options options = burnish_png_options_default();
    options.threads = 1;
    uint8_t *bytes;
    size_t size;
    burnish_error error;
    CHECK_STATUS(burnish_context_create(&wanted, &options.context, NULL), BURNISH_STATUS_OK);
    int failed = 0;
    for (;; ++failed) {
        counted.left = failed;
        if (burnish_png_encode(&pixels, &options, &bytes, &size, &error) == BURNISH_STATUS_OK) {
            break;
        }
        CHECK(error.status == BURNISH_STATUS_MEMORY && !bytes && counted.live == 1,
              "allocation %d: %s, %d left", failed, error.text, counted.live);
    }
    CHECK(failed > 5 && counted.live == 2, "%d failures, %d allocations", failed, counted.live);
    burnish_release(options.context, bytes);
    burnish_context_destroy(options.context);
    CHECK(counted.live == 0, "%d allocations left", counted.live);

    wanted = burnish_context_options_default();
    wanted.cancelled = cancel_at_once;
    CHECK_STATUS(burnish_context_create(&wanted, &options.context, NULL), BURNISH_STATUS_OK);
    CHECK_STATUS(burnish_png_encode(&pixels, &options, &bytes, &size, &error),
                 BURNISH_STATUS_CANCELLED);
    burnish_context_destroy(options.context);
    burnish_image_destroy(&image);
}

static const char *path_of(const char *name) {
    static char path[sizeof folder + 64];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static int entry_count(void) {
    int count = 0;
    DIR *entries = opendir(folder);
    while (entries && readdir(entries)) {
        ++count;
    }
    if (entries) {
        closedir(entries);
    }
    return count - 2;
}

/* Whether the file holds exactly text. */
static int holds(const char *path, const char *text) {
    char bytes[64] = {0};
    FILE *file = fopen(path, "rb");
    size_t size = file ? fread(bytes, 1, sizeof bytes - 1, file) : 0;
    if (file) {
        fclose(file);
    }
    return file && size == strlen(text) && memcmp(bytes, text, size) == 0;
}

static mode_t mode_of(const char *path) {
    struct stat state = {0};
    return stat(path, &state) == 0 ? state.st_mode & 07777 : 0;
}

static void test_new_and_existing_file(void) {
    mode_t old_mask = umask(027);
    CHECK_STATUS(burnish_file_write(path_of("a"), "one", 3, NULL), BURNISH_STATUS_OK);
    CHECK(holds(path_of("a"), "one") && mode_of(path_of("a")) == 0640, "a new file, mode %o",
          mode_of(path_of("a")));
    CHECK(chmod(path_of("a"), 0604) == 0, "chmod");
    CHECK_STATUS(burnish_file_write(path_of("a"), "second", 6, NULL), BURNISH_STATUS_OK);
    CHECK(holds(path_of("a"), "second") && mode_of(path_of("a")) == 0604, "replaced, mode %o",
          mode_of(path_of("a")));
    umask(old_mask);
    CHECK_STATUS(burnish_file_write(path_of("a"), NULL, 0, NULL), BURNISH_STATUS_OK);
    CHECK(holds(path_of("a"), ""), "an empty file");
    CHECK(entry_count() == 1, "%d entries", entry_count());
    unlink(path_of("a"));
}

static void test_link(void) {
    CHECK(symlink("target", path_of("link")) == 0, "symlink");
    CHECK_STATUS(burnish_file_write(path_of("target"), "old", 3, NULL), BURNISH_STATUS_OK);
    CHECK_STATUS(burnish_file_write(path_of("link"), "new", 3, NULL), BURNISH_STATUS_OK);
    struct stat state = {0};
    CHECK(lstat(path_of("link"), &state) == 0 && S_ISLNK(state.st_mode), "the link must stay");
    CHECK(holds(path_of("target"), "new"), "the link's target");
    unlink(path_of("link"));
    unlink(path_of("target"));
}

static void test_bare_name(void) {
    int here = open(".", O_RDONLY | O_DIRECTORY);
    CHECK(here >= 0 && chdir(folder) == 0, "chdir");
    CHECK_STATUS(burnish_file_write("bare", "x", 1, NULL), BURNISH_STATUS_OK);
    CHECK(holds(path_of("bare"), "x") && entry_count() == 1, "a name without a folder");
    unlink("bare");
    CHECK(fchdir(here) == 0, "fchdir");
    close(here);
}

static void test_bad_paths(void) {
    burnish_error error;
    char expected[sizeof folder + 200];
    CHECK_STATUS(burnish_file_write(NULL, "x", 1, &error), BURNISH_STATUS_ARGUMENT);
    CHECK_STATUS(burnish_file_write("", "x", 1, &error), BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "output: no file name; give one, or - for standard output");
    CHECK_STATUS(burnish_file_write(folder, "x", 1, &error), BURNISH_STATUS_WRITE);
    snprintf(expected, sizeof expected, "%s: can't be written: it is a folder; name a file in it",
             folder);
    CHECK_TEXT(error.text, expected);
    CHECK_STATUS(burnish_file_write(path_of("no/x.png"), "x", 1, &error), BURNISH_STATUS_WRITE);
    snprintf(expected, sizeof expected,
             "%s/no/x.png: can't be written: No such file or directory; create the folder first",
             folder);
    CHECK_TEXT(error.text, expected);
    CHECK_STATUS(burnish_file_write(path_of("f"), "x", 1, NULL), BURNISH_STATUS_OK);
    CHECK_STATUS(burnish_file_write(path_of("f/x.png"), "x", 1, &error), BURNISH_STATUS_WRITE);
    CHECK(entry_count() == 1 && holds(path_of("f"), "x"), "nothing new");
    unlink(path_of("f"));
}

/* A full disk, imitated by a limit on file sizes: the write stops in the middle. */
static void test_failing_write(void) {
    struct rlimit old, low;
    getrlimit(RLIMIT_FSIZE, &old);
    low = old;
    low.rlim_cur = 1000;
    static char bytes[5000];
    CHECK_STATUS(burnish_file_write(path_of("kept"), "kept", 4, NULL), BURNISH_STATUS_OK);
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &low);
    burnish_error error = {0};
    burnish_status over = burnish_file_write(path_of("kept"), bytes, sizeof bytes, &error);
    burnish_status fresh = burnish_file_write(path_of("fresh"), bytes, sizeof bytes, NULL);
    setrlimit(RLIMIT_FSIZE, &old);
    CHECK(over == BURNISH_STATUS_WRITE && fresh == BURNISH_STATUS_WRITE, "%d %d", over, fresh);
    CHECK(strstr(error.text, "/kept: can't be written: ") != NULL, "%s", error.text);
    CHECK(holds(path_of("kept"), "kept"), "the old file must be as it was");
    CHECK(entry_count() == 1, "%d entries", entry_count());
    unlink(path_of("kept"));
}

/* As an ordinary user in a folder without permission; root may write everywhere. */
static void test_no_permission(void) {
    CHECK_STATUS(burnish_file_write(path_of("mine"), "mine", 4, NULL), BURNISH_STATUS_OK);
    chmod(path_of("mine"), 0444);
    chmod(folder, 0555);
    int root = geteuid() == 0;
    if (root && seteuid(65534) != 0) {
        printf("no permission tests: can't become an ordinary user\n");
    } else {
        CHECK_STATUS(burnish_file_write(path_of("x"), "x", 1, NULL), BURNISH_STATUS_WRITE);
        CHECK(!root || seteuid(0) == 0, "seteuid");
        /* The folder allows a rename now; the file itself says no. */
        chmod(folder, 0777);
        CHECK(!root || seteuid(65534) == 0, "seteuid");
        CHECK_STATUS(burnish_file_write(path_of("mine"), "x", 1, NULL), BURNISH_STATUS_WRITE);
        CHECK(!root || seteuid(0) == 0, "seteuid");
    }
    chmod(folder, 0755);
    CHECK(entry_count() == 1 && holds(path_of("mine"), "mine"), "nothing changed");
    unlink(path_of("mine"));
}

static void test_devices(void) {
    burnish_error error;
    struct stat state = {0};
    CHECK_STATUS(burnish_file_write("/dev/null", "x", 1, NULL), BURNISH_STATUS_OK);
    CHECK(stat("/dev/null", &state) == 0 && S_ISCHR(state.st_mode), "/dev/null must stay");
    CHECK_STATUS(burnish_file_write("/dev/full", "x", 1, &error), BURNISH_STATUS_WRITE);
    CHECK_TEXT(error.text, "/dev/full: can't be written: No space left on device; free some space");
    CHECK(stat("/dev/full", &state) == 0 && S_ISCHR(state.st_mode), "/dev/full must stay");
}

/* Reads everything from file in a child process, whose exit status tells whether it was `size`
 * bytes of the pattern 0, 1, 2, ... 250, 0, ... */
static pid_t start_reader(int file, int unused, size_t size) {
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        if (unused >= 0) {
            close(unused);
        }
        size_t total = 0;
        int good = 1;
        uint8_t bytes[5000];
        ssize_t got;
        while ((got = read(file, bytes, sizeof bytes)) > 0) {
            for (ssize_t i = 0; i < got; ++i) {
                good &= bytes[i] == (total + (size_t)i) % 251;
            }
            total += (size_t)got;
        }
        _exit(good && total == size ? 0 : 1);
    }
    return child;
}

static int reader_is_content(pid_t child) {
    int status;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/* Standard output as a pipe that doesn't block: many short writes and waits. Then a closed one. */
static void test_standard_output(void) {
    enum { SIZE = 1000003 };
    uint8_t *bytes = malloc(SIZE);
    for (size_t i = 0; bytes && i < SIZE; ++i) {
        bytes[i] = (uint8_t)(i % 251);
    }
    int ends[2];
    if (!CHECK(bytes && pipe(ends) == 0, "pipe")) {
        free(bytes);
        return;
    }
    pid_t reader = start_reader(ends[0], ends[1], SIZE);
    close(ends[0]);
    fflush(stdout);
    int saved = dup(STDOUT_FILENO);
    dup2(ends[1], STDOUT_FILENO);
    fcntl(STDOUT_FILENO, F_SETFL, O_NONBLOCK);
    burnish_status whole = burnish_file_write("-", bytes, SIZE, NULL);
    close(ends[1]);
    dup2(saved, STDOUT_FILENO);
    CHECK_STATUS(whole, BURNISH_STATUS_OK);
    CHECK(reader_is_content(reader), "the reader got other bytes");

    signal(SIGPIPE, SIG_IGN);
    burnish_error error = {0};
    CHECK(pipe(ends) == 0 && close(ends[0]) == 0, "pipe");
    fflush(stdout);
    dup2(ends[1], STDOUT_FILENO);
    close(ends[1]);
    burnish_status closed = burnish_file_write("-", bytes, SIZE, &error);
    dup2(saved, STDOUT_FILENO);
    close(saved);
    CHECK_STATUS(closed, BURNISH_STATUS_WRITE);
    CHECK_TEXT(error.text,
               "standard output: can't be written: Broken pipe; the reader closed the pipe");
    free(bytes);
}

static void test_fifo(void) {
    uint8_t bytes[251];
    for (size_t i = 0; i < sizeof bytes; ++i) {
        bytes[i] = (uint8_t)i;
    }
    CHECK(mkfifo(path_of("fifo"), 0600) == 0, "mkfifo");
    /* Opened for both ends, so that neither open blocks. */
    int held = open(path_of("fifo"), O_RDWR);
    int file = open(path_of("fifo"), O_RDONLY);
    CHECK_STATUS(burnish_file_write(path_of("fifo"), bytes, sizeof bytes, NULL), BURNISH_STATUS_OK);
    close(held);
    pid_t reader = start_reader(file, -1, sizeof bytes);
    close(file);
    CHECK(reader_is_content(reader), "the reader got other bytes");
    struct stat state = {0};
    CHECK(stat(path_of("fifo"), &state) == 0 && S_ISFIFO(state.st_mode), "the pipe must stay");
    unlink(path_of("fifo"));
}

static void test_write_png(void) {
    burnish_image image = make(33, 21, 3);
    CHECK_STATUS(burnish_image_write_png(&image, path_of("i.png"), NULL), BURNISH_STATUS_OK);
    uint8_t bytes[8000];
    FILE *file = fopen(path_of("i.png"), "rb");
    if (CHECK(file != NULL, "no file")) {
        size_t size = fread(bytes, 1, sizeof bytes, file);
        CHECK(size > 100 && size < sizeof bytes, "%zu bytes", size);
        check_decoded(&image, bytes, size);
        fclose(file);
    }
    unlink(path_of("i.png"));
    burnish_image_destroy(&image);
    CHECK_STATUS(burnish_image_write_png(&image, path_of("i.png"), NULL), BURNISH_STATUS_ARGUMENT);
    CHECK(entry_count() == 0, "%d entries", entry_count());
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    if (!mkdtemp(folder)) {
        printf("can't make %s\n", folder);
        return EXIT_FAILURE;
    }
    RUN(test_decoding());
    RUN(test_bands());
    RUN(test_chunks());
    RUN(test_views());
    RUN(test_bad_views());
    RUN(test_context());
    RUN(test_new_and_existing_file());
    RUN(test_link());
    RUN(test_bare_name());
    RUN(test_bad_paths());
    RUN(test_failing_write());
    RUN(test_no_permission());
    RUN(test_devices());
    RUN(test_standard_output());
    RUN(test_fifo());
    RUN(test_write_png());
    CHECK(rmdir(folder) == 0, "something was left in %s", folder);
    return test_end("png");
}
