"""The options of loading and drawing: the flags of `burnish render`. A test compares names and words with the program's."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal, TypedDict, TypeVar, Union

__all__ = ["Drawing", "Loading", "Options"]

_T = TypeVar("_T")
Words = Union[_T, Iterable[_T]]
Vector = Union[str, Iterable[float]]
Color = Union[str, Iterable[float]]
Off = Literal[False]
Plane = Literal["depth", "normal", "triangle", "coverage"]


class _Loading(TypedDict, total=False):
    input_format: Literal["auto", "gltf", "obj", "off", "ply", "stl", "3mf", "bms"]
    up: Literal["+Y", "-Y", "+Z", "-Z", "+X", "-X", "auto", "format"]
    clip: Union[Vector, Iterable[Vector], Off]
    color_by: str
    color_map: Literal["viridis", "coolwarm", "grey"]
    color_range: str
    normals: Literal["auto", "file", "own"]
    crease_angle: float
    tessellation: int
    animation_time: float
    animation: Union[str, int]
    point_size: float
    strict: bool
    no_textures: bool
    no_libraries: bool
    max_triangles: int
    max_texture_pixels: int
    max_input_bytes: Union[int, str]


class _Drawing(TypedDict, total=False):
    resolution: Union[str, Iterable[int]]
    size: Union[int, str, Iterable[int]]
    width: int
    height: int
    cull_back_faces: bool
    samples: Literal[1, 4, 8, 16]
    background_color: Union[Color, Off]
    background: Union[Color, Off]
    no_background: bool
    no_legend: bool
    views: Words[Literal["front", "right", "top", "iso", "back", "left", "bottom"]]
    annotate: Union[Words[Literal["axes", "box", "dimensions", "scale", "grid", "none"]], Off]
    camera_direction: Vector
    azimuth: float
    camera_azimuth_angle: float
    elevation: float
    camera_elevation_angle: float
    camera: Union[str, int]
    camera_position: Vector
    camera_focal_point: Vector
    camera_view_up: Vector
    camera_view_angle: float
    zoom: float
    camera_zoom_factor: float
    camera_orthographic: Union[bool, Literal["no"]]
    camera_orthographic_height: float
    margin: float
    look: Literal["studio", "three-point", "plain", "clay", "technical", "drawing", "lobes"]
    color: Color
    no_colors: bool
    material: Literal["matte", "satin", "plastic", "polished", "metal"]
    opacity: float
    specular: float
    exponent: float
    lobe: Words[str]
    equation: Literal["blinn", "phong"]
    viewer: Literal["local", "distant"]
    light: Union[Words[str], Off]
    environment: str
    environment_strength: float
    environment_turn: float
    ambient: Union[float, Color]
    occlusion: Union[int, Literal["none"], Off]
    ground: bool
    shadow: bool
    edges: Union[bool, Words[Literal["silhouettes", "creases", "boundaries", "materials", "none"]]]
    wireframe: bool
    hidden_lines: bool
    center_lines: bool
    edge_width: float
    edge_color: Color
    outline_contrast: int
    max_overdraw: float
    isa: str


class Loading(_Loading, total=False):
    """Options of load() and Mesh()."""

    threads: int


class Drawing(_Drawing, total=False):
    """Options of Mesh.render()."""

    threads: int


class Options(_Loading, _Drawing, total=False):
    """`burnish render --help` describes each one, and values are the same as there. A list is any iterable. False switches
    something off, and None omits an option."""

    threads: int
