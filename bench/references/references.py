#!/usr/bin/env python3
"""Draws scenes with burnish and with another renderer, prints what they differ by and writes a sheet of pictures.

Usage: references.py three|cycles|monte-carlo|rays BURNISH SCRATCH [FOLDER]
  SCRATCH  gets the pictures, REFERENCE.txt and REFERENCE.png; for three: has node_modules with three and puppeteer-core
  FOLDER   glTF files for three, cycles and rays, in it or in its folders; without: spheres of roughness 0 to 1 only

Both draw with the same camera and the same environment, the room at half its strength, without tone mapping, shadows and computed occlusion.
Pixels that both cover completely are compared. Needs numpy and Pillow; SIZE and SAMPLES change the size and the noise.

rays: the files, or without them the spheres, under a softbox and ambient light instead of the room, by --raytracing and by depth maps,
and in Cycles with five bounces. Then what arrives of the ambient light and of the softbox at 4,000 pixels, against rays of Blender's own tree."""
import base64
import json
import os
import pathlib
import subprocess
import sys

import numpy as np
from PIL import Image, ImageDraw

import monte_carlo

HERE = pathlib.Path(__file__).parent
GOLD, RED = (1.0, 0.766, 0.336), (0.8, 0.05, 0.02)
SIZE = tuple(map(int, os.environ.get("SIZE", "320x240").split("x")))
TIMES = 2
SAMPLES = int(os.environ.get("SAMPLES", "64"))
STRENGTH = 0.5
AMBIENT, RADIANCE, POINTS = 0.3, 6, 4000
WAYS = {"rays": ("--raytracing",), "maps": ("--occlusion=72", "--shadow")}


def sphere(file, base, metallic, roughness):
    """Writes a glTF file."""
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 193), np.linspace(0, np.pi, 97))
    position = np.stack((np.cos(u) * np.sin(v), np.cos(v), np.sin(u) * np.sin(v)), -1).reshape(-1, 3).astype("<f4")
    triangles = (np.arange(96 * 193).reshape(96, 193)[:, :192, None] + (0, 1, 193, 1, 194, 193)).astype("<u4")
    accessors = [{"bufferView": 0, "componentType": 5126, "count": len(position), "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]},
                 {"bufferView": 1, "componentType": 5125, "count": triangles.size, "type": "SCALAR"}]
    data = position.tobytes() + triangles.tobytes()
    file.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [*base, 1], "metallicFactor": metallic, "roughnessFactor": roughness}}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": position.nbytes}, {"buffer": 0, "byteOffset": position.nbytes, "byteLength": triangles.nbytes}],
        "accessors": accessors}))


def spheres(scratch):
    for kind, base, metallic in (("metal", GOLD, 1), ("plastic", RED, 0)):
        for roughness in (0, 0.1, 0.3, 0.5, 0.8, 1):
            file = scratch / f"{kind}-{roughness}.gltf"
            sphere(file, base, metallic, roughness)
            yield {"name": file.stem, "file": str(file), "material": (base, metallic, roughness)}


def run(burnish, file, output, *flags):
    command = [burnish, "render", file, "--look=plain", "--overwrite", f"--output={output}", "--json", *flags]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    sys.stderr.write("" if done.returncode == 0 else done.stderr)
    return json.loads(done.stdout) if done.returncode == 0 else None


def room(burnish, scratch):
    """burnish's room as an equirectangular image, in a file and an array: six views from its middle."""
    (scratch / "inside.obj").write_text("v 0 0 0\nv 1e-4 0 0\nv 0 1e-4 0\nf 1 2 3\n")
    polar, around = np.meshgrid((np.arange(512) + 0.5) / 512 * np.pi, ((np.arange(1024) + 0.5) / 1024 - 0.5) * 2 * np.pi, indexing="ij")
    w = np.stack((np.sin(polar) * np.cos(around), np.cos(polar), np.sin(polar) * np.sin(around)), -1)
    image, face = np.zeros(w.shape), np.abs(w).argmax(-1)
    for axis in range(3):
        for sign in (1, -1):
            forward, up = sign * np.eye(3)[axis], np.eye(3)[2 if axis == 1 else 1]
            run(burnish, scratch / "inside.obj", scratch / "inside.png", "--size=512", "--environment=room",
                "--background-color=environment", "--camera-position=0,0,0", f"--camera-focal-point={','.join(map(str, forward))}",
                f"--camera-view-up={','.join(map(str, up))}", "--camera-view-angle=90", f"--plane=color:{scratch / 'inside.npy'}", "-q")
            here = (face == axis) & (w[..., axis] * sign > 0)
            x, y = (((w[here] @ side) / (w[here] @ forward) * 256 + 256).clip(0, 511).astype(int) for side in (np.cross(forward, up), -up))
            image[here] = np.load(scratch / "inside.npy")[y, x, :3]
    mantissa, exponent = np.frexp(image.max(-1).clip(1e-9))
    rgbe = np.concatenate((image * (mantissa * 256 / image.max(-1).clip(1e-9))[..., None], exponent[..., None] + 128), -1).astype(np.uint8)
    file = scratch / "room.hdr"
    file.write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 512 +X 1024\n" + rgbe.tobytes())
    return str(file.resolve()), image


