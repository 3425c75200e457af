#!/usr/bin/env python3
"""Writes files of less than 1 MB that are meant to take long, or much memory.

Usage: test/hostile/make.py FOLDER [NAME...]        without names: all of them
Each line of output is a file, the exit code that `burnish render` ends with, and flags that suit it.
"""
import math
import os
import random
import struct
import sys

from files import FILES, png, textured


def stl(triangles):
    """Binary STL of nine coordinates per triangle."""
    parts = [b"\0" * 80, struct.pack("<I", len(triangles))]
    parts += [struct.pack("<12fH", 0, 0, 0, *t, 0) for t in triangles]
    return b"".join(parts)


def obj(positions, faces):
    return ("".join("v %.6g %.6g %.6g\n" % p for p in positions) +
            "".join("f %s\n" % " ".join(map(str, f)) for f in faces)).encode()


def sheet(z, turn=0):
    """A triangle of which a picture from above shows half."""
    t = [(0, 0), (1, 0), (0, 1)] if not turn else [(1, 1), (0, 1), (1, 0)]
    return [c for x, y in t for c in (x, y, z)]


def sheets(count, nearest_first=False):
    order = range(count, 0, -1) if nearest_first else range(count)
    return stl([sheet(i / count) for i in order])


def alternating(count):
    """Alternately front- and back-facing."""
    triangles = []
    for i in range(count):
        t = sheet(i / count)
        triangles.append(t if i % 2 else t[:3] + t[6:] + t[3:6])
    return stl(triangles)


def shuffled(count):
    rng = random.Random(1)
    order = list(range(count))
    rng.shuffle(order)
    return stl([sheet(i / count) for i in order])


def crossed(count):
    """Sheets of two slopes, each of which pierces all of the other."""
    triangles = []
    for i in range(count):
        t = sheet(0)
        s = 1 if i % 2 else -1
        for k in range(3):
            t[3 * k + 2] = s * (t[3 * k] - 0.5) + i / count
        triangles.append(t)
    return stl(triangles)


def around_an_axis(count):
    triangles = []
    for i in range(count):
        a = math.pi * i / count
        c, s = math.cos(a), math.sin(a)
        triangles.append([-c, -1, -s, c, -1, s, 0, 1, 0])
    return stl(triangles)


def random_large(count):
    rng = random.Random(2)
    return stl([[rng.uniform(-1, 1) for _ in range(9)] for _ in range(count)])


def spikes(count):
    rng = random.Random(3)
    triangles = []
    for _ in range(count):
        p = [rng.uniform(-1, 1) for _ in range(6)]
        triangles.append(p + [p[3] + 0.01, p[4], p[5]])
    return stl(triangles)


def same(count):
    return obj([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(1, 2, 3)] * count)


