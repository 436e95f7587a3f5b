"""Generates the eight scenes of the shadowtruth set, as triangles with integer coordinates.

Each scene has y up. Corners are on a grid of 1/1024 m, with coordinates from 0 to 2^24 - 1. The code uses no
transcendental function, so the meshes are identical on all machines.
"""
import math
import random
import struct
import subprocess

PER_METRE = 1024
LIMIT = 1 << 24
ROOT_HALF = math.sqrt(0.5)
ROOT_3_4 = math.sqrt(0.75)
CIRCLE = (
    (1, 0), (ROOT_3_4, 0.5), (0.5, ROOT_3_4), (0, 1), (-0.5, ROOT_3_4), (-ROOT_3_4, 0.5),
    (-1, 0), (-ROOT_3_4, -0.5), (-0.5, -ROOT_3_4), (0, -1), (0.5, -ROOT_3_4), (ROOT_3_4, -0.5),
)  # fmt: skip


class Mesh:
    """A triangle mesh with shared corners. The mesh skips triangles with two equal corners, and duplicate triangles."""

    def __init__(self):
        self.corners = []
        self.triangles = []
        self._index = {}
        self._known = set()

    def corner(self, point):
        """Returns the index of the grid point nearest to `point` (metres)."""
        place = tuple(round(x * PER_METRE) for x in point)
        if place not in self._index:
            self._index[place] = len(self.corners)
            self.corners.append(place)
        return self._index[place]

    def add(self, *points):
        """Adds the polygon with these corners (metres) as a fan of triangles."""
        ring = [self.corner(p) for p in points]
        for b, c in zip(ring[1:], ring[2:]):
            key = tuple(sorted((ring[0], b, c)))
            if len(set(key)) == 3 and key not in self._known:
                self._known.add(key)
                self.triangles.append((ring[0], b, c))

    def box(self, low, high):
        (x0, y0, z0), (x1, y1, z1) = low, high
        for y in (y0, y1):
            self.add((x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1))
        for x in (x0, x1):
            self.add((x, y0, z0), (x, y1, z0), (x, y1, z1), (x, y0, z1))
        for z in (z0, z1):
            self.add((x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z))

    def column(self, x, z, y0, y1, bottom, top=None, capped=True):
        """Adds a vertical column with 12 sides from y0 to y1. `bottom` and `top` are its radii (metres)."""
        top = bottom if top is None else top
        low = [(x + bottom * c, y0, z + bottom * s) for c, s in CIRCLE]
        high = [(x + top * c, y1, z + top * s) for c, s in CIRCLE]
        for i in range(12):
            j = (i + 1) % 12
            self.add(low[i], high[i], high[j], low[j])
        if capped:
            self.add(*high)

    def heights(self, size, count, height):
        """Adds a height field of size x size metres with count x count squares. `height(x, z)` returns metres."""
        step = size / count
        points = [[(i * step, height(i * step, k * step), k * step) for i in range(count + 1)] for k in range(count + 1)]
        for k in range(count):
            for i in range(count):
                self.add(points[k][i], points[k + 1][i], points[k + 1][i + 1])
                self.add(points[k][i], points[k + 1][i + 1], points[k][i + 1])

    def finished(self):
        """Moves the smallest coordinate of each axis to 0, and returns the mesh."""
        low = [min(c[axis] for c in self.corners) for axis in range(3)]
        self.corners = [tuple(c[axis] - low[axis] for axis in range(3)) for c in self.corners]
        assert max(max(c) for c in self.corners) < LIMIT
        return self

    def size(self):
        """Returns the extent in metres."""
        return [max(c[axis] for c in self.corners) / PER_METRE for axis in range(3)]


def smooth_noise(seed, cells):
    """Returns a value noise function of (x, y) with `cells` x `cells` cells. Arguments and values are in [0, 1]."""
    chance = random.Random(seed)
    values = [[chance.random() for _ in range(cells + 2)] for _ in range(cells + 2)]

    def at(x, y):
        x, y = x * cells, y * cells
        i, k = min(int(x), cells), min(int(y), cells)
        u, v = x - i, y - k
        u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
        low = values[k][i] + (values[k][i + 1] - values[k][i]) * u
        high = values[k + 1][i] + (values[k + 1][i + 1] - values[k + 1][i]) * u
        return low + (high - low) * v

    return at


def read_ply(data):
    """Returns the triangles of a binary PLY with float or double positions, each as three corners (metres)."""
    end = data.index(b"end_header\n") + len(b"end_header\n")
    layout, counts, element = {"vertex": "<", "face": "<"}, {}, ""
    sizes = {"float": "f", "double": "d", "uchar": "B", "int": "i", "uint": "I"}
    for words in (line.split() for line in data[:end].decode().splitlines()):
        if words[0] == "element":
            element, counts[words[1]] = words[1], int(words[2])
        elif words[0] == "property" and words[1] == "list":
            layout[element] += sizes[words[2]] + 3 * sizes[words[3]]
        elif words[0] == "property":
            layout[element] += sizes[words[1]]
    vertices = end + counts["vertex"] * struct.calcsize(layout["vertex"])
    points = [record[:3] for record in struct.iter_unpack(layout["vertex"], data[end:vertices])]
    return [tuple(points[i] for i in record[1:4]) for record in struct.iter_unpack(layout["face"], data[vertices:])]


