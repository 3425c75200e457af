#!/usr/bin/env python3
"""Times whole processes, which draw each file to a PNG in turns on all cores: burnish, an older burnish, f3d.

Usage: parts.py BUILD FOLDER ROUNDS [OLD]
  BUILD   its build folder, with the programs of bench/peers
  FOLDER  files of parts; or subfolders, which the table below names, with files for its rows
  OLD     the older program

Prints one line per file and row: medians of wall-clock milliseconds with their quartiles, ratios of these and of processor time, the
peak of memory in MiB. A round comes first that fills the caches. Then a line per row: geometric mean and worst of the ratios."""
import math
import os
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import measure

HD = "--resolution=1920,1080"
PLAIN = "--look=plain --samples=1"  # what f3d draws
# (subfolder or built-in object, arguments of burnish after the file, the peer)
ROWS = [("", "--version", "true"), *(("parts", f"--size={size} {look}".strip(), "f3d" * (size == 256)) for size in (128, 256) for look in ("", PLAIN)),
        ("parts", HD, "f3d"), ("parts", f"{HD} {PLAIN}", "f3d"),
        *(("parts", f"{HD} --look={look}", "") for look in ("plain", "three-point", "clay", "technical", "drawing")),
        ("load", "--size=16 --samples=1 --look=plain", ""), ("batch", "--size=256", ""), ("batch", "--size=256 --look=plain", ""),
        *((mesh, f"{HD} {PLAIN} --lobe={lobe}", "") for mesh in (":teapot", ":knot") for lobe in ("energy:2", "composite", "power")),
        ("projects", "--size=512 --plate=sheet", ""), ("points", HD, ""), ("rays", f"{HD} --raytracing", ""), ("rays", HD, "")]
LONG = 15e3  # milliseconds that a row may take, after three rounds

if len(sys.argv) < 4:
    sys.exit("usage: parts.py BUILD FOLDER ROUNDS [OLD]")
build, folder, rounds, *old = sys.argv[1:]
rounds = int(rounds)
patience = [300 if rounds > 1 else 0] # seconds; a single round is a check, not a measurement


def files_of(subfolder):
    if not subfolder or subfolder[0] == ":":
        return [subfolder] if os.path.isdir(f"{folder}/parts") else []
    path = f"{folder}/{subfolder}"
    if subfolder == "parts" and not os.path.isdir(path):
        path = folder
    return sorted(f"{path}/{name}" for name in os.listdir(path)) if os.path.isdir(path) else []


def command_of(program, file, arguments, scratch):
    if program == "f3d":
        size = HD if HD in arguments else "--resolution=256,256"
        return ["f3d", "--dry-run", "--quiet", file, "--output", f"{scratch}/part.png", size]
    if program == "true" or not file:
        return [program, arguments]
    output = ["-d", f"{scratch}/batch", "--force"] if os.path.isdir(file) else ["-o", f"{scratch}/part.png", "--overwrite", "--quiet"]
    return [program, "batch" if os.path.isdir(file) else "render", file, *output, *arguments.split()]


def run(file, arguments, programs, scratch, display):
    """[wall ms, KiB, processor ms] of each round, by program; none for a program that fails."""
    figures = {program: [] for program in programs}
    for number in range(rounds + 1):
        measure.wait_until_quiet(patience)
        for program in [program for program in programs if program in figures]:
            figure = measure.run(build, command_of(program, file, arguments, scratch), display)
            if not figure:
                del figures[program]
            elif number:
                figures[program].append(figure)
        if number >= 3 and sum(figure[0] for own in figures.values() for figure in own) > LONG:
            break
    return figures


def show(figures, scale=1):
    low, middle, high = (measure.quantile(figures, share) / scale for share in (0.25, 0.5, 0.75))
    return f"{middle:.2f} ({low:.2f} to {high:.2f})"


def main(scratch, display):
    ours, before = f"{build}/burnish", old[0] if old else ""
    summary = []
    print("| row | ms: old | new | new / old | processor: new / old | MiB: old | new | peer, ms | peer / new | MiB |\n|" + " --- |" * 10)
    for subfolder, arguments, peer in ROWS:
        ratios = []
        for file in files_of(subfolder):
            figures = run(file, arguments, [name for name in (before, ours, peer) if name], scratch, display)
            columns = {name: list(zip(*values)) for name, values in figures.items()}
            middle = {name: [measure.median(column) for column in own] for name, own in columns.items()}
            none = [math.nan] * 3
            then, now, theirs = (middle.get(name, none) for name in (before, ours, peer))
            ratios.append((now[0] / then[0], now[2] / then[2], now[1] / then[1], now[0] / theirs[0]))
            times = [show(columns[name][0]) if name in columns else "–" for name in (before, ours, peer)]
            print(f"| {os.path.basename(file)} {arguments} | {times[0]} | {times[1]} | {ratios[-1][0]:.3f} | {ratios[-1][1]:.3f} | {then[1] / 1024:.0f} "
                  f"| {now[1] / 1024:.0f} | {times[2]} | {1 / ratios[-1][3]:.1f} | {theirs[1] / 1024:.0f} |", flush=True)
        if len(ratios) > 1:
            summary.append((f"{subfolder} {arguments}", list(zip(*ratios))))
    print("\nnew by old: geometric mean, worst\n\n| row | time | processor | memory | peer / new: mean, worst |\n|" + " --- |" * 5)
    for name, columns in summary:
        means = [(math.exp(sum(map(math.log, column)) / len(column)), max(column)) for column in columns]
        print(f"| {name} |" + "".join(f" {mean:.3f}, {worst:.3f} |" for mean, worst in means[:3]) + f" {1 / means[3][0]:.1f}, {1 / means[3][1]:.1f} |")


server, display_name = measure.start_x() if shutil.which("f3d") and shutil.which("Xvfb") else (None, "")
if not server:
    print("bench-peers: without f3d or Xvfb; scripts/install-deps peers", file=sys.stderr)
try:
    with tempfile.TemporaryDirectory(prefix="bench-parts.") as temporary:
        main(temporary, display_name)
finally:
    if server:
        server.terminate()
        server.wait()
for mesh in files_of("rays") if os.access(f"{build}/bench_rays", os.X_OK) else []:
    print(f"\n{os.path.basename(mesh)}", flush=True)
    subprocess.run([f"{build}/bench_rays", mesh], check=False)
