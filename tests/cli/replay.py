"""What the replays of ../shared/faults/turn3 have in common: inputs, measurements, and the readers of results.

$GNOMON_FAULTS names the folder that has turn3; without it, it is the neighbour of $GNOMON_MODELS.
"""
import json
import os
import pathlib
import struct
import unittest
import zlib

from program import GNOMON, ProgramTest, measured, run

MODELS = pathlib.Path(os.environ.get("GNOMON_MODELS") or pathlib.Path(__file__).resolve().parents[3] / "shared/models")
FAULTS = pathlib.Path(os.environ.get("GNOMON_FAULTS") or MODELS.parent / "faults") / "turn3"
IS_SANITIZED = any(name in pathlib.Path(GNOMON).read_bytes() for name in (b"__asan_init", b"__tsan_init"))
SIZES = {"float": "f", "double": "d", "uchar": "B"}


def vertices_of(path):
    """Position and colour, if there is one, of each vertex of a PLY that gnomon wrote."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + 11
    header = data[:end].decode().split("\n")
    count = next(int(line.split()[2]) for line in header if line.startswith("element vertex"))
    names = [line.split()[1:] for line in header if line.startswith("property") and "list" not in line]
    row = struct.Struct("<" + "".join(SIZES[kind] for kind, _ in names))
    columns = [name for _, name in names]
    for values in row.iter_unpack(data[end : end + count * row.size]):
        vertex = dict(zip(columns, values))
        yield (vertex["x"], vertex["y"], vertex["z"]), tuple(vertex[c] for c in ("red", "green", "blue") if c in vertex)


def pixels_of(path):
    """The rows of pixels of a PNG of 8 bits, without interlacing."""
    data, at, raw = path.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IHDR":
            width, height, _, form = struct.unpack_from(">IIBB", data, at + 8)
        if kind == b"IDAT":
            raw += data[at + 8 : at + 8 + length]
        at += 12 + length
    raw, step = zlib.decompress(raw), {0: 1, 2: 3, 4: 2, 6: 4}[form]
    before, rows = bytes(width * step), []
    for y in range(height):
        begin = y * (width * step + 1)
        line = bytearray(raw[begin + 1 : begin + 1 + width * step])
        for i, filtered in enumerate(line):
            left, up = line[i - step] if i >= step else 0, before[i]
            corner = before[i - step] if i >= step else 0
            near = min((abs(up - corner), 0, left), (abs(left - corner), 1, up), (abs(left + up - 2 * corner), 2, corner))
            line[i] = (filtered + (0, left, up, (left + up) // 2, near[2])[raw[begin]]) & 255
        rows.append([tuple(line[x : x + step]) for x in range(0, width * step, step)])
        before = line
    return rows


@unittest.skipUnless(FAULTS.is_dir(), f"the inputs of shared/faults/turn3 are not in {FAULTS.parent}")
class ReplayTest(ProgramTest):
    def measured(self, *words, env=None):
        """Exit code, stdout, stderr, seconds of processor time and MiB of peak resident size."""
        done = measured(*words, env=env)
        return done.code, done.out, done.err, done.seconds, done.mebibytes

    def built(self, source, *options):
        """The model of a source, its report and what was said."""
        model = self.place / "m.gnm"
        told = run("build", FAULTS / source, "-o", model, "--json", *options)
        self.assertEqual(told.returncode, 0, told.stderr)
        return model, json.loads(told.stdout), told.stderr

    def info(self, model):
        return json.loads(self.expect(0, "", "info", model, "--json").stdout)

    def vertices(self, model):
        mesh = self.place / "full.ply"
        self.expect(0, "", "export", model, "--triangles", "1G", "-o", mesh)
        return list(vertices_of(mesh))
