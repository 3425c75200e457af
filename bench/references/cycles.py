"""Draws pictures with Blender's Cycles. Usage: blender --background --factory-startup --python cycles.py -- JOBS

JOBS is the file that references.py writes. Objects are seen by the camera and by rays that pass through glass only, so none shades
or mirrors another: what is compared is materials, textures and lights. Each picture is drawn twice with other random numbers.

Pictures with a softbox have all light, over five bounces; rough surfaces without metal are matt. From their points Blender's own tree
casts rays to the softbox and to the sky: what arrives is written beside the points."""
import json
import math
import sys

import bpy
import mathutils
import mathutils.bvhtree
import numpy

numpy.bool = bool # the importer of Blender 3.4 names what numpy 1.24 no longer has

with open(sys.argv[-1], encoding="utf-8") as file:
    jobs = json.load(file)


def turned(v):
    """The importer turns Y up into Z up."""
    return mathutils.Vector((v[0], -v[2], v[1]))


def world(scene, ambient):
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    nodes, links = scene.world.node_tree.nodes, scene.world.node_tree.links
    if ambient:
        nodes["Background"].inputs["Color"].default_value = (ambient, ambient, ambient, 1)
        return
    image = nodes.new("ShaderNodeTexEnvironment")
    image.image = bpy.data.images.load(jobs["environment"])
    nodes["Background"].inputs["Strength"].default_value = jobs["strength"]
    links.new(image.outputs["Color"], nodes["Background"].inputs["Color"])


def camera(scene, at):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit, data.angle = "VERTICAL", at["view_angle"] * 3.14159265358979 / 180
    back = (turned(at["position"]) - turned(at["focal_point"]))
    data.clip_start, data.clip_end = back.length / 100, back.length * 100
    z = back.normalized()
    x = turned(at["view_up"]).cross(z).normalized()
    scene.camera = bpy.data.objects.new("camera", data)
    scene.camera.matrix_world = mathutils.Matrix.Translation(turned(at["position"])) @ mathutils.Matrix((x, z.cross(x), z)).transposed().to_4x4()
    scene.collection.objects.link(scene.camera)


def lamp(scene, box):
    """A softbox of burnish: its middle, its half sides and the direction in which it shines."""
    at, target = turned(box["at"]), turned(box["target"])
    facing = (target - at).normalized()
    u = mathutils.Vector((0, 0, 1)).cross(facing).normalized() * box["side"] / 2
    v = facing.cross(u)
    mesh = bpy.data.meshes.new("softbox")
    mesh.from_pydata([at - u - v, at + u - v, at + u + v, at - u + v], [], [(0, 1, 2, 3)])
    material = bpy.data.materials.new("softbox")
    material.use_nodes = True
    emission = material.node_tree.nodes.new("ShaderNodeEmission")
    emission.inputs["Strength"].default_value = box["radiance"]
    material.node_tree.links.new(emission.outputs[0], material.node_tree.nodes["Material Output"].inputs["Surface"])
    mesh.materials.append(material)
    thing = bpy.data.objects.new("softbox", mesh)
    thing.visible_camera = thing.visible_shadow = False
    scene.collection.objects.link(thing)
    return at, u, v, facing


def matt():
    for material in bpy.data.materials:
        for node in list(material.node_tree.nodes) if material.use_nodes else ():
            color, metallic, roughness = map(node.inputs.get, ("Base Color", "Metallic", "Roughness"))
            if node.type == "BSDF_PRINCIPLED" and not (color.is_linked or metallic.is_linked or roughness.is_linked) and (
                    roughness.default_value > 0.85 and metallic.default_value == 0):
                diffuse = material.node_tree.nodes.new("ShaderNodeBsdfDiffuse")
                diffuse.inputs["Color"].default_value = color.default_value
                material.node_tree.links.new(diffuse.outputs[0], material.node_tree.nodes["Material Output"].inputs["Surface"])


