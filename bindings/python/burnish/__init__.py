"""Meshes drawn on the CPU, the same pixels on every machine.

>>> import burnish
>>> picture = burnish.render(":teapot", size=64)
>>> picture
<burnish.Image 64x64 RGB ...>
>>> picture.save("teapot.png")

Inputs: a file's name, the bytes of a file, a mesh of trimesh, Open3D, PyVista or meshio, a shape of CadQuery, build123d
or FreeCAD, a pair (vertices, faces), or a Mesh. Options are the flags of ``burnish render`` with _ instead of -; see Options.
"""

from __future__ import annotations

import copyreg
import difflib
import json
import math
import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, overload

from . import _burnish, _cameras, _shapes, lobe
from ._burnish import ArgumentError, Error, FileError, Image, MissingFileError
from ._options import Drawing, Loading, Options, Plane, Words

if TYPE_CHECKING:
    from typing import Unpack

__all__ = [
    "ArgumentError", "Drawing", "Error", "FileError", "Filament", "Image", "Loading", "Mesh", "MissingFileError", "Options", "Part",
    "Plate", "Scene", "__version__", "load", "lobe", "render", "sheet",
]  # fmt: skip
__version__: str = _burnish.version

_FLAGS = {name.replace("-", "_"): row["phases"] for row in json.loads(_burnish.flags()) for name in (row["name"], *row["also"])}
_PLANES = {"depth": 1, "normal": 2, "triangle": 4, "coverage": 8}  # as in session.h
_AXES = {"+X": (1, 0, 0), "-X": (-1, 0, 0), "+Y": (0, 1, 0), "-Y": (0, -1, 0), "+Z": (0, 0, 1), "-Z": (0, 0, -1)}


def __dir__() -> list[str]:
    return __all__


def _values(key: str, value: Any) -> list[bool | str | tuple[float, ...]]:
    """A value as the extension takes it: a bool, a text or numbers; each one of a list with texts or vectors."""
    if getattr(value, "shape", None) == () and hasattr(value, "item"):  # a scalar of NumPy
        value = value.item()
    if isinstance(value, (bool, str)):
        return [value]
    if isinstance(value, os.PathLike):
        return [os.fsdecode(value)]
    try:
        items = list(value) if hasattr(value, "__iter__") else [value]
        if any(hasattr(item, "__iter__") for item in items):
            return [one for item in items for one in _values(key, item)]
        return [tuple(float(item) for item in items) or False]
    except TypeError:
        raise TypeError(f"{key}: {value!r} is not a bool, a number, a text or a list of these") from None


def _pairs(options: Mapping[str, Any]) -> list[tuple[str, bool | str | tuple[float, ...]]]:
    """{"samples": 4, "ground": True} as [("samples", (4.0,)), ("ground", True)]; each item of a list has the option's name."""
    return [(key, one) for key, value in options.items() if value is not None for one in _values(key, value)]


def _check(function: str, options: Mapping[str, Any], phase: str | None, instead: str = "") -> None:
    """Raises TypeError for unknown options, and for options that do not act in a phase, "load" or "draw"."""
    for key in options:
        if key not in _FLAGS:
            near = difflib.get_close_matches(key, _FLAGS, 1)
            hint = f". Did you mean '{near[0]}'?" if near else ""
            raise TypeError(f"{function}() got an unexpected keyword argument '{key}'{hint}")
        if phase and phase not in _FLAGS[key]:
            raise TypeError(f"{function}() does not take '{key}'; {instead} does")


def _kinds(planes: Words[Plane]) -> int:
    kinds = 0
    for plane in [planes] if isinstance(planes, str) else planes:
        if plane not in _PLANES:
            raise ValueError(f"planes: {plane!r}; expected some of {', '.join(_PLANES)}")
        kinds |= _PLANES[plane]
    return kinds


def _restore(pixels: bytes, shape: Any, covered: int, camera: Any, planes: Mapping[str, Any], warnings: Any) -> Image:
    views = {name: memoryview(data).cast(code, size) for name, (data, code, size) in planes.items()}
    return _burnish.image(pixels, shape, covered, camera, views, warnings)


def _reduce(image: Image) -> Any:
    """For pickle and copy: an image has its planes and facts wherever it goes."""
    planes = {name: (plane.tobytes(), plane.format, plane.shape) for name, plane in image.planes.items()}
    return _restore, (image.tobytes(), image.shape, image.covered_pixels, image.camera, planes, image.warnings)


copyreg.pickle(Image, _reduce)


class Part(NamedTuple):
    """A part of a mesh: an object of the file, or one of its volumes, at one of its places. Only solids are drawn."""

    name: str
    role: str
    """One of "solid", "negative volume", "modifier", "support blocker", "support enforcer", "support" or "not printed"."""
    id: int
    """Of the object in the file."""
    item: int
    """Of the file, that placed it: negative volumes are subtracted from solids of the same item."""
    plate: int | None
    filament: int | None
    """The number of its filament, from 1."""
    triangles: int
    size: list[float] | None
    """Of what is drawn, along X, Y and Z."""
    transform: list[float]
    """The matrix from the object to the file's coordinates: three rows of four."""


