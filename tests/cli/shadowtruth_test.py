"""`scripts/shadowtruth` and its scorer: exact coordinates, reproducible bytes, and the counts of broken masks.

The scorer is compared with plain loops. Tests that need numpy are skipped without it.
"""
import json
import math
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import unittest

from program import GNOMON, ProgramTest, run

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bench/shadowtruth"))
import cases  # noqa: E402
import scenes  # noqa: E402
from grey_png import read_grey, write_png  # noqa: E402

SUBSET = ("bricks-04-close", "bricks-07-top", "lamp_room-11-top", "grating-09-eye_level", "low_sun-03-tele")
LIT, DARK, AWAY, NEAR, NONE = 255, 0, 64, 128, 192
SHARE = 64  # side of the part of a truth that is compared with plain loops


def python_with_numpy():
    for program in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([program, "-c", "import numpy"], capture_output=True, check=False).returncode == 0:
            return program
    return None


PYTHON = python_with_numpy()


def make_set(folder, names=SUBSET):
    subprocess.run([sys.executable, ROOT / "scripts/shadowtruth", folder, "--gnomon", GNOMON, "--cases", ",".join(names)],
                   check=True, stdout=subprocess.DEVNULL)  # fmt: skip


def scored(truth, mask):
    """The lines of the scorer, as dictionaries."""
    said = subprocess.run([PYTHON, ROOT / "bench/shadowtruth/score.py", truth, mask], capture_output=True, text=True, check=True).stdout
    head, *rows = [line.split("\t") for line in said.splitlines()]
    return [dict(zip(head, row)) for row in rows]


class PlainScore:
    """The definition of the page in plain loops over rows of grey levels."""

    def __init__(self, truth, mask):
        self.h, self.w, self.truth = len(truth), len(truth[0]), truth
        self.lit = [[level >= 128 for level in row] for row in mask]
        everywhere = [(y, x) for y in range(self.h) for x in range(self.w)]
        self.judged = [p for p in everywhere if self.level(p) in (LIT, DARK)]
        self.false = [p for p in self.judged if self.level(p) == LIT and not self.drawn(p)]
        light = [p for p in self.judged if self.level(p) == DARK and self.drawn(p)]
        hidden = {p for region in self.regions() if all(map(self.drawn, region)) for p in region}
        self.missed = [p for p in light if p in hidden]
        self.leaked = [p for p in light if p not in hidden]

    def level(self, p):
        return self.truth[p[0]][p[1]] if 0 <= p[0] < self.h and 0 <= p[1] < self.w else NONE

    def drawn(self, p):
        return self.lit[p[0]][p[1]]

    def regions(self):
        seen, found = set(), []
        for start in self.judged:
            if self.level(start) != DARK or start in seen:
                continue
            seen.add(start)
            region = [start]
            for y, x in region:
                for near in ((y + dy, x + dx) for dy in (-1, 0, 1) for dx in (-1, 0, 1)):
                    if self.level(near) == DARK and near not in seen:
                        seen.add(near)
                        region.append(near)
            found.append(region)
        return found

    def edges(self, is_lit):
        beside = ((0, 1), (1, 0), (0, -1), (-1, 0))
        judged = set(self.judged)
        return [(y, x) for y, x in self.judged
                if any((y + dy, x + dx) in judged and is_lit((y + dy, x + dx)) != is_lit((y, x)) for dy, dx in beside)]  # fmt: skip

    def percentiles(self):
        true, drawn = self.edges(lambda p: self.level(p) == LIT), self.edges(self.drawn)
        apart = [self.distance(p, drawn) for p in true] + [self.distance(p, true) for p in drawn]
        apart.sort()
        return [apart[max(math.ceil(share * len(apart)) - 1, 0)] if apart else 0 for share in (0.5, 0.99)]

    def distance(self, p, edge):
        return math.sqrt(min(((p[0] - y) ** 2 + (p[1] - x) ** 2 for y, x in edge), default=self.h**2 + self.w**2))


def shadow_of(truth):
    return [[LIT if level == LIT else 0 for level in row] for row in truth]


