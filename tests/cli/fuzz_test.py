"""Random options, damaged models and mangled JSON: exit 0, 1 or 2, one line at most, never a crash or a hang.

GNOMON_FUZZ_ROUNDS (default 20) runs of each kind, GNOMON_FUZZ_SEED (default 1) for others than last time.
"""
import os
import random
import re
import unittest

from program import DATA, Workplace, run

ROUNDS = int(os.environ.get("GNOMON_FUZZ_ROUNDS", "20"))
SEED = int(os.environ.get("GNOMON_FUZZ_SEED", "1"))

NUMBERS = ["0", "1", "-1", "0.5", "2", "3.7", "1e9", "1e-9", "1e300", "-1e300", "1e-310", "nan", "inf", "", "x", "auto"]
VECTORS = ["0,0,0", "1,2,3", "0,1,0", "1e300,0,0", "0,-1e9,1e-9", "1,2", "nan,0,0", "a,b,c", "", "-3,5,8", "0,30,0"]
SIZES = ["1x1", "64x48", "0x0", "17x3", "-1x5", "99999999999x1", "64", "x", "", "300x1", "1x300", "5x5x5"]
WORDS = ["on", "off", "auto", "none", "maps", "rays", "lspsm", "psm", "tsm", "minimax", "1", "4", "12", "13", "-2", "", "é"]
MEMORY = ["1", "0", "64M", "1G", "-1", "1e3", "", "junk", "16k"]

VIEW = {
    "--size": SIZES, "--eye": VECTORS, "--target": VECTORS, "--up": VECTORS + ["z", "-x"], "--view": WORDS + ["left", "iso"], "--fov-y": NUMBERS + ["60", "179.9"],
    "--near": NUMBERS, "--far": NUMBERS, "--near-floor": NUMBERS, "--light": VECTORS, "--error-pixels": NUMBERS,
    "--max-triangles": NUMBERS + ["1k"], "--shadows": WORDS, "--warp": WORDS, "--eta": NUMBERS, "--tsm-focus": NUMBERS,
    "--z-partitions": WORDS, "--split-lambda": NUMBERS, "--face-partitions": WORDS, "--shadow-texels": SIZES + ["512x512"],
    "--max-aliasing": NUMBERS, "--filter": NUMBERS, "--cull-casters": WORDS, "--occlusion": WORDS, "--stabilize": WORDS,
    "--backend": ["software", "osmesa", "auto", "vulkan"], "--memory": MEMORY, "--gpu-memory": MEMORY,
}  # fmt: skip


