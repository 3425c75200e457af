/* For the memory sanitizer, which sees no writes of libraries that are not built with it: ISA-L's
 * functions and, as clang 14 does not know them, stat for large files, followed by what they wrote.
 * Linked into every test of the preset msan. */
#include <dlfcn.h>
#include <isa-l/igzip_lib.h>
#include <sanitizer/msan_interface.h>
#include <sys/stat.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

void isal_deflate_init(struct isal_zstream *stream) {
    REAL(isal_deflate_init)(stream);
    __msan_unpoison(stream, sizeof *stream);
}

int isal_deflate_set_dict(struct isal_zstream *stream, uint8_t *bytes, uint32_t size) {
    int code = REAL(isal_deflate_set_dict)(stream, bytes, size);
    __msan_unpoison(&code, sizeof code);
    return code;
}

int isal_deflate(struct isal_zstream *stream) {
    uint8_t *out = stream->next_out;
    int code = REAL(isal_deflate)(stream);
    __msan_unpoison(&code, sizeof code);
    __msan_unpoison(stream, sizeof *stream);
    __msan_unpoison(out, (size_t)(stream->next_out - out));
    return code;
}

uint32_t isal_adler32(uint32_t init, const unsigned char *bytes, uint64_t size) {
    uint32_t sum = REAL(isal_adler32)(init, bytes, size);
    __msan_unpoison(&sum, sizeof sum);
    return sum;
}

int stat(const char *path, struct stat *info) {
    int code = REAL(stat)(path, info);
    __msan_unpoison(&code, sizeof code);
    __msan_unpoison(info, sizeof *info);
    return code;
}

int lstat(const char *path, struct stat *info) {
    int code = REAL(lstat)(path, info);
    __msan_unpoison(&code, sizeof code);
    __msan_unpoison(info, sizeof *info);
    return code;
}

int fstat(int file, struct stat *info) {
    int code = REAL(fstat)(file, info);
    __msan_unpoison(&code, sizeof code);
    __msan_unpoison(info, sizeof *info);
    return code;
}
