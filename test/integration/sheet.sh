#!/bin/sh
# The contact sheet of the firmware's frames, which `make mcu` writes.
# usage: sheet.sh PROGRAM SCRATCH
. "$(dirname "$0")/../cli/lib.sh"

# frames COUNT: that many grey pictures of 64 by 64 pixels
frames() {
    for frame in $(seq "$1"); do
        printf 'P6\n64 64\n255\n'
        head -c 12288 /dev/zero | tr '\0' "\\$frame"
    done
}

frames 4 >whole.ppm
frames 3 >short.ppm
check "four frames" sh -c "'$burnish' sheet.png 4 1 <whole.ppm"
check "1024 by 256 pixels" sh -c "head -c 24 sheet.png | od -An -tx1 | tr -d ' \n' | grep -q 0000040000000100\$"
check "three frames are refused" sh -c "! '$burnish' short.png 4 1 <short.ppm"
check "and leave no picture" test ! -e short.png
check "text is refused" sh -c "! echo text | '$burnish' short.png 1 1"
finish
