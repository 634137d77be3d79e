#!/usr/bin/env python3
"""Writes still_life.glb beside this file: a copper jug with leaves, and fruit, on a table by a window.

Most shapes are surfaces of revolution. The images are made of noise. The model therefore has the licence of limn. The
leaves have alpha. Table, wall and oranges have normal maps. The matte materials have an index of refraction of 1, and
therefore no clear coat. The script needs only Python.
"""

import json
import math
import struct
import zlib
from pathlib import Path

FLOAT, USHORT = 5126, 5123
TURN = 2 * math.pi


# ---- images: lists of rows from the top, each a list of tuples of bytes ----------------------------------------------


def hashed(x, y, seed):
    """Returns a pseudorandom number in [0, 1] for whole numbers x and y."""
    h = (x * 374761393 + y * 668265263 + seed * 2246822519) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFF) / 0xFFFF


def smooth(t):
    return t * t * (3 - 2 * t)


def noise(u, v, cells_u, cells_v, seed):
    """Returns smooth noise in [0, 1] with period 1 in u and v."""
    x, y = u * cells_u, v * cells_v
    i, j = math.floor(x), math.floor(y)
    s, t = smooth(x - i), smooth(y - j)
    at = lambda a, b: hashed(a % cells_u, b % cells_v, seed)
    return ((at(i, j) * (1 - s) + at(i + 1, j) * s) * (1 - t) + (at(i, j + 1) * (1 - s) + at(i + 1, j + 1) * s) * t)


def layers(u, v, cells_u, cells_v, seed, count):
    """Returns the mean of `count` octaves of noise, each with half the weight of the one before."""
    return sum(noise(u, v, cells_u << k, cells_v << k, seed + k) / 2**k for k in range(count)) / (2 - 2 ** (1 - count))


def mixed(a, b, t):
    t = min(1.0, max(0.0, t))
    return [x + (y - x) * t for x, y in zip(a, b)]


def srgb(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


def byte(value):
    return round(255 * min(1.0, max(0.0, value)))


def picture(width, height, color):
    """Returns the image of a function of (u, v), v upward, that returns linear red, green, blue and perhaps alpha."""
    rows = []
    for y in range(height):
        row = []
        for x in range(width):
            c = color((x + 0.5) / width, 1 - (y + 0.5) / height)
            # An image whose lowest bit is cleared compresses better.
            row.append(tuple(byte(srgb(k)) & 0xFE for k in c[:3]) + tuple(byte(k) for k in c[3:]))
        rows.append(row)
    return rows


def normal_map(width, height, relief, depth, aspect=1):
    """Returns the normal map of a relief, a periodic function of (u, v). A value of 1 is `depth` high, in units of the
    length that u spans. This length is `aspect` times the length that v spans. The lowest two bits are cleared."""
    values = [[relief((x + 0.5) / width, 1 - (y + 0.5) / height) for x in range(width)] for y in range(height)]
    rows = []
    for y in range(height):
        row = []
        for x in range(width):
            du = (values[y][(x + 1) % width] - values[y][x - 1]) * width / 2 * depth
            dv = (values[y - 1][x] - values[(y + 1) % height][x]) * height / 2 * depth * aspect
            length = math.sqrt(du * du + dv * dv + 1)
            row.append(tuple(byte(0.5 + 0.5 * k / length) & 0xFC for k in (-du, -dv, 1)))
        rows.append(row)
    return rows


def png(rows):
    """Returns the bytes of a PNG file. Each line is filtered by the difference from the line above."""
    channels = len(rows[0][0])
    chunk = lambda kind, data: (struct.pack(">I", len(data)) + kind + data
                                + struct.pack(">I", zlib.crc32(kind + data)))
    lines = [b"".join(bytes(p) for p in row) for row in rows]
    packed = bytearray()
    before = bytes(len(lines[0]))
    for line in lines:
        packed += b"\2" + bytes((a - b) & 255 for a, b in zip(line, before))
        before = line
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(packed), 9))
            + chunk(b"IEND", b""))


def planks(v):
    """Returns which of four planks is at v, and the distance from its edges."""
    at = 4 * v
    return math.floor(at), min(at % 1, 1 - at % 1)


