#!/bin/sh
# What desktops get: their own tools find the installed files sound, and the thumbnailer draws every kind of file where
# GNOME runs it, in bubblewrap with nothing but /usr, the file and an empty folder.
# Usage: desktop.sh BUILD SOURCE_DIR SCRATCH
for tool in bwrap update-mime-database; do
    command -v "$tool" >/dev/null 2>&1 || { echo "desktop: SKIPPED: no $tool" && exit 77; }
done
here=$(cd "$(dirname "$0")" && pwd)
build=$(realpath "$1") source=$(realpath "$2")
set -- "$build/burnish" "$3"
. "$here/../cli/lib.sh"
DESTDIR=$scratch/staged cmake --install "$build" --prefix /usr >install.log || fail "cmake --install: $(tail -n 3 install.log)"
usr=$scratch/staged/usr
share=$usr/share

# MIME types, in addition to freedesktop's.
cp /usr/share/mime/packages/freedesktop.org.xml "$share/mime/packages/"
update-mime-database "$share/mime" 2>mime.all || fail "update-mime-database"
grep -v 'not in the search path' mime.all >mime.log # it names the folder, which may be called burnish
check "update-mime-database: $(grep -i burnish mime.log)" sh -c '! grep -qiE "burnish|error" mime.log'
types=$(sed -n 's/^MimeType=//p' "$share/thumbnailers/burnish.thumbnailer")
for extension in $(sed -n 's/^    X([A-Z0-9]*, [a-z0-9]*, "\(\.[a-z0-9 .]*\)".*/\1/p' "$source/include/burnish/mesh.h" | tr -d .); do
    case $extension in scenejson | urdf) continue ;; esac # of files that a thumbnailer does not get
    type=$(sort -t: -k1,1nr "$share/mime/globs2" | sed -n "s/^[0-9]*:\(.*\):\*\.$extension$/\1/p" | head -n 1)
    check "*.$extension is \"$type\", which is none of the thumbnailer's" sh -c "[ -n '$type' ] && echo ';$types' | grep -qF ';$type;'"
done

# As gnome-desktop-thumbnail-script.c does it; the program is where the staged tree has it.
mkdir out
thumbnail() { # FILE
    rm -f out/*
    set -f
    set -- "$1" $(sed -n 's/^Exec=//p' "$share/thumbnailers/burnish.thumbnailer" |
        sed "s|%s|128|; s|%o|/tmp/out.png|; s|%i|/tmp/file-to-thumbnail.${1##*.}|; s|^burnish|/staged/bin/burnish|")
    set +f
    file=$1
    shift
    bwrap --ro-bind /usr /usr --ro-bind-try /etc/ld.so.cache /etc/ld.so.cache --symlink /usr/bin /bin --symlink /usr/lib /lib \
        --symlink /usr/lib64 /lib64 --ro-bind "$usr" /staged --proc /proc --dev /dev --chdir / --unshare-all --die-with-parent \
        --bind "$scratch/out" /tmp --ro-bind "$file" "/tmp/file-to-thumbnail.${file##*.}" "$@" >"$out" 2>"$err" </dev/null
    code=$?
}
if ! bwrap --ro-bind /usr /usr --symlink /usr/lib /lib --symlink /usr/lib64 /lib64 --unshare-all --proc /proc --dev /dev /usr/bin/true; then
    skip "thumbnails in bubblewrap, this system does not allow it"
    finish
    exit
fi
# Fuzzing seeds, without the bytes that control the fuzzer.
"$source/test/fuzz/seeds" seeds >seeds.log 2>&1 || fail "seeds: $(tail -n 2 seeds.log)"
mkdir files
for seed in seeds/*/*; do
    format=$(basename "$(dirname "$seed")") name=files/$(basename "$seed")
    tail -c +5 "$seed" >"$name.$format"
    [ "$(head -c 4 "$name.$format")" != glTF ] || mv "$name.$format" "$name.glb"
done
for extension in stl obj ply off gltf glb 3mf gcode bms; do
    drawn=0
    for file in files/*."$extension"; do
        "$burnish" render "$file" --no-libraries --quiet --no-background --size=128 -o wanted.png 2>/dev/null || continue
        thumbnail "$PWD/$file"
        check "$file: exit code $code: $(cat "$err")" [ $code = 0 ]
        check "$file: another picture" cmp -s wanted.png out/out.png
        drawn=$((drawn + 1))
        [ $drawn -lt 2 ] || break
    done
    check "no file drawn of .$extension" [ $drawn -gt 0 ]
done
head -c 300 "$source/test/data/colors.ply" >cut.ply
thumbnail "$PWD/cut.ply"
check "a damaged file: exit code $code" [ $code = 4 ]
check "a damaged file leaves a picture" [ ! -e out/out.png ]
finish
