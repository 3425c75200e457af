#!/usr/bin/env python3
"""Writes the ring that test/importers/ring.glb holds compressed, without loss, by libdraco 1.5.5: a torus of 12 x 8.

Usage: ring.py FILE.glb"""
import json
import math
import struct
import sys

N, M = 12, 8
positions, normals, colors = [], [], []
for i in range(N):
    for j in range(M):
        for a, b in ((i, j), (i, j + 1), (i + 1, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)):
            a, b = a % N, b % M
            u, v = 2 * math.pi * a / N, 2 * math.pi * b / M
            radius = 1 + 0.4 * math.cos(v)
            positions += [math.cos(u) * radius, 0.4 * math.sin(v), math.sin(u) * radius]
            normals += [math.cos(u) * math.cos(v), math.sin(v), math.sin(u) * math.cos(v)]
            colors += [20 * a, 30 * b, 90, 255]
count = len(positions) // 3
binary = struct.pack("<%df" % (6 * count), *positions, *normals) + bytes(colors)
scene = {
    "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "buffers": [{"byteLength": len(binary)}],
    "bufferViews": [{"buffer": 0, "byteOffset": at * count, "byteLength": size * count} for at, size in ((0, 12), (12, 12), (24, 4))],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5126, "count": count, "type": "VEC3"},
                  {"bufferView": 2, "componentType": 5121, "count": count, "type": "VEC4", "normalized": True}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "COLOR_0": 2}}]}]}
text = json.dumps(scene).encode()
text += b" " * (-len(text) % 4)
with open(sys.argv[1], "wb") as file:
    file.write(struct.pack("<4sIII4s", b"glTF", 2, 28 + len(text) + len(binary), len(text), b"JSON") + text
               + struct.pack("<I4s", len(binary), b"BIN\0") + binary)