def wood_relief(u, v):
    plank, edge = planks(v)
    grain = noise(u, v, 6, 96, 11 + plank)
    return min(1.0, edge * 25) * (0.75 + 0.25 * grain)


def wood_color(u, v):
    plank, edge = planks(v)
    wave = layers(u, v, 3, 12, 40 + plank, 2)
    ring = 0.5 + 0.5 * math.sin(TURN * (9 * wave + 5 * v + 0.37 * plank))
    color = mixed((0.30, 0.15, 0.065), (0.18, 0.08, 0.032), ring * (0.6 + 0.4 * noise(u, v, 8, 128, 3)))
    return mixed((0.03, 0.015, 0.008), color, edge * 40)


def peel_relief(u, v):
    """Returns the height of the pores of an orange. There are none at the poles."""
    return layers(u, v, 48, 24, 7, 2) * smooth(min(1.0, 6 * min(v, 1 - v)))


def apple_color(u, v):
    streaks = noise(u, v, 40, 3, 5)
    red = 0.9 * layers(u, v, 3, 2, 8, 2) + 0.5 * streaks + 0.5 * v - 0.35
    color = mixed((0.55, 0.38, 0.05), (0.42, 0.022, 0.012), 2 * red)
    return mixed((0.12, 0.09, 0.02), color, 9 * min(v, 1 - v))


def leaf_color(u, v):
    across, half = abs(u - 0.5), 0.46 * math.sin(math.pi * min(1.0, max(0.0, v)) ** 0.8) ** 0.75
    half *= 0.96 + 0.04 * math.sin(TURN * 14 * v)  # the edge is toothed
    vein = min(across * 40, 3 * abs(((v - 1.2 * across) * 9) % 1 - 0.5) * 2 + 6 * (0.06 - across))
    color = mixed((0.16, 0.28, 0.05), (0.045, 0.13, 0.018), vein)
    shade = 0.75 + 0.5 * layers(u, v, 6, 10, 21, 2)
    stalk = 0.02 if v < 0.12 else 0.0
    alpha = min(1.0, max(0.0, 0.5 + 64 * (max(half, stalk) - across)))
    return [shade * c for c in color] + [alpha]


def plaster_relief(u, v):
    return layers(u, v, 12, 12, 30, 3)


# ---- shapes: positions, normals, uvs, triangles ----------------------------------------------------------------------


def lathe(profile, steps=56):
    """Returns the surface of revolution of a profile, a list of (radius, height). If the profile is drawn to the right
    of the axis, the outside is on the right of the way from its first to its last point."""
    n = len(profile)
    lengths = [0.0]
    for (r0, h0), (r1, h1) in zip(profile, profile[1:]):
        lengths.append(lengths[-1] + math.hypot(r1 - r0, h1 - h0))
    positions, normals, uvs = [], [], []
    for k, (r, h) in enumerate(profile):
        (r0, h0), (r1, h1) = profile[max(0, k - 1)], profile[min(n - 1, k + 1)]
        dr, dh = r1 - r0, h1 - h0
        scale = 1 / math.hypot(dr, dh)
        for i in range(steps + 1):
            c, s = math.cos(TURN * i / steps), math.sin(TURN * i / steps)
            positions.append((r * c, h, -r * s))
            normal = (dh * scale * c, -dr * scale, -dh * scale * s)
            normals.append((0.0, math.copysign(1, -dr), 0.0) if r == 0 else normal)
            uvs.append((i / steps, lengths[k] / lengths[-1]))
    triangles = []
    for k in range(n - 1):
        for i in range(steps):
            a, b = k * (steps + 1) + i, (k + 1) * (steps + 1) + i
            triangles += [(a, a + 1, b + 1)] if profile[k][0] > 0 else []
            triangles += [(a, b + 1, b)] if profile[k + 1][0] > 0 else []
    return positions, normals, uvs, triangles


def curve(points, steps):
    """Returns points of the Catmull-Rom spline through the given points. A negative radius becomes 0."""
    made = []
    for k in range(len(points) - 1):
        p = [points[max(0, min(len(points) - 1, k + d))] for d in (-1, 0, 1, 2)]
        for i in range(steps):
            t = i / steps
            made.append(tuple(b + 0.5 * t * ((c - a) + t * ((2 * a - 5 * b + 4 * c - d) + t * (3 * (b - c) + d - a)))
                              for a, b, c, d in zip(*p)))
    return [(max(r, 0.0), h) for r, h in made + [points[-1]]]


