"""The program under test, $GNOMON, and two small models of data/ that it built."""
import os
import pathlib
import subprocess
import tempfile
import unittest

GNOMON = os.environ["GNOMON"]
DATA = pathlib.Path(__file__).resolve().parents[2] / "data"


def run(*words, **options):
    """What came of `gnomon WORDS...`; text that is no UTF-8 is kept as escapes."""
    command = [GNOMON, *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, errors="backslashreplace", timeout=120, **options)


class Workplace:
    """A folder with sundial.gnm and colonnade.gnm; gone when it is closed."""

    def __init__(self):
        self.folder = tempfile.TemporaryDirectory(prefix="gnomon_cli_")
        self.path = pathlib.Path(self.folder.name)
        for mesh in ("sundial.ply", "colonnade.obj"):
            built = run("build", DATA / "models" / mesh, "-o", (self.path / mesh).with_suffix(".gnm"))
            assert built.returncode == 0, built.stderr

    def __truediv__(self, name):
        return self.path / name

    def close(self):
        self.folder.cleanup()


class ProgramTest(unittest.TestCase):
    """Runs the program in a workplace of the test's own, `place`, whose `sundial` is a model."""

    @classmethod
    def setUpClass(cls):
        cls.place = Workplace()
        cls.sundial = cls.place / "sundial.gnm"

    @classmethod
    def tearDownClass(cls):
        cls.place.close()

    def expect(self, code, said, *words, **options):
        result = run(*words, **options)
        self.assertEqual(result.returncode, code, f"{words}: {result.stderr}")
        self.assertIn(said, result.stderr)
        if code:
            self.assertEqual(result.stderr.count("\n"), 1, f"{words}: {result.stderr}")
            self.assertTrue(result.stderr.startswith("gnomon: "), result.stderr)
        return result