def softbox(burnish, picture, scratch):
    """A softbox half as wide as the object, above it on the left, as a flag and as cycles.py reads it."""
    report = run(burnish, picture["file"], scratch / "box.png", "--size=16")
    low, high = (np.array(report["bounding_box"][end]) for end in ("min", "max")) if report else np.zeros((2, 3))
    side = (high - low).max() / 2
    lamp = {"at": list((low + high) / 2 + side * np.array((-1.2, 1.8, 1.2))), "target": list((low + high) / 2), "side": side, "radiance": RADIANCE}
    at, target = (",".join(map(str, lamp[key])) for key in ("at", "target"))
    return lamp, f"--light=world-rect:{at}:{side},{side}:target={target}:{RADIANCE}"


def shares(burnish, picture, scratch, lamp):
    """Adds what arrives at some pixels of the softbox and of ambient light, by each way, and the points and normals of these."""
    plane = {name: scratch / f"share.{name}.npy" for name in ("coverage", "normal", "depth", "color")}
    matt = (f"--size={SIZE[0]}x{SIZE[1]}", "--samples=1", "--material=matte", "--specular=0", "--color=0.1,0.1,0.1", "-q",
            *(f"--plane={name}:{file}" for name, file in plane.items()))
    drawn = {}
    for light, flags in (("softbox", (lamp, "--ambient=0")), ("ambient", ("--light=none", "--ambient=1"))):
        for way, more in (("all", ("--occlusion=none",)), *WAYS.items()):
            run(burnish, picture["file"], scratch / "share.png", *matt, *flags, *more)
            drawn[light, way] = np.load(plane["color"])[..., 0].astype(float)
    full = drawn["softbox", "all"] * (np.load(plane["coverage"]) == 255)
    y, x = np.nonzero(full > 0.05 * full.max())
    kept = np.random.default_rng(1).permutation(len(x))[:POINTS]
    y, x = y[kept], x[kept]
    camera = {name: np.array(value) for name, value in picture["camera"].items()}
    points = camera["position"] + np.load(plane["depth"])[y, x][:, None] * directions(camera, x, y, SIZE)
    picture["points"] = str((scratch / f"{picture['name']}.points.npy").resolve())
    np.save(picture["points"], np.concatenate((points, monte_carlo.unit(np.load(plane["normal"])[y, x])), 1))
    picture["strength"] = full[y, x] / full[y, x].max()
    picture["shares"] = {way: np.stack([drawn[light, way][y, x] / drawn[light, "all"][y, x] for light in ("softbox", "ambient")]) for way in WAYS}


def directions(camera, x, y, size):
    """Through the middles of pixels, of length 1 along the camera's axis."""
    forward = monte_carlo.unit(camera["focal_point"] - camera["position"])
    right = monte_carlo.unit(np.cross(forward, camera["view_up"]))
    scale = np.tan(np.radians(camera["view_angle"]) / 2) / size[1]
    return forward + ((2 * x + 1 - size[0]) * scale)[:, None] * right - ((2 * y + 1 - size[1]) * scale)[:, None] * np.cross(right, forward)


