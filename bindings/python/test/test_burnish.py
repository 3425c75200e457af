"""The installed package against the program. Usage: test_burnish.py PROGRAM SOURCES, in a scratch folder."""

import copy
import ctypes
import doctest
import gc
import importlib.util
import io
import json
import multiprocessing
import os
import pickle
import re
import signal
import struct
import subprocess
import sys
import threading
import typing
import unittest
import zipfile
from array import array
from pathlib import Path
from types import SimpleNamespace

import burnish
from burnish import _burnish, _options


class Mallinfo(ctypes.Structure):
    """What malloc has handed out, in bytes: uordblks by the heap, hblkhd by mappings of its own."""
    _fields_ = [(name, ctypes.c_size_t) for name in "arena ordblks smblks hblks hblkhd usmblks fsmblks uordblks fordblks keepcost".split()]


LIBC = ctypes.CDLL(None)
LIBC.mallinfo2.restype = Mallinfo
LIBC.mallopt(-8, 1)  # M_ARENA_MAX: one heap for all threads, the one that mallinfo2 counts

PROGRAM, SOURCES = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
DATA = SOURCES / "test/data"
sys.path.append(str(SOURCES / "test/cli"))
import outputs  # noqa: E402

try:
    import numpy
except ImportError:
    numpy = None
try:
    from PIL import Image as Pillow
except ImportError:
    Pillow = None

CORNERS = [(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3)]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]


def ask(*arguments, folder=DATA):
    """The report of `burnish render`, or its one line."""
    run = subprocess.run(
        [PROGRAM, "render", *arguments, "--json", "-o", os.devnull], cwd=folder, capture_output=True, text=True
    )
    return json.loads(run.stdout) if run.returncode == 0 else run.stderr.strip().removeprefix("burnish: ")


def options_of(flags):
    """["--camera-view-angle=30"] as {"camera_view_angle": "30"}"""
    options = {}
    for flag in flags:
        key, _, value = flag[2:].partition("=")
        key = key.replace("-", "_")
        options[key] = [*options[key], value] if key in options else [value] if value else True
    return options


def stl(corners, faces):
    triangles = b"".join(struct.pack("<12fH", 0, 0, 0, *corners[a], *corners[b], *corners[c], 0) for a, b, c in faces)
    return bytes(80) + struct.pack("<I", len(faces)) + triangles


