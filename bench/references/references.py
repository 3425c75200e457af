#!/usr/bin/env python3
"""Draws scenes with burnish and with another renderer, prints what they differ by and writes a sheet of pictures.

Usage: references.py three|cycles|monte-carlo BURNISH SCRATCH [FOLDER]
  SCRATCH  gets the pictures, REFERENCE.txt and REFERENCE.png; for three: has node_modules with three and puppeteer-core
  FOLDER   glTF files for three and cycles, in it or in its folders; without: spheres and tori of roughness 0 to 1 only

Both draw with the same camera and the same environment, the room at half its strength, without tone mapping, shadows and occlusion.
Pixels that both cover completely are compared. Needs numpy and Pillow; SIZE and SAMPLES change the size and the noise."""
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
SAMPLES = int(os.environ.get("SAMPLES", "64"))
STRENGTH = 0.5
SQUARE = (2.5, 2.0, 1.5) # the centre of a near light, which faces the object


def shape(file, tube, material):
    """Writes a glTF file with a sphere of radius 1, or a torus if tube > 0."""
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 193), np.linspace(0, 2 * np.pi if tube else np.pi, 97))
    ring = np.stack((np.cos(u), 0 * u, np.sin(u)), -1)
    normal = ring * (np.cos(v) if tube else np.sin(v))[..., None] + np.stack((0 * v, np.sin(v) if tube else np.cos(v), 0 * v), -1)
    position = normal if not tube else 0.7 * ring + tube * normal
    i = (np.arange(96)[:, None] * 193 + np.arange(192)).ravel()[:, None]
    triangles = (i + (0, 1, 193, 1, 194, 193)) if not tube else (i + (0, 193, 1, 1, 193, 194))
    arrays = (position.reshape(-1, 3).astype("<f4"), normal.reshape(-1, 3).astype("<f4"), triangles.reshape(-1, 1).astype("<u4"))
    data, views, accessors = b"", [], []
    for array, kind, component in zip(arrays, ("VEC3", "VEC3", "SCALAR"), (5126, 5126, 5125)):
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(array), "type": kind,
                          "min": array.min(0).tolist(), "max": array.max(0).tolist()})
        data += array.tobytes()
    base, metallic, roughness = material
    file.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2, "material": 0}]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [*base, 1], "metallicFactor": metallic, "roughnessFactor": roughness}}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": views, "accessors": accessors}))


def shapes(scratch, roughnesses):
    for kind, base, metallic in (("metal", GOLD, 1), ("plastic", RED, 0)):
        for name, tube in (("sphere", 0), ("torus", 0.3)):
            for roughness in roughnesses:
                file = scratch / f"{name}-{kind}-{roughness}.gltf"
                shape(file, tube, (base, metallic, roughness))
                yield {"name": file.stem, "file": str(file), "material": (base, metallic, roughness)}


def run(burnish, file, output, *flags):
    command = [burnish, "render", file, "--look=plain", "--overwrite", f"--output={output}", "--json", *flags]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return json.loads(done.stdout) if done.returncode == 0 else sys.stderr.write(done.stderr)


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


def draw(burnish, picture, scratch, lights):
    """burnish's picture, its mask and its camera."""
    paths = {name: str((scratch / f"{picture['name']}.{name}").resolve()) for name in ("burnish.png", "coverage.npy", "normal.npy", "depth.npy", "output", "mask", "a.npy", "b.npy")}
    report = run(burnish, picture["file"], paths["burnish.png"], f"--size={SIZE[0]}x{SIZE[1]}", *lights, "--tone-mapping=none", "--occlusion=none",
                 *(f"--plane={plane}:{paths[plane + '.npy']}" for plane in ("coverage", "normal", "depth")))
    if not report:
        return False
    picture.update(camera=report["camera"], warnings=report["warnings"], output=paths["output"], mask=paths["mask"], halves=[paths["a.npy"], paths["b.npy"]],
                   drawn=np.asarray(Image.open(paths["burnish.png"]).convert("RGB")), inside=np.load(paths["coverage.npy"]) == 255,
                   normal=np.load(paths["normal.npy"]), depth=np.load(paths["depth.npy"]))
    return True


def estimate(picture, light):
    """Two independent estimates by monte_carlo."""
    camera = {name: np.array(value) for name, value in picture["camera"].items()}
    forward = monte_carlo.unit(camera["focal_point"] - camera["position"])
    right = monte_carlo.unit(np.cross(forward, camera["view_up"]))
    y, x = np.nonzero(picture["inside"])
    scale = np.tan(np.radians(camera["view_angle"]) / 2) / SIZE[1]
    rays = forward + ((2 * x + 1 - SIZE[0]) * scale)[:, None] * right - ((2 * y + 1 - SIZE[1]) * scale)[:, None] * np.cross(right, forward)
    points = camera["position"] + picture["depth"][y, x][:, None] * rays
    for half in picture["halves"]:
        image = np.zeros(picture["drawn"].shape)
        image[y, x] = monte_carlo.radiance(points, monte_carlo.unit(picture["normal"][y, x]), camera["position"], light, *picture["material"], SAMPLES)
        np.save(half, image)


