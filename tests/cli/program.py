"""The program under test, $GNOMON, and two small models of data/ that it built."""
import os
import pathlib
import subprocess
import tempfile

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
