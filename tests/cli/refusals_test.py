"""What contradicts itself or cannot be right is refused before any work: exit 2 and one line."""
import csv
import json
import os
import signal
import subprocess
import time
import unittest

from program import DATA, GNOMON, ProgramTest, run

PATH = DATA / "paths/sundial_orbit.json"
SMALL = ("--size", "32x32", "--shadow-texels", "128x128", "--frames", "1", "--warmup", "0")


class Refusals(ProgramTest):
    def bench(self, code, said, *words):
        return self.expect(code, said, "bench", self.sundial, "--path", PATH, *SMALL, *words)

    def test_a_list_has_items_and_none_is_empty(self):
        for option in ("--warp", "--error-pixels", "--shadow-maps", "--z-partitions", "--shadow-texels"):
            for empty in ("", ",", "1,", ",1", "1,,2"):
                self.bench(2, option, option, empty)

    def test_an_output_that_is_an_input_is_refused_and_nothing_is_lost(self):
        model, mesh, path = self.place / "own.gnm", self.place / "own.ply", self.place / "own.json"
        model.write_bytes(self.sundial.read_bytes())
        mesh.write_bytes((DATA / "models/sundial.ply").read_bytes())
        path.write_bytes(PATH.read_bytes())
        (self.place / "link.ply").symlink_to(mesh)
        os.link(model, self.place / "other_name.png")
        camera = self.place / "camera.json"
        camera.write_bytes((DATA / "cameras/sundial_low.json").read_bytes())
        files = (model, mesh, path, camera)
        before = [file.read_bytes() for file in files]
        for words in (
            ("build", mesh, "-o", mesh),
            ("build", DATA / "models/colonnade.obj", mesh, "-o", self.place / "." / "own.ply"),
            ("build", mesh, "-o", self.place / "link.ply"),
            ("export", model, "-o", model, "--error", "1"),
            ("path", model, "--kind", "orbit", "-o", model),
            ("render", model, "-o", self.place / "other_name.png", "--size", "8x8"),
            ("render", model, "-o", self.place / "new.png", "--size", "8x8", "--stats", model),
            ("render", model, "-o", self.place / "new.png", "--size", "8x8", "--camera", camera, "--depth", camera),
            ("bench", model, "--path", path, *SMALL, "--csv", path),
            ("bench", model, "--path", path, *SMALL, "--json-file", model),
            ("bench", model, "--path", path, *SMALL, "--json-file", path, "--baseline", path),
            ("theory", "eval", path, "-o", path),
            ("view", model, "--csv", model),
        ):
            self.expect(2, "would replace", *words)
            self.assertEqual([file.read_bytes() for file in files], before, words)
        self.bench(2, "the same file", "--csv", self.place / "new", "--json-file", self.place / "." / "new")
        self.expect(0, "", "render", model, "-o", "/dev/null", "--depth", "/dev/null", "--size", "8x8")

    def test_a_bench_says_at_once_what_it_cannot_write_or_read(self):
        file, bad = self.place / "file", self.place / "bad.json"
        file.write_text("in the way of a folder")
        for text in ("", "[]", "{}", '{"benchmarks": 3}', '{"context": {}, "benchmarks": [{"name": 3, "p50": 1}]}',
                     '{"context": {}, "benchmarks": [{"name": "run"}]}'):  # fmt: skip
            bad.write_text(text)
            self.assertEqual(self.bench(1, "bad.json", "--baseline", bad).stdout, "", text)
        for option in ("--csv", "--json-file", "--images", "--report", "--baseline"):
            told = self.bench(1, "file/below", option, self.place / "file/below")
            self.assertEqual(told.stdout, "", "it has walked first")

    def test_a_picture_is_not_drawn_where_an_output_or_the_reference_fails(self):
        file, picture = self.place / "no_folder", self.place / "undrawn.png"
        file.write_text("in the way of a folder")
        for option in ("--stats", "--depth", "--shadow-depth", "--reference"):
            self.expect(1, "no_folder/below", "render", self.sundial, "-o", picture, "--size", "8x8", option, file / "below")
            self.assertEqual(list(self.place.path.glob("undrawn*")), [], option)
        picture.write_bytes(b"in place already")
        self.expect(1, "undrawn.png", "render", self.sundial, "-o", self.place / "drawn.png", "--size", "8x8",
                    "--reference", picture)  # fmt: skip
        self.assertEqual(list(self.place.path.glob("drawn*")), [])
        depth = self.place / "depth.pfm"
        self.expect(0, "", "render", self.sundial, "-o", picture, "--size", "8x8", "--depth", depth)
        self.assertEqual(picture.read_bytes()[1:4], b"PNG")
        self.assertEqual(depth.read_bytes()[:2], b"Pf")

    def test_an_interrupted_bench_leaves_no_empty_folder(self):
        made, there = self.place / "made/deep", self.place / "there"
        there.mkdir()
        words = ("bench", self.sundial, "--path", PATH, "--size", "32x32", "--frames", "1000000", "--shadow-maps", "1")
        bench = subprocess.Popen([GNOMON, *words, "--report", made, "--images", there], stderr=subprocess.PIPE, text=True)
        late = time.monotonic() + 60
        while not made.exists() and time.monotonic() < late:
            time.sleep(0.01)
        self.assertTrue(made.exists())
        time.sleep(0.2)  # until it walks
        bench.send_signal(signal.SIGINT)
        self.assertIn("interrupted", bench.communicate(timeout=60)[1])
        self.assertEqual((bench.returncode, made.parent.exists(), there.exists()), (1, False, True))

    def test_a_name_that_is_no_utf8_is_a_name(self):
        model = self.place / os.fsdecode(b"\xff\xfe.gnm")
        model.write_bytes(self.sundial.read_bytes())
        log, stats = self.place / "log.json", self.place / "stats.json"
        self.expect(0, "", "bench", model, "--path", PATH, *SMALL, "--json-file", log, "--report", self.place / "page",
                    "--quick", "--repetitions", "1", "--warp", "none,auto")  # fmt: skip
        self.assertEqual(json.loads(log.read_text())["context"]["model"], "\ufffd\ufffd.gnm")
        self.expect(0, "", "render", model, "-o", self.place / "name.png", "--size", "8x8", "--stats", stats)
        self.assertTrue(json.loads(stats.read_text())["model"].endswith("/\ufffd\ufffd.gnm"))

    def test_output_that_does_not_arrive_is_exit_1(self):
        light = ("--near", "1", "--far", "10", "--fov-y", "60", "--light", "0,1,0")
        for words in (
            ("--help",),
            ("render", "--help"),
            ("--version",),
            ("info", self.sundial),
            ("info", self.sundial, "--json"),
            ("verify", self.sundial, "--cuts", "1", "--json"),
            ("explain", self.sundial, "--json"),
            ("build", DATA / "models/sundial.ply", "-o", self.place / "full.gnm", "--json"),
            ("theory", "table", *light),
        ):
            with open("/dev/full", "w") as full:
                told = subprocess.run([GNOMON, *map(str, words)], stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual((told.returncode, told.stderr.count("\n")), (1, 1), f"{words}: {told.stderr}")
            self.assertIn("gnomon: stdout: cannot write", told.stderr)

    def test_shadow_maps_are_slices_without_faces(self):
        for faces in ("on", "auto", "off,on"):
            self.bench(2, "--face-partitions", "--shadow-maps", "1,4", "--face-partitions", faces)
        self.bench(2, "--z-partitions", "--shadow-maps", "1,4", "--z-partitions", "2")
        log = self.place / "maps.csv"
        self.bench(0, "", "--shadow-maps", "1,3", "--face-partitions", "off", "--csv", log)
        with open(log, newline="") as file:
            rows = [(row["shadow_maps"], row["face_partitions"]) for row in csv.DictReader(file)]
        self.assertEqual(rows, [("1", "off"), ("3", "off")])

    def test_no_value_of_a_list_is_there_twice(self):
        for option, values in (("--shadow-maps", "1,1"), ("--z-partitions", "4,2,4"), ("--warp", "auto,auto"),
                               ("--error-pixels", "1,2,1"), ("--shadows", "maps,maps"), ("--filter", "0,0")):  # fmt: skip
            self.bench(2, option, option, values)

    def test_what_has_no_sun_has_no_shadows(self):
        for shading in ("headlight", "unlit"):
            for asked in (("--shadows", "maps"), ("--shadows", "exact"), ("--z-partitions", "2")):
                self.expect(2, "--shading", "explain", self.sundial, "--shading", shading, *asked)
            for given in ((), ("--shadows", "off")):
                told = self.expect(0, "", "explain", self.sundial, "--shading", shading, *given)
                self.assertIn("shadows off", told.stdout)
            drawing = ("render", self.sundial, "-o", self.place / "sunless.png", "--size", "8x8", "--shading", shading)
            self.expect(2, "--shading", *drawing, "--overlay", "partitions")
        self.expect(0, "", "explain", self.sundial, "--shading", "flat", "--shadows", "maps")

    def test_a_transparent_background_is_the_pictures_alpha(self):
        picture = self.place / "clear.png"
        drawing = ("render", self.sundial, "-o", picture, "--size", "16x16")
        for background, channels in (("transparent", 6), ("sky", 2), ("#204060", 2), ("white", 2)):
            self.expect(0, "", *drawing, "--background", background)
            self.assertEqual(picture.read_bytes()[25], channels, background)
        self.expect(2, "--overlay", *drawing, "--background", "transparent", "--overlay", "lod")

    def test_stabilised_slices_have_no_warp(self):
        for eta in ("0.5", "0", "1"):
            self.expect(2, "--stabilize", "explain", self.sundial, "--stabilize", "on", "--eta", eta)
        self.expect(2, "--stabilize", "explain", self.sundial, "--stabilize", "on", "--warp", "auto")
        self.expect(0, "", "explain", self.sundial, "--stabilize", "on", "--eta", "-1")
        self.expect(0, "", "explain", self.sundial, "--stabilize", "off", "--eta", "0.5")
        self.bench(2, "--stabilize", "--stabilize", "off,on", "--eta", "0.5")

    def test_a_baseline_is_of_the_same_walk_view_and_settings(self):
        before, other_path = self.place / "walked.json", self.place / "lifted.json"
        path = json.loads(PATH.read_text())
        path["keyframes"][0]["eye"][1] += 0.5
        other_path.write_text(json.dumps(path))
        usual = {"--path": PATH, "--size": "32x32", "--shadow-texels": "128x128", "--frames": "2", "--warmup": "0",
                 "--z-partitions": "1,2", "--memory": "512M", "--threads": "1"}  # fmt: skip

        def walked(code, said, *flags, **changes):
            asked = {**usual, **{"--" + name.replace("_", "-"): value for name, value in changes.items()}}
            return self.expect(code, said, "bench", self.sundial, *[w for pair in asked.items() for w in pair], *flags)

        walked(0, "", json_file=before)
        context = json.loads(before.read_text())["context"]
        self.assertEqual((context["path"], context["shadow_texels"]), (PATH.name, "128x128"))
        self.assertEqual(context["options"], "shadow_texels:128x128")
        self.assertNotIn("z_partitions", context)
        held = {"baseline": before, "fail_above": "1e9"}
        self.assertEqual(walked(0, "", **held).stderr, "")
        told = walked(5, "2 gates fail", z_partitions="2,3", **held)
        name = "sundial/sundial_orbit/maps,z_partitions:{},shadow_texels:128x128/32x32/default/software run: expected {}"
        for run in (name.format(3, "missing, found present"), name.format(1, "present, found missing")):
            self.assertIn(run, told.stderr)
        for key, option, value in (
            ("path_content_hash", "path", other_path),
            ("frames", "frames", "3"),
            ("light", "light", "0,1,0"),
            ("near_and_far", "near", "1"),
            ("memory_cap", "memory", "128M"),
            ("gpu_memory_cap", "gpu_memory", "64M"),
            ("threads", "threads", "2"),
            ("max_triangles", "max_triangles", "1000"),
            ("split_lambda", "split_lambda", "0.5"),
            ("eta", "eta", "0.25"),
            ("options: expected shadow_texels:128x128, found shadow_texels:64x64", "shadow_texels", "64x64"),
            ("options", "error_pixels", "2"),
            ("picture", "sun_angle", "1"),
        ):
            told = walked(5, f"comparable {key}", **held, **{option: value})
            self.assertEqual(told.stdout, "", "it has walked first")
        walked(5, "comparable real_time", "--no-wait", **held)

    def test_a_baseline_is_of_the_same_model_size_and_backend(self):
        before, changed = self.place / "before.json", self.place / "changed.json"
        self.bench(0, "", "--json-file", before)
        self.bench(0, "", "--baseline", before, "--fail-above", "1e9")
        for key in ("model_content_hash", "image_size", "backend"):
            document = json.loads(before.read_text())
            document["context"][key] = "another"
            changed.write_text(json.dumps(document))
            told = self.bench(5, key, "--baseline", changed, "--fail-above", "1e9")
            self.assertEqual(told.stdout, "", "it has walked first")
            del document["context"][key]
            changed.write_text(json.dumps(document))
            self.bench(5, key, "--baseline", changed, "--fail-above", "1e9")
        for option in ("--fail-above", "--budget-ms"):
            for value in ("-1", "-50", "nan", "inf", "x"):
                self.bench(2, option, option, value, "--baseline", before)
        self.bench(2, "--budget-ms", "--budget-ms", "0")

    def test_a_path_is_the_only_camera_of_a_bench(self):
        for option in (("--eye", "1,2,3"), ("--target", "1,2,3"), ("--view", "top"), ("--fov-y", "40"),
                       ("--camera", DATA / "cameras/sundial_low.json")):  # fmt: skip
            self.bench(2, option[0], *option)

    def test_a_theory_table_of_no_view_is_wrong_usage(self):
        view = {"--near": "1", "--far": "10", "--fov-y": "60", "--light": "0,1,0"}
        for option, value, said in (("--far", "0.5", "far 0.5"), ("--near", "nan", "near nan"), ("--near", "-1", "near"),
                                    ("--far", "inf", "far inf"), ("--fov-y", "200", "angle"), ("--fov-y", "0", "angle"),
                                    ("--aspect", "0", "aspect"), ("--aspect", "nan", "aspect"),
                                    ("--light", "inf,1,0", "inf,1,0"), ("--light", "0,0,0", "0,0,0"),
                                    ("--light", "0,1", "0,1"), ("--light", "1e308,1e308,0", "1e308")):  # fmt: skip
            words = [word for pair in {**view, option: value}.items() for word in pair]
            self.expect(2, said, "theory", "table", *words)
        self.expect(0, "", "theory", "table", *[word for pair in view.items() for word in pair])

    def test_what_is_refused_is_named_with_what_was_found(self):
        picture, mesh = self.place / "refused.png", self.place / "refused.ply"
        for words, said in (
            (("render", self.sundial, "-o", picture, "--light", "1e300,1e300,1"), "found '1e300,1e300,1'"),
            (("render", self.sundial, "-o", picture, "--up", "1e300,1e300,1"), "found '1e300,1e300,1'"),
            (("explain", self.sundial, "--light", "0,0,0"), "found '0,0,0'"),
            (("bench", self.sundial, "--path", PATH, *SMALL, "--shadow-maps", "0"), "--shadow-maps: expected"),
            (("bench", self.sundial, "--path", PATH, *SMALL, "--shadow-maps", "1,13"), "found '13'"),
            (("make", "statue", "--triangles", "3", "-o", mesh), "found 3"),
            (("make", "statue", "--seed", "-1", "-o", mesh), "found '-1'"),
            (("verify", self.sundial, "--seed", "-1"), "found '-1'"),
            (("render", self.sundial, "-o", picture, "--backend", "window"), "--backend window works only with gnomon view"),
            (("bench", self.sundial, "--path", PATH, *SMALL, "--backend", "window"), "--backend window works only with gnomon view"),
            (("export", self.sundial, "-o", mesh, "--error", "nan"), "found 'nan'"),
            (("export", self.sundial, "-o", mesh, "--error", "-1"), "found '-1'"),
        ):
            self.expect(2, said, *words)
        self.assertEqual(list(self.place.path.glob("refused*")), [])
        self.expect(0, "", "make", "statue", "--triangles", "2k", "--seed", str(2**64 - 1), "-o", mesh)

    def test_no_file_has_the_name_of_another_format(self):
        mesh = DATA / "models/sundial.ply"
        for said, words, names in (
            (".ply", ("export", self.sundial, "--error", "1"), ("named.obj", "named.gnm", "named.plyx")),
            (".ply", ("make", "statue", "--triangles", "2k"), ("named.stl", "named.gnm")),
            (".gnm", ("build", mesh), ("named.PLY", "named.gn")),
        ):
            for name in names:
                self.expect(2, f"a name ending in {said}", *words, "-o", self.place / name)
            self.assertEqual(list(self.place.path.glob("named*")), [])
        self.expect(0, "", "export", self.sundial, "--error", "1", "-o", self.place / "named.PLY")
        self.expect(0, "", "build", mesh, "-o", self.place / "named")

    def test_json_may_come_through_a_pipe(self):
        camera = (DATA / "cameras/sundial_low.json").read_text()
        for words, text in (
            (("explain", self.sundial, "--camera", "/dev/stdin"), camera),
            (("theory", "eval", "/dev/stdin"), '{"rows": []}' + " " * 100000),
        ):
            self.expect(0, "", *words, input=text)
            self.expect(1, "not JSON", *words, input=text[:-1] + "x" if "eval" in words else "x")

    def test_the_window_refuses_wrong_usage_before_it_opens_or_builds(self):
        mesh = self.place / "seen.ply"
        mesh.write_bytes((DATA / "models/sundial.ply").read_bytes())
        camera = DATA / "cameras/sundial_low.json"
        for words in (
            ("--light", "foo"),
            ("--light", "0,0,0"),
            ("--camera", camera, "--eye", "1,2,3"),
            ("--memory", "plenty"),
            ("--memory", "0"),
            ("--gpu-memory", "x"),
            ("--build-memory", "x"),
            ("--fov-y", "200"),
            ("--up", "0,0,0"),
            ("--up", "w"),
            ("--view", "inside"),
            ("--view", "top", "--eye", "1,2,3"),
            ("--view", "top", "--camera", camera),
            ("--eye", "1,2,3", "--target", "1,2,3"),
            ("--size", "0x4"),
            ("--warp", "wavy"),
            ("--warp", "fitted"),
            ("--frames", "3"),
            ("--stabilize", "on", "--eta", "0.5"),
        ):
            self.expect(2, "", "view", mesh, *words, env={**os.environ, "DISPLAY": ":none"})
        self.assertEqual(list(self.place.path.glob("seen.ply.gnm*")), [])

    def test_the_options_that_a_bench_prints_draw_the_same(self):
        given = ("--eta", "0.25", "--split-lambda", "0.5", "--light", "1,2,0.5")
        told = self.bench(0, "", "--error-pixels", "1,2", "--budget-ms", "1e9", *given)
        for line in ("fastest with an aliasing bound", "budget: "):
            printed = next(text for text in told.stdout.splitlines() if text.startswith(line))
            for option, value in zip(given[::2], given[1::2]):
                self.assertIn(f"{option} {value}", printed)
            self.assertIn("--size 32x32", printed)

    def test_what_stands_behind_the_oracle_is_told(self):
        picture = self.place / "oracle.png"
        small = ("-o", picture, "--size", "32x32")
        self.expect(2, "write MODEL before this option", "render", "--oracle", self.sundial, *small)
        self.expect(2, "write MODEL before this option", "bench", "--oracle", self.sundial, "--path", PATH)
        for oracle in (("--oracle",), ("--oracle", "full"), ("--oracle=full",)):
            self.expect(0, "", "render", self.sundial, *small, *oracle)
        self.expect(0, "", "render", *small, "--oracle", "full", self.sundial)

    def test_a_file_that_cannot_be_made_is_called_by_its_name(self):
        picture = self.place / "missing/p.png"
        told = self.expect(1, f"{picture}: cannot create", "render", self.sundial, "-o", picture, "--size", "8x8")
        self.assertNotIn("partial", told.stderr)

    def test_memory_is_written_as_people_write_it(self):
        for size in ("1G", "1GB", "1GiB", "1024MiB"):
            self.expect(0, "", "explain", self.sundial, "--memory", size)
            self.expect(0, "", "build", DATA / "models/sundial.ply", "-o", self.place / "size.gnm", "--memory", size)

    def test_a_path_is_written_in_round_degrees(self):
        path = self.place / "round.json"
        self.expect(0, "", "path", self.sundial, "--kind", "orbit", "-o", path)
        self.assertEqual({key["fov_y"] for key in json.loads(path.read_text())["keyframes"]}, {60})


if __name__ == "__main__":
    unittest.main()
