#!/usr/bin/env python3
"""Draws large clouds and meshes, whole and as previews: the rows of docs/performance.md, points and previews.

usage: clouds.py BURNISH FOLDER [POINTS [TRIANGLES]]

FOLDER receives the inputs, 4 GB by default: 30 million points on three surfaces in random order, and a wavy square of
10 million triangles as binary STL, OBJ, and binary and ASCII PLY. Each row is one run at 1024 x 768 pixels.
"""
import array
import math
import os
import random
import sys
import tempfile

HEAD = "ply\nformat %s 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
FACES = "element face %d\nproperty list uchar int vertex_indices\n"


def point():
    """On a sphere, a cylinder or a plane."""
    turn, height, kind = 2 * math.pi * random.random(), 2 * random.random() - 1, random.random()
    if kind < 0.4:
        radius = math.sqrt(1 - height * height)
        return radius * math.cos(turn), radius * math.sin(turn), height
    if kind < 0.7:
        return 2.5 + 0.7 * math.cos(turn), 0.7 * math.sin(turn), height
    return 5 * random.random() - 1.5, 3 * random.random() - 1.5, -1


def write_cloud(path, count):
    random.seed(1)
    with open(path, "wb") as file:
        file.write((HEAD % ("binary_little_endian", count) + "end_header\n").encode())
        for first in range(0, count, 100000):
            values = array.array("f")
            for _ in range(min(100000, count - first)):
                values.extend(point())
            file.write(values.tobytes())


def position(side, i):
    x, y = 2 * (i // side) / (side - 1) - 1, 2 * (i % side) / (side - 1) - 1
    return x, y, 0.15 * math.sin(5 * x) * math.cos(4 * y)


def triangles(side):
    for i in range(side * (side - 1)):
        if i % side < side - 1:
            yield i, i + side, i + side + 1
            yield i, i + side + 1, i + 1


def write_meshes(folder, side):
    count = 2 * (side - 1) * (side - 1)
    places = [position(side, i) for i in range(side * side)]
    with open(f"{folder}/square.stl", "wb") as file:
        file.write(bytes(80) + count.to_bytes(4, "little"))
        for corners in triangles(side):
            values = array.array("f", (0, 0, 0))
            for corner in corners:
                values.extend(places[corner])
            file.write(values.tobytes() + b"\0\0")
    with open(f"{folder}/square.obj", "w") as file:
        file.writelines("v %.6f %.6f %.6f\n" % p for p in places)
        file.writelines("f %d %d %d\n" % (a + 1, b + 1, c + 1) for a, b, c in triangles(side))
    with open(f"{folder}/square-ascii.ply", "w") as file:
        file.write(HEAD % ("ascii", len(places)) + FACES % count + "end_header\n")
        file.writelines("%.6f %.6f %.6f\n" % p for p in places)
        file.writelines("3 %d %d %d\n" % t for t in triangles(side))
    with open(f"{folder}/square.ply", "wb") as file:
        file.write((HEAD % ("binary_little_endian", len(places)) + FACES % count + "end_header\n").encode())
        for p in places:
            file.write(array.array("f", p).tobytes())
        for t in triangles(side):
            file.write(b"\3" + array.array("i", t).tobytes())


def measure(burnish, path, limit):
    """Wall-clock and processor time in seconds, and the peak in MB."""
    picture = tempfile.mktemp(suffix=".png")
    arguments = [burnish, "render", path, "-o", picture, "--resolution=1024,768"]
    start = os.times().elapsed
    child = os.spawnv(os.P_NOWAIT, burnish, arguments + ([f"--max-memory={limit}"] if limit else []))
    _, status, usage = os.wait4(child, 0)
    if status != 0:
        sys.exit(f"{path}: status {status}")
    os.remove(picture)
    return os.times().elapsed - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1000


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    burnish, folder = sys.argv[1:3]
    points, count = [int(n) for n in sys.argv[3:] + ["30000000", "10000000"][len(sys.argv) - 3:]]
    os.makedirs(folder, exist_ok=True)
    if not os.path.exists(f"{folder}/cloud.ply"):
        write_cloud(f"{folder}/cloud.ply", points)
        write_meshes(folder, int(math.sqrt(count / 2)) + 1)
    for name in ("cloud.ply", "square.stl", "square.obj", "square.ply", "square-ascii.ply"):
        for limit in ("", "300M", "500M") + (("1G",) if name == "cloud.ply" else ()):
            print("| %s | %s | %.1f | %.1f | %.0f |" % (name, limit or "none", *measure(burnish, f"{folder}/{name}", limit)),
                  flush=True)


main()