class Plate(NamedTuple):
    """A plate of a slicer's project."""

    number: int
    name: str
    size: list[float] | None
    """Of what is drawn of it; None for an empty plate."""


class Filament(NamedTuple):
    """A filament of a slicer's project or of G-code."""

    color: str
    """As "#FF8000"."""
    length: float
    """That G-code uses, in millimetres; 0 if unknown."""


class Mesh(_burnish.Mesh):
    """A mesh from arrays, which can be drawn many times and by several threads.

    vertices  (N, 3) numbers, or a list of triples
    faces     (M, 3) numbers of vertices; more columns are polygons. None: every three vertices are a triangle
    normals   (N, 3) floats. None: generated; each edge is smooth or sharp depending on its surroundings
    colors    (N, 3) or (N, 4), sRGB: integers in [0, 255], or floats in [0, 1]
    uv        (N, 2) floats: texture coordinates
    up        the up axis: "+Y", "+Z" ...
    name      for messages

    Arrays are objects with a buffer, such as NumPy arrays; they are copied. The other options are options of loading.
    The properties vertices, faces, normals and colors are memoryviews for numpy.asarray(). A vertex with several normals or colors
    is split, so there can be more vertices than were given.

    >>> corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> mesh = burnish.Mesh(corners, [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])
    >>> mesh
    <burnish.Mesh 4 triangles, 12 vertices>
    >>> mesh.bounds
    ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    >>> mesh.render(size=32, look="clay").shape
    (32, 32, 3)
    """

    __slots__ = ()

    def __new__(
        cls,
        vertices: Any,
        faces: Any = None,
        normals: Any = None,
        colors: Any = None,
        uv: Any = None,
        *,
        up: str = "+Y",
        name: str = "mesh",
        **options: Unpack[Loading],
    ) -> Mesh:
        _check("Mesh", options, "load", "render()")
        if up != "auto" and up not in _AXES:
            raise ValueError(f'up: "{up}"; expected one of {", ".join(_AXES)} and auto')
        if up == "auto":
            options["up"] = up
        floats = [_shapes.numbers(array, "f") for array in (vertices, normals, uv)]
        return _burnish.build(
            cls, name, floats[0], _shapes.numbers(faces, "I"), floats[1], _shapes.colors(colors), floats[2],
            _AXES.get(up, (0, 1, 0)), _pairs(options),
        )  # fmt: skip

    @overload
    def render(
        self, *, planes: Words[Plane] = (), K: Any = None, R: Any = None, t: Any = None, cameras: None = None, **options: Unpack[Drawing]
    ) -> Image: ...  # fmt: skip
    @overload
    def render(self, *, planes: Words[Plane] = (), cameras: Iterable[Any], **options: Unpack[Drawing]) -> list[Image]: ...
    def render(self, **options: Any) -> Image | list[Image]:
        """Draws the mesh, with options of drawing.

        planes   of "depth", "normal", "triangle" and "coverage": arrays in the property planes of the image
        K, R, t  a camera as in OpenCV: a point p in the file's coordinates, of vertices + origin, is at K (R p + t), x right, y down,
                 z forward, and pixel (0, 0) has its middle there. Distortion and skew are not possible.
        cameras  several pictures, as burnish.render() takes them
        """
        return render(self, **options)

    @property
    def parts(self) -> list[Part]:
        """What the file consists of, such as objects of 3MF and features of G-code; empty for formats without parts."""
        return [Part(**row) for row in json.loads(self._contents())["parts"]]

    @property
    def plates(self) -> list[Plate]:
        """The plates of a slicer's project that names some."""
        return [Plate(**row) for row in json.loads(self._contents())["plates"]]

    @property
    def filaments(self) -> list[Filament]:
        """Filament i + 1 of parts is item i."""
        contents = json.loads(self._contents())
        return [Filament(*row) for row in zip(contents["filaments"], contents["filament_lengths"])]

    def _repr_png_(self) -> bytes:
        return self.render(size=480).png()

    def __copy__(self) -> Mesh:
        return self

    def __deepcopy__(self, memo: Any) -> Mesh:
        return self

    def __reduce__(self) -> Any:
        raise TypeError("a Mesh can't be pickled; pickle its file's name or its arrays, and load it again")


Scene = Mesh


