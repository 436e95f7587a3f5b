"""Runs the commands of README.md and docs/guide.md, in their order, on small models.

Commands that need a display, a network, root or MPI are only parsed: each of their options must be in the help of the
command. Counts of `make` and sizes of pictures are reduced, so that all commands take less than a minute.
"""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import tempfile
import unittest

from program import GNOMON, run

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ("README.md", "docs/guide.md")
ONLY_PARSED = re.compile(r"gnomon view|gnomon-mpi|https?://|egl")
NOT_RUN = re.compile(r"export |scripts/\w+")  # the shell's own, and scripts that install packages


def commands_of(page):
    """The commands of the page's ```sh blocks without their comments."""
    for block in re.findall(r"^```sh\n(.*?)^```", (ROOT / page).read_text(), re.M | re.S):
        for line in block.replace("\\\n", " ").splitlines():
            command = re.sub(r"\s+#\s.*", "", line).strip()
            if command:
                yield command


def reduced(command):
    """The same command for small models and pictures."""
    command = re.sub(r"(gnomon make \w+ --triangles) \w+", r"\1 20k", command)
    if re.search(r"gnomon (render|bench|explain|sun hours)", command):
        command = re.sub(r"(gnomon (render|bench|explain|sun hours) \S+)", r"\1 --size 160x160", command)
    return command


def headings(page):
    """The anchors that GitHub gives the headings of a page."""
    titles = re.findall(r"^#+ (.*)$", page.read_text(), re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


class Pages(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory(prefix="gnomon_pages_")
        self.addCleanup(self.folder.cleanup)
        self.place = pathlib.Path(self.folder.name)
        (self.place / "bin").mkdir()
        (self.place / "bin" / "gnomon").symlink_to(pathlib.Path(GNOMON).resolve())
        self.environment = dict(os.environ, PATH=f"{self.place / 'bin'}:{os.environ['PATH']}")
        made = run("make", "statue", "--triangles", "20k", "-o", self.place / "scan.ply")
        self.assertEqual(made.returncode, 0, made.stderr)

    def execute(self, command):
        done = subprocess.run(["bash", "-eo", "pipefail", "-c", command], cwd=self.place, env=self.environment,
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stderr}")

    def parse(self, command):
        words = shlex.split(command)
        start = next(i for i, word in enumerate(words) if word.startswith("gnomon"))
        subcommand = words[start + 1:start + 2] + (["hours"] if "hours" in words else [])
        text = run(*subcommand, "--help").stdout + run(*subcommand, "--help-all").stdout
        for option in [word for word in words[start:] if word.startswith("--")]:
            self.assertRegex(text, rf"{option}\b", command)

    def test_their_commands_do_what_they_say(self):
        for page in PAGES:
            for command in commands_of(page):
                with self.subTest(command=command):
                    if NOT_RUN.match(command):
                        for script in re.findall(r"scripts/\w+", command):
                            self.assertTrue(os.access(ROOT / script, os.X_OK), script)
                    elif ONLY_PARSED.search(command):
                        self.parse(command)
                    elif "ffmpeg" not in command or shutil.which("ffmpeg"):
                        self.execute(reduced(command))

    def test_their_links_lead_to_files_and_headings(self):
        for page in [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "bench/README.md", *(ROOT / "docs").glob("*.md")]:
            for path, heading in re.findall(r"\]\((?!https?:)([^)#]*)(?:#([^)]*))?\)", page.read_text()):
                target = page.parent / path if path else page
                self.assertTrue(target.exists(), f"{page.name}: {path}")
                if heading:
                    self.assertIn(heading, headings(target), f"{page.name}: {path}#{heading}")
