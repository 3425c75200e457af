#!/usr/bin/env python3
"""burnish against llvmpipe on many meshes: one line each, then means and quartiles, for one and two threads, one sample and four,
1920x1080 and 256x256.

Usage: meshes.py [--short] PROGRAMS [INPUT...]
  PROGRAMS  folder of the contestants; without inputs: the bunny and the built-in objects
  --short   one frame each of 256x256, one thread, one sample

Both load a file with burnish's reader and draw the same triangles. burnish draws energy:2 in sRGB, llvmpipe pow in linear bytes; four
samples are 4x MSAA with its resolve. Both cull back faces. The contestants take turns of a few frames while the
other waits: a busy moment affects both."""
import math
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import measure

CONTESTANTS = {"burnish": "family", "llvmpipe": "power"} # and their variant
SCENES = "bunny bunny16 :teapot :knot :torus :sphere".split()
peers = set() # versions
SLOW = 100 # milliseconds: such a frame is timed once, a third of it in rounds of one
FRAMES, ROUNDS = 3, 3
SETUPS = [(threads, samples, size) for threads in (1, 2) for size in ((1920, 1080), (256, 256)) for samples in (1, 4)]


def time_setup(contestants, is_short):
    """Sorted times of each contestant, or None if one can't draw."""
    values = [[], []]
    for number in range(1 if is_short else 1 + ROUNDS):
        for own, contestant, variant in zip(values, contestants, CONTESTANTS.values()):
            if number == 0 or own[0] <= SLOW:
                times, _ = contestant.frames(variant, FRAMES if number and own[0] < SLOW / 3 else 1)
                if times is None:
                    return None
                own += times
    return [sorted(own) for own in values]


def run_setup(contestants, setup, source, is_short):
    """(triangles, drawn ones, pixels, (median, least) of each contestant), or None."""
    _, samples, (width, height) = setup
    for name, contestant in zip(CONTESTANTS, contestants):
        reply = contestant.request(f"open {width} {height} {samples} {source}")
        if not reply.startswith("ready"):
            print(f"bench-peers: {name}: {reply}", file=sys.stderr)
            return None
    peers.add(measure.mesa(reply))
    counts = contestants[0].request("counts").split()
    if counts[1:2] == ["0"]:
        print(f"bench-peers: {source} has no triangles", file=sys.stderr) # llvmpipe draws no points
        return None
    times = time_setup(contestants, is_short) if counts[0] == "ok" else None
    if not times:
        print(f"bench-peers: {source} can't be drawn", file=sys.stderr)
        return None
    return (*map(int, counts[1:]), *((own[len(own) // 2], own[0]) for own in times))


def print_summary(results, least):
    ratios = sorted(theirs[least] / ours[least] for _, (_, _, _, ours, theirs) in results)
    count = len(ratios)
    mean = math.exp(sum(map(math.log, ratios)) / count)
    print(f"by {'least times' if least else 'medians'}: geometric mean {mean:.2f}, least {ratios[0]:.2f}, quartiles {ratios[count // 4]:.2f} "
          f"{ratios[count // 2]:.2f} {ratios[3 * count // 4]:.2f}, most {ratios[-1]:.2f}; {sum(ratio < 1 for ratio in ratios)} of {count} "
          "slower than llvmpipe")


def print_setup(setup, results):
    threads, samples, (width, height) = setup
    print(f"\n{width}x{height}, {samples} sample{'s' * (samples > 1)}, {threads} thread{'s' * (threads > 1)}")
    print("%-40s %9s %8s %8s %9s %9s %6s %9s %9s %6s" % ("medians, then least times; ms", "triangles", "drawn", "pixels", "burnish", "llvmpipe",
                                                       "ratio", "burnish", "llvmpipe", "ratio"))
    for name, (triangles, drawn, pixels, ours, theirs) in results:
        print("%-40s %9d %8d %8d %9.2f %9.2f %6.2f %9.2f %9.2f %6.2f" % (name, triangles, drawn, pixels, ours[0], theirs[0], theirs[0] / ours[0],
                                                                       ours[1], theirs[1], theirs[1] / ours[1]))
    for least in (0, 1) if results else ():
        print_summary(results, least)


def main():
    is_short = sys.argv[1:2] == ["--short"]
    if len(sys.argv) < 2 + is_short:
        sys.exit("usage: meshes.py [--short] PROGRAMS [INPUT...]")
    programs, *inputs = sys.argv[1 + is_short:]
    setups = [(1, 1, (256, 256))] if is_short else SETUPS
    for name in CONTESTANTS:
        if not os.access(f"{programs}/bench_peers_{name}", os.X_OK):
            sys.exit(f"bench-peers: {programs}/bench_peers_{name} is not built (scripts/install-deps peers)")
    pairs = {threads: [measure.Contestant(f"{programs}/bench_peers_{name}", threads) for name in CONTESTANTS] for threads in {setup[0] for setup in setups}}
    results = [[] for _ in setups]
    for number, source in enumerate(inputs or SCENES, 1):
        name = source.rpartition("/")[2][:39]
        for setup, own in zip(setups, results):
            result = run_setup(pairs[setup[0]], setup, source, is_short)
            if result:
                own.append((name, result))
        print(number, name, file=sys.stderr)
    for contestant in sum(pairs.values(), []):
        contestant.stop()
    print(f"llvmpipe: {', '.join(peers)}")
    for setup, own in zip(setups, results):
        print_setup(setup, own)


main()
