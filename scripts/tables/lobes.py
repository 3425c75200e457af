"""docs/theory.md: figures and tables of what burnish computes now."""
import difflib
import math
import os

from page import ROOT, Refused, csv_rows, filled, grid, read, run, table, write

FIGURES = "error curves core ratio w1 w1-extreme cost energy orders widths radius polygon rough".split()


def figures(burnish, folder):
    """BURNISH FOLDER: draws the figures of docs/theory.md"""
    os.makedirs(folder, exist_ok=True)
    for name in [f"{figure}.svg" for figure in FIGURES] + ["object.png"]:
        run(burnish, "lobe", "plot", name[:-4], "-o", os.path.join(folder, name))


def theory(burnish, page, mode=""):
    """BURNISH PAGE [--check]: fills docs/theory.md; --check changes nothing and fails if the page is out of date"""
    tables = {name: make(burnish) for name, make in TABLES.items()}
    tables["operations"] = operations(page)
    for name, lines in tables.items():
        if len(lines) < 4:
            raise Refused(f"the table {name} is empty")
    text = filled(page, tables)
    if mode != "--check":
        return write(page, text)
    for line in difflib.unified_diff(read(page).splitlines(), text.splitlines(), page, "now", lineterm="", n=0):
        print(line)
    if read(page) != text:
        raise Refused(f"{page} is out of date; run make figures")


def numbers(burnish, lobes, exponents, metric):
    """Rows of exponent, lobe, value."""
    return csv_rows(run(burnish, "lobe", "table", f"--lobes={lobes}", f"--exponents={exponents}", f"--metrics={metric}", "--format=csv"))


def claims(burnish, *names):
    """Rows of the claims: the case (5th cell), what was measured (6th), and the bound (9th)."""
    rows = [line for name in names for line in csv_rows(run(burnish, "lobe", "claims", name, "--format=csv"))]
    return [(line[4], line[5], line[8]) for line in rows]


def limits(burnish):
    """Largest absolute error of every order and fit near its limit for large exponents."""
    fits = "taylor energy level0.5 projected minimax affine".split()
    lobes = ",".join(f"{fit}:{order}" for order in (2, 4, 8, 16, 32) for fit in fits)
    return grid("order", [(*lobe.split(":"), value) for _, lobe, value in numbers(burnish, lobes, 65536, "max-error")], "%.4f", "`%s`")


def shipped(burnish):
    """Slopes that games shipped, compared with the best ones."""
    cells = []
    for n in (10, 11, 18):
        wanted = [("best slope", "minimax:2", "zeta"), ("its error", "minimax:2", "max-error")]
        wanted += [(f"error of ζ = {zeta}", f"zeta{zeta}:2", "max-error") for zeta in ("4", "6.645")]
        cells += [(name, f"n = {n}", numbers(burnish, lobe, n, metric)[0][2]) for name, lobe, metric in wanted]
    return grid("exponent", cells, "%.4f")


def by_lobe(burnish, lobes, exponents, metric, form):
    return grid("lobe", [(n, f"`{lobe}`", value) for n, lobe, value in numbers(burnish, lobes, exponents, metric)], form, "n = %s")


def choose(burnish):
    """Largest absolute error of the lobes to choose from."""
    lobes = "energy:2,minimax:2,minimax:4,minimax:8,minimax:16,minimax:32,gaussian,schlick"
    return by_lobe(burnish, lobes, "3,10,32,100,1000", "max-error", "%.4f")


def energy(burnish):
    """The integral over the hemisphere, relative to the integral of cos^n."""
    return by_lobe(burnish, "schlick,gx,gaussian,taylor:2,shift7,shift3,minimax:2,energy:2", "5,18,64,256,1024", "energy", "%.3f")


def boundary(burnish):
    """Cosines below which a lobe is invisible."""
    cells = []
    for metric, what in (("cutoff-cosine", "becomes zero"), ("boundary:8", "falls to 1/256")):
        cells += [(n, f"`{lobe}` {what}", value) for n, lobe, value in numbers(burnish, "power,energy:2,minimax:4,schlick", "10,100,1000", metric)]
    cells = [cell for cell in cells if cell[1] not in ("`power` becomes zero", "`schlick` becomes zero")]
    return grid("the cosine where", sorted(cells, key=lambda cell: cell[1]), "%.5f", "n = %s")


