"""Defines the cases of the shadowtruth set (scene, light and view), and writes and reads their GLB files."""
import json
import math
import struct

from scenes import PER_METRE

SIZE = 512
# Directions to the sun, and positions of lamps as fractions of the scene's extent.
SUNS = ((0, 1, 0), (2, 7, 3), (3, 6, -2), (5, 7, 5), (-4, 4, 3), (7, 4, -4), (11, 4, -10), (-13, 3, 8), (19, 1, 2))
LOW_SUNS = ((19, 1, 2), (13, 1, 14), (2, 1, 19), (-14, 1, 13), (-19, 1, 2), (-13, 1, -14), (-2, 1, -19), (9, 1, -17), (17, 1, -9))
LAMPS = ((0.5, 0.9, 0.5), (0.3, 0.6, 0.65), (1.3, 3, 1.2))
ROOM_LAMPS = {
    "hall": ((0.5, 0.6, 0.5), (0.1, 0.2, 0.4), (0.8, 2, 1.5)),
    "lamp_room": ((0.5, 0.675, 0.481), (0.797, 0.32, 0.793), (0.25, 0.4, 0.3)),
    "terrain": ((0.5, 1.1, 0.5), (0.2, 1.3, 0.7), (1.3, 3, 1.2)),
}
VIEWS = ("overview", "top", "eye_level", "close", "tele")
# Eye and target in fractions of the extent, and the vertical field of view in degrees.
OPEN_VIEWS = (
    ((1.15, 0.9, 1.2), (0.5, 0.1, 0.5), 40),
    ((0.45, 1.3, 0.55), (0.5, 0, 0.5), 50),
    ((0.05, 0.25, 0.15), (0.8, 0.15, 0.7), 60),
    ((0.62, 0.4, 0.68), (0.48, 0.2, 0.5), 50),
    ((-0.6, 0.7, 1.4), (0.5, 0.2, 0.5), 15),
)
VIEWS_OF = {
    "terrain": (((1.1, 2.2, 1.15), (0.5, 0.5, 0.5), 40), ((0.45, 5, 0.55), (0.5, 0.4, 0.5), 50), ((0.12, 1.2, 0.2), (0.7, 0.55, 0.65), 60),
                ((0.62, 1.3, 0.7), (0.45, 0.5, 0.45), 50), ((-0.6, 2.5, 1.4), (0.5, 0.5, 0.5), 15)),
    "plant": (((0.8, 0.9, 0.85), (0.45, 0.05, 0.45), 45), ((0.45, 1.5, 0.5), (0.5, 0, 0.5), 50), ((0.3, 0.06, 0.25), (0.5, 0.08, 0.55), 60),
              ((0.6, 0.25, 0.62), (0.42, 0.1, 0.45), 50), ((-0.6, 0.7, 1.4), (0.5, 0.2, 0.5), 15)),
    "bricks": (((1.15, 0.9, 1.2), (0.5, 0.1, 0.5), 40), ((0.6, 1.7, 0.5), (0.6, 0, 0.25), 60), ((0.05, 0.25, 0.15), (0.8, 0.15, 0.7), 60),
               ((0.62, 0.4, 0.68), (0.48, 0.2, 0.5), 50), ((-0.6, 0.7, 1.4), (0.5, 0.2, 0.5), 15)),
    "planes": (((0.75, 4, 0.8), (0.5, 0.2, 0.5), 40), ((0.48, 9, 0.55), (0.5, 0, 0.5), 50), ((0.4, 0.5, 0.42), (0.55, 0.3, 0.52), 60),
               ((0.53, 0.9, 0.56), (0.49, 0.3, 0.5), 50), ((0.1, 3, 0.9), (0.5, 0.2, 0.5), 15)),
    "low_sun": (((0.9, 3, 0.95), (0.5, 0.1, 0.5), 40), ((0.45, 7, 0.55), (0.5, 0, 0.5), 50), ((0.1, 0.45, 0.3), (0.8, 0.2, 0.6), 60),
                ((0.42, 0.5, 0.52), (0.55, 0.15, 0.42), 50), ((-0.5, 4, 1.2), (0.5, 0.2, 0.5), 15)),
    "hall": (((0.95, 0.7, 0.9), (0.3, 0.2, 0.4), 60), ((0.5, 0.9, 0.55), (0.45, 0, 0.5), 80), ((0.1, 0.17, 0.45), (0.9, 0.2, 0.55), 70),
             ((0.42, 0.3, 0.7), (0.35, 0.05, 0.45), 50), ((1.4, 0.6, 0.6), (0.2, 0.2, 0.45), 20)),
    "lamp_room": (((0.08, 0.8, 0.9), (0.6, 0.3, 0.4), 75), ((0.6, 0.9, 0.6), (0.5, 0.1, 0.45), 90), ((0.9, 0.5, 0.85), (0.2, 0.4, 0.2), 70),
                  ((0.3, 0.5, 0.7), (0.5, 0.25, 0.42), 50), ((2.5, 0.8, 0.7), (0.4, 0.3, 0.4), 20)),
}  # fmt: skip