def broken_masks(truth):
    """Twenty masks, each broken on purpose."""
    chance, right = random.Random(4), shadow_of(truth)
    h, w = len(right), len(right[0])

    def changed(rule):
        return [[rule(y, x) for x in range(w)] for y in range(h)]

    masks = [changed(lambda y, x: 255), changed(lambda y, x: 0), changed(lambda y, x: 255 - right[y][x])]
    for dy, dx in ((0, 1), (0, 3), (1, 0), (5, 0), (2, 2), (0, -7), (-1, 0)):
        masks.append(changed(lambda y, x, dy=dy, dx=dx: right[(y + dy) % h][(x + dx) % w]))
    for share in (0.0001, 0.001, 0.01, 0.1):
        masks.append(changed(lambda y, x, share=share: 255 - right[y][x] if chance.random() < share else right[y][x]))
    masks.append(changed(lambda y, x: right[y - y % 4][x - x % 4]))  # coarse texels
    masks.append(changed(lambda y, x: max(right[min(y + i, h - 1)][min(x + k, w - 1)] for i in (0, 1) for k in (0, 1))))  # thin
    masks.append(changed(lambda y, x: min(right[min(y + i, h - 1)][min(x + k, w - 1)] for i in (0, 1) for k in (0, 1))))  # fat
    masks.append(changed(lambda y, x: 0 if (x + y) % 7 == 0 else right[y][x]))  # acne
    masks.append(changed(lambda y, x: 255 if x < w // 2 else right[y][x]))
    masks.append(changed(lambda y, x: right[y][x] // 2 + (1 if right[y][x] else 127)))  # 128 is lit, 127 is dark
    masks[-1][h // 2] = [127] * w
    return masks


class ShadowTruth(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory(prefix="gnomon_shadowtruth_")
        cls.folder = pathlib.Path(cls.place.name) / "set"
        make_set(cls.folder)
        cls.cases = json.loads((cls.folder / "cases.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def document(self, case):
        return cases.read_glb((self.folder / f"{case['name']}.glb").read_bytes())

    def test_there_are_96_cases(self):
        every = [case for i, scene in enumerate(scenes.SCENES) for case in cases.cases_of(i, scene.__name__, (9, 9, 9))]
        self.assertEqual(len({case["name"] for case in every}), 96)
        pairs = {(case["name"].split("-")[1], case["name"].split("-")[2]) for case in every}
        self.assertEqual(len(pairs), 60, "each light occurs with each view")
        self.assertEqual({case["name"] for case in self.cases}, set(SUBSET))

    def test_a_second_run_makes_the_same_bytes(self):
        again = pathlib.Path(self.place.name) / "again"
        make_set(again)
        files = sorted(p.relative_to(self.folder) for p in self.folder.rglob("*") if p.is_file())
        self.assertEqual(files, sorted(p.relative_to(again) for p in again.rglob("*") if p.is_file()))
        self.assertGreaterEqual(len(files), 2 * len(SUBSET) + 5)
        for file in files:
            self.assertEqual((self.folder / file).read_bytes(), (again / file).read_bytes(), file)

    def test_coordinates_are_read_back(self):
        for case in self.cases:
            document, places, triangles = self.document(case)
            self.assertEqual(document["nodes"][0]["scale"], [1 / 1024] * 3)
            self.assertTrue(all(c == int(c) and 0 <= c < 1 << 24 for place in places for c in place))
            exported = self.folder.parent / "finest.ply"
            told = run("export", self.folder / f"models/{case['scene']}.gnm", "-o", exported, "--error", "0")
            self.assertEqual(told.returncode, 0, told.stderr)
            finest = scenes.read_ply(exported.read_bytes())
            expected = sorted(tuple(sorted(places[i] for i in t)) for t in triangles)
            self.assertEqual(sorted(tuple(sorted(tuple(1024 * x for x in p) for p in t)) for t in finest), expected)

    def test_each_glb_gives_its_picture(self):
        """The picture of the GLB's own mesh, camera and light."""
        place = pathlib.Path(self.place.name)
        for case in self.cases:
            for words in (("build", self.folder / f"{case['name']}.glb", "-o", place / "own.gnm"),
                          ("path", place / "own.gnm", "--kind", "source", "-o", place / "own.json")):  # fmt: skip
                told = run(*words)
                self.assertEqual(told.returncode, 0, told.stderr)
            nodes = self.document(case)[0]["nodes"]
            light = nodes[2]["matrix"]
            options = list(case["options"])
            for name in ("--eye", "--target", "--up", "--fov-y"):
                at = options.index(name)
                del options[at : at + 2]
            at = options.index("--light" if "sun" in case else "--light-at") + 1
            options[at] = ",".join(map(repr, light[8:11] if "sun" in case else light[12:15]))
            told = run("render", place / "own.gnm", "-o", place / "own.png", "--camera", place / "own.json", *options,
                       "--shadows", "exact", "--oracle", "exact", "--shadow-classes", place / "classes.png")  # fmt: skip
            self.assertEqual(told.returncode, 0, told.stderr)
            own, truth = read_grey(place / "classes.png"), read_grey(self.folder / f"{case['name']}.png")
            apart = sum(a != b for x, y in zip(own, truth) for a, b in zip(x, y))
            self.assertLessEqual(apart, 2, case["name"])  # the last bits of camera and light can move a pixel of an edge

    @unittest.skipUnless(PYTHON, "the scorer needs numpy")
    def test_the_truth_has_no_wrong_pixel(self):
        rows = scored(self.folder, self.folder)
        self.assertEqual(len(rows), len(SUBSET) + 1)
        for row in rows:
            self.assertEqual([row[c] for c in ("wrong", "false", "missed", "leaked", "edge_p50", "edge_p99")], ["0"] * 4 + ["0.00"] * 2)
            self.assertGreater(int(row["judged"]), 1000)

    @unittest.skipUnless(PYTHON, "the scorer needs numpy")
    def test_twenty_broken_masks(self):
        place = pathlib.Path(self.place.name)
        for folder in ("truths", "masks"):
            (place / folder).mkdir()
        plain = {}
        for k, case in enumerate(self.cases):
            whole = read_grey(self.folder / f"{case['name']}.png")
            truth = [row[200 : 200 + SHARE] for row in whole[250 : 250 + SHARE]]
            if k == 0:
                truth[30][10:50] = [NONE, AWAY, NEAR, AWAY] * 10
            for i, mask in list(enumerate(broken_masks(truth)))[4 * k : 4 * k + 4]:
                for folder, picture in (("truths", truth), ("masks", mask)):
                    write_png(place / folder / f"{i:02}.png", SHARE, bytes(level for row in picture for level in row))
                plain[f"{i:02}"] = PlainScore(truth, mask)
        rows = scored(place / "truths", place / "masks")
        self.assertEqual([row["case"] for row in rows], [*sorted(plain), "all"])
        for row in rows[:-1]:
            expected = plain[row["case"]]
            wrong = len(expected.false) + len(expected.missed) + len(expected.leaked)
            counts = [len(expected.judged), wrong, len(expected.false), len(expected.missed), len(expected.leaked)]
            self.assertEqual([int(row[c]) for c in ("judged", "wrong", "false", "missed", "leaked")], counts, row["case"])
            self.assertEqual([row["edge_p50"], row["edge_p99"]], [f"{p:.2f}" for p in expected.percentiles()], row["case"])
        for column in ("wrong", "false", "missed", "leaked"):
            self.assertGreater(int(rows[-1][column]), 0, column)

    @unittest.skipUnless(PYTHON, "the scorer needs numpy")
    def test_every_filter_of_png(self):
        place, chance = pathlib.Path(self.place.name), random.Random(8)
        picture = [[chance.choice((LIT, DARK, AWAY)) for _ in range(9)] for _ in range(25)]
        write_png(place / "plain.png", 9, bytes(level for row in picture for level in row))
        for channels in (1, 3, 4):
            write_png(place / "filtered.png", 9, bytes(c for row in picture for level in row for c in [level] * channels),
                      channels=channels, filters=True)  # fmt: skip
            self.assertEqual(read_grey(place / "filtered.png"), picture)
            self.assertEqual(scored(place / "plain.png", place / "filtered.png")[0]["wrong"], "0")

    @unittest.skipUnless(PYTHON, "the scorer needs numpy")
    def test_wrong_masks_are_refused(self):
        place = pathlib.Path(self.place.name)
        write_png(place / "small.png", 4, bytes(16))
        (place / "broken.png").write_bytes((place / "small.png").read_bytes()[:50])
        truth = self.folder / f"{SUBSET[0]}.png"
        for mask, said in (("small.png", "512x512"), ("broken.png", "broken.png: "), ("none.png", "No such file")):
            told = subprocess.run([PYTHON, ROOT / "bench/shadowtruth/score.py", truth, place / mask],
                                  capture_output=True, text=True, check=False)  # fmt: skip
            self.assertEqual(told.returncode, 1, mask)
            self.assertIn(said, told.stderr)
            self.assertEqual(told.stderr.count("\n"), 1, told.stderr)


class ShadowClasses(ProgramTest):
    def classes(self, *words):
        file, stats = self.place / "classes.png", self.place / "stats.json"
        self.expect(0, "", "render", self.sundial, "-o", self.place / "p.png", "--size", "96x64", "--shading", "lit", "--light", "1,1,1",
                    "--shadow-classes", file, "--stats", stats, *words)  # fmt: skip
        return [level for row in read_grey(file) for level in row], json.loads(stats.read_text())

    def test_they_count_the_wrong_pixels(self):
        for shadows in (("maps", "--shadow-texels", "64x64"), ("rays",), ("exact",)):
            truth, row = self.classes("--shadows", *shadows, "--oracle", "exact")
            drawn, _ = self.classes("--shadows", *shadows)
            self.assertTrue({LIT, DARK, NONE} <= set(truth), set(truth))
            self.assertNotIn(NEAR, drawn)
            wrong = sum((a == LIT) != (b == LIT) for a, b in zip(truth, drawn) if a != NEAR)
            self.assertLessEqual(abs(row["wrong_pixels_all"] * len(truth) - wrong), truth.count(NEAR))
            self.assertEqual(wrong > 0, shadows[0] == "maps")
            self.assertEqual([i for i, a in enumerate(truth) if a in (AWAY, NONE)], [i for i, a in enumerate(drawn) if a in (AWAY, NONE)])

    def test_what_contradicts_them(self):
        picture = ("render", self.sundial, "-o", self.place / "p.png", "--shadow-classes")
        self.expect(2, "--shadow-classes and --shadows off contradict", *picture, self.place / "c.png", "--shadows", "off")
        self.expect(2, "--shadow-classes and --shading unlit contradict", *picture, self.place / "c.png", "--shading", "unlit")
        self.expect(2, "--shadow-classes", *picture, self.place / "c.png", "--samples", "4")
        self.expect(2, "--shadow-classes", *picture, self.place / "c.png", "--turntable", "3")
        self.expect(2, ".png", *picture, self.place / "c.pfm")
        self.expect(2, "--shadow-classes", *picture, self.place / "p.png")