def lyon(burnish):
    """What vectors of other lengths lose of a highlight, unchanged and after three terms of Lyon's series."""
    cells, loss = [], {}
    for case, measured, _ in claims(burnish, "lyon-lengths", "lyon-series"):
        words = case.split()
        if words[-1] != "n=100":
            continue
        if len(words) == 4:
            loss[words[1], words[0]] = measured
            continue
        values = {
            "length of the mean": "%.3f" % math.cos(float(words[0]) / 360 * math.pi),
            "lost by the cosine of vectors as they are": "%.2f" % float(loss[words[0], "cosine"]),
            "lost by their chord": "%.2f" % float(loss[words[0], "chord"]),
            "lost by the chord after three terms": "%.2f" % float(measured),
        }
        cells += [(f"{words[0]} degrees", name, value) for name, value in values.items()]
    return grid("normals apart", cells, "%s")


def operations(page):
    """Operations of one value, counted by `tables operations`, after those that the paper states."""
    counts = os.path.join(os.path.dirname(page), "images", "operations.csv")
    if not os.path.exists(counts):
        counts = os.path.join(ROOT, "docs", "images", "operations.csv")
    stated = {"w": ("$W$", "2 2 1 - - 5"), "w_half": ("$W_{0.5}$", "2 3 7_places - - -"), "schlick": ("Schlick", "1 1 - - 1 3")}
    machines = {"circuit": "circuit, cells", "rv32": "RV32IM", "m0": "Cortex-M0", "avr": "AVR, 8 bits"}
    counted = [line.split(",") for line in read(counts).splitlines() if not line.startswith("#")]
    rows = []
    for key, (lobe, cells) in stated.items():
        rows.append([lobe, "stated", *(cell.strip("-").replace("_", " ") for cell in cells.split())])
        rows += [[lobe, machines[line[1]], *line[2:]] for line in counted if line[0] == key]
    return table("one value of|on|multiplications|additions, subtractions, complements|shifts|tests and branches|divisions|all", rows, left=2)


def polygon(burnish):
    """Errors of the evaluations of a polygon's light, in double precision."""
    cells = []
    for order in (2, 8, 32):
        lines = csv_rows(run(burnish, "lobe", "plot", "polygon", f"--lobes=energy:{order}", "--format=csv"))
        cells += [(name, f"{order}, {slope}", error) for name, slope, error in lines if slope in ("1", "10", "100", "1000")]
    return grid("order, slope", cells, "%.0e")


def rough(burnish):
    """What sums of lobes for GGX and Beckmann miss."""
    cells = []
    for name, distribution, lobes in [("GGX", "ggx", n) for n in (3, 2, 1)] + [("Beckmann", "beckmann", n) for n in (3, 2)]:
        rows = csv_rows(run(burnish, "lobe", "rough", f"--distribution={distribution}", f"--lobes={lobes}", "--format=csv"))
        for row in rows:
            cells += [(f"{name}, {lobes}", "%.1f" % float(row[0]), "%.1f, %.1f" % (float(row[1]), float(row[2])))]
    return grid("roughness", cells, "%s")


def albedo(burnish):
    """Light that the engines' factors reflect at normal incidence."""
    cells = []
    for metric, what in (("phong-albedo", "(n + 2)/2π, Phong"), ("blinn-albedo", "(n + 8)/8π, Blinn")):
        cells += [(f"n = {n}", f"{what}: `{lobe}`", value) for n, lobe, value in numbers(burnish, "power,energy:2,energy:8", "8,20,100,1000", metric)]
    return grid("factor and lobe", cells, "%.3f")


TABLES = {
    "limits": limits,
    "polygon": polygon,
    "rough": rough,
    "albedo": albedo,
    "shipped": shipped,
    "choose": choose,
    "energy": energy,
    "boundary": boundary,
    "lyon": lyon,
}
