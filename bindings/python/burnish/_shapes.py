"""Conversion of meshes and shapes of other libraries to arrays for Mesh. They are recognized by their attributes; only NumPy is imported."""

from __future__ import annotations

import warnings
from array import array
from collections.abc import Iterable
from typing import Any


def _has_buffer(thing: Any) -> bool:
    try:
        memoryview(thing)
    except (TypeError, ValueError, BufferError):
        return False
    return True


def _coordinates(vector: Any) -> tuple[float, ...]:
    for names in (("x", "y", "z"), ("X", "Y", "Z")):
        if all(hasattr(vector, name) for name in names):
            return tuple(float(getattr(vector, name)) for name in names)
    return tuple(vector)


def _native(values: Any) -> Any:
    """A NumPy array of a type that the extension reads: float16, long double and foreign byte orders are converted."""
    kind, size = values.dtype.kind, values.dtype.itemsize
    if kind == "f" and (size not in (4, 8) or not values.dtype.isnative):
        return values.astype("f8")
    return values if values.dtype.isnative else values.astype(values.dtype.newbyteorder("="))


def numbers(values: Any, typecode: str) -> Any:
    """values itself if it has a buffer, else an array of its rows' numbers."""
    if hasattr(values, "astype") and hasattr(values, "dtype"):
        return _native(values)
    if values is None or _has_buffer(values):
        return values
    if hasattr(values, "__array__") or hasattr(values, "__array_interface__"):
        import numpy

        return _native(numpy.asarray(values))
    rows = [_coordinates(row) if typecode == "f" else tuple(row) for row in values]
    widths = {len(row) for row in rows}
    if len(widths) > 1 and typecode == "I":  # polygons of several sizes
        rows = [(row[0], *pair) for row in rows for pair in zip(row[1:], row[2:])]
        widths = {3}
    if len(widths) > 1 or widths and min(widths) < 2:
        raise ValueError("rows of different lengths; use the same number of values in each row")
    flat = array("q" if typecode == "I" else typecode, (number for row in rows for number in row))
    width = widths.pop() if widths else 3
    return memoryview(flat).cast("B").cast(flat.typecode, (len(rows), width)) if rows else flat


def colors(values: Any) -> Any:
    """Like numbers(), for colours, which can be integers or floats."""
    if values is None or _has_buffer(values) or hasattr(values, "__array__"):
        return numbers(values, "f")
    rows = [tuple(row) for row in values]
    return numbers(rows, "f" if any(isinstance(number, float) for row in rows for number in row) else "q")


def _call(value: Any) -> Any:
    return value() if callable(value) else value


def _size(shape: Any) -> float:
    for name in ("BoundBox", "BoundingBox", "bounding_box"):  # FreeCAD, CadQuery, build123d
        box = _call(getattr(shape, name, None))
        for diagonal in ("DiagonalLength", "diagonal"):
            if hasattr(box, diagonal):
                return float(_call(getattr(box, diagonal)))
    return 100.0


def _tessellate(shapes: Iterable[Any], tolerance: float | None) -> dict[str, Any]:
    vertices: list[Any] = []
    faces: list[Any] = []
    for shape in shapes:
        points, triangles = shape.tessellate(tolerance or _size(shape) / 1000)
        first = len(vertices)
        vertices.extend(points)
        faces.extend(tuple(first + index for index in triangle) for triangle in triangles)
    return {"vertices": vertices, "faces": faces, "up": "+Z"}


def _of_trimesh(mesh: Any) -> dict[str, Any]:
    """Without normals: those of trimesh are generated."""
    arrays = {"vertices": mesh.vertices, "faces": mesh.faces, "up": "auto"}
    visual: Any = getattr(mesh, "visual", None)
    kind = getattr(visual, "kind", None)
    if kind == "vertex":
        arrays["colors"] = visual.vertex_colors
    elif kind == "face":
        import numpy  # which trimesh needs

        corners = numpy.asarray(mesh.vertices)[numpy.asarray(mesh.faces)]
        return {"vertices": corners, "colors": numpy.repeat(numpy.asarray(visual.face_colors), 3, axis=0), "up": "auto"}
    elif kind == "texture":
        warnings.warn('burnish ignores textures of trimesh; load the file, or mesh.export(file_type="glb")', stacklevel=5)
    return arrays


def _of_meshio(mesh: Any) -> dict[str, Any]:
    faces = [mesh.cells_dict[kind] for kind in ("triangle", "quad") if kind in mesh.cells_dict]
    if not faces:
        raise ValueError(f"no triangle or quad in the mesh's cells, which are: {', '.join(mesh.cells_dict) or 'none'}")
    return {"vertices": mesh.points, "faces": faces[0] if len(faces) == 1 else [*faces[0], *faces[1]], "up": "auto"}


def _of_open3d(mesh: Any) -> dict[str, Any]:
    arrays = {"vertices": mesh.vertices, "faces": mesh.triangles, "up": "auto"}
    if _call(getattr(mesh, "has_vertex_normals", False)):
        arrays["normals"] = mesh.vertex_normals
    if _call(getattr(mesh, "has_vertex_colors", False)):
        arrays["colors"] = mesh.vertex_colors
    return arrays


def arrays_of(thing: Any, tolerance: float | None = None) -> dict[str, Any]:
    """The arguments of Mesh for an object of another library."""
    if isinstance(thing, (tuple, list)) and len(thing) == 2:
        return {"vertices": thing[0], "faces": thing[1]}
    if hasattr(thing, "tessellate"):
        return _tessellate([thing], tolerance)
    if hasattr(thing, "vals"):  # CadQuery's Workplane
        return _tessellate(thing.vals(), tolerance)
    if hasattr(thing, "triangles") and hasattr(thing, "vertices"):
        return _of_open3d(thing)
    if hasattr(thing, "geometry") and hasattr(thing, "to_mesh"):  # trimesh's Scene
        return _of_trimesh(thing.to_mesh())
    if hasattr(thing, "vertices") and hasattr(thing, "faces"):
        return _of_trimesh(thing)
    if hasattr(thing, "points") and hasattr(thing, "cells_dict"):  # meshio
        return _of_meshio(thing)
    if hasattr(thing, "points") and hasattr(thing, "regular_faces"):  # PyVista
        return {"vertices": thing.points, "faces": thing.regular_faces, "up": "auto"}
    if hasattr(thing, "vectors"):  # numpy-stl
        return {"vertices": thing.vectors, "up": "auto"}
    if _has_buffer(thing):
        return {"vertices": thing}
    raise TypeError(
        f"{type(thing).__name__}: not a file name, bytes, a mesh or a shape; use (vertices, faces) or an object with these attributes"
    )
