"""Renders scenes with Cycles, by Blender's Python module bpy.

Opaque balls are points of a point cloud, the only exact spheres of Cycles. Balls of glass are meshes with exact
normals. Spherical lamps are point lights with a radius. Coordinates are not changed: y is up."""

import math
import re
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix, Vector

from geometry import index_of, pixels, sphere_mesh

FEW_LIGHTS = 16  # up to this number of lights the light tree costs more than it gains


class Shader:
    """The node tree of a material or a world."""

    def __init__(self, owner):
        owner.use_nodes = True
        self.tree = owner.node_tree
        self.tree.nodes.clear()

    def node(self, kind, inputs=(), **settings):
        """Adds a node and returns its first output. An input is the output of another node, or a value."""
        node = self.tree.nodes.new("ShaderNode" + kind)
        for name, value in settings.items():
            setattr(node, name, value)
        for name, value in dict(inputs).items():
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, node.inputs[name])
            else:
                node.inputs[name].default_value = value
        return node.outputs[0] if node.outputs else None

    def color(self, color, space="Linear Rec.709"):
        """Returns a colour as an input: a value or the output of a texture node."""
        if "cell" in color:  # Color1 is the colour of cells whose indices have an odd sum
            return self.node("TexChecker", {"Vector": self.node("NewGeometry"), "Color1": rgba(color["odd"]),
                                            "Color2": rgba(color["even"]), "Scale": 1 / color["cell"]})
        if "picture" in color:
            return self.node("TexImage", image=image_of(pixels(color["picture"]), space), interpolation="Linear",
                             extension="REPEAT")
        return rgba(color)


def rgba(color):
    return [*map(float, color), 1.0]


def image_of(values, space="Linear Rec.709"):
    """Returns a Blender image of an array. The rows of the array go from the top, those of Blender from the bottom."""
    height, width, _ = values.shape
    made = bpy.data.images.new("picture", width, height, float_buffer=True)
    made.colorspace_settings.name = space
    rows = np.concatenate([values, np.ones((height, width, 1), np.float32)], axis=2)
    made.pixels.foreach_set(rows[::-1].ravel())
    made.pack()
    return made


def material_of(told, tinted=False):
    """Returns a Blender material. If `tinted` is true, its colour is an attribute of the points."""
    # Make a medium.
    made = bpy.data.materials.new(told["kind"])
    shader = Shader(made)
    if told["kind"] == "medium":
        scattering = told["density"] * np.array(told["albedo"])
        shader.node("OutputMaterial", {"Volume": shader.node("VolumeCoefficients", {
            "Absorption Coefficients": told["density"] - scattering, "Scatter Coefficients": scattering,
            "Anisotropy": 0.0})})
        return made
    # Make the nodes of a surface's colour and normal.
    color = shader.node("Attribute", attribute_name="tint") if tinted else shader.color(told.get("color", (1, 1, 1)))
    inputs = {"Color": color, "Roughness": math.sqrt(told.get("alpha", 0))}
    if "normal_map" in told:
        inputs["Normal"] = shader.node("NormalMap", {"Color": shader.color(told["normal_map"], "Non-Color")})
    # Make the node that scatters or emits.
    if told["kind"] == "lambertian":
        surface = shader.node("BsdfDiffuse", inputs)
    elif told["kind"] == "mirror":
        surface = shader.node("BsdfAnisotropic", inputs)
    elif told["kind"] == "rough-conductor":
        del inputs["Color"]
        inputs["IOR"], inputs["Extinction"] = index_of(told)
        surface = shader.node("BsdfMetallic", inputs, fresnel_type="PHYSICAL_CONDUCTOR", distribution="GGX")
    elif told["kind"] in ("glass", "rough-glass"):
        surface = shader.node("BsdfGlass", {**inputs, "IOR": told["index"]}, distribution="GGX")
    else:
        surface = shader.node("Emission", {"Color": color, "Strength": 1.0})
        made.cycles.emission_sampling = "FRONT_BACK"
    # Make the holes.
    if "opacity" in told:
        opacity = told["opacity"]
        share = shader.color(opacity, "Non-Color") if "picture" in opacity else opacity[0]
        surface = shader.node("MixShader", {0: share, 1: shader.node("BsdfTransparent"), 2: surface})
    shader.node("OutputMaterial", {"Surface": surface})
    return made


def add(data, material=None):
    made = bpy.data.objects.new(data.name, data)
    bpy.context.scene.collection.objects.link(made)
    if material is not None:
        data.materials.append(material)
    return made


def add_mesh(told, material):
    data = bpy.data.meshes.new("mesh")
    data.from_pydata(told["vertices"].tolist(), [], told["triangles"].tolist())
    if told["uvs"] is not None:
        data.uv_layers.new(name="uv").data.foreach_set("uv", told["uvs"][told["triangles"].ravel()].ravel())
    if told["normals"] is not None:
        data.shade_smooth()
        data.normals_split_custom_set_from_vertices(told["normals"].tolist())
    add(data, material)


