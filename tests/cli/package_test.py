"""The Debian packages: what is in them, and that what they hold works from where it is put."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from program import DATA, run

BUILD = pathlib.Path(os.environ["GNOMON"]).resolve().parent


def commands():
    """Every command of the program with those below it, as --help lists them."""
    def below(path):
        help_text = run(*path, "--help").stdout
        listed = help_text.partition("Commands:\n")[2]
        for name in re.findall(r"^  ([a-z]+) ", listed, re.M):
            yield [*path, name]
            yield from below([*path, name])
    return list(below([]))


@unittest.skipUnless(shutil.which("dpkg-shlibdeps"), "dpkg-dev is not installed")
class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.place.name) / "root"
        made = subprocess.run(["cpack", "-G", "DEB", "-B", cls.place.name], cwd=BUILD, capture_output=True, text=True)
        assert made.returncode == 0, made.stdout + made.stderr
        files = list(pathlib.Path(cls.place.name).glob("*.deb"))
        cls.names = {file.name.split("_")[0] for file in files}
        for file in files:
            subprocess.run(["dpkg-deb", "-x", file, cls.root], check=True)

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def test_it_runs_from_where_it_is_put(self):
        done = subprocess.run([self.root / "usr/bin/gnomon", "--version"], capture_output=True, text=True)
        self.assertEqual((done.stdout, done.stderr), (run("--version").stdout, ""))

    def test_there_is_one_for_each_use(self):
        self.assertLessEqual({"gnomon", "libgnomon0", "libgnomon-dev"}, self.names)
        for package in self.names:
            self.assertTrue((self.root / "usr/share/doc" / package / "copyright").exists(), package)

    def test_the_example_compiles_against_what_is_installed(self):
        place = pathlib.Path(self.place.name)
        source = pathlib.Path(__file__).resolve().parents[2] / "examples/cut_and_shadow"
        for words in (["cmake", "-S", source, "-B", place / "example", f"-DCMAKE_PREFIX_PATH={self.root / 'usr'}"],
                      ["cmake", "--build", place / "example"]):
            done = subprocess.run(words, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        made = subprocess.run([place / "example/cut_and_shadow", DATA / "models/sundial.ply", place / "example.gnm",
                               place / "example.ppm"], capture_output=True, text=True)
        self.assertEqual((made.returncode, made.stderr), (0, ""))
        self.assertRegex(made.stdout, r"cut: \d+ triangles, off by at most .*\n(.* maps: .* texels a pixel\n)+")
        self.assertEqual((place / "example.ppm").stat().st_size, len("P6 320 240 255\n") + 3 * 320 * 240)

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
