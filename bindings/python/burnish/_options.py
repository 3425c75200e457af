"""The options of loading and drawing: the flags of `burnish render`. A test compares the names with the program's."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypedDict, Union

try:
    from typing import Unpack
except ImportError:  # Python has it from 3.11 on, as the extension
    from typing_extensions import Unpack

__all__ = ["Options", "Unpack"]

Vector = Union[str, Sequence[float]]
Color = Union[str, Sequence[float]]
Switch = bool


class Options(TypedDict, total=False):
    """`burnish render --help` describes each one. Values are the same as there; lists can be tuples. False and None
    omit an option. Options of loading come first, then options of drawing."""

    input_format: str
    up: str
    clip: Union[Vector, Sequence[str]]
    color_by: str
    color_map: str
    color_range: str
    normals: str
    crease_angle: float
    tessellation: int
    animation_time: float
    animation: Union[str, int]
    point_size: float
    strict: Switch
    no_textures: Switch
    no_libraries: Switch
    max_triangles: int
    max_texture_pixels: int
    max_input_bytes: Union[int, str]

    resolution: Union[str, tuple[int, int]]
    size: int
    cull_back_faces: Switch
    samples: int
    background_color: Color
    no_background: Switch
    no_legend: Switch
    views: str
    annotate: Union[str, bool]
    camera_direction: Vector
    azimuth: float
    elevation: float
    camera: Union[str, int]
    camera_position: Vector
    camera_focal_point: Vector
    camera_view_up: Vector
    camera_view_angle: float
    zoom: float
    camera_orthographic: Union[bool, str]
    camera_orthographic_height: float
    margin: float
    look: str
    color: Color
    no_colors: Switch
    material: str
    opacity: float
    specular: float
    exponent: float
    lobe: str
    equation: str
    viewer: str
    light: Union[str, Sequence[str]]
    environment: str
    environment_strength: float
    environment_turn: float
    ambient: Union[float, str]
    occlusion: Union[int, str, bool]
    ground: Switch
    shadow: Switch
    edges: Union[str, bool]
    wireframe: Switch
    hidden_lines: Switch
    center_lines: Switch
    edge_width: float
    edge_color: Color
    outline_contrast: int
    max_overdraw: float
    isa: str
    threads: int
