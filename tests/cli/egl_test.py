"""GPUs that cannot be used: the next one is tried, then the software backend draws, and one line says why."""
import json
import os
import pathlib
import unittest

from program import ProgramTest, run


@unittest.skipUnless(pathlib.Path("/usr/lib/x86_64-linux-gnu/libEGL.so.1").exists(), "there is no EGL")
class EglTest(ProgramTest):
    @staticmethod
    def environment(gpus, dead):
        return dict(os.environ, LD_LIBRARY_PATH=os.environ["FAILING_EGL"], EGL_GPUS=str(gpus), EGL_DEAD=str(dead))

    def drawn(self, gpus, dead, *words):
        stats = self.place / "stats.json"
        stats.unlink(missing_ok=True)
        drawing = ("render", self.sundial, "-o", self.place / "p.png", "--size", "16x16", "--stats", stats)
        result = run(*drawing, *words, env=self.environment(gpus, dead))
        return result, json.loads(stats.read_text())["backend"] if stats.exists() else None

    def test_the_next_gpu_is_tried(self):
        result, backend = self.drawn(2, 1, "--backend", "egl")
        self.assertEqual((result.returncode, backend), (0, "egl"), result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn("GPU 1 of 2", result.stderr)

    def test_auto_falls_back_to_software(self):
        pictures = [self.place / "0.png", self.place / "1.png"]
        result = run("render", self.sundial, "--turntable", "2", "-o", self.place / "%d.png", "--size", "16x16",
                     env=self.environment(1, 1))  # fmt: skip
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        self.assertIn("software", result.stderr)
        self.assertTrue(all(picture.exists() for picture in pictures))

    def test_a_single_picture_needs_no_gpu(self):
        result, backend = self.drawn(2, 1)
        self.assertEqual((result.returncode, backend, result.stderr), (0, "software", ""))

    def test_a_backend_that_was_asked_for_is_an_error(self):
        result, backend = self.drawn(2, 2, "--backend", "egl")
        self.assertEqual((result.returncode, backend), (1, None))
        self.assertEqual(result.stderr.count("gnomon: EGL"), 1, result.stderr)
        self.assertIn("no GPU can be used", result.stderr)


if __name__ == "__main__":
    unittest.main()
