"""Replays the inputs of ../shared/faults/turn3, which once failed, and compares each result with the numbers of the input.

A row of ROWS is one build, its expected exit code and the expected facts. The shadow maps of d2*.cpp are tested in
tests/frame.
"""
import dataclasses
import json
import os
import pathlib
import shutil
import struct
import subprocess
import unittest

from program import DATA, GNOMON, run
from replay import FAULTS, IS_SANITIZED, ReplayTest, pixels_of

RED, GREEN, GREY = (255, 0, 0), (0, 255, 0), (128, 128, 128)


@dataclasses.dataclass
class Row:
    """A build of `source` with `options`, and what must be true of it."""

    source: str
    options: tuple = ()
    code: int = 0
    says: tuple = ()  # patterns of which the messages and the report match each
    triangles: int | None = None
    colors: tuple | None = None  # of the vertices with x below 1.5, and of the others
    palette: frozenset | None = None  # the colours that the vertices have
    box: tuple | None = None  # extents along x, y and z
    hash_of: str | None = None  # the file whose content hash it must have
    up: str | None = None
    seconds: float | None = None  # of processor time, at most
    mebibytes: int | None = None  # of peak resident size, at most


QUADS = {"triangles": 4, "colors": (RED, GREEN)}
ROWS = (
    *(Row(f"01_far_text/wall.{kind}", ("--up", "y"), box=(0.3, 0.02, 1), hash_of="01_far_text/wall.ply")
      for kind in ("obj", "off", "stl")),
    Row("02a_material_hash/m.obj", **QUADS),
    Row("02b_material_tabs/m.obj", **QUADS),
    Row("02c_kd_one_number/m.obj", triangles=4, colors=(GREY, GREEN)),
    Row("03a_nan_normal_obj/n.obj", triangles=1, says=("[Nn]ormal",)),
    Row("03a_nan_normal_obj/n.ply", triangles=1),
    *(Row(f"03b_underflow/u.{kind}", triangles=1) for kind in ("obj", "off", "stl")),
    *(Row(f"05{name}", triangles=2, box=(1, 1, 0)) for name in
      ("a_off_glued/g.off", "b_off_comment_first/c.off", "c_off_two_counts/t.off", "d_off_wrapped/w.off")),
    Row("05e_off_colours_unnamed/v.off", triangles=2, colors=(RED, RED)),
    Row("06_stl_one_line/o.stl", triangles=1, box=(1, 1, 0)),
    Row("07_stl_colours/magics.stl", triangles=2, palette=frozenset((RED, GREEN))),
    Row("07_stl_colours/viscam.stl", triangles=2, palette=frozenset((RED, GREEN))),
    Row("08_specular_glossiness/s.gltf", triangles=12, colors=(RED, RED)),
    Row("10_rotation_not_unit/r.gltf", triangles=12, box=(1, 1, 1)),
    Row("10_rotation_not_unit/byte.gltf", triangles=12, box=(1.70191, 1.40649, 1.65464)),
    Row("11_required_texture_extension/k.gltf", ("--textures", "off"), triangles=2),
    Row("11_required_texture_extension/k.gltf", code=1, says=("KHR_texture_basisu", "--textures off")),
    Row("12_glb_chunk_between/c.glb", triangles=12, box=(1, 1, 1)),
    Row("14_camera/c.gltf", triangles=12, box=(1, 1, 1)),
    Row("32_utf16_obj/u.obj", code=1, says=("UTF-16", "UTF-8")),
    Row("gltf_dotdot.gltf", code=1, says=("--source-root",)),
    Row("gltf_nul.gltf", code=1, says=("%00",)),
    Row("bomb_mtl_many.obj", seconds=3),
    Row("bomb_jpg_10000_prog.glb", ("--memory", "512M"), code=None, mebibytes=512, seconds=10),
    Row("bomb_jpg_5000_prog_20000scans.glb", ("--memory", "512M"), code=None, mebibytes=512, seconds=10),
    Row("png_ztxt.glb", ("--memory", "512M"), code=None, mebibytes=512, seconds=10),
)


