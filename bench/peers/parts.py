#!/usr/bin/env python3
"""Times whole processes: f3d and burnish draw each file to a PNG in turns, on all cores.

Usage: parts.py PROGRAMS BURNISH SCRATCH ROUNDS FILE...

Prints one line per file and size: the size; milliseconds of f3d, of burnish with f3d's settings (--look=plain --samples=1) and of
burnish without flags; the peak memory of each in KiB; the file. Numbers are medians of the rounds, after one that fills the caches.
Standard error: per size, geometric means of f3d's times and memory over burnish's (plain, without flags, memory), and the least."""
import math
import os
import shutil
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import measure

CONTESTANTS = ("f3d", "burnish --look=plain", "burnish")

if len(sys.argv) < 6:
    sys.exit("usage: parts.py PROGRAMS BURNISH SCRATCH ROUNDS FILE...")
programs, burnish, scratch, rounds, *files = sys.argv[1:]
sizes = ("256,256", "1920,1080")
ratios = {size: [] for size in sizes}
patience = [300 if int(rounds) > 1 else 0] # seconds; a single round is a check, not a measurement


def run_part(file, size, display):
    figures = [[] for _ in CONTESTANTS]
    for number in range(int(rounds) + 1):
        measure.wait_until_quiet(patience)
        for who, name in enumerate(CONTESTANTS):
            picture = {"input": file, "output": f"{scratch}/part.png", "size": size, "default": name == "burnish"}
            figure = measure.draw(programs, picture, burnish if who else None, display)
            if not figure:
                sys.exit(f"bench-peers: {name} can't draw {file}")
            if number:
                figures[who].append(figure)
    medians = [[measure.median([figure[k] for figure in own]) for own in figures] for k in (0, 1)]
    print(size, *(f"{value:.2f}" for value in medians[0]), *(f"{value:.0f}" for value in medians[1]), file, flush=True)
    times, memory = medians
    ratios[size].append((times[0] / times[1], times[0] / times[2], memory[0] / memory[2]))


server, display = measure.start_x() if shutil.which("f3d") and shutil.which("Xvfb") else (None, "")
if not server:
    sys.exit("bench-peers: parts need f3d and Xvfb; scripts/install-deps peers")
try:
    for file in files:
        for size in sizes:
            run_part(file, size, display)
finally:
    server.terminate()
    server.wait()
for size, each in ratios.items():
    for name, column in zip(("plain", "without flags", "memory"), zip(*each)):
        print(f"{size}, {name}: {math.exp(sum(map(math.log, column)) / len(column)):.1f}, least {min(column):.1f}", file=sys.stderr)
