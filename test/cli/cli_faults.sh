#!/bin/sh
# External faults while a mesh is read, drawn or written: one line, the right exit code, no partial file, no temporary files.
# Usage: cli_faults.sh PROGRAM FOLDER
here=$(cd "$(dirname "$0")" && pwd)
. "$here/lib.sh"

# A pipe that nobody reads.
{
    "$burnish" render :sphere --size=600 -o - 2>"$err"
    echo $? >../code
} | true
check "a closed pipe: exit code $(cat ../code)" [ "$(cat ../code)" = 7 ]
check "a closed pipe: $(cat "$err")" grep -qx "burnish: standard output: can't be written: Broken pipe; the reader closed the pipe" "$err"
rm -f ../code

# A file that shrinks and grows while it is read gives a picture or an error, never a signal.
awk 'BEGIN { for (i = 0; i < 40000; ++i) print "v " i % 7 " " i % 11 " " i % 13; for (i = 1; i < 39000; ++i) print "f " i " " i + 1 " " i + 2 }' >whole.obj
(
    while [ -e whole.obj ]; do
        cat whole.obj >moving.obj 2>/dev/null
        : >moving.obj
    done
) &
changer=$!
codes=
for _ in 1 2 3 4 5 6 7 8 9 10 11 12; do
    "$burnish" info moving.obj >/dev/null 2>&1
    codes="$codes $?"
done
rm whole.obj
wait $changer
rm -f moving.obj
check "a file that shrinks: exit codes$codes" [ -z "$(echo "$codes" | tr -d ' 034')" ]

# Signals in the middle, for a new file and an old one: as the signal would have ended it, and no temporary file is left, also if the
# file system does not support unnamed files, which a failing access() simulates.
printf 'int access(const char *path, int mode);\nint access(const char *path, int mode) { (void)path, (void)mode; return -1; }\n' >../access.c
preload=
${CC:-cc} -shared -fPIC -o ../access.so ../access.c 2>/dev/null && LD_PRELOAD=../access.so "$burnish" --version >/dev/null 2>&1 &&
    preload=$(realpath ../access.so)
has_temporary() { ls -A | grep -q '^[.]'; }
if ! env --default-signal=INT true 2>/dev/null; then
    skip "signals, env has no --default-signal"
else
    echo old >old.gif
    for name in INT TERM HUP; do
        for file in new.gif old.gif; do
            for before in '' $preload; do
                env --default-signal=$name LD_PRELOAD="$before" "$burnish" render :sphere --size=800 --frames=2000 --turntable=$file 2>/dev/null &
                await computes $!
                [ -z "$before" ] || check "no temporary to leave" await has_temporary
                kill -$name $!
                wait $! 2>/dev/null
                code=$?
                check "SIG$name: exit code $code" [ $code = $((128 + $(kill -l $name 2>/dev/null || case $name in INT) echo 2 ;; HUP) echo 1 ;; *) echo 15 ;; esac))) ]
            done
        done
        check "SIG$name: $(ls -A)" [ "$(ls -A)" = old.gif -a "$(cat old.gif)" = old ]
    done
    rm -f old.gif
fi

# A full file system, and a file that is a mount point, if this user can mount.
mounted() { # SCRIPT: with $burnish, in a name space of its own; its output is in $out
    unshare -r -m sh -c "$1" sh "$burnish" >"$out" 2>"$err"
    code=$?
}
if unshare -r -m true 2>/dev/null && unshare -r -m sh -c 'mkdir m && mount -t tmpfs -o size=64k none m' 2>/dev/null; then
    mounted 'mount -t tmpfs -o size=64k none m && "$1" render :knot --size=800 -o m/s.png; code=$?; ls -A m; exit $code'
    check "a full disk: exit code $code" [ "$code" = 7 ]
    check "a full disk: $(cat "$err")" grep -qx "burnish: m/s.png: can't be written: No space left on device; free some space" "$err"
    check "a full disk: left $(cat "$out")" [ ! -s "$out" ]
    echo old >a.png
    echo other >b.png
    mounted 'mount --bind b.png a.png && "$1" render :sphere --size=16 -o a.png; code=$?; cat a.png; exit $code'
    check "a bind mount: exit code $code, $(cat "$err")" [ "$code" = 7 ]
    check "a bind mount: one line" [ "$(wc -l <"$err")" = 1 ]
    check "a bind mount: $(cat "$out")" [ "$(cat "$out")" = other ]
    rm -f a.png b.png
else
    skip "full disk and bind mount, no right to mount"
fi
rmdir m 2>/dev/null
nothing_left "faults"
finish
