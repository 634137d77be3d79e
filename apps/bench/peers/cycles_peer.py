"""Scenes of the report in Cycles, through Blender's Python module.

Opaque balls are points of a point cloud, its only exact spheres; those of glass, which points cannot be, are meshes
with exact normals. A ball of light is Blender's point light, which has a radius. Coordinates stay as they are, y up.
"""

import math
import re
import tempfile
import time
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix, Vector

from geometry import is_checker, is_picture, lifted, pixels, quads_mesh, sphere_mesh

LIFT = 0.02  # of media, off the floor
FEW_LIGHTS = 16  # up to here the light tree costs more than it gives


def node_tree(owner):
    owner.use_nodes = True
    owner.node_tree.nodes.clear()
    return owner.node_tree


class Shader:
    """Nodes by short names."""

    def __init__(self, owner):
        self.tree = node_tree(owner)

    def node(self, kind, inputs=(), **settings):
        node = self.tree.nodes.new(kind)
        for name, value in settings.items():
            setattr(node, name, value)
        for name, value in dict(inputs).items():
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[name])
            else:
                node.inputs[name].default_value = value
        return node

    def output(self, kind, slot, value):
        self.node(kind, {slot: value})


def rgba(color):
    return [float(c) for c in color] + [1.0]


def image_of(values, color_space="Linear Rec.709"):
    """Rows from the top, as a Blender image, whose rows begin at the bottom."""
    height, width, _ = values.shape
    made = bpy.data.images.new("picture", width, height, float_buffer=True)
    made.colorspace_settings.name = color_space
    made.pixels.foreach_set(np.concatenate([values[::-1], np.ones((height, width, 1), np.float32)], axis=2).ravel())
    made.pack()
    return made


def picture_node(shader, color, color_space="Linear Rec.709"):
    return shader.node("ShaderNodeTexImage", image=image_of(pixels(color["picture"]), color_space),
                       interpolation="Linear", extension="REPEAT").outputs["Color"]


def material_of(told, tinted=False):
    """A Blender material; `tinted`: the colour is an attribute of the points."""
    made = bpy.data.materials.new(told["kind"])
    made.use_backface_culling = False
    shader = Shader(made)
    if tinted:
        color = shader.node("ShaderNodeAttribute", attribute_name="tint").outputs["Color"]
    elif is_checker(told.get("color")):
        position = shader.node("ShaderNodeNewGeometry").outputs["Position"]
        c = told["color"]
        # Its first colour is where the sum of the whole parts is odd.
        color = shader.node("ShaderNodeTexChecker", {"Vector": position, "Color1": rgba(c["odd"]),
                                                     "Color2": rgba(c["even"]), "Scale": 1 / c["cell"]}).outputs["Color"]
    elif is_picture(told.get("color")):
        color = picture_node(shader, told["color"])
    else:
        color = rgba(told.get("color", (1, 1, 1)))
    bent = {}
    if "normal_map" in told:
        normals = picture_node(shader, told["normal_map"], "Non-Color")
        bent = {"Normal": shader.node("ShaderNodeNormalMap", {"Color": normals}, space="TANGENT").outputs[0]}
    if told["kind"] == "lambertian":
        surface = shader.node("ShaderNodeBsdfDiffuse", {"Color": color, "Roughness": 0.0, **bent}).outputs[0]
    elif told["kind"] == "rough-conductor":
        surface = shader.node("ShaderNodeBsdfMetallic", {
            "IOR": told["eta"], "Extinction": told["k"], "Roughness": math.sqrt(told["alpha"]), **bent,
        }, fresnel_type="PHYSICAL_CONDUCTOR", distribution="GGX").outputs[0]
    elif told["kind"] == "rough-glass":
        surface = shader.node("ShaderNodeBsdfGlass", {
            "Color": color, "Roughness": math.sqrt(told["alpha"]), "IOR": told["index"], **bent,
        }, distribution="GGX").outputs[0]
    elif told["kind"] == "mirror":
        surface = shader.node("ShaderNodeBsdfAnisotropic", {"Color": color, "Roughness": 0.0}).outputs[0]
    elif told["kind"] == "glass":
        surface = shader.node("ShaderNodeBsdfGlass", {"Color": color, "Roughness": 0.0, "IOR": told["index"]}).outputs[0]
    else:
        surface = shader.node("ShaderNodeEmission", {"Color": color, "Strength": 1.0}).outputs[0]
        made.cycles.emission_sampling = "FRONT_BACK"
    if "opacity" in told:
        stopped = picture_node(shader, told["opacity"], "Non-Color") if is_picture(told["opacity"]) else told["opacity"][0]
        through = shader.node("ShaderNodeBsdfTransparent").outputs[0]
        surface = shader.node("ShaderNodeMixShader", {0: stopped, 1: through, 2: surface}).outputs[0]
    shader.output("ShaderNodeOutputMaterial", "Surface", surface)
    return made


