"""Camera matrices as options of drawing."""

from __future__ import annotations

from typing import Any


def _rows(matrix: Any) -> list[list[float]]:
    return [[float(number) for number in row] for row in matrix]


def _dot(a: list[float], b: list[float]) -> float:
    return sum(x * y for x, y in zip(a, b))


def options_of(K: Any, R: Any, t: Any) -> dict[str, Any]:
    """A camera as in OpenCV: a point p is at K (R p + t) in the picture. Nothing without any of them."""
    if K is None and R is None and t is None:
        return {}
    if K is None or R is None or t is None:
        raise TypeError("K, R and t belong together; give all of them")
    k, r = _rows(K), _rows(R)
    move = [float(number) for item in t for number in (item if hasattr(item, "__iter__") else [item])]
    if [len(row) for row in (*k, *r, move)] != [3] * 7:
        raise ValueError("expected K of 3 x 3 numbers, R of 3 x 3 and t of 3")
    if k != [[k[0][0], 0, k[0][2]], [0, k[1][1], k[1][2]], [0, 0, 1]]:
        raise ValueError("K: expected [[fx, 0, cx], [0, fy, cy], [0, 0, 1]]")
    right, down, forward = r
    cross = [right[i - 2] * down[i - 1] - right[i - 1] * down[i - 2] for i in range(3)]
    errors = [a - b for a, b in zip(cross, forward)] + [_dot(right, right) - 1, _dot(down, down) - 1, _dot(right, down)]
    if not all(abs(error) < 1e-4 for error in errors):
        raise ValueError("R: not a rotation; its rows are the directions right, down and forward, of length 1")
    position = [-_dot(list(column), move) for column in zip(*r)]
    reach = 1 + max(abs(at) for at in position)  # a focal point as far keeps the digits of the direction
    return {
        "camera_intrinsics": (k[0][0], k[1][1], k[0][2], k[1][2]),
        "camera_position": position,
        "camera_focal_point": [at + reach * axis for at, axis in zip(position, forward)],
        "camera_view_up": [-axis for axis in down],
    }


def join(options: dict[str, Any], K: Any, R: Any, t: Any) -> dict[str, Any]:
    """Options with the camera of K, R and t, which have no other one."""
    camera = options_of(K, R, t)
    for name in camera:
        if options.get(name) is not None:
            raise TypeError(f"{name}: K, R and t set the camera; omit one of them")
    return {**options, **camera}
