"""The replays of ../shared/faults/turn3 that take long: large pictures, long polygons, sparse logs and power cuts."""
import hashlib
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import unittest

from program import GNOMON
from replay import FAULTS, IS_SANITIZED, ReplayTest

DAMAGES = 200


@unittest.skipIf(IS_SANITIZED, "sanitizers need time and memory of their own")
class SlowReplay(ReplayTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.faults = cls.place / "faults.so"  # ends the process at a call of the system that the environment names
        subprocess.run(["cc", "-shared", "-fPIC", "-o", cls.faults, FAULTS / "fi.c", "-ldl"], check=True)

    def test_large_pictures_fit_or_say_what_they_need(self):
        for size, samples in (("16384x16384", 1), ("7680x4320", 16)):
            code, _, err, _, peak = self.measured(
                GNOMON, "render", self.sundial, "--size", size, "--samples", samples, "--shadows", "exact", "--memory",
                "1G", "-o", self.place / "large.png", "--progress", "none")
            self.assertLess(peak, 1024, err)
            if code != 0:
                self.assertEqual((code, err.count("\n")), (1, 1), err)
                self.assertRegex(err, r"at least [\d.]+ (GiB|MiB)")

    def test_a_polygon_of_a_million_corners_takes_no_minutes(self):
        subprocess.run([sys.executable, FAULTS / "poly_comb.py", "1000000"], cwd=self.place.path, check=True)
        code, _, err, seconds, _ = self.measured(
            GNOMON, "build", self.place / "poly_comb.ply", "-o", self.place / "comb.gnm", "--progress", "none")
        self.assertIn(code, (0, 1), err)
        self.assertLess(seconds, 20, err)

    def test_a_sparse_log_takes_no_time(self):
        script = ["bash", FAULTS / "sun_log.sh", GNOMON, self.faults]
        code, _, err, seconds, _ = self.measured(*script, env=dict(os.environ, SIZE="1G"))
        self.assertEqual(code, 0, err)
        self.assertLess(seconds, 4)

    def killed(self, command, state, calls):
        """Runs `command` until it is killed at its call number `calls`, and gives what is left to `state`."""
        environment = dict(os.environ, LD_PRELOAD=str(self.faults), FI_CALL="pwrite|pread|fallocate|unlink|rename",
                           FI_ACT="KILL", FI_N=str(calls))  # fmt: skip
        self.measured(*command, env=environment)
        self.assertTrue((self.place / "o.gnm.building").is_dir(), f"nothing was left after {calls} calls")
        shutil.rmtree(state, ignore_errors=True)
        (self.place / "o.gnm.building").rename(state)

    @staticmethod
    def damage(folder, seeded):
        """Damages one file in one of the ways of disks that lose power; returns in words what it did."""
        file = seeded.choice(sorted(path for path in folder.iterdir() if path.name != "lock"))
        data = bytearray(file.read_bytes())
        at = seeded.randrange(len(data) + 1)
        if seeded.random() < 0.7:
            at = at // 4096 * 4096
        length = min(seeded.choice((1, 4096, 4096, 40960, len(data))), len(data) - at)
        kind = seeded.choice(("zeros", "zeros", "flip", "cut", "swap", "missing"))
        if kind == "zeros":
            data[at : at + length] = bytes(length)
        elif kind == "flip" and length:
            data[at] ^= 1 << seeded.randrange(8)
        elif kind == "cut":
            del data[at:]
        elif kind == "swap":
            other = seeded.randrange(len(data) - length + 1)
            data[at : at + length], data[other : other + length] = data[other : other + length], data[at : at + length]
        if kind == "missing":
            file.unlink()
        else:
            file.write_bytes(data)
        return f"{kind} of {length} bytes at {at} of {file.name}"

    def test_a_power_cut_changes_no_model(self):
        mesh, model, state = self.place / "in.ply", self.place / "o.gnm", self.place / "state"
        self.expect(0, "", "make", "plant", "--triangles", "30000", "--seed", "78", "-o", mesh)
        command = (GNOMON, "build", mesh, "-o", model, "--chunk-triangles", "2k", "--threads", "1", "--progress", "none")
        self.assertEqual(self.measured(*command)[0], 0)
        expected = hashlib.sha256(model.read_bytes()).hexdigest()
        seeded, anew = random.Random(3), 0
        for i in range(DAMAGES):
            if i % 25 == 0:
                self.killed(command, state, seeded.randrange(100, 1400))
            shutil.copytree(state, self.place / "o.gnm.building")
            model.unlink(missing_ok=True)
            done = self.damage(self.place / "o.gnm.building", seeded)
            code, _, err, _, _ = self.measured(*command, "--resume")
            if code == 1:
                self.assertEqual(err.count("\n"), 1, f"{done}: {err}")
                shutil.rmtree(self.place / "o.gnm.building", ignore_errors=True)
                continue
            self.assertEqual(code, 0, f"{done}: {err}")
            self.assertEqual(hashlib.sha256(model.read_bytes()).hexdigest(), expected, done)
            anew += "the build starts again from the beginning" in err
        self.assertGreater(anew, DAMAGES // 10)


if __name__ == "__main__":
    unittest.main()
