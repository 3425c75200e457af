"""Turntables, read back frame by frame. Usage: turntable.py BURNISH, in an empty folder."""
import subprocess
import sys

from outputs import check, checks, gif, png, y4m

BURNISH = sys.argv[1]
W, H, N = 61, 46, 12  # odd, and not what y4m's halves divide


def render(*arguments):
    line = [BURNISH, "render", "--look=plain", "--background-color=#c8d2dc", "--resolution=%d,%d" % (W, H), *arguments]
    return subprocess.run(line, check=True, stdout=subprocess.PIPE).stdout


def difference(a, b):
    return sum(abs(x - y) for x, y in zip(a, b)) / len(a)


def frames_of(mesh, *flags):
    """The luma of each frame, on standard output."""
    return [luma for luma, _, _ in y4m(render(mesh, "--turntable=-", *flags))[3]]


def box(luma):
    """The part of a frame that is not ground."""
    seen = [i for i in range(len(luma)) if luma[i] != luma[0]]
    columns = [i % W for i in seen]
    return min(columns), seen[0] // W, max(columns), seen[-1] // W


GROUND = (200, 210, 220)
# The camera of the first frame, and those of a turn of four frames: to the right, from -Y, the front of up +Z, to +X.
FIRST = ("--up=+Z", "--camera-position=0,-9,2", "--camera-focal-point=0,0,0")
QUARTERS = ("0,-9,2", "9,0,2", "0,9,2", "-9,0,2")


def quarters(mesh, *flags):
    """The pictures of QUARTERS."""
    for position in QUARTERS:
        render(mesh, "-o", "one.png", *FIRST, "--camera-position=" + position, *flags)
        yield png("one.png")[4]


def test_turn():
    """The whole object in every frame; the last goes on into the first."""
    frames = frames_of(":knot", "--frames=%d" % N, "--up=+Z")
    check(len(frames) == N, "frames")
    for i, frame in enumerate(frames):
        x0, y0, x1, y1 = box(frame)
        check(x0 >= 1 and y0 >= 1 and x1 < W - 1 and y1 < H - 1, "frame %d is cut off: %s" % (i, (x0, y0, x1, y1)))
    steps = [difference(frames[i], frames[(i + 1) % N]) for i in range(N)]
    check(min(steps) > 0.5, "a frame that stands still: %s" % steps)
    check(0.6 * min(steps[:-1]) <= steps[-1] <= 1.6 * max(steps[:-1]), "the last step is %s of %s" % (steps[-1], steps))


def test_framing():
    """A sphere keeps its place and size; a bar far from its middle does not leave; projections of both kinds; every up axis."""
    for flags in ((), ("--camera-orthographic",), ("--up=-X", "--elevation=40")):
        boxes = [box(frame) for frame in frames_of(":sphere", "--frames=5", *flags)]
        for side in zip(*boxes):
            check(max(side) - min(side) <= 1, "the sphere pumps with %s: %s" % (flags, boxes))
        check(boxes[0][3] - boxes[0][1] >= 0.8 * H, "the sphere is small with %s: %s" % (flags, boxes[0]))
    open("bar.obj", "w").write("v 100 0 0\nv 110 0 0\nv 110 1 0\nv 100 1 1\nf 1 2 3\nf 1 3 4\n")
    for flags in ((), ("--camera-direction=0,-1,0.001",), ("--views=front",), ("--zoom=1",)):
        widths = []
        for i, frame in enumerate(frames_of("bar.obj", "--frames=16", *flags)):
            x0, y0, x1, y1 = box(frame)
            check(x0 >= 1 and y0 >= 1 and x1 < W - 1 and y1 < H - 1, "bar, frame %d with %s is cut off" % (i, flags))
            widths.append(x1 - x0)
        check(max(widths) > 0.5 * min(W, H), "the bar is small with %s: %s" % (flags, widths))


