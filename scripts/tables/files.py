"""Tables and pictures of files: docs/importers.md, gallery.md."""
import glob
import html
import json
import os
import re
import shutil
import subprocess

from page import ROOT, fill, run, table


# ---- Importers ----

SPECIAL = r"lib(?:png|jpeg|webp|isal|nlopt|seccomp|cjson|OpenEXRCore|assimp|draco|TKernel|TKXDESTEP|tbb|X11)[-A-Za-z0-9.]*(?=\.so)"


def importers(folder, page):
    """FOLDER PAGE: fills docs/importers.md with the sizes of the programs in FOLDER and of the libraries that they load"""
    rows = []
    for program in ("burnish", "burnish-import-assimp", "burnish-import-draco", "burnish-import-occt"):
        path = os.path.join(folder, program)
        libraries = set(re.findall(r"=> (/\S+)|^\s*(/\S+)", run("ldd", path), re.M))
        libraries = sorted(filter(None, sum(libraries, ())))
        special = sorted(set(re.findall(SPECIAL, "\n".join(libraries))))
        rows.append([f"`{program}`", megabytes([path]), len(libraries), megabytes(libraries), " ".join(special)])
    lines = table("program|MB|libraries|MB of libraries|among them", rows)
    lines[1] = "| --- | ---: | ---: | ---: | --- |"
    fill(page, {"sizes": lines}, ("byte", "head", "material"))


def megabytes(files):
    return "%.2f" % (sum(os.path.getsize(file) for file in files) / 1e6)


# ---- Gallery ----