class Pictures(unittest.TestCase):
    def test_golden(self):
        """Every option of the golden pictures gives the program's pixels."""
        drawn = 0
        for line in (SOURCES / "test/golden/pixels.txt").read_text().splitlines():
            hash_, source, *flags = line.split()
            if re.search(r"--(views|lobe)=\S*,", line) or "--same-scale" in flags:
                continue  # a sheet
            source = source if source.startswith(":") else DATA / source
            with self.subTest(line):
                self.assertEqual(burnish.render(source, **options_of(flags)).hash, hash_)
            drawn += 1
        self.assertGreater(drawn, 30)

    def test_values(self):
        """Python's values are the command line's words."""
        picture = burnish.render(
            DATA / "cube.obj", resolution=(90, 60), camera_direction=[-1, -0.5, -1.5], margin=0.1, light=["directional:1,2,3", "point:0,1,2:0.5"],
            color=(0.5, 0.25, 1), ground=True, shadow=False, occlusion=None, no_background=True, threads=1,
        )  # fmt: skip
        report = ask(
            "cube.obj", "--resolution=90,60", "--camera-direction=-1,-.5,-1.5", "--margin=.1", "--light=directional:1,2,3",
            "--light=point:0,1,2:0.5", "--color=.5,.25,1", "--ground", "--no-background",
        )  # fmt: skip
        self.assertEqual(picture.hash, report["hash"], report)
        self.assertEqual(picture.camera["position"], tuple(report["camera"]["position"]))
        self.assertEqual(picture.covered_pixels, report["covered_pixels"])
        self.assertEqual((picture.size, picture.mode), ((90, 60), "RGBA"))

    def test_lists(self):
        """A list is one value between commas, or repeats a flag whose values add up."""
        for options, flags in (
            ({"annotate": ["axes", "box"]}, ["--annotate=axes,box"]),
            ({"annotate": {"box": 1}.keys(), "views": ("front",)}, ["--annotate=box", "--views=front"]),
            ({"edges": ["creases", "boundaries"]}, ["--edges=creases,boundaries"]),
            ({"color": ["0.5", 0.25, 1]}, ["--color=0.5,0.25,1"]),
            ({"clip": [(1, 0, 0, 0.5), "0,1,0,0.5"]}, ["--clip=1,0,0,.5", "--clip=0,1,0,.5"]),
            ({"clip": [(1, 0, 0, 0.5)]}, ["--clip=1,0,0,.5"]),
            ({"section": "x"}, ["--section=x"]),
            ({"light": ("point:0,1,2", "directional:1,2,3")}, ["--light=point:0,1,2", "--light=directional:1,2,3"]),
        ):
            with self.subTest(options):
                self.assertEqual(burnish.render(DATA / "cube.obj", size=64, **options).hash, ask("cube.obj", "--size=64", *flags)["hash"])
        Path("parts.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no a\nf 1 2 3\no b\nf 1 3 4\no c\nf 1 2 4\n")
        picture = burnish.render("parts.obj", size=64, hide=["a", "c*"], explode=0.5)
        self.assertEqual(picture.hash, ask("parts.obj", "--size=64", "--only=b", folder=".")["hash"])
        for options in ({"views": ["front", "top"]}, {"lobe": ["power", "schlick"]}):
            with self.assertRaisesRegex(burnish.Error, "one picture at a time"):
                burnish.render(":knot", **options)

    def test_false(self):
        """False switches off what has a word for it or an opposite, and a switch."""
        for options, flags in (
            ({"views": "front", "camera_orthographic": False}, ["--views=front", "--camera-orthographic=no"]),
            ({"look": "technical", "edges": False}, ["--look=technical", "--edges=none"]),
            ({"look": "technical", "edges": []}, ["--look=technical", "--edges=none"]),
            ({"occlusion": False, "annotate": False, "clip": False}, ["--occlusion=none"]),
            ({"background": False, "light": False}, ["--no-background", "--light=none"]),
            ({"background": "red", "no_background": False, "ground": False, "color": None}, ["--background=red", "--no-ground"]),
        ):
            with self.subTest(options):
                self.assertEqual(burnish.render(DATA / "cube.obj", size=64, **options).hash, ask("cube.obj", "--size=64", *flags)["hash"])
        for key, line in (
            ("look", "look: it can't be switched off; omit it, or give NAME"),
            ("camera_view_angle", "camera_view_angle: it can't be switched off; omit it, or give DEG"),
            ("up", "up: it can't be switched off; omit it, or give AXIS"),
        ):
            with self.subTest(key), self.assertRaises(burnish.Error) as caught:
                burnish.render(":knot", **{key: False})
            self.assertEqual(str(caught.exception), line)
        with self.assertRaisesRegex(burnish.Error, "^look: a value is missing: look=NAME"):
            burnish.render(":knot", look=True)

    def test_sizes(self):
        for options, size in (
            ({"size": (64, 48)}, (64, 48)), ({"size": "64x48"}, (64, 48)), ({"width": 64}, (64, 48)), ({"height": 24}, (32, 24)),
            ({"width": 40, "height": 50}, (40, 50)), ({"size": 64, "width": 40}, (40, 40)), ({"resolution": range(30, 60, 20)}, (30, 50)),
        ):  # fmt: skip
            with self.subTest(options):
                self.assertEqual(burnish.render(":knot", **options).size, size)

    def test_far_from_the_origin(self):
        corners = [(4e6 + x, y - 2e6, z) for x, y, z in CORNERS]
        text = "".join(f"v {x} {y} {z}\n" for x, y, z in corners) + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in FACES)
        Path("far.obj").write_text(text)
        flags = ["--size=64", "--camera-position=4000004,-1999990,9", "--clip=1,0,0,4000000.5"]
        picture = burnish.render("far.obj", **options_of(flags))
        report = ask("far.obj", *flags, folder=".")
        self.assertEqual(picture.hash, report["hash"])
        self.assertEqual(burnish.load("far.obj", clip=flags[2][7:]).bounds, (tuple(report["bounding_box"]["min"]), tuple(report["bounding_box"]["max"])))
        self.assertEqual(picture.camera["position"], (4000004, -1999990, 9))

    def test_bytes_and_files(self):
        expected = ask("textured.obj", "--size=64")["hash"]
        files = {name: (DATA / name).read_bytes() for name in os.listdir(DATA)}
        self.assertEqual(burnish.render(DATA / "textured.obj", size=64).hash, expected)
        self.assertEqual(burnish.render(files["textured.obj"], name="textured.obj", files=files, size=64).hash, expected)
        lonely = burnish.render(bytearray(files["textured.obj"]), name="textured.obj", size=64)
        self.assertIn("textured.mtl", lonely.warnings[0])

    def test_options_in_vain(self):
        mesh = burnish.load(DATA / "cube.obj", animation_time=3)
        why = "animation_time: no effect: only glTF files have animations; omit the flag"
        self.assertEqual(mesh.warnings, (why,))
        self.assertEqual(mesh.render(size=8, camera="0", light="file").warnings, (
            why, "camera: no effect: INPUT has no cameras; omit the flag", "light=file: no effect: INPUT has no lights; omit the flag"))
        self.assertEqual(mesh.render(size=8, edge_color="red").warnings, (why, "edge_color: no effect: no lines are drawn; use edges"))
        with open("hot.hdr", "wb") as file:
            file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\xff")
        self.assertEqual(mesh.render(size=8, environment="hot.hdr").warnings, (
            why, "hot.hdr: 3 values are negative, above 1000000 or not numbers; they are clamped"))
        self.assertEqual(mesh.render(size=8, light="file").hash, mesh.render(size=8).hash)
        strict = burnish.load(DATA / "cube.obj", strict=True)
        with self.assertRaisesRegex(burnish.Error, "edge_color: no effect"):
            strict.render(edge_color="red")

    @unittest.skipUnless(numpy, "no NumPy")
    def test_numpy_values(self):
        """Vectors and numbers of NumPy are values of options."""
        for key, value in {"camera_position": [3.0, 4.0, 5.0], "color": [1.0, 0.5, 0.0], "resolution": [40, 30], "size": 40, "margin": 0.25}.items():
            with self.subTest(key):
                options = {"size": 32} if key not in ("size", "resolution") else {}
                expected = burnish.render(":teapot", **options, **{key: value}).hash
                self.assertEqual(burnish.render(":teapot", **options, **{key: numpy.array(value)}).hash, expected)
                self.assertEqual(burnish.render(":teapot", **options, **{key: numpy.array([value])[0]}).hash, expected)
        for ground in (numpy.True_, numpy.False_, numpy.array(True)):
            self.assertEqual(burnish.render(":teapot", size=32, ground=ground).hash, burnish.render(":teapot", size=32, ground=bool(ground)).hash)
        names = numpy.array(["axes", "box"])
        self.assertEqual(burnish.render(":teapot", size=64, annotate=names).hash, burnish.render(":teapot", size=64, annotate="axes,box").hash)

    def test_open_files(self):
        expected = burnish.render(DATA / "wedge.stl", size=32).hash
        with open(DATA / "wedge.stl", "rb") as file:
            self.assertEqual(burnish.render(file, size=32).hash, expected)
        self.assertEqual(burnish.render(io.BytesIO((DATA / "wedge.stl").read_bytes()), name="w.stl", size=32).hash, expected)
        with open(DATA / "cube.obj") as file, self.assertRaisesRegex(TypeError, '^cube.obj: open in text mode; open it with mode "rb"$'):
            burnish.load(file)
        with self.assertRaisesRegex(TypeError, "open in text mode"):
            burnish.render(io.StringIO("solid"))

    def test_option_types(self):
        """Types of each kind of value, and each option in the stage that takes it."""
        loading, drawing, both = (typing.get_type_hints(options) for options in (_options.Loading, _options.Drawing, _options.Options))
        self.assertEqual(set(loading) & set(drawing), {"threads"})
        self.assertEqual(both, {**loading, **drawing})
        for options, name, type_ in (
            (loading, "up", 'Literal["+Y", "-Y", "+Z", "-Z", "+X", "-X", "auto", "format"]'), (loading, "strict", "bool"),
            (loading, "max_input_bytes", "Union[int, str]"), (loading, "clip", "Union[Words[Vector], Off]"),
            (drawing, "samples", "Literal[1, 4, 8, 16]"), (drawing, "camera_orthographic", 'Union[bool, Literal["no"]]'),
            (drawing, "background", "Union[Color, Off]"), (drawing, "occlusion", 'Union[int, Literal["none"], Off]'),
            (drawing, "size", "Union[int, str, Iterable[int]]"), (drawing, "light", "Union[Words[str], Off]"),
            (drawing, "annotate", 'Union[Words[Literal["axes", "box", "dimensions", "scale", "grid", "none"]], Off]'),
        ):  # fmt: skip
            self.assertEqual(options[name], eval(type_, vars(_options)), name)


