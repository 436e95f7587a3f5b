"""What relations are held on: random meshes of dyadic numbers, real models, views of both, and their pictures."""
import os
import struct
import subprocess
import zlib

LIMIT = 120


class Fails(Exception):
    pass


def run(folder, *words, code=0, **environment):
    command = [os.environ["GNOMON"], *map(str, words)]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, errors="backslashreplace", timeout=LIMIT,
                          env=dict(os.environ, **environment))  # fmt: skip
    if done.returncode != code:
        raise Fails(f"{' '.join(map(str, words))}: exit {done.returncode}: {done.stderr[-300:]}")
    return done.stdout


def pixels(file):
    """Width, height and the rows of a PNG of 8 bits a channel, without filters undone twice: bytes of each pixel."""
    data = file.read_bytes()
    width, height, depth, colour = struct.unpack_from(">IIBB", data, 16)
    assert depth == 8, depth
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[colour]
    packed, at = b"", 8
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IDAT":
            packed += data[at + 8 : at + 8 + length]
        at += 12 + length
    return width, height, channels, unfiltered(zlib.decompress(packed), width * channels, height, channels)


def unfiltered(raw, stride, height, channels):
    rows, before = [], bytearray(stride)
    for y in range(height):
        kind, line = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
        for x in range(stride):
            left = line[x - channels] if x >= channels else 0
            corner = before[x - channels] if x >= channels else 0
            line[x] = (line[x] + predicted(kind, left, before[x], corner)) & 255
        rows.append(bytes(line))
        before = line
    return rows


def predicted(kind, left, above, corner):
    if kind == 4:
        guess = left + above - corner
        return min((abs(guess - value), index, value) for index, value in enumerate((left, above, corner)))[2]
    return (0, left, above, (left + above) // 2)[kind]


class Mesh:
    """Vertices of dyadic coordinates and triangles."""

    def __init__(self, vertices, triangles):
        self.vertices, self.triangles = vertices, triangles

    def moved(self, by):
        return Mesh([tuple(a + b for a, b in zip(vertex, by)) for vertex in self.vertices], self.triangles)

    def scaled(self, by):
        return Mesh([tuple(a * by for a in vertex) for vertex in self.vertices], self.triangles)

    def turned(self):
        """Axes x, y, z become y, z, x: a rotation about the space's diagonal."""
        return Mesh([(z, x, y) for x, y, z in self.vertices], self.triangles)

    def write(self, file, form="binary_little_endian"):
        """As a PLY of doubles."""
        head = (f"ply\nformat {form} 1.0\nelement vertex {len(self.vertices)}\n"
                "property double x\nproperty double y\nproperty double z\n"
                f"element face {len(self.triangles)}\nproperty list uchar int vertex_indices\nend_header\n")  # fmt: skip
        if form == "ascii":
            lines = [" ".join(map(repr, vertex)) for vertex in self.vertices]
            lines += ["3 " + " ".join(map(str, corners)) for corners in self.triangles]
            file.write_text(head + "\n".join(lines) + "\n")
            return
        order = "<" if "little" in form else ">"
        body = b"".join(struct.pack(order + "3d", *vertex) for vertex in self.vertices)
        body += b"".join(struct.pack(order + "B3i", 3, *corners) for corners in self.triangles)
        file.write_bytes(head.encode() + body)

    def write_obj(self, file):
        lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in self.vertices]
        lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in self.triangles]
        file.write_text("\n".join(lines) + "\n")


def random_mesh(chance):
    """Hilly ground with boxes on it, some of which float, in sixty-fourths."""
    side = chance.randint(8, 20)
    vertices = [(float(x), chance.randint(0, 64) / 64, float(z)) for z in range(side + 1) for x in range(side + 1)]
    triangles = []
    for z in range(side):
        for x in range(side):
            a = z * (side + 1) + x
            triangles += [(a, a + side + 1, a + 1), (a + 1, a + side + 1, a + side + 2)]
    for _ in range(chance.randint(2, 12)):
        low = [chance.randint(0, 64 * side) / 64, chance.randint(0, 256) / 64, chance.randint(0, 64 * side) / 64]
        size = [chance.randint(4, 160) / 64 for _ in range(3)]
        first = len(vertices)
        vertices += [tuple(low[axis] + size[axis] * (corner >> axis & 1) for axis in range(3)) for corner in range(8)]
        for a, b, c, d in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
            triangles += [(first + a, first + b, first + c), (first + a, first + c, first + d)]
    return Mesh(vertices, triangles)


class View:
    """An eye, a target and a light of dyadic coordinates near a mesh."""

    def __init__(self, chance, mesh):
        size = max(x for x, _, _ in mesh.vertices)
        self.eye = (chance.randint(-64, 128) / 64 * size / 2, chance.randint(96, 512) / 64, size * chance.randint(80, 160) / 128)
        self.target = (size / 2, 0.5, size / 4)
        self.light = (chance.randint(-64, 64) / 64, chance.randint(16, 64) / 64, chance.randint(-64, 64) / 64)
        self.up, self.size = (0.0, 1.0, 0.0), "96x64"

    def words(self, eye=None, target=None, light=None, up=None):
        def text(vector):
            return ",".join(map(repr, vector))

        return ("--eye", text(eye or self.eye), "--target", text(target or self.target), "--up", text(up or self.up),
                "--light", text(light or self.light), "--size", self.size, "--samples", "1")  # fmt: skip


class Model:
    """A real model, seen from a random side by a random light, in a folder of its own."""

    def __init__(self, folder, chance, model):
        self.folder, self.chance = folder, chance
        (folder / "a.gnm").symlink_to(model.resolve())
        self.view = SideView(chance)

    def picture(self, model="a.gnm", words=None, *more, **environment):
        return Instance.picture(self, model, words, *more, **environment)


class SideView:
    """A view that frames a model."""

    def __init__(self, chance):
        self.light = (chance.randint(-64, 64) / 64, chance.randint(16, 64) / 64, chance.randint(-64, 64) / 64)
        self.side = chance.choice(("front", "left", "top", "iso"))

    def words(self, light=None):
        light = ",".join(map(repr, light or self.light))
        return ("--view", self.side, "--light", light, "--size", "160x120", "--samples", "1")


class Instance:
    """A random mesh with its model, and a view of it, in a folder of its own."""

    def __init__(self, folder, chance):
        self.folder, self.chance = folder, chance
        self.mesh = random_mesh(chance)
        self.view = View(chance, self.mesh)
        self.mesh.write(folder / "a.ply")
        self.build("a.ply", "a.gnm")

    def build(self, source, out, *words):
        run(self.folder, "build", *([source] if isinstance(source, str) else source), "-o", out, "--chunk-triangles", "500", "--up", "y", *words)
        return (self.folder / out).read_bytes()

    def built(self, mesh, name="b"):
        mesh.write(self.folder / f"{name}.ply")
        return self.build(f"{name}.ply", f"{name}.gnm")

    def first(self):
        return (self.folder / "a.gnm").read_bytes()

    def picture(self, model="a.gnm", words=None, *more, **environment):
        out = self.folder / "p.png"
        run(self.folder, "render", model, "-o", out, *(words or self.view.words()), *more, **environment)
        return out.read_bytes()
