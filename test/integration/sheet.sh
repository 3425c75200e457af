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

# A display's dots: 16 by 8, three times as large, gaps of 6.
for frame in 1 2 3 4; do
    printf 'P4\n16 8\n'
    head -c 16 /dev/zero
done >dots.pbm
check "four displays" sh -c "'$burnish' dots.png 2 2 <dots.pbm"
check "114 by 66 pixels" sh -c "head -c 24 dots.png | od -An -tx1 | tr -d ' \n' | grep -q 0000007200000042\$"
cat whole.ppm dots.pbm >mixed
check "frames of two kinds are refused" sh -c "! '$burnish' mixed.png 5 1 <mixed"
check "text is refused" sh -c "! echo text | '$burnish' mixed.png 1 1"
check "no picture of those" test ! -e mixed.png
finish