class Types(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("mypy"), "no mypy")
    def test_mypy(self):
        """The package has no errors, and wrong options have one each."""
        Path("types").mkdir(exist_ok=True)
        right = (
            'burnish.load("a.stl", up="+Y", clip=[(1, 0, 0, 1)], threads=1)', 'burnish.render("a", annotate=["axes", "box"], occlusion=False)',
            "burnish.render(b'', size=(64, 48), color=None, planes=['depth']).save('b.png')", "burnish.Mesh([], normals=None, strict=True)",
            'burnish.render("a", cameras=[{"azimuth": 30}], size=8)[0].save("c.png")', 'burnish.Mesh([]).render(K=[], R=[], t=[]).hash',
            'burnish.Mesh([]).render(look="clay", views="front", edges=["creases"], light="none", lobe="power")',
        )  # fmt: skip
        wrong = (
            'burnish.render("a", colour="red")', 'burnish.render("a", look="nice")', 'burnish.render("a", annotate=["axes", "bx"])',
            'burnish.load("a", size=3)', 'burnish.load("a").render(up="+Y")', 'burnish.render("a", look=False)', 'burnish.Mesh([], zoom=2)',
            'burnish.render("a", cameras=[]).hash', 'burnish.render("a", planes=["depths"])', 'burnish.load("a", files=7)',
        )  # fmt: skip
        Path("types/use.py").write_text("\n".join(["import burnish", *right, *wrong]) + "\n")
        check = [sys.executable, "-m", "mypy", "--strict", "--python-executable", sys.executable]
        run = subprocess.run([*check, "use.py"], cwd="types", capture_output=True, text=True)
        errors = [line.split(":")[:2] for line in run.stdout.splitlines() if ": error: " in line]
        self.assertEqual(errors, [["use.py", str(2 + len(right) + i)] for i in range(len(wrong))], run.stdout)
        run = subprocess.run([*check, "--package=burnish"], cwd="types", capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stdout)


class Planes(unittest.TestCase):
    def test_program(self):
        """Planes are those of --plane."""
        files = {"depth": ("f", (48, 64)), "normal": ("f", (48, 64, 3)), "triangle": ("I", (48, 64)), "coverage": ("B", (48, 64))}
        flags = [flag for name in files for flag in ("--plane", f"{name}:{name}.npy")]
        subprocess.run([PROGRAM, "render", ":teapot", "--resolution=64,48", *flags, "-o", "planes.png", "--quiet"], check=True)
        mesh = burnish.load(":teapot")
        picture = mesh.render(resolution=(64, 48), planes=files)
        self.assertEqual(picture.hash, mesh.render(resolution=(64, 48)).hash)
        self.assertEqual(list(picture.planes), list(files))
        for name, (format_, shape) in files.items():
            plane = picture.planes[name]
            self.assertEqual((plane.format, plane.shape), (format_, shape))
            self.assertEqual(plane.tobytes(), Path(f"{name}.npy").read_bytes()[-plane.nbytes :], name)
        self.assertEqual(picture.planes["depth"].tolist()[0][0], float("inf"))
        self.assertLess(min(min(row) for row in picture.planes["triangle"].tolist()), mesh.faces.shape[0])

    def test_choice(self):
        self.assertEqual(burnish.render(":knot", size=16).planes, {})
        self.assertEqual(list(burnish.render(":knot", size=16, planes="depth").planes), ["depth"])
        depth = burnish.render(":knot", size=16, planes=["depth"]).planes["depth"]
        gc.collect()
        self.assertEqual(len(depth.tolist()), 16)
        with self.assertRaisesRegex(ValueError, "planes: 'depths'; expected some of depth, normal, triangle, coverage"):
            burnish.render(":knot", planes=["depths"])


class Cameras(unittest.TestCase):
    R = ((0.36, 0.48, -0.8), (-0.8, 0.6, 0.0), (0.48, 0.64, 0.6))
    t = (0.3, -0.2, 5.0)

    @unittest.skipUnless(numpy, "no NumPy")
    def test_projection(self):
        """Depths of slanted planes are those of K, R and t, to a hundredth of a pixel across and down."""
        K = numpy.array([[310.7, 0, 71.3], [0, 262.4, 40.9], [0, 0, 1]])
        R, t = numpy.array(self.R), numpy.array(self.t)
        width, height = 160, 120
        rays = numpy.linalg.inv(K) @ numpy.stack([*numpy.meshgrid(range(width), range(height)), numpy.ones((height, width))]).reshape(3, -1)
        for slope in ((3.0, 0.2), (-0.3, -4.0)):  # of z along x and y of the camera
            corners = numpy.array([(x, y, 5 + slope[0] * x + slope[1] * y) for x, y in ((-0.7, -0.7), (0.7, -0.7), (0.3, 0.7))])
            mesh = burnish.Mesh((corners - t) @ R)
            shot = mesh.render(resolution=(width, height), planes=["depth", "coverage"], K=K, R=R, t=t.reshape(3, 1))
            depth = numpy.asarray(shot.planes["depth"], float)
            expected = (5 / (rays[2] - slope[0] * rays[0] - slope[1] * rays[1])).reshape(height, width)
            steps = numpy.hypot(*numpy.gradient(expected))
            inside = numpy.asarray(shot.planes["coverage"]) == 255
            self.assertGreater(inside.sum(), 1000)
            self.assertLess(numpy.max((abs(depth - expected) / steps)[inside]), 0.01)
            at = K @ corners.mean(axis=0)
            self.assertTrue(inside[round(at[1] / at[2]), round(at[0] / at[2])])

    def test_usual_camera(self):
        """The middle of the picture and equal focal lengths are the camera of other flags, bit by bit."""
        camera = {"camera_position": (3, 2, 4), "camera_focal_point": (0, 0, 0), "camera_view_up": (0, 1, 0)}
        usual = burnish.render(":knot", resolution=(64, 48), camera_view_angle=90, **camera)
        self.assertEqual(burnish.render(":knot", resolution=(64, 48), camera_intrinsics=(24, 24, 31.5, 23.5), **camera).hash, usual.hash)

    def test_several(self):
        K = ((50, 0, 15.5), (0, 50, 15.5), (0, 0, 1))
        mesh = burnish.load(":knot")
        one = mesh.render(size=32, K=K, R=self.R, t=self.t, look="clay")
        pictures = burnish.render(mesh, size=32, look="clay", cameras=[(K, self.R, self.t), {"views": "front"}])
        self.assertEqual([picture.hash for picture in pictures], [one.hash, mesh.render(size=32, views="front", look="clay").hash])
        self.assertEqual([p.hash for p in burnish.render(":knot", size=32, look="clay", cameras=[{"K": K, "R": self.R, "t": self.t}])], [one.hash])
        self.assertEqual([p.hash for p in mesh.render(size=32, look="clay", cameras=[(K, self.R, self.t)])], [one.hash])
        self.assertEqual(burnish.render(mesh, cameras=[]), [])

    def test_sheet(self):
        pictures = burnish.render(":knot", size=(20, 16), no_background=True, cameras=[{"azimuth": angle} for angle in (0, 40, 80)])
        sheet = burnish.sheet(pictures, columns=2)
        rows = [sheet.tobytes()[start : start + 160] for start in range(0, 160 * 32, 160)]
        self.assertEqual(b"".join(row[80:] for row in rows[:16]), pictures[1].tobytes())
        self.assertEqual(b"".join(row[:80] for row in rows[16:]), pictures[2].tobytes())
        self.assertEqual(set(b"".join(row[80:] for row in rows[16:])), {0})
        self.assertEqual(burnish.sheet(iter(pictures)).hash, sheet.hash)
        for wrong in ([], [pictures[0], burnish.render(":knot", size=20)]):
            with self.assertRaises(ValueError):
                burnish.sheet(wrong)

    def test_refused(self):
        K = ((50, 0, 16), (0, 50, 16), (0, 0, 1))
        for kind, line, matrices in (
            (TypeError, "omit", {"K": K, "R": self.R, "t": self.t, "camera_position": (1, 2, 3)}),
            (TypeError, "together", {"K": K}), (ValueError, "expected K", {"K": ((50, 0, 16), (0, 1, 16)), "R": self.R, "t": self.t}),
            (ValueError, "fx", {"K": ((50, 1, 16), *K[1:]), "R": self.R, "t": self.t}),
            (ValueError, "rotation", {"K": K, "R": ((1, 0, 0), (0, 1, 0), (0, 0, -1)), "t": self.t}),
            (ValueError, "rotation", {"K": K, "R": ((2, 0, 0), (0, 1, 0), (0, 0, 2)), "t": self.t}),
            (burnish.ArgumentError, "camera_intrinsics: ", {"K": ((0, 0, 16), *K[1:]), "R": self.R, "t": self.t}),
        ):  # fmt: skip
            with self.assertRaisesRegex(kind, line):
                burnish.render(":knot", **matrices)
        with self.assertRaises(TypeError):
            burnish.render(":knot", cameras=[{"up": "+Z"}])