def cast(scene, picture, box, count=16):
    """Of count * count rays to the softbox and to the sky from each point: the share of their light that arrives."""
    at, u, v, facing = box
    vertices, triangles = [], []
    for thing in scene.objects:
        if thing.type == "MESH" and thing.name != "softbox":
            mesh = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
            mesh.calc_loop_triangles()
            triangles += [[len(vertices) + i for i in triangle.vertices] for triangle in mesh.loop_triangles]
            vertices += [thing.matrix_world @ vertex.co for vertex in mesh.vertices]
    tree = mathutils.bvhtree.BVHTree.FromPolygons(vertices, triangles, all_triangles=True)
    random = numpy.random.default_rng(1)
    points = numpy.load(picture["points"])
    arrived = numpy.zeros((2, len(points)))
    near = 2e-5 * (mathutils.Vector(map(max, zip(*vertices))) - mathutils.Vector(map(min, zip(*vertices)))).length
    for i, point in enumerate(points):
        position, normal = turned(point[:3]), turned(point[3:]).normalized()
        face = tree.find_nearest(position)[1]
        face = -face if face.dot(normal) < 0 else face
        origin, side = position + near * face, normal.orthogonal().normalized()
        across, total = normal.cross(side), 0
        for a, b in ((random.random((count * count, 2)) + numpy.indices((count, count)).reshape(2, -1).T) / count).tolist():
            to = at + (2 * a - 1) * u + (2 * b - 1) * v - origin
            length = to.length
            weight = max(0, to.dot(normal)) * max(0, -to.dot(facing)) / length ** 4
            total += weight
            if weight and to.dot(face) > 0 and not tree.ray_cast(origin, to, length)[0]:
                arrived[0, i] += weight
            r, turn = math.sqrt(a), 2 * math.pi * b
            to = r * math.cos(turn) * side + r * math.sin(turn) * across + math.sqrt(1 - a) * normal
            arrived[1, i] += to.dot(face) > 0 and not tree.ray_cast(origin, to)[0]
        arrived[:, i] /= max(total, 1e-30), count * count
    numpy.save(picture["points"] + ".npy", arrived)


def draw(picture):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=picture["file"], guess_original_bind_pose=False)
    scene = bpy.context.scene
    for thing in list(scene.objects):
        if thing.type in ("LIGHT", "CAMERA"):
            bpy.data.objects.remove(thing)
        else:
            thing.visible_diffuse = thing.visible_glossy = thing.visible_shadow = "softbox" in picture
            thing.animation_data_clear()
            for bone in thing.pose.bones if thing.pose else ():
                bone.matrix_basis.identity()
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.use_nodes else ():
            if node.type == "BSDF_PRINCIPLED":
                node.distribution = "MULTI_GGX"
    world(scene, picture.get("ambient"))
    camera(scene, picture["camera"])
    if "softbox" in picture:
        matt()
        cast(scene, picture, lamp(scene, picture["softbox"]))
    render, cycles = scene.render, scene.cycles
    render.use_persistent_data = True
    render.engine, cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = "CYCLES", jobs["samples"], False, False
    cycles.pixel_filter_type, cycles.max_bounces, cycles.sample_clamp_indirect = "BOX", 5 if "softbox" in picture else 8, 0
    render.resolution_x, render.resolution_y, render.resolution_percentage = jobs["width"], jobs["height"], 100
    render.film_transparent, render.image_settings.color_mode = True, "RGBA"
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.view_settings.view_transform = "Standard"
    for i, output in enumerate(picture["halves"]):
        cycles.seed, render.filepath = i, output + ".exr"
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(output + ".exr")
        pixels = numpy.empty(4 * jobs["width"] * jobs["height"], numpy.float32)
        image.pixels.foreach_get(pixels)
        numpy.save(output, pixels.reshape(jobs["height"], jobs["width"], 4)[::-1])


for one in jobs["pictures"]:
    try:
        draw(one)
    except Exception as error: # the others are drawn
        print(f"cycles.py: {one['file']}: {str(error).splitlines()[-1]}", file=sys.stderr)
