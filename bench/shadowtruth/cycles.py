"""Draws shadow masks of the shadowtruth set with Blender Cycles on the CPU.

usage: blender -b --factory-startup -P cycles.py -- DIR MASKS

DIR is the folder of the set, made by scripts/shadowtruth. The script writes one PNG file per case to the folder MASKS,
and skips existing files. Light sources have no size, and a bright light saturates each lit pixel. Each pixel has one
sample, at its centre.
"""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import bpy  # noqa: E402
import cases  # noqa: E402
import mathutils  # noqa: E402


def matrix(values):
    """Returns the matrix of a glTF node, which is column-major."""
    return mathutils.Matrix([values[i::4] for i in range(4)])


def add(name, data, place):
    thing = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(thing)
    thing.matrix_world = place
    return thing


def add_mesh(document, corners, triangles):
    mesh = bpy.data.meshes.new("mesh")
    mesh.from_pydata(corners, [], triangles)
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    nodes = material.node_tree
    nodes.nodes.clear()
    diffuse, output = nodes.nodes.new("ShaderNodeBsdfDiffuse"), nodes.nodes.new("ShaderNodeOutputMaterial")
    nodes.links.new(diffuse.outputs[0], output.inputs[0])
    mesh.materials.append(material)
    add("mesh", mesh, mathutils.Matrix.Diagonal((*document["nodes"][0]["scale"], 1)))


def add_light(document):
    case = document["extras"]
    light = bpy.data.lights.new("light", "SUN" if "sun" in case else "POINT")
    if "sun" in case:
        light.angle, light.energy = 0, 1e6
    else:
        light.shadow_soft_size, light.energy = 0, 1e15
    add("light", light, matrix(document["nodes"][2]["matrix"]))


def set_up(scene):
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device, cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = "CPU", 1, False, False
    cycles.max_bounces, cycles.pixel_filter_type, cycles.filter_width, cycles.seed = 0, "BOX", 0.01, 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0
    render = scene.render
    render.resolution_x = render.resolution_y = cases.SIZE
    render.resolution_percentage, render.dither_intensity, render.film_transparent = 100, 0, True
    render.image_settings.file_format, render.image_settings.color_mode = "PNG", "RGB"
    scene.view_settings.view_transform = "Raw"
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0, 0, 0)


def draw(path, output):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    set_up(scene)
    document, corners, triangles = cases.read_glb(path.read_bytes())
    add_mesh(document, corners, triangles)
    add_light(document)
    camera = bpy.data.cameras.new("camera")
    camera.angle = math.radians(document["extras"]["fov_y"])
    camera.clip_start, camera.clip_end = 0.01, 1e5
    scene.camera = add("camera", camera, matrix(document["nodes"][1]["matrix"]))
    scene.render.filepath = str(output)
    bpy.ops.render.render(write_still=True)


def main():
    folder, masks = map(pathlib.Path, sys.argv[sys.argv.index("--") + 1 :])
    for path in sorted(folder.glob("*.glb")):
        if not (masks / f"{path.stem}.png").exists():
            draw(path, masks / f"{path.stem}.png")


main()
