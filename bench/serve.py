#!/usr/bin/env python3
"""Latency of single pictures: one process each, and requests to burnish serve-stdio.

Usage: serve.py BURNISH FOLDER [ROUNDS]
  FOLDER  for a mesh of 5,000 triangles and a picture

Prints a table: wall time of ROUNDS pictures of 256 x 256, in turns, after 5 untimed ones."""
import os
import struct
import subprocess
import sys
import time

import measure

FIRST = 5
LOOKS = {"--look=studio": "the default look", "--look=plain": "`--look=plain`"}
WAYS = ("`burnish render`, a process each", "`burnish render --sandbox`, two processes each", "`burnish serve-stdio`, which locks each request in")

if len(sys.argv) < 3:
    sys.exit("usage: serve.py BURNISH FOLDER [ROUNDS]")
burnish, folder = sys.argv[1:3]
rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 200
os.makedirs(folder, exist_ok=True)
mesh = f"{folder}/torus.stl"
stl = measure.torus_stl(50)
with open(mesh, "wb") as stream:
    stream.write(stl)


def render(look, *flags):
    process = os.posix_spawn(burnish, [burnish, "render", mesh, "--size=256", "--threads=1", "-o", f"{folder}/torus.png", look, *flags], os.environ)
    if os.waitpid(process, 0)[1]:
        sys.exit("serve.py: burnish render did not draw")


def request(server):
    line = b'{"name": "torus.stl"}\n'
    server.stdin.write(struct.pack("=II", len(line) + len(stl), 1) + line + stl)
    server.stdin.flush()
    size, _ = struct.unpack("=II", server.stdout.read(8))
    if not server.stdout.read(size).startswith(b'{"code":0,'):
        sys.exit("serve.py: serve-stdio did not draw")


def time_look(look):
    """Wall times of every way in ms, measured in turns."""
    server = subprocess.Popen([burnish, "serve-stdio", "--size=256", look], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    times = [[], [], []]
    for i in range(FIRST + rounds):
        clock = [time.monotonic()]
        for run in (lambda: render(look), lambda: render(look, "--sandbox"), lambda: request(server)):
            run()
            clock.append(time.monotonic())
        for way, own in enumerate(times):
            if i >= FIRST:
                own.append(1e3 * (clock[way + 1] - clock[way]))
    server.stdin.close()
    server.wait()
    return [sorted(own) for own in times]


print("| | | median, ms | 95 % are below, ms | of a process each |\n| --- | --- | ---: | ---: | ---: |")
for look, name in LOOKS.items():
    times = time_look(look)
    for way, own in zip(WAYS, times):
        middle = own[rounds // 2]
        print(f"| {name} | {way} | {middle:.1f} | {own[rounds * 95 // 100]:.1f} | {middle / times[0][rounds // 2]:.2f} |")