def medium_material(medium):
    made = bpy.data.materials.new("medium")
    shader = Shader(made)
    albedo, density = medium["albedo"], medium["density"]
    if not any(albedo):
        volume = shader.node("ShaderNodeVolumeAbsorption", {"Color": rgba(albedo), "Density": density})
    elif all(c == 1 for c in albedo):
        volume = shader.node("ShaderNodeVolumeScatter", {"Color": rgba(albedo), "Density": density, "Anisotropy": 0.0})
    else:
        raise ValueError("media that are neither black nor white")
    shader.output("ShaderNodeOutputMaterial", "Volume", volume.outputs[0])
    return made


def add(data, material=None):
    made = bpy.data.objects.new(data.name, data)
    bpy.context.scene.collection.objects.link(made)
    if material is not None:
        data.materials.append(material)
    return made


def add_mesh(vertices, triangles, material, normals=None, uvs=None):
    data = bpy.data.meshes.new("mesh")
    data.from_pydata(vertices.tolist(), [], triangles.tolist())
    if uvs is not None:
        data.uv_layers.new(name="uv").data.foreach_set("uv", uvs[triangles.ravel()].ravel())
    if normals is not None:
        data.shade_smooth()
        data.normals_split_custom_set_from_vertices(normals.tolist())
    return add(data, material)


def add_points(spheres, material):
    """Spheres of one material as a point cloud, made by geometry nodes from a mesh of their centres."""
    data = bpy.data.meshes.new("centres")
    data.from_pydata([s["center"] for s in spheres], [], [])
    radius = data.attributes.new("size", "FLOAT", "POINT")
    radius.data.foreach_set("value", [s["radius"] for s in spheres])
    if not is_checker(spheres[0]["material"]["color"]):
        tint = data.attributes.new("tint", "FLOAT_COLOR", "POINT")
        tint.data.foreach_set("color", [c for s in spheres for c in rgba(s["material"]["color"])])
    tree = bpy.data.node_groups.new("points", "GeometryNodeTree")
    for direction in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=direction, socket_type="NodeSocketGeometry")
    nodes = {name: tree.nodes.new(kind) for name, kind in (
        ("in", "NodeGroupInput"), ("size", "GeometryNodeInputNamedAttribute"), ("points", "GeometryNodeMeshToPoints"),
        ("material", "GeometryNodeSetMaterial"), ("out", "NodeGroupOutput"))}
    nodes["size"].data_type = "FLOAT"
    nodes["size"].inputs["Name"].default_value = "size"
    nodes["material"].inputs["Material"].default_value = material
    link = tree.links.new
    link(nodes["in"].outputs[0], nodes["points"].inputs["Mesh"])
    link(nodes["size"].outputs["Attribute"], nodes["points"].inputs["Radius"])
    link(nodes["points"].outputs[0], nodes["material"].inputs["Geometry"])
    link(nodes["material"].outputs[0], nodes["out"].inputs[0])
    add(data, material).modifiers.new("points", "NODES").node_group = tree


