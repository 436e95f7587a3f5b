"""A job across two hosts: network namespaces of this machine that share a folder, a cable and nothing else."""
import json
import os
import pathlib
import shutil
import subprocess
import unittest

from job import GNOMON_MPI, SETTINGS, JobTest, Told

SMALL = ("--chunk-triangles", "4k", "--threads", "1")
NOT_PERMITTED = 77  # as two_hosts has it


def separated():
    """How namespaces are made here; nothing where they are not permitted."""
    apart = ["unshare", "--net", "--mount", "--uts"]
    for words in (apart, [*apart, "--map-root-user"]):
        if shutil.which("unshare") and shutil.which("ip") and subprocess.run([*words, "true"], capture_output=True).returncode == 0:
            return words
    return None


class TwoHosts(JobTest):
    def setUp(self):
        self.apart = separated()
        if not self.apart:
            self.skipTest("no namespaces: this system does not permit them, or has no `unshare` and `ip`")
        (self.place / "local").mkdir(exist_ok=True)

    def tearDown(self):
        shutil.rmtree(self.place / "local", ignore_errors=True)
        (self.place / "remote_shell").unlink(missing_ok=True)

    def across(self, *words):
        """What comes of a job of a process on each host."""
        script = pathlib.Path(__file__).with_name("two_hosts")
        environment = {**os.environ, **{name: value for name, value in SETTINGS.items() if name != "OMPI_MCA_plm"}}
        job = subprocess.Popen([*self.apart, script, self.place, "-n", "2", *map(str, words)], env=environment, text=True,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)  # fmt: skip
        told = Told(job)
        if told.returncode == NOT_PERMITTED:
            self.skipTest(f"no two hosts: {told.stderr}")
        return told

    def test_they_share_nothing_but_the_folder(self):
        told = self.across("sh", "-c", f"echo $(hostname) $(stat -c %d {self.place}/local) $(stat -c %d {self.place})")
        self.assertEqual(told.returncode, 0, told.stderr)
        (a, local_a, shared_a), (b, local_b, shared_b) = sorted(line.split() for line in told.stdout.splitlines())
        self.assertEqual((a, b), ("node-a", "node-b"))
        self.assertEqual(shared_a, shared_b)
        self.assertEqual(len({local_a, local_b, shared_a}), 3)

    def test_build_the_bytes_of_one(self):
        mesh, model = self.made("plant", "60k"), self.place / "m.gnm"
        expected = self.hash_alone(mesh, *SMALL)
        told = self.across(GNOMON_MPI, "build", mesh, "-o", model, *SMALL, "--json")
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        report = json.loads(told.stdout)
        self.assertEqual(report["content_hash"], expected)
        self.assertEqual([rank["host"] for rank in report["ranks"]], ["node-a", "node-b"])
        for rank in report["ranks"]:
            self.assertGreater(rank["tasks"], 0)
        self.assertEqual(self.left(), ["local", "m.gnm", "remote_shell"])


if __name__ == "__main__":
    unittest.main()
