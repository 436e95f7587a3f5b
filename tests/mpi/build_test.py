"""Any number of processes builds the bytes of one."""
import json
import struct
import unittest

from job import DATA, SLOW, JobTest, run

SMALL = ("--chunk-triangles", "4k")


class Build(JobTest):
    def report(self, processes, *words):
        model = self.place / "m.gnm"
        told = run(processes, "build", *words, "-o", model, "--json")
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertEqual(self.left(), ["m.gnm"])
        model.unlink()
        return json.loads(told.stdout)

    def sheet(self, form):
        """Squares and triangles by turns, so that no row lies where its number says."""
        side = 130
        points = [(x, y, (x * 7 + y * 11) % 13 / 40) for y in range(side) for x in range(side)]
        faces = []
        for y in range(side - 1):
            for x in range(side - 1):
                a, b, c, d = (y * side + x, y * side + x + 1, (y + 1) * side + x + 1, (y + 1) * side + x)
                faces += [(a, b, c, d)] if (x + y) % 3 else [(a, b, c), (a, c, d)]
        head = (f"ply\nformat {form} 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
                f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n")  # fmt: skip
        if form == "ascii":
            rows = [" ".join(map(str, point)) for point in points]
            body = "\n".join(rows + [f"{len(face)} {' '.join(map(str, face))}" for face in faces]).encode() + b"\n"
        else:
            body = b"".join(struct.pack("<3f", *point) for point in points)
            body += b"".join(struct.pack(f"<B{len(face)}i", len(face), *face) for face in faces)
        path = self.place / f"{form}.ply"
        path.write_bytes(head.encode() + body)
        return path

    def test_sorts_text_and_polygons_by_ranges(self):
        for form in ("ascii", "binary_little_endian"):
            phases = {phase["name"]: phase for phase in self.report(2, self.sheet(form), *SMALL)["phases"]}
            self.assertGreater(phases["count"]["tasks"], 0, form)
            self.assertGreater(phases["bin"]["tasks"], 0, form)

    def test_its_manual_is_printed_once(self):
        told = run(2, "manual", "man", "build")
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertEqual(told.stdout.count('.TH "GNOMON\\-MPI\\-BUILD"'), 1, told.stdout[:80])

    def test_same_bytes_for_any_number_of_processes_and_threads(self):
        for words in ((self.made("plant", "60k"), *SMALL), (self.made("statue", "40k"), *SMALL),
                      (self.sheet("ascii"), *SMALL), (self.sheet("binary_little_endian"), *SMALL),
                      (DATA / "models/colonnade.obj",)):  # fmt: skip
            expected = self.hash_alone(*words)
            for processes in (1, 2, 3) if SLOW else (2,):
                for threads in (1, 2) if SLOW else (1,):
                    told = self.report(processes, *words, "--threads", threads)
                    self.assertEqual(told["content_hash"], expected, f"{words}: {processes} processes of {threads}")

    def test_the_report_tells_who_did_what(self):
        told = self.report(3, self.made("plant", "60k"), *SMALL, "--threads", "1")
        self.assertEqual([rank["rank"] for rank in told["ranks"]], [0, 1, 2])
        self.assertEqual(sum(rank["tasks"] for rank in told["ranks"]), sum(phase["tasks"] for phase in told["phases"]))
        for rank in told["ranks"]:
            self.assertGreater(rank["tasks"], 0)
            self.assertGreater(rank["busy_seconds"], 0)
            self.assertGreater(rank["peak_rss_bytes"], 1 << 20)
            self.assertGreater(rank["scratch_bytes_written"], 0)
            self.assertEqual(rank["threads"], 1)
            self.assertTrue(rank["host"])
        for phase in told["phases"]:
            self.assertTrue(0 <= phase["idle_share"] <= 1, phase)
            self.assertIn(phase["slowest_rank"], (0, 1, 2))
        self.assertGreater(told["source_triangles"] * 2, sum(rank["bytes_sent"] for rank in told["ranks"]))


if __name__ == "__main__":
    unittest.main()
