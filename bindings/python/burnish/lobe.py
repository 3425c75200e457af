"""Specular lobes: values, facts and choice, like ``burnish lobe``.

Lobes have the same names: "energy:2", "minimax:4", "power", "schlick" ...; words() lists an example of each kind.
"""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Sequence
from typing import Any

from . import _burnish, _shapes

__all__ = ["choose", "exact", "table", "values", "words"]


def values(lobe: str, exponent: float, cosines: Any) -> memoryview:
    """The lobe at cosines, in single precision: the same bits as in pictures.

    >>> [round(value, 4) for value in burnish.lobe.values("energy:2", 32, [1.0, 0.99, 0.9, 0.5])]
    [1.0, 0.7921, 0.0, 0.0]
    """
    has_buffer = _shapes._has_buffer(cosines)
    return _burnish.lobe_values(lobe, exponent, cosines if has_buffer else array("f", cosines))


def exact(lobe: str, exponent: float, angles: Sequence[float]) -> memoryview:
    """The lobe at angles in radians, in double precision.

    >>> burnish.lobe.exact("power", 2, [0.0, 3.141592653589793 / 4]).tolist()
    [1.0, 0.5]
    """
    return _burnish.lobe_exact(lobe, exponent, angles)


def table(
    lobes: str | Iterable[str], exponents: float | Iterable[float], metrics: str | Iterable[str] = "all"
) -> list[dict[str, Any]]:
    """A row for every lobe and exponent, like `burnish lobe table`. Angles are in degrees.

    >>> rows = burnish.lobe.table(["energy:2", "schlick"], [10, 100], "zeta,max-error")
    >>> rows[0]["zeta"], round(rows[0]["max_error"], 4)
    (3.6666666666666665, 0.0698)
    """
    lobes = [lobes] if isinstance(lobes, str) else list(lobes)
    exponents = list(exponents) if isinstance(exponents, Iterable) else [exponents]
    names = metrics.split(",") if isinstance(metrics, str) else list(metrics)
    return [
        {"lobe": lobe, "exponent": float(exponent), **_burnish.lobe_row(lobe, exponent, names)}
        for exponent in exponents
        for lobe in lobes
    ]


def choose(exponent: float, epsilon: float, *, affine: bool = False) -> dict[str, Any]:
    """The cheapest lobe whose maximum distance from cos^n is epsilon; affine: also lobes with a peak below 1.

    >>> burnish.lobe.choose(100, 0.02)["lobe"]
    'minimax:8'
    """
    return _burnish.lobe_choose(exponent, epsilon, affine)


def words() -> list[str]:
    """An example of each kind of lobe.

    >>> "minimax:8" in burnish.lobe.words()
    True
    """
    return _burnish.lobe_words()
