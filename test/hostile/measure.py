#!/usr/bin/env python3
"""Draws every file of make.py at the default size on one thread. Prints a table of processor time, memory and exit code;
fails where an exit code is not the one that make.py states.

Usage: test/hostile/measure.py PROGRAM FOLDER [NAME...]
"""
import os
import sys

import make


def draw(program, path, flags, picture):
    """CPU seconds, the largest resident set in MB, the exit code."""
    child = os.fork()
    if child == 0:
        nothing = os.open(os.devnull, os.O_RDWR)
        for descriptor in range(3):
            os.dup2(nothing, descriptor)
        os.execv(program, [program, "render", path, "--threads=1", "-o", picture, *flags.split()])
    _, status, used = os.wait4(child, 0)
    return used.ru_utime + used.ru_stime, used.ru_maxrss / 1000, os.waitstatus_to_exitcode(status)


def main():
    program, folder, names = sys.argv[1], sys.argv[2], sys.argv[3:] or list(make.CASES)
    os.makedirs(folder, exist_ok=True)
    wrong = []
    print("| file | bytes | CPU, s | memory, MB | exit code |\n| --- | ---: | ---: | ---: | ---: |")
    for name in names:
        build, flags, expected = make.CASES[name]
        content = build()
        path = make.write(folder, name, content)
        size = sum(map(len, content.values())) if isinstance(content, dict) else len(content)
        seconds, memory, code = draw(program, path, flags, os.path.join(folder, "picture.png"))
        wrong += [] if code == expected else ["%s: exit code %d, not %d" % (name, code, expected)]
        print("| %s | %d | %.2f | %.0f | %d |" % (name, size, max(seconds, 0.01), memory, code), flush=True)
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
