#!/usr/bin/env python3
"""burnish alone, scene by scene: least and median milliseconds per frame.

Usage: scenes.py [--only NAME] [--threads N] [--samples N] [--size W,H] [--frames N] PROGRAMS [FILE...]

Without files: all scenes of scenes.h, or with --only the ones whose names start with NAME. Draws frames for about half a second, at
least --frames of them. To compare two builds, run this with the programs of each in turn."""
import argparse
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import measure

parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
parser.add_argument("--only", default="")
parser.add_argument("--threads", type=int, default=1)
parser.add_argument("--samples", type=int, default=1)
parser.add_argument("--size", default="1920,1080")
parser.add_argument("--frames", type=int, default=9)
parser.add_argument("programs")
parser.add_argument("files", nargs="*")
flags = parser.parse_args()

burnish = measure.Contestant(f"{flags.programs}/bench_peers_burnish", flags.threads)
failed = False
print(f"{'ms per frame':<24} {'triangles':>9} {'drawn':>9} {'pixels':>9} {'least':>9} {'median':>9}")
for source in flags.files or [scene for scene in burnish.scenes() if scene.startswith(flags.only)]:
    reply = burnish.request(f"open {flags.size.replace(',', ' ')} {flags.samples} {source}")
    times, error = burnish.frames("scene", 1) if reply.startswith("ready") else (None, reply)
    if error:
        print(f"scenes.py: {source}: {error}", file=sys.stderr)
        failed = True
        continue
    triangles, drawn, pixels = burnish.request("counts").split()[1:]
    times, _ = burnish.frames("scene", min(1000, max(flags.frames, int(500 / times[0]))))
    print(f"{source.rpartition('/')[2]:<24} {triangles:>9} {drawn:>9} {pixels:>9} {min(times):9.3f} {measure.median(times):9.3f}", flush=True)
burnish.stop()
sys.exit(failed)
