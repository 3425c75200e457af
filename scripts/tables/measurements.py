"""Tables of measured times: docs/performance.md, frames.md and shaders.md."""
import collections
import csv
import json
import math
import os
import re
import tempfile

from page import ROOT, fill, filled, number, read, run, table


class Kernels:
    """The rows of `bench_kernels --csv`: (instruction set, section.name) to label, ns, cycles and ratio."""

    def __init__(self, path):
        self.about, self.rows, self.names, self.isas = {}, {}, collections.defaultdict(dict), []
        for isa, section, name, label, *values in csv.reader(read(path).splitlines()[1:]):
            if isa == "run":
                self.about[name] = label
                continue
            self.rows[isa, f"{section}.{name}"] = values
            self.names[section][name] = label
            if isa != "code" and isa not in self.isas:
                self.isas.insert(0, isa)

    def value(self, isa, key, column):
        values = self.rows.get((isa, key))
        return float(values[column]) if values and values[column] else None

    def contenders(self, section, form, is_rate=False):
        """A row per contender: value and ratio for each instruction set, fastest first."""
        rows = []
        for name, label in self.names[section].items():
            cells = []
            for isa in self.isas:
                value, over = (self.value(isa, f"{section}.{name}", column) for column in (0, 2))
                value = 1000 / value if is_rate and value else value
                over = 1 / over if "copy" in name and over else over
                cells += [number(value, form), number(over, "%.3g") if rows else "1"]
            rows.append([label, *cells])
        return table(["lobe" if is_rate else "f(c)", *(head for isa in self.isas for head in (isa, "x lobe"))], rows)

    def scalar(self, section, over):
        rows = []
        for at, (name, label) in enumerate(self.names[section + ".latency"].items()):
            if name == "loop":
                continue
            cells = [f"`{label}`"]
            for part, form in ((".latency.", "%.1f"), (".throughput.", "%.2f")):
                ns, cycles, ratio = (self.value("code", section + part + name, column) for column in range(3))
                cells += [number(ns, "%.2f"), number(cycles, form), number(ratio, "%.2f") if at else "1"]
            rows.append(cells)
        return table(f"one value at a time|latency, ns|cycles|{over}|throughput, ns|cycles|{over}", rows)


def performance(kernels, page):
    """KERNELS.csv PAGE: fills docs/performance.md from `bench_kernels --csv`"""
    kernels = Kernels(kernels)
    machine = "Machine: {processor}, data caches {cache_l1}, {cache_l2} and {cache_l3}, one thread, not pinned. Compiler: {compiler}. {rounds} rounds; arrays in memory of {array}."
    fill(page, {
        "machine": [machine.format(**kernels.about)],
        "first-cache": kernels.contenders("lobe.l1", "%.3f"),
        "memory": kernels.contenders("lobe.memory", "%.3f"),
        "directional": kernels.contenders("shade.directional", "%.0f", is_rate=True),
        "point": kernels.contenders("shade.point", "%.0f", is_rate=True),
        "roots": kernels.contenders("root.l1", "%.3f"),
        "scalar": kernels.scalar("scalar", "x lobe"),
        "paper": kernels.scalar("paper", "Schlick over"),
    }, keep=True)


# ---- docs/frames.md ----

SETS = ("bunny.t1", "bunny.t2", "bunny16.t1", "bunny16.t2")
FRAMES = """burnish, energy:2, back faces culled|burnish.family
burnish, energy:2, both sides lit|burnish.family-two-sided
burnish, power (vector exp2 and log2), culled|burnish.power
burnish, power by libm, culled|burnish.libm
burnish, schlick, culled|burnish.schlick
llvmpipe pow, culled, linear bytes|llvmpipe.power
llvmpipe pow, culled, sRGB bytes|llvmpipe.power-srgb
llvmpipe pow, both sides lit, linear bytes|llvmpipe.power-two-sided
llvmpipe energy:2, culled, linear bytes|llvmpipe.family
Embree, packets of 16, energy:2|embree.family"""
RATIOS = """llvmpipe pow, culled, linear|llvmpipe
llvmpipe pow, culled, sRGB|llvmpipe_srgb
llvmpipe pow over burnish, both with both sides lit|llvmpipe_two_sided
Embree|embree
burnish with both sides lit|two_sided
burnish with power by libm|libm
burnish with power by vectors|vector_pow
burnish with schlick|schlick"""
SETUPS = ("1920x1080, 1 sample, 1 thread", "1920x1080, 1 sample, 2 threads", "1920x1080, 4 samples, 1 thread",
          "1920x1080, 4 samples, 2 threads", "256x256, 1 sample, 1 thread")


