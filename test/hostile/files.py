"""Files that are small and become large: what each format can repeat, and what stays just below its limit.

FILES: name -> (function that returns the bytes, or a dictionary of files of which the first is the input; flags; exit code).
"""
import base64
import gzip
import io
import json
import random
import struct
import zipfile
import zlib

MIB = 1 << 20
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


def bits(text):
    text += "1" * (-len(text) % 8)
    data = bytes(int(text[i:i + 8], 2) for i in range(0, len(text), 8))
    return data.replace(b"\xff", b"\xff\0")


def jpeg(side, scans):
    """Progressive and grey: a bit for a block, then scans of a few bytes that go over all of them."""
    def segment(mark, data):
        return bytes((0xFF, mark)) + struct.pack(">H", len(data) + 2) + data

    def table(number, symbol):
        return segment(0xC4, bytes((number, 1)) + bytes(15) + bytes((symbol,)))

    blocks = ((side + 7) // 8) ** 2
    runs = "0" + "1" * 14  # a run of 2^15 - 1 blocks without anything
    out = [b"\xff\xd8", segment(0xDB, b"\0" + b"\1" * 64),
           segment(0xC2, struct.pack(">BHHBBBB", 8, side, side, 1, 1, 0x11, 0)), table(0x00, 0), table(0x10, 0xE0),
           segment(0xDA, bytes((1, 1, 0, 0, 0, 0))), bits("0" * blocks)]
    for scan in range(1, scans):
        out += [segment(0xDA, bytes((1, 1, 0, scan, scan, 0))), bits(runs * (blocks // 32767) + "0" + "0" * 14)]
    return b"".join(out) + b"\xff\xd9"


def tga(side):
    """In runs of 128 grey pixels."""
    return (struct.pack("<BBBHHBHHHHBB", 0, 0, 11, 0, 0, 0, 0, 0, side, side, 8, 0) + b"\xff\x80" * (side * side // 128))


# ---- glTF ----

def glb(scene, data):
    text = json.dumps(scene, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data += bytes(-len(data) % 4)
    body = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


def scene(**more):
    return dict({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}]}, **more)


def views(*parts):
    """One buffer of all parts: its bytes, and a view of each."""
    data, listed = b"", []
    for part in parts:
        listed.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
        data += part + bytes(-len(part) % 4)
    return data, {"buffers": [{"byteLength": len(data)}], "bufferViews": listed}


def accessor(view, count, kind="VEC3", component=5126, **more):
    return dict({"bufferView": view, "componentType": component, "count": count, "type": kind}, **more)


def cloud(count, seed=1):
    rng = random.Random(seed)
    return struct.pack("<%df" % (3 * count), *(rng.random() for _ in range(3 * count)))


def shared(mode, count, times):
    """Primitives that draw the same vertices again and again."""
    data, lists = views(cloud(count))
    return glb(scene(meshes=[{"primitives": [{"mode": mode, "attributes": {"POSITION": 0}}] * times}],
                     accessors=[accessor(0, count)], **lists), data)


def grid(side):
    """A sheet of side * side quads with an index of 32 bits."""
    n = side + 1
    positions = b"".join(struct.pack("<3f", x / side, y / side, 0) for y in range(n) for x in range(n))
    corners = []
    for y in range(side):
        for x in range(side):
            a = y * n + x
            corners += [a, a + 1, a + n + 1, a, a + n + 1, a + n]
    return positions, struct.pack("<%dI" % len(corners), *corners), n * n, len(corners)


def forest(side, across):
    """Sheets next to one another: none covers another."""
    positions, corners, vertices, count = grid(side)
    data, lists = views(positions, corners)
    nodes = [{"mesh": 0, "translation": [x, y, 0]} for y in range(across) for x in range(across)]
    return glb(dict(scene(meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                          accessors=[accessor(0, vertices), accessor(1, count, "SCALAR", 5125)], **lists),
                    nodes=nodes, scenes=[{"nodes": list(range(len(nodes)))}]), data)


def instanced(count):
    """EXT_mesh_gpu_instancing by an accessor of zeros, which takes no bytes."""
    data, lists = views(TRIANGLE)
    node = {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 1}}}}
    return glb(dict(scene(meshes=[{"primitives": [{"attributes": {"POSITION": 0}}]}],
                          accessors=[accessor(0, 3), {"componentType": 5126, "count": count, "type": "VEC3"}], **lists),
                    nodes=[node], extensionsUsed=["EXT_mesh_gpu_instancing"]), data)


def morphed(count, targets, nodes):
    data, lists = views(cloud(count))
    mesh = {"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}] * targets}], "weights": [1] * targets}
    return glb(dict(scene(meshes=[mesh], accessors=[accessor(0, count)], **lists), nodes=[{"mesh": 0}] * nodes,
                    scenes=[{"nodes": list(range(nodes))}]), data)


def skinned(count, joints, nodes):
    data, lists = views(cloud(count), bytes(4 * count), struct.pack("<4f", 1, 0, 0, 0) * count)
    mesh = {"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}}]}
    return glb(dict(scene(meshes=[mesh], skins=[{"joints": [0] * joints}] * nodes,
                          accessors=[accessor(0, count), accessor(1, count, "VEC4", 5121), accessor(2, count, "VEC4")], **lists),
                    nodes=[{"mesh": 0, "skin": i} for i in range(nodes)], scenes=[{"nodes": list(range(nodes))}]), data)


def sparse(count, times):
    """Accessors without bytes, which are zeros."""
    empty = {"componentType": 5126, "count": count, "type": "VEC3"}
    data, lists = views(TRIANGLE)
    primitives = [{"attributes": {"POSITION": 1 + i}} for i in range(times)]
    return glb(scene(meshes=[{"primitives": primitives}], accessors=[accessor(0, 3)] + [empty] * times, **lists), data)


def meshopt(count, times):
    """Compressed views of zeros: a bit or so for each group of vertices."""
    size = 12
    block = min(256, 8192 // size & ~15)
    groups = 0
    for i in range(0, count, block):
        n = min(block, count - i)
        groups += size * (((n + 15) // 16 + 3) // 4)
    packed = b"\xa0" + bytes(groups) + bytes(32)
    data, lists = views(packed)
    lists["bufferViews"] = [{"buffer": 0, "byteLength": 0, "extensions": {"EXT_meshopt_compression": {
        "buffer": 0, "byteLength": len(packed), "byteStride": size, "count": count, "mode": "ATTRIBUTES"}}}] * times
    return glb(scene(meshes=[{"primitives": [{"attributes": {"POSITION": i}} for i in range(times)]}],
                     accessors=[accessor(i, count) for i in range(times)], extensionsUsed=["EXT_meshopt_compression"], **lists), data)


def in_base64(count):
    """The same bytes as data URIs."""
    uri = "data:;base64," + base64.b64encode(TRIANGLE).decode()
    return json.dumps(scene(
        meshes=[{"primitives": [{"attributes": {"POSITION": i}} for i in range(count)]}],
        buffers=[{"byteLength": 36, "uri": uri}] * count, bufferViews=[{"buffer": i, "byteLength": 36} for i in range(count)],
        accessors=[accessor(i, 3) for i in range(count)]), separators=(",", ":")).encode()


def listed(**more):
    """A triangle and long lists."""
    data, lists = views(TRIANGLE)
    return glb(dict(scene(meshes=[{"primitives": [{"attributes": {"POSITION": 0}}]}], accessors=[accessor(0, 3)], **lists), **more), data)


def lit(count):
    nodes = [{"mesh": 0}] + [{"extensions": {"KHR_lights_punctual": {"light": 0}}}] * count
    return listed(nodes=nodes, scenes=[{"nodes": list(range(count + 1))}],
                  extensions={"KHR_lights_punctual": {"lights": [{"type": "point"}]}})


def animated(count):
    data, lists = views(TRIANGLE, struct.pack("<%df" % count, *range(count)), bytes(12 * count))
    channel = {"sampler": 0, "target": {"node": 0, "path": "translation"}}
    return glb(scene(meshes=[{"primitives": [{"attributes": {"POSITION": 0}}]}],
                     accessors=[accessor(0, 3), accessor(1, count, "SCALAR"), accessor(2, count)],
                     animations=[{"samplers": [{"input": 1, "output": 2}], "channels": [channel] * (4 * count)}], **lists), data)


def textured(pictures, maps=("color",), modes=("OPAQUE",), uses=1):
    """A triangle for each picture, which is its colour, its metal or its normals."""
    coordinates = struct.pack("<6f", 0, 0, 1, 0, 0, 1)
    data, lists = views(TRIANGLE, coordinates, *pictures)
    materials = []
    for i in range(len(pictures) * uses * len(modes)):
        use = {"index": i // len(modes)}
        material = {"pbrMetallicRoughness": {}, "alphaMode": modes[i % len(modes)]}
        if "color" in maps:
            material["pbrMetallicRoughness"]["baseColorTexture"] = use
        if "metal" in maps:
            material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = use
        if "normal" in maps:
            material["normalTexture"] = use
        materials.append(material)
    kinds = {b"\xff\xd8": "image/jpeg"}
    images = [{"bufferView": 2 + i % len(pictures), "mimeType": kinds.get(pictures[i % len(pictures)][:2], "image/png")}
              for i in range(len(pictures) * uses)]
    return glb(scene(meshes=[{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": i}
                                             for i in range(len(materials))]}],
                     accessors=[accessor(0, 3), accessor(1, 3, "VEC2")], images=images,
                     textures=[{"source": i} for i in range(len(images))], materials=materials, **lists), data)


# ---- 3MF ----

def threemf(model, more=()):
    relations = ('<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship '
                 'Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("_rels/.rels", relations)
        archive.writestr("3D/3dmodel.model", model)
    return out.getvalue()


def model(resources, items):
    return ('<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>' + resources +
            "</resources><build>" + items + "</build></model>")


def part(side):
    """An object of 2 * side * side triangles."""
    n = side + 1
    vertices = "".join('<vertex x="%d" y="%d" z="0"/>' % (x, y) for y in range(n) for x in range(n))
    triangles = "".join('<triangle v1="%d" v2="%d" v3="%d"/><triangle v1="%d" v2="%d" v3="%d"/>' %
                        (a, a + 1, a + n + 1, a, a + n + 1, a + n) for y in range(side) for a in range(y * n, y * n + side))
    return '<object id="1"><mesh><vertices>%s</vertices><triangles>%s</triangles></mesh></object>' % (vertices, triangles)


def items(side, across):
    places = "".join('<item objectid="1" transform="1 0 0 0 1 0 0 0 1 %d %d 0"/>' % (x * side, y * side)
                     for y in range(across) for x in range(across))
    return threemf(model(part(side), places))


def nested(depth):
    """Objects that hold the one before twice."""
    objects = "".join('<object id="%d"><components><component objectid="%d"/><component objectid="%d"/></components></object>' %
                      (i, i - 1, i - 1) for i in range(2, depth + 2))
    return threemf(model(part(4) + objects, '<item objectid="%d"/>' % (depth + 1)))


# ---- Text, and what gzip makes of it ----

def packed(data):
    return gzip.compress(data, 9, mtime=0)


def nested_gzip(size):
    """A ZIP whose part is gzip: of one member that is stored, so the part is not small, and of one that unpacks to `size`."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.obj", gzip.compress(FOUR + b"f 1 2 3\n" + b" " * (2 * MIB), 0, mtime=0) + packed(b" " * size))
    return out.getvalue()


def ply(vertices, body, properties="xyz", kind="char", face=None, encoding="binary_little_endian"):
    head = "ply\nformat %s 1.0\nelement vertex %d\n" % (encoding, vertices)
    head += "".join("property %s %s\n" % (kind, name) for name in properties)
    if face:
        head += face
    return (head + "end_header\n").encode() + body


def strips(count):
    """One strip of so many corners, a byte each."""
    return ply(4, bytes([0, 0, 0, 9, 0, 0, 0, 9, 0, 9, 9, 9]) + struct.pack("<I", count) + bytes([0, 1, 2, 3]) * (count // 4),
               face="element tristrips 1\nproperty list uint uchar vertex_indices\n")


def polygons(count, corners):
    body = bytes([0, 0, 0, 9, 0, 0, 0, 9, 0, 9, 9, 9]) + (bytes([corners]) + (bytes([0, 1, 2, 3]) * 64)[:corners]) * count
    return ply(4, body, face="element face %d\nproperty list uchar uchar vertex_indices\n" % count)


FOUR = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"


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


def binary_stl(count):
    facet = struct.pack("<12fH", 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    return bytes(80) + struct.pack("<I", count) + facet * count


ASCII_FACET = b"facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"


def named_textures(count, alias):
    """A picture by many names."""
    library = "".join("newmtl m%d\nmap_Kd %st.png\n" % (i, alias * (i % 900)) for i in range(count))
    faces = "".join("usemtl m%d\nf 1/1 2/2 3/3\n" % i for i in range(count))
    name = "named-%d%s" % (count, "-aliases" if alias else "")
    return {name + ".obj": ("mtllib %s.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n" % name + faces).encode(),
            name + ".mtl": library.encode()[:900000], "t.png": png(2048, 2048)}


def wide_texture():
    return {"wide.obj": b"mtllib wide.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n",
            "wide.mtl": b"newmtl m\nmap_Kd wide.png\n", "wide.png": WIDE}


WIDE = png(400000000, 1, 16, 6, bytes(9))
LARGEST = 5792  # its square is just below 2^25

FILES = {
    # pictures
    "wide-png.glb": (lambda: textured([WIDE]), "", 0),
    "wide.obj": (wide_texture, "", 0),
    "flat.glb": (lambda: textured([png(LARGEST, LARGEST)]), "", 0),
    "flat-blend.glb": (lambda: textured([png(LARGEST, LARGEST)], modes=("BLEND",)), "", 0),
    "flat-mask.glb": (lambda: textured([png(LARGEST, LARGEST)], modes=("MASK",)), "", 0),
    "flat-16-bits.glb": (lambda: textured([png(LARGEST, LARGEST, 16, 6)]), "", 0),
    "flat-interlaced.glb": (lambda: textured([png(LARGEST, LARGEST, 8, 6, interlaced=1)]), "", 0),
    "flat-all-maps.glb": (lambda: textured([png(LARGEST, LARGEST)], ("color", "metal", "normal")), "", 0),
    "flat-all-modes.glb": (lambda: textured([png(LARGEST, LARGEST)], modes=("OPAQUE", "BLEND", "MASK")), "", 0),
    "flat-twice-as-large.glb": (lambda: textured([png(16384, 4096)]), "", 0),
    "flat-512.glb": (lambda: textured([png(512, 512)] * 127, ("color", "metal", "normal")), "", 0),
    "damaged.glb": (lambda: textured([png(LARGEST, LARGEST, end=False)], uses=400), "", 0),
    "scans.glb": (lambda: textured([jpeg(LARGEST, 16)]), "", 0),
    "scans-60.glb": (lambda: textured([jpeg(LARGEST, 60)]), "", 0),
    "runs.obj": (lambda: {"runs.obj": b"mtllib runs.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n",
                          "runs.mtl": b"newmtl m\nmap_Kd runs.tga\n", "runs.tga": tga(5120)}, "", 0),
    "named-4000.obj": (lambda: named_textures(4000, ""), "--max-overdraw=2000", 0),
    "named-2000-aliases.obj": (lambda: named_textures(2000, "./"), "", 0),
    # glTF
    "points-30000x1000.glb": (lambda: shared(0, 30000, 1000), "", 5),
    "lines-30000x1000.glb": (lambda: shared(3, 30000, 1000), "", 5),
    "triangles-30000x1000.glb": (lambda: shared(4, 30000, 1000), "", 5),
    "points-30000x12.glb": (lambda: shared(0, 30000, 12), "", 0),
    "lines-30000x7.glb": (lambda: shared(3, 30000, 7), "", 5),
    "triangles-30000x130.glb": (lambda: shared(4, 30000, 130), "", 5),
    "forest-3400000.glb": (lambda: forest(64, 20), "", 0),
    "forest-13000000.glb": (lambda: forest(64, 40), "", 5),
    "instanced-1000000.glb": (lambda: instanced(1000000), "", 5),
    "instanced-20000000.glb": (lambda: instanced(20000000), "", 5),
    "morphed.glb": (lambda: morphed(30000, 500, 1), "", 0),
    "morphed-nodes.glb": (lambda: morphed(3000, 500, 500), "", 5),
    "skinned.glb": (lambda: skinned(30, 10000, 30), "", 0),
    "sparse.glb": (lambda: sparse(200000, 20), "", 5),
    "sparse-more.glb": (lambda: sparse(2000000, 20), "", 5),
    "meshopt.glb": (lambda: meshopt(900000, 5), "", 5),
    "meshopt-more.glb": (lambda: meshopt(2500000, 8), "", 5),
    "base64-4000.gltf": (lambda: in_base64(4000), "--max-overdraw=2000", 0),
    "materials-65000.glb": (lambda: listed(materials=[{}] * 65000), "", 0),
    "materials-300000.glb": (lambda: listed(materials=[{}] * 300000), "", 5),
    "nodes-55000.glb": (lambda: listed(nodes=[{"mesh": 0}] * 55000, scenes=[{"nodes": list(range(55000))}]), "", 5),
    "lights-12000.glb": (lambda: lit(12000), "", 0),
    "animated.glb": (lambda: animated(3000), "--animation-time=1", 0),
    "nested-900000.gltf": (lambda: b"[" * 900000, "", 5),
    # 3MF
    "items-3400000.3mf": (lambda: items(64, 20), "", 0),
    "items-13000000.3mf": (lambda: items(64, 40), "", 5),
    "nested-40.3mf": (lambda: nested(40), "", 5),
    "blanks.3mf": (lambda: threemf(model(part(4), '<item objectid="1"/>') + " " * (60 * MIB)), "", 0),
    "blanks-more.3mf": (lambda: threemf(model(part(4), '<item objectid="1"/>') + " " * (80 * MIB)), "", 5),
    # plain text and binary
    "polygon-25000.obj": (lambda: random_polygon(25000), "", 0),
    "points.obj": (lambda: b"v 0 0 0\nv 1 0 0\n" + b"v 1 1 1\n" * 120000, "", 0),
    "lines.obj": (lambda: FOUR + b"l" + b" 1 2" * 240000, "", 5),
    "strips.ply": (lambda: strips(900000), "--views=front", 5),
    "polygons.ply": (lambda: polygons(3900, 255), "--views=front", 5),
    "points.ply": (lambda: ply(330000, random.Random(5).randbytes(990000)), "", 0),
    "faces.off": (lambda: b"OFF\n4 120000 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" + b"3 0 1 2\n" * 120000, "--views=front", 5),
    "commas.ply": (lambda: ply(60000, b"".join(b"%d,5 %d,5 0,5 " % (i % 245, i // 245) for i in range(60000)), kind="float", encoding="ascii"), "", 0),
    "nested.zip": (lambda: nested_gzip(30 * MIB), "", 0),
    "nested-more.zip": (lambda: nested_gzip(100 * MIB), "", 5),
    # gzip, below its limit
    "fan.obj.gz": (lambda: packed(FOUR + b"f " + b"1 2 3 4 " * 5000000), "", 5),
    "faces.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\n" * 7000000), "", 5),
    "both-sides.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\nf 1 3 2\n" * 2500000), "", 5),
    "both-sides-fewer.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\nf 1 3 2\n" * 690000), "", 5),
    "around-9.obj.gz": (lambda: packed(random_faces(9, 2000, 5000000)), "", 5),
    "around-30-fewer.obj.gz": (lambda: packed(random_faces(30, 2000, 1390000)), "", 5),
    "points.obj.gz": (lambda: packed(b"v 0 0 0\n" + b"v 1 1 1\np -1\n" * 3000000), "", 5),
    "lines.obj.gz": (lambda: packed(FOUR + b"l" + b" 1 2" * 10000000), "", 5),
    "vertices.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\n" + b"v 1 1 1\n" * 550000), "", 0),
    "blanks.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\n" + b" " * (60 * MIB)), "", 0),
    "materials.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\n" + b"usemtl a\nusemtl b\n" * 3000000), "", 0),
    "groups.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\n" + b"g a\no b\ns 1\n" * 3000000), "", 0),
    "cloud.ply.gz": (lambda: packed(ply(13 * MIB, bytes(i % 5 for i in range(375)) * (13 * MIB * 3 // 375 + 1))), "", 5),
    "strips.ply.gz": (lambda: packed(strips(40000000)), "", 5),
    "polygons.ply.gz": (lambda: packed(polygons(150000, 255)), "", 5),
    "text.stl.gz": (lambda: packed(b"solid a\n" + ASCII_FACET * 550000 + b"endsolid\n"), "", 5),
    "binary.stl.gz": (lambda: packed(binary_stl(1200000)), "", 5),
    "binary-more.stl.gz": (lambda: packed(binary_stl(1320000)), "", 5),
    "faces.off.gz": (lambda: packed(b"OFF\n4 7000000 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n" + b"3 0 1 2\n" * 7000000), "", 5),
    "lists.gltf.gz": (lambda: packed(b'{"asset":{"version":"2.0"},"extras":[' + b"[]," * 20000000 + b"[]]}"), "", 4),
    "too-much.obj.gz": (lambda: packed(FOUR + b"f 1 2 3\n" + b" " * (80 * MIB)), "", 5),
}

if __name__ == "__main__":
    print("\n".join(FILES))
