"""The deterministic tables of the pages equal a new run."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from program import GNOMON

ROOT = pathlib.Path(__file__).resolve().parents[2]


def tables(*words):
    command = [sys.executable, ROOT / "scripts/tables", "--check", "--gnomon", GNOMON, *words]
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Tables(unittest.TestCase):
    def test_all_equal_a_new_run(self):
        told = tables()
        self.assertEqual(told.returncode, 0, told.stdout + told.stderr + "run scripts/tables to write the new values")

    def test_a_changed_digit_is_found(self):
        with tempfile.TemporaryDirectory(prefix="gnomon_tables_") as folder:
            for name in ("bench/README.md", "docs/stored_error.md", "docs/exact_shadows.md"):
                (pathlib.Path(folder) / name).parent.mkdir(exist_ok=True)
                shutil.copy(ROOT / name, pathlib.Path(folder) / name)
            page = pathlib.Path(folder) / "docs/stored_error.md"
            text = page.read_text()
            page.write_text(re.sub(r"(\| plant 300k \| \d\.\d)\d", lambda found: found[1] + "x", text))
            told = tables("--pages", folder, "--only", "stored_error")
            self.assertEqual(told.returncode, 1, told.stderr)
            self.assertIn("-| plant 300k | ", told.stdout)
            self.assertIn("x", page.read_text(), "a check changes no page")
            page.write_text(text.replace("<!-- end -->", ""))
            told = tables("--pages", folder, "--only", "stored_error")
            self.assertEqual(told.returncode, 1)
            self.assertIn("stored_error: expected one table with this name in the pages, found 0", told.stderr)
