"""Runs every block of docs/*.md that is marked sh, as a reader would, with one folder per page.

Usage: guides.py PROGRAM SOURCE_DIR BUILD_DIR SCRATCH

HTML comments directly above a block, which readers do not see:
  needs: TOOL...   run only if these commands exist
  exits: CODE      the block ends with this exit code instead of 0
  file: NAME       the block is written to a file of that name instead
A block marked text directly below shows what the commands print, on both outputs: its lines must come in this order; "..."
stands for any others. part.stl, bracket.stl, before.stl ... and the folder parts are the reader's own files, made here.
"""
import glob
import os
import re
import shutil
import subprocess
import sys

PROGRAM, SOURCE, BUILD, SCRATCH = map(os.path.abspath, sys.argv[1:5])
BLOCK = re.compile(r"((?:^<!-- \w+: [^\n]* -->\n\n?)*)^```([^\n]*)\n(.*?)^```$\n*(?:^```text\n(.*?)^```$)?", re.M | re.S)
FILES = {"part.stl": (40, 20, 10), "bracket.stl": (60, 40, 5), "mug.stl": (8, 8, 9), "before.stl": (40, 20, 10), "after.stl": (40, 20, 12), "parts/base.stl": (30, 10, 10), "parts/left/arm.stl": (10, 10, 40)}
CORNERS = "023 031 457 476 015 054 267 273 046 062 137 175".split()


def box(x, y, z):
    """A closed box from the origin, as STL."""
    corners = [f"vertex {n % 2 * x} {n // 2 % 2 * y} {n // 4 * z}\n" for n in range(8)]
    facets = ("facet normal 0 0 0\nouter loop\n" + "".join(corners[int(n)] for n in facet) + "endloop\nendfacet\n" for facet in CORNERS)
    return "solid box\n" + "".join(facets) + "endsolid box\n"


def difference(wanted, got):
    """Where the printed lines differ from those of the page; None if nowhere."""
    pattern = "".join(r"(?:.*\n)*?" if line.strip() == "..." else re.escape(line) + r"\n" for line in wanted.splitlines())
    return None if re.fullmatch(pattern, got) else f"shows\n{wanted}prints\n{got}"


def run(page, text):
    """Failures, and the number of blocks that were run."""
    os.makedirs(os.path.join(SCRATCH, page, "parts", "left"))
    os.chdir(os.path.join(SCRATCH, page))
    for name, size in FILES.items():
        with open(name, "w", encoding="ascii") as file:
            file.write(box(*size))
    failures, ran, skipped = [], 0, []
    for block in BLOCK.finditer(text):
        marks, kind, commands, shown = block.groups()
        marks = dict(re.findall(r"<!-- (\w+): (.*) -->", marks))
        where = f"docs/{page}.md:{text.count(chr(10), 0, block.start(3))}"
        missing = [tool for tool in marks.get("needs", "").split() if not shutil.which(tool)]
        if "file" in marks:
            with open(marks["file"], "w", encoding="utf-8") as file:
                file.write(commands)
        elif kind == "sh" and missing:
            skipped.append(missing)
        elif kind == "sh":
            done = subprocess.run(["sh", "-eu", "-c", commands], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            output = done.stdout.decode("utf-8", "replace")
            ran += 1
            if done.returncode != int(marks.get("exits", 0)):
                failures.append(f"{where}: exit code {done.returncode}, not {marks.get('exits', 0)}: {output[-300:]}")
            elif shown and difference(shown, output):
                failures.append(f"{where}: {difference(shown, output)}")
    if skipped:
        print(f"SKIPPED: {len(skipped)} of {ran + len(skipped)} blocks of docs/{page}.md, no {', '.join(dict.fromkeys(sum(skipped, [])))}")
    return failures, ran


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH + "/bin")
    os.symlink(PROGRAM, SCRATCH + "/bin/burnish")
    # Environments that the test python and make python leave.
    environments = [f"{venv}/bin" for venv in (SOURCE + "/build/python/venv", BUILD + "/test/scratch/python/venv") if os.path.exists(venv + "/bin/python3")]
    # pyenv puts the folder of its Python first; Blender would look for its modules there
    path = [folder for folder in os.environ["PATH"].split(":") if "/.pyenv/versions/" not in folder]
    os.environ["PATH"] = ":".join([*environments, SCRATCH + "/bin", *path])
    results = []
    for page in sorted(glob.glob(SOURCE + "/docs/*.md")):
        with open(page, encoding="utf-8") as file:
            results.append(run(os.path.basename(page)[:-3], file.read()))
    failures = [failure for result in results for failure in result[0]]
    if sum(ran for _, ran in results) < 8:
        failures.append("fewer than 8 blocks of commands")
    print("\n".join([*failures, f"guides: {sum(ran for _, ran in results)} blocks of commands, {len(failures)} failed"]))
    return bool(failures)


sys.exit(main())