def add_ball_of_light(sphere):
    light = bpy.data.lights.new("ball", "POINT")
    light.shadow_soft_size = sphere["radius"]
    light.use_soft_falloff = False
    radiance, brightest = np.array(sphere["material"]["color"], float), max(sphere["material"]["color"])
    light.color = radiance / brightest
    light.energy = 4 * math.pi**2 * sphere["radius"] ** 2 * brightest
    made = add(light)
    made.location = sphere["center"]
    made.visible_camera = True


def add_sun(sun):
    light = bpy.data.lights.new("sun", "SUN")
    light.angle = math.radians(2 * sun["angular_radius"])
    brightest = max(sun["irradiance"])
    light.color, light.energy = np.array(sun["irradiance"]) / brightest, brightest
    add(light).rotation_mode = "QUATERNION"
    bpy.data.objects[light.name].rotation_quaternion = Vector(sun["direction"]).to_track_quat("-Z", "Y")


def environment_color(shader, environment):
    """Blender's maps are around +z, the middle +x turned to +y at the left; the scene's around +y, the middle -z."""
    direction = shader.node("ShaderNodeTexCoord").outputs["Generated"]
    parts = shader.node("ShaderNodeSeparateXYZ", {"Vector": direction}).outputs
    turned = {name: shader.node("ShaderNodeMath", {0: parts[name], 1: -1.0}, operation="MULTIPLY").outputs[0]
              for name in ("X", "Z")}
    around = shader.node("ShaderNodeCombineXYZ", {"X": turned["Z"], "Y": turned["X"], "Z": parts["Y"]}).outputs[0]
    return shader.node("ShaderNodeTexEnvironment", {"Vector": around}, image=image_of(environment),
                       interpolation="Linear", projection="EQUIRECTANGULAR").outputs["Color"]


def add_sky(background, environment):
    world = bpy.data.worlds.new("sky")
    bpy.context.scene.world = world
    shader = Shader(world)
    if environment is not None:
        color = environment_color(shader, environment)
    elif background["bottom"] == background["top"]:
        color = rgba(background["top"])
    else:
        direction = shader.node("ShaderNodeTexCoord").outputs["Generated"]
        upward = shader.node("ShaderNodeSeparateXYZ", {"Vector": direction}).outputs["Y"]
        raised = shader.node("ShaderNodeMath", {0: upward, 1: 1.0}, operation="ADD").outputs[0]
        share = shader.node("ShaderNodeMath", {0: raised, 1: 0.5}, operation="MULTIPLY").outputs[0]
        color = shader.node("ShaderNodeMixRGB", {"Fac": share, "Color1": rgba(background["bottom"]),
                                                 "Color2": rgba(background["top"])}).outputs[0]
    emission = shader.node("ShaderNodeBackground", {"Color": color, "Strength": 1.0}).outputs[0]
    shader.output("ShaderNodeOutputWorld", "Surface", emission)
    world.cycles.sampling_method = "NONE" if environment is None else "AUTOMATIC"


def add_camera(told):
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle = math.radians(told["vertical_fov"])
    data.clip_start, data.clip_end = 1e-3, 1e5
    if told["lens_radius"] > 0:
        data.dof.use_dof = True
        data.dof.focus_distance = told["focus_distance"]
        data.dof.aperture_fstop = data.lens * 1e-3 / (2 * told["lens_radius"])
    eye, target, up = (Vector(told[k]) for k in ("look_from", "look_at", "up"))
    back = (eye - target).normalized()
    right = up.cross(back).normalized()
    made = add(data)
    made.matrix_world = Matrix([[*row, c] for row, c in zip(zip(right, back.cross(right), back), eye)]
                               + [[0, 0, 0, 1]])
    bpy.context.scene.camera = made