def sphere(radius, rings=32):
    polar = [math.pi * k / rings for k in range(rings + 1)]
    return lathe([(radius * math.sin(a) if 0 < k < rings else 0.0, -radius * math.cos(a))
                  for k, a in enumerate(polar)])


def quad(corner, u, v, repeat=(1, 1)):
    add = lambda *all_of: tuple(sum(c) for c in zip(*all_of))
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    length = math.sqrt(sum(c * c for c in n))
    n = tuple(c / length for c in n)
    return ([corner, add(corner, u), add(corner, u, v), add(corner, v)], [n] * 4,
            [(0, 0), (repeat[0], 0), repeat, (0, repeat[1])], [(0, 1, 2), (0, 2, 3)])


def joined(*shapes):
    """Returns several shapes as one."""
    whole = ([], [], [], [])
    for shape in shapes:
        first = len(whole[0])
        for k in range(3):
            whole[k].extend(shape[k])
        whole[3].extend(tuple(first + i for i in t) for t in shape[3])
    return whole


def leaf(root, heading, rise, droop, length, width, twist, steps=8):
    """Returns a leaf, a strip of triangles that begins at `root` in the direction of the angle `heading`. Its angle of
    elevation is `rise` at the root and falls by `droop` over its length. `twist` turns it about its midrib."""
    positions, normals, uvs = [], [], []
    at = list(root)
    for k in range(steps + 1):
        t = k / steps
        angle = rise - droop * t
        along = (math.cos(angle) * math.cos(heading), math.sin(angle), math.cos(angle) * math.sin(heading))
        upward = (-math.sin(angle) * math.cos(heading), math.cos(angle), -math.sin(angle) * math.sin(heading))
        side = (along[1] * upward[2] - along[2] * upward[1], along[2] * upward[0] - along[0] * upward[2],
                along[0] * upward[1] - along[1] * upward[0])
        c, s = math.cos(twist * t), math.sin(twist * t)
        across = [c * a + s * b for a, b in zip(side, upward)]
        normal = [c * b - s * a for a, b in zip(side, upward)]
        for sign in (-1, 1):
            fold = 0.12 * width  # the sides are higher than the midrib
            positions.append(tuple(p + 0.5 * sign * width * a + fold * n for p, a, n in zip(at, across, normal)))
            normals.append(tuple(normal))
            uvs.append((0.5 + 0.5 * sign, t))
        at = [p + length / steps * a for p, a in zip(at, along)]
    triangles = [t for k in range(steps) for t in ((2 * k, 2 * k + 1, 2 * k + 3), (2 * k, 2 * k + 3, 2 * k + 2))]
    return positions, normals, uvs, triangles


def leaves():
    """Returns the leaves, which begin in the mouth of the jug."""
    made = []
    for k in range(26):
        heading = 2.39996 * k + 0.5 * hashed(k, 0, 1)
        rise = 1.45 - 0.9 * (k / 26) - 0.25 * hashed(k, 1, 1)
        length, droop = 1.9 + 0.9 * hashed(k, 2, 1), 0.6 + 0.9 * hashed(k, 3, 1)
        root = (0.3 * math.cos(heading), 3.3, 0.3 * math.sin(heading))
        made.append(leaf(root, heading, rise, droop, length, 0.36 * length, 0.8 * (hashed(k, 4, 1) - 0.5)))
    return joined(*made)


# ---- the file --------------------------------------------------------------------------------------------------------