def made(gnomon, kind, folder, triangles):
    """Returns the mesh of `gnomon make KIND`, rounded to the grid."""
    path = folder / f"{kind}.ply"
    subprocess.run([gnomon, "make", kind, "--triangles", str(triangles), "--seed", "1", "-o", path,
                    "--progress", "none"], check=True, capture_output=True)  # fmt: skip
    mesh = Mesh()
    for triangle in read_ply(path.read_bytes()):
        mesh.add(*triangle)
    path.unlink()
    return mesh


def planes(gnomon, folder):
    return made(gnomon, "planes", folder, 40_000)


def plant(gnomon, folder):
    return made(gnomon, "plant", folder, 60_000)


def hall(*_):
    """Returns a hall with columns, windows, roof beams with skylights, and crates."""
    mesh, chance = Mesh(), random.Random(3)
    mesh.box((0, -0.5, 0), (48, 0, 24))
    for side in (0, 23.5):
        for i in range(13):
            mesh.box((i * 4 - 0.6, 0, side), (i * 4 + 0.6, 12, side + 0.5))
        mesh.box((0, 0, side), (48, 1.5, side + 0.5))
        mesh.box((0, 10, side), (48, 12, side + 0.5))
    mesh.box((0, 0, 0), (0.5, 12, 24))
    for i in range(1, 12):
        for z in (6, 18):
            mesh.box((i * 4 - 0.5, 0, z - 0.5), (i * 4 + 0.5, 0.3, z + 0.5))
            mesh.column(i * 4, z, 0.3, 11, 0.35, 0.28)
        mesh.box((i * 4 - 0.15, 11, 0.5), (i * 4 + 0.15, 11.6, 23.5))
    for i in range(24):
        mesh.box((0, 11.6, i), (48, 11.75, i + 0.2))
        if i % 3:
            mesh.box((0, 11.75, i + 0.1), (48, 11.8, i + 1.1))
    for _ in range(60):
        x, z, s = 2 + 42 * chance.random(), 1.5 + 20 * chance.random(), 0.3 + chance.random()
        mesh.box((x, 0, z), (x + s, s * (0.5 + chance.random()), z + s))
    for i in range(40):
        mesh.box((1 + i * 1.1, 4, 11.98), (1.02 + i * 1.1, 5, 12.02))
    mesh.box((1, 5, 11.97), (45, 5.04, 12.03))
    return mesh


def terrain(*_):
    """Returns mountains of 2 x 2 km with rocks."""
    mesh, layers = Mesh(), [smooth_noise(7 + i, 4 << i) for i in range(6)]

    def height(x, z):
        return sum(400 / (2.1**i) * layer(x / 2048, z / 2048) for i, layer in enumerate(layers))

    mesh.heights(2048, 128, height)
    chance = random.Random(11)
    for _ in range(200):
        x, z, s = 2000 * chance.random(), 2000 * chance.random(), 3 + 12 * chance.random()
        mesh.column(x + 20, z + 20, height(x, z) - 10, height(x, z) + 2 * s, s, 0.3 * s)
    return mesh


def grating(*_):
    """Bars over a floor. Their pitch decreases from 0.64 m to 0.02 m."""
    mesh = Mesh()
    mesh.box((0, -0.2, 0), (12, 0, 8))
    pitch, x = 0.64, 0.5
    while pitch >= 0.02 and x < 11.5:
        mesh.box((x, 1.5, 0.5), (x + pitch / 2, 1.5 + pitch / 4, 3.5))
        x += pitch
        pitch *= 0.975
    for i in range(60):
        mesh.box((0.5 + i * 0.1, 0.6, 4), (0.53 + i * 0.1, 0.61, 7.5))
    for i in range(35):
        mesh.box((0.5, 0.62, 4 + i * 0.1), (6.5, 0.63, 4.03 + i * 0.1))
    for i in range(80):
        z = 4 + 0.045 * i
        mesh.add((7, 0.2 + i / 50, z), (11.5, 0.25 + i / 50, z + 0.3), (11.5, 0.25 + i / 50, z + 0.32), (7, 0.2 + i / 50, z + 0.02))
    return mesh