def test_gif():
    """Near what a camera at each quarter sees; the ground exactly; what stays the same does not flicker; times add up."""
    for mesh, most in ((":knot", 1.0), ("colors.ply", 6.0)):
        render(mesh, "--turntable=g.gif", "--frames=4", "--fps=30", *FIRST)
        width, height, frames, plays = gif("g.gif")
        check((width, height, len(frames), plays) == (W, H, 4, 0), "GIF: header")
        check(abs(sum(delay for delay, _ in frames) - 4 / 30) < 0.0051, "GIF: times")
        check(all(0.03 <= delay <= 0.04 for delay, _ in frames), "GIF: a time of %s" % [d for d, _ in frames])
        before = None
        for i, ((_, shown), samples) in enumerate(zip(frames, quarters(mesh))):
            picture = [tuple(samples[k:k + 3]) for k in range(0, 3 * W * H, 3)]
            check(all(g == GROUND for g, p in zip(shown, picture) if p == GROUND), "GIF: the ground of frame %d" % i)
            error = sum(abs(a - b) for g, p in zip(shown, picture) for a, b in zip(g, p)) / (3 * W * H)
            check(error < most, "GIF: frame %d of %s differs by %.2f" % (i, mesh, error))
            if before:
                check(all(g == b[1] for g, p, b in zip(shown, picture, before) if p == b[0]), "GIF: frame %d flickers" % i)
            before = list(zip(picture, shown))
    # more pixels than 4,096 codes hold, and a transparent ground
    render(":teapot", "--turntable=l.gif", "--frames=2", "--resolution=300,200")
    check(len(gif("l.gif")[2]) == 2, "GIF: a large one")
    render(":torus", "--turntable=t.gif", "--frames=4", "--no-background", *FIRST)
    for (_, shown), picture in zip(gif("t.gif")[2], quarters(":torus", "--no-background")):
        alphas = picture[3::4]
        check(0 in alphas and 255 in alphas, "PNG: alpha")
        check(all((g is None) == (a < 128) for g, a in zip(shown, alphas)), "GIF: transparent pixels")


def test_y4m():
    """Luma and chroma of BT.709 in limited range, of the pixels that a camera at each quarter sees."""
    words, width, height, frames = y4m(render("colors.ply", "--turntable=-", "--frames=4", "--fps=24", *FIRST))
    check((width, height, len(frames)) == (W, H, 4), "Y4M: size")
    check({"F24:1", "Ip", "A1:1", "C420jpeg", "XCOLORRANGE=LIMITED"} <= set(words), "Y4M: %s" % words)
    for (luma, blue, red), samples in zip(frames, quarters("colors.ply")):
        for i in range(W * H):
            r, g, b = samples[3 * i:3 * i + 3]
            check(abs(16 + 219 / 255 * (0.2126 * r + 0.7152 * g + 0.0722 * b) - luma[i]) < 0.51, "Y4M: luma %d" % i)
        for i in range(len(blue)):
            x, y = 2 * (i % ((W + 1) // 2)), 2 * (i // ((W + 1) // 2))
            r = g = b = 0
            for px, py in ((x, y), (min(x + 1, W - 1), y), (x, min(y + 1, H - 1)), (min(x + 1, W - 1), min(y + 1, H - 1))):
                at = 3 * (py * W + px)
                r, g, b = r + samples[at] / 4, g + samples[at + 1] / 4, b + samples[at + 2] / 4
            bright = 0.2126 * r + 0.7152 * g + 0.0722 * b
            check(abs(128 + 224 / 255 * (b - bright) / 1.8556 - blue[i]) < 0.51, "Y4M: blue %d" % i)
            check(abs(128 + 224 / 255 * (r - bright) / 1.5748 - red[i]) < 0.51, "Y4M: red %d" % i)


def make_colors():
    """A strip that is bent, of all colours."""
    rows = [(x / 8, y / 8, (x - 8) ** 2 / 64, 15 * x, 15 * y, 255 - 15 * x) for x in range(17) for y in range(17)]
    faces = [(17 * x + y, 17 * x + y + 17, 17 * x + y + 18, 17 * x + y + 1) for x in range(16) for y in range(16)]
    with open("colors.ply", "w") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex %d\n" % len(rows))
        file.write("".join("property float %s\n" % c for c in "xyz"))
        file.write("".join("property uchar %s\n" % c for c in ("red", "green", "blue")))
        file.write("element face %d\nproperty list uchar int vertex_indices\nend_header\n" % len(faces))
        file.write("".join("%g %g %g %d %d %d\n" % row for row in rows))
        file.write("".join("4 %d %d %d %d\n" % face for face in faces))


if __name__ == "__main__":
    make_colors()
    test_turn()
    test_framing()
    test_gif()
    test_y4m()
    print("turntable: %d checks" % len(checks))
