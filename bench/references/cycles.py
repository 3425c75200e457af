"""Draws pictures with Blender's Cycles. Usage: blender --background --factory-startup --python cycles.py -- JOBS

JOBS is the file that references.py writes. Objects are seen by the camera and by rays that pass through glass only, so none shades
or mirrors another: what is compared is materials, textures and lights. Each picture is drawn twice with other random numbers."""
import json
import sys

import bpy
import mathutils
import numpy

numpy.bool = bool # the importer of Blender 3.4 names what numpy 1.24 no longer has

with open(sys.argv[-1], encoding="utf-8") as file:
    jobs = json.load(file)


def turned(v):
    """The importer turns Y up into Z up."""
    return mathutils.Vector((v[0], -v[2], v[1]))


def world(scene):
    scene.world = bpy.data.worlds.new("world")
    scene.world.use_nodes = True
    nodes, links = scene.world.node_tree.nodes, scene.world.node_tree.links
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


def draw(picture):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=picture["file"], guess_original_bind_pose=False)
    scene = bpy.context.scene
    for thing in list(scene.objects):
        if thing.type in ("LIGHT", "CAMERA"):
            bpy.data.objects.remove(thing)
        else:
            thing.visible_diffuse = thing.visible_glossy = thing.visible_shadow = False
            thing.animation_data_clear()
            for bone in thing.pose.bones if thing.pose else ():
                bone.matrix_basis.identity()
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.use_nodes else ():
            if node.type == "BSDF_PRINCIPLED":
                node.distribution = "MULTI_GGX"
    world(scene)
    camera(scene, picture["camera"])
    render, cycles = scene.render, scene.cycles
    render.use_persistent_data = True
    render.engine, cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = "CYCLES", jobs["samples"], False, False
    cycles.pixel_filter_type, cycles.max_bounces, cycles.sample_clamp_indirect = "BOX", 8, 0
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
    except RuntimeError as error:
        print(f"cycles.py: {one['file']}: {str(error).splitlines()[-1]}", file=sys.stderr)
