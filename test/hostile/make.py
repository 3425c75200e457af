#!/usr/bin/env python3
"""Writes files of less than 1 MB that become large: one of each kind of thing that a format can repeat.

Usage: test/hostile/make.py FOLDER [NAME...]        without names: all of them
Each line of output is a file, the exit code that `burnish render` ends with, and flags that suit it.
"""
import gzip
import io
import json
import os
import random
import struct
import sys
import zipfile
import zlib

MIB = 1 << 20
LARGEST = 5792  # its square is just below 2^25
TRIANGLE = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width, height, depth=8, kind=0, rows=None, interlaced=0, end=True):
    """Of one colour, where `rows` are not given. kind: 0 grey, 2 RGB, 6 RGBA"""
    row = 1 + width * {0: 1, 2: 3, 6: 4}[kind] * depth // 8
    if rows is None:
        packer = zlib.compressobj(9)
        count = row * height * 9 // 8 if interlaced else row * height
        parts = [packer.compress(bytes(min(MIB, count - i))) for i in range(0, count, MIB)]
        data = b"".join(parts) + packer.flush()
    else:
        data = zlib.compress(rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, interlaced)) +
            chunk(b"IDAT", data) + (chunk(b"IEND", b"") if end else chunk(b"IDAT", b"\0") + chunk(b"IEND", b"")))


def tga(side):
    """In runs of 128 grey pixels."""
    return (struct.pack("<BBBHHBHHHHBB", 0, 0, 11, 0, 0, 0, 0, 0, side, side, 8, 0) + b"\xff\x80" * (side * side // 128))


# ---- glTF ----

def accessor(view, count, kind="VEC3", component=5126):
    return {"bufferView": view, "componentType": component, "count": count, "type": kind}


def zeros(count):
    """An accessor without bytes."""
    return {"componentType": 5126, "count": count, "type": "VEC3"}


def glb(parts, accessors, primitives=({"attributes": {"POSITION": 0}},), mesh=None, **more):
    """A mesh of primitives in one buffer of all parts, with a view of each, and whatever the scene has besides."""
    data, listed = b"", []
    for part in parts:
        listed.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
        data += part + bytes(-len(part) % 4)
    scene = {"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "meshes": [{"primitives": primitives, **(mesh or {})}],
             "accessors": accessors, "buffers": [{"byteLength": len(data)}], "bufferViews": listed, **more}
    scene |= {"scene": 0, "scenes": [{"nodes": list(range(len(scene["nodes"])))}]}
    text = json.dumps(scene, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def listed(**more):
    """A triangle and long lists."""
    return glb([TRIANGLE], [accessor(0, 3)], **more)


def cloud(count):
    rng = random.Random(1)
    return struct.pack("<%df" % (3 * count), *(rng.random() for _ in range(3 * count)))


def instanced(count):
    node = {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}}
    return glb([TRIANGLE], [accessor(0, 3), zeros(count)], nodes=[node], extensionsUsed=["EXT_mesh_gpu_instancing"])


def morphed(count, targets, nodes):
    return glb([cloud(count)], [accessor(0, count)], [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}] * targets}],
               {"weights": [1] * targets}, nodes=[{"mesh": 0}] * nodes)


def skinned(count, joints, nodes):
    return glb([cloud(count), bytes(4 * count), struct.pack("<4f", 1, 0, 0, 0) * count],
               [accessor(0, count), accessor(1, count, "VEC4", 5121), accessor(2, count, "VEC4")],
               [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}], skins=[{"joints": [0] * joints}] * nodes,
               nodes=[{"mesh": 0, "skin": i} for i in range(nodes)])


def sparse(count, times):
    return glb([TRIANGLE], [accessor(0, 3)] + [zeros(count)] * times, [{"attributes": {"POSITION": 1 + i}} for i in range(times)])


