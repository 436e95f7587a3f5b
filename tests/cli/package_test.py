"""The Debian package: what is in it, and that what it holds works from where it is put."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from program import run

BUILD = pathlib.Path(os.environ["GNOMON"]).resolve().parent


def commands():
    """Every command of the program with those below it, as --help lists them."""
    def below(path):
        help_text = run(*path, "--help").stdout
        listed = help_text.partition("Subcommands:\n")[2]
        for name in re.findall(r"^  ([a-z]+) ", listed, re.M):
            yield [*path, name]
            yield from below([*path, name])
    return list(below([]))


@unittest.skipUnless(shutil.which("dpkg-shlibdeps"), "dpkg-dev is not installed")
class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.place.name) / "root"
        made = subprocess.run(["cpack", "-G", "DEB", "-B", cls.place.name], cwd=BUILD, capture_output=True, text=True)
        assert made.returncode == 0, made.stdout + made.stderr
        (cls.file,) = pathlib.Path(cls.place.name).glob("*.deb")
        subprocess.run(["dpkg-deb", "-x", cls.file, cls.root], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def test_it_runs_from_where_it_is_put(self):
        done = subprocess.run([self.root / "usr/bin/gnomon", "--version"], capture_output=True, text=True)
        self.assertEqual(done.stdout, run("--version").stdout)

    def test_every_command_has_its_page(self):
        pages = {path.name for path in (self.root / "usr/share/man/man1").iterdir()}
        told = {"-".join(["gnomon", *path]) + ".1.gz" for path in commands() if path != ["manual"]}
        self.assertEqual(pages, told | {"gnomon.1.gz"})

    def test_completions_are_those_that_are_printed(self):
        for shell, file in (("bash", "bash-completion/completions/gnomon"), ("zsh", "zsh/vendor-completions/_gnomon"),
                            ("fish", "fish/vendor_completions.d/gnomon.fish")):
            self.assertEqual((self.root / "usr/share" / file).read_text(), run("manual", shell).stdout, shell)

    def test_a_desktop_finds_it(self):
        entry = (self.root / "usr/share/applications/gnomon.desktop").read_text()
        for words in ("Exec=gnomon view %f", "Icon=gnomon", "application/x-gnomon;"):
            self.assertIn(words, entry)
        self.assertTrue((self.root / "usr/share/icons/hicolor/scalable/apps/gnomon.svg").exists())
        if shutil.which("update-mime-database"):
            subprocess.run(["update-mime-database", self.root / "usr/share/mime"], check=True, capture_output=True)
            globs = (self.root / "usr/share/mime/globs").read_text()
            self.assertIn("application/x-gnomon:*.gnm", globs)


if __name__ == "__main__":
    unittest.main()
