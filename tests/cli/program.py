"""The program under test, $GNOMON, and two small models of data/ that it built."""
import dataclasses
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

GNOMON = os.environ["GNOMON"]
DATA = pathlib.Path(__file__).resolve().parents[2] / "data"


def run(*words, **options):
    """What came of `gnomon WORDS...`; text that is no UTF-8 is kept as escapes."""
    command = [GNOMON, *map(str, words)]
    return subprocess.run(command, capture_output=True, text=True, errors="backslashreplace", timeout=120, **options)


@dataclasses.dataclass
class Measured:
    """What came of a process."""

    code: int
    out: str
    err: str
    seconds: float  # of processor time
    peak: int  # resident bytes

    @property
    def mebibytes(self):
        return self.peak / (1 << 20)


def measured(*command, env=None):
    """Runs `command` from a small process: the kernel counts the memory of the one that starts it."""
    with tempfile.TemporaryDirectory(prefix="gnomon_measured_") as folder, open(f"{folder}/out", "w+b") as out, \
            open(f"{folder}/err", "w+b") as err:  # fmt: skip
        starter = [sys.executable, "-S", "-E", pathlib.Path(__file__).with_name("measured.py"), f"{folder}/usage"]
        environment = json.dumps(dict(os.environ if env is None else env))
        subprocess.run([*map(str, (*starter, environment, *command))], stdout=out, stderr=err, check=True)
        texts = []
        for file in (out, err):
            file.seek(0)
            texts.append(file.read().decode(errors="backslashreplace"))
        code, seconds, peak = json.loads(pathlib.Path(f"{folder}/usage").read_text())
    return Measured(code, *texts, seconds, peak)


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