class Images(unittest.TestCase):
    def setUp(self):
        self.picture = burnish.render(":knot", size=40, no_background=True)

    def test_buffer(self):
        view = memoryview(self.picture)
        self.assertEqual((view.shape, view.format, view.readonly, view.nbytes), ((40, 40, 4), "B", True, 6400))
        self.assertEqual(view.tobytes(), self.picture.tobytes())
        kept = view[:]
        hash_ = burnish.render(":knot", size=40, no_background=True)
        del self.picture
        gc.collect()
        self.assertEqual(kept.tobytes(), hash_.tobytes())

    def test_png(self):
        png = self.picture.png()
        self.assertEqual(self.picture._repr_png_(), png)
        self.picture.save(Path("knot.png"))
        self.assertEqual(Path("knot.png").read_bytes(), png)
        self.assertEqual(outputs.png("knot.png")[:5], (40, 40, 4, 8, list(self.picture.tobytes())))
        with self.assertRaises(burnish.Error) as caught:
            self.picture.save("no such folder/knot.png")
        self.assertEqual(caught.exception.status, "WRITE")
        self.assertIsInstance(caught.exception, FileNotFoundError)
        # the extension decides, as in Pillow: no PNG file gets another format's name
        for name in ("x.jpg", "x.webp", "a.png/x.svg", Path("x.gif")):
            with self.subTest(name), self.assertRaisesRegex(ValueError, "save\\(\\) writes PNG"):
                self.picture.save(name)
            self.assertFalse(Path(name).exists())
        stream = io.BytesIO()
        self.picture.save(stream)
        for name in ("X.PNG", "plain"):
            self.picture.save(name)
            self.assertEqual(Path(name).read_bytes(), stream.getvalue())

    def test_copies(self):
        """Pickling and copying keep everything."""
        picture = burnish.render(DATA / "cube.obj", size=(40, 30), no_textures=True, planes=["depth", "normal", "triangle", "coverage"])
        with_warning = burnish.render((DATA / "textured.obj").read_bytes(), name="textured.obj", size=16)
        self.assertNotEqual(with_warning.warnings, ())
        for image in (self.picture, picture, with_warning):
            for copied in (copy.copy(image), copy.deepcopy([image])[0], *(pickle.loads(pickle.dumps(image, protocol)) for protocol in range(6))):
                for key in ("hash", "shape", "mode", "camera", "covered_pixels", "warnings"):
                    self.assertEqual(getattr(copied, key), getattr(image, key), key)
                self.assertEqual(copied.tobytes(), image.tobytes())
                self.assertEqual(list(copied.planes), list(image.planes))
                for name, plane in image.planes.items():
                    other = copied.planes[name]
                    self.assertEqual((other.format, other.shape, other.readonly, other.tobytes()), (plane.format, plane.shape, True, plane.tobytes()))
        for wrong in ((b"", (1, 1, 3)), (b"123", (1, 1, 2)), (b"", (0, 0, 3)), (b"", (1 << 20, 1 << 20, 3))):
            with self.assertRaises(ValueError):
                _burnish.image(*wrong, 0, {}, {}, ())

    def test_constructors(self):
        for kind in (burnish.Image, burnish._burnish.Mesh, burnish._burnish.Array):
            with self.assertRaisesRegex(TypeError, "constructor"):
                kind()

    def test_pool(self):
        """Images and errors come back from other processes."""
        expected = burnish.render(":knot", size=24).hash
        for method in ("fork", "spawn"):
            with multiprocessing.get_context(method).Pool(1) as pool:
                self.assertEqual(pool.apply(burnish.render, (":knot",), {"size": 24}).hash, expected)
                with self.assertRaises(burnish.FileError) as caught:
                    pool.apply(burnish.load, ("no such file.stl",))
                self.assertEqual(caught.exception.status, "READ")

    @unittest.skipUnless(numpy, "no NumPy")
    def test_numpy(self):
        pixels = numpy.asarray(self.picture)
        self.assertEqual((pixels.shape, pixels.dtype, pixels.flags.writeable), ((40, 40, 4), numpy.uint8, False))
        self.assertEqual(pixels.ctypes.data, self.picture.__array_interface__["data"][0])  # not copied
        self.assertEqual(pixels.ctypes.data, numpy.asarray(self.picture).ctypes.data)

    @unittest.skipUnless(Pillow, "no Pillow")
    def test_pillow(self):
        for image in (
            Pillow.fromarray(self.picture),
            Pillow.frombuffer("RGBA", self.picture.size, self.picture, "raw", "RGBA", 0, 1),
            Pillow.open(io.BytesIO(self.picture.png())),
        ):
            self.assertEqual((image.mode, image.size, image.tobytes()), ("RGBA", (40, 40), self.picture.tobytes()))


