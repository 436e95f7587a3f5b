"""Models that claim what cannot be, and disks that fail: exit 1 and one line, within the caps, and never a wrong picture.

The models are those of ../shared/faults beside the real ones ($GNOMON_MODELS/../faults), whose README says what each
once did; what they break is made in memory by tests/hierarchy, too.
"""
import json
import os
import pathlib
import struct
import subprocess
import unittest

from program import DATA, GNOMON, ProgramTest, measured

MODELS = pathlib.Path(os.environ.get("GNOMON_MODELS") or pathlib.Path(__file__).resolve().parents[3] / "shared/models")
FAULTS = MODELS.parent / "faults"
IS_SANITIZED = any(name in pathlib.Path(GNOMON).read_bytes() for name in (b"__asan_init", b"__tsan_init"))
PATH = DATA / "paths/sundial_orbit.json"
SMALL = ("--size", "32x32", "--shadow-texels", "128x128")
WALK = (*SMALL, "--frames", "2", "--warmup", "0")
MAX_BYTES = 256 << 20  # of a run on a small model: far below what the files below once took


def rows_of(model):
    """(offset, stored bytes, whether it holds a root) of each page."""
    data = model.read_bytes()
    offset, size = struct.unpack_from("<2Q", data, len(data) - 72)
    place, page, rows = offset, 40, []
    while place < offset + size:
        row = struct.unpack_from("<IIQ5I6II6d", data, place)
        rows.append((page, row[0], row[-1] == float("inf")))
        page += row[0]
        place += 112 + 4 * row[14]
    return rows


class Hostile(ProgramTest):
    def measured(self, *words):
        """Exit code, stderr and peak memory of a run."""
        done = measured(GNOMON, *words)
        return done.code, done.err, done.peak

    def expect_refused(self, *words):
        code, said, peak = self.measured(*words)
        told = f"{words}: {said}"
        self.assertEqual(code, 1, told)
        self.assertEqual(said.count("\n"), 1, told)
        self.assertTrue(said.startswith("gnomon: "), told)
        if not IS_SANITIZED:
            self.assertLess(peak, MAX_BYTES, told)
        return said

    def commands(self, model):
        out = self.place.path
        return (
            ("info", model),
            ("verify", model, "--cuts", "2"),
            ("render", model, "-o", out / "o.png", *SMALL),
            ("explain", model),
            ("bench", model, "--path", PATH, *WALK),
            ("path", model, "--kind", "walk", "-o", out / "o.json"),
            ("export", model, "--error", "1", "-o", out / "o.ply"),
        )

    @unittest.skipUnless(FAULTS.is_dir(), f"no files that once broke the program in {FAULTS}")
    def test_every_command_refuses_the_models_that_once_broke_it(self):
        for fault in sorted(FAULTS.glob("*.gnm")):
            for words in self.commands(fault):
                said = self.expect_refused(*words)
                for part in (fault.name, "expected ", ", found "):
                    self.assertIn(part, said)
        self.assertEqual([file.name for file in self.place.path.glob("o.*")], [])

    def test_what_floats_cannot_hold_is_not_drawn(self):
        mesh, model = self.place / "vast.obj", self.place / "vast.gnm"
        mesh.write_text("v 0 0 0\nv 1e37 0 0\nv 0 1e37 0\nv 0 1e37 1e37\nf 1 2 3\nf 1 2 4\n")
        self.expect(0, "", "build", mesh, "-o", model)
        for words in (("render", model, "-o", self.place / "o.png", *SMALL), ("explain", model)):
            self.assertIn("too large to be drawn", self.expect_refused(*words))
        self.expect(0, "", "verify", model, "--cuts", "2")

    def failing(self, first, end, times, *words):
        """The outcome of a run whose first so many reads of models in [first, end) fail."""
        environment = dict(os.environ, LD_PRELOAD=os.environ["FAILING_READS"])
        environment.update(FAIL_FROM=str(first), FAIL_TO=str(end), FAIL_TIMES=str(times))
        command = [GNOMON, *map(str, words)]
        return subprocess.run(command, capture_output=True, text=True, timeout=120, env=environment)

    @unittest.skipIf(IS_SANITIZED, "a sanitizer reads before what is preloaded")
    def test_a_page_that_cannot_be_read_is_an_error_and_no_damage(self):
        offset, stored, _ = [row for row in rows_of(self.sundial) if not row[2]][-1]
        picture = self.place / "unread.png"
        for words in (
            ("render", self.sundial, "-o", picture, "--error-pixels", "0.001", *SMALL),
            ("bench", self.sundial, "--path", PATH, "--error-pixels", "0.001", *WALK),
            ("verify", self.sundial, "--cuts", "2"),
            ("export", self.sundial, "--triangles", "1M", "-o", self.place / "unread.ply"),
        ):
            told = self.failing(offset, offset + stored, 10**9, *words)
            self.assertEqual(told.returncode, 1, words)
            self.assertEqual(told.stderr.count("\n"), 1, told.stderr)
            self.assertIn("cannot read: Input/output error", told.stderr)
            self.assertNotIn("damaged", told.stderr)
            self.assertEqual(list(self.place.path.glob("unread*")), [])
            self.assertEqual(self.failing(offset, offset + stored, 2, *words).returncode, 0, f"{words}: not tried again")
            for drawn in self.place.path.glob("unread*"):
                drawn.unlink()

    def test_a_bench_that_lacked_pages_fails_against_a_baseline(self):
        before, now, damaged = self.place / "before.json", self.place / "now.json", self.place / "damaged.gnm"
        bench = ("--path", PATH, "--error-pixels", "0.001", *WALK)
        self.expect(0, "", "bench", self.sundial, *bench, "--json-file", before)
        sound = json.loads(before.read_text())["benchmarks"][0]
        self.assertEqual((sound["pages_damaged"], sound["pages_missing"]), (0, 0))
        offset, stored, _ = [row for row in rows_of(self.sundial) if not row[2]][-1]
        data = bytearray(self.sundial.read_bytes())
        data[offset + stored // 2] ^= 1
        damaged.write_bytes(data)
        self.expect(0, "is damaged", "bench", damaged, *bench, "--json-file", now)
        self.assertEqual(json.loads(now.read_text())["benchmarks"][0]["pages_damaged"], 1)
        _, said, _ = self.measured("bench", damaged, *bench, "--baseline", before, "--fail-above", "1e9")
        self.assertIn("drew without some pages", said)
        self.assertIn("expected none damaged and none missing, found 1 damaged, 0 missing", said)


if __name__ == "__main__":
    unittest.main()
