"""What docs/file_format.md says is enough to read a model: an independent reader finds the triangles of `export`.

usage: GNOMON=build/release/gnomon python3 -m unittest gnm_reader_test
"""
import json
import math
import os
import pathlib
import struct
import subprocess
import tempfile
import unittest

import gnm_reader

GNOMON = os.environ["GNOMON"]
DATA = pathlib.Path(__file__).resolve().parents[2] / "data"


def gnomon(*words):
    return subprocess.run([GNOMON, *map(str, words)], check=True, capture_output=True, text=True, timeout=120).stdout


def read_ply(path):
    """The triangles of what `export` writes, as sorted rows of three positions each, starting at the least."""
    header, _, body = path.read_bytes().partition(b"end_header\n")
    lines = header.decode().split("\n")
    counts = {words[1]: int(words[2]) for words in (line.split() for line in lines) if words[:1] == ["element"]}
    forms = {"float": "f", "double": "d", "uchar": "B"}
    form = "<" + "".join(forms[line.split()[1]] for line in lines if line.startswith("property") and "list" not in line)
    size = struct.calcsize(form)
    points = [struct.unpack_from(form, body, i * size)[:3] for i in range(counts["vertex"])]
    faces = struct.iter_unpack("<B3i", body[counts["vertex"] * size:])
    return sorted(turned([points[c] for c in face[1:]]) for face in faces)


def turned(corners):
    """The same triangle, the least corner first, the winding kept."""
    first = corners.index(min(corners))
    return tuple(corners[first:] + corners[:first])


def read_vertices(path):
    """The rows of the vertices of what `export` writes, by the names of their properties."""
    header, _, body = path.read_bytes().partition(b"end_header\n")
    lines = header.decode().split("\n")
    count = next(int(line.split()[2]) for line in lines if line.startswith("element vertex"))
    properties = [line.split()[1:] for line in lines if line.startswith("property") and "list" not in line]
    form = "<" + "".join({"float": "f", "double": "d", "uchar": "B"}[kind] for kind, _ in properties)
    rows = (struct.unpack_from(form, body, i * struct.calcsize(form)) for i in range(count))
    return [dict(zip((name for _, name in properties), row)) for row in rows]


SIDE = 60


def field_row(column, row):
    """x, y, z, quality, time, label of a vertex: smooth, far from 0, and an integer."""
    height = math.sin(column / 9) * math.cos(row / 7)
    return column, row, height, 3 * height - 1, 1e9 + column / 100 + row, (column * 7 + row) % 50


