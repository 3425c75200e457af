#!/usr/bin/env python3
"""The runner: starts the contestants, times them in turn, compares their pictures and prints a table.

Usage: frames.py PROGRAMS BURNISH SCRATCH [ROUNDS]
  PROGRAMS  folder of the contestants

Contestants of one scene and thread count run at the same time, but only one of them draws at a time: each round asks each for a few
frames in turn, so a busy moment affects all alike. A round waits for a quiet moment first; rounds without one are counted."""
import array
import collections
import os
import shutil
import subprocess
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import measure

# The first of each is the reference of the ratios; family is energy:2, the default.
VARIANTS = {
    "burnish": ("family", "family-two-sided", "power", "schlick"),
    "llvmpipe": ("power", "power-srgb", "power-two-sided", "family", "schlick"),
    "embree": ("family", "power"),
}
PACKAGES = {"burnish": "", "llvmpipe": "libegl-dev libgles-dev libegl-mesa0 libgl1-mesa-dri", "embree": "libembree-dev"}
SCENES = ("bunny", "bunny16")
SIZES = {"256": "256,256", "1080p": "1920,1080"}
FRAMES, NOTHING = 3, 0xFFFFFFFF

if not 4 <= len(sys.argv) <= 5:
    sys.exit("usage: frames.py PROGRAMS BURNISH SCRATCH [ROUNDS]")
programs, burnish, scratch = sys.argv[1:4]
rounds = int(sys.argv[4]) if len(sys.argv) > 4 else 11
cores = os.cpu_count()
patience = [300 if rounds > 1 else 0] # seconds; a single round is a check, not a measurement
figures = collections.defaultdict(list) # {name: values}
skipped = {}
comparisons = {} # {(scene, contestant): comparison}
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


def compare(ours, theirs):
    """Two (picture, triangle numbers): pixels of the same triangle and of others with histograms of their bytes' differences, and
    pixels that only one covers. Pixels that neither covers are not counted."""
    result = {"same": 0, "other": 0, "coverage": 0, "histogram": collections.Counter(), "other_histogram": collections.Counter()}
    (a, t), (b, u) = ours, theirs
    for i, (x, y) in enumerate(zip(t, u)):
        if x == y == NOTHING:
            continue
        kind = "same" if x == y else "coverage" if NOTHING in (x, y) else "other"
        result[kind] += 1
        if kind != "coverage":
            result["histogram" if x == y else "other_histogram"].update(abs(a[k] - b[k]) for k in range(3 * i, 3 * i + 3))
    return result


def draw_to_file(name, scene, contestant):
    picture, triangles = f"{scratch}/{scene}-{name}.rgb", f"{scratch}/{scene}-{name}.triangles"
    if "ok" != contestant.request(f"picture power {picture}") or "ok" != contestant.request(f"triangles {triangles}"):
        return None
    with open(picture, "rb") as rgb, open(triangles, "rb") as numbers:
        return rgb.read(), array.array("I", numbers.read())


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
                comparisons[scene, name] = compare(drawn["burnish"], drawn[name])
    for contestant in running.values():
        contestant.stop()


# ---- Whole processes ----

def time_process(scene, size, threads, who, display, counts):
    picture = {"input": f"{scratch}/{scene}.ply", "output": f"{scratch}/{scene}-{size}-{who}.png", "size": SIZES[size]}
    figure = measure.draw(programs, picture, burnish if who == "burnish" else None, threads, display)
    if not figure:
        print(f"bench-peers: {who} can't draw {picture['input']}", file=sys.stderr)
    elif counts:
        for kind, value in zip(("process", "memory"), figure):
            figures[f"{kind}.{scene}.{size}.t{threads}.{who}"].append(value)


def run_processes():
    server, display = None, ""
    if not shutil.which("f3d") or not shutil.which("Xvfb"):
        skipped["f3d"] = "not found: install f3d xvfb (scripts/install-deps peers)"
    else:
        server, display = measure.start_x()
        if not server:
            skipped["f3d"] = "Xvfb does not start"
    for scene in SCENES:
        if subprocess.run([f"{programs}/bench_peers_ply", scene, f"{scratch}/{scene}.ply"], check=False, stdout=subprocess.DEVNULL).returncode:
            print(f"bench-peers: no PLY of {scene}", file=sys.stderr)
            continue
        for number in range(rounds + 1): # the first fills the caches of files and shaders
            begin_round()
            for size in SIZES:
                for threads in range(1, min(cores, 2) + 1):
                    for who in ("f3d", "burnish") if server else ("burnish",):
                        time_process(scene, size, threads, who, display, number > 0)
    if server:
        server.terminate()
        server.wait()


# ---- Report ----

def print_table():
    print(f"\n{'ms; KiB of memory':<44} {'median':>9} {'quarter':>9} {'minimum':>9} {'x ours':>9}")
    for name, values in figures.items():
        is_frame = name.startswith("frame.")
        # frame.SCENE.THREADS, process.SCENE.SIZE.CORES: the contestant follows
        ours = ".".join(name.split(".")[:3 if is_frame else 4] + ["burnish"] + ["family"] * is_frame)
        middle = measure.median(values)
        print(f"{name:<44} {middle:9.2f} {measure.quantile(values, 0.25):9.2f} {measure.quantile(values, 0):9.2f} "
              f"{middle / measure.median(figures.get(ours)):9.2f}")


def histogram_text(histogram):
    return "".join(f" {difference}: {histogram[difference]}" for difference in sorted(histogram))


def print_comparisons():
    print("\nPictures with cos^n, sRGB bytes, histograms of the difference from burnish:")
    for (scene, name), c in comparisons.items():
        print(f"  {scene}, {name}: {c['same']} pixels of the same triangle,{histogram_text(c['histogram'])}")
        print(f"    {c['other']} pixels of another triangle,{histogram_text(c['other_histogram'])}; {c['coverage']} pixels covered by one only")


def main():
    sys.stdout.reconfigure(line_buffering=True)
    print(f"{cores} cores, load {os.getloadavg()[0]:.1f} at the start; {rounds} rounds of {FRAMES} frames, 1920x1080, one sample")
    for scene in SCENES:
        for threads in range(1, min(cores, 2) + 1):
            run_frames(scene, threads)
    run_processes()
    print_table()
    print_comparisons()
    print(f"{count['busy_rounds']} of {count['rounds']} rounds began while other programs ran")
    for name in (*VARIANTS, "f3d"):
        if name in skipped:
            print(f"skipped: {name}: {skipped[name]}")


main()
