# Functions of the tests of `burnish`, after those of base/test/lib.sh.
. "$(dirname "$0")/../../base/test/lib.sh"

# draws FLAGS...: whether this system and this build draw with them, such as --sandbox.
draws() {
    "$burnish" render :sphere --size=8 --threads=1 "$@" -o drawn.png 2>/dev/null
    set -- $?
    rm -f drawn.png
    return "$1"
}

# unlimited: the flag with which a batch runs under a sanitizer, which can't bear limits of memory; else nothing.
unlimited() { draws --max-memory=1G || echo --max-memory=8000000000G; }

# block X Y Z: an OBJ file of a closed box from 0 to these.
block() {
    printf 'v %s %s %s\n' 0 0 0 "$1" 0 0 "$1" "$2" 0 0 "$2" 0 0 0 "$3" "$1" 0 "$3" "$1" "$2" "$3" 0 "$2" "$3"
    printf 'f %s %s %s %s\n' 4 3 2 1 5 6 7 8 1 2 6 5 2 3 7 6 3 4 8 7 4 1 5 8
}

# late SECONDS: the last run, or an input of it, was ended by this limit: of processor time or, on a busy machine, of ten
# times that in wall-clock time.
late() {
    grep -qE "not done after ($1 seconds of processor time \\(--max-seconds\\)|[0-9.]* seconds, 10 times --max-seconds): raise the limit" "$err"
}

# sheets: an OBJ file of many triangles one behind another, which takes long.
sheets() { awk 'BEGIN { for (i = 0; i < 9000; ++i) { z = i / 9000; print "v 0 0 " z "\nv 1 0 " z "\nv 0 1 " z "\nf -3 -2 -1" } }'; }