def on_grid(fractions, size):
    """Returns the grid point (integers) at `fractions` of the extent `size` (metres)."""
    return [round(f * s * PER_METRE) for f, s in zip(fractions, size)]


def cases_of(number, name, size):
    """Returns the 12 cases of scene `number`, one per light. The view changes with each light and with each scene."""
    cases = []
    suns = LOW_SUNS if name == "low_sun" else SUNS
    for i in range(12):
        view = (i + number) % 5
        eye, target, fov = VIEWS_OF.get(name, OPEN_VIEWS)[view]
        case = {"name": f"{name}-{i + 1:02}-{VIEWS[view]}", "scene": name, "eye": on_grid(eye, size),
                "target": on_grid(target, size), "fov_y": fov}  # fmt: skip
        if i < 9:
            case["sun"] = list(suns[i])
        else:
            case["lamp"] = on_grid(ROOM_LAMPS.get(name, LAMPS)[i - 9], size)
        cases.append(case)
    return cases


def metres(point):
    return ",".join(repr(x / PER_METRE) for x in point)


def options(case):
    """Returns the options of `gnomon render` for the view and light of a case, including all default values."""
    light = ["--light", ",".join(map(str, case["sun"]))] if "sun" in case else ["--light-at", metres(case["lamp"])]
    return ["--size", f"{SIZE}x{SIZE}", "--eye", metres(case["eye"]), "--target", metres(case["target"]), "--up", "0,1,0",
            "--fov-y", str(case["fov_y"]), "--projection", "perspective", *light, "--shading", "lit",
            "--ground", "off", "--sky", "0", "--samples", "1", "--error-pixels", "1e-9", "--backend", "software"]  # fmt: skip


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def axes(backward):
    """Returns the unit axes x, y, z of a node that looks along -z, with y up. `backward` is +z."""
    z = unit(backward)
    x = unit(cross((0, 1, 0) if abs(z[0]) + abs(z[2]) > 0 else (0, 0, -1), z))
    return x, cross(z, x), z


def node_matrix(backward, place):
    """Returns the column-major matrix of a camera or light node."""
    x, y, z = axes(backward)
    return [*x, 0, *y, 0, *z, 0, *place, 1]


def glb(mesh, case):
    """Returns the bytes of the case's GLB."""
    places = b"".join(struct.pack("<3f", *c) for c in mesh.corners)
    indices = b"".join(struct.pack("<3I", *t) for t in mesh.triangles)
    eye = [x / PER_METRE for x in case["eye"]]
    backward = [e - t for e, t in zip(case["eye"], case["target"])]
    if "sun" in case:
        light, matrix = {"type": "directional", "intensity": 1}, node_matrix(case["sun"], (0, 0, 0))
    else:
        light, matrix = {"type": "point", "intensity": 1}, node_matrix((0, 1, 0), [x / PER_METRE for x in case["lamp"]])
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": len(places), "target": 34962},
             {"buffer": 0, "byteOffset": len(places), "byteLength": len(indices), "target": 34963}]  # fmt: skip
    json_text = json.dumps({
        "asset": {"version": "2.0", "generator": "shadowtruth"},
        "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [light]}},
        "extras": {**case, "units_per_metre": PER_METRE, "size": SIZE},
        "scene": 0,
        "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [{"name": "mesh", "mesh": 0, "scale": [1 / PER_METRE] * 3},
                  {"name": "camera", "camera": 0, "matrix": node_matrix(backward, eye)},
                  {"name": "light", "matrix": matrix, "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "cameras": [{"type": "perspective", "perspective": {
            "yfov": case["fov_y"] * math.pi / 180, "aspectRatio": 1, "znear": 0.01}}],
        "materials": [{"doubleSided": True, "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 1}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(mesh.corners), "type": "VEC3",
                       "min": [min(c[i] for c in mesh.corners) for i in range(3)],
                       "max": [max(c[i] for c in mesh.corners) for i in range(3)]},
                      {"bufferView": 1, "componentType": 5125, "count": 3 * len(mesh.triangles), "type": "SCALAR"}],
        "bufferViews": views,
        "buffers": [{"byteLength": len(places) + len(indices)}],
    }, separators=(",", ":")).encode()  # fmt: skip
    json_text += b" " * (-len(json_text) % 4)
    body = places + indices
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(json_text) + len(body)) + struct.pack("<I4s", len(json_text), b"JSON") + json_text
            + struct.pack("<I4s", len(body), b"BIN\0") + body)  # fmt: skip


def read_glb(data):
    """Returns the JSON document, the corners and the triangles of a GLB that `glb` made."""
    length = struct.unpack_from("<I", data, 12)[0]
    document = json.loads(data[20 : 20 + length])
    corners, triangles = document["bufferViews"]
    start = 28 + length
    places = list(struct.iter_unpack("<3f", data[start : start + corners["byteLength"]]))
    start += triangles["byteOffset"]
    return document, places, list(struct.iter_unpack("<3I", data[start : start + triangles["byteLength"]]))
