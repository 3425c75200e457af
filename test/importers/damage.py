#!/usr/bin/env python3
"""Damages model files and has them drawn: each has to end as a picture or as one line with an exit code.

Usage: damage.py PROGRAM FOLDER COUNT [SANDBOX]
COUNT files in all, the same every time: bytes changed, pieces cut out, repeated or lost at the end."""
import os
import random
import subprocess
import sys
import time

EXTENSIONS = (".3ds .3mf .ac .ase .b3d .blend .cob .dae .dxf .fbx .glb .hmp .ifc .iqm .lwo .lxo .md2 .md3 "
           ".md5mesh .mdc .mdl .ms3d .nff .ogex .q3o .sib .smd .step .igs .brep .brp .x .x3d .xgl .zgl").split()
CODES = {0, 4, 5, 6}  # a picture, no mesh, a limit, memory
SECONDS = 2


def files(folder):
    """The smallest few of each extension."""
    of = {}
    for place, _, names in sorted(os.walk(folder)):
        for name in names:
            extension = os.path.splitext(name)[1].lower()
            path = os.path.join(place, name)
            if extension in EXTENSIONS and os.path.getsize(path) > 0:
                of.setdefault(extension, []).append((os.path.getsize(path), path))
    return [(extension, path) for extension in sorted(of) for _, path in sorted(of[extension])[:4]]


def damaged(data, chance):
    data = bytearray(data)
    for _ in range(chance.choice((1, 1, 2, 8, 40))):
        at = chance.randrange(max(len(data), 1))
        kind = chance.randrange(6)
        if not data:
            break
        if kind < 2:
            data[at] = chance.randrange(256)
        elif kind == 2:
            data[at] = chance.choice((0, 1, 127, 128, 255))
        elif kind == 3:  # a number of 4 bytes
            data[at:at + 4] = chance.choice((0, 1, 0x7fffffff, 0x80000000, 0xffffffff, 0x10000000)).to_bytes(4, "little")
        elif kind == 4:
            size = chance.randrange(1, 200)
            data[at:at + size] = data[at:at + size] * chance.randrange(3)
        else:
            del data[max(at, 1):max(at, 1) + chance.randrange(1, 50)]
    if data and chance.randrange(8) == 0:
        del data[chance.randrange(len(data)):]
    return bytes(data)


def main():
    burnish, folder, count = sys.argv[1], sys.argv[2], int(sys.argv[3])
    flags = sys.argv[4:] or ["--sandbox"]
    found = files(folder)
    codes, crashes, bad, slowest = {}, 0, 0, (0, "")
    for number in range(count):
        extension, path = found[number % len(found)]
        with open(path, "rb") as file:
            data = damaged(file.read(), random.Random(number))
        name = "damaged" + extension
        with open(name, "wb") as file:
            file.write(data)
        start = time.monotonic()
        run = subprocess.run([burnish, "render", name, "--size=32", "--quiet", "--max-seconds=%d" % SECONDS, "-o", "damaged.png"] + flags,
                             stdin=subprocess.DEVNULL, capture_output=True)
        seconds = time.monotonic() - start
        slowest = max(slowest, (seconds, "%d of %s" % (number, path)))
        said = run.stderr.decode("utf-8", "replace")
        codes[run.returncode] = codes.get(run.returncode, 0) + 1
        crashes += "crashed by signal" in said
        whole = run.returncode in CODES and (
            said == "" if run.returncode == 0 else
            said.count("\n") == 1 and said.startswith("burnish: ") and not os.path.exists("damaged.png"))
        if not whole:
            bad += 1
            print("%d of %s: exit code %d: %s" % (number, path, run.returncode, said))
        for left in (name, "damaged.png"):
            if os.path.exists(left):
                os.remove(left)
    print("damaged files: %d, exit codes %s, importers crashed: %d, wrong: %d, slowest %.1f s (%s)" % (
        count, ", ".join("%d: %d" % pair for pair in sorted(codes.items())), crashes, bad, *slowest))
    return 1 if bad else 0


sys.exit(main())