class Arrays(unittest.TestCase):
    def setUp(self):
        self.expected = burnish.render(stl(CORNERS, FACES), name="t.stl", size=64, up="+Y").hash

    def draw(self, *arrays, **more):
        return burnish.Mesh(*arrays, **more).render(size=64).hash

    def test_lists(self):
        self.assertEqual(self.draw(CORNERS, FACES), self.expected)
        self.assertEqual(burnish.render((CORNERS, FACES), size=64).hash, self.expected)
        self.assertEqual(self.draw([CORNERS[i] for face in FACES for i in face]), self.expected)
        self.assertEqual(burnish.Scene, burnish.Mesh)

    def test_buffers(self):
        for vertex_code in "fdbhilqBHILQ":
            flat = array(vertex_code, (x for corner in CORNERS for x in corner))
            for face_code in "bBhHiIlLqQ":
                faces = array(face_code, (i for face in FACES for i in face))
                with self.subTest(vertices=vertex_code, faces=face_code):
                    self.assertEqual(self.draw(flat, faces), self.expected)

    @unittest.skipUnless(numpy, "no NumPy")
    def test_numpy_layouts(self):
        vertices, faces = numpy.array(CORNERS, "f4"), numpy.array(FACES, "u4")
        padded = numpy.zeros((4, 8), "f4")
        padded[:, :3] = vertices
        wide = numpy.zeros((8, 6), "i8")
        wide[::2, ::2] = faces
        for v in (vertices, padded[:, :3], numpy.asfortranarray(vertices), vertices.astype("f8")[::-1][::-1]):
            for f in (faces, faces.astype("u1"), numpy.asfortranarray(faces), wide[::2, ::2]):
                self.assertEqual(self.draw(v, f), self.expected)
        self.assertEqual(self.draw(vertices[faces]), self.expected)
        self.assertEqual(burnish.load(SimpleNamespace(vectors=vertices[faces]), up="+Y").faces.shape, (len(faces), 3))  # numpy-stl
        self.assertEqual(burnish.render(vertices[faces], size=64).hash, self.expected)

    @unittest.skipUnless(numpy, "no NumPy")
    def test_numpy_types(self):
        red = self.draw(CORNERS, FACES, colors=[(255, 0, 0)] * 4)
        for dtype in ("f2", ">f4", ">f8", "longdouble", "i8", ">i2", "u1"):
            with self.subTest(dtype):
                self.assertEqual(self.draw(numpy.array(CORNERS, dtype), FACES), self.expected)
        for dtype in (">u4", ">i8", "u2"):
            self.assertEqual(self.draw(CORNERS, numpy.array(FACES, dtype)), self.expected)
        for dtype in ("i8", "u1", ">u2", "i4"):
            self.assertEqual(self.draw(CORNERS, FACES, colors=numpy.array([(255, 0, 0)] * 4, dtype)), red)

    def test_color_ranges(self):
        """Floats are in [0, 1]: floats of bytes are an error, not white."""
        for colors in ([(200.0, 0, 0)] * 4, [(0, 0, -0.1)] * 4, [(float("nan"), 0, 0)] * 4, [(300, 0, 0)] * 4, [(0, -1, 0)] * 4, array("h", [0] * 15 + [256])):
            with self.subTest(colors), self.assertRaisesRegex(ValueError, "colors: row [03] "):
                burnish.Mesh(CORNERS, FACES, colors=colors)
        nearly = self.draw(CORNERS, FACES, colors=[(1.000001, -0.000001, 0.0)] * 4)
        self.assertEqual(nearly, self.draw(CORNERS, FACES, colors=[(255, 0, 0)] * 4))

    def test_polygons(self):
        square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 2, 0)]
        pentagon = self.draw(square, [(0, 1, 2, 4, 3)])
        self.assertEqual(pentagon, self.draw(square, [(0, 1, 2), (0, 2, 4), (0, 4, 3)]))
        self.assertEqual(pentagon, self.draw(square, [(0, 1, 2, 4), (0, 4, 3)]))

    def test_colors_normals_up(self):
        red = [(255, 0, 0)] * 4
        plain = self.draw(CORNERS, FACES, colors=red)
        self.assertNotEqual(plain, self.expected)
        self.assertEqual(self.draw(CORNERS, FACES, colors=[(1.0, 0.0, 0.0)] * 4), plain)
        self.assertEqual(self.draw(CORNERS, FACES, colors=[(255, 0, 0, 255)] * 4), plain)
        mesh = burnish.Mesh(CORNERS, FACES, [(1, 0, 0)] * 4, red, [(0, 0)] * 4, up="-X", crease_angle=30)
        self.assertTrue(all(abs(x) == 1 for x, _, _ in mesh.normals.tolist()))
        self.assertEqual(mesh.colors.tolist()[0], [255, 0, 0, 255])
        self.assertNotEqual(self.draw(CORNERS, FACES, up="-X"), self.expected)

    def test_round_trip(self):
        mesh = burnish.Mesh(CORNERS, FACES)
        again = burnish.Mesh(mesh.vertices, mesh.faces, mesh.normals)
        self.assertEqual(again.render(size=64).hash, self.expected)
        self.assertEqual(sorted(set(map(tuple, mesh.vertices.tolist()))), sorted(map(tuple, (map(float, c) for c in CORNERS))))

    def test_duck_typing(self):
        vector = lambda p: SimpleNamespace(x=p[0], y=p[1], z=p[2])  # noqa: E731
        tessellate = lambda tolerance: ([vector(p) for p in CORNERS], FACES)  # noqa: E731
        box = SimpleNamespace(DiagonalLength=4)
        solid = SimpleNamespace(tessellate=tessellate, BoundingBox=lambda: box)
        standing = burnish.render(stl(CORNERS, FACES), name="t.stl", size=64).hash
        self.assertEqual(burnish.render(solid, size=64).hash, standing)
        self.assertEqual(burnish.render(SimpleNamespace(vals=lambda: [solid]), size=64).hash, standing)
        red = [(255, 0, 0, 255)] * 4
        colored = self.draw(CORNERS, FACES, colors=red, up="auto")  # as files are: these libraries know no axis
        grey = self.draw(CORNERS, FACES, up="auto")
        trimesh = SimpleNamespace(vertices=CORNERS, faces=FACES, visual=SimpleNamespace(kind="vertex", vertex_colors=red))
        self.assertEqual(burnish.render(trimesh, size=64).hash, colored)
        open3d = SimpleNamespace(
            vertices=CORNERS, triangles=FACES, has_vertex_colors=lambda: True, vertex_colors=[(1.0, 0.0, 0.0)] * 4,
            has_vertex_normals=lambda: False,
        )  # fmt: skip
        self.assertEqual(burnish.render(open3d, size=64).hash, colored)
        meshio = SimpleNamespace(points=CORNERS, cells_dict={"triangle": FACES})
        self.assertEqual(burnish.render(meshio, size=64).hash, grey)
        self.assertEqual(burnish.render(meshio, size=64, up="+Y").hash, self.expected)
        mixed = SimpleNamespace(points=CORNERS, cells_dict={"line": [(0, 1)], "triangle": FACES[:2], "quad": [(0, 3, 2, 1)]})
        self.assertEqual(burnish.load(mixed).faces.shape, (4, 3))
        with self.assertRaisesRegex(ValueError, "no triangle or quad in the mesh's cells, which are: line, tetra"):
            burnish.load(SimpleNamespace(points=CORNERS, cells_dict={"line": [(0, 1)], "tetra": [(0, 1, 2, 3)]}))
        pyvista = SimpleNamespace(points=CORNERS, regular_faces=FACES)
        self.assertEqual(burnish.render(pyvista, size=64).hash, grey)

    def test_up_of_other_libraries(self):
        """A pyramid that would fall over on +Y stands on +Z, like its STL file."""
        corners = [(0, -2, 0), (2, -1, 0), (2, 1, 0), (0, 2, 0), (-2, 1, 0), (-2, -1, 0), (0, 0, 3)]
        faces = [(i, (i + 1) % 6, 6) for i in range(6)] + [(0, i + 1, i) for i in range(1, 5)]
        expected = burnish.render(stl(corners, faces), name="t.stl", size=64).hash
        self.assertEqual(burnish.render(SimpleNamespace(vertices=corners, faces=faces), size=64).hash, expected)

    @unittest.skipUnless(numpy, "no NumPy")
    def test_face_colors(self):
        colors = numpy.array([(255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (255, 255, 0, 255)], "u1")
        trimesh = SimpleNamespace(
            vertices=numpy.array(CORNERS, "f8"), faces=numpy.array(FACES), visual=SimpleNamespace(kind="face", face_colors=colors)
        )
        corners = [CORNERS[i] for face in FACES for i in face]
        expected = self.draw(corners, colors=[color for color in colors.tolist() for _ in range(3)], up="auto")
        self.assertEqual(burnish.render(trimesh, size=64).hash, expected)

    def test_textures_of_trimesh(self):
        trimesh = SimpleNamespace(vertices=CORNERS, faces=FACES, visual=SimpleNamespace(kind="texture"))
        with self.assertWarnsRegex(UserWarning, "burnish ignores textures of trimesh"):
            burnish.load(trimesh)

    def test_copies(self):
        """A copy is the mesh itself, which can't change."""
        mesh = burnish.Mesh(CORNERS, FACES)
        self.assertIs(copy.copy(mesh), mesh)
        self.assertIs(copy.deepcopy({"a": mesh})["a"], mesh)
        with self.assertRaisesRegex(TypeError, "a Mesh can't be pickled"):
            pickle.dumps(mesh)

    def test_refused(self):
        for face in (4, 9, -1, 1 << 40, -(1 << 40)):  # one class for all, which is documented
            for faces in ([(0, 1, face)], array("q", (0, 1, face))):
                with self.subTest(faces), self.assertRaises(ValueError) as caught:
                    burnish.Mesh(CORNERS, faces)
                self.assertEqual((type(caught.exception), caught.exception.status), (burnish.ArgumentError, "ARGUMENT"))
        for arrays, kind in (
            ((CORNERS, array("d", [0, 1, 2])), TypeError),
            (([(0, 0), (1, 0), (0, 1)],), ValueError),
            ((array("f", range(8)),), ValueError),
            (([(0, 0, 0), (float("nan"), 0, 0), (0, 1, 0)],), burnish.Error),
            (([(0, 0, 0)] * 3,), burnish.Error),
            ((CORNERS, FACES, [(1, 0, 0)]), burnish.Error),
            ((7,), TypeError),
        ):
            with self.subTest(arrays), self.assertRaises(kind):
                burnish.Mesh(*arrays)
        with self.assertRaises(TypeError):
            burnish.render(SimpleNamespace())
        with self.assertRaises(TypeError):
            _burnish.Mesh()


class Contents(unittest.TestCase):
    def test_project(self):
        """A project of two plates: parts, plates and filaments, as they are in the file."""
        namespace = 'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"'
        mesh = "<mesh><vertices>{}</vertices><triangles>{}</triangles></mesh>".format(
            "".join('<vertex x="{}" y="{}" z="{}"/>'.format(*corner) for corner in CORNERS),
            "".join('<triangle v1="{}" v2="{}" v3="{}"/>'.format(*face) for face in FACES),
        )
        plates = "".join(
            f'<plate><metadata key="plater_id" value="{n}"/><metadata key="plater_name" value="p\u00e9 {n}"/><model_instance>'
            f'<metadata key="object_id" value="1"/><metadata key="instance_id" value="{n - 1}"/></model_instance></plate>' for n in (1, 2)
        )
        parts = {
            "3D/3dmodel.model": f'<model {namespace}><resources><object id="1">{mesh}</object></resources><build>'
            '<item objectid="1" transform="1 0 0 0 1 0 0 0 1 5 6 7"/><item objectid="1" printable="0"/></build></model>',
            "Metadata/model_settings.config": '<config><object id="1"><metadata key="name" value="wedge"/>'
            f'<metadata key="extruder" value="2"/></object>{plates}</config>',
            "Metadata/project_settings.config": '{"filament_colour":["#FF8000","#0000FF"]}',
        }
        archive = io.BytesIO()
        with zipfile.ZipFile(archive, "w") as file:
            for name, text in parts.items():
                file.writestr(name, text)
        project = burnish.load(archive.getvalue(), name="a.3mf")
        row = project.parts[0]
        self.assertEqual(row[:-1], ("wedge", "solid", 1, 0, 1, 2, 4, [1, 2, 3]))
        self.assertEqual(row.transform, [1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 1, 7])
        self.assertEqual((project.parts[1].role, project.parts[1].size), ("not printed", None))
        self.assertEqual(project.plates, [(1, "p\u00e9 1", [1, 2, 3]), (2, "p\u00e9 2", None)])
        self.assertEqual(project.filaments, [burnish.Filament("#FF8000", 0), burnish.Filament("#0000FF", 0)])
        self.assertEqual(project.face_parts.tolist(), [0] * 4)

    def test_others(self):
        teapot = burnish.load(":teapot")
        self.assertEqual((teapot.parts, teapot.plates, teapot.filaments, teapot.face_parts), ([], [], [], None))

    def test_importers(self):
        """A program in BURNISH_IMPORTERS reads other formats, here with a triangle as its answer."""
        stream = struct.pack("<8s2IQ6I4f9f3I", b"\x89BMS\r\n\x1a\n", 1, 0, 112, 3, 1, *(0,) * 6, 1, 0, *(0, 0, 0, 1, 0, 0, 0, 1, 0), 0, 1, 2)
        Path("part.fbx").write_bytes(b"Kaydara FBX Binary")
        Path("burnish-import-assimp").write_bytes(b"#!/bin/sh\n[ $1 = fbx ] && tail -c 112 $0\nexit\n" + stream)
        Path("burnish-import-assimp").chmod(0o755)
        os.environ["BURNISH_IMPORTERS"] = os.getcwd()
        self.addCleanup(os.environ.pop, "BURNISH_IMPORTERS")
        self.assertEqual(burnish.load("part.fbx").vertices.tolist(), [[0, 0, 0], [1, 0, 0], [0, 1, 0]])
        os.environ["BURNISH_IMPORTERS"] = "/"
        with self.assertRaisesRegex(burnish.Error, "^part.fbx: burnish-import-assimp reads such files and is not installed"):
            burnish.load("part.fbx")
        with self.assertRaisesRegex(burnish.Error, "^a.glb: burnish-import-draco reads such files and is not installed"):
            burnish.load((SOURCES / "test/importers/ring.glb").read_bytes(), name="a.glb")


class Errors(unittest.TestCase):
    def test_lines(self):
        for options, flag in (
            ({"samples": 3}, "--samples=3"), ({"lobe": "enrgy"}, "--lobe=enrgy"), ({"size": 0}, "--size=0"),
            ({"light": ["spot:1,2,3"]}, "--light=spot:1,2,3"),
        ):  # fmt: skip
            with self.subTest(flag), self.assertRaises(burnish.Error) as caught:
                burnish.render(":sphere", **options)
            line = re.sub("--(?!help)(?=[a-z])", "", ask(":sphere", flag))  # options as they are named here
            self.assertEqual((str(caught.exception), caught.exception.status), (line, "ARGUMENT"))

    def test_names(self):
        """Errors and warnings name options as they are here, and files as they are."""
        Path("--size.d").mkdir(exist_ok=True)
        for name in ("--size.d/--part-a.stl", "--size", "--margin.stl", "x --size.stl"):
            with self.subTest(name):
                with self.assertRaises(burnish.Error) as caught:
                    burnish.load(name)
                self.assertTrue(str(caught.exception).startswith(f"{name}: can't be opened"), caught.exception)
                with self.assertRaises(burnish.Error) as caught:
                    burnish.load(b"solid", name=name)
                self.assertTrue(str(caught.exception).startswith(f"{name}: "), caught.exception)
                picture = burnish.load(b"mtllib --color.mtl\n" + (DATA / "cube.obj").read_bytes(), name=name, input_format="obj")
                first = picture.warnings[0]
                self.assertTrue("--color.mtl" in first and first.startswith(f"{name}:"), first)
                last = picture.render(size=40, annotate="scale").warnings[-1]
                self.assertEqual(last, f"{name}: annotate: scale: a perspective has no scale, so the picture has no bar; use camera_orthographic, or omit it")
        with self.assertRaisesRegex(burnish.Error, '^look: "--size" is not one of'):
            burnish.render(":knot", look="--size")

    def test_statuses(self):
        Path("broken.ply").write_text("ply\nformat ascii 1.0\nelement vertex 3\n")
        for source, more, status in (
            ("no such file.stl", {}, "READ"), ("broken.ply", {}, "FORMAT"), (":cow", {}, "ARGUMENT"),
            (":teapot", {"max_triangles": 10}, "LIMIT"), (b"", {"name": "empty.stl"}, "FORMAT"),
        ):  # fmt: skip
            with self.subTest(source), self.assertRaises(burnish.Error) as caught:
                burnish.render(source, **more)
            self.assertEqual(caught.exception.status, status)

    def test_os_errors(self):
        """`except OSError` catches what open() would raise."""
        with self.assertRaises(FileNotFoundError) as caught:
            burnish.load("no such file.stl")
        self.assertIsInstance(caught.exception, burnish.Error)
        self.assertTrue(str(caught.exception).startswith("no such file.stl: "))
        with self.assertRaises(OSError) as caught:
            burnish.load(".")
        self.assertNotIsInstance(caught.exception, FileNotFoundError)

    def test_unknown_options(self):
        for call, line in (
            (lambda: burnish.render(":knot", siz=3), "render() got an unexpected keyword argument 'siz'. Did you mean 'size'?"),
            (lambda: burnish.load(":knot").render(zzzzz=3), "render() got an unexpected keyword argument 'zzzzz'"),
            (lambda: burnish.load(":knot", strickt=True), "load() got an unexpected keyword argument 'strickt'. Did you mean 'strict'?"),
            (lambda: burnish.load(":knot", size=3), "load() does not take 'size'; render() does"),
            (lambda: burnish.render(":knot", size=3j), "size: 3j is not a bool, a number, a text or a list of these"),
        ):
            with self.subTest(line), self.assertRaises(TypeError) as caught:
                call()
            self.assertEqual(str(caught.exception), line)

    def test_wrong_options(self):
        for call in (
            lambda: burnish.load(":knot").render(clip="1,0,0,0"),
            lambda: burnish.render(":knot", help=True),
            lambda: burnish.render(":knot", look="a\0b"),
            lambda: burnish.render("a\0b"),
            lambda: burnish.Mesh(CORNERS, FACES, up="W"),
        ):
            with self.assertRaises((TypeError, ValueError, burnish.Error)):
                call()


class Process(unittest.TestCase):
    def test_threads(self):
        shared = burnish.load(":teapot")
        expected = shared.render(size=128).hash
        found = []

        def work(index):
            for _ in range(4):
                found.append((shared if index % 2 else burnish.load(":teapot")).render(size=128).hash)

        threads = [threading.Thread(target=work, args=(index,)) for index in range(8)]
        [thread.start() for thread in threads]
        [thread.join() for thread in threads]
        self.assertEqual(found, [expected] * 32)

    def test_interrupt(self):
        """Another thread interrupts a picture: it runs only if drawing has released the lock, and only
        a picture that polls for signals stops."""
        mesh = burnish.load(":knot", tessellation=128)
        drawing = threading.Event()
        drawn = []

        def interrupt():
            drawing.wait()
            os.kill(os.getpid(), signal.SIGINT)

        self.addCleanup(signal.signal, signal.SIGINT, signal.getsignal(signal.SIGINT))
        signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell may have the test ignore it
        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        sys.setswitchinterval(3600)  # threads take turns only where one gives up the lock
        thread = threading.Thread(target=interrupt)
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            drawing.set()
            drawn.append(mesh.render(size=8192, samples=16, threads=1, ground=True))
        thread.join()
        self.assertEqual(drawn, [])
        self.assertEqual(mesh.render(size=32).hash, burnish.render(":knot", tessellation=128, size=32).hash)

    def test_handler(self):
        """A signal's handler that uses the mesh being drawn gets an exception instead of waiting for itself."""
        mesh = burnish.load(":knot", tessellation=128)
        drawing = threading.Event()
        found = []

        def handle(*_):
            for use in (lambda: mesh.render(size=8), lambda: mesh.warnings):
                try:
                    use()
                except RuntimeError as error:
                    found.append(str(error))
            found.append(burnish.render(":sphere", size=8).hash)
            raise KeyboardInterrupt

        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, handle))
        thread = threading.Thread(target=lambda: (drawing.wait(), os.kill(os.getpid(), signal.SIGINT)))
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            drawing.set()
            mesh.render(size=8192, samples=16, threads=1, ground=True)
        thread.join()
        line = "a signal handler can't use the mesh that it interrupts; use another mesh"
        self.assertEqual(found, [line, line, burnish.render(":sphere", size=8).hash])
        self.assertEqual(mesh.warnings, ())

    def test_no_leak(self):
        vertices, faces = array("f", (x for c in CORNERS for x in c)), array("i", (i for f in FACES for i in f))
        content = stl(CORNERS, FACES)

        def work():
            mesh = burnish.Mesh(vertices, faces, colors=bytes(16))
            picture = mesh.render(size=256)
            mesh.render(size=64, planes=["depth", "normal", "triangle", "coverage"]).planes
            memoryview(picture), mesh.vertices, mesh.faces, picture.png(), picture.camera, picture.warnings
            burnish.load(content, name="t.stl", files={"a": content})
            burnish.lobe.values("power", 8, vertices)
            for wrong in (lambda: mesh.render(size=-1), lambda: burnish.Mesh(vertices, [(0, 1, 99)]), lambda: burnish.Mesh(vertices, colors=faces)):
                try:
                    wrong()
                except (burnish.Error, ValueError):
                    pass

        def taken():
            info = LIBC.mallinfo2()
            return info.uordblks + info.hblkhd

        for _ in range(30):
            work()
        gc.collect()
        counts, memory = (sys.getrefcount(vertices), sys.getrefcount(content), sys.getrefcount(_burnish.Mesh)), taken()
        for _ in range(150):  # 150 pictures of 192 KiB would be 28 MiB
            work()
        gc.collect()
        self.assertEqual((sys.getrefcount(vertices), sys.getrefcount(content), sys.getrefcount(_burnish.Mesh)), counts)
        self.assertLess(taken() - memory, 150 * 1024)  # less than a KiB each


