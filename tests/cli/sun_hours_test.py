"""`sun hours`: its files agree with each other and with pictures, a killed run goes on, and what is refused."""
import array
import csv
import os
import signal
import subprocess
import time

from program import GNOMON, ProgramTest, run

DAY = ("--at", "47,8", "--from", "2026-06-21T00:00+02:00", "--to", "2026-06-22T00:00+02:00")
SIZE = ("--size", "96x64")


def pfm(path):
    """Rows from the top."""
    head, size, _, values = path.read_bytes().split(b"\n", 3)
    assert head == b"Pf"
    width, height = map(int, size.split())
    numbers = array.array("f", values)
    return [numbers[width * (height - 1 - row) : width * (height - row)] for row in range(height)]


class SunHours(ProgramTest):
    def hours(self, name, *words):
        """The bytes of the three files."""
        paths = [self.place / f"{name}.{kind}" for kind in ("png", "pfm", "csv")]
        told = self.expect(0, "of 96 steps", "sun", "hours", self.sundial, *DAY, "--step", "15m", *SIZE,
                           "-o", paths[0], "--pfm", paths[1], "--csv", paths[2], *words)  # fmt: skip
        self.assertFalse((self.place / f"{name}.png.steps").exists())
        return paths, [path.read_bytes() for path in paths], told.stderr

    def test_files_agree_whatever_the_threads(self):
        paths, written, told = self.hours("plan")
        self.assertEqual(self.hours("again", "--threads", "1")[1], written)
        with open(paths[2], newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertIn(f"{len(rows)} points, sun up in 64 of 96 steps", told)
        image = pfm(paths[1])
        covered = sum(value >= 0 for row in image for value in row)
        self.assertEqual(covered, len(rows))
        self.assertGreater(covered, 1000)
        for row in rows:
            steps = int(row["steps"])
            self.assertEqual(float(row["hours"]), steps / 4)
            self.assertEqual(image[int(row["row"])][int(row["column"])], steps / 4)
            self.assertEqual(row["first_sun"] == "", steps == 0)
            self.assertLessEqual(row["first_sun"], row["last_sun"])
        self.assertGreater(len({row["steps"] for row in rows}), 10)

    def test_sections_cut_what_is_seen_and_what_casts(self):
        section = ("--section", "0,1,0,0,1,0")
        whole, cut, kept = (pfm(self.hours(name, *words)[0][1]) for name, words in (
            ("whole", ()), ("cut", section), ("kept", (*section, "--section-casters", "keep"))))
        both = [(a, b, c) for rows in zip(whole, cut, kept) for a, b, c in zip(*rows) if b >= 0]
        self.assertGreater(len(both), 500)
        self.assertTrue(all(b >= c for _, b, c in both), "what is cut away takes no sun")
        self.assertGreater(sum(b > c for _, b, c in both), 50)
        self.assertGreater(sum(a < 0 <= b or a != b for a, b, _ in both), 50)
        points, table = self.place / "under.csv", self.place / "hours.csv"
        points.write_text("".join(f"{x / 2},0.5,{z / 2}\n" for x in range(-6, 7) for z in range(-6, 7)))
        asked = ("sun", "hours", self.sundial, *DAY, "--step", "15m", "--points", points, "--csv", table)
        steps = []
        for words in ((), section, (*section, "--section-casters", "keep")):
            self.expect(0, "169 points", *asked, *words)
            with open(table, newline="") as file:
                steps.append([int(row["steps"]) for row in csv.DictReader(file)])
        self.assertEqual(steps[0], steps[2])
        self.assertTrue(all(a >= b for a, b in zip(steps[1], steps[0])), steps)
        self.assertGreater(sum(steps[1]), sum(steps[0]) + 20)

    def test_points_and_vertices(self):
        points = self.place / "points.csv"
        points.write_text("x,y,z,name\n0,50,0,far above\n\n  0 , 0.02 , 0 \r\n1e0,2.5,1,beside\n")
        table = self.place / "table.csv"
        asked = ("sun", "hours", self.sundial, *DAY, "--step", "15m")
        self.expect(0, "3 points, sun up in 64 of 96 steps", *asked, "--points", points, "--csv", table)
        with open(table, newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["steps"] for row in rows][:2], ["64", "0"])
        self.assertEqual((rows[0]["x"], rows[0]["y"], rows[0]["first_sun"]), ("0", "50", "2026-06-21T05:37:30+02:00"))
        points.write_text("1,2,3\n1,2\n")
        told = self.expect(1, "three numbers x,y,z", *asked, "--points", points, "--csv", table)
        self.assertIn("points.csv:2", told.stderr)
        mesh = self.place / "hours.ply"
        self.expect(0, "sun up in 64", *asked, "--vertices", "-o", mesh)
        plain = self.place / "plain.ply"
        self.expect(0, "", "export", self.sundial, "--error", "1e-3", "-o", plain)
        head = mesh.read_bytes().split(b"end_header\n")[0].decode().split("\n")
        self.assertIn("property float hours", head)
        self.assertEqual([line for line in head if "element" in line],
                         [line for line in plain.read_bytes().split(b"end_header\n")[0].decode().split("\n") if "element" in line])  # fmt: skip
        again = self.place / "again.ply"
        self.expect(0, "", *asked, "--vertices", "-o", again, "--threads", "1")
        self.assertEqual(again.read_bytes(), mesh.read_bytes())
        for words, said in (
            (("--points", points, "--vertices"), "excludes"),
            (("--points", points, "-o", again), "--points needs --csv"),
            (("--vertices", "--csv", table), "--vertices needs -o"),
            (("--vertices", "-o", again, "--view", "top"), "need no view"),
            (("-o", self.place / "x.png", "--error", "1"), "--error needs --points"),
        ):
            self.expect(2, said, *asked, *words)

    def test_a_killed_run_goes_on(self):
        whole = self.hours("whole")[1]
        words = ["sun", "hours", self.sundial, *DAY, *SIZE]
        outputs = ["-o", self.place / "cut.png", "--pfm", self.place / "cut.pfm", "--csv", self.place / "cut.csv"]
        log = self.place / "cut.png.steps"
        slowed = [GNOMON, *map(str, words + outputs), "--step", "15m", "--threads", "1"]
        process = subprocess.Popen(slowed, stderr=subprocess.DEVNULL)
        while process.poll() is None and not (log.exists() and log.stat().st_size > 3000):
            time.sleep(0.001)
        if process.poll() is None:
            os.kill(process.pid, signal.SIGKILL)
        killed = process.wait() != 0
        self.assertEqual(log.exists(), killed)
        if killed:
            other = run(*words, *outputs, "--resume", "--step", "10m")
            self.assertEqual((other.returncode, "cannot resume" in other.stderr), (1, True), other.stderr)
        self.assertEqual(self.hours("cut", "--resume")[1], whole)

    def test_what_is_refused(self):
        picture = self.place / "refused.png"
        asked = ("sun", "hours", self.sundial, *DAY, "--step", "15m", *SIZE)
        self.expect(2, "needs an output", *asked)
        for words, said in (
            (("--light", "1,1,1"), "--light"),
            (("--sun", "47,8,2026-06-21T12:00Z"), "--sun"),
            (("--shadows", "maps"), "--shadows"),
            (("--z-partitions", "2"), "exact shadows"),
            (("--backend", "egl"), "--backend"),
            (("--sky", "16"), "--sky"),
            (("--sun-angle", "0.5"), "--sun-angle"),
        ):
            self.expect(2, said, *asked, "-o", picture, *words)
        start = ("sun", "hours", self.sundial, "-o", picture, "--at", "47,8", "--from", "2026-06-21T00:00+02:00")
        self.expect(2, "--to must be later", *start, "--to", "2026-06-20T00:00+02:00", "--step", "1h")
        self.expect(2, "--step: expected a time such as", *start, "--to", "2026-06-22T00:00+02:00", "--step", "15")
        self.expect(2, "--step must be at most twice", *start, "--to", "2026-06-21T01:00+02:00", "--step", "3h")
        self.expect(1, "the sun is below the horizon", *start, "--to", "2026-06-21T02:00+02:00", "--step", "10m")
        self.assertEqual(list(self.place.path.glob("refused*")), [])