def frames(*arguments):
    """[--parts FOLDER | --meshes] BUILD_FOLDER PAGE: fills docs/frames.md from bench-peers; --parts and --meshes only one table"""
    build, page = arguments[-2:]
    if arguments[0] == "--parts":
        tables = {"parts": parts(read(f"{build}/bench-parts.txt"), os.path.join(arguments[1], "SOURCES"))}
    elif arguments[0] == "--meshes":
        tables = {"meshes": meshes(read(f"{build}/bench-meshes.txt"))}
    else:
        values = json.loads(read(f"{build}/bench-peers.json"))
        values.update(values.pop("medians"))
        tables = {
            "machine": [f"Measured on: {processor()}; llvmpipe of {values.get('mesa')}; medians of {values['rounds']} rounds in all."],
            "frames": per_set("ms per frame", FRAMES, lambda key, what: values.get(f"frame.{key}.{what}"), lambda value: "%.1f" if value < 100 else "%.0f"),
            "ratios": per_set("time relative to burnish with energy:2, culled", RATIOS, lambda key, what: values.get(f"frame.{key}.{what}_over"), lambda value: "%.2f"),
            "processes": processes(values),
            "shapes": shapes(read(f"{build}/bench-scenes.txt")),
        }
        if not any(key.endswith(".f3d") for key in values):  # which is not installed everywhere: the page keeps its table
            del tables["processes"]
    fill(page, tables, keep=True, empty=True)


def processor():
    text = read("/proc/cpuinfo") if os.path.exists("/proc/cpuinfo") else ""
    name, family, model = (re.search(rf"^{key}\s*: (.*)", text, re.M) for key in ("model name", "cpu family", "model"))
    return f"{name[1]}, family {family[1]}, model {model[1]}" if name and family and model else name[1] if name else "an unnamed processor"


def per_set(heading, names, value, form):
    rows = []
    for label, what in (line.split("|") for line in names.splitlines()):
        values = [value(key, what) for key in SETS]
        rows.append([label, *(number(each, form(each or 0)) for each in values)])
    return table([heading, "bunny, 1 thread", "2 threads", "bunny16, 1 thread", "2 threads"], rows)


def processes(values):
    rows = []
    for scene in ("bunny", "bunny16"):
        for size, pixels in (("256", "256x256"), ("1080p", "1920x1080")):
            for cores in (1, 2):
                key = f"{scene}.{size}.t{cores}"
                if f"process.{key}.f3d" in values:
                    theirs, ours = (values[f"process.{key}.{name}"] for name in ("f3d", "burnish"))
                    memory, least = (values[f"memory.{key}.{name}"] / 1024 for name in ("f3d", "burnish"))
                    cells = "%.0f %.1f %.1f %.1f %.1f %.1f" % (theirs, ours, theirs / ours, memory, least, memory / least)
                    rows.append([f"{scene}, {pixels}, {cores}", *cells.split()])
    return table("mesh, picture, cores|f3d, ms|burnish, ms|ratio|f3d, MiB|burnish, MiB|ratio", rows)


def shapes(text):
    """From bench/peers/meshes.py: blocks of rows after a line with their setup; descriptions "NAME: TEXT"."""
    names, triangles, descriptions, values, setup = [], {}, {}, {}, None
    for line in text.splitlines():
        words = line.split()
        if re.match(r"[0-9]+x[0-9]+, ", line):
            setup = line
        elif re.match(r"[a-z0-9-]+: ", line):
            descriptions[words[0][:-1]] = line[len(words[0]) + 1:]
        elif len(words) == 10:
            if words[0] not in triangles:
                names.append(words[0])
            triangles[words[0]] = words[1]
            values[setup, words[0]] = words[4:7]
        elif line.startswith("by medians: geometric mean"):
            values[setup, "geometric mean"] = ["", "", words[4].rstrip(",")]
            values[setup, "least"] = ["", "", words[6].rstrip(",")]
    rows = []
    for name in names + ["geometric mean", "least"]:
        times = values.get((SETUPS[0], name), ["", "", ""])[:2]
        ratios = [number(values.get((setup, name), [""] * 3)[2], "%.2f") for setup in SETUPS]
        if name in triangles:
            rows.append([f"{name}: {descriptions.get(name, '')}", "%d" % float(triangles[name]), *(number(time, "%.1f") for time in times), *ratios])
        else:
            rows.append([name, "", "", "", *ratios])
    return table("shape|triangles|burnish, ms|llvmpipe, ms|1 thread|2 threads|4 samples, 1 thread|4 samples, 2 threads|256x256, 1 thread", rows)


