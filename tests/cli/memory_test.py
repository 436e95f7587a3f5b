"""The peak resident size stays below --memory: of builds at the least that they name, which is close to the peak, and of
`export` and `verify`."""
import array
import json
import pathlib
import random
import re
import shutil
import struct
import tempfile
import unittest

from program import DATA, GNOMON, measured, run

# Sanitizers keep what is freed, and shadow all that is used.
IS_SANITIZED = any(name in pathlib.Path(GNOMON).read_bytes() for name in (b"__asan_init", b"__tsan_init"))


def write_parts(path, count, corners, kind):
    """`count` small polygons, none touching another, with coordinates of PLY type `kind`."""
    seeded = random.Random(7)
    positions = array.array({"float": "f", "double": "d"}[kind])
    for _ in range(count):
        x, y, z = seeded.random(), seeded.random(), seeded.random()
        for dx, dy in ((0, 0), (1, 0), (1, 1), (0, 1))[:corners]:
            positions.extend((x + dx * 1e-3, y + dy * 1e-3, z + seeded.random() * 1e-4))
    row = struct.Struct("<B" + "i" * corners)
    with open(path, "wb") as file:
        file.write(
            f"ply\nformat binary_little_endian 1.0\nelement vertex {corners * count}\n"
            f"property {kind} x\nproperty {kind} y\nproperty {kind} z\n"
            f"element face {count}\nproperty list uchar int vertex_indices\nend_header\n".encode())
        positions.tofile(file)
        file.write(b"".join(row.pack(corners, *range(corners * i, corners * (i + 1))) for i in range(count)))


def write_soup(path, count, corner):
    """`count` triangles with vertices of their own, at what `corner(random, number)` tells."""
    seeded = random.Random(7)
    positions = array.array("f")
    for i in range(3 * count):
        positions.extend(corner(seeded, i % 3))
    row = struct.Struct("<B3i")
    with open(path, "wb") as file:
        file.write(
            f"ply\nformat binary_little_endian 1.0\nelement vertex {3 * count}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {count}\nproperty list uchar int vertex_indices\nend_header\n".encode())
        positions.tofile(file)
        file.write(b"".join(row.pack(3, 3 * i, 3 * i + 1, 3 * i + 2) for i in range(count)))


@unittest.skipIf(IS_SANITIZED, "sanitizers need memory of their own")
class MemoryTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="gnomon_memory_")
        self.addCleanup(folder.cleanup)
        self.place = pathlib.Path(folder.name)

    def expect_kept(self, mesh, chunk_triangles="400k", max_ratio=1.6):
        model = self.place / "m.gnm"
        refused = run("build", mesh, "-o", model, "--memory", "1M", "--chunk-triangles", chunk_triangles)
        self.assertEqual(refused.returncode, 1)
        minimum = re.search(r"expected --memory (\d+)M or more", refused.stderr)
        self.assertTrue(minimum, refused.stderr)
        built = run("build", mesh, "-o", model, "--memory", f"{minimum[1]}M", "--chunk-triangles", chunk_triangles, "--error", "estimated", "--json")
        self.assertEqual(built.returncode, 0, built.stderr)
        peak = json.loads(built.stdout)["peak_rss_bytes"]
        self.assertLessEqual(peak, int(minimum[1]) << 20)
        self.assertLessEqual(int(minimum[1]) << 20, max_ratio * peak)

    def test_loose_triangles(self):
        write_parts(self.place / "loose.ply", 700_000, 3, "double")
        self.expect_kept(self.place / "loose.ply")

    def test_loose_quads(self):
        write_parts(self.place / "quads.ply", 150_000, 4, "float")
        self.expect_kept(self.place / "quads.ply")

    def test_what_is_asked_for_is_the_same_before_and_after_chunks_are_known(self):
        soup = self.place / "soup.ply"
        write_soup(soup, 300_000, lambda seeded, _: [seeded.random() for _ in range(3)])
        asked = set()
        for memory in ("1M", "62M"):  # sorting does not fit, and sorting fits
            refused = run("build", soup, "-o", self.place / "m.gnm", "--memory", memory, "--chunk-triangles", "100k")
            self.assertEqual(refused.returncode, 1)
            asked.add(re.search(r"expected --memory (\d+)M or more", refused.stderr)[1])
        self.assertEqual(len(asked), 1, asked)

    def test_coincident_triangles(self):
        write_soup(self.place / "three.ply", 200_000, lambda _, number: ((0, 0, 0), (1, 0, 0), (0, 1, 0))[number])
        self.expect_kept(self.place / "three.ply", "100k")

    def test_a_welded_surface(self):
        made = run("make", "statue", "--triangles", "300k", "-o", self.place / "statue.ply")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.expect_kept(self.place / "statue.ply", max_ratio=1.25)

    def test_a_small_model_needs_little(self):
        for name in ("sundial.ply", "colonnade.obj"):
            self.expect_kept(DATA / "models" / name, max_ratio=1.25)

    def test_exports_and_checks_stay_below_their_limit_or_name_one(self):
        mesh, model, out = self.place / "plant.ply", self.place / "plant.gnm", self.place / "out"
        run("make", "plant", "--triangles", "300k", "-o", mesh)
        self.assertEqual(run("build", mesh, "-o", model).returncode, 0)
        for words in (
            ("verify", model, "--cuts", "5"),
            ("verify", model, "--cuts", "5", "--source", mesh),
            ("export", model, "--triangles", "1G", "-o", out / "x.ply"),
            ("export", model, "--triangles", "1G", "-o", out / "x.glb"),
            ("export", model, "--format", "3dtiles", "-o", out / "tiles"),
        ):
            limits = ["1M", "48M", "80M"]
            for limit in limits:
                shutil.rmtree(out, ignore_errors=True)
                out.mkdir()
                done = measured(GNOMON, *words, "--memory", limit)
                said = done.err
                if done.code == 0:
                    self.assertLessEqual(done.mebibytes, int(limit[:-1]), words)
                    continue
                minimum = re.search(r"too little memory for .*: expected --memory (\d+)M or more", said)
                self.assertTrue(minimum, said)
                self.assertEqual((done.code, said.count("\n")), (1, 1), said)
                self.assertEqual(list(out.iterdir()), [])
                if limit == "1M":
                    limits.append(f"{minimum[1]}M")


if __name__ == "__main__":
    unittest.main()
