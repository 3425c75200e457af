#!/usr/bin/env python3
"""The runner: starts the contestants, times them in turn, compares their pictures and prints a table.

Usage: frames.py PROGRAMS SCRATCH [ROUNDS]
  PROGRAMS  folder of the contestants

Contestants of one scene and thread count run at the same time, but only one of them draws at a time: each round asks each for a few
frames in turn, so a busy moment affects all alike. A round waits for a quiet moment first; rounds without one are counted."""
import collections
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import measure

# The first of each is the reference of the ratios; family is energy:2, the default.
VARIANTS = {
    "burnish": ("family", "family-two-sided", "power", "schlick"),
    "llvmpipe": ("power", "power-srgb", "power-two-sided", "family", "schlick"),
}
PACKAGES = {"burnish": "", "llvmpipe": "libegl-dev libgles-dev libegl-mesa0 libgl1-mesa-dri"}
SCENES = ("bunny", "bunny16")
FRAMES = 3

if not 3 <= len(sys.argv) <= 4:
    sys.exit("usage: frames.py PROGRAMS SCRATCH [ROUNDS]")
programs, scratch = sys.argv[1:3]
rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 11
cores = os.cpu_count()
patience = [300 if rounds > 1 else 0] # seconds; a single round is a check, not a measurement
figures = collections.defaultdict(list) # {name: values}
skipped = {}
comparisons = {} # {(scene, contestant): bytes by their difference}
count = collections.Counter() # rounds, busy_rounds


def begin_round():
    count["rounds"] += 1
    count["busy_rounds"] += not measure.wait_until_quiet(patience)


# ---- Frames ----

def start(name, scene, threads):
    """The contestant with its scene open, or None."""
    program = f"{programs}/bench_peers_{name}"
    if not os.access(program, os.X_OK):
        skipped.setdefault(name, f"not built: install {PACKAGES[name]} (scripts/install-deps peers)")
        return None
    contestant = measure.Contestant(program, threads)
    reply = contestant.request(f"open 1920 1080 1 {scene}")
    if not reply.startswith("ready "):
        skipped.setdefault(name, reply)
        contestant.stop()
        return None
    print("  " + reply.removeprefix("ready "))
    return contestant


def draw_to_file(name, scene, contestant):
    picture = f"{scratch}/{scene}-{name}.rgb"
    if "ok" != contestant.request(f"picture power {picture}"):
        return None
    with open(picture, "rb") as rgb:
        return rgb.read()


def run_frames(scene, threads):
    print(f"{scene}, {threads} thread{'s' * (threads > 1)}:")
    running = {name: contestant for name in VARIANTS if (contestant := start(name, scene, threads))}
    for _ in range(rounds):
        begin_round()
        for name, contestant in running.items():
            for variant in VARIANTS[name]:
                times, error = contestant.frames(variant, FRAMES)
                if error:
                    skipped.setdefault(name, f"{variant}: {error}")
                else:
                    figures[f"frame.{scene}.t{threads}.{name}.{variant}"] += times
                time.sleep(0.01) # lets spinning threads fall asleep
    if threads == 1:
        drawn = {name: draw_to_file(name, scene, contestant) for name, contestant in running.items()}
        for name in drawn:
            if name != "burnish" and drawn.get("burnish") and drawn[name]:
                comparisons[scene, name] = collections.Counter(abs(a - b) for a, b in zip(drawn["burnish"], drawn[name]))
    for contestant in running.values():
        contestant.stop()


# ---- Report ----

def print_table():
    print(f"\n{'ms':<44} {'median':>9} {'quarter':>9} {'minimum':>9} {'x ours':>9}")
    for name, values in figures.items():
        ours = ".".join([*name.split(".")[:3], "burnish", "family"]) # frame.SCENE.THREADS: the contestant follows
        middle = measure.median(values)
        print(f"{name:<44} {middle:9.2f} {measure.quantile(values, 0.25):9.2f} {measure.quantile(values, 0):9.2f} "
              f"{middle / measure.median(figures.get(ours)):9.2f}")


def print_comparisons():
    print("\nPictures with cos^n, sRGB bytes, histograms of the difference from burnish:")
    for (scene, name), counts in comparisons.items():
        print(f"  {scene}, {name}:" + "".join(f" {difference}: {counts[difference]}" for difference in sorted(counts)))


def main():
    sys.stdout.reconfigure(line_buffering=True)
    print(f"{cores} cores, load {os.getloadavg()[0]:.1f} at the start; {rounds} rounds of {FRAMES} frames, 1920x1080, one sample")
    for scene in SCENES:
        for threads in range(1, min(cores, 2) + 1):
            run_frames(scene, threads)
    print_table()
    print_comparisons()
    print(f"{count['busy_rounds']} of {count['rounds']} rounds began while other programs ran")
    for name in VARIANTS:
        if name in skipped:
            print(f"skipped: {name}: {skipped[name]}")


main()