def load(
    source: str | os.PathLike[str] | bytes | bytearray | memoryview | Any,
    *,
    name: str | None = None,
    files: Mapping[str, Any] | None = None,
    tolerance: float | None = None,
    **options: Unpack[Loading],
) -> Mesh:
    """Loads a mesh: a file by its name, the bytes of one, an open binary file, a built-in object, or another library's mesh.

    name       of bytes and arrays, for messages; the extension of a file name chooses the format
    files      files that the bytes refer to, such as textures: {"part.mtl": b"..."}
    tolerance  maximum distance of triangles from a CAD shape's surface; by default 1/1000 of its size

    The other options are options of loading.

    >>> burnish.load(":sphere")
    <burnish.Mesh 12288 triangles, 6146 vertices>
    >>> burnish.load(b"solid\\nfacet oops", name="part.stl")
    Traceback (most recent call last):
    burnish.Error: part.stl: ...
    """
    _check("load", options, "load", "render()")
    if hasattr(source, "read") and not isinstance(source, (str, bytes)):
        name = name or os.path.basename(str(getattr(source, "name", ""))) or None
        source = source.read()
        if isinstance(source, str):
            raise TypeError(f'{name or "the file"}: open in text mode; open it with mode "rb"')
    if isinstance(source, (str, os.PathLike)):
        path = os.fsencode(source)
        if b"\0" in path:
            raise ValueError("the name contains a zero byte")
        return _burnish.load(Mesh, path, None, [], _pairs(options))
    if isinstance(source, (bytes, bytearray, memoryview)):
        return _burnish.load(
            Mesh, (name or "memory").removeprefix(":").encode(), source,
            [(key.encode(), content) for key, content in (files or {}).items()], _pairs(options),
        )  # fmt: skip
    if isinstance(source, _burnish.Mesh):
        raise TypeError("it is already a Mesh")
    arrays = _shapes.arrays_of(source, tolerance)
    if name:
        arrays["name"] = name
    return Mesh(**{**arrays, **options})


@overload
def render(
    source: Any, *, name: str | None = None, files: Mapping[str, Any] | None = None, tolerance: float | None = None,
    planes: Words[Plane] = (), K: Any = None, R: Any = None, t: Any = None, cameras: None = None, **options: Unpack[Options],
) -> Image: ...  # fmt: skip
@overload
def render(
    source: Any, *, name: str | None = None, files: Mapping[str, Any] | None = None, tolerance: float | None = None,
    planes: Words[Plane] = (), cameras: Iterable[Any], **options: Unpack[Options],
) -> list[Image]: ...  # fmt: skip
def render(
    source: Any,
    *,
    name: str | None = None,
    files: Mapping[str, Any] | None = None,
    tolerance: float | None = None,
    planes: Words[Plane] = (),
    K: Any = None,
    R: Any = None,
    t: Any = None,
    cameras: Iterable[Any] | None = None,
    **options: Unpack[Options],
) -> Image | list[Image]:
    """Draws what load() loads, or a Mesh. K, R and t are a camera as in Mesh.render().

    cameras  several pictures, as a list: for each one (K, R, t) or a dictionary of options of drawing

    >>> front = burnish.render(":knot", size=48, views="front", lobe="minimax:4", color=(0.8, 0.3, 0.1), no_background=True)
    >>> front.mode, front.shape
    ('RGBA', (48, 48, 4))
    >>> burnish.render(":knot", samples=3)
    Traceback (most recent call last):
    burnish.ArgumentError: samples: ...
    """
    if isinstance(source, Mesh):
        loading, drawing = {}, options
        _check("render", options, "draw", "load() or Mesh()")
    else:
        _check("render", options, None)
        loading = {key: value for key, value in options.items() if "load" in _FLAGS[key]}
        drawing = {key: value for key, value in options.items() if "draw" in _FLAGS[key]}
    drawing = _cameras.join({**drawing}, K, R, t)
    kinds = _kinds(planes)
    shots = [one if isinstance(one, Mapping) else dict(zip("KRt", one)) for one in ([{}] if cameras is None else cameras)]
    pairs = []
    for shot in shots:
        own = {key: value for key, value in shot.items() if key not in ("K", "R", "t")}
        _check("render", own, "draw", "render(), for all cameras,")
        pairs.append(_pairs({**drawing, **_cameras.join(own, shot.get("K"), shot.get("R"), shot.get("t"))}))
        _burnish.check(pairs[-1])
    mesh = source if isinstance(source, Mesh) else load(source, name=name, files=files, tolerance=tolerance, **loading)
    pictures = [mesh._draw(kinds, one) for one in pairs]
    return pictures[0] if cameras is None else pictures


def sheet(pictures: Iterable[Image], columns: int | None = None) -> Image:
    """Pictures of one size as one, in rows.

    >>> burnish.sheet(burnish.render(":knot", size=32, cameras=[{"views": view} for view in ("front", "top", "right")])).shape
    (64, 64, 3)
    """
    items = list(pictures)
    if len({item.shape for item in items}) != 1:
        raise ValueError("pictures: expected one or more of the same size, all with or all without transparency")
    (height, width, channels), columns = items[0].shape, columns or math.ceil(math.sqrt(len(items)))
    blank = bytes([255 if channels == 3 else 0]) * (width * channels)
    pixels = bytearray()
    for first in range(0, len(items), columns):
        row = [memoryview(item).cast("B") for item in items[first : first + columns]]
        for start in range(0, height * len(blank), len(blank)):
            pixels += b"".join(view[start : start + len(blank)] for view in row) + blank * (columns - len(row))
    size = (-(-len(items) // columns) * height, columns * width, channels)
    return _restore(bytes(pixels), size, sum(item.covered_pixels for item in items), {}, {}, ())
