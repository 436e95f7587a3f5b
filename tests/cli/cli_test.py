"""Help, exit codes, one-line errors, and files that are there whole or not at all."""
import base64
import csv
import json
import math
import random
import os
import stat
import struct
import unittest

from program import DATA, ProgramTest, run

COMMANDS = ("make", "build", "info", "verify", "export", "path", "render", "explain", "bench", "view", "theory", "measure")


def square_document():
    """A glTF whose mesh is the square from (1, 0.5) to (3, 2) at z = -8. Its scene has node 0."""
    corners = [(1, 0.5, -8), (3, 0.5, -8), (3, 2, -8), (1, 2, -8)]
    buffer = struct.pack("<12f", *(number for corner in corners for number in corner))
    return {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": 48, "uri": "data:;base64," + base64.b64encode(buffer).decode()}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 6}]}],
        "scenes": [{"nodes": [0]}],
    }


class CommandLine(ProgramTest):
    def test_help_lists_every_command_and_each_has_its_own(self):
        overview = run("--help")
        self.assertEqual(overview.returncode, 0)
        for command in COMMANDS:
            self.assertIn(f"\n  {command} ", overview.stdout)
            own = run(command, "--help")
            self.assertEqual(own.returncode, 0)
            self.assertIn(f"Usage: gnomon {command}", own.stdout)
        self.assertRegex(run("--version").stdout, r"^gnomon \d+\.\d+\.\d+\n$")
        told = json.loads(run("--version", "--json").stdout)
        self.assertEqual("gnomon " + told["version"] + "\n", run("--version").stdout)
        self.assertIn("glb", told["writes"])
        self.assertEqual(run("--json", "info", "x").returncode, 2)

    def test_wrong_usage_is_exit_2(self):
        picture = self.place / "wrong.png"
        for words in (
            (),
            ("paint",),
            ("render",),
            ("render", self.sundial),
            ("render", self.sundial, "-o", picture, "--no-such-option"),
            ("render", self.sundial, "-o", self.place / "picture.jpg"),
            ("render", self.sundial, "-o", picture, "--size", "0x4"),
            ("render", self.sundial, "-o", picture, "--size", "20000x20"),
            ("render", self.sundial, "-o", picture, "--shadow-texels", "1000000x1000000"),
            ("render", self.sundial, "-o", picture, "--shadow-texels", "16384x16385"),
            ("explain", self.sundial, "--shadow-texels", "2147483647x2147483647"),
            ("render", self.sundial, "-o", picture, "--light", "0,0,0"),
            ("render", self.sundial, "-o", picture, "--light", "0,0,0", "--camera", DATA / "cameras/sundial_low.json"),
            ("render", self.sundial, "-o", picture, "--light", "1,nan,0"),
            ("render", self.sundial, "-o", picture, "--warp", "wavy"),
            ("render", self.sundial, "-o", picture, "--warp", "lspsm", "--eta", "0.5"),
            ("render", self.sundial, "-o", picture, "--warp", "lspsm", "--stabilize", "on"),
            ("render", self.sundial, "-o", picture, "--shadow-near", "5", "--shadow-far", "1"),
            ("render", self.sundial, "-o", picture, "--camera", "c.json", "--eye", "1,2,3"),
            ("render", self.sundial, "-o", picture, "--shaders", self.place / "nowhere"),
            ("export", self.sundial, "-o", self.place / "wrong.ply"),
            ("export", self.sundial, "-o", self.place / "wrong.ply", "--triangles", "5", "--error", "1"),
            ("make", "cube", "-o", self.place / "wrong.ply"),
            ("path", self.sundial, "--kind", "stroll", "-o", self.place / "wrong.json"),
            ("verify", self.sundial, "--cuts", "-1"),
            ("theory",),
        ):
            self.expect(2, "", *words)
        self.assertEqual(list(self.place.path.glob("wrong*")), [])

    def test_what_cannot_be_done_is_exit_1_and_leaves_no_file(self):
        missing = self.place / "missing"
        self.expect(1, "missing", "info", missing)
        self.expect(1, "missing", "build", missing, "-o", self.place / "undone.gnm")
        self.expect(1, "missing", "render", missing, "-o", self.place / "undone.png")
        self.expect(1, "missing", "bench", self.sundial, "--path", missing)
        self.expect(1, "this file is already a model", "build", self.sundial, "-o", self.place / "undone.gnm")
        self.expect(1, "--memory", "render", self.sundial, "-o", self.place / "undone.png", "--memory", "1")
        self.expect(1, "no level of detail has so few", "export", self.sundial, "-o", self.place / "undone.ply", "--triangles", "1")
        self.expect(1, "cannot create", "render", self.sundial, "-o", missing / "undone.png")
        self.assertEqual(list(self.place.path.glob("*undone*")), [])

    def test_textures_that_cannot_be_read_can_be_left_out(self):
        source, model = self.place / "textured.gltf", self.place / "textured.gnm"
        required = {"extensionsUsed": ["KHR_texture_basisu"], "extensionsRequired": ["KHR_texture_basisu"]}
        source.write_text(json.dumps(square_document() | required | {"nodes": [{"mesh": 0}]}))
        self.expect(1, "found KHR_texture_basisu", "build", source, "-o", model)
        self.expect(1, "or --textures off", "build", source, "-o", model)
        self.assertFalse(model.exists())
        self.expect(0, "", "build", source, "-o", model, "--textures", "off")
        self.assertTrue(model.exists())

    def test_a_picture_through_a_camera_of_the_source_shows_what_the_camera_sees(self):
        # At the depth of the square the picture shows 8 by 8.
        camera = {"type": "perspective", "perspective": {"yfov": 2 * math.atan(0.5), "znear": 0.1}}
        document = square_document() | {
            "cameras": [camera, {"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
            "nodes": [
                {"children": [1, 2, 3], "rotation": [0.5, 0.5, 0.5, 0.5], "scale": [3, 3, 3], "translation": [7e5, 5e6, 9]},
                {"mesh": 0},
                {"camera": 1, "translation": [0, 0, 9]},
                {"camera": 0},
            ],
        }
        source = self.place / "seen.gltf"
        source.write_text(json.dumps(document))
        model = self.place / "seen.gnm"
        report = json.loads(self.expect(0, "", "build", source, "-o", model, "--json").stdout)
        self.assertEqual((report["cameras"], report["attributes_dropped"]), (2, {}))
        self.assertEqual(json.loads(run("info", model, "--json").stdout)["cameras"], 2)
        paths = []
        for start in (model, source):
            paths.append(self.place / (start.name + ".json"))
            self.expect(0, "", "path", start, "--kind", "source", "-o", paths[-1])
        path = json.loads(paths[0].read_text())
        self.assertEqual(path, json.loads(paths[1].read_text()))
        self.assertEqual([key["time"] for key in path["keyframes"]], [0, 1])
        self.assertEqual(path["keyframes"][0]["eye"], [7e5, 5e6, 9])
        depth = self.place / "seen.pfm"
        picture = self.place / "seen.png"
        words = ("render", model, "-o", picture, "--size", "80x80", "--samples", "1", "--depth", depth)
        self.expect(0, "", *words, "--camera", paths[0])
        header, rest = b"Pf\n80 80\n-1.0\n", depth.read_bytes()
        self.assertTrue(rest.startswith(header))
        rows = struct.unpack("<6400f", rest[len(header):])  # from below
        seen = {(i % 80, i // 80) for i, value in enumerate(rows) if math.isfinite(value)}
        self.assertEqual(seen, {(x, y) for x in range(50, 70) for y in range(45, 60)})
        self.expect(1, "(kind source)", *words, "--camera", source)
        self.expect(1, "no camera", "path", self.sundial, "--kind", "source", "-o", self.place / "undone.json")
        self.assertFalse((self.place / "undone.json").exists())

    def test_a_device_is_written_to_and_not_replaced(self):
        # A full one, so that writing to it is seen; a copy of it, so that a failure costs nobody his.
        full = self.place / "full"
        try:
            os.mknod(full, 0o600 | stat.S_IFCHR, os.makedev(1, 7))
            full.open("rb").close()
        except PermissionError:
            self.skipTest("only root makes devices")
        self.expect(1, "No space left", "render", self.sundial, "-o", full, "--size", "64x64")
        self.expect(1, "No space left", "make", "statue", "--triangles", "2k", "-o", full)
        self.assertTrue(full.is_char_device())

    def test_shaders_are_read_from_the_folder_given(self):
        shaders = self.place / "shaders"
        picture = self.place / "shaders.png"
        drawing = ("render", self.sundial, "-o", picture, "--backend", "osmesa", "--size", "64x64", "--shaders", shaders)
        shaders.mkdir()
        for backend in ("osmesa", "software"):
            self.expect(2, str(shaders), *drawing[:5], backend, *drawing[6:])
        for source in (DATA.parent / "shaders").rglob("*.*"):
            copy = shaders / source.relative_to(DATA.parent / "shaders")
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(source.read_bytes())
        self.expect(0, "", *drawing)

    def test_a_bench_walks_the_paths_of_the_data_folder(self):
        for path, model in (("sundial_orbit", "sundial"), ("colonnade_walk", "colonnade")):
            log = self.place / f"{path}.csv"
            report = self.place / f"{path}.json"
            # fmt: off
            self.expect(0, "", "bench", self.place / f"{model}.gnm", "--path", DATA / "paths" / f"{path}.json",
                        "--size", "64x64", "--shadow-texels", "256x256", "--frames", "5", "--warmup", "0",
                        "--shadow-maps", "1,2", "--csv", log, "--json-file", report)
            # fmt: on
            with open(log, newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(len(rows), 10)
            self.assertEqual({row["shadow_maps"] for row in rows} - {"1", "2"}, set())
            self.assertEqual([row["frame"] for row in rows[:5]], list("01234"))
            self.assertEqual(len(json.loads(report.read_text())["benchmarks"]), 2)

    def test_a_model_that_does_not_get_coarse_is_told_of(self):
        number = random.Random(1)
        soup, model = self.place / "soup.ply", self.place / "soup.gnm"
        count = 20000
        corners = [" ".join(f"{number.random():.6f}" for _ in range(3)) for _ in range(3 * count)]
        faces = [f"3 {3 * i} {3 * i + 1} {3 * i + 2}" for i in range(count)]
        header = ["ply", "format ascii 1.0", f"element vertex {3 * count}", *(f"property float {c}" for c in "xyz"),
                  f"element face {count}", "property list uchar int vertex_indices", "end_header"]  # fmt: skip
        soup.write_text("\n".join([*header, *corners, *faces]) + "\n")
        told = self.expect(0, f"{model}: the coarsest level has", "build", soup, "-o", model, "--json")
        self.assertEqual(told.stderr.count("\n"), 1)
        coarsest = json.loads(told.stdout)["coarsest_triangles"]
        self.assertGreater(coarsest, 1000)
        self.assertIn(f" {coarsest} of {count} triangles", told.stderr)
        told = self.expect(0, "", "build", DATA / "models/sundial.ply", "-o", model)
        self.assertEqual(told.stderr, "")

    def test_a_tight_error_is_a_lower_bound_and_the_same_for_any_threads(self):
        mesh = self.place / "statue.ply"
        self.expect(0, "", "make", "statue", "--triangles", "8k", "--seed", "1", "-o", mesh)
        tightness = {}
        alone = self.place / "alone.gnm"
        self.expect(0, "", "build", mesh, "-o", alone, "--error", "tight", "--threads", 1)
        for error in ("measured", "tight"):
            model = self.place / f"{error}.gnm"
            self.expect(0, "", "build", mesh, "-o", model, "--error", error, "--threads", 2)
            told = json.loads(self.expect(0, "", "verify", model, "--source", mesh, "--cuts", "5", "--json").stdout)
            tightness[error] = next(check["tightness"] for check in told["checks"] if check["name"] == "error_bound")
        self.assertLess(tightness["tight"], 0.95 * tightness["measured"])
        self.assertEqual(alone.read_bytes(), model.read_bytes())

    def test_info_tells_far_coordinates_apart(self):
        survey, model = self.place / "survey.ply", self.place / "survey.gnm"
        survey.write_text("ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n"
                          "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
                          "10000000 0 0\n10000001 0 0\n10000001 1 0\n10000000 1 0\n3 0 1 2\n3 0 2 3\n")  # fmt: skip
        self.expect(0, "", "build", survey, "-o", model)
        bounds = run("info", model).stdout.splitlines()[2].split()
        (low, high) = ([float(x) for x in bounds[i].split(",")] for i in (1, 3))
        for got, expected in zip(low + high, [1e7, 0, 0, 1e7 + 1, 1, 0]):
            self.assertAlmostEqual(got, expected, delta=0.01, msg=bounds)

    def test_a_run_without_maps_promises_nothing(self):
        told = self.expect(0, "", "bench", self.sundial, "--path", DATA / "paths/sundial_orbit.json", "--size", "32x32",
                           "--shadow-texels", "128x128", "--frames", "1", "--warmup", "0", "--shadows", "off,maps,rays")  # fmt: skip
        promises = {line.split()[0]: line.split()[-2] for line in told.stdout.splitlines() if line.startswith("shadows:")}
        self.assertEqual((promises["shadows:off"], promises["shadows:rays"]), ("-", "-"))
        self.assertGreater(float(promises["shadows:maps"]), 0)

    def test_threads_are_no_more_than_asked_for(self):
        report = self.place / "threads.json"
        for threads in (1, 3):
            self.expect(0, "", "bench", self.sundial, "--path", DATA / "paths/sundial_orbit.json", "--size", "32x32",
                        "--frames", "1", "--threads", threads, "--json-file", report)  # fmt: skip
            self.assertEqual(json.loads(report.read_text())["context"]["threads"], str(threads))
        self.expect(0, "", "info", self.sundial, "--threads", "1")

    def test_every_camera_of_the_data_folder_is_one(self):
        for camera in sorted((DATA / "cameras").glob("*.json")):
            picture = self.place / "camera.png"
            self.expect(0, "", "render", self.sundial, "-o", picture, "--size", "32x32", "--camera", camera)


if __name__ == "__main__":
    unittest.main()
