"""What `build` asks for does: the peak of meshes of all kinds stays below the least --memory that it names for them."""
import array
import json
import pathlib
import random
import re
import struct
import tempfile
import unittest

from program import GNOMON, run

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


@unittest.skipIf(IS_SANITIZED, "sanitizers need memory of their own")
class MemoryTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="gnomon_memory_")
        self.addCleanup(folder.cleanup)
        self.place = pathlib.Path(folder.name)

    def expect_kept(self, mesh):
        model = self.place / "m.gnm"
        refused = run("build", mesh, "-o", model, "--memory", "1M", "--chunk-triangles", "400k")
        self.assertEqual(refused.returncode, 1)
        least = re.search(r"expected --memory (\d+)M or more", refused.stderr)
        self.assertTrue(least, refused.stderr)
        built = run("build", mesh, "-o", model, "--memory", f"{least[1]}M", "--chunk-triangles", "400k", "--error", "estimated", "--json")
        self.assertEqual(built.returncode, 0, built.stderr)
        self.assertLessEqual(json.loads(built.stdout)["peak_rss_bytes"], int(least[1]) << 20)

    def test_loose_triangles(self):
        write_parts(self.place / "loose.ply", 700_000, 3, "double")
        self.expect_kept(self.place / "loose.ply")

    def test_loose_quads(self):
        write_parts(self.place / "quads.ply", 150_000, 4, "float")
        self.expect_kept(self.place / "quads.ply")

    def test_a_welded_surface(self):
        made = run("make", "statue", "--triangles", "300k", "-o", self.place / "statue.ply")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.expect_kept(self.place / "statue.ply")


if __name__ == "__main__":
    unittest.main()
