"""`--occlusion`: who can do it, what is logged and told of it, and that it changes no picture."""
import csv
import json

from program import DATA, ProgramTest

PATH = DATA / "paths/sundial_orbit.json"
SIZE = ("--size", "64x64")


class Occlusion(ProgramTest):
    def test_gl_refuses_it_where_it_is_asked_for(self):
        for backend in ("osmesa", "egl"):
            told = self.expect(2, "--occlusion on", "render", self.sundial, "-o", self.place / "gl.png", *SIZE,
                               "--backend", backend, "--occlusion", "on")  # fmt: skip
            self.assertIn(f"--backend {backend}", told.stderr)
        self.assertFalse((self.place / "gl.png").exists())

    def test_a_bench_sweeps_it_and_logs_what_was_done(self):
        log = self.place / "log.csv"
        self.expect(0, "", "bench", self.sundial, "--path", PATH, *SIZE, "--frames", "2", "--shadows", "maps",
                    "--occlusion", "off,on", "--backend", "software", "--csv", log)  # fmt: skip
        with open(log, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({row["occlusion"] for row in rows}, {"off", "on"})
        for row in rows:
            self.assertEqual(row["clusters_hidden"] != "", row["occlusion"] == "on", row)

    def test_a_picture_is_the_same_and_the_plan_says_why_all_is_drawn(self):
        pictures = []
        for occlusion in ("off", "on", "auto"):
            picture = self.place / f"{occlusion}.png"
            self.expect(0, "", "render", self.sundial, "-o", picture, *SIZE, "--occlusion", occlusion)
            pictures.append(picture.read_bytes())
        self.assertEqual(pictures, pictures[:1] * 3)
        plan = json.loads(self.expect(0, "", "explain", self.sundial, "--occlusion", "off", "--json").stdout)
        self.assertIn({"effect": "occlusion culling", "reason": "switched off"}, plan["omitted"])
