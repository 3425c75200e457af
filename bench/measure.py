"""Shared by the benchmarks of whole processes: quiet moments, statistics, processes, a torus."""
import array
import math
import os
import re
import struct
import subprocess
import time


def wait_until_quiet(patience):
    """Waits until the processors were idle for a tenth of a second, at most patience[0] seconds, which it counts down.
    Returns whether they were, True if that is unknown."""
    def ticks():
        with open("/proc/stat", encoding="ascii") as file: # user nice system idle iowait irq softirq steal
            return [int(word) for word in file.readline().split()[1:9]]
    try:
        while True:
            before = ticks()
            time.sleep(0.1)
            passed = [now - then for now, then in zip(ticks(), before)]
            if passed[3] + passed[4] >= 0.85 * sum(passed): # one tick of a core is a tenth of the pause
                return True
            if patience[0] <= 0:
                return False
            patience[0] -= 0.1
    except OSError:
        return True


def quantile(values, share):
    """Interpolated between neighbours; NaN without values."""
    if not values:
        return math.nan
    values = sorted(values)
    place = share * (len(values) - 1)
    below = int(place)
    above = min(below + 1, len(values) - 1)
    return values[below] + (place - below) * (values[above] - values[below])


def mesa(reply):
    """Mesa's version in what bench_peers_llvmpipe replies to "open"."""
    found = re.search(r"Mesa [0-9.]+", reply)
    return found[0] if found else "an unnamed OpenGL"


def median(values):
    return quantile(values, 0.5)


def on_one_core():
    """Binds this process to its last core: the first ones get most interrupts."""
    os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})


class Contestant:
    """A program that replies to lines; bench/peers/worker.h has the protocol. One thread is bound to one core."""

    def __init__(self, program, threads):
        environment = dict(os.environ, LP_NUM_THREADS="0" if threads == 1 else "2")
        self.process = subprocess.Popen([program, str(threads)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment,
                                        preexec_fn=on_one_core if threads == 1 else None)

    def request(self, line):
        try:
            self.process.stdin.write(line + "\n")
            self.process.stdin.flush()
            reply = self.process.stdout.readline()
        except BrokenPipeError:
            reply = ""
        return reply.rstrip("\n") or "error it ended"

    def frames(self, variant, count):
        """(milliseconds of each frame, None), or (None, the reply)."""
        reply = self.request(f"frame {variant} {count}")
        return ([float(word) for word in reply.split()[1:]], None) if reply.startswith("ok") else (None, reply)

    def stop(self):
        self.process.stdin.close()
        self.process.wait()


def run(build, command, display):
    """Wall-clock milliseconds of a process, its peak of resident memory in KiB and its processor milliseconds; None if it fails.
    bench_peers_process starts the program: a child's peak starts from its parent's, and Python's is large."""
    done = subprocess.run([f"{build}/bench/peers/bench_peers_process", *command], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          env=dict(os.environ, DISPLAY=display), check=False)
    if command[0] == "f3d":
        time.sleep(0.1) # the X server cleans up after it
    return [float(word) for word in done.stdout.split()] if done.returncode == 0 else None


def start_x():
    """Starts Xvfb; returns (its process, its display), or (None, "")."""
    ours, theirs = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(theirs), "-screen", "0", "1920x1080x24", "-nolisten", "tcp"],
                              pass_fds=[theirs], stderr=subprocess.DEVNULL)
    os.close(theirs)
    with open(ours, encoding="ascii") as file:
        number = file.readline().strip()
    if not number.isdigit():
        server.terminate()
        server.wait()
        return None, ""
    return server, f":{number}"


def torus_stl(grid, height=1):
    """A torus of 2 grid^2 triangles as binary STL, its z times `height`."""
    turn = 2 * math.pi / grid
    angles = [turn * i for i in range(grid)]
    normals = [(math.cos(u) * math.cos(v), math.sin(u) * math.cos(v), math.sin(v)) for u in angles for v in angles]
    positions = [(20 * math.cos(u) + 7 * x, 20 * math.sin(u) + 7 * y, 7 * z * height)
                 for u, row in zip(angles, range(grid)) for x, y, z in normals[row * grid:(row + 1) * grid]]
    out = bytearray(struct.pack("<80xI", 2 * grid * grid))
    for i in range(grid * grid):
        row, column = divmod(i, grid)
        right, below = (column + 1) % grid, (row + 1) % grid * grid
        here = row * grid
        for corners in (i, below + column, below + right), (i, below + right, here + right):
            out += array.array("f", (*normals[i], *positions[corners[0]], *positions[corners[1]], *positions[corners[2]])).tobytes() + b"\0\0"
    return bytes(out)
