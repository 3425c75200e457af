/* File functions and flags that differ between systems; a missing flag does nothing. */
#ifndef BURNISH_BASE_PLATFORM_H
#define BURNISH_BASE_PLATFORM_H

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef _WIN32
#include <io.h>
#include <wchar.h>

#define O_CLOEXEC O_NOINHERIT
#define EDQUOT ENOSPC

/* Names of files are UTF-8, or else in the code page; a too long one becomes "", which no file has. */
typedef struct burnish_wide_name {
    wchar_t text[4096];
} burnish_wide_name;
burnish_wide_name burnish_widen(const char *name); /* output.c */
#define fopen(name, mode) _wfopen(burnish_widen(name).text, L"" mode)
#define open(name, ...) _wopen(burnish_widen(name).text, __VA_ARGS__)
#define access(name, mode) _waccess(burnish_widen(name).text, mode)
#define unlink(name) _wunlink(burnish_widen(name).text)
#define burnish_stat(name, status) _wstat64(burnish_widen(name).text, status)
#else
#define O_BINARY 0
#define burnish_stat stat
#endif
#ifndef O_NOCTTY
#define O_NOCTTY 0
#endif
#ifndef O_NOFOLLOW
#define O_NOFOLLOW 0
#endif
#ifndef O_NONBLOCK
#define O_NONBLOCK 0
#endif

/* Turns off the conversion of line ends in standard input or output. */
static inline void burnish_set_binary(int file) {
#ifdef _WIN32
    _setmode(file, O_BINARY);
#else
    (void)file;
#endif
}

/* Reading at an offset, by several threads side by side. */
#if defined(_WIN32) || defined(__wasm__)
#define BURNISH_HAS_PREAD 0
#else
#define BURNISH_HAS_PREAD 1
#endif

/* Files without a name, which vanish with the process unless they are given one. */
#if defined(__linux__) && defined(O_TMPFILE)
#define BURNISH_HAS_NAMELESS_FILES 1
#else
#define BURNISH_HAS_NAMELESS_FILES 0
#endif

#endif