def same_turned(count):
    """The same triangle, its vertices in other orders, and both windings."""
    faces = [(1, 2, 3), (2, 3, 1), (3, 1, 2), (3, 2, 1)]
    return obj([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [faces[i % 4] for i in range(count)])


def fan(count):
    """One face that goes around four vertices again and again: 2 bytes per triangle."""
    return obj([(0, 0, 0), (1, 0, 0.01), (1, 1, 0), (0, 1, 0.02)],
               [tuple(1 + i % 4 for i in range(count))])


def near_copies(count):
    """Sheets whose depths differ in the last bits."""
    return stl([sheet(1 + i * 2.0 ** -22) for i in range(count)])


def growing(count):
    """Each sheet covers the last one and some more: none is hidden."""
    return stl([[0, 0, i / count, .5 + .5 * i / count, 0, i / count, 0, .5 + .5 * i / count,
                 i / count] for i in range(count)])


def transparent(count, alpha=20):
    """PLY with alpha."""
    header = ("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\n"
              "property float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
              "property uchar blue\nproperty uchar alpha\nelement face %d\n"
              "property list uchar int vertex_indices\nend_header\n" % (3 * count, count))
    out = [header.encode()]
    for i in range(count):
        t = sheet(i / count)
        out += [struct.pack("<3f4B", *t[3 * k:3 * k + 3], 200, 100, 50, alpha) for k in range(3)]
    out += [struct.pack("<B3i", 3, 3 * i, 3 * i + 1, 3 * i + 2) for i in range(count)]
    return b"".join(out)


def many_libraries(count):
    return b"mtllib" + b" a" * count + b"\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def long_libraries(size):
    out = [b"mtllib " + b"%d" % (i % 10) * 3000 + b"\n" for i in range(63)]
    out += [b"mtllib q\n"] * (size // 9)
    return b"".join(out) + b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def many_elements(count):
    header = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    header += b"element face 1\nproperty list uchar int vertex_indices\n" * count
    return header + b"end_header\n0 0 0\n1 0 0\n0 1 0\n" + b"2 0 1\n" * count


def edges_at_a_vertex(count):
    """Faces of all slopes around one edge, with other normals."""
    ring = [(math.cos(i), math.sin(i), 0.0) for i in range(count)]
    return obj([(0, 0, 0), (0, 0, 1)] + ring, [(1, 2, i + 3) for i in range(count)])


def grid_folded(count):
    """Saw teeth seen edge on: silhouettes everywhere."""
    n = int(math.sqrt(count / 2))
    positions = [(x / n, y / n, 0.3 * ((x + y) % 2)) for y in range(n + 1) for x in range(n + 1)]
    faces = []
    for y in range(n):
        for x in range(n):
            a = y * (n + 1) + x + 1
            faces += [(a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1)]
    return obj(positions, faces)


TOP = "--views=top"
MAPS = ("color", "metal", "normal")
CASES = {
    "sheets-500.stl": (lambda: sheets(500), TOP, 0),
    "sheets-500-back.stl": (lambda: sheets(500, True), TOP, 0),
    "sheets-4000.stl": (lambda: sheets(4000), TOP, 5),
    "sheets-20000.stl": (lambda: sheets(20000), TOP, 5),
    "sheets-20000-back.stl": (lambda: sheets(20000, True), TOP, 5),
    "shuffled-20000.stl": (lambda: shuffled(20000), TOP, 5),
    "alternating-20000.stl": (lambda: alternating(20000), TOP, 5),
    "crossed-20000.stl": (lambda: crossed(20000), TOP, 5),
    "axis-20000.stl": (lambda: around_an_axis(20000), "", 5),
    "random-20000.stl": (lambda: random_large(20000), "", 0),
    "spikes-20000.stl": (lambda: spikes(20000), "", 0),
    "growing-20000.stl": (lambda: growing(20000), TOP, 5),
    "near-copies-20000.stl": (lambda: near_copies(20000), TOP, 5),
    "same-1250.obj": (lambda: same(1250), "--views=front", 0),
    "same-120000.obj": (lambda: same(120000), "--views=front", 5),
    "same-edge-on-120000.obj": (lambda: same(120000), "--views=top", 5),
    "same-turned-120000.obj": (lambda: same_turned(120000), "--views=front", 5),
    "fan-450000.obj": (lambda: fan(450000), "--views=front", 5),
    "transparent-500.ply": (lambda: transparent(500), "--views=front", 5),
    "transparent-15000.ply": (lambda: transparent(15000), "--views=front", 5),
    "faint-280.ply": (lambda: transparent(280, 1), "", 0),
    "libraries-50000.obj": (lambda: many_libraries(50000), "", 0),
    "libraries-400000.obj": (lambda: many_libraries(400000), "", 0),
    "libraries-long.obj": (lambda: long_libraries(900000), "", 0),
    "elements-10000.ply": (lambda: many_elements(10000), "", 4),
    "edge-30000.obj": (lambda: edges_at_a_vertex(30000), "", 5),
    "folded-30000.obj": (lambda: grid_folded(30000), "", 0),
    "texture-16384.glb": (lambda: textured([png(16384, 16384)], MAPS), "", 0),
    "textures-4096.glb": (lambda: textured([png(4096, 4096)] * 40, MAPS), "", 0),
    "textures-512.glb": (lambda: textured([png(512, 512)] * 800, MAPS), "", 0),
    **FILES,
}


def write(folder, name, content):
    """The input, and the files that it names. Returns its path."""
    parts = content if isinstance(content, dict) else {name: content}
    for part, data in parts.items():
        with open(os.path.join(folder, part), "wb") as file:
            file.write(data)
    return os.path.join(folder, next(iter(parts)))


def main():
    folder, names = sys.argv[1], sys.argv[2:] or list(CASES)
    os.makedirs(folder, exist_ok=True)
    for name in names:
        make, flags, code = CASES[name]
        print(write(folder, name, make()), code, flags, flush=True)


if __name__ == "__main__":
    main()