class Glb:
    """A binary glTF file. The methods add a part and return its index."""

    def __init__(self):
        self.data = bytearray()
        self.json = {"asset": {"version": "2.0", "generator": "limn's examples/models/still_life.py"}, "scene": 0,
                     "extensionsUsed": ["KHR_materials_ior", "KHR_materials_emissive_strength"],
                     "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [], "accessors": [],
                     "bufferViews": [], "textures": [], "images": [], "samplers": [{"magFilter": 9729}], "cameras": []}

    def append(self, name, entry):
        self.json[name].append(entry)
        return len(self.json[name]) - 1

    def view(self, data):
        at = len(self.data)
        self.data += data + bytes(-len(data) % 4)
        return self.append("bufferViews", {"buffer": 0, "byteOffset": at, "byteLength": len(data)})

    def accessor(self, rows, kind, component):
        flat = [x for row in rows for x in row] if kind != "SCALAR" else rows
        entry = {"bufferView": self.view(struct.pack(f"<{len(flat)}{'f' if component == FLOAT else 'H'}", *flat)),
                 "componentType": component, "count": len(rows), "type": kind}
        if kind == "VEC3":
            rounded = [struct.unpack("<3f", struct.pack("<3f", *row)) for row in rows]
            entry.update(min=[min(c) for c in zip(*rounded)], max=[max(c) for c in zip(*rounded)])
        return self.append("accessors", entry)

    def texture(self, name, rows):
        image = self.append("images", {"name": name, "mimeType": "image/png", "bufferView": self.view(png(rows))})
        return {"index": self.append("textures", {"source": image, "sampler": 0})}

    def matte(self, name, color=(1, 1, 1), **more):
        """Adds a diffuse material without a clear coat."""
        pbr = {"baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": 1}
        if "picture" in more:
            pbr["baseColorTexture"] = more.pop("picture")
        return self.append("materials", {"name": name, "doubleSided": True, "pbrMetallicRoughness": pbr,
                                         "extensions": {"KHR_materials_ior": {"ior": 1}}, **more})

    def metal(self, name, color, roughness):
        return self.append("materials", {"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": [*color, 1], "metallicFactor": 1, "roughnessFactor": roughness}})

    def lamp(self, name, radiance):
        strength = max(radiance)
        return self.append("materials", {
            "name": name, "doubleSided": True, "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]},
            "emissiveFactor": [c / strength for c in radiance],
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}})

    def mesh(self, name, shape, material):
        positions, normals, uvs, triangles = shape
        attributes = {"POSITION": self.accessor(positions, "VEC3", FLOAT),
                      "NORMAL": self.accessor(normals, "VEC3", FLOAT),
                      "TEXCOORD_0": self.accessor([(u, 1 - v) for u, v in uvs], "VEC2", FLOAT)}
        indices = self.accessor([i for t in triangles for i in t], "SCALAR", USHORT)
        return self.append("meshes", {"name": name, "primitives": [
            {"attributes": attributes, "indices": indices, "material": material}]})

    def node(self, **entry):
        self.json["scenes"][0]["nodes"].append(self.append("nodes", entry))

    def place(self, name, mesh, at, axis=(0, 1, 0), degrees=0, scale=1):
        half = math.radians(degrees) / 2
        self.node(name=name, mesh=mesh, translation=at, scale=[scale] * 3,
                  rotation=[math.sin(half) * c for c in axis] + [math.cos(half)])

    def look(self, name, eye, target, degrees):
        back = [a - b for a, b in zip(eye, target)]
        yaw = math.atan2(back[0], back[2])
        pitch = -math.atan2(back[1], math.hypot(back[0], back[2]))
        (sy, cy), (sp, cp) = ((math.sin(a / 2), math.cos(a / 2)) for a in (yaw, pitch))
        camera = self.append("cameras", {"name": name, "type": "perspective", "perspective": {
            "yfov": math.radians(degrees), "znear": 0.1}})
        self.node(name=name, camera=camera, translation=eye, rotation=[cy * sp, sy * cp, -sy * sp, cy * cp])

    def write(self, path):
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.json, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        length = 12 + 8 + len(text) + 8 + len(self.data)
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, length) + struct.pack("<I4s", len(text), b"JSON") + text
                         + struct.pack("<I4s", len(self.data), b"BIN\0") + bytes(self.data))