def meshes(text):
    """From bench/peers/meshes.py with files: the summary of each setup, and how many files there were."""
    rows, setup, count, peer = [], "", 0, ""
    for line in text.splitlines():
        peer = line.removeprefix("llvmpipe: ") if line.startswith("llvmpipe: ") else peer
        found = re.match("by medians: geometric mean (.*), least (.*), quartiles (.*), most (.*); .* of (.*) slower", line)
        if re.match(r"[0-9]+x[0-9]+, ", line):
            setup = line
        elif found:
            picture, samples, threads = setup.split(", ")
            mean, least, quartiles, most, count = found.groups()
            rows.append([f"{picture}, {samples}", threads.split()[0], mean, least, quartiles.replace(" ", ", "), most])
    heading = f"{count} meshes, measured on: {processor()}; llvmpipe of {peer}."
    return [heading, "", *table("picture|threads|geometric mean|least|quartiles|most", rows)]


def parts(text, sources):
    """From bench_peers_parts: size, five times and memories, FILE per line; a line "file, repository, commit, path" of SOURCES names its origin."""
    origins = [line.split("\t") for line in read(sources).splitlines()] if os.path.exists(sources) else []
    origins = {line[0]: re.sub("^github.com/", "", f"{line[1]}: {line[3]}") for line in origins}
    rows, logs = [], collections.defaultdict(list)
    for line in text.splitlines():
        size, *values, file = line.split(" ", 7)
        size, name = size.replace(",", "x"), os.path.basename(file)
        theirs, plain, ours, memory, _, least = map(float, values)
        ratios = theirs / plain, theirs / ours, memory / least
        cells = "%.0f %.1f %.1f %.1f %.1f %.1f %.1f %.1f" % (theirs, plain, ratios[0], ours, ratios[1], memory / 1024, least / 1024, ratios[2])
        rows.append([f"{origins.get(name, name)}, {size}", *cells.split()])
        logs[size].append([math.log(ratio) for ratio in ratios])
    for size, each in logs.items():
        means = ["%.1f" % math.exp(sum(column) / len(each)) for column in zip(*each)]
        rows.append([f"geometric mean of {len(each)}, {size}", "", "", means[0], "", means[1], "", "", means[2]])
    return table("part, picture|f3d, ms|burnish plain, ms|ratio|burnish, ms|ratio|f3d, MiB|burnish, MiB|ratio", rows)


# ---- Others ----

def scale(bench, burnish, folder, page, most="100000000"):
    """BENCH_SCALE BURNISH FOLDER PAGE [TRIANGLES]: fills docs/performance.md; takes 20 bytes per triangle in FOLDER, 60 of memory"""
    filled(page, {"scale": []}, keep=True)  # refuses a page without the table's place before minutes of work
    with tempfile.TemporaryDirectory(prefix="scale.", dir=folder) as work:
        fill(page, {"scale": run(bench, burnish, work, most).splitlines()}, ("read",), keep=True)


def shaders(bench, half_table, page, *rounds):
    """BENCH_SHADERS HALF_TABLE PAGE [ROUNDS]: fills docs/shaders.md; a GPU has a table of its own"""
    cost = run(bench, os.path.join(ROOT, "shaders", "burnish.glsl"), *rounds).splitlines()
    fill(page, {"cost" if "llvmpipe" in cost[0] else "cost-gpu": cost, "half": run(half_table).splitlines()},
         ("4", "8", "16", "32", "ns a highlight", "of `pow`"), keep=True)
