#!/bin/sh
# Turntables: errors and files. turntable.py tests the frames.
# usage: cli_turntable.sh BURNISH SCRATCH
. "$(dirname "$0")/lib.sh"
here=$(dirname "$(realpath "$0")")

for name in t.mov t.y4m t.apng; do
    expect 2 "burnish: --turntable: \"$name\": turntables are written as WebP, GIF, MP4 or WebM; for other videos use --turntable=- | ffmpeg -i - FILE" render :sphere --turntable=$name
done
for name in t.jpg t.png; do
    expect 2 "burnish: --turntable: \"$name\": turntables are written as WebP, GIF, MP4 or WebM; end the name in .webp, .gif, .mp4 or .webm" render :sphere --turntable=$name
done
expect 2 'burnish: --turntable: "t": turntables are written as WebP, GIF, MP4 or WebM; end the name in .webp, .gif, .mp4 or .webm' render :sphere --turntable=t
expect 2 'burnish: --frames: "1" is not a whole number from 2 to 3600' render :sphere --turntable=t.gif --frames=1
expect 2 'burnish: --fps: "0" is not a whole number from 1 to 120' render :sphere --turntable=t.gif --fps=0
expect 2 'burnish: --fps: a GIF has at most 50 frames per second; write WebP, MP4 or WebM' render :sphere --turntable=t.gif --fps=51
expect 2 'burnish: --output: --turntable already names a file; omit one of them' render :sphere --turntable=t.gif -o t.png
expect 2 'burnish: --views: a turntable shows only one view and one lobe; omit the flag' render :sphere --turntable=t.gif --views=top,front
expect 2 'burnish: --plane: a turntable shows only one view and one lobe; omit the flag' render :sphere --turntable=t.gif --plane=depth:d.npy
expect 2 'burnish: --annotate: a turntable shows only one view and one lobe; omit the flag' render :sphere --turntable=t.gif --annotate=box
expect 2 'burnish: --no-background: .y4m has no alpha; write WebP or GIF' render :sphere --turntable=- --no-background
expect 2 'burnish: --output: "t.gif": only a turntable moves; write one with --turntable=FILE, in WebP, GIF, MP4 or WebM' render :sphere -o t.gif
nothing_left "wrong usage"

# Nothing is left of a file that can't be completed, and an older one stays.
few="--size=16 --look=plain --frames=3"
expect 7 "burnish: /dev/full: can't be written: No space left on device; free some space" render :sphere $few --output-format=gif --turntable=/dev/full
printf mine >kept.gif
(
    ulimit -f 1
    "$burnish" render :teapot --size=200 --look=plain --frames=4 --turntable=kept.gif 2>"$err"
    echo $? >../code
)
check "a file over the limit of the shell: exit code $(cat ../code)" [ "$(cat ../code)" = 7 ]
check "a file over the limit replaces a turntable" [ "$(cat kept.gif)" = mine ]
away='--camera-position=100,0,0 --camera-focal-point=200,0,0'
gives 8 render :sphere $few $away --turntable=kept.gif --fail-on-blank  # a blank turntable
check "a blank turntable replaces another" [ "$(cat kept.gif)" = mine ]
rm -f kept.gif
nothing_left "failed turntables"

# The report tells of the first frame.
run render :sphere $few --turntable=t.gif --fps=7 --json
check "frames" [ "$(json frames)" = 3 ]
check "fps" [ "$(json fps)" = 7 ]
first=$(json hash)
check "the report is JSON" valid_json
run render :sphere $few --turntable=t.gif --frames=5 --json
check "the hash is not that of the first frame" [ "$(json hash)" = "$first" ]

# The tables of a GIF take little room.
if "$burnish" render :sphere $few --threads=1 --max-memory=70M --turntable=- >/dev/null 2>&1; then # not with the sanitizers
    gives 0 render :sphere $few --threads=1 --max-memory=70M --turntable=t.gif
fi

# The same bytes with any number of threads and without vectors, uncompressed by a library.
for isa in scalar auto; do
    for threads in 1 2 7; do
        gives 0 render :knot $few --isa=$isa --threads=$threads --turntable=s.gif
        gives 0 render :knot $few --isa=$isa --threads=$threads --turntable=-
        cat s.gif "$out" | cksum >>sums
    done