def main():
    # Add the materials.
    glb = Glb()
    wood = glb.matte("wood", picture=glb.texture("wood", picture(256, 384, wood_color)),
                     normalTexture=glb.texture("wood relief", normal_map(128, 384, wood_relief, 0.004)))
    plaster = glb.matte("plaster", (0.24, 0.215, 0.18),
                        normalTexture=glb.texture("plaster relief", normal_map(192, 192, plaster_relief, 0.012)))
    peel = glb.matte("orange peel", (0.75, 0.23, 0.015),
                     normalTexture=glb.texture("peel relief", normal_map(384, 192, peel_relief, 0.006, 2)))
    apple_skin = glb.matte("apple", picture=glb.texture("apple", picture(128, 64, apple_color)))
    green = glb.matte("leaf", picture=glb.texture("leaf", picture(96, 192, leaf_color)), alphaMode="BLEND")
    clay = glb.matte("clay", (0.62, 0.58, 0.5))
    copper, pewter = glb.metal("copper", (0.93, 0.55, 0.39), 0.28), glb.metal("pewter", (0.6, 0.58, 0.55), 0.4)
    window = glb.lamp("window", (17, 16, 14))

    # Make the shapes.
    table = joined(quad((-9, 0, 4.5), (18, 0, 0), (0, 0, -9), (2, 1)),
                   quad((-9, -0.5, 4.5), (18, 0, 0), (0, 0.5, 0), (2, 0.05)))
    jug = curve([(0, 0), (1.0, 0.0), (1.12, 0.08), (1.5, 0.9), (1.45, 1.7), (0.9, 2.6), (0.72, 3.1), (0.95, 3.55),
                 (1.0, 3.62), (0.93, 3.6), (0.66, 3.1), (0.8, 2.6), (1.3, 1.7), (1.3, 0.9), (0, 0.2)], 4)
    bowl = curve([(0, 0), (0.8, 0), (0.85, 0.1), (0.8, 0.2), (1.6, 0.6), (2.1, 1.25), (2.15, 1.3), (2.05, 1.28),
                  (1.5, 0.72), (0.7, 0.35), (0, 0.32)], 4)
    apple = curve([(0, 0.12), (0.25, 0.02), (0.55, 0.12), (0.86, 0.6), (0.92, 1.0), (0.7, 1.45), (0.35, 1.56),
                   (0.12, 1.42), (0, 1.3)], 4)
    stem = lathe([(0.0, 0), (0.045, 0), (0.035, 0.35), (0.05, 0.42), (0.0, 0.43)], 12)

    # Place the objects.
    glb.place("table", glb.mesh("table", table, wood), (0, 0, 0))
    glb.place("wall", glb.mesh("wall", quad((-20, -4, -4.5), (40, 0, 0), (0, 20, 0), (8, 4)), plaster), (0, 0, 0))
    glb.place("window", glb.mesh("window", quad((-11, 2, 7), (0, 6, 0), (4, 0, 3.5)), window), (0, 0, 0))
    glb.place("jug", glb.mesh("jug", lathe(jug), copper), (-1.9, 0, -1.2))
    glb.place("leaves", glb.mesh("leaves", leaves(), green), (-1.9, 0, -1.2))
    glb.place("bowl", glb.mesh("bowl", lathe(bowl), pewter), (2.3, 0, -0.6))
    orange, fruit, stalk = (glb.mesh("orange", sphere(0.85), peel), glb.mesh("apple", lathe(apple), apple_skin),
                            glb.mesh("stalk", stem, clay))
    for i, (at, axis, turn) in enumerate((((1.75, 1.3, -0.3), (1, 0, 0.3), 50), ((3.05, 1.3, -0.55), (0.2, 0, 1), -70),
                                          ((2.35, 1.4, -1.35), (1, 0, 0), 20), ((0.15, 0.85, 1.5), (1, 0, 1), 110))):
        glb.place(f"orange {i + 1}", orange, at, [c / math.hypot(*axis) for c in axis], turn)
    for i, (at, turn) in enumerate((((-0.75, -0.02, 2.2), 40), ((4.9, -0.02, 1.3), 150), ((-3.9, -0.02, 0.9), 250))):
        glb.place(f"apple {i + 1}", fruit, at, degrees=turn)
        glb.place(f"stalk {i + 1}", stalk, (at[0], 1.2, at[2]), (0, 0, 1), -12)
    # Add the camera and write the file.
    glb.look("front", (0.6, 4.4, 14), (0.4, 2.15, -0.5), 32)
    glb.write(Path(__file__).with_suffix(".glb"))


if __name__ == "__main__":
    main()
