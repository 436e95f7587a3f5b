"""`--shadows exact`: what contradicts it, what is logged of it, and that no pixel of it is wrong."""
import csv
import json

from program import DATA, ProgramTest

PATH = DATA / "paths/sundial_orbit.json"
SIZE = ("--size", "64x64")
OF_MAPS = (
    ("--z-partitions", "2"),
    ("--face-partitions", "on"),
    ("--warp", "lspsm"),
    ("--eta", "0.5"),
    ("--tsm-focus", "3"),
    ("--shadow-texels", "256x256"),
    ("--filter", "3"),
    ("--stabilize", "on"),
    ("--max-aliasing", "2"),
)


class ExactShadows(ProgramTest):
    def expect_refused(self, option, *words):
        told = self.expect(2, "--shadows exact", *words, "--shadows", "exact")
        self.assertIn(option, told.stderr)

    def test_options_of_maps_contradict_it(self):
        picture = self.place / "refused.png"
        for option, value in OF_MAPS:
            self.expect_refused(option, "render", self.sundial, "-o", picture, *SIZE, option, value)
            self.expect_refused(option, "explain", self.sundial, option, value)
            self.expect_refused(option, "bench", self.sundial, "--path", PATH, *SIZE, option, value)
            self.expect_refused(option, "view", self.sundial, option, value)
            words = ("explain", self.sundial, "--shadows", "maps", option, value)
            if option != "--tsm-focus":
                self.expect(0, "", *words)
        self.expect_refused("--shadow-maps", "bench", self.sundial, "--path", PATH, *SIZE, "--shadow-maps", "2")
        self.expect_refused("--shadow-depth", "render", self.sundial, "-o", picture, *SIZE,
                            "--shadow-depth", self.place / "refused.pfm")  # fmt: skip
        self.assertEqual(list(self.place.path.glob("refused*")), [])

    def test_gl_cannot_draw_it(self):
        picture = self.place / "gl.png"
        for backend in ("osmesa", "egl"):
            self.expect_refused(f"--backend {backend}", "render", self.sundial, "-o", picture, *SIZE, "--backend", backend)
            self.expect_refused(f"--backend {backend}", "bench", self.sundial, "--path", PATH, *SIZE, "--backend", backend)
        told = self.expect(2, "--backend osmesa", "bench", self.sundial, "--path", PATH, *SIZE, "--backend", "osmesa",
                           "--shadows", "maps,exact")  # fmt: skip
        self.assertIn("--shadows exact", told.stderr)
        self.expect_refused("--backend window", "view", self.sundial, "--backend", "window")
        self.assertFalse(picture.exists())

    def test_a_bench_logs_it_beside_maps(self):
        log = self.place / "both.csv"
        self.expect(0, "", "bench", self.sundial, "--path", PATH, *SIZE, "--frames", "3", "--warmup", "0",
                    "--shadows", "maps,exact", "--csv", log)  # fmt: skip
        with open(log, newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["shadows"] for row in rows], ["maps"] * 3 + ["exact"] * 3)
        counted = ("shadow_samples", "shadow_cells", "sample_tests", "exact_decisions", "touching_pixels")
        for row in rows:
            is_exact = row["shadows"] == "exact"
            for column in counted:
                self.assertEqual(row[column] != "", is_exact, column)
            for column in ("promised_aliasing_x", "promised_aliasing_z", "storage_factor", "promise_kept"):
                self.assertEqual(row[column] == "", is_exact, column)
            self.assertEqual(row["wrong_pixels_all"], "")
            self.assertGreater(int(row["gpu_bytes"]), 0)
            self.assertEqual(row["backend"], "software")
        self.assertGreater(int(rows[3]["shadow_samples"]), 100)
        self.assertEqual(rows[3]["shadow_maps"], "0")

    def test_no_pixel_of_it_is_wrong(self):
        stats = self.place / "stats.json"
        drawing = ("render", self.sundial, "-o", self.place / "exact.png", *SIZE, "--oracle", "exact", "--stats", stats)
        wrong = {}
        for shadows, *words in (("exact",), ("rays",), ("maps", "--shadow-texels", "32x32"), ("off",)):
            self.expect(0, "", *drawing, "--shadows", shadows, *words)
            row = json.loads(stats.read_text())
            self.assertEqual(row["shadows"], shadows)
            wrong[shadows] = row["wrong_pixels_all"]
        self.assertEqual(wrong["exact"], 0)
        self.assertGreater(wrong["maps"], 0)
        self.assertIsNone(wrong["off"])

    def test_its_plan_is_explained(self):
        words = ("explain", self.sundial, "--shadows", "exact")
        plan = json.loads(self.expect(0, "", *words, "--json").stdout)
        self.assertIn("exact", json.dumps(plan))
        self.assertIn("shadows are decided exactly", self.expect(0, "", *words).stdout)
