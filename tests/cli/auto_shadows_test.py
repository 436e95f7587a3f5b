"""`--shadows auto`, the default: when it is exact, when it is maps, and the reason that `explain` gives."""
import csv
import json

from program import DATA, ProgramTest

PATH = DATA / "paths/sundial_orbit.json"
SIZE = ("--size", "64x64")
SOFTWARE = ("--backend", "software")
OF_MAPS = (
    ("--z-partitions", "4"),
    ("--face-partitions", "off"),
    ("--warp", "auto"),
    ("--eta", "0.5"),
    ("--shadow-texels", "2048x2048"),
    ("--filter", "0"),
    ("--stabilize", "off"),
    ("--max-aliasing", "4"),
    ("--split-lambda", "1"),
    ("--cull-casters", "on"),
)


class AutoShadows(ProgramTest):
    def plan(self, *words):
        return json.loads(self.expect(0, "", "explain", self.sundial, "--json", *words).stdout)

    def drawn(self, *words):
        stats = self.place / "auto.json"
        self.expect(0, "", "render", self.sundial, "-o", self.place / "auto.png", *SIZE, *SOFTWARE, "--stats", stats, *words)
        return json.loads(stats.read_text())["shadows"]

    def logged(self, *words):
        log = self.place / "auto.csv"
        self.expect(0, "", "bench", self.sundial, "--path", PATH, *SIZE, *SOFTWARE, "--frames", "3", "--warmup", "0",
                    "--csv", log, *words)  # fmt: skip
        with open(log, newline="") as file:
            return list(csv.DictReader(file))

    def test_it_is_exact_with_the_software_backend(self):
        self.assertEqual(self.drawn(), "exact")
        self.assertEqual(self.drawn("--shadows", "auto"), "exact")
        self.assertEqual({row["shadows"] for row in self.logged()}, {"exact"})
        plan = self.plan(*SIZE, *SOFTWARE)
        self.assertEqual(plan["shadows"], "exact")
        self.assertIn("the software backend draws exact shadows", plan["shadows_because"])

    def test_the_warp_that_is_left_open_has_logarithmic_rows_where_they_can_be_drawn(self):
        far_apart = ("--warp", "auto", "--eye", "-3,0.3,0.2", "--target", "5,0.2,0",
                     "--shadow-near", "0.05", "--shadow-far", "50")

        def told(*words, slices="auto"):
            return self.expect(0, "", "explain", self.sundial, *SIZE, *far_apart, "--z-partitions", slices, *words).stdout

        self.assertIn("+log", told(*SOFTWARE))
        self.assertNotIn("+log", told("--backend", "osmesa"))
        self.assertIn("only the software backend draws logarithmic maps", told("--backend", "osmesa"))
        self.assertNotIn("+log", told(*SOFTWARE, slices="4"))
        self.assertIn("--z-partitions selects a scheme", told(*SOFTWARE, slices="4"))
        stats = self.place / "log.json"
        self.expect(0, "", "render", self.sundial, "-o", self.place / "log.png", *SIZE, *SOFTWARE, "--stats", stats, *far_apart,
                    "--z-partitions", "auto")  # fmt: skip
        self.assertIn("+log", json.loads(stats.read_text())["scheme"])

    def test_it_means_maps_beside_each_option_of_them_even_at_its_default(self):
        for option, value in OF_MAPS:
            for named in ((), ("--shadows", "auto")):
                plan = self.plan(option, value, *named, *SOFTWARE)
                self.assertEqual(plan["shadows"], "maps", option)
                self.assertIn("of shadow maps is requested", plan["shadows_because"])
            self.assertEqual(self.drawn(option, value), "maps", option)
            self.assertEqual({row["shadows"] for row in self.logged(option, value)}, {"maps"}, option)
        self.assertEqual({row["shadows"] for row in self.logged("--shadow-maps", "1,4")}, {"maps"})
        self.assertEqual(self.drawn("--shadow-depth", self.place / "maps"), "maps")
        self.assertNotEqual(list((self.place / "maps").glob("*.pfm")), [])

    def test_overlays_and_proofs_of_maps_mean_them(self):
        for overlay in ("partitions", "texels", "aliasing", "projection"):
            self.assertEqual(self.drawn("--overlay", overlay), "maps", overlay)
        for overlay in ("none", "lod", "clusters", "residency"):
            self.assertEqual(self.drawn("--overlay", overlay), "exact", overlay)
        for oracle, shadows in (("same", "maps"), ("full", "maps"), ("exact", "exact")):
            self.assertEqual(self.drawn("--oracle", oracle), shadows, oracle)
            self.assertEqual(self.drawn("--oracle", oracle, "--section", "0,1,0,0,1,0"), shadows, oracle)
        self.assertEqual({row["shadows"] for row in self.logged("--oracle", "same")}, {"maps"})

    def test_gl_keeps_maps(self):
        plan = self.plan("--backend", "osmesa")
        self.assertEqual(plan["shadows"], "maps")
        self.assertIn("only the software backend draws exact shadows", plan["shadows_because"])

    def test_what_is_asked_for_is_said_to_be(self):
        for shadows in ("off", "maps", "exact", "rays"):
            plan = self.plan("--shadows", shadows)
            self.assertEqual((plan["shadows"], plan["shadows_because"]), (shadows, "they are requested"))

    def test_no_column_or_field_predicts(self):
        for row in self.logged("--shadows", "maps,exact,auto"):
            self.assertFalse({"predicted_sample_tests", "refined_cast_triangles", "refined_sample_tests"} & set(row))
        self.assertNotIn("predicted", self.plan("--shadows", "exact"))
        self.assertNotIn("predicted", self.expect(0, "", "explain", self.sundial, *SOFTWARE).stdout)

    def test_a_report_holds_maps_and_exact_shadows_by_their_names(self):
        self.expect(0, "", "bench", self.sundial, "--path", PATH, *SIZE, *SOFTWARE, "--quick", "--frames", "1", "--warmup",
                    "0", "--repetitions", "1", "--report", self.place / "page")  # fmt: skip
        with open(self.place / "page" / "bench.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({row["shadows"] for row in rows}, {"maps", "exact"})
        self.assertGreater(sum(row["shadows"] == "maps" for row in rows), 3)

    def test_nothing_is_cast_where_nothing_faces_the_light(self):
        dark = ("--light", "0,-1,0", "--eye", "0,9,0.1", "--target", "0,0,0")
        for shadows in ("exact", "auto"):
            plan = self.plan("--shadows", shadows, *dark, *SOFTWARE)
            self.assertIn({"effect": "exact shadows", "reason": "no visible surface faces the light"}, plan["omitted"])
