#!/usr/bin/env python3
"""Whole processes and batches by number of threads, as a table: medians of wall-clock time.

Usage: cores.py BURNISH FOLDER [ROUNDS]
  FOLDER  for a torus of a million triangles, copies of a small one, and pictures; emptied before and removed after"""
import os
import shutil
import subprocess
import sys
import time

import measure

SIZES = ("256x256", "1920x1080", "3840x2160")
BUNNY = "/usr/share/glmark2/models/bunny.obj"
burnish, folder = sys.argv[1:3]
rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 11
threads = measure.thread_counts()


def seconds(*words):
    start = time.perf_counter()
    subprocess.run([burnish, *words, "--quiet"], check=True, stdout=subprocess.DEVNULL)
    return time.perf_counter() - start


def medians(count, of):
    """Of each number of threads; they take turns."""
    times = [[] for _ in threads]
    for _ in range(count):
        for own, number in zip(times, threads):
            own.append(of(number))
    return [measure.median(own) for own in times]


def draw(path, size):
    return medians(rounds, lambda number: seconds("render", path, "-o", f"{folder}/out.png", f"--size={size}", f"--threads={number}"))


def batch(count):
    return medians(min(rounds, 3), lambda number: seconds("batch", f"{folder}/many", "-d", f"{folder}/thumbs", "--size=256", "--force",
                                                         f"--jobs={number}") / count)


def write_torus(path, grid):
    with open(path, "wb") as file:
        file.write(measure.torus_stl(grid))


shutil.rmtree(folder, ignore_errors=True)
os.makedirs(f"{folder}/many")
write_torus(f"{folder}/torus.stl", 708 if rounds > 1 else 70)
many = 400 if rounds > 1 else 4
write_torus(f"{folder}/many/0.stl", 100) # 20,000 triangles
for i in range(1, many):
    shutil.copy(f"{folder}/many/0.stl", f"{folder}/many/{i}.stl")
print("| ms | " + " | ".join(f"{number} thread{'s' * (number > 1)}" for number in threads) + " |\n| --- |" + " ---: |" * len(threads))
for name, path in (("bunny.obj", BUNNY), ("torus.stl, a million triangles", f"{folder}/torus.stl")):
    for size in SIZES if os.path.exists(path) else ():
        print(f"| {name}, {size} | " + " | ".join(f"{1e3 * value:.0f}" for value in draw(path, size)) + " |", flush=True)
print(f"| batch: a picture of 256x256 of {many}, 20,000 triangles each | " + " | ".join(f"{1e3 * value:.2f}" for value in batch(many)) + " |")
shutil.rmtree(folder)