class Lobes(unittest.TestCase):
    def test_program(self):
        """Numbers are those of `burnish lobe`."""
        run = subprocess.run([PROGRAM, "lobe", "table", "--metrics=all", "--format=json"], capture_output=True, text=True)
        rows = json.loads(run.stdout)["rows"]
        lobes = list(dict.fromkeys(row["lobe"] for row in rows))
        exponents = list(dict.fromkeys(row["exponent"] for row in rows))
        found = {(row["lobe"], row["exponent"]): row for row in burnish.lobe.table(lobes, exponents)}
        for row in rows:
            finite = {key: None if value == float("inf") else value for key, value in found[row["lobe"], row["exponent"]].items()}
            self.assertEqual(finite, row)  # JSON has no infinity

    def test_values(self):
        cosines = array("f", (i / 100 for i in range(101)))
        for words in ("energy:2", "power", "schlick"):
            values = burnish.lobe.values(words, 20, cosines)
            self.assertEqual((values.format, len(values)), ("f", 101))
        self.assertEqual(list(burnish.lobe.values("power", 20, [])), [])
        with self.assertRaises(burnish.Error):
            burnish.lobe.values("enrgy", 64, [1.0])


class Pages(unittest.TestCase):
    def test_docstrings(self):
        for module in (burnish, burnish.lobe):
            # an error's text is the library's, which doctest need not know whole
            result = doctest.testmod(module, extraglobs={"burnish": burnish}, optionflags=doctest.ELLIPSIS | doctest.IGNORE_EXCEPTION_DETAIL)
            self.assertEqual(result.failed, 0)
            self.assertGreater(result.attempted, 4)

    def test_guide(self):
        """The code of bindings/python/README.md runs, in its order."""
        Path("part.stl").write_bytes((DATA / "wedge.stl").read_bytes())
        names = {}
        blocks = re.findall(r"^```python\n(.*?)^```", (SOURCES / "bindings/python/README.md").read_text(), re.S | re.M)
        for block in blocks:
            if numpy or "numpy" not in block:
                exec(compile(block, "bindings/python/README.md", "exec"), names)
        self.assertGreater(len(blocks), 4)

    def test_notebook(self):
        """The notebook has no outputs, and its cells run in their order."""
        cells = json.loads((SOURCES / "docs/examples/notebook.ipynb").read_text())["cells"]
        names = {}
        for cell in cells:
            if cell["cell_type"] == "code":
                self.assertEqual((cell["outputs"], cell["execution_count"]), ([], None))
                exec(compile("".join(cell["source"]), "notebook.ipynb", "exec"), names)
        self.assertEqual(len({picture.hash for picture in names["views"].values()}), 4)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
