"""What docs/file_format.md says is enough to read a model: an independent reader finds the triangles of `export`.

usage: GNOMON=build/release/gnomon python3 -m unittest gnm_reader_test
"""
import json
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
    least = corners.index(min(corners))
    return tuple(corners[least:] + corners[:least])


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