def write_fields(path):
    lines = ["ply", "format ascii 1.0", f"element vertex {SIDE * SIDE}", "property float x", "property float y",
             "property float z", "property float quality", "property double time", "property short label",
             f"element face {(SIDE - 1) ** 2}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(map(repr, field_row(c, r))) for r in range(SIDE) for c in range(SIDE)]
    corners = [r * SIDE + c for r in range(SIDE - 1) for c in range(SIDE - 1)]
    lines += [f"4 {a} {a + 1} {a + SIDE + 1} {a + SIDE}" for a in corners]
    path.write_text("\n".join(lines) + "\n")


class ReaderTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="gnomon_format_")
        cls.path = pathlib.Path(cls.folder.name)
        gnomon("make", "statue", "--triangles", "6000", "--seed", "1", "-o", cls.path / "statue.ply")
        cls.models = {"statue": cls.path / "statue.ply", "colonnade": DATA / "models" / "colonnade.obj",
                      "sundial": DATA / "models" / "sundial.ply"}
        for name, mesh in cls.models.items():
            gnomon("build", mesh, "-o", cls.path / f"{name}.gnm")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_tables_are_those_of_info(self):
        for name in self.models:
            model = gnm_reader.Model(self.path / f"{name}.gnm")
            info = json.loads(gnomon("info", self.path / f"{name}.gnm", "--json"))
            self.assertEqual(model.content_hash, info["content_hash"])
            self.assertEqual(model.summary["source_triangles"], info["source_triangles"])
            self.assertEqual(model.summary["step"], info["grid_step"])
            self.assertEqual([level["triangles"] for level in model.summary["levels"]],
                             [level["triangles"] for level in info["levels"]])

    def test_cuts_are_those_of_export(self):
        for name in self.models:
            model = gnm_reader.Model(self.path / f"{name}.gnm")
            errors = [level["max_error"] for level in model.summary["levels"]]
            for limit in {errors[0], errors[len(errors) // 2]}:
                out = self.path / "cut.ply"
                gnomon("export", self.path / f"{name}.gnm", "--error", repr(limit), "-o", out)
                rows = []
                for page, cluster in model.uniform_cut(limit):
                    for face in cluster["faces"]:
                        corners = [model.world(page.vertices[cluster["first"] + c][0]) for c in face]
                        rows.append(turned(corners))
                with self.subTest(model=name, limit=limit):
                    self.assertGreater(len(rows), 0)
                    self.assertEqual(sorted(rows), read_ply(out))

    def test_fields_are_those_of_the_source(self):
        mesh, built, out = (self.path / name for name in ("fields.ply", "fields.gnm", "fields_out.ply"))
        write_fields(mesh)
        names = ["label", "time", "quality"]
        words = ("build", mesh, "--fields", ",".join(names), "--chunk-triangles", "300", "-o", built, "--json")
        reports = [json.loads(gnomon(*words, "--threads", threads)) for threads in (1, 3)]
        self.assertEqual(*(report["content_hash"] for report in reports))
        self.assertEqual(reports[0]["attributes_dropped"], {})
        self.assertGreater(len(reports[0]["rounds"]), 0)
        rows = json.loads(gnomon("info", built, "--json"))["fields"]
        self.assertEqual([row["name"] for row in rows], names)
        self.assertEqual([row["bits"] for row in rows], [10, 10, 10])
        error = {row["name"]: row["error"] for row in rows}
        for row in rows:
            self.assertAlmostEqual(row["error"], (row["max"] - row["min"]) / 2046)
        truth = {row[:2]: dict(zip(("quality", "time", "label"), row[3:]))
                 for row in (field_row(c, r) for r in range(SIDE) for c in range(SIDE))}

        model = gnm_reader.Model(built)
        finest = model.summary["levels"][0]["max_error"]
        gnomon("export", built, "--error", repr(finest), "-o", out)
        vertices = read_vertices(out)
        self.assertEqual(len(vertices), SIDE * SIDE)
        for vertex in vertices:
            source = truth[round(vertex["x"]), round(vertex["y"])]
            for name in names:
                self.assertLessEqual(abs(vertex[name] - source[name]), error[name] * 1.001)
        exported = {tuple(vertex[axis] for axis in "xyz"): vertex for vertex in vertices}
        for page, cluster in model.uniform_cut(finest):
            first = cluster["first"]
            for position, _, _, numbers in page.vertices[first:first + cluster["vertices"]]:
                vertex = exported[model.world(position)]
                for name, value in model.field_values(numbers).items():
                    self.assertAlmostEqual(vertex[name], value, delta=error[name] / 50)

        # Far from the finest level values are means of what vanished: no further off than neighbours are.
        gnomon("export", built, "--triangles", "600", "-o", out)
        coarse = read_vertices(out)
        self.assertLess(len(coarse), 400)
        for vertex in coarse:
            source = truth[round(vertex["x"]), round(vertex["y"])]
            self.assertLess(abs(vertex["quality"] - source["quality"]), 1.0)
            self.assertLess(abs(vertex["time"] - source["time"]), 6.0)
        self.assertTrue(any(vertex["label"] != truth[round(vertex["x"]), round(vertex["y"])]["label"]
                            for vertex in coarse))

    def test_unknown_fields_are_refused(self):
        mesh = self.path / "refused.ply"
        write_fields(mesh)
        for fields, message in (("colour", "unknown field: expected one of quality, time, label, found colour"),
                                ("time,time", "a field is requested twice: expected each once, found time")):
            done = subprocess.run([GNOMON, "build", mesh, "--fields", fields, "-o", self.path / "no.gnm"],
                                  capture_output=True, text=True, timeout=60)
            self.assertEqual((done.returncode, done.stdout), (1, ""))
            self.assertEqual(done.stderr, f"gnomon: {mesh}: {message}\n")
            self.assertFalse((self.path / "no.gnm").exists())

    def test_damage_is_seen(self):
        data = bytearray((self.path / "sundial.gnm").read_bytes())
        data[gnm_reader.HEADER_BYTES + 20] ^= 1
        (self.path / "damaged.gnm").write_bytes(data)
        model = gnm_reader.Model(self.path / "damaged.gnm")
        with self.assertRaises(gnm_reader.Damaged):
            for number in range(len(model.pages)):
                model.page(number)


if __name__ == "__main__":
    unittest.main()
