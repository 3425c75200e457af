"""Types of the options of loading and drawing, which are flags of `burnish render`.

Usage: burnish help --json | options.py typescript FILE
       options.py python FOLDER            writes _options.py next to the extension _burnish
"""

import json
import re
import sys

PYTHON = {
    "switch": "bool", "integer": "int", "number": "float", "bytes": "Union[int, str]",
    "size": "Union[int, str, Iterable[int]]", "vector": "Vector", "color": "Color", "number or color": "Union[float, Color]",
    "text": "str", "name": "Union[str, int]",
}  # fmt: skip
TYPESCRIPT = {
    "switch": "boolean", "integer": "number", "number": "number", "bytes": "number | string", "vector": "Vector", "color": "Color",
    "size": "number | readonly [number, number] | string",
    "number or color": "number | Color", "text": "string", "name": "string | number",
}  # fmt: skip

PYTHON_FILE = '''"""The options of loading and drawing: the flags of `burnish render`. Made by bindings/options.py."""

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
{loading}


class _Drawing(TypedDict, total=False):
{drawing}


class Loading(_Loading, total=False):
    """Options of load() and Mesh()."""

{both}


class Drawing(_Drawing, total=False):
    """Options of Mesh.render()."""

{both}


class Options(_Loading, _Drawing, total=False):
    """`burnish render --help` describes each one, and values are the same as there. A list is any iterable. False switches
    something off, and None omits an option."""

{both}
'''

TYPESCRIPT_FILE = '''/** The options of loading and drawing: the flags of `burnish render`. Made by bindings/options.py. */

/** One word, or several: an array, or with commas between them. */
export type Words<Word extends string> = Word | `${{Word}},${{string}}` | readonly Word[];
export type Vector = readonly number[] | string;
/** A name, "#rrggbb", or three numbers in [0, 1]. */
export type Color = string | readonly number[];

export interface LoadFlags {{
{loading}
}}

export interface DrawFlags {{
{drawing}
}}
'''


def words_of(row):
    """The valid words, without those of sheets, which are several pictures."""
    return [word for word in row["words"] or [] if not word.endswith("-angle")]


def python_type(row):
    literal = f"Literal[{', '.join(word if word.isdigit() else json.dumps(word) for word in words_of(row))}]"
    type_ = f"Words[{literal}]" if row["type"] == "words" else literal if row["words"] else PYTHON[row["type"]]
    types = [f"Words[{type_}]" if row["repeats"] else type_]
    if row["optional"] and row["value"] == row["off"]:
        types = [f'Literal["{row["off"]}"]']  # the only value
    if row["type"] == "integer" and row["off"]:
        types.append(f'Literal["{row["off"]}"]')
    if row["optional"]:
        types.insert(0, "bool")
    elif row["off"] or row["repeats"]:
        types.append("Off")
    return types[0] if len(types) == 1 else f"Union[{', '.join(types)}]"


def typescript_type(row):
    literal = " | ".join(word if word.isdigit() else json.dumps(word) for word in words_of(row))
    type_ = f"Words<{literal}>" if row["type"] == "words" else literal or TYPESCRIPT[row["type"]]
    item = f"({type_})" if " | " in type_ else type_
    types = [type_] + ([f"readonly {item}[]"] if row["repeats"] else [])
    if row["optional"] and row["value"] == row["off"]:
        types = [json.dumps(row["off"])]
    if row["type"] == "integer" and row["off"]:
        types.append(json.dumps(row["off"]))
    return " | ".join(types + (["boolean"] if row["optional"] else ["false"] if row["off"] or row["repeats"] else []))


def names_of(row):
    return [row["name"], *row["also"]]


def python_fields(rows):
    return "\n".join(f"    {name.replace('-', '_')}: {python_type(row)}" for row in rows for name in names_of(row))


def typescript_fields(rows):
    lines = []
    for row in rows:
        default = row["default_label"] or row["default"]
        range_ = f", {row['low']:g} to {row['high']:g}" if row["type"] in ("integer", "number") and 0.001 <= row["high"] <= 1e6 else ""
        lines.append(f"  /** {row['help']}{range_}{f' [{default}]' if default else ''} */")
        for name in names_of(row):
            key = re.sub("-(.)", lambda match: match[1].upper(), name)
            lines.append(f"  {key}?: {typescript_type(row)};")
    return "\n".join(lines)


def main(language, path):
    if language == "python":
        sys.path.insert(0, path)
        import _burnish

        rows, fields, text = json.loads(_burnish.flags()), python_fields, PYTHON_FILE
        path += "/_options.py"
    else:  # load() has the threads of the module
        rows = [row for row in json.load(sys.stdin)["options"] if row["name"] != "threads"]
        fields, text = typescript_fields, TYPESCRIPT_FILE
    phases = [{"load", "draw"}.intersection(row["phases"]) for row in rows]
    loading, drawing, both = (
        fields([row for row, found in zip(rows, phases) if found == wanted]) for wanted in ({"load"}, {"draw"}, {"load", "draw"})
    )
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.format(loading=loading, drawing=drawing, both=both))


main(*sys.argv[1:])