done
check "turntables differ: $(cat sums)" [ "$(sort -u sums | wc -l)" = 1 ]

# Videos: ffmpeg gets the bytes of a Y4M. One that succeeds copies them; others fail early, late, or are missing. Its output is /dev/fd/1,
# which minimal containers lack: there it is what /dev/fd is a link to.
mkdir bin none
fake() { printf '#!/bin/sh\n%s\n' "$1" >bin/ffmpeg && chmod +x bin/ffmpeg; }
video() { PATH=$PWD/bin:/usr/bin:/bin gives "$@"; }
"$burnish" render :knot $few --turntable=- >v.y4m
fake 'for file; do :; done; echo "$*" >arguments; cat >"/proc/self${file#/dev}"'
video 2 render :sphere --turntable=t.mp4 --resolution=1,8
same "a video of one column" "$(cat "$err")" 'burnish: --resolution: a .mp4 has at least 2 x 2 pixels; write WebP or GIF'
sandboxes='--sandbox --no-sandbox' bounded=1 # a sanitizer's program has neither a sandbox nor a bounded address space
draws --sandbox || sandboxes=--no-sandbox
draws --max-memory=500M || bounded=0
for sandbox in $sandboxes; do
    rm -f v.mp4 v.webm
    video 0 render :knot $few --turntable=v.mp4 $sandbox
    check "$sandbox: the video is not what ffmpeg wrote" cmp v.mp4 v.y4m
    check "$sandbox: ffmpeg's arguments: $(cat arguments)" grep -q -- '-f yuv4mpegpipe -i pipe:0 .* -f mp4 -y /dev/fd/1$' arguments
    video 0 render :knot $few --turntable=v.webm $sandbox
    check "$sandbox: no WebM" grep -q -- '-f webm' arguments
    printf mine >kept.mp4
    fake 'echo "no such encoder" >&2; exit 1'
    video 7 render :knot $few --turntable=kept.mp4 $sandbox
    same "$sandbox: ffmpeg's error" "$(cat "$err")" "burnish: kept.mp4: ffmpeg failed: no such encoder; no file was written"
    fake 'cat >/dev/null'
    video 7 render :knot $few --turntable=kept.mp4 $sandbox
    fake 'echo $$ >process; exec sleep 1000'
    for seconds in 0.2 0.8 3.2 12.8; do # until it lasts for ffmpeg to begin
        rm -f process
        video 5 render :knot --size=512 --frames=30 --max-seconds=$seconds --turntable=kept.mp4 $sandbox
        ! [ -s process ] || break
    done
    check "$sandbox: ffmpeg runs on after burnish" await ended "$(cat process)"
    if command -v python3 >/dev/null; then # shells name ten descriptors
        fake 'for file; do :; done; [ -e /proc/$$/fd/300 ] && echo 300 >held; cat >"/proc/self${file#/dev}"'
        check "with descriptor 300" python3 -c 'import os, sys
os.dup2(1, 300)
os.execve(sys.argv[1], sys.argv[1:], {"PATH": os.getcwd() + "/bin:/usr/bin:/bin"})' "$burnish" render :knot $few --turntable=v.mp4 $sandbox
        check "$sandbox: ffmpeg has descriptors of others" [ ! -e held ]
    fi
    fake 'for file; do :; done; cat >"/proc/self${file#/dev}"; kill -9 $$'
    video 7 render :knot $few --turntable=kept.mp4 $sandbox
    fake 'for file; do :; done; cat >"/proc/self${file#/dev}"'
    [ $bounded = 0 ] || video 6 render :knot --size=8000 --threads=1 --max-memory=100M --turntable=kept.mp4 $sandbox
    same "$sandbox: a video that could not be made replaces another" "$(cat kept.mp4)" mine
    fake 'for file; do :; done; echo "$*" >arguments; cat >"/proc/self${file#/dev}"'
done
same "without ffmpeg" "$(PATH=$PWD/none:.:bin "$burnish" render :knot $few --turntable=no.mp4 2>&1)" \
    'burnish: --turntable: "no.mp4": ffmpeg encodes videos and is not in PATH; install it, or write .gif or .webp'
rm -rf bin none arguments kept.mp4 v.*