def srgb(linear):
    linear = linear.clip(0, 1)
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def decibels(a, b):
    return 10 * np.log10(255 ** 2 / max(1e-9, np.mean((a.astype(float) - b) ** 2)))


def reference(picture):
    """The other picture, its mask, and the decibels of its noise."""
    if os.path.exists(picture["output"]):
        image, noise = np.asarray(Image.open(picture["output"]).convert("RGB")), None
    else:
        a, b = (np.load(half).astype(float) for half in picture["halves"])
        image, noise = srgb((a + b) / 2), decibels(srgb(a)[picture["inside"]], srgb(b)[picture["inside"]]) + 6
    if not os.path.exists(picture["mask"]):
        return image, picture["inside"], noise
    return image, np.asarray(Image.open(picture["mask"]))[..., 3] == 255, noise


def sheet(pictures, file):
    (width, height), columns = SIZE, 2
    image = Image.new("RGB", (columns * 3 * width, -(-len(pictures) // columns) * (height + 16)))
    for i, picture in enumerate(pictures):
        x, y = i % columns * 3 * width, i // columns * (height + 16)
        ImageDraw.Draw(image).text((x + 4, y + 2), f"{picture['name']}  {picture['db']:.1f} dB   burnish | reference | 4 x difference")
        outside, a, b = ~(picture["both"][..., None]), picture["drawn"].astype(float), picture["other"]
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
    environment, image = room(burnish, work)
    dome = (f"--environment={environment}", f"--environment-strength={STRENGTH}", "--background-color=environment")
    pictures = []
    if name == "monte-carlo":
        square = (f"--light=world-rect:{','.join(map(str, SQUARE))}:2,2", "--ambient=0")
        for kind, flags, light in (("room", dome, monte_carlo.Environment(image, STRENGTH)), ("square", square, monte_carlo.Square(SQUARE, 1))):
            for picture in shapes(work, (0.1, 0.3, 0.5, 0.8)):
                picture["name"] += "-" + kind
                draw(burnish, picture, work, flags)
                estimate(picture, light)
                pictures.append(picture)
    else:
        files = sorted(file for pattern in ("*.glb", "*.gltf") for file in pathlib.Path(*folder).resolve().rglob(pattern)) if folder else []
        pictures = [*shapes(work, (0, 0.1, 0.3, 0.5, 0.8, 1)), *({"name": file.stem, "file": str(file)} for file in files)]
        pictures = [picture for picture in pictures if draw(burnish, picture, work, dome)]
        jobs = {"environment": environment, "strength": STRENGTH, "samples": SAMPLES, "width": SIZE[0], "height": SIZE[1],
                "pictures": [{key: picture[key] for key in ("file", "camera", "output", "mask", "halves")} for picture in pictures]}
        (work / "jobs.json").write_text(json.dumps(jobs))
        other = {"three": ["node", HERE / "three.mjs", scratch / "node_modules"], "cycles": ["blender", "--background", "--factory-startup", "--python", HERE / "cycles.py", "--"]}
        subprocess.run([*other[name], work / "jobs.json"], stdout=subprocess.DEVNULL, check=True)
    lines, compared = [], []
    for picture in pictures:
        if not any(map(os.path.exists, (picture["output"], picture["halves"][0]))):
            lines.append(f"     -             {picture['name']}: not drawn by {name}")
            continue
        picture["other"], mask, picture["noise"] = reference(picture)
        picture["both"] = mask & picture["inside"]
        picture["db"] = decibels(picture["drawn"][picture["both"]], picture["other"][picture["both"]])
        picture["same"] = picture["both"].sum() / max(1, (mask | picture["inside"]).sum())
        compared.append(picture)
    compared.sort(key=lambda picture: picture["db"])
    for picture in compared:
        noise = f"{picture['noise']:6.1f}" if picture["noise"] else "     -"
        lines.append(f"{picture['db']:6.1f} {noise} {100 * picture['same']:5.1f} %  {picture['name']}  {' '.join(picture['warnings'])[:90]}")
    lines.append("dB, dB of the reference's noise, pixels that both cover of those that one covers")
    for group, kept in (("shapes", [p["db"] for p in compared if "material" in p]), ("files", [p["db"] for p in compared if "material" not in p])):
        if kept:
            lines.append(f"{group}: {len(kept)} pictures, mean {np.mean(kept):.1f} dB, median {np.median(kept):.1f}, worst {min(kept):.1f}")
    (scratch / f"{name}.txt").write_text("\n".join(lines) + "\n")
    sheet(compared, scratch / f"{name}.png")
    print("\n".join(lines))
    print(f"sheet: {scratch / name}.png")


main()
