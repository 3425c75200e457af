#!/usr/bin/env python3
"""burnish next to this machine's GPU: milliseconds of a frame of 1920 x 1080 pixels, medians of frames in turns, as a table.

Usage: gpu.py PROGRAMS [--any] [INPUT...]
  --any   takes a driver that draws on the processor, too, and one frame of each
  INPUT   a scene (bench/peers/scenes.h) or a file; without any: a few scenes

burnish draws with one thread, two, four ... and as many as there are processors, energy:2 in sRGB. The GPU draws pow in linear bytes, its
buffers and programs are made before; "read back": its picture is copied into memory, where burnish's is."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import measure

SCENES = ("bunny", "bunny16", "texture", "lights-16", "rods", "spheres", "gear", "hair", "triangles")
ROUNDS, FRAMES = 7, 3
ANY = "--any" in sys.argv
programs, *inputs = [word for word in sys.argv[1:] if word != "--any"]
threads = measure.thread_counts()


def time_input(contestants, samples, source):
    """Medians of burnish for each number of threads, of the GPU and of the GPU with the picture read back."""
    for contestant in contestants:
        reply = contestant.request(f"open 1920 1080 {samples} {source}")
        if not reply.startswith("ready"):
            sys.exit(f"bench-gpu: {reply}")
    if not ANY and "llvmpipe (" in reply:
        sys.exit("bench-gpu: OpenGL draws on the processor (llvmpipe): no GPU is at hand")
    lanes = [(contestant, "scene") for contestant in contestants] + [(contestants[-1], "scene-read")]
    times = [[] for _ in lanes]
    for _ in range(1 if ANY else ROUNDS):
        for own, (contestant, variant) in zip(times, lanes):
            own += contestant.frames(variant, 1 if ANY else FRAMES)[0]
    return reply.removeprefix("ready ").split(", LP_NUM_THREADS")[0], [measure.median(own) for own in times]


# Two threads: the GPU's contestant then measures wall-clock time.
contestants = [measure.Contestant(f"{programs}/bench_peers_burnish", count) for count in threads] + [
    measure.Contestant(f"{programs}/bench_peers_llvmpipe", 2)]
rows = []
for source in inputs or SCENES:
    for samples in (1, 4):
        name, row = time_input(contestants, samples, source)
        rows.append(f"| {os.path.basename(source)} | {samples} | " + " | ".join(f"{value:.2f}" for value in row) + " |")
for contestant in contestants:
    contestant.stop()
print(f"Measured on: {name}; {threads[-1]} cores.\n")
print("| scene | samples | burnish, 1 thread | " + " | ".join(map(str, threads[1:])) + " | GPU | and read back |")
print("| --- |" + " ---: |" * (len(threads) + 3))
print("\n".join(rows))