def draw(burnish, picture, scratch, lights):
    """Adds burnish's picture, its mask and its camera, and the names of the reference's files."""
    base = str((scratch / picture["name"]).resolve())
    planes = {plane: f"{base}.{plane}.npy" for plane in ("coverage", "normal", "depth")}
    report = run(burnish, picture["file"], base + ".burnish.png", f"--size={TIMES * SIZE[0]}x{TIMES * SIZE[1]}", *lights, "--tone-mapping=none",
                 *(f"--plane={plane}:{file}" for plane, file in planes.items()))
    if report:
        coverage, normal, depth = (np.load(file) for file in planes.values())
        picture.update(camera=report["camera"], warnings=report["warnings"], drawn=srgb(smaller(linear(base + ".burnish.png"))),
                       inside=smaller(coverage[..., None])[..., 0] == 255, normal=normal, depth=depth,
                       output=base + ".output.png", mask=base + ".mask.png", halves=[base + ".a.npy", base + ".b.npy"])
    return picture


def ways(burnish, picture, scratch):
    """burnish's pictures by rays and by maps, with the same reference."""
    lamp, flag = softbox(burnish, picture, scratch)
    both = [draw(burnish, {**picture, "name": f"{picture['name']}-{way}"}, scratch, (flag, f"--ambient={AMBIENT}", *flags)) for way, flags in WAYS.items()]
    if not all("drawn" in one for one in both):
        return [{key: one[key] for key in ("name", "file")} for one in both]
    both[1].update(is_shared=True, halves=both[0]["halves"])
    both[0].update(softbox=lamp, ambient=AMBIENT)
    shares(burnish, both[0], scratch, flag)
    return both


def compare_shares(pictures):
    """A line for each way of its means over the pictures."""
    errors = {way: [] for way in WAYS}
    for picture in pictures:
        if os.path.exists(picture.get("points", "") + ".npy"):
            light, sky = np.load(picture["points"] + ".npy")
            partly = (light > 0.05) & (light < 0.95)
            for way, (a, b) in picture["shares"].items():
                rms = [np.sqrt(np.mean(x * x)) for x in ((a - light) * picture["strength"], ((a - light) * picture["strength"])[partly], (a - light)[partly], b - sky)]
                errors[way].append(rms)
                yield f"{picture['name'][:-5]} by {way}: " + " ".join(f"{x:.4f}" for x in rms)
    for way, own in errors.items():
        if own:
            yield f"mean by {way}: " + " ".join(f"{x:.4f}" for x in np.nanmean(own, 0))
    if any(errors.values()):
        yield ("root mean square errors: softbox, in its penumbra, of its full light; in its penumbra, of what would arrive there; ambient light")