def meshopt(count, times):
    """Compressed views of zeros: a bit or so for each group of vertices."""
    packed = b"\xa0" + bytes(12 * sum(((min(256, count - i) + 15) // 16 + 3) // 4 for i in range(0, count, 256))) + bytes(32)
    view = {"buffer": 0, "byteLength": 0, "extensions": {"EXT_meshopt_compression": {
        "buffer": 0, "byteLength": len(packed), "byteStride": 12, "count": count, "mode": "ATTRIBUTES"}}}
    return glb([packed], [accessor(i, count) for i in range(times)], [{"attributes": {"POSITION": i}} for i in range(times)],
               bufferViews=[view] * times, extensionsUsed=["EXT_meshopt_compression"])


def textured(picture, uses=1, modes=("OPAQUE", "BLEND", "MASK")):
    """A triangle for each use of a picture in each mode: as its colour, its metal and its normals."""
    materials = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": i}, "metallicRoughnessTexture": {"index": i}},
                  "normalTexture": {"index": i}, "alphaMode": mode} for i in range(uses) for mode in modes]
    return glb([TRIANGLE, struct.pack("<6f", 0, 0, 1, 0, 0, 1), picture], [accessor(0, 3), accessor(1, 3, "VEC2")],
               [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": i} for i in range(len(materials))],
               images=[{"bufferView": 2, "mimeType": "image/png"}] * uses,
               textures=[{"source": i} for i in range(uses)], materials=materials)


# ---- 3MF and text, and what gzip makes of it ----

def threemf(items=1, blanks=0):
    """A sheet of 8,192 triangles in many places."""
    vertices = "".join('<vertex x="%d" y="%d" z="0"/>' % (i % 65, i // 65) for i in range(65 * 65))
    corners = [65 * y + x for y in range(64) for x in range(64)]
    triangles = "".join('<triangle v1="%d" v2="%d" v3="%d"/><triangle v1="%d" v2="%d" v3="%d"/>' % (a, a + 1, a + 66, a, a + 66, a + 65) for a in corners)
    places = "".join('<item objectid="1" transform="1 0 0 0 1 0 0 0 1 %d %d 0"/>' % (i % 40 * 64, i // 40 * 64) for i in range(items))
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("_rels/.rels", '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship '
                         'Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
        archive.writestr("3D/3dmodel.model", '<model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1"><mesh>'
                         f"<vertices>{vertices}</vertices><triangles>{triangles}</triangles></mesh></object></resources><build>{places}</build></model>" + " " * blanks)
    return out.getvalue()


FOUR = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"


def packed(data):
    return gzip.compress(data, 9, mtime=0)


def random_polygon(count):
    rng = random.Random(4)
    return ("".join("v %.3f %.3f %.3f\n" % (rng.random(), rng.random(), rng.random()) for _ in range(count)) +
            "f " + " ".join(map(str, range(1, count + 1))) + "\n").encode()


def random_faces(points, different, count):
    """Faces that are repeated; far fewer are different."""
    rng = random.Random(6)
    vertices = "".join("v %d %d %d\n" % tuple(rng.randrange(99) for _ in "xyz") for _ in range(points))
    faces = "".join("f %d %d %d\n" % tuple(rng.sample(range(1, points + 1), 3)) for _ in range(different))
    return (vertices + faces * (count // different)).encode()


def obj_with(pictures, count, textures):
    """A triangle for each of `count` materials, which name these textures in turn; and the pictures' files."""
    library = "".join("newmtl m%d\nmap_Kd %s\n" % (i, textures(i)) for i in range(count))
    faces = "".join("usemtl m%d\nf 1/1 2/2 3/3\n" % i for i in range(count))
    return {"a.obj": ("mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n" + faces).encode(), "a.mtl": library.encode()[:900000], **pictures}


CASES = {
    "wide.glb": (lambda: textured(png(400000000, 1, 16, 6, bytes(9))), "", 0),
    "flat.glb": (lambda: textured(png(LARGEST, LARGEST)), "", 0),
    "flat-interlaced.glb": (lambda: textured(png(LARGEST, LARGEST, 16, 6, interlaced=1), modes=("OPAQUE",)), "", 0),
    "flat-512.glb": (lambda: textured(png(512, 512), 127, ("OPAQUE",)), "", 0),
    "damaged.glb": (lambda: textured(png(LARGEST, LARGEST, end=False), 400, ("OPAQUE",)), "", 0),
    "runs": (lambda: obj_with({"runs.tga": tga(5120)}, 1, lambda i: "runs.tga"), "", 0),
    "named-4000": (lambda: obj_with({"t.png": png(2048, 2048)}, 4000, lambda i: "t.png"), "--max-overdraw=2000", 0),
    "named-2000-aliases": (lambda: obj_with({"t.png": png(2048, 2048)}, 2000, lambda i: "./" * (i % 900) + "t.png"), "", 0),
    "instanced.glb": (lambda: instanced(20000000), "", 5),
    "morphed.glb": (lambda: morphed(30000, 500, 1), "", 0),
    "morphed-nodes.glb": (lambda: morphed(3000, 500, 500), "", 5),
    "skinned.glb": (lambda: skinned(30, 10000, 30), "", 0),
    "sparse.glb": (lambda: sparse(2000000, 20), "", 5),
    "meshopt.glb": (lambda: meshopt(2500000, 8), "", 5),
    "materials-65000.glb": (lambda: listed(materials=[{}] * 65000), "", 0),
    "materials-300000.glb": (lambda: listed(materials=[{}] * 300000), "", 5),
    "nodes-55000.glb": (lambda: listed(nodes=[{"mesh": 0}] * 55000), "", 5),
    "nested-900000.gltf": (lambda: b"[" * 900000, "", 5),
    "items.3mf": (lambda: threemf(1600), "", 5),
    "blanks.3mf": (lambda: threemf(blanks=60 * MIB), "", 0),
    "blanks-more.3mf": (lambda: threemf(blanks=80 * MIB), "", 5),
    "polygon-25000.obj": (lambda: random_polygon(25000), "", 0),
    "points.obj": (lambda: b"v 0 0 0\nv 1 0 0\n" + b"v 1 1 1\n" * 120000, "", 0),
    "fan.obj.gz": (lambda: packed(FOUR + b"f " + b"1 2 3 4 " * 5000000), "", 5),
    "both-sides.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\nf 1 3 2\n" * 690000), "", 5),
    "around-30.obj.gz": (lambda: packed(random_faces(30, 2000, 1390000)), "", 5),
    "points.obj.gz": (lambda: packed(b"v 0 0 0\n" + b"v 1 1 1\np -1\n" * 3000000), "", 5),
    "lines.obj.gz": (lambda: packed(FOUR + b"l" + b" 1 2" * 10000000), "", 5),
    "vertices.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\n" + b"v 1 1 1\n" * 550000), "", 0),
    "materials.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\n" + b"usemtl a\nusemtl b\n" * 3000000), "", 0),
    "groups.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\n" + b"g a\no b\ns 1\n" * 3000000), "", 0),
    "cloud.ply.gz": (lambda: packed(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty char x\nproperty char y\nproperty char z\nend_header\n" %
                                    (13 * MIB) + bytes(i % 5 for i in range(375)) * (13 * MIB * 3 // 375 + 1)), "", 5),
    "binary.stl.gz": (lambda: packed(bytes(80) + struct.pack("<I", 1320000) + (bytes(12) + TRIANGLE + bytes(2)) * 1320000), "", 5),
    "lists.gltf.gz": (lambda: packed(b'{"asset":{"version":"2.0"},"extras":[' + b"[]," * 20000000 + b"[]]}"), "", 4),
    "too-much.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\n" + b" " * (80 * MIB)), "", 5),
}

for name in sys.argv[2:] or CASES:
    make, flags, code = CASES[name]
    content = make()
    parts = content if isinstance(content, dict) else {name: content}
    folder = os.path.join(sys.argv[1], name) if parts is content else sys.argv[1]
    os.makedirs(folder, exist_ok=True)
    for part, data in parts.items():
        with open(os.path.join(folder, part), "wb") as file:
            file.write(data)
    print(os.path.join(folder, next(iter(parts))), code, flags, flush=True)