GLMARK, ASSIMP = "/usr/share/glmark2/models/", "/usr/share/assimp/models/"
LOOKS = {
    "studio": [],
    "on the ground": ["--ground"],
    "three-point": ["--look=three-point"],
    "metal": ["--material=metal", "--color=#d0d0d4"],
    "polished": ["--material=polished", "--color=#c02020"],
    "clay": ["--look=clay"],
    "technical": ["--look=technical"],
    "drawing": ["--look=drawing"],
    "plain": ["--look=plain"],
    "like stl-thumb": "--look=plain --color=#a6c8ff --background-color=white --camera-direction=-2,4,-2".split(),
}
# Name, file or object, flags.
SHAPES = [(name, name, "") for name in (":teapot", ":sphere", ":torus", ":knot")] + [
    ("bunny", GLMARK + "bunny.obj", ""),
    ("horse", GLMARK + "horse.3ds", ""),
    ("cat", GLMARK + "cat.3ds", "--up=-Z"),
    ("asteroid", GLMARK + "asteroid-high.3ds", ""),
    ("wuson stl", ASSIMP + "STL/Wuson.stl", "--up=+Y"),
    ("wuson obj", ASSIMP + "OBJ/WusonOBJ.obj", ""),
    ("spider stl", ASSIMP + "STL/Spider_binary.stl", ""),
    ("spider obj", ASSIMP + "OBJ/spider.obj", ""),
    ("max export", ASSIMP + "STL/3DSMaxExport.STL", ""),
    ("sphere with hole", ASSIMP + "STL/sphereWithHole.stl", ""),
    ("cube with colours", ASSIMP + "OBJ/cube_with_vertexcolors.obj", ""),
    ("spider ascii", ASSIMP + "STL/Spider_ascii.stl", ""),
    ("box", ASSIMP + "OBJ/box.obj", ""),
    ("concave polygon", ASSIMP + "OBJ/concave_polygon.obj", ""),
    ("cube", ASSIMP + "PLY/cube.ply", ""),
]
SHOWN = "bracket gear hinge impeller plate heatsink knob name".split()
PARTS = os.path.join(ROOT, "docs", "gallery", "parts")
README = [  # its images of parts; helmet.jpg is a public asset (FlightHelmet.gltf of Khronos' samples, CC0)
    ("metal.jpg", "impeller", ["--material=metal", "--color=#c8763a", "--ground", "-s", "480x360"]),
    ("section.jpg", "mug", ["--clip=0,-1,0,0", "--color=#c0392b", "--ground", "-s", "480x360"]),
    ("drawing.svg", "bracket", ["--look=drawing", "--views=iso", "--annotate=dimensions", "-s", "480x360"]),
    ("drawing-sheet.svg", "bracket", ["--look=drawing", "--views=third-angle", "--hidden-lines", "--center-lines", "--annotate=dimensions", "-s", "900x636"]),
    ("drawing-hidden.png", "mug", ["--look=technical", "--hidden-lines", "--views=iso", "-s", "480x360"]),
    ("drawing-cut.svg", "mug", ["--look=drawing", "--clip=0,-1,0,0", "--annotate=dimensions", "-s", "480x360"]),
    ("turntable.gif", "gear", ["--material=metal", "-s", "240x180", "--frames=24"]),
]
HEAD = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>burnish: gallery</title>
<style>body { font: 14px sans-serif; margin: 1em } img { display: block; width: 320px } td, th { padding: 2px; text-align: left; vertical-align: top }</style></head>
<body><h1>Gallery</h1><table>
"""


def gallery(burnish, out, docs, short=""):
    """BURNISH FOLDER DOCS_FOLDER [short]: draws 40 shapes with burnish and, if installed, f3d

    FOLDER receives index.html, images, contact sheets (if ImageMagick is installed) and meshes, which are kept between runs;
    DOCS_FOLDER the images of docs/gallery.md. Shapes without a file or a tool leave theirs unchanged. short: three small shapes, no f3d.
    """
    Gallery(os.path.abspath(burnish), os.path.abspath(out), os.path.abspath(docs), bool(short)).draw()


class Gallery:
    def __init__(self, burnish, out, docs, short):
        self.burnish, self.out, self.docs, self.missing = burnish, out, docs, []
        self.peer = not short and shutil.which("f3d") and shutil.which("xvfb-run")
        self.shapes = SHAPES + [(os.path.basename(part)[:-5], part, "") for part in sorted(glob.glob(PARTS + "/*.scad"))]
        self.size, self.all_looks, self.shown = "400,300", "bracket", SHOWN
        if short:
            self.shapes = [shape for shape in self.shapes if shape[0] in (":torus", ":knot", "block")]
            self.size, self.all_looks, self.shown = "160,120", "torus", ["torus"]
        if not self.peer:
            self.missing.append("f3d")
        for folder in (os.path.join(out, "meshes"), docs):
            os.makedirs(folder, exist_ok=True)

    def draw(self):
        heads = ["shape", *LOOKS] + (["f3d", "f3d --ssao --fxaa --tone-mapping, the same camera and ground"] if self.peer else [])
        rows = ["<tr>" + "".join(f"<th>{head}</th>" for head in heads) + "</tr>\n"]
        for name, file, flags in self.shapes:
            stem = name.replace(":", "").replace(" ", "_")
            mesh = self.mesh(stem, file)
            if mesh:
                rows.append(self.row(name, stem, mesh, flags.split()))
            else:
                self.missing.append(stem)
        with open(f"{self.out}/index.html", "w", encoding="utf-8") as page:
            page.write(HEAD + "".join(rows) + "</table></body></html>\n")
        self.sheets()
        for image, part, flags in [] if self.all_looks == "torus" else README:
            mesh = self.mesh(part, f"{PARTS}/{part}.scad")
            if mesh:
                run(self.burnish, mesh, f"{self.docs}/../images/{image}", *flags, "--overwrite", "--quiet")
        if self.missing:
            print(f"gallery: left out: {' '.join(self.missing)} (make deps GROUPS=gallery)")
        print(f"gallery: {len(rows) - 1} shapes: {self.out}/index.html")

    def mesh(self, stem, file):
        """The mesh to draw, converted if necessary; None if a tool or the file is missing."""
        made = os.path.join(self.out, "meshes", stem)
        if file.startswith(":"):
            return file
        if file.endswith(".scad"):
            made += ".stl"
            command = ["openscad", "-q", "-o", made, file]
        elif file.endswith(".3ds"):
            made += ".obj"
            command = ["assimp", "export", file, made]
        else:
            return file if os.path.exists(file) else None
        if not shutil.which(command[0]) or not os.path.exists(file):
            return None
        if not os.path.exists(made) or os.path.getmtime(made) < os.path.getmtime(file):
            if subprocess.run(command, stdout=subprocess.DEVNULL).returncode:
                return None
        return made

    def render(self, mesh, flags, image):
        """The report of the image."""
        return json.loads(run(self.burnish, "render", mesh, *flags, f"--resolution={self.size}", "--quiet", "--json=-", "-o", image))

    def row(self, name, stem, mesh, flags):
        images, reports = [], {}
        for look, more in LOOKS.items():
            images.append((f"{stem}-{look.replace(' ', '-')}.png", look))
            reports[look] = self.render(mesh, flags + more, os.path.join(self.out, images[-1][0]))
            if stem == self.all_looks:
                self.render(mesh, flags + more, f"{self.docs}/look-{look.replace(' ', '-')}.jpg")
        if self.peer:
            images += [(f"{stem}-f3d.png", "f3d"), (f"{stem}-f3d-best.png", "f3d at its best")]
            if not mesh.startswith(":"):
                self.draw_by_f3d(stem, mesh, reports["studio"])
        if stem in self.shown:
            self.render(mesh, flags, f"{self.docs}/{stem}.jpg")
            if os.path.exists(f"{self.out}/{stem}-f3d-best.png"):
                shutil.copy(f"{self.out}/{stem}-f3d-best.png", f"{self.docs}/{stem}-f3d.png")
        cells = []
        for image, words in images:
            there = os.path.exists(os.path.join(self.out, image))
            cells.append(f'<td><img src="{image}" alt="{html.escape(name)}, {words}"></td>\n' if there else "<td>-</td>\n")
        return f"<tr><td>{name}</td>\n{''.join(cells)}</tr>\n"

    def draw_by_f3d(self, stem, mesh, report):
        """f3d with its defaults, then with burnish's camera and ground and the options that improve its images."""
        camera = {key: ",".join(map(str, report["camera"][key])) for key in ("position", "focal_point", "view_up")}
        plain = ["xvfb-run", "-a", "f3d", mesh, f"--resolution={self.size}", f"--up={report['up']}"]
        best = ["--ssao", "--fxaa", "--tone-mapping", "--bg-color=0.933,0.937,0.945", f"--camera-position={camera['position']}",
                f"--camera-focal-point={camera['focal_point']}", f"--camera-view-up={camera['view_up']}", "--camera-view-angle=30"]
        for name, flags in (("f3d", []), ("f3d-best", best)):
            subprocess.run([*plain, f"--output={self.out}/{stem}-{name}.png", *flags], capture_output=True)

    def sheets(self):
        """One contact sheet of all shapes per column."""
        for column in [look.replace(" ", "-") for look in LOOKS] + ["f3d", "f3d-best"]:
            images = sorted(glob.glob(f"{self.out}/*-{column}.png"))
            if images and shutil.which("montage"):
                run("montage", *images, "-tile", "6x", "-geometry", "266x200+2+2", f"{self.out}/sheet-{column}.jpg")