def estimate(picture, light):
    """Two independent estimates by monte_carlo."""
    camera = {name: np.array(value) for name, value in picture["camera"].items()}
    inside = picture["inside"].repeat(TIMES, 0).repeat(TIMES, 1)
    y, x = np.nonzero(inside)
    height, width = inside.shape
    points = camera["position"] + picture["depth"][y, x][:, None] * directions(camera, x, y, (width, height))
    for half in picture["halves"]:
        image = np.zeros((height, width, 4))
        image[y, x, 3] = 1
        image[y, x, :3] = monte_carlo.radiance(points, monte_carlo.unit(picture["normal"][y, x]), camera["position"], light,
                                                *picture["material"], -(-SAMPLES // TIMES ** 2))
        np.save(half, image)


def srgb(x):
    x = x.clip(0, 1)
    return 255 * np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def linear(file):
    x = np.arange(256) / 255
    return np.where(x <= 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4)[np.asarray(Image.open(file).convert("RGB"))]


def smaller(image):
    """An image of the size SIZE: means of as many pixels as this one has for each."""
    return image.reshape(SIZE[1], -1, SIZE[0], image.shape[1] // SIZE[0], image.shape[2]).mean((1, 3))


def decibels(square):
    return 10 * np.log10(255 ** 2 / max(1e-3, square))


def compare(picture):
    """Adds the other picture, the mask, decibels, the reference's noise and the share of pixels that both cover. The product of two
    differences from independent halves is free of noise."""
    if os.path.exists(picture["output"]):
        other = [linear(picture["output"])]
        mask = np.asarray(Image.open(picture["mask"]))[..., 3:] / 255
    else:
        other = [np.load(half).astype(float) for half in picture["halves"]]
        mask = np.minimum(*(half[..., 3:] for half in other))
    other, mask = [srgb(smaller(half[..., :3])) for half in other], smaller(mask)[..., 0] > 0.999
    both = mask & picture["inside"]
    a, b = (half[both] - picture["drawn"][both] for half in (other[0], other[-1]))
    noise = np.mean((a - b) ** 2) / 4
    picture.update(other=np.mean(other, 0), both=both, same=both.sum() / max(1, (mask | picture["inside"]).sum()),
                   db=decibels(max(np.mean(a * b), noise / 32)), noise=decibels(noise) if noise else None)


def sheet(pictures, file):
    (width, height), columns = SIZE, 2
    image = Image.new("RGB", (columns * 3 * width, -(-len(pictures) // columns) * (height + 16)))
    for i, picture in enumerate(pictures):
        x, y = i % columns * 3 * width, i // columns * (height + 16)
        ImageDraw.Draw(image).text((x + 4, y + 2), f"{picture['name']}  {picture['db']:.1f} dB   burnish | reference | 4 x difference")
        outside, a, b = ~(picture["both"][..., None]), picture["drawn"], picture["other"]
        for k, part in enumerate((a, b, np.where(outside, 0, 4 * np.abs(a - b)))):
            image.paste(Image.fromarray(part.clip(0, 255).astype(np.uint8)), (x + k * width, y + 16))
    image.save(file)


def main():
    name, burnish, scratch, *folder = sys.argv[1:]
    scratch = pathlib.Path(scratch)
    work = scratch / name
    work.mkdir(parents=True, exist_ok=True)
    for old in work.glob("*.*"):
        old.unlink()
    files = sorted(file for pattern in ("*.glb", "*.gltf") for file in pathlib.Path(*folder).resolve().rglob(pattern)) if folder else []
    pictures = [*(spheres(work) if name != "rays" or not files else ()), *({"name": file.stem, "file": str(file)} for file in files)]
    jobs = {"samples": SAMPLES, "ratio": TIMES, "width": SIZE[0], "height": SIZE[1]}
    if name == "rays":
        pictures = [way for picture in pictures for way in ways(burnish, picture, work)]
    else:
        jobs["environment"], image = room(burnish, work)
        jobs["strength"] = STRENGTH
        dome = (f"--environment={jobs['environment']}", f"--environment-strength={STRENGTH}", "--background-color=environment", "--occlusion=none")
        pictures = [draw(burnish, picture, work, dome) for picture in pictures]
    if name == "monte-carlo":
        light = monte_carlo.Environment(image, STRENGTH)
        for picture in pictures:
            estimate(picture, light)
    else:
        jobs["pictures"] = [{key: picture[key] for key in ("file", "camera", "output", "mask", "halves", "softbox", "ambient", "points") if key in picture}
                            for picture in pictures if "drawn" in picture and "is_shared" not in picture]
        (work / "jobs.json").write_text(json.dumps(jobs))
        blender = ["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", HERE / "cycles.py", "--"]
        other = ["node", HERE / "three.mjs", scratch / "node_modules"] if name == "three" else blender
        subprocess.run([*other, work / "jobs.json"], stdout=subprocess.DEVNULL, check=True)
    lines, compared = [], []
    for picture in pictures:
        if "drawn" in picture and any(map(os.path.exists, (picture["output"], picture["halves"][0]))):
            compare(picture)
            compared.append(picture)
        else:
            lines.append(f"     -                  {picture['name']}: not drawn by {name if 'drawn' in picture else 'burnish'}")
    compared.sort(key=lambda picture: picture["db"])
    for picture in compared:
        noise = f"{picture['noise']:6.1f}" if picture["noise"] else "     -"
        lines.append(f"{picture['db']:6.1f} {noise} {100 * picture['same']:5.1f} %  {picture['name']}  {' '.join(picture['warnings']).replace(picture['file'] + ': ', '')[:120]}")
    lines.append("dB without the reference's noise, dB of that noise, pixels that both cover of those that one covers")
    for group in ("rays", "maps") if name == "rays" else ("spheres", "files"):
        kept = [p["db"] for p in compared if (p["name"].endswith("-" + group) if name == "rays" else ("material" in p) == (group == "spheres"))]
        if kept:
            lines.append(f"{group}: {len(kept)} pictures, mean {np.mean(kept):.1f} dB, median {np.median(kept):.1f}, worst {min(kept):.1f}")
    lines += compare_shares(pictures)
    (scratch / f"{name}.txt").write_text("\n".join(lines) + "\n")
    sheet(compared, scratch / f"{name}.png")
    print("\n".join(lines))
    print(f"sheet: {scratch / name}.png")


main()