def bricks(*_):
    """Returns two walls of bricks with recessed joints. Every second brick of one wall is missing."""
    mesh = Mesh()
    mesh.box((-1, -0.2, -1), (8, 0, 6))
    length, height, depth, joint = 0.24, 0.071, 0.115, 0.012
    for row in range(32):
        y, shift = row * (height + joint), (row % 2) * (length + joint) / 2
        for i in range(24):
            x = i * (length + joint) + shift
            mesh.box((x, y, 0), (x + length, y + height, depth))
            if i < 16 and (i + row) % 2:
                mesh.box((7 - depth, y, x + 0.3), (7, y + height, x + 0.3 + length))
    mesh.box((0.1, 0, 0.01), (6.1, 32 * (height + joint), depth - 0.01))
    for i in range(40):
        mesh.box((0.6 + 0.25 * (i % 8), 0.08 * (i // 8), 2.2), (0.8 + 0.25 * (i % 8), 0.07 + 0.08 * (i // 8), 2.3))
    return mesh


def lamp_room(*_):
    """Returns a room with a window, a door, furniture, and a lamp in a shade."""
    mesh = Mesh()
    mesh.box((0, -0.2, 0), (6, 0, 5))
    mesh.box((0, 2.8, 0), (6, 3, 5))
    mesh.box((-0.2, 0, 0), (0, 2.8, 5))
    mesh.box((0, 0, -0.2), (6, 2.8, 0))
    mesh.box((6, 0, 0), (6.2, 0.9, 5))
    mesh.box((6, 2.1, 0), (6.2, 2.8, 5))
    for z0, z1 in ((0, 0.8), (2.45, 2.55), (4.2, 5)):
        mesh.box((6, 0.9, z0), (6.2, 2.1, z1))
    mesh.box((0, 0, 5), (1, 2.8, 5.2))
    mesh.box((2, 0, 5), (6, 2.8, 5.2))
    mesh.box((1, 2.1, 5), (2, 2.8, 5.2))
    mesh.box((2.2, 0.72, 1.8), (3.8, 0.76, 2.8))
    for x in (2.25, 3.7):
        for z in (1.85, 2.7):
            mesh.box((x, 0, z), (x + 0.05, 0.72, z + 0.05))
    for x, z in ((1.7, 2.1), (4, 2.2), (2.8, 1.2)):
        mesh.box((x, 0.42, z), (x + 0.42, 0.46, z + 0.42))
        for i in range(4):
            mesh.box((x + 0.38 * (i % 2), 0, z + 0.38 * (i // 2)), (x + 0.04 + 0.38 * (i % 2), 0.42, z + 0.04 + 0.38 * (i // 2)))
        for i in range(4):
            mesh.box((x + 0.02 + 0.11 * i, 0.46, z), (x + 0.05 + 0.11 * i, 0.9, z + 0.02))
    chance = random.Random(5)
    for shelf in range(5):
        y, x = 0.3 + 0.4 * shelf, 0.4
        mesh.box((0.35, y, 0), (3.4, y + 0.02, 0.28))
        while x < 3.2:
            width = 0.02 + 0.04 * chance.random()
            if chance.random() < 0.85:
                mesh.box((x, y + 0.02, 0.02), (x + width, y + 0.2 + 0.14 * chance.random(), 0.16 + 0.1 * chance.random()))
            x += width + 0.002
    mesh.column(3, 2.3, 1.75, 2.05, 0.3, 0.12, capped=False)
    mesh.box((2.99, 2.05, 2.29), (3.01, 2.8, 2.31))
    mesh.column(4.9, 4.1, 0, 0.35, 0.12, 0.18, capped=False)
    for c, s in CIRCLE:
        x, z = 4.9 + 0.05 * c, 4.1 + 0.05 * s
        mesh.add((x, 0.2, z), (x + 0.3 * c, 0.9, z + 0.3 * s), (x + 0.3 * c - 0.06 * s, 0.75, z + 0.3 * s + 0.06 * c))
    return mesh


def low_sun(*_):
    """Returns a field with poles, fences and stones, for long shadows."""
    mesh, layers, chance = Mesh(), [smooth_noise(31, 4), smooth_noise(32, 24)], random.Random(9)

    def height(x, z):
        return 1.5 * layers[0](x / 96, z / 96) + 0.12 * layers[1](x / 96, z / 96)

    mesh.heights(96, 96, height)
    for _ in range(120):
        x, z, r = 4 + 88 * chance.random(), 4 + 88 * chance.random(), 0.03 + 0.1 * chance.random()
        mesh.column(x, z, height(x, z) - 0.3, height(x, z) + 1 + 5 * chance.random(), r, 0.7 * r)
    for _ in range(150):
        x, z, r = 4 + 88 * chance.random(), 4 + 88 * chance.random(), 0.1 + 0.5 * chance.random()
        mesh.column(x, z, height(x, z) - 0.2, height(x, z) + r, r, 0.5 * r)
    for i in range(80):
        x, z = 8 + i, 40 + 0.1 * i
        mesh.box((x, height(x, z) - 0.2, z), (x + 0.08, height(x, z) + 1.2, z + 0.08))
        for y in (0.4, 0.7, 1):
            mesh.add((x, height(x, z) + y, z), (x + 1, height(x + 1, z + 0.1) + y, z + 0.1),
                     (x + 1, height(x + 1, z + 0.1) + y + 0.06, z + 0.1), (x, height(x, z) + y + 0.06, z))  # fmt: skip
    return mesh


SCENES = (planes, plant, hall, terrain, grating, bricks, lamp_room, low_sun)
