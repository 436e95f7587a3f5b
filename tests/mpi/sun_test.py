"""Hours of sun that many processes count, each a share of the directions, are those that one counts: the same bytes."""
import json
import os
import signal
import time
import unittest

from job import SLOW, JobTest, Told, alone, ranks_of, run, slow, start

DAY = ("--at", "47.4,8.5", "--from", "2026-06-21T00:00+02:00", "--to", "2026-06-22T00:00+02:00", "--step", "30m", "--threads", "1")


class Sun(JobTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.model, cls.points = cls.place / "plant.gnm", cls.place / "points.csv"
        alone("build", cls.made(cls, "plant", "60k"), "-o", cls.model)
        cls.points.write_text("x,y,z\n" + "".join(f"{x},{1 + x / 7},{3 - x}\n" for x in range(-20, 20)))
        cls.hours = ("sun", "hours", cls.model, *DAY)

    def outputs(self, name):
        """Options for all that hours of a view write, and where it lies."""
        place = self.place / name
        place.mkdir()
        return ("--size", "160x120", "-o", place / "h.png", "--pfm", place / "h.pfm", "--csv", place / "h.csv", "--report", place), place

    def written(self, place):
        return {path.name: path.read_bytes() for path in place.iterdir()}

    def test_a_view_comes_to_the_same_bytes_for_any_number_of_processes(self):
        words, place = self.outputs("alone")
        expected_counts = json.loads(alone(*self.hours, *words, "--json"))
        expected = self.written(place)
        self.assertEqual(set(expected), {"h.png", "h.pfm", "h.csv", "index.html"})
        for processes in (1, 2, 3):
            words, place = self.outputs(f"of{processes}")
            told = run(processes, *self.hours, *words, "--json", "--progress", "json")
            self.assertEqual(told.returncode, 0, told.stderr)
            self.assertEqual(self.written(place), expected)
            self.assertEqual(json.loads(told.stdout), expected_counts)
            lines = [json.loads(line) for line in told.stderr.splitlines() if line.startswith('{"stage": "sun"')]
            share = -(-expected_counts["steps_up"] // processes)  # of rank 0
            self.assertEqual((lines[-1]["done"], lines[-1]["total"]), (share, share))

    @slow
    def test_points_and_vertices_come_to_the_same_bytes(self):
        for name, words in (("points.csv", ("--points", self.points, "--csv")), ("vertices.ply", ("--vertices", "--error", "0.5", "-o"))):
            alone(*self.hours, *words, self.place / f"alone_{name}")
            told = run(3, *self.hours, *words, self.place / f"all_{name}")
            self.assertEqual((told.returncode, told.stderr.count("sun up in")), (0, 1), told.stderr)
            self.assertEqual((self.place / f"all_{name}").read_bytes(), (self.place / f"alone_{name}").read_bytes())

    def test_a_killed_job_is_resumed_by_any_number(self):
        words, place = self.outputs("expected")
        long = (*self.hours[:-4], "--step", "1m" if SLOW else "4m", "--threads", "1")
        decided = json.loads(alone(*long, *words, "--json"))["verdicts"]
        expected = self.written(place)
        for processes in (2, 1, 4) if SLOW else (2,):
            words, place = self.outputs(f"killed{processes}")
            job = start(3, *long, *words)
            ranks = ranks_of(job, 3)
            logs = [place / "h.png.steps", place / "h.png.1.steps", place / "h.png.2.steps"]
            while not all(log.exists() and log.stat().st_size > 5000 for log in logs) and job.poll() is None:
                time.sleep(0.005)
            os.kill(ranks[2], signal.SIGKILL)
            self.assertNotEqual(Told(job).returncode, 0)
            self.assertEqual(set(self.written(place)), {log.name for log in logs})
            told = run(processes, *long, *words, "--resume", "--json")
            self.assertEqual(told.returncode, 0, told.stderr)
            self.assertEqual(self.written(place), expected)
            self.assertLess(json.loads(told.stdout)["verdicts"], decided)

    def test_what_fails_in_one_rank_is_one_line(self):
        words, place = self.outputs("failed")
        for change, said in (('set -- "$@" --size 80x60', "it has another model, other options"),
                             ('set -- sun hours nothing.gnm "${@:4}"', "nothing.gnm: cannot open: No such file")):  # fmt: skip
            told = run(2, *self.hours, *words[2:], program=self.of_rank(1, change))
            self.assertEqual((told.returncode, len(told.lines)), (1, 1), told.stderr)
            self.assertRegex(told.lines[0], rf"gnomon: rank 1\b.*{said}")
            self.assertEqual(list(place.iterdir()), [])
        told = run(2, "sun", "hours", "nothing.gnm", *DAY, *words)
        self.assertEqual((told.returncode, len(told.lines)), (1, 1), told.stderr)
        told = run(2, "sun", "position")
        self.assertEqual((told.returncode, len(told.lines)), (2, 1), told.stderr)


if __name__ == "__main__":
    unittest.main()
