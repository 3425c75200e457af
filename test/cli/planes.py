"""What planes hold, against scenes whose answer is a formula. Usage: planes.py BURNISH, in an empty folder."""
import json
import math
import subprocess
import sys

from outputs import check, checks, exr, npy, png

BURNISH = sys.argv[1]
W, H = 40, 30
INFINITY = float("inf")


def render(*arguments):
    line = [BURNISH, "render", *arguments, "--resolution=%d,%d" % (W, H), "--json=report.json", "--look=plain"]
    subprocess.run(line, check=True)
    return json.load(open("report.json"))


def ray(x, y, angle=30.0):
    """Slopes of the ray through a pixel's centre, of a camera that looks along -Z with +Y up."""
    scale = math.tan(math.radians(angle) / 2) / (H / 2)
    return (x + 0.5 - W / 2) * scale, -(y + 0.5 - H / 2) * scale


def close(a, b, tolerance, text):
    check(abs(a - b) <= tolerance, "%s: %.9g, not %.9g" % (text, a, b))


def test_tilted_plane():
    """z = x / 2 - 1, left half one material, right half another: depth, normal and ids have closed forms."""
    open("two.mtl", "w").write("newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n")
    corners = [(x, y, x / 2 - 1) for x in (-1, 0, 1) for y in (-1, 1)]
    open("two.obj", "w").write(
        "mtllib two.mtl\n" + "".join("v %g %g %g\n" % c for c in corners) +
        "usemtl red\nf 1 3 4 2\nusemtl blue\nf 3 5 6 4\n")
    names = {"depth": "float", "normal": "float", "triangle": "id", "material": "id", "coverage": "", "color": ""}
    flags = ["--plane=%s:%s.%s" % (n, n, e) for n in names for e in ("npy", "png", "exr") if (n, e) != ("color", "png")]
    report = render("two.obj", "--camera-position=0,0,5", "--camera-focal-point=0,0,0", "-o", "all.exr", "--samples=1",
                    *flags)
    shape, depth = npy("depth.npy")
    check(shape == (H, W), "shape %s" % (shape,))
    _, normals = npy("normal.npy")
    _, triangles = npy("triangle.npy")
    _, materials = npy("material.npy")
    _, coverage = npy("coverage.npy")
    length = math.sqrt(1.25)
    seen = 0
    for i in range(W * H):
        sx, sy = ray(i % W, i // W)
        t = (5 + 1) / (1 + sx / 2)  # 5 - t = t sx / 2 - 1
        px, py = t * sx, t * sy
        if max(abs(px), abs(py)) > 1.03:
            check(depth[i] == INFINITY and triangles[i] == -1 and materials[i] == -1 and coverage[i] == 0,
                  "pixel %d: something outside" % i)
            check(normals[3 * i:3 * i + 3] == [0, 0, 0], "pixel %d: a normal of nothing" % i)
        elif max(abs(px), abs(py)) < 0.97:
            seen += 1
            close(depth[i], t, 1e-4, "pixel %d: depth" % i)  # a slope of 0.05 a pixel, corners snap to 1/256
            for k, expected in enumerate((-0.5 / length, 0, 1 / length)):
                close(normals[3 * i + k], expected, 1e-6, "pixel %d: normal" % i)
            check(coverage[i] == 255, "pixel %d: coverage %d" % (i, coverage[i]))
            if abs(px) > 0.05:
                check(materials[i] == int(px > 0), "pixel %d: material %d" % (i, materials[i]))
                check(triangles[i] // 2 == int(px > 0) and 0 <= triangles[i] < 4, "pixel %d: id" % i)
    check(seen > 100 and len(set(triangles)) == 5, "%d pixels, ids %s" % (seen, set(triangles)))
    finite = [d for d in depth if d < INFINITY]
    plane = next(p for p in report["planes"] if p["output"] == "depth.png")
    close(plane["low"], min(finite), 1e-6, "low")
    close(plane["high"], max(finite), 1e-6, "high")
    test_formats(plane, depth, normals, triangles, materials, coverage)


def test_formats(plane, depth, normals, triangles, materials, coverage):
    """PNG and EXR hold what NPY holds, by the mappings that the manual states."""
    _, _, channels, bits, codes, found = png("depth.png")
    check((channels, bits) == (1, 16) and "sRGB" not in found, "depth.png: header")
    step = (plane["high"] - plane["low"]) / 65534
    for i, code in enumerate(codes):
        check((code == 0) == (depth[i] == INFINITY), "depth.png: pixel %d is %d" % (i, code))
        if code:
            close(plane["low"] + (code - 1) * step, depth[i], 0.51 * step + 1e-9, "depth.png: pixel %d" % i)
    check(max(codes) == 65535 and min(c for c in codes if c) == 1, "depth.png: range")
    _, _, channels, bits, codes, found = png("normal.png")
    check((channels, bits) == (3, 16) and "sRGB" not in found, "normal.png: header")
    for i, code in enumerate(codes):
        none = depth[i // 3] == INFINITY
        if none:
            check(code == 0, "normal.png: a normal of nothing")
        else:
            close(2 * code / 65535 - 1, normals[i], 1.01 / 65535, "normal.png: sample %d" % i)
    for name, ids in (("triangle", triangles), ("material", materials)):
        _, _, channels, bits, codes, found = png(name + ".png")
        check((channels, bits) == (3, 8) and "sRGB" not in found, name + ".png: header")
        read = [65536 * codes[i] + 256 * codes[i + 1] + codes[i + 2] - 1 for i in range(0, len(codes), 3)]
        check(read == ids, name + ".png: ids")
    check(png("coverage.png")[4] == [257 * c for c in coverage], "coverage.png")
    width, height, planes = exr("all.exr")
    check((width, height) == (W, H), "all.exr: size")
    unsigned = lambda values: [v & 0xffffffff for v in values]
    check(sorted(planes) == sorted("R G B A Z N.X N.Y N.Z id material coverage".split()), "all.exr: %s" % sorted(planes))
    check(planes["Z"] == depth, "all.exr: Z")
    for k in range(3):
        check(planes["N." + "XYZ"[k]] == normals[k::3], "all.exr: normals")
    check(planes["id"] == unsigned(triangles) and planes["material"] == unsigned(materials), "all.exr: ids")
    check(all(abs(a - b / 255) < 1e-6 for a, b in zip(planes["coverage"], coverage)), "all.exr: coverage")
    _, color = npy("color.npy")
    for k in range(4):
        check(planes["RGBA"[k]] == color[k::4], "all.exr: color")
    for name in ("depth", "normal", "triangle", "material", "coverage", "color"):
        for channel, values in exr(name + ".exr")[2].items():
            check(values == planes[channel], "%s.exr: %s" % (name, channel))


def test_color():
    """Linear colour is the picture before sRGB; without a background EXR has alpha multiplied in, NPY not."""
    def code(value):
        value = min(max(value, 0), 1)
        return 255 * (12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055)

    render(":torus", "--samples=1", "-o", "p.png", "--plane=color:c.npy")
    shape, color = npy("c.npy")
    samples = png("p.png")[4]
    check(shape == (H, W, 4), "color: shape")
    for i in range(W * H):
        check(color[4 * i + 3] == 1, "color: alpha")
        for k in range(3):
            close(code(color[4 * i + k]), samples[3 * i + k], 0.52, "color: pixel %d" % i)
    render(":torus", "--samples=16", "--no-background", "-o", "c.exr", "--plane=color:c.npy")
    _, color = npy("c.npy")
    planes = exr("c.exr")[2]
    partial = 0
    for i in range(W * H):
        alpha = color[4 * i + 3]
        partial += 0 < alpha < 1
        check(planes["A"][i] == alpha and abs(planes["coverage"][i] - alpha) < 0.003, "alpha of pixel %d" % i)
        close(planes["R"][i], color[4 * i] * alpha, 1e-6, "premultiplied pixel %d" % i)
    check(partial > 50, "no edges")
    render(":torus", "-o", "c.npy")
    check(npy("c.npy")[0] == (H, W, 4), "-o c.npy")


if __name__ == "__main__":
    test_tilted_plane()
    test_color()
    print("planes: %d checks" % len(checks))