def add_points(spheres, tinted):
    """Adds balls of one kind of material as a point cloud. Blender can only make it from a mesh, of their centres."""
    data = bpy.data.meshes.new("centres")
    data.from_pydata([s["center"] for s in spheres], [], [])
    data.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", [s["radius"] for s in spheres])
    if tinted:
        data.attributes.new("tint", "FLOAT_COLOR", "POINT").data.foreach_set(
            "color", [c for s in spheres for c in rgba(s["material"]["color"])])
    made = add(data, material_of(spheres[0]["material"], tinted))
    bpy.ops.object.select_all(action="DESELECT")
    made.select_set(True)
    bpy.context.view_layer.objects.active = made
    bpy.ops.object.convert(target="POINTCLOUD")


def add_spheres(spheres):
    clouds = {}
    for sphere in spheres:
        material = sphere["material"]
        if material["kind"] == "light":
            add_ball_of_light(sphere)
        elif material["kind"] in ("glass", "rough-glass"):
            add_mesh(sphere_mesh(sphere, 64), material_of(material))
        else:
            clouds.setdefault(("cell" in material["color"], material["kind"]), []).append(sphere)
    for (checkered, _), balls in sorted(clouds.items()):  # Cycles loses the tints unless their cloud is added first
        add_points(balls, tinted=not checkered)


def add_light(kind, power):
    light = bpy.data.lights.new("light", kind)
    light.color, light.energy = np.array(power) / max(power), max(power)
    return light, add(light)


def add_ball_of_light(sphere):
    light, made = add_light("POINT", 4 * math.pi**2 * sphere["radius"] ** 2 * np.array(sphere["material"]["color"]))
    light.shadow_soft_size = sphere["radius"]
    light.use_soft_falloff = False
    made.location = sphere["center"]
    made.visible_camera = True


def add_sun(sun):
    light, made = add_light("SUN", sun["irradiance"])
    light.angle = math.radians(2 * sun["angular_radius"])
    made.rotation_mode = "QUATERNION"
    made.rotation_quaternion = Vector(sun["direction"]).to_track_quat("-Z", "Y")


def add_sky(scene):
    world = bpy.context.scene.world = bpy.data.worlds.new("sky")
    shader = Shader(world)
    if np.ndim(scene.sky) == 3:
        # Turn the map: z is up in Blender's maps, y in the scene.
        turn = Matrix(((0, 0, -1), (-1, 0, 0), (0, 1, 0))).to_euler()
        around = shader.node("Mapping", {"Vector": shader.node("TexCoord"), "Rotation": turn}, vector_type="VECTOR")
        color = shader.node("TexEnvironment", {"Vector": around}, image=image_of(scene.sky), interpolation="Linear",
                            projection="EQUIRECTANGULAR")
    else:
        color = rgba(scene.sky or (0, 0, 0))
    shader.node("OutputWorld", {"Surface": shader.node("Background", {"Color": color, "Strength": 1.0})})
    world.cycles.sampling_method = "AUTOMATIC" if scene.has_map else "NONE"


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
    made = bpy.context.scene.camera = add(data)
    made.matrix_world = Matrix([[*row, c] for row, c in zip(zip(right, back.cross(right), back), eye)]
                               + [[0, 0, 0, 1]])


class Peer:
    about = f"Cycles of Blender {bpy.app.version_string}, tabulated Sobol, light tree from {FEW_LIGHTS + 1} lights on"

    def open(self, scene):
        # Add the scene.
        bpy.ops.wm.read_factory_settings(use_empty=True)
        add_spheres(scene.spheres)
        for mesh in scene.meshes:
            add_mesh(mesh, material_of(mesh["material"]))
        for medium in scene.media:
            add_mesh(medium["boundary"], material_of({**medium, "kind": "medium"}))
        for sun in scene.suns:
            add_sun(sun)
        add_sky(scene)
        add_camera(scene.camera)
        # Set the integrator.
        render, cycles = bpy.context.scene.render, bpy.context.scene.cycles
        render.engine, cycles.device = "CYCLES", "CPU"
        render.use_persistent_data = True
        render.threads_mode, render.resolution_percentage = "FIXED", 100
        images = render.image_settings
        images.file_format, images.color_depth, images.color_mode = "OPEN_EXR", "32", "RGB"
        for name in ("max", "diffuse", "glossy", "transmission", "volume"):
            # Cycles does not count the segments from the camera and to a light.
            setattr(cycles, f"{name}_bounces", max(0, scene.max_depth - 2))
        cycles.transparent_max_bounces = 64
        cycles.caustics_reflective = cycles.caustics_refractive = True
        cycles.blur_glossy = cycles.light_sampling_threshold = 0
        cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
        cycles.use_adaptive_sampling = cycles.use_denoising = cycles.use_guiding = cycles.use_auto_tile = False
        cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
        cycles.sampling_pattern = "TABULATED_SOBOL"
        cycles.use_light_tree = sum(s["material"]["kind"] == "light" for s in scene.spheres + scene.meshes) > FEW_LIGHTS

    def render(self, path, size, spp, seed, threads):
        scene = bpy.context.scene
        scene.render.resolution_x = scene.render.resolution_y = size
        scene.render.threads, scene.render.filepath = threads, path
        scene.cycles.samples, scene.cycles.seed = spp, seed
        bpy.ops.render.render(write_still=True)
        # Read the seconds of sampling in the header of the picture.
        time = re.search(rb"cycles\.[^\0]*\.render_time\0string\0....(\d\d):(\d\d\.\d\d)", Path(path).read_bytes(),
                         re.DOTALL)
        return 60 * int(time[1]) + float(time[2]), spp
