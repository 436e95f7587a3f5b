"""The Python module and the library below it, held to what the program answers to the same."""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

import numpy as np

import gnomon
from program import ProgramTest, run

LIBRARY = pathlib.Path(os.environ["LIBRARY"])
VIEW = {"size": (160, 120), "eye": (3.0, 4.0, -5.0), "target": (0, 0.5, 0), "light": (1, 2, -0.5), "error_pixels": 0.5}
WORDS = ("--size", "160x120", "--eye", "3,4,-5", "--target", "0,0.5,0", "--light", "1,2,-0.5", "--error-pixels", "0.5")


def mesh_of_ply(path):
    """Positions and triangles of a binary PLY, as `gnomon export` writes it."""
    data = path.read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    rows, kind, elements = [], None, {}
    types = {"float": "<f4", "double": "<f8", "uchar": "u1", "int": "<i4", "uint": "<u4"}
    for words in (line.split() for line in data[:end].decode().splitlines()):
        if words[0] == "element":
            kind = words[1]
            elements[kind] = (int(words[2]), [])
        elif words[0] == "property" and words[1] != "list":
            elements[kind][1].append((words[2], types[words[1]]))
        elif words[0] == "property":
            elements[kind][1].append(("count", types[words[2]]))
            elements[kind][1].append(("corners", types[words[3]], 3))
    for count, fields in elements.values():
        rows.append(np.frombuffer(data, np.dtype(fields), count, end))
        end += rows[-1].nbytes
    vertices, faces = rows
    return np.stack([vertices[axis] for axis in "xyz"], 1), faces["corners"]


class Module(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.model = gnomon.open(cls.sundial)

    def test_info_and_plan_are_those_that_the_program_prints(self):
        self.assertEqual(self.model.info, json.loads(run("info", self.sundial, "--json").stdout))
        for options, words in (({}, ()), ({"shadows": "maps", "z_partitions": 3}, ("--shadows", "maps", "--z-partitions", 3))):
            printed = json.loads(run("explain", self.sundial, "--json", "--backend", "software", *WORDS, *words).stdout)
            self.assertEqual(self.model.plan(**VIEW, **options), printed)

    def test_pictures_are_those_that_the_program_draws(self):
        for samples, options, words in ((1, {}, ()), (4, {"shadows": "maps"}, ("--shadows", "maps"))):
            png = self.place / "drawn.png"
            self.expect(0, "", "render", self.sundial, "-o", png, "--samples", samples, *WORDS, *words)
            picture = self.model.render(samples=samples, **VIEW, **options)
            self.assertEqual((picture.shape, picture.dtype), ((120, 160, 4), np.uint8))
            self.assertTrue((picture[..., 3] == 255).all())
            # The program compares for us: a picture of which we write the raw pixels as a PNG of our own.
            ours = self.place / "ours.png"
            ours.write_bytes(png_of(picture[..., :3]))
            self.expect(0, "", "render", self.sundial, "-o", png, "--samples", samples, "--reference", ours,
                        "--reference-threshold", 0, *WORDS, *words)
            self.assertEqual(self.model.render(samples=1, background="transparent", **VIEW)[0, 0, 3], 0)

    def test_cuts_are_those_that_the_program_exports(self):
        ply = self.place / "cut.ply"
        for options, words in (({"triangles": 400}, ("--triangles", 400)), ({"error": 0.05}, ("--error", 0.05))):
            self.expect(0, "triangles", "export", self.sundial, "-o", ply, *words)
            mesh = self.model.cut(**options)
            positions, triangles = mesh_of_ply(ply)
            np.testing.assert_array_equal(mesh.triangles, triangles)
            np.testing.assert_allclose(mesh.positions, positions, rtol=1e-7, atol=1e-7)
            self.assertEqual(mesh.normals.shape, mesh.positions.shape)
            self.assertEqual((mesh.colors.shape, mesh.colors.dtype), ((len(mesh.positions), 4), np.uint8))
            self.assertTrue(mesh.positions.flags["C_CONTIGUOUS"])
            self.assertFalse(mesh.positions.flags["OWNDATA"], "nothing is copied")
        mesh = self.model.cut(**VIEW)
        self.assertGreater(len(mesh.triangles), 100)
        for wrong in ({}, {"triangles": 4, "error": 1.0}, {"triangles": 400, "size": (2, 2)}):
            with self.assertRaises(TypeError):
                self.model.cut(**wrong)

    def test_builds_have_the_programs_bytes(self):
        mesh = pathlib.Path(__file__).resolve().parents[2] / "data/models/sundial.ply"
        stages = set()
        report = gnomon.build(mesh, self.place / "ours.gnm", progress=lambda stage, done, total: stages.add(stage))
        self.assertEqual((self.place / "ours.gnm").read_bytes(), self.sundial.read_bytes())
        self.assertEqual(report["content_hash"], self.model.info["content_hash"])
        self.assertGreater(len(stages), 2)
        with self.assertRaisesRegex(RuntimeError, "cancelled"):
            gnomon.build(mesh, self.place / "stopped.gnm", progress=lambda *told: False)
        with self.assertRaisesRegex(RuntimeError, "missing.ply"):
            gnomon.build("missing.ply", self.place / "missing.gnm")
        with self.assertRaisesRegex(ZeroDivisionError, "division"):
            gnomon.build(mesh, self.place / "stopped.gnm", progress=lambda *told: 1 // 0)

    def test_schemes_are_those_of_the_table(self):
        table = json.loads(run("theory", "table", "--near", 1, "--far", 500, "--fov-y", 50, "--light", "0.3,0.9,-0.2",
                               "--aspect", 1.5, "--json").stdout)
        rows = gnomon.schemes(1, 500, fov_y=50, aspect=1.5, light=(0.3, 0.9, -0.2))
        table = table.get("rows", table) if isinstance(table, dict) else table
        self.assertEqual([(row["scheme"], row["warp"], row["maps"]) for row in rows],
                         [(row["scheme"], row["warp"], row["maps"]) for row in table])

    def test_options_are_refused_by_name(self):
        with self.assertRaisesRegex(RuntimeError, "--siz: there is no such option"):
            self.model.render(siz=(3, 3))
        with self.assertRaisesRegex(RuntimeError, "none.gnm"):
            gnomon.open("none.gnm")

    @unittest.skipUnless(shutil.which("nm"), "binutils are not installed")
    def test_only_the_public_names_leave_the_library(self):
        listed = subprocess.run(["nm", "-DC", "--defined-only", LIBRARY], capture_output=True, text=True, check=True).stdout
        names = [line.split(maxsplit=2)[2] for line in listed.splitlines()]
        self.assertGreater(len(names), 10)
        self.assertEqual([name for name in names if "gnomon::api::" not in name], [])


def png_of(pixels):
    """A PNG of rows of 8-bit RGB."""
    import struct
    import zlib

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


if __name__ == "__main__":
    unittest.main(argv=sys.argv)
