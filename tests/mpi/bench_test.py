"""A bench whose walks are spread over processes writes what one process writes, but for times."""
import csv
import json
import os
import re
import signal
import time
import unittest

from job import GNOMON_MPI, SLOW, JobTest, Told, alone, ranks_of, run, slow, start

# What a process holds, and so reads, hangs on the runs it has walked before.
VARYING = re.compile(r".*_ms|gpu_bytes|resident_bytes|bytes_read")


def rows_of(path):
    with open(path, newline="") as file:
        return [{name: cell for name, cell in row.items() if not VARYING.fullmatch(name)} for row in csv.DictReader(file)]


def files_of(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


class Bench(JobTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.model, cls.path = cls.place / "plant.gnm", cls.place / "path.json"
        mesh = cls.made(cls, "plant", "20k")
        alone("build", mesh, "-o", cls.model)
        alone("path", cls.model, "--kind", "orbit", "-o", cls.path)
        cls.walk = ("bench", cls.model, "--path", cls.path, "--size", "96x64", "--z-partitions", "1,2,4", "--frames", "3",
                    "--repetitions", "2", "--warmup", "0", "--backend", "software", "--threads", "1")  # fmt: skip

    def outputs(self, name, *pictures):
        """Options for what a bench writes, and where it lies."""
        place = self.place / name
        place.mkdir()
        return ("--csv", place / "log.csv", "--json-file", place / "runs.json",
                *(("--images", place / "images", "--all-images") if pictures else ())), place  # fmt: skip

    def test_same_rows_and_pictures_for_any_number_of_processes(self):
        words, expected = self.outputs("alone", "pictures")
        alone(*self.walk, "--oracle", *words)
        names = [row["name"] for row in json.loads((expected / "runs.json").read_text())["benchmarks"]]
        for processes in (1, 2, 3) if SLOW else (2,):
            words, place = self.outputs(f"of{processes}", "pictures")
            told = run(processes, *self.walk, "--oracle", *words, "--share-nodes")
            self.assertEqual((told.returncode, told.stderr), (0, ""))
            self.assertIn("recommended: ", told.stdout)
            self.assertEqual(told.stdout.count("p50 ms"), 1)
            self.assertEqual(rows_of(place / "log.csv"), rows_of(expected / "log.csv"))
            self.assertEqual(files_of(place / "images"), files_of(expected / "images"))
            document = json.loads((place / "runs.json").read_text())
            self.assertEqual([row["name"] for row in document["benchmarks"]], names)
            ranks, phases = document["context"]["ranks"], document["context"]["phases"]
            self.assertEqual([rank["rank"] for rank in ranks], list(range(processes)))
            self.assertEqual({phase["name"]: phase["tasks"] for phase in phases}, {"bench": 6, "proof": 3})
            self.assertEqual(sum(rank["tasks"] for rank in ranks), 9)
            for rank in ranks:
                self.assertTrue(rank["host"])
                self.assertEqual(rank["threads"], 1)
                self.assertGreater(rank["tasks"], 0)
                self.assertGreater(rank["busy_seconds"], 0)
                self.assertGreater(rank["peak_rss_bytes"], 1 << 20)
            for phase in phases:
                self.assertTrue(0 <= phase["idle_share"] <= 1, phase)
                self.assertIn(phase["slowest_rank"], range(processes))

    @slow
    def test_a_report_names_no_host_and_a_budget_is_walked_again(self):
        page = self.place / "page"
        told = run(2, *self.walk, "--report", page, "--budget-ms", "1000", "--share-nodes", "--progress", "json")
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertEqual({path.name for path in page.iterdir()}, {"bench.csv", "bench.json", "index.html"})
        self.assertNotIn("ranks", json.loads((page / "bench.json").read_text())["context"])
        self.assertIn("when walked again", told.stdout)
        shown = [json.loads(line) for line in told.stderr.splitlines() if line.startswith("{")]
        last = {line["stage"]: line for line in shown}  # one bar: rank 0's, of what all do
        self.assertEqual((last["bench"]["done"], last["once more"]["done"]), (27, 6))
        for line in last.values():
            self.assertEqual(line["done"], line["total"], line)

    def test_processes_of_one_host_are_refused(self):
        words, place = self.outputs("refused")
        told = run(2, *self.walk, *words)
        self.assertEqual((told.returncode, len(told.lines)), (2, 1), told.stderr)
        self.assertRegex(told.lines[0], r"ranks 0 and 1 are both on \S+ .*--share-nodes")
        self.assertEqual(list(place.iterdir()), [])
        alone_help = alone("bench", "--help")
        shared_help = run(1, "bench", "--help").stdout
        self.assertNotIn("--share-nodes", alone_help)
        self.assertIn("--share-nodes", shared_help)

    def test_what_fails_in_one_rank_is_one_line_and_leaves_nothing(self):
        words, place = self.outputs("failed")
        other = self.of_rank(1, 'set -- "$@" --frames 4')
        told = run(2, *[word for word in self.walk if word not in ("--frames", "3")], *words, "--share-nodes", program=other)
        self.assertEqual((told.returncode, len(told.lines)), (1, 1), told.stderr)
        self.assertRegex(told.lines[0], r"gnomon: rank 1 on \S+: it works on something else than rank 0")
        told = run(3, *self.walk, *words, "--share-nodes", program=self.of_rank(2, 'set -- bench nothing.gnm "${@:3}"'))
        self.assertEqual((told.returncode, len(told.lines)), (1, 1), told.stderr)
        self.assertRegex(told.lines[0], r"gnomon: rank 2\b.*nothing.gnm: cannot open: No such file")
        self.assertEqual(list(place.iterdir()), [])

    @slow
    def test_a_rank_that_dies_leaves_nothing(self):
        words, place = self.outputs("killed")
        job = start(2, *self.walk, "--frames", "100000", *words, "--share-nodes")  # the last --frames counts
        ranks = ranks_of(job, 2)
        time.sleep(0.3)
        self.assertIsNone(job.poll())
        os.kill(ranks[1], signal.SIGKILL)
        told = Told(job)
        self.assertNotEqual(told.returncode, 0)
        self.assertEqual(list(place.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