class Fuzz(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = Workplace()
        cls.models = [cls.place / "sundial.gnm", cls.place / "colonnade.gnm"]

    @classmethod
    def tearDownClass(cls):
        cls.place.close()

    def setUp(self):
        self.random = random.Random(f"{SEED} {self.id()}")

    def sane(self, *words):
        result = run(*words)
        told = f"gnomon {' '.join(map(str, words))}\n{result.stdout[-300:]}\n{result.stderr[-300:]}"
        self.assertIn(result.returncode, (0, 1, 2), told)
        if result.returncode:
            # A warning names its file if it is about one.
            lines = [line for line in result.stderr.splitlines() if not re.match(r"gnomon: (\S+: )?warning: ", line)]
            self.assertEqual(len(lines), 1, told)
            self.assertTrue(lines[0].startswith("gnomon: "), told)
        return result.returncode

    def some(self, table, max_count):
        words = []
        for option in self.random.sample(sorted(table), self.random.randint(0, max_count)):
            words += [option, self.random.choice(table[option])]
        return words

    def test_view_options(self):
        picture = self.place / "fuzz.png"
        codes = []
        for _ in range(2 * ROUNDS):
            words = self.some(VIEW, 4)
            if "--size" not in words:
                words += ["--size", "48x32"]
            if "--shadow-texels" not in words:
                words += ["--shadow-texels", "128x128"]
            codes.append(self.sane("render", self.random.choice(self.models), "-o", picture, *words))
        self.assertGreaterEqual(codes.count(0), ROUNDS / 10)  # else it is only the parser that is tested

    def test_other_options(self):
        out = self.place / "fuzz_out"
        tables = {
            ("build", DATA / "models/sundial.ply", "-o", out): {
                "--memory": MEMORY, "--cluster-triangles": NUMBERS, "--chunk-triangles": NUMBERS, "--error": WORDS,
                "--max-stuck": NUMBERS, "--threads": NUMBERS, "--simplifier": WORDS, "--progress": WORDS},
            ("make", "statue", "-o", out): {"--triangles": ["2k", "5k", "0", "-1", "x", "1"], "--seed": NUMBERS},
            ("make", "plant", "-o", out): {"--triangles": ["20k", "0", "-1", "x", "1"], "--threads": NUMBERS},
            ("export", self.models[0], "-o", out): {"--triangles": NUMBERS, "--error": NUMBERS},
            ("verify", self.models[1]): {"--cuts": ["0", "3", "-1", "x"], "--seed": NUMBERS, "--threads": NUMBERS},
            ("path", self.models[1], "-o", out): {"--kind": ["walk", "orbit", "flyby", "approach", "x"]},
            ("theory", "table"): {
                "--near": NUMBERS, "--far": NUMBERS + ["100"], "--fov-y": NUMBERS + ["60"], "--light": VECTORS,
                "--aspect": NUMBERS},
        }  # fmt: skip
        for base, table in tables.items():
            for _ in range(ROUNDS // 4):
                self.sane(*base, *self.some(table, len(table)))

    def mangled(self, data):
        """`data` with bytes changed, lost, doubled, or cut off."""
        data = bytearray(data)
        for _ in range(self.random.randint(1, 4)):
            at = self.random.randrange(len(data)) if data else 0
            kind = self.random.randrange(5)
            if kind == 0:
                data[at : at + 1] = bytes([self.random.randrange(256)])
            elif kind == 1:
                del data[at : at + self.random.randint(1, 40)]
            elif kind == 2:
                data[at:at] = data[at : at + self.random.randint(1, 40)]
            elif kind == 3:
                data[at : at + 8] = self.random.choice([b"\xff" * 8, b"\0" * 8, b"1e999999", b"-9999999", b'"x": [[]'])
            else:
                del data[at:]
        return bytes(data)

    def test_damaged_models(self):
        bad = self.place / "bad.gnm"
        for _ in range(ROUNDS):
            bad.write_bytes(self.mangled(self.random.choice(self.models).read_bytes()))
            command = self.random.choice(("info", "verify", "export", "path", "render"))
            more = {
                "info": [],
                "verify": ["--cuts", "3"],
                "export": ["--error", "0", "-o", self.place / "bad.ply"],
                "path": ["--kind", "walk", "-o", self.place / "bad.json"],
                "render": ["--size", "48x32", "--shadow-texels", "128x128", "-o", self.place / "bad.png"],
            }[command]
            self.sane(command, bad, *more)

    def test_mangled_json(self):
        bad = self.place / "bad.json"
        small = ("--size", "32x32", "--shadow-texels", "128x128")
        for _ in range(ROUNDS):
            camera = DATA / "cameras/sundial_low.json"
            bad.write_bytes(self.mangled(camera.read_bytes()))
            self.sane("render", self.models[0], "--camera", bad, "-o", self.place / "bad.png", *small)
            path = DATA / "paths/colonnade_walk.json"
            bad.write_bytes(self.mangled(path.read_bytes()))
            self.sane("bench", self.models[1], "--path", bad, "--frames", "2", "--warmup", "0", *small)

    def test_mangled_meshes(self):
        for _ in range(ROUNDS):
            mesh = self.random.choice(sorted((DATA / "models").iterdir()))
            bad = self.place / ("bad" + mesh.suffix)
            bad.write_bytes(self.mangled(mesh.read_bytes()))
            self.sane("build", bad, "-o", self.place / "bad.gnm")


if __name__ == "__main__":
    unittest.main()