def set_integrator(scene, lights):
    render, cycles = bpy.context.scene.render, bpy.context.scene.cycles
    render.engine = "CYCLES"
    render.use_persistent_data = True
    render.threads_mode = "FIXED"
    cycles.device = "CPU"
    bounces = max(0, scene.max_depth - 2)  # the camera's segment and that of the last light do not count
    for name in ("max", "diffuse", "glossy", "transmission", "volume"):
        setattr(cycles, f"{name}_bounces", bounces)
    cycles.transparent_max_bounces = 64
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.light_sampling_threshold = 0
    cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_guiding = False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    cycles.sampling_pattern = "TABULATED_SOBOL"
    cycles.use_light_tree = lights > FEW_LIGHTS
    cycles.use_auto_tile = False


class Peer:
    name = "Cycles"
    version = bpy.app.version_string
    settings = f"Blender {version}, CPU, tabulated Sobol, light tree from {FEW_LIGHTS + 1} lights on"

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory()
        images = bpy.context.scene.render.image_settings
        images.file_format, images.color_depth, images.color_mode = "OPEN_EXR", "32", "RGB"

    def open(self, scene):
        for blocks in (bpy.data.objects, bpy.data.meshes, bpy.data.lights, bpy.data.cameras, bpy.data.materials,
                       bpy.data.worlds, bpy.data.node_groups, bpy.data.images):
            for block in list(blocks):
                blocks.remove(block)
        points = {}
        for sphere in scene.spheres:
            told = sphere["material"]
            if told["kind"] == "light":
                add_ball_of_light(sphere)
            elif told["kind"] in ("glass", "rough-glass"):
                vertices, triangles, normals = sphere_mesh(sphere["center"], sphere["radius"],
                                                           rings=128 if len(scene.spheres) < 16 else 64)
                add_mesh(vertices, triangles, material_of(told), normals)
            else:
                points.setdefault((told["kind"], is_checker(told["color"])), []).append(sphere)
        # Attributes are lost where the first cloud has none.
        for (_, checkered), spheres in sorted(points.items(), key=lambda item: item[0][1]):
            add_points(spheres, material_of(spheres[0]["material"], tinted=not checkered))
        by_material = {}
        for quad in scene.quads:
            by_material.setdefault(str(quad["material"]), []).append(quad)
        for quads in by_material.values():
            add_mesh(*quads_mesh(quads), material_of(quads[0]["material"]))
        for mesh in scene.meshes:
            add_mesh(mesh["vertices"], mesh["triangles"], material_of(mesh["material"]), mesh["normals"], mesh["uvs"])
        for medium in scene.media:
            add_mesh(*quads_mesh(lifted(medium["boundary"]["quads"], LIFT)), medium_material(medium))
        for sun in scene.suns:
            add_sun(sun)
        add_sky(scene.background, scene.environment)
        add_camera(scene.camera)
        set_integrator(scene, sum(s["material"]["kind"] == "light" for s in scene.spheres + scene.quads))

    def render(self, size, spp, seed, threads):
        scene = bpy.context.scene
        scene.render.resolution_x = scene.render.resolution_y = size
        scene.render.resolution_percentage = 100
        scene.render.threads = threads
        scene.cycles.samples, scene.cycles.seed = spp, seed
        path = Path(self.folder.name) / "picture.exr"
        scene.render.filepath = str(path)
        start = time.perf_counter()
        bpy.ops.render.render(write_still=True)
        whole = time.perf_counter() - start
        return read_exr(path, size), seconds_in(path, whole), spp


def seconds_in(path, whole):
    """What Cycles says that the sampling took, in the header of its picture."""
    found = re.search(rb"cycles\.[^\0]*\.render_time\0string\0....(\d\d):(\d\d)\.(\d\d)", path.read_bytes(), re.DOTALL)
    if not found:
        return whole
    minutes, seconds, hundredths = (int(x) for x in found.groups())
    return 60 * minutes + seconds + 0.01 * hundredths


def read_exr(path, size):
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    pixels = np.empty(4 * size * size, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return pixels.reshape(size, size, 4)[::-1, :, :3]
