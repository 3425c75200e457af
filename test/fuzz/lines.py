#!/usr/bin/env python3
"""Random command lines: commands, flags and words come from the program's completions, values from these words and from a list of
numbers, names and nonsense, some with a byte changed. Each line runs in its own process, in a fresh folder with the meshes of the
tests. It must end with a documented exit code within 20 s of processor time, report errors in a line that begins with "burnish: ", and
leave no temporary file.

Usage: lines.py BURNISH SCRATCH COUNT [SEED]
Prints lines that fail in the shell's syntax; then exits with 1."""
import glob
import os
import random
import re
import resource
import shlex
import shutil
import subprocess
import sys

INPUTS = ":sphere :torus :teapot :knot cube.obj wedge.stl colors.ply none.obj - . : :x /dev/null".split() + [""]
OUTPUTS = "out.png out.jpg out.svg out.pdf out.webp out.exr out.gif out.npy - /dev/full none/x.png . out".split() + [""]
VALUES = """0 1 2 3 -1 0.5 1e9 1e308 -1e308 nan inf 1e-320 , ,, 1,2 1,2,3 0,0,0 1,1,1,1 -1,0,0,0.2 1,2,3,4,5 #fff #abcdef red none auto all +Z
    -X taylor:2 minimax:8 power level.5 zeta3 taylor:3 camera-point:1,2,3 directional:0,0,1:0.5:#fff front,top,iso front iso,iso depth:d.png
    normal:n.exr color:- axes,scale 12,34 100,10 65536 4294967296 18446744073709551616 5K %s%n -- -o = true""".split() + [
    "", " ", "a\tb", "\udcff\udcfe", "\u20ac"]
# Flags whose larger values are valid but slow.
SLOW = "--resolution --size --frames --tessellation --columns --occlusion --samples --count --threads --edge-width".split()
SMALL = "1 2 16 24 24,16 0 -1 x 3, 1e1 none".split() + [""]


def read_completions(program):
    """{command: [(flag, whether it has a value, its words)]}"""
    commands, words = {}, {}
    for line in subprocess.run([program, "help", "--completion=bash"], capture_output=True, text=True, check=True).stdout.split("\n"):
        if match := re.match(r" {4}'([^']*)'.*\)", line):
            commands[match[1]] = current = []
        elif match := re.match(r" +flags='([^']*)'", line):
            current += [(*flag.partition("=")[:2], words.setdefault((id(current), flag.partition("=")[0]), [])) for flag in match[1].split()]
        elif match := re.match(r" +([-a-z]+)\) words='([^']*)'", line):
            words.get((id(current), match[1]), []).extend(match[2].split())
    if len(commands) < 5 or sum(map(len, commands.values())) < 50:
        sys.exit("lines.py: the completions list too few commands or flags")
    return commands


def read_exit_codes(program):
    text = subprocess.run([program, "--help"], capture_output=True, text=True, check=True).stdout
    codes = {int(code) for code in re.findall(r"^ *(\d+) ", text.partition("Exit codes")[2], re.M)}
    if len(codes) < 5:
        sys.exit("lines.py: --help lists too few exit codes")
    return codes


def make_value(pick, flag, words):
    if flag in SLOW:
        return pick.choice(SMALL)
    if words and pick.randrange(4):
        value = pick.choice(words)
    else:
        value = pick.choice(OUTPUTS if flag in ("--output", "--turntable") or not pick.randrange(6) else VALUES)
    if value and "/" not in value and not pick.randrange(8):
        changed = bytearray(os.fsencode(value))
        changed[pick.randrange(len(changed))] = ord(".") if (byte := pick.randrange(1, 256)) == ord("/") else byte
        value = os.fsdecode(bytes(changed))
    return value


def make_line(pick, commands):
    name = pick.choice(list(commands))
    line = name.split()
    operands = {"render": 1, "compare": 2}.get(name)
    if operands: # cheap unless a flag says otherwise
        line += ["--size=24", "--output=out.png"]
    else:
        operands = pick.randrange(2)
    line += [pick.choice(INPUTS[:7] if pick.randrange(3) else INPUTS) for _ in range(operands + (not pick.randrange(10)))]
    for _ in range(pick.randrange(7) if commands[name] else 0):
        flag, has_value, words = pick.choice(commands[name])
        value = make_value(pick, flag, words)
        if pick.randrange(4) if has_value else not pick.randrange(30):
            line.append(f"{flag}={value}")
        else:
            line += [flag, value] if has_value else [flag]
    return line


def run(program, line, codes):
    """(exit code, None or what was wrong)"""
    with open("stderr.txt", "wb") as errors:
        try:
            code = subprocess.run([program, *line], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=errors, timeout=120, check=False,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (20, 20))).returncode
        except subprocess.TimeoutExpired: # it waits instead of working
            return None, "did not end within two minutes"
    if code < 0:
        return code, "ended by a signal"
    if code not in codes:
        return code, "has an exit code that is not documented"
    if glob.glob(".burnish*"): # files that the program names itself while it writes
        return code, "left a temporary file"
    with open("stderr.txt", "rb") as file:
        if 2 <= code < 8 and not re.search(rb"^burnish: (?!warning)", file.read(), re.M):
            return code, "did not report why"
    return code, None


def main():
    if len(sys.argv) < 4:
        sys.exit("usage: lines.py BURNISH SCRATCH COUNT [SEED]")
    program, scratch, count = os.path.realpath(sys.argv[1]), sys.argv[2], int(sys.argv[3])
    pick = random.Random(int(sys.argv[4]) if len(sys.argv) > 4 else 1)
    data = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../data")
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    for kind in "obj", "mtl", "stl", "ply":
        for path in glob.glob(f"{data}/*.{kind}"):
            shutil.copy(path, scratch)
    commands, codes = read_completions(program), read_exit_codes(program)
    os.chdir(scratch)
    failed = done = 0
    for _ in range(count):
        line = make_line(pick, commands)
        code, wrong = run(program, line, codes)
        done += code == 0
        failed += wrong is not None
        if wrong:
            print(f"FAIL: {wrong}: {shlex.join([program, *line])}".encode(errors="surrogateescape").decode(errors="backslashreplace"))
    print(f"lines: {count} command lines, {done} of them did something, {failed} failed")
    sys.exit(failed > 0 or done < count / 10)


main()
