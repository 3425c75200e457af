#!/usr/bin/env python3
"""Rate of burnish batch: 200 meshes of 5,000 triangles (binary STL), 256 x 256, one thread per picture.

Usage: batch.py BURNISH FOLDER [ROUNDS]
  FOLDER  for the meshes and their pictures

Prints a table: medians of ROUNDS batches of each look, in turns. Other programs on the machine lengthen processor time a little,
and wall time, which is not reported, a lot."""
import os
import sys

import measure

FILES = 200
LOOKS = {"--look=plain": "`--look=plain`", "--look=studio": "the default look"}

if len(sys.argv) < 3:
    sys.exit("usage: batch.py BURNISH FOLDER [ROUNDS]")
burnish, folder = sys.argv[1:3]
rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 5
meshes, pictures = f"{folder}/meshes", f"{folder}/pictures"
os.makedirs(meshes, exist_ok=True)
for i in range(FILES): # rings from flat to high: no two files are the same
    with open(f"{meshes}/{i:03}.stl", "wb") as file:
        file.write(measure.torus_stl(50, 0.5 + 2 * i / FILES))


def run(look):
    """Processor time of a batch, all its processes together, in ms."""
    null = [(os.POSIX_SPAWN_OPEN, output, "/dev/null", os.O_WRONLY, 0) for output in (1, 2)]
    process = os.posix_spawn(burnish, [burnish, "batch", meshes, "--size=256", "--force", "-d", pictures, look], os.environ, file_actions=null)
    _, state, usage = os.wait4(process, 0)
    if state:
        sys.exit("batch.py: burnish batch did not draw")
    return 1e3 * (usage.ru_utime + usage.ru_stime)


times = {look: [] for look in LOOKS}
for _ in range(rounds):
    for look in LOOKS:
        times[look].append(run(look) / FILES)
print("| | a picture | two cores would draw |\n| --- | --- | --- |")
for look, name in LOOKS.items():
    middle = sorted(times[look])[rounds // 2]
    print(f"| {name} | {middle:.1f} ms | {2000 / middle:.0f} a second |")