class Replay(ReplayTest):
    def check(self, row):
        model = self.place / "m.gnm"
        code, out, err, seconds, peak = self.measured(
            GNOMON, "build", FAULTS / row.source, "-o", model, "--json", "--progress", "none", *row.options)
        if row.code is not None:
            self.assertEqual(code, row.code, err)
        self.assertIn(code, (0, 1), err)
        if code == 1:
            self.assertEqual(err.count("\n"), 1, err)
        for pattern in row.says:
            self.assertRegex(out + err, pattern)
        if row.seconds is not None and not IS_SANITIZED:
            self.assertLess(seconds, row.seconds)
        if row.mebibytes is not None and not IS_SANITIZED:
            self.assertLess(peak, row.mebibytes)
        if code == 1:
            return
        report = json.loads(out)
        if row.triangles is not None:
            self.assertEqual(report["source_triangles"], row.triangles)
        if row.hash_of:
            self.assertEqual(report["content_hash"], self.built(row.hash_of, *row.options)[1]["content_hash"])
        if row.up:
            self.assertEqual(report["up"], row.up)
        if row.box:
            bounds = self.info(model)["bounds"]
            for low, high, extent in zip(bounds["min"], bounds["max"], row.box):
                self.assertAlmostEqual(high - low, extent, delta=2e-3 * max(row.box))
        if row.palette:
            self.assertEqual({color for _, color in self.vertices(model)}, row.palette)
        if row.colors:
            for position, color in self.vertices(model):
                self.assertEqual(color, row.colors[position[0] > 1.5], position)

    def test_rows(self):
        for row in ROWS:
            with self.subTest(row=" ".join((row.source, *row.options))):
                self.check(row)

    def test_a_far_triangle_costs_the_rest_no_detail(self):
        near, report, _ = self.built("15_stray_at_origin/near.ply", "--up", "z")
        expected, collapsed = self.info(near), report["dropped"]["collapsed_by_grid"]
        stray, report, said = self.built("15_stray_at_origin/stray.ply", "--up", "z")
        found = self.info(stray)
        self.assertRegex(said + json.dumps(report), "(?i)stray")
        self.assertEqual(report["dropped"]["collapsed_by_grid"], collapsed)
        self.assertEqual((found["grid_step"], found["bounds"]), (expected["grid_step"], expected["bounds"]))
        pictures = []
        for model in (near, stray):
            self.expect(0, "", "render", model, "-o", self.place / "p.png", "--size", "64x64")
            pictures.append((self.place / "p.png").read_bytes())
        self.assertEqual(*pictures)
        kept = self.info(self.built("15_stray_at_origin/stray.ply", "--up", "z", "--keep-strays")[0])["bounds"]
        self.assertGreater(kept["max"][1] - kept["min"][1], 5e6)

    def test_of_coplanar_faces_the_first_one_is_seen(self):
        model, picture = self.built("17_coplanar_flicker/c.ply", "--up", "z")[0], self.place / "c.png"
        for backend in ("software", "osmesa"):
            for eye in ("13,-9,6", "5,-4,9", "-6,12,3"):
                self.expect(0, "", "render", model, "-o", picture, "--shading", "unlit", "--samples", "1", "--size",
                            "100x100", "--backend", backend, f"--eye={eye}", "--target", "5,3,0")
                green = sum(p[1] > p[0] + 50 for row in pixels_of(picture) for p in row)
                grey = sum(max(p[:3]) - min(p[:3]) < 8 and 140 < p[0] < 160 for row in pixels_of(picture) for p in row)
                self.assertEqual(green, 0, f"{backend} from {eye}")
                self.assertGreater(grey, 300)

    def test_videos_name_their_colours(self):
        for size, chroma in (("64x48", "420"), ("61x47", "444")):
            command = [GNOMON, "render", self.sundial, "--turntable", "2", "--size", size, "--samples", "1", "-o", "-"]
            video = subprocess.run([*map(str, command)], capture_output=True, timeout=120)
            self.assertEqual(video.returncode, 0, video.stderr)
            header, _, frames = video.stdout.partition(b"\n")
            self.assertIn(b"XCOLORRANGE=LIMITED", header)
            if chroma == "444":
                self.assertIn(b"C444", header)
            width, height = map(int, size.split("x"))
            luma = frames[len(b"FRAME\n") : len(b"FRAME\n") + width * height]
            self.assertGreaterEqual(min(luma), 16)
            self.assertLessEqual(max(luma), 235)

    def test_the_up_axis_is_z_or_unsure(self):
        for name in ("table.ply", "room.ply", "floors.ply", "pitch.obj"):
            with self.subTest(name):
                model, report, said = self.built(f"31_up_guess_z/{name}")
                confidence = self.info(model)["up_confidence"]
                if report["up"] != "z":
                    self.assertEqual(confidence, "unsure")
                    self.assertIn("--up", said + json.dumps(report))

    def test_cameras_of_a_gltf_are_kept(self):
        walk = self.place / "cameras.json"
        model = self.built("14_camera/c.gltf")[0]
        self.expect(0, "", "path", model, "--kind", "source", "-o", walk)
        self.assertRegex(walk.read_text().replace("\n", ""), r"0\.5,\s*0\.5,\s*4")

    def test_all_formats_of_a_survey_have_one_hash(self):
        """The mesh of gen.py, smaller."""
        side, step = 12, 0.01
        points, faces = [], []
        for i in range(side):
            for j in range(side):
                height = 123.4 + 0.05 * ((i * 7 + j * 3) % 11) / 11 + (0.2 if i > side // 2 else 0)
                points.append((f"{500000.123 + i * step:.4f}", f"{4649776.456 + j * step:.4f}", f"{height:.4f}"))
                if i and j:
                    a = (i - 1) * side + j - 1
                    faces += [(a, a + side, a + side + 1), (a, a + side + 1, a + 1)]
        rows = [" ".join(point) for point in points]
        listed = "".join(f"3 {a} {b} {c}\n" for a, b, c in faces)
        meshes = {
            "s.obj": "".join(f"v {row}\n" for row in rows) + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces),
            "s.off": f"OFF\n{len(rows)} {len(faces)} 0\n" + "".join(f"{row}\n" for row in rows) + listed,
            "s.stl": "solid s\n" + "".join(
                "facet normal 0 0 1\nouter loop\n" + "".join(f"vertex {rows[v]}\n" for v in face)
                + "endloop\nendfacet\n" for face in faces) + "endsolid s\n",
        }  # fmt: skip
        header = "".join(f"property double {axis}\n" for axis in "xyz")
        for form in ("ascii", "binary_little_endian", "binary_big_endian"):
            order = ">" if "big" in form else "<"
            text = (f"ply\nformat {form} 1.0\nelement vertex {len(rows)}\n{header}element face {len(faces)}\n"
                    "property list uchar int vertex_indices\nend_header\n")  # fmt: skip
            body = ("".join(f"{row}\n" for row in rows) + listed).encode()
            if form != "ascii":
                body = b"".join(struct.pack(order + "3d", *map(float, point)) for point in points)
                body += b"".join(struct.pack(order + "B3i", 3, *face) for face in faces)
            meshes[f"{form}.ply"] = text.encode() + body
        hashes = {}
        for name, content in meshes.items():
            mesh = self.place / name
            mesh.write_bytes(content if isinstance(content, bytes) else content.encode())
            hashes[name] = self.built(mesh, "--up", "y")[1]["content_hash"]
        stl = hashes.pop("s.stl")  # its vertices repeat, and each counts
        self.assertEqual(len(set(hashes.values())), 1, hashes)
        self.assertEqual(stl, hashes["s.obj"])

    def test_the_range_cache_removes_no_files_of_others(self):
        script = [FAULTS / "cache_link.sh", GNOMON, pathlib.Path(__file__).resolve().parents[2]]
        told = subprocess.run(["bash", *map(str, script)], capture_output=True, text=True, timeout=60)
        self.assertEqual(told.stdout.split()[-1], "20", told.stdout + told.stderr)

    def test_a_gpu_that_fails_gives_way_to_the_next(self):
        if not pathlib.Path("/usr/lib/x86_64-linux-gnu/libEGL.so.1").exists():
            self.skipTest("there is no EGL")
        picture = self.place / "egl.png"
        environment = dict(os.environ, LD_LIBRARY_PATH=str(FAULTS / "d9_egl_shim"))
        code, _, err, _, _ = self.measured(
            GNOMON, "render", self.sundial, "-o", picture, "--size", "32x32", "--backend", "egl", env=environment)
        self.assertEqual(code, 0, err)
        self.assertIn("the GPU that works", err, "the shim's own line")


if __name__ == "__main__":
    unittest.main()
