"""What ends a job, and that another one goes on with what it left."""
import json
import os
import random
import signal
import time
import unittest

from job import JobTest, Told, alone, ranks_of, run, slow, start

SMALL = ("--chunk-triangles", "4k", "--threads", "1")


class Failures(JobTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.model = cls.place / "m.gnm"

    def setUp(self):
        self.model.unlink(missing_ok=True)  # of a test that failed

    def expect_finish(self, processes, mesh, expected):
        told = run(processes, "build", mesh, "-o", self.model, *SMALL, "--resume", "--json")
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertEqual(json.loads(told.stdout)["content_hash"], expected)
        self.assertEqual(self.left(), ["m.gnm"])
        self.model.unlink()

    @slow
    def test_a_killed_rank_ends_the_job_and_any_number_goes_on(self):
        mesh = self.made("plant", "150k")
        expected = self.hash_alone(mesh, *SMALL)
        chance = random.Random(int(os.environ.get("GNOMON_KILL_SEED", "1")))
        ended = 0
        for _ in range(int(os.environ.get("GNOMON_KILLS", "4"))):
            processes = chance.randint(2, 3)
            job = start(processes, "build", mesh, "-o", self.model, *SMALL, "--resume")
            ranks = ranks_of(job, processes)
            time.sleep(chance.uniform(0.05, 1.2))
            if job.poll() is None and ranks:
                try:
                    os.kill(chance.choice(list(ranks.values())), signal.SIGKILL)
                except ProcessLookupError:
                    pass
            told = Told(job)
            ended += told.returncode != 0
            if self.model.exists():  # a rank may be killed when all is done
                self.assertEqual(json.loads(alone("info", self.model, "--json"))["content_hash"], expected)
                self.model.unlink()
            else:
                self.assertNotEqual(told.returncode, 0)
            if chance.random() < 0.5:
                self.expect_finish(chance.randint(1, 3), mesh, expected)
        self.expect_finish(2, mesh, expected)
        self.assertGreater(ended, 0)

    @slow
    def test_a_job_that_is_told_to_end_keeps_what_it_has(self):
        mesh = self.made("plant", "150k")
        expected = self.hash_alone(mesh, *SMALL)
        job = start(2, "build", mesh, "-o", self.model, *SMALL, "--scratch-rate", "2M")  # long enough to be ended
        log = self.place / "m.gnm.building/checkpoints"
        sizes = set()
        for _ in range(4000):  # until the source is in chunks: the first record after that of what is built
            sizes.add(log.stat().st_size if log.exists() else 0)
            if len(sizes) > 2 or job.poll() is not None:
                break
            time.sleep(0.002)
        job.send_signal(signal.SIGTERM)
        told = Told(job)
        self.assertNotEqual(told.returncode, 0)
        self.assertEqual(self.left(), ["m.gnm.building"])
        self.expect_finish(3, mesh, expected)

    @slow
    def test_a_stopped_rank_is_waited_for(self):
        mesh = self.made("plant", "150k")
        expected = self.hash_alone(mesh, *SMALL)
        job = start(3, "build", mesh, "-o", self.model, *SMALL, "--json")
        rank = ranks_of(job, 3)[1]
        time.sleep(0.3)
        os.kill(rank, signal.SIGSTOP)
        time.sleep(float(os.environ.get("GNOMON_STOP_SECONDS", "2")))
        os.kill(rank, signal.SIGCONT)
        told = Told(job)
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertEqual(json.loads(told.stdout)["content_hash"], expected)
        self.model.unlink()

    def test_a_full_disk_of_one_rank_is_one_line_and_the_old_output_stays(self):
        mesh = self.made("plant", "150k")
        expected = self.hash_alone(mesh, *SMALL)
        self.model.write_text("the old one")
        told = run(3, "build", mesh, "-o", self.model, *SMALL, program=self.of_rank(2, "ulimit -f 100"),
                   settings={"OMPI_MCA_btl": "tcp,self"})  # fmt: skip
        self.assertEqual((told.returncode, len(told.lines)), (1, 1), told.stderr)
        self.assertRegex(told.lines[0], r"gnomon: rank 2 on \S+: .*/m.gnm.building/scratch.2: byte \d+: .*File too large")
        self.assertEqual(self.model.read_text(), "the old one")
        self.expect_finish(2, mesh, expected)

    def test_an_input_that_one_rank_cannot_read_is_one_line(self):
        mesh = self.made("plant", "60k")
        hidden = self.place / "hidden.ply"
        hidden.write_bytes(mesh.read_bytes())
        other = self.of_rank(1, f'set -- build {self.place}/nothing.ply "${{@:3}}"')
        told = run(3, "build", hidden, "-o", self.model, *SMALL, program=other)
        self.assertEqual((told.returncode, len(told.lines)), (1, 1), told.stderr)
        self.assertRegex(told.lines[0], r"gnomon: rank 1\b.*nothing.ply: cannot open: No such file")
        told = run(2, "build", hidden, "-o", self.model, *SMALL, program=self.of_rank(1, 'set -- "$@" --cluster-triangles 64'))
        self.assertEqual((told.returncode, len(told.lines)), (1, 1), told.stderr)
        self.assertIn("it has other inputs, other options", told.lines[0])
        self.assertEqual(self.left(), [])

    def test_wrong_usage_is_one_line_and_exit_2(self):
        for words, said in ((("build",), "INPUT is required"), (("walk",), "there is no command 'walk'"),
                            (("bench", self.model, "--path", "p.json"), "bench works only in one process; use gnomon bench"),
                            (("build", self.made("plant", "60k"), "-o", self.model, "--in-memory"), "without temporary files")):  # fmt: skip
            told = run(2, *words)
            self.assertEqual((told.returncode, len(told.lines)), (2, 1), told.stderr)
            self.assertIn(said, told.lines[0])
        told = run(2, "--version")
        self.assertEqual((told.returncode, told.stdout.count("gnomon-mpi")), (0, 1))
        self.assertEqual(run(2, "build", "--help").stdout.count("Usage:"), 1)


if __name__ == "__main__":
    unittest.main()
