"""GPUs that cannot be used: the next one is tried, then the software backend draws, and one line says why."""
import json
import os
import pathlib
import unittest

from program import ProgramTest, run


@unittest.skipUnless(pathlib.Path("/usr/lib/x86_64-linux-gnu/libEGL.so.1").exists(), "there is no EGL")
class EglTest(ProgramTest):
    def drawn(self, gpus, dead, *words):
        environment = dict(os.environ, LD_LIBRARY_PATH=os.environ["FAILING_EGL"], EGL_GPUS=str(gpus), EGL_DEAD=str(dead))
        stats = self.place / "stats.json"
        stats.unlink(missing_ok=True)
        drawing = ("render", self.sundial, "-o", self.place / "p.png", "--size", "16x16", "--stats", stats)
        result = run(*drawing, *words, env=environment)
        return result, json.loads(stats.read_text())["backend"] if stats.exists() else None

    def test_the_next_gpu_is_tried(self):
        for words in ((), ("--backend", "egl")):
            result, backend = self.drawn(2, 1, *words)
            self.assertEqual((result.returncode, backend), (0, "egl"), result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn("GPU 1 of 2", result.stderr)

    def test_auto_falls_back_to_software(self):
        result, backend = self.drawn(1, 1)
        self.assertEqual((result.returncode, backend), (0, "software"), result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn("software", result.stderr)

    def test_a_backend_that_was_asked_for_is_an_error(self):
        result, backend = self.drawn(2, 2, "--backend", "egl")
        self.assertEqual((result.returncode, backend), (1, None))
        self.assertEqual(result.stderr.count("gnomon: EGL"), 1, result.stderr)
        self.assertIn("no GPU can be used", result.stderr)


if __name__ == "__main__":
    unittest.main()
