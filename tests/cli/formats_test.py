"""One mesh is one model, whatever the format; and what a build says of how it understood an input."""
import json
import struct
import unittest

from program import ProgramTest, run

# A wall far from the origin: a relief of 20 mm in coordinates of survey size.
PLACES = [(x, y, z) for z in ("100.000", "101.000")
          for x, y in (("500000.003", "5000000.003"), ("500000.103", "5000000.023"),
                       ("500000.203", "5000000.003"), ("500000.303", "5000000.023"))]  # fmt: skip
FACES = [(0, 1, 5), (0, 5, 4), (1, 2, 6), (1, 6, 5), (2, 3, 7), (2, 7, 6)]


def obj():
    return "".join(f"v {' '.join(p)}\n" for p in PLACES) + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in FACES)


def off():
    rows = "".join(f"{' '.join(p)}\n" for p in PLACES) + "".join(f"3 {a} {b} {c}\n" for a, b, c in FACES)
    return f"OFF\n{len(PLACES)} {len(FACES)} 0\n" + rows


def stl():
    facets = ("facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {' '.join(PLACES[v])}\n" for v in face) +
              "endloop\nendfacet\n" for face in FACES)  # fmt: skip
    return "solid wall\n" + "".join(facets) + "endsolid wall\n"


def ply(kind, is_binary):
    header = f"ply\nformat {'binary_little_endian' if is_binary else 'ascii'} 1.0\nelement vertex {len(PLACES)}\n"
    header += "".join(f"property {kind} {axis}\n" for axis in "xyz")
    header += f"element face {len(FACES)}\nproperty list uchar int vertex_indices\nend_header\n"
    if not is_binary:
        return header.encode() + "".join(off().splitlines(True)[2:]).encode()
    rows = b"".join(struct.pack("<3d", *map(float, p)) for p in PLACES)
    return header.encode() + rows + b"".join(struct.pack("<B3i", 3, *face) for face in FACES)


class Formats(ProgramTest):
    def build(self, name, content, *words):
        (self.place / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        built = run("build", self.place / name, "-o", self.place / f"{name}.gnm", "--json", *words)
        self.assertEqual(built.returncode, 0, built.stderr)
        return json.loads(built.stdout), built.stderr

    def test_far_text_is_the_same_model_as_a_ply_of_doubles(self):
        whole, _ = self.build("wall.ply", ply("double", True), "--up", "y")
        for name, content in (("ascii.ply", ply("double", False)), ("wall.obj", obj()), ("wall.off", off()), ("wall.stl", stl()),
                              ("line.stl", stl().replace("\n", " ")), ("words.off", off().replace("\n", " "))):  # fmt: skip
            report, told = self.build(name, content, "--up", "y")
            self.assertEqual(report["content_hash"], whole["content_hash"], name)
            self.assertEqual(told, "", name)
        info = json.loads(run("info", self.place / "wall.ply.gnm", "--json").stdout)
        low, high = info["bounds"]["min"], info["bounds"]["max"]
        self.assertAlmostEqual(high[1] - low[1], 0.020, delta=2 * info["grid_step"])

    def test_how_an_input_was_understood_is_said_once(self):
        _, told = self.build("digits.ply", ply("float", False))
        self.assertEqual(told.count("\n"), 1, told)
        self.assertIn("digits.ply: warning: a coordinate of type float has more digits", told)
        rows = "0 0 0 200 0 0\n1 0 0 0 200 0\n0 1 0 0 0 200\n3 0 1 2\n"
        header = "ply\nformat ascii 1.0\nelement vertex 3\n" + "".join(f"property float {n}\n" for n in "xyzrgb")
        header += "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        _, told = self.build("rgb.ply", header + rows)
        self.assertIn("rgb.ply: colours of element vertex (r, g, b) of type float range from 0 to 255\n", told)
        (self.place / "paint.mtl").write_text("newmtl a\nKd 1 0 0\n")
        report, told = self.build("windows.obj", "mtllib C:\\dir\\PAINT.MTL\n" + "usemtl a\n" + obj())
        self.assertIn('there is no material library "C:?dir?PAINT.MTL"'.replace("?", "\\"), told)
        self.assertEqual(report["attributes_dropped"], {})

    def test_the_warning_about_digits_precedes_an_error_that_they_cause(self):
        header = ply("float", False).split(b"element")[0].decode() + "element vertex 3\n"
        header += "".join(f"property float {axis}\n" for axis in "xyz")
        header += "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        rows = "500000.123456 4649776.654321 10\n500000.143456 4649776.654321 10\n500000.123456 4649776.674321 10\n"
        (self.place / "tiny.ply").write_text(header + rows + "3 0 1 2\n")
        told = run("build", self.place / "tiny.ply", "-o", self.place / "tiny.gnm")
        self.assertEqual(told.returncode, 1)
        self.assertRegex(told.stderr, "(?s)more digits than a float holds.*no triangles are left")

    def test_normals_that_are_not_finite_are_named_for_every_format(self):
        normals = ("0 0 1", "nan 0 0", "0 0 1")
        places = ("0 0 0", "1 0 0", "0 1 0")
        header = "ply\nformat ascii 1.0\nelement vertex 3\n"
        header += "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz"))
        header += "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        rows = "".join(f"{place} {normal}\n" for place, normal in zip(places, normals)) + "3 0 1 2\n"
        lines = "".join(f"v {place}\nvn {normal}\n" for place, normal in zip(places, normals)) + "f 1//1 2//2 3//3\n"
        for name, content in (("n.ply", header + rows), ("n.off", "NOFF\n3 1 0\n" + rows), ("n.obj", lines)):
            report, _ = self.build(name, content)
            self.assertEqual(report["attributes_dropped"], {"normals that are not finite": 1}, name)

    def test_one_line_says_which_axis_is_up_and_how_to_turn_the_model(self):
        (self.place / "wall.ply").write_bytes(ply("double", True))
        for words, is_named in (((), True), (("--up", "z"), False)):
            built = self.expect(0, "", "build", self.place / "wall.ply", "-o", self.place / "wall.gnm", *words)
            lines = [line for line in built.stdout.splitlines() if "up " in line]
            self.assertEqual(len(lines), 1, lines)
            self.assertEqual("--up x, y, z" in lines[0], is_named, lines)

    def test_files_outside_of_the_source_root_need_the_option(self):
        (self.place / "deep").mkdir()
        (self.place / "red.mtl").write_text("newmtl a\nKd 1 0 0\n")
        mesh = self.place / "deep" / "a.obj"
        mesh.write_text("mtllib ../red.mtl\nusemtl a\n" + obj())
        words = ("build", mesh, "-o", self.place / "deep" / "a.gnm")
        self.expect(1, "a.obj:1: refers to a file outside the folder of the source: expected a path below", *words)
        self.expect(1, "--source-root", *words)
        self.expect(0, "", *words, "--source-root", self.place.path)
        model = self.place / "deep" / "a.gnm"
        self.expect(1, "--source-root", "verify", model, "--cuts", "1", "--source", mesh)
        self.expect(0, "", "verify", model, "--cuts", "1", "--source", mesh, "--source-root", self.place.path)
        self.expect(2, "--source-root", *words, "--source-root", self.place / "no such folder")


if __name__ == "__main__":
    unittest.main()