# WebP: as many frames, and their time.
if "$burnish" render :knot $few --fps=10 --turntable=t.webp 2>/dev/null; then
    check "WebP: no animation" sh -c "[ \"\$(head -c 4 t.webp)\" = RIFF ] && grep -qa ANIM t.webp"
    check "WebP: frames" [ "$(grep -ao ANMF t.webp | wc -l)" = 3 ]
else
    skip "WebP, this build does not write it"
fi

# Some C libraries give threads 128 KiB of stack.
if sh -c "ulimit -s 112; '$burnish' render :sphere --look=plain --size=16 -o plain.png" 2>/dev/null; then # not with the sanitizers
    check "small stacks" sh -c "ulimit -s 128; '$burnish' render :sphere --size=64 --frames=3 --turntable=small.gif"
    rm -f plain.png small.gif
else
    skip "small stacks, this build needs more"
fi

# --play: frames of the input's animation, each as a new run draws that moment, framed for all of them.
python3 - <<'END'
import base64, json, struct
data = struct.pack("<9f2f6f", 0, 0, 0, 1, 0, 0, 0, 1, .5, 0, 2, 0, 0, 0, 6, 0, 0)
view = lambda offset, count, kind: {"bufferView": 0, "byteOffset": offset, "componentType": 5126, "count": count, "type": kind}
json.dump({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0,
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
    "accessors": [view(0, 3, "VEC3"), view(36, 2, "SCALAR"), view(44, 2, "VEC3")],
    "animations": [{"name": "go", "samplers": [{"input": 1, "output": 2}], "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
    "buffers": [{"byteLength": len(data), "uri": "moves.bin"}]}, open("moves.gltf", "w"))
open("moves.bin", "wb").write(data)
END
size=48 play="moves.gltf --size=48 --frames=4 --play"
gives 0 render $play --turntable=t.gif --json
same "seconds and frames" "$(json animation_seconds) $(json frames)" "2.000000 4"
camera="--camera-position=$(json position) --camera-focal-point=$(json focal_point) --camera-view-up=$(json view_up)"
"$burnish" render $play --turntable=- >played.y4m
frame=$((size * size * 3 / 2 + 6)) # and its marker
for at in 0 1 2 3; do
    "$burnish" render moves.gltf --size=48 --frames=2 $camera --animation-time=0.$((at * 5)) --turntable=- >one.y4m
    [ $at -lt 2 ] || "$burnish" render moves.gltf --size=48 --frames=2 $camera --animation-time=1.$((at * 5 - 10)) --turntable=- >one.y4m
    check "frame $at" [ "$(tail -c $((frame * (4 - at))) played.y4m | head -c $frame | cksum)" = "$(tail -c $((frame * 2)) one.y4m | head -c $frame | cksum)" ]
done
check "it moves" [ "$(tail -c $frame played.y4m | cksum)" != "$(tail -c $((frame * 2)) played.y4m | head -c $frame | cksum)" ]
for flag in --threads=1 --sandbox; do
    draws $flag || continue
    "$burnish" render $play --turntable=- --animation=go $flag >other.y4m
    check "played with $flag" cmp played.y4m other.y4m
done
# A sandboxed process keeps all 56 MiB of frames.
for run in '0 --no-sandbox' '6 --sandbox'; do
    draws "${run#* }" --max-memory=70M || continue # not with the sanitizers
    gives "${run% *}" render $play --size=256 --frames=600 --samples=1 --max-memory=70M --threads=1 --turntable=- "${run#* }"
done
rm -f played.y4m one.y4m other.y4m t.gif
expect 2 'burnish: --play: :sphere has no animation; omit the flag for a turn of the camera' render :sphere --turntable=t.gif --play
expect 2 'burnish: --animation-time: --play shows all times; omit one of them' render moves.gltf --turntable=t.gif --play --animation-time=1
expect 2 'burnish: --play: reads INPUT for every frame; name a file' render - --turntable=t.gif --play
rm -f moves.gltf moves.bin
check "a wrong use of --play writes a file" [ ! -e t.gif ]

check "$(PYTHONDONTWRITEBYTECODE=1 python3 "$here/turntable.py" "$burnish" 2>&1 | tail -1)" \
    env PYTHONDONTWRITEBYTECODE=1 python3 "$here/turntable.py" "$burnish"
finish
